//! Couples between two bodies.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::Force;

/// The turn of `on` against `from`.
fn turn(fields: &mut Fields) -> Result<ModelExpr, CompileError> {
    let (on, from) = (fields.turning_body("on")?, fields.turning_body("from")?);
    Ok(ModelExpr::variable(ModelVariable::Angle(on)) - ModelExpr::variable(ModelVariable::Angle(from)))
}

fn between(card: Card) -> Card {
    card.needs("on", FieldKind::Body, Role::Number, "", "the body it acts on").takes(
        "from",
        FieldKind::Body,
        "",
        "ground",
        "the body that feels the opposite",
    )
}

/// A torque or motor.
pub struct Torque;

impl ForceKind for Torque {
    fn card(&self) -> Card {
        between(Card::new("torque", "A couple on one body, from another, counter-clockwise."))
            .needs("value", FieldKind::Law, Role::Number, "N*m", "the couple")
            .loads(&[LoadCard::couple("couple", "value")])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        Ok(Force::along_gauge(turn(fields)?, fields.law("value")?, None))
    }
}

/// A torsion spring with a damper.
pub struct TorsionSpring;

impl ForceKind for TorsionSpring {
    fn card(&self) -> Card {
        between(Card::new("torsion_spring", "A couple against the turn of one body relative to another."))
            .needs("stiffness", FieldKind::Number, Role::Number, "N*m/rad", "couple for each radian")
            .takes("rest_angle", FieldKind::Number, "rad", "0", "turn without couple")
            .takes("damping", FieldKind::Number, "N*m*s/rad", "0", "couple for each radian a second")
            .loads(&[LoadCard::couple("spring", "value"), LoadCard::couple("damper", "value")])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let gauge = turn(fields)?;
        super::spring::elastic(gauge, fields, "rest_angle")
    }
}
