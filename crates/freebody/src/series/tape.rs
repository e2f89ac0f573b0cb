//! The equations of motion as a list of operations.

use crate::scalar::{DoubleDouble, Scalar};

/// The place of a number of the tape: the inputs, as time and the state, then what the operations give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Row(pub(super) u32);

impl Row {
    #[inline(always)]
    pub(super) fn at(self) -> usize {
        self.0 as usize
    }
}

/// A multiple of a number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term<S> {
    pub row: Row,
    pub factor: S,
}

/// An operation on numbers that stand before it.
#[derive(Clone, Debug)]
pub(super) enum Op<S, T = Vec<Term<S>>> {
    Sum {
        constant: S,
        terms: T,
    },
    Product(Row, Row),
    Quotient(Row, Row),
    Inverse(Row),
    /// Gives two numbers.
    SinCos(Row),
    Sqrt(Row),
    Exp(Row),
    Ln(Row),
    /// The angle of a point (x, y) at this distance squared.
    Atan2 {
        y: Row,
        x: Row,
        radius2: Row,
    },
}

/// Results as functions of inputs, as ẏ of t and y.
#[derive(Clone, Debug)]
pub struct Tape<S> {
    /// Each with the place of its first number.
    pub(super) ops: Vec<(Row, Op<S>)>,
    pub(super) rows: u32,
    /// Where the results stand.
    pub(super) results: Vec<Row>,
}

impl<S, T> Op<S, T> {
    /// The numbers that its value follows from; those of a sum are asked for.
    pub fn operands_with(&self, of_sum: impl FnOnce(&T) -> Vec<Row>) -> Vec<Row> {
        match self {
            Op::Sum { terms, .. } => of_sum(terms),
            Op::Product(a, b) | Op::Quotient(a, b) | Op::Atan2 { y: a, x: b, .. } => vec![*a, *b],
            Op::Inverse(x) | Op::SinCos(x) | Op::Sqrt(x) | Op::Exp(x) | Op::Ln(x) => vec![*x],
        }
    }

    /// The places of its values, from the first on.
    pub fn values(&self, first: Row) -> impl Iterator<Item = Row> {
        let count = if matches!(self, Op::SinCos(_)) { 2 } else { 1 };
        (first.0..first.0 + count).map(Row)
    }
}

impl<S> Op<S> {
    /// The numbers that its value follows from.
    pub fn operands(&self) -> Vec<Row> {
        self.operands_with(|terms| terms.iter().map(|term| term.row).collect())
    }
}

impl<S: Copy> Op<S> {
    /// The same with every row, every constant and the terms of a sum replaced.
    pub fn map<T, U>(
        &self,
        row: impl Fn(Row) -> Row,
        number: impl Fn(S) -> T,
        terms: impl FnOnce(&[Term<S>]) -> U,
    ) -> Op<T, U> {
        match *self {
            Op::Sum { constant, terms: ref own } => Op::Sum { constant: number(constant), terms: terms(own) },
            Op::Product(a, b) => Op::Product(row(a), row(b)),
            Op::Quotient(a, b) => Op::Quotient(row(a), row(b)),
            Op::Inverse(b) => Op::Inverse(row(b)),
            Op::SinCos(a) => Op::SinCos(row(a)),
            Op::Sqrt(a) => Op::Sqrt(row(a)),
            Op::Exp(a) => Op::Exp(row(a)),
            Op::Ln(a) => Op::Ln(row(a)),
            Op::Atan2 { y, x, radius2 } => Op::Atan2 { y: row(y), x: row(x), radius2: row(radius2) },
        }
    }
}

impl<S> Tape<S> {
    pub(super) fn new(inputs: usize) -> Self {
        Tape { ops: vec![], rows: inputs as u32, results: vec![] }
    }

    pub(super) fn push(&mut self, op: Op<S>) -> Row {
        self.ops.push((Row(self.rows), op));
        self.rows += 1;
        Row(self.rows - 1)
    }

    pub(super) fn push_pair(&mut self, op: Op<S>) -> (Row, Row) {
        let first = self.push(op);
        self.rows += 1;
        (first, Row(first.0 + 1))
    }
}

impl<S: Copy> Tape<S> {
    /// The same with every row and constant replaced.
    fn map<T>(&self, row: impl Fn(Row) -> Row, number: impl Fn(S) -> T) -> Tape<T> {
        let term = |term: &Term<S>| Term { row: row(term.row), factor: number(term.factor) };
        let replaced = |op: &Op<S>| op.map(&row, &number, |terms| terms.iter().map(term).collect());
        let ops = self.ops.iter().map(|(at, op)| (row(*at), replaced(op))).collect();
        Tape { ops, rows: self.rows, results: self.results.iter().map(|&result| row(result)).collect() }
    }

    /// The same with quotients for products with inverses that nothing else needs.
    pub(super) fn divided(mut self) -> Self {
        let mut uses = vec![0; self.rows as usize];
        let operands = self.ops.iter().flat_map(|(_, op)| op.operands());
        operands.chain(self.results.iter().copied()).for_each(|row| uses[row.at()] += 1);
        let mut below = vec![None; self.rows as usize];
        for (row, op) in &mut self.ops {
            match *op {
                Op::Inverse(of) if uses[row.at()] == 1 => below[row.at()] = Some(of),
                Op::Product(a, b) => {
                    if let Some((above, by)) = [(a, b), (b, a)].into_iter().find(|(_, b)| below[b.at()].is_some()) {
                        uses[by.at()] = 0;
                        *op = Op::Quotient(above, below[by.at()].take().expect("it was found"));
                    }
                }
                _ => {}
            }
        }
        self.ops.retain(|(row, op)| !matches!(op, Op::Inverse(_)) || uses[row.at()] > 0);
        self
    }

    /// The same with rows this far apart.
    pub(super) fn spread(&self, stride: u32) -> Self {
        self.map(|row| Row(row.0 * stride), |x| x)
    }
}

impl Tape<DoubleDouble> {
    /// The same with rounded constants.
    pub fn rounded(&self) -> Tape<f64> {
        self.map(|row| row, DoubleDouble::value)
    }
}
