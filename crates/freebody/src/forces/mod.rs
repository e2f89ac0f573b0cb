//! The forces. One is a card and a lowering to *pulls* (a law on a gauge) and *pushes* (a load in a
//! direction, fixed or following a body), with its potential if it has one.
//!
//! To add a force: write its file, and add one line to the list below. How it loads the bodies, its
//! power, its work and its place in the ledger follow.

mod force;
mod law;
mod spring;
mod torque;

use crate::compile::{CompileError, Fields};
use crate::gauges::Law;
use crate::joints::Card;

/// A force, compiled.
#[derive(Clone, Debug, Default)]
pub struct Force {
    /// Name.
    pub name: String,
    /// Its word in the list.
    pub word: &'static str,
    /// Laws on gauges.
    pub pulls: Vec<Pull>,
    /// Loads in a direction.
    pub pushes: Vec<Push>,
    /// Its potential energy, J; a force without one accounts for its work.
    pub potential: Option<Law>,
}

impl Force {
    /// Whether its law has cases, like `max` or `if`.
    pub fn has_cases(&self) -> bool {
        let pulls = self.pulls.iter().map(|pull| &pull.value);
        pulls.chain(self.pushes.iter().flat_map(|push| [&push.x, &push.y])).any(|law| law.kinks().next().is_some())
    }
}

/// A force that acts to increase a gauge.
#[derive(Clone, Debug)]
pub struct Pull {
    /// The gauge.
    pub gauge: Law,
    /// How strongly, N for a length and N·m for an angle.
    pub value: Law,
    /// The bodies on which the gauge depends.
    pub bodies: Vec<usize>,
}

/// A force at a point.
#[derive(Clone, Debug)]
pub struct Push {
    /// The site at which it acts.
    pub site: usize,
    /// Component along x, N.
    pub x: Law,
    /// Component along y, N.
    pub y: Law,
    /// Whether x and y are the body's axes.
    pub with_body: bool,
}

/// The contract of a force.
pub trait ForceKind {
    /// Names and fields.
    fn card(&self) -> Card;
    /// Its pulls, pushes and potential, from the fields of the model.
    fn lower(&self, fields: &mut Fields) -> Result<Force, CompileError>;
}

macro_rules! list {
    ($($module:ident :: $Force:ident),* $(,)?) => {
        /// Every force there is.
        pub const ALL: &[&(dyn ForceKind + Sync)] = &[$(&$module::$Force),*];
    };
}

list! {
    force::AtPoint,
    torque::Torque,
    torque::TorsionSpring,
    spring::Spring,
    spring::Damper,
    law::General,
}

/// The force of a given word.
pub fn named(word: &str) -> Option<&'static (dyn ForceKind + Sync)> {
    ALL.iter().copied().find(|f| f.card().word == word)
}

impl Force {
    /// A law on a gauge.
    pub fn pulling(gauge: Law, value: Law, potential: Option<Law>) -> Self {
        Force { pulls: vec![Pull { gauge, value, bodies: vec![] }], potential, ..Force::default() }
    }
    /// The laws that it evaluates.
    pub fn laws(&self) -> impl Iterator<Item = &Law> {
        let pulls = self.pulls.iter().flat_map(|p| [&p.gauge, &p.value]);
        pulls.chain(self.pushes.iter().flat_map(|p| [&p.x, &p.y])).chain(&self.potential)
    }
}
