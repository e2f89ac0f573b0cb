//! The physical sizes by which errors, guards and forces of a motion are judged.

use super::HybridSystem;
use crate::dynamics::Workspace;

/// Size of a guard, for its round-off, while coordinates are small: places are sums of some lengths.
pub(super) const ROUNDOFF: f64 = 4.0;

/// Part of an energy below which what a change of mode takes is round-off, as of an engagement of what met at one speed.
pub(super) const NOTHING_LOST: f64 = 1e-14;

/// The physical sizes at a start.
pub struct Sizes {
    /// Of [q, u, works, states].
    pub of: Vec<f64>,
    /// A large change of each coordinate.
    units: Vec<f64>,
    /// The fastest rate, 1/s.
    pub rate: f64,
    energy: f64,
}

impl Sizes {
    /// At the state where a workspace is placed, with so many works, of a run that takes so long, s: lengths from the mechanism, the time
    /// from its speeds and accelerations there and from gravity, or from the end of the run where nothing moves yet.
    pub fn new(workspace: &mut Workspace, works: usize, run: f64) -> Self {
        let m = workspace.m;
        workspace.take_length_of_motion(run);
        let (length, fastest) = (workspace.length, workspace.natural_rate());
        let rate = match run {
            _ if fastest > 0.0 => fastest,
            0.0 => 1.0,
            _ => 1.0 / run,
        };
        let (units, at) = (workspace.units(), workspace.at());
        let mut of: Vec<f64> = units.iter().zip(at.q).map(|(unit, q)| unit.max(q.abs())).collect();
        of.extend(units.iter().map(|unit| unit * rate));
        let numbers = at.n;
        let turning = (1..m.bodies.len()).filter(|&i| !m.bodies[i].particle).map(|i| numbers.inertia[i]).sum::<f64>();
        let inertia = numbers.mass.iter().sum::<f64>() * length * length + turning;
        let energy = (inertia * rate * rate).max(workspace.kinetic_energy()).max(f64::MIN_POSITIVE);
        of.resize(of.len() + works, energy);
        let states = numbers.p[m.first_state()..].iter().zip(workspace.state_rates());
        // A state that neither has a value nor changes yet is judged by its unit.
        of.extend(states.map(|(z, change)| z.abs().max(change.abs() / rate)).map(|z| if z > 0.0 { z } else { 1.0 }));
        Sizes { of, units, rate, energy }
    }
}

impl HybridSystem<'_> {
    /// Learns the physical sizes of the state's components from the starting state.
    pub fn set_scales(&mut self, t: f64, until: f64, y: &[f64]) {
        self.place(t, y);
        let Sizes { of, units, rate, energy } = Sizes::new(&mut self.workspace, self.works.count(), (until - t).abs());
        let length = self.workspace.length;
        (self.scales, self.units) = (of, units);
        self.roundoff_scale = ROUNDOFF;
        self.speed = length * rate;
        self.time = 1.0 / rate;
        self.strength = energy / length;
    }
}
