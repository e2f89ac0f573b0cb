//! Refinement of an approximate solver by minimal residuals.

use super::{axpy, dot};

/// Directions kept in one cycle.
const CYCLE: usize = 20;
/// A cycle ends at this reduction of the residual, which is then computed afresh.
const REDUCTION: f64 = 1e-8;
/// K P⁻¹ is near the identity; below this it is round-off, and the direction in the kernel of K.
const KERNEL: f64 = 1e-5;

/// Adds to `x` an approximate solution of K x = `residual` (the residual is overwritten) and returns
/// the number of preconditioner solves. `target` is the 2-norm at which to stop.
///
/// One cycle of flexible GMRES (Saad, *Iterative Methods for Sparse Linear Systems*, 2nd ed., §9.4);
/// its first direction alone is a step of iterative refinement, the others deal with what the
/// regularised factors do not resolve.
pub(super) fn cycle(
    apply: impl Fn(&[f64], &mut [f64]),
    precondition: impl Fn(&mut [f64]),
    residual: &mut [f64],
    target: f64,
    x: &mut [f64],
) -> usize {
    let beta = dot(residual, residual).sqrt();
    let stop = target.max(REDUCTION * beta);
    residual.iter_mut().for_each(|v| *v /= beta);
    let mut basis = vec![residual.to_vec()];
    let mut steps: Vec<Vec<f64>> = Vec::new();
    let mut least = LeastSquares { rhs: vec![beta], ..Default::default() };
    while steps.len() < CYCLE && least.residual() > stop {
        let mut z = basis[steps.len()].clone();
        precondition(&mut z);
        let mut w = vec![0.0; z.len()];
        apply(&z, &mut w);
        steps.push(z);
        let mut column: Vec<f64> = basis.iter().map(|v| remove(v, &mut w)).collect();
        let norm = dot(&w, &w).sqrt();
        column.push(norm);
        if !least.push(column) || norm == 0.0 {
            break;
        }
        w.iter_mut().for_each(|v| *v /= norm);
        basis.push(w);
    }
    let y = least.solution();
    y.iter().zip(&steps).for_each(|(y, z)| axpy(*y, z, x));
    steps.len()
}

/// Takes the part along the unit vector v out of w and returns its size.
fn remove(v: &[f64], w: &mut [f64]) -> f64 {
    let h = dot(v, w);
    axpy(-h, v, w);
    h
}

/// min |β e₀ − H y| for a Hessenberg H that grows by columns, by plane rotations.
#[derive(Default)]
struct LeastSquares {
    columns: Vec<Vec<f64>>,
    rotations: Vec<(f64, f64)>,
    rhs: Vec<f64>,
}

impl LeastSquares {
    /// Takes a column, unless it is dependent.
    fn push(&mut self, mut h: Vec<f64>) -> bool {
        for (i, &(c, s)) in self.rotations.iter().enumerate() {
            (h[i], h[i + 1]) = (c * h[i] + s * h[i + 1], c * h[i + 1] - s * h[i]);
        }
        let k = self.columns.len();
        let norm = (h[k] * h[k] + h[k + 1] * h[k + 1]).sqrt();
        if norm <= KERNEL {
            return false;
        }
        let (c, s) = (h[k] / norm, h[k + 1] / norm);
        h[k] = norm;
        let last = self.rhs[k];
        self.rhs[k] = c * last;
        self.rhs.push(-s * last);
        self.rotations.push((c, s));
        self.columns.push(h);
        true
    }

    fn residual(&self) -> f64 {
        self.rhs[self.columns.len()].abs()
    }

    fn solution(&self) -> Vec<f64> {
        let mut y = self.rhs[..self.columns.len()].to_vec();
        for k in (0..y.len()).rev() {
            y[k] /= self.columns[k][k];
            let s = y[k];
            axpy(-s, &self.columns[k][..k], &mut y[..k]);
        }
        y
    }
}
