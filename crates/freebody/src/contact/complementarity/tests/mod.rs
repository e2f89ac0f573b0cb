//! Random contacts, and what an answer must satisfy whoever found it.

use super::*;
use crate::solve::Matrix;

mod closed;
mod impacts;
mod jams;
mod random;

/// Random numbers by SplitMix64 (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Uniform in 0..n.
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    /// Uniform in [−1, 1), or of a few round numbers there.
    fn unit(&mut self, round: bool) -> f64 {
        match round {
            true => self.below(5) as f64 / 2.0 - 1.0,
            false => (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0,
        }
    }
    fn sense(&mut self) -> f64 {
        [1.0, -1.0][self.below(2)]
    }
}

/// The normal and tangential row of a contact at (x, y) of a body with coordinates (x, y, angle), with the
/// normal at `angle`.
fn touch(x: f64, y: f64, angle: f64) -> [[f64; 3]; 2] {
    let row = |(nx, ny): (f64, f64)| [nx, ny, x * ny - y * nx];
    [row((angle.cos(), angle.sin())), row((angle.sin(), -angle.cos()))]
}

/// Rows of contacts of one body on the ground, normals first.
fn rows(contacts: &[[[f64; 3]; 2]]) -> Matrix {
    let k = contacts.len();
    Matrix::from_fn(2 * k, 3, |i, j| contacts[i % k][i / k][j])
}

/// W M⁻¹ Wᵀ.
fn delassus(w: &Matrix, inverse_masses: &[f64]) -> Matrix {
    let n = w.rows();
    let entry = |i: usize, j: usize| (0..w.cols()).map(|c| w[(i, c)] * inverse_masses[c] * w[(j, c)]).sum();
    Matrix::from_fn(n, n, entry)
}

/// G, free accelerations and grips.
struct Case {
    g: Matrix,
    free: Vec<f64>,
    grips: Vec<FrictionLaw>,
    /// The free accelerations are W v̇ of some motion.
    consistent: bool,
}

impl Case {
    fn problem(&self) -> Problem<'_> {
        Problem { g: &self.g, free: &self.free, friction: &self.grips }
    }
}

/// Touches of two bodies with the ground and each other; `round` numbers make degenerate cases.
fn case(r: &mut Random, k: usize, friction_law: impl Fn(&mut Random) -> FrictionLaw) -> Case {
    let (round, consistent) = (r.below(3) == 0, r.below(4) > 0);
    let bodies = 1 + r.below(2);
    let masses: Vec<f64> = (0..3 * bodies).map(|_| if round { 1.0 } else { (3.0 * r.unit(false)).exp() }).collect();
    let mut w = Matrix::zeros(2 * k, 3 * bodies);
    for i in 0..k {
        let (body, both) = (r.below(bodies), bodies == 2 && r.below(2) == 0);
        let angle = r.unit(round) * std::f64::consts::PI;
        for (b, sign) in [(body, 1.0), (1 - body.min(1), -1.0)].into_iter().take(1 + usize::from(both)) {
            let pair = touch(r.unit(round), r.unit(round), angle);
            for (t, row) in pair.iter().enumerate() {
                (0..3).for_each(|c| w[(t * k + i, 3 * b + c)] = sign * row[c]);
            }
        }
    }
    let pull: Vec<f64> = masses.iter().map(|_| r.unit(round)).collect();
    let mut free = w.mul_vec(&pull);
    if !consistent {
        free.iter_mut().for_each(|f| *f += r.unit(round));
    }
    Case { g: delassus(&w, &masses), free, grips: (0..k).map(|_| friction_law(r)).collect(), consistent }
}

fn any_grip(r: &mut Random) -> FrictionLaw {
    let round = r.below(3) == 0;
    let mu = 1.0 + r.unit(round);
    match r.below(8) {
        0 => FrictionLaw::Frictionless,
        1 => FrictionLaw::Rough,
        2..=4 => FrictionLaw::Sliding { sense: r.sense(), kinetic: mu },
        _ => FrictionLaw::Resting { fixed: mu, kinetic: mu },
    }
}

/// Holds an answer against the conditions of contact, to `tolerance` relative to the terms of a row and the free
/// accelerations.
fn verify(p: &Problem, a: &Answer, tolerance: f64) -> Result<(), String> {
    let k = p.friction.len();
    let force = [&a.normal[..], &a.tangent[..]].concat();
    let units: Vec<f64> = (0..2 * k).map(|i| p.g[(i, i)].sqrt()).collect();
    let free = p.free.iter().zip(&units).map(|(f, u)| f.abs() / u).fold(0.0, f64::max);
    let point_forces = force.iter().zip(&units).map(|(f, u)| f.abs() * u).fold(free, f64::max);
    let terms = |i: usize| units[i] * free + (0..2 * k).map(|j| (p.g[(i, j)] * force[j]).abs()).sum::<f64>();
    let small: Vec<f64> = (0..2 * k).map(|i| tolerance * terms(i)).collect();
    let moved = p.g.mul_vec(&force);
    let require = |ok: bool, what: &str, i: usize| if ok { Ok(()) } else { Err(format!("{what} of touch {i}")) };
    for i in 0..k {
        let push = tolerance * point_forces * (1.0 / units[i]).max(1.0 / units[k + i]);
        let (n, t, an, at) = (a.normal[i], a.tangent[i], a.acceleration[i], a.acceleration[k + i]);
        require((p.free[i] + moved[i] - an).abs() <= small[i], "aN = G λ + f", i)?;
        require((p.free[k + i] + moved[k + i] - at).abs() <= small[k + i], "aT = G λ + f", i)?;
        require(n >= 0.0 && an >= 0.0 && n * an == 0.0, "0 ≤ λN ⟂ aN ≥ 0", i)?;
        let (slip, stick) = (a.status[i] == Status::Slip(at.signum()), a.status[i] == Status::Stick);
        match (p.friction[i], a.status[i]) {
            (_, Status::Open) => require(n == 0.0 && t == 0.0, "no force", i)?,
            (FrictionLaw::Frictionless, s) => require(t == 0.0 && s == Status::Closed, "λT = 0", i)?,
            (FrictionLaw::Rough, _) => require(at == 0.0 && stick && n > 0.0, "aT = 0", i)?,
            (FrictionLaw::Sliding { sense, kinetic }, s) => {
                require((t + kinetic * sense * n).abs() <= push && s == Status::Slip(sense), "λT = −μ s λN", i)?
            }
            (FrictionLaw::Resting { fixed, .. }, Status::Stick) => {
                require(at == 0.0 && t.abs() <= fixed * n + push, "|λT| ≤ μ λN", i)?
            }
            (FrictionLaw::Resting { kinetic, .. }, _) => {
                require(slip && (t + kinetic * at.signum() * n).abs() <= push, "λT = −μ sgn(aT) λN", i)?
            }
        }
    }
    Ok(())
}

/// Every answer of a verdict, verified.
fn verified(p: &Problem, tolerance: f64) -> Verdict {
    let verdict = solve(p);
    let answers = match &verdict {
        Verdict::Solved(a) => std::slice::from_ref(a),
        Verdict::Indeterminate(all) => &all[..],
        Verdict::Inconsistent | Verdict::Unknown => &[],
    };
    for a in answers {
        verify(p, a, tolerance).unwrap_or_else(|e| panic!("{e}: {p:?} {a:?}"));
    }
    verdict
}

/// The answer of a problem that has one motion.
fn solved(p: &Problem) -> Answer {
    match verified(p, 1e-12) {
        Verdict::Solved(a) => a,
        other => panic!("{other:?} for {p:?}"),
    }
}

/// Whether x and y differ by at most `tolerance`, relative to the largest of y or 1.
fn agree(x: &[f64], y: &[f64], tolerance: f64) -> bool {
    let size = y.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
    x.iter().zip(y).all(|(x, y)| (x - y).abs() <= tolerance * size)
}
