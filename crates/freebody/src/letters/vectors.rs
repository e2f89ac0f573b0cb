//! Vectors told in named unit directions.

use crate::algebra::{Letter, Tree};
use crate::plane::Vec2;
use crate::scalar::{Scalar, Symbol};
use serde_json::{json, Value};

/// A vector as components along fixed axes, and along and across unit directions at angles to the x axis.
///
/// What turns with an angle A comes in pairs: c cos A of x with c sin A of y is c along A; −c sin A with c cos A is c
/// across it, a right angle on.
pub fn tell(v: Vec2<Symbol>) -> Value {
    let mut rest = v;
    let mut told = vec![];
    for angle in v.x.angles().into_iter().chain(v.y.angles()) {
        let (sin, cos) = angle.sin_cos();
        let [xc, xs] = rest.x.harmonic(angle);
        let [yc, ys] = rest.y.harmonic(angle);
        let (along, across) = (matching(xc, ys), matching(-xs, yc));
        if along.is_zero() && across.is_zero() {
            continue;
        }
        rest = rest - Vec2 { x: along * cos - across * sin, y: along * sin + across * cos };
        told.push(json!({"angle": tree(angle), "along": tree(along), "across": tree(across)}));
    }
    json!({"directions": told, "i": tree(rest.x), "j": tree(rest.y), "xy": [tree(v.x), tree(v.y)]})
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
pub fn tree_by(of: Symbol, unknowns: &[Letter]) -> Tree {
    of.tree_by(unknowns)
}
