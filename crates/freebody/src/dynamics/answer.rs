//! What an instant tells, as data.

use super::{ContactLoad, Freedom, Instant};
use crate::mode::Mode;
use serde_json::{json, Value};

impl Instant {
    /// The degrees of freedom, how they come about, and the ways in which parts can load each other, in words.
    pub fn rank(&self, f: &Freedom) -> Value {
        json!({
            "freedom": f.here, "count": f.count, "rows": f.rows, "redundant": f.redundant, "always_redundant": f.always_redundant,
            "driven": f.driven, "uncertain": f.uncertain, "explanation": f.explain(), "self_stress": self.self_stress,
        })
    }

    /// What every contact, stop and string does.
    pub fn contacts(&self) -> Value {
        let data = |l: &ContactLoad| {
            json!({
                "state": l.state, "gap": l.gap, "normal": l.along[0], "friction": l.along[1],
                "force": [l.force.x, l.force.y], "at": l.at.map(|p| [p.x, p.y]), "determinate": l.determinate,
            })
        };
        Value::Array(self.contacts.iter().map(data).collect())
    }
}

impl<'m> super::Workspace<'m> {
    /// The mechanism at a state in a mode; where none is given, with contacts, strings and friction as they are where
    /// nothing moved before.
    ///
    /// # Errors
    /// Arrays that are no state; as [`super::Workspace::initial_mode`].
    pub fn of_state(
        m: &'m crate::mechanism::Mechanism,
        p: &[f64],
        t: f64,
        [q, u]: [&[f64]; 2],
        mode: Option<&Mode>,
    ) -> Result<Self, super::DynamicsError> {
        m.check_state(p, t, q, u)?;
        let mut workspace = Self::in_mode(m, p, mode)?;
        workspace.move_to(t, q, u);
        if mode.is_none() {
            workspace.enter_initial_mode()?;
        }
        Ok(workspace)
    }

    /// Contacts, strings and friction as they are where nothing moved before.
    pub(super) fn enter_initial_mode(&mut self) -> Result<(), super::DynamicsError> {
        let mode = self.initial_mode()?;
        self.enter(&mode);
        Ok(())
    }

    /// The mechanism in a mode, not yet placed.
    ///
    /// # Errors
    /// A mode that is none of the mechanism.
    pub fn in_mode(
        m: &'m crate::mechanism::Mechanism,
        p: &[f64],
        mode: Option<&Mode>,
    ) -> Result<Self, super::DynamicsError> {
        let mut workspace = Self::new(m, p);
        match mode {
            Some(mode) if !mode.fits(m) => return Err(super::DynamicsError::ForeignHistory),
            Some(mode) => workspace.enter(mode),
            None => {}
        }
        Ok(workspace)
    }
}
