//! A program as machine code for one state: values stay in registers while they are needed.

use super::machine_code::{Assembler, Code, Instruction, Operand};
use super::program::{Product, Program, Sum};
use super::tape::{Op, Row, Term};
use crate::scalar::{block, real, Block};
use std::collections::VecDeque;

/// A change of what a row holds, or a need of it by the operation with this number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    Write,
    Read(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Register {
    Free,
    /// What an operation works in.
    Taken,
    Holds {
        row: Row,
        is_in_memory: bool,
    },
}

/// The state of the registers while operations are written.
struct Writer {
    code: Assembler,
    registers: [Register; 16],
    /// What is still to come, of each row.
    ahead: Vec<VecDeque<Event>>,
    /// Rows beside each other where angles stand, each to become its sine, with a row for the cosine.
    angles: Vec<Row>,
}

/// The operations of a program on inputs that move; None where the system lets no code be made.
pub(super) fn code(program: &Program) -> Option<Code> {
    let registers = [Register::Free; 16];
    let mut writer = Writer { code: Assembler::new(), registers, ahead: events(program), angles: vec![] };
    for (to, op, terms, products) in program.moving.steps() {
        writer.write(to, op, terms, products);
    }
    writer.turn();
    writer.flush();
    writer.code.finish()
}

/// What comes of each row, in its order.
fn events(program: &Program) -> Vec<VecDeque<Event>> {
    let mut ahead = vec![VecDeque::new(); program.rows];
    for (i, (to, op, terms, products)) in program.moving.steps().enumerate() {
        let own = op.operands_with(|sum| vec![sum.start]);
        let added = terms.iter().map(|term| term.row).chain(products.iter().flat_map(|product| product.of));
        own.into_iter().chain(added).for_each(|row| ahead[row.at()].push_back(Event::Read(i)));
        op.values(to).for_each(|row| ahead[row.at()].push_back(Event::Write));
    }
    program.results.iter().for_each(|(row, _)| ahead[row.at()].push_back(Event::Read(usize::MAX)));
    ahead
}

impl Writer {
    fn write(&mut self, to: Row, op: &Op<(), Sum>, terms: &[Term<f64>], products: &[Product]) {
        if let Op::SinCos(x) = *op {
            return self.angle(x, to);
        }
        self.turn();
        let made = match *op {
            Op::Sum { terms: Sum { start, .. }, .. } => self.sum(start, terms, products),
            Op::Product(a, b) => self.product(a, b),
            Op::Quotient(a, b) => {
                let above = self.own(a);
                self.apply(Instruction::Div, above, b)
            }
            Op::Inverse(x) => {
                let above = self.take();
                self.code.push(Instruction::Load, above, Operand::Constant(1.0));
                self.apply(Instruction::Div, above, x)
            }
            Op::Sqrt(x) => {
                let made = self.own(x);
                self.code.push(Instruction::Sqrt, made, Operand::Register(made));
                made
            }
            Op::SinCos(_) => unreachable!("angles are gathered"),
            Op::Exp(x) => return self.call(exp as *const (), &[x], &[to]),
            Op::Ln(x) => return self.call(ln as *const (), &[x], &[to]),
            Op::Atan2 { y, x, .. } => return self.call(atan2 as *const (), &[y, x], &[to]),
        };
        self.put(to, made);
    }

    fn sum(&mut self, start: Row, terms: &[Term<f64>], products: &[Product]) -> u8 {
        let sum = self.own(start);
        for &Term { row, factor } in terms {
            if factor.abs() == 1.0 {
                let x = self.read(row);
                self.code.push(if factor > 0.0 { Instruction::Add } else { Instruction::Sub }, sum, x);
                continue;
            }
            let x = self.own(row);
            self.add(sum, factor, x);
        }
        for &Product { factor, of: [a, b] } in products {
            let x = self.product(a, b);
            self.add(sum, factor, x);
        }
        sum
    }

    /// Adds a multiple of what stands in a register, which then is free.
    fn add(&mut self, sum: u8, factor: f64, x: u8) {
        if factor.abs() != 1.0 {
            self.code.push(Instruction::Mul, x, Operand::Constant(factor));
        }
        // A factor −1 changes nothing but the sign.
        let instruction = if factor == -1.0 { Instruction::Sub } else { Instruction::Add };
        self.code.push(instruction, sum, Operand::Register(x));
        self.registers[usize::from(x)] = Register::Free;
    }

    fn product(&mut self, a: Row, b: Row) -> u8 {
        // The one that nothing else needs leaves its register.
        let [a, b] = if self.is_last(b) && !self.is_last(a) { [b, a] } else { [a, b] };
        let product = self.own(a);
        self.apply(Instruction::Mul, product, b)
    }

    fn apply(&mut self, instruction: Instruction, register: u8, of: Row) -> u8 {
        let of = self.read(of);
        self.code.push(instruction, register, of);
        register
    }

    /// Puts an angle beside others.
    fn angle(&mut self, x: Row, to: Row) {
        let is_beside = self.angles.last().is_none_or(|last| last.0 + 2 == to.0);
        let is_known = self.angles.iter().all(|angle| x != *angle && x.0 != angle.0 + 1);
        if !(is_beside && is_known) || self.angles.len() == SIN_COS.len() {
            self.turn();
        }
        let angle = self.own(x);
        self.code.push(Instruction::Store, angle, Operand::Memory(to));
        self.registers[usize::from(angle)] = Register::Free;
        self.angles.push(to);
    }

    /// Makes sines and cosines of the angles that are beside each other.
    fn turn(&mut self) {
        let angles = std::mem::take(&mut self.angles);
        if let Some(&first) = angles.first() {
            self.flush();
            self.code.call(SIN_COS[angles.len() - 1], first);
        }
        for row in angles.into_iter().flat_map(|sin| [sin, Row(sin.0 + 1)]) {
            self.ahead[row.at()].pop_front();
        }
    }

    /// Calls a function, which writes its values where they stand in memory.
    fn call(&mut self, function: *const (), of: &[Row], to: &[Row]) {
        self.flush();
        for (i, &row) in of.iter().enumerate() {
            self.code.push(Instruction::Load, i as u8, Operand::Memory(row));
            self.ahead[row.at()].pop_front();
        }
        self.code.call(function, to[0]);
        for row in to {
            self.ahead[row.at()].pop_front();
        }
    }

    /// When the value of a row is needed next, if ever.
    fn next(&self, row: Row) -> Option<usize> {
        match self.ahead[row.at()].front() {
            Some(Event::Read(when)) => Some(*when),
            _ => None,
        }
    }

    fn is_last(&self, row: Row) -> bool {
        !matches!(self.ahead[row.at()].get(1), Some(Event::Read(_)))
    }

    fn holding(&self, row: Row) -> Option<u8> {
        let holds = |register: &Register| matches!(register, Register::Holds { row: held, .. } if *held == row);
        self.registers.iter().position(holds).map(|i| i as u8)
    }

    /// The value of a row for an operation; it stays in a register where others need it.
    fn read(&mut self, row: Row) -> Operand {
        self.ahead[row.at()].pop_front();
        let held = self.holding(row);
        if self.next(row).is_none() {
            held.into_iter().for_each(|i| self.registers[usize::from(i)] = Register::Free);
            return held.map_or(Operand::Memory(row), Operand::Register);
        }
        Operand::Register(held.unwrap_or_else(|| {
            let register = self.take();
            self.code.push(Instruction::Load, register, Operand::Memory(row));
            self.registers[usize::from(register)] = Register::Holds { row, is_in_memory: true };
            register
        }))
    }

    /// A register with the value of a row, to be changed.
    fn own(&mut self, row: Row) -> u8 {
        let held = self.read(row);
        let register = match held {
            Operand::Register(register) if self.next(row).is_none() => register,
            _ => self.take(),
        };
        self.registers[usize::from(register)] = Register::Taken;
        match held {
            Operand::Register(same) if same == register => {}
            Operand::Register(_) => self.code.push(Instruction::Copy, register, held),
            _ => self.code.push(Instruction::Load, register, held),
        }
        register
    }

    /// A register to work in; where none is free, that of the value that is needed last (Belady 1966, *IBM Systems Journal* 5, 78).
    fn take(&mut self) -> u8 {
        let wait = |register: &Register| match *register {
            Register::Holds { row, .. } => self.next(row),
            _ => None,
        };
        let free = self.registers.iter().position(|register| *register == Register::Free);
        let taken = free.or_else(|| (0..16).max_by_key(|&i| wait(&self.registers[i]))).expect("there are registers");
        self.leave(taken);
        self.registers[taken] = Register::Taken;
        taken as u8
    }

    /// Sees to it that what a register holds stands in memory.
    fn leave(&mut self, i: usize) {
        if let Register::Holds { row, is_in_memory: false } = self.registers[i] {
            self.code.push(Instruction::Store, i as u8, Operand::Memory(row));
        }
        self.registers[i] = Register::Free;
    }

    fn flush(&mut self) {
        (0..16).for_each(|i| self.leave(i));
    }

    /// Gives a row the value that stands in a register.
    fn put(&mut self, row: Row, register: u8) {
        self.ahead[row.at()].pop_front();
        let holds = Register::Holds { row, is_in_memory: false };
        self.registers[usize::from(register)] = if self.next(row).is_some() { holds } else { Register::Free };
    }
}

/// Of one angle, of two, …
const SIN_COS: [*const (); 4] =
    [sin_cos::<1> as *const (), sin_cos::<2> as *const (), sin_cos::<3> as *const (), sin_cos::<4> as *const ()];

extern "sysv64" fn sin_cos<const N: usize>(rows: &mut [[Block<1>; 2]; N]) {
    let made = block::sin_cos(&rows.map(|[angle, _]| angle.0[0]));
    *rows = std::array::from_fn(|i| made.map(|made| Block::of(made[i])));
}

extern "sysv64" fn exp(to: &mut Block<1>, x: f64) {
    *to = Block::of(real::exp(x));
}

extern "sysv64" fn ln(to: &mut Block<1>, x: f64) {
    *to = Block::of(real::ln(x));
}

extern "sysv64" fn atan2(to: &mut Block<1>, y: f64, x: f64) {
    *to = Block::of(real::atan2(y, x));
}
