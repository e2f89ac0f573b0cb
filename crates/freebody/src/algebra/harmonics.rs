//! What turns with an angle: the factors of its cosine and its sine in a Fourier sum.

use super::arena::{Arena, SumId};
use super::atom::{with_exponent, Atom};
use super::coefficient::Coefficient;
use super::ratio::Ratio;
use super::trig::Trig;

impl Arena {
    /// The angles of all sines and cosines that are factors of its terms, each once, in the order met.
    pub(crate) fn angles(&self, of: SumId) -> Vec<SumId> {
        let mut angles = vec![];
        for &(monomial, _) in self.terms(of).iter() {
            for factor in self.factors(monomial).iter().filter(|f| f.1 == Ratio::ONE) {
                if let Atom::Cos(angle) | Atom::Sin(angle) = *self.atom(factor.0) {
                    if !angles.contains(&angle) {
                        angles.push(angle);
                    }
                }
            }
        }
        angles
    }

    /// The factors of the cosine and of the sine of an angle.
    pub(crate) fn harmonic(&mut self, of: SumId, angle: SumId) -> [SumId; 2] {
        let mut parts = [vec![], vec![]];
        for &(monomial, coefficient) in self.terms(of).iter() {
            let factors = self.factors(monomial);
            let found = factors.iter().position(|f| f.1 == Ratio::ONE && self.as_trig(f).is_some_and(|t| t.1 == angle));
            let Some(at) = found else { continue };
            let kind = self.as_trig(&factors[at]).map_or(Trig::Cos, |t| t.0);
            let rest = self.product_of(with_exponent(&factors, at, Ratio::ZERO), Coefficient::ONE);
            let rest = self.scale(rest, coefficient);
            parts[usize::from(kind == Trig::Sin)].extend(self.terms(rest).iter().copied());
        }
        parts.map(|terms| self.sum(terms))
    }
}
