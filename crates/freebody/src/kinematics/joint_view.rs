//! A joint with its numbers: its own formulas, read with any scalar.

use super::StateView;
use crate::bound_values::BoundValues;
use crate::expr::Env;
use crate::gauges::{ModelExpr, ModelVariable};
use crate::joints::{Curve as CurveOf, Gear, Joint as Formulas, Numbers as JointNumbers, Relative};
use crate::mechanism::{Curve, Joint, Mechanism};
use crate::plane::{vec2, Rows3, Vec2};
use crate::scalar::{Dual, Scalar};
use smallvec::SmallVec;

/// Most numbers that a joint has.
const MOST: usize = 6;

/// A joint with its numbers, read with scalar `T`.
pub struct JointView<'a, T> {
    joint: &'a Joint,
    own: [T; MOST],
    curve: Option<CurveView<'a, T>>,
}

struct CurveView<'a, T> {
    mechanism: &'a Mechanism,
    curve: &'a Curve,
    p: SmallVec<[T; 8]>,
}

impl<'a, T: Scalar> JointView<'a, T> {
    /// The joint with its numbers carried over by `to`.
    #[inline(always)]
    pub fn new<S: Scalar>(m: &'a Mechanism, n: &BoundValues<S>, joint: &'a Joint, to: impl Fn(S) -> T) -> Self {
        let mut own = [T::zero(); MOST];
        for (number, &id) in own.iter_mut().zip(&joint.numbers) {
            *number = to(n.values[id]);
        }
        let curve = joint.curve.map(|i| CurveView {
            mechanism: m,
            curve: &m.curves[i],
            p: n.p.iter().map(|&x| to(x)).collect(),
        });
        JointView { joint, own, curve }
    }
    /// Joint `index` at a state: the teeth of a gear pair bear on the flank that its mode says.
    #[inline(always)]
    pub fn in_mode<S: Scalar>(at: StateView<'a, S>, index: usize, to: impl Fn(S) -> T) -> Self {
        let mut view = JointView::new(at.m, at.n, &at.m.joints[index], to);
        if at.mode.bears_on_other_flank(index) {
            view.own[Gear::FLANK] = -view.own[Gear::FLANK];
        }
        view
    }
    #[inline(always)]
    fn numbers(&self) -> JointNumbers<'_, T> {
        JointNumbers {
            of: &self.own[..self.joint.numbers.len()],
            curve: self.curve.as_ref().map(|c| c as &dyn CurveOf<T>),
        }
    }
    /// The pose at joint coordinates in the order of the card, seen from the second body if `reversed`.
    pub fn pose(&self, q: &[T], reversed: bool) -> Relative<T> {
        let pose = self.joint.kind.pose(&self.numbers(), q).expect("a joint of the tree has a pose");
        if reversed {
            pose.inverse()
        } else {
            pose
        }
    }
    /// All rows of the card.
    #[inline(always)]
    pub fn residual(&self, r: &Relative<T>) -> Rows3<T> {
        self.joint.kind.residual(&self.numbers(), r).expect("a joint that closes a loop has a residual")
    }
    /// The coefficients of its row of rates, if it is one.
    #[inline(always)]
    pub fn rate_row(&self, r: &Relative<T>) -> Option<[T; 3]> {
        self.joint.kind.rate_row(&self.numbers(), r)
    }
    /// Where the reaction acts, in the first marker's axes.
    pub fn contact(&self, r: &Relative<T>) -> Vec2<T> {
        self.joint.kind.contact(&self.numbers(), r)
    }
    /// Direction of the joint's line, or of its curve at the own measure `s` of its first coordinate, in the first
    /// marker's axes.
    pub fn tangent(&self, s: T) -> Vec2<T> {
        match &self.curve {
            Some(curve) => {
                let (_, slope) = curve.at(s);
                slope.unit()
            }
            None => vec2(T::one(), T::zero()),
        }
    }
    /// The coordinates in the order of the card, where they can be read off.
    pub fn measure(&self, r: &Relative<T>) -> Option<Rows3<T>> {
        self.joint.kind.measure(&self.numbers(), r)
    }
}

impl JointView<'_, f64> {
    /// Period of a row of the card.
    pub fn period(&self, row: usize) -> f64 {
        self.joint.kind.period(&self.numbers(), row)
    }
}

impl<T: Scalar> CurveOf<T> for CurveView<'_, T> {
    fn at(&self, s: T) -> (Vec2<T>, Vec2<T>) {
        let env = Along { m: self.mechanism, p: &self.p, s };
        let x: Dual<1, T> = self.curve.x.eval(&env);
        let y: Dual<1, T> = self.curve.y.eval(&env);
        (vec2(x.re, y.re), vec2(x.du[0], y.du[0]))
    }
}

/// What the description of a curve may read.
struct Along<'a, T> {
    m: &'a Mechanism,
    p: &'a [T],
    s: T,
}

impl<T: Scalar> Env<Dual<1, T>, ModelVariable> for Along<'_, T> {
    fn variable(&self, variable: &ModelVariable) -> Dual<1, T> {
        match variable {
            ModelVariable::Parameter(i) => Dual::constant(self.p[*i]),
            ModelVariable::Local => Dual::variable(self.s, 0),
            other => unreachable!("{other:?} in the description of a curve"),
        }
    }
    fn rate(&self, _: &ModelExpr) -> Dual<1, T> {
        Dual::constant(T::zero())
    }
    fn accel(&self, _: &ModelExpr) -> Dual<1, T> {
        Dual::constant(T::zero())
    }
    fn table(&self, table: usize, x: Dual<1, T>) -> Dual<1, T> {
        self.m.tables[table].eval(x)
    }
}
