//! Errors of the core as Python exceptions.

use freebody::balance::Trouble;
use freebody::error::CompileError;
use freebody::expr::ExprError;
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(_core, ModelError, PyValueError, "A model that cannot be compiled: (path, what, hint).");
create_exception!(_core, ExpressionError, PyValueError, "Text that is no expression: (start, end, what, hint).");
create_exception!(_core, MotionError, PyRuntimeError, "A state that has no answer: (kind, path, what, hint).");

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("ModelError", m.py().get_type::<ModelError>())?;
    m.add("ExpressionError", m.py().get_type::<ExpressionError>())?;
    m.add("MotionError", m.py().get_type::<MotionError>())
}

pub fn model(e: CompileError) -> PyErr {
    ModelError::new_err((e.path, e.what, e.hint))
}

/// Offsets in characters rather than bytes.
pub fn expression(text: &str, e: ExprError) -> PyErr {
    let characters = |byte: usize| text.get(..byte).map_or(text.chars().count(), |head| head.chars().count());
    ExpressionError::new_err((characters(e.at.start), characters(e.at.end), e.what, e.hint))
}

pub fn motion(t: Trouble) -> PyErr {
    let (what, hint) = t.sentence.split_once("; ").unwrap_or((&t.sentence, ""));
    MotionError::new_err((t.name, t.path.unwrap_or_default(), what.to_string(), hint.to_string()))
}
