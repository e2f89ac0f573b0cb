//! What is watched for during a motion.

use super::Part;
use crate::expr::Condition;
use crate::gauges::{ModelExpr, ModelVariable};

/// A place where a law or a curve is not smooth: the zero of a function of the state.
#[derive(Clone, Debug)]
pub enum Discontinuity {
    /// A switch of a law, by its identifier; its arm is frozen between the discontinuities.
    Switch(usize, ModelExpr),
    /// A table, and its argument at one of its points; of a periodic table also at what repeats it.
    Knot(usize, ModelExpr, f64),
    /// A switch in the description of the curve of a joint, by its identifier; its arm is never frozen.
    Bend(usize, ModelExpr),
}

/// Something to watch for.
#[derive(Clone, Debug)]
pub struct Event {
    /// Name.
    pub name: String,
    /// Its zero is the event.
    pub when: ModelExpr,
    /// +1, −1 or 0.
    pub direction: i8,
    /// Armed only while this holds.
    pub condition: Option<Condition<ModelVariable>>,
    /// It happens at the start, before anything moves.
    pub opening: bool,
    /// A value below 0 is the event, too, where the motion starts or starts afresh.
    pub guard: bool,
    /// What happens then, besides being recorded.
    pub then: Vec<EventAction>,
}

/// What an event does.
#[derive(Clone, Debug)]
pub enum EventAction {
    /// End the run.
    Stop,
    /// Give a parameter the value of an expression.
    Set(usize, ModelExpr),
    /// Take a part away.
    Release(Part),
    /// Put a part in place; what does not fit at once comes together with a plastic impact.
    Engage(Part),
    /// Give a gauge a rate at once, with the least change of momentum.
    Reset {
        /// The gauge in its user's words.
        gauge: String,
        /// The gauge.
        of: ModelExpr,
        /// Its rate.
        rate: ModelExpr,
    },
}

impl Event {
    /// What is read of the motion to see whether it happens.
    pub fn watched(&self) -> impl Iterator<Item = &ModelExpr> {
        [&self.when].into_iter().chain(self.condition.as_ref().map(Condition::as_expr))
    }
}

impl EventAction {
    /// What is read of the motion where it acts.
    pub fn law(&self) -> Option<&ModelExpr> {
        match self {
            EventAction::Set(_, law) | EventAction::Reset { rate: law, .. } => Some(law),
            EventAction::Stop | EventAction::Release(_) | EventAction::Engage(_) => None,
        }
    }
}
