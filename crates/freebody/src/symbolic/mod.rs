//! The equations of a mechanism, symbolically: the same mechanics, read with symbols.
//!
//! A state is read with a variable for each quantity (parameters, coordinates, rates, accelerations, unknown loads),
//! with its numbers beside it: which contacts hold and which arm of a law is taken is decided by the numbers.

mod energy;
mod equation;
mod maximal_coordinates;
mod motion;
mod offsets;
mod power;
mod query;
mod vectors;
mod witness;

pub use query::{answer, Query, Setting};

use crate::algebra::{Symbol, Variable};
use crate::bound_values::BoundValues;
use crate::dynamics::{DynamicsError, Workspace};
use crate::free_bodies::{loads, relate_friction, Load, Origin, Size};
use crate::kinematics::{Kinematics, StateView};
use crate::mechanism::{FrictionSource, Mechanism};
use crate::mode::{ContactMode, Mode};
use crate::plane::{Twist, Vec2};
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// One state of a mechanism in symbols.
pub struct SymbolicState<'m> {
    m: &'m Mechanism,
    mode: &'m Mode,
    n: BoundValues<Symbol>,
    k: Kinematics<Symbol>,
    t: Symbol,
    q: Vec<Symbol>,
    u: Vec<Symbol>,
    /// Accelerations of the coordinates.
    a: Vec<Symbol>,
    /// Accelerations of joint origins and angles of all bodies.
    bodies: Vec<Twist<Symbol>>,
    loads: Vec<Load<Symbol>>,
    /// The size of each load: a variable where it is unknown.
    sizes: Vec<Symbol>,
    /// Variables of numbers that the model leaves without a name.
    named: Vec<Named>,
}

/// A variable that a number gets which the model leaves without a name.
struct Named {
    variable: String,
    value: f64,
    unit: &'static str,
    /// The names that it may have, the usual one first.
    names: [String; 2],
    /// What it is.
    doc: String,
}

impl<'m> SymbolicState<'m> {
    /// The state of a solved balance in symbols; `values` are those of the unknown loads.
    pub fn new(workspace: &'m Workspace<'_>, setting: &Setting, values: &[f64]) -> Self {
        let (m, at) = (workspace.m, workspace.at());
        let named = |name: &str, dots: u8, value: f64| match setting.fixed(name, dots) {
            Some(number) => Symbol::of(number),
            None => Symbol::variable(Variable::new(name, dots), value),
        };
        let p: Vec<Symbol> = m.parameters.iter().zip(&at.n.p).map(|(p, &x)| named(&p.name, 0, x)).collect();
        let mut bound = m.bind(&p).values;
        let mut numbers = name_numbers(m, at.n, &named, &mut bound);
        let mut n = m.with_values(&p, bound);
        n.row_offsets = offsets::name_offsets(workspace, &named, &mut numbers);
        let coordinate = |i: usize, dots: u8, x: f64| named(&m.coordinate(i).name, dots, x);
        let q: Vec<Symbol> =
            witness::coordinates(workspace).iter().enumerate().map(|(i, &x)| coordinate(i, 0, x)).collect();
        let u: Vec<Symbol> = at.u.iter().enumerate().map(|(i, &x)| coordinate(i, 1, x)).collect();
        let mut found = vec![0.0; m.freedom()];
        workspace.accelerations(&mut found);
        let a: Vec<Symbol> = found.iter().enumerate().map(|(i, &x)| coordinate(i, 2, x)).collect();
        let mut k = Kinematics::of(m);
        k.forward_kinematics(m, &n, &q, &u);
        let t = named("t", 0, at.t);
        let placed = StateView { m, n: &n, k: &k, q: &q, u: &u, t, mode: at.mode };
        let bodies = k.propagate_user_motion(m, &n, &a);
        let mut loads = loads(placed);
        relate_friction(placed, &mut loads, values);
        let sizes = sizes(&loads, values);
        SymbolicState { m, mode: at.mode, n, k, t, q, u, a, bodies, loads, sizes, named: numbers }
    }

    fn at(&self) -> StateView<'_, Symbol> {
        StateView { m: self.m, n: &self.n, k: &self.k, q: &self.q, u: &self.u, t: self.t, mode: self.mode }
    }

    /// The mass centre of a body.
    fn centre(&self, body: usize) -> Vec2<Symbol> {
        self.at().mass_centre(body)
    }

    /// From the joint origin of a body to its mass centre.
    fn arm(&self, body: usize) -> Vec2<Symbol> {
        self.at().centre_arm(body)
    }

    /// The coordinates in place: all but those along curves that bodies have left.
    fn coordinates(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.m.freedom()).filter(|&i| self.mode.has(self.m.part_of(self.m.coordinates[i].0)))
    }

    /// The variables of what is unknown: accelerations, then loads.
    fn unknowns(&self) -> Vec<Variable> {
        let accelerations = self.coordinates().map(|i| Variable::new(&self.m.coordinate(i).name, 2));
        let loads = self.loads.iter().filter(|load| matches!(load.size, Size::Unknown | Size::ByLaw));
        accelerations.chain(loads.map(|load| Variable::new(&load.symbol, 0))).collect()
    }
}

/// A variable for what the model does not name: the first that is not taken, with `_` or without.
fn unused_name<'a>(taken: impl Iterator<Item = &'a str>, names: &[String; 2]) -> String {
    let plain = |name: &str| name.replace('_', "");
    let taken: Vec<String> = taken.map(plain).collect();
    let numbered = (2..).map(|i| format!("{}{i}", names[1]));
    names.iter().cloned().chain(numbered).find(|name| !taken.contains(&plain(name))).unwrap_or_default()
}

/// Gives variables to numbers that the model leaves without a name: g, masses and inertias; answers which.
fn name_numbers(
    m: &Mechanism,
    n: &BoundValues,
    named: &dyn Fn(&str, u8, f64) -> Symbol,
    bound: &mut [Symbol],
) -> Vec<Named> {
    let mut entries = vec![];
    let mut name = |id: usize, names: [String; 2], unit: &'static str, doc: String| {
        let value = n.values[id];
        if m.values[id].literal().is_some() && value != 0.0 {
            let coordinates = (0..m.freedom()).map(|i| m.coordinate(i).name.as_str());
            let variable = unused_name(m.parameters.iter().map(|p| p.name.as_str()).chain(coordinates), &names);
            bound[id] = named(&variable, 0, value.abs()).scale(value.signum());
            entries.push(Named { variable, value: value.abs(), unit, names, doc });
        }
    };
    let [x, y] = m.gravity;
    if n.values[x] == 0.0 || n.values[y] == 0.0 {
        for id in [x, y] {
            name(id, ["g".into(), "gravity".into()], "m/s^2", "gravity".into());
        }
    } else {
        for (id, axis) in [(x, "x"), (y, "y")] {
            let sign = if n.values[id] < 0.0 { "−" } else { "" };
            name(id, [format!("g_{axis}"), format!("gravity_{axis}")], "m/s^2", format!("gravity along {sign}{axis}"));
        }
    }
    for body in m.bodies.iter().filter(|body| body.mass_elements.len() == 1) {
        let (piece, of) = (&body.mass_elements[0], &body.name);
        name(piece.mass, [format!("m_{of}"), format!("mass_{of}")], "kg", format!("mass of {of}"));
        if let Some(id) = piece.inertia {
            let doc = format!("inertia about the mass centre of {of}");
            name(id, [format!("I_{of}"), format!("inertia_{of}")], "kg*m^2", doc);
        }
    }
    entries
}

/// The size of every load: 1 where its parts are what acts, a variable where it is unknown.
fn sizes(loads: &[Load<Symbol>], values: &[f64]) -> Vec<Symbol> {
    let mut sizes: Vec<Symbol> = vec![];
    for (load, &value) in loads.iter().zip(values) {
        let size = match load.size {
            Size::Known => Symbol::one(),
            Size::Unknown | Size::ByLaw => Symbol::variable(Variable::new(&load.symbol, 0), value),
            Size::Follows(of, ratio) => sizes[of] * ratio,
        };
        sizes.push(size);
    }
    sizes
}

impl SymbolicState<'_> {
    fn coordinate(&self, name: &str) -> Result<usize, DynamicsError> {
        let known: Vec<&String> = (0..self.m.freedom()).map(|i| &self.m.coordinate(i).name).collect();
        let found = known.iter().position(|k| *k == name);
        found.ok_or_else(|| {
            let entries = crate::builder::unknown("coordinate", name, known.into_iter());
            DynamicsError::UnknownName(format!("{}; {}", entries.what, entries.hint))
        })
    }

    /// The laws of loads that follow from others by one that is not linear: the friction of a bearing.
    fn laws(&self) -> Vec<Value> {
        let law = |load: &Load<Symbol>| {
            let (Origin::JointFriction(friction), Size::ByLaw) = (load.origin, load.size) else { return None };
            let (friction, ContactMode::Slip(sense)) =
                (&self.m.joint_friction[friction], self.mode.joint_friction[friction])
            else {
                return None;
            };
            let FrictionSource::Joint { joint, radius, .. } = friction.of else { return None };
            let carried = |axis: usize| {
                let place = self.loads.iter().position(|l| l.origin == Origin::Pin(joint, axis))?;
                Some(self.sizes[place])
            };
            let (x, y, radius) = (carried(0)?, carried(1)?, self.n.values[radius?]);
            let most = self.n.values[friction.kinetic] * radius * (x * x + y * y).sqrt();
            Some(json!({"load": load.symbol, "tree": most.scale(-sense).tree()}))
        };
        self.loads.iter().filter_map(law).collect()
    }

    /// Every variable that may appear, with its kind and its value at the present state.
    fn table(&self) -> Value {
        let mut table = serde_json::Map::new();
        let mut add = |name: &str, kind: &str, value: f64, unit: &str| {
            table.insert(name.to_string(), json!({"kind": kind, "value": value, "unit": unit}));
        };
        for i in self.coordinates() {
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
            let entries = json!({"kind": "number", "value": n.value, "unit": n.unit, "names": n.names, "doc": n.doc});
            table.insert(n.variable.clone(), entries);
        }
        Value::Object(table)
    }
}
