//! The compiled mechanism: topology, immutable and without numbers.
//!
//! Every number of the model is a *value*: an expression of the parameters `p`, evaluated once by
//! [`Mechanism::bind`]. Bodies are numbered in the order of the tree, parents first; body 0 is ground.

mod cables;
mod drives;
mod events;
mod forces;
mod joints;
mod recording;
mod surfaces;
mod unilateral;

pub use cables::{Cable, End, Guide};
pub use drives::{Drive, DriveGauges, DriveKind, Level};
pub use events::{Discontinuity, Event, EventAction};
pub use forces::{Force, GaugeForce, PlateFriction, PlateOutline, PointForce};
pub use joints::{Coordinate, CurveFollower, FrictionSource, Joint, JointFriction};
pub use recording::Recording;
pub use surfaces::{Arc, Chain, ContactPair, Disk, Profile, Stretch, Track};
pub use unilateral::{Friction, Gap, Group, UnilateralConstraint, FRICTION};

use crate::expr::Table;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::Joint as _;
use crate::plane::Turn;
use crate::scalar::Scalar;
use crate::series::{Latest, Memo, Tape};

/// Index of a number of the model.
pub type ValueId = usize;

/// A mechanism without numbers.
pub struct Mechanism {
    /// Title.
    pub name: String,
    /// The parameters, in the order of the model; behind them the states, whose values are those at the start.
    pub parameters: Vec<Parameter>,
    /// An order in which every parameter comes after those it uses.
    pub parameter_order: Vec<usize>,
    /// The rates of the states.
    pub state_rates: Vec<ModelExpr>,
    /// Every number of the model.
    pub values: Vec<ModelExpr>,
    /// Those that are sizes of bodies, lengths of links and strings, radii: m.
    pub lengths: Vec<ValueId>,
    /// Functions given by points.
    pub tables: Vec<Table>,
    /// Their names.
    pub table_names: Vec<String>,
    /// Acceleration of gravity.
    pub gravity: [ValueId; 2],
    /// Ground, then the bodies in tree order.
    pub bodies: Vec<Body>,
    /// Places on bodies.
    pub sites: Vec<Site>,
    /// Named points: name and site.
    pub points: Vec<(String, usize)>,
    /// Named lines: name and marker.
    pub lines: Vec<(String, Marker)>,
    /// Curves of bodies.
    pub curves: Vec<Curve>,
    /// Named gauges.
    pub gauges: Vec<(String, ModelExpr)>,
    /// All joints: those of the model in its order, then those added while compiling.
    pub joints: Vec<Joint>,
    /// Joints that close loops.
    pub closures: Vec<usize>,
    /// The coordinates of the tree: joint and number within the joint, in the order of `q`.
    pub coordinates: Vec<(usize, usize)>,
    /// Couplings and prescribed motions.
    pub drives: Vec<Drive>,
    /// The gauges of their rows.
    pub drive_gauges: Vec<DriveGauges>,
    /// The forces, gravity apart.
    pub forces: Vec<Force>,
    /// Gauges that cannot fall below zero: contacts, stops, strings.
    pub unilateral: Vec<UnilateralConstraint>,
    /// The contacts, stops and strings of the model.
    pub groups: Vec<Group>,
    /// Joints with friction.
    pub joint_friction: Vec<JointFriction>,
    /// Joints along curves that can be released.
    pub curve_followers: Vec<CurveFollower>,
    /// Parts that are not in place at the start.
    pub initially_absent: Vec<Part>,
    /// What to watch for.
    pub events: Vec<Event>,
    /// Where laws and curves are not smooth: the integrator must not step over these.
    pub discontinuities: Vec<Discontinuity>,
    /// The item of the model in whose law or curve each of them stands, e.g. `forces.wind`.
    pub discontinuous_items: Vec<String>,
    /// Number of switches in the model.
    pub switches: usize,
    /// What was assumed while compiling, in sentences.
    pub notes: Vec<String>,
    /// What was recorded of its motion when it was needed first, by which bodies have no mass.
    pub recorded: Memo<(Recording, Vec<bool>)>,
    /// Its equations for series, by the parameters.
    pub equations: Latest<Vec<f64>, Tape<f64>>,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Unit for display.
    pub unit: String,
    /// Its value, an expression of other parameters.
    pub value: ModelExpr,
}

/// A body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Position in the model's list; ground has none.
    pub listed: Option<usize>,
    /// A particle has no rotation.
    pub particle: bool,
    /// Its features.
    pub mass_elements: Vec<MassElement>,
    /// How it hangs in the tree; ground hangs on nothing.
    pub tree_joint: Option<TreeJoint>,
    /// Its reference point: the marker of its joint in the tree.
    pub joint_origin: usize,
}

/// How a body hangs in the tree.
#[derive(Clone, Copy, Debug)]
pub struct TreeJoint {
    /// The body nearer to ground.
    pub parent: usize,
    /// The joint between them.
    pub joint: usize,
    /// Whether the parent is the joint's second body.
    pub reversed: bool,
    /// First coordinate in `q`.
    pub start: usize,
    /// Number of coordinates.
    pub freedom: usize,
    /// A plain hinge, whose pose and motion are written out.
    pub hinge: bool,
}

/// A piece of a body.
#[derive(Clone, Debug)]
pub struct MassElement {
    /// Its shape.
    pub shape: crate::shapes::Shape,
    /// Mass.
    pub mass: ValueId,
    /// Origin of the shape in the body's frame.
    pub at: [ValueId; 2],
    /// Turn of the shape's axes in the body's frame.
    pub angle: ValueId,
    /// Inertia about the mass centre, when it is given.
    pub inertia: Option<ValueId>,
    /// Sizes or corners of the shape.
    pub sizes: Vec<ValueId>,
}

/// A place on a body.
#[derive(Clone, Copy, Debug)]
pub struct Site {
    /// The body.
    pub body: usize,
    /// Where on the body.
    pub at: PointLocation,
}

/// Where a site is, in its body's frame.
#[derive(Clone, Copy, Debug)]
pub enum PointLocation {
    /// At coordinates.
    At([ValueId; 2]),
    /// At the mass centre.
    MassCentre,
}

/// A site with a direction.
#[derive(Clone, Copy, Debug)]
pub struct Marker {
    /// The site.
    pub site: usize,
    /// Direction in the body's frame.
    pub angle: ValueId,
    /// Whether that may be another than 0.
    pub turned: bool,
}

impl Marker {
    /// Its axes on a body turned as `body` says, for its direction there.
    #[inline(always)]
    pub fn axes<S: Scalar>(&self, body: Turn<S>, direction: S) -> Turn<S> {
        match self.turned {
            true => Turn::by(body.angle + direction),
            false => body,
        }
    }
}

/// A curve of a body, in the body's frame.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name.
    pub name: String,
    /// The body.
    pub body: usize,
    /// x as a function of the curve's parameter.
    pub x: ModelExpr,
    /// y as a function of the curve's parameter.
    pub y: ModelExpr,
}

/// Something that can be released and engaged during a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A joint; one that closes a loop.
    Joint(usize),
    /// A coupling or a prescribed motion.
    Drive(usize),
    /// A force.
    Force(usize),
    /// A contact, stop or string.
    Group(usize),
}

impl Mechanism {
    /// A mechanism of which only the title is known yet.
    pub(crate) fn empty(name: &str) -> Self {
        Mechanism {
            name: name.to_string(),
            parameters: vec![],
            parameter_order: vec![],
            state_rates: vec![],
            values: vec![],
            lengths: vec![],
            tables: vec![],
            table_names: vec![],
            gravity: [0; 2],
            bodies: vec![],
            sites: vec![],
            points: vec![],
            lines: vec![],
            curves: vec![],
            gauges: vec![],
            joints: vec![],
            closures: vec![],
            coordinates: vec![],
            drives: vec![],
            drive_gauges: vec![],
            forces: vec![],
            unilateral: vec![],
            groups: vec![],
            joint_friction: vec![],
            curve_followers: vec![],
            initially_absent: vec![],
            events: vec![],
            discontinuities: vec![],
            discontinuous_items: vec![],
            switches: 0,
            notes: vec![],
            recorded: Memo::default(),
            equations: Latest::default(),
        }
    }
    /// Whether what holds it can change during a motion: unilateral constraints, friction, or parts that are released
    /// and engaged.
    pub fn is_hybrid(&self) -> bool {
        !(self.unilateral.is_empty() && self.joint_friction.is_empty()) || self.has_parts_that_come_and_go()
    }
    /// Whether parts are released or engaged.
    pub fn has_parts_that_come_and_go(&self) -> bool {
        let switches = |action: &EventAction| matches!(action, EventAction::Release(_) | EventAction::Engage(_));
        !self.initially_absent.is_empty() || self.events.iter().any(|e| e.then.iter().any(switches))
    }
    /// The row that holds what runs on a curve once its pin, a part, is released.
    pub fn held_without(&self, part: Part) -> Option<Part> {
        let follower = self.curve_followers.iter().find(|follower| part == Part::Joint(follower.released_joint))?;
        Some(Part::Drive(follower.hold))
    }
    /// The massless body that a joint along a curve carries to close a loop, and the body that is pinned to it: those of
    /// a pin; None for any other joint.
    pub fn carried(&self, pin: usize) -> Option<[usize; 2]> {
        let [parent, body] = self.ends(&self.joints[pin]);
        (parent > 0 && self.bodies[parent].listed.is_none()).then_some([parent, body])
    }
    /// The joints of the model, in its order: all but the pins of massless bodies.
    pub fn listed_joints(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.joints.len()).filter(|&joint| self.carried(joint).is_none())
    }
    /// The pin of the massless body that a joint along a curve carries, if it carries one.
    pub fn pin_of(&self, joint: usize) -> Option<usize> {
        let child = self.joints[joint].child?;
        self.closures.iter().copied().find(|&pin| self.carried(pin).is_some_and(|[carrier, _]| carrier == child))
    }
    /// First and second body of a joint as in the model: one along a curve is of the body that is pinned to what it carries.
    pub fn listed_ends(&self, joint: usize) -> [usize; 2] {
        let [first, second] = self.ends(&self.joints[joint]);
        [first, self.pin_of(joint).map_or(second, |pin| self.ends(&self.joints[pin])[1])]
    }
    /// What is released where a joint is.
    pub fn part_of(&self, joint: usize) -> Part {
        let follower = self.curve_followers.iter().find(|follower| follower.joint == joint);
        Part::Joint(follower.map_or(joint, |follower| follower.released_joint))
    }
    /// The friction of a unilateral constraint for which a spring stands.
    pub fn joint_friction_of(&self, constraint: usize) -> Option<usize> {
        self.joint_friction
            .iter()
            .position(|friction| matches!(friction.of, FrictionSource::Unilateral(l) if l == constraint))
    }
    /// Where the states begin among the parameters.
    pub fn first_state(&self) -> usize {
        self.parameters.len() - self.state_rates.len()
    }
    /// Degrees of freedom of the tree: the length of `q`.
    pub fn freedom(&self) -> usize {
        self.coordinates.len()
    }
    /// The last body on the way from ground to both of two bodies.
    pub fn common_ancestor(&self, a: usize, b: usize) -> usize {
        let (mut a, mut b) = (a, b);
        while a != b {
            // Parents come first: the later of the two cannot carry the other.
            let later = if a > b { &mut a } else { &mut b };
            *later = self.bodies[*later].tree_joint.map_or(0, |branch| branch.parent);
        }
        a
    }
    /// The bodies in the order of the model.
    pub fn listed_bodies(&self) -> Vec<usize> {
        let mut bodies: Vec<usize> = (0..self.bodies.len()).filter(|&i| self.bodies[i].listed.is_some()).collect();
        bodies.sort_by_key(|&i| self.bodies[i].listed);
        bodies
    }
    /// The body on which a site lies.
    pub fn body_of(&self, site: usize) -> usize {
        self.sites[site].body
    }
    /// First and second body of a joint.
    pub fn ends(&self, joint: &Joint) -> [usize; 2] {
        [self.body_of(joint.first.site), self.body_of(joint.second.site)]
    }
    /// Coordinate `i` of `q`.
    pub fn coordinate(&self, i: usize) -> &Coordinate {
        let (joint, k) = self.coordinates[i];
        &self.joints[joint].coordinates[k]
    }
    /// Index in `q` of coordinate `k` of a joint, if the joint is in the tree.
    pub fn place_in_q(&self, joint: usize, k: usize) -> Option<usize> {
        let child = self.joints[joint].child?;
        self.bodies[child].tree_joint.map(|b| b.start + k)
    }
    /// The bodies on which a law depends, ground left out, each once.
    pub fn bodies_of(&self, law: &ModelExpr) -> Vec<usize> {
        let mut bodies: Vec<usize> =
            law.variables().flat_map(|variable| self.variable_bodies(variable)).filter(|&b| b > 0).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }
    /// The unit of a gauge, m or rad, where all that it reads has this one.
    pub fn gauge_unit(&self, law: &ModelExpr) -> Option<&str> {
        let unit = |leaf: &ModelVariable| match leaf {
            ModelVariable::X(_) | ModelVariable::Y(_) => "m",
            ModelVariable::Angle(_) => "rad",
            ModelVariable::Coordinate(joint, k) => self.joints[*joint].coordinates[*k].dimension,
            ModelVariable::Parameter(i) => self.parameters[*i].unit.as_str(),
            ModelVariable::State(i) => self.parameters[self.first_state() + i].unit.as_str(),
            _ => "",
        };
        let mut units: Vec<&str> = law.variables().map(unit).filter(|unit| !unit.is_empty()).collect();
        units.sort_unstable();
        units.dedup();
        match units[..] {
            [unit @ ("m" | "rad")] => Some(unit),
            _ => None,
        }
    }
    /// Whether all that a law reads of the configuration are turns of bodies: what acts along it is a couple.
    pub fn turns(&self, law: &ModelExpr) -> bool {
        let mut read = law.variables().filter(|variable| !self.variable_bodies(variable).is_empty()).peekable();
        let turn = |variable: &ModelVariable| match variable {
            ModelVariable::Coordinate(joint, k) => {
                let joint = &self.joints[*joint];
                joint.kind.card().coordinates[joint.coordinates[*k].card].turn
            }
            variable => matches!(variable, ModelVariable::Angle(_)),
        };
        read.peek().is_some() && read.all(turn)
    }
    fn variable_bodies(&self, variable: &ModelVariable) -> Vec<usize> {
        match variable {
            ModelVariable::X(site) | ModelVariable::Y(site) => vec![self.body_of(*site)],
            ModelVariable::Angle(body) => vec![*body],
            ModelVariable::Coordinate(joint, _) => self.ends(&self.joints[*joint]).to_vec(),
            _ => vec![],
        }
    }
}
