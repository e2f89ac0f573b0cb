//! Loads of contacts, stops and strings, and of friction in joints.

use super::reactions::loaded;
use super::{along_gauge, ground_takes, joint_place, part, Load, Origin, Part, Size};
use crate::balance::{gap_row, rub_row, slide_row, Row, Source};
use crate::expr::spell;
use crate::joints::{Joint as _, LoadCard};
use crate::kinematics::{Placed, Poses};
use crate::mechanism::{Friction, Gap, Rubbing, FRICTION};
use crate::mode::Hold;
use crate::scalar::Scalar;

/// The loads of every limit that is closed or pressed.
pub fn limits<S: Scalar>(at: Placed<'_, S>, out: &mut Vec<Load<S>>) {
    for of in &at.m.groups {
        let acts: Vec<usize> = of.limits.clone().filter(|&l| acts(at, l)).collect();
        for (k, &limit) in acts.iter().enumerate() {
            let number = (acts.len() > 1).then_some(k + 1);
            let load = |origin, card: LoadCard, parts, size| {
                let which = number.map_or(String::new(), |k| k.to_string());
                let symbol = format!("{}.{}{which}", spell(&of.name), card.reading);
                Load { origin, symbol, card, number, of: of.ends, parts, size }
            };
            push_limit(at, limit, &load, out);
        }
    }
}

fn acts<S: Scalar>(at: Placed<'_, S>, limit: usize) -> bool {
    let hold = at.mode.limits[limit].hold;
    hold.carries() || hold == Hold::Pressed
}

fn push_limit<S: Scalar>(
    at: Placed<'_, S>,
    limit: usize,
    load: &dyn Fn(Origin, LoadCard, Vec<Part<S>>, Size<S>) -> Load<S>,
    out: &mut Vec<Load<S>>,
) {
    let hold = at.mode.limits[limit].hold;
    let card = at.m.limits[limit].gap.card(at.m);
    let normal = Row { force: None, ..gap_row(at, limit, None) };
    let parts = told(at, limit, &normal);
    if hold == Hold::Pressed {
        out.push(load(Origin::Pressed(limit), card, parts, Size::ByLaw));
        if let Some((origin, size)) = at.m.rub_of(limit).and_then(|rub| rubbing(at, rub)) {
            let slide = slide_row(at, limit, None).expect("what rubs slides");
            out.push(load(origin, FRICTION, told(at, limit, &slide), size));
        }
        return;
    }
    let pressing = out.len();
    out.push(load(Origin::Row(Source::Limit(limit)), card, parts, Size::Unknown));
    let Some(slide) = slide_row(at, limit, None) else { return };
    let along = told(at, limit, &slide);
    match (hold, at.m.limits[limit].friction) {
        (Hold::Stuck, _) => {
            out.push(load(Origin::Row(Source::Friction(limit)), FRICTION, along, Size::Unknown));
        }
        (Hold::Sliding(sense), Some(Friction::Coulomb { kinetic, .. })) => {
            let ratio = -at.n.slots[kinetic].scale(sense);
            out.push(load(Origin::Sliding(limit), FRICTION, along, Size::Follows(pressing, ratio)));
        }
        (Hold::Leaning(part), _) => {
            out.push(load(Origin::Sliding(limit), FRICTION, along, Size::Follows(pressing, S::of(part))));
        }
        _ => {}
    }
}

/// The loads of a row of a limit, each where it acts.
fn told<S: Scalar>(at: Placed<'_, S>, limit: usize, row: &Row<S>) -> Vec<Part<S>> {
    match &at.m.limits[limit].gap {
        Gap::Gauge(law) => along_gauge(at, law, row.loads()),
        Gap::Touch(touch) => {
            let place = touch.contact(at.m, &at, at.mode.limits[limit].piece.index).point;
            loaded(at, row, place)
        }
        Gap::Cord(cord) => {
            let place = |body: usize| {
                let site = cord.sites().find(|&site| at.m.body_of(site) == body);
                site.map_or(at.mass_centre(body), |site| at.pose(body).place(at.arm(site)))
            };
            let mut parts: Vec<Part<S>> = row.loads().iter().map(|&(b, w)| part(at, b, w, place(b))).collect();
            if cord.sites().any(|site| at.m.body_of(site) == 0) {
                ground_takes(&mut parts, place(0));
            }
            parts
        }
    }
}

/// Whence friction comes and how much is known of it, where there is any.
fn rubbing<S: Scalar>(at: Placed<'_, S>, rub: usize) -> Option<(Origin, Size<S>)> {
    match at.mode.rubs[rub] {
        Hold::Stuck => Some((Origin::Row(Source::Rub(rub)), Size::Unknown)),
        Hold::Sliding(_) => Some((Origin::Rubbing(rub), Size::ByLaw)),
        _ => None,
    }
}

/// Friction of every joint that rubs.
pub fn rubs<S: Scalar>(at: Placed<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, rub) in at.m.rubs.iter().enumerate() {
        let (Rubbing::Joint { joint: carrier, .. }, Some((origin, size))) = (rub.of, rubbing(at, index)) else {
            continue;
        };
        let joint = &at.m.joints[carrier];
        let parts = loaded(at, &rub_row(at, index, None), joint_place(at, carrier));
        let bearing = joint.kind.card().coordinates.first().is_some_and(|c| c.turn);
        let card = LoadCard::force("friction", "friction", "F").along(bearing);
        let symbol = format!("{}.{}", spell(&joint.name), card.reading);
        out.push(Load { origin, symbol, card, number: None, of: at.m.ends(joint), parts, size });
    }
}
