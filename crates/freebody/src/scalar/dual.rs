//! First-order dual numbers: a value and its gradient along `N` directions.

use super::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `re + Σ du[i] εᵢ` with εᵢεⱼ = 0 (Clifford's dual numbers; Griewank & Walther,
/// *Evaluating Derivatives*, ch. 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize, S = f64> {
    /// The value.
    pub re: S,
    /// The gradient along the seeded directions.
    pub du: [S; N],
}

impl<const N: usize, S: Scalar> Dual<N, S> {
    /// A number that does not vary.
    #[inline]
    pub fn constant(re: S) -> Self {
        Dual { re, du: [S::zero(); N] }
    }
    /// The independent variable of direction `i`.
    #[inline]
    pub fn variable(re: S, i: usize) -> Self {
        let mut du = [S::zero(); N];
        du[i] = S::one();
        Dual { re, du }
    }
    #[inline(always)]
    fn chain(self, re: S, slope: S) -> Self {
        Dual { re, du: self.du.map(|d| d * slope) }
    }
}

impl<const N: usize, S: Scalar> Add for Dual<N, S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Dual { re: self.re + o.re, du: std::array::from_fn(|i| self.du[i] + o.du[i]) }
    }
}
impl<const N: usize, S: Scalar> Sub for Dual<N, S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Dual { re: self.re - o.re, du: std::array::from_fn(|i| self.du[i] - o.du[i]) }
    }
}
impl<const N: usize, S: Scalar> Mul for Dual<N, S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Dual { re: self.re * o.re, du: std::array::from_fn(|i| self.du[i] * o.re + self.re * o.du[i]) }
    }
}
impl<const N: usize, S: Scalar> Div for Dual<N, S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let re = self.re / o.re;
        Dual { re, du: std::array::from_fn(|i| (self.du[i] - re * o.du[i]) / o.re) }
    }
}
impl<const N: usize, S: Scalar> Neg for Dual<N, S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Dual { re: -self.re, du: self.du.map(|d| -d) }
    }
}
impl<const N: usize, S: Scalar> AddAssign for Dual<N, S> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<const N: usize, S: Scalar> SubAssign for Dual<N, S> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<const N: usize, S: Scalar> Scalar for Dual<N, S> {
    fn of(value: f64) -> Self {
        Self::constant(S::of(value))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.re.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        self.chain(root, S::of(0.5) / root)
    }
    fn exp(self) -> Self {
        let e = self.re.exp();
        self.chain(e, e)
    }
    fn ln(self) -> Self {
        self.chain(self.re.ln(), S::one() / self.re)
    }
    fn atan2(self, x: Self) -> Self {
        let r2 = self.re * self.re + x.re * x.re;
        Dual { re: self.re.atan2(x.re), du: std::array::from_fn(|i| (x.re * self.du[i] - self.re * x.du[i]) / r2) }
    }
    fn powi(self, n: i32) -> Self {
        match n {
            0 => Self::one(),
            _ => self.chain(self.re.powi(n), self.re.powi(n - 1).scale(n as f64)),
        }
    }
    fn value(self) -> f64 {
        self.re.value()
    }
}
