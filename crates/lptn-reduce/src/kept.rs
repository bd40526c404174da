//! Several nodes of a network with the conductances between them: a network of fewer nodes with
//! positive elements.
//!
//! The elements are a Schur complement with moved capacities, from one solution a node, so that
//! large networks are not eliminated.

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense;
use lptn_network::{Network, NodeId};

use crate::error::ReduceError;
use crate::kept_errors::{KeptErrors, KeptReference};
use crate::norton::{NortonEquivalent, grounded};
use crate::rises::{Rises, Way};

/// A network reduced to some of its nodes.
///
/// The conductances between the nodes are those of the Schur complement (G. Kron, Tensor Analysis
/// of Networks, 1939): the inverse of the block of `G^-1` that belongs to them. In steady state
/// every temperature of these nodes and every heat of a boundary is exact. The capacity of a node
/// that is left out goes to the kept nodes in the shares in which its temperature follows theirs,
/// as in TICER (B. N. Sheehan, ICCAD 1999, 200). If that reduces the error over every load, the
/// capacities are then changed by the least amount that gives the responses at the requested nodes
/// their first moments, `sum of Z_pn C_n Z_nq`. All elements are positive, so the reduced network
/// is passive.
///
/// Further nodes are those that follow the others latest. The mean delay of a node with all chosen
/// ones fixed is the solution of the network for the heat `C_n` in every node.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The nodes that stay: the requested ones, then those that were chosen.
    pub nodes: Vec<NodeId>,
    /// Number of requested nodes.
    pub asked: usize,
    /// Heat capacity of each in J/K.
    pub capacity: Vec<f64>,
    /// Conductance between two of them in W/K, the lower place first.
    pub links: Vec<(usize, usize, f64)>,
    /// Conductance of each to every boundary in W/K.
    pub grounds: Vec<Vec<f64>>,
    /// Share of the heat of every source that each gets; the rest goes to boundaries at once.
    pub shares: Vec<Vec<f64>>,
    /// Share of each in the temperature of every node of the network: between 0 and 1.
    pub weights: Vec<Vec<f64>>,
    /// Largest error of the first moments at the requested nodes, relative to them.
    pub moments: f64,
}

/// The part of every node's temperature that does not follow from the kept ones, exact in steady
/// state: `T_n = sum of weights T_kept + sum of boundaries T_b + sum of sources P`. In between, it
/// assumes that the other nodes are at rest among the kept ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovery {
    /// Share of each boundary in every node; empty for a boundary that none feels.
    pub boundaries: Vec<Vec<f64>>,
    /// Rise of every node for each source in K/W, with the kept nodes fixed.
    pub sources: Vec<Vec<f64>>,
}

impl Kept {
    /// Keeps the requested nodes and chooses more until there are `count`, or all. The smallest
    /// error over every load decides if capacities are changed, and how much of that falls on large
    /// ones.
    ///
    /// # Errors
    /// [`ReduceError::NoGround`], [`ReduceError::NotLinear`], [`ReduceError::OneWay`] if streams go
    /// on from node to node, [`ReduceError::Factorization`], and as [`Kept::network`].
    pub fn new(
        system: &ThermalSystem,
        reference: &KeptReference,
        count: usize,
    ) -> Result<(Self, KeptErrors), ReduceError> {
        let mut rises = Rises::new(system)?;
        if !rises.is_symmetric() {
            return Err(ReduceError::OneWay);
        }
        let asked = reference.asked();
        let mut choice = Choice::new(system, &mut rises)?;
        for &node in asked {
            choice.take(node, &mut rises)?;
        }
        while choice.columns.len() < count {
            let Some(node) = choice.latest()? else { break };
            choice.take(node, &mut rises)?;
        }
        let mut best: Option<(Self, KeptErrors)> = None;
        for power in POWERS {
            let kept = choice.kept(asked.len(), power)?;
            let errors = reference.errors(&kept.network(system, reference.start())?)?;
            if best.as_ref().is_none_or(|(_, before)| errors.share() < before.share()) {
                best = Some((kept, errors));
            }
        }
        best.ok_or(ReduceError::Modes)
    }

    /// Recovers all temperatures from those of the kept nodes.
    ///
    /// # Errors
    /// As [`Kept::new`].
    pub fn recovery(&self, system: &ThermalSystem) -> Result<Recovery, ReduceError> {
        let network = system.network();
        let mut rises = Rises::new(system)?;
        // the part of a temperature field that the chosen nodes do not explain
        let rest = |field: Vec<f64>| -> Vec<f64> {
            let mut rest = field.clone();
            for (node, weights) in self.nodes.iter().zip(&self.weights) {
                let here = field[node.index()];
                rest.iter_mut().zip(weights).for_each(|(t, w)| *t -= w * here);
            }
            rest
        };
        let mut boundaries = Vec::new();
        for boundary in 0..network.boundaries().len() {
            boundaries.push(rest(rises.of_boundary(boundary)?));
        }
        let mut sources = Vec::new();
        for source in network.sources() {
            let mut heat = vec![0.0; network.nodes().len()];
            source.into.iter().for_each(|(node, share)| heat[node.index()] += share);
            sources.push(rest(rises.of_nodes(&heat, Way::Forth)?));
        }
        Ok(Recovery { boundaries, sources })
    }

    /// Number of nodes.
    pub fn count(&self) -> usize {
        self.nodes.len()
    }
}

/// Powers of the capacities that weigh their changes: no change, in proportion, and more of the
/// large ones.
const POWERS: [Option<i32>; 4] = [None, Some(1), Some(2), Some(3)];

/// Shares and conductances below this part of the whole are rounding.
const ROUNDING: f64 = 1e-12;

/// Nodes chosen up to now, each with its Norton equivalent.
struct Choice<'a> {
    system: &'a ThermalSystem,
    columns: Vec<NortonEquivalent>,
    capacity: Vec<f64>,
    /// Mean delay of every node with only the boundaries fixed, in s.
    delay: Vec<f64>,
}

impl<'a> Choice<'a> {
    fn new(system: &'a ThermalSystem, rises: &mut Rises<'_>) -> Result<Self, ReduceError> {
        let network: &Network = system.network();
        let mut capacity: Vec<f64> = network.node_ids().map(|id| network.capacity(id)).collect();
        for loose in network.ungrounded().into_iter().flatten() {
            capacity[loose.index()] = 0.0; // the heat of a separate island does not matter
        }
        let delay = rises.of_nodes(&capacity, Way::Forth)?;
        Ok(Self { system, columns: Vec::new(), capacity, delay })
    }

    fn take(&mut self, node: NodeId, rises: &mut Rises<'_>) -> Result<(), ReduceError> {
        grounded(self.system.network(), node)?;
        self.columns.push(NortonEquivalent::with(self.system, node, rises)?);
        Ok(())
    }

    /// The node with capacity that follows the chosen ones latest, among those that feel them.
    fn latest(&self) -> Result<Option<NodeId>, ReduceError> {
        let held = self.held(&self.delay)?;
        let felt = |id: &NodeId| self.columns.iter().any(|c| c.response[id.index()] > 0.0);
        let taken = |id: &NodeId| self.columns.iter().any(|c| c.port == *id);
        let ids = self.system.network().node_ids();
        let open = ids.filter(|id| self.capacity[id.index()] > 0.0 && felt(id) && !taken(id));
        let late = |id: &NodeId| held[id.index()];
        Ok(open.max_by(|a, b| late(a).total_cmp(&late(b))))
    }

    /// `Z` among the chosen nodes, in K/W.
    fn among(&self) -> Mat<f64> {
        let k = self.columns.len();
        let entry = |i: usize, j: usize| self.columns[i].response[self.columns[j].port.index()];
        Mat::from_fn(k, k, |i, j| 0.5 * (entry(i, j) + entry(j, i)))
    }

    /// Temperatures less the part that follows from those of the chosen nodes.
    fn held(&self, temperatures: &[f64]) -> Result<Vec<f64>, ReduceError> {
        let at = |i: usize| temperatures[self.columns[i].port.index()];
        let b = Mat::from_fn(self.columns.len(), 1, |i, _| at(i));
        let heat = solved(&self.among(), &b)?;
        let mut held = temperatures.to_vec();
        for (i, column) in self.columns.iter().enumerate() {
            held.iter_mut().zip(&column.response).for_each(|(t, r)| *t -= heat[(i, 0)] * r);
        }
        Ok(held)
    }

    fn kept(&self, asked: usize, power: Option<i32>) -> Result<Kept, ReduceError> {
        let k = self.columns.len();
        let among = self.among();
        let inverse = solved(&among, &Mat::identity(k, k))?;
        let follow = |of: &dyn Fn(&NortonEquivalent) -> Vec<f64>| -> Vec<Vec<f64>> {
            let rows: Vec<Vec<f64>> = self.columns.iter().map(of).collect();
            combined(&inverse, &rows)
        };
        let mut weights = follow(&|column| column.response.clone());
        let mut grounds = follow(&|column| column.boundary_weights.clone());
        let mut shares =
            follow(&|column| column.source_weights.iter().map(|w| w * column.resistance).collect());
        weights.iter_mut().chain(&mut shares).flatten().for_each(|share| *share = clean(*share));
        for (k, grounds) in grounds.iter_mut().enumerate() {
            grounds.iter_mut().filter(|g| **g < ROUNDING * inverse[(k, k)]).for_each(|g| *g = 0.0);
        }
        let shared = self.moved(&weights);
        let (capacity, moments) = self.matched(&among, shared, (asked, power))?;
        let mut links = Vec::new();
        for i in 0..k {
            for j in i + 1..k {
                let g = -0.5 * (inverse[(i, j)] + inverse[(j, i)]);
                let scale = (inverse[(i, i)] * inverse[(j, j)]).sqrt();
                if g > 1e-14 * scale {
                    links.push((i, j, g));
                }
            }
        }
        let nodes = self.columns.iter().map(|column| column.port).collect();
        Ok(Kept { nodes, asked, capacity, links, grounds, shares, weights, moments })
    }

    /// Each chosen node's part of all capacities in J/K.
    fn moved(&self, weights: &[Vec<f64>]) -> Vec<f64> {
        let part = |w: &Vec<f64>| w.iter().zip(&self.capacity).map(|(w, c)| w * c).sum();
        weights.iter().map(part).collect()
    }

    /// The capacities nearest to these with the first moments of the whole network at the requested
    /// nodes, and the remaining error.
    fn matched(
        &self,
        among: &Mat<f64>,
        start: Vec<f64>,
        (asked, power): (usize, Option<i32>),
    ) -> Result<(Vec<f64>, f64), ReduceError> {
        let k = start.len();
        let all: Vec<(usize, usize)> =
            (0..asked).flat_map(|p| (p..asked).map(move |q| (p, q))).collect();
        let own = all.iter().copied().filter(|(p, q)| p == q);
        let pairs: Vec<(usize, usize)> = if all.len() <= k { all.clone() } else { own.collect() };
        let entry = |(p, q): (usize, usize), j: usize| among[(p, j)] * among[(j, q)];
        let whole = |(p, q): (usize, usize)| -> f64 {
            let (a, b) = (&self.columns[p].response, &self.columns[q].response);
            a.iter().zip(b).zip(&self.capacity).map(|((a, b), c)| a * b * c).sum()
        };
        let has = |c: &[f64], pair| (0..k).map(|j| entry(pair, j) * c[j]).sum::<f64>();
        let missing = |c: &[f64], pair: (usize, usize)| {
            let scale = (whole((pair.0, pair.0)) * whole((pair.1, pair.1))).sqrt();
            if scale > 0.0 { (whole(pair) - has(c, pair)) / scale } else { 0.0 }
        };
        let scale = |pair: (usize, usize)| {
            (whole((pair.0, pair.0)) * whole((pair.1, pair.1))).sqrt().max(f64::MIN_POSITIVE)
        };
        // the least change, with each capacity weighed by its power, that gives the moments
        let largest = start.iter().copied().fold(0.0, f64::max);
        let exponent = 0.5 * f64::from(power.unwrap_or(1) - 1);
        let ease = |j: usize| start[j] * (start[j] / largest).powf(exponent);
        let a = Mat::from_fn(k, pairs.len(), |j, r| entry(pairs[r], j) * ease(j) / scale(pairs[r]));
        let gram = dense::product(a.transpose(), a.as_ref());
        let b = Mat::from_fn(pairs.len(), 1, |r, _| missing(&start, pairs[r]));
        let solved = power.and_then(|_| dense::cholesky_solve(gram.as_ref(), b.as_ref()));
        let capacity = match solved {
            Some(multipliers) => {
                let change = dense::product(a.as_ref(), multipliers.as_ref());
                let change: Vec<f64> = (0..k).map(|j| change[(j, 0)] * ease(j)).collect();
                // at most nine tenths of a capacity are taken away
                let shares = change.iter().zip(&start).map(|(change, c)| change / c);
                let least = shares.filter(|share| share.is_finite()).fold(0.0, f64::min);
                let part = if least < -0.9 { -0.9 / least } else { 1.0 };
                start.iter().zip(&change).map(|(c, change)| c + part * change).collect()
            }
            None => start,
        };
        let moments = all.iter().map(|&pair| missing(&capacity, pair).abs()).fold(0.0, f64::max);
        Ok((capacity, moments))
    }
}

/// A share without rounding errors near 0 and 1.
fn clean(share: f64) -> f64 {
    if share < ROUNDING {
        0.0
    } else if (share - 1.0).abs() < ROUNDING {
        1.0
    } else {
        share
    }
}

/// `inverse` times rows.
fn combined(inverse: &Mat<f64>, rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let length = rows.first().map_or(0, Vec::len);
    let row = |i: usize| -> Vec<f64> {
        let at = |n: usize| (0..rows.len()).map(|j| inverse[(i, j)] * rows[j][n]).sum::<f64>();
        (0..length).map(|n| at(n).max(0.0)).collect()
    };
    (0..rows.len()).map(row).collect()
}

fn solved(a: &Mat<f64>, b: &Mat<f64>) -> Result<Mat<f64>, ReduceError> {
    dense::cholesky_solve(a.as_ref(), b.as_ref()).ok_or(ReduceError::Modes)
}
