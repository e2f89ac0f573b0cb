//! Touches that push and rub but do not pull.

pub mod complementarity;
