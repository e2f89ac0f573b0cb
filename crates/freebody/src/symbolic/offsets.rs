//! Where events engaged joints: the zeros of their rows, each a variable with its number.

use super::{unused_name, Named};
use crate::algebra::Symbol;
use crate::dynamics::{Workspace, OPEN};
use crate::joints::Joint as _;
use crate::mechanism::Part;
use crate::scalar::Scalar;
use std::collections::HashMap;

/// Gives variables to the zeros of the rows of joints that an event engaged apart from where they close; adds which to `entries`.
pub(super) fn name_offsets(
    workspace: &Workspace<'_>,
    named: &dyn Fn(&str, u8, f64) -> Symbol,
    entries: &mut Vec<Named>,
) -> HashMap<(usize, usize), Symbol> {
    let (m, at) = (workspace.m, workspace.at());
    let taken: Vec<&str> = m
        .parameters
        .iter()
        .map(|p| p.name.as_str())
        .chain((0..m.freedom()).map(|i| m.coordinate(i).name.as_str()))
        .collect();
    let mut found = HashMap::new();
    for &index in m.closures.iter().filter(|&&joint| at.mode.has(Part::Joint(joint))) {
        let (joint, card) = (&m.joints[index], m.joints[index].kind.card());
        let lengths = joint.rows.iter().filter(|&&r| !card.rows[r].load.couple).count();
        for &r in &joint.rows {
            let (value, row) = (at.engaged_at(index, r), &card.rows[r]);
            let turns = row.load.couple;
            if value.abs() <= OPEN * if turns { 1.0 } else { workspace.length } {
                found.insert((index, r), Symbol::zero());
                continue;
            }
            let below = match row.pin {
                Some(axis) => ["_x", "_y"][axis].to_string(),
                None if lengths > 1 && !turns => format!("_{}", r + 1),
                None => String::new(),
            };
            let stem = if turns { "delta" } else { "d" };
            let names = [stem, "offset"].map(|stem| format!("{stem}_{}{below}", joint.name));
            let variable = unused_name(taken.iter().copied(), &names);
            let on = &m.bodies[m.body_of(joint.first.site)].name;
            let doc = match row.pin {
                Some(axis) => format!("where {} took hold, along {} of {on}", joint.name, ["x", "y"][axis]),
                None => format!("by how much {} was off where it took hold", joint.name),
            };
            found.insert((index, r), named(&variable, 0, value));
            entries.push(Named { variable, value, unit: if turns { "rad" } else { "m" }, names, doc });
        }
    }
    found
}
