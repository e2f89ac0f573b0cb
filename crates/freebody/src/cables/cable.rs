//! The way of a string and what is slack of it.

use super::layout::Layout;
use super::tangent::{FreeSegment, WrapCircle};
use super::{Winding, WrapState};
use crate::kinematics::Poses;
use crate::mechanism::{Cable, End, Guide, Mechanism};
use crate::mode::{Border, Feature};
use crate::plane::{vec2, Vec2};
use crate::scalar::{real, Scalar};
use std::f64::consts::{FRAC_PI_2, PI};

/// Swing of a string, rad, from the direction nearest to which it is counted, after which it is counted from the next
/// one, half a turn on. Above a quarter turn, lest it go to and fro between the two.
const SWUNG: f64 = 0.75 * PI;

/// Angle about a drum, rad, by which a configuration beyond a border is still taken to be on it.
const ON_BORDER: f64 = 1e-10;

/// Borders that a configuration may lie beyond at once.
const MOST_BORDERS: usize = 8;

/// A straight segment of a string, fixed axes.
pub struct Straight {
    /// From its first end to its second, m.
    pub along: Vec2,
    /// Whether it joins two points.
    pub joins_points: bool,
    /// How far one end lies within the circle that the string leaves at the other, m.
    pub within: f64,
}

impl Cable {
    /// What is slack, m: 0 where the string is taut. Along its gradient the ends are pulled together.
    pub fn gap<T: Scalar>(&self, m: &Mechanism, poses: &impl Poses<T>, feature: Feature) -> T {
        let length = self.length.map_or(T::of(feature.phase[2]), |id| poses.value(id));
        length - Layout::new(self, m, poses, Winding::of(feature.index), feature.phase).length()
    }

    /// How it is wound at a configuration, given how it was: the number of a [`Winding`]. At the start it was wound by
    /// 0.
    pub fn feature(&self, m: &Mechanism, poses: &impl Poses<f64>, last: Feature) -> usize {
        let radius = |end: &End| if let End::Wound { radius, .. } = end { poses.value(*radius) } else { f64::INFINITY };
        let (mut feature, least) = (last, self.ends.iter().map(radius).fold(f64::INFINITY, f64::min));
        for _ in 0..MOST_BORDERS {
            match self.borders(m, poses, feature).iter().find(|border| border.value < -ON_BORDER * least) {
                Some(border) => feature.index = border.beyond,
                None => break,
            }
        }
        feature.index
    }

    /// Where that ends: the last of the string leaves a drum, or the string is laid against it; or the string has swung
    /// round a drum so far that its direction is counted from another one, which changes no length.
    pub fn borders(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: Feature) -> Vec<Border> {
        let winding = Winding::of(feature.index);
        let layout = Layout::new(self, m, poses, winding, feature.phase);
        let mut borders = vec![];
        for (number, (end, leave)) in self.ends.iter().zip(&layout.leaves).enumerate() {
            let (End::Wound { sense, .. }, Some(leave)) = (end, leave) else { continue };
            let mut add = |angle: f64, way: WrapState, direction: f64| {
                let beyond = winding.with(number, way, direction).index();
                borders.push(Border { value: leave.radius * angle, beyond });
            };
            if winding.states[number] == WrapState::Pivot {
                let aside = sense * FRAC_PI_2;
                add(FRAC_PI_2 - leave.turn, WrapState::Wound, leave.attached + aside);
                add(FRAC_PI_2 + leave.turn, WrapState::WoundBack, leave.attached - aside);
            } else {
                let (way, from) = (winding.states[number], winding.near(number));
                let swung = leave.direction - from;
                add(leave.wound / leave.radius, WrapState::Pivot, 0.0);
                add(SWUNG - swung, way, from + PI);
                add(SWUNG + swung, way, from - PI);
            }
        }
        borders
    }

    /// Whether a straight segment beside a circle has no length, so that its gap has no second derivative.
    pub fn is_without_free_length(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: Feature) -> bool {
        let layout = Layout::new(self, m, poses, Winding::of(feature.index), feature.phase);
        layout.segments.iter().any(|segment| segment.none > 0.0)
    }

    /// The straight segments from its first end to its second.
    pub fn free_segments(&self, m: &Mechanism, poses: &impl Poses<f64>, feature: Feature) -> Vec<Straight> {
        let layout = Layout::new(self, m, poses, Winding::of(feature.index), feature.phase);
        let vector = |(pair, free): (&[WrapCircle<f64>], &FreeSegment<f64>)| {
            let (sin, cos) = real::sin_cos(free.angle);
            let joins_points = pair[0].radius == 0.0 && pair[1].radius == 0.0;
            Straight { along: vec2(cos, sin) * (free.length - free.none), joins_points, within: free.within }
        };
        layout.circles.windows(2).zip(&layout.segments).map(vector).collect()
    }

    /// The bodies on which its slack depends, ground left out, each once.
    pub fn bodies(&self, m: &Mechanism) -> Vec<usize> {
        let mut bodies: Vec<usize> = self.sites().map(|site| m.body_of(site)).filter(|&body| body > 0).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }

    /// The sites of its ends, the first and the last, and of what it passes.
    pub(crate) fn sites(&self) -> impl Iterator<Item = usize> + '_ {
        let end = |end: &End| match *end {
            End::Tied(site) | End::Wound { centre: site, .. } => site,
        };
        let guides = self.over.iter().map(|guide| match *guide {
            Guide::Eyelet(site) | Guide::Pulley { centre: site, .. } => site,
        });
        std::iter::once(end(&self.ends[0])).chain(guides).chain(std::iter::once(end(&self.ends[1])))
    }
}
