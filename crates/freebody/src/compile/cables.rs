//! Strings.

use crate::builder::{Builder, Result};
use crate::error::CompileError;
use crate::mechanism::{Cable, End, Gap, Guide, UnilateralConstraint, ValueId};
use crate::spec::{self, Number};

impl Builder<'_> {
    pub(crate) fn cables(&mut self) -> Result<()> {
        for string in &self.spec.strings {
            self.cable(&format!("strings.{}", string.name), string)?;
        }
        Ok(())
    }

    fn cable(&mut self, path: &str, string: &spec::Cable) -> Result<()> {
        let [first, second] = &string.ends;
        let ends = [self.end(&format!("{path}.ends[0]"), first)?, self.end(&format!("{path}.ends[1]"), second)?];
        let mut over = vec![];
        for (i, guide) in string.over.iter().enumerate() {
            over.push(self.guide(&format!("{path}.over[{i}]"), guide)?);
        }
        let length = match &string.length {
            // One that is elastic may be tied to a spring that is relaxed when nothing of the string is out.
            Some(number) if string.stiffness.is_some() => {
                Some(self.within(&format!("{path}.length"), number, |x| x >= 0.0, "a length, 0 or more")?)
            }
            Some(number) => Some(self.positive_length(&format!("{path}.length"), number)?),
            None => None,
        };
        let restitution = format!("{path}.restitution");
        let restitution =
            self.within(&restitution, &string.restitution, |x| (0.0..=1.0).contains(&x), "a number from 0 to 1")?;
        let cable = Cable { ends, over, length };
        let bodies: Vec<usize> = cable.sites().map(|site| self.m.body_of(site)).collect();
        if bodies.iter().all(|body| *body == bodies[0]) {
            let what = format!("this string runs from `{0}` to `{0}`", self.m.bodies[bodies[0]].name);
            return Err(CompileError::new(path, what, "a string joins points of different bodies"));
        }
        let ends = [bodies[0], bodies[bodies.len() - 1]];
        let soft = self.soft(path, &string.stiffness, &string.damping)?;
        let (group, bodies) = (self.m.groups.len(), cable.bodies(&self.m));
        let constraint =
            UnilateralConstraint { gap: Gap::Cable(cable), group, bodies, restitution, friction: None, soft };
        self.group(path, &string.name, "string", ends, vec![constraint], string.engaged)?;
        Ok(())
    }

    fn end(&mut self, path: &str, end: &spec::CableEnd) -> Result<End> {
        let (centre, radius, sense, attached, wound) = match end {
            spec::CableEnd::Point(name) => return Ok(End::Tied(self.site_named(path, name)?)),
            spec::CableEnd::Drum { centre, radius, sense, attached, wound } => (centre, radius, sense, attached, wound),
        };
        let (centre, radius, sense) = self.wheel(path, centre, radius, *sense)?;
        let body = &self.m.bodies[self.m.body_of(centre)];
        if body.particle {
            let what = format!("`{}` is a particle, which has no rotation and cannot be a drum", body.name);
            return Err(CompileError::new(path, what, "make it a rigid body"));
        }
        let (attached, wound) = match (attached, wound) {
            (Some(angle), None) => (Some(self.number_value(&format!("{path}.attached"), angle)?), None),
            (None, Some(length)) => {
                (None, Some(self.within(&format!("{path}.wound"), length, |x| x >= 0.0, "a length, 0 or more")?))
            }
            (None, None) => {
                let what = "a drum needs the length that is wound at the start, or where the string is attached";
                return Err(CompileError::new(path, what, "give `wound` or `attached`"));
            }
            (Some(_), Some(_)) => {
                let what =
                    "of the length wound at the start and the place of the attachment, one follows from the other";
                return Err(CompileError::new(path, what, "leave out `wound` or `attached`"));
            }
        };
        Ok(End::Wound { centre, radius, sense, attached, wound })
    }

    fn guide(&mut self, path: &str, guide: &spec::Guide) -> Result<Guide> {
        Ok(match guide {
            spec::Guide::Eyelet(name) => Guide::Eyelet(self.site_named(path, name)?),
            spec::Guide::Pulley { centre, radius, sense } => {
                let (centre, radius, sense) = self.wheel(path, centre, radius, *sense)?;
                Guide::Pulley { centre, radius, sense }
            }
        })
    }

    /// Centre, radius and sense of a drum or a pulley.
    fn wheel(&mut self, path: &str, centre: &str, radius: &Number, sense: i8) -> Result<(usize, ValueId, f64)> {
        let centre = self.site_named(&format!("{path}.centre"), centre)?;
        let radius = self.positive_length(&format!("{path}.radius"), radius)?;
        if !matches!(sense, -1 | 1) {
            let what = format!("{sense} is no sense in which a string goes round");
            return Err(CompileError::new(format!("{path}.sense"), what, "write 1, counter-clockwise, or -1"));
        }
        Ok((centre, radius, f64::from(sense)))
    }

    fn site_named(&self, path: &str, name: &str) -> Result<usize> {
        self.names.site(name).map_err(|m| CompileError::from(path, m))
    }

    /// A number that, where it is written out, must be of a kind.
    fn positive_length(&mut self, path: &str, number: &Number) -> Result<ValueId> {
        let length = self.within(path, number, |x| x > 0.0, "a positive length")?;
        self.m.lengths.push(length);
        Ok(length)
    }

    fn within(&mut self, path: &str, number: &Number, fits: impl Fn(f64) -> bool, kind: &str) -> Result<ValueId> {
        match number {
            Number::Literal(x) if !fits(*x) => {
                Err(CompileError::new(path, format!("{x} stands where {kind} is needed"), format!("give {kind}")))
            }
            _ => self.number_value(path, number),
        }
    }
}
