//! The search for the minimum.
//!
//! A run is known to its tolerance, and so is a sum of squares (`Settings::error`). Near the
//! minimum a step lowers the sum by less than that error. Such a step is judged by the distance
//! that the derivatives still predict, which is known much better. Without this, one fit in ten of
//! a planned experiment stalled within a thousandth of a standard error of its minimum.

use super::error::LeastSquaresError;
use super::estimate::{LeastSquaresFit, Side, Stop, Termination, Test};
use super::linear::Triangle;
use super::region::{Region, Room, length};
use super::{Evaluated, Residuals, Settings};

/// Largest number of times that a step is shortened.
const MOST_TRIALS: usize = 100;

/// Largest number of descents that meet parameters at which the model has no value.
const MOST_EDGES: usize = 20;

type Fallible<T> = Result<T, LeastSquaresError>;

/// Finds the parameters, near `start`, for which the sum of the squares of residuals and priors is
/// least.
///
/// A start outside its bounds begins on them. The minimum is a local one. The tests of [`Settings`]
/// use the full step to the minimum of the linear model inside the box, not one that the trust
/// region cut short. If none of them ends the search, [`LeastSquaresFit::outcome`] reports it.
///
/// # Errors
/// [`LeastSquaresError`]
pub fn minimise<P: Residuals>(
    problem: &mut P,
    start: &[f64],
    settings: &Settings,
) -> Fallible<LeastSquaresFit> {
    check(problem.parameters(), start, settings)?;
    let mut search = Search { problem, settings, evaluations: 0, data: 0, edges: 0 };
    let clamped =
        start.iter().enumerate().map(|(j, p)| p.clamp(search.bounds(j).0, search.bounds(j).1));
    let first = search.point(clamped.collect())?;
    search.run(first)
}

fn check(count: usize, start: &[f64], settings: &Settings) -> Fallible<()> {
    let wrong = |got: usize| LeastSquaresError::Parameters { expected: count, got };
    if start.len() != count {
        return Err(wrong(start.len()));
    }
    if !settings.bounds.is_empty() && settings.bounds.len() != count {
        return Err(wrong(settings.bounds.len()));
    }
    let reversed =
        |(low, high): &(f64, f64)| low.partial_cmp(high) != Some(std::cmp::Ordering::Less);
    if let Some(parameter) = settings.bounds.iter().position(reversed) {
        return Err(LeastSquaresError::Bounds { parameter });
    }
    for prior in &settings.priors {
        let positive = prior.sigma > 0.0 && prior.sigma.is_finite() && prior.value.is_finite();
        match prior.parameter {
            parameter if parameter >= count => return Err(wrong(parameter + 1)),
            parameter if !positive => return Err(LeastSquaresError::Prior { parameter }),
            _ => {}
        }
    }
    Ok(())
}

/// Parameters with their residuals.
struct Point {
    parameters: Vec<f64>,
    sides: Vec<Option<Side>>,
    residuals: Vec<f64>,
    jacobian: Vec<f64>,
    squares: f64,
}

impl Point {
    fn is_finite(&self) -> bool {
        self.squares.is_finite() && self.jacobian.iter().all(|x| x.is_finite())
    }
}

struct Search<'a, P: Residuals> {
    problem: &'a mut P,
    settings: &'a Settings,
    evaluations: usize,
    data: usize,
    /// Descents in which the model had no value somewhere.
    edges: usize,
}

/// A point with its linear model.
struct Place {
    point: Point,
    model: Triangle,
    room: Room,
    /// The step to the minimum of the linear model inside the bounds.
    full: Vec<f64>,
    /// The part of the residuals that this step removes.
    offset: f64,
}

impl Place {
    /// True if the full step changes no parameter by more than this part of it.
    fn moves_less_than(&self, part: f64) -> bool {
        self.full.iter().zip(&self.point.parameters).all(|(s, p)| s.abs() <= part * p.abs())
    }
}

/// Result of a step.
enum Descent {
    /// A lower sum of squares.
    Lower(Point),
    /// One that differs by rounding only.
    Level(Point),
    /// No further point.
    Stopped(Stop),
}

/// A step that was tried.
struct Trial {
    parameters: Vec<f64>,
    /// True if the trust region cut it short.
    cut: bool,
    /// Length in scaled parameters.
    length: f64,
    /// Predicted decrease of the sum of squares, as a part of it; `lowered` is the actual one.
    predicted: f64,
    lowered: f64,
}

impl<P: Residuals> Search<'_, P> {
    fn bounds(&self, j: usize) -> (f64, f64) {
        self.settings.bounds.get(j).copied().unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
    }

    /// Residuals, and derivatives if asked for, with those of the priors.
    fn evaluate(&mut self, p: &[f64], with_jacobian: bool) -> Evaluated {
        self.evaluations += 1;
        let (mut residuals, mut jacobian) = self.problem.evaluate(p, with_jacobian)?;
        let rows = residuals.len();
        if self.data == 0 {
            self.data = rows;
        }
        let same = |expected: usize, got: usize| match expected == got {
            true => Ok(()),
            false => Err(LeastSquaresError::Residuals { expected, got }),
        };
        same(self.data.max(1), rows)?;
        let priors = &self.settings.priors;
        residuals
            .extend(priors.iter().map(|prior| (p[prior.parameter] - prior.value) / prior.sigma));
        if with_jacobian {
            same(rows * p.len(), jacobian.len())?;
            jacobian = self.with_priors(&jacobian, p.len());
        }
        Ok((residuals, jacobian))
    }

    fn with_priors(&self, jacobian: &[f64], count: usize) -> Vec<f64> {
        let mut all = Vec::with_capacity(jacobian.len() + count * self.settings.priors.len());
        for j in 0..count {
            all.extend_from_slice(&jacobian[j * self.data..][..self.data]);
            let slope =
                |prior: &super::Prior| if prior.parameter == j { 1.0 / prior.sigma } else { 0.0 };
            all.extend(self.settings.priors.iter().map(slope));
        }
        all
    }

    /// A point with its derivatives.
    fn point(&mut self, parameters: Vec<f64>) -> Fallible<Point> {
        let (residuals, jacobian) = self.evaluate(&parameters, true)?;
        let squares = residuals.iter().map(|r| r * r).sum();
        let side = |(j, p): (usize, &f64)| match self.bounds(j) {
            (low, _) if *p <= low => Some(Side::Lower),
            (_, high) if *p >= high => Some(Side::Upper),
            _ => None,
        };
        let sides = parameters.iter().enumerate().map(side).collect();
        Ok(Point { parameters, sides, residuals, jacobian, squares })
    }

    fn room(&self, parameters: &[f64]) -> Room {
        let room = |(j, p): (usize, &f64)| (self.bounds(j).0 - p, self.bounds(j).1 - p);
        parameters.iter().enumerate().map(room).collect()
    }

    fn run(&mut self, start: Point) -> Fallible<LeastSquaresFit> {
        if !start.is_finite() {
            return Ok(self.end(
                start,
                Termination::NotConverged(Stop::StartNotFinite),
                f64::NAN,
                0,
            ));
        }
        let mut scales = vec![0.0; start.parameters.len()];
        let mut here = self.place(start, &mut scales)?;
        let size = length(&here.point.parameters, &scales);
        let mut radius = self.settings.reach * if size > 0.0 { size } else { 1.0 };
        let mut iterations = 0;
        let outcome = loop {
            if let Some(test) = self.at_minimum(&here) {
                break Termination::Converged(test);
            }
            if iterations == self.settings.iterations {
                break Termination::NotConverged(Stop::Iterations);
            }
            let (next, ends) = match self.descend(&here, &scales, &mut radius)? {
                Descent::Lower(next) => (next, false),
                Descent::Level(next) => (next, true),
                Descent::Stopped(stop) => break self.stopped(&here, stop),
            };
            if !next.is_finite() {
                break Termination::NotConverged(Stop::DerivativeNotFinite);
            }
            let next = self.place(next, &mut scales)?;
            if ends && next.offset > 0.9 * here.offset {
                break Termination::Converged(Test::Cost);
            }
            here = next;
            iterations += 1;
        };
        Ok(self.end(here.point, outcome, here.offset, iterations))
    }

    /// The linear model of a point.
    fn place(&self, point: Point, scales: &mut [f64]) -> Fallible<Place> {
        let model = Triangle::new(&point.jacobian, &point.residuals);
        widen(scales, &model.norms());
        let room = self.room(&point.parameters);
        let region = Region { model: &model, scales, room: &room };
        let full = region.inside_box(0.0).ok_or(LeastSquaresError::Decomposition)?.step;
        let offset =
            (model.reduction(&full).max(0.0) / point.squares.max(f64::MIN_POSITIVE)).sqrt();
        Ok(Place { point, model, room, full, offset })
    }

    /// The tests of a point, however it was reached.
    fn at_minimum(&self, here: &Place) -> Option<Test> {
        if here.point.squares <= 0.0 || here.offset <= self.settings.gradient {
            return Some(Test::Gradient);
        }
        here.moves_less_than(self.settings.step).then_some(Test::Step)
    }

    /// If no step leads lower, a minimum whose residuals are rounding still counts.
    fn stopped(&self, here: &Place, stop: Stop) -> Termination {
        if here.moves_less_than(1e-8) {
            Termination::Converged(Test::Step)
        } else {
            Termination::NotConverged(stop)
        }
    }

    /// Shortens the step until one lowers the sum of squares.
    fn descend(&mut self, here: &Place, scales: &[f64], radius: &mut f64) -> Fallible<Descent> {
        let region = Region { model: &here.model, scales, room: &here.room };
        let least = f64::EPSILON * region.length(&here.point.parameters);
        let level = self.level(&here.point);
        if here.offset * here.offset <= level {
            // undo the effect of sums of squares that differ by rounding on the region
            *radius = radius.max(2.0 * region.length(&here.full));
        }
        let mut edge = false;
        for _ in 0..MOST_TRIALS {
            let trial = self.attempt(&here.point, &region, *radius)?;
            if trial.lowered.is_infinite() && !edge {
                edge = true;
                self.edges += 1;
            }
            if self.edges > MOST_EDGES {
                return Ok(Descent::Stopped(Stop::Edge));
            }
            *radius = next_radius(*radius, &trial);
            let differs = trial.predicted.max(trial.lowered.abs());
            if differs <= self.settings.cost && !trial.cut {
                return Ok(Descent::Level(self.point(trial.parameters)?));
            }
            if trial.lowered > 1e-4 * trial.predicted && trial.lowered > 0.0 {
                return Ok(Descent::Lower(self.point(trial.parameters)?));
            }
            if differs <= level && !trial.cut {
                return Ok(Descent::Level(self.point(trial.parameters)?));
            }
            if *radius <= least || trial.length <= least {
                break;
            }
        }
        let full = self.attempt(&here.point, &region, f64::INFINITY)?;
        let beyond = full.lowered.is_infinite();
        Ok(Descent::Stopped(if beyond { Stop::Edge } else { Stop::Stalled }))
    }

    /// The part of the sum of squares by which two of them may differ by chance: with errors d of
    /// the residuals r, it is (2 |r| |d| + |d|^2) / |r|^2.
    fn level(&self, point: &Point) -> f64 {
        let part = self.settings.error / point.squares.max(f64::MIN_POSITIVE).sqrt();
        self.settings.cost.max(part * (2.0 + part))
    }

    fn attempt(&mut self, point: &Point, region: &Region<'_>, radius: f64) -> Fallible<Trial> {
        let (taken, cut) = region.step(radius).ok_or(LeastSquaresError::Decomposition)?;
        let moved = |j: usize| match taken.sides[j] {
            Some(Side::Lower) => self.bounds(j).0,
            Some(Side::Upper) => self.bounds(j).1,
            None => (point.parameters[j] + taken.step[j]).clamp(self.bounds(j).0, self.bounds(j).1),
        };
        let parameters: Vec<f64> = (0..taken.step.len()).map(moved).collect();
        let (residuals, _) = self.evaluate(&parameters, false)?;
        let squares: f64 = residuals.iter().map(|r| r * r).sum();
        let predicted = region.model.reduction(&taken.step) / point.squares;
        let lowered =
            if squares.is_finite() { 1.0 - squares / point.squares } else { f64::NEG_INFINITY };
        let length = region.length(&taken.step);
        Ok(Trial { parameters, cut, length, predicted, lowered })
    }

    fn end(
        &self,
        point: Point,
        outcome: Termination,
        offset: f64,
        iterations: usize,
    ) -> LeastSquaresFit {
        LeastSquaresFit {
            parameters: point.parameters,
            outcome,
            on_bound: point.sides,
            squares: point.squares,
            residuals: point.residuals,
            jacobian: point.jacobian,
            data: self.data,
            offset,
            iterations,
            evaluations: self.evaluations,
        }
    }
}

/// Scales never shrink, and a parameter without influence has scale 1.
fn widen(scales: &mut [f64], norms: &[f64]) {
    for (scale, &norm) in scales.iter_mut().zip(norms) {
        *scale = if norm > *scale { norm } else { *scale };
        if *scale == 0.0 {
            *scale = 1.0;
        }
    }
}

/// A shorter radius after a step that did less than a quarter of the prediction, a longer one after
/// one that did three quarters of it.
fn next_radius(radius: f64, trial: &Trial) -> f64 {
    let predicted = trial.predicted.max(f64::MIN_POSITIVE);
    if !trial.lowered.is_finite() || trial.lowered < -99.0 {
        return 0.1 * radius.min(trial.length);
    }
    if trial.lowered < 0.25 * predicted {
        // the minimum of the parabola through both ends with the slope at the first
        let shrink = predicted / (2.0 * predicted - trial.lowered);
        return shrink.clamp(0.1, 0.5) * radius.min(10.0 * trial.length);
    }
    match trial.cut {
        false => 2.0 * trial.length,
        true if trial.lowered >= 0.75 * predicted => radius.max(2.0 * trial.length),
        true => radius,
    }
}
