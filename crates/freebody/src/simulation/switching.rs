//! What switches during a motion: parts released and engaged, impacts, limits that hold and let go.

use super::Machine;
use crate::balance::{Blow, Reached, Route, Trouble};
use crate::contact::complementarity::{self, Law, NoImpact, Strike};
use crate::gauges::Law as Gauge;
use crate::mechanism::{Deed, Part};
use crate::mode::Hold;
use crate::motion::System;
use crate::plane::Vec2;

/// Gap, over the characteristic length, below which a limit is reached.
const REACHED: f64 = 1e-10;
/// Speed, over the mechanism's own, below which there is none.
const STILL: f64 = 1e-10;
/// Flight between bounces, over the time in which the mechanism moves its own length, that is not followed any more: its
/// height comes near the round-off of the gap.
const BRIEF: f64 = 1e-5;
/// Impacts that one instant may hold.
const ROUNDS: usize = 100;
/// Guards of each limit: gap or force, two for friction, border.
pub(super) const GUARDS: usize = 4;

/// What to do about impacts whose outcome rigid bodies leave open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// End the run by name.
    Stop,
    /// Take a law.
    Law(Law),
}

impl Rule {
    /// Every rule with its word.
    pub const ALL: &'static [(&'static str, Rule)] = &[
        ("stop", Rule::Stop),
        ("newton", Rule::Law(Law::Newton)),
        ("poisson", Rule::Law(Law::Poisson)),
        ("sequential", Rule::Law(Law::Sequential)),
    ];
    /// The rule of a word.
    pub fn named(word: &str) -> Option<Rule> {
        Rule::ALL.iter().find(|r| r.0 == word).map(|r| r.1)
    }
    /// Its word.
    pub fn word(self) -> &'static str {
        Rule::ALL.iter().find(|r| r.1 == self).map_or("", |r| r.0)
    }
}

/// Something that switched.
#[derive(Clone, Debug)]
pub struct Change {
    /// When, s.
    pub t: f64,
    /// One word: `impact`, `taut`, `lift-off`, `slack`, `contact`, `slip`, `stick`, `rest`, `released`, `engaged`, `reset`.
    pub kind: &'static str,
    /// The contacts, stops, strings or parts concerned, by name.
    pub of: Vec<String>,
    /// Energy that it took, J.
    pub lost: f64,
    /// State vectors before and after, where it jumped.
    pub states: Option<[Vec<f64>; 2]>,
    /// Impulses, where there was a blow.
    pub impulses: Option<Impulses>,
    /// What else is to be said.
    pub note: Option<String>,
}

/// The impulses of a blow.
#[derive(Clone, Debug, Default)]
pub struct Impulses {
    /// On the first body of each contact (the first end of a string), with its name, N·s.
    pub limits: Vec<(String, Vec2)>,
    /// Of each joint on its second body, N·s and N·m·s about its point.
    pub joints: Vec<[f64; 3]>,
}

impl Machine<'_> {
    /// Finds what only the start tells of limits, lets the events of the start happen and begins the first stretch.
    ///
    /// # Errors
    /// `penetration`; `backward`, for what switches cannot be undone; what [`Machine::settle`] finds.
    pub fn begin(&mut self, t: f64, until: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let m = self.balance.m;
        if m.changes() && until < t {
            return Err(Trouble::new("backward", "impacts and releases cannot be undone: choose an end after the start"));
        }
        if !m.limits.is_empty() {
            self.place(t, y);
            self.balance.start_limits()?;
            self.settle(t, y)?;
        }
        for event in m.events.iter().filter(|event| event.opening) {
            self.happen(event, t, y)?;
        }
        self.open();
        Ok(())
    }

    /// The values of the guards of all limits: positive as long as the mode holds.
    pub(super) fn guard_values(&mut self, t: f64, y: &[f64], out: &mut [f64]) -> Result<(), Trouble> {
        self.place(t, y);
        let carries = self.balance.mode.limits.iter().any(|held| held.hold.carries());
        if carries {
            self.balance.solve_by(Route::Minimal)?;
        }
        let forces = if carries { self.balance.safest_forces(self.strength) } else { vec![] };
        let apart = self.balance.apart();
        for (l, values) in out.chunks_exact_mut(GUARDS).enumerate() {
            match apart[self.balance.m.limits[l].group] {
                // Apart, as their bodies are.
                Some(least) if self.balance.mode.limits[l].hold == Hold::Open => {
                    values.copy_from_slice(&[least / self.balance.length, 1.0, 1.0, 1.0]);
                }
                _ => self.guards_of(l, forces.get(l).copied().unwrap_or_default(), values),
            }
        }
        Ok(())
    }

    /// The guards of one limit under given forces along its gap and its slide, at the state placed.
    fn guards_of(&self, l: usize, forces: [f64; 2], values: &mut [f64]) {
        let held = self.balance.mode.limits[l];
        values.fill(1.0);
        match held.hold {
            Hold::Off => {}
            Hold::Open => values[0] = self.balance.open_gap(l) / self.balance.length,
            Hold::Idle => values[0] = self.balance.limit_gap(l) / self.balance.length + REACHED,
            Hold::Smooth | Hold::Stuck | Hold::Leaning(_) | Hold::Sliding(_) => {
                for (value, margin) in values.iter_mut().zip(self.balance.margins(l, forces)) {
                    *value = margin / self.strength;
                }
                if let Hold::Sliding(sense) = held.hold {
                    values[1] = sense * self.balance.slide_rate(l) / self.speed;
                }
                values[3] = self.balance.border(l).map_or(1.0, |(value, _)| value / self.balance.length);
            }
        }
    }

    /// One guard, if it is of the configuration alone: then nothing needs to be solved.
    pub(super) fn guard_value(&mut self, guard: usize, t: f64, y: &[f64]) -> Option<f64> {
        let l = guard / GUARDS;
        if self.balance.mode.limits[l].hold.carries() {
            return None;
        }
        self.place(t, y);
        let mut values = [0.0; GUARDS];
        self.guards_of(l, [0.0; 2], &mut values);
        Some(values[guard % GUARDS])
    }

    /// A guard of limit `l` fell to zero.
    pub(super) fn switch_limit(&mut self, l: usize, guard: usize, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        self.place(t, y);
        if guard == 3 {
            let (_, beyond) = self.balance.border(l).expect("a guard of a border belongs to one");
            let held = &mut self.balance.mode.limits[l];
            held.piece.index = beyond;
            if !self.balance.m.limits[l].gap.can_close(beyond) {
                held.hold = Hold::Open;
            }
        }
        self.settle(t, y)
    }

    /// Impacts until nothing approaches, then which limits hold.
    ///
    /// # Errors
    /// `simultaneous_impact` and the paradoxes of Painlevé, by name.
    pub(super) fn settle(&mut self, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let before = self.balance.mode.clone();
        self.balance.mode.resting = false;
        for _ in 0..ROUNDS {
            self.place(t, y);
            self.balance.find_pieces();
            let touching = self.balance.touching(REACHED * self.balance.length);
            if touching.is_empty() {
                self.flight = None;
                return self.take_mode(t, &before);
            }
            let reached = self.balance.reach(touching)?;
            let k = reached.limits.len();
            let still = STILL * self.speed;
            if reached.rates[..k].iter().any(|&rate| rate < -still) {
                self.impact(t, y, &reached)?;
                continue;
            }
            let (parting, staying): (Vec<usize>, Vec<usize>) = (0..k).partition(|&i| reached.rates[i] > still);
            if !staying.is_empty() {
                self.take_holds(t, y, staying.iter().map(|&i| reached.limits[i]).collect())?;
            }
            self.put_onto(t, y, &reached.limits)?;
            match parting.is_empty() {
                true => self.flight = None,
                false if self.capture(t, y, &reached, &parting)? => continue,
                false => {}
            }
            return self.take_mode(t, &before);
        }
        Err(Trouble::new(
            "endless_impacts",
            format!("{ROUNDS} impacts in one instant did not bring it to an end; choose another rule for impacts"),
        ))
    }

    /// Decides how limits that neither approach nor part go on.
    fn take_holds(&mut self, t: f64, y: &mut [f64], limits: Vec<usize>) -> Result<(), Trouble> {
        let (still, stay) = (STILL * self.speed, self.rule != Rule::Stop);
        let reached = self.balance.reach(limits)?;
        let slips = reached.slips();
        let mut holding = self.balance.hold(&reached, &slips, still, stay)?;
        if holding.close {
            // What nothing decides now is decided by what comes next.
            self.balance.take(&reached, &holding);
            self.place(t, y);
            self.balance.share(&reached, &holding)?;
            let (q, u) = self.ahead(t, y)?;
            self.balance.place(t + self.glimpse(), &q, &u);
            let next = self.balance.reach(reached.limits.clone())?;
            holding = self.balance.hold(&next, &slips, still, stay)?;
        }
        self.balance.take(&reached, &holding);
        self.place(t, y);
        self.balance.share(&reached, &holding)?;
        Ok(())
    }

    /// Brings the state exactly onto the limits that hold, and out of those that open.
    fn put_onto(&mut self, t: f64, y: &mut [f64], reached: &[usize]) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        self.place(t, y);
        let inside = |l: &&usize| self.balance.mode.limits[**l].hold == Hold::Open && self.balance.limit_gap(**l) < 0.0;
        let opening: Vec<usize> = reached.iter().filter(inside).copied().collect();
        if opening.is_empty() && !self.balance.mode.limits.iter().any(|held| held.hold.carries()) {
            return Ok(());
        }
        let (q, rest) = y.split_at_mut(n);
        opening.iter().for_each(|&l| self.balance.mode.limits[l].hold = Hold::Smooth);
        let closed = self.balance.close(t, q, &rest[..n]);
        opening.iter().for_each(|&l| self.balance.mode.limits[l].hold = Hold::Open);
        closed?;
        self.balance.align(t, q, &mut rest[..n])?;
        self.place(t, y);
        self.balance.solve()?;
        if self.balance.is_locked() {
            // Nothing can move: not even by round-off.
            y[n..2 * n].fill(0.0);
            self.balance.mode.resting = true;
        }
        Ok(())
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

    /// The limits reached strike.
    fn impact(&mut self, t: f64, y: &mut [f64], reached: &Reached) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        let restitution: Vec<f64> = reached.limits.iter().map(|&l| self.balance.restitution(l)).collect();
        let names = self.balance.names_of(&reached.limits);
        let rule = self.rule;
        let before = y.to_vec();
        let energy = self.balance.kinetic_energy();
        let blow = self.balance.blow(reached, &restitution, |strike| decide(strike, rule, &names))?;
        y[n..2 * n].iter_mut().zip(&blow.change).for_each(|(u, d)| *u += d);
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        let struck = reached.limits.iter().zip(&blow.normal).filter(|(_, &p)| p > 0.0);
        let struck: Vec<usize> = struck.map(|(&l, _)| l).collect();
        let m = self.balance.m;
        let string = |&l: &usize| m.groups[m.limits[l].group].word == "string";
        self.begin_stretch(t, 0.0, -lost);
        self.note(Change {
            t,
            kind: if struck.iter().all(string) { "taut" } else { "impact" },
            of: self.names(&struck),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(reached, &blow)),
            note: blow.note,
        });
        Ok(())
    }

    fn impulses(&self, reached: &Reached, blow: &Blow) -> Impulses {
        let m = self.balance.m;
        let mut limits: Vec<(String, Vec2)> = vec![];
        for (&l, &p) in reached.limits.iter().zip(&blow.on_first) {
            let name = &m.groups[m.limits[l].group].name;
            match limits.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += p,
                None => limits.push((name.clone(), p)),
            }
        }
        limits.retain(|(_, p)| p.norm() > 0.0);
        Impulses { limits, joints: blow.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect() }
    }

    /// Whether bounces without end are over within a moment: then what takes part in them comes to rest.
    ///
    /// A flight after a bounce lasts twice the speed of parting over the acceleration of return, and each of a series
    /// lasts a constant part of the one before. Longer flights are noted, for a step must not be so long that it does not see
    /// them.
    fn capture(&mut self, t: f64, y: &mut [f64], reached: &Reached, parting: &[usize]) -> Result<bool, Trouble> {
        self.place(t, y);
        self.balance.solve()?;
        let limits: Vec<usize> = parting.iter().map(|&i| reached.limits[i]).collect();
        let back = self.balance.gap_accelerations(&limits);
        let speeds = parting.iter().map(|&i| reached.rates[i]);
        let flights: Vec<f64> = speeds.zip(&back).map(|(v, &a)| if a < 0.0 { -2.0 * v / a } else { f64::INFINITY }).collect();
        let (brief, before) = (BRIEF * self.balance.length / self.speed, self.flight.take());
        let over: Vec<usize> = (0..limits.len()).filter(|&i| flights[i] <= brief).collect();
        let next = (0..limits.len()).min_by(|&a, &b| flights[a].total_cmp(&flights[b])).expect("something parts");
        if over.is_empty() {
            self.flight = flights[next].is_finite().then_some((limits[next], flights[next]));
            return Ok(false);
        }
        let flight = over.iter().map(|&i| flights[i]).fold(0.0, f64::max);
        let over: Vec<usize> = over.iter().map(|&i| limits[i]).collect();
        // A block that rocks comes down on its corners by turns: the contact is the same, the limits are not.
        let group = |&l: &usize| self.balance.m.limits[l].group;
        let same = |(last, _): &(usize, f64)| over.iter().any(|l| group(l) == group(last));
        let part = before.filter(same).map_or(0.0, |(_, before)| (flight / before).min(0.999));
        let n = self.balance.m.freedom();
        let (energy, earlier) = (self.balance.kinetic_energy(), y.to_vec());
        for &limit in &over {
            self.balance.mode.limits[limit].hold = Hold::Smooth;
        }
        let (q, rest) = y.split_at_mut(n);
        self.balance.align(t, q, &mut rest[..n])?;
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        self.begin_stretch(t, 0.0, -lost);
        self.note(Change {
            t: t + flight / (1.0 - part),
            kind: "rest",
            of: self.names(&over),
            lost,
            states: Some([earlier, y.to_vec()]),
            impulses: None,
            note: Some(format!("the bounces from t = {t:.12} s on, without end, are over")),
        });
        Ok(true)
    }

    /// The names of the contacts, stops and strings of limits, each once.
    fn names(&self, limits: &[usize]) -> Vec<String> {
        let m = self.balance.m;
        let mut of: Vec<String> = limits.iter().map(|&l| m.groups[m.limits[l].group].name.clone()).collect();
        of.dedup();
        of
    }

    /// Notes what changed of the mode, and begins another stretch.
    fn take_mode(&mut self, t: f64, before: &crate::mode::Mode) -> Result<(), Trouble> {
        let m = self.balance.m;
        let mut told: Vec<(&'static str, String)> = vec![];
        for (l, limit) in m.limits.iter().enumerate() {
            let group = &m.groups[limit.group];
            let string = group.word == "string";
            let (was, is) = (before.limits[l].hold, self.balance.mode.limits[l].hold);
            let kind = match (was.is_closed(), is.is_closed()) {
                (true, false) if string => "slack",
                (true, false) => "lift-off",
                (false, true) if self.has_struck(t, &group.name) => continue,
                (false, true) if string => "taut",
                (false, true) => "contact",
                _ => match (was, is) {
                    (was, Hold::Sliding(_)) if was.sticks() => "slip",
                    (Hold::Sliding(_), is) if is.sticks() => "stick",
                    (Hold::Sliding(a), Hold::Sliding(b)) if a != b => "reversal",
                    _ => continue,
                },
            };
            if !told.iter().any(|(k, name)| *k == kind && *name == group.name) {
                told.push((kind, group.name.clone()));
            }
        }
        for (kind, name) in told {
            self.note(Change { t, kind, of: vec![name], lost: 0.0, states: None, impulses: None, note: None });
        }
        self.begin_stretch(t, 0.0, 0.0);
        Ok(())
    }

    /// Whether a blow of this instant has told of a limit already.
    fn has_struck(&self, t: f64, name: &String) -> bool {
        self.changes.iter().rev().take_while(|c| c.t >= t).any(|c| c.impulses.is_some() && c.of.contains(name))
    }

    fn note(&mut self, change: Change) {
        self.changes.push(change);
    }

    /// Notes a jump of the velocities, with the energy that it took.
    fn note_jump(&mut self, change: Change) {
        self.begin_stretch(change.t, 0.0, -change.lost);
        self.note(change);
    }

    /// Releases and engages parts and resets rates, as deeds ask.
    ///
    /// # Errors
    /// As [`Machine::settle`].
    pub(super) fn switch_parts(&mut self, t: f64, y: &mut [f64], deeds: &[Deed]) -> Result<bool, Trouble> {
        let mut switched = false;
        for deed in deeds {
            switched |= match deed {
                Deed::Release(part) => self.put(t, *part, false),
                Deed::Engage(part) => self.put(t, *part, true),
                _ => false,
            };
        }
        let resets: Vec<(&Gauge, &Gauge)> =
            deeds.iter().filter_map(|d| if let Deed::Reset(of, rate) = d { Some((of, rate)) } else { None }).collect();
        if !resets.is_empty() {
            self.reset(t, y, &resets)?;
            switched = true;
        }
        if switched {
            self.close_up(t, y)?;
            self.settle(t, y)?;
        }
        Ok(switched)
    }

    fn put(&mut self, t: f64, part: Part, there: bool) -> bool {
        let changed = self.balance.put(part, there);
        if changed {
            let of = vec![self.balance.m.name_of(part).to_string()];
            let kind = if there { "engaged" } else { "released" };
            self.note(Change { t, kind, of, lost: 0.0, states: None, impulses: None, note: None });
        }
        changed
    }

    /// Gives gauges their new rates, with the least change of momentum.
    fn reset(&mut self, t: f64, y: &mut [f64], resets: &[(&Gauge, &Gauge)]) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        let rates: Vec<&Gauge> = resets.iter().map(|r| r.1).collect();
        let values = self.read(&rates, t, y)?;
        let held: Vec<_> = resets.iter().zip(values).map(|(r, x)| (String::new(), r.0.clone(), x)).collect();
        let before = y.to_vec();
        self.place(t, y);
        let energy = self.balance.kinetic_energy();
        let (q, rest) = y.split_at_mut(n);
        self.balance.align_with(t, q, &mut rest[..n], &held)?;
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        let states = Some([before, y.to_vec()]);
        self.note_jump(Change { t, kind: "reset", of: vec![], lost, states, impulses: None, note: None });
        Ok(())
    }

    /// Lets what was engaged take hold: a plastic impact of the joints.
    fn close_up(&mut self, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        self.place(t, y);
        let energy = self.balance.kinetic_energy();
        // Limits join in afterwards; the whole is the same impact, for what they do leaves the joints closed.
        let mut limits = std::mem::take(&mut self.balance.mode.limits);
        let held = limits.clone();
        limits.iter_mut().filter(|h| h.hold.carries()).for_each(|h| h.hold = Hold::Idle);
        self.balance.mode.limits = limits;
        let blow = self.balance.joining_blow()?;
        self.balance.mode.limits = held;
        let before = y.to_vec();
        y[n..2 * n].iter_mut().zip(&blow.change).for_each(|(u, d)| *u += d);
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        if lost.abs() <= 1e-14 * energy {
            y.copy_from_slice(&before);
            self.place(t, y);
            return Ok(());
        }
        let joints = blow.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect();
        let impulses = Some(Impulses { limits: vec![], joints });
        let states = Some([before, y.to_vec()]);
        self.note_jump(Change { t, kind: "impact", of: vec![], lost, states, impulses, note: None });
        Ok(())
    }
}

/// The impulses of a strike, by the rule where laws differ.
fn decide(strike: &Strike, rule: Rule, names: &str) -> Result<(complementarity::Impulses, Option<String>), Trouble> {
    let law = match rule {
        Rule::Law(law) => law,
        Rule::Stop => match complementarity::undecided(strike) {
            Some(alternatives) => return Err(undecided(names, &alternatives)),
            None => Law::Newton,
        },
    };
    let settled = match (complementarity::settle(strike, law), rule) {
        (Ok(settled), _) => settled,
        (Err(NoImpact::Ambiguous(all)), Rule::Law(_)) => return Ok(least(all)),
        (Err(e), _) => {
            return Err(Trouble::new("no_impact", format!("no impulses at {names} satisfy the law of impact: {e}")))
        }
    };
    let note = (!settled.notes.is_empty()).then(|| settled.notes.join("; "));
    Ok((settled.impulses, note))
}

/// Of plastic impacts that all satisfy Coulomb's law the one that leaves least energy.
fn least(all: Vec<complementarity::Impulses>) -> (complementarity::Impulses, Option<String>) {
    let note = format!("Taken as plastic, and of {} outcomes as the one that leaves least energy.", all.len());
    let least = all.into_iter().min_by(|a, b| a.work.total_cmp(&b.work)).expect("several outcomes");
    (least, Some(note))
}

fn undecided(names: &str, alternatives: &[(Law, complementarity::Impulses)]) -> Trouble {
    let told: Vec<String> = alternatives
        .iter()
        .map(|(law, impulses)| {
            let speeds: Vec<String> =
                impulses.after[..impulses.normal.len()].iter().map(|v| format!("{v:.6}")).collect();
            format!("by {} they part at {} m/s", Rule::Law(*law).word(), speeds.join(", "))
        })
        .collect();
    Trouble::new(
        "simultaneous_impact",
        format!(
            "{names} strike at once, and rigid bodies do not decide what follows: {}; choose a rule, `impacts: newton`, `poisson` or `sequential`",
            told.join("; ")
        ),
    )
}
