//! Virtual power: all bodies moved at once as closed loops allow, so that what closes the loops has none.

use super::vectors::{tree, tree_by};
use super::SymbolicState;
use crate::algebra::{Symbol, Variable};
use crate::dynamics::{momentum_rate, DynamicsError};
use crate::free_bodies::Load;
use crate::plane::{vec2, Twist, Vec2};
use crate::scalar::Scalar;
use serde_json::{json, Value};

impl SymbolicState<'_> {
    /// One equation for each coordinate that is not `bound`: its virtual rates, those of the bound ones following from the
    /// `rows` (by their places) of what is closed, and the power of all loads and of all inertia in them.
    pub(super) fn virtual_power(&self, bound: &[String], rows: &[usize]) -> Result<Value, DynamicsError> {
        let bound: Vec<usize> = bound.iter().map(|name| self.coordinate(name)).collect::<Result<_, _>>()?;
        let jacobian = self.jacobian(rows);
        if jacobian.len() != bound.len() {
            return Err(DynamicsError::WrongQuestion("as many rows as bound coordinates are needed".into()));
        }
        let all = self.m.freedom();
        let free = self.coordinates().filter(|i| !bound.contains(i));
        Ok(free.map(|i| self.power_in(&virtual_rates(&jacobian, all, i, &bound))).collect())
    }

    /// What the rows hold of the rates of all coordinates.
    fn jacobian(&self, rows: &[usize]) -> Vec<Vec<Symbol>> {
        let accelerations: Vec<Variable> =
            (0..self.m.freedom()).map(|i| Variable::new(&self.m.coordinate(i).name, 2)).collect();
        let all = self.closing();
        rows.iter().filter_map(|&r| all.get(r)).map(|row| row.bias.linear_in(&accelerations).0).collect()
    }

    fn power_in(&self, rates: &[Symbol]) -> Value {
        let (acts, mut moves) = (self.power_of(rates, |_| true), Symbol::zero());
        for body in self.m.listed_bodies() {
            let (v, w) = self.virtual_motion(body, self.arm(body), rates);
            moves += momentum_rate(self.at(), body, self.bodies[body]).power(Twist { v, w });
        }
        let unknowns = self.unknowns();
        let rates: serde_json::Map<String, Value> =
            self.coordinates().map(|i| (self.m.coordinate(i).name.clone(), json!(tree(rates[i])))).collect();
        json!({
            "rates": rates, "left": tree_by(acts, &unknowns), "right": tree_by(moves, &unknowns),
            "linear": self.linear(moves - acts),
        })
    }

    /// The power of some of the loads at virtual rates of the coordinates.
    pub(super) fn power_of(&self, rates: &[Symbol], counts: impl Fn(&Load<Symbol>) -> bool) -> Symbol {
        let mut sum = Symbol::zero();
        for (load, &size) in self.loads.iter().zip(&self.sizes).filter(|(load, _)| counts(load)) {
            for part in load.parts.iter().filter(|part| part.body > 0) {
                let (v, w) = self.virtual_motion(part.body, part.point - self.k.pose[part.body].at, rates);
                sum += (part.force.dot(v) + part.couple * w) * size;
            }
        }
        sum
    }

    /// Velocity at an arm from the joint origin of a body, and its turning rate, at given rates of the coordinates.
    fn virtual_motion(&self, body: usize, arm: Vec2<Symbol>, rates: &[Symbol]) -> (Vec2<Symbol>, Symbol) {
        // A velocity depends on rates as an acceleration does on accelerations, and those are variables at rest as
        // well.
        let origin = self.bodies[body];
        let mut sum = Twist { v: Vec2::zero(), w: Symbol::zero() };
        for (i, &rate) in rates.iter().enumerate().filter(|(_, rate)| !rate.is_zero()) {
            let own = Variable::new(&self.m.coordinate(i).name, 2);
            let along = |of: Symbol| of.derivative(&own) * rate;
            sum.v += vec2(along(origin.v.x), along(origin.v.y));
            sum.w += along(origin.w);
        }
        (sum.at(arm), sum.w)
    }
}

/// The rates of all coordinates that leave the rows closed, by Cramer's rule without its division.
fn virtual_rates(jacobian: &[Vec<Symbol>], coordinates: usize, free: usize, bound: &[usize]) -> Vec<Symbol> {
    let columns = |of: &[usize]| -> Vec<Vec<Symbol>> {
        jacobian.iter().map(|row| of.iter().map(|&c| row[c]).collect()).collect()
    };
    let mut rates = vec![Symbol::zero(); coordinates];
    rates[free] = determinant(&columns(bound));
    for (place, &coordinate) in bound.iter().enumerate() {
        let mut replaced = bound.to_vec();
        replaced[place] = free;
        rates[coordinate] = -determinant(&columns(&replaced));
    }
    rates
}

/// By its first row.
fn determinant(of: &[Vec<Symbol>]) -> Symbol {
    let Some((first, rest)) = of.split_first() else { return Symbol::one() };
    let mut sum = Symbol::zero();
    for (place, &entry) in first.iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
        let minor: Vec<Vec<Symbol>> = rest.iter().map(|row| [&row[..place], &row[place + 1..]].concat()).collect();
        let term = entry * determinant(&minor);
        sum += if place % 2 == 0 { term } else { -term };
    }
    sum
}
