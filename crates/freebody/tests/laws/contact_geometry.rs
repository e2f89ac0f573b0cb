//! Touches: gaps and slides of a disk and a surface, held against velocities of material points, contact forces and
//! distances found without pieces.

use crate::model::*;
use crate::scenes::*;
use freebody::kinematics::SeededView;
use freebody::mechanism::{Profile, Track};
use freebody::mode::Border;
use freebody::plane::{vec2, Vec2, Wrench};
use freebody::scalar::{Dual, Jet};

/// On every piece, with the disk brought to it: the jet's rates are those of the material points that touch, and the
/// gradients are contact forces.
#[test]
fn rates_are_of_the_material_points_and_gradients_are_contact_forces() {
    every_scene(|scene, there, _| {
        let (m, touch, label) = (&scene.m, &scene.touch, &scene.label);
        for feature in scene.pieces() {
            for _ in 0..2 {
                let at = there.at(m);
                let by = touch.contact(m, &at, feature).normal * -touch.gap(m, &at, feature);
                scene.shift(there, by);
            }
            let at = there.at(m);
            assert!(touch.gap(m, &at, feature).abs() < 1e-14, "{label}, {feature}");
            let c = touch.contact(m, &at, feature);
            assert!((c.normal.norm() - 1.0).abs() < 1e-14 && c.normal.cross(c.tangent) == -c.normal.dot(c.normal));
            let centre = scene.place(there, touch.disk.centre);
            let rim = centre - c.normal * scene.radius(there);
            assert!((rim - c.point).norm() < 1e-14, "{label}, {feature}: the point of contact is not on the disk");
            assert!(off_surface(scene, there, feature, c.point) < 1e-14, "{label}, {feature}: nor on the surface");

            let bodies = touch.bodies(m);
            let [v_a, v_b] = bodies.map(|b| at.k.twist[b].at(c.point - at.k.pose[b].at));
            let (gap, slide) = (touch.gap(m, &there.moving(m), feature), touch.slide(m, &there.moving(m), feature));
            let speed = [c.normal, c.tangent].map(|e| e.dot(v_a - v_b));
            assert!((gap.d1 - speed[0]).abs() < 1e-12, "{label}, {feature}: {} {}", gap.d1, speed[0]);
            assert!((slide.d1 - speed[1]).abs() < 1e-12, "{label}, {feature}: {} {}", slide.d1, speed[1]);

            for (body, sense) in bodies.into_iter().zip([1.0, -1.0]).filter(|(b, _)| *b > 0) {
                let seeded = SeededView { at, body };
                let found: [Dual<3>; 2] = [touch.gap(m, &seeded, feature), touch.slide(m, &seeded, feature)];
                for (found, e) in found.iter().zip([c.normal, c.tangent]) {
                    let mut load = Wrench::force(e * sense, c.point - at.k.pose[body].at);
                    if m.bodies[body].particle {
                        load.m = 0.0;
                    }
                    let load = load.parts();
                    let off = apart(&found.du, &load, 1.0);
                    assert!(off < 1e-12, "{label}, {feature}: {:?} {load:?}", found.du);
                }
            }
        }
    });
}

/// How far a point is from the surface of a piece.
fn off_surface(scene: &Scene, there: &There, feature: usize, p: Vec2) -> f64 {
    match &scene.touch.against {
        Profile::Line(marker) => {
            let body = scene.m.body_of(marker.site);
            let angle = there.k.pose[body].turn.angle + there.n.values[marker.angle];
            let free = vec2(-angle.sin(), angle.cos());
            free.dot(p - scene.place(there, marker.site)).abs()
        }
        Profile::Circle { centre, radius, .. } => {
            ((p - scene.place(there, *centre)).norm() - there.n.values[*radius]).abs()
        }
        Profile::Arc(_) => {
            let (hub, radius, ends) = scene.arc(there).expect("an arc");
            if feature == 0 {
                return ((p - hub).norm() - radius).abs();
            }
            let along = turned(vec2(1.0, 0.0), ends[feature - 1]);
            match scene.touch.disk.radius {
                Some(_) => (p - hub - along * radius).norm(),
                None => along.cross(p - hub).abs(),
            }
        }
        Profile::Track(track) => match track.stretches.get(feature) {
            Some(stretch) => {
                let [from, to] = stretch.ends.map(|site| scene.place(there, site));
                match stretch.centre.map(|site| scene.place(there, site)) {
                    Some(centre) => ((p - centre).norm() - (from - centre).norm()).abs(),
                    None => ((to - from).cross(p - from) / (to - from).norm()).abs(),
                }
            }
            None => (p - end_of(scene, there, track, feature)).norm(),
        },
        Profile::Chain(chain) => {
            let corner = |i: usize| scene.place(there, chain.corners[i % chain.corners.len()]);
            let first = feature == 2 * chain.sides();
            let (i, j) = if first { (0, 1) } else { (feature / 2, feature / 2 + 1) };
            let (p0, p1) = (corner(i), corner(j));
            let along = (p1 - p0) * (1.0 / (p1 - p0).norm());
            let end = if first { p0 } else { p1 };
            match (feature.is_multiple_of(2) && !first, scene.touch.disk.radius) {
                (true, _) => along.cross(p - p0).abs(),
                (false, Some(_)) => (p - end).norm(),
                // Straight back from the end, or across to the other end.
                (false, None) => {
                    let across = corner(0) - corner(chain.sides());
                    along.dot(p - end).abs().min(across.cross(p - end).abs() / across.norm())
                }
            }
        }
    }
}

/// The start or the end of a track, by its piece.
fn end_of(scene: &Scene, there: &There, track: &Track, feature: usize) -> Vec2 {
    let n = track.stretches.len();
    scene.place(there, if feature == n { track.stretches[0].ends[0] } else { track.stretches[n - 1].ends[1] })
}

/// Rates and accelerations are differences along a motion, on every piece, wherever the disk is.
#[test]
fn jets_are_differences_along_the_motion() {
    every_scene(|scene, there, _| {
        let (m, touch) = (&scene.m, &scene.touch);
        for feature in scene.pieces() {
            // Corners are seen from 0.5 m or more: fifth derivatives of angles are below 1e5 there.
            if near_centre(scene, there, feature) {
                continue;
            }
            let h = 1e-3;
            let read = |t: f64| {
                let there = there.later(t);
                [touch.gap(m, &there.at(m), feature), touch.slide(m, &there.at(m), feature)]
            };
            let values = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|i| read(i * h));
            let moving = there.moving(m);
            let jets: [Jet; 2] = [touch.gap(m, &moving, feature), touch.slide(m, &moving, feature)];
            for (k, jet) in jets.iter().enumerate() {
                let v = values.map(|v| v[k]);
                assert!((jet.d0 - v[2]).abs() < 1e-13, "{}, {feature}", scene.label);
                if k == 1 && (v[4] - v[0]).abs() > 1.0 {
                    continue; // a direction that wraps
                }
                let rate = (8.0 * (v[3] - v[1]) - (v[4] - v[0])) / (12.0 * h);
                let accel = (16.0 * (v[3] + v[1]) - (v[4] + v[0]) - 30.0 * v[2]) / (12.0 * h * h);
                assert!((jet.d1 - rate).abs() < 1e-7, "{}, {feature}, {k}: {} {rate}", scene.label, jet.d1);
                assert!((jet.d2 - accel).abs() < 1e-5, "{}, {feature}, {k}: {} {accel}", scene.label, jet.d2);
            }
        }
    });
}

/// Whether the centre of the disk is near the centre of a round piece, from which directions change fast.
fn near_centre(scene: &Scene, there: &There, feature: usize) -> bool {
    let centre = match &scene.touch.against {
        Profile::Circle { centre, .. } => scene.place(there, *centre),
        Profile::Arc(_) => {
            let (hub, radius, ends) = scene.arc(there).expect("an arc");
            if feature == 0 {
                hub
            } else {
                hub + turned(vec2(radius, 0.0), ends[feature - 1])
            }
        }
        Profile::Track(track) => match track.stretches.get(feature).map(|stretch| stretch.centre) {
            Some(Some(centre)) => scene.place(there, centre),
            Some(None) => return false,
            None => end_of(scene, there, track, feature),
        },
        Profile::Chain(chain) if feature == 2 * chain.sides() => scene.place(there, chain.corners[0]),
        Profile::Chain(chain) if feature % 2 == 1 => {
            scene.place(there, chain.corners[(feature / 2 + 1) % chain.corners.len()])
        }
        _ => return false,
    };
    (scene.place(there, scene.touch.disk.centre) - centre).norm() < 0.5
}

/// Distance of a point from a row of straight sides.
fn distance(p: Vec2, corners: &[Vec2], closed: bool) -> f64 {
    sides(corners, closed)
        .map(|(a, b)| {
            let s = ((p - a).dot(b - a) / (b - a).dot(b - a)).clamp(0.0, 1.0);
            (p - a - (b - a) * s).norm()
        })
        .fold(f64::INFINITY, f64::min)
}

fn sides(corners: &[Vec2], closed: bool) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    let n = corners.len();
    (0..n - usize::from(!closed)).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// Heights over all sides.
fn heights(p: Vec2, corners: &[Vec2], closed: bool) -> Vec<f64> {
    sides(corners, closed).map(|(a, b)| (b - a).cross(p - a) / (b - a).norm()).collect()
}

/// The gap of a disk is the distance of its centre from the polygon less its radius, inside the solid the least depth;
/// that of a point is the largest height over a side.
#[test]
fn gaps_are_distances() {
    every_scene(|scene, there, rng| {
        let Some((corners, closed)) = scene.corners(there) else { return };
        for _ in 0..50 {
            let to = corners[0] + vec2(rng.about(2.5), rng.about(2.5));
            let there = &scene.with_disk_at(there, to);
            let (corners, _) = scene.corners(there).expect("a chain");
            let (p, at) = (scene.place(there, scene.touch.disk.centre), there.at(&scene.m));
            let gap = scene.touch.signed_gap(&scene.m, &at);
            let (far, over) = (distance(p, &corners, closed), heights(p, &corners, closed));
            let highest = over.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
            let (r, reach) = (scene.radius(there), scene.touch.separation_bound(&scene.m, &at));
            assert!(reach < far - r + 1e-14 && (reach <= 0.0 || gap > 0.0 || highest < 0.0), "{}", scene.label);
            let label = match (r > 0.0, scene.word) {
                (_, "bent") => continue,
                (true, _) if highest >= 0.0 => far - r,
                (true, _) if closed => highest - r,
                (false, _) if closed => highest,
                (false, _) => {
                    let [first, last] =
                        [(corners[0], corners[1]), (corners[corners.len() - 2], corners[corners.len() - 1])];
                    let ends = [(first.0 - first.1, first.0), (last.1 - last.0, last.1)];
                    ends.iter().fold(highest, |m, (out, end)| m.max(out.dot(p - *end) / out.norm()))
                }
                _ => continue,
            };
            assert!((gap - label).abs() < 1e-13, "{}: {gap} {label}", scene.label);
        }
    });
}

/// A gap that is a distance changes, while it is open, by no more than its disk is shifted.
#[test]
fn distances_change_no_faster_than_bodies_move() {
    let mut looked = 0;
    every_scene(|scene, there, rng| {
        let (m, touch) = (&scene.m, &scene.touch);
        if !touch.is_a_distance() {
            return;
        }
        for _ in 0..50 {
            let (near, by) = (vec2(rng.about(2.5), rng.about(2.5)), vec2(rng.about(1.0), rng.about(1.0)));
            let from = scene.with_disk_at(there, near);
            let to = scene.with_disk_at(there, near + by);
            let gaps = [from, to].map(|there| touch.signed_gap(m, &there.at(m)));
            if gaps.iter().all(|&gap| gap > 0.0) {
                assert!((gaps[1] - gaps[0]).abs() < by.norm() + 1e-13, "{}: {gaps:?} {by:?}", scene.label);
                looked += 1;
            }
        }
    });
    assert!(looked > 1000, "{looked}");
}

/// A disk that is not behind an arc is as far from it as from the nearest of very many of its points; and round it, on
/// every side, the borders are those of the pieces and the gap does not jump. A point meets the arc where its disk
/// would, and only there.
#[test]
fn an_arc_is_its_points_and_ends_at_its_ends() {
    let mut changes = 0;
    every_scene(|scene, there, rng| {
        let Some((hub, radius, ends)) = scene.arc(there) else { return };
        let (m, touch, label, r) = (&scene.m, &scene.touch, &scene.label, scene.radius(there));
        let hollow = scene.word == "hollow arc";
        let out = if hollow { rng.within(0.3, 0.9) } else { rng.within(1.1, 2.0) };
        let mut last: Option<(usize, f64)> = None;
        for i in 0..6283 {
            let step = 1e-3;
            let angle = ends[0] + f64::from(i) * step;
            let there = &scene.with_disk_at(there, hub + turned(vec2(out * radius, 0.0), angle));
            let (at, (hub, _, ends)) = (there.at(m), scene.arc(there).expect("an arc"));
            let (p, feature, gap) =
                (scene.place(there, touch.disk.centre), touch.feature(m, &at), touch.signed_gap(m, &at));
            let beside = (angle - ends[0]).rem_euclid(std::f64::consts::TAU) > ends[1] - ends[0];
            let rim = |a: f64| hub + turned(vec2(radius, 0.0), a);
            let far = (0..=4000).map(|k| (p - rim(ends[0] + (ends[1] - ends[0]) * f64::from(k) / 4000.0)).norm());
            let far = if i % 200 == 0 { far.fold(f64::INFINITY, f64::min) } else { f64::NAN };
            if r > 0.0 && far.is_finite() {
                assert!((gap - (far - r)).abs() < 3e-5, "{label}: {gap} {}", far - r);
            }
            if r == 0.0 && far.is_finite() {
                assert!(gap > 0.0 && gap < far + 1e-12, "{label}: {gap} {far}");
                assert!(touch.can_close(feature) || beside, "{label}, {feature}");
            }
            let borders = touch.borders(m, &at, feature);
            assert!(borders.iter().all(|b| b.value >= -1e-12), "{label}, {feature}: {borders:?}");
            if let Some((old, before)) = last {
                assert!((gap - before).abs() < 1.0001 * out * radius * step, "{label}: {before} {gap}");
                let crossed = |b: &Border| b.beyond == feature && b.value <= 0.0;
                assert!(old == feature || touch.borders(m, &at, old).iter().any(crossed), "{label}: {old} {feature}");
                changes += usize::from(old != feature);
            }
            last = Some((feature, gap));
        }
    });
    assert!(changes > 200, "{changes}");
}

/// Just before a track, as far as any disk fits there, the gap is the distance from its nearest point, all along it and
/// without a jump from stretch to stretch; past its ends it is that from the end.
#[test]
fn a_track_is_its_points() {
    let mut visits = 0;
    every_scene(|scene, there, rng| {
        let Profile::Track(track) = &scene.touch.against else { return };
        let (m, touch, r) = (&scene.m, &scene.touch, scene.radius(there));
        let way = walked(scene, there, track);
        for _ in 0..200 {
            let i = rng.below(way.len() - 1);
            let along = way[i + 1] - way[i];
            let place = way[i] + along.perp() * (rng.within(0.0, 0.4) / along.norm());
            let there = &scene.with_disk_at(there, place);
            let (at, way) = (there.at(m), walked(scene, there, track));
            let p = scene.place(there, touch.disk.centre);
            let far = way.iter().map(|w| (p - *w).norm()).fold(f64::INFINITY, f64::min);
            let (feature, gap) = (touch.feature(m, &at), touch.signed_gap(m, &at));
            assert!((gap - (far - r)).abs() < 1e-5, "{}: {gap} {}", scene.label, far - r);
            assert!(touch.can_close(feature) || i == 0 || i + 2 == way.len(), "{}", scene.label);
            let borders = touch.borders(m, &at, feature);
            assert!(borders.iter().all(|b| b.value >= -1e-9), "{}, {feature}: {borders:?}", scene.label);
            for border in borders {
                let back = touch.borders(m, &at, border.beyond).into_iter().find(|b| b.beyond == feature);
                assert_eq!(back.map(|b| b.value), Some(-border.value), "{}: one border, two values", scene.label);
            }
            visits += 1;
        }
    });
    assert!(visits > 1000, "{visits}");
}

/// Places all along a track, 1/400 of a stretch apart.
fn walked(scene: &Scene, there: &There, track: &Track) -> Vec<Vec2> {
    let stretch = |stretch: &freebody::mechanism::Stretch| {
        let [from, to] = stretch.ends.map(|site| scene.place(there, site));
        let centre = stretch.centre.map(|site| scene.place(there, site));
        let part = move |k: i32| {
            let x = f64::from(k) / 400.0;
            match centre {
                Some(centre) => {
                    let (a, b) = (from - centre, to - centre);
                    centre + turned(a, a.cross(b).atan2(a.dot(b)) * x)
                }
                None => from + (to - from) * x,
            }
        };
        (0..=400).map(part).collect::<Vec<_>>()
    };
    let mut way: Vec<Vec2> = track.stretches.iter().flat_map(stretch).collect();
    way.dedup_by(|a, b| (*a - *b).norm() < 1e-9);
    way
}

/// Within its piece all borders are positive; where the piece changes, the border with the new one is crossed, and the
/// gap does not jump.
#[test]
fn pieces_end_at_their_borders() {
    let mut changes = 0;
    every_scene(|scene, there, rng| {
        let (m, touch, label) = (&scene.m, &scene.touch, &scene.label);
        let Some((corners, closed)) = scene.corners(there) else { return };
        let mid = corners.iter().fold(vec2(0.0, 0.0), |sum, c| sum + *c) * (1.0 / corners.len() as f64);
        // Round the chain, at a distance at which it is seen from outside; an open one only where it can be met.
        let size = corners.iter().map(|c| (*c - mid).norm()).fold(0.0, f64::max) * rng.within(1.0, 2.0);
        let mut last: Option<(usize, f64)> = None;
        let step = 1e-3;
        for i in 0..6283 {
            let p = mid + turned(vec2(size, 0.0), f64::from(i) * step);
            let there = &scene.with_disk_at(there, p);
            let (at, (corners, _)) = (there.at(m), scene.corners(there).expect("a chain"));
            let seen = scene.place(there, touch.disk.centre);
            let (feature, gap) = (touch.feature(m, &at), touch.signed_gap(m, &at));
            let behind = heights(seen, &corners, false).iter().all(|h| *h < 0.0);
            if !closed && if scene.radius(there) > 0.0 { behind } else { gap < 0.0 } {
                last = None;
                continue;
            }
            let borders = touch.borders(m, &at, feature);
            assert!(borders.iter().all(|b| b.value >= -1e-13), "{label}, {feature}: {borders:?}");
            if let Some((old, before)) = last {
                assert!((gap - before).abs() < 1.0001 * size * step, "{label}: {before} {gap}");
                let crossed = |b: &Border| b.beyond == feature && b.value <= 0.0;
                assert!(old == feature || touch.borders(m, &at, old).iter().any(crossed), "{label}: {old} {feature}");
                changes += usize::from(old != feature);
            }
            last = Some((feature, gap));
        }
    });
    assert!(changes > 500, "{changes}");
}

/// A point touches a chain all along its sides, and nowhere in front of them.
#[test]
fn points_touch_chains_along_their_sides() {
    every_scene(|scene, there, rng| {
        let Some((corners, closed)) = scene.corners(there).filter(|_| scene.radius(there) == 0.0) else { return };
        for (a, b) in sides(&corners, closed) {
            let (foot, free) = (a + (b - a) * rng.within(0.1, 0.9), (b - a).perp() * (1.0 / (b - a).norm()));
            let gap = |height: f64| {
                let there = scene.with_disk_at(there, foot + free * height);
                scene.touch.signed_gap(&scene.m, &there.at(&scene.m))
            };
            assert!(gap(0.0).abs() < 1e-13 && (gap(1e-3) - 1e-3).abs() < 1e-13 && gap(-1e-3) < 0.0, "{}", scene.label);
        }
    });
}
