//! What a method must be able to do.

use super::dense::Segment;
use super::norm::Norm;
pub(super) use super::system::Point;
use super::system::{DynamicsError, System};

/// An integration method.
pub struct Method {
    /// Name by which it is asked for.
    pub name: &'static str,
    /// Where it comes from.
    pub citation: &'static str,
    /// Global error is O(hᵖ) with this p.
    pub order: u32,
    /// The dense output adds an error O(hᵖ⁺¹) within a step, with this p.
    pub dense_order: u32,
    /// How the error estimate shrinks with the step, O(hᵏ); `None`: the step is fixed.
    pub estimate_order: Option<u32>,
    /// Needs [`System::canonical`].
    pub symplectic: bool,
    /// Needs [`System::analytic`].
    pub analytic: bool,
    /// The stages are solved for: the control of steps is predictive, and keeps a step for the sake of its factors.
    pub(super) implicit: bool,
    /// The fraction of a step farthest from where the rate is evaluated.
    pub(super) stage_gap: f64,
    pub(super) stepper: fn(usize) -> Box<dyn Stepper>,
}

/// Why a step could not be made.
#[derive(Clone, Debug)]
pub(super) enum Failure {
    /// The system refused.
    DynamicsError(DynamicsError),
    /// A rate or a state is infinite or not a number.
    NotFinite,
    /// Newton's iteration of an implicit step did not converge.
    NoConvergence,
}

impl From<DynamicsError> for Failure {
    fn from(error: DynamicsError) -> Self {
        Failure::DynamicsError(error)
    }
}

/// A system whose evaluations are counted and checked.
pub(super) struct Counted<'a> {
    pub system: &'a mut dyn System,
    pub evaluations: usize,
}

impl Counted<'_> {
    pub fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Failure> {
        self.evaluations += 1;
        all_finite(y)?;
        self.system.rate(t, y, dy)?;
        all_finite(dy)
    }

    /// Evaluates the rate of a point in place.
    pub fn rate_of(&mut self, point: &mut Point) -> Result<(), Failure> {
        self.rate(point.t, &point.y, &mut point.dy)
    }

    pub fn flow(&mut self, t: f64, z: &[f64], dz: &mut [f64]) -> Result<(), Failure> {
        self.evaluations += 1;
        all_finite(z)?;
        let canonical = self.system.canonical().expect("checked when the run starts");
        canonical.flow(t, z, dz)?;
        all_finite(dz)
    }
}

/// Refuses infinities and NaN.
pub(super) fn all_finite(values: &[f64]) -> Result<(), Failure> {
    match values.iter().all(|value| value.is_finite()) {
        true => Ok(()),
        false => Err(Failure::NotFinite),
    }
}

/// The working part of a method.
pub(super) trait Stepper {
    /// Steps from `from` to `to.t`, filling `to.y` and `to.dy`, see [`Stepper::rates_end`]; returns the estimated error in
    /// units of the tolerance (accept when ≤ 1).
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, norm: &Norm) -> Result<f64, Failure>;

    /// The length of the step from a point, where the method knows it before the step is made.
    fn reach(&mut self, _system: &mut Counted, _from: &Point, _norm: &Norm) -> Option<f64> {
        None
    }

    /// Whether an attempt leaves the rate at its end; otherwise that is nearly it, and is evaluated once the step is accepted.
    fn rates_end(&self) -> bool {
        true
    }

    /// The dense output of the last attempt, after `to` has been projected.
    fn dense(&mut self, system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure>;

    /// The part of a small change of the state that dies out within a part of the last step; `None` where the method does
    /// not know it.
    fn stiff_part(&self, _change: &[f64]) -> Option<Vec<f64>> {
        None
    }

    /// Whether the last accepted steps look stiff.
    fn is_stiff(&self) -> bool {
        false
    }

    /// Forgets earlier steps, because the state or the law changed.
    fn reset(&mut self) {}
}
