//! Strings between bodies that fly freely: what is seen of them in any state, and strings of all kinds thrown together.

use crate::model::*;
use crate::rng::Rng;
use freebody::cables::{Outline, Stretch, Winding};
use freebody::compile::Compiled;
use freebody::dynamics::Workspace;
use freebody::kinematics::{MotionView, SeededView, StateView};
use freebody::mechanism::{Cable as Path, End, Gap};
use freebody::mode::Feature;
use freebody::plane::{vec2, Twist, Vec2, Wrench};
use freebody::scalar::{Dual, Jet};
use freebody::spec::{Cable, CableEnd, Guide};
use std::f64::consts::{FRAC_PI_2, PI};

/// Place, or its rate, or its acceleration: x, y and angle.
pub type Three = [f64; 3];

/// Bodies `b0`, `b1` … that fly freely, and one string `s` on points of theirs.
pub struct Scene(pub Compiled);

impl Scene {
    pub fn new(arms: &[[f64; 2]], string: Cable) -> Self {
        Scene(strung(arms, string).compile())
    }
    pub fn cord(&self) -> &Path {
        match &self.0.mechanism.unilateral[0].gap {
            Gap::Cable(cable) => cable,
            other => panic!("a string became {other:?}"),
        }
    }
    /// Number, sense and radius of its ends on drums, with the length wound that is given.
    pub fn drums(&self) -> Vec<(usize, f64, f64, Option<f64>)> {
        let n = self.0.mechanism.bind(&self.0.mechanism.parameters_with(&[]));
        let drum = |(i, end): (usize, &End)| match *end {
            End::Tied(_) => None,
            End::Wound { sense, radius, wound, .. } => Some((i, sense, n.values[radius], wound.map(|w| n.values[w]))),
        };
        self.cord().ends.iter().enumerate().filter_map(drum).collect()
    }
    /// What is seen of it while its bodies are at places, with rates.
    pub fn see<R>(&self, at: &[Three], rates: &[Three], look: impl FnOnce(StateView<'_>, &Path) -> R) -> R {
        let m = &self.0.mechanism;
        let mut workspace = Workspace::new(m, &m.parameters_with(&[]));
        let ordered = |of: &[Three]| -> Vec<f64> {
            let mut all = vec![0.0; m.freedom()];
            for (i, three) in of.iter().enumerate() {
                for (word, value) in ["x", "y", "a"].iter().zip(three) {
                    all[index_of(m, &format!("{word}{i}"))] = *value;
                }
            }
            all
        };
        workspace.move_to(0.0, &ordered(at), &ordered(rates));
        look(workspace.at(), self.cord())
    }
    pub fn start(&self, at: &[Three]) -> Feature {
        self.see(at, &[], |placed, cable| {
            let feature = Feature { index: 0, phase: cable.initial_winding(placed.m, &placed) };
            Feature { index: cable.feature(placed.m, &placed, feature), ..feature }
        })
    }
    pub fn gap(&self, at: &[Three], feature: Feature) -> f64 {
        self.see(at, &[], |placed, cable| cable.gap(placed.m, &placed, feature))
    }
    pub fn outline(&self, at: &[Three], feature: Feature) -> Outline {
        self.see(at, &[], |placed, cable| cable.outline(placed.m, &placed, feature))
    }
    /// The gap with its rate and acceleration.
    pub fn jet(&self, at: &[Three], rates: &[Three], accelerations: &[Three], feature: Feature) -> Jet<f64> {
        self.see(at, rates, |placed, cable| {
            let mut bodies = vec![Twist::zero(); placed.m.bodies.len()];
            for (i, three) in accelerations.iter().enumerate() {
                bodies[body_named(placed.m, &format!("b{i}"))] = Twist::from_parts(*three);
            }
            cable.gap(placed.m, &MotionView { at: placed, bodies: Some(&bodies), accelerations: None }, feature)
        })
    }
    /// The loads of a unit tension on the bodies in their order, at their origins.
    pub fn loads(&self, at: &[Three], feature: Feature) -> Vec<Wrench> {
        self.see(at, &[], |placed, cable| {
            let load = |i: usize| {
                let body = body_named(placed.m, &format!("b{i}"));
                let gap: Dual<3, f64> = cable.gap(placed.m, &SeededView { at: placed, body }, feature);
                Wrench::from_parts(gap.du)
            };
            (0..at.len()).map(load).collect()
        })
    }
}

/// A model of free bodies, each with a point `P` at its arm, and a string.
pub fn strung(arms: &[[f64; 2]], string: Cable) -> Model {
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

pub fn string(ends: [CableEnd; 2], over: Vec<Guide>) -> Cable {
    Cable {
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

pub fn tied(point: &str) -> CableEnd {
    CableEnd::Point(point.into())
}

pub fn wound(centre: &str, radius: f64, sense: i8, length: f64) -> CableEnd {
    let (radius, wound) = (literal(radius), Some(literal(length)));
    CableEnd::Drum { centre: centre.into(), radius, sense, attached: None, wound }
}

pub fn attached(centre: &str, radius: f64, sense: i8, angle: f64) -> CableEnd {
    let (radius, attached) = (literal(radius), Some(literal(angle)));
    CableEnd::Drum { centre: centre.into(), radius, sense, attached, wound: None }
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

/// Strings of all kinds over bodies thrown apart from each other, each just taut: at its start, or after some of the
/// drums have been turned until they are empty and further.
pub fn every_string(mut visit: impl FnMut(&Scene, &[Three], Feature, &str, &mut Rng)) {
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
        let mut feature = scene.start(&at);
        let wound = scene.outline(&at, feature).wound_length;
        for (end, sense, radius, given) in scene.drums() {
            assert!(given.is_none_or(|given| (given - wound[end]).abs() < 1e-12), "seed {seed}: {given:?} {wound:?}");
            if rng.chance(0.7) {
                at[end * (n - 1)][2] += sense * (wound[end] / radius + rng.within(0.0, 4.6));
            }
        }
        feature.index = scene.see(&at, &[], |placed, cable| cable.feature(placed.m, &placed, feature));
        feature.phase[2] -= scene.gap(&at, feature);
        // Where a pulley is about to be measured with another turn, nothing is smooth.
        let outline = scene.outline(&at, feature);
        let stretches = &outline.stretches;
        let mut arcs = stretches.iter().skip(1).take(stretches.len().saturating_sub(2)).filter_map(swept);
        if arcs.any(|angle| (angle.abs() % PI - FRAC_PI_2).abs() < 0.1) {
            continue;
        }
        visit(&scene, &at, feature, &format!("seed {seed}, {:?}", Winding::of(feature.index).states), &mut rng);
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
