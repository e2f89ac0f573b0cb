//! Many motions at once by the classical Runge–Kutta method: nothing is looked for on the way.

use super::dense::{between, cubic};
use super::rk4::TABLE;
use super::run::end_of_step;
use crate::scalar::{block, Block};

/// When a march begins, ends, and shows its state, s; and the length of its steps.
#[derive(Clone, Copy, Debug)]
pub struct Span<'a> {
    /// Start.
    pub from: f64,
    /// End.
    pub to: f64,
    /// Length of a step; its sign is that of the way.
    pub step: f64,
    /// Times from start to end, in the order of the march.
    pub times: &'a [f64],
}

/// Carries states side by side along a span by the method `rk4` and shows them at each of its times: each what [`super::run()`] gives
/// for the same system without events, to the same bits. Answers which of them were finite all the way.
#[inline(always)]
pub fn march<const B: usize>(
    span: Span,
    start: &[Block<B>],
    mut rate: impl FnMut(f64, &[Block<B>], &mut [Block<B>]),
    mut show: impl FnMut(&[Block<B>]),
) -> [bool; B] {
    let mut k = vec![start.to_vec(); TABLE.b.len()];
    let [mut y, mut next, mut stage, mut slope] = [(); 4].map(|()| start.to_vec());
    let (mut t, mut shown) = (span.from, 0);
    rate(t, &y, &mut k[0]);
    while shown < span.times.len() && span.times[shown] == t {
        show(&y);
        shown += 1;
    }
    while t != span.to {
        let end = end_of_step(t, span.to, span.step);
        let h = end - t;
        for (j, (&c, a)) in TABLE.c.iter().zip(TABLE.a).enumerate() {
            let (known, rest) = k.split_at_mut(j + 1);
            go_ahead(&y, h, a, known, &mut stage);
            rate(t + c * h, &stage, &mut rest[0]);
        }
        go_ahead(&y, h, TABLE.b, &k, &mut next);
        rate(end, &next, &mut slope);
        while shown < span.times.len() && (span.times[shown] - end) * h <= 0.0 {
            let theta = (span.times[shown] - t) / h;
            for (i, stage) in stage.iter_mut().enumerate() {
                match span.times[shown] == end {
                    true => *stage = next[i],
                    false => {
                        let ends = [&y[i].0, &next[i].0, &k[0][i].0, &slope[i].0];
                        stage.0 = block::each(ends, |[y0, y1, slope0, slope1]| {
                            between(theta, [y0, y1], cubic(h, [y0, y1], [slope0, slope1]).into_iter())
                        });
                    }
                }
            }
            show(&stage);
            shown += 1;
        }
        std::mem::swap(&mut y, &mut next);
        std::mem::swap(&mut k[0], &mut slope);
        t = end;
    }
    // What is not finite once does not become so again.
    std::array::from_fn(|i| y.iter().chain(&k[0]).all(|x| x.0[i].is_finite()))
}

/// Writes y + h Σ aⱼ kⱼ; stages without weight are left out.
#[inline(always)]
fn go_ahead<const B: usize>(y: &[Block<B>], h: f64, a: &[f64], k: &[Vec<Block<B>>], to: &mut [Block<B>]) {
    for (i, to) in to.iter_mut().enumerate() {
        let mut slope = [0.0; B];
        for (&a, k) in a.iter().zip(k).filter(|(&a, _)| a != 0.0) {
            block::add(&mut slope, a, &k[i].0);
        }
        to.0 = block::each([&y[i].0, &slope], |[y, slope]| y + h * slope);
    }
}
