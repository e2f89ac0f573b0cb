//! Rational powers, and with them quotients: what is common to all terms is pulled out, so that
//! equal denominators meet.

use super::arena::{raised, Arena, Lead, MonomialId, SumId, Term};
use super::atom::{inverted, Atom, AtomId, Factor};
use super::coefficient::Coefficient;
use super::ratio::Ratio;

/// Above this number of terms no root is looked for.
const ROOT_TERMS: usize = 40;
/// A rounded leading coefficient as close to 1 as this is left alone.
const NEARLY_ONE: f64 = 1.0e-14;
/// Primes up to here are looked for under a root.
const LARGEST_DIVISOR: i64 = 50_000;

impl Arena {
    pub(crate) fn divide(&mut self, a: SumId, b: SumId) -> SumId {
        if a == b && a != SumId::ZERO && !self.is_undefined(a) {
            return SumId::ONE;
        }
        let inverse = self.power(b, Ratio::whole(-1));
        self.multiply(a, inverse)
    }
    pub(crate) fn sqrt(&mut self, a: SumId) -> SumId {
        self.power(a, Ratio::HALF)
    }
    /// A rational power; undefined for 0 to one that is not positive, save 0⁰ = 1.
    pub(crate) fn power(&mut self, a: SumId, r: Ratio) -> SumId {
        if r.is_zero() {
            return SumId::ONE;
        }
        let terms = self.terms(a);
        if r.is_whole() && r.signum() > 0 && terms.len() != 1 {
            return self.repeat(a, r.parts().0);
        }
        match *terms {
            [] if r.signum() < 0 => self.constant(Coefficient::UNDEFINED),
            [] => SumId::ZERO,
            [(monomial, coefficient)] => self.power_of_term(&self.factors(monomial), coefficient, r),
            _ => self.power_of_sum(a, r),
        }
    }

    fn power_of_sum(&mut self, a: SumId, r: Ratio) -> SumId {
        let (contents, primitive) = self.primitive(a);
        let mut result = match self.terms(primitive).len() {
            1 => self.power(primitive, r),
            _ => self.power_of_primitive(primitive, r),
        };
        for (factors, number) in contents {
            let power = self.power_of_term(&factors, number, r);
            result = self.multiply(result, power);
        }
        result
    }
    fn power_of_primitive(&mut self, a: SumId, r: Ratio) -> SumId {
        if let Some(root) = self.half_angle(a) {
            return self.power_of_square(root, r);
        }
        if !r.is_whole() && r.parts().1 % 2 == 0 {
            if let Some(root) = self.root(a) {
                return self.power_of_square(root, r);
            }
        }
        let whole = r.floor().max(0);
        let pulled = self.repeat(a, whole);
        let group = self.atom_id(Atom::Group(a));
        match r.plus(Ratio::whole(-whole)) {
            Some(left) => {
                let power = self.product(&[(group, left)]);
                self.multiply(pulled, power)
            }
            None => self.constant(Coefficient::UNDEFINED),
        }
    }

    /// The power r of the square of `root`, by the sign that the root has at the witness; of its absolute value if it moves.
    fn power_of_square(&mut self, root: SumId, r: Ratio) -> SumId {
        let Some(twice) = r.times(Ratio::whole(2)) else { return self.constant(Coefficient::UNDEFINED) };
        let root = if self.value(root) < 0.0 && !r.is_whole() { self.negate(root) } else { root };
        let moves = self.variables(root).iter().any(|&atom| self.is_rate(atom));
        if moves && !twice.is_even() {
            let abs = self.abs_atom(root);
            return self.product(&[(abs, twice)]);
        }
        self.power(root, twice)
    }

    /// Whether it is a rate: its sign changes as a mechanism moves, where that of a place tells the assembly.
    fn is_rate(&self, atom: AtomId) -> bool {
        self.variable(atom).is_some_and(|variable| variable.dots > 0)
    }

    /// The power of a single term: of each factor that is positive at the witness or has an even
    /// exponent; of the rest together.
    fn power_of_term(&mut self, factors: &[Factor], coefficient: Coefficient, r: Ratio) -> SumId {
        let mut result = match r.is_whole() || !coefficient.is_negative() {
            true => self.power_of_number(coefficient, r),
            false => self.power_of_number(coefficient.negated(), r),
        };
        let odd_sign = !r.is_whole() && coefficient.is_negative();
        let mut rest: Vec<Factor> = Vec::new();
        for &(atom, e) in factors {
            let (value, Some(raised)) = (self.atom_value(atom), e.times(r)) else { continue };
            let power = match self.atom(atom) {
                _ if self.is_rate(atom) && !r.is_whole() && e.is_even() && !raised.is_even() => {
                    self.power_of_abs(atom, raised)
                }
                _ if value > 0.0 || r.is_whole() => self.product(&[(atom, raised)]),
                _ if e.is_even() && raised.is_whole() && value < 0.0 => {
                    let power = self.product(&[(atom, raised)]);
                    if raised.is_even() {
                        power
                    } else {
                        self.negate(power)
                    }
                }
                Atom::Group(_) | Atom::Prime(_) => self.product(&[(atom, raised)]),
                _ if e.is_even() => self.power_of_abs(atom, raised),
                _ => {
                    rest.push((atom, e));
                    continue;
                }
            };
            result = self.multiply(result, power);
        }
        if odd_sign || !rest.is_empty() {
            let sign = Coefficient::whole(if odd_sign { -1 } else { 1 });
            let left = self.product_of(rest, sign);
            let group = self.atom_id(Atom::Group(left));
            let power = self.product(&[(group, r)]);
            result = self.multiply(result, power);
        }
        result
    }

    fn power_of_abs(&mut self, atom: AtomId, exponent: Ratio) -> SumId {
        let inner = self.product_of(vec![(atom, Ratio::ONE)], Coefficient::ONE);
        let abs = self.abs_atom(inner);
        self.product(&[(abs, exponent)])
    }

    /// A power of a number, not negative unless r is whole, as a fraction times roots of primes.
    fn power_of_number(&mut self, number: Coefficient, r: Ratio) -> SumId {
        let float = |arena: &mut Self| arena.constant(Coefficient::Float(raised(number.value(), r)));
        let Some(exact) = number.exact() else { return float(self) };
        if r.is_whole() {
            return match exact.power(r.parts().0) {
                Some(power) => self.constant(Coefficient::Exact(power)),
                None => float(self),
            };
        }
        let (n, d) = exact.parts();
        let (Some(above), Some(below)) = (primes(n), primes(d)) else { return float(self) };
        let mut result = SumId::ONE;
        let powers = above.into_iter().chain(below.into_iter().map(|(p, k)| (p, -k)));
        for (prime, k) in powers {
            let Some(e) = r.times(Ratio::whole(k)) else { return float(self) };
            let atom = self.atom_id(Atom::Prime(prime));
            let power = self.product(&[(atom, e)]);
            result = self.multiply(result, power);
        }
        result
    }

    /// Contents and primitive part: the sum is their product, each content a single term, the
    /// primitive part has whole coefficients without common factor and is positive at the witness.
    fn primitive(&mut self, a: SumId) -> (Vec<(Vec<Factor>, Coefficient)>, SumId) {
        let (mut contents, mut left) = (Vec::new(), a);
        // Pulling out a denominator can bring forth a common factor; twice is rare.
        for _ in 0..4 {
            let (factors, number) = self.content(left);
            if factors.is_empty() && number.is_one() {
                break;
            }
            left = self.multiply_factors(left, &inverted(&factors));
            left = self.scale(left, Coefficient::ONE.over(number));
            contents.push((factors, number));
        }
        (contents, left)
    }
    pub(super) fn content(&self, a: SumId) -> (Vec<Factor>, Coefficient) {
        let terms = self.terms(a);
        let mut common: Vec<Factor> = self.factors(terms[0].0).to_vec();
        for &(monomial, _) in &terms[..] {
            let factors = self.factors(monomial);
            let exponent = |id| factors.iter().find(|f| f.0 == id).map_or(Ratio::ZERO, |f| f.1);
            for &(id, e) in factors.iter() {
                if e.signum() < 0 && !common.iter().any(|f| f.0 == id) {
                    common.push((id, Ratio::ZERO));
                }
            }
            common.iter_mut().for_each(|f| f.1 = f.1.min(exponent(f.0)));
        }
        common.retain(|f| !f.1.is_zero() && !matches!(self.atom(f.0), Atom::Prime(_)));
        common.sort();
        let sign = if self.value(a) < 0.0 { -1 } else { 1 };
        (common, common_number(&terms).times(Coefficient::whole(sign)))
    }

    /// 1 ± cos 2A is twice a square.
    fn half_angle(&mut self, a: SumId) -> Option<SumId> {
        let terms = self.terms(a);
        let &[(MonomialId::UNIT, one), (cosine, by)] = &terms[..] else { return None };
        let &[(id, Ratio::ONE)] = &self.factors(cosine)[..] else { return None };
        let &Atom::Cos(angle) = self.atom(id) else { return None };
        let even = |term: &Term| term.1.exact().is_some_and(Ratio::is_even);
        if !one.is_one() || by.abs() != Coefficient::ONE || !self.terms(angle).iter().all(even) {
            return None;
        }
        let half = self.scale(angle, Coefficient::Exact(Ratio::HALF));
        let root = if by.is_one() { self.cos(half) } else { self.sin(half) };
        let two = self.constant(Coefficient::whole(2));
        let two = self.sqrt(two);
        Some(self.multiply(root, two))
    }

    /// The sum of which it is the square, found term by term from the leading one.
    fn root(&mut self, a: SumId) -> Option<SumId> {
        if self.terms(a).len() > ROOT_TERMS {
            return None;
        }
        let mut root = self.leading_root(a)?;
        let lead = self.terms(root)[0];
        let lead = self.sum(vec![lead]);
        let double = self.scale(lead, Coefficient::whole(2));
        for _ in 0..8 {
            let square = self.multiply(root, root);
            let left = self.subtract(a, square);
            if left == SumId::ZERO {
                return Some(root);
            }
            let next = self.leading_term(left)?;
            let next = self.divide(next, double);
            root = self.add(root, next);
        }
        None
    }
    fn leading_root(&mut self, a: SumId) -> Option<SumId> {
        let lead = self.leading_term(a)?;
        let (monomial, coefficient) = self.terms(lead)[0];
        let factors: Vec<Factor> = self.factors(monomial).to_vec();
        let square = coefficient.exact().filter(|c| c.signum() > 0)?;
        let number = self.power_of_number(Coefficient::Exact(square), Ratio::HALF);
        if !factors.iter().all(|f| f.1.is_even()) || self.as_constant(number).is_none() {
            return None;
        }
        let halves = factors.iter().map(|f| f.1.times(Ratio::HALF).map(|e| (f.0, e))).collect::<Option<_>>()?;
        let root = self.product_of(halves, Coefficient::ONE);
        Some(self.multiply(root, number))
    }
    fn leading_term(&mut self, a: SumId) -> Option<SumId> {
        let terms = self.terms(a);
        if terms.iter().any(|term| !self.is_polynomial(term.0)) {
            return None;
        }
        let lead = *terms.iter().max_by(|x, y| self.lexical(x.0, y.0))?;
        Some(self.sum(vec![lead]))
    }

    /// How to divide by a group; `None` for one whose leading product is not safe to replace.
    pub(super) fn lead(&mut self, group: SumId) -> Option<Lead> {
        if let Some(known) = self.leads.get(&group) {
            return *known;
        }
        let found = self.find_lead(group);
        self.leads.insert(group, found);
        found
    }
    fn find_lead(&mut self, group: SumId) -> Option<Lead> {
        let terms = self.terms(group);
        if terms.iter().any(|term| !self.is_polynomial(term.0)) {
            return None;
        }
        let lead = *terms.iter().max_by(|x, y| self.lexical(x.0, y.0))?;
        let alone = terms.iter().filter(|term| self.lexical(term.0, lead.0).is_eq()).count() == 1;
        let plain = self.factors(lead.0).iter().all(|f| matches!(self.atom(f.0), Atom::Variable(_)));
        if !alone || !plain || lead.0 == MonomialId::UNIT {
            return None;
        }
        let tail = self.sorted_sum(terms.iter().copied().filter(|term| term.0 != lead.0).collect());
        Some((lead.0, lead.1, tail))
    }
    /// Variables and trigonometric functions with whole positive exponents.
    fn is_polynomial(&self, monomial: MonomialId) -> bool {
        let plain = |id| matches!(self.atom(id), Atom::Variable(_) | Atom::Pi | Atom::Cos(_) | Atom::Sin(_));
        self.factors(monomial).iter().all(|f| f.1.is_whole() && f.1.signum() > 0 && plain(f.0))
    }
    /// Lexical order of the variables in two products: the first variable that differs decides.
    fn lexical(&self, a: MonomialId, b: MonomialId) -> std::cmp::Ordering {
        let variables = |m| {
            let factors = self.factors(m).to_vec();
            factors.into_iter().filter(|f| matches!(self.atom(f.0), Atom::Variable(_))).collect::<Vec<_>>()
        };
        let (a, b) = (variables(a), variables(b));
        for (x, y) in a.iter().zip(&b) {
            if x != y {
                return y.0.cmp(&x.0).then(x.1.cmp(&y.1));
            }
        }
        a.len().cmp(&b.len())
    }
}

/// The greatest common factor of the coefficients; 1 when one is not exact.
fn common_number(terms: &[Term]) -> Coefficient {
    let exact: Option<Vec<Ratio>> = terms.iter().map(|term| term.1.exact()).collect();
    let common = exact.and_then(|all| all.into_iter().map(Ratio::abs).try_fold(Ratio::ZERO, Ratio::common));
    match common {
        Some(common) if !common.is_zero() => Coefficient::Exact(common),
        _ if (terms[0].1.value().abs() - 1.0).abs() < NEARLY_ONE => Coefficient::ONE,
        _ => terms[0].1.abs(),
    }
}

/// The primes of a positive number; `None` when one is too large to be found.
fn primes(mut n: i64) -> Option<Vec<(i64, i64)>> {
    let mut found = Vec::new();
    let mut p = 2;
    while p * p <= n && p <= LARGEST_DIVISOR {
        let mut k = 0;
        while n % p == 0 {
            n /= p;
            k += 1;
        }
        if k > 0 {
            found.push((p, k));
        }
        p += if p == 2 { 1 } else { 2 };
    }
    if n >= LARGEST_DIVISOR * LARGEST_DIVISOR {
        return None;
    }
    if n > 1 {
        found.push((n, 1));
    }
    Some(found)
}
