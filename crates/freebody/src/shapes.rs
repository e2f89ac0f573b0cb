//! Mass centre and inertia of homogeneous plane shapes (Meriam & Kraige, *Dynamics*, App. D).

use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

/// A homogeneous shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// All mass in one point; also a body whose inertia is given.
    Point,
    /// A thin rod along x, about its middle. Size: length.
    Rod,
    /// A disk. Size: radius.
    Disk,
    /// A thin ring. Size: radius.
    Ring,
    /// A rectangle about its middle. Sizes: width along x, height along y.
    Rectangle,
    /// A simple polygon. Sizes: x and y of each corner in turn.
    Polygon,
}

/// The shapes with their words and the words of their sizes; a polygon's corners come as a list.
pub const SHAPES: &[(&str, Shape, &[&str])] = &[
    ("point", Shape::Point, &[]),
    ("given", Shape::Point, &[]),
    ("rod", Shape::Rod, &["length"]),
    ("disk", Shape::Disk, &["radius"]),
    ("ring", Shape::Ring, &["radius"]),
    ("rectangle", Shape::Rectangle, &["width", "height"]),
    ("polygon", Shape::Polygon, &[]),
];

impl Shape {
    /// Mass centre in the shape's own axes, and the square of the radius of gyration about it.
    pub fn geometry<S: Scalar>(self, sizes: &[S]) -> (Vec2<S>, S) {
        let square = |i: usize| sizes[i] * sizes[i];
        match self {
            Shape::Point => (Vec2::zero(), S::zero()),
            Shape::Rod => (Vec2::zero(), square(0) / S::of(12.0)),
            Shape::Disk => (Vec2::zero(), square(0).scale(0.5)),
            Shape::Ring => (Vec2::zero(), square(0)),
            Shape::Rectangle => (Vec2::zero(), (square(0) + square(1)) / S::of(12.0)),
            Shape::Polygon => polygon(sizes),
        }
    }
}

/// Green's theorem over the triangles that the sides span with the first corner, so that a polygon far
/// from the origin loses no digits.
fn polygon<S: Scalar>(sizes: &[S]) -> (Vec2<S>, S) {
    let corner = |i: usize| vec2(sizes[2 * i], sizes[2 * i + 1]);
    let n = sizes.len() / 2;
    let (mut area, mut first, mut second) = (S::zero(), Vec2::zero(), S::zero());
    for i in 1..n.saturating_sub(1) {
        let (a, b) = (corner(i) - corner(0), corner(i + 1) - corner(0));
        let twice = a.cross(b);
        area += twice.scale(0.5);
        first += (a + b) * (twice / S::of(6.0));
        second += twice * ((a.dot(a) + a.dot(b) + b.dot(b)) / S::of(12.0));
    }
    let centre = first * (S::one() / area);
    (corner(0) + centre, second / area - centre.dot(centre))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_told_as_a_polygon_is_the_same() {
        let (centre, k2) = Shape::Polygon.geometry(&[1.0, 2.0, 4.0, 2.0, 4.0, 4.0, 1.0, 4.0]);
        let (_, same) = Shape::Rectangle.geometry(&[3.0, 2.0]);
        assert!((centre.x - 2.5).abs() < 1e-14 && (centre.y - 3.0).abs() < 1e-14);
        assert!((k2 - same).abs() < 1e-14, "{k2} {same}");
    }

    #[test]
    fn a_polygon_of_many_corners_tends_to_a_disk() {
        let n = 2000;
        let corners: Vec<f64> = (0..n)
            .flat_map(|i| {
                let a = std::f64::consts::TAU * i as f64 / n as f64;
                [a.cos(), a.sin()]
            })
            .collect();
        let (_, k2) = Shape::Polygon.geometry(&corners);
        // The area of an inscribed n-gon differs from the disk's by order 1/n².
        assert!((k2 - 0.5).abs() < 1e-5);
    }
}
