//! The motion of a mechanism: the system that an integrator carries, and what is kept of a run.
//!
//! State y = [q, u, works]: coordinates, their rates, and the work of every force without a potential and of
//! every prescribed motion, so that the energy ledger has the accuracy of the motion.

mod bounds;
mod branches;
mod cable_singularity;
mod canonical;
mod dead_position;
mod event_actions;
mod guards;
mod impacts;
mod independence;
mod instant;
mod mode_changes;
mod mode_resolution;
mod parts;
mod record;
mod recorded;
mod reference;
mod rest;
mod scales;
mod series;
mod system;
mod trajectory;
mod works;

pub use canonical::mass_matrix;
pub use impacts::Rule;
pub use mode_changes::{ContactImpulse, Impulses, ModeChange};
pub use recorded::{is_firm, Recorded};
pub use reference::reference;
pub use scales::Sizes;
pub use system::HybridSystem;
pub use trajectory::{Ledger, MotionState, Trajectory};

use crate::builder::chosen;
use crate::dynamics::{DynamicsError, Route, Workspace};
use crate::error::CompileError;
use crate::mechanism::Mechanism;
use crate::mode::Mode;
use crate::motion::{method, run, Method, Options};

/// Part of a run after which a law that switches just at its start is on the side to which it goes.
const MOMENT: f64 = 1e-9;

/// What may be chosen about a simulation.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Name of the integrator.
    pub method: String,
    /// Tolerances and steps.
    pub options: Options,
    /// How each instant is solved; None for the cheapest way.
    pub route: Option<Route>,
    /// What is done about impacts that the laws leave open.
    pub impacts: Rule,
    /// Whether contacts that jam by friction jump, instead of ending the run.
    pub jam_by_impact: bool,
}

impl Settings {
    /// Settings by their words: integrator, route (or `auto`), law of impacts, and answer to an impact without
    /// collision of friction.
    ///
    /// # Errors
    /// An unknown word.
    pub fn named(words: [&str; 4], options: Options) -> Result<Settings, CompileError> {
        let [method, route, impacts, painleve] = words;
        let routes = [("auto", None)].into_iter().chain(Route::ALL.iter().map(|r| (r.0, Some(r.1))));
        let rules = Rule::ALL.iter().copied();
        Ok(Settings {
            method: method.to_string(),
            options,
            route: chosen("route", route, routes)?,
            impacts: chosen("law of impacts", impacts, rules)?,
            jam_by_impact: chosen("answer to a jam of friction", painleve, [("stop", false), ("impact", true)])?,
        })
    }

    /// Whether motions go by steps that are the same for all, as [`crate::motion::march`] does.
    pub fn marches(&self) -> bool {
        self.method == "rk4" && self.route.is_none()
    }

    /// The integrator chosen.
    ///
    /// # Errors
    /// `unknown_method`.
    pub fn integrator(&self) -> Result<&'static Method, DynamicsError> {
        let known = crate::motion::METHODS.iter().map(|m| m.name);
        method(&self.method).ok_or_else(|| DynamicsError::UnknownMethod(self.method.clone(), known.collect()))
    }
}

/// A state to start from: parameters, time, coordinates and rates.
#[derive(Clone, Debug)]
pub struct Start<'a> {
    /// Parameters.
    pub p: &'a [f64],
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: &'a [f64],
    /// Rates.
    pub u: &'a [f64],
    /// What is in place and holds, where the motion goes on from another; None for that of the model's start.
    pub mode: Option<&'a Mode>,
}

/// Carries a mechanism from a state to the time `until`, or to an event that ends the run.
///
/// `progress` gets the time now and then; the run ends when it answers false.
///
/// # Errors
/// What keeps the run from starting; what ends it later is its outcome.
pub fn simulate(
    m: &Mechanism,
    start: &Start,
    until: f64,
    settings: &Settings,
    progress: &mut dyn FnMut(f64) -> bool,
) -> Result<Trajectory, DynamicsError> {
    m.check_state(start.p, start.t, start.q, start.u)?;
    if start.mode.is_some_and(|mode| !mode.fits(m)) {
        return Err(DynamicsError::ForeignHistory);
    }
    if !until.is_finite() {
        return Err(DynamicsError::NoFiniteNumber("until".into(), until));
    }
    let integrator = settings.integrator()?;
    let mut workspace = Workspace::new(m, start.p);
    workspace.prefer(settings.route);
    workspace.move_to(start.t, start.q, start.u);
    let mut mode = start.mode.cloned().unwrap_or_else(|| workspace.with_row_offsets());
    let spent = std::mem::take(&mut mode.spent);
    let mut system = HybridSystem::new(workspace, mode, start.p);
    system.spent = spent;
    system.rule = settings.impacts;
    system.jam_by_impact = settings.jam_by_impact;
    let mut y = system.pack(start.q, start.u);
    system.freeze_branches(start.t, &y, MOMENT * (until - start.t));
    system.set_scales(start.t, until, &y);
    crate::motion::System::project(&mut system, start.t, &mut y)?;
    system.begin(start, until, &mut y)?;
    if settings.route.is_none() {
        system.record_equations(start.t, &y, settings.marches());
    }
    let opening = system.energy(start.t, &y);
    let run = run(&mut system, integrator, (start.t, &y), until, &settings.options, progress);
    Ok(Trajectory::new(system, run, opening, settings.clone()))
}
