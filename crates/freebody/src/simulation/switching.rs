//! From one mode to the next: what strikes, holds, slides and lets go.

use super::impacts::{Rule, LEFT_OVER};
use super::{Machine, Start};
use crate::balance::{Scale, Trouble};
use crate::mode::Hold;
use crate::motion::{Happening, Kind, System};

/// Gap, over the characteristic length, below which a limit is reached.
pub(super) const REACHED: f64 = 1e-10;
/// Speed, over the mechanism's own, below which there is none.
pub(super) const STILL: f64 = 1e-10;
/// Kinetic energy, over the mechanism's own, that it takes no round-off to gain.
const GAIN: f64 = 1e-9;
/// The troubles in which friction lets no motion go on, or none that was found.
const JAMS: [&str; 2] = ["painleve_inconsistent", "contact_unsolved"];
/// Impacts that one instant may hold, and those after which ever larger speeds count as none.
const ROUNDS: usize = 100;
const MANY: usize = 50;

impl Machine<'_> {
    /// Finds what only the start tells of limits, lets the events of the start happen and begins the first stretch; where
    /// the motion goes on from another, both are done already.
    ///
    /// # Errors
    /// `penetration`; `backward`, for what switches cannot be undone; what [`Machine::settle`] finds.
    pub fn begin(&mut self, start: &Start, until: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let (m, t) = (self.balance.m, start.t);
        if m.changes() && until < t {
            return Err(Trouble::new(
                "backward",
                "impacts and releases cannot be undone: choose an end after the start",
            ));
        }
        if !(m.limits.is_empty() && m.rubs.is_empty()) {
            self.place(t, y);
            if start.mode.is_none() {
                self.balance.start_limits()?;
            }
            self.settle(t, y)?;
        }
        for (i, event) in m.events.iter().enumerate().filter(|(_, e)| e.opening && start.mode.is_none()) {
            if self.armed(i, t, y)? {
                self.openings.push(Happening { t, y: y.to_vec(), index: i, kind: Kind::Opening, direction: 0 });
                self.happen(event, t, y)?;
            }
        }
        self.open();
        Ok(())
    }

    /// A guard of limit `l` fell to zero.
    pub(super) fn switch_limit(&mut self, l: usize, guard: usize, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        self.place(t, y);
        let limit = &self.balance.m.limits[l];
        if guard == 3 {
            let (_, beyond) = self.balance.border(l).expect("a guard of a border belongs to one");
            self.balance.mode.limits[l].piece.index = beyond;
            if !limit.gap.can_close(beyond) {
                let before = self.balance.mode.clone();
                self.balance.mode.limits[l].hold = Hold::Open;
                self.take_mode(t, &before)?;
            }
        } else if limit.soft.is_some() {
            let before = self.balance.mode.clone();
            let held = &mut self.balance.mode.limits[l];
            held.hold = if held.hold == Hold::Open { Hold::Pressed } else { Hold::Open };
            self.stick(t, y, &[], None)?;
            return self.take_mode(t, &before);
        }
        self.settle(t, y)
    }

    /// A guard of a joint that rubs fell to zero: it sticks no more, or stopped.
    pub(super) fn switch_rub(&mut self, rub: usize, guard: usize, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let slides = self.balance.mode.rubs[rub] == Hold::Stuck;
        // The friction that is used up pushes against the sliding to come.
        let sense = if guard == 0 { -1.0 } else { 1.0 };
        self.settle_with(t, y, slides.then_some((rub, sense)))
    }

    /// Impacts until nothing approaches, then which limits hold and which joints stick.
    ///
    /// # Errors
    /// `simultaneous_impact` and the paradoxes of Painlevé, by name.
    pub(super) fn settle(&mut self, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        self.settle_with(t, y, None)
    }

    fn settle_with(&mut self, t: f64, y: &mut [f64], loose: Option<(usize, f64)>) -> Result<(), Trouble> {
        let (known, earlier) = ([self.changes.len(), self.stretches.len()], y.to_vec());
        (self.still, self.rough) = (STILL * self.speed, false);
        let settled = self.settle_from(t, y, loose);
        if settled.is_err() {
            // The motion ends with the state before.
            y.copy_from_slice(&earlier);
            self.changes.truncate(known[0]);
            self.stretches.truncate(known[1]);
        }
        settled
    }

    fn settle_from(&mut self, t: f64, y: &mut [f64], loose: Option<(usize, f64)>) -> Result<(), Trouble> {
        let before = self.balance.mode.clone();
        self.balance.mode.resting = false;
        let mut struck = vec![];
        for round in 0..ROUNDS {
            if round > MANY {
                // What comes to rest here sets off what rests there, ever more slowly.
                self.still = (2.0 * self.still).min(LEFT_OVER * self.speed);
            }
            // Joints pass impulses on without friction.
            self.balance.mode.rubs.fill(Hold::Open);
            self.place(t, y);
            self.balance.find_pieces(self.glimpse());
            let touching = self.balance.touching(REACHED * self.balance.length);
            let reached = self.balance.reach(touching)?;
            let (k, still) = (reached.limits.len(), self.still);
            if reached.rates[..k].iter().any(|&rate| rate < -still) {
                struck.extend(self.impact(t, y, &reached)?);
                continue;
            }
            let (parting, staying): (Vec<usize>, Vec<usize>) = (0..k).partition(|&i| reached.rates[i] > still);
            let staying: Vec<usize> = staying.iter().map(|&i| reached.limits[i]).collect();
            match self.stick(t, y, &staying, loose) {
                Err(trouble) if self.jams_strike && JAMS.contains(&trouble.name) => {
                    if self.rough {
                        return Err(trouble);
                    }
                    // Where nothing seizes there are forces, and what contradicts them is not told exactly enough.
                    self.rough = !self.seize(t, y, &staying)?;
                    continue;
                }
                done => done?,
            }
            // What bounces back does so from where it is: to shift it would turn its way.
            let at_rest: Vec<usize> = reached.limits.iter().copied().filter(|l| !struck.contains(l)).collect();
            self.bring_onto(t, y, &at_rest, &reached.limits)?;
            match parting.is_empty() {
                true => self.flight = None,
                false if self.capture(t, y, &reached, &parting, &struck)? => continue,
                false => {}
            }
            return self.take_mode(t, &before);
        }
        Err(Trouble::new(
            "endless_impacts",
            format!("{ROUNDS} impacts in one instant did not bring it to an end; choose another rule for impacts"),
        ))
    }

    /// Decides which limits hold and which joints stick.
    fn stick(&mut self, t: f64, y: &[f64], limits: &[usize], loose: Option<(usize, f64)>) -> Result<(), Trouble> {
        self.balance.start_rubs(STILL * self.speed)?;
        if let Some((rub, sense)) = loose.filter(|(rub, _)| self.balance.mode.rubs[*rub] == Hold::Stuck) {
            self.balance.mode.rubs[rub] = Hold::Sliding(sense);
        }
        let scale = Scale { still: STILL * self.speed, ..self.judgement() };
        for _ in 0..=self.balance.most_turns() {
            if !limits.is_empty() {
                self.take_holds(t, y, limits)?;
            }
            if self.balance.m.rubs.is_empty() || !self.balance.turn_rub(scale, loose.map(|(rub, _)| rub))? {
                break;
            }
        }
        Ok(())
    }

    /// Brings the state exactly onto the limits that hold. What speed, and what height, that takes away, where limits all but
    /// depend on each other, is in the ledger.
    fn bring_onto(&mut self, t: f64, y: &mut [f64], at_rest: &[usize], reached: &[usize]) -> Result<(), Trouble> {
        let before = self.energy(t, y);
        self.put_onto(t, y, at_rest, reached)?;
        let after = self.energy(t, y);
        let [speed, height] = [0, 1].map(|i| after[i] - before[i]);
        if speed > GAIN * self.strength * self.balance.length {
            let names = self.balance.names_of(reached);
            let what = format!("to bring {names} to rest on each other would create the energy {speed:.6e} J");
            return Err(Trouble::new("contact_unsolved", what));
        }
        if speed + height != 0.0 {
            self.begin_stretch(t, 0.0, speed + height);
        }
        Ok(())
    }

    /// Brings the state exactly onto the limits that hold, and out of those that open from rest.
    fn put_onto(&mut self, t: f64, y: &mut [f64], at_rest: &[usize], reached: &[usize]) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        self.place(t, y);
        let inside = |l: &&usize| self.balance.mode.limits[**l].hold == Hold::Open && self.balance.limit_gap(**l) < 0.0;
        let opening: Vec<usize> = at_rest.iter().filter(inside).copied().collect();
        let carries = self.balance.mode.limits.iter().any(|held| held.hold.carries());
        if opening.is_empty() && !carries && self.balance.m.rubs.is_empty() {
            return Ok(());
        }
        let (q, rest) = y.split_at_mut(n);
        opening.iter().for_each(|&l| self.balance.mode.limits[l].hold = Hold::Smooth);
        let closed = self.balance.close(t, q, &rest[..n]);
        opening.iter().for_each(|&l| self.balance.mode.limits[l].hold = Hold::Open);
        closed?;
        // What begins to slide does so from rest, and not the other way by round-off.
        let holds: Vec<Hold> = self.balance.mode.limits.iter().map(|held| held.hold).collect();
        for (l, &hold) in holds.iter().enumerate() {
            if matches!(hold, Hold::Sliding(sense) if sense * self.balance.slide_rate(l) < 0.0) {
                self.balance.mode.limits[l].hold = Hold::Stuck;
            }
        }
        // What opens does not approach any more, by however little.
        self.balance.place(t, q, &rest[..n]);
        let opening = reached.iter().filter(|&&l| holds[l] == Hold::Open && self.balance.gap_rate(l) < 0.0);
        let opening: Vec<usize> = opening.copied().collect();
        opening.iter().for_each(|&l| self.balance.mode.limits[l].hold = Hold::Smooth);
        let aligned = self.balance.align(t, q, &mut rest[..n]);
        self.balance.mode.limits.iter_mut().zip(holds).for_each(|(held, hold)| held.hold = hold);
        aligned?;
        self.place(t, y);
        self.balance.solve()?;
        if self.balance.is_locked() {
            // Nothing can move: not even by round-off.
            y[n..2 * n].fill(0.0);
            self.balance.mode.resting = true;
            self.place(t, y);
        }
        Ok(())
    }

    /// Decides how limits that neither approach nor part go on.
    fn take_holds(&mut self, t: f64, y: &[f64], limits: &[usize]) -> Result<(), Trouble> {
        let scale = self.judgement();
        self.place(t, y);
        let reached = self.balance.reach(limits.to_vec())?;
        let slips = reached.slips();
        let mut holding = self.balance.hold(&reached, &slips, scale)?;
        if holding.close {
            // What nothing decides now is decided by what comes next.
            self.balance.take(&reached, &holding);
            self.place(t, y);
            self.balance.share(&reached, &holding)?;
            let (q, u) = self.ahead(t, y)?;
            self.balance.place(t + self.glimpse(), &q, &u);
            let next = self.balance.reach(reached.limits.clone())?;
            holding = self.balance.hold(&next, &slips, scale)?;
        }
        self.balance.take(&reached, &holding);
        self.place(t, y);
        self.balance.share(&reached, &holding)
    }

    /// What counts as slow, and what is done where nothing decides.
    pub(super) fn judgement(&self) -> Scale {
        let pace = self.speed * self.speed / self.balance.length;
        Scale { still: self.still, pace, stay: self.rule != Rule::Stop, rough: self.rough }
    }

    /// A time that is short beside any of the motion, s.
    fn glimpse(&self) -> f64 {
        1e-6 * self.balance.length / self.speed
    }

    /// The state a glimpse later, in the present mode.
    fn ahead(&mut self, t: f64, y: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Trouble> {
        let (n, h) = (self.balance.m.freedom(), self.glimpse());
        let mut dy = vec![0.0; y.len()];
        self.rate(t, y, &mut dy)?;
        let q = (0..n).map(|i| y[i] + h * y[n + i] + 0.5 * h * h * dy[n + i]).collect();
        let u = (n..2 * n).map(|i| y[i] + h * dy[i]).collect();
        Ok((q, u))
    }
}
