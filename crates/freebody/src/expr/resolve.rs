//! From syntax tree to expression.

use super::function::Function;
use super::tree::Op;
use super::{nearest, Ast, Condition, Expr, ExprError, Kind, Message, Operator};

/// Most operations in a resolved expression, named ones that it takes in included.
pub const MAX_OPERATIONS: usize = 100_000;

/// The functions that every expression knows. `step(x)` is 1 where x > 0, else 0; `clamp(x, a, b)`
/// is x kept between a and b; `min` and `max` take two arguments or more; `mod(a, b)` is a − b floor(a/b).
pub const FUNCTIONS: [&str; 24] = [
    "sqrt", "exp", "ln", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "atan2", "hypot", "abs",
    "sign", "step", "min", "max", "clamp", "mod", "if", "rate", "accel",
];

/// What the names in an expression mean.
pub trait Scope<L> {
    /// The meaning of a name: a leaf, or a named expression to take in.
    fn name(&mut self, name: &str) -> Result<Expr<L>, Message>;
    /// A call of a function that is not in [`FUNCTIONS`] and is no table; `None` when it is unknown
    /// here too. Arguments may be names or be resolved with [`Expr::resolve`].
    fn call(&mut self, name: &str, arguments: &[Ast]) -> Option<Result<Expr<L>, ExprError>> {
        let _ = (name, arguments);
        None
    }
    /// The table of that name.
    fn table(&self, name: &str) -> Option<usize> {
        let _ = name;
        None
    }
    /// The names of tables and of functions that [`Scope::call`] knows, for suggestions.
    fn functions(&self) -> Vec<String> {
        Vec::new()
    }
    /// A fresh identifier for a switch, unique in the model.
    fn discontinuity(&mut self) -> usize;
}

type Resolved<T> = Result<T, ExprError>;

impl<L: Clone + PartialEq> Expr<L> {
    /// The meaning of a syntax tree that gives a number.
    pub fn resolve<C: Scope<L> + ?Sized>(ast: &Ast, scope: &mut C) -> Resolved<Self> {
        let expr = match &ast.kind {
            Kind::Number(value) => Expr::constant(*value),
            Kind::Name(name) if name == "pi" => Expr::constant(std::f64::consts::PI),
            Kind::Name(name) => scope.name(name).map_err(|message| message.at(&ast.span))?,
            Kind::Negate(inner) => -Expr::resolve(inner, scope)?,
            Kind::Chain(first, rest) if is_arithmetic(rest) => chain(first, rest, scope)?,
            Kind::Call(name, arguments) => call(ast, name, arguments, scope)?,
            Kind::Not(_) | Kind::Chain(..) => {
                let hint = "for a number, write `if(condition, 1, 0)`";
                return error_at(ast, "a condition stands where a number is needed", hint);
            }
        };
        check(expr, ast)
    }
}

impl<L: Clone + PartialEq> Condition<L> {
    /// The meaning of a syntax tree that is true or false.
    pub fn resolve<C: Scope<L> + ?Sized>(ast: &Ast, scope: &mut C) -> Resolved<Self> {
        let condition = match &ast.kind {
            Kind::Not(inner) => !Condition::resolve(inner, scope)?,
            Kind::Chain(first, rest) if !is_arithmetic(rest) => conditions(first, rest, scope)?,
            _ => {
                let hint = "compare it with another, as in `x > 0`";
                return error_at(ast, "a number stands where a condition is needed", hint);
            }
        };
        check(condition.0, ast).map(Condition)
    }
}

fn error_at<T>(ast: &Ast, what: impl Into<String>, hint: impl Into<String>) -> Resolved<T> {
    Err(Message::new(what, hint).at(&ast.span))
}

fn check<L>(expr: Expr<L>, ast: &Ast) -> Resolved<Expr<L>> {
    // Within as well: the rate of what is finite can overflow to a constant.
    if expr.ops.iter().any(|op| matches!(op, Op::Constant(value) if !value.is_finite())) {
        return error_at(ast, "this number is undefined or infinite", "look for a division by 0 or a negative root");
    }
    if expr.ops.len() > MAX_OPERATIONS {
        let what = format!("the expression has more than {MAX_OPERATIONS} operations with all that it names");
        return error_at(ast, what, "let it name less");
    }
    Ok(expr)
}

fn is_arithmetic(rest: &[(Operator, Ast)]) -> bool {
    use Operator::{Add, Divide, Multiply, Power, Subtract};
    rest.iter().all(|(operator, _)| matches!(operator, Add | Subtract | Multiply | Divide | Power))
}

fn chain<L, C>(first: &Ast, rest: &[(Operator, Ast)], scope: &mut C) -> Resolved<Expr<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    let mut value = Expr::resolve(first, scope)?;
    for (operator, ast) in rest {
        let operand = Expr::resolve(ast, scope)?;
        value = match operator {
            Operator::Add => value + operand,
            Operator::Subtract => value - operand,
            Operator::Multiply => value * operand,
            Operator::Divide => value / operand,
            _ => value.powf(operand),
        };
        value = check(value, ast)?;
    }
    Ok(value)
}

fn conditions<L, C>(first: &Ast, rest: &[(Operator, Ast)], scope: &mut C) -> Resolved<Condition<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    if let [(operator, second)] = rest {
        if !matches!(operator, Operator::And | Operator::Or) {
            return compare(first, *operator, second, scope);
        }
    }
    let mut value = Condition::resolve(first, scope)?;
    for (operator, ast) in rest {
        let operand = Condition::resolve(ast, scope)?;
        let joined = match operator {
            Operator::And => value.and(operand),
            _ => value.or(operand),
        };
        value = Condition(check(joined.0, ast)?);
    }
    Ok(value)
}

fn compare<L, C>(a: &Ast, operator: Operator, b: &Ast, scope: &mut C) -> Resolved<Condition<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    let (a, b) = (Expr::resolve(a, scope)?, Expr::resolve(b, scope)?);
    Ok(match operator {
        Operator::Less => a.less(b, scope.discontinuity()),
        Operator::LessEqual => a.less_equal(b, scope.discontinuity()),
        Operator::Greater => b.less(a, scope.discontinuity()),
        Operator::GreaterEqual => b.less_equal(a, scope.discontinuity()),
        Operator::NotEqual => !a.equal(b),
        _ => a.equal(b),
    })
}

fn call<L, C>(ast: &Ast, name: &str, arguments: &[Ast], scope: &mut C) -> Resolved<Expr<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    if let Some(function) = Function::named(name) {
        return arity(ast, name, arguments, 1, || Expr::resolve(&arguments[0], scope).map(|x| x.apply(function)));
    }
    match name {
        "abs" | "sign" | "step" | "rate" | "accel" => arity(ast, name, arguments, 1, || {
            let x = Expr::resolve(&arguments[0], scope)?;
            of_one(ast, name, x, scope)
        }),
        "atan2" | "hypot" | "mod" => arity(ast, name, arguments, 2, || {
            let (a, b) = (Expr::resolve(&arguments[0], scope)?, Expr::resolve(&arguments[1], scope)?);
            Ok(match name {
                "atan2" => a.atan2(b),
                "hypot" => a.hypot(b),
                _ => a.modulo(b, scope.discontinuity()),
            })
        }),
        "min" | "max" => extreme(ast, name, arguments, scope),
        "clamp" => arity(ast, name, arguments, 3, || {
            let [x, low, high] = three(arguments, scope)?;
            Ok(x.max(low, scope.discontinuity()).min(high, scope.discontinuity()))
        }),
        "if" => arity(ast, name, arguments, 3, || {
            let condition = Condition::resolve(&arguments[0], scope)?;
            Ok(condition.choose(Expr::resolve(&arguments[1], scope)?, Expr::resolve(&arguments[2], scope)?))
        }),
        _ => foreign(ast, name, arguments, scope),
    }
}

fn arity<T>(
    ast: &Ast,
    name: &str,
    arguments: &[Ast],
    wanted: usize,
    then: impl FnOnce() -> Resolved<T>,
) -> Resolved<T> {
    if arguments.len() == wanted {
        return then();
    }
    let plural = if wanted == 1 { "argument" } else { "arguments" };
    let hint = match name {
        "if" => "write `if(condition, value, other value)`",
        _ => "arguments are separated by commas",
    };
    error_at(ast, format!("`{name}` takes {wanted} {plural}, not {}", arguments.len()), hint)
}

fn three<L, C>(arguments: &[Ast], scope: &mut C) -> Resolved<[Expr<L>; 3]>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    let mut next = |i: usize| Expr::resolve(&arguments[i], scope);
    Ok([next(0)?, next(1)?, next(2)?])
}

fn of_one<L, C>(ast: &Ast, name: &str, x: Expr<L>, scope: &mut C) -> Resolved<Expr<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    Ok(match name {
        "abs" => x.abs(scope.discontinuity()),
        "sign" => x.sign(scope.discontinuity()),
        "step" => {
            let positive = Expr::constant(0.0).less(x, scope.discontinuity());
            positive.choose(Expr::constant(1.0), Expr::constant(0.0))
        }
        "rate" => x.rate(),
        _ => match x.accel() {
            Some(expr) => expr,
            None => return error_at(ast, "`accel` of a time derivative", "write `rate` of it"),
        },
    })
}

fn extreme<L, C>(ast: &Ast, name: &str, arguments: &[Ast], scope: &mut C) -> Resolved<Expr<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    if arguments.len() < 2 {
        return error_at(ast, format!("`{name}` takes two arguments or more"), "arguments are separated by commas");
    }
    let mut value = Expr::resolve(&arguments[0], scope)?;
    for argument in &arguments[1..] {
        let other = Expr::resolve(argument, scope)?;
        let discontinuity = scope.discontinuity();
        let joined = if name == "min" { value.min(other, discontinuity) } else { value.max(other, discontinuity) };
        value = check(joined, argument)?;
    }
    Ok(value)
}

/// A table, or a function of the scope.
fn foreign<L, C>(ast: &Ast, name: &str, arguments: &[Ast], scope: &mut C) -> Resolved<Expr<L>>
where
    L: Clone + PartialEq,
    C: Scope<L> + ?Sized,
{
    if let Some(table) = scope.table(name) {
        return arity(ast, name, arguments, 1, || Expr::resolve(&arguments[0], scope).map(|x| x.lookup(table)));
    }
    if let Some(result) = scope.call(name, arguments) {
        return result;
    }
    let more = scope.functions();
    let hint = match name {
        "log" => "for the natural logarithm, write `ln(x)`".to_string(),
        "arcsin" | "arccos" | "arctan" => format!("did you mean `a{}`?", &name[3..]),
        _ => match nearest(name, FUNCTIONS.into_iter().chain(more.iter().map(String::as_str))) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "for a product, write `*` before the parenthesis".to_string(),
        },
    };
    error_at(ast, format!("no function is called `{name}`"), hint)
}
