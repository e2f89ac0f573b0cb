//! The syntax tree of an expression, and what can be wrong with one.

use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

/// A piece of an expression as it was written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ast {
    /// What it is.
    #[serde(flatten)]
    pub kind: Kind,
    /// Where it stands in the text, in bytes.
    #[serde(serialize_with = "pair")]
    pub span: Range<usize>,
}

/// The kinds of pieces. A tree is at most a few hundred levels deep, so it may be walked recursively.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A literal.
    Number(f64),
    /// A name, without its quotes.
    Name(String),
    /// A function with its arguments.
    Call(String, Vec<Ast>),
    /// The opposite of a number.
    Negate(Box<Ast>),
    /// The opposite of a condition.
    Not(Box<Ast>),
    /// Operators of equal precedence, applied from left to right: `a - b + c`.
    Chain(Box<Ast>, Vec<(Operator, Ast)>),
}

/// What stands between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "each is its sign")]
pub enum Operator {
    #[serde(rename = "or")]
    Or,
    #[serde(rename = "and")]
    And,
    #[serde(rename = "<")]
    Less,
    #[serde(rename = "<=")]
    LessEqual,
    #[serde(rename = ">")]
    Greater,
    #[serde(rename = ">=")]
    GreaterEqual,
    #[serde(rename = "==")]
    Equal,
    #[serde(rename = "!=")]
    NotEqual,
    #[serde(rename = "+")]
    Add,
    #[serde(rename = "-")]
    Subtract,
    #[serde(rename = "*")]
    Multiply,
    #[serde(rename = "/")]
    Divide,
    #[serde(rename = "^")]
    Power,
}

fn pair<T: Serializer>(span: &Range<usize>, to: T) -> Result<T::Ok, T::Error> {
    (span.start, span.end).serialize(to)
}

/// What is wrong and what to do about it, wherever it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// What is wrong.
    pub what: String,
    /// What to do about it; may be empty.
    pub hint: String,
}

impl Message {
    /// A message of its two sentences.
    pub fn new(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Message { what: what.into(), hint: hint.into() }
    }
    /// The message about a place in a text.
    pub fn at(self, span: &Range<usize>) -> ExprError {
        ExprError { at: span.clone(), what: self.what, hint: self.hint }
    }
}

/// What is wrong with an expression, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExprError {
    /// The place in the text, in bytes.
    pub at: Range<usize>,
    /// What is wrong.
    pub what: String,
    /// What to do about it; may be empty.
    pub hint: String,
}

impl fmt::Display for ExprError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.what)?;
        if self.hint.is_empty() {
            return Ok(());
        }
        write!(f, "; {}", self.hint)
    }
}

impl std::error::Error for ExprError {}

/// A name as it is written in an expression: in quotes unless it is plain.
pub fn spell(name: &str) -> Cow<'_, str> {
    match super::lex::is_plain(name) {
        true => Cow::Borrowed(name),
        false => Cow::Owned(format!("'{name}'")),
    }
}
