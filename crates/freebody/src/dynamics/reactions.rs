//! What every joint does to its bodies.

use super::rows::{Row, Source};
use super::{constraint_rows, joint_place, residual, Workspace};
use crate::kinematics::{relative, StateView};
use crate::mechanism::{DriveKind, FrictionSource, Mechanism};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::real;
use crate::solve::{Matrix, Orthogonal};

/// The reaction of a joint on its second body: force in fixed axes and couple about the joint's point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLoad {
    /// The joint's point, fixed axes.
    pub point: Vec2,
    /// Force on the second body, N.
    pub force: Vec2,
    /// Couple on the second body about the point, N·m; a plain 0 where the joint passes none.
    pub couple: f64,
    /// Direction of the first body's marker, rad.
    pub axes: f64,
    /// From the first body's marker to the second's, fixed axes.
    pub span: Vec2,
}

impl Source {
    /// The name of the joint, motion, contact, stop or string.
    pub fn name(self, m: &Mechanism) -> &str {
        match self {
            Source::Joint(joint, _) => &m.joints[joint].name,
            Source::Drive(drive) => &m.drives[drive].name,
            Source::JointFriction(friction) => match m.joint_friction[friction].of {
                FrictionSource::Joint { joint, .. } => &m.joints[joint].name,
                FrictionSource::Unilateral(constraint) => Source::Gap(constraint).name(m),
            },
            Source::Gap(constraint) | Source::Friction(constraint) => &m.groups[m.unilateral[constraint].group].name,
        }
    }
    /// Where it stands in the model, e.g. `joints.pivot`.
    pub fn path(self, m: &Mechanism) -> String {
        match self {
            Source::Gap(constraint) | Source::Friction(constraint) => m.groups[m.unilateral[constraint].group].path(),
            Source::JointFriction(friction) => match m.joint_friction[friction].of {
                FrictionSource::Unilateral(constraint) => Source::Gap(constraint).path(m),
                FrictionSource::Joint { joint, .. } => Source::Joint(joint, 0).path(m),
            },
            Source::Drive(drive) => match m.drives[drive].kind {
                DriveKind::Motion => format!("motions.{}", self.name(m)),
                DriveKind::Coupling => format!("joints.{}", self.name(m)),
                DriveKind::Lock => "events".to_string(),
            },
            Source::Joint(..) => format!("joints.{}", self.name(m)),
        }
    }
}

/// The reaction of joint `index`: in the tree from the load passed, else from the multipliers.
fn joint_load(at: StateView<'_>, index: usize, joint_wrenches: &[Wrench], rows: &[Row], lambda: &[f64]) -> JointLoad {
    let joint = &at.m.joints[index];
    let (axes, place) = relative(joint, at.m, &at);
    let point = joint_place(at, index);
    let [first, second] = at.m.ends(joint);
    let load = match joint.child {
        Some(child) if child == second => about(at, child, joint_wrenches[child], point),
        Some(child) => -about(at, child, joint_wrenches[child], point),
        None => {
            let mut load = Wrench::zero();
            let on_body = if second > 0 { second } else { first };
            let sign = if second > 0 { 1.0 } else { -1.0 };
            for (row, &l) in
                rows.iter().zip(lambda).filter(|(r, _)| matches!(r.source, Source::Joint(j, _) if j == index))
            {
                let on = row.motion.iter().find(|(body, _)| *body == on_body).map_or(Wrench::zero(), |(_, w)| *w);
                load += on * (l * sign);
            }
            about(at, on_body, load, point)
        }
    };
    let couple = if joint.couple { load.m } else { 0.0 };
    JointLoad { point, force: load.f, couple, axes: axes.turn.angle, span: axes.turn.apply(place.at()) }
}

/// A load at a body's joint origin, expressed about another place.
fn about(at: StateView<'_>, body: usize, load: Wrench, place: Vec2) -> Wrench {
    load.seen_from(at.k.pose[body].at - place)
}

impl JointLoad {
    /// The load on the second body at its joint origin.
    fn at_joint_origin(&self, at: StateView<'_>, body: usize) -> Wrench {
        Wrench { f: self.force, m: self.couple }.seen_from(self.point - at.k.pose[body].at)
    }
    /// The pull along the line of the two markers: positive when it draws the second towards the first, N.
    pub fn tension(&self) -> f64 {
        -self.force.dot(self.span) / self.span.norm()
    }
    /// The force along and across the first body's marker.
    pub fn in_joint_axes(&self) -> Vec2 {
        let (sin, cos) = real::sin_cos(self.axes);
        vec2(cos * self.force.x + sin * self.force.y, cos * self.force.y - sin * self.force.x)
    }
}

impl Workspace<'_> {
    /// The reaction of a joint in the last solution.
    pub(super) fn joint_load(&self, joint: usize) -> JointLoad {
        joint_load(self.at(), joint, &self.solved.joint_wrenches, &self.rows, &self.solved.lambda)
    }

    /// The reaction of every joint in the last solution.
    pub fn joint_loads(&self) -> Vec<JointLoad> {
        self.joint_loads_of(&self.solved.joint_wrenches, &self.solved.lambda)
    }

    /// The reaction of every joint by the loads passed in the tree and the multipliers of the present rows.
    pub(super) fn joint_loads_of(&self, joint_wrenches: &[Wrench], lambda: &[f64]) -> Vec<JointLoad> {
        (0..self.m.joints.len()).map(|j| joint_load(self.at(), j, joint_wrenches, &self.rows, lambda)).collect()
    }

    /// The multipliers of a joint's own rows that add up to its reaction in the last solution.
    pub fn row_loads(&self, joint: usize) -> Vec<f64> {
        let at = self.at();
        let load = self.joint_load(joint);
        let second = at.m.ends(&at.m.joints[joint])[1];
        let on_second = load.at_joint_origin(at, second).parts();
        let mut rows = vec![];
        constraint_rows(at, joint, &mut rows);
        let of_second = |row: &Row| row.motion.iter().find(|(b, _)| *b == second).map_or([0.0; 3], |(_, w)| w.parts());
        let unit = [1.0, 1.0, 1.0 / self.length];
        let g = Matrix::from_fn(3, rows.len(), |i, j| of_second(&rows[j])[i] * unit[i]);
        let side: Vec<f64> = on_second.iter().zip(unit).map(|(w, u)| w * u).collect();
        let mut multipliers = vec![0.0; rows.len()];
        Orthogonal::factor(&g).add_solution(&side, &mut multipliers);
        multipliers
    }

    /// Force or torque of each drive in the last solution.
    pub fn drive_forces(&self) -> Vec<f64> {
        self.of_drives(&self.solved.lambda)
    }

    /// The multiplier of each drive among those of the present rows; 0 where it is not in place.
    pub(super) fn of_drives(&self, lambda: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; self.m.drives.len()];
        for (row, &lambda) in self.rows.iter().zip(lambda) {
            if let Source::Drive(drive) = row.source {
                forces[drive] = lambda;
            }
        }
        forces
    }

    /// Power of each drive in the last solution, W.
    pub fn drive_powers(&self) -> Vec<f64> {
        self.drive_powers_of(&self.solved.lambda, |body| self.k.twist[body])
    }

    /// Power of each motion by multipliers and velocities; its work, by impulses. Couplings and locks have none.
    pub(super) fn drive_powers_of(&self, lambda: &[f64], twist: impl Fn(usize) -> Twist) -> Vec<f64> {
        let mut powers = vec![0.0; self.m.drives.len()];
        for (row, &lambda) in self.rows.iter().zip(lambda) {
            let Source::Drive(drive) = row.source else { continue };
            if self.m.drives[drive].is_motion() {
                let rate: f64 = row.loads().iter().map(|(body, w)| w.power(twist(*body))).sum();
                powers[drive] = lambda * rate;
            }
        }
        powers
    }

    /// What is left of the momentum balance of each body in the last solution, with what every joint can pass: N, N,
    /// N·m at its mass centre.
    pub fn residuals(&self) -> Vec<[f64; 3]> {
        let at = self.at();
        let (mut rows, mut multipliers) = (self.rows.clone(), self.solved.lambda.clone());
        for (index, _) in at.joints().filter(|(_, joint)| joint.child.is_some() && !joint.rows.is_empty()) {
            constraint_rows(at, index, &mut rows);
            multipliers.extend(self.row_loads(index));
        }
        let left = residual(at, &self.loads, &self.solved.bodies, &rows, &multipliers);
        let at_centre = |i: usize| {
            let w = left[i].seen_from(-self.arms[i]);
            [w.f.x, w.f.y, if self.m.bodies[i].particle { 0.0 } else { w.m }]
        };
        (1..left.len()).map(at_centre).collect()
    }
}
