//! Laws with cases: which branch each takes, at a start, at a zero and after a jump of the state.

use super::HybridSystem;
use crate::kinematics::State;
use crate::mechanism::Discontinuity;

impl HybridSystem<'_> {
    /// Freezes every switch at the branch it has now; one that is just changing at that which it has a moment `ahead` (s).
    pub fn freeze_branches(&mut self, t: f64, y: &[f64], ahead: f64) {
        let (m, n) = (self.workspace.m, self.workspace.m.freedom());
        let later: Vec<f64> = (0..y.len()).map(|i| if i < n { y[i] + ahead * y[n + i] } else { y[i] }).collect();
        for discontinuity in &m.discontinuities {
            let Discontinuity::Switch(switch, _) = discontinuity else { continue };
            self.place(t, y);
            let mut value = self.switching(discontinuity);
            if value == 0.0 {
                self.place(t + ahead, &later);
                value = self.switching(discontinuity);
            }
            self.mode.freeze(*switch, value >= 0.0);
        }
        self.place(t, y);
    }

    /// Takes the other branch of a switch.
    pub(super) fn switch_branch(&mut self, discontinuity: &Discontinuity, t: f64) {
        if let Discontinuity::Switch(switch, _) = discontinuity {
            let branch = self.mode.branch(*switch).unwrap_or(true);
            self.mode.freeze(*switch, !branch);
        }
        self.begin_phase(t, 0.0);
    }

    /// The function whose zero is a discontinuity, at the present state.
    pub(super) fn switching(&self, discontinuity: &Discontinuity) -> f64 {
        let at = self.workspace.at();
        match discontinuity {
            Discontinuity::Switch(switch, law) | Discontinuity::Bend(switch, law) => law.switch(*switch, &State(at)),
            Discontinuity::Knot(table, argument, x) => at.m.tables[*table].beyond(argument.eval(&State(at)), *x),
        }
    }

    /// The side of zero of a switch that is frozen at a branch; 0 of any other discontinuity.
    pub(super) fn frozen_side(&self, law: usize) -> i8 {
        let Discontinuity::Switch(switch, _) = self.workspace.m.discontinuities[law] else { return 0 };
        self.mode.branch(switch).map_or(0, |branch| if branch { 1 } else { -1 })
    }

    /// The values by which laws take their branches, at a state.
    pub(super) fn branch_values(&mut self, t: f64, y: &[f64]) -> Vec<f64> {
        let m = self.workspace.m;
        if m.discontinuities.is_empty() {
            return vec![];
        }
        self.place(t, y);
        m.discontinuities.iter().map(|discontinuity| self.switching(discontinuity)).collect()
    }

    /// Lets laws take the branches to which a jump of the state has brought them, from the values `before`; answers whether any did.
    pub(super) fn follow_jump(&mut self, t: f64, y: &[f64], before: &[f64]) -> bool {
        let (m, mut changed) = (self.workspace.m, false);
        for (discontinuity, before) in m.discontinuities.iter().zip(before) {
            let Discontinuity::Switch(switch, _) = discontinuity else { continue };
            self.place(t, y); // what is within another law has its branch by now
            let value = self.switching(discontinuity);
            if value != *before && value != 0.0 && self.mode.branch(*switch) != Some(value > 0.0) {
                self.mode.freeze(*switch, value > 0.0);
                changed = true;
            }
        }
        if changed {
            self.begin_phase(t, 0.0);
            self.place(t, y);
        }
        changed
    }
}
