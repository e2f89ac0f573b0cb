//! Symbolic equations of mechanisms thrown together: expressed at one state, they hold at another.

use crate::random::*;
use crate::random_mechanisms::{recipe, HOME, MECHANISMS};
use crate::rng::{seeds, Rng};
use freebody::dynamics::Workspace;
use freebody::free_bodies::free_bodies;
use freebody::symbolic::{answer, Query, Setting};
use serde_json::{json, Value};
use std::collections::HashMap;

/// Part of the largest term of an equation that is round-off: its terms are multiplied out, and cancel.
const ROUND_OFF: f64 = 1e-8;

/// Most bodies of a mechanism whose equations are written out.
const BODIES: usize = 2;

type Numbers = HashMap<(String, u64), f64>;

fn fraction(text: &str) -> f64 {
    let mut parts = text.split('/').map(|part| part.parse::<f64>().unwrap());
    parts.next().unwrap() / parts.next().unwrap_or(1.0)
}

/// The value of a tree, and the size of its largest term.
fn value(tree: &Value, numbers: &Numbers) -> (f64, f64) {
    let all = |of: &Value| -> Vec<(f64, f64)> { of.as_array().unwrap().iter().map(|t| value(t, numbers)).collect() };
    if let Some(number) = tree.get("num") {
        let x = number.as_f64().unwrap_or_else(|| fraction(number.as_str().unwrap()));
        (x, x.abs())
    } else if let Some(name) = tree.get("sym") {
        let name = name.as_str().unwrap();
        let key = (name.to_string(), tree["dots"].as_u64().unwrap());
        let x = if name == "pi" { std::f64::consts::PI } else { numbers[&key] };
        (x, x.abs())
    } else if let Some(of) = tree.get("add") {
        let of = all(of);
        (of.iter().map(|x| x.0).sum(), of.iter().fold(0.0, |m, x| x.1.max(m)))
    } else if let Some(of) = tree.get("mul") {
        all(of).into_iter().fold((1.0, 1.0), |(x, size), (y, other)| (x * y, size * other))
    } else if let Some(of) = tree.get("pow") {
        let exponent = fraction(of[1].as_str().unwrap());
        let (x, size) = value(&of[0], numbers);
        let y = if exponent.fract() == 0.0 { x.powi(exponent as i32) } else { x.powf(exponent) };
        (y, y.abs().max(if exponent > 0.0 { size.powf(exponent) } else { 0.0 }))
    } else {
        let of = all(&tree["args"]);
        let y = match tree["fn"].as_str().unwrap() {
            "cos" => of[0].0.cos(),
            "sin" => of[0].0.sin(),
            "exp" => of[0].0.exp(),
            "ln" => of[0].0.ln(),
            "abs" => of[0].0.abs(),
            "atan2" => of[0].0.atan2(of[1].0),
            other => panic!("{other} in {tree}"),
        };
        (y, y.abs())
    }
}

/// All symbols at the present state of a solved balance.
fn numbers(workspace: &mut Workspace, bench: &Bench, state: &State) -> Numbers {
    let label = free_bodies(workspace).unwrap();
    let m = &bench.compiled.mechanism;
    let mut numbers = Numbers::new();
    numbers.insert(("t".into(), 0), state.t);
    for i in 0..m.freedom() {
        let name = &m.coordinate(i).name;
        let values = [state.q[i], state.u[i], label["accelerations"][name].as_f64().unwrap()];
        numbers.extend(values.into_iter().enumerate().map(|(dots, x)| ((name.clone(), dots as u64), x)));
    }
    for load in label["loads"].as_array().unwrap() {
        if let Some(x) = load["value"].as_f64() {
            numbers.insert((load["symbol"].as_str().unwrap().into(), 0), x);
        }
    }
    numbers
}

fn questions(bench: &Bench) -> Vec<Query> {
    let m = &bench.compiled.mechanism;
    let coordinates = (0..m.freedom()).map(|i| json!({"ask": "coordinate", "name": m.coordinate(i).name}));
    let bodies = m.listed_bodies();
    let each = bodies.iter().flat_map(|&b| {
        let name = &m.bodies[b].name;
        [
            json!({"ask": "equation", "bodies": [name], "along": "x"}),
            json!({"ask": "equation", "bodies": [name], "about": "centre"}),
        ]
    });
    let all: Vec<Value> = coordinates
        .chain(each)
        .chain([json!({"ask": "lagrange"}), json!({"ask": "rows"}), json!({"ask": "energy"})])
        .collect();
    serde_json::from_value(Value::Array(all)).unwrap()
}

fn sum(of: Vec<Value>) -> Value {
    json!({"add": of})
}

fn less(a: &Value, b: &Value) -> Value {
    json!({"add": [a, {"mul": [{"num": -1}, b]}]})
}

/// Every equation among the answers, as what vanishes, with what it is.
fn equations(answers: &Value) -> Vec<(String, Value)> {
    let mut found = vec![];
    for answer in answers.as_array().unwrap() {
        if let Some(bodies) = answer.get("bodies") {
            let (left, right, linear) = (&answer["left"], &answer["right"], &answer["linear"]);
            let trees = |word: &str| answer[word].as_array().unwrap().iter().map(|part| part["tree"].clone()).collect();
            let held =
                linear["coefficients"].as_array().unwrap().iter().map(|c| json!({"mul": [c["tree"], c["symbol"]]}));
            let what = |how: &str| format!("{how} {} of {bodies}", answer["test"]["kind"]);
            found.push((what("balance"), less(right, left)));
            found.push((what("loads in the balance"), less(&sum(trees("loads")), left)));
            found.push((what("bodies in the balance"), less(&sum(trees("inertia")), right)));
            found.push((what("linear balance"), sum(held.chain([linear["rest"].clone()]).collect())));
        }
        for equation in answer.get("equations").and_then(Value::as_array).into_iter().flatten() {
            found.push((format!("Lagrange {}", equation["coordinate"]), equation["residual"].clone()));
        }
        for row in answer.as_array().into_iter().flatten() {
            found.push((format!("row {}", row["name"]), row["acceleration"].clone()));
        }
    }
    found
}

#[test]
fn equations_told_at_one_state_hold_at_another() {
    let mut label = 0;
    for seed in seeds(0..MECHANISMS / 2, 3) {
        let recipe = recipe(seed);
        let recipe = Recipe { odd: false, bodies: recipe.bodies.min(BODIES), idle: seed % 2 == 1, ..recipe };
        let bench = Bench::new(&recipe.draw(seed, HOME));
        let mut workspace = bench.balance();
        let mut rng = Rng::new(seed);
        let mut go = |workspace: &mut Workspace| {
            let state = bench.state(workspace, &mut rng, 0.05).expect("a state");
            workspace.move_to(state.t, &state.q, &state.u);
            state
        };
        go(&mut workspace);
        let answers = match answer(&mut workspace, &Setting::default(), &questions(&bench)) {
            Ok(answers) => answers,
            Err(trouble) => {
                assert_eq!(trouble.name(), "too_large", "seed {seed}: {trouble:?}");
                continue;
            }
        };
        let state = go(&mut workspace);
        let mut numbers = numbers(&mut workspace, &bench, &state);
        for (name, variable) in answers["symbols"].as_object().unwrap() {
            numbers.entry((name.clone(), 0)).or_insert(variable["value"].as_f64().unwrap());
        }
        let energies = answers["answers"].as_array().unwrap().last().unwrap();
        for (what, known) in [("kinetic", workspace.kinetic_energy()), ("potential", workspace.potential_energy())] {
            let (x, size) = value(&energies[what], &numbers);
            assert!((x - known).abs() <= ROUND_OFF * size.max(1.0), "seed {seed}: {what} energy {x} for {known}");
        }
        for (what, residual) in equations(&answers["answers"]) {
            assert!(!residual.to_string().contains("null"), "seed {seed}, {what} is undefined: {}", bench.label());
            let (x, size) = value(&residual, &numbers);
            assert!(x.abs() <= ROUND_OFF * size.max(1.0), "seed {seed}, {what}: {x} of {size}, {}", bench.label());
            label += 1;
        }
    }
    assert!(label > 50, "{label}");
}

/// Numbers that are no exponents, variables, operations and functions of a tree.
fn signs(tree: &Value) -> usize {
    let of = ["add", "mul", "args"].into_iter().filter_map(|word| tree.get(word)?.as_array());
    let base = tree.get("pow").map_or(0, |of| signs(&of[0]));
    1 + base + of.flatten().map(signs).sum::<usize>()
}

#[test]
fn bodies_are_written_of_balances_with_no_more_signs_than_said() {
    for seed in seeds(0..12, 3) {
        let bench = Bench::new(&Recipe { odd: false, bodies: BODIES, ..recipe(seed) }.draw(seed, HOME));
        let mut workspace = bench.balance();
        let state = bench.state(&mut workspace, &mut Rng::new(seed), 0.05).expect("a state");
        workspace.move_to(state.t, &state.q, &state.u);
        let mut written = |within: usize| {
            let question = json!([{"ask": "equation", "bodies": [], "along": "x", "inertia_within": within}]);
            let question: Vec<Query> = serde_json::from_value(question).unwrap();
            let answers = answer(&mut workspace, &Setting::default(), &question).unwrap();
            let balance = answers["answers"][0].clone();
            (signs(&balance["left"]) + signs(&balance["right"]), balance["inertia"].as_array().unwrap().len())
        };
        let (size, bodies) = written(usize::MAX);
        assert!(bodies > 0, "seed {seed}");
        assert_eq!([written(size).1, written(size - 1).1], [bodies, 0], "seed {seed}: {size} signs");
    }
}
