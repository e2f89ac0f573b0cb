//! How expressions are written.

use crate::algebra::{session, Number, Symbol, Tree, Variable};
use crate::scalar::{Jet, Scalar};

/// A tree as plain text: `θ''` has two dots, factors are separated by spaces.
fn text(tree: &Tree) -> String {
    match tree {
        Tree::Num { num: Number::Exact(text) } => text.clone(),
        Tree::Num { num: Number::Float(x) } => x.to_string(),
        Tree::Sym { sym, dots } => format!("{sym}{}", "'".repeat(*dots as usize)),
        Tree::Add { add } => add.iter().map(text).collect::<Vec<_>>().join(" + ").replace("+ -", "- "),
        Tree::Mul { mul } => {
            let parts: Vec<String> = mul.iter().map(bracketed).collect();
            match parts.join(" ") {
                product if product.starts_with("-1 ") => format!("-{}", &product[3..]),
                product => product,
            }
        }
        Tree::Pow { pow: (base, e) } => format!("{}^{e}", bracketed(base)),
        Tree::Fn { name, args } => format!("{name}({})", args.iter().map(text).collect::<Vec<_>>().join(", ")),
    }
}
fn bracketed(tree: &Tree) -> String {
    match tree {
        Tree::Add { .. } => format!("({})", text(tree)),
        _ => text(tree),
    }
}

fn sin(x: Symbol) -> Symbol {
    x.sin_cos().0
}
fn cos(x: Symbol) -> Symbol {
    x.sin_cos().1
}
fn variables<const N: usize>(names: [&str; N]) -> [Symbol; N] {
    let mut value = 0.6;
    names.map(|name| {
        value += 0.17;
        let dots = name.chars().rev().take_while(|&c| c == '\'').count();
        Symbol::variable(Variable::new(name.trim_end_matches('\''), dots as u8), value)
    })
}
fn written(symbol: Symbol) -> String {
    text(&symbol.tree())
}

#[test]
fn small_forms() {
    session(|| {
        let [m, l, k, a, b] = variables(["m", "l", "M", "a", "b"]);
        let half = |x: Symbol| x.scale(0.5);
        let forms = [
            (Symbol::zero(), "0"),
            (m * Symbol::of(9.81), "9.81 m"),
            (m * l * l * Symbol::of(1.0 / 3.0), "1/3 m l^2"),
            (half(a) + half(b), "1/2 (a + b)"),
            (m * l * l / Symbol::of(4.0) + k * l * l, "(1/4 m + M) l^2"),
            (sin(a) * cos(a), "sin(a) cos(a)"),
            (sin(a).powi(2), "sin(a)^2"),
            (cos(a) * cos(b), "cos(a) cos(b)"),
            (sin(a) * cos(b), "sin(a) cos(b)"),
            (sin(a) * sin(b), "sin(a) sin(b)"),
            (sin(a) * sin(b) + cos(a) * cos(b), "cos(a - b)"),
            (sin(a) / cos(a), "tan(a)"),
            (k + m * sin(a).powi(2), "m sin(a)^2 + M"),
            (m * Symbol::of(2.0) / (m + k), "2 m (m + M)^-1"),
            (a / (a + b), "a (a + b)^-1"),
            ((a + b) * (l + m), "(m + l) (a + b)"),
            ((a * a + b * b).sqrt(), "(a^2 + b^2)^1/2"),
            (cos(Symbol::of(std::f64::consts::PI / 6.0)) * m, "1/2 3^1/2 m"),
            (a - a * cos(b), "a (1 - cos(b))"),
            (m * (b - a), "(b - a) m"),
            (m * (k * a - k * b - l), "((a - b) M - l) m"),
        ];
        for (symbol, expected) in forms {
            assert_eq!(written(symbol), expected);
        }
    });
}

#[test]
fn rates_are_gathered_into_squares() {
    session(|| {
        let [m, l, p, q, u, v] = variables(["m", "l", "p'", "q'", "p''", "q''"]);
        let b = variables(["b"])[0];
        assert_eq!(written(m * l * sin(b) * (p + q).powi(2)), "m l sin(b) (p' + q')^2");
        assert_eq!(written(m * l * (u + v)), "m l (p'' + q'')");
        let sum = m * l * (u + v) + m * sin(b) * (p * p + (p * q).scale(2.0)) + l * q;
        assert_eq!(written(sum), "m (l (p'' + q'') + sin(b) p' (p' + 2 q')) + l q'");
    });
}

/// The moment of the outer force of a double pendulum about its pivot, less that of the weights.
fn double_pendulum() -> [Symbol; 2] {
    let [m1, m2, l1, l2, g] = variables(["m1", "m2", "l1", "l2", "g"]);
    let [q, qd, qdd, p, pd, pdd] = variables(["q", "q'", "q''", "p", "p'", "p''"]);
    let (q, p) = (Jet::new(q, qd, qdd), Jet::new(p, pd, pdd));
    let along = |l: Symbol, angle: Jet<Symbol>| {
        let (s, c) = angle.sin_cos();
        [Jet::constant(l) * s, -(Jet::constant(l) * c)]
    };
    let (upper, arm) = (along(l1, q), along(l2, p));
    let lower = [upper[0] + arm[0], upper[1] + arm[1]];
    let moment =
        |at: [Jet<Symbol>; 2], of: [Jet<Symbol>; 2], m: Symbol| m * (at[0].d0 * (of[1].d2 + g) - at[1].d0 * of[0].d2);
    [moment(upper, upper, m1) + moment(upper, lower, m2), moment(arm, lower, m2)]
}

#[test]
fn a_double_pendulum_looks_as_in_a_textbook() {
    session(|| {
        let [upper, lower] = double_pendulum();
        assert_eq!(written(upper), "l1 ((m1 + m2) (l1 q'' + g sin(q)) + m2 l2 (cos(q - p) p'' + sin(q - p) p'^2))");
        assert_eq!(written(lower), "m2 l2 (l1 (cos(q - p) q'' - sin(q - p) q'^2) + l2 p'' + g sin(p))");
    });
}

#[test]
fn what_is_gathered_alone_keeps_its_sign_and_numbers() {
    session(|| {
        let [m, l, b, a, w, i] = variables(["m", "l", "b", "a''", "w'", "I"]);
        let [x, y] = variables(["x", "y"]);
        let inertia = i * a + m * l * (b * (cos(x - y) * a - sin(x - y) * w * w) + l * a);
        assert!(!written(inertia).contains("(-"), "{}", written(inertia));
        let [p, q, r] = variables(["p'", "q'", "r'"]);
        let (n, c) = (|a: f64, b: f64| Symbol::of(a / b), cos(x - y));
        let energy = n(7.0, 6.0) * p * p + n(2.0, 3.0) * q * q + n(3.0, 2.0) * c * p * q + n(1.0, 6.0) * r * r;
        assert!(!written(energy).contains("/9"), "{}", written(energy));
    });
}

#[test]
fn a_tree_can_be_grouped_by_unknowns() {
    session(|| {
        let [_, lower] = double_pendulum();
        let by = [Variable::new("q", 2), Variable::new("p", 2)];
        assert_eq!(
            text(&lower.tree_by(&by)),
            "m2 l1 l2 cos(q - p) q'' + m2 l2^2 p'' - m2 l1 l2 sin(q - p) q'^2 + m2 l2 g sin(p)"
        );
    });
}

#[test]
fn a_cart_and_pole_has_its_usual_denominator() {
    session(|| {
        let [c, m, l, g, q, qd] = variables(["M", "m", "l", "g", "q", "q'"]);
        let x = m * sin(q) * (l * qd * qd + g * cos(q)) / (c + m * sin(q).powi(2));
        assert_eq!(written(x), "m (M + m sin(q)^2)^-1 sin(q) (l q'^2 + g cos(q))");
    });
}

#[test]
fn a_tree_is_the_json_that_is_agreed_on() {
    session(|| {
        let [m, q] = variables(["m", "q'"]);
        let json = serde_json::to_string(&(m * q * q * Symbol::of(1.5) + cos(m)).tree()).unwrap();
        let term = r#"{"mul":[{"num":"3/2"},{"sym":"m","dots":0},{"pow":[{"sym":"q","dots":1},"2"]}]}"#;
        let rest = r#"{"fn":"cos","args":[{"sym":"m","dots":0}]}"#;
        assert_eq!(json, format!(r#"{{"add":[{term},{rest}]}}"#));
    });
}

/// The equation of the base of a hanging chain of ten links: thousands of terms, soon written.
#[test]
fn ten_links_are_written_in_time() {
    const LINKS: usize = 10;
    session(|| {
        let number = |name: &str, i: usize, dots| {
            Symbol::variable(Variable::new(format!("{name}{i}"), dots), 0.3 + 0.1 * i as f64)
        };
        let g = Symbol::variable(Variable::new("g", 0), 9.81);
        let (mut x, mut y) = (Jet::constant(Symbol::zero()), Jet::constant(Symbol::zero()));
        let mut angle = Jet::constant(Symbol::zero());
        let mut moment = Symbol::zero();
        for i in 0..LINKS {
            angle += Jet::new(number("q", i, 0), number("q", i, 1), number("q", i, 2));
            let (s, c) = angle.sin_cos();
            let l = Jet::constant(number("l", i, 0));
            (x, y) = (x + l * s, y - l * c);
            moment += number("m", i, 0) * (x.d0 * (y.d2 + g) - y.d0 * x.d2);
        }
        let start = std::time::Instant::now();
        let tree = moment.tree();
        assert!(start.elapsed().as_secs() < 10);
        assert!((3000..9000).contains(&tree.signs()), "{}", tree.signs());
    });
}
