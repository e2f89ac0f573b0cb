//! Functions of one variable given by points.

use super::{nearest, slopes, Message};
use crate::scalar::{real, Scalar};
use std::f64::consts::PI;

/// How a table is read between its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight segments.
    Linear,
    /// Cubics with a continuous slope that never overshoot the points.
    Pchip,
    /// Cubics with continuous slope and curvature; at free ends the curvature is 0.
    Spline,
}

const NAMES: [&str; 3] = ["linear", "pchip", "spline"];

impl Interpolation {
    /// The interpolation called `linear`, `pchip` or `spline`.
    pub fn named(word: &str) -> Result<Self, Message> {
        match word {
            "linear" => Ok(Interpolation::Linear),
            "pchip" => Ok(Interpolation::Pchip),
            "spline" => Ok(Interpolation::Spline),
            _ => Err(Message::new(
                format!("no interpolation is called `{word}`"),
                match nearest(word, NAMES.into_iter()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "choose `linear`, `pchip` or `spline`".into(),
                },
            )),
        }
    }
}

/// What the first and the last value of a periodic table may differ by, of the largest value: round-off of units.
const AGREES: f64 = 1e-12;

/// A function given by points. Outside them the end value holds, or it is periodic.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    x: Vec<f64>,
    /// Coefficients of each piece in powers of the distance from its left end.
    pieces: Vec<[f64; 4]>,
    /// Values at the two ends.
    ends: [f64; 2],
    interpolation: Interpolation,
    period: Option<f64>,
}

impl Table {
    /// The function through the points (x\[i\], y\[i\]); if it is `periodic`, with the period x\[n\] − x\[0\].
    ///
    /// Fails unless there are at least two points, all finite, with strictly increasing x, and, of a periodic one, with the
    /// same value at both ends.
    pub fn new(x: &[f64], y: &[f64], interpolation: Interpolation, periodic: bool) -> Result<Self, Message> {
        check(x, y, periodic)?;
        let widths: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let chords: Vec<f64> = (0..widths.len()).map(|i| (y[i + 1] - y[i]) / widths[i]).collect();
        let smooth = |slopes: Vec<f64>| cubics(&widths, y, &chords, &slopes);
        let pieces = match interpolation {
            Interpolation::Linear => (0..chords.len()).map(|i| [y[i], chords[i], 0.0, 0.0]).collect(),
            Interpolation::Pchip => smooth(slopes::pchip(&widths, &chords, periodic)),
            Interpolation::Spline => smooth(slopes::spline(&widths, &chords, periodic)),
        };
        let [first, last] = [x[0], x[x.len() - 1]];
        let period = periodic.then_some(last - first);
        Ok(Table { x: x.to_vec(), pieces, ends: [y[0], y[y.len() - 1]], interpolation, period })
    }

    /// The value at `x`, with exact derivatives; at a knot they are those of its right side.
    pub fn eval<S: Scalar>(&self, x: S) -> S {
        if let Some(period) = self.period {
            let turns = ((x.value() - self.x[0]) / period).floor();
            return self.between(x - S::of(turns * period));
        }
        if x.value() < self.x[0] {
            return S::of(self.ends[0]);
        }
        if x.value() >= self.x[self.x.len() - 1] {
            return S::of(self.ends[1]);
        }
        self.between(x)
    }

    /// The value at `x` within the points.
    fn between<S: Scalar>(&self, x: S) -> S {
        // An undefined argument finds no knot on its left, and the first piece passes it on.
        let knots = &self.x[..self.pieces.len()];
        let i = knots.partition_point(|&knot| knot <= x.value()).max(1) - 1;
        let [a, b, c, d] = self.pieces[i];
        let u = x - S::of(self.x[i]);
        match self.interpolation {
            Interpolation::Linear => S::of(a) + u.scale(b),
            Interpolation::Pchip | Interpolation::Spline => S::of(a) + u * (S::of(b) + u * (S::of(c) + u.scale(d))),
        }
    }

    /// Whether an argument is before the first or after the last, where the end value holds; a periodic table has no end.
    pub fn is_beyond(&self, x: f64) -> bool {
        self.period.is_none() && (x < self.x[0] || x > self.x[self.x.len() - 1])
    }

    /// How far `x` is beyond a knot; of a periodic table a function of `x` that vanishes likewise at what repeats the knot.
    pub fn beyond(&self, x: f64, knot: f64) -> f64 {
        match self.period {
            Some(period) => real::sin_pi((x - knot) / period) * period / PI,
            None => x - knot,
        }
    }

    /// The increasing arguments at which the slope may jump: every point of a linear table, the two
    /// ends of a smooth one that has ends; of those a period apart only the first.
    pub fn knots(&self) -> impl Iterator<Item = f64> + '_ {
        let all = self.x.len();
        let (count, step) = match (self.interpolation, self.period) {
            (Interpolation::Linear, None) => (all, 1),
            (Interpolation::Linear, Some(_)) => (all - 1, 1),
            (_, None) => (all, all - 1),
            (_, Some(_)) => (0, 1),
        };
        self.x[..count].iter().copied().step_by(step)
    }
}

fn check(x: &[f64], y: &[f64], periodic: bool) -> Result<(), Message> {
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
    let (first, last, size) = (y[0], y[y.len() - 1], y.iter().fold(0.0, |most: f64, y| most.max(y.abs())));
    if periodic && (last - first).abs() > AGREES * size {
        let what = format!("the values of a periodic table at its ends, {first} and {last}, are not the same");
        return Err(Message::new(what, "end with the value of the first point, one period on"));
    }
    Ok(())
}

/// The cubic of each piece with these slopes at its ends.
fn cubics(widths: &[f64], y: &[f64], chords: &[f64], slopes: &[f64]) -> Vec<[f64; 4]> {
    let piece = |i: usize| {
        let (h, chord, left, right) = (widths[i], chords[i], slopes[i], slopes[i + 1]);
        [y[i], left, (3.0 * chord - 2.0 * left - right) / h, (left + right - 2.0 * chord) / (h * h)]
    };
    (0..chords.len()).map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Dual, Jet};
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
                let table = Table::new(&x, &y, kind, false).unwrap();
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
            let table = Table::new(&x, &y, Interpolation::Pchip, false).unwrap();
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

    /// A value with its first two derivatives.
    fn jet(table: &Table, x: f64) -> [f64; 3] {
        let found = table.eval(Jet { d0: x, d1: 1.0, d2: 0.0 });
        [found.d0, found.d1, found.d2]
    }

    /// The largest difference of two jets, each derivative in the size that steps of `h` give it.
    fn apart(a: [f64; 3], b: [f64; 3], h: f64) -> f64 {
        (0..3).map(|k| (a[k] - b[k]).abs() * h.powi(k as i32)).fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn a_spline_is_smooth_to_the_curvature((x, mut y) in points(), periodic: bool) {
            let last = x.len() - 1;
            if periodic {
                y[last] = y[0];
            }
            let table = Table::new(&x, &y, Interpolation::Spline, periodic).unwrap();
            let narrowest = (0..last).map(|i| x[i + 1] - x[i]).fold(f64::INFINITY, f64::min);
            let left = |i: usize| {
                let ([a, b, c, d], h) = (table.pieces[i - 1], x[i] - x[i - 1]);
                [a + h * (b + h * (c + h * d)), b + h * (2.0 * c + 3.0 * h * d), 2.0 * c + 6.0 * h * d]
            };
            for (i, &at) in x[..last].iter().enumerate().skip(1) {
                prop_assert!(apart(left(i), jet(&table, at), narrowest) < 1e-11);
            }
            let first = jet(&table, x[0]);
            if periodic {
                prop_assert!(apart(left(last), first, narrowest) < 1e-11);
            } else {
                prop_assert!(first[2].abs().max(left(last)[2].abs()) * narrowest.powi(2) < 1e-11);
            }
        }

        #[test]
        fn a_periodic_table_comes_again((x, mut y) in points(), part in 0.0..1.0f64, turns in -20..20) {
            let last = x.len() - 1;
            y[last] = y[0];
            let period = x[last] - x[0];
            for kind in [Interpolation::Linear, Interpolation::Pchip, Interpolation::Spline] {
                let table = Table::new(&x, &y, kind, true).unwrap();
                let at = x[0] + part * period;
                let (here, there) = (table.eval(at), table.eval(at + f64::from(turns) * period));
                let steepest = table.pieces.iter().map(|piece| piece[1].abs()).fold(1.0, f64::max);
                prop_assert!((here - there).abs() < 1e-11 * steepest);
                let repeated = x[0] + f64::from(turns) * period;
                prop_assert!(table.beyond(repeated, x[0]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn a_straight_line_stays_straight() {
        for kind in [Interpolation::Linear, Interpolation::Pchip, Interpolation::Spline] {
            let table = Table::new(&[0.0, 1.0, 4.0], &[1.0, 3.0, 9.0], kind, false).unwrap();
            assert!((table.eval(2.3) - 5.6).abs() < 1e-14);
            assert!((slope(&table, 0.7) - 2.0).abs() < 1e-14);
        }
    }

    #[test]
    fn knots_are_where_the_slope_jumps() {
        let knots = |kind, periodic| {
            let table = Table::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], kind, periodic).unwrap();
            table.knots().collect::<Vec<_>>()
        };
        assert_eq!(knots(Interpolation::Linear, false), [0.0, 1.0, 2.0]);
        assert_eq!(knots(Interpolation::Linear, true), [0.0, 1.0]);
        for smooth in [Interpolation::Pchip, Interpolation::Spline] {
            assert_eq!(knots(smooth, false), [0.0, 2.0]);
            assert!(knots(smooth, true).is_empty());
        }
    }

    #[test]
    fn an_undefined_argument_is_passed_on() {
        for kind in [Interpolation::Linear, Interpolation::Spline] {
            for periodic in [false, true] {
                let table = Table::new(&[0.0, 1.0], &[0.0, 0.0], kind, periodic).unwrap();
                assert!(table.eval(f64::NAN).is_nan());
            }
        }
    }

    #[test]
    fn wrong_points_are_named() {
        let what = |x: &[f64], y: &[f64]| Table::new(x, y, Interpolation::Linear, true).unwrap_err().what;
        assert!(what(&[0.0, 1.0], &[0.0]).contains("2 arguments but 1 values"));
        assert!(what(&[0.0], &[0.0]).contains("two points"));
        assert!(what(&[0.0, 2.0, 2.0], &[0.0; 3]).contains("argument 3"));
        assert!(what(&[0.0, f64::NAN], &[0.0; 2]).contains("point 2"));
        assert!(what(&[0.0, 1.0], &[0.0, 2.0]).contains("at its ends, 0 and 2,"));
        assert_eq!(Interpolation::named("linaer").unwrap_err().hint, "did you mean `linear`?");
    }
}
