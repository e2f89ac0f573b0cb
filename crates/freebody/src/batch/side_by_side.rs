//! Motions side by side, by one program.

use super::{Batch, Ending};
use crate::dynamics::{reaction_names, Workspace};
use crate::hybrid::Recorded;
use crate::mechanism::Recording;
use crate::motion::{march, Outcome, Span};
use crate::scalar::Block;
use multiversion::multiversion;

/// How many: the time to read an operation is then little beside that to do it, and what it works on is near at hand.
pub const SIDE_BY_SIDE: usize = 64;

pub type Lanes = Block<SIDE_BY_SIDE>;

/// What makes them, one block of members after the other.
pub struct SideBySide<'a> {
    batch: &'a Batch<'a>,
    recorded: &'a Recorded,
    workspace: Workspace<'a>,
    memory: Vec<Lanes>,
    start: Vec<Lanes>,
    numbers: Vec<Lanes>,
    shown: Vec<Lanes>,
}

impl Batch<'_> {
    /// The equations of its members, as they are for the first.
    pub fn record(&self) -> Option<Recorded> {
        let mut workspace = Workspace::new(self.m, self.parameters(0));
        self.place(0, &mut workspace);
        Recorded::new(&workspace, Recording::Rates)
    }
}

impl<'a> SideBySide<'a> {
    pub fn new(batch: &'a Batch<'a>, recorded: &'a Recorded) -> Self {
        let workspace = Workspace::new(batch.m, batch.parameters(0));
        let (memory, [start, numbers, shown]) = (recorded.program.memory(), [(); 3].map(|()| vec![]));
        SideBySide { batch, recorded, workspace, memory, start, numbers, shown }
    }

    /// Makes the members from one on; those that fail, each for itself.
    pub fn make(&mut self, first: usize, rows: &mut [f64], endings: &mut [Ending]) {
        let batch = self.batch;
        let starts = self.take(first);
        self.recorded.program.fix(&mut self.memory, &self.numbers);
        let step = batch.settings.options.first_step.unwrap_or(f64::NAN).abs() * (batch.until - batch.t).signum();
        let span = Span { from: batch.t, to: batch.until, step, times: batch.times };
        self.shown.clear();
        let ends = carry(self.recorded, &mut self.memory, span, &self.start, &mut self.shown);
        let width = batch.times.len() * batch.width();
        for (lane, (rows, ending)) in rows.chunks_mut(width).zip(endings).enumerate() {
            let is_made = starts[lane] && ends[lane] && self.write(first + lane, lane, rows);
            *ending = match is_made {
                true => Ending::of(&Outcome::Completed, batch.until, Outcome::Completed.to_string()),
                false => batch.alone(first + lane, rows),
            };
        }
    }

    /// Takes the starts and numbers of the members from one on; the last fills the lanes that are left. Answers which can be solved by the
    /// same operations.
    fn take(&mut self, first: usize) -> [bool; SIDE_BY_SIDE] {
        let (batch, m) = (self.batch, self.batch.m);
        let mut solution = vec![0.0; m.freedom() + reaction_names(m).len()];
        std::array::from_fn(|lane| {
            let member = (first + lane).min(batch.members - 1);
            let (p, [q, u]) = (batch.parameters(member), batch.state(member));
            let is_solved = self.solve(p, batch.t, [q, u], &mut solution);
            put(&mut self.start, lane, [q, u, &p[m.first_state()..]].concat());
            put(&mut self.numbers, lane, self.recorded.numbers(&self.workspace));
            is_solved && self.recorded.holds_at(&mut self.workspace)
        })
    }

    /// Writes what was shown of a member; false where it cannot be solved for reactions that are wanted.
    fn write(&mut self, member: usize, lane: usize, rows: &mut [f64]) -> bool {
        let (batch, m) = (self.batch, self.batch.m);
        let (n, mut p) = (m.freedom(), batch.parameters(member).to_vec());
        let mut y = vec![0.0; self.start.len()];
        rows.chunks_mut(batch.width()).enumerate().all(|(i, row)| {
            let shown = &self.shown[i * y.len()..];
            y.iter_mut().zip(shown).for_each(|(y, shown)| *y = shown.0[lane]);
            let (own, states) = y.split_at(2 * n);
            p[m.first_state()..].copy_from_slice(states);
            let (kept, solution) = row.split_at_mut(2 * n);
            kept.copy_from_slice(own);
            !batch.reactions || self.solve(&p, batch.times[i], own.split_at(n).into(), solution)
        })
    }

    /// Writes accelerations and reactions at a state; false where it has none.
    fn solve(&mut self, p: &[f64], t: f64, state: [&[f64]; 2], solution: &mut [f64]) -> bool {
        let (accelerations, reactions) = solution.split_at_mut(self.batch.m.freedom());
        self.workspace.evaluate_at(p, t, state, accelerations, reactions).is_ok()
    }
}

/// Puts values into a lane of blocks.
pub fn put(blocks: &mut Vec<Lanes>, lane: usize, values: impl IntoIterator<Item = f64>) {
    for (i, value) in values.into_iter().enumerate() {
        if i == blocks.len() {
            blocks.push(Block::of(0.0));
        }
        blocks[i].0[lane] = value;
    }
}

/// Carries them along a span in the widest registers that the machine has.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn carry(
    recorded: &Recorded,
    memory: &mut [Lanes],
    span: Span,
    start: &[Lanes],
    shown: &mut Vec<Lanes>,
) -> [bool; SIDE_BY_SIDE] {
    march(span, start, |t, y, dy| recorded.program.run(memory, Block::of(t), y, dy), |y| shown.extend_from_slice(y))
}
