//! Integration of motions in time: methods, step control, dense output, events.
//!
//! Knows no mechanics: it moves an abstract [`System`]. A method is a table and a citation, one
//! entry of [`METHODS`] and one file. [`run()`] is the only way in.

mod adaptive_lanes;
mod chatter;
mod collocation;
mod dense;
mod dop853;
mod event_location;
mod events;
mod explicit;
mod gauss6;
mod linear;
mod march;
mod method;
mod norm;
mod outcome;
mod probe;
mod radau;
mod rk4;
mod roots;
mod run;
mod step_control;
mod system;
mod taylor;
#[cfg(test)]
mod tests;
mod tsit5;

pub use adaptive_lanes::{integrate_lanes, Interval, LaneSystem};
pub use dense::{Segment, Trajectory};
pub use events::{Doubt, Kind, Unresolved};
pub use march::{march, Span};
pub use method::Method;
pub use outcome::{EventRecord, Outcome, Run};
pub use run::{run, Options, TIGHTEST};
pub use system::{After, Analytic, Canonical, DynamicsError, EventSpec, Role, Spent, System};

/// All methods; the first one is the default.
pub const METHODS: &[&Method] =
    &[&dop853::METHOD, &tsit5::METHOD, &radau::METHOD, &taylor::METHOD, &gauss6::METHOD, &rk4::METHOD];

/// The method called `name`.
pub fn method(name: &str) -> Option<&'static Method> {
    METHODS.iter().copied().find(|method| method.name == name)
}
