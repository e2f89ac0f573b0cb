//! Masses and rows by the coordinates of the tree, and the units in which both are of order one.

use super::momentum::Inertia;
use super::{size_of_power, visit_ancestors, BodyWrenches, Row, CANCELLED};
use crate::kinematics::StateView;
use crate::mechanism::Mechanism;
use crate::plane::{Vec2, Wrench};
use crate::scalar::Scalar;
use crate::solve::Matrix;

/// Unit of each coordinate.
pub(super) fn column_scales(at: StateView<'_>, length: f64) -> impl Iterator<Item = f64> + '_ {
    (0..at.m.coordinates.len()).map(move |i| column_scale(at, i, length))
}

/// Unit of a coordinate: a radian for angles, the characteristic length for lengths, and for the parameter of a curve
/// what shifts or turns a body by as much.
#[inline]
pub(super) fn column_scale(at: StateView<'_>, coordinate: usize, length: f64) -> f64 {
    let (joint, k) = at.m.coordinates[coordinate];
    let of_curve = || {
        let column = at.k.motion_subspace[at.m.joints[joint].child?][k];
        let size = column.v.norm().max(length * column.w.abs());
        (size > 0.0).then(|| length / size)
    };
    match at.m.joints[joint].coordinates[k].dimension {
        "m" => length,
        "rad" => 1.0,
        _ => of_curve().unwrap_or(1.0),
    }
}

/// Makes every row of order one in scaled coordinates.
pub(super) fn row_scales<'a>(g: &'a Matrix, columns: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    (0..g.rows()).map(move |i| {
        let norm = g.row(i).iter().zip(columns).map(|(x, c)| (x * c) * (x * c)).sum::<f64>().sqrt();
        if norm > 0.0 {
            1.0 / norm
        } else {
            1.0
        }
    })
}

/// Rows by joint coordinates, n columns.
pub(super) fn gradients(at: StateView<'_>, rows: &[Row], length: f64) -> Matrix {
    let mut g = Matrix::default();
    rows_in_coordinates(at, rows, length, |row| &row.motion, &mut g, &mut vec![]);
    g
}

/// What loads of rows do on the joint coordinates, n columns, with memory for their sizes.
#[inline]
pub(super) fn rows_in_coordinates(
    at: StateView<'_>,
    rows: &[Row],
    length: f64,
    of: impl Fn(&Row) -> &BodyWrenches<f64>,
    out: &mut Matrix,
    sizes: &mut Vec<f64>,
) {
    out.reset(rows.len(), at.m.freedom());
    sizes.resize(at.m.freedom(), 0.0);
    for (i, row) in rows.iter().enumerate() {
        sizes.fill(0.0);
        generalized_force_clean(at, of(row), length, out.row_mut(i), sizes);
    }
}

/// As [`generalized_force`], but 0 where loads cancel, or pass through a joint origin, but for round-off: such a row asks for
/// nothing of that coordinate, and must not be scaled up to a constraint. `size`, 0 before, is what does not cancel.
#[inline]
fn generalized_force_clean(
    at: StateView<'_>,
    wrenches: &BodyWrenches<f64>,
    length: f64,
    out: &mut [f64],
    size: &mut [f64],
) {
    visit_ancestors(at, wrenches.iter().copied(), |i, load, column| {
        out[i] += load.power(column);
        size[i] += size_of_power(load, column, length);
    });
    for (sum, size) in out.iter_mut().zip(size) {
        *sum = cleared(*sum, *size);
    }
}

/// A sum, 0 where terms of that size cancel but for round-off.
#[inline]
fn cleared(sum: f64, size: f64) -> f64 {
    if sum.abs() <= CANCELLED * size {
        0.0
    } else {
        sum
    }
}

/// The same as entries of a sparse matrix: `places` says of each coordinate on which the loads may act where its entry stands; `out` and
/// `size` are 0 before and after.
#[inline]
pub(super) fn power_entries(
    at: StateView<'_>,
    wrenches: &BodyWrenches<f64>,
    length: f64,
    places: &[(usize, usize)],
    [out, size]: [&mut [f64]; 2],
    values: &mut [f64],
) {
    visit_ancestors(at, wrenches.iter().copied(), |i, load, column| {
        out[i] += load.power(column);
        size[i] += size_of_power(load, column, length);
    });
    for &(i, place) in places {
        values[place] = cleared(std::mem::take(&mut out[i]), std::mem::take(&mut size[i]));
    }
}

/// The mass matrix of the tree by joint coordinates, n × n.
#[inline]
pub(super) fn mass_matrix(at: StateView<'_>, arms: &[Vec2], carried: &mut Vec<Inertia>, out: &mut Matrix) {
    out.reset(at.m.freedom(), at.m.freedom());
    visit_mass(at, arms, carried, |row, column, inertia| {
        out[(row, column)] = inertia;
        out[(column, row)] = inertia;
    });
}

/// Calls f(row, column, inertia) for every pair of coordinates of the tree that may share inertia, from that of each body with all that
/// hangs on it (composite rigid bodies; Featherstone ch. 6).
#[inline]
pub(super) fn visit_mass<S: Scalar>(
    at: StateView<'_, S>,
    arms: &[Vec2<S>],
    carried: &mut Vec<Inertia<S>>,
    mut f: impl FnMut(usize, usize, S),
) {
    let bodies = at.m.bodies.len();
    carried.clear();
    carried.resize(bodies, Inertia::none());
    for i in (1..bodies).rev() {
        let (body, own) = (Inertia::of(at, i, arms[i]), &mut carried[i]);
        own.mass += body.mass;
        own.moment += body.moment;
        own.turn += body.turn;
        let own = *own;
        let tree_joint = at.m.bodies[i].tree_joint.expect("every body hangs in the tree");
        let particle = at.m.bodies[i].particle;
        for k in 0..tree_joint.freedom {
            let mut load = own.momentum(at.k.motion_subspace[i][k]);
            if particle {
                load.m = S::zero();
            }
            couple(at, i, tree_joint.start + k, load, &mut f);
        }
        let r = at.k.arm[i];
        let up = &mut carried[tree_joint.parent];
        up.mass += own.mass;
        if particle {
            // A particle resists the turning of its parent by its place only.
            up.moment += r * own.mass;
            up.turn += own.mass * r.dot(r);
        } else {
            up.moment += own.moment + r * own.mass;
            up.turn += own.turn + r.dot(own.moment).scale(2.0) + own.mass * r.dot(r);
        }
    }
}

/// Says what the load of coordinate `j` does on every coordinate from body `i` down to ground.
#[inline]
fn couple<S: Scalar>(at: StateView<'_, S>, i: usize, j: usize, load: Wrench<S>, f: &mut impl FnMut(usize, usize, S)) {
    visit_ancestors(at, [(i, load)], |row, load, column| f(row, j, load.power(column)));
}

/// The pairs of coordinates that [`visit_mass`] visits, in its order.
pub(super) fn mass_entries(m: &Mechanism, mut f: impl FnMut(usize, usize)) {
    let tree_joint = |body: usize| m.bodies[body].tree_joint;
    for i in (1..m.bodies.len()).rev() {
        for k in 0..tree_joint(i).map_or(0, |joint| joint.freedom) {
            let mut below = i;
            while let (Some(joint), Some(own)) = (tree_joint(below), tree_joint(i)) {
                (joint.start..joint.start + joint.freedom).for_each(|row| f(row, own.start + k));
                below = joint.parent;
            }
        }
    }
}
