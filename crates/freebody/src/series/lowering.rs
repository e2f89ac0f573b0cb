//! A tape made into a program: products within the sums that they belong to, values where others stood that are done with.

use super::program::{List, Product, Program, Sum};
use super::tape::{Op, Row, Tape, Term};

/// An operation, where its value goes, the value that a sum starts from, and the products that it has beside its terms.
struct Step {
    to: Row,
    op: Op<f64>,
    start: Option<Row>,
    products: Vec<Product>,
}

impl Program {
    /// That of a tape of which so many of the first inputs move.
    pub fn new(tape: Tape<f64>, inputs: usize) -> Self {
        let (moves, given) = (moving(&tape, inputs), tape.ops.first().map_or(tape.rows, |(to, _)| to.0));
        let mut places =
            Places { of: (0..tape.rows).map(Row).collect(), count: given, free: vec![], constants: vec![] };
        let results = tape.results.clone();
        let (moving, fixed): (Vec<_>, Vec<_>) = fused(tape, &moves).into_iter().partition(|step| moves[step.to.at()]);
        let moving = sines_first(moving, moves.len());
        let mut last: Vec<_> = moves.iter().map(|&moves| if moves { 0 } else { usize::MAX }).collect();
        for (i, step) in moving.iter().enumerate() {
            let rows = step.operands().into_iter().chain(step.values());
            rows.filter(|row| moves[row.at()]).for_each(|row| last[row.at()] = i);
        }
        results.iter().for_each(|row| last[row.at()] = usize::MAX);
        let mut program = Program { inputs, ..Program::default() };
        fixed.iter().for_each(|step| step.lower(&mut places, |_| false, &mut program.fixed));
        let mut steps = vec![0; moves.len()];
        for (i, step) in moving.iter().enumerate() {
            step.lower(&mut places, |row| last[row.at()] == i, &mut program.moving);
            step.values().for_each(|row| steps[row.at()] = i + 1);
        }
        program.results = results.iter().map(|row| (places.of[row.at()], steps[row.at()])).collect();
        Program { rows: places.count as usize, constants: places.constants, ..program }
    }
}

/// What follows from inputs that move.
fn moving(tape: &Tape<f64>, inputs: usize) -> Vec<bool> {
    let mut moves = vec![false; tape.rows as usize];
    moves[..inputs].fill(true);
    for (to, op) in &tape.ops {
        let is_moved = op.operands().iter().any(|row| moves[row.at()]);
        op.values(*to).for_each(|row| moves[row.at()] = is_moved);
    }
    moves
}

/// The operations, with each product that moves and that only one sum needs in it.
fn fused(tape: Tape<f64>, moves: &[bool]) -> Vec<Step> {
    let mut uses = vec![0; tape.rows as usize];
    for (_, op) in &tape.ops {
        // A use by what is no sum counts as several.
        let weight = if matches!(op, Op::Sum { .. }) { 1 } else { 2 };
        op.operands().iter().for_each(|row| uses[row.at()] += weight);
    }
    tape.results.iter().for_each(|row| uses[row.at()] += 2);
    let mut taken: Vec<Option<[Row; 2]>> = vec![None; tape.rows as usize];
    let mut steps = vec![];
    for (to, mut op) in tape.ops {
        let (mut start, mut products) = (None, vec![]);
        match &mut op {
            &mut Op::Product(a, b) if uses[to.at()] == 1 && moves[to.at()] => {
                taken[to.at()] = Some([a, b]);
                continue;
            }
            Op::Sum { constant, terms } => {
                let product = |row: Row, factor| taken[row.at()].map(|of| Product { factor, of });
                products.extend(terms.iter().filter_map(|term| product(term.row, term.factor)));
                terms.retain(|term| taken[term.row.at()].is_none());
                let lead = terms.iter().position(|term| term.factor == 1.0).filter(|_| *constant == 0.0);
                start = lead.map(|lead| terms.remove(lead).row);
            }
            _ => {}
        }
        steps.push(Step { to, op, start, products });
    }
    steps
}

/// The steps, with those sines that follow from no other one beside each other, before all that does not lead to them.
fn sines_first(mut steps: Vec<Step>, rows: usize) -> Vec<Step> {
    let (mut by_sines, mut leads) = (vec![false; rows], vec![false; rows]);
    for step in &steps {
        let is_by_sines = step.is_sine() || step.operands().iter().any(|row| by_sines[row.at()]);
        step.values().for_each(|row| by_sines[row.at()] = is_by_sines);
    }
    let is_first = |step: &Step| step.is_sine() && step.operands().iter().all(|row| !by_sines[row.at()]);
    for step in steps.iter().rev() {
        if is_first(step) || step.values().any(|row| leads[row.at()]) {
            step.operands().iter().for_each(|row| leads[row.at()] = true);
        }
    }
    steps.sort_by_key(|step| (!leads[step.to.at()], !is_first(step)));
    steps
}

impl Step {
    fn is_sine(&self) -> bool {
        matches!(self.op, Op::SinCos(_))
    }

    fn operands(&self) -> Vec<Row> {
        let mut operands = self.op.operands();
        operands.extend(self.start);
        operands.extend(self.products.iter().flat_map(|product| product.of));
        operands.sort_unstable();
        operands.dedup();
        operands
    }

    fn values(&self) -> impl Iterator<Item = Row> {
        self.op.values(self.to)
    }

    /// Writes it to a list, its values at free places; the places of what is done with then are free.
    fn lower(&self, places: &mut Places, is_done: impl Fn(Row) -> bool, list: &mut List) {
        let start = match (self.start, &self.op) {
            (None, Op::Sum { constant, .. }) => places.constant(*constant),
            (start, _) => start.map_or(self.to, |row| places.of[row.at()]),
        };
        let place = |row: Row| places.of[row.at()];
        let products = self.products.iter().map(|product| Product { of: product.of.map(place), ..*product });
        let next = |terms: &[Term<f64>]| {
            list.terms.extend(terms.iter().map(|term| Term { row: place(term.row), ..*term }));
            list.products.extend(products);
            Sum { start, terms: terms.len() as u32, products: self.products.len() as u32 }
        };
        let op = self.op.map(place, |_| (), next);
        places.leave(self.operands(), &is_done);
        places.take(self.values());
        places.leave(self.values(), &is_done);
        list.steps.push((places.of[self.to.at()], op));
    }
}

/// Where values stand.
struct Places {
    of: Vec<Row>,
    count: u32,
    free: Vec<Row>,
    constants: Vec<(Row, f64)>,
}

impl Places {
    /// The place of a constant.
    fn constant(&mut self, constant: f64) -> Row {
        let known = self.constants.iter().find(|(_, known)| known.to_bits() == constant.to_bits());
        known.map(|(row, _)| *row).unwrap_or_else(|| {
            self.constants.push((Row(self.count), constant));
            self.count += 1;
            Row(self.count - 1)
        })
    }

    /// Gives a value a place, or two values places beside each other.
    fn take(&mut self, mut values: impl Iterator<Item = Row>) {
        let (first, second) = (values.next().expect("an operation has a value"), values.next());
        let free = if second.is_none() { self.free.pop() } else { None };
        for value in [Some(first), second].into_iter().flatten() {
            self.of[value.at()] = free.unwrap_or(Row(self.count));
            self.count += u32::from(free.is_none());
        }
    }

    fn leave(&mut self, values: impl IntoIterator<Item = Row>, is_done: impl Fn(Row) -> bool) {
        let done = values.into_iter().filter(|&value| is_done(value));
        self.free.extend(done.map(|value| self.of[value.at()]));
    }
}
