//! What can only push, and what can only pull: contacts, stops and strings.
//!
//! All are one thing, a [`UnilateralConstraint`]: a gauge, its *gap*, that cannot fall below zero. The gap of a contact
//! is the distance of its surfaces, that of a stop what is left of the way, that of a string how much of it is slack. A
//! unilateral constraint that is reached holds with a force along its gap; a contact may also have friction, along its
//! *slide*.
//!
//! Gaps are measured feature by feature: an edge or a corner of a polygon, a string wound on its drum or hanging from its
//! attachment. On one feature they are smooth; what leads from one feature to the next is a border.

pub mod complementarity;
mod geometry;
mod unilateral;

pub use unilateral::Contact;
