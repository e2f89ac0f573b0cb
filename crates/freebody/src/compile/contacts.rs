//! Contacts and stops: which disk or point can touch which surface, and what a gauge may not fall below.

use super::outline::Outline;
use crate::builder::{twice, Builder, Reach, Result};
use crate::error::CompileError;
use crate::mechanism::{
    Arc, ContactPair, Disk, Friction, FrictionSource, Gap, Group, JointFriction, Marker, Profile, Track,
    UnilateralConstraint, ValueId,
};
use crate::plane::Vec2;
use crate::spec::{Contact, Number, Surface};
use std::f64::consts::TAU;

/// A surface of a model, lowered.
enum Shape {
    Point(usize),
    Circle {
        centre: usize,
        radius: ValueId,
        hollow: bool,
    },
    Arc(Arc),
    Line(Marker),
    Polyline(Outline),
    Polygon(Outline),
    /// A track, and whether one of its arcs bulges to its free side.
    Track(Track, bool),
}

impl Shape {
    fn site(&self) -> usize {
        match self {
            Shape::Point(site) => *site,
            Shape::Circle { centre, .. } | Shape::Arc(Arc { centre, .. }) => *centre,
            Shape::Line(marker) => marker.site,
            Shape::Polyline(outline) | Shape::Polygon(outline) => outline.chains[0].corners[0],
            Shape::Track(track, _) => track.ends()[0],
        }
    }

    /// As what touches: a point or a solid circle.
    fn disk(&self) -> Option<Disk> {
        match *self {
            Shape::Point(centre) => Some(Disk { centre, radius: None, beside: None }),
            Shape::Circle { centre, radius, hollow: false } => {
                Some(Disk { centre, radius: Some(radius), beside: None })
            }
            _ => None,
        }
    }

    /// As what is touched; a point is not.
    fn profiles(&self) -> Vec<Profile> {
        match self {
            Shape::Point(_) => vec![],
            Shape::Circle { centre, radius, hollow } => {
                vec![Profile::Circle { centre: *centre, radius: *radius, hollow: *hollow }]
            }
            Shape::Arc(arc) => vec![Profile::Arc(arc.clone())],
            Shape::Track(track, _) => vec![Profile::Track(track.clone())],
            Shape::Line(marker) => vec![Profile::Line(*marker)],
            Shape::Polyline(outline) | Shape::Polygon(outline) => {
                outline.chains.iter().cloned().map(Profile::Chain).collect()
            }
        }
    }

    /// The corners that can touch others.
    fn corners(&self) -> Vec<Disk> {
        let point = |&centre: &usize| Disk { centre, radius: None, beside: None };
        match self {
            Shape::Polyline(outline) => outline.points.iter().map(point).collect(),
            Shape::Track(track, _) => track.ends().iter().map(point).collect(),
            Shape::Polygon(outline) => {
                let (points, n) = (&outline.points, outline.points.len());
                let beside = |i: usize| Some([points[(i + n - 1) % n], points[(i + 1) % n]]);
                (0..n).map(|i| Disk { centre: points[i], radius: None, beside: beside(i) }).collect()
            }
            _ => vec![],
        }
    }
}

/// Every disk against every profile.
fn each(disks: &[Disk], surface: &Shape) -> Vec<ContactPair> {
    let profiles = surface.profiles();
    let against = |&disk: &Disk| profiles.iter().map(move |profile| ContactPair { disk, against: profile.clone() });
    disks.iter().flat_map(against).collect()
}

/// The touches of two surfaces; or why they have none, and what to write.
fn touches(a: &Shape, b: &Shape) -> std::result::Result<Vec<ContactPair>, (&'static str, &'static str)> {
    use Shape::{Arc, Circle, Line, Point, Polygon, Polyline, Track};
    match (a, b) {
        (Point(_), Point(_)) => Err(("two points never touch", "give one of them a circle with a radius")),
        (Line(_), Line(_)) => Err(("two lines without ends cannot touch", "make one of them a polygon or a polyline")),
        (Polyline(_), Polyline(_) | Line(_)) | (Line(_), Polyline(_)) => {
            Err(("a polyline meets points, circles and polygons only", "make the moving surface a polygon"))
        }
        (Polygon(_), Track(_, false)) | (Track(_, false), Polygon(_)) => {
            Ok([each(&a.corners(), b), each(&b.corners(), a)].concat())
        }
        (Track(..), other) | (other, Track(..)) if !matches!(other, Point(_) | Circle { hollow: false, .. }) => {
            let what = "a track meets points and circles only, and polygons where no arc bulges towards them";
            Err((what, "make the moving surface a circle"))
        }
        (Arc(crate::mechanism::Arc { hollow: false, .. }), Polygon(_))
        | (Polygon(_), Arc(crate::mechanism::Arc { hollow: false, .. })) => {
            Err(("a polygon does not meet an arc that bulges towards it", "leave out `ends`: it meets whole circles"))
        }
        (Arc(_), other) | (other, Arc(_)) if !matches!(other, Point(_) | Circle { hollow: false, .. }) => {
            Err(("an arc meets points and circles only", "make the moving surface a circle, or the arc a track"))
        }
        (Circle { hollow: true, .. }, Circle { hollow: true, .. } | Line(_) | Polyline(_))
        | (Line(_) | Polyline(_), Circle { hollow: true, .. }) => Err((
            "in a hollow circle only points, circles and polygons can be",
            "leave out `hollow`, or give what moves inside as a circle or a polygon",
        )),
        (Polygon(_), Polygon(_) | Polyline(_)) | (Polyline(_), Polygon(_)) => {
            Ok([each(&a.corners(), b), each(&b.corners(), a)].concat())
        }
        (Polygon(_), Line(_) | Circle { hollow: true, .. }) => Ok(each(&a.corners(), b)),
        (Line(_) | Circle { hollow: true, .. }, Polygon(_)) => Ok(each(&b.corners(), a)),
        // A point is never the surface; of two circles the first is the disk.
        (_, Point(_)) => Ok(each(b.disk().as_slice(), a)),
        (Point(_) | Circle { hollow: false, .. }, _) => Ok(each(a.disk().as_slice(), b)),
        _ => Ok(each(b.disk().as_slice(), a)),
    }
}

impl Builder<'_> {
    /// The contacts. The shapes of polygons and polylines are judged at the parameters' own values; other parameters
    /// must keep their corners convex or concave as they are.
    pub(crate) fn contacts(&mut self) -> Result<()> {
        let arms = match self.spec.contacts.is_empty() {
            true => vec![],
            false => self.m.bind(&self.m.parameters_with(&[])).arms,
        };
        for contact in &self.spec.contacts {
            let path = format!("contacts.{}", contact.name);
            let [a, b] = [0, 1].map(|i| self.shape(&format!("{path}.of[{i}]"), &contact.of[i], &arms));
            let (a, b) = (a?, b?);
            let ends = [&a, &b].map(|shape| self.m.body_of(shape.site()));
            if ends[0] == ends[1] {
                let what = format!("both surfaces are on `{}`", self.m.bodies[ends[0]].name);
                return Err(CompileError::new(format!("{path}.of"), what, "a contact needs two different bodies"));
            }
            let refused = |(what, hint)| CompileError::new(format!("{path}.of"), what, hint);
            let touches = touches(&a, &b).map_err(refused)?;
            touches.iter().try_for_each(|touch| self.fits(&format!("{path}.of"), touch))?;
            let friction = self.friction(&path, contact)?;
            let restitution = self.restitution(&path, &contact.restitution)?;
            let soft = self.soft(&path, &contact.stiffness, &contact.damping)?;
            let friction = match (friction, soft) {
                (Some(Friction::Coulomb { fixed, kinetic }), Some(_)) => {
                    let first = self.m.unilateral.len();
                    let friction =
                        |constraint| JointFriction { of: FrictionSource::Unilateral(constraint), fixed, kinetic };
                    self.m.joint_friction.extend((first..first + touches.len()).map(friction));
                    None
                }
                (Some(Friction::Rough), Some(_)) => {
                    let what = "a rough contact on a spring would jerk when it touches down";
                    return Err(CompileError::new(&path, what, "give the coefficient of its friction"));
                }
                (friction, _) => friction,
            };
            let limits = touches.into_iter().map(|touch| UnilateralConstraint {
                bodies: touch.bodies(&self.m).into_iter().filter(|&body| body > 0).collect(),
                gap: Gap::ContactPair(touch),
                group: self.m.groups.len(),
                restitution,
                friction,
                soft,
            });
            let limits = limits.collect();
            self.group(&path, &contact.name, "contact", ends, limits, contact.engaged)?;
        }
        Ok(())
    }

    /// The ends of the way of gauges.
    pub(crate) fn stops(&mut self) -> Result<()> {
        for stop in &self.spec.stops {
            let path = format!("stops.{}", stop.name);
            let gap = self.law(&format!("{path}.gap"), &stop.gap, Reach::Configuration)?;
            let bodies = self.m.bodies_of(&gap);
            if bodies.is_empty() {
                let what = "this gauge measures no body that can move";
                return Err(CompileError::new(format!("{path}.gap"), what, "name a coordinate, a point or an angle"));
            }
            let restitution = self.restitution(&path, &stop.restitution)?;
            let soft = self.soft(&path, &stop.stiffness, &stop.damping)?;
            let group = self.m.groups.len();
            let constraint =
                UnilateralConstraint { gap: Gap::Gauge(gap), group, bodies, restitution, friction: None, soft };
            self.group(&path, &stop.name, "stop", [0; 2], vec![constraint], stop.engaged)?;
        }
        Ok(())
    }

    /// The spring and the damper that stand for a unilateral constraint.
    pub(crate) fn soft(
        &mut self,
        path: &str,
        stiffness: &Option<Number>,
        damping: &Option<Number>,
    ) -> Result<Option<[ValueId; 2]>> {
        let Some(stiffness) = stiffness else {
            if damping.is_some() {
                let what = "`damping` goes with `stiffness`";
                return Err(CompileError::new(
                    format!("{path}.damping"),
                    what,
                    "give the stiffness of its spring, too",
                ));
            }
            return Ok(None);
        };
        let stiffness = self.number_value(&format!("{path}.stiffness"), stiffness)?;
        let none = Number::Literal(0.0);
        let damping = self.number_value(&format!("{path}.damping"), damping.as_ref().unwrap_or(&none))?;
        Ok(Some([stiffness, damping]))
    }

    /// Enters a contact, stop or string under its name.
    pub(crate) fn group(
        &mut self,
        path: &str,
        name: &str,
        word: &'static str,
        ends: [usize; 2],
        limits: Vec<UnilateralConstraint>,
        engaged: bool,
    ) -> Result<()> {
        let n = &mut self.names;
        let taken = n.joints.contains_key(name) || n.drives.contains_key(name) || n.forces.contains_key(name);
        if taken || n.groups.insert(name.to_string(), self.m.groups.len()).is_some() {
            return Err(twice(path, name));
        }
        let start = self.m.unilateral.len();
        self.m.unilateral.extend(limits);
        let limits = start..self.m.unilateral.len();
        self.m.groups.push(Group { name: name.to_string(), word, ends, constraints: limits, engaged });
        Ok(())
    }

    fn shape(&mut self, path: &str, surface: &Surface, arms: &[Vec2]) -> Result<Shape> {
        let site = |c: &Self, name: &str| c.names.site(name).map_err(|m| CompileError::from(path, m));
        Ok(match surface {
            Surface::Point(name) => Shape::Point(site(self, name)?),
            Surface::Circle { centre, radius, hollow, ends } => {
                if matches!(radius, Number::Literal(r) if *r <= 0.0) {
                    let hint = "give it a radius above 0, or write `point`";
                    return Err(CompileError::new(format!("{path}.radius"), "this circle has no size", hint));
                }
                let radius = self.length_value(&format!("{path}.radius"), radius)?;
                let (centre, hollow) = (site(self, centre)?, *hollow);
                match ends {
                    None => Shape::Circle { centre, radius, hollow },
                    Some(ends) => Shape::Arc(Arc { centre, radius, hollow, ends: self.ends_of_arc(path, ends)? }),
                }
            }
            Surface::Line(place) => Shape::Line(self.place(path, place)?.0),
            Surface::Polyline(names) => Shape::Polyline(Outline::polyline(path, &self.corners(path, names, arms)?)?),
            Surface::Track { start, stretches } => {
                let track = self.track(path, start, stretches, arms)?;
                let bulges = track.stretches.iter().any(|stretch| stretch.bulges(&|site| arms[site]));
                Shape::Track(track, bulges)
            }
            Surface::Polygon(names) => Shape::Polygon(Outline::polygon(path, self.corners(path, names, arms)?)?),
        })
    }

    fn ends_of_arc(&mut self, path: &str, [first, second]: &[Number; 2]) -> Result<[ValueId; 2]> {
        let path = format!("{path}.ends");
        if let (Number::Literal(a), Number::Literal(b)) = (first, second) {
            if !(0.0..TAU).contains(&(b - a)) || a == b {
                let what = "an arc goes counter-clockwise from its first end to its second, by less than a turn";
                return Err(CompileError::new(path, what, "turn its ends, or leave them out for a whole circle"));
            }
        }
        Ok([self.number_value(&path, first)?, self.number_value(&path, second)?])
    }

    fn friction(&mut self, path: &str, contact: &Contact) -> Result<Option<Friction>> {
        let none = |number: &Number| *number == Number::Literal(0.0);
        let smooth = none(&contact.friction) && contact.static_friction.as_ref().is_none_or(none);
        let error = |field: &str, what: &str, hint| Err(CompileError::new(format!("{path}.{field}"), what, hint));
        match (contact.rough, smooth) {
            (true, true) => return Ok(Some(Friction::Rough)),
            (true, false) => {
                return error("friction", "a rough contact never slides", "leave out `rough` or the coefficients")
            }
            (false, true) => return Ok(None),
            (false, false) => {}
        }
        let named = [("friction", Some(&contact.friction)), ("static_friction", contact.static_friction.as_ref())];
        for (field, number) in named {
            if matches!(number, Some(Number::Literal(x)) if *x < 0.0) {
                return error(field, "a coefficient of friction is not negative", "give a number of 0 or more");
            }
        }
        if let (Number::Literal(kinetic), Some(Number::Literal(fixed))) = (&contact.friction, &contact.static_friction)
        {
            if fixed < kinetic {
                let what = format!("friction at rest, {fixed}, is below that of sliding, {kinetic}");
                return error("static_friction", &what, "the coefficient at rest is the larger one");
            }
        }
        let kinetic = self.number_value(&format!("{path}.friction"), &contact.friction)?;
        let fixed = match &contact.static_friction {
            Some(fixed) => self.number_value(&format!("{path}.static_friction"), fixed)?,
            None => kinetic,
        };
        Ok(Some(Friction::Coulomb { fixed, kinetic }))
    }

    /// A coefficient of restitution.
    pub(crate) fn restitution(&mut self, path: &str, number: &Number) -> Result<ValueId> {
        let path = format!("{path}.restitution");
        match number {
            Number::Literal(e) if !(0.0..=1.0).contains(e) => Err(CompileError::new(
                path,
                format!("a coefficient of restitution of {e}"),
                "it is between 0, plastic, and 1, elastic",
            )),
            number => self.number_value(&path, number),
        }
    }
}
