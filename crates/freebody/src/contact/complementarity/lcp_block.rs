//! Touches that influence each other, in units in which their numbers are of order one.

use super::{Answer, FrictionLaw, Status};
use crate::solve::{Matrix, Orthogonal};

/// A diagonal entry of G below this fraction of the largest is round-off: nothing moves there.
const IMMOVABLE: f64 = 1e-14;
/// A direction of G' that counts as dependent, but is larger than this, may be real.
const DOUBTFUL: f64 = 1e-13;

/// Conditions hold to round-off of the solver; only if no modes do, to that of ever worse data.
pub(super) const EXACT: [f64; 3] = [4e-14, 1e-12, 1e-10];
/// The same where contacts may be one but for the depth to which sides are sunk (`touch/chain.rs`).
pub(super) const RELAXED: [f64; 4] = [4e-14, 1e-12, 1e-10, 1e-7];

/// Free accelerations below this have lost their digits: they are none.
const VANISHING: f64 = 1e-280;

/// How a contact of a block resists sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BlockFriction {
    /// As given.
    Law(FrictionLaw),
    /// It has begun to slide, so it must go on that way: sense and coefficient.
    Starting(f64, f64),
}

/// A group of coupled contacts: a' = G' λ' + f', with unit diagonal of G' and the largest f' of size 1.
#[derive(Clone, Debug)]
pub(super) struct LcpBlock {
    pub g: Matrix,
    pub free: Vec<f64>,
    pub friction: Vec<BlockFriction>,
    /// The least normal force of each contact.
    pub least_normal: Vec<f64>,
    /// To what its conditions must hold, one after the other.
    pub tolerances: &'static [f64],
    /// Which contacts of the problem these are.
    contacts: Vec<usize>,
    force_units: Vec<f64>,
    acceleration_units: Vec<f64>,
}

impl LcpBlock {
    pub fn new(
        g: &Matrix,
        free: &[f64],
        friction: &[FrictionLaw],
        least_normal: &[f64],
        contacts: &[usize],
    ) -> LcpBlock {
        let (k, n) = (friction.len(), contacts.len());
        let rows: Vec<usize> = contacts.iter().copied().chain(contacts.iter().map(|i| k + i)).collect();
        let largest = rows.iter().map(|&i| g[(i, i)]).fold(0.0, f64::max);
        let floor = if largest > 0.0 { IMMOVABLE * largest } else { 1.0 };
        let scales: Vec<f64> = rows.iter().map(|&i| 1.0 / g[(i, i)].max(floor).sqrt()).collect();
        let sizes = rows.iter().zip(&scales).map(|(&i, d)| (free[i] * d).abs());
        let presses = contacts.iter().zip(&scales).map(|(&i, d)| least_normal[i] / d);
        let unit = sizes.chain(presses).fold(0.0, f64::max);
        let unit = if unit > VANISHING { unit } else { 1.0 };
        let law = |i: usize| scaled(friction[contacts[i]], scales[i] / scales[n + i]);
        LcpBlock {
            g: Matrix::from_fn(2 * n, 2 * n, |i, j| scales[i] * g[(rows[i], rows[j])] * scales[j]),
            free: rows.iter().zip(&scales).map(|(&i, d)| free[i] * d / unit).collect(),
            friction: (0..n).map(|i| BlockFriction::Law(law(i))).collect(),
            least_normal: contacts.iter().zip(&scales).map(|(&i, d)| least_normal[i] / (d * unit)).collect(),
            tolerances: &EXACT,
            contacts: contacts.to_vec(),
            force_units: scales.iter().map(|d| d * unit).collect(),
            acceleration_units: scales.iter().map(|d| unit / d).collect(),
        }
    }

    /// The same task, with conditions that hold to other tolerances.
    pub fn within(self, tolerances: &'static [f64]) -> LcpBlock {
        LcpBlock { tolerances, ..self }
    }

    /// Whether G may have more independent rows than the solvers see, as when masses differ by ten orders.
    pub fn rank_is_doubtful(&self) -> bool {
        Orthogonal::factor(&self.g).rank().dropped > DOUBTFUL
    }

    /// The number of contacts.
    pub fn len(&self) -> usize {
        self.contacts.len()
    }

    /// The same contacts, each held as `hold` makes of it.
    pub fn with_friction(&self, law: impl Fn(usize, BlockFriction) -> BlockFriction) -> LcpBlock {
        let laws = self.friction.iter().enumerate().map(|(i, h)| law(i, *h)).collect();
        LcpBlock { friction: laws, ..self.clone() }
    }

    /// Writes a finding, in the units of the problem, into its answer.
    pub fn write(&self, found: &Found, answer: &mut Answer) {
        let (k, n) = (answer.status.len(), self.len());
        for (i, &contact) in self.contacts.iter().enumerate() {
            answer.status[contact] = found.status[i];
            answer.normal[contact] = found.force[i] * self.force_units[i];
            answer.tangent[contact] = found.force[n + i] * self.force_units[n + i];
            answer.acceleration[contact] = found.acceleration[i] * self.acceleration_units[i];
            answer.acceleration[k + contact] = found.acceleration[n + i] * self.acceleration_units[n + i];
        }
    }
}

/// What contacts do, all conditions satisfied, in the units of the block.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub status: Vec<Status>,
    pub force: Vec<f64>,
    pub acceleration: Vec<f64>,
}

/// The friction law with its coefficients times `ratio`, the unit of normal over that of tangential force.
fn scaled(friction_law: FrictionLaw, ratio: f64) -> FrictionLaw {
    match friction_law {
        FrictionLaw::Sliding { sense, kinetic } => FrictionLaw::Sliding { sense, kinetic: kinetic * ratio },
        FrictionLaw::Resting { fixed, kinetic } => {
            FrictionLaw::Resting { fixed: fixed * ratio, kinetic: kinetic * ratio }
        }
        FrictionLaw::Frictionless | FrictionLaw::Rough => friction_law,
    }
}

/// The contacts by groups without influence on each other, in order of their first members.
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
