//! Events that come ever more densely.

use super::system::Role;

/// Time, over the system's own and that of the run, within which events are found: nearer ones are one instant.
const INSTANT: f64 = 1e-12;

/// Whether two times are one instant of a system with its own `time`.
pub(super) fn is_tie(a: f64, b: f64, time: f64) -> bool {
    (a - b).abs() <= INSTANT * (time + b.abs())
}

/// How often one guard may act in one instant: an impact may call for others.
const REPEATS: usize = 8;
/// How many events may happen within a time over the system's own: what bounces faster goes nowhere.
const CROWD: (usize, f64) = (10_000, 1e-9);

/// Guards against events that come ever more densely.
pub(super) struct Chatter {
    since: f64,
    /// Indices of the events of this instant, and their time.
    instant: (f64, Vec<usize>),
    count: usize,
    /// The system's own time, s.
    time: f64,
}

impl Chatter {
    pub fn new(t: f64, time: f64) -> Self {
        Self { since: t, instant: (t, Vec::new()), count: 0, time }
    }

    /// What happened last in the instant of a time.
    pub fn latest(&self, t: f64) -> Option<usize> {
        self.instant.1.last().copied().filter(|_| is_tie(t, self.instant.0, self.time))
    }

    /// Whether an event happens twice in one instant, a guard does so again and again, or too many come in a short time.
    pub fn is_dense(&mut self, index: usize, role: Role, t: f64) -> bool {
        if !is_tie(t, self.instant.0, self.time) {
            self.instant = (t, Vec::new());
        }
        if (t - self.since).abs() > CROWD.1 * self.time {
            (self.since, self.count) = (t, 0);
        }
        self.count += 1;
        let before = self.instant.1.iter().filter(|&&i| i == index).count();
        self.instant.1.push(index);
        self.count > CROWD.0 || before >= if role == Role::Guard { REPEATS } else { 1 }
    }
}
