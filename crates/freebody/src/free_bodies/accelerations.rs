//! How bodies accelerate for given accelerations of the user's coordinates.

use crate::gauges::Placed;
use crate::plane::Twist;
use crate::scalar::Scalar;

/// Accelerations of the pins and angles of all bodies for accelerations of the coordinates, in the order of `q`.
pub fn accelerations<S: Scalar>(at: Placed<'_, S>, of_coordinates: &[S]) -> Vec<Twist<S>> {
    let mut out = vec![Twist::zero(); at.m.bodies.len()];
    for (i, body) in at.m.bodies.iter().enumerate() {
        let Some(branch) = body.branch else { continue };
        let base = out[branch.parent];
        let turning = if body.particle { S::zero() } else { base.w };
        let mut motion = Twist { v: base.at(at.k.arm[i]), w: turning } + at.k.drift[i];
        for (k, coordinate) in at.m.joints[branch.joint].coordinates.iter().enumerate() {
            let user = of_coordinates[branch.start + k].scale(coordinate.sense);
            let own = if coordinate.absolute { user - base.w } else { user };
            motion = motion + at.k.columns[i][k] * own;
        }
        out[i] = motion;
    }
    out
}
