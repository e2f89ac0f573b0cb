//! Sparse L D Lᵀ factors of a quasi-definite matrix.

use std::ops::Range;

/// The nonzero structure of L: found once, used by every factorisation.
#[derive(Clone, Debug, Default)]
pub(super) struct Symbolic {
    /// Column j of L fills `columns[j]..columns[j + 1]` of the values.
    columns: Vec<usize>,
    /// The row of each value.
    rows: Vec<usize>,
    /// Row k of L has its nonzeros in the columns `row_entries[row_starts[k]..row_starts[k + 1]]`.
    row_starts: Vec<usize>,
    row_entries: Vec<usize>,
}

/// A symmetric matrix by the columns of its upper triangle; the diagonal ends each column.
#[derive(Clone, Debug, Default)]
pub(super) struct Upper {
    /// Column k fills `starts[k]..starts[k + 1]`.
    pub starts: Vec<usize>,
    /// The row of each entry, ascending in a column.
    pub rows: Vec<usize>,
}

impl Upper {
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }
    pub fn column(&self, k: usize) -> Range<usize> {
        self.starts[k]..self.starts[k + 1]
    }
    /// y ← y + factor K x.
    pub fn add_product(&self, values: &[f64], factor: f64, x: &[f64], y: &mut [f64]) {
        for k in 0..self.len() {
            let Range { start, end } = self.column(k);
            let (xk, mut sum) = (factor * x[k], values[end - 1] * x[k]);
            for (&row, &v) in self.rows[start..end - 1].iter().zip(&values[start..end - 1]) {
                y[row] += v * xk;
                sum += v * x[row];
            }
            y[k] += factor * sum;
        }
    }
    /// Calls f(row, column, value) for every entry of the upper triangle.
    #[inline(always)]
    pub fn each(&self, values: &[f64], mut f: impl FnMut(usize, usize, f64)) {
        for k in 0..self.len() {
            let column = self.column(k);
            self.rows[column.clone()].iter().zip(&values[column]).for_each(|(&row, &v)| f(row, k, v));
        }
    }
    /// K ← diag(s) K diag(s).
    pub fn scale(&self, s: &[f64], values: &mut [f64]) {
        for (k, &sk) in s.iter().enumerate() {
            let column = self.column(k);
            self.rows[column.clone()].iter().zip(&mut values[column]).for_each(|(&row, v)| *v *= s[row] * sk);
        }
    }
}

impl Symbolic {
    /// The rows of L from the elimination tree (Davis, *Direct Methods for Sparse Linear Systems*,
    /// 2006, §4.1 and §4.4).
    pub fn new(upper: &Upper) -> Self {
        let n = upper.len();
        let (mut parent, mut mark) = (vec![usize::MAX; n], vec![usize::MAX; n]);
        let (mut row_starts, mut row_entries) = (vec![0], Vec::new());
        let mut counts = vec![0; n];
        for k in 0..n {
            mark[k] = k;
            for p in upper.column(k) {
                let mut j = upper.rows[p];
                while mark[j] != k {
                    if parent[j] == usize::MAX {
                        parent[j] = k;
                    }
                    mark[j] = k;
                    counts[j] += 1;
                    row_entries.push(j);
                    j = parent[j];
                }
            }
            row_entries[row_starts[k]..].sort_unstable();
            row_starts.push(row_entries.len());
        }
        let columns = running_sum(&counts);
        let rows = rows_by_column(&columns, &row_starts, &row_entries);
        Symbolic { columns, rows, row_starts, row_entries }
    }

    /// Nonzeros of L below the diagonal.
    pub fn fill(&self) -> usize {
        self.rows.len()
    }

    /// Multiply-adds of one factorisation: Σ c(c + 1)/2 + c over the column counts c of L.
    pub fn flops(&self) -> f64 {
        let counts = self.columns.windows(2).map(|w| (w[1] - w[0]) as f64);
        counts.map(|c| c * (c + 3.0) / 2.0).sum()
    }
}

/// [0, c₀, c₀ + c₁, …].
pub(super) fn running_sum(counts: &[usize]) -> Vec<usize> {
    let mut sums = vec![0];
    for (i, c) in counts.iter().enumerate() {
        sums.push(sums[i] + c);
    }
    sums
}

fn rows_by_column(columns: &[usize], row_starts: &[usize], entries: &[usize]) -> Vec<usize> {
    let (mut next, mut rows) = (columns.to_vec(), vec![0; entries.len()]);
    for k in 0..row_starts.len() - 1 {
        for &j in &entries[row_starts[k]..row_starts[k + 1]] {
            rows[next[j]] = k;
            next[j] += 1;
        }
    }
    rows
}

/// The values of L and D.
#[derive(Clone, Debug, Default)]
pub(super) struct Ldl {
    values: Vec<f64>,
    inverse_pivots: Vec<f64>,
    next: Vec<usize>,
    work: Vec<f64>,
}

impl Ldl {
    /// Factors K + diag(shift), row after row of L. A pivot that round-off has brought below its
    /// shift, or past zero, is replaced by the shift.
    pub fn factor(&mut self, s: &Symbolic, upper: &Upper, values: &[f64], shift: &[f64]) {
        let n = upper.len();
        self.values.resize(s.fill(), 0.0);
        self.inverse_pivots.resize(n, 0.0);
        self.next.clear();
        self.next.extend_from_slice(&s.columns[..n]);
        self.work.clear();
        self.work.resize(n, 0.0);
        for (k, &shift) in shift.iter().enumerate() {
            for p in upper.column(k) {
                self.work[upper.rows[p]] = values[p];
            }
            let pivot = shift + std::mem::take(&mut self.work[k]) - self.eliminate_row(s, k);
            let too_small = pivot * shift.signum() < shift.abs();
            self.inverse_pivots[k] = 1.0 / if too_small { shift } else { pivot };
        }
    }

    /// Row k of L by forward substitution; returns Σ lₖⱼ² dⱼ.
    fn eliminate_row(&mut self, s: &Symbolic, k: usize) -> f64 {
        let mut square = 0.0;
        for &j in &s.row_entries[s.row_starts[k]..s.row_starts[k + 1]] {
            let y = std::mem::take(&mut self.work[j]);
            let (start, end) = (s.columns[j], self.next[j]);
            for (row, l) in s.rows[start..end].iter().zip(&self.values[start..end]) {
                self.work[*row] -= l * y;
            }
            let l = y * self.inverse_pivots[j];
            square += l * y;
            self.values[end] = l;
            self.next[j] = end + 1;
        }
        square
    }

    /// x ← (L D Lᵀ)⁻¹ x.
    pub fn solve(&self, s: &Symbolic, x: &mut [f64]) {
        let column = |j: usize| s.columns[j]..s.columns[j + 1];
        for j in 0..x.len() {
            let xj = x[j];
            for p in column(j) {
                x[s.rows[p]] -= self.values[p] * xj;
            }
        }
        for j in (0..x.len()).rev() {
            let sum: f64 = column(j).map(|p| self.values[p] * x[s.rows[p]]).sum();
            x[j] = x[j] * self.inverse_pivots[j] - sum;
        }
    }
}
