//! A motion to 25 digits and more: its Taylor series over double-doubles.

use super::series::equations;
use super::{HybridSystem, Start};
use crate::dynamics::{DynamicsError, SmoothMotion, Workspace};
use crate::mechanism::Mechanism;
use crate::motion::System;
use crate::scalar::{real, DoubleDouble, Scalar};
use crate::series::{Solution, Traced};

/// The last term of a step, relative to the size of its component: round-off.
const TOLERANCE: f64 = 1e-32;
/// Part of the step at which it is that, since terms beyond are left out (Jorba & Zou).
const SAFETY: f64 = 0.97;
/// By how much the rate of the motion may differ from that of the instant, in doubles.
const SAME_RATE: f64 = 1e-8;

/// Coordinates and rates of a motion at times that follow each other from the start on, a row for each; by series of an order. The
/// mechanism has the numbers that it has in doubles, exactly. `go_on` is asked after each step; None where it answers false.
///
/// # Errors
/// A motion without such a series, by why it has none; a state that is none.
pub fn reference(
    m: &Mechanism,
    start: &Start,
    times: &[f64],
    order: usize,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Vec<Vec<DoubleDouble>>>, DynamicsError> {
    m.check_state(start.p, start.t, start.q, start.u)?;
    let obstacle = SmoothMotion::<Traced>::obstacle(m).or((!m.events.is_empty()).then_some("events may happen"));
    if let Some(why) = obstacle {
        return Err(DynamicsError::NoSeries(why));
    }
    let Some(&until) = times.last() else { return Ok(Some(vec![])) };
    let mut workspace = Workspace::new(m, start.p);
    workspace.move_to(start.t, start.q, start.u);
    let mode = workspace.with_row_offsets();
    let mut system = HybridSystem::new(workspace, mode, start.p);
    let y = system.pack(start.q, start.u);
    system.set_scales(start.t, until, &y);
    let tape = equations(m, &system.works, start.p, (start.t, &y))?;
    let mut motion = Motion { system, series: Solution::new(tape, order), order };
    motion.follow(start.t, &y, times, go_on)
}

struct Motion<'m> {
    system: HybridSystem<'m>,
    series: Solution<DoubleDouble>,
    order: usize,
}

impl Motion<'_> {
    fn follow(
        &mut self,
        t0: f64,
        y0: &[f64],
        times: &[f64],
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<Vec<Vec<DoubleDouble>>>, DynamicsError> {
        let width = 2 * self.system.workspace.m.freedom();
        let until = times[times.len() - 1];
        let (mut t, mut y) = (t0, y0.iter().map(|&y| DoubleDouble::of(y)).collect::<Vec<_>>());
        let mut found = Vec::with_capacity(times.len());
        loop {
            if !self.series.expand(DoubleDouble::of(t), &y) {
                return Err(DynamicsError::NoFiniteAcceleration);
            }
            let ahead = (until - t).signum();
            let end = t + ahead * self.step(&y).min((until - t).abs());
            let after = |time: f64| DoubleDouble::of(time) - DoubleDouble::of(t);
            for &time in times[found.len()..].iter().take_while(|&&time| (time - end) * ahead <= 0.0) {
                found.push((0..width).map(|i| self.at(i, after(time)).0).collect());
            }
            if found.len() == times.len() {
                return Ok(Some(found));
            }
            let ahead: Vec<_> = (0..y.len()).map(|i| self.at(i, after(end))).collect();
            y = ahead.iter().map(|(y, _)| *y).collect();
            self.check_rate(end, &y, ahead.iter().map(|(_, rate)| rate.hi))?;
            t = end;
            if !go_on() {
                return Ok(None);
            }
        }
    }

    /// A component and its rate some time after where the series begins.
    fn at(&self, i: usize, h: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
        let zero = DoubleDouble::zero();
        self.series.component(i).iter().rev().fold((zero, zero), |(y, rate), &c| (y * h + c, rate * h + y))
    }

    /// The step at which the last two terms are round-off.
    fn step(&self, y: &[DoubleDouble]) -> f64 {
        let largest = |k: usize| {
            let parts = y.iter().zip(&self.system.scales).enumerate();
            parts.fold(0.0, |most: f64, (i, (y, scale))| {
                most.max(self.series.component(i)[k].hi.abs() / y.hi.abs().max(*scale))
            })
        };
        let reach = |k: usize| real::powf(largest(k), -1.0 / k as f64);
        SAFETY * reach(self.order - 1).min(reach(self.order)) * real::powf(TOLERANCE, 1.0 / self.order as f64)
    }

    /// Whether the series still is that of the motion: it was recorded at the start.
    fn check_rate(
        &mut self,
        t: f64,
        y: &[DoubleDouble],
        rates: impl Iterator<Item = f64>,
    ) -> Result<(), DynamicsError> {
        let y: Vec<f64> = y.iter().map(|y| y.hi).collect();
        let mut dy = vec![0.0; y.len()];
        self.system.rate(t, &y, &mut dy)?;
        let time = self.system.time_scale();
        let mut pairs = rates.zip(dy.iter().zip(&self.system.scales));
        match pairs.all(|(rate, (dy, scale))| (rate - dy).abs() <= SAME_RATE * (dy.abs() + scale / time)) {
            true => Ok(()),
            false => Err(DynamicsError::NoSeries("a force changes its direction at a point where it has none")),
        }
    }
}
