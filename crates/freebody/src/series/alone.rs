//! A program run for one state: what an operation needs stands beside it, and sums have their length in their name.

use super::program::{List, Program, Sum};
use super::tape::{Op, Row};
use crate::scalar::{real, Block};

/// Places of operands beyond the first in one step: a term has one, a product two.
const MOST: usize = 5;

/// What a step makes of its operands; `Sum21` is the first with two terms and one product added.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Sum00,
    Sum10,
    Sum20,
    Sum30,
    Sum40,
    Sum50,
    Sum01,
    Sum11,
    Sum21,
    Sum31,
    Sum02,
    Sum12,
    Product,
    Quotient,
    Inverse,
    SinCos,
    Sqrt,
    Exp,
    Ln,
    Atan2,
}

#[derive(Clone, Copy, Debug)]
struct Step {
    kind: Kind,
    to: Row,
    of: [Row; 1 + MOST],
    factors: [f64; MOST],
}

/// The operations of a program on inputs that move, and its memory.
#[derive(Clone, Debug)]
pub struct Alone {
    steps: Vec<Step>,
    memory: Vec<f64>,
    inputs: usize,
    results: Vec<Row>,
}

impl Alone {
    /// That of a program with the inputs that do not move.
    pub fn new(program: &Program, inputs: &[f64]) -> Self {
        let mut memory = program.memory::<1>();
        program.fix(&mut memory, &inputs.iter().map(|&x| Block::of(x)).collect::<Vec<_>>());
        let mut memory: Vec<_> = memory.iter().map(|x| x.0[0]).collect();
        let rest = Row(memory.len() as u32);
        memory.push(0.0);
        let results = program.results.iter().map(|(row, _)| *row).collect();
        Alone { steps: steps(&program.moving, rest), memory, inputs: program.inputs, results }
    }

    /// Makes the operations at a time and a state, of which two parts are given: the other inputs that move.
    pub fn run(&mut self, t: f64, [y, more]: [&[f64]; 2]) {
        let memory = &mut self.memory[..];
        memory[0] = t;
        memory[1..][..y.len()].copy_from_slice(y);
        memory[1 + y.len()..self.inputs].copy_from_slice(more);
        self.steps.iter().for_each(|step| step.make(memory));
    }

    /// Results of the last run, from one on.
    pub fn results(&self, from: usize) -> impl Iterator<Item = f64> + '_ {
        self.results[from..].iter().map(|row| self.memory[row.at()])
    }
}

impl Step {
    fn new(kind: Kind, to: Row, operands: &[Row], by: &[f64]) -> Self {
        let (mut of, mut factors) = ([Row(0); 1 + MOST], [0.0; MOST]);
        of[..operands.len()].copy_from_slice(operands);
        factors[..by.len()].copy_from_slice(by);
        Step { kind, to, of, factors }
    }

    #[inline(always)]
    fn make(&self, memory: &mut [f64]) {
        let at = |i: usize| memory[self.of[i].at()];
        memory[self.to.at()] = match self.kind {
            Kind::Sum00 => self.sum::<0, 0>(memory),
            Kind::Sum10 => self.sum::<1, 0>(memory),
            Kind::Sum20 => self.sum::<2, 0>(memory),
            Kind::Sum30 => self.sum::<3, 0>(memory),
            Kind::Sum40 => self.sum::<4, 0>(memory),
            Kind::Sum50 => self.sum::<5, 0>(memory),
            Kind::Sum01 => self.sum::<0, 1>(memory),
            Kind::Sum11 => self.sum::<1, 1>(memory),
            Kind::Sum21 => self.sum::<2, 1>(memory),
            Kind::Sum31 => self.sum::<3, 1>(memory),
            Kind::Sum02 => self.sum::<0, 2>(memory),
            Kind::Sum12 => self.sum::<1, 2>(memory),
            Kind::Product => at(0) * at(1),
            Kind::Quotient => at(0) / at(1),
            Kind::Inverse => 1.0 / at(0),
            Kind::SinCos => {
                let (sin, cos) = real::sin_cos(at(0));
                memory[self.to.at() + 1] = cos;
                sin
            }
            Kind::Sqrt => at(0).sqrt(),
            Kind::Exp => real::exp(at(0)),
            Kind::Ln => real::ln(at(0)),
            Kind::Atan2 => real::atan2(at(0), at(1)),
        };
    }

    #[inline(always)]
    fn sum<const TERMS: usize, const PRODUCTS: usize>(&self, memory: &[f64]) -> f64 {
        let at = |i: usize| memory[self.of[i].at()];
        let mut sum = at(0);
        for i in 0..TERMS {
            sum += at(1 + i) * self.factors[i];
        }
        for i in 0..PRODUCTS {
            let first = 1 + TERMS + 2 * i;
            sum += at(first) * at(first + 1) * self.factors[TERMS + i];
        }
        sum
    }
}

/// The steps of a list; `rest`: a place for sums that go on in the next one.
fn steps(list: &List, rest: Row) -> Vec<Step> {
    let (mut terms, mut products, mut steps) = (list.terms.iter(), list.products.iter(), vec![]);
    for &(to, ref op) in &list.steps {
        let (kind, of) = match *op {
            Op::Sum { terms: Sum { start, terms: t, products: p }, .. } => {
                let terms = terms.by_ref().take(t as usize).map(|term| (term.factor, vec![term.row]));
                let products = products.by_ref().take(p as usize).map(|product| (product.factor, product.of.to_vec()));
                push_sum(&mut steps, [to, rest], start, terms.chain(products));
                continue;
            }
            Op::Product(a, b) => (Kind::Product, [a, b]),
            Op::Quotient(a, b) => (Kind::Quotient, [a, b]),
            Op::Inverse(x) => (Kind::Inverse, [x; 2]),
            Op::SinCos(x) => (Kind::SinCos, [x; 2]),
            Op::Sqrt(x) => (Kind::Sqrt, [x; 2]),
            Op::Exp(x) => (Kind::Exp, [x; 2]),
            Op::Ln(x) => (Kind::Ln, [x; 2]),
            Op::Atan2 { y, x, .. } => (Kind::Atan2, [y, x]),
        };
        steps.push(Step::new(kind, to, &of, &[]));
    }
    steps
}

/// A sum in as many steps as it takes.
fn push_sum(steps: &mut Vec<Step>, [to, rest]: [Row; 2], start: Row, parts: impl Iterator<Item = (f64, Vec<Row>)>) {
    let (mut of, mut factors) = (vec![start], vec![]);
    for (factor, rows) in parts {
        if of.len() + rows.len() > 1 + MOST {
            steps.push(Step::new(sum(of.len() - 1, factors.len()), rest, &of, &factors));
            (of, factors) = (vec![rest], vec![]);
        }
        of.extend(rows);
        factors.push(factor);
    }
    steps.push(Step::new(sum(of.len() - 1, factors.len()), to, &of, &factors));
}

/// A sum of so many operands and factors beside its first: a product has two operands, a term one.
fn sum(operands: usize, factors: usize) -> Kind {
    let products = operands - factors;
    match [factors - products, products] {
        [0, 0] => Kind::Sum00,
        [1, 0] => Kind::Sum10,
        [2, 0] => Kind::Sum20,
        [3, 0] => Kind::Sum30,
        [4, 0] => Kind::Sum40,
        [5, 0] => Kind::Sum50,
        [0, 1] => Kind::Sum01,
        [1, 1] => Kind::Sum11,
        [2, 1] => Kind::Sum21,
        [3, 1] => Kind::Sum31,
        [0, 2] => Kind::Sum02,
        [1, 2] => Kind::Sum12,
        _ => unreachable!("a step has room for them"),
    }
}
