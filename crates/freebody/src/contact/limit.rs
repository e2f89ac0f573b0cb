//! Limits: gauges that cannot fall below zero.

use super::Touch;
use crate::gauges::{Config, Law, Poses};
use crate::mechanism::{Mechanism, Slot};
use crate::mode::Mode;
use crate::paths::Cord;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// A gauge that cannot fall below zero.
#[derive(Clone, Debug)]
pub struct Limit {
    /// The gauge.
    pub gap: Gap,
    /// The contact, stop or string of the model to which it belongs.
    pub group: usize,
    /// Its two bodies, or all on which the gauge depends; ground left out.
    pub bodies: Vec<usize>,
    /// Restitution: speed of parting over speed of approach, 0 to 1.
    pub restitution: Slot,
    /// Friction, where it can rub.
    pub friction: Option<Friction>,
    /// Stiffness, N/m, and damping, N·s/m, where a spring and a damper stand for the limit: it can be violated, against them.
    pub soft: Option<[Slot; 2]>,
}

/// A contact, stop or string, as its user names it; a contact of polygons is many limits.
#[derive(Clone, Debug)]
pub struct Group {
    /// Name.
    pub name: String,
    /// `contact`, `stop` or `string`.
    pub word: &'static str,
    /// First and second body of a contact.
    pub ends: [usize; 2],
    /// Its limits.
    pub limits: std::ops::Range<usize>,
    /// Whether it is there from the start.
    pub engaged: bool,
}

impl Group {
    /// Where it stands in the model.
    pub fn path(&self) -> String {
        format!("{}s.{}", self.word, self.name)
    }
}

/// Coulomb friction of a contact.
#[derive(Clone, Copy, Debug)]
pub enum Friction {
    /// It never slides while it is closed.
    Rough,
    /// Coefficients of rest and of sliding.
    Coulomb {
        /// Of rest; not below that of sliding.
        fixed: Slot,
        /// Of sliding.
        kinetic: Slot,
    },
}

/// What a limit measures.
#[derive(Clone, Debug)]
pub enum Gap {
    /// A gauge of the model.
    Gauge(Law),
    /// A disk, or a point, against a surface.
    Touch(Touch),
    /// What is slack of a string.
    Cord(Cord),
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

/// Where a closed limit acts, in fixed axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<S = f64> {
    /// The place.
    pub point: Vec2<S>,
    /// Unit normal, along which the force on the disk's body pushes.
    pub normal: Vec2<S>,
    /// Unit tangent: the normal turned clockwise by a right angle.
    pub tangent: Vec2<S>,
}

impl Gap {
    /// The gap, m (rad for a stop of an angle); below 0 where the limit is violated.
    pub fn gap<T: Scalar>(&self, m: &Mechanism, mode: &Mode, poses: &impl Poses<T>, piece: Piece) -> T {
        match self {
            Gap::Gauge(law) => law.eval(&Config { poses, m, mode }),
            Gap::Touch(touch) => touch.gap(m, poses, piece.index),
            Gap::Cord(cord) => cord.gap(m, poses, piece),
        }
    }

    /// A gauge whose rate is the speed of sliding, where the gap is 0: of the disk's material along the tangent, as seen
    /// from the surface, m. None where nothing can rub.
    pub fn slide<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, piece: Piece) -> Option<T> {
        match self {
            Gap::Touch(touch) => Some(touch.slide(m, poses, piece.index)),
            Gap::Gauge(_) | Gap::Cord(_) => None,
        }
    }

    /// The piece that tells the gap at a configuration.
    pub fn piece(&self, m: &Mechanism, poses: &impl Poses<f64>, last: Piece) -> Piece {
        match self {
            Gap::Gauge(_) => last,
            Gap::Touch(touch) => Piece { index: touch.piece(m, poses), ..last },
            Gap::Cord(cord) => Piece { index: cord.piece(m, poses, last), ..last },
        }
    }

    /// The borders of a piece.
    pub fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, piece: Piece) -> Vec<Border> {
        match self {
            Gap::Gauge(_) => vec![],
            Gap::Touch(touch) => touch.borders(m, poses, piece.index),
            Gap::Cord(cord) => cord.borders(m, poses, piece),
        }
    }

    /// Whether the gap can close on a piece: a point does not stay on a corner.
    pub fn can_close(&self, piece: usize) -> bool {
        match self {
            Gap::Touch(touch) => touch.can_close(piece),
            Gap::Gauge(_) | Gap::Cord(_) => true,
        }
    }

    /// Where a touch acts.
    pub fn contact(&self, m: &Mechanism, poses: &impl Poses<f64>, piece: Piece) -> Option<Contact> {
        match self {
            Gap::Touch(touch) => Some(touch.contact(m, poses, piece.index)),
            Gap::Gauge(_) | Gap::Cord(_) => None,
        }
    }
}
