//! A finished run.

use crate::data::{array, plain};
use crate::errors;
use crate::instant::solution;
use crate::mechanism::Shared;
use freebody::hybrid;
use freebody::symbolic::answer;
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

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
    /// What happened, what switched, how the run ended and what it took.
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        plain(py, &self.run.record(&self.of.mechanism()))
    }
    /// Everything about one time, by a route.
    fn instant<'py>(&self, py: Python<'py>, t: f64, route: &str) -> PyResult<Bound<'py, PyDict>> {
        let m = self.of.mechanism();
        let route = crate::mechanism::route(route)?;
        let (solved, freedom) = self.run.instant(&m, t, route).map_err(errors::motion)?;
        solution(py, &m, &solved, &freedom)
    }
    /// Bodies and loads of the free-body diagrams at one time, in numbers.
    fn free_bodies<'py>(&self, py: Python<'py>, t: f64) -> PyResult<Bound<'py, PyAny>> {
        let told = self.run.at(&self.of.mechanism(), t, freebody::free_bodies::free_bodies);
        plain(py, &told.map_err(errors::motion)?)
    }
    /// Answers in letters to questions about one time; see `Mechanism.letters`.
    fn letters<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        setting: &Bound<'_, PyAny>,
        questions: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (setting, questions) = crate::mechanism::questions(setting, questions)?;
        let told = self.run.at(&self.of.mechanism(), t, |workspace| answer(workspace, &setting, &questions));
        plain(py, &told.map_err(errors::motion)?)
    }
    /// Bodies and loads during a blow, given by its place among the changes: those of what was struck are told for a
    /// unit.
    fn free_bodies_of_blow<'py>(&self, py: Python<'py>, change: usize) -> PyResult<Bound<'py, PyAny>> {
        let told = self.run.at_impact(&self.of.mechanism(), change, |workspace| {
            // What strikes at several places moves there as no constraint allows; where impulses act does not depend on
            // it.
            workspace.set_zero_rates();
            freebody::free_bodies::free_bodies(workspace)
        });
        plain(py, &told.map_err(errors::motion)?)
    }
    /// Answers in letters to questions about a blow, with the rates before it.
    fn letters_of_blow<'py>(
        &self,
        py: Python<'py>,
        change: usize,
        setting: &Bound<'_, PyAny>,
        questions: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (setting, questions) = crate::mechanism::questions(setting, questions)?;
        let told =
            self.run.at_impact(&self.of.mechanism(), change, |workspace| answer(workspace, &setting, &questions));
        plain(py, &told.map_err(errors::motion)?)
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
    #[allow(clippy::type_complexity)]
    fn instants<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<f64>,
    ) -> PyResult<(Bound<'py, PyArray3<f64>>, Bound<'py, PyArray3<bool>>)> {
        let m = self.of.mechanism();
        let rows = self.run.reactions(&m, times.as_slice()?).map_err(errors::motion)?;
        let shape = [rows.len(), m.joints.len(), 3];
        let known = |x: f64, sure: bool| if sure { x } else { f64::NAN };
        let values = rows.iter().flatten().flat_map(|(x, s)| (0..3).map(|i| known(x[i], s[i]))).collect();
        let sure: Vec<bool> = rows.iter().flatten().flat_map(|(_, s)| *s).collect();
        Ok((array(py, values, shape)?, array(py, sure, shape)?))
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
    /// Parameters, time, coordinates and rates at the end.
    #[allow(clippy::type_complexity)]
    fn end<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyArray1<f64>>, f64, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let (t, q, u, p) = self.run.end(&self.of.mechanism());
        let list = |v: Vec<f64>| PyArray1::from_vec(py, v);
        (list(p), t, list(q), list(u))
    }
}
