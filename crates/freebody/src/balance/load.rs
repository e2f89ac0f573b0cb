//! The loads on the bodies: gravity and the forces of the model.

use crate::kinematics::{gradient, Placed, State};
use crate::mechanism::{Force, Part, Pull, Push};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// From the pin of each body to its mass centre, fixed axes.
pub fn centre_arms<S: Scalar>(at: Placed<'_, S>, out: &mut [Vec2<S>]) {
    for (i, arm) in out.iter_mut().enumerate() {
        *arm = at.centre_arm(i);
    }
}

/// The loads of gravity and of all forces on each body, at its pin.
pub fn loads<S: Scalar>(at: Placed<'_, S>, arms: &[Vec2<S>], out: &mut [Wrench<S>]) {
    for (i, load) in out.iter_mut().enumerate() {
        *load = Wrench::force(at.n.gravity * at.n.mass[i], arms[i]);
    }
    for (_, force) in at.forces() {
        add_force(at, force, out);
    }
}

/// Adds the loads of one force.
pub fn add_force<S: Scalar>(at: Placed<'_, S>, force: &Force, out: &mut [Wrench<S>]) {
    for pull in &force.pulls {
        for (body, load) in pulled(at, pull) {
            out[body] += load;
        }
    }
    for push in &force.pushes {
        let (body, arm, f) = pushed(at, push);
        out[body] += Wrench::force(f, arm);
    }
}

/// The loads of a pull on its bodies, at their pins.
pub fn pulled<'a, S: Scalar>(at: Placed<'a, S>, pull: &'a Pull) -> impl Iterator<Item = (usize, Wrench<S>)> + 'a {
    let value = pull_value(at, pull);
    pull.bodies.iter().map(move |&body| (body, gradient(at, &pull.gauge, body) * value))
}

/// The body on which a push acts, where, from its pin, and the force, both in fixed axes.
pub fn pushed<S: Scalar>(at: Placed<'_, S>, push: &Push) -> (usize, Vec2<S>, Vec2<S>) {
    let body = at.m.body_of(push.site);
    let turn = at.k.pose[body].turn;
    let f = vec2(push.x.eval(&State(at)), push.y.eval(&State(at)));
    (body, turn.apply(at.n.arms[push.site]), if push.with_body { turn.apply(f) } else { f })
}

/// How strongly a pull acts, N or N·m.
fn pull_value<S: Scalar>(at: Placed<'_, S>, pull: &Pull) -> S {
    pull.value.eval(&State(at))
}

fn pull_power<S: Scalar>(at: Placed<'_, S>, pull: &Pull) -> S {
    let value = pull_value(at, pull);
    let mut power = S::zero();
    for &body in &pull.bodies {
        power += gradient(at, &pull.gauge, body).power(at.k.twist[body]) * value;
    }
    power
}

fn push_power<S: Scalar>(at: Placed<'_, S>, push: &Push) -> S {
    let (body, arm, f) = pushed(at, push);
    f.dot(at.k.twist[body].at(arm))
}

/// The power of a force at the present motion, W; 0 where it is not in place.
pub fn force_power<S: Scalar>(at: Placed<'_, S>, force: usize) -> S {
    power(at, force, |_| true)
}

/// The power of a force at the present motion without what its potential accounts for, W.
pub fn unaccounted_power<S: Scalar>(at: Placed<'_, S>, force: usize) -> S {
    power(at, force, |pull| !pull.conservative)
}

/// The power of those pulls of a force that `counts` names, and of its pushes.
fn power<S: Scalar>(at: Placed<'_, S>, force: usize, counts: impl Fn(&Pull) -> bool) -> S {
    let mut power = S::zero();
    if at.mode.has(Part::Force(force)) {
        let force = &at.m.forces[force];
        for pull in force.pulls.iter().filter(|pull| counts(pull)) {
            power += pull_power(at, pull);
        }
        for push in &force.pushes {
            power += push_power(at, push);
        }
    }
    power
}

/// The size of a force as its user gave it: the value of its laws together, N or N·m; 0 where it is not in place.
pub fn force_value(at: Placed<'_, f64>, force: usize) -> f64 {
    if !at.mode.has(Part::Force(force)) {
        return 0.0;
    }
    let force = &at.m.forces[force];
    let pulls: f64 = force.pulls.iter().map(|p| pull_value(at, p)).sum();
    let pushes: f64 = force.pushes.iter().map(|p| pushed(at, p).2.norm()).sum();
    pulls + pushes
}

/// What the inertia of a body asks for, at its pin, for an acceleration of its pin and angle; `arm` from
/// the pin to the mass centre: m a_G at G and I α.
#[inline]
pub fn effective<S: Scalar>(at: Placed<'_, S>, body: usize, arm: Vec2<S>, acceleration: Twist<S>) -> Wrench<S> {
    let w = at.k.twist[body].w;
    let centre = acceleration.at(arm) - arm * (w * w);
    let force = centre * at.n.mass[body];
    Wrench { f: force, m: arm.cross(force) + at.n.inertia[body] * acceleration.w }
}
