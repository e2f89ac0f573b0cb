//! Friction in joints: Coulomb's, by the size of the force that the joint carries; and of contacts for which a spring stands, by
//! the force of the spring, which the state tells.
//!
//! The load of a joint depends on its friction and the friction on its load. Where it slides both are found in turns; as
//! long as friction does not jam the joint each turn brings them closer.

use super::rows::rub_row;
use super::{Balance, Route, Scale, Source, Trouble, INCONSISTENT};
use crate::mechanism::Rubbing;
use crate::mode::Hold;

/// Turns after which a joint counts as jammed.
const TURNS: usize = 200;
/// Turns for each of what rubs in which it is found what sticks.
const FLIPS: usize = 8;
/// Part of the mechanism's own accelerations below which one brings nothing back.
const NOTHING: f64 = 1e-9;
/// Change of a friction force that is round-off, over the most that the largest load of all would rub.
const SETTLED: f64 = 1e-14;

impl Balance<'_> {
    /// The most that friction can be in the last solution, by a coefficient: N, or N·m of a hinge.
    fn most_friction(&self, rub: usize, rests: bool) -> f64 {
        let of = &self.m.rubs[rub];
        let pressing = match of.of {
            Rubbing::Joint { joint, .. } => self.joint_load(joint).force.norm() * self.arm_of(rub),
            Rubbing::Limit(limit) => self.press(limit).max(0.0),
        };
        pressing * self.n.slots[if rests { of.fixed } else { of.kinetic }]
    }

    /// Radius of the bearing of a hinge, m; else 1.
    fn arm_of(&self, rub: usize) -> f64 {
        match self.m.rubs[rub].of {
            Rubbing::Joint { radius: Some(radius), .. } => self.n.slots[radius],
            _ => 1.0,
        }
    }

    /// Adds the loads of all that slides.
    pub(super) fn add_rubs(&mut self) {
        for rub in 0..self.m.rubs.len() {
            let force = self.rub_forces[rub];
            if matches!(self.mode.rubs[rub], Hold::Sliding(_)) && force != 0.0 {
                for (body, load) in rub_row(self.at(), rub, None).motion {
                    self.loads[body] += load * force;
                }
            }
        }
    }

    /// Solves again until the friction of all that slides fits the forces that press.
    pub(super) fn fit_rubs(&mut self, route: Route) -> Result<(), Trouble> {
        for _ in 0..TURNS {
            let wanted: Vec<f64> = (0..self.m.rubs.len()).map(|rub| self.sliding_friction(rub)).collect();
            let largest = self.largest_force();
            let noise = |rub: usize| SETTLED * self.n.slots[self.m.rubs[rub].kinetic] * self.arm_of(rub) * largest;
            let fits = |rub: usize| (wanted[rub] - self.rub_forces[rub]).abs() <= noise(rub);
            if (0..wanted.len()).all(fits) {
                return Ok(());
            }
            self.rub_forces = wanted;
            self.solve_once(route)?;
        }
        let names: Vec<String> = (0..self.m.rubs.len()).map(|r| format!("`{}`", Source::Rub(r).name(self.m))).collect();
        Err(Trouble::new(
            "friction_jams",
            format!("at {} no friction force fits the load that it causes; lower the friction", names.join(", ")),
        ))
    }

    /// The largest force of all that balance each other at a body, in the last solution: applied, passed on, effective, N.
    fn largest_force(&self) -> f64 {
        let effective = |i: usize| super::effective(self.at(), i, self.arms[i], self.solved.bodies[i]);
        let forces = |i: usize| [self.loads[i], self.solved.passed[i], effective(i)].map(|load| load.f.norm());
        (0..self.m.bodies.len()).flat_map(forces).fold(0.0, f64::max)
    }

    fn sliding_friction(&self, rub: usize) -> f64 {
        match self.mode.rubs[rub] {
            Hold::Sliding(sense) => -sense * self.most_friction(rub, false),
            _ => 0.0,
        }
    }

    /// Friction in the last solution, along what it keeps from sliding: N, or N·m of a hinge.
    pub fn rub_force(&self, rub: usize) -> f64 {
        match self.mode.rubs[rub] {
            Hold::Sliding(_) => self.rub_forces[rub],
            _ => {
                let rows = self.rows.iter().zip(&self.solved.lambda);
                rows.filter(|(row, _)| row.source == Source::Rub(rub)).map(|(_, &l)| l).sum()
            }
        }
    }

    /// How much of the friction at rest is left in the last solution, in either direction.
    pub fn rub_reserve(&self, rub: usize) -> [f64; 2] {
        let (most, force) = (self.most_friction(rub, true), self.rub_force(rub));
        [most - force, most + force]
    }

    /// The rate of sliding at the present state, m/s, or rad/s of a hinge.
    pub fn rub_rate(&self, rub: usize) -> f64 {
        rub_row(self.at(), rub, None).rate.unwrap_or(0.0)
    }

    /// Power of all that slides in the last solution, W.
    pub(super) fn rub_power(&self) -> f64 {
        (0..self.m.rubs.len()).map(|rub| self.rub_force(rub) * self.rub_rate(rub)).sum()
    }

    /// Lets all that rubs go on as it is: what moves slides, the rest sticks, and what is not pressed does neither.
    ///
    /// # Errors
    /// As [`Balance::solve`].
    pub fn start_rubs(&mut self, still: f64) -> Result<(), Trouble> {
        for rub in 0..self.m.rubs.len() {
            self.mode.rubs[rub] = match self.m.rubs[rub].of {
                Rubbing::Limit(limit) if self.mode.limits[limit].hold != Hold::Pressed => Hold::Open,
                Rubbing::Joint { joint, .. } if !self.has(self.m.part_of(joint)) => Hold::Open,
                _ if self.rests(rub, still) => Hold::Stuck,
                _ => Hold::Sliding(self.rub_rate(rub).signum()),
            };
        }
        if self.mode.rubs.contains(&Hold::Stuck) && self.contradicts_itself() {
            self.let_slide_what_cannot_stick()?;
        }
        Ok(())
    }

    /// Whether the constraints of the present mode ask for motions that exclude each other.
    fn contradicts_itself(&mut self) -> bool {
        matches!(self.solve_by(Route::Minimal), Err(trouble) if trouble.name == INCONSISTENT)
    }

    /// Lets slide what no friction can hold, because the other constraints alone tell its acceleration: a slider that turns
    /// back at the dead point of its crank.
    fn let_slide_what_cannot_stick(&mut self) -> Result<(), Trouble> {
        let stuck: Vec<usize> = (0..self.m.rubs.len()).filter(|&rub| self.mode.rubs[rub] == Hold::Stuck).collect();
        stuck.iter().for_each(|&rub| self.mode.rubs[rub] = Hold::Open);
        self.solve_by(Route::Minimal)?;
        let ahead: Vec<f64> = stuck.iter().map(|&rub| self.rub_acceleration(rub)).collect();
        for (&rub, ahead) in stuck.iter().zip(ahead) {
            self.mode.rubs[rub] = Hold::Stuck;
            if self.contradicts_itself() {
                self.mode.rubs[rub] = Hold::Sliding(ahead.signum());
            }
        }
        Ok(())
    }

    /// Turns after which it should be settled what sticks.
    pub fn most_turns(&self) -> usize {
        FLIPS * self.m.rubs.len()
    }

    /// Lets the first slide that sticks and whose friction at rest does not suffice, or the first stick again that slides from
    /// rest and would be brought back, but not the one just come `loose`; answers whether there was one (Murty 1974,
    /// *Mathematical Programming* 7, 138: the first of them, so that it comes to an end).
    ///
    /// # Errors
    /// As [`Balance::solve`].
    pub fn turn_rub(&mut self, scale: Scale, loose: Option<usize>) -> Result<bool, Trouble> {
        self.solve()?;
        for rub in 0..self.m.rubs.len() {
            match self.mode.rubs[rub] {
                Hold::Stuck => {
                    let [ahead, back] = self.rub_reserve(rub);
                    if ahead.min(back) < 0.0 {
                        // Friction that would have to push ahead cannot keep it from sliding back.
                        self.mode.rubs[rub] = Hold::Sliding(if ahead < back { -1.0 } else { 1.0 });
                        return Ok(true);
                    }
                }
                Hold::Sliding(sense)
                    if loose != Some(rub)
                        && self.rests(rub, scale.still)
                        && sense * self.rub_acceleration(rub) < -NOTHING * scale.pace =>
                {
                    self.mode.rubs[rub] = Hold::Stuck;
                    return Ok(true);
                }
                _ => {}
            }
        }
        Ok(false)
    }

    /// Acceleration of sliding in the last solution, m/s², or rad/s² of a hinge.
    fn rub_acceleration(&self, rub: usize) -> f64 {
        rub_row(self.at(), rub, Some(&self.solved.bodies)).bias
    }

    /// Whether what rubs does not slide, at a speed that counts.
    fn rests(&self, rub: usize, still: f64) -> bool {
        let arm = match self.m.rubs[rub].of {
            Rubbing::Joint { radius, .. } => radius.map_or(1.0, |_| self.length),
            Rubbing::Limit(_) => 1.0,
        };
        self.rub_rate(rub).abs() * arm <= still
    }
}
