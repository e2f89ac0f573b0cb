//! Tracks of lines and arcs as surfaces.

use crate::builder::{Builder, Result};
use crate::error::CompileError;
use crate::mechanism::{ContactPair, Profile, Stretch, Track};
use crate::plane::Vec2;
use crate::scalar::real;
use crate::spec;

/// Sine of the turn between two stretches up to which there is no discontinuity; difference of the radii at the two
/// ends of an arc, over the first, up to which they are one.
const SMOOTH: f64 = 1e-9;

impl Builder<'_> {
    /// A track on one body, which goes on smoothly from stretch to stretch at the parameters' own values.
    pub(super) fn track(&self, path: &str, start: &str, stretches: &[spec::Stretch], arms: &[Vec2]) -> Result<Track> {
        let site = |name: &str| self.names.site(name).map_err(|m| CompileError::from(path, m));
        let (mut from, mut made): (usize, Vec<Stretch>) = (site(start)?, vec![]);
        for (i, stretch) in stretches.iter().enumerate() {
            let to = site(&stretch.to)?;
            let centre = stretch.centre.as_deref().map(site).transpose()?;
            if [Some(to), centre].into_iter().flatten().any(|site| self.m.body_of(site) != self.m.body_of(from)) {
                return Err(CompileError::new(path, "a track lies on one body", "take points of one body"));
            }
            let next = Stretch { ends: [from, to], centre };
            if let Some((what, hint)) = fault(&next, made.last(), arms) {
                return Err(CompileError::new(path, format!("stretch {} of the track {what}", i + 1), hint));
            }
            made.push(next);
            from = to;
        }
        if made.is_empty() {
            return Err(CompileError::new(path, "a track needs a line or an arc", "give it a stretch"));
        }
        Ok(Track { stretches: made })
    }

    /// Whether disks fit into all arcs of a track in which they lie, at the parameters' own values.
    pub(super) fn fits(&self, path: &str, touch: &ContactPair) -> Result<()> {
        let (Profile::Track(track), Some(radius)) = (&touch.against, touch.disk.radius) else { return Ok(()) };
        let n = self.m.bind(&self.m.parameters_with(&[]));
        let arm = |site: usize| n.arms[site];
        let too_narrow = |stretch: &Stretch| stretch.hollow(&arm).is_some_and(|wide| wide <= n.values[radius]);
        let Some(narrow) = track.stretches.iter().position(too_narrow) else { return Ok(()) };
        let what = format!("the circle does not fit into the arc that is stretch {} of the track", narrow + 1);
        Err(CompileError::new(path, what, "make the circle smaller than the arc"))
    }
}

/// What is wrong with a stretch after the one before, and what to try.
fn fault(stretch: &Stretch, before: Option<&Stretch>, arms: &[Vec2]) -> Option<(String, &'static str)> {
    let [from, to] = stretch.ends.map(|site| arms[site]);
    if from == to {
        return Some(("has no length".into(), "leave it out"));
    }
    if let Some(centre) = stretch.centre.map(|site| arms[site]) {
        let [first, last] = [(from - centre).norm(), (to - centre).norm()];
        if (first - last).abs() > SMOOTH * first {
            let what = format!("starts {first} m from its centre and ends {last} m from it");
            return Some((what, "let both ends be as far from the centre"));
        }
        if (from - centre).cross(to - centre).abs() <= SMOOTH * first * first {
            let what = "goes round by half a turn: either way is as short".into();
            return Some((what, "make two arcs of it"));
        }
    }
    let arm = |site: usize| arms[site];
    let [end, begin] = [before?.heading(&arm, 1), stretch.heading(&arm, 0)];
    let turn = real::atan2(end.cross(begin), end.dot(begin));
    (turn.abs() > SMOOTH).then(|| {
        let what = format!("begins with a kink of {:.6}°", turn.to_degrees());
        (what, "let it go on along the tangent, or make two contacts of two tracks")
    })
}
