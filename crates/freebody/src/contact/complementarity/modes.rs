//! What contacts do under given modes, held against the conditions of contact; and all modes there are.

use super::lcp_block::{BlockFriction, Found, LcpBlock};
use super::{FrictionLaw, Status};
use crate::solve::{keep_above, Lu, Matrix, Orthogonal};

/// A pivot below this, of rows with unit diagonal, is round-off of G.
const SINGULAR: f64 = 1e-11;

/// What a contact is supposed to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mode {
    /// aN = 0; otherwise the normal force is the least one, which is zero unless pressed.
    pub closed: bool,
    pub tangent: Tangent,
}

impl Mode {
    pub const OPEN: Mode = Mode { closed: false, tangent: Tangent::Free };

    /// That of a contact without a least normal force that does this.
    pub fn of(status: Status) -> Mode {
        let closed = |tangent| Mode { closed: true, tangent };
        match status {
            Status::Open => Mode::OPEN,
            Status::Closed => closed(Tangent::Free),
            Status::Stick => closed(Tangent::Stick),
            Status::Slip(sense) => closed(Tangent::Slip(sense)),
        }
    }
}

/// What a contact is supposed to do along its tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Tangent {
    /// λT = 0.
    Free,
    /// λT = −μ s λN.
    Slip(f64),
    /// aT = 0 by a force λT.
    Stick,
    /// aT = 0 with λT this part of λN: held by other contacts.
    PartialFriction(f64),
}

/// Why modes give no finding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refusal {
    /// Their equations do not determine the forces.
    Singular,
    /// A condition is violated.
    Violated,
}

/// An unknown force: a unit along the normal of a contact, with its friction, or along its tangent.
struct Column {
    contact: usize,
    normal: f64,
    tangent: f64,
}

impl Column {
    /// Adds `x` of it to the forces.
    fn add(&self, x: f64, force: &mut [f64]) {
        let n = force.len() / 2;
        force[self.contact] += self.normal * x;
        force[n + self.contact] += self.tangent * x;
    }

    /// The acceleration of `row` by a unit of it.
    fn moves(&self, block: &LcpBlock, row: usize) -> f64 {
        block.g[(row, self.contact)] * self.normal + block.g[(row, block.len() + self.contact)] * self.tangent
    }
}

/// Solves the equations of `modes` and checks every condition to `tolerance`, relative to the terms that
/// make up an acceleration, the largest free acceleration, and the largest force.
pub(super) fn evaluate(block: &LcpBlock, modes: &[Mode], tolerance: f64) -> Result<Found, Refusal> {
    let force = forces(block, modes)?;
    Check::new(block, modes, &force, tolerance).verdict().ok_or(Refusal::Violated)
}

/// As [`evaluate`], for modes whose equations do not determine the forces. Of forces well inside their bounds the contact that is
/// nearest to one of its own, along a self-stress, opens, where it `may_open`, or keeps its friction as part of its normal force, until
/// what is left is determined: friction on the edge of its cone would hold no longer than the moment.
pub(super) fn basic(block: &LcpBlock, modes: &[Mode], may_open: bool, tolerance: f64) -> Result<Found, Refusal> {
    let mut modes = modes.to_vec();
    for _ in 0..=3 * modes.len() {
        let Equations { columns, missing, a, force } = Equations::new(block, &modes);
        let factors = Orthogonal::factor(&a);
        let (n, rank) = (columns.len(), factors.rank().rank);
        if rank == n {
            break;
        }
        let mut x = vec![0.0; n];
        factors.add_solution(&missing, &mut x);
        let wrenches = |x: &[f64], mut force: Vec<f64>| {
            columns.iter().zip(x).for_each(|(column, x)| column.add(*x, &mut force));
            force
        };
        let nothing = vec![0.0; force.len()];
        let along = |j: usize| margins(block, &modes, &wrenches(factors.x().row(rank + j), nothing.clone()));
        let by: Vec<Vec<(usize, Bound, f64)>> = (0..n - rank).map(along).collect();
        let inside = |force: &[f64]| {
            let mut all = margins(block, &modes, force);
            all.iter_mut().filter(|m| m.1 == Bound::LeastNormal).for_each(|m| m.2 -= block.least_normal[m.0]);
            all
        };
        let least: Vec<f64> = inside(&wrenches(&x, force.clone())).iter().map(|m| m.2).collect();
        let (share, most) = keep_above(&Matrix::from_fn(least.len(), by.len(), |i, j| by[j][i].2), &least, 1.0);
        if most < -tolerance {
            return Err(Refusal::Violated);
        }
        for (j, share) in share.iter().enumerate() {
            x.iter_mut().zip(factors.x().row(rank + j)).for_each(|(x, along)| *x += share * along);
        }
        let force = wrenches(&x, force);
        let now = inside(&force);
        let is_way = |by: &(usize, Bound, f64)| by.2.abs() > SINGULAR && (may_open || by.1 != Bound::LeastNormal);
        let ways = now.iter().zip(&by[0]).filter(|(_, by)| is_way(by));
        let next = ways.map(|(now, by)| (now.0, now.1, (now.2 / by.2).abs())).min_by(|a, b| a.2.total_cmp(&b.2));
        let Some((contact, bound, _)) = next else {
            // Friction without bound, of contacts that need it all the less.
            let friction = (0..n).find(|&j| columns[j].normal == 0.0 && factors.x()[(rank, j)].abs() > SINGULAR);
            let contact = columns[friction.ok_or(Refusal::Singular)?].contact;
            modes[contact].tangent = Tangent::PartialFriction(0.0);
            continue;
        };
        modes[contact] = match bound {
            Bound::LeastNormal if block.least_normal[contact] == 0.0 => Mode::OPEN,
            Bound::LeastNormal => Mode { closed: false, ..modes[contact] },
            Bound::Cone(most) => {
                let part = force[block.len() + contact] / force[contact].max(f64::MIN_POSITIVE);
                Mode { tangent: Tangent::PartialFriction(part.clamp(-most, most)), ..modes[contact] }
            }
        };
    }
    evaluate(block, &modes, tolerance)
}

/// What bounds the force of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    /// The least normal force.
    LeastNormal,
    /// The cone of friction with this coefficient.
    Cone(f64),
}

/// How far forces are inside the bounds of contacts that could carry more or less.
fn margins(block: &LcpBlock, modes: &[Mode], force: &[f64]) -> Vec<(usize, Bound, f64)> {
    let mut all = vec![];
    for (i, mode) in modes.iter().enumerate() {
        if mode.closed {
            all.push((i, Bound::LeastNormal, force[i]));
        }
        if let (BlockFriction::Law(FrictionLaw::Resting { fixed, .. }), Tangent::Stick) =
            (block.friction[i], mode.tangent)
        {
            let (most, friction) = (fixed * force[i], force[modes.len() + i]);
            all.extend([most - friction, most + friction].map(|margin| (i, Bound::Cone(fixed), margin)));
        }
    }
    all
}

/// What modes ask of the forces: A x = missing, for x times the columns beside those given.
struct Equations {
    columns: Vec<Column>,
    missing: Vec<f64>,
    a: Matrix,
    force: Vec<f64>,
}

/// The forces (2n) that keep the promises aN = 0 and aT = 0 of the modes.
fn forces(block: &LcpBlock, modes: &[Mode]) -> Result<Vec<f64>, Refusal> {
    let Equations { columns, missing, a, mut force } = Equations::new(block, modes);
    for (column, x) in columns.iter().zip(solved(&a, &missing)?) {
        column.add(x, &mut force);
    }
    Ok(force)
}

impl Equations {
    fn new(block: &LcpBlock, modes: &[Mode]) -> Equations {
        let n = block.len();
        let (mut rows, mut columns, mut force) = (Vec::new(), Vec::new(), vec![0.0; 2 * n]);
        for (i, mode) in modes.iter().enumerate() {
            let ratio = ratio(block.friction[i], mode.tangent);
            (force[i], force[n + i]) = (block.least_normal[i], ratio * block.least_normal[i]);
            if mode.closed {
                rows.push(i);
                columns.push(Column { contact: i, normal: 1.0, tangent: ratio });
            }
            if matches!(mode.tangent, Tangent::Stick | Tangent::PartialFriction(_)) {
                rows.push(n + i);
            }
            if mode.tangent == Tangent::Stick {
                columns.push(Column { contact: i, normal: 0.0, tangent: 1.0 });
            }
        }
        let missing: Vec<f64> = rows.iter().map(|&r| -accelerated(block, r, &force)).collect();
        let a = Matrix::from_fn(rows.len(), columns.len(), |i, j| columns[j].moves(block, rows[i]));
        Equations { columns, missing, a, force }
    }
}

/// x with A x = b, for A with independent columns; a residual is left to the check of the accelerations.
fn solved(a: &Matrix, b: &[f64]) -> Result<Vec<f64>, Refusal> {
    if a.rows() == a.cols() {
        let mut lu = Lu::default();
        lu.refactor(a, SINGULAR).map_err(|_| Refusal::Singular)?;
        return Ok(lu.solve(b));
    }
    if a.rows() < a.cols() {
        return Err(Refusal::Singular);
    }
    // Of the columns, which are fewer: their bases are the smaller.
    let factors = Orthogonal::factor(&Matrix::from_fn(a.cols(), a.rows(), |i, j| a[(j, i)]));
    if factors.rank().rank < a.cols() {
        return Err(Refusal::Singular);
    }
    let mut x = vec![0.0; a.cols()];
    factors.add_transposed_solution(b, &mut x);
    let residual: Vec<f64> = b.iter().zip(a.mul_vec(&x)).map(|(b, ax)| b - ax).collect();
    factors.add_transposed_solution(&residual, &mut x);
    Ok(x)
}

/// λT/λN where the mode fixes it, else 0.
fn ratio(law: BlockFriction, tangent: Tangent) -> f64 {
    let sense = match tangent {
        Tangent::Slip(s) => s,
        Tangent::PartialFriction(part) => return part,
        Tangent::Free | Tangent::Stick => return 0.0,
    };
    match law {
        BlockFriction::Law(FrictionLaw::Resting { kinetic, .. } | FrictionLaw::Sliding { kinetic, .. })
        | BlockFriction::Starting(_, kinetic) => -kinetic * sense,
        BlockFriction::Law(FrictionLaw::Frictionless | FrictionLaw::Rough) => 0.0,
    }
}

/// Acceleration `row` under the forces.
fn accelerated(block: &LcpBlock, row: usize, force: &[f64]) -> f64 {
    block.free[row] + block.g.row(row).iter().zip(force).map(|(g, l)| g * l).sum::<f64>()
}

/// Forces against the conditions of their modes.
struct Check<'a> {
    task: &'a LcpBlock,
    modes: &'a [Mode],
    force: &'a [f64],
    acceleration: Vec<f64>,
    /// What counts as zero: for each acceleration, and for forces.
    noise: Vec<f64>,
    nothing: f64,
}

impl<'a> Check<'a> {
    fn new(block: &'a LcpBlock, modes: &'a [Mode], force: &'a [f64], tolerance: f64) -> Check<'a> {
        let rows = 0..force.len();
        // Free accelerations are of order one, and as uncertain as the largest.
        let terms = |r: usize| 1.0 + block.g.row(r).iter().zip(force).map(|(g, l)| (g * l).abs()).sum::<f64>();
        Check {
            task: block,
            modes,
            force,
            acceleration: rows.clone().map(|r| accelerated(block, r, force)).collect(),
            noise: rows.map(|r| tolerance * terms(r)).collect(),
            nothing: tolerance * force.iter().fold(1.0_f64, |m, f| m.max(f.abs())),
        }
    }

    /// The finding, with exact zeros where the conditions ask for them.
    fn verdict(mut self) -> Option<Found> {
        let n = self.modes.len();
        let status: Option<Vec<Status>> = (0..n).map(|i| self.status(i)).collect();
        let (status, mut force) = (status?, self.force.to_vec());
        for (i, status) in status.iter().enumerate() {
            if self.modes[i].closed || self.acceleration[i].abs() <= self.noise[i] {
                self.acceleration[i] = 0.0;
            }
            if *status == Status::Stick {
                self.acceleration[n + i] = 0.0;
            }
            if force[i] <= self.nothing && self.task.least_normal[i] == 0.0 {
                (force[i], force[n + i]) = (0.0, 0.0);
            }
        }
        Some(Found { status, force, acceleration: self.acceleration })
    }

    /// What contact i then does, if its conditions hold.
    fn status(&self, i: usize) -> Option<Status> {
        let n = self.modes.len();
        let (mode, a, noise) = (self.modes[i], self.acceleration[i], self.noise[i]);
        let normal_holds = if mode.closed {
            a.abs() <= noise && self.force[i] - self.task.least_normal[i] >= -self.nothing
        } else {
            a >= -noise
        };
        let sliding = self.sliding(i)?;
        let carries = self.force[i] > self.nothing;
        match normal_holds {
            false => None,
            true if carries => Some(sliding),
            true if self.force[n + i].abs() <= self.nothing => Some(Status::Open),
            true => None,
        }
    }

    /// What it does along its tangent, if the conditions there hold.
    fn sliding(&self, i: usize) -> Option<Status> {
        let t = self.modes.len() + i;
        let (a, noise) = (self.acceleration[t], self.noise[t]);
        let (law, sticks) = (self.task.friction[i], a.abs() <= noise);
        match self.modes[i].tangent {
            Tangent::Free => Some(Status::Closed),
            Tangent::Slip(s) => match law {
                BlockFriction::Law(FrictionLaw::Resting { .. }) | BlockFriction::Starting(..) if sticks => {
                    Some(Status::Stick)
                }
                BlockFriction::Law(FrictionLaw::Resting { .. }) | BlockFriction::Starting(..) if s * a < -noise => None,
                _ => Some(Status::Slip(s)),
            },
            Tangent::Stick | Tangent::PartialFriction(_) => {
                let bound = match law {
                    BlockFriction::Law(FrictionLaw::Resting { fixed, .. }) => fixed * self.force[i],
                    _ => f64::INFINITY,
                };
                (sticks && self.force[t].abs() <= bound + self.nothing).then_some(Status::Stick)
            }
        }
    }
}

/// All modes of a contact, with the least force first.
pub(super) fn admissible(law: BlockFriction, least_normal: f64) -> Vec<Mode> {
    let tangents = match law {
        BlockFriction::Law(FrictionLaw::Frictionless) => vec![Tangent::Free],
        BlockFriction::Law(FrictionLaw::Rough) => vec![Tangent::Stick],
        BlockFriction::Law(FrictionLaw::Sliding { sense, .. }) | BlockFriction::Starting(sense, _) => {
            vec![Tangent::Slip(sense)]
        }
        BlockFriction::Law(FrictionLaw::Resting { .. }) => {
            vec![Tangent::Stick, Tangent::Slip(1.0), Tangent::Slip(-1.0)]
        }
    };
    let with = |closed| tangents.iter().map(move |&tangent| Mode { closed, tangent });
    let open = if least_normal > 0.0 { with(false).collect() } else { vec![Mode::OPEN] };
    open.into_iter().chain(with(true)).collect()
}

/// A mode and what can stand for it where its forces are not determined: the vertices of the set of forces.
pub(super) fn vertices(law: BlockFriction, mode: Mode) -> Vec<Mode> {
    let tangents = match (mode.tangent, law) {
        (Tangent::Stick, BlockFriction::Law(FrictionLaw::Resting { fixed, .. })) => {
            let parts = [0.0, -fixed, fixed].map(Tangent::PartialFriction);
            [Tangent::Stick].into_iter().chain(parts).collect()
        }
        (Tangent::Stick, _) => vec![Tangent::Stick, Tangent::PartialFriction(0.0)],
        (tangent, _) => vec![tangent],
    };
    tangents.into_iter().map(|tangent| Mode { tangent, ..mode }).collect()
}

/// Calls `visit` with every choice of one mode for each contact, the last contact varying fastest, until it
/// returns true.
pub(super) fn choices(lists: &[Vec<Mode>], mut visit: impl FnMut(&[Mode]) -> bool) {
    let mut at = vec![0; lists.len()];
    let mut modes: Vec<Mode> = lists.iter().map(|l| l[0]).collect();
    while !visit(&modes) {
        let Some(i) = (0..lists.len()).rev().find(|&i| at[i] + 1 < lists[i].len()) else { return };
        at[i] += 1;
        at[i + 1..].fill(0);
        (i..lists.len()).for_each(|j| modes[j] = lists[j][at[j]]);
    }
}
