//! A mechanism as a system of differential equations with events.

use super::changes::Change;
use super::guards::{GUARDS, RUB_GUARDS};
use super::impacts::Rule;
use crate::balance::{Balance, Observer, Trouble};
use crate::gauges::Law;
use crate::kinematics::{curve_switch, Poses, State};
use crate::mechanism::{Deed, Kink};
use crate::mode::Mode;
use crate::motion::{After, Canonical, Happening, System, Watch};
use crate::plane::Vec2;

/// Independence of the closing rows below which every stage of a step is brought onto the loops.
const DELICATE: f64 = 0.1;

/// A stretch of the motion under one set of parameters and switches.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// When it began, s.
    pub from: f64,
    /// Parameters.
    pub p: Vec<f64>,
    /// Arms of switches.
    pub mode: Mode,
    /// Energy that the change of parameters at its beginning put in, J.
    pub jump: f64,
    /// Energy that impacts and jumps of the velocities at its beginning put in, J: less than nothing for impacts.
    pub blow: f64,
}

/// A mechanism in motion.
pub struct Machine<'m> {
    pub(super) balance: Balance<'m>,
    /// Forces whose work is integrated.
    pub(super) worked: Vec<usize>,
    /// Prescribed motions, whose work is integrated.
    pub(super) driven: Vec<usize>,
    /// Whether the work of friction is integrated.
    pub(super) rubs: bool,
    /// Whether the work of springs of limits is integrated.
    pub(super) presses: bool,
    /// What is done about impacts that the laws leave open.
    pub(super) rule: Rule,
    /// Whether contacts that jam by friction strike, instead of ending the run.
    pub(super) jams_strike: bool,
    /// What has switched.
    pub(super) changes: Vec<Change>,
    /// Of every limit, how it ran after the last step, if it is a taut string.
    pub(super) spans: Vec<Vec<Vec2>>,
    /// The events of the start.
    pub(super) openings: Vec<Happening>,
    /// After the last bounce: what struck and what comes back first, and how long its flight lasts, s.
    pub(super) flight: Option<(Vec<usize>, f64)>,
    /// Sizes of forces, N, and of speeds, m/s.
    pub(super) strength: f64,
    pub(super) speed: f64,
    /// Speed below which there is none, at the instant that is settled, m/s.
    pub(super) still: f64,
    /// Whether touches that are almost one may contradict each other by a little, at the instant that is settled.
    pub(super) rough: bool,
    /// Parameters that events have set.
    pub(super) set: Vec<(usize, f64)>,
    pub(super) stretches: Vec<Stretch>,
    pub(super) worst_gap: f64,
    /// Whether the loops are near a configuration where they lose independence.
    delicate: bool,
    independence: f64,
    scales: Vec<f64>,
    /// Size of a guard, for its round-off.
    grain: f64,
}

impl<'m> Machine<'m> {
    /// A mechanism at given parameters.
    pub fn new(balance: Balance<'m>, p: &[f64]) -> Self {
        let m = balance.m;
        let worked = (0..m.forces.len()).filter(|&f| !m.forces[f].is_conservative());
        let driven = (0..m.drives.len()).filter(|&d| !m.drives[d].coupling);
        let (worked, driven): (Vec<_>, Vec<_>) = (worked.collect(), driven.collect());
        let rubs = !m.rubs.is_empty() || m.limits.iter().any(|limit| limit.friction.is_some());
        let presses = m.limits.iter().any(|limit| limit.soft.is_some());
        let size = 2 * m.freedom() + worked.len() + driven.len() + usize::from(rubs) + usize::from(presses);
        Machine {
            balance,
            worked,
            driven,
            rubs,
            presses,
            rule: Rule::Stop,
            jams_strike: false,
            changes: vec![],
            spans: vec![],
            openings: vec![],
            flight: None,
            strength: 1.0,
            speed: 1.0,
            still: 0.0,
            rough: false,
            set: m.overruled(p),
            stretches: vec![],
            worst_gap: 0.0,
            delicate: false,
            independence: 1.0,
            scales: vec![1.0; size],
            grain: 1.0,
        }
    }

    /// The state vector at the start.
    pub fn pack(&self, q: &[f64], u: &[f64]) -> Vec<f64> {
        let mut y = [q, u].concat();
        y.resize(self.scales.len(), 0.0);
        y
    }

    fn split<'y>(&self, y: &'y [f64]) -> (&'y [f64], &'y [f64]) {
        let n = self.balance.m.freedom();
        (&y[..n], &y[n..2 * n])
    }

    pub(super) fn place(&mut self, t: f64, y: &[f64]) {
        let (q, u) = self.split(y);
        self.balance.place(t, q, u);
    }

    /// Goes to the state on the closed loops that is nearest to y. Close to a singular configuration a motion off
    /// the loops, however little, is accelerated without bound; a motion on them is not.
    fn place_closed(&mut self, t: f64, y: &[f64]) -> Result<(), Trouble> {
        let (q, u) = self.split(y);
        let (mut q, mut u) = (q.to_vec(), u.to_vec());
        self.balance.close(t, &mut q, &u)?;
        self.balance.align(t, &q, &mut u)?;
        self.balance.place(t, &q, &u);
        Ok(())
    }

    /// Freezes every switch at the arm it has now.
    pub fn freeze_arms(&mut self, t: f64, y: &[f64]) {
        self.place(t, y);
        let m = self.balance.m;
        for kink in &m.kinks {
            let value = self.switching(kink);
            if let Kink::Switch(switch, _) = kink {
                self.balance.mode.freeze(*switch, value >= 0.0);
            }
        }
    }

    /// Begins the first stretch of the motion, in the present mode.
    pub fn open(&mut self) {
        self.stretches.clear();
        self.begin_stretch(f64::NEG_INFINITY, 0.0, 0.0);
    }

    pub(super) fn begin_stretch(&mut self, from: f64, jump: f64, blow: f64) {
        let (p, mode) = (self.balance.n.p.clone(), self.balance.mode.clone());
        self.stretches.push(Stretch { from, p, mode, jump, blow });
    }

    /// The function whose zero is a kink, at the present state.
    fn switching(&self, kink: &Kink) -> f64 {
        let at = self.balance.at();
        match kink {
            Kink::Switch(switch, law) => law.switch(*switch, &State(at)),
            Kink::Knot(argument, x) => argument.eval::<f64, _>(&State(at)) - x,
            Kink::Bend(joint, switch) => curve_switch(at.m, at.n, *joint, at.coordinate(*joint, 0), *switch),
        }
    }

    /// Learns the physical sizes of the state's components from the starting state.
    pub fn size_up(&mut self, t: f64, y: &[f64]) {
        self.place(t, y);
        let m = self.balance.m;
        let (n, length) = (m.freedom(), self.balance.length);
        let gravity = self.balance.n.gravity.norm();
        let (q, u) = self.split(y);
        let unit = |i: usize| if m.coordinate(i).dimension == "m" { length } else { 1.0 };
        let fastest = (0..n).map(|i| u[i].abs() / unit(i)).fold((gravity / length).sqrt(), f64::max);
        let pace = if fastest > 0.0 { fastest } else { 1.0 };
        let mut scales: Vec<f64> = (0..n).map(|i| unit(i).max(q[i].abs())).collect();
        scales.extend((0..n).map(|i| unit(i) * pace));
        let mass: f64 = self.balance.n.mass.iter().sum::<f64>() + self.balance.n.inertia[1..].iter().sum::<f64>();
        let energy = (mass.max(1e-300) * length * pace * length * pace).max(self.balance.kinetic_energy());
        scales.resize(self.scales.len(), energy);
        // A gap is told to the round-off of places.
        let far = |i: usize| if m.coordinate(i).dimension == "m" { q[i].abs() / length } else { 0.0 };
        self.grain = 4.0 * (0..n).map(far).fold(1.0, f64::max);
        self.scales = scales;
        self.speed = length * pace;
        self.strength = energy / length;
    }

    /// Kinetic and potential energy at a state.
    pub fn energy(&mut self, t: f64, y: &[f64]) -> [f64; 2] {
        self.place(t, y);
        [self.balance.kinetic_energy(), self.balance.potential_energy()]
    }

    /// Values of laws at a state.
    pub(super) fn read(&mut self, laws: &[&Law], t: f64, y: &[f64]) -> Result<Vec<f64>, Trouble> {
        let works = self.works(y);
        let (q, u) = (y[..self.balance.m.freedom()].to_vec(), self.split(y).1.to_vec());
        let mut observer = Observer::new(&mut self.balance, laws.iter().copied());
        observer.place(t, &q, &u)?;
        Ok(observer.read(laws, &works))
    }

    /// The works in the state vector, spread over all forces, then all drives, then that of friction.
    pub(super) fn works(&self, y: &[f64]) -> Vec<f64> {
        let m = self.balance.m;
        let mut works = vec![0.0; m.forces.len() + m.drives.len() + 1];
        let tail = &y[2 * m.freedom()..];
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
}

impl System for Machine<'_> {
    fn dim(&self) -> usize {
        self.scales.len()
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        if self.balance.mode.resting {
            dy.fill(0.0);
            return Ok(());
        }
        if self.delicate {
            self.place_closed(t, y)?;
        } else {
            self.place(t, y);
        }
        self.check_spans()?;
        self.balance.solve()?;
        dy[..n].copy_from_slice(self.balance.at().u);
        self.balance.accelerations(&mut dy[n..2 * n]);
        for (i, &f) in self.worked.iter().enumerate() {
            dy[2 * n + i] = crate::balance::unaccounted_power(self.balance.at(), f);
        }
        if !self.driven.is_empty() {
            let powers = self.balance.drive_powers();
            for (i, &d) in self.driven.iter().enumerate() {
                dy[2 * n + self.worked.len() + i] = powers[d];
            }
        }
        if self.rubs {
            dy[2 * n + self.worked.len() + self.driven.len()] = self.balance.friction_power();
        }
        if self.presses {
            dy[self.scales.len() - 1] = self.balance.pressed_power();
        }
        Ok(())
    }

    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<f64, Trouble> {
        if !self.balance.is_closed() || self.balance.mode.resting {
            return Ok(0.0);
        }
        let n = self.balance.m.freedom();
        let (q, rest) = y.split_at_mut(n);
        let moved = self.balance.close(t, q, &rest[..n])?;
        self.worst_gap = self.worst_gap.max(self.balance.worst_gap());
        self.independence = self.balance.independence();
        self.delicate = self.independence < DELICATE;
        let turned = self.balance.align(t, q, &mut rest[..n])?;
        self.note_spans();
        let pace = self.scales.get(n).zip(self.scales.first()).map_or(1.0, |(u, q)| u / q);
        Ok(moved.max(turned / pace))
    }

    /// A gap of round-off size is a rate error of its size over the independence cubed: once for the positions, once for
    /// the velocities, once for the accelerations that close it. Within a step the independence may fall to a third.
    fn noise(&self) -> f64 {
        if self.delicate {
            100.0 * f64::EPSILON / (self.independence * self.independence * self.independence)
        } else {
            0.0
        }
    }

    /// When the loops lose independence, from how fast they do so now.
    fn blind_spot(&mut self, t: f64, y: &[f64]) -> Option<f64> {
        if !self.delicate {
            return None;
        }
        let n = self.balance.m.freedom();
        let fastest = (0..n).map(|i| (y[n + i] / self.scales[i]).abs()).fold(0.0, f64::max);
        let dt = 1e-3 * DELICATE / fastest;
        let mut independence = |t: f64, y: &[f64]| {
            self.place(t, y);
            self.balance.take_rows();
            self.balance.independence()
        };
        let ahead: Vec<f64> = (0..y.len()).map(|i| if i < n { y[i] + dt * y[n + i] } else { y[i] }).collect();
        let (now, next) = (independence(t, y), independence(t + dt, &ahead));
        let when = now * dt / (now - next);
        (when > 0.0 && when.is_finite()).then_some(t + when)
    }

    /// Twice the first flight after a bounce.
    fn horizon(&mut self) -> f64 {
        self.flight.as_ref().map_or(f64::INFINITY, |(_, flight)| 2.0 * flight)
    }

    fn scale(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.scales);
    }

    fn switches(&self) -> usize {
        let m = self.balance.m;
        m.events.len() + m.kinks.len() + GUARDS * m.limits.len() + RUB_GUARDS * m.rubs.len()
    }

    fn switch_values(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Trouble> {
        let m = self.balance.m;
        let laws: Vec<&Law> = m.events.iter().map(|e| &e.when).collect();
        let values = if laws.is_empty() { vec![] } else { self.read(&laws, t, y)? };
        out[..values.len()].copy_from_slice(&values);
        if !m.kinks.is_empty() {
            self.place(t, y);
            for (i, kink) in m.kinks.iter().enumerate() {
                out[m.events.len() + i] = self.switching(kink);
            }
        }
        if !(m.limits.is_empty() && m.rubs.is_empty()) {
            self.guard_values(t, y, &mut out[m.events.len() + m.kinks.len()..])?;
        }
        Ok(())
    }

    fn switch_value(&mut self, i: usize, t: f64, y: &[f64]) -> Result<Option<f64>, Trouble> {
        let first = self.balance.m.events.len() + self.balance.m.kinks.len();
        Ok(i.checked_sub(first).and_then(|guard| self.guard_value(guard, t, y)))
    }

    fn check(&mut self, t: f64, y: &[f64]) -> Result<(), Trouble> {
        if self.balance.m.limits.is_empty() {
            return Ok(());
        }
        self.place(t, y);
        self.balance.check_gaps(t)
    }

    fn switch(&self, i: usize) -> Watch {
        let m = self.balance.m;
        match m.events.get(i) {
            Some(event) => Watch { is_positive: event.guard, ..Watch::event(event.direction) },
            None if i < m.events.len() + m.kinks.len() => Watch::kink(),
            None => Watch::guard(self.grain),
        }
    }

    fn armed(&mut self, i: usize, t: f64, y: &[f64]) -> Result<bool, Trouble> {
        let m = self.balance.m;
        if m.events.get(i).is_some_and(|event| event.guard && self.is_spent(event)) {
            return Ok(false);
        }
        let Some(condition) = m.events.get(i).and_then(|e| e.condition.as_ref()) else { return Ok(true) };
        Ok(self.read(&[condition.as_expr()], t, y)?[0] > 0.5)
    }

    fn act(&mut self, i: usize, t: f64, y: &mut [f64]) -> Result<After, Trouble> {
        let m = self.balance.m;
        let Some(event) = m.events.get(i) else {
            match m.kinks.get(i - m.events.len()) {
                Some(kink) => self.turn(kink, t),
                None => {
                    let guard = i - m.events.len() - m.kinks.len();
                    match guard.checked_sub(GUARDS * m.limits.len()) {
                        None => self.switch_limit(guard / GUARDS, guard % GUARDS, t, y)?,
                        Some(rub) => self.switch_rub(rub / RUB_GUARDS, rub % RUB_GUARDS, t, y)?,
                    }
                }
            }
            return Ok(After::Restart);
        };
        let changed = self.happen(event, t, y)?;
        let stops = event.then.iter().any(|d| matches!(d, Deed::Stop));
        Ok(match (stops, changed) {
            (true, _) => After::Stop,
            (_, false) => After::Continue,
            _ => After::Restart,
        })
    }

    fn canonical(&mut self) -> Option<&mut dyn Canonical> {
        if self.balance.is_closed() || !self.worked.is_empty() {
            return None;
        }
        Some(self)
    }
}
