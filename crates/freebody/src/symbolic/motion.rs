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

    /// Velocity and acceleration of a point through a body: what the body carries, what the point does against it, and
    /// Coriolis's part. They add up to the whole.
    pub(super) fn frame(&self, point: &str, body: &str) -> Result<Value, DynamicsError> {
        let (site, frame) = (self.point(point)?, self.body(body)?);
        let own = self.m.body_of(site);
        let turn = self.k.pose[own].turn;
        let arm = turn.apply(self.n.arms[site]);
        let place = self.k.pose[own].at + arm;
        let v = self.k.twist[own].at(arm);
        let a = self.bodies[own].acceleration_at(arm, self.k.twist[own].w);
        let (twist, origin, w) = (self.k.twist[frame], self.bodies[frame], self.k.twist[frame].w);
        let reach = place - self.k.pose[frame].at;
        let v_transport = twist.at(reach);
        let v_relative = v - v_transport;
        let a_transport = origin.acceleration_at(reach, w);
        let coriolis = v_relative.perp() * w.scale(2.0);
        Ok(json!({
            "v": self.vector(v), "v_transport": self.vector(v_transport), "v_relative": self.vector(v_relative),
            "a": self.vector(a), "a_transport": self.vector(a_transport), "a_coriolis": self.vector(coriolis),
            "a_relative": self.vector(a - a_transport - coriolis), "omega": tree(w), "alpha": tree(origin.w),
        }))
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
    /// acceleration.
    pub(super) fn joint_origins(&self, k: &Kinematics<Symbol>, bodies: &[Twist<Symbol>], rows: &mut [Row<Symbol>]) {
        let place = |site: usize| -> [Vec2<Symbol>; 3] {
            let body = self.m.body_of(site);
            let (pose, twist) = (k.pose[body], k.twist[body]);
            let arm = pose.turn.apply(self.n.arms[site]);
            [pose.at + arm, twist.at(arm), bodies[body].acceleration_at(arm, twist.w)]
        };
        for row in rows {
            let Source::Joint(joint, _) = row.source else { continue };
            let joint = &self.m.joints[joint];
            if let Some(axis) = self.card_of(row).and_then(|card| card.pin) {
                let (first, second) = (place(joint.first.site), place(joint.second.site));
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
