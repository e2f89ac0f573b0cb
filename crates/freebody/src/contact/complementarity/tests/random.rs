//! Random problems: pivoting against enumeration, and what theory promises.

use super::super::lcp_block::Found;
use super::super::mode_search::{enumerate, Outcome, Proposals};
use super::*;

fn task(c: &Case) -> LcpBlock {
    let k = c.grips.len();
    LcpBlock::new(&c.g, &c.free, &c.grips, &vec![0.0; k], &(0..k).collect::<Vec<_>>())
}

/// Pivoting finds what enumeration finds, and never what it does not; every answer satisfies the conditions.
#[test]
fn pivoting_agrees_with_enumeration() {
    let mut r = Random(1);
    let (mut counts, mut lost) = ([0; 4], 0);
    for n in 0..100_000 {
        let k = 1 + r.below(3);
        let c = case(&mut r, k, any_grip);
        let block = task(&c);
        let all = enumerate(&block, Vec::new(), 1e-12);
        match Proposals::new(&block).first(1e-12) {
            Outcome::Found(found) => {
                let same = |f: &Found| agree(&f.acceleration, &found[0].acceleration, 1e-9);
                assert!(all.iter().any(same), "case {n}: {:?}\n{found:?}\n{all:?}", c.problem());
            }
            Outcome::Nothing => assert!(all.is_empty(), "case {n}: {:?}\n{all:?}", c.problem()),
            Outcome::Unknown => lost += usize::from(!all.is_empty()),
        }
        match verified(&c.problem(), 1e-9) {
            Verdict::Solved(_) => counts[0] += 1,
            Verdict::Indeterminate(_) => counts[1] += 1,
            Verdict::Inconsistent => counts[2] += 1,
            Verdict::Unknown => counts[3] += 1,
        }
    }
    assert!(counts[0] > 50_000 && counts[1] > 1_000 && counts[2] > 1_000 && counts[3] == 0, "{counts:?}");
    // Where contacts slide, Lemke's path may end on a ray though there is a solution, and relaxation does not find all of them.
    assert!(lost < 500, "{lost}");
}

/// Without contacts that slide already there is always a motion, however many contacts are redundant
/// (Stewart & Trinkle 1996), and pivoting finds it.
#[test]
fn touches_at_rest_always_have_a_motion() {
    let mut r = Random(2);
    for n in 0..10_000 {
        let k = 1 + r.below(10);
        let mu = r.unit(false).abs() * 2.0;
        let c = case(&mut r, k, |_| {
            if n % 4 == 0 {
                FrictionLaw::Frictionless
            } else {
                FrictionLaw::Resting { fixed: mu, kinetic: mu }
            }
        });
        if c.consistent {
            assert!(matches!(Proposals::new(&task(&c)).first(1e-12), Outcome::Found(_)), "case {n}: {:?}", c.problem());
            assert!(matches!(verified(&c.problem(), 1e-9), Verdict::Solved(_) | Verdict::Indeterminate(_)));
        }
    }
}

/// Nor does round-off of G and of the free accelerations make redundant contacts impossible.
#[test]
fn round_off_is_no_contradiction() {
    let mut r = Random(5);
    for n in 0..1_500 {
        let (k, noise) = (1 + r.below(8), [1e-16, 1e-14, 1e-12][n % 3]);
        let mut c = case(&mut r, k, |r| {
            if n % 4 == 0 {
                FrictionLaw::Frictionless
            } else {
                FrictionLaw::Resting { fixed: 1.0, kinetic: r.unit(true).abs() }
            }
        });
        for (a, b) in (0..2 * k).flat_map(|a| (0..=a).map(move |b| (a, b))) {
            c.g[(a, b)] += noise * r.unit(false);
            c.g[(b, a)] = c.g[(a, b)];
        }
        c.free.iter_mut().for_each(|f| *f += noise * r.unit(false));
        if c.consistent && c.free.iter().any(|f| f.abs() > 0.1) {
            let verdict = solve(&c.problem());
            assert!(
                matches!(verdict, Verdict::Solved(_) | Verdict::Indeterminate(_)),
                "case {n}: {:?} {verdict:?}",
                c.problem()
            );
        }
    }
}

/// Other units of the rows change nothing but units.
#[test]
fn units_do_not_matter() {
    let mut r = Random(3);
    for _ in 0..2_000 {
        let k = 1 + r.below(3);
        let c = case(&mut r, k, any_grip);
        let Verdict::Solved(a) = solve(&c.problem()) else { continue };
        let (d, f) = (2_f64.powi(r.below(40) as i32 - 20), 10_f64.powi(r.below(19) as i32 - 9));
        let g = Matrix::from_fn(2 * k, 2 * k, |i, j| d * c.g[(i, j)] * d);
        let free: Vec<f64> = c.free.iter().map(|v| d * f * v).collect();
        let Verdict::Solved(b) = verified(&Problem { g: &g, free: &free, friction: &c.grips }, 1e-9) else { panic!() };
        let back: Vec<f64> = b.acceleration.iter().map(|v| v / (d * f)).collect();
        assert!(agree(&back, &a.acceleration, 1e-9));
        assert_eq!(a.status, b.status);
    }
}

/// Static friction above kinetic: what rests under the static coefficient stays, what slides obeys the kinetic one.
#[test]
fn static_friction_has_precedence() {
    let mut r = Random(4);
    let mut slips = 0;
    for _ in 0..3_000 {
        let k = 1 + r.below(3);
        let c = case(&mut r, k, |r| {
            let fixed = 1.0 + r.unit(false);
            FrictionLaw::Resting { fixed, kinetic: 0.5 * fixed * (1.0 + r.unit(false)) }
        });
        let Verdict::Solved(a) = verified(&c.problem(), 1e-9) else { continue };
        slips += a.status.iter().filter(|s| matches!(s, Status::Slip(_))).count();
        let bound = |g: &FrictionLaw| match *g {
            FrictionLaw::Resting { fixed, .. } => FrictionLaw::Resting { fixed, kinetic: fixed },
            g => g,
        };
        let friction: Vec<FrictionLaw> = c.grips.iter().map(bound).collect();
        if let Verdict::Solved(b) = solve(&Problem { friction: &friction, ..c.problem() }) {
            let slides = |a: &Answer| a.status.iter().any(|s| matches!(s, Status::Slip(_)));
            assert!(slides(&a) == slides(&b) || slides(&b));
        }
    }
    assert!(slips > 300);
}

/// Groups without influence on each other are decided each on its own scale.
#[test]
fn far_apart() {
    let g = Matrix::identity(4);
    let friction_law = FrictionLaw::Resting { fixed: 0.5, kinetic: 0.5 };
    let a = solved(&Problem { g: &g, free: &[-1e9, -1e-9, 1e9, 1e-10], friction: &[friction_law; 2] });
    assert_eq!(a.status, [Status::Slip(1.0), Status::Stick]);
    assert_eq!(a.normal, [1e9, 1e-9]);
    assert!(agree(&a.tangent, &[-5e8, -1e-10], 1e-15));
}

/// What is not a number is not answered.
#[test]
fn not_a_number() {
    let g = Matrix::identity(2);
    let verdict = |free: f64, friction_law| solve(&Problem { g: &g, free: &[free, 0.0], friction: &[friction_law] });
    assert_eq!(verdict(f64::NAN, FrictionLaw::Frictionless), Verdict::Unknown);
    assert_eq!(verdict(-1.0, FrictionLaw::Resting { fixed: f64::NAN, kinetic: 0.1 }), Verdict::Unknown);
    assert_eq!(verdict(-1.0, FrictionLaw::Resting { fixed: 0.1, kinetic: 0.2 }), Verdict::Unknown);
    assert_eq!(verdict(-1.0, FrictionLaw::Sliding { sense: 0.0, kinetic: 0.2 }), Verdict::Unknown);
}

/// Friction that is brought inside its cones makes no contact do anything else.
#[test]
fn what_contacts_do_stays_as_friction_comes_inside() {
    let (mut r, mut moved) = (Random(7), 0);
    for _ in 0..5_000 {
        let k = 3 + r.below(3);
        let case = case(&mut r, k, any_grip);
        let Verdict::Solved(edge) = verified(&case.problem(), 1e-9) else { continue };
        let found = inside(&case.problem(), edge.clone());
        verify(&case.problem(), &found, 1e-9).expect("an answer, too");
        assert_eq!(found.status, edge.status, "{:?}", case.problem());
        moved += usize::from(!agree(&found.tangent, &edge.tangent, 1e-9));
    }
    assert!(moved > 100, "{moved}");
}
