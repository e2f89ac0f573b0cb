//! The most brute force: three coordinates a body, and every joint a constraint.

use super::motion::acceleration;

use super::vectors::{linear_in, tree_by};
use super::{own_letter, sizes, SymbolicState};
use crate::algebra::{Symbol, Tree, Variable};
use crate::dynamics::{closing_rows, joint_rows, momentum, Row, Source};
use crate::free_bodies::{loads, relate_friction, Load, Size};
use crate::kinematics::{Kinematics, StateView};
use crate::plane::{vec2, Pose, Turn, Twist, Vec2};
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// The bodies placed each by itself: x and y of its mass centre and its angle.
struct Free {
    k: Kinematics<Symbol>,
    bodies: Vec<Twist<Symbol>>,
    coordinates: Vec<String>,
}

impl SymbolicState<'_> {
    /// Variables for the place of every body, with the numbers of the present state beside them.
    fn free(&self) -> Free {
        let mut free = Free { k: self.k.clone(), bodies: self.bodies.clone(), coordinates: vec![] };
        for i in 1..self.m.bodies.len() {
            let body = &self.m.bodies[i];
            let mut named = |word: &str, long: &str, values: [Symbol; 3]| -> [Symbol; 3] {
                let names = [format!("{word}_{}", body.name), format!("{long}_{}", body.name)];
                let name = own_letter(self.m.parameters.iter().map(|p| p.name.as_str()), &names);
                let entries = [0, 1, 2].map(|d| Symbol::variable(Variable::new(&name, d as u8), values[d].value()));
                free.coordinates.push(name);
                entries
            };
            let (arm, twist, origin) = (self.arm(i), self.k.twist[i], self.bodies[i]);
            let (r, v, a) = (self.centre(i), twist.at(arm), acceleration(origin, arm, twist.w));
            let x = named("x", "place_x", [r.x, v.x, a.x]);
            let y = named("y", "place_y", [r.y, v.y, a.y]);
            let angle = match body.particle {
                true => [self.k.pose[i].turn.angle, Symbol::zero(), Symbol::zero()],
                false => named("phi", "angle", [self.k.pose[i].turn.angle, twist.w, origin.w]),
            };
            let turn = Turn::by(angle[0]);
            let to_origin = -turn.apply(self.n.centre[i]);
            free.k.pose[i] = Pose { at: vec2(x[0], y[0]) + to_origin, turn };
            free.k.twist[i] = Twist { v: vec2(x[1], y[1]) + to_origin.perp() * angle[1], w: angle[1] };
            let centripetal = to_origin * (angle[1] * angle[1]);
            let at_origin: Vec2<Symbol> = vec2(x[2], y[2]) + to_origin.perp() * angle[2] - centripetal;
            free.bodies[i] = Twist { v: at_origin, w: angle[2] };
        }
        for (i, body) in self.m.bodies.iter().enumerate() {
            if let Some(branch) = body.tree_joint {
                free.k.arm[i] = free.k.pose[i].at - free.k.pose[branch.parent].at;
            }
        }
        free
    }

    /// Three balance equations a body and every joint's own equations, in the places of the bodies.
    pub(super) fn constraints(&self) -> Value {
        let free = self.free();
        let at = StateView { k: &free.k, ..self.at() };
        let mut all = loads(at);
        let values: Vec<f64> = self.sizes.iter().map(|s| s.value()).collect();
        relate_friction(at, &mut all, &values);
        let sizes = sizes(&all, &values);
        let mut unknowns: Vec<Variable> = free.coordinates.iter().map(|c| Variable::new(c, 2)).collect();
        let open = all.iter().filter(|l| matches!(l.size, Size::Unknown | Size::ByLaw));
        unknowns.extend(open.map(|l| Variable::new(&l.symbol, 0)));
        let balances: Vec<Value> =
            self.m.listed_bodies().into_iter().flat_map(|i| self.balances(&free, i, &all, &sizes, &unknowns)).collect();
        let entries: Vec<Value> = self.free_rows(&free, at).iter().map(|row| self.row_in(row, &unknowns)).collect();
        json!({
            "coordinates": free.coordinates, "unknowns": unknowns.iter().map(|l| Tree::variable(&l.name, l.dots)).collect::<Vec<_>>(), "balances": balances,
            "rows": entries,
        })
    }

    /// What all joints, motions and limits ask of bodies that are free otherwise; joint origins along fixed axes.
    fn free_rows(&self, free: &Free, at: StateView<'_, Symbol>) -> Vec<Row<Symbol>> {
        let mut rows = vec![];
        for (index, _) in at.joints().filter(|(_, joint)| joint.curve.is_none() && !joint.rows.is_empty()) {
            joint_rows(at, index, Some(&free.bodies), &mut rows);
        }
        let tree = |row: &Row<Symbol>| matches!(row.source, Source::Joint(..));
        rows.extend(closing_rows(at, Some(&free.bodies)).into_iter().filter(|row| !tree(row)));
        self.joint_origins(&free.k, &free.bodies, &mut rows);
        rows
    }

    fn balances(
        &self,
        free: &Free,
        i: usize,
        all: &[Load<Symbol>],
        sizes: &[Symbol],
        unknowns: &[Variable],
    ) -> Vec<Value> {
        let turn = free.k.pose[i].turn;
        let arm = turn.apply(self.n.centre[i]);
        let centre = free.k.pose[i].at + arm;
        let a = acceleration(free.bodies[i], arm, free.k.twist[i].w);
        let rate = momentum(self.at(), i, a, free.bodies[i].w);
        let mut left = [Symbol::zero(); 3];
        for (load, &size) in all.iter().zip(sizes) {
            for part in load.parts.iter().filter(|part| part.body == i) {
                left[0] += part.force.x * size;
                left[1] += part.force.y * size;
                left[2] += ((part.point - centre).cross(part.force) + part.couple) * size;
            }
        }
        let right = [rate.f.x, rate.f.y, rate.m];
        let kinds = ["LMB along x", "LMB along y", "AMB about G"];
        let count = if self.m.bodies[i].particle { 2 } else { 3 };
        (0..count)
            .map(|k| {
                json!({
                    "body": self.m.bodies[i].name, "kind": kinds[k],
                    "left": tree_by(left[k], unknowns), "right": tree_by(right[k], unknowns),
                    "linear": linear_in(right[k] - left[k], unknowns),
                })
            })
            .collect()
    }
}
