//! A solved instant, over any scalar. What is read of it stands with its kind: reactions and drives in `reactions.rs`, contacts
//! in `contact_forces.rs`, friction in `joint_friction.rs`, whatever an expression asks for in `instant.rs`.

use super::{Row, Workspace};
use crate::kinematics::StateView;
use crate::plane::Wrench;

/// A state with what was found for it.
#[derive(Clone, Copy)]
pub struct SolvedView<'a, S = f64> {
    /// The state.
    pub at: StateView<'a, S>,
    /// The load that each body's joint in the tree puts on it, at its joint origin.
    pub joint_wrenches: &'a [Wrench<S>],
    /// The closing rows.
    pub rows: &'a [Row<S>],
    /// Their multipliers.
    pub lambda: &'a [S],
    /// Friction of each joint that slides, along its coordinate.
    pub sliding_friction: &'a [S],
    /// Characteristic length of the mechanism, m.
    pub length: f64,
}

impl Workspace<'_> {
    /// The last solution, as what is read of it.
    pub fn solved_view(&self) -> SolvedView<'_> {
        SolvedView {
            at: self.at(),
            joint_wrenches: &self.solved.joint_wrenches,
            rows: &self.rows,
            lambda: &self.solved.lambda,
            sliding_friction: &self.joint_friction_forces,
            length: self.length,
        }
    }
}
