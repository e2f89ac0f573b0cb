//! The articulated-body algorithm: accelerations and all reactions of a tree in one pass towards ground and one back.
//!
//! Featherstone's articulated-body algorithm (*Rigid Body Dynamics Algorithms*, ch. 7) in the plane, about the joint
//! origins: towards ground, each body tells its parent how it would resist (mass `A`, bias `p`) once its joint's
//! freedom is eliminated; back, each joint's acceleration and the load that it passes follow. Lever arms are relative
//! vectors, so nothing is lost far from the origin.

use super::momentum::Inertia;
use super::DynamicsError;
use crate::kinematics::StateView;
use crate::mechanism::TreeJoint;
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// Relative size below which an inertia is none.
const NO_INERTIA: f64 = 1e-13;

/// What a body and all that hangs on it resist, at its joint origin: the load needed for an acceleration a is
/// A a + p, A = [xx xy x; xy yy y; x y turn].
#[derive(Clone, Copy, Debug)]
struct ArticulatedInertia<S> {
    xx: S,
    xy: S,
    yy: S,
    /// Coupling of force and angular acceleration.
    h: Vec2<S>,
    turn: S,
    p: Vec2<S>,
    pm: S,
    /// The inertia there would be if nothing cancelled: the measure of what is nothing.
    size: S,
}

/// What the way back needs of a plain hinge: each acceleration waits for the one before, and for little else.
#[derive(Clone, Copy, Debug)]
struct FreeHinge<S> {
    /// 1 / turn; 0 of a particle, which nothing turns.
    inverse: S,
    /// The couple that would keep the body from turning faster, where its parent has no acceleration,
    couple: S,
    /// and for each unit of the parent's angular acceleration.
    lever: S,
}

type Square<S> = [[S; 3]; 3];

/// The same of any other joint, of so many columns S: U = A S and (SᵀAS)⁻¹.
#[derive(Clone, Copy, Debug)]
struct GeneralJoint<S> {
    u: Square<S>,
    inverse: Square<S>,
    freedom: usize,
}

/// Memory of the sweep.
#[derive(Clone, Debug)]
pub struct ArticulatedBody<S = f64> {
    full: Vec<ArticulatedInertia<S>>,
    /// Of each body that of its joint.
    hinges: Vec<FreeHinge<S>>,
    general: Vec<GeneralJoint<S>>,
}

impl<S: Scalar> ArticulatedInertia<S> {
    #[inline(always)]
    fn none() -> Self {
        let (zero, none) = (S::zero(), Vec2::zero());
        ArticulatedInertia { xx: zero, xy: zero, yy: zero, h: none, turn: zero, p: none, pm: zero, size: zero }
    }
    #[inline(always)]
    fn apply(&self, a: Twist<S>) -> Wrench<S> {
        Wrench {
            f: vec2(
                self.xx * a.v.x + self.xy * a.v.y + self.h.x * a.w,
                self.xy * a.v.x + self.yy * a.v.y + self.h.y * a.w,
            ),
            m: self.h.dot(a.v) + self.turn * a.w,
        }
    }
    #[inline(always)]
    fn bias(&self) -> Wrench<S> {
        Wrench { f: self.p, m: self.pm }
    }
    /// The force needed for an acceleration of the joint origin.
    #[inline(always)]
    fn push(&self, v: Vec2<S>) -> Vec2<S> {
        vec2(self.xx * v.x + self.xy * v.y, self.xy * v.x + self.yy * v.y)
    }
    /// With what is left of a child that turns freely about its joint origin, which lies at `arm` and has this acceleration beside its
    /// parent: what the child resists, less what its turning gives way. Little is left to be done once `inverse` is known.
    #[inline(always)]
    fn with_freed(self, c: &ArticulatedInertia<S>, hinge: &FreeHinge<S>, arm: Vec2<S>, bias: Vec2<S>) -> Self {
        let (r, h, FreeHinge { inverse, couple, lever }) = (arm.perp(), c.h, *hinge);
        let (mr, p) = (c.push(r), c.p + c.push(bias));
        ArticulatedInertia {
            xx: self.xx + c.xx - h.x * h.x * inverse,
            xy: self.xy + c.xy - h.x * h.y * inverse,
            yy: self.yy + c.yy - h.y * h.y * inverse,
            h: self.h + mr - h * (lever * inverse),
            turn: self.turn + r.dot(mr) - lever * lever * inverse,
            p: self.p + p - h * (couple * inverse),
            pm: self.pm + arm.cross(p) - lever * couple * inverse,
            size: self.size + (c.xx + c.yy) * r.dot(r),
        }
    }
    /// With what a child resists at its joint origin, which lies at `arm`.
    #[inline(always)]
    fn with_child(self, c: &ArticulatedInertia<S>, arm: Vec2<S>) -> Self {
        let r = arm.perp();
        let mr = c.push(r);
        ArticulatedInertia {
            xx: self.xx + c.xx,
            xy: self.xy + c.xy,
            yy: self.yy + c.yy,
            h: self.h + (mr + c.h),
            turn: self.turn + (r.dot(mr) + r.dot(c.h).scale(2.0) + c.turn),
            p: self.p + c.p,
            pm: self.pm + (arm.cross(c.p) + c.pm),
            size: self.size + (c.size + (c.xx + c.yy) * r.dot(r)),
        }
    }
}

impl<S: Scalar> ArticulatedBody<S> {
    pub fn new() -> Self {
        ArticulatedBody { full: vec![], hinges: vec![], general: vec![] }
    }

    /// Joint accelerations `nu_dot`, accelerations of the joint origins and, by `passed`, the load that each body's joint puts
    /// on it at its joint origin.
    ///
    /// # Errors
    /// A joint that nothing resists, by the name of its body.
    #[inline(always)]
    pub fn solve(
        &mut self,
        at: StateView<'_, S>,
        arms: &[Vec2<S>],
        loads: &[Wrench<S>],
        nu_dot: &mut [S],
        bodies: &mut [Twist<S>],
        passed: impl FnMut(usize, Wrench<S>),
    ) -> Result<(), DynamicsError> {
        self.start_bodies(at, arms, loads);
        self.free_joints(at)?;
        self.accelerate(at, nu_dot, bodies, passed);
        Ok(())
    }

    /// Towards ground: frees one joint after the other, and gives what is left of its body to the parent.
    #[inline(always)]
    fn free_joints(&mut self, at: StateView<'_, S>) -> Result<(), DynamicsError> {
        let n = at.m.bodies.len();
        let (tree, full, hinges, general) =
            (&at.m.bodies[..n], &mut self.full[..n], &mut self.hinges[..n], &mut self.general[..n]);
        let (arms, biases, subspaces) = (&at.k.arm[..n], &at.k.bias_acceleration[..n], &at.k.motion_subspace[..n]);
        // The body that comes next, in a chain the parent: what it is given stays at hand.
        let mut next = full[n - 1];
        for i in (1..n).rev() {
            let TreeJoint { parent, hinge, freedom, .. } = tree[i].tree_joint.expect("every body hangs in the tree");
            let (body, arm, bias, columns) = (next, arms[i], biases[i].v, &subspaces[i]);
            let (particle, singular) = (tree[i].particle, || DynamicsError::singular_inertia(at.m, i));
            (full[i], next) = (body, full[i - 1]);
            match hinge {
                true => hinges[i] = FreeHinge::of(&body, particle, arm, bias).ok_or_else(singular)?,
                false => general[i] = GeneralJoint::of(&full[i], columns, freedom).ok_or_else(singular)?,
            }
            // Ground resists whatever hangs on it.
            if parent == 0 {
                continue;
            }
            let to = if parent == i - 1 { next } else { full[parent] };
            let given = match hinge {
                true => to.with_freed(&body, &hinges[i], arm, bias),
                false => to.with_child(&general[i].beyond(&full[i], columns, particle, biases[i]), arm),
            };
            match parent == i - 1 {
                true => next = given,
                false => full[parent] = given,
            }
        }
        Ok(())
    }

    /// Back from ground: each joint's acceleration, and the load that it passes.
    #[inline(always)]
    fn accelerate(
        &self,
        at: StateView<'_, S>,
        nu_dot: &mut [S],
        bodies: &mut [Twist<S>],
        mut passed: impl FnMut(usize, Wrench<S>),
    ) {
        let n = at.m.bodies.len();
        let (tree, full, hinges, bodies) = (&at.m.bodies[..n], &self.full[..n], &self.hinges[..n], &mut bodies[..n]);
        let (arms, biases) = (&at.k.arm[..n], &at.k.bias_acceleration[..n]);
        bodies[0] = Twist::zero();
        let mut last = bodies[0];
        for i in 1..n {
            let (body, tree_joint) = (&full[i], tree[i].tree_joint.expect("every body hangs in the tree"));
            let base = if tree_joint.parent == i - 1 { last } else { bodies[tree_joint.parent] };
            let (bias, particle) = (biases[i], tree[i].particle);
            let mut a = Twist { v: base.at(arms[i]) + bias.v, w: if particle { S::zero() } else { base.w + bias.w } };
            if tree_joint.hinge && !particle {
                let alpha = hinges[i].acceleration(body, base);
                let sense = if tree_joint.reversed { -1.0 } else { 1.0 };
                nu_dot[tree_joint.start] = (alpha - a.w).scale(sense);
                a.w = alpha;
            } else if tree_joint.freedom > 0 {
                let rates = &mut nu_dot[tree_joint.start..][..tree_joint.freedom];
                a = self.general[i].accelerate(body, &at.k.motion_subspace[i], a, rates);
            }
            (bodies[i], last) = (a, a);
            passed(i, body.apply(a) + body.bias());
        }
    }

    /// Every body alone.
    #[inline(always)]
    fn start_bodies(&mut self, at: StateView<'_, S>, arms: &[Vec2<S>], loads: &[Wrench<S>]) {
        let n = at.m.bodies.len();
        self.hinges.resize(n, FreeHinge { inverse: S::zero(), couple: S::zero(), lever: S::zero() });
        self.general.resize(n, GeneralJoint { u: [[S::zero(); 3]; 3], inverse: [[S::zero(); 3]; 3], freedom: 0 });
        self.full.resize(n, ArticulatedInertia::none());
        let (arms, loads, twists, full) = (&arms[..n], &loads[..n], &at.k.twist[..n], &mut self.full[..n]);
        for i in 1..n {
            let (arm, w) = (arms[i], twists[i].w);
            let Inertia { mass, moment, turn } = Inertia::of(at, i, arm);
            let swing = arm * (-mass * w * w);
            full[i] = ArticulatedInertia {
                xx: mass,
                xy: S::zero(),
                yy: mass,
                h: moment.perp(),
                turn,
                p: swing - loads[i].f,
                pm: arm.cross(swing) - loads[i].m,
                size: turn,
            };
        }
    }
}

impl<S: Scalar> FreeHinge<S> {
    /// That of a body whose joint origin lies at `arm` and has this acceleration beside its parent; None where nothing resists.
    #[inline(always)]
    fn of(body: &ArticulatedInertia<S>, particle: bool, arm: Vec2<S>, bias: Vec2<S>) -> Option<Self> {
        if !particle && is_nothing(body.turn, body.size) {
            return None;
        }
        let inverse = if particle { S::zero() } else { S::one() / body.turn };
        Some(FreeHinge { inverse, couple: body.pm + body.h.dot(bias), lever: arm.cross(body.h) })
    }

    /// The angular acceleration of the body, for the acceleration of its parent.
    #[inline(always)]
    fn acceleration(&self, body: &ArticulatedInertia<S>, parent: Twist<S>) -> S {
        -(self.couple + body.h.dot(parent.v) + self.lever * parent.w) * self.inverse
    }
}

impl<S: Scalar> GeneralJoint<S> {
    /// That of a body; None where nothing resists.
    fn of(c: &ArticulatedInertia<S>, columns: &[Twist<S>; 3], freedom: usize) -> Option<Self> {
        let zero = S::zero();
        let u: Square<S> = std::array::from_fn(|k| if k < freedom { c.apply(columns[k]).parts() } else { [zero; 3] });
        let mut d = [[zero; 3]; 3];
        for (k, row) in d.iter_mut().enumerate().take(freedom) {
            for (j, entry) in row.iter_mut().enumerate().take(freedom) {
                *entry = dot(columns[k].parts(), u[j]);
            }
        }
        let inverse = invert(d, freedom, columns, (c.xx + c.yy, c.size))?;
        Some(GeneralJoint { u, inverse, freedom })
    }

    /// What is left of the body, whose joint origin has an acceleration beside its parent, when the joint may move along its columns.
    fn beyond(
        &self,
        c: &ArticulatedInertia<S>,
        columns: &[Twist<S>; 3],
        particle: bool,
        bias: Twist<S>,
    ) -> ArticulatedInertia<S> {
        let GeneralJoint { u, inverse, freedom } = *self;
        let start = (c.apply(bias) + c.bias()).parts();
        let applied: [S; 3] = std::array::from_fn(|k| dot(columns[k].parts(), start));
        let mut full = [[c.xx, c.xy, c.h.x], [c.xy, c.yy, c.h.y], [c.h.x, c.h.y, c.turn]];
        let mut bias = start;
        for k in 0..freedom {
            for j in 0..freedom {
                let weight = inverse[k][j];
                for (a, row) in full.iter_mut().enumerate() {
                    for (b, entry) in row.iter_mut().enumerate() {
                        *entry -= u[k][a] * weight * u[j][b];
                    }
                    bias[a] -= u[k][a] * weight * applied[j];
                }
            }
        }
        let keep = if particle { 0.0 } else { 1.0 };
        ArticulatedInertia {
            xx: full[0][0],
            xy: full[0][1],
            yy: full[1][1],
            h: vec2(full[0][2].scale(keep), full[1][2].scale(keep)),
            turn: full[2][2].scale(keep),
            p: vec2(bias[0], bias[1]),
            pm: bias[2].scale(keep),
            size: c.turn,
        }
    }

    /// The acceleration of the body where that with the joint at rest is `a`; writes the joint's own.
    fn accelerate(
        &self,
        body: &ArticulatedInertia<S>,
        columns: &[Twist<S>; 3],
        mut a: Twist<S>,
        rates: &mut [S],
    ) -> Twist<S> {
        let rest = (body.apply(a) + body.bias()).parts();
        let applied: [S; 3] = std::array::from_fn(|k| dot(columns[k].parts(), rest));
        for (k, rate) in rates.iter_mut().enumerate() {
            let share = |j: usize| self.inverse[k][j] * applied[j];
            *rate = -(1..self.freedom).fold(share(0), |sum, j| sum + share(j));
            a = a + columns[k] * *rate;
        }
        a
    }
}

#[inline(always)]
fn dot<S: Scalar>(a: [S; 3], b: [S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether an inertia is none beside one of this size.
#[inline(always)]
fn is_nothing<S: Scalar>(inertia: S, size: S) -> bool {
    inertia.value() - NO_INERTIA * size.value() <= 0.0 || inertia.value() <= 0.0
}

/// Inverse of the leading `n × n` block by Gauss–Jordan; None when a motion has no inertia.
fn invert<S: Scalar>(d: Square<S>, n: usize, columns: &[Twist<S>; 3], (mass, turn): (S, S)) -> Option<Square<S>> {
    let (mut a, mut inverse) = (d, [[S::zero(); 3]; 3]);
    for (k, row) in inverse.iter_mut().enumerate() {
        row[k] = S::one();
    }
    for k in 0..n {
        let size = columns[k].v.dot(columns[k].v) * mass + columns[k].w * columns[k].w * turn;
        if is_nothing(a[k][k], size) {
            return None;
        }
        let pivot = S::one() / a[k][k];
        for j in 0..n {
            a[k][j] = a[k][j] * pivot;
            inverse[k][j] = inverse[k][j] * pivot;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i][k];
            for j in 0..n {
                let (taken, undone) = (factor * a[k][j], factor * inverse[k][j]);
                a[i][j] -= taken;
                inverse[i][j] -= undone;
            }
        }
    }
    Some(inverse)
}
