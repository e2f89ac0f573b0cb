//! Events and what they do; parts that are released and engaged.

use crate::builder::{unknown, Builder, Names, Reach, Result};
use crate::error::CompileError;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::Joint as _;
use crate::mechanism::{CurveFollower, Drive, DriveKind, Event, EventAction, Level, Part};
use crate::spec::{Action, Element, Event as EventSpec, Spec};

/// Whether a joint is there all the time; one that comes or goes cannot be in the tree.
pub(super) fn stays(spec: &Spec, joint: &Element) -> bool {
    let switched = |action: &Action| match action {
        Action::Release(names) | Action::Engage(names) => names.contains(&joint.name),
        _ => false,
    };
    joint.engaged && !spec.events.iter().flat_map(|event| &event.then).any(switched)
}

impl Builder<'_> {
    /// A row for every gauge that an event locks; it holds only from then on.
    pub(crate) fn locks(&mut self) -> Result<()> {
        for event in &self.spec.events {
            let path = format!("events.{}.then", event.name);
            for action in &event.then {
                let Action::Lock(texts) = action else { continue };
                for text in texts {
                    let name = lock(text);
                    if self.names.drives.contains_key(&name) {
                        continue;
                    }
                    let of = self.law(&path, text, Reach::Configuration)?;
                    self.m.initially_absent.push(Part::Drive(self.m.drives.len()));
                    let (law, level) = (ModelExpr::constant(0.0), Level::Velocity);
                    self.drive(
                        &path,
                        Drive { name, kind: DriveKind::Lock, of, law, level, by: None, feedback: false },
                    )?;
                }
            }
        }
        Ok(())
    }

    /// Of every joint along a curve that can be released, the pin that is released and a row that then holds what runs
    /// on the curve.
    pub(crate) fn curve_followers(&mut self) -> Result<()> {
        for element in self.spec.joints.iter().filter(|element| !stays(self.spec, element)) {
            let Some(&(joint, _)) = self.names.joints.get(&element.name) else { continue };
            if self.m.joints[joint].kind.card().is_one_sided() {
                let what = "what only pushes opens and closes by itself";
                let hint = format!("release its stop, `{}.contact`", element.name);
                return Err(CompileError::new(format!("joints.{}", element.name), what, hint));
            }
            let Some(pin) = self.m.pin_of(joint) else { continue };
            let hold = self.m.drives.len();
            let (name, of) = (element.name.clone(), ModelExpr::variable(ModelVariable::Coordinate(joint, 0)));
            let (law, level) = (ModelExpr::constant(0.0), Level::Velocity);
            self.m.initially_absent.push(Part::Drive(hold));
            self.m.drives.push(Drive { name, kind: DriveKind::Hold, of, law, level, by: None, feedback: false });
            self.m.curve_followers.push(CurveFollower { joint, released_joint: pin, hold });
        }
        Ok(())
    }

    pub(crate) fn events(&mut self) -> Result<()> {
        for event in &self.spec.events {
            let path = format!("events.{}", event.name);
            let when = self.law(&format!("{path}.when"), &event.when, Reach::Instant)?;
            let condition = match &event.condition {
                Some(text) => {
                    Some(self.scope(Reach::Instant).condition(text).map_err(|e| Names::error(&path, text, e))?)
                }
                None => None,
            };
            let then = self.event_actions(event, &format!("{path}.then"))?;
            let (name, direction) = (event.name.clone(), event.direction);
            let (opening, guard) = (event.opening, event.guard);
            self.m.events.push(Event { name, when, direction, condition, opening, guard, then });
        }
        Ok(())
    }

    fn event_actions(&mut self, event: &EventSpec, path: &str) -> Result<Vec<EventAction>> {
        let mut actions = vec![];
        for action in &event.then {
            match action {
                Action::Stop => actions.push(EventAction::Stop),
                Action::Set(values) => {
                    for (name, text) in values {
                        let known = self.names.parameters.keys().chain(self.names.states.keys());
                        let missing = || CompileError::from(path, unknown("parameter", name, known));
                        let state = self.names.states.get(name).map(|i| self.m.first_state() + i);
                        let p = self.names.parameters.get(name).copied().or(state).ok_or_else(missing)?;
                        actions.push(EventAction::Set(p, self.law(path, text, Reach::Instant)?));
                    }
                }
                Action::Release(names) => {
                    actions.extend(self.parts(path, names)?.into_iter().map(EventAction::Release))
                }
                Action::Engage(names) => actions.extend(self.parts(path, names)?.into_iter().map(EventAction::Engage)),
                Action::Lock(texts) => actions.extend(self.locked(path, texts)?.into_iter().map(EventAction::Engage)),
                Action::Unlock(texts) => {
                    actions.extend(self.locked(path, texts)?.into_iter().map(EventAction::Release))
                }
                Action::Reset(rates) => {
                    for (gauge, rate) in rates {
                        let of = self.law(path, gauge, Reach::Configuration)?;
                        let rate = self.law(path, rate, Reach::Instant)?;
                        actions.push(EventAction::Reset { gauge: gauge.clone(), of, rate });
                    }
                }
            }
        }
        Ok(actions)
    }

    fn parts(&self, path: &str, names: &[String]) -> Result<Vec<Part>> {
        names.iter().map(|name| self.part(path, name)).collect()
    }

    /// The part of a name; of a joint along a curve it is its pin.
    pub(crate) fn part(&self, path: &str, name: &String) -> Result<Part> {
        let n = &self.names;
        if let Some(&(joint, _)) = n.joints.get(name) {
            return Ok(self.m.part_of(joint));
        }
        let others = [
            n.drives.get(name).map(|&i| Part::Drive(i)),
            n.forces.get(name).map(|(i, _)| Part::Force(*i)),
            n.groups.get(name).map(|&i| Part::Group(i)),
        ];
        if let Some(part) = others.into_iter().flatten().next() {
            return Ok(part);
        }
        let known = n.joints.keys().chain(n.drives.keys()).chain(n.forces.keys()).chain(n.groups.keys());
        let what = "joint, motion, force, contact, stop or string";
        Err(CompileError::from(path, unknown(what, name, known)))
    }

    fn locked(&self, path: &str, texts: &[String]) -> Result<Vec<Part>> {
        let find = |text: &String| {
            let missing = || {
                let what = format!("`{text}` is unlocked here, but nothing locks it");
                CompileError::new(path, what, "write it as in the action that locks it")
            };
            self.names.drives.get(&lock(text)).map(|&d| Part::Drive(d)).ok_or_else(missing)
        };
        texts.iter().map(find).collect()
    }

    /// The parts that are not there at the start.
    pub(crate) fn idle(&mut self) -> Result<()> {
        let joints = self.spec.joints.iter().filter(|e| !e.engaged).map(|e| ("joints", &e.name));
        let motions = self.spec.motions.iter().filter(|m| !m.engaged).map(|m| ("motions", &m.name));
        let forces = self.spec.forces.iter().filter(|f| !f.engaged).map(|f| ("forces", &f.name));
        for (section, name) in joints.chain(motions).chain(forces) {
            let part = self.part(&format!("{section}.{name}"), name)?;
            if self.m.held_without(part).is_some() {
                let what = format!("`{name}` runs along a curve and has no place on it before it is there");
                return Err(CompileError::new(
                    format!("{section}.{name}"),
                    what,
                    "engage a slot or a contact in its place",
                ));
            }
            self.m.initially_absent.push(part);
        }
        Ok(())
    }
}

/// The name of the row that locks a gauge.
fn lock(text: &str) -> String {
    format!("lock {text}")
}
