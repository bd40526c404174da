//! Choosing parts from catalogues: of all combinations the best that keeps everything, with what is
//! varied beside the parts sized for each.
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

/// More combinations than these are refused.
const MOST: usize = 1_000_000;

/// And more than these where each has to be solved before it is known what it costs.
const MOST_SOLVED: usize = 10_000;

/// So many are judged before it is asked whether more have to be: the same ones whatever the number
/// of threads.
const BLOCK: usize = 32;

/// So many that keep everything are looked for behind the best one.
const RUNNERS_UP: usize = 3;

/// All of so many combinations are judged, whatever the best one is.
const ALL: usize = 200;

/// Parts to choose from: the parameters that one sets, and for each part their values in SI units.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The parameters.
    pub parameters: Vec<ParameterId>,
    /// Their values, part by part.
    pub values: Vec<Vec<f64>>,
}

/// What is to be chosen.
#[derive(Clone, Debug)]
pub struct ChoiceTask<'a> {
    /// What has to be kept.
    pub demand: Demand<'a>,
    /// What the best choice has least or most of.
    pub aim: Aim<'a>,
    /// Of each one part is chosen; at least one.
    pub catalogues: &'a [Parts],
    /// The parameters that are sized for each choice, and the least and largest value that each may
    /// take, in SI units.
    pub varied: &'a [(ParameterId, (f64, f64))],
    /// How many threads may work; the result is the same.
    pub threads: usize,
}

/// One part of each catalogue.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The position of the part in each catalogue.
    pub parts: Vec<usize>,
    /// What the parts set, then what was sized, in SI units; only the former where it failed.
    pub values: Vec<f64>,
    /// What is sought, in SI units; NaN where that is not known, since it failed.
    pub objective: f64,
    /// What came of it, or why it could not be judged.
    pub judged: Result<Judged, SizeError>,
}

impl Choice {
    /// Whether it is known to keep everything.
    pub fn keeps(&self) -> bool {
        self.judged.as_ref().is_ok_and(Judged::keeps)
    }

    /// How far each requirement is from being broken; none where it could not be judged.
    pub fn margins(&self) -> &[f64] {
        self.judged.as_ref().map_or(&[], |judged| &judged.margins)
    }
}

/// What came of choosing.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Those that were judged. Of given parts the best comes first by what is sought; where something
    /// is sized, what keeps everything comes before what does not. Of equals the first of the file.
    pub judged: Vec<Choice>,
    /// The best one that keeps everything, by its position among them.
    pub best: Option<usize>,
    /// How many combinations there are.
    pub count: usize,
    /// How many networks were solved.
    pub solved: usize,
}

/// Judges combinations of parts, those that are better by what is sought first, until the best that
/// keeps everything and some behind it are known; all, if they are few, none keeps it, or each has to
/// be solved before it is known what it costs.
///
/// # Errors
/// [`SizeError`] if no combination can be judged, one is no network, or there are too many. One
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
    Ok(Choices { judged, best, count, solved: solved + designs.judge.count() })
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

/// All combinations, the best first by what is sought, where that is known beforehand.
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

/// What was solved: by what is sought, those whose costs are not known last; where something is sized,
/// what keeps everything first, for what does not has no cost.
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

/// One combination, and how many networks were solved for it beside those of `designs`.
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

/// Whether a combination has no answer of its own, which says nothing of the others.
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

/// A look, and a better one where that does not tell whether something is kept.
fn judge(designs: &Designs<'_>, values: &[f64]) -> Result<Design, SizeError> {
    let look = designs.judge(values, Care::Look)?;
    let error = look.judged.error;
    let clear = look.judged.margins.iter().all(|margin| margin.abs() > error);
    if clear { Ok(look) } else { designs.judge(values, Care::Proof) }
}

/// The best values of what is varied, beside these of the parts.
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
