//! Strings: where they end and what they pass.

use super::ValueId;

/// A string between two ends: without mass, of a length that does not change, pulling only, without friction where it
/// is bent.
///
/// Its slack is its length less that of the shortest way along what it passes: straight segments, arcs on pulleys, and
/// what is wound on drums. A pulley it never leaves: the angle through which it turns there is taken between −90° and
/// 270°. Where an end is pushed into its drum or a pulley, the segment to it has no length.
///
/// A drum may turn, and be gone round by the string, any number of times: bodies' angles are never wrapped, and how
/// often the string has swung round is part of the feature.
#[derive(Clone, Debug)]
pub struct Cable {
    /// Its ends.
    pub ends: [End; 2],
    /// What it passes, from the first end to the second; without friction.
    pub over: Vec<Guide>,
    /// Its length, m; None where it is just taut at the start, and the phase of the feature tells the length.
    pub length: Option<ValueId>,
}

/// Where a string ends.
#[derive(Clone, Copy, Debug)]
pub enum End {
    /// At a site.
    Tied(usize),
    /// On the rim of a drum, on which it is wound.
    Wound {
        /// Site of the drum's centre.
        centre: usize,
        /// Its radius.
        radius: ValueId,
        /// +1 where the string, followed from its attachment, goes round the drum counter-clockwise.
        sense: f64,
        /// Direction of the attachment from the centre, in the body's frame; None where the length wound at the start
        /// is given instead, and the phase of the feature tells the direction.
        attached: Option<ValueId>,
        /// Length on the drum at the start, m, if that is given.
        wound: Option<ValueId>,
    },
}

/// What a string passes without friction.
#[derive(Clone, Copy, Debug)]
pub enum Guide {
    /// A small ring at a site.
    Eyelet(usize),
    /// A pulley.
    Pulley {
        /// Site of its centre.
        centre: usize,
        /// Its radius.
        radius: ValueId,
        /// +1 where the string goes round it counter-clockwise.
        sense: f64,
    },
}
