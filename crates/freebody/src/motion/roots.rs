//! Zeros of functions of one variable.

use crate::scalar::real;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Samples per step of a switching function, at most.
pub(super) const SAMPLES: usize = 9;

/// Roots this far outside [−1, 1] are taken as lying at its ends.
const MARGIN: f64 = 1e-7;

/// The Chebyshev points −cos(jπ/8) of [−1, 1], both ends included.
pub(super) fn chebyshev_points() -> [f64; SAMPLES] {
    std::array::from_fn(|j| match 2 * j + 1 {
        SAMPLES => 0.0,
        _ => -real::sin_cos(PI * j as f64 / (SAMPLES - 1) as f64).1,
    })
}

/// cos(jπ/8), a whole turn.
static COSINES: LazyLock<[f64; 2 * (SAMPLES - 1)]> =
    LazyLock::new(|| std::array::from_fn(|j| real::sin_cos(PI * j as f64 / (SAMPLES - 1) as f64).1));

/// Coefficients in the Chebyshev basis of the interpolant through `values` at the points
/// (Trefethen, *Approximation Theory and Approximation Practice*, ch. 3), or at every second or fourth of them.
pub(super) fn chebyshev<const N: usize>(values: &[f64; N]) -> [f64; N] {
    let (last, cosines) = (N - 1, &*COSINES);
    let end = |index: usize| if index == 0 || index == last { 0.5 } else { 1.0 };
    let cosine = |times: usize| cosines[times * (SAMPLES - 1) / last % cosines.len()];
    std::array::from_fn(|k| {
        let sum: f64 = (0..N).map(|j| end(j) * values[j] * cosine(k * (last - j))).sum();
        2.0 / last as f64 * end(k) * sum
    })
}

/// Coefficients of 1, x, x² … of a polynomial given in the Chebyshev basis.
pub(super) fn monomial(chebyshev: &[f64; SAMPLES]) -> [f64; SAMPLES] {
    let mut sum = [0.0; SAMPLES];
    let (mut before, mut now) = ([0.0; SAMPLES], [0.0; SAMPLES]);
    now[0] = 1.0;
    for (k, coefficient) in chebyshev.iter().enumerate() {
        sum.iter_mut().zip(&now).for_each(|(sum, t)| *sum += coefficient * t);
        let double = if k == 0 { 1.0 } else { 2.0 };
        let next = std::array::from_fn(|j| {
            let shifted = if j == 0 { 0.0 } else { now[j - 1] };
            double * shifted - before[j]
        });
        (before, now) = (now, next);
    }
    sum
}

/// Value at `x` of a polynomial given by the coefficients of 1, x, x² ….
pub(super) fn value(polynomial: &[f64], x: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// All extrema in [−1, end] of a polynomial, in order; the end is not below 1.
pub(super) fn extrema(polynomial: &[f64], end: f64) -> Vec<f64> {
    let inside = |x: f64| if x <= 1.0 + MARGIN { x.clamp(-1.0, 1.0) } else { x };
    sign_changes(&derivative(polynomial), end).into_iter().map(inside).collect()
}

fn derivative(polynomial: &[f64]) -> Vec<f64> {
    polynomial.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect()
}

/// All sign changes of a polynomial: between two neighbouring extrema it is monotone, and the
/// extrema are the sign changes of the derivative, and so on down to a constant.
fn sign_changes(polynomial: &[f64], end: f64) -> Vec<f64> {
    if polynomial.len() < 2 {
        return Vec::new();
    }
    let mut nodes = vec![-1.0 - MARGIN];
    nodes.extend(sign_changes(&derivative(polynomial), end));
    nodes.push(end + MARGIN);
    let at = |x: f64| value(polynomial, x);
    let pairs = nodes.windows(2).map(|pair| ((pair[0], at(pair[0])), (pair[1], at(pair[1]))));
    pairs
        .filter(|(a, b)| a.1 != 0.0 && (a.1 < 0.0) != (b.1 < 0.0))
        .map(|(a, b)| match bracketed(|x| Ok::<_, std::convert::Infallible>(at(x)), a, b) {
            Ok(root) => root,
            Err(never) => match never {},
        })
        .collect()
}

/// The zero between `a` and `b`, given as (x, f(x)) with values of unlike sign, to the last digits
/// (Chandrupatla 1997, *Advances in Engineering Software* 28, 145; Scherer, *Computational
/// Physics*, 6.1.7).
pub(super) fn bracketed<E>(mut f: impl FnMut(f64) -> Result<f64, E>, a: (f64, f64), b: (f64, f64)) -> Result<f64, E> {
    let (mut new, mut old, mut share) = (b, a, 0.5);
    loop {
        let x = new.0 + share * (old.0 - new.0);
        let here = (x, f(x)?);
        let third = if (here.1 < 0.0) == (new.1 < 0.0) { new } else { std::mem::replace(&mut old, new) };
        new = here;
        let best = if old.1.abs() < new.1.abs() { old } else { new };
        let width = (old.0 - new.0).abs();
        let least = (2.0 * f64::EPSILON * best.0.abs() + f64::MIN_POSITIVE) / width;
        if best.1 == 0.0 || least > 0.5 {
            return Ok(best.0);
        }
        share = chandrupatla(new, old, third).clamp(least, 1.0 - least);
    }
}

/// Where to look next between `new` and `old`: inverse quadratic interpolation where it is safe,
/// the middle elsewhere.
fn chandrupatla(new: (f64, f64), old: (f64, f64), third: (f64, f64)) -> f64 {
    let xi = (new.0 - old.0) / (third.0 - old.0);
    let phi = (new.1 - old.1) / (third.1 - old.1);
    if !(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
        return 0.5;
    }
    let slant = (third.0 - new.0) / (old.0 - new.0);
    new.1 / (old.1 - new.1) * third.1 / (old.1 - third.1)
        + slant * new.1 / (third.1 - new.1) * old.1 / (third.1 - old.1)
}
