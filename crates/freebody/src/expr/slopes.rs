//! The slopes at the points of a table, of which its cubics are made; from the widths of the pieces and their chords.

/// Slopes of cubics that never overshoot (Fritsch & Carlson, SIAM J. Numer. Anal. 17, 1980, 238–246): a weighted harmonic
/// mean of the chords beside each point, 0 at an extremum (Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5, 1984, 300–304).
pub(super) fn pchip(widths: &[f64], chords: &[f64], periodic: bool) -> Vec<f64> {
    let last = chords.len() - 1;
    if last == 0 {
        return vec![chords[0]; 2];
    }
    let mean = |before: usize, i: usize| {
        let (left, right) = (chords[before], chords[i]);
        if left * right <= 0.0 {
            return 0.0;
        }
        let (a, b) = (2.0 * widths[i] + widths[before], widths[i] + 2.0 * widths[before]);
        (a + b) / (a / left + b / right)
    };
    let inner = |i: usize| mean(i - 1, i);
    if periodic {
        let seam = mean(last, 0);
        return std::iter::once(seam).chain((1..=last).map(inner)).chain(std::iter::once(seam)).collect();
    }
    let first = end_slope([widths[0], widths[1]], [chords[0], chords[1]]);
    let end = end_slope([widths[last], widths[last - 1]], [chords[last], chords[last - 1]]);
    std::iter::once(first).chain((1..=last).map(inner)).chain(std::iter::once(end)).collect()
}

/// The three-point slope at an end, limited so that the end piece stays monotone.
fn end_slope(widths: [f64; 2], chords: [f64; 2]) -> f64 {
    let [h, next] = widths;
    let slope = ((2.0 * h + next) * chords[0] - h * chords[1]) / (h + next);
    if slope * chords[0] <= 0.0 {
        0.0
    } else if chords[0] * chords[1] <= 0.0 && slope.abs() > 3.0 * chords[0].abs() {
        3.0 * chords[0]
    } else {
        slope
    }
}

/// Slopes that make the curvature continuous; it is 0 at the ends, or goes on across the seam (de Boor, *A Practical Guide to
/// Splines*, 1978, ch. IV).
pub(super) fn spline(widths: &[f64], chords: &[f64], periodic: bool) -> Vec<f64> {
    let last = chords.len() - 1;
    let smooth = |before: usize, i: usize| Row {
        left: widths[i],
        own: 2.0 * (widths[before] + widths[i]),
        right: widths[before],
        value: 3.0 * (widths[i] * chords[before] + widths[before] * chords[i]),
    };
    let inner = (1..=last).map(|i| smooth(i - 1, i));
    if periodic {
        let rows: Vec<Row> = std::iter::once(smooth(last, 0)).chain(inner).collect();
        let mut slopes = cyclic(&rows);
        slopes.push(slopes[0]);
        return slopes;
    }
    let first = Row { left: 0.0, own: 2.0, right: 1.0, value: 3.0 * chords[0] };
    let end = Row { left: 1.0, own: 2.0, right: 0.0, value: 3.0 * chords[last] };
    let rows: Vec<Row> = std::iter::once(first).chain(inner).chain(std::iter::once(end)).collect();
    tridiagonal(&rows, rows.iter().map(|row| row.value).collect())
}

/// left x₋₁ + own x + right x₊₁ = value, with a dominant `own`.
struct Row {
    left: f64,
    own: f64,
    right: f64,
    value: f64,
}

/// The solution of rows of which the first has nothing on its left and the last nothing on its right, for a right-hand side;
/// by elimination without exchanges, which the dominant diagonal allows.
fn tridiagonal(rows: &[Row], mut x: Vec<f64>) -> Vec<f64> {
    let mut own: Vec<f64> = rows.iter().map(|row| row.own).collect();
    for i in 1..rows.len() {
        let factor = rows[i].left / own[i - 1];
        own[i] -= factor * rows[i - 1].right;
        x[i] -= factor * x[i - 1];
    }
    for i in (0..rows.len()).rev() {
        let beyond = if i + 1 < rows.len() { rows[i].right * x[i + 1] } else { 0.0 };
        x[i] = (x[i] - beyond) / own[i];
    }
    x
}

/// The solution of rows in a ring: the last unknown is left over while the others are eliminated.
fn cyclic(rows: &[Row]) -> Vec<f64> {
    let (last, others) = rows.split_last().expect("a table has a piece");
    let n = others.len();
    if n == 0 {
        return vec![last.value / (last.left + last.own + last.right)];
    }
    let mut of_last = vec![0.0; n];
    of_last[0] += others[0].left;
    of_last[n - 1] += others[n - 1].right;
    let fixed = tridiagonal(others, others.iter().map(|row| row.value).collect());
    let per_last = tridiagonal(others, of_last);
    let around = |x: &[f64]| last.right * x[0] + last.left * x[n - 1];
    let end = (last.value - around(&fixed)) / (last.own - around(&per_last));
    (0..n).map(|i| fixed[i] - end * per_last[i]).chain([end]).collect()
}
