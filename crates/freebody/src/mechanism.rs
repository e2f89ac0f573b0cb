//! The compiled mechanism: topology, immutable and without numbers.
//!
//! Every number of the model is a *slot*: an expression of the parameters `p`, evaluated once by
//! [`Mechanism::bind`]. Bodies are numbered in the order of the tree, parents first; body 0 is ground.

use crate::contact::{Group, Limit};
use crate::expr::Table;
use crate::forces::Force;
use crate::gauges::{Law, Leaf};
use crate::joints::Kind;

/// Index of a number of the model.
pub type Slot = usize;

/// A mechanism without numbers.
pub struct Mechanism {
    /// Title.
    pub name: String,
    /// The parameters, in the order of the model.
    pub parameters: Vec<Parameter>,
    /// An order in which every parameter comes after those it uses.
    pub parameter_order: Vec<usize>,
    /// Every number of the model.
    pub slots: Vec<Law>,
    /// Functions given by points.
    pub tables: Vec<Table>,
    /// Their names.
    pub table_names: Vec<String>,
    /// Acceleration of gravity.
    pub gravity: [Slot; 2],
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
    pub gauges: Vec<(String, Law)>,
    /// All joints: those of the model in its order, then those added while compiling.
    pub joints: Vec<Joint>,
    /// Joints that close loops.
    pub closures: Vec<usize>,
    /// The coordinates of the tree: joint and number within the joint, in the order of `q`.
    pub coordinates: Vec<(usize, usize)>,
    /// Couplings and prescribed motions.
    pub drives: Vec<Drive>,
    /// The forces, gravity apart.
    pub forces: Vec<Force>,
    /// Gauges that cannot fall below zero: contacts, stops, strings.
    pub limits: Vec<Limit>,
    /// The contacts, stops and strings of the model.
    pub groups: Vec<Group>,
    /// Joints that rub.
    pub rubs: Vec<Rub>,
    /// Joints along curves that can be released.
    pub runners: Vec<Runner>,
    /// Parts that are not in place at the start.
    pub idle: Vec<Part>,
    /// What to watch for.
    pub events: Vec<Event>,
    /// Where laws and curves are not smooth: the integrator must not step over these.
    pub kinks: Vec<Kink>,
    /// Number of switches in the model.
    pub switches: usize,
    /// What was assumed while compiling, in sentences.
    pub notes: Vec<String>,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Unit for display.
    pub unit: String,
    /// Its value, an expression of other parameters.
    pub value: Law,
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
    /// Its pieces.
    pub pieces: Vec<Piece>,
    /// How it hangs in the tree; ground hangs on nothing.
    pub branch: Option<Branch>,
    /// Its reference point: the marker of its joint in the tree.
    pub pin: usize,
}

/// How a body hangs in the tree.
#[derive(Clone, Copy, Debug)]
pub struct Branch {
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
    /// A plain hinge, told the short way.
    pub hinge: bool,
}

/// A piece of a body.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Its shape.
    pub shape: crate::shapes::Shape,
    /// Mass.
    pub mass: Slot,
    /// Origin of the shape in the body's frame.
    pub at: [Slot; 2],
    /// Turn of the shape's axes in the body's frame.
    pub angle: Slot,
    /// Inertia about the mass centre, when it is given.
    pub inertia: Option<Slot>,
    /// Sizes or corners of the shape.
    pub sizes: Vec<Slot>,
}

/// A place on a body.
#[derive(Clone, Copy, Debug)]
pub struct Site {
    /// The body.
    pub body: usize,
    /// Where on the body.
    pub at: Spot,
}

/// Where a site is, in its body's frame.
#[derive(Clone, Copy, Debug)]
pub enum Spot {
    /// At coordinates.
    At([Slot; 2]),
    /// At the mass centre.
    MassCentre,
}

/// A site with a direction.
#[derive(Clone, Copy, Debug)]
pub struct Marker {
    /// The site.
    pub site: usize,
    /// Direction in the body's frame.
    pub angle: Slot,
}

/// A curve of a body, in the body's frame.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name.
    pub name: String,
    /// The body.
    pub body: usize,
    /// x as a function of the curve's parameter.
    pub x: Law,
    /// y as a function of the curve's parameter.
    pub y: Law,
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Marker on the first body.
    pub first: Marker,
    /// Marker on the second body.
    pub second: Marker,
    /// Its numbers.
    pub numbers: Vec<Slot>,
    /// Its curve.
    pub curve: Option<usize>,
    /// Number of coordinates on its card.
    pub size: usize,
    /// Its coordinates, those that a particle does not have left out.
    pub coordinates: Vec<Coordinate>,
    /// Its rows as a constraint, those that a particle does not have left out: index among the card's rows.
    pub rows: Vec<usize>,
    /// Of each row of the card, whether only its change counts.
    pub phased: Vec<bool>,
    /// The body that hangs on it, if it is in the tree.
    pub child: Option<usize>,
}

impl Joint {
    /// The markers on the body nearer to ground and on the one that it carries.
    #[inline(always)]
    pub fn sides(&self, reversed: bool) -> (&Marker, &Marker) {
        if reversed {
            (&self.second, &self.first)
        } else {
            (&self.first, &self.second)
        }
    }
}

/// A joint coordinate, as its user reads it.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Name.
    pub name: String,
    /// Which of the card's coordinates it is.
    pub card: usize,
    /// `m`, `rad` or nothing.
    pub dimension: &'static str,
    /// Reading of the joint's measure where the coordinate is 0.
    pub zero: Slot,
    /// +1 or −1.
    pub sense: f64,
    /// Measured from the fixed x axis instead of from the first body.
    pub absolute: bool,
}

/// At which level a motion is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// The gauge's value is given.
    Position,
    /// Its rate is given.
    Velocity,
    /// Its acceleration is given.
    Acceleration,
}

/// A coupling or a prescribed motion: one row on gauges.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name.
    pub name: String,
    /// Whether it is a coupling (a joint of the model) rather than a motion.
    pub coupling: bool,
    /// The gauge whose motion is given.
    pub of: Law,
    /// What it is given to be.
    pub law: Law,
    /// At which level.
    pub level: Level,
    /// The gauge along which the force acts, when it is another one.
    pub by: Option<Law>,
    /// Whether the law reads the state.
    pub feedback: bool,
}

/// Coulomb friction that is known once the force that presses is: at most a coefficient times its size.
#[derive(Clone, Debug)]
pub struct Rub {
    /// What rubs.
    pub of: Rubbing,
    /// Coefficient at rest.
    pub fixed: Slot,
    /// Coefficient of sliding.
    pub kinetic: Slot,
}

/// What rubs.
#[derive(Clone, Copy, Debug)]
pub enum Rubbing {
    /// A joint, by the force that it carries (times the radius of its bearing).
    Joint {
        /// The joint.
        joint: usize,
        /// Radius of the bearing of a hinge, which rubs as it turns; all else rubs along its line or curve.
        radius: Option<Slot>,
    },
    /// A limit for which a spring stands, by the force of the spring and its damper.
    Limit(usize),
}

/// A massless particle that runs on a curve and carries a pin, in place of a joint along the curve that can be released:
/// then the pin is, and the particle is held where it is.
#[derive(Clone, Copy, Debug)]
pub struct Runner {
    /// The joint along the curve, which carries the particle.
    pub joint: usize,
    /// The joint by which the particle carries the second body.
    pub pin: usize,
    /// The row that holds the particle.
    pub hold: usize,
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

/// A place where a law or a curve is not smooth: the zero of a function of the state.
#[derive(Clone, Debug)]
pub enum Kink {
    /// A switch of a law, by its identifier; its arm is frozen between the kinks.
    Switch(usize, Law),
    /// The argument of a table of straight pieces at one of its points.
    Knot(Law, f64),
    /// A switch in the description of the curve of a joint.
    Bend(usize, usize),
}

/// Something to watch for.
#[derive(Clone, Debug)]
pub struct Event {
    /// Name.
    pub name: String,
    /// Its zero is the event.
    pub when: Law,
    /// +1, −1 or 0.
    pub direction: i8,
    /// Armed only while this holds.
    pub condition: Option<crate::expr::Condition<Leaf>>,
    /// It happens at the start, before anything moves.
    pub opening: bool,
    /// A value below 0 is the event, too, where the motion starts or starts afresh.
    pub guard: bool,
    /// What happens then, besides being recorded.
    pub then: Vec<Deed>,
}

/// What an event does.
#[derive(Clone, Debug)]
pub enum Deed {
    /// End the run.
    Stop,
    /// Give a parameter the value of an expression.
    Set(usize, Law),
    /// Take a part away.
    Release(Part),
    /// Put a part in place; what does not fit at once comes together with a plastic impact.
    Engage(Part),
    /// Give a gauge a rate at once, with the least change of momentum.
    Reset {
        /// The gauge in its user's words.
        gauge: String,
        /// The gauge.
        of: Law,
        /// Its rate.
        rate: Law,
    },
}

impl Mechanism {
    /// A mechanism of which only the title is known yet.
    pub(crate) fn empty(name: &str) -> Self {
        Mechanism {
            name: name.to_string(),
            parameters: vec![],
            parameter_order: vec![],
            slots: vec![],
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
            forces: vec![],
            limits: vec![],
            groups: vec![],
            rubs: vec![],
            runners: vec![],
            idle: vec![],
            events: vec![],
            kinks: vec![],
            switches: 0,
            notes: vec![],
        }
    }
    /// Whether what holds it can change during a motion: limits, friction, or parts that are released and engaged.
    pub fn changes(&self) -> bool {
        let switches = |deed: &Deed| matches!(deed, Deed::Release(_) | Deed::Engage(_));
        !(self.limits.is_empty() && self.rubs.is_empty() && self.idle.is_empty())
            || self.events.iter().any(|e| e.then.iter().any(switches))
    }
    /// The row that holds what runs on a curve once its pin, a part, is released.
    pub fn held_without(&self, part: Part) -> Option<Part> {
        let runner = self.runners.iter().find(|runner| part == Part::Joint(runner.pin))?;
        Some(Part::Drive(runner.hold))
    }
    /// What is released where a joint is.
    pub fn part_of(&self, joint: usize) -> Part {
        let runner = self.runners.iter().find(|runner| runner.joint == joint);
        Part::Joint(runner.map_or(joint, |runner| runner.pin))
    }
    /// The friction of a limit for which a spring stands.
    pub fn rub_of(&self, limit: usize) -> Option<usize> {
        self.rubs.iter().position(|rub| matches!(rub.of, Rubbing::Limit(l) if l == limit))
    }
    /// Degrees of freedom of the tree: the length of `q`.
    pub fn freedom(&self) -> usize {
        self.coordinates.len()
    }
    /// The last body on the way from ground to both of two bodies.
    pub fn common_carrier(&self, a: usize, b: usize) -> usize {
        let (mut a, mut b) = (a, b);
        while a != b {
            // Parents come first: the later of the two cannot carry the other.
            let later = if a > b { &mut a } else { &mut b };
            *later = self.bodies[*later].branch.map_or(0, |branch| branch.parent);
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
        self.bodies[child].branch.map(|b| b.start + k)
    }
    /// The bodies on which a law depends, ground left out, each once.
    pub fn bodies_of(&self, law: &Law) -> Vec<usize> {
        let mut bodies: Vec<usize> = law.leaves().flat_map(|leaf| self.leaf_bodies(leaf)).filter(|&b| b > 0).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }
    fn leaf_bodies(&self, leaf: &Leaf) -> Vec<usize> {
        match leaf {
            Leaf::X(site) | Leaf::Y(site) => vec![self.body_of(*site)],
            Leaf::Angle(body) => vec![*body],
            Leaf::Coordinate(joint, _) => self.ends(&self.joints[*joint]).to_vec(),
            _ => vec![],
        }
    }
}
