//! Mechanisms thrown together: bodies are thrown on the plane, and joints are put where they happen to fit. Every joint
//! holds at the pose thrown, so loops are closed by construction, whichever joints the compiler takes for its tree.

use crate::model::*;
use crate::rng::Rng;
use freebody::bound_values::BoundValues as Bound;
use freebody::joints::{Card, Curve, FieldKind, Joint, Kind, Numbers, Relative, Role};
use freebody::mechanism::Mechanism;
use freebody::plane::{vec2, Vec2};
use freebody::scalar::{Dual, Scalar};
use freebody::spec::*;
use std::collections::{BTreeMap, HashMap};

/// A curve that is nowhere straight: (s, bend s² + sin(s)/3), from an origin.
#[derive(Clone, Copy)]
pub struct Wave {
    pub from: [f64; 2],
    pub bend: f64,
}

impl<S: Scalar> Curve<S> for Wave {
    fn at(&self, s: S) -> (Vec2<S>, Vec2<S>) {
        let (sin, cos) = s.sin_cos();
        let y = (s * s).scale(self.bend) + sin.scale(1.0 / 3.0);
        let slope = s.scale(2.0 * self.bend) + cos.scale(1.0 / 3.0);
        (vec2(S::of(self.from[0]) + s, S::of(self.from[1]) + y), vec2(S::one(), slope))
    }
}

impl Wave {
    pub fn thrown(rng: &mut Rng) -> Self {
        Wave { from: [0.0, 0.0], bend: rng.within(0.2, 0.6) }
    }
    pub fn written(&self) -> [String; 2] {
        let [x, y] = self.from;
        [format!("({x:?}) + s"), format!("({y:?}) + {:?}*s^2 + sin(s)/3", self.bend)]
    }
}

/// The numbers of a joint, drawn for the fields of its card. Each length is well below the one before, so that wheels
/// fit in and beside each other.
pub fn numbers_for(card: &Card, rng: &mut Rng) -> Vec<f64> {
    let mut largest = 1.5;
    let mut length = |rng: &mut Rng| {
        let drawn = rng.within(0.6, 1.0) * largest;
        largest = 0.5 * drawn;
        drawn
    };
    let mut numbers = vec![];
    for field in &card.fields {
        match (field.role, field.kind) {
            (Role::Number, FieldKind::Numbers) => numbers.extend([length(rng), length(rng)]),
            (Role::Number, FieldKind::Flag) => numbers.push(f64::from(u8::from(rng.chance(0.5)))),
            (Role::Number, _) => numbers.push(match field.dimension {
                Some("m") => length(rng),
                Some("rad") => rng.within(0.2, 0.6),
                _ => rng.sign(),
            }),
            (_, FieldKind::Circle) => numbers.push(length(rng)),
            (Role::Second, FieldKind::Points) => numbers.push(length(rng)),
            _ => {}
        }
    }
    numbers
}

/// Coordinates in the order of a card, angles within half a turn, distances from a pole and free lengths away from 0.
pub fn coordinates_for(card: &Card, rng: &mut Rng) -> Vec<f64> {
    card.coordinates
        .iter()
        .map(|c| match (c.dimension, c.name) {
            ("rad", _) => rng.about(3.0),
            (_, "r" | "length") => rng.within(0.5, 1.5),
            _ => rng.about(1.5),
        })
        .collect()
}

/// Whether a joint can be of the tree.
pub fn has_pose(kind: Kind) -> bool {
    let card = kind.card();
    card.coordinates.len() + card.rows.len() == 3
}

/// Whether what a joint does still makes sense for a body that does not turn.
pub fn suits_particle(kind: Kind) -> bool {
    let card = kind.card();
    card.coordinates.iter().any(|c| c.turn) || card.rows.iter().any(|r| r.load.couple)
}

/// A mechanism at the pose at which it was thrown together.
#[derive(Clone, Default)]
pub struct Thrown {
    pub model: Model,
    /// Frames of all bodies: x, y, angle.
    pub pose: BTreeMap<String, [f64; 3]>,
    /// Of each joint, its own coordinates in the order of its card.
    pub readings: HashMap<String, Vec<f64>>,
    pub particles: Vec<String>,
    points: usize,
}

impl Thrown {
    pub fn new(gravity: [f64; 2]) -> Self {
        let mut thrown = Thrown { model: Model::new().gravity(gravity[0], gravity[1]), ..Default::default() };
        thrown.pose.insert("ground".into(), [0.0; 3]);
        thrown
    }

    /// Throws a body; its mass is an expression or a literal.
    pub fn throw(&mut self, name: &str, mass: Number, inertia: Number, centre: [f64; 2], pose: [f64; 3]) {
        self.model = std::mem::take(&mut self.model).heavy(name, false, mass, inertia, centre);
        self.pose.insert(name.into(), pose);
    }

    pub fn throw_particle(&mut self, name: &str, mass: Number, at: [f64; 2]) {
        self.model = std::mem::take(&mut self.model).heavy(name, true, mass, literal(0.0), [0.0, 0.0]);
        self.pose.insert(name.into(), [at[0], at[1], 0.0]);
        self.particles.push(name.into());
    }

    pub fn is_particle(&self, body: &str) -> bool {
        self.particles.iter().any(|p| p == body)
    }

    /// A point of a body, given in the body's frame.
    pub fn point(&mut self, body: &str, local: Vec2) -> String {
        self.points += 1;
        let name = format!("{body}.p{}", self.points);
        self.model = std::mem::take(&mut self.model).point(&name, [local.x, local.y]);
        name
    }

    /// A point somewhere on a body; a particle has only one.
    pub fn some_point(&mut self, body: &str, rng: &mut Rng) -> String {
        let reach = if self.is_particle(body) { 0.0 } else { 1.0 };
        let local = vec2(rng.about(1.0) * reach, rng.about(1.0) * reach);
        self.point(body, local)
    }

    pub fn frame(&self, body: &str) -> freebody::plane::Pose {
        pose(self.pose[body])
    }

    /// Joins two bodies where they are; `named` are names of coordinates, with conventions drawn at random if `odd`.
    pub fn join(&mut self, rng: &mut Rng, name: &str, kind: Kind, ends: [&str; 2], named: bool, odd: bool) {
        let card = kind.card();
        let [a, b] = ends;
        let [theta_a, theta_b] = [self.pose[a][2], self.pose[b][2]];
        let of_kind = |role: Role| card.fields.iter().find(|f| f.role == role).map(|f| f.kind);
        let mut numbers = numbers_for(&card, rng);
        let mut q = coordinates_for(&card, rng);
        let mut wave = Wave::thrown(rng);

        // The turn of the second marker against the first must be what the joint says.
        let relative = |numbers: &[f64], q: &[f64]| kind.pose(&Numbers { of: numbers, curve: Some(&wave) }, q);
        let first_turns = of_kind(Role::First) == Some(FieldKind::Line);
        let second_turns = matches!(of_kind(Role::Second), Some(FieldKind::Line | FieldKind::Points));
        let mut alpha = if first_turns { rng.about(3.0) } else { 0.0 };
        let mut beta = if second_turns { rng.about(3.0) } else { 0.0 };
        if let Some(there) = relative(&numbers, &q) {
            let missing = theta_b + beta - theta_a - alpha - there.angle;
            if first_turns {
                alpha += missing;
            } else if second_turns {
                beta -= missing;
            } else {
                turn_by(kind, &mut numbers, &mut q, &wave, missing);
            }
        }
        let there = relative(&numbers, &q).unwrap_or_else(|| far_away(rng));

        // One of the two markers is put where the other asks for it.
        let axes = pose([0.0, 0.0, theta_a + alpha]).turn;
        let local = if self.is_particle(a) { vec2(0.0, 0.0) } else { vec2(rng.about(1.0), rng.about(1.0)) };
        let mut first = self.frame(a).place(local);
        let mut second = first + axes.apply(there.at());
        if self.is_particle(b) {
            assert!(!self.is_particle(a), "no joint between two particles is thrown");
            second = self.frame(b).at;
            first = second - axes.apply(there.at());
        }
        let own = |body: &str, place: Vec2| self.frame(body).turn.undo(place - self.frame(body).at);
        let (first, second) = (own(a, first), own(b, second));
        wave.from = [first.x, first.y];

        let mut left = numbers.into_iter();
        let mut fields = vec![];
        for field in &card.fields {
            let mut number = || left.next().expect("numbers were drawn for the card");
            let given = match (field.role, field.kind) {
                (Role::Number, FieldKind::Numbers) => Value::List(vec![value(number()), value(number())]),
                (Role::Number, FieldKind::Flag) => Value::Flag(number() == 1.0),
                (Role::Number, _) => value(number()),
                (Role::First, FieldKind::Point) => text(self.point(a, first)),
                (Role::First, FieldKind::Line) => line(&self.point(a, first), alpha),
                (Role::First, FieldKind::Circle) => circle(&self.point(a, first), number()),
                (Role::First, FieldKind::Curve) => {
                    let curve = format!("{a}.{name}");
                    let [x, y] = wave.written();
                    self.model = std::mem::take(&mut self.model).curve(&curve, &x, &y);
                    text(curve)
                }
                (Role::Second, FieldKind::Point) => text(self.point(b, second)),
                (Role::Second, FieldKind::Line) => line(&self.point(b, second), beta),
                (Role::Second, FieldKind::Circle) => circle(&self.point(b, second), number()),
                (Role::Second, FieldKind::Points) => {
                    let other = second + turned(vec2(number(), 0.0), beta);
                    points(&[&self.point(b, second), &self.point(b, other)])
                }
                (Role::Both, FieldKind::Points) => points(&[&self.point(a, first), &self.point(b, second)]),
                other => panic!("a joint with a field that is new to this test: {other:?}"),
            };
            fields.push((field.name, given));
        }
        let with_turn = !(self.is_particle(a) || self.is_particle(b));
        let shown: Vec<_> = card.coordinates.iter().filter(|c| with_turn || !c.turn).collect();
        let coordinates = if named { shown.len() } else { 0 };
        let coordinates = (0..coordinates)
            .map(|k| Coordinate {
                name: format!("{name}_{k}"),
                zero: literal(if odd { rng.about(1.0) } else { 0.0 }),
                sense: if odd && rng.chance(0.5) { -1 } else { 1 },
                absolute: odd && shown[k].dimension == "rad" && rng.chance(0.3),
            })
            .collect();
        self.readings.insert(name.into(), q);
        self.model.0.joints.push(element(name, card.word, &fields, coordinates));
    }

    /// The coordinates of the compiled tree at the pose thrown.
    pub fn coordinates(&self, m: &Mechanism, n: &Bound) -> Vec<f64> {
        let one = |&(j, k): &(usize, usize)| {
            let joint = &m.joints[j];
            let c = &joint.coordinates[k];
            let own = self.readings[&joint.name][c.card];
            let base = self.pose[&m.bodies[m.ends(joint)[0]].name][2] + n.values[joint.first.angle];
            let reading = if c.absolute { own + base } else { own };
            (reading - n.values[c.zero]) * c.sense
        };
        m.coordinates.iter().map(one).collect()
    }
}

/// Turns the second marker further by `missing`: along the first coordinate that turns it, or by the joint's own number.
fn turn_by(kind: Kind, numbers: &mut [f64], q: &mut [f64], wave: &Wave, missing: f64) {
    let constants: Vec<Dual<3, f64>> = numbers.iter().map(|&x| Dual::constant(x)).collect();
    let there = kind.pose_gradient(&Numbers { of: &constants, curve: Some(wave) }, q).expect("a joint with a pose");
    let slopes = there.angle.du;
    match (0..q.len()).find(|&k| slopes[k] != 0.0) {
        Some(k) => q[k] += missing / slopes[k],
        None => numbers[0] += missing,
    }
}

/// Two wheels well apart.
fn far_away(rng: &mut Rng) -> Relative<f64> {
    let (direction, distance) = (rng.about(3.0), rng.within(3.0, 4.0));
    let at = turned(vec2(distance, 0.0), direction);
    Relative { x: at.x, y: at.y, angle: rng.about(3.0) }
}
