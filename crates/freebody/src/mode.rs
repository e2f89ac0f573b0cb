//! What is active now. A motion is a chain of modes; within one, every law is smooth.

use crate::mechanism::{Mechanism, Part};
use crate::motion::Spent;
use std::collections::HashMap;
use std::sync::Arc;

/// Which branches, parts and unilateral constraints are active.
#[derive(Clone, Debug, Default)]
pub struct Mode {
    branches: Vec<Option<bool>>,
    off: Vec<Part>,
    /// Zero of each row of which only the change counts, by joint and row; none before a motion starts.
    pub row_offsets: HashMap<(usize, usize), f64>,
    /// How each unilateral constraint is held; copies share it until one is changed.
    pub contacts: Arc<[ContactState]>,
    /// How each joint with friction is held: stuck, sliding, or open while nothing is decided.
    pub joint_friction: Vec<ContactMode>,
    /// The gear pairs whose teeth bear on the other flank than that of the model, by joint.
    other_flank: Vec<usize>,
    /// At rest by friction: nothing moves until the mode changes.
    pub resting: bool,
    /// Zeros that events have used up where a motion ended, for one that goes on from there.
    pub spent: Vec<Spent>,
}

impl PartialEq for Mode {
    /// One by one, as often as a state is placed: the bytes of a list that is empty have no address, and a processor
    /// takes its time to find that out.
    fn eq(&self, other: &Self) -> bool {
        fn same<T: PartialEq>(a: &[T], b: &[T]) -> bool {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b)
        }
        same(&self.branches, &other.branches)
            && same(&self.off, &other.off)
            && self.row_offsets == other.row_offsets
            && (Arc::ptr_eq(&self.contacts, &other.contacts) || same(&self.contacts, &other.contacts))
            && same(&self.joint_friction, &other.joint_friction)
            && same(&self.other_flank, &other.other_flank)
            && self.resting == other.resting
    }
}

/// How a unilateral constraint is held, and on which feature its gap is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactState {
    /// How.
    pub mode: ContactMode,
    /// The feature.
    pub feature: Feature,
}

/// The feature on which a gap is measured, and what was found when its motion started.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Feature {
    /// Which one: an edge, a corner, a way of being wound. What the number means is the gap's own.
    pub index: usize,
    /// Found at the start, for a string: where on its drum each end is attached, rad, and its length, m.
    pub phase: [f64; 3],
}

/// A function that is positive on its feature, with the feature that lies beyond its zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// Its value, in m.
    pub value: f64,
    /// The feature beyond.
    pub beyond: usize,
}

/// How a unilateral constraint is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ContactMode {
    /// Not there: released, or not yet engaged.
    Off,
    /// Its gap is open.
    #[default]
    Open,
    /// Its gap is violated, against its spring and damper.
    Compliant,
    /// Its gap is closed, but others carry the load.
    ClosedUnloaded,
    /// Its gap is closed and it does not have friction.
    Frictionless,
    /// Its gap is closed and it does not slide.
    Stick,
    /// Its gap is closed and others keep it from sliding: its friction is a given part of its normal force.
    PartialFriction(f64),
    /// Its gap is closed and it slides: the sign of the speed of sliding.
    Slip(f64),
}

impl ContactMode {
    /// Whether it carries load.
    pub fn carries(self) -> bool {
        matches!(
            self,
            ContactMode::Frictionless | ContactMode::Stick | ContactMode::PartialFriction(_) | ContactMode::Slip(_)
        )
    }
    /// Whether it is closed and does not slide, though it could.
    pub fn sticks(self) -> bool {
        matches!(self, ContactMode::Stick | ContactMode::PartialFriction(_))
    }
    /// Whether it is reached, closed or pressed.
    pub fn touches(self) -> bool {
        self == ContactMode::Compliant || self.is_closed()
    }
    /// Whether its gap is closed.
    pub fn is_closed(self) -> bool {
        self == ContactMode::ClosedUnloaded || self.carries()
    }
}

impl Mode {
    /// The mode before a motion: no switch frozen, every law read by its value, no unilateral constraint reached, and
    /// all parts in place but those that are engaged later.
    pub fn free(m: &Mechanism) -> Self {
        let held = |group: usize| ContactState {
            mode: if m.groups[group].engaged { ContactMode::Open } else { ContactMode::Off },
            feature: Feature::default(),
        };
        Mode {
            branches: vec![None; m.switches],
            off: m.initially_absent.clone(),
            row_offsets: HashMap::new(),
            contacts: m.unilateral.iter().map(|constraint| held(constraint.group)).collect(),
            joint_friction: vec![ContactMode::Open; m.joint_friction.len()],
            other_flank: vec![],
            resting: false,
            spent: vec![],
        }
    }
    /// Whether nothing touches, sticks or rests, and all parts are in place: then it moves as if nothing could happen to it, unless what
    /// is in place has come so.
    pub fn is_free(&self) -> bool {
        !self.resting
            && self.off.is_empty()
            && self.contacts.iter().all(|contact| !contact.mode.touches())
            && self.joint_friction.is_empty()
    }
    /// Whether it is a mode of this mechanism.
    pub fn fits(&self, m: &Mechanism) -> bool {
        self.branches.len() <= m.switches
            && self.contacts.len() == m.unilateral.len()
            && self.joint_friction.len() == m.joint_friction.len()
    }
    /// The branch at which a switch is frozen.
    pub fn branch(&self, discontinuity: usize) -> Option<bool> {
        self.branches.get(discontinuity).copied().flatten()
    }
    /// Freezes a switch at a branch.
    pub fn freeze(&mut self, discontinuity: usize, branch: bool) {
        self.branches[discontinuity] = Some(branch);
    }
    /// Whether the teeth of a gear pair bear on the other flank than that of the model.
    pub fn bears_on_other_flank(&self, joint: usize) -> bool {
        self.other_flank.contains(&joint)
    }
    /// Lets the teeth of a gear pair bear on the flank on which they do not.
    pub fn turn_flank(&mut self, joint: usize) {
        match self.other_flank.iter().position(|&j| j == joint) {
            Some(place) => drop(self.other_flank.swap_remove(place)),
            None => self.other_flank.push(joint),
        }
    }
    /// Whether a part is in place, contacts, stops and strings included.
    pub fn is_in_place(&self, m: &Mechanism, part: Part) -> bool {
        match part {
            Part::Group(g) => m.groups[g].constraints.clone().any(|l| self.contacts[l].mode != ContactMode::Off),
            _ => self.has(part),
        }
    }
    /// How each unilateral constraint is held, to be changed.
    pub fn contacts_mut(&mut self) -> &mut [ContactState] {
        Arc::make_mut(&mut self.contacts)
    }
    /// This mode with some unilateral constraints held in another way.
    pub fn with_contacts(&self, constraints: &[usize], held: ContactMode) -> Mode {
        let mut mode = self.clone();
        let contacts = mode.contacts_mut();
        constraints.iter().for_each(|&l| contacts[l].mode = held);
        mode
    }
    /// Whether a joint, a drive or a force is in place.
    pub fn has(&self, part: Part) -> bool {
        !self.off.contains(&part)
    }
    /// Takes a part away, or puts it in place; answers whether that changed anything.
    pub fn put(&mut self, part: Part, there: bool) -> bool {
        let changes = self.has(part) != there;
        match there {
            true => self.off.retain(|p| *p != part),
            false if changes => self.off.push(part),
            false => {}
        }
        changes
    }
}
