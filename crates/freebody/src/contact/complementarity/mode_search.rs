//! The decision on a block: pivoting, enumeration, and the order of static before kinetic friction.

use super::form::{propose, Proposal};
use super::lcp_block::Found;
use super::lcp_block::{BlockFriction, LcpBlock};
use super::modes::{admissible, basic, choices, evaluate, vertices, Mode, Refusal, Tangent};
use super::relaxation::relaxed;
use super::{FrictionLaw, Status};

/// Up to this many coupled contacts all modes are tried, to see whether the answer is the only one.
const ALWAYS: usize = 3;
/// Up to this many all modes are tried when pivoting fails.
const ENUMERABLE: usize = 6;
/// Accelerations that differ by less are the same.
const SAME_ACCELERATION: f64 = 1e-9;

/// Where contacts oppose each other, round-off can leave no motion that opens or closes all; so pivoting is
/// tried again with contacts moved apart by this, and what it proposes is judged without.
const APART: [f64; 4] = [0.0, 1e-9, 1e-7, 1e-5];

/// Paths of pivoting tried: where many contacts are redundant, round-off leads some of them astray.
const PATHS: usize = 3;

/// Vertices tried of forces that their equations do not determine: all, for six contacts.
const VERTICES: usize = 4_096;

/// What there is to find.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    /// At least one finding, with different accelerations.
    Found(Vec<Found>),
    /// Certainly none.
    Nothing,
    /// None was found, but not all modes were tried.
    Unknown,
}

/// Decides a block.
pub(super) fn decide(block: &LcpBlock) -> Outcome {
    let at_rest = block.with_friction(|_, law| match law {
        BlockFriction::Law(FrictionLaw::Resting { fixed, .. }) => {
            BlockFriction::Law(FrictionLaw::Resting { fixed, kinetic: fixed })
        }
        _ => law,
    });
    let first = bounded(&at_rest);
    if at_rest.friction == block.friction {
        return first;
    }
    let mut all = Vec::new();
    match first {
        Outcome::Found(found) => found.into_iter().for_each(|f| slide(block, f, &mut all)),
        // Proved without regard to friction.
        Outcome::Nothing if block.len() > ENUMERABLE => return Outcome::Nothing,
        Outcome::Nothing | Outcome::Unknown => {}
    }
    match all.len() {
        0 if block.len() <= ENUMERABLE => most_at_rest(block),
        0 => Outcome::Unknown,
        _ => Outcome::Found(all),
    }
}

/// Lets the contacts that slipped under their static coefficients slide under the kinetic ones, and decides
/// the others again, until no more slip.
fn slide(block: &LcpBlock, found: Found, all: &mut Vec<Found>) {
    let starts = |i: usize, law: BlockFriction| match (law, found.status[i]) {
        (BlockFriction::Law(FrictionLaw::Resting { fixed, kinetic }), Status::Slip(s)) if kinetic < fixed => {
            BlockFriction::Starting(s, kinetic)
        }
        _ => law,
    };
    let next = block.with_friction(starts);
    if next.friction == block.friction {
        return add(all, found);
    }
    if let Outcome::Found(found) = decide(&next) {
        found.into_iter().for_each(|f| add(all, f));
    }
}

/// Of all findings with static friction at rest and kinetic in motion, those with most contacts at rest.
fn most_at_rest(block: &LcpBlock) -> Outcome {
    let at_rest = |f: &Found| f.status.iter().filter(|s| **s == Status::Stick).count();
    let all = block.tolerances.iter().map(|t| enumerate(block, Vec::new(), *t)).find(|all| !all.is_empty());
    let Some(mut all) = all else { return Outcome::Nothing };
    let most = all.iter().map(at_rest).max();
    all.retain(|f| Some(at_rest(f)) == most);
    Outcome::Found(all)
}

/// Decides a block in which static and kinetic friction are the same.
fn bounded(block: &LcpBlock) -> Outcome {
    let unique = block.friction.iter().all(|h| *h == BlockFriction::Law(FrictionLaw::Frictionless));
    let few = block.len() <= ALWAYS && !unique;
    let mut proposals = Proposals::new(block);
    for tolerance in block.tolerances.iter().filter(|_| !few) {
        match proposals.first(*tolerance) {
            Outcome::Unknown => {}
            decided => return decided,
        }
    }
    if block.len() > ENUMERABLE {
        return Outcome::Unknown;
    }
    for &tolerance in block.tolerances {
        let pivoted = match proposals.first(tolerance) {
            Outcome::Found(found) => found,
            Outcome::Nothing => return Outcome::Nothing,
            Outcome::Unknown => Vec::new(),
        };
        let all = enumerate(block, pivoted, tolerance);
        if !all.is_empty() {
            return Outcome::Found(all);
        }
    }
    Outcome::Nothing
}

/// What is proposed for a block, in the order in which it is tried: by pivoting, then by relaxation. Each proposal is made once, when it is
/// first asked for, and judged to one tolerance after the other.
pub(super) struct Proposals<'a> {
    block: &'a LcpBlock,
    known: Vec<Proposal>,
    coming: Box<dyn Iterator<Item = Proposal> + 'a>,
}

impl<'a> Proposals<'a> {
    pub fn new(block: &'a LcpBlock) -> Self {
        let paths = (0..PATHS).flat_map(|path| APART.map(|apart| (path, apart)));
        let pivoted = paths.filter_map(|(path, apart)| propose(block, apart, path));
        Proposals { block, known: vec![], coming: Box::new(pivoted.chain(relaxed(block).map(Proposal::Modes))) }
    }

    /// The first that holds to a tolerance; not all modes are tried.
    pub fn first(&mut self, tolerance: f64) -> Outcome {
        let (block, mut i) = (self.block, 0);
        while let Some(proposal) = self.get(i) {
            let Proposal::Modes(modes) = proposal else { return Outcome::Nothing };
            if let Some(found) = vertex(block, modes, tolerance) {
                return Outcome::Found(vec![found]);
            }
            i += 1;
        }
        Outcome::Unknown
    }

    /// Proposal `i` of those that differ.
    fn get(&mut self, i: usize) -> Option<&Proposal> {
        while i >= self.known.len() {
            let next = self.coming.next()?;
            if !self.known.contains(&next) {
                self.known.push(next);
            }
        }
        Some(&self.known[i])
    }
}

/// What all modes add to the findings.
pub(super) fn enumerate(block: &LcpBlock, mut all: Vec<Found>, tolerance: f64) -> Vec<Found> {
    let lists: Vec<Vec<Mode>> =
        (0..block.len()).map(|i| admissible(block.friction[i], block.least_normal[i])).collect();
    choices(&lists, |modes| {
        vertex(block, modes, tolerance).into_iter().for_each(|found| add(&mut all, found));
        false
    });
    all
}

/// The finding of these modes; where they do not determine the forces, the first of its vertices, with more contacts
/// one near the middle.
fn vertex(block: &LcpBlock, modes: &[Mode], tolerance: f64) -> Option<Found> {
    let mut result = evaluate(block, modes, tolerance);
    let is_singular = matches!(result, Err(Refusal::Singular));
    if is_singular && block.len() > ALWAYS {
        result = basic(block, modes, true, tolerance);
    }
    if result.is_err() && is_singular && block.len() <= ENUMERABLE {
        let lists: Vec<Vec<Mode>> = modes.iter().zip(&block.friction).map(|(m, h)| vertices(*h, *m)).collect();
        let mut tries = 0;
        choices(&lists, |modes| {
            tries += 1;
            result = evaluate(block, modes, tolerance);
            result.is_ok() || tries == VERTICES
        });
    }
    let found = result.ok()?;
    // On the edge of its cone but held by others, a contact may not need a tangential force at all.
    match held(block, modes, &found).filter(|_| block.len() <= ENUMERABLE) {
        Some(modes) => vertex(block, &modes, tolerance).or(Some(found)),
        None => Some(found),
    }
}

/// The modes with the contacts stuck that were to slip and do not, if there are such.
fn held(block: &LcpBlock, modes: &[Mode], found: &Found) -> Option<Vec<Mode>> {
    let resting = |i: usize| matches!(block.friction[i], BlockFriction::Law(FrictionLaw::Resting { .. }));
    let stays =
        |i: usize| matches!(modes[i].tangent, Tangent::Slip(_)) && found.status[i] == Status::Stick && resting(i);
    let stick = |i: usize| if stays(i) { Mode { tangent: Tangent::Stick, ..modes[i] } } else { modes[i] };
    (0..modes.len()).any(stays).then(|| (0..modes.len()).map(stick).collect())
}

/// Adds a finding whose accelerations are new.
fn add(all: &mut Vec<Found>, found: Found) {
    let size = found.acceleration.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
    let same = |f: &Found| {
        f.acceleration.iter().zip(&found.acceleration).all(|(a, b)| (a - b).abs() <= SAME_ACCELERATION * size)
    };
    if !all.iter().any(same) {
        all.push(found);
    }
}
