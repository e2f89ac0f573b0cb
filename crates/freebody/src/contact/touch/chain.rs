//! Straight sides with convex corners.

use super::{heading, Disk, Face};
use crate::contact::Border;
use crate::gauges::Poses;
use crate::mechanism::Mechanism;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// Straight sides one after the other, on one body, the free side on the left of each: the edge of a solid on their right.
/// Each corner turns to the right, so a closed one has its corners clockwise.
///
/// Piece 2i is side i, from corner i to the next; piece 2i + 1 the corner that ends it. The corner at which an open chain
/// starts is the last number, twice the number of sides.
///
/// A disk touches corners as circles of radius 0, and its gap is the distance. A point cannot: its distance from a corner
/// has no direction there. It has pieces for sides only, each prolonged until it meets the next, and its gap is the largest
/// of its distances from them. That is 0 on the chain and nowhere else, but outside a corner less than the distance. An open
/// chain is then bounded at its ends by the line of the side that follows in a concave corner, or straight back; but all its
/// corners are inside.
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

/// A side and the centre of a disk.
struct Seen<T> {
    /// From the start of the side to the centre.
    to: Vec2<T>,
    /// Direction of the side.
    along: Vec2<T>,
    length: f64,
}

impl<T: Scalar> Seen<T> {
    /// Place of the centre along the side.
    fn place(&self) -> f64 {
        self.along.dot(self.to).value()
    }
    /// How far it is past the end.
    fn past(&self) -> f64 {
        self.place() - self.length
    }
    /// Height of the centre over the side.
    fn height(&self) -> f64 {
        self.along.cross(self.to).value()
    }
}

impl Chain {
    /// Number of its sides.
    pub fn sides(&self) -> usize {
        self.corners.len() - usize::from(!self.closed)
    }

    /// Corner `i`, round and round.
    fn corner(&self, i: usize) -> usize {
        self.corners[i % self.corners.len()]
    }

    fn seen<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, disk: &Disk, side: usize) -> Seen<T> {
        let [from, to] = [side, side + 1].map(|i| self.corner(i));
        let length = (poses.arm(to) - poses.arm(from)).norm().value();
        Seen { to: poses.span(from, disk.centre, m), along: heading(m, poses, from, to), length }
    }

    pub(super) fn face<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, disk: &Disk, piece: usize) -> Face<T> {
        let first = piece == 2 * self.sides();
        if piece % 2 == 0 && !first {
            let Seen { to, along, .. } = self.seen(m, poses, disk, piece / 2);
            return Face::Flat { to, along };
        }
        let corner = if first { self.corners[0] } else { self.corner(piece / 2 + 1) };
        let to = poses.span(corner, disk.centre, m);
        if disk.radius.is_some() {
            return Face::Round { to, radius: T::zero(), side: 1.0 };
        }
        self.back(m, poses, to, first)
    }

    /// What bounds an open chain for points at its start or at its end, with the vector from there to the point.
    fn back<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, to: Vec2<T>, start: bool) -> Face<T> {
        let [first, last] = [self.corners[0], self.corner(self.sides())];
        let along = match (self.beyond, start) {
            ([Some(before), _], true) => heading(m, poses, first, before),
            ([None, _], true) => heading(m, poses, first, self.corner(1)).perp(),
            ([_, Some(after)], false) => heading(m, poses, after, last),
            ([_, None], false) => -heading(m, poses, self.corner(self.sides() - 1), last).perp(),
        };
        let (straight, home) = (Face::Flat { to, along }, heading(m, poses, last, first));
        let across = Face::Flat { to, along: home };
        // The other end of a chain that bends far lies beyond: then all as far as there is inside, too.
        let height = along.cross(if start { -home } else { home }).value();
        let nearer = across.gap(T::zero()).value() < straight.gap(T::zero()).value();
        if height > 0.0 && nearer {
            across
        } else {
            straight
        }
    }

    /// The pieces before and after a piece. What bounds an open chain for points borders on the sides at both ends.
    fn beside(&self, disk: &Disk, piece: usize) -> [Option<usize>; 2] {
        let all = 2 * self.sides();
        let step = if disk.radius.is_some() { 1 } else { 2 };
        let last = self.last();
        if self.closed {
            return [Some((piece + all - step) % all), Some((piece + step) % all)];
        }
        let round = (disk.radius.is_none() && self.sides() > 1).then_some(last - 1);
        match piece {
            first if first == all => [round, Some(0)],
            0 => [Some(all), Some(step.min(last))],
            end if end == last => [Some(last - 1), round.map(|_| 0)],
            _ => [Some(piece - step), Some((piece + step).min(last))],
        }
    }

    pub(super) fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, piece: usize) -> Vec<Border> {
        let [before, after] = self.beside(disk, piece);
        let border = |value: f64, beyond: Option<usize>| beyond.map(|beyond| Border { value, beyond });
        let both = if disk.radius.is_none() {
            let height = |piece| self.face(m, poses, disk, piece).gap(0.0);
            let over = |other: Option<usize>| border(height(piece) - other.map_or(0.0, height), other);
            [over(before), over(after)]
        } else if piece % 2 == 0 && piece < 2 * self.sides() {
            let side = self.seen(m, poses, disk, piece / 2);
            [border(side.place(), before), border(-side.past(), after)]
        } else {
            let side = |piece: usize| self.seen(m, poses, disk, piece / 2);
            [before.and_then(|p| border(side(p).past(), before)), after.and_then(|p| border(-side(p).place(), after))]
        };
        both.into_iter().flatten().collect()
    }

    pub(super) fn piece(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> usize {
        let (sides, ends) = (self.sides(), if self.closed { vec![] } else { vec![self.last(), 2 * self.sides()] });
        let even = (0..sides).map(|i| 2 * i);
        if disk.radius.is_none() {
            let height = |piece| self.face(m, poses, disk, piece).gap(0.0);
            return nearest(even.chain(ends).map(|piece| (piece, -height(piece))));
        }
        let seen: Vec<Seen<f64>> = (0..sides).map(|i| self.seen(m, poses, disk, i)).collect();
        let between = self.closed || (seen[0].place() >= 0.0 && seen[sides - 1].past() <= 0.0);
        if between && seen.iter().all(|side| side.height() <= 0.0) {
            return nearest(even.map(|piece| (piece, -seen[piece / 2].height())));
        }
        let faced = |side: &Seen<f64>| side.height() >= 0.0 && side.place() >= 0.0 && side.past() <= 0.0;
        let over = even.filter(|piece| faced(&seen[piece / 2])).map(|piece| (piece, seen[piece / 2].height()));
        let corner = |piece: usize| (piece, self.face(m, poses, disk, piece).gap(0.0));
        let corners = (0..sides).map(|i| 2 * i + 1).chain(ends.into_iter().skip(1));
        nearest(over.chain(corners.map(corner)))
    }

    fn last(&self) -> usize {
        2 * self.sides() - 1
    }
}

/// The piece of least distance, the first of equals.
fn nearest(pieces: impl Iterator<Item = (usize, f64)>) -> usize {
    let least = |best: (usize, f64), other: (usize, f64)| if other.1 < best.1 { other } else { best };
    pieces.reduce(least).map_or(0, |(piece, _)| piece)
}
