//! The fields of one joint or force, read as what its card says they are.

use super::{unknown, Builder, Reach, Result};
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::joints::Card;
use crate::mechanism::PlateOutline;
use crate::spec::{Element, Number, Value};

/// The fields of one element.
pub struct Fields<'a, 's> {
    pub(crate) c: &'a mut Builder<'s>,
    pub(crate) element: &'a Element,
    pub(crate) card: &'a Card,
    pub(crate) path: String,
}

impl<'a, 's> Fields<'a, 's> {
    /// An error about a field.
    pub fn error(&self, field: &str, what: impl Into<String>, hint: impl Into<String>) -> CompileError {
        CompileError::new(format!("{}.{field}", self.path), what, hint)
    }

    /// Whether the model gives the field.
    pub fn given(&self, field: &str) -> bool {
        self.element.fields.contains_key(field)
    }

    /// Refuses fields that the card does not have.
    pub fn check(&self) -> Result<()> {
        let known: Vec<String> = self.card.fields.iter().map(|f| f.name.to_string()).collect();
        match self.element.fields.keys().find(|k| !known.contains(k)) {
            Some(field) => {
                let what = format!("field of a {}", self.card.word);
                Err(CompileError::from(format!("{}.{field}", self.path), unknown(&what, field, known.iter())))
            }
            None => Ok(()),
        }
    }

    fn value(&self, field: &str) -> Result<Value> {
        if let Some(value) = self.element.fields.get(field) {
            return Ok(value.clone());
        }
        let card = self.card.fields.iter().find(|f| f.name == field);
        match card.and_then(|f| f.default) {
            Some("") | None => {
                let doc = card.map_or("", |f| f.doc);
                Err(self.error(field, format!("a {} needs its `{field}`", self.card.word), doc))
            }
            Some("true") => Ok(Value::Flag(true)),
            Some("false") => Ok(Value::Flag(false)),
            Some(text) => Ok(Value::Number(Number::Expression(text.to_string()))),
        }
    }

    fn number_of(&mut self, field: &str, value: &Value) -> Result<ModelExpr> {
        let path = format!("{}.{field}", self.path);
        match value {
            Value::Flag(flag) => Ok(ModelExpr::constant(if *flag { 1.0 } else { 0.0 })),
            Value::Number(number) => self.c.number(&path, number),
            _ => Err(CompileError::new(path, "a number is needed here", "")),
        }
    }

    /// A number of the model.
    pub fn number(&mut self, field: &str) -> Result<ModelExpr> {
        let value = self.value(field)?;
        self.number_of(field, &value)
    }

    /// Two numbers.
    pub fn numbers(&mut self, field: &str) -> Result<Vec<ModelExpr>> {
        match self.value(field)? {
            Value::List(values) if values.len() == 2 => values.iter().map(|v| self.number_of(field, v)).collect(),
            _ => Err(self.error(field, "two numbers are needed here", "write `[a, b]`")),
        }
    }

    fn expression(&mut self, field: &str, reach: Reach) -> Result<ModelExpr> {
        let path = format!("{}.{field}", self.path);
        match self.value(field)? {
            Value::Number(Number::Literal(x)) => self.c.number(&path, &Number::Literal(x)),
            Value::Number(Number::Expression(text)) => self.c.law(&path, &text, reach),
            _ => Err(CompileError::new(path, "an expression is needed here", "")),
        }
    }

    /// An expression of time and state.
    pub fn law(&mut self, field: &str) -> Result<ModelExpr> {
        self.expression(field, Reach::Motion)
    }

    /// An expression of the configuration.
    pub fn gauge(&mut self, field: &str) -> Result<ModelExpr> {
        self.expression(field, Reach::Configuration)
    }

    fn name(&self, field: &str, value: &Value) -> Result<String> {
        let needed = || self.error(field, "a name is needed here", "a point is written `body.point`");
        value.text().map(str::to_string).ok_or_else(needed)
    }

    fn site_of(&self, field: &str, value: &Value) -> Result<usize> {
        let name = self.name(field, value)?;
        self.c.names.site(&name).map_err(|m| CompileError::from(format!("{}.{field}", self.path), m))
    }

    /// A point.
    pub fn site(&mut self, field: &str) -> Result<usize> {
        let value = self.value(field)?;
        self.site_of(field, &value)
    }

    /// One point or more.
    pub fn sites(&mut self, field: &str) -> Result<Vec<usize>> {
        match self.value(field)? {
            Value::List(points) if !points.is_empty() => {
                points.iter().map(|point| self.site_of(field, point)).collect()
            }
            _ => Err(self.error(field, "points are needed here", "write `[body.P, body.Q, …]`")),
        }
    }

    /// Two points.
    pub fn two_sites(&mut self, field: &str) -> Result<[usize; 2]> {
        match self.value(field)? {
            Value::List(points) if points.len() == 2 => {
                Ok([self.site_of(field, &points[0])?, self.site_of(field, &points[1])?])
            }
            _ => Err(self.error(field, "two points are needed here", "write `[body.P, body.Q]`")),
        }
    }

    /// A body.
    pub fn body(&mut self, field: &str) -> Result<usize> {
        let name = self.name(field, &self.value(field)?)?;
        let bodies = &self.c.names.bodies;
        let unknown = || CompileError::from(format!("{}.{field}", self.path), unknown("body", &name, bodies.keys()));
        bodies.get(&name).copied().ok_or_else(unknown)
    }

    /// A body that can take a couple.
    pub fn turning_body(&mut self, field: &str) -> Result<usize> {
        let body = self.body(field)?;
        match self.c.m.bodies[body].particle {
            true => Err(self.error(
                field,
                "a couple cannot act on a particle, which has no rotation",
                "make it a rigid body",
            )),
            false => Ok(body),
        }
    }

    /// A line: its site and direction.
    pub fn line(&mut self, field: &str) -> Result<crate::mechanism::Marker> {
        let path = format!("{}.{field}", self.path);
        match self.value(field)? {
            Value::Line(place) => Ok(self.c.place(&path, &place)?.0),
            _ => Err(CompileError::new(
                path,
                "a line is needed here",
                "write `body.line`, `[P, Q]` or `{through: P, angle: a}`",
            )),
        }
    }

    /// A circle: its centre and radius.
    pub fn circle(&mut self, field: &str) -> Result<(usize, ModelExpr)> {
        let path = format!("{}.{field}", self.path);
        match self.value(field)? {
            Value::Circle { centre, radius } => {
                let site = self.c.names.site(&centre).map_err(|m| CompileError::from(&path, m))?;
                Ok((site, self.c.number(&path, &radius)?))
            }
            _ => Err(CompileError::new(path, "a circle is needed here", "write `{centre: P, radius: r}`")),
        }
    }

    /// An area of a body that moves: what bounds it, and the body.
    pub fn area(&mut self, field: &str) -> Result<(PlateOutline, usize)> {
        let (outline, site) = match self.value(field)? {
            Value::Circle { .. } => {
                let (centre, radius) = self.circle(field)?;
                (PlateOutline::Disk(centre, radius), centre)
            }
            Value::List(corners) if corners.len() > 2 => {
                let sites = self.sites(field)?;
                let first = sites[0];
                (PlateOutline::Polygon(sites), first)
            }
            _ => {
                let hint = "name a disk, rectangle or polygon, or write `{centre: P, radius: r}` or `[P, Q, R]`";
                return Err(self.error(field, "an area is needed here", hint));
            }
        };
        match self.c.m.body_of(site) {
            0 => Err(self.error(field, "the ground does not slide on a table", "take an area of a body")),
            body => Ok((outline, body)),
        }
    }

    /// On or off.
    pub fn flag(&self, field: &str) -> Result<bool> {
        match self.value(field)? {
            Value::Flag(flag) => Ok(flag),
            _ => Err(self.error(field, "`true` or `false` is needed here", "")),
        }
    }

    /// A named curve.
    pub fn curve(&mut self, field: &str) -> Result<usize> {
        let name = self.name(field, &self.value(field)?)?;
        let curves = &self.c.names.curves;
        let unknown = || CompileError::from(format!("{}.{field}", self.path), unknown("curve", &name, curves.keys()));
        curves.get(&name).copied().ok_or_else(unknown)
    }

    /// One of some words.
    pub fn word(&mut self, field: &str, words: &[&str]) -> Result<String> {
        let name = self.name(field, &self.value(field)?)?;
        if words.contains(&name.as_str()) {
            return Ok(name);
        }
        Err(self.error(field, format!("`{name}` is none of {}", words.join(", ")), ""))
    }
}
