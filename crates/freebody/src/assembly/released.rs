//! Where a body starts whose joint can be released: where that joint would carry it in the tree.

use super::AssemblyRequest;
use crate::dynamics::Workspace;
use crate::gauges::ModelVariable;
use crate::joints::Kind;
use crate::kinematics::JointView;
use crate::mechanism::{Joint, TreeJoint};
use crate::plane::Turn;

/// The starting coordinates, with those of bodies that are free from ground for the sake of a joint that can be released,
/// and of which nothing else is said, as that joint's coordinates have them. Rows that count only changes (rolling, a
/// string that winds up) leave the place of such a body open: it is the same whether or not the joint can be released.
pub(super) fn start(workspace: &mut Workspace, t: f64, request: &AssemblyRequest) -> Vec<f64> {
    let (m, mut q) = (workspace.m, request.start.clone());
    let at_rest = vec![0.0; q.len()];
    for joint in m.joints.iter().filter(|joint| joint.child.is_none() && !joint.coordinates.is_empty()) {
        let open = |body: usize| m.bodies[body].tree_joint.filter(|free| is_open(&m.joints[free.joint], free, request));
        let [first, second] = m.ends(joint);
        let (free, reversed) = match (open(second), open(first)) {
            (Some(free), _) => (free, false),
            (None, Some(free)) => (free, true),
            (None, None) => continue,
        };
        workspace.move_to(t, &q, &at_rest);
        let place = carried(workspace, joint, reversed, request);
        q[free.start..free.start + free.freedom].copy_from_slice(&place[..free.freedom]);
    }
    q
}

/// Whether nothing is said of the coordinates of a free body.
fn is_open(joint: &Joint, free: &TreeJoint, request: &AssemblyRequest) -> bool {
    let own = free.start..free.start + free.freedom;
    joint.kind == Kind::Free && free.parent == 0 && own.clone().all(|i| request.free[i] && request.start[i] == 0.0)
}

/// Place and angle of the second body of a joint, of the first if `reversed`, m and rad, as the joint's coordinates are
/// asked for; 0 where they are not.
fn carried(workspace: &Workspace, joint: &Joint, reversed: bool, request: &AssemblyRequest) -> [f64; 3] {
    let at = workspace.at();
    let (near, far) = joint.sides(reversed);
    let base = at.k.pose[at.m.body_of(near.site)];
    let axes = Turn::by(base.turn.angle + at.n.values[near.angle]);
    let index = at.m.joints.iter().position(|other| std::ptr::eq(other, joint));
    let mut own = [0.0; 3];
    for (k, coordinate) in joint.coordinates.iter().enumerate() {
        let is_this =
            |law: &ModelVariable| matches!(law, ModelVariable::Coordinate(j, i) if Some(*j) == index && *i == k);
        let mut asked = request.held.iter().chain(&request.near);
        let value = asked.find(|(_, law, _)| law.as_variable().is_some_and(is_this)).map_or(0.0, |(.., value)| *value);
        (own[coordinate.card], _) = coordinate.reading(&at.n.values).to_joint(value, 0.0, axes.angle, 0.0);
    }
    let seen = JointView::new(at.m, at.n, joint, |x: f64| x).pose(&own[..joint.size], reversed);
    let angle = axes.angle + seen.angle - at.n.values[far.angle];
    let marker = base.at + base.turn.apply(at.n.arms[near.site]) + axes.apply(seen.at());
    let origin = marker - Turn::by(angle).apply(at.n.arms[far.site]);
    [origin.x, origin.y, angle]
}
