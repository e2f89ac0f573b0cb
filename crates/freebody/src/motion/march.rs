//! Many motions at once by the classical Runge–Kutta method: nothing is looked for on the way.

use super::dense::Segment;
use super::explicit::combine;
use super::rk4::TABLE;
use super::run::end_of_step;
use super::system::DynamicsError;
use crate::scalar::Scalar;

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

/// Carries `y` along a span by the method `rk4` and shows the state at each of its times: over `f64` what [`super::run()`] gives for the
/// same system without events, to the same bits.
///
/// # Errors
/// That of the rate; a state or rate that is not finite.
#[inline(always)]
pub fn march<S: Scalar>(
    span: Span,
    start: &[S],
    mut rate: impl FnMut(S, &[S], &mut [S]) -> Result<(), DynamicsError>,
    mut show: impl FnMut(&[S]),
) -> Result<(), DynamicsError> {
    let n = start.len();
    let mut k = vec![vec![S::zero(); n]; TABLE.b.len()];
    let (mut y, mut next) = (start.to_vec(), start.to_vec());
    let (mut stage, mut slope) = (start.to_vec(), vec![S::zero(); n]);
    let (mut t, mut shown) = (span.from, 0);
    rate(S::of(t), &y, &mut k[0])?;
    while shown < span.times.len() && span.times[shown] == t {
        show(&y);
        shown += 1;
    }
    while t != span.to {
        let end = end_of_step(t, span.to, span.step);
        let h = end - t;
        for (j, (&c, a)) in TABLE.c.iter().zip(TABLE.a).enumerate() {
            let (known, rest) = k.split_at_mut(j + 1);
            combine(a, known, &mut stage);
            stage.iter_mut().zip(&y).for_each(|(stage, &y)| *stage = y + stage.scale(h));
            rate(S::of(t + c * h), &stage, &mut rest[0])?;
        }
        combine(TABLE.b, &k, &mut next);
        next.iter_mut().zip(&y).for_each(|(next, &y)| *next = y + next.scale(h));
        rate(S::of(end), &next, &mut slope)?;
        let mut is_finite = true;
        for i in 0..n {
            is_finite &= !(next[i].any(|x| !x.is_finite()) || slope[i].any(|x| !x.is_finite()));
        }
        if !is_finite {
            return Err(DynamicsError::NoFiniteAcceleration);
        }
        let mut segment = None;
        while shown < span.times.len() && (span.times[shown] - end) * h <= 0.0 {
            let segment = segment.get_or_insert_with(|| Segment::hermite((t, &y, &k[0]), (end, &next, &slope)));
            segment.at(span.times[shown], &mut stage);
            show(&stage);
            shown += 1;
        }
        std::mem::swap(&mut y, &mut next);
        std::mem::swap(&mut k[0], &mut slope);
        t = end;
    }
    Ok(())
}
