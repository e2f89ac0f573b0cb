//! Mechanisms whose motion or loads are known in closed form.

use crate::model::*;
use crate::rng::Rng;
use freebody::compile::Compiled;
use freebody::dynamics::{Instant, Route, Workspace};
use freebody::hybrid::{simulate, MotionState, Settings, Start, Trajectory};
use freebody::mode::Mode;
use freebody::motion::{Options, METHODS};

const G: f64 = 9.81;

/// Complete elliptic integral of the first kind at modulus 1/√2: Γ(1/4)²/(4√π) (Abramowitz & Stegun 17.3.9, 17.3.30).
const K_HALF: f64 = 1.854_074_677_301_372;

fn instant(compiled: &Compiled, q: &[f64], u: &[f64]) -> Instant {
    let mut workspace = Workspace::new(&compiled.mechanism, &[]);
    workspace.move_to(0.0, q, u);
    workspace.instant(Route::Minimal).expect("a mechanism that moves")
}

fn run(compiled: &Compiled, q: &[f64], u: &[f64], until: f64, method: &str, options: Options) -> Trajectory {
    let settings = Settings {
        method: method.into(),
        options,
        route: None,
        impacts: freebody::hybrid::Rule::Stop,
        jam_by_impact: false,
    };
    let run =
        simulate(&compiled.mechanism, &Start { p: &[], t: 0.0, q, u, mode: None }, until, &settings, &mut |_| true);
    let run = run.expect("starts");
    assert!(run.outcome.is_ok(), "{method}: {}", run.outcome);
    run
}

fn near(label: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{label}: {found}, not {expected}");
}

/// A point mass on a massless rod of length 1, measured from the downward vertical.
fn pendulum() -> Compiled {
    let down = freebody::spec::Coordinate { zero: literal(-std::f64::consts::FRAC_PI_2), ..coordinate("theta") };
    let mut model = Model::new().gravity(0.0, -G).body("rod", 1.0, 0.0, [1.0, 0.0]).point("rod.A", [0.0, 0.0]);
    model = model.joint("pivot", "hinge", &[("of", points(&["ground.O", "rod.A"]))], &[]);
    model.0.joints[0].coordinates = vec![down];
    model.compile()
}

/// Released from the horizontal, a pendulum is back at rest after 4 K(sin 45°) √(l/g).
#[test]
fn every_integrator_brings_the_pendulum_back() {
    let compiled = pendulum();
    let period = 4.0 * K_HALF / G.sqrt();
    for method in METHODS {
        // Four hundred steps, or the tolerance; allowed is a phase error of some hundred times what one step may err.
        let fixed = method.estimate_order.is_none();
        let h = period / 400.0;
        let options = Options { rtol: 1e-11, first_step: fixed.then_some(h), ..Options::default() };
        let allowed = if fixed { 100.0 * (std::f64::consts::TAU / 400.0).powi(method.order as i32) } else { 1e-8 };
        let run = run(&compiled, &[std::f64::consts::FRAC_PI_2], &[0.0], period, method.name, options);
        let MotionState { q, u, .. } = run.end(&compiled.mechanism);
        near(method.name, q[0], std::f64::consts::FRAC_PI_2, allowed);
        near(method.name, u[0], 0.0, allowed * G);
    }
}

/// A disk that rolls down an incline: a = g sin β/(1 + 1/2), N = m g cos β, friction m g sin β/3.
#[test]
fn a_disk_rolls_down_an_incline() {
    let (m, r, beta) = (3.0, 0.4, 0.5_f64);
    let model = Model::new().gravity(0.0, -G).body("disk", m, 0.5 * m * r * r, [0.0, 0.0]).point("disk.C", [0.0, 0.0]);
    let fields = [("on", line("ground.O", -beta)), ("circle", circle("disk.C", r))];
    let compiled = model.joint("road", "rolling", &fields, &["s"]).compile();
    let now = instant(&compiled, &[0.7], &[2.0]);
    near("acceleration", now.accelerations[0], G * beta.sin() / 1.5, 1e-14);
    let along = now.joints[0].in_joint_axes();
    near("normal force", along.y, m * G * beta.cos(), 1e-13);
    near("friction", along.x, -m * G * beta.sin() / 3.0, 1e-13);
    near("couple at the contact", now.joints[0].couple, 0.0, 1e-13);
}

/// Two wheels on fixed axles, driven by a torque on the first.
fn wheels(kind: &str, fields: &[(&str, freebody::spec::Value)], distance: f64, torque: f64) -> Compiled {
    let mut model = Model::new().point("ground.B", [distance, 0.0]);
    for (name, inertia, axle) in [("one", 0.2, "ground.O"), ("two", 0.9, "ground.B")] {
        let centre = format!("{name}.C");
        model = model.body(name, 1.0, inertia, [0.0, 0.0]).point(&centre, [0.0, 0.0]);
        model = model.joint(name, "hinge", &[("of", points(&[axle, &centre]))], &[&format!("turn_{name}")]);
    }
    let fields: Vec<_> = fields.iter().cloned().chain([("of", points(&["one.C", "two.C"]))]).collect();
    model = model.joint("mesh", kind, &fields, &[]);
    model.force("motor", "torque", &[("on", text("one")), ("value", value(torque))]).compile()
}

/// Ratios of wheels, and the force between them: for gears it lies along the line of action, which stands at the
/// pressure angle to the common tangent and touches both base circles (Shigley, *Mechanical Engineering Design*, ch.
/// 13).
#[test]
fn gears_and_belts_keep_their_ratio() {
    let (r1, r2, phi, torque) = (0.3, 0.5, 0.35, 2.0);
    let radii = || ("radii", freebody::spec::Value::List(vec![value(r1), value(r2)]));
    let flag = freebody::spec::Value::Flag;
    // Kind, its fields, distance of the axles, sense of the second wheel's turn, lever of the force on the first wheel.
    let gear = [radii(), ("pressure_angle", value(phi))];
    let ring = [radii(), ("pressure_angle", value(phi)), ("internal", flag(true))];
    let (open, crossed) = ([radii()], [radii(), ("crossed", flag(true))]);
    let cases: [(&str, &[_], f64, f64, f64); 4] = [
        ("gear", &gear, r1 + r2, -1.0, r1 * f64::cos(phi)),
        ("gear", &ring, r2 - r1, 1.0, r1 * f64::cos(phi)),
        ("belt", &open, 2.0, 1.0, r1),
        ("belt", &crossed, 2.0, -1.0, r1),
    ];
    for (kind, fields, distance, sense, lever) in cases {
        let compiled = wheels(kind, fields, distance, torque);
        let now = instant(&compiled, &[0.4, -0.3], &[1.0, sense * r1 / r2]);
        let label = format!("{kind} {sense}");
        // Reduced to the first wheel: I₁ + (r₁/r₂)² I₂.
        let alpha = torque / (0.2 + (r1 / r2).powi(2) * 0.9);
        near(&label, now.accelerations[0], alpha, 1e-13);
        near(&label, now.accelerations[1], sense * r1 / r2 * alpha, 1e-13);
        let mesh = joint_named(&compiled.mechanism, "mesh");
        let force = now.joints[mesh].force;
        near(&label, force.norm(), (torque - 0.2 * alpha) / lever, 1e-12);
        if kind == "gear" {
            // On the second wheel: teeth push apart, whichever way the torque is.
            for torque in [torque, -torque] {
                let compiled = wheels(kind, fields, distance, torque);
                let force = instant(&compiled, &[0.4, -0.3], &[1.0, sense * r1 / r2]).joints[mesh].force;
                near(&label, force.x / force.norm(), -sense * phi.sin(), 1e-13);
            }
        }
    }
}

/// In balance and at rest nothing tells whether the axles keep their distance but round-off, and still no teeth pull: on
/// a frame that a motion holds, two wheels are loaded against each other.
#[test]
fn teeth_push_apart_at_rest_too() {
    let mut rng = Rng::new(7);
    for case in 0..40 {
        let (r1, r2, at, torque) = (rng.within(0.1, 0.5), rng.within(0.1, 0.5), rng.about(3.0), rng.about(5.0));
        let mut model = Model::new().gravity(0.0, -G).body("frame", 3.0, 0.7, [0.2, 0.1]).point("frame.O", [0.0, 0.0]);
        model = model.joint("hub", "hinge", &[("of", points(&["ground.O", "frame.O"]))], &["theta"]);
        for (wheel, place, load) in [("first", 0.37, torque), ("second", 0.37 + r1 + r2, torque * r2 / r1)] {
            let (axle, centre) = (format!("frame.{wheel}"), format!("{wheel}.C"));
            model = model.body(wheel, 1.3, 0.2, [0.0, 0.0]).point(&axle, [place, 0.0]).point(&centre, [0.0, 0.0]);
            model = model.joint(&format!("axle {wheel}"), "hinge", &[("of", points(&[&axle, &centre]))], &[wheel]);
            model =
                model.force(wheel, "torque", &[("on", text(wheel)), ("from", text("frame")), ("value", value(load))]);
        }
        let radii = freebody::spec::Value::List(vec![value(r1), value(r2)]);
        let fields = [("of", points(&["first.C", "second.C"])), ("radii", radii), ("pressure_angle", value(0.35))];
        let compiled =
            model.joint("mesh", "gear", &fields, &[]).motion("hold", "theta", &at.to_string(), "position", None);
        let compiled = compiled.compile();
        let now = instant(&compiled, &[at, 0.3, -0.3 * r1 / r2], &[0.0; 3]);
        let force = turned(now.joints[joint_named(&compiled.mechanism, "mesh")].force, -at);
        near(&format!("case {case}"), force.x / force.norm(), 0.35_f64.sin(), 1e-12);
    }
}

/// An arm carries a planet that rolls on (or in) a fixed wheel: it turns (1 ± R/r) as fast as the arm.
#[test]
fn an_epicyclic_planet_turns_by_the_ratio() {
    for (inside, ratio) in [(false, 1.0 + 0.5 / 0.2), (true, 1.0 - 0.5 / 0.2)] {
        let reach = if inside { 0.3 } else { 0.7 };
        let mut model =
            Model::new().body("arm", 1.0, 0.1, [0.2, 0.0]).point("arm.A", [0.0, 0.0]).point("arm.B", [reach, 0.0]);
        model = model.body("planet", 2.0, 0.04, [0.0, 0.0]).point("planet.C", [0.0, 0.0]);
        model = model.joint("hub", "hinge", &[("of", points(&["ground.O", "arm.A"]))], &["theta"]);
        model = model.joint("axle", "hinge", &[("of", points(&["arm.B", "planet.C"]))], &["phi"]);
        let fields = [
            ("on", circle("ground.O", 0.5)),
            ("circle", circle("planet.C", 0.2)),
            ("inside", freebody::spec::Value::Flag(inside)),
        ];
        model = model.joint("mesh", "rolling_circles", &fields, &[]);
        let compiled = model.force("motor", "torque", &[("on", text("arm")), ("value", value(1.0))]).compile();
        let now = instant(&compiled, &[0.3, 0.1], &[1.0, ratio - 1.0]);
        let arm = now.accelerations[0];
        near("planet", now.accelerations[1], (ratio - 1.0) * arm, 1e-13);
        // Reduced to the arm: its inertia about the hub, the planet's centre, the planet's turn.
        let inertia = 0.1 + 0.04 + 2.0 * reach * reach + 0.04 * ratio * ratio;
        near("arm", arm, 1.0 / inertia, 1e-13);
    }
}

/// Four-bar: ω₄/ω₂ = IA/ID, I where the coupler's line meets the line of the fixed pins (Kennedy's theorem; Uicker,
/// Pennock & Shigley, *Theory of Machines and Mechanisms*, §3.17). And the power put in at the crank comes out.
#[test]
fn a_four_bar_has_the_ratio_of_its_instant_centre() {
    let (a, b, c, d) = ([0.0, 0.0], [0.3, 0.4], [1.2, 0.9], [1.0, 0.0]);
    let bar = |p: [f64; 2], q: [f64; 2]| ((q[0] - p[0]).hypot(q[1] - p[1]), (q[1] - p[1]).atan2(q[0] - p[0]));
    let ends = [("crank", a, b), ("coupler", b, c), ("rocker", c, d)];
    let mut model = Model::new().point("ground.D", d);
    for (name, p, q) in ends {
        let length = bar(p, q).0;
        model = model.body(name, 1.0, 0.1, [0.5 * length, 0.0]).point(&format!("{name}.P"), [0.0, 0.0]);
        model = model.point(&format!("{name}.Q"), [length, 0.0]);
    }
    for (name, from, to, named) in [
        ("A", "ground.O", "crank.P", "theta2"),
        ("B", "crank.Q", "coupler.P", "theta3"),
        ("C", "coupler.Q", "rocker.P", "theta4"),
    ] {
        model = model.joint(name, "hinge", &[("of", points(&[from, to]))], &[named]);
        model.0.joints.last_mut().expect("just joined").coordinates[0].absolute = true;
    }
    model = model.joint("D", "hinge", &[("of", points(&["rocker.Q", "ground.D"]))], &[]);
    let compiled = model.compile();
    let q = ends.map(|(_, p, q)| bar(p, q).1);
    let mut workspace = Workspace::new(&compiled.mechanism, &[]);
    let mut u = vec![1.0, 0.0, 0.0];
    workspace.project_velocities(&Mode::free(workspace.m), 0.0, &q, &mut u).expect("closed");
    let centre = b[0] - b[1] * (c[0] - b[0]) / (c[1] - b[1]);
    near("ratio", u[2] / u[0], (centre - a[0]) / (centre - d[0]), 1e-13);
}

/// A bead on y = x²/2: (1 + x²) ẍ + x ẋ² + g x = 0 (Lagrange), and N = m (ẍ, ÿ + g) with ÿ = ẋ² + x ẍ.
#[test]
fn a_bead_on_a_parabola() {
    let m = 0.7;
    let model = Model::new().gravity(0.0, -G).particle("bead", m).curve("ground.wire", "s", "s^2/2");
    let fields = [("along", text("ground.wire")), ("point", text("bead.origin"))];
    let compiled = model.joint("wire", "curved_slot", &fields, &["x"]).compile();
    let mut rng = Rng::new(3);
    for _ in 0..20 {
        let (x, v) = (rng.about(2.0), rng.about(3.0));
        let now = instant(&compiled, &[x], &[v]);
        let a = -(x * v * v + G * x) / (1.0 + x * x);
        near("acceleration", now.accelerations[0], a, 1e-13);
        let force = now.joints[0].force;
        near("normal force, x", force.x, m * a, 1e-13);
        near("normal force, y", force.y, m * (v * v + x * a + G), 1e-12);
        let force = now.joints[0].in_joint_axes();
        near("along the wire", force.x, 0.0, 1e-12);
        near("to its left", force.y, m * (v * v + G) / (1.0 + x * x).sqrt(), 1e-12);
    }
    let run = run(&compiled, &[1.5], &[0.0], 20.0, "dop853", Options { rtol: 1e-12, ..Options::default() });
    let ledger = run.ledger(&compiled.mechanism, &[5.0, 10.0, 20.0]).expect("inside the run");
    for row in &ledger.rows {
        near("energy", row[row.len() - 1], 0.0, 1e-10);
    }
}

/// Over some 800 swings a symplectic method keeps the energy of a conservative motion within a band that does not
/// widen.
#[test]
fn a_symplectic_method_does_not_drift() {
    let mut model = Model::new().gravity(0.0, -G);
    for (name, before) in [("upper", "ground.O"), ("lower", "upper.B")] {
        let (pin, end) = (format!("{name}.A"), format!("{name}.B"));
        model = model.body(name, 1.0, 1.0 / 12.0, [0.5, 0.0]).point(&pin, [0.0, 0.0]).point(&end, [1.0, 0.0]);
        model = model.joint(name, "hinge", &[("of", points(&[before, &pin]))], &[&format!("theta_{name}")]);
    }
    let compiled = model.compile();
    let (m, down) = (&compiled.mechanism, -std::f64::consts::FRAC_PI_2);
    let (q, u, until) = ([down + 0.2, -0.1], [0.0, 0.0], 600.0);
    for method in METHODS.iter().filter(|m| m.symplectic) {
        let options = Options { first_step: Some(0.05), ..Options::default() };
        let run = run(&compiled, &q, &u, until, method.name, options);
        let band = |from: f64| {
            let times: Vec<f64> = (0..300).map(|i| from + 0.7 * f64::from(i)).collect();
            let ledger = run.ledger(m, &times).expect("inside the run");
            ledger.rows.iter().map(|row| row[row.len() - 1].abs()).fold(0.0, f64::max)
        };
        let (early, late) = (band(0.0), band(until - 211.0));
        assert!(early > 0.0 && late < 2.0 * early + 1e-11, "{}: {early:e} J early, {late:e} J late", method.name);
        assert!(late < 1e-6, "{}: {late:e} J", method.name);
    }
    assert!(METHODS.iter().any(|m| m.symplectic));
}
