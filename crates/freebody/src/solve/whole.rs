//! The equations of an instant as one small matrix: the quickest way where nothing is in doubt.

use super::saddle::Equations;
use super::{largest, with_length, Lu, Matrix, Solution};

/// Most unknowns and rows together: beyond, the zeros and the groups of the equations are worth more.
const MOST: usize = 16;
/// Pivot, entries being of order one, below which rows may depend on each other, a motion may have no inertia, or small masses
/// behind large ones may lose digits.
const CLEAR: f64 = 1e-2;

/// [M −Bᵀ; G 0] in its LU factors. It knows no rank and no groups, so it declines where a pivot is small: [`Islands`](super::Islands)
/// are asked then.
#[derive(Clone, Debug, Default)]
pub struct Whole {
    matrix: Matrix,
    lu: Lu,
    /// What makes the equations, and the unknowns, of order one.
    left: Vec<f64>,
    right: Vec<f64>,
    side: Vec<f64>,
    found: Vec<f64>,
}

impl Whole {
    /// Factors other equations, false where it declines.
    pub fn refactor(&mut self, of: Equations) -> bool {
        let Equations { mass, row_scale, col_scale, .. } = of;
        let size = row_scale.len() + col_scale.len();
        if size > MOST {
            return false;
        }
        let inertia = largest((0..mass.rows()).map(|j| mass[(j, j)] * col_scale[j] * col_scale[j]));
        if inertia <= 0.0 || !inertia.is_finite() {
            return false;
        }
        with_length!(size, |size| self.set_up(size, of, inertia));
        self.matrix.data().iter().all(|entry| entry.is_finite()) && self.lu.refactor(&self.matrix, CLEAR).is_ok()
    }

    #[inline(always)]
    fn set_up(&mut self, size: usize, of: Equations, inertia: f64) {
        let Equations { mass, g, b, row_scale, col_scale } = of;
        let n = col_scale.len();
        self.left.clear();
        self.right.clear();
        for &scale in col_scale {
            self.left.push(scale / inertia);
            self.right.push(scale);
        }
        for &scale in row_scale {
            self.left.push(scale);
            self.right.push(scale * inertia);
        }
        self.matrix.reset(size, size);
        for j in 0..n {
            let row = self.matrix.row_of_mut(j, size);
            for (k, &entry) in mass.row(j).iter().enumerate() {
                row[k] = entry * self.left[j] * self.right[k];
            }
        }
        for i in 0..row_scale.len() {
            let b = b.unwrap_or(g).row(i);
            for (j, (&g, &b)) in g.row(i).iter().zip(b).enumerate() {
                self.matrix.row_of_mut(n + i, size)[j] = g * self.left[n + i] * self.right[j];
                self.matrix.row_of_mut(j, size)[n + i] = -b * self.left[j] * self.right[n + i];
            }
        }
    }

    /// Solves for applied forces f (n) and right-hand sides r (m), not refined: into `found`.
    pub fn solve_into(&mut self, f: &[f64], r: &[f64], found: &mut Solution) {
        self.side.clear();
        for (value, scale) in f.iter().chain(r).zip(&self.left) {
            self.side.push(value * scale);
        }
        self.lu.substitute(&self.side, &mut self.found);
        self.found.iter_mut().zip(&self.right).for_each(|(value, scale)| *value *= scale);
        let (a, lambda) = self.found.split_at(f.len());
        a.clone_into(&mut found.a);
        lambda.clone_into(&mut found.lambda);
        found.inconsistency = 0.0;
    }
}
