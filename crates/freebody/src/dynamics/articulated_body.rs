//! The articulated-body algorithm: accelerations and all reactions of a tree in one pass towards ground and one back.
//!
//! Featherstone's articulated-body algorithm (*Rigid Body Dynamics Algorithms*, ch. 7) in the plane, about the joint
//! origins: towards ground, each body tells its parent how it would resist (mass `A`, bias `p`) once its joint's
//! freedom is eliminated; back, each joint's acceleration and the load that it passes follow. Lever arms are relative
//! vectors, so nothing is lost far from the origin.

use super::momentum::Inertia;
use super::DynamicsError;
use crate::kinematics::StateView;
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

type Square<S> = [[S; 3]; 3];

/// Memory of the sweep.
#[derive(Clone, Debug)]
pub struct ArticulatedBody<S = f64> {
    full: Vec<ArticulatedInertia<S>>,
    /// 1 / turn of plain hinges: on the way back each acceleration waits for the one before, and not for a division.
    inverse_inertia: Vec<S>,
    /// U = A S and (SᵀAS)⁻¹ of joints that are no plain hinges.
    general: Vec<(Square<S>, Square<S>)>,
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
    /// Adds what a child resists at its joint origin, which lies at `arm`.
    #[inline(always)]
    fn add_child(&mut self, c: &ArticulatedInertia<S>, arm: Vec2<S>) {
        let r = arm.perp();
        let mr = vec2(c.xx * r.x + c.xy * r.y, c.xy * r.x + c.yy * r.y);
        self.xx += c.xx;
        self.xy += c.xy;
        self.yy += c.yy;
        self.h += mr + c.h;
        self.turn += r.dot(mr) + r.dot(c.h).scale(2.0) + c.turn;
        self.p += c.p;
        self.pm += arm.cross(c.p) + c.pm;
        self.size += c.size + (c.xx + c.yy) * r.dot(r);
    }
}

impl<S: Scalar> ArticulatedBody<S> {
    pub fn new() -> Self {
        ArticulatedBody { full: vec![], inverse_inertia: vec![], general: vec![] }
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
        mut passed: impl FnMut(usize, Wrench<S>),
    ) -> Result<(), DynamicsError> {
        self.start_bodies(at, arms, loads);
        for i in (1..at.m.bodies.len()).rev() {
            let tree_joint = at.m.bodies[i].tree_joint.expect("every body hangs in the tree");
            if tree_joint.hinge {
                self.free_hinge(at, i)?;
            } else {
                self.free_joint(at, i, tree_joint.freedom)?;
            }
            // Ground resists whatever hangs on it.
            if tree_joint.parent > 0 {
                let rest = match tree_joint.hinge {
                    true => self.beyond_hinge(at, i),
                    false => self.beyond_joint(at, i, tree_joint.freedom),
                };
                self.full[tree_joint.parent].add_child(&rest, at.k.arm[i]);
            }
        }
        bodies[0] = Twist::zero();
        for i in 1..at.m.bodies.len() {
            let body = &at.m.bodies[i];
            let tree_joint = body.tree_joint.expect("every body hangs in the tree");
            let (base, bias) = (bodies[tree_joint.parent], at.k.bias_acceleration[i]);
            let mut a =
                Twist { v: base.at(at.k.arm[i]) + bias.v, w: if body.particle { S::zero() } else { base.w + bias.w } };
            if tree_joint.hinge && !body.particle {
                let full = &self.full[i];
                let alpha = -(full.pm + full.h.dot(a.v)) * self.inverse_inertia[i];
                let sense = if tree_joint.reversed { -1.0 } else { 1.0 };
                nu_dot[tree_joint.start] = (alpha - a.w).scale(sense);
                a.w = alpha;
            } else if tree_joint.freedom > 0 {
                let rest = (self.full[i].apply(a) + self.full[i].bias()).parts();
                let (_, inverse) = &self.general[i];
                let columns = &at.k.motion_subspace[i];
                let applied: [S; 3] = std::array::from_fn(|k| dot(columns[k].parts(), rest));
                for k in 0..tree_joint.freedom {
                    let share = |j: usize| inverse[k][j] * applied[j];
                    let rate = -(1..tree_joint.freedom).fold(share(0), |sum, j| sum + share(j));
                    nu_dot[tree_joint.start + k] = rate;
                    a = a + columns[k] * rate;
                }
            }
            bodies[i] = a;
            passed(i, self.full[i].apply(a) + self.full[i].bias());
        }
        Ok(())
    }

    /// Every body alone.
    #[inline(always)]
    fn start_bodies(&mut self, at: StateView<'_, S>, arms: &[Vec2<S>], loads: &[Wrench<S>]) {
        let n = at.m.bodies.len();
        self.inverse_inertia.resize(n, S::zero());
        self.general.resize(n, ([[S::zero(); 3]; 3], [[S::zero(); 3]; 3]));
        self.full.resize(n, ArticulatedInertia::none());
        for i in 1..n {
            let (arm, w) = (arms[i], at.k.twist[i].w);
            let Inertia { mass, moment, turn } = Inertia::of(at, i, arm);
            let swing = arm * (-mass * w * w);
            self.full[i] = ArticulatedInertia {
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

    /// Prepares a hinge to be eliminated: a body that nothing resists cannot be.
    #[inline(always)]
    fn free_hinge(&mut self, at: StateView<'_, S>, i: usize) -> Result<(), DynamicsError> {
        let c = &self.full[i];
        if at.m.bodies[i].particle {
            return Ok(());
        }
        if is_nothing(c.turn, c.size) {
            return Err(DynamicsError::singular_inertia(at.m, i));
        }
        self.inverse_inertia[i] = S::one() / c.turn;
        Ok(())
    }

    /// What is left of body `i` when it may turn about its joint origin.
    #[inline(always)]
    fn beyond_hinge(&self, at: StateView<'_, S>, i: usize) -> ArticulatedInertia<S> {
        let c = &self.full[i];
        let only_force = ArticulatedInertia { xx: c.xx, xy: c.xy, yy: c.yy, p: c.p, ..ArticulatedInertia::none() };
        if at.m.bodies[i].particle {
            return shift_bias(only_force, at, i);
        }
        let (h, inverse) = (c.h, self.inverse_inertia[i]);
        let rest = ArticulatedInertia {
            xx: c.xx - h.x * h.x * inverse,
            xy: c.xy - h.x * h.y * inverse,
            yy: c.yy - h.y * h.y * inverse,
            p: c.p - h * (c.pm * inverse),
            ..only_force
        };
        shift_bias(rest, at, i)
    }

    /// Prepares a joint that moves along its columns to be eliminated.
    fn free_joint(&mut self, at: StateView<'_, S>, i: usize, freedom: usize) -> Result<(), DynamicsError> {
        let (c, columns, zero) = (&self.full[i], &at.k.motion_subspace[i], S::zero());
        let u: Square<S> = std::array::from_fn(|k| if k < freedom { c.apply(columns[k]).parts() } else { [zero; 3] });
        let mut d = [[zero; 3]; 3];
        for (k, row) in d.iter_mut().enumerate().take(freedom) {
            for (j, entry) in row.iter_mut().enumerate().take(freedom) {
                *entry = dot(columns[k].parts(), u[j]);
            }
        }
        let scale = (c.xx + c.yy, c.size);
        let inverse = invert(d, freedom, columns, scale).ok_or_else(|| DynamicsError::singular_inertia(at.m, i))?;
        self.general[i] = (u, inverse);
        Ok(())
    }

    /// What is left of body `i` when its joint may move along its columns.
    fn beyond_joint(&self, at: StateView<'_, S>, i: usize, freedom: usize) -> ArticulatedInertia<S> {
        let (c, columns, (u, inverse)) = (&self.full[i], &at.k.motion_subspace[i], &self.general[i]);
        let start = (c.apply(at.k.bias_acceleration[i]) + c.bias()).parts();
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
        let keep = if at.m.bodies[i].particle { 0.0 } else { 1.0 };
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
}

/// The bias of a freed hinge, that of its joint origin included.
#[inline(always)]
fn shift_bias<S: Scalar>(rest: ArticulatedInertia<S>, at: StateView<'_, S>, i: usize) -> ArticulatedInertia<S> {
    let bias = at.k.bias_acceleration[i].v;
    let moved = vec2(rest.xx * bias.x + rest.xy * bias.y, rest.xy * bias.x + rest.yy * bias.y);
    ArticulatedInertia { p: rest.p + moved, ..rest }
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
