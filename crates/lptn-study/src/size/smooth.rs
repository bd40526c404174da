//! Constrained minimisation in a box by sequential least squares, from values alone: the only
//! module that knows the library.

use std::cell::RefCell;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError,
    Constraints, CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints,
    NoNonlinearBlock, NonlinearBlock, NonlinearBlocks, NonlinearInequalityValues,
    SelectedFirstOrderState, Slsqp, State,
};

/// An objective to minimise, and values that must not be negative, all of order 1.
pub(crate) type Values = (f64, Vec<f64>);

/// The effort of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// The step of differences, as a share of the box.
    pub(crate) step: f64,
    /// The error of the objective and of the values that must not be negative.
    pub(crate) accuracy: f64,
    pub(crate) iterations: u64,
}

/// The place in the unit box that Kraft's sequential least-squares programming reaches from a start
/// (D. Kraft, DFVLR-FB 88-28, 1988), with derivatives by central differences. A constraint may be
/// negative by the accuracy, and the result is a local minimum at best: the caller has to check it.
///
/// # Errors
/// The error of the function.
pub(crate) fn minimise<E: 'static>(
    function: &dyn Fn(&[f64]) -> Result<Values, E>,
    (start, count): (&[f64], usize),
    effort: Effort,
) -> Result<Vec<f64>, E> {
    let n = start.len();
    let problem = Smooth {
        function,
        count,
        step: effort.step,
        lower: vec![0.0; n],
        upper: vec![1.0; n],
        known: RefCell::new(Vec::new()),
        best: RefCell::new(start.to_vec()),
        failed: RefCell::new(None),
    };
    let solver = Slsqp::new().with_absolute_accuracy_tolerance(effort.accuracy);
    let state = SelectedFirstOrderState::new(start.to_vec());
    let outcome = Executor::new(&problem, solver, state).max_iter(effort.iterations).run();
    if let Some(error) = problem.failed.take() {
        return Err(error);
    }
    // a search that breaks off leaves the last place that it accepted
    Ok(match outcome {
        Ok(result) => result.state.param().clone(),
        Err(_) => problem.best.take(),
    })
}

/// Number of places whose values are kept.
const KEPT: usize = 64;

struct Smooth<'a, E> {
    function: &'a dyn Fn(&[f64]) -> Result<Values, E>,
    count: usize,
    step: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
    known: RefCell<Vec<(Vec<f64>, Values)>>,
    best: RefCell<Vec<f64>>,
    failed: RefCell<Option<E>>,
}

/// The function failed; the reason is stored in [`Smooth`].
#[derive(Debug)]
struct Failed;

impl std::fmt::Display for Failed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the function failed")
    }
}

impl std::error::Error for Failed {}

impl<E> Smooth<'_, E> {
    fn at(&self, x: &[f64]) -> Result<Values, Failed> {
        if let Some((_, values)) = self.known.borrow().iter().find(|(place, _)| place == x) {
            return Ok(values.clone());
        }
        let values = (self.function)(x).map_err(|error| {
            *self.failed.borrow_mut() = Some(error);
            Failed
        })?;
        let mut known = self.known.borrow_mut();
        known.truncate(KEPT - 1);
        known.insert(0, (x.to_vec(), values.clone()));
        Ok(values)
    }

    /// The change of everything with one coordinate.
    fn slope(&self, x: &[f64], i: usize) -> Result<Values, Failed> {
        let moved = |by: f64| {
            let mut place = x.to_vec();
            place[i] = (place[i] + by).clamp(0.0, 1.0);
            (place[i], place)
        };
        let ((low, before), (high, after)) = (moved(-self.step), moved(self.step));
        let (before, after) = (self.at(&before)?, self.at(&after)?);
        let over = |a: f64, b: f64| (b - a) / (high - low);
        let margins = before.1.iter().zip(&after.1).map(|(a, b)| over(*a, *b)).collect();
        Ok((over(before.0, after.0), margins))
    }
}

impl<E> Constraints for &Smooth<'_, E> {
    type Set = ConstraintSet<
        BoxBounds<Vec<f64>>,
        NoLinearConstraints,
        NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>,
    >;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
            .with_nonlinear_inequalities(self.count)
    }
}

impl<E> CostFunction for &Smooth<'_, E> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Failed;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Failed> {
        self.at(x).map(|values| values.0)
    }
}

impl<E> Gradient for &Smooth<'_, E> {
    type Gradient = Vec<f64>;

    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Failed> {
        // called at places that are accepted
        self.best.borrow_mut().clone_from(x);
        (0..x.len()).map(|i| self.slope(x, i).map(|slope| slope.0)).collect()
    }
}

/// The library's convention: a constraint is kept while it is not positive.
impl<E> NonlinearInequalityValues for &Smooth<'_, E> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Failed;

    fn nonlinear_inequalities(
        &self,
        x: &Self::Param,
    ) -> Result<Self::Values, ConstraintSolveError<Self::Error>> {
        let values = self.at(x).map_err(ConstraintSolveError::Evaluation)?;
        Ok(values.1.iter().map(|margin| -margin).collect())
    }
}

impl<E> ConstraintJacobian for &Smooth<'_, E> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Failed;

    fn constraint_jacobian(
        &self,
        x: &Self::Param,
    ) -> Result<Self::Jacobian, ConstraintSolveError<Self::Error>> {
        let n = x.len();
        let mut rows = vec![0.0; self.count * n];
        for i in 0..n {
            let slope = self.slope(x, i).map_err(ConstraintSolveError::Evaluation)?;
            for (row, slope) in slope.1.iter().enumerate() {
                rows[row * n + i] = -slope;
            }
        }
        Ok(DenseMatrix::from_row_slice(self.count, n, &rows))
    }
}
