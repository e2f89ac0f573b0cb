//! The Taylor series of an oscillation, whose coefficients are known.

use super::*;
use crate::motion::method::{Counted, Point, Stepper};
use crate::motion::norm::Norm;
use crate::motion::system::Analytic;

/// q̈ = −q; the rate is that of another law where `wrong` says so.
struct Oscillation {
    wrong: f64,
}

impl System for Oscillation {
    fn dim(&self) -> usize {
        2
    }
    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
        (dy[0], dy[1]) = (y[1], -y[0] * (1.0 + self.wrong));
        Ok(())
    }
    fn analytic(&mut self) -> Result<&mut dyn Analytic, &'static str> {
        Ok(self)
    }
}

impl Analytic for Oscillation {
    fn expand(&mut self, _: f64, y: &[f64], order: usize, out: &mut [f64]) -> Result<(), DynamicsError> {
        let (q, u) = out.split_at_mut(order + 1);
        (q[0], u[0]) = (y[0], y[1]);
        for k in 1..=order {
            (q[k], u[k]) = (u[k - 1] / k as f64, -q[k - 1] / k as f64);
        }
        Ok(())
    }
}

fn stepper() -> Box<dyn Stepper> {
    (method("taylor").unwrap().stepper)(2)
}

/// One step of length h from the crest: where it comes to, and how far its dense output is from the cosine at most.
fn step(h: f64) -> (f64, f64) {
    let mut system = Oscillation { wrong: 0.0 };
    let norm = Norm::new(&system, 1e-13);
    let mut counted = Counted { system: &mut system, evaluations: 0 };
    let mut from = Point::new(0.0, &[1.0, 0.0]);
    counted.rate_of(&mut from).unwrap();
    let mut to = Point::new(h, &[0.0, 0.0]);
    let mut stepper = stepper();
    stepper.attempt(&mut counted, &from, &mut to, &norm).unwrap();
    let segment = stepper.dense(&mut counted, &from, &to).unwrap();
    let mut y = [0.0; 2];
    let away = |k: usize| {
        let t = h * k as f64 / 40.0;
        segment.at(t, &mut y);
        (y[0] - t.cos()).abs()
    };
    (to.y[0], (0..=40).map(away).fold(0.0, f64::max))
}

/// The first term left out of the cosine is that of order 26; long steps show it before round-off does.
#[test]
fn the_error_of_a_step_is_the_first_term_left_out() {
    let factorial: f64 = (1..=26).map(f64::from).product();
    for h in [5.0_f64, 6.0, 7.0, 8.0] {
        let left_out = h.powi(26) / factorial;
        let (end, within) = step(h);
        assert!(((end - h.cos()).abs() / left_out - 1.0).abs() < 0.1, "{h}: {end} {left_out:e}");
        assert!(within < 1.1 * left_out, "{h}: {within:e}");
    }
}

/// A step ends where the last term, h²⁴/24!, is the tolerance.
#[test]
fn the_tolerance_is_kept_in_as_many_steps_as_that_takes() {
    let factorial: f64 = (1..=24).map(f64::from).product();
    for rtol in [1e-6, 1e-9, 1e-12] {
        let options = Options { rtol, ..Options::default() };
        let taylor = method("taylor").unwrap();
        let end = run(&mut Oscillation { wrong: 0.0 }, taylor, (0.0, &[1.0, 0.0]), 50.0, &options, &mut |_| true);
        assert_eq!(end.outcome, Outcome::Completed);
        let error = (end.y[0] - 50.0_f64.cos()).abs();
        assert!(error < 30.0 * rtol && end.rejected == 0, "{error:e}");
        let steps = 50.0 / (rtol * factorial).powf(1.0 / 24.0);
        assert!((end.accepted as f64 / steps - 1.0).abs() < 0.15, "{rtol:e}: {} {steps}", end.accepted);
    }
}

#[test]
fn a_series_that_is_not_that_of_the_motion_is_no_step() {
    let taylor = method("taylor").unwrap();
    let options = Options { max_steps: 1000, ..Options::default() };
    let end = run(&mut Oscillation { wrong: 1e-3 }, taylor, (0.0, &[1.0, 0.0]), 50.0, &options, &mut |_| true);
    assert!(!end.outcome.is_ok(), "{:?}", end.outcome);
}

#[test]
fn a_system_without_series_is_refused_by_name() {
    let mut system = Plain::new(&[1.0], |_, y, dy| dy[0] = y[0]);
    let end = system.run("taylor", (0.0, &[1.0]), 1.0, &Options::default());
    assert!(end.outcome.to_string().contains("no series"), "{}", end.outcome);
}

#[test]
fn dense_output_meets_the_ends() {
    let taylor = method("taylor").unwrap();
    let end =
        run(&mut Oscillation { wrong: 0.0 }, taylor, (0.0, &[1.0, 0.0]), 20.0, &Options::default(), &mut |_| true);
    for pair in end.trajectory.segments.windows(2) {
        assert_eq!((pair[0].t1, pair[0].end()), (pair[1].t0, pair[1].start()));
    }
}
