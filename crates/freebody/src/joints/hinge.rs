//! Hinge: a point of one body stays on a point of the other.

use super::*;

/// Two points kept together; the bodies turn freely about them.
pub struct Hinge;

impl Joint for Hinge {
    fn card(&self) -> Card {
        Card::new("hinge", "A point of one body stays on a point of the other.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the points; more than two share one pin")
            .turn()
            .pin()
            .with_friction()
            .glyph("pin")
    }
    #[inline]
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: S::zero(), y: S::zero(), angle: q[0] })
    }
    #[inline]
    fn held(&self) -> Option<&'static [usize]> {
        Some(&[0, 1])
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.angle]))
    }
}
