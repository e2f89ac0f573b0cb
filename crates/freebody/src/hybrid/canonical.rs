//! The motion of a conservative tree in Hamilton's variables, for symplectic methods.
//!
//! With T = uᵀM(q)u/2, momenta p = M u; Hamilton's ṗ = ∂T/∂q + Q is M u̇ + Ṁ u, where M u̇ comes from the
//! balance of the instant and Ṁ u from the momenta along the motion at fixed u, by dual numbers.

use super::HybridSystem;
use crate::bound_values::BoundValues;
use crate::kinematics::Kinematics;
use crate::mechanism::Mechanism;
use crate::motion::{Canonical, DynamicsError};
use crate::scalar::{Dual, Scalar};
use crate::solve::{Lu, Matrix};

/// Momenta p = M(q) u of the user's coordinates: pⱼ is the momentum of all bodies along the motion of a unit uⱼ.
fn momenta<S: Scalar>(m: &Mechanism, n: &BoundValues<S>, q: &[S], u: &[S]) -> Vec<S> {
    let mut going = Kinematics::<S>::of(m);
    going.forward_kinematics(m, n, q, u);
    let mut along = Kinematics::<S>::of(m);
    let mut unit = vec![S::zero(); q.len()];
    (0..q.len())
        .map(|j| {
            unit[j] = S::one();
            along.forward_kinematics(m, n, q, &unit);
            unit[j] = S::zero();
            let mut sum = S::zero();
            for i in 1..m.bodies.len() {
                let arm = going.pose[i].turn.apply(n.centre[i]);
                sum += along.twist[i].at(arm).dot(going.twist[i].at(arm)) * n.mass[i];
                sum += along.twist[i].w * going.twist[i].w * n.inertia[i];
            }
            sum
        })
        .collect()
}

/// The mass matrix of the tree in the user's coordinates, column by column.
fn mass_columns(m: &Mechanism, n: &BoundValues, q: &[f64]) -> Vec<f64> {
    let mut unit = vec![0.0; q.len()];
    let mut flat = Vec::with_capacity(q.len() * q.len());
    for j in 0..q.len() {
        unit[j] = 1.0;
        flat.extend(momenta(m, n, q, &unit));
        unit[j] = 0.0;
    }
    flat
}

/// The mass matrix of the tree in the user's coordinates at parameters `p`, n × n, row-major (it is symmetric).
pub fn mass_matrix(m: &Mechanism, p: &[f64], q: &[f64]) -> Vec<f64> {
    mass_columns(m, &m.bind(p), q)
}

impl HybridSystem<'_> {
    fn mass_times(&self, q: &[f64], u: &[f64]) -> Vec<f64> {
        momenta(self.workspace.m, self.workspace.at().n, q, u)
    }

    /// u from p: solves M u = p.
    fn rates(&self, q: &[f64], p: &[f64]) -> Result<Vec<f64>, DynamicsError> {
        let n = q.len();
        let flat = mass_columns(self.workspace.m, self.workspace.at().n, q);
        let mass = Matrix::from_fn(n, n, |i, j| flat[j * n + i]);
        let lu = Lu::factor(&mass).map_err(|_| DynamicsError::NoUniqueMotion)?;
        Ok(lu.solve(p))
    }
}

impl Canonical for HybridSystem<'_> {
    fn enter(&mut self, _: f64, y: &[f64], z: &mut [f64]) -> Result<(), DynamicsError> {
        let n = self.workspace.m.freedom();
        let p = self.mass_times(&y[..n], &y[n..2 * n]);
        z[..n].copy_from_slice(&y[..n]);
        z[n..2 * n].copy_from_slice(&p);
        Ok(())
    }

    fn leave(&mut self, _: f64, z: &[f64], y: &mut [f64]) -> Result<(), DynamicsError> {
        let n = self.workspace.m.freedom();
        let u = self.rates(&z[..n], &z[n..2 * n])?;
        y[..n].copy_from_slice(&z[..n]);
        y[n..2 * n].copy_from_slice(&u);
        Ok(())
    }

    fn flow(&mut self, t: f64, z: &[f64], dz: &mut [f64]) -> Result<(), DynamicsError> {
        let n = self.workspace.m.freedom();
        let q = &z[..n];
        let u = self.rates(q, &z[n..2 * n])?;
        self.workspace.place(&self.mode, t, q, &u);
        self.workspace.solve()?;
        let mut u_dot = vec![0.0; n];
        self.workspace.accelerations(&mut u_dot);
        let along: Vec<Dual<1>> = q.iter().zip(&u).map(|(&q, &u)| Dual { re: q, du: [u] }).collect();
        let held: Vec<Dual<1>> = u.iter().map(|&u| Dual::constant(u)).collect();
        let p: Vec<Dual<1>> = self.workspace.at().n.p.iter().map(|&p| Dual::constant(p)).collect();
        let bias = momenta(self.workspace.m, &self.workspace.m.bind(&p), &along, &held);
        let mass = self.mass_times(q, &u_dot);
        dz[..n].copy_from_slice(&u);
        for i in 0..n {
            dz[n + i] = mass[i] + bias[i].du[0];
        }
        Ok(())
    }
}
