//! Teeth push and never pull: a gear pair without backlash carries on the flank that can.

use super::{Source, Workspace};
use crate::joints::{Gear, Kind};
use crate::kinematics::{relative, MotionView};
use crate::mechanism::Joint;
use crate::mode::Mode;

/// Change of a distance, relative to what the wheels' turning could make of it, that is round-off.
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
            if flank * lambda < 0.0 && self.keeps_centre_distance(joint) {
                other.get_or_insert_with(|| self.at().mode.clone()).turn_flank(j);
            }
        }
        other
    }

    /// Whether the axles of a gear pair keep their distance in the last solution, in rate and in acceleration.
    fn keeps_centre_distance(&self, joint: &Joint) -> bool {
        let going = MotionView { at: self.at(), bodies: Some(&self.solved.bodies), accelerations: None };
        let [a, b] = self.m.ends(joint);
        let at = relative(joint, self.m, &going).1.at();
        let apart = at.dot(at);
        let spin = self.k.twist[a].w.abs() + self.k.twist[b].w.abs();
        let spin_up = self.solved.bodies[a].w.abs() + self.solved.bodies[b].w.abs() + spin * spin;
        apart.d1.abs() <= HELD * apart.d0 * spin.max(f64::MIN_POSITIVE)
            && apart.d2.abs() <= HELD * apart.d0 * spin_up.max(f64::MIN_POSITIVE)
    }
}
