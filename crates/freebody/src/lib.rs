//! Planar multibody dynamics: from the free-body diagram to the motion.
//!
//! The core knows no files, no clock and no Python. `ARCHITECTURE.md` at the root of the
//! repository is the map.

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests compare with other functions than ours"))]

pub mod algebra;
pub mod assembly;
pub mod batch;
pub mod benchmark;
pub mod bound_values;
pub mod builder;
pub mod cables;
pub mod compile;
pub mod contact;
pub mod dynamics;
pub mod error;
pub mod expr;
pub mod forces;
pub mod free_bodies;
pub mod gauges;
pub mod graph;
pub mod hybrid;
pub mod initial;
pub mod joints;
pub mod kinematics;
pub mod mechanism;
pub mod metadata;
pub mod mode;
pub mod motion;
pub mod plane;
pub mod scalar;
pub mod series;
pub mod shapes;
pub mod solve;
pub mod spec;
pub mod symbolic;
