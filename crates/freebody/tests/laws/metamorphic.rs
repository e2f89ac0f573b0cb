//! What must happen to the answers when the whole world is moved, boosted or made heavier.

use crate::model::*;
use crate::random::*;
use crate::random_mechanisms::{loads, motion, recipe, HOME, MECHANISMS};
use crate::rng::Rng;
use freebody::dynamics::{Instant, Route};
use freebody::joints::{Joint, Kind};
use freebody::spec::{Element, Number, Place, Spec, Value};

/// Two solutions whose numbers all differ by round-off, through masses that differ by 1e4.
const AGREE: f64 = 1e-9;

/// What two solutions may be apart: `AGREE`, or ten times what a change of the state in its last digits makes of the accelerations.
fn tolerance(seed: u64, s: &State) -> f64 {
    let home = solved(seed, HOME, &[], s);
    let nudged = |sign: f64| {
        let q = s.q.iter().enumerate().map(|(i, x)| x * (1.0 + sign * [2e-16, -2e-16][i % 2])).collect();
        solved(seed, HOME, &[], &State { q, ..s.clone() })
    };
    let felt = [1.0, -1.0].map(|sign| apart(&motion_of(&home), &motion_of(&nudged(sign)), 1.0));
    AGREE.max(10.0 * felt[0].max(felt[1]))
}

/// Without actuators, which read the place of things in the world; and without particles in loops, from which a body
/// may come to hang: an angle measured from a particle is measured from the world.
fn ideal(seed: u64) -> Recipe {
    let recipe = recipe(seed);
    let particles = if recipe.loops > 0 { 0 } else { recipe.particles };
    Recipe { motions: 0, odd: false, particles, ..recipe }
}

/// A state of the mechanism at home.
fn state(seed: u64) -> (Bench, State) {
    let bench = Bench::new(&ideal(seed).draw(seed, HOME));
    let mut workspace = bench.balance();
    let found =
        bench.state(&mut workspace, &mut Rng::new(seed), 0.2).unwrap_or_else(|| panic!("seed {seed}: no state"));
    (bench, found)
}

/// The instant with `base` set on another footing: the coordinates of `base` come first and are `own`.
fn solved(seed: u64, base: Base, own: &[[f64; 2]], s: &State) -> Instant {
    let bench = Bench::new(&ideal(seed).draw(seed, base));
    let join = |at: usize, rest: &[f64]| own.iter().map(|x| x[at]).chain(rest.iter().copied()).collect::<Vec<_>>();
    let mut workspace = bench.balance();
    workspace.move_to(s.t, &join(0, &s.q), &join(1, &s.u));
    workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}, {base:?}: {e:?}"))
}

/// Forces and accelerations expressed in axes turned by `angle`.
fn turned_back(now: &Instant, angle: f64) -> (Vec<f64>, Vec<f64>) {
    let back = |x: f64, y: f64| turned(freebody::plane::vec2(x, y), -angle);
    let bodies = now.bodies.iter().flat_map(|b| [back(b[0], b[1]).x, back(b[0], b[1]).y, b[2]]);
    let joints = now.joints.iter().flat_map(|l| [back(l.force.x, l.force.y).x, back(l.force.x, l.force.y).y, l.couple]);
    (bodies.collect(), joints.collect())
}

#[test]
fn the_place_and_direction_of_the_world_do_not_matter() {
    for seed in 0..MECHANISMS {
        let (_, s) = state(seed);
        let home = solved(seed, HOME, &[], &s);
        // Reactions that are not determinate are the least of their kind, and that depends on the axes.
        if !home.self_stress.is_empty() {
            continue;
        }
        let agree = tolerance(seed, &s);
        for (place, close) in [([0.0, 0.0, 2.0], agree), ([3.0, -40.0, 0.0], 10.0 * agree), ([-5.0, 2.0, -1.0], agree)]
        {
            let away = solved(seed, Base::At(place), &[], &s);
            let ((a, f), (b, g)) = (turned_back(&home, 0.0), turned_back(&away, place[2]));
            let (a, f) = (apart(&a, &b, 1.0), apart(&f, &g, 1e-300));
            assert!(a < close && f < close, "seed {seed} at {place:?}: accelerations {a:e}, reactions {f:e}");
        }
    }
}

/// Galileo: a base in uniform motion is as good as one at rest. And Einstein: an accelerated base is a tilted gravity.
#[test]
fn a_moving_base_cannot_be_felt() {
    for seed in 0..MECHANISMS {
        let (bench, s) = state(seed);
        let agree = tolerance(seed, &s);
        // Forces that read absolute rates, and joints to ground, would feel the motion; all here are between bodies.
        let home = solved(seed, HOME, &[], &s);
        let boosted = solved(seed, Base::Sliding(0.0), &[[0.7, 5.0]], &s);
        let label = bench.label();
        let joints = 3..3 * bench.compiled.mechanism.joints.len();
        let known = |now: &Instant| loads(now)[joints.clone()].to_vec();
        let (a, f) = (apart(&motion_of(&home), &motion_of(&boosted), 1.0), apart(&known(&home), &known(&boosted), 1.0));
        assert!(a < agree && f < agree, "seed {seed}: accelerations {a:e}, reactions {f:e}; {label}");

        let push = 3.0;
        let pushed = solved(seed, Base::Sliding(push), &[[0.7, 5.0]], &s);
        let mut falling = ideal(seed).draw(seed, HOME);
        let [gx, _] = falling.model.0.gravity.as_mut().expect("gravity is drawn");
        let freebody::spec::Number::Literal(x) = gx else { panic!("gravity is drawn as a number") };
        *gx = literal(*x - push);
        let falling = Bench::new(&falling);
        let mut workspace = falling.balance();
        workspace.move_to(s.t, &s.q, &s.u);
        let tilted = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
        let relative: Vec<f64> = motion_of(&pushed).chunks(3).flat_map(|b| [b[0] - push, b[1], b[2]]).collect();
        let (a, f) = (apart(&motion_of(&tilted), &relative, 1.0), apart(&known(&tilted), &known(&pushed), 1.0));
        assert!(a < agree && f < agree, "seed {seed}, accelerated: accelerations {a:e}, reactions {f:e}; {label}");
    }
}

fn motion_of(now: &Instant) -> Vec<f64> {
    now.bodies.iter().flatten().copied().collect()
}

/// All masses and all forces twice (or a quarter) as large: the same motion to the last bit, reactions in proportion.
#[test]
fn a_power_of_two_in_the_masses_changes_no_bit_of_the_motion() {
    for seed in 0..MECHANISMS {
        let (bench, s) = state(seed);
        let scale = bench.compiled.names.parameters["scale"];
        let solved = |factor: f64| {
            let (mut workspace, mut p) = (bench.balance(), bench.p.clone());
            p[scale] = factor;
            workspace.rebind(&p);
            workspace.move_to(s.t, &s.q, &s.u);
            workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"))
        };
        let one = solved(1.0);
        for factor in [2.0, 0.25] {
            let other = solved(factor);
            assert_eq!(motion(&one), motion(&other), "seed {seed}, factor {factor}; {}", bench.label());
            let label: Vec<f64> = loads(&one).iter().map(|x| x * factor).collect();
            assert_eq!(label, loads(&other), "seed {seed}, factor {factor}; {}", bench.label());
        }
    }
}

/// The same world seen in a mirror, y → −y. In body frames as in the fixed axes y changes sign, and angles with it;
/// lines and curves that have something on their left run the other way.
fn mirrored(mut spec: Spec) -> Spec {
    let minus = |x: &mut Number| {
        *x = match x {
            Number::Literal(x) => Number::Literal(-*x),
            Number::Expression(text) => Number::Expression(format!("-({text})")),
        }
    };
    spec.gravity.iter_mut().for_each(|[_, y]| minus(y));
    spec.points.iter_mut().for_each(|point| minus(&mut point.at[1]));
    spec.bodies.iter_mut().flat_map(|body| &mut body.pieces).for_each(|piece| minus(&mut piece.at[1]));
    for curve in &mut spec.curves {
        let back = |text: &str| text.replace("sin", "S").replace('s', "(-s)").replace('S', "sin");
        (curve.x, curve.y) = (back(&curve.x), format!("-({})", back(&curve.y)));
    }
    for Element { kind, fields, .. } in &mut spec.joints {
        for (word, field) in fields {
            match (word.as_str(), field) {
                ("on", Value::Line(Place { angle: Some(Number::Literal(angle)), .. })) => {
                    *angle = std::f64::consts::PI - *angle;
                }
                (_, Value::Line(Place { angle: Some(angle), .. })) => minus(angle),
                ("angle" | "flank" | "strand", Value::Number(number)) => minus(number),
                // A curve is gone along the other way, and keeps its side.
                ("right", Value::Flag(right)) if kind == "wound_string" => *right = !*right,
                _ => {}
            }
        }
    }
    for Element { kind, fields, .. } in &mut spec.forces {
        for (word, field) in fields {
            let Value::Number(number) = field else { continue };
            if let Number::Expression(text) = number {
                if let Some((a, rest)) = text.split_once(" - angle(") {
                    // What is measured from one body to the other is measured the other way.
                    let (head, a) = a.rsplit_once("angle(").expect("a difference of two angles");
                    let (b, tail) = rest.split_once(')').expect("of two bodies");
                    *text = format!("{head}angle({b}) - angle({a}{tail}");
                }
            }
            match (kind.as_str(), word.as_str()) {
                ("torque", "value") | (_, "direction" | "rest_angle" | "y") => minus(number),
                _ => {}
            }
        }
    }
    spec
}

#[test]
fn the_world_in_a_mirror_is_as_good() {
    let mut seen_there = 0;
    for seed in 0..3 * MECHANISMS {
        let thrown = ideal(seed).draw(seed, HOME);
        let bench = Bench::new(&thrown);
        let mut workspace = bench.balance();
        let label = bench.label();
        // The angle of a wheel is counted from the way of its line, which the mirror turns round.
        if bench.compiled.mechanism.joints.iter().any(|j| j.kind == Kind::Rolling && j.child.is_some()) {
            continue;
        }
        seen_there += 1;
        let s = bench.state(&mut workspace, &mut Rng::new(seed), 0.2).unwrap_or_else(|| panic!("no state: {label}"));
        workspace.move_to(s.t, &s.q, &s.u);
        let here = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}: {e:?}"));

        let there = Model(mirrored(thrown.model.0)).compile();
        let m = &there.mechanism;
        let (mut q, mut u) = (s.q, s.u);
        for (i, &(joint, k)) in m.coordinates.iter().enumerate() {
            let joint = &m.joints[joint];
            let name = joint.kind.card().coordinates[joint.coordinates[k].card].name;
            let other_way = name == "s" && joint.curve.is_some();
            if matches!(name, "angle" | "direction" | "y") || other_way {
                (q[i], u[i]) = (-q[i], -u[i]);
            }
        }
        let mut workspace = with_locks(m, &bench.p);
        workspace.move_to(s.t, &q, &u);
        let there = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}, mirrored: {e:?}"));
        // What holds a turn acts the other way round in the mirror, what holds a distance the same way.
        let bodies = 3 * m.joints.len();
        let sized = |x: Vec<f64>| [&x[..bodies], &x[bodies..].iter().map(|f| f.abs()).collect::<Vec<_>>()].concat();
        let seen = |x: Vec<f64>| {
            let (vectors, sizes) = x.split_at(x.len().min(bodies));
            vectors.chunks(3).flat_map(|b| [b[0], -b[1], -b[2]]).chain(sizes.iter().copied()).collect::<Vec<_>>()
        };
        let (a, f) = (
            apart(&motion_of(&here), &seen(motion_of(&there)), 1.0),
            apart(&sized(loads(&here)), &seen(sized(loads(&there))), 1e-300),
        );
        assert!(a < AGREE && f < AGREE, "seed {seed}: accelerations {a:e}, reactions {f:e}; {label}");
        assert_eq!(here.determinate, there.determinate, "{label}");
    }
    assert!(seen_there > MECHANISMS, "only {seen_there} mechanisms have a mirror image");
}
