//! The forces. One is a card and a lowering to *pulls* (a law on a gauge) and *pushes* (a load in a
//! direction, fixed or following a body), with its potential if it has one.
//!
//! To add a force: write its file, and add one line to the list below. How it loads the bodies, its
//! power, its work and its place in the ledger follow.

mod force;
mod law;
mod plate_friction;
mod spring;
mod table_friction;
mod torque;

use crate::builder::Fields;
use crate::error::CompileError;
use crate::joints::Card;
use crate::mechanism::Force;

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
    table_friction::TableFriction,
    plate_friction::PlateFriction,
}

/// The force of a given word.
pub fn named(word: &str) -> Option<&'static (dyn ForceKind + Sync)> {
    ALL.iter().copied().find(|f| f.card().word == word)
}
