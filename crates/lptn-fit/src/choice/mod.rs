//! Which of several networks records speak for.
//!
//! More parameters always come nearer to a record. Whether they describe the machine or what was
//! by chance in its records shows in records that they have not seen: every network is fitted anew
//! without each of the records, and says the one that was left out. A network is taken only if it
//! does this better than the others, by a paired test over the records; of a single record it is the
//! last third that is left out.
//!
//! Beside that stands Akaike's criterion with the correction of C. M. Hurvich and C.-L. Tsai
//! (Biometrika 76 (1989) 297), from the likelihood of the means of stretches with noise that need
//! not be independent ([`crate::noise`]); stretches are as long for all networks, so that it is the
//! same data whose likelihood is compared. Whether what is left over is white is tested after G. M.
//! Ljung and G. E. P. Box (Biometrika 65 (1978) 297).
//!
//! The criterion has no vote if there are several records. With correlated noise a likelihood is
//! only as good as the model of the noise, and a wrong network makes its own noise. The number of
//! rows determines the length of the stretches, not the derivatives. Otherwise the likelihoods
//! would be of different data. The noise of each column is fitted to the residuals as they are.
//! Projecting out derivatives would let each column move the shared parameters.
//!
//! Fits without a record begin at the end of the fit to all, and skip errors and profiles
//! (`network/predict.rs`). The score of a record is the logarithm of its misfit; a mean of squares
//! would be dominated by the hottest record.

mod error;
mod likelihood;
mod paired;
mod same;
mod unseen;

pub use error::ChoiceError;
pub use likelihood::{LAGS, Likely, Whiteness};
pub use paired::Behind;
pub use unseen::{Held, UnseenRecord};

use std::fmt;

use lptn_solve::{Proceed, Progress, in_parallel};

use crate::network::{FitStage, NetworkFit, NetworkFitTask, fit_network_observed};

/// By so much Akaike's criterion has to be lower where a single record cannot be tested: the other
/// network is then 1/20 as likely.
pub const MARGIN: f64 = 6.0;

/// A network that may be the one, and what it is fitted to.
#[derive(Clone, Debug)]
pub struct Contender {
    /// What it is called.
    pub name: String,
    /// Its fit.
    pub task: NetworkFitTask,
}

/// How far a choice is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChoiceStage<'a> {
    /// The network that is fitted.
    pub contender: &'a str,
    /// The record that it does not see, from 1, and how many there are; `None` where it sees all.
    pub without: Option<(usize, usize)>,
    /// How far that fit is.
    pub fit: FitStage,
}

impl fmt::Display for ChoiceStage<'_> {
    /// `two_nodes without record 3 of 14, search 1 of 1, round 2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.without {
            Some((record, of)) if of > 1 => {
                write!(f, "{} without record {record} of {of}, {}", self.contender, self.fit)
            }
            _ => write!(f, "{}, {}", self.contender, self.fit),
        }
    }
}

/// Is called after every step of every run, on its thread, and may interrupt the choice.
pub type ChoiceObserver<'a> = dyn Fn(&ChoiceStage<'_>, Progress) -> Proceed + Sync + 'a;

/// What records say of several networks.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The networks, in the order in which they were given.
    pub contenders: Vec<Judged>,
    /// What was left out of the fits.
    pub held: Held,
    /// The network that says best what it has not seen.
    pub best: usize,
}

/// A network, and how it fares.
#[derive(Clone, Debug)]
pub struct Judged {
    /// What it is called.
    pub name: String,
    /// Its task, with records and columns in the order of the first network.
    pub task: NetworkFitTask,
    /// Its fit to all records; one without a minimum is never the best.
    pub fit: NetworkFit,
    /// How likely the records are with it.
    pub likely: Likely,
    /// Its share of likelihood among the networks, by Akaike's criterion; `None` where there are
    /// too few values for that.
    pub weight: Option<f64>,
    /// Whether what is left over of each column is white.
    pub whiteness: Vec<Option<Whiteness>>,
    /// How it says each record that it has not seen.
    pub unseen: Vec<UnseenRecord>,
    /// How far behind the best it is in that; `None` for the best.
    pub behind: Option<Behind>,
    /// Where it differs most from the best; `None` for the best.
    pub apart: Option<Apart>,
}

/// Where two networks differ most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Place of the record.
    pub run: usize,
    /// Place of the column in the record.
    pub column: usize,
    /// When, in s.
    pub time: f64,
    /// By how much, in the SI unit of the column.
    pub by: f64,
}

impl Choice {
    /// The networks that the records do not tell from the best, in the order given.
    pub fn rivals(&self) -> Vec<usize> {
        let told = |i: &usize| self.is_told(*i);
        (0..self.contenders.len()).filter(|i| *i != self.best && !told(i)).collect()
    }

    /// Whether the records tell a network from the best: it says unseen records worse with 95 %
    /// confidence; the rest of a single record worse, with a criterion that is higher by [`MARGIN`].
    ///
    /// A network whose fit has no minimum is out.
    pub fn is_told(&self, i: usize) -> bool {
        let (judged, best) = (&self.contenders[i], &self.contenders[self.best]);
        if judged.fit.not_converged.is_some() {
            return i != self.best;
        }
        let Some(behind) = &judged.behind else { return false };
        match (behind.interval, judged.likely.aicc, best.likely.aicc) {
            (Some((low, _)), _, _) => low > 1.0,
            (None, Some(own), Some(least)) => behind.ratio > 1.0 && own - least >= MARGIN,
            (None, _, _) => false,
        }
    }

    /// Of the best and what is not told from it the one with the fewest unknowns, the best among
    /// equals.
    pub fn simplest(&self) -> usize {
        let count = |i: &usize| self.contenders[*i].likely.unknowns;
        std::iter::once(self.best).chain(self.rivals()).min_by_key(count).unwrap_or(self.best)
    }

    /// The network with the lowest criterion, if it is lower than that of the best by [`MARGIN`].
    pub fn likeliest_instead(&self) -> Option<usize> {
        let aicc = |i: usize| self.contenders[i].likely.aicc;
        let own = aicc(self.best)?;
        let with_minimum = |i: &usize| self.contenders[*i].fit.not_converged.is_none();
        let all = (0..self.contenders.len()).filter(with_minimum);
        let all = all.filter_map(|i| Some((i, aicc(i)?)));
        let (i, least) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (own - least >= MARGIN).then_some(i)
    }
}

/// Fits every network with and without parts of the records, and compares what they say.
///
/// # Errors
/// [`ChoiceError`]: networks that are not fitted to the same values, too little to leave out, and a
/// fit that fails.
pub fn choose(
    contenders: &[Contender],
    threads: usize,
    observer: &ChoiceObserver<'_>,
) -> Result<Choice, ChoiceError> {
    let contenders = same::aligned(contenders)?;
    let held = Held::of(&contenders)?;
    let each = |task: &NetworkFitTask, jobs: usize| (threads / jobs.max(1)).clamp(1, task.threads);
    let fits = in_parallel(&contenders, threads, |one| {
        fit(one, each(&one.task, contenders.len()), observer)
    });
    let fits: Vec<NetworkFit> = fits.into_iter().collect::<Result<_, _>>()?;
    let parts = held.parts(&contenders[0]);
    let jobs: Vec<(usize, usize)> =
        (0..contenders.len()).flat_map(|i| (0..parts).map(move |part| (i, part))).collect();
    let unseen = in_parallel(&jobs, threads, |&(i, part)| {
        let threads = each(&contenders[i].task, jobs.len());
        held.predict((&contenders[i], &fits[i]), (part, threads), observer)
    });
    let mut unseen = unseen.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter();
    let judged = contenders.iter().zip(fits).map(|(one, fit)| Judged {
        name: one.name.clone(),
        task: one.task.clone(),
        likely: Likely::of(&one.task, &fit),
        weight: None,
        whiteness: likelihood::whiteness(&one.task, &fit),
        unseen: unseen.by_ref().take(parts).collect(),
        behind: None,
        apart: None,
        fit,
    });
    let mut judged: Vec<Judged> = judged.collect();
    let best = paired::best(&judged);
    if let Some(stop) = &judged[best].fit.not_converged {
        let (contender, why) = (judged[best].name.clone(), stop.text().to_string());
        return Err(ChoiceError::NotConverged { contender, why });
    }
    compare(&mut judged, best, &contenders[0].task);
    Ok(Choice { contenders: judged, held, best })
}

fn fit(
    one: &Contender,
    threads: usize,
    observer: &ChoiceObserver<'_>,
) -> Result<NetworkFit, ChoiceError> {
    let task = NetworkFitTask { threads, ..one.task.clone() };
    let watch = |fit: FitStage, step: Progress| {
        observer(&ChoiceStage { contender: &one.name, without: None, fit }, step)
    };
    let failed = |error| ChoiceError::of_fit(&one.name, None, error);
    fit_network_observed(&task, &watch).map_err(failed)
}

/// What each network is beside the others.
fn compare(judged: &mut [Judged], best: usize, task: &NetworkFitTask) {
    let weights = likelihood::weights(judged);
    let behind: Vec<Behind> =
        judged.iter().map(|one| Behind::of(&one.unseen, &judged[best].unseen)).collect();
    let apart: Vec<Option<Apart>> =
        judged.iter().map(|one| apart(task, &one.fit, &judged[best].fit)).collect();
    for (i, ((one, behind), apart)) in judged.iter_mut().zip(behind).zip(apart).enumerate() {
        one.weight = weights[i];
        if i != best {
            (one.behind, one.apart) = (Some(behind), apart);
        }
    }
}

/// Where two fits to the same records differ most.
fn apart(task: &NetworkFitTask, a: &NetworkFit, b: &NetworkFit) -> Option<Apart> {
    let columns = a.columns.iter().zip(&b.columns).flat_map(|(a, b)| {
        let both = a.modelled.iter().zip(&b.modelled);
        both.zip(&task.runs[a.run].times).map(move |((x, y), &time)| {
            let (run, column) = (a.run, a.column);
            Apart { run, column, time, by: (x - y).abs() }
        })
    });
    let size = |one: &Apart| one.by / task.runs[one.run].columns[one.column].weight();
    columns.max_by(|a, b| size(a).total_cmp(&size(b)))
}
