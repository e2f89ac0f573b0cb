//! Spanning trees. Knows no physics.

/// An edge that may join two nodes in a tree.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Its two ends.
    pub ends: [usize; 2],
    /// How much it is wanted in the tree, walked from its first end or from its second: the smaller
    /// the sooner; None when it cannot be walked that way.
    pub rank: [Option<u32>; 2],
}

/// A step of a tree: `child` hangs on `parent` by `edge`, walked against its direction if `reversed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The node nearer to the root.
    pub parent: usize,
    /// The node reached.
    pub child: usize,
    /// Index of the edge.
    pub edge: usize,
    /// Whether the edge's second end is the parent.
    pub reversed: bool,
}

/// Grows a tree from node 0, most wanted edges first, breadth first among equals (Prim's algorithm).
///
/// Nodes that no edge reaches are attached by `adopt`, which gets the node and returns the index of a
/// new edge from node 0; `orphans`, all nodes but 0, says which is asked first. Branches come parents first.
pub fn spanning_tree(orphans: &[usize], edges: &[Edge], mut adopt: impl FnMut(usize) -> usize) -> Vec<Branch> {
    let nodes = orphans.len() + 1;
    let mut at: Vec<Vec<usize>> = vec![vec![]; nodes];
    for (i, e) in edges.iter().enumerate() {
        e.ends.iter().for_each(|&end| at[end].push(i));
    }
    let mut frontier = std::collections::BinaryHeap::new();
    let mut contacts = vec![false; nodes];
    let mut tree = Vec::with_capacity(orphans.len());
    let mut orphans = orphans.iter();
    let arrive = |node: usize, contacts: &mut Vec<bool>, frontier: &mut std::collections::BinaryHeap<_>, age: usize| {
        contacts[node] = true;
        for &i in &at[node] {
            for (side, rank) in edges[i].rank.iter().enumerate() {
                if let (true, Some(rank)) = (edges[i].ends[side] == node, rank) {
                    frontier.push(std::cmp::Reverse((*rank, age, i, side)));
                }
            }
        }
    };
    arrive(0, &mut contacts, &mut frontier, 0);
    loop {
        while let Some(std::cmp::Reverse((_, _, i, side))) = frontier.pop() {
            let (parent, child) = (edges[i].ends[side], edges[i].ends[1 - side]);
            if !contacts[child] {
                tree.push(Branch { parent, child, edge: i, reversed: side == 1 });
                arrive(child, &mut contacts, &mut frontier, tree.len());
            }
        }
        let Some(&child) = orphans.find(|&&node| !contacts[node]) else { return tree };
        let edge = adopt(child);
        tree.push(Branch { parent: 0, child, edge, reversed: false });
        arrive(child, &mut contacts, &mut frontier, tree.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(a: usize, b: usize, rank: u32) -> Edge {
        Edge { ends: [a, b], rank: [Some(rank), Some(rank)] }
    }

    #[test]
    fn a_loop_is_cut_at_its_least_wanted_edge() {
        let edges = [edge(0, 1, 1), edge(1, 2, 1), edge(2, 3, 5), edge(3, 0, 1)];
        let tree = spanning_tree(&[1, 2, 3], &edges, |_| unreachable!());
        let mut used: Vec<_> = tree.iter().map(|b| b.edge).collect();
        used.sort();
        assert_eq!(used, [0, 1, 3]);
        assert!(tree.iter().any(|b| b.edge == 3 && b.reversed));
    }

    #[test]
    fn unreached_nodes_are_adopted_parents_first() {
        let tree = spanning_tree(&[1, 2, 3], &[edge(3, 2, 0)], |node| 100 + node);
        assert_eq!(tree.iter().map(|b| b.child).collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!(tree[2], Branch { parent: 2, child: 3, edge: 0, reversed: true });
    }
}
