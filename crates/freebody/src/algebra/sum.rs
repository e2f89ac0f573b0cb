//! Adding and multiplying, and the rules that make a product canonical.

use super::arena::{Arena, MonomialId, SumId, Term};
use super::atom::{inverted, joined, with_exponent, Atom, Factor, Function};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use crate::scalar::real;

impl Arena {
    pub(crate) fn add(&mut self, a: SumId, b: SumId) -> SumId {
        match (a, b) {
            (SumId::ZERO, other) | (other, SumId::ZERO) => return other,
            _ => {}
        }
        let (left, right) = (self.terms(a), self.terms(b));
        let mut all: Vec<Term> = Vec::with_capacity(left.len() + right.len());
        let (mut i, mut j) = (0, 0);
        while i < left.len() && j < right.len() {
            match left[i].0.cmp(&right[j].0) {
                std::cmp::Ordering::Less => (all.push(left[i]), i += 1),
                std::cmp::Ordering::Greater => (all.push(right[j]), j += 1),
                std::cmp::Ordering::Equal => {
                    all.push((left[i].0, left[i].1.plus(right[j].1)));
                    i += 1;
                    ((), j += 1)
                }
            };
        }
        all.extend(&left[i..]);
        all.extend(&right[j..]);
        self.sorted_sum(all)
    }
    pub(crate) fn subtract(&mut self, a: SumId, b: SumId) -> SumId {
        let minus = self.negate(b);
        self.add(a, minus)
    }
    pub(crate) fn negate(&mut self, a: SumId) -> SumId {
        self.scale(a, Coefficient::whole(-1))
    }
    pub(super) fn scale(&mut self, a: SumId, by: Coefficient) -> SumId {
        if by.is_one() {
            return a;
        }
        if !by.value().is_finite() {
            return self.constant(Coefficient::UNDEFINED);
        }
        let scaled = self.terms(a).iter().map(|&(m, c)| (m, c.times(by))).collect();
        self.sorted_sum(scaled)
    }
    pub(crate) fn multiply(&mut self, a: SumId, b: SumId) -> SumId {
        if a == SumId::ONE || (b == SumId::ZERO && !self.is_undefined(a)) {
            return b;
        }
        if b == SumId::ONE || (a == SumId::ZERO && !self.is_undefined(b)) {
            return a;
        }
        if let Some(number) = self.as_constant(a) {
            return self.scale(b, number);
        }
        if let Some(number) = self.as_constant(b) {
            return self.scale(a, number);
        }
        let (left, right) = (self.terms(a), self.terms(b));
        if !self.spend(left.len() * right.len()) {
            return self.constant(Coefficient::UNDEFINED);
        }
        let mut all = Vec::with_capacity(left.len() * right.len());
        for &(m, c) in left.iter() {
            for &(n, d) in right.iter() {
                let product = self.multiply_monomials(m, n);
                let by = c.times(d);
                all.extend(self.terms(product).iter().map(|&(p, e)| (p, e.times(by))));
            }
        }
        self.sum(all)
    }
    /// The product with factors, exponents added before anything is multiplied out.
    pub(super) fn multiply_factors(&mut self, a: SumId, by: &[Factor]) -> SumId {
        let mut all = Vec::new();
        for &(monomial, c) in self.terms(a).iter() {
            let Some(factors) = joined(&self.factors(monomial), by) else {
                return self.constant(Coefficient::UNDEFINED);
            };
            let product = self.product(&factors);
            all.extend(self.terms(product).iter().map(|&(m, d)| (m, c.times(d))));
        }
        self.sum(all)
    }
    /// A whole power, not negative.
    pub(super) fn repeat(&mut self, a: SumId, n: i64) -> SumId {
        (0..n).fold(SumId::ONE, |product, _| self.multiply(product, a))
    }

    fn multiply_monomials(&mut self, m: MonomialId, n: MonomialId) -> SumId {
        let key = (m.min(n), m.max(n));
        if let Some(&known) = self.products.get(&key) {
            return known;
        }
        let product = match joined(&self.factors(m), &self.factors(n)) {
            Some(factors) => self.product(&factors),
            None => self.constant(Coefficient::UNDEFINED),
        };
        self.products.insert(key, product);
        product
    }

    /// The canonical form of a product of distinct factors.
    pub(super) fn product(&mut self, factors: &[Factor]) -> SumId {
        let rewritten = self
            .whole_parts(factors)
            .or_else(|| self.trig_product(factors))
            .or_else(|| self.trig_quotient(factors))
            .or_else(|| self.exponentials(factors))
            .or_else(|| self.group_quotient(factors));
        rewritten.unwrap_or_else(|| self.product_of(factors.to_vec(), Coefficient::ONE))
    }

    /// √2 √2 = 2, (a + b)^(3/2) = (a + b) √(a + b), |x|² = x².
    fn whole_parts(&mut self, factors: &[Factor]) -> Option<SumId> {
        for (at, &(id, e)) in factors.iter().enumerate() {
            let (whole, pulled) = match self.atom(id).clone() {
                Atom::Prime(p) if e.floor() != 0 => {
                    let number = Ratio::whole(p).power(e.floor()).map(Coefficient::Exact);
                    let number = number.unwrap_or(Coefficient::Float(real::powi(p as f64, e.floor() as i32)));
                    (e.floor(), self.constant(number))
                }
                Atom::Group(of) if e >= Ratio::ONE => (e.floor(), self.repeat(of, e.floor())),
                Atom::Call(Function::Abs, of) if e.abs() >= Ratio::whole(2) => {
                    let even = (e.abs().floor() / 2) * 2 * e.signum();
                    (even, self.power(of[0], Ratio::whole(even)))
                }
                _ => continue,
            };
            let rest = self.product(&with_exponent(factors, at, e.plus(Ratio::whole(-whole))?));
            return Some(self.multiply(rest, pulled));
        }
        None
    }

    /// eᵃ eᵇ = eᵃ⁺ᵇ.
    fn exponentials(&mut self, factors: &[Factor]) -> Option<SumId> {
        let exponent = |arena: &Self, factor: &Factor| match arena.atom(factor.0) {
            Atom::Call(Function::Exp, of) => Some(of[0]),
            _ => None,
        };
        let (powers, rest): (Vec<Factor>, Vec<Factor>) =
            factors.iter().partition(|factor| exponent(self, factor).is_some());
        if powers.is_empty() || (powers.len() == 1 && powers[0].1 == Ratio::ONE) {
            return None;
        }
        let mut total = SumId::ZERO;
        for factor in &powers {
            let scaled = self.scale(exponent(self, factor)?, Coefficient::Exact(factor.1));
            total = self.add(total, scaled);
        }
        let (rest, joint) = (self.product(&rest), self.exp(total));
        Some(self.multiply(rest, joint))
    }

    /// a/(a + b) = 1 − b/(a + b): what a group divides is free of the group's leading product, so
    /// that exact quotients come out whole and equal ones meet.
    fn group_quotient(&mut self, factors: &[Factor]) -> Option<SumId> {
        for (at, &(id, e)) in factors.iter().enumerate() {
            let Atom::Group(of) = *self.atom(id) else { continue };
            if e.signum() > 0 {
                continue;
            }
            let Some((lead, coefficient, tail)) = self.lead(of) else { continue };
            let Some(left) = without(factors, &self.factors(lead)) else { continue };
            let at = left.iter().position(|factor| factor.0 == id).unwrap_or(at);
            let whole = self.product(&with_exponent(&left, at, e.plus(Ratio::ONE)?));
            let left = self.product(&left);
            let rest = self.multiply(tail, left);
            let difference = self.subtract(whole, rest);
            return Some(self.scale(difference, Coefficient::ONE.over(coefficient)));
        }
        None
    }
}

/// The factors that are left when `divisor` is taken out, where each is there often enough.
fn without(factors: &[Factor], divisor: &[Factor]) -> Option<Vec<Factor>> {
    let enough =
        |&(id, e): &Factor| factors.iter().any(|&(other, exponent)| other == id && exponent >= e && e.signum() > 0);
    if !divisor.iter().all(enough) {
        return None;
    }
    joined(factors, &inverted(divisor))
}
