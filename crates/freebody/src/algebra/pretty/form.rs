//! Factored forms, before they become trees.

use super::super::atom::{AtomId, Factor};
use super::super::coefficient::Coefficient;
use super::super::ratio::Ratio;
use crate::scalar::real;
use std::rc::Rc;

/// A sum of products of free factors: sines and cosines may stand as powers and products.
pub(super) type Poly = Vec<(Vec<Factor>, Coefficient)>;

/// A factor: an atom or a sum in brackets.
#[derive(Clone, Debug)]
pub(super) enum Form {
    Atom(AtomId),
    Sum(Rc<[Product]>),
}

/// A number times powers of factors.
#[derive(Clone, Debug)]
pub(super) struct Product {
    pub(super) number: Coefficient,
    pub(super) factors: Vec<(Form, Ratio)>,
    /// How much there is to read.
    pub(super) cost: usize,
}

impl Product {
    /// The product as the terms of a sum.
    pub(super) fn into_terms(self) -> Vec<Product> {
        match &self.factors[..] {
            [(Form::Sum(terms), Ratio::ONE)] if self.number.abs().is_one() => {
                terms.iter().map(|term| term.clone().scaled(self.number)).collect()
            }
            _ => vec![self],
        }
    }
    pub(super) fn times(mut self, o: Product) -> Product {
        let number = self.number.times(o.number);
        self.cost = self.cost + o.cost + number_cost(number) - number_cost(self.number) - number_cost(o.number);
        self.number = number;
        self.factors.extend(o.factors);
        self
    }
    pub(super) fn scaled(mut self, by: Coefficient) -> Product {
        let number = self.number.times(by);
        self.cost = self.cost + number_cost(number) - number_cost(self.number);
        self.number = number;
        self
    }
    /// A whole power.
    pub(super) fn raised(mut self, e: Ratio) -> Product {
        let number = self.number.exact().and_then(|exact| exact.power(e.parts().0)).map(Coefficient::Exact);
        let number = number.unwrap_or(Coefficient::Float(real::powi(self.number.value(), e.parts().0 as i32)));
        self.cost = self.cost + self.factors.len() + number_cost(number) - number_cost(self.number);
        self.number = number;
        self.factors.iter_mut().for_each(|factor| factor.1 = factor.1.times(e).unwrap_or(factor.1));
        self
    }
    /// Every atom once.
    pub(super) fn joined(mut self) -> Product {
        let mut once: Vec<(Form, Ratio)> = Vec::new();
        for (form, e) in self.factors {
            let same =
                once.iter_mut().find(|(other, _)| matches!((other, &form), (Form::Atom(a), Form::Atom(b)) if a == b));
            match same.and_then(|(_, sum)| sum.plus(e).map(|joint| *sum = joint)) {
                Some(()) => {}
                None => once.push((form, e)),
            }
        }
        once.retain(|factor| !factor.1.is_zero());
        self.factors = once;
        self
    }
    /// A sum of products as one factor.
    pub(super) fn of_sum(mut terms: Vec<Product>) -> Product {
        if terms.len() == 1 {
            return terms.remove(0);
        }
        let cost = terms.iter().map(|term| term.cost).sum::<usize>() + terms.len() - 1;
        Product { number: Coefficient::ONE, factors: vec![(Form::Sum(terms.into()), Ratio::ONE)], cost }
    }
}

/// What a number costs to read; a sign costs nothing.
pub(super) fn number_cost(number: Coefficient) -> usize {
    match number.exact().map(|ratio| ratio.abs().parts()) {
        Some((1, 1)) => 0,
        Some((1, _)) | Some((_, 1)) | None => 1,
        Some(_) => 2,
    }
}
