//! Kinematics of the tree: where every body is, how it moves, and how it would accelerate if no
//! joint did.
//!
//! Joint rates ν are relative (of the second body against the first); the user's rates u may be
//! absolute or reversed. [`Kinematics::user_rates`] goes between them.
//!
//! A state is seen as [`StateView`], over any scalar; gauges are measured on it.

mod joint_view;
mod measure;
mod travel;
mod view;

pub use joint_view::JointView;
pub use measure::{gradient, jet, Config, Observed, State};
pub use travel::{Travel, TravelView, PARTS};
pub use view::{relative, MotionView, Poses, SeededView, StateView, ValuesView};

use crate::bound_values::{BoundValues, HingeNumbers};
use crate::joints::Relative;
use crate::mechanism::{Body, Joint, Mechanism, TreeJoint};
use crate::plane::{vec2, Pose, Turn, Twist, Vec2};
use crate::scalar::{Dual, Jet, Scalar, WIDE};

/// Poses, twists and velocity-product accelerations of all bodies at one state.
#[derive(Clone, Debug, Default)]
pub struct Kinematics<S = f64> {
    /// Pose of each body at its joint origin.
    pub pose: Vec<Pose<S>>,
    /// Velocity of the joint origin and angular velocity.
    pub twist: Vec<Twist<S>>,
    /// From the parent's joint origin to the own joint origin, fixed axes.
    pub arm: Vec<Vec2<S>>,
    /// Acceleration of the own joint origin against the parent's motion when all joint accelerations are 0:
    /// centripetal, Coriolis and the joint's own.
    pub bias_acceleration: Vec<Twist<S>>,
    /// Motion of the own joint origin against the parent for each unit joint rate, fixed axes.
    pub motion_subspace: Vec<[Twist<S>; 3]>,
    /// Joint rates of each coordinate, in the order of `q`.
    pub nu: Vec<S>,
}

impl<S: Scalar> Kinematics<S> {
    /// Memory for a mechanism.
    pub fn of(mechanism: &Mechanism) -> Self {
        let n = mechanism.bodies.len();
        Kinematics {
            pose: vec![Pose::identity(); n],
            twist: vec![Twist::zero(); n],
            arm: vec![Vec2::zero(); n],
            bias_acceleration: vec![Twist::zero(); n],
            motion_subspace: mechanism.bodies.iter().map(constant_subspace).collect(),
            nu: vec![S::zero(); mechanism.freedom()],
        }
    }

    /// Goes through the tree from ground to the leaves, at coordinates `q` and rates `u`.
    #[inline(always)]
    pub fn forward_kinematics(&mut self, m: &Mechanism, n: &BoundValues<S>, q: &[S], u: &[S]) {
        let mut body = 1;
        while body < m.bodies.len() {
            let hinges = m.bodies[body..].iter().map_while(|body| body.tree_joint.filter(|b| b.hinge));
            if hinges.take(WIDE).count() == WIDE {
                self.place_on_hinges(m, n, body, [q, u]);
                body += WIDE;
                continue;
            }
            match m.bodies[body].tree_joint {
                Some(b) if b.hinge => {
                    let hinge = &n.hinges[body];
                    let angle = self.turn_on_hinge(body, m.bodies[body].particle, b, hinge, [q, u]);
                    self.shift_on_hinge(body, b.parent, hinge.arm, Turn::by(angle));
                }
                Some(b) => self.place_child(m, n, body, b, q, u),
                None => {}
            }
            body += 1;
        }
    }

    /// Bodies in a row on plain hinges, from one on, each as alone: their sines and cosines are found side by side.
    #[inline(always)]
    fn place_on_hinges(&mut self, m: &Mechanism, n: &BoundValues<S>, first: usize, state: [&[S]; 2]) {
        let (bodies, hinges) = (&m.bodies[first..][..WIDE], &n.hinges[first..][..WIDE]);
        let on_hinge = |body: &Body| body.tree_joint.expect("it is on a hinge");
        let mut angles = [S::zero(); WIDE];
        for (k, (body, hinge)) in bodies.iter().zip(hinges).enumerate() {
            angles[k] = self.turn_on_hinge(first + k, body.particle, on_hinge(body), hinge, state);
        }
        let [sin, cos] = S::sin_cos_each(&angles);
        for (k, (body, hinge)) in bodies.iter().zip(hinges).enumerate() {
            let turn = Turn { cos: cos[k], sin: sin[k], angle: angles[k] };
            self.shift_on_hinge(first + k, on_hinge(body).parent, hinge.arm, turn);
        }
    }

    /// The angle of a body on a plain hinge between body axes: the general case, written short.
    #[inline(always)]
    fn turn_on_hinge(
        &mut self,
        body: usize,
        particle: bool,
        b: TreeJoint,
        hinge: &HingeNumbers<S>,
        [q, u]: [&[S]; 2],
    ) -> S {
        if particle {
            return S::zero();
        }
        let (near, base_rate) = (self.pose[b.parent].turn.angle + hinge.near, self.twist[b.parent].w);
        let (angle, rate) = hinge.reading.to_joint(q[b.start], u[b.start], near, base_rate);
        let (angle, rate) = if b.reversed { (-angle, -rate) } else { (angle, rate) };
        let angle = near + angle - hinge.far;
        self.nu[b.start] = if b.reversed { -rate } else { rate };
        self.twist[body].w = base_rate + rate;
        self.pose[body].turn.angle = angle;
        angle
    }

    /// The place of that body, which is turned like this and hangs on its parent at `arm`, in the parent's axes.
    #[inline(always)]
    fn shift_on_hinge(&mut self, body: usize, parent: usize, arm: Vec2<S>, turn: Turn<S>) {
        let (base, carried) = (self.pose[parent], self.twist[parent]);
        let arm = base.turn.apply(arm);
        self.arm[body] = arm;
        self.pose[body] = Pose { at: base.at + arm, turn };
        self.twist[body].v = carried.at(arm);
        self.bias_acceleration[body].v = -(arm * (carried.w * carried.w));
    }

    /// A body on any joint, from the joint's pose.
    fn place_child(&mut self, m: &Mechanism, n: &BoundValues<S>, body: usize, b: TreeJoint, q: &[S], u: &[S]) {
        let joint = &m.joints[b.joint];
        let (near, far) = joint.sides(b.reversed);
        let (base, parent_twist) = (self.pose[b.parent], self.twist[b.parent]);
        let axes = near.axes(base.turn, n.values[near.angle]);
        let (mut at, mut rate) = ([S::zero(); 3], [S::zero(); 3]);
        for (k, c) in joint.coordinates.iter().enumerate() {
            let i = b.start + k;
            (at[c.card], rate[c.card]) = c.reading(&n.values).to_joint(q[i], u[i], axes.angle, parent_twist.w);
            self.nu[i] = rate[c.card];
        }
        let motion = JointMotion::of(m, n, joint, b.reversed, &at[..joint.size], &rate[..joint.size]);

        let moved = axes.apply(motion.at.at());
        let arm = base.turn.apply(n.arms[near.site]) + moved;
        let slide = axes.apply(vec2(motion.rate[0], motion.rate[1]));
        let curl = axes.apply(vec2(motion.bias_acceleration[0], motion.bias_acceleration[1]));
        let w = parent_twist.w;
        let particle = m.bodies[body].particle;
        let turning = |x: S| if particle { S::zero() } else { x };
        let angle = turning(axes.angle + motion.at.angle - n.values[far.angle]);

        self.arm[body] = arm;
        self.pose[body] = Pose { at: base.at + arm, turn: Turn::by(angle) };
        self.twist[body] = Twist { v: parent_twist.at(arm) + slide, w: turning(w + motion.rate[2]) };
        self.bias_acceleration[body] =
            Twist { v: curl + slide.perp() * w.scale(2.0) - arm * (w * w), w: turning(motion.bias_acceleration[2]) };
        for (k, coordinate) in joint.coordinates.iter().enumerate() {
            let column = motion.motion_subspace[coordinate.card];
            self.motion_subspace[body][k] = Twist { v: axes.apply(vec2(column[0], column[1])), w: turning(column[2]) };
        }
    }

    /// The user's accelerations from the bodies' accelerations (of the joint origins) and the joints' own `nu_dot`.
    #[inline(always)]
    pub fn user_rates(&self, m: &Mechanism, n: &BoundValues<S>, bodies: &[Twist<S>], nu: &[S], out: &mut [S]) {
        for (body, hinge) in m.bodies.iter().zip(&n.hinges) {
            let Some(b) = body.tree_joint else { continue };
            let carried = bodies[b.parent].w;
            if b.hinge && b.freedom == 1 {
                out[b.start] = hinge.reading.to_user(nu[b.start], carried);
                continue;
            }
            for (c, i) in m.joints[b.joint].coordinates.iter().zip(b.start..) {
                out[i] = c.reading(&n.values).to_user(nu[i], carried);
            }
        }
    }

    /// Accelerations of all joint origins and angles for joint accelerations `nu_dot`; with `bias`, those that
    /// the velocities cause are added (without, the result is a virtual displacement or a velocity).
    pub fn propagate_motion(&self, m: &Mechanism, nu_dot: &[S], bias: bool, out: &mut [Twist<S>]) {
        self.propagate(m, bias, |b, k, _| nu_dot[b.start + k], out);
    }

    /// Accelerations of all joint origins and angles for accelerations of the user's coordinates.
    pub fn propagate_user_motion(&self, m: &Mechanism, n: &BoundValues<S>, u_dot: &[S]) -> Vec<Twist<S>> {
        let own = |b: TreeJoint, k: usize, carried: S| {
            let reading = m.joints[b.joint].coordinates[k].reading(&n.values);
            reading.to_joint(S::zero(), u_dot[b.start + k], S::zero(), carried).1
        };
        let mut out = vec![Twist::zero(); m.bodies.len()];
        self.propagate(m, true, own, &mut out);
        out
    }

    /// Goes through the tree; `own` tells the joint acceleration of a coordinate of a branch, given the angular one of
    /// the body that carries it.
    fn propagate(&self, m: &Mechanism, bias: bool, own: impl Fn(TreeJoint, usize, S) -> S, out: &mut [Twist<S>]) {
        out[0] = Twist::zero();
        for (i, body) in m.bodies.iter().enumerate() {
            let Some(b) = body.tree_joint else { continue };
            let base = out[b.parent];
            let mut motion = Twist { v: base.at(self.arm[i]), w: if body.particle { S::zero() } else { base.w } };
            if bias {
                motion = motion + self.bias_acceleration[i];
            }
            for k in 0..b.freedom {
                motion = motion + self.motion_subspace[i][k] * own(b, k, base.w);
            }
            out[i] = motion;
        }
    }
}

/// The columns that no state changes: those of plain hinges.
fn constant_subspace<S: Scalar>(body: &Body) -> [Twist<S>; 3] {
    let mut columns = [Twist::zero(); 3];
    if let Some(tree_joint) = body.tree_joint.filter(|b| b.hinge && b.freedom == 1) {
        columns[0].w = if tree_joint.reversed { -S::one() } else { S::one() };
    }
    columns
}

/// A joint's relative pose with its derivatives, seen from the body nearer to ground.
struct JointMotion<S> {
    at: Relative<S>,
    motion_subspace: [[S; 3]; 3],
    rate: [S; 3],
    bias_acceleration: [S; 3],
}

impl<S: Scalar> JointMotion<S> {
    fn of(m: &Mechanism, n: &BoundValues<S>, joint: &Joint, reversed: bool, at: &[S], rate: &[S]) -> Self {
        let seeds: [Dual<3, S>; 3] = std::array::from_fn(|i| Dual::variable(*at.get(i).unwrap_or(&S::zero()), i));
        let seeded = JointView::new(m, n, joint, Dual::constant).pose(&seeds[..at.len()], reversed);
        let zero = S::zero();
        let going: [Jet<S>; 3] = std::array::from_fn(|i| match at.get(i) {
            Some(&x) => Jet::new(x, rate[i], zero),
            None => Jet::constant(zero),
        });
        let moving = JointView::new(m, n, joint, Jet::constant).pose(&going[..at.len()], reversed);
        JointMotion {
            at: Relative { x: seeded.x.re, y: seeded.y.re, angle: seeded.angle.re },
            motion_subspace: std::array::from_fn(|k| [seeded.x.du[k], seeded.y.du[k], seeded.angle.du[k]]),
            rate: [moving.x.d1, moving.y.d1, moving.angle.d1],
            bias_acceleration: [moving.x.d2, moving.y.d2, moving.angle.d2],
        }
    }
}
