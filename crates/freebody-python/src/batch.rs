//! Many motions of one mechanism.

use crate::data::array;
use crate::errors;
use freebody::batch::{self, Batch, Wish};
use freebody::compile::Compiled;
use freebody::error::CompileError;
use freebody::hybrid::Settings;
use freebody::initial::Initial;
use freebody::mechanism::Mechanism;
use numpy::{PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// Of each motion how it ended: the name, whether it did what was asked, when, a sentence, and its item.
pub type Endings = Vec<(&'static str, bool, f64, String, String)>;

/// Parameters, coordinates and rates, in rows.
pub type Rows<'py> = [PyReadonlyArray2<'py, f64>; 3];

#[allow(clippy::too_many_arguments)]
pub fn batch(
    py: Python<'_>,
    m: &Mechanism,
    [p, q, u]: &Rows<'_>,
    [t, until]: [f64; 2],
    times: &PyReadonlyArray1<'_, f64>,
    mut made: PyReadwriteArray3<'_, f64>,
    reactions: bool,
    settings: &Settings,
    threads: usize,
) -> PyResult<Endings> {
    settings.integrator().map_err(errors::motion)?;
    let members = q.shape()[0];
    let (p, q, u, times) = (p.as_slice()?, q.as_slice()?, u.as_slice()?, times.as_slice()?);
    let batch = Batch { m, members, p, q, u, t, until, times, reactions, settings, threads };
    let rows = made.as_slice_mut()?;
    let endings = unless_stopped(py, |go_on| batch.run(rows, go_on))?;
    Ok(endings.into_iter().map(|e| (e.name, e.is_ok, e.t, e.sentence, e.path)).collect())
}

/// What a member is asked to be at its start, as `Assembly` of the Python package.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Asked {
    fixed: BTreeMap<String, f64>,
    guess: BTreeMap<String, f64>,
    rates: BTreeMap<String, f64>,
    points: BTreeMap<String, [f64; 2]>,
    branch: BTreeMap<String, i64>,
}

/// Of each member a value of what is fixed, by name, and of what rate is.
pub type Columns<'py> = [BTreeMap<String, PyReadonlyArray1<'py, f64>>; 2];

/// Coordinates and rates at the starts, in rows: of each as it is asked for, or of all as one is, but for what stands in columns.
pub fn starts<'py>(
    py: Python<'py>,
    compiled: &mut Compiled,
    t: f64,
    asked: Vec<Asked>,
    p: &PyReadonlyArray2<'py, f64>,
    columns: &Columns<'py>,
    threads: usize,
) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
    let wish = |Asked { fixed, guess, rates, points, branch }: Asked| {
        compiled.wish(&Initial { fixed, guess, rates, points, branch, from: None }).map_err(errors::model)
    };
    let wishes = asked.into_iter().map(wish).collect::<PyResult<Vec<_>>>()?;
    let ([members, width], p) = ([p.shape()[0], p.shape()[1]], p.as_slice()?);
    let mut named = vec![];
    for (columns, of_rate) in columns.iter().zip([false, true]) {
        for (name, column) in columns {
            named.push((name, column.as_slice()?, of_rate));
        }
    }
    let m = &compiled.mechanism;
    let wish = |member: usize| -> Wish {
        let mut wish = wishes[member.min(wishes.len() - 1)].clone();
        named.iter().for_each(|(name, column, of_rate)| wish.ask(m, name, column[member], *of_rate));
        (p[member * width..][..width].to_vec(), wish)
    };
    let found = unless_stopped(py, |go_on| batch::starts(m, t, members, &wish, threads, go_on))?;
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
