//! Bounds of switching functions over a whole step: where all stay away nothing needs to be looked for in it.

use super::guards::SwitchingFunction;
use super::HybridSystem;
use crate::gauges::{is_measured, ModelExpr};
use crate::kinematics::{Config, TravelView};
use crate::mechanism::{Gap, Mechanism};
use crate::mode::ContactMode;
use crate::motion::Segment;
use crate::scalar::Ball;

/// Whether the same formula of the configuration tells an expression everywhere.
fn is_one_formula(law: &ModelExpr) -> bool {
    is_measured(law) && law.is_without_choice()
}

/// How many times as far as it goes from the middle of a step a motion must be able to go until it is asked again what is near,
const LEAST_ROOM: f64 = 2.0;
/// and may go at most.
const MOST_ROOM: f64 = 1000.0;
/// How many times as far as they go functions are from zero where they are far from it.
const FAR: f64 = 1.1;
/// Part of the way to where they are so no more that is tried, since bounds are not in proportion to it, and how often.
const SAFETY: f64 = 0.95;
const TRIES: usize = 5;

/// How many times as far functions with these bounds may go and are far from zero.
fn room(bounds: &[[f64; 2]]) -> f64 {
    bounds.iter().map(|[value, most]| value.abs() / (FAR * most)).fold(MOST_ROOM, f64::min)
}

/// All states about one, in a phase of the motion, with the bounds of the switching functions there.
pub(super) struct Neighbourhood {
    phase: usize,
    t: f64,
    q: Vec<f64>,
    /// How far time and each coordinate may go.
    time: f64,
    reach: Vec<f64>,
    bounds: Vec<[f64; 2]>,
}

impl Neighbourhood {
    /// Whether a step stays in it.
    fn holds(&self, on: &Segment) -> bool {
        let is_within = |(i, (q, reach)): (usize, (&f64, &f64))| {
            let (middle, parts) = on.about_middle(i);
            (middle - q).abs() + parts.iter().map(|part| part.abs()).sum::<f64>() <= *reach
        };
        let is_in_time = |t: f64| (t - self.t).abs() <= self.time;
        is_in_time(on.t0) && is_in_time(on.t1) && self.q.iter().zip(&self.reach).enumerate().all(is_within)
    }
}

impl SwitchingFunction {
    /// Whether it can have a bound as long as nothing touches or rubs.
    pub(super) fn may_have_bound(self, m: &Mechanism) -> bool {
        match self {
            SwitchingFunction::Event(event) => is_one_formula(&m.events[event].when),
            SwitchingFunction::Contact(l, _) => match &m.unilateral[l].gap {
                Gap::Gauge(law) => is_one_formula(law),
                Gap::ContactPair(_) => true,
                Gap::Cable(_) => false,
            },
            SwitchingFunction::Discontinuity(_) | SwitchingFunction::JointFriction(..) => false,
        }
    }
}

impl HybridSystem<'_> {
    /// Writes of every switching function its value in the middle of a step, of this one or of another that the motion has made since it
    /// came near, and how far it goes from there at most in this one; false where one has no bound.
    pub(super) fn bounds(&mut self, on: &Segment, out: &mut [[f64; 2]]) -> bool {
        if !self.may_have_bounds || self.mode.contacts.iter().any(|contact| contact.mode.touches()) {
            return false;
        }
        self.note_roundoff(on.end());
        // In the neighbourhood of before nothing is placed.
        if let Some(near) = self.neighbourhood.as_ref().filter(|near| near.phase == self.phases.len() && near.holds(on))
        {
            out.copy_from_slice(&near.bounds);
            return true;
        }
        self.follow(on);
        let is_bounded = self.write_bounds(out).is_some();
        self.neighbourhood = if is_bounded { self.neighbourhood(out) } else { None };
        is_bounded
    }

    /// The switching functions that may come to zero in a step at whose start they have the values `here`: all but those of open
    /// contacts whose gap is wider than their bodies can cross in the step.
    pub(super) fn near_zero(&mut self, on: &Segment, here: &[f64]) -> Vec<usize> {
        if !self.mode.contacts.iter().any(|contact| contact.mode == ContactMode::Open) {
            return (0..here.len()).collect();
        }
        self.follow(on);
        let stays = |(i, function): &(usize, &SwitchingFunction)| match function {
            SwitchingFunction::Contact(l, guard) if self.mode.contacts[*l].mode == ContactMode::Open => {
                let gap = here[i - *guard as usize] * self.workspace.length;
                self.workspace.stays_open(*l, gap, &self.travel)
            }
            _ => false,
        };
        let functions = self.switching_functions.iter().enumerate();
        functions.filter(|function| !stays(function)).map(|(i, _)| i).collect()
    }

    /// Goes to the middle of a step, and finds how far the bodies go from there in it.
    fn follow(&mut self, on: &Segment) {
        let (middle, mut y) = (0.5 * (on.t0 + on.t1), std::mem::take(&mut self.middle));
        y.resize(self.scales.len(), 0.0);
        on.at(middle, &mut y);
        self.place(middle, &y);
        self.middle = y;
        let at = self.workspace.at();
        let changes = |i: usize| {
            let (middle, [first, second, rest]) = on.about_middle(i);
            [first, second, middle - at.q[i], rest]
        };
        let time = (0.5 * (on.t0 + on.t1) - at.t).abs() + 0.5 * (on.t1 - on.t0).abs();
        self.travel.follow(at, changes, time);
    }

    /// All states within as many times as far as was followed last as keep all functions, with these bounds there, far from zero.
    fn neighbourhood(&mut self, bounds: &[[f64; 2]]) -> Option<Neighbourhood> {
        let (step, time) = (self.travel.changes().to_vec(), self.travel.time());
        let (mut bounds, mut times) = (bounds.to_vec(), 1.0);
        for _ in 0..TRIES {
            times *= SAFETY * room(&bounds);
            if times < LEAST_ROOM {
                return None;
            }
            let at = self.workspace.at();
            self.travel.follow(at, |i| [0.0, 0.0, 0.0, times * step[i]], times * time);
            self.write_bounds(&mut bounds)?;
            if room(&bounds) > 1.0 {
                let (at, reach) = (self.workspace.at(), self.travel.changes().to_vec());
                let (phase, time) = (self.phases.len(), self.travel.time());
                return Some(Neighbourhood { phase, t: at.t, q: at.q.to_vec(), time, reach, bounds });
            }
        }
        None
    }

    fn write_bounds(&self, out: &mut [[f64; 2]]) -> Option<()> {
        let (m, at) = (self.workspace.m, self.workspace.at());
        let view = TravelView { at, travel: &self.travel };
        let (events, guards) = out.split_at_mut(m.events.len());
        for (bound, event) in events.iter_mut().zip(&m.events) {
            let Ball { mid, radius } = event.when.eval(&Config { poses: &view, m, mode: at.mode });
            *bound = [mid, radius];
        }
        let each = guards.len() / m.unilateral.len().max(1);
        guards.fill([1.0, 0.0]);
        let is_open = |l: &usize| self.mode.contacts[*l].mode == ContactMode::Open;
        for l in (0..m.unilateral.len()).filter(is_open) {
            let (gap, lever) = (self.workspace.gap_bound(l, &self.travel)?, self.workspace.lever(l));
            guards[each * l] = [gap.mid, gap.radius].map(|x| x * lever / self.workspace.length);
        }
        Some(())
    }
}
