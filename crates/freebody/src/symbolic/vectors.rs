//! Vectors expressed in named unit directions.

use crate::algebra::{Symbol, Tree, Variable};
use crate::plane::Vec2;
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// A vector as components along fixed axes, and along and across unit directions at angles to the x axis.
///
/// What turns with an angle A comes in pairs: c cos A of x with c sin A of y is c along A; −c sin A with c cos A is c
/// across it, a right angle on. Of A and −A, which have the same cosine, the one comes first in which `coordinates`
/// grow.
pub fn presented(v: Vec2<Symbol>, coordinates: &[Variable]) -> Value {
    let mut rest = v;
    let mut entries = vec![];
    let mut angles: Vec<Symbol> = v.x.angles();
    for angle in v.y.angles() {
        if !angles.contains(&angle) {
            angles.push(angle);
        }
    }
    for angle in angles.into_iter().flat_map(|angle| both_ways(angle, coordinates)) {
        let (along, across) = components(rest, angle);
        if along.is_zero() && across.is_zero() {
            continue;
        }
        let (sin, cos) = angle.sin_cos();
        rest -= Vec2 { x: along * cos - across * sin, y: along * sin + across * cos };
        entries.push(json!({"angle": tree(angle), "along": tree(along), "across": tree(across)}));
    }
    json!({"directions": entries, "i": tree(rest.x), "j": tree(rest.y), "xy": [tree(v.x), tree(v.y)]})
}

/// An angle and its opposite, first the one that grows with the first coordinate in it.
fn both_ways(angle: Symbol, coordinates: &[Variable]) -> [Symbol; 2] {
    let grows = |variable: &Variable| angle.coefficient_of(variable).filter(|c| !c.is_zero()).map(|c| c.value() > 0.0);
    match coordinates.iter().find_map(grows) {
        Some(false) => [-angle, angle],
        _ => [angle, -angle],
    }
}

/// What of a vector turns with an angle: along it and across it.
fn components(v: Vec2<Symbol>, angle: Symbol) -> (Symbol, Symbol) {
    let (sin, _) = angle.sin_cos();
    // The canonical form tells an angle or its opposite; the sine says which.
    let [_, own] = sin.harmonic(angle);
    let (of, sign) = if own.is_zero() { (-angle, -Symbol::one()) } else { (angle, Symbol::one()) };
    let [xc, xs] = v.x.harmonic(of);
    let [yc, ys] = v.y.harmonic(of);
    (matching(xc, ys * sign), matching(-xs * sign, yc))
}

/// A coefficient that both components have, or none.
fn matching(a: Symbol, b: Symbol) -> Symbol {
    if (a - b).is_zero() {
        a
    } else {
        Symbol::zero()
    }
}

/// An expression for the reader.
pub fn tree(of: Symbol) -> Tree {
    of.tree()
}

/// An expression for the reader, ordered by unknowns.
pub fn tree_by(of: Symbol, unknowns: &[Variable]) -> Tree {
    of.tree_by(unknowns)
}

/// An expression as coefficients of unknowns in which it is linear, and the rest.
pub(super) fn linear_in(of: Symbol, unknowns: &[Variable]) -> Value {
    let (factors, rest) = of.linear_in(unknowns);
    let found = unknowns.iter().zip(factors).filter(|(_, factor)| !factor.is_zero());
    let entries = |(l, c): (&Variable, Symbol)| json!({"symbol": Tree::variable(&l.name, l.dots), "tree": tree(c)});
    let coefficients: Vec<Value> = found.map(entries).collect();
    json!({"coefficients": coefficients, "rest": tree(rest)})
}
