//! One solved instant.

use crate::array;
use freebody::balance;
use freebody::mechanism::Mechanism;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// One instant, solved.
#[pyclass(frozen)]
pub struct Instant {
    pub solved: balance::Instant,
    pub rank: String,
    /// Row of each body of the model.
    pub order: Vec<usize>,
    /// Which drives are prescribed motions.
    pub motions: Vec<usize>,
}

#[pymethods]
impl Instant {
    #[getter]
    fn accelerations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.solved.accelerations)
    }
    #[getter]
    fn body_accelerations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_body(py, &self.solved.bodies)
    }
    #[getter]
    fn body_residuals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.by_body(py, &self.solved.residuals)
    }
    #[getter]
    fn reactions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let sure = |x: f64, sure: bool| if sure { x } else { f64::NAN };
        let loads = self.loads().into_iter().zip(&self.solved.determinate);
        let flat = loads.flat_map(|(l, s)| [sure(l[0], s[0]), sure(l[1], s[1]), sure(l[2], s[2])]).collect();
        array(py, flat, [self.solved.joints.len(), 3])
    }
    #[getter]
    fn least_reactions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        array(py, self.loads().concat(), [self.solved.joints.len(), 3])
    }
    #[getter]
    fn determinate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<bool>>> {
        PyArray1::from_vec(py, self.solved.determinate.concat()).reshape([self.solved.joints.len(), 3])
    }
    /// Direction of the first body's marker at each joint, rad.
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.solved.joints.iter().map(|l| l.axes).collect())
    }
    /// Where each reaction acts, fixed axes, m.
    #[getter]
    fn places<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.solved.joints.iter().flat_map(|l| [l.point.x, l.point.y]).collect();
        array(py, flat, [self.solved.joints.len(), 2])
    }
    #[getter]
    fn motions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let sure = |d: usize| if self.solved.drives_determinate[d] { self.solved.drives[d] } else { f64::NAN };
        PyArray1::from_vec(py, self.motions.iter().map(|&d| sure(d)).collect())
    }
    #[getter]
    fn residual(&self) -> f64 {
        self.solved.residual
    }
    /// Largest force (N) and acceleration (m/s²) among the terms that balance.
    #[getter]
    fn sizes(&self) -> (f64, f64) {
        (self.solved.sizes.load, self.solved.sizes.acceleration)
    }
    /// JSON, one for each contact, stop and string.
    #[getter]
    fn limits(&self) -> String {
        let told = |l: &balance::LimitLoad| {
            serde_json::json!({
                "state": l.state, "gap": l.gap, "normal": l.along[0], "friction": l.along[1],
                "force": [l.force.x, l.force.y], "at": l.at.map(|p| [p.x, p.y]), "determinate": l.determinate,
            })
        };
        serde_json::Value::Array(self.solved.limits.iter().map(told).collect()).to_string()
    }
    #[getter]
    fn rank(&self) -> &str {
        &self.rank
    }
}

impl Instant {
    pub fn new(m: &Mechanism, solved: balance::Instant, freedom: &balance::Freedom) -> Self {
        let rank = rank_json(freedom, &solved.self_stress);
        let motions = (0..m.drives.len()).filter(|&d| !m.drives[d].coupling).collect();
        Instant { solved, rank, order: m.listed_bodies(), motions }
    }
    fn loads(&self) -> Vec<[f64; 3]> {
        self.solved.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect()
    }
    fn by_body<'py>(&self, py: Python<'py>, rows: &[[f64; 3]]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.order.iter().flat_map(|&body| rows[body - 1]).collect();
        array(py, flat, [self.order.len(), 3])
    }
}

fn rank_json(f: &balance::Freedom, stresses: &[String]) -> String {
    serde_json::json!({
        "freedom": f.here, "count": f.count, "rows": f.rows, "redundant": f.redundant, "always_redundant": f.always_redundant, "driven": f.driven,
        "uncertain": f.uncertain, "explanation": f.explain(), "self_stress": stresses,
    })
    .to_string()
}
