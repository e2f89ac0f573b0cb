//! Touches that influence each other, in units in which their numbers are of order one.

use super::modes::Found;
use super::{Answer, Grip};
use crate::solve::{Matrix, Orthogonal};

/// A diagonal entry of G below this fraction of the largest is round-off: nothing moves there.
const IMMOVABLE: f64 = 1e-14;
/// A direction of G' that counts as dependent, but is larger than this, may be real.
const DOUBTFUL: f64 = 1e-13;

/// Conditions hold to round-off of the solver; only if no modes do, to that of ever worse data.
pub(super) const EXACT: [f64; 3] = [4e-14, 1e-12, 1e-10];
/// The same where touches may be one but for the depth to which sides are sunk (`touch/chain.rs`).
pub(super) const ROUGH: [f64; 4] = [4e-14, 1e-12, 1e-10, 1e-7];

/// Free accelerations below this have lost their digits: they are none.
const VANISHING: f64 = 1e-280;

/// How a touch of a task resists sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// As given.
    Grip(Grip),
    /// It has begun to slide, so it must go on that way: sense and coefficient.
    Starting(f64, f64),
}

/// A group of coupled touches: a' = G' λ' + f', with unit diagonal of G' and the largest f' of size 1.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub g: Matrix,
    pub free: Vec<f64>,
    pub holds: Vec<Hold>,
    /// The least normal force of each touch.
    pub pressed: Vec<f64>,
    /// To what its conditions must hold, one after the other.
    pub tolerances: &'static [f64],
    /// Which touches of the problem these are.
    touches: Vec<usize>,
    force_units: Vec<f64>,
    acceleration_units: Vec<f64>,
}

impl Task {
    pub fn new(g: &Matrix, free: &[f64], grips: &[Grip], pressed: &[f64], touches: &[usize]) -> Task {
        let (k, n) = (grips.len(), touches.len());
        let rows: Vec<usize> = touches.iter().copied().chain(touches.iter().map(|i| k + i)).collect();
        let largest = rows.iter().map(|&i| g[(i, i)]).fold(0.0, f64::max);
        let floor = if largest > 0.0 { IMMOVABLE * largest } else { 1.0 };
        let scales: Vec<f64> = rows.iter().map(|&i| 1.0 / g[(i, i)].max(floor).sqrt()).collect();
        let sizes = rows.iter().zip(&scales).map(|(&i, d)| (free[i] * d).abs());
        let presses = touches.iter().zip(&scales).map(|(&i, d)| pressed[i] / d);
        let unit = sizes.chain(presses).fold(0.0, f64::max);
        let unit = if unit > VANISHING { unit } else { 1.0 };
        let hold = |i: usize| scaled(grips[touches[i]], scales[i] / scales[n + i]);
        Task {
            g: Matrix::from_fn(2 * n, 2 * n, |i, j| scales[i] * g[(rows[i], rows[j])] * scales[j]),
            free: rows.iter().zip(&scales).map(|(&i, d)| free[i] * d / unit).collect(),
            holds: (0..n).map(|i| Hold::Grip(hold(i))).collect(),
            pressed: touches.iter().zip(&scales).map(|(&i, d)| pressed[i] / (d * unit)).collect(),
            tolerances: &EXACT,
            touches: touches.to_vec(),
            force_units: scales.iter().map(|d| d * unit).collect(),
            acceleration_units: scales.iter().map(|d| unit / d).collect(),
        }
    }

    /// The same task, with conditions that hold to other tolerances.
    pub fn within(self, tolerances: &'static [f64]) -> Task {
        Task { tolerances, ..self }
    }

    /// Whether G may have more independent rows than the solvers see, as when masses differ by ten orders.
    pub fn rank_is_doubtful(&self) -> bool {
        Orthogonal::factor(&self.g).rank().dropped > DOUBTFUL
    }

    /// The number of touches.
    pub fn len(&self) -> usize {
        self.touches.len()
    }

    /// The same touches, each held as `hold` makes of it.
    pub fn held(&self, hold: impl Fn(usize, Hold) -> Hold) -> Task {
        let holds = self.holds.iter().enumerate().map(|(i, h)| hold(i, *h)).collect();
        Task { holds, ..self.clone() }
    }

    /// Writes a finding, in the units of the problem, into its answer.
    pub fn write(&self, found: &Found, answer: &mut Answer) {
        let (k, n) = (answer.status.len(), self.len());
        for (i, &touch) in self.touches.iter().enumerate() {
            answer.status[touch] = found.status[i];
            answer.normal[touch] = found.force[i] * self.force_units[i];
            answer.tangent[touch] = found.force[n + i] * self.force_units[n + i];
            answer.acceleration[touch] = found.acceleration[i] * self.acceleration_units[i];
            answer.acceleration[k + touch] = found.acceleration[n + i] * self.acceleration_units[n + i];
        }
    }
}

/// The grip with its coefficients times `ratio`, the unit of normal over that of tangential force.
fn scaled(grip: Grip, ratio: f64) -> Grip {
    match grip {
        Grip::Sliding { sense, kinetic } => Grip::Sliding { sense, kinetic: kinetic * ratio },
        Grip::Resting { fixed, kinetic } => Grip::Resting { fixed: fixed * ratio, kinetic: kinetic * ratio },
        Grip::Smooth | Grip::Rough => grip,
    }
}

/// The touches by groups without influence on each other, in order of their first members.
pub(super) fn groups(g: &Matrix) -> Vec<Vec<usize>> {
    let k = g.rows() / 2;
    let coupled = |i: usize, j: usize| [(i, j), (i, k + j), (k + i, j), (k + i, k + j)].iter().any(|&p| g[p] != 0.0);
    let mut left: Vec<usize> = (0..k).collect();
    let mut groups = Vec::new();
    while !left.is_empty() {
        let mut group = vec![left.remove(0)];
        let mut next = 0;
        while next < group.len() {
            let (joined, apart) = left.iter().partition(|&&j| coupled(group[next], j));
            let joined: Vec<usize> = joined;
            group.extend(joined);
            left = apart;
            next += 1;
        }
        group.sort_unstable();
        groups.push(group);
    }
    groups
}
