//! Exponentials, logarithms, directions and functions given by name.

use super::arena::{Arena, Rule, SumId};
use super::atom::{Atom, AtomId, Function};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use crate::scalar::real;
use std::rc::Rc;

impl Arena {
    pub(crate) fn exp(&mut self, x: SumId) -> SumId {
        if let Some(of) = self.sole_call(x, &Function::Ln) {
            return of[0];
        }
        match x {
            SumId::ZERO => SumId::ONE,
            _ => self.apply(Function::Exp, vec![x]),
        }
    }
    pub(crate) fn ln(&mut self, x: SumId) -> SumId {
        if let Some(of) = self.sole_call(x, &Function::Exp) {
            return of[0];
        }
        match x {
            SumId::ONE => SumId::ZERO,
            SumId::ZERO => self.constant(Coefficient::UNDEFINED),
            _ => self.apply(Function::Ln, vec![x]),
        }
    }
    /// The angle of the point (x, y), of the branch that holds at the witness.
    pub(crate) fn atan2(&mut self, y: SumId, x: SumId) -> SumId {
        let (along, across) = (self.value(x), self.value(y));
        let positive = |v: f64| v > 0.0;
        match (y, x) {
            (SumId::ZERO, SumId::ZERO) => SumId::ZERO,
            (SumId::ZERO, _) if along != 0.0 => self.pi(Ratio::whole(i64::from(!positive(along)))),
            (_, SumId::ZERO) if across != 0.0 => {
                let right = self.pi(Ratio::HALF);
                if positive(across) {
                    right
                } else {
                    self.negate(right)
                }
            }
            _ => self.direction(y, x, real::atan2(across, along)),
        }
    }
    fn direction(&mut self, y: SumId, x: SumId, value: f64) -> SumId {
        let scale = self.power_of_length(y, x);
        let (unit_y, unit_x) = (self.divide(y, scale), self.divide(x, scale));
        if let Some(angle) = self.angle_of(unit_y, unit_x) {
            let turns = ((value - self.value(angle)) / std::f64::consts::TAU).round() as i64;
            let turns = self.pi(Ratio::whole(2 * turns));
            return self.add(angle, turns);
        }
        self.apply(Function::Atan2, vec![unit_y, unit_x])
    }
    /// What is common to both, positive at the witness.
    fn power_of_length(&mut self, y: SumId, x: SumId) -> SumId {
        let y2 = self.multiply(y, y);
        let x2 = self.multiply(x, x);
        let square = self.add(y2, x2);
        let length = self.sqrt(square);
        match &self.terms(length)[..] {
            [_] if !self.holds_group(length) => length,
            _ => SumId::ONE,
        }
    }
    fn holds_group(&self, a: SumId) -> bool {
        let group = |id: AtomId| matches!(self.atom(id), Atom::Group(_) | Atom::Call(..));
        self.terms(a).iter().any(|term| self.factors(term.0).iter().any(|f| group(f.0)))
    }
    /// A, when the two are sin A and cos A.
    fn angle_of(&mut self, y: SumId, x: SumId) -> Option<SumId> {
        let &[(monomial, sign)] = &self.terms(y)[..] else { return None };
        let &[(id, Ratio::ONE)] = &self.factors(monomial)[..] else { return None };
        let (angle, complement) = match *self.atom(id) {
            Atom::Sin(angle) => (angle, false),
            Atom::Cos(angle) => (angle, true),
            _ => return None,
        };
        let signed = |arena: &mut Self, a| if sign.is_negative() { arena.negate(a) } else { a };
        let mut candidates = Vec::new();
        let (plain, right) = (signed(self, angle), self.pi(Ratio::HALF));
        let (straight, right) = (self.pi(Ratio::ONE), signed(self, right));
        if complement {
            candidates.extend([self.add(right, angle), self.subtract(right, angle)]);
        } else {
            candidates.extend([plain, self.subtract(straight, plain)]);
        }
        candidates.into_iter().find(|&a| self.sin(a) == y && self.cos(a) == x)
    }

    /// |x|, by its sign at the witness where it has one.
    pub(crate) fn abs(&mut self, x: SumId) -> SumId {
        let value = self.value(x);
        if value > 0.0 || x == SumId::ZERO {
            return x;
        }
        if value < 0.0 {
            return self.negate(x);
        }
        let atom = self.abs_atom(x);
        self.product(&[(atom, Ratio::ONE)])
    }
    pub(super) fn abs_atom(&mut self, x: SumId) -> AtomId {
        self.atom_id(Atom::Call(Function::Abs, vec![x]))
    }

    /// A function given by its name, its rule remembered.
    pub(crate) fn named(&mut self, name: &str, order: u8, x: SumId, rule: Rule) -> SumId {
        let name: Rc<str> = name.into();
        self.rules.entry(name.clone()).or_insert(rule);
        self.apply(Function::Named(name, order), vec![x])
    }

    pub(super) fn apply(&mut self, function: Function, of: Vec<SumId>) -> SumId {
        match of.iter().copied().find(|&x| self.is_undefined(x)) {
            Some(undefined) => undefined,
            None => self.atom_as_sum(Atom::Call(function, of)),
        }
    }
    fn sole_call(&self, x: SumId, wanted: &Function) -> Option<Vec<SumId>> {
        let &[(monomial, Coefficient::Exact(Ratio::ONE))] = &self.terms(x)[..] else { return None };
        let &[(id, Ratio::ONE)] = &self.factors(monomial)[..] else { return None };
        match self.atom(id) {
            Atom::Call(function, of) if function == wanted => Some(of.clone()),
            _ => None,
        }
    }
}
