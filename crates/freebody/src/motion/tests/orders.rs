//! The order of every method of the list, by regression.

use super::*;
use crate::motion::method::{Counted, Point};
use crate::motion::norm::Norm;

/// A known motion q, q̇ from t = 0, and the force that gives it.
struct Known {
    force: fn(f64) -> f64,
    exact: fn(f64) -> [f64; 2],
    until: f64,
}

/// q̈ = 2q³ has the solution q = 1/(1.5 − t), q̇ = q².
const TOWARDS_A_POLE: Known =
    Known { force: |q| 2.0 * q.powi(3), exact: |t| [1.0 / (1.5 - t), (1.5 - t).powi(-2)], until: 1.0 };
/// Long steps show a high order before round-off does.
const OSCILLATION: Known = Known { force: |q| -q, exact: |t| [t.sin(), t.cos()], until: 12.0 };

/// Largest errors at the ends of the steps and within them, over equal steps.
fn errors(method: &Method, known: &Known, steps: usize) -> (f64, f64) {
    let Known { force, exact, until } = *known;
    let mut system = Hamiltonian { force };
    let norm = Norm::new(&system, 1e-13);
    let mut counted = Counted { system: &mut system, evaluations: 0 };
    let mut stepper = (method.stepper)(2);
    let mut from = Point::new(0.0, &exact(0.0));
    counted.rate_of(&mut from).unwrap();
    let (mut at_ends, mut within, mut y) = (0.0_f64, 0.0_f64, [0.0; 2]);
    let note = |worst: &mut f64, t: f64, y: &[f64]| {
        let truth = exact(t);
        *worst = worst.max((y[0] - truth[0]).abs()).max((y[1] - truth[1]).abs());
    };
    for step in 1..=steps {
        let mut to = from.clone();
        to.t = until * step as f64 / steps as f64;
        stepper.attempt(&mut counted, &from, &mut to, &norm).unwrap();
        if !stepper.rates_end() {
            counted.rate_of(&mut to).unwrap();
        }
        let segment = stepper.dense(&mut counted, &from, &to).unwrap();
        for k in 1..20 {
            let t = from.t + (to.t - from.t) * k as f64 / 20.0;
            segment.at(t, &mut y);
            note(&mut within, t, &y);
        }
        note(&mut at_ends, to.t, &to.y);
        from = to;
    }
    (at_ends, within)
}

/// Slope of log(error) over log(1/steps), by least squares.
fn order(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0.ln()), mean(&|p| p.1.ln()));
    let top = mean(&|p| (p.0.ln() - x) * (p.1.ln() - y));
    -top / mean(&|p| (p.0.ln() - x).powi(2))
}

#[test]
fn every_method_has_its_order() {
    for method in METHODS.iter().filter(|method| !method.analytic) {
        let (known, counts): (&Known, &[usize]) = match method.order {
            13 => (&OSCILLATION, &[5, 6, 7, 8]),
            8 => (&TOWARDS_A_POLE, &[16, 20, 24, 32]),
            _ => (&TOWARDS_A_POLE, &[48, 64, 96, 128]),
        };
        let results: Vec<_> = counts.iter().map(|&n| (n as f64, errors(method, known, n))).collect();
        let ends: Vec<_> = results.iter().map(|r| (r.0, r.1 .0)).collect();
        let within: Vec<_> = results.iter().map(|r| (r.0, r.1 .1)).collect();
        let (step, dense) = (order(&ends), order(&within));
        println!("{}: order {step:.2}, dense {dense:.2} {results:?}", method.name);
        assert!((step - f64::from(method.order)).abs() < 0.5, "{}: {step}", method.name);
        assert!(dense > f64::from(method.dense_order) + 0.2, "{}: dense {dense}", method.name);
    }
}

#[test]
fn dense_output_meets_the_ends() {
    for method in METHODS.iter().filter(|method| !method.analytic) {
        let mut system = Hamiltonian { force: |q| -q.sin() };
        let options = Options { max_step: 0.1, ..fixed(0.1) };
        let run = run(&mut system, method, (0.0, &[1.0, 0.0]), 1.0, &options, &mut |_| true);
        assert_eq!(run.outcome, Outcome::Completed);
        let mut y = [0.0; 2];
        for pair in run.trajectory.segments.windows(2) {
            assert_eq!((pair[0].t1, pair[0].end()), (pair[1].t0, pair[1].start()));
            pair[0].at(pair[0].t0, &mut y);
            assert_eq!(pair[0].start(), y);
        }
        assert!(run.trajectory.at(1.0, &mut y) && y[..] == run.y[..]);
        assert!(!run.trajectory.at(1.0 + 1e-9, &mut y) && !run.trajectory.at(-1e-9, &mut y));
    }
}
