//! Numbers of about 32 digits, as the unevaluated sum of two.

use super::{real, Scalar};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// The number hi + lo, where hi is the nearest double to it (Dekker, *Numer. Math.* 18, 1971; Hida, Li & Bailey, *Library for
/// Double-Double and Quad-Double Arithmetic*, 2007). Our own, for the same bits on every machine and sines of full length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    /// The nearest double.
    pub hi: f64,
    /// What it lacks.
    pub lo: f64,
}

/// π/2, as far as three doubles go.
const HALF_PI: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169e-33];
/// ln 2.
const LN_2: DoubleDouble = DoubleDouble { hi: std::f64::consts::LN_2, lo: 2.319_046_813_846_299_6e-17 };
/// A term of a series below which the rest is round-off.
const NEGLIGIBLE: f64 = 1e-34;

/// The sum, and its rounding error (Knuth).
#[inline(always)]
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let other = hi - a;
    DoubleDouble { hi, lo: (a - (hi - other)) + (b - other) }
}

/// The same where |a| ≥ |b| (Dekker).
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// A double as the sum of two of 26 bits (Veltkamp).
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0;
    let large = SPLITTER * a;
    let hi = large - (large - a);
    (hi, a - hi)
}

/// The product, and its rounding error (Dekker).
#[inline(always)]
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    DoubleDouble { hi, lo: ((a1 * b1 - hi) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl DoubleDouble {
    /// The product with a double.
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        let product = two_product(self.hi, factor);
        quick_two_sum(product.hi, product.lo + self.lo * factor)
    }
    /// Σ of a series whose term n is `ratio(n)` times the one before; the first is `term`.
    fn series(term: Self, ratio: impl Fn(f64) -> Self) -> Self {
        let (mut sum, mut term, mut n) = (term, term, 1.0);
        while term.hi.abs() > NEGLIGIBLE {
            term = term * ratio(n);
            sum += term;
            n += 1.0;
        }
        sum
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let (s, t) = (two_sum(self.hi, o.hi), two_sum(self.lo, o.lo));
        let s = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(s.hi, s.lo + t.lo)
    }
}
impl Sub for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let product = two_product(self.hi, o.hi);
        quick_two_sum(product.hi, product.lo + (self.hi * o.lo + self.lo * o.hi))
    }
}
impl Div for DoubleDouble {
    type Output = Self;
    /// Long division, three digits of a double each.
    fn div(self, o: Self) -> Self {
        let first = self.hi / o.hi;
        let rest = self - o.times(first);
        let second = rest.hi / o.hi;
        let rest = rest - o.times(second);
        quick_two_sum(first, second) + Self::of(rest.hi / o.hi)
    }
}
impl Neg for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        DoubleDouble { hi: -self.hi, lo: -self.lo }
    }
}
impl AddAssign for DoubleDouble {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for DoubleDouble {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Scalar for DoubleDouble {
    #[inline(always)]
    fn of(value: f64) -> Self {
        DoubleDouble { hi: value, lo: 0.0 }
    }
    /// By the series of what is left of whole quarter turns.
    fn sin_cos(self) -> (Self, Self) {
        let quarters = (self.hi / HALF_PI[0]).round();
        let rest = HALF_PI.iter().fold(self, |rest, &part| rest - two_product(part, quarters));
        let square = -(rest * rest);
        let sin = Self::series(rest, |n| square / Self::of(2.0 * n * (2.0 * n + 1.0)));
        let cos = Self::series(Self::one(), |n| square / Self::of((2.0 * n - 1.0) * 2.0 * n));
        match quarters.rem_euclid(4.0) {
            0.0 => (sin, cos),
            1.0 => (cos, -sin),
            2.0 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
    /// A step of Newton's method from the root of a double (Karp & Markstein).
    fn sqrt(self) -> Self {
        if self.hi == 0.0 {
            return self;
        }
        let root = self.hi.sqrt();
        two_sum(root, (self - two_product(root, root)).hi / (2.0 * root))
    }
    /// By the series of what is left of whole powers of 2.
    fn exp(self) -> Self {
        let doublings = (self.hi / LN_2.hi).round();
        let rest = self - LN_2.times(doublings);
        let sum = Self::series(Self::one(), |n| rest / Self::of(n));
        sum.times(real::powi(2.0, doublings as i32))
    }
    /// A step of Newton's method from the logarithm of a double.
    fn ln(self) -> Self {
        let near = Self::of(real::ln(self.hi));
        near + self * (-near).exp() - Self::one()
    }
    /// The angle of doubles, and what is left to turn.
    fn atan2(self, x: Self) -> Self {
        let near = Self::of(real::atan2(self.hi, x.hi));
        let (sin, cos) = near.sin_cos();
        let across = self * cos - x * sin;
        if across.hi == 0.0 {
            return near;
        }
        near + across / (self * sin + x * cos)
    }
    fn powi(self, n: i32) -> Self {
        let power = (0..n.unsigned_abs()).fold(Self::one(), |product, _| product * self);
        if n < 0 {
            Self::one() / power
        } else {
            power
        }
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self.hi
    }
}
