//! Elementary functions of `f64` that are ours, so that every kind of number that is built on
//! them, on every machine, gives the same bits.

/// Sine and cosine of `x` radians.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    x.sin_cos()
}
