//! A program run for one state, as machine code where that can be.

#[cfg(target_arch = "x86_64")]
use super::native;
use super::program::Program;
use crate::scalar::Block;
use std::sync::Arc;

/// The operations of a program on inputs that move, and its memory.
#[derive(Debug)]
pub struct Alone {
    program: Arc<Program>,
    memory: Vec<Block<1>>,
}

impl Alone {
    /// That of a program with the inputs that do not move.
    pub fn new(program: &Arc<Program>, inputs: &[f64]) -> Self {
        let mut memory = program.memory();
        program.fix(&mut memory, &inputs.iter().map(|&x| Block::of(x)).collect::<Vec<_>>());
        Alone { program: Arc::clone(program), memory }
    }

    /// Makes the operations at a time and a state, of which two parts are given: the other inputs that move.
    pub fn run(&mut self, t: f64, [y, more]: [&[f64]; 2]) {
        self.memory[0] = Block([t]);
        self.memory[1..].iter_mut().zip(y.iter().chain(more)).for_each(|(to, &x)| *to = Block([x]));
        #[cfg(target_arch = "x86_64")]
        if let Some(code) = self.program.code.get_or_init(|| native::code(&self.program)) {
            return code.run(&mut self.memory);
        }
        self.program.moving.run::<1, 1>(self.program.moving.steps.len(), &mut self.memory);
    }

    /// Results of the last run, from one on.
    pub fn results(&self, from: usize) -> impl Iterator<Item = f64> + '_ {
        self.program.results[from..].iter().map(|(row, _)| self.memory[row.at()].0[0])
    }
}
