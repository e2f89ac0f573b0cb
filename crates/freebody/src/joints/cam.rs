//! Joints along a curve of the first body: a pin in a curved slot, and a round follower on a cam.
//!
//! The curve parameter is a coordinate of its own, so that a curve may cross itself and no closest
//! point is ever searched for. Such a joint has no residual: where it would close a loop, the
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

/// A circle of the second body that touches a curve of the first, on one side of it.
pub struct Cam;

impl Joint for Cam {
    fn card(&self) -> Card {
        Card::new("cam", "A round follower of the second body stays on a curve of the first, on one side of it.")
            .needs("along", FieldKind::Curve, Role::First, "m", "the curve of the first body")
            .needs("follower", FieldKind::Circle, Role::Second, "m", "the circle of the second body")
            .takes(
                "right",
                FieldKind::Flag,
                "",
                "false",
                "whether it stays on the right of the curve as `s` grows, not on its left",
            )
            .coordinate("s", "")
            .turn()
            .row(RowCard::of(LoadCard::force("normal force", "Fn", "N")))
            .glyph("follower")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (at, slope) = n.curve?.at(q[0]);
        let side = S::one() - n.of[1].scale(2.0);
        let centre = at + slope.perp() * (side * n.of[0] / slope.norm());
        Some(Relative { x: centre.x, y: centre.y, angle: q[1] })
    }
}
