//! A force at a point.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::{Force, PointForce};

/// A force at a point, by size and direction or by components, in fixed axes or in those of the body.
pub struct AtPoint;

impl ForceKind for AtPoint {
    fn card(&self) -> Card {
        Card::new("force", "A force at a point, by its size and direction or by its components.")
            .needs("at", FieldKind::Point, Role::Number, "m", "where it acts")
            .takes("value", FieldKind::Law, "N", "0", "its size along `direction`")
            .takes("direction", FieldKind::Law, "rad", "0", "its angle from the x axis of its frame")
            .takes("x", FieldKind::Law, "N", "0", "its component along x")
            .takes("y", FieldKind::Law, "N", "0", "its component along y")
            .takes("frame", FieldKind::Frame, "", "fixed", "`fixed`, or `body` for axes that turn with the body")
            .loads(&[LoadCard::force("force", "value", "F")])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let along = fields.law("direction")?;
        let (size, x, y) = (fields.law("value")?, fields.law("x")?, fields.law("y")?);
        let by_components = [&x, &y].iter().any(|component| **component != ModelExpr::constant(0.0));
        let applied = PointForce {
            site: fields.site("at")?,
            value: (!by_components).then(|| size.clone()),
            x: x + size.clone() * ModelExpr::cos(along.clone()),
            y: y + size * ModelExpr::sin(along),
            with_body: fields.word("frame", &["fixed", "body"])? == "body",
        };
        Ok(Force { point_forces: vec![applied], ..Force::default() })
    }
}
