//! The most brute force: three coordinates a body, and every joint a constraint.

use super::equation::VirtualMotion;
use super::vectors::{linear_in, tree_by};
use super::{sizes, unused_name, SymbolicState};
use crate::algebra::{Symbol, Tree, Variable};
use crate::dynamics::{closing_rows, joint_rows, Row, Source};
use crate::free_bodies::{loads, relate_friction, Size};
use crate::kinematics::{relative, JointView, MotionView, StateView};
use crate::mechanism::Joint;
use crate::plane::{vec2, Pose, Turn, Twist};
use crate::scalar::{Jet, Scalar};
use serde_json::{json, Value};

impl SymbolicState<'_> {
    /// The state with each body placed by itself, by variables for x and y of its mass centre and its angle, with the
    /// numbers of the present state beside them; the names of these coordinates.
    fn free(&self) -> (SymbolicState<'_>, Vec<String>) {
        let (mut k, mut bodies, mut coordinates) = (self.k.clone(), self.bodies.clone(), vec![]);
        for i in self.m.listed_bodies() {
            let body = &self.m.bodies[i];
            let mut named = |word: &str, long: &str, values: [Symbol; 3]| -> [Symbol; 3] {
                let names = [format!("{word}_{}", body.name), format!("{long}_{}", body.name)];
                let name = unused_name(self.m.parameters.iter().map(|p| p.name.as_str()), &names);
                let entries = [0, 1, 2].map(|d| Symbol::variable(Variable::new(&name, d as u8), values[d].value()));
                coordinates.push(name);
                entries
            };
            let (arm, twist, origin) = (self.arm(i), self.k.twist[i], self.bodies[i]);
            let (r, v, a) = (self.centre(i), twist.at(arm), origin.acceleration_at(arm, twist.w));
            let x = named("x", "place_x", [r.x, v.x, a.x]);
            let y = named("y", "place_y", [r.y, v.y, a.y]);
            let angle = match body.particle {
                true => [self.k.pose[i].turn.angle, Symbol::zero(), Symbol::zero()],
                false => named("phi", "angle", [self.k.pose[i].turn.angle, twist.w, origin.w]),
            };
            let turn = Turn::by(angle[0]);
            let to_origin = -turn.apply(self.n.centre[i]);
            k.pose[i] = Pose { at: vec2(x[0], y[0]) + to_origin, turn };
            k.twist[i] = Twist { v: vec2(x[1], y[1]) + to_origin.perp() * angle[1], w: angle[1] };
            let centre = Twist { v: vec2(x[2], y[2]), w: angle[2] };
            bodies[i] = Twist { v: centre.acceleration_at(to_origin, angle[1]), w: angle[2] };
        }
        for &pin in &self.m.closures {
            let Some([carrier, body]) = self.m.carried(pin) else { continue };
            let (second, at) = (&self.m.joints[pin].second, self.at());
            let arm = k.pose[body].turn.apply(self.n.arms[second.site]);
            let (twist, acceleration) = (k.twist[body], bodies[body].acceleration_at(arm, k.twist[body].w));
            let turned = k.pose[body].turn.angle + self.n.values[second.angle] - at.engaged_at(pin, 2);
            let (turn, w, alpha) = match self.m.bodies[carrier].particle {
                true => (self.k.pose[carrier].turn, Symbol::zero(), Symbol::zero()),
                false => (Turn::by(turned), twist.w, bodies[body].w),
            };
            let shift = turn.apply(vec2(at.engaged_at(pin, 0), at.engaged_at(pin, 1)));
            k.pose[carrier] = Pose { at: k.pose[body].at + arm - shift, turn };
            k.twist[carrier] = Twist { v: twist.at(arm) - shift.perp() * w, w };
            bodies[carrier] = Twist { v: acceleration - shift.perp() * alpha + shift * (w * w), w: alpha };
        }
        for (i, body) in self.m.bodies.iter().enumerate() {
            if let Some(branch) = body.tree_joint {
                k.arm[i] = k.pose[i].at - k.pose[branch.parent].at;
            }
        }
        let at = StateView { k: &k, ..self.at() };
        let values: Vec<f64> = self.sizes.iter().map(|s| s.value()).collect();
        let mut loads = loads(at);
        relate_friction(at, &mut loads, &values);
        let sizes = sizes(&loads, &values);
        let (n, q, u, a) = (self.n.clone(), self.q.clone(), self.u.clone(), self.a.clone());
        (SymbolicState { n, k, q, u, a, bodies, loads, sizes, named: vec![], ..*self }, coordinates)
    }

    /// Three balance equations a body and every joint's own equations, in the places of the bodies.
    pub(super) fn constraints(&self) -> Value {
        let (free, mut coordinates) = self.free();
        let own = self.curve_starts().flat_map(|(joint, start)| self.places_on_curve(joint).map(move |k| start + k));
        coordinates.extend(own.map(|i| self.m.coordinate(i).name.clone()));
        let mut unknowns: Vec<Variable> = coordinates.iter().map(|c| Variable::new(c, 2)).collect();
        let open = free.loads.iter().filter(|l| matches!(l.size, Size::Unknown | Size::ByLaw));
        unknowns.extend(open.map(|l| Variable::new(&l.symbol, 0)));
        let balances: Vec<Value> =
            self.m.listed_bodies().into_iter().flat_map(|i| free.balances(i, &unknowns)).collect();
        let entries: Vec<Value> = free.free_rows().iter().map(|row| free.row_in(row, &unknowns)).collect();
        json!({
            "coordinates": coordinates, "unknowns": unknowns.iter().map(|l| Tree::variable(&l.name, l.dots)).collect::<Vec<_>>(), "balances": balances,
            "rows": entries,
        })
    }

    /// What all joints, motions and contacts ask of bodies that are free otherwise; joint origins along fixed axes.
    fn free_rows(&self) -> Vec<Row<Symbol>> {
        let (at, mut rows) = (self.at(), vec![]);
        let own = |&(index, joint): &(usize, &Joint)| {
            joint.curve.is_none() && !joint.rows.is_empty() && self.m.carried(index).is_none()
        };
        for (index, _) in at.joints().filter(own) {
            joint_rows(at, index, Some(&self.bodies), &mut rows);
        }
        self.curve_starts().for_each(|(joint, start)| rows.extend(self.rows_along_curve(joint, start)));
        let tree = |row: &Row<Symbol>| matches!(row.source, Source::Joint(..));
        let others = |row: &Row<Symbol>| !tree(row) && !self.holds_what_was_left(row);
        rows.extend(closing_rows(at, Some(&self.bodies)).into_iter().filter(others));
        self.joint_origins(&self.k, &self.bodies, &mut rows);
        rows
    }

    /// The joints in place that run along curves, each with its coordinate along the curve, which stays a coordinate beside
    /// those of the bodies: no place of a body tells it by a formula.
    fn curve_starts(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let start = |joint: usize| self.m.place_in_q(joint, 0).expect("a joint along a curve is in the tree");
        let on_curve =
            |&(index, joint): &(usize, &Joint)| joint.curve.is_some() && self.mode.has(self.m.part_of(index));
        self.at().joints().filter(on_curve).map(move |(index, _)| (index, start(index)))
    }

    /// The coordinates of a joint along a curve that are no turn.
    fn places_on_curve(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        let own = self.m.joints[joint].coordinates.iter().enumerate();
        own.filter(|(_, c)| c.dimension != "rad").map(|(k, _)| k)
    }

    /// What a joint along a curve asks: that its second point is at its coordinate, in both directions of the first body.
    fn rows_along_curve(&self, index: usize, start: usize) -> [Row<Symbol>; 2] {
        let joint = &self.m.joints[index];
        let (_, place) =
            relative(joint, self.m, &MotionView { at: self.at(), bodies: Some(&self.bodies), accelerations: None });
        let mut own = [Jet::constant(Symbol::zero()); 3];
        for k in self.places_on_curve(index) {
            let c = &joint.coordinates[k];
            let [q, u, a] = [&self.q, &self.u, &self.a].map(|of| of[start + k].scale(c.sense));
            own[c.card] = Jet::new(self.n.values[c.zero] + q, u, a);
        }
        let curve = JointView::new(self.m, &self.n, joint, Jet::constant).pose(&own[..joint.size], false);
        [place.x - curve.x, place.y - curve.y].map(|gap| Row {
            source: Source::Joint(index, 0),
            value: Some(gap.d0),
            rate: Some(gap.d1),
            bias: gap.d2,
            motion: Default::default(),
            force: None,
        })
    }

    /// The balances of one body: along the fixed axes, and about its mass centre where it is no particle.
    fn balances(&self, body: usize, unknowns: &[Variable]) -> Vec<Value> {
        let (zero, one) = (Symbol::zero(), Symbol::one());
        let mut tests = vec![
            ("LMB along x", VirtualMotion::Force(vec2(one, zero))),
            ("LMB along y", VirtualMotion::Force(vec2(zero, one))),
        ];
        if !self.m.bodies[body].particle {
            tests.push(("AMB about G", VirtualMotion::about(self.centre(body))));
        }
        let entry = |(kind, test): (&str, VirtualMotion)| {
            let balance = self.balance(&[body], test);
            json!({
                "body": self.m.bodies[body].name, "kind": kind,
                "left": tree_by(balance.left, unknowns), "right": tree_by(balance.right, unknowns),
                "linear": linear_in(balance.right - balance.left, unknowns),
            })
        };
        tests.into_iter().map(entry).collect()
    }
}
