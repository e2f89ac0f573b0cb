//! No joint at all: the place of a body from a point of another, in Cartesian or polar coordinates.

use super::*;

/// Cartesian coordinates.
pub struct Free;

impl Joint for Free {
    fn card(&self) -> Card {
        Card::new("free", "Free motion, in Cartesian coordinates from a point of the first body.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the point measured from and the point measured to")
            .coordinate("x", "m")
            .coordinate("y", "m")
            .turn()
    }
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: q[1], angle: q[2] })
    }
    fn residual<S: Scalar>(&self, _: &Numbers<S>, _: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x, r.y, r.angle]))
    }
}

/// Polar coordinates; singular where the distance is 0. A motion through the pole carries a distance below 0.
pub struct Polar;

impl Joint for Polar {
    fn card(&self) -> Card {
        Card::new("polar", "Free motion, in polar coordinates about a point of the first body; a motion through the pole takes `r` below 0.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the pole and the point measured to")
            .coordinate("r", "m")
            .along("the radius of {}")
            .coordinate("direction", "rad")
            .across("the radius of {}, times r,")
            .turn()
    }
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (sin, cos) = q[1].sin_cos();
        Some(Relative { x: q[0] * cos, y: q[0] * sin, angle: q[2] })
    }
    fn residual<S: Scalar>(&self, _: &Numbers<S>, _: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.at().norm(), r.y.atan2(r.x), r.angle]))
    }
    fn unsigned(&self, k: usize) -> bool {
        k == 0
    }
}
