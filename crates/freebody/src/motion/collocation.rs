//! Polynomials over a step, 0 at its start, by their values at nodes.
//!
//! They are sums of those that are 1 at one node and 0 at the others (Lagrange); the step goes from 0 to 1.

/// The values of these at `theta`.
pub(super) fn values<const S: usize>(nodes: &[f64; S], theta: f64) -> [f64; S] {
    std::array::from_fn(|k| {
        let others = nodes.iter().enumerate().filter(|(l, _)| *l != k);
        others.fold(theta / nodes[k], |product, (_, node)| product * (theta - node) / (nodes[k] - node))
    })
}

/// Their slopes at `theta`: the product rule, exact at 0 and at the nodes.
pub(super) fn slopes<const S: usize>(nodes: &[f64; S], theta: f64) -> [f64; S] {
    let zero = |l: usize| nodes.get(l).copied().unwrap_or(0.0);
    std::array::from_fn(|k| {
        let others = |but: usize| (0..=S).filter(move |&l| l != k && l != but);
        let without = |j| others(j).fold(1.0, |product, l| product * (theta - zero(l)) / (zero(k) - zero(l)));
        others(k).map(|j| without(j) / (zero(k) - zero(j))).sum()
    })
}

/// What each adds to the numbers F of a [`super::Segment`]; first by number, then by node.
pub(super) fn bends<const S: usize>(nodes: &[f64; S]) -> [[f64; S]; S] {
    let mut found = [[0.0; S]; S];
    for k in 0..S {
        let mut left = over_theta(nodes, k);
        for (i, row) in found.iter_mut().enumerate() {
            row[k] = if i % 2 == 0 { left.iter().sum() } else { left[0] };
            left = if i % 2 == 0 { less_at_one(&left) } else { less_at_zero(&left) };
        }
    }
    found
}

/// Coefficients of 1, θ, θ² … in polynomial `k`, over θ.
fn over_theta<const S: usize>(nodes: &[f64; S], k: usize) -> [f64; S] {
    let mut product = [0.0; S];
    product[0] = 1.0 / nodes[k];
    for (_, node) in nodes.iter().enumerate().filter(|(l, _)| *l != k) {
        for i in (0..S).rev() {
            let lower = if i > 0 { product[i - 1] } else { 0.0 };
            product[i] = (lower - node * product[i]) / (nodes[k] - node);
        }
    }
    product
}

/// (p(θ) − p(1))/(1 − θ), by coefficients.
fn less_at_one<const S: usize>(p: &[f64; S]) -> [f64; S] {
    std::array::from_fn(|i| -p[i + 1..].iter().sum::<f64>())
}

/// (p(θ) − p(0))/θ, by coefficients.
fn less_at_zero<const S: usize>(p: &[f64; S]) -> [f64; S] {
    std::array::from_fn(|i| p.get(i + 1).copied().unwrap_or(0.0))
}
