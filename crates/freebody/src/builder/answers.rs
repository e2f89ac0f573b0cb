//! The words behind the name of a part of the model, like `pivot.Fx`: one entry each, with its unit and what it reads.

use crate::gauges::{Axis, ContactQuantity, Reading};
use crate::joints::{Card, FieldKind};
use serde_json::{json, Map, Value};

/// The unit of what is read of a part of the model.
#[derive(Clone, Copy)]
pub enum Unit {
    /// This one.
    Is(&'static str),
    /// That of the gauge on which the part acts.
    Gauge,
    /// That of a force along the gauge: N along a length, N·m along an angle.
    Load,
}

impl Unit {
    /// The unit, by that of the gauge; none where that is not known.
    pub fn by(self, gauge: Option<&str>) -> Option<&'static str> {
        match (self, gauge) {
            (Unit::Is(unit), _) => Some(unit),
            (Unit::Gauge, Some("m")) => Some("m"),
            (Unit::Gauge, Some("rad")) => Some("rad"),
            (Unit::Load, Some("m")) => Some("N"),
            (Unit::Load, Some("rad")) => Some("N*m"),
            _ => None,
        }
    }
}

/// A word behind the name of a part of the model, like `pivot.Fx`.
#[derive(Clone, Copy)]
pub struct Answer {
    /// Its word.
    pub word: &'static str,
    /// The unit of its value.
    pub unit: Unit,
    /// What it reads of the part of a number.
    pub read: fn(usize) -> Reading,
    /// One phrase.
    pub doc: &'static str,
}

const fn answer(word: &'static str, unit: Unit, read: fn(usize) -> Reading, doc: &'static str) -> Answer {
    Answer { word, unit, read, doc }
}

const FORCE: Unit = Unit::Is("N");

/// Of a joint, on its second body; beside those of its rows.
const JOINT: &[Answer] = &[
    answer("Fx", FORCE, |j| Reading::Reaction(j, Axis::X), "force on its second body along x"),
    answer("Fy", FORCE, |j| Reading::Reaction(j, Axis::Y), "force on it along y"),
    answer("M", Unit::Is("N*m"), |j| Reading::Reaction(j, Axis::Couple), "couple on it about the joint's point"),
    answer("F", FORCE, |j| Reading::Reaction(j, Axis::Size), "size of the force"),
    answer("Fs", FORCE, |j| Reading::Reaction(j, Axis::Along), "force along the first body's line or curve"),
    answer("Fn", FORCE, |j| Reading::Reaction(j, Axis::Across), "force across it, to its left"),
];
/// Of the rows of a joint, in order.
const ROWS: [Answer; 2] = [
    answer(
        "F1",
        Unit::Load,
        |j| Reading::Reaction(j, Axis::Row(0)),
        "force of the first constraint: of a roller, of teeth",
    ),
    answer("F2", Unit::Load, |j| Reading::Reaction(j, Axis::Row(1)), "force of the second constraint"),
];
const TENSION: Answer = answer("tension", FORCE, |j| Reading::Reaction(j, Axis::Tension), "tension, of what pulls");
const FRICTION: Answer =
    answer("friction", Unit::Load, Reading::JointFriction, "friction in the sense of the first coordinate");
/// Of a prescribed motion or a coupling.
pub const MOTION: &[Answer] = &[
    answer("force", Unit::Load, Reading::Drive, "force or couple in the sense of its gauge"),
    answer("F", Unit::Load, Reading::Drive, "the same"),
    answer("power", Unit::Is("W"), Reading::DrivePower, "its power"),
    answer("work", Unit::Is("J"), Reading::DriveWork, "its work since the start"),
];
/// Of a force of the model.
const ACTING: &[Answer] = &[
    answer("value", Unit::Load, Reading::Force, "its value; its size where it is given by components"),
    answer("power", Unit::Is("W"), Reading::ForcePower, "its power"),
    answer("work", Unit::Is("J"), Reading::ForceWork, "its work since the start"),
];
/// Of the friction of a plate besides.
const PLATE: &[Answer] = &[
    answer("Fx", FORCE, |f| Reading::Plate(f, Axis::X), "friction of a plate along x"),
    answer("Fy", FORCE, |f| Reading::Plate(f, Axis::Y), "friction of it along y"),
    answer("M", Unit::Is("N*m"), |f| Reading::Plate(f, Axis::Couple), "friction couple on it about its mass centre"),
];
/// Of a contact, stop or string.
pub const LIMIT: &[Answer] = &[
    answer(
        "gap",
        Unit::Gauge,
        |g| Reading::Contact(g, ContactQuantity::Gap),
        "least distance, or what is left of the way",
    ),
    answer("slack", Unit::Gauge, |g| Reading::Contact(g, ContactQuantity::Gap), "what is slack"),
    answer("F", FORCE, |g| Reading::Contact(g, ContactQuantity::OnFirst(Axis::Size)), "size of the force"),
    answer("N", Unit::Load, |g| Reading::Contact(g, ContactQuantity::Force), "normal force, or force of the stop"),
    answer("tension", Unit::Load, |g| Reading::Contact(g, ContactQuantity::Force), "tension"),
    answer("T", FORCE, |g| Reading::Contact(g, ContactQuantity::Friction), "friction along the tangent"),
    answer("Fx", FORCE, |g| Reading::Contact(g, ContactQuantity::OnFirst(Axis::X)), "force on the first body along x"),
    answer("Fy", FORCE, |g| Reading::Contact(g, ContactQuantity::OnFirst(Axis::Y)), "force on the first body along y"),
    answer(
        "x",
        Unit::Is("m"),
        |g| Reading::Contact(g, ContactQuantity::Place(Axis::X)),
        "x of where the normal forces act",
    ),
    answer("y", Unit::Is("m"), |g| Reading::Contact(g, ContactQuantity::Place(Axis::Y)), "y of that place"),
    answer("slip", Unit::Is("m/s"), |g| Reading::Contact(g, ContactQuantity::Slip), "speed of sliding"),
];

/// What can be read of a joint, with the unit of what it acts along: those of every joint, one for each row, a tension where it pulls.
/// Where one side only pushes, all is read of the stop.
pub fn of_joint(card: &Card) -> Vec<(Answer, Option<&'static str>)> {
    let gauge = |turns: bool| Some(if turns { "rad" } else { "m" });
    if card.is_one_sided() {
        return vec![];
    }
    let mut found: Vec<_> = JOINT.iter().map(|&each| (each, None)).collect();
    found.extend(ROWS.into_iter().zip(&card.rows).map(|(each, row)| (each, gauge(row.load.couple))));
    found.extend(card.rows.iter().any(|row| row.load.pulls).then_some((TENSION, None)));
    found.push((FRICTION, gauge(card.coordinates.first().is_some_and(|c| c.turn))));
    found
}

/// What can be read of a force.
pub fn of_force(card: &Card) -> Vec<Answer> {
    let plate = card.fields.iter().any(|field| field.kind == FieldKind::Area);
    [ACTING, if plate { PLATE } else { &[] }].concat()
}

/// The words by what they are read of, with a phrase each, as data.
pub fn phrases() -> Value {
    let joint = JOINT.iter().chain(&ROWS).chain([&TENSION, &FRICTION]);
    let of = |answers: &mut dyn Iterator<Item = &Answer>| answers.map(|a| json!([a.word, a.doc])).collect::<Vec<_>>();
    json!({
        "joint": of(&mut joint.into_iter()), "motion": of(&mut MOTION.iter()), "force": of(&mut ACTING.iter().chain(PLATE)),
        "limit": of(&mut LIMIT.iter()),
    })
}

/// The words with their units, as data; null where the unit is not known.
pub fn units(answers: &[Answer], gauge: Option<&str>) -> Value {
    answers.iter().map(|a| (a.word.to_string(), json!(a.unit.by(gauge)))).collect::<Map<_, _>>().into()
}

/// Those of a joint.
pub fn units_of_joint(card: &Card) -> Value {
    of_joint(card).iter().map(|(a, gauge)| (a.word.to_string(), json!(a.unit.by(*gauge)))).collect::<Map<_, _>>().into()
}

/// Those of a force as far as its kind tells: what acts along any gauge has no unit of its own.
pub fn units_of_force(card: &Card) -> Value {
    let any = card.fields.iter().any(|field| field.kind == FieldKind::Gauge);
    let gauge = if card.parts[0].couple { "rad" } else { "m" };
    units(&of_force(card), (!any).then_some(gauge))
}
