//! What products are made of.

use super::ratio::Ratio;
use std::rc::Rc;

/// A variable of the formulas: a quantity or one of its time derivatives.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variable {
    /// The name of the quantity.
    pub name: String,
    /// How many times it is differentiated with respect to time.
    pub dots: u8,
}

impl Variable {
    /// The variable `name` with `dots` dots.
    pub fn new(name: impl Into<String>, dots: u8) -> Self {
        Variable { name: name.into(), dots }
    }
}

/// The position of a sum in the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SumId(pub(crate) u32);

impl SumId {
    pub(crate) const ZERO: SumId = SumId(0);
    pub(crate) const ONE: SumId = SumId(1);
}

/// The position of an atom in the arena; the order in which atoms were first met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct AtomId(pub(super) u32);

/// What cannot be taken apart by adding and multiplying.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Atom {
    Variable(Variable),
    Pi,
    /// A prime number, with exponents in (0, 1).
    Prime(i64),
    Cos(SumId),
    Sin(SumId),
    /// A sum of several terms without common factor, positive at the witness; with exponents that
    /// are negative or in (0, 1).
    Group(SumId),
    Call(Function, Vec<SumId>),
}

/// A function that is not rewritten into others.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Function {
    Exp,
    Ln,
    Abs,
    Atan2,
    /// A function given by its name, and which of its derivatives.
    Named(Rc<str>, u8),
}

impl Atom {
    pub(super) fn is_trig(&self) -> bool {
        matches!(self, Atom::Cos(_) | Atom::Sin(_))
    }
}

/// An atom with its exponent.
pub(super) type Factor = (AtomId, Ratio);

/// The product of two products, both sorted.
pub(super) fn joined(a: &[Factor], b: &[Factor]) -> Option<Vec<Factor>> {
    let mut all = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        if a[i].0 < b[j].0 {
            all.push(a[i]);
            i += 1;
        } else if b[j].0 < a[i].0 {
            all.push(b[j]);
            j += 1;
        } else {
            let exponent = a[i].1.plus(b[j].1)?;
            if !exponent.is_zero() {
                all.push((a[i].0, exponent));
            }
            (i, j) = (i + 1, j + 1);
        }
    }
    all.extend(&a[i..]);
    all.extend(&b[j..]);
    Some(all)
}

/// One over the factors.
pub(super) fn inverted(factors: &[Factor]) -> Vec<Factor> {
    factors.iter().map(|factor| (factor.0, factor.1.negated())).collect()
}

/// The same factors with the exponent of one of them changed.
pub(super) fn with_exponent(factors: &[Factor], at: usize, exponent: Ratio) -> Vec<Factor> {
    let mut changed = factors.to_vec();
    changed[at].1 = exponent;
    changed.retain(|factor| !factor.1.is_zero());
    changed
}
