//! The loads of a solved instant in numbers, as data for whoever draws or reasons.

use super::{loads, relate_friction, Load, Origin, Part, Size};
use crate::dynamics::{closing_rows, plate_load, Determinacy, DynamicsError, Source, Workspace};
use crate::joints::Joint as _;
use crate::mechanism::Mechanism;
use crate::plane::{Twist, Vec2};
use serde_json::{json, Map, Value};

/// Part of the largest force of a load below which another is round-off; and times the characteristic length a couple.
const ROUND_OFF: f64 = 1e-12;

/// Bodies, loads with their sizes, and what joints and motions ask of the accelerations, at the state of the workspace;
/// what is closed without load and could carry one is held, with a force of 0.
///
/// # Errors
/// `not_finite`; as [`Workspace::solve`].
pub fn free_bodies(workspace: &mut Workspace<'_>) -> Result<Value, DynamicsError> {
    let unloaded = workspace.hold_unloaded()?;
    workspace.solve()?;
    workspace.check_finite()?;
    let determinacy = workspace.determinacy();
    let sizes = LoadValues::of(workspace, &determinacy, &unloaded);
    let at = workspace.at();
    let m = workspace.m;
    let mut all = loads(at);
    let found: Vec<(Option<f64>, bool)> = all.iter().map(|load| sizes.of_load(workspace, load, &all)).collect();
    let values: Vec<f64> = found.iter().map(|(value, _)| value.unwrap_or(1.0)).collect();
    relate_friction(at, &mut all, &values);
    let entries: Vec<Value> = all.iter().zip(found).map(|(load, size)| load_data(workspace, load, size)).collect();
    let at_rest = vec![0.0; m.freedom()];
    let wrenches = |of_coordinates: &[f64]| at.k.propagate_user_motion(m, at.n, of_coordinates);
    let bias = wrenches(&at_rest);
    let unit = |j: usize| -> Vec<Twist> {
        let mut one = at_rest.clone();
        one[j] = 1.0;
        wrenches(&one).iter().zip(&bias).map(|(a, d)| *a + *d * -1.0).collect()
    };
    let units: Vec<Vec<Twist>> = (0..m.freedom()).map(unit).collect();
    let bodies: Vec<Value> = m.listed_bodies().into_iter().map(|i| body(workspace, i, &bias, &units)).collect();
    let rows: Vec<Value> = closing_rows(at, Some(&bias))
        .iter()
        .map(|row| {
            let power = |motion: &[Twist]| -> f64 { row.motion.iter().map(|(b, w)| w.power(motion[*b])).sum() };
            let coefficients: Map<String, Value> =
                (0..m.freedom()).map(|j| (m.coordinate(j).name.clone(), json!(power(&units[j])))).collect();
            json!({"name": row.source.name(m), "coefficients": coefficients, "right": -row.bias})
        })
        .collect();
    let mut found = vec![0.0; m.freedom()];
    workspace.accelerations(&mut found);
    let accelerations: Map<String, Value> =
        found.iter().enumerate().map(|(j, a)| (m.coordinate(j).name.clone(), json!(a))).collect();
    Ok(json!({"bodies": bodies, "loads": entries, "rows": rows, "accelerations": accelerations}))
}

fn xy(v: Vec2) -> Value {
    json!([v.x, v.y])
}

/// Acceleration of the mass centre and angular acceleration, by those of the joint origin; `w` the angular velocity.
fn at_centre(arm: Vec2, origin: Twist, w: f64) -> [f64; 3] {
    let a = origin.acceleration_at(arm, w);
    [a.x, a.y, origin.w]
}

fn body(workspace: &Workspace<'_>, i: usize, bias: &[Twist], units: &[Vec<Twist>]) -> Value {
    let (at, m) = (workspace.at(), workspace.m);
    let (body, pose, twist) = (&m.bodies[i], at.k.pose[i], at.k.twist[i]);
    let centre = at.mass_centre(i);
    let arm = centre - pose.at;
    let origin = m.sites.iter().position(|s| s.body == i).expect("every body has its origin as a site");
    let found = at_centre(arm, workspace.solved().bodies[i], twist.w);
    let by: Map<String, Value> = units
        .iter()
        .enumerate()
        .map(|(j, u)| (m.coordinate(j).name.clone(), json!(at_centre(arm, u[i], 0.0))))
        .collect();
    json!({
        "name": body.name, "particle": body.particle, "mass": at.n.mass[i],
        "inertia": if body.particle { 0.0 } else { at.n.inertia[i] },
        "at": xy(pose.place(at.n.arms[origin])), "angle": pose.turn.angle,
        "G": xy(centre), "v": xy(twist.at(arm)), "omega": twist.w,
        "a": [found[0], found[1]], "alpha": if body.particle { 0.0 } else { found[2] },
        "by_accelerations": by, "bias": at_centre(arm, bias[i], twist.w),
    })
}

fn load_data(workspace: &Workspace<'_>, load: &Load<f64>, (value, determinate): (Option<f64>, bool)) -> Value {
    let m = workspace.m;
    let (kind, name, path) = described(m, load);
    let axis = match load.origin {
        Origin::Pin(_, axis) | Origin::Plate(_, axis @ 0..2) => Some(["x", "y"][axis]),
        _ => None,
    };
    let largest = load.parts.iter().map(|p| p.force.norm()).fold(0.0, f64::max);
    let parts: Vec<Value> = load.parts.iter().map(|p| part(workspace, p, largest)).collect();
    let follows = match load.size {
        Size::Follows(of, ratio) => json!({"load": of, "ratio": ratio}),
        _ => Value::Null,
    };
    json!({
        "name": name, "path": path, "symbol": load.symbol, "kind": kind, "axis": axis, "card": load.card, "number": load.number,
        "unknown": !matches!(load.size, Size::Known), "follows": follows, "value": value, "determinate": determinate,
        "of": load.of.map(|b| &m.bodies[b].name), "on": parts,
    })
}

/// A part of a load whose `largest` force is known, its couple taken up by the place of the force where there is one, round-off
/// left out.
fn part(workspace: &Workspace<'_>, p: &Part<f64>, largest: f64) -> Value {
    let force = if p.force.norm() > ROUND_OFF * largest { p.force } else { Vec2::zero() };
    let size = force.norm();
    let (mut point, mut couple) = (p.point, p.couple);
    if couple.abs() <= ROUND_OFF * largest * workspace.length {
        couple = 0.0;
    } else if size > 0.0 {
        point = p.point + force.perp() * (-couple / (size * size));
        couple = 0.0;
    }
    json!({"body": workspace.m.bodies[p.body].name, "point": xy(point), "force": xy(force), "couple": couple})
}

/// Kind, name and place in the model of a load.
fn described<'m>(m: &'m Mechanism, load: &Load<f64>) -> (&'static str, &'m str, String) {
    let of = |kind, source: Source| (kind, source.name(m), source.path(m));
    let group = |constraint: usize| m.groups[m.unilateral[constraint].group].word;
    match load.origin {
        Origin::Weight(body) => ("weight", &m.bodies[body].name, format!("bodies.{}", m.bodies[body].name)),
        Origin::Force(force, _) => ("force", &m.forces[force].name, format!("forces.{}", m.forces[force].name)),
        Origin::Plate(force, _) => ("friction", &m.forces[force].name, format!("forces.{}", m.forces[force].name)),
        Origin::Pin(joint, axis) => of("joint", Source::Joint(joint, axis)),
        Origin::Row(source @ Source::Joint(..)) => of("joint", source),
        Origin::Row(source @ Source::Drive(drive)) => of(m.drives[drive].kind.word(), source),
        Origin::Row(source @ Source::Gap(constraint)) => of(group(constraint), source),
        Origin::Compliant(constraint) => of(group(constraint), Source::Gap(constraint)),
        Origin::Sliding(constraint) => of("friction", Source::Gap(constraint)),
        Origin::Row(source @ (Source::Friction(_) | Source::JointFriction(_))) => of("friction", source),
        Origin::JointFriction(friction) => of("friction", Source::JointFriction(friction)),
    }
}

/// The sizes of all unknown loads in the last solution, and whether they are determinate.
struct LoadValues<'l> {
    determinacy: &'l Determinacy,
    joints: Vec<(Vec2, Vec<f64>)>,
    drives: Vec<f64>,
    contacts: Vec<[f64; 2]>,
}

impl<'l> LoadValues<'l> {
    /// Those of `unloaded` constraints are 0 without round-off.
    fn of(b: &Workspace<'_>, determinacy: &'l Determinacy, unloaded: &[usize]) -> Self {
        let seen = b.solved_view();
        let loads = seen.joint_loads();
        let joints = loads.iter().enumerate().map(|(j, l)| (l.force, rows_of(b, j))).collect();
        let mut contacts = seen.contact_forces();
        unloaded.iter().for_each(|&l| contacts[l] = [0.0; 2]);
        LoadValues { determinacy, joints, drives: seen.drive_forces(), contacts }
    }

    fn of_load(&self, b: &Workspace<'_>, load: &Load<f64>, all: &[Load<f64>]) -> (Option<f64>, bool) {
        let m = b.m;
        let group = |constraint: usize| m.unilateral[constraint].group;
        if let Size::Follows(of, ratio) = load.size {
            let (normal, sure) = self.of_load(b, &all[of], all);
            return (Some(normal.unwrap_or(1.0) * ratio), sure);
        }
        match load.origin {
            Origin::Weight(_) | Origin::Force(..) | Origin::Compliant(_) | Origin::Sliding(_) => (None, true),
            Origin::Plate(force, k) => (Some(plate_load(b.at(), force).parts()[k]), true),
            Origin::Pin(joint, axis) => {
                let force = self.joints[joint].0;
                (Some([force.x, force.y][axis]), self.determinacy.joints[joint][axis])
            }
            Origin::Row(Source::Joint(joint, row)) => {
                let of = &m.joints[joint];
                let at = of.rows.iter().position(|&r| r == row).expect("a row of the joint");
                let sign = of.kind.card().rows[row].sign();
                (Some(sign * self.joints[joint].1[at]), self.is_sure(joint, load, all))
            }
            Origin::Row(Source::Drive(drive)) => (Some(self.drives[drive]), self.determinacy.drives[drive]),
            Origin::Row(Source::Gap(l)) => (Some(self.contacts[l][0]), self.determinacy.groups[group(l)][2]),
            Origin::Row(Source::Friction(l)) => (Some(self.contacts[l][1]), self.determinacy.groups[group(l)][3]),
            Origin::Row(Source::JointFriction(friction)) | Origin::JointFriction(friction) => {
                (Some(b.solved_view().joint_friction_force(friction)), true)
            }
        }
    }

    /// Whether the load of a row is determinate: where all components of its joint are, or those of its force that no
    /// other row of the joint shares.
    fn is_sure(&self, joint: usize, load: &Load<f64>, all: &[Load<f64>]) -> bool {
        let determinacy = self.determinacy.joints[joint];
        let own = along(load);
        let of_joint = |other: &&Load<f64>| matches!(other.origin, Origin::Row(Source::Joint(j, _)) if j == joint);
        let others = all.iter().filter(of_joint).filter(|other| other.symbol != load.symbol);
        let alone = !others.map(along).any(|other| (0..2).any(|axis| own[axis] && other[axis]));
        let point_forces = own.contains(&true);
        determinacy.iter().all(|&sure| sure)
            || (point_forces && alone && (0..2).all(|axis| !own[axis] || determinacy[axis]))
    }
}

/// Whether a load has a force along x, and along y.
fn along(load: &Load<f64>) -> [bool; 2] {
    let any = |of: fn(&Part<f64>) -> f64| load.parts.iter().any(|part| of(part) != 0.0);
    [any(|part| part.force.x), any(|part| part.force.y)]
}

fn rows_of(b: &Workspace<'_>, joint: usize) -> Vec<f64> {
    if b.m.joints[joint].rows.is_empty() {
        return vec![];
    }
    b.solved_view().row_loads(joint)
}
