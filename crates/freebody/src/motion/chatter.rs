//! Events that come ever more densely.

use super::system::Role;
use std::collections::VecDeque;

/// Time, over the system's own and that of the run, within which events are found: nearer ones are one instant.
const INSTANT: f64 = 1e-12;

/// Whether two times are one instant of a system with its own `time`.
pub(super) fn is_tie(a: f64, b: f64, time: f64) -> bool {
    (a - b).abs() <= INSTANT * (time + b.abs())
}

/// How often one guard may act in a moment: an impact may call for others.
const REPEATS: usize = 8;
/// A moment, over the system's own time, and how many events it may hold: what bounces faster goes nowhere.
const MOMENT: f64 = 1e-9;
const CROWD: usize = 10_000;

/// Guards against events that come ever more densely.
pub(super) struct Chatter {
    /// Times and indices of the events of the last moment.
    recent: VecDeque<(f64, usize)>,
    /// The system's own time, s.
    time: f64,
}

impl Chatter {
    pub fn new(time: f64) -> Self {
        Self { recent: VecDeque::new(), time }
    }

    /// What happened last in the instant of a time.
    pub fn latest(&self, t: f64) -> Option<usize> {
        self.recent.back().filter(|last| is_tie(t, last.0, self.time)).map(|last| last.1)
    }

    /// Whether an event happens twice in one instant, a guard acts again and again in a moment, or that holds too many.
    pub fn is_dense(&mut self, index: usize, role: Role, t: f64) -> bool {
        while self
            .recent
            .front()
            .is_some_and(|first| (t - first.0).abs() > MOMENT * self.time && !is_tie(t, first.0, self.time))
        {
            self.recent.pop_front();
        }
        let repeats =
            |when: &dyn Fn(f64) -> bool| self.recent.iter().filter(|(at, i)| *i == index && when(*at)).count();
        let is_repeated = match role {
            Role::Guard => repeats(&|_| true) >= REPEATS,
            _ => repeats(&|at| is_tie(t, at, self.time)) >= 1,
        };
        self.recent.push_back((t, index));
        self.recent.len() > CROWD || is_repeated
    }
}
