//! A tape run for its values alone, of several states side by side.

use super::tape::{Op, Row, Term};
use crate::scalar::block::{self, PART};
use crate::scalar::{real, Block};
#[cfg(target_arch = "x86_64")]
use {super::machine_code::Code, std::sync::OnceLock};

/// A multiple of a product that nothing else needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Product {
    pub factor: f64,
    pub of: [Row; 2],
}

/// A sum: a value, and so many of the terms and products that follow those of the sums before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    pub start: Row,
    pub terms: u32,
    pub products: u32,
}

/// Operations, each with where its value goes.
#[derive(Clone, Debug, Default)]
pub(super) struct List {
    pub steps: Vec<(Row, Op<(), Sum>)>,
    pub terms: Vec<Term<f64>>,
    pub products: Vec<Product>,
}

/// The operations of a tape.
#[derive(Debug, Default)]
pub struct Program {
    /// Those on inputs that do not move, done once for many states.
    pub(super) fixed: List,
    pub(super) moving: List,
    /// How many inputs move; they stand first.
    pub(super) inputs: usize,
    pub(super) rows: usize,
    pub(super) constants: Vec<(Row, f64)>,
    /// Where each result stands, and how many of the steps are made then.
    pub(super) results: Vec<(Row, usize)>,
    /// Those on inputs that move as machine code, once it was needed.
    #[cfg(target_arch = "x86_64")]
    pub(super) code: OnceLock<Option<Code>>,
}

impl Program {
    /// Memory for states side by side.
    pub fn memory<const B: usize>(&self) -> Vec<Block<B>> {
        let mut memory = vec![Block::of(0.0); self.rows];
        self.constants.iter().for_each(|(row, constant)| memory[row.at()] = Block::of(*constant));
        memory
    }

    /// Takes the inputs that do not move.
    pub fn fix<const B: usize>(&self, memory: &mut [Block<B>], inputs: &[Block<B>]) {
        memory[self.inputs..][..inputs.len()].copy_from_slice(inputs);
        self.fixed.run::<B, 1>(self.fixed.steps.len(), memory);
    }

    /// Writes the first results at times `t` and states `y`, which are the inputs that move; the others were taken before. Of whole parts.
    #[inline(always)]
    pub fn run<const B: usize>(&self, memory: &mut [Block<B>], t: Block<B>, y: &[Block<B>], results: &mut [Block<B>]) {
        memory[0] = t;
        memory[1..self.inputs].copy_from_slice(y);
        let asked = &self.results[..results.len()];
        let steps = asked.iter().map(|(_, steps)| *steps).max().unwrap_or(0);
        self.moving.run::<B, PART>(steps, memory);
        for (to, (row, _)) in results.iter_mut().zip(asked) {
            *to = memory[row.at()];
        }
    }
}

/// An operation, where its value goes, and what it adds.
pub(super) type Step<'a> = (Row, &'a Op<(), Sum>, &'a [Term<f64>], &'a [Product]);

impl List {
    /// The operations.
    #[inline(always)]
    pub fn steps(&self) -> impl Iterator<Item = Step<'_>> {
        let (mut terms, mut products) = (&self.terms[..], &self.products[..]);
        self.steps.iter().map(move |(to, op)| {
            let mut own = (&terms[..0], &products[..0]);
            if let Op::Sum { terms: next, .. } = op {
                (own.0, terms) = terms.split_at(next.terms as usize);
                (own.1, products) = products.split_at(next.products as usize);
            }
            (*to, op, own.0, own.1)
        })
    }

    /// Makes the first steps, in parts of N values, each read before it is written: values may stand where others stood.
    #[inline(always)]
    pub fn run<const B: usize, const N: usize>(&self, steps: usize, memory: &mut [Block<B>]) {
        for next in self.steps().take(steps) {
            step::<B, N>(memory, next);
        }
    }
}

#[inline(always)]
fn step<const B: usize, const N: usize>(memory: &mut [Block<B>], (to, op, terms, products): Step<'_>) {
    match *op {
        Op::Sum { terms: Sum { start, .. }, .. } => {
            for part in 0..B / N {
                let mut sum = *memory[start.at()].part::<N>(part);
                for term in terms {
                    block::add(&mut sum, term.factor, memory[term.row.at()].part(part));
                }
                for &Product { factor, of: [a, b] } in products {
                    block::add_product(&mut sum, factor, memory[a.at()].part(part), memory[b.at()].part(part));
                }
                *memory[to.at()].part_mut(part) = sum;
            }
        }
        Op::Product(a, b) => write::<B, N, 2>(memory, to, [a, b], |[a, b]| a * b),
        Op::Quotient(a, b) => write::<B, N, 2>(memory, to, [a, b], |[a, b]| a / b),
        Op::Inverse(x) => write::<B, N, 1>(memory, to, [x], |[x]| 1.0 / x),
        Op::SinCos(x) => {
            for part in 0..B / N {
                let [sin, cos] = block::sin_cos(memory[x.at()].part::<N>(part));
                *memory[to.at()].part_mut(part) = sin;
                *memory[to.at() + 1].part_mut(part) = cos;
            }
        }
        Op::Sqrt(x) => write::<B, N, 1>(memory, to, [x], |[x]| x.sqrt()),
        Op::Exp(x) => write::<B, N, 1>(memory, to, [x], |[x]| real::exp(x)),
        Op::Ln(x) => write::<B, N, 1>(memory, to, [x], |[x]| real::ln(x)),
        Op::Atan2 { y, x, .. } => write::<B, N, 2>(memory, to, [y, x], |[y, x]| real::atan2(y, x)),
    }
}

/// Writes a function of values.
#[inline(always)]
fn write<const B: usize, const N: usize, const K: usize>(
    memory: &mut [Block<B>],
    to: Row,
    of: [Row; K],
    f: impl Fn([f64; K]) -> f64,
) {
    for part in 0..B / N {
        *memory[to.at()].part_mut(part) = block::each(of.map(|row| memory[row.at()].part::<N>(part)), &f);
    }
}
