//! Any law on any gauge.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::Force;

/// A law on a gauge.
pub struct General;

impl ForceKind for General {
    fn card(&self) -> Card {
        Card::new("law", "A force that acts to increase a gauge, given by an expression.")
            .needs("along", FieldKind::Gauge, Role::Number, "", "the gauge")
            .needs("value", FieldKind::Law, Role::Number, "", "the force (N) or couple (N·m)")
            .takes("potential", FieldKind::Gauge, "J", "", "its potential energy, if it has one")
            .loads(&[LoadCard::force("force", "value", "F")])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let potential = if fields.given("potential") { Some(fields.gauge("potential")?) } else { None };
        Ok(Force::along_gauge(fields.gauge("along")?, fields.law("value")?, potential))
    }
}
