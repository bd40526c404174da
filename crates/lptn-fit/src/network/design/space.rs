//! Possible measurements, and their information.

use crate::network::design::error::DesignError;
use crate::network::design::information::{Information, RowSum};
use crate::network::design::sensitive::{DesignObserver, RunInformation};
use crate::network::design::task::DesignTask;

/// Distance of a design from its targets: the number of those that are not determined, and the
/// largest error of the others over its target.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Score(usize, f64);

impl Score {
    pub(super) const WORST: Self = Self(usize::MAX, f64::INFINITY);

    /// True if it is less than a percent better than another.
    pub(super) fn is_about(self, other: Self) -> bool {
        self.0 == other.0 && self.1 > 0.99 * other.1
    }

    pub(super) fn is_reached(self) -> bool {
        self.0 == 0 && self.1 <= 1.0
    }
}

/// A run of a design, and the length at which it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leg {
    pub(super) run: usize,
    /// Index among the lengths of the run.
    pub(super) length: usize,
}

pub(super) struct Space<'t> {
    pub(super) task: &'t DesignTask,
    pub(super) runs: Vec<RunInformation>,
    /// Prior information, by `±` and by existing records.
    pub(super) before: Information,
}

impl<'t> Space<'t> {
    pub(super) fn new(
        task: &'t DesignTask,
        observer: &DesignObserver<'_>,
    ) -> Result<Self, DesignError> {
        let runs = task.informations(observer)?;
        let mut before = task.of_given(observer)?;
        before.add(&task.of_priors());
        Ok(Self { task, runs, before })
    }

    /// Information before the next run: by `±`, by existing records, and by the runs that are
    /// measured in any case, with sensors at these places.
    pub(super) fn base(&self, places: &[usize]) -> Information {
        let mut all = self.before.clone();
        let done = (0..self.runs.len()).filter(|&run| self.task.runs[run].done);
        done.for_each(|run| all.add(&self.tells(places, self.whole(run))));
        all
    }

    /// A run as long as it may last.
    pub(super) fn whole(&self, run: usize) -> Leg {
        Leg { run, length: self.runs[run].lengths.len() - 1 }
    }

    /// Information of one run with sensors at these places.
    pub(super) fn tells(&self, places: &[usize], leg: Leg) -> Information {
        let of = |place: &usize| &self.runs[leg.run].places[*place][leg.length];
        let mut all = Information::none(of(&places[0]).count);
        places.iter().for_each(|place| all.add(of(place)));
        self.settled(leg.run, all)
    }

    /// Eliminates the unknowns that only a record of this run has, with their priors.
    pub(super) fn settled(&self, run: usize, mut all: Information) -> Information {
        let shared = self.task.unknowns.len();
        for (i, own) in self.runs[run].own.iter().enumerate() {
            own.iter().for_each(|deviation| all.add_prior(shared + i, *deviation));
        }
        all.without_last(shared)
    }

    pub(super) fn score(&self, told: &Information) -> Score {
        self.score_of(&told.errors())
    }

    pub(super) fn score_of(&self, errors: &[f64]) -> Score {
        let (mut lost, mut worst) = (0, 0.0_f64);
        for known in &self.task.known {
            match errors[known.unknown] {
                error if error.is_finite() => worst = worst.max(error / known.error),
                _ => lost += 1,
            }
        }
        Score(lost, worst)
    }

    pub(super) fn samples(&self, leg: Leg) -> usize {
        self.runs[leg.run].lengths[leg.length]
    }

    /// Cost of sensors at these places.
    pub(super) fn cost_of_places(&self, places: &[usize]) -> f64 {
        places.iter().map(|&place| self.task.places[place].cost).sum()
    }

    pub(super) fn cost_of_run(&self, run: usize, samples: usize) -> f64 {
        self.task.runs[run].cost + self.task.hour * self.task.lasts(samples) / 3600.0
    }

    pub(super) fn cost_of(&self, leg: Leg) -> f64 {
        self.cost_of_run(leg.run, self.samples(leg))
    }

    /// The longest run that the rest of the budget allows.
    pub(super) fn longest(&self, run: usize, left: f64) -> Option<Leg> {
        let legs = (0..self.runs[run].lengths.len()).map(|length| Leg { run, length });
        legs.rev().find(|leg| self.cost_of(*leg) <= left)
    }

    /// The shortest length of a run, up to this one, that reaches all targets together with the
    /// information before.
    pub(super) fn shortest(
        &self,
        places: &[usize],
        (base, longest): (&Information, Leg),
    ) -> Option<Leg> {
        let reached = |length: usize| {
            let mut all = base.clone();
            all.add(&self.tells(places, Leg { length, ..longest }));
            self.score(&all).is_reached()
        };
        if !reached(longest.length) {
            return None;
        }
        let (mut low, mut high) = (0, longest.length);
        while low < high {
            let middle = usize::midpoint(low, high);
            if reached(middle) { high = middle } else { low = middle + 1 }
        }
        Some(Leg { length: high, ..longest })
    }

    /// The most informative run in addition to the information before, as long as it may last, and
    /// its score.
    pub(super) fn best_run(
        &self,
        places: &[usize],
        (base, left): (&Information, f64),
    ) -> Option<(Leg, Score)> {
        let longest = (0..self.runs.len()).filter_map(|run| self.longest(run, left));
        let scored = longest.map(|leg| {
            let mut all = base.clone();
            all.add(&self.tells(places, leg));
            (leg, self.score(&all))
        });
        scored.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }

    /// Information of a run after some samples, with the unknowns that only its record has.
    pub(super) fn exactly(
        &self,
        places: &[usize],
        (run, samples): (usize, usize),
        observer: &DesignObserver<'_>,
    ) -> Result<Information, DesignError> {
        let record = self.task.record(run, observer)?;
        let mut all: Option<Information> = None;
        for &place in places {
            let mut sum = record.begin(&self.task.places[place]);
            (0..samples).for_each(|row| sum.add(&record.row(place, row)));
            match &mut all {
                Some(all) => all.add(&sum.sum),
                None => all = Some(sum.sum),
            }
        }
        Ok(all.unwrap_or_else(|| Information::none(self.task.unknowns.len())))
    }

    /// The fewest samples of a run that reach all targets: between those of two lengths.
    pub(super) fn fewest(
        &self,
        places: &[usize],
        (base, leg): (&Information, Leg),
        observer: &DesignObserver<'_>,
    ) -> Result<usize, DesignError> {
        let record = self.task.record(leg.run, observer)?;
        let most = self.samples(leg);
        let least =
            leg.length.checked_sub(1).map_or(1, |length| self.runs[leg.run].lengths[length]);
        let mut sums: Vec<RowSum> =
            places.iter().map(|&place| record.begin(&self.task.places[place])).collect();
        for row in 0..most {
            let rows = places.iter().zip(&mut sums);
            rows.for_each(|(&place, sum)| sum.add(&record.row(place, row)));
            if row < least {
                continue;
            }
            let mut own = sums[0].sum.clone();
            sums[1..].iter().for_each(|sum| own.add(&sum.sum));
            let mut all = base.clone();
            all.add(&self.settled(leg.run, own));
            if self.score(&all).is_reached() {
                return Ok(row + 1);
            }
        }
        Ok(most)
    }
}
