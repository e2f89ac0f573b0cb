//! Guards: functions that stay positive as long as the mode holds.

use super::switching::{REACHED, STILL};
use super::Machine;
use crate::balance::{Route, Trouble};
use crate::mechanism::Gap;
use crate::mode::Hold;

/// Guards of each limit: gap or force, two for friction, border.
pub(super) const GUARDS: usize = 4;
/// Guards of each joint that rubs: friction in either direction, or the speed.
pub(super) const RUB_GUARDS: usize = 2;

/// Gap, over the characteristic length, that what is kept off by another may lack: more than the other may.
const KEPT: f64 = 2.0 * REACHED;
/// Speed, over the mechanism's own, from which what leaned on others slides: well above what counts as none.
const LOOSE: f64 = 10.0 * STILL;

impl Machine<'_> {
    /// The values of the guards of all limits: positive as long as the mode holds.
    pub(super) fn guard_values(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Trouble> {
        self.place(t, y);
        let m = self.balance.m;
        let carries = !m.rubs.is_empty() || self.balance.mode.limits.iter().any(|held| held.hold.carries());
        if carries {
            self.balance.solve_by(Route::Minimal)?;
        }
        let shared = if carries { self.balance.safest_margin(self.strength) } else { None };
        let forces = if carries && shared.is_none() { self.balance.limit_forces() } else { vec![] };
        let (out, rubs) = out.split_at_mut(GUARDS * m.limits.len());
        self.rub_values(rubs);
        let apart = self.balance.apart();
        for (l, values) in out.chunks_exact_mut(GUARDS).enumerate() {
            match apart[m.limits[l].group] {
                // Apart, as their bodies are.
                Some(least) if self.balance.mode.limits[l].hold == Hold::Open => {
                    values.copy_from_slice(&[least / self.balance.length, 1.0, 1.0, 1.0]);
                }
                _ => self.guards_of(l, forces.get(l).copied(), values),
            }
        }
        // One guard is of them all.
        let first = self.balance.mode.limits.iter().position(|held| held.hold.carries());
        if let Some((first, shared)) = first.zip(shared) {
            out[GUARDS * first] = shared / self.strength;
        }
        Ok(())
    }

    /// The guards of one limit under given forces along its gap and its slide, where there are such, at the state placed.
    fn guards_of(&self, l: usize, forces: Option<[f64; 2]>, values: &mut [f64]) {
        let (limit, held) = (&self.balance.m.limits[l], self.balance.mode.limits[l]);
        values.fill(1.0);
        match held.hold {
            Hold::Off => return,
            Hold::Open if limit.soft.is_some() => values[0] = self.free_of_spring(l),
            Hold::Pressed => values[0] = self.kept_by_spring(l),
            // What another keeps off is at zero with it.
            Hold::Open => {
                let kept_off = || self.balance.open_gap(l) / self.balance.length + KEPT;
                let closing = self.balance.closing_gap(l).map(|gap| gap / self.balance.length);
                values[0] = closing.unwrap_or_else(kept_off);
            }
            Hold::Idle => values[0] = self.balance.open_gap(l) / self.balance.length + REACHED,
            Hold::Smooth | Hold::Stuck | Hold::Leaning(_) | Hold::Sliding(_) => {
                let margins = forces.map_or(vec![], |forces| self.balance.margins(l, forces));
                for (value, margin) in values.iter_mut().zip(margins) {
                    *value = margin / self.strength;
                }
                match held.hold {
                    Hold::Sliding(sense) => values[1] = sense * self.balance.slide_rate(l) / self.speed,
                    Hold::Leaning(_) => values[1] = LOOSE - self.balance.slide_rate(l).abs() / self.speed,
                    _ => {}
                }
            }
        }
        // A string keeps count of its turns, slack or taut.
        if held.hold.touches() || matches!(limit.gap, Gap::Cord(_)) {
            values[3] = self.balance.border(l).map_or(1.0, |(value, _)| value / self.balance.length);
        }
    }

    /// The values of the guards of all joints that rub, at the state of the last solution.
    fn rub_values(&self, out: &mut [f64]) {
        for (rub, values) in out.chunks_exact_mut(RUB_GUARDS).enumerate() {
            values.fill(1.0);
            match self.balance.mode.rubs[rub] {
                Hold::Stuck => {
                    let reserve = self.balance.rub_reserve(rub).map(|r| r / self.strength);
                    values.copy_from_slice(&reserve);
                }
                Hold::Sliding(sense) => values[0] = sense * self.balance.rub_rate(rub) / self.speed,
                _ => {}
            }
        }
    }

    /// Positive while the gap of a limit with a spring is open, or its damper would have to pull.
    fn free_of_spring(&self, l: usize) -> f64 {
        let gap = self.balance.limit_gap(l) / self.balance.length;
        gap.max(-self.balance.press(l) / self.strength)
    }

    /// Positive while the gap of a limit with a spring is violated and the spring pushes.
    fn kept_by_spring(&self, l: usize) -> f64 {
        let gap = self.balance.limit_gap(l) / self.balance.length;
        (-gap).min(self.balance.press(l) / self.strength)
    }

    /// One guard, if it is of places and speeds alone: then nothing needs to be solved.
    pub(super) fn guard_value(&mut self, guard: usize, t: f64, y: &[f64]) -> Option<f64> {
        let (l, which) = (guard / GUARDS, guard % GUARDS);
        let is_force = match self.balance.mode.limits.get(l)?.hold {
            Hold::Stuck => which < 3,
            hold => hold.carries() && which == 0,
        };
        if is_force {
            return None;
        }
        self.place(t, y);
        let mut values = [0.0; GUARDS];
        self.guards_of(l, None, &mut values);
        Some(values[which])
    }
}
