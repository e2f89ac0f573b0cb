//! Accelerations and all reactions as bare numbers, at one state after another.

use super::{joint_place, Determinacy, DynamicsError, SolvedView, Workspace};
use crate::mechanism::{DriveKind, Mechanism};
use crate::mode::Mode;
use crate::scalar::Scalar;

/// The names of what [`Workspace::evaluate_at`] gives: of each joint the force on its second body along the fixed axes and the couple
/// (N, N·m), the force or torque of each motion and coupling, and of each contact, stop and string the force on its first body.
pub fn reaction_names(m: &Mechanism) -> Vec<String> {
    let joints = m.listed_joints().flat_map(|j| ["Fx", "Fy", "M"].map(|part| format!("{}.{part}", m.joints[j].name)));
    let drives = driven(m).map(|d| m.drives[d].name.clone());
    let groups = m.groups.iter().flat_map(|group| ["Fx", "Fy"].map(|part| format!("{}.{part}", group.name)));
    joints.chain(drives).chain(groups).collect()
}

/// The motions and couplings.
fn driven(m: &Mechanism) -> impl Iterator<Item = usize> + '_ {
    (0..m.drives.len()).filter(|&d| matches!(m.drives[d].kind, DriveKind::Motion | DriveKind::Coupling))
}

impl Workspace<'_> {
    /// Accelerations of the coordinates, and reactions in the order of [`reaction_names`]; NaN where the balances leave one open. The
    /// state decides by itself what touches, is taut or slides. Parameters are bound again only where they are others.
    ///
    /// # Errors
    /// Arrays that are no state; as [`Workspace::solve`] and [`Workspace::initial_mode`].
    pub fn evaluate_at(
        &mut self,
        p: &[f64],
        t: f64,
        [q, u]: [&[f64]; 2],
        accelerations: &mut [f64],
        reactions: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.m.check_state(p, t, q, u)?;
        if self.n.p != p {
            self.rebind(p);
        }
        if !self.m.unilateral.is_empty() || !self.m.joint_friction.is_empty() {
            self.place(&Mode::free(self.m), t, q, u);
            self.enter_initial_mode()?;
        } else {
            self.move_to(t, q, u);
        }
        self.solve_reactions()?;
        self.check_finite()?;
        self.write_solution(accelerations, reactions);
        Ok(())
    }

    /// Writes the accelerations of the last solution, and its reactions as [`Workspace::evaluate_at`] has them.
    pub fn write_solution(&mut self, accelerations: &mut [f64], reactions: &mut [f64]) {
        let determinacy = (!self.is_determinate()).then(|| self.determinacy());
        self.accelerations(accelerations);
        self.solved_view().write_reactions(determinacy.as_ref(), reactions);
    }
}

impl<S: Scalar> SolvedView<'_, S> {
    /// Writes the reactions in the order of [`reaction_names`]; NaN where one is not determinate. No `determinacy`: all are.
    pub fn write_reactions(&self, determinacy: Option<&Determinacy>, out: &mut [S]) {
        let m = self.at.m;
        let mut out = out.iter_mut();
        let mut put = |value: S, is_sure: &dyn Fn(&Determinacy) -> bool| {
            *out.next().expect("as many as there are names") =
                if determinacy.is_none_or(is_sure) { value } else { S::of(f64::NAN) };
        };
        for j in m.listed_joints() {
            let load = self.reaction(j, joint_place(self.at, j));
            for (k, value) in load.parts().into_iter().enumerate() {
                put(value, &|open| open.joints[j][k]);
            }
        }
        if !m.drives.is_empty() {
            let forces = self.drive_forces();
            driven(m).for_each(|d| put(forces[d], &|open| open.drives[d]));
        }
        for g in 0..m.groups.len() {
            let force = self.force_on_first(g);
            put(force.x, &|open| open.groups[g][0]);
            put(force.y, &|open| open.groups[g][1]);
        }
    }
}
