//! Taut strings that are drawn in until two of their points meet: there they have no direction.

use super::HybridSystem;
use crate::dynamics::DynamicsError;
use crate::mechanism::Gap;
use crate::plane::Vec2;

/// Length of a phase, over the characteristic length, below which it has none.
const VANISHED: f64 = 1e-9;

impl HybridSystem<'_> {
    /// The segments between points of unilateral constraint `l`, if it is a taut string. Where one at a drum comes to no length, as
    /// its load comes to the rim, the string may go on in the other sense.
    pub(super) fn taut_segments(&self, l: usize) -> Vec<Vec2> {
        let carries = self.workspace.mode().contacts[l].mode.carries();
        self.segments(l).into_iter().filter(|(_, points)| carries && *points).map(|(segment, _)| segment).collect()
    }

    /// Those of a string, and whether each joins two points.
    fn segments(&self, l: usize) -> Vec<(Vec2, bool)> {
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
        let lost = |&&l: &&usize| self.segments(l).iter().any(|(segment, points)| *points && segment.norm() < short);
        constraints.iter().find(lost).map_or(Ok(()), |&l| Err(self.zero_length_error(l)))
    }

    /// Remembers how all taut strings run at the state placed.
    pub(super) fn note_taut_segments(&mut self) {
        self.taut_segments = (0..self.workspace.m.unilateral.len()).map(|l| self.taut_segments(l)).collect();
    }

    /// Refuses a state, the one placed, in which a segment of a taut string has vanished since, or has passed through
    /// its end: steps then become shorter, up to where it does.
    ///
    /// # Errors
    /// `string_zero_length`.
    pub(super) fn check_taut_segments(&self) -> Result<(), DynamicsError> {
        for (l, before) in self.taut_segments.iter().enumerate().filter(|(_, spans)| !spans.is_empty()) {
            let short = VANISHED * self.workspace.length;
            let lost = |(a, b): (&Vec2, Vec2)| b.norm() < short.min(a.norm()) || a.dot(b) < 0.0;
            if before.iter().zip(self.taut_segments(l)).any(lost) {
                return Err(self.zero_length_error(l));
            }
        }
        Ok(())
    }

    pub(super) fn zero_length_error(&self, l: usize) -> DynamicsError {
        let group = &self.workspace.m.groups[self.workspace.m.unilateral[l].group];
        DynamicsError::StringZeroLength(group.name.clone(), group.path())
    }
}
