//! The number read as a symbol.

use super::{with, Ratio, Rule, SumId, Tree, Variable};
use crate::scalar::{real, Scalar};
use std::collections::HashMap;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// An expression in variables, in canonical form, and the value it has for the values of the variables.
///
/// It is a handle that holds within one [`session`](super::session). Decisions read the value.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    id: SumId,
    value: f64,
}

impl PartialEq for Symbol {
    /// Whether both are identically the same expression.
    fn eq(&self, o: &Self) -> bool {
        self.id == o.id
    }
}

impl Symbol {
    fn new(id: SumId, value: f64) -> Self {
        Symbol { id, value: if id == SumId::ZERO { 0.0 } else { value } }
    }
    fn valued(id: SumId) -> Self {
        Symbol::new(id, with(|arena| arena.value(id)))
    }
    /// The variable. Within a session a variable keeps the value it was first made with; variables are
    /// written in the order in which they were first made.
    pub fn variable(variable: Variable, value: f64) -> Self {
        let (id, value) = with(|arena| arena.variable_sum(variable, value));
        Symbol::new(id, value)
    }
    /// The derivative `order` of a function of one variable that is known by its name only, at
    /// `self`; `rule` gives its values. Within a session a name keeps its first rule.
    pub fn function(self, name: &str, order: u8, rule: Rule) -> Self {
        let value = rule(self.value, order);
        Symbol::new(with(|arena| arena.named(name, order, self.id, rule)), value)
    }
    /// The absolute value: `self` or −`self`, by its value.
    pub fn abs(self) -> Self {
        Symbol::new(with(|arena| arena.abs(self.id)), self.value.abs())
    }
    /// A fraction raises a positive base.
    fn rational_power(self, exponent: Ratio) -> Self {
        let (n, d) = exponent.parts();
        let value = if d == 1 { real::powi(self.value, n as i32) } else { real::powf(self.value, exponent.value()) };
        Symbol::new(with(|arena| arena.power(self.id, exponent)), value)
    }
    /// Whether it vanishes identically.
    pub fn is_zero(self) -> bool {
        self.id == SumId::ZERO
    }
    /// The number it is, when no variable is in it.
    pub fn constant(self) -> Option<f64> {
        self.variables().is_empty().then_some(self.value)
    }
    /// The partial derivative; variables with different dots are independent.
    pub fn derivative(self, variable: &Variable) -> Self {
        Symbol::valued(with(|arena| {
            let variable = arena.variable_id(variable);
            arena.derivative(self.id, variable, &mut HashMap::new())
        }))
    }
    /// The expression with variables replaced, all at once.
    pub fn substitute(self, new: &[(Variable, Symbol)]) -> Self {
        Symbol::valued(with(|arena| {
            let mut new = new.iter().map(|(variable, symbol)| (arena.variable_id(variable), symbol.id)).collect();
            arena.substitute(self.id, &mut new)
        }))
    }
    /// The factor of a variable that occurs linearly; `None` when it does not.
    pub fn coefficient_of(self, variable: &Variable) -> Option<Self> {
        let slope = self.derivative(variable);
        (!slope.variables().contains(variable)).then_some(slope)
    }
    /// The factor of each variable, and the rest, of an expression that is linear in them all together.
    pub fn linear_in(self, variables: &[Variable]) -> (Vec<Self>, Self) {
        let (factors, rest) = with(|arena| {
            let ids: Vec<_> = variables.iter().map(|variable| arena.variable_id(variable)).collect();
            arena.linear(self.id, &ids)
        });
        (factors.into_iter().map(Symbol::valued).collect(), Symbol::valued(rest))
    }
    /// What is left when the variables are zero.
    pub fn without(self, variables: &[Variable]) -> Self {
        let zeros: Vec<(Variable, Symbol)> = variables.iter().map(|l| (l.clone(), Symbol::zero())).collect();
        self.substitute(&zeros)
    }
    /// The angles whose sines and cosines are factors of its terms.
    pub fn angles(self) -> Vec<Self> {
        let angles = with(|arena| arena.angles(self.id));
        angles.into_iter().map(Symbol::valued).collect()
    }
    /// The factors of the cosine and of the sine of an angle.
    pub fn harmonic(self, angle: Symbol) -> [Self; 2] {
        with(|arena| arena.harmonic(self.id, angle.id)).map(Symbol::valued)
    }
    /// The variables in it, in the order in which they were made.
    pub fn variables(self) -> Vec<Variable> {
        with(|arena| arena.variables(self.id).into_iter().filter_map(|id| arena.variable(id).cloned()).collect())
    }
    /// The value for other values of the variables, on the branches of this session.
    pub fn evaluate(self, values: &dyn Fn(&Variable) -> f64) -> f64 {
        with(|arena| arena.evaluate(self.id, values, &mut HashMap::new()))
    }
    /// The expression as a person writes it.
    pub fn tree(self) -> Tree {
        with(|arena| arena.tree(self.id))
    }
    /// The same, as a sum of one term for each of `variables` that occurs linearly, and the rest.
    pub fn tree_by(self, variables: &[Variable]) -> Tree {
        with(|arena| {
            let variables: Vec<_> = variables.iter().map(|variable| arena.variable_id(variable)).collect();
            arena.tree_by(self.id, &variables)
        })
    }
}

impl Add for Symbol {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Symbol::new(with(|arena| arena.add(self.id, o.id)), self.value + o.value)
    }
}
impl Sub for Symbol {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Symbol::new(with(|arena| arena.subtract(self.id, o.id)), self.value - o.value)
    }
}
impl Mul for Symbol {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Symbol::new(with(|arena| arena.multiply(self.id, o.id)), self.value * o.value)
    }
}
impl Div for Symbol {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        Symbol::new(with(|arena| arena.divide(self.id, o.id)), self.value / o.value)
    }
}
impl Neg for Symbol {
    type Output = Self;
    fn neg(self) -> Self {
        Symbol::new(with(|arena| arena.negate(self.id)), -self.value)
    }
}
impl AddAssign for Symbol {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Symbol {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Scalar for Symbol {
    fn of(value: f64) -> Self {
        Symbol::new(with(|arena| arena.number(value)), value)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = real::sin_cos(self.value);
        with(|arena| (Symbol::new(arena.sin(self.id), s), Symbol::new(arena.cos(self.id), c)))
    }
    fn sqrt(self) -> Self {
        Symbol::new(with(|arena| arena.sqrt(self.id)), self.value.sqrt())
    }
    fn exp(self) -> Self {
        Symbol::new(with(|arena| arena.exp(self.id)), real::exp(self.value))
    }
    fn ln(self) -> Self {
        Symbol::new(with(|arena| arena.ln(self.id)), real::ln(self.value))
    }
    fn atan2(self, x: Self) -> Self {
        Symbol::new(with(|arena| arena.atan2(self.id, x.id)), real::atan2(self.value, x.value))
    }
    fn powi(self, n: i32) -> Self {
        self.rational_power(Ratio::whole(n.into()))
    }
    fn powf(self, exponent: Self) -> Self {
        match with(|arena| arena.exact_constant(exponent.id)) {
            Some(exponent) => self.rational_power(exponent),
            None => (self.ln() * exponent).exp(),
        }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn zero() -> Self {
        Symbol::new(SumId::ZERO, 0.0)
    }
    fn one() -> Self {
        Symbol::new(SumId::ONE, 1.0)
    }
}
