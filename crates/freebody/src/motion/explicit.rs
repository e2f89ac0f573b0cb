//! Explicit Runge–Kutta methods: one engine for all tables.

use super::dense::Segment;
use super::method::{Counted, Failure, Point, Stepper};
use super::norm::{self, noted, Norm};
use crate::scalar::real;

/// Weight of the second error estimate (HNW I, II.10).
const TEMPERING: f64 = 0.1;

/// The numbers of an explicit method of s stages. Stage s (counted from 0) is the rate at the end
/// of the step; the stages of the dense output come after it.
pub(super) struct Table {
    /// Times of stages 1 …, as fractions of the step.
    pub c: &'static [f64],
    /// Weights of the earlier stages in stages 1 ….
    pub a: &'static [&'static [f64]],
    /// Weights of the step.
    pub b: &'static [f64],
    /// Weights of the error estimate, and of a second one that tempers it (HNW I, II.10).
    pub errors: &'static [&'static [f64]],
    /// Times and weights of the extra stages of the dense output.
    pub more_c: &'static [f64],
    /// Weights of all earlier stages in the extra ones.
    pub more_a: &'static [&'static [f64]],
    /// Weights of F₃, F₄, … of [`Segment`].
    pub dense: &'static [&'static [f64]],
    /// The method is at its stability limit when |hλ| exceeds this.
    pub stability: Option<f64>,
}

/// Runs a [`Table`].
pub(super) struct Explicit {
    table: &'static Table,
    /// Weights that are not zero, each with where the rate of its stage begins.
    a: Vec<Weights>,
    b: Weights,
    errors: Vec<Weights>,
    more_a: Vec<Weights>,
    dense: Vec<Weights>,
    /// How many components change in the step.
    moving: usize,
    /// Rates at the stages, one after the other.
    k: Vec<f64>,
    /// State at the stage being evaluated.
    y: Vec<f64>,
    /// State at the last stage of the step, for the test of stiffness.
    last: Vec<f64>,
    /// Whether the error estimate asks for the rate at the end of the step.
    rates_end: bool,
    weights: Vec<f64>,
    stiffness: Stiffness,
}

type Weights = Vec<(usize, f64)>;

impl Explicit {
    pub fn boxed(table: &'static Table, n: usize) -> Box<dyn Stepper> {
        let stages = table.b.len() + 1 + table.more_c.len();
        let row = |weights: &&[f64]| -> Weights {
            let placed = weights.iter().enumerate().map(|(stage, &weight)| (stage * n, weight));
            placed.filter(|(_, weight)| *weight != 0.0).collect()
        };
        let rows = |rows: &[&[f64]]| rows.iter().map(row).collect();
        Box::new(Self {
            table,
            a: rows(table.a),
            b: row(&table.b),
            errors: rows(table.errors),
            more_a: rows(table.more_a),
            dense: rows(table.dense),
            moving: n,
            k: vec![0.0; n * stages],
            y: vec![0.0; n],
            last: vec![0.0; n],
            rates_end: table.errors.iter().any(|weights| weights.len() > table.b.len()),
            weights: vec![0.0; n],
            stiffness: Stiffness::default(),
        })
    }

    /// Where the rate of a stage stands.
    fn at(&self, stage: usize) -> std::ops::Range<usize> {
        stage * self.y.len()..(stage + 1) * self.y.len()
    }

    /// The rate at a stage, from the state that is there.
    fn rate(&mut self, system: &mut Counted, stage: usize, t: f64) -> Result<(), Failure> {
        let at = self.at(stage);
        system.rate(t, &self.y, &mut self.k[at])
    }

    fn error(&self, h: f64) -> f64 {
        let norm = |e: &Weights| {
            let mut squares = [0.0; 2];
            combine(e, &self.k, self.moving, |i, sum| squares = noted(squares, sum * h / self.weights[i]));
            norm::norm(squares, self.moving)
        };
        match &self.errors[..] {
            [] => 0.0,
            [main] => norm(main),
            [main, tempering, ..] => tempered(norm(main), || norm(tempering)),
        }
    }
}

/// An error estimate, tempered by another.
pub(super) fn tempered(main: f64, tempering: impl FnOnce() -> f64) -> f64 {
    match main > 0.0 {
        true => main * main / real::hypot(main, TEMPERING * tempering()),
        false => main,
    }
}

/// Takes Σ aⱼ kⱼ of each of n components, stage after stage.
#[inline(always)]
fn combine(a: &Weights, k: &[f64], n: usize, mut take: impl FnMut(usize, f64)) {
    let mut from = 0;
    for _ in 0..n / 4 {
        combined::<4>(a, k, &mut from, &mut take);
    }
    if n % 4 > 1 {
        combined::<2>(a, k, &mut from, &mut take);
    }
    if n % 2 == 1 {
        combined::<1>(a, k, &mut from, &mut take);
    }
}

/// The next few components, which stay in registers.
#[inline(always)]
fn combined<const N: usize>(a: &Weights, k: &[f64], from: &mut usize, take: &mut impl FnMut(usize, f64)) {
    let (mut sum, k) = ([0.0; N], &k[*from..]);
    for &(stage, a) in a {
        let part = &k[stage..stage + N];
        sum.iter_mut().zip(part).for_each(|(sum, k)| *sum += k * a);
    }
    sum.iter().enumerate().for_each(|(i, &sum)| take(*from + i, sum));
    *from += N;
}

impl Stepper for Explicit {
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, norm: &Norm) -> Result<f64, Failure> {
        let (table, h) = (self.table, to.t - from.t);
        let (n, stages) = (system.system.moving(), table.b.len());
        self.moving = n;
        self.k[..from.dy.len()].copy_from_slice(&from.dy);
        self.y[n..].copy_from_slice(&from.y[n..]);
        to.y[n..].copy_from_slice(&from.y[n..]);
        for (j, c) in table.c.iter().enumerate() {
            combine(&self.a[j], &self.k, n, |i, sum| self.y[i] = from.y[i] + h * sum);
            self.rate(system, j + 1, from.t + c * h)?;
        }
        self.last.copy_from_slice(&self.y);
        combine(&self.b, &self.k, n, |i, sum| to.y[i] = from.y[i] + h * sum);
        match self.rates_end {
            true => system.rate_of(to)?,
            false => to.dy.copy_from_slice(&self.k[self.at(stages - 1)]),
        }
        let end = self.at(stages);
        self.k[end].copy_from_slice(&to.dy);
        norm.weights(from, to, &mut self.weights);
        Ok(self.error(h))
    }

    fn dense(&mut self, system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (table, h, n, stages) = (self.table, to.t - from.t, self.moving, self.table.b.len());
        let end = self.at(stages);
        self.k[end].copy_from_slice(&to.dy);
        if let Some(limit) = table.stability {
            let last = &self.k[self.at(stages - 1)];
            self.stiffness.note(limit, h, (last, &self.last), to);
        }
        for (j, c) in table.more_c.iter().enumerate() {
            combine(&self.more_a[j], &self.k, n, |i, sum| self.y[i] = from.y[i] + h * sum);
            self.rate(system, stages + 1 + j, from.t + c * h)?;
        }
        let mut segment = Segment::hermite((from.t, &from.y, &from.dy), (to.t, &to.y, &to.dy), self.dense.len());
        for (j, row) in self.dense.iter().enumerate() {
            combine(row, &self.k, n, |i, sum| self.y[i] = h * sum);
            segment.bend(3 + j, self.y[..n].iter().copied());
        }
        Ok(segment)
    }

    fn rates_end(&self) -> bool {
        self.rates_end
    }

    fn is_stiff(&self) -> bool {
        self.stiffness.suspicions >= 15
    }

    fn reset(&mut self) {
        self.stiffness = Stiffness::default();
    }
}

/// Hairer's stiffness test (HW II, IV.2): the ratio of two rates at the end of the step to the
/// distance of their states estimates |hλ|; 15 steps near the limit are suspicious, 6 clear it.
#[derive(Default)]
struct Stiffness {
    suspicions: u32,
    clear: u32,
}

impl Stiffness {
    fn note(&mut self, limit: f64, h: f64, (k, y): (&[f64], &[f64]), to: &Point) {
        let distance =
            |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() };
        if h.abs() * distance(k, &to.dy) > limit * distance(y, &to.y) {
            *self = Self { suspicions: self.suspicions + 1, clear: 0 };
            return;
        }
        self.clear += 1;
        if self.clear >= 6 {
            self.suspicions = 0;
        }
    }
}
