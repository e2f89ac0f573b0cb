//! Properties of expressions as a whole.

use super::*;
use crate::scalar::{Dual, Jet, Scalar};
use proptest::prelude::*;

/// Leaves are named by letters; `x` is the first.
struct SymbolicState {
    kinks: usize,
}

impl Scope<char> for SymbolicState {
    fn name(&mut self, name: &str) -> Result<Expr<char>, Message> {
        match name {
            "x" | "y" | "z" => Ok(Expr::variable(name.chars().next().unwrap())),
            "gauge" => Ok(Expr::variable('x') * Expr::variable('y')),
            _ => Err(Message::new(format!("`{name}` names nothing"), "did you mean `x`?")),
        }
    }
    fn call(&mut self, name: &str, arguments: &[Ast]) -> Option<Result<Expr<char>, ExprError>> {
        (name == "double").then(|| Expr::resolve(&arguments[0], self).map(|x| x * Expr::constant(2.0)))
    }
    fn table(&self, name: &str) -> Option<usize> {
        (name == "ramp").then_some(7)
    }
    fn functions(&self) -> Vec<String> {
        vec!["double".into(), "ramp".into()]
    }
    fn discontinuity(&mut self) -> usize {
        self.kinks += 1;
        self.kinks
    }
}

/// Values of x, y and z, and the arm at which all switches are frozen.
struct At<S> {
    values: [S; 3],
    arm: Option<bool>,
}

impl<S: Scalar> Env<S, char> for At<S> {
    fn variable(&self, variable: &char) -> S {
        self.values[*variable as usize - 'x' as usize]
    }
    /// As if every leaf grew at the rate 1.
    fn rate(&self, of: &Expr<char>) -> S {
        of.eval(&MotionView(self)).d1
    }
    fn accel(&self, of: &Expr<char>) -> S {
        of.eval(&MotionView(self)).d2
    }
    fn table(&self, table: usize, x: S) -> S {
        ramp(table, x)
    }
    fn branch(&self, _: usize) -> Option<bool> {
        self.arm
    }
}

/// The inside of time derivatives, which holds no further ones.
struct MotionView<'a, S>(&'a At<S>);

impl<S: Scalar> Env<Jet<S>, char> for MotionView<'_, S> {
    fn variable(&self, variable: &char) -> Jet<S> {
        Jet::new(self.0.variable(variable), S::one(), S::zero())
    }
    fn rate(&self, _: &Expr<char>) -> Jet<S> {
        unreachable!()
    }
    fn accel(&self, _: &Expr<char>) -> Jet<S> {
        unreachable!()
    }
    fn table(&self, table: usize, x: Jet<S>) -> Jet<S> {
        ramp(table, x)
    }
    fn branch(&self, discontinuity: usize) -> Option<bool> {
        self.0.branch(discontinuity)
    }
}

fn ramp<S: Scalar>(table: usize, x: S) -> S {
    assert_eq!(table, 7);
    Table::new(&[-2.0, 0.0, 2.0], &[0.0, 1.0, 5.0], Interpolation::Linear, false).unwrap().eval(x)
}

fn resolve(text: &str) -> Result<Expr<char>, ExprError> {
    Expr::resolve(&parse(text)?, &mut SymbolicState { kinks: 0 })
}

fn free<S>(values: [S; 3]) -> At<S> {
    At { values, arm: None }
}

fn value(text: &str) -> f64 {
    resolve(text).unwrap().eval(&free([0.7, -1.3, 2.1]))
}

fn condition(text: &str) -> Condition<char> {
    Condition::resolve(&parse(text).unwrap(), &mut SymbolicState { kinks: 0 }).unwrap()
}

fn print(expr: &Expr<char>) -> String {
    expr.text(|named| match named {
        Named::Variable(variable) => variable.to_string(),
        Named::Table(_) => "ramp".into(),
    })
}

fn slope(expr: &Expr<char>, x: f64, arm: Option<bool>) -> f64 {
    let fixed = Dual::<1>::constant;
    expr.eval(&At { values: [Dual::variable(x, 0), fixed(-1.3), fixed(2.1)], arm }).du[0]
}

/// Any expression, as text.
fn texts() -> impl Strategy<Value = String> {
    let atom = prop_oneof![
        Just("x".to_string()),
        Just("y".to_string()),
        Just("z".to_string()),
        Just("gauge".to_string()),
        Just("pi".to_string()),
        (0.0..1e3f64).prop_map(|v| format!("{v:?}")),
        (0..9u8).prop_map(|v| v.to_string()),
    ];
    atom.prop_recursive(6, 60, 3, |inner| {
        let two = (inner.clone(), inner.clone());
        let three = (inner.clone(), inner.clone(), inner.clone(), inner.clone());
        prop_oneof![
            (two.clone(), prop::sample::select(vec!["+", "-", "*", "/", " ** "]))
                .prop_map(|((a, b), s)| format!("({a}){s}({b})")),
            (two.clone(), prop::sample::select(vec!["+", "-", "*", "/"])).prop_map(|((a, b), s)| format!("{a}{s}{b}")),
            (two, prop::sample::select(vec!["min", "max", "atan2", "hypot", "mod"]))
                .prop_map(|((a, b), f)| format!("{f}({a}, {b})")),
            (inner.clone(), prop::sample::select(vec!["sin", "tanh", "abs", "sign", "step", "ramp", "double"]))
                .prop_map(|(a, f)| format!("{f}({a})")),
            inner.prop_map(|a| format!("-({a})^2")),
            (three, prop::sample::select(vec!["<", "<=", ">", ">=", "==", "!="]))
                .prop_map(|((a, b, c, d), s)| format!("if({a} {s} {b} and not ({c} < {d} or x > y), {c}, {d})")),
        ]
    })
}

proptest! {
    #[test]
    fn printing_keeps_the_value(text in texts(), x in -2.0..2.0f64) {
        let Ok(expr) = resolve(&text) else { return Ok(()) };
        let again = resolve(&print(&expr)).unwrap();
        let at = free([x, -1.3, 2.1]);
        let (a, b) = (expr.eval(&at), again.eval(&at));
        prop_assert!(a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan(), "{} and {}: {} and {}", text, print(&expr), a, b);
    }

    #[test]
    fn no_text_upsets_the_parser(text in "[ -~×°µ']{0,60}") {
        if let Err(error) = parse(&text) {
            prop_assert!(error.at.end <= text.len() && text.is_char_boundary(error.at.start));
        }
    }

    #[test]
    fn slopes_are_exact_on_both_sides_of_kinks(x in 0.05..0.95f64) {
        let texts = [
            "sqrt(x)", "exp(x)", "ln(x)", "sin(x)", "cos(x)", "tan(x)", "asin(x)", "acos(x)", "atan(x)", "sinh(x)",
            "cosh(x)", "tanh(x)", "tanh(9*x)", "sinh(3*x)", "atan2(x, y)", "hypot(x, z)", "x^3", "x^-2", "x^2.5",
            "2^x", "x^x", "abs(x - 0.5)", "sign(x - 0.5)*x", "min(x, 1 - x)", "max(x, 1 - x)", "clamp(x, 0.3, 0.7)*x",
            "if(x < 0.5, x^2, 3*x)", "if(x < 0.3 or x >= 0.6 and not x > 0.8, x^2, 3*x)", "step(x - 0.5)*x", "ramp(x - 0.5)",
            "rate(x^3)", "accel(sin(x))", "rate(abs(x - 0.5)*x)", "x/(x + y)", "-x^2", "max(0, x - 0.5)^1.5",
            "mod(x + 0.5, 1)*x",
        ];
        // Central differences need a neighbourhood without discontinuities.
        prop_assume!([0.3, 0.5, 0.6, 0.7, 0.8].iter().all(|discontinuity| (x - discontinuity).abs() > 1e-4));
        for text in texts {
            let expr = resolve(text).unwrap();
            let at = |x: f64| expr.eval(&free([x, -1.3, 2.1]));
            let h = 1e-5 * x.min(1.0 - x);
            let difference = (at(x + h) - at(x - h)) / (2.0 * h);
            let exact = slope(&expr, x, None);
            prop_assert!((exact - difference).abs() <= 1e-5 * (1.0 + 2.0 * exact.abs()), "{} at {}: {} and {}", text, x, exact, difference);
        }
    }

    #[test]
    fn hyperbolic_functions_are_exact(x in -30.0..30.0f64, small in -0.6..0.6f64) {
        let at = |text: &str, x: f64| resolve(text).unwrap().eval(&free([x, 0.0, 0.0]));
        for x in [x, small, small * 1e-6] {
            for (text, exact) in [("sinh(x)", x.sinh()), ("cosh(x)", x.cosh()), ("tanh(x)", x.tanh())] {
                prop_assert!((at(text, x) - exact).abs() <= 6.0 * f64::EPSILON * exact.abs(), "{} at {}", text, x);
            }
        }
        prop_assert_eq!(at("tanh(x)", 1e4 * x.signum()), x.signum());
    }
}

#[test]
fn precedence_is_that_of_mathematics() {
    for (text, exact) in [
        ("2 + 3*4^2/6 - 1", 9.0),
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2**-1", 0.5),
        ("(-2)^2", 4.0),
        ("8/4/2", 1.0),
        ("1 - 2 - 3", -4.0),
        ("--3", 3.0),
        ("+-+3", -3.0),
        ("2^-2^2", 0.0625),
        ("1.5e-3*1E3", 1.5),
        (".5 + 1.", 1.5),
        ("if(not 1 < 2 or 3 >= 3 and 2 != 2, 1, 0)", 0.0),
        ("2*-3", -6.0),
        ("5 − 2", 3.0),
        ("min(4, 2, 3)", 2.0),
        ("clamp(5, 0, 2)", 2.0),
        ("step(0) + step(1)", 1.0),
        ("mod(7.5, 2)", 1.5),
        ("mod(-1, 3) + mod(5, -3)", 1.0),
        ("sign(0)", 0.0),
        ("ramp(1)", 3.0),
        ("double(4)", 8.0),
    ] {
        assert_eq!(value(text), exact, "{text}");
    }
}

#[test]
fn meanings_are_checked_where_they_stand() {
    for (text, at, what, hint) in [
        ("1 + snn(x)", 4..10, "`snn`", "`sin`"),
        ("doubel(x)", 0..9, "`doubel`", "`double`"),
        ("log(x)", 0..6, "`log`", "`ln(x)`"),
        ("arctan(x)", 0..9, "`arctan`", "`atan`"),
        ("2*w", 2..3, "`w` names nothing", "`x`"),
        ("sin(x, y)", 0..9, "takes 1 argument, not 2", ""),
        ("if(x, 1, 2)", 3..4, "a condition is needed", "x > 0"),
        ("2*(x < y)", 3..8, "a number is needed", "if("),
        ("accel(2 + rate(x))", 0..18, "time derivative", "rate"),
        ("mod(x)", 0..6, "takes 2 arguments, not 1", ""),
        ("mod(x, 0)", 0..9, "undefined", "division by 0"),
        ("x + 1/0", 6..7, "infinite", "division by 0"),
        ("min(x)", 0..6, "two arguments", ""),
    ] {
        let error = resolve(text).map(|expr| print(&expr)).unwrap_err();
        assert_eq!(error.at, at, "{text}: {error}");
        assert!(error.what.contains(what) && error.hint.contains(hint), "{text}: {error}");
    }
}

#[test]
fn hostile_texts_are_refused_without_harm() {
    let refused = |text: String, what: &str| assert!(parse(&text).unwrap_err().what.contains(what));
    for unit in ["(", "-", "+", "not ", "sin(", "2^", "1^-", "a < (", "if(not (-"] {
        refused(unit.repeat(1_000_000), "deep");
    }
    refused(vec!["1"; 20_000].join("+"), "pieces");
    assert_eq!(value(&vec!["1"; 9_000].join("+")), 9_000.0);
    assert_eq!(value(&["x"; 3].join("*")), 0.7 * 0.7 * 0.7);
    let deepest = format!("{}x{}", "(".repeat(MAX_DEPTH), ")".repeat(MAX_DEPTH));
    assert_eq!(value(&deepest), 0.7);
}

#[test]
fn long_expressions_are_evaluated_too() {
    let text = (0..60).map(|i| format!("sin({i} + x)")).collect::<Vec<_>>().join(" + ");
    let exact: f64 = (0..60).map(|i| (f64::from(i) + 0.7).sin()).sum();
    assert!((value(&text) - exact).abs() < 1e-13);
}

#[test]
fn frozen_arms_go_on_smoothly() {
    for (text, positive, negative) in [
        ("abs(x)", 1.0, -1.0),
        ("sign(x)*x", 1.0, -1.0),
        ("min(2*x, x)", 1.0, 2.0),
        ("max(2*x, x)", 2.0, 1.0),
        ("if(x < y, 3*x, 4*x)", 3.0, 4.0),
        ("if(not x >= y, 3*x, 4*x)", 4.0, 3.0),
        ("rate(abs(x)*x)/2", 1.0, -1.0),
    ] {
        let expr = resolve(text).unwrap();
        for x in [-2.0, 0.0, 1e-300, 2.0] {
            for (arm, rate) in [(true, positive), (false, negative)] {
                let at = At { values: [x, -1.3, 2.1], arm: Some(arm) };
                assert_eq!(expr.eval(&at), rate * x, "{text} at {x}");
                assert_eq!(slope(&expr, x, Some(arm)), rate, "{text} at {x}");
            }
        }
    }
}

#[test]
fn a_frozen_modulus_goes_on_smoothly_across_both_its_jumps() {
    let expr = resolve("mod(x, z)").unwrap();
    let at = |x: f64, arm| expr.eval(&At { values: [x, -1.3, 2.0], arm });
    for (x, even) in [(4.0, true), (5.9, true), (6.0, false), (-1.9, false), (-2.1, true)] {
        let here = at(x, None);
        assert_eq!(at(x, Some(even)), here, "at {x}");
        for step in [-0.05, 0.05] {
            assert!((at(x + step, Some(even)) - here - step).abs() < 1e-15, "at {x} + {step}");
        }
        assert_eq!(slope(&expr, x, Some(even)), 1.0);
        let switch = expr.switch(1, &free([x, -1.3, 2.0]));
        assert!(switch == 0.0 && x % 2.0 == 0.0 || (switch > 0.0) == even, "at {x}");
    }
}

#[test]
fn switching_functions_are_positive_on_the_true_arm() {
    for (text, switch) in [
        ("abs(x)", 0.7),
        ("3*sign(x)", 0.7),
        ("min(x, y)", 2.0),
        ("max(x, y)", 2.0),
        ("if(x < y, 1, 0)", -2.0),
        ("if(x >= y, 1, 0)", 2.0),
        ("rate(abs(y))", -1.3),
    ] {
        let expr = resolve(text).unwrap();
        assert_eq!(expr.discontinuities().collect::<Vec<_>>(), [1], "{text}");
        assert_eq!(expr.switch(1, &free([0.7, -1.3, 2.1])), switch, "{text}");
        assert!(expr.switch(2, &free([0.7, -1.3, 2.1])).is_nan());
    }
    assert_eq!(resolve("if(x == y, 1, 0)").unwrap().discontinuities().count(), 0);
}

#[test]
fn what_is_undefined_in_another_arm_does_no_harm() {
    for (text, x) in [
        ("if(x > 0, sqrt(x), 2*x)", 0.0),
        ("if(x > 0, sqrt(x), 2*x)", -1.0),
        ("if(x != 0, x*ln(x)/x^2, 2*x)", 0.0),
        ("max(x, 0)^1.5 + 2*x", 0.0),
        ("max(x, 0)^1.5 + 2*x", -1.0),
        ("max(2*x, min(2*x, -sqrt(-x)))", 0.0),
    ] {
        assert_eq!(slope(&resolve(text).unwrap(), x, None), 2.0, "{text} at {x}");
    }
}

#[test]
fn conditions_hold_or_not() {
    for (text, holds) in
        [("x > 0 and y < 0", true), ("not x > 0", false), ("x == y or z >= 2", true), ("ln(y) < 0", false)]
    {
        assert_eq!(condition(text).holds(&free([0.7, -1.3, 2.1])), holds, "{text}");
    }
    let condition = condition("x > 0 and (y < 0 or z < x)");
    assert_eq!(condition.as_expr().discontinuities().collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(
        condition.text(|named| match named {
            Named::Variable(variable) => variable.to_string(),
            Named::Table(_) => unreachable!(),
        }),
        "0 < x and (y < 0 or z < x)"
    );
}

#[test]
fn leaves_and_derivatives_are_known() {
    let expr = resolve("rate(x*y) + accel(z) + 2").unwrap();
    assert_eq!(expr.variables().collect::<String>(), "xyz");
    assert_eq!(expr.derivatives().map(|(_, second)| second).collect::<Vec<_>>(), [false, true]);
    assert!(expr.depends_on_rates() && expr.depends_on_accelerations() && !expr.is_constant());
    let expr = resolve("rate(x*rate(y))").unwrap();
    assert_eq!(expr.variables().collect::<String>(), "xy");
    assert!(expr.depends_on_accelerations() && resolve("rate(rate(x))") == resolve("accel(x)"));
    let expr = resolve("abs(ramp(1) - 2)*3").unwrap();
    assert!(expr.is_constant() && !expr.depends_on_rates() && expr.literal().is_none());
    let lookups: Vec<_> = resolve("x + ramp(2*x)").unwrap().lookups().map(|(table, of)| (table, print(&of))).collect();
    assert_eq!(lookups, [(7, "2*x".to_string())]);
}

#[test]
fn composing_leaves_out_what_changes_nothing() {
    for (text, printed) in [
        ("0 + x*1 - 0", "x"),
        ("x^1/1", "x"),
        ("0*x + 2*3", "6"),
        ("--x", "x"),
        ("0 - x", "-x"),
        ("x^2.0", "x^2"),
        ("x^0.5", "sqrt(x)"),
        ("rate(3)", "0"),
        ("x - -(y + z)*2", "x - -(y + z)*2"),
        ("(x^2)^-3", "(x^2)^-3"),
        ("x - (y - z) - 1e-7", "x - (y - z) - 1e-7"),
        ("gauge + gauge", "x*y + x*y"),
        ("2*(-3)^x", "2*(-3)^x"),
    ] {
        assert_eq!(print(&resolve(text).unwrap()), printed, "{text}");
    }
    assert_eq!(resolve("gauge + gauge").unwrap().ops.len(), 4);
}
