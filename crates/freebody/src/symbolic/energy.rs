//! Energy in variables, Lagrange's equations, and the equations for small departures from equilibrium.

use super::equation::VirtualMotion;
use super::vectors::{tree, tree_by};
use super::SymbolicState;
use crate::algebra::{Symbol, Variable};
use crate::dynamics::{kinetic, potential, Source};
use crate::free_bodies::Origin;
use crate::scalar::Scalar;
use serde_json::{json, Value};
use std::collections::BTreeMap;

impl SymbolicState<'_> {
    fn kinetic(&self) -> Symbol {
        (1..self.m.bodies.len()).fold(Symbol::zero(), |sum, body| sum + kinetic(self.at(), body))
    }

    /// Kinetic and potential energy, and the names of the forces, compliant contacts among them, whose work is not in
    /// it.
    pub(super) fn energy(&self) -> Value {
        let mut without: Vec<&str> = vec![];
        for load in self.loads.iter().filter(|load| !load.origin.is_conservative(self.m)) {
            match load.origin {
                Origin::Force(force, _) | Origin::Plate(force, _) => without.push(&self.m.forces[force].name),
                Origin::Compliant(limit) => without.push(Source::Gap(limit).name(self.m)),
                _ => {}
            }
        }
        without.dedup();
        json!({"kinetic": tree(self.kinetic()), "potential": tree(potential(self.at())), "without_potential": without})
    }

    fn variable(&self, i: usize, dots: u8) -> Variable {
        Variable::new(&self.m.coordinate(i).name, dots)
    }

    /// d/dt of an expression of coordinates, rates and time.
    fn rate(&self, of: Symbol) -> Symbol {
        let mut sum = of.derivative(&Variable::new("t", 0));
        for i in 0..self.m.freedom() {
            sum += of.derivative(&self.variable(i, 0)) * self.u[i] + of.derivative(&self.variable(i, 1)) * self.a[i];
        }
        sum
    }

    /// Of every coordinate d/dt ∂T/∂q̇ − ∂T/∂q + ∂V/∂q and the generalized force of all that has no potential.
    pub(super) fn lagrange(&self) -> Value {
        let (kinetic, potential) = (self.kinetic(), potential(self.at()));
        let of = |i: usize| {
            let q = self.variable(i, 0);
            let momentum = kinetic.derivative(&self.variable(i, 1));
            let left = self.rate(momentum) - kinetic.derivative(&q) + potential.derivative(&q);
            let force = self.generalized_force(i);
            json!({
                "coordinate": self.m.coordinate(i).name, "momentum": tree(momentum),
                "left": tree_by(left, &self.unknowns()), "force": tree(force),
                "residual": tree_by(left - force, &self.unknowns()),
            })
        };
        json!({
            "kinetic": tree(kinetic), "potential": tree(potential),
            "equations": self.coordinates().map(of).collect::<Vec<_>>(),
        })
    }

    /// The power of all loads without a potential for a unit rate of a coordinate.
    fn generalized_force(&self, i: usize) -> Symbol {
        let mut rates = vec![Symbol::zero(); self.m.freedom()];
        rates[i] = Symbol::of(1.0);
        self.power_of(&rates, |load| !load.origin.is_conservative(self.m))
    }

    /// The equations of the coordinates near rest: matrices of M ẍ + C ẋ + K x = 0, and what is left at the place
    /// itself, which vanishes where it is an equilibrium.
    pub(super) fn linearised(&self, at: &BTreeMap<String, f64>) -> Value {
        let place = |i: usize| at.get(&self.m.coordinate(i).name).map(|&x| (self.variable(i, 0), Symbol::of(x)));
        let at_rest = |dots: u8| move |i: usize| (self.variable(i, dots), Symbol::zero());
        let all = || self.coordinates();
        let fixed: Vec<(Variable, Symbol)> =
            all().map(at_rest(1)).chain(all().map(at_rest(2))).chain(all().filter_map(place)).collect();
        let there = |of: Symbol| of.substitute(&fixed);
        let residuals: Vec<Symbol> = all()
            .map(|i| {
                let (bodies, test): (Vec<usize>, VirtualMotion) = self.of_coordinate(i);
                let balance = self.balance(&bodies, test);
                balance.right - balance.left
            })
            .collect();
        let matrix = |dots: u8| -> Vec<Vec<Value>> {
            let entry = |r: &Symbol, j: usize| json!(tree(there(r.derivative(&self.variable(j, dots)))));
            residuals.iter().map(|r| all().map(|j| entry(r, j)).collect()).collect()
        };
        json!({
            "coordinates": all().map(|i| &self.m.coordinate(i).name).collect::<Vec<_>>(),
            "M": matrix(2), "C": matrix(1), "K": matrix(0),
            "left": residuals.iter().map(|&r| tree(there(r))).collect::<Vec<_>>(),
        })
    }
}
