//! Sums as a person writes them: factored, sines and cosines multiplied out of the Fourier form
//! where that is shorter, accelerations first.

mod factor;
mod form;
mod tree;
mod unfold;
mod write;

pub use tree::{Number, Tree};

use super::arena::{Arena, SumId};
use super::atom::{inverted, Atom, AtomId, Factor};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use factor::Writer;
use form::{Form, Product};

impl Arena {
    /// The tree of a sum, first by the given letters.
    pub(crate) fn tree(&mut self, of: SumId, first: &[AtomId]) -> Tree {
        let mut writer = Writer::new(self);
        let mut terms = Vec::new();
        let mut left = of;
        for &letter in first {
            let (with, without) = writer.split(left, letter);
            if with == SumId::ZERO {
                continue;
            }
            let one = Product { number: Coefficient::ONE, factors: vec![(Form::Atom(letter), Ratio::ONE)], cost: 1 };
            let term = writer.whole(with).times(one);
            terms.push(writer.written_product(&term));
            left = without;
        }
        if left != SumId::ZERO || terms.is_empty() {
            let rest = writer.whole(left);
            terms.extend(writer.written_terms(&rest.into_terms()));
        }
        Tree::sum(terms)
    }
}

impl Writer<'_> {
    /// The factor of a letter in the terms that hold it linearly, and the other terms.
    fn split(&mut self, of: SumId, letter: AtomId) -> (SumId, SumId) {
        let terms = self.arena.terms(of);
        let (mut with, mut without) = (Vec::new(), Vec::new());
        for &(monomial, c) in terms.iter() {
            let factors = self.arena.factors(monomial);
            match factors.contains(&(letter, Ratio::ONE)) {
                true => {
                    let rest: Vec<Factor> = factors.iter().copied().filter(|f| f.0 != letter).collect();
                    with.push((self.arena.monomial(rest), c));
                }
                false => without.push((monomial, c)),
            }
        }
        (self.arena.sum(with), self.arena.sum(without))
    }

    /// The cheapest form of a sum: as it stands, with sines and cosines multiplied, or over one denominator.
    pub(super) fn whole(&mut self, of: SumId) -> Product {
        if self.arena.terms(of).is_empty() {
            return Product { number: Coefficient::ZERO, factors: vec![], cost: 0 };
        }
        let mut forms = vec![self.arena.unfolded(of, false), self.arena.unfolded(of, true), self.arena.folded(of)];
        forms.dedup();
        let mut candidates: Vec<Product> = forms.iter().map(|poly| (*self.factor(poly)).clone()).collect();
        candidates.extend(self.over_one_denominator(of));
        candidates.into_iter().min_by_key(|product| product.cost).expect("there is one")
    }
    /// All terms over their common denominator.
    fn over_one_denominator(&mut self, of: SumId) -> Option<Product> {
        let below: Vec<Factor> = self.arena.content(of).0.into_iter().filter(|f| self.divides(f)).collect();
        if below.is_empty() || self.arena.terms(of).len() == 1 {
            return None;
        }
        let above = self.arena.multiply_factors(of, &inverted(&below));
        let below = self.single(&below, Coefficient::ONE);
        Some(below.times(self.whole(above)))
    }
    fn divides(&self, factor: &Factor) -> bool {
        factor.1.signum() < 0 && !matches!(self.arena.atom(factor.0), Atom::Letter(_))
    }
}
