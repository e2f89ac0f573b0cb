//! Free-body diagrams of mechanisms thrown together: they are complete, and what joins two bodies acts on both.

use crate::random::*;
use crate::random_mechanisms::{recipe, HOME, MECHANISMS};
use crate::rng::Rng;
use freebody::dynamics::Route;
use freebody::free_bodies::free_bodies;
use freebody::mechanism::DriveKind;
use serde_json::Value;

/// Part of the largest load of an instant that is round-off: that of the solution, with some cancellation.
const ROUND_OFF: f64 = 1e-9;

fn pair(v: &Value) -> [f64; 2] {
    [v[0].as_f64().unwrap(), v[1].as_f64().unwrap()]
}

/// Force and moment about a place of one part of a load of a given size.
fn wrench(part: &Value, size: f64, about: [f64; 2]) -> [f64; 3] {
    let (point, force) = (pair(&part["point"]), pair(&part["force"]).map(|f| f * size));
    let arm = [point[0] - about[0], point[1] - about[1]];
    [force[0], force[1], part["couple"].as_f64().unwrap() * size + arm[0] * force[1] - arm[1] * force[0]]
}

fn size(load: &Value) -> f64 {
    load["value"].as_f64().unwrap_or(1.0)
}

fn every_diagram(mut visit: impl FnMut(&Value, &str)) {
    for seed in 0..MECHANISMS {
        let bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let mut workspace = bench.balance();
        let mut rng = Rng::new(seed);
        for _ in 0..5 {
            let state = bench.state(&mut workspace, &mut rng, 0.3).expect("a state");
            workspace.move_to(state.t, &state.q, &state.u);
            visit(&free_bodies(&mut workspace).expect("a solution"), &bench.label());
        }
    }
}

/// The loads on every body are its rate of momentum.
fn assert_balanced(label: &Value, name: &str) {
    let loads = label["loads"].as_array().unwrap();
    for body in label["bodies"].as_array().unwrap() {
        let (centre, mass) = (pair(&body["G"]), body["mass"].as_f64().unwrap());
        let a = pair(&body["a"]);
        let inertia = body["inertia"].as_f64().unwrap() * body["alpha"].as_f64().unwrap();
        let mut left = [-mass * a[0], -mass * a[1], -inertia];
        let mut largest = left.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        for load in loads {
            for part in load["on"].as_array().unwrap().iter().filter(|p| p["body"] == body["name"]) {
                for (sum, w) in left.iter_mut().zip(wrench(part, size(load), centre)) {
                    *sum += w;
                    largest = largest.max(w.abs());
                }
            }
        }
        let label = if body["particle"].as_bool().unwrap() { &left[..2] } else { &left[..] };
        assert!(label.iter().all(|x| x.abs() < ROUND_OFF * largest), "{} of {name}: {left:?}", body["name"]);
    }
}

#[test]
fn the_loads_on_every_body_are_its_rate_of_momentum() {
    every_diagram(assert_balanced);
}

/// A lock is a load like those of joints: with it every body balances, and what it locks stays; by whichever route.
#[test]
fn what_locks_hold_is_among_the_loads() {
    let mut held = 0;
    for seed in 0..MECHANISMS {
        let bench = Bench::new(&Recipe { locks: 2, ..recipe(seed) }.draw(seed, HOME));
        let m = &bench.compiled.mechanism;
        let Some(lock) = m.drives.iter().position(|drive| drive.kind == DriveKind::Lock) else { continue };
        let mut workspace = bench.balance();
        let state = bench.state(&mut workspace, &mut Rng::new(seed), 0.3).expect("a state");
        workspace.move_to(state.t, &state.q, &state.u);
        let label = format!("seed {seed}, {}", bench.label());
        let now = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}: {e:?}"));
        let sizes = workspace.balances().sizes;
        for (word, route) in Route::ALL {
            let other = workspace.instant(*route).unwrap_or_else(|e| panic!("{label}: {word}: {e:?}"));
            let most = workspace.balances().sizes.load.max(1.0);
            assert!((other.drives[lock] - now.drives[lock]).abs() < ROUND_OFF * most, "{label}: {word}");
        }
        let loads = free_bodies(&mut workspace).expect("a solution");
        assert_balanced(&loads, &label);
        let load = loads["loads"].as_array().unwrap().iter().find(|load| load["kind"] == "lock").expect("its load");
        assert!((size(load) - now.drives[lock]).abs() < ROUND_OFF * sizes.load.max(1.0), "{label}: {load}");
        let locked = m.drives[lock].name.trim_start_matches("lock ").trim_matches('\'');
        if let Some(a) = loads["accelerations"][locked].as_f64() {
            assert!(a.abs() < ROUND_OFF * sizes.acceleration.max(1.0), "{label}: it accelerates with {a:e}");
        }
        held += 1;
    }
    assert!(held > 15, "{held}");
}

#[test]
fn what_joins_two_bodies_acts_on_both_in_opposite_ways() {
    every_diagram(|label, name| {
        for load in label["loads"].as_array().unwrap().iter().filter(|l| l["kind"] == "joint") {
            let on = load["on"].as_array().unwrap();
            assert_eq!(on.len(), 2, "{name}: {load}");
            let [a, b] = [&on[0], &on[1]].map(|part| wrench(part, 1.0, [0.3, -0.7]));
            let scale = a.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            assert!(a.iter().zip(b).all(|(a, b)| (a + b).abs() < ROUND_OFF * scale), "{name}: {load}");
        }
    });
}
