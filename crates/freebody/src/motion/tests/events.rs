//! Events.

use super::*;
use crate::motion::roots::{chebyshev, chebyshev_points, extrema, monomial, value};
use proptest::prelude::*;

fn clock<'a>() -> Plain<'a> {
    Plain::new(&[1.0], |_, _, dy| dy[0] = 1.0)
}

fn times(run: &Run) -> Vec<f64> {
    run.events.iter().map(|event| event.t).collect()
}

/// A deterministic number in [0, 1).
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn a_crossing_is_found_to_the_last_digits() {
    let mut system =
        Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -y[0]])).watching(&[0], |_, y, g| g[0] = y[0]);
    let run = system.run("dop853", (0.0, &[1.0, 0.0]), 5.0, &rtol(1e-14));
    let truth = [0.5, 1.5].map(|k| k * std::f64::consts::PI);
    assert_eq!(run.events.len(), 2);
    for (event, truth) in run.events.iter().zip(truth) {
        println!("{:e}", event.t - truth);
        assert!((event.t - truth).abs() < 4e-15);
    }
    assert_eq!([run.events[0].direction, run.events[1].direction], [-1, 1]);
}

#[test]
fn a_located_state_is_on_the_event() {
    for name in ["dop853", "tsit5", "radau"] {
        let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -y[0]]))
            .watching(&[0], |_, y, g| g[0] = y[0] - 0.3);
        let run = system.run(name, (0.0, &[1.0, 0.0]), 20.0, &rtol(1e-6));
        assert_eq!(run.events.len(), 6, "{name}");
        assert!(run.events.iter().all(|e| (e.y[0] - 0.3).abs() < 1e-14), "{name}");
        let mut ends = run.trajectory.segments.iter().map(|s| s.t1);
        assert!(run.events.iter().all(|event| ends.any(|t| t == event.t)));
    }
}

#[test]
fn no_double_crossing_of_a_cubic_is_missed() {
    let mut seed = 1;
    for _ in 0..10_000 {
        let gap = 10.0_f64.powf(-6.0 * random(&mut seed));
        let a = 0.001 + (0.998 - gap) * random(&mut seed);
        let (b, c) = (a + gap, 3.0 * random(&mut seed) - 1.0);
        // Else the function stays within the tolerance between the roots: it touches.
        let depth = 0.25 * gap * gap * (c - a).abs().min((c - b).abs());
        if depth < 1e-12 {
            continue;
        }
        let sign = if random(&mut seed) < 0.5 { -1.0 } else { 1.0 };
        let mut expected: Vec<f64> = [a, b, c].into_iter().filter(|t| (0.0..1.0).contains(t)).collect();
        expected.sort_by(f64::total_cmp);
        let mut system = clock().watching(&[0], |_, y, g| {
            g[0] = sign * (y[0] - a) * (y[0] - b) * (y[0] - c);
        });
        let options = Options { first_step: Some(1.0), ..rtol(1e-14) };
        let run = system.run("dop853", (0.0, &[0.0]), 1.0, &options);
        let crossings: Vec<f64> = run.events.iter().filter(|e| e.kind == Kind::Crossing).map(|e| e.t).collect();
        assert_eq!(crossings.len(), expected.len(), "{crossings:?} {expected:?}");
        assert!(crossings.iter().zip(&expected).all(|(t, truth)| (t - truth).abs() < 1e-8));
    }
}

/// What passes by is near for a part of a step only: where its distance, a V, reaches zero between two looks, that is found.
#[test]
fn no_dip_of_what_passes_by_is_missed() {
    let mut seed = 2;
    for _ in 0..1_000 {
        let (a, depth) = (0.3 + 0.4 * random(&mut seed), 10.0_f64.powf(-1.5 - 1.5 * random(&mut seed)));
        let mut system = clock().watching(&[0], |_, y, g| g[0] = (4.5 * (y[0] - a).abs()).min(1.0) - depth);
        let options = Options { first_step: Some(1.0), ..rtol(1e-14) };
        let found = times(&system.run("dop853", (0.0, &[0.0]), 1.0, &options));
        let truth = [a - depth / 4.5, a + depth / 4.5];
        let is_found = found.len() == 2 && found.iter().zip(truth).all(|(t, truth)| (t - truth).abs() < 1e-12);
        assert!(is_found, "{a} {depth} {found:?}");
    }
}

/// sin grazes 1: once, whatever the tolerance makes of its height, and wherever steps end.
#[test]
fn a_graze_is_one_touch_at_every_tolerance() {
    for (i, name) in (0..17).flat_map(|i| ["dop853", "tsit5", "radau"].map(|name| (i, name))) {
        let tolerance = 10.0_f64.powf(-6.0 - 7.0 * f64::from(i) / 16.0);
        for phase in [0.0_f64, 0.4, 1.1, 2.3] {
            let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -y[0]]))
                .watching(&[0], |_, y, g| g[0] = y[0] - 1.0);
            let run = system.run(name, (0.0, &[-phase.sin(), phase.cos()]), 6.0, &rtol(tolerance));
            let label = format!("{name}, {tolerance:e}, {phase}: {:?}", run.events);
            assert!(run.outcome == Outcome::Completed && run.events.len() == 1, "{label}");
            assert_eq!(run.events[0].kind, Kind::Touch, "{label}");
            let truth = std::f64::consts::FRAC_PI_2 + phase;
            assert!((run.events[0].t - truth).abs() < 30.0 * tolerance + 1e-7, "{label}");
        }
    }
}

/// What decays crosses zero however small it has become.
#[test]
fn small_oscillations_cross_zero() {
    let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -y[0] - 0.2 * y[1]]))
        .watching(&[0], |_, y, g| g[0] = y[0]);
    let run = system.run("dop853", (0.0, &[1.0, 0.0]), 300.0, &rtol(1e-9));
    let times = times(&run);
    assert!(run.events.iter().all(|event| event.kind == Kind::Crossing));
    let half = std::f64::consts::PI / 0.99_f64.sqrt();
    assert_eq!(times.len(), (300.0 / half).round() as usize);
}

/// An event that comes more often than can be recorded says so; the motion goes on.
#[test]
fn what_is_only_recorded_never_ends_a_run() {
    let mut system = clock().watching(&[0], |t, _, g| g[0] = if (t * 1e14) as i64 % 2 == 0 { 1.0 } else { -1.0 });
    let run = system.run("dop853", (0.0, &[0.0]), 1.0, &rtol(1e-9));
    assert_eq!((run.outcome, run.unrecorded.len()), (Outcome::Completed, 1));
}

/// A point passes a peg: its distance is a V, and it is inside for as little as a millionth of the step. Where it goes in by less
/// than is known of the distance, it touches.
#[test]
fn a_short_visit_is_not_missed() {
    let mut seed = 5;
    for _ in 0..10_000 {
        let radius = 10.0_f64.powf(-6.0 * random(&mut seed));
        let at = 2.0 * radius + 1.0 + random(&mut seed);
        let off = 0.99 * radius * (2.0 * random(&mut seed) - 1.0);
        let half = (radius * radius - off * off).sqrt();
        let mut system = clock().watching(&[0], |_, y, g| g[0] = (y[0] - at).hypot(off) - radius);
        let end = 2.5 + 4.0 * radius;
        let options = Options { first_step: Some(end), ..rtol(1e-9) };
        let found = times(&system.run("dop853", (0.0, &[0.0]), end, &options));
        if radius - off.abs() < 100.0 * options.rtol && found.len() == 1 {
            assert!((found[0] - at).abs() < 2.0 * half, "{radius} {off} {at}");
            continue;
        }
        assert_eq!(found.len(), 2, "{radius} {off} {at}");
        assert!((found[0] - at + half).abs() < 1e-9 && (found[1] - at - half).abs() < 1e-9);
    }
}

#[test]
fn touches_are_told_apart_and_not_acted_on() {
    let mut acted = 0;
    let mut system = Plain::new(&[1.0], |_, _, dy| dy[0] = 1.0)
        .watching(&[0], |_, y, g| g[0] = (y[0] - 0.37).powi(2) * (y[0] - 0.8))
        .acting(|_, _, _| {
            acted += 1;
            After::Continue
        });
    let options = Options { first_step: Some(1.0), ..rtol(1e-9) };
    let run = system.run("dop853", (0.0, &[0.0]), 1.0, &options);
    drop(system);
    let kinds: Vec<Kind> = run.events.iter().map(|e| e.kind).collect();
    assert_eq!(kinds, [Kind::Touch, Kind::Crossing]);
    assert!((run.events[0].t - 0.37).abs() < 1e-9 && (run.events[1].t - 0.8).abs() < 1e-14);
    assert_eq!(acted, 1);
}

#[test]
fn a_touch_on_the_border_of_two_steps_is_seen_once() {
    let mut system = clock().watching(&[0], |t, _, g| g[0] = (t - 0.5).powi(2));
    let run = system.run("rk4", (0.0, &[0.0]), 1.0, &fixed(0.25));
    assert_eq!(run.events.len(), 1);
    assert_eq!(run.events[0].kind, Kind::Touch);
}

#[test]
fn a_crossing_on_the_border_of_two_steps_is_seen_once() {
    for direction in [-1.0, 1.0] {
        let mut system = clock().watching(&[0], |t, _, g| g[0] = direction * (t - 0.5));
        assert_eq!(times(&system.run("rk4", (0.0, &[0.0]), 1.0, &fixed(0.25))), [0.5]);
    }
}

/// A run up to the crossing sees it, and one that goes on from there does not see it again.
#[test]
fn a_crossing_at_the_end_is_seen_once() {
    for (start, end, beyond) in [(0.0, 0.5, 1.0), (1.0, 0.5, 0.0)] {
        for direction in [-1.0, 1.0] {
            let mut system = clock().watching(&[0], |t, _, g| g[0] = direction * (t - 0.5));
            let first = system.run("dop853", (start, &[0.0]), end, &rtol(1e-9));
            assert_eq!(times(&first), [0.5]);
            assert_eq!(f64::from(first.events[0].direction), direction);
            assert!(system.run("dop853", (end, &first.y), beyond, &rtol(1e-9)).events.is_empty());
        }
    }
    let mut system = clock().watching(&[1], |t, _, g| g[0] = 0.5 - t);
    assert!(system.run("dop853", (0.0, &[0.0]), 0.5, &rtol(1e-9)).events.is_empty(), "it falls");
}

#[test]
fn a_zero_at_the_start_counts_when_the_function_comes_back() {
    for sign in [-1.0, 1.0] {
        let mut system = clock().watching(&[0], |t, _, g| g[0] = sign * t * (t - 0.01));
        let options = Options { first_step: Some(1.0), ..rtol(1e-9) };
        let found = times(&system.run("dop853", (0.0, &[0.0]), 1.0, &options));
        assert!(found.len() == 1 && (found[0] - 0.01).abs() < 1e-15, "{found:?}");
    }
}

#[test]
fn directions_and_order_are_kept() {
    let mut system = clock().watching(&[1, -1, 0], |t, _, g| {
        g.copy_from_slice(&[(20.0 * t).sin(), (20.0 * t).sin(), t - 0.4]);
    });
    let run = system.run("dop853", (0.0, &[0.0]), 1.0, &Options { max_step: 0.2, ..rtol(1e-9) });
    let order: Vec<usize> = run.events.iter().map(|e| e.index).collect();
    let pi = std::f64::consts::PI;
    assert_eq!(order, [1, 0, 2, 1, 0, 1, 0]);
    for (k, t) in times(&run).into_iter().filter(|t| *t != 0.4).enumerate() {
        assert!((t - pi * (k + 1) as f64 / 20.0).abs() < 1e-14);
    }
}

#[test]
fn ties_are_simultaneous() {
    let mut system = clock().watching(&[0, 0], |t, _, g| {
        g.copy_from_slice(&[t - 0.3, 1e5 * (t * t - 0.09)]);
    });
    let run = system.run("dop853", (0.0, &[0.0]), 1.0, &rtol(1e-9));
    assert_eq!(run.events.len(), 2);
    assert_eq!(run.events[0].t, run.events[1].t);
}

/// A ball dropped from 1 m that keeps 0.8 of its speed at each bounce.
#[test]
fn a_ball_bounces_where_it_should() {
    let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -9.81]))
        .watching(&[-1], |_, y, g| g[0] = y[0])
        .acting(|_, _, y| {
            y[1] *= -0.8;
            After::Restart
        });
    let run = system.run("dop853", (0.0, &[1.0, 0.0]), 3.0, &rtol(1e-10));
    let (mut t, mut speed) = ((2.0_f64 / 9.81).sqrt(), (2.0_f64 * 9.81).sqrt());
    assert_eq!(run.events.len(), 6);
    for event in &run.events {
        assert!((event.t - t).abs() < 1e-12, "{} {t}", event.t);
        speed *= 0.8;
        t += 2.0 * speed / 9.81;
    }
}

#[test]
fn a_ball_that_comes_to_rest_is_named() {
    let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -9.81]))
        .watching(&[-1], |_, y, g| g[0] = y[0])
        .acting(|_, _, y| {
            y[1] *= -0.5;
            After::Restart
        });
    let run = system.run("dop853", (0.0, &[1.0, 0.0]), 3.0, &rtol(1e-10));
    println!("{:?} at {} after {} bounces", run.outcome, run.t, run.events.len());
    let rest = 3.0 * (2.0_f64 / 9.81).sqrt();
    assert!(matches!(run.outcome, Outcome::Chatter { .. }));
    assert!((run.t - rest).abs() < 1e-7);
}

#[test]
fn a_stopping_event_ends_the_run() {
    let mut system = clock().watching(&[0], |_, y, g| g[0] = y[0] - 0.3).acting(|_, _, _| After::Stop);
    let run = system.run("tsit5", (0.0, &[0.0]), 1.0, &rtol(1e-9));
    assert_eq!(run.outcome, Outcome::StoppedByEvent { index: 0 });
    assert!((run.t - 0.3).abs() < 1e-16 && run.outcome.is_ok());
}

/// ẍ = −sign(x)·1, x(0) = 0, ẋ(0) = 1: each half swing takes 2.
#[test]
fn kinks_are_passed_exactly() {
    let side = std::cell::Cell::new(1.0);
    let mut system = Plain::new(&[1.0, 1.0], |_, y, dy| dy.copy_from_slice(&[y[1], -side.get()]))
        .watching(&[0], |_, y, g| g[0] = y[0])
        .acting(|_, _, _| {
            side.set(-side.get());
            After::Continue
        });
    system.watches[0].role = Role::Discontinuity;
    let run = system.run("dop853", (0.0, &[0.0, 1.0]), 41.0, &rtol(1e-10));
    println!("{:?}, {} kinks, {} steps", run.y, run.discontinuities, run.accepted);
    assert_eq!((run.discontinuities, run.events.len()), (20, 0));
    assert!((run.y[0] - 0.5).abs() < 1e-11 && run.y[1].abs() < 1e-11);
}

/// An action that takes the level away from where the motion is: it comes to the new one later, and not again at once.
#[test]
fn a_level_that_is_moved_away_is_not_crossed() {
    for direction in [0, -1] {
        let level = std::cell::Cell::new(0.5);
        let mut system = Plain::new(&[1.0], |_, _, dy| dy[0] = -1.0)
            .watching(&[direction], |_, y, g| g[0] = y[0] - level.get())
            .acting(|_, _, _| {
                level.set(0.2);
                After::Restart
            });
        let run = system.run("dop853", (0.0, &[1.0]), 3.0, &rtol(1e-9));
        let times: Vec<f64> = run.events.iter().map(|event| event.t).collect();
        assert!(
            times.len() == 2 && (times[0] - 0.5).abs() < 1e-12 && (times[1] - 0.8).abs() < 1e-12,
            "{:?} {times:?}",
            run.outcome
        );
    }
}

#[test]
fn events_are_found_going_backward() {
    let mut system = clock().watching(&[1, -1], |t, _, g| g.copy_from_slice(&[t - 0.3, t - 0.3]));
    let run = system.run("dop853", (1.0, &[0.0]), 0.0, &rtol(1e-9));
    assert_eq!(run.events.len(), 1);
    assert_eq!((run.events[0].index, run.events[0].direction), (0, 1));
}

proptest! {
    #[test]
    fn all_extrema_of_a_polynomial_are_found(roots in prop::collection::vec(-0.99..0.99f64, 7)) {
        let mut roots = roots;
        roots.sort_by(f64::total_cmp);
        prop_assume!(roots.windows(2).all(|pair| pair[1] - pair[0] > 1e-2));
        let f = |x: f64| roots.iter().fold(1.0, |product, root| product * (x - root));
        let samples = chebyshev_points().map(f);
        let polynomial = monomial(&chebyshev(&samples));
        prop_assert!((value(&polynomial, 0.3) - f(0.3)).abs() < 1e-13);
        let found = extrema(&polynomial, 1.0);
        prop_assert_eq!(found.len(), 6);
        for (x, pair) in found.iter().zip(roots.windows(2)) {
            prop_assert!(pair[0] < *x && *x < pair[1]);
        }
    }
}

/// Of three guards one dips below zero between two samples, and turns only after two others have fallen: it is the first.
#[test]
fn no_dip_before_other_guards_is_missed() {
    let acted = std::cell::RefCell::new(vec![]);
    let mut system = clock()
        .watching(&[-1, -1, -1], |_, y, g| {
            let t = y[0];
            g.copy_from_slice(&[0.36 - t, 0.38 - t, (t - 0.34) * (t - 0.46)]);
        })
        .acting(|_, t, _| {
            acted.borrow_mut().push(t);
            After::Restart
        });
    system.watches = vec![EventSpec::guard(1.0); 3];
    let options = Options { first_step: Some(1.0), ..rtol(1e-14) };
    let _ = system.run("dop853", (0.0, &[0.0]), 1.0, &options);
    assert!((acted.borrow()[0] - 0.34).abs() < 1e-12, "{acted:?}");
}

/// Of a polynomial of degree 2 the coefficients are the same from 3, 5 and 9 of the points.
#[test]
fn few_points_tell_a_parabola() {
    let points = chebyshev_points();
    let parabola = |x: f64| 3.0 - 2.0 * x + 0.5 * (2.0 * x * x - 1.0);
    let few = chebyshev::<3>(&std::array::from_fn(|j| parabola(points[4 * j])));
    let some = chebyshev::<5>(&std::array::from_fn(|j| parabola(points[2 * j])));
    for coefficients in [&few[..], &some[..], &chebyshev(&points.map(parabola))[..]] {
        for (k, c) in coefficients.iter().enumerate() {
            let known = [3.0, -2.0, 0.5].get(k).copied().unwrap_or(0.0);
            assert!((c - known).abs() < 1e-14, "{coefficients:?}");
        }
    }
}

/// Dry friction on a block at rest: the sliding law flips at v = 0 without end.
#[test]
fn sliding_on_a_kink_is_named() {
    let side = std::cell::Cell::new(1.0);
    let mut system = Plain::new(&[1.0], |_, _, dy| dy[0] = 0.3 - side.get())
        .watching(&[0], |_, y, g| g[0] = y[0])
        .acting(|_, _, _| {
            side.set(-side.get());
            After::Continue
        });
    system.watches[0].role = Role::Discontinuity;
    let run = system.run("dop853", (0.0, &[0.7]), 3.0, &rtol(1e-9));
    assert!(matches!(run.outcome, Outcome::Chatter { .. }));
    assert!((run.t - 1.0).abs() < 1e-12);
}

/// What opens so slowly that it stays within its round-off for a while and then falls has fallen where it leaves that, whatever signs its
/// round-off has before.
#[test]
fn a_guard_falls_where_it_leaves_its_roundoff() {
    let (opens, falls) = (0.1, 0.1 + 5e-8);
    let acted = std::cell::RefCell::new(vec![]);
    let mut system = clock()
        .watching(&[-1], |_, y, g| {
            g[0] = match acted.borrow().len() {
                0 => opens - y[0],
                1 if y[0] < falls => 1e-17 * (opens + 1e-12 - y[0]).signum(),
                1 => -0.02 * (y[0] - falls),
                _ => 1.0,
            }
        })
        .acting(|_, t, _| {
            acted.borrow_mut().push(t);
            After::Restart
        });
    system.watches[0] = EventSpec::guard(1.0);
    let run = system.run("dop853", (0.0, &[0.0]), 1.0, &rtol(1e-9));
    let acted = acted.borrow();
    assert!(run.outcome.is_ok() && acted.len() == 2 && (acted[1] - falls).abs() < 1e-12, "{} {acted:?}", run.outcome);
}
