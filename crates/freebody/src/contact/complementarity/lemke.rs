//! Lemke's method for w = M z + q, 0 ≤ w ⟂ z ≥ 0.

use crate::solve::Matrix;

/// An entry of the tableau below this is round-off and no pivot.
const TABLEAU_PIVOT: f64 = 1e-10;
/// A ray that starts this near to a solution has missed it by round-off: redundant contacts can often be
/// closed all together only.
const RESIDUE: f64 = 1e-10;
/// Ratios that differ by less, relative to their size, tie.
const TIE: f64 = 3e-14;

/// Where the path of complementary bases ends.
#[derive(Clone, Debug)]
pub(super) enum End {
    /// At a solution.
    Solution {
        /// Whether zᵢ is in the basis.
        basic: Vec<bool>,
        /// w.
        slack: Vec<f64>,
    },
    /// On a ray along this direction of z.
    Ray(Vec<f64>),
    /// Nowhere within the bound on its length, which only round-off reaches.
    Lost,
}

/// The equations I w − M z − d z₀ = q, solved for the basis: the columns of what is not in it, and the right-hand side. Variables are
/// numbered w, z, z₀.
struct Tableau {
    n: usize,
    rows: Matrix,
    /// The variable that each row gives, and that of each column.
    basis: Vec<usize>,
    columns: Vec<usize>,
}

/// Follows Lemke's path with the lexicographic ratio test, on which no basis comes twice (Cottle, Pang & Stone, *The
/// Linear Complementarity Problem*, 1992, §4.4 and §4.9). Each covering vector d > 0 has a path of its own.
pub(super) fn lemke(m: &Matrix, q: &[f64], d: &[f64]) -> End {
    let n = q.len();
    let mut t = Tableau::new(m, q, d);
    if q.iter().all(|q| *q >= 0.0) {
        return t.solution();
    }
    let mut enter = n;
    let mut row = t.worst(d);
    for _ in 0..100 + 50 * n {
        let leave = t.pivot(row, enter);
        if leave == 2 * n {
            return t.solution();
        }
        enter = t.column(if leave < n { leave + n } else { leave - n }).expect("its complement has left the basis");
        match t.ratio_test(enter) {
            Some(r) => row = r,
            None if t.artificial() <= RESIDUE => return t.solution(),
            None => return End::Ray(t.ray(enter)),
        }
    }
    End::Lost
}

impl Tableau {
    fn new(m: &Matrix, q: &[f64], d: &[f64]) -> Tableau {
        let n = q.len();
        let entry = |i: usize, j: usize| match j {
            _ if j < n => -m[(i, j)],
            _ if j == n => -d[i],
            _ => q[i],
        };
        Tableau { n, rows: Matrix::from_fn(n, n + 2, entry), basis: (0..n).collect(), columns: (n..=2 * n).collect() }
    }

    /// The column of a variable that is not in the basis.
    fn column(&self, variable: usize) -> Option<usize> {
        self.columns.iter().position(|&v| v == variable)
    }

    /// The row that the artificial z₀ must lift most, the last of several.
    fn worst(&self, d: &[f64]) -> usize {
        let lift = |i: usize| self.right(i) / d[i];
        (1..self.n).fold(0, |best, i| if lift(i) <= lift(best) { i } else { best })
    }

    fn right(&self, i: usize) -> f64 {
        self.rows[(i, self.n + 1)]
    }

    /// z₀, by which w = M z + q is still missed.
    fn artificial(&self) -> f64 {
        self.basis.iter().position(|&v| v == 2 * self.n).map_or(0.0, |i| self.right(i))
    }

    /// The variable of column `enter` takes the place of the one of `row`, which is returned.
    fn pivot(&mut self, row: usize, enter: usize) -> usize {
        let p = self.rows[(row, enter)];
        self.rows[(row, enter)] = 1.0;
        self.rows.row_mut(row).iter_mut().for_each(|v| *v /= p);
        for i in (0..self.n).filter(|&i| i != row) {
            let (source, target) = self.rows.two_rows_mut(row, i);
            let s = std::mem::take(&mut target[enter]);
            if s != 0.0 {
                target.iter_mut().zip(source.iter()).for_each(|(t, p)| *t -= s * p);
            }
        }
        std::mem::swap(&mut self.basis[row], &mut self.columns[enter]);
        self.columns[enter]
    }

    /// The row that blocks column `enter` first: z₀ if it is among them, else the least in lexicographic order.
    fn ratio_test(&self, enter: usize) -> Option<usize> {
        let candidates: Vec<usize> = (0..self.n).filter(|&i| self.rows[(i, enter)] > TABLEAU_PIVOT).collect();
        let mut places = vec![None; 2 * self.n + 1];
        self.columns.iter().enumerate().for_each(|(j, &variable)| places[variable] = Some(j));
        let best = candidates.iter().copied().reduce(|a, b| if self.before(b, a, enter, &places) { b } else { a })?;
        let home = candidates.iter().copied().find(|&i| self.basis[i] == 2 * self.n);
        let is_tied = |h: usize| self.compare([h, best], enter, |i| self.right(i)).is_eq();
        home.filter(|&h| is_tied(h)).or(Some(best))
    }

    /// Whether the ratios of row a come before those of b: of the right-hand sides, then of the columns w, which are in these `places`.
    fn before(&self, a: usize, b: usize, enter: usize, places: &[Option<usize>]) -> bool {
        let entry = |i: usize, w: usize| match places[w] {
            Some(j) => self.rows[(i, j)],
            None => f64::from(self.basis[i] == w),
        };
        let of_columns = (0..self.n).map(|w| self.compare([a, b], enter, |i| entry(i, w)));
        let mut all = std::iter::once(self.compare([a, b], enter, |i| self.right(i))).chain(of_columns);
        all.find(|o| o.is_ne()).is_some_and(|o| o.is_lt())
    }

    /// Compares the ratios of two rows in a column.
    fn compare(&self, rows: [usize; 2], enter: usize, entry: impl Fn(usize) -> f64) -> std::cmp::Ordering {
        let [x, y]: [f64; 2] = rows.map(|i| entry(i) / self.rows[(i, enter)]);
        let tie = (x - y).abs() <= TIE * (1.0 + x.abs().max(y.abs()));
        if tie {
            std::cmp::Ordering::Equal
        } else {
            x.total_cmp(&y)
        }
    }

    fn solution(&self) -> End {
        let (mut basic, mut slack) = (vec![false; self.n], vec![0.0; self.n]);
        for (i, &v) in self.basis.iter().enumerate() {
            match v.checked_sub(self.n) {
                Some(z) if z < self.n => basic[z] = true,
                Some(_) => {}
                None => slack[v] = self.right(i),
            }
        }
        End::Solution { basic, slack }
    }

    /// The direction of z along which the variable of column `enter` grows without bound.
    fn ray(&self, enter: usize) -> Vec<f64> {
        let mut z = vec![0.0; self.n];
        let mut set = |v: usize, value: f64| {
            if (self.n..2 * self.n).contains(&v) {
                z[v - self.n] = value;
            }
        };
        set(self.columns[enter], 1.0);
        self.basis.iter().enumerate().for_each(|(i, &v)| set(v, -self.rows[(i, enter)]));
        z
    }
}
