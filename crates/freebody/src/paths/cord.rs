//! The way of a string and what is slack of it.

use crate::contact::{Border, Piece};
use crate::gauges::Poses;
use crate::mechanism::{Mechanism, Slot};
use crate::scalar::Scalar;

/// A string between two ends.
#[derive(Clone, Debug)]
pub struct Cord {
    /// Its ends.
    pub ends: [End; 2],
    /// What it passes, from the first end to the second; without friction.
    pub over: Vec<Guide>,
    /// Its length, m; None where it is just taut at the start, and the phase of the piece tells the length.
    pub length: Option<Slot>,
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
        radius: Slot,
        /// +1 where the string, followed from its attachment, goes round the drum counter-clockwise.
        sense: f64,
        /// Direction of the attachment from the centre, in the body's frame; None where the length wound at the start
        /// is given instead, and the phase of the piece tells the direction.
        attached: Option<Slot>,
        /// Length on the drum at the start, m, if that is given.
        wound: Option<Slot>,
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
        radius: Slot,
        /// +1 where the string goes round it counter-clockwise.
        sense: f64,
    },
}

impl Cord {
    /// What is slack, m.
    pub fn gap<T: Scalar>(&self, _m: &Mechanism, _poses: &impl Poses<T>, _piece: Piece) -> T {
        todo!()
    }
    /// How it is wound at a configuration, given how it was.
    pub fn piece(&self, _m: &Mechanism, _poses: &impl Poses<f64>, _last: Piece) -> usize {
        todo!()
    }
    /// Where that ends.
    pub fn borders(&self, _m: &Mechanism, _poses: &impl Poses<f64>, _piece: Piece) -> Vec<Border> {
        todo!()
    }
    /// Directions in which its ends are attached and its length, from the configuration at the start.
    pub fn phases(&self, _m: &Mechanism, _poses: &impl Poses<f64>) -> [f64; 3] {
        todo!()
    }
}
