//! The block-sparse solver for mechanisms of many bodies and loops.

use super::gmres;
use super::ldl::{running_sum, Ldl, Symbolic, Upper};
use super::{max_abs, minimum_degree};
use std::fmt;

/// Regularisation of bodies (+) and rows (−), relative to the equilibrated matrix. It balances the
/// error it makes, of its own order, against the growth ε⁻¹ of round-off at a massless body.
const SHIFT: f64 = 1e-8;
/// The scaled residual aimed at, and the largest one accepted.
const TARGET: f64 = 1e-14;
const ACCEPTED: f64 = 1e-9;
/// Refinement cycles; each has up to twenty steps.
const CYCLES: usize = 10;

/// The structure of K = [M Gᵀ; G 0], analysed once for all instants of a mechanism.
///
/// Nodes are numbered bodies first, then joints: a body is a block of unknown accelerations, a joint
/// a block of constraint rows.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// First unknown of each node in the caller's order.
    starts: Vec<usize>,
    bodies: usize,
    /// First unknown of each node in elimination order.
    places: Vec<usize>,
    /// For each node, the partners eliminated before it (and itself), with the offset of their block
    /// in the node's columns.
    blocks: Vec<Vec<(usize, usize)>>,
    upper: Upper,
    symbolic: Symbolic,
}

impl Pattern {
    /// Analyses bodies and joints with the given numbers of unknowns (at least 1 each); `edges` are
    /// the pairs of nodes with a nonzero block between them, in any order.
    pub fn new(bodies: &[usize], joints: &[usize], edges: &[(usize, usize)]) -> Pattern {
        let sizes = [bodies, joints].concat();
        assert!(sizes.iter().all(|&s| s > 0), "a node without unknowns");
        let order = minimum_degree(&sizes, edges);
        let mut places = vec![0; sizes.len()];
        let mut place = 0;
        for &i in &order {
            places[i] = place;
            place += sizes[i];
        }
        let mut pattern = Pattern {
            starts: running_sum(&sizes),
            bodies: bodies.len(),
            places,
            blocks: vec![Vec::new(); sizes.len()],
            upper: Upper { starts: vec![0], rows: Vec::new() },
            symbolic: Symbolic::default(),
        };
        pattern.set_blocks(edges);
        order.iter().for_each(|&i| pattern.push_columns(i));
        pattern.symbolic = Symbolic::new(&pattern.upper);
        pattern
    }

    fn set_blocks(&mut self, edges: &[(usize, usize)]) {
        for &(i, j) in edges.iter().filter(|(i, j)| i != j) {
            let (early, late) = if self.places[i] < self.places[j] { (i, j) } else { (j, i) };
            self.blocks[late].push((early, 0));
        }
        for i in 0..self.blocks.len() {
            let mut list = std::mem::take(&mut self.blocks[i]);
            list.push((i, 0));
            list.sort_unstable_by_key(|&(j, _)| self.places[j]);
            list.dedup();
            let mut offset = 0;
            for (j, start) in &mut list {
                *start = offset;
                offset += self.size(*j);
            }
            self.blocks[i] = list;
        }
    }

    /// Appends the columns of node i to the upper triangle.
    fn push_columns(&mut self, i: usize) {
        for column in self.places[i]..self.places[i] + self.size(i) {
            for &(j, _) in &self.blocks[i] {
                let rows = self.places[j]..self.places[j] + self.size(j);
                self.upper.rows.extend(rows.filter(|&row| row <= column));
            }
            self.upper.starts.push(self.upper.rows.len());
        }
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.upper.len()
    }

    /// Nonzeros of L below its diagonal.
    pub fn fill(&self) -> usize {
        self.symbolic.fill()
    }

    /// Multiply-adds of one factorisation.
    pub fn flops(&self) -> f64 {
        self.symbolic.flops()
    }

    fn size(&self, i: usize) -> usize {
        self.starts[i + 1] - self.starts[i]
    }

    fn nodes(&self) -> usize {
        self.places.len()
    }

    /// (unknown in the caller's order, unknown in elimination order), node by node.
    fn renumbering(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let of_node = |i: usize| (0..self.size(i)).map(move |c| (i, c));
        (0..self.nodes()).flat_map(of_node).map(|(i, c)| (self.starts[i] + c, self.places[i] + c))
    }

    /// The node of an unknown in the caller's order.
    fn node_of(&self, unknown: usize) -> usize {
        self.starts.partition_point(|&s| s <= unknown) - 1
    }

    /// Calls f(entry, value) for each stored entry of block (i, j).
    fn place_block(&self, i: usize, j: usize, block: &[f64], mut f: impl FnMut(usize, f64)) {
        let (rows, cols) = (self.size(i), self.size(j));
        assert_eq!(block.len(), rows * cols, "size of block ({i}, {j})");
        let (early, late) = if self.places[i] <= self.places[j] { (i, j) } else { (j, i) };
        let list = &self.blocks[late];
        let found = list.binary_search_by_key(&self.places[early], |&(n, _)| self.places[n]);
        let offset = list[found.unwrap_or_else(|_| panic!("no edge ({i}, {j})"))].1;
        for row in 0..rows {
            for col in 0..cols {
                let (inner, outer) = if early == i { (row, col) } else { (col, row) };
                if early != late || inner <= outer {
                    let start = self.upper.starts[self.places[late] + outer];
                    f(start + offset + inner, block[row * cols + col]);
                }
            }
        }
    }
}

/// How well a system was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Solves with the factors.
    pub iterations: usize,
    /// max |b − K x| as a fraction of max (|K| |x| + |b|), all equilibrated.
    pub residual: f64,
}

/// Refinement came to a halt far from a solution: rows that contradict each other, a loaded
/// direction without inertia, or numbers that are not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stalled {
    /// The node with the largest residual.
    pub node: usize,
    /// Residual as in [`Accuracy`].
    pub residual: f64,
}

impl fmt::Display for Stalled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "equations of node {} violated by {:e} of their terms", self.node, self.residual)
    }
}

impl std::error::Error for Stalled {}

/// Factors of K, regularised to [M + ε Gᵀ; G −ε]: a quasi-definite matrix, which has L D Lᵀ factors
/// in any order of elimination (Vanderbei, SIAM J. Optim. 5, 1995).
///
/// K is first equilibrated symmetrically (Ruiz 2001). Solutions are refined on K itself, so that the
/// regularisation leaves no trace but this one: of redundant rows' multipliers the least, in
/// equilibrated rows, is found.
#[derive(Clone, Debug)]
pub struct Factor {
    pattern: Pattern,
    values: Vec<f64>,
    scale: Vec<f64>,
    shift: Vec<f64>,
    ldl: Ldl,
}

impl Factor {
    /// Memory for the factors of matrices with this pattern (of which it keeps a copy).
    pub fn new(pattern: &Pattern) -> Factor {
        let mut shift = vec![-SHIFT; pattern.unknowns()];
        let bodies = pattern.starts[pattern.bodies];
        pattern.renumbering().take(bodies).for_each(|(_, place)| shift[place] = SHIFT);
        Factor {
            values: vec![0.0; pattern.upper.rows.len()],
            scale: vec![1.0; pattern.unknowns()],
            shift,
            ldl: Ldl::default(),
            pattern: pattern.clone(),
        }
    }

    /// Factors the sum of the blocks (i, j, values by rows), others being zero. Block (i, j) stands for
    /// its transpose (j, i) too: give one of them. Diagonal blocks are symmetric.
    ///
    /// Panics if a block has no edge in the pattern or another size.
    pub fn refactor<'a>(&mut self, blocks: impl IntoIterator<Item = (usize, usize, &'a [f64])>) {
        self.values.fill(0.0);
        let values = &mut self.values;
        for (i, j, block) in blocks {
            self.pattern.place_block(i, j, block, |entry, v| values[entry] += v);
        }
        self.equilibrate();
        self.ldl.factor(&self.pattern.symbolic, &self.pattern.upper, &self.values, &self.shift);
    }

    /// Scales rows and columns by powers of two until every row has its largest entry near 1.
    fn equilibrate(&mut self) {
        let (upper, values) = (&self.pattern.upper, &mut self.values);
        self.scale.fill(1.0);
        let mut largest = vec![0.0_f64; upper.len()];
        for _ in 0..4 {
            largest.fill(0.0);
            upper.each(|i, k, p| {
                largest[i] = largest[i].max(values[p].abs());
                largest[k] = largest[k].max(values[p].abs());
            });
            largest.iter_mut().for_each(|v| *v = inverse_root(*v));
            upper.each(|i, k, p| values[p] *= largest[i] * largest[k]);
            self.scale.iter_mut().zip(&largest).for_each(|(s, l)| *s *= l);
        }
    }

    /// Solves K x = `rhs` into `out`, both node by node in the caller's order.
    pub fn solve(&self, rhs: &[f64], out: &mut [f64]) -> Result<Accuracy, Stalled> {
        let pattern = &self.pattern;
        let n = pattern.unknowns();
        assert_eq!((rhs.len(), out.len()), (n, n), "one number for each unknown");
        let (mut b, mut x) = (vec![0.0; n], vec![0.0; n]);
        pattern.renumbering().for_each(|(i, p)| b[p] = rhs[i] * self.scale[p]);
        let (accuracy, residual) = self.refine(&b, &mut x);
        pattern.renumbering().for_each(|(i, p)| out[i] = x[p] * self.scale[p]);
        if accuracy.residual <= ACCEPTED {
            return Ok(accuracy);
        }
        let worst = pattern.renumbering().fold((0, 0.0), |w, (i, p)| {
            let size = residual[p].abs();
            if size > w.1 || size.is_nan() { (i, size) } else { w }
        });
        Err(Stalled { node: pattern.node_of(worst.0), residual: accuracy.residual })
    }

    /// Refines until the residual is round-off or no longer halves; returns the residual too.
    fn refine(&self, b: &[f64], x: &mut [f64]) -> (Accuracy, Vec<f64>) {
        let upper = &self.pattern.upper;
        let apply = |x: &[f64], y: &mut [f64]| upper.apply(&self.values, x, y);
        let mut accuracy = Accuracy { iterations: 0, residual: 0.0 };
        let (mut r, mut best) = (b.to_vec(), x.to_vec());
        let mut last = f64::INFINITY;
        for _ in 0..CYCLES {
            let size = self.residual(b, x, &mut r);
            accuracy.residual = if size == 0.0 { 0.0 } else { max_abs(&r) / size };
            if accuracy.residual <= TARGET || !(accuracy.residual <= 0.5 * last) {
                break;
            }
            last = accuracy.residual;
            best.copy_from_slice(x);
            let precondition = |v: &mut [f64]| self.ldl.solve(&self.pattern.symbolic, v);
            accuracy.iterations +=
                gmres::cycle(apply, precondition, &mut r, 0.5 * TARGET * size, x);
        }
        if accuracy.residual > last {
            x.copy_from_slice(&best);
            accuracy.residual = last;
            self.residual(b, x, &mut r);
        }
        (accuracy, r)
    }

    /// r ← b − K x; returns max (|K| |x| + |b|).
    fn residual(&self, b: &[f64], x: &[f64], r: &mut [f64]) -> f64 {
        let mut size: Vec<f64> = b.iter().map(|b| b.abs()).collect();
        r.copy_from_slice(b);
        self.pattern.upper.each(|i, k, p| {
            let v = self.values[p];
            r[i] -= v * x[k];
            size[i] += (v * x[k]).abs();
            if i != k {
                r[k] -= v * x[i];
                size[k] += (v * x[i]).abs();
            }
        });
        max_abs(&size)
    }
}

/// The power of two next below v^(-1/2); 1 for a zero row.
fn inverse_root(v: f64) -> f64 {
    if v == 0.0 || !v.is_finite() {
        return 1.0;
    }
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits((1.0 / v.sqrt()).to_bits() & EXPONENT)
}
