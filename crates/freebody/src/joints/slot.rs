//! Slot: a pin of one body moves along a straight line of the other.

use super::*;

/// A point kept on a line.
pub struct Slot;

impl Joint for Slot {
    fn card(&self) -> Card {
        Card::new("slot", "A point of the second body moves along a line of the first.")
            .needs("along", FieldKind::Line, Role::First, "m", "the line of the first body")
            .needs("point", FieldKind::Point, Role::Second, "m", "the point of the second body")
            .coordinate("s", "m")
            .along("the slot {}")
            .turn()
            .row(RowCard::of(LoadCard::press("normal force", "Fn")))
            .with_friction()
            .glyph("slot")
    }
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: S::zero(), angle: q[1] })
    }
    #[inline]
    fn held(&self) -> Option<&'static [usize]> {
        Some(&[1])
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x, r.angle]))
    }
}
