//! What is kept of a run, and how it is read.

use super::mode_changes::ModeChange;
use super::system::Phase;
use super::works::Works;
use super::{HybridSystem, Settings};
use crate::dynamics::{reaction_names, DynamicsError, Workspace};
use crate::gauges::ModelExpr;
use crate::mechanism::{Discontinuity, Event, EventAction, Mechanism};
use crate::mode::Mode;
use crate::motion::{EventRecord, Outcome, Run, Unresolved};

/// Parts of a step at which what is only read is looked at.
const LOOKS: [f64; 8] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];
/// Of the time between two looks, to its last digits.
const HALVINGS: usize = 50;

/// Part of the fastest rate by which the rates after an impact may differ from those of an impact whose rows part at −e times
/// their approach: more, and it followed another law.
const SAME_IMPACT: f64 = 1e-8;

/// A finished run with dense output.
pub struct Trajectory {
    /// Times of the accepted steps, first and last included.
    pub steps: Vec<f64>,
    /// What happened on the way.
    pub events: Vec<EventRecord>,
    /// Events that came more often than can be recorded, and since when.
    pub unrecorded: Vec<(usize, f64)>,
    /// What events do by less than the motion is known.
    pub unresolved: Vec<Unresolved>,
    /// How it ended.
    pub outcome: Outcome,
    /// Accepted and rejected steps, rate evaluations.
    pub counts: [usize; 3],
    /// Number of discontinuities of force laws passed.
    pub discontinuities: usize,
    /// When the explicit method first looked stiff.
    pub stiff_since: Option<f64>,
    /// Largest gap of a loop after a step, relative to the characteristic length.
    pub worst_gap: f64,
    /// What was chosen.
    pub settings: Settings,
    /// What switched on the way.
    pub mode_changes: Vec<ModeChange>,
    run: Run,
    phases: Vec<Phase>,
    opening: [f64; 2],
    works: Works,
}

/// A state of a motion, with what it brought along: a motion that starts here goes on with it.
#[derive(Clone, Debug)]
pub struct MotionState {
    /// Parameters.
    pub p: Vec<f64>,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Rates.
    pub u: Vec<f64>,
    /// What is in place and holds.
    pub mode: Mode,
    /// Works since the start as [`Workspace::evaluate`] takes them, J.
    pub works: Vec<f64>,
}

/// The energy ledger: columns and their values at each time, J.
pub struct Ledger {
    /// Names of the columns.
    pub names: Vec<String>,
    /// One row for each time.
    pub rows: Vec<Vec<f64>>,
}

impl Trajectory {
    pub(super) fn new(system: HybridSystem, run: Run, opening: [f64; 2], settings: Settings) -> Self {
        let segments = &run.trajectory.segments;
        let mut changes = system.mode_changes;
        // The end of a series of bounces is recorded after what it brought about.
        changes.sort_by(|a, b| a.t.total_cmp(&b.t));
        let mut steps: Vec<f64> = segments.iter().map(|s| s.t0).collect();
        steps.push(run.t);
        Trajectory {
            steps,
            events: system.initial_events.into_iter().chain(run.events.iter().cloned()).collect(),
            unrecorded: run.unrecorded.clone(),
            unresolved: run.unresolved.clone(),
            outcome: run.outcome.clone(),
            counts: [run.accepted, run.rejected, run.evaluations],
            discontinuities: run.discontinuities,
            stiff_since: run.stiff_since,
            worst_gap: system.worst_gap,
            settings,
            phases: system.phases,
            opening,
            mode_changes: changes,
            works: system.works,
            run,
        }
    }

    /// The state at the end: a motion that goes on from there starts with it.
    pub fn end(&self, m: &Mechanism) -> MotionState {
        let mut end = self.state_of(m, self.run.t, &self.run.y);
        end.mode.spent.clone_from(&self.run.spent);
        end
    }

    /// The state at one time, on the closed loops.
    ///
    /// # Errors
    /// As [`Trajectory::sample`].
    pub fn state(&self, m: &Mechanism, t: f64) -> Result<MotionState, DynamicsError> {
        let mut found = None;
        self.each(m, &[t], |_, t, y| {
            found = Some(self.state_of(m, t, y));
            Ok(())
        })?;
        Ok(found.expect("one time was visited"))
    }

    fn state_of(&self, m: &Mechanism, t: f64, y: &[f64]) -> MotionState {
        let (n, phase) = (m.freedom(), self.phase(t));
        let (q, u, mut p) = (y[..n].to_vec(), y[n..2 * n].to_vec(), phase.p.clone());
        p[m.first_state()..].copy_from_slice(self.states(m, y));
        MotionState { p, t, q, u, mode: phase.mode.clone(), works: self.works.spread(m, y, &phase.given) }
    }

    /// The states with a rate of their own in a state vector.
    fn states<'y>(&self, m: &Mechanism, y: &'y [f64]) -> &'y [f64] {
        &y[2 * m.freedom() + self.works.count()..]
    }

    /// The state during an impact, by its place among `mode_changes`: with the rates before it, and held what took part in
    /// the impact.
    ///
    /// # Errors
    /// `not_an_impact`.
    pub fn state_of_impact(&self, m: &Mechanism, change: usize) -> Result<MotionState, DynamicsError> {
        let found = self.mode_changes.get(change).and_then(|c| Some((c.t, c.states.as_ref()?, c.impulses.as_ref()?)));
        let (t, [before, _], impulses) = found.ok_or(DynamicsError::NotAnImpact(change))?;
        Ok(MotionState { mode: impulses.mode.clone(), ..self.state_of(m, t, before) })
    }

    /// The derivatives of the rates after an impact, given by its place among `mode_changes`, by time, coordinates, rates and
    /// parameters before it; one row for each of these.
    ///
    /// # Errors
    /// `not_an_impact`, `no_impact_derivative`.
    pub fn impact_derivatives(&self, m: &Mechanism, change: usize) -> Result<Vec<Vec<f64>>, DynamicsError> {
        let before = self.state_of_impact(m, change)?;
        let mut workspace = Workspace::new(m, &before.p);
        workspace.place(&before.mode, before.t, &before.q, &before.u);
        let (after, found) = workspace.impact_derivatives(&workspace.unit_directions())?;
        let n = m.freedom();
        let states = self.mode_changes[change].states.as_ref().expect("an impact has both of its states");
        let fastest = states.iter().flat_map(|y| &y[n..2 * n]).fold(0.0_f64, |most, u| most.max(u.abs()));
        if after.iter().zip(&states[1][n..2 * n]).any(|(a, b)| (a - b).abs() > SAME_IMPACT * fastest) {
            return Err(DynamicsError::NoImpactDerivative(before.t));
        }
        Ok(found)
    }

    fn phase(&self, t: f64) -> &Phase {
        let later = self.phases.partition_point(|s| s.from <= t);
        &self.phases[later.max(1) - 1]
    }

    /// Goes through times: `visit` is given a workspace placed on the closed loops, with the whole state vector.
    fn each<'m>(
        &self,
        m: &'m Mechanism,
        times: &[f64],
        mut visit: impl FnMut(&mut Workspace<'m>, f64, &[f64]) -> Result<(), DynamicsError>,
    ) -> Result<(), DynamicsError> {
        let n = m.freedom();
        let mut y = vec![0.0; self.run.y.len()];
        let mut last: Option<(f64, Workspace<'m>)> = None;
        for &t in times {
            if t == self.run.t {
                // After what happened there.
                y.copy_from_slice(&self.run.y);
            } else if !self.run.trajectory.at(t, &mut y) {
                let (first, end) = (self.steps[0], self.run.t);
                return Err(DynamicsError::OutOfRange(t, first, end));
            }
            let phase = self.phase(t);
            // Made anew only where parameters may have changed.
            let known = last.take().filter(|(from, _)| *from == phase.from);
            let (_, workspace) = last.insert(known.unwrap_or_else(|| (phase.from, Workspace::new(m, &phase.p))));
            workspace.set_states(self.states(m, &y));
            workspace.enter(&phase.mode);
            if workspace.is_closed() && !phase.mode.resting {
                let (q, rest) = y.split_at_mut(n);
                workspace.project_positions_with(&phase.mode, t, q, &rest[..n], &phase.locked)?;
                workspace.close_rates(&mut rest[..n])?;
            }
            workspace.place(&phase.mode, t, &y[..n], &y[n..2 * n]);
            visit(workspace, t, &y)?;
        }
        Ok(())
    }

    /// Coordinates and rates at times, on the closed loops.
    ///
    /// # Errors
    /// `out_of_range`; `branch_lost`.
    pub fn sample(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<f64>>, DynamicsError> {
        let mut rows = vec![];
        self.each(m, times, |_, _, y| {
            rows.push(y[..2 * m.freedom()].to_vec());
            Ok(())
        })?;
        Ok(rows)
    }

    /// Frame origin and angle of every body, in the order of the model, at times.
    ///
    /// # Errors
    /// As [`Trajectory::sample`].
    pub fn poses(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<[f64; 3]>>, DynamicsError> {
        let bodies = m.listed_bodies();
        let mut rows = vec![];
        self.each(m, times, |workspace, _, _| {
            rows.push(bodies.iter().map(|&b| workspace.frame(b)).collect());
            Ok(())
        })?;
        Ok(rows)
    }

    /// Coordinates, rates, accelerations, and reactions in the order of [`reaction_names`], at times; of the last two NaN at a singular
    /// place that the motion passes.
    ///
    /// # Errors
    /// As [`Trajectory::sample`], and what keeps an instant from being solved.
    pub fn instants(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<f64>>, DynamicsError> {
        let (n, reactions, mut rows) = (m.freedom(), reaction_names(m).len(), vec![]);
        self.each(m, times, |workspace, _, y| {
            let mut row = y[..2 * n].to_vec();
            row.resize(3 * n + reactions, f64::NAN);
            if passed(workspace.solve_reactions())?.is_some() {
                let (accelerations, reactions) = row[2 * n..].split_at_mut(n);
                workspace.write_solution(accelerations, reactions);
            }
            rows.push(row);
            Ok(())
        })?;
        Ok(rows)
    }

    /// Values of expressions at times; NaN at a singular place that the motion passes.
    ///
    /// # Errors
    /// As [`Trajectory::instants`].
    pub fn evaluate(&self, m: &Mechanism, laws: &[&ModelExpr], times: &[f64]) -> Result<Vec<Vec<f64>>, DynamicsError> {
        let mut rows = vec![];
        self.each(m, times, |workspace, t, y| {
            let values = passed(workspace.evaluate(laws, &self.works.spread(m, y, &self.phase(t).given)))?;
            rows.push(values.unwrap_or_else(|| vec![f64::NAN; laws.len()]));
            Ok(())
        })?;
        Ok(rows)
    }

    /// Tables of laws, curves, events and what is `reported` that were left, each with when first, s.
    ///
    /// # Errors
    /// As [`Trajectory::sample`].
    pub fn tables_left(&self, m: &Mechanism, reported: &[ModelExpr]) -> Result<Vec<(usize, f64)>, DynamicsError> {
        let in_laws = m.discontinuities.iter().filter_map(|discontinuity| match discontinuity {
            Discontinuity::Knot(table, argument, x) if m.tables[*table].knots().next() == Some(*x) => {
                Some((*table, argument.clone()))
            }
            _ => None,
        });
        let read = m.events.iter().flat_map(Event::watched).chain(reported).flat_map(ModelExpr::lookups);
        // Steps end where a law comes to a knot, but not for what is only read.
        let mut left = self.first_beyond(m, in_laws.collect(), &[0.5])?;
        left.extend(self.first_beyond(m, read.collect(), &LOOKS)?);
        for event in &self.events {
            let just_before = (event.t - f64::EPSILON * event.t.abs()).max(self.steps[0]);
            let acting = m.events[event.index].then.iter().filter_map(EventAction::law);
            for (table, argument) in acting.flat_map(ModelExpr::lookups) {
                let x = self.evaluate(m, &[&argument], &[just_before])?[0][0];
                left.extend(m.tables[table].is_beyond(x).then_some((table, event.t)));
            }
        }
        left.sort_by(|a: &(usize, f64), b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        left.dedup_by_key(|(table, _)| *table);
        Ok(left)
    }

    /// When arguments of tables are first beyond their points, looked for at `parts` of every step.
    fn first_beyond(
        &self,
        m: &Mechanism,
        lookups: Vec<(usize, ModelExpr)>,
        parts: &[f64],
    ) -> Result<Vec<(usize, f64)>, DynamicsError> {
        let (tables, arguments): (Vec<usize>, Vec<&ModelExpr>) = lookups.iter().map(|(table, of)| (*table, of)).unzip();
        if tables.is_empty() {
            return Ok(vec![]);
        }
        let within = self.steps.windows(2).flat_map(|ends| parts.iter().map(|x| ends[0] + x * (ends[1] - ends[0])));
        let times: Vec<f64> = self.steps.first().copied().into_iter().chain(within).collect();
        let (rows, mut found) = (self.evaluate(m, &arguments, &times)?, vec![]);
        for (k, &table) in tables.iter().enumerate() {
            let is_beyond = |x: f64| m.tables[table].is_beyond(x);
            let Some(step) = rows.iter().position(|row| is_beyond(row[k])) else { continue };
            let (mut before, mut after) = (times[step.saturating_sub(1)], times[step]);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (before + after);
                let beyond = is_beyond(self.evaluate(m, &arguments[k..=k], &[middle])?[0][0]);
                *(if beyond { &mut after } else { &mut before }) = middle;
            }
            found.push((table, after));
        }
        Ok(found)
    }

    /// The energy ledger at times: kinetic, potential, each work, changes of parameters, and what is left over.
    ///
    /// # Errors
    /// As [`Trajectory::sample`].
    pub fn ledger(&self, m: &Mechanism, times: &[f64]) -> Result<Ledger, DynamicsError> {
        let mut names: Vec<String> = vec!["kinetic".into(), "potential".into()];
        names.extend(self.works.names(m));
        names.extend(["parameter changes".into(), "impacts".into(), "balance".into()]);
        let start: f64 = self.opening.iter().sum();
        let mut rows = vec![];
        self.each(m, times, |workspace, t, y| {
            let (kinetic, potential) = (workspace.kinetic_energy(), workspace.potential_energy());
            let works = &y[2 * m.freedom()..][..self.works.count()];
            let jumps: f64 = self.phases.iter().filter(|s| s.from <= t).map(|s| s.jump).sum();
            let impacts: f64 = self.phases.iter().filter(|s| s.from <= t).map(|s| s.impact).sum();
            let left = kinetic + potential - start - works.iter().sum::<f64>() - jumps - impacts;
            let mut row = vec![kinetic, potential];
            row.extend_from_slice(works);
            row.extend([jumps, impacts, left]);
            rows.push(row);
            Ok(())
        })?;
        Ok(Ledger { names, rows })
    }
}

/// What is found at a time of a motion that went on from there; nothing at a singular place, where round-off makes the rows
/// contradict each other.
fn passed<T>(found: Result<T, DynamicsError>) -> Result<Option<T>, DynamicsError> {
    match found {
        Err(DynamicsError::Contradiction(..) | DynamicsError::Residual(..)) => Ok(None),
        found => found.map(Some),
    }
}
