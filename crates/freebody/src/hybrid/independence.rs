//! How near the loops are to losing the independence of their closing rows, and what the steps do about it.

use super::HybridSystem;
use crate::dynamics::DynamicsError;

/// Independence of the closing rows below which every stage of a step is brought onto the loops.
pub(super) const NEAR_SINGULAR: f64 = 0.1;
/// Independence of the closing rows below which the steps look out for a singular configuration: far enough to come to it by a step across.
const WATCHED: f64 = 0.5;

/// Part of the way to there over which the fall of the independence is a difference.
const GLANCE: f64 = 1e-3;
/// Gap that a stage keeps, by round-off, and a factor 27 for the independence that falls to a third within a step.
const STAGE_NOISE: f64 = 100.0 * f64::EPSILON;

impl HybridSystem<'_> {
    /// Independence of the closing rows at a state, and a short time later as it goes now; that time.
    pub(super) fn independence_ahead(&mut self, t: f64, y: &[f64]) -> (f64, [f64; 2]) {
        let n = self.workspace.m.freedom();
        let fastest = (0..n).map(|i| (y[n + i] / self.scales[i]).abs()).fold(0.0, f64::max);
        let dt = if fastest > 0.0 { GLANCE * NEAR_SINGULAR / fastest } else { 0.0 };
        let later: Vec<f64> = (0..y.len()).map(|i| if i < n { y[i] + dt * y[n + i] } else { y[i] }).collect();
        self.learn_independence(t, y);
        (dt, [self.independence, self.independence_of(t + dt, &later)])
    }

    /// Finds the independence of the closing rows at a state, where it is not known yet.
    fn learn_independence(&mut self, t: f64, y: &[f64]) {
        let n = self.workspace.m.freedom();
        if self.independence == 0.0 || self.independence_at != y[..n] {
            let found = self.independence_of(t, y);
            self.note_independence(found, &y[..n]);
        }
    }

    /// Notes the independence of the closing rows at coordinates.
    pub(super) fn note_independence(&mut self, found: f64, q: &[f64]) {
        self.independence = found;
        self.independence_at.clear();
        self.independence_at.extend_from_slice(q);
    }

    fn independence_of(&mut self, t: f64, y: &[f64]) -> f64 {
        self.place(t, y);
        self.workspace.update_rows();
        self.workspace.independence()
    }

    /// Solves a stage of a step, the state placed. Close to a singular configuration it is first brought onto the
    /// loops: there a motion off them, however little, is accelerated without bound; a motion on them is not.
    pub(super) fn solve_stage(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        if self.near_singular {
            let (q, u) = self.split(y);
            let (mode, mut q, mut u) = (self.workspace.mode().clone(), q.to_vec(), u.to_vec());
            self.workspace.project_positions(&mode, t, &mut q, &u)?;
            self.workspace.project_velocities(&mode, t, &q, &mut u)?;
            self.workspace.move_to(t, &q, &u);
        }
        self.check_taut_segments()?;
        self.workspace.solve_motion()
    }

    /// A gap of round-off size is a rate error of its size over the independence cubed: once for the positions, once
    /// for the velocities, once for the accelerations that close it. Within a step the independence may fall to a
    /// third.
    pub(super) fn stage_noise(&self) -> f64 {
        if self.near_singular {
            STAGE_NOISE / (self.independence * self.independence * self.independence)
        } else {
            0.0
        }
    }

    /// When the loops lose independence, from how fast they do so now. Where the next step may go across that place its
    /// stages are brought onto the loops too: off them by its own error it would be accelerated beyond measure.
    pub(super) fn singular_ahead(&mut self, t: f64, y: &[f64], reach: f64) -> Option<f64> {
        self.near_singular = false;
        if !self.workspace.is_closed() || self.mode.resting {
            return None;
        }
        self.learn_independence(t, y);
        if self.independence >= WATCHED {
            return None;
        }
        let (dt, [now, next]) = self.independence_ahead(t, y);
        let left = now * dt / (now - next);
        let ahead = left.is_finite() && left * reach > 0.0;
        self.near_singular = now < NEAR_SINGULAR || ahead && left.abs() <= reach.abs();
        ahead.then_some(t + left)
    }
}
