//! The resolved expression.

use super::function::Function;

/// An expression whose names are resolved to leaves `L`.
///
/// It is a list of operations in the order of evaluation, each on results of earlier ones; the
/// last is the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr<L> {
    pub(super) ops: Vec<Op<L>>,
}

/// A resolved condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition<L>(pub(super) Expr<L>);

/// One operation; `usize` operands are positions of earlier ones, `kink` names a switch. Truth is
/// the number 1 and falsehood 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Op<L> {
    Constant(f64),
    Variable(L),
    Add(usize, usize),
    Subtract(usize, usize),
    Multiply(usize, usize),
    Divide(usize, usize),
    Negate(usize),
    /// A power with a constant whole exponent.
    Whole(usize, i32),
    Power(usize, usize),
    Apply(Function, usize),
    Atan2(usize, usize),
    Abs {
        of: usize,
        kink: usize,
    },
    Sign {
        of: usize,
        kink: usize,
    },
    Min {
        a: usize,
        b: usize,
        kink: usize,
    },
    Max {
        a: usize,
        b: usize,
        kink: usize,
    },
    /// a − n b, with the whole number n that goes into a/b.
    Modulo {
        a: usize,
        b: usize,
        kink: usize,
    },
    Less {
        a: usize,
        b: usize,
        kink: usize,
    },
    LessEqual {
        a: usize,
        b: usize,
        kink: usize,
    },
    /// Exact equality; no switch.
    Equal(usize, usize),
    And(usize, usize),
    Or(usize, usize),
    Not(usize),
    If {
        condition: usize,
        then: usize,
        otherwise: usize,
    },
    Table(usize, usize),
    Rate(Box<Expr<L>>),
    Accel(Box<Expr<L>>),
}

impl<L> Op<L> {
    /// The switch it is, if any.
    pub(super) fn discontinuity(&self) -> Option<usize> {
        match *self {
            Op::Abs { kink: discontinuity, .. } | Op::Sign { kink: discontinuity, .. } => Some(discontinuity),
            Op::Min { kink: discontinuity, .. } | Op::Max { kink: discontinuity, .. } => Some(discontinuity),
            Op::Modulo { kink: discontinuity, .. } => Some(discontinuity),
            Op::Less { kink: discontinuity, .. } | Op::LessEqual { kink: discontinuity, .. } => Some(discontinuity),
            _ => None,
        }
    }

    /// The expression whose time derivative it is, if any.
    pub(super) fn inner(&self) -> Option<&Expr<L>> {
        match self {
            Op::Rate(inner) | Op::Accel(inner) => Some(inner),
            _ => None,
        }
    }

    /// The same operation on other positions.
    pub(super) fn moved(self, to: impl Fn(usize) -> usize) -> Self {
        use Op::*;
        match self {
            Constant(_) | Variable(_) | Rate(_) | Accel(_) => self,
            Add(a, b) => Add(to(a), to(b)),
            Subtract(a, b) => Subtract(to(a), to(b)),
            Multiply(a, b) => Multiply(to(a), to(b)),
            Divide(a, b) => Divide(to(a), to(b)),
            Negate(a) => Negate(to(a)),
            Whole(a, n) => Whole(to(a), n),
            Power(a, b) => Power(to(a), to(b)),
            Apply(function, a) => Apply(function, to(a)),
            Atan2(a, b) => Atan2(to(a), to(b)),
            Abs { of, kink: discontinuity } => Abs { of: to(of), kink: discontinuity },
            Sign { of, kink: discontinuity } => Sign { of: to(of), kink: discontinuity },
            Min { a, b, kink: discontinuity } => Min { a: to(a), b: to(b), kink: discontinuity },
            Max { a, b, kink: discontinuity } => Max { a: to(a), b: to(b), kink: discontinuity },
            Modulo { a, b, kink: discontinuity } => Modulo { a: to(a), b: to(b), kink: discontinuity },
            Less { a, b, kink: discontinuity } => Less { a: to(a), b: to(b), kink: discontinuity },
            LessEqual { a, b, kink: discontinuity } => LessEqual { a: to(a), b: to(b), kink: discontinuity },
            Equal(a, b) => Equal(to(a), to(b)),
            And(a, b) => And(to(a), to(b)),
            Or(a, b) => Or(to(a), to(b)),
            Not(a) => Not(to(a)),
            If { condition, then, otherwise } => {
                If { condition: to(condition), then: to(then), otherwise: to(otherwise) }
            }
            Table(table, a) => Table(table, to(a)),
        }
    }
}

impl<L> Expr<L> {
    /// The number it is, when it is a bare number.
    pub fn literal(&self) -> Option<f64> {
        match self.ops[..] {
            [Op::Constant(value)] => Some(value),
            _ => None,
        }
    }

    /// The leaf it is, when it is a bare leaf.
    pub fn as_variable(&self) -> Option<&L> {
        match &self.ops[..] {
            [Op::Variable(variable)] => Some(variable),
            _ => None,
        }
    }

    /// Whether no value decides how it is evaluated: it is made of sums, products, quotients, whole powers and functions that
    /// have one formula.
    pub fn is_without_choice(&self) -> bool {
        use Function::{Cos, Exp, Ln, Sin, Sqrt, Tan};
        self.ops.iter().all(|op| match op {
            Op::Constant(_) | Op::Variable(_) | Op::Negate(_) | Op::Whole(..) => true,
            Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) | Op::Divide(..) => true,
            Op::Apply(function, _) => matches!(function, Sqrt | Exp | Ln | Sin | Cos | Tan),
            _ => false,
        })
    }

    /// Whether nothing in it can change: it has no leaves.
    pub fn is_constant(&self) -> bool {
        self.variables().next().is_none()
    }

    /// Whether it is the same operations whatever the values of its leaves.
    pub fn is_uniform(&self) -> bool {
        self.all().all(|op| match op {
            Op::Constant(_) | Op::Variable(_) | Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) | Op::Divide(..) => {
                true
            }
            Op::Negate(_) | Op::Whole(..) | Op::Atan2(..) | Op::Rate(_) | Op::Accel(_) => true,
            Op::Apply(function, _) => !matches!(function, Function::Sinh | Function::Tanh),
            _ => false,
        })
    }

    /// Its operations, then those inside its time derivatives.
    pub(super) fn all(&self) -> Box<dyn Iterator<Item = &Op<L>> + '_> {
        Box::new(self.ops.iter().chain(self.ops.iter().filter_map(Op::inner).flat_map(Expr::all)))
    }

    /// Its leaves, those inside time derivatives included; one may come more than once.
    pub fn variables(&self) -> impl Iterator<Item = &L> {
        self.all().filter_map(|op| match op {
            Op::Variable(variable) => Some(variable),
            _ => None,
        })
    }

    /// Whether it holds a time derivative, `rate(…)` or `accel(…)`.
    pub fn depends_on_rates(&self) -> bool {
        self.ops.iter().any(|op| op.inner().is_some())
    }

    /// Whether it holds a second time derivative, `accel(…)` or the rate of what holds a rate.
    pub fn depends_on_accelerations(&self) -> bool {
        self.derivatives().any(|(inner, second)| second || inner.depends_on_rates())
    }

    /// Its time derivatives: the expression inside, and whether the derivative is the second.
    pub fn derivatives(&self) -> impl Iterator<Item = (&Expr<L>, bool)> {
        self.ops.iter().filter_map(|op| op.inner().map(|inner| (inner, matches!(op, Op::Accel(_)))))
    }

    /// The discontinuities of its switches, those inside time derivatives included; one may come more than once.
    pub fn discontinuities(&self) -> impl Iterator<Item = usize> + '_ {
        self.all().filter_map(Op::discontinuity)
    }
}

impl<L: Clone> Expr<L> {
    /// Its table look-ups outside time derivatives: the table and its argument.
    pub fn lookups(&self) -> impl Iterator<Item = (usize, Expr<L>)> + '_ {
        self.ops.iter().filter_map(|op| match *op {
            Op::Table(table, of) => Some((table, Expr { ops: self.ops[..=of].to_vec() })),
            _ => None,
        })
    }
}

impl<L> Condition<L> {
    /// The condition as a number, 1 or 0; it has the leaves and discontinuities of the condition.
    pub fn as_expr(&self) -> &Expr<L> {
        &self.0
    }
}
