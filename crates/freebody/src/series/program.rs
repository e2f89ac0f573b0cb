//! A tape run for its values alone, of several states side by side.

use super::tape::{Op, Row, Tape};
use crate::scalar::{real, Block};

/// A multiple of a product that nothing else needs.
#[derive(Clone, Copy, Debug)]
struct Product {
    factor: f64,
    of: [Row; 2],
}

/// An operation, where its value goes, and the products that a sum has beside its terms.
#[derive(Clone, Debug)]
struct Step {
    to: Row,
    op: Op<f64>,
    products: Vec<Product>,
}

/// The operations of a tape.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Those on inputs that do not move, done once for many states.
    fixed: Vec<Step>,
    moving: Vec<Step>,
    /// How many inputs move; they stand first.
    inputs: usize,
    rows: usize,
    results: Vec<Row>,
}

impl Program {
    /// That of a tape of which so many of the first inputs move.
    pub fn new(tape: Tape<f64>, inputs: usize) -> Self {
        let rows = tape.rows as usize;
        let (mut moves, mut uses) = (vec![false; rows], vec![0; rows]);
        moves[..inputs].fill(true);
        for (to, op) in &tape.ops {
            let is_sum = matches!(op, Op::Sum { .. });
            for row in op.operands() {
                moves[to.at()] |= moves[row.at()];
                // A use by what is no sum counts as several.
                uses[row.at()] += if is_sum { 1 } else { 2 };
            }
            if let Op::SinCos(_) = op {
                moves[to.at() + 1] = moves[to.at()];
            }
        }
        tape.results.iter().for_each(|row| uses[row.at()] += 2);
        let mut program = Program { fixed: vec![], moving: vec![], inputs, rows, results: tape.results };
        let mut taken: Vec<Option<[Row; 2]>> = vec![None; rows];
        for (to, mut op) in tape.ops {
            let mut products = vec![];
            match &mut op {
                &mut Op::Product(a, b) if uses[to.at()] == 1 && moves[to.at()] => {
                    taken[to.at()] = Some([a, b]);
                    continue;
                }
                Op::Sum { terms, .. } => {
                    let product = |row: Row, factor| taken[row.at()].map(|of| Product { factor, of });
                    products.extend(terms.iter().filter_map(|term| product(term.row, term.factor)));
                    terms.retain(|term| taken[term.row.at()].is_none());
                }
                _ => {}
            }
            let steps = if moves[to.at()] { &mut program.moving } else { &mut program.fixed };
            steps.push(Step { to, op, products });
        }
        program
    }

    /// Memory for states side by side.
    pub fn memory<const B: usize>(&self) -> Vec<Block<B>> {
        vec![Block::of(0.0); self.rows]
    }

    /// Takes the inputs that do not move.
    pub fn fix<const B: usize>(&self, memory: &mut [Block<B>], inputs: &[Block<B>]) {
        memory[self.inputs..][..inputs.len()].copy_from_slice(inputs);
        self.fixed.iter().for_each(|step| step.run(memory));
    }

    /// Writes the first results at time `t` and state `y`, which are the inputs that move; the others were taken before.
    #[inline(always)]
    pub fn run<const B: usize>(&self, memory: &mut [Block<B>], t: f64, y: &[Block<B>], results: &mut [Block<B>]) {
        memory[0] = Block::of(t);
        memory[1..self.inputs].copy_from_slice(y);
        for step in &self.moving {
            step.run(memory);
        }
        for (to, row) in results.iter_mut().zip(&self.results) {
            *to = memory[row.at()];
        }
    }
}

impl Step {
    #[inline(always)]
    fn run<const B: usize>(&self, memory: &mut [Block<B>]) {
        let (known, to) = memory.split_at_mut(self.to.at());
        let of = |row: Row| &known[row.at()];
        match self.op {
            Op::Sum { constant, ref terms } => {
                let multiples = terms.iter().map(|term| (term.factor, of(term.row)));
                let products = self.products.iter().map(|product| {
                    let [a, b] = product.of;
                    (product.factor, of(a), of(b))
                });
                to[0].write_sum(constant, multiples, products);
            }
            Op::Product(a, b) => to[0].write([of(a), of(b)], |[a, b]| a * b),
            Op::Quotient(a, b) => to[0].write([of(a), of(b)], |[a, b]| a / b),
            Op::Inverse(x) => to[0].write([of(x)], |[x]| 1.0 / x),
            Op::SinCos(x) => {
                let (sin, cos) = to.split_at_mut(1);
                Block::write_sin_cos([&mut sin[0], &mut cos[0]], of(x));
            }
            Op::Sqrt(x) => to[0].write([of(x)], |[x]| x.sqrt()),
            Op::Exp(x) => to[0].write([of(x)], |[x]| real::exp(x)),
            Op::Ln(x) => to[0].write([of(x)], |[x]| real::ln(x)),
            Op::Atan2 { y, x, .. } => to[0].write([of(y), of(x)], |[y, x]| real::atan2(y, x)),
        }
    }
}
