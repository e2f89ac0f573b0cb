//! Piles drawn at random: convex polygons and disks over a floor between two walls.

use crate::model::*;
use crate::rng::Rng;
use freebody::compile::Compiled;
use freebody::mechanism::Mechanism;
use freebody::plane::{vec2, Vec2};
use freebody::spec::{Contact, MassElement, Number, Surface};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Half the width of the box, and the spacing of the bodies at the start, m.
const HALF: f64 = 0.5;
const CELL: f64 = 0.32;
/// Mass for an area, kg/m².
const DENSITY: f64 = 20.0;

/// The outline of a body, in its own axes.
pub enum Outline {
    Disk(f64),
    /// Corners counter-clockwise.
    Polygon(Vec<Vec2>),
}

/// A body: what it is and how it starts, [x, y, angle] and the rates.
pub struct Block {
    pub outline: Outline,
    pub at: [f64; 3],
    pub rates: [f64; 3],
}

/// A pile: its bodies, with a model of them.
pub struct Pile {
    pub blocks: Vec<Block>,
    pub compiled: Compiled,
}

/// Coefficients of friction and restitution.
type Surfaces = [f64; 2];

impl Pile {
    /// Corners of a box, 20 by 12 cm.
    pub const BOX: [[f64; 2]; 4] = [[-0.1, -0.06], [0.1, -0.06], [0.1, 0.06], [-0.1, 0.06]];

    /// A pile of 3 to 12 bodies of 0.1 to 0.3 m, thrown down in columns of three; every third seed is all plastic.
    pub fn drawn(seed: u64) -> Pile {
        let mut rng = Rng::new(seed);
        let count = 3 + rng.below(10);
        let plastic = seed.is_multiple_of(3);
        let blocks: Vec<Block> = (0..count).map(|i| block(i, &mut rng)).collect();
        let mut pair = |_: &str| [rng.within(0.2, 0.8), if plastic { 0.0 } else { rng.within(0.0, 0.3) }];
        let compiled = model(&blocks, &mut pair).compile();
        Pile { blocks, compiled }
    }

    /// Boxes of one size on one another over the floor, each turned and shifted by a little, that are let go some height, m, apart.
    pub fn stack(count: usize, apart: f64) -> Pile {
        let block = |i: usize| {
            let outline = Outline::Polygon(Pile::BOX.map(|[x, y]| vec2(x, y)).into());
            let off = if i.is_multiple_of(2) { 0.01 } else { -0.01 };
            Block { outline, at: [off, (2 * i + 1) as f64 * 0.06 + (i + 1) as f64 * apart, off], rates: [0.0; 3] }
        };
        Pile::of((0..count).map(block).collect(), [0.5, 0.3])
    }

    /// Some bodies of one surface.
    pub fn of(blocks: Vec<Block>, surfaces: Surfaces) -> Pile {
        let compiled = model(&blocks, &mut |_| surfaces).compile();
        Pile { blocks, compiled }
    }

    /// Mass and inertia of each body about its mass centre, of its outline alone.
    pub fn inertias(&self) -> Vec<[f64; 2]> {
        let of = |block: &Block| match &block.outline {
            Outline::Disk(r) => [0.5 * TAU * r * r * DENSITY, 0.25 * TAU * r.powi(4) * DENSITY],
            Outline::Polygon(corners) => {
                let sides = || corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| (a.cross(*b), a, b));
                let second = |(cross, a, b): (f64, &Vec2, &Vec2)| cross * (a.dot(*a) + a.dot(*b) + b.dot(*b)) / 12.0;
                [sides().map(|(cross, ..)| 0.5 * cross).sum::<f64>(), sides().map(second).sum()].map(|x| DENSITY * x)
            }
        };
        self.blocks.iter().map(of).collect()
    }

    /// How far each body is from all others and from the box, m, at least.
    pub fn distances(&self, poses: &[[f64; 3]]) -> Vec<f64> {
        let shapes: Vec<StateView> =
            self.blocks.iter().zip(poses).map(|(b, at)| StateView::of(&b.outline, *at)).collect();
        let others = |i: usize| (0..shapes.len()).filter(move |&j| j != i);
        let of = |i: usize| others(i).map(|j| shapes[i].apart(&shapes[j])).fold(shapes[i].in_box(), f64::min);
        (0..shapes.len()).map(of).collect()
    }

    pub fn mechanism(&self) -> &Mechanism {
        &self.compiled.mechanism
    }

    /// Coordinates and rates at the start.
    pub fn start(&self) -> [Vec<f64>; 2] {
        let m = self.mechanism();
        let mut start = [vec![0.0; m.freedom()], vec![0.0; m.freedom()]];
        for (i, block) in self.blocks.iter().enumerate() {
            for (k, word) in ["x", "y", "a"].iter().enumerate() {
                let at = index_of(m, &format!("{word}{i}"));
                (start[0][at], start[1][at]) = (block.at[k], block.rates[k]);
            }
        }
        start
    }

    /// The least distance of any two bodies, or of a body and the box, below 0 where they overlap, by separating axes;
    /// with which they are. Independent of what the contacts of the model measure.
    pub fn clearance(&self, poses: &[[f64; 3]]) -> (f64, String) {
        let n = self.blocks.len();
        let shape = |i: usize| StateView::of(&self.blocks[i].outline, poses[i]);
        let shapes: Vec<StateView> = (0..n).map(shape).collect();
        let boxed = |i: usize| (shapes[i].in_box(), format!("b{i} box"));
        let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
        let apart = pairs.map(|(i, j)| (shapes[i].apart(&shapes[j]), format!("b{i} b{j}")));
        (0..n).map(boxed).chain(apart).reduce(|a, b| if b.0 < a.0 { b } else { a }).expect("a body")
    }
}

fn block(i: usize, rng: &mut Rng) -> Block {
    let size = rng.within(0.06, 0.13);
    let outline = match rng.chance(0.3) {
        true => Outline::Disk(size),
        false => Outline::Polygon(polygon(size, rng)),
    };
    let reach = match &outline {
        Outline::Disk(radius) => *radius,
        Outline::Polygon(corners) => corners.iter().map(|c| c.norm()).fold(0.0, f64::max),
    };
    let shift = 0.5 * CELL - reach;
    let x = (i % 3) as f64 * CELL - CELL + rng.about(shift);
    let y = (i / 3) as f64 * CELL + 0.5 * CELL + rng.about(shift);
    Block { outline, at: [x, y, rng.about(3.0)], rates: [rng.about(1.0), rng.about(1.0), rng.about(5.0)] }
}

/// A triangle to hexagon inscribed in a circle, about its mass centre, of which no two corners are close.
fn polygon(size: f64, rng: &mut Rng) -> Vec<Vec2> {
    let n = 3 + rng.below(4);
    let corner = |i: usize, shift: f64| {
        let angle = TAU * (i as f64 + shift) / n as f64;
        vec2(size * angle.cos(), size * angle.sin())
    };
    let corners: Vec<Vec2> = (0..n).map(|i| corner(i, rng.about(0.25))).collect();
    let (mut area, mut first) = (0.0, Vec2::zero());
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        area += 0.5 * a.cross(*b);
        first += (*a + *b) * (a.cross(*b) / 6.0);
    }
    corners.iter().map(|c| *c - first * (1.0 / area)).collect()
}

fn model(blocks: &[Block], surfaces: &mut dyn FnMut(&str) -> Surfaces) -> Model {
    let mut model = Model::new().gravity(0.0, -9.81).point("ground.L", [-HALF, 0.0]).point("ground.R", [HALF, 0.0]);
    for (i, block) in blocks.iter().enumerate() {
        let name = format!("b{i}");
        model = solid(model, &name, &block.outline);
        let coordinates = ["x", "y", "a"].map(|c| format!("{c}{i}"));
        let coordinates: Vec<&str> = coordinates.iter().map(String::as_str).collect();
        let ends = points(&["ground.O", &format!("{name}.origin")]);
        model = model.joint(&format!("free{i}"), "free", &[("of", ends)], &coordinates);
    }
    let walls = [("floor", "ground.O", 0.0), ("left", "ground.L", -FRAC_PI_2), ("right", "ground.R", FRAC_PI_2)];
    for (i, block) in blocks.iter().enumerate() {
        for (wall, through, angle) in walls {
            let of = [surface(i, &block.outline), Surface::Line(place(through, angle))];
            contact(&mut model, format!("b{i} {wall}"), of, surfaces);
        }
        for (j, other) in blocks[..i].iter().enumerate() {
            let of = [surface(i, &block.outline), surface(j, &other.outline)];
            contact(&mut model, format!("b{i} b{j}"), of, surfaces);
        }
    }
    model
}

fn solid(mut model: Model, name: &str, outline: &Outline) -> Model {
    let (shape, area, sizes, corners) = match outline {
        Outline::Disk(r) => ("disk", 0.5 * TAU * r * r, [("radius".to_string(), literal(*r))].into(), vec![]),
        Outline::Polygon(corners) => {
            let twice: f64 = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum();
            ("polygon", 0.5 * twice, Default::default(), corners.iter().map(|c| at([c.x, c.y])).collect())
        }
    };
    if let Outline::Polygon(corners) = outline {
        for (k, corner) in corners.iter().enumerate() {
            model = model.point(&format!("{name}.P{k}"), [corner.x, corner.y]);
        }
    }
    let piece = MassElement {
        shape: shape.into(),
        mass: literal(DENSITY * area),
        at: at([0.0; 2]),
        angle: literal(0.0),
        inertia: None,
        sizes,
        corners,
    };
    model.0.bodies.push(freebody::spec::Body { name: name.into(), particle: false, pieces: vec![piece] });
    model
}

fn surface(i: usize, outline: &Outline) -> Surface {
    match outline {
        Outline::Disk(r) => {
            Surface::Circle { centre: format!("b{i}.origin"), radius: Number::Literal(*r), hollow: false, ends: None }
        }
        Outline::Polygon(corners) => Surface::Polygon((0..corners.len()).map(|k| format!("b{i}.P{k}")).collect()),
    }
}

fn contact(model: &mut Model, name: String, of: [Surface; 2], surfaces: &mut dyn FnMut(&str) -> Surfaces) {
    let [friction, restitution] = surfaces(&name).map(literal);
    model.0.contacts.push(Contact {
        name,
        of,
        friction,
        static_friction: None,
        rough: false,
        restitution,
        stiffness: None,
        damping: None,
        engaged: true,
    });
}

/// An outline in its place: corners round which a disk of a radius goes.
struct StateView {
    corners: Vec<Vec2>,
    radius: f64,
}

impl StateView {
    fn of(outline: &Outline, at: [f64; 3]) -> StateView {
        let pose = pose(at);
        match outline {
            Outline::Disk(radius) => StateView { corners: vec![pose.at], radius: *radius },
            Outline::Polygon(corners) => {
                StateView { corners: corners.iter().map(|c| pose.place(*c)).collect(), radius: 0.0 }
            }
        }
    }

    fn in_box(&self) -> f64 {
        let least = |c: &Vec2| c.y.min(c.x + HALF).min(HALF - c.x) - self.radius;
        self.corners.iter().map(least).fold(f64::INFINITY, f64::min)
    }

    fn middle(&self) -> Vec2 {
        self.corners.iter().fold(Vec2::zero(), |sum, c| sum + *c) * (1.0 / self.corners.len() as f64)
    }

    /// Along every normal of a side, and from every corner to every one of a disk, how far the other lies beyond: the
    /// largest is a distance that both keep at least, and where they overlap the depth, negative.
    fn apart(&self, other: &StateView) -> f64 {
        let beyond = |a: &StateView, b: &StateView, normal: Vec2| {
            let far = a.corners.iter().map(|c| normal.dot(*c)).fold(f64::NEG_INFINITY, f64::max);
            let near = b.corners.iter().map(|c| normal.dot(*c)).fold(f64::INFINITY, f64::min);
            near - far
        };
        let sides = |a: &StateView, b: &StateView| {
            let next = a.corners.iter().cycle().skip(1);
            let normals = a.corners.iter().zip(next).filter(|_| a.corners.len() > 1).map(|(p, q)| {
                let along = *q - *p;
                -along.perp() * (1.0 / along.norm())
            });
            normals.map(|n| beyond(a, b, n)).fold(f64::NEG_INFINITY, f64::max)
        };
        let ends = self.corners.iter().flat_map(|a| other.corners.iter().map(|b| *b - *a));
        let outward = ends.filter(|d| self.radius + other.radius > 0.0 && d.dot(other.middle() - self.middle()) > 0.0);
        let round = outward.map(|d| beyond(self, other, d * (1.0 / d.norm()))).fold(f64::NEG_INFINITY, f64::max);
        sides(self, other).max(sides(other, self)).max(round) - self.radius - other.radius
    }
}
