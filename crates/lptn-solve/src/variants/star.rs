//! Networks solved by taking out one node after the other, each leaving conductances between its
//! neighbours (the star-mesh transformation). Sums and products of positive numbers, so that nothing
//! cancels however far conductances are apart.

use std::collections::BTreeSet;

use lptn_network::{Conductor, End};

/// Most pairs of neighbours in all eliminations together; beyond that a network is not for this
/// method.
const MOST_PAIRS: usize = 400_000;

/// The link of a conductor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Link {
    /// Between two nodes, by its place in [`Star::among`].
    Nodes(usize),
    /// From the node at this place to a boundary.
    Boundary(usize, usize),
    /// Between boundaries.
    Nothing,
}

/// Data shared by all candidates: the order in which nodes are taken out, and its fill.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The node at each place of the order, those without capacity first.
    pub(crate) order: Vec<usize>,
    /// The place of each node.
    pub(crate) place: Vec<usize>,
    /// Number of nodes without capacity.
    pub(crate) massless: usize,
    /// Start, in `later`, of the neighbours of each place that are taken out later.
    start: Vec<usize>,
    later: Vec<usize>,
    /// Slots of the conductances between every two of those, and where each place's begin.
    pairs: Vec<usize>,
    pairs_start: Vec<usize>,
    /// The link of each conductor.
    pub(crate) links: Vec<Link>,
}

impl Plan {
    /// The order of a network of conductors; `None` if too much would be filled in.
    pub(crate) fn new(massless: &[bool], conductors: &[Conductor]) -> Option<Self> {
        let n = massless.len();
        let mut around = vec![BTreeSet::new(); n];
        for conductor in conductors {
            if let (End::Node(a), End::Node(b)) = (conductor.from, conductor.to) {
                around[a.index()].insert(b.index());
                around[b.index()].insert(a.index());
            }
        }
        let mut plan = Self::ordered(massless, around)?;
        plan.links = conductors.iter().map(|conductor| plan.link(conductor)).collect();
        Some(plan)
    }

    /// The order of nodes with these neighbours.
    fn ordered(massless: &[bool], around: Vec<BTreeSet<usize>>) -> Option<Self> {
        let n = massless.len();
        let (order, neighbours) = eliminated(massless, around)?;
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(k, &node)| place[node] = k);
        let (mut start, mut later) = (vec![0], Vec::new());
        for neighbours in neighbours {
            let from = later.len();
            later.extend(neighbours.iter().map(|&node| place[node]));
            later[from..].sort_unstable();
            start.push(later.len());
        }
        let massless = massless.iter().filter(|massless| **massless).count();
        let (pairs, pairs_start, links) = (Vec::new(), Vec::new(), Vec::new());
        let mut plan = Self { order, place, massless, start, later, pairs, pairs_start, links };
        for k in 0..n {
            plan.pairs_start.push(plan.pairs.len());
            let more = plan.pairs_of(k);
            plan.pairs.extend(more);
        }
        Some(plan)
    }

    fn link(&self, conductor: &Conductor) -> Link {
        match (conductor.from, conductor.to) {
            (End::Node(a), End::Node(b)) => {
                let (a, b) = (self.place[a.index()], self.place[b.index()]);
                Link::Nodes(self.between(a.min(b), a.max(b)))
            }
            (End::Node(a), End::Boundary(b)) | (End::Boundary(b), End::Node(a)) => {
                Link::Boundary(self.place[a.index()], b.index())
            }
            (End::Boundary(_), End::Boundary(_)) => Link::Nothing,
        }
    }

    fn pairs_of(&self, k: usize) -> Vec<usize> {
        let later = &self.later[self.start[k]..self.start[k + 1]];
        let with = |(i, &a): (usize, &usize)| {
            later[i + 1..].iter().map(move |&b| self.between(a, b)).collect::<Vec<usize>>()
        };
        later.iter().enumerate().flat_map(with).collect()
    }

    /// The slot of the conductance between two places, the earlier one first.
    fn between(&self, a: usize, b: usize) -> usize {
        let later = &self.later[self.start[a]..self.start[a + 1]];
        self.start[a] + later.partition_point(|place| *place < b)
    }

    /// The places of both ends of every conductance between nodes from this place on, with its
    /// slot.
    pub(crate) fn between_all(&self, from: usize) -> impl Iterator<Item = (usize, usize, usize)> {
        let column = |k: usize| (self.start[k]..self.start[k + 1]).map(move |slot| (k, slot));
        (from..self.order.len()).flat_map(column).map(|(k, slot)| (k, self.later[slot], slot))
    }
}

/// The order with the fewest neighbours first, those without capacity before all others, and the
/// neighbours of each when it is taken out.
fn eliminated(
    massless: &[bool],
    mut around: Vec<BTreeSet<usize>>,
) -> Option<(Vec<usize>, Vec<BTreeSet<usize>>)> {
    let (mut order, mut neighbours, mut pairs) = (Vec::new(), Vec::new(), 0);
    let key = |node: usize, around: &[BTreeSet<usize>]| (!massless[node], around[node].len(), node);
    let mut waiting: BTreeSet<_> = (0..massless.len()).map(|node| key(node, &around)).collect();
    while let Some((.., node)) = waiting.pop_first() {
        let left = std::mem::take(&mut around[node]);
        pairs += left.len() * left.len() / 2;
        if pairs > MOST_PAIRS {
            return None;
        }
        for &a in &left {
            waiting.remove(&key(a, &around));
            around[a].remove(&node);
            around[a].extend(left.iter().filter(|b| **b != a));
            waiting.insert(key(a, &around));
        }
        order.push(node);
        neighbours.push(left);
    }
    Some((order, neighbours))
}

/// The conductances of one candidate after the other.
#[derive(Clone, Debug)]
pub(crate) struct Star {
    /// Conductance in W/K between every two places; once the earlier one is taken out, its share of
    /// that place's total.
    pub(crate) among: Vec<f64>,
    /// Conductance of each place to all surroundings in W/K.
    pub(crate) ground: Vec<f64>,
    /// Total conductance of each place when it was taken out, in W/K.
    total: Vec<f64>,
    work: Vec<f64>,
}

impl Star {
    pub(crate) fn new(plan: &Plan) -> Self {
        let of = |count: usize| vec![0.0; count];
        let n = plan.order.len();
        Self { among: of(plan.later.len()), ground: of(n), total: of(n), work: of(n) }
    }

    /// Begins with the conductors of a candidate, in W/K.
    pub(crate) fn begin(&mut self, plan: &Plan, conductance: &[f64]) {
        self.among.fill(0.0);
        self.ground.fill(0.0);
        for (link, &g) in plan.links.iter().zip(conductance) {
            match *link {
                Link::Nodes(slot) => self.among[slot] += g,
                Link::Boundary(place, _) => self.ground[place] += g,
                Link::Nothing => {}
            }
        }
    }

    /// Takes out the places of a range; `None` for a node that nothing determines.
    pub(crate) fn eliminate(&mut self, plan: &Plan, places: std::ops::Range<usize>) -> Option<()> {
        for k in places {
            let slots = plan.start[k]..plan.start[k + 1];
            let total = self.among[slots.clone()].iter().sum::<f64>() + self.ground[k];
            if !(total > 0.0 && total.is_finite()) {
                return None;
            }
            self.total[k] = total;
            let mut pairs = plan.pairs[plan.pairs_start[k]..].iter();
            for slot in slots.clone() {
                let share = self.among[slot] / total;
                self.ground[plan.later[slot]] += share * self.ground[k];
                for (other, &to) in (slot + 1..slots.end).zip(&mut pairs) {
                    self.among[to] += share * self.among[other];
                }
                self.among[slot] = share;
            }
        }
        Some(())
    }

    /// Replaces the heat into each node in W by its rise over the surroundings in K, once all are
    /// taken out.
    pub(crate) fn solve(&mut self, plan: &Plan, heat: &mut [f64]) {
        for (work, &node) in self.work.iter_mut().zip(&plan.order) {
            *work = heat[node];
        }
        for k in 0..self.work.len() {
            let h = self.work[k];
            for slot in plan.start[k]..plan.start[k + 1] {
                self.work[plan.later[slot]] += self.among[slot] * h;
            }
        }
        for k in (0..self.work.len()).rev() {
            let shared = self.shared(plan, k, |place| self.work[place]);
            self.work[k] = self.work[k] / self.total[k] + shared;
        }
        for (&work, &node) in self.work.iter().zip(&plan.order) {
            heat[node] = work;
        }
    }

    /// Gives nodes without capacity and without heat their rises from those of their neighbours.
    pub(crate) fn recover(&self, plan: &Plan, rises: &mut [f64]) {
        for k in (0..plan.massless).rev() {
            rises[plan.order[k]] = self.shared(plan, k, |place| rises[plan.order[place]]);
        }
    }

    /// The rise of a place from those of its later neighbours.
    fn shared(&self, plan: &Plan, k: usize, rise: impl Fn(usize) -> f64) -> f64 {
        let slots = plan.start[k]..plan.start[k + 1];
        let later = plan.later[slots.clone()].iter();
        self.among[slots].iter().zip(later).map(|(share, &to)| share * rise(to)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Link, Plan, Star};
    use std::collections::BTreeSet;

    /// A plan of nodes joined in this way; the conductor to a boundary of each node comes last.
    fn plan(massless: &[bool], joined: &[(usize, usize)]) -> Plan {
        let mut around = vec![BTreeSet::new(); massless.len()];
        for &(a, b) in joined {
            around[a].insert(b);
            around[b].insert(a);
        }
        let mut plan = Plan::ordered(massless, around).unwrap();
        let link = |&(a, b): &(usize, usize)| {
            let (a, b) = (plan.place[a], plan.place[b]);
            Link::Nodes(plan.between(a.min(b), a.max(b)))
        };
        let mut links: Vec<Link> = joined.iter().map(link).collect();
        links.extend(plan.place.iter().map(|&place| Link::Boundary(place, 0)));
        plan.links = links;
        plan
    }

    /// A chain of three: rises are sums of heat times the resistances that it passes.
    #[test]
    fn a_chain_with_conductances_far_apart() {
        let plan = plan(&[false; 3], &[(0, 1), (1, 2)]);
        let mut star = Star::new(&plan);
        for _ in 0..2 {
            star.begin(&plan, &[1e9, 1e-3, 0.0, 0.0, 2.0]);
            star.eliminate(&plan, 0..3).unwrap();
            let mut rises = [5.0, 0.0, 1.0 + 2.0 * 10.0];
            star.solve(&plan, &mut rises);
            let last = 10.0 + 6.0 / 2.0;
            let expected = [last + 5.0 * (1e3 + 1e-9), last + 5.0 * 1e3, last];
            for (rise, expected) in rises.iter().zip(expected) {
                assert!((rise - expected).abs() < 1e-14 * expected, "{rise} {expected}");
            }
        }
        star.begin(&plan, &[1.0, 0.0, 1.0, 0.0, 0.0]);
        assert!(star.eliminate(&plan, 0..3).is_none());
    }

    /// A ring of five, two of them without capacity, of conductances 1 and to the surroundings 1
    /// from one: rises after heat of 1 W into its neighbour (by hand: 3 + 4/5 and so on), and the
    /// two as mean values of their neighbours.
    #[test]
    fn a_ring_that_fills_in_and_nodes_that_follow() {
        let joined = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)];
        let plan = plan(&[false, true, false, false, true], &joined);
        assert_eq!(plan.massless, 2);
        let mut star = Star::new(&plan);
        let mut g = vec![1.0; 5];
        g.extend([1.0, 0.0, 0.0, 0.0, 0.0]);
        star.begin(&plan, &g);
        star.eliminate(&plan, 0..2).unwrap();
        star.eliminate(&plan, 2..5).unwrap();
        let mut rises = [0.0, 1.0, 0.0, 0.0, 0.0];
        star.solve(&plan, &mut rises);
        // 1 W goes to the surroundings; on the ring 4/5 W take the short way and 1/5 the long one
        for (rise, expected) in rises.iter().zip([1.0, 1.8, 1.6, 1.4, 1.2]) {
            assert!((rise - expected).abs() < 1e-15, "{rises:?}");
        }
        let mut followed = [rises[0], f64::NAN, rises[2], rises[3], f64::NAN];
        star.recover(&plan, &mut followed);
        assert!((followed[1] - 0.5 * (1.0 + 1.6)).abs() < 1e-15);
        assert!((followed[4] - 0.5 * (1.0 + 1.4)).abs() < 1e-15);
    }
}
