//! Wheels that drive each other along a common tangent: gear pairs and belts.
//!
//! An involute gear pair is a crossed belt between the base circles: the teeth push along the
//! line of action, which touches both (Litvin & Fuentes, *Gear Geometry*, ch. 10). An open belt is the
//! same with the second radius counted negative. With b₁, b₂ the radii, b = b₁ + b₂, D the distance
//! of the centres, ψ the direction of the line of centres and s = ±1 the flank or strand:
//!
//! s(√(D² − b²) − b arccos(b/D)) + bψ − b₁θ₁ − b₂θ₂ = constant,
//!
//! the length of belt that has passed. It holds for moving centres too. Teeth push apart: a positive multiplier does
//! so on the flank s = +1, a negative one on s = −1 (inside a ring the other way round).

use super::*;
use std::f64::consts::TAU;

fn passed<S: Scalar>(r: &Relative<S>, b1: S, b2: S, side: S) -> S {
    let b = b1 + b2;
    side * strand(r.at().dot(r.at()), b) + b * r.y.atan2(r.x) - b2 * r.angle
}

/// What the strand gains by the distance of the centres, whose square is `d2`.
fn strand<S: Scalar>(d2: S, b: S) -> S {
    let free = (d2 - b * b).sqrt();
    free - b * free.atan2(b)
}

/// A gear pair. Numbers: pitch radii, pressure angle, 1 for an internal second wheel, flank (+1 or −1).
pub struct Gear;

impl Gear {
    /// Which of its numbers is the flank.
    pub const FLANK: usize = 4;

    /// +1, or −1 inside a ring.
    fn side<S: Scalar>(n: &Numbers<S>) -> S {
        S::one() - n.of[3].scale(2.0)
    }
    fn base<S: Scalar>(n: &Numbers<S>) -> (S, S) {
        let (_, cos) = n.of[2].sin_cos();
        (n.of[0] * cos, Self::side(n) * n.of[1] * cos)
    }
}

impl Joint for Gear {
    fn card(&self) -> Card {
        Card::new("gear", "Two wheels with involute teeth, without backlash.")
            .needs("of", FieldKind::Points, Role::Both, "m", "the centres of the wheels")
            .needs("radii", FieldKind::Numbers, Role::Number, "m", "the two pitch radii")
            .takes(
                "pressure_angle",
                FieldKind::Number,
                "rad",
                "pi/9",
                "angle of the line of action to the common tangent",
            )
            .takes("internal", FieldKind::Flag, "", "false", "whether the second wheel is a ring around the first")
            .takes(
                "flank",
                FieldKind::Number,
                "",
                "1",
                "+1 or -1: the side of the teeth that is tried first; the other carries where it would have to pull",
            )
            .row(RowCard {
                is_relative: true,
                ..RowCard::of(LoadCard { flank: true, ..LoadCard::force("tooth force", "F1", "F") })
            })
            .glyph("pitch_circles")
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (b1, b2) = Self::base(n);
        let flank = Self::side(n) * n.of[Self::FLANK];
        // At the distance of the pitch radii both flanks touch at once.
        let pitch = n.of[0] + Self::side(n) * n.of[1];
        Some(Rows3::of(&[passed(r, b1, b2, flank) - flank * strand(pitch * pitch, b1 + b2)]))
    }
    fn contact<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
        let (b1, b2) = Self::base(n);
        r.at() * (b1 / (b1 + b2))
    }
    fn period(&self, n: &Numbers<f64>, _: usize) -> f64 {
        let (b1, b2) = Self::base(n);
        TAU * (b1 + b2).abs()
    }
}

/// A belt or rope over two wheels, of which one strand is followed. Numbers: radii, 1 if crossed, strand (+1 or −1).
pub struct Belt;

impl Belt {
    fn radii<S: Scalar>(n: &Numbers<S>) -> (S, S) {
        let side = n.of[2].scale(2.0) - S::one();
        (n.of[0], side * n.of[1])
    }
}

impl Joint for Belt {
    fn card(&self) -> Card {
        Card::new(
            "belt",
            "A belt without slip over two wheels; its reaction is the pull of one strand over that of the other.",
        )
        .needs("of", FieldKind::Points, Role::Both, "m", "the centres of the wheels")
        .needs("radii", FieldKind::Numbers, Role::Number, "m", "the two radii")
        .takes("crossed", FieldKind::Flag, "", "false", "whether the strands cross")
        .takes("strand", FieldKind::Number, "", "1", "+1 or -1: the strand that carries")
        .row(RowCard { is_relative: true, beside: true, ..RowCard::of(LoadCard::force("strand force", "F1", "F")) })
        .glyph("belt")
    }
    fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let (b1, b2) = Self::radii(n);
        Some(Rows3::of(&[passed(r, b1, b2, n.of[3])]))
    }
    fn period(&self, n: &Numbers<f64>, _: usize) -> f64 {
        let (b1, b2) = Self::radii(n);
        TAU * (b1 + b2).abs()
    }
}
