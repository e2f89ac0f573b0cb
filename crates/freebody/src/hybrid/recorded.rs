//! What is read of a motion as a program, for one motion or for many side by side.

use super::independence::NEAR_SINGULAR;
use super::HybridSystem;
use crate::bound_values::BoundValues;
use crate::dynamics::{closing_rows, SmoothMotion, Workspace};
use crate::mechanism::Recording;
use crate::scalar::Scalar;
use crate::series::{recorded, Alone, Program, Traced};
use crate::solve::Quasidefinite;
use std::iter::repeat;
use std::sync::Arc;

/// By how much the state recorded is aside: there no length vanishes without which a spring has no direction.
const ASIDE: f64 = 0.618_033_988_749_894_9;
/// Part of what was left of an inertia or a row at the start, where it is eliminated, below which digits may be lost.
const FIRM: f64 = 1e-2;
/// Freedom of trees up to which a program is no more work than a sweep, also where there is no machine code: all machines go the same
/// way, for the same bits.
const FEW: usize = 3;

/// Whether a pivot says that digits are kept, beside what it was at the start.
#[inline(always)]
pub fn is_firm(pivot: f64, at_start: f64) -> bool {
    pivot.abs() >= FIRM * at_start.abs()
}

/// A [`Recording`] as a function of time, of [q, u, states], and of what follows from parameters and from where the loops are closed.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The operations.
    pub program: Arc<Program>,
    massless: Vec<bool>,
    /// The numbers of the model that follow from parameters.
    bound: Vec<usize>,
    /// How many pivots follow the rates.
    pub pivots: usize,
}

impl Recorded {
    /// That of a mechanism that is placed, in a mode that [is free](crate::mode::Mode::is_free), recorded once for all its motions; None
    /// where its motion may be other operations elsewhere.
    pub fn new(workspace: &Workspace, what: Recording) -> Option<Self> {
        let (m, massless) = (workspace.m, massless(workspace.at().n));
        let pivots = if m.is_tree() { 0 } else { m.freedom() + closing_rows(workspace.at(), None).len() };
        if !SmoothMotion::<Traced>::fits_while_free(m) || pivots > Quasidefinite::MOST {
            return None;
        }
        let bound: Vec<_> = (0..m.values.len()).filter(|&i| m.values[i].variables().next().is_some()).collect();
        let program = m.recorded.program((what, massless.clone()), || program(workspace, &bound, what))?;
        Some(Recorded { program, massless, bound, pivots })
    }

    /// Whether it holds at the state where another workspace is placed, which has solved it where loops are closed, and about it: a tree has a
    /// motion, loops are eliminated in the order given with no doubt. The mass centre is another formula where there is no mass.
    pub fn holds_at(&self, workspace: &mut Workspace) -> bool {
        let is_solved = match workspace.is_closed() {
            true => workspace.is_clear() && workspace.independence() > NEAR_SINGULAR,
            false => workspace.solve_motion().is_ok(),
        };
        is_solved && massless(workspace.at().n) == self.massless
    }

    /// The inputs that do not move.
    pub fn numbers(&self, workspace: &Workspace) -> Vec<f64> {
        numbers(workspace, &self.bound)
    }
}

fn numbers(workspace: &Workspace, bound: &[usize]) -> Vec<f64> {
    let (m, n) = (workspace.m, workspace.at().n);
    let zeros = closing_rows(workspace.at(), None).into_iter().map(|row| {
        let gap = workspace.gap(&row);
        row.value.zip(gap).map_or(0.0, |(value, gap)| value - gap)
    });
    n.p[..m.first_state()].iter().copied().chain(bound.iter().map(|&i| n.values[i])).chain(zeros).collect()
}

fn program(workspace: &Workspace, bound: &[usize], what: Recording) -> Option<Program> {
    let (m, at) = (workspace.m, workspace.at());
    let first_state = m.first_state();
    let moving = [&[at.t], at.q, at.u, &at.n.p[first_state..]].concat();
    let aside = moving.iter().enumerate().map(|(i, x)| x + ((i + 1) as f64 * ASIDE).fract());
    let tape = recorded(aside.chain(numbers(workspace, bound)), |x| {
        let (y, fixed) = x[1..].split_at(moving.len() - 1);
        let (p, numbers) = fixed.split_at(first_state);
        let (numbers, zeros) = numbers.split_at(bound.len());
        let mut values: Vec<Traced> = at.n.values.iter().map(|&x| Traced::of(x)).collect();
        bound.iter().zip(numbers).for_each(|(&i, &x)| values[i] = x);
        let p = [p, &y[2 * m.freedom()..]].concat();
        SmoothMotion::new(m, m.with_values(&p, values)).read(what, x[0], y, zeros)
    });
    Some(Program::new(tape.ok()?.rounded(), moving.len()))
}

fn massless(n: &BoundValues) -> Vec<bool> {
    n.mass.iter().map(|&mass| mass == 0.0).collect()
}

/// One motion by them.
pub(super) struct Motion {
    program: Alone,
    /// How many of y are coordinates and rates, and how many states.
    own: usize,
    states: usize,
    /// The pivots at the start.
    pivots: Vec<f64>,
}

impl Motion {
    /// That of a mechanism that is placed, and solved, at its start.
    pub fn new(workspace: &mut Workspace) -> Option<Self> {
        let (recorded, m) = (Recorded::new(workspace, Recording::Rates)?, workspace.m);
        if !recorded.holds_at(workspace) {
            return None;
        }
        let (program, at) = (Alone::new(&recorded.program, &recorded.numbers(workspace)), workspace.at());
        let mut motion = Motion { program, own: 2 * m.freedom(), states: m.state_rates.len(), pivots: vec![] };
        motion.program.run(at.t, [&[at.q, at.u].concat(), &at.n.p[m.first_state()..]]);
        motion.pivots = motion.program.results(motion.own + motion.states).take(recorded.pivots).collect();
        Some(motion)
    }

    /// Writes the rates of [q, u, works, states]; false where one is not finite, or digits may be lost.
    pub fn write_rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> bool {
        let (rates, first_state) = (self.own + self.states, y.len() - self.states);
        self.program.run(t, [&y[..self.own], &y[first_state..]]);
        let (own, rest) = dy.split_at_mut(self.own);
        let (works, states) = rest.split_at_mut(first_state - self.own);
        for (to, from) in [(own, 0), (states, self.own), (works, rates + self.pivots.len())] {
            // Behind all results are friction and contacts, which do no work.
            to.iter_mut().zip(self.program.results(from).chain(repeat(0.0))).for_each(|(to, from)| *to = from);
        }
        let mut pivots = self.pivots.iter().zip(self.program.results(rates));
        let is_kept = pivots.all(|(&start, pivot)| is_firm(pivot, start));
        is_kept && dy.iter().all(|rate| rate.is_finite())
    }
}

impl HybridSystem<'_> {
    /// Lets a program carry the motion from a state on that can be solved, as long as its mode is free: as it does many side by side, to
    /// the same bits. Trees of more than a few bodies are swept sooner, and so are unless they march.
    pub(super) fn record_equations(&mut self, t: f64, y: &[f64], marches: bool) {
        let m = self.workspace.m;
        if self.mode.is_free() && (marches || !m.is_tree() || m.freedom() <= FEW) {
            self.place(t, y);
            let is_solved = self.workspace.solve_motion().is_ok();
            self.recorded = is_solved.then(|| Motion::new(&mut self.workspace)).flatten();
        }
    }
}
