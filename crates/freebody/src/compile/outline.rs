//! Polygons and polylines as convex chains.

use crate::builder::{Builder, Result};
use crate::error::CompileError;
use crate::mechanism::Chain;
use crate::plane::Vec2;
use crate::spec::Value;

/// Sine of the turn at a corner below which its sides are one; and height over a side, in parts of the outline's size,
/// below which a corner is behind it.
const STRAIGHT: f64 = 1e-9;

/// A corner of an outline, as the model names it.
#[derive(Clone)]
pub(crate) struct Corner {
    name: String,
    site: usize,
    /// Where it is on its body, at the parameters' own values.
    at: Vec2,
}

/// An outline in convex parts.
pub(crate) struct Outline {
    /// Its convex chains.
    pub chains: Vec<Chain>,
    /// Sites of its convex corners, free ends among them: what can touch others.
    pub points: Vec<usize>,
}

impl Builder<'_> {
    /// The corners of an outline, on one body and each at a place of its own.
    pub(super) fn corners(&self, path: &str, names: &[String], arms: &[Vec2]) -> Result<Vec<Corner>> {
        let mut corners: Vec<Corner> = vec![];
        for (i, name) in names.iter().enumerate() {
            let site = self.names.site(name).map_err(|m| CompileError::from(path, m))?;
            let corner = Corner { name: name.clone(), site, at: arms[site] };
            if !corner.at.norm().is_finite() {
                return Err(CompileError::new(
                    path,
                    format!("`{name}` has no finite place"),
                    "look for a division by 0",
                ));
            }
            let body = |site| &self.m.bodies[self.m.body_of(site)].name;
            if let Some(first) = corners.first().filter(|first| body(first.site) != body(site)) {
                let what = format!("`{}` is on `{}` and `{name}` on `{}`", first.name, body(first.site), body(site));
                return Err(CompileError::new(path, what, "all corners are points of one body"));
            }
            // The last may be the first again.
            let skip = usize::from(i + 1 == names.len() && i > 2);
            if let Some(same) = corners.iter().skip(skip).find(|other| other.at == corner.at) {
                let what = format!("`{}` and `{name}` are at one place", same.name);
                return Err(CompileError::new(path, what, "give each corner once, in order"));
            }
            corners.push(corner);
        }
        Ok(corners)
    }

    /// Refuses the corners of an area of which sides cross, or that has none.
    pub(super) fn uncrossed(&self, path: &str, area: &Value) -> Result<()> {
        let Value::List(corners) = area else { return Ok(()) };
        let names: Vec<String> = corners.iter().filter_map(|corner| corner.text().map(str::to_string)).collect();
        let corners = self.corners(path, &names, &self.m.bind(&self.m.parameters_with(&[])).arms)?;
        let side = |i: usize| [&corners[i], &corners[(i + 1) % corners.len()]];
        let apart = |[a, b]: [&Corner; 2], c: &Corner, d: &Corner| {
            (b.at - a.at).cross(c.at - a.at) * (b.at - a.at).cross(d.at - a.at) < 0.0
        };
        for i in 0..corners.len() {
            for j in 0..i {
                let ([a, b], [c, d]) = (side(i), side(j));
                if apart([a, b], c, d) && apart([c, d], a, b) {
                    let what = format!("the sides `{}` `{}` and `{}` `{}` cross", c.name, d.name, a.name, b.name);
                    return Err(CompileError::new(path, what, "give the corners in order, one way round"));
                }
            }
        }
        without_straight(path, corners, true).and_then(|left| match left.len() {
            0..3 => Err(CompileError::new(path, "this polygon has no area", "give corners that are not in one line")),
            _ => Ok(()),
        })
    }
}

impl Outline {
    /// A convex polygon.
    pub(super) fn polygon(path: &str, mut corners: Vec<Corner>) -> Result<Outline> {
        if corners.len() > 3 && joined(&corners) {
            corners.pop();
        }
        let n = corners.len();
        let area: f64 =
            (0..n).map(|i| (corners[i].at - corners[0].at).cross(corners[(i + 1) % n].at - corners[0].at)).sum();
        if area > 0.0 {
            corners.reverse();
        }
        let corners = without_straight(path, corners, true)?;
        if corners.len() < 3 {
            return Err(CompileError::new(
                path,
                "this polygon has no area",
                "give three corners or more, not in one line",
            ));
        }
        let n = corners.len();
        if let Some(i) = (0..n).find(|&i| turn(&corners, i) > 0.0) {
            let what = format!("this polygon is not convex at `{}`", corners[i].name);
            return Err(CompileError::new(path, what, "split it into convex polygons, each with a contact"));
        }
        let chain = chain(path, &corners, [None; 2], true)?;
        Ok(Outline { points: chain.corners.clone(), chains: vec![chain] })
    }

    /// A polyline, divided at its concave corners; one whose last point is its first goes round.
    pub(super) fn polyline(path: &str, corners: &[Corner]) -> Result<Outline> {
        if corners.len() < 2 {
            return Err(CompileError::new(path, "a polyline has two points at least", "add one, or write `point`"));
        }
        let goes_round = corners.len() > 3 && joined(corners);
        let mut corners =
            without_straight(path, corners[..corners.len() - usize::from(goes_round)].to_vec(), goes_round)?;
        let mut beyond = [None; 2];
        if goes_round {
            let Some(concave) = (0..corners.len()).find(|&i| turn(&corners, i) > 0.0) else {
                let chain = chain(path, &corners, beyond, true)?;
                return Ok(Outline { points: chain.corners.clone(), chains: vec![chain] });
            };
            corners.rotate_left(concave);
            beyond = [corners.last(), corners.get(1)].map(|corner| corner.map(|c| c.site));
            corners.push(corners[0].clone());
        }
        let end = corners.len() - 1;
        let (concave, convex): (Vec<usize>, Vec<usize>) = (1..end).partition(|&i| turn(&corners, i) > 0.0);
        let ends = if goes_round { vec![] } else { vec![0, end] };
        let points = convex.into_iter().chain(ends).map(|i| corners[i].site).collect();
        let mut chains = vec![];
        let mut from = 0;
        for to in concave.into_iter().chain([end]) {
            let before = if from > 0 { Some(corners[from - 1].site) } else { beyond[0] };
            let after = if to < end { Some(corners[to + 1].site) } else { beyond[1] };
            chains.push(chain(path, &corners[from..=to], [before, after], false)?);
            from = to;
        }
        Ok(Outline { chains, points })
    }
}

/// Whether the last corner is the first again.
fn joined(corners: &[Corner]) -> bool {
    corners[0].at == corners[corners.len() - 1].at
}

/// Sine of the turn to the left at a corner; round and round.
fn turn(corners: &[Corner], i: usize) -> f64 {
    let [before, at, after] = around(corners, i);
    let (u, v) = (at.at - before.at, after.at - at.at);
    u.cross(v) / (u.norm() * v.norm())
}

fn around(corners: &[Corner], i: usize) -> [&Corner; 3] {
    let n = corners.len();
    [(i + n - 1) % n, i, (i + 1) % n].map(|i| &corners[i])
}

/// The corners at which the outline turns, and its ends.
fn without_straight(path: &str, corners: Vec<Corner>, closed: bool) -> Result<Vec<Corner>> {
    let n = corners.len();
    let mut kept = vec![];
    for (i, corner) in corners.iter().enumerate() {
        let inner = n > 2 && (closed || (i > 0 && i + 1 < n));
        if inner && turn(&corners, i).abs() < STRAIGHT {
            let [before, at, after] = around(&corners, i);
            if (at.at - before.at).dot(after.at - at.at) < 0.0 {
                let what = format!("the outline turns straight back at `{}`", corner.name);
                return Err(CompileError::new(path, what, "leave out what is walked twice"));
            }
            continue;
        }
        kept.push(corner.clone());
    }
    Ok(kept)
}

/// A chain of convex corners; all of it lies behind each of its sides.
fn chain(path: &str, corners: &[Corner], beyond: [Option<usize>; 2], closed: bool) -> Result<Chain> {
    let n = corners.len();
    for i in 0..n - usize::from(!closed) {
        let (from, to) = (corners[i].at, corners[(i + 1) % n].at);
        let along = (to - from) * (1.0 / (to - from).norm());
        let before = |corner: &&Corner| {
            let way = corner.at - from;
            along.cross(way) > STRAIGHT * way.norm()
        };
        if let Some(other) = corners.iter().find(before) {
            let what =
                format!("from `{}` on this outline turns until `{}` is in front of it", corners[i].name, other.name);
            return Err(CompileError::new(path, what, "give it in parts, each with a contact"));
        }
    }
    Ok(Chain { corners: corners.iter().map(|c| c.site).collect(), closed, beyond })
}
