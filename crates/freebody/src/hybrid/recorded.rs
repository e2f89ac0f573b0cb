//! The equations of motion of a tree as a program, for one motion or for many side by side.

use super::works::Works;
use super::HybridSystem;
use crate::bound_values::BoundValues;
use crate::dynamics::{DynamicsError, TreeMotion, Workspace};
use crate::scalar::{Block, Scalar};
use crate::series::{recorded, Program, Traced};
use std::sync::Arc;

/// By how much the state recorded is aside: there no length vanishes without which a spring has no direction.
const ASIDE: f64 = 0.618_033_988_749_894_9;

/// The rates of [q, u, states], then the powers of forces that have no potential, as functions of time, of [q, u, states], and of
/// what follows from parameters.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The operations.
    pub program: Arc<Program>,
    massless: Vec<bool>,
    /// The numbers of the model that follow from parameters.
    bound: Vec<usize>,
    first_state: usize,
}

impl Recorded {
    /// Those of a mechanism that is placed, recorded once for all its motions; None where its motion may be other operations elsewhere.
    pub fn new(workspace: &Workspace) -> Option<Self> {
        let (m, massless) = (workspace.m, massless(workspace.at().n));
        if !TreeMotion::<Traced>::fits(m) {
            return None;
        }
        let bound: Vec<_> = (0..m.values.len()).filter(|&i| m.values[i].variables().next().is_some()).collect();
        let program = m.recorded.program(&massless, || program(workspace, &bound))?;
        Some(Recorded { program, massless, bound, first_state: m.first_state() })
    }

    /// Whether they hold at other numbers: the mass centre is another formula where there is no mass.
    pub fn fits(&self, n: &BoundValues) -> bool {
        massless(n) == self.massless
    }

    /// The inputs that do not move.
    pub fn numbers<'a>(&'a self, n: &'a BoundValues) -> impl Iterator<Item = f64> + 'a {
        numbers(n, self.first_state, &self.bound)
    }
}

fn numbers<'a>(n: &'a BoundValues, first_state: usize, bound: &'a [usize]) -> impl Iterator<Item = f64> + 'a {
    n.p[..first_state].iter().copied().chain(bound.iter().map(|&i| n.values[i]))
}

fn program(workspace: &Workspace, bound: &[usize]) -> Option<Program> {
    let (m, at) = (workspace.m, workspace.at());
    let (first_state, forces) = (m.first_state(), Works::of(m).forces);
    let moving = [&[at.t], at.q, at.u, &at.n.p[first_state..]].concat();
    let aside = moving.iter().enumerate().map(|(i, x)| x + ((i + 1) as f64 * ASIDE).fract());
    let tape = recorded(aside.chain(numbers(at.n, first_state, bound)), |x| {
        let (y, fixed) = x[1..].split_at(moving.len() - 1);
        let (p, numbers) = fixed.split_at(first_state);
        let mut values: Vec<Traced> = at.n.values.iter().map(|&x| Traced::of(x)).collect();
        bound.iter().zip(numbers).for_each(|(&i, &x)| values[i] = x);
        let p = [p, &y[2 * m.freedom()..]].concat();
        let mut tree = TreeMotion::new(m, m.with_values(&p, values));
        let mut rates = vec![Traced::zero(); y.len()];
        tree.rate(x[0], y, &mut rates)?;
        rates.extend(forces.iter().map(|&force| tree.unaccounted_power(x[0], y, force)));
        Ok::<_, DynamicsError>(rates)
    });
    Some(Program::new(tape.ok()?.rounded(), moving.len()))
}

fn massless(n: &BoundValues) -> Vec<bool> {
    n.mass.iter().map(|&mass| mass == 0.0).collect()
}

/// One motion by them.
pub(super) struct Motion {
    program: Arc<Program>,
    memory: Vec<Block<1>>,
    y: Vec<Block<1>>,
    rates: Vec<Block<1>>,
    /// How many of y are coordinates and rates.
    own: usize,
}

impl Motion {
    /// That of a mechanism that is placed.
    pub fn new(workspace: &Workspace, forces: usize) -> Option<Self> {
        let (recorded, at) = (Recorded::new(workspace)?, workspace.at());
        let numbers: Vec<_> = recorded.numbers(at.n).map(Block::of).collect();
        let (program, own) = (recorded.program, 2 * at.q.len());
        let mut memory = program.memory();
        program.fix(&mut memory, &numbers);
        let y = vec![Block::of(0.0); own + at.n.p.len() - recorded.first_state];
        let rates = vec![Block::of(0.0); y.len() + forces];
        Some(Motion { program, memory, y, rates, own })
    }

    /// Writes the rates of [q, u, works, states]; false where one is not finite.
    pub fn write_rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> bool {
        let states = self.y.len() - self.own;
        let moving = y[..self.own].iter().chain(&y[y.len() - states..]);
        self.y.iter_mut().zip(moving).for_each(|(to, &y)| *to = Block::of(y));
        self.program.run(&mut self.memory, t, &self.y, &mut self.rates);
        let (own, rest) = self.rates.split_at(self.own);
        let (states, powers) = rest.split_at(states);
        let rates = own.iter().chain(powers).chain(states);
        dy.iter_mut().zip(rates).for_each(|(dy, rate)| *dy = rate.0[0]);
        dy.iter().all(|rate| rate.is_finite())
    }
}

impl HybridSystem<'_> {
    /// Lets a program carry the motion from a state on that can be solved: as it does many side by side, to the same bits.
    pub(super) fn record_equations(&mut self, t: f64, y: &[f64]) {
        self.place(t, y);
        let is_solved = self.workspace.solve_motion().is_ok();
        self.recorded = is_solved.then(|| Motion::new(&self.workspace, self.works.forces.len())).flatten();
    }
}
