//! Seeded random numbers (SplitMix64; Steele, Lea & Flood, *Fast splittable pseudorandom number generators*, 2014).

use std::iter::StepBy;
use std::ops::Range;

/// Seeds of a family that takes long: every `share`-th by default, all where the environment has `FREEBODY_ALL`.
pub fn seeds(all: Range<u64>, share: usize) -> StepBy<Range<u64>> {
    all.step_by(if std::env::var_os("FREEBODY_ALL").is_some() { 1 } else { share })
}

pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Rng(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Evenly in [a, b).
    pub fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    /// Evenly in [−a, a).
    pub fn about(&mut self, a: f64) -> f64 {
        self.within(-a, a)
    }
    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    pub fn chance(&mut self, p: f64) -> bool {
        self.within(0.0, 1.0) < p
    }
    pub fn sign(&mut self) -> f64 {
        if self.chance(0.5) {
            1.0
        } else {
            -1.0
        }
    }
    pub fn of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }
    pub fn vector(&mut self, n: usize, a: f64) -> Vec<f64> {
        (0..n).map(|_| self.about(a)).collect()
    }
}
