//! Gauges: scalars measured from the configuration, their rates and accelerations, and everything else
//! that an expression of a model may read.
//!
//! A gauge is an [`Expr`] over [`ModelVariable`]s. One definition serves springs, drives, couplings, unilateral constraints,
//! events and reports: over plain numbers it gives a value, over jets its rate and acceleration, over
//! duals seeded on one body the load that a unit force along the gauge puts on that body.

mod reading;

pub use reading::{Axis, ContactQuantity, Reading};

use crate::expr::Expr;

/// What the names in an expression stand for, in the end.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelVariable {
    /// A parameter of the model.
    Parameter(usize),
    /// Time, s.
    Time,
    /// The parameter of the curve that is being described.
    Local,
    /// x of a site, m.
    X(usize),
    /// y of a site, m.
    Y(usize),
    /// Angle of a body, rad.
    Angle(usize),
    /// A coordinate of a joint, as its user reads it.
    Coordinate(usize, usize),
    /// A quantity with a rate of its own.
    State(usize),
    /// Something that is known only when the instant is solved.
    Reading(Reading),
}

/// An expression of a model.
pub type ModelExpr = Expr<ModelVariable>;

/// Whether an expression is measured from the configuration and time alone, so that jets give its derivatives.
pub fn is_measured(of: &ModelExpr) -> bool {
    let measured = |variable: &ModelVariable| !matches!(variable, ModelVariable::Reading(_) | ModelVariable::State(_));
    !of.depends_on_rates() && of.variables().all(measured)
}
