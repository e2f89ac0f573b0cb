//! Unilateral constraints: gauges that cannot fall below zero. Contacts, stops and strings are made of them.

use super::{Cable, ContactPair, Mechanism, ValueId};
use crate::gauges::ModelExpr;
use crate::joints::LoadCard;

/// A gauge that cannot fall below zero.
#[derive(Clone, Debug)]
pub struct UnilateralConstraint {
    /// The gauge.
    pub gap: Gap,
    /// The contact, stop or string of the model to which it belongs.
    pub group: usize,
    /// Its two bodies, or all on which the gauge depends; ground left out.
    pub bodies: Vec<usize>,
    /// Restitution: speed of parting over speed of approach, 0 to 1.
    pub restitution: ValueId,
    /// Friction, where it can have friction.
    pub friction: Option<Friction>,
    /// Stiffness, N/m, and damping, N·s/m, where a spring and a damper stand for the unilateral constraint: it can be
    /// violated, against them.
    pub soft: Option<[ValueId; 2]>,
}

impl UnilateralConstraint {
    /// Whether a spring without a damper stands for it, so that all its work is in a potential.
    pub fn is_conservative(&self, m: &Mechanism) -> bool {
        self.soft.is_some_and(|[_, damping]| m.values[damping].literal() == Some(0.0))
    }
}

/// A contact, stop or string, as its user names it; a contact of polygons is many unilateral constraints.
#[derive(Clone, Debug)]
pub struct Group {
    /// Name.
    pub name: String,
    /// `contact`, `stop` or `string`.
    pub word: &'static str,
    /// First and second body of a contact.
    pub ends: [usize; 2],
    /// Its unilateral constraints.
    pub constraints: std::ops::Range<usize>,
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
        fixed: ValueId,
        /// Of sliding.
        kinetic: ValueId,
    },
}

/// Friction of what touches.
pub const FRICTION: LoadCard = LoadCard { tangent: true, ..LoadCard::force("friction", "T", "F") };

/// What a unilateral constraint measures.
#[derive(Clone, Debug)]
pub enum Gap {
    /// A gauge of the model.
    Gauge(ModelExpr),
    /// A disk, or a point, against a surface.
    ContactPair(ContactPair),
    /// What is slack of a string.
    Cable(Cable),
}

impl Gap {
    /// Whether it is an angle.
    pub fn turns(&self, m: &Mechanism) -> bool {
        matches!(self, Gap::Gauge(law) if m.turns(law))
    }

    /// The force that keeps the unilateral constraint.
    pub fn card(&self, m: &Mechanism) -> LoadCard {
        match self {
            Gap::ContactPair(_) => LoadCard::press("normal force", "N"),
            Gap::Cable(_) => LoadCard::tension(),
            Gap::Gauge(_) => LoadCard::force("force", "N", "F").along(self.turns(m)),
        }
    }
}
