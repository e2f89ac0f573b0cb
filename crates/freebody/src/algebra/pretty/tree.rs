//! The expression tree that is handed out.

use super::super::atom::Variable;
use super::super::coefficient::Coefficient;
use super::super::ratio::Ratio;
use crate::scalar::real;
use serde::Serialize;

/// A number of a tree.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Number {
    /// A fraction, `"3/2"` or `"-2"`.
    Exact(String),
    /// A decimal.
    Float(f64),
}

/// An expression. As JSON: `{"num": "3/2"}` or `{"num": 0.35}`, `{"sym": "theta", "dots": 1}`,
/// `{"add": […]}`, `{"mul": […]}`, `{"pow": [base, "1/2"]}`, `{"fn": "cos", "args": […]}`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Tree {
    /// A number.
    Num {
        /// Its value.
        num: Number,
    },
    /// A variable; π is the variable `pi`.
    Sym {
        /// The name.
        sym: String,
        /// The number of time derivatives.
        dots: u8,
    },
    /// A sum of two or more.
    Add {
        /// The terms.
        add: Vec<Tree>,
    },
    /// A product of two or more; a number comes first.
    Mul {
        /// The factors.
        mul: Vec<Tree>,
    },
    /// A rational power.
    Pow {
        /// The base and the exponent.
        pow: (Box<Tree>, String),
    },
    /// A function; derivatives of a named one have primes.
    Fn {
        /// Its name.
        #[serde(rename = "fn")]
        name: String,
        /// The arguments.
        args: Vec<Tree>,
    },
}

impl Tree {
    pub(super) fn number(c: Coefficient) -> Tree {
        Tree::Num { num: spelled(c) }
    }
    /// A variable.
    pub fn variable(name: &str, dots: u8) -> Tree {
        Tree::Sym { sym: name.into(), dots }
    }
    pub(super) fn call(name: &str, args: Vec<Tree>) -> Tree {
        Tree::Fn { name: name.into(), args }
    }
    pub(super) fn power(base: Tree, exponent: Ratio) -> Tree {
        match exponent {
            Ratio::ONE => base,
            _ => Tree::Pow { pow: (base.into(), exponent.to_string()) },
        }
    }
    pub(super) fn sum(mut terms: Vec<Tree>) -> Tree {
        match terms.len() {
            0 => Tree::number(Coefficient::ZERO),
            1 => terms.remove(0),
            _ => Tree::Add { add: terms },
        }
    }
    pub(super) fn product(factors: Vec<Tree>) -> Tree {
        let mut factors: Vec<Tree> = factors.into_iter().filter(|f| !f.is_one()).collect();
        match factors.len() {
            0 => Tree::number(Coefficient::ONE),
            1 => factors.remove(0),
            _ => Tree::Mul { mul: factors },
        }
    }
    fn is_one(&self) -> bool {
        *self == Tree::number(Coefficient::ONE)
    }

    /// How many numbers that are no exponents, variables, operations and functions there are in it.
    pub fn signs(&self) -> usize {
        1 + match self {
            Tree::Num { .. } | Tree::Sym { .. } => 0,
            Tree::Add { add: parts } | Tree::Mul { mul: parts } | Tree::Fn { args: parts, .. } => {
                parts.iter().map(Tree::signs).sum()
            }
            Tree::Pow { pow: (base, _) } => base.signs(),
        }
    }

    /// The value for values of the variables (π is known) and of named functions.
    pub fn evaluate(&self, variables: &dyn Fn(&Variable) -> f64, functions: &dyn Fn(&str, &[f64]) -> f64) -> f64 {
        let value = |tree: &Tree| tree.evaluate(variables, functions);
        match self {
            Tree::Num { num } => num.value(),
            Tree::Sym { sym, dots: 0 } if sym == "pi" => std::f64::consts::PI,
            Tree::Sym { sym, dots } => variables(&Variable::new(sym, *dots)),
            Tree::Add { add } => add.iter().map(value).sum(),
            Tree::Mul { mul } => mul.iter().map(value).product(),
            Tree::Pow { pow: (base, exponent) } => real::powf(value(base), fraction(exponent)),
            Tree::Fn { name, args } => {
                let x: Vec<f64> = args.iter().map(value).collect();
                match name.as_str() {
                    "cos" => real::sin_cos(x[0]).1,
                    "sin" => real::sin_cos(x[0]).0,
                    "tan" => real::sin_cos(x[0]).0 / real::sin_cos(x[0]).1,
                    "exp" => real::exp(x[0]),
                    "ln" => real::ln(x[0]),
                    "abs" => x[0].abs(),
                    "atan2" => real::atan2(x[0], x[1]),
                    _ => functions(name, &x),
                }
            }
        }
    }
}

impl Number {
    /// The value as a double.
    pub fn value(&self) -> f64 {
        match self {
            Number::Exact(text) => fraction(text),
            Number::Float(x) => *x,
        }
    }
}

fn fraction(text: &str) -> f64 {
    let number = |part: &str| part.parse().unwrap_or(f64::NAN);
    match text.split_once('/') {
        Some((n, d)) => number(n) / number(d),
        None => number(text),
    }
}

/// Fractions that are short as decimals are written so: 9.81, but 3/4.
fn spelled(c: Coefficient) -> Number {
    let Some(ratio) = c.exact() else { return Number::Float(c.value()) };
    let (_, d) = ratio.parts();
    let decimal = d >= 10 && 10_000 % d == 0 && d != 12 && d != 16;
    match decimal {
        true => Number::Float(ratio.value()),
        false => Number::Exact(ratio.to_string()),
    }
}
