//! Impacts: blows of limits that are reached, the end of bounces without end, and contacts that jam.

use super::changes::{Change, Impulses, Struck};
use super::Machine;
use crate::balance::{Blow, Reached, Trouble};
use crate::contact::complementarity::{self, Law, NoImpact, Strike};
use crate::mode::Hold;
use crate::plane::Vec2;

/// Flight between bounces, over the time in which the mechanism moves its own length, that is not followed any more: its
/// height comes near the round-off of the gap.
const BRIEF: f64 = 1e-5;
/// Part of the kinetic energy by which it may rise in an impact, as round-off.
const RISE: f64 = 1e-11;
/// Shares of themselves by which limits yield, one after the other, where impulses of rigid ones are lost in round-off.
const YIELDING: [f64; 4] = [1e-12, 1e-10, 1e-8, 1e-6];
/// Speed, over the mechanism's own, up to which what yielding, or a long row of impacts, leaves over counts as none.
pub(super) const LEFT_OVER: f64 = 1e-6;
/// Part of the largest impulse below which one is round-off.
const NOTHING: f64 = 1e-12;
/// Part of what friction can do in a blow from which on all of it is used up.
const USED_UP: f64 = 1.0 - 1e-9;

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

impl Machine<'_> {
    /// The limits reached strike; returns those that did.
    pub(super) fn impact(&mut self, t: f64, y: &mut [f64], reached: &Reached) -> Result<Vec<usize>, Trouble> {
        let restitution: Vec<f64> = reached.limits.iter().map(|&l| self.balance.restitution(l)).collect();
        let names = self.balance.names_of(&reached.limits);
        let rule = self.rule;
        let (before, still) = (y.to_vec(), self.still);
        let blow = self.balance.blow(reached, &restitution, |strike| decide(strike, rule, &names));
        let mut struck = blow.and_then(|blow| self.strike(t, y, blow));
        for share in YIELDING.into_iter().filter(|_| rule != Rule::Stop) {
            if struck.is_err() {
                let blow = self.balance.blow(reached, &restitution, |strike| yielding(strike, share, &names));
                struck = blow.and_then(|blow| self.strike(t, y, blow));
                struck.iter().for_each(|(blow, _)| self.let_pass(reached, blow, share));
            }
        }
        let (blow, lost) = struck?;
        let (part, hit) = (reached.takes_part(still), hit(&blow));
        let struck = (0..part.len()).filter(|&i| part[i] && hit[i]);
        let struck: Vec<usize> = struck.map(|i| reached.limits[i]).collect();
        let m = self.balance.m;
        let string = |&l: &usize| m.groups[m.limits[l].group].word == "string";
        self.note_jump(Change {
            t,
            kind: if struck.iter().all(string) { "taut" } else { "impact" },
            of: self.names(&struck),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(reached, &blow)),
            note: blow.note,
        });
        Ok(struck)
    }

    /// Takes the velocities after a blow, with the energy lost in it, if there is less than before: large impulses that all but
    /// cancel can bring energy from nowhere.
    fn strike(&mut self, t: f64, y: &mut [f64], blow: Blow) -> Result<(Blow, f64), Trouble> {
        let n = self.balance.m.freedom();
        let (before, energy) = (y.to_vec(), self.balance.kinetic_energy());
        y[n..2 * n].iter_mut().zip(&blow.change).for_each(|(u, d)| *u += d);
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        if lost >= -RISE * energy {
            return Ok((blow, lost));
        }
        y.copy_from_slice(&before);
        self.place(t, y);
        let sentence = format!("the impulses found at t = {t:.12} s would create the energy {:.6e} J", -lost);
        Err(Trouble::new("no_impact", sentence))
    }

    /// From now on in this instant the speeds that yielding left over count as none.
    fn let_pass(&mut self, reached: &Reached, blow: &Blow, share: f64) {
        let left = reached.speeds_of(&blow.normal, &blow.tangent).map(|v| 2.0 * share * v).fold(0.0, f64::max);
        if left <= LEFT_OVER * self.speed {
            self.still = self.still.max(left);
        }
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
        let most = limits.iter().map(|(_, p)| p.norm()).fold(0.0, f64::max);
        limits.retain(|(_, p)| p.norm() > NOTHING * most);
        let joints = blow.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect();
        let (part, hit) = (reached.takes_part(self.still), hit(blow));
        let (struck, spared): (Vec<usize>, Vec<usize>) = (0..part.len()).filter(|&i| part[i]).partition(|&i| hit[i]);
        let mut mode = self.balance.mode.clone();
        for &i in &struck {
            let rubs = self.balance.friction_of(reached.limits[i]);
            mode.limits[reached.limits[i]].hold = held(blow.normal[i], blow.tangent[i], rubs);
        }
        let spared: Vec<usize> = spared.iter().map(|&i| reached.limits[i]).collect();
        let struck = struck.iter().map(|&i| Struck {
            name: m.groups[m.limits[reached.limits[i]].group].name.clone(),
            normal: blow.normal[i],
            tangent: blow.tangent[i],
            restitution: self.balance.restitution(reached.limits[i]),
        });
        Impulses { limits, joints, struck: struck.collect(), spared: self.names(&spared), mode }
    }

    /// Whether bounces without end are over within a moment: then what takes part in them comes to rest.
    ///
    /// A flight after a bounce lasts twice the speed of parting over the acceleration of return, and each of a series
    /// lasts a constant part of the one before. Longer flights are noted, for a step must not be so long that it does not see
    /// them.
    pub(super) fn capture(
        &mut self,
        t: f64,
        y: &mut [f64],
        reached: &Reached,
        parting: &[usize],
        struck: &[usize],
    ) -> Result<bool, Trouble> {
        self.place(t, y);
        self.balance.solve()?;
        let limits: Vec<usize> = parting.iter().map(|&i| reached.limits[i]).collect();
        let back = self.balance.gap_accelerations(&limits);
        let speeds = parting.iter().map(|&i| reached.rates[i]);
        let flights: Vec<f64> =
            speeds.zip(&back).map(|(v, &a)| if a < 0.0 { -2.0 * v / a } else { f64::INFINITY }).collect();
        let (brief, before) = (BRIEF * self.balance.length / self.speed, self.flight.take());
        let over: Vec<usize> = (0..limits.len()).filter(|&i| flights[i] <= brief).collect();
        let next = (0..limits.len()).min_by(|&a, &b| flights[a].total_cmp(&flights[b])).expect("something parts");
        if over.is_empty() {
            let of = struck.iter().copied().chain([limits[next]]).collect();
            self.flight = flights[next].is_finite().then_some((of, flights[next]));
            return Ok(false);
        }
        let flight = over.iter().map(|&i| flights[i]).fold(0.0, f64::max);
        let over: Vec<usize> = over.iter().map(|&i| limits[i]).collect();
        // What rocks alternates between its feet.
        let same = before.filter(|(of, _)| over.iter().any(|l| of.contains(l)));
        let part = same.map_or(0.0, |(_, before)| (flight / before).min(0.999));
        let n = self.balance.m.freedom();
        let (energy, earlier) = (self.balance.kinetic_energy(), y.to_vec());
        let fastest = parting.iter().map(|&i| reached.rates[i]).fold(0.0, f64::max);
        for &limit in &over {
            // What rocks comes to rest as a whole; what slides goes on sliding.
            let rocks =
                self.balance.m.limits[limit].friction.is_some() && self.balance.slide_rate(limit).abs() <= fastest;
            self.balance.mode.limits[limit].hold = if rocks { Hold::Stuck } else { Hold::Smooth };
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

    /// Contacts that jam seize: the impact without a collision that brings their sliding to an end (Génot & Brogliato
    /// 1999, *European Journal of Mechanics A* 18). Answers whether anything did.
    pub(super) fn seize(&mut self, t: f64, y: &mut [f64], limits: &[usize]) -> Result<bool, Trouble> {
        self.place(t, y);
        let reached = self.balance.reach(limits.to_vec())?;
        let (before, scale) = (y.to_vec(), self.judgement());
        let Some(blow) = self.balance.jam(&reached, scale)? else { return Ok(false) };
        let (blow, lost) = self.strike(t, y, blow)?;
        let hit = hit(&blow);
        let jammed = (0..reached.limits.len()).filter(|&i| hit[i]);
        let jammed: Vec<usize> = jammed.map(|i| reached.limits[i]).collect();
        self.note_jump(Change {
            t,
            kind: "impact",
            of: self.names(&jammed),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(&reached, &blow)),
            note: blow.note,
        });
        Ok(true)
    }
}

/// Of each limit reached whether it has an impulse.
fn hit(blow: &Blow) -> Vec<bool> {
    let most = blow.normal.iter().fold(0.0_f64, |most, &p| most.max(p));
    blow.normal.iter().map(|&p| p > NOTHING * most).collect()
}

/// How a limit is held during a blow: it slides where its friction is all used up.
fn held(normal: f64, tangent: f64, friction: f64) -> Hold {
    match friction {
        0.0 => Hold::Smooth,
        _ if tangent.abs() < USED_UP * friction * normal => Hold::Stuck,
        _ => Hold::Sliding(-tangent.signum()),
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
        (Err(NoImpact::Ambiguous(all)), Rule::Law(_)) => {
            let n = all.len();
            let note = format!("Taken as plastic, and of {n} outcomes as the one that leaves least energy.");
            return Ok((complementarity::least(all), Some(note)));
        }
        (Err(e), _) => {
            return Err(Trouble::new("no_impact", format!("no impulses at {names} satisfy the law of impact: {e}")))
        }
    };
    let note = (!settled.notes.is_empty()).then(|| settled.notes.join("; "));
    Ok((settled.impulses, note))
}

/// The impulses of a strike without restitution, on limits that yield by a share of themselves.
fn yielding(strike: &Strike, share: f64, names: &str) -> Result<(complementarity::Impulses, Option<String>), Trouble> {
    let impulses = complementarity::yielding(strike, share)
        .map_err(|e| Trouble::new("no_impact", format!("no impulses at {names} satisfy the law of impact: {e}")))?;
    let note = format!("Taken as plastic, e = 0, at touches that yield by {share:.0e} of themselves: of rigid ones no impulses were found that create no energy.");
    Ok((impulses, Some(note)))
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
