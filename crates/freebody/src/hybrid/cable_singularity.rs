//! Taut strings that are drawn in until two of their points meet: there they have no direction.

use super::HybridSystem;
use crate::cables::Straight;
use crate::dynamics::DynamicsError;
use crate::mechanism::Gap;
use crate::plane::Vec2;

/// Length of a segment, over the characteristic length, below which it has none.
const VANISHED: f64 = 1e-9;
/// The same, below which a motion that finds no step is at the end of its string.
const SHORT: f64 = 1e-3;

impl HybridSystem<'_> {
    /// The segments between points of unilateral constraint `l`, if it is a taut string.
    pub(super) fn taut_segments(&self, l: usize) -> Vec<Vec2> {
        let taut = if self.is_taut(l) { self.segments(l) } else { vec![] };
        taut.into_iter().filter(|segment| segment.joins_points).map(|segment| segment.along).collect()
    }

    fn is_taut(&self, l: usize) -> bool {
        self.workspace.mode().contacts[l].mode.carries()
    }

    fn segments(&self, l: usize) -> Vec<Straight> {
        let feature = self.workspace.mode().contacts[l].feature;
        match &self.workspace.m.unilateral[l].gap {
            Gap::Cable(cable) => cable.free_segments(self.workspace.m, &self.workspace.at(), feature),
            _ => vec![],
        }
    }

    /// Refuses strings that would go taut where two of their points meet.
    ///
    /// # Errors
    /// `string_zero_length`.
    pub(super) fn check_direction(&self, constraints: &[usize]) -> Result<(), DynamicsError> {
        let short = VANISHED * self.workspace.length;
        let lost = |&&l: &&usize| self.segments(l).iter().any(|each| each.joins_points && each.along.norm() < short);
        constraints.iter().find(lost).map_or(Ok(()), |&l| Err(self.zero_length_error(l)))
    }

    /// Remembers how all taut strings run at the state placed.
    pub(super) fn note_taut_segments(&mut self) {
        self.taut_segments = (0..self.workspace.m.unilateral.len()).map(|l| self.taut_segments(l)).collect();
    }

    /// Refuses a state, the one placed, in which a segment of a taut string has vanished since, has passed through its end, or
    /// is drawn in beyond the rim of its drum: steps then become shorter, up to where it does. A load that comes to the rim with
    /// the speed of the rim stays outside, and the string goes on in the other sense.
    ///
    /// # Errors
    /// `string_zero_length`.
    pub(super) fn check_taut_segments(&self) -> Result<(), DynamicsError> {
        let deep = VANISHED * self.workspace.length;
        if let Some(error) = self.wound_up(|segment| segment.within > deep) {
            return Err(error);
        }
        for (l, before) in self.taut_segments.iter().enumerate().filter(|(_, spans)| !spans.is_empty()) {
            let short = VANISHED * self.workspace.length;
            let lost = |(a, b): (&Vec2, Vec2)| b.norm() < short.min(a.norm()) || a.dot(b) < 0.0;
            if before.iter().zip(self.taut_segments(l)).any(lost) {
                return Err(self.zero_length_error(l));
            }
        }
        Ok(())
    }

    /// A taut string at the state placed that all but has no length beside its drum, to which its load comes with a speed of its
    /// own: its direction turns without bound.
    pub(super) fn wound_up_string(&self) -> Option<DynamicsError> {
        let short = SHORT * self.workspace.length;
        self.wound_up(|segment| !segment.joins_points && segment.along.norm() < short)
    }

    fn wound_up(&self, is_end: impl Fn(&Straight) -> bool) -> Option<DynamicsError> {
        let mut taut = (0..self.workspace.m.unilateral.len()).filter(|&l| self.is_taut(l));
        let l = taut.find(|&l| self.segments(l).iter().any(&is_end))?;
        let group = &self.workspace.m.groups[self.workspace.m.unilateral[l].group];
        Some(DynamicsError::StringWoundUp(group.name.clone(), group.path()))
    }

    pub(super) fn zero_length_error(&self, l: usize) -> DynamicsError {
        let group = &self.workspace.m.groups[self.workspace.m.unilateral[l].group];
        DynamicsError::StringZeroLength(group.name.clone(), group.path())
    }
}
