//! Small dense linear systems.

/// The factors P·A = L·U of a square matrix, rows one after the other.
pub(super) struct Lu {
    n: usize,
    factors: Vec<f64>,
    pivots: Vec<usize>,
}

impl Lu {
    /// Factors `a`, n×n, with partial pivoting; `None` when it is singular.
    pub fn new(n: usize, mut a: Vec<f64>) -> Option<Self> {
        let mut pivots = vec![0; n];
        for k in 0..n {
            let size = |row: &usize| a[row * n + k].abs();
            let pivot = (k..n).max_by(|x, y| size(x).total_cmp(&size(y)))?;
            if a[pivot * n + k] == 0.0 || !a[pivot * n + k].is_finite() {
                return None;
            }
            pivots[k] = pivot;
            for column in 0..n {
                a.swap(k * n + column, pivot * n + column);
            }
            for row in k + 1..n {
                let factor = a[row * n + k] / a[k * n + k];
                a[row * n + k] = factor;
                for column in k + 1..n {
                    a[row * n + column] -= factor * a[k * n + column];
                }
            }
        }
        Some(Self { n, factors: a, pivots })
    }

    /// Replaces the right-hand side `b` by the solution.
    pub fn solve(&self, b: &mut [f64]) {
        let (n, a) = (self.n, &self.factors);
        for k in 0..n {
            b.swap(k, self.pivots[k]);
        }
        for row in 0..n {
            let known: f64 = (0..row).map(|j| a[row * n + j] * b[j]).sum();
            b[row] -= known;
        }
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n).map(|j| a[row * n + j] * b[j]).sum();
            b[row] = (b[row] - known) / a[row * n + row];
        }
    }
}
