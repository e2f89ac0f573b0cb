//! How large the terms are that balance: against them, not against what is left of them, round-off is to be held.
//!
//! Where nothing pushes a bead along a turning rod, Coriolis and transverse acceleration cancel; what is left of them
//! is no measure of anything.

use super::Workspace;
use crate::plane::Wrench;

/// Load, N, and acceleration, m/s², of a mechanism in which there are none: above 0, to divide by, and below any that counts.
const VANISHING: f64 = 1e-300;

/// The largest term of any body's balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TermScales {
    /// Force (or couple over the characteristic length), N.
    pub load: f64,
    /// Acceleration, m/s²: a part of a body's own, or what the loads on it alone would give it.
    pub acceleration: f64,
}

impl Workspace<'_> {
    /// The sizes of the last solution's terms.
    pub fn term_scales(&self) -> TermScales {
        let mut sizes = TermScales { load: self.least_load(), acceleration: VANISHING };
        self.parts_of_accelerations().iter().zip(&self.n.mass).for_each(|(a, m)| sizes.include(a * m, *a));
        for (load, &mass) in self.loads.iter().zip(&self.n.mass) {
            let force = self.strength(load);
            sizes.include(force, if mass > 0.0 { force / mass } else { 0.0 });
        }
        for joint in self.solved_view().joint_loads() {
            sizes.include(self.strength(&Wrench { f: joint.force, m: joint.couple }), 0.0);
        }
        for (row, &lambda) in self.rows.iter().zip(&self.solved.lambda) {
            row.loads().iter().for_each(|(_, load)| sizes.include(self.strength(&(*load * lambda)), 0.0));
        }
        sizes
    }

    /// Round-off of m v²/l, the force that would turn a body's motion within the characteristic length: below it a load is none.
    fn least_load(&self) -> f64 {
        let turning = |i: usize| self.n.mass[i] * self.centre(i).1.dot(self.centre(i).1) / self.length;
        (1..self.m.bodies.len()).map(turning).fold(VANISHING, |most, force| most.max(f64::EPSILON * force))
    }

    fn strength(&self, load: &Wrench) -> f64 {
        load.f.norm().max(load.m.abs() / self.length)
    }

    /// Of each body, the largest part of its mass centre's acceleration, those that it is carried with included.
    fn parts_of_accelerations(&self) -> Vec<f64> {
        let mut carried = vec![0.0_f64; self.m.bodies.len()];
        let mut whole = carried.clone();
        for (i, body) in self.m.bodies.iter().enumerate() {
            let Some(b) = body.tree_joint else { continue };
            let mut part = carried[b.parent].max(self.solved.bodies[b.parent].w.abs() * self.k.arm[i].norm());
            part = part.max(self.k.bias_acceleration[i].v.norm());
            for k in 0..b.freedom {
                part = part.max(self.k.motion_subspace[i][k].v.norm() * self.solved.nu_dot[b.start + k].abs());
            }
            let spin = self.solved.bodies[i].w.abs().max(self.k.twist[i].w * self.k.twist[i].w);
            carried[i] = part;
            whole[i] = part.max(spin * self.arms[i].norm());
        }
        whole
    }
}

impl TermScales {
    fn include(&mut self, load: f64, acceleration: f64) {
        self.load = self.load.max(load);
        self.acceleration = self.acceleration.max(acceleration);
    }
}
