//! The loads of a solved instant in numbers, as data for whoever draws or reasons.

use super::{follow_presses, loads, Load, Origin, Part, Size};
use crate::balance::{closing_rows, Balance, Labels, Source, Trouble};
use crate::joints::Joint as _;
use crate::mechanism::Mechanism;
use crate::plane::{Twist, Vec2};
use serde_json::{json, Map, Value};

/// Part of a load's force times the characteristic length below which its couple is round-off.
const NO_COUPLE: f64 = 1e-12;

/// Bodies, loads with their sizes, and what joints and motions ask of the accelerations, at the state of `balance`.
///
/// # Errors
/// `not_finite`; as [`Balance::solve`].
pub fn free_bodies(balance: &mut Balance<'_>) -> Result<Value, Trouble> {
    balance.solve()?;
    if !balance.solved().nu_dot.iter().all(|a| a.is_finite()) {
        return Err(Trouble::not_finite());
    }
    let labels = balance.labels();
    let sizes = Sizes::of(balance, &labels);
    let at = balance.at();
    let m = balance.m;
    let mut all = loads(at);
    let found: Vec<(Option<f64>, bool)> = all.iter().map(|load| sizes.of_load(balance, load, &all)).collect();
    let values: Vec<f64> = found.iter().map(|(value, _)| value.unwrap_or(1.0)).collect();
    follow_presses(at, &mut all, &values);
    let told: Vec<Value> = all.iter().zip(found).map(|(load, size)| tell(balance, load, size)).collect();
    let still = vec![0.0; m.freedom()];
    let spread = |of_coordinates: &[f64]| at.k.spread_user(m, at.n, of_coordinates);
    let drift = spread(&still);
    let unit = |j: usize| -> Vec<Twist> {
        let mut one = still.clone();
        one[j] = 1.0;
        spread(&one).iter().zip(&drift).map(|(a, d)| *a + *d * -1.0).collect()
    };
    let units: Vec<Vec<Twist>> = (0..m.freedom()).map(unit).collect();
    let bodies: Vec<Value> = m.listed_bodies().into_iter().map(|i| body(balance, i, &drift, &units)).collect();
    let rows: Vec<Value> = closing_rows(at, Some(&drift))
        .iter()
        .map(|row| {
            let power = |motion: &[Twist]| -> f64 { row.motion.iter().map(|(b, w)| w.power(motion[*b])).sum() };
            let coefficients: Map<String, Value> =
                (0..m.freedom()).map(|j| (m.coordinate(j).name.clone(), json!(power(&units[j])))).collect();
            json!({"name": row.source.name(m), "coefficients": coefficients, "right": -row.bias})
        })
        .collect();
    let mut found = vec![0.0; m.freedom()];
    balance.accelerations(&mut found);
    let accelerations: Map<String, Value> =
        found.iter().enumerate().map(|(j, a)| (m.coordinate(j).name.clone(), json!(a))).collect();
    Ok(json!({"bodies": bodies, "loads": told, "rows": rows, "accelerations": accelerations}))
}

fn xy(v: Vec2) -> Value {
    json!([v.x, v.y])
}

/// Acceleration of the mass centre and angular acceleration, by those of the pin; `w` the angular velocity.
fn at_centre(arm: Vec2, pin: Twist, w: f64) -> [f64; 3] {
    let a = pin.at(arm) - arm * (w * w);
    [a.x, a.y, pin.w]
}

fn body(balance: &Balance<'_>, i: usize, drift: &[Twist], units: &[Vec<Twist>]) -> Value {
    let (at, m) = (balance.at(), balance.m);
    let (body, pose, twist) = (&m.bodies[i], at.k.pose[i], at.k.twist[i]);
    let centre = at.mass_centre(i);
    let arm = centre - pose.at;
    let origin = m.sites.iter().position(|s| s.body == i).expect("every body has its origin as a site");
    let found = at_centre(arm, balance.solved().bodies[i], twist.w);
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
        "by_accelerations": by, "drift": at_centre(arm, drift[i], twist.w),
    })
}

fn tell(balance: &Balance<'_>, load: &Load<f64>, (value, determinate): (Option<f64>, bool)) -> Value {
    let m = balance.m;
    let (kind, name, path) = described(m, load);
    let axis = if let Origin::Pin(_, axis) = load.origin { Some(["x", "y"][axis]) } else { None };
    let parts: Vec<Value> = load.parts.iter().map(|p| part(balance, p)).collect();
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

/// A part, its couple taken up by the place of the force where there is one, round-off left out.
fn part(balance: &Balance<'_>, p: &Part<f64>) -> Value {
    let size = p.force.norm();
    let (mut point, mut couple) = (p.point, p.couple);
    if couple.abs() <= NO_COUPLE * size * balance.length {
        couple = 0.0;
    } else if size > 0.0 {
        point = p.point + p.force.perp() * (-couple / (size * size));
        couple = 0.0;
    }
    json!({"body": balance.m.bodies[p.body].name, "point": xy(point), "force": xy(p.force), "couple": couple})
}

/// Kind, name and place in the model of a load.
fn described<'m>(m: &'m Mechanism, load: &Load<f64>) -> (&'static str, &'m str, String) {
    let of = |kind, source: Source| (kind, source.name(m), source.path(m));
    let group = |limit: usize| m.groups[m.limits[limit].group].word;
    match load.origin {
        Origin::Weight(body) => ("weight", &m.bodies[body].name, format!("bodies.{}", m.bodies[body].name)),
        Origin::Force(force, _) => ("force", &m.forces[force].name, format!("forces.{}", m.forces[force].name)),
        Origin::Pin(joint, axis) => of("joint", Source::Joint(joint, axis)),
        Origin::Row(source @ Source::Joint(..)) => of("joint", source),
        Origin::Row(source @ Source::Drive(drive)) if m.drives[drive].coupling => of("coupling", source),
        Origin::Row(source @ Source::Drive(_)) => of("motion", source),
        Origin::Row(source @ Source::Limit(limit)) => of(group(limit), source),
        Origin::Pressed(limit) => of(group(limit), Source::Limit(limit)),
        Origin::Sliding(limit) => of("friction", Source::Limit(limit)),
        Origin::Row(source @ (Source::Friction(_) | Source::Rub(_))) => of("friction", source),
        Origin::Rubbing(rub) => of("friction", Source::Rub(rub)),
    }
}

/// The sizes of all unknown loads in the last solution, and whether they are determinate.
struct Sizes<'l> {
    labels: &'l Labels,
    joints: Vec<(Vec2, Vec<f64>)>,
    drives: Vec<f64>,
    limits: Vec<[f64; 2]>,
}

impl<'l> Sizes<'l> {
    fn of(b: &Balance<'_>, labels: &'l Labels) -> Self {
        let loads = b.joint_loads();
        let joints = loads.iter().enumerate().map(|(j, l)| (l.force, rows_of(b, j))).collect();
        Sizes { labels, joints, drives: b.drive_forces(), limits: b.limit_forces() }
    }

    fn of_load(&self, b: &Balance<'_>, load: &Load<f64>, all: &[Load<f64>]) -> (Option<f64>, bool) {
        let m = b.m;
        let group = |limit: usize| m.limits[limit].group;
        if let Size::Follows(of, ratio) = load.size {
            let (normal, sure) = self.of_load(b, &all[of], all);
            return (normal.map(|n| n * ratio), sure);
        }
        match load.origin {
            Origin::Weight(_) | Origin::Force(..) => (None, true),
            Origin::Pin(joint, axis) => {
                let force = self.joints[joint].0;
                (Some([force.x, force.y][axis]), self.labels.joints[joint][axis])
            }
            Origin::Row(Source::Joint(joint, row)) => {
                let of = &m.joints[joint];
                let at = of.rows.iter().position(|&r| r == row).expect("a row of the joint");
                let sign = of.kind.card().rows[row].sign();
                (Some(sign * self.joints[joint].1[at]), self.is_sure(joint, load, all))
            }
            Origin::Row(Source::Drive(drive)) => (Some(self.drives[drive]), self.labels.drives[drive]),
            Origin::Row(Source::Limit(l)) => (Some(self.limits[l][0]), self.labels.groups[group(l)][2]),
            Origin::Row(Source::Friction(l)) => (Some(self.limits[l][1]), self.labels.groups[group(l)][3]),
            Origin::Row(Source::Rub(rub)) | Origin::Rubbing(rub) => (Some(b.rub_force(rub)), true),
            Origin::Pressed(l) | Origin::Sliding(l) => (Some(b.press(l)), true),
        }
    }

    /// Whether the load of a row is determinate: where all components of its joint are, or those of its force that no other row
    /// of the joint shares.
    fn is_sure(&self, joint: usize, load: &Load<f64>, all: &[Load<f64>]) -> bool {
        let labels = self.labels.joints[joint];
        let own = along(load);
        let of_joint = |other: &&Load<f64>| matches!(other.origin, Origin::Row(Source::Joint(j, _)) if j == joint);
        let others = all.iter().filter(of_joint).filter(|other| other.symbol != load.symbol);
        let alone = !others.map(along).any(|other| (0..2).any(|axis| own[axis] && other[axis]));
        let pushes = own.contains(&true);
        labels.iter().all(|&sure| sure) || (pushes && alone && (0..2).all(|axis| !own[axis] || labels[axis]))
    }
}

/// Whether a load has a force along x, and along y.
fn along(load: &Load<f64>) -> [bool; 2] {
    let any = |of: fn(&Part<f64>) -> f64| load.parts.iter().any(|part| of(part) != 0.0);
    [any(|part| part.force.x), any(|part| part.force.y)]
}

fn rows_of(b: &Balance<'_>, joint: usize) -> Vec<f64> {
    if b.m.joints[joint].rows.is_empty() {
        return vec![];
    }
    b.row_loads(joint)
}
