//! One balance equation of a group of bodies: moments about a point, or forces along a direction.
//!
//! The group moves as one, virtually: turned about a point P, or shifted along a direction e. The power of all loads on
//! it is then that of its rate of momentum: Σ M/P = Ḣ/P, or Σ F·e = L̇·e. Loads between its own bodies cancel.

use super::query::{About, Along, Group, Parts};
use super::vectors::{linear_in, tree, tree_by};
use super::SymbolicState;
use crate::algebra::{Symbol, Tree};
use crate::dynamics::{momentum, momentum_rate, DynamicsError};
use crate::free_bodies::{Load, Part, Size};
use crate::plane::{vec2, Vec2, Wrench};
use crate::scalar::Scalar;
use serde_json::{json, Value};

/// A rigid virtual motion of a group.
#[derive(Clone, Copy)]
pub enum VirtualMotion {
    /// A turn about a point at `about / scale`, fixed axes: the scale keeps equations free of fractions.
    Moment { about: Vec2<Symbol>, scale: Symbol },
    /// A shift along a direction.
    Force(Vec2<Symbol>),
}

impl VirtualMotion {
    /// The power of a force at a point and a couple.
    fn power(self, point: Vec2<Symbol>, force: Vec2<Symbol>, couple: Symbol) -> Symbol {
        match self {
            VirtualMotion::Moment { about, scale } => (point * scale - about).cross(force) + couple * scale,
            VirtualMotion::Force(along) => along.dot(force),
        }
    }

    pub(super) fn about(point: Vec2<Symbol>) -> Self {
        VirtualMotion::Moment { about: point, scale: Symbol::one() }
    }
}

/// The balance of momentum of a group: Σ of the powers of its loads = that of its rate of momentum.
pub struct Balance {
    /// Of every load on it its number, its power, and whether it acts between bodies of the group.
    loads: Vec<(usize, Symbol, bool)>,
    /// Of every body the power of its rate of momentum.
    rates: Vec<(usize, Symbol)>,
    pub left: Symbol,
    pub right: Symbol,
}

impl SymbolicState<'_> {
    /// The bodies of a group; none named means all.
    pub(super) fn group(&self, group: &Group) -> Result<Vec<usize>, DynamicsError> {
        if group.is_empty() {
            return Ok(self.m.listed_bodies());
        }
        group.iter().map(|name| self.body(name)).collect()
    }

    pub(super) fn body(&self, name: &str) -> Result<usize, DynamicsError> {
        let known = || self.m.listed_bodies().into_iter().map(|i| &self.m.bodies[i].name);
        self.m.bodies.iter().position(|b| b.name == name).ok_or_else(|| unknown("body", name, known()))
    }

    pub(super) fn point(&self, name: &str) -> Result<usize, DynamicsError> {
        let known = self.m.points.iter().map(|p| &p.0);
        let found = self.m.points.iter().find(|p| p.0 == name);
        found.map(|p| p.1).ok_or_else(|| unknown("point", name, known))
    }

    fn load(&self, index: usize) -> Result<&Load<Symbol>, DynamicsError> {
        let sentence = || DynamicsError::UnknownName(format!("there is no load {index}; count them from 0"));
        self.loads.get(index).ok_or_else(sentence)
    }

    /// The line on which a load acts on a group.
    fn acts_on(&self, index: usize, bodies: &[usize]) -> Result<Part<Symbol>, DynamicsError> {
        let load = self.load(index)?;
        let part = load.parts.iter().find(|part| bodies.contains(&part.body)).or(load.parts.first());
        part.copied().ok_or_else(|| DynamicsError::UnknownName(format!("`{}` acts on nothing", load.symbol)))
    }

    /// What a load does to a group, with the friction that follows from it: its force, and its moment about the origin.
    fn wrench(&self, index: usize, bodies: &[usize]) -> Result<Wrench<Symbol>, DynamicsError> {
        let own = self.acts_on(index, bodies)?.body;
        let with = |load: &Load<Symbol>| match load.size {
            Size::Follows(of, ratio) if of == index => Some(ratio),
            _ => None,
        };
        let followers = self.loads.iter().filter_map(|load| with(load).map(|ratio| (load, ratio)));
        let mut sum = Wrench::zero();
        for (load, ratio) in std::iter::once((self.load(index)?, Symbol::one())).chain(followers) {
            for part in load.parts.iter().filter(|part| part.body == own || bodies.contains(&part.body)) {
                let force = Wrench::force(part.force, part.point);
                sum += Wrench { m: force.m + part.couple, ..force } * ratio;
            }
        }
        Ok(sum)
    }

    fn turned_about(&self, about: &About, bodies: &[usize]) -> Result<VirtualMotion, DynamicsError> {
        let at = self.at();
        let point = match about {
            About::Point(name) => {
                let site = self.point(name)?;
                self.k.pose[self.m.body_of(site)].place(at.n.arms[site])
            }
            About::Load(index) => return Ok(on_line(self.acts_on(*index, bodies)?)),
            About::Meeting(a, b) => return Ok(meeting(self.wrench(*a, bodies)?, self.wrench(*b, bodies)?)),
            About::Centre => self.centre_of(bodies),
        };
        Ok(VirtualMotion::about(point))
    }

    fn centre_of(&self, bodies: &[usize]) -> Vec2<Symbol> {
        let (mut mass, mut moment) = (Symbol::zero(), Vec2::zero());
        for &b in bodies {
            mass += self.n.mass[b];
            moment += self.centre(b) * self.n.mass[b];
        }
        match mass.is_zero() {
            true => self.centre(bodies[0]),
            false => moment * (Symbol::one() / mass),
        }
    }

    fn along(&self, along: &Along, bodies: &[usize]) -> Result<Vec2<Symbol>, DynamicsError> {
        let (zero, one) = (Symbol::zero(), Symbol::one());
        Ok(match along {
            Along::X => vec2(one, zero),
            Along::Y => vec2(zero, one),
            Along::Load(index) => self.acts_on(*index, bodies)?.force,
            Along::Across(index) => self.acts_on(*index, bodies)?.force.perp(),
            Along::Clear(index) => self.wrench(*index, bodies)?.f.perp(),
            Along::Body(name) => {
                let turn = self.k.pose[self.body(name)?].turn;
                vec2(turn.cos, turn.sin)
            }
        })
    }

    pub(super) fn virtual_motion_of(
        &self,
        about: Option<&About>,
        along: Option<&Along>,
        bodies: &[usize],
    ) -> Result<VirtualMotion, DynamicsError> {
        match (about, along) {
            (Some(about), None) => self.turned_about(about, bodies),
            (None, Some(along)) => Ok(VirtualMotion::Force(self.along(along, bodies)?)),
            _ => Err(DynamicsError::WrongQuestion(
                "an equation is `about` a point or `along` a direction, one of them".into(),
            )),
        }
    }

    /// What every load gives to an equation; what acts between bodies of the group is left out.
    fn moments(&self, bodies: &[usize], test: VirtualMotion) -> Vec<(usize, Symbol, bool)> {
        let mut entries = vec![];
        for (index, (load, &size)) in self.loads.iter().zip(&self.sizes).enumerate() {
            let inside: Vec<&Part<Symbol>> = load.parts.iter().filter(|p| bodies.contains(&p.body)).collect();
            if inside.is_empty() {
                continue;
            }
            let mut sum = Symbol::zero();
            for p in &inside {
                let couple =
                    if self.m.bodies[p.body].particle && bodies.len() == 1 { Symbol::zero() } else { p.couple };
                sum += test.power(p.point, p.force, couple);
            }
            let internal = load.parts.len() > 1 && inside.len() == load.parts.len();
            entries.push((index, sum * size, internal));
        }
        entries
    }

    /// The momentum of a body as the equation sees it.
    pub(super) fn momentum(&self, body: usize, test: VirtualMotion) -> Symbol {
        let twist = self.k.twist[body];
        self.tested(body, test, momentum(self.at(), body, twist.at(self.arm(body)), twist.w))
    }

    /// The power of a load about the mass centre of a body.
    fn tested(&self, body: usize, test: VirtualMotion, about_centre: Wrench<Symbol>) -> Symbol {
        test.power(self.centre(body), about_centre.f, about_centre.m)
    }

    /// The balance of momentum of a group under a virtual motion of it.
    pub(super) fn balance(&self, bodies: &[usize], test: VirtualMotion) -> Balance {
        let loads = self.moments(bodies, test);
        let rate = |&b: &usize| (b, self.tested(b, test, momentum_rate(self.at(), b, self.bodies[b])));
        let rates: Vec<(usize, Symbol)> = bodies.iter().map(rate).collect();
        let left = loads.iter().filter(|(_, _, internal)| !internal).fold(Symbol::zero(), |sum, load| sum + load.1);
        let right = rates.iter().fold(Symbol::zero(), |sum, rate| sum + rate.1);
        Balance { loads, rates, left, right }
    }

    /// The equation, with as much of what it is made of as is asked for.
    pub(super) fn equation(&self, bodies: &[usize], test: VirtualMotion, parts: Parts) -> Value {
        let Balance { loads, rates, left, right } = self.balance(bodies, test);
        let unknowns = self.unknowns();
        let sides = [left, right].map(|side| tree_by(side, &unknowns));
        let mut entries = json!({
            "bodies": bodies.iter().map(|&b| &self.m.bodies[b].name).collect::<Vec<_>>(), "test": self.presented(test),
            "left": sides[0], "right": sides[1], "linear": self.linear(right - left),
        });
        if parts.terms {
            let load = |(i, moment, internal): &(usize, Symbol, bool)| {
                let entries = if *internal { Symbol::zero() } else { *moment };
                json!({"load": i, "tree": tree(entries), "zero": moment.is_zero(), "internal": internal})
            };
            let inertia = |&(b, rate): &(usize, Symbol)| json!({"body": self.m.bodies[b].name, "tree": tree(rate), "zero": rate.is_zero()});
            let written = sides.iter().map(Tree::signs).sum::<usize>() <= parts.inertia_within;
            entries["loads"] = loads.iter().map(load).collect();
            entries["inertia"] = rates.iter().filter(|_| written).map(inertia).collect();
        }
        if parts.momentum {
            let momentum = bodies.iter().fold(Symbol::zero(), |sum, &b| sum + self.momentum(b, test));
            entries["momentum"] = json!(tree(momentum));
        }
        entries
    }

    fn presented(&self, test: VirtualMotion) -> Value {
        match test {
            VirtualMotion::Moment { about, scale } => {
                let point = about * (Symbol::one() / scale);
                json!({"kind": "moment", "about": self.vector(point), "scale": tree(scale)})
            }
            VirtualMotion::Force(along) => json!({"kind": "force", "along": self.vector(along)}),
        }
    }

    /// An expression as coefficients of what is unknown, and the rest.
    pub(super) fn linear(&self, of: Symbol) -> Value {
        linear_in(of, &self.unknowns())
    }

    /// The equation of a coordinate: the bodies that it carries, tested by the motion that it allows.
    pub(super) fn of_coordinate(&self, i: usize) -> (Vec<usize>, VirtualMotion) {
        let (joint, k) = self.m.coordinates[i];
        let child = self.m.joints[joint].child.expect("a coordinate of the tree");
        let column = self.k.motion_subspace[child][k];
        let origin = self.k.pose[child].at;
        let test = match column.w.is_zero() {
            true => VirtualMotion::Force(column.v),
            false => VirtualMotion::about(origin + column.v.perp() * (Symbol::one() / column.w)),
        };
        (self.carried_by(child), test)
    }

    /// A body with all that hang on it in the tree, in the order of the model.
    fn carried_by(&self, root: usize) -> Vec<usize> {
        let hangs = |&body: &usize| self.m.common_ancestor(body, root) == root;
        self.m.listed_bodies().into_iter().filter(hangs).collect()
    }
}

/// A turn about where a load acts: of a force with a couple beside it, the place on its line that is nearest to its
/// point.
fn on_line(part: Part<Symbol>) -> VirtualMotion {
    let square = part.force.dot(part.force);
    if part.couple.is_zero() || square.is_zero() {
        return VirtualMotion::about(part.point);
    }
    VirtualMotion::Moment { about: part.point * square - part.force.perp() * part.couple, scale: square }
}

/// A turn about the place where two lines meet: neither load has power in it.
fn meeting(a: Wrench<Symbol>, b: Wrench<Symbol>) -> VirtualMotion {
    let (about, scale) = (a.f * b.m - b.f * a.m, a.f.cross(b.f));
    if scale == -Symbol::one() {
        return VirtualMotion::about(-about); // at right angles, as of a floor and a wall
    }
    VirtualMotion::Moment { about, scale }
}

fn unknown<'n>(what: &str, name: &str, known: impl Iterator<Item = &'n String>) -> DynamicsError {
    let entries = crate::builder::unknown(what, name, known);
    DynamicsError::UnknownName(format!("{}; {}", entries.what, entries.hint))
}
