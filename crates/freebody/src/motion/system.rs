//! What an integrator may ask of the thing that moves.

use super::dense::Segment;
pub use crate::error::DynamicsError;

/// How a switching function is watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventSpec {
    /// +1: only when rising through zero as time grows; −1: only when falling; 0: either.
    pub direction: i8,
    /// What its zero is.
    pub role: Role,
    /// Whether an event does more than being reported.
    pub acts: bool,
    /// Side of zero on which it is where the run starts, +1 or −1: a value on the other there is its zero; 0: its value tells.
    pub side: i8,
    /// It is of forces, which are known as well as the motion is; what is of places is kept to round-off.
    pub of_forces: bool,
    /// Physical size of the function: what is below 16 ε of it is zero. 0 when unknown; the
    /// largest value met stands in for it.
    pub scale: f64,
    /// How far below zero a guard may go that begins within as much of it: what was decided so closely is left only where
    /// that is clear.
    pub leeway: f64,
}

/// What the zero of a switching function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// An event: reported, and acted on.
    Event,
    /// A discontinuity of a force law: always acted on and followed by a restart, never reported.
    Discontinuity,
    /// Positive as long as the law in force holds: a value below zero, also at once after a restart, makes it act.
    /// Never reported.
    Guard,
}

impl EventSpec {
    /// An event that counts in a direction.
    pub fn event(direction: i8) -> Self {
        EventSpec { direction, role: Role::Event, acts: false, side: 0, of_forces: false, scale: 0.0, leeway: 0.0 }
    }
    /// A discontinuity.
    pub fn discontinuity() -> Self {
        EventSpec { role: Role::Discontinuity, ..EventSpec::event(0) }
    }
    /// A guard of given physical size.
    pub fn guard(scale: f64) -> Self {
        EventSpec { role: Role::Guard, side: 1, scale, ..EventSpec::event(-1) }
    }
}

/// A zero that an event has used up where a motion ended: one that goes on from there does not see it again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// Its switching function.
    pub index: usize,
    /// The side of zero on which it goes on; 0 where it rests there.
    pub side: i8,
    /// Its value there.
    pub value: f64,
    /// Largest value seen on the way.
    pub size: f64,
}

/// What follows an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum After {
    /// Nothing changed; the motion goes on.
    Continue,
    /// The state or the law changed; the integrator starts afresh.
    Restart,
    /// The run ends here.
    Stop,
}

/// A system dy/dt = f(t, y) of [`System::dim`] equations, with what is known about it beyond f.
pub trait System {
    /// Number of components of y.
    fn dim(&self) -> usize;

    /// Writes dy/dt at (t, y).
    ///
    /// # Errors
    /// A named failure where the rate does not exist. An adaptive method then tries a shorter
    /// step; when that does not help, the run ends with this failure.
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError>;

    /// How many components may change now: those behind rest where they are until an event restarts the motion.
    fn moving(&self) -> usize {
        self.dim()
    }

    /// Brings `y` back onto its invariants; called after each accepted step and at events.
    /// Returns the size of the correction, relative to [`System::scale`].
    ///
    /// # Errors
    /// A named failure when there is no way back; the run ends with it.
    fn project(&mut self, _t: f64, _y: &mut [f64]) -> Result<f64, DynamicsError> {
        Ok(0.0)
    }

    /// A switching function at a state that is first brought onto the invariants; None where it is on them.
    fn switch_value_closed(&mut self, _i: usize, _t: f64, _y: &[f64]) -> Result<Option<f64>, DynamicsError> {
        Ok(None)
    }

    /// Why no step from (t, y) is short enough, where that is known.
    fn dead_end(&mut self, _t: f64, _y: &[f64]) -> Option<DynamicsError> {
        None
    }

    /// Round-off of the rate in the step that was last looked ahead to, relative to [`System::scale`], where it is more than usual.
    fn noise(&self) -> f64 {
        0.0
    }

    /// The time at which the motion, as it goes at (t, y), passes a place where the rate is smooth but cannot be
    /// evaluated accurately, if it goes there. An adaptive method steps across it by its next step from (t, y) where it
    /// comes within the time `reach`, which has the sign of the run.
    fn singular_stage_gap(&mut self, _t: f64, _y: &[f64], _reach: f64) -> Option<f64> {
        None
    }

    /// The longest step after a restart that does not pass over a zero of a switching function which starts at zero,
    /// and soon comes back to it.
    fn horizon(&mut self) -> f64 {
        f64::INFINITY
    }

    /// Writes the physical size of each component (1 rad, a length, a speed …); positive.
    fn scale(&self, out: &mut [f64]) {
        out.fill(1.0);
    }

    /// A physical time of the system, s; positive.
    fn time_scale(&self) -> f64 {
        1.0
    }

    /// Number of switching functions, events and discontinuities together.
    fn switches(&self) -> usize {
        0
    }

    /// Writes the values of all switching functions at (t, y).
    ///
    /// # Errors
    /// A named failure; the run ends with it.
    fn switch_values(&mut self, _t: f64, _y: &[f64], _out: &mut [f64]) -> Result<(), DynamicsError> {
        Ok(())
    }

    /// Writes bounds of all switching functions on a step: a value that each has had since it was zero, and how far it goes from
    /// there at most. False, and nothing is known, where one has no bound.
    fn switch_bounds(&mut self, _on: &Segment, _out: &mut [[f64; 2]]) -> bool {
        false
    }

    /// The switching functions that may come to zero in a step at whose start they have the values `here`.
    fn watched(&mut self, _on: &Segment, _here: &[f64]) -> Vec<usize> {
        (0..self.switches()).collect()
    }

    /// As [`System::switch_values`], but of those alone that are `watched`.
    ///
    /// # Errors
    /// As there.
    fn watched_values(&mut self, t: f64, y: &[f64], _watched: &[usize], out: &mut [f64]) -> Result<(), DynamicsError> {
        self.switch_values(t, y, out)
    }

    /// The value of one switching function at (t, y), where that costs less than all; else none.
    ///
    /// # Errors
    /// As [`System::switch_values`].
    fn switch_value(&mut self, _i: usize, _t: f64, _y: &[f64]) -> Result<Option<f64>, DynamicsError> {
        Ok(None)
    }

    /// Whether events crowd, each of little consequence: they may happen to the state of the dense output, which is less accurate than
    /// a step that ends there, and forces change little from one to the next.
    fn is_crowded(&self) -> bool {
        false
    }

    /// Refuses a state that no switching function lets the motion come to; called at the end of each step that passes
    /// no zero.
    ///
    /// # Errors
    /// A named failure; the run ends with it, before that step.
    fn check(&mut self, _t: f64, _y: &[f64]) -> Result<(), DynamicsError> {
        Ok(())
    }

    /// How switching function `i` is watched.
    fn switch(&self, _i: usize) -> EventSpec {
        EventSpec::event(0)
    }

    /// Whether event `i` counts at (t, y).
    ///
    /// # Errors
    /// A named failure; the run ends with it.
    fn armed(&mut self, _i: usize, _t: f64, _y: &[f64]) -> Result<bool, DynamicsError> {
        Ok(true)
    }

    /// Event `i` happened at (t, y); may change `y` and the system itself, and then answers
    /// [`After::Restart`]. An action that stops the motion at the event must also change the law
    /// that brings it back there: an event that returns within one instant ends the run.
    ///
    /// # Errors
    /// A named failure; the run ends with it.
    fn act(&mut self, _i: usize, _t: f64, _y: &mut [f64]) -> Result<After, DynamicsError> {
        Ok(After::Continue)
    }

    /// Zeros that events have used up in the motion that goes on here.
    fn spent(&self) -> &[Spent] {
        &[]
    }

    /// The Taylor series of the motion; or why it has none, to follow "because".
    fn analytic(&mut self) -> Result<&mut dyn Analytic, &'static str> {
        Err("the system gives no series")
    }

    /// The canonical form, which symplectic methods need; `None` when there is none.
    fn canonical(&mut self) -> Option<&mut dyn Canonical> {
        None
    }
}

/// A motion that has a Taylor series wherever it is.
pub trait Analytic {
    /// Writes the coefficients of the motion through y at t, in powers of the time since: those of each component from order 0
    /// on, one component after the other. Not finite where there are none.
    ///
    /// # Errors
    /// A named failure.
    fn expand(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> Result<(), DynamicsError>;
}

/// The same motion in canonical variables z = (q, p), as many as components of y.
pub trait Canonical {
    /// Writes z at (t, y).
    ///
    /// # Errors
    /// A named failure.
    fn enter(&mut self, t: f64, y: &[f64], z: &mut [f64]) -> Result<(), DynamicsError>;

    /// Writes y at (t, z); inverse of [`Canonical::enter`].
    ///
    /// # Errors
    /// A named failure.
    fn leave(&mut self, t: f64, z: &[f64], y: &mut [f64]) -> Result<(), DynamicsError>;

    /// Hamilton's equations: writes dz/dt = (∂H/∂p, −∂H/∂q).
    ///
    /// # Errors
    /// A named failure.
    fn flow(&mut self, t: f64, z: &[f64], dz: &mut [f64]) -> Result<(), DynamicsError>;
}

/// A time, the state there and its rate.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub t: f64,
    pub y: Vec<f64>,
    pub dy: Vec<f64>,
}

impl Point {
    pub fn new(t: f64, y: &[f64]) -> Self {
        Self { t, y: y.to_vec(), dy: vec![0.0; y.len()] }
    }
}
