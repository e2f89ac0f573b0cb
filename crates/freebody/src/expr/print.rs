//! From expression to text.

use super::tree::{Condition, Expr, Op};

/// What a text of an expression needs a name for.
#[derive(Clone, Copy, Debug)]
pub enum Named<'a, L> {
    /// A leaf.
    Variable(&'a L),
    /// A table, by its identifier.
    Table(usize),
}

/// Longest text of a part; expressions share parts, so that a text can be far longer than its source.
const MAX_LENGTH: usize = 100_000;

/// How tightly a text holds together, from the loosest.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Bond {
    Or,
    And,
    Condition,
    Sum,
    Product,
    Sign,
    Power,
    Operand,
}

struct Text {
    text: String,
    bond: Bond,
}

impl<L> Expr<L> {
    /// Its text, which parses to the same value. `name` spells leaves and tables; see
    /// [`super::spell`] for names that need quotes. What is longer than 100 000 bytes becomes `…`.
    pub fn text(&self, mut name: impl FnMut(Named<L>) -> String) -> String {
        self.write(&mut name)
    }

    fn write(&self, name: &mut dyn FnMut(Named<L>) -> String) -> String {
        let mut parts: Vec<Text> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let (mut text, bond) = op.text(&parts, name);
            if text.len() > MAX_LENGTH {
                text = "…".into();
            }
            parts.push(Text { text, bond });
        }
        parts.pop().map_or(String::new(), |part| part.text)
    }
}

impl<L> Condition<L> {
    /// Its text, which parses to the same condition; as [`Expr::text`].
    pub fn text(&self, name: impl FnMut(Named<L>) -> String) -> String {
        self.0.text(name)
    }
}

/// The shortest digits that read back as the same number.
fn literal(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}

impl Text {
    /// The text, in parentheses unless it holds together at least as tightly as `least`.
    fn within(&self, least: Bond) -> String {
        match self.bond >= least {
            true => self.text.clone(),
            false => format!("({})", self.text),
        }
    }
}

impl<L> Op<L> {
    fn text(&self, parts: &[Text], name: &mut dyn FnMut(Named<L>) -> String) -> (String, Bond) {
        let plain = |i: usize| &parts[i].text;
        let infix = |a: usize, left: Bond, sign: &str, b: usize, right: Bond| {
            format!("{}{sign}{}", parts[a].within(left), parts[b].within(right))
        };
        let call =
            |function: &str, a: usize, b: usize| (format!("{function}({}, {})", plain(a), plain(b)), Bond::Operand);
        match *self {
            Op::Constant(value) if value.is_sign_negative() => (literal(value), Bond::Sign),
            Op::Constant(value) => (literal(value), Bond::Operand),
            Op::Variable(ref variable) => (name(Named::Variable(variable)), Bond::Operand),
            Op::Add(a, b) => (infix(a, Bond::Sum, " + ", b, Bond::Product), Bond::Sum),
            Op::Subtract(a, b) => (infix(a, Bond::Sum, " - ", b, Bond::Product), Bond::Sum),
            Op::Multiply(a, b) => (infix(a, Bond::Product, "*", b, Bond::Sign), Bond::Product),
            Op::Divide(a, b) => (infix(a, Bond::Product, "/", b, Bond::Sign), Bond::Product),
            Op::Negate(a) => (format!("-{}", parts[a].within(Bond::Sign)), Bond::Sign),
            Op::Whole(a, n) => (format!("{}^{n}", parts[a].within(Bond::Operand)), Bond::Power),
            Op::Power(a, b) => (infix(a, Bond::Operand, "^", b, Bond::Sign), Bond::Power),
            Op::Apply(function, a) => (format!("{}({})", function.name(), plain(a)), Bond::Operand),
            Op::Atan2(y, x) => call("atan2", y, x),
            Op::Abs { of, .. } => (format!("abs({})", plain(of)), Bond::Operand),
            Op::Sign { of, .. } => (format!("sign({})", plain(of)), Bond::Operand),
            Op::Min { a, b, .. } => call("min", a, b),
            Op::Max { a, b, .. } => call("max", a, b),
            Op::Modulo { a, b, .. } => call("mod", a, b),
            Op::Less { a, b, .. } => (infix(a, Bond::Sum, " < ", b, Bond::Sum), Bond::Condition),
            Op::LessEqual { a, b, .. } => (infix(a, Bond::Sum, " <= ", b, Bond::Sum), Bond::Condition),
            Op::Equal(a, b) => (infix(a, Bond::Sum, " == ", b, Bond::Sum), Bond::Condition),
            Op::And(a, b) => (infix(a, Bond::And, " and ", b, Bond::Condition), Bond::And),
            Op::Or(a, b) => (infix(a, Bond::Or, " or ", b, Bond::And), Bond::Or),
            Op::Not(a) => (format!("not ({})", plain(a)), Bond::Condition),
            Op::If { condition, then, otherwise } => {
                (format!("if({}, {}, {})", plain(condition), plain(then), plain(otherwise)), Bond::Operand)
            }
            Op::Table(table, a) => (format!("{}({})", name(Named::Table(table)), plain(a)), Bond::Operand),
            Op::Rate(ref inner) => (format!("rate({})", inner.write(name)), Bond::Operand),
            Op::Accel(ref inner) => (format!("accel({})", inner.write(name)), Bond::Operand),
        }
    }
}
