//! Three balance equations a body, for the joint accelerations and all reactions at once (with the loop equations,
//! where there are loops): A x = b.

use super::minimal::CONTRADICTION;
use super::rows::closing_rows;
use super::{momentum, residual, size_of_power, DynamicsError, Row, Workspace, CANCELLED};
use crate::plane::{Twist, Wrench};
use crate::solve::{Lu, Matrix, Orthogonal};

/// Condition from which a square system is solved as one that may be singular.
const ILL_CONDITIONED: f64 = 1e12;
/// Part of a unit vector beyond those spanned below which it lies in their span.
const SPANNED: f64 = 1e-9;

/// The unknown loads of one body's joint in the tree: directions at the body's joint origin.
fn reaction_directions(columns: &[Twist], particle: bool) -> Vec<Wrench> {
    let size = if particle { 2 } else { 3 };
    let mut directions: Vec<[f64; 3]> = vec![];
    let mut spanned: Vec<[f64; 3]> = vec![];
    for c in columns {
        push_orthogonal(c.parts(), &mut spanned, SPANNED);
    }
    // The unit loads that are farthest from what the joint leaves free come first.
    let mut units: Vec<[f64; 3]> = (0..size).map(|i| std::array::from_fn(|k| if k == i { 1.0 } else { 0.0 })).collect();
    let freedom = spanned.len();
    while directions.len() + freedom < size && !units.is_empty() {
        let left = |u: &[f64; 3]| remainder(*u, &spanned).iter().map(|x| x * x).sum::<f64>();
        let best = (0..units.len()).max_by(|&a, &b| left(&units[a]).total_cmp(&left(&units[b]))).expect("not empty");
        let unit = units.swap_remove(best);
        push_orthogonal(unit, &mut spanned, SPANNED);
        directions.push(spanned[spanned.len() - 1]);
    }
    directions.into_iter().map(Wrench::from_parts).collect()
}

fn remainder(v: [f64; 3], spanned: &[[f64; 3]]) -> [f64; 3] {
    let mut rest = v;
    for s in spanned {
        let along: f64 = rest.iter().zip(s).map(|(a, b)| a * b).sum();
        for (r, s) in rest.iter_mut().zip(s) {
            *r -= along * s;
        }
    }
    rest
}

fn push_orthogonal(v: [f64; 3], spanned: &mut Vec<[f64; 3]>, nothing: f64) {
    // Twice is enough (Parlett, *The Symmetric Eigenvalue Problem*, §6.9).
    let rest = remainder(remainder(v, spanned), spanned);
    let norm = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if norm > nothing * size {
        spanned.push(rest.map(|x| x / norm));
    }
}

impl Workspace<'_> {
    pub(super) fn solve_newton_euler(&mut self) -> Result<(), DynamicsError> {
        let zero = vec![0.0; self.m.freedom()];
        self.k.propagate_motion(self.m, &zero, true, &mut self.solved.bodies);
        self.rows = closing_rows(self.at(), Some(&self.solved.bodies));
        let reactions = self.reactions();
        let (a, b) = self.brute_force(&reactions);
        let mut x = vec![0.0; a.cols()];
        solve_any(&a, &b, &mut x).map_err(|_| DynamicsError::NoUniqueMotion)?;
        self.take_brute_force(&reactions, &x);
        Ok(())
    }

    /// The unknown reactions of the tree: body and direction at its joint origin.
    fn reactions(&self) -> Vec<(usize, Wrench)> {
        (1..self.m.bodies.len())
            .flat_map(|i| {
                let freedom = self.m.bodies[i].tree_joint.map_or(0, |b| b.freedom);
                let directions = reaction_directions(&self.k.motion_subspace[i][..freedom], self.m.bodies[i].particle);
                directions.into_iter().map(move |w| (i, w))
            })
            .collect()
    }

    /// The matrix and right-hand side: balance of every body at its joint origin, then the closing rows.
    fn brute_force(&self, reactions: &[(usize, Wrench)]) -> (Matrix, Vec<f64>) {
        let m = self.m;
        let sizes: Vec<usize> = m.bodies.iter().map(|b| if b.particle { 2 } else { 3 }).collect();
        let starts: Vec<usize> = (0..m.bodies.len()).map(|i| sizes[1..i.max(1)].iter().sum()).collect();
        let balances: usize = sizes[1..].iter().sum();
        let (n, all) = (m.freedom(), balances + self.rows.len());
        let mut a = Matrix::zeros(all, n + reactions.len() + self.rows.len());
        let mut b = vec![0.0; all];
        let mut motion = vec![Twist::zero(); m.bodies.len()];
        let mut unit = vec![0.0; n];
        let enter = |a: &mut Matrix, body: usize, column: usize, w: Wrench, sign: f64| {
            for (k, value) in w.parts().into_iter().take(sizes[body]).enumerate() {
                a[(starts[body] + k, column)] += sign * value;
            }
        };
        for j in 0..n {
            unit[j] = 1.0;
            self.k.propagate_motion(m, &unit, false, &mut motion);
            unit[j] = 0.0;
            for (i, &motion) in motion.iter().enumerate().skip(1) {
                let arm = self.arms[i];
                enter(&mut a, i, j, momentum(self.at(), i, motion.at(arm), motion.w).seen_from(arm), 1.0);
            }
            for (r, row) in self.rows.iter().enumerate() {
                a[(balances + r, j)] = rate_of_row(row, &motion, self.length);
            }
        }
        for (c, &(body, w)) in reactions.iter().enumerate() {
            enter(&mut a, body, n + c, w, -1.0);
            let parent = m.bodies[body].tree_joint.expect("a body of the tree").parent;
            if parent > 0 {
                enter(&mut a, parent, n + c, w.seen_from(self.k.arm[body]), 1.0);
            }
        }
        for (r, row) in self.rows.iter().enumerate() {
            for &(body, w) in row.loads() {
                enter(&mut a, body, n + reactions.len() + r, w, -1.0);
            }
            b[balances + r] = -row.bias;
        }
        let unbalanced = residual(self.at(), &self.loads, &self.solved.bodies, &[], &[]);
        for (i, side) in unbalanced.into_iter().enumerate().skip(1) {
            for (k, value) in side.parts().into_iter().take(sizes[i]).enumerate() {
                b[starts[i] + k] = value;
            }
        }
        (a, b)
    }

    fn take_brute_force(&mut self, reactions: &[(usize, Wrench)], x: &[f64]) {
        let n = self.m.freedom();
        self.solved.nu_dot.copy_from_slice(&x[..n]);
        self.k.propagate_motion(self.m, &self.solved.nu_dot, true, &mut self.solved.bodies);
        self.solved.joint_wrenches.fill(Wrench::zero());
        for (&(body, w), &size) in reactions.iter().zip(&x[n..]) {
            self.solved.joint_wrenches[body] += w * size;
        }
        self.solved.lambda = x[n + reactions.len()..].to_vec();
    }
}

/// What a row says of a motion; 0 where the bodies' parts cancel, or the load passes through a joint origin, but for
/// round-off.
fn rate_of_row(row: &Row, motion: &[Twist], length: f64) -> f64 {
    let (mut sum, mut size) = (0.0, 0.0);
    for &(body, w) in &row.motion {
        sum += w.power(motion[body]);
        size += size_of_power(w, motion[body], length);
    }
    if sum.abs() > CANCELLED * size {
        sum
    } else {
        0.0
    }
}

/// Solves equilibrated equations; of all solutions of a singular but consistent system the least.
///
/// # Errors
/// No solution.
pub(super) fn solve_any(a: &Matrix, b: &[f64], x: &mut [f64]) -> Result<(), ()> {
    let (rows, cols) = equilibrate(a);
    let scaled = Matrix::from_fn(a.rows(), a.cols(), |i, j| a[(i, j)] * rows[i] * cols[j]);
    let side: Vec<f64> = b.iter().zip(&rows).map(|(b, r)| b * r).collect();
    let square = a.rows() == a.cols();
    let unique = square.then(|| Lu::factor(&scaled).ok().filter(|lu| lu.condition() < ILL_CONDITIONED)).flatten();
    match unique {
        Some(lu) => x.copy_from_slice(&lu.solve(&side)),
        None => {
            let least = Orthogonal::factor(&scaled);
            x.fill(0.0);
            least.add_solution(&side, x);
            let left = left_over(&scaled, x, &side);
            least.add_solution(&left, x);
            let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            if largest(&left_over(&scaled, x, &side)) > CONTRADICTION * largest_term(&scaled, x, &side) {
                return Err(());
            }
        }
    }
    x.iter_mut().zip(&cols).for_each(|(x, c)| *x *= c);
    Ok(())
}

/// The largest of the terms that balance each other in A x = b.
fn largest_term(a: &Matrix, x: &[f64], b: &[f64]) -> f64 {
    let terms = |i: usize| a.row(i).iter().zip(x).map(|(a, x)| (a * x).abs()).fold(b[i].abs(), f64::max);
    (0..a.rows()).map(terms).fold(0.0, f64::max)
}

fn left_over(a: &Matrix, x: &[f64], b: &[f64]) -> Vec<f64> {
    a.mul_vec(x).iter().zip(b).map(|(ax, b)| b - ax).collect()
}

/// Scales that bring rows and columns to order one (Ruiz 2001), three times over.
fn equilibrate(a: &Matrix) -> (Vec<f64>, Vec<f64>) {
    let (mut rows, mut cols) = (vec![1.0; a.rows()], vec![1.0; a.cols()]);
    for _ in 0..3 {
        let (mut r, mut c) = (vec![0.0_f64; a.rows()], vec![0.0_f64; a.cols()]);
        for i in 0..a.rows() {
            for j in 0..a.cols() {
                let size = (a[(i, j)] * rows[i] * cols[j]).abs();
                r[i] = r[i].max(size);
                c[j] = c[j].max(size);
            }
        }
        let root = |x: f64| if x > 0.0 { 1.0 / x.sqrt() } else { 1.0 };
        rows.iter_mut().zip(&r).for_each(|(s, &x)| *s *= root(x));
        cols.iter_mut().zip(&c).for_each(|(s, &x)| *s *= root(x));
    }
    (rows, cols)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::vec2;

    #[test]
    fn reactions_do_no_work_on_what_the_joint_leaves_free() {
        let columns = [Twist { v: vec2(0.6, 0.8), w: 0.0 }, Twist { v: vec2(0.0, 0.0), w: 1.0 }];
        let reactions = reaction_directions(&columns, false);
        assert_eq!(reactions.len(), 1);
        for c in columns {
            assert!(reactions[0].power(c).abs() < 1e-15);
        }
    }
}
