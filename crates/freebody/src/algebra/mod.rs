//! Algebra of symbols: sums of products, always in one canonical form. It knows no mechanics.
//!
//! A [`Symbol`] is a handle to a sum of an arena that lives for one [`session`]. Two symbols are
//! the same handle when their canonical forms agree, so what vanishes identically is zero:
//!
//! - products are multiplied out, and powers of sums kept as groups without common factor;
//! - products of sines and cosines become sums (Fourier form), so cos² + sin² is 1;
//! - what stands over a group or a cosine is reduced by it, so equal quotients meet.
//!
//! Branches (√x² = ±x, the quadrant of an angle) are those of the values that the variables have.
//! [`Tree`] is the same expression as a person writes it.

mod arena;
mod atom;
mod calculus;
mod coefficient;
mod functions;
mod harmonics;
mod linear;
mod power;
mod pretty;
mod ratio;
mod sum;
mod symbol;
mod trig;

#[cfg(test)]
mod tests;

pub use arena::Rule;
pub use atom::Variable;
pub use pretty::{Number, Tree};
pub use symbol::Symbol;

pub(crate) use arena::{with, SumId};
pub(crate) use coefficient::Coefficient;
pub(crate) use ratio::Ratio;

/// Runs `work` with an empty arena and empties it after; no symbol may outlive it.
pub fn session<T>(work: impl FnOnce() -> T) -> T {
    struct Emptied;
    impl Drop for Emptied {
        fn drop(&mut self) {
            arena::clear();
        }
    }
    arena::clear();
    let _emptied = Emptied;
    work()
}

/// Whether the session has written more than it may; what was found since is undefined.
pub fn is_exhausted() -> bool {
    with(|arena| arena.is_exhausted())
}

impl arena::Arena {
    /// A constant, as a fraction or a fraction of π where it is one.
    pub(crate) fn number(&mut self, x: f64) -> SumId {
        /// Largest denominator of a fraction that is recognised.
        const DENOMINATOR: i64 = 10_000;
        if let Some(exact) = Ratio::near(x, DENOMINATOR) {
            return self.constant(Coefficient::Exact(exact));
        }
        match part_of_pi(x) {
            Some(part) => self.pi(part),
            None => self.constant(Coefficient::Float(x)),
        }
    }
    /// The variable, with its value where it is new, and the value it has.
    pub(crate) fn variable_sum(&mut self, variable: Variable, value: f64) -> (SumId, f64) {
        let id = self.atom_with(atom::Atom::Variable(variable), |_| value);
        (self.product(&[(id, Ratio::ONE)]), self.atom_value(id))
    }
    pub(crate) fn variable_id(&mut self, variable: &Variable) -> atom::AtomId {
        self.atom_id(atom::Atom::Variable(variable.clone()))
    }
    pub(crate) fn exact_constant(&self, of: SumId) -> Option<Ratio> {
        self.as_constant(of).and_then(Coefficient::exact)
    }
}

/// The fraction of π that `x` is to the last place.
fn part_of_pi(x: f64) -> Option<Ratio> {
    use std::f64::consts::PI;
    let near = |q: &i64| {
        let p = (x / PI * *q as f64).round();
        p != 0.0 && (p * PI / *q as f64 - x).abs() <= 2.0 * f64::EPSILON * x.abs()
    };
    let q = (1..=360).filter(|_| x.abs() < 100.0).find(near)?;
    Ratio::new((x / PI * q as f64).round() as i128, q.into())
}
