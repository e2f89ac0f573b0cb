//! The equations of an instant by their multipliers alone, where every motion has inertia and it is clear which rows depend on others.

use super::islands::Groups;
use super::{axpy, dot, largest, Matrix, Solution};

/// Pivot, over what it was before others were eliminated, below which digits may be lost.
const CLEAR: f64 = 1e-3;
/// The same below which it is round-off: the row depends on those before it.
const DEPENDENT: f64 = 1e-10;
/// What rows that depend on others leave open of what they ask for, over the terms of which it is the rest, that is round-off.
const MET: f64 = 1e-9;

/// W λ = r − G M⁻¹ f with W = G M⁻¹ Bᵀ (Delassus), and M a = f + Bᵀ λ. M = L D Lᵀ within its envelope (George & Liu, *Computer
/// Solution of Large Sparse Positive Definite Systems*, 1981, ch. 4): bodies that share no inertia cost nothing together, and rows
/// that share no unknown are eliminated apart.
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
    groups: Groups,
    blocks: Vec<Block>,
    x: Vec<f64>,
    part: Vec<f64>,
}

/// Entries with their places.
type Sparse = Vec<(usize, f64)>;

/// Rows that share unknowns, by way of others too.
#[derive(Clone, Debug, Default)]
struct Block {
    /// Its part of W in its factors, rows and columns in the order of their pivots.
    w: Matrix,
    order: [Vec<usize>; 2],
    /// Of each row that is not eliminated its largest entry.
    largest: Vec<f64>,
    rank: usize,
    side: Vec<f64>,
}

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
        self.group();
        self.condense() && self.blocks.iter_mut().all(Block::eliminate) && self.is_determinate()
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

    /// Finds the rows of each block.
    fn group(&mut self) {
        let Condensed { rows, forces, groups, blocks, .. } = self;
        let own = if self.has_own_forces { &forces[..] } else { &[] };
        let touched = |i: usize| rows[i].iter().chain(own.get(i).into_iter().flatten()).map(|&(k, _)| k);
        groups.begin(self.inverse_pivots.len());
        (0..rows.len()).for_each(|i| groups.join(touched(i)));
        blocks.resize_with(groups.number(), Block::default);
        blocks.iter_mut().for_each(|block| block.order[0].clear());
        for i in 0..rows.len() {
            // A row that moves nothing is found in any.
            let group = touched(i).next().map_or(0, |k| groups.of[k]);
            blocks[group].order[0].push(i);
        }
    }

    /// W, made of order one; false where a row moves nothing.
    fn condense(&mut self) -> bool {
        let Condensed { rows, forces, inverse_pivots, scale, acting, blocks, .. } = self;
        let size = |row: &Sparse| row.iter().map(|&(k, x)| x * x * inverse_pivots[k]).sum::<f64>();
        scale.clear();
        scale.extend(rows.iter().map(|row| 1.0 / size(row).sqrt()));
        acting.iter_mut().for_each(Sparse::clear);
        acting.resize_with(inverse_pivots.len(), Sparse::new);
        let forces = if self.has_own_forces { forces } else { &*rows };
        for Block { order: [own, _], w, .. } in &mut *blocks {
            for (j, &force) in own.iter().enumerate() {
                forces[force].iter().for_each(|&(k, x)| acting[k].push((j, x * inverse_pivots[k] * scale[force])));
            }
            w.reset(own.len(), own.len());
            for (i, &row) in own.iter().enumerate() {
                let out = w.row_mut(i);
                for &(k, x) in &rows[row] {
                    acting[k].iter().for_each(|&(j, force)| out[j] += x * force);
                }
                out.iter_mut().for_each(|entry| *entry *= scale[row]);
            }
        }
        blocks.iter().all(|block| block.w.data().iter().all(|entry| entry.is_finite()))
    }

    /// Whether rows of W that depend on others are rows of G that do, and columns of B: else forces of their own move what no row
    /// sees, or a row asks for what no force does.
    fn is_determinate(&mut self) -> bool {
        // With W = V Vᵀ, as many rows of V depend on others as of W.
        if !self.has_own_forces {
            return true;
        }
        let Condensed { rows, forces, scale, inverse_pivots, blocks, x, part, .. } = self;
        let mut is_nothing = |of: &[Sparse], order: &[usize], part: &[f64]| {
            x.clear();
            x.resize(inverse_pivots.len(), 0.0);
            for (&i, part) in order.iter().zip(part) {
                of[i].iter().for_each(|&(k, entry)| x[k] += entry * part * scale[i]);
            }
            x.iter().zip(&*inverse_pivots).map(|(x, inverse)| x * x * inverse).sum::<f64>() <= DEPENDENT
        };
        let mut depends_alike = |block: &Block, i: usize| {
            block.write_dependence(i, part);
            let depends = is_nothing(rows, &block.order[0], part);
            block.write_stress(i, part);
            depends && is_nothing(forces, &block.order[1], part)
        };
        blocks.iter().all(|block| (block.rank..block.order[0].len()).all(|i| depends_alike(block, i)))
    }

    /// m × d: the multipliers with Bᵀ λ = 0; the largest entry of each column is 1.
    pub fn self_stress(&self) -> Matrix {
        let dependent = |block: &Block| block.order[0].len() - block.rank;
        let mut all = Matrix::zeros(self.rows.len(), self.blocks.iter().map(dependent).sum());
        let (mut column, mut part) = (0, vec![]);
        for block in &self.blocks {
            for i in block.rank..block.order[0].len() {
                block.write_stress(i, &mut part);
                let scaled = || block.order[1].iter().zip(&part).map(|(&j, x)| (j, x * self.scale[j]));
                let largest = scaled().fold(0.0, |most: f64, (_, x)| if x.abs() > most.abs() { x } else { most });
                scaled().for_each(|(j, x)| all[(j, column)] = x / largest);
                column += 1;
            }
        }
        all
    }

    /// Solves for applied forces f (n) and right-hand sides r (m): into `found`. Of multipliers that depend on others some are 0; what
    /// contradicts others is left open, and told.
    pub fn solve_into(&mut self, f: &[f64], r: &[f64], found: &mut Solution) {
        let Solution { a, lambda, inconsistency } = found;
        f.clone_into(a);
        forward(&self.lower, &self.first, a);
        a.iter_mut().zip(&self.inverse_pivots).for_each(|(a, inverse)| *a *= inverse);
        let terms = |i: usize| self.rows[i].iter().map(|&(k, x)| x * a[k]);
        let size = |i: usize| (r[i].abs() + terms(i).map(f64::abs).sum::<f64>()) * self.scale[i];
        lambda.clear();
        lambda.resize(r.len(), 0.0);
        let mut open = 0.0_f64;
        for block in &mut self.blocks {
            block.side.clear();
            block.side.extend(block.order[0].iter().map(|&i| (r[i] - terms(i).sum::<f64>()) * self.scale[i]));
            block.substitute();
            open = open.max(largest(block.side[block.rank..].iter().copied()));
            for (&j, x) in block.order[1].iter().zip(&block.side[..block.rank]) {
                lambda[j] = x * self.scale[j];
            }
        }
        *inconsistency = if open > 0.0 && open > MET * largest((0..r.len()).map(size)) { open } else { 0.0 };
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
}

impl Block {
    /// W = L U with the largest pivot of all that is left (Golub & Van Loan, *Matrix Computations*, 4th ed., §3.4.6), down to what is
    /// round-off; false where a pivot is neither large nor that.
    fn eliminate(&mut self) -> bool {
        let Block { w, largest, order: [rows, columns], .. } = self;
        let m = rows.len();
        columns.clone_from(rows);
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
            rows.swap(k, i);
            columns.swap(k, j);
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

    /// What dependent row i is of those before it: parts of rows, in the order of their pivots, that add up to nothing.
    fn write_dependence(&self, i: usize, out: &mut Vec<f64>) {
        out.clear();
        out.resize(i, 0.0);
        out.push(1.0);
        for k in (0..self.rank).rev() {
            out[k] = -self.w[(i, k)] - (k + 1..self.rank).map(|j| out[j] * self.w[(j, k)]).sum::<f64>();
        }
    }

    /// Multipliers, in the order of their pivots and of order one, of which W makes nothing: that of dependent column i and those before.
    fn write_stress(&self, i: usize, out: &mut Vec<f64>) {
        out.clear();
        out.resize(i, 0.0);
        out.push(1.0);
        for k in (0..self.rank).rev() {
            let row = self.w.row(k);
            out[k] = -(row[i] + dot(&row[k + 1..self.rank], &out[k + 1..self.rank])) / row[k];
        }
    }

    /// The multipliers in the order of their pivots, and behind them what is left open of the rows that depend on others.
    fn substitute(&mut self) {
        for i in 0..self.side.len() {
            let known = i.min(self.rank);
            self.side[i] -= dot(&self.w.row(i)[..known], &self.side[..known]);
        }
        for i in (0..self.rank).rev() {
            let row = &self.w.row(i)[..self.rank];
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
