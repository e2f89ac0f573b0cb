//! A disk, or a point, and the surfaces that it can touch.

use super::{Marker, ValueId};

/// A disk against a surface. Every contact of the plane is made of these: polygons meet with the corners of one against
/// the sides of the other.
#[derive(Clone, Debug)]
pub struct ContactPair {
    /// The disk.
    pub disk: Disk,
    /// The surface.
    pub against: Profile,
}

/// A disk of a body; a point has radius 0.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// Site of its centre.
    pub centre: usize,
    /// Radius; None for a point.
    pub radius: Option<ValueId>,
    /// Sites of the corners before and after it, where it is the corner of a polygon.
    pub beside: Option<[usize; 2]>,
}

/// A surface of a body.
#[derive(Clone, Debug)]
pub enum Profile {
    /// A straight line without ends; the free side is on its left.
    Line(Marker),
    /// A circle.
    Circle {
        /// Site of its centre.
        centre: usize,
        /// Radius.
        radius: ValueId,
        /// Whether the free side is inside.
        hollow: bool,
    },
    /// A circle with ends.
    Arc(Arc),
    /// Straight sides with convex corners.
    Chain(Chain),
    /// Lines and arcs with a continuous tangent.
    Track(Track),
}

/// Part of a circle of a body, counter-clockwise from one direction to another.
///
/// Feature 0 is the arc, 1 and 2 its start and its end. A disk touches the ends as circles of radius 0. A point cannot:
/// there the lines from the centre through the ends bound the solid, and the gap is the larger of the heights over the
/// arc and over the line through the nearer end.
#[derive(Clone, Debug)]
pub struct Arc {
    /// Site of its centre.
    pub centre: usize,
    /// Radius.
    pub radius: ValueId,
    /// Whether the free side is inside.
    pub hollow: bool,
    /// Directions of its ends from the centre, in the body's frame; the second less than a turn beyond the first.
    pub ends: [ValueId; 2],
}

/// Straight sides one after the other, on one body, the free side on the left of each: the edge of a solid on their
/// right. Each corner turns to the right, so a closed one has its corners clockwise.
///
/// Feature 2i is side i, from corner i to the next; feature 2i + 1 the corner that ends it. The corner at which an open
/// chain starts is the last number, twice the number of sides.
///
/// A disk touches corners as circles of radius 0, and its gap is the distance. A point cannot: its distance from a
/// corner has no direction there. It has features for sides only, each prolonged until it meets the next, and its gap
/// is the largest of its heights over them: 0 just on the sides, and outside a corner less than the distance. The ends
/// of an open chain are then bounds of the solid too: along the side that follows in a concave corner, a little behind
/// it, else straight back, or across to the other end where that would leave corners outside.
///
/// Where two corners meet, the sides of either polygon may keep them apart, and one side that does is enough. So the
/// corner of a polygon that is lower over the sides here than the corners here are over a side of its own has a piece
/// for that, the number 1: what closes is the other corner, on that side.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Sites of its corners.
    pub corners: Vec<usize>,
    /// Whether the last corner is joined to the first.
    pub closed: bool,
    /// Where the surface goes on beyond the ends with a concave corner: the sites of its corners before the first and
    /// after the last of this chain.
    pub beyond: [Option<usize>; 2],
}

/// A way of straight and round segments on one body, with a continuous tangent; the free side is on its left.
///
/// Features 0 to n − 1 are the segments in order, n is the start and n + 1 the end. A disk touches the two ends as
/// circles of radius 0, a point cannot; behind the track there is nothing. While the gap is closed, the piece goes from
/// a segment to the next by what is past their common point, so a track may cross itself, as a loop does. A disk
/// touches it at one place at a time.
#[derive(Clone, Debug)]
pub struct Track {
    /// Its segments.
    pub stretches: Vec<Stretch>,
}

/// A line, or an arc of less than half a turn.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Sites where it starts and ends.
    pub ends: [usize; 2],
    /// Site of the centre of an arc.
    pub centre: Option<usize>,
}
