//! A disk, or a point, against a surface.
//!
//! Each feature of a profile is a straight face or a round one. The normal n points to the disk's side, the tangent t
//! is n turned clockwise by a right angle; both bodies turn counter-clockwise.

mod arc;
mod chain;
mod local_surface;
mod track;

use super::Contact;
use crate::bound_values::BoundValues;
use crate::kinematics::Poses;
use crate::mechanism::{Arc, ContactPair, Mechanism, Profile};
use crate::mode::Border;
use crate::plane::{vec2, Turn};
use crate::scalar::Scalar;
use local_surface::LocalSurface;

/// How far before the end of a surface, in parts of its size, a point that slides has left it: it does not come back to
/// it.
const SURFACE_END: f64 = 1e-10;

impl ContactPair {
    /// The disk's body and the surface's body.
    pub fn bodies(&self, m: &Mechanism) -> [usize; 2] {
        [self.disk.centre, self.surface()].map(|site| m.body_of(site))
    }

    /// Distance of disk and surface, m; below 0 where they overlap.
    pub fn gap<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> T {
        self.local_surface(m, poses, feature).gap(self.radius(poses))
    }

    /// A gauge whose rate, where the gap is 0, is the speed of the disk's material along the tangent as seen from the
    /// surface, m. Only its changes count.
    pub fn slide<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> T {
        self.gap_and_slide(m, poses, feature).1
    }

    /// [`ContactPair::gap`], m, below 0 where disk and surface overlap, and [`ContactPair::slide`], m, from one evaluation of the surface.
    pub fn gap_and_slide<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> (T, T) {
        let (surface, radius) = (self.local_surface(m, poses, feature), self.radius(poses));
        (surface.gap(radius), surface.slide(radius, self.bodies(m).map(|body| turn(m, poses, body).angle)))
    }

    /// The feature that tells the gap. A line and a circle have only feature 0; others are expressed at [`Arc`],
    /// [`Chain`] and [`Track`].
    pub fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>) -> usize {
        match &self.against {
            Profile::Arc(arc) => arc.feature(m, poses, &self.disk),
            Profile::Chain(chain) => chain.feature(m, poses, &self.disk),
            Profile::Track(track) => track.feature(m, poses, &self.disk),
            Profile::Line(_) | Profile::Circle { .. } => 0,
        }
    }

    /// Whether the same formula tells the gap everywhere: the surface has no ends and no corners.
    pub fn has_one_feature(&self) -> bool {
        matches!(self.against, Profile::Line(_) | Profile::Circle { .. })
    }

    /// Whether the gap, while it is open, is a distance of the two outlines: it changes no faster than their points move.
    pub fn is_a_distance(&self) -> bool {
        match &self.against {
            Profile::Line(_) | Profile::Circle { .. } => true,
            Profile::Chain(chain) => chain.closed,
            Profile::Arc(_) | Profile::Track(_) => false,
        }
    }

    /// Where the feature ends.
    pub fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: usize) -> Vec<Border> {
        match &self.against {
            Profile::Arc(arc) => arc.borders(m, poses, &self.disk, feature),
            Profile::Chain(chain) => chain.borders(m, poses, &self.disk, feature),
            Profile::Track(track) => track.borders(m, poses, &self.disk, feature),
            Profile::Line(_) | Profile::Circle { .. } => vec![],
        }
    }

    /// Whether the gap is the largest of what its features tell, as that of a point over a chain, and this one may tell
    /// it where it is closed.
    pub fn may_be_active(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: usize) -> bool {
        match &self.against {
            Profile::Chain(chain) => self.disk.radius.is_none() && !chain.is_submerged(m, poses, &self.disk, feature),
            _ => false,
        }
    }

    /// Whether the gap can close on a feature: a point does not stay on a corner.
    pub fn can_close(&self, feature: usize) -> bool {
        match &self.against {
            _ if self.disk.radius.is_some() => true,
            Profile::Chain(_) => feature.is_multiple_of(2),
            Profile::Arc(_) => feature == 0,
            Profile::Track(track) => feature < track.stretches.len(),
            Profile::Line(_) | Profile::Circle { .. } => true,
        }
    }

    /// The point of contact on the surface, with its directions.
    pub fn contact<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> Contact<T> {
        let centre = poses.pose(m.body_of(self.disk.centre)).place(poses.arm(self.disk.centre));
        let (normal, foot) = self.local_surface(m, poses, feature).foot();
        Contact { point: centre - foot, normal, tangent: -normal.perp() }
    }

    /// The gap on the feature that tells it, m: continuous but deep inside.
    pub fn signed_gap(&self, m: &Mechanism, poses: &impl Poses<f64>) -> f64 {
        self.gap(m, poses, self.feature(m, poses))
    }

    /// A distance, m, that disk and profile keep at least: above 0 only where they are apart. It costs less than the
    /// gap.
    pub fn separation_bound(&self, m: &Mechanism, poses: &impl Poses<f64>) -> f64 {
        match &self.against {
            Profile::Line(_) | Profile::Circle { .. } => self.gap(m, poses, 0),
            Profile::Arc(_) | Profile::Track(_) => self.signed_gap(m, poses),
            Profile::Chain(chain) => {
                let first = chain.corners[0];
                let far = |&corner: &usize| (poses.arm(corner) - poses.arm(first)).norm();
                let size = chain.corners.iter().map(far).fold(0.0, f64::max);
                poses.span(first, self.disk.centre, m).norm() - size - self.radius(poses)
            }
        }
    }

    /// How far disk and surface reach from the joint origins of their bodies, m; without bound for what has no back.
    pub fn extents(&self, n: &BoundValues) -> [f64; 2] {
        let far = |site: usize| n.arms[site].norm();
        let surface = match &self.against {
            Profile::Circle { centre, radius, hollow: false }
            | Profile::Arc(Arc { centre, radius, hollow: false, .. }) => far(*centre) + n.values[*radius],
            Profile::Chain(chain) if chain.closed => chain.corners.iter().map(|&site| far(site)).fold(0.0, f64::max),
            _ => f64::INFINITY,
        };
        [far(self.disk.centre) + self.disk.radius.map_or(0.0, |id| n.values[id]), surface]
    }

    /// A site of the surface.
    fn surface(&self) -> usize {
        match &self.against {
            Profile::Line(marker) => marker.site,
            Profile::Circle { centre, .. } | Profile::Arc(Arc { centre, .. }) => *centre,
            Profile::Chain(chain) => chain.corners[0],
            Profile::Track(track) => track.ends()[0],
        }
    }

    fn radius<T: Scalar>(&self, poses: &impl Poses<T>) -> T {
        self.disk.radius.map_or(T::zero(), |id| poses.value(id))
    }

    fn local_surface<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: usize) -> LocalSurface<T> {
        let centre = self.disk.centre;
        match &self.against {
            Profile::Line(marker) => {
                let (sin, cos) = poses.value(marker.angle).sin_cos();
                let along = turn(m, poses, m.body_of(marker.site)).apply(vec2(cos, sin));
                LocalSurface::Flat { to: poses.span(marker.site, centre, m), along }
            }
            Profile::Circle { centre: hub, radius, hollow } => LocalSurface::Round {
                to: poses.span(*hub, centre, m),
                radius: poses.value(*radius),
                side: if *hollow { -1.0 } else { 1.0 },
            },
            Profile::Arc(arc) => arc.local_surface(m, poses, &self.disk, feature),
            Profile::Chain(chain) => chain.local_surface(m, poses, &self.disk, feature),
            Profile::Track(track) => track.local_surface(m, poses, &self.disk, feature),
        }
    }
}

/// The turn of a body; a particle has none.
fn turn<T: Scalar>(m: &Mechanism, poses: &impl Poses<T>, body: usize) -> Turn<T> {
    match m.bodies[body].particle {
        true => Turn::none(),
        false => poses.pose(body).turn,
    }
}
