//! Second-order Taylor jets in time: a quantity with its rate and its acceleration.

use super::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A quantity x(t) at one instant: `d0` = x, `d1` = ẋ, `d2` = ẍ (derivatives, not Taylor
/// coefficients). Arithmetic is Leibniz's rule (Griewank & Walther, *Evaluating Derivatives*, ch. 13).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<S = f64> {
    /// Value.
    pub d0: S,
    /// First time derivative.
    pub d1: S,
    /// Second time derivative.
    pub d2: S,
}

impl<S: Scalar> Jet<S> {
    /// A quantity with its rate and acceleration.
    #[inline(always)]
    pub fn new(d0: S, d1: S, d2: S) -> Self {
        Jet { d0, d1, d2 }
    }
    /// A quantity that does not change with time.
    #[inline(always)]
    pub fn constant(d0: S) -> Self {
        Jet { d0, d1: S::zero(), d2: S::zero() }
    }
    /// f(x(t)) from f, f′, f″ at x.
    #[inline(always)]
    fn chain(self, f: S, df: S, ddf: S) -> Self {
        Jet { d0: f, d1: df * self.d1, d2: ddf * self.d1 * self.d1 + df * self.d2 }
    }
}

impl<S: Scalar> Add for Jet<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Jet { d0: self.d0 + o.d0, d1: self.d1 + o.d1, d2: self.d2 + o.d2 }
    }
}
impl<S: Scalar> Sub for Jet<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Jet { d0: self.d0 - o.d0, d1: self.d1 - o.d1, d2: self.d2 - o.d2 }
    }
}
impl<S: Scalar> Mul for Jet<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Jet {
            d0: self.d0 * o.d0,
            d1: self.d1 * o.d0 + self.d0 * o.d1,
            d2: self.d2 * o.d0 + (self.d1 * o.d1).scale(2.0) + self.d0 * o.d2,
        }
    }
}
impl<S: Scalar> Div for Jet<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let d0 = self.d0 / o.d0;
        let d1 = (self.d1 - d0 * o.d1) / o.d0;
        let d2 = (self.d2 - (d1 * o.d1).scale(2.0) - d0 * o.d2) / o.d0;
        Jet { d0, d1, d2 }
    }
}
impl<S: Scalar> Neg for Jet<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Jet { d0: -self.d0, d1: -self.d1, d2: -self.d2 }
    }
}
impl<S: Scalar> AddAssign for Jet<S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<S: Scalar> SubAssign for Jet<S> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<S: Scalar> Scalar for Jet<S> {
    fn of(value: f64) -> Self {
        Self::constant(S::of(value))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.d0.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
    fn sqrt(self) -> Self {
        let root = self.d0.sqrt();
        let slope = S::of(0.5) / root;
        self.chain(root, slope, -slope.scale(0.5) / self.d0)
    }
    fn exp(self) -> Self {
        let e = self.d0.exp();
        self.chain(e, e, e)
    }
    fn ln(self) -> Self {
        let inverse = S::one() / self.d0;
        self.chain(self.d0.ln(), inverse, -inverse * inverse)
    }
    fn atan2(self, x: Self) -> Self {
        let y = self;
        let r2 = y.d0 * y.d0 + x.d0 * x.d0;
        let area = x.d0 * y.d1 - y.d0 * x.d1;
        let d1 = area / r2;
        let growth = (x.d0 * x.d1 + y.d0 * y.d1).scale(2.0);
        let d2 = (x.d0 * y.d2 - y.d0 * x.d2 - d1 * growth) / r2;
        Jet { d0: y.d0.atan2(x.d0), d1, d2 }
    }
    fn powi(self, n: i32) -> Self {
        let power = |k: i32| if k == 0 { S::one() } else { self.d0.powi(k) };
        match n {
            0 => Self::one(),
            1 => self,
            _ => self.chain(power(n), power(n - 1).scale(n as f64), power(n - 2).scale((n * (n - 1)) as f64)),
        }
    }
    fn value(self) -> f64 {
        self.d0.value()
    }
}
