//! What acts on each body: the loads of a free-body diagram, expressed over any scalar.
//!
//! A load is one thing that pushes, pulls or turns: a weight, a spring, one component of the reaction of a joint. On
//! two bodies it acts in equal and opposite ways. What is not known before the balance is solved is expressed for a
//! unit of it.

mod applied;
mod contacts;
mod numbers;
mod reactions;

pub use numbers::free_bodies;

use crate::dynamics::{compliant_force, joint_place, Source};
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::LoadCard;
use crate::kinematics::{Poses, StateView};
use crate::mechanism::{FrictionSource, Mechanism};
use crate::mode::ContactMode;
use crate::plane::{Vec2, Wrench};
use crate::scalar::Scalar;

/// Where a load comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Gravity on a body.
    Weight(usize),
    /// A force of the model: its pull or push of a number, pulls first.
    Force(usize, usize),
    /// The force of a pin of a joint along fixed axes: 0 for x, 1 for y.
    Pin(usize, usize),
    /// A component of the friction of a plate, a force of the model: along x, along y, and the couple.
    Plate(usize, usize),
    /// A row: of a joint, a motion or coupling, a closed unilateral constraint, friction that sticks.
    Row(Source),
    /// Friction of a unilateral constraint that slides.
    Sliding(usize),
    /// The spring and damper that stand for a unilateral constraint.
    Compliant(usize),
    /// Friction of a joint that slides.
    JointFriction(usize),
}

impl Origin {
    /// Whether the work of the load is in the potential energy.
    pub fn is_conservative(self, m: &Mechanism) -> bool {
        match self {
            Origin::Weight(_) => true,
            Origin::Force(force, number) => {
                m.forces[force].gauge_forces.get(number).is_some_and(|gauge_force| gauge_force.conservative)
            }
            Origin::Compliant(constraint) => m.unilateral[constraint].is_conservative(m),
            _ => false,
        }
    }
}

/// What one load does to one body.
#[derive(Clone, Copy, Debug)]
pub struct Part<S> {
    /// The body; 0 for ground.
    pub body: usize,
    /// Where the force acts, fixed axes, m.
    pub point: Vec2<S>,
    /// Force, fixed axes, N; for a unit of an unknown a direction.
    pub force: Vec2<S>,
    /// Couple beside the force at its point, N·m.
    pub couple: S,
}

/// How much is known of the size of a load before the balance is solved.
#[derive(Clone, Copy, Debug)]
pub enum Size<S> {
    /// All: its parts are what acts.
    Known,
    /// Nothing: its parts are expressed for a unit of it.
    Unknown,
    /// It is this many times another load of the list, its parts being expressed for a unit of it.
    Follows(usize, S),
    /// It follows from the others by a law that is not linear; its parts are expressed for a unit of it.
    ByLaw,
}

/// A load.
#[derive(Clone, Debug)]
pub struct Load<S> {
    /// Where it comes from.
    pub origin: Origin,
    /// Its name, as in an expression of the model: `pivot.Fx`, `motor`.
    pub symbol: String,
    /// What it is.
    pub card: LoadCard,
    /// Which one it is, from 1, of several of its kind that its owner has.
    pub number: Option<usize>,
    /// First and second body; ground for the first where it has none.
    pub of: [usize; 2],
    /// What it does to each body, ground among them where it takes the opposite.
    pub parts: Vec<Part<S>>,
    /// What is known of its size.
    pub size: Size<S>,
}

/// All loads at a state, in the order: weights, forces, joints, motions, unilateral constraints, friction. What acts on
/// a massless body that a joint along a curve carries acts on the body that is pinned to it.
pub fn loads<S: Scalar>(at: StateView<'_, S>) -> Vec<Load<S>> {
    let mut loads = vec![];
    applied::weights(at, &mut loads);
    applied::forces(at, &mut loads);
    reactions::joints(at, &mut loads);
    reactions::drives(at, &mut loads);
    contacts::contacts(at, &mut loads);
    contacts::joint_friction(at, &mut loads);
    for (pin, _) in at.joints() {
        let Some([parent, body]) = at.m.carried(pin) else { continue };
        // What turns the massless body turns the other one only if it cannot turn against it.
        let shift = if at.m.bodies[parent].particle { at.pin_shift(pin) } else { Vec2::zero() };
        for load in &mut loads {
            load.of.iter_mut().filter(|on| **on == parent).for_each(|on| *on = body);
            for part in load.parts.iter_mut().filter(|part| part.body == parent) {
                (part.body, part.point) = (body, part.point + shift);
            }
        }
    }
    loads
}

/// Where what slides is pressed by one load, as of a joint that carries its force by one row or of a contact on a
/// spring, its friction is that many times it; `values` are those of the loads, and say on which side it presses.
pub fn relate_friction<S: Scalar>(at: StateView<'_, S>, loads: &mut [Load<S>], values: &[f64]) {
    for i in 0..loads.len() {
        let Origin::JointFriction(friction) = loads[i].origin else { continue };
        let presses = |load: &Load<S>| match (load.origin, &at.m.joint_friction[friction].of) {
            (Origin::Row(Source::Joint(joint, _)), FrictionSource::Joint { joint: friction, .. }) => {
                joint == *friction && !load.card.couple
            }
            (Origin::Compliant(constraint), FrictionSource::Unilateral(friction)) => constraint == *friction,
            _ => false,
        };
        if let Some(press) = loads.iter().position(presses) {
            let ContactMode::Slip(sense) = at.mode.joint_friction[friction] else { continue };
            let side = if values[press] < 0.0 { -sense } else { sense };
            let ratio = at.n.values[at.m.joint_friction[friction].kinetic].scale(-side);
            loads[i].size = Size::Follows(
                press,
                match loads[press].origin {
                    Origin::Compliant(constraint) => ratio * compliant_force(at, constraint),
                    _ => ratio,
                },
            );
        }
    }
}

/// A load at the joint origin of a body, expressed as a force at a point and a couple beside it.
fn part<S: Scalar>(at: StateView<'_, S>, body: usize, at_joint_origin: Wrench<S>, point: Vec2<S>) -> Part<S> {
    let there = at_joint_origin.seen_from(at.k.pose[body].at - point);
    Part { body, point, force: there.f, couple: there.m }
}

/// Adds what ground takes: the opposite of all parts together, at the point `at`.
fn ground_takes<S: Scalar>(parts: &mut Vec<Part<S>>, point: Vec2<S>) {
    let (mut force, mut couple) = (Vec2::zero(), S::zero());
    for part in parts.iter() {
        force += part.force;
        couple += part.couple + (part.point - point).cross(part.force);
    }
    parts.push(Part { body: 0, point, force: -force, couple: -couple });
}

/// The loads of a spread along a gauge, each at the point that the gauge looks at.
fn along_gauge<S: Scalar>(at: StateView<'_, S>, gauge: &ModelExpr, wrenches: &[(usize, Wrench<S>)]) -> Vec<Part<S>> {
    let to_part = |&(body, w): &(usize, Wrench<S>)| part(at, body, w, place_on(at, gauge, body));
    let mut parts: Vec<Part<S>> = wrenches.iter().map(to_part).collect();
    if looks_at_ground(at, gauge) {
        ground_takes(&mut parts, place_on(at, gauge, 0));
    }
    parts
}

/// Where a gauge takes hold of a body: its only site there, or the place of a joint, or the mass centre.
fn place_on<S: Scalar>(at: StateView<'_, S>, gauge: &ModelExpr, body: usize) -> Vec2<S> {
    let mut sites: Vec<usize> = gauge.variables().filter_map(|variable| site_on(at, variable, body)).collect();
    sites.sort_unstable();
    sites.dedup();
    let joint = gauge.variables().find_map(|variable| match variable {
        ModelVariable::Coordinate(joint, _) if at.m.ends(&at.m.joints[*joint]).contains(&body) => Some(*joint),
        _ => None,
    });
    match (&sites[..], joint) {
        ([site], _) => at.pose(body).place(at.arm(*site)),
        ([], Some(joint)) => joint_place(at, joint),
        ([], None) | ([_, _, ..], _) => at.mass_centre(body),
    }
}

fn site_on<S: Scalar>(at: StateView<'_, S>, variable: &ModelVariable, body: usize) -> Option<usize> {
    match variable {
        ModelVariable::X(site) | ModelVariable::Y(site) if at.m.body_of(*site) == body => Some(*site),
        _ => None,
    }
}

fn looks_at_ground<S: Scalar>(at: StateView<'_, S>, gauge: &ModelExpr) -> bool {
    gauge.variables().any(|variable| match variable {
        ModelVariable::X(_) | ModelVariable::Y(_) => site_on(at, variable, 0).is_some(),
        ModelVariable::Coordinate(joint, _) => at.m.ends(&at.m.joints[*joint]).contains(&0),
        _ => false,
    })
}
