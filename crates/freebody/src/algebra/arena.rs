//! Where sums live: every canonical sum once, so that equal sums have equal handles.

pub(crate) use super::atom::SumId;
use super::atom::{Atom, AtomId, Factor, Function};
use super::coefficient::Coefficient;
use super::pretty::Known;
use super::ratio::Ratio;
use crate::scalar::real;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::rc::Rc;

/// The position of a product of atoms in the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct MonomialId(u32);

impl MonomialId {
    pub(super) const UNIT: MonomialId = MonomialId(0);
}

/// A product of atoms with its coefficient.
pub(super) type Term = (MonomialId, Coefficient);

/// The values of a named function and of its derivatives: of the argument and the order.
pub type Rule = Rc<dyn Fn(f64, u8) -> f64>;

/// How a group is divided by: its leading product, the coefficient of that, and the rest.
pub(super) type Lead = (MonomialId, Coefficient, SumId);

#[derive(Default)]
pub(crate) struct Arena {
    atoms: Vec<(Atom, f64)>,
    atom_ids: FxHashMap<Atom, AtomId>,
    monomials: Vec<Rc<[Factor]>>,
    monomial_ids: FxHashMap<Rc<[Factor]>, MonomialId>,
    sums: Vec<Rc<[Term]>>,
    sum_ids: FxHashMap<Rc<[Term]>, SumId>,
    pub(super) products: FxHashMap<(MonomialId, MonomialId), SumId>,
    pub(super) leads: FxHashMap<SumId, Option<Lead>>,
    pub(super) known: Known,
    pub(super) rules: FxHashMap<Rc<str>, Rule>,
    /// Terms written so far.
    spent: usize,
}

/// Terms that a session may write; the equations of a ten-link chain take 1.4 million. Beyond, everything is undefined.
const BUDGET: usize = 5_000_000;

thread_local! {
    static ARENA: RefCell<Arena> = RefCell::new(Arena::new());
}

/// Does something with the arena of this thread.
pub(crate) fn with<T>(work: impl FnOnce(&mut Arena) -> T) -> T {
    ARENA.with(|arena| work(&mut arena.borrow_mut()))
}

pub(super) fn clear() {
    with(|arena| *arena = Arena::new());
}

impl Arena {
    fn new() -> Self {
        let mut arena = Arena::default();
        arena.monomial(Vec::new());
        arena.sum(Vec::new());
        arena.constant(Coefficient::ONE);
        arena
    }

    /// The atom, with its value where it is new.
    pub(super) fn atom_with(&mut self, atom: Atom, value: impl FnOnce(&Self) -> f64) -> AtomId {
        if let Some(&id) = self.atom_ids.get(&atom) {
            return id;
        }
        let value = value(self);
        let id = AtomId(self.atoms.len() as u32);
        self.atoms.push((atom.clone(), value));
        self.atom_ids.insert(atom, id);
        id
    }
    /// The atom; a variable that is new has no value.
    pub(super) fn atom_id(&mut self, atom: Atom) -> AtomId {
        let copy = atom.clone();
        self.atom_with(atom, |arena| arena.witness(&copy))
    }
    fn witness(&self, atom: &Atom) -> f64 {
        match atom {
            Atom::Variable(_) => f64::NAN,
            Atom::Pi => std::f64::consts::PI,
            Atom::Prime(p) => *p as f64,
            Atom::Cos(of) => real::sin_cos(self.value(*of)).1,
            Atom::Sin(of) => real::sin_cos(self.value(*of)).0,
            Atom::Group(of) => self.value(*of),
            Atom::Call(function, of) => {
                let arguments: Vec<f64> = of.iter().map(|&id| self.value(id)).collect();
                self.call(function, &arguments)
            }
        }
    }
    /// The value of a function.
    pub(super) fn call(&self, function: &Function, x: &[f64]) -> f64 {
        match function {
            Function::Exp => real::exp(x[0]),
            Function::Ln => real::ln(x[0]),
            Function::Abs => x[0].abs(),
            Function::Atan2 => real::atan2(x[0], x[1]),
            Function::Named(name, order) => self.rules.get(name).map_or(f64::NAN, |rule| rule(x[0], *order)),
        }
    }
    pub(super) fn atom(&self, id: AtomId) -> &Atom {
        &self.atoms[id.0 as usize].0
    }
    pub(super) fn atom_value(&self, id: AtomId) -> f64 {
        self.atoms[id.0 as usize].1
    }
    pub(super) fn atom_as_sum(&mut self, atom: Atom) -> SumId {
        let id = self.atom_id(atom);
        self.product_of(vec![(id, Ratio::ONE)], Coefficient::ONE)
    }

    /// The product of factors that is canonical already.
    pub(super) fn monomial(&mut self, factors: Vec<Factor>) -> MonomialId {
        if let Some(&id) = self.monomial_ids.get(factors.as_slice()) {
            return id;
        }
        let id = MonomialId(self.monomials.len() as u32);
        let factors: Rc<[Factor]> = factors.into();
        self.monomials.push(factors.clone());
        self.monomial_ids.insert(factors, id);
        id
    }
    pub(super) fn factors(&self, id: MonomialId) -> Rc<[Factor]> {
        self.monomials[id.0 as usize].clone()
    }
    /// A single term, canonical already.
    pub(super) fn product_of(&mut self, factors: Vec<Factor>, coefficient: Coefficient) -> SumId {
        let monomial = self.monomial(factors);
        self.sum(vec![(monomial, coefficient)])
    }

    /// The sum of terms in any order; an undefined one makes the whole undefined.
    pub(super) fn sum(&mut self, mut terms: Vec<Term>) -> SumId {
        terms.sort_by_key(|term| term.0);
        terms.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.plus(next.1);
            }
            same
        });
        self.sorted_sum(terms)
    }
    /// Whether so many more terms may be written.
    pub(super) fn spend(&mut self, terms: usize) -> bool {
        self.spent = self.spent.saturating_add(terms);
        !self.is_exhausted()
    }
    pub(crate) fn is_exhausted(&self) -> bool {
        self.spent > BUDGET
    }
    /// The sum of terms that are sorted and distinct.
    pub(super) fn sorted_sum(&mut self, mut terms: Vec<Term>) -> SumId {
        if !self.spend(terms.len()) || terms.iter().any(|term| !term.1.value().is_finite()) {
            terms = vec![(MonomialId::UNIT, Coefficient::UNDEFINED)];
        }
        terms.retain(|term| !term.1.is_zero());
        if let Some(&id) = self.sum_ids.get(terms.as_slice()) {
            return id;
        }
        let id = SumId(self.sums.len() as u32);
        let terms: Rc<[Term]> = terms.into();
        self.sums.push(terms.clone());
        self.sum_ids.insert(terms, id);
        id
    }
    pub(super) fn terms(&self, id: SumId) -> Rc<[Term]> {
        self.sums[id.0 as usize].clone()
    }
    pub(crate) fn constant(&mut self, coefficient: Coefficient) -> SumId {
        self.sum(vec![(MonomialId::UNIT, coefficient)])
    }
    /// The number it is, when no atom is in it.
    pub(super) fn as_constant(&self, id: SumId) -> Option<Coefficient> {
        match *self.sums[id.0 as usize] {
            [] => Some(Coefficient::ZERO),
            [(MonomialId::UNIT, coefficient)] => Some(coefficient),
            _ => None,
        }
    }
    pub(super) fn is_undefined(&self, id: SumId) -> bool {
        self.as_constant(id).is_some_and(|c| c.value().is_nan())
    }

    /// The value at the witness.
    pub(crate) fn value(&self, id: SumId) -> f64 {
        self.sums[id.0 as usize].iter().map(|&(m, c)| c.value() * self.monomial_value(m)).sum()
    }
    fn monomial_value(&self, id: MonomialId) -> f64 {
        self.monomials[id.0 as usize].iter().map(|&(atom, e)| raised(self.atom_value(atom), e)).product()
    }
}

/// A rational power of a value.
pub(super) fn raised(base: f64, exponent: Ratio) -> f64 {
    match exponent.parts() {
        (1, 1) => base,
        (n, 1) => real::powi(base, n as i32),
        (1, 2) => base.sqrt(),
        (n, d) => real::powf(base, n as f64 / d as f64),
    }
}
