//! Thirty random mechanisms at a thousand random states: what must hold of any mechanism.

use crate::model::*;
use crate::random::*;
use crate::rng::Rng;
use freebody::balance::{Instant, Route};

pub const MECHANISMS: u64 = 30;
const STATES: usize = 34;

pub fn recipe(seed: u64) -> Recipe {
    let mut rng = Rng::new(1000 + seed);
    let bodies = 1 + rng.below(12);
    Recipe {
        bodies,
        particles: rng.below(3),
        loops: (seed as usize % 4).min(bodies / 2),
        forces: rng.below(8),
        motions: rng.below(3),
        own_directions: seed % 3 == 0,
        odd: true,
    }
}

const HOME: Base = Base::At([0.0; 3]);

#[test]
fn every_joint_holds_at_the_pose_thrown() {
    for seed in 0..MECHANISMS {
        let thrown = recipe(seed).draw(seed, HOME);
        let bench = Bench::new(&thrown);
        let mut balance = bench.balance();
        balance.place(0.0, &bench.q, &vec![0.0; bench.q.len()]);
        for body in bench.compiled.mechanism.listed_bodies() {
            let name = &bench.compiled.mechanism.bodies[body].name;
            let off = apart(&balance.frame(body), &thrown.pose[name], 1.0);
            assert!(off < 1e-13, "seed {seed}: {name} is {off:e} off: {:?} {:?}", balance.frame(body), thrown.pose[name]);
        }
    }
}

#[test]
fn the_three_routes_agree() {
    let mut states = 0;
    let mut worst: Vec<(f64, String)> = vec![];
    for seed in 0..MECHANISMS {
        let bench = Bench::new(&recipe(seed).draw(seed, HOME));
        let mut balance = bench.balance();
        let mut rng = Rng::new(seed);
        for i in 0..STATES {
            let Some(s) = bench.state(&mut balance, &mut rng, 0.3) else { eprintln!("seed {seed}: no state");break };
            balance.place(s.t, &s.q, &s.u);
            let all: Vec<Instant> = Route::ALL
                .iter()
                .filter_map(|(word, route)| balance.instant(*route).map_err(|e| eprintln!("seed {seed}, state {i}: {word}: {e:?}")).ok())
                .collect(); if all.len()<3 {break}
            states += 1;
            for (k, other) in all.iter().enumerate() {
                let (a, f) = difference(&all[0], other);
                worst.push((a, format!("seed {seed} state {i} acc {} ", Route::ALL[k].0)));
                worst.push((f, format!("seed {seed} state {i} reactions {} ", Route::ALL[k].0)));
                worst.push((other.residual*100., format!("seed {seed} state {i} residual {}", Route::ALL[k].0)));
            }
        }
    }
    for seed in 0..MECHANISMS { for what in ["acc minimal","acc newton","acc con","reactions newton","reactions con","residual mini","residual newton","residual cons"] {
        let most = worst.iter().filter(|w| w.1.starts_with(&format!("seed {seed} ")) && w.1.contains(what)).map(|w| w.0).fold(0.0, f64::max);
        if most > 1e-10 { eprintln!("seed {seed}: {what} {most:.2e} {}", Bench::new(&recipe(seed).draw(seed, HOME)).told()); }
    }}
    worst.truncate(0); worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    for w in worst.iter().take(60) { eprintln!("{w:?}"); }
    assert!(states > 1);
}

fn difference(a: &Instant, b: &Instant) -> (f64, f64) {
    let flat = |i: &Instant| i.bodies.iter().flatten().chain(&i.accelerations).copied().collect::<Vec<f64>>();
    let loads = |i: &Instant| {
        i.joints.iter().zip(&a.determinate).flat_map(|(l, sure)| {
            [l.force.x, l.force.y, l.couple].into_iter().zip(sure).map(|(x, &s)| if s { x } else { 0.0 }).collect::<Vec<_>>()
        }).chain(i.drives.iter().zip(&a.drives_determinate).map(|(x, &s)| if s { *x } else { 0.0 })).collect::<Vec<f64>>()
    };
    (apart(&flat(a), &flat(b), 1e-300), apart(&loads(a), &loads(b), 1e-300))
}
