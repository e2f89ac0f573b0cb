//! A mechanism does not know where its loops were cut: whichever joints make the tree, bodies and reactions are the
//! same.

use crate::model::*;
use crate::random::*;
use crate::random_mechanisms::{loads, HOME, MECHANISMS};
use crate::rng::Rng;
use freebody::dynamics::{Instant, Route};
use freebody::gauges::{ModelExpr, ModelVariable};
use freebody::joints::Joint;
use freebody::kinematics::{jet, MotionView};
use freebody::mechanism::Mechanism;
use freebody::plane::Vec2;

/// Two eliminations of linkages whose masses differ by 1e4, relative to the largest.
const AGREE: f64 = 1e-9;

/// Accelerations by body and reactions by joint, determinate in both.
fn compare(label: &str, [m, n]: [&Mechanism; 2], [a, b]: [&Instant; 2]) {
    let flat = |i: &Instant, m: &Mechanism| -> Vec<f64> {
        m.listed_bodies().into_iter().flat_map(|body| i.bodies[body - 1]).collect()
    };
    let off = apart(&flat(a, m), &flat(b, n), 1.0);
    assert!(off < AGREE, "{label}: accelerations {off:e} apart");
    let most = loads(a).iter().chain(&loads(b)).fold(1e-300, |m: f64, x| m.max(x.abs()));
    for (j, joint) in m.joints.iter().enumerate() {
        let Some(k) = n.joints.iter().position(|other| other.name == joint.name) else { continue };
        let parts = |l: &freebody::dynamics::JointLoad| [l.force.x, l.force.y, l.couple];
        let curve = |m: &Mechanism, j: usize| m.bodies[m.ends(&m.joints[j])[1]].listed.is_none();
        if curve(m, j) || curve(n, k) {
            continue;
        }
        for axis in 0..3 {
            assert_eq!(a.determinate[j][axis], b.determinate[k][axis], "{label}: {} {axis}", joint.name);
            let (x, y) = (parts(&a.joints[j])[axis], parts(&b.joints[k])[axis]);
            let apart = (x - y).abs();
            assert!(!a.determinate[j][axis] || apart < AGREE * most, "{label}: {} {axis}: {x} {y}", joint.name);
        }
    }
}

#[test]
fn the_tree_does_not_matter() {
    let mut other_trees = 0;
    for seed in 0..3 * MECHANISMS {
        let recipe = Recipe {
            bodies: 3 + seed as usize % 6,
            particles: 0,
            loops: 1 + seed as usize % 3,
            forces: 4,
            motions: 0,
            own_directions: false,
            odd: false,
            locks: 0,
            idle: false,
        };
        let thrown = recipe.draw(seed, HOME);
        let mut renamed = thrown.clone();
        let mut rng = Rng::new(seed);
        for joint in &mut renamed.model.0.joints {
            let card = freebody::joints::Kind::named(&joint.kind).expect("a joint of the list").card();
            let wanted = rng.chance(0.5) && card.coordinates.len() + card.rows.len() == 3;
            let names = card.coordinates.iter().filter(|_| wanted);
            joint.coordinates = names.map(|c| coordinate(&format!("{}_{}", joint.name, c.name))).collect();
        }
        let (one, other) = (Bench::new(&thrown), Bench::new(&renamed));
        let [m, n] = [&one.compiled.mechanism, &other.compiled.mechanism];
        let cut = |m: &Mechanism| m.closures.iter().map(|&j| m.joints[j].name.clone()).collect::<Vec<_>>();
        let label = format!("seed {seed}: cut at {:?} and {:?}; {}", cut(m), cut(n), one.label());
        let mut first = one.balance();
        first.move_to(0.0, &one.q, &vec![0.0; one.q.len()]);
        let mode = first.with_row_offsets();
        first.enter(&mode);
        let mut u = rng.vector(one.q.len(), 2.0);
        first.project_velocities(&mode, 0.0, &one.q, &mut u).unwrap_or_else(|e| panic!("{label}: {e:?}"));
        first.move_to(0.0, &one.q, &u);
        // The rates of the other tree's coordinates, read off the first tree's bodies.
        let going = MotionView { at: first.at(), bodies: None, accelerations: None };
        let rate = |&(joint, k): &(usize, usize)| {
            let here = joint_named(m, &n.joints[joint].name);
            let present = k < m.joints[here].coordinates.len();
            present.then(|| jet(&going, &ModelExpr::variable(ModelVariable::Coordinate(here, k))).d1)
        };
        let Some(v) = n.coordinates.iter().map(rate).collect::<Option<Vec<f64>>>() else { continue };
        other_trees += usize::from(cut(m) != cut(n));
        let a = first.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}: {e:?}"));
        let mut second = other.balance();
        second.move_to(0.0, &other.q, &v);
        let b = second.instant(Route::Minimal).unwrap_or_else(|e| panic!("{label}: {e:?}"));
        compare(&label, [m, n], [&a, &b]);
    }
    assert!(other_trees > MECHANISMS as usize, "only {other_trees} mechanisms were cut elsewhere");
}

/// A four-bar of which any one link may be massless, cut at any joint: then a massless link may end the tree.
#[test]
fn a_massless_link_may_be_cut_loose() {
    let joints =
        [["ground.A", "crank.A"], ["crank.B", "coupler.B"], ["coupler.C", "rocker.C"], ["rocker.D", "ground.D"]];
    let at = [[0.0, 0.0], [0.3, 0.4], [1.2, 0.9], [1.0, 0.0]].map(|[x, y]| Vec2 { x, y });
    for massless in ["crank", "coupler", "rocker"] {
        let mut found: Vec<Instant> = vec![];
        let mut mechanisms = vec![];
        for cut in 0..4 {
            let mut model =
                Model::new().gravity(0.0, -9.81).point("ground.A", [0.0, 0.0]).point("ground.D", [1.0, 0.0]);
            // Each bar lies along its own x axis, from the pin named first.
            for (i, body) in ["crank", "coupler", "rocker"].into_iter().enumerate() {
                let length = (at[i + 1] - at[i]).norm();
                let mass = if body == massless { 0.0 } else { 1.5 };
                model = model.body(body, mass, 0.1 * mass, [0.4 * length, 0.0]);
                model = model.point(joints[i][1], [0.0, 0.0]).point(joints[i + 1][0], [length, 0.0]);
            }
            for (i, of) in joints.iter().enumerate() {
                let named: &[&str] = if i == cut { &[] } else { &[["h0", "h1", "h2", "h3"][i]] };
                model = model.joint(["A", "B", "C", "D"][i], "hinge", &[("of", points(of))], named);
            }
            mechanisms.push((cut, model.compile()));
        }
        for (cut, compiled) in &mechanisms {
            let m = &compiled.mechanism;
            assert_eq!(m.closures, [*cut]);
            let direction = |i: usize| (at[i + 1] - at[i]).y.atan2((at[i + 1] - at[i]).x);
            let angles = [0.0, direction(0), direction(1), direction(2), 0.0];
            let q: Vec<f64> = m.coordinates.iter().map(|&(j, _)| angles[j + 1] - angles[j]).collect();
            let mut workspace = freebody::dynamics::Workspace::new(m, &[]);
            workspace.move_to(0.0, &q, &vec![0.0; q.len()]);
            assert!(workspace.worst_gap() < 1e-15);
            for (word, route) in Route::ALL {
                found.push(
                    workspace.instant(*route).unwrap_or_else(|e| panic!("{massless} cut at {cut}: {word}: {e:?}")),
                );
            }
        }
        for (i, now) in found.iter().enumerate() {
            let label = format!("{massless} massless, cut at {}", i / 3);
            compare(&label, [&mechanisms[0].1.mechanism, &mechanisms[i / 3].1.mechanism], [&found[0], now]);
        }
    }
}

/// A particle passes no couple: what is welded to it is pinned, and a slider along a body's line is a slot. No tree
/// that would hang the body on the particle is chosen where another will do.
#[test]
fn no_couple_goes_through_a_particle() {
    let bead = |m: Model| {
        m.particle("bead", 0.7).point("bead.C", [0.0, 0.0]).body("rod", 1.5, 0.2, [0.4, 0.1]).point("rod.A", [0.0, 0.0])
    };
    let guided = |kind: &str| {
        let (far, names): (_, &[&str]) = match kind {
            "slider" => (("line", line("bead.C", 0.0)), &["r"]),
            _ => (("point", text("bead.C")), &[]),
        };
        let upright = [("along", line("ground.B", std::f64::consts::FRAC_PI_2)), ("point", text("bead.C"))];
        bead(Model::new().gravity(0.3, -9.81).point("ground.A", [0.0, 0.0]).point("ground.B", [1.0, 0.0]))
            .joint("pivot", "hinge", &[("of", points(&["ground.A", "rod.A"]))], &[])
            .joint("wall", "slot", &upright, &["y"])
            .joint("between", kind, &[("along", line("rod.A", 0.0)), far], names)
    };
    let floating = |kind: &str| {
        let push = [("at", text("rod.A")), ("x", value(3.0)), ("y", value(-1.0))];
        bead(Model::new().gravity(0.0, 0.0).point("rod.B", [0.9, -0.2]))
            .joint("between", kind, &[("of", points(&["rod.B", "bead.C"]))], &[])
            .force("push", "force", &push)
    };
    let cases = [
        (guided("slider"), guided("slot"), vec![0.4, 0.4_f64.tan()]),
        (floating("weld"), floating("hinge"), vec![0.2, -0.1, 0.7]),
    ];
    for (one, other, q) in cases {
        let [one, other] = [one.compile(), other.compile()];
        let [m, n] = [&one.mechanism, &other.mechanism];
        let solved = |m: &Mechanism| {
            let mut workspace = freebody::dynamics::Workspace::new(m, &[]);
            workspace.move_to(0.0, &q, &vec![0.0; q.len()]);
            assert!(workspace.worst_gap() < 1e-15);
            workspace.instant(Route::Minimal).expect("nothing is singular here")
        };
        compare("a particle", [m, n], [&solved(m), &solved(n)]);
    }
}
