//! Radau IIA of order 13, for stiff systems.

use super::collocation::{bends, slopes, values};
use super::dense::Segment;
use super::linear::Lu;
use super::method::{Counted, Failure, Method, Point, Stepper};
use super::norm::{measure, Norm, ROUND_OFF};
use crate::scalar::real;
use std::sync::LazyLock;

/// Hairer & Wanner, *Solving ODEs II*, IV.8, with seven stages (J. Comput. Appl. Math. 111 (1999), 93): simplified
/// Newton iterations on the equations of the stages, error estimate (8.20), collocation polynomial as dense output.
/// With three stages the estimate, O(h⁴), asks for many times the steps at the tolerances that are usual here.
pub(super) const METHOD: Method = Method {
    name: "radau",
    citation: "Hairer & Wanner, Solving ODEs II, IV.5 and IV.8; J. Comput. Appl. Math. 111 (1999), 93",
    order: 13,
    dense_order: 7,
    estimate_order: Some(8),
    symplectic: false,
    analytic: false,
    implicit: true,
    stage_gap: 0.45,
    stepper: |n| Box::new(Radau::new(n)),
};

const STAGES: usize = 7;
const LAST: usize = STAGES - 1;
/// Nodes: the zeros of d⁶/dx⁶ x⁶(x − 1)⁷.
const C: [f64; STAGES] = [
    0.029_316_427_159_784_892,
    0.148_078_599_668_484_3,
    0.336_984_690_281_154_3,
    0.558_671_518_771_550_1,
    0.769_233_862_030_054_5,
    0.926_945_671_319_741_1,
    1.0,
];
/// The real eigenvalue of the inverse Runge–Kutta matrix A⁻¹,
const REAL: f64 = 8.936_832_788_405_216;
/// and the pairs of complex ones: real and imaginary parts.
const PAIRS: [(f64, f64); STAGES / 2] = [
    (8.511_834_825_102_946, 3.281_013_624_325_059),
    (7.141_055_219_187_64, 6.623_045_922_639_276),
    (4.378_693_561_506_806, 10.169_693_283_795_012),
];
/// Newton converging faster than this keeps its Jacobian.
const FAST: f64 = 1e-3;
/// Error of Newton's method, in tolerances, at which the stages are found. It goes on as error of fast modes, so 0.03
/// (HW IV.8) loses digits; at √rtol round-off of the rates keeps Newton from converging.
const STAGES_FOUND: f64 = 3e-4;
/// Part of its physical size that a component has at least, for the step of a difference.
const LEAST_SIZE: f64 = 1e-3;
const NEWTON_ITERATIONS: usize = 15;

struct Radau {
    n: usize,
    /// Displacements of the stages from the start of the step.
    z: Vec<f64>,
    jacobian: Option<Jacobian>,
    factors: Option<Factors>,
    /// Length and `z` of the last accepted step, from which Newton extrapolates.
    past: Option<(f64, Vec<f64>)>,
}

struct Jacobian {
    values: Vec<f64>,
    /// Time at which it was taken.
    t: f64,
    /// Newton converged slowly with it.
    is_stale: bool,
}

/// Of A⁻¹/h⊗I − I⊗J by the eigenvectors of A⁻¹.
struct Factors {
    h: f64,
    real: Lu,
    pairs: Vec<Lu>,
    /// What round-off of the state does to each component, by the Jacobian: (γ/h − J)⁻¹J of it.
    noise: Vec<f64>,
}

impl Factors {
    fn new(jacobian: &[f64], h: f64, scale: &[f64]) -> Option<Self> {
        let n = scale.len();
        let real = (0..n * n).map(|at| if at / n == at % n { REAL / h } else { 0.0 } - jacobian[at]).collect();
        let pair = |&(re, im): &(f64, f64)| {
            let mut rows = vec![0.0; 4 * n * n];
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let on = if i == j { 1.0 / h } else { 0.0 };
                rows[i * 2 * n + j] = re * on - jacobian[i * n + j];
                rows[i * 2 * n + n + j] = im * on;
                rows[(n + i) * 2 * n + j] = -im * on;
                rows[(n + i) * 2 * n + n + j] = re * on - jacobian[i * n + j];
            }
            Lu::new(2 * n, rows)
        };
        let (real, pairs) = (Lu::new(n, real)?, PAIRS.iter().map(pair).collect::<Option<_>>()?);
        let mut noise = vec![0.0; n];
        for j in 0..n {
            let mut change: Vec<f64> = (0..n).map(|i| jacobian[i * n + j] * ROUND_OFF * scale[j]).collect();
            real.solve(&mut change);
            noise.iter_mut().zip(change).for_each(|(sum, change)| *sum += change.abs());
        }
        Some(Self { h, real, pairs, noise })
    }

    /// Replaces what the stages lack by their correction.
    fn solve(&self, n: usize, stages: &mut [f64]) {
        TABLEAU.to_eigenvectors(n, stages);
        let (real, pairs) = stages.split_at_mut(n);
        self.real.solve(real);
        self.pairs.iter().zip(pairs.chunks_mut(2 * n)).for_each(|(factors, pair)| factors.solve(pair));
        TABLEAU.to_stages(n, stages);
    }
}

/// The method in numbers, all from its nodes.
struct Tableau {
    /// A⁻¹: slopes at the nodes.
    inverse: [[f64; STAGES]; STAGES],
    slopes_at_start: [f64; STAGES],
    bends: [[f64; STAGES]; STAGES],
    /// Eigenvectors of A⁻¹ as columns: the real one, then real and imaginary part of each pair.
    eigenvectors: [[f64; STAGES]; STAGES],
    factors: Lu,
}

static TABLEAU: LazyLock<Tableau> = LazyLock::new(|| {
    let inverse = C.map(|c| slopes(&C, c));
    let mut columns = vec![eigenvector(&inverse, (REAL, 0.0))[0]];
    columns.extend(PAIRS.iter().flat_map(|&value| eigenvector(&inverse, value)));
    let eigenvectors: [[f64; STAGES]; STAGES] = std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i]));
    let factors = Lu::new(STAGES, eigenvectors.concat()).expect("eigenvalues differ");
    Tableau { inverse, slopes_at_start: slopes(&C, 0.0), bends: bends(&C), eigenvectors, factors }
});

/// Real and imaginary part of the eigenvector of `a` that is 1 at the last node, from all rows but the last.
fn eigenvector(a: &[[f64; STAGES]; STAGES], (re, im): (f64, f64)) -> [[f64; STAGES]; 2] {
    const M: usize = STAGES - 1;
    let mut rows = vec![0.0; 4 * M * M];
    for (i, j) in (0..M).flat_map(|i| (0..M).map(move |j| (i, j))) {
        let on = if i == j { 1.0 } else { 0.0 };
        rows[i * 2 * M + j] = a[i][j] - re * on;
        rows[i * 2 * M + M + j] = im * on;
        rows[(M + i) * 2 * M + j] = -im * on;
        rows[(M + i) * 2 * M + M + j] = a[i][j] - re * on;
    }
    let mut found: Vec<f64> = (0..2 * M).map(|i| if i < M { -a[i][M] } else { 0.0 }).collect();
    Lu::new(2 * M, rows).expect("a simple eigenvalue").solve(&mut found);
    let part = |from: usize, last| std::array::from_fn(|i| if i < M { found[from + i] } else { last });
    [part(0, 1.0), part(M, 0.0)]
}

impl Tableau {
    /// Changes values at the stages into parts along the eigenvectors, and back.
    fn to_eigenvectors(&self, n: usize, stages: &mut [f64]) {
        for i in 0..n {
            let mut parts: [f64; STAGES] = std::array::from_fn(|k| stages[k * n + i]);
            self.factors.solve(&mut parts);
            (0..STAGES).for_each(|k| stages[k * n + i] = parts[k]);
        }
    }

    fn to_stages(&self, n: usize, stages: &mut [f64]) {
        for i in 0..n {
            let parts: [f64; STAGES] = std::array::from_fn(|k| stages[k * n + i]);
            (0..STAGES).for_each(|k| stages[k * n + i] = dot(&self.eigenvectors[k], |l| parts[l]));
        }
    }
}

/// Σ aₖ·of(k) over the stages.
fn dot(a: &[f64; STAGES], of: impl Fn(usize) -> f64) -> f64 {
    a.iter().enumerate().map(|(k, a)| a * of(k)).sum()
}

impl Radau {
    fn new(n: usize) -> Self {
        let z = vec![0.0; STAGES * n];
        Self { n, z, jacobian: None, factors: None, past: None }
    }

    /// Takes the Jacobian at `at`, by forward differences.
    fn differentiate(&mut self, system: &mut Counted, at: &Point, norm: &Norm) -> Result<(), Failure> {
        let n = self.n;
        let (mut values, mut y, mut dy) = (vec![0.0; n * n], at.y.clone(), vec![0.0; n]);
        for j in 0..n {
            y[j] += f64::EPSILON.sqrt() * at.y[j].abs().max(LEAST_SIZE * norm.scale[j]);
            system.rate(at.t, &y, &mut dy)?;
            for i in 0..n {
                values[i * n + j] = (dy[i] - at.dy[i]) / (y[j] - at.y[j]);
            }
            y[j] = at.y[j];
        }
        self.jacobian = Some(Jacobian { values, t: at.t, is_stale: false });
        self.factors = None;
        Ok(())
    }

    /// Factors the equations of the stages unless that was done for this step length.
    fn factor(&mut self, h: f64, scale: &[f64]) -> Option<()> {
        if self.factors.as_ref().is_none_or(|factors| factors.h != h) {
            self.factors = Some(Factors::new(&self.jacobian.as_ref()?.values, h, scale)?);
        }
        Some(())
    }

    /// Starts Newton from the collocation polynomial of the last step, or from rest.
    fn guess(&mut self, h: f64) {
        let n = self.n;
        self.z.fill(0.0);
        let Some((past_h, past)) = &self.past else { return };
        for (k, c) in C.iter().enumerate() {
            let weights = values(&C, 1.0 + c * h / past_h);
            for i in 0..n {
                self.z[k * n + i] = dot(&weights, |l| past[l * n + i]) - past[LAST * n + i];
            }
        }
    }

    /// Tolerated error of each component. Its change over the step is that of the stages: where the state is off the slow
    /// motion by little, the rate at the start is of any size.
    fn weights(&self, from: &Point, norm: &Norm) -> Vec<f64> {
        let moved = |i: usize| self.z.iter().skip(i).step_by(self.n).fold(0.0_f64, |most, z| most.max(z.abs()));
        let reached = |i: usize| (from.y[i] + self.z[LAST * self.n + i]).abs().max(moved(i));
        let noise = |i: usize| self.factors.as_ref().map_or(0.0, |factors| factors.noise[i]);
        (0..self.n).map(|i| norm.tolerated(i, from.y[i].abs(), reached(i)) + noise(i)).collect()
    }

    /// Solves for the stages; returns the rate of convergence.
    fn newton(&mut self, system: &mut Counted, from: &Point, h: f64, norm: &Norm) -> Result<f64, Failure> {
        let tolerance = (10.0 * f64::EPSILON / norm.rtol).max(STAGES_FOUND);
        let (mut last, mut theta) = (f64::NAN, FAST);
        for iteration in 0..NEWTON_ITERATIONS {
            let mut step = self.residual(system, from, h)?;
            self.factors.as_ref().ok_or(Failure::NoConvergence)?.solve(self.n, &mut step);
            self.z.iter_mut().zip(&step).for_each(|(z, step)| *z += step);
            let size = measure(&step, &self.weights(from, norm).repeat(STAGES));
            if iteration > 0 {
                theta = size / last;
            }
            if size == 0.0 || theta < 1.0 && theta / (1.0 - theta) * size <= tolerance {
                return Ok(theta);
            }
            let left = (NEWTON_ITERATIONS - 1 - iteration) as i32;
            if theta >= 1.0 || real::powi(theta, left) / (1.0 - theta) * size > tolerance && iteration > 0 {
                break;
            }
            last = size;
        }
        Err(Failure::NoConvergence)
    }

    /// F(y + z) − (A⁻¹⊗I)z/h.
    fn residual(&self, system: &mut Counted, from: &Point, h: f64) -> Result<Vec<f64>, Failure> {
        let n = self.n;
        let (mut y, mut left) = (vec![0.0; n], vec![0.0; STAGES * n]);
        for (k, stage) in left.chunks_mut(n).enumerate() {
            for (i, y) in y.iter_mut().enumerate() {
                *y = from.y[i] + self.z[k * n + i];
            }
            system.rate(from.t + C[k] * h, &y, stage)?;
            for (i, left) in stage.iter_mut().enumerate() {
                *left -= dot(&TABLEAU.inverse[k], |l| self.z[l * n + i]) / h;
            }
        }
        Ok(left)
    }

    /// Slope at the start of the step of the polynomial through the stages.
    fn slope_at_start(&self, i: usize, h: f64) -> f64 {
        dot(&TABLEAU.slopes_at_start, |l| self.z[l * self.n + i]) / h
    }

    fn error(&self, system: &mut Counted, from: &Point, to: &Point, norm: &Norm) -> Result<f64, Failure> {
        let (n, h) = (self.n, to.t - from.t);
        let factors = self.factors.as_ref().ok_or(Failure::NoConvergence)?;
        let weights = self.weights(from, norm);
        let mut error: Vec<f64> = (0..n).map(|i| from.dy[i] - self.slope_at_start(i, h)).collect();
        factors.real.solve(&mut error);
        let size = measure(&error, &weights);
        if size <= 1.0 {
            return Ok(size);
        }
        // (8.20): filters stiff components that the first estimate overrates.
        let y: Vec<f64> = from.y.iter().zip(&error).map(|(y, error)| y + error).collect();
        system.rate(from.t, &y, &mut error)?;
        error.iter_mut().enumerate().for_each(|(i, error)| *error -= self.slope_at_start(i, h));
        factors.real.solve(&mut error);
        Ok(measure(&error, &weights))
    }

    /// Solves for the stages with the Jacobian at hand; returns the rate of convergence.
    fn collocate(&mut self, system: &mut Counted, from: &Point, h: f64, norm: &Norm) -> Result<f64, Failure> {
        self.factor(h, &norm.scale).ok_or(Failure::NoConvergence)?;
        self.guess(h);
        self.newton(system, from, h, norm)
    }
}

impl Stepper for Radau {
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, norm: &Norm) -> Result<f64, Failure> {
        let h = to.t - from.t;
        if self.jacobian.as_ref().is_none_or(|j| j.is_stale && j.t != from.t) {
            self.differentiate(system, from, norm)?;
        }
        let mut theta = self.collocate(system, from, h, norm);
        if theta.is_err() && self.jacobian.as_ref().is_some_and(|j| j.t != from.t) {
            self.differentiate(system, from, norm)?;
            theta = self.collocate(system, from, h, norm);
        }
        let is_slow = theta? > FAST;
        if let Some(jacobian) = &mut self.jacobian {
            jacobian.is_stale = is_slow;
        }
        for (i, y) in to.y.iter_mut().enumerate() {
            *y = from.y[i] + self.z[LAST * self.n + i];
        }
        system.rate_of(to)?;
        self.error(system, from, to, norm)
    }

    fn dense(&mut self, _system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (n, h) = (self.n, to.t - from.t);
        let slopes: Vec<f64> = (0..n).map(|i| self.slope_at_start(i, h)).collect();
        let mut segment = Segment::hermite((from.t, &from.y, &slopes), (to.t, &to.y, &to.dy), TABLEAU.bends.len() - 3);
        for (k, bend) in TABLEAU.bends.iter().enumerate().skip(3) {
            segment.bend(k, (0..n).map(|i| dot(bend, |l| self.z[l * n + i])));
        }
        self.past = Some((h, self.z.clone()));
        Ok(segment)
    }

    /// What steps by the implicit Euler method take from it, F = (I − hJ/γ)⁻¹: all but F³(4 − 3F) of it, which is 1 to
    /// second order where F is. So nothing is taken of the gap of a loop: J makes it of its rate, and its rate of nothing.
    fn stiff_part(&self, change: &[f64]) -> Option<Vec<f64>> {
        let factors = self.factors.as_ref()?;
        let euler = |from: &[f64]| {
            let mut to: Vec<f64> = from.iter().map(|from| from * REAL / factors.h).collect();
            factors.real.solve(&mut to);
            to
        };
        let ahead: Vec<f64> = change.iter().zip(euler(change)).map(|(from, to)| 4.0 * from - 3.0 * to).collect();
        let slow = euler(&euler(&euler(&ahead)));
        Some(change.iter().zip(slow).map(|(change, slow)| change - slow).collect())
    }

    fn reset(&mut self) {
        *self = Self::new(self.n);
    }
}
