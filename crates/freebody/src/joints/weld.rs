//! Weld: two bodies move as one.

use super::*;
use std::f64::consts::TAU;

/// No relative motion at all.
pub struct Weld;

impl Joint for Weld {
    fn card(&self) -> Card {
        Card::new("weld", "The two bodies move as one.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the points that coincide")
            .takes("angle", FieldKind::Number, "rad", "0", "turn of the second body against the first")
            .pin()
            .couple()
            .glyph("weld")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, _: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: S::zero(), y: S::zero(), angle: n.of[0] })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x, r.y, r.angle - n.of[0]]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, _: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[]))
    }
    fn period(&self, _: &Numbers<f64>, row: usize) -> f64 {
        [0.0, 0.0, TAU][row]
    }
}
