//! How far several linear quantities can be kept above zero all together.

use super::islands::Groups;
use super::Matrix;

/// A coefficient below this, of rows of order one, is round-off and no pivot.
const PIVOT: f64 = 1e-10;

/// The x for which the least of all (A x + b)ᵢ is greatest, and that least; no more than `most` is asked for. Quantities that share no
/// unknown are kept above it apart.
pub fn keep_above(a: &Matrix, b: &[f64], most: f64) -> (Vec<f64>, f64) {
    let felt = |i: usize| (0..a.cols()).filter(move |&j| a[(i, j)] != 0.0);
    let mut groups = Groups::default();
    groups.begin(a.cols());
    (0..a.rows()).for_each(|i| groups.join(felt(i)));
    let count = groups.number();
    let (mut x, mut rows) = (vec![0.0; a.cols()], vec![vec![]; count]);
    let mut least = f64::INFINITY;
    for (i, &b) in b.iter().enumerate() {
        match felt(i).next() {
            Some(j) => rows[groups.of[j]].push(i),
            None => least = least.min(b),
        }
    }
    for (group, rows) in rows.iter().enumerate() {
        let columns: Vec<usize> = (0..a.cols()).filter(|&j| groups.of[j] == group).collect();
        let part = Matrix::from_fn(rows.len(), columns.len(), |i, j| a[(rows[i], columns[j])]);
        let (found, lowest) = keep_all_above(&part, &rows.iter().map(|&i| b[i]).collect::<Vec<_>>(), most.min(least));
        columns.iter().zip(found).for_each(|(&j, found)| x[j] = found);
        least = least.min(lowest);
    }
    (x, least)
}

/// The same of all together.
///
/// The simplex method from x = 0 by Bland's rule, on which no basis comes twice (Chvátal, *Linear Programming*, 1983,
/// ch. 3).
fn keep_all_above(a: &Matrix, b: &[f64], most: f64) -> (Vec<f64>, f64) {
    let (m, n) = (a.rows(), a.cols());
    let least = b.iter().copied().fold(f64::INFINITY, f64::min);
    if m == 0 || n == 0 || least >= most {
        return (vec![0.0; n], least);
    }
    // Columns: the rise s of the least, x from below with one common shift down, slacks, right-hand side. Rows: s − (A
    // x)ᵢ ≤ bᵢ − least; s ≤ most − least; and last what is to be made great, s.
    let (slack, right) = (n + 2, n + m + 3);
    let entry = |i: usize, j: usize| match j {
        _ if j == right && i == m => most - least,
        _ if j == right && i < m => b[i] - least,
        0 => {
            if i > m {
                -1.0
            } else {
                1.0
            }
        }
        _ if i >= m => f64::from(j == slack + m && i == m),
        _ if j <= n => -a[(i, j - 1)],
        _ if j == n + 1 => a.row(i).iter().sum(),
        _ => f64::from(j == slack + i),
    };
    let mut table = Matrix::from_fn(m + 2, right + 1, entry);
    let mut basis: Vec<usize> = (slack..=slack + m).collect();
    // Bland's rule ends by itself, but for round-off.
    for _ in 0..100 + 50 * m {
        let Some(enter) = (0..right).find(|&j| table[(m + 1, j)] < -PIVOT) else { break };
        let ratio = |i: usize| table[(i, right)].max(0.0) / table[(i, enter)];
        let rows = (0..=m).filter(|&i| table[(i, enter)] > PIVOT);
        let first = rows.min_by(|&i, &j| ratio(i).total_cmp(&ratio(j)).then(basis[i].cmp(&basis[j])));
        let Some(row) = first else { break };
        basis[row] = enter;
        let pivot = table[(row, enter)];
        table.row_mut(row).iter_mut().for_each(|v| *v /= pivot);
        for i in (0..m + 2).filter(|&i| i != row) {
            let (source, target) = table.two_rows_mut(row, i);
            let s = target[enter];
            target.iter_mut().zip(source.iter()).for_each(|(t, p)| *t -= s * p);
        }
    }
    let value = |j: usize| basis.iter().position(|&v| v == j).map_or(0.0, |i| table[(i, right)]);
    let shift = value(n + 1);
    ((1..=n).map(|j| value(j) - shift).collect(), least + value(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least of several linear quantities is greatest where moving on along any direction lessens one of them: held
    /// against a search over a fine grid.
    #[test]
    fn no_other_point_keeps_them_higher() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for case in 0..200 {
            // Of every other problem the quantities are of one unknown each, the last of none.
            let is_felt = |i: usize, j: usize| case % 2 == 0 || i < 6 && i % 2 == j;
            let a = Matrix::from_fn(7, 2, |i, j| if is_felt(i, j) { random() } else { 0.0 });
            let b: Vec<f64> = (0..7).map(|_| random()).collect();
            let least = |x: &[f64]| a.mul_vec(x).iter().zip(&b).map(|(a, b)| a + b).fold(f64::INFINITY, f64::min);
            let (x, most) = keep_above(&a, &b, 1.0);
            assert!((least(&x) - most).abs() < 1e-12 || most >= 1.0 - 1e-12, "{} {most}", least(&x));
            for i in -40..40 {
                for j in -40..40 {
                    let near = [x[0] + 0.05 * f64::from(i), x[1] + 0.05 * f64::from(j)];
                    assert!(least(&near).min(1.0) <= most + 1e-12);
                }
            }
        }
    }
}
