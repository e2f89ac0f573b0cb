//! Planar multibody dynamics: from the free-body diagram to the motion.
//!
//! The core knows no files, no clock and no Python. `ARCHITECTURE.md` at the root of the
//! repository is the map.

pub mod expr;
pub mod joints;
pub mod motion;
pub mod plane;
pub mod scalar;
pub mod solve;
pub mod spec;
