//! Loads of contacts, stops and strings, and of friction in joints.

use super::reactions::loaded;
use super::{along_gauge, ground_takes, joint_place, part, Load, Origin, Part, Size};
use crate::dynamics::{compliant_force, gap_row, joint_friction_row, slide_row, Row, Source};
use crate::expr::spell;
use crate::joints::{Joint as _, LoadCard};
use crate::kinematics::{Poses, StateView};
use crate::mechanism::{Friction, FrictionSource, Gap, FRICTION};
use crate::mode::ContactMode;
use crate::scalar::Scalar;

/// The loads of every unilateral constraint that is closed or pressed.
pub fn contacts<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    for of in &at.m.groups {
        let acts: Vec<usize> = of.constraints.clone().filter(|&l| acts(at, l)).collect();
        for (k, &constraint) in acts.iter().enumerate() {
            let number = (acts.len() > 1).then_some(k + 1);
            let load = |origin, card: LoadCard, parts, size| {
                let which = number.map_or(String::new(), |k| k.to_string());
                let symbol = format!("{}.{}{which}", spell(&of.name), card.reading);
                Load { origin, symbol, card, number, of: of.ends, parts, size }
            };
            push_contact(at, constraint, &load, out);
        }
    }
}

fn acts<S: Scalar>(at: StateView<'_, S>, constraint: usize) -> bool {
    let mode = at.mode.contacts[constraint].mode;
    mode.carries() || mode == ContactMode::Compliant
}

fn push_contact<S: Scalar>(
    at: StateView<'_, S>,
    constraint: usize,
    load: &dyn Fn(Origin, LoadCard, Vec<Part<S>>, Size<S>) -> Load<S>,
    out: &mut Vec<Load<S>>,
) {
    let mode = at.mode.contacts[constraint].mode;
    let card = at.m.unilateral[constraint].gap.card(at.m);
    let normal = Row { force: None, ..gap_row(at, constraint, None) };
    let parts = parts_of_row(at, constraint, &normal);
    if mode == ContactMode::Compliant {
        let force = compliant_force(at, constraint);
        let acting =
            parts.into_iter().map(|p| Part { force: p.force * force, couple: p.couple * force, ..p }).collect();
        out.push(load(Origin::Compliant(constraint), card, acting, Size::Known));
        if let Some((origin, size)) =
            at.m.joint_friction_of(constraint).and_then(|friction| friction_load(at, friction))
        {
            let slide = slide_row(at, constraint, None).expect("what rubs slides");
            out.push(load(origin, FRICTION, parts_of_row(at, constraint, &slide), size));
        }
        return;
    }
    let pressing = out.len();
    out.push(load(Origin::Row(Source::Gap(constraint)), card, parts, Size::Unknown));
    let Some(slide) = slide_row(at, constraint, None) else { return };
    let along = parts_of_row(at, constraint, &slide);
    match (mode, at.m.unilateral[constraint].friction) {
        (ContactMode::Stick, _) => {
            out.push(load(Origin::Row(Source::Friction(constraint)), FRICTION, along, Size::Unknown));
        }
        (ContactMode::Slip(sense), Some(Friction::Coulomb { kinetic, .. })) => {
            let ratio = -at.n.values[kinetic].scale(sense);
            out.push(load(Origin::Sliding(constraint), FRICTION, along, Size::Follows(pressing, ratio)));
        }
        (ContactMode::PartialFriction(part), _) => {
            out.push(load(Origin::Sliding(constraint), FRICTION, along, Size::Follows(pressing, S::of(part))));
        }
        _ => {}
    }
}

/// The loads of a row of a unilateral constraint, each where it acts.
fn parts_of_row<S: Scalar>(at: StateView<'_, S>, constraint: usize, row: &Row<S>) -> Vec<Part<S>> {
    match &at.m.unilateral[constraint].gap {
        Gap::Gauge(law) => along_gauge(at, law, row.loads()),
        Gap::ContactPair(touch) => {
            let place = touch.contact(at.m, &at, at.mode.contacts[constraint].feature.index).point;
            loaded(at, row, place)
        }
        Gap::Cable(cable) => {
            let place = |body: usize| {
                let site = cable.sites().find(|&site| at.m.body_of(site) == body);
                site.map_or(at.mass_centre(body), |site| at.pose(body).place(at.arm(site)))
            };
            let mut parts: Vec<Part<S>> = row.loads().iter().map(|&(b, w)| part(at, b, w, place(b))).collect();
            if cable.sites().any(|site| at.m.body_of(site) == 0) {
                ground_takes(&mut parts, place(0));
            }
            parts
        }
    }
}

/// Whence friction comes and how much is known of it, where there is any.
fn friction_load<S: Scalar>(at: StateView<'_, S>, friction: usize) -> Option<(Origin, Size<S>)> {
    match at.mode.joint_friction[friction] {
        ContactMode::Stick => Some((Origin::Row(Source::JointFriction(friction)), Size::Unknown)),
        ContactMode::Slip(_) => Some((Origin::JointFriction(friction), Size::ByLaw)),
        _ => None,
    }
}

/// Friction of every joint with friction.
pub fn joint_friction<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, friction) in at.m.joint_friction.iter().enumerate() {
        let (FrictionSource::Joint { joint: of, .. }, Some((origin, size))) = (friction.of, friction_load(at, index))
        else {
            continue;
        };
        if !at.mode.has(at.m.part_of(of)) {
            continue;
        }
        let joint = &at.m.joints[of];
        let parts = loaded(at, &joint_friction_row(at, index, None), joint_place(at, of));
        let bearing = joint.kind.card().coordinates.first().is_some_and(|c| c.turn);
        let card = LoadCard::force("friction", "friction", "F").along(bearing);
        let symbol = format!("{}.{}", spell(&joint.name), card.reading);
        out.push(Load { origin, symbol, card, number: None, of: at.m.ends(joint), parts, size });
    }
}
