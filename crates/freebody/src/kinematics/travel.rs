//! How far bodies go while the coordinates go their ways: a bound, found in one pass along the tree.

use super::view::measured;
use super::{Poses, StateView};
use crate::mechanism::{Joint, TreeJoint};
use crate::plane::{Pose, Turn, Vec2};
use crate::scalar::{Ball, Scalar};

/// Parts of the motions that are followed, and the one by which each coordinate goes for itself.
pub const PARTS: usize = 4;
const ALONE: usize = PARTS - 1;

/// Bounds of how far the bodies go from a state while each coordinate goes by Σₖ wₖ dₖ, where |wₖ| ≤ 1: all coordinates
/// together, so that what opposite turns leave of each other is found, but in the last part each for itself.
#[derive(Clone, Debug, Default)]
pub struct Travel {
    /// Of each body, how far its joint origin goes at most, m.
    way: Vec<f64>,
    /// How far it turns at most, rad.
    turn: Vec<f64>,
    /// How far it turns in each part of the motion, rad.
    turns: Vec<[f64; PARTS]>,
    /// How far each coordinate goes at most.
    change: Vec<f64>,
    /// How far time goes, s.
    time: f64,
}

impl Travel {
    /// Takes a motion that is never more than `time` from the state, by the changes dₖ of each coordinate. What hangs on a joint along a
    /// curve may go anywhere.
    pub fn follow(&mut self, at: StateView<'_>, changes: impl Fn(usize) -> [f64; PARTS], time: f64) {
        let bodies = at.m.bodies.len();
        self.time = time;
        self.way.resize(bodies, 0.0);
        self.turn.resize(bodies, 0.0);
        self.turns.resize(bodies, [0.0; PARTS]);
        self.change.resize(at.q.len(), 0.0);
        for body in 1..bodies {
            let Some(b) = at.m.bodies[body].tree_joint else { continue };
            let (joint, carried) = (&at.m.joints[b.joint], self.turns[b.parent]);
            let mut turned = if at.m.bodies[body].particle { [0.0; PARTS] } else { carried };
            let (mut shift, mut spin, mut relative) = (0.0, 0.0, 0.0);
            for (j, coordinate) in joint.coordinates.iter().enumerate() {
                let (i, reading) = (b.start + j, coordinate.reading(&at.n.values));
                let (column, is_shift) = (at.k.motion_subspace[body][j].w, !b.hinge && coordinate.dimension == "m");
                let changes = changes(i);
                self.change[i] = changes.iter().map(|change| change.abs()).sum();
                let mut own: [f64; PARTS] =
                    std::array::from_fn(|k| reading.to_joint(0.0, changes[k], 0.0, carried[k]).1);
                (0..ALONE).for_each(|k| turned[k] += column * own[k]);
                // What is read from a fixed axis takes back what is carried.
                let taken = if reading.absolute { 1.0 } else { 0.0 };
                own[ALONE] = changes[ALONE].abs() + taken * carried[ALONE];
                turned[ALONE] = turned[ALONE] * (1.0 - taken * column).abs() + (column * changes[ALONE]).abs();
                let sum: f64 = own.iter().map(|own| own.abs()).sum();
                *(if is_shift { &mut shift } else { &mut spin }) += sum;
                relative += column.abs() * sum;
            }
            if joint.curve.is_some() {
                turned = [f64::INFINITY; PARTS];
            }
            self.turns[body] = turned;
            self.turn[body] = turned.iter().map(|turn| turn.abs()).sum();
            let swing = self.turn[b.parent] * at.k.arm[body].norm();
            self.way[body] = self.way[b.parent] + swing + joint_way(at, body, joint, b, [shift, spin, relative]);
        }
    }

    /// How far each coordinate goes at most.
    pub fn changes(&self) -> &[f64] {
        &self.change
    }

    /// How far time goes, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How far the points of a body within a reach of its joint origin go at most, m.
    pub fn way_within(&self, body: usize, reach: f64) -> f64 {
        // A body that does not turn may have an infinite reach: 0 · ∞ is no number.
        let swing = if self.turn[body] > 0.0 { self.turn[body] * reach } else { 0.0 };
        self.way[body] + swing
    }

    /// How far the joint origin of a body goes at most, m.
    pub fn way(&self, body: usize) -> f64 {
        self.way[body]
    }
}

/// How far a joint moves the origin of the body that it carries in the axes of the other, its coordinates shifting and turning
/// by so much, and the one body turning by so much `relative` to the other: what they turn is no longer than from one body's point
/// to the other's, and what hangs on its second body turns with that, too.
fn joint_way(at: StateView<'_>, body: usize, joint: &Joint, b: TreeJoint, [shift, spin, relative]: [f64; 3]) -> f64 {
    match (b.hinge, joint.curve) {
        (true, _) => 0.0,
        (_, Some(_)) => f64::INFINITY,
        _ => {
            let from = at.k.pose[b.parent].turn.apply(at.n.arms[joint.sides(b.reversed).0.site]);
            let turns = spin + if b.reversed { relative } else { 0.0 };
            shift + turns * ((at.k.arm[body] - from).norm() + shift)
        }
    }
}

/// A state with bounds of how far everything goes about it: measures come with theirs.
pub struct TravelView<'a> {
    /// The state.
    pub at: StateView<'a>,
    /// How far its bodies go.
    pub travel: &'a Travel,
}

impl Poses<Ball> for TravelView<'_> {
    fn pose(&self, body: usize) -> Pose<Ball> {
        let (Pose { at, turn }, way, radius) = (self.at.k.pose[body], self.travel.way[body], self.travel.turn[body]);
        let about = |mid: f64, radius: f64| Ball { mid, radius };
        let chord = radius.min(2.0);
        Pose {
            at: Vec2 { x: about(at.x, way), y: about(at.y, way) },
            turn: Turn { angle: about(turn.angle, radius), cos: about(turn.cos, chord), sin: about(turn.sin, chord) },
        }
    }
    fn arm(&self, site: usize) -> Vec2<Ball> {
        let arm = self.at.n.arms[site];
        Vec2 { x: Ball::of(arm.x), y: Ball::of(arm.y) }
    }
    fn value(&self, id: usize) -> Ball {
        Ball::of(self.at.n.values[id])
    }
    fn parameter(&self, i: usize) -> Ball {
        Ball::of(self.at.n.p[i])
    }
    fn state(&self, i: usize) -> Ball {
        Ball { mid: self.at.state(i), radius: f64::INFINITY }
    }
    fn time(&self) -> Ball {
        Ball { mid: self.at.t, radius: self.travel.time }
    }
    fn coordinate(&self, joint: usize, k: usize) -> Ball {
        match self.at.m.place_in_q(joint, k) {
            Some(i) => Ball { mid: self.at.q[i], radius: self.travel.change[i] },
            None => measured(self.at.m, self.at.n, self, joint, k, Ball::of),
        }
    }
}
