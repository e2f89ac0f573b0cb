//! Thirty random mechanisms at a thousand random states: what must hold of any mechanism.

use crate::model::*;
use crate::random::*;
use crate::rng::Rng;
use freebody::dynamics::{force_power, force_value, unaccounted_power, Instant, JointLoad, Route, Workspace};
use freebody::kinematics::gradient;
use freebody::mode::Mode;

pub const MECHANISMS: u64 = 30;
const STATES: usize = 34;
/// How far states are from the pose thrown, m or rad.
const REACH: f64 = 0.3;
pub const HOME: Base = Base::At([0.0; 3]);

/// Agreement asked of the routes, relative to the largest acceleration, or the largest load, of the instant.
pub const AGREE: f64 = 1e-10;

/// Trees and loops, every other one driven.
pub fn recipe(seed: u64) -> Recipe {
    let mut rng = Rng::new(1000 + seed);
    let bodies = 1 + rng.below(12);
    Recipe {
        bodies,
        particles: rng.below(3),
        loops: (seed as usize % 4).min(bodies / 2),
        forces: rng.below(8),
        motions: rng.below(3),
        locks: usize::from(seed % 3 == 1),
        own_directions: seed.is_multiple_of(3),
        odd: true,
        idle: seed % 5 == 2,
    }
}

/// Visits states of random mechanisms; a mechanism without states would be a hole in the test.
fn every_state(
    recipe: impl Fn(u64) -> Recipe,
    states: usize,
    mut visit: impl FnMut(&Bench, &mut Workspace, &State, &str, &mut Rng),
) {
    for seed in 0..MECHANISMS {
        let bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let mut workspace = bench.balance();
        let mut rng = Rng::new(seed);
        for i in 0..states {
            let label = format!("seed {seed}, state {i}, {}", bench.label());
            let state = bench.state(&mut workspace, &mut rng, REACH).unwrap_or_else(|| panic!("no state: {label}"));
            workspace.move_to(state.t, &state.q, &state.u);
            visit(&bench, &mut workspace, &state, &label, &mut rng);
        }
    }
}

/// The same without actuators: the joints do no work.
fn ideal(seed: u64) -> Recipe {
    Recipe { motions: 0, ..recipe(seed) }
}

/// Accelerations of all bodies and coordinates.
pub fn motion(now: &Instant) -> Vec<f64> {
    now.bodies.iter().flatten().chain(&now.accelerations).copied().collect()
}

/// Determinate reactions and forces of actuators, 0 for the others.
pub fn loads(now: &Instant) -> Vec<f64> {
    let known = |x: f64, sure: bool| if sure { x } else { 0.0 };
    let joints = now
        .joints
        .iter()
        .zip(&now.determinate)
        .flat_map(|(l, sure)| [known(l.force.x, sure[0]), known(l.force.y, sure[1]), known(l.couple, sure[2])]);
    joints.chain(now.drives.iter().zip(&now.drives_determinate).map(|(&x, &sure)| known(x, sure))).collect()
}

#[test]
fn a_solution_knows_nothing_of_those_before() {
    every_state(recipe, 3, |bench, workspace, state, label, _| {
        let mode = workspace.mode().clone();
        for (word, route) in Route::ALL {
            let mut fresh = bench.balance();
            fresh.place(&mode, state.t, &state.q, &state.u);
            let (now, first) = (workspace.instant(*route), fresh.instant(*route));
            let text = |found: &Result<Instant, _>| format!("{found:?}");
            assert_eq!(text(&now), text(&first), "{word}, {label}");
        }
    });
}

/// The flank on which teeth bear is another reaction, never another motion.
#[test]
fn the_motion_alone_is_that_of_the_whole_solution() {
    every_state(recipe, 3, |bench, workspace, _, label, _| {
        let found = |workspace: &Workspace| {
            let mut accelerations = vec![0.0; bench.q.len()];
            workspace.accelerations(&mut accelerations);
            [accelerations, workspace.solved_view().drive_powers()].concat()
        };
        workspace.solve_motion().unwrap_or_else(|e| panic!("{label}: {e:?}"));
        let alone = found(workspace);
        workspace.solve().unwrap_or_else(|e| panic!("{label}: {e:?}"));
        let off = apart(&alone, &found(workspace), 1.0);
        assert!(off < AGREE, "{label}: {off:e}");
    });
}

#[test]
fn every_joint_holds_at_the_pose_thrown() {
    for seed in 0..MECHANISMS {
        let thrown = recipe(seed).draw(seed, HOME);
        let bench = Bench::new(&thrown);
        let mut workspace = bench.balance();
        workspace.move_to(0.0, &bench.q, &vec![0.0; bench.q.len()]);
        for body in bench.compiled.mechanism.listed_bodies() {
            let name = &bench.compiled.mechanism.bodies[body].name;
            let off = apart(&workspace.frame(body), &thrown.pose[name], 1.0);
            assert!(off < 1e-13, "seed {seed}: {name} is {off:e} off; {}", bench.label());
        }
    }
}

#[test]
fn the_three_routes_agree_and_every_body_balances() {
    let mut states = 0;
    every_state(recipe, STATES, |_, workspace, _, label, _| {
        let minimal = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}: {e:?}"));
        for (word, route) in Route::ALL {
            let now = workspace.instant(*route).unwrap_or_else(|e| panic!("{label}: {word}: {e:?}"));
            // Accelerations below 1 m/s² are nothing against gravity.
            let (a, f) = (apart(&motion(&minimal), &motion(&now), 1.0), apart(&loads(&minimal), &loads(&now), 1e-300));
            assert!(a < AGREE && f < AGREE, "{label}: {word}: accelerations {a:e}, reactions {f:e} apart");
            let residual = workspace.balances().residual;
            assert!(residual < 1e-12, "{label}: {word}: residual {residual:e}");
            assert_eq!(now.determinate, minimal.determinate, "{label}: {word}");
        }
        states += 1;
    });
    assert!(states >= 1000);
}

/// Small masses in loops behind large ones: from 1e-4 to 1e4 kg in one linkage of six bars.
#[test]
fn light_links_between_heavy_ones_keep_their_digits() {
    let mut rng = Rng::new(5);
    for i in 0..100 {
        let mut model = Model::new().gravity(0.0, -9.81);
        let bars = 5;
        let mut at = freebody::plane::vec2(0.0, 0.0);
        let (mut before, mut q) = ("ground.O".to_string(), vec![]);
        for b in 0..bars {
            let (mass, angle) = (10f64.powf(rng.about(4.0)), rng.about(1.5));
            let (body, pin, end) = (format!("b{b}"), format!("b{b}.A"), format!("b{b}.B"));
            model = model.body(&body, mass, 0.1 * mass, [0.5, 0.1]).point(&pin, [0.0, 0.0]).point(&end, [1.0, 0.0]);
            model = model.joint(&body, "hinge", &[("of", points(&[&before, &pin]))], &[&format!("q{b}")]);
            model.0.joints.last_mut().expect("just joined").coordinates[0].absolute = true;
            at += turned(freebody::plane::vec2(1.0, 0.0), angle);
            before = end;
            q.push(angle);
        }
        model = model.point("ground.E", [at.x, at.y]);
        let compiled = model.joint("close", "hinge", &[("of", points(&[&before, "ground.E"]))], &[]).compile();
        let mut workspace = Workspace::new(&compiled.mechanism, &[]);
        let mut u = rng.vector(bars, 1.0);
        workspace.project_velocities(&Mode::free(workspace.m), 0.0, &q, &mut u).expect("closed as drawn");
        workspace.move_to(0.0, &q, &u);
        let found: Vec<Instant> = Route::ALL.iter().map(|r| workspace.instant(r.1).expect("moves")).collect();
        for now in &found {
            let off = apart(&motion(&found[0]), &motion(now), 1.0);
            assert!(off < AGREE, "draw {i}: accelerations {off:e} apart");
        }
    }
}

/// d(kinetic + potential)/dt is the power of what has no potential, actuators included.
#[test]
fn energy_changes_by_the_power_put_in() {
    every_state(recipe, 8, |bench, workspace, _, label, _| {
        workspace.solve().unwrap_or_else(|e| panic!("{label}: {e:?}"));
        let m = &bench.compiled.mechanism;
        let at = workspace.at();
        let n = at.n;
        let mut terms = vec![];
        for b in 1..m.bodies.len() {
            let (v, w) = (workspace.centre(b).1, at.k.twist[b].w);
            terms.push(n.mass[b] * v.dot(workspace.centre_acceleration(b) - n.gravity));
            terms.push(n.inertia[b] * w * workspace.solved().bodies[b].w);
        }
        terms.extend((0..m.forces.len()).map(|force| -unaccounted_power(at, force)));
        for potential in at.forces().filter_map(|(_, force)| force.potential.as_ref()) {
            terms.extend(m.bodies_of(potential).into_iter().map(|b| gradient(at, potential, b).power(at.k.twist[b])));
        }
        terms.extend(workspace.solved_view().drive_powers().iter().map(|p| -p));
        // Ideal joints transmit any power; what they take in at one body they give out at the other.
        let left: f64 = terms.iter().sum();
        let transmitted =
            workspace.solved_view().joint_loads().iter().map(|l| l.force.norm() + l.couple.abs()).fold(1.0, f64::max);
        let size = terms.iter().fold(transmitted, |m: f64, x| m.max(x.abs()));
        assert!(left.abs() < AGREE * size, "{label}: {left:e} of {size:e} W is unaccounted for");
    });
}

/// What is not in place is as if it were not in the model: the motion, the reactions, the energies, the powers. Both by the route that
/// is the same algorithm for trees and loops: a tree that has motions only later is no longer one for `minimal`.
#[test]
fn what_is_not_in_place_does_nothing() {
    let mut idle = 0;
    for seed in 0..MECHANISMS {
        let thrown = Recipe { idle: true, forces: 6, ..recipe(seed) }.draw(seed, HOME);
        let (whole, bare) = (Bench::new(&thrown), Bench::without_idle(&thrown));
        let (mut with, mut without) = (whole.balance(), bare.balance());
        let state = bare.state(&mut without, &mut Rng::new(seed), REACH).expect("a state");
        with.move_to(0.0, &whole.q, &vec![0.0; whole.q.len()]);
        let mode = with.with_row_offsets();
        with.enter(&mode);
        for workspace in [&mut with, &mut without] {
            workspace.move_to(state.t, &state.q, &state.u);
        }
        let label = format!("seed {seed}, {}", whole.label());
        let [a, b] = [&mut with, &mut without]
            .map(|workspace| workspace.instant(Route::Constraints).unwrap_or_else(|e| panic!("{label}: {e:?}")));
        assert!(apart(&motion(&a), &motion(&b), 1.0) < AGREE, "{label}");
        let named = |workspace: &Workspace, joints: bool, now: &Instant| -> Vec<(String, [f64; 3])> {
            let joint =
                |(j, l): (usize, &JointLoad)| (workspace.m.joints[j].name.clone(), [l.force.x, l.force.y, l.couple]);
            let drive = |(d, f): (usize, &f64)| (workspace.m.drives[d].name.clone(), [*f, 0.0, 0.0]);
            let all = now.joints.iter().enumerate().map(joint).take(if joints { usize::MAX } else { 0 });
            all.chain(now.drives.iter().enumerate().map(drive)).collect()
        };
        let sure = a.determinate.iter().flatten().all(|&sure| sure);
        let (mine, theirs) = (named(&with, sure, &a), named(&without, sure, &b));
        let most = theirs.iter().flat_map(|(_, load)| load).fold(1.0_f64, |most, x| most.max(x.abs()));
        for (name, load) in mine {
            let other = theirs.iter().find(|(n, _)| *n == name).map_or([0.0; 3], |(_, load)| *load);
            assert!((0..3).all(|i| (load[i] - other[i]).abs() < AGREE * most), "{label}: {name}: {load:?} {other:?}");
        }
        for (what, x, y) in [
            ("kinetic", with.kinetic_energy(), without.kinetic_energy()),
            ("potential", with.potential_energy(), without.potential_energy()),
        ] {
            assert!((x - y).abs() <= 1e-13 * x.abs().max(1.0), "{label}: {what} {x} {y}");
        }
        for (f, force) in with.m.forces.iter().enumerate() {
            let there = thrown.model.0.forces.iter().any(|spec| spec.name == force.name && spec.engaged);
            idle += usize::from(!there);
            let powers = [force_power(with.at(), f), unaccounted_power(with.at(), f), force_value(with.at(), f)];
            assert!(there || powers == [0.0; 3], "{label}: {}: {powers:?}", force.name);
        }
    }
    assert!(idle > 50, "{idle}");
}

/// Where joints do no work, the acceleration of coordinate i for a unit load on j is that of j for a unit load on i.
#[test]
fn accelerations_are_reciprocal() {
    for seed in 0..MECHANISMS {
        let mut thrown = ideal(seed).draw(seed, HOME);
        let first = Bench::new(&thrown);
        let names: Vec<String> =
            (0..first.q.len()).map(|i| first.compiled.mechanism.coordinate(i).name.clone()).collect();
        for (i, name) in names.iter().enumerate() {
            thrown.model = std::mem::take(&mut thrown.model).parameter(&format!("load{i}"), 0.0).force(
                &format!("push{i}"),
                "law",
                &[("along", text(format!("'{name}'"))), ("value", text(format!("load{i}")))],
            );
        }
        let bench = Bench::new(&thrown);
        let mut workspace = bench.balance();
        let mut rng = Rng::new(seed);
        let state = bench.state(&mut workspace, &mut rng, REACH).unwrap_or_else(|| panic!("seed {seed}: no state"));
        let n = names.len();
        let mut response = |loaded: Option<usize>| {
            let mut p = bench.p.clone();
            if let Some(i) = loaded {
                let load = bench.compiled.names.parameters[&format!("load{i}")];
                p[load] = 1.0;
            }
            workspace.rebind(&p);
            workspace.move_to(state.t, &state.q, &state.u);
            workspace.solve().unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
            let mut a = vec![0.0; n];
            workspace.accelerations(&mut a);
            a
        };
        let rest = response(None);
        let columns: Vec<Vec<f64>> = (0..n).map(|i| response(Some(i))).collect();
        for i in 0..n {
            for j in 0..i {
                let (a, b) = (columns[i][j] - rest[j], columns[j][i] - rest[i]);
                // Both are small differences of accelerations as large as those at rest.
                let size = rest[i]
                    .abs()
                    .max(rest[j].abs())
                    .max(columns[i][j].abs())
                    .max(columns[j][i].abs())
                    .max(1.0)
                    .max(columns[i][i].abs())
                    .max(columns[j][j].abs());
                assert!(
                    (a - b).abs() < AGREE * size,
                    "seed {seed}, {} and {}: {a} {b}; {}",
                    names[i],
                    names[j],
                    bench.label()
                );
            }
        }
    }
}

/// A load found as the force that a motion takes gives that motion back, and nothing else changes.
#[test]
fn inverse_dynamics_undoes_forward_dynamics() {
    for seed in 0..MECHANISMS {
        let thrown = ideal(seed).draw(seed, HOME);
        let plain = Bench::new(&thrown);
        let name = plain.compiled.mechanism.coordinate(seed as usize % plain.q.len()).name.clone();
        let load = 3.0;
        let mut pushed = thrown.clone();
        pushed.model =
            pushed.model.force("push", "law", &[("along", text(format!("'{name}'"))), ("value", value(load))]);
        let pushed = Bench::new(&pushed);
        let mut workspace = pushed.balance();
        let mut rng = Rng::new(seed);
        let state = pushed.state(&mut workspace, &mut rng, REACH).unwrap_or_else(|| panic!("seed {seed}: no state"));
        workspace.move_to(state.t, &state.q, &state.u);
        let forward = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
        let i = index_of(&pushed.compiled.mechanism, &name);
        let law = format!("{:?}", forward.accelerations[i]);
        let mut driven = thrown.clone();
        driven.model = driven.model.motion("push", &format!("'{name}'"), &law, "acceleration", None);
        let driven = Bench::new(&driven);
        let mut workspace = driven.balance();
        workspace.move_to(state.t, &state.q, &state.u);
        let inverse = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
        let label = format!("seed {seed}, {name}, {}", driven.label());
        let push = driven.compiled.mechanism.drives.iter().position(|d| d.name == "push").expect("the motion");
        let mut others = loads(&inverse);
        others.remove(3 * inverse.joints.len() + push);
        let (a, f) = (apart(&motion(&forward), &motion(&inverse), 1.0), apart(&loads(&forward), &others, load));
        assert!(a < AGREE, "{label}: accelerations {a:e} apart");
        if inverse.drives_determinate[push] {
            let mass = pushed.compiled.mechanism.bind(&pushed.p).mass.iter().sum::<f64>();
            let inertial = motion(&forward).iter().fold(0.0_f64, |m, x| m.max(x.abs())) * mass;
            let most = loads(&forward).iter().fold(inertial.max(load), |m, x| m.max(x.abs()));
            assert!(
                (inverse.drives[push] - load).abs() < AGREE * most,
                "{label}: {} N for {load} N",
                inverse.drives[push]
            );
            assert!(f < AGREE, "{label}: reactions {f:e} apart");
        }
    }
}

/// The power of every force is that of its loads on the bodies.
#[test]
fn power_is_load_times_velocity() {
    every_state(recipe, 4, |bench, workspace, _, label, _| {
        let m = &bench.compiled.mechanism;
        let at = workspace.at();
        for (f, force) in at.forces() {
            let mut on = vec![freebody::plane::Wrench::zero(); m.bodies.len()];
            freebody::dynamics::add_force(at, force, &mut on);
            let terms: Vec<f64> = on.iter().zip(&at.k.twist).map(|(w, v)| w.power(*v)).collect();
            let size = terms.iter().fold(1e-300, |m: f64, x| m.max(x.abs()));
            let (power, told_by_law) = (terms.iter().sum::<f64>(), force_power(at, f));
            assert!((power - told_by_law).abs() <= 1e-13 * size, "{label}: {}: {power} {told_by_law}", force.name);
        }
    });
}
