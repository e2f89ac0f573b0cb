//! Coulomb friction on a table, seen from above.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::{Force, PointForce};

/// Friction against the velocity of each of the points on which a body lies; the table stands still. What is at rest has
/// no such force: the model file ends the run there.
pub struct TableFriction;

impl ForceKind for TableFriction {
    fn card(&self) -> Card {
        Card::new(
            "table_friction",
            "Coulomb friction on a table seen from above; the points on which a body lies share its load evenly.",
        )
        .needs("points", FieldKind::Points, Role::Number, "m", "the points of the body on which it lies")
        .needs("friction", FieldKind::Number, Role::Number, "", "the coefficient of sliding")
        .needs("load", FieldKind::Number, Role::Number, "N", "the force with which it presses on the table")
        .takes(
            "rest_speed",
            FieldKind::Number,
            "m/s",
            "1e-10",
            "mean speed of the points at which the run ends, by the event `FORCE rests`",
        )
        .loads(&[LoadCard::force("friction", "value", "F")])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let sites = fields.sites("points")?;
        let share = fields.number("friction")? * fields.number("load")? / ModelExpr::constant(sites.len() as f64);
        let rate = |variable| ModelExpr::variable(variable).rate();
        let on = |site| {
            let (vx, vy) = (rate(ModelVariable::X(site)), rate(ModelVariable::Y(site)));
            let slope = share.clone() / vx.clone().hypot(vy.clone());
            PointForce { site, x: -(slope.clone() * vx), y: -(slope * vy), value: None, with_body: false }
        };
        Ok(Force { point_forces: sites.into_iter().map(on).collect(), ..Force::default() })
    }
}
