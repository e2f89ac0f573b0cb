//! Unknown loads of joints, motions and couplings.

use super::{along_gauge, joint_place, part, Load, Origin, Part, Size};
use crate::balance::{curve_row, drive_row, joint_rows, Row, Source};
use crate::expr::spell;
use crate::joints::{Joint as _, Kind};
use crate::kinematics::{Placed, Poses};
use crate::mechanism::{Joint, Part as Piece};
use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

/// The components of the reaction of every joint in place, on its second body.
pub fn joints<S: Scalar>(at: Placed<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, joint) in at.m.joints.iter().enumerate() {
        if joint.rows.is_empty() || !at.mode.has(Piece::Joint(index)) {
            continue;
        }
        let (of, mut rows) = (at.m.ends(joint), vec![]);
        let place = match joint.curve {
            Some(_) => {
                let (row, touch) = curve_row(at, index);
                rows.push(row);
                touch
            }
            None => {
                joint_rows(at, index, None, &mut rows);
                joint_place(at, index)
            }
        };
        let card = joint.kind.card();
        for row in &rows {
            let Source::Joint(_, r) = row.source else { continue };
            let (origin, parts) = match card.rows[r].pin {
                Some(axis) => (Origin::Pin(index, axis), pinned(at, joint, axis)),
                None => (Origin::Row(row.source), loaded(at, row, place)),
            };
            let symbol = format!("{}.{}", spell(&joint.name), word(joint.kind, r));
            let turned = if joint.kind == Kind::Link { -S::one() } else { S::one() };
            let parts = parts.into_iter().map(|p| Part { force: p.force * turned, couple: p.couple * turned, ..p });
            out.push(Load { origin, symbol, of, parts: parts.collect(), size: Size::Unknown });
        }
    }
}

/// What an expression of the model calls the multiplier of a row of a joint; a link's is its tension.
fn word(kind: Kind, row: usize) -> String {
    let card = kind.card();
    let row_card = &card.rows[row];
    match (row_card.pin, row_card.name) {
        (Some(0), _) => "Fx".into(),
        (Some(_), _) => "Fy".into(),
        (None, "couple") => "M".into(),
        (None, "thrust") => "tension".into(),
        (None, "normal force") if matches!(kind, Kind::Slot | Kind::Slider | Kind::Rolling) => "Fn".into(),
        (None, "friction force") if kind == Kind::Rolling => "Fs".into(),
        _ => format!("F{}", row + 1),
    }
}

/// A unit force of a pin along a fixed axis; each body feels it where it has the pin.
fn pinned<S: Scalar>(at: Placed<'_, S>, joint: &Joint, axis: usize) -> Vec<Part<S>> {
    let (zero, one) = (S::zero(), S::one());
    let force = if axis == 0 { vec2(one, zero) } else { vec2(zero, one) };
    let on = |site: usize, force| {
        let body = at.m.body_of(site);
        Part { body, point: at.pose(body).place(at.arm(site)), force, couple: zero }
    };
    vec![on(joint.first.site, -force), on(joint.second.site, force)]
}

/// The loads of a unit multiplier of a row between two bodies, both at one place.
pub(super) fn loaded<S: Scalar>(at: Placed<'_, S>, row: &Row<S>, place: Vec2<S>) -> Vec<Part<S>> {
    let mut parts: Vec<Part<S>> = row.loads().iter().map(|&(body, w)| part(at, body, w, place)).collect();
    if parts.len() == 1 {
        super::ground_takes(&mut parts, place);
    }
    parts
}

/// What drives every motion and what every coupling passes.
pub fn drives<S: Scalar>(at: Placed<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, drive) in at.m.drives.iter().enumerate().filter(|(d, _)| at.mode.has(Piece::Drive(*d))) {
        let row = drive_row(at, index, None);
        let parts = along_gauge(at, drive.by.as_ref().unwrap_or(&drive.of), row.loads());
        let first = if parts.len() > 1 { parts[1].body } else { 0 };
        let of = [first, parts.first().map_or(0, |p| p.body)];
        let symbol = format!("{}.force", spell(&drive.name));
        out.push(Load { origin: Origin::Row(row.source), symbol, of, parts, size: Size::Unknown });
    }
}
