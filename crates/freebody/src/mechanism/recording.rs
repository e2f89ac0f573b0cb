//! What is recorded of a mechanism.

/// A function of the time and the state y = [q, u, states] of a motion, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Recording {
    /// The rate of y; of loops what is left of each inertia and row where it is eliminated; the powers of forces without what their
    /// potentials account for, and of motions.
    Rates,
    /// The changes of q that close the loops, in first order, and of u that keep them closed: the least ones in the metric of the mass
    /// matrix. Nothing for a tree.
    Corrections,
    /// Accelerations and reactions, in the order of [`crate::dynamics::reaction_names`].
    Solution,
}
