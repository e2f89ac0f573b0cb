//! Which bodies a joint joins, and which joints make the tree.

use crate::builder::{unknown, Builder, Result};
use crate::error::CompileError;
use crate::graph::{spanning_tree, Branch, Edge};
use crate::joints::{Card, FieldKind, Joint as _, Kind, Role};
use crate::mechanism::Body;
use crate::shapes::{Shape, SHAPES};
use crate::spec::{Body as BodySpec, Element, MassElement, Spec, Value};
use std::collections::HashMap;

/// A joint of the model, as one pair of bodies.
pub(crate) struct Pair {
    /// The joint as written, its points cut down to this pair.
    pub element: Element,
    /// Its path in the model.
    pub path: String,
    /// What it is.
    pub kind: Kind,
    /// Names of the two bodies.
    pub ends: [String; 2],
    /// Whether it is there all the time.
    pub stays: bool,
}

/// All joints but couplings, pins shared by several bodies as one pair each.
pub(crate) fn joints_of(spec: &Spec) -> Result<Vec<Pair>> {
    let bodies: HashMap<&str, &str> = spec.points.iter().map(|p| (p.name.as_str(), p.body.as_str())).collect();
    let mut pairs = vec![];
    for element in spec.joints.iter().filter(|e| e.kind != "coupling") {
        let path = format!("joints.{}", element.name);
        let kind = Kind::named(&element.kind).ok_or_else(|| no_such_joint(&path, &element.kind))?;
        let card = kind.card();
        let stays = super::events::stays(spec, element);
        for element in separate(element, &card, &bodies) {
            let ends = [end(spec, &bodies, &element, &card, 0, &path)?, end(spec, &bodies, &element, &card, 1, &path)?];
            if ends[0] == ends[1] {
                let what = format!("both sides of this joint are on `{}`", ends[0]);
                return Err(CompileError::new(path, what, "a joint needs two different bodies"));
            }
            pairs.push(Pair { element, path: path.clone(), kind, ends, stays });
        }
    }
    Ok(pairs)
}

fn no_such_joint(path: &str, word: &str) -> CompileError {
    let words: Vec<String> =
        Kind::ALL.iter().map(|k| k.card().word.to_string()).chain(["coupling".to_string()]).collect();
    CompileError::from(format!("{path}.type"), unknown("type of joint", word, words.iter()))
}

/// A pin shared by several bodies is a hinge of each with the first, named after the other body as its part calls it.
fn separate(element: &Element, card: &Card, bodies: &HashMap<&str, &str>) -> Vec<Element> {
    let field = card.fields.iter().find(|f| f.role == Role::Both).map(|f| f.name);
    let points = match field.and_then(|f| element.fields.get(f)) {
        Some(Value::List(points)) if points.len() > 2 => points.clone(),
        _ => return vec![element.clone()],
    };
    let part = element.name.rfind('.').map_or("", |dot| &element.name[..=dot]);
    let one = |(i, other): (usize, &Value)| {
        let mut pair = element.clone();
        let body = other.text().and_then(|name| bodies.get(name).copied()).unwrap_or("?");
        pair.name = format!("{}.{}", element.name, body.strip_prefix(part).unwrap_or(body));
        pair.fields.insert(field.unwrap_or("of").to_string(), Value::List(vec![points[0].clone(), other.clone()]));
        pair.coordinates = element.coordinates.get(i).cloned().into_iter().collect();
        pair
    };
    points[1..].iter().enumerate().map(one).collect()
}

/// The name of the body on one side of a joint.
fn end(
    spec: &Spec,
    bodies: &HashMap<&str, &str>,
    element: &Element,
    card: &Card,
    side: usize,
    path: &str,
) -> Result<String> {
    let role = [Role::First, Role::Second][side];
    let field = card.fields.iter().find(|f| f.role == role || f.role == Role::Both).expect("a joint has two sides");
    let path = format!("{path}.{}", field.name);
    let missing = || CompileError::new(&path, format!("`{}` is missing", field.name), field.doc);
    let value = element.fields.get(field.name).ok_or_else(missing)?;
    let name = match value {
        Value::List(points) => {
            let i = if field.role == Role::Both { side } else { 0 };
            points.get(i).and_then(Value::text)
        }
        Value::Line(place) => Some(place.point.as_str()),
        Value::Circle { centre, .. } => Some(centre.as_str()),
        other => other.text(),
    };
    let name = name.ok_or_else(missing)?;
    if field.kind == FieldKind::Curve {
        if let Some(curve) = spec.curves.iter().find(|c| c.name == name) {
            return Ok(curve.body.clone());
        }
        let known: Vec<String> = spec.curves.iter().map(|c| c.name.clone()).collect();
        return Err(CompileError::from(path, unknown("curve", name, known.iter())));
    }
    if let Some(body) = bodies.get(name) {
        return Ok(body.to_string());
    }
    if let Some((body, part)) = name.rsplit_once('.') {
        let there = body == "ground" || spec.bodies.iter().any(|b| b.name == body);
        if there && (part == "G" || part == "origin" || (body == "ground" && part == "O")) {
            return Ok(body.to_string());
        }
    }
    let known: Vec<String> = spec.points.iter().map(|p| p.name.clone()).collect();
    Err(CompileError::from(path, unknown("point", name, known.iter())))
}

/// Rank of a joint that would hang a body on a particle and pass it a couple: taken last, and then refused.
const THROUGH_PARTICLE: u32 = 100;

/// How much a joint between bodies, of which some are particles, is wanted in the tree; None when it can only close
/// loops.
fn rank(pair: &Pair, particle: [bool; 2]) -> [Option<u32>; 2] {
    let card = pair.kind.card();
    if card.coordinates.len() + card.rows.len() != 3 || !pair.stays {
        return [None, None];
    }
    let on_curve = card.fields.iter().any(|f| f.kind == FieldKind::Curve);
    let named = !pair.element.coordinates.is_empty();
    let forward = match (on_curve, named, card.rows.is_empty()) {
        (true, _, _) => 0,
        (_, true, _) => 1,
        (_, _, true) => 8,
        // One that frees less is nearer to the coordinates of a book: a hinge before a slot.
        _ => 1 + card.coordinates.len().max(1) as u32,
    };
    let absolute = pair.element.coordinates.iter().any(|c| c.absolute);
    let turns = card.coordinates.iter().any(|c| c.turn);
    let passes_couple = |parent: usize| particle[parent] && !particle[1 - parent] && !turns;
    let last = |parent| if passes_couple(parent) { THROUGH_PARTICLE } else { 0 };
    [Some(forward + last(0)), Some(forward + last(1) + if absolute { 4 } else { 0 })]
}

impl Builder<'_> {
    /// Numbers the bodies, parents first, and says by which pair each hangs; a body that nothing joins
    /// is free from the origin of ground, which is a pair beyond the last.
    pub(crate) fn bodies(&mut self, pairs: &[Pair]) -> Result<Vec<Branch>> {
        let mut index: HashMap<&str, usize> = HashMap::from([("ground", 0)]);
        for (i, body) in self.spec.bodies.iter().enumerate() {
            if index.insert(&body.name, i + 1).is_some() {
                return Err(super::twice(format!("bodies.{}", body.name), &body.name));
            }
        }
        let particle = |node: usize| node > 0 && self.spec.bodies[node - 1].particle;
        let mut edges = vec![];
        for pair in pairs {
            let side = |s: usize| {
                let known = self.spec.bodies.iter().map(|b| &b.name);
                let missing = || CompileError::from(&pair.path, unknown("body", &pair.ends[s], known));
                index.get(pair.ends[s].as_str()).copied().ok_or_else(missing)
            };
            let ends = [side(0)?, side(1)?];
            edges.push(Edge { ends, rank: rank(pair, ends.map(particle)) });
        }
        let mut extra = pairs.len();
        // Particles last: a body can carry a particle, and not the other way round.
        let mut orphans: Vec<usize> = (1..=self.spec.bodies.len()).collect();
        orphans.sort_by_key(|&node| particle(node));
        let mut branches = spanning_tree(&orphans, &edges, |_| {
            extra += 1;
            extra - 1
        });
        self.number_bodies(&mut branches)?;
        Ok(branches)
    }

    fn number_bodies(&mut self, branches: &mut [Branch]) -> Result<()> {
        let mut place = vec![0; self.spec.bodies.len() + 1];
        for (i, branch) in branches.iter().enumerate() {
            place[branch.child] = i + 1;
        }
        self.m.bodies = vec![ground()];
        self.names.bodies.insert("ground".to_string(), 0);
        for branch in branches.iter_mut() {
            let listed = branch.child - 1;
            let body = self.body(listed)?;
            self.names.bodies.insert(body.name.clone(), self.m.bodies.len());
            self.m.bodies.push(body);
            (branch.parent, branch.child) = (place[branch.parent], place[branch.child]);
        }
        Ok(())
    }

    fn body(&mut self, listed: usize) -> Result<Body> {
        let spec: &BodySpec = &self.spec.bodies[listed];
        let path = format!("bodies.{}", spec.name);
        if spec.name == "ground" {
            return Err(CompileError::new(path, "`ground` is always there", "give the body another name"));
        }
        let pieces = spec.pieces.iter().map(|p| self.piece(&path, p)).collect::<Result<Vec<_>>>()?;
        Ok(Body {
            name: spec.name.clone(),
            listed: Some(listed),
            particle: spec.particle,
            mass_elements: pieces,
            tree_joint: None,
            joint_origin: 0,
        })
    }

    fn piece(&mut self, path: &str, spec: &MassElement) -> Result<crate::mechanism::MassElement> {
        let Some((_, shape, words)) = SHAPES.iter().find(|(word, ..)| *word == spec.shape) else {
            let words: Vec<String> = SHAPES.iter().map(|s| s.0.to_string()).collect();
            return Err(CompileError::from(format!("{path}.shape"), unknown("shape", &spec.shape, words.iter())));
        };
        let mut sizes = vec![];
        for word in *words {
            let missing = || CompileError::new(path, format!("a {} needs its `{word}`", spec.shape), "");
            let number = spec.sizes.get(*word).ok_or_else(missing)?;
            sizes.push(self.length_value(&format!("{path}.{word}"), number)?);
        }
        if *shape == Shape::Polygon && spec.corners.len() < 3 {
            return Err(CompileError::new(format!("{path}.corners"), "a polygon has three corners or more", ""));
        }
        for corner in &spec.corners {
            for number in corner {
                sizes.push(self.length_value(&format!("{path}.corners"), number)?);
            }
        }
        let inertia = match &spec.inertia {
            Some(number) => Some(self.number_value(&format!("{path}.inertia"), number)?),
            None => None,
        };
        Ok(crate::mechanism::MassElement {
            shape: *shape,
            mass: self.number_value(&format!("{path}.mass"), &spec.mass)?,
            at: [
                self.number_value(&format!("{path}.at"), &spec.at[0])?,
                self.number_value(&format!("{path}.at"), &spec.at[1])?,
            ],
            angle: self.number_value(&format!("{path}.angle"), &spec.angle)?,
            inertia,
            sizes,
        })
    }
}

fn ground() -> Body {
    Body {
        name: "ground".to_string(),
        listed: None,
        particle: false,
        mass_elements: vec![],
        tree_joint: None,
        joint_origin: 0,
    }
}
