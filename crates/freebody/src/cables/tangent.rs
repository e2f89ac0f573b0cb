//! Straight segments of a string: common tangents of circles and points.

use crate::kinematics::Poses;
use crate::mechanism::Mechanism;
use crate::plane::Vec2;
use crate::scalar::Scalar;
use std::f64::consts::TAU;

/// A circle that a string touches, or a point, which is a circle of radius 0.
pub(super) struct WrapCircle<T> {
    /// Site by which its centre is given.
    pub site: usize,
    /// The centre from that site, fixed axes, m.
    pub off: Vec2<T>,
    /// Radius, m; negative where the string, followed from its first end, goes round clockwise.
    pub radius: T,
}

/// A straight segment.
pub(super) struct FreeSegment<T> {
    /// Its length, m.
    pub length: T,
    /// Its direction, from the first end of the string towards the second, rad in fixed axes; known up to whole turns.
    pub angle: T,
    /// How much of its length stands for none, m.
    pub none: f64,
    /// How far one end lies within the circle of the other, m.
    pub within: f64,
}

/// Square of the free length over that of the distance of centres below which it is round-off.
const TOUCHING: f64 = 1e-16;

impl<T: Scalar> WrapCircle<T> {
    /// A point at a site.
    pub fn point(site: usize) -> Self {
        WrapCircle { site, off: Vec2::zero(), radius: T::zero() }
    }
}

impl<T: Scalar> FreeSegment<T> {
    /// The common tangent from one circle to the next. With the tangent's unit vector t and n on its left, the points
    /// of touch are c − r n, so that the vector of the centres is L t + (r₂ − r₁) n. Where a point lies on the rim, or
    /// has been pushed within it, L keeps its least value: length and arc together are smooth there, though neither is
    /// alone.
    pub fn between(m: &Mechanism, poses: &impl Poses<T>, a: &WrapCircle<T>, b: &WrapCircle<T>) -> Self {
        let span = poses.span(a.site, b.site, m) + b.off - a.off;
        let square = span.dot(span);
        // One point has neither distance nor direction from itself.
        if square.value() < f64::MIN_POSITIVE {
            return FreeSegment { length: T::zero(), angle: T::zero(), none: 0.0, within: 0.0 };
        }
        let aside = b.radius - a.radius;
        let (rest, least) = (square - aside * aside, square.value() * TOUCHING);
        let is_long = rest.value() > least;
        let length = T::select(is_long, rest, T::of(least)).sqrt();
        let none = if is_long { 0.0 } else { length.value() };
        let within = f64::max(aside.value().abs() - square.value().sqrt(), 0.0);
        FreeSegment { length, angle: span.y.atan2(span.x) - aside.atan2(length), none, within }
    }
}

/// An angle turned by whole turns to where it is nearest to another, rad.
pub(super) fn near<T: Scalar>(angle: T, to: f64) -> T {
    angle + T::of(TAU * ((to - angle.value()) / TAU).round())
}
