//! Python bindings: a method forwards, or it is wrong. `python/freebody/_core.pyi` is the contract.

mod errors;
mod instant;
mod mechanism;
mod trajectory;

use freebody::balance::Balance;
use freebody::compile::{coupling_card, Compiled};
use freebody::joints::{Joint, Kind};
use freebody::scalar::real::sin_cos;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::hint::black_box;
use std::time::Instant;

/// The syntax tree of an expression, as JSON.
#[pyfunction]
fn parse(text: &str) -> PyResult<String> {
    freebody::expr::parse(text).map(|ast| json(&ast)).map_err(|e| errors::expression(text, e))
}

/// The cards of all joints, forces and shapes, as JSON.
#[pyfunction]
fn cards() -> String {
    let joints: Vec<_> = Kind::ALL.iter().map(|k| k.card()).chain([coupling_card()]).collect();
    let forces: Vec<_> = freebody::forces::ALL.iter().map(|f| f.card()).collect();
    let shapes: Vec<_> = freebody::shapes::SHAPES
        .iter()
        .map(|(word, _, sizes)| serde_json::json!({"type": word, "sizes": sizes}))
        .collect();
    serde_json::json!({"joints": joints, "forces": forces, "shapes": shapes}).to_string()
}

/// Seconds for one acceleration solve with all reactions of a chain of `n` hinged uniform bars; for benchmarks.
#[pyfunction]
fn time_chain(n: usize, repeats: usize) -> PyResult<f64> {
    let compiled = Compiled::new(&freebody::benchmark::chain_model(n)).map_err(errors::model)?;
    let mut balance = Balance::new(&compiled.mechanism, &[]);
    let q: Vec<f64> = (0..n).map(|i| 0.1 * sin_cos(i as f64).0).collect();
    let u: Vec<f64> = (0..n).map(|i| 0.2 * sin_cos(i as f64).1).collect();
    let mut u_dot = vec![0.0; n];
    let mut solve = || {
        balance.place(0.0, black_box(&q), &u);
        let solved = balance.solve();
        balance.accelerations(&mut u_dot);
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

fn json(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("plain data")
}

/// A two- or three-dimensional array from equal rows laid end to end.
fn array<'py, D: numpy::ndarray::Dimension>(
    py: Python<'py>,
    flat: Vec<f64>,
    shape: impl numpy::ndarray::IntoDimension<Dim = D>,
) -> PyResult<Bound<'py, numpy::PyArray<f64, D>>> {
    PyArray1::from_vec(py, flat).reshape(shape)
}

/// The compiled core of freebody.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(parse, m)?)?;
    m.add_function(wrap_pyfunction!(cards, m)?)?;
    m.add_function(wrap_pyfunction!(time_chain, m)?)?;
    m.add_class::<mechanism::Mechanism>()?;
    m.add_class::<instant::Instant>()?;
    m.add_class::<trajectory::Trajectory>()?;
    errors::register(m)
}
