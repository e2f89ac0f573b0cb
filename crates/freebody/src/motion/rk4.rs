//! The classical Runge–Kutta method, for comparison.

use super::explicit::{Explicit, Table};
use super::method::Method;

/// Kutta (1901), *Zeitschrift für Mathematik und Physik* 46, 435; HNW I, table II.1.2.
pub(super) const METHOD: Method = Method {
    name: "rk4",
    citation: "Kutta 1901; Hairer, Nørsett & Wanner, Solving ODEs I, II.1",
    order: 4,
    dense_order: 3,
    estimate_order: None,
    symplectic: false,
    analytic: false,
    implicit: false,
    stage_gap: 0.25,
    stepper: |n| Explicit::boxed(&TABLE, n),
};

pub(super) static TABLE: Table = Table {
    c: &[0.5, 0.5, 1.0],
    a: &[&[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    errors: &[],
    more_c: &[],
    more_a: &[],
    dense: &[],
    stability: None,
};
