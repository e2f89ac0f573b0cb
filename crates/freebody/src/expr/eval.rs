//! Evaluation over any scalar.

use super::function::power;
use super::tree::{Condition, Expr, Op};
use crate::scalar::{real, Scalar};

/// Where the values of leaves `L` come from, as numbers `S`.
///
/// An environment that answers [`Env::rate`] by evaluating over `Jet<S>` needs a second type for
/// the inside: were it its own, the compiler would build `Jet<Jet<…>>` without end.
pub trait Env<S, L> {
    /// The value of a leaf.
    fn variable(&self, variable: &L) -> S;
    /// The time derivative of an expression.
    fn rate(&self, of: &Expr<L>) -> S;
    /// The second time derivative of an expression, which holds no further derivative.
    fn accel(&self, of: &Expr<L>) -> S;
    /// The value of a table at `x`.
    fn table(&self, table: usize, x: S) -> S;
    /// The arm at which a switch is frozen; by its switching function when `None`.
    fn branch(&self, discontinuity: usize) -> Option<bool> {
        let _ = discontinuity;
        None
    }
}

impl<L> Expr<L> {
    /// Its value. Nothing is allocated for up to 128 operations.
    ///
    /// All arms are evaluated but only the chosen one counts, so that what is undefined in another
    /// (a root of a negative number, a division by 0) does no harm.
    pub fn eval<S: Scalar, E: Env<S, L> + ?Sized>(&self, env: &E) -> S {
        let last = self.ops.len() - 1;
        match &self.ops[last] {
            Op::Constant(value) => S::of(*value),
            Op::Variable(variable) => env.variable(variable),
            _ => self.with_values(last + 1, env, |values| values[last]),
        }
    }

    /// The switching function of the switch `kink`, positive on its true arm; NaN when the
    /// expression has no such switch, or where the switch is undefined and cannot matter.
    ///
    /// It is x for `abs(x)` and `sign(x)`, a − b for `min(a, b)` and `max(a, b)`, b − a for `a < b`,
    /// `a <= b`, `b > a` and `b >= a`, sin(πa/b) for `mod(a, b)`.
    pub fn switch<E: Env<f64, L> + ?Sized>(&self, discontinuity: usize, env: &E) -> f64 {
        match self.ops.iter().position(|op| op.discontinuity() == Some(discontinuity)) {
            Some(i) => self.with_values(i, env, |values| self.ops[i].switching(values)),
            None => match self
                .ops
                .iter()
                .filter_map(Op::inner)
                .find(|inner| inner.discontinuities().any(|k| k == discontinuity))
            {
                Some(inner) => inner.switch(discontinuity, env),
                None => f64::NAN,
            },
        }
    }

    /// Evaluates the first `count` operations, on the stack when they are few.
    fn with_values<S: Scalar, E: Env<S, L> + ?Sized, T>(
        &self,
        count: usize,
        env: &E,
        read: impl FnOnce(&[S]) -> T,
    ) -> T {
        match count {
            0..=8 => read(self.fill(&mut [S::zero(); 8][..count], env)),
            9..=32 => read(self.fill(&mut [S::zero(); 32][..count], env)),
            33..=128 => read(self.fill(&mut [S::zero(); 128][..count], env)),
            _ => read(self.fill(&mut vec![S::zero(); count], env)),
        }
    }

    fn fill<'a, S: Scalar, E: Env<S, L> + ?Sized>(&self, values: &'a mut [S], env: &E) -> &'a [S] {
        for i in 0..values.len() {
            values[i] = self.ops[i].result(&values[..i], env);
        }
        values
    }
}

impl<L> Condition<L> {
    /// Whether it holds. A comparison with an undefined number does not.
    pub fn holds<S: Scalar, E: Env<S, L> + ?Sized>(&self, env: &E) -> bool {
        truth(self.0.eval(env))
    }
}

fn truth<S: Scalar>(value: S) -> bool {
    value.value() > 0.5
}

fn number<S: Scalar>(truth: bool) -> S {
    S::of(if truth { 1.0 } else { 0.0 })
}

impl<L> Op<L> {
    #[inline]
    fn result<S: Scalar, E: Env<S, L> + ?Sized>(&self, v: &[S], env: &E) -> S {
        match *self {
            Op::Constant(value) => S::of(value),
            Op::Variable(ref variable) => env.variable(variable),
            Op::Add(a, b) => v[a] + v[b],
            Op::Subtract(a, b) => v[a] - v[b],
            Op::Multiply(a, b) => v[a] * v[b],
            Op::Divide(a, b) => v[a] / v[b],
            Op::Negate(a) => -v[a],
            Op::Whole(a, n) => v[a].powi(n),
            Op::Power(a, b) => power(v[a], v[b]),
            Op::Apply(function, a) => function.apply(v[a]),
            Op::Atan2(y, x) => v[y].atan2(v[x]),
            Op::Sign { of, kink: discontinuity } => sign(v[of].value(), env.branch(discontinuity)),
            Op::Abs { of, .. } => S::select(self.branch(v, env), v[of], -v[of]),
            Op::Min { a, b, .. } => S::select(self.branch(v, env), v[b], v[a]),
            Op::Max { a, b, .. } => S::select(self.branch(v, env), v[a], v[b]),
            Op::Modulo { a, b, .. } => v[a] - v[b].scale(self.multiple(v[a].value() / v[b].value(), env)),
            Op::Less { .. } | Op::LessEqual { .. } => number(self.branch(v, env)),
            Op::Equal(a, b) => number(v[a].value() == v[b].value()),
            Op::And(a, b) => number(truth(v[a]) && truth(v[b])),
            Op::Or(a, b) => number(truth(v[a]) || truth(v[b])),
            Op::Not(a) => number(!truth(v[a])),
            Op::If { condition, then, otherwise } => S::select(truth(v[condition]), v[then], v[otherwise]),
            Op::Table(table, a) => env.table(table, v[a]),
            Op::Rate(ref inner) => env.rate(inner),
            Op::Accel(ref inner) => env.accel(inner),
        }
    }

    /// The arm of a switch: frozen, or by its switching function.
    #[inline]
    fn branch<S: Scalar, E: Env<S, L> + ?Sized>(&self, v: &[S], env: &E) -> bool {
        let frozen = self.discontinuity().and_then(|discontinuity| env.branch(discontinuity));
        frozen.unwrap_or_else(|| match self {
            Op::Less { .. } => self.switching(v) > 0.0,
            _ => self.switching(v) >= 0.0,
        })
    }

    /// The whole number below a ratio; of a frozen modulus that of the frozen parity whose interval is nearest.
    fn multiple<S: Scalar, E: Env<S, L> + ?Sized>(&self, ratio: f64, env: &E) -> f64 {
        match self.discontinuity().and_then(|discontinuity| env.branch(discontinuity)) {
            Some(even) => {
                let odd = if even { 0.0 } else { 1.0 };
                2.0 * (0.5 * (ratio - 0.5 - odd)).round() + odd
            }
            None => ratio.floor(),
        }
    }

    /// The switching function; NaN when it is no switch.
    fn switching<S: Scalar>(&self, v: &[S]) -> f64 {
        match *self {
            Op::Abs { of, .. } | Op::Sign { of, .. } => v[of].value(),
            Op::Min { a, b, .. } | Op::Max { a, b, .. } => v[a].value() - v[b].value(),
            Op::Less { a, b, .. } | Op::LessEqual { a, b, .. } => v[b].value() - v[a].value(),
            Op::Modulo { a, b, .. } => real::sin_pi(v[a].value() / v[b].value()),
            _ => f64::NAN,
        }
    }
}

/// −1, 0 or 1; a frozen sign is never 0, an undefined one stays undefined.
fn sign<S: Scalar>(x: f64, arm: Option<bool>) -> S {
    S::of(match arm {
        Some(true) => 1.0,
        Some(false) => -1.0,
        None if x == 0.0 => 0.0,
        None => x.signum(),
    })
}
