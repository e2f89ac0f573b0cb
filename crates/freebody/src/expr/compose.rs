//! Composition of expressions. Operations on bare numbers are done at once, and those with 0 and
//! 1 that change nothing are left out.

use super::function::{power, Function};
use super::tree::{Condition, Expr, Op};
use crate::scalar::real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// How far back an equal operation is looked for.
const MEMORY: usize = 64;
/// Whole exponent from which on a power is not a product of that many factors any more.
const MOST_FACTORS: f64 = 1e6;

impl<L: Clone + PartialEq> Expr<L> {
    /// A number.
    pub fn constant(value: f64) -> Self {
        Expr { ops: vec![Op::Constant(value)] }
    }
    /// A leaf.
    pub fn variable(variable: L) -> Self {
        Expr { ops: vec![Op::Variable(variable)] }
    }
    /// Square root.
    pub fn sqrt(self) -> Self {
        self.apply(Function::Sqrt)
    }
    /// Natural exponential.
    pub fn exp(self) -> Self {
        self.apply(Function::Exp)
    }
    /// Sine of an angle in radians.
    pub fn sin(self) -> Self {
        self.apply(Function::Sin)
    }
    /// Cosine of an angle in radians.
    pub fn cos(self) -> Self {
        self.apply(Function::Cos)
    }
    /// The angle of the point (x, self), radians in (−π, π].
    pub fn atan2(self, x: Self) -> Self {
        match (self.literal(), x.literal()) {
            (Some(y), Some(x)) => Self::constant(real::atan2(y, x)),
            _ => self.join(x, Op::Atan2),
        }
    }
    /// √(self² + other²).
    pub fn hypot(self, other: Self) -> Self {
        (self.powi(2) + other.powi(2)).sqrt()
    }
    /// A whole power.
    pub fn powi(self, n: i32) -> Self {
        match (self.literal(), n) {
            (_, 0) => Self::constant(1.0),
            (_, 1) => self,
            (Some(base), _) => Self::constant(real::powi(base, n)),
            _ => self.extend(|a| Op::Whole(a, n)),
        }
    }
    /// A real power of a positive base; a base of 0 is allowed with exponents above 1.
    pub fn powf(self, exponent: Self) -> Self {
        match (self.literal(), exponent.literal()) {
            (_, Some(n)) if n.fract() == 0.0 && n.abs() < MOST_FACTORS => self.powi(n as i32),
            (_, Some(0.5)) => self.sqrt(),
            (Some(base), Some(exponent)) => Self::constant(power(base, exponent)),
            _ => self.join(exponent, Op::Power),
        }
    }
    /// Absolute value; `kink` names the switch.
    pub fn abs(self, discontinuity: usize) -> Self {
        match self.literal() {
            Some(value) => Self::constant(value.abs()),
            None => self.extend(|of| Op::Abs { of, kink: discontinuity }),
        }
    }
    /// −1, 0 or 1; `kink` names the switch.
    pub fn sign(self, discontinuity: usize) -> Self {
        match self.literal() {
            Some(0.0) => self,
            Some(value) => Self::constant(value.signum()),
            None => self.extend(|of| Op::Sign { of, kink: discontinuity }),
        }
    }
    /// The smaller of two; `kink` names the switch.
    pub fn min(self, other: Self, discontinuity: usize) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a.min(b)),
            _ => self.join(other, |a, b| Op::Min { a, b, kink: discontinuity }),
        }
    }
    /// The larger of two; `kink` names the switch.
    pub fn max(self, other: Self, discontinuity: usize) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a.max(b)),
            _ => self.join(other, |a, b| Op::Max { a, b, kink: discontinuity }),
        }
    }
    /// What is left of it by whole multiples of another, from 0 up to that; `kink` names the switch.
    pub fn modulo(self, other: Self, discontinuity: usize) -> Self {
        match (self.literal(), other.literal()) {
            (_, Some(0.0)) => Self::constant(f64::NAN),
            (Some(a), Some(b)) => Self::constant(a - b * (a / b).floor()),
            _ => self.join(other, |a, b| Op::Modulo { a, b, kink: discontinuity }),
        }
    }
    /// The value of a table at this argument.
    pub fn lookup(self, table: usize) -> Self {
        self.extend(|of| Op::Table(table, of))
    }
    /// The time derivative.
    pub fn rate(self) -> Self {
        match &self.ops[..] {
            [Op::Rate(inner)] => Expr { ops: vec![Op::Accel(inner.clone())] },
            _ => self.derivative(Op::Rate),
        }
    }
    /// The second time derivative. `None` when there is a time derivative in it already.
    pub fn accel(self) -> Option<Self> {
        (!self.depends_on_rates()).then(|| self.derivative(Op::Accel))
    }
    /// Whether it is below another; `kink` names the switch.
    pub fn less(self, other: Self, discontinuity: usize) -> Condition<L> {
        Condition(self.join(other, |a, b| Op::Less { a, b, kink: discontinuity }))
    }
    /// Whether it is at most another; `kink` names the switch.
    pub fn less_equal(self, other: Self, discontinuity: usize) -> Condition<L> {
        Condition(self.join(other, |a, b| Op::LessEqual { a, b, kink: discontinuity }))
    }
    /// Whether it equals another to the bit. It is no switch, so it suits parameters only.
    pub fn equal(self, other: Self) -> Condition<L> {
        Condition(self.join(other, Op::Equal))
    }

    pub(super) fn apply(self, function: Function) -> Self {
        match self.literal() {
            // Elsewhere its digits would be cut: cos(pi/2) is 0 symbolically.
            Some(0.0) => Self::constant(function.apply(0.0)),
            _ => self.extend(|a| Op::Apply(function, a)),
        }
    }

    fn derivative(self, op: fn(Box<Self>) -> Op<L>) -> Self {
        match self.is_constant() {
            true => Self::constant(0.0),
            false => Expr { ops: vec![op(Box::new(self))] },
        }
    }

    /// The expression with `value` in place of a leaf; of one without time derivatives.
    pub fn substitute(&self, leaf: &L, value: &Self) -> Self {
        let (mut all, mut places) = (Expr { ops: vec![] }, Vec::with_capacity(self.ops.len()));
        for op in &self.ops {
            let place = match op {
                Op::Variable(variable) if variable == leaf => all.absorb(value.clone()),
                _ => {
                    all.ops.push(op.clone().moved(|i| places[i]));
                    all.ops.len() - 1
                }
            };
            places.push(place);
        }
        all
    }

    /// One more operation on the value.
    fn extend(mut self, op: impl FnOnce(usize) -> Op<L>) -> Self {
        self.ops.push(op(self.ops.len() - 1));
        self
    }

    /// An operation on two values.
    fn join(mut self, other: Self, op: impl FnOnce(usize, usize) -> Op<L>) -> Self {
        let a = self.ops.len() - 1;
        let b = self.absorb(other);
        self.ops.push(op(a, b));
        self
    }

    /// Takes over the operations of `other`, equal ones once, and says where its value is.
    fn absorb(&mut self, other: Self) -> usize {
        let mut places: Vec<usize> = Vec::with_capacity(other.ops.len());
        for op in other.ops {
            let op = op.moved(|i| places[i]);
            let recent = self.ops.len().saturating_sub(MEMORY);
            let known = self.ops[recent..].iter().position(|old| *old == op).map(|i| recent + i);
            if known.is_none() {
                self.ops.push(op);
            }
            places.push(known.unwrap_or(self.ops.len() - 1));
        }
        places[places.len() - 1]
    }
}

impl<L: Clone + PartialEq> Condition<L> {
    /// Whether both hold.
    pub fn and(self, other: Self) -> Self {
        Condition(self.0.join(other.0, Op::And))
    }
    /// Whether one of them or both hold.
    pub fn or(self, other: Self) -> Self {
        Condition(self.0.join(other.0, Op::Or))
    }
    /// `then` where it holds, else `otherwise`.
    pub fn choose(self, then: Expr<L>, otherwise: Expr<L>) -> Expr<L> {
        let mut all = self.0;
        let condition = all.ops.len() - 1;
        let then = all.absorb(then);
        let otherwise = all.absorb(otherwise);
        all.ops.push(Op::If { condition, then, otherwise });
        all
    }
}

impl<L: Clone + PartialEq> std::ops::Not for Condition<L> {
    type Output = Self;
    fn not(self) -> Self {
        Condition(self.0.extend(Op::Not))
    }
}

impl<L: Clone + PartialEq> Add for Expr<L> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a + b),
            (Some(0.0), _) => other,
            (_, Some(0.0)) => self,
            _ => self.join(other, Op::Add),
        }
    }
}
impl<L: Clone + PartialEq> Sub for Expr<L> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a - b),
            (Some(0.0), _) => -other,
            (_, Some(0.0)) => self,
            _ => self.join(other, Op::Subtract),
        }
    }
}
impl<L: Clone + PartialEq> Mul for Expr<L> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a * b),
            (Some(0.0), _) | (_, Some(0.0)) => Self::constant(0.0),
            (Some(1.0), _) => other,
            (_, Some(1.0)) => self,
            _ => self.join(other, Op::Multiply),
        }
    }
}
impl<L: Clone + PartialEq> Div for Expr<L> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        match (self.literal(), other.literal()) {
            (Some(a), Some(b)) => Self::constant(a / b),
            (Some(0.0), _) => self,
            (_, Some(1.0)) => self,
            _ => self.join(other, Op::Divide),
        }
    }
}
impl<L: Clone + PartialEq> Neg for Expr<L> {
    type Output = Self;
    fn neg(mut self) -> Self {
        match (self.literal(), self.ops.last()) {
            (Some(value), _) => Self::constant(-value),
            // The value of a double negation is the operation before it only if that is where it points.
            (_, Some(&Op::Negate(a))) if a + 2 == self.ops.len() => {
                self.ops.pop();
                self
            }
            _ => self.extend(Op::Negate),
        }
    }
}
