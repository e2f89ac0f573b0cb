//! Link: a rigid massless rod with a hinge at each end; two points at a fixed distance.

use super::*;

/// Two points kept at a distance.
pub struct Link;

impl Joint for Link {
    fn card(&self) -> Card {
        Card::new("link", "A rigid massless rod between two points, hinged at both ends.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the points at its ends")
            .needs("length", FieldKind::Number, Role::Number, "m", "the distance")
            .coordinate("direction", "rad")
            .across("the link {}")
            .turn()
            .row(RowCard::of(LoadCard::tension()))
            .glyph("link")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (sin, cos) = q[0].sin_cos();
        Some(Relative { x: n.of[0] * cos, y: n.of[0] * sin, angle: q[1] })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        // Where it closes it is the distance less the length, with its first two derivatives; and it has no root.
        let length = n.of[0];
        Some(Rows3::of(&[(r.at().dot(r.at()) - length * length) / length.scale(2.0)]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.y.atan2(r.x), r.angle]))
    }
}
