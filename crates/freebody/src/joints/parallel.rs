//! Parallel guide: two bodies keep their directions to each other and shift freely, as on a drawing machine.

use super::*;
use std::f64::consts::TAU;

/// Two bodies that cannot turn against each other.
pub struct Parallel;

impl Joint for Parallel {
    fn card(&self) -> Card {
        Card::new("parallel", "The second body shifts freely and does not turn against the first.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the points whose shift is measured")
            .takes("angle", FieldKind::Number, "rad", "0", "turn of the second body against the first")
            .coordinate("x", "m")
            .coordinate("y", "m")
            .couple()
            .outline(&[&[[-0.7, -0.6], [0.0, 0.6]], &[[0.0, -0.6], [0.7, 0.6]]])
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: q[1], angle: n.of[0] })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.angle - n.of[0]]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x, r.y]))
    }
    fn period(&self, _: &Numbers<f64>, _: usize) -> f64 {
        TAU
    }
}
