//! The equations of a mechanism in letters: the same mechanics, read with symbols.
//!
//! A state is taken over letter by letter (parameters, coordinates, rates, accelerations, unknown loads), with its numbers
//! beside it: which contacts hold and which arm of a law is taken is decided by the numbers.

mod energy;
mod equation;
mod free_coordinates;
mod motion;
mod power;
mod question;
mod vectors;

pub use question::{answer, Question, Setting};

use crate::algebra::{Letter, Symbol};
use crate::balance::{Balance, Trouble};
use crate::free_bodies::{follow_presses, loads, Load, Origin, Size};
use crate::kinematics::{Kinematics, Placed};
use crate::mechanism::{Mechanism, Rubbing};
use crate::mode::{Hold, Mode};
use crate::numbers::Numbers;
use crate::plane::{Twist, Vec2};
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// One state of a mechanism in letters.
pub struct Letters<'m> {
    m: &'m Mechanism,
    mode: &'m Mode,
    n: Numbers<Symbol>,
    k: Kinematics<Symbol>,
    t: Symbol,
    q: Vec<Symbol>,
    u: Vec<Symbol>,
    /// Accelerations of the coordinates.
    a: Vec<Symbol>,
    /// Accelerations of pins and angles of all bodies.
    bodies: Vec<Twist<Symbol>>,
    loads: Vec<Load<Symbol>>,
    /// The size of each load: a letter where it is unknown.
    sizes: Vec<Symbol>,
    /// Letters of numbers that the model leaves without a name.
    named: Vec<Named>,
}

/// A letter that a number gets which the model leaves without a name.
struct Named {
    letter: String,
    value: f64,
    unit: &'static str,
    /// The names that it may have, the usual one first.
    names: [String; 2],
    /// What it is.
    doc: String,
}

impl<'m> Letters<'m> {
    /// The state of a solved balance in letters; `values` are those of the unknown loads.
    pub fn new(balance: &'m Balance<'_>, setting: &Setting, values: &[f64]) -> Self {
        let (m, at) = (balance.m, balance.at());
        let named = |name: &str, dots: u8, value: f64| match setting.fixed(name, dots) {
            Some(number) => Symbol::of(number),
            None => Symbol::letter(Letter::new(name, dots), value),
        };
        let p: Vec<Symbol> = m.parameters.iter().zip(&at.n.p).map(|(p, &x)| named(&p.name, 0, x)).collect();
        let mut slots = m.bind(&p).slots;
        for (slot, &now) in slots.iter_mut().zip(&at.n.slots) {
            // What the balance has turned (the flank of a gear) is no longer what the model says.
            if (slot.value() + now).abs() <= f64::EPSILON * now.abs() && now != 0.0 {
                *slot = -*slot;
            }
        }
        let numbers = name_numbers(m, at.n, &named, &mut slots);
        let n = m.with_slots(&p, slots);
        let coordinate = |i: usize, dots: u8, x: f64| named(&m.coordinate(i).name, dots, x);
        let q: Vec<Symbol> = at.q.iter().enumerate().map(|(i, &x)| coordinate(i, 0, x)).collect();
        let u: Vec<Symbol> = at.u.iter().enumerate().map(|(i, &x)| coordinate(i, 1, x)).collect();
        let mut found = vec![0.0; m.freedom()];
        balance.accelerations(&mut found);
        let a: Vec<Symbol> = found.iter().enumerate().map(|(i, &x)| coordinate(i, 2, x)).collect();
        let mut k = Kinematics::of(m);
        k.sweep(m, &n, &q, &u);
        let t = named("t", 0, at.t);
        let placed = Placed { m, n: &n, k: &k, q: &q, u: &u, t, mode: &balance.mode };
        let bodies = k.spread_user(m, &n, &a);
        let mut loads = loads(placed);
        follow_presses(placed, &mut loads, values);
        let sizes = sizes(&loads, values);
        Letters { m, mode: &balance.mode, n, k, t, q, u, a, bodies, loads, sizes, named: numbers }
    }

    fn at(&self) -> Placed<'_, Symbol> {
        Placed { m: self.m, n: &self.n, k: &self.k, q: &self.q, u: &self.u, t: self.t, mode: self.mode }
    }

    /// The mass centre of a body.
    fn centre(&self, body: usize) -> Vec2<Symbol> {
        self.at().mass_centre(body)
    }

    /// From the pin of a body to its mass centre.
    fn arm(&self, body: usize) -> Vec2<Symbol> {
        self.at().centre_arm(body)
    }

    /// The letters of what is unknown: accelerations, then loads.
    fn unknowns(&self) -> Vec<Letter> {
        let accelerations = (0..self.m.freedom()).map(|i| Letter::new(&self.m.coordinate(i).name, 2));
        let loads = self.loads.iter().filter(|load| matches!(load.size, Size::Unknown | Size::ByLaw));
        accelerations.chain(loads.map(|load| Letter::new(&load.symbol, 0))).collect()
    }
}

/// A letter for what the model does not name: the first that is not taken, with `_` or without.
fn own_letter<'a>(taken: impl Iterator<Item = &'a str>, names: &[String; 2]) -> String {
    let plain = |name: &str| name.replace('_', "");
    let taken: Vec<String> = taken.map(plain).collect();
    let numbered = (2..).map(|i| format!("{}{i}", names[1]));
    names.iter().cloned().chain(numbered).find(|name| !taken.contains(&plain(name))).unwrap_or_default()
}

/// Gives letters to numbers that the model leaves without a name: g, masses and inertias; answers which.
fn name_numbers(
    m: &Mechanism,
    n: &Numbers,
    named: &dyn Fn(&str, u8, f64) -> Symbol,
    slots: &mut [Symbol],
) -> Vec<Named> {
    let mut told = vec![];
    let mut name = |slot: usize, names: [String; 2], unit: &'static str, doc: String| {
        let value = n.slots[slot];
        if m.slots[slot].literal().is_some() && value != 0.0 {
            let coordinates = (0..m.freedom()).map(|i| m.coordinate(i).name.as_str());
            let letter = own_letter(m.parameters.iter().map(|p| p.name.as_str()).chain(coordinates), &names);
            slots[slot] = named(&letter, 0, value.abs()).scale(value.signum());
            told.push(Named { letter, value: value.abs(), unit, names, doc });
        }
    };
    let [x, y] = m.gravity;
    if n.slots[x] == 0.0 || n.slots[y] == 0.0 {
        for slot in [x, y] {
            name(slot, ["g".into(), "gravity".into()], "m/s^2", "gravity".into());
        }
    }
    for body in m.bodies.iter().filter(|body| body.pieces.len() == 1) {
        let (piece, of) = (&body.pieces[0], &body.name);
        name(piece.mass, [format!("m_{of}"), format!("mass_{of}")], "kg", format!("mass of {of}"));
        if let Some(slot) = piece.inertia {
            let doc = format!("inertia about the mass centre of {of}");
            name(slot, [format!("I_{of}"), format!("inertia_{of}")], "kg*m^2", doc);
        }
    }
    told
}

/// The size of every load: 1 where its parts are what acts, a letter where it is unknown.
fn sizes(loads: &[Load<Symbol>], values: &[f64]) -> Vec<Symbol> {
    let mut sizes: Vec<Symbol> = vec![];
    for (load, &value) in loads.iter().zip(values) {
        let size = match load.size {
            Size::Known => Symbol::one(),
            Size::Unknown | Size::ByLaw => Symbol::letter(Letter::new(&load.symbol, 0), value),
            Size::Follows(of, ratio) => sizes[of] * ratio,
        };
        sizes.push(size);
    }
    sizes
}

impl Letters<'_> {
    fn coordinate(&self, name: &str) -> Result<usize, Trouble> {
        let known: Vec<&String> = (0..self.m.freedom()).map(|i| &self.m.coordinate(i).name).collect();
        let found = known.iter().position(|k| *k == name);
        found.ok_or_else(|| {
            let told = crate::builder::unknown("coordinate", name, known.into_iter());
            Trouble::new("unknown_name", format!("{}; {}", told.what, told.hint))
        })
    }

    /// The laws of loads that follow from others by one that is not linear: the friction of a bearing.
    fn laws(&self) -> Vec<Value> {
        let law = |load: &Load<Symbol>| {
            let (Origin::Rubbing(rub), Size::ByLaw) = (load.origin, load.size) else { return None };
            let (rub, Hold::Sliding(sense)) = (&self.m.rubs[rub], self.mode.rubs[rub]) else { return None };
            let Rubbing::Joint { joint, radius, .. } = rub.of else { return None };
            let carried = |axis: usize| {
                let place = self.loads.iter().position(|l| l.origin == Origin::Pin(joint, axis))?;
                Some(self.sizes[place])
            };
            let (x, y, radius) = (carried(0)?, carried(1)?, self.n.slots[radius?]);
            let most = self.n.slots[rub.kinetic] * radius * (x * x + y * y).sqrt();
            Some(json!({"load": load.symbol, "tree": most.scale(-sense).tree()}))
        };
        self.loads.iter().filter_map(law).collect()
    }

    /// Every letter that may appear, with its kind and its value at the present state.
    fn table(&self) -> Value {
        let mut table = serde_json::Map::new();
        let mut add = |name: &str, kind: &str, value: f64, unit: &str| {
            table.insert(name.to_string(), json!({"kind": kind, "value": value, "unit": unit}));
        };
        for i in 0..self.m.freedom() {
            let c = self.m.coordinate(i);
            add(&c.name, "coordinate", self.q[i].value(), c.dimension);
        }
        for (p, x) in self.m.parameters.iter().zip(&self.n.p) {
            add(&p.name, "parameter", x.value(), &p.unit);
        }
        for (load, size) in self.loads.iter().zip(&self.sizes) {
            if matches!(load.size, Size::Unknown | Size::ByLaw) {
                add(&load.symbol, "unknown", size.value(), "");
            }
        }
        add("t", "time", self.t.value(), "s");
        for n in &self.named {
            let told = json!({"kind": "number", "value": n.value, "unit": n.unit, "names": n.names, "doc": n.doc});
            table.insert(n.letter.clone(), told);
        }
        Value::Object(table)
    }
}
