//! Conjugate gradients with a multigrid method, for steady states of large bodies.
//!
//! Incomplete factors need as many iterations as a body is wide; with coarser levels the number
//! hardly grows. Levels are networks: pairs of nodes with the links between them summed, so that
//! nothing but conductances is ever stored, however they spread. Every few levels a level is solved
//! with two steps of conjugate gradients (the K-cycle), which makes up for the plain sums: Y.
//! Notay, Electron. Trans. Numer. Anal. 37 (2010) 123. Larger groups on one level take fewer levels, but
//! their cycles grow with the spread: measured with groups of four and of eight.

mod groups;
mod level;

use std::sync::Arc;

use groups::{NONE, Network};
use level::{Coarse, Level, cycle};

use super::cholesky::Analysis;
use super::fallback::Fallback;
use super::shape::Shape;
use super::{Factorization, LinearSolverKind, SparseCholesky, checked, expect_length, probe};
use crate::{FactorError, Pattern, kernels};

/// Paths to ground below this part of the diagonal are rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Remaining residual, relative to the right side, over the diagonal (for a network: in K).
const LEFT_OVER: f64 = 1e-9;

/// More cycles than this do not converge.
const MOST_CYCLES: usize = 150;

/// Levels up to this size are solved exactly.
const SMALL: usize = 500;

/// A level this many times smaller than the last one that is visited twice is visited twice itself:
/// all visits together then cost less than three of the first level.
const SHRUNK: usize = 5;

/// A level that keeps more than this part of its nodes is the last one.
const STALLED: f64 = 0.7;

/// Products of exact factors of the last level, at most.
const MOST_PRODUCTS: f64 = 3e10;

/// Multigrid-preconditioned conjugate gradients. If they do not converge, exact factors take
/// over until there are other values.
pub struct Multigrid {
    shape: Arc<Shape>,
    /// `S` of the scaled matrix `S A S`, whose diagonal is 1.
    scale: Vec<f64>,
    levels: Vec<Level>,
    last: Option<SparseCholesky>,
    exact: Option<Fallback>,
    ready: bool,
    iterations: u64,
}

impl Multigrid {
    /// For symmetric matrices with this pattern.
    ///
    /// # Panics
    /// If the matrix has 2^32 entries or more, which no memory can store.
    #[must_use]
    pub fn new(pattern: &Pattern) -> Self {
        Self::with(Arc::new(Shape::new(pattern)))
    }

    pub(super) fn with(shape: Arc<Shape>) -> Self {
        let (scale, levels) = (Vec::new(), Vec::new());
        Self { shape, scale, levels, last: None, exact: None, ready: false, iterations: 0 }
    }

    /// The network that the values are those of.
    fn network(&mut self, values: &[f64]) -> Result<Network, FactorError> {
        let Shape { triangle, source, diagonal, order, .. } = &*self.shape;
        let links: Vec<f64> = source.iter().map(|&slot| -values[slot as usize]).collect();
        let mut ground: Vec<f64> = diagonal.iter().map(|&slot| values[slot as usize]).collect();
        if let Some(row) = ground.iter().position(|&d| d.is_nan() || d <= 0.0 || d.is_infinite()) {
            return Err(FactorError::NotPositiveDefinite { index: order[row] as usize });
        }
        self.scale = ground.iter().map(|d| d.sqrt().recip()).collect();
        let mut linked = vec![0.0; ground.len()];
        let network = Network { triangle: Arc::clone(triangle), links, ground: Vec::new() };
        network.each_link(|row, column, link| {
            linked[row] += link;
            linked[column] += link;
        });
        // paths below the rounding of the diagonal are dropped
        for (ground, linked) in ground.iter_mut().zip(linked) {
            let rest = *ground - linked;
            *ground = if rest.abs() > ROUNDING * *ground { rest } else { 0.0 };
        }
        Ok(Network { ground, ..network })
    }

    /// Builds the levels, the first one of this network; false if there is only one.
    fn build(&mut self, mut network: Network) -> Result<bool, FactorError> {
        let mut scale = self.scale.clone();
        let mut visited = network.size();
        while scale.len() > SMALL {
            let (group, coarse) = network.paired();
            let below = scales(&coarse)?;
            if below.len() as f64 > STALLED * scale.len() as f64 {
                break;
            }
            let twice = SHRUNK * coarse.size() <= visited;
            visited = if twice { coarse.size() } else { visited };
            self.levels.push(level(network, &scale, (group, twice), &below));
            (network, scale) = (coarse, below);
        }
        self.last = Some(last(network, &scale)?);
        Ok(!self.levels.is_empty())
    }

    /// Solves for the residual `left` and adds the solution to `x`, in the order and scale of the
    /// first level; false if `allowed` is not reached.
    fn iterate(&mut self, mut left: Vec<f64>, x: &mut [f64], allowed: f64) -> bool {
        let Some(last) = &mut self.last else { return false };
        let vector = || vec![0.0; x.len()];
        let (mut change, mut direction, mut product) = (vector(), vector(), vector());
        let (mut before, mut length) = (f64::INFINITY, 0.0);
        for _ in 0..MOST_CYCLES {
            if kernels::weighted_max(&left, &self.scale) <= allowed {
                return true;
            }
            self.iterations += 1;
            cycle(&mut self.levels, last, &left, &mut change);
            // makes the direction conjugate to the one before though the cycle is not linear
            let share = -length * kernels::dot(&change, &product) / before;
            kernels::scale_and_add(share, &mut direction, 1.0, &change);
            let Some(level) = self.levels.first() else { return false };
            level.lower().multiply(&direction, &mut product);
            before = kernels::dot(&change, &left);
            length = kernels::dot(&direction, &left) / kernels::dot(&direction, &product);
            if !length.is_finite() || before.is_nan() || before <= 0.0 {
                return false;
            }
            kernels::scale_and_add(1.0, x, length, &direction);
            kernels::scale_and_add(1.0, &mut left, -length, &product);
        }
        false
    }

    /// True if cycles reach `allowed` from the guess, or the usual part from 0.
    fn converges(&mut self, b: &[f64], x: &mut [f64], allowed: Option<f64>) -> bool {
        let Some(level) = self.levels.first() else { return false };
        let rows = || self.shape.order.iter().map(|&row| row as usize).zip(&self.scale);
        let mut left: Vec<f64> = rows().map(|(row, scale)| scale * b[row]).collect();
        let mut solution = vec![0.0; b.len()];
        if allowed.is_some() {
            solution.iter_mut().zip(rows()).for_each(|(own, (row, scale))| *own = x[row] / scale);
            let mut product = vec![0.0; b.len()];
            level.lower().multiply(&solution, &mut product);
            kernels::scale_and_add(1.0, &mut left, -1.0, &product);
        }
        let size = kernels::weighted_max(&left, &self.scale);
        if !self.iterate(left, &mut solution, allowed.unwrap_or(LEFT_OVER * size)) {
            return false;
        }
        let rows = self.shape.order.iter().zip(&self.scale).zip(&solution);
        rows.for_each(|((&row, scale), solution)| x[row as usize] = scale * solution);
        true
    }

    /// The solution by cycles or, if they fail, by exact factors.
    fn solve(&mut self, b: &[f64], x: &mut [f64], allowed: Option<f64>) -> Result<(), FactorError> {
        if let Some(index) = kernels::first_not_finite(b) {
            return Err(FactorError::Singular { index });
        }
        if self.exact.is_none() {
            if self.converges(b, x, allowed) {
                return Ok(());
            }
            self.take_exact_factors()?;
        }
        self.exact.as_mut().map_or(Err(FactorError::NotFactorized), |exact| exact.solve(b, x))
    }

    fn take_exact_factors(&mut self) -> Result<(), FactorError> {
        let Some(level) = self.levels.first() else { return Err(FactorError::NotFactorized) };
        self.exact = Some(exact_factors(&self.shape, &level.entries, &self.scale)?);
        Ok(())
    }
}

/// Exact factors of the first level.
fn exact_factors(shape: &Shape, entries: &[f64], scale: &[f64]) -> Result<Fallback, FactorError> {
    let mut values = vec![0.0; shape.slots];
    let entries = shape.source.iter().zip(entries);
    entries.for_each(|(&slot, entry)| values[slot as usize] = *entry);
    shape.diagonal.iter().for_each(|&slot| values[slot as usize] = 1.0);
    Fallback::new(shape, (values, scale), |pattern| Ok(Box::new(SparseCholesky::new(pattern)?)))
}

/// `S` of each node of a network.
fn scales(network: &Network) -> Result<Vec<f64>, FactorError> {
    let diagonal = network.diagonal();
    match diagonal.iter().position(|&d| d.is_nan() || d <= 0.0) {
        Some(index) => Err(FactorError::NotPositiveDefinite { index }),
        None => Ok(diagonal.iter().map(|d| d.sqrt().recip()).collect()),
    }
}

/// Replaces the links by the entries of the scaled matrix.
fn scaled(network: &mut Network, scale: &[f64]) {
    let Network { triangle, links, .. } = network;
    for (row, own) in triangle.rows() {
        for (link, &column) in links[own.clone()].iter_mut().zip(&triangle.columns[own]) {
            *link *= -scale[row] * scale[column as usize];
        }
    }
}

/// The level of a network whose nodes are corrected by these groups of a network with the scale
/// `below`, which is visited twice if `twice` is true.
fn level(
    mut network: Network,
    scale: &[f64],
    (mut group, twice): (Vec<u32>, bool),
    below: &[f64],
) -> Level {
    scaled(&mut network, scale);
    let weight = |(group, scale): (&mut u32, &f64)| match *group {
        NONE => {
            *group = 0;
            0.0
        }
        group => below[group as usize] / scale,
    };
    let weight = group.iter_mut().zip(scale).map(weight).collect();
    let Network { triangle, links: entries, .. } = network;
    let (work, coarse) = (vec![0.0; scale.len()], Coarse::new(below.len(), twice));
    Level { triangle, entries, group, weight, twice, work, coarse }
}

/// Exact factors of the last level.
fn last(mut network: Network, scale: &[f64]) -> Result<SparseCholesky, FactorError> {
    let mut links = Vec::with_capacity(network.links.len());
    network.each_link(|row, column, _| links.push((row, column)));
    let pattern = Pattern::new(scale.len(), links.into_iter());
    let analysis = Analysis::new(&pattern)?;
    if analysis.products() > MOST_PRODUCTS {
        return Err(FactorError::OutOfMemory);
    }
    scaled(&mut network, scale);
    let mut values = vec![0.0; pattern.len()];
    pattern.diagonal().iter().for_each(|&slot| values[slot] = 1.0);
    network.each_link(|row, column, entry| {
        pattern.slot(row, column).into_iter().for_each(|slot| values[slot] = entry);
    });
    let mut factors = SparseCholesky::of(Arc::new(analysis))?;
    factors.factorize(&values)?;
    factors.check(&pattern, &values)?;
    Ok(factors)
}

impl Factorization for Multigrid {
    fn size(&self) -> usize {
        self.shape.order.len()
    }

    fn kind(&self) -> LinearSolverKind {
        LinearSolverKind::Multigrid
    }

    fn fill(&self) -> usize {
        let levels = self.levels.iter().map(|level| level.entries.len() + 2 * level.weight.len());
        let exact = self.exact.iter().map(Fallback::fill);
        let last = self.last.iter().map(Factorization::fill);
        levels.chain(last).chain(exact).sum()
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self::with(Arc::clone(&self.shape))))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.shape.slots, values.len())?;
        self.levels.clear();
        (self.last, self.exact, self.ready) = (None, None, false);
        let network = self.network(values)?;
        if !matches!(self.build(network), Ok(true)) {
            // small, or nothing to take together
            let mut network = self.network(values)?;
            scaled(&mut network, &self.scale);
            self.exact = Some(exact_factors(&self.shape, &network.links, &self.scale)?);
        }
        self.ready = true;
        Ok(())
    }

    /// The last level shows nodes without a path to ground: its factors are checked when made.
    fn check(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), FactorError> {
        if self.exact.is_none() {
            return Ok(());
        }
        probe(pattern, values, |b| self.solve_in_place(b))
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |_| ())?;
        let right = b.to_vec();
        self.solve(&right, b, None)
    }

    fn solve_from(&mut self, b: &[f64], x: &mut [f64], allowed: f64) -> Result<(), FactorError> {
        expect_length(self.size(), b.len())?;
        checked((self.size(), self.ready), x, |_| ())?;
        self.solve(b, x, Some(allowed))
    }
}
