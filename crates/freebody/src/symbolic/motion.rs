//! Kinematics in variables: every mass centre, a point seen from a moving body, and what loops and motions ask.

use super::vectors::{linear_in, presented, tree};
use super::SymbolicState;
use crate::algebra::{Symbol, Variable};
use crate::dynamics::{closing_rows, DynamicsError, Row, Source};
use crate::joints::{Joint as _, RowCard};
use crate::kinematics::{Kinematics, State};
use crate::mechanism::DriveKind;
use crate::plane::{Twist, Vec2};
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// Position, velocity and acceleration of a place.
type Moving = [Vec2<Symbol>; 3];

/// Of the place on a body an arm away from its pin.
fn moving(k: &Kinematics<Symbol>, bodies: &[Twist<Symbol>], body: usize, arm: Vec2<Symbol>) -> Moving {
    let twist = k.twist[body];
    [k.pose[body].at + arm, twist.at(arm), bodies[body].acceleration_at(arm, twist.w)]
}

impl SymbolicState<'_> {
    /// Angle, position, velocity and acceleration of every body and its mass centre.
    pub(super) fn kinematics(&self) -> Value {
        let entry = |i: usize| {
            let (body, twist, origin) = (&self.m.bodies[i], self.k.twist[i], self.bodies[i]);
            let arm = self.arm(i);
            json!({
                "body": body.name, "particle": body.particle,
                "mass": tree(self.n.mass[i]), "inertia": tree(self.n.inertia[i]),
                "angle": tree(self.k.pose[i].turn.angle), "omega": tree(twist.w), "alpha": tree(origin.w),
                "r": self.vector(self.centre(i)), "v": self.vector(twist.at(arm)),
                "a": self.vector(origin.acceleration_at(arm, twist.w)),
            })
        };
        Value::Array(self.m.listed_bodies().into_iter().map(entry).collect())
    }

    /// Position, velocity and acceleration of a point through the frames of bodies, each seen from the one before: those of the
    /// origin of the first, and for each stretch, from the origin of a frame to that of the next or to the point, what the
    /// frame carries and turns, what moves against it, and Coriolis's part. They add up to the whole. Without `frames` these are
    /// the bodies by which that of the point hangs in the tree, with itself. The origin of a frame is the pin of its body.
    pub(super) fn through(&self, point: &str, frames: &[String]) -> Result<Value, DynamicsError> {
        let site = self.point(point)?;
        let own = self.m.body_of(site);
        let named: Result<Vec<usize>, DynamicsError> = frames.iter().map(|name| self.body(name)).collect();
        let bodies = if frames.is_empty() { self.path(own) } else { named? };
        let place = |body: usize, arm: Vec2<Symbol>| moving(&self.k, &self.bodies, body, arm);
        let mut ends: Vec<Moving> = bodies.iter().map(|&body| place(body, Vec2::zero())).collect();
        ends.push(place(own, self.k.pose[own].turn.apply(self.n.arms[site])));
        let whole = |at: &Moving| json!({"r": self.vector(at[0]), "v": self.vector(at[1]), "a": self.vector(at[2])});
        let stretches: Vec<Value> =
            bodies.iter().zip(ends.windows(2)).map(|(&body, ends)| self.stretch(body, ends)).collect();
        Ok(json!({"origin": whole(&ends[0]), "stretches": stretches, "point": whole(&ends[bodies.len()])}))
    }

    /// The bodies of the model by which one hangs in the tree, with itself.
    fn path(&self, body: usize) -> Vec<usize> {
        let above = |&i: &usize| self.m.bodies[i].tree_joint.map(|branch| branch.parent);
        let mut found: Vec<usize> = std::iter::successors(Some(body), above).collect();
        found.retain(|&i| self.m.bodies[i].listed.is_some());
        found.reverse();
        found
    }

    /// From one of two places to the other, seen from a body: each vector also along the axes of its pin (`own`).
    fn stretch(&self, body: usize, ends: &[Moving]) -> Value {
        let [r, v, a] = std::array::from_fn(|i| ends[1][i] - ends[0][i]);
        let (w, alpha) = (self.k.twist[body].w, self.bodies[body].w);
        let (turned, tangential, centripetal) = (r.perp() * w, r.perp() * alpha, -r * (w * w));
        let relative = v - turned;
        let coriolis = relative.perp() * w.scale(2.0);
        let vector = |v: Vec2<Symbol>| {
            let (mut told, own) = (self.vector(v), self.k.pose[body].turn.undo(v));
            told["own"] = json!([tree(own.x), tree(own.y)]);
            told
        };
        let it = &self.m.bodies[body];
        json!({
            "body": it.name, "pin": it.tree_joint.map(|branch| &self.m.joints[branch.joint].name),
            "angle": tree(self.k.pose[body].turn.angle), "omega": tree(w), "alpha": tree(alpha),
            "r": vector(r), "turned": vector(turned), "v_relative": vector(relative),
            "tangential": vector(tangential), "centripetal": vector(centripetal), "coriolis": vector(coriolis),
            "a_relative": vector(a - tangential - centripetal - coriolis),
        })
    }

    /// The rates of the states that have one of their own.
    pub(super) fn state_rates(&self) -> Value {
        Value::Array(self.m.state_rates.iter().map(|rate| json!(tree(rate.eval(&State(self.at()))))).collect())
    }

    /// What loops, motions and closed limits ask, of the coordinates.
    pub(super) fn rows(&self) -> Value {
        Value::Array(self.closing().iter().map(|row| self.row(row)).collect())
    }

    /// What closes loops, prescribes motions and holds limits.
    pub(super) fn closing(&self) -> Vec<Row<Symbol>> {
        let mut rows = closing_rows(self.at(), Some(&self.bodies));
        rows.retain(|row| !self.holds_what_was_left(row));
        self.joint_origins(&self.k, &self.bodies, &mut rows);
        rows
    }

    /// Whether a row is of no part of the model, but holds a massless body on a curve that was left.
    pub(super) fn holds_what_was_left(&self, row: &Row<Symbol>) -> bool {
        matches!(row.source, Source::Drive(drive) if self.m.drives[drive].kind == DriveKind::Hold)
    }

    /// Tells the rows of joint origins along the fixed axes: from the first point to the second, with its rate and its
    /// acceleration; and every row from where an event engaged its joint.
    pub(super) fn joint_origins(&self, k: &Kinematics<Symbol>, bodies: &[Twist<Symbol>], rows: &mut [Row<Symbol>]) {
        let place = |site: usize, shift: Vec2<Symbol>| {
            let body = self.m.body_of(site);
            moving(k, bodies, body, k.pose[body].turn.apply(self.n.arms[site]) + shift)
        };
        for row in rows {
            let Source::Joint(index, r) = row.source else { continue };
            let joint = &self.m.joints[index];
            row.value = row.value.map(|value| value - self.at().engaged_at(index, r));
            if let Some(axis) = self.card_of(row).and_then(|card| card.pin) {
                let first = place(joint.first.site, self.at().pin_shift(index));
                let second = place(joint.second.site, Vec2::zero());
                let [value, rate, bias] =
                    std::array::from_fn(|i| [(second[i] - first[i]).x, (second[i] - first[i]).y][axis]);
                (row.value, row.rate, row.bias) = (Some(value), Some(rate), bias);
            }
        }
    }

    /// What the card of a joint says of one of its rows; a joint along a curve has rows besides.
    fn card_of(&self, row: &Row<Symbol>) -> Option<RowCard> {
        let Source::Joint(joint, r) = row.source else { return None };
        self.m.joints[joint].kind.card().rows.into_iter().nth(r)
    }

    fn row(&self, row: &Row<Symbol>) -> Value {
        self.row_in(row, &self.unknowns())
    }

    /// A row with its acceleration as coefficients of unknowns.
    pub(super) fn row_in(&self, row: &Row<Symbol>, unknowns: &[Variable]) -> Value {
        let kind = match row.source {
            Source::Joint(joint, _) if !self.m.joints[joint].is_holonomic() => "non-holonomic",
            Source::Joint(..) => "joint",
            Source::Drive(drive) => self.m.drives[drive].kind.word(),
            Source::Gap(limit) | Source::Friction(limit) => self.m.groups[self.m.unilateral[limit].group].word,
            Source::JointFriction(_) => "friction",
        };
        // Of gears only the change counts: their place holds a constant of the assembly.
        let value = row.value.filter(|_| !self.card_of(row).is_some_and(|card| card.is_relative));
        json!({
            "name": row.source.name(self.m), "kind": kind, "value": value.map(tree), "rate": row.rate.map(tree),
            "acceleration": tree(row.bias), "linear": linear_in(row.bias, unknowns),
        })
    }
}

impl SymbolicState<'_> {
    /// A vector in named unit directions.
    pub(super) fn vector(&self, v: Vec2<Symbol>) -> Value {
        let coordinates: Vec<Variable> =
            (0..self.m.freedom()).map(|i| Variable::new(&self.m.coordinate(i).name, 0)).collect();
        presented(v, &coordinates)
    }
}
