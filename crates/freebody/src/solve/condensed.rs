//! The equations of an instant by their multipliers alone, where every motion has inertia and it is clear which rows depend on others.

use super::{axpy, dot, largest, Matrix, Solution};

/// Pivot, over what it was before others were eliminated, below which digits may be lost.
const CLEAR: f64 = 1e-3;
/// The same below which it is round-off: the row depends on those before it.
const DEPENDENT: f64 = 1e-10;
/// What rows that depend on others leave open of what they ask for, over the terms of which it is the rest, that is round-off.
const MET: f64 = 1e-9;

/// W λ = r − G M⁻¹ f with W = G M⁻¹ Bᵀ (Delassus), and M a = f + Bᵀ λ. M = L D Lᵀ within its envelope (George & Liu, *Computer
/// Solution of Large Sparse Positive Definite Systems*, 1981, ch. 4): bodies that share no inertia cost nothing together.
#[derive(Clone, Debug, Default)]
pub struct Condensed {
    lower: Matrix,
    /// Of each row of L its first entry.
    first: Vec<usize>,
    /// Of each row of L where its block ends: what lies beyond shares no inertia with it.
    ends: Vec<usize>,
    inverse_pivots: Vec<f64>,
    /// L⁻¹ Gᵀ and L⁻¹ Bᵀ, column after column, as far as they are not 0.
    rows: Vec<Sparse>,
    forces: Vec<Sparse>,
    has_own_forces: bool,
    /// Of each unknown what acts on it.
    acting: Vec<Sparse>,
    /// What makes the rows of order one.
    scale: Vec<f64>,
    /// W in its factors, rows and columns in the order of their pivots.
    condensed: Matrix,
    order: [Vec<usize>; 2],
    /// Of each row that is not eliminated its largest entry.
    largest: Vec<f64>,
    rank: usize,
    side: Vec<f64>,
    x: Vec<f64>,
}

/// Entries with their places.
type Sparse = Vec<(usize, f64)>;

impl Condensed {
    /// Factors other equations, false where it declines; `b`: what the multipliers act along, G if none.
    pub fn refactor(&mut self, mass: &Matrix, g: &Matrix, b: Option<&Matrix>) -> bool {
        self.has_own_forces = b.is_some();
        if !self.factor_mass(mass) {
            return false;
        }
        let mut rows = std::mem::take(&mut self.rows);
        self.half_solve(g, &mut rows);
        self.rows = rows;
        if let Some(b) = b {
            let mut forces = std::mem::take(&mut self.forces);
            self.half_solve(b, &mut forces);
            self.forces = forces;
        }
        self.condense() && self.eliminate() && self.is_determinate()
    }

    /// Whether the multipliers act along others than G.
    pub fn has_own_forces(&self) -> bool {
        self.has_own_forces
    }

    fn factor_mass(&mut self, mass: &Matrix) -> bool {
        let n = mass.rows();
        self.lower.clone_from(mass);
        self.first.clear();
        self.first.extend((0..n).map(|i| mass.row(i)[..i].iter().position(|&x| x != 0.0).unwrap_or(i)));
        self.ends.clear();
        self.ends.resize(n, n);
        let mut least = n;
        for i in (1..n).rev() {
            least = least.min(self.first[i]);
            self.ends[i - 1] = if least == i { i } else { self.ends[i] };
        }
        self.inverse_pivots.clear();
        for i in 0..n {
            let (above, from) = self.lower.split_rows_mut(i, n);
            let (row, first) = (&mut from[..n], self.first[i]);
            for j in first..i {
                let (other, begin) = (&above[j * n..], self.first[j].max(first));
                row[j] -= dot(&row[begin..j], &other[begin..j]);
            }
            // So far each entry is that of L times its pivot.
            let mut pivot = row[i];
            for (entry, inverse) in row[first..i].iter_mut().zip(&self.inverse_pivots[first..]) {
                let part = *entry * inverse;
                pivot -= part * *entry;
                *entry = part;
            }
            if pivot.is_nan() || pivot <= CLEAR * row[i] {
                return false;
            }
            self.inverse_pivots.push(1.0 / pivot);
        }
        true
    }

    /// L⁻¹ of the rows of a matrix, block of M by block.
    fn half_solve(&mut self, of: &Matrix, out: &mut Vec<Sparse>) {
        out.resize_with(of.rows(), Sparse::new);
        for (i, out) in out.iter_mut().enumerate() {
            out.clear();
            self.x.clear();
            self.x.extend_from_slice(of.row(i));
            let mut end = 0;
            while let Some(more) = self.x[end..].iter().position(|&x| x != 0.0) {
                let begin = end + more;
                end = self.ends[begin];
                for k in begin..end {
                    let first = self.first[k].max(begin);
                    self.x[k] -= dot(&self.lower.row(k)[first..k], &self.x[first..k]);
                }
                out.extend((begin..end).map(|k| (k, self.x[k])).filter(|(_, x)| *x != 0.0));
            }
        }
    }

    /// W, made of order one; false where a row moves nothing.
    fn condense(&mut self) -> bool {
        let Condensed { rows, forces, inverse_pivots, scale, acting, condensed, .. } = self;
        let size = |row: &Sparse| row.iter().map(|&(k, x)| x * x * inverse_pivots[k]).sum::<f64>();
        scale.clear();
        scale.extend(rows.iter().map(|row| 1.0 / size(row).sqrt()));
        acting.iter_mut().for_each(Sparse::clear);
        acting.resize_with(inverse_pivots.len(), Sparse::new);
        for (j, force) in if self.has_own_forces { forces } else { &*rows }.iter().enumerate() {
            force.iter().for_each(|&(k, x)| acting[k].push((j, x * inverse_pivots[k] * scale[j])));
        }
        condensed.reset(rows.len(), rows.len());
        for (i, row) in rows.iter().enumerate() {
            let out = condensed.row_mut(i);
            for &(k, x) in row {
                acting[k].iter().for_each(|&(j, force)| out[j] += x * force);
            }
            out.iter_mut().for_each(|entry| *entry *= scale[i]);
        }
        condensed.data().iter().all(|entry| entry.is_finite())
    }

    /// W = L U with the largest pivot of all that is left (Golub & Van Loan, *Matrix Computations*, 4th ed., §3.4.6), down to what is
    /// round-off; false where a pivot is neither large nor that.
    fn eliminate(&mut self) -> bool {
        let (w, m, largest) = (&mut self.condensed, self.rows.len(), &mut self.largest);
        self.order.iter_mut().for_each(|order| order.splice(.., 0..m).for_each(drop));
        largest.clear();
        largest.extend((0..m).map(|i| magnitude(w.row(i))));
        for k in 0..m {
            let i = (k..m).fold(k, |best, i| if largest[i] > largest[best] { i } else { best });
            self.rank = k;
            if largest[i] <= DEPENDENT {
                return true;
            }
            if largest[i].is_nan() || largest[i] <= CLEAR {
                return false;
            }
            let at = w.row(i)[k..].iter().position(|x| x.abs() == largest[i]);
            let j = k + at.expect("the largest is an entry");
            w.swap_rows(k, i);
            (0..m).for_each(|row| w.row_mut(row).swap(k, j));
            self.order[0].swap(k, i);
            self.order[1].swap(k, j);
            largest.swap(k, i);
            let (above, below) = w.split_rows_mut(k + 1, m);
            let pivot = &above[k * m..];
            for (row, largest) in below.chunks_exact_mut(m).zip(&mut largest[k + 1..]) {
                row[k] /= pivot[k];
                // What shares no body with the pivot stays as it is.
                if row[k] != 0.0 {
                    axpy(-row[k], &pivot[k + 1..], &mut row[k + 1..]);
                    *largest = magnitude(&row[k + 1..]);
                }
            }
        }
        self.rank = m;
        true
    }

    /// Whether rows of W that depend on others are rows of G that do, and columns of B: else forces of their own move what no row
    /// sees, or a row asks for what no force does.
    fn is_determinate(&mut self) -> bool {
        // With W = V Vᵀ, as many rows of V depend on others as of W.
        !self.has_own_forces || (self.rank..self.rows.len()).all(|i| self.depends_alike(i))
    }

    fn depends_alike(&mut self, i: usize) -> bool {
        let (w, rank) = (&self.condensed, self.rank);
        self.side.clear();
        self.side.resize(i, 0.0);
        self.side.push(1.0);
        for k in (0..rank).rev() {
            self.side[k] = -w[(i, k)] - (k + 1..rank).map(|j| self.side[j] * w[(j, k)]).sum::<f64>();
        }
        if !self.is_nothing(0) {
            return false;
        }
        let mut side = std::mem::take(&mut self.side);
        self.write_stress(i, &mut side);
        self.side = side;
        self.is_nothing(1)
    }

    /// Multipliers, in the order of their pivots and of order one, of which W makes nothing: that of dependent column i and those before.
    fn write_stress(&self, i: usize, out: &mut [f64]) {
        let (w, rank) = (&self.condensed, self.rank);
        out[rank..].fill(0.0);
        out[i] = 1.0;
        for k in (0..rank).rev() {
            out[k] = -(w[(k, i)] + (k + 1..rank).map(|j| w[(k, j)] * out[j]).sum::<f64>()) / w[(k, k)];
        }
    }

    /// m × d: the multipliers with Bᵀ λ = 0; the largest entry of each column is 1.
    pub fn self_stress(&self) -> Matrix {
        let (rank, m) = (self.rank, self.rows.len());
        let mut all = Matrix::zeros(m, m - rank);
        let mut part = vec![0.0; m];
        for i in rank..m {
            self.write_stress(i, &mut part);
            let scaled = || self.order[1].iter().zip(&part).map(|(&j, x)| (j, x * self.scale[j]));
            let largest = scaled().fold(0.0, |most: f64, (_, x)| if x.abs() > most.abs() { x } else { most });
            scaled().for_each(|(j, x)| all[(j, i - rank)] = x / largest);
        }
        all
    }

    /// Whether the rows of G (0), or columns of B (1), add up to nothing, each with its part.
    fn is_nothing(&mut self, which: usize) -> bool {
        let of = if which == 0 { &self.rows } else { &self.forces };
        self.x.fill(0.0);
        for (&i, part) in self.order[which].iter().zip(&self.side) {
            of[i].iter().for_each(|&(k, x)| self.x[k] += x * part * self.scale[i]);
        }
        let size: f64 = self.x.iter().zip(&self.inverse_pivots).map(|(x, inverse)| x * x * inverse).sum();
        size <= DEPENDENT
    }

    /// Solves for applied forces f (n) and right-hand sides r (m): into `found`. Of multipliers that depend on others some are 0; what
    /// contradicts others is left open, and told.
    pub fn solve_into(&mut self, f: &[f64], r: &[f64], found: &mut Solution) {
        let Solution { a, lambda, inconsistency } = found;
        f.clone_into(a);
        forward(&self.lower, &self.first, a);
        a.iter_mut().zip(&self.inverse_pivots).for_each(|(a, inverse)| *a *= inverse);
        let terms = |i: usize| self.rows[i].iter().map(|&(k, x)| x * a[k]);
        self.side.clear();
        self.side.extend(self.order[0].iter().map(|&i| (r[i] - terms(i).sum::<f64>()) * self.scale[i]));
        let size = |i: usize| (r[i].abs() + terms(i).map(f64::abs).sum::<f64>()) * self.scale[i];
        let most = if self.rank < r.len() { largest((0..r.len()).map(size)) } else { 0.0 };
        self.substitute();
        let open = largest(self.side[self.rank..].iter().copied());
        *inconsistency = if open > MET * most { open } else { 0.0 };
        lambda.clear();
        lambda.resize(r.len(), 0.0);
        for (&j, x) in self.order[1].iter().zip(&self.side[..self.rank]) {
            lambda[j] = x * self.scale[j];
        }
        let forces = if self.has_own_forces { &self.forces } else { &self.rows };
        for (force, lambda) in forces.iter().zip(&*lambda) {
            force.iter().for_each(|&(k, x)| a[k] += x * self.inverse_pivots[k] * lambda);
        }
        for i in (0..a.len()).rev() {
            let first = self.first[i];
            let (before, own) = a.split_at_mut(i);
            before[first..].iter_mut().zip(&self.lower.row(i)[first..i]).for_each(|(x, l)| *x -= l * own[0]);
        }
    }

    /// The multipliers in the order of their pivots, and behind them what is left open of the rows that depend on others.
    fn substitute(&mut self) {
        for i in 0..self.side.len() {
            let known = i.min(self.rank);
            self.side[i] -= dot(&self.condensed.row(i)[..known], &self.side[..known]);
        }
        for i in (0..self.rank).rev() {
            let row = &self.condensed.row(i)[..self.rank];
            self.side[i] = (self.side[i] - dot(&row[i + 1..], &self.side[i + 1..self.rank])) / row[i];
        }
    }
}

/// The largest magnitude, by lanes.
fn magnitude(x: &[f64]) -> f64 {
    let (most, rest) = x.as_chunks::<8>();
    let larger = |a: f64, b: f64| if b.abs() > a { b.abs() } else { a };
    let lanes = most.iter().fold([0.0; 8], |all, x| std::array::from_fn(|i| larger(all[i], x[i])));
    lanes.iter().chain(rest).fold(0.0, |all, &x| larger(all, x))
}

/// x ← L⁻¹ x.
fn forward(lower: &Matrix, first: &[usize], x: &mut [f64]) {
    for (i, &first) in first.iter().enumerate() {
        x[i] -= dot(&lower.row(i)[first..i], &x[first..i]);
    }
}
