//! Energy and momentum of a state.

use super::{load, Balance};
use crate::expr::Env;
use crate::gauges::Leaf;
use crate::kinematics::Config;
use crate::mechanism::Part;
use crate::plane::{vec2, Vec2};

impl Balance<'_> {
    /// From the pin of a body to its mass centre, fixed axes.
    fn centre_arm(&self, body: usize) -> Vec2 {
        self.k.pose[body].turn.apply(self.n.centre[body])
    }

    /// Place and velocity of a body's mass centre.
    pub fn centre(&self, body: usize) -> (Vec2, Vec2) {
        let arm = self.centre_arm(body);
        (self.k.pose[body].at + arm, self.k.twist[body].at(arm))
    }

    /// Acceleration of a body's mass centre in the last solution.
    pub fn centre_acceleration(&self, body: usize) -> Vec2 {
        let arm = self.centre_arm(body);
        let w = self.k.twist[body].w;
        self.solved.bodies[body].at(arm) - arm * (w * w)
    }

    /// Kinetic energy of a body, J.
    pub fn kinetic(&self, body: usize) -> f64 {
        let (v, w) = (self.centre(body).1, self.k.twist[body].w);
        0.5 * (self.n.mass[body] * v.dot(v) + self.n.inertia[body] * w * w)
    }

    /// Kinetic energy of all bodies, J.
    pub fn kinetic_energy(&self) -> f64 {
        (1..self.m.bodies.len()).map(|i| self.kinetic(i)).sum()
    }

    /// Potential energy of gravity (zero at the origin) and of the forces that have one, J.
    pub fn potential_energy(&self) -> f64 {
        let at = self.at();
        let weight = |i: usize| -self.n.mass[i] * self.n.gravity.dot(self.centre(i).0);
        let gravity: f64 = (1..self.m.bodies.len()).map(weight).sum();
        let env = Config { poses: &at, m: self.m, mode: &self.mode };
        let acting = self.m.forces.iter().enumerate().filter(|(f, _)| self.mode.has(Part::Force(*f)));
        let elastic = acting.filter_map(|(_, f)| f.potential.as_ref());
        gravity + elastic.map(|p| p.eval::<f64, dyn Env<f64, Leaf>>(&env)).sum::<f64>()
    }

    /// Power of each force, W.
    pub fn force_powers(&self) -> Vec<f64> {
        self.m.forces.iter().map(|f| load::force_power(self.at(), f)).collect()
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
