//! The length of the next step.

use crate::scalar::real;

/// Aim below the tolerance, lest every other step be rejected.
const SAFETY: f64 = 0.9;
/// Least and greatest change of the step from one to the next.
const SHRINK: f64 = 0.2;
const GROWTH: f64 = 6.0;
/// Least error, in units of the tolerance, that is taken for one: below it the growth is at its limit anyway.
const LEAST_ERROR: f64 = 1e-10;
/// Least earlier error that steers, and that assumed at the start, as in Hairer's codes.
const LEAST_LAST_ERROR: f64 = 1e-4;
/// Change of a step that could not be made: nothing tells by how much it was too long.
const FAILED: f64 = 0.25;

/// Proportional-integral step control (HNW I, IV.2 in part II; Gustafsson 1991): after an error e,
/// in units of the tolerance, h ← 0.9·h·e^(−0.85/k)·e₋₁^(0.2/k), between 0.2·h and 6·h.
pub(super) struct StepController {
    /// Length of the next step, with the sign of the run.
    pub h: f64,
    exponent: Option<f64>,
    growth_threshold: f64,
    max_step: f64,
    last_error: f64,
    was_rejected: bool,
}

impl StepController {
    pub fn new(estimate_order: Option<u32>, growth_threshold: f64, max_step: f64) -> Self {
        let exponent = estimate_order.map(|k| 1.0 / f64::from(k));
        let was_rejected = false;
        Self { h: 0.0, exponent, growth_threshold, max_step, last_error: LEAST_LAST_ERROR, was_rejected }
    }

    /// Starts afresh with a step of length `h`.
    pub fn restart(&mut self, h: f64) {
        self.h = h.clamp(-self.max_step, self.max_step);
        self.last_error = LEAST_LAST_ERROR;
        self.was_rejected = false;
    }

    pub fn is_fixed(&self) -> bool {
        self.exponent.is_none()
    }

    /// After an accepted step.
    pub fn accepted(&mut self, error: f64) {
        let Some(exponent) = self.exponent else { return };
        let error = error.max(LEAST_ERROR);
        let factor = SAFETY * real::powf(error, -0.85 * exponent) * real::powf(self.last_error, 0.2 * exponent);
        let most = if self.was_rejected { 1.0 } else { GROWTH };
        let factor = factor.clamp(SHRINK, most);
        if factor < 1.0 || factor > self.growth_threshold {
            self.h = (self.h * factor).clamp(-self.max_step, self.max_step);
        }
        self.last_error = error.max(LEAST_LAST_ERROR);
        self.was_rejected = false;
    }

    /// After a step of length `h` whose error was too large.
    pub fn rejected(&mut self, h: f64, error: f64) {
        let exponent = self.exponent.unwrap_or(0.0);
        self.h = h * (SAFETY * real::powf(error, -exponent)).clamp(SHRINK, SAFETY);
        self.was_rejected = true;
    }

    /// After a step of length `h` that could not be made.
    pub fn failed(&mut self, h: f64) {
        self.h = FAILED * h;
        self.was_rejected = true;
    }
}
