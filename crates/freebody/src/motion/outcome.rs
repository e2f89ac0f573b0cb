//! What a run gives back.

use super::dense::Trajectory;
use super::events::{Kind, Unresolved};
use super::system::{DynamicsError, Spent};
use std::fmt;

/// How a run ended. Each names the last good time `t` through [`Run::t`].
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The end time was reached.
    Completed,
    /// An event asked for the end.
    StoppedByEvent {
        /// Index of its switching function.
        index: usize,
    },
    /// The tolerance asks for steps below the resolution of time.
    StepUnderflow,
    /// The number of steps allowed was used up.
    TooManySteps {
        /// The number allowed.
        steps: usize,
    },
    /// A state or a rate became infinite or not a number.
    Overflow,
    /// The relative tolerance is below what the arithmetic can keep, or not a number.
    ToleranceTooTight {
        /// The tolerance asked for.
        rtol: f64,
    },
    /// An explicit method is held at its stability limit and the steps allowed do not suffice.
    StiffSuspected,
    /// The caller asked for the end.
    Interrupted,
    /// The system failed.
    DynamicsError(DynamicsError),
    /// The method cannot do this.
    Unsupported {
        /// Name of the method.
        method: &'static str,
        /// What is missing, to follow "because".
        reason: String,
    },
    /// Events came so densely that the motion no longer advances.
    Chatter {
        /// Index of the switching function that came last.
        index: usize,
    },
}

impl Outcome {
    /// Fixed name of the outcome; that of the failure for [`Outcome::DynamicsError`].
    pub fn name(&self) -> &'static str {
        match self {
            Self::Completed => "Completed",
            Self::StoppedByEvent { .. } => "StoppedByEvent",
            Self::StepUnderflow => "StepUnderflow",
            Self::TooManySteps { .. } => "TooManySteps",
            Self::Overflow => "Overflow",
            Self::ToleranceTooTight { .. } => "ToleranceTooTight",
            Self::StiffSuspected => "StiffSuspected",
            Self::Interrupted => "Interrupted",
            Self::DynamicsError(error) => error.name(),
            Self::Unsupported { .. } => "Unsupported",
            Self::Chatter { .. } => "Chatter",
        }
    }

    /// The item of the model that it is about, e.g. `joints.pivot`, or nothing.
    pub fn path(&self) -> &str {
        match self {
            Self::DynamicsError(error) => error.path().unwrap_or(""),
            _ => "",
        }
    }

    /// Whether the run did what was asked: it reached the end time or a stopping event.
    pub fn is_ok(&self) -> bool {
        matches!(self, Self::Completed | Self::StoppedByEvent { .. })
    }
}

/// One sentence.
impl fmt::Display for Outcome {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Completed => write!(out, "the end time was reached"),
            Self::StoppedByEvent { index } => write!(out, "event {index} ended the run"),
            Self::StepUnderflow => write!(
                out,
                "the tolerance asks for steps below the resolution of time; a singularity or a \
                 jump of the rate may be near"
            ),
            Self::TooManySteps { steps } => write!(out, "all {steps} steps allowed were used"),
            Self::Overflow => write!(out, "the state or its rate stopped being a finite number"),
            Self::ToleranceTooTight { rtol } => {
                write!(out, "rtol = {rtol:e} is not a tolerance that can be kept; 1e-14 is the least")
            }
            Self::StiffSuspected => {
                write!(out, "the system looks stiff and the steps allowed do not suffice; use the method radau")
            }
            Self::Interrupted => write!(out, "the run was interrupted"),
            Self::DynamicsError(error) => write!(out, "{}", error.sentence()),
            Self::Unsupported { method, reason } => {
                write!(out, "{method} cannot do this because {reason}")
            }
            Self::Chatter { index } => write!(
                out,
                "switching function {index} came back within one instant, or 10000 events came in hardly any time: the motion chatters"
            ),
        }
    }
}

/// Something that happened on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct EventRecord {
    /// When.
    pub t: f64,
    /// The state then, before the event acted.
    pub y: Vec<f64>,
    /// Index of the switching function.
    pub index: usize,
    /// Crossing, touch or opening.
    pub kind: Kind,
    /// +1 where the function rises as time grows, −1 where it falls, else 0.
    pub direction: i8,
}

/// A run, complete or not: everything up to [`Run::t`] is good.
#[derive(Clone, Debug)]
pub struct Run {
    /// The motion at all times that were passed.
    pub trajectory: Trajectory,
    /// What happened on the way, in order; discontinuities are only counted.
    pub events: Vec<EventRecord>,
    /// Events that came more often than can be recorded: index, and from when on they are not.
    pub unrecorded: Vec<(usize, f64)>,
    /// What events do by less than the motion is known, each once.
    pub unresolved: Vec<Unresolved>,
    /// Zeros that events have used up where it ended.
    pub spent: Vec<Spent>,
    /// How it ended.
    pub outcome: Outcome,
    /// Last good time.
    pub t: f64,
    /// State then; a run can be continued from (t, y).
    pub y: Vec<f64>,
    /// Number of steps accepted.
    pub accepted: usize,
    /// Number of steps rejected or not possible.
    pub rejected: usize,
    /// Number of evaluations of the rate.
    pub evaluations: usize,
    /// Number of discontinuities passed.
    pub discontinuities: usize,
    /// Largest correction that [`super::System::project`] reported.
    pub largest_correction: f64,
    /// Time at which the system first looked stiff to an explicit method.
    pub stiff_since: Option<f64>,
}
