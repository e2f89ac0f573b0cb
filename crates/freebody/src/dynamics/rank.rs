//! Degrees of freedom, redundant constraints, and which reactions statics and dynamics determine.
//!
//! A reaction component is determinate if and only if no self-stress, a set of multipliers that loads no motion
//! (Bᵀλ = 0), touches it (Wojtyra 2005, *Joint reaction forces in multibody systems with redundant constraints*).

use super::contact_modes::{force_on_first, REST};
use super::minimal::{joint_wrenches, Force};
use super::rows::closing_rows;
use super::tree_matrices::{gradients, row_scales};
use super::{Route, Row, SolvedView, Source, Workspace};
use crate::kinematics::StateView;
use crate::mechanism::{DriveKind, Mechanism, Part};
use crate::mode::{ContactMode, Mode};
use crate::plane::Wrench;
use crate::solve::{Matrix, Orthogonal};

/// Relative size below which a self-stress does not touch a component.
const UNTOUCHED: f64 = 1e-9;

/// How far a configuration nearby is, in radians and characteristic lengths: a singular one is well behind, no loop opens.
const NEARBY: f64 = 1e-2;

/// Coordinates up to which ranks are decided anew at every state.
const FEW_COORDINATES: usize = 60;

/// What is determinate.
#[derive(Clone, Debug)]
pub struct Determinacy {
    /// Of each joint (Fx, Fy, M).
    pub joints: Vec<[bool; 3]>,
    /// Of each drive its force.
    pub drives: Vec<bool>,
    /// Of each contact, stop and string the force on its first body (Fx, Fy), its normal force and its friction.
    pub groups: Vec<[bool; 4]>,
}

/// Degrees of freedom at a configuration, expressed in several ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedom {
    /// Coordinates of all bodies less the rows of all joints (Grübler's formula); motions not counted.
    pub count: i64,
    /// True degrees of freedom at this configuration.
    pub here: usize,
    /// Rows of all joints and couplings.
    pub rows: usize,
    /// Rows that say nothing new at this configuration.
    pub redundant: usize,
    /// Rows that say nothing new anywhere nearby either: redundant for good, not only in a singular configuration.
    pub always_redundant: usize,
    /// Prescribed motions.
    pub driven: usize,
    /// Whether the rank was too close to call.
    pub uncertain: bool,
}

/// A way in which joints can load each other without moving anything.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfStress {
    /// Of each joint: force and couple on the second body at its point, fixed axes, in any common unit.
    pub joints: Vec<[f64; 3]>,
    /// Of each drive: its force.
    pub drives: Vec<f64>,
    /// Of each contact, stop and string: force on its first body, fixed axes, along its gaps and along its slides.
    pub groups: Vec<[f64; 4]>,
}

/// What Grübler's formula counts of the parts in place.
#[derive(Clone, Copy, Debug)]
pub struct Count {
    /// Coordinates of all bodies.
    pub bodies: usize,
    /// Rows of joints and couplings.
    pub rows: usize,
    /// Prescribed motions.
    pub driven: usize,
}

impl Count {
    /// That of a mechanism in a mode.
    pub fn of(m: &Mechanism, mode: &Mode) -> Self {
        let joints = m.listed_joints().filter(|&j| mode.has(m.part_of(j)));
        let drives = (0..m.drives.len()).filter(|&d| m.drives[d].kind != DriveKind::Hold && mode.has(Part::Drive(d)));
        let (motions, couplings): (Vec<usize>, Vec<usize>) = drives.partition(|&d| m.drives[d].is_motion());
        Count {
            bodies: m.listed_bodies().iter().map(|&b| if m.bodies[b].particle { 2 } else { 3 }).sum(),
            rows: joints.map(|j| m.joints[j].rows.len()).sum::<usize>() + couplings.len(),
            driven: motions.len(),
        }
    }
}

fn degrees(number: usize) -> String {
    if number == 1 {
        "1 degree".into()
    } else {
        format!("{number} degrees")
    }
}

impl Freedom {
    /// Why the count and the true number differ, or that they agree.
    pub fn explain(&self) -> String {
        let (count, here) = (self.count, self.here);
        let mut text = match (self.redundant, here as i64 - count) {
            (0, 0) => format!("{} of freedom, as many as Grübler's count", degrees(here)),
            (r, _) => {
                let singular = r - self.always_redundant.min(r);
                let mut why = vec![];
                if self.always_redundant > 0 {
                    let are = if self.always_redundant == 1 { "is" } else { "are" };
                    why.push(format!("{} of the {} constraints {are} redundant", self.always_redundant, self.rows));
                }
                if singular > 0 {
                    let are = if singular == 1 { "is" } else { "are" };
                    why.push(format!(
                        "{singular} of the {} constraints {are} dependent in this configuration, which is singular",
                        self.rows
                    ));
                }
                format!("{} of freedom (Grübler's count: {count}): {}", degrees(here), why.join("; "))
            }
        };
        if self.driven > 0 {
            text += &format!("; {} prescribed by motions", self.driven);
        }
        if self.uncertain {
            text += "; the rank is too close to call: the mechanism is near a singular configuration";
        }
        text
    }
}

impl Workspace<'_> {
    /// Degrees of freedom at the present state, and whether constraints that are redundant here are so nearby.
    pub fn freedom(&mut self) -> Freedom {
        let Count { bodies, rows, driven } = Count::of(self.m, self.mode());
        let (rank, uncertain) = self.closing_rank();
        let closing = self.geometric().len();
        let redundant = closing - rank;
        let always_redundant = if redundant == 0 { 0 } else { closing - self.nearby_rank(rank) };
        Freedom {
            count: bodies as i64 - rows as i64,
            here: self.m.freedom() - rank,
            rows,
            redundant,
            always_redundant,
            driven,
            uncertain,
        }
    }

    /// The largest rank at a few configurations nearby, reached by motions that the loops allow.
    fn nearby_rank(&mut self, here: usize) -> usize {
        let mode = self.mode().clone();
        let (t, q, u) = (self.placed.t, self.placed.q.clone(), self.placed.u.clone());
        self.rows = self.geometric();
        // A factorisation that fails for want of inertia has still found the motions.
        let _ = self.factor(Force::Gradient);
        let motions = self.dense.saddle.motions();
        let zero = vec![0.0; u.len()];
        let mut most = here;
        for k in 0..motions.cols() {
            let along: Vec<f64> = (0..q.len()).map(|i| NEARBY * motions[(i, k)]).collect();
            let mut step = zero.clone();
            self.move_to(t, &q, &u);
            self.to_user(&along, &mut step);
            let mut near: Vec<f64> = q.iter().zip(&step).map(|(q, d)| q + d).collect();
            if self.project_positions(&mode, t, &mut near, &zero).is_ok() {
                most = most.max(self.closing_rank().0);
            }
        }
        self.move_to(t, &q, &u);
        most
    }

    /// The rows that close loops, motions and unilateral constraints left out.
    fn geometric(&self) -> Vec<Row> {
        let closes = |s: Source| match s {
            Source::Joint(..) => true,
            Source::Drive(d) => !self.m.drives[d].is_motion(),
            Source::Gap(_) | Source::Friction(_) | Source::JointFriction(_) => false,
        };
        closing_rows(self.at(), None).into_iter().filter(|r| closes(r.source)).collect()
    }

    /// Rank of the rows that close loops, motions left out.
    fn closing_rank(&self) -> (usize, bool) {
        let rows = self.geometric();
        if rows.is_empty() || self.m.freedom() == 0 {
            return (0, false);
        }
        let g = gradients(self.at(), &rows, self.length);
        let columns = self.units();
        let scales: Vec<f64> = row_scales(&g, &columns).collect();
        let scaled = Matrix::from_fn(g.rows(), g.cols(), |i, j| g[(i, j)] * scales[i] * columns[j]);
        let rank = Orthogonal::factor(&scaled).rank();
        (rank.rank, rank.uncertain)
    }

    /// Whether the last solution says that every reaction is determinate: in a tree, and where it found the rows of loops independent.
    pub(super) fn is_determinate(&self) -> bool {
        let solved_by_null_space = self.m.unilateral.is_empty() && self.cheapest() == Route::Minimal;
        !self.is_closed() || solved_by_null_space && self.dense.self_stress().cols() == 0
    }

    /// All independent self-stresses at the present, solved state; the mechanism must not be too large for a
    /// dense factorisation.
    pub fn self_stresses(&mut self) -> Vec<SelfStress> {
        if !self.is_closed() {
            return vec![];
        }
        let solved = self.rows.clone();
        if !self.m.unilateral.is_empty() {
            self.rows = self.rows_with_closed_contacts();
        }
        // A factorisation that fails for want of inertia has still decided the ranks.
        let _ = self.factor(Force::ActuatorDirection);
        let multipliers = self.dense.saddle.self_stress();
        let stresses = (0..multipliers.cols()).map(|k| self.self_stress(&multipliers, k)).collect();
        self.rows = solved;
        stresses
    }

    /// The rows of all that is closed: of unilateral constraints that touch one solution loads no more than balance
    /// needs.
    fn rows_with_closed_contacts(&self) -> Vec<Row> {
        let rest_speed = REST * self.length * self.rate_of_motion();
        let mut mode = self.at().mode.clone();
        for (l, contact) in mode.contacts_mut().iter_mut().enumerate().filter(|(_, contact)| contact.mode.is_closed()) {
            let rests = self.slide_rate(l).abs() <= rest_speed;
            match (contact.mode, self.m.unilateral[l].friction) {
                (ContactMode::Frictionless, _) => {}
                (_, None) => contact.mode = ContactMode::Frictionless,
                (_, Some(_)) if rests => contact.mode = ContactMode::Stick,
                _ => {}
            }
        }
        closing_rows(StateView { mode: &mode, ..self.at() }, None)
    }

    fn self_stress(&self, multipliers: &Matrix, k: usize) -> SelfStress {
        let lambda: Vec<f64> = (0..self.rows.len()).map(|i| multipliers[(i, k)]).collect();
        let mut loads = vec![Wrench::zero(); self.m.bodies.len()];
        super::add_multipliers(&self.rows, &lambda, &mut loads);
        let joint_wrenches = joint_wrenches(self.at(), &loads);
        let stressed = SolvedView { joint_wrenches: &joint_wrenches, lambda: &lambda, ..self.solved_view() };
        let (loads, drives) = (stressed.joint_loads(), stressed.drive_forces());
        let mut groups = vec![[0.0; 4]; self.m.groups.len()];
        for (row, &l) in self.rows.iter().zip(&lambda) {
            let (Source::Gap(constraint) | Source::Friction(constraint)) = row.source else { continue };
            let force = force_on_first(self.m, constraint, row.loads()) * l;
            let along = if row.source == Source::Gap(constraint) { [l, 0.0] } else { [0.0, l] };
            let sum = &mut groups[self.m.unilateral[constraint].group];
            sum.iter_mut().zip([force.x, force.y, along[0], along[1]]).for_each(|(s, x)| *s += x);
        }
        SelfStress {
            joints: loads.iter().map(|load| [load.force.x, load.force.y, load.couple]).collect(),
            drives,
            groups,
        }
    }

    /// As [`Workspace::determinacy_under`], at the present, solved state. In a mechanism with many coordinates, where
    /// the ranks cost far more than the solution, they are decided once and kept.
    pub fn determinacy(&mut self) -> Determinacy {
        if let (Some(determinacy), true, false) =
            (&self.determinacy, self.m.freedom() > FEW_COORDINATES, self.m.is_hybrid())
        {
            return determinacy.clone();
        }
        let stresses = self.self_stresses();
        let determinacy = self.determinacy_under(&stresses);
        self.determinacy = Some(determinacy.clone());
        determinacy
    }

    /// What no self-stress touches.
    pub fn determinacy_under(&self, stresses: &[SelfStress]) -> Determinacy {
        let mut joints = vec![[true; 3]; self.m.joints.len()];
        let mut drives = vec![true; self.m.drives.len()];
        let mut groups = vec![[true; 4]; self.m.groups.len()];
        for s in stresses {
            let size = |c: &[f64; 3]| c[0].abs().max(c[1].abs()).max(c[2].abs() / self.length);
            let contacts = s.groups.iter().flatten().map(|x| x.abs());
            let forces = s.joints.iter().map(size).chain(s.drives.iter().map(|d| d.abs())).chain(contacts);
            // The largest multiplier is 1: a stress within one contact shows in none of its sums.
            let most = forces.fold(1.0, f64::max);
            for (flags, c) in groups.iter_mut().zip(&s.groups) {
                flags.iter_mut().zip(c).for_each(|(flag, x)| *flag &= x.abs() <= UNTOUCHED * most);
            }
            for (flags, c) in joints.iter_mut().zip(&s.joints) {
                let scaled = [c[0], c[1], c[2] / self.length];
                for (flag, x) in flags.iter_mut().zip(scaled) {
                    *flag &= x.abs() <= UNTOUCHED * most;
                }
            }
            for (flag, d) in drives.iter_mut().zip(&s.drives) {
                *flag &= d.abs() <= UNTOUCHED * most;
            }
        }
        Determinacy { joints, drives, groups }
    }

    /// A self-stress in words; none for one within a single contact.
    pub fn describe_self_stress(&self, s: &SelfStress) -> String {
        let size = |c: &[f64; 3]| c[0].abs().max(c[1].abs()).max(c[2].abs() / self.length);
        let most = s.joints.iter().map(size).fold(1.0, f64::max);
        let mut names: Vec<String> = vec![];
        for index in self.m.listed_joints() {
            let (joint, c) = (&self.m.joints[index], s.joints[index]);
            let forced = c[0].abs().max(c[1].abs()) > UNTOUCHED * most;
            match (forced, c[2].abs() / self.length > UNTOUCHED * most) {
                (true, true) => names.push(format!("`{}` (force and couple)", joint.name)),
                (true, false) => names.push(format!("`{}`", joint.name)),
                (false, true) => names.push(format!("`{}` (couple)", joint.name)),
                _ => {}
            }
        }
        for (group, c) in self.m.groups.iter().zip(&s.groups) {
            if c.iter().any(|x| x.abs() > UNTOUCHED) {
                names.push(format!("`{}`", group.name));
            }
        }
        for (drive, &d) in self.m.drives.iter().zip(&s.drives) {
            if d.abs() > UNTOUCHED * most.max(d.abs()) {
                names.push(format!("`{}`", drive.name));
            }
        }
        match names.is_empty() {
            // Within one contact, whose sums it does not touch.
            true => String::new(),
            false => format!("{} are statically indeterminate (self-stress)", names.join(", ")),
        }
    }
}
