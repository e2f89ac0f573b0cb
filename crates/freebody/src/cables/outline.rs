//! How a string is drawn, and where its length is.

use super::layout::Layout;
use super::{Winding, WrapState};
use crate::kinematics::Poses;
use crate::mechanism::{Cable, End, Guide, Mechanism};
use crate::mode::Feature;
use crate::plane::{vec2, Vec2};
use crate::scalar::real;
use std::f64::consts::FRAC_PI_2;

/// A string at one configuration, drawn as if it were taut.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its segments, from its first end to its second.
    pub stretches: Vec<Stretch>,
    /// Length of the straight segments, m.
    pub free_length: f64,
    /// Length on pulleys, m.
    pub over_length: f64,
    /// Length on the drum at each end, m.
    pub wound_length: [f64; 2],
}

/// A straight segment of a string, or an arc; in fixed axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stretch {
    /// A straight line.
    Straight {
        /// Where it begins.
        from: Vec2,
        /// Where it ends.
        to: Vec2,
    },
    /// An arc; of several turns where it is wound so.
    Arc {
        /// Its centre.
        centre: Vec2,
        /// Its radius, m.
        radius: f64,
        /// Direction from the centre to where it begins, rad.
        from: f64,
        /// Direction to where it ends, rad; below `from` where it runs clockwise.
        to: f64,
    },
}

impl Cable {
    /// Its segments and their lengths.
    pub fn outline(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: Feature) -> Outline {
        let winding = Winding::of(feature.index);
        let layout = Layout::new(self, m, poses, winding, feature.phase);
        let centre = |i: usize| {
            let round = &layout.circles[i];
            poses.pose(m.body_of(round.site)).place(poses.arm(round.site)) + round.off
        };
        let touch = |i: usize, angle: f64| {
            let (sin, cos) = real::sin_cos(angle);
            centre(i) + vec2(sin, -cos) * layout.circles[i].radius
        };
        let drum = |end: usize| {
            let (End::Wound { sense, .. }, Some(leave)) = (self.ends[end], &layout.leaves[end]) else { return None };
            let swept = match winding.states[end] {
                WrapState::Wound => sense * leave.wound / leave.radius,
                WrapState::Pivot => return None,
                WrapState::WoundBack => -sense * leave.wound / leave.radius,
            };
            let (attached, rim) = (leave.attached, leave.attached + swept);
            let (at, from, to) = if end == 0 { (0, attached, rim) } else { (self.over.len() + 1, rim, attached) };
            Some(Stretch::Arc { centre: centre(at), radius: leave.radius, from, to })
        };
        let mut stretches: Vec<Stretch> = drum(0).into_iter().collect();
        for (i, free) in layout.segments.iter().enumerate() {
            if let Some(&Guide::Pulley { sense, .. }) = i.checked_sub(1).map(|before| &self.over[before]) {
                let radius = layout.circles[i].radius.abs();
                let from = layout.segments[i - 1].angle - sense * FRAC_PI_2;
                let to = from + sense * layout.over[i - 1] / radius;
                stretches.push(Stretch::Arc { centre: centre(i), radius, from, to });
            }
            stretches.push(Stretch::Straight { from: touch(i, free.angle), to: touch(i + 1, free.angle) });
        }
        stretches.extend(drum(1));
        Outline {
            stretches,
            free_length: layout.free_length(),
            over_length: layout.over_length(),
            wound_length: [0, 1].map(|end| layout.leaves[end].as_ref().map_or(0.0, |leave| leave.wound)),
        }
    }
}
