//! Named failures.

use std::fmt;

/// A named failure of a system, with a sentence for the reader.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// Short fixed name, e.g. `SingularMass`.
    pub name: &'static str,
    /// One sentence: what happened and what to do.
    pub sentence: String,
    /// The item of the model it is about, e.g. `joints.pivot`, where there is one.
    pub path: Option<String>,
}

impl Trouble {
    /// A failure called `name`, explained by `sentence`.
    pub fn new(name: &'static str, sentence: impl Into<String>) -> Self {
        Self { name, sentence: sentence.into(), path: None }
    }
    /// The same failure, said to be about an item of the model.
    pub fn about(self, path: impl Into<Option<String>>) -> Self {
        Self { path: path.into(), ..self }
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{}: {}", self.name, self.sentence)
    }
}

impl std::error::Error for Trouble {}

/// What is wrong with a model.
#[derive(Clone, Debug, PartialEq)]
pub struct CompileError {
    /// Where in the model, e.g. `joints.pivot.of`.
    pub path: String,
    /// What is wrong.
    pub what: String,
    /// What to try.
    pub hint: String,
}

impl CompileError {
    pub(crate) fn new(path: impl Into<String>, what: impl Into<String>, hint: impl Into<String>) -> Self {
        CompileError { path: path.into(), what: what.into(), hint: hint.into() }
    }
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}; {}", self.path, self.what, self.hint)
    }
}

impl std::error::Error for CompileError {}
