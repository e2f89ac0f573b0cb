//! What is recorded of a mechanism once holds at all its states: of loops, too, which are eliminated in the order given. The routes of an
//! instant share neither the elimination nor the list of operations.

use crate::many_loops::{frame, on_loops};
use crate::model::*;
use crate::random_mechanisms::{loads, AGREE};
use crate::rng::Rng;
use freebody::dynamics::{reaction_names, Route, Workspace};
use freebody::hybrid::Recorded;
use freebody::mechanism::Recording;
use freebody::mode::Mode;
use freebody::scalar::Block;
use freebody::series::Alone;

/// How far a state is off the loops, rad, and what is left then by one correction: its square, by levers of less than ten lengths.
const OFF: f64 = 1e-6;
const LEFT: f64 = 1e-11;

/// The first of what is read at a state.
fn read(recorded: &Recorded, workspace: &Workspace, count: usize) -> Vec<f64> {
    let (mut alone, at) = (Alone::new(&recorded.program, &recorded.numbers(workspace)), workspace.at());
    alone.run(at.t, [at.q, at.u]);
    alone.results(0).take(count).collect()
}

/// The same, in the middle of many side by side.
fn read_beside(recorded: &Recorded, workspace: &Workspace, count: usize) -> Vec<f64> {
    let (program, at) = (&recorded.program, workspace.at());
    let (mut memory, mut found) = (program.memory::<64>(), vec![Block::of(0.0); count]);
    let each = |x: &[f64]| x.iter().map(|&x| Block::of(x)).collect::<Vec<_>>();
    program.fix(&mut memory, &each(&recorded.numbers(workspace)));
    program.run(&mut memory, Block::of(at.t), &each(&[at.q, at.u].concat()), &mut found);
    found.iter().map(|x| x.0[37]).collect()
}

/// Visits states on the loops of frames of one to three windows with what is recorded of each frame.
fn every_state(what: Recording, mut visit: impl FnMut(&Recorded, &mut Workspace, &str, &mut Rng)) {
    let mut visited = 0;
    for seed in 0..120 {
        let (mut rng, driven) = (Rng::new(seed), seed % 3 == 2);
        let compiled = frame(1 + rng.below(3), driven, &mut rng).compile();
        let m = &compiled.mechanism;
        let mut workspace = Workspace::new(m, &[]);
        on_loops(&mut workspace, m, &mut rng);
        let recorded = Recorded::new(&workspace, what).expect("nothing happens in it");
        for _ in 0..4 {
            on_loops(&mut workspace, m, &mut rng);
            if workspace.solve_motion().is_ok() && recorded.holds_at(&mut workspace) {
                visit(&recorded, &mut workspace, &format!("seed {seed}"), &mut rng);
                visited += 1;
            }
        }
    }
    assert!(visited > 60, "{visited}");
}

#[test]
fn machine_code_gives_the_bits_of_the_list() {
    for what in [Recording::Rates, Recording::Corrections, Recording::Solution] {
        every_state(what, |recorded, workspace, label, _| {
            let alone = read(recorded, workspace, usize::MAX);
            let beside = read_beside(recorded, workspace, alone.len());
            assert!(alone.iter().zip(beside).all(|(a, b)| a.to_bits() == b.to_bits()), "{label}");
        });
    }
}

#[test]
fn loops_accelerate_and_carry_as_by_newton_and_euler() {
    every_state(Recording::Solution, |recorded, workspace, label, _| {
        let (m, now) = (workspace.m, workspace.instant(Route::NewtonEuler).unwrap_or_else(|e| panic!("{label}: {e}")));
        let found = read(recorded, workspace, m.freedom() + reaction_names(m).len());
        let off = apart(&found[..m.freedom()], &now.accelerations, 1.0);
        assert!(off < AGREE, "{label}: {off:e}");
        let off = apart(&found[m.freedom()..], &loads(&now), 1.0);
        assert!(off < AGREE, "{label}: {off:e}");
    });
}

#[test]
fn rates_are_the_accelerations_and_the_power_of_each_motion() {
    every_state(Recording::Rates, |recorded, workspace, label, _| {
        let (n, motions) = (workspace.m.freedom(), workspace.m.drives.len());
        workspace.solve_by(Route::Constraints).unwrap_or_else(|e| panic!("{label}: {e}"));
        let mut expected = [workspace.at().u, &vec![0.0; n]].concat();
        workspace.accelerations(&mut expected[n..]);
        expected.extend(workspace.solved_view().drive_powers());
        let mut found = read(recorded, workspace, 2 * n + recorded.pivots + motions);
        found.drain(2 * n..2 * n + recorded.pivots);
        let off = apart(&found, &expected, 1.0);
        assert!(off < AGREE, "{label}: {off:e}");
    });
}

/// Least in the metric of the masses, as corrections by the equations of the instant are.
#[test]
fn a_correction_closes_places_in_first_order_and_rates_at_once() {
    every_state(Recording::Corrections, |recorded, workspace, label, rng| {
        let (m, mode) = (workspace.m, Mode::free(workspace.m));
        let (n, t, q) = (m.freedom(), workspace.at().t, workspace.at().q.to_vec());
        let u = rng.vector(n, 1.0);
        workspace.move_to(t, &q, &u);
        let by = read(recorded, workspace, 2 * n);
        let turned: Vec<f64> = u.iter().zip(&by[n..]).map(|(u, by)| u + by).collect();
        let mut closed = u;
        workspace.project_velocities(&mode, t, &q, &mut closed).unwrap_or_else(|e| panic!("{label}: {e}"));
        let off = apart(&turned, &closed, 1.0);
        assert!(off < AGREE, "{label}: {off:e}");
        let shifted: Vec<f64> = q.iter().zip(rng.vector(n, OFF)).map(|(q, off)| q + off).collect();
        workspace.move_to(t, &shifted, &closed);
        let by = read(recorded, workspace, n);
        let shut: Vec<f64> = shifted.iter().zip(&by).map(|(q, by)| q + by).collect();
        let mut exact = shifted;
        workspace.project_positions(&mode, t, &mut exact, &closed).unwrap_or_else(|e| panic!("{label}: {e}"));
        let off = apart(&shut, &exact, 1.0);
        assert!(off < LEFT, "{label}: {off:e}");
    });
}
