//! Frames of many windows, whose motions take the equations of the tree in sparse form: accelerations are those of every route, and what is
//! brought back onto the loops is on them.

use crate::model::*;
use crate::random_mechanisms::AGREE;
use crate::rng::Rng;
use freebody::dynamics::{Route, Workspace};
use freebody::mechanism::Mechanism;
use freebody::mode::Mode;

/// Largest gap of a loop, in parts of a length, and rate of a gap in parts of a rate, after a correction.
const SHUT: f64 = 1e-12;

/// Posts on a sill, joined at their heads by beams, some of them massless; all are drawn as they
/// stand, so that all coordinates are zero. `driven`: the first post turns by a law.
pub fn frame(windows: usize, driven: bool, rng: &mut Rng) -> Model {
    let heads: Vec<[f64; 2]> = (0..=windows).map(|i| [i as f64 + rng.about(0.3), rng.within(0.6, 1.4)]).collect();
    let mut model = Model::new().gravity(0.0, -9.81);
    let mass = |rng: &mut Rng| 10.0_f64.powf(rng.within(-1.5, 1.5));
    for (i, head) in heads.iter().enumerate() {
        let (post, tip, foot) = (format!("post{i}"), [head[0] - i as f64, head[1]], format!("ground.F{i}"));
        let m = mass(rng);
        model = model.body(&post, m, m / 12.0, [0.5 * tip[0], 0.5 * tip[1]]).point(&format!("{post}.foot"), [0.0, 0.0]);
        model = model.point(&format!("{post}.head"), tip).point(&foot, [i as f64, 0.0]);
        let of = points(&[&foot, &format!("{post}.foot")]);
        model = model.joint(&format!("foot{i}"), "hinge", &[("of", of)], &[&format!("a{i}")]);
    }
    for i in 1..=windows {
        let (beam, [from, to]) = (format!("beam{i}"), [heads[i - 1], heads[i]]);
        let (end, m) = ([to[0] - from[0], to[1] - from[1]], if rng.chance(0.2) { 0.0 } else { mass(rng) });
        model = model.body(&beam, m, m / 12.0, [0.5 * end[0], 0.5 * end[1]]);
        model = model.point(&format!("{beam}.start"), [0.0, 0.0]).point(&format!("{beam}.end"), end);
        let (left, right) = (format!("post{}.head", i - 1), format!("post{i}.head"));
        let ends = [points(&[&left, &format!("{beam}.start")]), points(&[&format!("{beam}.end"), &right])];
        let [of, closing] = ends;
        model = model.joint(&format!("left{i}"), "hinge", &[("of", of)], &[&format!("b{i}")]);
        model = model.joint(&format!("right{i}"), "hinge", &[("of", closing)], &[]);
    }
    match driven {
        true => model.motion("crank", "a0", "0.3*sin(2*t)", "position", None),
        false => model,
    }
}

/// A state that is on the loops, with rates that keep it there.
pub fn on_loops(workspace: &mut Workspace, m: &Mechanism, rng: &mut Rng) -> [Vec<f64>; 2] {
    let mode = Mode::free(m);
    let (mut q, mut u) = (rng.vector(m.freedom(), 1e-3), rng.vector(m.freedom(), 1.0));
    workspace.project_positions(&mode, 0.0, &mut q, &u).unwrap_or_else(|e| panic!("{e}"));
    workspace.project_velocities(&mode, 0.0, &q, &mut u).unwrap_or_else(|e| panic!("{e}"));
    workspace.move_to(0.0, &q, &u);
    [q, u]
}

#[test]
fn motions_have_the_accelerations_of_every_route_and_keep_loops_closed() {
    for seed in 0..12 {
        let (mut rng, driven) = (Rng::new(seed), seed % 3 == 2);
        let model = frame(20 + rng.below(12), driven, &mut rng);
        let compiled = model.compile();
        let m = &compiled.mechanism;
        let mut workspace = Workspace::new(m, &[]);
        let [_, u] = on_loops(&mut workspace, m, &mut rng);
        assert!(workspace.worst_gap() < SHUT, "seed {seed}: {:e}", workspace.worst_gap());
        let open = workspace.rows().iter().filter_map(|row| row.rate).fold(0.0_f64, |most, rate| most.max(rate.abs()));
        assert!(open < SHUT * u.iter().fold(1.0_f64, |most, u| most.max(u.abs())), "seed {seed}: {open:e}");
        workspace.solve_motion().unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let found = workspace.solved().nu_dot.clone();
        for (word, route) in Route::ALL {
            workspace.solve_by(*route).unwrap_or_else(|e| panic!("seed {seed}, {word}: {e}"));
            let differ = apart(&found, &workspace.solved().nu_dot, 1.0);
            assert!(differ < AGREE, "seed {seed}, {word}: {differ:e}");
        }
    }
}
