//! What can be asked of a mechanism in symbols, as data.

use super::SymbolicState;
use crate::algebra;
use crate::dynamics::{DynamicsError, Workspace};
use crate::free_bodies;
use serde::Deserialize;
use serde_json::{json, Value};
use std::collections::BTreeMap;

/// Names of bodies; none means all.
pub type Group = Vec<String>;

/// A point about which moments are taken.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum About {
    /// A named point.
    Point(String),
    /// Where a load acts, by its place in the list of loads.
    Load(usize),
    /// Where the lines of two loads meet, each with the friction that follows from it.
    Meeting(usize, usize),
    /// The mass centre of the group.
    Centre,
}

/// A direction along which forces are taken.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Along {
    /// The fixed x axis.
    X,
    /// The fixed y axis.
    Y,
    /// That of a load.
    Load(usize),
    /// Across that of a load, a right angle counter-clockwise on.
    Across(usize),
    /// Across all that a load does to the group, with the friction that follows from it.
    Clear(usize),
    /// The x axis of a body.
    Body(String),
}

/// What is said beside an equation.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default)]
pub struct Parts {
    /// What each load and each body gives to it; loads within the group, which cancel, are not written.
    pub terms: bool,
    /// Signs of both sides up to which each body is among them; a longer equation is read by nobody, term by term.
    pub inertia_within: usize,
    /// The momentum of the group.
    pub momentum: bool,
}

impl Default for Parts {
    fn default() -> Self {
        Parts { terms: true, inertia_within: usize::MAX, momentum: true }
    }
}

/// One question.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
pub enum Query {
    /// Position, velocity and acceleration of every mass centre.
    Kinematics,
    /// A balance equation of a group: moments about a point, or forces along a direction.
    Equation {
        /// The bodies.
        bodies: Group,
        /// The point.
        about: Option<About>,
        /// The direction.
        along: Option<Along>,
        /// What is said beside it.
        #[serde(flatten)]
        parts: Parts,
    },
    /// The balance equation of a coordinate: of the bodies that it carries, in the sense in which it moves them.
    Coordinate {
        /// Its name.
        name: String,
        /// What is said beside it.
        #[serde(flatten)]
        parts: Parts,
    },
    /// What loops, motions and closed limits ask: the value, rate and acceleration that must vanish.
    Rows,
    /// Three coordinates a body, every joint a constraint.
    Constraints,
    /// A point through the frames of bodies, each seen from the one before.
    Through {
        /// The point.
        point: String,
        /// The bodies; none for those by which that of the point hangs in the tree.
        frames: Group,
    },
    /// The rates of the states that have one of their own, in the order of the model.
    StateRates,
    /// Kinetic and potential energy.
    Energy,
    /// Lagrange's equations.
    Lagrange,
    /// Virtual power in motions that keep closed what is closed: one equation for each coordinate that is not bound.
    VirtualPower {
        /// The coordinates that follow from the rows.
        bound: Vec<String>,
        /// The rows by their places, as many.
        rows: Vec<usize>,
    },
    /// The equations of the coordinates for small departures from rest at given coordinates.
    Linear {
        /// Coordinates that are numbers there; the others stay variables.
        at: BTreeMap<String, f64>,
    },
}

/// What is taken as a number from the start.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Setting {
    /// All rates are 0.
    pub at_rest: bool,
    /// Variables with their numbers: `theta`, or `theta.1` for its rate and `theta.2` for its acceleration.
    pub numbers: BTreeMap<String, f64>,
}

impl Setting {
    /// The number that a variable is set to.
    pub fn fixed(&self, name: &str, dots: u8) -> Option<f64> {
        let key = if dots == 0 { name.to_string() } else { format!("{name}.{dots}") };
        self.numbers.get(&key).copied().or_else(|| (self.at_rest && dots == 1).then_some(0.0))
    }
}

/// Answers to questions about a solved balance.
///
/// # Errors
/// Unknown names; as [`Workspace::solve`].
pub fn answer(workspace: &mut Workspace<'_>, setting: &Setting, questions: &[Query]) -> Result<Value, DynamicsError> {
    let diagram = free_bodies::free_bodies(workspace)?;
    let values: Vec<f64> = diagram["loads"]
        .as_array()
        .map_or(vec![], |loads| loads.iter().map(|l| l["value"].as_f64().unwrap_or(1.0)).collect());
    let workspace = &*workspace;
    algebra::session(|| {
        let variables = SymbolicState::new(workspace, setting, &values);
        let answers: Result<Vec<Value>, DynamicsError> = questions.iter().map(|q| variables.answer(q)).collect();
        if algebra::is_exhausted() {
            return Err(DynamicsError::TooLarge);
        }
        Ok(
            json!({"answers": answers?, "loads": diagram["loads"], "laws": variables.laws(), "symbols": variables.table()}),
        )
    })
}

impl SymbolicState<'_> {
    fn answer(&self, question: &Query) -> Result<Value, DynamicsError> {
        match question {
            Query::Kinematics => Ok(self.kinematics()),
            Query::Equation { bodies, about, along, parts } => {
                let bodies = self.group(bodies)?;
                let test = self.virtual_motion_of(about.as_ref(), along.as_ref(), &bodies)?;
                Ok(self.equation(&bodies, test, *parts))
            }
            Query::Coordinate { name, parts } => {
                let (bodies, test) = self.of_coordinate(self.coordinate(name)?);
                Ok(self.equation(&bodies, test, *parts))
            }
            Query::Rows => Ok(self.rows()),
            Query::Constraints => Ok(self.constraints()),
            Query::Through { point, frames } => self.through(point, frames),
            Query::StateRates => Ok(self.state_rates()),
            Query::Energy => Ok(self.energy()),
            Query::Lagrange => Ok(self.lagrange()),
            Query::VirtualPower { bound, rows } => self.virtual_power(bound, rows),
            Query::Linear { at } => Ok(self.linearised(at)),
        }
    }
}
