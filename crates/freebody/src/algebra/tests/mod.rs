mod writing;

use super::{session, Symbol, Tree, Variable};
use crate::scalar::{Jet, Scalar};
use proptest::prelude::*;

const NAMES: [&str; 4] = ["a", "b", "u", "v"];

fn variable(name: &str, value: f64) -> Symbol {
    Symbol::variable(Variable::new(name, 0), value)
}

/// A random expression, to be built over any scalar.
#[derive(Clone, Debug)]
enum Random {
    Letter(usize),
    Constant(f64),
    Add(Box<Random>, Box<Random>),
    Subtract(Box<Random>, Box<Random>),
    Multiply(Box<Random>, Box<Random>),
    Divide(Box<Random>, Box<Random>),
    Whole(Box<Random>, i32),
    /// √(1 + x²), (1 + x²)^c, ln(2 + x²): safe for all arguments.
    Root(Box<Random>),
    Power(Box<Random>, f64),
    Ln(Box<Random>),
    /// exp(sin x): stays small.
    Exp(Box<Random>),
    Sin(Box<Random>),
    Cos(Box<Random>),
    Direction(Box<Random>, Box<Random>),
}

impl Random {
    fn build<S: Scalar>(&self, variables: &[S]) -> S {
        self.nudged(variables, 0.0)
    }
    /// The same with every constant changed by a small part of itself.
    fn nudged<S: Scalar>(&self, variables: &[S], by: f64) -> S {
        let of = |x: &Random| x.nudged(variables, by);
        match self {
            Random::Letter(i) => variables[*i],
            Random::Constant(x) => S::of(*x * (1.0 + by)),
            Random::Add(a, b) => of(a) + of(b),
            Random::Subtract(a, b) => of(a) - of(b),
            Random::Multiply(a, b) => of(a) * of(b),
            // Undefined at once, not infinite first.
            Random::Divide(a, b) => of(a) / proper(of(b)),
            Random::Whole(a, n) if *n < 0 => proper(of(a)).powi(*n),
            Random::Whole(a, n) => of(a).powi(*n),
            Random::Root(a) => (S::one() + of(a).powi(2)).sqrt(),
            Random::Power(a, e) => (S::one() + of(a).powi(2)).powf(S::of(*e)),
            Random::Ln(a) => (S::of(2.0) + of(a).powi(2)).ln(),
            Random::Exp(a) => of(a).sin_cos().0.exp(),
            Random::Sin(a) => of(a).sin_cos().0,
            Random::Cos(a) => of(a).sin_cos().1,
            // −0 is no number of its own.
            Random::Direction(a, b) => (of(a) + S::zero()).atan2(of(b) + S::zero()),
        }
    }
}

fn proper<S: Scalar>(divisor: S) -> S {
    S::select(divisor.value() == 0.0, S::of(f64::NAN), divisor)
}

fn expressions() -> impl Strategy<Value = Random> {
    let constant =
        prop::sample::select(vec![0.0, 1.0, -1.0, 2.0, 0.5, 1.5, 9.81, 0.123_456_789_012_3, 0.523_598_775_598_298_8]);
    let variable =
        prop_oneof![3 => (0..NAMES.len()).prop_map(Random::Letter), 1 => constant.prop_map(Random::Constant)];
    variable.prop_recursive(5, 14, 2, |x| {
        let one = || x.clone().prop_map(Box::new);
        let two = || (one(), one());
        prop_oneof![
            3 => two().prop_map(|(a, b)| Random::Add(a, b)),
            2 => two().prop_map(|(a, b)| Random::Subtract(a, b)),
            4 => two().prop_map(|(a, b)| Random::Multiply(a, b)),
            2 => two().prop_map(|(a, b)| Random::Divide(a, b)),
            1 => (one(), -2..4_i32).prop_map(|(a, n)| Random::Whole(a, n)),
            1 => one().prop_map(Random::Root),
            1 => (one(), prop::sample::select(vec![1.5, -0.5, 0.25])).prop_map(|(a, e)| Random::Power(a, e)),
            1 => one().prop_map(Random::Ln),
            1 => one().prop_map(Random::Exp),
            2 => one().prop_map(Random::Sin),
            2 => one().prop_map(Random::Cos),
            1 => two().prop_map(|(a, b)| Random::Direction(a, b)),
        ]
    })
}

fn points() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(prop_oneof![-2.0..-0.1, 0.1..2.0])
}

/// Where rounding could decide, nothing is judged: the value is taken at three neighbours.
fn settled(random: &Random, at: [f64; 4]) -> Option<f64> {
    let value = random.build(&at);
    let moved = |e: f64| random.nudged(&[at[0] + e, at[1] - e, at[2] + 0.7 * e, at[3] + 0.3 * e], e);
    let steady = |e: f64| (moved(e) - value).abs() <= 1e-4 * value.abs().max(1.0);
    (value.is_finite() && value.abs() < 1e6 && steady(1e-7) && steady(-1e-7)).then_some(value)
}

fn values(at: [f64; 4]) -> impl Fn(&Variable) -> f64 {
    move |variable| at[NAMES.iter().position(|name| *name == variable.name).unwrap()]
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-7 * a.abs().max(b.abs()).max(1.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, max_global_rejects: 40_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rewriting_keeps_the_value(random in expressions(), at in points()) {
        let Some(expected) = settled(&random, at) else { return Ok(()) };
        session(|| {
            let variables: Vec<Symbol> = NAMES.iter().zip(at).map(|(name, x)| variable(name, x)).collect();
            let symbol = random.build(&variables);
            let value = symbol.evaluate(&values(at));
            prop_assert!(close(value, expected), "{value} instead of {expected}");
            prop_assert!(close(symbol.value(), expected));
            let written = symbol.tree().evaluate(&values(at), &|_, _| f64::NAN);
            prop_assert!(close(written, expected), "written {written} instead of {expected}: {:?}", symbol.tree());
            Ok(())
        })?;
    }

    #[test]
    fn derivatives_are_those_of_jets(random in expressions(), at in points()) {
        prop_assume!(settled(&random, at).is_some());
        let jets: Vec<Jet> = (0..4).map(|i| Jet::new(at[i], if i == 0 { 1.0 } else { 0.0 }, 0.0)).collect();
        let expected = random.build(&jets).d1;
        prop_assume!(expected.is_finite() && expected.abs() < 1e4);
        session(|| {
            let variables: Vec<Symbol> = NAMES.iter().zip(at).map(|(name, x)| variable(name, x)).collect();
            let slope = random.build(&variables).derivative(&Variable::new("a", 0));
            let value = slope.evaluate(&values(at));
            prop_assert!((value - expected).abs() <= 1e-5 * expected.abs().max(1.0), "{value} instead of {expected}");
            Ok(())
        })?;
    }
}

/// Identities, as differences that must vanish in the canonical form.
#[test]
fn what_vanishes_identically_is_zero() {
    type Difference = fn([Symbol; 4]) -> Symbol;
    fn s(x: Symbol) -> Symbol {
        x.sin_cos().0
    }
    fn c(x: Symbol) -> Symbol {
        x.sin_cos().1
    }
    fn k(x: f64) -> Symbol {
        Symbol::of(x)
    }
    const PI: f64 = std::f64::consts::PI;
    let identities: &[(&str, Difference)] = &[
        ("cos² + sin² = 1", |[a, ..]| c(a).powi(2) + s(a).powi(2) - k(1.0)),
        ("cos⁴ − sin⁴ = cos 2a", |[a, ..]| c(a).powi(4) - s(a).powi(4) - c(a + a)),
        ("addition", |[a, b, ..]| s(a + b) - s(a) * c(b) - c(a) * s(b)),
        ("addition of a direction", |[a, u, v, _]| {
            let (sine, cosine) = (a + u.atan2(v)).sin_cos();
            (sine.powi(2) + cosine.powi(2)) - k(1.0)
        }),
        ("double angle", |[a, ..]| s(a.scale(2.0)) - (s(a) * c(a)).scale(2.0)),
        ("30°", |[a, ..]| s(a + k(PI / 6.0)) - s(a) * k(3.0).sqrt().scale(0.5) - c(a).scale(0.5)),
        ("a constant angle", |[a, ..]| c(a + k(0.3)) - c(a) * c(k(0.3)) + s(a) * s(k(0.3))),
        ("right angle", |[a, ..]| s(a + k(PI / 2.0)) - c(a)),
        ("binomial", |[a, b, ..]| (a + b).powi(2) - a * a - (a * b).scale(2.0) - b * b),
        ("quotient", |[a, b, ..]| (a * a - b * b) / (a - b) - a - b),
        ("fractions", |[a, b, ..]| a / (a + b) + b / (a + b) - k(1.0)),
        ("scaled fractions", |[a, b, u, _]| (u * a) / (u * a * k(2.0) + u * b * k(2.0)) - k(0.5) * a / (a + b)),
        ("nested fractions", |[a, b, u, v]| k(1.0) / (a / b + u / v) - b * v / (a * v + b * u)),
        ("1/cos² = 1 + tan²", |[a, ..]| k(1.0) / c(a).powi(2) - k(1.0) - (s(a) / c(a)).powi(2)),
        ("sin 2a / cos a", |[a, ..]| s(a + a) / c(a) - s(a).scale(2.0)),
        ("half angles", |[a, b, ..]| (c(a + b) + c(a - b)) / c(b) - c(a).scale(2.0)),
        ("√a²", |[a, ..]| (a * a).sqrt() - a),
        ("√(sum)²", |[a, b, u, v]| (a * u + b * v).powi(2).sqrt() - (a * u + b * v)),
        ("(√s)²", |[a, b, ..]| (a * a + b).sqrt().powi(2) - a * a - b),
        ("√2 √3 = √6", |_| k(2.0).sqrt() * k(3.0).sqrt() - k(6.0).sqrt()),
        ("length", |[a, b, ..]| ((b * c(a)).powi(2) + (b * s(a)).powi(2)).sqrt() - b),
        ("√cos²", |[a, ..]| c(a).powi(2).sqrt() - c(a)),
        ("direction", |[a, b, ..]| (b * s(a)).atan2(b * c(a)) - a),
        ("exponentials", |[a, b, ..]| a.exp() * b.exp() - (a + b).exp()),
        ("decimals", |_| k(0.1) + k(0.2) - k(0.3)),
        ("π", |_| k(PI / 3.0) * k(3.0) - k(PI)),
    ];
    for (name, difference) in identities {
        session(|| {
            let variables = [("a", 0.7), ("b", 1.3), ("u", 0.4), ("v", 0.9)].map(|(name, x)| variable(name, x));
            let left = difference(variables);
            assert!(left.is_zero(), "{name}: {:?}", left.tree());
        });
    }
}

#[test]
fn a_root_takes_the_sign_of_the_values() {
    session(|| {
        let x = variable("x", -2.0);
        assert_eq!((x * x).sqrt(), -x);
        assert_eq!(Symbol::zero().atan2(x), Symbol::of(std::f64::consts::PI));
    });
}

#[test]
fn a_root_of_the_square_of_a_rate_is_its_absolute_value() {
    session(|| {
        let [rate, other] = [("x", 2.0), ("y", 5.0)].map(|(name, x)| Symbol::variable(Variable::new(name, 1), x));
        let [speed, together] = [rate, rate - other].map(|s| (s * s).sqrt());
        assert_ne!(speed, rate);
        assert_eq!(speed * speed, rate * rate);
        assert_eq!(together, (other - rate).powi(2).sqrt());
        assert_eq!(rate.powi(4).sqrt(), rate * rate);
    });
}

#[test]
fn equal_work_gives_the_same_tree() {
    let work = || {
        session(|| {
            let [a, b] = ["a", "b"].map(|name| variable(name, 0.8));
            ((a + b).powi(3) * (a - b).sin_cos().1 / (a + b * b)).tree()
        })
    };
    assert_eq!(work(), work());
}

#[test]
fn a_linear_symbol_has_a_coefficient_and_a_rest() {
    session(|| {
        let [a, b, u] = ["a", "b", "u"].map(|name| variable(name, 0.8));
        let (sum, of) = (a * b * u + a * b.sin_cos().0, Variable::new("u", 0));
        assert_eq!(sum.coefficient_of(&of), Some(a * b));
        assert_eq!(sum.without(std::slice::from_ref(&of)), a * b.sin_cos().0);
        assert_eq!((u * u).coefficient_of(&of), None);
        assert_eq!(sum.substitute(&[(of, a)]), a * a * b + a * b.sin_cos().0);
    });
}

#[test]
fn what_is_undefined_stays_so() {
    session(|| {
        let a = variable("a", 1.0);
        let infinite = a / (a - a);
        assert!((infinite * Symbol::zero()).evaluate(&|_| 1.0).is_nan());
        assert!(matches!(infinite.tree(), Tree::Num { .. }));
    });
}

#[test]
fn a_function_that_is_known_by_name_has_its_derivatives() {
    session(|| {
        let rule = || -> super::Rule { std::rc::Rc::new(|x, order| [x * x, 2.0 * x, 2.0][order as usize]) };
        let a = variable("a", 1.5);
        let f = (a * a).function("cam", 0, rule());
        assert_eq!(f.derivative(&Variable::new("a", 0)), (a * a).function("cam", 1, rule()) * a.scale(2.0));
        assert_eq!(f.evaluate(&|_| 3.0), 81.0);
    });
}
