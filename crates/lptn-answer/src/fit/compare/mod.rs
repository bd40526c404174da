//! Choice between several networks by records.

mod figure;
mod page;
mod shown;
mod words;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn_fit::choice::{Choice, ChoiceError, Contender, Judged, choose};
use lptn_fit::network::NetworkFitTask;
use lptn_netlist::{Diagnostic, Files, FitStudy};
use lptn_report::plain;
use lptn_solve::available_threads;
use lptn_units::Problem as _;

use super::network::{FitNetworkAnswer, STUDIES, doubts, record_place};
use crate::answer::Answer;
use crate::failure::{Failure, told};
use crate::gathered::Gathered;
use crate::input::Input;
use crate::listener::Listener;

/// Asks which of several networks predicts held-out records best.
#[derive(Clone, Debug, Default)]
pub struct FitCompareQuestion {
    /// The `[fit.NAME]` that are taken from each netlist; none for all.
    pub fits: Vec<String>,
    /// Number of searches from other starts between the bounds; `None` for that of each study.
    pub starts: Option<usize>,
    /// Number of runs computed at once; `None` for as many as the machine can.
    pub threads: Option<usize>,
}

/// A netlist whose fits are candidates.
///
/// It keeps its own values: another fit may have counted the same records.
#[derive(Clone, Debug)]
pub struct CandidateNetlist {
    /// Its file, which candidates are named after.
    pub path: PathBuf,
    /// Label that distinguishes it from netlists of the same file, `n=2`; empty for the only one.
    pub label: String,
    /// The netlist.
    pub input: Arc<Input>,
}

/// A candidate network: a `[fit.NAME]` of a netlist.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Name that distinguishes it from the others.
    pub name: String,
    /// The netlist.
    pub input: Arc<Input>,
    /// The fit.
    pub study: FitStudy,
}

/// A comparison that can be computed.
#[derive(Debug)]
pub struct FitComparison {
    netlists: Vec<Arc<Input>>,
    candidates: Vec<Candidate>,
    contenders: Vec<Contender>,
    threads: usize,
}

/// Networks compared by their predictions of records.
#[derive(Debug)]
pub struct FitCompareAnswer {
    /// The networks.
    pub candidates: Vec<Candidate>,
    /// The judgement of each, in the order of `candidates`.
    pub choice: Choice,
    /// The fit of each candidate to all records.
    pub fits: Vec<FitNetworkAnswer>,
    /// Doubts in each candidate.
    doubts: Vec<Vec<Diagnostic>>,
    gathered: Gathered,
}

impl Answer for FitCompareAnswer {
    fn files(&self) -> &Files {
        &self.gathered.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        self.gathered.doubts.clone()
    }
}

impl FitCompareQuestion {
    /// Asks netlists.
    ///
    /// # Errors
    /// Fewer than two candidates, records that differ, a fit that cannot be computed, and a
    /// comparison that was interrupted.
    pub fn ask(
        &self,
        netlists: &[CandidateNetlist],
        listener: &dyn Listener,
    ) -> Result<FitCompareAnswer, Failure> {
        self.begin(netlists, listener)?.compute(listener)
    }

    /// Reads the studies in advance.
    ///
    /// # Errors
    /// A study that does not exist, and one that does not fit its network.
    pub fn begin(
        &self,
        netlists: &[CandidateNetlist],
        listener: &dyn Listener,
    ) -> Result<FitComparison, Failure> {
        let candidates = self.candidates(netlists)?;
        let netlists: Vec<Arc<Input>> = netlists.iter().map(|one| Arc::clone(&one.input)).collect();
        for input in &netlists {
            listener.warn(&input.netlist.files, &input.netlist.warnings);
        }
        let threads = self.threads.unwrap_or_else(available_threads).max(1);
        let task = |one: &Candidate| {
            let mut task =
                NetworkFitTask::of(&one.input.netlist, &one.study, threads).map_err(|error| {
                    let place = record_place(&one.study, &error).unwrap_or(&one.study.span);
                    one.input.failure(&error, Some(place.clone()))
                })?;
            task.more_starts = self.starts.unwrap_or(task.more_starts);
            Ok(Contender { name: one.name.clone(), task })
        };
        let contenders = candidates.iter().map(task).collect::<Result<_, Failure>>()?;
        Ok(FitComparison { netlists, candidates, contenders, threads })
    }

    fn candidates(&self, netlists: &[CandidateNetlist]) -> Result<Vec<Candidate>, Failure> {
        let mut found: Vec<(&CandidateNetlist, &FitStudy)> = Vec::new();
        for one in netlists {
            let fits = &one.input.netlist.studies.fits;
            let is_meant =
                |study: &&FitStudy| self.fits.is_empty() || self.fits.contains(&study.name);
            let before = found.len();
            found.extend(fits.iter().filter(is_meant).map(|study| (one, study)));
            if found.len() == before {
                let name = self.fits.first().map(String::as_str);
                STUDIES.find(&one.input, (fits, |study| &study.name), name)?;
            }
        }
        let unused = |name: &&String| found.iter().all(|(_, study)| study.name != **name);
        if let (Some(name), Some(one)) = (self.fits.iter().find(unused), netlists.first()) {
            let fits = &one.input.netlist.studies.fits;
            STUDIES.find(&one.input, (fits, |study| &study.name), Some(name))?;
        }
        let names = names(&found);
        let candidate = |((one, study), name): (&(&CandidateNetlist, &FitStudy), String)| {
            Candidate { name, input: Arc::clone(&one.input), study: (*study).clone() }
        };
        Ok(found.iter().zip(names).map(candidate).collect())
    }
}

impl FitComparison {
    /// Computes it.
    ///
    /// # Errors
    /// Fewer than two candidates, records that differ, a run that fails, and an interruption.
    pub fn compute(self, listener: &dyn Listener) -> Result<FitCompareAnswer, Failure> {
        let Self { netlists, candidates, contenders, threads } = self;
        let choice = choose(&contenders, threads, &|stage, step| listener.stage(stage, step))
            .map_err(|error| failed(&candidates, &error))?;
        let answer = FitCompareAnswer::new(&netlists, candidates, choice);
        for (candidate, doubts) in answer.candidates.iter().zip(&answer.doubts) {
            listener.warn(&candidate.input.netlist.files, doubts);
        }
        Ok(answer)
    }
}

/// Names of the candidates: file, fit and settings, each if it differs.
fn names(found: &[(&CandidateNetlist, &FitStudy)]) -> Vec<String> {
    let stem = |path: &Path| {
        path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
    };
    let differ = |of: &dyn Fn(&(&CandidateNetlist, &FitStudy)) -> String| {
        found.iter().any(|one| of(one) != of(&found[0]))
    };
    let of_path = |one: &(&CandidateNetlist, &FitStudy)| one.0.path.display().to_string();
    let of_stem = |one: &(&CandidateNetlist, &FitStudy)| stem(&one.0.path);
    let (by_path, by_label) = (differ(&of_path), differ(&|one| one.0.label.clone()));
    let twice = |one: &(&CandidateNetlist, &FitStudy)| {
        let mut others = found.iter().filter(|other| of_stem(other) == of_stem(one));
        others.any(|other| other.0.path != one.0.path)
    };
    let several = |one: &(&CandidateNetlist, &FitStudy)| {
        found.iter().filter(|other| std::ptr::eq(other.0, one.0)).count() > 1
    };
    let name = |one: &(&CandidateNetlist, &FitStudy)| {
        let file = if twice(one) { of_path(one) } else { of_stem(one) };
        let parts = [
            (by_path, file),
            (several(one) || !(by_path || by_label), one.1.name.clone()),
            (by_label, one.0.label.clone()),
        ];
        let parts: Vec<String> =
            parts.into_iter().filter(|(tells, _)| *tells).map(|(_, part)| part).collect();
        plain(&parts.join(", "))
    };
    found.iter().map(name).collect()
}

/// A failure at the fit that caused it.
fn failed(candidates: &[Candidate], error: &ChoiceError) -> Failure {
    let one = error.contender().and_then(|name| candidates.iter().find(|one| one.name == name));
    match one {
        Some(one) => one.input.failure(error, Some(one.study.span.clone())),
        None => Failure::new(error.class().into(), told(error)),
    }
}

impl FitCompareAnswer {
    fn new(netlists: &[Arc<Input>], candidates: Vec<Candidate>, choice: Choice) -> Self {
        let both = candidates.iter().zip(&choice.contenders);
        let fit = |(one, judged): (&Candidate, &Judged)| {
            let of = (Arc::clone(&one.input), one.study.clone());
            FitNetworkAnswer::new(of, judged.task.clone(), judged.fit.clone())
        };
        let fits: Vec<FitNetworkAnswer> = both.map(fit).collect();
        let (doubts, gathered) = (Vec::new(), Gathered::default());
        let mut answer = Self { candidates, choice, fits, doubts, gathered };
        answer.doubts = (0..answer.fits.len()).map(|i| answer.doubts_of(i)).collect();
        for input in netlists {
            answer.gathered.add(&input.netlist.files, &input.netlist.warnings);
        }
        for (one, doubts) in answer.candidates.iter().zip(&answer.doubts) {
            answer.gathered.add(&one.input.netlist.files, doubts);
        }
        answer
    }

    /// Doubts of one candidate: those of its fit and of its held-out predictions.
    /// Misfits of a worse candidate are left out: they are expected. So is slow drift: the width of
    /// the intervals shows it.
    fn doubts_of(&self, i: usize) -> Vec<Diagnostic> {
        let name = &self.candidates[i].name;
        let named = |doubt: Diagnostic| Diagnostic {
            message: format!("{name}: {}", doubt.message),
            ..doubt
        };
        let worse = self.choice.is_told(i);
        let matters = |doubt: &Diagnostic| match doubt.code {
            "fit::misfit" | "fit::records_differ" => !worse,
            code => code != "fit::slow_drift",
        };
        let of_fit = doubts(&self.fits[i]).into_iter().filter(matters).map(named);
        of_fit.chain(words::doubts(self, i)).collect()
    }
}
