use super::super::{jacobi_svd, max_abs, Lu, Matrix, Orthogonal};
use super::{difference, distance, Random};

#[test]
fn lu_residual_is_round_off() {
    for seed in 0..200 {
        let mut random = Random(seed);
        let n = random.index(1, 25);
        let (a, b) = (random.matrix(n, n), random.vector(n));
        let lu = Lu::factor(&a).unwrap();
        let x = lu.solve(&b);
        // One refinement makes the backward error a few ε (Higham, §12.2).
        let size = n as f64 * max_abs(&x) + max_abs(&b);
        assert!(distance(&a.mul_vec(&x), &b) * max_abs(&b) < 1e-15 * size, "seed {seed}");
    }
}

#[test]
fn lu_names_the_dependent_column_and_its_combination() {
    for seed in 0..100 {
        let mut random = Random(seed);
        let n = random.index(2, 12);
        let column = random.index(1, n);
        let mut a = random.matrix(n, n);
        let weights = random.vector(column);
        for i in 0..n {
            a[(i, column)] = (0..column).map(|j| weights[j] * a[(i, j)]).sum();
        }
        let mut lu = Lu::default();
        let error = lu.refactor(&a, 1e-13).unwrap_err();
        assert_eq!(error.column, column, "seed {seed}");
        // Round-off times the condition of the leading columns, which is random.
        assert!(max_abs(&a.mul_vec(&lu.null_vector(column))) < 1e-11, "seed {seed}");
    }
}

#[test]
fn condition_estimate_is_close_from_below() {
    for seed in 0..100 {
        let mut random = Random(seed);
        let n = random.index(1, 12);
        let a = random.matrix(n, n);
        let lu = Lu::factor(&a).unwrap();
        let norm = |a: &Matrix| {
            let column = |j| (0..n).map(|i| a[(i, j)].abs()).sum::<f64>();
            (0..n).map(column).fold(0.0, f64::max)
        };
        let columns: Vec<Vec<f64>> = (0..n).map(|j| lu.solve(Matrix::identity(n).row(j))).collect();
        let exact = norm(&a) * norm(&Matrix::from_fn(n, n, |i, j| columns[j][i]));
        let estimate = lu.condition();
        assert!(estimate <= exact * (1.0 + 1e-9) && estimate > 0.2 * exact, "seed {seed}");
    }
}

#[test]
fn svd_reproduces_the_matrix() {
    for seed in 0..100 {
        let mut random = Random(seed);
        let (m, n) = (random.index(1, 9), random.index(1, 9));
        let a = random.matrix(m, n);
        let svd = jacobi_svd(&a);
        let scaled = Matrix::from_fn(m, n, |k, j| svd.values[k] * svd.right[(k, j)]);
        assert!(difference(&svd.left.t_mul(&scaled), &a) < 1e-14, "seed {seed}");
        let gram = svd.left.t_mul(&svd.left);
        assert!(difference(&gram, &Matrix::identity(m)) < 1e-14, "seed {seed}");
        assert!(svd.values.windows(2).all(|w| w[0] >= w[1]));
    }
}

/// A product of random factors: m × n of rank r.
fn of_rank(random: &mut Random, m: usize, n: usize, r: usize) -> Matrix {
    random.matrix(m, r).mul(&random.matrix(r, n))
}

#[test]
fn orthogonal_bases_split_both_spaces() {
    for seed in 0..300 {
        let mut random = Random(seed);
        let (m, n) = (random.index(0, 9), random.index(1, 9));
        let r = random.index(0, m.min(n) + 1);
        let g = of_rank(&mut random, m, n, r);
        let o = Orthogonal::factor(&g);
        assert_eq!((o.rank().rank, o.rank().uncertain), (r, false), "seed {seed}");
        assert!(difference(&o.x().mul(&transposed(o.x())), &Matrix::identity(n)) < 1e-14);
        assert!(difference(&o.y().mul(&transposed(o.y())), &Matrix::identity(m)) < 1e-14);
        for k in r..n {
            assert!(max_abs(&g.mul_vec(o.x().row(k))) < 1e-13, "seed {seed}");
        }
        for k in r..m {
            let mut stress = vec![0.0; n];
            g.add_t_mul_vec(o.y().row(k), &mut stress);
            assert!(max_abs(&stress) < 1e-13, "seed {seed}");
        }
    }
}

#[test]
fn solutions_in_both_spaces_are_exact_and_least() {
    for seed in 0..300 {
        let mut random = Random(seed);
        let (m, n) = (random.index(1, 9), random.index(1, 9));
        let r = random.index(1, m.min(n) + 1);
        let g = of_rank(&mut random, m, n, r);
        let o = Orthogonal::factor(&g);
        let b = g.mul_vec(&random.vector(n));
        let mut x = vec![0.0; n];
        o.add_solution(&b, &mut x);
        // The condition of a product of random factors reaches 1e3 or so.
        assert!(distance(&g.mul_vec(&x), &b) < 1e-12, "seed {seed}");
        assert!((r..n).all(|k| super::super::dot(o.x().row(k), &x).abs() < 1e-12 * max_abs(&x)));
        let (mut c, mut back) = (vec![0.0; n], vec![0.0; n]);
        g.add_t_mul_vec(&random.vector(m), &mut c);
        let mut y = vec![0.0; m];
        o.add_transposed_solution(&c, &mut y);
        g.add_t_mul_vec(&y, &mut back);
        assert!(distance(&back, &c) < 1e-12, "seed {seed}");
        assert!((r..m).all(|k| super::super::dot(o.y().row(k), &y).abs() < 1e-12 * max_abs(&y)));
    }
}

/// Rows whose singular values are given.
fn with_values(random: &mut Random, values: &[f64]) -> Matrix {
    let m = values.len();
    let (left, right) = (random.matrix(m, m), random.matrix(m, m));
    let (left, right) = (Orthogonal::factor(&left), Orthogonal::factor(&right));
    let scaled = Matrix::from_fn(m, m, |k, j| values[k] * right.x()[(k, j)]);
    left.x().t_mul(&scaled)
}

#[test]
fn a_gap_decides_the_rank_and_its_absence_is_admitted() {
    for seed in 0..50 {
        let mut random = Random(seed);
        let clear = with_values(&mut random, &[1.0, 0.3, 1e-5, 1e-13]);
        let rank = Orthogonal::factor(&clear).rank();
        assert_eq!((rank.rank, rank.uncertain), (3, false), "seed {seed}");
        assert!(rank.kept > 1e-6 && rank.kept < 1e-4 && rank.dropped < 1e-12);
        let doubtful = with_values(&mut random, &[1.0, 0.3, 1e-9, 2e-11]);
        let o = Orthogonal::factor(&doubtful);
        assert_eq!((o.rank().rank, o.rank().uncertain), (3, true), "seed {seed}");
        assert!((o.rank().kept / 1e-9 - 1.0).abs() < 1e-5, "the singular values were used");
        assert!(max_abs(&doubtful.mul_vec(o.x().row(3))) < 3e-11, "seed {seed}");
    }
}

fn transposed(a: &Matrix) -> Matrix {
    Matrix::from_fn(a.cols(), a.rows(), |i, j| a[(j, i)])
}
