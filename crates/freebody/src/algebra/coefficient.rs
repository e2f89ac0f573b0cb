//! The number before a term: exact as long as it can be.

use super::ratio::Ratio;
use std::hash::{Hash, Hasher};

/// Below this part of what it is left from, a rounded difference is nothing.
const CANCELS: f64 = 1.0e-15;

/// A coefficient.
#[derive(Clone, Copy, Debug)]
pub enum Coefficient {
    /// A fraction.
    Exact(Ratio),
    /// A number that is no small fraction.
    Float(f64),
}
use Coefficient::{Exact, Float};

impl Coefficient {
    pub(super) const ZERO: Self = Exact(Ratio::ZERO);
    pub(super) const ONE: Self = Exact(Ratio::ONE);
    pub(super) const UNDEFINED: Self = Float(f64::NAN);

    pub(super) fn whole(n: i64) -> Self {
        Exact(Ratio::whole(n))
    }
    pub(super) fn value(self) -> f64 {
        match self {
            Exact(ratio) => ratio.value(),
            Float(x) => x,
        }
    }
    pub(super) fn exact(self) -> Option<Ratio> {
        match self {
            Exact(ratio) => Some(ratio),
            Float(_) => None,
        }
    }
    pub(super) fn is_zero(self) -> bool {
        self.value() == 0.0
    }
    pub(super) fn is_one(self) -> bool {
        matches!(self, Exact(Ratio::ONE))
    }
    pub(super) fn is_negative(self) -> bool {
        self.value() < 0.0
    }
    pub(super) fn negated(self) -> Self {
        match self {
            Exact(ratio) => Exact(ratio.negated()),
            Float(x) => Float(-x),
        }
    }
    pub(super) fn abs(self) -> Self {
        if self.is_negative() {
            self.negated()
        } else {
            self
        }
    }
    pub(super) fn plus(self, o: Self) -> Self {
        if let (Exact(a), Exact(b)) = (self, o) {
            if let Some(sum) = a.plus(b) {
                return Exact(sum);
            }
        }
        let (a, b) = (self.value(), o.value());
        match (a + b).abs() < CANCELS * a.abs().max(b.abs()) {
            true => Self::ZERO,
            false => Float(a + b),
        }
    }
    pub(super) fn times(self, o: Self) -> Self {
        let exact = self.exact().zip(o.exact()).and_then(|(a, b)| a.times(b));
        exact.map_or_else(|| Float(self.value() * o.value()), Exact)
    }
    pub(super) fn over(self, o: Self) -> Self {
        let exact = self.exact().zip(o.exact()).and_then(|(a, b)| a.over(b));
        exact.map_or_else(|| Float(self.value() / o.value()), Exact)
    }
    fn key(self) -> (bool, i64, i64) {
        match self {
            Exact(ratio) => (true, ratio.parts().0, ratio.parts().1),
            Float(x) => (false, x.to_bits() as i64, 0),
        }
    }
}

impl PartialEq for Coefficient {
    fn eq(&self, o: &Self) -> bool {
        self.key() == o.key()
    }
}
impl Eq for Coefficient {}
impl Hash for Coefficient {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}
