//! What a string takes from the configuration at its start: where its ends are attached, and its length.

use super::layout::{Layout, Leave};
use super::tangent::near;
use super::{Winding, WrapState};
use crate::kinematics::Poses;
use crate::mechanism::{Cable, End, Mechanism};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Angle, rad, below which a string that is attached where it leaves the drum is not wound a whole turn.
const NONE: f64 = 1e-9;

impl Cable {
    /// Directions from the centre, in the body's frame, in which its ends are attached, rad; and its length, m: what
    /// [`Feature::phase`](crate::mode::Feature::phase) is to be from the start on.
    ///
    /// - Where the length wound is given, the direction follows.
    /// - Where the direction is given and the straight line from there is free, the string is unwound; else less than one
    ///   turn is wound. If the length of the string is given too, it is wound by so many turns that the slack is the least:
    ///   a slack of more than half a turn is expressed by the length wound.
    pub fn initial_winding(&self, m: &Mechanism, poses: &impl Poses<f64>) -> [f64; 3] {
        let (mut phase, mut winding) = ([0.0; 3], Winding::default());
        // Once more, for where the string leaves one drum depends on how it is wound on the other.
        for end in [0, 1, 0, 1] {
            (phase[end], winding.states[end]) = self.attachment(m, poses, end, winding, phase);
        }
        phase[2] = match self.length {
            Some(id) => poses.value(id),
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
    ) -> (f64, WrapState) {
        let End::Wound { centre, radius, sense, attached, wound } = self.ends[end] else {
            return (0.0, WrapState::Wound);
        };
        let (radius, body) = (poses.value(radius), poses.pose(m.body_of(centre)).turn.angle);
        let mut laid = |way: WrapState| {
            phase[end] = attached.map_or(0.0, |id| poses.value(id));
            winding.states[end] = way;
            let layout = Layout::new(self, m, poses, winding, phase);
            let (length, last) = (layout.length(), layout.segments.len() - 1);
            let none = layout.segments[if end == 0 { 0 } else { last }].none;
            let [first, second] = layout.leaves;
            let leave: Leave<f64> = if end == 0 { first } else { second }.expect("an end on a drum");
            (leave, length, none)
        };
        let (leave, length, none) = laid(WrapState::Wound);
        let at = |turn: f64| leave.direction - body - sense * turn;
        if let Some(id) = wound {
            // A free segment of no length takes nothing from what is wound.
            return (at(FRAC_PI_2 + (poses.value(id) - none) / radius), WrapState::Wound);
        }
        let turn = near(leave.turn, FRAC_PI_2 + PI - NONE);
        let (unwound, straight, _) = laid(WrapState::Pivot);
        let free = unwound.turn.abs() <= FRAC_PI_2;
        let Some(given) = self.length.map(|id| poses.value(id)) else {
            return if free { (at(turn - TAU), WrapState::Pivot) } else { (at(turn), WrapState::Wound) };
        };
        let slack = given - length - radius * (turn - leave.turn);
        let turns = (slack / (radius * TAU)).round().max(0.0);
        let left = slack - turns * radius * TAU;
        match free && (given - straight).abs() <= left.abs() {
            true => (at(turn - TAU), WrapState::Pivot),
            false => (at(turn + turns * TAU), WrapState::Wound),
        }
    }
}
