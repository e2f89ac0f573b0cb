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

/// Relative size below which an inertia is none.
const NO_INERTIA: f64 = 1e-13;

/// What a body and all that hangs on it resist, at its joint origin: the load needed for an acceleration a is
/// A a + p, A = [xx xy x; xy yy y; x y turn].
#[derive(Clone, Copy, Debug, Default)]
struct ArticulatedInertia {
    xx: f64,
    xy: f64,
    yy: f64,
    /// Coupling of force and angular acceleration.
    h: Vec2,
    turn: f64,
    p: Vec2,
    pm: f64,
    /// The inertia there would be if nothing cancelled: the measure of what is nothing.
    size: f64,
}

type Square = [[f64; 3]; 3];

/// Memory of the sweep.
#[derive(Clone, Debug, Default)]
pub struct ArticulatedBody {
    full: Vec<ArticulatedInertia>,
    /// 1 / turn of plain hinges: on the way back each acceleration waits for the one before, and not for a division.
    inverse_inertia: Vec<f64>,
    /// U = A S and (SᵀAS)⁻¹ of joints that are no plain hinges.
    general: Vec<(Square, Square)>,
}

impl ArticulatedInertia {
    #[inline(always)]
    fn apply(&self, a: Twist) -> Wrench {
        Wrench {
            f: vec2(
                self.xx * a.v.x + self.xy * a.v.y + self.h.x * a.w,
                self.xy * a.v.x + self.yy * a.v.y + self.h.y * a.w,
            ),
            m: self.h.dot(a.v) + self.turn * a.w,
        }
    }
    #[inline(always)]
    fn bias(&self) -> Wrench {
        Wrench { f: self.p, m: self.pm }
    }
    /// Adds what a child resists at its joint origin, which lies at `arm`.
    #[inline(always)]
    fn add_child(&mut self, c: &ArticulatedInertia, arm: Vec2) {
        let r = arm.perp();
        let mr = vec2(c.xx * r.x + c.xy * r.y, c.xy * r.x + c.yy * r.y);
        self.xx += c.xx;
        self.xy += c.xy;
        self.yy += c.yy;
        self.h += mr + c.h;
        self.turn += r.dot(mr) + 2.0 * r.dot(c.h) + c.turn;
        self.p += c.p;
        self.pm += arm.cross(c.p) + c.pm;
        self.size += c.size + (c.xx + c.yy) * r.dot(r);
    }
}

impl ArticulatedBody {
    /// Joint accelerations `nu_dot`, accelerations of the joint origins and the load that each body's joint puts
    /// on it at its joint origin.
    ///
    /// # Errors
    /// A joint that nothing resists, by the name of its body.
    pub fn solve(
        &mut self,
        at: StateView<'_>,
        arms: &[Vec2],
        loads: &[Wrench],
        nu_dot: &mut [f64],
        bodies: &mut [Twist],
        joint_wrenches: &mut [Wrench],
    ) -> Result<(), DynamicsError> {
        self.start_bodies(at, arms, loads);
        for i in (1..at.m.bodies.len()).rev() {
            let tree_joint = at.m.bodies[i].tree_joint.expect("every body hangs in the tree");
            let rest = if tree_joint.hinge {
                self.eliminate_hinge(at, i)?
            } else {
                self.eliminate_joint(at, i, tree_joint.freedom)?
            };
            self.full[tree_joint.parent].add_child(&rest, at.k.arm[i]);
        }
        bodies[0] = Twist::zero();
        for i in 1..at.m.bodies.len() {
            let body = &at.m.bodies[i];
            let tree_joint = body.tree_joint.expect("every body hangs in the tree");
            let (base, bias) = (bodies[tree_joint.parent], at.k.bias_acceleration[i]);
            let mut a =
                Twist { v: base.at(at.k.arm[i]) + bias.v, w: if body.particle { 0.0 } else { base.w + bias.w } };
            if tree_joint.hinge && !body.particle {
                let full = &self.full[i];
                let alpha = -(full.pm + full.h.dot(a.v)) * self.inverse_inertia[i];
                let sense = if tree_joint.reversed { -1.0 } else { 1.0 };
                nu_dot[tree_joint.start] = (alpha - a.w) * sense;
                a.w = alpha;
            } else if tree_joint.freedom > 0 {
                let rest = (self.full[i].apply(a) + self.full[i].bias()).parts();
                let (_, inverse) = &self.general[i];
                let columns = &at.k.motion_subspace[i];
                let applied: [f64; 3] = std::array::from_fn(|k| dot(columns[k].parts(), rest));
                for k in 0..tree_joint.freedom {
                    let rate = -(0..tree_joint.freedom).map(|j| inverse[k][j] * applied[j]).sum::<f64>();
                    nu_dot[tree_joint.start + k] = rate;
                    a = a + columns[k] * rate;
                }
            }
            bodies[i] = a;
            joint_wrenches[i] = self.full[i].apply(a) + self.full[i].bias();
        }
        Ok(())
    }

    /// Every body alone.
    fn start_bodies(&mut self, at: StateView<'_>, arms: &[Vec2], loads: &[Wrench]) {
        let n = at.m.bodies.len();
        self.full.resize(n, ArticulatedInertia::default());
        self.inverse_inertia.resize(n, 0.0);
        self.general.resize(n, Default::default());
        for i in 0..n {
            let (arm, w) = (arms[i], at.k.twist[i].w);
            let Inertia { mass, moment, turn } = Inertia::of(at, i, arm);
            let swing = arm * (-mass * w * w);
            self.full[i] = ArticulatedInertia {
                xx: mass,
                xy: 0.0,
                yy: mass,
                h: moment.perp(),
                turn,
                p: swing - loads[i].f,
                pm: arm.cross(swing) - loads[i].m,
                size: turn,
            };
        }
    }

    /// What is left of body `i` when it may turn about its joint origin.
    #[inline]
    fn eliminate_hinge(&mut self, at: StateView<'_>, i: usize) -> Result<ArticulatedInertia, DynamicsError> {
        let c = &self.full[i];
        let only_force = ArticulatedInertia { h: Vec2::zero(), turn: 0.0, pm: 0.0, size: 0.0, ..*c };
        if at.m.bodies[i].particle {
            return Ok(shift_bias(only_force, at, i));
        }
        if c.turn <= NO_INERTIA * c.size || c.turn <= 0.0 {
            return Err(DynamicsError::singular_inertia(at.m, i));
        }
        let (h, inverse) = (c.h, 1.0 / c.turn);
        self.inverse_inertia[i] = inverse;
        let rest = ArticulatedInertia {
            xx: c.xx - h.x * h.x * inverse,
            xy: c.xy - h.x * h.y * inverse,
            yy: c.yy - h.y * h.y * inverse,
            p: c.p - h * (c.pm * inverse),
            ..only_force
        };
        Ok(shift_bias(rest, at, i))
    }

    /// What is left of body `i` when its joint may move along its columns.
    fn eliminate_joint(
        &mut self,
        at: StateView<'_>,
        i: usize,
        freedom: usize,
    ) -> Result<ArticulatedInertia, DynamicsError> {
        let c = self.full[i];
        let columns = &at.k.motion_subspace[i];
        let u: [[f64; 3]; 3] =
            std::array::from_fn(|k| if k < freedom { c.apply(columns[k]).parts() } else { [0.0; 3] });
        let mut d = [[0.0; 3]; 3];
        for (k, row) in d.iter_mut().enumerate().take(freedom) {
            for (j, entry) in row.iter_mut().enumerate().take(freedom) {
                *entry = dot(columns[k].parts(), u[j]);
            }
        }
        let scale = (c.xx + c.yy, c.size);
        let inverse = invert(d, freedom, columns, scale).ok_or_else(|| DynamicsError::singular_inertia(at.m, i))?;
        self.general[i] = (u, inverse);
        let start = (c.apply(at.k.bias_acceleration[i]) + c.bias()).parts();
        let applied: [f64; 3] = std::array::from_fn(|k| dot(columns[k].parts(), start));
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
        let particle = at.m.bodies[i].particle;
        let keep = if particle { 0.0 } else { 1.0 };
        Ok(ArticulatedInertia {
            xx: full[0][0],
            xy: full[0][1],
            yy: full[1][1],
            h: vec2(full[0][2], full[1][2]) * keep,
            turn: full[2][2] * keep,
            p: vec2(bias[0], bias[1]),
            pm: bias[2] * keep,
            size: c.turn.abs(),
        })
    }
}

/// The bias of a freed hinge, that of its joint origin included.
#[inline(always)]
fn shift_bias(rest: ArticulatedInertia, at: StateView<'_>, i: usize) -> ArticulatedInertia {
    let bias = at.k.bias_acceleration[i].v;
    let moved = vec2(rest.xx * bias.x + rest.xy * bias.y, rest.xy * bias.x + rest.yy * bias.y);
    ArticulatedInertia { p: rest.p + moved, ..rest }
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Inverse of the leading `n × n` block by Gauss–Jordan; None when a motion has no inertia.
fn invert(d: Square, n: usize, columns: &[Twist; 3], (mass, turn): (f64, f64)) -> Option<Square> {
    let (mut a, mut inverse) = (d, [[0.0; 3]; 3]);
    for (k, row) in inverse.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    for k in 0..n {
        let size = columns[k].v.dot(columns[k].v) * mass + columns[k].w * columns[k].w * turn;
        if a[k][k] <= NO_INERTIA * size || a[k][k] <= 0.0 {
            return None;
        }
        let pivot = 1.0 / a[k][k];
        for j in 0..n {
            a[k][j] *= pivot;
            inverse[k][j] *= pivot;
        }
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i][k];
            for j in 0..n {
                a[i][j] -= factor * a[k][j];
                inverse[i][j] -= factor * inverse[k][j];
            }
        }
    }
    Some(inverse)
}
