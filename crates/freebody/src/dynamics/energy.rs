//! Energy and momentum of a state.

use super::Workspace;
use crate::kinematics::{State, StateView};
use crate::plane::{vec2, Vec2};
use crate::scalar::Scalar;

/// Kinetic energy of a body, J.
pub fn kinetic<S: Scalar>(at: StateView<'_, S>, body: usize) -> S {
    let twist = at.k.twist[body];
    let v = twist.at(at.centre_arm(body));
    (at.n.mass[body] * v.dot(v) + at.n.inertia[body] * twist.w * twist.w).scale(0.5)
}

/// Potential energy of gravity (zero at the origin) and of the conservative forces in place, J.
pub fn potential<S: Scalar>(at: StateView<'_, S>) -> S {
    let (mut gravity, mut elastic) = (S::zero(), S::zero());
    for body in 1..at.m.bodies.len() {
        gravity += -at.n.mass[body] * at.n.gravity.dot(at.mass_centre(body));
    }
    for potential in at.forces().filter_map(|(_, force)| force.potential.as_ref()) {
        elastic += potential.eval(&State(at));
    }
    gravity + elastic
}

impl Workspace<'_> {
    /// Place and velocity of a body's mass centre.
    pub fn centre(&self, body: usize) -> (Vec2, Vec2) {
        let arm = self.at().centre_arm(body);
        (self.k.pose[body].at + arm, self.k.twist[body].at(arm))
    }

    /// Acceleration of a body's mass centre in the last solution.
    pub fn centre_acceleration(&self, body: usize) -> Vec2 {
        let arm = self.at().centre_arm(body);
        self.solved.bodies[body].acceleration_at(arm, self.k.twist[body].w)
    }

    /// Kinetic energy of all bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        (1..self.m.bodies.len()).map(|body| kinetic(self.at(), body)).sum()
    }

    /// Potential energy, J.
    pub fn potential_energy(&self) -> f64 {
        potential(self.at())
    }

    /// Momentum of all bodies, kg·m/s.
    pub fn momentum(&self) -> Vec2 {
        (1..self.m.bodies.len()).fold(vec2(0.0, 0.0), |sum, i| sum + self.centre(i).1 * self.n.mass[i])
    }

    /// Angular momentum of all bodies about a place, kg·m²/s.
    pub fn angular_momentum(&self, about: Vec2) -> f64 {
        (1..self.m.bodies.len())
            .map(|i| {
                let (at, v) = self.centre(i);
                (at - about).cross(v) * self.n.mass[i] + self.n.inertia[i] * self.k.twist[i].w
            })
            .sum()
    }

    /// Mass centre of all bodies.
    pub fn mass_centre(&self) -> Vec2 {
        let mass: f64 = self.n.mass[1..].iter().sum();
        let moment = (1..self.m.bodies.len()).fold(vec2(0.0, 0.0), |sum, i| sum + self.centre(i).0 * self.n.mass[i]);
        moment * (1.0 / mass)
    }

    /// Place of a site, fixed axes.
    pub fn site(&self, site: usize) -> Vec2 {
        self.k.pose[self.m.body_of(site)].place(self.n.arms[site])
    }

    /// Frame origin and angle of a body: x, y in m and rad.
    pub fn frame(&self, body: usize) -> [f64; 3] {
        let pose = self.k.pose[body];
        let origin = self.m.sites.iter().position(|s| s.body == body).expect("every body has its origin as a site");
        let at = pose.place(self.n.arms[origin]);
        [at.x, at.y, pose.turn.angle]
    }
}
