//! The motion of a tree over any scalar, to be recorded.

use super::articulated_body::ArticulatedBody;
use super::loads::{centre_arms, loads, unaccounted_power};
use super::DynamicsError;
use crate::bound_values::BoundValues;
use crate::gauges::ModelExpr;
use crate::joints::Joint as _;
use crate::kinematics::{Kinematics, State, StateView};
use crate::mechanism::{Force, Joint, Mechanism};
use crate::mode::Mode;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// A tree in motion.
pub struct TreeMotion<'m, S> {
    /// The mechanism.
    pub m: &'m Mechanism,
    /// Its numbers.
    pub n: BoundValues<S>,
    mode: Mode,
    k: Kinematics<S>,
    arms: Vec<Vec2<S>>,
    loads: Vec<Wrench<S>>,
    sweep: ArticulatedBody<S>,
    nu_dot: Vec<S>,
    bodies: Vec<Twist<S>>,
}

impl<'m, S: Scalar> TreeMotion<'m, S> {
    /// Whether a mechanism is a tree whose motion is the same operations whatever its numbers, and nothing happens in it.
    pub fn fits(m: &Mechanism) -> bool {
        m.events.is_empty() && Self::obstacle(m).is_none()
    }

    /// Why the motion of a mechanism is not that of a tree by the same operations whatever its numbers, to follow "because".
    pub fn obstacle(m: &Mechanism) -> Option<&'static str> {
        let is_plain =
            |joint: &Joint| joint.curve.is_none() && !joint.coordinates.iter().any(|c| joint.kind.unsigned(c.card));
        let is_smooth = |force: &Force| force.plate.is_none() && force.laws().all(ModelExpr::is_uniform);
        let obstacles = [
            (!m.closures.is_empty(), "joints close a loop"),
            (!m.drives.is_empty(), "a motion or a coupling is prescribed"),
            (m.is_hybrid(), "there are contacts, stops, strings, joint friction or parts that come and go"),
            (!m.discontinuities.is_empty(), "a law switches"),
            (!m.joints.iter().all(is_plain), "a joint runs along a curve, or its coordinate has no sign"),
            (!m.forces.iter().all(is_smooth), "a law of a force is looked up, or its formula has branches"),
            (
                !m.state_rates.iter().all(ModelExpr::is_uniform),
                "a law of a state is looked up, or its formula has branches",
            ),
        ];
        obstacles.iter().find(|(stands, _)| *stands).map(|(_, why)| *why)
    }

    /// A tree with its numbers.
    pub fn new(m: &'m Mechanism, n: BoundValues<S>) -> Self {
        let (bodies, freedom) = (m.bodies.len(), m.freedom());
        TreeMotion {
            m,
            n,
            mode: Mode::free(m),
            k: Kinematics::of(m),
            arms: vec![Vec2::zero(); bodies],
            loads: vec![Wrench::zero(); bodies],
            sweep: ArticulatedBody::new(),
            nu_dot: vec![S::zero(); freedom],
            bodies: vec![Twist::zero(); bodies],
        }
    }

    /// Writes the rates of y = [q, u, states] at a time.
    ///
    /// # Errors
    /// `singular_mass`.
    pub fn rate(&mut self, t: S, y: &[S], dy: &mut [S]) -> Result<(), DynamicsError> {
        let n = self.m.freedom();
        self.solve(t, y, &mut dy[n..2 * n])?;
        dy[..n].copy_from_slice(&y[n..2 * n]);
        for (rate, law) in dy[2 * n..].iter_mut().zip(&self.m.state_rates) {
            *rate = law.eval(&State(self.at(t, y)));
        }
        Ok(())
    }

    /// Writes the accelerations at y and a time.
    fn solve(&mut self, t: S, y: &[S], accelerations: &mut [S]) -> Result<(), DynamicsError> {
        let (m, n) = (self.m, self.m.freedom());
        let (q, u) = (&y[..n], &y[n..2 * n]);
        self.n.p[m.first_state()..].copy_from_slice(&y[2 * n..]);
        self.k.forward_kinematics(m, &self.n, q, u);
        let at = StateView { m, n: &self.n, k: &self.k, q, u, t, mode: &self.mode };
        centre_arms(at, &mut self.arms);
        loads(at, &self.arms, &mut self.loads);
        self.sweep.solve(at, &self.arms, &self.loads, &mut self.nu_dot, &mut self.bodies, |_, _| {})?;
        self.k.user_rates(m, &self.n, &self.bodies, &self.nu_dot, accelerations);
        Ok(())
    }

    /// The state that was solved last.
    fn at<'a>(&'a self, t: S, y: &'a [S]) -> StateView<'a, S> {
        let (q, u) = y[..2 * self.m.freedom()].split_at(self.m.freedom());
        StateView { m: self.m, n: &self.n, k: &self.k, q, u, t, mode: &self.mode }
    }

    /// The power of a force without what its potential accounts for, where the rates were written last, W.
    pub fn unaccounted_power(&self, t: S, y: &[S], force: usize) -> S {
        unaccounted_power(self.at(t, y), force)
    }
}
