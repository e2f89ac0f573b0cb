//! Python bindings: a method forwards, or it is wrong.

use pyo3::prelude::*;

/// The compiled core of freebody.
#[pymodule]
fn _core(_m: &Bound<'_, PyModule>) -> PyResult<()> {
    Ok(())
}
