//! Cost of solvers, predicted by counts: the same matrix always gets the same solver.
//!
//! Times in ns are those of one core of a server of 2023; only their ratios decide. Measured on
//! bodies of cells in the plane (32 x 32 to 1000 x 1000) and in space (5^3 to 40^3) with
//! `examples/solvers.rs`; they are right within a factor of 1.5:
//!
//! - exact factors: 5 ns for each number and 0.45 ns for each product, or 10 ns and 0.035 ns if
//!   faer takes columns together;
//! - a solve with them: 1.5 ns for each number;
//! - an iteration of conjugate gradients: 2.5 ns for each row and 1.2 ns for each link. A solve has
//!   one and a half more, to begin and to see the end.
//!
//! If [`Shape::products`] excludes exact factors, nothing is ordered. Large matrices are ordered
//! and counted first, since an analysis that is not used would take more memory than all else.
//!
//! Counts choose the solver, never a clock. If iterations turn out slower than predicted, exact
//! factors take over. This happens when one set of values has cost as much as the factors and their
//! solves. The price is therefore at most twice the least. An analysis that was not used caused the
//! peak memory of a run before large matrices were counted first. Newton's method takes Cholesky
//! for large Jacobians whose values are symmetric.

use std::sync::Arc;

use super::cholesky::{Analysis, SparseCholesky};
use super::counts::Counts;
use super::krylov::Patience;
use super::shape::Shape;
use super::{Factorization, Krylov, Multigrid, SparseLu};
use crate::{FactorError, Pattern};

/// Use of the factors of one set of values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demand {
    /// Solves with them.
    solves: f64,
    /// Iterations of each.
    iterations: f64,
    /// True if heat has to cross the body, which takes an iteration for each of its levels.
    crosses: bool,
}

/// The Newton matrices of a multistep method: they change with every step size, and a solve begins
/// at nothing.
pub(super) const NEWTON: Demand = Demand { solves: 5.0, iterations: 20.0, crosses: false };

/// The matrices of a one-step method with few step sizes, solved from a guess to a tolerance.
pub(super) const STAGES: Demand = Demand { solves: 30.0, iterations: 6.0, crosses: false };

/// Number of rows above which the width is evaluated before the matrix is ordered.
const LARGE: usize = 20_000;

/// The matrix of a steady state, solved once and refined.
const STEADY: Demand = Demand { solves: 1.6, iterations: 15.0, crosses: true };

/// Number of rows below which a steady state, or a matrix that is not symmetric, is solved exactly
/// at any cost.
const SOON_DONE: usize = 5000;

/// Number of rows above which a steady state in space is solved on several levels.
const MANY: usize = 30_000;

/// Iterations that the levels of a multigrid method and its cycles cost.
const MULTIGRID: f64 = 400.0;

/// Cost of LU over that of Cholesky: twice the products, and its rows are found while it runs.
const LU: f64 = 6.0;

/// Cost of ordering a row, in ns.
const ORDER: f64 = 1000.0;

/// Exact factors with more than this multiple of the numbers of the matrix are not made to save
/// time, since every step size has its own.
const MOST_FILL: usize = 25;

/// Exact factors with more numbers than this, 256 MB, do not take over from iterations to save time.
const MOST_NUMBERS: usize = 32 << 20;

/// Costs of exact factors in ns.
#[derive(Clone, Copy, Debug)]
struct Exact {
    factorize: f64,
    solve: f64,
}

impl Exact {
    fn of(analysis: &Analysis) -> Self {
        let (fill, products) = (analysis.fill() as f64, analysis.products());
        let (number, product) = if analysis.simplicial() { (5.0, 0.45) } else { (10.0, 0.035) };
        Self { factorize: number * fill + product * products, solve: 1.5 * fill }
    }

    /// Costs of factors that are only counted: faer takes the columns in the cheaper way.
    fn counted(counts: &Counts) -> Self {
        let of = |number: f64, product: f64| number * counts.fill + product * counts.products;
        Self { factorize: of(5.0, 0.45).min(of(10.0, 0.035)), solve: 1.5 * counts.fill }
    }

    /// Cost in ns with this number of solves.
    fn whole(&self, solves: f64) -> f64 {
        self.factorize + solves * self.solve
    }

    /// The costs in iterations.
    fn patience(&self, iteration: f64) -> Patience {
        let [factorize, solve] =
            [self.factorize, self.solve].map(|cost| (cost / iteration).ceil() as usize);
        Patience { factorize, solve }
    }
}

/// The cost in ns of one iteration.
fn iteration(pattern: &Pattern) -> f64 {
    let rows = pattern.size();
    2.5 * rows as f64 + 1.2 * ((pattern.len() - rows) / 2) as f64
}

/// Least cost of exact factors, in ns.
fn least(shape: &Shape) -> f64 {
    0.035 * shape.products()
}

/// Exact factors or conjugate gradients for a large symmetric matrix.
///
/// # Errors
/// [`FactorError::OutOfMemory`].
pub(super) fn cheapest(
    pattern: &Pattern,
    demand: Demand,
) -> Result<Box<dyn Factorization>, FactorError> {
    let iteration = iteration(pattern);
    let iterated = demand.solves * (demand.iterations + 1.5) * iteration;
    if pattern.size() > LARGE {
        let shape = Shape::new(pattern);
        if least(&shape) > 10.0 * iterated {
            return Ok(Box::new(Krylov::symmetric(shape, None)));
        }
        let counts = Counts::of(pattern)?;
        let exact = Exact::counted(&counts);
        if exact.whole(demand.solves) > iterated {
            let fits = counts.fill <= (MOST_FILL * pattern.len()).min(MOST_NUMBERS) as f64;
            let exact = fits.then(|| (exact.patience(iteration), None));
            return Ok(Box::new(Krylov::symmetric(shape, exact)));
        }
    }
    let analysis = Analysis::new(pattern)?;
    let exact = Exact::of(&analysis);
    if exact.whole(demand.solves) <= iterated {
        return Ok(Box::new(SparseCholesky::of(analysis.into())?));
    }
    let fits = analysis.fill() / MOST_FILL <= pattern.len();
    let small = pattern.size() <= LARGE;
    let exact = fits.then(|| (exact.patience(iteration), small.then(|| analysis.into())));
    Ok(Box::new(Krylov::symmetric(Shape::new(pattern), exact)))
}

/// Exact factors or iterations for a large matrix that is not symmetric.
///
/// # Errors
/// [`FactorError::OutOfMemory`].
pub(super) fn not_symmetric(
    pattern: &Pattern,
    demand: Demand,
) -> Result<Box<dyn Factorization>, FactorError> {
    if pattern.size() > SOON_DONE {
        let shape = Shape::new(pattern);
        let iterations = demand.iterations + if demand.crosses { shape.depth as f64 } else { 0.0 };
        // two products with the matrix each
        let iterated = demand.solves * (2.0 * iterations + 1.5) * iteration(pattern);
        if LU * least(&shape) > iterated {
            return Ok(Box::new(Krylov::new(pattern, false)));
        }
    }
    Ok(Box::new(SparseLu::new(pattern)?))
}

/// Exact factors or iterations for the exact Jacobian of a steady state.
///
/// # Errors
/// [`FactorError::OutOfMemory`].
pub(super) fn steady_not_symmetric(
    pattern: &Pattern,
) -> Result<Box<dyn Factorization>, FactorError> {
    not_symmetric(pattern, STEADY)
}

/// Exact factors, conjugate gradients or a multigrid method for the symmetric matrix of a steady
/// state.
///
/// # Errors
/// [`FactorError::OutOfMemory`].
pub(super) fn steady(pattern: &Pattern) -> Result<Box<dyn Factorization>, FactorError> {
    let rows = pattern.size();
    if rows < SOON_DONE {
        return Ok(Box::new(SparseCholesky::new(pattern)?));
    }
    let (shape, iteration) = (Shape::new(pattern), iteration(pattern));
    let iterations = STEADY.solves * (STEADY.iterations + shape.depth as f64);
    let several = if rows > MANY { MULTIGRID } else { f64::INFINITY };
    let other = iteration * iterations.min(several);
    let mut analysis = None;
    if ORDER * rows as f64 + least(&shape) < other {
        let known = Arc::new(Analysis::new(pattern)?);
        let exact = Exact::of(&known);
        if exact.factorize + 2.0 * exact.solve <= other {
            return Ok(Box::new(SparseCholesky::of(known)?));
        }
        analysis = Some((exact.patience(iteration), Some(known)));
    }
    if several < iterations {
        return Ok(Box::new(Multigrid::with(shape.into())));
    }
    Ok(Box::new(Krylov::symmetric(shape, analysis)))
}
