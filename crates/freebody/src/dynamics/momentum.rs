//! Momentum and inertia of a body, and what the balances of momentum leave over.

use super::Row;
use crate::kinematics::StateView;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// The momentum of a body about its mass centre, which moves at `v`, as it turns at `w`: m v and I ω. With
/// accelerations in place of velocities its rate of momentum, with jumps of them an impulse.
#[inline]
pub fn momentum<S: Scalar>(at: StateView<'_, S>, body: usize, v: Vec2<S>, w: S) -> Wrench<S> {
    let turning = if at.m.bodies[body].particle { S::zero() } else { at.n.inertia[body] * w };
    Wrench { f: v * at.n.mass[body], m: turning }
}

/// The rate of momentum of a body about its mass centre, for an acceleration of its joint origin and angle: m a_G and
/// I α.
#[inline]
pub fn momentum_rate<S: Scalar>(at: StateView<'_, S>, body: usize, acceleration: Twist<S>) -> Wrench<S> {
    let (arm, w) = (at.centre_arm(body), at.k.twist[body].w);
    momentum(at, body, acceleration.acceleration_at(arm, w), acceleration.w)
}

/// The same at its joint origin.
#[inline]
pub fn inertia_wrench<S: Scalar>(at: StateView<'_, S>, body: usize, acceleration: Twist<S>) -> Wrench<S> {
    let (arm, w) = (at.centre_arm(body), at.k.twist[body].w);
    momentum(at, body, acceleration.acceleration_at(arm, w), acceleration.w).seen_from(arm)
}

/// What is left of the balance of momentum of every body, at its joint origin: the loads on it and those of the rows
/// with their multipliers, less its rate of momentum.
pub fn residual<S: Scalar>(
    at: StateView<'_, S>,
    loads: &[Wrench<S>],
    accelerations: &[Twist<S>],
    rows: &[Row<S>],
    multipliers: &[S],
) -> Vec<Wrench<S>> {
    let mut left = vec![Wrench::zero(); loads.len()];
    residual_into(at, loads, accelerations, rows, multipliers, &mut left);
    left
}

/// The same in the memory of `left`.
pub(super) fn residual_into<S: Scalar>(
    at: StateView<'_, S>,
    loads: &[Wrench<S>],
    accelerations: &[Twist<S>],
    rows: &[Row<S>],
    multipliers: &[S],
    left: &mut [Wrench<S>],
) {
    for (body, left) in left.iter_mut().enumerate() {
        *left = loads[body] - inertia_wrench(at, body, accelerations[body]);
    }
    add_multipliers(rows, multipliers, left);
}

/// Adds the loads of rows with their multipliers to those on each body.
pub fn add_multipliers<S: Scalar>(rows: &[Row<S>], multipliers: &[S], loads: &mut [Wrench<S>]) {
    for (row, &multiplier) in rows.iter().zip(multipliers) {
        for &(body, load) in row.loads() {
            loads[body] += load * multiplier;
        }
    }
}

/// Mass, first and second moment of a body, or of several that move as one, about its joint origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia<S = f64> {
    pub mass: S,
    pub moment: Vec2<S>,
    pub turn: S,
}

impl<S: Scalar> Inertia<S> {
    /// That of nothing.
    pub fn none() -> Self {
        Inertia { mass: S::zero(), moment: Vec2::zero(), turn: S::zero() }
    }

    /// That of a body whose mass centre is at `arm` from its joint origin; a particle does not resist turning.
    #[inline(always)]
    pub fn of(at: StateView<'_, S>, body: usize, arm: Vec2<S>) -> Self {
        let mass = at.n.mass[body];
        let turn = if at.m.bodies[body].particle { S::zero() } else { at.n.inertia[body] + mass * arm.dot(arm) };
        Inertia { mass, moment: arm * mass, turn }
    }

    /// The momentum of a motion, at the joint origin.
    pub fn momentum(&self, motion: Twist<S>) -> Wrench<S> {
        let f = motion.v * self.mass + self.moment.perp() * motion.w;
        Wrench { f, m: self.moment.cross(motion.v) + self.turn * motion.w }
    }
}
