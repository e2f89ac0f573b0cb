//! Joints as compiled, their coordinates and their friction.

use super::{Marker, ValueId};
use crate::joints::{Joint as _, Kind};

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Marker on the first body.
    pub first: Marker,
    /// Marker on the second body.
    pub second: Marker,
    /// Its numbers.
    pub numbers: Vec<ValueId>,
    /// Its curve.
    pub curve: Option<usize>,
    /// Number of coordinates on its card.
    pub size: usize,
    /// Its coordinates, those that a particle does not have left out.
    pub coordinates: Vec<Coordinate>,
    /// Its rows as a constraint, those that a particle does not have left out: index among the card's rows.
    pub rows: Vec<usize>,
    /// Of each row of the card, whether only its change counts.
    pub is_relative: Vec<bool>,
    /// Whether its reaction can have a couple about its point.
    pub couple: bool,
    /// The body that hangs on it, if it is in the tree.
    pub child: Option<usize>,
}

impl Joint {
    /// Whether it constrains places, and not rates only.
    pub fn is_holonomic(&self) -> bool {
        !self.kind.card().rows.iter().any(|row| row.of_rates)
    }
    /// The markers on the body nearer to ground and on the one that it carries.
    #[inline(always)]
    pub fn sides(&self, reversed: bool) -> (&Marker, &Marker) {
        if reversed {
            (&self.second, &self.first)
        } else {
            (&self.first, &self.second)
        }
    }
}

/// A joint coordinate, as its user reads it.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Name.
    pub name: String,
    /// Which of the card's coordinates it is.
    pub card: usize,
    /// `m`, `rad` or nothing.
    pub dimension: &'static str,
    /// Reading of the joint's measure where the coordinate is 0.
    pub zero: ValueId,
    /// +1 or −1.
    pub sense: f64,
    /// Measured from the fixed x axis instead of from the first body.
    pub absolute: bool,
    /// A free length: a motion ends where it falls to 0.
    pub ends: bool,
}

/// Coulomb friction that is known once the force that presses is: at most a coefficient times its size.
#[derive(Clone, Debug)]
pub struct JointFriction {
    /// What has friction.
    pub of: FrictionSource,
    /// Coefficient at rest.
    pub fixed: ValueId,
    /// Coefficient of sliding.
    pub kinetic: ValueId,
}

/// What has friction.
#[derive(Clone, Copy, Debug)]
pub enum FrictionSource {
    /// A joint, by the force that it carries (times the radius of its bearing).
    Joint {
        /// The joint.
        joint: usize,
        /// Radius of the bearing of a hinge, whose friction is a couple; all else has it along its line or curve.
        radius: Option<ValueId>,
    },
    /// A unilateral constraint for which a spring stands, by the force of the spring and its damper.
    Unilateral(usize),
}

/// A massless particle that runs on a curve and carries a pin, in place of a joint along the curve that can be
/// released: then the pin is, and the particle is held where it is.
#[derive(Clone, Copy, Debug)]
pub struct CurveFollower {
    /// The joint along the curve, which carries the particle.
    pub joint: usize,
    /// The joint by which the particle carries the second body.
    pub released_joint: usize,
    /// The row that holds the particle.
    pub hold: usize,
}
