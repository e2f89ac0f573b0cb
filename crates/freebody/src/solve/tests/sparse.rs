use super::super::{max_abs, minimum_degree, Factor, Matrix, Pattern, Saddle};
use super::{distance, Random};

/// Rigid bars with pins, in the plane: three unknowns to a bar, two rows to a pin.
struct Truss {
    masses: Vec<[f64; 9]>,
    /// (bar, pin, 2 × 3 block of G).
    levers: Vec<(usize, usize, [f64; 6])>,
    pins: usize,
}

impl Truss {
    /// Bars between points; point 0 and the points in `fixed` belong to the ground.
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
        let (n, g) = (3 * self.bars(), self.g());
        let (rows, cols) = (vec![1.0; g.rows()], vec![1.0; n]);
        let saddle = Saddle::factor(&self.mass(), &g, None, &rows, &cols).unwrap();
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

#[test]
fn experiment() {
    for (name, diagonals, decades, massless) in [("shear",0,0.0,0.0),("shear m",0,3.0,0.0),("rigid",1,0.0,0.0),("rigid m",1,3.0,0.0),("redundant",2,0.0,0.0),("redundant m",2,3.0,0.0),("shear massless",0,0.0,0.5),("rigid massless",1,1.0,0.5),("redundant massless",2,1.0,0.5), ("all massless", 2, 0.0, 1.0)] {
        for bays in [1, 4, 300] {
        let (mut worst, mut its, mut diff, mut fails, mut tot) = (0.0f64, 0, 0.0f64, 0, 0);
        for seed in 0..40 {
            let mut random = Random(seed);
            let (points, bars) = ladder(&mut random, bays, diagonals);
            // the rails stay massive
            let mut k = 0;
            let per = 3 + diagonals;
            let truss = Truss::new(&points, &bars, 2, || { let m = random.decades(decades); let u = 0.5*(random.unit()+1.0); k += 1; if u < massless && ((k - 1) % per >= 2 || massless == 1.0) { 0.0 } else { m } });
            let rhs = truss.loads(&mut random);
            let mut x = vec![0.0; rhs.len()];
            match truss.factor().solve(&rhs, &mut x) {
                Ok(acc) => { worst = worst.max(acc.residual); its = its.max(acc.iterations); tot += acc.iterations; }
                Err(e) => { fails += 1; worst = worst.max(e.residual); }
            }
            if bays < 10 { if let Some(a) = std::panic::catch_unwind(|| truss.dense(&rhs)).ok() { diff = diff.max(distance(&x[..a.len()], &a)); } else { println!("zero inertia"); } }
        }
        println!("{name:20} bays {bays} worst {worst:.1e} its {its} mean {:.1} diff {diff:.1e} fails {fails}", tot as f64/40.0);
    } }
    for bays in [300, 1000, 5000] {
        let mut random = Random(1);
        let (points, bars) = ladder(&mut random, bays, 1);
        let truss = Truss::new(&points, &bars, 2, || 1.0);
        let t = std::time::Instant::now();
        let p = truss.pattern();
        println!("nodes {} analyse {:?} fill/unknown {:.1} flops {:.1e}", truss.bars()+truss.pins, t.elapsed(), p.fill() as f64/p.unknowns() as f64, p.flops());
        let t = std::time::Instant::now();
        let f = truss.factor();
        println!("  all factor {:?}", t.elapsed());
        let t = std::time::Instant::now();
        let rhs = truss.loads(&mut random);
        let mut x = vec![0.0; rhs.len()];
        println!("  solve {:?} {:?}", f.solve(&rhs, &mut x), t.elapsed());
    }
    let edges: Vec<_> = (0..20000).map(|i| (i, i+1)).collect();
    let t = std::time::Instant::now();
    minimum_degree(&vec![3; 20001], &edges);
    println!("chain {:?}", t.elapsed());
    let _ = max_abs(&[]);
}
