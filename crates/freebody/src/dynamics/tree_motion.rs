//! The motion of a tree over any scalar: of several mechanisms at once over lanes.

use super::articulated_body::ArticulatedBody;
use super::loads::{centre_arms, loads};
use super::DynamicsError;
use crate::bound_values::BoundValues;
use crate::gauges::ModelExpr;
use crate::joints::Joint as _;
use crate::kinematics::{Kinematics, State, StateView};
use crate::mechanism::{Force, Joint, Mechanism};
use crate::mode::Mode;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;

/// A tree in motion. Its equations are those of [`super::Workspace`], to the same bits.
pub struct TreeMotion<'m, S> {
    m: &'m Mechanism,
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
    /// Whether a mechanism is a tree whose motion is the same operations whatever its numbers: nothing closes a loop, switches, happens
    /// or is looked up.
    pub fn fits(m: &Mechanism) -> bool {
        let is_plain =
            |joint: &Joint| joint.curve.is_none() && !joint.coordinates.iter().any(|c| joint.kind.unsigned(c.card));
        let is_smooth = |force: &Force| force.plate.is_none() && force.laws().all(ModelExpr::is_uniform);
        m.closures.is_empty()
            && m.drives.is_empty()
            && !m.is_hybrid()
            && m.events.is_empty()
            && m.discontinuities.is_empty()
            && m.joints.iter().all(is_plain)
            && m.forces.iter().all(is_smooth)
            && m.state_rates.iter().all(ModelExpr::is_uniform)
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
    /// `singular_mass`, where that is so of any of the mechanisms.
    #[inline(always)]
    pub fn rate(&mut self, t: S, y: &[S], dy: &mut [S]) -> Result<(), DynamicsError> {
        let (m, n) = (self.m, self.m.freedom());
        let (q, u) = (&y[..n], &y[n..2 * n]);
        self.n.p[m.first_state()..].copy_from_slice(&y[2 * n..]);
        self.k.forward_kinematics(m, &self.n, q, u);
        let at = StateView { m, n: &self.n, k: &self.k, q, u, t, mode: &self.mode };
        centre_arms(at, &mut self.arms);
        loads(at, &self.arms, &mut self.loads);
        let (nu_dot, bodies) = (&mut self.nu_dot, &mut self.bodies);
        self.sweep.solve(at, &self.arms, &self.loads, nu_dot, bodies, |_, _| {})?;
        dy[..n].copy_from_slice(u);
        self.k.user_rates(m, &self.n, &self.bodies, &self.nu_dot, &mut dy[n..2 * n]);
        for (rate, law) in dy[2 * n..].iter_mut().zip(&m.state_rates) {
            *rate = law.eval(&State(at));
        }
        Ok(())
    }
}
