//! Joints: their markers, numbers and coordinates, and which of them close loops.

use super::tree::Pair;
use crate::builder::{twice, Builder, Fields, Result};
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::graph::Branch as TreeBranch;
use crate::joints::{Card, Field, FieldKind, Joint as _, Kind, Role};
use crate::mechanism::{Body, Coordinate, FrictionSource, Joint, JointFriction, Marker, TreeJoint};
use crate::spec::{Coordinate as CoordinateSpec, Number};

/// What the fields of a joint give, side by side.
#[derive(Default)]
struct Sides {
    first: Option<Marker>,
    second: Option<Marker>,
    curve: Option<usize>,
    /// Each with whether it is a length.
    numbers: Vec<(ModelExpr, bool)>,
}

impl Sides {
    /// Reads one field into its marker, curve or numbers.
    fn read(&mut self, fields: &mut Fields, field: &Field) -> Result<()> {
        let (name, is_length) = (field.name, field.dimension == Some("m"));
        let marker = match (field.role, field.kind) {
            (Role::Number, FieldKind::Numbers) => {
                self.numbers.extend(fields.numbers(name)?.into_iter().map(|law| (law, is_length)));
                return Ok(());
            }
            (Role::Number, _) => {
                self.numbers.push((fields.number(name)?, is_length));
                return Ok(());
            }
            (_, FieldKind::Curve) => {
                self.curve = Some(fields.curve(name)?);
                return Ok(());
            }
            (Role::Both, _) => {
                let [p, q] = fields.two_sites(name)?;
                self.first = Some(fields.c.straight_marker(p));
                fields.c.straight_marker(q)
            }
            (_, FieldKind::Line) => fields.line(name)?,
            (_, FieldKind::Circle) => {
                let (site, radius) = fields.circle(name)?;
                self.numbers.push((radius, true));
                fields.c.straight_marker(site)
            }
            (_, FieldKind::Points) => self.two_points(fields, name)?,
            _ => {
                let site = fields.site(name)?;
                fields.c.straight_marker(site)
            }
        };
        match field.role {
            Role::First => self.first = Some(marker),
            _ => self.second = Some(marker),
        }
        Ok(())
    }

    /// Two points of one body as a marker at the first that looks to the second, and their distance.
    fn two_points(&mut self, fields: &mut Fields, name: &str) -> Result<Marker> {
        let [p, q] = fields.two_sites(name)?;
        let path = format!("{}.{name}", fields.path);
        let [dx, dy] = fields.c.offset(&path, p, q)?;
        self.numbers.push((dx.clone().hypot(dy.clone()), true));
        Ok(fields.c.marker(p, dy.atan2(dx)))
    }
}

impl Builder<'_> {
    pub(crate) fn joints(&mut self, pairs: &[Pair], tree: &[TreeBranch]) -> Result<()> {
        for (i, pair) in pairs.iter().enumerate() {
            let branch = tree.iter().find(|b| b.edge == i).copied();
            let joint = self.joint(pair, branch)?;
            self.name_joint(&pair.path, &joint)?;
            self.m.joints.push(joint);
        }
        self.free_bodies(pairs.len(), tree)?;
        for joint in 0..pairs.len() {
            self.close(joint)?;
        }
        self.number_coordinates();
        for (joint, pair) in pairs.iter().enumerate() {
            self.joint_friction(joint, pair)?;
        }
        Ok(())
    }

    /// Friction of a joint along its first coordinate.
    fn joint_friction(&mut self, joint: usize, pair: &Pair) -> Result<()> {
        let Some(friction) = &pair.element.friction else { return Ok(()) };
        let path = format!("{}.friction", pair.path);
        let card = pair.kind.card();
        let turns = card.coordinates.first().is_some_and(|c| c.turn);
        if !card.has_friction || self.m.joints[joint].coordinates.is_empty() {
            let what = format!("a {} has no friction of its own", card.word);
            return Err(CompileError::new(
                path,
                what,
                "give it to a hinge, a slot, a curved slot or a slider, or write a contact",
            ));
        }
        if turns != friction.radius.is_some() {
            let what = if turns {
                "the friction of a hinge needs the radius of its bearing"
            } else {
                "this joint has no bearing"
            };
            return Err(CompileError::new(path, what, "the bearing radius belongs to the friction of a hinge"));
        }
        let kinetic = self.number_value(&path, &friction.kinetic)?;
        let fixed = match &friction.fixed {
            Some(fixed) => self.number_value(&path, fixed)?,
            None => kinetic,
        };
        let radius = friction.radius.as_ref().map(|r| self.number_value(&path, r)).transpose()?;
        self.m.joint_friction.push(JointFriction { of: FrictionSource::Joint { joint, radius }, fixed, kinetic });
        Ok(())
    }

    fn name_joint(&mut self, path: &str, joint: &Joint) -> Result<()> {
        let index = self.m.joints.len();
        if self.names.joints.insert(joint.name.clone(), (index, joint.kind)).is_some() {
            return Err(twice(path, &joint.name));
        }
        for (k, c) in joint.coordinates.iter().enumerate() {
            let taken = self.names.parameters.contains_key(&c.name);
            if taken || self.names.coordinates.insert(c.name.clone(), (index, k)).is_some() {
                return Err(twice(format!("{path}.coordinate"), &c.name));
            }
        }
        Ok(())
    }

    fn joint(&mut self, pair: &Pair, branch: Option<TreeBranch>) -> Result<Joint> {
        let card = pair.kind.card();
        let mut fields = Fields { c: self, element: &pair.element, card: &card, path: pair.path.clone() };
        fields.check()?;
        let mut sides = Sides::default();
        for field in &card.fields {
            sides.read(&mut fields, field)?;
        }
        let Sides { first, second, curve, numbers } = sides;
        let ends = pair.ends.each_ref().map(|name| self.names.bodies[name.as_str()]);
        let particle = ends.map(|body| self.m.bodies[body].particle);
        let first = first.unwrap_or_else(|| self.at_origin(ends[0]));
        let second = second.expect("a joint has a second marker");
        let reversed = branch.is_some_and(|b| b.reversed);
        let child_is_particle = particle[if reversed { 0 } else { 1 }];
        let has_turn = card.coordinates.iter().any(|c| c.turn);
        if branch.is_some() && particle.contains(&true) && !child_is_particle && !has_turn {
            let what = format!("a {} would have to pass a couple to a particle", card.word);
            return Err(CompileError::new(&pair.path, what, "use a slot or a hinge, or make the body rigid"));
        }
        if particle.contains(&true) && !card.rows.iter().any(|r| r.load.couple) && !has_turn && !card.rows.is_empty() {
            let what = format!("a {} needs bodies that can turn, and a particle cannot", card.word);
            return Err(CompileError::new(&pair.path, what, "use a slot or a link, or make the particle a rigid body"));
        }
        let coordinates = self.coordinates(pair, &card, child_is_particle, reversed)?;
        let number = |(law, is_length)| if is_length { self.length(law) } else { self.value(law) };
        let numbers = numbers.into_iter().map(number).collect();
        let rows: Vec<usize> =
            (0..card.rows.len()).filter(|&r| !(card.rows[r].load.couple && particle.contains(&true))).collect();
        Ok(Joint {
            name: pair.element.name.clone(),
            kind: pair.kind,
            first,
            second,
            numbers,
            curve,
            size: card.coordinates.len(),
            coordinates,
            couple: rows.iter().any(|&r| card.rows[r].turns()),
            rows,
            is_relative: card.rows.iter().map(|row| row.is_relative).collect(),
            child: branch.map(|b| b.child),
        })
    }

    fn at_origin(&mut self, body: usize) -> Marker {
        let name = &self.m.bodies[body].name;
        let site = self.names.sites[&format!("{name}.origin")];
        self.straight_marker(site)
    }

    /// The coordinates of a joint: named by the model in the order of the card, or after the joint.
    fn coordinates(&mut self, pair: &Pair, card: &Card, particle: bool, reversed: bool) -> Result<Vec<Coordinate>> {
        let present: Vec<usize> =
            (0..card.coordinates.len()).filter(|&i| !(particle && card.coordinates[i].turn)).collect();
        let given = &pair.element.coordinates;
        let path = format!("{}.coordinate", pair.path);
        if given.len() > present.len() {
            let what = format!("{} coordinates are named, but this joint has {}", given.len(), present.len());
            return Err(CompileError::new(path, what, "a particle has no angle"));
        }
        let mut coordinates = vec![];
        for (k, &i) in present.iter().enumerate() {
            let card = &card.coordinates[i];
            let default = CoordinateSpec {
                name: format!("{}.{}", pair.element.name, card.name),
                zero: Number::Literal(0.0),
                sense: 1,
                absolute: false,
            };
            let c = given.get(k).unwrap_or(&default);
            if c.absolute && reversed {
                let what =
                    format!("`{}` cannot be absolute: this joint carries its first body, not its second", c.name);
                return Err(CompileError::new(path, what, "name the body nearer to ground first"));
            }
            if c.absolute && card.dimension != "rad" {
                return Err(CompileError::new(path, format!("`{}` is no angle, so it cannot be absolute", c.name), ""));
            }
            coordinates.push(Coordinate {
                name: c.name.clone(),
                card: i,
                dimension: card.dimension,
                zero: self.number_value(&path, &c.zero)?,
                sense: f64::from(c.sense),
                absolute: c.absolute,
                ends: !card.ends.is_empty(),
            });
        }
        Ok(coordinates)
    }

    /// Bodies that nothing joins to ground are free from its origin.
    fn free_bodies(&mut self, known: usize, tree: &[TreeBranch]) -> Result<()> {
        for branch in tree.iter().filter(|b| b.edge >= known) {
            let body = &self.m.bodies[branch.child];
            let (name, particle) = (body.name.clone(), body.particle);
            let (first, second) = (self.at_origin(0), self.at_origin(branch.child));
            let card = Kind::Free.card();
            let zero = self.value(ModelExpr::constant(0.0));
            let coordinates = card.coordinates.iter().enumerate().filter(|(_, c)| !(particle && c.turn));
            let coordinates = coordinates.map(|(i, c)| Coordinate {
                name: format!("{name}.{}", c.name),
                card: i,
                dimension: c.dimension,
                zero,
                sense: 1.0,
                absolute: false,
                ends: false,
            });
            let joint = Joint {
                name: format!("{name} free"),
                kind: Kind::Free,
                first,
                second,
                numbers: vec![],
                curve: None,
                size: 3,
                coordinates: coordinates.collect(),
                rows: vec![],
                is_relative: vec![],
                couple: false,
                child: Some(branch.child),
            };
            self.m.notes.push(format!("`{name}` is joined to nothing: it moves freely from ground.O."));
            self.name_joint(&format!("bodies.{name}"), &joint)?;
            self.m.joints.push(joint);
        }
        let first_free = self.m.joints.len() - tree.iter().filter(|b| b.edge >= known).count();
        for branch in tree {
            let joint = if branch.edge < known { branch.edge } else { first_free + branch.edge - known };
            let j = &self.m.joints[joint];
            let far = if branch.reversed { j.first } else { j.second };
            let body = &mut self.m.bodies[branch.child];
            body.joint_origin = far.site;
            body.tree_joint = Some(TreeJoint {
                parent: branch.parent,
                joint,
                reversed: branch.reversed,
                start: 0,
                freedom: j.coordinates.len(),
                hinge: j.kind == Kind::Hinge,
            });
        }
        Ok(())
    }

    /// A joint outside the tree closes a loop; one along a curve does so by way of a massless body that it carries: a
    /// particle in place of a point, which may turn, to which the second body is pinned, or a rigid body to which it is
    /// welded.
    fn close(&mut self, joint: usize) -> Result<()> {
        if self.m.joints[joint].child.is_some() {
            return Ok(());
        }
        if self.m.joints[joint].curve.is_none() {
            self.m.closures.push(joint);
            return Ok(());
        }
        let (old, name) = (self.m.joints[joint].second, self.m.joints[joint].name.clone());
        let zero = self.value(ModelExpr::constant(0.0));
        let body = self.m.bodies.len();
        let site = self.site(body, crate::mechanism::PointLocation::At([zero, zero]));
        let pin = self.straight_marker(site);
        let parent = self.m.body_of(self.m.joints[joint].first.site);
        let carried = self.m.bodies[self.m.body_of(old.site)].name.clone();
        let j = &mut self.m.joints[joint];
        j.second = pin;
        j.child = Some(body);
        for c in j.coordinates.iter().filter(|c| c.dimension == "rad") {
            self.names.coordinates.remove(&c.name);
        }
        j.coordinates.retain(|c| c.dimension != "rad");
        let turns = j.kind.card().coordinates.iter().any(|c| c.turn);
        let (kind, numbers, rows) =
            if turns { (Kind::Hinge, vec![], vec![0, 1]) } else { (Kind::Weld, vec![zero], vec![0, 1, 2]) };
        let branch = TreeJoint { parent, joint, reversed: false, start: 0, freedom: j.coordinates.len(), hinge: false };
        self.m.bodies.push(Body {
            name: carried,
            listed: None,
            particle: turns,
            mass_elements: vec![],
            tree_joint: Some(branch),
            joint_origin: site,
        });
        self.m.closures.push(self.m.joints.len());
        self.m.joints.push(Joint {
            name,
            kind,
            first: pin,
            second: old,
            numbers,
            curve: None,
            size: kind.card().coordinates.len(),
            coordinates: vec![],
            is_relative: vec![false; rows.len()],
            couple: !turns,
            rows,
            child: None,
        });
        Ok(())
    }

    /// The coordinates of the tree in the order of the joints.
    fn number_coordinates(&mut self) {
        for joint in 0..self.m.joints.len() {
            let Some(child) = self.m.joints[joint].child else { continue };
            let branch = self.m.bodies[child].tree_joint.as_mut().expect("a body of the tree");
            branch.start = self.m.coordinates.len();
            self.m.coordinates.extend((0..branch.freedom).map(|k| (joint, k)));
        }
    }
}
