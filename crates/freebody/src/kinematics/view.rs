//! One state of a mechanism: with plain numbers, moving, or seeded on one body.

use super::{JointView, Kinematics};
use crate::bound_values::BoundValues;
use crate::joints::{Joint as _, Relative};
use crate::mechanism::{Drive, Force, Joint, Mechanism, Part};
use crate::mode::Mode;
use crate::plane::{Pose, Turn, Twist, Vec2, Wrench};
use crate::scalar::{Dual, Jet, Scalar};

/// Where all bodies are, as scalars `T`.
pub trait Poses<T: Scalar> {
    /// The pose of a body at its joint origin.
    fn pose(&self, body: usize) -> Pose<T>;
    /// The place of a site from its body's joint origin, in the body's axes.
    fn arm(&self, site: usize) -> Vec2<T>;
    /// A number of the model.
    fn value(&self, id: usize) -> T;
    /// A parameter.
    fn parameter(&self, i: usize) -> T;
    /// A quantity with a rate of its own.
    fn state(&self, i: usize) -> T;
    /// Time.
    fn time(&self) -> T;
    /// A coordinate of a joint, as its user reads it.
    fn coordinate(&self, joint: usize, k: usize) -> T;
    /// The place of a site, fixed axes.
    fn place(&self, site: usize, m: &Mechanism) -> Vec2<T> {
        self.pose(m.body_of(site)).place(self.arm(site))
    }
    /// The vector from one site to another, fixed axes.
    fn span(&self, from: usize, to: usize, m: &Mechanism) -> Vec2<T> {
        self.place(to, m) - self.place(from, m)
    }
}

/// One state of a mechanism, as everything that measures sees it.
#[derive(Clone, Copy)]
pub struct StateView<'a, S = f64> {
    /// The mechanism.
    pub m: &'a Mechanism,
    /// Its numbers.
    pub n: &'a BoundValues<S>,
    /// Where its bodies are and how they move.
    pub k: &'a Kinematics<S>,
    /// Coordinates of the tree.
    pub q: &'a [S],
    /// Their rates.
    pub u: &'a [S],
    /// Time.
    pub t: S,
    /// Which arms of switches are frozen.
    pub mode: &'a Mode,
}

impl<S: Scalar> StateView<'_, S> {
    /// What a row of a joint was where an event engaged it, its zero since; 0 for any other, and where only changes count.
    pub fn engaged_at(&self, joint: usize, row: usize) -> S {
        if self.m.joints[joint].is_relative.get(row) == Some(&true) {
            return S::zero();
        }
        let of_mode = || self.mode.row_offsets.get(&(joint, row)).map_or(S::zero(), |&zero| S::of(zero));
        self.n.row_offsets.get(&(joint, row)).copied().unwrap_or_else(of_mode)
    }
    /// From the first point of a pin to where an event engaged it on the first body, fixed axes.
    pub fn pin_shift(&self, joint: usize) -> Vec2<S> {
        let first = &self.m.joints[joint].first;
        let axes = first.axes(self.pose(self.m.body_of(first.site)).turn, self.n.values[first.angle]);
        axes.apply(Vec2 { x: self.engaged_at(joint, 0), y: self.engaged_at(joint, 1) })
    }
}

impl<S: Scalar> Poses<S> for StateView<'_, S> {
    #[inline(always)]
    fn pose(&self, body: usize) -> Pose<S> {
        self.k.pose[body]
    }
    #[inline(always)]
    fn arm(&self, site: usize) -> Vec2<S> {
        self.n.arms[site]
    }
    #[inline(always)]
    fn value(&self, id: usize) -> S {
        self.n.values[id]
    }
    fn parameter(&self, i: usize) -> S {
        self.n.p[i]
    }
    fn state(&self, i: usize) -> S {
        self.n.p[self.m.first_state() + i]
    }
    fn time(&self) -> S {
        self.t
    }
    fn coordinate(&self, joint: usize, k: usize) -> S {
        match self.m.place_in_q(joint, k) {
            Some(i) => self.q[i],
            None => measured(self.m, self.n, self, joint, k, |x| x),
        }
    }
    /// Along the tree, so that what both sites have in common cancels before it is rounded.
    fn span(&self, from: usize, to: usize, m: &Mechanism) -> Vec2<S> {
        let [a, b] = [from, to].map(|site| m.body_of(site));
        let meeting = m.common_ancestor(a, b);
        let [(near_a, far_a), (near_b, far_b)] =
            [(from, a), (to, b)].map(|(site, body)| self.reach(site, body, meeting));
        (near_b - near_a) + (far_b - far_a)
    }
}

/// A state over any scalar by its plain values, for decisions.
pub struct ValuesView<'a, S>(pub StateView<'a, S>);

impl<S: Scalar> Poses<f64> for ValuesView<'_, S> {
    fn pose(&self, body: usize) -> Pose {
        let Pose { at, turn } = self.0.pose(body);
        let turn = Turn { angle: turn.angle.value(), cos: turn.cos.value(), sin: turn.sin.value() };
        Pose { at: at.value(), turn }
    }
    fn arm(&self, site: usize) -> Vec2 {
        self.0.arm(site).value()
    }
    fn value(&self, id: usize) -> f64 {
        self.0.value(id).value()
    }
    fn parameter(&self, i: usize) -> f64 {
        self.0.parameter(i).value()
    }
    fn state(&self, i: usize) -> f64 {
        self.0.state(i).value()
    }
    fn time(&self) -> f64 {
        self.0.t.value()
    }
    fn coordinate(&self, joint: usize, k: usize) -> f64 {
        self.0.coordinate(joint, k).value()
    }
    fn span(&self, from: usize, to: usize, m: &Mechanism) -> Vec2 {
        self.0.span(from, to, m).value()
    }
}

impl<'a, S: Scalar> StateView<'a, S> {
    /// The joints in place, with their numbers.
    pub fn joints(&self) -> impl Iterator<Item = (usize, &'a Joint)> {
        let mode = self.mode;
        self.m.joints.iter().enumerate().filter(|(j, _)| mode.has(Part::Joint(*j)))
    }
    /// The couplings and prescribed motions in place, with their numbers.
    pub fn drives(&self) -> impl Iterator<Item = (usize, &'a Drive)> {
        let mode = self.mode;
        self.m.drives.iter().enumerate().filter(|(d, _)| mode.has(Part::Drive(*d)))
    }
    /// The forces in place, gravity apart, with their numbers.
    pub fn forces(&self) -> impl Iterator<Item = (usize, &'a Force)> {
        let mode = self.mode;
        self.m.forces.iter().enumerate().filter(|(f, _)| mode.has(Part::Force(*f)))
    }
    /// From the joint origin of a body to its mass centre, fixed axes.
    #[inline(always)]
    pub fn centre_arm(&self, body: usize) -> Vec2<S> {
        self.k.pose[body].turn.apply(self.n.centre[body])
    }
    /// The place of a site, fixed axes.
    pub fn site(&self, site: usize) -> Vec2<S> {
        self.k.pose[self.m.body_of(site)].place(self.n.arms[site])
    }
    /// The mass centre of a body, fixed axes.
    pub fn mass_centre(&self, body: usize) -> Vec2<S> {
        self.k.pose[body].at + self.centre_arm(body)
    }
    /// −1 for a distance that the tree carries below 0, which its measure cannot tell; else 1.
    fn side(&self, joint: usize, k: usize) -> f64 {
        let j = &self.m.joints[joint];
        let c = &j.coordinates[k];
        let coordinate = self.m.place_in_q(joint, k).filter(|_| j.kind.unsigned(c.card));
        let below = coordinate.is_some_and(|i| self.n.values[c.zero].value() + c.sense * self.q[i].value() < 0.0);
        if below {
            -1.0
        } else {
            1.0
        }
    }
    /// The way from the joint origin of `ancestor` to a site on `body`: its first part, on the ancestor itself, and the
    /// rest.
    fn reach(&self, site: usize, body: usize, ancestor: usize) -> (Vec2<S>, Vec2<S>) {
        let own = self.k.pose[body].turn.apply(self.n.arms[site]);
        if body == ancestor {
            return (own, Vec2::zero());
        }
        let (mut body, mut rest) = (body, own);
        loop {
            let parent = self.m.bodies[body].tree_joint.expect("a body that hangs on the ancestor").parent;
            if parent == ancestor {
                return (self.k.arm[body], rest);
            }
            rest += self.k.arm[body];
            body = parent;
        }
    }
}

/// The state in motion: every measure comes with its rate and its acceleration.
pub struct MotionView<'a, S> {
    /// The state.
    pub at: StateView<'a, S>,
    /// Accelerations of joint origins and angles of all bodies; 0 when not given.
    pub bodies: Option<&'a [Twist<S>]>,
    /// Accelerations of the coordinates, if they are known.
    pub accelerations: Option<&'a [S]>,
}

impl<S: Scalar> Poses<Jet<S>> for MotionView<'_, S> {
    #[inline(always)]
    fn pose(&self, body: usize) -> Pose<Jet<S>> {
        let (pose, twist) = (self.at.k.pose[body], self.at.k.twist[body]);
        let acc = self.bodies.map_or(Twist::zero(), |bodies| bodies[body]);
        let turn = &pose.turn;
        let (w, w2) = (twist.w, twist.w * twist.w);
        Pose {
            at: Vec2 { x: Jet::new(pose.at.x, twist.v.x, acc.v.x), y: Jet::new(pose.at.y, twist.v.y, acc.v.y) },
            turn: Turn {
                angle: Jet::new(turn.angle, w, acc.w),
                cos: Jet::new(turn.cos, -turn.sin * w, -turn.cos * w2 - turn.sin * acc.w),
                sin: Jet::new(turn.sin, turn.cos * w, -turn.sin * w2 + turn.cos * acc.w),
            },
        }
    }
    #[inline(always)]
    fn arm(&self, site: usize) -> Vec2<Jet<S>> {
        let arm = self.at.n.arms[site];
        Vec2 { x: Jet::constant(arm.x), y: Jet::constant(arm.y) }
    }
    #[inline(always)]
    fn value(&self, id: usize) -> Jet<S> {
        Jet::constant(self.at.n.values[id])
    }
    fn parameter(&self, i: usize) -> Jet<S> {
        Jet::constant(self.at.n.p[i])
    }
    fn state(&self, i: usize) -> Jet<S> {
        // Nothing asks for its second derivative.
        Jet::new(self.at.state(i), self.at.m.state_rates[i].eval(&super::State(self.at)), S::zero())
    }
    fn time(&self) -> Jet<S> {
        Jet::new(self.at.t, S::one(), S::zero())
    }
    #[inline(always)]
    fn place(&self, site: usize, m: &Mechanism) -> Vec2<Jet<S>> {
        let body = m.body_of(site);
        let (pose, twist) = (&self.at.k.pose[body], &self.at.k.twist[body]);
        let arm = pose.turn.apply(self.at.n.arms[site]);
        let (at, v) = (pose.at + arm, twist.at(arm));
        let a = self.bodies.map_or(Twist::zero(), |bodies| bodies[body]).acceleration_at(arm, twist.w);
        Vec2 { x: Jet::new(at.x, v.x, a.x), y: Jet::new(at.y, v.y, a.y) }
    }
    fn span(&self, from: usize, to: usize, m: &Mechanism) -> Vec2<Jet<S>> {
        let value = self.at.span(from, to, m);
        let by_places = self.place(to, m) - self.place(from, m);
        Vec2 { x: Jet { d0: value.x, ..by_places.x }, y: Jet { d0: value.y, ..by_places.y } }
    }
    fn coordinate(&self, joint: usize, k: usize) -> Jet<S> {
        match (self.at.m.place_in_q(joint, k), self.accelerations) {
            (Some(i), Some(a)) => Jet::new(self.at.q[i], self.at.u[i], a[i]),
            _ => self.along_bodies(joint, k),
        }
    }
}

impl<S: Scalar> MotionView<'_, S> {
    /// As [`relative`], written out: the place of a joint's second marker as seen from its first, in motion, with the pose of the
    /// first marker.
    #[inline(always)]
    pub fn relative(&self, joint: &Joint) -> (Pose<S>, Relative<Jet<S>>) {
        let StateView { m, n, k, .. } = self.at;
        let [a, b] = m.ends(joint);
        let moving = |body: usize, site: usize| {
            let (arm, twist) = (k.pose[body].turn.apply(n.arms[site]), k.twist[body]);
            let acceleration = self.bodies.map_or(Twist::zero(), |bodies| bodies[body]);
            let of_site = acceleration.acceleration_at(arm, twist.w);
            (arm, Twist { v: twist.at(arm), w: twist.w }, Twist { v: of_site, w: acceleration.w })
        };
        let (first, second) = (moving(a, joint.first.site), moving(b, joint.second.site));
        let axes = joint.first.axes(k.pose[a].turn, n.values[joint.first.angle]);
        let (d, v, acc) =
            (self.at.span(joint.first.site, joint.second.site, m), second.1 - first.1, second.2 - first.2);
        let (w, alpha) = (first.1.w, first.2.w);
        let at = axes.undo(d);
        let rate = axes.undo(v.v - d.perp() * w);
        let bend = axes.undo(acc.v - d.perp() * alpha - v.v.perp() * w.scale(2.0) - d * (w * w));
        let angle = k.pose[b].turn.angle + n.values[joint.second.angle] - axes.angle;
        let place = Relative {
            x: Jet::new(at.x, rate.x, bend.x),
            y: Jet::new(at.y, rate.y, bend.y),
            angle: Jet::new(angle, v.w, acc.w),
        };
        (Pose { at: k.pose[a].at + first.0, turn: axes }, place)
    }

    /// A coordinate by way of the bodies: right for any accelerations of the bodies.
    fn along_bodies(&self, joint: usize, k: usize) -> Jet<S> {
        let (m, n) = (self.at.m, self.at.n);
        let measured = match m.joints[joint].curve {
            Some(_) => self.along_curve(joint, k),
            None => measured(m, n, self, joint, k, Jet::constant).scale(self.at.side(joint, k)),
        };
        Jet { d0: self.at.coordinate(joint, k), ..measured }
    }

    /// A coordinate of a joint on a curve: the turn is read off the bodies; of the place r(s), or r(s, gap), whose coordinate lines
    /// are at right angles, r̈ = r′s̈ + … is taken along r′, where … is what the rates alone give.
    fn along_curve(&self, index: usize, k: usize) -> Jet<S> {
        let (m, n) = (self.at.m, self.at.n);
        let joint = &m.joints[index];
        let c = &joint.coordinates[k];
        let (axes, place) = relative(joint, m, self);
        if c.dimension == "rad" {
            return (if c.absolute { place.angle + axes.turn.angle } else { place.angle }).scale(c.sense);
        }
        let start = m.place_in_q(index, k).expect("a joint along a curve is in the tree");
        let mut going = [Jet::constant(S::zero()); 3];
        for (i, other) in joint.coordinates.iter().enumerate().filter(|(_, other)| other.dimension != "rad") {
            let (q, u) = (self.at.q[start - k + i], self.at.u[start - k + i]);
            going[other.card] = Jet::new(n.values[other.zero] + q.scale(other.sense), u.scale(other.sense), S::zero());
        }
        let view = JointView::new(m, n, joint, Jet::constant);
        let run = view.pose(&going[..joint.size], false);
        let mut alone = going.map(|x| Jet::constant(x.d0));
        alone[c.card].d1 = S::one();
        let unit = view.pose(&alone[..joint.size], false);
        let slope = Vec2 { x: unit.x.d1, y: unit.y.d1 };
        let rest = Vec2 { x: place.x.d2 - run.x.d2, y: place.y.d2 - run.y.d2 };
        Jet::new(self.at.q[start], self.at.u[start], (slope.dot(rest) / slope.dot(slope)).scale(c.sense))
    }
}

/// The state with the pose of one body seeded: measures come with their gradient by (x, y, angle) of its joint origin.
pub struct SeededView<'a, S> {
    /// The state.
    pub at: StateView<'a, S>,
    /// The seeded body.
    pub body: usize,
}

impl<S: Scalar> Poses<Dual<3, S>> for SeededView<'_, S> {
    fn pose(&self, body: usize) -> Pose<Dual<3, S>> {
        let pose = self.at.k.pose[body];
        let (x, y, turn) = (pose.at.x, pose.at.y, pose.turn);
        if body != self.body {
            let fixed = Dual::constant;
            let at = Vec2 { x: fixed(x), y: fixed(y) };
            return Pose { at, turn: Turn { angle: fixed(turn.angle), cos: fixed(turn.cos), sin: fixed(turn.sin) } };
        }
        let zero = S::zero();
        Pose {
            at: Vec2 { x: Dual::variable(x, 0), y: Dual::variable(y, 1) },
            turn: Turn {
                angle: Dual::variable(turn.angle, 2),
                cos: Dual { re: turn.cos, du: [zero, zero, -turn.sin] },
                sin: Dual { re: turn.sin, du: [zero, zero, turn.cos] },
            },
        }
    }
    fn arm(&self, site: usize) -> Vec2<Dual<3, S>> {
        let arm = self.at.n.arms[site];
        Vec2 { x: Dual::constant(arm.x), y: Dual::constant(arm.y) }
    }
    fn value(&self, id: usize) -> Dual<3, S> {
        Dual::constant(self.at.n.values[id])
    }
    fn parameter(&self, i: usize) -> Dual<3, S> {
        Dual::constant(self.at.n.p[i])
    }
    fn state(&self, i: usize) -> Dual<3, S> {
        Dual::constant(self.at.state(i))
    }
    fn time(&self) -> Dual<3, S> {
        Dual::constant(self.at.t)
    }
    fn coordinate(&self, joint: usize, k: usize) -> Dual<3, S> {
        let (m, n) = (self.at.m, self.at.n);
        let du = match m.joints[joint].curve {
            None => measured(m, n, self, joint, k, Dual::constant).scale(self.at.side(joint, k)).du,
            Some(_) => self.along_curve(joint, k),
        };
        Dual { re: self.at.coordinate(joint, k), du }
    }
}

impl<S: Scalar> SeededView<'_, S> {
    /// The gradient of a coordinate of a joint on a curve: a couple for the turn; for the place a force along the curve
    /// at the second body's point, which does no work on the turn.
    fn along_curve(&self, index: usize, k: usize) -> [S; 3] {
        let (m, kin) = (self.at.m, self.at.k);
        let joint = &m.joints[index];
        let c = &joint.coordinates[k];
        let child = joint.child.expect("a joint along a curve is in the tree");
        let [first, second] = m.ends(joint);
        let place = self.at.pose(second).place(self.at.arm(joint.second.site));
        let load = if c.dimension == "rad" {
            Wrench { f: Vec2::zero(), m: S::of(c.sense) }
        } else {
            let along = kin.motion_subspace[child][k].v;
            let sense = if child == second { c.sense } else { -c.sense };
            Wrench { f: along * (S::of(sense) / along.dot(along)), m: S::zero() }
        };
        let on = |body: usize| load.seen_from(place - kin.pose[body].at);
        match self.body {
            body if body == second => on(second).parts(),
            body if body == first && !c.absolute => (-on(first)).parts(),
            _ => [S::zero(); 3],
        }
    }
}

/// A coordinate of a joint read off the bodies.
pub(super) fn measured<S: Scalar, T: Scalar>(
    m: &Mechanism,
    n: &BoundValues<S>,
    poses: &impl Poses<T>,
    joint: usize,
    k: usize,
    to: impl Fn(S) -> T,
) -> T {
    let joint = &m.joints[joint];
    let c = &joint.coordinates[k];
    let (axes, place) = relative(joint, m, poses);
    let view = JointView::new(m, n, joint, to);
    let own = view.measure(&place).expect("a coordinate that can be read off")[c.card];
    let reading = if c.absolute { own + axes.turn.angle } else { own };
    (reading - poses.value(c.zero)).scale(c.sense)
}

/// The place of a joint's second marker as seen from its first, with the pose of the first marker.
#[inline]
pub fn relative<T: Scalar>(joint: &Joint, m: &Mechanism, poses: &impl Poses<T>) -> (Pose<T>, Relative<T>) {
    let [a, b] = m.ends(joint);
    let (first, second) = (poses.pose(a), poses.pose(b));
    let axes = joint.first.axes(first.turn, poses.value(joint.first.angle));
    let from = poses.place(joint.first.site, m);
    let at = axes.undo(poses.span(joint.first.site, joint.second.site, m));
    let angle = second.turn.angle + poses.value(joint.second.angle) - axes.angle;
    (Pose { at: from, turn: axes }, Relative { x: at.x, y: at.y, angle })
}
