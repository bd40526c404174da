//! Exact elimination of linear massless nodes, and their recovery.
//!
//! A massless node m with conductances g_i to its neighbours and the heat q put into it has the
//! temperature `T_m = (q + sum g_i T_i) / sum g`. Putting this into the balances of its neighbours
//! links every pair of them with `g_i g_j / sum g` and gives each the share `q g_i / sum g` of the
//! heat: the star-mesh transformation (A. Rosen, J. IEE 62 (1924) 916). Only sums, products and
//! quotients of positive numbers occur, so nothing cancels and the result is exact to rounding for
//! any spread of conductances.
//!
//! A general Schur complement is not exact in this way. A vertex with very many neighbours would
//! link them all. It is refused with a message, because it could fill the memory.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::ops::Range;

use lptn_units::Taylor;

/// A conductance between two vertices: nodes come first, then boundaries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) g: f64,
}

impl Link {
    /// Adds the heat between two unknowns at their temperatures in K to that of each, in W.
    pub(crate) fn add_heat(&self, temperatures: &[f64], heat: &mut [f64]) {
        let (a, b) = (self.a as usize, self.b as usize);
        let q = self.g * (temperatures[a] - temperatures[b]);
        heat[a] -= q;
        heat[b] += q;
    }
}

/// One eliminated vertex with the weights `g_i / sum g` of the neighbours it had at its turn.
#[derive(Clone, Debug)]
struct Star {
    vertex: u32,
    total: f64,
    /// The neighbour with the largest weight: temperatures are averaged as differences to it, so
    /// that a vertex between equal temperatures has that temperature to the last digit.
    nearest: u32,
    /// Positions of its weights in those of all stars.
    weights: Range<usize>,
}

/// The eliminated vertices, in the order of elimination.
#[derive(Clone, Debug, Default)]
pub(crate) struct Elimination {
    stars: Vec<Star>,
    /// The weights of all stars in one piece: they are read at every evaluated time.
    weights: Vec<(u32, f64)>,
}

/// A vertex that has too many neighbours to be eliminated.
pub(crate) struct TooMany {
    pub(crate) vertex: u32,
    pub(crate) neighbours: usize,
}

/// Number of links that the elimination may add to the given ones: up to about 50 bytes each, so at
/// most 1 GB.
const FILL_LIMIT: usize = 20_000_000;

impl Elimination {
    /// Eliminates the vertices marked in `massless` from `links`; returns the remaining links
    /// merged and sorted.
    pub(crate) fn new(links: Vec<Link>, massless: &[bool]) -> Result<(Self, Vec<Link>), TooMany> {
        Self::within(FILL_LIMIT, links, massless)
    }

    fn within(
        limit: usize,
        links: Vec<Link>,
        massless: &[bool],
    ) -> Result<(Self, Vec<Link>), TooMany> {
        let is_massless = |v: u32| massless.get(v as usize).copied().unwrap_or(false);
        let mut graph =
            Graph { stars: BTreeMap::new(), kept: Vec::new(), added: 0, is_massless: &is_massless };
        links.into_iter().for_each(|link| graph.add(link));
        graph.added = 0;
        let mut done = Self { stars: Vec::with_capacity(graph.stars.len()), weights: Vec::new() };
        let mut queue: BinaryHeap<Reverse<(usize, u32)>> =
            graph.stars.iter().map(|(&v, neighbours)| Reverse((neighbours.len(), v))).collect();
        while let Some(Reverse((degree, vertex))) = queue.pop() {
            let Some(neighbours) = graph.stars.get(&vertex) else { continue };
            if neighbours.len() != degree {
                continue; // an entry from before a neighbour went
            }
            if graph.added + degree * degree.saturating_sub(1) / 2 > limit {
                return Err(TooMany { vertex, neighbours: degree });
            }
            let neighbours = graph.eliminate(vertex);
            for &(neighbour, _) in &neighbours {
                if let Some(next) = graph.stars.get(&neighbour) {
                    queue.push(Reverse((next.len(), neighbour)));
                }
            }
            done.push(vertex, &neighbours);
        }
        Ok((done, merged(graph.kept)))
    }

    /// Adds a vertex with the conductances to the neighbours that it had.
    fn push(&mut self, vertex: u32, neighbours: &[(u32, f64)]) {
        let total: f64 = neighbours.iter().map(|&(_, g)| g).sum();
        let nearest = neighbours.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let begin = self.weights.len();
        self.weights.extend(neighbours.iter().map(|&(v, g)| (v, g / total)));
        self.stars.push(Star {
            vertex,
            total,
            nearest: nearest.map_or(vertex, |&(v, _)| v),
            weights: begin..self.weights.len(),
        });
    }

    /// Passes the heat put into massless vertices on to those that remain.
    ///
    /// `heat` has one entry per vertex. Afterwards that of an eliminated vertex is the heat it had
    /// at its turn, which [`Elimination::recover`] needs.
    pub(crate) fn distribute(&self, heat: &mut [f64]) {
        for star in &self.stars {
            let q = heat[star.vertex as usize];
            if q != 0.0 {
                let weights = &self.weights[star.weights.clone()];
                weights.iter().for_each(|&(v, w)| heat[v as usize] += w * q);
            }
        }
    }

    /// Passes bounds on heat on, as [`Elimination::distribute`] does with heat.
    pub(crate) fn distribute_bounds(&self, heat: &mut [Taylor]) {
        for star in &self.stars {
            let q = heat[star.vertex as usize];
            for &(v, w) in &self.weights[star.weights.clone()] {
                heat[v as usize] = heat[v as usize] + q * Taylor::constant(w);
            }
        }
    }

    /// Fills in the temperatures of the eliminated vertices from those that remain.
    pub(crate) fn recover(&self, heat: &[f64], temperature: &mut [f64]) {
        for star in self.stars.iter().rev() {
            let near = temperature[star.nearest as usize];
            let weights = &self.weights[star.weights.clone()];
            let rest: f64 =
                weights.iter().map(|&(v, w)| w * (temperature[v as usize] - near)).sum();
            temperature[star.vertex as usize] =
                near + (rest + heat[star.vertex as usize] / star.total);
        }
    }

    /// Fills in bounds on the temperatures of the eliminated vertices: means of those of their
    /// neighbours, and the rise by heat.
    pub(crate) fn recover_bounds(&self, heat: &[Taylor], temperature: &mut [Taylor]) {
        for star in self.stars.iter().rev() {
            let added = heat[star.vertex as usize] * Taylor::constant(star.total.recip());
            let weights = &self.weights[star.weights.clone()];
            temperature[star.vertex as usize] = weights
                .iter()
                .fold(added, |sum, &(v, w)| sum + temperature[v as usize] * Taylor::constant(w));
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.stars.is_empty()
    }
}

struct Graph<'a> {
    /// Neighbours of every massless vertex that is still there.
    stars: BTreeMap<u32, BTreeMap<u32, f64>>,
    /// Links between vertices that stay.
    kept: Vec<Link>,
    /// Number of added links; one between two massless vertices counts twice.
    added: usize,
    is_massless: &'a dyn Fn(u32) -> bool,
}

impl Graph<'_> {
    fn add(&mut self, Link { a, b, g }: Link) {
        let mut stays = true;
        for (v, other) in [(a, b), (b, a)] {
            if (self.is_massless)(v) {
                let neighbours = self.stars.entry(v).or_default();
                let before = neighbours.len();
                *neighbours.entry(other).or_insert(0.0) += g;
                self.added += neighbours.len() - before;
                stays = false;
            }
        }
        if stays {
            self.kept.push(Link { a: a.min(b), b: a.max(b), g });
            self.added += 1;
        }
    }

    /// Takes a vertex out, and returns the neighbours that it had.
    fn eliminate(&mut self, vertex: u32) -> Vec<(u32, f64)> {
        let neighbours = self.stars.remove(&vertex).unwrap_or_default();
        let total: f64 = neighbours.values().sum();
        for v in neighbours.keys() {
            if let Some(star) = self.stars.get_mut(v) {
                star.remove(&vertex);
            }
        }
        let list: Vec<(u32, f64)> = neighbours.into_iter().collect();
        for (i, &(a, g_a)) in list.iter().enumerate() {
            for &(b, g_b) in &list[i + 1..] {
                self.add(Link { a, b, g: g_a * (g_b / total) });
            }
        }
        list
    }
}

/// Sorts links by their ends and adds parallel ones.
fn merged(mut links: Vec<Link>) -> Vec<Link> {
    links.sort_by_key(|link| (link.a, link.b)); // stable: parallel links are summed in their order
    links.dedup_by(|next, first| {
        let parallel = (next.a, next.b) == (first.a, first.b);
        if parallel {
            first.g += next.g;
        }
        parallel
    });
    links
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_of_junctions_becomes_its_series_resistance() {
        // 0 -(2)- 1 -(3)- 2 -(6)- 3 with 1 and 2 massless: 1/(1/2 + 1/3 + 1/6) = 1
        let links = vec![
            Link { a: 0, b: 1, g: 2.0 },
            Link { a: 1, b: 2, g: 3.0 },
            Link { a: 2, b: 3, g: 6.0 },
        ];
        let (elimination, kept) =
            Elimination::new(links, &[false, true, true, false]).ok().expect("a chain is small");
        assert_eq!(kept.len(), 1);
        assert!((kept[0].g - 1.0).abs() < 1e-15);
        let mut temperature = [0.0, f64::NAN, f64::NAN, 6.0];
        elimination.recover(&[0.0; 4], &mut temperature);
        assert!((temperature[1] - 3.0).abs() < 1e-14, "{temperature:?}");
        assert!((temperature[2] - 5.0).abs() < 1e-14, "{temperature:?}");
    }

    #[test]
    fn heat_into_a_junction_divides_by_conductance() {
        let links = vec![Link { a: 0, b: 1, g: 3.0 }, Link { a: 1, b: 2, g: 1.0 }];
        let (elimination, _) =
            Elimination::new(links, &[false, true, false]).ok().expect("a star is small");
        let mut heat = [0.0, 8.0, 0.0];
        elimination.distribute(&mut heat);
        assert!((heat[0] - 6.0).abs() < 1e-15 && (heat[2] - 2.0).abs() < 1e-15, "{heat:?}");
        let mut temperature = [10.0, 0.0, 10.0];
        elimination.recover(&heat, &mut temperature);
        assert!((temperature[1] - 12.0).abs() < 1e-14, "{temperature:?}");
    }

    #[test]
    fn links_that_are_given_are_not_counted() {
        // regression: a face between two bodies of 10^7 cells was refused for its two neighbours
        let mut links: Vec<Link> = (2..100).map(|a| Link { a, b: a + 1, g: 1.0 }).collect();
        links.extend([Link { a: 0, b: 1, g: 2.0 }, Link { a: 1, b: 2, g: 2.0 }]);
        let (_, kept) =
            Elimination::within(1, links, &[false, true]).ok().expect("one link is added");
        assert_eq!(kept[0], Link { a: 0, b: 2, g: 1.0 });
        assert_eq!(kept.len(), 99);
    }

    #[test]
    fn a_hub_of_too_many_neighbours_is_refused() {
        let links = (1..8000).map(|b| Link { a: 0, b, g: 1.0 }).collect();
        let Err(refused) = Elimination::new(links, &[true]) else {
            panic!("32 million links were made")
        };
        assert_eq!((refused.vertex, refused.neighbours), (0, 7999));
    }
}
