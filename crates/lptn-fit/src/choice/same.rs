//! Check that all networks are fitted to the same values.

use crate::choice::Contender;
use crate::choice::error::ChoiceError;
use crate::network::{MeasuredColumn, MeasuredRun};

/// The networks with the records and columns of each in the order of the first.
pub(crate) fn aligned(contenders: &[Contender]) -> Result<Vec<Contender>, ChoiceError> {
    let [first, others @ ..] = contenders else { return Err(ChoiceError::Alone) };
    if others.is_empty() {
        return Err(ChoiceError::Alone);
    }
    let mut all = vec![first.clone()];
    for other in others {
        all.push(in_order_of(first, other)?);
    }
    Ok(all)
}

fn in_order_of(first: &Contender, other: &Contender) -> Result<Contender, ChoiceError> {
    let mut left = other.task.runs.clone();
    let mut runs = Vec::with_capacity(left.len());
    for run in &first.task.runs {
        let same = left.iter().position(|candidate| columns(run, candidate).is_ok());
        let Some(place) = same else { return Err(differing((first, run), (other, &left))) };
        let mut found = left.remove(place);
        let order = columns(run, &found).unwrap_or_default();
        found.columns = order.into_iter().map(|place| found.columns[place].clone()).collect();
        runs.push(found);
    }
    if let Some(more) = left.first() {
        let (one, other) = (other.name.clone(), first.name.clone());
        return Err(ChoiceError::Records { one, other, record: more.name.clone() });
    }
    weighed_alike((first, &first.task.runs), (&other.name, &runs))?;
    let task = crate::network::NetworkFitTask { runs, ..other.task.clone() };
    Ok(Contender { name: other.name.clone(), task })
}

/// Index of each column in another record with the same values, or the name of a column that only
/// one of them has.
fn columns(run: &MeasuredRun, other: &MeasuredRun) -> Result<Vec<usize>, String> {
    let name =
        |columns: &[MeasuredColumn]| columns.first().map_or(String::new(), |c| c.name.clone());
    if !equal(&run.times, &other.times) {
        return Err(name(&run.columns));
    }
    let same =
        |a: &MeasuredColumn, b: &MeasuredColumn| a.name == b.name && equal(&a.values, &b.values);
    let place = |column: &MeasuredColumn| {
        let place = other.columns.iter().position(|candidate| same(column, candidate));
        place.ok_or_else(|| column.name.clone())
    };
    let places: Vec<usize> = run.columns.iter().map(place).collect::<Result<_, _>>()?;
    match (0..other.columns.len()).find(|place| !places.contains(place)) {
        Some(more) => Err(other.columns[more].name.clone()),
        None => Ok(places),
    }
}

fn equal(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// The error for a record of the first network that the other one reads differently.
fn differing(
    (first, run): (&Contender, &MeasuredRun),
    (other, left): (&Contender, &[MeasuredRun]),
) -> ChoiceError {
    let names = (first.name.clone(), other.name.clone());
    let Some(theirs) = left.iter().find(|theirs| theirs.name == run.name) else {
        return ChoiceError::Records { one: names.0, other: names.1, record: run.name.clone() };
    };
    let column = columns(run, theirs).err().unwrap_or_default();
    let has = |run: &MeasuredRun| run.columns.iter().any(|own| own.name == column);
    let (one, other) = if has(run) { names } else { (names.1, names.0) };
    ChoiceError::Columns { one, other, record: run.name.clone(), column }
}

/// Checks that a value has the same weight with both networks.
fn weighed_alike(
    (first, of_first): (&Contender, &[MeasuredRun]),
    (other, of_other): (&str, &[MeasuredRun]),
) -> Result<(), ChoiceError> {
    let columns = |runs: &'_ [MeasuredRun]| -> Vec<MeasuredColumn> {
        runs.iter().flat_map(|run| run.columns.clone()).collect()
    };
    let (a, b) = (columns(of_first), columns(of_other));
    let unlike = |(a, b): &(MeasuredColumn, MeasuredColumn)| {
        (a.weight() - b.weight()).abs() > 1e-9 * a.weight()
    };
    match a.into_iter().zip(b).find(unlike) {
        Some((a, b)) => Err(ChoiceError::Sigma {
            one: first.name.clone(),
            other: other.to_owned(),
            column: a.name.clone(),
            sigmas: [a.weight(), b.weight()],
            unit: a.ty.dimension.si_unit(),
        }),
        None => Ok(()),
    }
}
