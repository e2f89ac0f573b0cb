//! The pieces of a switching function within a step on which it is monotone.

use super::{EventDetector, CLEAR_OF_ZERO, TOUCH};
use crate::motion::probe::{Node, Probe};
use crate::motion::roots::{chebyshev, extrema, monomial, value, SAMPLES};
use crate::motion::system::DynamicsError;

/// Part of a half step past its end where what crosses zero in it may turn back.
const PAST: f64 = 0.1;
/// A polynomial is trusted when its last coefficients are below this many times its swing,
const CONVERGED: f64 = 1e-9;
/// or below this many times its distance from zero.
const FAR_FROM_ZERO: f64 = 1e-2;
/// A function changes at most this many times as fast as its steepest secant.
const STEEPER: f64 = 1.5;
/// Parabolas by which an extremum is brought nearer.
const PARABOLAS: usize = 3;
/// Values of one function in one step that are asked for beside the samples and extrema.
const PATIENCE: usize = 300;

impl EventDetector {
    /// The samples and, when zero is near, the extrema of the function, in order, until a time is passed: between two
    /// neighbours the function is monotone.
    pub(super) fn nodes(
        &self,
        i: usize,
        values: &[f64; SAMPLES],
        until: f64,
        probe: &mut Probe,
    ) -> Result<Vec<Node>, DynamicsError> {
        let sample = |(&x, &value)| Node { t: probe.time(x), value, is_extremum: false };
        let mut nodes: Vec<Node> = self.points.iter().zip(values).map(sample).collect();
        if is_clear_of_zero(values) {
            return Ok(nodes);
        }
        let coefficients = chebyshev(values);
        let (polynomial, memory) = (monomial(&coefficients), &self.memory[i]);
        let (mut past, mut dip) = (None, 0.0_f64);
        let (t0, later) = (probe.segment.t0, probe.ahead());
        for x in extrema(&polynomial, 1.0 + PAST) {
            let t = probe.time(x);
            if x <= 1.0 {
                let value = probe.one(i, t)?;
                nodes.push(Node { t, value, is_extremum: true });
                if memory.is_guard
                    && value < dip
                    && probe.closed(i, t)?.is_some_and(|value| value > -TOUCH * memory.size)
                {
                    dip = value;
                }
            } else if until.is_infinite()
                && past.is_none()
                && value(&polynomial, x).abs() <= 2.0 * memory.graze.max(memory.doubt).max(TOUCH) * memory.size
            {
                past = Some(Node { t, value: probe.one(i, t)?, is_extremum: true });
            }
            // The first one beyond closes the last interval.
            if later * (t - until) > 0.0 {
                break;
            }
        }
        // What touches zero on the loops may dip below it on the dense output, which is off them.
        nodes.iter_mut().filter(|node| (dip..0.0).contains(&node.value)).for_each(|node| node.value = 0.0);
        nodes.sort_by(|a, b| (later * (a.t - t0)).total_cmp(&(later * (b.t - t0))));
        nodes.truncate(1 + nodes.iter().filter(|node| later * (node.t - until) <= 0.0).count());
        if !is_trusted(&coefficients, nodes.iter().map(|node| node.value)) {
            nodes = self.between(i, &nodes, values, probe)?;
            if !memory.is_guard {
                nodes = turns(i, &nodes, probe)?;
            }
        }
        nodes.extend(past);
        Ok(nodes)
    }

    /// The nodes with further ones wherever the function may reach zero between two and come back. The distance of
    /// things that pass each other is a V, which no polynomial follows; but it changes no faster than they move.
    fn between(
        &self,
        i: usize,
        nodes: &[Node],
        values: &[f64; SAMPLES],
        probe: &mut Probe,
    ) -> Result<Vec<Node>, DynamicsError> {
        let times = self.points.map(|x| probe.time(x));
        let secant = |j: usize| ((values[j + 1] - values[j]) / (times[j + 1] - times[j])).abs();
        let steepest = STEEPER * (0..SAMPLES - 1).map(secant).fold(0.0, f64::max);
        let memory = &self.memory[i];
        let clear = TOUCH * memory.size;
        let mut patience = PATIENCE;
        let mut found = vec![nodes[0]];
        for &node in &nodes[1..] {
            let mut later = vec![node];
            while let Some(&b) = later.last() {
                let a = found[found.len() - 1];
                let same = a.value * b.value > 0.0 && a.value.abs().min(b.value.abs()) > clear;
                let t = 0.5 * (a.t + b.t);
                let near = same && a.value.abs() + b.value.abs() < steepest * (b.t - a.t).abs();
                // It was heading for the other side where it acted.
                let back = memory.is_spent && found.len() == 1 && b.value * f64::from(memory.now.side) < 0.0;
                if !(near || back) || patience == 0 || t == a.t || t == b.t {
                    found.extend(later.pop());
                } else {
                    patience -= 1;
                    later.push(Node { t, value: probe.one(i, t)?, is_extremum: false });
                }
            }
        }
        Ok(found)
    }
}

/// Whether the polynomial through samples cannot reach zero, and is trusted.
pub(super) fn is_clear_of_zero<const N: usize>(values: &[f64; N]) -> bool {
    let is_constant = || values.iter().all(|value| *value == values[0]);
    let is_far = |of: [f64; N]| of[0].abs() > CLEAR_OF_ZERO * swing(&of) && is_trusted(&of, values.iter().copied());
    is_constant() || is_far(chebyshev(values))
}

/// Whether a function of which these are values follows its polynomial.
fn is_trusted<const N: usize>(coefficients: &[f64; N], values: impl Iterator<Item = f64>) -> bool {
    let tail = coefficients[N - 2].abs() + coefficients[N - 1].abs();
    let nearest = values.fold(f64::INFINITY, |least, value| least.min(value.abs()));
    tail <= CONVERGED * swing(coefficients) || tail <= FAR_FROM_ZERO * nearest
}

/// How far a polynomial is from its mean at most.
fn swing(coefficients: &[f64]) -> f64 {
    coefficients[1..].iter().map(|c| c.abs()).sum()
}

/// The nodes of function `i` with its extrema as they are themselves, not as those of a polynomial that does not follow it: each node
/// beyond both of its neighbours, brought nearer by parabolas.
fn turns(i: usize, nodes: &[Node], probe: &mut Probe) -> Result<Vec<Node>, DynamicsError> {
    let mut found = nodes.to_vec();
    for k in 1..nodes.len() - 1 {
        let [mut a, mut b, mut c] = [nodes[k - 1], nodes[k], nodes[k + 1]];
        b.is_extremum = (b.value - a.value) * (b.value - c.value) > 0.0;
        for _ in 0..if b.is_extremum { PARABOLAS } else { 0 } {
            let (left, right) = ((b.value - a.value) / (b.t - a.t), (c.value - b.value) / (c.t - b.t));
            let t = 0.5 * (a.t + b.t - left * (c.t - a.t) / (right - left));
            let node = Node { t, value: probe.one(i, t)?, is_extremum: true };
            let (is_farther, is_later) = ((node.value - b.value) * left > 0.0, (t - b.t) * (c.t - b.t) > 0.0);
            match (is_farther, is_later) {
                (true, true) => (a, b) = (b, node),
                (true, false) => (b, c) = (node, b),
                (false, true) => c = node,
                (false, false) => a = node,
            }
            if !(t != b.t || is_farther) || a.t == b.t || b.t == c.t {
                break;
            }
        }
        found[k] = b;
    }
    Ok(found)
}
