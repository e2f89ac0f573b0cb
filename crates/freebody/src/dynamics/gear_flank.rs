//! Teeth push and never pull: a gear pair without backlash carries on the flank that can.

use super::{Source, Workspace};
use crate::joints::{Gear, Kind};
use crate::kinematics::{relative, MotionView};
use crate::mechanism::Joint;
use crate::mode::Mode;
use crate::plane::Twist;

/// Change of a distance, relative to what moves its ends, that is round-off.
const HELD: f64 = 1e-9;

impl Workspace<'_> {
    /// The mode with the other flank of every gear pair whose teeth would pull in the last solution, if there is one.
    ///
    /// Where other joints hold the axles at their distance, the flank changes no motion, and so no tooth force: both
    /// flanks push along the pitch circles alike. Where they do not, or where the teeth themselves hold the axles, the
    /// flank chosen in the model stays: the other is another constraint.
    pub(super) fn other_gear_flanks(&self) -> Option<Mode> {
        let mut other = None;
        for (row, lambda) in self.rows.iter().zip(&self.solved.lambda) {
            let Source::Joint(j, _) = row.source else { continue };
            let joint = &self.m.joints[j];
            if joint.kind != Kind::Gear {
                continue;
            }
            let model = self.n.values[joint.numbers[Gear::FLANK]];
            let flank = if self.at().mode.bears_on_other_flank(j) { -model } else { model };
            if flank * lambda < 0.0 && self.keeps_centre_distance(joint, lambda.abs()) {
                other.get_or_insert_with(|| self.at().mode.clone()).turn_flank(j);
            }
        }
        other
    }

    /// Whether the axles of a gear pair keep their distance in the last solution, in rate and in acceleration, beside how
    /// they move, and beside what the force of the teeth would do to the whole mass: so round-off of rest is rest.
    fn keeps_centre_distance(&self, joint: &Joint, tooth_force: f64) -> bool {
        let going = MotionView { at: self.at(), bodies: Some(&self.solved.bodies), accelerations: None };
        let at = relative(joint, self.m, &going).1.at();
        let square = at.dot(at);
        let apart = square.d0.sqrt();
        let both =
            |of: &[Twist]| self.m.ends(joint).iter().map(|&i| of[i].v.norm() + of[i].w.abs() * apart).sum::<f64>();
        let speed = both(&self.k.twist);
        let acceleration =
            both(&self.solved.bodies) + speed * speed / apart + tooth_force / self.n.mass.iter().sum::<f64>();
        square.d1.abs() <= HELD * apart * (speed + (acceleration * apart).sqrt())
            && square.d2.abs() <= HELD * apart * acceleration
    }
}
