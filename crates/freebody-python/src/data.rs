//! Plain data of the core as Python objects, and back.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::Value;

/// Data as None, bool, int, float, str, list and dict.
pub fn plain<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(x) => x.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(x) => match x.as_i64() {
            Some(x) => x.into_pyobject(py)?.into_any(),
            None => x.as_f64().into_pyobject(py)?.into_any(),
        },
        Value::String(x) => x.into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|x| plain(py, x)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Object(map) => {
            let dict = PyDict::new(py);
            for (key, x) in map {
                dict.set_item(key, plain(py, x)?)?;
            }
            dict.into_any()
        }
    })
}

/// A Python object as data of the core; what is wrong with it where it is none.
pub fn data<T: serde::de::DeserializeOwned>(object: &Bound<'_, PyAny>) -> PyResult<Result<T, serde_json::Error>> {
    let text: String = object.py().import("json")?.call_method1("dumps", (object,))?.extract()?;
    Ok(serde_json::from_str(&text))
}

/// An array of equal rows laid end to end.
pub fn array<'py, T: numpy::Element, D: numpy::ndarray::Dimension>(
    py: Python<'py>,
    flat: Vec<T>,
    shape: impl numpy::ndarray::IntoDimension<Dim = D>,
) -> PyResult<Bound<'py, numpy::PyArray<T, D>>> {
    use numpy::PyArrayMethods;
    numpy::PyArray1::from_vec(py, flat).reshape(shape)
}
