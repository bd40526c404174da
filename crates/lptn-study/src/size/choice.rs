//! Choosing parts from catalogues: the best of all combinations that keep every requirement, with
//! further parameters sized for each combination.
//!
//! Parts are judged in the order of their price, in blocks whose size does not depend on threads.
//! The first part that works is the answer, and the evaluated parts are the same on every machine.
//! If a price is known only after a solution (a part is sized, or the price contains results), all
//! parts are solved.

use lptn_network::ParameterId;
use lptn_solve::in_parallel;

use crate::size::aim::Aim;
use crate::size::design::{Design, Designs};
use crate::size::error::{SizeError, TrialError};
use crate::size::judge::{Care, Demand, Judged};
use crate::size::several::{SeveralTask, size_several};
use crate::size::shortfall::Shortfall;

/// More combinations than these are refused.
const MOST: usize = 1_000_000;

/// The same limit if each has to be solved before its cost is known.
const MOST_SOLVED: usize = 10_000;

/// Combinations judged before checking for an end: the same ones whatever the number of threads.
const BLOCK: usize = 32;

/// Combinations that keep everything and are searched after the best one.
const RUNNERS_UP: usize = 3;

/// Up to this number of combinations all are judged, whatever the best one is.
const ALL: usize = 200;

/// Parts to choose from: the parameters that one sets, and for each part their values in SI units.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The parameters.
    pub parameters: Vec<ParameterId>,
    /// Their values, part by part.
    pub values: Vec<Vec<f64>>,
}

/// A task of choosing parts.
#[derive(Clone, Debug)]
pub struct ChoiceTask<'a> {
    /// The requirements.
    pub demand: Demand<'a>,
    /// The objective of the best choice.
    pub aim: Aim<'a>,
    /// The catalogues; one part is chosen from each; at least one.
    pub catalogues: &'a [Parts],
    /// The parameters that are sized for each choice, and the least and largest value that each may
    /// take, in SI units.
    pub varied: &'a [(ParameterId, (f64, f64))],
    /// Number of threads; the result does not depend on it.
    pub threads: usize,
}

/// One part of each catalogue.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The position of the part in each catalogue.
    pub parts: Vec<usize>,
    /// Values of the parts, then the sized values, in SI units; only the former if it failed.
    pub values: Vec<f64>,
    /// The objective in SI units; NaN if it is not known, since the choice failed.
    pub objective: f64,
    /// The results, or why it could not be judged.
    pub judged: Result<Judged, SizeError>,
}

impl Choice {
    /// True if it is known to keep everything.
    pub fn keeps(&self) -> bool {
        self.judged.as_ref().is_ok_and(Judged::keeps)
    }

    /// The margin of each requirement; none if the choice could not be judged.
    pub fn margins(&self) -> &[f64] {
        self.judged.as_ref().map_or(&[], |judged| &judged.margins)
    }
}

/// The result of choosing.
#[derive(Clone, Debug)]
pub struct Choices {
    /// The judged combinations, the best objective first. If parameters are sized, combinations
    /// that keep everything come before the others. Equal ones are in the order of the file.
    pub judged: Vec<Choice>,
    /// The best one that keeps everything, by its position among them.
    pub best: Option<usize>,
    /// The measure of requirements that are broken.
    pub shortfall: Shortfall,
    /// Number of combinations.
    pub count: usize,
    /// Number of networks that were solved.
    pub solved: usize,
}

/// Judges combinations of parts in the order of the objective, the best first, until the best that
/// keeps everything and some after it are known. It judges all if they are few, if none keeps
/// everything, or if each has to be solved before its cost is known.
///
/// # Errors
/// [`SizeError`] if no combination can be judged, one is not a network, or there are too many. One
/// without an answer, such as a run that fails, is listed with its error.
pub fn choose(task: &ChoiceTask<'_>) -> Result<Choices, SizeError> {
    let sizes: Vec<usize> = task.catalogues.iter().map(|parts| parts.values.len()).collect();
    let count = sizes.iter().try_fold(1_usize, |all, size| all.checked_mul(*size));
    let known = task.varied.is_empty() && !task.aim.of_results;
    let most = if known { MOST } else { MOST_SOLVED };
    let count = count.filter(|count| *count <= most).ok_or(SizeError::TooMany { most })?;
    let parameters: Vec<ParameterId> =
        task.catalogues.iter().flat_map(|parts| parts.parameters.iter().copied()).collect();
    let designs = Designs::new(task.demand, task.aim, parameters)?;
    let all: Vec<Vec<usize>> = (0..count).map(|number| picks(&sizes, number)).collect();
    let (mut judged, mut solved) = (Vec::new(), 0);
    for block in in_order(task, &designs, (all, known))?.chunks(BLOCK) {
        let found = in_parallel(block, task.threads, |picks| one(task, &designs, picks));
        for choice in found {
            let (choice, networks) = choice?;
            judged.push(choice);
            solved += networks;
        }
        if known && count > ALL && judged.iter().filter(|c| c.keeps()).count() > RUNNERS_UP {
            break;
        }
    }
    if !known {
        sort(task, &mut judged);
    }
    if let Some(error) = judged.iter().map(|c| c.judged.as_ref().err()).collect::<Option<Vec<_>>>()
    {
        return Err(error[0].clone());
    }
    let best = judged.iter().position(Choice::keeps);
    let shortfall = Shortfall::of(&task.demand);
    Ok(Choices { judged, best, shortfall, count, solved: solved + designs.judge.count() })
}

/// The positions of a combination; the last catalogue changes fastest.
fn picks(sizes: &[usize], mut number: usize) -> Vec<usize> {
    let mut picks = vec![0; sizes.len()];
    for (pick, size) in picks.iter_mut().zip(sizes).rev() {
        (*pick, number) = (number % size, number / size);
    }
    picks
}

/// The values of the parts at these positions.
fn values(task: &ChoiceTask<'_>, picks: &[usize]) -> Vec<f64> {
    let of = task.catalogues.iter().zip(picks);
    of.flat_map(|(parts, &pick)| parts.values[pick].iter().copied()).collect()
}

/// All combinations, the best first by the objective if it is known in advance.
fn in_order(
    task: &ChoiceTask<'_>,
    designs: &Designs<'_>,
    (all, known): (Vec<Vec<usize>>, bool),
) -> Result<Vec<Vec<usize>>, SizeError> {
    if !known {
        return Ok(all);
    }
    let cost = |picks: Vec<usize>| {
        let objective = designs.objective(&values(task, &picks))?;
        Ok((designs.cost(objective), picks))
    };
    let mut all = all.into_iter().map(cost).collect::<Result<Vec<_>, SizeError>>()?;
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(all.into_iter().map(|(_, picks)| picks).collect())
}

/// Sorts solved choices by the objective, those without a cost last; if parameters are sized, those
/// that keep everything first, for the others have no cost.
fn sort(task: &ChoiceTask<'_>, judged: &mut [Choice]) {
    judged.sort_by(|a, b| {
        let fails = |choice: &Choice| !task.varied.is_empty() && !choice.keeps();
        let cost = |choice: &Choice| match choice.judged {
            Ok(_) => task.aim.cost(choice.objective),
            Err(_) => f64::INFINITY,
        };
        fails(a).cmp(&fails(b)).then(cost(a).total_cmp(&cost(b)))
    });
}

/// One combination, and the number of networks solved for it in addition to those of `designs`.
fn one(
    task: &ChoiceTask<'_>,
    designs: &Designs<'_>,
    picks: &[usize],
) -> Result<(Choice, usize), SizeError> {
    let values = values(task, picks);
    let found = match task.varied.is_empty() {
        true => judge(designs, &values).map(|design| (design, 0)),
        false => size(task, designs, &values),
    };
    let (design, solved) = match found {
        Ok((design, solved)) => (Ok(design), solved),
        Err(error) if is_no_answer(&error) => (Err(error), 0),
        Err(error) => return Err(error),
    };
    let parts = picks.to_vec();
    let choice = match design {
        Ok(Design { values, objective, judged }) => {
            Choice { parts, values, objective, judged: Ok(judged) }
        }
        Err(error) => {
            let known = task.varied.is_empty() && !task.aim.of_results;
            let objective = if known { designs.objective(&values)? } else { f64::NAN };
            Choice { parts, values, objective, judged: Err(error) }
        }
    };
    Ok((choice, solved))
}

/// True if this combination alone has no answer, which does not affect the others.
fn is_no_answer(error: &SizeError) -> bool {
    let SizeError::Trial { error, .. } = error else { return false };
    matches!(
        error.as_ref(),
        TrialError::Gears(_)
            | TrialError::Steady(_)
            | TrialError::Run(_)
            | TrialError::Periodic(_)
            | TrialError::Requirement { .. }
    )
}

/// A rough evaluation, and a better one if that does not show whether everything is kept.
fn judge(designs: &Designs<'_>, values: &[f64]) -> Result<Design, SizeError> {
    let look = designs.judge(values, Care::Look)?;
    let error = look.judged.error;
    let clear = look.judged.margins.iter().all(|margin| margin.abs() > error);
    if clear { Ok(look) } else { designs.judge(values, Care::Proof) }
}

/// The best values of the varied parameters, with these values of the parts.
fn size(
    task: &ChoiceTask<'_>,
    designs: &Designs<'_>,
    values: &[f64],
) -> Result<(Design, usize), SizeError> {
    let network = designs.network(values)?;
    let demand = Demand { network: &network, ..task.demand };
    let (aim, varied) = (task.aim, task.varied.to_vec());
    let found = size_several(&SeveralTask { demand, aim, varied, threads: 1 })?;
    let Design { values: sized, objective, judged } = found.design;
    let values = values.iter().copied().chain(sized).collect();
    Ok((Design { values, objective, judged }, found.solved))
}
