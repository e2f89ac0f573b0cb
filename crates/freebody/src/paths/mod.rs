//! Strings: inextensible, without mass, pulling only; over eyelets and pulleys, wound on drums.

mod cord;

pub use cord::{Cord, End, Guide};
