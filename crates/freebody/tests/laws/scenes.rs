//! Disks and points against surfaces of every kind, on bodies of every sort, thrown anywhere and in any motion.

use crate::model::*;
use crate::rng::Rng;
use freebody::bound_values::BoundValues;
use freebody::gauges::ModelExpr;
use freebody::kinematics::{Kinematics, MotionView, StateView};
use freebody::mechanism::{
    Arc, Chain, ContactPair, Disk, Marker, Mechanism, PointLocation, Profile, Site, Stretch, Track,
};
use freebody::mode::Mode;
use freebody::plane::{vec2, Pose, Turn, Twist, Vec2};

const SURFACES: [&str; 9] = ["line", "circle", "hollow", "polygon", "chain", "bent", "arc", "hollow arc", "track"];

/// A touch of a disk and a surface, on bodies of every sort; the disk comes first.
pub struct Scene {
    pub m: Mechanism,
    pub touch: ContactPair,
    pub word: &'static str,
    pub label: String,
}

/// Bodies wherever they are, and their motion.
#[derive(Clone)]
pub struct There {
    pub n: BoundValues,
    pub k: Kinematics,
    pub acceleration: Vec<Twist>,
    pub mode: Mode,
}

impl Scene {
    pub fn new(word: &'static str, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let rng = &mut rng;
        let free = |model: Model, body: &str, coordinates: &[&str]| {
            model.joint(body, "free", &[("of", points(&["ground.O", &format!("{body}.origin")]))], coordinates)
        };
        let model = Model::new().body("a", 1.0, 1.0, [0.0; 2]).body("b", 1.0, 1.0, [0.0; 2]).particle("bead", 1.0);
        let model = free(free(free(model, "a", &["xa", "ya", "fa"]), "b", &["xb", "yb", "fb"]), "bead", &["xc", "yc"]);
        let mut m = model.compile().mechanism;
        let [first, second] = *rng.of(&[["a", "b"], ["bead", "b"], ["a", "ground"], ["ground", "b"]]);
        let point = !rng.chance(0.5);
        let label =
            format!("{} of {first} against {word} of {second}, seed {seed}", if point { "point" } else { "disk" });
        let [first, second] = [first, second].map(|name| body_named(&m, name));
        let reach = if m.bodies[first].particle { 0.0 } else { 1.0 };
        let centre = site(&mut m, first, vec2(rng.about(reach), rng.about(reach)));
        let radius = (!point).then(|| slot(&mut m, rng.within(0.1, 0.3)));
        let from = vec2(rng.about(1.0), rng.about(1.0));
        let against = match word {
            "line" => Profile::Line(Marker {
                site: site(&mut m, second, from),
                angle: slot(&mut m, rng.about(3.0)),
                turned: true,
            }),
            "circle" | "hollow" => Profile::Circle {
                centre: site(&mut m, second, from),
                radius: slot(&mut m, rng.within(0.5, 1.5)),
                hollow: word == "hollow",
            },
            "arc" | "hollow arc" => {
                let (start, sweep) = (rng.about(3.0), rng.within(0.3, 5.5));
                Profile::Arc(Arc {
                    centre: site(&mut m, second, from),
                    radius: slot(&mut m, rng.within(0.5, 1.5)),
                    hollow: word == "hollow arc",
                    ends: [slot(&mut m, start), slot(&mut m, start + sweep)],
                })
            }
            "track" => Profile::Track(track(&mut m, second, from, rng)),
            _ => {
                let sites = outline(word, rng).into_iter().map(|p| site(&mut m, second, from + p)).collect();
                Profile::Chain(Chain { corners: sites, closed: word == "polygon", beyond: [None; 2] })
            }
        };
        Scene { m, touch: ContactPair { disk: Disk { centre, radius, beside: None }, against }, word, label }
    }

    /// Bodies somewhere, in any motion, the disk near the surface or anywhere; a particle does not turn.
    pub fn thrown(&self, rng: &mut Rng) -> There {
        let (m, mut some) = (&self.m, |a: f64| vec2(rng.about(a), rng.about(a)));
        let n = m.bind::<f64>(&[]);
        let mut k = Kinematics::of(m);
        let mut acceleration = vec![Twist::zero(); m.bodies.len()];
        for (i, body) in m.bodies.iter().enumerate().skip(1) {
            let turning = if body.particle { 0.0 } else { 1.0 };
            let (at, [v, a], turns) = (some(2.0), [some(1.0), some(1.0)], [some(3.0), some(1.5)]);
            k.pose[i] = Pose { at, turn: Turn::by(turning * turns[0].x) };
            k.arm[i] = at;
            k.twist[i] = Twist { v, w: turning * turns[1].x };
            acceleration[i] = Twist { v: a, w: turning * turns[1].y };
        }
        There { n, k, acceleration, mode: Mode::free(m) }
    }

    /// Shifts the body that can move so that the disk goes by a vector against the surface.
    pub fn shift(&self, there: &mut There, by: Vec2) {
        let [disk, surface] = self.touch.bodies(&self.m);
        let (body, by) = if disk > 0 { (disk, by) } else { (surface, -by) };
        there.k.pose[body].at += by;
        there.k.arm[body] += by;
    }

    /// The same with the disk at a place, or where it is seen from the surface as if it were there.
    pub fn with_disk_at(&self, there: &There, place: Vec2) -> There {
        let mut other = there.clone();
        self.shift(&mut other, place - self.place(there, self.touch.disk.centre));
        other
    }

    /// Every piece in turn.
    pub fn pieces(&self) -> Vec<usize> {
        match &self.touch.against {
            Profile::Chain(chain) => {
                let (sides, point) = (chain.sides(), self.touch.disk.radius.is_none());
                let all = (0..2 * sides + usize::from(!chain.closed)).collect::<Vec<_>>();
                let end = |&p: &usize| !chain.closed && p + 1 >= 2 * sides;
                all.into_iter().filter(|p| !point || p % 2 == 0 || end(p)).collect()
            }
            Profile::Arc(_) => vec![0, 1, 2],
            Profile::Track(track) => {
                let ends = if self.touch.disk.radius.is_some() { 2 } else { 0 };
                (0..track.stretches.len() + ends).collect()
            }
            Profile::Line(_) | Profile::Circle { .. } => vec![0],
        }
    }

    /// Centre, radius, and directions of the ends of an arc, in fixed axes.
    pub fn arc(&self, there: &There) -> Option<(Vec2, f64, [f64; 2])> {
        let Profile::Arc(arc) = &self.touch.against else { return None };
        let turn = there.k.pose[self.m.body_of(arc.centre)].turn.angle;
        let ends = arc.ends.map(|slot| turn + there.n.values[slot]);
        Some((self.place(there, arc.centre), there.n.values[arc.radius], ends))
    }

    pub fn radius(&self, there: &There) -> f64 {
        self.touch.disk.radius.map_or(0.0, |slot| there.n.values[slot])
    }

    pub fn place(&self, there: &There, site: usize) -> Vec2 {
        there.k.pose[self.m.body_of(site)].place(there.n.arms[site])
    }

    pub fn corners(&self, there: &There) -> Option<(Vec<Vec2>, bool)> {
        match &self.touch.against {
            Profile::Chain(chain) => {
                Some((chain.corners.iter().map(|&s| self.place(there, s)).collect(), chain.closed))
            }
            _ => None,
        }
    }
}

impl There {
    pub fn at<'a>(&'a self, m: &'a Mechanism) -> StateView<'a> {
        StateView { m, n: &self.n, k: &self.k, q: &[], u: &[], t: 0.0, mode: &self.mode }
    }
    pub fn moving<'a>(&'a self, m: &'a Mechanism) -> MotionView<'a, f64> {
        MotionView { at: self.at(m), bodies: Some(&self.acceleration), accelerations: None }
    }
    /// The bodies a time later, with the present accelerations.
    pub fn later(&self, t: f64) -> There {
        let mut k = self.k.clone();
        for (i, a) in self.acceleration.iter().enumerate() {
            let v = self.k.twist[i];
            let moved = v * t + *a * (0.5 * t * t);
            k.pose[i] = Pose { at: k.pose[i].at + moved.v, turn: Turn::by(k.pose[i].turn.angle + moved.w) };
            k.arm[i] = k.pose[i].at;
        }
        There { n: self.n.clone(), k, acceleration: self.acceleration.clone(), mode: self.mode.clone() }
    }
}

fn slot(m: &mut Mechanism, x: f64) -> usize {
    m.values.push(ModelExpr::constant(x));
    m.values.len() - 1
}

fn site(m: &mut Mechanism, body: usize, at: Vec2) -> usize {
    let at = PointLocation::At([slot(m, at.x), slot(m, at.y)]);
    m.sites.push(Site { body, at });
    m.sites.len() - 1
}

/// A line, arcs to one side and to the other, and a line; the arcs are wider than any disk.
fn track(m: &mut Mechanism, body: usize, from: Vec2, rng: &mut Rng) -> Track {
    let (mut at, mut heading, mut last) = (from, rng.about(3.0), site(m, body, from));
    let mut stretches = vec![];
    for sweep in [0.0, rng.within(0.2, 1.5), -rng.within(0.2, 1.5), 0.0] {
        let along = turned(vec2(1.0, 0.0), heading);
        let centre = (sweep != 0.0).then(|| at + along.perp() * (rng.within(0.5, 1.0) * f64::signum(sweep)));
        at = match centre {
            Some(centre) => centre + turned(at - centre, sweep),
            None => at + along * rng.within(0.5, 1.0),
        };
        let next = site(m, body, at);
        stretches.push(Stretch { ends: [last, next], centre: centre.map(|centre| site(m, body, centre)) });
        (heading, last) = (heading + sweep, next);
    }
    Track { stretches }
}

/// Corners, clockwise: of a polygon, of a chain that turns by less than a right angle, and of one that turns further.
fn outline(word: &str, rng: &mut Rng) -> Vec<Vec2> {
    let sides = 1 + rng.below(4);
    match word {
        "polygon" => {
            let n = 3 + rng.below(4);
            let (size, start) = (rng.within(0.8, 1.6), rng.about(3.0));
            let corner = |i: usize| start - std::f64::consts::TAU * (i as f64 + 0.8 * rng.within(0.0, 1.0)) / n as f64;
            let angles: Vec<f64> = (0..n).map(corner).collect();
            angles.into_iter().map(|a| turned(vec2(size, 0.0), a)).collect()
        }
        _ => {
            let (sides, most) = if word == "bent" { (1 + sides, 2.6) } else { (sides, 1.5) };
            let (mut heading, mut corner) = (rng.about(3.0), vec2(0.0, 0.0));
            let mut corners = vec![corner];
            for _ in 0..sides {
                corner += turned(vec2(rng.within(0.5, 1.0), 0.0), heading);
                heading -= rng.within(0.5, 1.0) * most / sides as f64;
                corners.push(corner);
            }
            corners
        }
    }
}

pub fn every_scene(mut visit: impl FnMut(&Scene, &mut There, &mut Rng)) {
    for (seed, word) in (0..60).flat_map(|seed| SURFACES.map(|word| (seed, word))) {
        let scene = Scene::new(word, seed);
        let mut rng = Rng::new(1000 + seed);
        let mut there = scene.thrown(&mut rng);
        visit(&scene, &mut there, &mut rng);
    }
}
