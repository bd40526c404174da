//! Candidate designs side by side.

mod answer;
mod conditions;
mod differences;
mod doubts;
mod evaluate;
mod figure;
mod load;
mod margins;
mod page;
mod variants;
mod verdict;

use std::path::PathBuf;

use lptn_netlist::{CsvOptions, Files};
use lptn_solve::{available_threads, in_parallel};
use lptn_study::{SortKey, order};

use crate::belief::Belief;
use crate::failure::Failure;
use crate::listener::Listener;
use crate::lumping::Detail;
use evaluate::{doubtful, evaluate_all};
use load::{believed, jobs, unit};

pub use answer::CompareAnswer;
pub use load::{Loaded, load, too_many, used};
pub use variants::{Variant, of_sets};

/// Candidates and settings of a comparison.
#[derive(Clone, Debug)]
pub struct CompareQuestion {
    /// Netlists.
    pub files: Vec<PathBuf>,
    /// Assignments for the candidates that have the parameter.
    /// Several values in one, such as `R=1K/W,2K/W`, make one candidate each.
    pub set: Vec<String>,
    /// The posterior of a fit to take values from.
    pub posterior: Option<PathBuf>,
    /// True if the uncertainty of peaks, margins and their order is computed.
    pub uncertainty: bool,
    /// Tables of parts, each of which makes a candidate.
    pub parts: Vec<PathBuf>,
    /// Statements about the form of these tables, where their contents do not show it.
    pub csv: CsvOptions,
    /// True if every netlist is taken in each of its load cases.
    pub cases: bool,
    /// True if settled cycles are compared instead of runs.
    pub periodic: bool,
    /// The order of the candidates.
    pub sort: SortKey,
    /// The unit of temperatures; `None` for that of the first netlist.
    pub temperature_unit: Option<String>,
    /// Threads; `None` for all. The result is the same for any number.
    pub threads: Option<usize>,
    /// Amount of detail in a table.
    pub detail: Detail,
    /// The words of the command that asks, for reports.
    pub command: Vec<String>,
}

impl CompareQuestion {
    /// Compares. Candidates that cannot be read or fail are rows of the answer.
    ///
    /// # Errors
    /// A value, part or unit that fits no candidate, and too many variants.
    pub fn ask(&self, listener: &dyn Listener) -> Result<CompareAnswer, Failure> {
        let threads = self.threads.unwrap_or_else(available_threads);
        let jobs = jobs(self, listener)?;
        let belief = self.posterior.as_deref().map_or(Belief::Named, Belief::Shared);
        let loaded = in_parallel(&jobs, threads, |(file, variant)| load(file, variant, &belief));
        used(&self.set, &loaded)?;
        believed(self, &loaded)?;
        let mut done = evaluate_all(&loaded, (self.periodic, threads), listener);
        let unsure = match self.uncertainty {
            true => doubtful(&loaded, &mut done, threads),
            false => Vec::new(),
        };
        let unit = unit(self, &loaded)?;
        let candidates: Vec<_> = done.iter().map(|outcome| outcome.as_ref().ok()).collect();
        let places = order(&candidates, self.sort);
        let mut outcomes: Vec<_> = loaded.into_iter().zip(done).map(Some).collect();
        let sorted = places.into_iter().filter_map(|place| outcomes[place].take());
        let mut answer = CompareAnswer::of(sorted, unit);
        answer.gathered.add(&Files::new(), &unsure);
        let variants = jobs.iter().any(|(_, variant)| !variant.label().is_empty());
        let fold = self.detail < Detail::Verbose;
        Ok(CompareAnswer { variants, fold, command: self.command.clone(), ..answer })
    }
}
