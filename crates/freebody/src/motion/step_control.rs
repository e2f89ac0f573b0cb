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
/// The same of an implicit method (HW IV.8), which keeps a step unless it may grow by more than this.
const LEAST_LAST_ERROR_IMPLICIT: f64 = 1e-2;
const LEAST_GROWTH: f64 = 1.2;

/// Proportional-integral step control (HNW I, IV.2 in part II; Gustafsson 1991): after an error e,
/// in units of the tolerance, h ← 0.9·h·e^(−0.85/k)·e₋₁^(0.2/k), between 0.2·h and 6·h. Of an implicit method
/// predictive control (Gustafsson 1994; HW IV.8), h ← 0.9·h·e^(−1/k)·min(1, h/h₋₁·(e₋₁/e)^(1/k)).
pub(super) struct StepController {
    /// Length of the next step, with the sign of the run.
    pub h: f64,
    exponent: Option<f64>,
    implicit: bool,
    max_step: f64,
    last_error: f64,
    /// Length of the last accepted step; none at the start.
    last_h: Option<f64>,
    was_rejected: bool,
}

impl StepController {
    pub fn new(estimate_order: Option<u32>, implicit: bool, max_step: f64) -> Self {
        let exponent = estimate_order.map(|k| 1.0 / f64::from(k));
        let was_rejected = false;
        Self { h: 0.0, exponent, implicit, max_step, last_error: LEAST_LAST_ERROR, last_h: None, was_rejected }
    }

    /// Starts afresh with a step of length `h`.
    pub fn restart(&mut self, h: f64) {
        self.h = h.clamp(-self.max_step, self.max_step);
        self.last_error = LEAST_LAST_ERROR;
        self.last_h = None;
        self.was_rejected = false;
    }

    /// Makes the next step as long as the method says that it may be.
    pub fn propose(&mut self, h: f64) {
        self.h = h.clamp(-self.max_step, self.max_step);
    }

    pub fn is_fixed(&self) -> bool {
        self.exponent.is_none()
    }

    /// After an accepted step.
    pub fn accepted(&mut self, error: f64) {
        let Some(exponent) = self.exponent else { return };
        let error = error.max(LEAST_ERROR);
        let factor = if self.implicit { self.predicted(error, exponent) } else { self.integrated(error, exponent) };
        let most = if self.was_rejected { 1.0 } else { GROWTH };
        let factor = factor.clamp(SHRINK, most);
        let least = if self.implicit { LEAST_LAST_ERROR_IMPLICIT } else { LEAST_LAST_ERROR };
        (self.last_h, self.last_error) = (Some(self.h), error.max(least));
        if !self.implicit || !(1.0..=LEAST_GROWTH).contains(&factor) {
            self.h = (self.h * factor).clamp(-self.max_step, self.max_step);
        }
        self.was_rejected = false;
    }

    fn integrated(&self, error: f64, exponent: f64) -> f64 {
        SAFETY * real::exp(exponent * (0.2 * real::ln(self.last_error) - 0.85 * real::ln(error)))
    }

    fn predicted(&self, error: f64, exponent: f64) -> f64 {
        let trend = self.last_h.map_or(1.0, |h| self.h / h * real::powf(self.last_error / error, exponent));
        SAFETY * real::powf(error, -exponent) * trend.min(1.0)
    }

    /// After a step of length `h` whose error was too large.
    pub fn rejected(&mut self, h: f64, error: f64) {
        let exponent = self.exponent.unwrap_or(0.0);
        self.h = h * (SAFETY * real::powf(error, -exponent)).clamp(SHRINK, SAFETY);
        self.was_rejected = true;
    }

    /// After a step of length `h` that could not be made: the part of it to try.
    pub fn failed(&mut self, h: f64, part: f64) {
        self.h = part * h;
        self.was_rejected = true;
    }
}
