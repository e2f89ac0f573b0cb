//! The length of the next step.

use crate::scalar::real;

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
        Self { h: 0.0, exponent, growth_threshold, max_step, last_error: 1e-4, was_rejected }
    }

    /// Starts afresh with a step of length `h`.
    pub fn restart(&mut self, h: f64) {
        self.h = h.clamp(-self.max_step, self.max_step);
        self.last_error = 1e-4;
        self.was_rejected = false;
    }

    pub fn is_fixed(&self) -> bool {
        self.exponent.is_none()
    }

    /// After an accepted step.
    pub fn accepted(&mut self, error: f64) {
        let Some(exponent) = self.exponent else { return };
        let error = error.max(1e-10);
        let factor = 0.9 * real::powf(error, -0.85 * exponent) * real::powf(self.last_error, 0.2 * exponent);
        let most = if self.was_rejected { 1.0 } else { 6.0 };
        let factor = factor.clamp(0.2, most);
        if factor < 1.0 || factor > self.growth_threshold {
            self.h = (self.h * factor).clamp(-self.max_step, self.max_step);
        }
        self.last_error = error.max(1e-4);
        self.was_rejected = false;
    }

    /// After a step of length `h` whose error was too large.
    pub fn rejected(&mut self, h: f64, error: f64) {
        let exponent = self.exponent.unwrap_or(0.0);
        self.h = h * (0.9 * real::powf(error, -exponent)).clamp(0.2, 0.9);
        self.was_rejected = true;
    }

    /// After a step of length `h` that could not be made.
    pub fn failed(&mut self, h: f64) {
        self.h = 0.25 * h;
        self.was_rejected = true;
    }
}
