//! Gauss–Legendre collocation of order 6, symplectic.

use super::dense::Segment;
use super::method::{Counted, Failure, Method, Point, Stepper};
use super::norm::Norm;
use super::system::DynamicsError;

/// Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3 (table 1.1), with the
/// Change of the stages, over the largest rate, that may be round-off of a rate: some hundred roundings.
const ROUND_OFF: f64 = 1e-13;
/// fixed-point iteration to round-off of VIII.6 and the compensated summation of VIII.5.
pub(super) const METHOD: Method = Method {
    name: "gauss6",
    citation: "Hairer, Lubich & Wanner, Geometric Numerical Integration, II.1.3 and VIII.5-6",
    order: 6,
    dense_order: 5,
    estimate_order: None,
    symplectic: true,
    analytic: false,
    implicit: true,
    stage_gap: 0.3,
    stepper: |n| Box::new(Gauss6::new(n)),
};

const SQRT15: f64 = 3.872_983_346_207_417;
const C: [f64; 3] = [0.5 - SQRT15 / 10.0, 0.5, 0.5 + SQRT15 / 10.0];
const A: [[f64; 3]; 3] = [
    [5.0 / 36.0, 2.0 / 9.0 - SQRT15 / 15.0, 5.0 / 36.0 - SQRT15 / 30.0],
    [5.0 / 36.0 + SQRT15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - SQRT15 / 24.0],
    [5.0 / 36.0 + SQRT15 / 30.0, 2.0 / 9.0 + SQRT15 / 15.0, 5.0 / 36.0],
];
const B: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];
const STAGE_ITERATIONS: usize = 100;

struct Gauss6 {
    n: usize,
    /// Canonical variables, as a sum of two numbers, at the start and the end of the attempt.
    from: Canon,
    to: Canon,
    /// Their rates at the stages.
    k: [Vec<f64>; 3],
}

#[derive(Clone)]
struct Canon {
    /// The state y that belongs to z; another y means that the system acted.
    y: Vec<f64>,
    z: Vec<f64>,
    /// What round-off took from z.
    rest: Vec<f64>,
}

impl Gauss6 {
    fn new(n: usize) -> Self {
        let canon = Canon { y: vec![f64::NAN; n], z: vec![0.0; n], rest: vec![0.0; n] };
        Self { n, from: canon.clone(), to: canon, k: [(); 3].map(|()| vec![0.0; n]) }
    }

    /// Takes the canonical variables over from the last step, or finds them anew.
    fn enter(&mut self, system: &mut Counted, from: &Point) -> Result<(), Failure> {
        if self.from.y == from.y {
            return Ok(());
        }
        if self.to.y == from.y {
            self.from = self.to.clone();
            return Ok(());
        }
        let canonical = system.system.canonical().expect("checked when the run starts");
        canonical.enter(from.t, &from.y, &mut self.from.z)?;
        self.from.y.copy_from_slice(&from.y);
        self.from.rest.fill(0.0);
        let z = self.from.z.clone();
        let mut k = vec![0.0; self.n];
        system.flow(from.t, &z, &mut k)?;
        self.k = [k.clone(), k.clone(), k];
        Ok(())
    }

    /// Iterates the stages until they stop changing, or change by round-off only.
    fn iterate(&mut self, system: &mut Counted, t: f64, h: f64) -> Result<(), Failure> {
        let mut last = f64::INFINITY;
        for _ in 0..STAGE_ITERATIONS {
            let change = self.sweep(system, t, h)?;
            // At round-off the change is small and no longer shrinks.
            if change == 0.0 || change < ROUND_OFF && change >= last {
                return Ok(());
            }
            last = change;
        }
        Err(DynamicsError::FixedPointStalled(t, STAGE_ITERATIONS).into())
    }

    /// One fixed-point iteration; returns the largest change relative to the largest rate.
    fn sweep(&mut self, system: &mut Counted, t: f64, h: f64) -> Result<f64, Failure> {
        let (mut z, old) = (vec![0.0; self.n], self.k.clone());
        for (stage, row) in A.iter().enumerate() {
            for (i, z) in z.iter_mut().enumerate() {
                let rise: f64 = (0..3).map(|l| row[l] * old[l][i]).sum();
                *z = self.from.z[i] + h * rise;
            }
            system.flow(t + C[stage] * h, &z, &mut self.k[stage])?;
        }
        let (mut change, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for (new, old) in self.k.iter().flatten().zip(old.iter().flatten()) {
            change = change.max((new - old).abs());
            size = size.max(new.abs());
        }
        Ok(change / size)
    }

    /// Adds the step to the canonical variables by compensated summation.
    fn add(&mut self, h: f64) {
        for i in 0..self.n {
            let rise = h * (0..3).map(|l| B[l] * self.k[l][i]).sum::<f64>() + self.from.rest[i];
            self.to.z[i] = self.from.z[i] + rise;
            self.to.rest[i] = (self.from.z[i] - self.to.z[i]) + rise;
        }
    }
}

impl Stepper for Gauss6 {
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, _norm: &Norm) -> Result<f64, Failure> {
        self.enter(system, from)?;
        self.iterate(system, from.t, to.t - from.t)?;
        self.add(to.t - from.t);
        let canonical = system.system.canonical().expect("checked when the run starts");
        canonical.leave(to.t, &self.to.z, &mut to.y)?;
        self.to.y.copy_from_slice(&to.y);
        system.rate_of(to)?;
        Ok(0.0)
    }

    /// The quintic whose slope is the rate at both ends, at 1/3 and at 2/3 of the step: the
    /// cubic Hermite interpolant gives the inner rates, then the quintic gives better ones
    /// (bootstrapping, HNW I, II.6).
    fn dense(&mut self, system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (n, h) = (self.n, to.t - from.t);
        let cubic = Segment::hermite((from.t, &from.y, &from.dy), (to.t, &to.y, &to.dy), 2);
        let mut segment = cubic.clone();
        let (mut y, mut inner) = (vec![0.0; n], [vec![0.0; n], vec![0.0; n]]);
        for _ in 0..2 {
            for (third, rate) in inner.iter_mut().enumerate() {
                let t = from.t + h * (1 + third) as f64 / 3.0;
                segment.at(t, &mut y);
                system.rate(t, &y, rate)?;
            }
            // What the cubic's slopes lack at 1/3 and 2/3; (θ²(1−θ)²)′ is ±4/27 there.
            let lack = |i: usize| {
                let mean = 4.0 / 3.0 * (to.y[i] - from.y[i]);
                let (a, b) = (h * from.dy[i] / 3.0, h * to.dy[i] / 3.0);
                [h * inner[0][i] - mean + b, h * inner[1][i] - mean + a]
            };
            let (third, fourth): (Vec<f64>, Vec<f64>) =
                (0..n).map(lack).map(|[a, b]| (-6.75 * (a + 2.0 * b), 20.25 * (a + b))).unzip();
            segment.bend(3, third.into_iter());
            segment.bend(4, fourth.into_iter());
        }
        Ok(segment)
    }

    fn reset(&mut self) {
        *self = Self::new(self.n);
    }
}
