//! A proven periodic steady state.
//!
//! Let `P` lead from the state at the start of a cycle to that at its end, and let `u` be the way
//! from a start `u0` near that which was found. If the run begins with the bounds `w0`, its bounds
//! `w` are valid for every solution that begins within `w0` of `u0` (`certify/bound.rs`). Such a
//! solution ends within `w(T) + |u(T) - u0|` of `u0`. If that is less than `w0` at each node, `P`
//! leads from the box `u0 +- w0` into itself, so that a solution begins there and comes back to its
//! start (L. E. J. Brouwer, Math. Ann. 71 (1912) 97). It repeats, because the inputs do, and it is
//! within `w` of the way all the time.
//!
//! The heat flows have to be continuous over temperature. If their slopes have bounds, the solution
//! is the only one in the box: two solutions differ by at most `q w`, as `C w' >= A w`, if they
//! begin within `q w0` of each other, so that `P` contracts (S. Banach, Fund. Math. 3 (1922) 133).
//!
//! The bounds `w0` are proposed, and then checked. Without curvature a cycle leads from `w0` to
//! `a + Q w0` with a matrix `Q >= 0`. If `Q v <= h v` for times `v > 0` and a share `h < 1`, then
//! `w0 = s v` is enough for each `s` with `a <= (1 - h) s v`.

use super::CycleMethod;
use super::cycle::Cycles;
use super::error::PeriodicError;
use super::search::{Found, Search};
use crate::certify::{ROUNDING, Uncertified, is_covered, shrinking};
use crate::settings::Around;
use crate::solution::Solution;

/// Most cycles that propose bounds.
const MOST_CYCLES: usize = 8;

/// The proposed bounds are wider than necessary by this share.
const GENEROUS: f64 = 0.05;

/// Most rounds in which bounds are made smaller; the last one is that which leaves more than this
/// share of each.
const ROUNDS: usize = 4;
const FEW: f64 = 0.8;

/// Bounds that did not prove anything are tried once more, this much wider.
const WIDER: f64 = 1.5;

/// The largest share that a cycle is supposed to leave of bounds, and the one if they do not shrink.
const LONGEST: f64 = 1.0 - 1e-6;
const UNKNOWN: f64 = 0.9;

/// The tolerance of the start of the way, as a share of that of the cycle, and its least in K.
const FINER: f64 = 1e-2;
const FINEST: f64 = 1e-9;

/// Least share of the tolerance of bounds.
const LEAST_SHARE: f64 = 1e-3;

/// Least bound of a start in K.
const LEAST: f64 = 1e-13;

/// A periodic state with proven bounds, or with the reason why it has none.
pub(super) fn proven(
    cycles: &mut Cycles<'_>,
    (found, method): (Found, CycleMethod),
) -> Result<Found, PeriodicError> {
    if let Err(reason) = is_covered(cycles.system) {
        return Ok(found.unproven(reason));
    }
    let (start, tolerance) = (found.shot.start.clone(), found.shot.noise);
    let centre = match method {
        CycleMethod::Shooting => finer(cycles, (&start, tolerance))?,
        _ => start.clone(),
    };
    let mut proof = Proof::new(cycles, (start, tolerance), centre);
    let mut bounds = match proof.proposed()? {
        Ok(bounds) => bounds,
        Err(reason) => return Ok(found.unproven(reason)),
    };
    let mut failed = None;
    for _ in 0..2 {
        let solution = proof.cycle(bounds.clone(), true)?;
        match returned(&solution, &proof.centre) {
            Err(reason) => return Ok(found.unproven(reason)),
            Ok(end) => match proof.not_shrunk(&bounds, &end) {
                None => return Ok(Found { solution, ..found }),
                reason => failed = reason,
            },
        }
        bounds.iter_mut().for_each(|bound| *bound *= WIDER);
    }
    Ok(match failed {
        Some(reason) => found.unproven(reason),
        None => found,
    })
}

/// A start that a cycle of a much smaller tolerance leads back to, near this one; this one if there
/// is none.
fn finer(
    cycles: &mut Cycles<'_>,
    (start, tolerance): (&[f64], f64),
) -> Result<Vec<f64>, PeriodicError> {
    let found = Search::new(cycles, (FINER * tolerance).max(FINEST.min(tolerance)));
    match found.find(start.to_vec()) {
        Ok(found) => Ok(found.shot.start),
        Err(error @ PeriodicError::Interrupted { .. }) => Err(error),
        Err(_) => Ok(start.to_vec()),
    }
}

impl Found {
    fn unproven(mut self, reason: Uncertified) -> Self {
        self.solution.certificate = Some(Err(reason));
        self
    }
}

/// Cycles from the start that was found.
struct Proof<'p, 'a> {
    start: Vec<f64>,
    /// The start of the way.
    centre: Vec<f64>,
    /// In K.
    tolerance: f64,
    cycles: &'p mut Cycles<'a>,
    /// Times in s over which bounds shrink at every node, if there are some.
    times: Vec<f64>,
    /// The share of bounds that a cycle is expected to leave.
    expected: f64,
}

impl<'p, 'a> Proof<'p, 'a> {
    fn new(
        cycles: &'p mut Cycles<'a>,
        (start, tolerance): (Vec<f64>, f64),
        centre: Vec<f64>,
    ) -> Self {
        let (from, period) = cycles.span();
        let of = |time: f64| shrinking(cycles.system, time, &start);
        let both = of(from).zip(of(from + 0.5 * period));
        let mean =
            |(a, b): (Vec<f64>, Vec<f64>)| a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
        let times: Vec<f64> = both.map_or_else(|| vec![period; start.len()], mean);
        let slowest = times.iter().copied().fold(0.0, f64::max);
        Self { start, centre, tolerance, cycles, times, expected: (-period / slowest).exp() }
    }

    /// Later cycles add up the bounds that one adds, so it may add less.
    fn cycle(&mut self, bounds: Vec<f64>, results: bool) -> Result<Solution, PeriodicError> {
        let share = (1.0 - self.expected).max(LEAST_SHARE);
        let around = Around { centre: self.centre.clone(), bounds, share };
        self.cycles.certified((self.start.clone(), self.tolerance), (around, results))
    }

    /// The end of a cycle without results, from these bounds in K.
    fn end(&mut self, bounds: &[f64]) -> Result<Result<Vec<f64>, Uncertified>, PeriodicError> {
        let solution = self.cycle(bounds.to_vec(), false)?;
        Ok(returned(&solution, &self.centre))
    }

    /// Bounds in K of the start that a cycle may shrink.
    fn proposed(&mut self) -> Result<Result<Vec<f64>, Uncertified>, PeriodicError> {
        let own = match self.end(&vec![0.0; self.start.len()])? {
            Ok(own) => own,
            Err(reason) => return Ok(Err(reason)),
        };
        let (mut shape, mut keeps) = (self.times.clone(), (0, self.expected));
        for _ in 0..MOST_CYCLES {
            let (_, most) = largest(&shape, &own);
            let share = if keeps.1 < LONGEST { keeps.1 } else { UNKNOWN };
            let scale = (1.0 + GENEROUS) * most / (1.0 - share);
            let bounds: Vec<f64> = shape.iter().map(|v| scale * v).collect();
            let end = match self.end(&bounds)? {
                Ok(end) => end,
                Err(reason) => return Ok(Err(reason)),
            };
            if self.not_shrunk(&bounds, &end).is_none() {
                return self.tightened([bounds, end]).map(Ok);
            }
            let later: Vec<f64> = end.iter().zip(&own).map(|(end, own)| end - own).collect();
            keeps = largest(&bounds, &later);
            if keeps.1 >= 1.0 {
                // the part that a cycle leaves has a shape that lasts
                shape = later.iter().map(|w| w.max(LEAST)).collect();
            }
        }
        Ok(Err(self.keeps(keeps)))
    }

    /// Smaller bounds in K that a cycle shrinks too, from some with those at the end of the cycle.
    fn tightened(&mut self, mut pair: [Vec<f64>; 2]) -> Result<Vec<f64>, PeriodicError> {
        for _ in 0..ROUNDS {
            let Ok(next) = self.end(&pair[1])? else { break };
            let bounds = nearer([&pair[0], &pair[1], &next]);
            let Ok(end) = self.end(&bounds)? else { break };
            if self.not_shrunk(&bounds, &end).is_some() {
                break;
            }
            let (_, left) = largest(&pair[1], &bounds);
            pair = [bounds, end];
            if left > FEW {
                break;
            }
        }
        let [bounds, end] = &pair;
        Ok(bounds.iter().zip(end).map(|(w, end)| end + GENEROUS * (w - end)).collect())
    }

    /// Why a cycle from these bounds to those at its end proves nothing; `None` if it does.
    fn not_shrunk(&self, bounds: &[f64], end: &[f64]) -> Option<Uncertified> {
        let (node, share) = largest(bounds, end);
        (share * (1.0 + ROUNDING) >= 1.0).then(|| self.keeps((node, share)))
    }

    fn keeps(&self, (state, share): (usize, f64)) -> Uncertified {
        let system = self.cycles.system;
        let id = system.states()[state];
        Uncertified::Cycle { name: system.network().nodes()[id.index()].name.clone(), share }
    }
}

/// The most in K by which a solution from the bounds of a start can differ from that after a cycle.
fn returned(solution: &Solution, start: &[f64]) -> Result<Vec<f64>, Uncertified> {
    let lost = || Uncertified::Lost { time: solution.times().first().copied().unwrap_or(0.0) };
    let certificate = solution.certificate().ok_or_else(lost)?.as_ref().map_err(Clone::clone)?;
    let [way, bounds] = &certificate.end;
    if way.len() != start.len() {
        return Err(lost());
    }
    let ends = way.iter().zip(bounds).zip(start);
    let of = |((way, bound), start): ((&f64, &f64), &f64)| {
        (bound + (way - start).abs()) * (1.0 + ROUNDING) + LEAST
    };
    let all: Vec<f64> = ends.map(of).collect();
    if all.iter().all(|bound| bound.is_finite()) { Ok(all) } else { Err(lost()) }
}

/// Bounds nearer to the smallest ones: if `d` is the last difference of bounds from one cycle to the
/// next, and `Q d >= q d`, then all later differences are at least `d q/(1 - q)`.
fn nearer([first, second, third]: [&[f64]; 3]) -> Vec<f64> {
    let differences = |(a, (b, c)): (&f64, (&f64, &f64))| (a - b, b - c);
    let pairs = first.iter().zip(second.iter().zip(third)).map(differences);
    let shares = pairs.clone().filter(|(before, _)| *before > 0.0).map(|(d, next)| next / d);
    let least = (1.0 - GENEROUS) * shares.fold(1.0, f64::min).max(0.0);
    let later = least / (1.0 - least);
    pairs.zip(third).map(|((_, d), w)| w - later * d.max(0.0)).collect()
}

/// The largest of `after / before`, with its place; infinite if it is not known.
fn largest(before: &[f64], after: &[f64]) -> (usize, f64) {
    let share = |(before, after): (&f64, &f64)| match after / before {
        share if share.is_nan() => f64::INFINITY,
        share => share,
    };
    let all = before.iter().zip(after).map(share).enumerate();
    all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

#[cfg(test)]
mod tests;
