//! Many motions of one mechanism.

use crate::data::array;
use crate::errors;
use freebody::batch::Batch;
use freebody::error::CompileError;
use freebody::hybrid::Settings;
use freebody::mechanism::Mechanism;
use numpy::{PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Of each motion its states at each time, and how it ended: the name, whether it did what was asked, when, a sentence, and its item.
pub type Made<'py> = (Bound<'py, PyArray3<f64>>, Vec<(&'static str, bool, f64, String, String)>);

/// Parameters, coordinates and rates, in rows.
pub type Rows<'py> = [PyReadonlyArray2<'py, f64>; 3];

pub fn batch<'py>(
    py: Python<'py>,
    m: &Mechanism,
    [p, q, u]: &Rows<'py>,
    [t, until]: [f64; 2],
    times: &PyReadonlyArray1<'py, f64>,
    settings: &Settings,
    threads: usize,
) -> PyResult<Made<'py>> {
    settings.integrator().map_err(errors::motion)?;
    let members = q.shape()[0];
    let (p, q, u, times) = (p.as_slice()?, q.as_slice()?, u.as_slice()?, times.as_slice()?);
    let batch = Batch { m, members, p, q, u, t, until, times, settings, threads };
    let mut error = None;
    let made = py.detach(|| {
        batch.run(&mut || match Python::attach(|py| py.check_signals()) {
            Ok(()) => true,
            Err(signal) => {
                error = Some(signal);
                false
            }
        })
    });
    let Some(made) = made else { return Err(error.expect("only a signal ends a batch")) };
    let states = array(py, made.states, [members, times.len(), 2 * m.freedom()])?;
    Ok((states, made.endings.into_iter().map(|e| (e.name, e.is_ok, e.t, e.sentence, e.path)).collect()))
}

/// What is wrong with the numbers of one of them, by its place.
pub fn of_member(member: usize, error: CompileError) -> PyErr {
    errors::model(CompileError { what: format!("{} (member {member})", error.what), ..error })
}
