//! Sums as a person writes them.

mod tree;

pub use tree::{Number, Tree};

use super::arena::{Arena, SumId};
use super::atom::{Atom, AtomId, Factor, Function};
use super::coefficient::Coefficient;

impl Arena {
    pub(crate) fn tree(&mut self, of: SumId, _first: &[AtomId]) -> Tree {
        self.plain(of)
    }
    fn plain(&mut self, of: SumId) -> Tree {
        let terms = self.terms(of);
        let terms = terms.iter().map(|&(m, c)| self.plain_term(&self.factors(m).clone(), c)).collect();
        Tree::sum(terms)
    }
    fn plain_term(&mut self, factors: &[Factor], c: Coefficient) -> Tree {
        let mut all = vec![Tree::number(c)];
        for &(id, e) in factors {
            let atom = self.plain_atom(id);
            all.push(Tree::power(atom, e));
        }
        Tree::product(all)
    }
    fn plain_atom(&mut self, id: AtomId) -> Tree {
        match self.atom(id).clone() {
            Atom::Letter(letter) => Tree::letter(&letter.name, letter.dots),
            Atom::Pi => Tree::letter("pi", 0),
            Atom::Prime(p) => Tree::number(Coefficient::whole(p)),
            Atom::Group(of) => self.plain(of),
            Atom::Cos(of) => Tree::call("cos", vec![self.plain(of)]),
            Atom::Sin(of) => Tree::call("sin", vec![self.plain(of)]),
            Atom::Call(function, of) => {
                let of = of.iter().map(|&x| self.plain(x)).collect();
                Tree::call(&function_name(&function), of)
            }
        }
    }
}

fn function_name(function: &Function) -> String {
    match function {
        Function::Exp => "exp".into(),
        Function::Ln => "ln".into(),
        Function::Abs => "abs".into(),
        Function::Atan2 => "atan2".into(),
        Function::Named(name, order) => format!("{name}{}", "'".repeat(*order as usize)),
    }
}
