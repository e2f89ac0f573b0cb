//! Elementary functions of `f64`, the same bits on every machine: each kind of number is built on them. Sine and cosine
//! are our own; the others are those of the crate `libm` (after FreeBSD's msun), where the platform's differ in the
//! last place.

/// Up to here the quadrant is below 2²⁰, so its products with the 33-bit parts of π/2 are exact.
const CAREFUL_ABOVE: f64 = 1.0e6;
/// Adding and subtracting 1.5·2⁵² rounds to the nearest integer and leaves it in the low bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;
/// π/2 in three parts: two of 33 bits, and the rest.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Sine and cosine of `x` radians, within 1 unit in the last place up to |x| = 10⁶.
///
/// Cody and Waite's reduction by π/2 (*Software Manual for the Elementary Functions*, 1980, ch. 8),
/// then the kernels of fdlibm (Sun Microsystems, 1993). It uses neither fused operations nor
/// tables: the bits are the same everywhere. Infinite or undefined angles give NaN.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() > CAREFUL_ABOVE {
        return careful(x);
    }
    let (shifted, s, c) = within_quadrant(x);
    into_quadrant(shifted, s, c)
}

/// The same side by side: each to the same bits as alone.
#[inline(always)]
pub(super) fn write_sin_cos<const B: usize>(x: &[f64; B], sin: &mut [f64; B], cos: &mut [f64; B]) {
    let mut any_far = false;
    for x in x {
        any_far |= x.abs() > CAREFUL_ABOVE;
    }
    if any_far {
        for i in 0..B {
            (sin[i], cos[i]) = sin_cos(x[i]);
        }
        return;
    }
    for i in 0..B {
        let (shifted, s, c) = within_quadrant(x[i]);
        (sin[i], cos[i]) = into_quadrant(shifted, s, c);
    }
}

/// Sine and cosine of what is left of an angle by whole quarter turns, and their number in the low bits.
#[inline(always)]
fn within_quadrant(x: f64) -> (f64, f64, f64) {
    let (shifted, hi, lo) = reduce(x);
    (shifted, kernel_sin(hi, lo), kernel_cos(hi, lo))
}

/// Odd quadrants swap the two; done on bits, for a branch here would be a coin toss.
#[inline(always)]
fn into_quadrant(shifted: f64, s: f64, c: f64) -> (f64, f64) {
    let (quadrant, s, c) = (shifted.to_bits(), s.to_bits(), c.to_bits());
    let swap = (s ^ c) & (quadrant & 1).wrapping_neg();
    let sign = |quadrant: u64| (quadrant & 2) << 62;
    (f64::from_bits(s ^ swap ^ sign(quadrant)), f64::from_bits(c ^ swap ^ sign(quadrant + 1)))
}

/// Beyond 160 000 turns the reduction needs hundreds of bits of π, which `libm` has.
#[cold]
#[inline(never)]
fn careful(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// sin(πx), exactly 0 at whole numbers.
pub fn sin_pi(x: f64) -> f64 {
    let near = x - 2.0 * (0.5 * x).round();
    let folded = if near.abs() > 0.5 { near.signum() - near } else { near };
    sin_cos(std::f64::consts::PI * folded).0
}

/// Natural exponential.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Direction of the point (x, y), rad in (−π, π].
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// √(x² + y²), without overflow on the way.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// Real power.
pub fn powf(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// Integer power, by squaring (Knuth, *The Art of Computer Programming*, vol. 2, 4.6.3).
#[inline]
pub fn powi(base: f64, n: i32) -> f64 {
    let (mut product, mut square, mut left) = (1.0, base, n.unsigned_abs());
    while left > 0 {
        if left % 2 == 1 {
            product *= square;
        }
        left /= 2;
        square *= square;
    }
    if n < 0 {
        1.0 / product
    } else {
        product
    }
}

/// The quadrant (modulo 4 in the low bits of a number) and x − quadrant·π/2 as an unevaluated sum.
#[inline(always)]
fn reduce(x: f64) -> (f64, f64, f64) {
    let shifted = x * std::f64::consts::FRAC_2_PI + ROUNDER;
    let n = shifted - ROUNDER;
    let first = x - n * HALF_PI[0];
    // Where the second part is the larger of the two, the difference is exact: no error to collect.
    let part = n * HALF_PI[1];
    let second = first - part;
    let rest = n * HALF_PI[2];
    let hi = second - rest;
    (shifted, hi, ((second - hi) - rest) + ((first - second) - part))
}

/// sin(x + y) for |x| ≤ π/4 and y a rounding error of x.
#[inline(always)]
fn kernel_sin(x: f64, y: f64) -> f64 {
    const C: [f64; 6] = [
        -0.166_666_666_666_666_32,
        0.008_333_333_333_322_49,
        -0.000_198_412_698_298_579_5,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    let z = x * x;
    // Subtracted, not added, so that −0 stays −0.
    x - ((z * 0.5 * y - y) - z * x * even(z, C))
}

/// cos(x + y) for |x| ≤ π/4 and y a rounding error of x.
#[inline(always)]
fn kernel_cos(x: f64, y: f64) -> f64 {
    const C: [f64; 6] = [
        0.041_666_666_666_666_6,
        -0.001_388_888_888_887_411,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let z = x * x;
    let half = z * 0.5;
    let top = 1.0 - half;
    top + (z * z * even(z, C) + (((1.0 - top) - half) - x * y))
}

/// A polynomial in z by Estrin's rule: half the waiting of Horner's.
#[inline(always)]
fn even(z: f64, c: [f64; 6]) -> f64 {
    let w = z * z;
    let line = |i: usize| c[i] + z * c[i + 1];
    (line(0) + w * line(2)) + w * w * line(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equidistributed in (−1, 1): the golden-ratio sequence.
    fn spread(i: u32) -> f64 {
        2.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract() - 1.0
    }

    fn check(ours: f64, exact: f64, x: f64) {
        let error = (ours - exact).abs();
        assert!(error <= 2.3e-16, "{ours} instead of {exact} at {x}");
        assert!(error <= 2.0 * f64::EPSILON * exact.abs(), "{ours} instead of {exact} at {x}");
    }

    #[test]
    fn agrees_with_std_to_the_last_place() {
        for reach in [0.8, 10.0, 1.0e3, 9.9e5, 1.0e9] {
            for i in 0..200_000 {
                let x = reach * spread(i);
                let (s, c) = sin_cos(x);
                check(s, x.sin(), x);
                check(c, x.cos(), x);
            }
        }
    }

    #[test]
    fn multiples_of_a_right_angle_keep_their_relative_accuracy() {
        for n in -600_000..600_000 {
            let x = f64::from(n) * std::f64::consts::FRAC_PI_2;
            let (s, c) = sin_cos(x);
            check(s, x.sin(), x);
            check(c, x.cos(), x);
        }
    }

    #[test]
    fn zeros_keep_their_sign_and_tiny_angles_are_themselves() {
        for x in [0.0, -0.0, 5e-324, -1e-300, 1e-9] {
            let (s, c) = sin_cos(x);
            assert_eq!((s.to_bits(), c), (f64::to_bits(x), 1.0));
        }
    }

    #[test]
    fn the_sine_of_whole_half_turns_vanishes() {
        for n in -1001_i32..1001 {
            let half_turns = f64::from(n);
            assert_eq!(sin_pi(half_turns), 0.0);
            let sign = if n.rem_euclid(2) == 0 { 1.0 } else { -1.0 };
            assert!((sin_pi(half_turns + 0.3) - sign * sin_cos(0.3 * std::f64::consts::PI).0).abs() < 1e-12);
        }
    }

    #[test]
    fn undefined_angles_give_nan() {
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let (s, c) = sin_cos(x);
            assert!(s.is_nan() && c.is_nan());
        }
    }

    #[test]
    fn parity_is_exact() {
        for i in 0..10_000 {
            let x = 1.0e4 * spread(i);
            let ((s, c), (t, d)) = (sin_cos(x), sin_cos(-x));
            assert_eq!((s, c), (-t, d));
        }
    }

    #[test]
    fn the_bits_are_the_same_everywhere() {
        let mut sum = 0_u64;
        let mut add = |x: f64| sum = sum.rotate_left(5).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ x.to_bits();
        for i in 0..20_000 {
            let (x, y) = (20.0 * spread(i), spread(3 * i + 1));
            let (s, c) = sin_cos(1e3 * x);
            let (far, _) = sin_cos(1e7 * x);
            let powers = [powf(x.abs(), y), powi(x, i as i32 % 9 - 4)];
            for value in [s, c, far, exp(x), ln(x.abs()), atan2(y, x), hypot(x, y), powers[0], powers[1]] {
                add(value);
            }
        }
        assert_eq!(sum, 5_723_081_420_715_980_108);
    }
}
