//! No memory is asked for in an evaluation: what it needs is there since the first of its kind.

use crate::many_loops::{frame, on_loops};
use crate::model::*;
use crate::random::*;
use crate::random_mechanisms::{recipe, HOME};
use crate::rng::{seeds, Rng};
use freebody::dynamics::Workspace;
use freebody::joints::Kind;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator, which counts what each thread asks for.
struct Counting;

thread_local! {
    static ASKED: Cell<usize> = const { Cell::new(0) };
}

#[allow(unsafe_code, reason = "an allocator is one; it only counts")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.with(|asked| asked.set(asked.get() + 1));
        System.alloc(layout)
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        System.dealloc(place, layout);
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often memory is asked for meanwhile.
fn asked(mut work: impl FnMut()) -> usize {
    let before = ASKED.with(Cell::get);
    work();
    ASKED.with(Cell::get) - before
}

/// How often memory is asked for at rates and at others close to them, each for the second time; none where one has no motion.
fn asked_again(workspace: &mut Workspace, t: f64, q: &[f64], u: &[f64]) -> Option<[usize; 2]> {
    let near: Vec<f64> = u.iter().map(|u| u * (1.0 + 1e-9)).collect();
    let (mut u_dot, mut solves) = (vec![0.0; q.len()], true);
    let mut of = |u: &[f64]| {
        asked(|| {
            workspace.move_to(t, q, u);
            solves &= workspace.solve_motion().is_ok();
            workspace.accelerations(&mut u_dot);
        })
    };
    let [_, _, again, other] = [u, &near, u, &near].map(&mut of);
    solves.then_some([again, other])
}

#[test]
fn an_evaluation_asks_for_no_memory() {
    let (mut evaluated, mut asking) = (0, vec![]);
    for seed in seeds(0..300, 4) {
        let bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let m = &bench.compiled.mechanism;
        // Teeth that would pull are tried on their other flank, in a mode that is made anew.
        if m.is_hybrid() && m.joints.iter().any(|joint| joint.kind == Kind::Gear) {
            continue;
        }
        let (mut workspace, mut rng) = (bench.balance(), Rng::new(seed));
        let Some(state) = bench.state(&mut workspace, &mut rng, 0.3) else { continue };
        let Some(counts) = asked_again(&mut workspace, state.t, &state.q, &state.u) else { continue };
        evaluated += 1;
        if counts != [0; 2] {
            asking.push(format!("seed {seed} {counts:?} times: {}", bench.label()));
        }
    }
    assert!(asking.is_empty(), "{asking:#?}");
    assert!(evaluated > 50, "{evaluated}");
}

/// Bars in an arc from a pin to ground, the last of them held by further pins at its end.
fn chain(bars: usize, pins: usize) -> Model {
    let place = |i: usize| [i as f64, (0.15 * i as f64).sin()];
    let mut model = Model::new().gravity(0.0, -9.81);
    for i in 0..bars {
        let (bar, [from, to]) = (format!("bar{i}"), [place(i), place(i + 1)]);
        let end = [to[0] - from[0], to[1] - from[1]];
        model = model.body(&bar, 1.0, 0.1, [0.5 * end[0], 0.5 * end[1]]);
        model = model.point(&format!("{bar}.start"), [0.0, 0.0]).point(&format!("{bar}.end"), end);
        let before = if i == 0 { "ground.O".into() } else { format!("bar{}.end", i - 1) };
        let of = points(&[&before, &format!("{bar}.start")]);
        model = model.joint(&format!("pin{i}"), "hinge", &[("of", of)], &[&format!("a{i}")]);
    }
    model = model.point("ground.O", place(0)).point("ground.D", place(bars));
    for pin in 0..pins {
        let of = points(&["ground.D", &format!("bar{}.end", bars - 1)]);
        model = model.joint(&format!("last{pin}"), "hinge", &[("of", of)], &[]);
    }
    model
}

#[test]
fn nor_do_many_loops_and_long_ones() {
    let mut rng = Rng::new(1);
    let all = [
        ("ladder", frame(25, false, &mut rng)),
        ("ladder that is driven", frame(25, true, &mut rng)),
        ("long loop", chain(60, 1)),
        ("loop that is closed twice", chain(60, 2)),
    ];
    for (name, model) in all {
        let compiled = model.compile();
        let mut workspace = Workspace::new(&compiled.mechanism, &[]);
        let [q, u] = on_loops(&mut workspace, &compiled.mechanism, &mut rng);
        assert_eq!(asked_again(&mut workspace, 0.0, &q, &u), Some([0; 2]), "{name}");
    }
}
