//! Every joint is defined twice, by how it moves and by what it forbids; and a mechanism does not know where its tree was
//! cut. Either telling must give the same accelerations and the same reactions.

use crate::model::*;
use crate::random::Bench;
use crate::random_motions::*;
use crate::rng::Rng;
use freebody::dynamics::{JointLoad, Route, Workspace};
use freebody::joints::{FieldKind, Joint, Kind};
use freebody::mechanism::Mechanism;
use freebody::spec::Value;

const DRAWS: u64 = 20;

/// Agreement relative to the largest acceleration or load: two ways through some ten operations each on bodies of like
/// mass, and the condition of a linkage of two bodies (below 1e4).
const AGREE: f64 = 1e-11;

/// A body carried by a hinge and a body joined to it by the joint under test, its ends in either order. With `free`,
/// the second body hangs free in the plane, so that the joint under test closes a loop.
fn pair(kind: Kind, seed: u64, reversed: bool, free: bool) -> Thrown {
    let mut rng = Rng::new(seed);
    let mut thrown = Thrown::new([rng.about(5.0), -9.81]);
    let on_curve = kind.card().fields.iter().any(|f| f.kind == FieldKind::Curve);
    for name in ["a", "b"] {
        let mass = rng.within(0.5, 2.0);
        let place = [rng.about(1.0), rng.about(1.0), rng.about(3.0)];
        thrown.throw(name, literal(mass), literal(rng.within(0.1, 0.5)), [rng.about(0.4), rng.about(0.4)], place);
    }
    let ends = if reversed { ["b", "a"] } else { ["a", "b"] };
    let hang = |thrown: &mut Thrown, rng: &mut Rng, body: &str| match (body, free) {
        ("a", _) => thrown.join(rng, "hang", Kind::Hinge, ["ground", "a"], true, false),
        (_, true) => thrown.join(rng, "free", Kind::Free, ["ground", "b"], true, false),
        _ => {}
    };
    // A joint on a curve is wanted in the tree, but not from its second body with an absolute angle.
    for body in [ends[1], ends[0]] {
        hang(&mut thrown, &mut Rng::new(seed + 1000), body);
    }
    thrown.join(&mut Rng::new(seed + 2000), "test", kind, ends, on_curve || !free, false);
    if on_curve && free {
        let own = &mut thrown.model.0.joints.last_mut().expect("just joined").coordinates;
        own.last_mut().expect("its turn").absolute = true;
    }
    let (p, q) = (thrown.point("a", Default::default()), thrown.point("b", Default::default()));
    let between = points(&[&p, &q]);
    let spring =
        [("between", between), ("stiffness", value(30.0)), ("rest_length", value(0.4)), ("damping", value(2.0))];
    let model = std::mem::take(&mut thrown.model).force("spring", "spring", &spring);
    thrown.model = model.force("motor", "torque", &[("on", text("b")), ("from", text("a")), ("value", value(1.7))]);
    thrown
}

/// Rates of the same motion in another tree: of joints that both trees hold the same, of a free body the velocity of
/// its point.
fn rates(to: &Bench, from: &Bench, at: &Workspace, u: &[f64]) -> Vec<f64> {
    let (m, tree) = (&to.compiled.mechanism, &from.compiled.mechanism);
    let mut there = to.balance();
    there.move_to(0.0, &to.q, &vec![0.0; to.q.len()]);
    let rate = |i: usize| {
        if let Some(j) = (0..u.len()).find(|&j| tree.coordinate(j).name == m.coordinate(i).name) {
            return u[j];
        }
        let joint = &m.joints[m.coordinates[i].0];
        assert_eq!(joint.kind, Kind::Free, "{}", m.coordinate(i).name);
        let body = body_named(tree, &m.bodies[m.body_of(joint.second.site)].name);
        let (pose, twist) = (at.at().k.pose[body], at.at().k.twist[body]);
        let v = twist.at(there.site(joint.second.site) - pose.at);
        [v.x, v.y, twist.w][m.coordinates[i].1]
    };
    (0..to.q.len()).map(rate).collect()
}

fn components(load: &JointLoad) -> [f64; 5] {
    let local = load.in_joint_axes();
    [load.force.x, load.force.y, load.couple, local.x, local.y]
}

fn accelerations(m: &Mechanism, bodies: &[[f64; 3]]) -> Vec<f64> {
    ["a", "b"].iter().flat_map(|b| bodies[body_named(m, b) - 1]).collect()
}

#[test]
fn a_joint_of_the_tree_is_the_same_joint_closing_a_loop() {
    for &kind in Kind::ALL.iter().filter(|&&k| has_pose(k)) {
        for (seed, reversed) in (0..DRAWS).flat_map(|s| [(s, false), (s, true)]) {
            let what = format!("{} at seed {seed}, reversed {reversed}", kind.card().word);
            let tree = Bench::new(&pair(kind, seed, reversed, false));
            let cut = Bench::new(&pair(kind, seed, reversed, true));
            assert!(!tree.balance().is_closed(), "{what}: not a tree");
            assert!(cut.balance().is_closed(), "{what}: {}", cut.label());
            let u = Rng::new(seed + 3000).vector(tree.q.len(), 2.0);
            let mut one = tree.balance();
            one.move_to(0.0, &tree.q, &u);
            let mut other = cut.balance();
            let v = rates(&cut, &tree, &one, &u);
            other.move_to(0.0, &cut.q, &v);
            let first = one.instant(Route::Minimal).unwrap_or_else(|e| panic!("{what}: {e:?}"));
            let [m, n] = [&tree.compiled.mechanism, &cut.compiled.mechanism];
            let (a, f) = (accelerations(m, &first.bodies), components(&first.joints[joint_named(m, "test")]));
            for (word, route) in Route::ALL {
                let now = other.instant(*route).unwrap_or_else(|e| panic!("{what}: {word}: {e:?}"));
                let (b, g) = (accelerations(n, &now.bodies), components(&now.joints[joint_named(n, "test")]));
                let (da, df) = (apart(&a, &b, 1.0), apart(&f, &g, 1.0));
                assert!(
                    da < AGREE && df < AGREE,
                    "{what}: {word}: accelerations {da:e}, reactions {df:e} apart\n{f:?} {g:?}"
                );
            }
        }
    }
}

/// A round follower on a curve is a pin on the curve's parallel.
#[test]
fn a_cam_is_a_slot_along_the_parallel_curve() {
    let r = 0.3;
    let build = |kind: &str, x: &str, y: &str, fields: &[(&str, Value)]| {
        let model = Model::new().gravity(0.0, -9.81).body("a", 2.0, 0.7, [0.2, -0.1]).body("b", 1.0, 0.2, [0.1, 0.3]);
        let model = model.point("a.A", [0.0, 0.0]).point("b.B", [-0.2, 0.1]).curve("a.curve", x, y);
        let model = model.joint("hang", "hinge", &[("of", points(&["ground.O", "a.A"]))], &["theta"]);
        let fields: Vec<_> = fields.iter().cloned().chain([("along", text("a.curve"))]).collect();
        model.joint("test", kind, &fields, &["s", "phi"]).compile()
    };
    let cam = build("cam", "s", "s^2/2", &[("follower", circle("b.B", r))]);
    let (x, y) = (format!("s - {r}*s/sqrt(1 + s^2)"), format!("s^2/2 + {r}/sqrt(1 + s^2)"));
    let slot = build("curved_slot", &x, &y, &[("point", text("b.B"))]);
    let mut rng = Rng::new(7);
    for _ in 0..DRAWS {
        let (q, u) = ([rng.about(3.0), rng.about(1.0), rng.about(3.0)], rng.vector(3, 2.0));
        let solved: Vec<_> = [&cam, &slot]
            .iter()
            .map(|c| {
                let mut workspace = Workspace::new(&c.mechanism, &[]);
                workspace.move_to(0.0, &q, &u);
                let now = workspace.instant(Route::Minimal).expect("a tree with inertia");
                (now.accelerations.clone(), components(&now.joints[1]).to_vec())
            })
            .collect();
        assert!(apart(&solved[0].0, &solved[1].0, 1.0) < AGREE, "accelerations at {q:?}");
        assert!(apart(&solved[0].1, &solved[1].1, 1.0) < AGREE, "reactions at {q:?}");
    }
}
