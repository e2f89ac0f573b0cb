//! Loads of contacts, stops and strings, and of friction in joints.

use super::reactions::loaded;
use super::{along_gauge, ground_takes, joint_place, mass_centre, part, Load, Origin, Part, Size};
use crate::balance::{gap_row, rub_row, slide_row, Row, Source};
use crate::expr::spell;
use crate::kinematics::{Placed, Poses};
use crate::mechanism::{Friction, Gap, Rubbing};
use crate::mode::Hold;
use crate::scalar::Scalar;

/// The loads of every limit that is closed or pressed.
pub fn limits<S: Scalar>(at: Placed<'_, S>, out: &mut Vec<Load<S>>) {
    for (group, of) in at.m.groups.iter().enumerate() {
        let acts: Vec<usize> = of.limits.clone().filter(|&l| acts(at, l)).collect();
        for (k, &limit) in acts.iter().enumerate() {
            let number = if acts.len() > 1 { (k + 1).to_string() } else { String::new() };
            let name = |word: &str| format!("{}.{word}{number}", spell(&of.name));
            push_limit(at, limit, at.m.groups[group].ends, &name, out);
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
    of: [usize; 2],
    name: &dyn Fn(&str) -> String,
    out: &mut Vec<Load<S>>,
) {
    let word = if matches!(at.m.limits[limit].gap, Gap::Touch(_)) { "N" } else { "tension" };
    let hold = at.mode.limits[limit].hold;
    let normal = Row { force: None, ..gap_row(at, limit, None) };
    let parts = told(at, limit, &normal);
    let load = |origin, symbol, parts, size| Load { origin, symbol, of, parts, size };
    if hold == Hold::Pressed {
        out.push(load(Origin::Pressed(limit), name(word), parts, Size::ByLaw));
        if let Some((origin, size)) = at.m.rub_of(limit).and_then(|rub| rubbing(at, rub)) {
            let slide = slide_row(at, limit, None).expect("what rubs slides");
            out.push(load(origin, name("T"), told(at, limit, &slide), size));
        }
        return;
    }
    let pressing = out.len();
    out.push(load(Origin::Row(Source::Limit(limit)), name(word), parts, Size::Unknown));
    let Some(slide) = slide_row(at, limit, None) else { return };
    let along = told(at, limit, &slide);
    match (hold, at.m.limits[limit].friction) {
        (Hold::Stuck, _) => {
            out.push(load(Origin::Row(Source::Friction(limit)), name("T"), along, Size::Unknown));
        }
        (Hold::Sliding(sense), Some(Friction::Coulomb { kinetic, .. })) => {
            let ratio = -at.n.slots[kinetic].scale(sense);
            out.push(load(Origin::Sliding(limit), name("T"), along, Size::Follows(pressing, ratio)));
        }
        (Hold::Leaning(part), _) => {
            out.push(load(Origin::Sliding(limit), name("T"), along, Size::Follows(pressing, S::of(part))));
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
                site.map_or(mass_centre(at, body), |site| at.pose(body).place(at.arm(site)))
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
        out.push(Load {
            origin,
            symbol: format!("{}.friction", spell(&joint.name)),
            of: at.m.ends(joint),
            parts,
            size,
        });
    }
}
