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

/// How many times as far as it goes in a step a motion may go before it is asked again what is near.
const WIDER: f64 = 8.0;

/// Whether functions with these bounds are all far from zero, and would be if they went so many times as far.
fn are_far(bounds: &[[f64; 2]], times: f64) -> bool {
    bounds.iter().all(|[value, most]| value.abs() > 2.0 * times * most)
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
    /// Writes of every switching function its value at a state, and how far it goes from there at most in a step; false where one has no
    /// bound. The state is that where the mechanism happens to be, as long as all are far from zero by that; else in the middle of the step.
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
        self.workspace.enter(&self.mode);
        let is_told = self.workspace.is_placed() && self.follow(on, out).is_some() && are_far(out, 1.0);
        if !is_told {
            let mut y = std::mem::take(&mut self.middle);
            y.resize(self.scales.len(), 0.0);
            on.at(0.5 * (on.t0 + on.t1), &mut y);
            self.place(0.5 * (on.t0 + on.t1), &y);
            self.middle = y;
            if self.follow(on, out).is_none() {
                return false;
            }
        }
        self.neighbourhood = if are_far(out, WIDER) { self.neighbourhood(out.to_vec()) } else { None };
        true
    }

    /// The bounds in a step, from where the mechanism is.
    fn follow(&mut self, on: &Segment, out: &mut [[f64; 2]]) -> Option<()> {
        let at = self.workspace.at();
        let changes = |i: usize| {
            let (middle, [first, second, rest]) = on.about_middle(i);
            [first, second, middle - at.q[i], rest]
        };
        let time = (0.5 * (on.t0 + on.t1) - at.t).abs() + 0.5 * (on.t1 - on.t0).abs();
        self.travel.follow(at, changes, time);
        self.write_bounds(out)
    }

    /// All states within some times as far as was followed last, as long as all functions are far from zero there.
    fn neighbourhood(&mut self, mut bounds: Vec<[f64; 2]>) -> Option<Neighbourhood> {
        let at = self.workspace.at();
        let (reach, time): (Vec<f64>, _) =
            (self.travel.changes().iter().map(|change| WIDER * change).collect(), WIDER * self.travel.time());
        self.travel.follow(at, |i| [0.0, 0.0, 0.0, reach[i]], time);
        self.write_bounds(&mut bounds)?;
        let at = self.workspace.at();
        are_far(&bounds, 1.0).then(|| Neighbourhood {
            phase: self.phases.len(),
            t: at.t,
            q: at.q.to_vec(),
            time,
            reach,
            bounds,
        })
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
