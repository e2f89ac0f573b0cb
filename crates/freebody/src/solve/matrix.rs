//! A small dense matrix.

use super::{axpy, dot};
use std::ops::{Index, IndexMut};

/// A dense matrix, stored by rows; entry (i, j) is `m[(i, j)]`.
///
/// Products panic when the shapes do not fit.
#[derive(Debug, Default, PartialEq)]
pub struct Matrix {
    rows: usize,
    cols: usize,
    data: Vec<f64>,
}

impl Clone for Matrix {
    fn clone(&self) -> Self {
        Matrix { data: self.data.clone(), ..*self }
    }
    /// Keeps its memory.
    fn clone_from(&mut self, other: &Self) {
        (self.rows, self.cols) = (other.rows, other.cols);
        self.data.clone_from(&other.data);
    }
}

impl Matrix {
    /// rows × cols zeros.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Matrix { rows, cols, data: vec![0.0; rows * cols] }
    }
    /// The n × n identity.
    pub fn identity(n: usize) -> Self {
        Matrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { 0.0 })
    }
    /// The matrix with entries `f(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> f64) -> Self {
        let mut m = Matrix::default();
        m.fill(rows, cols, &mut f);
        m
    }
    /// Becomes the rows × cols matrix with entries `f(i, j)` and keeps its memory.
    pub fn fill(&mut self, rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> f64) {
        self.data.clear();
        self.data.reserve(rows * cols);
        (0..rows).for_each(|i| self.data.extend((0..cols).map(|j| f(i, j))));
        (self.rows, self.cols) = (rows, cols);
    }
    /// Becomes rows × cols zeros and keeps its memory.
    pub fn reset(&mut self, rows: usize, cols: usize) {
        self.data.clear();
        self.data.resize(rows * cols, 0.0);
        (self.rows, self.cols) = (rows, cols);
    }
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// Number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }
    /// All entries, row after row.
    pub fn data(&self) -> &[f64] {
        &self.data
    }
    /// Row i.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }
    /// Row i, to be written.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.data[i * self.cols..(i + 1) * self.cols]
    }
    /// Row i of rows that are `n` long, as the caller knows.
    #[inline(always)]
    pub(super) fn row_of(&self, i: usize, n: usize) -> &[f64] {
        &self.data[i * n..(i + 1) * n]
    }
    /// The same, to be written.
    #[inline(always)]
    pub(super) fn row_of_mut(&mut self, i: usize, n: usize) -> &mut [f64] {
        &mut self.data[i * n..(i + 1) * n]
    }
    /// The first `i` of rows that are `n` long, and the others, both to be written.
    #[inline(always)]
    pub(super) fn split_rows_mut(&mut self, i: usize, n: usize) -> (&mut [f64], &mut [f64]) {
        self.data.split_at_mut(i * n)
    }
    /// Rows i ≠ j, both to be written.
    pub fn two_rows_mut(&mut self, i: usize, j: usize) -> (&mut [f64], &mut [f64]) {
        let n = self.cols;
        if i < j {
            let (head, tail) = self.data.split_at_mut(j * n);
            (&mut head[i * n..(i + 1) * n], &mut tail[..n])
        } else {
            let (head, tail) = self.data.split_at_mut(i * n);
            (&mut tail[..n], &mut head[j * n..(j + 1) * n])
        }
    }
    /// Exchanges rows i and j.
    pub fn swap_rows(&mut self, i: usize, j: usize) {
        if i != j {
            let (a, b) = self.two_rows_mut(i, j);
            a.swap_with_slice(b);
        }
    }
    /// The product A B.
    pub fn mul(&self, b: &Matrix) -> Matrix {
        assert_eq!(self.cols, b.rows, "inner sizes of a product");
        let mut c = Matrix::zeros(self.rows, b.cols);
        for i in 0..self.rows {
            b.add_t_mul_vec(self.row(i), c.row_mut(i));
        }
        c
    }
    /// The product Aᵀ B.
    pub fn t_mul(&self, b: &Matrix) -> Matrix {
        assert_eq!(self.rows, b.rows, "inner sizes of a product");
        let mut c = Matrix::zeros(self.cols, b.cols);
        for k in 0..self.rows {
            for (i, &s) in self.row(k).iter().enumerate() {
                axpy(s, b.row(k), c.row_mut(i));
            }
        }
        c
    }
    /// The product A x.
    pub fn mul_vec(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![];
        self.mul_vec_into(x, &mut y);
        y
    }
    /// y becomes the product A x.
    pub fn mul_vec_into(&self, x: &[f64], y: &mut Vec<f64>) {
        assert_eq!(self.cols, x.len(), "inner sizes of a product");
        y.clear();
        y.extend((0..self.rows).map(|i| dot(self.row(i), x)));
    }
    /// y ← y + Aᵀ x.
    pub fn add_t_mul_vec(&self, x: &[f64], y: &mut [f64]) {
        assert_eq!((self.rows, self.cols), (x.len(), y.len()), "sizes of a product");
        for (i, &s) in x.iter().enumerate() {
            axpy(s, self.row(i), y);
        }
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.data[i * self.cols + j]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.data[i * self.cols + j]
    }
}
