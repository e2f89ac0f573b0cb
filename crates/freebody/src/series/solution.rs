//! The Taylor coefficients of a solution, order by order.

use super::tape::{Op, Row, Tape};
use crate::scalar::{DoubleDouble, Scalar};
use multiversion::multiversion;

/// Products that are added side by side, whatever the registers of the machine.
const WIDTH: usize = 4;

/// A number that series may have as coefficients.
pub trait Coefficient: Scalar {
    /// Fills a solution up to its order.
    fn fill(solution: &mut Solution<Self>, t: Self, y: &[Self]);
}

impl Coefficient for f64 {
    fn fill(solution: &mut Solution<f64>, t: f64, y: &[f64]) {
        fill_doubles(solution, t, y);
    }
}

impl Coefficient for DoubleDouble {
    fn fill(solution: &mut Solution<Self>, t: Self, y: &[Self]) {
        solution.fill(t, y);
    }
}

/// Σ aⱼ bⱼ of as many, a multiple of [`WIDTH`], in parts that are to be added.
#[inline(always)]
fn dot<S: Scalar>(a: &[S], b: &[S]) -> [S; WIDTH] {
    let mut sums = [S::zero(); WIDTH];
    for (a, b) in a.chunks_exact(WIDTH).zip(b.chunks_exact(WIDTH)) {
        for ((sum, &a), &b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums
}

/// In the widest registers that the machine has, to the same bits.
#[multiversion(targets("x86_64+avx2"))]
fn fill_doubles(solution: &mut Solution<f64>, t: f64, y: &[f64]) {
    solution.fill(t, y);
}

/// The coefficients of every number of a tape in powers of the time since one instant.
///
/// A row of memory holds the coefficients x₀, x₁ … of a number, those k xₖ of its rate, and … x₂, x₁ in reverse with zeros behind: the
/// inner terms Σ aⱼ bₖ₋ⱼ of a product, 0 < j < k, are then a sum along memory. They hold nothing of order k, so those of all
/// operations are found first, none waiting for another.
pub struct Solution<S> {
    tape: Tape<S>,
    order: usize,
    /// 1/k, from k = 1 on.
    inverse: Vec<S>,
    /// Where the factors of the inner terms begin, those of an operation behind those of the one before.
    factors: Vec<[usize; 2]>,
    inner: Vec<[S; WIDTH]>,
    memory: Vec<S>,
}

/// The coefficients while they are found; rows are told by their first place.
struct Memory<'a, S> {
    layout: Layout,
    all: &'a mut [S],
}

/// Where the parts of a row are in memory.
#[derive(Clone, Copy)]
struct Layout {
    order: usize,
}

impl Layout {
    #[inline(always)]
    fn length(self) -> usize {
        self.order + WIDTH
    }
    #[inline(always)]
    fn rate(self) -> usize {
        self.length()
    }
    /// Where coefficient 0 would be in reverse.
    #[inline(always)]
    fn reverse(self) -> usize {
        2 * self.length() + self.order
    }
    fn stride(self) -> usize {
        self.reverse() + WIDTH
    }
}

impl<S: Coefficient> Solution<S> {
    /// Of a tape, up to an order.
    pub fn new(tape: Tape<S>, order: usize) -> Self {
        let layout = Layout { order };
        let memory = vec![S::zero(); tape.rows as usize * layout.stride()];
        let tape = tape.divided().spread(layout.stride() as u32);
        let inverse = (1..=order).map(|k| S::one() / S::of(k as f64)).collect();
        let factors: Vec<_> = tape.ops.iter().flat_map(|(row, op)| factors(layout, *row, op)).collect();
        Solution { tape, order, inverse, inner: vec![[S::zero(); WIDTH]; factors.len()], factors, memory }
    }

    /// Finds the coefficients of the motion through y at t; false where it has none.
    pub fn expand(&mut self, t: S, y: &[S]) -> bool {
        S::fill(self, t, y);
        let found = (0..y.len()).all(|i| self.component(i).iter().all(|x| x.value().is_finite()));
        if !found {
            self.memory.fill(S::zero());
        }
        found
    }

    /// Those of a component of y, from order 0 on.
    pub fn component(&self, i: usize) -> &[S] {
        let from = (i + 1) * Layout { order: self.order }.stride();
        &self.memory[from..=from + self.order]
    }

    #[inline(always)]
    fn fill(&mut self, t: S, y: &[S]) {
        let Solution { tape, order, inverse, factors, inner, memory } = self;
        let layout = Layout { order: *order };
        let mut at = Memory { layout, all: memory };
        let component = |i: usize| Row(((i + 1) * layout.stride()) as u32);
        at.set(Row(0), 0, t);
        at.set(Row(0), 1, S::one());
        for (i, &y) in y.iter().enumerate() {
            at.set(component(i), 0, y);
        }
        for k in 0..*order {
            if k > 0 {
                at.write_inner(factors, k, inner);
            }
            let mut inner = &inner[..];
            for (row, op) in &tape.ops {
                match k {
                    0 => at.begin(*row, op),
                    _ => inner = &inner[at.advance(*row, op, k, inverse[k - 1], inner)..],
                }
            }
            for (i, &rate) in tape.results.iter().enumerate() {
                at.set(component(i), k + 1, at.get(rate, k) * inverse[k]);
            }
        }
    }
}

/// Where the factors begin of the products of series that an operation takes, from coefficient 1 of the first on and of the
/// second in reverse.
fn factors(layout: Layout, row: Row, op: &Op<impl Copy>) -> Vec<[usize; 2]> {
    let product = |a: Row, b: Row| [a.0 as usize + 1, b.0 as usize + layout.reverse() + 1];
    let of_rate = |a: Row, b: Row| [a.0 as usize + layout.rate() + 1, b.0 as usize + layout.reverse() + 1];
    match *op {
        Op::Sum { .. } => vec![],
        Op::Product(a, b) => vec![product(a, b)],
        Op::Inverse(b) | Op::Quotient(_, b) => vec![product(b, row)],
        Op::SinCos(angle) => vec![of_rate(angle, Row(row.0 + layout.stride() as u32)), of_rate(angle, row)],
        Op::Sqrt(_) => vec![product(row, row)],
        Op::Exp(x) => vec![of_rate(x, row)],
        Op::Ln(x) => vec![of_rate(row, x)],
        Op::Atan2 { y, x, radius2 } => vec![of_rate(y, x), of_rate(x, y), of_rate(row, radius2)],
    }
}

impl<S: Coefficient> Memory<'_, S> {
    #[inline(always)]
    fn get(&self, row: Row, k: usize) -> S {
        self.all[row.0 as usize + k]
    }
    #[inline(always)]
    fn set(&mut self, row: Row, k: usize, x: S) {
        let row = row.0 as usize;
        self.all[row + k] = x;
        if k > 0 {
            self.all[row + self.layout.rate() + k] = x * S::of(k as f64);
            self.all[row + self.layout.reverse() - k] = x;
        }
    }

    /// The inner terms of order k of all products.
    #[inline(always)]
    fn write_inner(&self, factors: &[[usize; 2]], k: usize, inner: &mut [[S; WIDTH]]) {
        match (k - 1).next_multiple_of(WIDTH) {
            0 => inner.fill([S::zero(); WIDTH]),
            4 => self.write_dots::<4>(factors, k, inner),
            8 => self.write_dots::<8>(factors, k, inner),
            12 => self.write_dots::<12>(factors, k, inner),
            16 => self.write_dots::<16>(factors, k, inner),
            20 => self.write_dots::<20>(factors, k, inner),
            24 => self.write_dots::<24>(factors, k, inner),
            count => {
                for (sums, &[a, b]) in inner.iter_mut().zip(factors) {
                    *sums = dot(&self.all[a..][..count], &self.all[b - k..][..count]);
                }
            }
        }
    }

    /// The same of a length that the compiler knows.
    #[inline(always)]
    fn write_dots<const COUNT: usize>(&self, factors: &[[usize; 2]], k: usize, inner: &mut [[S; WIDTH]]) {
        for (sums, &[a, b]) in inner.iter_mut().zip(factors) {
            let [a, b] = [a, b - k].map(|from| self.all[from..].first_chunk::<COUNT>().expect("rows are longer"));
            *sums = dot(a, b);
        }
    }

    /// The value that an operation gives.
    fn begin(&mut self, row: Row, op: &Op<S>) {
        let x = match op {
            Op::Sum { constant, terms } => {
                terms.iter().fold(*constant, |sum, term| sum + self.get(term.row, 0) * term.factor)
            }
            Op::Product(a, b) => self.get(*a, 0) * self.get(*b, 0),
            Op::Quotient(a, b) => self.get(*a, 0) / self.get(*b, 0),
            Op::Inverse(b) => S::one() / self.get(*b, 0),
            Op::SinCos(angle) => {
                let (sin, cos) = self.get(*angle, 0).sin_cos();
                self.set(self.second(row), 0, cos);
                sin
            }
            Op::Sqrt(x) => self.get(*x, 0).sqrt(),
            Op::Exp(x) => self.get(*x, 0).exp(),
            Op::Ln(x) => self.get(*x, 0).ln(),
            Op::Atan2 { y, x, .. } => self.get(*y, 0).atan2(self.get(*x, 0)),
        };
        self.set(row, 0, x);
    }

    /// Coefficient k > 0 of what an operation gives, from those before it, those of what it works on, and its inner terms, the first
    /// of those given; returns how many it has. `share` is 1/k. Each waits for a number that stands late on the tape, so that is added last.
    #[inline(always)]
    fn advance(&mut self, row: Row, op: &Op<S>, k: usize, share: S, inner: &[[S; WIDTH]]) -> usize {
        let inner = |i: usize| (inner[i][0] + inner[i][2]) + (inner[i][1] + inner[i][3]);
        let (x, count) = match op {
            Op::Sum { terms, .. } => {
                let each = terms.iter().map(|term| self.get(term.row, k) * term.factor);
                (each.reduce(|sum, x| sum + x).unwrap_or(S::zero()), 0)
            }
            Op::Product(a, b) => {
                ((inner(0) + self.get(*a, k) * self.get(*b, 0)) + self.get(*b, k) * self.get(*a, 0), 1)
            }
            Op::Inverse(b) => (-(inner(0) + self.get(*b, k) * self.get(row, 0)) * self.get(row, 0), 1),
            Op::Quotient(a, b) => {
                let above = self.get(*a, k) - inner(0) - self.get(*b, k) * self.get(row, 0);
                (above * (S::one() / self.get(*b, 0)), 1)
            }
            Op::SinCos(angle) => {
                let (cos, slope) = (self.second(row), self.get(*angle, k));
                let (at_sin, at_cos) = (self.get(row, 0), self.get(cos, 0));
                self.set(cos, k, -(inner(1) * share + slope * at_sin));
                (inner(0) * share + slope * at_cos, 2)
            }
            Op::Sqrt(x) => ((self.get(*x, k) - inner(0)) / (self.get(row, 0) + self.get(row, 0)), 1),
            Op::Exp(x) => (inner(0) * share + self.get(*x, k) * self.get(row, 0), 1),
            Op::Ln(x) => ((self.get(*x, k) - inner(0) * share) / self.get(*x, 0), 1),
            Op::Atan2 { y, x, radius2 } => {
                let turned = self.get(*y, k) * self.get(*x, 0) - self.get(*x, k) * self.get(*y, 0);
                let known = (inner(0) - inner(1) - inner(2)) * share;
                ((turned + known) / self.get(*radius2, 0), 3)
            }
        };
        self.set(row, k, x);
        count
    }

    /// The second number of an operation that gives two.
    #[inline(always)]
    fn second(&self, row: Row) -> Row {
        Row(row.0 + self.layout.stride() as u32)
    }
}
