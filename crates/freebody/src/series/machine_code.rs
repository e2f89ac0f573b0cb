//! Machine code of x86-64 for doubles, as much of it as a program takes: of SSE2, which every such processor has, and nothing fused. The
//! bytes are those of the *Intel 64 and IA-32 Architectures Software Developer's Manual*, vol. 2.

use super::tape::Row;
use crate::scalar::Block;
use memmap2::{Mmap, MmapMut};
use rustc_hash::FxHashMap;

/// What stands on the right of an instruction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operand {
    /// One of xmm0 to xmm15.
    Register(u8),
    Memory(Row),
    Constant(f64),
}

/// What a register becomes by an operand, by its byte of operation.
#[derive(Clone, Copy, Debug)]
pub(super) enum Instruction {
    Load = 0x10,
    /// The other way.
    Store = 0x11,
    /// Of a whole register: it waits for nothing that was there.
    Copy = 0x28,
    Sqrt = 0x51,
    Add = 0x58,
    Mul = 0x59,
    Sub = 0x5c,
    Div = 0x5e,
}

/// A function that is being written, of memory whose address stands in rbx.
#[derive(Debug)]
pub(super) struct Assembler {
    bytes: Vec<u8>,
    /// Where each constant stands behind the function, by its bits.
    constants: FxHashMap<u64, usize>,
    /// Where the distances to constants are to be written.
    distances: Vec<(usize, usize)>,
    rows: usize,
}

/// A function of memory that can run; its place is given back when it is dropped.
#[derive(Debug)]
pub(super) struct Code {
    bytes: Mmap,
    /// How many rows of memory it knows.
    rows: usize,
}

impl Assembler {
    pub fn new() -> Self {
        // push rbx; mov rbx, rdi: now the stack is as calls expect it.
        let bytes = vec![0x53, 0x48, 0x89, 0xfb];
        Assembler { bytes, constants: FxHashMap::default(), distances: vec![], rows: 0 }
    }

    pub fn push(&mut self, instruction: Instruction, register: u8, operand: Operand) {
        let prefix = if matches!(instruction, Instruction::Copy) { 0x66 } else { 0xf2 };
        let other = if let Operand::Register(other) = operand { other } else { 0 };
        let high_bits = 0x40 | (register >> 3) << 2 | other >> 3;
        self.bytes.extend([prefix, high_bits, 0x0f, instruction as u8]);
        let register = (register & 7) << 3;
        match operand {
            Operand::Register(_) => self.bytes.push(0xc0 | register | other & 7),
            Operand::Memory(row) => self.push_address(register, row),
            Operand::Constant(x) => {
                self.bytes.push(register | 5);
                let next = self.constants.len();
                let constant = *self.constants.entry(x.to_bits()).or_insert(next);
                self.distances.push((self.bytes.len(), constant));
                self.bytes.extend([0; 4]);
            }
        }
    }

    /// The end of an instruction with a register and an address, told from rbx.
    fn push_address(&mut self, register: u8, row: Row) {
        self.rows = self.rows.max(row.at() + 1);
        self.bytes.push(0x80 | register | 3);
        self.bytes.extend(((row.at() * size_of::<Block<1>>()) as i32).to_le_bytes());
    }

    /// A call of what takes the address of a row, and doubles in xmm0 and xmm1; it leaves nothing in the registers.
    pub fn call(&mut self, function: *const (), row: Row) {
        // lea rdi, [rbx + …]; mov rax, …; call rax
        self.bytes.extend([0x48, 0x8d]);
        self.push_address(7 << 3, row);
        self.bytes.extend([0x48, 0xb8]);
        self.bytes.extend((function as u64).to_le_bytes());
        self.bytes.extend([0xff, 0xd0]);
    }

    /// The function; None where the system lets none be made.
    pub fn finish(mut self) -> Option<Code> {
        // pop rbx; ret
        self.bytes.extend([0x5b, 0xc3]);
        let end = self.bytes.len().next_multiple_of(size_of::<f64>());
        self.bytes.resize(end + self.constants.len() * size_of::<f64>(), 0);
        let place = |constant: usize| end + constant * size_of::<f64>();
        for (bits, constant) in self.constants {
            self.bytes[place(constant)..][..8].copy_from_slice(&bits.to_le_bytes());
        }
        for (at, constant) in self.distances {
            // From the end of the instruction.
            let distance = (place(constant) - (at + 4)) as i32;
            self.bytes[at..][..4].copy_from_slice(&distance.to_le_bytes());
        }
        let mut memory = MmapMut::map_anon(self.bytes.len()).ok()?;
        memory.copy_from_slice(&self.bytes);
        Some(Code { bytes: memory.make_exec().ok()?, rows: self.rows })
    }
}

impl Code {
    /// Runs it on memory.
    #[allow(unsafe_code)]
    pub fn run(&self, memory: &mut [Block<1>]) {
        assert!(memory.len() >= self.rows, "memory has the rows that it knows");
        // SAFETY: the bytes are those of an `Assembler`, from its first push to the return: a function of this convention, which gives back
        // rbx and the stack as they were, reads its own constants, and reads and writes rows below `rows` alone, which are there.
        let run = unsafe { std::mem::transmute::<*const u8, extern "sysv64" fn(*mut Block<1>)>(self.bytes.as_ptr()) };
        run(memory.as_mut_ptr());
    }
}
