//! Derivatives, substitution and the variables of a sum.

use super::arena::{raised, Arena, SumId};
use super::atom::{Atom, AtomId, Function, Variable};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use crate::scalar::real;
use std::collections::{BTreeSet, HashMap};

impl Arena {
    /// Σ over terms and factors of c · e · atom^(e−1) · rest · d(atom).
    pub(crate) fn derivative(&mut self, of: SumId, by: AtomId, known: &mut HashMap<AtomId, SumId>) -> SumId {
        let mut parts = Vec::new();
        for &(monomial, c) in self.terms(of).iter() {
            let factors = self.factors(monomial);
            for (at, &(id, e)) in factors.iter().enumerate() {
                let slope = self.atom_derivative(id, by, known);
                if slope == SumId::ZERO {
                    continue;
                }
                let lower = e.plus(Ratio::whole(-1)).expect("an exponent stays small");
                let rest = self.product(&super::atom::with_exponent(&factors, at, lower));
                let part = self.multiply(rest, slope);
                let part = self.scale(part, c.times(Coefficient::Exact(e)));
                parts.extend(self.terms(part).iter().copied());
            }
        }
        self.sum(parts)
    }
    fn atom_derivative(&mut self, id: AtomId, by: AtomId, known: &mut HashMap<AtomId, SumId>) -> SumId {
        if id == by {
            return SumId::ONE;
        }
        if let Some(&slope) = known.get(&id) {
            return slope;
        }
        let slope = match self.atom(id).clone() {
            Atom::Variable(_) | Atom::Pi | Atom::Prime(_) => SumId::ZERO,
            Atom::Group(of) => self.derivative(of, by, known),
            atom @ (Atom::Cos(of) | Atom::Sin(of)) => {
                let inner = self.derivative(of, by, known);
                let outer = match atom {
                    Atom::Cos(_) => {
                        let sin = self.sin(of);
                        self.negate(sin)
                    }
                    _ => self.cos(of),
                };
                self.multiply(outer, inner)
            }
            Atom::Call(function, of) => {
                let inner: Vec<SumId> = of.iter().map(|&x| self.derivative(x, by, known)).collect();
                self.call_derivative(id, &function, &of, &inner)
            }
        };
        known.insert(id, slope);
        slope
    }
    fn call_derivative(&mut self, id: AtomId, function: &Function, of: &[SumId], inner: &[SumId]) -> SumId {
        if inner.iter().all(|&d| d == SumId::ZERO) {
            return SumId::ZERO;
        }
        let itself = self.product(&[(id, Ratio::ONE)]);
        match function {
            Function::Exp => self.multiply(itself, inner[0]),
            Function::Ln => self.divide(inner[0], of[0]),
            Function::Abs => {
                let sign = self.divide(of[0], itself);
                self.multiply(sign, inner[0])
            }
            Function::Atan2 => {
                let (forward, back) = (self.multiply(of[1], inner[0]), self.multiply(of[0], inner[1]));
                let area = self.subtract(forward, back);
                let (y2, x2) = (self.multiply(of[0], of[0]), self.multiply(of[1], of[1]));
                let square = self.add(y2, x2);
                self.divide(area, square)
            }
            Function::Named(name, order) => {
                let slope = self.apply(Function::Named(name.clone(), order + 1), vec![of[0]]);
                self.multiply(slope, inner[0])
            }
        }
    }

    /// The sum with variables replaced.
    pub(crate) fn substitute(&mut self, of: SumId, new: &mut HashMap<AtomId, SumId>) -> SumId {
        let mut total = SumId::ZERO;
        for &(monomial, c) in self.terms(of).iter() {
            let mut product = self.constant(c);
            for &(id, e) in self.factors(monomial).iter() {
                let atom = self.replaced(id, new);
                let power = self.power(atom, e);
                product = self.multiply(product, power);
            }
            total = self.add(total, product);
        }
        total
    }
    fn replaced(&mut self, id: AtomId, new: &mut HashMap<AtomId, SumId>) -> SumId {
        if let Some(&sum) = new.get(&id) {
            return sum;
        }
        let sum = match self.atom(id).clone() {
            Atom::Variable(_) | Atom::Pi | Atom::Prime(_) => self.product(&[(id, Ratio::ONE)]),
            Atom::Group(of) => self.substitute(of, new),
            Atom::Cos(of) => {
                let angle = self.substitute(of, new);
                self.cos(angle)
            }
            Atom::Sin(of) => {
                let angle = self.substitute(of, new);
                self.sin(angle)
            }
            Atom::Call(function, of) => {
                let of: Vec<SumId> = of.iter().map(|&x| self.substitute(x, new)).collect();
                match function {
                    Function::Exp => self.exp(of[0]),
                    Function::Ln => self.ln(of[0]),
                    Function::Abs => self.abs(of[0]),
                    Function::Atan2 => self.atan2(of[0], of[1]),
                    Function::Named(..) => self.apply(function, of),
                }
            }
        };
        new.insert(id, sum);
        sum
    }

    /// The variables in it, those inside functions included.
    pub(crate) fn variables(&self, of: SumId) -> BTreeSet<AtomId> {
        let (mut variables, mut seen) = (BTreeSet::new(), BTreeSet::new());
        self.collect_variables(of, &mut variables, &mut seen);
        variables
    }
    fn collect_variables(&self, of: SumId, variables: &mut BTreeSet<AtomId>, seen: &mut BTreeSet<SumId>) {
        if !seen.insert(of) {
            return;
        }
        for &(monomial, _) in self.terms(of).iter() {
            for &(id, _) in self.factors(monomial).iter() {
                match self.atom(id) {
                    Atom::Variable(_) => {
                        variables.insert(id);
                    }
                    Atom::Pi | Atom::Prime(_) => {}
                    Atom::Group(of) | Atom::Cos(of) | Atom::Sin(of) => self.collect_variables(*of, variables, seen),
                    Atom::Call(_, of) => of.iter().for_each(|&x| self.collect_variables(x, variables, seen)),
                }
            }
        }
    }
    pub(crate) fn variable(&self, id: AtomId) -> Option<&Variable> {
        match self.atom(id) {
            Atom::Variable(variable) => Some(variable),
            _ => None,
        }
    }

    /// The value for given values of the variables.
    pub(crate) fn evaluate(
        &self,
        of: SumId,
        values: &dyn Fn(&Variable) -> f64,
        known: &mut HashMap<AtomId, f64>,
    ) -> f64 {
        let mut total = 0.0;
        for &(monomial, c) in self.terms(of).iter() {
            let mut product = c.value();
            for &(id, e) in self.factors(monomial).iter() {
                product *= raised(self.evaluate_atom(id, values, known), e);
            }
            total += product;
        }
        total
    }
    fn evaluate_atom(&self, id: AtomId, values: &dyn Fn(&Variable) -> f64, known: &mut HashMap<AtomId, f64>) -> f64 {
        if let Some(&value) = known.get(&id) {
            return value;
        }
        let value = match self.atom(id) {
            Atom::Variable(variable) => values(variable),
            Atom::Pi | Atom::Prime(_) => self.atom_value(id),
            Atom::Group(of) => self.evaluate(*of, values, known),
            Atom::Cos(of) => real::sin_cos(self.evaluate(*of, values, known)).1,
            Atom::Sin(of) => real::sin_cos(self.evaluate(*of, values, known)).0,
            Atom::Call(function, of) => {
                let x: Vec<f64> = of.iter().map(|&x| self.evaluate(x, values, known)).collect();
                self.call(function, &x)
            }
        };
        known.insert(id, value);
        value
    }
}
