//! Values side by side: one formula for several mechanisms at once.

use super::{real, Scalar};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// How many values stand side by side: two registers of AVX-512, so that one computes while the other waits, or several smaller ones.
pub const LANES: usize = 16;

/// [`LANES`] values, each computed as an `f64` would be, to the same bits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes(pub [f64; LANES]);

impl Lanes {
    /// A value for each lane.
    #[inline(always)]
    pub fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
        Lanes(std::array::from_fn(value))
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = self;
        for i in 0..LANES {
            out.0[i] = f(self.0[i]);
        }
        out
    }
    #[inline(always)]
    fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = self;
        for i in 0..LANES {
            out.0[i] = f(self.0[i], o.0[i]);
        }
        out
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        self.zip(o, |a, b| a + b)
    }
}
impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        self.zip(o, |a, b| a - b)
    }
}
impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.zip(o, |a, b| a * b)
    }
}
impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        self.zip(o, |a, b| a / b)
    }
}
impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}
impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Scalar for Lanes {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Lanes([value; LANES])
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        real::sin_cos_lanes(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    fn exp(self) -> Self {
        self.map(real::exp)
    }
    fn ln(self) -> Self {
        self.map(real::ln)
    }
    fn atan2(self, x: Self) -> Self {
        self.zip(x, real::atan2)
    }
    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        self.map(|x| real::powi(x, n))
    }
    fn powf(self, exponent: Self) -> Self {
        self.zip(exponent, real::powf)
    }
    /// # Panics
    /// Always: what decides by one value would decide for all.
    fn value(self) -> f64 {
        panic!("lanes have no one value")
    }
    #[inline(always)]
    fn any(self, holds: impl Fn(f64) -> bool) -> bool {
        let mut any = false;
        for i in 0..LANES {
            any |= holds(self.0[i]);
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_have_the_bits_of_each_lane_alone() {
        let odd = [0.0, -0.0, 5e-324, f64::NAN, f64::INFINITY, -7.1e9, 1.0e6, -2.3];
        let odd = Lanes::from_fn(|lane| odd[lane % odd.len()]);
        let blocks = (0..2000).map(|i| Lanes::from_fn(|lane| f64::from(i * 16 + lane as i32 - 16000) * 0.0171));
        for x in blocks.chain([odd]) {
            let (s, c) = x.sin_cos();
            for lane in 0..LANES {
                let (sin, cos) = real::sin_cos(x.0[lane]);
                let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                assert!(same(s.0[lane], sin) && same(c.0[lane], cos), "{}", x.0[lane]);
            }
        }
    }

    #[test]
    fn any_lane_counts() {
        let x = Lanes::from_fn(|lane| lane as f64);
        assert!(x.any(|x| x == 15.0) && x.any(|x| x == 0.0) && !x.any(|x| x > 15.0));
    }
}
