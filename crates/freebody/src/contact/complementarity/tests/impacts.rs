//! Impacts with answers on paper, and what no impact may do.

use super::*;

/// Touches between balls in a row, smooth: gaps open with v₂ − v₁, …; the tangential rows do not move.
fn row_of_balls(masses: &[f64], velocities: &[f64]) -> (Matrix, Matrix, Vec<f64>) {
    let k = masses.len() - 1;
    let w = Matrix::from_fn(2 * k, k + 1, |i, j| if i >= k { 0.0 } else { f64::from(j == i + 1) - f64::from(j == i) });
    let g = delassus(&w, &masses.iter().map(|m| 1.0 / m).collect::<Vec<_>>());
    let before = w.mul_vec(velocities);
    (w, g, before)
}

/// The velocities of the balls after.
fn after(w: &Matrix, masses: &[f64], velocities: &[f64], p: &Impulses) -> Vec<f64> {
    let mut push = vec![0.0; masses.len()];
    w.add_t_mul_vec(&[&p.normal[..], &p.tangent[..]].concat(), &mut push);
    (0..masses.len()).map(|i| velocities[i] + push[i] / masses[i]).collect()
}

/// A disk wedged between walls a hair from parallel, with friction: contacts that yield leave over their share of the
/// speeds that they take away, and lose energy whatever the hair.
#[test]
fn what_yields_loses_energy() {
    for (hair, share) in [0.0, 1e-9, 1e-7, 1e-3].into_iter().flat_map(|hair| [1e-10, 1e-6].map(|share| (hair, share))) {
        let w = rows(&[touch(-0.1, 0.0, 0.0), touch(0.1, 0.0, std::f64::consts::PI - hair)]);
        let g = delassus(&w, &[1.0, 1.0, 200.0]);
        let before = w.mul_vec(&[-1.0, 0.3, 2.0]);
        let s = ImpactProblem { g: &g, before: &before, restitution: &[0.3; 2], friction: &[0.8; 2] };
        let p = compliant_regularization(&s, share).unwrap();
        let p = [&p.normal[..], &p.tangent[..]].concat();
        let changes = g.mul_vec(&p);
        let work: f64 = (0..4).map(|i| (before[i] + 0.5 * changes[i]) * p[i]).sum();
        assert!(work < -0.1 && p[0] > 0.0, "hair {hair}: {work}");
        for i in (0..2).filter(|&i| p[i] > 0.0) {
            let left = before[i] + changes[i] + share * g[(i, i)] * p[i];
            assert!(left.abs() < 1e-14 * (1.0 + p[i]), "hair {hair}: {left}");
        }
    }
}

#[test]
fn cradle() {
    let (masses, velocities) = ([1.0; 3], [1.0, 0.0, 0.0]);
    let (w, g, before) = row_of_balls(&masses, &velocities);
    let s = ImpactProblem { g: &g, before: &before, restitution: &[1.0; 2], friction: &[0.0; 2] };
    let together = [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    for (law, expected) in
        [(ImpactLaw::Newton, together), (ImpactLaw::Poisson, together), (ImpactLaw::Sequential, [0.0, 0.0, 1.0])]
    {
        let p = impact(&s, law).unwrap();
        assert!(agree(&after(&w, &masses, &velocities, &p), &expected, 1e-15));
        assert!(p.work.abs() < 1e-15 && !p.gains);
    }
    let all = undecided(&s).unwrap();
    assert_eq!(
        all.iter().map(|(law, _)| *law).collect::<Vec<_>>(),
        [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential]
    );
    assert_eq!(undecided(&ImpactProblem { restitution: &[0.0; 2], ..s }), None);
    let (_, g, before) = row_of_balls(&[1.0; 2], &[1.0, 0.0]);
    assert_eq!(undecided(&ImpactProblem { g: &g, before: &before, restitution: &[1.0], friction: &[0.0] }), None);
}

/// Plastic carts go on together with the velocity of their mass centre; elastic ones exchange momentum.
#[test]
fn carts() {
    let (masses, velocities) = ([2.0, 3.0, 1.0, 0.5], [4.0, 1.0, 0.0, -2.0]);
    let (w, g, before) = row_of_balls(&masses, &velocities);
    let s = ImpactProblem { g: &g, before: &before, restitution: &[0.0; 3], friction: &[0.0; 3] };
    let momentum: f64 = masses.iter().zip(velocities).map(|(m, v)| m * v).sum();
    let common = momentum / masses.iter().sum::<f64>();
    for law in [ImpactLaw::Newton, ImpactLaw::Poisson] {
        let p = impact(&s, law).unwrap();
        assert!(agree(&after(&w, &masses, &velocities, &p), &[common; 4], 1e-15));
        assert!(p.after.iter().all(|v| *v == 0.0));
    }
    let e = 0.6;
    let (w, g, before) = row_of_balls(&masses[..2], &velocities[..2]);
    let s = ImpactProblem { g: &g, before: &before, restitution: &[e], friction: &[0.0] };
    for law in [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential] {
        let p = impact(&s, law).unwrap();
        let mean = 11.0 / 5.0;
        let expected = [mean - 3.0 * e * 3.0 / 5.0, mean + 3.0 * e * 2.0 / 5.0];
        assert!(agree(&after(&w, &masses[..2], &velocities[..2], &p), &expected, 1e-15));
        assert!((p.work + 0.5 * 1.2 * 9.0 * (1.0 - e * e)).abs() < 1e-14);
    }
}

/// A disc that lands without spin slides on if vT/|vN| > 3 μ (1 + e); otherwise it rolls.
#[test]
fn landing_disc() {
    let w = rows(&[touch(0.0, -1.0, std::f64::consts::FRAC_PI_2)]);
    let g = delassus(&w, &[1.0, 1.0, 2.0]);
    let (mu, e) = (0.2, 0.7);
    for (slip, slides) in [(3.0 * mu * (1.0 + e) + 1e-9, true), (3.0 * mu * (1.0 + e) - 1e-9, false)] {
        let s = ImpactProblem { g: &g, before: &[-1.0, slip], restitution: &[e], friction: &[mu] };
        for law in [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential] {
            let p = impact(&s, law).unwrap();
            assert!((p.after[0] - e).abs() < 1e-15 && (p.normal[0] - 1.0 - e).abs() < 1e-15);
            assert_eq!(p.after[1] > 0.0, slides);
            assert!(p.tangent[0].abs() <= mu * p.normal[0] * (1.0 + 1e-15) && !p.gains);
        }
    }
}

/// Newton's law with friction creates energy: an elastic rod at 45° that sticks. With H = G⁻¹ the
/// work is −½ vT (2 HNT vN + HTT vT) (after Kane 1984). Poisson's law returns the normal impulse of compression,
/// which moves the end of the rod by 1/HNN.
#[test]
fn newton_with_friction_creates_energy() {
    let w = rows(&[touch(0.5_f64.sqrt(), -(0.5_f64.sqrt()), std::f64::consts::FRAC_PI_2)]);
    let g = delassus(&w, &[1.0, 1.0, 3.0]);
    let det = g[(0, 0)] * g[(1, 1)] - g[(0, 1)] * g[(0, 1)];
    let (vn, vt) = (-1.0, -0.2);
    let expected = -0.5 * vt * (-2.0 * g[(0, 1)] * vn + g[(0, 0)] * vt) / det;
    for friction in [f64::INFINITY, 5.0] {
        let s = ImpactProblem { g: &g, before: &[vn, vt], restitution: &[1.0], friction: &[friction] };
        let p = impact(&s, ImpactLaw::Newton).unwrap();
        assert!(expected > 0.0 && p.gains && (p.work - expected).abs() < 1e-14, "{p:?} {expected}");
        let settled = solve_impact(&s, ImpactLaw::Newton).unwrap();
        assert!(settled.law == ImpactLaw::Poisson && !settled.plastic && settled.impulses.work <= 0.0, "{settled:?}");
        assert_eq!(settled.notes.len(), 1);
        let compression = -(g[(1, 1)] * vn - g[(0, 1)] * vt) / det;
        assert!(agree(&settled.impulses.after, &[det / g[(1, 1)] * compression, 0.0], 1e-14), "{settled:?}");
    }
}

/// What is settled creates no energy, leaves no contact approaching, and pushes within the friction cones;
/// without restitution a law never needs to be replaced.
#[test]
fn settled_impacts() {
    let (mut r, cases, mut replaced, mut ambiguous) = (Random(21), 4_000, 0, 0);
    for n in 0..cases {
        let k = 1 + r.below(3);
        let c = case(&mut r, k, any_grip);
        if !c.consistent {
            continue;
        }
        let e: Vec<f64> = (0..k).map(|_| r.unit(true).abs()).collect();
        let mu: Vec<f64> = (0..k).map(|_| 1.0 + r.unit(true)).collect();
        let s = ImpactProblem { g: &c.g, before: &c.free, restitution: &e, friction: &mu };
        let law = [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential][r.below(3)];
        let settled = match solve_impact(&s, law) {
            Ok(settled) => settled,
            Err(NoImpact::Ambiguous(all)) => {
                ambiguous += 1;
                assert!(all.len() > 1);
                continue;
            }
            Err(error) => panic!("case {n}: {error}: {s:?}"),
        };
        replaced += usize::from(!settled.notes.is_empty());
        let p = &settled.impulses;
        assert!(!p.gains && p.work <= 1e-9, "case {n}: {s:?} {settled:?}");
        for (i, mu) in mu.iter().enumerate() {
            assert!(p.after[i] >= -1e-9 && p.normal[i] >= 0.0, "case {n}: {s:?} {settled:?}");
            assert!(p.tangent[i].abs() <= mu * p.normal[i] + 1e-9, "case {n}: {s:?} {settled:?}");
        }
        let none = vec![0.0; k];
        let plastic = impact(&ImpactProblem { restitution: &none, ..s }, ImpactLaw::Newton);
        assert!(plastic.is_err() || plastic.is_ok_and(|p| !p.gains));
    }
    assert!(replaced > 10 && ambiguous < cases / 10, "{replaced} {ambiguous}");
}
