//! What a mechanism says of itself, as data for whoever shows it.

use crate::bound_values::BoundValues;
use crate::builder::answers::{of_force, phrases, units, units_of_force, units_of_joint, LIMIT, MOTION};
use crate::builder::readings::FUNCTIONS;
use crate::compile::coupling_card;
use crate::dynamics::{Count, Source};
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::{Card, Joint as _, Kind};
use crate::mechanism::{Drive, DriveKind, FrictionSource, Gap, Group, Level, Mechanism, Part};
use crate::mode::Mode;
use crate::motion::{Method, METHODS};
use serde_json::{json, Map, Value};

/// What the language has: the cards of joints, forces and shapes, what can be read of a mechanism, and the integrators.
pub fn cards() -> Value {
    let joint = |card: Card| {
        let readings = if card.word == coupling_card().word { units(MOTION, None) } else { units_of_joint(&card) };
        json!({"card": card, "readings": readings})
    };
    let force = |card: Card| json!({"readings": units_of_force(&card), "card": card});
    let shapes = crate::shapes::SHAPES.iter().map(|(word, _, sizes)| json!({"type": word, "sizes": sizes}));
    let limit = |unit| units(LIMIT, unit);
    let method = |m: &&Method| {
        json!({
            "name": m.name, "order": m.order, "fixed_step": m.estimate_order.is_none(), "symplectic": m.symplectic, "analytic": m.analytic,
            "citation": m.citation,
        })
    };
    json!({
        "joints": Kind::ALL.iter().map(|k| k.card()).chain([coupling_card()]).map(joint).collect::<Vec<_>>(),
        "forces": crate::forces::ALL.iter().map(|f| force(f.card())).collect::<Vec<_>>(),
        "shapes": shapes.collect::<Vec<_>>(),
        "functions": FUNCTIONS,
        "readings": {"motion": units(MOTION, None), "contact": limit(Some("m")), "string": limit(Some("m")), "stop": limit(None)},
        "phrases": phrases(),
        "methods": METHODS.iter().map(method).collect::<Vec<_>>(),
    })
}

/// Bodies, parameters, coordinates, joints, forces, motions, events and notes.
pub fn metadata(m: &Mechanism) -> Value {
    let (numbers, start) = (m.bind(&m.parameters_with(&[])), Mode::free(m));
    json!({
        "name": m.name,
        "bodies": bodies(m, &numbers),
        "parameters": parameters(m, &numbers),
        "states": m.parameters[m.first_state()..].iter().map(|p| &p.name).collect::<Vec<_>>(),
        "coordinates": coordinates(m, &numbers, true),
        "closure_coordinates": coordinates(m, &numbers, false),
        "joints": m.listed_joints().map(|j| joint(m, &start, j)).collect::<Vec<_>>(),
        "forces": (0..m.forces.len()).map(|f| force(m, &start, f)).collect::<Vec<_>>(),
        "motions": motions(m, &start),
        "locks": locks(m),
        "limits": m.groups.iter().map(|g| limit(m, g)).collect::<Vec<_>>(),
        "events": m.events.iter().map(|e| &e.name).collect::<Vec<_>>(),
        "freedom": count(m, &start),
        "notes": notes(m, &numbers),
    })
}

fn bodies(m: &Mechanism, n: &BoundValues) -> Vec<Value> {
    // The first site of every body is its origin.
    let mut origins = vec![0; m.bodies.len()];
    m.sites.iter().enumerate().rev().for_each(|(site, s)| origins[s.body] = site);
    let entry = |&i: &usize| {
        let body = &m.bodies[i];
        // The mass centre is kept from the pin; tell it in the body's own frame.
        let centre = n.centre[i] - n.arms[origins[i]];
        json!({
            "name": body.name, "particle": body.particle, "mass": n.mass[i],
            "inertia": if body.particle { 0.0 } else { n.inertia[i] }, "centre": [centre.x, centre.y],
        })
    };
    m.listed_bodies().iter().map(entry).collect()
}

fn parameters(m: &Mechanism, n: &BoundValues) -> Vec<Value> {
    let entry = |(p, x): (&crate::mechanism::Parameter, &f64)| json!({"name": p.name, "unit": p.unit, "value": x});
    m.parameters.iter().zip(&n.p).map(entry).collect()
}

/// Coordinates of the joints in the tree, or of those that close loops.
fn coordinates(m: &Mechanism, n: &BoundValues, tree: bool) -> Vec<Value> {
    let joints = m.joints.iter().enumerate().filter(|(_, j)| j.child.is_some() == tree);
    joints
        .flat_map(|(index, j)| {
            j.coordinates.iter().map(move |c| {
                json!({"name": c.name, "word": j.kind.card().coordinates[c.card].name, "joint": j.name, "dimension": c.dimension, "absolute": c.absolute, "doc": meaning(m, n, index, c)})
            })
        })
        .collect()
}

/// What a coordinate measures, in words.
fn meaning(m: &Mechanism, n: &BoundValues, index: usize, c: &crate::mechanism::Coordinate) -> String {
    let joint = &m.joints[index];
    let [first, second] = m.listed_ends(index).map(|b| &m.bodies[b].name);
    let what = joint.kind.card().coordinates[c.card].name;
    // Markers lie along the lines of their joint, so its angles are measured from these and not from the axes of the bodies.
    let turned = n.values[joint.first.angle] - n.values[joint.second.angle];
    let zero = n.values[c.zero] + if what == "angle" && !c.absolute { turned } else { 0.0 };
    let from = match (c.dimension, c.absolute || m.ends(joint)[0] == 0) {
        ("rad", fixed) if fixed && zero != 0.0 => direction(zero.to_degrees()),
        ("rad", false) if zero != 0.0 => format!("{} to `{first}`", direction_at(zero.to_degrees())),
        _ if c.absolute => "the fixed x axis".to_string(),
        _ => format!("`{first}`"),
    };
    let sense = match (c.dimension, c.sense < 0.0) {
        ("rad", true) => ", clockwise",
        ("rad", false) => ", counter-clockwise",
        (_, true) => ", backward",
        _ => "",
    };
    format!("{what} of `{second}` from {from} at `{}`{sense}", joint.name)
}

/// Degrees within which a direction is the one that has a name: it is written with nine decimals.
const SAME_DIRECTION: f64 = 1e-9;

/// A fixed direction, by its angle to the x axis in degrees.
fn direction(degrees: f64) -> String {
    let named = [(-90.0, "straight down"), (90.0, "straight up"), (180.0, "the fixed −x axis")];
    let is = |angle: f64| (degrees - angle).abs() < SAME_DIRECTION;
    named
        .iter()
        .find(|(angle, _)| is(*angle))
        .map_or_else(|| format!("{} to the fixed x axis", direction_at(degrees)), |(_, words)| words.to_string())
}

fn direction_at(degrees: f64) -> String {
    format!("the direction at {}°", (degrees * 1e9).round() / 1e9)
}

fn joint(m: &Mechanism, start: &Mode, index: usize) -> Value {
    let j = &m.joints[index];
    let card = j.kind.card();
    let [first, second] = m.listed_ends(index).map(|b| &m.bodies[b].name);
    json!({
        "name": j.name, "type": card.word, "first": first, "second": second,
        "cut": j.child.is_none() || m.pin_of(index).is_some(), "holonomic": j.is_holonomic(),
        "engaged": start.has(m.part_of(index)),
        "coordinates": j.coordinates.iter().map(|c| &c.name).collect::<Vec<_>>(),
        "reaction": j.rows.iter().map(|&r| card.rows[r].load.name).collect::<Vec<_>>(), "couple": j.couple,
        "readings": units_of_joint(&card),
    })
}

fn limit(m: &Mechanism, g: &Group) -> Value {
    let unit = match &m.unilateral[g.constraints.start].gap {
        Gap::Gauge(law) => m.gauge_unit(law),
        Gap::ContactPair(_) | Gap::Cable(_) => Some("m"),
    };
    json!({
        "name": g.name, "type": g.word, "engaged": g.engaged, "first": m.bodies[g.ends[0]].name,
        "second": m.bodies[g.ends[1]].name, "dimension": unit.unwrap_or(""), "readings": units(LIMIT, unit),
    })
}

fn force(m: &Mechanism, start: &Mode, index: usize) -> Value {
    let f = &m.forces[index];
    let card = crate::forces::named(f.word).expect("a force of the list").card();
    let gauge = f.gauge_forces.first().map_or(Some("m"), |pull| m.gauge_unit(&pull.gauge));
    json!({
        "name": f.name, "type": f.word, "conservative": f.is_conservative(), "cases": f.has_cases(),
        "engaged": start.has(Part::Force(index)), "readings": units(&of_force(&card), gauge),
    })
}

fn motions(m: &Mechanism, start: &Mode) -> Vec<Value> {
    let level = |l: Level| match l {
        Level::Position => "position",
        Level::Velocity => "velocity",
        Level::Acceleration => "acceleration",
    };
    let motions = m.drives.iter().enumerate().filter(|(_, d)| d.is_motion());
    let entry = |(i, d): (usize, &Drive)| {
        let readings = units(MOTION, m.gauge_unit(d.by.as_ref().unwrap_or(&d.of)));
        json!({
            "name": d.name, "level": level(d.level), "ideal": !d.feedback && d.by.is_none(),
            "engaged": start.has(Part::Drive(i)), "readings": readings,
        })
    };
    motions.map(entry).collect()
}

/// What events lock: the second body on which each lock acts, the first being that which takes the opposite or ground.
fn locks(m: &Mechanism) -> Vec<Value> {
    let entry = |d: &Drive| {
        let joint = d.of.variables().find_map(|variable| match variable {
            ModelVariable::Coordinate(joint, _) if d.of == ModelExpr::variable(variable.clone()) => Some(*joint),
            _ => None,
        });
        let bodies = m.bodies_of(&d.of);
        let body = |i: usize| bodies.get(i).copied().unwrap_or(0);
        let [first, second] = joint.map_or_else(|| [body(1), body(0)], |joint| m.listed_ends(joint));
        let [first, second] = [first, second].map(|body| &m.bodies[body].name);
        let readings = units(MOTION, m.gauge_unit(&d.of));
        json!({"name": d.name, "first": first, "second": second, "turns": m.turns(&d.of), "readings": readings})
    };
    m.drives.iter().filter(|d| d.kind == DriveKind::Lock).map(entry).collect()
}

/// Grübler's count at the start.
fn count(m: &Mechanism, start: &Mode) -> Value {
    let Count { bodies, rows, driven } = Count::of(m, start);
    json!({"count": bodies as i64 - rows as i64, "bodies": bodies, "rows": rows, "driven": driven})
}

/// What is modelled, ignored and assumed.
fn notes(m: &Mechanism, n: &BoundValues) -> Vec<String> {
    let mut notes = m.notes.clone();
    let massless: Vec<_> = m
        .listed_bodies()
        .into_iter()
        .filter(|&i| n.mass[i] == 0.0)
        .map(|i| format!("`{}`", m.bodies[i].name))
        .collect();
    if !massless.is_empty() {
        notes.push(format!("Without mass: {}.", massless.join(", ")));
    }
    match n.gravity.norm() {
        0.0 => notes.push("No gravity acts in the plane.".to_string()),
        _ => notes.push(format!("Gravity is ({}, {}) m/s².", n.gravity.x, n.gravity.y)),
    }
    let joints = (0..m.joint_friction.len())
        .filter(|&friction| matches!(m.joint_friction[friction].of, FrictionSource::Joint { .. }));
    let rubbing: Vec<_> = joints.map(|friction| format!("`{}`", Source::JointFriction(friction).name(m))).collect();
    notes.push(match rubbing.is_empty() {
        true => "Bodies are rigid; joints have no friction and no clearance.".to_string(),
        false => format!("Bodies are rigid; joints have no clearance, and no friction but {}.", rubbing.join(", ")),
    });
    notes.push(match m.groups.is_empty() {
        true => "Bodies that no joint joins pass through each other: there are no contacts.".to_string(),
        false => "Only what a contact, stop or string names can touch or hold; all else passes through.".to_string(),
    });
    let named =
        |joints: &[usize]| joints.iter().map(|&j| format!("`{}`", m.joints[j].name)).collect::<Vec<_>>().join(", ");
    let (loops, rates): (Vec<_>, Vec<_>) = m.closures.iter().partition(|&&j| m.joints[j].is_holonomic());
    if !loops.is_empty() {
        let names = named(&loops);
        notes.push(format!("Loops are closed at {names}; the motion is carried by the other joints' coordinates."));
    }
    if !rates.is_empty() {
        notes.push(format!("Rates only are constrained at {}: every place can still be reached.", named(&rates)));
    }
    notes
}

/// Named points in their bodies' frames, origins and mass centres among them: name → [body, x, y].
pub fn places(m: &Mechanism, n: &BoundValues) -> Value {
    let mut all = Map::new();
    for (name, site) in &m.points {
        let body = m.body_of(*site);
        let origin = m.sites.iter().position(|s| s.body == body).expect("every body has its origin as a site");
        let at = n.arms[*site] - n.arms[origin];
        all.insert(name.clone(), json!([m.bodies[body].name, at.x, at.y]));
    }
    Value::Object(all)
}
