//! Models as data, written short.

use freebody::compile::Compiled;
use freebody::mechanism::Mechanism;
use freebody::plane::{vec2, Pose, Turn, Vec2};
use freebody::spec::*;

pub fn literal(x: f64) -> Number {
    Number::Literal(x)
}

pub fn written(text: impl Into<String>) -> Number {
    Number::Expression(text.into())
}

pub fn text(text: impl Into<String>) -> Value {
    Value::Number(written(text))
}

pub fn value(x: f64) -> Value {
    Value::Number(literal(x))
}

pub fn points(names: &[&str]) -> Value {
    Value::List(names.iter().map(|n| text(*n)).collect())
}

pub fn circle(centre: &str, radius: f64) -> Value {
    Value::Circle { centre: centre.into(), radius: literal(radius) }
}

pub fn line(point: &str, angle: f64) -> Value {
    Value::Line(place(point, angle))
}

pub fn place(point: &str, angle: f64) -> Place {
    Place { point: point.into(), angle: Some(literal(angle)), towards: None }
}

pub fn at(xy: [f64; 2]) -> [Number; 2] {
    xy.map(literal)
}

pub fn coordinate(name: &str) -> Coordinate {
    Coordinate { name: name.into(), zero: literal(0.0), sense: 1, absolute: false }
}

/// A pose given by place and angle.
pub fn pose([x, y, angle]: [f64; 3]) -> Pose {
    Pose { at: vec2(x, y), turn: Turn::by(angle) }
}

/// A model being written.
#[derive(Clone, Default)]
pub struct Model(pub Spec);

impl Model {
    pub fn new() -> Self {
        Model(Spec::default())
    }
    pub fn gravity(mut self, x: f64, y: f64) -> Self {
        self.0.gravity = Some(at([x, y]));
        self
    }
    pub fn parameter(mut self, name: &str, x: f64) -> Self {
        self.0.parameters.push(Parameter { name: name.into(), value: literal(x), unit: String::new() });
        self
    }
    /// A rigid body with its mass centre and the inertia about it.
    pub fn body(self, name: &str, mass: f64, inertia: f64, centre: [f64; 2]) -> Self {
        self.heavy(name, false, literal(mass), literal(inertia), centre)
    }
    pub fn particle(self, name: &str, mass: f64) -> Self {
        self.heavy(name, true, literal(mass), literal(0.0), [0.0, 0.0])
    }
    pub fn heavy(mut self, name: &str, particle: bool, mass: Number, inertia: Number, centre: [f64; 2]) -> Self {
        let piece = MassElement {
            shape: "given".into(),
            mass,
            at: at(centre),
            angle: literal(0.0),
            inertia: Some(inertia),
            sizes: Default::default(),
            corners: vec![],
        };
        self.0.bodies.push(Body { name: name.into(), particle, pieces: vec![piece] });
        self
    }
    /// A point, named `body.point`.
    pub fn point(mut self, name: &str, xy: [f64; 2]) -> Self {
        let body = name.split('.').next().expect("a point is named after its body").to_string();
        self.0.points.push(Point { name: name.into(), body, at: at(xy) });
        self
    }
    pub fn curve(mut self, name: &str, x: &str, y: &str) -> Self {
        let body = name.split('.').next().expect("a curve is named after its body").to_string();
        self.0.curves.push(Curve { name: name.into(), body, x: x.into(), y: y.into() });
        self
    }
    pub fn joint(mut self, name: &str, kind: &str, fields: &[(&str, Value)], coordinates: &[&str]) -> Self {
        self.0.joints.push(element(name, kind, fields, coordinates.iter().map(|c| coordinate(c)).collect()));
        self
    }
    pub fn force(mut self, name: &str, kind: &str, fields: &[(&str, Value)]) -> Self {
        self.0.forces.push(element(name, kind, fields, vec![]));
        self
    }
    pub fn motion(mut self, name: &str, of: &str, law: &str, level: &str, by: Option<&str>) -> Self {
        let by = by.map(str::to_string);
        self.0.motions.push(Motion {
            name: name.into(),
            of: of.into(),
            law: law.into(),
            level: level.into(),
            by,
            engaged: true,
        });
        self
    }
    pub fn compile(&self) -> Compiled {
        Compiled::new(&self.0).unwrap_or_else(|e| panic!("{e}\n{:#?}", self.0))
    }
}

pub fn element(name: &str, kind: &str, fields: &[(&str, Value)], coordinates: Vec<Coordinate>) -> Element {
    let fields = fields.iter().map(|(word, value)| (word.to_string(), value.clone())).collect();
    Element { name: name.into(), kind: kind.into(), fields, coordinates, engaged: true, friction: None }
}

pub fn joint_named(m: &Mechanism, name: &str) -> usize {
    m.joints.iter().position(|j| j.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

pub fn body_named(m: &Mechanism, name: &str) -> usize {
    m.bodies.iter().position(|b| b.name == name).unwrap_or_else(|| panic!("no body {name}"))
}

/// Index in `q` of a coordinate.
pub fn index_of(m: &Mechanism, coordinate: &str) -> usize {
    let found = (0..m.freedom()).find(|&i| m.coordinate(i).name == coordinate);
    found.unwrap_or_else(|| panic!("no coordinate {coordinate} in the tree"))
}

/// The largest difference of two lists, relative to the largest entry of either (but not less than `least`).
pub fn apart(a: &[f64], b: &[f64], least: f64) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = a.iter().chain(b).fold(least, |m, x| m.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| if a.is_finite() { (a - b).abs() } else { f64::INFINITY }).fold(0.0, f64::max) / size
}

pub fn turned(v: Vec2, angle: f64) -> Vec2 {
    Turn::by(angle).apply(v)
}
