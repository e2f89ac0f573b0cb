//! The equations of an instant where every motion has inertia and no row depends on others: elimination in the order given.

use super::{largest, Matrix, Solution};

/// Pivot, over the largest inertia or over what the row was before the others were eliminated, below which digits may be lost.
const CLEAR: f64 = 1e-2;

/// [M Gᵀ; G 0] = L D Lᵀ, with positive pivots for M and negative ones for G (Vanderbei, *Symmetric quasidefinite matrices*, SIAM
/// J. Optimization 1995): M needs no exchange of rows, and after it neither do rows that are clearly independent.
#[derive(Clone, Debug, Default)]
pub struct Quasidefinite {
    size: usize,
    /// The rows of D Lᵀ above the diagonal, and on it the inverse pivots.
    factors: Vec<f64>,
}

/// Calls a function of the size as a constant.
macro_rules! of_size {
    ($size:expr, $self:ident.$function:ident $arguments:tt) => {
        of_size!(@ $size, $self, $function, $arguments, 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
    };
    (@ $size:expr, $self:ident, $function:ident, $arguments:tt, $($small:literal)*) => {
        match $size {
            $($small => $self.$function::<$small> $arguments,)*
            _ => unreachable!("no larger ones are factored"),
        }
    };
}

impl Quasidefinite {
    /// Most unknowns and rows together.
    pub const MOST: usize = 16;

    /// Factors other equations, false where it declines; `scale`: what makes the unknowns of order one.
    pub fn refactor(&mut self, mass: &Matrix, g: &Matrix, scale: &[f64]) -> bool {
        self.size = mass.rows() + g.rows();
        if self.size == 0 || self.size > Self::MOST {
            return false;
        }
        self.factors.resize(Self::MOST * Self::MOST, 0.0);
        let inertia = largest(scale.iter().enumerate().map(|(j, scale)| mass[(j, j)] * scale * scale));
        of_size!(self.size, self.factor(mass, g, scale, CLEAR * inertia))
    }

    /// `least`: what an inertia must be. Rows are combined in their whole length, for that is a constant; what that leaves below
    /// the diagonal is never read.
    fn factor<const N: usize>(&mut self, mass: &Matrix, g: &Matrix, scale: &[f64], least: f64) -> bool {
        let n = scale.len().min(N);
        let mut a = [[0.0; N]; N];
        for (i, to) in a.iter_mut().enumerate().take(n) {
            to.iter_mut().zip(mass.row_of(i, n)).for_each(|(to, entry)| *to = *entry);
        }
        for i in n..N {
            a.iter_mut().zip(g.row_of(i - n, n)).take(n).for_each(|(to, entry)| to[i] = *entry);
        }
        let (mut own, mut is_clear) = ([0.0; N], true);
        for k in 0..N {
            if k == n {
                own = std::array::from_fn(|i| -a[i][i]);
            }
            let (row, inverse) = (a[k], 1.0 / a[k][k]);
            is_clear &= if k < n { row[k] * scale[k] * scale[k] > least } else { -row[k] > CLEAR * own[k] };
            for i in k + 1..N {
                let part = row[i] * inverse;
                for j in 0..N {
                    a[i][j] -= part * row[j];
                }
            }
            a[k][k] = inverse;
        }
        self.factors[..N * N].copy_from_slice(a.as_flattened());
        is_clear
    }

    /// M a − Gᵀ λ = f, G a = r: into `found`.
    pub fn solve_into(&self, f: &[f64], r: &[f64], found: &mut Solution) {
        of_size!(self.size, self.substitute(f, r, found));
    }

    fn substitute<const N: usize>(&self, f: &[f64], r: &[f64], found: &mut Solution) {
        let rows = self.factors.as_chunks::<N>().0.first_chunk::<N>().expect("room for all sizes");
        let (mut side, mut x) = ([0.0; N], [0.0; N]);
        let (forces, rates) = side.split_at_mut(f.len().min(N));
        forces.copy_from_slice(f);
        rates.copy_from_slice(r);
        for k in 0..N {
            x[k] = side[k] * rows[k][k];
            for j in 0..N {
                side[j] -= rows[k][j] * x[k];
            }
        }
        for k in (0..N).rev() {
            let later: f64 = (k + 1..N).map(|j| rows[k][j] * x[j]).sum();
            x[k] -= rows[k][k] * later;
        }
        found.a.clear();
        found.a.extend_from_slice(&x[..f.len()]);
        found.lambda.clear();
        found.lambda.extend(x[f.len()..].iter().map(|x| -x));
        found.inconsistency = 0.0;
    }
}
