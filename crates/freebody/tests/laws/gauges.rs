//! Gauges and forces: what a gauge reads, its rate, and the loads along it are one thing; every force of the list.

use crate::model::*;
use crate::random::*;
use crate::random_motions::*;
use crate::rng::Rng;
use freebody::builder::{Reach, Scope};
use freebody::compile::Compiled;
use freebody::dynamics::{add_force, force_power, Workspace};
use freebody::expr::Env;
use freebody::forces;
use freebody::gauges::{ModelExpr, ModelVariable};
use freebody::hybrid::{simulate, Settings, Start};
use freebody::joints::Kind;
use freebody::kinematics::{gradient, jet, Config, Kinematics, MotionView, StateView};
use freebody::plane::{vec2, Pose, Turn, Twist, Vec2, Wrench};
use freebody::spec::{Line, Spec};

/// A mechanism with every joint of the list that can be in a tree, a particle, and a named line.
fn zoo(seed: u64) -> Thrown {
    let mut rng = Rng::new(seed);
    let rng = &mut rng;
    let mut thrown = Thrown::new([1.0, -9.81]);
    let mut bodies = vec!["ground".to_string()];
    for (i, &kind) in Kind::ALL.iter().filter(|&&k| has_pose(k)).enumerate() {
        let name = format!("b{i}");
        let mass = rng.within(0.5, 2.0);
        let place = [rng.about(2.0), rng.about(2.0), rng.about(3.0)];
        thrown.throw(&name, literal(mass), literal(0.3 * mass), [rng.about(0.3), rng.about(0.3)], place);
        let parent = rng.of(&bodies).clone();
        let turned_round = i % 2 == 1;
        let ends = if turned_round { [name.as_str(), &parent] } else { [parent.as_str(), &name] };
        thrown.join(rng, &format!("j{i}"), kind, ends, true, !turned_round);
        bodies.push(name);
    }
    thrown.throw_particle("bead", literal(0.7), [rng.about(2.0), rng.about(2.0)]);
    thrown.join(rng, "string", Kind::Link, ["b0", "bead"], true, true);
    let p = thrown.some_point("b1", rng);
    thrown.model.0.lines.push(Line { name: "b1.line".into(), line: place(&p, 0.4) });
    thrown
}

/// Every function that a gauge may call, with arguments that it takes; and every coordinate.
fn gauges(spec: &Spec, compiled: &mut Compiled) -> Vec<(String, ModelExpr)> {
    let point = |i: usize| spec.points.iter().rev().nth(i).expect("points were thrown").name.clone();
    let arguments = [
        format!("({})", point(0)),
        format!("({}, {})", point(1), point(4)),
        format!("({}, b1.line)", point(3)),
        "(b2)".to_string(),
        "(bead.origin)".to_string(),
    ];
    let words = words(compiled);
    let calls = words.iter().flat_map(|w| arguments.iter().map(move |a| format!("{w}{a}")));
    let m = &compiled.mechanism;
    let coordinates = (0..m.freedom()).map(|i| format!("'{}'", m.coordinate(i).name));
    let texts: Vec<String> = calls.chain(coordinates).collect();
    let mut read = |text: &String| {
        let mut scope =
            Scope { names: &compiled.names, reach: Reach::Configuration, switches: &mut compiled.mechanism.switches };
        let law = scope.law(text).ok()?;
        let measures = law.variables().any(|leaf| !matches!(leaf, ModelVariable::Parameter(_)));
        measures.then(|| (text.clone(), law))
    };
    texts.iter().filter_map(&mut read).collect()
}

/// The functions of places and bodies that expressions know.
fn words(compiled: &mut Compiled) -> Vec<String> {
    use freebody::expr::Scope as _;
    Scope { names: &compiled.names, reach: Reach::Configuration, switches: &mut compiled.mechanism.switches }
        .functions()
}

fn read(at: StateView<'_>, law: &ModelExpr) -> f64 {
    let env = Config { poses: &at, m: at.m, mode: at.mode };
    law.eval::<f64, dyn Env<f64, ModelVariable>>(&env)
}

/// A random state of a zoo, with everything that can be measured in it.
fn every_zoo(mut visit: impl FnMut(&Bench, &mut Workspace, &[(String, ModelExpr)], &str, &mut Rng)) {
    for seed in 0..6 {
        let thrown = zoo(seed);
        let mut bench = Bench::new(&thrown);
        let list = gauges(&thrown.model.0, &mut bench.compiled);
        let mut rng = Rng::new(100 + seed);
        let u = rng.vector(bench.q.len(), 1.5);
        let mut workspace = bench.balance();
        workspace.move_to(0.3, &bench.q, &u);
        visit(&bench, &mut workspace, &list, &format!("seed {seed}"), &mut rng);
    }
}

#[test]
fn every_function_of_the_configuration_is_measured() {
    every_zoo(|_, _, list, label, _| {
        for word in ["x", "y", "angle", "distance", "direction", "along", "across"] {
            assert!(list.iter().any(|(text, _)| text.starts_with(&format!("{word}("))), "{label}: {word} is missing");
        }
    });
}

// Central differences of step 1e-5: truncation of third derivatives (of order 1e2 for angles seen from 0.1 m) 1e-8,
// round-off 1e-11; both times the size of the gauge's own rate.
const STEP: f64 = 1e-5;
const DIFFERENCE: f64 = 1e-6;

/// The loads of a unit force along a gauge are its derivative: along any motion of the bodies, tree or no tree.
#[test]
fn the_loads_of_a_gauge_are_its_gradient() {
    every_zoo(|bench, workspace, list, label, rng| {
        let m = &bench.compiled.mechanism;
        let at = workspace.at();
        let mut random = || Twist { v: vec2(rng.about(1.0), rng.about(1.0)), w: rng.about(1.0) };
        let mut moves: Vec<Twist> = m.bodies.iter().map(|_| random()).collect();
        for (i, body) in m.bodies.iter().enumerate() {
            let keep = if body.particle || i == 0 { 0.0 } else { 1.0 };
            moves[i] = Twist { v: if i == 0 { Vec2::zero() } else { moves[i].v }, w: moves[i].w * keep };
        }
        for (text, law) in
            list.iter().filter(|(_, law)| !law.variables().any(|l| matches!(l, ModelVariable::Coordinate(..))))
        {
            let moved = |by: f64| {
                let mut k: Kinematics = at.k.clone();
                for (pose, v) in k.pose.iter_mut().zip(&moves) {
                    *pose = Pose { at: pose.at + v.v * by, turn: Turn::by(pose.turn.angle + v.w * by) };
                }
                read(StateView { k: &k, ..at }, law)
            };
            let difference = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
            let power: f64 = m.bodies_of(law).into_iter().map(|b| gradient(at, law, b).power(moves[b])).sum();
            assert!(
                (power - difference).abs() < DIFFERENCE * (1.0 + power.abs()),
                "{label}: {text}: {power} {difference}"
            );
        }
    });
}

/// A gauge's rate is the power of a unit force along it, and the difference along the motion of the tree.
#[test]
fn the_rate_of_a_gauge_is_the_power_along_it() {
    every_zoo(|bench, workspace, list, label, _| {
        let m = &bench.compiled.mechanism;
        let (q, u) = (workspace.at().q.to_vec(), workspace.at().u.to_vec());
        for (text, law) in list {
            workspace.move_to(0.3, &q, &u);
            let at = workspace.at();
            let rate = jet(&MotionView { at, bodies: None, accelerations: None }, law).d1;
            let powers: Vec<f64> =
                m.bodies_of(law).into_iter().map(|b| gradient(at, law, b).power(at.k.twist[b])).collect();
            let size = powers.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
            assert!((rate - powers.iter().sum::<f64>()).abs() < 1e-12 * size, "{label}: {text}: {rate} {powers:?}");
            let mut moved = |by: f64| {
                let q: Vec<f64> = q.iter().zip(&u).map(|(q, u)| q + u * by).collect();
                workspace.move_to(0.3, &q, &u);
                read(workspace.at(), law)
            };
            let difference = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
            assert!(
                (rate - difference).abs() < DIFFERENCE * (1.0 + rate.abs()),
                "{label}: {text}: {rate} {difference}"
            );
        }
    });
}

/// Rates and accelerations of gauges, against the gauges along a simulated motion.
#[test]
fn rates_and_accelerations_are_those_of_the_motion() {
    for seed in 0..3 {
        let thrown = zoo(seed);
        let mut bench = Bench::new(&thrown);
        let list = gauges(&thrown.model.0, &mut bench.compiled);
        let mut laws = vec![];
        for (text, law) in &list {
            let rate = bench.compiled.observable(&format!("rate({text})")).expect("a rate");
            let accel = bench.compiled.observable(&format!("accel({text})")).expect("an acceleration");
            laws.push([law.clone(), rate, accel]);
        }
        let m = &bench.compiled.mechanism;
        let u = Rng::new(seed).vector(bench.q.len(), 0.5);
        let options = freebody::motion::Options { rtol: 1e-13, ..Default::default() };
        let settings = Settings {
            method: "dop853".into(),
            options,
            route: None,
            impacts: freebody::hybrid::Rule::Stop,
            jam_by_impact: false,
        };
        let start = Start { p: &bench.p, t: 0.0, q: &bench.q, u: &u, mode: None };
        let run = simulate(m, &start, 0.1, &settings, &mut |_| true).expect("starts");
        assert!(run.outcome.is_ok(), "seed {seed}: {}", run.outcome);
        // Central differences of step h and 2h, combined (Richardson): h⁴/30 of fifth derivatives.
        let (t, h) = (0.05, 2e-3);
        let times = [t - 2.0 * h, t - h, t, t + h, t + 2.0 * h];
        let flat: Vec<&ModelExpr> = laws.iter().flatten().collect();
        let rows = run.evaluate(m, &flat, &times).expect("inside the run");
        for (i, (text, _)) in list.iter().enumerate() {
            let at = |row: usize, order: usize| rows[row][3 * i + order];
            for order in 0..2 {
                let narrow = (at(3, order) - at(1, order)) / (2.0 * h);
                let wide = (at(4, order) - at(0, order)) / (4.0 * h);
                let difference = (4.0 * narrow - wide) / 3.0;
                let label = at(2, order + 1);
                let size = label.abs().max(1.0);
                // The two differences tell how far the motion is from a parabola.
                let close = 1e-8 * size + 0.1 * (narrow - wide).abs();
                assert!((label - difference).abs() < close, "seed {seed}: {text}, order {order}: {label} {difference}");
            }
        }
    }
}

/// For every force of the list: power is value times rate; and its load is minus the gradient of its potential.
#[test]
fn forces_do_the_work_that_their_potential_loses() {
    let mut conservative = 0;
    for (seed, kind) in (0..20).flat_map(|s| forces::ALL.iter().map(move |f| (s, *f))) {
        let mut rng = Rng::new(seed);
        let mut thrown = zoo(seed % 3);
        thrown.model = std::mem::take(&mut thrown.model).parameter("scale", 1.0);
        let pair = [format!("b{}", 1 + rng.below(5)), format!("b{}", 6 + rng.below(3))];
        let force = force_for("force", kind, &pair, 0.0, &mut thrown, &mut rng);
        thrown.model.0.forces.push(force);
        let bench = Bench::new(&thrown);
        let m = &bench.compiled.mechanism;
        let label = format!("{} at seed {seed}", kind.card().word);
        let mut workspace = bench.balance();
        let loads = |at: StateView<'_>| {
            let mut on = vec![Wrench::zero(); m.bodies.len()];
            add_force(at, &m.forces[0], &mut on);
            on
        };
        let u = rng.vector(bench.q.len(), 1.5);
        workspace.move_to(0.3, &bench.q, &u);
        let at = workspace.at();
        let on = loads(at);
        let power: f64 = on.iter().zip(&at.k.twist).map(|(w, v)| w.power(*v)).sum();
        if !power.is_finite() {
            // What lies still on a table has no friction of sliding.
            assert!(kind.card().word.ends_with("_friction"), "{label}");
            continue;
        }
        let size = on.iter().zip(&at.k.twist).fold(1e-3, |m: f64, (w, v)| m.max(w.power(*v).abs()));
        assert!((power - force_power(at, 0)).abs() < 1e-12 * size, "{label}");
        let Some(potential) = &m.forces[0].potential else { continue };
        conservative += 1;
        // At rest: a damper beside a spring does nothing.
        workspace.move_to(0.3, &bench.q, &vec![0.0; u.len()]);
        let at = workspace.at();
        let most = loads(at).iter().fold(1e-300, |m: f64, w| m.max(w.f.norm()).max(w.m.abs()));
        for (b, load) in loads(at).into_iter().enumerate().skip(1) {
            let left = (load + gradient(at, potential, b)).parts();
            assert!(left.iter().all(|x| x.abs() < 1e-12 * most), "{label}: {left:?} of {most} on {}", m.bodies[b].name);
        }
    }
    assert!(conservative >= 60);
}

/// A body that flies through the pole of its polar coordinates: beyond it the distance is below 0, and a force along
/// the distance, its rate and its acceleration still say the same.
#[test]
fn a_distance_below_0_is_a_gauge_like_any_other() {
    let model = Model::new()
        .gravity(0.4, -9.81)
        .body("plate", 2.0, 0.3, [0.2, -0.1])
        .point("ground.O", [0.1, 0.3])
        .point("plate.P", [0.4, 0.2])
        .joint("flight", "polar", &[("of", points(&["ground.O", "plate.P"]))], &["r", "phi", "turn"])
        .force("pull", "law", &[("along", text("r")), ("value", text("3.0"))]);
    let mut compiled = model.compile();
    let law = compiled.observable("r").expect("a coordinate");
    let m = &compiled.mechanism;
    let mut workspace = Workspace::new(m, &[]);
    // The same state seen from either side of the pole.
    let mut solved = |r: f64, phi: f64, rate: f64| {
        workspace.move_to(0.0, &[r, phi, 0.7], &[rate, 0.5, -0.8]);
        let going = MotionView { at: workspace.at(), bodies: None, accelerations: None };
        let read = jet(&going, &law);
        assert!((read.d0 - r).abs() < 1e-15 && (read.d1 - rate).abs() < 1e-14, "{read:?}");
        workspace.instant(freebody::dynamics::Route::Minimal).expect("it flies freely")
    };
    let (later, behind) = (solved(0.6, 0.2, 1.1), solved(-0.6, 0.2 + std::f64::consts::PI, -1.1));
    // What drives it away from the pole in the one telling draws it there in the other.
    for (a, sense) in [(&later, 1.0), (&behind, -1.0)] {
        let free = [a.bodies[0][0] - 0.4, a.bodies[0][1] + 9.81];
        let (sin, cos) = 0.2_f64.sin_cos();
        let off = (2.0 * free[0] - sense * 3.0 * cos).hypot(2.0 * free[1] - sense * 3.0 * sin);
        assert!(off < 1e-13, "{off:e}");
    }
}
