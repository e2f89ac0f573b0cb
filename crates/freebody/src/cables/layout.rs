//! A string laid out at one configuration: its straight segments, its arcs, and what is wound.

use super::tangent::{near, FreeSegment, WrapCircle};
use super::{Winding, WrapState};
use crate::kinematics::Poses;
use crate::mechanism::{Cable, End, Guide, Mechanism};
use crate::plane::{vec2, Vec2};
use crate::scalar::{real, Scalar};
use std::f64::consts::{FRAC_PI_2, PI};

/// A string at one configuration, as if it were taut.
pub(super) struct Layout<T> {
    /// What it touches, from its first end to its second.
    pub circles: Vec<WrapCircle<T>>,
    /// The straight segments between them.
    pub segments: Vec<FreeSegment<T>>,
    /// Of each eyelet and pulley, the length on it, m.
    pub over: Vec<T>,
    /// Of each end, how it leaves its drum.
    pub leaves: [Option<Leave<T>>; 2],
}

/// How a string leaves a drum.
pub(super) struct Leave<T> {
    /// Radius of the drum, m.
    pub radius: T,
    /// Direction of the attachment from the centre, in fixed axes, rad.
    pub attached: T,
    /// Direction of the string, away from the drum, rad.
    pub direction: T,
    /// Angle from the direction of the attachment to that of the string, in the sense of the drum, rad: above a right
    /// angle it is wound, below minus a right angle it is wound back, and between them it runs straight from the
    /// attachment.
    pub turn: T,
    /// Length wound, m; below 0 beyond the border of this way of being wound.
    pub wound: T,
}

impl<T: Scalar> Layout<T> {
    /// Lays a string out, wound as given, its ends attached at `phase`.
    pub fn new(cable: &Cable, m: &Mechanism, poses: &impl Poses<T>, winding: Winding, phase: [f64; 3]) -> Self {
        let last = |end: usize| circle_at(cable.ends[end], end, m, poses, winding.states[end], phase[end]);
        let rounds: Vec<WrapCircle<T>> = std::iter::once(last(0))
            .chain(cable.over.iter().map(|guide| guide.circle(poses)))
            .chain(std::iter::once(last(1)))
            .collect();
        let free: Vec<FreeSegment<T>> =
            rounds.windows(2).map(|pair| FreeSegment::between(m, poses, &pair[0], &pair[1])).collect();
        let turned = free.windows(2).map(|pair| pair[1].angle - pair[0].angle);
        let over = cable.over.iter().zip(turned).map(|(guide, turned)| guide.length(poses, turned)).collect();
        let away = [free[0].angle, free[free.len() - 1].angle + T::of(PI)];
        let leaves = [0, 1].map(|end| Leave::new(cable.ends[end], m, poses, winding, end, phase[end], away[end]));
        Layout { circles: rounds, segments: free, over, leaves }
    }

    /// Length of the straight segments, m.
    pub fn free_length(&self) -> T {
        self.segments.iter().fold(T::zero(), |sum, free| sum + free.length)
    }

    /// Length on pulleys, m.
    pub fn over_length(&self) -> T {
        self.over.iter().fold(T::zero(), |sum, arc| sum + *arc)
    }

    /// Length on the drums, m.
    pub fn wound_length(&self) -> T {
        self.leaves.iter().flatten().fold(T::zero(), |sum, leave| sum + leave.wound)
    }

    /// Length of the whole way, m.
    pub fn length(&self) -> T {
        self.free_length() + self.over_length() + self.wound_length()
    }
}

impl<T: Scalar> Leave<T> {
    fn new(
        end: End,
        m: &Mechanism,
        poses: &impl Poses<T>,
        winding: Winding,
        number: usize,
        phase: f64,
        away: T,
    ) -> Option<Self> {
        let End::Wound { centre, radius, sense, .. } = end else { return None };
        let radius = poses.value(radius);
        let attached = poses.pose(m.body_of(centre)).turn.angle + T::of(phase);
        let right = T::of(FRAC_PI_2);
        let unwound = near((away - attached).scale(sense), 0.0);
        let direction = near(away, winding.near(number));
        let wound = (direction - attached).scale(sense);
        let (direction, turn, wound) = match winding.states[number] {
            WrapState::Wound => (direction, wound, radius * (wound - right)),
            WrapState::Pivot => (attached + unwound.scale(sense), unwound, T::zero()),
            WrapState::WoundBack => (direction, wound, radius * (-wound - right)),
        };
        Some(Leave { radius, attached, direction, turn, wound })
    }
}

/// What the string touches last at an end: the rim of its drum, or a point.
fn circle_at<T: Scalar>(
    end: End,
    number: usize,
    m: &Mechanism,
    poses: &impl Poses<T>,
    way: WrapState,
    phase: f64,
) -> WrapCircle<T> {
    let (centre, radius, sense) = match end {
        End::Tied(site) => return WrapCircle::point(site),
        End::Wound { centre, radius, sense, .. } => (centre, poses.value(radius), sense),
    };
    // Followed from its first end, the string comes back to the attachment at its second.
    let sense = if number == 0 { sense } else { -sense };
    match way {
        WrapState::Wound => WrapCircle { site: centre, off: Vec2::zero(), radius: radius.scale(sense) },
        WrapState::WoundBack => WrapCircle { site: centre, off: Vec2::zero(), radius: radius.scale(-sense) },
        WrapState::Pivot => {
            let (sin, cos) = real::sin_cos(phase);
            let outward = poses.pose(m.body_of(centre)).turn.apply(vec2(T::of(cos), T::of(sin)));
            WrapCircle { site: centre, off: outward * radius, radius: T::zero() }
        }
    }
}

impl Guide {
    fn circle<T: Scalar>(&self, poses: &impl Poses<T>) -> WrapCircle<T> {
        match *self {
            Guide::Eyelet(site) => WrapCircle::point(site),
            Guide::Pulley { centre, radius, sense } => {
                WrapCircle { site: centre, off: Vec2::zero(), radius: poses.value(radius).scale(sense) }
            }
        }
    }

    /// Length on it, m, where the string turns through an angle that is known up to whole turns.
    fn length<T: Scalar>(&self, poses: &impl Poses<T>, turned: T) -> T {
        match *self {
            Guide::Eyelet(_) => T::zero(),
            Guide::Pulley { radius, sense, .. } => poses.value(radius) * near(turned.scale(sense), FRAC_PI_2),
        }
    }
}
