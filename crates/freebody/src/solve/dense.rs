//! LU factors of a small square matrix.

use super::{axpy, dot, max_abs, with_length, Matrix};
use std::fmt;

/// A matrix whose column depends, to round-off, on the columns before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// The dependent column.
    pub column: usize,
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "singular matrix: column {} depends on those before it", self.column)
    }
}

impl std::error::Error for Singular {}

/// P A = L U with row pivoting (Golub & Van Loan, *Matrix Computations*, 4th ed., §3.4).
#[derive(Clone, Debug, Default)]
pub struct Lu {
    matrix: Matrix,
    lu: Matrix,
    perm: Vec<usize>,
}

impl Lu {
    /// Factors the square matrix `a`; a pivot below n ε max|a| counts as zero.
    pub fn factor(a: &Matrix) -> Result<Lu, Singular> {
        let mut lu = Lu::default();
        lu.refactor(a, a.rows() as f64 * f64::EPSILON * max_abs(a.data()))?;
        Ok(lu)
    }

    /// Factors another matrix in the same memory; a pivot of magnitude at most `floor` counts as zero.
    pub fn refactor(&mut self, a: &Matrix, floor: f64) -> Result<(), Singular> {
        assert_eq!(a.rows(), a.cols(), "LU of a matrix that is not square");
        let n = a.rows();
        self.matrix.clone_from(a);
        self.lu.clone_from(a);
        self.perm.clear();
        self.perm.extend(0..n);
        with_length!(n, |n| self.eliminate(n, floor))
    }

    #[inline(always)]
    fn eliminate(&mut self, n: usize, floor: f64) -> Result<(), Singular> {
        for k in 0..n {
            let (mut best, mut size) = (k, self.lu.row_of(k, n)[k].abs());
            for i in k + 1..n {
                let other = self.lu.row_of(i, n)[k].abs();
                if other > size {
                    (best, size) = (i, other);
                }
            }
            if size <= floor {
                return Err(Singular { column: k });
            }
            self.lu.swap_rows(k, best);
            self.perm.swap(k, best);
            let (above, below) = self.lu.split_rows_mut(k + 1, n);
            let pivot = &above[k * n..(k + 1) * n];
            for row in below.chunks_exact_mut(n) {
                let s = row[k] / pivot[k];
                row[k] = s;
                axpy(-s, &pivot[k + 1..], &mut row[k + 1..]);
            }
        }
        Ok(())
    }

    /// x with A x = `b`, refined once (Higham, *Accuracy and Stability*, 2nd ed., §12.2).
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = vec![];
        self.solve_into(b, &mut x, &mut Default::default());
        x
    }

    /// The same into `x`, with memory for the residual and the correction.
    pub(super) fn solve_into(&self, b: &[f64], x: &mut Vec<f64>, [residual, more]: &mut [Vec<f64>; 2]) {
        self.substitute(b, x);
        residual.clear();
        residual.extend(b.iter().enumerate().map(|(i, b)| b - dot(self.matrix.row(i), x)));
        self.substitute(residual, more);
        axpy(1.0, more, x);
    }

    /// The same, not refined.
    pub(super) fn substitute(&self, b: &[f64], x: &mut Vec<f64>) {
        with_length!(self.perm.len(), |n| {
            x.clear();
            for i in 0..n {
                x.push(b[self.perm[i]] - dot(&self.lu.row_of(i, n)[..i], x));
            }
            self.back_substitute(n, &mut x[..n]);
        });
    }

    /// x ← U₁⁻¹ x with the leading block U₁ of x's size, in rows of length `n`.
    #[inline(always)]
    fn back_substitute(&self, n: usize, x: &mut [f64]) {
        let size = x.len();
        for i in (0..size).rev() {
            let row = self.lu.row_of(i, n);
            x[i] = (x[i] - dot(&row[i + 1..size], &x[i + 1..])) / row[i];
        }
    }

    fn substitute_transposed(&self, b: &[f64]) -> Vec<f64> {
        let (n, mut y) = (b.len(), b.to_vec());
        for i in 0..n {
            y[i] /= self.lu[(i, i)];
            let s = y[i];
            axpy(-s, &self.lu.row(i)[i + 1..], &mut y[i + 1..]);
        }
        for i in (0..n).rev() {
            let s = y[i];
            axpy(-s, &self.lu.row(i)[..i], &mut y[..i]);
        }
        let mut x = vec![0.0; n];
        self.perm.iter().zip(&y).for_each(|(&p, &v)| x[p] = v);
        x
    }

    /// A vector y with A y ≈ 0, after a [`Singular`] refusal at `column`; its entry there is 1.
    pub fn null_vector(&self, column: usize) -> Vec<f64> {
        let mut y: Vec<f64> = (0..column).map(|i| -self.lu[(i, column)]).collect();
        self.back_substitute(self.lu.cols(), &mut y);
        y.resize(self.lu.rows(), 0.0);
        y[column] = 1.0;
        y
    }

    /// A lower estimate, rarely far off, of the condition number ‖A‖₁ ‖A⁻¹‖₁
    /// (Hager 1984; Higham, *Accuracy and Stability*, 2nd ed., alg. 15.1).
    pub fn condition(&self) -> f64 {
        let n = self.matrix.rows();
        let mut x = vec![1.0 / n as f64; n];
        let mut inverse = 0.0_f64;
        for _ in 0..5 {
            let mut y = vec![];
            self.substitute(&x, &mut y);
            let norm = y.iter().map(|v| v.abs()).sum::<f64>();
            let signs: Vec<f64> = y.iter().map(|v| 1_f64.copysign(*v)).collect();
            let z = self.substitute_transposed(&signs);
            let steepest = (0..n).fold(0, |p, i| if z[i].abs() > z[p].abs() { i } else { p });
            if norm <= inverse || n == 0 {
                break;
            }
            inverse = norm;
            if z[steepest].abs() <= dot(&z, &x) {
                break;
            }
            x.fill(0.0);
            x[steepest] = 1.0;
        }
        inverse * self.norm()
    }

    /// ‖A‖₁.
    fn norm(&self) -> f64 {
        let a = &self.matrix;
        let column = |j| (0..a.rows()).map(|i| a[(i, j)].abs()).sum::<f64>();
        (0..a.cols()).map(column).fold(0.0, f64::max)
    }
}
