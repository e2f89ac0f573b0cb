//! An initial state as it is asked for, by names; and what is worth saying about what was found.

use crate::assembly::{Assembled, AssemblyRequest, Closed};
use crate::builder::unknown;
use crate::compile::Compiled;
use crate::error::CompileError;
use crate::expr::spell;
use crate::gauges::ModelExpr;
use crate::mechanism::Mechanism;
use serde_json::{json, Value};
use std::collections::{BTreeMap, HashSet};

/// A coordinate is as guessed if it differs by less, m or rad: it is printed with nine decimals.
const AS_GUESSED: f64 = 1e-9;

type Named = BTreeMap<String, f64>;

/// What an initial state is asked to be: coordinates and gauges, points and signs of expressions by name.
#[derive(Clone, Debug, Default)]
pub struct Initial {
    /// Values that must hold.
    pub fixed: Named,
    /// Values that should be near.
    pub guess: Named,
    /// Rates that must hold.
    pub rates: Named,
    /// Places of points that must hold, m.
    pub points: BTreeMap<String, [f64; 2]>,
    /// Expressions that must be positive or negative.
    pub branch: BTreeMap<String, i64>,
    /// A state of the assembly that is wished for: it is reached from there, and what is neither fixed nor guessed stays near.
    pub from: Option<Closed>,
}

impl Compiled {
    /// All parameters, those that are named overruled.
    ///
    /// # Errors
    /// A name of no parameter; numbers that cannot be.
    pub fn parameters(&self, values: &BTreeMap<String, f64>) -> Result<Vec<f64>, CompileError> {
        let place = |name: &String| {
            self.mechanism.parameters.iter().position(|p| p.name == *name).ok_or_else(|| {
                CompileError::from(name, unknown("parameter", name, self.mechanism.parameters.iter().map(|p| &p.name)))
            })
        };
        let given: Result<Vec<_>, _> = values.iter().map(|(name, x)| Ok((place(name)?, *x))).collect();
        let p = self.mechanism.parameters_with(&given?);
        self.mechanism.check(&p)?;
        Ok(p)
    }

    /// What an initial state is asked to be, with its names looked up.
    ///
    /// # Errors
    /// Names that mean nothing; values that are not finite.
    pub fn wish(&mut self, asked: &Initial) -> Result<AssemblyRequest, CompileError> {
        let held = self.gauges(&asked.fixed)?;
        let near = self.gauges(&asked.guess)?;
        let held_rates = self.gauges(&asked.rates)?;
        let signs =
            asked.branch.iter().map(|(text, sign)| Ok((text.clone(), self.observable(text)?, sign.signum() as i8)));
        let branch = signs.collect::<Result<_, CompileError>>()?;
        let places = asked.points.iter().flat_map(|(name, [x, y])| {
            let name = spell(name);
            [(format!("x({name})"), *x), (format!("y({name})"), *y)]
        });
        let placed = self.read(places.map(|(text, x)| (text.clone(), text, x)).collect())?;
        let m = &self.mechanism;
        let names: Vec<&String> = (0..m.freedom()).map(|i| &m.coordinate(i).name).collect();
        let own: HashSet<&String> = names.iter().copied().collect();
        let known = |i: usize| asked.from.as_ref().map_or(0.0, |from| from.q[i]);
        let value = |(i, name): (usize, &&String)| {
            asked.fixed.get(*name).or_else(|| asked.guess.get(*name)).copied().unwrap_or_else(|| known(i))
        };
        Ok(AssemblyRequest {
            start: names.iter().enumerate().map(value).collect(),
            start_rates: names.iter().map(|name| *asked.rates.get(*name).unwrap_or(&0.0)).collect(),
            held: held.into_iter().chain(placed).collect(),
            near: near.into_iter().filter(|(name, ..)| !own.contains(name)).collect(),
            held_rates,
            branch,
            free: names.iter().map(|name| !asked.fixed.contains_key(*name)).collect(),
            from: asked.from.clone(),
        })
    }

    fn gauges(&mut self, named: &Named) -> Result<Vec<(String, ModelExpr, f64)>, CompileError> {
        self.read(named.iter().map(|(name, x)| (name.clone(), spell(name).into_owned(), *x)).collect())
    }

    /// Name, expression and value with the expression read.
    fn read(&mut self, asked: Vec<(String, String, f64)>) -> Result<Vec<(String, ModelExpr, f64)>, CompileError> {
        let read = |(name, text, x): (String, String, f64)| match x.is_finite() {
            true => Ok((name, self.observable(&text)?, x)),
            false => {
                Err(CompileError::new(format!("initial.{name}"), format!("{x} is no number"), "give a finite number"))
            }
        };
        asked.into_iter().map(read).collect()
    }
}

impl Assembled {
    /// `branch`: the assembly taken and the others, where there are several; `adjusted`: what is not as guessed; `behind`:
    /// contacts on whose wrong side a body seems to be.
    pub fn notes(&self, m: &Mechanism, asked: &Initial) -> Value {
        let name = |i: usize| &m.coordinate(i).name;
        let values = |q: &[f64]| {
            let each = q.iter().enumerate().map(|(i, x)| format!("{} = {x:.6}", name(i)));
            each.collect::<Vec<_>>().join(", ")
        };
        let mut branch: Vec<String> = self.others.iter().map(|o| format!("other assembly: {}", values(o))).collect();
        if !branch.is_empty() {
            branch.insert(0, format!("assembled: {}", values(&self.q)));
        }
        let coordinates = self.q.iter().enumerate().map(|(i, x)| (name(i), x));
        let adjusted = coordinates.chain(self.near.iter().map(|(name, x)| (name, x))).filter_map(|(name, x)| {
            let guess = asked.guess.get(name).filter(|guess| (*guess - x).abs() > AS_GUESSED)?;
            Some(format!("{name}: guess {guess:.6}, assembled {x:.9}"))
        });
        json!({"branch": branch, "adjusted": adjusted.collect::<Vec<_>>(), "behind": self.behind, "gap": self.gap})
    }
}
