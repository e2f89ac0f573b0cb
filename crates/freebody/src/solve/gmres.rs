//! Refinement of an approximate solver by minimal residuals.

use super::{axpy, dot};

/// Directions kept in one cycle.
const CYCLE: usize = 20;
/// A cycle ends at this reduction of the residual, which is then computed afresh.
const REDUCTION: f64 = 1e-8;
/// K P⁻¹ is near the identity; below this it is round-off, and the direction in the kernel of K.
const KERNEL: f64 = 1e-5;

/// The directions of a cycle and what the solver makes of them, end to end.
#[derive(Clone, Debug, Default)]
pub(super) struct Directions {
    basis: Vec<f64>,
    steps: Vec<f64>,
}

/// Adds to `x` an approximate solution of K x = `residual` (the residual is overwritten) and returns
/// the number of preconditioner solves. `target` is the 2-norm at which to stop.
///
/// One cycle of flexible GMRES (Saad, *Iterative Methods for Sparse Linear Systems*, 2nd ed., §9.4);
/// its first direction alone is a step of iterative refinement, the others deal with what the
/// regularised factors do not resolve.
pub(super) fn cycle(
    apply: impl Fn(&[f64], &mut [f64]),
    precondition: impl Fn(&mut [f64]),
    Directions { basis, steps }: &mut Directions,
    residual: &mut [f64],
    target: f64,
    x: &mut [f64],
) -> usize {
    let (n, beta) = (residual.len(), dot(residual, residual).sqrt());
    let stop = target.max(REDUCTION * beta);
    residual.iter_mut().for_each(|v| *v /= beta);
    basis.clear();
    basis.extend_from_slice(residual);
    steps.clear();
    let (mut count, mut least) = (0, LeastSquares::new(beta));
    while count < CYCLE && least.residual() > stop {
        steps.extend_from_slice(&basis[count * n..]);
        precondition(&mut steps[count * n..]);
        basis.resize((count + 2) * n, 0.0);
        let (known, w) = basis.split_at_mut((count + 1) * n);
        apply(&steps[count * n..], w);
        let mut column = [0.0; CYCLE + 1];
        known.chunks_exact(n).zip(&mut column).for_each(|(v, h)| *h = remove(v, w));
        let norm = dot(w, w).sqrt();
        column[count + 1] = norm;
        count += 1;
        if !least.push(column) || norm == 0.0 {
            break;
        }
        w.iter_mut().for_each(|v| *v /= norm);
    }
    let y = least.solution();
    y[..least.size].iter().zip(steps.chunks_exact(n)).for_each(|(y, z)| axpy(*y, z, x));
    count
}

/// Takes the part along the unit vector v out of w and returns its size.
fn remove(v: &[f64], w: &mut [f64]) -> f64 {
    let h = dot(v, w);
    axpy(-h, v, w);
    h
}

/// min |β e₀ − H y| for a Hessenberg H that grows by columns, by plane rotations.
struct LeastSquares {
    size: usize,
    columns: [[f64; CYCLE + 1]; CYCLE],
    rotations: [(f64, f64); CYCLE],
    rhs: [f64; CYCLE + 1],
}

impl LeastSquares {
    fn new(beta: f64) -> LeastSquares {
        let mut rhs = [0.0; CYCLE + 1];
        rhs[0] = beta;
        LeastSquares { size: 0, columns: [[0.0; CYCLE + 1]; CYCLE], rotations: [(1.0, 0.0); CYCLE], rhs }
    }

    /// Takes a column, unless it is dependent.
    fn push(&mut self, mut h: [f64; CYCLE + 1]) -> bool {
        let k = self.size;
        for (i, &(c, s)) in self.rotations[..k].iter().enumerate() {
            (h[i], h[i + 1]) = (c * h[i] + s * h[i + 1], c * h[i + 1] - s * h[i]);
        }
        let norm = (h[k] * h[k] + h[k + 1] * h[k + 1]).sqrt();
        if norm <= KERNEL {
            return false;
        }
        let (c, s) = (h[k] / norm, h[k + 1] / norm);
        h[k] = norm;
        let last = self.rhs[k];
        (self.rhs[k], self.rhs[k + 1]) = (c * last, -s * last);
        (self.rotations[k], self.columns[k]) = ((c, s), h);
        self.size = k + 1;
        true
    }

    fn residual(&self) -> f64 {
        self.rhs[self.size].abs()
    }

    fn solution(&self) -> [f64; CYCLE + 1] {
        let mut y = self.rhs;
        for k in (0..self.size).rev() {
            y[k] /= self.columns[k][k];
            let s = y[k];
            axpy(-s, &self.columns[k][..k], &mut y[..k]);
        }
        y
    }
}
