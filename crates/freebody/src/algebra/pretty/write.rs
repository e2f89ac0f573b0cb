//! From factored forms to trees, in the order in which a person writes.

use super::super::arena::SumId;
use super::super::atom::{Atom, AtomId, Function};
use super::super::coefficient::Coefficient;
use super::super::ratio::Ratio;
use super::factor::{Kind, Writer};
use super::form::{Form, Product};
use super::tree::Tree;
use std::cmp::Reverse;
use std::collections::BTreeSet;

/// Where a term stands in a sum: highest derivatives first, then variables as they were made.
type Place = (Reverse<i16>, Vec<AtomId>, Vec<AtomId>);

impl Writer<'_> {
    /// The terms of a sum, in order.
    pub(super) fn written_terms(&mut self, terms: &[Product]) -> Vec<Tree> {
        let terms = self.ordered(terms);
        terms.iter().map(|term| self.written_settled(term)).collect()
    }
    pub(super) fn written_product(&mut self, product: &Product) -> Tree {
        let product = self.settled(product);
        self.written_settled(&product)
    }

    /// Sums within in their order, begun with a positive term where that costs no sign.
    fn settled(&self, product: &Product) -> Product {
        let mut settled = product.clone();
        for (form, e) in &mut settled.factors {
            let Form::Sum(terms) = form else { continue };
            let mut inner = self.ordered(terms);
            let positive = inner.iter().position(|term| !term.number.is_negative());
            let turns = e.is_even() || (e.is_whole() && (settled.number.is_negative() || positive.is_none()));
            match positive {
                Some(0) => {}
                _ if turns => {
                    let minus = Coefficient::whole(-1);
                    inner.iter_mut().for_each(|term| term.number = term.number.negated());
                    settled.number = if e.is_even() { settled.number } else { settled.number.times(minus) };
                }
                Some(at) => inner[..=at].rotate_right(1),
                None => {}
            }
            *terms = inner.into();
        }
        settled
    }
    fn ordered(&self, terms: &[Product]) -> Vec<Product> {
        let mut terms: Vec<Product> = terms.iter().map(|term| self.settled(term)).collect();
        terms.sort_by_cached_key(|term| self.place(term));
        terms
    }

    fn written_settled(&mut self, product: &Product) -> Tree {
        let mut factors: Vec<((u8, Vec<AtomId>), Tree)> = Vec::new();
        let mut atoms: Vec<(AtomId, Ratio)> = Vec::new();
        for (form, e) in &product.factors {
            match form {
                Form::Atom(id) => atoms.push((*id, *e)),
                Form::Sum(terms) => {
                    let sum = Tree::sum(terms.iter().map(|term| self.written_settled(term)).collect());
                    factors.push((self.factor_place(terms, *e), Tree::power(sum, *e)));
                }
            }
        }
        self.tangents(&mut atoms, &mut factors);
        for (id, e) in atoms {
            let kind = match self.arena.atom(id) {
                Atom::Prime(_) | Atom::Pi => 0,
                _ if e.signum() < 0 => 3,
                _ => [2, 4, 6][self.kind(id) as usize],
            };
            let atom = self.written_atom(id);
            factors.push(((kind, vec![id]), Tree::power(atom, e)));
        }
        factors.sort_by(|a, b| a.0.cmp(&b.0));
        let mut all = vec![Tree::number(product.number)];
        all.extend(factors.into_iter().map(|factor| factor.1));
        Tree::product(all)
    }

    /// sin A/cos A is tan A.
    fn tangents(&mut self, atoms: &mut Vec<(AtomId, Ratio)>, factors: &mut Vec<((u8, Vec<AtomId>), Tree)>) {
        while let Some((sine, cosine, angle)) = self.find_tangent(atoms) {
            let (id, e) = atoms[sine];
            let tangent = Tree::call("tan", vec![self.written(angle)]);
            factors.push(((4, vec![id]), Tree::power(tangent, e)));
            atoms.remove(sine.max(cosine));
            atoms.remove(sine.min(cosine));
        }
    }
    fn find_tangent(&self, atoms: &[(AtomId, Ratio)]) -> Option<(usize, usize, SumId)> {
        for (i, &(id, e)) in atoms.iter().enumerate() {
            let Atom::Sin(angle) = *self.arena.atom(id) else { continue };
            let below = |&(other, exponent): &(AtomId, Ratio)| {
                exponent == e.negated() && *self.arena.atom(other) == Atom::Cos(angle)
            };
            if let Some(j) = atoms.iter().position(below).filter(|_| e.signum() > 0) {
                return Some((i, j, angle));
            }
        }
        None
    }

    fn written(&mut self, of: SumId) -> Tree {
        let terms = (*self.whole(of)).clone().into_terms();
        Tree::sum(self.written_terms(&terms))
    }
    fn written_atom(&mut self, id: AtomId) -> Tree {
        match self.arena.atom(id).clone() {
            Atom::Variable(variable) => Tree::variable(&variable.name, variable.dots),
            Atom::Pi => Tree::variable("pi", 0),
            Atom::Prime(p) => Tree::number(Coefficient::whole(p)),
            Atom::Group(of) => self.written(of),
            Atom::Cos(of) => Tree::call("cos", vec![self.written(of)]),
            Atom::Sin(of) => Tree::call("sin", vec![self.written(of)]),
            Atom::Call(function, of) => {
                let of = of.iter().map(|&x| self.written(x)).collect();
                Tree::call(&function_name(&function), of)
            }
        }
    }

    pub(super) fn holds_function(&self, product: &Product) -> bool {
        let mut atoms = BTreeSet::new();
        collect(product, &mut atoms);
        atoms.into_iter().any(|id| self.kind(id) == Kind::Function)
    }
    fn place(&self, product: &Product) -> Place {
        let mut atoms = BTreeSet::new();
        collect(product, &mut atoms);
        let dots = |&id: &AtomId| self.arena.variable(id).map_or(-1, |variable| i16::from(variable.dots));
        let highest = atoms.iter().map(dots).max().unwrap_or(-1);
        let first = atoms.iter().copied().filter(|id| highest >= 0 && dots(id) == highest).collect();
        (Reverse(highest), first, atoms.into_iter().collect())
    }
    /// Sums of parameters before variables, sums with functions or rates among those.
    fn factor_place(&self, terms: &[Product], e: Ratio) -> (u8, Vec<AtomId>) {
        let mut atoms = BTreeSet::new();
        terms.iter().for_each(|term| collect(term, &mut atoms));
        let kind = atoms.iter().map(|&id| self.kind(id)).max().unwrap_or(Kind::Parameter);
        let rank = if e.signum() < 0 { 3 } else { [1, 5, 7][kind as usize] };
        (rank, atoms.into_iter().collect())
    }
}

fn collect(product: &Product, atoms: &mut BTreeSet<AtomId>) {
    for (form, _) in &product.factors {
        match form {
            Form::Atom(id) => {
                atoms.insert(*id);
            }
            Form::Sum(terms) => terms.iter().for_each(|term| collect(term, atoms)),
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
