//! A compiled mechanism.

use crate::instant::Instant;
use crate::trajectory::Trajectory;
use crate::{array, errors, json};
use freebody::assembly::{assemble, Wish};
use freebody::balance::{Balance, Observer, Route, Trouble};
use freebody::compile::Compiled;
use freebody::gauges::Law;
use freebody::letters::{answer, Question, Setting};
use freebody::simulation::{simulate, Rule, Settings, Start};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, RwLock, RwLockReadGuard};

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
    pub fn observables(&self, texts: &[String]) -> PyResult<Vec<Law>> {
        let mut compiled = self.0.write().expect("no thread panics while it holds the mechanism");
        texts.iter().map(|text| compiled.observable(text).map_err(errors::model)).collect()
    }
}

/// A compiled model: topology without numbers.
#[pyclass(frozen)]
pub struct Mechanism(Arc<Shared>);

type Named = BTreeMap<String, f64>;

#[pymethods]
impl Mechanism {
    #[new]
    fn new(spec: &str) -> PyResult<Self> {
        let spec = serde_json::from_str(spec).map_err(|e| {
            errors::ModelError::new_err((String::new(), format!("the model data cannot be read: {e}"), ""))
        })?;
        let compiled = Compiled::new(&spec).map_err(errors::model)?;
        Ok(Mechanism(Arc::new(Shared(RwLock::new(compiled)))))
    }

    fn describe(&self) -> String {
        freebody::describe::describe(&self.0.mechanism()).to_string()
    }

    fn bind<'py>(&self, py: Python<'py>, values: Named) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let m = self.0.mechanism();
        let mut given = vec![];
        for (name, value) in &values {
            let i = m.parameters.iter().position(|p| p.name == *name);
            given.push((i.ok_or_else(|| unknown("parameter", name, m.parameters.iter().map(|p| &p.name)))?, *value));
        }
        let p = m.parameters_with(&given);
        m.check(&p).map_err(errors::model)?;
        Ok(PyArray1::from_vec(py, p))
    }

    #[pyo3(signature = (p, t=0.0, fixed=Named::new(), guess=Named::new(), rates=Named::new(), points=BTreeMap::new(), branch=BTreeMap::new()))]
    #[allow(clippy::too_many_arguments, clippy::type_complexity)]
    fn assemble<'py>(
        &self,
        py: Python<'py>,
        p: PyReadonlyArray1<f64>,
        t: f64,
        fixed: Named,
        guess: Named,
        rates: Named,
        points: BTreeMap<String, Vec<f64>>,
        branch: BTreeMap<String, i64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, String)> {
        let wish = self.wish(&fixed, &guess, &rates, &points, &branch)?;
        let m = self.0.mechanism();
        let mut balance = Balance::new(&m, p.as_slice()?);
        let found = assemble(&mut balance, t, &wish).map_err(errors::motion)?;
        let told = |q: &[f64]| -> String {
            let each = q.iter().enumerate().map(|(i, x)| format!("{} = {x:.6}", m.coordinate(i).name));
            each.collect::<Vec<_>>().join(", ")
        };
        let branches: Vec<String> = match found.others.is_empty() {
            true => vec![],
            false => {
                let taken = format!("taken: {}", told(&found.q));
                std::iter::once(taken)
                    .chain(found.others.iter().map(|o| format!("another assembly: {}", told(o))))
                    .collect()
            }
        };
        let adjusted: Vec<String> = m
            .coordinates
            .iter()
            .enumerate()
            .filter_map(|(i, _)| {
                let name = &m.coordinate(i).name;
                let asked = guess.get(name)?;
                ((asked - found.q[i]).abs() > 1e-9)
                    .then(|| format!("{name}: guess {asked:.6}, assembled {:.9}", found.q[i]))
            })
            .collect();
        let notes = serde_json::json!({"branch": branches, "adjusted": adjusted, "gap": found.gap});
        Ok((PyArray1::from_vec(py, found.q), PyArray1::from_vec(py, found.u), notes.to_string()))
    }

    #[pyo3(signature = (p, t, q, u, route="minimal"))]
    fn instant(
        &self,
        p: PyReadonlyArray1<f64>,
        t: f64,
        q: PyReadonlyArray1<f64>,
        u: PyReadonlyArray1<f64>,
        route: &str,
    ) -> PyResult<Instant> {
        let m = self.0.mechanism();
        let route = self::route(route)?;
        let mut balance = self.placed(&m, &p, t, &q, &u)?;
        let solved = balance.instant(route).map_err(errors::motion)?;
        let freedom = balance.freedom();
        Ok(Instant::new(&m, solved, &freedom))
    }

    /// Bodies and loads of the free-body diagrams at a state, in numbers, as JSON.
    fn free_bodies(
        &self,
        p: PyReadonlyArray1<f64>,
        t: f64,
        q: PyReadonlyArray1<f64>,
        u: PyReadonlyArray1<f64>,
    ) -> PyResult<String> {
        let m = self.0.mechanism();
        let mut balance = self.placed(&m, &p, t, &q, &u)?;
        Ok(freebody::free_bodies::free_bodies(&mut balance).map_err(errors::motion)?.to_string())
    }

    /// Answers in letters to questions about a state: `setting` and `questions` as JSON, the answers as JSON.
    fn letters(
        &self,
        p: PyReadonlyArray1<f64>,
        t: f64,
        q: PyReadonlyArray1<f64>,
        u: PyReadonlyArray1<f64>,
        setting: &str,
        questions: &str,
    ) -> PyResult<String> {
        let m = self.0.mechanism();
        let mut balance = self.placed(&m, &p, t, &q, &u)?;
        let (setting, questions) = self::questions(setting, questions)?;
        Ok(answer(&mut balance, &setting, &questions).map_err(errors::motion)?.to_string())
    }

    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        texts: Vec<String>,
        p: PyReadonlyArray1<f64>,
        t: f64,
        q: PyReadonlyArray1<f64>,
        u: PyReadonlyArray1<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let laws = self.0.observables(&texts)?;
        let m = self.0.mechanism();
        let mut balance = self.placed(&m, &p, t, &q, &u)?;
        let laws: Vec<&Law> = laws.iter().collect();
        let mut observer = Observer::new(&mut balance, laws.iter().copied());
        observer.place(t, q.as_slice()?, u.as_slice()?).map_err(errors::motion)?;
        Ok(PyArray1::from_vec(py, observer.read(&laws, &[])))
    }

    fn points(&self, p: PyReadonlyArray1<f64>) -> PyResult<String> {
        let m = self.0.mechanism();
        Ok(json(&freebody::describe::places(&m, &m.bind(p.as_slice()?))))
    }

    /// Mass matrix of the tree in the coordinates of `q`, (n, n).
    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        p: PyReadonlyArray1<f64>,
        q: PyReadonlyArray1<f64>,
    ) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
        let m = self.0.mechanism();
        let n = m.freedom();
        let flat = freebody::simulation::mass_matrix(&m, p.as_slice()?, q.as_slice()?);
        array(py, flat, [n, n])
    }

    #[pyo3(signature = (p, t, q, u, until, method="dop853", rtol=1e-9, step=None, max_step=None, route="auto", max_steps=1_000_000, progress=None, impacts="stop", painleve="stop", after=None))]
    #[allow(clippy::too_many_arguments)]
    fn simulate(
        &self,
        py: Python<'_>,
        p: PyReadonlyArray1<f64>,
        t: f64,
        q: PyReadonlyArray1<f64>,
        u: PyReadonlyArray1<f64>,
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
        after: Option<PyRef<'_, Trajectory>>,
    ) -> PyResult<Trajectory> {
        let mode = after.map(|run| run.run.end_mode().clone());
        let words: Vec<&str> = Rule::ALL.iter().map(|r| r.0).collect();
        one_of("law of impacts", impacts, &words)?;
        let impacts = Rule::named(impacts).unwrap_or(Rule::Stop);
        one_of("answer to a jam of friction", painleve, &["stop", "impact"])?;
        let options = freebody::motion::Options {
            rtol,
            first_step: step,
            max_step: max_step.unwrap_or(f64::INFINITY),
            max_steps,
        };
        let settings = Settings {
            method: method.to_string(),
            options,
            route: chosen(route)?,
            impacts,
            jams_strike: painleve == "impact",
        };
        let (p, q, u) = (p.as_slice()?.to_vec(), q.as_slice()?.to_vec(), u.as_slice()?.to_vec());
        let of = self.0.clone();
        let mut trouble = None;
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
                    trouble = Some(e);
                    false
                })
            })
        });
        match trouble {
            Some(error) => Err(error),
            None => Ok(Trajectory { of: self.0.clone(), run: run.map_err(errors::motion)? }),
        }
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

/// A setting and questions in letters, from JSON.
pub fn questions(setting: &str, questions: &str) -> PyResult<(Setting, Vec<Question>)> {
    let wrong = |e: serde_json::Error| errors::motion(Trouble::new("wrong_question", e.to_string()));
    Ok((serde_json::from_str(setting).map_err(wrong)?, serde_json::from_str(questions).map_err(wrong)?))
}

/// The route of a word.
pub fn route(word: &str) -> PyResult<Route> {
    let words: Vec<String> = Route::ALL.iter().map(|r| r.0.to_string()).collect();
    Route::named(word).ok_or_else(|| unknown("route", word, words.iter()))
}

/// The route of a word; None to leave the choice to the program.
fn chosen(word: &str) -> PyResult<Option<Route>> {
    if word == "auto" {
        return Ok(None);
    }
    let words: Vec<String> = Route::ALL.iter().map(|r| r.0.to_string()).chain(["auto".to_string()]).collect();
    Route::named(word).map(Some).ok_or_else(|| unknown("route", word, words.iter()))
}

/// Complains about a word that is none of those.
fn one_of(what: &str, word: &str, words: &[&str]) -> PyResult<()> {
    let words: Vec<String> = words.iter().map(|w| w.to_string()).collect();
    if words.iter().any(|w| w == word) {
        return Ok(());
    }
    Err(unknown(what, word, words.iter()))
}

fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a String>) -> PyErr {
    let message = freebody::builder::unknown(what, name, known);
    errors::ModelError::new_err((name.to_string(), message.what, message.hint))
}

impl Mechanism {
    fn placed<'m>(
        &self,
        m: &'m freebody::mechanism::Mechanism,
        p: &PyReadonlyArray1<f64>,
        t: f64,
        q: &PyReadonlyArray1<f64>,
        u: &PyReadonlyArray1<f64>,
    ) -> PyResult<Balance<'m>> {
        let (q, u) = (q.as_slice()?, u.as_slice()?);
        if q.len() != m.freedom() || u.len() != m.freedom() || p.len()? != m.parameters.len() {
            let sizes =
                format!("{} parameters, {} coordinates and as many rates are needed", m.parameters.len(), m.freedom());
            return Err(errors::motion(Trouble::new("wrong_size", sizes)));
        }
        let mut balance = Balance::new(m, p.as_slice()?);
        balance.place(t, q, u);
        balance.lean().map_err(errors::motion)?;
        Ok(balance)
    }

    /// What an initial state is asked to be, with names looked up.
    fn wish(
        &self,
        fixed: &Named,
        guess: &Named,
        rates: &Named,
        points: &BTreeMap<String, Vec<f64>>,
        branch: &BTreeMap<String, i64>,
    ) -> PyResult<Wish> {
        let texts = |names: Vec<String>| self.0.observables(&names);
        let spelled = |named: &Named| named.keys().map(|k| freebody::expr::spell(k).into_owned()).collect::<Vec<_>>();
        let (held, near, held_rates) = (texts(spelled(fixed))?, texts(spelled(guess))?, texts(spelled(rates))?);
        let branches: Vec<String> = branch.keys().cloned().collect();
        let signs = texts(branches.clone())?;
        let places: Vec<(String, f64)> = points
            .iter()
            .flat_map(|(name, xy)| {
                let spelled = freebody::expr::spell(name).into_owned();
                [(format!("x({spelled})"), xy[0]), (format!("y({spelled})"), xy[1])]
            })
            .collect();
        let placed = texts(places.iter().map(|p| p.0.clone()).collect())?;
        let m = self.0.mechanism();
        let mut wish = Wish { start: vec![0.0; m.freedom()], start_rates: vec![0.0; m.freedom()], ..Wish::default() };
        wish.free = vec![true; m.freedom()];
        for i in 0..m.freedom() {
            let name = &m.coordinate(i).name;
            wish.start[i] = *fixed.get(name).or_else(|| guess.get(name)).unwrap_or(&0.0);
            wish.start_rates[i] = *rates.get(name).unwrap_or(&0.0);
            wish.free[i] = !fixed.contains_key(name);
        }
        let in_tree = |name: &String| (0..m.freedom()).any(|i| m.coordinate(i).name == *name);
        wish.held.extend(fixed.iter().zip(held).map(|((name, x), law)| (name.clone(), law, *x)));
        wish.held.extend(places.iter().zip(placed).map(|((name, x), law)| (name.clone(), law, *x)));
        wish.near.extend(guess.iter().zip(near).filter(|((name, _), _)| !in_tree(name)).map(|((_, x), law)| (law, *x)));
        wish.held_rates.extend(rates.iter().zip(held_rates).map(|((name, x), law)| (name.clone(), law, *x)));
        wish.branch
            .extend(branch.iter().zip(signs).map(|((text, sign), law)| (text.clone(), law, sign.signum() as i8)));
        Ok(wish)
    }
}
