//! The laws of contact on random touches, and closed forms.

use super::*;
use crate::solve::Matrix;

#[test]
fn block_on_floor() {
    let g = Matrix::from_fn(2, 2, |i, j| f64::from(i == j));
    let p = Problem { g: &g, free: &[-9.81, 2.0], grips: &[Grip::Resting { fixed: 0.3, kinetic: 0.2 }] };
    println!("{:?}", solve(&p));
    let p = Problem { g: &g, free: &[-9.81, 4.0], grips: &[Grip::Resting { fixed: 0.3, kinetic: 0.2 }] };
    println!("{:?}", solve(&p));
}
