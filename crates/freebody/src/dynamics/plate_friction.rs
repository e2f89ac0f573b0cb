//! Coulomb friction of an area that slides on a table, evenly pressed, or of its rim.
//!
//! With V = v + ω k × r the velocity at r from the centre of the area A, an even pressure rubs with F = −∫ V/|V| dA and the couple
//! M = −∫ r × V/|V| dA, the slopes of the power −∫ |V| dA by v and ω (Goyal, Ruina & Papadopoulos, *Wear* 143, 1991). About the
//! instantaneous centre |V| is ω times the distance, and Gauss's theorem makes integrals along the boundary of these:
//!
//! ω F = −∮ |V| dr,  ω² M = −∮ |V| (ω r × dr − 2 v·dr)/3.
//!
//! What is even in |V| does nothing along a closed line. Taken out, with the mean speed U, v² + ω² R² = U², R the area's radius of
//! gyration, it leaves integrals without ω below them, good from pure slide to pure turn.

use crate::kinematics::{State, StateView};
use crate::mechanism::{PlateFriction, PlateOutline};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::Scalar;
use std::f64::consts::FRAC_PI_4;

/// Abscissae and weights of Gauss's rule with 16 points on [−1, 1], of one side.
const GAUSS: [[f64; 2]; 8] = [
    [0.09501250983763744, 0.1894506104550685],
    [0.2816035507792589, 0.18260341504492358],
    [0.45801677765722737, 0.16915651939500254],
    [0.6178762444026438, 0.14959598881657674],
    [0.755404408355003, 0.12462897125553388],
    [0.8656312023878318, 0.09515851168249279],
    [0.9445750230732326, 0.062253523938647894],
    [0.9894009349916499, 0.027152459411754096],
];
/// How often a piece of the boundary at the instantaneous centre is halved; what is left of it then is below round-off.
const MOST_HALVINGS: usize = 52;

/// A piece of a boundary, in the axes of its body.
#[derive(Clone, Copy)]
enum Piece<S> {
    /// From one corner to the next, as its parameter goes from 0 to 1.
    Side(Vec2<S>, Vec2<S>),
    /// An eighth of a circle, by centre and radius; its parameter is the angle, from this one.
    Arc(Vec2<S>, S, f64),
}

impl<S: Scalar> Piece<S> {
    fn range(self) -> [f64; 2] {
        match self {
            Piece::Side(..) => [0.0, 1.0],
            Piece::Arc(_, _, from) => [from, from + FRAC_PI_4],
        }
    }

    /// Place and slope.
    fn at(self, x: f64) -> (Vec2<S>, Vec2<S>) {
        match self {
            Piece::Side(from, to) => (from + (to - from) * S::of(x), to - from),
            Piece::Arc(centre, radius, _) => {
                let (sin, cos) = S::of(x).sin_cos();
                let arm = vec2(cos, sin) * radius;
                (centre + arm, arm.perp())
            }
        }
    }

    /// The integral of `f(r, dr)` over a part of the piece, which is halved until it is shorter than its distance from the centre
    /// of a `motion`: there what depends on the distance is as smooth as Gauss's rule asks for.
    fn integral<const N: usize>(
        self,
        [from, to]: [f64; 2],
        halvings: usize,
        motion: Twist,
        f: &impl Fn(Vec2<S>, Vec2<S>) -> [S; N],
        sum: &mut [S; N],
    ) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (place, slope) = self.at(middle);
        if motion.at(place.value()).norm() < motion.w.abs() * slope.value().norm() * 2.0 * half {
            if halvings < MOST_HALVINGS {
                self.integral([from, middle], halvings + 1, motion, f, sum);
                self.integral([middle, to], halvings + 1, motion, f, sum);
            }
            return;
        }
        for [x, weight] in GAUSS.into_iter().flat_map(|[x, weight]| [[x, weight], [-x, weight]]) {
            let (place, slope) = self.at(middle + half * x);
            let terms = f(place, slope * S::of(weight * half));
            sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
    }
}

/// The integral of `f(r, dr)` along a boundary, which may depend on the speed at r of a `motion`.
fn around<S: Scalar, const N: usize>(
    boundary: &[Piece<S>],
    motion: Twist,
    f: impl Fn(Vec2<S>, Vec2<S>) -> [S; N],
) -> [S; N] {
    let mut sum = [S::zero(); N];
    boundary.iter().for_each(|piece| piece.integral(piece.range(), 0, motion, &f, &mut sum));
    sum
}

/// The friction of a plate on its body, at the body's joint origin, fixed axes.
pub fn plate_friction<S: Scalar>(at: StateView<'_, S>, plate: &PlateFriction) -> Wrench<S> {
    let (turn, twist) = (at.k.pose[plate.body].turn, at.k.twist[plate.body]);
    let motion = Twist { v: turn.undo(twist.v), w: twist.w };
    let boundary = boundary(at, &plate.outline);
    let unit = if plate.rim { of_rim(&boundary, motion) } else { of_area(&boundary, motion) };
    let most = plate.most.eval(&State(at));
    Wrench { f: turn.apply(unit.f), m: unit.m } * -most
}

fn boundary<S: Scalar>(at: StateView<'_, S>, outline: &PlateOutline) -> Vec<Piece<S>> {
    match outline {
        PlateOutline::Polygon(sites) => {
            let corner = |i: usize| at.n.arms[sites[i % sites.len()]];
            (0..sites.len()).map(|i| Piece::Side(corner(i), corner(i + 1))).collect()
        }
        PlateOutline::Disk(centre, radius) => {
            let radius = radius.eval(&State(at));
            (0..8).map(|i| Piece::Arc(at.n.arms[*centre], radius, f64::from(i) * FRAC_PI_4)).collect()
        }
    }
}

const AT_REST: Twist = Twist { v: Vec2 { x: 0.0, y: 0.0 }, w: 0.0 };

/// The mean of V/|V| over an area, as a wrench at the origin.
fn of_area<S: Scalar>(boundary: &[Piece<S>], motion: Twist<S>) -> Wrench<S> {
    let [area, x, y] = around(boundary, AT_REST, |r, dr| {
        let swept = r.cross(dr);
        [swept.scale(0.5), swept * r.x.scale(1.0 / 3.0), swept * r.y.scale(1.0 / 3.0)]
    });
    let centre = vec2(x / area, y / area);
    let [gyration] = around(boundary, AT_REST, |p, dr| {
        let r = p - centre;
        [r.cross(dr) * r.dot(r).scale(0.25) / area]
    });
    let (v, w) = (motion.at(centre), motion.w);
    let mean = (v.dot(v) + w * w * gyration).sqrt();
    let values = Twist { v: motion.v.value(), w: w.value() };
    let [fx, fy, couple] = around(boundary, values, |p, dr| {
        let r = p - centre;
        let (across, speeds) = (v.dot(r.perp()), (v + r.perp() * w).norm() + mean);
        let beyond = r.dot(r) - gyration;
        // |V| = U + ω s, and s = v·(k × r)/U + ω b.
        let s = (across.scale(2.0) + w * beyond) / speeds;
        let b = (beyond - across * s / mean) / speeds;
        [dr.x * s, dr.y * s, (r.cross(dr) * s - v.dot(dr).scale(2.0) * b).scale(1.0 / 3.0)]
    });
    let f = vec2(fx / area, fy / area);
    Wrench { f, m: couple / area + (w * gyration / mean).scale(2.0 / 3.0) + centre.cross(f) }
}

/// The mean of V/|V| along a rim, as a wrench at the origin.
fn of_rim<S: Scalar>(rim: &[Piece<S>], motion: Twist<S>) -> Wrench<S> {
    let values = Twist { v: motion.v.value(), w: motion.w.value() };
    let [length, fx, fy, couple] = around(rim, values, |r, dr| {
        let (velocity, ds) = (motion.at(r), dr.norm());
        let along = velocity * (ds / velocity.norm());
        [ds, along.x, along.y, r.cross(along)]
    });
    Wrench { f: vec2(fx / length, fy / length), m: couple / length }
}
