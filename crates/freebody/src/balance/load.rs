//! The loads on the bodies: gravity and the forces of the model.

use crate::kinematics::{gradient, Placed, State};
use crate::mechanism::{Force, Part, Pull, Push};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// From the pin of each body to its mass centre, fixed axes.
pub fn centre_arms<S: Scalar>(at: Placed<'_, S>, out: &mut [Vec2<S>]) {
    for (i, arm) in out.iter_mut().enumerate() {
        *arm = at.k.pose[i].turn.apply(at.n.centre[i]);
    }
}

/// The loads of gravity and of all forces on each body, at its pin.
pub fn loads<S: Scalar>(at: Placed<'_, S>, arms: &[Vec2<S>], out: &mut [Wrench<S>]) {
    for (i, load) in out.iter_mut().enumerate() {
        *load = Wrench::force(at.n.gravity * at.n.mass[i], arms[i]);
    }
    for (_, force) in at.m.forces.iter().enumerate().filter(|(f, _)| at.mode.has(Part::Force(*f))) {
        add_force(at, force, out);
    }
}

/// Adds the loads of one force.
pub fn add_force<S: Scalar>(at: Placed<'_, S>, force: &Force, out: &mut [Wrench<S>]) {
    for pull in &force.pulls {
        let value = pull_value(at, pull);
        for &body in &pull.bodies {
            out[body] += gradient(at, &pull.gauge, body) * value;
        }
    }
    for push in &force.pushes {
        let (arm, f) = push_value(at, push);
        out[at.m.body_of(push.site)] += Wrench::force(f, arm);
    }
}

/// How strongly a pull acts, N or N·m.
pub fn pull_value<S: Scalar>(at: Placed<'_, S>, pull: &Pull) -> S {
    pull.value.eval(&State(at))
}

/// Where a push acts, from the pin of its body, and its force, both in fixed axes.
fn push_value<S: Scalar>(at: Placed<'_, S>, push: &Push) -> (Vec2<S>, Vec2<S>) {
    let turn = at.k.pose[at.m.body_of(push.site)].turn;
    let f = vec2(push.x.eval(&State(at)), push.y.eval(&State(at)));
    (turn.apply(at.n.arms[push.site]), if push.with_body { turn.apply(f) } else { f })
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
    let (arm, f) = push_value(at, push);
    f.dot(at.k.twist[at.m.body_of(push.site)].at(arm))
}

/// The power of one force at the present motion, W.
pub fn force_power<S: Scalar>(at: Placed<'_, S>, force: &Force) -> S {
    let mut power = S::zero();
    for pull in &force.pulls {
        power += pull_power(at, pull);
    }
    for push in &force.pushes {
        power += push_power(at, push);
    }
    power
}

/// The power of one force at the present motion without what its potential accounts for, W.
///
/// A force with a potential pulls first along it; what it pulls beside that (a damper) is told here.
pub fn unaccounted_power<S: Scalar>(at: Placed<'_, S>, force: &Force) -> S {
    let from = usize::from(force.potential.is_some());
    let mut power = S::zero();
    for pull in &force.pulls[from..] {
        power += pull_power(at, pull);
    }
    for push in &force.pushes {
        power += push_power(at, push);
    }
    power
}

/// The size of a force as its user gave it: the value of its laws together, N or N·m.
pub fn force_value(at: Placed<'_, f64>, force: &Force) -> f64 {
    let pulls: f64 = force.pulls.iter().map(|p| pull_value(at, p)).sum();
    let pushes: f64 = force.pushes.iter().map(|p| push_value(at, p).1.norm()).sum();
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
