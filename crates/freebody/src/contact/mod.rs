//! What can only push, and what can only pull: contacts, stops and strings.
//!
//! All are one thing, a [`Limit`]: a gauge, its *gap*, that cannot fall below zero. The gap of a contact is the distance of
//! its surfaces, that of a stop what is left of the way, that of a string how much of it is slack. A limit that is reached
//! holds with a force along its gap; a contact may also rub, along its *slide*.
//!
//! Gaps are told piece by piece: an edge or a corner of a polygon, a string wound on its drum or hanging from its
//! attachment. On one piece they are smooth; what leads from one piece to the next is a border.

pub mod complementarity;
mod limit;
mod touch;

pub use limit::Contact;
