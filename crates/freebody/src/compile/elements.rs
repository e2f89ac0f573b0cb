//! Couplings and motions, forces, events.

use super::{twice, CompileError, Compiler, Fields, Names, Reach, Result};
use crate::gauges::{Law, Leaf};
use crate::joints::{Card, FieldKind, Role};
use crate::mechanism::{Deed, Drive, Event, Level};
use crate::spec::Action;

/// The card of a coupling, which joins gauges rather than bodies.
pub fn coupling_card() -> Card {
    Card::new("coupling", "An expression of the configuration stays 0.").needs(
        "zero",
        FieldKind::Gauge,
        Role::Number,
        "",
        "the expression",
    )
}

impl Compiler<'_> {
    pub(crate) fn drives(&mut self) -> Result<()> {
        for element in self.spec.joints.iter().filter(|e| e.kind == "coupling") {
            let path = format!("joints.{}", element.name);
            let card = coupling_card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let of = fields.gauge("zero")?;
            let law = Law::constant(0.0);
            let name = element.name.clone();
            self.drive(
                &path,
                Drive { name, coupling: true, of, law, level: Level::Position, by: None, feedback: false },
            )?;
        }
        for motion in &self.spec.motions {
            let path = format!("motions.{}", motion.name);
            let of = self.law(&format!("{path}.of"), &motion.of, Reach::Configuration)?;
            let law = self.law(&format!("{path}.is"), &motion.law, Reach::Motion)?;
            let by = match &motion.by {
                Some(by) => Some(self.law(&format!("{path}.by"), by, Reach::Configuration)?),
                None => None,
            };
            let level = match motion.level.as_str() {
                "position" => Level::Position,
                "velocity" => Level::Velocity,
                "acceleration" => Level::Acceleration,
                word => {
                    let what = format!("`{word}` is no level of a motion");
                    return Err(CompileError::new(
                        format!("{path}.level"),
                        what,
                        "write position, velocity or acceleration",
                    ));
                }
            };
            if level != Level::Acceleration && law.depends_on_rates() {
                let what = "a law of rates gives an acceleration, not a position or a velocity";
                return Err(CompileError::new(format!("{path}.is"), what, "write `level: acceleration`"));
            }
            let feedback = law.leaves().any(|l| !matches!(l, Leaf::Time | Leaf::Parameter(_)));
            let name = motion.name.clone();
            self.drive(&path, Drive { name, coupling: false, of, law, level, by, feedback })?;
        }
        Ok(())
    }

    fn drive(&mut self, path: &str, drive: Drive) -> Result<()> {
        let taken = self.names.joints.contains_key(&drive.name);
        if taken || self.names.drives.insert(drive.name.clone(), self.m.drives.len()).is_some() {
            return Err(twice(path, &drive.name));
        }
        if self.m.bodies_of(&drive.of).is_empty() {
            return Err(CompileError::new(
                path,
                "this gauge measures no body that can move",
                "name a coordinate, a point or an angle",
            ));
        }
        self.m.drives.push(drive);
        Ok(())
    }

    pub(crate) fn forces(&mut self) -> Result<()> {
        for element in &self.spec.forces {
            let path = format!("forces.{}", element.name);
            let Some(kind) = crate::forces::named(&element.kind) else {
                let words: Vec<String> = crate::forces::ALL.iter().map(|f| f.card().word.to_string()).collect();
                let message = super::names::unknown("type of force", &element.kind, words.iter());
                return Err(CompileError::from(format!("{path}.type"), message));
            };
            let card = kind.card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let mut force = kind.lower(&mut fields)?;
            force.name = element.name.clone();
            force.word = card.word;
            for pull in &mut force.pulls {
                pull.bodies = self.m.bodies_of(&pull.gauge);
            }
            if self.names.forces.insert(force.name.clone(), self.m.forces.len()).is_some() {
                return Err(twice(path, &force.name));
            }
            self.m.forces.push(force);
        }
        Ok(())
    }

    pub(crate) fn events(&mut self) -> Result<()> {
        for event in &self.spec.events {
            let path = format!("events.{}", event.name);
            let when = self.law(&format!("{path}.when"), &event.when, Reach::Instant)?;
            let condition = match &event.condition {
                Some(text) => {
                    Some(self.scope(Reach::Instant).condition(text).map_err(|e| Names::complaint(&path, text, e))?)
                }
                None => None,
            };
            let mut then = vec![];
            for action in &event.then {
                match action {
                    Action::Stop => then.push(Deed::Stop),
                    Action::Set(values) => {
                        for (name, text) in values {
                            let known = self.names.parameters.keys();
                            let missing = || CompileError::from(&path, super::names::unknown("parameter", name, known));
                            let p = *self.names.parameters.get(name).ok_or_else(missing)?;
                            then.push(Deed::Set(p, self.law(&path, text, Reach::Instant)?));
                        }
                    }
                    Action::Release(_) | Action::Engage(_) | Action::Lock(_) | Action::Unlock(_) | Action::Reset(_) => {
                    }
                }
            }
            self.m.events.push(Event {
                name: event.name.clone(),
                when,
                direction: event.direction,
                condition,
                opening: event.opening,
                guard: event.guard,
                then,
            });
        }
        Ok(())
    }
}
