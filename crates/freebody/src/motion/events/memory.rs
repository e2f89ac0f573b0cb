//! What is known of a switching function.

use super::nodes::is_clear_of_zero;
use super::{CLEAR_OF_ZERO, GRAZE_OF_ACTION, NOISE, TOUCH};
use crate::motion::system::EventSpec;

/// Where a switching function is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Sign of its last value clearly away from zero; 0 before there was one.
    pub side: i8,
    /// How far it has been from zero on that side.
    pub reach: f64,
    /// It is at a touch, which may be recorded already.
    pub grazes: Option<bool>,
    pub last_touch: f64,
    /// It is a guard that has not been farther from zero than its leeway since the law changed.
    pub begins: bool,
}

/// What is known of one switching function.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    pub now: Place,
    /// The place at the end of the segment last searched.
    pub ahead: Place,
    /// Largest value seen, or its physical scale.
    pub size: f64,
    /// It acted where the next segment starts: that zero is used up.
    pub is_spent: bool,
    /// It is not watched any more.
    pub is_muted: bool,
    pub is_guard: bool,
    /// How far below zero it may be where it begins there.
    pub leeway: f64,
    /// Part of its reach within which it touches zero.
    pub graze: f64,
    /// The same within which it is not sure whether it acts,
    pub doubt: f64,
    /// and within which it is not sure, of any event, when it comes.
    pub blur: f64,
}

impl Memory {
    /// Takes samples on a step into the size of the function and, of a guard, its leeway and graze there.
    pub fn learn(&mut self, spec: EventSpec, rtol: f64, values: &[f64]) {
        self.size = values.iter().fold(self.size.max(spec.scale), |most, value| most.max(value.abs()));
        if self.is_guard {
            self.leeway = spec.leeway;
            self.now.begins &= spec.leeway > 0.0;
            self.graze = if spec.of_forces { GRAZE_OF_ACTION * rtol } else { 0.0 };
        }
    }

    /// Sign of a value that is clearly not zero, else 0.
    pub fn sign(&self, value: f64) -> i8 {
        beyond(value, NOISE * self.size)
    }

    /// Whether a function that goes so far from a value, at most, stays clearly on the side where it is.
    pub fn is_kept_away(&self, [value, most]: [f64; 2]) -> bool {
        let (is_calm, noise) = (!self.is_spent && self.now.grazes.is_none(), TOUCH * self.size.max(value.abs()));
        is_calm && value.abs() - noise > CLEAR_OF_ZERO * most && self.now.side == value.signum() as i8
    }

    /// Whether samples show that it stays clearly on the side where it is; if so, they are what is known of it.
    pub fn stays_away<const N: usize>(&mut self, values: &[f64; N]) -> bool {
        let (is_calm, side) = (!self.is_spent && self.now.grazes.is_none(), f64::from(self.now.side));
        let noise = if self.now.begins { self.leeway.max(NOISE * self.size) } else { NOISE * self.size };
        let stays = is_calm && values.iter().all(|value| side * value > noise) && is_clear_of_zero(values);
        if stays {
            self.stay(values.iter().fold(0.0, |most, value| value.abs().max(most)));
        }
        stays
    }

    /// It has been so far from zero, where it is.
    pub fn stay(&mut self, reach: f64) {
        self.ahead = Place { reach: self.now.reach.max(reach), begins: false, ..self.now };
    }

    /// Values below this, at an extremum, touch zero.
    pub fn near(&self, place: Place) -> f64 {
        (TOUCH * self.size).max(self.graze * place.reach)
    }
}

/// Sign of a value beyond the noise, else 0.
pub(super) fn beyond(value: f64, noise: f64) -> i8 {
    match value.abs() > noise {
        true => value.signum() as i8,
        false => 0,
    }
}
