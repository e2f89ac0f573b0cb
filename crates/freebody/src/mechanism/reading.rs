//! What is recorded of a mechanism.

/// What is read of a motion at a time and a state y = [q, u, states].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reading {
    /// The rate of y; of loops what is left of each inertia and row where it is eliminated; the powers of forces without what their
    /// potentials account for, and of motions.
    Rates,
    /// By what q closes the loops, in first order, and by what u keeps them closed: least in the metric of the masses. Nothing for a tree.
    Corrections,
    /// Accelerations and reactions, in the order of [`crate::dynamics::reaction_names`].
    Solution,
}
