//! The Taylor series of the solution itself.

use super::dense::Segment;
use super::method::{all_finite, Counted, Failure, Method, Point, Stepper};
use super::norm::{measure, Norm};
use crate::scalar::real;

/// Jorba & Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*, Experimental
/// Mathematics 14 (2005). The order is theirs for a tolerance of 1e-20 at all tolerances: products of series are summed side by side, so
/// that a step costs less than the square of the order, and a higher one is faster.
pub(super) const METHOD: Method = Method {
    name: "taylor",
    citation: "Jorba & Zou, Experimental Mathematics 14 (2005) 99-117",
    order: ORDER as u32,
    dense_order: ORDER as u32,
    estimate_order: Some(ORDER as u32),
    symplectic: false,
    analytic: true,
    implicit: false,
    stage_gap: 0.5,
    stepper: |n| Box::new(Taylor::new(n)),
};

const ORDER: usize = 24;
/// Part of the step at which the last term is the tolerance, since terms beyond are left out: theirs, e^(−0.7/(order − 1)).
const SAFETY: f64 = 0.97;
/// Components whose series are divided side by side.
const SIDE: usize = 4;

struct Taylor {
    /// Where the series begins; none before the first step.
    from: Option<(f64, Vec<f64>)>,
    /// Coefficients of each component, one after the other.
    coefficients: Vec<f64>,
    weights: Vec<f64>,
    terms: Vec<f64>,
}

impl Taylor {
    fn new(n: usize) -> Self {
        let zeros = vec![0.0; n];
        Self { from: None, coefficients: vec![0.0; n * (ORDER + 1)], weights: zeros.clone(), terms: zeros }
    }

    fn of(&self, i: usize) -> &[f64] {
        &self.coefficients[i * (ORDER + 1)..(i + 1) * (ORDER + 1)]
    }

    fn expand(&mut self, system: &mut Counted, from: &Point) -> Result<(), Failure> {
        if self.from.as_ref().is_some_and(|(t, y)| *t == from.t && *y == from.y) {
            return Ok(());
        }
        self.from = None;
        system.evaluations += 1;
        let analytic = system.system.analytic().expect("checked when the run starts");
        analytic.expand(from.t, &from.y, ORDER, &mut self.coefficients)?;
        all_finite(&self.coefficients)?;
        self.from = Some((from.t, from.y.clone()));
        Ok(())
    }

    /// The step by which the last two terms are as large as is tolerated, where components are as large as they get in `within`.
    fn tolerated_step(&mut self, norm: &Norm, within: f64) -> f64 {
        for i in 0..self.weights.len() {
            let of = self.of(i);
            let terms = if within > 0.0 { &of[1..] } else { &[] };
            let reached = terms.iter().rev().fold(0.0, |sum, c| (sum + c.abs()) * within);
            self.weights[i] = norm.tolerated(i, of[0].abs(), reached);
        }
        let mut exponent = f64::INFINITY;
        for k in [ORDER - 1, ORDER] {
            for i in 0..self.terms.len() {
                self.terms[i] = self.of(i)[k];
            }
            let size = measure(&self.terms, &self.weights);
            if size > 0.0 {
                exponent = exponent.min(-real::ln(size) / k as f64);
            }
        }
        SAFETY * real::exp(exponent)
    }
}

impl Stepper for Taylor {
    fn reach(&mut self, system: &mut Counted, from: &Point, norm: &Norm) -> Option<f64> {
        self.expand(system, from).ok()?;
        let first = self.tolerated_step(norm, 0.0);
        Some(self.tolerated_step(norm, first.min(f64::MAX)))
    }

    /// The error is what the series leaves of the equations at the end of the step.
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, norm: &Norm) -> Result<f64, Failure> {
        self.expand(system, from)?;
        let h = to.t - from.t;
        for i in 0..from.y.len() {
            let (mut y, mut slope) = (0.0, 0.0);
            for &c in self.of(i).iter().rev() {
                slope = slope * h + y;
                y = y * h + c;
            }
            (to.y[i], self.terms[i]) = (y, slope);
        }
        system.rate_of(to)?;
        self.terms.iter_mut().zip(&to.dy).for_each(|(slope, rate)| *slope = (*slope - rate) * h / ORDER as f64);
        norm.weights(from, to, &mut self.weights);
        Ok(measure(&self.terms, &self.weights))
    }

    /// The series, in the form of a segment: divided by θ and 1 − θ in turn.
    fn dense(&mut self, _: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (n, h) = (from.y.len(), to.t - from.t);
        let mut segment = Segment::hermite((from.t, &from.y, &from.dy), (to.t, &to.y, &to.dy), ORDER - 3);
        let mut bends = vec![0.0; n * ORDER];
        for first in (0..n).step_by(SIDE) {
            let (beside, mut power) = (SIDE.min(n - first), 1.0);
            let mut left = [[0.0; SIDE]; ORDER];
            for (k, left) in left.iter_mut().enumerate() {
                power *= h;
                (0..beside).for_each(|i| left[i] = self.of(first + i)[k + 1] * power);
            }
            let mut left = &mut left[..];
            for index in 0..ORDER {
                // What is left less its value at 1, over 1 − θ: of each power the sum of all above, reversed.
                let bend = if index % 2 == 0 {
                    left.iter_mut().rev().fold([0.0; SIDE], |above, term| {
                        let sum = std::array::from_fn(|i| above[i] + term[i]);
                        *term = above.map(|x: f64| -x);
                        sum
                    })
                } else {
                    let first = left[0];
                    left = &mut left[1..];
                    first
                };
                bends[index * n + first..][..beside].copy_from_slice(&bend[..beside]);
            }
        }
        segment.bend(3, bends[3 * n..].iter().copied());
        Ok(segment)
    }

    fn reset(&mut self) {
        self.from = None;
    }
}
