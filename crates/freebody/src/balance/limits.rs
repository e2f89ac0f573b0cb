//! Limits that are reached: which of them hold, and what a blow does.
//!
//! All other constraints are eliminated first, by the null space of their rows; what is left is a problem of the limits
//! alone, with the Delassus matrix of accelerations by unit contact forces. An impact is the same problem with velocities
//! and impulses (Pfeiffer & Glocker 1996, *Multibody Dynamics with Unilateral Contacts*).

use super::minimal::Force;
use super::rows::{closing_rows, gap_row, slide_row};
use super::{project, Balance, Row, Trouble};
use crate::contact::complementarity::{self, Answer, Grip, Problem, Status, Verdict};
use crate::mechanism::Friction;
use crate::mode::Hold;
use crate::plane::{Vec2, Wrench};
use crate::solve::Matrix;

/// Part of the largest acceleration below which one, or a force that would cause it, is too small to decide by.
const CLOSE: f64 = 1e-8;
/// Part of the mechanism's own accelerations below which one is round-off.
const NOTHING: f64 = 1e-13;

/// Coupling of two limits, over their own sizes, that is round-off.
const UNCOUPLED: f64 = 1e-12;

/// What counts as slow, and what is done where nothing decides.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// A speed of sliding below which there is none, m/s.
    pub still: f64,
    /// The mechanism's own accelerations, m/s².
    pub pace: f64,
    /// Whether what can stay at rest stays, where Coulomb's law leaves it open.
    pub stay: bool,
    /// Whether touches that are almost one may contradict each other by a little.
    pub rough: bool,
}

/// Limits whose gaps are closed at one state, k of them.
pub struct Reached {
    /// Which.
    pub limits: Vec<usize>,
    pub(super) gaps: Vec<Row>,
    pub(super) slides: Vec<Option<Row>>,
    /// Joint accelerations for a unit force: of the k gaps, then of the k slides.
    columns: Vec<Vec<f64>>,
    /// Accelerations of gaps, then slides, by unit forces along them, 2k × 2k.
    pub(super) g: Matrix,
    /// Rates of the k gaps, then of the k slides, m/s.
    pub rates: Vec<f64>,
}

/// How limits go on.
pub struct Holding {
    /// Of each limit reached.
    pub holds: Vec<Hold>,
    /// Whether something that decides was too small to be sure of.
    pub close: bool,
    /// Part of its normal force with which each rubs.
    pub rubs: Vec<f64>,
}

impl Reached {
    pub(super) fn len(&self) -> usize {
        self.limits.len()
    }

    /// Speeds of sliding, m/s.
    pub fn slips(&self) -> Vec<f64> {
        self.rates[self.len()..].to_vec()
    }

    /// Sizes of the speeds that each impulse alone gives where it acts, m/s.
    pub fn speeds_of<'a>(&'a self, normal: &'a [f64], tangent: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        normal.iter().chain(tangent).enumerate().map(|(i, p)| (self.g[(i, i)] * p).abs())
    }

    /// Of each limit whether it approaches faster than `still`, or is coupled to one that does.
    pub fn takes_part(&self, still: f64) -> Vec<bool> {
        let k = self.len();
        let size = |i: usize| self.g[(i, i)].max(self.g[(k + i, k + i)]).max(f64::MIN_POSITIVE);
        let coupled = |i: usize, j: usize| {
            let entries = [(i, j), (i, k + j), (k + i, j), (k + i, k + j)];
            entries.iter().any(|&at| self.g[at].abs() > UNCOUPLED * (size(i) * size(j)).sqrt())
        };
        let mut part: Vec<bool> = (0..k).map(|i| self.rates[i] < -still).collect();
        let mut found: Vec<usize> = (0..k).filter(|&i| part[i]).collect();
        while let Some(i) = found.pop() {
            for j in (0..k).filter(|&j| coupled(i, j)) {
                if !std::mem::replace(&mut part[j], true) {
                    found.push(j);
                }
            }
        }
        part
    }

    /// Row i of gaps and slides together; None for a slide that cannot rub.
    pub(super) fn row(&self, i: usize) -> Option<&Row> {
        let k = self.len();
        if i < k {
            Some(&self.gaps[i])
        } else {
            self.slides[i - k].as_ref()
        }
    }
}

impl Balance<'_> {
    /// Frees `limits` and finds how they act on one another at the present state.
    ///
    /// # Errors
    /// As [`Balance::solve`]: the mechanism without them must have a motion.
    pub fn reach(&mut self, limits: Vec<usize>) -> Result<Reached, Trouble> {
        for &limit in &limits {
            self.mode.limits[limit].hold = Hold::Open;
        }
        let at = self.at();
        let gaps: Vec<Row> = limits.iter().map(|&l| gap_row(at, l, None)).collect();
        let slides: Vec<Option<Row>> =
            limits.iter().map(|&l| self.m.limits[l].friction.and_then(|_| slide_row(at, l, None))).collect();
        self.rows = closing_rows(at, None);
        let mut arms = std::mem::take(&mut self.arms);
        super::load::centre_arms(self.at(), &mut arms);
        self.arms = arms;
        self.factor(Force::OwnWay)?;
        let k = limits.len();
        let rates = gaps.iter().map(|r| r.rate.unwrap_or(0.0));
        let rates = rates.chain(slides.iter().map(|s| s.as_ref().and_then(|r| r.rate).unwrap_or(0.0))).collect();
        let mut reached = Reached { limits, gaps, slides, columns: vec![], g: Matrix::zeros(2 * k, 2 * k), rates };
        let along: Vec<Vec<f64>> = (0..2 * k).map(|i| self.along(reached.row(i))).collect();
        let still = vec![0.0; self.rows.len()];
        reached.columns = along.iter().map(|f| self.dense.saddle.solve(f, &still).a).collect();
        reached.g = Matrix::from_fn(2 * k, 2 * k, |i, j| dot(&along[i], &reached.columns[j]));
        Ok(reached)
    }

    /// What a unit force along a row does on each joint coordinate.
    pub(super) fn along(&self, row: Option<&Row>) -> Vec<f64> {
        let mut force = vec![0.0; self.m.freedom()];
        if let Some(row) = row {
            project(self.at(), &row.motion, &mut force);
        }
        force
    }

    /// Accelerations of gaps, then slides, that the limits reached would have without force, m/s².
    ///
    /// # Errors
    /// As [`Balance::solve`].
    pub fn free_accelerations(&mut self, reached: &Reached) -> Result<Vec<f64>, Trouble> {
        self.solve_by(super::Route::Minimal)?;
        let at = self.at();
        let bodies = Some(self.solved.bodies.as_slice());
        let gaps = reached.limits.iter().map(|&l| gap_row(at, l, bodies).bias);
        let slides = reached
            .limits
            .iter()
            .zip(&reached.slides)
            .map(|(&l, slide)| slide.as_ref().and_then(|_| slide_row(at, l, bodies)).map_or(0.0, |row| row.bias));
        Ok(gaps.chain(slides).collect())
    }

    /// How the limits reached go on from the present state: what parts, what sticks, what slides, for given speeds of
    /// sliding; one below `still` is none. An acceleration far below `pace` decides nothing by itself. Where several motions
    /// satisfy Coulomb's law, as where a block in a gap may jam or go down, `stay` takes the one in which most limits stick:
    /// what can stay at rest stays.
    ///
    /// # Errors
    /// `painleve_inconsistent`, `painleve_indeterminate`; as [`Balance::solve`].
    pub fn hold(&mut self, reached: &Reached, slips: &[f64], scale: Scale) -> Result<Holding, Trouble> {
        let mut free = self.free_accelerations(reached)?;
        if !free.iter().all(|a| a.is_finite()) {
            return Err(Trouble::not_finite());
        }
        // Round-off is no reason to part.
        free.iter_mut().filter(|a| a.abs() <= NOTHING * scale.pace).for_each(|a| *a = 0.0);
        let grips = self.grips(reached, slips, scale.still);
        let problem = Problem { g: &reached.g, free: &free, grips: &grips };
        let solve = if scale.rough { complementarity::solve_roughly } else { complementarity::solve };
        match solve(&problem) {
            Verdict::Solved(answer) => Ok(holding(&answer, &problem, scale.pace)),
            Verdict::Indeterminate(answers) if scale.stay => {
                let sticks = |a: &&Answer| a.status.iter().filter(|s| **s == Status::Stick).count();
                let most = answers.iter().rev().max_by_key(sticks).expect("several answers");
                Ok(holding(most, &problem, scale.pace))
            }
            verdict => Err(self.paradox(reached, &free, &grips, &verdict)),
        }
    }

    /// Lets the limits hold that are reached at the present state, and the joints rub that move, for an instant by itself:
    /// nothing strikes.
    ///
    /// # Errors
    /// `penetration`; as [`Balance::hold`].
    pub fn lean(&mut self) -> Result<(), Trouble> {
        if self.m.limits.is_empty() && self.m.rubs.is_empty() {
            return Ok(());
        }
        self.start_limits()?;
        let still = 1e-9 * self.length * (self.n.gravity.norm() / self.length).sqrt().max(1.0);
        self.start_rubs(still)?;
        let scale = Scale { still, pace: self.n.gravity.norm().max(self.length), stay: false, rough: false };
        for _ in 0..=self.most_turns() {
            self.lean_on_reached(scale)?;
            if self.m.rubs.is_empty() || !self.turn_rub(scale, None)? {
                break;
            }
        }
        Ok(())
    }

    fn lean_on_reached(&mut self, scale: Scale) -> Result<(), Trouble> {
        let touching = self.touching(1e-9 * self.length);
        let reached = self.reach(touching)?;
        let staying =
            (0..reached.len()).filter(|&i| reached.rates[i] <= scale.still).map(|i| reached.limits[i]).collect();
        let reached = self.reach(staying)?;
        let holding = self.hold(&reached, &reached.slips(), scale)?;
        self.take(&reached, &holding);
        Ok(())
    }

    /// Takes the holds found.
    pub fn take(&mut self, reached: &Reached, holding: &Holding) {
        for (&l, &hold) in reached.limits.iter().zip(&holding.holds) {
            self.mode.limits[l].hold = hold;
        }
    }

    /// Of limits that stick, though others that slide keep them from it, takes as many as there are forces too many for the
    /// motions that are excluded: these go on to rub as they do now. What holds them does not say how much.
    ///
    /// # Errors
    /// As [`Balance::solve`].
    pub fn share(&mut self, reached: &Reached, holding: &Holding) -> Result<(), Trouble> {
        let sticking = |(&l, &rub): (&usize, &f64)| Some((l, rub)).filter(|_| self.mode.limits[l].hold == Hold::Stuck);
        let sticking: Vec<(usize, f64)> = reached.limits.iter().zip(&holding.rubs).filter_map(sticking).collect();
        if self.solve_by(super::Route::Minimal).is_ok() || sticking.is_empty() {
            return Ok(());
        }
        for &(l, rub) in &sticking {
            self.mode.limits[l].hold = Hold::Leaning(rub);
        }
        for &(l, rub) in &sticking {
            self.mode.limits[l].hold = Hold::Stuck;
            let fails = self.solve_by(super::Route::Minimal).is_err();
            if fails && self.dense.saddle.authority() >= self.dense.saddle.rank().rank {
                self.mode.limits[l].hold = Hold::Leaning(rub);
            }
        }
        self.solve_by(super::Route::Minimal)
    }

    pub(super) fn grips(&self, reached: &Reached, slips: &[f64], still: f64) -> Vec<Grip> {
        reached.limits.iter().zip(slips).map(|(&l, &slip)| self.grip(l, slip, still)).collect()
    }

    fn grip(&self, limit: usize, slip: f64, still: f64) -> Grip {
        match self.m.limits[limit].friction {
            None => Grip::Smooth,
            Some(Friction::Rough) => Grip::Rough,
            Some(Friction::Coulomb { fixed, kinetic }) => {
                let (fixed, kinetic) = (self.n.slots[fixed], self.n.slots[kinetic]);
                match slip.abs() <= still {
                    true => Grip::Resting { fixed, kinetic },
                    false => Grip::Sliding { sense: slip.signum(), kinetic },
                }
            }
        }
    }

    /// Says by name that Coulomb's law and rigid bodies contradict each other here.
    fn paradox(&self, reached: &Reached, free: &[f64], grips: &[Grip], verdict: &Verdict) -> Trouble {
        let names = self.names_of(&reached.limits);
        let mut told = match verdict {
            Verdict::Indeterminate(answers) => {
                format!(
                    "at {names} {} different motions satisfy Coulomb's law and the balance equations",
                    answers.len()
                )
            }
            Verdict::Unknown => format!("at {names} no motion was found that satisfies Coulomb's law"),
            _ => {
                format!("at {names} no motion satisfies both Coulomb's law and the balance equations: the contact jams")
            }
        };
        let sliding = (0..reached.len()).find_map(|i| match grips[i] {
            Grip::Sliding { sense, kinetic } => Some((i, sense, kinetic)),
            _ => None,
        });
        if let Some((i, sense, kinetic)) = sliding {
            let p = complementarity::painleve(&reached.g, free, i, sense, kinetic);
            told += &format!("; A = {:.4e} 1/kg, b = {:.4e} m/s²", p.leading, p.free);
            if let Some(critical) = p.critical {
                told += &format!(", and the paradox begins at a friction of {critical:.6}");
            }
        }
        let name = match verdict {
            Verdict::Indeterminate(_) => "painleve_indeterminate",
            Verdict::Unknown => "contact_unsolved",
            _ => "painleve_inconsistent",
        };
        let group = &self.m.groups[self.m.limits[reached.limits[sliding.map_or(0, |s| s.0)]].group];
        Trouble::new(name, told + "; lower the friction, or let a spring stand for the contact").about(group.path())
    }

    /// The names of the contacts, stops and strings of limits, each once.
    pub fn names_of(&self, limits: &[usize]) -> String {
        let mut names: Vec<String> =
            limits.iter().map(|&l| format!("`{}`", self.m.groups[self.m.limits[l].group].name)).collect();
        names.dedup();
        names.join(" and ")
    }
}

/// The force that loads put on the first body of a limit's group; ground takes the opposite of what the others get.
pub(super) fn force_on_first(m: &crate::mechanism::Mechanism, limit: usize, loads: &[(usize, Wrench)]) -> Vec2 {
    let first = m.groups[m.limits[limit].group].ends[0];
    match loads.iter().find(|(body, _)| *body == first) {
        Some((_, load)) => load.f,
        None => -loads.iter().fold(Vec2::zero(), |sum, (_, load)| sum + load.f),
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The holds of an answer, and whether it was a close thing.
fn holding(answer: &Answer, problem: &Problem, pace: f64) -> Holding {
    let k = answer.status.len();
    let fastest = problem.free.iter().chain(&answer.acceleration).fold(pace, |most, x| most.max(x.abs()));
    let weak = |i: usize| answer.normal[i] * problem.g[(i, i)] <= CLOSE * fastest;
    let slow = |x: f64| x.abs() <= CLOSE * fastest;
    let hold = |i: usize| match answer.status[i] {
        Status::Open if slow(answer.acceleration[i]) => Hold::Idle,
        Status::Open => Hold::Open,
        Status::Closed => Hold::Smooth,
        Status::Stick => Hold::Stuck,
        Status::Slip(sense) => Hold::Sliding(sense),
    };
    let close = |i: usize| match (answer.status[i], problem.grips[i]) {
        (Status::Open, _) => slow(answer.acceleration[i]),
        (Status::Stick, Grip::Resting { fixed, .. }) => {
            let most = fixed * answer.normal[i];
            weak(i) || most - answer.tangent[i].abs() <= CLOSE * most
        }
        (Status::Slip(_), Grip::Resting { .. }) => weak(i) || slow(answer.acceleration[k + i]),
        _ => weak(i),
    };
    let rubs = answer.normal.iter().zip(&answer.tangent).map(|(n, t)| if *n > 0.0 { t / n } else { 0.0 }).collect();
    Holding { holds: (0..k).map(hold).collect(), close: (0..k).any(close), rubs }
}
