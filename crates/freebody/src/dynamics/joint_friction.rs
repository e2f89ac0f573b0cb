//! Friction in joints: Coulomb's, by the size of the force that the joint carries; and of contacts for which a spring
//! stands, by the force of the spring, which the state tells.
//!
//! The load of a joint depends on its friction and the friction on its load. Where it slides both are found in turns;
//! as long as friction does not jam the joint each turn brings them closer.

use super::minimal::Wanted;
use super::rows::joint_friction_row;
use super::{compliant_force, ContactTolerances, DynamicsError, Route, SolvedView, Source, Workspace};
use crate::kinematics::StateView;
use crate::mechanism::FrictionSource;
use crate::mode::{ContactMode, Mode};
use crate::plane::Wrench;
use crate::scalar::Scalar;

/// Turns after which a joint counts as jammed.
const FRICTION_ITERATIONS: usize = 200;
/// Turns for each of what has friction in which it is found what sticks.
const SWITCHES: usize = 8;
/// Part of the mechanism's own accelerations above which one brings back what slides.
const BRINGS_BACK: f64 = 1e-9;
/// Change of a friction force that is round-off, over the most that the largest load of all could cause by friction.
const SETTLED: f64 = 1e-14;

/// Radius of the bearing of a hinge, m; else 1.
fn arm_of<S: Scalar>(at: StateView<'_, S>, friction: usize) -> S {
    match at.m.joint_friction[friction].of {
        FrictionSource::Joint { radius: Some(radius), .. } => at.n.values[radius],
        _ => S::one(),
    }
}

/// Adds the loads of all that slides in joints.
pub(super) fn add_joint_friction<S: Scalar>(at: StateView<'_, S>, forces: &[S], loads: &mut [Wrench<S>]) {
    for (friction, &force) in forces.iter().enumerate() {
        if matches!(at.mode.joint_friction[friction], ContactMode::Slip(_)) {
            for (body, load) in joint_friction_row(at, friction, None).motion {
                loads[body] += load * force;
            }
        }
    }
}

impl<S: Scalar> SolvedView<'_, S> {
    /// The most that friction can be, by a coefficient: N, or N·m of a hinge.
    fn most_friction(&self, friction: usize, rests: bool) -> S {
        let of = &self.at.m.joint_friction[friction];
        let pressing = match of.of {
            FrictionSource::Joint { joint, .. } => self.joint_load(joint).force.norm() * arm_of(self.at, friction),
            FrictionSource::Unilateral(constraint) => {
                let force = compliant_force(self.at, constraint);
                S::select(force.value() > 0.0, force, S::zero())
            }
        };
        pressing * self.at.n.values[if rests { of.fixed } else { of.kinetic }]
    }

    /// The friction of all that slides in joints, by the forces that press; 0 of what does not slide.
    pub(super) fn friction_by_law(&self) -> Vec<S> {
        let by_law = |friction: usize| match self.at.mode.joint_friction[friction] {
            ContactMode::Slip(sense) => self.most_friction(friction, false).scale(-sense),
            _ => S::zero(),
        };
        (0..self.at.m.joint_friction.len()).map(by_law).collect()
    }

    /// Friction along what it keeps from sliding: N, or N·m of a hinge.
    pub fn joint_friction_force(&self, friction: usize) -> S {
        match self.at.mode.joint_friction[friction] {
            ContactMode::Slip(_) => self.sliding_friction[friction],
            _ => {
                let rows = self.multipliers().filter(|(row, _)| row.source == Source::JointFriction(friction));
                rows.fold(S::zero(), |sum, (_, l)| sum + l)
            }
        }
    }
}

impl Workspace<'_> {
    /// Solves again until the friction of all that slides fits the forces that press.
    pub(super) fn solve_joint_friction(&mut self, route: Route) -> Result<(), DynamicsError> {
        for _ in 0..FRICTION_ITERATIONS {
            let wanted = self.solved_view().friction_by_law();
            let largest = self.largest_force();
            let noise = |friction: usize| {
                SETTLED * self.n.values[self.m.joint_friction[friction].kinetic] * arm_of(self.at(), friction) * largest
            };
            let fits =
                |friction: usize| (wanted[friction] - self.joint_friction_forces[friction]).abs() <= noise(friction);
            if (0..wanted.len()).all(fits) {
                return Ok(());
            }
            self.joint_friction_forces = wanted;
            self.solve_once(route, Wanted::Rank)?;
        }
        Err(self.self_locking())
    }

    /// The friction of joints has no forces that fit it.
    pub(super) fn self_locking(&self) -> DynamicsError {
        let names = (0..self.m.joint_friction.len()).map(|r| Source::JointFriction(r).name(self.m).to_string());
        DynamicsError::SelfLocking(names.collect())
    }

    /// The largest force of all that balance each other at a body, in the last solution: applied, passed on, of
    /// inertia, N.
    fn largest_force(&self) -> f64 {
        let inertial = |i: usize| super::inertia_wrench(self.at(), i, self.solved.bodies[i]);
        let forces = |i: usize| [self.loads[i], self.solved.joint_wrenches[i], inertial(i)].map(|load| load.f.norm());
        (0..self.m.bodies.len()).flat_map(forces).fold(0.0, f64::max)
    }

    /// How much of the friction at rest is left in the last solution, in either direction.
    pub fn joint_friction_reserve(&self, friction: usize) -> [f64; 2] {
        let seen = self.solved_view();
        let (most, force) = (seen.most_friction(friction, true), seen.joint_friction_force(friction));
        [most - force, most + force]
    }

    /// The rate of sliding at the present state, m/s, or rad/s of a hinge.
    pub fn joint_sliding_rate(&self, friction: usize) -> f64 {
        joint_friction_row(self.at(), friction, None).rate.unwrap_or(0.0)
    }

    /// Power of all that slides in the last solution, W.
    pub(super) fn joint_friction_power(&self) -> f64 {
        (0..self.m.joint_friction.len())
            .map(|friction| self.solved_view().joint_friction_force(friction) * self.joint_sliding_rate(friction))
            .sum()
    }

    /// The present mode with all friction going on as it is: what moves slides, the rest sticks, and what is not
    /// pressed does neither.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn start_joint_friction(&mut self, rest_speed: f64) -> Result<Mode, DynamicsError> {
        let mut mode = self.mode().clone();
        for friction in 0..self.m.joint_friction.len() {
            mode.joint_friction[friction] = match self.m.joint_friction[friction].of {
                FrictionSource::Unilateral(constraint) if mode.contacts[constraint].mode != ContactMode::Compliant => {
                    ContactMode::Open
                }
                FrictionSource::Joint { joint, .. } if !mode.has(self.m.part_of(joint)) => ContactMode::Open,
                _ if self.rests(friction, rest_speed) => ContactMode::Stick,
                _ => ContactMode::Slip(self.joint_sliding_rate(friction).signum()),
            };
        }
        if mode.joint_friction.contains(&ContactMode::Stick) && self.is_overconstrained(&mode) {
            return self.release_overconstrained_friction(mode);
        }
        Ok(mode)
    }

    /// Whether the constraints of a mode ask for motions that exclude each other.
    fn is_overconstrained(&mut self, mode: &Mode) -> bool {
        self.enter(mode);
        matches!(self.solve_by(Route::Minimal), Err(DynamicsError::Contradiction(..) | DynamicsError::Residual(..)))
    }

    /// Lets slide what no friction can hold, because the other constraints alone tell its acceleration: a slider that
    /// turns back at the dead point of its crank.
    fn release_overconstrained_friction(&mut self, mut mode: Mode) -> Result<Mode, DynamicsError> {
        let stuck: Vec<usize> = (0..self.m.joint_friction.len())
            .filter(|&friction| mode.joint_friction[friction] == ContactMode::Stick)
            .collect();
        stuck.iter().for_each(|&friction| mode.joint_friction[friction] = ContactMode::Open);
        self.enter(&mode);
        self.solve_by(Route::Minimal)?;
        let later: Vec<f64> = stuck.iter().map(|&friction| self.joint_sliding_acceleration(friction)).collect();
        for (&friction, later) in stuck.iter().zip(later) {
            mode.joint_friction[friction] = ContactMode::Stick;
            if self.is_overconstrained(&mode) {
                mode.joint_friction[friction] = ContactMode::Slip(later.signum());
            }
        }
        Ok(mode)
    }

    /// Turns after which it should be settled what sticks.
    pub fn friction_switch_limit(&self) -> usize {
        SWITCHES * self.m.joint_friction.len()
    }

    /// The present mode, but that the first slides that sticks and whose friction at rest does not suffice, or that the
    /// first sticks again that slides from rest and would be brought back, the one just `released` left out; None where
    /// there is none (Murty 1974, *Mathematical Programming* 7, 138: the first of them, so that it comes to an end).
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn switch_joint_friction(
        &mut self,
        scale: ContactTolerances,
        released: Option<usize>,
    ) -> Result<Option<Mode>, DynamicsError> {
        self.solve()?;
        let with = |friction: usize, held: ContactMode| {
            let mut mode = self.mode().clone();
            mode.joint_friction[friction] = held;
            Ok(Some(mode))
        };
        for friction in 0..self.m.joint_friction.len() {
            match self.mode().joint_friction[friction] {
                ContactMode::Stick => {
                    let [later, back] = self.joint_friction_reserve(friction);
                    if later.min(back) < 0.0 {
                        // Friction that would have to push ahead cannot keep it from sliding back.
                        return with(friction, ContactMode::Slip(if later < back { -1.0 } else { 1.0 }));
                    }
                }
                ContactMode::Slip(sense)
                    if released != Some(friction)
                        && self.rests(friction, scale.rest_speed)
                        && sense * self.joint_sliding_acceleration(friction) * self.friction_lever(friction)
                            < -BRINGS_BACK * scale.acceleration =>
                {
                    return with(friction, ContactMode::Stick);
                }
                _ => {}
            }
        }
        Ok(None)
    }

    /// Acceleration of sliding in the last solution, m/s², or rad/s² of a hinge.
    fn joint_sliding_acceleration(&self, friction: usize) -> f64 {
        joint_friction_row(self.at(), friction, Some(&self.solved.bodies)).bias
    }

    /// Whether what has friction does not slide, at a speed that counts.
    fn rests(&self, friction: usize, rest_speed: f64) -> bool {
        self.joint_sliding_rate(friction).abs() * self.friction_lever(friction) <= rest_speed
    }
}
