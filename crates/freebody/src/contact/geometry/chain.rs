//! Straight sides with convex corners.

use super::{turn, LocalSurface};
use crate::kinematics::Poses;
use crate::mechanism::{Chain, Disk, Mechanism};
use crate::mode::Border;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// Depth to which both chains at a concave corner go on behind each other, in parts of the height of the one over the
/// other: far more than round-off, and less than any blade is thin.
const INSET: f64 = 0.01;
/// Depth, in parts of its length, to which a side is sunk for a corner whose polygon reaches behind it: it cannot be
/// what keeps them apart. Two polygons on one floor, their lower sides in line, so meet with the sides above.
const SUNK: f64 = 1e-7;
/// Sine of the angle between sides of two polygons below which they lie flat on each other: then corners of both hold.
const FLAT: f64 = 1e-6;
/// Height, in parts of its length, that a side on which a corner rests may lack of one of the corner's own: corners
/// that rest on each other stay as they are.
const SLACK: f64 = 1e-10;
/// The feature of a corner that a side of its own polygon keeps off. Nothing closes there.
const OCCLUDED: usize = 1;

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
        let length = (poses.arm(to) - poses.arm(from)).value().norm();
        Seen {
            to: poses.span(from, disk.centre, m),
            along: turn(m, poses, m.body_of(from)).apply(way(poses, from, to)),
            length,
        }
    }

    pub(super) fn local_surface<T: Scalar>(
        &self,
        m: &Mechanism,
        poses: &impl Poses<T>,
        disk: &Disk,
        feature: usize,
    ) -> LocalSurface<T> {
        let first = feature == 2 * self.sides();
        if feature.is_multiple_of(2) && !first {
            let Seen { to, along, length } = self.seen(m, poses, disk, feature / 2);
            let depth = length * SUNK * behind(m, poses, disk, along);
            return LocalSurface::Flat { to: to - along.perp() * T::of(depth), along };
        }
        match disk.radius {
            None if self.closed => self.occluded(m, poses, disk),
            Some(_) => {
                let corner = if first { self.corners[0] } else { self.corner(feature / 2 + 1) };
                LocalSurface::Round { to: poses.span(corner, disk.centre, m), radius: T::zero(), side: 1.0 }
            }
            None => self.back(m, poses, disk, first),
        }
    }

    /// What bounds an open chain for points at its start or at its end.
    fn back<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, disk: &Disk, start: bool) -> LocalSurface<T> {
        let [first, last] = [self.corners[0], self.corner(self.sides())];
        let axes = turn(m, poses, m.body_of(first));
        let bound = |start: bool| {
            let to = poses.span(if start { first } else { last }, disk.centre, m);
            let along = axes.apply(self.bound(poses, start));
            LocalSurface::Flat { to: to - along.perp() * self.inset(poses, start), along }
        };
        if !self.bends_past(poses, start) {
            return bound(start);
        }
        // Where a side follows, only what lies behind both its line and the line home is outside.
        let followed = |&start: &bool| self.beyond[usize::from(!start)].is_some() && self.bends_past(poses, start);
        let nearer = |a: LocalSurface<T>, b: LocalSurface<T>| match b.gap(T::zero()).value() < a.gap(T::zero()).value()
        {
            true => b,
            false => a,
        };
        let home =
            LocalSurface::Flat { to: poses.span(last, disk.centre, m), along: axes.apply(way(poses, last, first)) };
        [true, false].into_iter().filter(followed).map(bound).fold(home, nearer)
    }

    /// Direction, in the body's axes, of the bound at the start or at the end: along the side that follows, or straight
    /// back.
    fn bound<T: Scalar>(&self, poses: &impl Poses<T>, start: bool) -> Vec2<T> {
        let n = self.sides();
        match (self.beyond, start) {
            ([Some(before), _], true) => way(poses, self.corner(0), before),
            ([None, _], true) => way(poses, self.corner(0), self.corner(1)).perp(),
            ([_, Some(after)], false) => way(poses, after, self.corner(n)),
            ([_, None], false) => -way(poses, self.corner(n - 1), self.corner(n)).perp(),
        }
    }

    /// How far that bound lies behind the side that follows, so that a point that rests in the concave corner is well
    /// within its features, m.
    fn inset<T: Scalar>(&self, poses: &impl Poses<T>, start: bool) -> T {
        let n = self.sides();
        let [corner, next, side] = if start { [0, 0, 0] } else { [n, 1, n - 1] };
        let along = way(poses, self.corner(side), self.corner(side + 1));
        let height = |beyond: usize| along.cross(poses.arm(beyond) - poses.arm(self.corner(corner)));
        self.beyond[next].map_or(T::zero(), |beyond| height(beyond).scale(INSET))
    }

    /// Whether that bound would leave the other end outside; the same wherever the body is.
    fn bends_past<T: Scalar>(&self, poses: &impl Poses<T>, start: bool) -> bool {
        let [first, last] = [self.corner(0), self.corner(self.sides())];
        let across = if start { way(poses, first, last) } else { way(poses, last, first) };
        self.bound(poses, start).cross(across).value() > 0.0
    }

    /// The features for points, in order round the solid.
    fn round(&self, poses: &impl Poses<f64>) -> Vec<usize> {
        let sides = (0..self.sides()).map(|i| 2 * i);
        match self.closed {
            true => sides.collect(),
            // The line home bounds both ends, and is one feature.
            false if [true, false].iter().all(|&start| self.bends_past(poses, start)) => {
                sides.chain([2 * self.sides()]).collect()
            }
            false => sides.chain([2 * self.sides() - 1, 2 * self.sides()]).collect(),
        }
    }

    pub(super) fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> Vec<Border> {
        let all = 2 * self.sides();
        if disk.radius.is_none() {
            let height = |feature| self.local_surface(m, poses, disk, feature).gap(0.0);
            if self.closed && feature == OCCLUDED {
                let beyond = self.highest(m, poses, disk);
                return vec![Border { value: height(feature) - height(beyond), beyond }];
            }
            let round = self.round(poses);
            let at = round.iter().position(|&p| p == feature).unwrap_or(0);
            let border = |beyond| Border { value: height(feature) - height(beyond), beyond };
            let beside = [at + round.len() - 1, at + 1].map(|i| border(round[i % round.len()]));
            let own = self.own_height(m, poses, disk, feature);
            let slack = SLACK * self.seen(m, poses, disk, feature / 2).length;
            let own = own.map(|own| Border { value: height(feature) - own + slack, beyond: OCCLUDED });
            return beside.into_iter().chain(own).collect();
        }
        let side = |feature: usize| self.seen(m, poses, disk, feature / 2);
        let before = if feature == 0 { all - usize::from(self.closed) } else { feature - 1 };
        let after = if self.closed { (feature + 1) % all } else { feature + 1 };
        if feature == all {
            vec![Border { value: -side(0).place(), beyond: 0 }]
        } else if feature.is_multiple_of(2) {
            let side = side(feature);
            vec![Border { value: side.place(), beyond: before }, Border { value: -side.past(), beyond: after }]
        } else {
            let start = Border { value: side(before).past(), beyond: before };
            let end = (after < all).then(|| Border { value: -side(after).place(), beyond: after });
            [start].into_iter().chain(end).collect()
        }
    }

    pub(super) fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> usize {
        let height = |feature| self.local_surface(m, poses, disk, feature).gap(0.0);
        if disk.radius.is_none() {
            let feature = self.highest(m, poses, disk);
            return if self.is_occluded(m, poses, disk, feature) { OCCLUDED } else { feature };
        }
        let seen: Vec<Seen<f64>> = (0..self.sides()).map(|i| self.seen(m, poses, disk, i)).collect();
        let (first, last) = (&seen[0], &seen[seen.len() - 1]);
        let between = self.closed || (first.place() >= 0.0 && last.past() <= 0.0);
        let sides = || seen.iter().enumerate().map(|(i, side)| (2 * i, side));
        if between && seen.iter().all(|side| side.height() <= 0.0) {
            return nearest(sides().map(|(feature, side)| (feature, -side.height())));
        }
        let faced = |side: &Seen<f64>| side.height() >= 0.0 && side.place() >= 0.0 && side.past() <= 0.0;
        let over = sides().filter(|(_, side)| faced(side)).map(|(feature, side)| (feature, side.height()));
        let start = (!self.closed).then_some(2 * seen.len());
        let corners = sides().map(|(feature, _)| feature + 1).chain(start);
        nearest(over.chain(corners.map(|feature| (feature, height(feature)))))
    }
}

/// Points, and the sides of polygons whose corners they are.
impl Chain {
    /// The feature over which a point is highest.
    fn highest(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> usize {
        let height = |feature| self.local_surface(m, poses, disk, feature).gap(0.0);
        nearest(self.round(poses).into_iter().map(|feature| (feature, -height(feature))))
    }

    /// Whether a corner on its highest feature is lower than this chain is over one of the corner's own sides, or
    /// reaches behind that feature: questions only where they are near.
    fn is_occluded(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> bool {
        let height = self.local_surface(m, poses, disk, feature).gap(0.0);
        let near = || height <= SUNK * self.seen(m, poses, disk, feature / 2).length;
        let lower = || self.own_height(m, poses, disk, feature).is_some_and(|own| height < own);
        self.closed && near() && (self.is_submerged(m, poses, disk, feature) || lower())
    }

    /// Whether a side is not what keeps a corner off, for the corner's polygon reaches behind it.
    pub(super) fn is_submerged(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> bool {
        feature.is_multiple_of(2) && behind(m, poses, disk, self.seen(m, poses, disk, feature / 2).along) > 0.0
    }

    /// The height of this chain over the one of the corner's own sides that is farther from it, those left out on which
    /// the side of a feature lies flat.
    fn own_height(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> Option<f64> {
        let own = self.own_sides(m, poses, disk)?;
        let side = self.seen(m, poses, disk, feature / 2).along;
        let meets = |(_, along): &(Vec2<f64>, Vec2<f64>)| along.cross(side).abs() > FLAT;
        own.into_iter().filter(meets).map(|(to, along)| along.cross(to)).reduce(f64::max)
    }

    /// That height as a face.
    fn occluded<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, disk: &Disk) -> LocalSurface<T> {
        let [a, b] = self.own_sides(m, poses, disk).expect("only corners of polygons are kept off");
        let height = |(to, along): (Vec2<T>, Vec2<T>)| along.cross(to).value();
        let (to, along) = if height(a) < height(b) { b } else { a };
        LocalSurface::Flat { to, along }
    }

    /// From each of the two sides of a corner's own polygon to the corner of this chain that is lowest over it, and the
    /// direction of the side.
    fn own_sides<T: Scalar>(
        &self,
        m: &Mechanism,
        poses: &impl Poses<T>,
        disk: &Disk,
    ) -> Option<[(Vec2<T>, Vec2<T>); 2]> {
        let [before, after] = disk.beside.filter(|_| self.closed)?;
        let axes = turn(m, poses, m.body_of(disk.centre));
        Some([[before, disk.centre], [disk.centre, after]].map(|[from, to]| {
            let along = axes.apply(way(poses, from, to));
            let spans = self.corners.iter().map(|&corner| poses.span(from, corner, m));
            let height = |to: &Vec2<T>| along.cross(*to).value();
            let lowest = spans.reduce(|a, b| if height(&b) < height(&a) { b } else { a });
            (lowest.expect("a chain has corners"), along)
        }))
    }
}

/// How far the polygon of a corner reaches behind a side through the corner: 0, or the sine of the angle of its own
/// side, where that does not lie flat.
fn behind<T: Scalar>(m: &Mechanism, poses: &impl Poses<T>, disk: &Disk, along: Vec2<T>) -> f64 {
    let Some(beside) = disk.beside else { return 0.0 };
    let (axes, along) = (turn(m, poses, m.body_of(disk.centre)).value(), along.value());
    let rise = |next: usize| along.cross(axes.apply((poses.arm(next) - poses.arm(disk.centre)).value().unit()));
    beside.into_iter().map(|next| -rise(next)).filter(|&sine| sine > FLAT).fold(0.0, f64::max)
}

/// Direction, in their body's axes, from one site to another of the same body.
fn way<T: Scalar>(poses: &impl Poses<T>, from: usize, to: usize) -> Vec2<T> {
    (poses.arm(to) - poses.arm(from)).unit()
}

/// The feature of least distance, the first of equals.
fn nearest(pieces: impl Iterator<Item = (usize, f64)>) -> usize {
    let least = |best: (usize, f64), other: (usize, f64)| if other.1 < best.1 { other } else { best };
    pieces.reduce(least).map_or(0, |(feature, _)| feature)
}
