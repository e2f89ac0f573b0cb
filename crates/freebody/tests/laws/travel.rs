//! A bound of how far bodies go, against where they go.

use crate::random::*;
use crate::random_mechanisms::{recipe, HOME};
use crate::rng::{seeds, Rng};
use freebody::kinematics::{Poses, Travel, TravelView, PARTS};
use freebody::plane::Pose;
use freebody::scalar::Ball;

/// How many of all sums of the parts of each motion are looked at.
const LOOKS: usize = 20;
/// Round-off of places and angles of order 1 to 100.
const ROUNDOFF: f64 = 1e-12;

#[test]
fn nothing_leaves_its_bound() {
    let mut bounded = 0;
    for seed in seeds(0..200, 4) {
        let bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let (bodies, n) = (bench.compiled.mechanism.bodies.len(), bench.q.len());
        let (mut workspace, mut rng, at_rest) = (bench.balance(), Rng::new(seed), vec![0.0; n]);
        let size = *rng.of(&[1e-3, 0.1, 2.0]);
        let parts: Vec<Vec<f64>> = (0..PARTS).map(|_| rng.vector(n, size)).collect();
        workspace.move_to(0.0, &bench.q, &at_rest);
        let mut travel = Travel::default();
        travel.follow(workspace.at(), |i| std::array::from_fn(|k| parts[k][i]), 0.0);
        let numbers = |Pose { at, turn }: Pose<Ball>| [at.x, at.y, turn.angle, turn.cos, turn.sin];
        let bounds: Vec<[Ball; 5]> =
            (0..bodies).map(|body| numbers(TravelView { at: workspace.at(), travel: &travel }.pose(body))).collect();
        for _ in 0..LOOKS {
            let (weights, own) = (rng.vector(PARTS - 1, 1.0), rng.vector(n, 1.0));
            let together = |i: usize| weights.iter().zip(&parts).map(|(weight, part)| weight * part[i]).sum::<f64>();
            let gone = |i: usize| together(i) + own[i] * parts[PARTS - 1][i];
            let q: Vec<f64> = bench.q.iter().enumerate().map(|(i, q)| q + gone(i)).collect();
            workspace.move_to(0.0, &q, &at_rest);
            for (body, balls) in bounds.iter().enumerate() {
                let Pose { at, turn } = workspace.at().pose(body);
                let found = [at.x, at.y, turn.angle, turn.cos, turn.sin];
                for (x, ball) in found.iter().zip(balls).filter(|(_, ball)| ball.radius.is_finite()) {
                    let gone = (x - ball.mid).abs();
                    assert!(
                        gone <= ball.radius + ROUNDOFF,
                        "seed {seed}, body {body}: {gone} > {} in {}",
                        ball.radius,
                        bench.label()
                    );
                    bounded += 1;
                }
            }
        }
    }
    assert!(bounded > 10_000, "{bounded}");
}
