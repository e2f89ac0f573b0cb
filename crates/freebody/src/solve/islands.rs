//! Equations that fall apart into groups without a common unknown: each group is solved for itself.

use super::saddle::{gather, Equations, Memory};
use super::{largest, Matrix, Orthogonal, Rank, Saddle, SaddleError, Solution};

/// Part of a row that is round-off.
const UNFELT: f64 = 1e-12;

/// The equations of [`Saddle`], group by group. The arithmetic grows with the cube of the largest group.
#[derive(Clone, Debug, Default)]
pub struct Islands {
    /// Numbers of rows and of unknowns.
    size: [usize; 2],
    islands: Vec<Island>,
    groups: Groups,
}

/// Which unknowns are in one group.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups {
    /// Of each unknown the least that it is known to be grouped with, found by way of others.
    least: Vec<usize>,
    /// The group of each unknown.
    pub of: Vec<usize>,
}

/// Memory of [`Islands::solve_into`], kept from one solution to the next.
#[derive(Clone, Debug, Default)]
pub struct IslandMemory {
    f: Vec<f64>,
    r: Vec<f64>,
    part: Solution,
    saddle: Memory,
}

#[derive(Clone, Debug, Default)]
struct Island {
    unknowns: Vec<usize>,
    rows: Vec<usize>,
    saddle: Saddle,
}

impl Islands {
    /// Factors other equations. After an error [`rank`](Self::rank),
    /// [`motions`](Self::motions) and [`self_stress`](Self::self_stress) still hold.
    pub fn refactor(&mut self, of: Equations) -> Result<(), SaddleError> {
        let Equations { mass, g, b, .. } = of;
        self.size = [g.rows(), g.cols()];
        let groups = self.groups.find(mass, g, b);
        self.islands.resize_with(groups, Island::default);
        for island in &mut self.islands {
            island.unknowns.clear();
            island.rows.clear();
        }
        for (i, &group) in self.groups.of.iter().enumerate() {
            self.islands[group].unknowns.push(i);
        }
        for i in 0..g.rows() {
            // Rows without unknowns go to the first, which is always there.
            let group = touched(g, b, i).next().map_or(0, |j| self.groups.of[j]);
            self.islands[group].rows.push(i);
        }
        let mut done = Ok(());
        for island in &mut self.islands {
            let Island { unknowns, rows, saddle } = island;
            let factored = saddle.refactor_part(of, [rows, unknowns]);
            done = done.and(factored.map_err(|error| spread_out(error, unknowns, self.size[1])));
        }
        done
    }

    /// The rank of G and what it was decided on.
    pub fn rank(&self) -> Rank {
        together(self.islands.iter().map(|island| island.saddle.rank()))
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
        let part = |island: &Island| island.unknowns.iter().map(|&i| row[i]).collect::<Vec<f64>>();
        let parts = self.islands.iter().map(|island| island.saddle.felt(&part(island)));
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
        let mut found = Solution::default();
        self.solve_into(f, r, &mut found, &mut IslandMemory::default());
        found
    }

    /// The same into `found`.
    pub fn solve_into(&self, f: &[f64], r: &[f64], found: &mut Solution, memory: &mut IslandMemory) {
        for (of, size) in [(&mut found.a, f.len()), (&mut found.lambda, r.len())] {
            of.clear();
            of.resize(size, 0.0);
        }
        found.inconsistency = 0.0;
        for Island { unknowns, rows, saddle, .. } in &self.islands {
            gather(f, unknowns, &mut memory.f);
            gather(r, rows, &mut memory.r);
            if memory.f.iter().chain(&memory.r).all(|&v| v == 0.0) {
                continue;
            }
            let part = &mut memory.part;
            saddle.solve_into(&memory.f, &memory.r, part, &mut memory.saddle);
            unknowns.iter().zip(&part.a).for_each(|(&i, &a)| found.a[i] = a);
            rows.iter().zip(&part.lambda).for_each(|(&i, &lambda)| found.lambda[i] = lambda);
            found.inconsistency = largest([found.inconsistency, part.inconsistency].into_iter());
        }
    }
}

/// The rank of rows that fall apart into groups without a common unknown.
#[derive(Clone, Debug, Default)]
pub struct IslandRank {
    groups: Groups,
    unknowns: Vec<usize>,
    rows: Vec<usize>,
    part: Matrix,
    split: Orthogonal,
}

impl IslandRank {
    /// That of other rows, and what it was decided on in the groups.
    pub fn find(&mut self, g: &Matrix) -> Rank {
        let IslandRank { groups, unknowns, rows, part, split } = self;
        groups.begin(g.cols());
        (0..g.rows()).for_each(|i| groups.join(touched(g, None, i)));
        let ranks = (0..groups.number()).map(|group| {
            unknowns.clear();
            unknowns.extend((0..g.cols()).filter(|&j| groups.of[j] == group));
            rows.clear();
            rows.extend((0..g.rows()).filter(|&i| unknowns.iter().any(|&j| g[(i, j)] != 0.0)));
            part.fill(rows.len(), unknowns.len(), |i, j| g[(rows[i], unknowns[j])]);
            split.find_rank(part)
        });
        together(ranks)
    }
}

/// The rank of groups together.
fn together(ranks: impl Iterator<Item = Rank>) -> Rank {
    let none = Rank { kept: f64::INFINITY, ..Rank::default() };
    let all = ranks.filter(|rank| rank.rank > 0).fold(none, |all, of| Rank {
        rank: all.rank + of.rank,
        kept: all.kept.min(of.kept),
        dropped: all.dropped.max(of.dropped),
        uncertain: all.uncertain || of.uncertain,
    });
    if all.rank == 0 {
        Rank::default()
    } else {
        all
    }
}

/// The unknowns that a row touches.
fn touched<'a>(g: &'a Matrix, b: Option<&'a Matrix>, i: usize) -> impl Iterator<Item = usize> + 'a {
    (0..g.cols()).filter(move |&j| g[(i, j)] != 0.0 || b.is_some_and(|b| b[(i, j)] != 0.0))
}

impl Groups {
    /// Finds the groups of equations, in the order of their first unknowns; returns how many, at least one.
    fn find(&mut self, mass: &Matrix, g: &Matrix, b: Option<&Matrix>) -> usize {
        let n = g.cols();
        let is_full = |of: &Matrix| (0..of.rows()).any(|i| of.row(i).iter().all(|&x| x != 0.0));
        if is_full(g) || is_full(mass) {
            self.of.clear();
            self.of.resize(n, 0);
            return 1;
        }
        self.begin(n);
        for i in 0..n {
            self.join((0..=i).filter(|&j| mass[(i, j)] != 0.0 || i == j));
        }
        (0..g.rows()).for_each(|i| self.join(touched(g, b, i)));
        self.number().max(1)
    }

    /// Takes `n` unknowns, each by itself.
    pub fn begin(&mut self, n: usize) {
        self.least.clear();
        self.least.extend(0..n);
    }

    /// Makes one group of all that are given.
    pub fn join(&mut self, mut of: impl Iterator<Item = usize>) {
        let Some(first) = of.next() else { return };
        let mut one = self.root(first);
        for i in of {
            let (a, b) = (one, self.root(i));
            one = a.min(b);
            self.least[a.max(b)] = one;
        }
    }

    /// Numbers the groups in the order of their first unknowns; returns how many there are.
    pub fn number(&mut self) -> usize {
        let mut count = 0;
        self.of.clear();
        for i in 0..self.least.len() {
            let first = self.root(i);
            self.of.push(if first == i { count } else { self.of[first] });
            count += usize::from(first == i);
        }
        count
    }

    fn root(&self, mut i: usize) -> usize {
        while self.least[i] != i {
            i = self.least[i];
        }
        i
    }
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
