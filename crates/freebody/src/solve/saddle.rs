//! The dense null-space solver of one instant of a mechanism.

use super::{axpy, dot, max_abs, with_length, Lu, Matrix, Orthogonal, Rank};
use std::fmt;

/// Momentum of a motion, over the largest inertia, that is none: round-off of the motion itself leaves more than of a pivot.
const NO_MOMENTUM: f64 = 1e-9;
/// An inertia below this fraction of the largest entry of M (scaled) is zero.
const ZERO_INERTIA: f64 = 1e-14;

/// The factored equations  M a − Bᵀ λ = f,  G a = r  of one instant.
///
/// M (n × n) is symmetric and may be singular, as long as it is positive definite on ker G. B = G for
/// ideal constraints; actuators that drive the motion G a = r through other directions have their
/// own rows B. Rows of G may be redundant; r must then agree with them.
///
/// The null-space method (Benzi, Golub & Liesen, *Numerical solution of saddle point problems*, Acta
/// Numerica 2005, §6): with bases Z of ker G and W of ker B, Wᵀ M Z ÿ = Wᵀ(f − M aₚ) are as many
/// equations as there are degrees of freedom.
///
/// All decisions are made on scaled unknowns and rows: aⱼ = `col_scale[j]` âⱼ, and row i of G and B is
/// multiplied by `row_scale[i]`. With lengths in the unit L of the mechanism both become pure
/// numbers of order one.
#[derive(Clone, Debug, Default)]
pub struct Saddle {
    row_scale: Vec<f64>,
    col_scale: Vec<f64>,
    mass: Matrix,
    g: Matrix,
    motion: Orthogonal,
    actuation: Option<(Matrix, Orthogonal)>,
    momentum: Matrix,
    inertia: Matrix,
    lu: Lu,
}

/// What [`Saddle::solve`] finds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solution {
    /// Accelerations, n.
    pub a: Vec<f64>,
    /// Multipliers, m; of all that satisfy the equations those of least norm in the scaled rows.
    pub lambda: Vec<f64>,
    /// Largest |`row_scale` (G a − r)|: round-off, unless redundant rows contradict each other.
    pub inconsistency: f64,
}

/// Memory of [`Saddle::solve_into`], kept from one solution to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    scaled: [Vec<f64>; 2],
    left: [Vec<f64>; 2],
    steps: Steps,
}

#[derive(Clone, Debug, Default)]
struct Steps {
    step: Vec<f64>,
    load: Vec<f64>,
    y: Vec<f64>,
    coefficients: Vec<f64>,
    lu: [Vec<f64>; 2],
}

/// The matrices of [`Saddle`] with their scales.
#[derive(Clone, Copy, Debug)]
pub struct Equations<'a> {
    /// M, n × n.
    pub mass: &'a Matrix,
    /// G, m × n.
    pub g: &'a Matrix,
    /// B, m × n; G if none.
    pub b: Option<&'a Matrix>,
    /// Scales of the rows, m positive numbers.
    pub row_scale: &'a [f64],
    /// Scales of the unknowns, n positive numbers.
    pub col_scale: &'a [f64],
}

/// Why the equations of an instant determine no motion.
#[derive(Clone, Debug, PartialEq)]
pub enum SaddleError {
    /// The constraints allow a motion that no mass resists.
    ZeroInertia {
        /// That motion as accelerations, n, the largest scaled entry being ±1.
        direction: Vec<f64>,
    },
    /// A motion that G prescribes, or forbids, is out of reach of the forces Bᵀ λ.
    InsufficientActuation {
        /// A free motion, n, whose inertia force is balanced by Bᵀ λ alone.
        direction: Vec<f64>,
    },
    /// There are not as many independent force directions in B as conditions in G.
    RankMismatch {
        /// Rank of G.
        motion: usize,
        /// Rank of B.
        force: usize,
    },
}

impl fmt::Display for SaddleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SaddleError::ZeroInertia { .. } => write!(f, "a free motion has no inertia"),
            SaddleError::InsufficientActuation { .. } => {
                write!(f, "the actuators cannot produce the prescribed motion")
            }
            SaddleError::RankMismatch { motion, force } => {
                write!(f, "{motion} independent conditions on the motion, but {force} forces")
            }
        }
    }
}

impl std::error::Error for SaddleError {}

impl Saddle {
    /// Factors equations, in the memory of those before; the arithmetic grows as n³. After an error [`rank`](Self::rank),
    /// [`motions`](Self::motions) and [`self_stress`](Self::self_stress) still hold.
    pub fn refactor(&mut self, of: Equations) -> Result<(), SaddleError> {
        let Equations { mass, g, b, row_scale, col_scale } = of;
        let (m, n) = (row_scale.len(), col_scale.len());
        assert_eq!((mass.rows(), mass.cols()), (n, n), "M is n × n");
        assert_eq!((g.rows(), g.cols()), (m, n), "G is m × n");
        assert!(b.is_none_or(|b| (b.rows(), b.cols()) == (m, n)), "B is m × n");
        let all = [(0..m).collect::<Vec<_>>(), (0..n).collect()];
        self.refactor_part(of, [&all[0], &all[1]])
    }

    /// Factors some rows of the equations for some of their unknowns.
    pub(super) fn refactor_part(&mut self, of: Equations, [rows, unknowns]: [&[usize]; 2]) -> Result<(), SaddleError> {
        gather(of.row_scale, rows, &mut self.row_scale);
        gather(of.col_scale, unknowns, &mut self.col_scale);
        let [by_row, by_unknown] = [(rows, &self.row_scale[..]), (unknowns, &self.col_scale[..])];
        scaled_part(of.mass, by_unknown, by_unknown, &mut self.mass);
        scaled_part(of.g, by_row, by_unknown, &mut self.g);
        self.motion.refactor(&self.g);
        match of.b {
            None => self.actuation = None,
            Some(b) => {
                let (scaled, basis) = self.actuation.get_or_insert_with(Default::default);
                scaled_part(b, by_row, by_unknown, scaled);
                basis.refactor(scaled);
            }
        }
        with_length!(unknowns.len(), |n| self.factor_inertia(n))
    }

    #[inline(always)]
    fn factor_inertia(&mut self, n: usize) -> Result<(), SaddleError> {
        let (motion, force) = (self.rank().rank, self.force().rank().rank);
        if motion != force {
            return Err(SaddleError::RankMismatch { motion, force });
        }
        let dof = n - motion;
        self.momentum.reset(dof, n);
        self.inertia.reset(dof, dof);
        for j in 0..dof {
            let momentum = self.momentum.row_of_mut(j, n);
            let z = self.motion.x().row_of(motion + j, n);
            for (i, momentum) in momentum.iter_mut().enumerate() {
                *momentum = dot(self.mass.row_of(i, n), z);
            }
            let force = self.actuation.as_ref().map_or(&self.motion, |(_, basis)| basis);
            for i in 0..dof {
                self.inertia[(i, j)] = dot(force.x().row_of(motion + i, n), momentum);
            }
        }
        let floor = ZERO_INERTIA * max_abs(self.mass.data());
        self.lu.refactor(&self.inertia, floor).map_err(|e| self.unresisted(e.column))
    }

    /// Names the motion whose momentum Wᵀ does not see, and whether it has any.
    fn unresisted(&self, column: usize) -> SaddleError {
        let y = self.lu.null_vector(column);
        let mut z = vec![0.0; self.mass.rows()];
        self.add_motion(&y, &mut z);
        let size = max_abs(&z);
        z.iter_mut().for_each(|v| *v /= size);
        let momentum = max_abs(&self.mass.mul_vec(&z));
        let direction = z.iter().zip(&self.col_scale).map(|(z, c)| z * c).collect();
        if momentum <= NO_MOMENTUM * max_abs(self.mass.data()) {
            SaddleError::ZeroInertia { direction }
        } else {
            SaddleError::InsufficientActuation { direction }
        }
    }

    /// The rank of G and what it was decided on.
    pub fn rank(&self) -> Rank {
        self.motion.rank()
    }

    /// The rank of B.
    pub fn actuation_rank(&self) -> usize {
        self.force().rank().rank
    }

    /// Degrees of freedom: n − rank G.
    pub fn dof(&self) -> usize {
        self.mass.rows() - self.rank().rank
    }

    /// n × dof: the accelerations (or velocities) with G z = 0; its columns are orthonormal in the
    /// scaled unknowns.
    pub fn motions(&self) -> Matrix {
        let (x, r) = (self.motion.x(), self.rank().rank);
        Matrix::from_fn(self.mass.rows(), self.dof(), |i, j| self.col_scale[i] * x[(r + j, i)])
    }

    /// Squares of the lengths of the part of a further row (n) that motions with G z = 0 feel, and of all of it, scaled.
    pub fn felt(&self, row: &[f64]) -> [f64; 2] {
        let (x, scaled) = (self.motion.x(), product(row, &self.col_scale));
        let felt = (self.rank().rank..row.len()).map(|j| dot(x.row(j), &scaled)).map(|part| part * part).sum();
        [felt, dot(&scaled, &scaled)]
    }

    /// m × d: the multipliers with Bᵀ λ = 0; the largest entry of each column is 1.
    pub fn self_stress(&self) -> Matrix {
        let (y, r) = (self.force().y(), self.force().rank().rank);
        let m = self.row_scale.len();
        let mut s = Matrix::from_fn(m, m - r, |i, j| self.row_scale[i] * y[(r + j, i)]);
        for j in 0..m - r {
            let largest = (0..m).map(|i| s[(i, j)]).fold(0.0, larger);
            (0..m).for_each(|i| s[(i, j)] /= largest);
        }
        s
    }

    /// Solves for applied forces f (n) and right-hand sides r (m), refined once.
    pub fn solve(&self, f: &[f64], r: &[f64]) -> Solution {
        let mut found = Solution::default();
        self.solve_into(f, r, &mut found, &mut Memory::default());
        found
    }

    /// The same into `found`.
    pub(super) fn solve_into(&self, f: &[f64], r: &[f64], found: &mut Solution, memory: &mut Memory) {
        let Memory { scaled: [scaled_f, scaled_r], left: [df, dr], steps } = memory;
        for (scaled, x, scale) in [(&mut *scaled_f, f, &self.col_scale), (&mut *scaled_r, r, &self.row_scale)] {
            scaled.clear();
            scaled.extend_from_slice(x);
            multiply(scaled, scale);
        }
        zeros(&mut found.a, f.len());
        zeros(&mut found.lambda, r.len());
        df.clone_from(scaled_f);
        dr.clone_from(scaled_r);
        for _ in 0..2 {
            with_length!(f.len(), |n| self.correct(n, df, dr, found, steps));
            self.residual([scaled_f, scaled_r], found, [df, dr]);
        }
        found.inconsistency = max_abs(dr);
        multiply(&mut found.a, &self.col_scale);
        multiply(&mut found.lambda, &self.row_scale);
    }

    /// f − M a + Bᵀ λ and r − G a, scaled.
    fn residual(&self, [f, r]: [&[f64]; 2], of: &Solution, [df, dr]: [&mut [f64]; 2]) {
        df.copy_from_slice(f);
        let b = self.actuation.as_ref().map_or(&self.g, |(b, _)| b);
        b.add_t_mul_vec(&of.lambda, df);
        df.iter_mut().enumerate().for_each(|(i, left)| *left -= dot(self.mass.row(i), &of.a));
        dr.iter_mut().zip(r).enumerate().for_each(|(i, (left, r))| *left = r - dot(self.g.row(i), &of.a));
    }

    /// Adds the scaled solution for (f, r) to (a, λ); f, which has n parts, is used up.
    #[inline(always)]
    fn correct(&self, n: usize, f: &mut [f64], r: &[f64], to: &mut Solution, steps: &mut Steps) {
        let Steps { step, load, y, coefficients, lu } = steps;
        let (f, rank, motion, force) = (&mut f[..n], self.rank().rank, &self.motion, self.force());
        let step = zeros(step, n);
        motion.add_solution_of(n, r, step, coefficients);
        for (i, left) in f.iter_mut().enumerate() {
            *left -= dot(self.mass.row_of(i, n), step);
        }
        load.clear();
        for i in rank..n {
            load.push(dot(force.x().row_of(i, n), f));
        }
        self.lu.solve_into(load, y, lu);
        // What is left over, M a − f, is the constraint force.
        f.iter_mut().for_each(|v| *v = -*v);
        for (j, y) in y.iter().enumerate() {
            axpy(*y, motion.x().row_of(rank + j, n), step);
            axpy(*y, self.momentum.row_of(j, n), f);
        }
        force.add_transposed_solution_of(n, f, &mut to.lambda, coefficients);
        axpy(1.0, step, &mut to.a[..n]);
    }

    /// z ← z + Z y, scaled.
    fn add_motion(&self, y: &[f64], z: &mut [f64]) {
        let rank = self.rank().rank;
        y.iter().enumerate().for_each(|(j, y)| axpy(*y, self.motion.x().row(rank + j), z));
    }

    fn force(&self) -> &Orthogonal {
        self.actuation.as_ref().map_or(&self.motion, |(_, basis)| basis)
    }
}

/// out ← the part of A in given rows and columns, each times its scale.
fn scaled_part(a: &Matrix, rows: (&[usize], &[f64]), cols: (&[usize], &[f64]), out: &mut Matrix) {
    out.fill(rows.0.len(), cols.0.len(), |i, j| a[(rows.0[i], cols.0[j])] * (rows.1[i] * cols.1[j]));
}

/// to ← the entries at given places.
pub(super) fn gather(of: &[f64], at: &[usize], to: &mut Vec<f64>) {
    to.clear();
    for &i in at {
        to.push(of[i]);
    }
}

fn product(x: &[f64], scale: &[f64]) -> Vec<f64> {
    let mut scaled = x.to_vec();
    multiply(&mut scaled, scale);
    scaled
}

/// x ← diag(scale) x.
#[inline(always)]
fn multiply(x: &mut [f64], scale: &[f64]) {
    assert_eq!(x.len(), scale.len(), "size of a right-hand side");
    x.iter_mut().zip(scale).for_each(|(x, s)| *x *= s);
}

/// x becomes n zeros.
#[inline(always)]
fn zeros(x: &mut Vec<f64>, n: usize) -> &mut [f64] {
    if x.len() != n {
        x.resize(n, 0.0);
    }
    let x = &mut x[..n];
    x.fill(0.0);
    x
}

fn larger(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() {
        b
    } else {
        a
    }
}
