//! The laws of mechanics, stated over the lists of joints, gauges, forces and integrators, and over mechanisms
//! thrown together at random. What is new in a list is tested because it is there.

#![allow(
    clippy::disallowed_methods,
    reason = "closed forms are evaluated by other functions than ours; what is thrown may differ"
)]

mod allocations;
mod arrows;
mod cables;
mod closed_forms;
mod contact_geometry;
mod contacts;
mod derivatives;
mod driven_impacts;
mod free_bodies;
mod gauges;
mod joints;
mod many_loops;
mod metamorphic;
mod model;
mod piles;
mod random;
mod random_cables;
mod random_mechanisms;
mod random_motions;
mod recorded;
mod redundancy;
mod rng;
mod scenes;
mod symbolic;
mod travel;
mod tree_choice;
mod two_definitions;
