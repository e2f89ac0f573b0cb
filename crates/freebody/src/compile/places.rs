//! Points, lines and curves.

use crate::builder::{unknown, Builder, Names, Reach, Result};
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::mechanism::{Curve, PointLocation};

impl Builder<'_> {
    /// All named points, and the origin and mass centre of every body.
    pub(crate) fn points(&mut self) -> Result<()> {
        let zero = self.value(ModelExpr::constant(0.0));
        for body in 0..self.m.bodies.len() {
            let name = self.m.bodies[body].name.clone();
            let origin = self.site(body, PointLocation::At([zero, zero]));
            self.m.bodies[body].joint_origin = origin;
            self.name_site(format!("{name}.origin"), origin);
            if body == 0 {
                self.name_site("ground.O".to_string(), origin);
            } else {
                let centre = self.site(body, PointLocation::MassCentre);
                self.name_site(format!("{name}.G"), centre);
            }
        }
        for point in &self.spec.points {
            let path = format!("points.{}", point.name);
            let known = self.names.bodies.keys();
            let missing = || CompileError::from(&path, unknown("body", &point.body, known));
            let body = *self.names.bodies.get(&point.body).ok_or_else(missing)?;
            let [x, y] = &point.at;
            let at = PointLocation::At([self.number_value(&path, x)?, self.number_value(&path, y)?]);
            let site = self.site(body, at);
            self.name_site(point.name.clone(), site);
        }
        Ok(())
    }

    /// A name of the model takes the place of one that every body has.
    fn name_site(&mut self, name: String, site: usize) {
        if self.names.sites.insert(name.clone(), site).is_some() {
            self.m.points.retain(|(known, _)| *known != name);
        }
        self.m.points.push((name, site));
    }

    pub(crate) fn lines(&mut self) -> Result<()> {
        for line in &self.spec.lines {
            let path = format!("lines.{}", line.name);
            let (marker, direction) = self.place(&path, &line.line)?;
            let body = self.m.body_of(marker.site);
            self.names.lines.insert(line.name.clone(), (marker, body, direction));
            self.m.lines.push((line.name.clone(), marker));
        }
        Ok(())
    }

    pub(crate) fn curves(&mut self) -> Result<()> {
        for (i, curve) in self.spec.curves.iter().enumerate() {
            let path = format!("curves.{}", curve.name);
            let known = self.names.bodies.keys();
            let missing = || CompileError::from(&path, unknown("body", &curve.body, known));
            let body = *self.names.bodies.get(&curve.body).ok_or_else(missing)?;
            let (x, y) = (self.law(&path, &curve.x, Reach::Curve)?, self.law(&path, &curve.y, Reach::Curve)?);
            self.m.curves.push(Curve { name: curve.name.clone(), body, x, y });
            self.names.curves.insert(curve.name.clone(), i);
        }
        Ok(())
    }

    /// Named gauges, in any order.
    pub(crate) fn gauges(&mut self) -> Result<()> {
        let mut left: Vec<_> = self.spec.gauges.iter().collect();
        while !left.is_empty() {
            let before = left.len();
            let mut error = None;
            let mut later = vec![];
            for gauge in left {
                let read = self.scope(Reach::Configuration).law(&gauge.value);
                match read {
                    Ok(law) => {
                        self.names.gauges.insert(gauge.name.clone(), law.clone());
                        self.m.gauges.push((gauge.name.clone(), law));
                    }
                    Err(e) => {
                        error.get_or_insert(Names::error(&format!("gauges.{}", gauge.name), &gauge.value, e));
                        later.push(gauge);
                    }
                }
            }
            if later.len() == before {
                return Err(error.expect("a gauge is left because it could not be read"));
            }
            left = later;
        }
        Ok(())
    }
}
