//! Strings between bodies that fly freely: what is seen of them in any state, and strings of all kinds thrown together.

use crate::model::*;
use crate::rng::Rng;
use freebody::balance::Balance;
use freebody::compile::Compiled;
use freebody::kinematics::{Moving, Placed, Seeded};
use freebody::mechanism::{Cord as Path, End, Gap};
use freebody::mode::Piece;
use freebody::paths::{Outline, Stretch, Winding};
use freebody::plane::{vec2, Twist, Vec2, Wrench};
use freebody::scalar::{Dual, Jet};
use freebody::spec::{Cord, CordEnd, Guide};
use std::f64::consts::{FRAC_PI_2, PI};

/// Place, or its rate, or its acceleration: x, y and angle.
pub type Three = [f64; 3];

/// Bodies `b0`, `b1` … that fly freely, and one string `s` on points of theirs.
pub struct Scene(pub Compiled);

impl Scene {
    pub fn new(arms: &[[f64; 2]], string: Cord) -> Self {
        Scene(strung(arms, string).compile())
    }
    pub fn cord(&self) -> &Path {
        match &self.0.mechanism.limits[0].gap {
            Gap::Cord(cord) => cord,
            other => panic!("a string became {other:?}"),
        }
    }
    /// Number, sense and radius of its ends on drums, with the length wound that is given.
    pub fn drums(&self) -> Vec<(usize, f64, f64, Option<f64>)> {
        let n = self.0.mechanism.bind(&self.0.mechanism.parameters_with(&[]));
        let drum = |(i, end): (usize, &End)| match *end {
            End::Tied(_) => None,
            End::Wound { sense, radius, wound, .. } => Some((i, sense, n.slots[radius], wound.map(|w| n.slots[w]))),
        };
        self.cord().ends.iter().enumerate().filter_map(drum).collect()
    }
    /// What is seen of it while its bodies are at places, with rates.
    pub fn see<R>(&self, at: &[Three], rates: &[Three], look: impl FnOnce(Placed<'_>, &Path) -> R) -> R {
        let m = &self.0.mechanism;
        let mut balance = Balance::new(m, &m.parameters_with(&[]));
        let ordered = |of: &[Three]| -> Vec<f64> {
            let mut all = vec![0.0; m.freedom()];
            for (i, three) in of.iter().enumerate() {
                for (word, value) in ["x", "y", "a"].iter().zip(three) {
                    all[index_of(m, &format!("{word}{i}"))] = *value;
                }
            }
            all
        };
        balance.place(0.0, &ordered(at), &ordered(rates));
        look(balance.at(), self.cord())
    }
    pub fn start(&self, at: &[Three]) -> Piece {
        self.see(at, &[], |placed, cord| {
            let piece = Piece { index: 0, phase: cord.phases(placed.m, &placed) };
            Piece { index: cord.piece(placed.m, &placed, piece), ..piece }
        })
    }
    pub fn gap(&self, at: &[Three], piece: Piece) -> f64 {
        self.see(at, &[], |placed, cord| cord.gap(placed.m, &placed, piece))
    }
    pub fn outline(&self, at: &[Three], piece: Piece) -> Outline {
        self.see(at, &[], |placed, cord| cord.outline(placed.m, &placed, piece))
    }
    /// The gap with its rate and acceleration.
    pub fn jet(&self, at: &[Three], rates: &[Three], accelerations: &[Three], piece: Piece) -> Jet<f64> {
        self.see(at, rates, |placed, cord| {
            let mut bodies = vec![Twist::zero(); placed.m.bodies.len()];
            for (i, three) in accelerations.iter().enumerate() {
                bodies[body_named(placed.m, &format!("b{i}"))] = Twist::from_parts(*three);
            }
            cord.gap(placed.m, &Moving { at: placed, bodies: Some(&bodies), accelerations: None }, piece)
        })
    }
    /// The loads of a unit tension on the bodies in their order, at their origins.
    pub fn loads(&self, at: &[Three], piece: Piece) -> Vec<Wrench> {
        self.see(at, &[], |placed, cord| {
            let load = |i: usize| {
                let body = body_named(placed.m, &format!("b{i}"));
                let gap: Dual<3, f64> = cord.gap(placed.m, &Seeded { at: placed, body }, piece);
                Wrench::from_parts(gap.du)
            };
            (0..at.len()).map(load).collect()
        })
    }
}

/// A model of free bodies, each with a point `P` at its arm, and a string.
pub fn strung(arms: &[[f64; 2]], string: Cord) -> Model {
    let mut model = Model::new();
    for (i, arm) in arms.iter().enumerate() {
        let name = format!("b{i}");
        let coordinates = ["x", "y", "a"].map(|word| format!("{word}{i}"));
        model = model.body(&name, 1.0, 1.0, [0.0, 0.0]).point(&format!("{name}.P"), *arm).joint(
            &format!("j{i}"),
            "free",
            &[("of", points(&["ground.O", &format!("{name}.origin")]))],
            &coordinates.each_ref().map(String::as_str),
        );
    }
    model.0.strings.push(string);
    model
}

pub fn string(ends: [CordEnd; 2], over: Vec<Guide>) -> Cord {
    Cord {
        name: "s".into(),
        ends,
        over,
        length: None,
        restitution: literal(0.0),
        stiffness: None,
        damping: None,
        engaged: true,
    }
}

pub fn tied(point: &str) -> CordEnd {
    CordEnd::Point(point.into())
}

pub fn wound(centre: &str, radius: f64, sense: i8, length: f64) -> CordEnd {
    let (radius, wound) = (literal(radius), Some(literal(length)));
    CordEnd::Drum { centre: centre.into(), radius, sense, attached: None, wound }
}

pub fn attached(centre: &str, radius: f64, sense: i8, angle: f64) -> CordEnd {
    let (radius, attached) = (literal(radius), Some(literal(angle)));
    CordEnd::Drum { centre: centre.into(), radius, sense, attached, wound: None }
}

pub fn pulley(centre: &str, radius: f64, sense: i8) -> Guide {
    Guide::Pulley { centre: centre.into(), radius: literal(radius), sense }
}

pub fn along(at: &[Three], rates: &[Three], accelerations: &[Three], t: f64) -> Vec<Three> {
    (0..at.len())
        .map(|i| std::array::from_fn(|k| at[i][k] + t * (rates[i][k] + 0.5 * t * accelerations[i][k])))
        .collect()
}

pub fn threes(rng: &mut Rng, n: usize, size: f64) -> Vec<Three> {
    (0..n).map(|_| std::array::from_fn(|_| rng.about(size))).collect()
}

/// Strings of all kinds over bodies thrown apart from each other, each just taut: at its start, or after some of the drums
/// have been turned until they are empty and further.
pub fn every_string(mut visit: impl FnMut(&Scene, &[Three], Piece, &str, &mut Rng)) {
    for seed in 0..200 {
        let mut rng = Rng::new(seed);
        let n = 2 + rng.below(3);
        let sense = |rng: &mut Rng| rng.sign() as i8;
        let end = |i: usize, rng: &mut Rng| {
            let (point, radius) = (format!("b{i}.P"), rng.within(0.2, 0.8));
            match rng.below(3) {
                0 => tied(&point),
                1 => wound(&point, radius, sense(rng), rng.within(0.0, 12.0)),
                _ => attached(&point, radius, sense(rng), rng.about(3.0)),
            }
        };
        let ends = [end(0, &mut rng), end(n - 1, &mut rng)];
        let guide = |i: usize| match rng.below(3) {
            0 => Guide::Eyelet(format!("b{i}.P")),
            _ => pulley(&format!("b{i}.P"), rng.within(0.2, 0.8), sense(&mut rng)),
        };
        let over = (1..n - 1).map(guide).collect();
        let arms: Vec<[f64; 2]> = (0..n).map(|_| [rng.about(0.3), rng.about(0.3)]).collect();
        let scene = Scene::new(&arms, string(ends, over));
        // To and fro, three metres up each time.
        let mut at: Vec<Three> = (0..n)
            .map(|i| [(i % 2) as f64 * 3.0 + rng.about(0.8), 3.0 * i as f64 + rng.about(0.4), rng.about(4.0)])
            .collect();
        let mut piece = scene.start(&at);
        let wound = scene.outline(&at, piece).wound_length;
        for (end, sense, radius, given) in scene.drums() {
            assert!(given.is_none_or(|given| (given - wound[end]).abs() < 1e-12), "seed {seed}: {given:?} {wound:?}");
            if rng.chance(0.7) {
                at[end * (n - 1)][2] += sense * (wound[end] / radius + rng.within(0.0, 4.6));
            }
        }
        piece.index = scene.see(&at, &[], |placed, cord| cord.piece(placed.m, &placed, piece));
        piece.phase[2] -= scene.gap(&at, piece);
        // Where a pulley is about to be told with another turn, nothing is smooth.
        let outline = scene.outline(&at, piece);
        let stretches = &outline.stretches;
        let mut arcs = stretches.iter().skip(1).take(stretches.len().saturating_sub(2)).filter_map(swept);
        if arcs.any(|angle| (angle.abs() % PI - FRAC_PI_2).abs() < 0.1) {
            continue;
        }
        visit(&scene, &at, piece, &format!("seed {seed}, {:?}", Winding::of(piece.index).ways), &mut rng);
    }
}

pub fn ends_of(stretch: &Stretch) -> [(Vec2, Option<Vec2>); 2] {
    match *stretch {
        Stretch::Straight { from, to } => {
            let along = to - from;
            [from, to].map(|end| (end, (along.norm() > 1e-9).then(|| along * (1.0 / along.norm()))))
        }
        Stretch::Arc { centre, radius, from, to } => [from, to].map(|angle: f64| {
            let out = vec2(angle.cos(), angle.sin());
            (centre + out * radius, Some(out.perp() * (to - from).signum()))
        }),
    }
}

/// The angle of an arc, rad.
pub fn swept(stretch: &Stretch) -> Option<f64> {
    match *stretch {
        Stretch::Straight { .. } => None,
        Stretch::Arc { from, to, .. } => Some(to - from),
    }
}

pub fn length_of(stretch: &Stretch) -> f64 {
    match *stretch {
        Stretch::Straight { from, to } => (to - from).norm(),
        Stretch::Arc { radius, from, to, .. } => radius * (to - from).abs(),
    }
}
