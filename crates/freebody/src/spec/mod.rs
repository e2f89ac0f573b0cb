//! The model as data: what a builder or a file reader hands to [`crate::Mechanism::compile`].
//!
//! Everything is explicit: repetitions are expanded, sub-mechanisms inlined, units converted to SI
//! and radians. A number is a literal or an expression of the parameters; see [`crate::expr`].

mod unilateral;

pub use unilateral::{Cable, CableEnd, Contact, Guide, Stop, Stretch, Surface};

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A number of the model: a literal in SI, or an expression of the parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Number {
    /// A literal in SI units or radians.
    Literal(f64),
    /// An expression, e.g. `m1/3`.
    Expression(String),
}

/// A whole model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Spec {
    /// Title for reports.
    pub name: String,
    /// Named numbers, in any order; each may use the others.
    pub parameters: Vec<Parameter>,
    /// Functions of one variable given by points.
    pub tables: Vec<Table>,
    /// Components of the acceleration of gravity along x and y.
    pub gravity: Option<[Number; 2]>,
    /// The bodies; `ground` is always there and not listed.
    pub bodies: Vec<Body>,
    /// Named points of bodies and of ground, as `body.point`.
    pub points: Vec<Point>,
    /// Named lines of bodies and of ground, as `body.line`.
    pub lines: Vec<Line>,
    /// Named curves of bodies and of ground, as `body.curve`.
    pub curves: Vec<Curve>,
    /// Named expressions of the configuration.
    pub gauges: Vec<Gauge>,
    /// Quantities with a rate of their own.
    pub states: Vec<StateVariable>,
    /// The joints.
    pub joints: Vec<Element>,
    /// The forces, gravity apart.
    pub forces: Vec<Element>,
    /// Prescribed motions.
    pub motions: Vec<Motion>,
    /// Surfaces that can push each other.
    pub contacts: Vec<Contact>,
    /// Strings.
    pub strings: Vec<Cable>,
    /// Ends of the way of gauges.
    pub stops: Vec<Stop>,
    /// What to watch for during a motion.
    pub events: Vec<Event>,
}

/// A named number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Name, e.g. `m1`.
    pub name: String,
    /// Its value in SI, or an expression of other parameters.
    pub value: Number,
    /// Unit in SI base words for display, e.g. `kg`; empty when not stated.
    #[serde(default)]
    pub unit: String,
}

/// A function given by points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// Name by which expressions call it, as `name(x)`.
    pub name: String,
    /// Strictly increasing arguments.
    pub x: Vec<f64>,
    /// Values, one for each argument.
    pub y: Vec<f64>,
    /// How to read between the points: `linear`, `pchip` or `spline`.
    pub interpolation: String,
    /// Whether the values come again with the span of the arguments; otherwise the end value holds outside.
    #[serde(default)]
    pub periodic: bool,
}

/// A rigid body or a particle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Name.
    pub name: String,
    /// A particle has two coordinates and no rotation in any joint.
    #[serde(default)]
    pub particle: bool,
    /// Its pieces; mass, mass centre and inertia are theirs together.
    pub pieces: Vec<MassElement>,
}

/// A piece of a body, of known mass and shape, placed in the body's frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassElement {
    /// `point`, `rod`, `disk`, `ring`, `rectangle`, `polygon`, or `given` (with `inertia`).
    pub shape: String,
    /// Mass in kg; 0 is allowed.
    pub mass: Number,
    /// Mass centre (`given`) or the shape's own origin, in the body's frame, m.
    #[serde(default = "origin")]
    pub at: [Number; 2],
    /// Angle of the shape's own x axis in the body's frame, rad.
    #[serde(default = "nought")]
    pub angle: Number,
    /// Inertia about the mass centre in kg·m²; overrules the shape's.
    #[serde(default)]
    pub inertia: Option<Number>,
    /// `length` of a rod, `radius` of a disk or ring, `width` and `height` of a rectangle.
    #[serde(default)]
    pub sizes: BTreeMap<String, Number>,
    /// Corners of a polygon, in order, in the shape's own axes.
    #[serde(default)]
    pub corners: Vec<[Number; 2]>,
}

fn nought() -> Number {
    Number::Literal(0.0)
}

fn origin() -> [Number; 2] {
    [nought(), nought()]
}

/// A named point of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Full name, `body.point`.
    pub name: String,
    /// The body, or `ground`.
    pub body: String,
    /// Coordinates in the body's frame, m.
    pub at: [Number; 2],
}

/// A directed line of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Full name, `body.line`.
    pub name: String,
    /// Where it is.
    pub line: Place,
}

/// A point with a direction, on the body of the point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Full name of the point it passes through.
    pub point: String,
    /// Direction, from the body's x axis, rad.
    #[serde(default)]
    pub angle: Option<Number>,
    /// Or the direction given by a second point of the same body.
    #[serde(default)]
    pub towards: Option<String>,
}

/// A curve fixed in a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// Full name, `body.curve`.
    pub name: String,
    /// The body, or `ground`.
    pub body: String,
    /// Coordinates in the body's frame as expressions of the curve parameter `s`.
    pub x: String,
    /// Coordinates in the body's frame as expressions of the curve parameter `s`.
    pub y: String,
}

/// A named expression of the configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gauge {
    /// Name.
    pub name: String,
    /// Expression of coordinates, points and angles.
    pub value: String,
}

/// A quantity that changes at a rate of its own: the integral of a controller, the output of a filter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateVariable {
    /// Name.
    pub name: String,
    /// Its value at the start, in SI.
    pub start: Number,
    /// Its rate: an expression of time and of the state, in SI.
    pub rate: String,
    /// Unit in SI base words for display; empty when not stated.
    #[serde(default)]
    pub unit: String,
}

/// A joint or a force: a word of the list with its fields (see `joints::cards`, `forces::cards`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Name.
    pub name: String,
    /// The word of the list, e.g. `hinge`.
    #[serde(rename = "type")]
    pub kind: String,
    /// The fields that its card asks for.
    #[serde(rename = "with", default)]
    pub fields: BTreeMap<String, Value>,
    /// Joints: names and conventions of the coordinates, in the order of the card.
    #[serde(default)]
    pub coordinates: Vec<Coordinate>,
    /// Whether it is in place from the start.
    #[serde(default = "yes")]
    pub engaged: bool,
    /// Friction along the first coordinate of a joint.
    #[serde(default)]
    pub friction: Option<JointFriction>,
}

/// Coulomb friction in a joint, by the size of the force that the joint carries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointFriction {
    /// Coefficient of sliding.
    pub kinetic: Number,
    /// Coefficient at rest; that of sliding when absent.
    #[serde(default)]
    pub fixed: Option<Number>,
    /// Radius of the bearing of a hinge, m.
    #[serde(default)]
    pub radius: Option<Number>,
}

fn yes() -> bool {
    true
}

/// What a field of a joint or force may hold; the card says which.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// On or off.
    Flag(bool),
    /// A number or an expression; also the name of a point, body, curve or choice.
    Number(Number),
    /// Several points or numbers. Before the structures, which would take a list for their fields.
    List(Vec<Value>),
    /// A circle about a point.
    Circle {
        /// Full name of its centre.
        centre: String,
        /// Radius, m.
        radius: Number,
    },
    /// A directed line.
    Line(Place),
}

impl Value {
    /// The text of a name or an expression.
    pub fn text(&self) -> Option<&str> {
        match self {
            Value::Number(Number::Expression(text)) => Some(text),
            _ => None,
        }
    }
}

/// How a joint coordinate is measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coordinate {
    /// Name; unique in the model.
    pub name: String,
    /// Reading of the joint's own measure at which this coordinate is 0.
    #[serde(default = "nought")]
    pub zero: Number,
    /// −1 when the coordinate grows against the joint's own measure (e.g. a clockwise angle).
    #[serde(default = "ahead")]
    pub sense: i8,
    /// An angle measured from the fixed x axis instead of from the first body.
    #[serde(default)]
    pub absolute: bool,
}

fn ahead() -> i8 {
    1
}

/// A motion that an actuator imposes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Name.
    pub name: String,
    /// The gauge whose motion is given.
    pub of: String,
    /// Its value, rate or acceleration: an expression of time and, if wished, of the state.
    #[serde(rename = "is")]
    pub law: String,
    /// `position`, `velocity` or `acceleration`.
    pub level: String,
    /// The gauge along which the actuator acts; `of` when absent.
    #[serde(default)]
    pub by: Option<String>,
    /// Whether it acts from the start.
    #[serde(default = "yes")]
    pub engaged: bool,
}

/// Something to watch for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// Name.
    pub name: String,
    /// The expression whose zero is the event.
    pub when: String,
    /// +1 rising, −1 falling, 0 either.
    #[serde(default)]
    pub direction: i8,
    /// Armed only while this condition holds.
    #[serde(default)]
    pub condition: Option<String>,
    /// It happens at the start, before anything moves; `when` is not asked.
    #[serde(default)]
    pub opening: bool,
    /// The expression is above 0 until the event: one that is below 0 at once is the event too.
    #[serde(default)]
    pub guard: bool,
    /// What happens then.
    pub then: Vec<Action>,
}

/// What an event does. An empty list of actions records the event and goes on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// End the run.
    Stop,
    /// Give parameters new values, computed at the event.
    Set(BTreeMap<String, String>),
    /// Take joints, motions, forces, contacts, stops or strings away.
    Release(Vec<String>),
    /// Put them in place.
    Engage(Vec<String>),
    /// Hold gauges where they are from now on.
    Lock(Vec<String>),
    /// Let them go again.
    Unlock(Vec<String>),
    /// Give gauges rates at once.
    Reset(BTreeMap<String, String>),
}
