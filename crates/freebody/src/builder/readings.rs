//! What an expression can read of a mechanism: its names, and the functions, one entry each.

use super::names::{distance, Reach, Scope};
use crate::expr::{self, Ast, ExprError, Message};
use crate::gauges::{Axis, ModelExpr, ModelVariable, Reading};
use serde::Serialize;

type Found = Result<ModelExpr, ExprError>;

/// What a function reads; all its arguments are names.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Argument {
    /// `body.point`.
    Point,
    /// `body.line`.
    Line,
    /// A body.
    Body,
    /// A string, or a link.
    String,
}

/// A function, like `distance(P, Q)`.
#[derive(Serialize)]
pub struct Function {
    /// Its word.
    pub word: &'static str,
    /// What it reads.
    pub takes: &'static [Argument],
    /// Whether that may be left out.
    pub optional: bool,
    /// Unit of its value, SI.
    pub unit: &'static str,
    /// One phrase.
    pub doc: &'static str,
    /// What must be known before it can be read.
    pub reach: Reach,
    /// Its value.
    #[serde(skip)]
    pub read: fn(&Scope, &[Ast]) -> Found,
}

const fn of(
    word: &'static str,
    takes: &'static [Argument],
    unit: &'static str,
    reach: Reach,
    read: fn(&Scope, &[Ast]) -> Found,
    doc: &'static str,
) -> Function {
    Function { word, takes, optional: false, unit, doc, reach, read }
}

/// Of the whole mechanism, or of a body where that has a meaning.
const fn whole(
    word: &'static str,
    unit: &'static str,
    read: fn(&Scope, &[Ast]) -> Found,
    doc: &'static str,
) -> Function {
    of(word, &[], unit, Reach::Instant, read, doc)
}

use Argument::{Body, Line, Point};
use Reach::{Configuration, Instant, Motion};

/// All functions that read a mechanism.
pub const FUNCTIONS: &[Function] = &[
    of("x", &[Point], "m", Configuration, |s, a| s.x(&a[0]), "x of a point"),
    of("y", &[Point], "m", Configuration, |s, a| s.y(&a[0]), "y of a point"),
    of("angle", &[Body], "rad", Configuration, |s, a| s.angle(&a[0]), "angle of a body from the fixed x axis"),
    of(
        "distance",
        &[Point, Point],
        "m",
        Configuration,
        |s, a| Ok(distance(s.place(&a[0])?, s.place(&a[1])?)),
        "distance of two points",
    ),
    of(
        "direction",
        &[Point, Point],
        "rad",
        Configuration,
        |s, a| Ok((s.y(&a[1])? - s.y(&a[0])?).atan2(s.x(&a[1])? - s.x(&a[0])?)),
        "angle of the line from one point to another from the fixed x axis",
    ),
    of(
        "along",
        &[Point, Line],
        "m",
        Configuration,
        |s, a| s.offset(s.place(&a[0])?, &a[1], false),
        "place of a point along a line, from that line's point",
    ),
    of(
        "across",
        &[Point, Line],
        "m",
        Configuration,
        |s, a| s.offset(s.place(&a[0])?, &a[1], true),
        "distance of a point from a line, positive on its left",
    ),
    of("vx", &[Point], "m/s", Motion, |s, a| Ok(rate(s.x(&a[0])?)), "velocity of a point along x"),
    of("vy", &[Point], "m/s", Motion, |s, a| Ok(rate(s.y(&a[0])?)), "velocity of a point along y"),
    of(
        "speed",
        &[Point],
        "m/s",
        Motion,
        |s, a| Ok((rate(s.x(&a[0])?).powi(2) + rate(s.y(&a[0])?).powi(2)).sqrt()),
        "size of the velocity of a point",
    ),
    of("omega", &[Body], "rad/s", Motion, |s, a| Ok(rate(s.angle(&a[0])?)), "angular velocity of a body"),
    of("ax", &[Point], "m/s^2", Instant, |s, a| Ok(accel(s.x(&a[0])?)), "acceleration of a point along x"),
    of("ay", &[Point], "m/s^2", Instant, |s, a| Ok(accel(s.y(&a[0])?)), "acceleration of a point along y"),
    of("alpha", &[Body], "rad/s^2", Instant, |s, a| Ok(accel(s.angle(&a[0])?)), "angular acceleration of a body"),
    of(
        "curvature",
        &[Point],
        "1/m",
        Instant,
        |s, a| {
            let (x, y) = (s.x(&a[0])?, s.y(&a[0])?);
            let (vx, vy) = (rate(x.clone()), rate(y.clone()));
            Ok((vx.clone() * accel(y) - vy.clone() * accel(x)) / vx.hypot(vy).powi(3))
        },
        "curvature of the path of a point, positive where it turns to the left; none at rest",
    ),
    Function {
        takes: &[Body],
        optional: true,
        ..whole(
            "kinetic",
            "J",
            |s, a| Ok(read(Reading::Kinetic(a.first().map(|b| s.body(b)).transpose()?))),
            "kinetic energy of a body, or of all",
        )
    },
    whole(
        "potential",
        "J",
        |_, _| Ok(read(Reading::Potential)),
        "potential energy of gravity and of all forces that have one",
    ),
    whole(
        "energy",
        "J",
        |_, _| Ok(read(Reading::Kinetic(None)) + read(Reading::Potential)),
        "kinetic and potential energy together",
    ),
    whole("momentum_x", "N*s", |_, _| Ok(read(Reading::Momentum(Axis::X))), "momentum of all bodies along x"),
    whole("momentum_y", "N*s", |_, _| Ok(read(Reading::Momentum(Axis::Y))), "momentum of all bodies along y"),
    Function {
        takes: &[Point],
        ..whole(
            "angular_momentum",
            "N*m*s",
            |s, a| Ok(read(Reading::AngularMomentum(s.place(&a[0])?))),
            "angular momentum of all bodies about the place where a point is now",
        )
    },
    whole("centre_x", "m", |_, _| Ok(read(Reading::Centre(Axis::X))), "x of the mass centre of all bodies"),
    whole("centre_y", "m", |_, _| Ok(read(Reading::Centre(Axis::Y))), "y of the mass centre of all bodies"),
    whole("friction_work", "J", |_, _| Ok(read(Reading::FrictionWork)), "work of all friction since the start"),
    Function {
        takes: &[Argument::String],
        ..whole("tension", "N", |s, a| s.tension(&a[0]), "tension of a string or a link")
    },
];

fn read(reading: Reading) -> ModelExpr {
    ModelExpr::variable(ModelVariable::Reading(reading))
}

fn rate(place: ModelExpr) -> ModelExpr {
    place.rate()
}

fn accel(place: ModelExpr) -> ModelExpr {
    place.accel().expect("a place has an acceleration")
}

impl expr::Scope<ModelVariable> for Scope<'_> {
    fn name(&mut self, name: &str) -> Result<ModelExpr, Message> {
        let n = self.names;
        // A curve's own symbol hides a parameter of that name.
        if name == "s" && self.reach == Reach::Curve {
            return Ok(ModelExpr::variable(ModelVariable::Local));
        }
        if let Some(&i) = n.parameters.get(name) {
            return Ok(ModelExpr::variable(ModelVariable::Parameter(i)));
        }
        if self.reach >= Reach::Configuration {
            if let Some(&(joint, k)) = n.coordinates.get(name) {
                return Ok(ModelExpr::variable(ModelVariable::Coordinate(joint, k)));
            }
            if let Some(gauge) = n.gauges.get(name) {
                return Ok(gauge.clone());
            }
        }
        if let Some(&i) = n.states.get(name).filter(|_| self.reach >= Reach::Motion) {
            return Ok(ModelExpr::variable(ModelVariable::State(i)));
        }
        if name == "t" && self.reach >= Reach::Motion {
            return Ok(ModelExpr::variable(ModelVariable::Time));
        }
        if let Some(reading) = self.reading(name) {
            return reading;
        }
        if self.reach < Reach::Configuration && (n.coordinates.contains_key(name) || n.gauges.contains_key(name)) {
            return Err(Message::new(
                format!("`{name}` changes with the motion; here stands a number of the model"),
                "use parameters only",
            ));
        }
        if n.states.contains_key(name) {
            return Err(Message::new(
                format!("`{name}` is a state with a rate of its own; it cannot be read here"),
                "laws of forces, motions by velocity or acceleration, rates of states, events and reports may read it",
            ));
        }
        Err(self.nothing(name))
    }

    fn call(&mut self, name: &str, arguments: &[Ast]) -> Option<Result<ModelExpr, ExprError>> {
        let wanted = |count: &[usize]| {
            (!count.contains(&arguments.len())).then(|| {
                let span = arguments.first().map_or(0..0, |a| a.span.clone());
                let numbers = count.iter().map(usize::to_string).collect::<Vec<_>>().join(" or ");
                Message::new(format!("`{name}` takes {numbers} arguments, not {}", arguments.len()), "").at(&span)
            })
        };
        let too_far = |reach: Reach| {
            (self.reach < reach).then(|| {
                let span = arguments.first().map_or(0..0, |a| a.span.clone());
                Message::new(
                    format!("`{name}(…)` cannot be read here"),
                    "see which expressions may read what in docs/model_file.md",
                )
                .at(&span)
            })
        };
        let function = FUNCTIONS.iter().find(|function| function.word == name)?;
        let counts = [if function.optional { 0 } else { function.takes.len() }, function.takes.len()];
        let counts = if function.optional { &counts[..] } else { &counts[1..] };
        Some(match wanted(counts).or_else(|| too_far(function.reach)) {
            Some(error) => Err(error),
            None => (function.read)(self, arguments),
        })
    }

    fn table(&self, name: &str) -> Option<usize> {
        self.names.tables.get(name).copied()
    }

    fn functions(&self) -> Vec<String> {
        let words = FUNCTIONS.iter().map(|function| function.word.to_string());
        words.chain(self.names.tables.keys().cloned()).collect()
    }

    fn discontinuity(&mut self) -> usize {
        *self.switches += 1;
        *self.switches - 1
    }
}
