//! A compiled mechanism.

use crate::batch::{self, Columns, Endings, Rows};
use crate::data::{array, data, plain};
use crate::errors;
use crate::instant::{balances, solution};
use crate::trajectory::Trajectory;
use freebody::assembly::{assemble, Closed};
use freebody::builder::chosen;
use freebody::compile::Compiled;
use freebody::dynamics::{reaction_names, DynamicsError, Route, Source, Workspace};
use freebody::gauges::ModelExpr;
use freebody::hybrid::{simulate, Settings, Start};
use freebody::initial::Initial;
use freebody::mode::Mode;
use freebody::motion::Options;
use freebody::scalar::DoubleDouble;
use freebody::symbolic::{answer, Query, Setting};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray3};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::sync::{Arc, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// A mechanism that several Python objects look at. Reading a new expression may add a switch to it.
pub struct Shared(RwLock<Compiled>);

/// The mechanism of a [`Shared`], held for reading.
pub struct Held<'a>(RwLockReadGuard<'a, Compiled>);

impl std::ops::Deref for Held<'_> {
    type Target = freebody::mechanism::Mechanism;
    fn deref(&self) -> &Self::Target {
        &self.0.mechanism
    }
}

impl Shared {
    pub fn mechanism(&self) -> Held<'_> {
        Held(self.0.read().expect("no thread panics while it holds the mechanism"))
    }
    fn names(&self) -> RwLockWriteGuard<'_, Compiled> {
        self.0.write().expect("no thread panics while it holds the mechanism")
    }
    pub fn observables(&self, texts: &[String]) -> PyResult<Vec<ModelExpr>> {
        let mut compiled = self.names();
        texts.iter().map(|text| compiled.observable(text).map_err(errors::model)).collect()
    }
}

/// A compiled model: topology without numbers.
#[pyclass(frozen)]
pub struct Mechanism {
    of: Arc<Shared>,
    /// What it says of itself, once that was asked for.
    described: PyOnceLock<Py<PyAny>>,
}

type Array<'py> = PyReadonlyArray1<'py, f64>;
type Named = BTreeMap<String, f64>;
/// Parameters, time, coordinates, rates, and what a motion brought along.
type State<'py> = (Array<'py>, f64, Array<'py>, Array<'py>, Option<PyRef<'py, History>>);

/// What a motion brings to a state: the mode, and the works since its start.
#[pyclass(frozen)]
pub struct History {
    pub mode: Mode,
    pub works: Vec<f64>,
}

#[pymethods]
impl History {
    /// What touches or is taut, by its place in the list of limits, each with the feature on which it does.
    fn touching(&self) -> Vec<(usize, usize)> {
        let contacts = self.mode.contacts.iter().enumerate().filter(|(_, contact)| contact.mode.touches());
        contacts.map(|(place, contact)| (place, contact.feature.index)).collect()
    }
}

fn placed<'m>(m: &'m freebody::mechanism::Mechanism, (p, t, q, u, past): &State<'_>) -> PyResult<Workspace<'m>> {
    let mode = past.as_ref().map(|past| &past.mode);
    Workspace::of_state(m, p.as_slice()?, *t, [q.as_slice()?, u.as_slice()?], mode).map_err(errors::motion)
}

/// The works of a state: those of its motion, or of one that starts there.
fn works(workspace: &Workspace, state: &State<'_>) -> Vec<f64> {
    state.4.as_ref().map_or_else(|| workspace.works_at_start(), |past| past.works.clone())
}

#[pymethods]
impl Mechanism {
    #[new]
    fn new(spec: &Bound<'_, PyAny>) -> PyResult<Self> {
        let spec = data(spec)?.map_err(|e| {
            errors::ModelError::new_err((String::new(), format!("the model data cannot be read: {e}"), ""))
        })?;
        let compiled = Compiled::new(&spec).map_err(errors::model)?;
        Ok(Mechanism { of: Arc::new(Shared(RwLock::new(compiled))), described: PyOnceLock::new() })
    }

    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let made = || PyResult::Ok(plain(py, &freebody::metadata::metadata(&self.of.mechanism()))?.unbind());
        Ok(self.described.get_or_try_init(py, made)?.bind(py).clone())
    }

    fn bind<'py>(&self, py: Python<'py>, values: Named) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let p = self.of.names().parameters(&values).map_err(errors::model)?;
        Ok(PyArray1::from_vec(py, p))
    }

    /// The parameters of many, in rows: those that are named have the columns given.
    fn bind_rows<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        columns: numpy::PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let (compiled, columns, mut rows) = (self.of.names(), columns.as_array(), vec![]);
        for (member, values) in columns.outer_iter().enumerate() {
            let named = names.iter().cloned().zip(values.iter().copied()).collect();
            rows.extend(compiled.parameters(&named).map_err(|e| batch::of_member(member, e))?);
        }
        array(py, rows, [columns.nrows(), compiled.mechanism.parameters.len()])
    }

    #[allow(clippy::too_many_arguments, clippy::type_complexity)]
    fn assemble<'py>(
        &self,
        py: Python<'py>,
        p: Array<'py>,
        t: f64,
        fixed: Named,
        guess: Named,
        rates: Named,
        points: BTreeMap<String, [f64; 2]>,
        branch: BTreeMap<String, i64>,
        past: Option<PyRef<'py, History>>,
        from: Option<State<'py>>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyAny>)> {
        let closed =
            |(p, t, q, ..): State| PyResult::Ok(Closed { p: p.as_slice()?.to_vec(), t, q: q.as_slice()?.to_vec() });
        let from = from.map(closed).transpose()?;
        let asked = Initial { fixed, guess, rates, points, branch, from };
        let wish = self.of.names().wish(&asked).map_err(errors::model)?;
        let m = self.of.mechanism();
        m.check_state(p.as_slice()?, t, &wish.start, &wish.start_rates).map_err(errors::motion)?;
        let mode = past.as_ref().map(|past| &past.mode);
        let mut workspace = Workspace::in_mode(&m, p.as_slice()?, mode).map_err(errors::motion)?;
        let found = assemble(&mut workspace, t, &wish).map_err(errors::motion)?;
        let notes = plain(py, &found.notes(&m, &asked))?;
        Ok((PyArray1::from_vec(py, found.q), PyArray1::from_vec(py, found.u), notes))
    }

    fn instant<'py>(&self, py: Python<'py>, state: State<'py>, route: &str) -> PyResult<Bound<'py, PyDict>> {
        let m = self.of.mechanism();
        let route = self::route(route)?;
        let mut workspace = placed(&m, &state)?;
        let solved = workspace.instant(route).map_err(errors::motion)?;
        solution(py, &m, &solved)
    }

    fn balances<'py>(&self, py: Python<'py>, state: State<'py>, route: &str) -> PyResult<Bound<'py, PyDict>> {
        let m = self.of.mechanism();
        balances(py, placed(&m, &state)?, self::route(route)?)
    }

    fn free_bodies<'py>(&self, py: Python<'py>, state: State<'py>) -> PyResult<Bound<'py, PyAny>> {
        let m = self.of.mechanism();
        let mut workspace = placed(&m, &state)?;
        plain(py, &freebody::free_bodies::free_bodies(&mut workspace).map_err(errors::motion)?)
    }

    fn symbolic_answers<'py>(
        &self,
        py: Python<'py>,
        state: State<'py>,
        setting: &Bound<'_, PyAny>,
        questions: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let m = self.of.mechanism();
        let mut workspace = placed(&m, &state)?;
        let (setting, questions) = self::questions(setting, questions)?;
        plain(py, &answer(&mut workspace, &setting, &questions).map_err(errors::motion)?)
    }

    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        texts: Vec<String>,
        state: State<'py>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let laws = self.of.observables(&texts)?;
        let m = self.of.mechanism();
        let mut workspace = placed(&m, &state)?;
        let laws: Vec<&ModelExpr> = laws.iter().collect();
        let works = works(&workspace, &state);
        Ok(PyArray1::from_vec(py, workspace.evaluate(&laws, &works).map_err(errors::motion)?))
    }

    fn derivatives<'py>(
        &self,
        py: Python<'py>,
        texts: Vec<String>,
        state: State<'py>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let laws = self.of.observables(&texts)?;
        let m = self.of.mechanism();
        let mut workspace = placed(&m, &state)?;
        let laws: Vec<&ModelExpr> = laws.iter().collect();
        let (works, along) = (works(&workspace, &state), workspace.unit_directions());
        let rows = workspace.derivatives(&laws, &works, &along).map_err(errors::motion)?;
        array(py, rows.concat(), [along.len(), laws.len()])
    }

    /// Each closing row: its name, whether it keeps something from sliding, derivatives of its value and of its rate.
    #[allow(clippy::type_complexity)]
    fn row_derivatives(&self, state: State<'_>) -> PyResult<Vec<(String, bool, Option<Vec<f64>>, Option<Vec<f64>>)>> {
        let m = self.of.mechanism();
        let mut workspace = placed(&m, &state)?;
        let along = workspace.unit_directions();
        let rows = workspace.row_derivatives(&along).map_err(errors::motion)?;
        let sticks = |source| matches!(source, Source::Friction(_) | Source::JointFriction(_));
        Ok(rows.into_iter().map(|r| (r.source.name(&m).to_string(), sticks(r.source), r.value, r.rate)).collect())
    }

    fn points<'py>(&self, py: Python<'py>, p: Array<'py>) -> PyResult<Bound<'py, PyAny>> {
        let m = self.of.mechanism();
        m.check_parameters(p.as_slice()?).map_err(errors::motion)?;
        plain(py, &freebody::metadata::places(&m, &m.bind(p.as_slice()?)))
    }

    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        p: Array<'py>,
        q: Array<'py>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let (m, p, q) = (self.of.mechanism(), p.as_slice()?, q.as_slice()?);
        m.check_state(p, 0.0, q, &vec![0.0; m.freedom()]).map_err(errors::motion)?;
        array(py, freebody::hybrid::mass_matrix(&m, p, q), [m.freedom(), m.freedom()])
    }

    #[pyo3(signature = (state, until, method=freebody::motion::METHODS[0].name, rtol=1e-9, step=None, max_step=None, route="auto", max_steps=1_000_000, progress=None, impacts="stop", painleve="stop"))]
    #[allow(clippy::too_many_arguments)]
    fn simulate(
        &self,
        py: Python<'_>,
        state: State<'_>,
        until: f64,
        method: &str,
        rtol: f64,
        step: Option<f64>,
        max_step: Option<f64>,
        route: &str,
        max_steps: usize,
        progress: Option<Py<PyAny>>,
        impacts: &str,
        painleve: &str,
    ) -> PyResult<Trajectory> {
        let options = Options { rtol, first_step: step, max_step: max_step.unwrap_or(f64::INFINITY), max_steps };
        let settings = Settings::named([method, route, impacts, painleve], options).map_err(errors::model)?;
        let (p, t, q, u, past) = state;
        let mode = past.map(|past| past.mode.clone());
        let (p, q, u) = (p.as_slice()?.to_vec(), q.as_slice()?.to_vec(), u.as_slice()?.to_vec());
        let of = self.of.clone();
        let mut error = None;
        let run = py.detach(|| {
            let m = of.mechanism();
            let start = Start { p: &p, t, q: &q, u: &u, mode: mode.as_ref() };
            let mut last = std::time::Instant::now();
            simulate(&m, &start, until, &settings, &mut |now| {
                if last.elapsed().as_millis() < 50 {
                    return true;
                }
                last = std::time::Instant::now();
                Python::attach(|py| heard(py, progress.as_ref(), now)).unwrap_or_else(|e| {
                    error = Some(e);
                    false
                })
            })
        });
        match error {
            Some(error) => Err(error),
            None => Ok(Trajectory { of: self.of.clone(), run: run.map_err(errors::motion)? }),
        }
    }

    /// Coordinates and rates at times that follow each other, as the sum of two arrays (times, 2 n), by Taylor series of an order.
    fn reference<'py>(
        &self,
        py: Python<'py>,
        state: State<'py>,
        times: Vec<f64>,
        order: usize,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
        let (p, t, q, u, _) = &state;
        let (m, mut error) = (self.of.mechanism(), None);
        let start = Start { p: p.as_slice()?, t: *t, q: q.as_slice()?, u: u.as_slice()?, mode: None };
        let found = py.detach(|| {
            freebody::hybrid::reference(&m, &start, &times, order, &mut || {
                Python::attach(|py| py.check_signals()).map_err(|signal| error = Some(signal)).is_ok()
            })
        });
        let rows = found.map_err(errors::motion)?;
        let Some(rows) = rows else { return Err(error.expect("a signal stopped it")) };
        let part = |of: fn(&DoubleDouble) -> f64| {
            array(py, rows.iter().flatten().map(of).collect(), [rows.len(), 2 * m.freedom()])
        };
        Ok([part(|x| x.hi)?, part(|x| x.lo)?])
    }

    /// Coordinates and rates of many at their starts.
    fn starts<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        asked: Vec<batch::Asked>,
        p: PyReadonlyArray2<'py, f64>,
        columns: Columns<'py>,
        threads: usize,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
        batch::starts(py, &mut self.of.names(), t, asked, &p, &columns, threads)
    }

    /// The names of the reactions of a batch, as of an evaluator.
    fn reaction_names(&self) -> Vec<String> {
        reaction_names(&self.of.mechanism())
    }

    /// Whether a batch by `rk4` runs side by side.
    fn runs_in_lanes(&self) -> bool {
        freebody::batch::fits_lanes(&self.of.mechanism())
    }

    #[pyo3(signature = (states, span, times, made, threads, method, rtol, step, max_step, route, impacts, painleve, reactions, max_steps=1_000_000))]
    #[allow(clippy::too_many_arguments)]
    fn batch<'py>(
        &self,
        py: Python<'py>,
        states: Rows<'py>,
        span: [f64; 2],
        times: Array<'py>,
        made: PyReadwriteArray3<'py, f64>,
        threads: usize,
        method: &str,
        rtol: f64,
        step: Option<f64>,
        max_step: Option<f64>,
        route: &str,
        impacts: &str,
        painleve: &str,
        reactions: bool,
        max_steps: usize,
    ) -> PyResult<Endings> {
        let options = Options { rtol, first_step: step, max_step: max_step.unwrap_or(f64::INFINITY), max_steps };
        let settings = Settings::named([method, route, impacts, painleve], options).map_err(errors::model)?;
        batch::batch(py, &self.of.mechanism(), &states, span, &times, made, reactions, &settings, threads)
    }
}

/// Whether to go on: no signal from the keyboard, and no refusal by the caller.
fn heard(py: Python<'_>, progress: Option<&Py<PyAny>>, now: f64) -> PyResult<bool> {
    py.check_signals()?;
    match progress {
        None => Ok(true),
        Some(call) => Ok(call.call1(py, (now,))?.extract::<bool>(py).unwrap_or(true)),
    }
}

/// A setting and symbolic questions.
fn questions(setting: &Bound<'_, PyAny>, questions: &Bound<'_, PyAny>) -> PyResult<(Setting, Vec<Query>)> {
    let wrong = |e: serde_json::Error| errors::motion(DynamicsError::WrongQuestion(e.to_string()));
    Ok((data(setting)?.map_err(wrong)?, data(questions)?.map_err(wrong)?))
}

/// The route of a word.
fn route(word: &str) -> PyResult<Route> {
    chosen("route", word, Route::ALL.iter().copied()).map_err(errors::model)
}
