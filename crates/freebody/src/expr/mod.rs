//! Expressions: every number of a model, every law, event and reported quantity.
//!
//! A text becomes a syntax tree ([`parse`]), the tree becomes an [`Expr`] by asking a [`Scope`] what
//! its names mean, and an `Expr` is evaluated over any [`crate::scalar::Scalar`] by asking an
//! [`Env`] for the values of its leaves.
//!
//! ```text
//! value      = numbers with + - * / ^ (or **), signs and parentheses
//! number     = 12, 1.5e-3, pi
//! name       = m1, rod.A, link[3].end, 'crank speed'
//! call       = sin(x), min(a, b), if(x > 0, a, b), rate(x), distance(rod.A, ground.O)
//! condition  = comparisons < <= > >= == != with and, or, not
//! ```
//!
//! `^` is read from the right and binds tighter than a sign on its left: `-x^2` is `-(x^2)`. The
//! functions are those of [`FUNCTIONS`]; angles are in radians.
//!
//! # Switches
//!
//! `abs`, `sign`, `min`, `max`, `mod`, `<`, `<=`, `>` and `>=` are switches: each owns an identifier, its
//! *discontinuity*, and a switching function whose sign tells the arm. An environment may freeze the arm, so
//! that an integrator sees smooth functions only and finds the discontinuities as zeros of [`Expr::switch`].

mod ast;
mod compose;
mod eval;
mod function;
mod lex;
mod nearest;
mod parse;
mod print;
mod resolve;
mod slopes;
mod table;
#[cfg(test)]
mod tests;
mod tree;

pub use ast::{spell, Ast, ExprError, Kind, Message, Operator};
pub use eval::Env;
pub use nearest::nearest;
pub use parse::{parse, MAX_DEPTH, MAX_NODES};
pub use print::Named;
pub use resolve::{Scope, FUNCTIONS, MAX_OPERATIONS};
pub use table::{Interpolation, Table};
pub use tree::{Condition, Expr};
