//! Coulomb friction of a plate on a table, seen from above.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::{Force, PlateFriction as Plate};

/// Friction against the velocity of every point of an area, or of its rim, that is pressed evenly on a table at rest. What is
/// at rest has no such force: the model file ends the run there.
pub struct PlateFriction;

impl ForceKind for PlateFriction {
    fn card(&self) -> Card {
        Card::new(
            "plate_friction",
            "Coulomb friction on a table seen from above; a body lies on it with an area, evenly pressed.",
        )
        .needs("area", FieldKind::Area, Role::Number, "m", "a body by its shape, or a circle or polygon of a body")
        .takes("rim", FieldKind::Flag, "", "false", "whether only the rim of the area lies on the table, as of a ring")
        .needs("friction", FieldKind::Number, Role::Number, "", "the coefficient of sliding")
        .needs("load", FieldKind::Number, Role::Number, "N", "the force with which it presses on the table")
        .takes(
            "rest_speed",
            FieldKind::Number,
            "m/s",
            "1e-10",
            "mean speed of corners, or of a circle's rim, at which the run ends, by the event `FORCE rests`",
        )
        .loads(&[
            LoadCard::force("friction", "Fx", "F"),
            LoadCard::force("friction", "Fy", "F"),
            LoadCard::couple("friction couple", "M"),
        ])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let (outline, body) = fields.area("area")?;
        let most = fields.number("friction")? * fields.number("load")?;
        let rim = fields.flag("rim")?;
        Ok(Force { plate: Some(Plate { body, outline, rim, most }), ..Force::default() })
    }
}
