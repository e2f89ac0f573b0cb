//! Values side by side: one number of several mechanisms at once.

use super::real;

/// So many values, each computed as an `f64` would be, to the same bits; they begin where a register's do, whatever its width.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Block<const B: usize>(pub [f64; B]);

/// Values whose sums stay in registers: four of AVX-512, which compute while others wait.
const PART: usize = 32;

/// Loops, and no closures that the compiler might leave as calls: those would not use the wide registers of their caller.
impl<const B: usize> Block<B> {
    /// The same value everywhere.
    #[inline(always)]
    pub fn of(value: f64) -> Self {
        Block([value; B])
    }

    /// Writes a function of the values of others.
    #[inline(always)]
    pub fn write<const N: usize>(&mut self, of: [&Self; N], f: impl Fn([f64; N]) -> f64) {
        for (i, to) in self.0.iter_mut().enumerate() {
            let mut x = [0.0; N];
            for (x, of) in x.iter_mut().zip(of) {
                *x = of.0[i];
            }
            *to = f(x);
        }
    }

    /// Writes the sum of a constant, multiples of others and multiples of products of two others.
    #[inline(always)]
    pub fn write_sum<'a>(
        &mut self,
        constant: f64,
        multiples: impl Iterator<Item = (f64, &'a Self)> + Clone,
        products: impl Iterator<Item = (f64, &'a Self, &'a Self)> + Clone,
    ) {
        match B % PART {
            0 => self.write_parts::<PART>(constant, multiples, products),
            _ => self.write_parts::<1>(constant, multiples, products),
        }
    }

    #[inline(always)]
    fn write_parts<'a, const N: usize>(
        &mut self,
        constant: f64,
        multiples: impl Iterator<Item = (f64, &'a Self)> + Clone,
        products: impl Iterator<Item = (f64, &'a Self, &'a Self)> + Clone,
    ) {
        for part in 0..B / N {
            let mut sum = [constant; N];
            for (factor, x) in multiples.clone() {
                let x = x.part::<N>(part);
                for (sum, x) in sum.iter_mut().zip(x) {
                    *sum += x * factor;
                }
            }
            for (factor, x, y) in products.clone() {
                let (x, y) = (x.part::<N>(part), y.part::<N>(part));
                for ((sum, x), y) in sum.iter_mut().zip(x).zip(y) {
                    *sum += x * y * factor;
                }
            }
            self.0.as_chunks_mut::<N>().0[part] = sum;
        }
    }

    #[inline(always)]
    fn part<const N: usize>(&self, part: usize) -> &[f64; N] {
        &self.0.as_chunks::<N>().0[part]
    }

    /// Writes the sine and the cosine of another.
    #[inline(always)]
    pub fn write_sin_cos([sin, cos]: [&mut Self; 2], of: &Self) {
        real::write_sin_cos(&of.0, &mut sin.0, &mut cos.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_have_the_bits_of_each_value_alone() {
        let odd = [0.0, -0.0, 5e-324, f64::NAN, f64::INFINITY, -7.1e9, 1.0e6, -2.3];
        let odd = Block::<64>(std::array::from_fn(|i| odd[i % odd.len()]));
        let blocks = (0..500).map(|k| Block(std::array::from_fn(|i| f64::from(k * 64 + i as i32 - 16000) * 0.0171)));
        for x in blocks.chain([odd]) {
            let (mut s, mut c) = (x, x);
            Block::write_sin_cos([&mut s, &mut c], &x);
            for i in 0..64 {
                let (sin, cos) = real::sin_cos(x.0[i]);
                let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                assert!(same(s.0[i], sin) && same(c.0[i], cos), "{}", x.0[i]);
            }
        }
    }
}
