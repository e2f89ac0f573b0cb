//! From the model as data to the mechanism: names resolved, numbers in numbered values, the tree chosen.

mod cables;
mod contacts;
mod elements;
mod events;
mod joints;
mod outline;
mod places;
mod track;
mod tree;

pub use elements::coupling_card;

use crate::builder::{twice, Builder, Names, Reach, Result, Scope};
use crate::error::CompileError;
use crate::expr::{Interpolation, Table};
use crate::gauges::{ModelExpr, ModelVariable};
use crate::mechanism::{Discontinuity, Gap, Mechanism, Parameter};
use crate::spec::{Number, Spec};
use std::collections::HashSet;

/// A compiled mechanism with the names by which expressions may read it.
pub struct Compiled {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its names.
    pub names: Names,
}

impl Compiled {
    /// Compiles a model.
    pub fn new(spec: &Spec) -> Result<Compiled> {
        let mut c = Builder { spec, names: Names::default(), m: Mechanism::empty(&spec.name) };
        c.parameters()?;
        c.states()?;
        c.tables()?;
        let elements = tree::joints_of(spec)?;
        let branches = c.bodies(&elements)?;
        c.points()?;
        c.lines()?;
        c.curves()?;
        c.gravity()?;
        c.joints(&elements, &branches)?;
        c.gauges()?;
        c.state_rates()?;
        c.drives()?;
        c.locks()?;
        c.curve_followers()?;
        c.forces()?;
        c.contacts()?;
        c.stops()?;
        c.cables()?;
        c.idle()?;
        c.events()?;
        c.find_discontinuities();
        c.m.drive_gauges = c.m.drives.iter().map(|drive| drive.gauges(|gauge| c.m.bodies_of(gauge))).collect();
        Ok(Compiled { mechanism: c.m, names: c.names })
    }

    /// An expression over the solved instant: a quantity to report.
    pub fn observable(&mut self, text: &str) -> Result<ModelExpr> {
        let mut scope = Scope { names: &self.names, reach: Reach::Instant, switches: &mut self.mechanism.switches };
        scope.law(text).map_err(|e| Names::error("", text, e))
    }
}

impl Builder<'_> {
    fn parameters(&mut self) -> Result<()> {
        for (i, p) in self.spec.parameters.iter().enumerate() {
            if self.names.parameters.insert(p.name.clone(), i).is_some() {
                return Err(twice(format!("parameters.{}", p.name), &p.name));
            }
        }
        for p in &self.spec.parameters {
            let value = self.number(&format!("parameters.{}", p.name), &p.value)?;
            self.m.parameters.push(Parameter { name: p.name.clone(), unit: p.unit.clone(), value });
        }
        Ok(())
    }

    /// The values of the states at the start, as parameters behind the others.
    fn states(&mut self) -> Result<()> {
        for (i, state) in self.spec.states.iter().enumerate() {
            let path = format!("states.{}", state.name);
            let taken = self.names.parameters.contains_key(&state.name);
            if taken || self.names.states.insert(state.name.clone(), i).is_some() {
                return Err(twice(path, &state.name));
            }
            let value = self.number(&format!("{path}.start"), &state.start)?;
            self.m.parameters.push(Parameter { name: state.name.clone(), unit: state.unit.clone(), value });
            self.m.state_rates.push(ModelExpr::constant(0.0));
        }
        self.order_parameters()
    }

    fn state_rates(&mut self) -> Result<()> {
        for (i, state) in self.spec.states.iter().enumerate() {
            self.m.state_rates[i] = self.law(&format!("states.{}.rate", state.name), &state.rate, Reach::Motion)?;
        }
        Ok(())
    }

    /// An order in which every parameter comes after those it uses.
    fn order_parameters(&mut self) -> Result<()> {
        let needs: Vec<HashSet<usize>> = self.m.parameters.iter().map(|p| uses(&p.value)).collect();
        let mut done = vec![false; needs.len()];
        while self.m.parameter_order.len() < needs.len() {
            let ready = (0..needs.len()).find(|&i| !done[i] && needs[i].iter().all(|&j| done[j]));
            let Some(i) = ready else {
                let stuck = (0..needs.len()).find(|&i| !done[i]).expect("one is left");
                let name = &self.m.parameters[stuck].name;
                let what = format!("`{name}` is defined by way of itself");
                return Err(CompileError::new(
                    format!("parameters.{name}"),
                    what,
                    "give one parameter of the circle a number",
                ));
            };
            done[i] = true;
            self.m.parameter_order.push(i);
        }
        Ok(())
    }

    fn tables(&mut self) -> Result<()> {
        for (i, t) in self.spec.tables.iter().enumerate() {
            let path = format!("tables.{}", t.name);
            let how = Interpolation::named(&t.interpolation)
                .map_err(|m| CompileError::from(format!("{path}.interpolation"), m))?;
            let table = Table::new(&t.x, &t.y, how, t.periodic).map_err(|m| CompileError::from(&path, m))?;
            self.m.tables.push(table);
            self.m.table_names.push(t.name.clone());
            self.names.tables.insert(t.name.clone(), i);
        }
        Ok(())
    }

    fn gravity(&mut self) -> Result<()> {
        let g = self.spec.gravity.clone().unwrap_or([Number::Literal(0.0), Number::Literal(0.0)]);
        self.m.gravity = [self.number_value("gravity", &g[0])?, self.number_value("gravity", &g[1])?];
        Ok(())
    }

    /// Where the laws of forces, drives and stops, and the curves of joints, are not smooth.
    fn find_discontinuities(&mut self) {
        let m = &self.m;
        let forces = m.forces.iter().flat_map(|f| f.laws().map(|law| (law, format!("forces.{}", f.name))));
        let drives = m.drives.iter().flat_map(|d| {
            let laws = [&d.of, &d.law].into_iter().chain(&d.by);
            laws.map(|law| (law, format!("{}s.{}", d.kind.word(), d.name)))
        });
        let stops = m.unilateral.iter().filter_map(|constraint| match &constraint.gap {
            Gap::Gauge(law) => Some((law, m.groups[constraint.group].path())),
            Gap::ContactPair(_) | Gap::Cable(_) => None,
        });
        let states = self.spec.states.iter().map(|state| format!("states.{}", state.name));
        let mut found: Vec<(Discontinuity, String)> = vec![];
        for (law, item) in forces.chain(drives).chain(stops).chain(m.state_rates.iter().zip(states)) {
            for switch in sorted(law.discontinuities()) {
                if !found.iter().any(|(k, _)| matches!(k, Discontinuity::Switch(known, _) if *known == switch)) {
                    found.push((Discontinuity::Switch(switch, law.clone()), item.clone()));
                }
            }
            for (table, argument) in law.lookups() {
                let knots = m.tables[table].knots();
                found.extend(knots.map(|x| (Discontinuity::Knot(table, argument.clone(), x), item.clone())));
            }
        }
        for (j, joint) in m.joints.iter().enumerate() {
            let Some(curve) = joint.curve.map(|c| &m.curves[c]) else { continue };
            let (first, item) = (&joint.coordinates[0], format!("joints.{}", joint.name));
            let turned = ModelExpr::constant(first.sense) * ModelExpr::variable(ModelVariable::Coordinate(j, 0));
            let along = m.values[first.zero].clone() + turned;
            for law in [&curve.x, &curve.y].map(|law| law.substitute(&ModelVariable::Local, &along)) {
                let switches = sorted(law.discontinuities());
                let bend = |switch| (Discontinuity::Bend(switch, law.clone()), item.clone());
                found.extend(switches.into_iter().map(bend));
                for (table, argument) in law.lookups() {
                    let knots = m.tables[table].knots();
                    found.extend(knots.map(|x| (Discontinuity::Knot(table, argument.clone(), x), item.clone())));
                }
            }
        }
        (self.m.discontinuities, self.m.discontinuous_items) = found.into_iter().unzip();
    }
}

fn sorted(discontinuities: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut discontinuities: Vec<usize> = discontinuities.collect();
    discontinuities.sort_unstable();
    discontinuities.dedup();
    discontinuities
}

/// The parameters that a number uses.
fn uses(law: &ModelExpr) -> HashSet<usize> {
    law.variables()
        .filter_map(|variable| match variable {
            ModelVariable::Parameter(i) => Some(*i),
            _ => None,
        })
        .collect()
}
