//! Limits: gauges that cannot fall below zero. Contacts, stops and strings are made of them.

use super::{Cord, Mechanism, Slot, Touch};
use crate::gauges::Law;
use crate::joints::LoadCard;

/// A gauge that cannot fall below zero.
#[derive(Clone, Debug)]
pub struct Limit {
    /// The gauge.
    pub gap: Gap,
    /// The contact, stop or string of the model to which it belongs.
    pub group: usize,
    /// Its two bodies, or all on which the gauge depends; ground left out.
    pub bodies: Vec<usize>,
    /// Restitution: speed of parting over speed of approach, 0 to 1.
    pub restitution: Slot,
    /// Friction, where it can rub.
    pub friction: Option<Friction>,
    /// Stiffness, N/m, and damping, N·s/m, where a spring and a damper stand for the limit: it can be violated, against them.
    pub soft: Option<[Slot; 2]>,
}

/// A contact, stop or string, as its user names it; a contact of polygons is many limits.
#[derive(Clone, Debug)]
pub struct Group {
    /// Name.
    pub name: String,
    /// `contact`, `stop` or `string`.
    pub word: &'static str,
    /// First and second body of a contact.
    pub ends: [usize; 2],
    /// Its limits.
    pub limits: std::ops::Range<usize>,
    /// Whether it is there from the start.
    pub engaged: bool,
}

impl Group {
    /// Where it stands in the model.
    pub fn path(&self) -> String {
        format!("{}s.{}", self.word, self.name)
    }
}

/// Coulomb friction of a contact.
#[derive(Clone, Copy, Debug)]
pub enum Friction {
    /// It never slides while it is closed.
    Rough,
    /// Coefficients of rest and of sliding.
    Coulomb {
        /// Of rest; not below that of sliding.
        fixed: Slot,
        /// Of sliding.
        kinetic: Slot,
    },
}

/// Friction of what touches.
pub const FRICTION: LoadCard = LoadCard { tangent: true, ..LoadCard::force("friction", "T", "F") };

/// What a limit measures.
#[derive(Clone, Debug)]
pub enum Gap {
    /// A gauge of the model.
    Gauge(Law),
    /// A disk, or a point, against a surface.
    Touch(Touch),
    /// What is slack of a string.
    Cord(Cord),
}

impl Gap {
    /// The force that keeps the limit.
    pub fn card(&self, m: &Mechanism) -> LoadCard {
        match self {
            Gap::Touch(_) => LoadCard::press("normal force", "N"),
            Gap::Cord(_) => LoadCard::tension(),
            Gap::Gauge(law) => LoadCard::force("force", "N", "F").along(m.turns(law)),
        }
    }
}
