//! Functions of one variable given by points.

use super::{nearest, Message};
use crate::scalar::Scalar;

/// How a table is read between its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight segments.
    Linear,
    /// Cubics with a continuous slope that never overshoot the points.
    Pchip,
}

impl Interpolation {
    /// The interpolation called `linear` or `pchip`.
    pub fn named(word: &str) -> Result<Self, Message> {
        match word {
            "linear" => Ok(Interpolation::Linear),
            "pchip" => Ok(Interpolation::Pchip),
            _ => Err(Message::new(
                format!("no interpolation is called `{word}`"),
                match nearest(word, ["linear", "pchip"].into_iter()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "choose `linear` or `pchip`".into(),
                },
            )),
        }
    }
}

/// A function given by points; outside them the end value holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    x: Vec<f64>,
    /// Coefficients of each piece in powers of the distance from its left end.
    pieces: Vec<[f64; 4]>,
    /// Values at the two ends.
    ends: [f64; 2],
    interpolation: Interpolation,
}

impl Table {
    /// The function through the points (x\[i\], y\[i\]).
    ///
    /// Fails unless there are at least two points, all finite, with strictly increasing x.
    pub fn new(x: &[f64], y: &[f64], interpolation: Interpolation) -> Result<Self, Message> {
        check(x, y)?;
        let chords: Vec<f64> = (1..x.len()).map(|i| (y[i] - y[i - 1]) / (x[i] - x[i - 1])).collect();
        let pieces = match interpolation {
            Interpolation::Linear => (0..chords.len()).map(|i| [y[i], chords[i], 0.0, 0.0]).collect(),
            Interpolation::Pchip => cubics(x, y, &chords),
        };
        Ok(Table { x: x.to_vec(), pieces, ends: [y[0], y[y.len() - 1]], interpolation })
    }

    /// The value at `x`, with exact derivatives; at a knot they are those of its right side.
    pub fn eval<S: Scalar>(&self, x: S) -> S {
        let at = x.value();
        if at < self.x[0] {
            return S::of(self.ends[0]);
        }
        if at >= self.x[self.x.len() - 1] {
            return S::of(self.ends[1]);
        }
        // An undefined argument finds no knot on its left, and the first piece passes it on.
        let i = self.x.partition_point(|&knot| knot <= at).max(1) - 1;
        let [a, b, c, d] = self.pieces[i];
        let u = x - S::of(self.x[i]);
        match self.interpolation {
            Interpolation::Linear => S::of(a) + u.scale(b),
            Interpolation::Pchip => S::of(a) + u * (S::of(b) + u * (S::of(c) + u.scale(d))),
        }
    }

    /// The first and the last argument: beyond them the end value holds.
    pub fn span(&self) -> [f64; 2] {
        [self.x[0], self.x[self.x.len() - 1]]
    }

    /// The increasing arguments at which the slope may jump: every point of a linear table, the two
    /// ends of a smooth one.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        let step = match self.interpolation {
            Interpolation::Linear => 1,
            Interpolation::Pchip => self.x.len() - 1,
        };
        self.x.iter().copied().step_by(step)
    }
}

fn check(x: &[f64], y: &[f64]) -> Result<(), Message> {
    if x.len() != y.len() {
        let what = format!("a table has {} arguments but {} values", x.len(), y.len());
        return Err(Message::new(what, "give one value for each argument"));
    }
    if x.len() < 2 {
        return Err(Message::new("a table needs at least two points", "for a constant, write the number itself"));
    }
    if let Some(i) = (0..x.len()).find(|&i| !(x[i].is_finite() && y[i].is_finite())) {
        let what = format!("point {} of a table is ({}, {})", i + 1, x[i], y[i]);
        return Err(Message::new(what, "give finite numbers"));
    }
    if let Some(i) = (1..x.len()).find(|&i| x[i] <= x[i - 1]) {
        let what = format!("argument {} of a table, {}, is not above the one before it, {}", i + 1, x[i], x[i - 1]);
        return Err(Message::new(what, "sort the points by their argument and drop repetitions"));
    }
    Ok(())
}

/// Monotone cubic pieces (Fritsch & Carlson, SIAM J. Numer. Anal. 17, 1980, 238–246) with the
/// slopes of Fritsch & Butland (SIAM J. Sci. Stat. Comput. 5, 1984, 300–304).
fn cubics(x: &[f64], y: &[f64], chords: &[f64]) -> Vec<[f64; 4]> {
    let widths: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slopes = slopes(&widths, chords);
    let piece = |i: usize| {
        let (h, chord, left, right) = (widths[i], chords[i], slopes[i], slopes[i + 1]);
        [y[i], left, (3.0 * chord - 2.0 * left - right) / h, (left + right - 2.0 * chord) / (h * h)]
    };
    (0..chords.len()).map(piece).collect()
}

/// The slope at each point: a weighted harmonic mean of its chords, 0 at an extremum.
fn slopes(widths: &[f64], chords: &[f64]) -> Vec<f64> {
    let last = chords.len() - 1;
    if last == 0 {
        return vec![chords[0]; 2];
    }
    let inner = |i: usize| {
        let (left, right) = (chords[i - 1], chords[i]);
        if left * right <= 0.0 {
            return 0.0;
        }
        let (a, b) = (2.0 * widths[i] + widths[i - 1], widths[i] + 2.0 * widths[i - 1]);
        (a + b) / (a / left + b / right)
    };
    let first = end_slope([widths[0], widths[1]], [chords[0], chords[1]]);
    let end = end_slope([widths[last], widths[last - 1]], [chords[last], chords[last - 1]]);
    std::iter::once(first).chain((1..=last).map(inner)).chain(std::iter::once(end)).collect()
}

/// The three-point slope at an end, limited so that the end piece stays monotone.
fn end_slope(widths: [f64; 2], chords: [f64; 2]) -> f64 {
    let [h, next] = widths;
    let slope = ((2.0 * h + next) * chords[0] - h * chords[1]) / (h + next);
    if slope * chords[0] <= 0.0 {
        0.0
    } else if chords[0] * chords[1] <= 0.0 && slope.abs() > 3.0 * chords[0].abs() {
        3.0 * chords[0]
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;
    use proptest::prelude::*;

    /// Increasing arguments with any values.
    fn points() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
        prop::collection::vec((0.01..3.0f64, -5.0..5.0f64), 2..12).prop_map(|pairs| {
            let mut at = -4.0;
            pairs
                .into_iter()
                .map(|(step, y)| {
                    at += step;
                    (at, y)
                })
                .unzip()
        })
    }

    fn slope(table: &Table, x: f64) -> f64 {
        table.eval(Dual::<1>::variable(x, 0)).du[0]
    }

    proptest! {
        #[test]
        fn passes_through_its_points_and_never_overshoots((x, y) in points(), part in 0.0..1.0f64) {
            for kind in [Interpolation::Linear, Interpolation::Pchip] {
                let table = Table::new(&x, &y, kind).unwrap();
                for i in 0..x.len() {
                    prop_assert_eq!(table.eval(x[i]), y[i]);
                }
                for i in 1..x.len() {
                    let inside = table.eval(x[i - 1] + part * (x[i] - x[i - 1]));
                    let (low, high) = (y[i].min(y[i - 1]), y[i].max(y[i - 1]));
                    prop_assert!(low - 1e-12 <= inside && inside <= high + 1e-12);
                }
                prop_assert_eq!(table.eval(x[0] - 1.0), y[0]);
                prop_assert_eq!(table.eval(x[x.len() - 1] + 1.0), y[y.len() - 1]);
            }
        }

        #[test]
        fn slopes_are_those_of_the_values_and_continuous((x, y) in points(), part in 0.1..0.9f64) {
            let table = Table::new(&x, &y, Interpolation::Pchip).unwrap();
            for i in 1..x.len() {
                let h = x[i] - x[i - 1];
                let (at, step) = (x[i - 1] + part * h, 1e-5 * h);
                let difference = (table.eval(at + step) - table.eval(at - step)) / (2.0 * step);
                prop_assert!((slope(&table, at) - difference).abs() < 1e-5 * (1.0 + 10.0 / h));
                if i + 1 < x.len() {
                    let below = slope(&table, x[i] - 1e-12);
                    prop_assert!((below - slope(&table, x[i])).abs() < 1e-6 * (1.0 + 100.0 / h));
                }
            }
        }
    }

    #[test]
    fn a_straight_line_stays_straight() {
        for kind in [Interpolation::Linear, Interpolation::Pchip] {
            let table = Table::new(&[0.0, 1.0, 4.0], &[1.0, 3.0, 9.0], kind).unwrap();
            assert!((table.eval(2.3) - 5.6).abs() < 1e-14);
            assert!((slope(&table, 0.7) - 2.0).abs() < 1e-14);
        }
    }

    #[test]
    fn knots_are_where_the_slope_jumps() {
        let knots = |kind| Table::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], kind).unwrap().knots().collect::<Vec<_>>();
        assert_eq!(knots(Interpolation::Linear), [0.0, 1.0, 2.0]);
        assert_eq!(knots(Interpolation::Pchip), [0.0, 2.0]);
    }

    #[test]
    fn an_undefined_argument_is_passed_on() {
        assert!(Table::new(&[0.0, 1.0], &[0.0, 1.0], Interpolation::Linear).unwrap().eval(f64::NAN).is_nan());
    }

    #[test]
    fn wrong_points_are_named() {
        let what = |x: &[f64], y: &[f64]| Table::new(x, y, Interpolation::Linear).unwrap_err().what;
        assert!(what(&[0.0, 1.0], &[0.0]).contains("2 arguments but 1 values"));
        assert!(what(&[0.0], &[0.0]).contains("two points"));
        assert!(what(&[0.0, 2.0, 2.0], &[0.0; 3]).contains("argument 3"));
        assert!(what(&[0.0, f64::NAN], &[0.0; 2]).contains("point 2"));
        assert_eq!(Interpolation::named("linaer").unwrap_err().hint, "did you mean `linear`?");
    }
}
