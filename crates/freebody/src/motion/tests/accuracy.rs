//! Error control.

use super::*;

/// Two unit point masses on unit links, absolute angles from the downward vertical.
fn double_pendulum(_: f64, y: &[f64], dy: &mut [f64]) {
    let (s, c) = (y[0] - y[1]).sin_cos();
    let (f1, f2) = (-s * y[3] * y[3] - 2.0 * 9.81 * y[0].sin(), s * y[2] * y[2] - 9.81 * y[1].sin());
    let det = 2.0 - c * c;
    dy.copy_from_slice(&[y[2], y[3], (f1 - c * f2) / det, (2.0 * f2 - c * f1) / det]);
}

/// From a Taylor-series integration in 60 digits.
const TRUTH: [f64; 4] = [-0.5684746640159502, -0.5263937279324047, 6.078384885761965, -9.68136068170888];

fn double_pendulum_error(tolerance: f64) -> f64 {
    let mut system = Plain::new(&[1.0, 1.0, 3.13, 3.13], double_pendulum);
    let quarter = std::f64::consts::FRAC_PI_2;
    let run = system.run("dop853", (0.0, &[quarter, quarter, 0.0, 0.0]), 10.0, &rtol(tolerance));
    assert_eq!(run.outcome, Outcome::Completed);
    let error = run.y.iter().zip(TRUTH).fold(0.0, |top: f64, (y, truth)| top.max((y - truth).abs()));
    println!("{tolerance:e}: {error:e}, {} + {} steps, {}", run.accepted, run.rejected, run.evaluations);
    error
}

#[test]
fn double_pendulum_stays_accurate() {
    for exponent in 6..14 {
        double_pendulum_error(0.1_f64.powi(exponent));
    }
    assert!(double_pendulum_error(1e-9) <= 3e-7);
    assert!(double_pendulum_error(1e-12) <= 5e-10);
}

#[test]
fn decaying_quantities_keep_their_digits() {
    for name in ["dop853", "tsit5", "radau"] {
        let mut system = Plain::new(&[1.0, 1.0], |t, y, dy| {
            dy.copy_from_slice(&[-y[0], -2.0 * y[1] / t]);
        });
        let run = system.run(name, (1.0, &[1.0, 1.0]), 14.8, &rtol(1e-8));
        let truth = [(-13.8_f64).exp(), 14.8_f64.powi(-2)];
        for (y, truth) in run.y.iter().zip(truth) {
            println!("{name}: {:e}, {} steps", y / truth - 1.0, run.accepted);
            assert!((y / truth - 1.0).abs() < 1e-6, "{name}");
        }
    }
}

#[test]
fn round_off_about_zero_does_not_govern_the_step() {
    let mut count = 0u32;
    let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| {
        count += 1;
        let noise = f64::from(count.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 23) - 1.0;
        dy.copy_from_slice(&[-y[0], 1e-17 * noise]);
    });
    let run = system.run("dop853", (0.0, &[1.0, 0.0]), 10.0, &rtol(1e-10));
    assert!(run.outcome.is_ok() && run.accepted < 60, "{} steps", run.accepted);
}

/// The change at the start is slow enough for a trial 10¹² s long, where the rate is beyond all numbers.
#[test]
fn the_first_step_is_tried_within_the_run() {
    for name in ["dop853", "tsit5", "radau"] {
        let mut system = Plain::new(&[1.0], |t, _, dy| dy[0] = 1e-14 + t.powi(40));
        let run = system.run(name, (0.0, &[1.0]), 1.0, &rtol(1e-10));
        assert!(run.outcome.is_ok() && (run.y[0] - 1.0 - 1.0 / 41.0).abs() < 1e-9, "{name}: {:?}", run.outcome);
    }
}

#[test]
fn outputs_never_change_the_steps() {
    let start = [1.0, 0.5, 0.0, 0.0];
    let mut system = Plain::new(&[1.0; 4], double_pendulum);
    let plain = system.run("dop853", (0.0, &start), 5.0, &rtol(1e-10));
    let mut y = [0.0; 4];
    for k in 0..=1000 {
        assert!(plain.trajectory.at(k as f64 * 0.005, &mut y));
    }
    let again = system.run("dop853", (0.0, &start), 5.0, &rtol(1e-10));
    assert_eq!(plain.trajectory, again.trajectory);
}

#[test]
fn watching_without_a_crossing_never_changes_the_steps() {
    let start = [1.0, 0.5, 0.0, 0.0];
    let plain = Plain::new(&[1.0; 4], double_pendulum).run("dop853", (0.0, &start), 5.0, &rtol(1e-10));
    let watched = Plain::new(&[1.0; 4], double_pendulum).watching(&[0], |_, y, g| g[0] = y[0] - 100.0).run(
        "dop853",
        (0.0, &start),
        5.0,
        &rtol(1e-10),
    );
    assert_eq!(plain.trajectory, watched.trajectory);
}

#[test]
fn a_run_continues_from_a_saved_state() {
    let start = [1.0, 0.5, 0.0, 0.0];
    let mut system = Plain::new(&[1.0; 4], double_pendulum);
    let whole = system.run("dop853", (0.0, &start), 2.0, &rtol(1e-12));
    let half = system.run("dop853", (0.0, &start), 1.0, &rtol(1e-12));
    let rest = system.run("dop853", (half.t, &half.y), 2.0, &rtol(1e-12));
    for (a, b) in whole.y.iter().zip(&rest.y) {
        assert!((a - b).abs() < 1e-10);
    }
}

#[test]
fn a_run_goes_backward() {
    for name in ["dop853", "tsit5", "radau", "rk4"] {
        let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -y[0]]));
        let options = if name == "rk4" { fixed(1e-3) } else { rtol(1e-10) };
        let run = system.run(name, (2.0, &[2.0_f64.cos(), -(2.0_f64.sin())]), -1.0, &options);
        assert_eq!((&run.outcome, run.t), (&Outcome::Completed, -1.0));
        assert!((run.y[0] - 1.0_f64.cos()).abs() < 1e-7, "{name}");
        let mut y = [0.0; 2];
        assert!(run.trajectory.at(0.5, &mut y) && (y[0] - 0.5_f64.cos()).abs() < 1e-6);
    }
}

#[test]
fn the_rate_is_taken_anew_after_a_projection() {
    struct Circle;
    impl System for Circle {
        fn dim(&self) -> usize {
            2
        }
        fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
            dy.copy_from_slice(&[-y[1], y[0]]);
            Ok(())
        }
        fn project(&mut self, _: f64, y: &mut [f64]) -> Result<f64, DynamicsError> {
            let r = y[0].hypot(y[1]);
            y.iter_mut().for_each(|y| *y /= r);
            Ok((r - 1.0).abs())
        }
    }
    let dop853 = method("dop853").unwrap();
    let run = run(&mut Circle, dop853, (0.0, &[1.0, 0.0]), 100.0, &rtol(1e-6), &mut |_| true);
    assert!((run.y[0].hypot(run.y[1]) - 1.0).abs() < 1e-15);
    assert!(run.largest_correction > 0.0);
    let mut bounds = run.trajectory.segments.windows(2);
    assert!(bounds.all(|pair| pair[0].end() == pair[1].start()));
}
