//! The Taylor series of the motion of a tree.

use super::works::Works;
use super::HybridSystem;
use crate::dynamics::{DynamicsError, SmoothMotion};
use crate::mechanism::Mechanism;
use crate::motion::Analytic;
use crate::scalar::{DoubleDouble, Scalar};
use crate::series::{recorded, Solution, Tape, Traced};

/// The equations of motion of y = [q, u, works, states] at parameters `p`, recorded at one time and state; every number that
/// follows from others is found anew, to all digits.
pub(super) fn equations(
    m: &Mechanism,
    works: &Works,
    p: &[f64],
    (t, y): (f64, &[f64]),
) -> Result<Tape<DoubleDouble>, DynamicsError> {
    let (n, states) = (m.freedom(), 2 * m.freedom() + works.count());
    recorded([&[t], y].concat(), |x| {
        let (t, y) = (x[0], &x[1..]);
        let given: Vec<(usize, Traced)> = m.overruled(p).into_iter().map(|(i, x)| (i, Traced::of(x))).collect();
        let mut tree = SmoothMotion::new(m, m.bind(&m.parameters_with(&given)));
        let moving = [&y[..2 * n], &y[states..]].concat();
        let mut rates = vec![Traced::zero(); moving.len()];
        tree.rate(t, &moving, &mut rates)?;
        let powers = works.forces.iter().map(|&force| tree.unaccounted_power(t, &moving, force)).collect();
        Ok([rates[..2 * n].to_vec(), powers, rates[2 * n..].to_vec()].concat())
    })
}

impl Analytic for HybridSystem<'_> {
    fn expand(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> Result<(), DynamicsError> {
        let phase = self.phases.len();
        if self.series.as_ref().is_none_or(|(of, _)| *of != phase) {
            let (m, p) = (self.workspace.m, &self.workspace.at().n.p);
            let record = || equations(m, &self.works, p, (t, y)).map(|tape| tape.rounded());
            let tape = m.equations.of(p[..m.first_state()].to_vec(), record)?;
            self.series = Some((phase, Solution::new(Tape::clone(&tape), order)));
        }
        let (_, series) = self.series.as_mut().expect("it was made");
        if !series.expand(t, y) {
            return Err(DynamicsError::NoFiniteAcceleration);
        }
        for (i, out) in out.chunks_exact_mut(order + 1).enumerate() {
            out.copy_from_slice(series.component(i));
        }
        Ok(())
    }
}
