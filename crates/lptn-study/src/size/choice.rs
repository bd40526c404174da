//! Choosing parts from catalogues: of all combinations the best that keeps everything.

use lptn_network::ParameterId;
use lptn_solve::in_parallel;

use crate::size::design::{Aim, Design, Designs};
use crate::size::error::SizeError;
use crate::size::judge::{Care, Demand};

/// More combinations than these are refused.
const MOST: usize = 1_000_000;

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
    /// How many threads may work; the result is the same.
    pub threads: usize,
}

/// One part of each catalogue.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The position of the part in each catalogue.
    pub parts: Vec<usize>,
    /// What came of it.
    pub design: Design,
}

/// What came of choosing.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Those that were judged, the best first by what is sought; of equals the first of the file.
    pub judged: Vec<Choice>,
    /// The best one that keeps everything, by its position among them.
    pub best: Option<usize>,
    /// How many combinations there are.
    pub count: usize,
    /// How many networks were solved.
    pub solved: usize,
}

/// Judges combinations of parts, those that are better by what is sought first, until the best that
/// keeps everything and some behind it are known; all, if they are few or none keeps it.
///
/// # Errors
/// [`SizeError`] if a combination cannot be judged, or there are too many.
pub fn choose(task: &ChoiceTask<'_>) -> Result<Choices, SizeError> {
    let sizes: Vec<usize> = task.catalogues.iter().map(|parts| parts.values.len()).collect();
    let count = sizes.iter().try_fold(1_usize, |all, size| all.checked_mul(*size));
    let count = count.filter(|count| *count <= MOST).ok_or(SizeError::TooMany { most: MOST })?;
    let parameters =
        task.catalogues.iter().flat_map(|parts| parts.parameters.iter().copied()).collect();
    let designs = Designs::new(task.demand, task.aim, parameters)?;
    let ranked = ranked(task, &designs, (&sizes, count))?;
    let mut judged: Vec<Choice> = Vec::new();
    for block in ranked.chunks(BLOCK) {
        let found = in_parallel(block, task.threads, |picks| judge(task, &designs, picks));
        for choice in found {
            judged.push(choice?);
        }
        let kept = judged.iter().filter(|choice| choice.design.judged.keeps()).count();
        if kept > RUNNERS_UP && count > ALL {
            break;
        }
    }
    let best = judged.iter().position(|choice| choice.design.judged.keeps());
    Ok(Choices { judged, best, count, solved: designs.judge.count() })
}

/// The values of the parts at these positions.
fn values(task: &ChoiceTask<'_>, picks: &[usize]) -> Vec<f64> {
    let of = task.catalogues.iter().zip(picks);
    of.flat_map(|(parts, &pick)| parts.values[pick].iter().copied()).collect()
}

/// All combinations, the best first by what is sought.
fn ranked(
    task: &ChoiceTask<'_>,
    designs: &Designs<'_>,
    (sizes, count): (&[usize], usize),
) -> Result<Vec<Vec<usize>>, SizeError> {
    let mut all = Vec::with_capacity(count);
    for mut number in 0..count {
        // the last catalogue changes fastest
        let mut picks = vec![0; sizes.len()];
        for (pick, size) in picks.iter_mut().zip(sizes).rev() {
            (*pick, number) = (number % size, number / size);
        }
        let objective = designs.objective(&values(task, &picks))?;
        all.push((designs.cost(objective), picks));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(all.into_iter().map(|(_, picks)| picks).collect())
}

/// A look, and a better one where that does not tell whether something is kept.
fn judge(
    task: &ChoiceTask<'_>,
    designs: &Designs<'_>,
    picks: &[usize],
) -> Result<Choice, SizeError> {
    let values = values(task, picks);
    let look = designs.judge(&values, Care::Look)?;
    let error = look.judged.error;
    let clear = look.judged.margins.iter().all(|margin| margin.abs() > error);
    let design = if clear { look } else { designs.judge(&values, Care::Proof)? };
    Ok(Choice { parts: picks.to_vec(), design })
}
