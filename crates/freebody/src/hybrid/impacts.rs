//! Impacts: impacts of unilateral constraints that are closed, and contacts that jam.

use super::mode_changes::{ContactImpulse, Impulses, ModeChange};
use super::HybridSystem;
use crate::contact::complementarity::{self, ImpactLaw, ImpactProblem, NoImpact};
use crate::dynamics::{ClosedContacts, ContactTolerances, DynamicsError, ImpactSolution};
use crate::mode::{ContactMode, Mode};
use crate::plane::Vec2;

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
        let before = y.to_vec();
        let restitution = self.restitutions(t, contacts);
        let (impact, lost, left) = self.collide(t, y, contacts, &restitution)?;
        let raised = rest_speed.max(left);
        let (part, hit) = (contacts.takes_part(rest_speed), hit(&impact));
        let impacting = (0..part.len()).filter(|&i| part[i] && hit[i]);
        let impacting: Vec<usize> = impacting.map(|i| contacts.constraints[i]).collect();
        let m = self.workspace.m;
        impacting.iter().for_each(|&l| self.collided[m.unilateral[l].group] = t);
        let string = |&l: &usize| m.groups[m.unilateral[l].group].word == "string";
        self.record_jump(ModeChange {
            t,
            kind: if impacting.iter().all(string) { "taut" } else { "impact" },
            of: self.names(&impacting),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(contacts, &impact, &restitution, raised)),
            note: impact.note,
        });
        Ok((impacting, raised))
    }

    /// Impulses with these restitutions, of rigid contacts or else of ones that yield; the velocities after them, the
    /// energy lost, and the speed that yielding left over.
    pub(super) fn collide(
        &mut self,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        restitution: &[f64],
    ) -> Result<(ImpactSolution, f64, f64), DynamicsError> {
        let (rule, names) = (self.rule, self.workspace.names_of(&contacts.constraints));
        let impact = self.workspace.solve_impact(contacts, restitution, |problem| decide(problem, rule, &names));
        let mut applied = impact.and_then(|impact| self.apply_impact(t, y, contacts, impact));
        let mut left = 0.0;
        for share in REGULARIZATION.into_iter().filter(|_| rule != Rule::Stop) {
            if applied.is_err() {
                let impact =
                    self.workspace.solve_impact(contacts, restitution, |problem| regularized(problem, share, &names));
                applied = impact.and_then(|impact| self.apply_impact(t, y, contacts, impact));
                left = applied.as_ref().map_or(0.0, |(impact, _)| self.speed_left(contacts, impact, share));
            }
        }
        applied.map(|(impact, lost)| (impact, lost, left))
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

    fn impulses(
        &self,
        contacts: &ClosedContacts,
        impact: &ImpactSolution,
        restitution: &[f64],
        rest_speed: f64,
    ) -> Impulses {
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
            mode.contacts_mut()[contacts.constraints[i]].mode = held(impact.normal[i], impact.tangent[i], friction);
        }
        let unloaded: Vec<usize> = unloaded.iter().map(|&i| contacts.constraints[i]).collect();
        let impacting = impacting.iter().map(|&i| ContactImpulse {
            name: m.groups[m.unilateral[contacts.constraints[i]].group].name.clone(),
            normal: impact.normal[i] * self.workspace.lever(contacts.constraints[i]),
            tangent: impact.tangent[i],
            restitution: restitution[i],
            slides: match mode.contacts[contacts.constraints[i]].mode {
                ContactMode::Slip(sense) => Some(sense),
                ContactMode::Stick => Some(0.0),
                _ => None,
            },
        });
        let (impacting, unloaded) = (impacting.collect(), self.names(&unloaded));
        let (drives, drive_works) = (impact.drives.clone(), impact.drive_works.clone());
        Impulses { groups, joints, drives, drive_works, contacts: impacting, unloaded, mode }
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
        let (hit, restitution) = (hit(&impact), self.restitutions(t, &contacts));
        let impacting = (0..contacts.constraints.len()).filter(|&i| hit[i]);
        let impacting: Vec<usize> = impacting.map(|i| contacts.constraints[i]).collect();
        self.record_jump(ModeChange {
            t,
            kind: "impact",
            of: self.names(&impacting),
            lost,
            states: Some([before, y.to_vec()]),
            impulses: Some(self.impulses(&contacts, &impact, &restitution, tolerances.rest_speed)),
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
