//! Many motions of one mechanism.

use crate::data::array;
use crate::errors;
use freebody::batch::{self, Batch, Wish};
use freebody::compile::Compiled;
use freebody::error::CompileError;
use freebody::hybrid::Settings;
use freebody::initial::Initial;
use freebody::mechanism::Mechanism;
use numpy::{PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// Of each motion its rows at each time, and how it ended: the name, whether it did what was asked, when, a sentence, and its item.
pub type Made<'py> = (Bound<'py, PyArray3<f64>>, Vec<(&'static str, bool, f64, String, String)>);

/// Parameters, coordinates and rates, in rows.
pub type Rows<'py> = [PyReadonlyArray2<'py, f64>; 3];

#[allow(clippy::too_many_arguments)]
pub fn batch<'py>(
    py: Python<'py>,
    m: &Mechanism,
    [p, q, u]: &Rows<'py>,
    [t, until]: [f64; 2],
    times: &PyReadonlyArray1<'py, f64>,
    reactions: bool,
    settings: &Settings,
    threads: usize,
) -> PyResult<Made<'py>> {
    settings.integrator().map_err(errors::motion)?;
    let members = q.shape()[0];
    let (p, q, u, times) = (p.as_slice()?, q.as_slice()?, u.as_slice()?, times.as_slice()?);
    let batch = Batch { m, members, p, q, u, t, until, times, reactions, settings, threads };
    let made = unless_stopped(py, |go_on| batch.run(go_on))?;
    let rows = array(py, made.rows, [members, times.len(), batch.width()])?;
    Ok((rows, made.endings.into_iter().map(|e| (e.name, e.is_ok, e.t, e.sentence, e.path)).collect()))
}

/// What a member is asked to be at its start, as `Assembly` of the Python package.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked<'py> {
    p: PyReadonlyArray1<'py, f64>,
    fixed: BTreeMap<String, f64>,
    guess: BTreeMap<String, f64>,
    rates: BTreeMap<String, f64>,
    points: BTreeMap<String, [f64; 2]>,
    branch: BTreeMap<String, i64>,
}

/// The same with its names looked up.
pub fn wish(compiled: &mut Compiled, Asked { p, fixed, guess, rates, points, branch }: Asked<'_>) -> PyResult<Wish> {
    let wish = compiled.wish(&Initial { fixed, guess, rates, points, branch, from: None }).map_err(errors::model)?;
    Ok((p.as_slice()?.to_vec(), wish))
}

/// Coordinates and rates at the starts, in rows.
pub fn starts<'py>(
    py: Python<'py>,
    m: &Mechanism,
    t: f64,
    wishes: &[Wish],
    threads: usize,
) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
    let found = unless_stopped(py, |go_on| batch::starts(m, t, wishes, threads, go_on))?;
    let found = found.map_err(|(member, error)| errors::motion_of(error, &format!(" (member {member})")))?;
    let rows = |part: usize| {
        array(py, found.iter().flat_map(|state| state[part].iter().copied()).collect(), [found.len(), m.freedom()])
    };
    Ok([rows(0)?, rows(1)?])
}

/// What work on threads gives, unless a signal from the keyboard stops it.
fn unless_stopped<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&mut dyn FnMut() -> bool) -> Option<T> + Send,
) -> PyResult<T> {
    let mut error = None;
    let mut go_on = || Python::attach(|py| py.check_signals()).map_err(|signal| error = Some(signal)).is_ok();
    let done = py.detach(|| work(&mut go_on));
    done.ok_or_else(|| error.expect("only a signal stops it"))
}

/// What is wrong with the numbers of one of them, by its place.
pub fn of_member(member: usize, error: CompileError) -> PyErr {
    errors::model(CompileError { what: format!("{} (member {member})", error.what), ..error })
}
