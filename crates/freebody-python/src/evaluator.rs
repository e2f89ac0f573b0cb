//! One mechanism at many states, its memory kept from one to the next.

use crate::data::data;
use crate::errors;
use freebody::compile::Compiled;
use freebody::dynamics::{reaction_names, Workspace};
use numpy::{AllowTypeChange, PyArray1, PyArrayLike1};
use pyo3::prelude::*;
use self_cell::self_cell;
use std::borrow::Cow;

self_cell!(
    struct Owned {
        owner: Compiled,
        #[covariant]
        dependent: Workspace,
    }
);

/// Accelerations and all reactions of a mechanism at one state after another, as arrays; made by `Mechanism.evaluator`.
#[pyclass(module = "freebody")]
pub struct Evaluator {
    owned: Owned,
    /// The names of the coordinates, in the order of q and of the accelerations.
    #[pyo3(get)]
    coordinates: Vec<String>,
    /// The names of the reactions.
    #[pyo3(get)]
    reactions: Vec<String>,
    /// The names of the parameters, in the order of p.
    #[pyo3(get)]
    parameters: Vec<String>,
    p: Vec<f64>,
    /// Accelerations and reactions of the last state, which are handed out as copies.
    found: [Vec<f64>; 2],
}

type Array<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// The numbers of an array, in one piece.
fn numbers<'a>(array: &'a Array<'_>) -> Cow<'a, [f64]> {
    array.as_slice().map_or_else(|_| array.as_array().to_vec().into(), Cow::Borrowed)
}

#[pymethods]
impl Evaluator {
    #[new]
    fn new(spec: &Bound<'_, PyAny>, p: Array<'_>) -> PyResult<Self> {
        let spec = data(spec)?.map_err(|e| {
            errors::ModelError::new_err((String::new(), format!("the model data cannot be read: {e}"), ""))
        })?;
        let compiled = Compiled::new(&spec).map_err(errors::model)?;
        let (m, p) = (&compiled.mechanism, numbers(&p).into_owned());
        m.check_parameters(&p).map_err(errors::motion)?;
        let coordinates: Vec<String> = (0..m.freedom()).map(|i| m.coordinate(i).name.clone()).collect();
        let (reactions, parameters) = (reaction_names(m), m.parameters.iter().map(|p| p.name.clone()).collect());
        let owned = Owned::new(compiled, |compiled| Workspace::new(&compiled.mechanism, &p));
        let found = [vec![0.0; coordinates.len()], vec![0.0; reactions.len()]];
        Ok(Evaluator { owned, coordinates, reactions, parameters, p, found })
    }

    /// Accelerations (n,) of the coordinates, m/s² or rad/s², and reactions (k,), N and N·m, at coordinates `q` (n,), rates `u` (n,), all
    /// parameters `p` (np,), by default those that it was made with, and a time `t`, s.
    ///
    /// A reaction that the balances leave open is NaN. The state decides by itself what touches, is taut or slides. Loops are not closed:
    /// `q` and `u` must keep them. Raises `MotionError`.
    #[pyo3(signature = (q, u, p=None, t=0.0))]
    #[allow(clippy::type_complexity)]
    fn __call__<'py>(
        &mut self,
        py: Python<'py>,
        q: Array<'py>,
        u: Array<'py>,
        p: Option<Array<'py>>,
        t: f64,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>)> {
        let [accelerations, reactions] = &mut self.found;
        let (q, u) = (numbers(&q), numbers(&u));
        let p = p.as_ref().map_or(Cow::Borrowed(&self.p[..]), numbers);
        let mut asked =
            |workspace: &mut Workspace<'_>| workspace.evaluate_at(&p, t, [&*q, &*u], accelerations, reactions);
        self.owned.with_dependent_mut(|_, workspace| asked(workspace)).map_err(errors::motion)?;
        Ok((PyArray1::from_slice(py, &self.found[0]), PyArray1::from_slice(py, &self.found[1])))
    }
}
