//! A mechanism as a system of differential equations with events.

use super::bounds::Neighbourhood;
use super::guards::{leeway, SwitchingFunction, LEEWAY};
use super::impacts::Rule;
use super::mode_changes::ModeChange;
use super::recorded::Motion;
use super::rest::is_pile;
use super::scales::ROUNDOFF;
use super::works::Works;
use crate::dynamics::{DynamicsError, SmoothMotion, Workspace};
use crate::gauges::ModelExpr;
use crate::kinematics::Travel;
use crate::mode::Mode;
use crate::motion::{After, Analytic, Canonical, EventRecord, EventSpec, Segment, Spent, System};
use crate::plane::Vec2;
use crate::series::{Solution, Traced};

/// A phase of the motion under one set of parameters and switches.
#[derive(Clone, Debug)]
pub struct Phase {
    /// When it began, s.
    pub from: f64,
    /// Parameters.
    pub p: Vec<f64>,
    /// What is active in it.
    pub mode: Mode,
    /// The gauges that its locks keep, each at its value.
    pub(super) locked: Vec<(ModelExpr, f64)>,
    /// Energy that the change of parameters, parts or springs in touch at its beginning put in, J.
    pub jump: f64,
    /// Energy that impacts and jumps of the velocities at its beginning put in, J: less than nothing for impacts.
    pub impact: f64,
    /// Energy that the potential of each force was given: what it was at the start and all that changes of parameters and
    /// parts put in since, J. Less what it is now, that is work.
    pub given: Vec<f64>,
}

/// A mechanism in motion.
pub struct HybridSystem<'m> {
    pub(super) workspace: Workspace<'m>,
    pub(super) switching_functions: Vec<SwitchingFunction>,
    /// Whether all switching functions have bounds as long as nothing touches or rubs; how far the bodies go in a step, about
    /// its middle.
    pub(super) may_have_bounds: bool,
    pub(super) travel: Travel,
    /// Where nothing comes near.
    pub(super) neighbourhood: Option<Neighbourhood>,
    pub(super) middle: Vec<f64>,
    /// What is active now.
    pub(super) mode: Mode,
    /// What works are integrated.
    pub(super) works: Works,
    /// What is done about impacts that the laws leave open.
    pub(super) rule: Rule,
    /// Whether contacts that jam by friction jump, instead of ending the run.
    pub(super) jam_by_impact: bool,
    /// What has switched.
    pub(super) mode_changes: Vec<ModeChange>,
    /// Of every unilateral constraint, how it ran after the last step, if it is a taut string.
    pub(super) taut_segments: Vec<Vec<Vec2>>,
    /// The events of the start.
    pub(super) initial_events: Vec<EventRecord>,
    /// Zeros that events have used up in the motion that goes on here.
    pub(super) spent: Vec<Spent>,
    /// After the last bounce: what collided and what comes back first, and how long its flight lasts, s.
    pub(super) bounce_interval: Option<(Vec<usize>, f64)>,
    /// The time of the last collision of every contact, stop and string, s; −∞ before the first.
    pub(super) collided: Vec<f64>,
    /// Sizes of forces, N, and of speeds, m/s.
    pub(super) strength: f64,
    pub(super) speed: f64,
    /// The time in which it moves its own length, or turns by a radian, s.
    pub(super) time: f64,
    /// Parameters that events have set.
    pub(super) set: Vec<(usize, f64)>,
    pub(super) phases: Vec<Phase>,
    /// The locks of the phase, and the gauges that they keep, each at the value where it was locked.
    pub(super) locks: Vec<usize>,
    pub(super) locked: Vec<(ModelExpr, f64)>,
    pub(super) worst_gap: f64,
    /// Whether the step being made begins near, or goes across, a configuration where the loops lose independence.
    pub(super) near_singular: bool,
    /// Independence of the closing rows at the end of the last step; 0 where a phase begins, before it is known.
    pub(super) independence: f64,
    /// The coordinates at which it was found.
    pub(super) independence_at: Vec<f64>,
    /// How many steps in a row have ended next to a singular configuration.
    pub(super) singular_steps: usize,
    pub(super) scales: Vec<f64>,
    /// A large change of each coordinate.
    pub(super) units: Vec<f64>,
    /// Size of a guard, for its round-off.
    pub(super) roundoff_scale: f64,
    /// The Taylor series of the phase with this number.
    pub(super) series: Option<(usize, Solution<f64>)>,
    /// Its equations as a program, where that carries it.
    pub(super) recorded: Option<Motion>,
}

impl<'m> HybridSystem<'m> {
    /// A mechanism at given parameters, in a mode.
    pub fn new(workspace: Workspace<'m>, mode: Mode, p: &[f64]) -> Self {
        let m = workspace.m;
        let works = Works::of(m);
        let size = 2 * m.freedom() + works.count() + m.state_rates.len();
        HybridSystem {
            workspace,
            switching_functions: SwitchingFunction::all(m).collect(),
            may_have_bounds: SwitchingFunction::all(m).all(|function| function.may_have_bound(m)),
            travel: Travel::default(),
            neighbourhood: None,
            middle: vec![],
            mode,
            works,
            rule: Rule::Stop,
            jam_by_impact: false,
            mode_changes: vec![],
            taut_segments: vec![],
            initial_events: vec![],
            spent: vec![],
            bounce_interval: None,
            collided: vec![f64::NEG_INFINITY; m.groups.len()],
            strength: 1.0,
            speed: 1.0,
            time: 1.0,
            set: m.overruled(p),
            phases: vec![],
            locks: vec![],
            locked: vec![],
            worst_gap: 0.0,
            near_singular: false,
            independence: 0.0,
            independence_at: vec![],
            singular_steps: 0,
            scales: vec![1.0; size],
            units: vec![],
            roundoff_scale: 1.0,
            series: None,
            recorded: None,
        }
    }

    /// The state vector at the start.
    pub fn pack(&self, q: &[f64], u: &[f64]) -> Vec<f64> {
        let mut y = [q, u].concat();
        y.resize(self.first_state(), 0.0);
        y.extend(&self.workspace.at().n.p[self.workspace.m.first_state()..]);
        y
    }

    pub(super) fn split<'y>(&self, y: &'y [f64]) -> (&'y [f64], &'y [f64]) {
        let n = self.workspace.m.freedom();
        (&y[..n], &y[n..2 * n])
    }

    /// Where the states with a rate of their own begin in the state vector.
    pub(super) fn first_state(&self) -> usize {
        2 * self.workspace.m.freedom() + self.works.count()
    }

    /// Goes to a state in the mode of the motion.
    pub(super) fn place(&mut self, t: f64, y: &[f64]) {
        let n = self.workspace.m.freedom();
        self.workspace.set_states(&y[self.first_state()..]);
        self.workspace.place(&self.mode, t, &y[..n], &y[n..2 * n]);
    }

    /// Goes to a state in a mode that may become that of the motion.
    pub(super) fn place_in(&mut self, mode: &Mode, t: f64, y: &[f64]) {
        let n = self.workspace.m.freedom();
        self.workspace.set_states(&y[self.first_state()..]);
        self.workspace.place(mode, t, &y[..n], &y[n..2 * n]);
    }

    /// Begins the first phase of the motion, in the present mode, at a state.
    pub fn open(&mut self, t: f64, y: &[f64]) {
        self.place(t, y);
        self.phases.clear();
        self.begin_phase(f64::NEG_INFINITY, 0.0);
    }

    pub(super) fn begin_phase(&mut self, from: f64, impact: f64) {
        let (p, mode) = (self.workspace.at().n.p.clone(), self.mode.clone());
        let given = self.phases.last().map_or_else(|| self.workspace.force_potentials(), |phase| phase.given.clone());
        self.note_locks();
        self.phases.push(Phase { from, p, mode, locked: self.locked.clone(), jump: 0.0, impact, given });
        self.independence = 0.0;
    }

    /// All energy at a state, and the potential of each force in it, J.
    pub(super) fn stored(&mut self, t: f64, y: &[f64]) -> (f64, Vec<f64>) {
        (self.energy(t, y).iter().sum(), self.workspace.force_potentials())
    }

    /// Begins a phase after parameters or parts were changed, and notes the energy that this put in beside that `before`.
    pub(super) fn begin_changed_phase(&mut self, t: f64, y: &[f64], before: (f64, Vec<f64>)) {
        let (energy, potentials) = self.stored(t, y);
        self.begin_phase(t, 0.0);
        let phase = self.phases.last_mut().expect("a phase was begun");
        phase.jump = energy - before.0;
        for (given, (after, before)) in phase.given.iter_mut().zip(potentials.iter().zip(&before.1)) {
            *given += after - before;
        }
    }

    /// Enters the works of drives in an impact; returns what motions put in, J.
    pub(super) fn add_drive_works(&self, y: &mut [f64], works: &[f64]) -> f64 {
        let first = 2 * self.workspace.m.freedom() + self.works.forces.len();
        for (sum, &drive) in y[first..].iter_mut().zip(&self.works.motions) {
            *sum += works[drive];
        }
        self.works.motions.iter().map(|&drive| works[drive]).sum()
    }

    /// A gap is known to the round-off of places and angles, which grows with them.
    pub(super) fn note_roundoff(&mut self, y: &[f64]) {
        let largest = y.iter().zip(&self.units).map(|(q, unit)| q.abs() / unit).fold(1.0, f64::max);
        self.roundoff_scale = self.roundoff_scale.max(ROUNDOFF * largest);
    }

    /// Kinetic and potential energy at a state.
    pub fn energy(&mut self, t: f64, y: &[f64]) -> [f64; 2] {
        self.place(t, y);
        [self.workspace.kinetic_energy(), self.workspace.potential_energy()]
    }

    /// Values of laws at a state.
    pub(super) fn read(&mut self, laws: &[&ModelExpr], t: f64, y: &[f64]) -> Result<Vec<f64>, DynamicsError> {
        self.place(t, y);
        let phase = self.phases.last().expect("a motion has begun its first phase");
        let works = self.works.spread(self.workspace.m, y, &phase.given);
        self.workspace.evaluate(laws, &works)
    }
}

impl System for HybridSystem<'_> {
    fn dim(&self) -> usize {
        self.scales.len()
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
        let (n, states) = (self.workspace.m.freedom(), self.first_state());
        if !self.near_singular
            && self.mode.is_free()
            && self.recorded.as_mut().is_some_and(|motion| motion.write_rates(t, y, dy))
        {
            return Ok(());
        }
        if self.mode.resting {
            dy[..states].fill(0.0);
            if states < dy.len() {
                self.place(t, y);
                self.workspace.write_state_rates(&mut dy[states..]);
            }
            return Ok(());
        }
        self.place(t, y);
        self.solve_stage(t, y)?;
        dy[..n].copy_from_slice(self.workspace.at().u);
        self.workspace.accelerations(&mut dy[n..2 * n]);
        self.works.write_powers(&self.workspace, &mut dy[2 * n..states]);
        self.workspace.write_state_rates(&mut dy[states..]);
        Ok(())
    }

    fn moving(&self) -> usize {
        match self.mode.is_free() && self.first_state() == self.dim() {
            true => 2 * self.workspace.m.freedom() + self.works.count_while_free(),
            false => self.dim(),
        }
    }

    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<f64, DynamicsError> {
        self.workspace.enter(&self.mode);
        if !self.workspace.is_closed() || self.mode.resting {
            self.taut_segments.clear();
            return Ok(0.0);
        }
        let n = self.workspace.m.freedom();
        self.workspace.set_states(&y[self.first_state()..]);
        let (q, rest) = y.split_at_mut(n);
        let moved = self.workspace.project_positions_with(&self.mode, t, q, &rest[..n], &self.locked)?;
        self.worst_gap = self.worst_gap.max(self.workspace.widest_gap());
        let found = self.workspace.independence();
        self.note_independence(found, q);
        let turned = self.workspace.close_rates(&mut rest[..n])?;
        self.note_taut_segments();
        self.check_dead_position(t, y)?;
        let rate = self.scales.get(n).zip(self.scales.first()).map_or(1.0, |(u, q)| u / q);
        Ok(moved.max(turned / rate))
    }

    fn dead_end(&mut self, t: f64, y: &[f64]) -> Option<DynamicsError> {
        self.place(t, y);
        self.wound_up_string()
    }

    fn noise(&self) -> f64 {
        self.stage_noise()
    }

    fn singular_stage_gap(&mut self, t: f64, y: &[f64], reach: f64) -> Option<f64> {
        self.singular_ahead(t, y, reach)
    }

    /// Twice the first flight after a bounce.
    fn horizon(&mut self) -> f64 {
        self.bounce_interval.as_ref().map_or(f64::INFINITY, |(_, flight)| 2.0 * flight)
    }

    fn scale(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.scales);
    }

    fn time_scale(&self) -> f64 {
        self.time
    }

    fn switches(&self) -> usize {
        self.switching_functions.len()
    }

    fn switch_values(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), DynamicsError> {
        let all: Vec<usize> = (0..out.len()).collect();
        self.watched_values(t, y, &all, out)
    }

    fn watched_values(&mut self, t: f64, y: &[f64], watched: &[usize], out: &mut [f64]) -> Result<(), DynamicsError> {
        let m = self.workspace.m;
        self.note_roundoff(y);
        let laws: Vec<&ModelExpr> = m.events.iter().map(|e| &e.when).collect();
        let values = if laws.is_empty() { vec![] } else { self.read(&laws, t, y)? };
        out[..values.len()].copy_from_slice(&values);
        if !m.discontinuities.is_empty() {
            self.place(t, y);
            for (i, discontinuity) in m.discontinuities.iter().enumerate() {
                out[m.events.len() + i] = self.switching(discontinuity);
            }
        }
        if !(m.unilateral.is_empty() && m.joint_friction.is_empty()) {
            self.guard_values(t, y, watched, &mut out[m.events.len() + m.discontinuities.len()..])?;
        }
        Ok(())
    }

    fn switch_bounds(&mut self, on: &Segment, out: &mut [[f64; 2]]) -> bool {
        self.bounds(on, out)
    }

    fn watched(&mut self, on: &Segment, here: &[f64]) -> Vec<usize> {
        self.near_zero(on, here)
    }

    fn switch_value(&mut self, i: usize, t: f64, y: &[f64]) -> Result<Option<f64>, DynamicsError> {
        Ok(match self.switching_functions[i] {
            SwitchingFunction::Contact(l, guard) => self.guard_value(l, guard, t, y),
            _ => None,
        })
    }

    fn switch_value_closed(&mut self, i: usize, t: f64, y: &[f64]) -> Result<Option<f64>, DynamicsError> {
        let SwitchingFunction::Contact(l, guard) = self.switching_functions[i] else { return Ok(None) };
        let (n, mut y) = (self.workspace.m.freedom(), y.to_vec());
        let (q, rest) = y.split_at_mut(n);
        self.workspace.project_positions_with(&self.mode, t, q, &rest[..n], &self.locked)?;
        Ok(self.guard_value(l, guard, t, &y))
    }

    fn is_crowded(&self) -> bool {
        !self.mode.resting && is_pile(self.mode.contacts.iter().filter(|contact| contact.mode.is_closed()).count())
    }

    fn check(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        if self.workspace.m.unilateral.is_empty() {
            return Ok(());
        }
        self.place(t, y);
        self.workspace.check_gaps(t)
    }

    fn switch(&self, i: usize) -> EventSpec {
        match self.switching_functions[i] {
            SwitchingFunction::Event(event) => {
                let event = &self.workspace.m.events[event];
                EventSpec {
                    side: i8::from(event.guard),
                    acts: !event.then.is_empty(),
                    ..EventSpec::event(event.direction)
                }
            }
            SwitchingFunction::Discontinuity(law) => {
                EventSpec { side: self.frozen_side(law), ..EventSpec::discontinuity() }
            }
            SwitchingFunction::Contact(l, guard) => {
                let of_forces = self.is_force(l, guard);
                let leeway = leeway(guard, of_forces);
                EventSpec { of_forces, leeway, ..EventSpec::guard(self.roundoff_scale) }
            }
            SwitchingFunction::JointFriction(..) => {
                EventSpec { leeway: LEEWAY, ..EventSpec::guard(self.roundoff_scale) }
            }
        }
    }

    fn armed(&mut self, i: usize, t: f64, y: &[f64]) -> Result<bool, DynamicsError> {
        let SwitchingFunction::Event(event) = self.switching_functions[i] else { return Ok(true) };
        let event = &self.workspace.m.events[event];
        if event.guard && self.is_spent(event) {
            return Ok(false);
        }
        let Some(condition) = &event.condition else { return Ok(true) };
        Ok(self.read(&[condition.as_expr()], t, y)?[0] > 0.5)
    }

    fn act(&mut self, i: usize, t: f64, y: &mut [f64]) -> Result<After, DynamicsError> {
        let before = self.branch_values(t, y);
        let after = self.act_on(i, t, y)?;
        if !matches!(self.switching_functions[i], SwitchingFunction::Discontinuity(_))
            && self.follow_jump(t, y, &before)
        {
            return Ok(if after == After::Continue { After::Restart } else { after });
        }
        Ok(after)
    }

    fn spent(&self) -> &[Spent] {
        &self.spent
    }

    fn analytic(&mut self) -> Result<&mut dyn Analytic, &'static str> {
        SmoothMotion::<Traced>::obstacle(self.workspace.m).map_or(Ok(self), Err)
    }

    fn canonical(&mut self) -> Option<&mut dyn Canonical> {
        if self.workspace.is_closed()
            || self.workspace.m.is_hybrid()
            || !(self.works.forces.is_empty() && self.workspace.m.state_rates.is_empty())
        {
            return None;
        }
        Some(self)
    }
}
