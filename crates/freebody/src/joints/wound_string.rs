//! A string from a point to the drum on which it is wound, always straight: its line turns about the point, and its
//! free length changes as the drum rolls along that line.
//!
//! With φ the direction of the line, e along it and n to its left, l the free length and R the radius, negative for a
//! drum on the right of the string: it touches the drum at l e from the point, the centre is at l e + R n, and without
//! slip the drum turns by φ − l/R.

use super::*;
use std::f64::consts::TAU;

/// A string wound on a drum. Numbers: radius of the drum, 1 when it is on the right of the string.
pub struct WoundString;

impl WoundString {
    /// The radius, with the sign of its side.
    fn radius<S: Scalar>(n: &Numbers<S>) -> S {
        n.of[0] * (S::one() - n.of[1].scale(2.0))
    }
    /// Direction and free length of the tangent from the point to the drum. Within the drum there is none: a negative
    /// length leads a search for a start out of it, and is no start.
    fn line<S: Scalar>(n: &Numbers<S>, r: &Relative<S>) -> (S, S) {
        let (at, radius) = (r.at(), Self::radius(n));
        let square = at.dot(at) - radius * radius;
        let length = S::select(square.value() < 0.0, -square, square).sqrt();
        let free = S::select(square.value() < 0.0, -length, length);
        (at.y.atan2(at.x) - radius.atan2(free), free)
    }
}

impl Joint for WoundString {
    fn card(&self) -> Card {
        Card::new(
            "wound_string",
            "A straight string, tied to the first body and wound without slip on a drum of the second.",
        )
        .needs("from", FieldKind::Point, Role::First, "m", "the point of the first body where it is tied")
        .needs("drum", FieldKind::Circle, Role::Second, "m", "the circle of the second body on which it is wound")
        .takes("right", FieldKind::Flag, "", "false", "whether the drum is on the right of the string, not on its left")
        .coordinate("direction", "rad")
        .across("the string {}")
        .coordinate("length", "m")
        .ends("is wound up")
        .row(RowCard { is_relative: true, ..RowCard::of(LoadCard::tension()) })
        .glyph("wound_string")
    }
    fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
        let (radius, (sin, cos)) = (Self::radius(n), q[0].sin_cos());
        Some(Relative { x: q[1] * cos - radius * sin, y: q[1] * sin + radius * cos, angle: q[0] - q[1] / radius })
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (direction, free) = Self::line(n, r);
        Some(Rows3::of(&[free + Self::radius(n) * (r.angle - direction)]))
    }
    fn measure<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (direction, free) = Self::line(n, r);
        Some(Rows3::of(&[direction, free]))
    }
    fn contact<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
        let (at, (_, free)) = (r.at(), Self::line(n, r));
        (at * free - at.perp() * Self::radius(n)) * (free / at.dot(at))
    }
    fn period(&self, n: &Numbers<f64>, _: usize) -> f64 {
        TAU * n.of[0]
    }
}
