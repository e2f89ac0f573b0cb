//! The mechanism by which speed is measured against a plain sweep; see `benchmarks/`.

use crate::spec::{Body, Element, MassElement, Number, Point, Spec, Value};
use std::collections::BTreeMap;

/// A chain of `n` uniform bars, 1 m and 1 kg each, hinged in series to ground.
pub fn chain_model(n: usize) -> Spec {
    let number = Number::Literal;
    let mut spec = Spec { gravity: Some([number(0.0), number(-9.81)]), ..Spec::default() };
    for i in 0..n {
        let name = format!("bar{i}");
        let piece = MassElement {
            shape: "rod".into(),
            mass: number(1.0),
            at: [number(0.0), number(0.0)],
            angle: number(0.0),
            inertia: None,
            sizes: BTreeMap::from([("length".into(), number(1.0))]),
            corners: vec![],
        };
        let point = |end: &str, x: f64| Point {
            name: format!("{name}.{end}"),
            body: name.clone(),
            at: [number(x), number(0.0)],
        };
        spec.points.extend([point("start", -0.5), point("end", 0.5)]);
        spec.bodies.push(Body { name: name.clone(), particle: false, pieces: vec![piece] });
        let before = if i == 0 { "ground.O".to_string() } else { format!("bar{}.end", i - 1) };
        let word = |text: String| Value::Number(Number::Expression(text));
        let of = Value::List(vec![word(before), word(format!("{name}.start"))]);
        spec.joints.push(Element {
            name: format!("pin{i}"),
            kind: "hinge".into(),
            fields: BTreeMap::from([("of".into(), of)]),
            coordinates: vec![],
            engaged: true,
            friction: None,
        });
    }
    spec
}
