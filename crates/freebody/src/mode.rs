//! What is active now. A motion is a chain of modes; within one, every law is smooth.

use crate::mechanism::{Mechanism, Part};
use std::collections::HashMap;

/// Which arms, parts and limits are active.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mode {
    arms: Vec<Option<bool>>,
    off: Vec<Part>,
    /// Zero of each row of which only the change counts, by joint and row; none before a motion starts.
    pub phases: HashMap<(usize, usize), f64>,
    /// How each limit is held.
    pub limits: Vec<Held>,
    /// How each joint that rubs is held: stuck, sliding, or open while nothing is decided.
    pub rubs: Vec<Hold>,
    /// At rest by friction: nothing moves until the mode changes.
    pub resting: bool,
}

/// How a limit is held, and on which piece its gap is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// How.
    pub hold: Hold,
    /// The piece.
    pub piece: Piece,
}

/// The piece on which a gap is told, and what was found when its motion started.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Piece {
    /// Which one: an edge, a corner, a way of being wound. What the number means is the gap's own.
    pub index: usize,
    /// Found at the start, for a string: where on its drum each end is attached, rad, and its length, m.
    pub phase: [f64; 3],
}

/// A function that is positive on its piece, with the piece that lies beyond its zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// Its value, in m.
    pub value: f64,
    /// The piece beyond.
    pub beyond: usize,
}

/// How a limit is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// Not there: released, or not yet engaged.
    Off,
    /// Its gap is open.
    #[default]
    Open,
    /// Its gap is violated, against its spring and damper.
    Pressed,
    /// Its gap is closed, but others carry the load.
    Idle,
    /// Its gap is closed and it does not rub.
    Smooth,
    /// Its gap is closed and it does not slide.
    Stuck,
    /// Its gap is closed and others keep it from sliding: it rubs with a given part of its normal force.
    Leaning(f64),
    /// Its gap is closed and it slides: the sign of the speed of sliding.
    Sliding(f64),
}

impl Hold {
    /// Whether it carries load.
    pub fn carries(self) -> bool {
        matches!(self, Hold::Smooth | Hold::Stuck | Hold::Leaning(_) | Hold::Sliding(_))
    }
    /// Whether it is closed and does not slide, though it could.
    pub fn sticks(self) -> bool {
        matches!(self, Hold::Stuck | Hold::Leaning(_))
    }
    /// Whether it is reached, closed or pressed.
    pub fn touches(self) -> bool {
        self == Hold::Pressed || self.is_closed()
    }
    /// Whether its gap is closed.
    pub fn is_closed(self) -> bool {
        self == Hold::Idle || self.carries()
    }
}

impl Mode {
    /// The mode before a motion: no switch frozen, every law read by its value, no limit reached, and all parts in place
    /// but those that are engaged later.
    pub fn free(m: &Mechanism) -> Self {
        let held = |group: usize| Held {
            hold: if m.groups[group].engaged { Hold::Open } else { Hold::Off },
            piece: Piece::default(),
        };
        Mode {
            arms: vec![None; m.switches],
            off: m.idle.clone(),
            phases: HashMap::new(),
            limits: m.limits.iter().map(|limit| held(limit.group)).collect(),
            rubs: vec![Hold::Open; m.rubs.len()],
            resting: false,
        }
    }
    /// The arm at which a switch is frozen.
    pub fn arm(&self, kink: usize) -> Option<bool> {
        self.arms.get(kink).copied().flatten()
    }
    /// Freezes a switch at an arm.
    pub fn freeze(&mut self, kink: usize, arm: bool) {
        self.arms[kink] = Some(arm);
    }
    /// Whether a part is in place.
    pub fn has(&self, part: Part) -> bool {
        !self.off.contains(&part)
    }
    /// Takes a part away, or puts it in place; answers whether that changed anything.
    pub fn put(&mut self, part: Part, there: bool) -> bool {
        let changes = self.has(part) != there;
        match there {
            true => self.off.retain(|p| *p != part),
            false if changes => self.off.push(part),
            false => {}
        }
        changes
    }
}
