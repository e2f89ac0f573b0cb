//! Motions side by side, each by steps of its own, by programs of what is read of them.

use super::side_by_side::{put, Lanes, SIDE_BY_SIDE};
use super::{Batch, Ending};
use crate::dynamics::{Workspace, CLOSED, OPEN};
use crate::hybrid::{is_firm, Recorded, Sizes};
use crate::mechanism::Recording;
use crate::motion::{integrate_lanes, Interval, LaneSystem, Outcome};
use crate::scalar::Block;
use crate::series::Program;
use multiversion::multiversion;
use std::slice::ChunksExactMut;

/// Corrections after which a position is given up.
const CORRECTIONS: usize = 12;

/// What is recorded of the members of a batch.
pub struct Recordings {
    rates: Recorded,
    corrections: Recorded,
    solution: Recorded,
}

impl Recordings {
    fn programs(&self) -> [&Program; 3] {
        [&self.rates, &self.corrections, &self.solution].map(|recorded| &*recorded.program)
    }
}

impl Batch<'_> {
    /// What is read of its members, as it is for the first.
    pub fn recordings(&self) -> Option<Recordings> {
        let mut workspace = Workspace::new(self.m, self.parameters(0));
        self.place(0, &mut workspace);
        let recording = |what| Recorded::new(&workspace, what);
        let (rates, corrections) = (recording(Recording::Rates)?, recording(Recording::Corrections)?);
        Some(Recordings { rates, corrections, solution: recording(Recording::Solution)? })
    }
}

/// What makes them, one block of members after the other.
pub struct Adaptive<'a> {
    batch: &'a Batch<'a>,
    recordings: &'a Recordings,
    workspace: Workspace<'a>,
    memories: [Vec<Lanes>; 3],
}

/// A block of members on their way.
struct Members<'a> {
    batch: &'a Batch<'a>,
    recordings: &'a Recordings,
    memories: &'a mut [Vec<Lanes>; 3],
    /// The rows of each that are not written yet.
    rows: Vec<ChunksExactMut<'a, f64>>,
    width: usize,
    units: Vec<Lanes>,
    /// What is left of inertias and rows where they are eliminated, at the start.
    pivots: Vec<Lanes>,
    read: Vec<Lanes>,
    /// Which gave numbers wherever they were shown.
    finite: [bool; SIDE_BY_SIDE],
}

impl<'a> Adaptive<'a> {
    pub fn new(batch: &'a Batch<'a>, recordings: &'a Recordings) -> Self {
        let workspace = Workspace::new(batch.m, batch.parameters(0));
        Adaptive { batch, recordings, workspace, memories: recordings.programs().map(Program::memory) }
    }

    /// Makes the members from one on; those that fail, each for itself.
    pub fn make(&mut self, first: usize, rows: &mut [f64], endings: &mut [Ending]) {
        let (batch, width) = (self.batch, self.batch.width());
        let all = (batch.times.len() * width).max(1);
        let (mut start, mut numbers, mut sizes, mut live) = (vec![], vec![], vec![], [false; SIDE_BY_SIDE]);
        for (lane, live) in live.iter_mut().enumerate() {
            let member = (first + lane).min(batch.members - 1);
            let (p, [q, u]) = (batch.parameters(member), batch.state(member));
            let workspace = &mut self.workspace;
            batch.place(member, workspace);
            put(&mut start, lane, [q, u, &p[batch.m.first_state()..]].concat());
            put(&mut numbers, lane, self.recordings.rates.numbers(workspace));
            let is_state = first + lane < batch.members && batch.m.check_state(p, batch.t, q, u).is_ok();
            sizes.push(Sizes::new(workspace, 0, (batch.until - batch.t).abs()));
            *live = is_state && self.recordings.rates.holds_at(workspace);
        }
        for (program, memory) in self.recordings.programs().into_iter().zip(&mut self.memories) {
            program.fix(memory, &numbers);
        }
        let mut members = Members {
            batch,
            recordings: self.recordings,
            memories: &mut self.memories,
            rows: rows.chunks_mut(all).map(|rows| rows.chunks_exact_mut(width)).collect(),
            width,
            units: (0..start.len()).map(|i| Block(std::array::from_fn(|lane| sizes[lane].of[i]))).collect(),
            pivots: vec![],
            read: vec![],
            finite: [true; SIDE_BY_SIDE],
        };
        let Batch { t, until, times, settings, .. } = *batch;
        let interval = Interval { from: t, to: until, times, options: &settings.options };
        let sizes = sizes.into_iter().map(|sizes| (sizes.of, sizes.rate)).collect();
        let ends = carry(&mut members, interval, &start, sizes, live);
        let finite = members.finite;
        for (lane, (rows, ending)) in rows.chunks_mut(all).zip(endings).enumerate() {
            *ending = match ends[lane] && finite[lane] {
                true => Ending::of(&Outcome::Completed, until, Outcome::Completed.to_string()),
                false => batch.alone(first + lane, rows),
            };
        }
    }
}

/// What cannot be trusted is no number.
impl LaneSystem<SIDE_BY_SIDE> for Members<'_> {
    fn rate(&mut self, t: &Lanes, y: &[Lanes], dy: &mut [Lanes]) {
        self.read.resize(y.len() + self.recordings.rates.pivots, Block::of(0.0));
        run(&self.recordings.rates.program, &mut self.memories[0], t, y, &mut self.read);
        let (rates, pivots) = self.read.split_at(y.len());
        dy.copy_from_slice(rates);
        if self.pivots.is_empty() {
            self.pivots = pivots.to_vec();
        }
        let are_firm = firm(pivots, &self.pivots);
        for lane in (0..SIDE_BY_SIDE).filter(|&lane| !are_firm[lane]) {
            dy.iter_mut().for_each(|dy| dy.0[lane] = f64::NAN);
        }
    }

    fn project(&mut self, t: &Lanes, y: &mut [Lanes], of: &[bool; SIDE_BY_SIDE]) {
        if self.batch.m.is_tree() {
            return;
        }
        let n = self.batch.m.freedom();
        let (mut open, mut last) = (*of, [f64::INFINITY; SIDE_BY_SIDE]);
        self.read.resize(2 * n, Block::of(0.0));
        for _ in 0..CORRECTIONS {
            run(&self.recordings.corrections.program, &mut self.memories[1], t, y, &mut self.read);
            if !correct(y, &self.read, &self.units, &mut open, &mut last) {
                return;
            }
        }
        for lane in (0..SIDE_BY_SIDE).filter(|&lane| open[lane]) {
            y.iter_mut().for_each(|y| y.0[lane] = f64::NAN);
        }
    }

    fn show(&mut self, t: &Lanes, y: &mut [Lanes], of: &[bool; SIDE_BY_SIDE]) {
        self.project(t, y, of);
        let (own, width) = (2 * self.batch.m.freedom(), self.width);
        self.read.resize(width - own, Block::of(0.0));
        run(&self.recordings.solution.program, &mut self.memories[2], t, y, &mut self.read);
        let is_finite = finite(&y[..own], &self.read);
        for (lane, rows) in self.rows.iter_mut().enumerate().filter(|(lane, _)| of[*lane]) {
            let (states, solution) = rows.next().expect("a row for each time").split_at_mut(own);
            states.iter_mut().zip(&*y).for_each(|(to, from)| *to = from.0[lane]);
            solution.iter_mut().zip(&self.read).for_each(|(to, from)| *to = from.0[lane]);
            self.finite[lane] &= is_finite[lane];
        }
    }
}

/// Of which members all numbers are finite.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn finite(y: &[Lanes], read: &[Lanes]) -> [bool; SIDE_BY_SIDE] {
    let mut nothing = [0.0; SIDE_BY_SIDE];
    for x in y.iter().chain(read) {
        (0..SIDE_BY_SIDE).for_each(|lane| nothing[lane] += x.0[lane] * 0.0);
    }
    nothing.map(|nothing| nothing == 0.0)
}

/// Of which members something is left of each inertia and row.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn firm(pivots: &[Lanes], at_start: &[Lanes]) -> [bool; SIDE_BY_SIDE] {
    let mut are_firm = [true; SIDE_BY_SIDE];
    for (pivot, start) in pivots.iter().zip(at_start) {
        (0..SIDE_BY_SIDE).for_each(|lane| are_firm[lane] &= is_firm(pivot.0[lane], start.0[lane]));
    }
    are_firm
}

/// Corrects the positions of those that are open, and the rates of those that were all but closed; answers whether any is open still.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn correct(
    y: &mut [Lanes],
    by: &[Lanes],
    units: &[Lanes],
    open: &mut [bool; SIDE_BY_SIDE],
    last: &mut [f64; SIDE_BY_SIDE],
) -> bool {
    let (n, mut size) = (by.len() / 2, [0.0; SIDE_BY_SIDE]);
    for (by, unit) in by[..n].iter().zip(units) {
        (0..SIDE_BY_SIDE).for_each(|lane| size[lane] = (by.0[lane] / unit.0[lane]).abs().max(size[lane]));
    }
    let (mut moves, mut turns) = ([false; SIDE_BY_SIDE], [false; SIDE_BY_SIDE]);
    for lane in 0..SIDE_BY_SIDE {
        let is_shut = size[lane] <= CLOSED || size[lane] <= OPEN && size[lane] >= 0.5 * last[lane];
        (moves[lane], turns[lane]) = (open[lane] && !is_shut, open[lane] && is_shut);
    }
    for (i, (y, by)) in y.iter_mut().zip(by).enumerate() {
        let corrected = if i < n { &*open } else { &turns };
        (0..SIDE_BY_SIDE).for_each(|lane| y.0[lane] += if corrected[lane] { by.0[lane] } else { 0.0 });
    }
    (*open, *last) = (moves, size);
    moves.contains(&true)
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn run(program: &Program, memory: &mut [Lanes], t: &Lanes, y: &[Lanes], results: &mut [Lanes]) {
    program.run(memory, *t, y, results);
}

/// Carries members along an interval in the widest registers that the machine has.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn carry(
    members: &mut Members<'_>,
    interval: Interval<'_>,
    start: &[Lanes],
    sizes: Vec<(Vec<f64>, f64)>,
    live: [bool; SIDE_BY_SIDE],
) -> [bool; SIDE_BY_SIDE] {
    integrate_lanes(members, interval, start, sizes, live)
}
