//! Loads that a state determines: weights, and the forces of the model.

use super::{along_gauge, Load, Origin, Part, Size};
use crate::dynamics::{pulled, pushed, BodyWrenches};
use crate::expr::spell;
use crate::joints::LoadCard;
use crate::kinematics::StateView;
use crate::mechanism::Mechanism;
use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

const WEIGHT: LoadCard = LoadCard::force("weight", "weight", "W");

/// The weight of every body that has one.
pub fn weights<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    for (body, of) in at.m.bodies.iter().enumerate().skip(1) {
        if weightless(at.m, body) {
            continue;
        }
        let force = at.n.gravity * at.n.mass[body];
        let parts = vec![Part { body, point: at.mass_centre(body), force, couple: S::zero() }];
        let symbol = format!("{}.weight", spell(&of.name));
        let (origin, card) = (Origin::Weight(body), WEIGHT);
        out.push(Load { origin, symbol, card, number: None, of: [0, body], parts, size: Size::Known });
    }
}

/// Whether the model itself says that a body weighs nothing, whatever its parameters are.
fn weightless(m: &Mechanism, body: usize) -> bool {
    let never = |id: usize| m.values[id].literal() == Some(0.0);
    m.gravity.into_iter().all(never) || m.bodies[body].mass_elements.iter().all(|feature| never(feature.mass))
}

/// Every force of the model that is in place, all that it does together.
pub fn forces<S: Scalar>(at: StateView<'_, S>, out: &mut Vec<Load<S>>) {
    for (index, force) in at.forces() {
        let several = force.cards.len() > 1;
        let load = |k: usize, parts: Vec<Part<S>>| Load {
            origin: Origin::Force(index, k),
            symbol: if several { format!("{}.{}", force.name, k + 1) } else { force.name.clone() },
            card: force.cards[k],
            number: several.then_some(k + 1),
            of: [if parts.len() > 1 { parts[1].body } else { 0 }, parts.first().map_or(0, |p| p.body)],
            parts,
            size: Size::Known,
        };
        for (k, gauge_force) in force.gauge_forces.iter().enumerate() {
            let wrenches: BodyWrenches<S> = pulled(at, gauge_force).collect();
            out.push(load(k, along_gauge(at, &gauge_force.gauge, &wrenches)));
        }
        for (k, applied) in force.point_forces.iter().enumerate() {
            let (body, arm, f) = pushed(at, applied);
            let part = Part { body, point: at.k.pose[body].at + arm, force: f, couple: S::zero() };
            out.push(load(force.gauge_forces.len() + k, vec![part]));
        }
        if let Some(plate) = &force.plate {
            let (one, none) = (S::one(), S::zero());
            let units = [(vec2(one, none), none), (vec2(none, one), none), (Vec2::zero(), one)];
            for (k, (force_along, couple)) in units.into_iter().enumerate() {
                let card = force.cards[k];
                let part = Part { body: plate.body, point: at.mass_centre(plate.body), force: force_along, couple };
                let symbol = format!("{}.{}", spell(&force.name), card.reading);
                let (origin, of) = (Origin::Plate(index, k), [0, plate.body]);
                out.push(Load { origin, symbol, card, number: None, of, parts: vec![part], size: Size::ByLaw });
            }
        }
    }
}
