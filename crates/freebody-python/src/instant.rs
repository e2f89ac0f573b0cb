//! One solved instant as arrays by name; `freebody.core.Solution` says what they are.

use crate::data::{array, plain};
use crate::errors;
use freebody::dynamics::{Instant, Route, Workspace};
use freebody::mechanism::{DriveKind, Mechanism};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Values of each body, in the order of the model.
fn by_body<'py>(py: Python<'py>, m: &Mechanism, rows: &[[f64; 3]]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let order = m.listed_bodies();
    array(py, order.iter().flat_map(|&b| rows[b - 1]).collect(), [order.len(), 3])
}

/// What is asked for at every instant.
pub fn solution<'py>(py: Python<'py>, m: &Mechanism, solved: &Instant) -> PyResult<Bound<'py, PyDict>> {
    let joints: Vec<usize> = m.listed_joints().collect();
    let loads = joints.iter().map(|&joint| &solved.joints[joint]);
    let least: Vec<f64> = loads.flat_map(|l| [l.force.x, l.force.y, l.couple]).collect();
    let determinate: Vec<bool> = joints.iter().flat_map(|&joint| solved.determinate[joint]).collect();
    let missing = joints.iter().filter(|joint| !solved.joints_in_place.contains(joint));
    let released: Vec<&str> = missing.map(|&joint| m.joints[joint].name.as_str()).collect();
    let joints = joints.len();
    let known = |(x, sure): (&f64, &bool)| if *sure { *x } else { f64::NAN };
    // Of locks only those in place.
    let is_in_place = |d: &usize| m.drives[*d].kind != DriveKind::Lock || solved.drives_in_place.contains(d);
    let drives = |kind: DriveKind| -> PyResult<Bound<'py, PyDict>> {
        let forces = PyDict::new(py);
        for d in (0..m.drives.len()).filter(|&d| m.drives[d].kind == kind).filter(is_in_place) {
            forces.set_item(&m.drives[d].name, known((&solved.drives[d], &solved.drives_determinate[d])))?;
        }
        Ok(forces)
    };
    let answer = PyDict::new(py);
    answer.set_item("accelerations", array(py, solved.accelerations.clone(), [solved.accelerations.len()])?)?;
    answer.set_item("body_accelerations", by_body(py, m, &solved.bodies)?)?;
    answer.set_item("reactions", array(py, least.iter().zip(&determinate).map(known).collect(), [joints, 3])?)?;
    answer.set_item("least_reactions", array(py, least, [joints, 3])?)?;
    answer.set_item("determinate", array(py, determinate, [joints, 3])?)?;
    answer.set_item("released", released)?;
    answer.set_item("motions", drives(DriveKind::Motion)?)?;
    answer.set_item("couplings", drives(DriveKind::Coupling)?)?;
    answer.set_item("locks", drives(DriveKind::Lock)?)?;
    answer.set_item("limits", plain(py, &solved.contacts())?)?;
    Ok(answer)
}

/// How well it balances, and its rank: what takes longer than the solution.
pub fn balances<'py>(py: Python<'py>, mut workspace: Workspace<'_>, route: Route) -> PyResult<Bound<'py, PyDict>> {
    let solved = workspace.instant(route).map_err(errors::motion)?;
    let found = workspace.balances();
    let answer = PyDict::new(py);
    answer.set_item("body_residuals", by_body(py, workspace.m, &found.residuals)?)?;
    answer.set_item("residual", found.residual)?;
    answer.set_item("sizes", (found.sizes.load, found.sizes.acceleration))?;
    answer.set_item("rank", plain(py, &solved.rank(&workspace.freedom()))?)?;
    Ok(answer)
}
