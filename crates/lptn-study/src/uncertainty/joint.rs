//! Directions in which several parameters move together.
//!
//! Many small deviations may reach a kink together that none reaches alone. Runs at both ends of
//! each parameter give the changes of temperatures and margins. The vector of these changes is the
//! direction in which a quantity goes furthest for normal parameters of one probability density:
//! that of the design point of the first-order reliability method (A. M. Hasofer and N. C. Lind,
//! J. Eng. Mech. Div. ASCE 100 (1974) 111).

use lptn_network::{Limit, Network, NodeId};

/// The most nodes of one limit whose directions are followed: those of more are spread evenly.
const MOST_NODES: usize = 16;

/// The most quantities of one limit that are moved with all combinations of signs.
const MOST_SIGNED: usize = 3;

/// Directions whose cosine is more than this are one.
const SAME: f64 = 0.99;

/// The nodes whose temperatures limits read.
pub(crate) struct NodesRead {
    /// Every node once, ascending.
    pub(crate) nodes: Vec<NodeId>,
    /// For each limit the places of its nodes among them.
    pub(crate) of_limits: Vec<Vec<usize>>,
}

impl NodesRead {
    pub(crate) fn of(network: &Network, limits: &[Limit]) -> Self {
        let read = |limit: &Limit| spread(network.nodes_read_by(&limit.sides()));
        let all: Vec<Vec<NodeId>> = limits.iter().map(read).collect();
        let mut nodes = all.concat();
        nodes.sort_unstable();
        nodes.dedup();
        let place = |id: &NodeId| nodes.binary_search(id).unwrap_or_default();
        let of_limits = all.iter().map(|read| read.iter().map(place).collect()).collect();
        Self { nodes, of_limits }
    }
}

fn spread(nodes: Vec<NodeId>) -> Vec<NodeId> {
    let count = nodes.len();
    if count <= MOST_NODES {
        return nodes;
    }
    (0..MOST_NODES).map(|i| nodes[i * (count - 1) / (MOST_NODES - 1)]).collect()
}

/// Unit vectors in the space of independent normal numbers, other than its axes. Each group has the
/// changes of quantities with each of these numbers. The direction of every quantity is taken, and
/// for a few in one group those of their sums and differences: a limit may depend on both. At most
/// as many as there are numbers, and four.
pub(crate) fn directions(groups: &[Vec<Vec<f64>>]) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for group in groups {
        let mut own: Vec<Vec<f64>> = Vec::new();
        group.iter().filter_map(|changes| unit(changes)).for_each(|one| add(&mut own, one));
        let combined = if own.len() <= MOST_SIGNED { combinations(&own) } else { own };
        for one in combined {
            let most = one.len() + 4;
            if found.len() < most && one.iter().all(|part| part.abs() <= SAME) {
                add(&mut found, one);
            }
        }
    }
    found
}

/// The vectors, and the sums of all of them with every sign but for that of the first.
fn combinations(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut all = vectors.to_vec();
    let Some((first, others)) = vectors.split_first() else { return all };
    for signs in 0..1_u32 << others.len() {
        let mut sum = first.clone();
        for (i, other) in others.iter().enumerate() {
            let sign = if signs >> i & 1 == 0 { 1.0 } else { -1.0 };
            sum.iter_mut().zip(other).for_each(|(sum, part)| *sum += sign * part);
        }
        all.extend(unit(&sum));
    }
    all
}

/// The vector with length 1; `None` for zero.
fn unit(vector: &[f64]) -> Option<Vec<f64>> {
    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
    let known = length > 0.0 && length.is_finite();
    known.then(|| vector.iter().map(|part| part / length).collect())
}

/// Adds a direction that is not known, forwards or backwards.
fn add(known: &mut Vec<Vec<f64>>, one: Vec<f64>) {
    let cosine = |other: &Vec<f64>| other.iter().zip(&one).map(|(a, b)| a * b).sum::<f64>().abs();
    if known.iter().all(|other| cosine(other) <= SAME) {
        known.push(one);
    }
}

#[cfg(test)]
mod tests {
    use super::directions;

    #[test]
    fn directions_are_those_of_quantities_their_sums_and_differences() {
        let (a, b, none) = (vec![3.0, 0.0], vec![0.0, 2.0], vec![0.0, 0.0]);
        let half = 0.5_f64.sqrt();
        let found = directions(&[vec![a.clone(), b, none], vec![vec![-6.0, -6.0]]]);
        assert_eq!(found.len(), 2, "{found:?}");
        for (one, expected) in found.iter().zip([[half, half], [half, -half]]) {
            assert!(one.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?}");
        }
        assert!(directions(&[vec![a]]).is_empty());
    }
}
