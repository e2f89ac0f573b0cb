//! What is written while a formula is recorded: sums of products, each product once.

use super::tape::{Op, Row, Tape, Term};
use crate::scalar::{DoubleDouble, Scalar};
use rustc_hash::FxHashMap;
use smallvec::{smallvec, SmallVec};

/// The position of a number of the formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FormId(u32);

/// The position of an operation that is no sum.
type AtomId = u32;

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Function {
    Sin,
    Cos,
    Sqrt,
    Exp,
    Ln,
}

/// A constant and multiples of atoms, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Form {
    constant: DoubleDouble,
    terms: Terms,
}

/// Few in most forms.
type Terms = SmallVec<[(AtomId, DoubleDouble); 4]>;

/// What is not a sum of others; one operation has one atom.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Atom {
    Input,
    /// A sum that stands in a product or in a function, by its constant and terms.
    Sum(Bits, Vec<(AtomId, Bits)>),
    /// Factors in their order.
    Product(Vec<AtomId>),
    /// Of the argument.
    Of(Function, AtomId),
    Quotient(AtomId, AtomId),
    Inverse(AtomId),
    Atan2(AtomId, AtomId),
}

/// A constant, to be compared.
type Bits = [u64; 2];

fn bits(x: DoubleDouble) -> Bits {
    [x.hi.to_bits(), x.lo.to_bits()]
}

fn number(x: Bits) -> DoubleDouble {
    DoubleDouble { hi: f64::from_bits(x[0]), lo: f64::from_bits(x[1]) }
}

/// Most products that a product of sums is multiplied out to: then what cancels is seen to.
const EXPANDED: usize = 2;
/// Most terms of a sum that others take over term by term: what runs along a chain does not grow with it.
const TERMS: usize = 8;
/// Most factors of a product.
const FACTORS: usize = 4;

impl Form {
    pub fn constant(constant: DoubleDouble) -> Self {
        Form { constant, terms: Terms::new() }
    }
    fn atom(atom: AtomId) -> Self {
        Form { terms: smallvec![(atom, DoubleDouble::one())], ..Form::default() }
    }
    fn scaled(&self, factor: DoubleDouble) -> Self {
        let terms = self.terms.iter().filter(|_| factor.hi != 0.0).map(|&(atom, x)| (atom, x * factor)).collect();
        Form { constant: self.constant * factor, terms }
    }
    fn plus(&self, o: &Form, factor: DoubleDouble) -> Self {
        let mut terms = Terms::with_capacity(self.terms.len() + o.terms.len());
        let (mut a, mut b) = (self.terms.iter().peekable(), o.terms.iter().peekable());
        loop {
            let (x, y) = (a.peek().copied(), b.peek().copied());
            let first = x.map_or(u32::MAX, |x| x.0).min(y.map_or(u32::MAX, |y| y.0));
            let mut sum = DoubleDouble::default();
            if x.is_none() && y.is_none() {
                break;
            }
            if let Some(x) = a.next_if(|x| x.0 == first) {
                sum += x.1;
            }
            if let Some(y) = b.next_if(|y| y.0 == first) {
                sum += y.1 * factor;
            }
            if sum.hi != 0.0 {
                terms.push((first, sum));
            }
        }
        Form { constant: self.constant + o.constant * factor, terms }
    }
}

/// Factors less others of them; None where they are not all there.
fn without(mut factors: Vec<AtomId>, others: &[AtomId]) -> Option<Vec<AtomId>> {
    for other in others {
        factors.remove(factors.iter().position(|factor| factor == other)?);
    }
    Some(factors)
}

/// The arena of one recording.
#[derive(Default)]
pub(super) struct Recorder {
    forms: Vec<Form>,
    atoms: Vec<Atom>,
    known: FxHashMap<Atom, AtomId>,
}

impl Recorder {
    pub fn form(&mut self, form: Form) -> FormId {
        self.forms.push(form);
        FormId(self.forms.len() as u32 - 1)
    }
    fn read(&self, form: FormId) -> &Form {
        &self.forms[form.0 as usize]
    }
    /// The next variable.
    pub fn input(&mut self) -> FormId {
        self.atoms.push(Atom::Input);
        self.form(Form::atom(self.atoms.len() as u32 - 1))
    }
    fn atom(&mut self, atom: Atom) -> AtomId {
        if let Some(&known) = self.known.get(&atom) {
            return known;
        }
        self.atoms.push(atom.clone());
        let id = self.atoms.len() as u32 - 1;
        self.known.insert(atom, id);
        id
    }
    pub fn as_constant(&self, form: FormId) -> Option<DoubleDouble> {
        let form = self.read(form);
        form.terms.is_empty().then_some(form.constant)
    }
    /// a + factor·b.
    pub fn combine(&mut self, a: FormId, b: FormId, factor: f64) -> FormId {
        let mut sum = self.read(a).plus(self.read(b), DoubleDouble::of(factor));
        if sum.terms.len() > TERMS {
            let (atom, factor) = self.factor(&sum);
            sum = Form::atom(atom).scaled(factor);
        }
        self.form(sum)
    }

    pub fn multiply(&mut self, a: FormId, b: FormId) -> FormId {
        let (a, b) = (self.read(a).clone(), self.read(b).clone());
        let product = self.product(&a, &b);
        self.form(product)
    }

    fn product(&mut self, a: &Form, b: &Form) -> Form {
        let outer = Form { constant: a.constant * b.constant, terms: Terms::new() };
        let (left, right) =
            (Form { terms: a.terms.clone(), ..Form::default() }, Form { terms: b.terms.clone(), ..Form::default() });
        let mut sum = outer.plus(&left, b.constant).plus(&right, a.constant);
        if left.terms.len() * right.terms.len() <= EXPANDED {
            for &(x, p) in &left.terms {
                for &(y, q) in &right.terms {
                    let product = self.product_of_atoms(x, y);
                    sum = sum.plus(&product, p * q);
                }
            }
            return sum;
        }
        let ((x, p), (y, q)) = (self.factor(&left), self.factor(&right));
        let product = self.product_of_atoms(x, y);
        sum.plus(&product, p * q)
    }

    /// A sum as one atom times a constant.
    fn factor(&mut self, form: &Form) -> (AtomId, DoubleDouble) {
        match form.terms[..] {
            [(atom, factor)] if form.constant.hi == 0.0 => (atom, factor),
            _ => {
                let lead = form.terms[0].1;
                let terms = form.terms.iter().map(|&(atom, x)| (atom, bits(x / lead))).collect();
                (self.atom(Atom::Sum(bits(form.constant / lead), terms)), lead)
            }
        }
    }

    fn factors(&self, atom: AtomId) -> Vec<AtomId> {
        match &self.atoms[atom as usize] {
            Atom::Product(factors) => factors.clone(),
            _ => vec![atom],
        }
    }

    /// A square of a sine is one of the cosine.
    fn product_of_atoms(&mut self, a: AtomId, b: AtomId) -> Form {
        let mut factors = [self.factors(a), self.factors(b)].concat();
        if factors.len() > FACTORS {
            factors = vec![a, b];
        }
        factors.sort_unstable();
        for i in 1..factors.len() {
            let Atom::Of(Function::Sin, angle) = self.atoms[factors[i] as usize] else { continue };
            if factors[i - 1] == factors[i] {
                factors.drain(i - 1..=i);
                let rest = if factors.is_empty() {
                    Form::constant(DoubleDouble::one())
                } else {
                    Form::atom(self.monomial(factors))
                };
                let cos = self.atom(Atom::Of(Function::Cos, angle));
                let square = self.product_of_atoms(cos, cos);
                let taken = self.product(&rest, &square);
                return rest.plus(&taken, DoubleDouble::of(-1.0));
            }
        }
        Form::atom(self.monomial(factors))
    }

    fn monomial(&mut self, factors: Vec<AtomId>) -> AtomId {
        match factors[..] {
            [one] => one,
            _ => {
                if factors.len() > 2 {
                    self.monomial(factors[..factors.len() - 1].to_vec());
                }
                self.atom(Atom::Product(factors))
            }
        }
    }

    /// A sum with what its products have in common before brackets.
    fn bracketed(&mut self, mut sum: Form) -> Form {
        while let Some(common) = self.most_in_common(&sum.terms) {
            let (mut inner, mut rest) = (Form::default(), Form { constant: sum.constant, terms: Terms::new() });
            for &(atom, x) in &sum.terms {
                match without(self.factors(atom), &common) {
                    None => rest.terms.push((atom, x)),
                    Some(left) if left.is_empty() => inner.constant = x,
                    Some(left) => inner.terms.push((self.monomial(left), x)),
                }
            }
            inner.terms.sort_unstable_by_key(|term| term.0);
            let inner = self.bracketed(inner);
            let (bracket, lead) = self.factor(&inner);
            let mut factors = [common, self.factors(bracket)].concat();
            factors.sort_unstable();
            sum = rest.plus(&Form::atom(self.monomial(factors)), lead);
        }
        sum
    }

    /// The most factors that two terms share, if any.
    fn most_in_common(&self, terms: &[(AtomId, DoubleDouble)]) -> Option<Vec<AtomId>> {
        let mut most = vec![];
        for (i, &(a, _)) in terms.iter().enumerate() {
            let factors = self.factors(a);
            for &(b, _) in &terms[..i] {
                let mut others = self.factors(b);
                let is_shared = |x: &&AtomId| others.iter().position(|y| y == *x).map(|at| others.remove(at)).is_some();
                let common: Vec<AtomId> = factors.iter().filter(is_shared).copied().collect();
                if common.len() > most.len() {
                    most = common;
                }
            }
        }
        Some(most).filter(|most| !most.is_empty())
    }

    pub fn divide(&mut self, a: FormId, b: FormId) -> FormId {
        let (a, b) = (self.read(a).clone(), self.read(b).clone());
        if b.terms.is_empty() {
            return self.form(a.scaled(DoubleDouble::one() / b.constant));
        }
        let (below, q) = self.factor(&b);
        if a.terms.is_empty() {
            let inverse = Form::atom(self.atom(Atom::Inverse(below)));
            return self.form(inverse.scaled(a.constant / q));
        }
        let (above, p) = self.factor(&a);
        let quotient = Form::atom(self.atom(Atom::Quotient(above, below)));
        self.form(quotient.scaled(p / q))
    }

    /// A function of what is no constant.
    pub fn apply(&mut self, function: Function, of: FormId) -> FormId {
        let of = self.argument(of);
        let atom = self.atom(Atom::Of(function, of));
        self.form(Form::atom(atom))
    }

    pub fn atan2(&mut self, y: FormId, x: FormId) -> FormId {
        if let (Some(y), Some(x)) = (self.as_constant(y), self.as_constant(x)) {
            return self.form(Form::constant(y.atan2(x)));
        }
        let (y, x) = (self.argument(y), self.argument(x));
        let atom = self.atom(Atom::Atan2(y, x));
        self.form(Form::atom(atom))
    }

    /// A number as an atom.
    fn argument(&mut self, form: FormId) -> AtomId {
        let form = self.read(form).clone();
        match form.terms[..] {
            [(atom, factor)] if form.constant.hi == 0.0 && factor == DoubleDouble::one() => atom,
            _ => {
                let terms = form.terms.iter().map(|&(atom, x)| (atom, bits(x))).collect();
                self.atom(Atom::Sum(bits(form.constant), terms))
            }
        }
    }

    /// The operations that the results need, in an order in which each is known before it is used.
    pub fn tape(mut self, inputs: usize, results: &[FormId]) -> Tape<DoubleDouble> {
        let results: Vec<AtomId> = results.iter().map(|&result| self.argument(result)).collect();
        let mut tape = Tape::new(inputs);
        let mut rows = (0..inputs as AtomId).map(|input| (input, Row(input))).collect();
        let results = results.iter().map(|&result| self.lower(result, &mut rows, &mut tape)).collect();
        Tape { results, ..tape }
    }

    /// The row of an atom, its operation written to the tape where it is new.
    fn lower(&mut self, atom: AtomId, rows: &mut FxHashMap<AtomId, Row>, tape: &mut Tape<DoubleDouble>) -> Row {
        if let Some(&row) = rows.get(&atom) {
            return row;
        }
        let mut of = |recorder: &mut Self, atom| recorder.lower(atom, rows, tape);
        let op = match self.atoms[atom as usize].clone() {
            Atom::Input => unreachable!("inputs have rows"),
            Atom::Sum(constant, terms) => {
                let terms = terms.iter().map(|&(atom, x)| (atom, number(x))).collect();
                let sum = self.bracketed(Form { constant: number(constant), terms });
                let mut of = |recorder: &mut Self, atom| recorder.lower(atom, rows, tape);
                let terms = sum.terms.iter().map(|&(atom, factor)| Term { row: of(self, atom), factor }).collect();
                Op::Sum { constant: sum.constant, terms }
            }
            Atom::Product(factors) => {
                let (last, rest) = factors.split_last().expect("a product has factors");
                let first = self.monomial(rest.to_vec());
                Op::Product(of(self, first), of(self, *last))
            }
            Atom::Of(Function::Sin | Function::Cos, angle) => {
                let angle_row = of(self, angle);
                let (sin, cos) = tape.push_pair(Op::SinCos(angle_row));
                for (function, row) in [(Function::Sin, sin), (Function::Cos, cos)] {
                    let id = self.atom(Atom::Of(function, angle));
                    rows.insert(id, row);
                }
                return rows[&atom];
            }
            Atom::Of(Function::Sqrt, x) => Op::Sqrt(of(self, x)),
            Atom::Of(Function::Exp, x) => Op::Exp(of(self, x)),
            Atom::Of(Function::Ln, x) => Op::Ln(of(self, x)),
            Atom::Quotient(a, b) => Op::Quotient(of(self, a), of(self, b)),
            Atom::Inverse(b) => Op::Inverse(of(self, b)),
            Atom::Atan2(y, x) => {
                let (y, x) = (of(self, y), of(self, x));
                let square = |tape: &mut Tape<DoubleDouble>, row| tape.push(Op::Product(row, row));
                let (yy, xx) = (square(tape, y), square(tape, x));
                let one = DoubleDouble::one();
                let terms = vec![Term { row: yy, factor: one }, Term { row: xx, factor: one }];
                let radius2 = tape.push(Op::Sum { constant: DoubleDouble::default(), terms });
                Op::Atan2 { y, x, radius2 }
            }
        };
        let row = tape.push(op);
        rows.insert(atom, row);
        row
    }
}
