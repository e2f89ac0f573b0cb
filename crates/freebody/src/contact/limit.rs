//! Limits: gauges that cannot fall below zero.

use crate::kinematics::{Config, Poses};
use crate::mechanism::{Gap, Mechanism};
use crate::mode::{Border, Mode, Piece};
use crate::plane::Vec2;
use crate::scalar::Scalar;

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
