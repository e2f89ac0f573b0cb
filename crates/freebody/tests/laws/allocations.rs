//! No memory is asked for in an evaluation: what it needs is there since the first of its kind.

use crate::random::*;
use crate::random_mechanisms::{recipe, HOME};
use crate::rng::{seeds, Rng};
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
        let mut u_dot = vec![0.0; state.q.len()];
        let near: Vec<f64> = state.u.iter().map(|u| u * (1.0 + 1e-9)).collect();
        let mut solves = true;
        for (u, first) in [(&state.u, true), (&near, true), (&state.u, false), (&near, false)] {
            let count = asked(|| {
                workspace.move_to(state.t, &state.q, u);
                solves &= workspace.solve_motion().is_ok();
                workspace.accelerations(&mut u_dot);
            });
            if solves && !first {
                evaluated += 1;
                if count > 0 {
                    asking.push(format!("seed {seed} {count} times: {}", bench.label()));
                }
            }
        }
    }
    assert!(asking.is_empty(), "{asking:#?}");
    assert!(evaluated > 100, "{evaluated}");
}
