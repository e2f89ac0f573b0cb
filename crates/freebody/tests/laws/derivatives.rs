//! Exact derivatives of accelerations and reactions against the limits of their differences.

use crate::random::*;
use crate::random_mechanisms::{recipe, HOME};
use crate::rng::{seeds, Rng};
use freebody::dynamics::{Direction, Workspace};
use freebody::gauges::ModelExpr;

/// The longest step of the differences, of a coordinate of order 1, and how often it is halved.
const STEP: f64 = 0.04;
const HALVINGS: i32 = 6;
/// Round-off of a solved instant, over the largest of its terms: masses differ by 1e4.
const ROUNDOFF: f64 = 1e-13;
/// Agreement asked, relative to the largest derivative of the instant, beside what the differences leave open.
const AGREE: f64 = 1e-10;

/// The derivatives of `f` at 0 by central differences, extrapolated to no step, each with its error (Richardson's scheme;
/// Stoer & Bulirsch, *Introduction to Numerical Analysis*, §3.5).
fn limits_of_differences(mut f: impl FnMut(f64) -> Vec<f64>) -> Vec<[f64; 2]> {
    let mut central = |k: i32| -> Vec<f64> {
        let h = STEP * 0.5_f64.powi(k);
        f(h).iter().zip(f(-h)).map(|(above, below)| (above - below) / (2.0 * h)).collect()
    };
    let rows: Vec<Vec<f64>> = (0..=HALVINGS).map(&mut central).collect();
    (0..rows[0].len()).map(|i| extrapolated(rows.iter().map(|row| row[i]).collect())).collect()
}

/// The limit of differences whose steps are halved, and how far the columns of the scheme still differ.
fn extrapolated(mut column: Vec<f64>) -> [f64; 2] {
    let (mut best, mut power) = ([column[0], f64::INFINITY], 4.0);
    while column.len() > 1 {
        let next: Vec<f64> = column.windows(2).map(|w| w[1] + (w[1] - w[0]) / (power - 1.0)).collect();
        for (next, pair) in next.iter().zip(column.windows(2)) {
            let error = (next - pair[0]).abs().max((next - pair[1]).abs());
            if error < best[1] {
                best = [*next, error];
            }
        }
        (column, power) = (next, power * 4.0);
    }
    best
}

/// All that this law reads: accelerations of the coordinates, reactions of joints, forces of motions.
fn readings(bench: &mut Bench) -> (Vec<String>, Vec<ModelExpr>) {
    let m = &bench.compiled.mechanism;
    let mut texts: Vec<String> = (0..m.freedom()).map(|i| format!("accel({})", m.coordinate(i).name)).collect();
    for joint in &m.joints {
        texts.extend(["Fx", "Fy", "M", "Fs", "Fn"].map(|word| format!("{}.{word}", joint.name)));
    }
    texts.extend(m.drives.iter().flat_map(|drive| ["force", "power"].map(|word| format!("{}.{word}", drive.name))));
    // The rate of an energy is found by such derivatives, and has none itself.
    texts.extend(["energy()", "rate(energy())"].map(String::from));
    texts.into_iter().filter_map(|text| bench.compiled.observable(&text).ok().map(|law| (text, law))).unzip()
}

#[test]
fn derivatives_are_the_limits_of_differences() {
    let mut compared = 0;
    for seed in seeds(0..300, 8) {
        let mut bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let (texts, laws) = readings(&mut bench);
        let laws: Vec<&ModelExpr> = laws.iter().collect();
        let m = &bench.compiled.mechanism;
        let mut workspace = bench.balance();
        let mut rng = Rng::new(seed);
        let Some(state) = bench.state(&mut workspace, &mut rng, 0.3) else { continue };
        workspace.move_to(state.t, &state.q, &state.u);
        workspace.solve().expect("a state that can be solved");
        // Gears bear on the flank of this solution.
        let mode = workspace.at().mode.clone();
        let n = m.freedom();
        let mut motion = Direction { t: 1.0, q: state.u.clone(), u: vec![0.0; n], ..Direction::default() };
        workspace.accelerations(&mut motion.u);
        let sizes = workspace.term_scales();
        let mut directions = vec![motion];
        // Where rows depend on each other, only a motion that they allow keeps them consistent.
        if workspace.freedom().redundant == 0 {
            directions.push(Direction { q: rng.vector(n, 1.0), u: rng.vector(n, 1.0), ..Direction::default() });
            directions.push(Direction { p: m.parameter_direction(&bench.p, 0), ..Direction::default() });
        }
        workspace.place(&mode, state.t, &state.q, &state.u);
        let exact = workspace.derivatives(&laws, &[], &directions).expect("derivatives");
        for (direction, exact) in directions.iter().zip(&exact) {
            // A fast motion is followed for a shorter while.
            let speed = direction.q.iter().chain(&direction.u).fold(1.0, |most: f64, x| most.max(x.abs()));
            let moved = |x: &[f64], by: &[f64], h: f64| -> Vec<f64> {
                x.iter().enumerate().map(|(i, x)| x + h / speed * by.get(i).unwrap_or(&0.0)).collect()
            };
            let limits = limits_of_differences(|h| {
                let mut there = Workspace::new(m, &moved(&bench.p, &direction.p, h));
                let t = state.t + h / speed * direction.t;
                there.place(&mode, t, &moved(&state.q, &direction.q, h), &moved(&state.u, &direction.u, h));
                there.evaluate(&laws, &[]).expect("a state nearby that can be solved")
            });
            let most = limits.iter().map(|[x, _]| x.abs()).filter(|x| x.is_finite()).fold(1.0, f64::max);
            let noise = ROUNDOFF * sizes.load.max(sizes.acceleration) / (STEP * 0.5_f64.powi(HALVINGS));
            for ((text, [limit, error]), exact) in texts.iter().zip(limits).zip(exact.iter().map(|x| x / speed)) {
                assert!(exact.is_nan() || !text.starts_with("rate("), "{text}");
                if exact.is_nan() || limit.is_nan() {
                    continue; // not determinate, here or nearby
                }
                let (off, asked) = ((limit - exact).abs(), AGREE * most + 10.0 * error + noise);
                let label = format!("seed {seed}, {text}: {exact} for {limit} ± {error:e}; {}", bench.label());
                assert!(off <= asked, "{label}");
                compared += usize::from(asked < 2.0 * AGREE * most);
            }
        }
    }
    assert!(compared > 250, "{compared} derivatives compared");
}
