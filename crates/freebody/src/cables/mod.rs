//! Strings: inextensible, without mass, pulling only; over eyelets and pulleys, wound on drums.
//!
//! A string is expressed as circles and points that it touches in turn (`tangent.rs`), laid out at one configuration
//! (`layout.rs`). How its ends are wound (`winding.rs`) is the feature on which its slack is measured.

mod cable;
mod initial_winding;
mod layout;
mod outline;
mod tangent;
mod winding;

pub use cable::Straight;
pub use outline::{Outline, Stretch};
pub use winding::{Winding, WrapState};
