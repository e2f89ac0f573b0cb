//! Taylor series of motions: the equations of motion, read once as a flat tape of operations, and the coefficients of their
//! solution order by order (Jorba & Zou, *Experimental Mathematics* 14, 2005; Griewank & Walther, *Evaluating Derivatives*, ch. 13).
//!
//! It knows no mechanics. A formula over [`Scalar`](crate::scalar::Scalar) is [`recorded`] by calling it with [`Traced`] numbers;
//! what comes out is a [`Tape`], valid as long as the formula would be the same operations. [`Solution`] runs it as series, over doubles or
//! [`DoubleDouble`](crate::scalar::DoubleDouble)s, [`Program`] for its values, of many states side by side, [`Alone`] of one, as
//! machine code.

mod alone;
mod lowering;
#[cfg(target_arch = "x86_64")]
mod machine_code;
mod memo;
#[cfg(target_arch = "x86_64")]
mod native;
mod program;
mod recorder;
mod solution;
mod tape;
mod traced;

#[cfg(test)]
mod tests;

pub use alone::Alone;
pub use memo::{Latest, Memo};
pub use program::Program;
pub use solution::{Coefficient, Solution};
pub use tape::Tape;
pub use traced::{recorded, Traced};
