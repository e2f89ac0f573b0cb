//! What every joint does to its bodies.

use super::rows::{joint_tangent, Row, Source};
use super::{constraint_rows, joint_place, residual, SolvedView, Workspace};
use crate::kinematics::{relative, JointView, StateView};
use crate::mechanism::{DriveKind, FrictionSource, Mechanism};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::Scalar;
use crate::solve::{Matrix, Orthogonal};

/// The reaction of a joint on its second body: force in fixed axes and couple about the joint's point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLoad<S = f64> {
    /// The joint's point, fixed axes.
    pub point: Vec2<S>,
    /// Force on the second body, N.
    pub force: Vec2<S>,
    /// Couple on the second body about the point, N·m; a plain 0 where the joint passes none.
    pub couple: S,
    /// Unit vector along the first body's line, or along its curve at the contact, fixed axes.
    pub tangent: Vec2<S>,
    /// From the first body's marker to the joint's point, fixed axes.
    pub span: Vec2<S>,
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
                DriveKind::Coupling | DriveKind::Hold => format!("joints.{}", self.name(m)),
                DriveKind::Lock => "events".to_string(),
            },
            Source::Joint(..) => format!("joints.{}", self.name(m)),
        }
    }
}

/// A load at a body's joint origin, expressed about another place.
fn about<S: Scalar>(at: StateView<'_, S>, body: usize, load: Wrench<S>, place: Vec2<S>) -> Wrench<S> {
    load.seen_from(at.k.pose[body].at - place)
}

impl<S: Scalar> JointLoad<S> {
    /// The load on the second body at its joint origin.
    fn at_joint_origin(&self, at: StateView<'_, S>, body: usize) -> Wrench<S> {
        Wrench { f: self.force, m: self.couple }.seen_from(self.point - at.k.pose[body].at)
    }
    /// The pull along the line to the joint's point: positive when it draws the second body towards the first, N.
    pub fn tension(&self) -> S {
        -self.force.dot(self.span) / self.span.norm()
    }
    /// The force along the first body's line or curve, and across it to its left.
    pub fn in_joint_axes(&self) -> Vec2<S> {
        vec2(self.tangent.dot(self.force), self.tangent.cross(self.force))
    }
}

impl<S: Scalar> SolvedView<'_, S> {
    /// The reaction of a joint, with where it acts.
    pub fn joint_load(&self, index: usize) -> JointLoad<S> {
        let at = self.at;
        let joint = &at.m.joints[index];
        let (axes, place) = relative(joint, at.m, &at);
        let point = joint_place(at, index);
        let Wrench { f: force, m: couple } = self.reaction(index, point);
        let tangent = axes.turn.apply(joint_tangent(at, index));
        let span = axes.turn.apply(JointView::new(at.m, at.n, joint, |x| x).contact(&place));
        JointLoad { point, force, couple, tangent, span }
    }

    /// The reaction of a joint on its second body about the joint's `point`: in the tree from the load passed, else from the multipliers.
    pub fn reaction(&self, index: usize, point: Vec2<S>) -> Wrench<S> {
        let at = self.at;
        let joint = &at.m.joints[index];
        let [first, second] = at.m.ends(joint);
        let load = match joint.child {
            Some(child) if child == second => about(at, child, self.joint_wrenches[child], point),
            Some(child) => -about(at, child, self.joint_wrenches[child], point),
            None => {
                let mut load = Wrench::zero();
                let on_body = if second > 0 { second } else { first };
                let sign = if second > 0 { 1.0 } else { -1.0 };
                let own = |row: &Row<S>| matches!(row.source, Source::Joint(j, _) if j == index);
                for (row, l) in self.multipliers().filter(|(row, _)| own(row)) {
                    let on = row.motion.iter().find(|(body, _)| *body == on_body).map_or(Wrench::zero(), |(_, w)| *w);
                    load += on * l.scale(sign);
                }
                about(at, on_body, load, point)
            }
        };
        Wrench { f: load.f, m: if joint.couple { load.m } else { S::zero() } }
    }

    /// The reaction of every joint.
    pub fn joint_loads(&self) -> Vec<JointLoad<S>> {
        (0..self.at.m.joints.len()).map(|joint| self.joint_load(joint)).collect()
    }

    /// The multipliers of a joint's own rows that add up to its reaction, by least squares over their values; what
    /// these leave is taken up once more, so that derivatives are exact.
    pub fn row_loads(&self, joint: usize) -> Vec<S> {
        let at = self.at;
        let [first, second] = at.m.ends(&at.m.joints[joint]);
        let on = |body: usize| self.joint_load(joint).at_joint_origin(at, body);
        // The ground has no balance.
        let (body, load) = if second > 0 { (second, on(second)) } else { (first, -on(first)) };
        let load = load.parts();
        let mut rows = vec![];
        constraint_rows(at, joint, &mut rows);
        let zero = [S::zero(); 3];
        let of_body = |row: &Row<S>| row.motion.iter().find(|(b, _)| *b == body).map_or(zero, |(_, w)| w.parts());
        let columns: Vec<[S; 3]> = rows.iter().map(of_body).collect();
        let unit = [1.0, 1.0, 1.0 / self.length];
        let g = Matrix::from_fn(3, rows.len(), |i, j| columns[j][i].value() * unit[i]);
        let factored = Orthogonal::factor(&g);
        let mut multipliers = vec![S::zero(); rows.len()];
        for _ in 0..2 {
            let mut left = load;
            for (column, &multiplier) in columns.iter().zip(&multipliers) {
                left.iter_mut().zip(column).for_each(|(left, &part)| *left -= part * multiplier);
            }
            for i in 0..3 {
                let (mut side, mut response) = ([0.0; 3], vec![0.0; rows.len()]);
                side[i] = unit[i];
                factored.add_solution(&side, &mut response);
                multipliers.iter_mut().zip(response).for_each(|(sum, r)| *sum += left[i].scale(r));
            }
        }
        multipliers
    }

    /// The rows with their multipliers.
    pub(super) fn multipliers(&self) -> impl Iterator<Item = (&Row<S>, S)> {
        self.rows.iter().zip(self.lambda.iter().copied())
    }

    /// Force or torque of each drive: its multiplier; 0 where it is not in place.
    pub fn drive_forces(&self) -> Vec<S> {
        let mut forces = vec![S::zero(); self.at.m.drives.len()];
        for (row, lambda) in self.multipliers() {
            if let Source::Drive(drive) = row.source {
                forces[drive] = lambda;
            }
        }
        forces
    }

    /// Power of each motion, W; couplings and locks have none.
    pub fn drive_powers(&self) -> Vec<S> {
        self.drive_powers_of(|body| self.at.k.twist[body])
    }

    /// Power of one motion, W; 0 where it is not in place.
    pub fn drive_power(&self, drive: usize) -> S {
        let found = self.multipliers().find(|(row, _)| row.source == Source::Drive(drive));
        found.map_or(S::zero(), |(row, lambda)| {
            lambda * row.loads().iter().fold(S::zero(), |sum, (body, w)| sum + w.power(self.at.k.twist[*body]))
        })
    }

    /// Power of each motion by velocities; its work, by impulses.
    pub(super) fn drive_powers_of(&self, twist: impl Fn(usize) -> Twist<S>) -> Vec<S> {
        let mut powers = vec![S::zero(); self.at.m.drives.len()];
        for (row, lambda) in self.multipliers() {
            let Source::Drive(drive) = row.source else { continue };
            if self.at.m.drives[drive].is_motion() {
                let rate = row.loads().iter().fold(S::zero(), |sum, (body, w)| sum + w.power(twist(*body)));
                powers[drive] = lambda * rate;
            }
        }
        powers
    }
}

impl Workspace<'_> {
    /// What is left of the momentum balance of each body in the last solution, with what every joint can pass: N, N,
    /// N·m at its mass centre.
    pub fn residuals(&self) -> Vec<[f64; 3]> {
        let at = self.at();
        let (mut rows, mut multipliers) = (self.rows.clone(), self.solved.lambda.clone());
        for (index, _) in at.joints().filter(|(_, joint)| joint.child.is_some() && !joint.rows.is_empty()) {
            constraint_rows(at, index, &mut rows);
            multipliers.extend(self.solved_view().row_loads(index));
        }
        let left = residual(at, &self.loads, &self.solved.bodies, &rows, &multipliers);
        let at_centre = |i: usize| {
            let w = left[i].seen_from(-self.arms[i]);
            [w.f.x, w.f.y, if self.m.bodies[i].particle { 0.0 } else { w.m }]
        };
        (1..left.len()).map(at_centre).collect()
    }
}
