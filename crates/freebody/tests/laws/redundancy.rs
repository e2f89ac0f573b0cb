//! Constraints that say nothing new: the motion does not feel them, and exactly the reactions that they make
//! indeterminate are labelled so.

use crate::model::*;
use crate::random::*;
use crate::random_mechanisms::{motion, recipe, HOME, MECHANISMS};
use crate::rng::Rng;
use freebody::dynamics::{Instant, Route, Workspace};
use freebody::joints::Kind;

/// A link from a hinge's pin to another point of one of its bodies: its length cannot change, and it can be stressed
/// against that hinge alone.
#[test]
fn a_planted_link_is_labelled_with_the_hinge_that_it_stresses() {
    let mut planted = 0;
    for seed in 0..MECHANISMS {
        let recipe = Recipe { motions: 0, ..recipe(seed) };
        let thrown = recipe.draw(seed, HOME);
        let plain = Bench::new(&thrown);
        let m = &plain.compiled.mechanism;
        // A hinge of a body without mass is left out: the small shift of redundant rows stands against no inertia there, and the
        // sparse factorisation keeps six digits of the accelerations (the plain one of the other routes keeps all).
        let masses = m.bind(&plain.p).mass;
        let rigid = |b: usize| !m.bodies[b].particle && (b == 0 || masses[b] > 0.0);
        let Some(hinge) = m.joints.iter().find(|j| j.kind == Kind::Hinge && m.ends(j).into_iter().all(rigid)) else {
            continue;
        };
        let [a, b] = m.ends(hinge).map(|b| m.bodies[b].name.clone());
        let pin =
            |site: usize| m.points.iter().find(|(_, s)| *s == site).expect("a thrown joint has named points").0.clone();
        let mut bound = thrown.clone();
        let far = bound.point(&a, freebody::plane::vec2(0.9, 0.7));
        let of_first = thrown.model.0.points.iter().find(|p| p.name == pin(hinge.first.site)).expect("named");
        let [x, y] =
            of_first.at.each_ref().map(|n| if let freebody::spec::Number::Literal(x) = n { *x } else { panic!() });
        let length = (0.9 - x).hypot(0.7 - y);
        bound.readings.insert("planted".into(), vec![0.0, 0.0]);
        let of = points(&[&far, &pin(hinge.second.site)]);
        let model = std::mem::take(&mut bound.model);
        bound.model = model.joint("planted", "link", &[("of", of), ("length", value(length))], &[]);
        let bound = Bench::new(&bound);
        let mut workspace = plain.balance();
        // Not where the mechanism is all but singular: there the sparse factorisation, which leans on a small shift of
        // redundant rows, keeps fewer digits (4 at accelerations of 1e5 m/s²) than the tolerance below.
        let mut rng = Rng::new(seed);
        let drawn = std::iter::repeat_with(|| {
            let s = plain.state(&mut workspace, &mut rng, 0.2).unwrap_or_else(|| panic!("seed {seed}: no state"));
            workspace.move_to(s.t, &s.q, &s.u);
            let now = workspace.instant(Route::Minimal).unwrap_or_else(|e| panic!("seed {seed}: {e:?}"));
            (s, now)
        });
        let calm = |now: &Instant| motion(now).iter().all(|a| a.abs() < 1e4);
        let found = drawn.take(10).find(|(_, now)| calm(now));
        let Some((s, before)) = found else { continue };
        planted += 1;
        let freedom = workspace.freedom();
        let mut workspace = bound.balance();
        workspace.move_to(s.t, &s.q, &s.u);
        let label = format!("seed {seed}: planted on {} of {a} and {b}; {}", hinge.name, bound.label());
        for (word, route) in Route::ALL {
            let after = workspace.instant(*route).unwrap_or_else(|e| panic!("{label}: {word}: {e:?}"));
            let off = apart(&motion(&before), &motion(&after), 1.0);
            assert!(off < 1e-9, "{label}: {word}: accelerations {off:e} apart");
            let residual = workspace.balances().residual;
            assert!(residual < 1e-12, "{label}: {word}: residual {residual:e}");
            assert_eq!(after.self_stress.len(), before.self_stress.len() + 1, "{label}: {:?}", after.self_stress);
            for (j, joint) in bound.compiled.mechanism.joints.iter().enumerate() {
                // Its thrust has both components, except where it lies along an axis, which chance does not do.
                let touched = joint.name == "planted" || joint.name == hinge.name;
                let sure =
                    m.joints.iter().position(|k| k.name == joint.name).map_or([true; 3], |k| before.determinate[k]);
                let expected = if touched { [false, false, sure[2]] } else { sure };
                assert_eq!(after.determinate[j], expected, "{label}: {}", joint.name);
            }
        }
        let now = workspace.freedom();
        assert_eq!((now.here, now.redundant), (freedom.here, freedom.redundant + 1), "{label}");
        assert_eq!(now.count, freedom.count - 1, "{label}");
    }
    assert!(planted > 5, "only {planted} hinges were found");
}

/// A table on three (or more) parallel cranks moves as on two; along the cranks, none of them can say what it carries.
#[test]
fn a_parallelogram_with_spare_cranks() {
    let build = |cranks: usize| {
        let mut model = Model::new().gravity(0.0, -9.81).body("table", 3.0, 0.5, [0.4, 0.2]);
        for i in 0..cranks {
            let (x, crank) = (0.5 * i as f64, format!("crank{i}"));
            let [ground, table] = [format!("ground.P{i}"), format!("table.P{i}")];
            let [low, high] = [format!("{crank}.A"), format!("{crank}.B")];
            model = model.body(&crank, 1.0, 0.1, [0.5, 0.0]).point(&ground, [x, 0.0]).point(&table, [x, 0.0]);
            model = model.point(&low, [0.0, 0.0]).point(&high, [1.0, 0.0]);
            let (hinge, angle) = (format!("low{i}"), format!("theta{i}"));
            model = model.joint(&hinge, "hinge", &[("of", points(&[&ground, &low]))], &[&angle]);
            let named: &[&str] = if i == 0 { &["phi"] } else { &[] };
            model = model.joint(&format!("high{i}"), "hinge", &[("of", points(&[&high, &table]))], named);
        }
        model.compile()
    };
    let solve = |cranks: usize| {
        let compiled = build(cranks);
        let m = &compiled.mechanism;
        let (theta, omega) = (1.1, 2.0);
        let by = |x: f64| -> Vec<f64> {
            (0..m.freedom()).map(|i| if m.coordinate(i).name == "phi" { -x } else { x }).collect()
        };
        let mut workspace = Workspace::new(m, &[]);
        workspace.move_to(0.0, &by(theta), &by(omega));
        let now = workspace.instant(Route::Minimal).expect("moves");
        let sure: Vec<(String, [bool; 3])> =
            m.joints.iter().zip(&now.determinate).map(|(j, s)| (j.name.clone(), *s)).collect();
        (now.bodies[body_named(m, "table") - 1], workspace.freedom(), sure)
    };
    let (_, two, sure) = solve(2);
    assert_eq!((two.count, two.here, two.redundant), (1, 1, 0));
    assert!(sure.iter().all(|(_, s)| *s == [true; 3]), "{sure:?}");
    for cranks in 3..6 {
        let (table, freedom, sure) = solve(cranks);
        // The cranks have mass and inertia: the motion is that of a table on as many cranks, here in closed form.
        let (n, g, theta, omega) = (cranks as f64, 9.81, 1.1_f64, 2.0);
        let inertia = 3.0 + n * (0.1 + 0.25);
        let alpha = -(3.0 + 0.5 * n) * g * theta.cos() / inertia;
        let expected = [
            -alpha * theta.sin() - omega * omega * theta.cos(),
            alpha * theta.cos() - omega * omega * theta.sin(),
            0.0,
        ];
        assert!(apart(&table, &expected, 1.0) < 1e-13, "{table:?} {expected:?}");
        assert_eq!((freedom.count, freedom.here, freedom.redundant), (3 - cranks as i64, 1, cranks - 2));
        for (name, sure) in sure {
            assert_eq!(sure, [false, false, true], "{cranks} cranks: {name}");
        }
    }
}
