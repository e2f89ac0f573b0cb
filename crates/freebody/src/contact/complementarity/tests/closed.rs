//! Problems with answers on paper.

use super::*;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

const UP: f64 = FRAC_PI_2;

fn resting(mu: f64) -> FrictionLaw {
    FrictionLaw::Resting { fixed: mu, kinetic: mu }
}

/// (ẍ, ÿ, angular acceleration) of a uniform box of unit mass, half-width b and half-height h, that rests on
/// two corners and is pulled to the right with the force `pull` < 2 g b/h at its centre. By cases: moment of
/// momentum about the centre or the right corner.
fn box_on_floor(b: f64, h: f64, mu: f64, pull: f64, gravity: f64) -> [f64; 3] {
    let inertia = (b * b + h * h) / 3.0;
    let roll = (pull * h - gravity * b) / (4.0 * inertia);
    let (normal, tangent) = (gravity + roll * b, roll * h - pull);
    let dragged = gravity / (1.0 - b * (mu * h - b) / inertia);
    match (roll > 0.0, mu * h > b) {
        (false, _) if pull <= mu * gravity => [0.0; 3],
        (true, _) if -tangent <= mu * normal => [roll * h, roll * b, -roll],
        (_, false) => [pull - mu * gravity, 0.0, 0.0],
        (_, true) => {
            let roll = dragged * (mu * h - b) / inertia;
            [pull - mu * dragged, roll * b, -roll]
        }
    }
}

#[test]
fn box_sticks_slides_tips() {
    let (mut r, gravity, mut seen) = (Random(11), 9.81, [0; 4]);
    for _ in 0..5_000 {
        let mut size = || 1.01 + r.unit(false);
        let (b, h, mu, pull) = (size(), size(), size(), size() * gravity);
        let expected = box_on_floor(b, h, mu, pull, gravity);
        seen[usize::from(expected[0] > 0.0) + 2 * usize::from(expected[2] < 0.0)] += 1;
        let w = rows(&[touch(-b, -h, UP), touch(b, -h, UP)]);
        let g = delassus(&w, &[1.0, 1.0, 3.0 / (b * b + h * h)]);
        let free = w.mul_vec(&[pull, -gravity, 0.0]);
        let a = solved(&Problem { g: &g, free: &free, friction: &[resting(mu); 2] });
        assert!(agree(&a.acceleration, &w.mul_vec(&expected), 1e-12), "{b} {h} {mu} {pull} {a:?} {expected:?}");
    }
    assert!(seen[0] > 100 && seen[1] > 100 && seen[3] > 100, "{seen:?}");
}

/// A block on an incline of angle α holds up to tan α = μ and not beyond, on one contact and on four.
#[test]
fn block_on_incline() {
    for n in 1..1_000 {
        let alpha = n as f64 / 1_000.0 * 1.5;
        for contacts in [1, 4] {
            let corners: Vec<_> = (0..contacts).map(|i| touch(4.0 * i as f64 / 3.0 - 2.0, -0.01, UP)).collect();
            let w = if contacts == 1 { rows(&[touch(0.0, 0.0, UP)]) } else { rows(&corners) };
            let g = delassus(&w, &[1.0, 1.0, 3.0]);
            let free = w.mul_vec(&[9.81 * alpha.sin(), -9.81 * alpha.cos(), 0.0]);
            // Friction falls short of the pull down the plane by this part of the weight.
            let slides = |short: f64| {
                let friction = vec![resting((alpha.sin() - short) / alpha.cos()); contacts];
                solved(&Problem { g: &g, free: &free, friction: &friction }).acceleration[contacts] > 1e-12
            };
            assert!(!slides(0.0) && !slides(-1e-12) && slides(1e-12), "{alpha} {contacts}");
        }
    }
}

/// Redundant contacts carry a load by independent forces, none with all of its friction used up, as it needs not be; the rest carry
/// nothing.
#[test]
fn redundant_touches_are_basic() {
    for k in 2..10 {
        for friction_law in [FrictionLaw::Frictionless, FrictionLaw::Rough, resting(0.4)] {
            let feet: Vec<_> = (0..k).map(|i| touch(i as f64 - 0.4 * k as f64, -1.0, UP)).collect();
            let w = rows(&feet);
            let g = delassus(&w, &[1.0, 1.0, 0.7]);
            let pull = if friction_law == FrictionLaw::Frictionless { 0.0 } else { 1.0 };
            let free = w.mul_vec(&[pull, -9.81, 0.1]);
            let a = solved(&Problem { g: &g, free: &free, friction: &vec![friction_law; k] });
            let count = |i: usize| usize::from(a.normal[i] != 0.0) + usize::from(a.tangent[i] != 0.0);
            assert!((0..k).map(count).sum::<usize>() <= 3, "{a:?}");
            let is_used_up = |i: usize| a.normal[i] > 0.0 && a.tangent[i].abs() > 0.39 * a.normal[i];
            assert!(friction_law != resting(0.4) || !(0..k).any(is_used_up), "{a:?}");
            assert!(a.acceleration.iter().all(|a| a.abs() <= 1e-14), "{a:?}");
            assert!((a.normal.iter().sum::<f64>() - 9.81).abs() < 1e-12);
        }
    }
}

/// Friction of a box that two feet share without being determined is brought from the edge of a cone inside both.
#[test]
fn shared_friction_is_brought_inside_its_cones() {
    let w = rows(&[touch(-1.0, -1.0, UP), touch(1.0, -1.0, UP)]);
    let (g, free) = (delassus(&w, &[1.0, 1.0, 0.7]), w.mul_vec(&[1.0, -9.81, 0.1]));
    let problem = Problem { g: &g, free: &free, friction: &[resting(0.4); 2] };
    let mut edge = solved(&problem);
    let all: f64 = edge.tangent.iter().sum();
    let used_up = 0.4 * edge.normal[1] * all.signum();
    edge.tangent = vec![all - used_up, used_up];
    verify(&problem, &edge, 1e-12).expect("an answer, too");
    let found = inside(&problem, edge);
    verify(&problem, &found, 1e-12).expect("an answer");
    assert!((0..2).all(|i| found.tangent[i].abs() < 0.3 * found.normal[i]), "{found:?}");
}

/// A stack of boxes of mass 1, each on two contacts: each pair carries the weight above it; if the
/// lowest is pulled hard enough, it slides out, and drags the next with friction.
#[test]
fn stacks() {
    let (mu, gravity) = (0.3, 9.81);
    for boxes in 1..8 {
        let k = 2 * boxes;
        let mut w = Matrix::zeros(2 * k, 3 * boxes);
        for i in 0..k {
            let (upper, x) = (i / 2, if i % 2 == 0 { -1.0 } else { 1.0 });
            for t in 0..2 {
                w.row_mut(t * k + i)[3 * upper..3 * upper + 3].copy_from_slice(&touch(x, -0.1, UP)[t]);
                if upper > 0 {
                    let below = touch(x, 0.1, UP)[t].map(|v| -v);
                    w.row_mut(t * k + i)[3 * upper - 3..3 * upper].copy_from_slice(&below);
                }
            }
        }
        let inverse: Vec<f64> = (0..3 * boxes).map(|i| if i % 3 == 2 { 3.0 / 1.01 } else { 1.0 }).collect();
        let g = delassus(&w, &inverse);
        let mut pull: Vec<f64> = (0..3 * boxes).map(|i| if i % 3 == 1 { -gravity } else { 0.0 }).collect();
        let a = solved(&Problem { g: &g, free: &w.mul_vec(&pull), friction: &vec![resting(mu); k] });
        assert!(a.acceleration.iter().all(|a| *a == 0.0));
        for j in 0..boxes {
            assert!((a.normal[2 * j] + a.normal[2 * j + 1] - (boxes - j) as f64 * gravity).abs() < 1e-12);
        }
        if boxes > 1 {
            pull[0] = 5.0 * boxes as f64 * gravity;
            let n = boxes as f64;
            let a = solved(&Problem { g: &g, free: &w.mul_vec(&pull), friction: &vec![resting(mu); k] });
            let (lowest, next) = (pull[0] - mu * gravity * (2.0 * n - 1.0), mu * gravity);
            assert!((a.acceleration[k] - lowest).abs() < 1e-11 * lowest, "{a:?}");
            assert!((a.acceleration[k + 2] - (next - lowest)).abs() < 1e-11 * lowest);
        }
    }
}

/// A block between two walls may fall between them or be clamped by them.
#[test]
fn clamped_between_walls() {
    let w = rows(&[touch(-1.0, 0.0, 0.0), touch(1.0, 0.0, 2.0 * FRAC_PI_2)]);
    let g = delassus(&w, &[1.0, 1.0, 1.0]);
    let free = w.mul_vec(&[0.0, -9.81, 0.0]);
    let Verdict::Indeterminate(all) = verified(&Problem { g: &g, free: &free, friction: &[resting(0.5); 2] }, 1e-12)
    else {
        panic!()
    };
    assert_eq!(all.len(), 2);
    assert!(all.iter().any(|a| a.acceleration.iter().all(|a| *a == 0.0)));
    let smooth = solved(&Problem { g: &g, free: &free, friction: &[FrictionLaw::Frictionless; 2] });
    assert!(agree(&smooth.acceleration, &free, 1e-15));
}

/// Opposed contacts that a prescribed motion would drive through each other cannot be.
#[test]
fn squeezed() {
    let w = rows(&[touch(-1.0, 0.0, 0.0), touch(1.0, 0.0, 2.0 * FRAC_PI_2)]);
    let g = delassus(&w, &[1.0, 1.0, 1.0]);
    for friction_law in [FrictionLaw::Frictionless, FrictionLaw::Rough, resting(0.5)] {
        assert_eq!(
            solve(&Problem { g: &g, free: &[-1.0, 0.5, 0.0, 0.0], friction: &[friction_law; 2] }),
            Verdict::Inconsistent
        );
    }
    let nothing_moves = Matrix::zeros(2, 2);
    let friction = &[resting(0.5)];
    assert_eq!(solve(&Problem { g: &nothing_moves, free: &[-1.0, 0.0], friction }), Verdict::Inconsistent);
    assert!(matches!(solve(&Problem { g: &nothing_moves, free: &[0.0, 1.0], friction }), Verdict::Solved(_)));
}

/// A uniform rod of half-length l slides at the angle θ to the ground: A m = 1 + 3 cos θ (cos θ − μ sin θ) and
/// b = l θ̇² sin θ − g decide between contact, lift-off, both, and neither.
#[test]
fn painleve_rod() {
    let (l, mass, gravity, mut seen) = (0.7, 1.3, 9.81, [0; 4]);
    for i in 0..200 {
        for j in 0..200 {
            let (theta, mu) = ((i as f64 + 0.5) / 200.0 * FRAC_PI_2, 4.0 * (j as f64 + 0.5) / 200.0);
            let (sin, cos) = theta.sin_cos();
            let g = delassus(&rows(&[touch(l * cos, -l * sin, UP)]), &[1.0 / mass, 1.0 / mass, 3.0 / (mass * l * l)]);
            let (leading, b) = (1.0 + 3.0 * cos * (cos - mu * sin), 2.0 * gravity * sin - gravity);
            if leading.abs() < 1e-9 || b.abs() < 1e-9 * gravity {
                continue;
            }
            let free = [b, 0.3 * gravity];
            let p = painleve(&g, &free, 0, 1.0, mu);
            assert!((p.leading * mass - leading).abs() < 1e-13 * (1.0 + mu) && p.free == b);
            assert!((p.critical.unwrap() - (1.0 + 3.0 * cos * cos) / (3.0 * cos * sin)).abs() < 1e-10 * (1.0 / cos));
            let verdict = verified(
                &Problem { g: &g, free: &free, friction: &[FrictionLaw::Sliding { sense: 1.0, kinetic: mu }] },
                1e-12,
            );
            let class = match (leading > 0.0, b > 0.0, &verdict) {
                (true, false, Verdict::Solved(a)) if a.status == [Status::Slip(1.0)] => 0,
                (true, true, Verdict::Solved(a)) if a.status == [Status::Open] => 1,
                (false, true, Verdict::Indeterminate(all)) if all.len() == 2 => 2,
                (false, false, Verdict::Inconsistent) => 3,
                _ => panic!("θ {theta}, μ {mu}: A {leading}, b {b}: {verdict:?}"),
            };
            seen[class] += 1;
        }
    }
    assert!(seen.iter().all(|n| *n > 500), "{seen:?}");
}

/// A rod against a wall, with the same friction there and on the floor, holds if tan θ ≥ (1 − μ²)/(2 μ).
#[test]
fn ladder() {
    let mu: f64 = 0.5;
    let constraint = ((1.0 - mu * mu) / (2.0 * mu)).atan();
    for (theta, laws) in [(constraint + 1e-6, true), (constraint - 1e-6, false), (FRAC_PI_4, true)] {
        let (sin, cos) = theta.sin_cos();
        let w = rows(&[touch(-cos, -sin, UP), touch(cos, sin, 2.0 * FRAC_PI_2)]);
        let g = delassus(&w, &[1.0, 1.0, 3.0]);
        let problem = Problem { g: &g, free: &w.mul_vec(&[0.0, -9.81, 0.0]), friction: &[resting(mu); 2] };
        assert_eq!(solved(&problem).acceleration.iter().all(|a| *a == 0.0), laws, "{theta}");
    }
}

/// A heavy ball on a light one on the floor: solved down to a ratio of masses of 1e-9; beyond, the rank of G is in
/// doubt, and no conclusion is drawn from it.
#[test]
fn heavy_on_light() {
    for decades in 0..13 {
        let light = 10_f64.powi(-decades);
        let normal = [[1.0, 0.0], [-1.0, 1.0]];
        let w = Matrix::from_fn(4, 2, |i, j| if i < 2 { normal[i][j] } else { 0.0 });
        let g = delassus(&w, &[1.0 / light, 1.0]);
        let free = w.mul_vec(&[-9.81, -9.81]);
        for friction_law in [FrictionLaw::Frictionless, resting(0.3)] {
            match solve(&Problem { g: &g, free: &free, friction: &[friction_law; 2] }) {
                Verdict::Solved(a) => assert!(agree(&a.normal, &[9.81 * (1.0 + light), 9.81], 1e-15 / light), "{a:?}"),
                verdict => assert!(decades > 9 && verdict == Verdict::Unknown, "{verdict:?} {light}"),
            }
        }
    }
}
