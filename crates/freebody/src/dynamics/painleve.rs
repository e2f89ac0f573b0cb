//! Where Coulomb's law and rigid bodies contradict each other (Painlevé), in words.

use super::{ClosedContacts, DynamicsError, Workspace};
use crate::contact::complementarity::{self, FrictionLaw, Verdict};
use crate::error::Paradox;

impl Workspace<'_> {
    /// Says by name that Coulomb's law and rigid bodies contradict each other here.
    pub(super) fn painleve_error(
        &self,
        contacts: &ClosedContacts,
        free: &[f64],
        friction: &[FrictionLaw],
        verdict: &Verdict,
    ) -> DynamicsError {
        let names = self.names_of(&contacts.constraints);
        let has_friction = friction.iter().any(|law| *law != FrictionLaw::Frictionless);
        let (laws, end, advice) = match has_friction {
            true => ("Coulomb's law and the balance equations", "the contact jams", "lower the friction"),
            false => ("the balance equations", "what is prescribed presses it together", "end a motion before"),
        };
        let mut text = match verdict {
            Verdict::Indeterminate(answers) => format!("at {names} {} different motions satisfy {laws}", answers.len()),
            Verdict::Unknown => format!("at {names} no motion was found that satisfies {laws}"),
            _ => format!("at {names} no motion satisfies {laws}: {end}"),
        };
        let sliding = (0..contacts.len()).find_map(|i| match friction[i] {
            FrictionLaw::Sliding { sense, kinetic } => Some((i, sense, kinetic)),
            _ => None,
        });
        if let Some((i, sense, kinetic)) = sliding {
            let p = complementarity::painleve(&contacts.g, free, i, sense, kinetic);
            text += &format!("; A = {:.4e} 1/kg, b = {:.4e} m/s²", p.leading, p.free);
            if let Some(critical) = p.critical {
                text += &format!(", and the paradox begins at a friction of {critical:.6}");
            }
        }
        text += &format!("; {advice}, or let a spring stand for the contact");
        let paradox = match verdict {
            Verdict::Indeterminate(_) => Paradox::Indeterminate,
            Verdict::Unknown => Paradox::Unsolved,
            _ => Paradox::Inconsistent,
        };
        let group = &self.m.groups[self.m.unilateral[contacts.constraints[sliding.map_or(0, |s| s.0)]].group];
        DynamicsError::Paradox(paradox, text, group.path())
    }
}
