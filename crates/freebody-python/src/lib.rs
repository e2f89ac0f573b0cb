//! Python bindings: a method forwards, or it is wrong. `python/freebody/core/` is all that speaks with them.

mod batch;
mod data;
mod errors;
mod evaluator;
mod instant;
mod mechanism;
mod trajectory;

use freebody::compile::Compiled;
use freebody::dynamics::Workspace;
use freebody::scalar::real::sin_cos;
use pyo3::prelude::*;
use std::hint::black_box;
use std::time::Instant;

/// The syntax tree of an expression.
#[pyfunction]
fn parse<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let tree = freebody::expr::parse(text).map_err(|e| errors::expression(text, e))?;
    data::plain(py, &serde_json::to_value(tree).expect("plain data"))
}

/// The cards of all joints, forces and shapes.
#[pyfunction]
fn cards(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    data::plain(py, &freebody::metadata::cards())
}

/// Seconds for one acceleration solve with all reactions of a chain of `n` hinged uniform bars; for benchmarks.
#[pyfunction]
fn time_chain(n: usize, repeats: usize) -> PyResult<f64> {
    let compiled = Compiled::new(&freebody::benchmark::chain_model(n)).map_err(errors::model)?;
    let mut workspace = Workspace::new(&compiled.mechanism, &[]);
    let mut q: Vec<f64> = (0..n).map(|i| 0.1 * sin_cos(i as f64).0).collect();
    let u: Vec<f64> = (0..n).map(|i| 0.2 * sin_cos(i as f64).1).collect();
    let mut u_dot = vec![0.0; n];
    let mut solve = || {
        // Every solve is a new one: a state that is the same is not placed again.
        q[0] += 1e-9;
        workspace.move_to(0.0, black_box(&q), &u);
        let solved = workspace.solve();
        workspace.accelerations(&mut u_dot);
        black_box(&u_dot);
        solved
    };
    solve().map_err(errors::motion)?;
    let start = Instant::now();
    for _ in 0..repeats.max(1) {
        solve().map_err(errors::motion)?;
    }
    Ok(start.elapsed().as_secs_f64() / repeats.max(1) as f64)
}

/// The compiled core of freebody.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(parse, m)?)?;
    m.add_function(wrap_pyfunction!(cards, m)?)?;
    m.add_function(wrap_pyfunction!(time_chain, m)?)?;
    m.add_class::<evaluator::Evaluator>()?;
    m.add_class::<mechanism::History>()?;
    m.add_class::<mechanism::Mechanism>()?;
    m.add_class::<trajectory::Trajectory>()
}
