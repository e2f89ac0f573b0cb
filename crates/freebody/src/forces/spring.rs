//! Springs and dampers, between two points or along a gauge.

use super::ForceKind;
use crate::builder::Fields;
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::joints::{Card, FieldKind, LoadCard, Role};
use crate::mechanism::{Force, GaugeForce};

const DAMPER: LoadCard = LoadCard::force("damper", "value", "F");

fn along(card: Card) -> Card {
    card.takes("between", FieldKind::Points, "m", "", "the two points at its ends").takes(
        "along",
        FieldKind::Gauge,
        "",
        "",
        "or the gauge along which it acts",
    )
}

/// The gauge of a force along `along` or between two points.
fn gauge(fields: &mut Fields) -> Result<ModelExpr, CompileError> {
    match (fields.given("between"), fields.given("along")) {
        (true, false) => {
            let [p, q] = fields.two_sites("between")?;
            Ok(crate::builder::distance(p, q))
        }
        (false, true) => fields.gauge("along"),
        _ => Err(fields.error(
            "between",
            "a spring or damper needs `between: [P, Q]` or `along: gauge`",
            "give one of the two",
        )),
    }
}

/// A linear spring with a damper on a gauge: −k(x − x₀) − cẋ, potential k(x − x₀)²/2.
pub(super) fn elastic(gauge: ModelExpr, fields: &mut Fields, rest: &str) -> Result<Force, CompileError> {
    let stretch = gauge.clone() - fields.number(rest)?;
    let stiffness = fields.number("stiffness")?;
    let damping = fields.number("damping")?;
    let potential = ModelExpr::constant(0.5) * stiffness.clone() * stretch.clone().powi(2);
    let mut force = Force::along_gauge(gauge.clone(), -(stiffness * stretch), Some(potential));
    if damping.literal() != Some(0.0) {
        force.gauge_forces.push(drag(gauge, damping));
    }
    Ok(force)
}

fn drag(gauge: ModelExpr, damping: ModelExpr) -> GaugeForce {
    let rate = gauge.clone().rate();
    GaugeForce { gauge, value: -(damping * rate), bodies: vec![], conservative: false }
}

/// A spring, with a damper beside it if wished.
pub struct Spring;

impl ForceKind for Spring {
    fn card(&self) -> Card {
        along(Card::new("spring", "A linear spring, with a linear damper beside it if wished."))
            .needs("stiffness", FieldKind::Number, Role::Number, "N/m", "force for each unit of stretch")
            .takes("rest_length", FieldKind::Number, "m", "0", "length without force")
            .takes("damping", FieldKind::Number, "N*s/m", "0", "force for each unit of stretching speed")
            .loads(&[LoadCard::force("spring", "value", "F"), DAMPER])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let gauge = gauge(fields)?;
        elastic(gauge, fields, "rest_length")
    }
}

/// A damper.
pub struct Damper;

impl ForceKind for Damper {
    fn card(&self) -> Card {
        along(Card::new("damper", "A linear damper."))
            .needs("damping", FieldKind::Number, Role::Number, "N*s/m", "force for each unit of speed")
            .loads(&[DAMPER])
    }
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError> {
        let gauge = gauge(fields)?;
        Ok(Force { gauge_forces: vec![drag(gauge, fields.number("damping")?)], ..Force::default() })
    }
}
