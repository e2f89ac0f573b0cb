//! Equations that fall apart into groups without a common unknown: each group is solved for itself.

use super::{largest, Matrix, Rank, Saddle, SaddleError, Solution};

/// Part of a row that is round-off.
const UNFELT: f64 = 1e-12;

/// The equations of [`Saddle`], group by group. The arithmetic grows with the cube of the largest group.
#[derive(Clone, Debug, Default)]
pub struct Islands {
    /// Numbers of rows and of unknowns.
    size: [usize; 2],
    islands: Vec<Island>,
}

#[derive(Clone, Debug, Default)]
struct Island {
    unknowns: Vec<usize>,
    rows: Vec<usize>,
    saddle: Saddle,
    /// Its parts of the matrices.
    mass: Matrix,
    g: Matrix,
    b: Matrix,
}

impl Islands {
    /// Factors other equations; arguments as those of [`Saddle::factor`]. After an error [`rank`](Self::rank),
    /// [`motions`](Self::motions) and [`self_stress`](Self::self_stress) still hold.
    pub fn refactor(
        &mut self,
        mass: &Matrix,
        g: &Matrix,
        b: Option<&Matrix>,
        row_scale: &[f64],
        col_scale: &[f64],
    ) -> Result<(), SaddleError> {
        self.size = [g.rows(), g.cols()];
        let groups = groups(mass, g, b);
        self.islands.resize_with(groups.len(), Island::default);
        let mut done = Ok(());
        for (island, (unknowns, rows)) in self.islands.iter_mut().zip(groups) {
            let part = |of: &Matrix, rows: &[usize], to: &mut Matrix| {
                to.fill(rows.len(), unknowns.len(), |i, j| of[(rows[i], unknowns[j])]);
            };
            part(mass, &unknowns, &mut island.mass);
            part(g, &rows, &mut island.g);
            b.iter().for_each(|b| part(b, &rows, &mut island.b));
            let factored = island.saddle.refactor(
                &island.mass,
                &island.g,
                b.map(|_| &island.b),
                &gather(row_scale, &rows),
                &gather(col_scale, &unknowns),
            );
            done = done.and(factored.map_err(|error| spread_out(error, &unknowns, self.size[1])));
            (island.unknowns, island.rows) = (unknowns, rows);
        }
        done
    }

    /// The rank of G and what it was decided on.
    pub fn rank(&self) -> Rank {
        let ranks = || self.islands.iter().map(|island| island.saddle.rank()).filter(|rank| rank.rank > 0);
        if ranks().next().is_none() {
            return Rank::default();
        }
        Rank {
            rank: ranks().map(|r| r.rank).sum(),
            kept: ranks().map(|r| r.kept).fold(f64::INFINITY, f64::min),
            dropped: ranks().map(|r| r.dropped).fold(0.0, f64::max),
            uncertain: ranks().any(|r| r.uncertain),
        }
    }

    /// The rank of B.
    pub fn actuation_rank(&self) -> usize {
        self.islands.iter().map(|island| island.saddle.actuation_rank()).sum()
    }

    /// Degrees of freedom: n − rank G.
    pub fn dof(&self) -> usize {
        self.islands.iter().map(|island| island.saddle.dof()).sum()
    }

    /// n × dof: the accelerations (or velocities) with G z = 0, those of each group as of [`Saddle::motions`].
    pub fn motions(&self) -> Matrix {
        self.side_by_side(self.size[1], |island| (&island.unknowns, island.saddle.motions()))
    }

    /// Whether some motion with G z = 0 changes a further row (n), beyond round-off.
    pub fn moves(&self, row: &[f64]) -> bool {
        let parts = self.islands.iter().map(|island| island.saddle.felt(&gather(row, &island.unknowns)));
        let [felt, all] = parts.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
        felt > UNFELT * UNFELT * all
    }

    /// m × d: the multipliers with Bᵀ λ = 0; the largest entry of each column is 1.
    pub fn self_stress(&self) -> Matrix {
        self.side_by_side(self.size[0], |island| (&island.rows, island.saddle.self_stress()))
    }

    fn side_by_side<'a>(&'a self, height: usize, of: impl Fn(&'a Island) -> (&'a Vec<usize>, Matrix)) -> Matrix {
        let parts: Vec<(&Vec<usize>, Matrix)> = self.islands.iter().map(of).collect();
        let mut all = Matrix::zeros(height, parts.iter().map(|(_, part)| part.cols()).sum());
        let mut first = 0;
        for (places, part) in parts {
            for (i, &place) in places.iter().enumerate() {
                all.row_mut(place)[first..first + part.cols()].copy_from_slice(part.row(i));
            }
            first += part.cols();
        }
        all
    }

    /// Solves for applied forces f (n) and right-hand sides r (m), refined once.
    pub fn solve(&self, f: &[f64], r: &[f64]) -> Solution {
        let mut all = Solution { a: vec![0.0; f.len()], lambda: vec![0.0; r.len()], inconsistency: 0.0 };
        for Island { unknowns, rows, saddle, .. } in &self.islands {
            let (f, r) = (gather(f, unknowns), gather(r, rows));
            if f.iter().chain(&r).all(|&v| v == 0.0) {
                continue;
            }
            let part = saddle.solve(&f, &r);
            unknowns.iter().zip(part.a).for_each(|(&i, a)| all.a[i] = a);
            rows.iter().zip(part.lambda).for_each(|(&i, lambda)| all.lambda[i] = lambda);
            all.inconsistency = largest([all.inconsistency, part.inconsistency].into_iter());
        }
        all
    }
}

/// The unknowns and the rows of each group; rows without unknowns go to the first, which is always there.
fn groups(mass: &Matrix, g: &Matrix, b: Option<&Matrix>) -> Vec<(Vec<usize>, Vec<usize>)> {
    let n = g.cols();
    // Of each unknown the least that it is known to be grouped with, found by way of others.
    let mut least: Vec<usize> = (0..n).collect();
    let touched = |i: usize| (0..n).filter(move |&j| g[(i, j)] != 0.0 || b.is_some_and(|b| b[(i, j)] != 0.0));
    for i in 0..n {
        join(&mut least, (0..=i).filter(|&j| mass[(i, j)] != 0.0 || i == j));
    }
    (0..g.rows()).for_each(|i| join(&mut least, touched(i)));
    let roots: Vec<usize> = (0..n).map(|i| root(&least, i)).collect();
    let mut groups: Vec<(Vec<usize>, Vec<usize>)> = vec![];
    let mut group_of = vec![0; n];
    for (i, &root) in roots.iter().enumerate() {
        if root == i {
            group_of[i] = groups.len();
            groups.push((vec![], vec![]));
        }
        groups[group_of[root]].0.push(i);
    }
    if groups.is_empty() {
        groups.push((vec![], vec![]));
    }
    for i in 0..g.rows() {
        groups[touched(i).next().map_or(0, |j| group_of[roots[j]])].1.push(i);
    }
    groups
}

fn root(least: &[usize], mut i: usize) -> usize {
    while least[i] != i {
        i = least[i];
    }
    i
}

/// Makes one group of all that are given.
fn join(least: &mut [usize], mut of: impl Iterator<Item = usize>) {
    let Some(first) = of.next() else { return };
    let mut one = root(least, first);
    for i in of {
        let (a, b) = (one, root(least, i));
        one = a.min(b);
        least[a.max(b)] = one;
    }
}

fn gather(of: &[f64], at: &[usize]) -> Vec<f64> {
    at.iter().map(|&i| of[i]).collect()
}

/// An error of a group, its direction expressed for all n unknowns.
fn spread_out(error: SaddleError, unknowns: &[usize], n: usize) -> SaddleError {
    let all = |part: Vec<f64>| {
        let mut direction = vec![0.0; n];
        unknowns.iter().zip(part).for_each(|(&i, v)| direction[i] = v);
        direction
    };
    match error {
        SaddleError::ZeroInertia { direction } => SaddleError::ZeroInertia { direction: all(direction) },
        SaddleError::InsufficientActuation { direction } => {
            SaddleError::InsufficientActuation { direction: all(direction) }
        }
        mismatch @ SaddleError::RankMismatch { .. } => mismatch,
    }
}
