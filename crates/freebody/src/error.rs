//! Named failures.

use std::fmt;

/// Why a state has no answer. An item of the model goes by its path, e.g. `joints.pivot`.
#[derive(Clone, Debug, PartialEq)]
pub enum DynamicsError {
    /// Something (in words) can move without inertia: words, item.
    ZeroInertia(String, Option<String>),
    /// A system of equations is singular.
    NoUniqueMotion,
    /// Actuators cannot bring about a motion of bodies: words, item.
    OutOfReach(String, Option<String>),
    /// Prescribed motions and loops ask for more independent conditions than there are ways to act.
    TooFewActuators {
        /// Conditions.
        asked: usize,
        /// Ways.
        ways: usize,
    },
    /// Constraints, by name, contradict each other: names, item.
    Contradiction(Vec<String>, Option<String>),
    /// The sparse equations leave a residual at an item: its size, name, item.
    Residual(f64, String, String),
    /// The sparse equations with actuators along another direction, of more unknowns than the dense ones hold.
    TooManyForDense,
    /// The accelerations are not finite.
    NoFiniteAcceleration,
    /// A force acts along a line of no length: its name, item.
    ForceWithoutDirection(String, String),
    /// A force is not finite: its name, item.
    InfiniteForce(String, String),
    /// A number that is given is not finite: name, value.
    NoFiniteNumber(String, f64),
    /// An array that is given has the wrong size.
    WrongSize {
        /// What it holds.
        what: &'static str,
        /// How many are needed.
        wanted: usize,
        /// How many were given.
        given: usize,
    },
    /// A state has the history of a motion of another mechanism.
    ForeignHistory,
    /// A loop opened during a motion: its name, gap (m), item.
    LoopOpened(String, f64, String),
    /// The way from one state to another comes near a singular position.
    SingularWay,
    /// A loop that motions drive on to where it cannot close: its name, how far it can in words, item.
    DeadPosition(String, String, String),
    /// A loop that motions bring next to a singular position, where it stays: its name, where in words, item.
    SingularPosition(String, String, String),
    /// An assembly leaves gaps: name and gap of each, the item of the widest.
    CannotAssemble(Vec<(String, f64)>, Option<String>),
    /// No assembly has the signs asked for of expressions.
    BranchNotFound(Vec<String>),
    /// Rates asked for contradict each other: the name of each and what the nearest motion leaves of it; the item of the first.
    InconsistentRates(Vec<(String, f64)>, Option<String>),
    /// A contact, stop or string is violated: in words, and what to try; item.
    Penetration(String, &'static str, String),
    /// No force of joint friction fits the loads that it causes: names.
    SelfLocking(Vec<String>),
    /// Contacts whose friction leaves no motion, or several: names and figures in words, item.
    Paradox(Paradox, String, String),
    /// Contacts that slide and press against each other, by an amount that is left open: names, item.
    UndecidedPress(String, String),
    /// Contacts cannot be brought to rest without creating energy: names, J.
    CreatesEnergy(String, f64),
    /// No impulses at contacts do what is asked: names, what, why.
    NoImpulses(String, &'static str, String),
    /// Contacts between which prescribed motions and locks leave nothing that could yield: names.
    DrivenTogether(String),
    /// The impulses found create energy: t, J.
    ImpulsesCreateEnergy(f64, f64),
    /// Impacts at once whose outcome rigid bodies leave open: names, what follows by each rule.
    SimultaneousImpact(String, Vec<String>),
    /// Impacts at one instant come to no end: how many.
    EndlessImpacts(usize),
    /// A taut string became a point: name, item.
    StringZeroLength(String, String),
    /// A taut string is drawn in up to the rim of its drum: name, item.
    StringWoundUp(String, String),
    /// A pin takes hold of two particles at a distance, in the axes of neither: name, the two.
    NoAxes(String, [String; 2]),
    /// A motion that switches was asked for backward in time.
    Backward,
    /// A time outside the run: t, first, last.
    OutOfRange(f64, f64, f64),
    /// A change of a run, by its place, that is no impact.
    NotAnImpact(usize),
    /// An impact, at a time, whose outcome has no derivative that is known.
    NoImpactDerivative(f64),
    /// An integrator of an unknown name: name, those that there are.
    UnknownMethod(String, Vec<&'static str>),
    /// A question about a name that nothing bears: what is wrong and what to try.
    UnknownName(String),
    /// A question that cannot be read, or asks for too much or too little: what is wrong.
    WrongQuestion(String),
    /// Symbolic equations grow beyond what can be written.
    TooLarge,
    /// A motion is not followed by its Taylor series to many digits: why.
    NoSeries(&'static str),
    /// The stages of an implicit step did not converge: t, iterations.
    FixedPointStalled(f64, usize),
}

/// What Coulomb's law and rigid bodies leave of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paradox {
    /// No motion satisfies both.
    Inconsistent,
    /// Several do.
    Indeterminate,
    /// None was found.
    Unsolved,
}

impl DynamicsError {
    /// Whether friction lets no motion go on, or none that was found.
    pub fn is_jam(&self) -> bool {
        matches!(self, Self::Paradox(Paradox::Inconsistent | Paradox::Unsolved, ..) | Self::CreatesEnergy(..))
    }
    /// Its fixed name, e.g. `singular_mass`.
    pub fn name(&self) -> &'static str {
        self.description().0
    }
    /// One sentence: what happened, and after a semicolon what to do.
    pub fn sentence(&self) -> String {
        self.description().1
    }
    /// What happened, and what to do.
    pub fn what_and_hint(&self) -> (String, String) {
        let sentence = self.sentence();
        let (what, hint) = sentence.split_once("; ").unwrap_or((&sentence, ""));
        (what.to_string(), hint.to_string())
    }
    /// The item of the model that it is about, where there is one.
    pub fn path(&self) -> Option<&str> {
        self.description().2
    }

    fn description(&self) -> (&'static str, String, Option<&str>) {
        let quoted = |names: &[String]| names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
        match self {
            Self::ZeroInertia(what, at) => (
                "singular_mass",
                format!("{what} with no inertia to resist it; give it (or what hangs on it) mass and inertia, or lock that motion"),
                at.as_deref(),
            ),
            Self::NoUniqueMotion => (
                "singular_mass",
                "the balance equations have no unique motion; the route `minimal` says where".into(),
                None,
            ),
            Self::OutOfReach(what, at) => (
                "insufficient_actuation",
                format!("the actuators cannot bring about the prescribed motion: {what} out of their reach"),
                at.as_deref(),
            ),
            Self::TooFewActuators { asked, ways } => (
                "insufficient_actuation",
                format!("the prescribed motions and loops ask for {asked} independent conditions, but the actuators and joints can act in {ways} ways; let each motion have an actuator of its own"),
                None,
            ),
            Self::Contradiction(names, at) => (
                "inconsistent_constraints",
                format!("{} ask for motions that exclude each other; remove one, or make them agree", quoted(names)),
                at.as_deref(),
            ),
            Self::Residual(size, name, at) => (
                "inconsistent_constraints",
                format!("the equations leave a residual of {size:.1e} at `{name}`: its constraints exclude each other, or a motion there has no inertia"),
                Some(at),
            ),
            Self::TooManyForDense => (
                "unsupported",
                "the route `constraints` cannot hold actuators with a direction of their own in a mechanism of this size; use `minimal`".into(),
                None,
            ),
            Self::NoSeries(why) => (
                "unsupported",
                format!("the motion cannot be followed by its Taylor series to many digits because {why}; use `simulate`"),
                None,
            ),
            Self::NoFiniteAcceleration => (
                "not_finite",
                "the accelerations are not finite; look for a division by 0, or a force along a line of no length".into(),
                None,
            ),
            Self::ForceWithoutDirection(name, at) => (
                "not_finite",
                format!("the force `{name}` acts along a line of no length, so it has no direction; keep its ends apart, or give it no rest length and no damping"),
                Some(at),
            ),
            Self::InfiniteForce(name, at) => (
                "not_finite",
                format!("the force `{name}` is not finite; look for a division by 0 in its law, or a root of what is negative"),
                Some(at),
            ),
            Self::NoFiniteNumber(name, value) => {
                ("not_finite", format!("{name} = {value} is no finite number; give it a value"), None)
            }
            Self::WrongSize { what, wanted, given } => (
                "wrong_size",
                format!("{wanted} {what}s are needed, and {given} were given; take them from `bind` and `assemble`"),
                None,
            ),
            Self::ForeignHistory => (
                "foreign_history",
                "the state is of a motion of another mechanism; take it without its history".to_string(),
                None,
            ),
            Self::LoopOpened(name, gap, at) => (
                "branch_lost",
                format!("the loop at `{name}` opened by {gap:.3e} (m or rad) and could not be closed again"),
                Some(at),
            ),
            Self::SingularWay => (
                "branch_lost",
                "on the way there loops come to a singular position, where they change over to another assembly; ask for a place on this side of it".into(),
                None,
            ),
            Self::DeadPosition(name, place, at) => (
                "dead_position",
                format!("dead position: the loop at `{name}` cannot close beyond {place}; end the motion before, or drive another part"),
                Some(at),
            ),
            Self::SingularPosition(name, place, at) => (
                "dead_position",
                format!("the loop at `{name}` comes to a singular position at {place} and stays next to it, where accelerations and forces have no digits; end the motion before, or drive another part"),
                Some(at),
            ),
            Self::CannotAssemble(gaps, at) => {
                let listed: Vec<String> = gaps.iter().map(|(name, gap)| format!("{gap:.4} at `{name}`")).collect();
                (
                    "cannot_assemble",
                    format!("the parts do not fit together: at the nearest approach the gaps (m or rad) are {}; check the lengths and the values under `initial`, or give approximate ones under `guess`", listed.join(", ")),
                    at.as_deref(),
                )
            }
            Self::BranchNotFound(signs) => (
                "branch_not_found",
                format!("no assembly was found in which the signs of {} are as asked; try the other sign or a nearer guess", signs.join(", ")),
                None,
            ),
            Self::InconsistentRates(left, at) => {
                let listed: Vec<String> = left.iter().map(|(name, off)| format!("{name} is off by {off:.3}")).collect();
                (
                    "inconsistent_velocities",
                    format!("the motions, loops and given rates contradict each other: at best {} (m/s or rad/s); remove one of them, or make them agree", listed.join(", ")),
                    at.as_deref(),
                )
            }
            Self::Penetration(what, hint, at) => ("penetration", format!("{what}; {hint}"), Some(at)),
            Self::SelfLocking(names) => (
                "self_locking",
                format!("at {} no friction force fits the load that it causes; lower the friction", quoted(names)),
                None,
            ),
            Self::Paradox(paradox, reason, at) => {
                let name = match paradox {
                    Paradox::Inconsistent => "painleve_inconsistent",
                    Paradox::Indeterminate => "painleve_indeterminate",
                    Paradox::Unsolved => "contact_unsolved",
                };
                (name, reason.clone(), Some(at))
            }
            Self::UndecidedPress(names, at) => (
                "painleve_indeterminate",
                format!("{names} slide while they press against each other: the balance equations leave open how hard, and the motion depends on it; lower the friction, or let a spring stand for one of them"),
                Some(at),
            ),
            Self::CreatesEnergy(names, energy) => (
                "contact_unsolved",
                format!("to bring {names} to rest on each other would create the energy {energy:.6e} J"),
                None,
            ),
            Self::NoImpulses(names, what, why) => ("no_impact", format!("impulses at {names} that {what}: {why}"), None),
            Self::DrivenTogether(names) => (
                "no_impact",
                format!("prescribed motions drive together what meets at {names}, and nothing between them can yield; end the motion before, or let a spring stand for the contact"),
                None,
            ),
            Self::ImpulsesCreateEnergy(t, energy) => {
                ("no_impact", format!("the impulses found at t = {t:.12} s would create the energy {energy:.6e} J"), None)
            }
            Self::SimultaneousImpact(names, ways) => (
                "simultaneous_impact",
                format!("{names} strike at once, and rigid bodies do not decide what follows: {}; choose a rule, `impacts: newton`, `poisson` or `sequential`", ways.join("; ")),
                None,
            ),
            Self::EndlessImpacts(rounds) => (
                "impact_iteration_limit",
                format!("{rounds} impacts in one instant did not bring it to an end; choose another rule for impacts"),
                None,
            ),
            Self::StringZeroLength(name, at) => (
                "string_zero_length",
                format!("the taut string `{name}` is drawn in until two of its points meet, or one the circle beside it: a little to one side it would swing round at once, straight through it would jerk; let it pass beside, or put a stop before"),
                Some(at),
            ),
            Self::NoAxes(name, [first, second]) => (
                "no_axes",
                format!("`{name}` takes hold of the particles `{first}` and `{second}` at a distance, and neither has axes in which that would turn; join them by a `link`, which keeps the distance"),
                None,
            ),
            Self::StringWoundUp(name, at) => (
                "string_zero_length",
                format!("the string `{name}` is wound up: its free length is zero, and it would be drawn in beyond the rim; end the motion before, or put a stop before"),
                Some(at),
            ),
            Self::Backward => {
                ("backward", "impacts and releases cannot be undone: choose an end after the start".into(), None)
            }
            Self::OutOfRange(t, first, last) => {
                ("out_of_range", format!("t = {t} s is outside the run, {first} s to {last} s"), None)
            }
            Self::NotAnImpact(change) => ("not_an_impact", format!("change {change} of the run is no impact"), None),
            Self::NoImpactDerivative(t) => (
                "no_impact_derivative",
                format!("the impact at t = {t} s follows a law by which its outcome has no derivative that is known; plastic impacts and Newton's restitution do"),
                None,
            ),
            Self::UnknownMethod(name, known) => {
                ("unknown_method", format!("no integrator is called `{name}`; there is {}", known.join(", ")), None)
            }
            Self::UnknownName(what) => ("unknown_name", what.clone(), None),
            Self::WrongQuestion(what) => ("wrong_question", what.clone(), None),
            Self::TooLarge => (
                "too_large",
                "the symbolic equations of this mechanism are too long to be written; ask for fewer, or set symbols to numbers".into(),
                None,
            ),
            Self::FixedPointStalled(t, iterations) => (
                "FixedPointStalled",
                format!("the stages of the step at t = {t} did not converge in {iterations} fixed-point iterations; use a smaller step"),
                None,
            ),
        }
    }
}

impl fmt::Display for DynamicsError {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{}: {}", self.name(), self.sentence())
    }
}

impl std::error::Error for DynamicsError {}

/// What is wrong with a model.
#[derive(Clone, Debug, PartialEq)]
pub struct CompileError {
    /// Where in the model, e.g. `joints.pivot.of`.
    pub path: String,
    /// What is wrong.
    pub what: String,
    /// What to try.
    pub hint: String,
}

impl CompileError {
    pub(crate) fn new(path: impl Into<String>, what: impl Into<String>, hint: impl Into<String>) -> Self {
        CompileError { path: path.into(), what: what.into(), hint: hint.into() }
    }
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}; {}", self.path, self.what, self.hint)
    }
}

impl std::error::Error for CompileError {}
