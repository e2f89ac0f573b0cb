//! A fill-reducing elimination order.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A node with more than this times √n neighbours is eliminated last (as in AMD).
const DENSE: f64 = 10.0;
/// Neighbours that no node is eliminated last for.
const FEW: f64 = 16.0;

/// An order in which symmetric elimination of the graph causes little fill: `order[k]` is the k-th
/// node to eliminate. `weights` are the nodes' numbers of unknowns, `edges` pairs of nodes in any
/// order, repeated or not.
///
/// Minimum approximate external degree on the quotient graph (Amestoy, Davis & Duff, SIAM J. Matrix
/// Anal. Appl. 17, 1996), near-linear on chains and ladders; ties go to the lower node.
pub fn minimum_degree(weights: &[usize], edges: &[(usize, usize)]) -> Vec<usize> {
    let mut graph = Quotient::new(weights, edges);
    let mut order = Vec::with_capacity(weights.len());
    while let Some(p) = graph.cheapest() {
        graph.eliminate(p);
        order.push(p);
    }
    order.extend(graph.dense);
    order
}

/// Nodes still to eliminate, and cliques (elements) left by those that are.
struct Quotient {
    weight: Vec<usize>,
    /// Neighbours that are not eliminated.
    nodes: Vec<Vec<usize>>,
    /// Cliques a node belongs to, each named after the node whose elimination made it.
    cliques: Vec<Vec<usize>>,
    members: Vec<Vec<usize>>,
    size: Vec<usize>,
    degree: Vec<usize>,
    gone: Vec<bool>,
    queue: BinaryHeap<Reverse<(usize, usize)>>,
    dense: Vec<usize>,
    stamp: Vec<usize>,
    outside: Vec<(usize, usize)>,
}

impl Quotient {
    fn new(weights: &[usize], edges: &[(usize, usize)]) -> Self {
        let n = weights.len();
        let mut nodes = adjacency(n, edges);
        let limit = FEW.max(DENSE * (n as f64).sqrt()) as usize;
        let (dense, gone): (Vec<_>, Vec<_>) = split_dense(&nodes, limit);
        nodes.iter_mut().for_each(|list| list.retain(|&j| !gone[j]));
        let weigh = |list: &Vec<usize>| list.iter().map(|&j| weights[j]).sum();
        let degree: Vec<usize> = nodes.iter().map(weigh).collect();
        let queue = (0..n).filter(|&i| !gone[i]).map(|i| Reverse((degree[i], i))).collect();
        Quotient {
            weight: weights.to_vec(),
            nodes,
            cliques: vec![Vec::new(); n],
            members: vec![Vec::new(); n],
            size: vec![0; n],
            degree,
            gone,
            queue,
            dense,
            stamp: vec![usize::MAX; n],
            outside: vec![(usize::MAX, 0); n],
        }
    }

    /// The node of least degree; entries of the queue that have been superseded are skipped.
    fn cheapest(&mut self) -> Option<usize> {
        while let Some(Reverse((degree, p))) = self.queue.pop() {
            if !self.gone[p] && degree == self.degree[p] {
                return Some(p);
            }
        }
        None
    }

    fn eliminate(&mut self, p: usize) {
        self.gone[p] = true;
        let clique = self.merge(p);
        self.size[p] = clique.iter().map(|&i| self.weight[i]).sum();
        self.measure_outside(p, &clique);
        for &i in &clique {
            self.update(p, i);
        }
        self.members[p] = clique;
    }

    /// The neighbours of p, whose cliques are absorbed.
    fn merge(&mut self, p: usize) -> Vec<usize> {
        let mut clique = std::mem::take(&mut self.nodes[p]);
        for e in std::mem::take(&mut self.cliques[p]) {
            clique.append(&mut self.members[e]);
            self.size[e] = 0;
        }
        let (stamp, gone) = (&mut self.stamp, &self.gone);
        clique.retain(|&i| !gone[i] && std::mem::replace(&mut stamp[i], p) != p);
        clique
    }

    /// For each older clique that meets p's, the weight of its part outside.
    fn measure_outside(&mut self, p: usize, clique: &[usize]) {
        for &i in clique {
            for &e in self.cliques[i].iter().filter(|&&e| self.size[e] > 0) {
                let (stamp, weight) = &mut self.outside[e];
                if *stamp != p {
                    (*stamp, *weight) = (p, self.size[e]);
                }
                *weight -= self.weight[i];
            }
        }
    }

    /// Makes i a member of clique p; what p covers leaves i's lists.
    fn update(&mut self, p: usize, i: usize) {
        let (stamp, gone) = (&self.stamp, &self.gone);
        self.nodes[i].retain(|&j| !gone[j] && stamp[j] != p);
        let (size, outside) = (&self.size, &self.outside);
        self.cliques[i].retain(|&e| size[e] > 0 && outside[e].1 > 0);
        let within = self.size[p] - self.weight[i];
        let apart: usize = self.nodes[i].iter().map(|&j| self.weight[j]).sum();
        let beyond: usize = self.cliques[i].iter().map(|&e| outside[e].1).sum();
        let degree = (self.degree[i] + within).min(apart + within + beyond);
        self.cliques[i].push(p);
        if degree != self.degree[i] {
            self.degree[i] = degree;
            self.queue.push(Reverse((degree, i)));
        }
    }
}

fn adjacency(n: usize, edges: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut nodes = vec![Vec::new(); n];
    for &(i, j) in edges.iter().filter(|(i, j)| i != j) {
        nodes[i].push(j);
        nodes[j].push(i);
    }
    for list in &mut nodes {
        list.sort_unstable();
        list.dedup();
    }
    nodes
}

fn split_dense(nodes: &[Vec<usize>], limit: usize) -> (Vec<usize>, Vec<bool>) {
    let gone: Vec<bool> = nodes.iter().map(|list| list.len() > limit).collect();
    ((0..nodes.len()).filter(|&i| gone[i]).collect(), gone)
}
