//! A circle with ends.

use super::{turn, LocalSurface, SURFACE_END};
use crate::kinematics::Poses;
use crate::mechanism::{Arc, Disk, Mechanism};
use crate::mode::Border;
use crate::plane::{vec2, Vec2};
use crate::scalar::{real, Scalar};
use std::f64::consts::PI;

const ARC: usize = 0;

impl Arc {
    /// Direction of an end, 1 or 2, from the centre, fixed axes.
    fn towards<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> Vec2<T> {
        let (sin, cos) = poses.value(self.ends[feature - 1]).sin_cos();
        turn(m, poses, m.body_of(self.centre)).apply(vec2(cos, sin))
    }

    pub(super) fn local_surface<T: Scalar>(
        &self,
        m: &Mechanism,
        poses: &impl Poses<T>,
        disk: &Disk,
        feature: usize,
    ) -> LocalSurface<T> {
        let (to, radius) = (poses.span(self.centre, disk.centre, m), poses.value(self.radius));
        if feature == ARC {
            return LocalSurface::Round { to, radius, side: if self.hollow { -1.0 } else { 1.0 } };
        }
        let towards = self.towards(m, poses, feature);
        match disk.radius {
            Some(_) => LocalSurface::Round { to: to - towards * radius, radius: T::zero(), side: 1.0 },
            None => LocalSurface::Flat { to, along: if feature == 1 { -towards } else { towards } },
        }
    }

    /// Half its angle, and the angle from its middle to the centre of a disk, within half a turn, rad.
    fn seen(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> (f64, f64) {
        let half = 0.5 * (poses.value(self.ends[1]) - poses.value(self.ends[0]));
        let (start, to) = (self.towards(m, poses, 1), poses.span(self.centre, disk.centre, m));
        let (sin, cos) = real::sin_cos(half);
        let middle = vec2(start.x * cos - start.y * sin, start.x * sin + start.y * cos);
        (half, real::atan2(middle.cross(to), middle.dot(to)))
    }

    pub(super) fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk) -> usize {
        let (half, off) = self.seen(m, poses, disk);
        let beside = match disk.radius {
            Some(_) => off.abs() > half,
            None => self.ahead(m, poses, disk, nearer(off), ARC) > -SURFACE_END * poses.value(self.radius),
        };
        if beside {
            nearer(off)
        } else {
            ARC
        }
    }

    /// By how much a point is higher over one feature than over another, m.
    fn ahead(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize, other: usize) -> f64 {
        let height = |feature| self.local_surface(m, poses, disk, feature).gap(0.0);
        height(feature) - height(other)
    }

    pub(super) fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, disk: &Disk, feature: usize) -> Vec<Border> {
        let ((half, off), far) = (self.seen(m, poses, disk), poses.span(self.centre, disk.centre, m).norm());
        let border = |value: f64, beyond: usize| Border { value, beyond };
        let behind = far * (PI - off.abs());
        match (feature, disk.radius) {
            (ARC, Some(_)) => vec![border(far * (half + off), 1), border(far * (half - off), 2)],
            (ARC, None) => vec![border(self.ahead(m, poses, disk, ARC, nearer(off)), nearer(off))],
            (end, _) if end != nearer(off) => vec![border(-behind, 3 - end)],
            (end, Some(_)) => vec![border(far * (off.abs() - half), ARC), border(behind, 3 - end)],
            (end, None) => vec![border(self.ahead(m, poses, disk, end, ARC), ARC), border(behind, 3 - end)],
        }
    }
}

/// The end that is nearer to a direction, seen from the middle.
fn nearer(off: f64) -> usize {
    if off < 0.0 {
        1
    } else {
        2
    }
}
