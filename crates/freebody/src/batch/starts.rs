//! Where many motions start, each with its loops closed.

use super::threads::share_out;
use crate::assembly::{state, AssemblyRequest};
use crate::dynamics::{DynamicsError, Workspace};
use crate::mechanism::Mechanism;

/// What a member of a batch is asked to be at its start: all parameters, and the rest.
pub type Wish = (Vec<f64>, AssemblyRequest);

/// Coordinates and rates of all, or the first that has no start, and why.
pub type Starts = Result<Vec<[Vec<f64>; 2]>, (usize, DynamicsError)>;

/// Coordinates and rates at a time `t` of each of many, by what is wished for it, as [`crate::assembly::assemble`] finds them. `go_on` is asked now and then; None
/// where it answers false.
pub fn starts(
    m: &Mechanism,
    t: f64,
    members: usize,
    wish: &(dyn Fn(usize) -> Wish + Sync),
    threads: usize,
    go_on: &mut dyn FnMut() -> bool,
) -> Option<Starts> {
    let mut found: Vec<_> = (0..members).map(|_| None).collect();
    let begin = || {
        let mut workspace = None;
        move |(member, found): (usize, &mut Option<_>)| {
            let (p, wish) = wish(member);
            let workspace = workspace.get_or_insert_with(|| Workspace::new(m, &p));
            workspace.restart(&p);
            let start = m.check_state(&p, t, &wish.start, &wish.start_rates);
            found.insert(start.and_then(|()| state(workspace, t, &wish))).is_ok()
        }
    };
    let todo = found.iter_mut().enumerate();
    share_out(todo, threads, begin, go_on);
    // They are taken in order: what stands before one that failed was done.
    let each = found.into_iter().enumerate();
    each.map(|(member, found)| found.map(|found| found.map_err(|error| (member, error)))).collect()
}
