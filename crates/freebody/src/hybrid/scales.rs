//! The physical sizes by which errors, guards and forces of a motion are judged.

use super::HybridSystem;

/// Size of a guard, for its round-off, while coordinates are small: places are sums of some lengths.
pub(super) const ROUNDOFF: f64 = 4.0;

/// Part of an energy below which what a change of mode takes is round-off, as of an engagement of what met at one speed.
pub(super) const NOTHING_LOST: f64 = 1e-14;

impl HybridSystem<'_> {
    /// Learns the physical sizes of the state's components from the starting state: lengths from the mechanism, the time
    /// from its speeds and accelerations there and from gravity, or from the end of the run where nothing moves yet.
    pub fn set_scales(&mut self, t: f64, until: f64, y: &[f64]) {
        self.place(t, y);
        let m = self.workspace.m;
        let (n, run) = (m.freedom(), (until - t).abs());
        self.workspace.take_length_of_motion(run);
        let (length, fastest) = (self.workspace.length, self.workspace.natural_rate());
        let rate = match run {
            _ if fastest > 0.0 => fastest,
            0.0 => 1.0,
            _ => 1.0 / run,
        };
        let units = self.workspace.units();
        let q = self.split(y).0;
        let mut scales: Vec<f64> = (0..n).map(|i| units[i].max(q[i].abs())).collect();
        scales.extend(units.iter().map(|unit| unit * rate));
        let numbers = self.workspace.at().n;
        let turning = (1..m.bodies.len()).filter(|&i| !m.bodies[i].particle).map(|i| numbers.inertia[i]).sum::<f64>();
        let inertia = numbers.mass.iter().sum::<f64>() * length * length + turning;
        let energy = (inertia * rate * rate).max(self.workspace.kinetic_energy()).max(f64::MIN_POSITIVE);
        scales.resize(self.first_state(), energy);
        let states = y[self.first_state()..].iter().zip(self.workspace.state_rates());
        // A state that neither has a value nor changes yet is judged by its unit.
        scales
            .extend(states.map(|(z, change)| z.abs().max(change.abs() / rate)).map(|z| if z > 0.0 { z } else { 1.0 }));
        self.scales = scales;
        self.units = units;
        self.roundoff_scale = ROUNDOFF;
        self.speed = length * rate;
        self.time = 1.0 / rate;
        self.strength = energy / length;
    }
}
