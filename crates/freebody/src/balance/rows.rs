//! The rows that close loops and drive motions.
//!
//! A row is a quantity that must vanish: with its value, its rate, the acceleration it would have if
//! no joint of the tree accelerated (or no body, see [`Base`]), the loads that a unit multiplier puts on the bodies (which are
//! also its gradient), and, for an actuator that acts along another gauge, the loads of that one.

use crate::expr::Env;
use crate::gauges::Law;
use crate::kinematics::{gradient, jet, relative, JointView, Moving, Placed, Poses, Seeded, State};
use crate::mechanism::{Drive, Friction, Joint, Level, Part, Rubbing};
use crate::mode::Hold;
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::{Dual, Jet, Scalar};

/// Loads on bodies, at their pins.
pub type Spread<S> = Vec<(usize, Wrench<S>)>;

/// Where a row comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Row `1` (of the card) of joint `0`.
    Joint(usize, usize),
    /// A coupling or prescribed motion.
    Drive(usize),
    /// A limit that carries load: its gap.
    Limit(usize),
    /// A limit that does not slide: its slide.
    Friction(usize),
    /// A joint, or a limit with a spring, that rubs and does not slide.
    Rub(usize),
}

/// One row.
#[derive(Clone, Debug)]
pub struct Row<S = f64> {
    /// Where it comes from.
    pub source: Source,
    /// What must vanish; None when only a rate or an acceleration is prescribed.
    pub value: Option<S>,
    /// Its rate, or the rate that must vanish; None when only an acceleration is prescribed.
    pub rate: Option<S>,
    /// The acceleration that the joints must cancel.
    pub bias: S,
    /// Gradient of the quantity by the motion of the bodies.
    pub motion: Spread<S>,
    /// Loads for a unit multiplier, when they are not the gradient.
    pub force: Option<Spread<S>>,
}

impl<S: Scalar> Row<S> {
    /// Loads for a unit multiplier.
    pub fn loads(&self) -> &Spread<S> {
        self.force.as_ref().unwrap_or(&self.motion)
    }
}

/// The accelerations of the bodies at which biases are told.
pub type Base<'a, S> = Option<&'a [Twist<S>]>;

/// All rows outside the tree that hold in the present mode.
pub fn closing_rows<S: Scalar>(at: Placed<'_, S>, base: Base<S>) -> Vec<Row<S>> {
    let mut rows = vec![];
    for &joint in at.m.closures.iter().filter(|&&j| at.mode.has(Part::Joint(j))) {
        joint_rows(at, joint, base, &mut rows);
    }
    for (drive, _) in at.drives() {
        rows.push(drive_row(at, drive, base));
    }
    for (limit, held) in at.mode.limits.iter().enumerate() {
        match held.hold {
            // What leans is kept from sliding by the rows of others.
            Hold::Smooth | Hold::Leaning(_) | Hold::Sliding(_) => rows.push(gap_row(at, limit, base)),
            Hold::Stuck => {
                rows.push(gap_row(at, limit, base));
                rows.extend(slide_row(at, limit, base));
            }
            Hold::Off | Hold::Open | Hold::Pressed | Hold::Idle => {}
        }
    }
    for rub in (0..at.m.rubs.len()).filter(|&rub| at.mode.rubs[rub] == Hold::Stuck) {
        rows.push(rub_row(at, rub, base));
    }
    rows
}

/// The row that keeps what rubs from sliding.
pub fn rub_row<S: Scalar>(at: Placed<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    let source = Source::Rub(index);
    match at.m.rubs[index].of {
        Rubbing::Joint { joint, radius } => Row { source, ..joint_slide_row(at, joint, radius.is_some(), base) },
        Rubbing::Limit(limit) => Row { source, ..slide_row(at, limit, base).expect("only contacts rub") },
    }
}

/// The row of the first freedom of a joint in the sense of its coordinate: what the second body turns, or moves along the
/// joint's line or curve, against the first.
fn joint_slide_row<S: Scalar>(at: Placed<'_, S>, index: usize, turns: bool, base: Base<S>) -> Row<S> {
    let joint = &at.m.joints[index];
    let (axes, place) = relative(joint, at.m, &at);
    let (_, going) = relative(joint, at.m, &Moving { at, bodies: base, accelerations: None });
    let first = &joint.coordinates[0];
    let (slide, load) = if turns {
        (going.angle.scale(first.sense), Wrench { f: Vec2::zero(), m: S::of(first.sense) })
    } else {
        let s = match joint.curve {
            Some(_) => at.n.slots[first.zero] + at.coordinate(index, 0).scale(first.sense),
            None => S::zero(),
        };
        let along = JointView::new(at.m, at.n, joint, |x| x).tangent(s) * S::of(first.sense);
        // The direction is that of this instant: it turns across the motion.
        let slide = going.x * Jet::constant(along.x) + going.y * Jet::constant(along.y);
        (slide, Wrench { f: axes.turn.apply(along), m: S::zero() })
    };
    let motion = pair(at, joint, axes.place(place.at()), load);
    Row { source: Source::Joint(index, 0), value: None, rate: Some(slide.d1), bias: slide.d2, motion, force: None }
}

/// The row that keeps the gap of a limit closed; one that slides rubs as it presses.
pub fn gap_row<S: Scalar>(at: Placed<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    let (limit, held) = (&at.m.limits[index], at.mode.limits[index]);
    let jet = limit.gap.gap(at.m, at.mode, &Moving { at, bodies: base, accelerations: None }, held.piece);
    let load = |body| limit.gap.gap(at.m, at.mode, &Seeded { at, body }, held.piece).du;
    let motion: Spread<S> = limit.bodies.iter().map(|&body| (body, Wrench::from_parts(load(body)))).collect();
    let rub = match (held.hold, limit.friction) {
        (Hold::Sliding(sense), Some(Friction::Coulomb { kinetic, .. })) => Some(-at.n.slots[kinetic].scale(sense)),
        (Hold::Leaning(part), _) => Some(S::of(part)),
        _ => None,
    };
    let force = match rub {
        Some(rub) => {
            let along = slide_loads(at, index);
            Some(motion.iter().zip(along).map(|(n, t)| (n.0, n.1 + t.1 * rub)).collect())
        }
        None => None,
    };
    let (value, rate) = (Some(jet.d0), Some(jet.d1));
    Row { source: Source::Limit(index), value, rate, bias: jet.d2, motion, force }
}

/// The row that keeps a limit from sliding; None where it cannot rub.
pub fn slide_row<S: Scalar>(at: Placed<'_, S>, index: usize, base: Base<S>) -> Option<Row<S>> {
    let (limit, held) = (&at.m.limits[index], at.mode.limits[index]);
    let jet = limit.gap.slide(at.m, &Moving { at, bodies: base, accelerations: None }, held.piece)?;
    let motion = slide_loads(at, index);
    Some(Row { source: Source::Friction(index), value: None, rate: Some(jet.d1), bias: jet.d2, motion, force: None })
}

/// The loads of a unit force along the slide of a limit.
fn slide_loads<S: Scalar>(at: Placed<'_, S>, index: usize) -> Spread<S> {
    let (limit, held) = (&at.m.limits[index], at.mode.limits[index]);
    let load = |body| limit.gap.slide(at.m, &Seeded { at, body }, held.piece).map_or([S::zero(); 3], |s| s.du);
    limit.bodies.iter().map(|&body| (body, Wrench::from_parts(load(body)))).collect()
}

/// The rows of one joint told as a constraint.
pub fn joint_rows<S: Scalar>(at: Placed<'_, S>, index: usize, base: Base<S>, out: &mut Vec<Row<S>>) {
    let joint = &at.m.joints[index];
    let going = Moving { at, bodies: base, accelerations: None };
    let (_, place) = relative(joint, at.m, &going);
    let jets = JointView::new(at.m, at.n, joint, Jet::constant).residual(&place);
    let loads = joint_loads(at, joint);
    for &row in &joint.rows {
        out.push(Row {
            source: Source::Joint(index, row),
            value: Some(jets[row].d0),
            rate: Some(jets[row].d1),
            bias: jets[row].d2,
            motion: loads[row].clone(),
            force: None,
        });
    }
}

/// The loads of a unit multiplier of each row of a joint's card.
fn joint_loads<S: Scalar>(at: Placed<'_, S>, joint: &Joint) -> Vec<Spread<S>> {
    let (axes, place) = relative(joint, at.m, &at);
    let seeded = crate::joints::Relative {
        x: Dual::<3, S>::variable(place.x, 0),
        y: Dual::variable(place.y, 1),
        angle: Dual::variable(place.angle, 2),
    };
    let rows = JointView::new(at.m, at.n, joint, Dual::constant).residual(&seeded);
    let point = axes.place(place.at());
    rows.iter()
        .map(|row| {
            let [x, y, angle] = row.du;
            pair(at, joint, point, Wrench { f: axes.turn.apply(vec2(x, y)), m: angle })
        })
        .collect()
}

/// A load on the second body at a place, and its opposite on the first, each at its body's pin.
pub fn pair<S: Scalar>(at: Placed<'_, S>, joint: &Joint, place: Vec2<S>, load: Wrench<S>) -> Spread<S> {
    let [a, b] = at.m.ends(joint);
    let mut spread = vec![];
    if b > 0 {
        spread.push((b, load.seen_from(place - at.k.pose[b].at)));
    }
    if a > 0 {
        spread.push((a, -load.seen_from(place - at.k.pose[a].at)));
    }
    spread
}

/// The row of a coupling or of a prescribed motion.
pub fn drive_row<S: Scalar>(at: Placed<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    let drive: &Drive = &at.m.drives[index];
    let going = Moving { at, bodies: base, accelerations: None };
    let of = jet(&going, &drive.of);
    let (value, rate, bias, gauge) = match drive.level {
        Level::Position => {
            let law = jet(&going, &drive.law);
            (Some(of.d0 - law.d0), Some(of.d1 - law.d1), of.d2 - law.d2, drive.of.clone() - drive.law.clone())
        }
        Level::Velocity => {
            let law = jet(&going, &drive.law);
            (None, Some(of.d1 - law.d0), of.d2 - law.d1, drive.of.clone())
        }
        Level::Acceleration => {
            let law: S = drive.law.eval(&State(at) as &dyn Env<S, _>);
            (None, None, of.d2 - law, drive.of.clone())
        }
    };
    let motion = spread(at, &gauge);
    let own_way = drive.by.is_some() || (drive.feedback && drive.level == Level::Position && !drive.coupling);
    let force = own_way.then(|| spread(at, drive.by.as_ref().unwrap_or(&drive.of)));
    Row { source: Source::Drive(index), value, rate, bias, motion, force }
}

/// The loads of a unit force along a gauge.
pub fn spread<S: Scalar>(at: Placed<'_, S>, gauge: &Law) -> Spread<S> {
    at.m.bodies_of(gauge).into_iter().map(|body| (body, gradient(at, gauge, body))).collect()
}
