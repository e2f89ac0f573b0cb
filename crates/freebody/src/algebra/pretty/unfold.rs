//! From the Fourier form to products of sines and cosines where those are shorter.

use super::super::arena::{Arena, SumId};
use super::super::atom::{Atom, AtomId, Factor};
use super::super::coefficient::Coefficient;
use super::super::ratio::Ratio;
use super::super::trig::Trig;
use super::form::Poly;
use std::collections::BTreeMap;

/// Above this number of trigonometric terms with the same factor no pairs are looked for.
const PAIRS: usize = 60;

/// A term of a Fourier sum: the function with its angle, none for the constant.
type Wave = (Option<(Trig, SumId)>, Coefficient);

impl Arena {
    /// The terms of a sum as they stand.
    pub(super) fn folded(&self, of: SumId) -> Poly {
        let mut poly: Poly = self.terms(of).iter().map(|&(m, c)| (self.factors(m).to_vec(), c)).collect();
        poly.sort_by(|a, b| a.0.cmp(&b.0));
        poly
    }

    /// The terms with squares and products of sines and cosines where those are shorter; `eager`,
    /// every sin 2A becomes a product.
    pub(super) fn unfolded(&mut self, of: SumId, eager: bool) -> Poly {
        let mut by_rest: BTreeMap<Vec<Factor>, Vec<Wave>> = BTreeMap::new();
        for (factors, c) in self.folded(of) {
            let at = factors.iter().position(|f| f.1 == Ratio::ONE && self.as_trig(f).is_some());
            let mut rest = factors.clone();
            let wave = at.and_then(|at| self.as_trig(&rest.remove(at)));
            by_rest.entry(rest).or_default().push((wave, c));
        }
        let mut all: BTreeMap<Vec<Factor>, Coefficient> = BTreeMap::new();
        for (rest, waves) in by_rest {
            for (factors, c) in self.unfolded_waves(waves, eager) {
                let product = super::super::atom::joined(&rest, &factors).unwrap_or_default();
                let sum = all.entry(product).or_insert(Coefficient::ZERO);
                *sum = sum.plus(c);
            }
        }
        all.into_iter().filter(|term| !term.1.is_zero()).collect()
    }

    fn unfolded_waves(&mut self, mut waves: Vec<Wave>, eager: bool) -> Poly {
        let mut out: Poly = Vec::new();
        self.squares(&mut waves, &mut out);
        if waves.len() <= PAIRS {
            self.pairs(&mut waves, &mut out);
        }
        for (wave, c) in waves {
            out.push(match wave {
                None => (vec![], c),
                Some((Trig::Sin, angle)) if eager || c.exact().is_some_and(|c| c.parts().1 % 2 == 0) => {
                    match self.half(angle) {
                        Some(half) => {
                            (self.trig_factors((Trig::Sin, half), (Trig::Cos, half)), c.times(Coefficient::whole(2)))
                        }
                        None => (vec![self.trig_factor(Trig::Sin, angle)], c),
                    }
                }
                Some((kind, angle)) => (vec![self.trig_factor(kind, angle)], c),
            });
        }
        out
    }

    /// ½ − ½ cos 2A = sin² A, and the like.
    fn squares(&mut self, waves: &mut Vec<Wave>, out: &mut Poly) {
        let Some(at) = waves.iter().position(|wave| wave.0.is_none()) else { return };
        for i in (0..waves.len()).rev() {
            let (constant, (wave, c)) = (waves[at].1, waves[i]);
            let Some((Trig::Cos, angle)) = wave else { continue };
            let Some(half) = self.half(angle) else { continue };
            if constant.abs() != c.abs() && !(is_half(constant) && is_half(c)) {
                continue;
            }
            let sign = Coefficient::whole(if c.is_negative() == constant.is_negative() { 1 } else { -1 });
            let (kind, by) = if c.is_negative() == constant.is_negative() { (Trig::Cos, 2) } else { (Trig::Sin, -2) };
            let factor = self.trig_factor(kind, half);
            out.push((vec![(factor.0, Ratio::whole(2))], c.times(Coefficient::whole(by))));
            waves[at].1 = constant.plus(c.times(sign).negated());
            waves[i].1 = Coefficient::ZERO;
            if waves[at].1.is_zero() {
                break;
            }
        }
        waves.retain(|wave| !wave.1.is_zero());
    }

    /// Two waves of equal size that are one product: cos A cos B, sin A sin B or sin A cos B.
    fn pairs(&mut self, waves: &mut Vec<Wave>, out: &mut Poly) {
        let mut i = 0;
        while i < waves.len() {
            let found = (i + 1..waves.len()).find_map(|j| self.paired(waves[i], waves[j]).map(|product| (j, product)));
            match found {
                Some((j, product)) => {
                    waves.remove(j);
                    waves.remove(i);
                    out.push(product);
                }
                None => i += 1,
            }
        }
    }
    fn paired(&mut self, a: Wave, b: Wave) -> Option<(Vec<Factor>, Coefficient)> {
        let ((f, x), (g, y), size) = (a.0?, b.0?, a.1);
        if f != g || size.abs() != b.1.abs() {
            return None;
        }
        let (factors, number) = self.pair(f, x, y, size == b.1)?;
        Some((factors, size.times(Coefficient::whole(number))))
    }
    /// f(x) ± f(y) as a product, with its number.
    fn pair(&mut self, f: Trig, x: SumId, y: SumId, plus: bool) -> Option<(Vec<Factor>, i64)> {
        let (sum, difference) = (self.add(x, y), self.subtract(x, y));
        let (p, q) = (self.half(sum)?, self.half(difference)?);
        if p == SumId::ZERO || q == SumId::ZERO || self.length(p) + self.length(q) > self.length(x) + self.length(y) {
            return None;
        }
        Some(match (f, plus) {
            (Trig::Cos, true) => self.signed_factors((Trig::Cos, p), (Trig::Cos, q), 2),
            (Trig::Cos, false) => self.signed_factors((Trig::Sin, p), (Trig::Sin, q), -2),
            (Trig::Sin, true) => self.signed_factors((Trig::Sin, p), (Trig::Cos, q), 2),
            (Trig::Sin, false) => self.signed_factors((Trig::Cos, p), (Trig::Sin, q), 2),
        })
    }
    /// The two functions as factors; a sine of an angle that stands turned round brings a sign.
    fn signed_factors(&mut self, a: (Trig, SumId), b: (Trig, SumId), number: i64) -> (Vec<Factor>, i64) {
        let mut sign = number;
        let mut forward = |arena: &mut Self, (kind, angle): (Trig, SumId)| {
            let back = arena.terms(angle).first().is_some_and(|term| term.1.is_negative());
            if back && kind == Trig::Sin {
                sign = -sign;
            }
            (kind, if back { arena.negate(angle) } else { angle })
        };
        let (a, b) = (forward(self, a), forward(self, b));
        (self.trig_factors(a, b), sign)
    }

    fn trig_factors(&mut self, a: (Trig, SumId), b: (Trig, SumId)) -> Vec<Factor> {
        let (a, b) = (self.trig_factor(a.0, a.1), self.trig_factor(b.0, b.1));
        super::super::atom::joined(&[a], &[b]).unwrap_or_default()
    }
    fn trig_factor(&mut self, kind: Trig, angle: SumId) -> Factor {
        let atom = match kind {
            Trig::Cos => Atom::Cos(angle),
            Trig::Sin => Atom::Sin(angle),
        };
        let id: AtomId = self.atom_id(atom);
        (id, Ratio::ONE)
    }
    /// Half of an angle that is twice one with whole coefficients.
    fn half(&mut self, angle: SumId) -> Option<SumId> {
        let even = self.terms(angle).iter().all(|term| term.1.exact().is_some_and(Ratio::is_even));
        even.then(|| self.scale(angle, Coefficient::Exact(Ratio::HALF)))
    }
    fn length(&self, angle: SumId) -> usize {
        self.terms(angle).iter().map(|term| 1 + usize::from(term.1.abs() != Coefficient::ONE)).sum()
    }
}

fn is_half(c: Coefficient) -> bool {
    c.exact().is_some_and(|c| c.parts().1 == 2)
}
