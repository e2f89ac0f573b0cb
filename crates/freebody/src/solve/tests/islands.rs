use super::super::{Condensed, IslandRank, Islands, Matrix, Solution};
use super::{distance, factored, unscaled, Random};

/// Equations of two or three groups, their unknowns and rows mixed up, have the solution of the whole: the same
/// accelerations, multipliers, rank, and counts of motions and self-stresses.
#[test]
fn groups_are_solved_as_the_whole() {
    let mut random = Random(11);
    let (mut condensed, mut found, mut clear) = (Condensed::default(), Solution::default(), 0);
    for case in 0..200 {
        let groups = 2 + case % 2;
        let (n, m) = (3 * groups + 2, 2 * groups);
        // Strides without a common factor mix the groups.
        let group = |i: usize| (7 * i) % groups;
        let root = random.matrix(n, n);
        let dense = root.t_mul(&root);
        let with = |i: usize, j: usize| f64::from(group(i) == group(j));
        let mass = Matrix::from_fn(n, n, |i, j| dense[(i, j)] * with(i, j) + f64::from(i == j));
        let plain = random.matrix(m, n);
        let mut g = Matrix::from_fn(m, n, |i, j| plain[(i, j)] * with(i, j));
        // One row twice: a self-stress.
        let twice = g.row(0).to_vec();
        g.row_mut(groups).copy_from_slice(&twice);
        let f = random.vector(n);
        let r = g.mul_vec(&random.vector(n));
        let of = unscaled(&mass, &g);
        let whole = factored(of).expect("factors");
        let mut parts = Islands::default();
        parts.refactor(of).expect("factors");
        let (a, b) = (parts.solve(&f, &r), whole.solve(&f, &r));
        assert!(distance(&a.a, &b.a) < 1e-9, "case {case}: accelerations");
        assert!(distance(&a.lambda, &b.lambda) < 1e-9, "case {case}: multipliers");
        assert_eq!((parts.rank().rank, parts.dof()), (whole.rank().rank, whole.dof()));
        assert_eq!(IslandRank::default().find(&g).rank, whole.rank().rank);
        if condensed.refactor(&mass, &g, None) {
            condensed.solve_into(&f, &r, &mut found);
            assert!(distance(&found.a, &b.a) < 1e-9 && found.inconsistency == 0.0, "case {case}: by multipliers");
            let loads = g.t_mul(&condensed.self_stress());
            assert_eq!(loads.cols(), m - whole.rank().rank);
            assert!(
                loads.data().iter().all(|x| x.abs() < 1e-9),
                "case {case}: a self-stress by multipliers that loads"
            );
            clear += 1;
        }
        let stress = parts.self_stress();
        assert_eq!((stress.cols(), parts.motions().cols()), (m - whole.rank().rank, whole.dof()));
        // A sum of rows moves with nothing, any other row with something.
        let mut sum = vec![0.0; n];
        g.add_t_mul_vec(&random.vector(m), &mut sum);
        assert!(!parts.moves(&sum) && parts.moves(&random.vector(n)), "case {case}");
        let left = g.t_mul(&stress);
        assert!(left.data().iter().all(|x| x.abs() < 1e-12), "case {case}: a self-stress that loads");
        let moved = g.mul(&parts.motions());
        assert!(moved.data().iter().all(|x| x.abs() < 1e-12), "case {case}: a motion that is excluded");
    }
    assert!(clear > 20, "{clear}");
}
