//! The loads on the bodies: gravity and the forces of the model.

use super::plate_friction;
use crate::kinematics::{gradient, State, StateView};
use crate::mechanism::{Force, GaugeForce, Part, PointForce};
use crate::plane::{vec2, Vec2, Wrench};
use crate::scalar::Scalar;

/// From the joint origin of each body to its mass centre, fixed axes.
#[inline(always)]
pub fn centre_arms<S: Scalar>(at: StateView<'_, S>, out: &mut [Vec2<S>]) {
    for (i, arm) in out.iter_mut().enumerate() {
        *arm = at.centre_arm(i);
    }
}

/// The loads of gravity and of all forces on each body, at its joint origin.
#[inline(always)]
pub fn loads<S: Scalar>(at: StateView<'_, S>, arms: &[Vec2<S>], out: &mut [Wrench<S>]) {
    for (i, load) in out.iter_mut().enumerate() {
        *load = Wrench::force(at.n.gravity * at.n.mass[i], arms[i]);
    }
    for (_, force) in at.forces() {
        add_force(at, force, out);
    }
}

/// Adds the loads of one force.
pub fn add_force<S: Scalar>(at: StateView<'_, S>, force: &Force, out: &mut [Wrench<S>]) {
    for gauge_force in &force.gauge_forces {
        for (body, load) in pulled(at, gauge_force) {
            out[body] += load;
        }
    }
    for applied in &force.point_forces {
        let (body, arm, f) = pushed(at, applied);
        out[body] += Wrench::force(f, arm);
    }
    if let Some(plate) = &force.plate {
        out[plate.body] += plate_friction(at, plate);
    }
}

/// The loads of a pull on its bodies, at their joint origins.
pub fn pulled<'a, S: Scalar>(
    at: StateView<'a, S>,
    gauge_force: &'a GaugeForce,
) -> impl Iterator<Item = (usize, Wrench<S>)> + 'a {
    let value = gauge_force_value(at, gauge_force);
    gauge_force.bodies.iter().map(move |&body| (body, direction(at, gauge_force, body, value) * value))
}

/// The load of a unit pull on a body; none where what pulls with no force has no direction, as a spring without length.
fn direction<S: Scalar>(at: StateView<'_, S>, gauge_force: &GaugeForce, body: usize, value: S) -> Wrench<S> {
    let along = gradient(at, &gauge_force.gauge, body);
    match value.value() != 0.0 || (along.f.x + along.f.y + along.m).value().is_finite() {
        true => along,
        false => Wrench::zero(),
    }
}

/// The body on which a push acts, where, from its joint origin, and the force, both in fixed axes.
pub fn pushed<S: Scalar>(at: StateView<'_, S>, applied: &PointForce) -> (usize, Vec2<S>, Vec2<S>) {
    let body = at.m.body_of(applied.site);
    let turn = at.k.pose[body].turn;
    let f = vec2(applied.x.eval(&State(at)), applied.y.eval(&State(at)));
    (body, turn.apply(at.n.arms[applied.site]), if applied.with_body { turn.apply(f) } else { f })
}

/// How strongly a pull acts, N or N·m.
fn gauge_force_value<S: Scalar>(at: StateView<'_, S>, gauge_force: &GaugeForce) -> S {
    gauge_force.value.eval(&State(at))
}

fn gauge_force_power<S: Scalar>(at: StateView<'_, S>, gauge_force: &GaugeForce) -> S {
    let value = gauge_force_value(at, gauge_force);
    let mut power = S::zero();
    for &body in &gauge_force.bodies {
        power += direction(at, gauge_force, body, value).power(at.k.twist[body]) * value;
    }
    power
}

fn point_force_power<S: Scalar>(at: StateView<'_, S>, applied: &PointForce) -> S {
    let (body, arm, f) = pushed(at, applied);
    f.dot(at.k.twist[body].at(arm))
}

/// The power of a force at the present motion, W; 0 where it is not in place.
pub fn force_power<S: Scalar>(at: StateView<'_, S>, force: usize) -> S {
    power(at, force, |_| true)
}

/// The power of a force at the present motion without what its potential accounts for, W.
pub fn unaccounted_power<S: Scalar>(at: StateView<'_, S>, force: usize) -> S {
    power(at, force, |gauge_force| !gauge_force.conservative)
}

/// The power of those pulls of a force that `counts` names, and of its pushes.
fn power<S: Scalar>(at: StateView<'_, S>, force: usize, counts: impl Fn(&GaugeForce) -> bool) -> S {
    let mut power = S::zero();
    if at.mode.has(Part::Force(force)) {
        let force = &at.m.forces[force];
        for gauge_force in force.gauge_forces.iter().filter(|gauge_force| counts(gauge_force)) {
            power += gauge_force_power(at, gauge_force);
        }
        for applied in &force.point_forces {
            power += point_force_power(at, applied);
        }
        if let Some(plate) = &force.plate {
            power += plate_friction(at, plate).power(at.k.twist[plate.body]);
        }
    }
    power
}

/// The friction of a plate at the mass centre of its body, fixed axes; of another force none.
pub fn plate_load<S: Scalar>(at: StateView<'_, S>, force: usize) -> Wrench<S> {
    match &at.m.forces[force].plate {
        Some(plate) if at.mode.has(Part::Force(force)) => {
            plate_friction(at, plate).seen_from(-at.centre_arm(plate.body))
        }
        _ => Wrench::zero(),
    }
}

/// A force as its user gave it: the value of its laws together, N or N·m, or the size of what has components; 0 where it is not in place.
pub fn force_value<S: Scalar>(at: StateView<'_, S>, force: usize) -> S {
    if !at.mode.has(Part::Force(force)) {
        return S::zero();
    }
    let force = &at.m.forces[force];
    let gauge_forces = force.gauge_forces.iter().fold(S::zero(), |sum, p| sum + gauge_force_value(at, p));
    let point_force =
        |p: &PointForce| p.value.as_ref().map_or_else(|| pushed(at, p).2.norm(), |value| value.eval(&State(at)));
    let point_forces = force.point_forces.iter().fold(S::zero(), |sum, p| sum + point_force(p));
    let plate = force.plate.as_ref().map_or(S::zero(), |plate| plate_friction(at, plate).f.norm());
    gauge_forces + point_forces + plate
}
