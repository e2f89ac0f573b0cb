//! The run: step, project, look for events, act, go on.

use super::chatter::Chatter;
use super::dense::Segment;
use super::events::{EventDetector, Kind};
use super::method::{all_finite, Counted, Failure, Method, Point, Stepper};
use super::norm::{first_step, Norm, SMALL_STEP};
use super::outcome::{Outcome, Run};
use super::step_control::StepController;
use super::system::{Role, System};

/// The tightest relative tolerance that is accepted.
pub const TIGHTEST: f64 = 1e-14;
/// Steps within which one is laid astride a singular place: this one, or the next, so that it fits without a short one.
const REACH: f64 = 1.5;
/// Steps within which the end of a run is reached by the next one: none is left that is only round-off long.
const LAST: f64 = 1.0 + 1e-6;
/// Part of its gap by which a step across a singular place may be short: less than a rejection shortens, lest the same step be
/// tried again.
const SHORT_OF_GAP: f64 = 1.05;
/// Change of a step that could not be made, where nothing tells by how much it was too long,
pub(super) const FAILED: f64 = 0.25;
/// and where Newton's method did not converge: its error grows with the step.
const NOT_CONVERGED: f64 = 0.5;
/// Projections at the end of a step that leave out what is stiff; where the last one is not down to round-off it is kept whole,
const PROJECTIONS: usize = 3;
/// of this size, relative to the physical sizes.
const PROJECTED: f64 = 1e-13;

/// What may be chosen about a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Relative tolerance of every component, at least 1e-14; not used with a fixed step.
    pub rtol: f64,
    /// Length of the first step, or of every step of a method with a fixed one, which needs it.
    pub first_step: Option<f64>,
    /// Longest step allowed; positive.
    pub max_step: f64,
    /// Largest number of steps, rejected ones included.
    pub max_steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { rtol: 1e-9, first_step: None, max_step: f64::INFINITY, max_steps: 1_000_000 }
    }
}

/// Integrates `system` from `y0` at `t0` to `t_end`, forward or backward.
///
/// `progress` is called with the time after each step; the run ends when it returns false.
/// A zero of an event at `t0` does not count; the event happens when its function comes back.
/// Failures are outcomes: the run then holds everything up to the last good time.
///
/// # Panics
/// When `y0` does not have [`System::dim`] components.
pub fn run(
    system: &mut dyn System,
    method: &Method,
    (t0, y0): (f64, &[f64]),
    t_end: f64,
    options: &Options,
    progress: &mut dyn FnMut(f64) -> bool,
) -> Run {
    assert_eq!(y0.len(), system.dim(), "y0 must have one value per component of the system");
    let mut follower = Runner::new(system, method, (t0, y0), t_end, options);
    let outcome = match follower.start(method, options) {
        Err(outcome) => outcome,
        Ok(()) => loop {
            if let Err(outcome) = follower.advance(options, progress) {
                break outcome;
            }
        },
    };
    follower.finish(outcome)
}

pub(super) struct Runner<'a> {
    pub system: Counted<'a>,
    pub stepper: Box<dyn Stepper>,
    pub detector: EventDetector,
    pub norm: Norm,
    pub steps: StepController,
    estimate_order: Option<u32>,
    /// Where a step may hold a blind spot of the system, and when the next one comes.
    singular_stage: (f64, Option<f64>),
    pub now: Point,
    /// End of the step being made.
    pub next: Point,
    pub t_end: f64,
    /// +1 or −1, as the run goes forward or backward.
    pub ahead: f64,
    /// The end of the step before its projection, and before the last round of it.
    before: Vec<f64>,
    from: Vec<f64>,
    pub run: Run,
    pub chatter: Chatter,
}

impl<'a> Runner<'a> {
    fn new(
        system: &'a mut dyn System,
        method: &Method,
        (t0, y0): (f64, &[f64]),
        t_end: f64,
        options: &Options,
    ) -> Self {
        let now = Point::new(t0, y0);
        Self {
            stepper: (method.stepper)(y0.len()),
            chatter: Chatter::new(system.time_scale()),
            detector: EventDetector::new(system, method.estimate_order.map_or(0.0, |_| options.rtol)),
            norm: Norm::new(system, options.rtol),
            steps: StepController::new(method.estimate_order, method.implicit, options.max_step),
            estimate_order: method.estimate_order,
            singular_stage: (method.stage_gap, None),
            next: now.clone(),
            t_end,
            ahead: (t_end - t0).signum(),
            before: vec![],
            from: vec![],
            run: Run::new(&now),
            now,
            system: Counted { system, evaluations: 0 },
        }
    }

    fn start(&mut self, method: &Method, options: &Options) -> Result<(), Outcome> {
        self.refuse(method, options)?;
        self.system.rate_of(&mut self.now).map_err(ending)?;
        match options.first_step {
            Some(h) => self.steps.restart(h.abs() * self.ahead),
            None => self.restart_steps(),
        }
        self.look_ahead();
        self.go_on_from_zeros()
    }

    /// What the method cannot do, by name.
    fn refuse(&mut self, method: &Method, options: &Options) -> Result<(), Outcome> {
        let refused = |reason: &str| Err(Outcome::Unsupported { method: method.name, reason: reason.into() });
        if method.symplectic && self.system.system.canonical().is_none() {
            return refused("the system has no canonical form");
        }
        if method.analytic {
            let analytic = self.system.system.analytic().map(drop);
            analytic
                .or_else(|why| refused(&format!("{why}; the method `{}` does not mind", super::METHODS[0].name)))?;
        }
        if self.steps.is_fixed() && options.first_step.is_none() {
            return refused("its step is fixed and first_step is not given");
        }
        if self.t_end.is_nan() || options.first_step.is_some_and(|h| h == 0.0 || !h.is_finite()) {
            return refused("the end time or the first step is not a number to step by");
        }
        if options.max_step.is_nan() || options.max_step <= 0.0 {
            return refused("the longest step allowed is not positive");
        }
        let is_too_tight = options.rtol.is_nan() || options.rtol < TIGHTEST;
        if !self.steps.is_fixed() && is_too_tight {
            return Err(Outcome::ToleranceTooTight { rtol: options.rtol });
        }
        all_finite(&self.now.y).map_err(ending)
    }

    /// Chooses the step anew, as at the start.
    pub fn restart_steps(&mut self) {
        let Some(order) = self.estimate_order else { return };
        let (left, most) = (self.t_end - self.now.t, self.system.system.horizon());
        let system = &mut self.system;
        let h = first_step(&self.norm, &self.now, left, order, |t, y, dy| system.rate(t, y, dy));
        // Where even the trial fails, the first steps are rejected until they fit.
        let h = h.ok().filter(|&h| h != 0.0).unwrap_or(left.signum() * SMALL_STEP * self.norm.time);
        self.steps.restart(h.clamp(-most, most));
    }

    /// One accepted step, or the part of it up to an event.
    fn advance(&mut self, options: &Options, progress: &mut dyn FnMut(f64) -> bool) -> Result<(), Outcome> {
        if self.now.t == self.t_end {
            self.act_at_end()?;
            return Err(Outcome::Completed);
        }
        let error = self.accept(options)?;
        let natural = self.natural_step();
        let segment = self.segment()?;
        let marks = self.search(&segment)?;
        if natural {
            self.steps.accepted(error);
        }
        if marks.iter().any(|mark| mark.kind == Kind::Crossing) {
            self.go_to_event(segment, &marks)?;
        } else {
            if !self.detector.is_clear {
                self.system.system.check(segment.t1, &self.next.y).map_err(Outcome::DynamicsError)?;
            }
            self.note_touches(&segment, &marks, segment.t1);
            self.note_unresolved(&segment, segment.t1);
            self.push(segment);
            self.detector.pass();
        }
        match progress(self.now.t) {
            true => Ok(()),
            false => Err(Outcome::Interrupted),
        }
    }

    /// Tries steps until one is accurate enough and has a rate at its end; returns its error.
    fn accept(&mut self, options: &Options) -> Result<f64, Outcome> {
        let mut cause = Outcome::StepUnderflow;
        let is_given = options.first_step.is_some() && self.run.accepted == 0;
        if let Some(h) = self.stepper.reach(&mut self.system, &self.now, &self.norm).filter(|_| !is_given) {
            self.steps.propose(h * self.ahead);
        }
        loop {
            self.check_steps(options.max_steps)?;
            self.next.t = self.target();
            let h = self.next.t - self.now.t;
            if h.abs() < 4.0 * f64::EPSILON * self.now.t.abs() && self.next.t != self.t_end || h == 0.0 {
                let known = self.system.system.dead_end(self.now.t, &self.now.y);
                let known = known.map(Outcome::DynamicsError).or_else(|| self.stuck_law());
                return Err(known.filter(|_| cause == Outcome::StepUnderflow).unwrap_or(cause));
            }
            let mut made = self.stepper.attempt(&mut self.system, &self.now, &mut self.next, &self.norm);
            if made.as_ref().is_ok_and(|&error| error <= 1.0) {
                match self.project()? {
                    Ok(()) => return made.map_err(ending),
                    Err(failure) => made = Err(failure),
                }
            }
            match made {
                Ok(error) if error.is_finite() => {
                    cause = Outcome::StepUnderflow;
                    self.steps.rejected(h, error);
                }
                Ok(_) => self.steps.failed(h, FAILED),
                Err(failure) if self.steps.is_fixed() => return Err(ending(failure)),
                Err(failure) => {
                    self.steps
                        .failed(h, if matches!(failure, Failure::NoConvergence) { NOT_CONVERGED } else { FAILED });
                    cause = ending(failure);
                }
            }
            self.run.rejected += 1;
        }
    }

    /// A law that has just taken another branch and, as no step is short enough for it, goes back.
    fn stuck_law(&self) -> Option<Outcome> {
        let latest = self.chatter.latest(self.now.t);
        let index = latest.filter(|&index| self.system.system.switch(index).role == Role::Discontinuity)?;
        Some(Outcome::Chatter { index })
    }

    /// End of the next step: the end of the run when it is in reach.
    fn target(&self) -> f64 {
        end_of_step(self.now.t, self.t_end, self.step_across())
    }

    /// The step that the pace asks for, or where a blind spot comes near one that takes it, or the next step, into its
    /// gap.
    fn step_across(&self) -> f64 {
        let (gap, Some(spot)) = self.singular_stage else { return self.steps.h };
        let (h, later) = (self.steps.h, spot - self.now.t);
        if self.steps.is_fixed() || later * h <= 0.0 || later.abs() > REACH * h.abs() {
            return h;
        }
        match later.abs() <= SHORT_OF_GAP * gap * h.abs() {
            true => later / gap,
            false => later - gap * h,
        }
    }

    /// Whether the step just made was as long as the pace asked for.
    fn natural_step(&self) -> bool {
        (self.next.t - self.now.t).abs() > 0.5 * self.steps.h.abs()
    }

    /// Ends the run when it has, or will have, too many steps.
    fn check_steps(&mut self, allowed: usize) -> Result<(), Outcome> {
        let left = allowed.saturating_sub(self.run.accepted + self.run.rejected);
        if self.stepper.is_stiff() {
            self.run.stiff_since.get_or_insert(self.now.t);
            if (self.t_end - self.now.t).abs() > left as f64 * self.steps.h.abs() {
                return Err(Outcome::StiffSuspected);
            }
        }
        match left {
            0 => Err(Outcome::TooManySteps { steps: allowed }),
            _ => Ok(()),
        }
    }

    /// Projects the end of the step onto the invariants, but not along what is stiff: even round-off of a loop is a
    /// vibration there, which the next step would have to follow. Answers with the failure of the rate there, if it has none.
    pub fn project(&mut self) -> Result<Result<(), Failure>, Outcome> {
        self.before.clone_from(&self.next.y);
        for round in 1..=PROJECTIONS {
            self.from.clone_from(&self.next.y);
            let system = &mut *self.system.system;
            let correction = system.project(self.next.t, &mut self.next.y).map_err(Outcome::DynamicsError)?;
            self.run.largest_correction = self.run.largest_correction.max(correction);
            if round == 1 && self.next.y == self.before {
                break;
            }
            if round == PROJECTIONS && correction > PROJECTED {
                break;
            }
            let change: Vec<f64> = self.next.y.iter().zip(&self.from).map(|(to, from)| to - from).collect();
            let Some(stiff) = self.stepper.stiff_part(&change) else { break };
            self.next.y.iter_mut().zip(stiff).for_each(|(y, stiff)| *y -= stiff);
            if correction <= PROJECTED {
                break;
            }
        }
        if self.next.y != self.before || !self.stepper.rates_end() {
            return Ok(self.system.rate_of(&mut self.next));
        }
        Ok(Ok(()))
    }

    pub fn segment(&mut self) -> Result<Segment, Outcome> {
        self.stepper.dense(&mut self.system, &self.now, &self.next).map_err(ending)
    }

    /// Makes the end of the step the present.
    pub fn push(&mut self, segment: Segment) {
        self.run.trajectory.segments.push(segment);
        self.run.accepted += 1;
        std::mem::swap(&mut self.now, &mut self.next);
        self.look_ahead();
    }

    /// Learns what the next step may go across.
    pub fn look_ahead(&mut self) {
        let (system, reach) = (&mut *self.system.system, REACH * self.steps.h);
        self.singular_stage.1 = system.singular_stage_gap(self.now.t, &self.now.y, reach);
        self.norm.noise = system.noise();
    }

    fn finish(mut self, outcome: Outcome) -> Run {
        let spent = self.spent();
        Run { outcome, t: self.now.t, y: self.now.y, evaluations: self.system.evaluations, spent, ..self.run }
    }
}

/// End of a step of length `h` from `t`: the end of the run when it is in reach.
#[inline(always)]
pub(super) fn end_of_step(t: f64, t_end: f64, h: f64) -> f64 {
    match (t_end - t).abs() <= LAST * h.abs() {
        true => t_end,
        false => t + h,
    }
}

impl Run {
    fn new(at: &Point) -> Self {
        Self {
            trajectory: Default::default(),
            events: Vec::new(),
            unrecorded: Vec::new(),
            unresolved: Vec::new(),
            spent: Vec::new(),
            outcome: Outcome::Interrupted,
            t: at.t,
            y: at.y.clone(),
            accepted: 0,
            rejected: 0,
            evaluations: 0,
            discontinuities: 0,
            largest_correction: 0.0,
            stiff_since: None,
        }
    }
}

/// The outcome of a failure that a shorter step does not cure.
pub(super) fn ending(failure: Failure) -> Outcome {
    match failure {
        Failure::DynamicsError(error) => Outcome::DynamicsError(error),
        Failure::NotFinite => Outcome::Overflow,
        Failure::NoConvergence => Outcome::StepUnderflow,
    }
}
