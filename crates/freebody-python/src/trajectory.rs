//! A finished run.

use crate::data::{array, plain};
use crate::errors;
use crate::mechanism::{History, Shared};
use freebody::hybrid;
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray1};
use pyo3::prelude::*;
use std::sync::Arc;

type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Parameters, time, coordinates, rates, and what the motion brought along.
type State<'py> = (Array<'py>, f64, Array<'py>, Array<'py>, Py<History>);

/// A finished run with dense output.
#[pyclass(frozen)]
pub struct Trajectory {
    pub of: Arc<Shared>,
    pub run: hybrid::Trajectory,
}

#[pymethods]
impl Trajectory {
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.run.steps)
    }
    /// What happened, what switched, how the run ended and what it took; `reported` is what is read of it besides.
    fn record<'py>(&self, py: Python<'py>, reported: Vec<String>) -> PyResult<Bound<'py, PyAny>> {
        let reported = self.of.observables(&reported)?;
        plain(py, &self.run.record(&self.of.mechanism(), &reported))
    }
    /// The state at one time.
    fn state<'py>(&self, py: Python<'py>, t: f64) -> PyResult<State<'py>> {
        handed(py, self.run.state(&self.of.mechanism(), t).map_err(errors::motion)?)
    }
    /// The state during an impact, given by its place among the changes.
    fn state_of_impact<'py>(&self, py: Python<'py>, change: usize) -> PyResult<State<'py>> {
        handed(py, self.run.state_of_impact(&self.of.mechanism(), change).map_err(errors::motion)?)
    }
    /// The derivatives of the rates after an impact by time, coordinates, rates and parameters before it, in rows.
    fn impact_derivatives<'py>(&self, py: Python<'py>, change: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let m = self.of.mechanism();
        let rows = self.run.impact_derivatives(&m, change).map_err(errors::motion)?;
        array(py, rows.concat(), [rows.len(), m.freedom()])
    }
    /// The state at the end.
    fn end<'py>(&self, py: Python<'py>) -> PyResult<State<'py>> {
        handed(py, self.run.end(&self.of.mechanism()))
    }
    #[allow(clippy::type_complexity)]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<f64>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>)> {
        let m = self.of.mechanism();
        let rows = self.run.sample(&m, times.as_slice()?).map_err(errors::motion)?;
        let n = m.freedom();
        let part = |from: usize| rows.iter().flat_map(|r| r[from..from + n].to_vec()).collect::<Vec<_>>();
        Ok((array(py, part(0), [rows.len(), n])?, array(py, part(n), [rows.len(), n])?))
    }
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        texts: Vec<String>,
        times: PyReadonlyArray1<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let laws = self.of.observables(&texts)?;
        let rows = self.run.evaluate(&self.of.mechanism(), &laws.iter().collect::<Vec<_>>(), times.as_slice()?);
        let rows = rows.map_err(errors::motion)?;
        array(py, rows.concat(), [rows.len(), texts.len()])
    }
    fn poses<'py>(&self, py: Python<'py>, times: PyReadonlyArray1<f64>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let m = self.of.mechanism();
        let rows = self.run.poses(&m, times.as_slice()?).map_err(errors::motion)?;
        let bodies = m.listed_bodies().len();
        array(py, rows.concat().concat(), [rows.len(), bodies, 3])
    }
    /// The reactions of all joints; NaN where one is not determinate.
    fn reactions<'py>(&self, py: Python<'py>, times: PyReadonlyArray1<f64>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let m = self.of.mechanism();
        let rows = self.run.instants(&m, times.as_slice()?).map_err(errors::motion)?;
        let (first, joints) = (3 * m.freedom(), m.listed_joints().count());
        let of_joints = rows.iter().flat_map(|row| row[first..first + 3 * joints].iter().copied());
        array(py, of_joints.collect(), [rows.len(), joints, 3])
    }
    fn ledger<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<f64>,
    ) -> PyResult<(Vec<String>, Bound<'py, PyArray2<f64>>)> {
        let ledger = self.run.ledger(&self.of.mechanism(), times.as_slice()?).map_err(errors::motion)?;
        let columns = ledger.names.len();
        Ok((ledger.names, array(py, ledger.rows.concat(), [ledger.rows.len(), columns])?))
    }
}

fn handed(py: Python<'_>, state: hybrid::MotionState) -> PyResult<State<'_>> {
    let hybrid::MotionState { p, t, q, u, mode, works } = state;
    let list = |v: Vec<f64>| PyArray1::from_vec(py, v);
    Ok((list(p), t, list(q), list(u), Py::new(py, History { mode, works })?))
}
