//! Values side by side: one number of several mechanisms at once.

use super::real;
use multiversion::multiversion;

/// So many values, each computed as an `f64` would be, to the same bits; they begin where a register's do, whatever its width.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Block<const B: usize>(pub [f64; B]);

/// How many values stay in registers while they are computed: four of AVX-512, which compute while others wait.
pub const PART: usize = 32;

/// How many values fill the widest registers.
pub const WIDE: usize = 8;

/// Loops, and no closures that the compiler might leave as calls: those would not use the wide registers of their caller.
impl<const B: usize> Block<B> {
    /// The same value everywhere.
    #[inline(always)]
    pub fn of(value: f64) -> Self {
        Block([value; B])
    }

    /// Some of the values, side by side.
    #[inline(always)]
    pub fn part<const N: usize>(&self, part: usize) -> &[f64; N] {
        &self.0.as_chunks::<N>().0[part]
    }

    /// The same, to be written.
    #[inline(always)]
    pub fn part_mut<const N: usize>(&mut self, part: usize) -> &mut [f64; N] {
        &mut self.0.as_chunks_mut::<N>().0[part]
    }
}

/// A function of values, for each of those side by side.
#[inline(always)]
pub fn each<const N: usize, const K: usize>(of: [&[f64; N]; K], f: impl Fn([f64; K]) -> f64) -> [f64; N] {
    let mut made = [0.0; N];
    for (i, made) in made.iter_mut().enumerate() {
        let mut x = [0.0; K];
        for (x, of) in x.iter_mut().zip(of) {
            *x = of[i];
        }
        *made = f(x);
    }
    made
}

/// Adds a multiple of values to others.
#[inline(always)]
pub fn add<const N: usize>(sum: &mut [f64; N], factor: f64, x: &[f64; N]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += x * factor;
    }
}

/// Adds a multiple of products of values to others.
#[inline(always)]
pub fn add_product<const N: usize>(sum: &mut [f64; N], factor: f64, x: &[f64; N], y: &[f64; N]) {
    for ((sum, x), y) in sum.iter_mut().zip(x).zip(y) {
        *sum += x * y * factor;
    }
}

/// The sine and the cosine of values.
#[inline(always)]
pub fn sin_cos<const N: usize>(of: &[f64; N]) -> [[f64; N]; 2] {
    let (mut sin, mut cos) = (*of, *of);
    real::write_sin_cos(of, &mut sin, &mut cos);
    [sin, cos]
}

/// The same in the widest registers that the machine has.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
pub fn wide_sin_cos(of: &[f64; WIDE]) -> [[f64; WIDE]; 2] {
    sin_cos(of)
}

#[cfg(test)]
mod tests {
    use super::{real, Block};

    #[test]
    fn sine_and_cosine_have_the_bits_of_each_value_alone() {
        let odd = [0.0, -0.0, 5e-324, f64::NAN, f64::INFINITY, -7.1e9, 1.0e6, -2.3];
        let odd = Block::<64>(std::array::from_fn(|i| odd[i % odd.len()]));
        let blocks = (0..500).map(|k| Block(std::array::from_fn(|i| f64::from(k * 64 + i as i32 - 16000) * 0.0171)));
        for x in blocks.chain([odd]) {
            let [s, c] = super::sin_cos(&x.0);
            let wide = x.0.as_chunks().0.iter().map(super::wide_sin_cos).flat_map(|[s, c]| s.into_iter().zip(c));
            for (i, wide) in wide.enumerate() {
                let (sin, cos) = real::sin_cos(x.0[i]);
                let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                assert!(same(s[i], sin) && same(c[i], cos), "{}", x.0[i]);
                assert!(same(wide.0, sin) && same(wide.1, cos), "{}", x.0[i]);
            }
        }
    }
}
