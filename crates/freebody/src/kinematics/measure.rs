//! What expressions read of a state.

use super::{MotionView, Poses, SeededView, StateView};
use crate::expr::Env;
use crate::gauges::{ModelExpr, ModelVariable, Reading};
use crate::mechanism::Mechanism;
use crate::mode::Mode;
use crate::plane::{Twist, Wrench};
use crate::scalar::{Dual, Jet, Scalar};

/// A configuration as an environment of expressions without time derivatives.
pub struct Config<'a, P> {
    /// Where everything is.
    pub poses: &'a P,
    /// The mechanism, for its tables.
    pub m: &'a Mechanism,
    /// Which arms of switches are frozen.
    pub mode: &'a Mode,
}

impl<T: Scalar, P: Poses<T>> Env<T, ModelVariable> for Config<'_, P> {
    fn variable(&self, variable: &ModelVariable) -> T {
        let p = self.poses;
        match variable {
            ModelVariable::Parameter(i) => p.parameter(*i),
            ModelVariable::State(i) => p.state(*i),
            ModelVariable::Time => p.time(),
            ModelVariable::X(site) => p.place(*site, self.m).x,
            ModelVariable::Y(site) => p.place(*site, self.m).y,
            ModelVariable::Angle(body) => p.pose(*body).turn.angle,
            ModelVariable::Coordinate(joint, k) => p.coordinate(*joint, *k),
            ModelVariable::Local | ModelVariable::Reading(_) => {
                unreachable!("{variable:?} in an expression of the configuration")
            }
        }
    }
    fn rate(&self, _: &ModelExpr) -> T {
        unreachable!("a time derivative in an expression of the configuration")
    }
    fn accel(&self, _: &ModelExpr) -> T {
        unreachable!("a time derivative in an expression of the configuration")
    }
    fn table(&self, table: usize, x: T) -> T {
        self.m.tables[table].eval(x)
    }
    fn branch(&self, discontinuity: usize) -> Option<bool> {
        self.mode.branch(discontinuity)
    }
}

/// A state as an environment of laws, which may read rates.
pub struct State<'a, S>(pub StateView<'a, S>);

impl<S: Scalar> Env<S, ModelVariable> for State<'_, S> {
    fn variable(&self, variable: &ModelVariable) -> S {
        Config { poses: &self.0, m: self.0.m, mode: self.0.mode }.variable(variable)
    }
    fn rate(&self, of: &ModelExpr) -> S {
        jet(&MotionView { at: self.0, bodies: None, accelerations: None }, of).d1
    }
    fn accel(&self, _: &ModelExpr) -> S {
        unreachable!("an acceleration in a law")
    }
    fn table(&self, table: usize, x: S) -> S {
        self.0.m.tables[table].eval(x)
    }
    fn branch(&self, discontinuity: usize) -> Option<bool> {
        self.0.mode.branch(discontinuity)
    }
}

/// The load on `body`, at its joint origin, of a unit force along a gauge.
pub fn gradient<S: Scalar>(at: StateView<'_, S>, gauge: &ModelExpr, body: usize) -> Wrench<S> {
    let seeded = SeededView { at, body };
    let value: Dual<3, S> = gauge.eval(&Config { poses: &seeded, m: at.m, mode: at.mode });
    Wrench::from_parts(value.du)
}

/// A gauge with its rate and acceleration, for given accelerations of the bodies.
pub fn jet<S: Scalar>(moving: &MotionView<'_, S>, gauge: &ModelExpr) -> Jet<S> {
    gauge.eval(&Config { poses: moving, m: moving.at.m, mode: moving.at.mode })
}

/// A solved instant as an environment of expressions.
pub struct Observed<'a, S = f64> {
    /// The state.
    pub at: StateView<'a, S>,
    /// Accelerations of joint origins and angles.
    pub bodies: &'a [Twist<S>],
    /// Accelerations of the coordinates.
    pub accelerations: &'a [S],
    /// What a reading is.
    pub read: &'a dyn Fn(Reading) -> S,
    /// Expressions that are not measured from the configuration alone, with their time derivatives.
    pub rates: &'a [(&'a ModelExpr, S)],
}

impl<S: Scalar> Observed<'_, S> {
    fn moving(&self) -> MotionView<'_, S> {
        MotionView { at: self.at, bodies: Some(self.bodies), accelerations: Some(self.accelerations) }
    }
}

/// Whether jets give the time derivative of an expression: it has no rates and nothing that is found by solving an instant.
fn reads_nothing(of: &ModelExpr) -> bool {
    !of.depends_on_rates() && of.variables().all(|variable| !matches!(variable, ModelVariable::Reading(_)))
}

impl<S: Scalar> Env<S, ModelVariable> for Observed<'_, S> {
    fn variable(&self, variable: &ModelVariable) -> S {
        match variable {
            ModelVariable::Parameter(i) => self.at.parameter(*i),
            ModelVariable::State(i) => self.at.state(*i),
            ModelVariable::Time => self.at.t,
            ModelVariable::X(site) => self.at.site(*site).x,
            ModelVariable::Y(site) => self.at.site(*site).y,
            ModelVariable::Angle(body) => self.at.pose(*body).turn.angle,
            ModelVariable::Coordinate(joint, k) => self.at.coordinate(*joint, *k),
            ModelVariable::Reading(reading) => (self.read)(*reading),
            ModelVariable::Local => unreachable!("a curve's parameter outside a curve"),
        }
    }
    fn rate(&self, of: &ModelExpr) -> S {
        match self.rates.iter().find(|(expr, _)| std::ptr::eq(*expr, of)) {
            Some((_, rate)) => *rate,
            None if reads_nothing(of) => jet(&self.moving(), of).d1,
            None => S::of(f64::NAN),
        }
    }
    fn accel(&self, of: &ModelExpr) -> S {
        jet(&self.moving(), of).d2
    }
    fn table(&self, table: usize, x: S) -> S {
        self.at.m.tables[table].eval(x)
    }
    fn branch(&self, discontinuity: usize) -> Option<bool> {
        self.at.mode.branch(discontinuity)
    }
}
