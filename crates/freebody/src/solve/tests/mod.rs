//! Properties of the solvers on random problems, from seeds so that a failure can be repeated.

use super::{Equations, Matrix, Saddle, SaddleError};

mod dense;
mod islands;
mod saddle;
mod sparse;

/// Random numbers by SplitMix64 (Steele, Lea & Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Uniform in [−1, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    /// Uniform in low..high.
    pub fn index(&mut self, low: usize, high: usize) -> usize {
        low + (self.next() % (high - low) as u64) as usize
    }
    /// Log-uniform in [10⁻ᵈ, 10ᵈ].
    pub fn decades(&mut self, d: f64) -> f64 {
        (self.unit() * d * std::f64::consts::LN_10).exp()
    }
    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.unit()).collect()
    }
    pub fn matrix(&mut self, rows: usize, cols: usize) -> Matrix {
        Matrix::from_fn(rows, cols, |_, _| self.unit())
    }
}

/// Equations without scales, actuated as they are constrained.
pub fn unscaled<'a>(mass: &'a Matrix, g: &'a Matrix) -> Equations<'a> {
    let ones = &[1.0; 200];
    Equations { mass, g, b: None, row_scale: &ones[..g.rows()], col_scale: &ones[..mass.cols()] }
}

pub fn factored(of: Equations) -> Result<Saddle, SaddleError> {
    let mut saddle = Saddle::default();
    saddle.refactor(of).map(|()| saddle)
}

/// max |x − y| / max |y|.
pub fn distance(x: &[f64], y: &[f64]) -> f64 {
    let difference = x.iter().zip(y).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    difference / super::max_abs(y).max(f64::MIN_POSITIVE)
}

/// max |A − B|.
pub fn difference(a: &Matrix, b: &Matrix) -> f64 {
    a.data().iter().zip(b.data()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
