//! How the ends of a string are wound, and the number that stands for it.

use std::f64::consts::PI;

/// How a string leaves the drum at one of its ends. An end that is tied to a point counts as wound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrapState {
    /// Wound in the sense of the drum.
    #[default]
    Wound,
    /// Unwound: straight from the attachment.
    Pivot,
    /// Wound in the other sense.
    WoundBack,
}

/// How both ends of a string are wound: the feature on which its slack is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Winding {
    /// How it leaves the drum at each end.
    pub states: [WrapState; 2],
    /// Half turns by which the direction of the string that leaves a drum has swung, in fixed axes, and to the nearest:
    /// a direction by itself is known only up to whole turns.
    pub swings: [i32; 2],
}

/// Direction from which swings are counted, rad: any, but such that half a turn from it hardly a string runs.
const AHEAD: f64 = -1.0;

/// Room for the swings of one end in the number of a feature.
const ROOM: usize = 1 << (usize::BITS / 2 - 3);

impl Winding {
    /// The direction, rad, from which that of the string at an end is less than half a turn off.
    pub(super) fn near(&self, end: usize) -> f64 {
        AHEAD + f64::from(self.swings[end]) * PI
    }

    /// With one end wound in another way, its string in a direction, rad.
    pub(super) fn with(mut self, end: usize, way: WrapState, direction: f64) -> Self {
        self.states[end] = way;
        self.swings[end] = if way == WrapState::Pivot { 0 } else { ((direction - AHEAD) / PI).round() as i32 };
        self
    }

    /// Its number: way of the first end + 3 × way of the second + 9 × what the swings come to, 0 before any.
    pub fn index(self) -> usize {
        let [a, b] = self.states.map(|way| way as usize);
        // 0, −1, 1, −2 … are 0, 1, 2, 3 …
        let [i, j] = self.swings.map(|swing| ((swing << 1) ^ (swing >> 31)) as u32 as usize % ROOM);
        a + 3 * b + 9 * (i + ROOM * j)
    }

    /// The winding of a number.
    pub fn of(index: usize) -> Self {
        let way = |i: usize| [WrapState::Wound, WrapState::Pivot, WrapState::WoundBack][i % 3];
        let swing = |i: usize| ((i >> 1) as i32) ^ -((i & 1) as i32);
        let swings = index / 9;
        Winding { states: [way(index), way(index / 3)], swings: [swing(swings % ROOM), swing(swings / ROOM)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_stands_for_one_winding() {
        let ways = [WrapState::Wound, WrapState::Pivot, WrapState::WoundBack];
        let mut seen = std::collections::HashSet::new();
        for (a, b) in ways.into_iter().flat_map(|a| ways.map(|b| (a, b))) {
            for (i, j) in (-40..40).flat_map(|i| [-4000, -1, 0, 1, 4000].map(|j| (i, j))) {
                let winding = Winding { states: [a, b], swings: [i, j] };
                assert_eq!(Winding::of(winding.index()), winding);
                assert!(seen.insert(winding.index()));
            }
        }
        assert_eq!(Winding::default().index(), 0);
    }
}
