//! Teeth push and never pull: a gear pair without backlash carries on the flank that can.

use super::{Balance, Source};
use crate::joints::{Gear, Kind};

impl Balance<'_> {
    /// Takes the other flank of every gear pair whose teeth would pull in the last solution; true if there was one.
    ///
    /// The flank changes no motion, and so no tooth force: both flanks push along the pitch circles alike.
    pub(super) fn turn_teeth(&mut self) -> bool {
        let mut turned = false;
        for (row, lambda) in self.rows.iter().zip(&self.solved.lambda) {
            let Source::Joint(j, _) = row.source else { continue };
            let joint = &self.m.joints[j];
            if joint.kind != Kind::Gear {
                continue;
            }
            let flank = &mut self.n.slots[joint.numbers[Gear::FLANK]];
            if *flank * lambda < 0.0 {
                *flank = -*flank;
                turned = true;
            }
        }
        turned
    }
}
