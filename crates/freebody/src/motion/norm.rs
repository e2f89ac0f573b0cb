//! How large an error is.

use super::system::{Point, System};
use crate::scalar::real;

/// The error norm: relative accuracy of every component, down to a physical floor.
///
/// A component weighs rtol·max(|y₀|, |y₁|, |h·ẏ₀|, |h·ẏ₁|) + floor: the change over the step
/// stands in for the size where the component passes through zero, so a decaying quantity keeps
/// its relative digits. The floor, max(1e-6·rtol, 1e-15)·scale, keeps a component that is zero but
/// for round-off from governing the step; where the system amplifies round-off it is raised to that
/// noise, at most to rtol·scale. What the end of the step adds to the size counts up to a limit, lest a
/// wild step be judged beside itself. The norm is the root mean square of the rms and the maximum of the
/// weighted errors: the worst component always counts for at least 0.7.
pub(super) struct Norm {
    pub rtol: f64,
    /// Physical size of each component.
    pub scale: Vec<f64>,
    /// Physical time of the system, s.
    pub time: f64,
    /// Round-off of the rate, relative to the physical sizes.
    pub noise: f64,
}

impl Norm {
    pub fn new(system: &dyn System, rtol: f64) -> Self {
        let mut scale = vec![1.0; system.dim()];
        system.scale(&mut scale);
        Self { rtol, scale, time: system.time_scale(), noise: 0.0 }
    }

    /// Tolerated error of each component for a step between two points.
    pub fn weights(&self, from: &Point, to: &Point, out: &mut [f64]) {
        let h = to.t - from.t;
        for (i, weight) in out.iter_mut().enumerate() {
            let known = from.y[i].abs().max((h * from.dy[i]).abs());
            let reached = to.y[i].abs().max((h * to.dy[i]).abs());
            *weight = self.tolerated(i, known, reached);
        }
    }

    /// Tolerated error of a component of a size that is known at the start of the step, and of another within it.
    pub fn tolerated(&self, i: usize, known: f64, reached: f64) -> f64 {
        self.tolerance().of(self.scale[i], known, reached)
    }

    /// That of all components.
    pub fn tolerance(&self) -> Tolerance {
        Tolerance { rtol: self.rtol, floor: (FLOOR * self.rtol).max(ROUND_OFF).max(self.noise.min(self.rtol)) }
    }

    /// Tolerated error of each component at the physical size of the system.
    fn physical(&self, at: &Point) -> Vec<f64> {
        at.y.iter().zip(&self.scale).map(|(y, scale)| self.rtol * y.abs().max(*scale)).collect()
    }
}

/// What is tolerated of a component, relative to its own size and to its physical one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    rtol: f64,
    floor: f64,
}

impl Tolerance {
    /// As [`Norm::tolerated`], of a component of a physical size.
    #[inline(always)]
    pub fn of(self, scale: f64, known: f64, reached: f64) -> f64 {
        let size = known.max(reached.min(GROWTH * known.max(scale)));
        self.rtol * size + self.floor * scale
    }
}

/// The norm of `values` in units of `weights`.
pub(super) fn measure(values: &[f64], weights: &[f64]) -> f64 {
    norm(
        values.iter().zip(weights).fold([0.0; 2], |squares, (value, weight)| noted(squares, value / weight)),
        values.len(),
    )
}

/// The sum of squares and the largest, with another.
#[inline(always)]
pub(super) fn noted([sum, top]: [f64; 2], ratio: f64) -> [f64; 2] {
    let square = ratio * ratio;
    [sum + square, top.max(square)]
}

/// The norm of so many values, by the sum of their squares and the largest.
pub(super) fn norm([sum, top]: [f64; 2], count: usize) -> f64 {
    (0.5 * (sum / count.max(1) as f64 + top)).sqrt()
}

/// Part of the tolerance, of the physical size, that is tolerated of a component that is zero but for round-off,
const FLOOR: f64 = 1e-6;
/// and at least this part of it: a few roundings of a rate.
pub(super) const ROUND_OFF: f64 = 1e-15;
/// How many times the size known at its start, or the physical one, the end of a step may count as.
const GROWTH: f64 = 10.0;
/// Parts of the system's own time for a first step where nothing gives its length, and where nothing moves.
pub(super) const SMALL_STEP: f64 = 1e-6;
/// Size or rate, over the physical sizes and time in units of the tolerance, below which it says nothing of a first step.
const NEGLIGIBLE: f64 = 1e-5;
/// Change in a first step, of the size and by the order: in the units of the tolerance, as in Hairer's code (HNW II.4).
const FIRST_CHANGE: f64 = 0.01;
/// The first step over the one that was tried, where nothing changes, and at most.
const SHORTER: f64 = 1e-3;
const LONGER: f64 = 100.0;
/// Rate and its change, in the same units, below which there is none.
const STEADY: f64 = 1e-15;

/// Hairer's first step (HNW I, II.4, eq. 4.14), from a rate at `from` and a rate function, which is tried no further
/// than `within`, a time of the sign of the run; time is in units of the system's own.
pub(super) fn first_step<E>(
    norm: &Norm,
    from: &Point,
    within: f64,
    estimate_order: u32,
    mut rate: impl FnMut(f64, &[f64], &mut [f64]) -> Result<(), E>,
) -> Result<f64, E> {
    let weights = norm.physical(from);
    let (d0, d1) = (measure(&from.y, &weights), measure(&from.dy, &weights) * norm.time);
    let sign = within.signum();
    let h0 = norm.time * if d0 < NEGLIGIBLE || d1 < NEGLIGIBLE { SMALL_STEP } else { FIRST_CHANGE * d0 / d1 };
    let h0 = h0.min(within.abs());
    let y: Vec<f64> = from.y.iter().zip(&from.dy).map(|(y, dy)| y + sign * h0 * dy).collect();
    let mut dy = vec![0.0; y.len()];
    rate(from.t + sign * h0, &y, &mut dy)?;
    let bend: Vec<f64> = dy.iter().zip(&from.dy).map(|(b, a)| b - a).collect();
    let steepest = d1.max(measure(&bend, &weights) / h0 * norm.time * norm.time);
    let h1 = match steepest <= STEADY {
        true => (h0 * SHORTER).max(SMALL_STEP * norm.time),
        false => norm.time * real::powf(FIRST_CHANGE / steepest, 1.0 / f64::from(estimate_order)),
    };
    Ok(sign * h1.min(LONGER * h0))
}
