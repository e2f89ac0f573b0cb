//! Impacts of several contacts at once: velocities before, impulses, velocities after.

use super::{lcp_block, resolve, FrictionLaw, Verdict};
use crate::solve::Matrix;
use std::fmt;

/// Approach slower than this, relative to the fastest velocity before, has come to rest.
const AT_REST: f64 = 1e-13;
/// Hits after which a sequence of them is given up.
const HITS: usize = 10_000;
/// A velocity below this, relative to the terms that make it up, is zero.
const VELOCITY_NOISE: f64 = 1e-14;
/// Work above this, relative to the terms that make it up, is a gain.
const WORK_GAIN: f64 = 1e-12;
/// Work above this, relative to the energy of the velocities before, is a gain whatever the terms.
const GROSS: f64 = 1e-10;

/// k contacts that are closed and may be approaching.
#[derive(Clone, Copy, Debug)]
pub struct ImpactProblem<'a> {
    /// 2k × 2k: velocity (rows) by unit impulses (columns), as in [`Problem`](super::Problem).
    pub g: &'a Matrix,
    /// 2k: the normal velocities before, negative where a contact approaches, then the tangential ones.
    pub before: &'a [f64],
    /// k: the coefficients of restitution, 0 ≤ e ≤ 1.
    pub restitution: &'a [f64],
    /// k: the coefficients of friction; infinite where a contact cannot slide.
    pub friction: &'a [f64],
}

/// What restitution means. Friction is Coulomb's between the impulses pT and pN, by the velocity after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImpactLaw {
    /// The velocity is reversed, all contacts at once: 0 ≤ pN ⟂ vN⁺ − e max(0, −vN⁻) ≥ 0
    /// (Newton; Moreau 1988). With friction it may create energy.
    Newton,
    /// The impulse is returned: plastic compression with pC, then expansion with pN ≥ e pC
    /// (Poisson; Glocker & Pfeiffer, *Nonlinear Dynamics* 7, 1995).
    Poisson,
    /// One contact after the other by Newton's law, the fastest approach first, until none approaches.
    Sequential,
}

/// What an impact does.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulses {
    /// k: the normal impulses, ≥ 0.
    pub normal: Vec<f64>,
    /// k: the tangential impulses.
    pub tangent: Vec<f64>,
    /// 2k: the velocities after.
    pub after: Vec<f64>,
    /// The change of kinetic energy, Σ ½(v⁻ + v⁺) p.
    pub work: f64,
    /// The law has created energy: the result must not be used.
    pub gains: bool,
}

/// Why a law gives no impulses.
#[derive(Clone, Debug, PartialEq)]
pub enum NoImpact {
    /// No impulses satisfy the law.
    Impossible,
    /// Several do, with these velocities after.
    Ambiguous(Vec<Impulses>),
    /// None were found, without proof that there are none; or a number is not what it should be.
    Unknown,
    /// One contact hits after the other without coming to rest, or ever faster.
    Endless,
}

impl fmt::Display for NoImpact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoImpact::Impossible => write!(f, "there are none"),
            NoImpact::Ambiguous(all) => write!(f, "{} different outcomes", all.len()),
            NoImpact::Unknown => write!(f, "none were found"),
            NoImpact::Endless => write!(f, "{HITS} hits, one after the other, do not come to rest"),
        }
    }
}

impl std::error::Error for NoImpact {}

/// Impulses, normal then tangential (2k).
type Impulse = Vec<f64>;

/// The impulses by one law. Those that create energy are flagged; see [`settle`](super::settle).
pub fn impact(s: &ImpactProblem, law: ImpactLaw) -> Result<Impulses, NoImpact> {
    if !s.is_sound() {
        return Err(NoImpact::Unknown);
    }
    let p = match law {
        ImpactLaw::Newton => newton(s),
        ImpactLaw::Poisson => poisson(s),
        ImpactLaw::Sequential => sequential(s),
    }?;
    Ok(s.with(&p))
}

impl ImpactProblem<'_> {
    fn len(&self) -> usize {
        self.friction.len()
    }

    /// Whether its numbers are what they should be.
    fn is_sound(&self) -> bool {
        self.g.data().iter().chain(self.before).all(|v| v.is_finite())
            && self.restitution.iter().all(|e| (0.0..=1.0).contains(e))
            && self.friction.iter().all(|mu| *mu >= 0.0)
    }

    /// What the impulses do.
    fn with(&self, p: &[f64]) -> Impulses {
        let k = self.len();
        let size = |i: usize| self.before[i].abs() + (0..2 * k).map(|j| (self.g[(i, j)] * p[j]).abs()).sum::<f64>();
        let changes = self.g.mul_vec(p);
        let after: Vec<f64> = (0..2 * k)
            .map(|i| self.before[i] + changes[i])
            .enumerate()
            .map(|(i, v)| if v.abs() <= VELOCITY_NOISE * size(i) { 0.0 } else { v })
            .collect();
        let terms = || (0..2 * k).map(|i| (self.before[i], after[i], p[i]));
        let work = terms().map(|(b, a, p)| 0.5 * (b + a) * p).sum();
        let scale: f64 = terms().map(|(b, a, p)| 0.5 * (b.abs() + a.abs()) * p.abs()).sum();
        // Large impulses that all but cancel must not hide a gain.
        let energy =
            |i: usize| if self.g[(i, i)] > 0.0 { self.before[i] * self.before[i] / self.g[(i, i)] } else { 0.0 };
        let gains = work > WORK_GAIN * scale || work > GROSS * (0..2 * k).map(energy).sum::<f64>();
        Impulses { normal: p[..k].to_vec(), tangent: p[k..].to_vec(), after, work, gains }
    }

    /// Impulses of which those of the contacts at `velocity`, or their reversal, are complementary.
    fn complementary(&self, velocity: &[f64], least_normal: &[f64]) -> Result<Impulse, NoImpact> {
        let friction: Vec<FrictionLaw> = self.friction.iter().map(|&mu| friction_law(mu)).collect();
        let join = |a: &super::Answer| [&a.normal[..], &a.tangent[..]].concat();
        match resolve(self.g, velocity, &friction, least_normal, &lcp_block::EXACT) {
            Verdict::Solved(a) => Ok(join(&a)),
            Verdict::Indeterminate(all) => Err(NoImpact::Ambiguous(all.iter().map(|a| self.with(&join(a))).collect())),
            Verdict::Inconsistent => Err(NoImpact::Impossible),
            Verdict::Unknown => Err(NoImpact::Unknown),
        }
    }
}

fn friction_law(mu: f64) -> FrictionLaw {
    match mu {
        0.0 => FrictionLaw::Frictionless,
        f64::INFINITY => FrictionLaw::Rough,
        _ => FrictionLaw::Resting { fixed: mu, kinetic: mu },
    }
}

fn newton(s: &ImpactProblem) -> Result<Impulse, NoImpact> {
    let mut free = s.before.to_vec();
    for (v, e) in free.iter_mut().zip(s.restitution) {
        *v -= e * (-*v).max(0.0);
    }
    s.complementary(&free, &vec![0.0; s.len()])
}

fn poisson(s: &ImpactProblem) -> Result<Impulse, NoImpact> {
    let compression = s.complementary(s.before, &vec![0.0; s.len()])?;
    let middle = s.with(&compression);
    let returned: Vec<f64> = s.restitution.iter().zip(&middle.normal).map(|(e, p)| e * p).collect();
    let expansion = s.complementary(&middle.after, &returned)?;
    Ok(compression.iter().zip(&expansion).map(|(c, e)| c + e).collect())
}

fn sequential(s: &ImpactProblem) -> Result<Impulse, NoImpact> {
    let k = s.len();
    let rest = AT_REST * s.before.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let (mut velocity, mut total) = (s.before.to_vec(), vec![0.0; 2 * k]);
    for _ in 0..HITS {
        let fastest = (0..k).reduce(|a, b| if velocity[b] < velocity[a] { b } else { a });
        let Some(hit) = fastest.filter(|&i| velocity[i] < -rest) else { return Ok(total) };
        let rows = [hit, k + hit];
        let one = ImpactProblem {
            g: &Matrix::from_fn(2, 2, |i, j| s.g[(rows[i], rows[j])]),
            before: &rows.map(|r| velocity[r]),
            restitution: &s.restitution[hit..=hit],
            friction: &s.friction[hit..=hit],
        };
        for (row, p) in rows.into_iter().zip(newton(&one)?) {
            total[row] += p;
            (0..2 * k).for_each(|i| velocity[i] += s.g[(i, row)] * p);
        }
        if velocity.iter().any(|v| !v.is_finite()) {
            break;
        }
    }
    Err(NoImpact::Endless)
}
