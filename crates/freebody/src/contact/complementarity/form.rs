//! Touches with friction as a linear complementarity problem, and back.
//!
//! A contact that may stick has four variables: λN, β₊, β₋ and γ, with λT = β₊ − β₋, and γ the size of the
//! tangential acceleration where it slides:
//!
//!   0 ≤ λN ⟂ aN ≥ 0,  0 ≤ β± ⟂ γ ± aT ≥ 0,  0 ≤ γ ⟂ μ λN − β₊ − β₋ ≥ 0
//!
//! (Stewart & Trinkle, *Int. J. Numer. Methods Eng.* 39, 1996; Anitescu & Potra 1997). Its matrix is
//! copositive, so without sliding contacts Lemke's method finds a solution where the normal conditions can
//! be met at all; the smaller form of Pfeiffer & Glocker (1996) does not promise that.

use super::lcp_block::{BlockFriction, LcpBlock};
use super::lemke::{lemke, End};
use super::modes::{Mode, Tangent};
use super::FrictionLaw;
use crate::solve::Matrix;

/// A ray proves that contacts cannot be closed if its forces, of size 1, accelerate less than this…
const SELF_STRESS: f64 = 1e-9;
/// … and oppose the free acceleration by more than this.
const OPPOSED: f64 = 1e-8;

/// The golden ratio less 1: its multiples leave no gaps.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What pivoting makes of a block.
#[derive(PartialEq)]
pub(super) enum Proposal {
    /// The modes of a complementary basis.
    Modes(Vec<Mode>),
    /// Normal forces in balance with themselves whose work on the free acceleration is negative: no
    /// motion opens or closes all contacts.
    Impossible,
}

/// A variable of the complementarity problem, of a contact.
#[derive(Clone, Copy, PartialEq)]
enum Variable {
    /// λN.
    Normal(usize),
    /// β with its sign.
    Friction(usize, f64),
    /// γ.
    Speed(usize),
}

/// Follows one of Lemke's paths, with `apart` added to the free normal accelerations; None where it ends without a proposal.
pub(super) fn propose(block: &LcpBlock, apart: f64, path: usize) -> Option<Proposal> {
    let variables = variables(block);
    let (m, mut q) = assemble(block, &variables);
    let normals = q.iter_mut().zip(&variables).filter(|(_, v)| matches!(v, Variable::Normal(_)));
    normals.for_each(|(q, _)| *q += apart);
    match lemke(&m, &q, &cover(path, q.len())) {
        End::Solution { basic, slack } => Some(Proposal::Modes(modes(block, &variables, &basic, &slack))),
        End::Ray(z) if self_stressed(block, &variables, &z) => Some(Proposal::Impossible),
        End::Ray(_) | End::Lost => None,
    }
}

/// The covering vector of a path: ones for the first, and numbers between 1 and 2 that are spread evenly for the
/// others.
fn cover(path: usize, n: usize) -> Vec<f64> {
    (0..n).map(|i| 1.0 + (GOLDEN * (path * (i + 1)) as f64).fract()).collect()
}

fn variables(block: &LcpBlock) -> Vec<Variable> {
    let of = |i: usize| match block.friction[i] {
        BlockFriction::Law(FrictionLaw::Resting { .. } | FrictionLaw::Rough) => {
            vec![Variable::Normal(i), Variable::Friction(i, 1.0), Variable::Friction(i, -1.0), Variable::Speed(i)]
        }
        _ => vec![Variable::Normal(i)],
    };
    (0..block.len()).flat_map(of).collect()
}

/// λT/λN of a contact that slides; 0 of others.
pub(super) fn drag(law: BlockFriction) -> f64 {
    match law {
        BlockFriction::Law(FrictionLaw::Sliding { sense, kinetic }) | BlockFriction::Starting(sense, kinetic) => {
            -sense * kinetic
        }
        BlockFriction::Law(_) => 0.0,
    }
}

/// The cone as ratio · λN − share · (β₊ + β₋) ≥ 0.
fn cone(law: BlockFriction) -> (f64, f64) {
    match law {
        BlockFriction::Law(FrictionLaw::Resting { fixed, .. }) => (fixed, 1.0),
        _ => (1.0, 0.0),
    }
}

fn assemble(block: &LcpBlock, variables: &[Variable]) -> (Matrix, Vec<f64>) {
    let n = block.len();
    let moved = |row: usize, v: Variable| match v {
        Variable::Normal(j) => block.g[(row, j)] + drag(block.friction[j]) * block.g[(row, n + j)],
        Variable::Friction(j, sign) => sign * block.g[(row, n + j)],
        Variable::Speed(_) => 0.0,
    };
    let entry = |row: Variable, column: Variable| match (row, column) {
        (Variable::Normal(i), v) => moved(i, v),
        (Variable::Friction(i, _), Variable::Speed(j)) => f64::from(i == j),
        (Variable::Friction(i, sign), v) => sign * moved(n + i, v),
        (Variable::Speed(i), Variable::Normal(j)) if i == j => cone(block.friction[i]).0,
        (Variable::Speed(i), Variable::Friction(j, _)) if i == j => -cone(block.friction[i]).1,
        (Variable::Speed(_), _) => 0.0,
    };
    let least_normal =
        |row: usize| (0..n).map(|j| block.least_normal[j] * moved(row, Variable::Normal(j))).sum::<f64>();
    let free = |row: usize| block.free[row] + least_normal(row);
    let constant = |row: Variable| match row {
        Variable::Normal(i) => free(i),
        Variable::Friction(i, sign) => sign * free(n + i),
        Variable::Speed(i) => cone(block.friction[i]).0 * block.least_normal[i],
    };
    let size = variables.len();
    let m = Matrix::from_fn(size, size, |i, j| entry(variables[i], variables[j]));
    (m, variables.iter().map(|&v| constant(v)).collect())
}

fn modes(block: &LcpBlock, variables: &[Variable], basic: &[bool], slack: &[f64]) -> Vec<Mode> {
    let at = |v: Variable| variables.iter().position(|&w| w == v);
    let is_basic = |v: Variable| at(v).is_some_and(|p| basic[p]);
    let slack = |v: Variable| at(v).map_or(0.0, |p| slack[p]);
    let tangent = |i: usize| {
        let (up, down) = (Variable::Friction(i, 1.0), Variable::Friction(i, -1.0));
        match block.friction[i] {
            BlockFriction::Law(FrictionLaw::Frictionless) => Tangent::Free,
            BlockFriction::Law(FrictionLaw::Sliding { sense, .. }) | BlockFriction::Starting(sense, _) => {
                Tangent::Slip(sense)
            }
            BlockFriction::Law(FrictionLaw::Rough) => Tangent::Stick,
            BlockFriction::Law(FrictionLaw::Resting { .. }) => {
                match (is_basic(Variable::Speed(i)), is_basic(up), is_basic(down)) {
                    (false, false, false) => Tangent::PartialFriction(0.0),
                    (false, _, _) | (true, true, true) => Tangent::Stick,
                    (true, true, false) => Tangent::Slip(-1.0),
                    (true, false, true) => Tangent::Slip(1.0),
                    // Without friction no β need be basic; γ + aT then exceeds γ − aT where aT > 0.
                    (true, false, false) => Tangent::Slip(if slack(up) >= slack(down) { 1.0 } else { -1.0 }),
                }
            }
        }
    };
    let mode = |i: usize| match is_basic(Variable::Normal(i)) {
        false if block.least_normal[i] == 0.0 => Mode::OPEN,
        closed => Mode { closed, tangent: tangent(i) },
    };
    (0..block.len()).map(mode).collect()
}

/// Normal forces v ≥ 0 with G v = 0 and v·f < 0 would have v·a = v·f < 0, against a ≥ 0.
fn self_stressed(block: &LcpBlock, variables: &[Variable], z: &[f64]) -> bool {
    let mut v = vec![0.0; 2 * block.len()];
    for (variable, value) in variables.iter().zip(z) {
        if let Variable::Normal(i) = variable {
            v[*i] = value.max(0.0);
        }
    }
    let size = v.iter().copied().fold(0.0, f64::max);
    let moved = block.g.mul_vec(&v).iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    let work: f64 = v.iter().zip(&block.free).map(|(v, f)| v * f).sum();
    moved <= SELF_STRESS * size && work < -OPPOSED * size
}
