//! Many motions at once by the method `dop853` (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, §II.10), each by steps
//! of its own, and without events.

use super::dense::{between, cubic};
use super::dop853::TABLE;
use super::explicit::tempered;
use super::method::Point;
use super::norm::{first_step, norm, noted, Norm, Tolerance, SMALL_STEP};
use super::run::{end_of_step, Options, FAILED};
use super::step_control::StepController;
use crate::scalar::{block, Block};

/// How their error shrinks with the step.
const ORDER: u32 = 8;
/// F₁, F₂, … of [`super::Segment`].
const BENDS: usize = 6;

/// Systems side by side; what fails gives no numbers.
pub trait LaneSystem<const B: usize> {
    /// Writes their rates, each at its time and state.
    fn rate(&mut self, t: &Block<B>, y: &[Block<B>], dy: &mut [Block<B>]);
    /// Brings the states of some of them back onto what their motions keep.
    fn project(&mut self, t: &Block<B>, y: &mut [Block<B>], of: &[bool; B]);
    /// Takes of some of them the state at the next of the times that are asked for.
    fn show(&mut self, t: &Block<B>, y: &mut [Block<B>], of: &[bool; B]);
}

/// When motions begin, end, and are shown, s, and how their steps are chosen.
#[derive(Clone, Copy, Debug)]
pub struct Interval<'a> {
    /// Start.
    pub from: f64,
    /// End.
    pub to: f64,
    /// Times from start to end, in the order of the way.
    pub times: &'a [f64],
    /// Tolerances and steps.
    pub options: &'a Options,
}

/// One of them.
struct Lane {
    norm: Norm,
    steps: StepController,
    tried: usize,
    shown: usize,
}

/// All of them.
struct AdaptiveLanes<'a, const B: usize> {
    interval: Interval<'a>,
    lanes: Vec<Lane>,
    live: [bool; B],
    scale: Vec<Block<B>>,
    tolerance: Tolerance,
    t: Block<B>,
    /// Lengths and ends of the steps being made.
    h: Block<B>,
    end: Block<B>,
    y: Vec<Block<B>>,
    next: Vec<Block<B>>,
    stage: Vec<Block<B>>,
    k: Vec<Vec<Block<B>>>,
    bends: [Vec<Block<B>>; BENDS],
}

/// Carries the `live` ones of systems, of physical sizes of their states and their rates, along an interval. Answers which came to its end.
#[inline(always)]
pub fn integrate_lanes<const B: usize>(
    system: &mut impl LaneSystem<B>,
    interval: Interval,
    start: &[Block<B>],
    sizes: Vec<(Vec<f64>, f64)>,
    live: [bool; B],
) -> [bool; B] {
    let mut all = AdaptiveLanes::new(interval, start, sizes, live);
    all.begin(system);
    while all.choose() {
        let accepted = all.step(system);
        all.finish(system, &accepted);
    }
    std::array::from_fn(|i| all.live[i] && all.y.iter().chain(&all.k[0]).all(|x| x.0[i].is_finite()))
}

impl<'a, const B: usize> AdaptiveLanes<'a, B> {
    #[inline(always)]
    fn new(interval: Interval<'a>, start: &[Block<B>], sizes: Vec<(Vec<f64>, f64)>, live: [bool; B]) -> Self {
        let Options { rtol, max_step, .. } = *interval.options;
        let scale = (0..start.len()).map(|i| Block(std::array::from_fn(|lane| sizes[lane].0[i]))).collect();
        let lane = |(scale, rate): (Vec<f64>, f64)| Lane {
            norm: Norm { rtol, scale, time: 1.0 / rate, noise: 0.0 },
            steps: StepController::new(Some(ORDER), false, max_step),
            tried: 0,
            shown: 0,
        };
        let lanes: Vec<Lane> = sizes.into_iter().map(lane).collect();
        AdaptiveLanes {
            interval,
            tolerance: lanes[0].norm.tolerance(),
            lanes,
            live,
            scale,
            t: Block::of(interval.from),
            h: Block::of(0.0),
            end: Block::of(interval.from),
            y: start.to_vec(),
            next: start.to_vec(),
            stage: start.to_vec(),
            k: vec![start.to_vec(); TABLE.b.len() + 1 + TABLE.more_c.len()],
            bends: std::array::from_fn(|_| start.to_vec()),
        }
    }

    /// Closes the start, shows it where it is asked for, and finds the first steps.
    #[inline(always)]
    fn begin(&mut self, system: &mut impl LaneSystem<B>) {
        system.project(&self.t, &mut self.y, &self.live);
        system.rate(&self.t, &self.y, &mut self.k[0]);
        while self.lanes[0].shown < self.interval.times.len()
            && self.interval.times[self.lanes[0].shown] == self.interval.from
        {
            self.stage.clone_from(&self.y);
            system.show(&self.t, &mut self.stage, &[true; B]);
            self.lanes.iter_mut().for_each(|lane| lane.shown += 1);
        }
        let left = self.interval.to - self.interval.from;
        if let Some(h) = self.interval.options.first_step {
            self.lanes.iter_mut().for_each(|lane| lane.steps.restart(h.abs() * left.signum()));
            return;
        }
        let starts: Vec<Point> = (0..B).map(|lane| self.point(lane)).collect();
        let mut t = self.t;
        for (i, (lane, at)) in self.lanes.iter().zip(&starts).enumerate() {
            let _ = first_step(&lane.norm, at, left, ORDER, |trial, y, _| {
                t.0[i] = trial;
                self.stage.iter_mut().zip(y).for_each(|(to, y)| to.0[i] = *y);
                Err(())
            });
        }
        system.rate(&t, &self.stage, &mut self.next);
        for (i, (lane, at)) in self.lanes.iter_mut().zip(&starts).enumerate() {
            let h = first_step(&lane.norm, at, left, ORDER, |_, _, dy| {
                dy.iter_mut().zip(&self.next).for_each(|(to, dy)| *to = dy.0[i]);
                Ok::<_, ()>(())
            });
            let h = h.ok().filter(|h| h.is_finite() && *h != 0.0);
            lane.steps.restart(h.unwrap_or(left.signum() * SMALL_STEP * lane.norm.time));
        }
    }

    /// The present of one of them.
    fn point(&self, lane: usize) -> Point {
        let [y, dy] = [&self.y, &self.k[0]].map(|of| of.iter().map(|x| x.0[lane]).collect());
        Point { t: self.t.0[lane], y, dy }
    }

    /// Takes the lengths of the next steps; false where none is left to be made.
    #[inline(always)]
    fn choose(&mut self) -> bool {
        let mut is_going = false;
        for (i, lane) in self.lanes.iter_mut().enumerate() {
            let (t, to) = (self.t.0[i], self.interval.to);
            self.h.0[i] = 0.0;
            if !self.live[i] || t == to {
                continue;
            }
            let end = end_of_step(t, to, lane.steps.h);
            (self.end.0[i], self.h.0[i]) = (end, end - t);
            let is_short = self.h.0[i].abs() < 4.0 * f64::EPSILON * t.abs() && end != to || self.h.0[i] == 0.0;
            self.live[i] = !is_short && lane.tried < self.interval.options.max_steps;
            lane.tried += 1;
            is_going |= self.live[i];
        }
        is_going
    }

    /// Tries a step of each; answers which are accurate enough.
    #[inline(always)]
    fn step(&mut self, system: &mut impl LaneSystem<B>) -> [bool; B] {
        for (j, (&c, a)) in TABLE.c.iter().zip(TABLE.a).enumerate() {
            self.stage(system, j + 1, c, a);
        }
        combine(TABLE.b, &self.k, &self.h, Some(&self.y), &mut self.next);
        let errors = [0, 1].map(|estimate| self.squares(TABLE.errors[estimate]));
        self.judge(errors)
    }

    /// Which steps are accurate enough, by their errors; chooses the next lengths. A function of its own: elementary functions are not for
    /// the widest registers.
    #[inline(never)]
    fn judge(&mut self, errors: [[Block<B>; 2]; 2]) -> [bool; B] {
        let mut accepted = [false; B];
        for (i, lane) in self.lanes.iter_mut().enumerate() {
            let (h, n) = (self.h.0[i], self.y.len());
            let [main, tempering] = [0, 1].map(|estimate| norm(errors[estimate].map(|squares| squares.0[i]), n));
            let error = tempered(main, || tempering);
            if h == 0.0 {
                continue;
            }
            match error.is_finite() {
                true if error <= 1.0 => {
                    accepted[i] = true;
                    lane.steps.accepted(error);
                }
                true => lane.steps.rejected(h, error),
                false => lane.steps.failed(h, FAILED),
            }
        }
        accepted
    }

    /// The rates at a stage.
    #[inline(always)]
    fn stage(&mut self, system: &mut impl LaneSystem<B>, index: usize, c: f64, a: &[f64]) {
        let (known, rest) = self.k.split_at_mut(index);
        combine(a, known, &self.h, Some(&self.y), &mut self.stage);
        let t = Block(block::each([&self.t.0, &self.h.0], |[t, h]| t + c * h));
        system.rate(&t, &self.stage, &mut rest[0]);
    }

    /// Of an error estimate, over what is tolerated: the sums of squares and the largest.
    #[inline(always)]
    fn squares(&mut self, weights: &[f64]) -> [Block<B>; 2] {
        combine(weights, &self.k, &self.h, None, &mut self.stage);
        let (tolerance, last) = (self.tolerance, TABLE.b.len() - 1);
        let [mut sum, mut top] = [[0.0; B]; 2];
        for i in 0..self.y.len() {
            let [y, next, error] = [&self.y[i].0, &self.next[i].0, &self.stage[i].0];
            let [slope, end, scale] = [&self.k[0][i].0, &self.k[last][i].0, &self.scale[i].0];
            for lane in 0..B {
                let h = self.h.0[lane];
                let known = y[lane].abs().max((h * slope[lane]).abs());
                let reached = next[lane].abs().max((h * end[lane]).abs());
                let ratio = error[lane] / tolerance.of(scale[lane], known, reached);
                [sum[lane], top[lane]] = noted([sum[lane], top[lane]], ratio);
            }
        }
        [Block(sum), Block(top)]
    }

    /// Closes the ends of the steps that are accepted, shows what is asked for within them, and goes there.
    #[inline(always)]
    fn finish(&mut self, system: &mut impl LaneSystem<B>, accepted: &[bool; B]) {
        let stages = TABLE.b.len();
        system.project(&self.end, &mut self.next, accepted);
        system.rate(&self.end, &self.next, &mut self.k[stages]);
        let mut asked = self.asked(accepted);
        if asked.contains(&true) {
            self.bend(system);
        }
        while asked.contains(&true) {
            let t = self.between(&asked);
            system.show(&t, &mut self.stage, &asked);
            self.lanes.iter_mut().zip(&asked).filter(|(_, asked)| **asked).for_each(|(lane, _)| lane.shown += 1);
            asked = self.asked(accepted);
        }
        let (slopes, ends) = self.k.split_at_mut(1);
        let slopes = slopes[0].iter_mut().zip(&ends[stages - 1]);
        for (to, from) in self.y.iter_mut().zip(&self.next).chain(slopes) {
            (0..B).for_each(|lane| to.0[lane] = if accepted[lane] { from.0[lane] } else { to.0[lane] });
        }
        (0..B).filter(|&lane| accepted[lane]).for_each(|lane| self.t.0[lane] = self.end.0[lane]);
    }

    /// Which have the next of their times within a step that is accepted.
    fn asked(&self, accepted: &[bool; B]) -> [bool; B] {
        let mut asked = *accepted;
        for (i, (asked, lane)) in asked.iter_mut().zip(&self.lanes).enumerate() {
            let is_within = |&next: &f64| (next - self.end.0[i]) * self.h.0[i] <= 0.0;
            *asked &= self.interval.times.get(lane.shown).is_some_and(is_within);
        }
        asked
    }

    /// Finds how the motions bend within the steps.
    #[inline(always)]
    fn bend(&mut self, system: &mut impl LaneSystem<B>) {
        for (j, (&c, a)) in TABLE.more_c.iter().zip(TABLE.more_a).enumerate() {
            self.stage(system, TABLE.b.len() + 1 + j, c, a);
        }
        let [first, second, others @ ..] = &mut self.bends;
        for (i, (first, second)) in first.iter_mut().zip(second).enumerate() {
            let [y, next] = [&self.y[i].0, &self.next[i].0];
            let [slope, end] = [0, TABLE.b.len()].map(|stage| &self.k[stage][i].0);
            for lane in 0..B {
                let ends = [[y[lane], next[lane]], [slope[lane], end[lane]]];
                [first.0[lane], second.0[lane]] = cubic(self.h.0[lane], ends[0], ends[1]);
            }
        }
        for (bend, weights) in others.iter_mut().zip(TABLE.dense) {
            combine(weights, &self.k, &self.h, None, bend);
        }
    }

    /// Writes the states at the times that are asked for; answers with these.
    #[inline(always)]
    fn between(&mut self, asked: &[bool; B]) -> Block<B> {
        let mut t = self.end;
        for (i, lane) in self.lanes.iter().enumerate().filter(|(i, _)| asked[*i]) {
            t.0[i] = self.interval.times[lane.shown];
        }
        let theta = block::each([&t.0, &self.t.0, &self.h.0], |[t, from, h]| (t - from) / h);
        for (i, stage) in self.stage.iter_mut().enumerate() {
            let [a, b, c, d, e, f] = std::array::from_fn(|k| &self.bends[k][i].0);
            let of = [&t.0, &self.end.0, &theta, &self.y[i].0, &self.next[i].0, a, b, c, d, e, f];
            stage.0 = block::each(of, |[t, end, theta, y0, y1, bends @ ..]: [f64; 5 + BENDS]| {
                let within = between(theta, [y0, y1], bends.into_iter());
                if t == end {
                    y1
                } else {
                    within
                }
            });
        }
        t
    }
}

/// Writes h Σ aⱼ kⱼ, or where it begins at y that beside y; stages without weight are left out.
#[inline(always)]
fn combine<const B: usize>(a: &[f64], k: &[Vec<Block<B>>], h: &Block<B>, y: Option<&[Block<B>]>, to: &mut [Block<B>]) {
    for (i, to) in to.iter_mut().enumerate() {
        let mut slope = [0.0; B];
        for (&a, k) in a.iter().zip(k).filter(|(&a, _)| a != 0.0) {
            block::add(&mut slope, a, &k[i].0);
        }
        to.0 = match y {
            Some(y) => block::each([&y[i].0, &h.0, &slope], |[y, h, slope]| y + h * slope),
            None => block::each([&h.0, &slope], |[h, slope]| h * slope),
        };
    }
}
