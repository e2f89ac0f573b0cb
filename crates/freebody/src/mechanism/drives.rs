//! Couplings, prescribed motions and locks.

use crate::gauges::ModelExpr;

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

/// What a row on gauges is in the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveKind {
    /// A prescribed motion.
    Motion,
    /// A coupling, one of the joints.
    Coupling,
    /// What holds a massless body on its curve once its pin is released.
    Hold,
    /// A gauge that an event locks.
    Lock,
}

impl DriveKind {
    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            DriveKind::Motion => "motion",
            DriveKind::Coupling => "coupling",
            DriveKind::Hold => "hold",
            DriveKind::Lock => "lock",
        }
    }
}

/// A coupling, a prescribed motion or a lock: one row on gauges.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name.
    pub name: String,
    /// What it is in the model.
    pub kind: DriveKind,
    /// The gauge whose motion is given.
    pub of: ModelExpr,
    /// What it is given to be.
    pub law: ModelExpr,
    /// At which level.
    pub level: Level,
    /// The gauge along which the force acts, when it is another one.
    pub by: Option<ModelExpr>,
    /// Whether the law reads the state.
    pub feedback: bool,
}

/// The gauges of a drive's row, each with the bodies on which it depends, ground left out.
#[derive(Clone, Debug)]
pub struct DriveGauges {
    /// What is held: less its law, where places are given.
    pub motion: (ModelExpr, Vec<usize>),
    /// That along which the force acts, where it is another one.
    pub force: Option<(ModelExpr, Vec<usize>)>,
}

impl Drive {
    /// The gauges of its row.
    pub(crate) fn gauges(&self, bodies_of: impl Fn(&ModelExpr) -> Vec<usize>) -> DriveGauges {
        let with_bodies = |gauge: ModelExpr| (gauge.clone(), bodies_of(&gauge));
        let held = match self.level {
            Level::Position => self.of.clone() - self.law.clone(),
            Level::Velocity | Level::Acceleration => self.of.clone(),
        };
        let own_way = self.by.is_some() || (self.feedback && self.level == Level::Position && self.is_motion());
        DriveGauges { motion: with_bodies(held), force: own_way.then(|| with_bodies(self.along().clone())) }
    }
    /// Whether it is a prescribed motion.
    pub fn is_motion(&self) -> bool {
        self.kind == DriveKind::Motion
    }
    /// The gauge along which its force acts.
    pub fn along(&self) -> &ModelExpr {
        self.by.as_ref().unwrap_or(&self.of)
    }
}
