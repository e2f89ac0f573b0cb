//! Contacts as the model gives them: which touches they become, outlines of random shape, and what is refused.

use crate::model::*;
use crate::rng::Rng;
use freebody::compile::Compiled;
use freebody::dynamics::Workspace;
use freebody::mechanism::{ContactPair, Friction, Gap, Mechanism};
use freebody::mode::{ContactMode, Mode};
use freebody::plane::{vec2, Vec2};
use freebody::spec::{Contact, Number, Stop, Surface};
use std::f64::consts::{PI, TAU};

fn contact(name: &str, of: [Surface; 2]) -> Contact {
    let nought = literal(0.0);
    let (friction, restitution) = (nought.clone(), nought);
    Contact {
        name: name.into(),
        of,
        friction,
        static_friction: None,
        rough: false,
        restitution,
        stiffness: None,
        damping: None,
        engaged: true,
    }
}

fn stop(name: &str, gap: &str) -> Stop {
    Stop {
        name: name.into(),
        gap: gap.into(),
        restitution: literal(0.5),
        stiffness: None,
        damping: None,
        engaged: false,
    }
}

fn point(name: &str) -> Surface {
    Surface::Point(name.into())
}

fn round(centre: &str, radius: f64, hollow: bool) -> Surface {
    Surface::Circle { centre: centre.into(), radius: literal(radius), hollow, ends: None }
}

fn names(words: &str) -> Vec<String> {
    words.split_whitespace().map(str::to_string).collect()
}

fn polygon(words: &str) -> Surface {
    Surface::Polygon(names(words))
}

fn polyline(words: &str) -> Surface {
    Surface::Polyline(names(words))
}

/// A box and a wheel that can go anywhere over ground, with corners on each.
fn stage() -> Model {
    let free = |model: Model, body: &str| {
        let coordinates = ["x", "y", "f"].map(|c| format!("{c}_{body}"));
        let coordinates: Vec<&str> = coordinates.iter().map(String::as_str).collect();
        model.joint(
            &format!("{body}_free"),
            "free",
            &[("of", points(&["ground.O", &format!("{body}.G")]))],
            &coordinates,
        )
    };
    let mut model = Model::new().body("box", 1.0, 1.0, [0.5, 0.5]).body("wheel", 1.0, 1.0, [0.0; 2]);
    for (name, at) in [("A", [0.0, 0.0]), ("B", [1.0, 0.0]), ("C", [1.0, 1.0]), ("D", [0.0, 1.0]), ("E", [0.5, 0.2])] {
        model = model.point(&format!("box.{name}"), at);
    }
    // A step down between two floors, a wall, and a top.
    for (i, at) in [[0.0, 0.0], [2.0, 0.0], [2.0, -1.0], [4.0, -1.0], [4.0, 1.0], [5.0, 1.0]].into_iter().enumerate() {
        model = model.point(&format!("ground.P{i}"), at);
    }
    free(free(model.point("ground.middle", [1.0, 0.0]), "box"), "wheel")
}

const FLOOR: &str = "ground.P0 ground.P1 ground.P2 ground.P3 ground.P4 ground.P5";
const BOX: &str = "box.A box.B box.C box.D";

fn compiled(change: impl FnOnce(&mut Model)) -> Result<Compiled, String> {
    let mut model = stage();
    change(&mut model);
    Compiled::new(&model.0).map_err(|e| e.to_string())
}

#[test]
fn every_pair_becomes_its_touches_in_either_order() {
    let line = || Surface::Line(place("ground.O", 0.0));
    let wheel = || round("wheel.G", 0.3, false);
    let cases = [
        (point("box.A"), line(), 1),
        (wheel(), line(), 1),
        (point("box.A"), wheel(), 1),
        (wheel(), round("ground.O", 1.0, false), 1),
        (wheel(), round("ground.O", 1.0, true), 1),
        (point("box.A"), round("ground.O", 1.0, true), 1),
        (polygon(BOX), line(), 4),
        (polygon(BOX), wheel(), 1),
        (polygon(BOX), round("ground.O", 9.0, true), 4),
        (polygon(BOX), polygon("ground.P0 ground.P1 ground.P2"), 7),
        (wheel(), polygon("ground.P0 ground.middle ground.P1 ground.P2"), 1),
        // P0 P1 P2 and P2 P3 and P3 is concave, P2 too; P1, P4 and the ends are convex.
        (wheel(), polyline(FLOOR), 3),
        (point("box.A"), polyline(FLOOR), 3),
        (polygon(BOX), polyline(FLOOR), 4 * 3 + 4),
    ];
    for (a, b, count) in cases {
        for of in [[a.clone(), b.clone()], [b.clone(), a.clone()]] {
            let label = format!("{of:?}");
            let compiled = compiled(|m| m.0.contacts.push(contact("c", of))).unwrap_or_else(|e| panic!("{label}: {e}"));
            let m = &compiled.mechanism;
            assert_eq!((m.unilateral.len(), m.groups[0].constraints.clone()), (count, 0..count), "{label}");
            let ends = m.groups[0].ends;
            for limit in &m.unilateral {
                let Gap::ContactPair(touch) = &limit.gap else { panic!("{label}: a gauge") };
                let bodies = touch.bodies(m);
                assert!(bodies == ends || bodies == [ends[1], ends[0]], "{label}");
                let moving: Vec<usize> = bodies.into_iter().filter(|b| *b > 0).collect();
                assert!(limit.bodies == moving && limit.friction.is_none() && limit.group == 0, "{label}");
            }
        }
    }
}

#[test]
fn what_cannot_be_a_contact_is_refused_with_a_reason() {
    let on = |a: Surface, b: Surface| move |m: &mut Model| m.0.contacts.push(contact("c", [a, b]));
    let with = |change: fn(&mut Contact)| {
        move |m: &mut Model| {
            let mut c = contact("c", [point("box.A"), round("ground.O", 1.0, false)]);
            change(&mut c);
            m.0.contacts.push(c);
        }
    };
    let line = || Surface::Line(place("ground.O", 0.0));
    let twice = |m: &mut Model| m.0.stops.extend([stop("s", "x_box"), stop("s", "y_box")]);
    type Change = Box<dyn FnOnce(&mut Model)>;
    let cases: Vec<(Change, &str, &str)> = vec![
        (Box::new(on(point("box.A"), point("ground.O"))), "c.of:", "two points"),
        (Box::new(on(Surface::Line(place("box.A", 0.0)), line())), "c.of:", "two lines"),
        (Box::new(on(polyline("box.A box.B"), polyline(FLOOR))), "c.of:", "polyline meets"),
        (Box::new(on(polyline("box.A box.B"), line())), "c.of:", "polyline meets"),
        (Box::new(on(round("box.A", 1.0, true), line())), "c.of:", "hollow"),
        (Box::new(on(point("box.A"), round("box.B", 0.1, false))), "c.of:", "both surfaces are on `box`"),
        (Box::new(on(point("box.Z"), line())), "c.of[0]:", "no point is called `box.Z`"),
        (Box::new(on(line(), polygon("box.A box.B ground.O"))), "c.of[1]:", "`box.A` is on `box` and `ground.O`"),
        (Box::new(on(polygon("box.A box.B box.C box.E"), line())), "c.of[0]:", "not convex at `box.E`"),
        (Box::new(on(polygon("box.A box.E box.C box.B"), line())), "c.of[0]:", "not convex at `box.E`"),
        (Box::new(on(polygon("box.A box.B box.A"), line())), "c.of[0]:", "at one place"),
        (Box::new(on(polygon("box.A box.B"), line())), "c.of[0]:", "no area"),
        (Box::new(on(polygon("box.A box.C box.B box.D"), line())), "c.of[0]:", "convex"),
        (Box::new(on(point("box.A"), polyline("ground.P0 ground.P1 ground.middle"))), "c.of[1]:", "straight back"),
        (Box::new(on(point("box.A"), polyline("ground.P0"))), "c.of[1]:", "two points at least"),
        (Box::new(on(point("wheel.G"), polyline("box.A box.D box.C box.B box.E"))), "c.of[1]:", "in front of it"),
        (Box::new(on(round("box.A", 0.0, false), line())), "c.of[0].radius:", "no size"),
        (Box::new(with(|c| c.restitution = literal(1.2))), "c.restitution:", "1.2"),
        (Box::new(with(|c| c.friction = literal(-0.1))), "c.friction:", "not negative"),
        (Box::new(with(|c| (c.friction, c.static_friction) = (literal(0.3), Some(literal(0.2))))), "c.static", "below"),
        (Box::new(with(|c| (c.friction, c.rough) = (literal(0.3), true))), "c.friction:", "never slides"),
        (Box::new(with(|c| c.name = "box_free".into())), "box_free:", "given twice"),
        (Box::new(twice), "stops.s:", "given twice"),
        (Box::new(|m: &mut Model| m.0.stops.push(stop("s", "1.0"))), "stops.s.gap:", "no body"),
        (Box::new(|m: &mut Model| m.0.stops.push(stop("s", "rate(x_box)"))), "stops.s.gap:", "only the configuration"),
    ];
    for (change, path, what) in cases {
        let error = compiled(change).err().unwrap_or_else(|| panic!("{path} {what}: compiled"));
        assert!(error.contains(path) && error.contains(what), "{path} {what}: {error}");
    }
}

#[test]
fn friction_and_stops_are_read_as_given() {
    let friction = |friction: Number, fixed: Option<Number>, rough: bool| {
        let mut c = contact("c", [point("box.A"), round("ground.O", 1.0, false)]);
        (c.friction, c.static_friction, c.rough) = (friction, fixed, rough);
        let m = compiled(|m| m.0.contacts.push(c)).expect("compiles").mechanism;
        let slots = m.bind::<f64>(&[]).values;
        m.unilateral[0].friction.map(|f| match f {
            Friction::Rough => [f64::INFINITY; 2],
            Friction::Coulomb { fixed, kinetic } => [slots[fixed], slots[kinetic]],
        })
    };
    assert_eq!(friction(literal(0.0), Some(literal(0.0)), false), None);
    assert_eq!(friction(literal(0.2), None, false), Some([0.2, 0.2]));
    assert_eq!(friction(literal(0.0), Some(literal(0.2)), false), Some([0.2, 0.0]));
    assert_eq!(friction(written("0.1 + 0.1"), Some(literal(0.3)), false), Some([0.3, 0.2]));
    assert_eq!(friction(literal(0.0), None, true), Some([f64::INFINITY; 2]));

    let m = compiled(|m| m.0.stops.push(stop("s", "abs(x_box) - y_wheel"))).expect("compiles").mechanism;
    let group = &m.groups[0];
    assert!(
        (group.word, group.engaged, m.unilateral[0].bodies.len(), m.discontinuities.len()) == ("stop", false, 2, 1)
    );
}

/// The touches of a point that moves over ground, with what they tell of it at a place.
struct Probe {
    m: Mechanism,
}

impl Probe {
    fn over(outline: &[Vec2], surface: fn(&str) -> Surface) -> Self {
        let mut model = Model::new().particle("bead", 1.0);
        let mut words = String::new();
        for (i, p) in outline.iter().enumerate() {
            model = model.point(&format!("ground.P{i}"), [p.x, p.y]);
            words += &format!(" ground.P{i}");
        }
        let ends = points(&["ground.O", "bead.origin"]);
        let mut model = model.joint("free", "free", &[("of", ends)], &["x", "y"]);
        model.0.contacts.push(contact("c", [point("bead.origin"), surface(&words)]));
        Probe { m: model.compile().mechanism }
    }

    /// All gaps, each with its normal and the distance to its nearest border.
    fn all(&self, p: Vec2) -> Vec<(f64, Vec2, f64)> {
        let mut workspace = Workspace::new(&self.m, &[]);
        workspace.move_to(0.0, &[p.x, p.y], &[0.0; 2]);
        let at = workspace.at();
        let touches = self.m.unilateral.iter().filter_map(|limit| match &limit.gap {
            Gap::ContactPair(touch) => Some(touch),
            _ => None,
        });
        let label = |touch: &ContactPair| {
            let feature = touch.feature(&self.m, &at);
            let border = touch.borders(&self.m, &at, feature).iter().fold(f64::INFINITY, |least, b| least.min(b.value));
            (touch.signed_gap(&self.m, &at), touch.contact(&self.m, &at, feature).normal, border)
        };
        touches.map(label).collect()
    }

    /// The least gap, and its normal.
    fn at(&self, p: Vec2) -> (f64, Vec2, f64) {
        self.all(p).into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("a touch")
    }
}

/// Over a landscape of hills and valleys, a point touches it just where it is: each side with its own normal up to its
/// very ends, and nothing in front of it. A point that slides down to a concave corner meets the side beyond with its
/// normal, too.
#[test]
fn a_point_touches_a_polyline_just_where_it_is() {
    for seed in 0..300 {
        let mut rng = Rng::new(seed);
        let mut corner = vec2(0.0, 0.0);
        let mut landscape = vec![corner];
        for _ in 0..2 + rng.below(5) {
            corner += vec2(rng.within(0.3, 1.0), rng.about(1.5));
            landscape.push(corner);
        }
        let probe = Probe::over(&landscape, polyline);
        let normal = |(a, b): (&Vec2, &Vec2)| (*b - *a).perp() * (1.0 / (*b - *a).norm());
        let normals: Vec<Vec2> = landscape.iter().zip(&landscape[1..]).map(normal).collect();
        for ((a, b), &normal) in landscape.iter().zip(&landscape[1..]).zip(&normals) {
            for s in [1e-6, rng.within(0.0, 1.0), 1.0 - 1e-6] {
                let foot = *a + (*b - *a) * s;
                let (gap, label, _) = probe.at(foot);
                assert!(
                    gap.abs() < 1e-14 && (label - normal).norm() < 1e-12,
                    "seed {seed}: {gap} {label:?} {normal:?}"
                );
                for (_, label, _) in probe.all(foot).iter().filter(|(gap, ..)| *gap < 1e-5) {
                    assert!(normals.iter().any(|n| (*n - *label).norm() < 1e-12), "seed {seed}: {label:?}");
                }
                let above = probe.at(foot + vec2(0.0, rng.within(1e-9, 2.0))).0;
                assert!(above > 0.0, "seed {seed}: {above}");
                assert!(probe.at(foot - vec2(0.0, 1e-9)).0 < 0.0, "seed {seed}");
            }
        }
    }
}

/// A point that rests in a concave corner is held by both sides, and no noise takes it off their pieces.
#[test]
fn a_point_rests_in_a_valley() {
    for seed in 0..100 {
        let mut rng = Rng::new(seed);
        let slopes = [-rng.within(0.1, 3.0), rng.within(0.1, 3.0)];
        let valley = vec2(rng.about(1.0), rng.about(1.0));
        let outline = [valley + vec2(-1.0, -slopes[0]), valley, valley + vec2(1.0, slopes[1])];
        let probe = Probe::over(&outline, polyline);
        for (label, slope) in probe.all(valley).iter().zip(slopes) {
            let normal = vec2(-slope, 1.0) * (1.0 / slope.hypot(1.0));
            let right = label.0.abs() < 1e-15 && (label.1 - normal).norm() < 1e-12 && label.2 > 1e-3;
            assert!(right, "seed {seed}: {label:?} {normal:?}");
        }
    }
}

/// A polyline that goes round is a room or a block, by the way it is walked; a polygon is a block either way.
#[test]
fn a_polyline_that_goes_round_has_an_inside() {
    let square = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 1.0), vec2(0.0, 1.0), vec2(0.0, 0.0)];
    let back: Vec<Vec2> = square.iter().rev().copied().collect();
    let bent = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 1.0), vec2(1.0, 0.5), vec2(0.0, 1.0), vec2(0.0, 0.0)];
    let (inside, near, outside) = (vec2(0.3, 0.4), vec2(0.01, 0.02), vec2(3.0, 0.4));
    let room = Probe::over(&square, polyline);
    assert!((room.at(inside).0 - 0.3).abs() < 1e-15 && (room.at(near).0 - 0.01).abs() < 1e-15);
    assert!(room.at(outside).0 < 0.0);
    for block in [Probe::over(&back, polyline), Probe::over(&back, polygon), Probe::over(&square[..4], polygon)] {
        assert!((block.at(outside).0 - 1.0).abs() < 1e-15 && (block.at(inside).0 + 0.3).abs() < 1e-15);
    }
    // Convex where the roof hangs in.
    let tent = Probe::over(&bent, polyline);
    assert!(tent.at(vec2(1.0, 0.499)).0 > 0.0 && tent.at(vec2(1.0, 0.501)).0 < 0.0 && tent.at(vec2(1.9, 0.9)).0 > 0.0);
}

/// Over the sides of both, the largest height of the other polygon over one, below 0 where they overlap; and the
/// normal, towards the first.
fn parted(a: &[Vec2], b: &[Vec2]) -> (f64, Vec2) {
    let over = |of: &[Vec2], other: &[Vec2], sense: f64| -> Vec<(f64, Vec2)> {
        let ends = of.iter().zip(of.iter().cycle().skip(1));
        let side = ends.map(|(p, q)| (*p, -(*q - *p).perp() * (1.0 / (*q - *p).norm())));
        side.map(|(p, n)| (other.iter().map(|c| n.dot(*c - p)).fold(f64::INFINITY, f64::min), n * sense)).collect()
    };
    let all = over(b, a, 1.0).into_iter().chain(over(a, b, -1.0));
    all.max_by(|x, y| x.0.total_cmp(&y.0)).expect("a side")
}

/// However near to corners two polygons meet, none of their corners is in the way where a side keeps them apart, and
/// where they touch one of the gaps that can close is closed.
#[test]
fn polygons_that_meet_with_corners_touch_just_where_they_are() {
    let mut met = 0;
    for seed in 0..3000 {
        let rng = &mut Rng::new(seed);
        let [moving, fixed] = [0, 1].map(|_| {
            let n = 3 + rng.below(4);
            let corner =
                |i: usize| turned(vec2(rng.within(0.9, 1.0), 0.0), TAU * (i as f64 + rng.about(0.2)) / n as f64);
            (0..n).map(corner).collect::<Vec<Vec2>>()
        });
        let mut model = Model::new().body("a", 1.0, 1.0, [0.0, 0.0]);
        let mut words = [String::new(), String::new()];
        for ((body, outline), words) in [("a", &moving), ("ground", &fixed)].into_iter().zip(&mut words) {
            for (i, p) in outline.iter().enumerate() {
                model = model.point(&format!("{body}.P{i}"), [p.x, p.y]);
                *words += &format!(" {body}.P{i}");
            }
        }
        let ends = points(&["ground.O", "a.origin"]);
        let mut model = model.joint("free", "free", &[("of", ends)], &["x", "y", "angle"]);
        model.0.contacts.push(contact("c", words.each_ref().map(|words| polygon(words))));
        let m = model.compile().mechanism;

        let (angle, apart) = (rng.about(3.0), 10.0_f64.powf(rng.within(-12.0, -1.0)));
        let turned_in: Vec<Vec2> = moving.iter().map(|&p| turned(p, angle)).collect();
        let from = turned(vec2(apart, 0.0), rng.about(3.2));
        let mut at = fixed[rng.below(fixed.len())] + from - turned_in[rng.below(moving.len())];
        let placed = |at: Vec2| turned_in.iter().map(|&p| p + at).collect::<Vec<Vec2>>();
        if parted(&placed(at), &fixed).0.abs() > apart {
            continue;
        }
        met += 1;
        // Pushed off one side, it may be too far from another.
        for _ in 0..1000 {
            let (height, normal) = parted(&placed(at), &fixed);
            at -= normal * height;
        }
        let mut workspace = Workspace::new(&m, &[]);
        workspace.move_to(0.0, &[at.x, at.y, angle], &[0.0; 3]);
        let closing = (0..m.unilateral.len()).filter_map(|l| workspace.closing_gap(l));
        let least = closing.fold(f64::INFINITY, f64::min);
        assert!(least.abs() < 1e-14, "seed {seed}, {apart:e} from corner to corner: {least:e}");
    }
    assert!(met > 500, "{met}");
}

/// A block that slides between two walls may be pinched by any amount, and the pinch brakes it: that is reported, of these
/// walls and not of the floor on which another slides.
#[test]
fn how_hard_walls_pinch_what_slides_is_not_decided() {
    let mut model = Model::new().body("block", 1.0, 1.0, [0.0; 2]).body("other", 1.0, 1.0, [0.0; 2]);
    for body in ["block", "other"] {
        let coordinates = ["x", "y", "f"].map(|c| format!("{c}_{body}"));
        let ends = points(&["ground.O", &format!("{body}.origin")]);
        model =
            model.joint(&format!("{body}_free"), "free", &[("of", ends)], &coordinates.each_ref().map(String::as_str));
    }
    for (name, body, angle) in [("low", "block", 0.0), ("high", "block", PI), ("floor", "other", 0.0)] {
        let wall = Surface::Line(place("ground.O", angle));
        let touch = contact(name, [point(&format!("{body}.origin")), wall]);
        model.0.contacts.push(Contact { friction: literal(0.3), ..touch });
    }
    let m = model.compile().mechanism;
    let mut workspace = Workspace::new(&m, &[]);
    workspace.move_to(0.0, &[0.0; 6], &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    // The normal of the upper wall is turned round, and so is its tangent.
    let mut mode = Mode::free(&m);
    for (l, sense) in [1.0, -1.0, 1.0].into_iter().enumerate() {
        mode.contacts_mut()[l].mode = ContactMode::Slip(sense);
    }
    workspace.enter(&mode);
    let trouble = workspace.solve().expect_err("any pinch");
    assert_eq!(trouble.name(), "painleve_indeterminate");
    assert!(trouble.sentence().starts_with("`low` and `high` slide"), "{trouble}");
    workspace.enter(&mode.with_contacts(&[1], ContactMode::ClosedUnloaded));
    workspace.solve().expect("one wall less");
}
