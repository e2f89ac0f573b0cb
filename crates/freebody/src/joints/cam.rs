//! Joints along a curve of the first body: a pin in a curved slot, a round follower on a cam, and one that can lift off.
//!
//! The curve parameter is a coordinate of its own, so that a curve may cross itself and no closest
//! point is ever searched for. Such a joint has no residual of its own: where it would close a loop, the
//! mechanism puts a massless body on the curve and closes the loop there with a hinge, or a weld.

use super::*;

/// A pin in a curved slot.
pub struct CurvedSlot;

impl Joint for CurvedSlot {
    fn card(&self) -> Card {
        Card::new("curved_slot", "A point of the second body moves along a curve of the first.")
            .needs("along", FieldKind::Curve, Role::First, "m", "the curve of the first body")
            .needs("point", FieldKind::Point, Role::Second, "m", "the point of the second body")
            .coordinate("s", "")
            .along("the tangent of {}")
            .turn()
            .row(RowCard::of(LoadCard::force("normal force", "Fn", "N")))
            .with_friction()
            .glyph("curve")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (at, _) = n.curve?.at(q[0]);
        Some(Relative { x: at.x, y: at.y, angle: q[1] })
    }
}

const ON_THE_RIGHT: &str = "whether it stays on the right of the curve as `s` grows, not on its left";

/// The place so far from a place of the curve, on the side of the follower.
fn beside<S: Scalar>(n: &Numbers<S>, s: S, distance: S) -> Option<Vec2<S>> {
    let (at, slope) = n.curve?.at(s);
    let side = S::one() - n.of[1].scale(2.0);
    Some(at + slope.perp() * (side * distance / slope.norm()))
}

/// A circle of the second body that touches a curve of the first, on one side of it.
pub struct Cam;

impl Joint for Cam {
    fn card(&self) -> Card {
        Card::new("cam", "A round follower of the second body stays on a curve of the first, on one side of it.")
            .needs("along", FieldKind::Curve, Role::First, "m", "the curve of the first body")
            .needs("follower", FieldKind::Circle, Role::Second, "m", "the circle of the second body")
            .takes("right", FieldKind::Flag, "", "false", ON_THE_RIGHT)
            .coordinate("s", "")
            .turn()
            .row(RowCard::of(LoadCard::force("normal force", "Fn", "N")))
            .glyph("follower")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let centre = beside(n, q[0], n.of[0])?;
        Some(Relative { x: centre.x, y: centre.y, angle: q[1] })
    }
}

/// A circle of the second body beside a curve of the first, on one side of it: it moves freely there, and the coordinates are
/// the place nearest to it and the gap. That the gap is not negative is a stop, which the model file makes.
pub struct OneSidedCam;

impl Joint for OneSidedCam {
    fn card(&self) -> Card {
        Card::new(
            "one_sided_cam",
            "A round follower of the second body is pushed by a curve of the first, on one side of it, lifts off and lands again.",
        )
        .needs("along", FieldKind::Curve, Role::First, "m", "the curve of the first body")
        .needs("follower", FieldKind::Circle, Role::Second, "m", "the circle of the second body; with radius 0 a point")
        .takes("right", FieldKind::Flag, "", "false", ON_THE_RIGHT)
        .coordinate("s", "")
        .gap()
        .turn()
        .glyph("follower")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let centre = beside(n, q[0], n.of[0] + q[1])?;
        Some(Relative { x: centre.x, y: centre.y, angle: q[2] })
    }
    fn residual<S: Scalar>(&self, _: &Numbers<S>, _: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[]))
    }
}
