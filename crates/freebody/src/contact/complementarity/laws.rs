//! Which impact law to believe: the one that creates no energy, and whether the laws agree.

use super::impact::{strike, Impulses, Law, NoImpact, Strike};
use super::jam::least;
use super::task::groups;
use crate::solve::Matrix;

/// Velocities after that differ by less, relative to the fastest, agree.
const AGREE: f64 = 1e-9;

/// An impact that creates no energy, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// What happens.
    pub impulses: Impulses,
    /// The law by which.
    pub law: Law,
    /// All coefficients of restitution were taken as zero.
    pub plastic: bool,
    /// Why other laws, tried before, were refused; a sentence each.
    pub notes: Vec<String>,
}

/// The impulses by `law`; where it gives none or creates energy by Poisson's, and where that does too, without
/// restitution, which never creates energy. An error is that of the last.
pub fn settle(s: &Strike, law: Law) -> Result<Settled, NoImpact> {
    let none = vec![0.0; s.friction.len()];
    let plastic = Strike { restitution: &none, ..*s };
    let mut notes = Vec::new();
    if let Some(impulses) = accepted(s, law, &mut notes) {
        return Ok(Settled { impulses, law, plastic: false, notes });
    }
    if law != Law::Poisson {
        if let Some(impulses) = accepted(s, Law::Poisson, &mut notes) {
            return Ok(Settled { impulses, law: Law::Poisson, plastic: false, notes });
        }
    }
    notes.push("Taken as plastic, e = 0.".to_owned());
    Ok(Settled { impulses: strike(&plastic, Law::Newton)?, law: Law::Newton, plastic: true, notes })
}

/// The impulses without restitution where each touch yields: a unit impulse on it moves it by `share` more than rigid bodies
/// would. Touches that all but oppose each other then share finite impulses; they never create energy, and a part `share` of
/// the speeds that they take away is left over.
pub fn yielding(s: &Strike, share: f64) -> Result<Impulses, NoImpact> {
    let entry = |i: usize, j: usize| if i == j { (1.0 + share) * s.g[(i, j)] } else { s.g[(i, j)] };
    let g = Matrix::from_fn(s.g.rows(), s.g.cols(), entry);
    let none = vec![0.0; s.friction.len()];
    match strike(&Strike { g: &g, restitution: &none, ..*s }, Law::Newton) {
        Err(NoImpact::Ambiguous(all)) => Ok(least(all)),
        struck => struck,
    }
}

/// The impulses by `law`, or a note why not.
fn accepted(s: &Strike, law: Law, notes: &mut Vec<String>) -> Option<Impulses> {
    match strike(s, law) {
        Ok(impulses) if !impulses.gains => return Some(impulses),
        Ok(impulses) => notes.push(format!("{law:?}'s law would create the energy {:.6e}.", impulses.work)),
        Err(trouble) => notes.push(format!("By {law:?}'s law {trouble}.")),
    }
    None
}

/// The outcomes by the laws that apply, if the question matters: coupled touches take impulses together,
/// one of them with restitution, and the velocities after are not the same.
///
/// A single touch is decided, and so is an impact without restitution: then the touches go on together.
pub fn undecided(s: &Strike) -> Option<Vec<(Law, Impulses)>> {
    let by = |law| strike(s, law).ok().filter(|i| !i.gains).map(|i| (law, i));
    let all: Vec<(Law, Impulses)> = [Law::Newton, Law::Poisson, Law::Sequential].into_iter().filter_map(by).collect();
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
