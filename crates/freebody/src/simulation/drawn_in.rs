//! Taut strings that are drawn in until two of their points meet: there they have no direction.

use super::Machine;
use crate::balance::Trouble;
use crate::mechanism::Gap;
use crate::plane::Vec2;

/// Length of a stretch, over the characteristic length, below which it has none.
const VANISHED: f64 = 1e-9;

impl Machine<'_> {
    /// The stretches of limit `l` between points, if it is a taut string.
    fn taut_spans(&self, l: usize) -> Vec<Vec2> {
        let (limit, held) = (&self.balance.m.limits[l], self.balance.mode.limits[l]);
        match &limit.gap {
            Gap::Cord(cord) if held.hold.carries() => cord.spans(self.balance.m, &self.balance.at(), held.piece),
            _ => vec![],
        }
    }

    /// Remembers how all taut strings run at the state placed.
    pub(super) fn note_spans(&mut self) {
        self.spans = (0..self.balance.m.limits.len()).map(|l| self.taut_spans(l)).collect();
    }

    /// Refuses a state, the one placed, in which a stretch of a taut string has vanished since, or has passed through its end:
    /// steps then become shorter, up to where it does.
    ///
    /// # Errors
    /// `string_drawn_in`.
    pub(super) fn check_spans(&self) -> Result<(), Trouble> {
        for (l, before) in self.spans.iter().enumerate().filter(|(_, spans)| !spans.is_empty()) {
            let short = VANISHED * self.balance.length;
            let lost = |(a, b): (&Vec2, Vec2)| b.norm() < short || a.dot(b) < 0.0;
            if before.iter().zip(self.taut_spans(l)).any(lost) {
                return Err(self.drawn_in(l));
            }
        }
        Ok(())
    }

    fn drawn_in(&self, l: usize) -> Trouble {
        let group = &self.balance.m.groups[self.balance.m.limits[l].group];
        let what = format!(
            "the taut string `{}` is drawn in until two of its points meet and it has no direction",
            group.name
        );
        let why = "a little to one side it would swing round at once, straight through it would jerk";
        Trouble::new("string_drawn_in", format!("{what}: {why}; let it pass beside, or put a stop before"))
            .about(group.path())
    }
}
