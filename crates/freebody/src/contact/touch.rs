//! A disk, or a point, against a surface.

use super::{Border, Contact};
use crate::gauges::Poses;
use crate::mechanism::{Marker, Mechanism, Slot};
use crate::scalar::Scalar;

/// A disk against a surface. Every contact of the plane is made of these: polygons meet with the corners of one against
/// the sides of the other.
#[derive(Clone, Debug)]
pub struct Touch {
    /// The disk.
    pub disk: Disk,
    /// The surface.
    pub against: Profile,
}

/// A disk of a body; a point has radius 0.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// Site of its centre.
    pub centre: usize,
    /// Radius; None for a point.
    pub radius: Option<Slot>,
}

/// A surface of a body.
#[derive(Clone, Debug)]
pub enum Profile {
    /// A straight line without ends; the free side is on its left.
    Line(Marker),
    /// A circle.
    Circle {
        /// Site of its centre.
        centre: usize,
        /// Radius.
        radius: Slot,
        /// Whether the free side is inside.
        hollow: bool,
    },
    /// A convex chain of straight sides, the free side on the left of each; or a closed convex polygon, its corners
    /// clockwise.
    Chain {
        /// Sites of its corners, all on one body.
        corners: Vec<usize>,
        /// Whether the last corner is joined to the first.
        closed: bool,
    },
}

impl Touch {
    /// Distance of disk and surface, m.
    pub fn gap<T: Scalar>(&self, _m: &Mechanism, _poses: &impl Poses<T>, _piece: usize) -> T {
        todo!()
    }
    /// A gauge whose rate is the speed of sliding where the gap is 0, m.
    pub fn slide<T: Scalar>(&self, _m: &Mechanism, _poses: &impl Poses<T>, _piece: usize) -> T {
        todo!()
    }
    /// The nearest piece: 2i for side i, 2i + 1 for the corner that ends it.
    pub fn piece(&self, _m: &Mechanism, _poses: &impl Poses<f64>) -> usize {
        todo!()
    }
    /// Where the piece ends.
    pub fn borders(&self, _m: &Mechanism, _poses: &impl Poses<f64>, _piece: usize) -> Vec<Border> {
        todo!()
    }
    /// Whether the gap can close on a piece: a point does not stay on a corner.
    pub fn can_close(&self, piece: usize) -> bool {
        self.disk.radius.is_some() || !matches!(self.against, Profile::Chain { .. }) || piece % 2 == 0
    }
    /// The point of contact with its directions.
    pub fn contact(&self, _m: &Mechanism, _poses: &impl Poses<f64>, _piece: usize) -> Contact {
        todo!()
    }
}
