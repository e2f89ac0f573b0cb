//! Where many motions start, each with its loops closed.

use super::threads::share_out;
use crate::assembly::{state, AssemblyRequest};
use crate::dynamics::{DynamicsError, Workspace};
use crate::mechanism::Mechanism;

/// What a member of a batch is asked to be at its start: all parameters, and the rest.
pub type Wish = (Vec<f64>, AssemblyRequest);

/// Coordinates and rates of all, or the first that has no start, and why.
pub type Starts = Result<Vec<[Vec<f64>; 2]>, (usize, DynamicsError)>;

/// Coordinates and rates at a time `t` of each of many, as [`crate::assembly::assemble`] finds them. `go_on` is asked now and then; None
/// where it answers false.
pub fn starts(
    m: &Mechanism,
    t: f64,
    wishes: &[Wish],
    threads: usize,
    go_on: &mut dyn FnMut() -> bool,
) -> Option<Starts> {
    let mut found: Vec<_> = wishes.iter().map(|_| None).collect();
    let start = |(p, wish): &Wish| {
        m.check_state(p, t, &wish.start, &wish.start_rates)?;
        state(&mut Workspace::new(m, p), t, wish)
    };
    let todo = wishes.iter().zip(&mut found);
    let begin = || |(wish, found): (&Wish, &mut Option<_>)| found.insert(start(wish)).is_ok();
    share_out(todo, threads, begin, go_on);
    // They are taken in order: what stands before one that failed was done.
    let each = found.into_iter().enumerate();
    each.map(|(member, found)| found.map(|found| found.map_err(|error| (member, error)))).collect()
}
