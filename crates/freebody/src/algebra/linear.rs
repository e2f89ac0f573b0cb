//! A sum as factors of variables in which it is linear, and the rest.

use super::arena::{Arena, SumId, Term};
use super::atom::{with_exponent, AtomId, Factor};
use super::ratio::Ratio;

impl Arena {
    /// The factor of each variable, and what is left without them, in one pass; a term with two of them, or one of them
    /// inside another atom, is left in the rest.
    pub(crate) fn linear(&mut self, of: SumId, variables: &[AtomId]) -> (Vec<SumId>, SumId) {
        let mut parts: Vec<Vec<Term>> = vec![vec![]; variables.len()];
        let mut rest = vec![];
        for &(monomial, coefficient) in self.terms(of).iter() {
            let factors = self.factors(monomial);
            let place = |f: &Factor| if f.1 == Ratio::ONE { variables.iter().position(|l| *l == f.0) } else { None };
            let mut found = factors.iter().enumerate().filter_map(|(at, f)| place(f).map(|k| (at, k)));
            match (found.next(), found.next()) {
                (Some((at, k)), None) => {
                    let without = self.monomial(with_exponent(&factors, at, Ratio::ZERO));
                    parts[k].push((without, coefficient));
                }
                _ => rest.push((monomial, coefficient)),
            }
        }
        (parts.into_iter().map(|terms| self.sum(terms)).collect(), self.sum(rest))
    }
}
