//! Numbers with a bound of how far they go.

use super::{real, Scalar};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// All numbers at most `radius` from `mid` (midpoint-radius arithmetic; Rump, *Fast and parallel interval arithmetic*, BIT 39,
/// 1999), but for round-off. The radius is infinite, or not a number, where nothing is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The middle.
    pub mid: f64,
    /// How far they go from there at most.
    pub radius: f64,
}

impl Ball {
    /// The image under a function that grows, or falls, all along.
    fn monotone(self, of: impl Fn(f64) -> f64) -> Self {
        let mid = of(self.mid);
        let ends = [self.mid - self.radius, self.mid + self.radius].map(|x| (of(x) - mid).abs());
        Ball { mid, radius: if ends.iter().any(|end| end.is_nan()) { f64::INFINITY } else { ends[0].max(ends[1]) } }
    }
}

/// The longest way between two points of the unit circle along an axis.
const DIAMETER: f64 = 2.0;

impl Add for Ball {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Ball { mid: self.mid + o.mid, radius: self.radius + o.radius }
    }
}
impl Sub for Ball {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Ball { mid: self.mid - o.mid, radius: self.radius + o.radius }
    }
}
impl Mul for Ball {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let radius = self.mid.abs() * o.radius + self.radius * (o.mid.abs() + o.radius);
        Ball { mid: self.mid * o.mid, radius }
    }
}
impl Div for Ball {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl, reason = "a quotient is a product with the inverse")]
    fn div(self, o: Self) -> Self {
        let least = o.mid.abs() - o.radius;
        let radius = if least > 0.0 { o.radius / (o.mid.abs() * least) } else { f64::INFINITY };
        self * Ball { mid: 1.0 / o.mid, radius }
    }
}
impl Neg for Ball {
    type Output = Self;
    fn neg(self) -> Self {
        Ball { mid: -self.mid, ..self }
    }
}
impl AddAssign for Ball {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Ball {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Scalar for Ball {
    fn of(value: f64) -> Self {
        Ball { mid: value, radius: 0.0 }
    }
    fn sin_cos(self) -> (Self, Self) {
        let ((sin, cos), radius) = (real::sin_cos(self.mid), self.radius.min(DIAMETER));
        (Ball { mid: sin, radius }, Ball { mid: cos, radius })
    }
    fn sqrt(self) -> Self {
        self.monotone(f64::sqrt)
    }
    fn exp(self) -> Self {
        self.monotone(real::exp)
    }
    fn ln(self) -> Self {
        self.monotone(real::ln)
    }
    fn atan2(self, x: Self) -> Self {
        Ball { mid: real::atan2(self.mid, x.mid), radius: f64::INFINITY }
    }
    fn powi(self, n: i32) -> Self {
        let power = (0..n.unsigned_abs()).fold(Self::one(), |product, _| product * self);
        if n < 0 {
            Self::one() / power
        } else {
            power
        }
    }
    fn value(self) -> f64 {
        self.mid
    }
}
