//! The numbers of one run, or why it has none.

use lptn_analysis::RunError;
use lptn_assembly::ChangeError;
use lptn_solve::Solution;

use crate::uncertainty::lost::Lost;

/// The numbers of one run.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    /// The temperatures of the first node at all rows in K, then those of the next; empty unless
    /// requested.
    pub(crate) rows: Vec<f64>,
    /// The answers in the order of the task's questions.
    pub(crate) answers: Vec<f64>,
}

impl Sample {
    /// The rows, ends, peaks and margins of a run whose recorded nodes are its watched ones.
    pub(crate) fn of(solution: &Solution, rows: bool) -> Self {
        let columns: Vec<Vec<f64>> = solution
            .recorded()
            .iter()
            .map(|node| solution.temperature(*node).unwrap_or_default())
            .collect();
        let of_node = |(seen, column): (&lptn_solve::Watched, &Vec<f64>)| {
            [column.last().copied().unwrap_or(f64::NAN), seen.peak.0]
        };
        let nodes = solution.watched().iter().zip(&columns).flat_map(of_node);
        let answers = nodes.chain(solution.limits().iter().map(|limit| limit.margin)).collect();
        Self { rows: if rows { columns.concat() } else { Vec::new() }, answers }
    }
}

/// Why a sample has no result.
#[derive(Clone, Debug)]
pub(crate) enum NoSample {
    /// The whole study was interrupted.
    Interrupted,
    /// It was not tried: another run of the same base point has no result.
    Skipped,
    /// The reason, and the key to group it by.
    Lost { key: String, lost: Lost },
}

impl NoSample {
    pub(crate) fn refused(error: &ChangeError) -> Self {
        let first = match error {
            ChangeError::Network(errors) => errors.first(),
            ChangeError::Assembly(_) => None,
        };
        let name = first.map_or("", |first| first.name.as_str());
        let message = first.map_or_else(|| error.to_string(), ToString::to_string);
        Self::lost((error.code(), name), true, message)
    }

    pub(crate) fn failed(error: &RunError) -> Self {
        Self::lost((error.code(), ""), false, error.to_string())
    }

    fn lost((code, name): (&'static str, &str), refused: bool, message: String) -> Self {
        Self::Lost {
            key: format!("{code} {name}"),
            lost: Lost { count: 1, refused, code, message },
        }
    }
}

/// Counts those without a result by their reason, in the order in which the reasons first appear.
pub(crate) fn count<'a>(all: impl Iterator<Item = &'a NoSample>) -> Vec<Lost> {
    let mut found: Vec<(&str, Lost)> = Vec::new();
    for no_sample in all {
        let NoSample::Lost { key, lost } = no_sample else { continue };
        match found.iter_mut().find(|(known, _)| known == key) {
            Some((_, known)) => known.count += 1,
            None => found.push((key, lost.clone())),
        }
    }
    found.into_iter().map(|(_, lost)| lost).collect()
}
