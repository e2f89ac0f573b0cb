//! What expressions read of a state.

use super::{Moving, Placed, Poses, Seeded};
use crate::expr::Env;
use crate::gauges::{Law, Leaf, Reading};
use crate::mechanism::Mechanism;
use crate::mode::Mode;
use crate::plane::{Twist, Vec2, Wrench};
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

impl<T: Scalar, P: Poses<T>> Env<T, Leaf> for Config<'_, P> {
    fn leaf(&self, leaf: &Leaf) -> T {
        let p = self.poses;
        match leaf {
            Leaf::Parameter(i) => p.parameter(*i),
            Leaf::Time => p.time(),
            Leaf::X(site) => p.pose(self.m.body_of(*site)).place(p.arm(*site)).x,
            Leaf::Y(site) => p.pose(self.m.body_of(*site)).place(p.arm(*site)).y,
            Leaf::Angle(body) => p.pose(*body).turn.angle,
            Leaf::Coordinate(joint, k) => p.coordinate(*joint, *k),
            Leaf::Local | Leaf::Reading(_) => unreachable!("{leaf:?} in an expression of the configuration"),
        }
    }
    fn rate(&self, _: &Law) -> T {
        unreachable!("a time derivative in an expression of the configuration")
    }
    fn accel(&self, _: &Law) -> T {
        unreachable!("a time derivative in an expression of the configuration")
    }
    fn table(&self, table: usize, x: T) -> T {
        self.m.tables[table].eval(x)
    }
    fn arm(&self, kink: usize) -> Option<bool> {
        self.mode.arm(kink)
    }
}

/// A state as an environment of laws, which may read rates.
pub struct State<'a, S>(pub Placed<'a, S>);

impl<S: Scalar> Env<S, Leaf> for State<'_, S> {
    fn leaf(&self, leaf: &Leaf) -> S {
        Config { poses: &self.0, m: self.0.m, mode: self.0.mode }.leaf(leaf)
    }
    fn rate(&self, of: &Law) -> S {
        jet(&Moving { at: self.0, bodies: None, accelerations: None }, of).d1
    }
    fn accel(&self, _: &Law) -> S {
        unreachable!("an acceleration in a law")
    }
    fn table(&self, table: usize, x: S) -> S {
        self.0.m.tables[table].eval(x)
    }
    fn arm(&self, kink: usize) -> Option<bool> {
        self.0.mode.arm(kink)
    }
}

/// The load on `body`, at its pin, of a unit force along a gauge.
pub fn gradient<S: Scalar>(at: Placed<'_, S>, gauge: &Law, body: usize) -> Wrench<S> {
    let seeded = Seeded { at, body };
    let value: Dual<3, S> = gauge.eval(&Config { poses: &seeded, m: at.m, mode: at.mode });
    Wrench::from_parts(value.du)
}

/// A gauge with its rate and acceleration, for given accelerations of the bodies.
pub fn jet<S: Scalar>(moving: &Moving<'_, S>, gauge: &Law) -> Jet<S> {
    gauge.eval(&Config { poses: moving, m: moving.at.m, mode: moving.at.mode })
}

/// A solved instant as an environment of expressions.
pub struct Observed<'a> {
    /// The state.
    pub at: Placed<'a>,
    /// Accelerations of pins and angles.
    pub bodies: &'a [Twist],
    /// Accelerations of the coordinates.
    pub accelerations: &'a [f64],
    /// What a reading is.
    pub read: &'a dyn Fn(Reading) -> f64,
}

impl Observed<'_> {
    fn moving(&self) -> Moving<'_, f64> {
        Moving { at: self.at, bodies: Some(self.bodies), accelerations: Some(self.accelerations) }
    }
}

impl Env<f64, Leaf> for Observed<'_> {
    fn leaf(&self, leaf: &Leaf) -> f64 {
        let place = |site: usize| -> Vec2 { self.at.pose(self.at.m.body_of(site)).place(self.at.arm(site)) };
        match leaf {
            Leaf::Parameter(i) => self.at.parameter(*i),
            Leaf::Time => self.at.t,
            Leaf::X(site) => place(*site).x,
            Leaf::Y(site) => place(*site).y,
            Leaf::Angle(body) => self.at.pose(*body).turn.angle,
            Leaf::Coordinate(joint, k) => self.at.coordinate(*joint, *k),
            Leaf::Reading(reading) => (self.read)(*reading),
            Leaf::Local => unreachable!("a curve's parameter outside a curve"),
        }
    }
    fn rate(&self, of: &Law) -> f64 {
        jet(&self.moving(), of).d1
    }
    fn accel(&self, of: &Law) -> f64 {
        jet(&self.moving(), of).d2
    }
    fn table(&self, table: usize, x: f64) -> f64 {
        self.at.m.tables[table].eval(x)
    }
    fn arm(&self, kink: usize) -> Option<bool> {
        self.at.mode.arm(kink)
    }
}
