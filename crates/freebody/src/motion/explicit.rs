//! Explicit Runge–Kutta methods: one engine for all tables.

use super::dense::Segment;
use super::method::{Counted, Failure, Point, Stepper};
use super::norm::{measure, Norm};
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
    /// Rates at the stages.
    k: Vec<Vec<f64>>,
    /// State at the stage being evaluated.
    y: Vec<f64>,
    /// State at the last stage of the step, for the test of stiffness.
    last: Vec<f64>,
    /// Whether the error estimate asks for the rate at the end of the step.
    rates_end: bool,
    weights: Vec<f64>,
    stiffness: Stiffness,
}

impl Explicit {
    pub fn boxed(table: &'static Table, n: usize) -> Box<dyn Stepper> {
        let stages = table.b.len() + 1 + table.more_c.len();
        Box::new(Self {
            table,
            k: vec![vec![0.0; n]; stages],
            y: vec![0.0; n],
            last: vec![0.0; n],
            rates_end: table.errors.iter().any(|weights| weights.len() > table.b.len()),
            weights: vec![0.0; n],
            stiffness: Stiffness::default(),
        })
    }

    fn stage(
        &mut self,
        system: &mut Counted,
        from: &Point,
        h: f64,
        (index, c, a): (usize, f64, &[f64]),
    ) -> Result<(), Failure> {
        let (known, rest) = self.k.split_at_mut(index);
        combine(a, known, &mut self.y);
        self.y.iter_mut().zip(&from.y).for_each(|(y, from)| *y = from + h * *y);
        system.rate(from.t + c * h, &self.y, &mut rest[0])
    }

    fn error(&mut self, h: f64) -> f64 {
        let mut norm = |e: &[f64]| {
            combine(e, &self.k, &mut self.y);
            self.y.iter_mut().for_each(|y| *y *= h);
            measure(&self.y, &self.weights)
        };
        match self.table.errors {
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

/// Writes Σ aⱼ kⱼ, stage after stage; those without weight are left out.
fn combine(a: &[f64], k: &[Vec<f64>], sum: &mut [f64]) {
    let (fours, rest) = sum.as_chunks_mut::<4>();
    let (twos, last) = rest.as_chunks_mut::<2>();
    let mut from = 0;
    fours.iter_mut().for_each(|sum| *sum = combined(a, k, &mut from));
    twos.iter_mut().for_each(|sum| *sum = combined(a, k, &mut from));
    last.iter_mut().for_each(|sum| [*sum] = combined(a, k, &mut from));
}

/// The next few components, which stay in registers.
#[inline(always)]
fn combined<const N: usize>(a: &[f64], k: &[Vec<f64>], from: &mut usize) -> [f64; N] {
    let mut sum = [0.0; N];
    for (&a, k) in a.iter().zip(k).filter(|(&a, _)| a != 0.0) {
        let part = &k[*from..*from + N];
        sum.iter_mut().zip(part).for_each(|(sum, k)| *sum += k * a);
    }
    *from += N;
    sum
}

impl Stepper for Explicit {
    fn attempt(&mut self, system: &mut Counted, from: &Point, to: &mut Point, norm: &Norm) -> Result<f64, Failure> {
        let (table, h) = (self.table, to.t - from.t);
        self.k[0].copy_from_slice(&from.dy);
        for (j, (&c, a)) in table.c.iter().zip(table.a).enumerate() {
            self.stage(system, from, h, (j + 1, c, a))?;
        }
        self.last.copy_from_slice(&self.y);
        combine(table.b, &self.k, &mut to.y);
        to.y.iter_mut().zip(&from.y).for_each(|(y, from)| *y = from + h * *y);
        let stages = table.b.len();
        match self.rates_end {
            true => system.rate_of(to)?,
            false => to.dy.copy_from_slice(&self.k[stages - 1]),
        }
        self.k[stages].copy_from_slice(&to.dy);
        norm.weights(from, to, &mut self.weights);
        Ok(self.error(h))
    }

    fn dense(&mut self, system: &mut Counted, from: &Point, to: &Point) -> Result<Segment, Failure> {
        let (table, h, stages) = (self.table, to.t - from.t, self.table.b.len());
        self.k[stages].copy_from_slice(&to.dy);
        if let Some(limit) = table.stability {
            self.stiffness.note(limit, h, (&self.k[stages - 1], &self.last), to);
        }
        for (j, (&c, a)) in table.more_c.iter().zip(table.more_a).enumerate() {
            self.stage(system, from, h, (stages + 1 + j, c, a))?;
        }
        let mut segment = Segment::hermite((from.t, &from.y, &from.dy), (to.t, &to.y, &to.dy));
        segment.expect(table.dense.len());
        for (j, row) in table.dense.iter().enumerate() {
            combine(row, &self.k, &mut self.y);
            segment.bend(3 + j, self.y.iter().map(|y| h * y));
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
