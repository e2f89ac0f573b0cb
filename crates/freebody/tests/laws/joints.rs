//! The contract of a joint, for every joint of the list.

use crate::random_motions::*;
use crate::rng::Rng;
use freebody::joints::{Card, Joint, Kind, Numbers, Relative};
use freebody::plane::Rows3;
use freebody::scalar::Dual;
use std::f64::consts::TAU;

const DRAWS: u64 = 50;

/// A joint with its numbers and its curve.
struct Drawn {
    kind: Kind,
    card: Card,
    numbers: Vec<f64>,
    wave: Wave,
    q: Vec<f64>,
    label: String,
}

impl Drawn {
    fn of(&self) -> Numbers<'_, f64> {
        Numbers { of: &self.numbers, curve: Some(&self.wave) }
    }
    fn pose(&self, q: &[f64]) -> Relative<f64> {
        self.kind.pose(&self.of(), q).expect("has a pose")
    }
    fn residual(&self, r: [f64; 3]) -> Option<Rows3<f64>> {
        self.kind.residual(&self.of(), &Relative { x: r[0], y: r[1], angle: r[2] })
    }
    /// Columns of the pose: x, y and angle by each coordinate.
    fn columns(&self) -> Vec<[f64; 3]> {
        let of: Vec<Dual<3, f64>> = self.numbers.iter().map(|&x| Dual::constant(x)).collect();
        let there =
            self.kind.pose_gradient(&Numbers { of: &of, curve: Some(&self.wave) }, &self.q).expect("has a pose");
        (0..self.q.len()).map(|k| [there.x.du[k], there.y.du[k], there.angle.du[k]]).collect()
    }
    /// Gradient of each row by x, y and angle.
    fn gradients(&self, [x, y, angle]: [f64; 3]) -> Option<Vec<[f64; 3]>> {
        let of: Vec<Dual<3, f64>> = self.numbers.iter().map(|&x| Dual::constant(x)).collect();
        let at = Relative { x: Dual::variable(x, 0), y: Dual::variable(y, 1), angle: Dual::variable(angle, 2) };
        let rows = self.kind.residual(&Numbers { of: &of, curve: Some(&self.wave) }, &at)?;
        Some(rows.iter().map(|row| row.du).collect())
    }
}

fn parts(r: Relative<f64>) -> [f64; 3] {
    [r.x, r.y, r.angle]
}

/// Every joint of the list, drawn again and again.
fn every_joint(mut visit: impl FnMut(Drawn, &mut Rng)) {
    for &kind in Kind::ALL {
        let card = kind.card();
        for seed in 0..DRAWS {
            let mut rng = Rng::new(seed);
            let (numbers, wave) = (numbers_for(&card, &mut rng), Wave::thrown(&mut rng));
            let (q, label) = (coordinates_for(&card, &mut rng), format!("{} at seed {seed}", card.word));
            visit(Drawn { kind, card: card.clone(), numbers, wave, q, label }, &mut rng);
        }
    }
}

fn every_tree_joint(mut visit: impl FnMut(Drawn, &mut Rng)) {
    every_joint(|joint, rng| {
        if joint.kind.pose(&joint.of(), &joint.q).is_some() {
            visit(joint, rng);
        }
    });
}

/// Away from whole turns.
fn turns_off(x: f64, period: f64) -> f64 {
    if period > 0.0 {
        (x - period * (x / period).round()).abs()
    } else {
        x.abs()
    }
}

// Formulas of a few operations on numbers of order one: some units in the last place.
const ROUND_OFF: f64 = 2e-14;

#[test]
fn a_joint_closes_loops_or_counts_three() {
    every_joint(|joint, _| {
        let counts = joint.card.coordinates.len() + joint.card.rows.len();
        let (pose, rows) = (joint.kind.pose(&joint.of(), &joint.q), joint.residual([5.0, 1.0, 0.3]));
        if joint.kind.rate_row(&joint.of(), &Relative { x: 5.0, y: 1.0, angle: 0.3 }).is_some() {
            let one = joint.card.rows.len() == 1 && joint.card.rows[0].of_rates;
            assert!(pose.is_none() && rows.is_none() && one, "{}", joint.label);
            return;
        }
        assert!(pose.is_some() || rows.is_some(), "{} does nothing", joint.label);
        assert_eq!(pose.is_some(), counts == 3, "{}: {counts} coordinates and rows", joint.label);
        if let Some(rows) = rows {
            assert_eq!(rows.len(), joint.card.rows.len(), "{}", joint.label);
        }
    });
}

#[test]
fn residual_vanishes_on_the_pose() {
    every_tree_joint(|joint, _| {
        let Some(rows) = joint.residual(parts(joint.pose(&joint.q))) else { return };
        for (i, &row) in rows.iter().enumerate() {
            let off = turns_off(row, joint.kind.period(&joint.of(), i));
            assert!(off < ROUND_OFF, "{}: row {i} is {off:e}", joint.label);
        }
    });
}

#[test]
fn measure_undoes_the_pose() {
    every_tree_joint(|joint, _| {
        let Some(read) = joint.kind.measure(&joint.of(), &joint.pose(&joint.q)) else { return };
        assert_eq!(read.len(), joint.q.len(), "{}", joint.label);
        for ((c, &read), &q) in joint.card.coordinates.iter().zip(read.iter()).zip(&joint.q) {
            let off = turns_off(read - q, if c.dimension == "rad" { TAU } else { 0.0 });
            assert!(off < ROUND_OFF, "{}: {} reads {read}, is {q}", joint.label, c.name);
        }
    });
}

#[test]
fn a_pose_and_its_inverse_cancel() {
    every_tree_joint(|joint, _| {
        let there = joint.pose(&joint.q);
        let (back, again) = (there.inverse(), there.inverse().inverse());
        let home = there.at() + freebody::plane::Turn::by(there.angle).apply(back.at());
        assert!(home.norm() < ROUND_OFF && there.angle + back.angle == 0.0, "{}", joint.label);
        assert!((again.at() - there.at()).norm() < ROUND_OFF && again.angle == there.angle, "{}", joint.label);
    });
}

#[test]
fn duals_agree_with_central_differences() {
    // Error of a central difference: h²/6 of third derivatives (here up to about 30) and round-off over h.
    let (h, close) = (1e-5, 1e-8);
    every_tree_joint(|joint, _| {
        for (k, column) in joint.columns().iter().enumerate() {
            let moved = |by: f64| {
                let mut q = joint.q.clone();
                q[k] += by;
                parts(joint.pose(&q))
            };
            let (later, back) = (moved(h), moved(-h));
            for i in 0..3 {
                let difference = (later[i] - back[i]) / (2.0 * h);
                assert!((difference - column[i]).abs() < close, "{}: column {k}", joint.label);
            }
        }
    });
    every_joint(|joint, rng| {
        let at = [3.0 + rng.about(0.5), rng.about(2.0), rng.about(3.0)];
        let Some(gradients) = joint.gradients(at) else { return };
        for k in 0..3 {
            let moved = |by: f64| {
                let mut at = at;
                at[k] += by;
                joint.residual(at).expect("has rows")
            };
            let (later, back) = (moved(h), moved(-h));
            for (i, gradient) in gradients.iter().enumerate() {
                let difference = (later[i] - back[i]) / (2.0 * h);
                assert!((difference - gradient[k]).abs() < close, "{}: row {i} by {k}", joint.label);
            }
        }
    });
}

/// The loads of a joint do no work on the motions that it leaves free, and together they span everything.
#[test]
fn loads_are_reciprocal_to_the_freedom() {
    every_tree_joint(|joint, _| {
        let Some(rows) = joint.gradients(parts(joint.pose(&joint.q))) else { return };
        let columns = joint.columns();
        for row in &rows {
            for column in &columns {
                let work: f64 = row.iter().zip(column).map(|(f, v)| f * v).sum();
                assert!(work.abs() < ROUND_OFF, "{}: {work:e}", joint.label);
            }
        }
        let all: Vec<[f64; 3]> = rows.iter().chain(&columns).copied().collect();
        let [a, b, c] = all[..] else { panic!("{}: not three", joint.label) };
        let volume = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        assert!(volume.abs() > 1e-3, "{}: rows and columns do not span the plane's motions", joint.label);
    });
}

/// What its card says of each row: a force, or a couple, that has a moment about the joint's point or none.
#[test]
fn rows_turn_about_the_joints_point_as_their_cards_say() {
    let mut largest = std::collections::BTreeMap::new();
    every_joint(|joint, rng| {
        let thrown = [3.0 + rng.about(0.5), rng.about(2.0), rng.about(3.0)];
        let at = joint.kind.pose(&joint.of(), &joint.q).map_or(thrown, parts);
        let Some(gradients) = joint.gradients(at) else { return };
        let there = Relative { x: at[0], y: at[1], angle: at[2] };
        let arm = there.at() - joint.kind.contact(&joint.of(), &there);
        for (i, (row, [x, y, angle])) in joint.card.rows.iter().zip(gradients).enumerate() {
            assert_eq!(row.load.couple, (x, y) == (0.0, 0.0), "{}: row {i}", joint.label);
            let moment = (angle + arm.cross(freebody::plane::vec2(x, y))).abs();
            assert!(row.turns() || moment < ROUND_OFF, "{}: row {i} turns by {moment:e}", joint.label);
            let most: &mut f64 = largest.entry((joint.card.word, i, row.turns())).or_default();
            *most = most.max(moment);
        }
    });
    let idle: Vec<_> = largest.iter().filter(|((.., turns), &most)| *turns && most < 0.1).collect();
    assert!(idle.is_empty(), "said to turn, and do not: {idle:?}");
}
