//! The equations of an instant where every motion has inertia and no row depends on others: elimination in the order given.

use super::{largest, Matrix, Solution};

/// Most unknowns and rows together.
const MOST: usize = 12;
/// Pivot, over the largest inertia or over what the row was before the others were eliminated, below which digits may be lost.
const CLEAR: f64 = 1e-2;

/// [M Gᵀ; G 0] = L D Lᵀ, with positive pivots for M and negative ones for G (Vanderbei, *Symmetric quasidefinite matrices*, SIAM
/// J. Optimization 1995): M needs no exchange of rows, and after it neither do rows that are clearly independent.
#[derive(Clone, Debug, Default)]
pub struct Quasidefinite {
    size: usize,
    /// The rows of L below the diagonal, and on it the inverse pivots.
    factors: Vec<f64>,
}

/// Calls a function of the size as a constant.
macro_rules! of_size {
    ($size:expr, $self:ident.$function:ident $arguments:tt) => {
        of_size!(@ $size, $self, $function, $arguments, 1 2 3 4 5 6 7 8 9 10 11 12)
    };
    (@ $size:expr, $self:ident, $function:ident, $arguments:tt, $($small:literal)*) => {
        match $size {
            $($small => $self.$function::<$small> $arguments,)*
            _ => unreachable!("no larger ones are factored"),
        }
    };
}

impl Quasidefinite {
    /// Factors other equations, false where it declines; `scale`: what makes the unknowns of order one.
    pub fn refactor(&mut self, mass: &Matrix, g: &Matrix, scale: &[f64]) -> bool {
        self.size = mass.rows() + g.rows();
        if self.size == 0 || self.size > MOST {
            return false;
        }
        self.factors.resize(MOST * MOST, 0.0);
        let inertia = largest(scale.iter().enumerate().map(|(j, scale)| mass[(j, j)] * scale * scale));
        of_size!(self.size, self.factor(mass, g, scale, CLEAR * inertia))
    }

    /// `least`: what an inertia must be.
    #[inline(never)]
    fn factor<const N: usize>(&mut self, mass: &Matrix, g: &Matrix, scale: &[f64], least: f64) -> bool {
        let n = scale.len().min(N);
        let mut a = [[0.0; N]; N];
        for (i, row) in a.iter_mut().enumerate() {
            let from = if i < n { &mass.row(i)[..=i] } else { g.row(i - n) };
            row[..from.len()].copy_from_slice(from);
        }
        let mut own = [0.0; N];
        for k in 0..N {
            let pivot = a[k][k];
            if k < n {
                // Written so that what is not a number declines.
                if !(pivot * scale[k] * scale[k] > least) {
                    return false;
                }
            } else if !(-pivot > CLEAR * own[k]) {
                return false;
            }
            let inverse = 1.0 / pivot;
            a[k][k] = inverse;
            for i in k + 1..N {
                let entry = a[i][k];
                let part = entry * inverse;
                for j in k + 1..=i {
                    a[i][j] -= part * a[j][k];
                }
                if k < n && i >= n {
                    own[i] += part * entry;
                }
            }
            for row in &mut a[k + 1..] {
                row[k] *= inverse;
            }
        }
        self.factors[..N * N].copy_from_slice(a.as_flattened());
        true
    }

    /// M a − Gᵀ λ = f, G a = r: into `found`.
    pub fn solve_into(&self, f: &[f64], r: &[f64], found: &mut Solution) {
        of_size!(self.size, self.substitute(f, r, found));
    }

    #[inline(never)]
    fn substitute<const N: usize>(&self, f: &[f64], r: &[f64], found: &mut Solution) {
        let rows = self.factors.as_chunks::<N>().0.first_chunk::<N>().expect("room for all sizes");
        let mut x = [0.0; N];
        x.iter_mut().zip(f.iter().chain(r)).for_each(|(x, side)| *x = *side);
        for i in 0..N {
            for j in 0..i {
                x[i] -= rows[i][j] * x[j];
            }
        }
        for i in (0..N).rev() {
            x[i] *= rows[i][i];
            for j in i + 1..N {
                x[i] -= rows[j][i] * x[j];
            }
        }
        found.a.clear();
        found.a.extend_from_slice(&x[..f.len()]);
        found.lambda.clear();
        found.lambda.extend(x[f.len()..].iter().map(|x| -x));
        found.inconsistency = 0.0;
    }
}
