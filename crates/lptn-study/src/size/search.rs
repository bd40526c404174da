//! The best value of a parameter that keeps every requirement.
//!
//! The range is evaluated at [`POINTS`] points first, so that a requirement kept only in the middle
//! is found, and one that breaks again beyond the answer is reported. Then the border nearest to
//! the best end is narrowed to neighbouring numbers, with the full network at every step.

use lptn_netlist::Goal;

use crate::size::answer::{Edge, SizeTask, Sizing, Trial, Verdict};
use crate::size::error::SizeError;
use crate::size::judge::{Care, Judge, Moments};
use crate::size::root::{last_kept, norton_guess};
use crate::size::shortfall::Shortfall;

/// Points at which the range is evaluated.
const POINTS: usize = 25;

/// A range that spans more than this factor is divided in equal ratios instead of equal steps.
pub(crate) const WIDE: f64 = 10.0;

/// Steps of the search for a value that keeps every requirement if no point does: golden section,
/// to 2e-9 of its interval. After half of them, at 4e-5, margins with the error of a run have to
/// show a difference: at a round top they hardly change, at a crossing of two they do.
const GOLDEN_STEPS: usize = 42;

/// Margins of the finest runs that differ by less than this in K may be the same.
const NOISE: f64 = 1e-8;

/// Values that differ by less than this share are the same if margins have the error of a run.
const RESOLUTION: f64 = 1e-12;

/// The worst margin of a value without a steady state, as a share of its scale.
const NOT_KEPT: f64 = -1.0;

/// Relative change of the parameter for its sensitivity.
const NUDGE: f64 = 1e-4;

/// Finds the best value of the task's parameter.
///
/// # Errors
/// [`SizeError`] if a network inside the range cannot be solved or a requirement has no value. That
/// no value keeps the requirements is an answer: [`Verdict::Infeasible`].
pub fn size(task: &SizeTask<'_>) -> Result<Sizing, SizeError> {
    let (from, to) = task.range;
    if !(from.is_finite() && to.is_finite() && from < to) {
        return Err(SizeError::Range { from, to });
    }
    let (judge, shortfall) = (Judge::new(task.demand)?, Shortfall::of(&task.demand));
    let trials = Trials { task, judge };
    let scan = places(task).map(|value| trials.look(value)).collect::<Result<Vec<_>, _>>()?;
    let search = Search { scale: scales(&scan), shortfall, trials, scan };
    let found = search.best()?;
    let closest = search.closest(&found.trial);
    let sensitivity = match found.edge {
        None => search.sensitivity(task, &found.trial, closest),
        Some(_) => None,
    };
    let Found { verdict, trial, edge, breaks_again, first_guess } = found;
    let error = sensitivity.filter(|_| verdict == Verdict::Bound && trial.judged.error > 0.0);
    let error = error.map(|slope| 0.01 * trial.value.abs() * trial.judged.error / slope.abs());
    let solved = search.trials.judge.count();
    let looked_at = search.scan;
    Ok(Sizing {
        verdict,
        trial,
        closest,
        breaks_again,
        edge,
        sensitivity,
        error,
        first_guess,
        solved,
        looked_at,
    })
}

/// The points of the first evaluation, the best end of the range first; the ends are exact.
fn places(task: &SizeTask<'_>) -> impl Iterator<Item = f64> + use<> {
    let (best, worst) = match task.goal {
        Goal::Minimise => task.range,
        Goal::Maximise => (task.range.1, task.range.0),
    };
    let ratio = worst / best;
    let wide = best > 0.0 && worst > 0.0 && ratio.max(ratio.recip()) > WIDE;
    (0..POINTS).map(move |i| {
        let share = i as f64 / (POINTS - 1) as f64;
        match i {
            0 => best,
            _ if i == POINTS - 1 => worst,
            _ if wide && ratio.is_normal() => best * ratio.powf(share),
            _ if wide => best.powf(1.0 - share) * worst.powf(share),
            _ => best + share * (worst - best),
        }
    })
}

/// The largest size of each margin. Borders and edges are located in shares of it; the answer does
/// not depend on them, since a border is a sign.
fn scales(scan: &[Trial]) -> Vec<f64> {
    let count = scan.first().map_or(0, |trial| trial.judged.margins.len());
    let largest =
        |i: usize| scan.iter().map(|trial| trial.judged.margins[i].abs()).fold(0.0, f64::max);
    (0..count).map(largest).map(|scale| if scale > 0.0 { scale } else { 1.0 }).collect()
}

/// Solves the network again and again.
pub(super) struct Trials<'a> {
    pub(super) task: &'a SizeTask<'a>,
    pub(super) judge: Judge<'a>,
}

impl Trials<'_> {
    pub(super) fn with(&self, value: f64, care: Care) -> Result<Trial, SizeError> {
        let judged = self.judge.judge(&[(self.task.parameter, value)], care)?;
        Ok(Trial { value, judged })
    }

    /// A rough evaluation of a value.
    fn look(&self, value: f64) -> Result<Trial, SizeError> {
        self.with(value, Care::Look)
    }

    /// The most accurate evaluation of a value.
    pub(super) fn at(&self, value: f64) -> Result<Trial, SizeError> {
        self.with(value, Care::Proof)
    }

    /// True if margins are exact to rounding.
    pub(super) fn exact(&self) -> bool {
        matches!(self.task.demand.moments, Moments::Steady(_))
    }

    /// The value at which a margin is zero, by the Norton equivalent through three trials: steady
    /// states only, for peaks follow no such law.
    fn guess(&self, margins: [(f64, f64); 3]) -> Option<f64> {
        if self.exact() { norton_guess(margins) } else { None }
    }
}

pub(super) struct Search<'a> {
    pub(super) trials: Trials<'a>,
    scan: Vec<Trial>,
    scale: Vec<f64>,
    /// The measure of requirements that are broken.
    shortfall: Shortfall,
}

struct Found {
    verdict: Verdict,
    trial: Trial,
    edge: Option<Edge>,
    breaks_again: Option<f64>,
    first_guess: Option<f64>,
}

impl Found {
    fn without_border(verdict: Verdict, trial: Trial) -> Self {
        Self { verdict, trial, edge: None, breaks_again: None, first_guess: None }
    }
}

/// The border at which a requirement breaks.
struct Border {
    /// The last trial that keeps everything.
    trial: Trial,
    /// The first value beyond it.
    beyond: f64,
    /// The first guess for it.
    first_guess: Option<f64>,
}

impl Search<'_> {
    fn shares(&self, trial: &Trial) -> impl Iterator<Item = f64> {
        trial.judged.margins.iter().zip(&self.scale).map(|(margin, scale)| margin / scale)
    }

    /// The least margin as a share of its scale: not negative if everything is kept.
    pub(super) fn worst(&self, trial: &Trial) -> f64 {
        self.shares(trial).fold(f64::INFINITY, f64::min)
    }

    /// The requirement that is broken most, or is the closest to it.
    pub(super) fn closest(&self, trial: &Trial) -> usize {
        self.shortfall.worst(&trial.judged)
    }

    /// True if the first of two trials comes closer to keeping everything, by more than this in K.
    fn closer(&self, a: &Trial, b: &Trial, than: f64) -> bool {
        self.shortfall.closer(&a.judged, &b.judged, than)
    }

    pub(super) fn keeps(&self, trial: &Trial) -> bool {
        self.worst(trial) >= 0.0
    }

    /// The trial at a place, as accurate as possible.
    fn proven(&self, place: usize) -> Result<Trial, SizeError> {
        let trial = &self.scan[place];
        if self.trials.exact() { Ok(trial.clone()) } else { self.trials.at(trial.value) }
    }

    fn best(&self) -> Result<Found, SizeError> {
        let first = self.scan.iter().position(|trial| self.keeps(trial));
        let Some((k, broken, kept)) = first.map_or(Ok(None), |k| self.bracket(k))? else {
            return self.between_the_places();
        };
        let mut found = match broken {
            None => Found::without_border(Verdict::BestEnd, kept),
            Some(broken) => self.at_border(&broken, &kept)?,
        };
        found.breaks_again = self.breaks_after(k)?;
        Ok(found)
    }

    /// The first place with everything kept, searched from place `k`, the first that a rough
    /// evaluation keeps; also the broken trial before it, unless it is the best end. A rough
    /// evaluation may err at a place that is nearer to the border than its error.
    fn bracket(&self, mut k: usize) -> Result<Option<(usize, Option<Trial>, Trial)>, SizeError> {
        let mut kept = self.proven(k)?;
        while !self.keeps(&kept) {
            k += 1;
            if k == self.scan.len() {
                return Ok(None);
            }
            kept = self.proven(k)?;
        }
        while k > 0 {
            let before = self.proven(k - 1)?;
            if !self.keeps(&before) {
                return Ok(Some((k, Some(before), kept)));
            }
            kept = before;
            k -= 1;
        }
        Ok(Some((0, None, kept)))
    }

    /// The last trial on the way from `kept` to `broken` that keeps everything; at an edge one that
    /// is far enough from it.
    fn at_border(&self, broken: &Trial, kept: &Trial) -> Result<Found, SizeError> {
        let Border { trial, beyond, first_guess } = self.border(broken, kept)?;
        let edge = self.edge(&trial, beyond)?;
        let (verdict, trial) = match edge {
            None => (Verdict::Bound, trial),
            Some(_) => (Verdict::Edge, self.safe((trial, beyond), kept.value)?),
        };
        Ok(Found { verdict, trial, edge, breaks_again: None, first_guess })
    }

    /// The last trial on the way from `kept` to `broken` that keeps everything.
    fn border(&self, broken: &Trial, kept: &Trial) -> Result<Border, SizeError> {
        let (mut broken, mut kept) = (broken.clone(), kept.clone());
        let middle = self.trials.at(0.5 * (broken.value + kept.value))?;
        let binding = self.closest(&broken);
        let margin = |trial: &Trial| (trial.value, trial.judged.margins[binding]);
        let guess = self.trials.guess([margin(&broken), margin(&middle), margin(&kept)]);
        let guessed = guess.map(|value| self.trials.at(value)).transpose()?;
        for trial in [Some(middle), guessed].into_iter().flatten() {
            let inside = (trial.value - broken.value) * (trial.value - kept.value) < 0.0;
            match self.keeps(&trial) {
                true if inside => kept = trial,
                false if inside => broken = trial,
                _ => {}
            }
        }
        let point = |trial: &Trial| (trial.value, self.worst(trial));
        let mut worst = |value| match self.trials.at(value) {
            // no steady state is found exactly where two of them end
            Err(error) if error.is_not_found() => Ok(NOT_KEPT),
            trial => trial.map(|trial| self.worst(&trial)),
        };
        let resolution = if self.trials.exact() { 0.0 } else { RESOLUTION };
        let ends = last_kept(point(&kept), point(&broken), (resolution, &mut worst))?;
        let [(value, _), (beyond, _)] = ends;
        Ok(Border { trial: self.trials.at(value)?, beyond, first_guess: guess })
    }

    /// The value at which a requirement breaks beyond place `k`, at which everything is kept.
    fn breaks_after(&self, k: usize) -> Result<Option<f64>, SizeError> {
        let behind = self.scan.iter().enumerate().skip(k + 1);
        let Some((at, _)) = behind.into_iter().find(|(_, trial)| !self.keeps(trial)) else {
            return Ok(None);
        };
        let (kept, broken) = (self.proven(at - 1)?, self.proven(at)?);
        match (self.keeps(&kept), self.keeps(&broken)) {
            (true, false) => self.border(&broken, &kept).map(|border| Some(border.trial.value)),
            // the border is there, as nearly as a rough evaluation can locate it
            (false, _) => Ok(Some(kept.value)),
            (true, true) => Ok(Some(broken.value)),
        }
    }

    /// No place keeps everything: perhaps a value between them does. Golden section around the best
    /// place, the first of equal ones, which is nearest to the best end.
    fn between_the_places(&self) -> Result<Found, SizeError> {
        let better = |best: usize, place: usize| {
            let (a, b) = (&self.scan[place], &self.scan[best]);
            if self.closer(a, b, a.judged.error.max(b.judged.error)) { place } else { best }
        };
        let best = (0..self.scan.len()).fold(0, better);
        let near = [best.saturating_sub(1), best, (best + 1).min(self.scan.len() - 1)];
        let [low, middle, high] = near.map(|place| self.proven(place));
        let (low, high) = (&low?, &high?);
        let top = self.top((low.value, high.value), middle?)?;
        if !self.keeps(&top) {
            return Ok(Found::without_border(Verdict::Infeasible, top));
        }
        let found = self.at_border(low, &top)?;
        let behind = self.border(high, &top)?.trial;
        Ok(Found { breaks_again: Some(behind.value), ..found })
    }

    /// The best trial between two values that golden section finds; the first that keeps everything
    /// ends it.
    fn top(&self, (mut a, mut b): (f64, f64), mut best: Trial) -> Result<Trial, SizeError> {
        let golden = 0.5 * (5_f64.sqrt() - 1.0);
        let inner = |from: f64, to: f64| self.trials.at(to - golden * (to - from));
        let (mut left, mut right) = (inner(a, b)?, inner(b, a)?);
        let exact = self.trials.exact();
        let (rough, noise) = if exact { (GOLDEN_STEPS, 0.0) } else { (GOLDEN_STEPS / 2, NOISE) };
        let closer = |a: &Trial, b: &Trial| self.closer(a, b, noise);
        for step in 0..GOLDEN_STEPS {
            for trial in [&left, &right] {
                if closer(trial, &best) {
                    best = trial.clone();
                }
            }
            let same = || !closer(&left, &right) && !closer(&right, &left);
            if self.keeps(&best) || (step >= rough && same()) {
                break;
            }
            if !closer(&right, &left) {
                b = right.value;
                right = left;
                left = inner(a, b)?;
            } else {
                a = left.value;
                left = right;
                right = inner(b, a)?;
            }
        }
        Ok(best)
    }

    /// Change of a margin for 1 % more of the parameter, by a central difference.
    fn sensitivity(&self, task: &SizeTask<'_>, trial: &Trial, closest: usize) -> Option<f64> {
        let ty = task.demand.network.parameters()[task.parameter.index()].ty;
        if ty.absolute || trial.value == 0.0 {
            return None;
        }
        let margin = |share: f64| {
            self.trials.at(trial.value * share).ok().map(|t| t.judged.margins[closest])
        };
        Some((margin(1.0 + NUDGE)? - margin(1.0 - NUDGE)?) / (2.0 * NUDGE) * 0.01)
    }
}
