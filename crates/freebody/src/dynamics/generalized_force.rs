//! What loads on bodies do on the joint coordinates of the tree.

use crate::kinematics::StateView;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// The part of loads on bodies that does work on each joint coordinate: Jᵀ w.
pub(super) fn generalized_force<S: Scalar>(
    at: StateView<'_, S>,
    wrenches: impl IntoIterator<Item = (usize, Wrench<S>)>,
    out: &mut [S],
) {
    visit_ancestors(at, wrenches, |i, load, column| out[i] += load.power(column));
}

/// Every coordinate on which loads may do work, with the load at the joint origin of its body and its column.
pub(super) fn visit_ancestors<S: Scalar>(
    at: StateView<'_, S>,
    wrenches: impl IntoIterator<Item = (usize, Wrench<S>)>,
    mut visit: impl FnMut(usize, Wrench<S>, Twist<S>),
) {
    for (mut body, mut load) in wrenches {
        while let Some(b) = at.m.bodies[body].tree_joint {
            for k in 0..b.freedom {
                visit(b.start + k, load, at.k.motion_subspace[body][k]);
            }
            load = load.seen_from(at.k.arm[body]);
            if at.m.bodies[body].particle {
                // A particle passes no couple on.
                load = Wrench::force(load.f, at.k.arm[body]);
            }
            body = b.parent;
        }
    }
}

/// How large the power of a load may be on its way to cancelling, levers being of the characteristic length; vectors by the
/// sum of their components.
pub(super) fn size_of_power(load: Wrench, motion: Twist, length: f64) -> f64 {
    let size = |v: Vec2| v.x.abs() + v.y.abs();
    size(load.f) * (size(motion.v) + length * motion.w.abs()) + (load.m * motion.w).abs()
}
