//! The orthogonal decomposition of a few constraint rows, and the decision on their rank.

use super::{axpy, dot, max_abs, with_length, Matrix};

/// Relative to the largest, a pivot or singular value below this is zero.
const RANK_TOLERANCE: f64 = 1e-10;
/// Kept and dropped values must differ by this factor for the rank to be beyond doubt.
const CLEAR_GAP: f64 = 1e3;
/// Rows whose cosine is below this are orthogonal to round-off.
const ORTHOGONAL: f64 = 1e-15;

/// A rank and what it was decided on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rank {
    /// The number of independent rows.
    pub rank: usize,
    /// Smallest kept pivot (or singular value), as a fraction of the largest; 0 when rank is 0.
    pub kept: f64,
    /// Largest dropped pivot (or singular value), as a fraction of the largest; 0 when none is.
    pub dropped: f64,
    /// Even the singular values show no clear gap (a factor 10³) between kept and dropped.
    pub uncertain: bool,
}

impl Rank {
    /// Decides on descending values.
    fn decide(values: &[f64]) -> Rank {
        let largest = values.first().copied().unwrap_or(0.0);
        let rank = values.iter().take_while(|v| **v > RANK_TOLERANCE * largest).count();
        let fraction = |v: Option<&f64>| v.map_or(0.0, |v| v / largest);
        if rank == 0 {
            return Rank::default();
        }
        let (kept, dropped) = (fraction(values.get(rank - 1)), fraction(values.get(rank)));
        Rank { rank, kept, dropped, uncertain: kept < CLEAR_GAP * dropped }
    }
}

/// G = Y₁ L X₁ᵀ: a complete orthogonal decomposition of m × n rows G, of rank r.
///
/// X (n × n) and Y (m × m) are orthogonal and are stored transposed, one basis vector to a row; X₁
/// and Y₁ are their first r vectors and the rest span ker G and ker Gᵀ; L is r × r, lower
/// triangular, in rows of length n. It comes from Householder QR of Gᵀ with column pivoting (Golub & Van Loan, *Matrix
/// Computations*, 4th ed., §5.4.2 and §5.4.7), or from the singular values where the pivots leave
/// doubt.
#[derive(Clone, Debug, Default)]
pub struct Orthogonal {
    rank: Rank,
    x: Matrix,
    y: Matrix,
    l: Matrix,
    perm: Vec<usize>,
    /// The vectors of the reflections whose product is X, 0 before their heads.
    h: Matrix,
    heads: Vec<f64>,
    values: Vec<f64>,
    /// Memory of the reflections from the left.
    reflectors: Matrix,
    vector: Vec<f64>,
}

impl Orthogonal {
    /// Decomposes `g`.
    pub fn factor(g: &Matrix) -> Orthogonal {
        let mut o = Orthogonal::default();
        o.refactor(g);
        o
    }

    /// Decomposes other rows in the same memory.
    pub fn refactor(&mut self, g: &Matrix) {
        with_length!(g.cols(), |n| self.pivoted_qr(n, g));
        self.rank = Rank::decide(&self.values);
        if self.rank.uncertain {
            self.take_svd(g);
        } else {
            with_length!(g.cols(), |n| self.form_x(n));
            self.reduce_and_form_y();
        }
    }

    /// The rank of other rows alone, in the same memory; no basis is known then.
    pub fn find_rank(&mut self, g: &Matrix) -> Rank {
        with_length!(g.cols(), |n| self.pivoted_qr(n, g));
        self.rank = Rank::decide(&self.values);
        if self.rank.uncertain {
            self.take_svd(g);
        }
        self.rank
    }

    /// The rank and its grounds.
    pub fn rank(&self) -> Rank {
        self.rank
    }
    /// Rows: an orthonormal basis of n-space; those from the rank on span ker G.
    pub fn x(&self) -> &Matrix {
        &self.x
    }
    /// Rows: an orthonormal basis of m-space; those from the rank on span ker Gᵀ.
    pub fn y(&self) -> &Matrix {
        &self.y
    }

    /// x ← x + G⁺ b, the least-squares solution of G x = b of minimum norm.
    pub fn add_solution(&self, b: &[f64], x: &mut [f64]) {
        self.add_solution_of(x.len(), b, x, &mut vec![]);
    }

    /// The same of `n` unknowns, with memory for the coefficients.
    #[inline(always)]
    pub(super) fn add_solution_of(&self, n: usize, b: &[f64], x: &mut [f64], c: &mut Vec<f64>) {
        let (x, m) = (&mut x[..n], b.len());
        c.clear();
        for k in 0..self.rank.rank {
            let row = self.l.row_of(k, n);
            c.push((dot(self.y.row_of(k, m), b) - dot(&row[..k], c)) / row[k]);
            axpy(c[k], self.x.row_of(k, n), x);
        }
    }

    /// y ← y + (Gᵀ)⁺ b, the least-squares solution of Gᵀ y = b of minimum norm.
    pub fn add_transposed_solution(&self, b: &[f64], y: &mut [f64]) {
        self.add_transposed_solution_of(b.len(), b, y, &mut vec![]);
    }

    /// The same of `n` equations, with memory for the coefficients.
    #[inline(always)]
    pub(super) fn add_transposed_solution_of(&self, n: usize, b: &[f64], y: &mut [f64], c: &mut Vec<f64>) {
        let (b, m, r) = (&b[..n], y.len(), self.rank.rank);
        c.clear();
        for k in 0..r {
            c.push(dot(self.x.row_of(k, n), b));
        }
        for k in (0..r).rev() {
            let row = self.l.row_of(k, n);
            c[k] /= row[k];
            let s = c[k];
            axpy(-s, &row[..k], &mut c[..k]);
            axpy(s, self.y.row_of(k, m), y);
        }
    }

    /// Row k of `l` becomes the k-th pivotal row of L, but for its diagonal; of `h` its reflection.
    #[inline(always)]
    fn pivoted_qr(&mut self, n: usize, g: &Matrix) {
        let m = g.rows();
        self.l.clone_from(g);
        self.h.reset(m.min(n), n);
        self.perm.clear();
        self.perm.extend(0..m);
        self.heads.clear();
        self.values.clear();
        for k in 0..m.min(n) {
            let (mut best, mut square) = (k, -1.0);
            for i in k..m {
                let tail = &self.l.row_of(i, n)[k..];
                let size = dot(tail, tail);
                if size > square {
                    (best, square) = (i, size);
                }
            }
            self.values.push(square.sqrt());
            if self.values[k] <= RANK_TOLERANCE * self.values[0] {
                break;
            }
            self.l.swap_rows(k, best);
            self.perm.swap(k, best);
            let v = self.h.row_of_mut(k, n);
            v[k..].copy_from_slice(&self.l.row_of(k, n)[k..]);
            self.heads.push(reflector(&mut v[k..]));
            for i in k + 1..m {
                reflect(v, self.l.row_of_mut(i, n));
            }
        }
    }

    /// X = H₀ H₁ ⋯, each basis vector being the image of a unit vector.
    #[inline(always)]
    fn form_x(&mut self, n: usize) {
        let r = self.rank.rank;
        self.x.reset(n, n);
        for i in 0..n {
            let row = self.x.row_of_mut(i, n);
            row[i] = 1.0;
            for k in (0..r.min(i + 1)).rev() {
                reflect(self.h.row_of(k, n), row);
            }
        }
        for k in 0..r {
            self.l[(k, k)] = self.heads[k];
        }
    }

    /// Annihilates the redundant rows of L by reflections from the left, whose product is Y.
    fn reduce_and_form_y(&mut self) {
        let (r, m) = (self.rank.rank, self.l.rows());
        let mut reflectors = std::mem::take(&mut self.reflectors);
        reflectors.reset(if m > r { r } else { 0 }, m - r + 1);
        for k in (0..reflectors.rows()).rev() {
            let v = reflectors.row_mut(k);
            v[0] = self.l[(k, k)];
            (r..m).for_each(|i| v[i - r + 1] = self.l[(i, k)]);
            self.l[(k, k)] = reflector(v);
            for j in 0..k {
                let tail = (r..m).map(|i| v[i - r + 1] * self.l[(i, j)]).sum::<f64>();
                let s = v[0] * self.l[(k, j)] + tail;
                self.l[(k, j)] -= s * v[0];
                (r..m).for_each(|i| self.l[(i, j)] -= s * v[i - r + 1]);
            }
        }
        self.form_y(&reflectors);
        self.reflectors = reflectors;
    }

    fn form_y(&mut self, reflectors: &Matrix) {
        let (r, m) = (self.rank.rank, self.l.rows());
        self.y.reset(m, m);
        if reflectors.rows() == 0 {
            self.perm.iter().enumerate().for_each(|(i, &p)| self.y[(i, p)] = 1.0);
            return;
        }
        let vector = &mut self.vector;
        for i in 0..m {
            vector.clear();
            vector.resize(m, 0.0);
            vector[i] = 1.0;
            for k in 0..reflectors.rows() {
                let v = reflectors.row(k);
                let s = v[0] * vector[k] + dot(&v[1..], &vector[r..]);
                vector[k] -= s * v[0];
                axpy(-s, &v[1..], &mut vector[r..]);
            }
            self.perm.iter().zip(&*vector).for_each(|(&p, &v)| self.y[(i, p)] = v);
        }
    }

    /// Rank and bases from the singular values instead.
    fn take_svd(&mut self, g: &Matrix) {
        let svd = jacobi_svd(g);
        self.rank = Rank::decide(&svd.values);
        let (r, n) = (self.rank.rank, g.cols());
        let lead = Matrix::from_fn(r, n, |i, j| svd.right[(i, j)]);
        // The rows of `lead` are orthonormal, so this one level of recursion finds full rank.
        let mut completed = Orthogonal::factor(&lead).x;
        (0..r).for_each(|i| completed.row_mut(i).copy_from_slice(lead.row(i)));
        self.x = completed;
        self.y = svd.left;
        self.l = Matrix::zeros(r, n);
        (0..r).for_each(|k| self.l[(k, k)] = svd.values[k]);
    }
}

/// Turns x into v, |v|² = 2, with (I − v vᵀ) x = α e₀, and returns α; v = 0 and α = x₀ if the tail
/// of x is zero (Golub & Van Loan, 4th ed., §5.1.2).
fn reflector(x: &mut [f64]) -> f64 {
    let head = x[0];
    if max_abs(&x[1..]) == 0.0 {
        x[0] = 0.0;
        return head;
    }
    let norm = dot(x, x).sqrt();
    let alpha = if head > 0.0 { -norm } else { norm };
    x[0] -= alpha;
    let scale = 1.0 / (alpha * (alpha - head)).sqrt();
    x.iter_mut().for_each(|v| *v *= scale);
    alpha
}

/// x ← (I − v vᵀ) x.
#[inline(always)]
fn reflect(v: &[f64], x: &mut [f64]) {
    axpy(-dot(v, x), v, x);
}

/// A = Y Σ X₁ᵀ for m × n A.
#[derive(Clone, Debug)]
pub struct Svd {
    /// m × m, orthogonal: row k is the left vector of value k.
    pub left: Matrix,
    /// m singular values, descending (those beyond n are zero to round-off).
    pub values: Vec<f64>,
    /// m × n: row k is the right vector of value k, or zero where the value is.
    pub right: Matrix,
}

/// Singular values and vectors of a small matrix, by one-sided Jacobi rotations of its rows
/// (Hestenes 1958; Demmel & Veselić 1992 for its high relative accuracy).
pub fn jacobi_svd(a: &Matrix) -> Svd {
    let m = a.rows();
    let (mut w, mut left) = (a.clone(), Matrix::identity(m));
    for _ in 0..60 {
        let mut rotated = false;
        for i in 0..m {
            for j in i + 1..m {
                rotated |= orthogonalise(&mut w, &mut left, i, j);
            }
        }
        if !rotated {
            break;
        }
    }
    sorted(&w, &left)
}

/// Rotates rows i and j of `w` (and of `left`) until they are orthogonal; false if they were.
fn orthogonalise(w: &mut Matrix, left: &mut Matrix, i: usize, j: usize) -> bool {
    let (p, q) = w.two_rows_mut(i, j);
    let (pp, qq, pq) = (dot(p, p), dot(q, q), dot(p, q));
    if pq.abs() <= ORTHOGONAL * (pp * qq).sqrt() {
        return false;
    }
    let zeta = (qq - pp) / (2.0 * pq);
    let t = 1_f64.copysign(zeta) / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    rotate(p, q, c, c * t);
    let (p, q) = left.two_rows_mut(i, j);
    rotate(p, q, c, c * t);
    true
}

fn rotate(p: &mut [f64], q: &mut [f64], c: f64, s: f64) {
    for (p, q) in p.iter_mut().zip(q) {
        (*p, *q) = (c * *p - s * *q, s * *p + c * *q);
    }
}

fn sorted(w: &Matrix, left: &Matrix) -> Svd {
    let norms: Vec<f64> = (0..w.rows()).map(|i| dot(w.row(i), w.row(i)).sqrt()).collect();
    let mut order: Vec<usize> = (0..w.rows()).collect();
    order.sort_by(|&i, &j| norms[j].total_cmp(&norms[i]));
    let unit = |i: usize, j: usize| if norms[i] > 0.0 { w[(i, j)] / norms[i] } else { 0.0 };
    Svd {
        left: Matrix::from_fn(left.rows(), left.cols(), |k, j| left[(order[k], j)]),
        values: order.iter().map(|&i| norms[i]).collect(),
        right: Matrix::from_fn(w.rows(), w.cols(), |k, j| unit(order[k], j)),
    }
}
