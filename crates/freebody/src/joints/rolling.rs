//! Rolling without slip, in the plane a holonomic joint: of a circle on a line, of a circle on or in a circle.

use super::*;
use std::f64::consts::TAU;

/// The row that keeps a circle from slipping.
fn friction(reading: &'static str) -> RowCard {
    let load = LoadCard { tangent: true, ..LoadCard::force("friction force", reading, "F") };
    RowCard { is_relative: true, ..RowCard::of(load) }
}

/// A circle of the second body rolls on a line of the first, on the line's left side.
pub struct Rolling;

impl Joint for Rolling {
    fn card(&self) -> Card {
        Card::new("rolling", "A circle of the second body rolls without slip on a line of the first, on its left side.")
            .needs("on", FieldKind::Line, Role::First, "m", "the line of the first body")
            .needs("circle", FieldKind::Circle, Role::Second, "m", "the circle of the second body")
            .coordinate("s", "m")
            .row(RowCard::of(LoadCard::press("normal force", "Fn")))
            .row(friction("Fs"))
            .glyph("wheel")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        Some(Relative { x: q[0], y: n.of[0], angle: -q[0] / n.of[0] })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.y - n.of[0], r.x + n.of[0] * r.angle]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.x]))
    }
    fn contact<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
        vec2(r.x, r.y - n.of[0])
    }
}

/// A circle of the second body rolls on a circle of the first, outside it or inside it.
///
/// Numbers: radius of the first, radius of the second, and 1 when it rolls inside. With ψ the
/// direction of the line of centres seen from the first body and D the distance of the centres,
/// equal velocities at the contact give D dψ = ±r₂ d(angle).
pub struct RollingCircles;

impl RollingCircles {
    /// Distance of the centres, and the second radius, negative inside.
    fn sizes<S: Scalar>(n: &Numbers<S>) -> (S, S) {
        let side = S::one() - n.of[2].scale(2.0);
        (n.of[0] + side * n.of[1], side * n.of[1])
    }
}

impl Joint for RollingCircles {
    fn card(&self) -> Card {
        Card::new("rolling_circles", "A circle of the second body rolls without slip on or in a circle of the first.")
            .needs("on", FieldKind::Circle, Role::First, "m", "the circle of the first body")
            .needs("circle", FieldKind::Circle, Role::Second, "m", "the circle of the second body")
            .takes("inside", FieldKind::Flag, "", "false", "whether it rolls inside the first circle")
            .coordinate("direction", "rad")
            .row(RowCard::of(LoadCard::press("normal force", "F1")))
            .row(friction("F2"))
            .glyph("wheels")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (distance, r2) = Self::sizes(n);
        let (sin, cos) = q[0].sin_cos();
        Some(Relative { x: distance * cos, y: distance * sin, angle: distance * q[0] / r2 })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (distance, r2) = Self::sizes(n);
        Some(Rows3::of(&[r.at().norm() - distance, distance * r.y.atan2(r.x) - r2 * r.angle]))
    }
    fn measure<S: Scalar>(&self, _: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        Some(Rows3::of(&[r.y.atan2(r.x)]))
    }
    fn contact<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
        r.at() * (n.of[0] / r.at().norm())
    }
    fn period(&self, n: &Numbers<f64>, row: usize) -> f64 {
        [0.0, TAU * Self::sizes(n).0][row]
    }
}
