//! Energy and momentum of a state.

use super::contact_forces::compliant_potential;
use super::Workspace;
use crate::kinematics::{State, StateView};
use crate::mechanism::Part;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// Kinetic energy of a body, J.
pub fn kinetic<S: Scalar>(at: StateView<'_, S>, body: usize) -> S {
    let twist = at.k.twist[body];
    let v = twist.at(at.centre_arm(body));
    (at.n.mass[body] * v.dot(v) + at.n.inertia[body] * twist.w * twist.w).scale(0.5)
}

/// Potential energy of gravity (zero at the origin), and of conservative forces in place and contacts pressed, J.
pub fn potential<S: Scalar>(at: StateView<'_, S>) -> S {
    let (mut gravity, mut elastic) = (S::zero(), compliant_potential(at));
    for body in 1..at.m.bodies.len() {
        gravity += -at.n.mass[body] * at.n.gravity.dot(at.mass_centre(body));
    }
    for force in 0..at.m.forces.len() {
        elastic += force_potential(at, force);
    }
    gravity + elastic
}

/// Potential energy of a force, J; 0 where it has none or is not in place.
pub fn force_potential<S: Scalar>(at: StateView<'_, S>, force: usize) -> S {
    let potential = at.m.forces[force].potential.as_ref().filter(|_| at.mode.has(Part::Force(force)));
    potential.map_or(S::zero(), |potential| potential.eval(&State(at)))
}

/// Kinetic energy of all bodies, J.
pub fn kinetic_energy<S: Scalar>(at: StateView<'_, S>) -> S {
    (1..at.m.bodies.len()).fold(S::zero(), |sum, body| sum + kinetic(at, body))
}

/// Velocity of a body's mass centre.
fn centre_velocity<S: Scalar>(at: StateView<'_, S>, body: usize) -> Vec2<S> {
    at.k.twist[body].at(at.centre_arm(body))
}

/// Momentum of all bodies, kg·m/s.
pub fn whole_momentum<S: Scalar>(at: StateView<'_, S>) -> Vec2<S> {
    (1..at.m.bodies.len()).fold(Vec2::zero(), |sum, i| sum + centre_velocity(at, i) * at.n.mass[i])
}

/// Angular momentum of all bodies about a place, kg·m²/s.
pub fn angular_momentum<S: Scalar>(at: StateView<'_, S>, about: Vec2<S>) -> S {
    (1..at.m.bodies.len()).fold(S::zero(), |sum, i| {
        let orbital = (at.mass_centre(i) - about).cross(centre_velocity(at, i)) * at.n.mass[i];
        sum + (orbital + at.n.inertia[i] * at.k.twist[i].w)
    })
}

/// Mass centre of all bodies.
pub fn whole_mass_centre<S: Scalar>(at: StateView<'_, S>) -> Vec2<S> {
    let mass = at.n.mass[1..].iter().fold(S::zero(), |sum, &mass| sum + mass);
    let moment = (1..at.m.bodies.len()).fold(Vec2::zero(), |sum, i| sum + at.mass_centre(i) * at.n.mass[i]);
    moment * (S::one() / mass)
}

impl Workspace<'_> {
    /// Place and velocity of a body's mass centre.
    pub fn centre(&self, body: usize) -> (Vec2, Vec2) {
        (self.at().mass_centre(body), centre_velocity(self.at(), body))
    }

    /// Kinetic energy of all bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        kinetic_energy(self.at())
    }

    /// Potential energy, J.
    pub fn potential_energy(&self) -> f64 {
        potential(self.at())
    }

    /// Potential energy of every force, J.
    pub fn force_potentials(&self) -> Vec<f64> {
        (0..self.m.forces.len()).map(|force| force_potential(self.at(), force)).collect()
    }

    /// The works, as [`Workspace::evaluate`] takes them, of a motion that starts from the present state.
    pub fn works_at_start(&self) -> Vec<f64> {
        let mut works = self.force_potentials();
        works.resize(self.m.forces.len() + self.m.drives.len() + 1, 0.0);
        works
    }

    /// Place of a site, fixed axes.
    pub fn site(&self, site: usize) -> Vec2 {
        self.at().site(site)
    }

    /// Acceleration of a body's mass centre in the last solution.
    pub fn centre_acceleration(&self, body: usize) -> Vec2 {
        let arm = self.at().centre_arm(body);
        self.solved.bodies[body].acceleration_at(arm, self.k.twist[body].w)
    }

    /// Frame origin and angle of a body: x, y in m and rad.
    pub fn frame(&self, body: usize) -> [f64; 3] {
        let pose = self.k.pose[body];
        let origin = self.m.sites.iter().position(|s| s.body == body).expect("every body has its origin as a site");
        let at = pose.place(self.n.arms[origin]);
        [at.x, at.y, pose.turn.angle]
    }
}
