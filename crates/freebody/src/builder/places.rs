//! Sites and directions.

use super::{Builder, Result};
use crate::error::CompileError;
use crate::gauges::ModelExpr;
use crate::mechanism::{Marker, PointLocation, Site};
use crate::spec::Place;

impl Builder<'_> {
    pub(crate) fn site(&mut self, body: usize, at: PointLocation) -> usize {
        self.m.sites.push(Site { body, at });
        self.m.sites.len() - 1
    }

    /// A site with a direction, and that direction.
    pub(crate) fn place(&mut self, path: &str, place: &Place) -> Result<(Marker, ModelExpr)> {
        let site = self.names.site(&place.point).map_err(|m| CompileError::from(path, m))?;
        let direction = match (&place.angle, &place.towards) {
            (None, Some(other)) => {
                let other = self.names.site(other).map_err(|m| CompileError::from(path, m))?;
                self.towards(path, site, other)?
            }
            (Some(angle), None) => self.number(path, angle)?,
            (None, None) => ModelExpr::constant(0.0),
            _ => {
                return Err(CompileError::new(path, "a line has an angle or a second point, not both", "leave one out"))
            }
        };
        Ok((self.marker(site, direction.clone()), direction))
    }

    /// Direction, in their body's frame, from one site to another of the same body.
    pub(crate) fn towards(&mut self, path: &str, from: usize, to: usize) -> Result<ModelExpr> {
        let [dx, dy] = self.offset(path, from, to)?;
        Ok(dy.atan2(dx))
    }

    /// The vector, in their body's frame, from one site to another of the same body.
    pub(crate) fn offset(&mut self, path: &str, from: usize, to: usize) -> Result<[ModelExpr; 2]> {
        let (a, b) = (self.m.sites[from], self.m.sites[to]);
        if a.body != b.body {
            let names = [&self.m.bodies[a.body].name, &self.m.bodies[b.body].name];
            let what = format!("these two points are on different bodies, `{}` and `{}`", names[0], names[1]);
            return Err(CompileError::new(path, what, "a line is given by two points of one body"));
        }
        match (a.at, b.at) {
            (PointLocation::At(a), PointLocation::At(b)) => {
                let id = |s: usize| self.m.values[s].clone();
                Ok([id(b[0]) - id(a[0]), id(b[1]) - id(a[1])])
            }
            _ => Err(CompileError::new(
                path,
                "a line cannot be drawn through the mass centre by name",
                "give the point its coordinates",
            )),
        }
    }
}
