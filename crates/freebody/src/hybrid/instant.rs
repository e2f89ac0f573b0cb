//! What one instant is about: what hangs together with it; all else goes on as it does.

use super::HybridSystem;
use crate::dynamics::DynamicsError;
use crate::mechanism::Mechanism;
use crate::mode::{ContactMode, Mode};

/// Part of the speed at which something came to rest below which it may do so again: what jams beside it sets it off ever more slowly.
const SLOWER: f64 = 0.5;

/// What takes part in the contacts of one instant.
pub(super) struct Instant {
    /// What collided.
    pub impacting: Vec<usize>,
    /// What came to rest in this instant.
    pub ended: Vec<Ended>,
    /// The bodies that are concerned.
    bodies: Vec<bool>,
}

/// What came to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ended {
    pub constraint: usize,
    /// How it is held.
    pub held: ContactMode,
    /// How fast it was, m/s.
    pub speed: f64,
}

impl Instant {
    /// Of the bodies of one unilateral constraint, or of all.
    pub fn about(constraint: Option<usize>, m: &Mechanism) -> Self {
        // What a drive holds, and the friction of joints, is decided as a whole.
        let one = constraint.filter(|_| m.drives.is_empty() && m.joint_friction.is_empty());
        let mut bodies = vec![one.is_none(); m.bodies.len()];
        one.map_or(&[][..], |l| &m.unilateral[l].bodies).iter().for_each(|&body| bodies[body] = true);
        Instant { impacting: vec![], ended: vec![], bodies }
    }

    /// Adds the bodies that hang together with one that is concerned, by joints and by what touches: what else they stand on, ground,
    /// passes nothing on.
    pub fn grow(&mut self, m: &Mechanism, touching: &[usize]) {
        let tree = m.bodies.iter().enumerate().filter_map(|(body, b)| Some(vec![body, b.tree_joint?.parent]));
        let loops = m.closures.iter().map(|&joint| m.ends(&m.joints[joint]).to_vec());
        let touches = touching.iter().map(|&l| m.unilateral[l].bodies.clone());
        let mut links: Vec<Vec<usize>> = tree.chain(loops).chain(touches).collect();
        links.iter_mut().for_each(|link| link.retain(|&body| body > 0));
        while let Some(link) = links.iter().position(|link| self.is_part(link) && !self.holds(link)) {
            links[link].iter().for_each(|&body| self.bodies[body] = true);
        }
    }

    /// Whether a unilateral constraint acts on what is concerned.
    pub fn concerns(&self, m: &Mechanism, constraint: usize) -> bool {
        self.is_part(&m.unilateral[constraint].bodies)
    }

    /// The coordinates of what is concerned.
    pub fn coordinates(&self, m: &Mechanism) -> Vec<usize> {
        let own = m.bodies.iter().zip(&self.bodies).filter(|(_, &own)| own).filter_map(|(body, _)| body.tree_joint);
        own.flat_map(|joint| joint.start..joint.start + joint.freedom).collect()
    }

    pub fn has_ended(&self, constraint: usize) -> bool {
        self.ended.iter().any(|ended| ended.constraint == constraint)
    }

    /// Whether a unilateral constraint at a speed may come to rest: once, and again as long as it is ever slower.
    pub fn may_end(&self, constraint: usize, speed: f64) -> bool {
        self.ended.iter().all(|ended| ended.constraint != constraint || speed <= SLOWER * ended.speed)
    }

    fn is_part(&self, bodies: &[usize]) -> bool {
        bodies.iter().any(|&body| self.bodies[body])
    }

    fn holds(&self, bodies: &[usize]) -> bool {
        bodies.iter().all(|&body| self.bodies[body])
    }
}

impl HybridSystem<'_> {
    /// Of what touches that which hangs together with what is concerned, in a mode in which all else that touches stands aside.
    pub(super) fn concerned(&mut self, instant: &mut Instant, touching: Vec<usize>) -> Vec<usize> {
        let m = self.workspace.m;
        let held = (0..m.unilateral.len()).filter(|&l| self.mode.contacts[l].mode.is_closed());
        instant.grow(m, &touching.iter().copied().chain(held).collect::<Vec<_>>());
        let (concerned, aside): (Vec<usize>, Vec<usize>) = touching.into_iter().partition(|&l| instant.concerns(m, l));
        if !aside.is_empty() {
            self.workspace.enter(&self.workspace.mode().with_contacts(&aside, ContactMode::Open));
        }
        concerned
    }

    /// The mode with what stood aside as it was; where nothing at all can move it rests.
    pub(super) fn rejoin(
        &mut self,
        mut mode: Mode,
        t: f64,
        y: &[f64],
        instant: &Instant,
    ) -> Result<Mode, DynamicsError> {
        let (m, n) = (self.workspace.m, self.workspace.m.freedom());
        for l in (0..m.unilateral.len()).filter(|&l| self.mode.contacts[l].mode.is_closed() && !instant.concerns(m, l))
        {
            mode.contacts_mut()[l] = self.mode.contacts[l];
        }
        let is_held = mode.contacts.iter().any(|contact| contact.mode.carries()) || !m.joint_friction.is_empty();
        if is_held && y[n..2 * n].iter().all(|&u| u == 0.0) {
            self.place_in(&mode, t, y);
            self.workspace.solve()?;
            mode.resting = self.workspace.dof() == 0;
        }
        Ok(mode)
    }
}
