//! Errors of the core as the exceptions of `freebody.core.errors`.

use freebody::dynamics::DynamicsError;
use freebody::error::CompileError;
use freebody::expr::ExprError;
use pyo3::import_exception;
use pyo3::prelude::*;

import_exception!(freebody.core.errors, ModelError);
import_exception!(freebody.core.errors, ExpressionError);
import_exception!(freebody.core.errors, MotionError);

pub fn model(e: CompileError) -> PyErr {
    ModelError::new_err((e.path, e.what, e.hint))
}

/// Offsets in characters rather than bytes.
pub fn expression(text: &str, e: ExprError) -> PyErr {
    let characters = |byte: usize| text.get(..byte).map_or(text.chars().count(), |head| head.chars().count());
    ExpressionError::new_err((characters(e.at.start), characters(e.at.end), e.what, e.hint))
}

pub fn motion(t: DynamicsError) -> PyErr {
    motion_of(t, "")
}

/// With something more behind what it says, as of whom.
pub fn motion_of(t: DynamicsError, more: &str) -> PyErr {
    let (what, hint) = t.what_and_hint();
    MotionError::new_err((t.name(), t.path().unwrap_or_default().to_string(), format!("{what}{more}"), hint))
}
