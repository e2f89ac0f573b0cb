//! The block-sparse solver for mechanisms of many bodies and loops.

use super::gmres;
use super::ldl::{running_sum, Ldl, Symbolic, Upper};
use super::{axpy, largest, max_abs, minimum_degree};
use std::fmt;

/// Regularisation of bodies, ε, and of rows, μ, relative to the equilibrated matrix. A massless body
/// eliminated first leaves round-off of order 10⁻¹⁶/ε in its rows, which must stay below μ.
const BODY_SHIFT: f64 = 1e-6;
const ROW_SHIFT: f64 = 1e-9;
/// Least pivot of a body's own block, equilibrated, from which its inertia needs no regularisation to speak of,
const MASSIVE: f64 = 1e-3;
/// and what it then gets.
const MASSIVE_SHIFT: f64 = 1e-13;
/// Steps of plain refinement go on while each leaves no more than this part of the residual.
const PLAIN_REDUCTION: f64 = 1e-3;
/// The residual aimed at, two units of round-off, and the largest one accepted.
const TARGET: f64 = 4e-16;
const ACCEPTED: f64 = 1e-9;
/// A residual beyond this is more than round-off: redundant rows do not quite agree.
const REDUNDANT_NOISE: f64 = 1e-14;
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

    /// Where the entry of two unknowns, in the caller's order, stands among the values.
    ///
    /// Panics if no edge of the pattern joins their nodes.
    pub fn entry(&self, a: usize, b: usize) -> usize {
        let place = |unknown: usize| {
            let node = self.node_of(unknown);
            self.places[node] + unknown - self.starts[node]
        };
        let (row, column) = (place(a).min(place(b)), place(a).max(place(b)));
        let entries = self.upper.column(column);
        entries.start + self.upper.rows[entries].binary_search(&row).expect("an edge joins the two")
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
    /// max |b − K x| as a fraction of max |K| |x| + max |b|, all equilibrated; the first two of bodies
    /// and of joints apart, the larger fraction of the two.
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

/// Factors of K, regularised to [M + ε Gᵀ; G −μ]: a quasi-definite matrix, which has L D Lᵀ factors
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
    largest: Vec<f64>,
    /// Of the solution, and of multipliers found anew.
    refinements: [Refinement; 2],
}

/// The vectors of one refinement, kept for the next: K x = b with the residual r.
#[derive(Clone, Debug, Default)]
struct Refinement {
    b: Vec<f64>,
    x: Vec<f64>,
    r: Vec<f64>,
    /// What is added to x; what x was.
    other: Vec<f64>,
    terms: Vec<f64>,
    directions: gmres::Directions,
}

impl Refinement {
    /// So long, and all 0.
    fn clear(&mut self, n: usize) {
        for vector in [&mut self.b, &mut self.x, &mut self.r, &mut self.other, &mut self.terms] {
            vector.clear();
            vector.resize(n, 0.0);
        }
    }
}

impl Factor {
    /// Memory for the factors of matrices with this pattern (of which it keeps a copy).
    pub fn new(pattern: &Pattern) -> Factor {
        let mut shift = vec![-ROW_SHIFT; pattern.unknowns()];
        let bodies = pattern.starts[pattern.bodies];
        pattern.renumbering().take(bodies).for_each(|(_, place)| shift[place] = BODY_SHIFT);
        Factor {
            values: vec![0.0; pattern.upper.rows.len()],
            scale: vec![1.0; pattern.unknowns()],
            shift,
            ldl: Ldl::default(),
            largest: vec![0.0; pattern.unknowns()],
            refinements: Default::default(),
            pattern: pattern.clone(),
        }
    }

    /// Factors the sum of the blocks (i, j, values by rows), others being zero. Block (i, j) stands for
    /// its transpose (j, i) too: give one of them. Diagonal blocks are symmetric.
    ///
    /// Panics if a block has no edge in the pattern or another size.
    pub fn refactor<B: AsRef<[f64]>>(&mut self, blocks: impl IntoIterator<Item = (usize, usize, B)>) {
        self.refactor_entries(|pattern, values| {
            for (i, j, block) in blocks {
                pattern.place_block(i, j, block.as_ref(), |entry, v| values[entry] += v);
            }
        });
    }

    /// The same from entries that `enter` writes among values that are all 0, each where [`Pattern::entry`] says.
    pub fn refactor_entries(&mut self, enter: impl FnOnce(&Pattern, &mut [f64])) {
        self.values.fill(0.0);
        enter(&self.pattern, &mut self.values);
        self.equilibrate();
        self.set_body_shifts();
        self.ldl.factor(&self.pattern.symbolic, &self.pattern.upper, &self.values, &self.shift);
    }

    /// Regularises the bodies whose own inertia does not make their blocks definite.
    fn set_body_shifts(&mut self) {
        for body in 0..self.pattern.bodies {
            let (first, size) = (self.pattern.places[body], self.pattern.size(body));
            let shift = if self.least_pivot(first, size) > MASSIVE { MASSIVE_SHIFT } else { BODY_SHIFT };
            self.shift[first..first + size].fill(shift);
        }
    }

    /// The least pivot of a diagonal block; 0 of one that is larger than a body's in the plane.
    fn least_pivot(&self, first: usize, size: usize) -> f64 {
        if size > 3 {
            return 0.0;
        }
        let (mut a, mut least) = ([[0.0; 3]; 3], f64::INFINITY);
        for k in 0..size {
            let end = self.pattern.upper.column(first + k).end;
            a[k][..=k].copy_from_slice(&self.values[end - k - 1..end]);
            for i in 0..k {
                let known: f64 = (0..i).map(|j| a[k][j] * a[i][j] / a[j][j]).sum();
                a[k][i] -= known;
            }
            let known: f64 = (0..k).map(|j| a[k][j] * a[k][j] / a[j][j]).sum();
            a[k][k] -= known;
            least = f64::min(least, a[k][k]);
            if least <= MASSIVE {
                break;
            }
        }
        least
    }

    /// Scales rows and columns by powers of two until every row has its largest entry near 1.
    fn equilibrate(&mut self) {
        let (upper, values, largest) = (&self.pattern.upper, &mut self.values, &mut self.largest);
        self.scale.fill(1.0);
        for _ in 0..4 {
            largest.fill(0.0);
            upper.each(values, |i, k, v| {
                largest[i] = largest[i].max(v.abs());
                largest[k] = largest[k].max(v.abs());
            });
            largest.iter_mut().for_each(|v| *v = inverse_root(*v));
            if largest.iter().all(|&s| s == 1.0) {
                break;
            }
            upper.scale(largest, values);
            self.scale.iter_mut().zip(&*largest).for_each(|(s, l)| *s *= l);
        }
    }

    /// Solves K x = `rhs` into `out`, both node by node in the caller's order.
    pub fn solve(&mut self, rhs: &[f64], out: &mut [f64]) -> Result<Accuracy, Stalled> {
        self.solve_to(TARGET, rhs, out)
    }

    /// The same to a residual that may be larger than round-off.
    pub fn solve_to(&mut self, target: f64, rhs: &[f64], out: &mut [f64]) -> Result<Accuracy, Stalled> {
        let n = self.pattern.unknowns();
        assert_eq!((rhs.len(), out.len()), (n, n), "one number for each unknown");
        let [mut of, mut other] = std::mem::take(&mut self.refinements);
        of.clear(n);
        self.pattern.renumbering().for_each(|(i, p)| of.b[p] = rhs[i] * self.scale[p]);
        let mut accuracy = self.refine(target, &mut of);
        if accuracy.residual > REDUNDANT_NOISE && accuracy.residual <= ACCEPTED {
            accuracy.iterations += self.correct_multipliers(&mut of, &mut other);
        }
        self.pattern.renumbering().for_each(|(i, p)| out[i] = of.x[p] * self.scale[p]);
        let solved = match accuracy.residual <= ACCEPTED {
            true => Ok(accuracy),
            false => Err(Stalled { node: self.worst(&of.r), residual: accuracy.residual }),
        };
        self.refinements = [of, other];
        solved
    }

    /// The node with the largest, or an undefined, entry of a residual.
    fn worst(&self, r: &[f64]) -> usize {
        let larger = |w: (usize, f64), (i, p): (usize, usize)| {
            if r[p].abs() <= w.1 || w.1.is_nan() {
                w
            } else {
                (i, r[p].abs())
            }
        };
        self.pattern.node_of(self.pattern.renumbering().fold((0, 0.0), larger).0)
    }

    /// Refines x, 0 at first, until the residual r is `aim`, or no longer halves.
    fn refine(&self, aim: f64, of: &mut Refinement) -> Accuracy {
        let Refinement { b, x, r, other, terms, directions } = of;
        let upper = &self.pattern.upper;
        let apply = |x: &[f64], y: &mut [f64]| {
            y.fill(0.0);
            upper.add_product(&self.values, 1.0, x, y);
        };
        let precondition = |v: &mut [f64]| self.ldl.solve(&self.pattern.symbolic, v);
        r.copy_from_slice(b);
        let mut accuracy = Accuracy { iterations: 0, residual: if max_abs(b) == 0.0 { 0.0 } else { 1.0 } };
        other.copy_from_slice(r);
        let mut sizes = None;
        while accuracy.residual > aim {
            precondition(other);
            axpy(1.0, other, x);
            let residual = self.residual(b, x, *sizes.get_or_insert_with(|| self.sizes(b, x, terms)), r);
            accuracy.iterations += 1;
            if residual.is_nan() || residual > PLAIN_REDUCTION * accuracy.residual {
                axpy(-1.0, other, x);
                accuracy.residual = self.residual(b, x, self.sizes(b, x, terms), r);
                break;
            }
            accuracy.residual = residual;
            other.copy_from_slice(r);
        }
        for _ in 0..CYCLES {
            if accuracy.residual <= aim {
                break;
            }
            other.copy_from_slice(x);
            let residual = accuracy.residual;
            let target = 0.5 * aim / residual * max_abs(r);
            accuracy.iterations += gmres::cycle(apply, precondition, directions, r, target, x);
            accuracy.residual = self.residual(b, x, self.sizes(b, x, terms), r);
            if accuracy.residual <= 0.5 * residual {
                continue;
            }
            if accuracy.residual > residual || accuracy.residual.is_nan() {
                x.copy_from_slice(other);
                accuracy.residual = self.residual(b, x, self.sizes(b, x, terms), r);
            }
            break;
        }
        accuracy
    }

    /// Frees the multipliers of what contradictions among redundant rows left in them, 1/μ times as
    /// large: finds them anew from f − M a, with rows that agree. Returns the iterations.
    fn correct_multipliers(&self, of: &mut Refinement, anew: &mut Refinement) -> usize {
        let clear_rows = |v: &mut [f64]| {
            v.iter_mut().zip(&self.shift).filter(|(_, s)| **s < 0.0).for_each(|(v, _)| *v = 0.0);
        };
        clear_rows(&mut of.x);
        anew.clear(of.b.len());
        self.residual(&of.b, &of.x, [1.0; 2], &mut anew.b);
        clear_rows(&mut anew.b);
        let iterations = self.refine(TARGET, anew).iterations;
        axpy(1.0, &anew.x, &mut of.x);
        iterations
    }

    /// r ← b − K x; returns the residual as defined by [`Accuracy`], for sizes of the terms.
    fn residual(&self, b: &[f64], x: &[f64], sizes: [f64; 2], r: &mut [f64]) -> f64 {
        r.copy_from_slice(b);
        self.pattern.upper.add_product(&self.values, -1.0, x, r);
        let left = self.largest_of_kinds(r);
        let ratio = |kind: usize| if left[kind] == 0.0 { 0.0 } else { left[kind] / sizes[kind] };
        max_abs(&[ratio(0), ratio(1)])
    }

    /// max |K| |x| + max |b|, of bodies and of joints.
    fn sizes(&self, b: &[f64], x: &[f64], terms: &mut [f64]) -> [f64; 2] {
        terms.fill(0.0);
        self.pattern.upper.each(&self.values, |i, k, v| {
            terms[i] += (v * x[k]).abs();
            if i != k {
                terms[k] += (v * x[i]).abs();
            }
        });
        let given = max_abs(b);
        self.largest_of_kinds(terms).map(|most| most + given)
    }

    /// The largest entry of bodies, and of joints.
    fn largest_of_kinds(&self, v: &[f64]) -> [f64; 2] {
        [true, false].map(|body| {
            let kind = v.iter().zip(&self.shift).filter(|(_, s)| (**s > 0.0) == body);
            largest(kind.map(|(v, _)| *v))
        })
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
