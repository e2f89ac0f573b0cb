//! Functions of one variable, over any scalar.

use crate::scalar::Scalar;

/// A smooth function of one variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
}

impl Function {
    pub(super) const ALL: [(&'static str, Function); 12] = [
        ("sqrt", Function::Sqrt),
        ("exp", Function::Exp),
        ("ln", Function::Ln),
        ("sin", Function::Sin),
        ("cos", Function::Cos),
        ("tan", Function::Tan),
        ("asin", Function::Asin),
        ("acos", Function::Acos),
        ("atan", Function::Atan),
        ("sinh", Function::Sinh),
        ("cosh", Function::Cosh),
        ("tanh", Function::Tanh),
    ];

    pub(super) fn named(word: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == word).map(|&(_, function)| function)
    }

    pub(super) fn name(self) -> &'static str {
        Self::ALL[self as usize].0
    }

    #[inline]
    pub(super) fn apply<S: Scalar>(self, x: S) -> S {
        match self {
            Function::Sqrt => x.sqrt(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Sin => x.sin_cos().0,
            Function::Cos => x.sin_cos().1,
            Function::Tan => tan(x),
            Function::Asin => x.atan2(other_leg(x)),
            Function::Acos => other_leg(x).atan2(x),
            Function::Atan => x.atan2(S::one()),
            Function::Sinh => sinh(x),
            Function::Cosh => cosh(x),
            Function::Tanh => tanh(x),
        }
    }
}

fn tan<S: Scalar>(x: S) -> S {
    let (s, c) = x.sin_cos();
    s / c
}

/// √(1 − x²), without cancellation near |x| = 1.
fn other_leg<S: Scalar>(x: S) -> S {
    ((S::one() - x) * (S::one() + x)).sqrt()
}

/// Below this the series is exact to the last place, above it the exponentials do not cancel.
const SMALL: f64 = 0.5;

fn sinh<S: Scalar>(x: S) -> S {
    if x.value().abs() < SMALL {
        return sinh_series(x);
    }
    (x.exp() - (-x).exp()).scale(0.5)
}

fn cosh<S: Scalar>(x: S) -> S {
    (x.exp() + (-x).exp()).scale(0.5)
}

fn tanh<S: Scalar>(x: S) -> S {
    if x.value().abs() < SMALL {
        return sinh_series(x) / cosh(x);
    }
    // An exponential that decays cannot overflow.
    let side = x.value().signum();
    let e = x.scale(-2.0 * side).exp();
    ((S::one() - e) / (S::one() + e)).scale(side)
}

/// x + x³/3! + … + x¹³/13!, by Horner's rule in x².
fn sinh_series<S: Scalar>(x: S) -> S {
    let square = x * x;
    let sum = [156.0, 110.0, 72.0, 42.0, 20.0, 6.0];
    x * sum.iter().fold(S::one(), |inner, divisor| S::one() + square.scale(1.0 / divisor) * inner)
}

/// The real power of a base, 0 included where it has a slope there.
pub(super) fn power<S: Scalar>(base: S, exponent: S) -> S {
    // The logarithm of 0 would make the slope 0·∞.
    if base.value() == 0.0 && exponent.value() > 1.0 {
        return S::zero();
    }
    base.powf(exponent)
}
