//! Unilateral constraints: gauges that cannot fall below zero.

use crate::kinematics::{Config, Poses};
use crate::mechanism::{Gap, Mechanism};
use crate::mode::{Border, Feature, Mode};
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// Where a closed unilateral constraint acts, in fixed axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<S = f64> {
    /// The place.
    pub point: Vec2<S>,
    /// Unit normal, along which the force on the disk's body pushes.
    pub normal: Vec2<S>,
    /// Unit tangent: the normal turned clockwise by a right angle.
    pub tangent: Vec2<S>,
}

impl Gap {
    /// The gap, m (rad for a stop of an angle); below 0 where the unilateral constraint is violated.
    pub fn gap<T: Scalar>(&self, m: &Mechanism, mode: &Mode, poses: &impl Poses<T>, feature: Feature) -> T {
        match self {
            Gap::Gauge(law) => law.eval(&Config { poses, m, mode }),
            Gap::ContactPair(touch) => touch.gap(m, poses, feature.index),
            Gap::Cable(cable) => cable.gap(m, poses, feature),
        }
    }

    /// A gauge whose rate is the speed of sliding, where the gap is 0: of the disk's material along the tangent, as
    /// seen from the surface, m. None where nothing can have friction.
    pub fn slide<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: Feature) -> Option<T> {
        match self {
            Gap::ContactPair(touch) => Some(touch.slide(m, poses, feature.index)),
            Gap::Gauge(_) | Gap::Cable(_) => None,
        }
    }

    /// [`Gap::gap`], m, or rad for a stop of an angle, and [`Gap::slide`], m, where there can be friction: the surface that they share is
    /// evaluated once.
    pub fn gap_and_slide<T: Scalar>(
        &self,
        m: &Mechanism,
        mode: &Mode,
        poses: &impl Poses<T>,
        feature: Feature,
    ) -> (T, Option<T>) {
        match self {
            Gap::ContactPair(touch) => {
                let (gap, slide) = touch.gap_and_slide(m, poses, feature.index);
                (gap, Some(slide))
            }
            Gap::Gauge(_) | Gap::Cable(_) => (self.gap(m, mode, poses, feature), None),
        }
    }

    /// The feature that tells the gap at a configuration.
    pub fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>, last: Feature) -> Feature {
        match self {
            Gap::Gauge(_) => last,
            Gap::ContactPair(touch) => Feature { index: touch.feature(m, poses), ..last },
            Gap::Cable(cable) => Feature { index: cable.feature(m, poses, last), ..last },
        }
    }

    /// The borders of a feature.
    pub fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: Feature) -> Vec<Border> {
        match self {
            Gap::Gauge(_) => vec![],
            Gap::ContactPair(touch) => touch.borders(m, poses, feature.index),
            Gap::Cable(cable) => cable.borders(m, poses, feature),
        }
    }

    /// Whether the gap can close on a feature: a point does not stay on a corner.
    pub fn can_close(&self, feature: usize) -> bool {
        match self {
            Gap::ContactPair(touch) => touch.can_close(feature),
            Gap::Gauge(_) | Gap::Cable(_) => true,
        }
    }

    /// Where a touch acts.
    pub fn contact<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: Feature) -> Option<Contact<T>> {
        match self {
            Gap::ContactPair(touch) => Some(touch.contact(m, poses, feature.index)),
            Gap::Gauge(_) | Gap::Cable(_) => None,
        }
    }
}
