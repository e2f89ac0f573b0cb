//! Quantities that are known only when the instant is solved.

/// A quantity of a solved instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// A component of a joint's reaction on its second body.
    Reaction(usize, Axis),
    /// Force or torque of a coupling or prescribed motion.
    Drive(usize),
    /// Power of a prescribed motion.
    DrivePower(usize),
    /// Work of a prescribed motion since the start.
    DriveWork(usize),
    /// Value of a force law.
    Force(usize),
    /// A component of the friction of a plate, about the mass centre of its body.
    Plate(usize, Axis),
    /// Power of a force.
    ForcePower(usize),
    /// Work of a force since the start.
    ForceWork(usize),
    /// Kinetic energy of a body, or of all.
    Kinetic(Option<usize>),
    /// Potential energy of gravity and of all conservative forces.
    Potential,
    /// Momentum of all bodies along x or y.
    Momentum(Axis),
    /// Angular momentum of all bodies about the place where a site is now.
    AngularMomentum(usize),
    /// Mass centre of all bodies.
    Centre(Axis),
    /// Something of a contact, stop or string.
    Contact(usize, ContactQuantity),
    /// Friction of a joint along its coordinate.
    JointFriction(usize),
    /// Work of all friction since the start.
    FrictionWork,
}

/// Something of a contact, stop or string.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactQuantity {
    /// Its least gap; what is slack of a string.
    Gap,
    /// The force along the gap, all touches together: normal force, tension, force of a stop.
    Force,
    /// The friction force on the first body along the tangent, all touches together.
    Friction,
    /// A component of the force on the first body.
    OnFirst(Axis),
    /// A coordinate of the place where the resultant of the normal forces acts.
    Place(Axis),
    /// The speed of sliding of the first body; 0 where it does not touch.
    Slip,
}

impl ContactQuantity {
    /// What must be determinate for it: of the force on the first body along x and y, the normal force, the friction.
    pub fn needs(self) -> &'static [usize] {
        match self {
            ContactQuantity::Gap | ContactQuantity::Slip => &[],
            ContactQuantity::OnFirst(Axis::X) => &[0],
            ContactQuantity::OnFirst(Axis::Y) => &[1],
            ContactQuantity::OnFirst(_) => &[0, 1],
            ContactQuantity::Force | ContactQuantity::Place(_) => &[2],
            ContactQuantity::Friction => &[3],
        }
    }
}

/// A component of a vector or of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// The couple.
    Couple,
    /// The length of the vector.
    Size,
    /// Along the first marker.
    Along,
    /// Across the first marker, on its left.
    Across,
    /// The pull of a link: the force on the second point towards the first.
    Tension,
    /// The reaction along one row of the joint, in the order of its card: the force of one roller, of one tooth …
    Row(usize),
}
