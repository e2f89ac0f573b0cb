//! The motion between the steps.

/// The solution over one step.
///
/// Every dense output here is the cubic Hermite interpolant plus θ²(1−θ)² times a polynomial,
/// written as in HNW I, II.6: with θ = (t−t0)/(t1−t0),
/// y = y0 + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))).
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Time at which the step starts.
    pub t0: f64,
    /// Time at which it ends; less than `t0` when the run goes backward.
    pub t1: f64,
    /// How many components there are.
    n: usize,
    /// y0, y1, F₁, F₂, … one after the other; F₀ = y1 − y0.
    values: Vec<f64>,
}

impl Segment {
    /// The cubic with the values `y0`, `y1` and the slopes `slope0`, `slope1` (dy/dt) at its ends, with room for that many further F.
    pub(super) fn hermite(
        (t0, y0, slope0): (f64, &[f64], &[f64]),
        (t1, y1, slope1): (f64, &[f64], &[f64]),
        more: usize,
    ) -> Self {
        let n = y0.len();
        let mut values = Vec::with_capacity((4 + more) * n);
        values.extend_from_slice(y0);
        values.extend_from_slice(y1);
        values.resize(4 * n, 0.0);
        for i in 0..n {
            [values[2 * n + i], values[3 * n + i]] = cubic(t1 - t0, [y0[i], y1[i]], [slope0[i], slope1[i]]);
        }
        Self { t0, t1, n, values }
    }

    /// Adds the next F, replacing those beyond `index` (F₃ has index 3): of all components, one row or more, or of the first, with 0 for
    /// the others.
    pub(super) fn bend(&mut self, index: usize, values: impl Iterator<Item = f64>) {
        self.values.truncate((index + 1) * self.n);
        self.values.extend(values);
        self.values.resize(self.values.len().next_multiple_of(self.n), 0.0);
    }

    /// Writes the state at time `t`; exact at both ends.
    pub fn at(&self, t: f64, y: &mut [f64]) {
        if t == self.t1 {
            y.copy_from_slice(self.end());
            return;
        }
        let theta = (t - self.t0) / (self.t1 - self.t0);
        for (i, value) in y.iter_mut().enumerate() {
            let [y0, y1] = [self.start()[i], self.end()[i]];
            let bends = self.values[2 * self.n..].chunks_exact(self.n).map(|bends| bends[i]);
            *value = between(theta, [y0, y1], bends);
        }
    }

    /// Component `i` in the middle of the step, and how far it goes from there at most: by the first two of three parts, each times a
    /// factor from −1 to 1 that is the same for all components, and by no more than the third. For θᵃ(1−θ)ᵇ, with a = b or b + 1, is
    /// from 0 to below twice its value 2⁻ᵃ⁻ᵇ at the middle.
    pub fn about_middle(&self, i: usize) -> (f64, [f64; 3]) {
        let [first, second] = [0.5 * (self.end()[i] - self.start()[i]), 0.25 * self.values[2 * self.n + i]];
        let (mut middle, mut rest, mut half) = (self.start()[i] + first + second, 0.0, 0.25);
        for bend in self.values[3 * self.n + i..].iter().step_by(self.n) {
            half *= 0.5;
            middle += half * bend;
            rest += (half * bend).abs();
        }
        (middle, [first, second, rest])
    }

    /// State at the start of the step.
    pub fn start(&self) -> &[f64] {
        &self.values[..self.n]
    }

    /// State at the end of the step.
    pub fn end(&self) -> &[f64] {
        &self.values[self.n..2 * self.n]
    }

    fn spans(&self, t: f64) -> bool {
        (t - self.t0) * (t - self.t1) <= 0.0
    }
}

/// F₁ and F₂ of the cubic over a time with these values and slopes at its ends.
#[inline(always)]
pub(super) fn cubic(h: f64, [y0, y1]: [f64; 2], [slope0, slope1]: [f64; 2]) -> [f64; 2] {
    let rise = y1 - y0;
    [slope0 * h - rise, rise * 2.0 - (slope0 + slope1) * h]
}

/// The value at θ between those at the ends, with F₁, F₂, ….
#[inline(always)]
pub(super) fn between(
    theta: f64,
    [y0, y1]: [f64; 2],
    bends: impl DoubleEndedIterator<Item = f64> + ExactSizeIterator,
) -> f64 {
    let factor = |k: usize| if k.is_multiple_of(2) { 1.0 - theta } else { theta };
    let sum = bends.enumerate().rev().fold(0.0, |sum, (k, bend)| (sum + bend) * factor(k));
    y0 + (y1 - y0 + sum) * theta
}

/// The solution over a run, step after step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// One segment per accepted step, in the order of the run.
    pub segments: Vec<Segment>,
}

impl Trajectory {
    /// Writes the state at time `t`; false, and `y` untouched, when the run did not pass there.
    ///
    /// Where an event made the state jump, this is the state after the jump.
    pub fn at(&self, t: f64, y: &mut [f64]) -> bool {
        let joint_wrenches = self.segments.partition_point(|s| (t - s.t0) * (s.t1 - s.t0) >= 0.0);
        match self.segments[..joint_wrenches].last() {
            Some(segment) if segment.spans(t) => {
                segment.at(t, y);
                true
            }
            _ => false,
        }
    }
}
