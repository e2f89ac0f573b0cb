//! Slider: a line of one body moves along a line of the other; written with a normal force and a
//! couple, or as two rollers with a normal force each.

use super::*;
use std::f64::consts::TAU;

/// Two lines kept together.
pub struct Slider;

impl Joint for Slider {
    fn card(&self) -> Card {
        Card::new("slider", "A line of the second body moves along a line of the first.")
            .needs("along", FieldKind::Line, Role::First, "m", "the line of the first body")
            .needs("line", FieldKind::Line, Role::Second, "m", "the line of the second body")
            .coordinate("s", "m")
            .along("the slider {}")
            .row(RowCard::of(LoadCard::press("normal force", "Fn")))
            .couple()
            .with_friction()
            .glyph("block")
    }
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: S::zero(), angle: S::zero() })
    }
    #[inline]
    fn held(&self) -> Option<&'static [usize]> {
        Some(&[1, 2])
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x]))
    }
    fn period(&self, _: &Numbers<f64>, row: usize) -> f64 {
        [0.0, TAU][row]
    }
}

/// A slider expressed as two rollers: two points of the second body stay on a line of the first.
///
/// The second marker sits at the first roller and points towards the other; the joint's number is
/// the distance between them.
pub struct Rollers;

impl Joint for Rollers {
    fn card(&self) -> Card {
        Card::new("rollers", "Two points of the second body stay on a line of the first.")
            .needs("along", FieldKind::Line, Role::First, "m", "the line of the first body")
            .needs("points", FieldKind::Points, Role::Second, "m", "the two rollers of the second body")
            .coordinate("s", "m")
            .along("the way of {}")
            .row(RowCard::of(LoadCard::press("force of the first roller", "F1")))
            .row(RowCard { beside: true, ..RowCard::of(LoadCard::press("force of the second roller", "F2")) })
            .glyph("rollers")
    }
    fn pose<S: Scalar>(&self, _: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: S::zero(), angle: S::zero() })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (sin, _) = r.angle.sin_cos();
        Some(Rows3::of(&[r.y, r.y + n.of[0] * sin]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x]))
    }
}
