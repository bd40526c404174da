//! Krylov methods with an incomplete factor, for large bodies and short steps.
//!
//! For the Newton matrices `M - gamma J` of bodies that are cut into cells along three axes: their
//! exact factors have sixty times as many numbers as the matrix (40 x 40 x 40 cells), and the steps
//! of a run are short enough for a few dozen iterations to suffice.

use std::sync::{Arc, Mutex};

use super::cholesky::Analysis;
use super::fallback::Fallback;
use super::incomplete::{Incomplete, Work};
use super::methods::{End, conjugate, stabilized};
use super::shape::Shape;
use super::{Factorization, LinearSolverKind, SparseCholesky, SparseLu, checked, expect_length};
use super::{put, taken};
use crate::{FactorError, Pattern, kernels};

/// Remaining residual, relative to the right side, both over the diagonal (for a network: in K) and
/// in the maximum norm, in which CVODES measures errors too. CVODES solves to 1e-2 and less of a
/// tolerance, so the energy balance of a run is not affected.
const LEFT_OVER: f64 = 1e-9;

/// The end of iterations.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// From 0: this share of the right side remains.
    Share(f64),
    /// From a guess: this residual remains.
    Rest(f64),
}

/// Conjugate gradients or, for matrices that are not symmetric, BiCGStab. If they do not
/// converge, exact factors take over until there are other values.
pub struct Krylov {
    family: Arc<Family>,
    matrix: Incomplete,
    exact: Option<Fallback>,
    ready: bool,
    /// Iterations of all solves.
    iterations: u64,
    /// Cost of exact factors of the present values in iterations, less those spent.
    left: usize,
}

/// Cost of exact factors in iterations: once as much was spent on one set of values, they take
/// over, so the price is at most twice the least.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patience {
    pub(super) factorize: usize,
    pub(super) solve: usize,
}

impl Patience {
    const ENDLESS: Self = Self { factorize: usize::MAX, solve: 0 };
}

/// Data that the matrices of one pattern share.
struct Family {
    symmetric: bool,
    patience: Patience,
    /// Memory for a solve, if no one uses it.
    spare: Mutex<Option<Work>>,
    /// Analysis for exact factors, if it was made to choose the solver.
    analysis: Option<Arc<Analysis>>,
}

impl Krylov {
    /// For matrices with this pattern.
    ///
    /// # Panics
    /// If the matrix has 2^32 entries or more, which no memory can store.
    #[must_use]
    pub fn new(pattern: &Pattern, symmetric: bool) -> Self {
        let shape = Shape::new(pattern);
        if symmetric {
            return Self::symmetric(shape, None);
        }
        let shape = shape.with_mirror(pattern);
        let (patience, spare, analysis) = (Patience::ENDLESS, Mutex::new(None), None);
        Self::of(Arc::new(Family { symmetric, patience, spare, analysis }), Arc::new(shape))
    }

    /// For symmetric matrices of a known shape, with the cost of exact factors and their analysis
    /// if it is there.
    pub(super) fn symmetric(
        shape: Shape,
        exact: Option<(Patience, Option<Arc<Analysis>>)>,
    ) -> Self {
        let (patience, analysis) = exact.unwrap_or((Patience::ENDLESS, None));
        let (symmetric, spare) = (true, Mutex::new(None));
        Self::of(Arc::new(Family { symmetric, patience, spare, analysis }), Arc::new(shape))
    }

    /// A solver for other values in the same pattern, whose analysis is shared, and so is the
    /// memory for solves.
    #[must_use]
    pub fn sibling(&self) -> Self {
        Self::of(Arc::clone(&self.family), Arc::clone(&self.matrix.shape))
    }

    fn of(family: Arc<Family>, shape: Arc<Shape>) -> Self {
        let matrix = Incomplete::new(shape);
        Self { family, matrix, exact: None, ready: false, iterations: 0, left: 0 }
    }

    /// Replaces `x`, which may be a guess, by the solution. False if the goal is not reached.
    fn iterate(&mut self, b: &[f64], x: &mut [f64], goal: Goal, work: &mut Work) -> bool {
        let guess = matches!(goal, Goal::Rest(_)).then_some(&*x);
        let size = self.matrix.begin(b, guess, work);
        let (allowed, energy) = match goal {
            // an error of `allowed` everywhere has this energy
            Goal::Rest(allowed) if self.family.symmetric => {
                (allowed, allowed * allowed * self.matrix.whole)
            }
            Goal::Rest(allowed) => (allowed, f64::INFINITY),
            Goal::Share(share) => (share * size, f64::INFINITY),
        };
        self.left = self.left.saturating_add(self.family.patience.solve);
        if size > allowed || (size > 0.0 && energy.is_finite()) {
            let most = self.left;
            let method = if self.family.symmetric { conjugate } else { stabilized };
            let (count, done) = method(&self.matrix, work, size, End { allowed, energy, most });
            self.iterations += count as u64;
            self.left = self.left.saturating_sub(count);
            if !done {
                return false;
            }
        }
        self.matrix.end(&work.solution, x);
        kernels::first_not_finite(x).is_none()
    }

    /// The solution by iterations or, if they fail, by exact factors.
    fn solve(&mut self, b: &[f64], x: &mut [f64], goal: Goal) -> Result<(), FactorError> {
        if let Some(index) = kernels::first_not_finite(b) {
            return Err(FactorError::Singular { index });
        }
        if self.exact.is_none() {
            let mut work = taken(&self.family.spare).unwrap_or_default();
            let done = self.iterate(b, x, goal, &mut work);
            put(&self.family.spare, work);
            if done {
                return Ok(());
            }
            self.exact = Some(self.exact_factors()?);
        }
        self.exact.as_mut().map_or(Err(FactorError::NotFactorized), |exact| exact.solve(b, x))
    }

    fn exact_factors(&self) -> Result<Fallback, FactorError> {
        let Family { symmetric, analysis, .. } = &*self.family;
        Fallback::new(&self.matrix.shape, self.matrix.values(), |pattern| {
            Ok(match (symmetric, analysis) {
                (true, Some(analysis)) => Box::new(SparseCholesky::of(Arc::clone(analysis))?),
                (true, None) => Box::new(SparseCholesky::new(pattern)?),
                (false, _) => Box::new(SparseLu::new(pattern)?),
            })
        })
    }
}

impl Factorization for Krylov {
    fn size(&self) -> usize {
        self.matrix.size()
    }

    fn kind(&self) -> LinearSolverKind {
        if self.family.symmetric { LinearSolverKind::Pcg } else { LinearSolverKind::BiCgStab }
    }

    fn fill(&self) -> usize {
        let exact = self.exact.as_ref().map_or(0, Fallback::fill);
        self.matrix.fill() + exact
    }

    fn iterations(&self) -> u64 {
        self.iterations
    }

    fn sibling(&self) -> Result<Box<dyn Factorization>, FactorError> {
        Ok(Box::new(Self::sibling(self)))
    }

    fn factorize(&mut self, values: &[f64]) -> Result<(), FactorError> {
        expect_length(self.matrix.shape.slots, values.len())?;
        (self.exact, self.left) = (None, self.family.patience.factorize);
        let done = self.matrix.factorize(values);
        self.ready = done.is_ok();
        done
    }

    fn solve_in_place(&mut self, b: &mut [f64]) -> Result<(), FactorError> {
        self.solve_share(b, LEFT_OVER)
    }

    fn solve_share(&mut self, b: &mut [f64], share: f64) -> Result<(), FactorError> {
        checked((self.size(), self.ready), b, |_| ())?;
        let right = b.to_vec();
        self.solve(&right, b, Goal::Share(share))
    }

    fn solve_from(&mut self, b: &[f64], x: &mut [f64], allowed: f64) -> Result<(), FactorError> {
        expect_length(self.size(), b.len())?;
        checked((self.size(), self.ready), x, |_| ())?;
        self.solve(b, x, Goal::Rest(allowed))
    }
}
