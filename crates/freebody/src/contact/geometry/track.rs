//! Lines and arcs that go on in each other's direction.

use super::{turn, LocalSurface, SURFACE_END};
use crate::kinematics::Poses;
use crate::mechanism::{Disk, Mechanism, Stretch, Track};
use crate::mode::Border;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// How far behind a segment, in parts of its length, a point still counts as on it.
const BEHIND: f64 = 0.01;

impl Stretch {
    /// +1 for an arc that goes round counter-clockwise, so that its centre is on the free side; −1 for the other.
    fn sense<T: Scalar>(&self, arm: &impl Fn(usize) -> Vec2<T>, centre: usize) -> f64 {
        let [from, to] = self.ends.map(|end| arm(end) - arm(centre));
        from.cross(to).value().signum()
    }

    /// Radius of an arc whose centre is on the free side, so that it is hollow.
    pub fn hollow(&self, arm: &impl Fn(usize) -> Vec2) -> Option<f64> {
        let centre = self.centre.filter(|&centre| self.sense(arm, centre) > 0.0)?;
        Some((arm(self.ends[0]) - arm(centre)).norm())
    }

    /// Whether it is an arc that bulges to the free side.
    pub fn bulges(&self, arm: &impl Fn(usize) -> Vec2) -> bool {
        self.centre.is_some() && self.hollow(arm).is_none()
    }

    /// Direction in which it goes at its start, 0, or its end, 1, by the places of sites in the body's axes.
    pub fn heading<T: Scalar>(&self, arm: &impl Fn(usize) -> Vec2<T>, end: usize) -> Vec2<T> {
        let way = match self.centre {
            None => arm(self.ends[1]) - arm(self.ends[0]),
            Some(centre) => (arm(self.ends[end]) - arm(centre)).perp() * T::of(self.sense(arm, centre)),
        };
        way.unit()
    }
}

impl Track {
    /// Sites of its start and its end.
    pub fn ends(&self) -> [usize; 2] {
        [self.site(0), self.site(self.stretches.len())]
    }

    fn start(&self) -> usize {
        self.stretches.len()
    }

    /// The site where segment `i` starts, or the last one ends.
    fn site(&self, i: usize) -> usize {
        self.stretches.get(i).map_or_else(|| self.stretches[i - 1].ends[1], |stretch| stretch.ends[0])
    }

    /// How far the centre of a disk is past the start of segment `i`, or past the end of the track, along the way
    /// there, m.
    fn past(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, i: usize) -> f64 {
        let (site, arm) = (self.site(i), |site| poses.arm(site));
        let heading = match self.stretches.get(i) {
            Some(stretch) => stretch.heading(&arm, 0),
            None => self.stretches[i - 1].heading(&arm, 1),
        };
        turn(m, poses, m.body_of(site)).apply(heading).dot(poses.span(site, disk.centre, m))
    }

    pub(super) fn local_surface<T: Scalar>(
        &self,
        m: &Mechanism,
        poses: &impl Poses<T>,
        disk: &Disk,
        feature: usize,
    ) -> LocalSurface<T> {
        let Some(stretch) = self.stretches.get(feature) else {
            let site = self.site(if feature == self.start() { 0 } else { self.stretches.len() });
            return LocalSurface::Round { to: poses.span(site, disk.centre, m), radius: T::zero(), side: 1.0 };
        };
        let (from, arm) = (stretch.ends[0], |site| poses.arm(site));
        match stretch.centre {
            None => {
                let along = turn(m, poses, m.body_of(from)).apply(stretch.heading(&arm, 0));
                LocalSurface::Flat { to: poses.span(from, disk.centre, m), along }
            }
            Some(centre) => LocalSurface::Round {
                to: poses.span(centre, disk.centre, m),
                radius: (arm(from) - arm(centre)).norm(),
                side: -stretch.sense(&arm, centre),
            },
        }
    }

    pub(super) fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> Vec<Border> {
        let (n, past) = (self.stretches.len(), |i| self.past(m, poses, disk, i));
        if feature == self.start() {
            return vec![Border { value: -past(0), beyond: 0 }];
        }
        if feature > n {
            return vec![Border { value: past(n), beyond: n - 1 }];
        }
        let before = if feature == 0 { self.start() } else { feature - 1 };
        let after = if feature + 1 == n { n + 1 } else { feature + 1 };
        vec![Border { value: past(feature), beyond: before }, Border { value: -past(feature + 1), beyond: after }]
    }

    /// The nearest of the segments beside which, and before which, the centre of a disk is; else the nearer end.
    pub(super) fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> usize {
        let n = self.stretches.len();
        let radius = disk.radius.map_or(0.0, |id| poses.value(id));
        let gap = |feature: usize| self.local_surface(m, poses, disk, feature).gap(radius);
        let length = |i: usize| (poses.arm(self.stretches[i].ends[1]) - poses.arm(self.stretches[i].ends[0])).norm();
        let mut past: Vec<f64> = (0..=n).map(|i| self.past(m, poses, disk, i)).collect();
        if disk.radius.is_none() {
            past[0] -= SURFACE_END * length(0);
            past[n] += SURFACE_END * length(n - 1);
        }
        let faced = |&i: &usize| past[i] >= 0.0 && past[i + 1] <= 0.0 && gap(i) > -radius - BEHIND * length(i);
        let nearer = |a: usize, b: usize| if gap(b).abs() < gap(a).abs() { b } else { a };
        (0..n).filter(faced).reduce(nearer).unwrap_or_else(|| nearer(n, n + 1))
    }
}
