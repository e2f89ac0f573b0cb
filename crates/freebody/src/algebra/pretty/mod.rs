//! Sums as a person writes them: factored, sines and cosines multiplied out of the Fourier form
//! where that is shorter, accelerations first.

mod factor;
mod form;
mod tree;
mod unfold;
mod write;

pub(super) use factor::Known;
pub use tree::{Number, Tree};

use super::arena::{Arena, SumId, Term};
use super::atom::{inverted, Atom, AtomId, Factor};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use factor::{Kind, Writer};
use form::{Form, Product};
use std::rc::Rc;

/// Above this number of terms only two ways to write sines and cosines are followed.
const MANY_TERMS: usize = 60;
/// Above this number of terms only one is.
const VERY_MANY_TERMS: usize = 400;

impl Arena {
    /// The tree of a sum.
    pub(crate) fn tree(&mut self, of: SumId) -> Tree {
        let mut writer = Writer { arena: self };
        let whole = (*writer.whole(of)).clone();
        Tree::sum(writer.written_terms(&whole.into_terms()))
    }

    /// The tree of a sum as one term for each of the given variables that occurs linearly, then what holds
    /// rates, then the rest, with products of functions standing by themselves.
    pub(crate) fn tree_by(&mut self, of: SumId, variables: &[AtomId]) -> Tree {
        let (factors, rest) = self.linear(of, variables);
        let mut writer = Writer { arena: self };
        let mut terms = Vec::new();
        for (&variable, with) in variables.iter().zip(factors).filter(|(_, with)| *with != SumId::ZERO) {
            let one = Product { number: Coefficient::ONE, factors: vec![(Form::Atom(variable), Ratio::ONE)], cost: 1 };
            let term = (*writer.whole(with)).clone().times(one);
            terms.push(writer.written_product(&term));
        }
        for part in writer.by_rates(rest).into_iter().filter(|&part| part != SumId::ZERO) {
            let whole = (*writer.whole(part)).clone();
            let wrenches: Vec<Product> = whole.into_terms().into_iter().flat_map(|term| writer.spread(term)).collect();
            terms.extend(writer.written_terms(&wrenches));
        }
        Tree::sum(terms)
    }
}

impl Writer<'_> {
    /// The terms with rates, and those without.
    fn by_rates(&mut self, of: SumId) -> [SumId; 2] {
        let holds = |term: &Term| self.arena.factors(term.0).iter().any(|f| self.kind(f.0) == Kind::Rate);
        let (with, without) = self.arena.terms(of).iter().partition(|term| holds(term));
        [with, without].map(|terms| self.arena.sorted_sum(terms))
    }

    /// A product of variables and of a sum whose terms all hold functions, as separate terms.
    fn spread(&self, product: Product) -> Vec<Product> {
        let sums: Vec<usize> =
            (0..product.factors.len()).filter(|&i| matches!(product.factors[i].0, Form::Sum(_))).collect();
        let &[at] = &sums[..] else { return vec![product] };
        match &product.factors[at] {
            (Form::Sum(terms), Ratio::ONE) if terms.iter().all(|term| self.holds_function(term)) => {
                let mut outer = product.clone();
                outer.factors.remove(at);
                terms.iter().map(|term| outer.clone().times(term.clone()).joined()).collect()
            }
            _ => vec![product],
        }
    }

    /// The cheapest form of a sum: as it stands, with sines and cosines multiplied, or over one denominator.
    pub(super) fn whole(&mut self, of: SumId) -> Rc<Product> {
        if let Some(known) = self.arena.known.whole.get(&of) {
            return known.clone();
        }
        let whole = Rc::new(self.cheapest(of));
        self.arena.known.whole.insert(of, whole.clone());
        whole
    }
    fn cheapest(&mut self, of: SumId) -> Product {
        let length = self.arena.terms(of).len();
        if length == 0 {
            return Product { number: Coefficient::ZERO, factors: vec![], cost: 0 };
        }
        let mut forms = vec![self.arena.unfolded(of, false), self.arena.unfolded(of, true), self.arena.folded(of)];
        forms.dedup();
        if length > MANY_TERMS {
            forms.sort_by_cached_key(|poly| self.flat_cost(poly));
            forms.truncate(if length > VERY_MANY_TERMS { 1 } else { 2 });
        }
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
        Some(below.times((*self.whole(above)).clone()))
    }
    fn divides(&self, factor: &Factor) -> bool {
        factor.1.signum() < 0 && !matches!(self.arena.atom(factor.0), Atom::Variable(_))
    }
}
