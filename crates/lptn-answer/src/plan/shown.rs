//! Numbers and names of a plan as they are shown.

use lptn_fit::network::design::Known;
use lptn_report::{duration, significant};

use super::PlanAnswer;
use crate::unseparated::joined;
use crate::words::{spaced, symbol};

/// Cell without a value.
pub(super) const NOTHING: &str = "-";

impl PlanAnswer {
    /// A standard error in the unit of its unknown.
    pub(super) fn error(&self, i: usize, si: f64) -> f64 {
        si / self.units[i].scale
    }

    /// "1.2 %" of the value, or "0.3 K" if its zero is arbitrary.
    pub(super) fn part(&self, i: usize, si: f64) -> String {
        if !si.is_finite() {
            return NOTHING.to_owned();
        }
        match self.value_of(i) {
            Some(value) => format!("{} %", significant(100.0 * si / value, 2)),
            None => self.own(i, si),
        }
    }

    /// "0.87 uW/rpm^(5/3)".
    pub(super) fn own(&self, i: usize, si: f64) -> String {
        format!("{}{}", significant(self.error(i, si), 2), spaced(symbol(&self.units[i].text)))
    }

    /// Its size, if an error can be a share of it.
    fn value_of(&self, i: usize) -> Option<f64> {
        let value = self.task.values[i].abs();
        (value > 0.0 && !self.task.unknowns[i].is_shift()).then_some(value)
    }

    /// The first few requirements.
    pub(super) fn few_known(&self) -> &[Known] {
        const MOST: usize = 3;
        &self.task.known[..self.task.known.len().min(MOST)]
    }

    /// "steel, bed".
    pub(super) fn places(&self, places: &[usize]) -> Vec<String> {
        places.iter().map(|&place| self.task.places[place].name.clone()).collect()
    }

    pub(super) fn run(&self, run: usize) -> &str {
        &self.task.runs[run].name
    }

    /// Duration of a run with this number of samples.
    pub(super) fn lasts(&self, samples: usize) -> String {
        duration(self.task.lasts(samples), 3)
    }

    /// "fast for 30 min, then 2 times slow for 10 min".
    pub(super) fn runs(&self, runs: &[(usize, usize)]) -> String {
        let mut parts: Vec<((usize, usize), usize)> = Vec::new();
        for &run in runs {
            match parts.last_mut() {
                Some((last, count)) if *last == run => *count += 1,
                _ => parts.push((run, 1)),
            }
        }
        let part = |((run, samples), count): &((usize, usize), usize)| {
            let times = if *count > 1 { format!("{count} times ") } else { String::new() };
            format!("{times}{} for {}", self.run(*run), self.lasts(*samples))
        };
        parts.iter().map(part).collect::<Vec<_>>().join(", then ")
    }

    /// The unknowns that sensors at these places concern.
    pub(super) fn concerned(&self, places: &[usize]) -> Vec<usize> {
        let unknowns = &self.task.unknowns;
        (0..unknowns.len()).filter(|&i| self.task.concerns(&unknowns[i], places)).collect()
    }

    /// "alpha to 1 % and R_skin to 5 %".
    pub(super) fn wanted(&self) -> String {
        let one = |known: &Known| {
            format!("{} to {}", self.names[known.unknown], self.part(known.unknown, known.error))
        };
        joined(&self.task.known.iter().map(one).collect::<Vec<_>>())
    }

    /// The required error of an unknown.
    pub(super) fn target(&self, i: usize) -> Option<f64> {
        self.task.known.iter().find(|known| known.unknown == i).map(|known| known.error)
    }

    /// True if anything has a cost or the budget is finite.
    pub(super) fn has_costs(&self) -> bool {
        let task = &self.task;
        let places = task.places.iter().map(|place| place.cost);
        let runs = task.runs.iter().map(|run| run.cost);
        places.chain(runs).chain([task.hour]).any(|cost| cost > 0.0) || task.budget.is_finite()
    }
}

/// A cost as text.
pub(super) fn cost(value: f64) -> String {
    significant(value, 4)
}
