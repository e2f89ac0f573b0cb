//! Unknown loads of joints, motions and couplings.

use super::{along_gauge, part, Load, Origin, Part, Size};
use crate::dynamics::{constraint_rows, drive_row, Row, Source};
use crate::expr::spell;
use crate::joints::{Joint as _, LoadCard};
use crate::kinematics::{Poses, StateView};
use crate::mechanism::{DriveKind, Joint};
use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

/// The components of the reaction of every joint in place, on its second body.
pub fn joints<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    let shown = |&(index, joint): &(usize, &Joint)| {
        !joint.rows.is_empty() && at.m.carried(index).is_none() && at.mode.has(at.m.part_of(index))
    };
    for (index, joint) in at.joints().filter(shown) {
        let (of, mut rows) = (at.m.ends(joint), vec![]);
        let place = constraint_rows(at, index, &mut rows);
        let card = joint.kind.card();
        for row in &rows {
            let Source::Joint(_, r) = row.source else { continue };
            let of_row = &card.rows[r];
            let (origin, parts) = match of_row.pin {
                Some(axis) => (Origin::Pin(index, axis), pinned(at, index, axis)),
                None => (Origin::Row(row.source), loaded(at, row, place)),
            };
            let sign = S::of(of_row.sign());
            let parts = parts.into_iter().map(|p| Part { force: p.force * sign, couple: p.couple * sign, ..p });
            let alike = card.rows.iter().filter(|other| other.load.stem == of_row.load.stem).count();
            out.push(Load {
                origin,
                symbol: format!("{}.{}", spell(&joint.name), of_row.load.reading),
                card: of_row.load,
                number: (alike > 1 && of_row.pin.is_none()).then_some(r + 1),
                of,
                parts: parts.collect(),
                size: Size::Unknown,
            });
        }
    }
}

/// A unit force of a pin along a fixed axis; each body feels it where it has the pin.
fn pinned<S: Scalar>(at: StateView<'_, S>, index: usize, axis: usize) -> Vec<Part<S>> {
    let (joint, zero, one) = (&at.m.joints[index], S::zero(), S::one());
    let force = if axis == 0 { vec2(one, zero) } else { vec2(zero, one) };
    let on = |site: usize, shift: Vec2<S>, force| {
        let body = at.m.body_of(site);
        Part { body, point: at.pose(body).place(at.arm(site)) + shift, force, couple: zero }
    };
    vec![on(joint.first.site, at.pin_shift(index), -force), on(joint.second.site, Vec2::zero(), force)]
}

/// The loads of a unit multiplier of a row between two bodies, both at one place.
pub(super) fn loaded<S: Scalar>(at: StateView<'_, S>, row: &Row<S>, place: Vec2<S>) -> Vec<Part<S>> {
    let mut parts: Vec<Part<S>> = row.loads().iter().map(|&(body, w)| part(at, body, w, place)).collect();
    if parts.len() == 1 {
        super::ground_takes(&mut parts, place);
    }
    parts
}

/// What drives every motion and what every coupling passes.
pub fn drives<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, drive) in at.drives().filter(|(_, drive)| drive.kind != DriveKind::Hold) {
        let row = drive_row(at, index, None);
        let parts = along_gauge(at, drive.along(), row.loads());
        let first = if parts.len() > 1 { parts[1].body } else { 0 };
        let of = [first, parts.first().map_or(0, |p| p.body)];
        let card = LoadCard::force("force", "force", "F").along(at.m.turns(drive.along()));
        let (origin, symbol) = (Origin::Row(row.source), format!("{}.{}", spell(&drive.name), card.reading));
        out.push(Load { origin, symbol, card, number: None, of, parts, size: Size::Unknown });
    }
}
