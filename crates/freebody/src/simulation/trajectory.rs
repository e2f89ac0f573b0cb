//! What is kept of a run, and how it is read.

use super::changes::Change;
use super::machine::Stretch;
use super::{Machine, Settings};
use crate::balance::{Balance, Freedom, Instant, Observer, Route, Trouble};
use crate::gauges::Law;
use crate::mechanism::Mechanism;
use crate::mode::Mode;
use crate::motion::{Happening, Outcome, Run};

/// A finished run with dense output.
pub struct Trajectory {
    /// Times of the accepted steps, first and last included.
    pub steps: Vec<f64>,
    /// What happened on the way.
    pub events: Vec<Happening>,
    /// How it ended.
    pub outcome: Outcome,
    /// Accepted and rejected steps, rate evaluations.
    pub counts: [usize; 3],
    /// Number of kinks of force laws passed.
    pub kinks: usize,
    /// When the explicit method first looked stiff.
    pub stiff_since: Option<f64>,
    /// Largest gap of a loop after a step, relative to the characteristic length.
    pub worst_gap: f64,
    /// What was chosen.
    pub settings: Settings,
    /// What switched on the way.
    pub changes: Vec<Change>,
    rubs: bool,
    presses: bool,
    run: Run,
    stretches: Vec<Stretch>,
    opening: [f64; 2],
    worked: Vec<usize>,
    driven: Vec<usize>,
}

/// The energy ledger: columns and their values at each time, J.
pub struct Ledger {
    /// Names of the columns.
    pub names: Vec<String>,
    /// One row for each time.
    pub rows: Vec<Vec<f64>>,
}

impl Trajectory {
    pub(super) fn new(machine: Machine, run: Run, opening: [f64; 2], settings: Settings) -> Self {
        let segments = &run.trajectory.segments;
        let mut changes = machine.changes;
        // The end of a series of bounces is told after what it brought about.
        changes.sort_by(|a, b| a.t.total_cmp(&b.t));
        let mut steps: Vec<f64> = segments.iter().map(|s| s.t0).collect();
        steps.push(run.t);
        Trajectory {
            steps,
            events: machine.openings.into_iter().chain(run.events.iter().cloned()).collect(),
            outcome: run.outcome.clone(),
            counts: [run.accepted, run.rejected, run.evaluations],
            kinks: run.kinks,
            stiff_since: run.stiff_since,
            worst_gap: machine.worst_gap,
            settings,
            stretches: machine.stretches,
            opening,
            rubs: machine.rubs,
            presses: machine.presses,
            changes,
            worked: machine.worked,
            driven: machine.driven,
            run,
        }
    }

    /// The last good time and the state then: t, q, u, parameters.
    pub fn end(&self, m: &Mechanism) -> (f64, Vec<f64>, Vec<f64>, Vec<f64>) {
        let n = m.freedom();
        let y = &self.run.y;
        (self.run.t, y[..n].to_vec(), y[n..2 * n].to_vec(), self.stretches[self.stretches.len() - 1].p.clone())
    }

    /// What is in place and holds at the end: a motion that goes on from there starts with it.
    pub fn end_mode(&self) -> &Mode {
        &self.stretches[self.stretches.len() - 1].mode
    }

    fn stretch(&self, t: f64) -> &Stretch {
        let later = self.stretches.partition_point(|s| s.from <= t);
        &self.stretches[later.max(1) - 1]
    }

    /// A balance with the parameters of a time; made anew only where they change.
    fn balance_at<'m>(&self, m: &'m Mechanism, t: f64, last: &mut Option<(f64, Balance<'m>)>) {
        let stretch = self.stretch(t);
        if last.as_ref().is_some_and(|(from, _)| *from == stretch.from) {
            return;
        }
        let mut balance = Balance::new(m, &stretch.p);
        balance.mode = stretch.mode.clone();
        *last = Some((stretch.from, balance));
    }

    /// Goes through times: `visit` is given a balance placed on the closed loops, with the whole state vector.
    fn each<'m>(
        &self,
        m: &'m Mechanism,
        times: &[f64],
        mut visit: impl FnMut(&mut Balance<'m>, f64, &[f64]) -> Result<(), Trouble>,
    ) -> Result<(), Trouble> {
        let n = m.freedom();
        let mut y = vec![0.0; self.run.y.len()];
        let mut last = None;
        for &t in times {
            if t == self.run.t {
                // After what happened there.
                y.copy_from_slice(&self.run.y);
            } else if !self.run.trajectory.at(t, &mut y) {
                let (first, end) = (self.steps[0], self.run.t);
                return Err(Trouble::new(
                    "out_of_range",
                    format!("t = {t} s is outside the run, {first} s to {end} s"),
                ));
            }
            self.balance_at(m, t, &mut last);
            let (_, balance) = last.as_mut().expect("made above");
            if balance.is_closed() && !balance.mode.resting {
                let (q, rest) = y.split_at_mut(n);
                balance.close(t, q, &rest[..n])?;
                balance.align(t, q, &mut rest[..n])?;
            }
            balance.place(t, &y[..n], &y[n..2 * n]);
            visit(balance, t, &y)?;
        }
        Ok(())
    }

    /// Coordinates and rates at times, on the closed loops.
    ///
    /// # Errors
    /// `out_of_range`; `branch_lost`.
    pub fn sample(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<f64>>, Trouble> {
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
    pub fn poses(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<[f64; 3]>>, Trouble> {
        let bodies = m.listed_bodies();
        let mut rows = vec![];
        self.each(m, times, |balance, _, _| {
            rows.push(bodies.iter().map(|&b| balance.frame(b)).collect());
            Ok(())
        })?;
        Ok(rows)
    }

    /// Reactions (Fx, Fy, M) of every joint with whether they are determinate, at times.
    ///
    /// # Errors
    /// As [`Trajectory::sample`], and what keeps an instant from being solved.
    #[allow(clippy::type_complexity)]
    pub fn reactions(&self, m: &Mechanism, times: &[f64]) -> Result<Vec<Vec<([f64; 3], [bool; 3])>>, Trouble> {
        let mut rows = vec![];
        self.each(m, times, |balance, _, _| {
            balance.solve()?;
            let sure = balance.labels().joints;
            let loads = balance.joint_loads();
            rows.push(loads.iter().zip(sure).map(|(l, s)| ([l.force.x, l.force.y, l.couple], s)).collect());
            Ok(())
        })?;
        Ok(rows)
    }

    /// Values of expressions at times.
    ///
    /// # Errors
    /// As [`Trajectory::reactions`].
    pub fn evaluate(&self, m: &Mechanism, laws: &[&Law], times: &[f64]) -> Result<Vec<Vec<f64>>, Trouble> {
        let n = m.freedom();
        let mut rows = vec![];
        self.each(m, times, |balance, t, y| {
            let works = self.works(m, y);
            let mut observer = Observer::new(balance, laws.iter().copied());
            observer.place(t, &y[..n], &y[n..2 * n])?;
            rows.push(observer.read(laws, &works));
            Ok(())
        })?;
        Ok(rows)
    }

    /// Works since the start of all forces without a potential, then of all drives.
    fn works(&self, m: &Mechanism, y: &[f64]) -> Vec<f64> {
        let tail = &y[2 * m.freedom()..];
        let mut works = vec![0.0; m.forces.len() + m.drives.len() + 1];
        if self.rubs {
            works[m.forces.len() + m.drives.len()] = tail[self.worked.len() + self.driven.len()];
        }
        for (i, &f) in self.worked.iter().enumerate() {
            works[f] = tail[i];
        }
        for (i, &d) in self.driven.iter().enumerate() {
            works[m.forces.len() + d] = tail[self.worked.len() + i];
        }
        works
    }

    /// The energy ledger at times: kinetic, potential, each work, changes of parameters, and what is left over.
    ///
    /// # Errors
    /// As [`Trajectory::sample`].
    pub fn ledger(&self, m: &Mechanism, times: &[f64]) -> Result<Ledger, Trouble> {
        let mut names: Vec<String> = vec!["kinetic".into(), "potential".into()];
        names.extend(self.worked.iter().map(|&f| m.forces[f].name.clone()));
        names.extend(self.driven.iter().map(|&d| m.drives[d].name.clone()));
        names.extend(self.rubs.then(|| "friction".to_string()));
        names.extend(self.presses.then(|| "compliant contacts".to_string()));
        names.extend(["parameter changes".into(), "impacts".into(), "balance".into()]);
        let start: f64 = self.opening.iter().sum();
        let mut rows = vec![];
        self.each(m, times, |balance, t, y| {
            let (kinetic, potential) = (balance.kinetic_energy(), balance.potential_energy());
            let works = &y[2 * m.freedom()..];
            let jumps: f64 = self.stretches.iter().filter(|s| s.from <= t).map(|s| s.jump).sum();
            let blows: f64 = self.stretches.iter().filter(|s| s.from <= t).map(|s| s.blow).sum();
            let left = kinetic + potential - start - works.iter().sum::<f64>() - jumps - blows;
            let mut row = vec![kinetic, potential];
            row.extend_from_slice(works);
            row.extend([jumps, blows, left]);
            rows.push(row);
            Ok(())
        })?;
        Ok(Ledger { names, rows })
    }

    /// What `read` finds at one time, with what is in place and holds then.
    ///
    /// # Errors
    /// As [`Trajectory::reactions`]; those of `read`.
    pub fn at<T>(
        &self,
        m: &Mechanism,
        t: f64,
        read: impl Fn(&mut Balance<'_>) -> Result<T, Trouble>,
    ) -> Result<T, Trouble> {
        let mut found = None;
        self.each(m, &[t], |balance, _, _| {
            found = Some(read(balance)?);
            Ok(())
        })?;
        Ok(found.expect("one time was visited"))
    }

    /// What `read` finds during a blow, by its place among `changes`: with the rates before it, and held what was struck.
    ///
    /// # Errors
    /// `no_blow`; those of `read`.
    pub fn at_blow<T>(
        &self,
        m: &Mechanism,
        change: usize,
        read: impl Fn(&mut Balance<'_>) -> Result<T, Trouble>,
    ) -> Result<T, Trouble> {
        let found = self.changes.get(change).and_then(|c| Some((c.t, c.states.as_ref()?, c.impulses.as_ref()?)));
        let Some((t, [before, _], impulses)) = found else {
            return Err(Trouble::new("no_blow", format!("change {change} of the run is no blow")));
        };
        let mut balance = Balance::new(m, &self.stretch(t).p);
        balance.mode = impulses.mode.clone();
        balance.place(t, &before[..m.freedom()], &before[m.freedom()..2 * m.freedom()]);
        read(&mut balance)
    }

    /// Everything about one time, and the degrees of freedom then.
    ///
    /// # Errors
    /// As [`Trajectory::reactions`].
    pub fn instant(&self, m: &Mechanism, t: f64, route: Route) -> Result<(Instant, Freedom), Trouble> {
        self.at(m, t, |balance| Ok((balance.instant(route)?, balance.freedom())))
    }
}
