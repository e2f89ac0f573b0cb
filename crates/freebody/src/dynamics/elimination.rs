//! The equations of an instant eliminated in the order given, over any scalar.

use crate::scalar::Scalar;

/// [M Gᵀ; G 0] = L D Lᵀ without pivoting (Golub & Van Loan, *Matrix Computations*, §4.1), to be read where [`Quasidefinite`](crate::solve::Quasidefinite) decides that it holds.
#[derive(Clone, Debug)]
pub struct Elimination<S> {
    /// The rows of Lᵀ right of the diagonal.
    factors: Vec<Vec<S>>,
    /// D: positive for M, negative for G.
    pub pivots: Vec<S>,
    inverse: Vec<S>,
}

impl<S: Scalar> Elimination<S> {
    /// `a`: the entries on the diagonal and above it.
    pub fn new(mut a: Vec<Vec<S>>) -> Self {
        let (mut pivots, mut inverse) = (vec![], vec![]);
        for k in 0..a.len() {
            let (done, rest) = a.split_at_mut(k + 1);
            let row = &mut done[k];
            pivots.push(row[k]);
            inverse.push(S::one() / row[k]);
            for (i, to) in (k + 1..).zip(rest) {
                let part = row[i] * inverse[k];
                (i..row.len()).for_each(|j| to[j] -= part * row[j]);
                row[i] = part;
            }
        }
        Elimination { factors: a, pivots, inverse }
    }

    /// M a − Gᵀ λ = f, G a = r, for [f, r]: [a, −λ].
    pub fn solve(&self, mut side: Vec<S>) -> Vec<S> {
        let size = side.len();
        for k in 0..size {
            let own = side[k];
            (k + 1..size).for_each(|j| side[j] -= self.factors[k][j] * own);
        }
        for k in (0..size).rev() {
            let own = side[k] * self.inverse[k];
            side[k] = (k + 1..size).fold(own, |left, j| left - self.factors[k][j] * side[j]);
        }
        side
    }
}
