//! Impacts: impacts of unilateral constraints that are closed, the end of bounces without end, and contacts that jam.

use super::mode_changes::{ContactImpulse, Impulses, ModeChange};
use super::HybridSystem;
use crate::contact::complementarity::{self, ImpactLaw, ImpactProblem, NoImpact};
use crate::dynamics::{ClosedContacts, ContactTolerances, DynamicsError, ImpactSolution};
use crate::mode::{ContactMode, Mode};
use crate::plane::Vec2;

/// Flight between bounces, over the time in which the mechanism moves its own length, that is not followed any more:
/// its height comes near the round-off of the gap.
const SHORTEST_FLIGHT: f64 = 1e-5;
/// The same in a pile, of more contacts than this, where each bounce sets off others and none is of consequence.
const SHORTEST_FLIGHT_IN_PILE: f64 = 1e-3;
const PILE: usize = 8;
/// Change of a rate over the speed of parting beyond which bounces are not what it would end.
const UNRELATED: f64 = 1e4;
/// Largest ratio of one bounce to the one before of which a series is summed: nearer to 1 its end would be infinitely far.
const SUMMABLE: f64 = 0.999;
/// Part of the kinetic energy by which it may rise in an impact, as round-off.
const RISE: f64 = 1e-11;
/// Shares of themselves by which unilateral constraints yield, one after the other, where impulses of rigid ones are
/// lost in round-off.
const REGULARIZATION: [f64; 4] = [1e-12, 1e-10, 1e-8, 1e-6];
/// Speed, over the mechanism's own, up to which what yielding, or a long row of impacts, leaves over counts as none.
pub(super) const LEFT_OVER: f64 = 1e-6;
/// Energy that it would take to stop an approach, over that of the mechanism, from which on nothing yields.
const RIGID: f64 = 1e12;
/// Part of the largest impulse below which one is round-off.
const NO_IMPULSE: f64 = 1e-12;
/// Part of what friction can do in an impact from which on all of it is used up.
const USED_UP: f64 = 1.0 - 1e-9;

/// What to do about impacts whose outcome rigid bodies leave open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// End the run by name.
    Stop,
    /// Take a law.
    Law(ImpactLaw),
}

impl Rule {
    /// Every rule with its word.
    pub const ALL: &'static [(&'static str, Rule)] = &[
        ("stop", Rule::Stop),
        ("newton", Rule::Law(ImpactLaw::Newton)),
        ("poisson", Rule::Law(ImpactLaw::Poisson)),
        ("sequential", Rule::Law(ImpactLaw::Sequential)),
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

impl HybridSystem<'_> {
    /// The constraints that are closed collide: returns those that did, and the speed that counts as none from now on
    /// in this instant.
    pub(super) fn impact(
        &mut self,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        rest_speed: f64,
    ) -> Result<(Vec<usize>, f64), DynamicsError> {
        self.refuse_driven_together(contacts)?;
        self.check_direction(&contacts.constraints)?;
        let restitution: Vec<f64> = contacts.constraints.iter().map(|&l| self.workspace.restitution(l)).collect();
        let names = self.workspace.names_of(&contacts.constraints);
        let rule = self.rule;
        let (before, mut raised) = (y.to_vec(), rest_speed);
        let impact = self.workspace.solve_impact(contacts, &restitution, |problem| decide(problem, rule, &names));
        let mut impacting = impact.and_then(|impact| self.apply_impact(t, y, contacts, impact));
        for share in REGULARIZATION.into_iter().filter(|_| rule != Rule::Stop) {
            if impacting.is_err() {
                let impact =
                    self.workspace.solve_impact(contacts, &restitution, |problem| regularized(problem, share, &names));
                impacting = impact.and_then(|impact| self.apply_impact(t, y, contacts, impact));
                if let Ok((impact, _)) = &impacting {
                    raised = raised.max(self.speed_left(contacts, impact, share));
                }
            }
        }
        let (impact, lost) = impacting?;
        let (part, hit) = (contacts.takes_part(rest_speed), hit(&impact));
        let impacting = (0..part.len()).filter(|&i| part[i] && hit[i]);
        let impacting: Vec<usize> = impacting.map(|i| contacts.constraints[i]).collect();
        let m = self.workspace.m;
        let string = |&l: &usize| m.groups[m.unilateral[l].group].word == "string";
        self.record_jump(ModeChange {
            t,
            kind: if impacting.iter().all(string) { "taut" } else { "impact" },
            of: self.names(&impacting),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(contacts, &impact, raised)),
            note: impact.note,
        });
        Ok((impacting, raised))
    }

    /// Takes the velocities after an impact, with the work of the drives and the energy lost in it, if there is any
    /// lost: large impulses that all but cancel can bring energy from nowhere.
    fn apply_impact(
        &mut self,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        impact: ImpactSolution,
    ) -> Result<(ImpactSolution, f64), DynamicsError> {
        let n = self.workspace.m.freedom();
        let (before, energy) = (y.to_vec(), self.workspace.kinetic_energy());
        y[n..2 * n].iter_mut().zip(&impact.change).for_each(|(u, d)| *u += d);
        self.place_in(&contacts.opened, t, y);
        let work = self.add_drive_works(y, &impact.drive_works);
        let lost = energy + work - self.workspace.kinetic_energy();
        if lost >= -RISE * (energy + work.abs()) {
            return Ok((impact, lost));
        }
        y.copy_from_slice(&before);
        self.place_in(&contacts.opened, t, y);
        Err(DynamicsError::ImpulsesCreateEnergy(t, -lost))
    }

    /// Refuses what approaches though hardly any impulse could stop it: its response to one is round-off.
    fn refuse_driven_together(&self, contacts: &ClosedContacts) -> Result<(), DynamicsError> {
        let energy = self.workspace.kinetic_energy() + self.strength * self.workspace.length;
        let rates = contacts.constraints.iter().enumerate().map(|(i, &l)| (i, l, contacts.rates[i]));
        let rigid = rates.filter(|&(i, _, v)| v < 0.0 && contacts.response(i) * RIGID * energy < v * v);
        let rigid: Vec<usize> = rigid.map(|(_, l, _)| l).collect();
        match rigid.is_empty() {
            true => Ok(()),
            false => Err(DynamicsError::DrivenTogether(self.workspace.names_of(&rigid))),
        }
    }

    /// The speed that yielding left over, m/s; 0 where it is too large to count as none.
    fn speed_left(&self, contacts: &ClosedContacts, impact: &ImpactSolution, share: f64) -> f64 {
        let left = contacts.speeds_of(&impact.normal, &impact.tangent).map(|v| 2.0 * share * v).fold(0.0, f64::max);
        if left <= LEFT_OVER * self.speed {
            left
        } else {
            0.0
        }
    }

    fn impulses(&self, contacts: &ClosedContacts, impact: &ImpactSolution, rest_speed: f64) -> Impulses {
        let m = self.workspace.m;
        let mut groups: Vec<(String, Vec2)> = vec![];
        for (&l, &p) in contacts.constraints.iter().zip(&impact.on_first) {
            let name = &m.groups[m.unilateral[l].group].name;
            match groups.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += p,
                None => groups.push((name.clone(), p)),
            }
        }
        let most = groups.iter().map(|(_, p)| p.norm()).fold(0.0, f64::max);
        groups.retain(|(_, p)| p.norm() > NO_IMPULSE * most);
        let joints = impact.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect();
        let (part, hit) = (contacts.takes_part(rest_speed), hit(impact));
        let (impacting, unloaded): (Vec<usize>, Vec<usize>) =
            (0..part.len()).filter(|&i| part[i]).partition(|&i| hit[i]);
        let mut mode = contacts.opened.clone();
        for &i in &impacting {
            let friction = self.workspace.friction_of(contacts.constraints[i]);
            mode.contacts[contacts.constraints[i]].mode = held(impact.normal[i], impact.tangent[i], friction);
        }
        let unloaded: Vec<usize> = unloaded.iter().map(|&i| contacts.constraints[i]).collect();
        let impacting = impacting.iter().map(|&i| ContactImpulse {
            name: m.groups[m.unilateral[contacts.constraints[i]].group].name.clone(),
            normal: impact.normal[i] * self.workspace.lever(contacts.constraints[i]),
            tangent: impact.tangent[i],
            restitution: self.workspace.restitution(contacts.constraints[i]),
        });
        let (impacting, unloaded) = (impacting.collect(), self.names(&unloaded));
        let (drives, drive_works) = (impact.drives.clone(), impact.drive_works.clone());
        Impulses { groups, joints, drives, drive_works, contacts: impacting, unloaded, mode }
    }

    /// The mode after bounces without end, if they are over within a moment: what takes part in them comes to rest.
    ///
    /// A flight after a bounce lasts twice the speed of parting over the acceleration of return, and each of a series
    /// lasts a constant part of the one before. Longer flights are noted, for a step must not be so long that it does
    /// not see them.
    pub(super) fn zeno_limit(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        parting: &[usize],
        impacting: &[usize],
    ) -> Result<Option<Mode>, DynamicsError> {
        self.place_in(mode, t, y);
        self.workspace.solve()?;
        let constraints: Vec<usize> = parting.iter().map(|&i| contacts.constraints[i]).collect();
        let back = self.workspace.gap_accelerations(&constraints);
        let speeds = parting.iter().map(|&i| contacts.rates[i]);
        let flights: Vec<f64> =
            speeds.zip(&back).map(|(v, &a)| if a < 0.0 { -2.0 * v / a } else { f64::INFINITY }).collect();
        let is_pile = contacts.constraints.len() > PILE;
        let shortest = if is_pile { SHORTEST_FLIGHT_IN_PILE } else { SHORTEST_FLIGHT };
        let (brief, before) = (shortest * self.workspace.length / self.speed, self.bounce_interval.take());
        let over: Vec<usize> = (0..constraints.len()).filter(|&i| flights[i] <= brief).collect();
        let next = (0..constraints.len()).min_by(|&a, &b| flights[a].total_cmp(&flights[b])).expect("something parts");
        if over.is_empty() {
            let of = impacting.iter().copied().chain([constraints[next]]).collect();
            self.bounce_interval = flights[next].is_finite().then_some((of, flights[next]));
            return Ok(None);
        }
        let flight = over.iter().map(|&i| flights[i]).fold(0.0, f64::max);
        let over: Vec<usize> = over.iter().map(|&i| constraints[i]).collect();
        // What rocks alternates between its feet.
        let same = before.filter(|(of, _)| over.iter().any(|l| of.contains(l)));
        let part = same.map_or(0.0, |(_, before)| (flight / before).min(SUMMABLE));
        let (energy, earlier) = (self.workspace.kinetic_energy(), y.to_vec());
        let fastest = parting.iter().map(|&i| contacts.rates[i]).fold(0.0, f64::max);
        let parts = constraints.iter().zip(parting).map(|(&l, &i)| contacts.rates[i] * self.workspace.lever(l));
        let (parts, n) = (parts.fold(0.0, f64::max), self.workspace.m.freedom());
        let mut mode = mode.clone();
        for &constraint in &over {
            // What rocks comes to rest as a whole; what slides goes on sliding.
            let rocks = self.workspace.m.unilateral[constraint].friction.is_some()
                && self.workspace.slide_rate(constraint).abs() <= fastest;
            mode.contacts[constraint].mode = if rocks { ContactMode::Stick } else { ContactMode::Frictionless };
        }
        let work = self.project_velocities(&mode, t, y)?;
        let change = |i: usize| (y[n + i] - earlier[n + i]).abs() / self.units[i] * self.workspace.length;
        if (0..n).map(change).fold(0.0, f64::max) > UNRELATED * parts {
            y.copy_from_slice(&earlier);
            return Ok(None);
        }
        let lost = energy + work - self.workspace.kinetic_energy();
        self.begin_phase(t, -lost);
        self.record(ModeChange {
            t: t + flight / (1.0 - part),
            kind: "rest",
            of: self.names(&over),
            lost,
            states: Some([earlier, y.to_vec()]),
            impulses: None,
            note: Some(format!("the bounces from t = {t:.12} s on, infinitely many, have come to an end")),
        });
        Ok(Some(mode))
    }

    /// Contacts that jam: the impact without a collision that brings their sliding to an end (Génot & Brogliato
    /// 1999, *European Journal of Mechanics A* 18). Answers whether anything did.
    pub(super) fn impact_without_collision(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        constraints: &[usize],
        tolerances: ContactTolerances,
    ) -> Result<bool, DynamicsError> {
        self.place_in(mode, t, y);
        let contacts = self.workspace.closed_contacts(constraints.to_vec())?;
        let before = y.to_vec();
        let Some(impact) = self.workspace.impact_without_collision(&contacts, tolerances)? else { return Ok(false) };
        let (impact, lost) = self.apply_impact(t, y, &contacts, impact)?;
        let hit = hit(&impact);
        let impacting = (0..contacts.constraints.len()).filter(|&i| hit[i]);
        let impacting: Vec<usize> = impacting.map(|i| contacts.constraints[i]).collect();
        self.record_jump(ModeChange {
            t,
            kind: "impact",
            of: self.names(&impacting),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(&contacts, &impact, tolerances.rest_speed)),
            note: impact.note,
        });
        Ok(true)
    }
}

/// Of each unilateral constraint reached whether it has an impulse.
fn hit(impact: &ImpactSolution) -> Vec<bool> {
    let most = impact.normal.iter().fold(0.0_f64, |most, &p| most.max(p));
    impact.normal.iter().map(|&p| p > NO_IMPULSE * most).collect()
}

/// How a unilateral constraint is held during an impact: it slides where its friction is all used up.
fn held(normal: f64, tangent: f64, friction: f64) -> ContactMode {
    match friction {
        0.0 => ContactMode::Frictionless,
        _ if tangent.abs() < USED_UP * friction * normal => ContactMode::Stick,
        _ => ContactMode::Slip(-tangent.signum()),
    }
}

/// The impulses of an impact, by the rule where laws differ.
fn decide(
    problem: &ImpactProblem,
    rule: Rule,
    names: &str,
) -> Result<(complementarity::Impulses, Option<String>), DynamicsError> {
    let law = match rule {
        Rule::Law(law) => law,
        Rule::Stop => match complementarity::undecided(problem) {
            Some(alternatives) => return Err(undecided(names, &alternatives)),
            None => ImpactLaw::Newton,
        },
    };
    let resolved = match (complementarity::solve_impact(problem, law), rule) {
        (Ok(resolved), _) => resolved,
        (Err(NoImpact::Ambiguous(all)), Rule::Law(_)) => {
            let n = all.len();
            let note = format!("Taken as plastic, and of {n} outcomes as the one that leaves least energy.");
            return Ok((complementarity::least(all), Some(note)));
        }
        (Err(e), _) => {
            return Err(DynamicsError::NoImpulses(names.to_string(), "satisfy the law of impact", e.to_string()))
        }
    };
    let note = (!resolved.notes.is_empty()).then(|| resolved.notes.join("; "));
    Ok((resolved.impulses, note))
}

/// The impulses of an impact without restitution, on unilateral constraints that yield by a share of themselves.
fn regularized(
    problem: &ImpactProblem,
    share: f64,
    names: &str,
) -> Result<(complementarity::Impulses, Option<String>), DynamicsError> {
    let impulses = complementarity::compliant_regularization(problem, share)
        .map_err(|e| DynamicsError::NoImpulses(names.to_string(), "satisfy the law of impact", e.to_string()))?;
    let note = format!("Taken as plastic, e = 0, at touches that yield by {share:.0e} of themselves: of rigid ones no impulses were found that create no energy.");
    Ok((impulses, Some(note)))
}

fn undecided(names: &str, alternatives: &[(ImpactLaw, complementarity::Impulses)]) -> DynamicsError {
    let outcomes: Vec<String> = alternatives
        .iter()
        .map(|(law, impulses)| {
            let speeds: Vec<String> =
                impulses.after[..impulses.normal.len()].iter().map(|v| format!("{v:.6}")).collect();
            format!("by {} they part at {} m/s", Rule::Law(*law).word(), speeds.join(", "))
        })
        .collect();
    DynamicsError::SimultaneousImpact(names.to_string(), outcomes)
}
