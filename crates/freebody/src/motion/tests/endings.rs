//! How runs end.

use super::*;
use crate::motion::linear::Lu;

#[test]
fn numbers_that_are_not_finite_never_come_back() {
    for name in ["dop853", "tsit5", "radau", "rk4"] {
        let options = Options { first_step: Some(0.01), ..rtol(1e-8) };
        let mut system = Plain::new(&[1.0], |t, _, dy| dy[0] = if t > 1.0 { f64::NAN } else { 1.0 });
        let run = system.run(name, (0.0, &[0.0]), 2.0, &options);
        assert_eq!(run.outcome, Outcome::Overflow, "{name}");
        assert!(run.t <= 1.0 && run.t > 0.98 && (run.y[0] - run.t).abs() < 1e-12, "{name} {}", run.t);
        let mut explosion = Plain::new(&[1.0], |_, y, dy| dy[0] = y[0] * y[0]);
        let run = explosion.run(name, (0.0, &[1.0]), 2.0, &options);
        assert!(!run.outcome.is_ok() && run.y[0].is_finite(), "{name}: {:?}", run.outcome);
    }
}

#[test]
fn the_end_is_named() {
    let mut system = Plain::new(&[1.0], |_, y, dy| dy[0] = -y[0]);
    let mut name = |method: &str, options: Options| {
        let run = system.run(method, (0.0, &[1.0]), 1.0, &options);
        assert!(!run.outcome.to_string().is_empty());
        run.outcome.name()
    };
    assert_eq!(name("dop853", rtol(1e-15)), "ToleranceTooTight");
    assert_eq!(name("dop853", rtol(f64::NAN)), "ToleranceTooTight");
    assert_eq!(name("dop853", rtol(1e-14)), "Completed");
    assert_eq!(name("dop853", Options { max_steps: 2, ..rtol(1e-9) }), "TooManySteps");
    assert_eq!(name("rk4", Options::default()), "Unsupported");
    assert_eq!(name("gauss6", fixed(0.1)), "Unsupported");
    assert_eq!(name("rk4", fixed(0.1)), "Completed");
}

#[test]
fn the_caller_can_interrupt() {
    let mut system = Plain::new(&[1.0], |_, y, dy| dy[0] = -y[0]);
    let options = Options { max_step: 0.1, ..rtol(1e-9) };
    let dop853 = method("dop853").unwrap();
    let run = run(&mut system, dop853, (0.0, &[1.0]), 10.0, &options, &mut |t| t < 0.5);
    assert_eq!(run.outcome, Outcome::Interrupted);
    assert!(run.t >= 0.5 && run.t < 0.7);
}

#[test]
fn troubles_are_passed_on() {
    struct Broken(f64);
    impl System for Broken {
        fn dim(&self) -> usize {
            1
        }
        fn rate(&mut self, t: f64, _: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
            dy[0] = 1.0;
            match t > self.0 {
                true => Err(DynamicsError::NoUniqueMotion),
                false => Ok(()),
            }
        }
    }
    for (broken_from, contacts) in [(0.5, 0.5), (-1.0, 0.0)] {
        let dop853 = method("dop853").unwrap();
        let mut system = Broken(broken_from);
        let run = run(&mut system, dop853, (0.0, &[0.0]), 1.0, &rtol(1e-9), &mut |_| true);
        assert_eq!(run.outcome.name(), "singular_mass");
        assert!((run.t - contacts).abs() < 1e-9);
    }
}

#[test]
fn small_systems_are_solved_with_pivoting() {
    let a = vec![0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
    let mut b = [7.0, 3.0, 6.0];
    Lu::new(3, a).unwrap().solve(&mut b);
    assert!([1.0, 2.0, 3.0].iter().zip(b).all(|(x, b)| (x - b).abs() < 1e-14));
    assert!(Lu::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
}
