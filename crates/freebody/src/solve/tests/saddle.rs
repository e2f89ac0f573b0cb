use super::super::{max_abs, Condensed, Equations, Lu, Matrix, Quasidefinite, Saddle, SaddleError, Solution};
use super::{distance, factored, unscaled, Random};

/// A random instant: n unknowns, m rows of rank r, masses over two decades either way.
struct Instant {
    mass: Matrix,
    g: Matrix,
    b: Matrix,
    f: Vec<f64>,
    r: Vec<f64>,
    rows: Vec<f64>,
    cols: Vec<f64>,
}

impl Instant {
    fn new(random: &mut Random, n: usize, m: usize, rank: usize) -> Instant {
        let root = random.matrix(n, n);
        let mut mass = root.t_mul(&root);
        (0..n).for_each(|i| mass[(i, i)] += random.decades(1.0));
        let mix = random.matrix(m, rank);
        let (g, b) = (mix.mul(&random.matrix(rank, n)), mix.mul(&random.matrix(rank, n)));
        let r = g.mul_vec(&random.vector(n));
        Instant {
            mass,
            g,
            b,
            f: random.vector(n),
            r,
            rows: (0..m).map(|_| random.decades(1.0)).collect(),
            cols: (0..n).map(|_| random.decades(1.0)).collect(),
        }
    }

    fn equations<'a>(&'a self, b: Option<&'a Matrix>) -> Equations<'a> {
        Equations { mass: &self.mass, g: &self.g, b, row_scale: &self.rows, col_scale: &self.cols }
    }

    fn factor(&self, b: Option<&Matrix>) -> Result<Saddle, SaddleError> {
        factored(self.equations(b))
    }

    /// The largest residual as a fraction of the largest term, in forces and in rows.
    fn residual(&self, b: &Matrix, s: &Solution) -> f64 {
        let mut forces = self.f.clone();
        b.add_t_mul_vec(&s.lambda, &mut forces);
        let inertia = self.mass.mul_vec(&s.a);
        let size = max_abs(&inertia) + max_abs(&s.lambda) + max_abs(&self.f);
        let left = distance(&forces, &inertia) * max_abs(&inertia) / size;
        let rows = self.g.mul_vec(&s.a);
        left.max(distance(&rows, &self.r) * max_abs(&self.r) / max_abs(&s.a).max(1.0))
    }

    /// (a, λ) by LU of the whole matrix.
    fn whole(&self, b: &Matrix) -> Vec<f64> {
        let (n, m) = (self.f.len(), self.r.len());
        let whole = Matrix::from_fn(n + m, n + m, |i, j| match (i < n, j < n) {
            (true, true) => self.mass[(i, j)],
            (true, false) => -b[(j - n, i)],
            (false, true) => self.g[(i - n, j)],
            (false, false) => 0.0,
        });
        Lu::factor(&whole).unwrap().solve(&[&self.f[..], &self.r].concat())
    }
}

/// Sizes with 0 ≤ m ≤ n, both ends included: trees and fully prescribed mechanisms.
fn sizes(random: &mut Random) -> (usize, usize) {
    let n = random.index(1, 16);
    (n, random.index(0, n + 1))
}

#[test]
fn agrees_with_lu_of_the_whole_matrix() {
    for seed in 0..400 {
        let mut random = Random(seed);
        let (n, m) = sizes(&mut random);
        let p = Instant::new(&mut random, n, m, m);
        for (b, used) in [(None, &p.g), (Some(&p.b), &p.b)] {
            let s = p.factor(b).unwrap().solve(&p.f, &p.r);
            // Refined once, both are backward stable; they differ by ε times the condition.
            assert!(p.residual(used, &s) < 2e-14, "seed {seed}");
            let both = [&s.a[..], &s.lambda].concat();
            assert!(distance(&both, &p.whole(used)) < 1e-9, "seed {seed}");
        }
    }
}

/// By the multipliers alone, or by elimination in order, clear equations have the same motion and loads; others are declined. Rows
/// that depend on others are no obstacle to the multipliers where they agree.
#[test]
fn clear_equations_have_the_same_solution_or_are_declined() {
    let (mut condensed, mut definite) = (Condensed::default(), Quasidefinite::default());
    let (mut found, mut solved) = (Solution::default(), [0; 3]);
    for seed in 0..600 {
        let mut random = Random(seed);
        let n = random.index(1, 9);
        let (rank, spare) = (random.index(1, n + 1), random.index(0, 4) / 2);
        let mut p = Instant::new(&mut random, n, rank + spare, rank);
        for (b, used) in [(None, &p.g), (Some(&p.b), &p.b)] {
            if !condensed.refactor(&p.mass, &p.g, b) {
                continue;
            }
            condensed.solve_into(&p.f, &p.r, &mut found);
            // Pivots of a thousandth, twice.
            let exact = p.factor(b).unwrap().solve(&p.f, &p.r);
            assert!(distance(&found.a, &exact.a) < 1e-9, "seed {seed}: {:e}", distance(&found.a, &exact.a));
            assert!(p.residual(used, &found) < 1e-11 && found.inconsistency == 0.0, "seed {seed}");
            solved[usize::from(spare > 0)] += 1;
        }
        if definite.refactor(&p.mass, &p.g, &p.cols) {
            assert_eq!(spare, 0, "seed {seed}: a redundant row");
            definite.solve_into(&p.f, &p.r, &mut found);
            let exact = p.factor(None).unwrap().solve(&p.f, &p.r);
            let apart = distance(&found.a, &exact.a).max(distance(&found.lambda, &exact.lambda));
            // Pivots of a hundredth: conditions of 1e4 at most.
            assert!(apart < 1e-11, "seed {seed}: {apart:e}");
            solved[2] += 1;
        }
        if spare > 0 && condensed.refactor(&p.mass, &p.g, None) {
            p.r[rank] += 1.0;
            condensed.solve_into(&p.f, &p.r, &mut found);
            assert!(found.inconsistency > 1e-3, "seed {seed}: rows that contradict each other");
            let b = random.matrix(rank + spare, n);
            assert!(rank == n || !condensed.refactor(&p.mass, &p.g, Some(&b)), "seed {seed}: more forces than rows");
        }
    }
    assert!(solved.iter().all(|&solved| solved > 50), "{solved:?}");
    let massless = Matrix::from_fn(2, 2, |i, j| f64::from(i + j == 0));
    assert!(!condensed.refactor(&massless, &Matrix::zeros(0, 2), None));
    assert!(!definite.refactor(&massless, &Matrix::zeros(0, 2), &[1.0; 2]));
}

#[test]
fn redundant_rows_leave_the_motion_unchanged() {
    for seed in 0..400 {
        let mut random = Random(seed);
        let n = random.index(2, 14);
        let rank = random.index(1, n + 1);
        let m = rank + random.index(1, 5);
        let p = Instant::new(&mut random, n, m, rank);
        let saddle = p.factor(None).unwrap();
        let s = saddle.solve(&p.f, &p.r);
        assert!(p.residual(&p.g, &s) < 1e-13, "seed {seed}");
        let short = |a: &Matrix| Matrix::from_fn(rank, n, |i, j| a[(i, j)]);
        let independent =
            factored(Equations { g: &short(&p.g), row_scale: &p.rows[..rank], ..p.equations(None) }).unwrap();
        let a = independent.solve(&p.f, &p.r[..rank]).a;
        // Random rows reach conditions of 1e4 or so.
        assert!(distance(&s.a, &a) < 1e-11, "seed {seed}: {:e}", distance(&s.a, &a));
        self_stress_balances_itself(&p, &saddle, m - rank);
        multipliers_are_least(&p, &saddle, &s);
    }
}

fn self_stress_balances_itself(p: &Instant, saddle: &Saddle, count: usize) {
    let stress = saddle.self_stress();
    assert_eq!((stress.rows(), stress.cols()), (p.r.len(), count));
    for j in 0..count {
        let column: Vec<f64> = (0..stress.rows()).map(|i| stress[(i, j)]).collect();
        let mut force = vec![0.0; p.f.len()];
        p.g.add_t_mul_vec(&column, &mut force);
        assert!(max_abs(&force) < 1e-12);
        assert_eq!(column.iter().copied().fold(0.0, f64::max), 1.0);
    }
    let gram = stress.t_mul(&stress);
    assert!(count == 0 || Lu::factor(&gram).is_ok(), "independent");
}

/// Scaled, the multipliers are orthogonal to every self-stress.
fn multipliers_are_least(p: &Instant, saddle: &Saddle, s: &Solution) {
    let stress = saddle.self_stress();
    let scaled: Vec<f64> = s.lambda.iter().zip(&p.rows).map(|(l, r)| l / (r * r)).collect();
    let mut along = vec![0.0; stress.cols()];
    stress.add_t_mul_vec(&scaled, &mut along);
    assert!(max_abs(&along) < 1e-11 * max_abs(&scaled));
}

#[test]
fn contradictory_rows_are_reported() {
    let (mass, g) = (Matrix::identity(2), Matrix::from_fn(2, 2, |_, j| [1.0, 0.0][j]));
    let saddle = factored(unscaled(&mass, &g)).unwrap();
    let agreeing = saddle.solve(&[0.0, 1.0], &[3.0, 3.0]);
    assert!(agreeing.inconsistency < 1e-15);
    let contradictory = saddle.solve(&[0.0, 1.0], &[3.0, 4.0]);
    assert!((contradictory.inconsistency - 0.5).abs() < 1e-15);
    assert!(distance(&contradictory.a, &[3.5, 1.0]) < 1e-15, "the least-squares compromise");
}

/// Takes away all inertia along the row space of G (and along `also`).
fn without_inertia(p: &mut Instant, also: Option<&[f64]>) {
    let n = p.f.len();
    let extra = also.map_or(0, |_| 1);
    let rows =
        Matrix::from_fn(p.g.rows() + extra, n, |i, j| if i < p.g.rows() { p.g[(i, j)] } else { also.unwrap()[j] });
    let kernel = factored(unscaled(&Matrix::identity(n), &rows)).unwrap().motions();
    let along = Matrix::from_fn(kernel.cols(), n, |k, j| kernel[(j, k)]);
    p.mass = along.t_mul(&along);
}

#[test]
fn a_singular_mass_matrix_that_is_definite_on_the_kernel_is_enough() {
    for seed in 0..200 {
        let mut random = Random(seed);
        let (n, m) = sizes(&mut random);
        let mut p = Instant::new(&mut random, n, m, m);
        without_inertia(&mut p, None);
        let s = p.factor(None).unwrap().solve(&p.f, &p.r);
        assert!(p.residual(&p.g, &s) < 1e-13, "seed {seed}");
        assert!(distance(&[&s.a[..], &s.lambda].concat(), &p.whole(&p.g)) < 1e-7, "seed {seed}");
    }
}

#[test]
fn a_motion_without_inertia_is_named() {
    for seed in 0..200 {
        let mut random = Random(seed);
        let n = random.index(2, 12);
        let m = random.index(0, n);
        let mut p = Instant::new(&mut random, n, m, m);
        let also = random.vector(n);
        without_inertia(&mut p, Some(&also));
        let Err(SaddleError::ZeroInertia { direction }) = p.factor(None) else { panic!("seed {seed}: not refused") };
        assert!(max_abs(&direction) > 0.05, "seed {seed}");
        // Both vanish to round-off times the condition of the rows.
        assert!(max_abs(&p.mass.mul_vec(&direction)) < 1e-10 * max_abs(&direction), "seed {seed}");
        let moved = max_abs(&p.g.mul_vec(&direction));
        assert!(moved < 1e-12 * max_abs(&direction).max(1.0), "seed {seed}");
    }
}

#[test]
fn actuators_must_reach_the_prescribed_motion() {
    let mass = Matrix::identity(2);
    let g = Matrix::from_fn(1, 2, |_, j| [1.0, 0.0][j]);
    let beside = Matrix::from_fn(1, 2, |_, j| [0.0, 1.0][j]);
    let error = factored(Equations { b: Some(&beside), ..unscaled(&mass, &g) }).unwrap_err();
    assert!(matches!(error, SaddleError::InsufficientActuation { .. }), "{error}");
    let none = Matrix::zeros(1, 2);
    let error = factored(Equations { b: Some(&none), ..unscaled(&mass, &g) }).unwrap_err();
    assert_eq!(error, SaddleError::RankMismatch { motion: 1, force: 0 });
}

#[test]
fn refactoring_is_the_same_as_factoring() {
    let mut reused = Saddle::default();
    for seed in 0..100 {
        let mut random = Random(seed);
        let (n, m) = sizes(&mut random);
        let p = Instant::new(&mut random, n, m, m);
        let b = (seed % 2 == 0).then_some(&p.b);
        reused.refactor(p.equations(b)).unwrap();
        assert_eq!(reused.solve(&p.f, &p.r), p.factor(b).unwrap().solve(&p.f, &p.r));
        assert_eq!(reused.dof(), n - m);
    }
}
