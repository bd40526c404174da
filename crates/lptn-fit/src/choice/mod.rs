//! Choice of the network that records favour.
//!
//! Additional parameters always reduce the residuals. Held-out records show if they describe the
//! machine or chance. Every network is fitted again without each record and predicts that record. A
//! network is taken only if a paired test over the records shows that it predicts better than the
//! others. For a single record, the last third is held out.
//!
//! A second measure is Akaike's criterion with the correction of C. M. Hurvich and C.-L. Tsai
//! (Biometrika 76 (1989) 297). Its likelihood is that of the means of stretches, with noise that
//! need not be independent ([`crate::noise`]). Stretches are equal for all networks, so the data
//! are the same. The test of residuals is that of G. M. Ljung and G. E. P. Box (Biometrika 65
//! (1978) 297).
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

/// Required difference of Akaike's criterion if a single record cannot be tested: the other network
/// is then 1/20 as likely.
pub const MARGIN: f64 = 6.0;

/// A candidate network and its fit.
#[derive(Clone, Debug)]
pub struct Contender {
    /// Name of the network.
    pub name: String,
    /// Task of its fit.
    pub task: NetworkFitTask,
}

/// Progress of a choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChoiceStage<'a> {
    /// The network that is being fitted.
    pub contender: &'a str,
    /// The held-out record, from 1, and the number of records; `None` for the fit to all.
    pub without: Option<(usize, usize)>,
    /// Progress of that fit.
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

/// Networks compared on records.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The networks, in the order in which they were given.
    pub contenders: Vec<Judged>,
    /// Data held out of the fits.
    pub held: Held,
    /// Index of the network that predicts held-out data best.
    pub best: usize,
}

/// A network and its results.
#[derive(Clone, Debug)]
pub struct Judged {
    /// Name of the network.
    pub name: String,
    /// Its task, with records and columns in the order of the first network.
    pub task: NetworkFitTask,
    /// Its fit to all records; one without a minimum is never the best.
    pub fit: NetworkFit,
    /// Likelihood of the records with it.
    pub likely: Likely,
    /// Its share of likelihood among the networks, by Akaike's criterion; `None` if there are too
    /// few values for that.
    pub weight: Option<f64>,
    /// Test of the residuals of each column for white noise.
    pub whiteness: Vec<Option<Whiteness>>,
    /// Its prediction of each held-out record.
    pub unseen: Vec<UnseenRecord>,
    /// Its held-out residuals relative to those of the best network; `None` for the best.
    pub behind: Option<Behind>,
    /// Largest difference from the best network; `None` for the best.
    pub apart: Option<Apart>,
}

/// Largest difference between two networks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Index of the record.
    pub run: usize,
    /// Index of the column in the record.
    pub column: usize,
    /// Time in s.
    pub time: f64,
    /// Absolute difference in the SI unit of the column.
    pub by: f64,
}

impl Choice {
    /// The networks that the records do not distinguish from the best, in the order given.
    pub fn rivals(&self) -> Vec<usize> {
        let told = |i: &usize| self.is_told(*i);
        (0..self.contenders.len()).filter(|i| *i != self.best && !told(i)).collect()
    }

    /// True if the records distinguish a network from the best. It predicts held-out records worse
    /// with 95 % confidence. For a single record, it predicts the rest worse and its criterion is
    /// higher by [`MARGIN`].
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

    /// The network with the fewest unknowns among the best and those not distinguished from it. The
    /// best comes first among equals.
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

/// Fits every network with and without parts of the records, and compares the predictions.
///
/// # Errors
/// [`ChoiceError`]: networks that are not fitted to the same values, too little data to hold out,
/// and a fit that fails.
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

/// Compares each network with the others.
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

/// Largest difference between two fits to the same records, relative to each column's weight.
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
