//! Couplings and motions, forces, events.

use crate::builder::{twice, unknown, Builder, Fields, Reach, Result};
use crate::error::CompileError;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::{Card, FieldKind, Role};
use crate::mechanism::{Drive, DriveKind, Level};

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

impl Builder<'_> {
    pub(crate) fn drives(&mut self) -> Result<()> {
        for element in self.spec.joints.iter().filter(|e| e.kind == "coupling") {
            let path = format!("joints.{}", element.name);
            let card = coupling_card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let of = fields.gauge("zero")?;
            let law = ModelExpr::constant(0.0);
            let name = element.name.clone();
            self.drive(
                &path,
                Drive { name, kind: DriveKind::Coupling, of, law, level: Level::Position, by: None, feedback: false },
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
            if level == Level::Position && law.variables().any(|leaf| matches!(leaf, ModelVariable::State(_))) {
                let what = "a state with a rate of its own gives a velocity or an acceleration, not a position";
                return Err(CompileError::new(format!("{path}.is"), what, "give the rate, with `level: velocity`"));
            }
            let feedback = law.variables().any(|l| !matches!(l, ModelVariable::Time | ModelVariable::Parameter(_)));
            let name = motion.name.clone();
            self.drive(&path, Drive { name, kind: DriveKind::Motion, of, law, level, by, feedback })?;
        }
        Ok(())
    }

    pub(super) fn drive(&mut self, path: &str, drive: Drive) -> Result<()> {
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
                let message = unknown("type of force", &element.kind, words.iter());
                return Err(CompileError::from(format!("{path}.type"), message));
            };
            let card = kind.card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let mut force = kind.lower(&mut fields)?;
            force.name = element.name.clone();
            force.word = card.word;
            if force.plate.is_some() {
                self.uncrossed(&format!("{path}.area"), &element.fields["area"])?;
            }
            let plate = if force.plate.is_some() { card.parts.len() } else { 0 };
            let loads = force.gauge_forces.len() + force.point_forces.len() + plate;
            force.cards = card.parts.iter().cycle().take(loads).copied().collect();
            for (pull, card) in force.gauge_forces.iter_mut().zip(&mut force.cards) {
                pull.bodies = self.m.bodies_of(&pull.gauge);
                *card = card.along(self.m.turns(&pull.gauge));
            }
            if self.names.forces.insert(force.name.clone(), (self.m.forces.len(), card)).is_some() {
                return Err(twice(path, &force.name));
            }
            self.m.forces.push(force);
        }
        Ok(())
    }
}
