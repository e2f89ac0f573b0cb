//! Which contacts carry, by relaxation: the forces of one contact after the other are brought to what its law asks for.

use super::form::drag;
use super::lcp_block::{BlockFriction, LcpBlock};
use super::modes::{Mode, Tangent};
use super::FrictionLaw;

/// How many sweeps are made, one lot after the other, before the modes that the forces have then are tried.
const SWEEPS: [usize; 4] = [50, 200, 800, 3200];
/// Part of the largest force that is none, and of a bound of friction within which it is reached.
const NONE: f64 = 1e-6;

/// Modes as relaxation approaches them (Gauss–Seidel; Jourdan, Alart & Jean, *Comput. Methods Appl. Mech. Eng.* 155, 1998). It finds its
/// way where many contacts slide, and pivoting ends in rays; where forces grow without bound it ends.
pub(super) fn relaxed(block: &LcpBlock) -> impl Iterator<Item = Vec<Mode>> + '_ {
    let (mut force, mut acceleration) = (vec![0.0; 2 * block.len()], block.free.clone());
    SWEEPS.into_iter().map_while(move |sweeps| {
        (0..sweeps).for_each(|_| (0..block.len()).for_each(|i| relax(block, i, &mut force, &mut acceleration)));
        force.iter().all(|f| f.is_finite()).then(|| modes(block, &force))
    })
}

/// Brings the forces of one contact to what its law asks for while the others stay.
fn relax(block: &LcpBlock, i: usize, force: &mut [f64], acceleration: &mut [f64]) {
    let (n, drag) = (block.len(), drag(block.friction[i]));
    let response = block.g[(i, i)] + drag * block.g[(i, n + i)];
    if response > 0.0 {
        let normal = (force[i] - acceleration[i] / response).max(block.least_normal[i]);
        set(block, i, normal, force, acceleration);
    }
    let tangential = match block.friction[i] {
        BlockFriction::Law(FrictionLaw::Frictionless) => 0.0,
        BlockFriction::Law(FrictionLaw::Sliding { .. }) | BlockFriction::Starting(..) => drag * force[i],
        law if force[i] > 0.0 && block.g[(n + i, n + i)] > 0.0 => {
            let (sticking, most) =
                (force[n + i] - acceleration[n + i] / block.g[(n + i, n + i)], bound(law) * force[i]);
            sticking.max(-most).min(most)
        }
        BlockFriction::Law(_) => 0.0,
    };
    set(block, n + i, tangential, force, acceleration);
}

/// Gives one force a value, and the accelerations what this changes.
fn set(block: &LcpBlock, row: usize, value: f64, force: &mut [f64], acceleration: &mut [f64]) {
    let change = value - std::mem::replace(&mut force[row], value);
    if change != 0.0 {
        acceleration.iter_mut().zip(block.g.row(row)).for_each(|(a, g)| *a += change * g);
    }
}

/// Most friction of a contact at rest, over its normal force.
fn bound(law: BlockFriction) -> f64 {
    match law {
        BlockFriction::Law(FrictionLaw::Resting { fixed, .. }) => fixed,
        _ => f64::INFINITY,
    }
}

fn modes(block: &LcpBlock, force: &[f64]) -> Vec<Mode> {
    let n = block.len();
    let none = NONE * force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    let tangent = |i: usize| match block.friction[i] {
        BlockFriction::Law(FrictionLaw::Frictionless) => Tangent::Free,
        BlockFriction::Law(FrictionLaw::Sliding { sense, .. }) | BlockFriction::Starting(sense, _) => {
            Tangent::Slip(sense)
        }
        law if force[n + i].abs() >= (1.0 - NONE) * bound(law) * force[i] => Tangent::Slip(-force[n + i].signum()),
        _ => Tangent::Stick,
    };
    let mode = |i: usize| match force[i] - block.least_normal[i] > none {
        false if block.least_normal[i] == 0.0 => Mode::OPEN,
        closed => Mode { closed, tangent: tangent(i) },
    };
    (0..n).map(mode).collect()
}
