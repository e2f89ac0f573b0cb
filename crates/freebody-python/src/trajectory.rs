//! A finished run.

use crate::instant::Instant;
use crate::mechanism::Shared;
use crate::{array, errors};
use freebody::letters::answer;
use freebody::motion::{Happening, Kind};
use freebody::simulation;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use std::sync::Arc;

/// A finished run with dense output.
#[pyclass(frozen)]
pub struct Trajectory {
    pub of: Arc<Shared>,
    pub run: simulation::Trajectory,
}

#[pymethods]
impl Trajectory {
    #[getter]
    fn steps<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.run.steps)
    }
    #[getter]
    fn events(&self) -> String {
        let m = self.of.mechanism();
        let n = m.freedom();
        let told = |h: &Happening| {
            let kind = match h.kind {
                Kind::Crossing => "crossing",
                Kind::Touch => "touch",
                Kind::Opening => "start",
            };
            serde_json::json!({
                "name": m.events[h.index].name, "t": h.t, "kind": kind,
                "direction": h.direction, "q": h.y[..n], "u": h.y[n..2 * n],
            })
        };
        serde_json::Value::Array(self.run.events.iter().map(told).collect()).to_string()
    }
    /// Everything about one time, by a route.
    #[pyo3(signature = (t, route="minimal"))]
    fn instant(&self, t: f64, route: &str) -> PyResult<Instant> {
        let m = self.of.mechanism();
        let route = crate::mechanism::route(route)?;
        let (solved, freedom) = self.run.instant(&m, t, route).map_err(errors::motion)?;
        Ok(Instant::new(&m, solved, &freedom))
    }
    /// Bodies and loads of the free-body diagrams at one time, in numbers, as JSON.
    fn free_bodies(&self, t: f64) -> PyResult<String> {
        let told = self.run.at(&self.of.mechanism(), t, freebody::free_bodies::free_bodies);
        Ok(told.map_err(errors::motion)?.to_string())
    }
    /// Answers in letters to questions about one time; see `Mechanism.letters`.
    fn letters(&self, t: f64, setting: &str, questions: &str) -> PyResult<String> {
        let (setting, questions) = crate::mechanism::questions(setting, questions)?;
        let told = self.run.at(&self.of.mechanism(), t, |balance| answer(balance, &setting, &questions));
        Ok(told.map_err(errors::motion)?.to_string())
    }
    /// Bodies and loads during a blow, given by its place among `changes`: those of what was struck are told for a unit.
    fn free_bodies_of_blow(&self, change: usize) -> PyResult<String> {
        let told = self.run.at_blow(&self.of.mechanism(), change, |balance| {
            // What strikes at several places moves there as no constraint allows; where impulses act does not depend on it.
            balance.stand_still();
            freebody::free_bodies::free_bodies(balance)
        });
        Ok(told.map_err(errors::motion)?.to_string())
    }
    /// Answers in letters to questions about a blow, with the rates before it.
    fn letters_of_blow(&self, change: usize, setting: &str, questions: &str) -> PyResult<String> {
        let (setting, questions) = crate::mechanism::questions(setting, questions)?;
        let told = self.run.at_blow(&self.of.mechanism(), change, |balance| answer(balance, &setting, &questions));
        Ok(told.map_err(errors::motion)?.to_string())
    }
    #[getter]
    fn changes(&self) -> String {
        let m = self.of.mechanism();
        let n = m.freedom();
        let told = |c: &simulation::Change| {
            let state = |y: &Vec<f64>| serde_json::json!({"q": y[..n], "u": y[n..2 * n]});
            let impulses = c.impulses.as_ref().map(|i| {
                let limits: Vec<_> = i.limits.iter().map(|(name, p)| serde_json::json!([name, [p.x, p.y]])).collect();
                let struck: Vec<_> = i.struck.iter().map(struck).collect();
                serde_json::json!({"limits": limits, "joints": i.joints, "struck": struck, "spared": i.spared})
            });
            serde_json::json!({
                "t": c.t, "kind": c.kind, "of": c.of, "lost": c.lost, "note": c.note, "impulses": impulses,
                "before": c.states.as_ref().map(|s| state(&s[0])), "after": c.states.as_ref().map(|s| state(&s[1])),
            })
        };
        serde_json::Value::Array(self.run.changes.iter().map(told).collect()).to_string()
    }
    #[getter]
    fn outcome(&self) -> String {
        let o = &self.run.outcome;
        let sentence = match o {
            freebody::motion::Outcome::StoppedByEvent { index } => {
                format!("the event `{}` ended the run", self.of.mechanism().events[*index].name)
            }
            freebody::motion::Outcome::Chatter { index } => format!(
                "the {} comes back again and again within one instant; change what happens there, or loosen the tolerance",
                simulation::Machine::switch_name(&self.of.mechanism(), *index)
            ),
            other => other.to_string(),
        };
        let path = match o {
            freebody::motion::Outcome::Trouble(trouble) => trouble.path.as_deref(),
            _ => None,
        };
        serde_json::json!({"name": o.name(), "ok": o.is_ok(), "t": self.run.steps.last(), "sentence": sentence, "path": path.unwrap_or("")})
            .to_string()
    }
    #[getter]
    fn stats(&self) -> String {
        let r = &self.run;
        serde_json::json!({
            "accepted": r.counts[0], "rejected": r.counts[1], "evaluations": r.counts[2], "kinks": r.kinks,
            "method": r.settings.method, "rtol": r.settings.options.rtol, "closure": r.worst_gap, "stiff_since": r.stiff_since,
        })
        .to_string()
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
        Ok((array(py, values, shape)?, PyArray1::from_vec(py, sure).reshape(shape)?))
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
    #[allow(clippy::type_complexity)]
    fn r#final<'py>(
        &self,
        py: Python<'py>,
    ) -> (f64, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, String) {
        let (t, q, u, p) = self.run.end(&self.of.mechanism());
        let list = |v: &[f64]| PyArray1::from_slice(py, v);
        (t, list(&q), list(&u), list(&p), "{}".to_string())
    }
}

fn struck(s: &simulation::Struck) -> serde_json::Value {
    serde_json::json!({"name": s.name, "normal": s.normal, "tangent": s.tangent, "restitution": s.restitution})
}
