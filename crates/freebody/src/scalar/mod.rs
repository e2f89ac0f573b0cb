//! The number. Every formula of mechanics is written once over [`Scalar`] and read as
//! `f64` (values), [`Dual`] (exact gradients), [`Jet`] (exact time derivatives), [`Ball`] (bounds),
//! in `series` as what is written down or, in `algebra`, as a symbol (equations).

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

mod ball;
pub mod block;
#[allow(
    clippy::suspicious_arithmetic_impl,
    reason = "a difference is a sum with the opposite, a quotient is a long division"
)]
mod double_double;
#[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds, the quotient rule subtracts")]
mod dual;
mod jet;
pub mod real;

pub use ball::Ball;
pub use block::{Block, WIDE};
pub use double_double::DoubleDouble;
pub use dual::Dual;
pub use jet::Jet;

/// What a formula of mechanics may do with a number.
///
/// There is no comparison: a value-dependent choice is [`Scalar::select`], so that numbers which
/// hold no value (symbols) can take part. Both arms of a `select`
/// are evaluated; give them arguments that are safe on either side.
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// A constant.
    fn of(value: f64) -> Self;
    /// Sine and cosine of an angle in radians, computed together.
    fn sin_cos(self) -> (Self, Self);
    /// The same of several angles, each to the same bits as alone.
    fn sin_cos_each(of: &[Self; WIDE]) -> [[Self; WIDE]; 2] {
        let each = of.map(Self::sin_cos);
        [each.map(|(sin, _)| sin), each.map(|(_, cos)| cos)]
    }
    /// Square root; its derivative at 0 is infinite.
    fn sqrt(self) -> Self;
    /// Natural exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Arc tangent of `self / x` in the quadrant of the point (x, self), radians in (−π, π].
    fn atan2(self, x: Self) -> Self;
    /// Integer power.
    fn powi(self, n: i32) -> Self;
    /// Real power of a positive base.
    fn powf(self, exponent: Self) -> Self {
        (self.ln() * exponent).exp()
    }
    /// The plain value, without derivatives; decisions (pivots, branches, modes) read this.
    fn value(self) -> f64;
    /// `a` where `mask`, else `b`.
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask {
            a
        } else {
            b
        }
    }
    /// Zero.
    fn zero() -> Self {
        Self::of(0.0)
    }
    /// One.
    fn one() -> Self {
        Self::of(1.0)
    }
    /// Multiplication by a plain constant.
    fn scale(self, factor: f64) -> Self {
        self * Self::of(factor)
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        real::sin_cos(self)
    }
    #[inline(always)]
    fn sin_cos_each(of: &[Self; WIDE]) -> [[Self; WIDE]; 2] {
        block::wide_sin_cos(of)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn exp(self) -> Self {
        real::exp(self)
    }
    fn ln(self) -> Self {
        real::ln(self)
    }
    fn atan2(self, x: Self) -> Self {
        real::atan2(self, x)
    }
    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        real::powi(self, n)
    }
    fn powf(self, exponent: Self) -> Self {
        real::powf(self, exponent)
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        self * factor
    }
}
