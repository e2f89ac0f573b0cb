//! Sines and cosines, kept as a Fourier sum: at most one to a term.

use super::arena::{Arena, SumId, Term};
use super::atom::{with_exponent, Atom, Factor, Function};
use super::coefficient::Coefficient;
use super::ratio::Ratio;

/// The two functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trig {
    Cos,
    Sin,
}
use Trig::{Cos, Sin};

impl Arena {
    pub(crate) fn sin(&mut self, angle: SumId) -> SumId {
        self.trig(Sin, angle)
    }
    pub(crate) fn cos(&mut self, angle: SumId) -> SumId {
        self.trig(Cos, angle)
    }

    /// The function of an angle of any form.
    fn trig(&mut self, kind: Trig, angle: SumId) -> SumId {
        if self.is_undefined(angle) {
            return angle;
        }
        if let Some(sum) = self.trig_of_direction(kind, angle) {
            return sum;
        }
        if self.points_backwards(angle) {
            let forwards = self.negate(angle);
            let result = self.trig(kind, forwards);
            return if kind == Sin { self.negate(result) } else { result };
        }
        let (rest, quarters, part) = self.split_turn(angle);
        let (kind, negative) = shifted(kind, quarters);
        let result = self.trig_near(kind, rest, part);
        if negative {
            self.negate(result)
        } else {
            result
        }
    }

    /// The function of `rest + part π` with |part| ≤ 1/4, where multiples of π/12 are known.
    fn trig_near(&mut self, kind: Trig, rest: SumId, part: Ratio) -> SumId {
        if let Some([c, s]) = self.known_angle(part) {
            if rest == SumId::ZERO {
                return if kind == Cos { c } else { s };
            }
            if !part.is_zero() {
                return self.turned(kind, rest, [c, s]);
            }
        }
        let pi = self.pi(part);
        let angle = self.add(rest, pi);
        if rest == SumId::ZERO && part.signum() < 0 {
            let result = self.trig_near(kind, rest, part.negated());
            return if kind == Sin { self.negate(result) } else { result };
        }
        self.atom_as_sum(match kind {
            Cos => Atom::Cos(angle),
            Sin => Atom::Sin(angle),
        })
    }

    /// The function of `angle` + α, from the cosine and the sine of α.
    fn turned(&mut self, kind: Trig, angle: SumId, [c, s]: [SumId; 2]) -> SumId {
        let (cos, sin) = (self.cos(angle), self.sin(angle));
        let (along, across) = if kind == Cos { (cos, sin) } else { (sin, cos) };
        let (along, across) = (self.multiply(along, c), self.multiply(across, s));
        match kind {
            Cos => self.subtract(along, across),
            Sin => self.add(along, across),
        }
    }

    /// `part` times π.
    pub(super) fn pi(&mut self, part: Ratio) -> SumId {
        let pi = self.atom_as_sum(Atom::Pi);
        self.scale(pi, Coefficient::Exact(part))
    }

    /// Cosine and sine of `part` π, |part| ≤ 1/4, for multiples of π/12.
    fn known_angle(&mut self, part: Ratio) -> Option<[SumId; 2]> {
        let twelfths = part.times(Ratio::whole(12))?;
        if !twelfths.is_whole() {
            return None;
        }
        let surd = |arena: &mut Self, of: i64, by: (i128, i128)| {
            let of = arena.constant(Coefficient::whole(of));
            let root = arena.power(of, Ratio::HALF);
            arena.scale(root, Coefficient::Exact(Ratio::new(by.0, by.1).expect("small")))
        };
        let (c, s) = match twelfths.parts().0.abs() {
            0 => (SumId::ONE, SumId::ZERO),
            1 => {
                let (six, two) = (surd(self, 6, (1, 4)), surd(self, 2, (1, 4)));
                (self.add(six, two), self.subtract(six, two))
            }
            2 => (surd(self, 3, (1, 2)), surd(self, 1, (1, 2))),
            _ => (surd(self, 2, (1, 2)), surd(self, 2, (1, 2))),
        };
        Some([c, if part.signum() < 0 { self.negate(s) } else { s }])
    }

    /// Whether its first term that varies (else the angle itself) is negative.
    fn points_backwards(&self, angle: SumId) -> bool {
        self.first_varying(angle).map_or(self.value(angle) < 0.0, |first| first.1.is_negative())
    }
    fn first_varying(&self, angle: SumId) -> Option<Term> {
        let varies = |factors: &[Factor]| factors.iter().any(|f| !matches!(self.atom(f.0), Atom::Pi | Atom::Prime(_)));
        self.terms(angle).iter().copied().find(|term| varies(&self.factors(term.0)))
    }

    /// The angle without its multiple of π, and that multiple as quarter turns and a rest in (−1/4, 1/4].
    fn split_turn(&mut self, angle: SumId) -> (SumId, i64, Ratio) {
        let pi = self.atom_id(Atom::Pi);
        let pi = self.monomial(vec![(pi, Ratio::ONE)]);
        let terms = self.terms(angle);
        let Some(part) = terms.iter().find(|term| term.0 == pi).and_then(|term| term.1.exact()) else {
            return (angle, 0, Ratio::ZERO);
        };
        let rest = self.sorted_sum(terms.iter().copied().filter(|term| term.0 != pi).collect());
        let quarter = Ratio::new(1, 4).expect("small");
        let doubled = part.plus(quarter.negated()).and_then(|x| x.times(Ratio::whole(2)));
        let quarters = doubled.map_or(0, |x| -x.negated().floor());
        let left = part.plus(Ratio::new(-i128::from(quarters), 2).expect("small")).unwrap_or(part);
        (rest, quarters, left)
    }

    /// cos(A + atan2(y, x)) by angle addition, with x/r and y/r.
    fn trig_of_direction(&mut self, kind: Trig, angle: SumId) -> Option<SumId> {
        for &(monomial, coefficient) in self.terms(angle).iter() {
            let [(id, Ratio::ONE)] = *self.factors(monomial) else { continue };
            let Atom::Call(Function::Atan2, of) = self.atom(id).clone() else { continue };
            let Some(times) = coefficient.exact().filter(|c| c.is_whole() && c.parts().0.abs() <= 4) else { continue };
            let sign = Coefficient::whole(times.signum());
            let one = self.product_of(vec![(id, Ratio::ONE)], sign);
            let rest = self.subtract(angle, one);
            let [y, x] = [of[0], of[1]];
            let (y2, x2) = (self.multiply(y, y), self.multiply(x, x));
            let square = self.add(y2, x2);
            let inverse = self.power(square, Ratio::HALF.negated());
            let c = self.multiply(x, inverse);
            let s = self.multiply(y, inverse);
            let s = self.scale(s, sign);
            return Some(self.turned(kind, rest, [c, s]));
        }
        None
    }

    pub(super) fn as_trig(&self, factor: &Factor) -> Option<(Trig, SumId)> {
        match *self.atom(factor.0) {
            Atom::Cos(of) => Some((Cos, of)),
            Atom::Sin(of) => Some((Sin, of)),
            _ => None,
        }
    }

    /// The product of two functions becomes a sum of functions of sum and difference.
    pub(super) fn trig_product(&mut self, factors: &[Factor]) -> Option<SumId> {
        let positive = |factor: &Factor| factor.1.is_whole() && factor.1.signum() > 0;
        let mut found = (0..factors.len()).filter(|&i| positive(&factors[i]) && self.as_trig(&factors[i]).is_some());
        let first = found.next()?;
        let second = match factors[first].1 {
            Ratio::ONE => found.next()?,
            _ => first,
        };
        let mut rest = factors.to_vec();
        for at in [first, second] {
            rest[at].1 = rest[at].1.plus(Ratio::whole(-1))?;
        }
        rest.retain(|factor| !factor.1.is_zero());
        let (a, b) = (self.as_trig(&factors[first])?, self.as_trig(&factors[second])?);
        let pair = self.trig_pair(a, b);
        let rest = self.product(&rest);
        Some(self.multiply(rest, pair))
    }

    fn trig_pair(&mut self, a: (Trig, SumId), b: (Trig, SumId)) -> SumId {
        let (sum, difference) = (self.add(a.1, b.1), self.subtract(a.1, b.1));
        let pair = match (a.0, b.0) {
            (Cos, Cos) => {
                let (c, d) = (self.cos(difference), self.cos(sum));
                self.add(c, d)
            }
            (Sin, Sin) => {
                let (c, d) = (self.cos(difference), self.cos(sum));
                self.subtract(c, d)
            }
            (Sin, Cos) => {
                let (s, d) = (self.sin(sum), self.sin(difference));
                self.add(s, d)
            }
            (Cos, Sin) => {
                let (s, d) = (self.sin(sum), self.sin(difference));
                self.subtract(s, d)
            }
        };
        self.scale(pair, Coefficient::Exact(Ratio::HALF))
    }

    /// Over cos A or sin A, an angle B of the numerator is brought within A: cos 2A/cos A is
    /// 2 cos A − 1/cos A, so that exact quotients come out whole and equal ones meet.
    pub(super) fn trig_quotient(&mut self, factors: &[Factor]) -> Option<SumId> {
        let at = factors.iter().position(|f| f.1.signum() < 0 && self.atom(f.0).is_trig())?;
        let top = factors.iter().position(|f| f.1 == Ratio::ONE && self.atom(f.0).is_trig())?;
        let ((below, a), (above, b)) = (self.as_trig(&factors[at])?, self.as_trig(&factors[top])?);
        let (b, sign, step) = self.step_towards(above, b, a)?;
        let by = |arena: &mut Self, n: i64| {
            let shift = arena.scale(a, Coefficient::whole(n * step));
            arena.subtract(b, shift)
        };
        let (near, far) = (by(self, 1), by(self, 2));
        let (near_kind, near_by, far_by) = match (above, below) {
            (kind, Cos) => (kind, 2, -1),
            (Cos, Sin) => (Sin, -2 * step, 1),
            (Sin, Sin) => (Cos, 2 * step, 1),
        };
        let (near, far) = (self.trig(near_kind, near), self.trig(above, far));
        let mut left = factors.to_vec();
        left[at].1 = left[at].1.plus(Ratio::ONE)?;
        left[top].1 = Ratio::ZERO;
        left.retain(|factor| !factor.1.is_zero());
        let (lifted, kept) = (self.product(&left), self.product(&with_exponent(factors, top, Ratio::ZERO)));
        let (near, far) = (self.multiply(lifted, near), self.multiply(kept, far));
        let (near, far) =
            (self.scale(near, Coefficient::whole(near_by * sign)), self.scale(far, Coefficient::whole(far_by * sign)));
        Some(self.add(near, far))
    }

    /// B turned so that what is not along A is forward, the sign that this costs, and the sign of
    /// the step by 2A; `None` when B is within (−A, A] already.
    fn step_towards(&mut self, kind: Trig, b: SumId, a: SumId) -> Option<(SumId, i64, i64)> {
        let lead = self.first_varying(a)?;
        let over = self.terms(b).iter().find(|term| term.0 == lead.0).map(|term| term.1)?;
        let ratio = over.exact()?.over(lead.1.exact()?)?;
        let along = self.scale(a, Coefficient::Exact(ratio));
        let rest = self.subtract(b, along);
        let backwards = if rest == SumId::ZERO { ratio.signum() < 0 } else { self.points_backwards(rest) };
        let (b, sign, ratio) = match (backwards, kind) {
            (false, _) => (b, 1, ratio),
            (true, Cos) => (self.negate(b), 1, ratio.negated()),
            (true, Sin) => (self.negate(b), -1, ratio.negated()),
        };
        if ratio > Ratio::ONE {
            Some((b, sign, 1))
        } else if ratio <= Ratio::whole(-1) {
            Some((b, sign, -1))
        } else {
            None
        }
    }
}

/// The function that `quarters` quarter turns make of it, and whether it is negative.
fn shifted(kind: Trig, quarters: i64) -> (Trig, bool) {
    match (kind, quarters.rem_euclid(4)) {
        (kind, 0) => (kind, false),
        (kind, 2) => (kind, true),
        (Cos, 1) => (Sin, true),
        (Cos, _) => (Sin, false),
        (Sin, 1) => (Cos, false),
        (Sin, _) => (Cos, true),
    }
}
