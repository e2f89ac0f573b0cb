//! The joints. One is a card (what a person writes and reads), a `pose` (how it moves as a joint of
//! the tree), a `residual` (the same joint expressed as a constraint) and a `measure` (its coordinates,
//! read off the bodies). Everything else (Jacobians, bias terms, reactions) follows.
//!
//! To add a joint: write its file, and add one line to the list below.

mod cam;
mod card;
mod free;
mod gear;
mod hinge;
mod link;
mod parallel;
mod rolling;
mod skate;
mod slider;
mod slot;
mod weld;
mod wound_string;

pub use card::{Card, CoordinateCard, Field, FieldKind, LoadCard, Role, RowCard};
pub use gear::Gear;

use crate::plane::{vec2, Rows3, Turn, Vec2};
use crate::scalar::{Dual, Scalar};

/// Where the second body's marker is, as seen from the first body's marker.
#[derive(Clone, Copy, Debug)]
pub struct Relative<S> {
    /// Along the first marker's x axis, m.
    pub x: S,
    /// Along the first marker's y axis, m.
    pub y: S,
    /// Turn of the second marker's axes against the first's, rad.
    pub angle: S,
}

impl<S: Scalar> Relative<S> {
    /// The first marker as seen from the second.
    pub fn inverse(&self) -> Self {
        let back = Turn::by(-self.angle);
        let at = -back.apply(vec2(self.x, self.y));
        Relative { x: at.x, y: at.y, angle: -self.angle }
    }
    /// The place of the second marker.
    pub fn at(&self) -> Vec2<S> {
        vec2(self.x, self.y)
    }
}

/// The numbers of one joint, and its curve if it has one.
pub struct Numbers<'a, S> {
    /// Numbers in the order in which the card's fields give them.
    pub of: &'a [S],
    /// The curve, as a function of its parameter.
    pub curve: Option<&'a dyn Curve<S>>,
}

/// A curve fixed in the first body, in that body's marker axes.
pub trait Curve<S> {
    /// The point of the curve at parameter `s`, with its derivative by `s`.
    fn at(&self, s: S) -> (Vec2<S>, Vec2<S>);
}

/// The contract of a joint.
///
/// All functions speak of the second body's marker as seen from the first body's marker. Laws,
/// checked for every joint of the list:
/// - `residual(pose(q))` = 0 for every q;
/// - `measure(pose(q))` = q (angles modulo a turn);
/// - freedom of `pose` + rows of `residual` = 3;
/// - a joint with a `rate_row` has neither, and this one row.
pub trait Joint {
    /// Names, fields, coordinates, rows.
    fn card(&self) -> Card;
    /// The relative place at joint coordinates `q`; None when it can only close loops.
    fn pose<S: Scalar>(&self, _n: &Numbers<S>, _q: &[S]) -> Option<Relative<S>> {
        None
    }
    /// Which of x, y and the angle stay 0, where these are the rows that vanish on the joint.
    fn held(&self) -> Option<&'static [usize]> {
        None
    }
    /// The rows that vanish on the joint; None when it can only be a joint of the tree.
    #[inline]
    fn residual<S: Scalar>(&self, _n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
        let held = self.held()?;
        let parts: [S; 3] = std::array::from_fn(|i| held.get(i).map_or(S::zero(), |&part| [r.x, r.y, r.angle][part]));
        Some(Rows3::of(&parts[..held.len()]))
    }
    /// The coefficients of (ẋ, ẏ, rate of the angle) whose sum vanishes, of a row that no residual has for its rate (a
    /// non-holonomic constraint, in Pfaff's form).
    fn rate_row<S: Scalar>(&self, _n: &Numbers<S>, _r: &Relative<S>) -> Option<[S; 3]> {
        None
    }
    /// The coordinates, read off the relative place; None where that has no formula.
    fn measure<S: Scalar>(&self, _n: &Numbers<S>, _r: &Relative<S>) -> Option<Rows3<S>> {
        None
    }
    /// Whether `measure` gives coordinate `k` without its sign, as a distance; `pose` takes either sign.
    fn unsigned(&self, _k: usize) -> bool {
        false
    }
    /// Where the reaction acts, in the first marker's axes; the second marker by default.
    fn contact<S: Scalar>(&self, _n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
        r.at()
    }
    /// Period of the row `i`, which is an angle times a length, when its angles may have wound; 0 for none.
    fn period(&self, _n: &Numbers<f64>, _row: usize) -> f64 {
        0.0
    }
}

macro_rules! list {
    ($($module:ident :: $Joint:ident),* $(,)?) => {
        /// A joint of the list.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs)]
        pub enum Kind { $($Joint),* }

        impl Kind {
            /// Every joint there is.
            pub const ALL: &'static [Kind] = &[$(Kind::$Joint),*];
        }

        impl Joint for Kind {
            fn card(&self) -> Card {
                match self { $(Kind::$Joint => $module::$Joint.card()),* }
            }
            #[inline]
            fn pose<S: Scalar>(&self, n: &Numbers<S>, q: &[S]) -> Option<Relative<S>> {
                match self { $(Kind::$Joint => $module::$Joint.pose(n, q)),* }
            }
            #[inline]
            fn held(&self) -> Option<&'static [usize]> {
                match self { $(Kind::$Joint => $module::$Joint.held()),* }
            }
            #[inline]
            fn residual<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
                match self { $(Kind::$Joint => $module::$Joint.residual(n, r)),* }
            }
            #[inline]
            fn rate_row<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<[S; 3]> {
                match self { $(Kind::$Joint => $module::$Joint.rate_row(n, r)),* }
            }
            #[inline]
            fn measure<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Option<Rows3<S>> {
                match self { $(Kind::$Joint => $module::$Joint.measure(n, r)),* }
            }
            fn unsigned(&self, k: usize) -> bool {
                match self { $(Kind::$Joint => $module::$Joint.unsigned(k)),* }
            }
            fn contact<S: Scalar>(&self, n: &Numbers<S>, r: &Relative<S>) -> Vec2<S> {
                match self { $(Kind::$Joint => $module::$Joint.contact(n, r)),* }
            }
            fn period(&self, n: &Numbers<f64>, row: usize) -> f64 {
                match self { $(Kind::$Joint => $module::$Joint.period(n, row)),* }
            }
        }
    };
}

list! {
    hinge::Hinge,
    weld::Weld,
    slider::Slider,
    slider::Rollers,
    slot::Slot,
    cam::CurvedSlot,
    cam::Cam,
    cam::OneSidedCam,
    link::Link,
    parallel::Parallel,
    rolling::Rolling,
    rolling::RollingCircles,
    gear::Gear,
    gear::Belt,
    wound_string::WoundString,
    skate::Skate,
    free::Free,
    free::Polar,
}

impl Kind {
    /// The joint of a given word.
    pub fn named(word: &str) -> Option<Kind> {
        Kind::ALL.iter().copied().find(|k| k.card().word == word)
    }
    /// The pose with its gradient along the joint coordinates.
    pub fn pose_gradient<S: Scalar>(&self, n: &Numbers<Dual<3, S>>, q: &[S]) -> Option<Relative<Dual<3, S>>> {
        let seeded: Vec<_> = q.iter().enumerate().map(|(i, &x)| Dual::variable(x, i)).collect();
        self.pose(n, &seeded)
    }
}
