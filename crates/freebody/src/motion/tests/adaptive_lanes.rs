//! Motions side by side, each by its own steps, are those of the method alone, to the same bits.

use super::*;
use crate::scalar::Block;

const LANES: usize = 6;

/// ẍ = −w² sin x + cos t, of which one runs away: ẋ = x².
fn rate(w: f64, t: f64, y: &[f64], dy: &mut [f64]) {
    (dy[0], dy[1]) = (y[1], t.cos() - w * w * y[0].sin());
    if w == 0.0 {
        (dy[0], dy[1]) = (y[0] * y[0], 0.0);
    }
}

/// Pendulums side by side, with what was shown of each.
struct Pendulums {
    w: [f64; LANES],
    shown: [Vec<[f64; 2]>; LANES],
}

impl LaneSystem<LANES> for Pendulums {
    fn rate(&mut self, t: &Block<LANES>, y: &[Block<LANES>], dy: &mut [Block<LANES>]) {
        for i in 0..LANES {
            let mut own = [0.0; 2];
            rate(self.w[i], t.0[i], &[y[0].0[i], y[1].0[i]], &mut own);
            (dy[0].0[i], dy[1].0[i]) = (own[0], own[1]);
        }
    }
    fn project(&mut self, _: &Block<LANES>, _: &mut [Block<LANES>], _: &[bool; LANES]) {}
    fn show(&mut self, _: &Block<LANES>, y: &mut [Block<LANES>], of: &[bool; LANES]) {
        (0..LANES).filter(|&i| of[i]).for_each(|i| self.shown[i].push([y[0].0[i], y[1].0[i]]));
    }
}

#[test]
fn each_has_the_bits_that_it_has_alone_however_long_the_steps_of_others_are() {
    let w = [1.0, 30.0, 0.0, 3.0, 0.1, 7.0];
    for (to, options) in [
        (8.0, rtol(1e-8)),
        (-8.0, rtol(1e-5)),
        (8.0, Options { max_step: 0.3, ..rtol(1e-6) }),
        (8.0, Options { first_step: Some(2.0), ..rtol(1e-10) }),
    ] {
        let times: Vec<f64> = [0.0, 0.01, 0.3, 0.31, 2.0, 7.999, 8.0].iter().map(|t| t * to / 8.0).collect();
        let start = [Block([0.5; LANES]), Block([0.1; LANES])];
        let mut system = Pendulums { w, shown: Default::default() };
        let interval = Interval { from: 0.0, to, times: &times, options: &options };
        let live = std::array::from_fn(|i| i != 4);
        let ends = integrate_lanes(&mut system, interval, &start, vec![(vec![1.0; 2], 1.0); LANES], live);
        for i in (0..LANES).filter(|&i| live[i]) {
            let mut alone = Plain::new(&[1.0, 1.0], |t, y, dy| rate(w[i], t, y, dy));
            let run = alone.run("dop853", (0.0, &[0.5, 0.1]), to, &options);
            assert_eq!(ends[i], run.outcome == Outcome::Completed, "{i}: {:?}", run.outcome);
            for (t, shown) in times.iter().zip(&system.shown[i]) {
                let mut y = [0.0; 2];
                assert!(run.trajectory.at(*t, &mut y), "{i}: {t}");
                assert_eq!(y.map(f64::to_bits), shown.map(f64::to_bits), "{i}: {t}");
            }
            assert!(!ends[i] || system.shown[i].len() == times.len(), "{i}");
        }
        assert_eq!(ends, [true, true, to < 0.0, true, false, true]);
    }
}
