use super::super::{max_abs, minimum_degree, Factor, Matrix, Pattern};
use super::{distance, factored, unscaled, Random};

/// Rigid bars with pins, in the plane: three unknowns to a bar, two rows to a pin.
struct Truss {
    masses: Vec<[f64; 9]>,
    /// (bar, pin, 2 × 3 block of G).
    levers: Vec<(usize, usize, [f64; 6])>,
    pins: usize,
}

impl Truss {
    /// Bars between points, of which the first `fixed` belong to the ground.
    fn new(points: &[[f64; 2]], bars: &[(usize, usize)], fixed: usize, mass: impl FnMut() -> f64) -> Truss {
        let mut truss = Truss { masses: Vec::new(), levers: Vec::new(), pins: 0 };
        let mut ends = vec![Vec::new(); points.len()];
        for (k, &(i, j)) in bars.iter().enumerate() {
            let middle = [0, 1].map(|c| 0.5 * (points[i][c] + points[j][c]));
            ends[i].push((k, middle));
            ends[j].push((k, middle));
        }
        truss.set_masses(points, bars, mass);
        for (point, ends) in points.iter().zip(&ends).take(fixed) {
            for &(bar, middle) in ends {
                truss.pin(*point, &[(bar, middle, 1.0)]);
            }
        }
        for (point, ends) in points.iter().zip(&ends).skip(fixed) {
            for w in ends.windows(2) {
                truss.pin(*point, &[(w[0].0, w[0].1, 1.0), (w[1].0, w[1].1, -1.0)]);
            }
        }
        truss
    }

    fn set_masses(&mut self, p: &[[f64; 2]], bars: &[(usize, usize)], mut mass: impl FnMut() -> f64) {
        for &(i, j) in bars {
            let square: f64 = (0..2).map(|c| (p[i][c] - p[j][c]) * (p[i][c] - p[j][c])).sum();
            let m = mass();
            self.masses.push([m, 0.0, 0.0, 0.0, m, 0.0, 0.0, 0.0, m * square / 12.0]);
        }
    }

    fn pin(&mut self, p: [f64; 2], ends: &[(usize, [f64; 2], f64)]) {
        for &(bar, c, s) in ends {
            let block = [s, 0.0, -s * (p[1] - c[1]), 0.0, s, s * (p[0] - c[0])];
            self.levers.push((bar, self.pins, block));
        }
        self.pins += 1;
    }

    fn bars(&self) -> usize {
        self.masses.len()
    }

    fn pattern(&self) -> Pattern {
        let n = self.bars();
        let edges: Vec<_> = self.levers.iter().map(|&(bar, pin, _)| (n + pin, bar)).collect();
        Pattern::new(&vec![3; n], &vec![2; self.pins], &edges)
    }

    fn factor(&self) -> Factor {
        let n = self.bars();
        let mut factor = Factor::new(&self.pattern());
        let masses = self.masses.iter().enumerate().map(|(i, m)| (i, i, &m[..]));
        let levers = self.levers.iter().map(|(bar, pin, g)| (n + pin, *bar, &g[..]));
        factor.refactor(masses.chain(levers));
        factor
    }

    fn g(&self) -> Matrix {
        let mut g = Matrix::zeros(2 * self.pins, 3 * self.bars());
        for (bar, pin, block) in &self.levers {
            (0..6).for_each(|k| g[(2 * pin + k / 3, 3 * bar + k % 3)] = block[k]);
        }
        g
    }

    fn mass(&self) -> Matrix {
        let n = 3 * self.bars();
        Matrix::from_fn(n, n, |i, j| if i == j { self.masses[i / 3][4 * (i % 3)] } else { 0.0 })
    }

    /// Random forces, and rows that a motion satisfies.
    fn loads(&self, random: &mut Random) -> Vec<f64> {
        let n = 3 * self.bars();
        let (mut rhs, motion) = (random.vector(n), random.vector(n));
        rhs.resize(n + 2 * self.pins, 0.0);
        for (bar, pin, block) in &self.levers {
            for k in 0..6 {
                rhs[n + 2 * pin + k / 3] += block[k] * motion[3 * bar + k % 3];
            }
        }
        rhs
    }

    /// Accelerations by the dense solver, with K's sign of λ.
    fn dense(&self, rhs: &[f64]) -> Vec<f64> {
        let n = 3 * self.bars();
        let saddle = factored(unscaled(&self.mass(), &self.g())).unwrap();
        saddle.solve(&rhs[..n], &rhs[n..]).a
    }
}

/// A ladder of bays on a foot of two fixed points: rails, rungs and as many diagonals as asked for.
/// Without diagonals each bay shears; with one it is rigid; with two it is redundant as well.
fn ladder(random: &mut Random, bays: usize, diagonals: usize) -> (Vec<[f64; 2]>, Vec<(usize, usize)>) {
    let point = |k: usize| [(k % 2) as f64, (k / 2) as f64];
    let points = (0..2 * bays + 2).map(|k| point(k).map(|c| c + 0.1 * random.unit())).collect();
    let mut bars = Vec::new();
    for k in (0..2 * bays).step_by(2) {
        bars.extend([(k, k + 2), (k + 1, k + 3), (k + 2, k + 3)]);
        bars.extend([(k, k + 3), (k + 1, k + 2)].iter().take(diagonals));
    }
    (points, bars)
}

/// Solves both ways and returns the distance of the accelerations.
fn against_dense(truss: &Truss, random: &mut Random) -> f64 {
    let rhs = truss.loads(random);
    let mut x = vec![0.0; rhs.len()];
    let accuracy = truss.factor().solve(&rhs, &mut x).unwrap();
    assert!(accuracy.residual < 1e-14, "{accuracy:?}");
    let a = truss.dense(&rhs);
    distance(&x[..a.len()], &a)
}

#[test]
fn agrees_with_the_dense_solver() {
    // Accelerations come with an error of ε times the condition: that of a beam of eight bays is 1e3
    // or so, and masses over six decades add to it.
    for (diagonals, decades, tolerance) in [(0, 0.0, 1e-13), (1, 1.0, 1e-12), (2, 3.0, 1e-11)] {
        for seed in 0..60 {
            let mut random = Random(seed);
            let bays = random.index(1, 9);
            let (points, bars) = ladder(&mut random, bays, diagonals);
            let mut masses = Random(seed + 1000);
            let truss = Truss::new(&points, &bars, 2, || masses.decades(decades));
            let distance = against_dense(&truss, &mut random);
            assert!(distance < tolerance, "{diagonals} diagonals, seed {seed}: {distance:e}");
        }
    }
}

#[test]
fn massless_bars_are_solved_where_the_rest_carries_inertia() {
    for seed in 0..60 {
        let mut random = Random(seed);
        let bays = random.index(1, 9);
        let diagonals = random.index(0, 3);
        let (points, bars) = ladder(&mut random, bays, diagonals);
        // Rungs and diagonals, whose ends move with the rails.
        let mut bar = 0;
        let truss = Truss::new(&points, &bars, 2, || {
            bar += 1;
            if (bar - 1) % (3 + diagonals) < 2 {
                1.0
            } else {
                0.0
            }
        });
        let distance = against_dense(&truss, &mut random);
        assert!(distance < 1e-12, "seed {seed}: {distance:e}");
    }
}

#[test]
fn a_nearly_singular_toggle_is_resolved() {
    for seed in 0..20 {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 1e-5]];
        let truss = Truss::new(&points, &[(0, 2), (2, 1)], 2, || 1.0);
        // The smallest singular value is some 1e-5 of the largest: ε/σ = 1e-11, and a margin.
        let distance = against_dense(&truss, &mut Random(seed));
        assert!(distance < 1e-10, "seed {seed}: {distance:e}");
    }
}

#[test]
fn redundant_rows_share_their_load() {
    // One bar pinned twice to the same point of the ground.
    let mut truss = Truss::new(&[[0.0, 0.0], [1.0, 0.0]], &[(0, 1)], 1, || 1.0);
    truss.pin([0.0, 0.0], &[(0, [0.5, 0.0], 1.0)]);
    let rhs = [0.0, -9.81, 0.0, 0.0, 0.0, 0.0, 0.0];
    let mut x = [0.0; 7];
    truss.factor().solve(&rhs, &mut x).unwrap();
    // The pin of a rod carries a quarter of the weight; each of two an eighth.
    let exact = [0.0, -0.75 * 9.81, -1.5 * 9.81, 0.0, -9.81 / 8.0, 0.0, -9.81 / 8.0];
    // Round-off over the shift of rows, 1e-16/1e-9, passes between them.
    assert!(distance(&x[..3], &exact[..3]) < 1e-14 && distance(&x, &exact) < 1e-6, "{x:?}");
}

#[test]
fn contradictory_rows_name_their_joint() {
    let mut truss = Truss::new(&[[0.0, 0.0], [1.0, 0.0]], &[(0, 1)], 1, || 1.0);
    truss.pin([0.0, 0.0], &[(0, [0.5, 0.0], 1.0)]);
    let mut x = [0.0; 7];
    let error = truss.factor().solve(&[0.0, 0.0, 0.0, 1.0, 0.0, 2.0, 0.0], &mut x).unwrap_err();
    assert!(error.node == 1 || error.node == 2, "{error}");
    assert!(error.residual > 1e-3, "{error}");
}

#[test]
fn a_slight_contradiction_leaves_no_trace_in_the_multipliers() {
    let mut truss = Truss::new(&[[0.0, 0.0], [1.0, 0.0]], &[(0, 1)], 1, || 1.0);
    truss.pin([0.0, 0.0], &[(0, [0.5, 0.0], 1.0)]);
    let mut x = [0.0; 7];
    truss.factor().solve(&[0.0, -9.81, 0.0, 0.0, 1e-10, 0.0, -1e-10], &mut x).unwrap();
    assert!((x[4] + 9.81 / 8.0).abs() < 1e-8 && (x[6] + 9.81 / 8.0).abs() < 1e-8, "{x:?}");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let truss = Truss::new(&[[0.0, 0.0], [1.0, 0.0]], &[(0, 1)], 1, || f64::NAN);
    let mut x = [0.0; 5];
    assert!(truss.factor().solve(&[1.0; 5], &mut x).is_err());
}

#[test]
fn a_long_redundant_ladder_reaches_round_off() {
    for seed in 0..5 {
        let mut random = Random(seed);
        let (points, bars) = ladder(&mut random, 300, 2);
        let mut masses = Random(seed + 1000);
        let truss = Truss::new(&points, &bars, 2, || masses.decades(3.0));
        let rhs = truss.loads(&mut random);
        let accuracy = truss.factor().solve(&rhs, &mut vec![0.0; rhs.len()]).unwrap();
        assert!(accuracy.residual < 1e-14 && accuracy.iterations < 60, "{accuracy:?}");
    }
}

#[test]
fn the_fill_of_a_ladder_is_linear() {
    let fill = |bays: usize| {
        let (points, bars) = ladder(&mut Random(0), bays, 1);
        let pattern = Truss::new(&points, &bars, 2, || 1.0).pattern();
        (pattern.fill() as f64 / bays as f64, pattern.flops() / bays as f64)
    };
    let (short, long) = (fill(100), fill(2500));
    assert!((long.0 / short.0 - 1.0).abs() < 0.05, "{short:?} {long:?}");
    assert!((long.1 / short.1 - 1.0).abs() < 0.1, "{short:?} {long:?}");
}

/// Edges that elimination in this order would add.
fn added(n: usize, edges: &[(usize, usize)], order: &[usize]) -> usize {
    let mut near = vec![std::collections::BTreeSet::new(); n];
    for &(i, j) in edges {
        near[i].insert(j);
        near[j].insert(i);
    }
    let mut count = 0;
    for &p in order {
        let clique: Vec<usize> = std::mem::take(&mut near[p]).into_iter().collect();
        for &i in &clique {
            near[i].remove(&p);
            count += clique.iter().filter(|&&j| j != i && near[i].insert(j)).count();
        }
    }
    count / 2
}

#[test]
fn orders_are_permutations_without_fill_on_trees() {
    for seed in 0..100 {
        let mut random = Random(seed);
        let n = random.index(1, 400);
        let tree: Vec<_> = (1..n).map(|i| (random.index(0, i), i)).collect();
        let order = minimum_degree(&vec![1; n], &tree);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..n), "seed {seed}");
        assert_eq!(added(n, &tree, &order), 0, "seed {seed}");
    }
}

#[test]
fn a_ring_fills_as_little_as_it_can() {
    let ring: Vec<_> = (0..500).map(|i| (i, (i + 1) % 500)).collect();
    assert_eq!(added(500, &ring, &minimum_degree(&[3; 500], &ring)), 497);
}

#[test]
fn chains_hubs_and_ladders_of_twenty_thousand_nodes_are_ordered_whole() {
    let chain: Vec<_> = (1..20_000).map(|i| (i - 1, i)).collect();
    let hub: Vec<_> = (1..20_000).map(|i| (0, i)).collect();
    let rungs = (0..19_998).step_by(2).map(|i| (i, i + 1));
    let ladder: Vec<_> = (2..20_000).map(|i| (i - 2, i)).chain(rungs).collect();
    let both = [&chain[..], &hub].concat();
    for edges in [&chain, &hub, &ladder, &both] {
        let mut order = minimum_degree(&vec![3; 20_000], edges);
        order.sort_unstable();
        assert!(order.into_iter().eq(0..20_000));
    }
}

#[test]
fn refactoring_repeats_to_the_bit() {
    let mut random = Random(7);
    let (points, bars) = ladder(&mut random, 20, 2);
    let truss = Truss::new(&points, &bars, 2, || 1.0);
    let rhs = truss.loads(&mut random);
    let (mut first, mut second) = (vec![0.0; rhs.len()], vec![0.0; rhs.len()]);
    truss.factor().solve(&rhs, &mut first).unwrap();
    truss.factor().solve(&rhs, &mut second).unwrap();
    assert_eq!(first, second);
    assert!(max_abs(&first) > 0.0);
}
