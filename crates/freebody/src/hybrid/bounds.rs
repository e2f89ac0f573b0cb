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

/// Whether a function with this bound is far from zero.
fn is_far(&[value, most]: &[f64; 2]) -> bool {
    value.abs() > 2.0 * most
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
        let idle = |mode: ContactMode| matches!(mode, ContactMode::Open | ContactMode::Off);
        if !(self.may_have_bounds && self.mode.contacts.iter().all(|contact| idle(contact.mode))) {
            return false;
        }
        self.note_roundoff(on.end());
        self.workspace.enter(&self.mode);
        if self.workspace.is_placed() && self.write_bounds(on, out).is_some() && out.iter().all(is_far) {
            return true;
        }
        let mut y = std::mem::take(&mut self.middle);
        y.resize(self.scales.len(), 0.0);
        on.at(0.5 * (on.t0 + on.t1), &mut y);
        self.place(0.5 * (on.t0 + on.t1), &y);
        self.middle = y;
        self.write_bounds(on, out).is_some()
    }

    fn write_bounds(&mut self, on: &Segment, out: &mut [[f64; 2]]) -> Option<()> {
        let (m, at) = (self.workspace.m, self.workspace.at());
        // From here to the middle of the step, and from there along it.
        let along = on.parts();
        let write_parts = |i: usize, out: &mut [f64]| {
            on.write_parts(i, &mut out[..along]);
            out[along] = on.start()[i] + out[..along].iter().sum::<f64>() - at.q[i];
        };
        let time = (0.5 * (on.t0 + on.t1) - at.t).abs() + 0.5 * (on.t1 - on.t0).abs();
        self.travel.follow(at, along + 1, write_parts, time);
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
