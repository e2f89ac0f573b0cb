//! The rows that close loops and drive motions.
//!
//! A row is a quantity that must vanish: with its value, its rate, the acceleration it would have if no joint of the
//! tree accelerated (or no body, see [`Base`]), the loads that a unit multiplier puts on the bodies (which are also its
//! gradient), and, for an actuator that acts along another gauge, the loads of that one.

use crate::expr::Env;
use crate::gauges::ModelExpr;
use crate::joints::{Joint as _, Relative};
use crate::kinematics::{gradient, jet, relative, JointView, MotionView, Poses, SeededView, State, StateView};
use crate::mechanism::{Drive, DriveGauges, Friction, FrictionSource, Joint, Level, Part};
use crate::mode::ContactMode;
use crate::plane::{vec2, Turn, Twist, Vec2, Wrench};
use crate::scalar::{Dual, Jet, Scalar};
use smallvec::{smallvec, SmallVec};

/// Loads on bodies, at their joint origins; rarely on more than four.
pub type BodyWrenches<S> = SmallVec<[(usize, Wrench<S>); 4]>;

/// Where a row comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Row `1` (of the card) of joint `0`.
    Joint(usize, usize),
    /// A coupling or prescribed motion.
    Drive(usize),
    /// A unilateral constraint that carries load: its gap.
    Gap(usize),
    /// A unilateral constraint that does not slide: its slide.
    Friction(usize),
    /// A joint, or a unilateral constraint with a spring, with friction and does not slide.
    JointFriction(usize),
}

impl Source {
    /// That of rows that hold gauges at values or rates.
    pub(super) const TARGET: Source = Source::Drive(usize::MAX);
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
    pub motion: BodyWrenches<S>,
    /// Loads for a unit multiplier, when they are not the gradient.
    pub force: Option<BodyWrenches<S>>,
}

impl<S: Scalar> Row<S> {
    /// Loads for a unit multiplier.
    pub fn loads(&self) -> &BodyWrenches<S> {
        self.force.as_ref().unwrap_or(&self.motion)
    }

    /// What it does on a body.
    pub(super) fn on(&self, body: usize) -> Wrench<S> {
        self.motion.iter().find(|(b, _)| *b == body).map_or(Wrench::zero(), |(_, load)| *load)
    }

    /// The row of a quantity that is larger by a factor.
    pub(super) fn scaled(self, by: S) -> Self {
        let times = |wrenches: BodyWrenches<S>| wrenches.into_iter().map(|(body, load)| (body, load * by)).collect();
        Row {
            source: self.source,
            value: self.value.map(|x| x * by),
            rate: self.rate.map(|x| x * by),
            bias: self.bias * by,
            motion: times(self.motion),
            force: self.force.map(times),
        }
    }
}

/// The accelerations of the bodies at which biases are taken.
pub type Base<'a, S> = Option<&'a [Twist<S>]>;

/// All rows outside the tree that hold in the present mode.
pub fn closing_rows<S: Scalar>(at: StateView<'_, S>, base: Base<S>) -> Vec<Row<S>> {
    let mut rows = vec![];
    closing_rows_into(at, base, &mut rows);
    rows
}

/// The same in the memory of other rows.
pub(super) fn closing_rows_into<S: Scalar>(at: StateView<'_, S>, base: Base<S>, rows: &mut Vec<Row<S>>) {
    let mut count = 0;
    for &joint in at.m.closures.iter().filter(|&&j| at.mode.has(Part::Joint(j))) {
        visit_joint_rows(at, joint, base, |row| {
            match rows.get_mut(count) {
                Some(old) => row.write(old),
                None => rows.push(row.new_row()),
            }
            count += 1;
        });
    }
    rows.truncate(count);
    for (drive, _) in at.drives() {
        rows.push(drive_row(at, drive, base));
    }
    for (constraint, contact) in at.mode.contacts.iter().enumerate() {
        match contact.mode {
            // What has partial friction is kept from sliding by the rows of others.
            ContactMode::Frictionless | ContactMode::PartialFriction(_) | ContactMode::Slip(_) => {
                rows.push(gap_row(at, constraint, base))
            }
            ContactMode::Stick => {
                let (gap, slide) = contact_rows(at, constraint, base);
                rows.push(gap);
                rows.extend(slide);
            }
            ContactMode::Off | ContactMode::Open | ContactMode::Compliant | ContactMode::ClosedUnloaded => {}
        }
    }
    for friction in
        (0..at.m.joint_friction.len()).filter(|&friction| at.mode.joint_friction[friction] == ContactMode::Stick)
    {
        rows.push(joint_friction_row(at, friction, base));
    }
}

/// The row that keeps what has friction from sliding.
pub fn joint_friction_row<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    let source = Source::JointFriction(index);
    match at.m.joint_friction[index].of {
        FrictionSource::Joint { joint, radius } => Row { source, ..joint_slide_row(at, joint, radius.is_some(), base) },
        FrictionSource::Unilateral(constraint) => {
            Row { source, ..slide_row(at, constraint, base).expect("only contacts rub") }
        }
    }
}

/// Unit vector along a joint's line, or along its curve where the second body is on it, as the parameter of the curve
/// grows; of a constraint on rates that along which it leaves the motion free. In the first marker's axes.
pub(super) fn joint_tangent<S: Scalar>(at: StateView<'_, S>, index: usize) -> Vec2<S> {
    let joint = &at.m.joints[index];
    let (_, place) = relative(joint, at.m, &at);
    let view = JointView::new(at.m, at.n, joint, |x| x);
    if let Some([x, y, _]) = view.rate_row(&place) {
        return vec2(y, -x);
    }
    let s = joint.curve.map_or(S::zero(), |_| {
        let first = &joint.coordinates[0];
        at.n.values[first.zero] + at.coordinate(index, 0).scale(first.sense)
    });
    view.tangent(s)
}

/// The row of the first freedom of a joint in the sense of its coordinate: what the second body turns, or moves along
/// the joint's line or curve, against the first.
fn joint_slide_row<S: Scalar>(at: StateView<'_, S>, index: usize, turns: bool, base: Base<S>) -> Row<S> {
    let joint = &at.m.joints[index];
    let (axes, place) = relative(joint, at.m, &at);
    let (_, going) = relative(joint, at.m, &MotionView { at, bodies: base, accelerations: None });
    let first = &joint.coordinates[0];
    let (slide, load) = if turns {
        (going.angle.scale(first.sense), Wrench { f: Vec2::zero(), m: S::of(first.sense) })
    } else {
        let along = joint_tangent(at, index) * S::of(first.sense);
        // The direction is that of this instant: it turns across the motion.
        let slide = going.x * Jet::constant(along.x) + going.y * Jet::constant(along.y);
        (slide, Wrench { f: axes.turn.apply(along), m: S::zero() })
    };
    let motion = pair(at, joint, axes.place(place.at()), load);
    Row { source: Source::Joint(index, 0), value: None, rate: Some(slide.d1), bias: slide.d2, motion, force: None }
}

/// The row that keeps the gap of a unilateral constraint closed; one that slides has friction in proportion to its
/// normal force.
pub fn gap_row<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    if sliding_friction(at, index).is_some() {
        return contact_rows(at, index, base).0;
    }
    let (constraint, contact) = (&at.m.unilateral[index], at.mode.contacts[index]);
    let jet = constraint.gap.gap(at.m, at.mode, &MotionView { at, bodies: base, accelerations: None }, contact.feature);
    let load = |body| constraint.gap.gap(at.m, at.mode, &SeededView { at, body }, contact.feature).du;
    let motion = constraint.bodies.iter().map(|&body| (body, Wrench::from_parts(load(body)))).collect();
    let (value, rate) = (Some(jet.d0), Some(jet.d1));
    Row { source: Source::Gap(index), value, rate, bias: jet.d2, motion, force: None }
}

/// The rows of the gap and of the slide of a unilateral constraint, as [`gap_row`] and [`slide_row`].
pub(super) fn contact_rows<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>) -> (Row<S>, Option<Row<S>>) {
    let (constraint, contact) = (&at.m.unilateral[index], at.mode.contacts[index]);
    let going = MotionView { at, bodies: base, accelerations: None };
    let (gap, slide) = constraint.gap.gap_and_slide(at.m, at.mode, &going, contact.feature);
    let (mut across, mut along): (BodyWrenches<S>, BodyWrenches<S>) = (smallvec![], smallvec![]);
    for &body in &constraint.bodies {
        let seeded = SeededView { at, body };
        let (gap, slide) = constraint.gap.gap_and_slide(at.m, at.mode, &seeded, contact.feature);
        across.push((body, Wrench::from_parts(gap.du)));
        along.push((body, Wrench::from_parts(slide.map_or([S::zero(); 3], |slide| slide.du))));
    }
    let force = sliding_friction(at, index)
        .map(|friction| across.iter().zip(&along).map(|(n, t)| (n.0, n.1 + t.1 * friction)).collect());
    let (value, rate) = (Some(gap.d0), Some(gap.d1));
    let row = Row { source: Source::Gap(index), value, rate, bias: gap.d2, motion: across, force };
    (row, slide.map(|slide| row_of_slide(index, slide, along)))
}

/// Friction over the normal force of a unilateral constraint, along its slide, where that is given.
fn sliding_friction<S: Scalar>(at: StateView<'_, S>, index: usize) -> Option<S> {
    match (at.mode.contacts[index].mode, at.m.unilateral[index].friction) {
        (ContactMode::Slip(sense), Some(Friction::Coulomb { kinetic, .. })) => Some(-at.n.values[kinetic].scale(sense)),
        (ContactMode::PartialFriction(part), _) => Some(S::of(part)),
        _ => None,
    }
}

fn row_of_slide<S: Scalar>(index: usize, slide: Jet<S>, motion: BodyWrenches<S>) -> Row<S> {
    Row { source: Source::Friction(index), value: None, rate: Some(slide.d1), bias: slide.d2, motion, force: None }
}

/// The row that keeps a unilateral constraint from sliding; None where it cannot have friction.
pub fn slide_row<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>) -> Option<Row<S>> {
    let (constraint, contact) = (&at.m.unilateral[index], at.mode.contacts[index]);
    let jet = constraint.gap.slide(at.m, &MotionView { at, bodies: base, accelerations: None }, contact.feature)?;
    let load =
        |body| constraint.gap.slide(at.m, &SeededView { at, body }, contact.feature).map_or([S::zero(); 3], |s| s.du);
    let motion = constraint.bodies.iter().map(|&body| (body, Wrench::from_parts(load(body)))).collect();
    Some(row_of_slide(index, jet, motion))
}

/// A row of a joint; its load for a unit multiplier is one on the second body and its opposite on the first.
struct JointRow<S> {
    source: Source,
    value: Option<S>,
    rate: S,
    bias: S,
    /// On the second body and the first, at their joint origins, ground included.
    loads: [(usize, Wrench<S>); 2],
}

impl<S: Scalar> JointRow<S> {
    /// Writes it in place of another row, for a row is long.
    #[inline(always)]
    fn write(self, row: &mut Row<S>) {
        (row.source, row.value, row.rate, row.bias, row.force) =
            (self.source, self.value, Some(self.rate), self.bias, None);
        row.motion.clear();
        let [second, first] = self.loads;
        if second.0 > 0 {
            row.motion.push(second);
        }
        if first.0 > 0 {
            row.motion.push(first);
        }
    }

    fn new_row(self) -> Row<S> {
        let (source, bias) = (self.source, self.bias);
        let mut row = Row { source, value: None, rate: None, bias, motion: smallvec![], force: None };
        self.write(&mut row);
        row
    }
}

/// The rows of one joint expressed as a constraint.
pub fn joint_rows<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>, out: &mut Vec<Row<S>>) {
    visit_joint_rows(at, index, base, |row| out.push(row.new_row()));
}

#[inline(always)]
fn visit_joint_rows<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>, mut visit: impl FnMut(JointRow<S>)) {
    let joint = &at.m.joints[index];
    let (axes, place) = MotionView { at, bodies: base, accelerations: None }.relative(joint);
    let now = Relative { x: place.x.d0, y: place.y.d0, angle: place.angle.d0 };
    let (point, [a, b]) = (axes.place(now.at()), at.m.ends(joint));
    let (first, second) = (point - at.k.pose[a].at, point - at.k.pose[b].at);
    let mut push = |row: usize, value: Option<S>, [rate, bias]: [S; 2], load: Wrench<S>| {
        let loads = [(b, load.seen_from(second)), (a, -load.seen_from(first))];
        visit(JointRow { source: Source::Joint(index, row), value, rate, bias, loads });
    };
    if let Some(held) = joint.kind.held() {
        let (one, zero, Turn { cos, sin, .. }) = (S::one(), S::zero(), axes.turn);
        for &row in &joint.rows {
            let (of, f, m) = match held[row] {
                0 => (&place.x, vec2(cos, sin), zero),
                1 => (&place.y, vec2(-sin, cos), zero),
                _ => (&place.angle, Vec2::zero(), one),
            };
            push(row, Some(of.d0), [of.d1, of.d2], Wrench { f, m });
        }
        return;
    }
    let along = |[x, y, angle]: [S; 3]| Wrench { f: axes.turn.apply(vec2(x, y)), m: angle };
    let view = JointView::in_mode(at, index, Jet::constant);
    if let Some(coefficients) = view.rate_row(&place) {
        let rates = [place.x, place.y, place.angle];
        let (mut rate, mut bias) = (S::zero(), S::zero());
        for (c, r) in coefficients.iter().zip(rates) {
            rate += c.d0 * r.d1;
            bias += c.d0 * r.d2 + c.d1 * r.d1;
        }
        push(0, None, [rate, bias], along(coefficients.map(|c| c.d0)));
        return;
    }
    let jets = view.residual(&place);
    let seeded = Relative {
        x: Dual::<3, S>::variable(now.x, 0),
        y: Dual::variable(now.y, 1),
        angle: Dual::variable(now.angle, 2),
    };
    let slopes = JointView::in_mode(at, index, Dual::constant).residual(&seeded);
    for &row in &joint.rows {
        push(row, Some(jets[row].d0), [jets[row].d1, jets[row].d2], along(slopes[row].du));
    }
}

/// A load on the second body at a place, and its opposite on the first, each at its body's joint origin.
#[inline(always)]
pub fn pair<S: Scalar>(at: StateView<'_, S>, joint: &Joint, place: Vec2<S>, load: Wrench<S>) -> BodyWrenches<S> {
    let [a, b] = at.m.ends(joint);
    let mut wrenches = smallvec![];
    if b > 0 {
        wrenches.push((b, load.seen_from(place - at.k.pose[b].at)));
    }
    if a > 0 {
        wrenches.push((a, -load.seen_from(place - at.k.pose[a].at)));
    }
    wrenches
}

/// The row of a coupling or of a prescribed motion.
pub fn drive_row<S: Scalar>(at: StateView<'_, S>, index: usize, base: Base<S>) -> Row<S> {
    let drive: &Drive = &at.m.drives[index];
    let going = MotionView { at, bodies: base, accelerations: None };
    let of = jet(&going, &drive.of);
    let (value, rate, bias) = match drive.level {
        Level::Position => {
            let law = jet(&going, &drive.law);
            (Some(of.d0 - law.d0), Some(of.d1 - law.d1), of.d2 - law.d2)
        }
        Level::Velocity => {
            let law = jet(&going, &drive.law);
            (None, Some(of.d1 - law.d0), of.d2 - law.d1)
        }
        Level::Acceleration => {
            let law: S = drive.law.eval(&State(at) as &dyn Env<S, _>);
            (None, None, of.d2 - law)
        }
    };
    let DriveGauges { motion, force } = &at.m.drive_gauges[index];
    let loads = |(gauge, bodies): &(ModelExpr, Vec<usize>)| -> BodyWrenches<S> {
        bodies.iter().map(|&body| (body, gradient(at, gauge, body))).collect()
    };
    let (motion, force) = (loads(motion), force.as_ref().map(loads));
    Row { source: Source::Drive(index), value, rate, bias, motion, force }
}

/// The loads of a unit force along a gauge.
pub fn gauge_wrenches<S: Scalar>(at: StateView<'_, S>, gauge: &ModelExpr) -> BodyWrenches<S> {
    at.m.bodies_of(gauge).into_iter().map(|body| (body, gradient(at, gauge, body))).collect()
}
