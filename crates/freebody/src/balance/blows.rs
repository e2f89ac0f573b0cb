//! Blows: what impulses through limits and joints do.

use super::limits::force_on_first;
use super::reactions::joint_load;
use super::{Balance, JointLoad, Reached, Scale, Trouble};
use crate::contact::complementarity::{self, Problem, Strike};
use crate::mechanism::Friction;
use crate::plane::{Twist, Vec2, Wrench};

/// Within a jam loads act for this part of the time in which they would bring about a speed that counts.
const BRIEF: f64 = 0.1;

/// A blow: what impulses through limits did.
#[derive(Clone, Debug)]
pub struct Blow {
    /// Change of the user's rates.
    pub change: Vec<f64>,
    /// Impulses along each reached gap, N·s.
    pub normal: Vec<f64>,
    /// Impulses along each slide, N·s.
    pub tangent: Vec<f64>,
    /// The impulse of each limit on its contact's first body, N·s, fixed axes.
    pub on_first: Vec<Vec2>,
    /// Impulsive reaction of every joint, N·s and N·m·s.
    pub joints: Vec<JointLoad>,
    /// What was to be said of the law.
    pub note: Option<String>,
}

impl Balance<'_> {
    /// What impulses along the limits reached would do, by `settle` of the strike that it is given.
    ///
    /// # Errors
    /// What `settle` finds.
    pub fn blow(
        &mut self,
        reached: &Reached,
        restitution: &[f64],
        settle: impl FnOnce(&Strike) -> Result<(complementarity::Impulses, Option<String>), Trouble>,
    ) -> Result<Blow, Trouble> {
        let friction: Vec<f64> = reached.limits.iter().map(|&l| self.friction_of(l)).collect();
        let strike = Strike { g: &reached.g, before: &reached.rates, restitution, friction: &friction };
        let (impulses, note) = settle(&strike)?;
        Ok(self.blow_of(reached, impulses, note))
    }

    /// The blow by which limits that have no motion under Coulomb's law come to one; None where each has one already.
    ///
    /// # Errors
    /// `no_impact`; as [`Balance::solve`].
    pub fn jam(&mut self, reached: &Reached, scale: Scale) -> Result<Option<Blow>, Trouble> {
        let (free, slips) = (self.free_accelerations(reached)?, reached.slips());
        let grips = self.grips(reached, &slips, scale.still);
        let problem = Problem { g: &reached.g, free: &free, grips: &grips };
        let fastest = free.iter().fold(scale.pace, |most, a| most.max(a.abs()));
        let impulses = complementarity::jam(&problem, &slips, BRIEF * scale.still / fastest).map_err(|e| {
            let sentence = format!("no impulses at {} end the jam: {e}", self.names_of(&reached.limits));
            Trouble::new("no_impact", sentence)
        })?;
        let note = Some("the contact jammed: an impact without a collision".to_string());
        Ok(impulses.map(|impulses| self.blow_of(reached, impulses, note)))
    }

    fn blow_of(&mut self, reached: &Reached, impulses: complementarity::Impulses, note: Option<String>) -> Blow {
        let p: Vec<f64> = impulses.normal.iter().chain(&impulses.tangent).copied().collect();
        let mut force = vec![0.0; self.m.freedom()];
        for (i, &p) in p.iter().enumerate() {
            self.along(reached.row(i)).iter().zip(&mut force).for_each(|(f, sum)| *sum += p * f);
        }
        let solution = self.dense.saddle.solve(&force, &vec![0.0; self.rows.len()]);
        let mut change = vec![0.0; self.m.freedom()];
        self.to_user(&solution.a, &mut change);
        let joints = self.impulsive_loads(reached, &p, &solution.a, &solution.lambda);
        let k = reached.len();
        let on_first = (0..k).map(|i| self.on_first(reached, i, p[i], p[k + i])).collect();
        let (normal, tangent) = (impulses.normal, impulses.tangent);
        Blow { change, normal, tangent, on_first, joints, note }
    }

    /// The impulses by which the present closing rows come to rest, limits apart from those that carry.
    ///
    /// # Errors
    /// As [`Balance::solve`].
    pub fn joining_blow(&mut self) -> Result<Blow, Trouble> {
        let nothing = self.reach(vec![])?;
        let asked: Vec<f64> = self.rows.iter().map(|row| -row.rate.unwrap_or(0.0)).collect();
        let solution = self.dense.saddle.solve(&vec![0.0; self.m.freedom()], &asked);
        let mut change = vec![0.0; self.m.freedom()];
        self.to_user(&solution.a, &mut change);
        let joints = self.impulsive_loads(&nothing, &[], &solution.a, &solution.lambda);
        Ok(Blow { change, normal: vec![], tangent: vec![], on_first: vec![], joints, note: None })
    }

    /// The coefficient of friction of a limit that slides: 0 where it is smooth, infinite where it cannot slide.
    pub fn friction_of(&self, limit: usize) -> f64 {
        match self.m.limits[limit].friction {
            None => 0.0,
            Some(Friction::Rough) => f64::INFINITY,
            Some(Friction::Coulomb { kinetic, .. }) => self.n.slots[kinetic],
        }
    }

    /// The force on the first body of a limit's contact (of a string, on its first end), for forces along gap and slide.
    fn on_first(&self, reached: &Reached, i: usize, normal: f64, tangent: f64) -> Vec2 {
        let mut sum = Vec2::zero();
        let parts = [(Some(&reached.gaps[i]), normal), (reached.slides[i].as_ref(), tangent)];
        for (row, p) in parts.into_iter().filter_map(|(row, p)| row.map(|row| (row, p))) {
            sum += force_on_first(self.m, reached.limits[i], &row.motion) * p;
        }
        sum
    }

    /// Reactions of all joints to impulses: the balance of momentum of all that hangs on them.
    fn impulsive_loads(&self, reached: &Reached, p: &[f64], change: &[f64], lambda: &[f64]) -> Vec<JointLoad> {
        let n = self.m.bodies.len();
        let mut bodies = vec![Twist::zero(); n];
        self.k.spread(self.m, change, false, &mut bodies);
        let mut needed: Vec<Wrench> = (0..n)
            .map(|i| {
                let momentum = bodies[i].at(self.arms[i]) * self.n.mass[i];
                Wrench { f: momentum, m: self.arms[i].cross(momentum) + self.n.inertia[i] * bodies[i].w }
            })
            .collect();
        for (i, &p) in p.iter().enumerate() {
            for &(body, load) in reached.row(i).map_or(&[][..], |row| &row.motion) {
                needed[body] = needed[body] - load * p;
            }
        }
        let passed = self.passed(needed, lambda);
        (0..self.m.joints.len()).map(|j| joint_load(self.at(), j, &passed, &self.rows, lambda)).collect()
    }
}
