//! The works that are integrated with the motion, at the end of the state vector.

use crate::dynamics::{unaccounted_power, Workspace};
use crate::mechanism::Mechanism;

/// Which works the state vector holds, in this order: of forces, of motions, of friction, of compliant contacts.
#[derive(Clone, Debug)]
pub(super) struct Works {
    /// Forces without a potential.
    pub forces: Vec<usize>,
    /// Prescribed motions.
    pub motions: Vec<usize>,
    /// Whether there is friction.
    friction: bool,
    /// Whether there are springs with dampers of unilateral constraints.
    compliant: bool,
}

impl Works {
    pub fn of(m: &Mechanism) -> Self {
        Works {
            forces: (0..m.forces.len()).filter(|&f| !m.forces[f].is_conservative()).collect(),
            motions: (0..m.drives.len()).filter(|&d| m.drives[d].is_motion()).collect(),
            friction: !m.joint_friction.is_empty() || m.unilateral.iter().any(|each| each.friction.is_some()),
            compliant: m.unilateral.iter().any(|each| each.soft.is_some() && !each.is_conservative(m)),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count_while_free() + usize::from(self.friction) + usize::from(self.compliant)
    }

    /// How many of them, the first, are done while nothing touches or rubs.
    pub fn count_while_free(&self) -> usize {
        self.forces.len() + self.motions.len()
    }

    /// The entries of the ledger for them.
    pub fn names(&self, m: &Mechanism) -> Vec<String> {
        let forces = self.forces.iter().map(|&f| m.forces[f].ledger_entry());
        let motions = self.motions.iter().map(|&d| m.drives[d].name.clone());
        let friction = self.friction.then(|| "friction".to_string());
        forces.chain(motions).chain(friction).chain(self.compliant.then(|| "compliant contacts".to_string())).collect()
    }

    /// Writes their rates in a solved state.
    pub fn write_powers(&self, solved: &Workspace, out: &mut [f64]) {
        let forces = self.forces.iter().map(|&f| unaccounted_power(solved.at(), f));
        let motions = self.motions.iter().map(|&d| solved.solved_view().drive_power(d));
        let friction = self.friction.then(|| solved.friction_power());
        let all = forces.chain(motions).chain(friction).chain(self.compliant.then(|| solved.compliant_power()));
        out.iter_mut().zip(all).for_each(|(out, power)| *out = power);
    }

    /// Those of a state vector, spread over all forces, then all drives, then that of friction, as [`Workspace::evaluate`]
    /// takes them; `given` is the energy that the potential of each force was given.
    pub fn spread(&self, m: &Mechanism, y: &[f64], given: &[f64]) -> Vec<f64> {
        let tail = &y[2 * m.freedom()..];
        let mut works = given.to_vec();
        works.resize(m.forces.len() + m.drives.len() + 1, 0.0);
        if self.friction {
            works[m.forces.len() + m.drives.len()] = tail[self.forces.len() + self.motions.len()];
        }
        for (i, &f) in self.forces.iter().enumerate() {
            works[f] += tail[i];
        }
        for (i, &d) in self.motions.iter().enumerate() {
            works[m.forces.len() + d] = tail[self.forces.len() + i];
        }
        works
    }
}
