//! The run: step, project, look for events, act, go on.

use super::dense::Segment;
use super::events::{Kind, Mark, Probe, Watcher};
use super::method::{all_finite, Counted, Failure, Method, Point, Stepper};
use super::norm::{first_step, Norm};
use super::outcome::{Happening, Outcome, Run};
use super::pace::Pace;
use super::system::{After, System};

/// The tightest relative tolerance that is accepted.
const TIGHTEST: f64 = 1e-14;

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
    let mut runner = Runner::new(system, method, (t0, y0), t_end, options);
    let outcome = match runner.start(method, options) {
        Err(outcome) => outcome,
        Ok(()) => loop {
            if let Err(outcome) = runner.advance(options, progress) {
                break outcome;
            }
        },
    };
    runner.finish(outcome)
}

struct Runner<'a> {
    system: Counted<'a>,
    stepper: Box<dyn Stepper>,
    watcher: Watcher,
    norm: Norm,
    pace: Pace,
    estimate_order: Option<u32>,
    now: Point,
    /// End of the step being made.
    next: Point,
    t_end: f64,
    run: Run,
    chatter: Chatter,
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
            watcher: Watcher::new(system),
            norm: Norm::new(system, options.rtol),
            pace: Pace::new(method.estimate_order, method.growth_threshold, options.max_step),
            estimate_order: method.estimate_order,
            next: now.clone(),
            t_end,
            run: Run::new(&now),
            chatter: Chatter { since: t0, count: 0 },
            now,
            system: Counted { system, evaluations: 0 },
        }
    }

    fn start(&mut self, method: &Method, options: &Options) -> Result<(), Outcome> {
        self.refuse(method, options)?;
        self.system.rate_of(&mut self.now).map_err(ending)?;
        match options.first_step {
            Some(h) => self.pace.restart(h.abs() * self.sign()),
            None => self.restart_pace(),
        }
        Ok(())
    }

    /// What the method cannot do, by name.
    fn refuse(&mut self, method: &Method, options: &Options) -> Result<(), Outcome> {
        let refused = |reason| Err(Outcome::Unsupported { method: method.name, reason });
        if method.symplectic && self.system.system.canonical().is_none() {
            return refused("the system has no canonical form");
        }
        if self.pace.is_fixed() && options.first_step.is_none() {
            return refused("its step is fixed and first_step is not given");
        }
        if self.t_end.is_nan() || options.first_step.is_some_and(|h| h == 0.0 || !h.is_finite()) {
            return refused("the end time or the first step is not a number to step by");
        }
        if !(options.max_step > 0.0) {
            return refused("the longest step allowed is not positive");
        }
        if !self.pace.is_fixed() && !(options.rtol >= TIGHTEST) {
            return Err(Outcome::ToleranceTooTight { rtol: options.rtol });
        }
        all_finite(&self.now.y).map_err(ending)
    }

    fn sign(&self) -> f64 {
        (self.t_end - self.now.t).signum()
    }

    /// Chooses the step anew, as at the start.
    fn restart_pace(&mut self) {
        let (Some(order), sign) = (self.estimate_order, self.sign()) else { return };
        let system = &mut self.system;
        let h = first_step(&self.norm, &self.now, sign, order, |t, y, dy| system.rate(t, y, dy));
        // Where even the trial fails, the first steps are rejected until they fit.
        self.pace.restart(h.unwrap_or(sign * 1e-6));
    }

    /// One accepted step, or the part of it up to an event.
    fn advance(
        &mut self,
        options: &Options,
        progress: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), Outcome> {
        if self.now.t == self.t_end {
            return Err(Outcome::Completed);
        }
        let error = self.accept(options)?;
        self.settle()?;
        let segment = self.segment()?;
        let marks = self.search(&segment)?;
        self.pace.accepted(error);
        if marks.iter().any(|mark| mark.kind == Kind::Crossing) {
            self.go_to_event(segment, &marks)?;
        } else {
            self.note_touches(&segment, &marks, segment.t1);
            self.push(segment);
            self.watcher.pass();
        }
        match progress(self.now.t) {
            true => Ok(()),
            false => Err(Outcome::Interrupted),
        }
    }

    /// Tries steps until one is accurate enough; returns its error.
    fn accept(&mut self, options: &Options) -> Result<f64, Outcome> {
        let mut cause = Outcome::StepUnderflow;
        loop {
            self.check_steps(options.max_steps)?;
            self.next.t = self.target();
            let h = self.next.t - self.now.t;
            if h.abs() < 4.0 * f64::EPSILON * self.now.t.abs() && self.next.t != self.t_end
                || h == 0.0
            {
                return Err(cause);
            }
            match self.stepper.attempt(&mut self.system, &self.now, &mut self.next, &self.norm) {
                Ok(error) if error <= 1.0 => return Ok(error),
                Ok(error) if error.is_finite() => {
                    cause = Outcome::StepUnderflow;
                    self.pace.rejected(h, error);
                }
                Ok(_) => self.pace.failed(h),
                Err(failure) if self.pace.is_fixed() => return Err(ending(failure)),
                Err(failure) => {
                    cause = ending(failure);
                    self.pace.failed(h);
                }
            }
            self.run.rejected += 1;
        }
    }

    /// End of the next step: the end of the run when it is in reach.
    fn target(&self) -> f64 {
        match (self.t_end - self.now.t).abs() <= (1.0 + 1e-6) * self.pace.h.abs() {
            true => self.t_end,
            false => self.now.t + self.pace.h,
        }
    }

    /// Ends the run when it has, or will have, too many steps.
    fn check_steps(&mut self, allowed: usize) -> Result<(), Outcome> {
        let left = allowed.saturating_sub(self.run.accepted + self.run.rejected);
        if self.stepper.is_stiff() {
            self.run.stiff_since.get_or_insert(self.now.t);
            if (self.t_end - self.now.t).abs() > left as f64 * self.pace.h.abs() {
                return Err(Outcome::StiffSuspected);
            }
        }
        match left {
            0 => Err(Outcome::TooManySteps { steps: allowed }),
            _ => Ok(()),
        }
    }

    /// Projects the end of the step onto the invariants.
    fn settle(&mut self) -> Result<(), Outcome> {
        let before = self.next.y.clone();
        let system = &mut *self.system.system;
        let correction = system.project(self.next.t, &mut self.next.y).map_err(Outcome::Trouble)?;
        self.run.largest_correction = self.run.largest_correction.max(correction);
        if self.next.y != before {
            self.system.rate_of(&mut self.next).map_err(ending)?;
        }
        Ok(())
    }

    fn segment(&mut self) -> Result<Segment, Outcome> {
        self.stepper.dense(&mut self.system, &self.now, &self.next).map_err(ending)
    }

    /// Makes the end of the step the present.
    fn push(&mut self, segment: Segment) {
        self.run.trajectory.segments.push(segment);
        self.run.accepted += 1;
        std::mem::swap(&mut self.now, &mut self.next);
    }

    /// The zeros on a segment that count, in order.
    fn search(&mut self, segment: &Segment) -> Result<Vec<Mark>, Outcome> {
        if self.watcher.is_idle() {
            return Ok(Vec::new());
        }
        let system = &mut *self.system.system;
        let marks = self.watcher.search(system, segment).map_err(Outcome::Trouble)?;
        let (mut counting, mut y) = (Vec::new(), vec![0.0; self.now.y.len()]);
        for mark in marks {
            let watch = system.switch(mark.index);
            let is_passing = mark.kind == Kind::Touch && watch.is_kink;
            if is_passing || watch.direction * mark.direction < 0 {
                continue;
            }
            segment.at(mark.t, &mut y);
            if system.armed(mark.index, mark.t, &y).map_err(Outcome::Trouble)? {
                counting.push(mark);
            }
        }
        Ok(counting)
    }

    /// Steps to the first crossing of `marks`, lets it act and goes on from there.
    fn go_to_event(&mut self, segment: Segment, marks: &[Mark]) -> Result<(), Outcome> {
        let mut crossings = marks.iter().filter(|mark| mark.kind == Kind::Crossing);
        let first = *crossings.next().expect("the caller saw one");
        let tie = 1e-12 * (1.0 + first.t.abs());
        let together = crossings.filter(|mark| (mark.t - first.t).abs() <= tie);
        let hits: Vec<Mark> = std::iter::once(&first).chain(together).copied().collect();
        self.note_touches(&segment, marks, first.t);
        self.land(&segment, first)?;
        let has_jumped = self.act(&hits)?;
        if has_jumped {
            self.stepper.reset();
            self.system.rate_of(&mut self.now).map_err(ending)?;
            self.restart_pace();
        }
        let values = self.switch_values()?;
        let fired: Vec<usize> = hits.iter().map(|hit| hit.index).collect();
        self.watcher.stop_at(&values, &fired, has_jumped);
        Ok(())
    }

    /// Makes a true step to a zero that was found on the dense output of a longer one, and once
    /// more when the function is not yet zero there.
    fn land(&mut self, segment: &Segment, hit: Mark) -> Result<(), Outcome> {
        let (t0, t1) = (segment.t0.min(segment.t1), segment.t0.max(segment.t1));
        let mut t = hit.t;
        for _ in 0..3 {
            if t == self.now.t {
                return Ok(());
            }
            self.step_to(t)?;
            let mut values = vec![0.0; self.system.system.switches()];
            let system = &mut *self.system.system;
            system.switch_values(t, &self.next.y, &mut values).map_err(Outcome::Trouble)?;
            let slope = Probe::new(system, segment).slope(hit.index, t).map_err(Outcome::Trouble)?;
            let better = (t - values[hit.index] / slope).clamp(t0, t1);
            if !((better - t).abs() > 4.0 * f64::EPSILON * t.abs()) {
                break;
            }
            t = better;
        }
        let landed = self.segment()?;
        self.push(landed);
        Ok(())
    }

    /// Makes a step to `t`, which is known to be short enough.
    fn step_to(&mut self, t: f64) -> Result<(), Outcome> {
        self.next.t = t;
        let attempt = self.stepper.attempt(&mut self.system, &self.now, &mut self.next, &self.norm);
        attempt.map_err(ending)?;
        self.settle()
    }

    /// Lets the events at the present act; whether the state or the law changed.
    fn act(&mut self, hits: &[Mark]) -> Result<bool, Outcome> {
        let (before, mut has_jumped, mut stop) = (self.now.y.clone(), false, None);
        for hit in hits {
            self.chatter.note(self.now.t)?;
            let system = &mut *self.system.system;
            let is_kink = system.switch(hit.index).is_kink;
            let after = system.act(hit.index, self.now.t, &mut self.now.y);
            let after = after.map_err(Outcome::Trouble)?;
            match is_kink {
                true => self.run.kinks += 1,
                false => self.run.events.push(happening(hit, self.now.t, &before)),
            }
            has_jumped |= is_kink || after == After::Restart;
            if after == After::Stop {
                stop.get_or_insert(hit.index);
            }
        }
        all_finite(&self.now.y).map_err(ending)?;
        match stop {
            Some(index) => Err(Outcome::StoppedByEvent { index }),
            None => Ok(has_jumped || self.now.y != before),
        }
    }

    /// Records the touches before time `until`.
    fn note_touches(&mut self, segment: &Segment, marks: &[Mark], until: f64) {
        let start = segment.t0;
        for mark in marks.iter().filter(|mark| mark.kind == Kind::Touch) {
            if (mark.t - start).abs() <= (until - start).abs() {
                let mut y = vec![0.0; self.now.y.len()];
                segment.at(mark.t, &mut y);
                self.run.events.push(happening(mark, mark.t, &y));
            }
        }
    }

    fn switch_values(&mut self) -> Result<Vec<f64>, Outcome> {
        let system = &mut *self.system.system;
        let mut values = vec![0.0; system.switches()];
        system.switch_values(self.now.t, &self.now.y, &mut values).map_err(Outcome::Trouble)?;
        Ok(values)
    }

    fn finish(self, outcome: Outcome) -> Run {
        Run {
            outcome,
            t: self.now.t,
            y: self.now.y,
            evaluations: self.system.evaluations,
            ..self.run
        }
    }
}

impl Run {
    fn new(at: &Point) -> Self {
        Self {
            trajectory: Default::default(),
            events: Vec::new(),
            outcome: Outcome::Interrupted,
            t: at.t,
            y: at.y.clone(),
            accepted: 0,
            rejected: 0,
            evaluations: 0,
            kinks: 0,
            largest_correction: 0.0,
            stiff_since: None,
        }
    }
}

fn happening(mark: &Mark, t: f64, y: &[f64]) -> Happening {
    Happening { t, y: y.to_vec(), index: mark.index, kind: mark.kind, direction: mark.direction }
}

/// The outcome of a failure that a shorter step does not cure.
fn ending(failure: Failure) -> Outcome {
    match failure {
        Failure::Trouble(trouble) => Outcome::Trouble(trouble),
        Failure::NotFinite => Outcome::Overflow,
        Failure::NoConvergence => Outcome::StepUnderflow,
    }
}

/// Guards against events that come ever more densely.
struct Chatter {
    since: f64,
    count: usize,
}

impl Chatter {
    fn note(&mut self, t: f64) -> Result<(), Outcome> {
        if (t - self.since).abs() > 1e-9 {
            *self = Self { since: t, count: 0 };
        }
        self.count += 1;
        match self.count > 10_000 {
            true => Err(Outcome::TooManyEvents),
            false => Ok(()),
        }
    }
}
