//! What cannot fall below zero: contacts and their surfaces, strings, stops.

use super::{nought, yes, Number, Place};
use serde::{Deserialize, Serialize};

/// Two surfaces that can push each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Name.
    pub name: String,
    /// The surfaces.
    pub of: [Surface; 2],
    /// Coefficient of sliding friction.
    #[serde(default = "nought")]
    pub friction: Number,
    /// Coefficient of friction at rest; that of sliding when absent.
    #[serde(default)]
    pub static_friction: Option<Number>,
    /// Never slides while it is closed.
    #[serde(default)]
    pub rough: bool,
    /// Speed of parting over speed of approach.
    #[serde(default = "nought")]
    pub restitution: Number,
    /// Stiffness, N/m, of a spring that stands for it; it is rigid when absent.
    #[serde(default)]
    pub stiffness: Option<Number>,
    /// Damping, N·s/m, beside that spring.
    #[serde(default)]
    pub damping: Option<Number>,
    /// Whether it is there from the start.
    #[serde(default = "yes")]
    pub engaged: bool,
}

/// A surface of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Surface {
    /// A point, by its full name.
    Point(String),
    /// A circle about a point.
    Circle {
        /// Full name of its centre.
        centre: String,
        /// Radius, m.
        radius: Number,
        /// Whether the free side is inside.
        #[serde(default)]
        hollow: bool,
        /// Of an arc the directions of its ends from the centre, counter-clockwise, in the body's frame, rad.
        #[serde(default)]
        ends: Option<[Number; 2]>,
    },
    /// A straight line without ends; the free side is on its left.
    Line(Place),
    /// A polyline by the full names of its corners; the free side is on its left.
    Polyline(Vec<String>),
    /// A convex polygon by the full names of its corners, in order, either way round.
    Polygon(Vec<String>),
    /// Lines and arcs one after another, with a continuous tangent; the free side is on the left.
    Track {
        /// Full name of the point where it starts.
        start: String,
        /// Its stretches in order.
        stretches: Vec<Stretch>,
    },
}

/// A line, or an arc the shorter way round a centre, from where a track is to a point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Full name of the point to which it goes.
    pub to: String,
    /// Full name of the centre of an arc.
    #[serde(default)]
    pub centre: Option<String>,
}

/// A string.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cable {
    /// Name.
    pub name: String,
    /// Its ends.
    pub ends: [CableEnd; 2],
    /// What it passes without friction, in order from the first end.
    #[serde(default)]
    pub over: Vec<Guide>,
    /// Its length, m; when absent it is just taut at the start.
    #[serde(default)]
    pub length: Option<Number>,
    /// Speed of return over speed of stretching when it goes taut.
    #[serde(default = "nought")]
    pub restitution: Number,
    /// Stiffness, N/m, when it is elastic.
    #[serde(default)]
    pub stiffness: Option<Number>,
    /// Damping, N·s/m, beside that.
    #[serde(default)]
    pub damping: Option<Number>,
    /// Whether it is there from the start.
    #[serde(default = "yes")]
    pub engaged: bool,
}

/// Where a string ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CableEnd {
    /// At a point, by its full name.
    Point(String),
    /// On the rim of a drum on which it is wound.
    Drum {
        /// Full name of its centre.
        centre: String,
        /// Radius, m.
        radius: Number,
        /// +1 where the string, followed from its attachment, goes round the drum counter-clockwise.
        sense: i8,
        /// Direction of the attachment from the centre in the body's frame, rad.
        #[serde(default)]
        attached: Option<Number>,
        /// Or the length that is wound at the start, m.
        #[serde(default)]
        wound: Option<Number>,
    },
}

/// What a string passes without friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Guide {
    /// A small ring at a point.
    Eyelet(String),
    /// A pulley.
    Pulley {
        /// Full name of its centre.
        centre: String,
        /// Radius, m.
        radius: Number,
        /// +1 where the string goes round it counter-clockwise.
        sense: i8,
    },
}

/// An end of the way of a gauge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Name.
    pub name: String,
    /// An expression of the configuration that cannot fall below zero.
    pub gap: String,
    /// Speed of parting over speed of approach.
    #[serde(default = "nought")]
    pub restitution: Number,
    /// Stiffness, N/m, of a spring that stands for it; it is rigid when absent.
    #[serde(default)]
    pub stiffness: Option<Number>,
    /// Damping, N·s/m, beside that spring.
    #[serde(default)]
    pub damping: Option<Number>,
    /// Whether it is there from the start.
    #[serde(default = "yes")]
    pub engaged: bool,
}
