//! Joints, drives, forces and events.

use super::tree::Pair;
use super::{twice, CompileError, Compiler, Fields, Names, Reach, Result};
use crate::gauges::{Law, Leaf};
use crate::graph::Branch as TreeBranch;
use crate::joints::{Card, FieldKind, Joint as _, Kind, Role};
use crate::mechanism::{Body, Branch, Coordinate, Deed, Drive, Event, Joint, Level, Marker};
use crate::spec::{Action, Coordinate as CoordinateSpec};

/// The card of a coupling, which joins gauges rather than bodies.
pub fn coupling_card() -> Card {
    Card::new("coupling", "An expression of the configuration stays 0.").needs(
        "zero",
        FieldKind::Gauge,
        Role::Number,
        "",
        "the expression",
    )
}

impl Compiler<'_> {
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
        let (mut first, mut second, mut curve, mut numbers) = (None, None, None, vec![]);
        for field in &card.fields {
            read_side(
                &mut fields,
                field.name,
                field.kind,
                field.role,
                &mut first,
                &mut second,
                &mut curve,
                &mut numbers,
            )?;
        }
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
        if particle.contains(&true) && !card.rows.iter().any(|r| r.turning) && !has_turn && !card.rows.is_empty() {
            let what = format!("a {} needs bodies that can turn, and a particle cannot", card.word);
            return Err(CompileError::new(&pair.path, what, "use a slot or a link, or make the particle a rigid body"));
        }
        let coordinates = self.coordinates(pair, &card, child_is_particle, reversed)?;
        let numbers = numbers.into_iter().map(|law| self.slot(law)).collect();
        let rows = card.rows.iter().enumerate().filter(|(_, row)| !(row.turning && particle.contains(&true)));
        Ok(Joint {
            name: pair.element.name.clone(),
            kind: pair.kind,
            first,
            second,
            numbers,
            curve,
            size: card.coordinates.len(),
            coordinates,
            rows: rows.map(|(i, _)| i).collect(),
            phased: card.rows.iter().map(|row| row.phased).collect(),
            child: branch.map(|b| b.child),
        })
    }

    fn at_origin(&mut self, body: usize) -> Marker {
        let name = &self.m.bodies[body].name;
        Marker { site: self.names.sites[&format!("{name}.origin")], angle: self.slot(Law::constant(0.0)) }
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
                zero: super::places::nought(),
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
                zero: self.number_slot(&path, &c.zero)?,
                sense: f64::from(c.sense),
                absolute: c.absolute,
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
            let zero = self.slot(Law::constant(0.0));
            let coordinates = card.coordinates.iter().enumerate().filter(|(_, c)| !(particle && c.turn));
            let coordinates = coordinates.map(|(i, c)| Coordinate {
                name: format!("{name}.{}", c.name),
                card: i,
                dimension: c.dimension,
                zero,
                sense: 1.0,
                absolute: false,
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
                phased: vec![],
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
            body.pin = far.site;
            body.branch = Some(Branch {
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

    /// A joint outside the tree closes a loop; one along a curve does so by way of a massless particle.
    fn close(&mut self, joint: usize) -> Result<()> {
        if self.m.joints[joint].child.is_some() {
            return Ok(());
        }
        if self.m.joints[joint].curve.is_none() {
            self.m.closures.push(joint);
            return Ok(());
        }
        let (old, name) = (self.m.joints[joint].second, self.m.joints[joint].name.clone());
        let zero = self.slot(Law::constant(0.0));
        let body = self.m.bodies.len();
        let site = self.site(body, crate::mechanism::Spot::At([zero, zero]));
        let pin = Marker { site, angle: zero };
        let parent = self.m.body_of(self.m.joints[joint].first.site);
        let j = &mut self.m.joints[joint];
        j.second = pin;
        j.child = Some(body);
        for c in j.coordinates.iter().filter(|c| c.dimension == "rad") {
            self.names.coordinates.remove(&c.name);
        }
        j.coordinates.retain(|c| c.dimension != "rad");
        let branch = Branch { parent, joint, reversed: false, start: 0, freedom: 1, hinge: false };
        self.m.bodies.push(Body {
            name: format!("{name}.pin"),
            listed: None,
            particle: true,
            pieces: vec![],
            branch: Some(branch),
            pin: site,
        });
        self.m.closures.push(self.m.joints.len());
        self.m.joints.push(Joint {
            name: format!("{name}.pin"),
            kind: Kind::Hinge,
            first: pin,
            second: old,
            numbers: vec![],
            curve: None,
            size: 1,
            coordinates: vec![],
            rows: vec![0, 1],
            phased: vec![false, false],
            child: None,
        });
        Ok(())
    }

    /// The coordinates of the tree in the order of the joints.
    fn number_coordinates(&mut self) {
        for joint in 0..self.m.joints.len() {
            let Some(child) = self.m.joints[joint].child else { continue };
            let branch = self.m.bodies[child].branch.as_mut().expect("a body of the tree");
            branch.start = self.m.coordinates.len();
            self.m.coordinates.extend((0..branch.freedom).map(|k| (joint, k)));
        }
    }

    pub(crate) fn drives(&mut self) -> Result<()> {
        for element in self.spec.joints.iter().filter(|e| e.kind == "coupling") {
            let path = format!("joints.{}", element.name);
            let card = coupling_card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let of = fields.gauge("zero")?;
            let law = Law::constant(0.0);
            let name = element.name.clone();
            self.drive(
                &path,
                Drive { name, coupling: true, of, law, level: Level::Position, by: None, feedback: false },
            )?;
        }
        for motion in &self.spec.motions {
            let path = format!("motions.{}", motion.name);
            let of = self.law(&format!("{path}.of"), &motion.of, Reach::Configuration)?;
            let law = self.law(&format!("{path}.is"), &motion.law, Reach::Motion)?;
            let by = match &motion.by {
                Some(by) => Some(self.law(&format!("{path}.by"), by, Reach::Configuration)?),
                None => None,
            };
            let level = match motion.level.as_str() {
                "position" => Level::Position,
                "velocity" => Level::Velocity,
                "acceleration" => Level::Acceleration,
                word => {
                    let what = format!("`{word}` is no level of a motion");
                    return Err(CompileError::new(
                        format!("{path}.level"),
                        what,
                        "write position, velocity or acceleration",
                    ));
                }
            };
            if level != Level::Acceleration && law.depends_on_rates() {
                let what = "a law of rates gives an acceleration, not a position or a velocity";
                return Err(CompileError::new(format!("{path}.is"), what, "write `level: acceleration`"));
            }
            let feedback = law.leaves().any(|l| !matches!(l, Leaf::Time | Leaf::Parameter(_)));
            let name = motion.name.clone();
            self.drive(&path, Drive { name, coupling: false, of, law, level, by, feedback })?;
        }
        Ok(())
    }

    fn drive(&mut self, path: &str, drive: Drive) -> Result<()> {
        let taken = self.names.joints.contains_key(&drive.name);
        if taken || self.names.drives.insert(drive.name.clone(), self.m.drives.len()).is_some() {
            return Err(twice(path, &drive.name));
        }
        if self.m.bodies_of(&drive.of).is_empty() {
            return Err(CompileError::new(
                path,
                "this gauge measures no body that can move",
                "name a coordinate, a point or an angle",
            ));
        }
        self.m.drives.push(drive);
        Ok(())
    }

    pub(crate) fn forces(&mut self) -> Result<()> {
        for element in &self.spec.forces {
            let path = format!("forces.{}", element.name);
            let Some(kind) = crate::forces::named(&element.kind) else {
                let words: Vec<String> = crate::forces::ALL.iter().map(|f| f.card().word.to_string()).collect();
                let message = super::names::unknown("type of force", &element.kind, words.iter());
                return Err(CompileError::from(format!("{path}.type"), message));
            };
            let card = kind.card();
            let mut fields = Fields { c: self, element, card: &card, path: path.clone() };
            fields.check()?;
            let mut force = kind.lower(&mut fields)?;
            force.name = element.name.clone();
            force.word = card.word;
            for pull in &mut force.pulls {
                pull.bodies = self.m.bodies_of(&pull.gauge);
            }
            if self.names.forces.insert(force.name.clone(), self.m.forces.len()).is_some() {
                return Err(twice(path, &force.name));
            }
            self.m.forces.push(force);
        }
        Ok(())
    }

    pub(crate) fn events(&mut self) -> Result<()> {
        for event in &self.spec.events {
            let path = format!("events.{}", event.name);
            let when = self.law(&format!("{path}.when"), &event.when, Reach::Instant)?;
            let condition = match &event.condition {
                Some(text) => {
                    Some(self.scope(Reach::Instant).condition(text).map_err(|e| Names::complaint(&path, text, e))?)
                }
                None => None,
            };
            let mut then = vec![];
            for action in &event.then {
                match action {
                    Action::Stop => then.push(Deed::Stop),
                    Action::Set(values) => {
                        for (name, text) in values {
                            let known = self.names.parameters.keys();
                            let missing = || CompileError::from(&path, super::names::unknown("parameter", name, known));
                            let p = *self.names.parameters.get(name).ok_or_else(missing)?;
                            then.push(Deed::Set(p, self.law(&path, text, Reach::Instant)?));
                        }
                    }
                }
            }
            self.m.events.push(Event { name: event.name.clone(), when, direction: event.direction, condition, then });
        }
        Ok(())
    }
}

/// Reads one field of a joint into its markers, curve and numbers.
#[allow(clippy::too_many_arguments)]
fn read_side(
    fields: &mut Fields,
    name: &str,
    kind: FieldKind,
    role: Role,
    first: &mut Option<Marker>,
    second: &mut Option<Marker>,
    curve: &mut Option<usize>,
    numbers: &mut Vec<Law>,
) -> Result<()> {
    let straight = |fields: &mut Fields, site| Marker { site, angle: fields.c.slot(Law::constant(0.0)) };
    let marker = match (role, kind) {
        (Role::Number, FieldKind::Numbers) => {
            numbers.extend(fields.numbers(name)?);
            return Ok(());
        }
        (Role::Number, _) => {
            numbers.push(fields.number(name)?);
            return Ok(());
        }
        (Role::Both, _) => {
            let [p, q] = fields.two_sites(name)?;
            *first = Some(straight(fields, p));
            straight(fields, q)
        }
        (_, FieldKind::Line) => fields.line(name)?,
        (_, FieldKind::Circle) => {
            let (site, radius) = fields.circle(name)?;
            numbers.push(radius);
            straight(fields, site)
        }
        (_, FieldKind::Curve) => {
            *curve = Some(fields.curve(name)?);
            return Ok(());
        }
        (_, FieldKind::Points) => {
            let [p, q] = fields.two_sites(name)?;
            let path = format!("{}.{name}", fields.path);
            let [dx, dy] = fields.c.offset(&path, p, q)?;
            numbers.push(dx.clone().hypot(dy.clone()));
            Marker { site: p, angle: fields.c.slot(dy.atan2(dx)) }
        }
        _ => {
            let site = fields.site(name)?;
            straight(fields, site)
        }
    };
    match role {
        Role::First => *first = Some(marker),
        _ => *second = Some(marker),
    }
    Ok(())
}
