//! Impact without collision: impulses without a collision.

use super::*;
use crate::solve::Orthogonal;

const MOMENT: f64 = 1e-12;

/// Where there is a motion nothing jumps; where there is none, impulses within Coulomb's cone bring sliding to an end,
/// and energy never rises.
#[test]
fn what_has_no_motion_jumps_by_the_law_of_friction() {
    let (mut r, mut jams) = (Random(7), 0);
    for n in 0..20_000 {
        let k = 1 + r.below(3);
        let c = case(&mut r, k, |r| {
            let mu = 1.0 + r.unit(false);
            match r.below(3) {
                0 => FrictionLaw::Resting { fixed: mu, kinetic: mu },
                _ => FrictionLaw::Sliding { sense: r.sense(), kinetic: mu },
            }
        });
        let speed = |g: &FrictionLaw| if let FrictionLaw::Sliding { sense, .. } = g { 0.5 * sense } else { 0.0 };
        let slips: Vec<f64> = c.grips.iter().map(speed).collect();
        let verdict = solve(&c.problem());
        // Redundant contacts cannot slide at any speeds.
        if Orthogonal::factor(&c.g).rank().rank < 2 * k {
            continue;
        }
        let impulses = impact_without_collision(&c.problem(), &slips, MOMENT);
        if verdict != Verdict::Inconsistent {
            assert_eq!(impulses, Ok(None), "case {n}: {:?}", c.problem());
            continue;
        }
        let p = impulses.expect("impulses").unwrap_or_else(|| panic!("case {n} does not jump: {:?}", c.problem()));
        jams += 1;
        let size = p.normal.iter().fold(0.0_f64, |m, v| m.max(*v));
        let units: Vec<f64> = (0..2 * k).map(|i| c.g[(i, i)].sqrt()).collect();
        for i in 0..k {
            let (FrictionLaw::Sliding { kinetic: mu, .. } | FrictionLaw::Resting { kinetic: mu, .. }) = c.grips[i]
            else {
                panic!()
            };
            let (push, friction, slides) = (p.normal[i], p.tangent[i], p.after[k + i] / units[k + i]);
            assert!(push >= 0.0 && friction.abs() <= mu * push + 1e-9 * size, "case {n}: cone");
            assert!(p.after[i] >= -1e-9 * units[i], "case {n}: approach");
            let opposed = (friction + mu * slides.signum() * push).abs() <= 1e-9 * size;
            assert!(push == 0.0 || slides.abs() <= 1e-9 || opposed, "case {n}: friction against the sliding after");
        }
        assert!(p.work <= 1e-9 * size, "case {n}: work {}", p.work);
    }
    assert!(jams > 300, "{jams}");
}

/// Painlevé's rod: the contact comes to rest by the impulses of one that sticks, p = −G⁻¹ (0, v).
#[test]
fn a_jammed_rod_stops_at_once() {
    let (angle, mu, slip) = (1.2_f64, 2.0, 0.5);
    let (s, c) = angle.sin_cos();
    let g = Matrix::from_fn(2, 2, |i, j| [[1.0 + 3.0 * c * c, 3.0 * s * c], [3.0 * s * c, 1.0 + 3.0 * s * s]][i][j]);
    let problem = Problem { g: &g, free: &[-9.81, 0.0], friction: &[FrictionLaw::Sliding { sense: 1.0, kinetic: mu }] };
    assert_eq!(solve(&problem), Verdict::Inconsistent);
    let p = impact_without_collision(&problem, &[slip], MOMENT).expect("impulses").expect("a jump");
    let det = g[(0, 0)] * g[(1, 1)] - g[(0, 1)] * g[(1, 0)];
    assert!(agree(&[p.normal[0], p.tangent[0]], &[g[(0, 1)] * slip / det, -g[(0, 0)] * slip / det], 1e-10));
}
