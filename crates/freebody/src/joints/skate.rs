//! Skate: a constraint on rates that no constraint on places gives (Neimark & Fufaev, *Dynamics of Nonholonomic
//! Systems*, 1972, ch. I).

use super::*;

/// The second body's marker moves only along its own x axis, as seen from the first body.
pub struct Skate;

impl Joint for Skate {
    fn card(&self) -> Card {
        Card::new(
            "skate",
            "A point of the second body moves only along a line of that body, as an edge or wheel seen from above.",
        )
        .needs("on", FieldKind::Point, Role::First, "m", "a point of the body on which it moves")
        .needs("line", FieldKind::Line, Role::Second, "m", "the line of the second body, through the point")
        .row(RowCard { of_rates: true, ..RowCard::of(LoadCard::force("sideways force", "Fn", "F")) })
        .glyph("skate")
    }
    fn rate_row<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<[S; 3]> {
        let (sin, cos) = r.angle.sin_cos();
        Some([-sin, cos, S::zero()])
    }
}
