//! Switching functions along a step.

use super::dense::Segment;
use super::roots::bracketed;
use super::system::{DynamicsError, System};
use std::collections::hash_map::{Entry, HashMap};

/// Parts of a step over which a rate is taken: the least whose change stands out of round-off by this much.
const SLOPE_REACHES: [f64; 4] = [1e-4, 1e-3, 1e-2, 1e-1];
const STANDS_OUT: f64 = 100.0;

/// A point of a segment with the value of a switching function there.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub t: f64,
    pub value: f64,
    pub is_extremum: bool,
}

/// Evaluates switching functions along a segment.
pub(super) struct Probe<'a> {
    pub system: &'a mut dyn System,
    pub segment: &'a Segment,
    /// Functions that are found together.
    together: &'a [usize],
    y: Vec<f64>,
    /// Values by the bits of their time, and by whether they are of the functions found together: many functions are bisected at the
    /// same times.
    known: HashMap<(u64, bool), Vec<f64>>,
}

impl<'a> Probe<'a> {
    /// Along a segment, for functions that are found `together`, those aside that are found by themselves.
    pub fn new(system: &'a mut dyn System, segment: &'a Segment, together: &'a [usize]) -> Self {
        let y = vec![0.0; system.dim()];
        Self { system, segment, together, y, known: HashMap::new() }
    }

    /// Takes the values of all functions at a time as known.
    pub fn know(&mut self, t: f64, values: &[f64]) {
        self.known.extend([false, true].map(|is_together| ((t.to_bits(), is_together), values.to_vec())));
    }

    /// Time at `x` in [−1, 1].
    pub fn time(&self, x: f64) -> f64 {
        match x {
            1.0 => self.segment.t1,
            _ => self.segment.t0 + 0.5 * (1.0 + x) * (self.segment.t1 - self.segment.t0),
        }
    }

    fn length(&self) -> f64 {
        (self.segment.t1 - self.segment.t0).abs()
    }

    pub fn ahead(&self) -> f64 {
        (self.segment.t1 - self.segment.t0).signum()
    }

    /// The values at a time, of which only those of the functions `of` have a meaning; these are all found together, or none of them is.
    pub fn values(&mut self, of: &[usize], t: f64) -> Result<&[f64], DynamicsError> {
        let is_together = of.first().is_some_and(|i| self.together.contains(i));
        match self.known.entry((t.to_bits(), is_together)) {
            Entry::Occupied(values) => Ok(values.into_mut()),
            Entry::Vacant(place) => {
                let mut values = vec![0.0; self.system.switches()];
                self.segment.at(t, &mut self.y);
                let of = if is_together { self.together } else { of };
                self.system.watched_values(t, &self.y, of, &mut values)?;
                Ok(place.insert(values))
            }
        }
    }

    pub fn one(&mut self, i: usize, t: f64) -> Result<f64, DynamicsError> {
        self.segment.at(t, &mut self.y);
        match self.system.switch_value(i, t, &self.y)? {
            Some(value) => Ok(value),
            None => Ok(self.values(&[i], t)?[i]),
        }
    }

    /// The same on the invariants, which a dense output leaves.
    pub fn closed(&mut self, i: usize, t: f64) -> Result<Option<f64>, DynamicsError> {
        self.segment.at(t, &mut self.y);
        self.system.switch_value_closed(i, t, &self.y)
    }

    /// Whether function `i` is another at time `t` with the state that the segment has at its start.
    pub fn depends_on_state(&mut self, i: usize, t: f64) -> Result<bool, DynamicsError> {
        let (mut here, mut there) = (vec![0.0; self.system.switches()], vec![0.0; self.system.switches()]);
        self.segment.at(t, &mut self.y);
        self.system.switch_values(t, &self.y, &mut here)?;
        self.segment.at(self.segment.t0, &mut self.y);
        self.system.switch_values(t, &self.y, &mut there)?;
        Ok(here[i] != there[i])
    }

    /// Where function `i`, shifted, changes its sign between two nodes, by the first of the `shifts` with which it does: where it
    /// has the sign of `b` at `a` already, though within its noise, it leaves the noise.
    pub fn root(&mut self, i: usize, a: Node, b: Node, shifts: [f64; 2]) -> Result<f64, DynamicsError> {
        let is_bracket = |shift: f64| a.value + shift != 0.0 && (a.value + shift < 0.0) != (b.value + shift < 0.0);
        match shifts.into_iter().find(|&shift| is_bracket(shift)) {
            Some(shift) => bracketed(|t| Ok(self.one(i, t)? + shift), (a.t, a.value + shift), (b.t, b.value + shift)),
            None => Ok(a.t),
        }
    }

    /// Rate of switching function `i` at time `t`, whose values are known to a `noise`.
    pub fn slope(&mut self, i: usize, t: f64, noise: f64) -> Result<f64, DynamicsError> {
        let (low, high) =
            if self.ahead() > 0.0 { (self.segment.t0, self.segment.t1) } else { (self.segment.t1, self.segment.t0) };
        let (mut change, mut time) = (0.0, 1.0);
        for reach in SLOPE_REACHES.map(|part| part * self.length()) {
            let (a, b) = ((t - reach).max(low), (t + reach).min(high));
            (change, time) = (self.one(i, b)? - self.one(i, a)?, b - a);
            if change.abs() > STANDS_OUT * noise {
                break;
            }
        }
        Ok(change / time)
    }
}
