//! Many loops in few equations: mass matrix and closing rows by the coordinates of the tree, M ν̇ − Gᵀλ = f and G ν̇ = −γ, in block-sparse
//! form. Where branches are short, as in a ladder, both are sparse and the cost is linear in the number of loops.

use super::minimal::Memory;
use super::tree_matrices::{column_scales, mass_entries, power_entries, visit_mass};
use super::{loads, DynamicsError, Source, Workspace};
use crate::mechanism::Mechanism;
use crate::solve::{Factor, Pattern};
use std::ops::Range;

/// Pairs of coordinates that share inertia, for each body, above which the mass matrix is as good as full.
const LONG_BRANCHES: usize = 60;
/// The residual to which a motion is solved, two orders above round-off.
const RESIDUAL: f64 = 1e-14;

/// Memory of the equations, the nodes of whose pattern are the bodies with coordinates, then the groups of rows.
pub struct SparseTree {
    factor: Factor,
    /// Multiply-adds of one factorisation.
    pub(super) flops: f64,
    bodies: Vec<usize>,
    groups: Vec<Source>,
    /// Where the entries of the mass matrix stand, in the order in which they are found.
    mass: Vec<usize>,
    /// Of each row the coordinates on which it may act, and where these entries stand.
    rows: Vec<Vec<(usize, usize)>>,
    /// What a row does on each coordinate, and the size of what is summed; 0 but while a row is entered.
    power: Vec<f64>,
    size: Vec<f64>,
    side: Vec<f64>,
    found: Vec<f64>,
}

/// A body and those between it and ground, ground left out.
fn branch(m: &Mechanism, body: usize) -> impl Iterator<Item = usize> + '_ {
    std::iter::successors(Some(body), |&i| m.bodies[i].tree_joint.map(|joint| joint.parent)).filter(|&i| i > 0)
}

fn coordinates(m: &Mechanism, body: usize) -> Range<usize> {
    let joint = m.bodies[body].tree_joint.expect("every body hangs in the tree");
    joint.start..joint.start + joint.freedom
}

/// The coordinates on which loads on bodies may do work, each once.
fn coordinates_below(m: &Mechanism, bodies: &[usize]) -> Vec<usize> {
    let mut all: Vec<usize> = bodies.iter().flat_map(|&body| branch(m, body)).flat_map(|i| coordinates(m, i)).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The groups of closing rows, each with its number of rows and the bodies on which these act.
fn groups(m: &Mechanism) -> Vec<(Source, usize, Vec<usize>)> {
    let of_joint = |&j: &usize| (Source::Joint(j, 0), m.joints[j].rows.len(), m.ends(&m.joints[j]).to_vec());
    let of_drive = |d: usize| {
        let driven = m.drives[d].of.clone() - m.drives[d].law.clone();
        (Source::Drive(d), 1, m.bodies_of(&driven))
    };
    m.closures.iter().map(of_joint).chain((0..m.drives.len()).map(of_drive)).filter(|group| group.1 > 0).collect()
}

impl SparseTree {
    /// Memory for a mechanism in which all parts are in place; None where branches are long.
    pub(super) fn of(m: &Mechanism) -> Option<SparseTree> {
        let mut bodies: Vec<usize> = (1..m.bodies.len()).filter(|&i| !coordinates(m, i).is_empty()).collect();
        bodies.sort_by_key(|&i| coordinates(m, i).start);
        let mut pairs = bodies.iter().flat_map(|&i| branch(m, i));
        if pairs.nth(LONG_BRANCHES * bodies.len()).is_some() {
            return None;
        }
        let groups = groups(m);
        let node = |i: usize| bodies.binary_search_by_key(&coordinates(m, i).start, |&j| coordinates(m, j).start).ok();
        let nodes = |body: usize| branch(m, body).filter(|&i| !coordinates(m, i).is_empty()).filter_map(node);
        let mut edges = vec![];
        for (at, &i) in bodies.iter().enumerate() {
            edges.extend(nodes(i).map(|other| (at, other)));
        }
        for (at, (.., touched)) in groups.iter().enumerate() {
            edges.extend(touched.iter().flat_map(|&body| nodes(body)).map(|other| (other, bodies.len() + at)));
        }
        let sizes: Vec<usize> = bodies.iter().map(|&i| coordinates(m, i).len()).collect();
        let widths: Vec<usize> = groups.iter().map(|group| group.1).collect();
        let pattern = Pattern::new(&sizes, &widths, &edges);
        let mut mass = vec![];
        mass_entries(m, |row, column| mass.push(pattern.entry(row, column)));
        let mut rows = vec![];
        for (_, width, touched) in &groups {
            for _ in 0..*width {
                let row = m.freedom() + rows.len();
                rows.push(coordinates_below(m, touched).into_iter().map(|i| (i, pattern.entry(i, row))).collect());
            }
        }
        let (factor, unknowns) = (Factor::new(&pattern), pattern.unknowns());
        let [power, size] = [(); 2].map(|()| vec![0.0; m.freedom()]);
        let [side, found] = [(); 2].map(|()| vec![0.0; unknowns]);
        let groups = groups.into_iter().map(|group| group.0).collect();
        Some(SparseTree { factor, flops: pattern.flops(), bodies, groups, mass, rows, power, size, side, found })
    }
}

impl Workspace<'_> {
    /// Solves for accelerations and multipliers.
    pub(super) fn solve_sparse_tree(&mut self) -> Result<(), DynamicsError> {
        let mut memory = self.memory.take().unwrap_or_default();
        self.set_forces(&mut memory.force);
        memory.asked.clear();
        memory.asked.extend(self.rows.iter().map(|row| -row.bias));
        self.factor_sparse_tree();
        let solved = self.substitute_sparse_tree(&mut memory);
        self.solved.nu_dot.copy_from_slice(&memory.found.a);
        self.solved.lambda.clone_from(&memory.found.lambda);
        self.memory = Some(memory);
        self.k.propagate_motion(self.m, &self.solved.nu_dot, true, &mut self.solved.bodies);
        solved
    }

    /// The motion that changes the present rows by `asked`, least in the metric of the masses. Equations factored at a state as
    /// `near` as that do.
    pub(super) fn sparse_tree_correction(&mut self, asked: &[f64], near: f64) -> Result<Vec<f64>, DynamicsError> {
        if !self.is_factored(near, true) {
            loads::centre_arms(self.placed.view(self.m, &self.n, &self.k), &mut self.arms);
            self.factor_sparse_tree();
        }
        let mut memory = self.memory.take().unwrap_or_default();
        memory.force.clear();
        memory.force.resize(self.m.freedom(), 0.0);
        memory.asked.clear();
        memory.asked.extend_from_slice(asked);
        let corrected = self.substitute_sparse_tree(&mut memory).map(|()| memory.found.a.clone());
        self.memory = Some(memory);
        corrected
    }

    fn factor_sparse_tree(&mut self) {
        let at = self.placed.view(self.m, &self.n, &self.k);
        let of = self.sparse_tree.as_mut().expect("chosen when the workspace was made");
        let (mass, places, power, size) = (&of.mass, &of.rows, &mut of.power, &mut of.size);
        let (arms, carried, rows, length) = (&self.arms, &mut self.dense.carried, &self.rows, self.length);
        of.factor.refactor_entries(|_, values| {
            let mut next = mass.iter();
            visit_mass(at, arms, carried, |_, _, inertia| {
                values[*next.next().expect("an entry for each pair")] = inertia;
            });
            for (row, places) in rows.iter().zip(places) {
                power_entries(at, &row.motion, length, places, [power, size], values);
            }
        });
        self.dense.columns.clear();
        self.dense.columns.extend(column_scales(at, length));
        self.note_factored(true, true);
    }

    /// Solves the equations factored last for the sides in `memory`.
    fn substitute_sparse_tree(&mut self, memory: &mut Memory) -> Result<(), DynamicsError> {
        let n = self.m.freedom();
        let of = self.sparse_tree.as_mut().expect("chosen when the workspace was made");
        of.side.clear();
        of.side.extend(memory.force.iter().chain(&memory.asked));
        let solved = of.factor.solve_to(RESIDUAL, &of.side, &mut of.found);
        memory.found.a.clear();
        memory.found.a.extend_from_slice(&of.found[..n]);
        memory.found.lambda.clear();
        // The factorisation solves M ν̇ + Gᵀ(−λ) = f.
        memory.found.lambda.extend(of.found[n..].iter().map(|l| -l));
        solved.map(|_| ()).map_err(|stalled| DynamicsError::stalled(self.m, &stalled, &of.bodies, &of.groups))
    }
}
