//! One feature of a profile as the centre of the disk sees it.

use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

/// A straight or a round face.
#[derive(Clone, Copy, Debug)]
pub(super) enum LocalSurface<T> {
    /// Straight; the free side is on its left.
    Flat {
        /// From a point of the face to the centre of the disk.
        to: Vec2<T>,
        /// Its direction.
        along: Vec2<T>,
    },
    /// A circle, or with radius 0 a corner.
    Round {
        /// From its centre to that of the disk.
        to: Vec2<T>,
        /// Its radius.
        radius: T,
        /// +1 where the free side is outside, −1 inside.
        side: f64,
    },
}

impl<T: Scalar> LocalSurface<T> {
    /// Distance to a disk of radius `r`.
    pub fn gap(&self, r: T) -> T {
        match *self {
            LocalSurface::Flat { to, along } => along.cross(to) - r,
            LocalSurface::Round { to, radius, side } => (polar(to).0 - radius).scale(side) - r,
        }
    }

    /// A gauge whose rate at gap 0 is the speed of sliding, for turns of disk and surface.
    ///
    /// On a straight face the centre moves along it with ξ̇ − r ω of the face, and the rim by r ω of the disk more. On
    /// a round one the point of contact goes round with φ̇, and each rim passes through it with its own turn less φ.
    pub fn slide(&self, r: T, [disk, surface]: [T; 2]) -> T {
        match *self {
            LocalSurface::Flat { to, along } => along.dot(to) + r * (disk - surface),
            LocalSurface::Round { to, radius, side } => {
                let direction = polar(to).1;
                r * (disk - direction) + (radius * (surface - direction)).scale(side)
            }
        }
    }
}

impl<T: Scalar> LocalSurface<T> {
    /// The normal, and the vector from the point of contact to the centre of the disk.
    pub fn foot(&self) -> (Vec2<T>, Vec2<T>) {
        match *self {
            LocalSurface::Flat { to, along } => {
                let normal = along.perp();
                (normal, normal * normal.dot(to))
            }
            LocalSurface::Round { to, radius, side } => {
                let length = to.norm();
                let outward = match length.value() > 0.0 {
                    true => to * (T::one() / length),
                    false => vec2(T::one(), T::zero()),
                };
                (outward * T::of(side), to - outward * radius)
            }
        }
    }
}

/// Length and direction of a vector; constant where it is 0, as nothing can be said of its changes there.
fn polar<T: Scalar>(v: Vec2<T>) -> (T, T) {
    if v.x.value() == 0.0 && v.y.value() == 0.0 {
        return (T::zero(), T::zero());
    }
    (v.norm(), v.y.atan2(v.x))
}
