//! What a string takes from the configuration at its start: where its ends are attached, and its length.

use super::layout::{Layout, Leave};
use super::tangent::near;
use super::{Way, Winding};
use crate::kinematics::Poses;
use crate::mechanism::{Cord, End, Mechanism};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Angle, rad, below which a string that is attached where it leaves the drum is not wound a whole turn.
const NONE: f64 = 1e-9;

impl Cord {
    /// Directions from the centre, in the body's frame, in which its ends are attached, rad; and its length, m: what
    /// [`Piece::phase`](crate::mode::Piece::phase) is to be from the start on.
    ///
    /// - Where the length wound is given, the direction follows.
    /// - Where the direction is given and the straight line from there is free, the string is unwound; else less than one
    ///   turn is wound. If the length of the string is given too, it is wound by so many turns that the slack is the least:
    ///   a slack of more than half a turn is told by the length wound.
    pub fn phases(&self, m: &Mechanism, poses: &impl Poses<f64>) -> [f64; 3] {
        let (mut phase, mut winding) = ([0.0; 3], Winding::default());
        // Once more, for where the string leaves one drum depends on how it is wound on the other.
        for end in [0, 1, 0, 1] {
            (phase[end], winding.ways[end]) = self.attachment(m, poses, end, winding, phase);
        }
        phase[2] = match self.length {
            Some(slot) => poses.slot(slot),
            None => Layout::new(self, m, poses, winding, phase).length(),
        };
        phase
    }

    /// Where one end is attached, and whether it is wound, given this of the other end.
    fn attachment(
        &self,
        m: &Mechanism,
        poses: &impl Poses<f64>,
        end: usize,
        mut winding: Winding,
        mut phase: [f64; 3],
    ) -> (f64, Way) {
        let End::Wound { centre, radius, sense, attached, wound } = self.ends[end] else { return (0.0, Way::Wound) };
        let (radius, body) = (poses.slot(radius), poses.pose(m.body_of(centre)).turn.angle);
        let mut laid = |way: Way| {
            phase[end] = attached.map_or(0.0, |slot| poses.slot(slot));
            winding.ways[end] = way;
            let layout = Layout::new(self, m, poses, winding, phase);
            let (length, last) = (layout.length(), layout.free.len() - 1);
            let none = layout.free[if end == 0 { 0 } else { last }].none;
            let [first, second] = layout.leaves;
            let leave: Leave<f64> = if end == 0 { first } else { second }.expect("an end on a drum");
            (leave, length, none)
        };
        let (leave, length, none) = laid(Way::Wound);
        let at = |turn: f64| leave.direction - body - sense * turn;
        if let Some(slot) = wound {
            // A free stretch of no length takes nothing from what is wound.
            return (at(FRAC_PI_2 + (poses.slot(slot) - none) / radius), Way::Wound);
        }
        let turn = near(leave.turn, FRAC_PI_2 + PI - NONE);
        let (unwound, straight, _) = laid(Way::Pivot);
        let free = unwound.turn.abs() <= FRAC_PI_2;
        let Some(given) = self.length.map(|slot| poses.slot(slot)) else {
            return if free { (at(turn - TAU), Way::Pivot) } else { (at(turn), Way::Wound) };
        };
        let slack = given - length - radius * (turn - leave.turn);
        let turns = (slack / (radius * TAU)).round().max(0.0);
        let left = slack - turns * radius * TAU;
        match free && (given - straight).abs() <= left.abs() {
            true => (at(turn - TAU), Way::Pivot),
            false => (at(turn + turns * TAU), Way::Wound),
        }
    }
}
