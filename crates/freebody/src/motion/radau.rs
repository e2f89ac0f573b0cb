//! Radau IIA of order 5, for stiff systems.

use super::dense::Segment;
use super::linear::Lu;
use super::method::{Counted, Failure, Method, Point, Stepper};
use super::norm::{measure, Norm};
use crate::scalar::real;

/// Hairer & Wanner, *Solving ODEs II*, IV.8: simplified Newton iterations on the 3n equations of
/// the stages, error estimate (8.20), collocation polynomial as dense output.
pub(super) const METHOD: Method = Method {
    name: "radau",
    citation: "Hairer & Wanner, Solving ODEs II, IV.5 and IV.8",
    order: 5,
    dense_order: 3,
    estimate_order: Some(4),
    symplectic: false,
    growth_threshold: 1.2,
    stage_gap: 0.4,
    stepper: |n| Box::new(Radau::new(n)),
};

const SQRT6: f64 = 2.449_489_742_783_178;
const C: [f64; 3] = [(4.0 - SQRT6) / 10.0, (4.0 + SQRT6) / 10.0, 1.0];
const A: [[f64; 3]; 3] = [
    [(88.0 - 7.0 * SQRT6) / 360.0, (296.0 - 169.0 * SQRT6) / 1800.0, (-2.0 + 3.0 * SQRT6) / 225.0],
    [(296.0 + 169.0 * SQRT6) / 1800.0, (88.0 + 7.0 * SQRT6) / 360.0, (-2.0 - 3.0 * SQRT6) / 225.0],
    [(16.0 - SQRT6) / 36.0, (16.0 + SQRT6) / 36.0, 1.0 / 9.0],
];
/// The real eigenvalue of A⁻¹.
const REAL: f64 = 3.637_834_252_744_496;
/// Weights of the stages in the error estimate.
const E: [f64; 3] = [-(13.0 + 7.0 * SQRT6) / 3.0, (-13.0 + 7.0 * SQRT6) / 3.0, -1.0 / 3.0];
/// Newton converging faster than this keeps its Jacobian.
const FAST: f64 = 1e-3;
/// Error of Newton's method, in tolerances, at which the stages are found: at most this, as in Hairer and Wanner's code
/// (HW IV.8), and less at a tight tolerance, √rtol.
const STAGES_FOUND: f64 = 0.03;
/// Part of its physical size that a component has at least, for the step of a difference.
const LEAST_SIZE: f64 = 1e-3;
const NEWTON_ITERATIONS: usize = 10;

struct Radau {
    n: usize,
    /// Displacements of the three stages from the start of the step.
    z: Vec<f64>,
    jacobian: Option<Jacobian>,
    factors: Option<Factors>,
    /// Length and `z` of the last accepted step, from which Newton extrapolates.
    past: Option<(f64, Vec<f64>)>,
    /// The next step is the first one, or repeats a rejected one.
    is_cautious: bool,
}

struct Jacobian {
    values: Vec<f64>,
    /// Time at which it was taken.
    t: f64,
    /// Newton converged slowly with it.
    is_stale: bool,
}

struct Factors {
    h: f64,
    stages: Lu,
    estimate: Lu,
}

impl Radau {
    fn new(n: usize) -> Self {
        let z = vec![0.0; 3 * n];
        Self { n, z, jacobian: None, factors: None, past: None, is_cautious: true }
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

    /// Factors I − hA⊗J and (γ/h)I − J unless that was done for this step length.
    fn factor(&mut self, h: f64) -> Option<()> {
        if self.factors.as_ref().is_some_and(|factors| factors.h == h) {
            return Some(());
        }
        let (n, jacobian) = (self.n, &self.jacobian.as_ref()?.values);
        let unit = |i, j| f64::from(i == j);
        let mut stages = vec![0.0; 9 * n * n];
        let mut estimate = vec![0.0; n * n];
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            estimate[i * n + j] = REAL / h * unit(i, j) - jacobian[i * n + j];
            for (k, l) in (0..3).flat_map(|k| (0..3).map(move |l| (k, l))) {
                stages[(k * n + i) * 3 * n + l * n + j] = unit(k, l) * unit(i, j) - h * A[k][l] * jacobian[i * n + j];
            }
        }
        let (stages, estimate) = (Lu::new(3 * n, stages)?, Lu::new(n, estimate)?);
        self.factors = Some(Factors { h, stages, estimate });
        Some(())
    }

    /// Starts Newton from the collocation polynomial of the last step, or from rest.
    fn guess(&mut self, h: f64) {
        let n = self.n;
        self.z.fill(0.0);
        let Some((past_h, past)) = &self.past else { return };
        for (k, c) in C.iter().enumerate() {
            let weights = lagrange(1.0 + c * h / past_h);
            for i in 0..n {
                let there: f64 = (0..3).map(|l| weights[l] * past[l * n + i]).sum();
                self.z[k * n + i] = there - past[2 * n + i];
            }
        }
    }

    /// Solves for the stages; returns the rate of convergence.
    fn newton(&mut self, system: &mut Counted, from: &Point, h: f64, norm: &Norm) -> Result<f64, Failure> {
        let n = self.n;
        let tolerance = (10.0 * f64::EPSILON / norm.rtol).max(norm.rtol.sqrt().min(STAGES_FOUND));
        let mut weights = vec![0.0; n];
        norm.weights(from, from, &mut weights);
        weights.iter_mut().zip(&from.dy).for_each(|(w, dy)| *w += norm.rtol * (h * dy).abs());
        let weights = weights.repeat(3);
        let (mut last, mut theta) = (f64::NAN, FAST);
        for iteration in 0..NEWTON_ITERATIONS {
            let mut step = self.residual(system, from, h)?;
            self.factors.as_ref().ok_or(Failure::NoConvergence)?.stages.solve(&mut step);
            let size = measure(&step, &weights);
            self.z.iter_mut().zip(&step).for_each(|(z, step)| *z += step);
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

    /// h(A⊗I)F(y + z) − z.
    fn residual(&self, system: &mut Counted, from: &Point, h: f64) -> Result<Vec<f64>, Failure> {
        let n = self.n;
        let (mut y, mut k) = (vec![0.0; n], vec![0.0; 3 * n]);
        for (stage, c) in C.iter().enumerate() {
            for (i, y) in y.iter_mut().enumerate() {
                *y = from.y[i] + self.z[stage * n + i];
            }
            system.rate(from.t + c * h, &y, &mut k[stage * n..][..n])?;
        }
        let sum = |row: usize, i: usize| (0..3).map(|l| A[row][l] * k[l * n + i]).sum::<f64>();
        Ok((0..3 * n).map(|at| h * sum(at / n, at % n) - self.z[at]).collect())
    }

    fn error(&self, system: &mut Counted, from: &Point, to: &Point, norm: &Norm) -> Result<f64, Failure> {
        let (n, h) = (self.n, to.t - from.t);
        let stages = |i: usize| (0..3).map(|l| E[l] * self.z[l * n + i]).sum::<f64>() / h;
        let factors = self.factors.as_ref().ok_or(Failure::NoConvergence)?;
        let mut weights = vec![0.0; n];
        norm.weights(from, to, &mut weights);
        let mut error: Vec<f64> = (0..n).map(|i| from.dy[i] + stages(i)).collect();
        factors.estimate.solve(&mut error);
        let size = measure(&error, &weights);
        if size <= 1.0 || !self.is_cautious {
            return Ok(size);
        }
        // (8.20): filters stiff components that the first estimate overrates.
        let y: Vec<f64> = from.y.iter().zip(&error).map(|(y, error)| y + error).collect();
        system.rate(from.t, &y, &mut error)?;
        error.iter_mut().enumerate().for_each(|(i, error)| *error += stages(i));
        factors.estimate.solve(&mut error);
        Ok(measure(&error, &weights))
    }

    /// Solves for the stages with the Jacobian at hand; returns the rate of convergence.
    fn collocate(&mut self, system: &mut Counted, from: &Point, h: f64, norm: &Norm) -> Result<f64, Failure> {
        self.factor(h).ok_or(Failure::NoConvergence)?;
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
            *y = from.y[i] + self.z[2 * self.n + i];
        }
        system.rate_of(to)?;
        let error = self.error(system, from, to, norm)?;
        self.is_cautious = error > 1.0;
        Ok(error)
    }

    fn dense(&mut self, _system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (n, h, weights) = (self.n, to.t - from.t, slopes_at_start());
        let slope = |i: usize| (0..3).map(|l| weights[l] * self.z[l * n + i]).sum::<f64>() / h;
        let slopes: Vec<f64> = (0..n).map(slope).collect();
        self.past = Some((h, self.z.clone()));
        Ok(Segment::hermite((from.t, &from.y, &slopes), (to.t, &to.y, &to.dy)))
    }

    fn reset(&mut self) {
        *self = Self::new(self.n);
    }
}

/// Values at `theta` of the three polynomials that are 0 at 0 and at two of the nodes C and 1 at
/// the third.
fn lagrange(theta: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let others = (0..3).filter(|&l| l != k);
        others.fold(theta / C[k], |product, l| product * (theta - C[l]) / (C[k] - C[l]))
    })
}

/// Slopes at 0 of the same polynomials.
fn slopes_at_start() -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let others = (0..3).filter(|&l| l != k);
        others.fold(1.0 / C[k], |product, l| product * -C[l] / (C[k] - C[l]))
    })
}
