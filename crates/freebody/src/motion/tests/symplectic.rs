//! Long motions.

use super::*;

fn energy(y: &[f64]) -> f64 {
    0.5 * y[1] * y[1] - y[0].cos()
}

#[test]
fn energy_of_the_pendulum_does_not_drift() {
    let mut system = Hamiltonian { force: |q| -q.sin() };
    let start = [2.0, 0.0];
    let gauss6 = method("gauss6").unwrap();
    let run = run(&mut system, gauss6, (0.0, &start), 1e4, &fixed(0.1), &mut |_| true);
    assert_eq!(run.outcome, Outcome::Completed);
    let errors: Vec<f64> = run.trajectory.segments.iter().map(|s| energy(s.end()) - energy(&start)).collect();
    assert!(errors.len() >= 100_000);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let tenth = errors.len() / 10;
    let drift = mean(&errors[9 * tenth..]) - mean(&errors[..tenth]);
    let swing = errors.iter().fold(0.0, |top: f64, e| top.max(e.abs()));
    println!("drift {drift:e}, swing {swing:e}, {} per step", run.evaluations / errors.len());
    assert!(swing < 1e-7 && drift.abs() < 1e-3 * swing);
}

#[test]
fn a_step_is_symplectic() {
    // det ∂(q₁, p₁)/∂(q₀, p₀) = 1, by central differences.
    let gauss6 = method("gauss6").unwrap();
    let map = |q: f64, p: f64| {
        let mut system = Hamiltonian { force: |q| -q.sin() };
        run(&mut system, gauss6, (0.0, &[q, p]), 0.5, &fixed(0.5), &mut |_| true).y
    };
    let (d, q, p) = (1e-4, 1.0, 0.5);
    let slope = |a: Vec<f64>, b: Vec<f64>| [(a[0] - b[0]) / (2.0 * d), (a[1] - b[1]) / (2.0 * d)];
    let (by_q, by_p) = (slope(map(q + d, p), map(q - d, p)), slope(map(q, p + d), map(q, p - d)));
    assert!((by_q[0] * by_p[1] - by_q[1] * by_p[0] - 1.0).abs() < 1e-8);
}

#[test]
fn too_large_a_step_is_named() {
    let mut system = Hamiltonian { force: |q| -100.0 * q };
    let gauss6 = method("gauss6").unwrap();
    let run = run(&mut system, gauss6, (0.0, &[1.0, 0.0]), 10.0, &fixed(1.0), &mut |_| true);
    assert_eq!(run.outcome.name(), "FixedPointStalled");
    assert_eq!((run.t, &run.y[..]), (0.0, &[1.0, 0.0][..]));
}
