//! Stiff systems.

use super::*;

/// Van der Pol's equation in the scaled time of HW II, (IV.10.1), from (2, 0) to t = 2;
/// μ = ε^(−1/2).
fn van_der_pol(epsilon: f64, tolerance: f64) -> Run {
    let mut system = Plain::new(&[1.0, 1.0], move |_, y, dy| {
        dy.copy_from_slice(&[y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) / epsilon]);
    });
    let run = system.run("radau", (0.0, &[2.0, 0.0]), 2.0, &rtol(tolerance));
    assert_eq!(run.outcome, Outcome::Completed);
    println!("{epsilon:e}: {:?}, {} + {} steps", run.y, run.accepted, run.rejected);
    run
}

#[test]
fn radau_masters_van_der_pol() {
    // The reference solution of HW II, IV.10 for ε = 1e-6.
    let run = van_der_pol(1e-6, 1e-8);
    let truth = [1.706167732170469, -0.8928097010248125];
    assert!(run.y.iter().zip(truth).all(|(y, truth)| (y - truth).abs() < 1e-8));
    assert!(run.accepted < 4000);
    for epsilon in [1e-8, 1e-10, 1e-12] {
        let (coarse, fine) = (van_der_pol(epsilon, 1e-6), van_der_pol(epsilon, 1e-9));
        assert!(coarse.y.iter().zip(&fine.y).all(|(a, b)| (a - b).abs() < 1e-6));
    }
}

#[test]
fn radau_takes_few_steps_through_stiff_decay() {
    let mut system = Plain::new(&[1.0], |t, y, dy| dy[0] = -1e6 * (y[0] - t.cos()) - t.sin());
    let run = system.run("radau", (0.0, &[2.0]), 10.0, &rtol(1e-8));
    println!("decay: {:e}, {} + {}", run.y[0] - 10.0_f64.cos(), run.accepted, run.rejected);
    assert!((run.y[0] - 10.0_f64.cos()).abs() < 1e-7 && run.accepted < 300);
}

#[test]
fn an_explicit_method_names_stiffness() {
    let mut system = Plain::new(&[1.0], |t, y, dy| dy[0] = -1e6 * (y[0] - t.cos()));
    let options = Options { max_steps: 10_000, ..rtol(1e-6) };
    let run = system.run("dop853", (0.0, &[2.0]), 10.0, &options);
    assert_eq!(run.outcome, Outcome::StiffSuspected);
    assert!(run.outcome.to_string().contains("radau") && run.accepted < 1000);
    let mut mild = Plain::new(&[1.0], |t, y, dy| dy[0] = -1e3 * (y[0] - t.cos()));
    let run = mild.run("dop853", (0.0, &[2.0]), 1.0, &rtol(1e-6));
    assert!(run.outcome == Outcome::Completed && run.stiff_since.is_some());
}
