//! Linear algebra of one instant of a mechanism: M a − Bᵀ λ = f, G a = r.
//!
//! [`Saddle`] is the dense solver, exact about rank and about directions without inertia; it suits mechanisms of up to
//! some forty unknowns, and [`Islands`] applies it to each part of equations that fall apart. Where every motion has inertia and it is
//! clear which rows depend on others [`Condensed`] is quicker, and [`Quasidefinite`] where they are few and none does. [`Pattern`] and
//! [`Factor`] solve the symmetric case for thousands of bodies, at a cost that grows with the fill. The rest is what
//! they stand on.

mod condensed;
mod dense;
mod gmres;
mod islands;
mod ldl;
mod matrix;
mod ordering;
mod orthogonal;
mod quasidefinite;
mod saddle;
mod simplex;
mod sparse;

pub use condensed::Condensed;
pub use dense::{Lu, Singular};
pub use islands::{IslandMemory, IslandRank, Islands};
pub use matrix::Matrix;
pub use ordering::minimum_degree;
pub use orthogonal::{jacobi_svd, Orthogonal, Rank, Svd};
pub use quasidefinite::Quasidefinite;
pub use saddle::{Equations, Saddle, SaddleError, Solution};
pub use simplex::keep_above;
pub use sparse::{Accuracy, Factor, Pattern, Stalled};

#[cfg(test)]
mod tests;

/// Calls for rows of length `$n`: of a constant length where they are short, so that all loops along them are plain sums.
macro_rules! with_length {
    ($n:expr, |$length:ident| $call:expr) => {
        with_length!(@ $n, $length, $call, 1 2 3 4 5 6 7 8)
    };
    (@ $n:expr, $length:ident, $call:expr, $($small:literal)*) => {
        match $n {
            $($small => { let $length = $small; $call })*
            $length => $call,
        }
    };
}
use with_length;

/// Σ xᵢ yᵢ.
#[inline(always)]
fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

/// y ← y + s x.
#[inline(always)]
fn axpy(s: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// max |xᵢ|, or NaN if any entry is NaN.
fn max_abs(x: &[f64]) -> f64 {
    largest(x.iter().copied())
}

/// The largest magnitude, or NaN if any is NaN; 0 of none.
fn largest(x: impl Iterator<Item = f64>) -> f64 {
    x.map(f64::abs).fold(0.0, |m, v| if m >= v || m.is_nan() { m } else { v })
}
