//! Several parameters at once: the best of something, with everything kept.
//!
//! The box is evaluated at points that fill it evenly. From the best of them a search with
//! derivatives goes on, at first with rough evaluations, at last with the most accurate ones. The
//! result is a local minimum at best; it is moved to the side on which everything is kept.
//!
//! Several parameters are searched from values alone, because peaks over a run have kinks when
//! another moment becomes the highest. Differences of runs to 1e-9 K serve as derivatives. The last
//! step goes along the way from a point that keeps everything, and needs none.

use lptn_network::ParameterId;
use lptn_solve::in_parallel;

use crate::size::aim::Aim;
use crate::size::design::{Design, Designs};
use crate::size::error::SizeError;
use crate::size::judge::{Care, Demand};
use crate::size::root::last_kept;
use crate::size::search::WIDE;
use crate::size::shortfall::Shortfall;
use crate::size::smooth::{Effort, Values, minimise};

/// Places for each parameter that is varied, at least; their number doubles with each.
const PLACES: usize = 16;

/// Not more places than these.
const MOST_PLACES: usize = 512;

/// With more parameters than this the corners of the box are not all evaluated.
const MOST_CORNERS: usize = 6;

/// Searches that begin in different parts of the box.
const STARTS: usize = 4;

/// Least distance of their starts, as a share of the box.
const APART: f64 = 0.2;

/// The effort of a search with rough evaluations, and with the most accurate ones.
const ROUGH: Effort = Effort { step: 1e-3, accuracy: 1e-6, iterations: 60 };
const FINE: Effort = Effort { step: 1e-4, accuracy: 1e-12, iterations: 60 };

/// A task of sizing several parameters.
#[derive(Clone, Debug)]
pub struct SeveralTask<'a> {
    /// The requirements.
    pub demand: Demand<'a>,
    /// The objective of the best design.
    pub aim: Aim<'a>,
    /// The parameters, and the least and largest value that each may take, in SI units.
    pub varied: Vec<(ParameterId, (f64, f64))>,
    /// Number of threads; the result does not depend on it.
    pub threads: usize,
}

/// The result of sizing several parameters.
#[derive(Clone, Debug)]
pub struct Several {
    /// The best design that keeps everything; if there is none, the one that comes closest.
    pub design: Design,
    /// True if it keeps everything.
    pub feasible: bool,
    /// The requirements that bind, by their positions among the margins.
    pub binding: Vec<usize>,
    /// The requirement that is broken most, or is the closest to it, among the margins.
    pub worst: usize,
    /// The designs that were evaluated first.
    pub looked_at: Vec<Design>,
    /// Number of networks that were solved.
    pub solved: usize,
}

/// Finds the best design.
///
/// # Errors
/// [`SizeError`] if a network inside the ranges cannot be solved or a requirement has no value.
pub fn size_several(task: &SeveralTask<'_>) -> Result<Several, SizeError> {
    for &(_, (from, to)) in &task.varied {
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(SizeError::Range { from, to });
        }
    }
    let parameters = task.varied.iter().map(|(id, _)| *id).collect();
    let designs = Designs::new(task.demand, task.aim, parameters)?;
    let places = places(task.varied.len());
    let looked_at =
        in_parallel(&places, task.threads, |place| designs.judge(&values(task, place), Care::Look));
    let looked_at = looked_at.into_iter().collect::<Result<Vec<_>, _>>()?;
    let search = Search::new(task, &designs, (places, looked_at));
    let (place, design) = search.best()?;
    let feasible = design.judged.keeps();
    let binding = search.binding(&place, &design)?;
    let (worst, solved) = (search.shortfall.worst(&design.judged), designs.judge.count());
    Ok(Several { design, feasible, binding, worst, looked_at: search.looked_at, solved })
}

/// Places that fill the unit box evenly, its corners first.
fn places(n: usize) -> Vec<Vec<f64>> {
    let count = (PLACES << n.min(MOST_CORNERS)).min(MOST_PLACES);
    let corners = if n <= MOST_CORNERS { 1_usize << n } else { 0 };
    let corner = |k: usize| (0..n).map(|i| f64::from(u8::from(k >> i & 1 == 1))).collect();
    // Halton's points: each coordinate has the digits of the number after the point, reversed
    let inside = |k: usize| (0..n).map(|i| reversed(k + 1, prime(i))).collect();
    (0..corners).map(corner).chain((0..count).map(inside)).collect()
}

/// A number between 0 and 1 with the digits of `k` after the point, the last one first.
fn reversed(mut k: usize, base: usize) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while k > 0 {
        digit /= base as f64;
        value += digit * (k % base) as f64;
        k /= base;
    }
    value
}

fn prime(i: usize) -> usize {
    let is_prime = |n: &usize| (2..*n).all(|d| !n.is_multiple_of(d));
    (2..).filter(is_prime).nth(i).unwrap_or(2)
}

/// The values at a place of the unit box: in equal ratios if the range is wide.
fn values(task: &SeveralTask<'_>, place: &[f64]) -> Vec<f64> {
    let of = task.varied.iter().zip(place);
    of.map(|(&(_, (from, to)), &share)| match share {
        _ if share <= 0.0 => from,
        _ if share >= 1.0 => to,
        _ if from > 0.0 && to / from > WIDE => from * (to / from).powf(share),
        _ => from + share * (to - from),
    })
    .collect()
}

struct Search<'a> {
    task: &'a SeveralTask<'a>,
    designs: &'a Designs<'a>,
    places: Vec<Vec<f64>>,
    looked_at: Vec<Design>,
    /// The largest size of each margin, and the spread of the objective.
    scale: Vec<f64>,
    spread: f64,
    /// The measure of requirements that are broken.
    shortfall: Shortfall,
}

type Found = (Vec<f64>, Design);

impl<'a> Search<'a> {
    fn new(
        task: &'a SeveralTask<'a>,
        designs: &'a Designs<'a>,
        (places, looked_at): (Vec<Vec<f64>>, Vec<Design>),
    ) -> Self {
        let one = |scale: f64| if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
        let count = looked_at.first().map_or(0, |design| design.judged.margins.len());
        let largest = |i: usize| {
            looked_at.iter().map(|design| design.judged.margins[i].abs()).fold(0.0, f64::max)
        };
        let scale = (0..count).map(largest).map(one).collect();
        let objectives = || looked_at.iter().map(|design| design.objective);
        let spread = objectives().fold(f64::NEG_INFINITY, f64::max)
            - objectives().fold(f64::INFINITY, f64::min);
        let shortfall = Shortfall::of(&task.demand);
        Self { task, designs, places, looked_at, scale, spread: one(spread), shortfall }
    }

    /// The least margin as a share of its scale.
    fn worst(&self, design: &Design) -> f64 {
        let shares = design.judged.margins.iter().zip(&self.scale).map(|(m, scale)| m / scale);
        shares.fold(f64::INFINITY, f64::min)
    }

    /// The better of two comes first: designs that keep everything by the objective, the others by
    /// how far they fail.
    fn order(&self, a: &Design, b: &Design) -> std::cmp::Ordering {
        let rank = |design: &Design| match self.shortfall.least(&design.judged) {
            least if least >= 0.0 => (0.0_f64, self.designs.cost(design.objective)),
            least => (1.0, -least),
        };
        let ((a, a_by), (b, b_by)) = (rank(a), rank(b));
        a.total_cmp(&b).then(a_by.total_cmp(&b_by))
    }

    fn at(&self, place: &[f64], care: Care) -> Result<Design, SizeError> {
        self.designs.judge(&values(self.task, place), care)
    }

    fn function(&self, place: &[f64], care: Care) -> Result<Values, SizeError> {
        let design = self.at(place, care)?;
        let cost = self.designs.cost(design.objective) / self.spread;
        let margins = design.judged.margins.iter().zip(&self.scale).map(|(m, scale)| m / scale);
        Ok((cost, margins.collect()))
    }

    fn search(&self, start: &[f64], (care, effort): (Care, Effort)) -> Result<Vec<f64>, SizeError> {
        minimise(&|place| self.function(place, care), (start, self.scale.len()), effort)
    }

    fn best(&self) -> Result<Found, SizeError> {
        let mut ranked: Vec<usize> = (0..self.places.len()).collect();
        ranked.sort_by(|&a, &b| self.order(&self.looked_at[a], &self.looked_at[b]));
        let mut found: Vec<Found> = Vec::new();
        for start in self.starts(&ranked) {
            let place = self.search(&self.places[start], (Care::Look, ROUGH))?;
            let design = self.at(&place, Care::Look)?;
            found.push((place, design));
        }
        // a search may lead to a worse place than its start
        let first = ranked.first().map(|&k| (self.places[k].clone(), self.looked_at[k].clone()));
        found.extend(first.clone());
        found.sort_by(|a, b| self.order(&a.1, &b.1));
        // a requirement that a rough evaluation breaks may only touch its limit
        let near = found.iter().position(|(_, design)| self.worst(design) >= -ROUGH.accuracy);
        let start = found.swap_remove(near.unwrap_or(0)).0;
        let place = self.search(&start, (Care::Proof, FINE))?;
        let design = self.at(&place, Care::Proof)?;
        let anchor = first.filter(|(_, design)| design.judged.keeps());
        let mut proven = vec![self.on_the_kept_side((place, design), anchor.as_ref())?];
        // a search without a place that keeps everything may lead away from it
        let other = anchor.map_or(start, |(place, _)| place);
        let design = self.at(&other, Care::Proof)?;
        proven.push((other, design));
        proven.sort_by(|a, b| self.order(&a.1, &b.1));
        let best = proven.swap_remove(0);
        if best.1.judged.keeps() { Ok(best) } else { self.closest(best) }
    }

    /// The place whose worst requirement is broken least, searched from this one. One more
    /// coordinate is the shortfall that all requirements have to stay within, as a share of the
    /// first; less of it is better.
    fn closest(&self, (start, design): Found) -> Result<Found, SizeError> {
        let most = -self.shortfall.least(&design.judged);
        let within = |place: &[f64]| {
            let (share, place) = place.split_last().unwrap_or((&1.0, &[]));
            let judged = self.at(place, Care::Proof)?.judged;
            let margins = self.shortfall.measured(&judged).map(|margin| margin / most + share);
            Ok((*share, margins.collect()))
        };
        let from: Vec<f64> = start.iter().copied().chain([1.0]).collect();
        let mut place = minimise(&within, (&from, self.scale.len()), FINE)?;
        place.truncate(start.len());
        let found = self.at(&place, Care::Proof)?;
        let closer = self.shortfall.closer(&found.judged, &design.judged, 0.0);
        Ok(if closer { (place, found) } else { (start, design) })
    }

    /// The best places, not near each other.
    fn starts(&self, ranked: &[usize]) -> Vec<usize> {
        let mut starts: Vec<usize> = Vec::new();
        for &place in ranked {
            let apart = |other: &usize| {
                let pairs = self.places[place].iter().zip(&self.places[*other]);
                pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) >= APART
            };
            if starts.iter().all(apart) {
                starts.push(place);
            }
            if starts.len() == STARTS {
                break;
            }
        }
        starts
    }

    /// The last place with everything kept on the way from a kept place to a found one.
    fn on_the_kept_side(&self, found: Found, anchor: Option<&Found>) -> Result<Found, SizeError> {
        let Some((from, kept)) = anchor.filter(|_| !found.1.judged.keeps()) else {
            return Ok(found);
        };
        let way = |share: f64| -> Vec<f64> {
            from.iter().zip(&found.0).map(|(a, b)| a + share * (b - a)).collect()
        };
        let mut worst =
            |share: f64| self.at(&way(share), Care::Proof).map(|design| self.worst(&design));
        let ends = ((0.0, self.worst(kept)), (1.0, self.worst(&found.1)));
        let [(share, _), _] = last_kept(ends.0, ends.1, (1e-13, &mut worst))?;
        let place = way(share);
        let design = self.at(&place, Care::Proof)?;
        Ok((place, design))
    }

    /// The requirements without which it would go on: those that a small part of the box breaks.
    fn binding(&self, place: &[f64], design: &Design) -> Result<Vec<usize>, SizeError> {
        let mut reach = vec![0.0_f64; self.scale.len()];
        for i in 0..place.len() {
            for by in [-NEAR, NEAR] {
                let mut other = place.to_vec();
                other[i] = (other[i] + by).clamp(0.0, 1.0);
                let other = self.at(&other, Care::Look)?;
                for (k, reach) in reach.iter_mut().enumerate() {
                    *reach = reach.max((other.judged.margins[k] - design.judged.margins[k]).abs());
                }
            }
        }
        let near = |k: &usize| design.judged.margins[*k] <= reach[*k] * SMALL;
        Ok((0..reach.len()).filter(near).collect())
    }
}

/// A requirement binds if its margin is less than [`SMALL`] times its change over this step of the
/// box.
const NEAR: f64 = 1e-3;
const SMALL: f64 = 1e-2;
