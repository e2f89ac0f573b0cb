//! Which impact law to believe: the one that creates no energy, and whether the laws agree.

use super::impact::{impact, ImpactLaw, ImpactProblem, Impulses, NoImpact};
use super::impact_without_collision::least;
use super::lcp_block::groups;
use crate::solve::Matrix;

/// Velocities after that differ by less, relative to the fastest, agree.
const AGREE: f64 = 1e-9;

/// An impact that creates no energy, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpactOutcome {
    /// What happens.
    pub impulses: Impulses,
    /// The law by which.
    pub law: ImpactLaw,
    /// All coefficients of restitution were taken as zero.
    pub plastic: bool,
    /// Why other laws, tried before, were refused; a sentence each.
    pub notes: Vec<String>,
}

/// The impulses by `law`; where it gives none or creates energy by Poisson's, and where that does too, without
/// restitution, which never creates energy. An error is that of the last.
pub fn solve_impact(s: &ImpactProblem, law: ImpactLaw) -> Result<ImpactOutcome, NoImpact> {
    let none = vec![0.0; s.friction.len()];
    let plastic = ImpactProblem { restitution: &none, ..*s };
    let mut notes = Vec::new();
    if let Some(impulses) = accepted(s, law, &mut notes) {
        return Ok(ImpactOutcome { impulses, law, plastic: false, notes });
    }
    if law != ImpactLaw::Poisson {
        if let Some(impulses) = accepted(s, ImpactLaw::Poisson, &mut notes) {
            return Ok(ImpactOutcome { impulses, law: ImpactLaw::Poisson, plastic: false, notes });
        }
    }
    notes.push("Taken as plastic, e = 0.".to_owned());
    Ok(ImpactOutcome { impulses: impact(&plastic, ImpactLaw::Newton)?, law: ImpactLaw::Newton, plastic: true, notes })
}

/// The impulses without restitution where each contact yields: a unit impulse on it moves it by `share` more than rigid
/// bodies would. Touches that all but oppose each other then share finite impulses; they never create energy, and a
/// part `share` of the speeds that they take away is left over.
pub fn compliant_regularization(s: &ImpactProblem, share: f64) -> Result<Impulses, NoImpact> {
    let entry = |i: usize, j: usize| if i == j { (1.0 + share) * s.g[(i, j)] } else { s.g[(i, j)] };
    let g = Matrix::from_fn(s.g.rows(), s.g.cols(), entry);
    let none = vec![0.0; s.friction.len()];
    match impact(&ImpactProblem { g: &g, restitution: &none, ..*s }, ImpactLaw::Newton) {
        Err(NoImpact::Ambiguous(all)) => Ok(least(all)),
        impulses => impulses,
    }
}

/// The impulses by `law`, or a note why not.
fn accepted(s: &ImpactProblem, law: ImpactLaw, notes: &mut Vec<String>) -> Option<Impulses> {
    match impact(s, law) {
        Ok(impulses) if !impulses.gains => return Some(impulses),
        Ok(impulses) => notes.push(format!("{law:?}'s law would create the energy {:.6e}.", impulses.work)),
        Err(error) => notes.push(format!("By {law:?}'s law {error}.")),
    }
    None
}

/// The outcomes by the laws that apply, if the question matters: coupled contacts take impulses together,
/// one of them with restitution, and the velocities after are not the same.
///
/// A single contact is decided, and so is an impact without restitution: then the contacts go on together.
pub fn undecided(s: &ImpactProblem) -> Option<Vec<(ImpactLaw, Impulses)>> {
    let by = |law| impact(s, law).ok().filter(|i| !i.gains).map(|i| (law, i));
    let all: Vec<(ImpactLaw, Impulses)> =
        [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential].into_iter().filter_map(by).collect();
    let k = s.friction.len();
    let hit = |i: &usize| all.iter().any(|(_, p)| p.normal[*i] > 0.0);
    let contested = |group: &Vec<usize>| {
        let hits: Vec<usize> = group.iter().copied().filter(|i| hit(i)).collect();
        hits.len() > 1 && hits.iter().any(|&i| s.restitution[i] > 0.0)
    };
    let rows = groups(s.g).into_iter().filter(contested).flatten().flat_map(|i| [i, k + i]);
    // Divided by the root of G's diagonal, velocities of different kinds are all roots of energies.
    let weigh = |i: usize, v: f64| if s.g[(i, i)] > 0.0 { v.abs() / s.g[(i, i)].sqrt() } else { 0.0 };
    let fastest = (0..2 * k).map(|i| weigh(i, s.before[i])).fold(0.0, f64::max);
    let differs = |i: usize| all.iter().any(|(_, p)| weigh(i, p.after[i] - all[0].1.after[i]) > AGREE * fastest);
    rows.into_iter().any(differs).then_some(all)
}
