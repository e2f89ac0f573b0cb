//! Forces as compiled: laws on gauges and loads in a direction.

use crate::gauges::Law;
use crate::joints::LoadCard;

/// A force, compiled.
#[derive(Clone, Debug, Default)]
pub struct Force {
    /// Name.
    pub name: String,
    /// Its word in the list.
    pub word: &'static str,
    /// Laws on gauges.
    pub pulls: Vec<Pull>,
    /// Loads in a direction.
    pub pushes: Vec<Push>,
    /// The potential energy of its conservative pulls, J; the work of all else is accounted for.
    pub potential: Option<Law>,
    /// What each of its pulls and pushes is, in this order.
    pub cards: Vec<LoadCard>,
}

impl Force {
    /// A law on a gauge.
    pub fn pulling(gauge: Law, value: Law, potential: Option<Law>) -> Self {
        let conservative = potential.is_some();
        Force { pulls: vec![Pull { gauge, value, bodies: vec![], conservative }], potential, ..Force::default() }
    }
    /// The laws that it evaluates.
    pub fn laws(&self) -> impl Iterator<Item = &Law> {
        let pulls = self.pulls.iter().flat_map(|p| [&p.gauge, &p.value]);
        pulls.chain(self.pushes.iter().flat_map(|p| [&p.x, &p.y])).chain(&self.potential)
    }
    /// Whether its potential accounts for all its work.
    pub fn is_conservative(&self) -> bool {
        self.pushes.is_empty() && self.pulls.iter().all(|pull| pull.conservative)
    }
    /// Whether its law has cases, like `max` or `if`.
    pub fn has_cases(&self) -> bool {
        let pulls = self.pulls.iter().map(|pull| &pull.value);
        pulls.chain(self.pushes.iter().flat_map(|push| [&push.x, &push.y])).any(|law| law.kinks().next().is_some())
    }
}

/// A force that acts to increase a gauge.
#[derive(Clone, Debug)]
pub struct Pull {
    /// The gauge.
    pub gauge: Law,
    /// How strongly, N for a length and N·m for an angle.
    pub value: Law,
    /// The bodies on which the gauge depends.
    pub bodies: Vec<usize>,
    /// Whether the potential of its force accounts for its work.
    pub conservative: bool,
}

/// A force at a point.
#[derive(Clone, Debug)]
pub struct Push {
    /// The site at which it acts.
    pub site: usize,
    /// Component along x, N.
    pub x: Law,
    /// Component along y, N.
    pub y: Law,
    /// Whether x and y are the body's axes.
    pub with_body: bool,
}
