//! Series beside their closed forms, and 32 digits beside those of others.

use super::*;
use crate::scalar::{Block, DoubleDouble, Scalar};
use std::sync::Arc;

const ORDER: usize = 20;

/// The coefficients of the solution of ẏ = rate(t, y) through y at t.
fn expanded(t: f64, y: &[f64], rate: impl FnOnce(Traced, &[Traced], &mut [Traced])) -> Vec<Vec<DoubleDouble>> {
    let tape = recorded([&[t], y].concat(), |x| {
        let mut dy = vec![Traced::zero(); y.len()];
        rate(x[0], &x[1..], &mut dy);
        Ok::<_, ()>(dy)
    });
    let tape = tape.unwrap();
    let mut rounded = Solution::new(tape.rounded(), ORDER);
    let mut exact = Solution::new(tape, ORDER);
    assert!(rounded.expand(t, y));
    assert!(exact.expand(DoubleDouble::of(t), &y.iter().map(|&y| DoubleDouble::of(y)).collect::<Vec<_>>()));
    for i in 0..y.len() {
        for (a, b) in rounded.component(i).iter().zip(exact.component(i)) {
            assert!((a - b.hi).abs() <= 1e-12 * b.hi.abs().max(1.0), "{i}: {a} {b:?}");
        }
    }
    (0..y.len()).map(|i| exact.component(i).to_vec()).collect()
}

fn near(a: DoubleDouble, b: DoubleDouble) -> bool {
    (a - b).hi.abs() <= 1e-29 * b.hi.abs().max(1.0)
}

/// A function of time beside its own rate, integrated: both have the same coefficients.
fn holds(t: f64, f: impl Fn(Traced) -> Traced, rate: impl Fn(Traced) -> Traced) {
    let start = f(Traced::of(t)).value();
    let y = expanded(t, &[start, start], |t, _, dy| {
        dy[0] = rate(t);
        // f once more, as the slope of its integral less what it was.
        dy[1] = f(t);
    });
    for k in 1..ORDER {
        let slope = y[0][k] * DoubleDouble::of(k as f64);
        let of_integral = y[1][k + 1] * DoubleDouble::of((k * (k + 1)) as f64);
        assert!(near(slope, of_integral), "{k}: {slope:?} {of_integral:?}");
    }
}

#[test]
fn every_function_has_the_rate_of_its_derivative() {
    let two = || Traced::of(2.0);
    holds(0.3, |t| (t * t).sin_cos().0, |t| (t * t).sin_cos().1 * two() * t);
    holds(0.3, |t| (t * t).sin_cos().1, |t| -(t * t).sin_cos().0 * two() * t);
    holds(0.3, |t| (t * t + two()).sqrt(), |t| t / (t * t + two()).sqrt());
    holds(0.3, |t| (t * t).exp(), |t| two() * t * (t * t).exp());
    holds(0.3, |t| (t * t + two()).ln(), |t| two() * t / (t * t + two()));
    holds(0.3, |t| t.atan2(t * t + two()), |t| (two() - t * t) / ((t * t + two()) * (t * t + two()) + t * t));
    holds(0.3, |t| (t + two()).powi(-3), |t| Traced::of(-3.0) / (t + two()).powi(4));
    holds(0.3, |t| (t + two()).powi(5), |t| Traced::of(5.0) * (t + two()).powi(4));
    holds(0.3, |t| (t + two()).powf(t), |t| (t + two()).powf(t) * ((t + two()).ln() + t / (t + two())));
}

#[test]
fn an_oscillation_has_the_coefficients_of_sine_and_cosine() {
    let y = expanded(0.0, &[0.0, 1.0], |_, y, dy| (dy[0], dy[1]) = (y[1], -y[0]));
    let mut expected = DoubleDouble::one();
    for (k, &found) in y[0].iter().enumerate().skip(1) {
        expected = expected / DoubleDouble::of(k as f64);
        let sign = if k % 4 == 1 { 1.0 } else { -1.0 };
        let known = if k % 2 == 1 { expected * DoubleDouble::of(sign) } else { DoubleDouble::zero() };
        assert!(near(found, known), "{k}");
    }
}

#[test]
fn what_cancels_is_not_computed() {
    let tape = recorded([0.4, 1.0], |y| {
        let (sin, cos) = y[0].sin_cos();
        let radius = Traced::of(2.0);
        let (x, z) = (radius * cos, radius * sin);
        let pull = y[1] * y[1];
        Ok::<_, ()>(vec![x * x + z * z, x * (z * pull) - z * (x * pull)])
    });
    let tape = tape.unwrap();
    assert!(tape.ops.iter().all(|(_, op)| matches!(op, tape::Op::Sum { terms, .. } if terms.is_empty())), "{tape:?}");
}

#[test]
fn what_products_have_in_common_stands_before_brackets_that_are_found_once() {
    let tape = recorded([0.4, 0.3, 0.7, 1.1, 0.9], |x| {
        let [a, b, c, d, e] = x[..] else { unreachable!("five inputs") };
        Ok::<_, ()>(vec![d * d * a + d * d * b, c + e * a + e * b])
    });
    let tape = tape.unwrap();
    let count = |is: fn(&tape::Op<DoubleDouble>) -> bool| tape.ops.iter().filter(|(_, op)| is(op)).count();
    // d² (a + b) and c + e (a + b).
    assert_eq!(count(|op| matches!(op, tape::Op::Product(..))), 3, "{tape:?}");
    assert_eq!(count(|op| matches!(op, tape::Op::Sum { .. })), 3, "{tape:?}");
}

/// Every operation; products that only a sum needs; parts that do not move; sines of each other, and many; more values at a time than
/// there are registers.
fn every_operation<S: Scalar>(x: &[S]) -> Vec<S> {
    let (t, y, p) = (x[0], x[1], x[2]);
    let (sin, cos) = (y * p).sin_cos();
    let (still, open) = ((p * p + S::of(2.0)).sqrt(), y * y + t);
    let many: Vec<S> = (0..20).map(|i| (t + S::of(f64::from(i))).sqrt()).collect();
    let turned = |by: usize| (0..20).fold(S::of(0.3), |sum, i| sum - many[i] * many[(i + by) % 20].scale(0.1));
    vec![
        (t * y).scale(3.0) - still * sin * (y + S::of(0.5)) + cos.scale(0.1) + S::of(0.7),
        t + y.scale(1.1) + sin.scale(0.2) + cos.scale(1.3) + t * sin + t * cos + (y * sin).scale(0.3) + y * cos,
        still.exp() / open,
        S::one() / (open + p),
        (open * open + S::one()).ln(),
        sin.atan2(cos + still),
        p * still,
        S::of(4.0),
        turned(3) * (many[7] * y).exp(),
        turned(8),
        sin.sin_cos().1 * cos.sin_cos().0.sin_cos().0,
        (2..8).fold(t, |sum, i| sum + y.scale(f64::from(i)).sin_cos().0),
    ]
}

#[test]
fn a_program_gives_the_formula_to_the_same_bits_alone_and_side_by_side() {
    let tape = recorded([0.4, 0.3, 0.9], |x| Ok::<_, ()>(every_operation(x))).unwrap();
    let program = Arc::new(Program::new(tape.rounded(), 2));
    let (mut beside, mut all) = (program.memory::<64>(), vec![Block::of(0.0); 12]);
    let [y, p] = [0.3, 0.7].map(|from| Block(std::array::from_fn(|i| from + 0.11 * i as f64)));
    program.fix(&mut beside, &[p]);
    for t in [0.4, 1.7] {
        program.run(&mut beside, Block::of(t), &[y], &mut all);
        for i in 0..64 {
            let mut alone = Alone::new(&program, &[p.0[i]]);
            alone.run(t, [&[y.0[i]], &[]]);
            for ((all, one), exact) in all.iter().zip(alone.results(0)).zip(every_operation(&[t, y.0[i], p.0[i]])) {
                assert_eq!(all.0[i].to_bits(), one.to_bits());
                assert!((one - exact).abs() <= 1e-14 * exact.abs().max(1.0), "{one} {exact}");
            }
        }
    }
}

#[test]
fn a_value_that_is_done_with_leaves_its_place_and_no_more_is_done_than_is_asked_for() {
    let far = |x: Traced| (0..50).fold(x, |x, _| (x * x + Traced::one()).sqrt());
    let tape = recorded([0.0, 0.3], |x| Ok::<_, ()>(vec![far(x[1]), far(far(x[1]))])).unwrap();
    let program = Program::new(tape.rounded(), 2);
    assert_eq!(program.results[1].1, 2 * program.results[0].1);
    let mut memory = program.memory::<32>();
    assert!(memory.len() <= 6, "time, the state, a constant, a result kept, and what is at work: {}", memory.len());
    for count in 1..=2 {
        let mut results = vec![Block::of(0.0); count];
        program.run(&mut memory, Block::of(0.0), &[Block::of(0.3)], &mut results);
        // From x to √(x² + 1), 50 times for each result.
        let exact = |k: usize| (0.09 + 50.0 * (k + 1) as f64).sqrt();
        results.iter().enumerate().for_each(|(k, x)| assert!((x.0[0] - exact(k)).abs() < 1e-12, "{k} {x:?}"));
    }
}

/// Digits by mpmath 1.3 at 50 digits, of the doubles written here.
#[test]
fn functions_have_32_digits() {
    let dd = DoubleDouble::of;
    let (sin, cos) = dd(10.5).sin_cos();
    let given = [
        (sin, -0.87969575997167, -5.4243203936702253e-17),
        (cos, -0.4755369279959925, -2.6679686221851937e-17),
        (dd(7.25).sqrt(), 2.692582403567252, 1.4592269629506974e-16),
        (dd(3.7).exp(), 40.4473043600674, -1.2179541332469429e-15),
        (dd(-40.3).exp(), 3.1472582402307286e-18, -1.238307780579342e-34),
        (dd(5.3).ln(), 1.667706820558076, 5.257867245077391e-17),
        (dd(2.0).atan2(dd(-3.0)), 2.5535900500422257, -3.5886651473917e-17),
        (dd(-1e-3).atan2(dd(7.0)), -0.00014285714188532557, -4.7503092165029476e-21),
        (dd(1.0) / dd(3.0), 0.3333333333333333, 1.850371707708594e-17),
        (dd(1.1).powi(-7), 0.5131581182307065, 1.5333842275090902e-17),
    ];
    for (value, hi, lo) in given {
        let error = (value - DoubleDouble { hi, lo }).hi.abs();
        assert!(error <= 2e-31 * hi.abs(), "{value:?} {hi} {lo}: {error:e}");
    }
}
