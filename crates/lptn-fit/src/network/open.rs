//! Searches that are lost along directions that the records do not determine.
//!
//! Along an open direction the sum of squares falls by errors of the runs, so a search may go on
//! until there is no run, or find no step at all. So many of the parameters are then fixed at their
//! start that the others are determined, and these are searched again. The result is an answer if
//! the sum of squares is not larger than at the end of the first search, and the records leave a
//! direction open there too.
//!
//! A ridge would move every fit a little. Fixed parameters change nothing if the first search
//! converged. A lag moves straight from 0 for the same reason: its logarithm has no end.

use crate::least_squares::{LeastSquaresFit, Residuals, minimise};
use crate::network::apart::{DIFFERENCES, told_apart};
use crate::network::coordinates::Coordinates;
use crate::network::error::NetworkFitError;
use crate::network::holding::Holding;
use crate::network::identify::Identifiability;
use crate::network::search::{Found, SAME, exactly, outcome};
use crate::network::task::NetworkFitTask;
use crate::network::unknown::Unknown;

/// Identifiability by the records at values in SI units, from [`told_apart`].
type ToldApart<'t, 'a> = dyn Fn(&mut Found<'a>, &[f64]) -> Option<Identifiability> + 't;

/// The same if the first search converged; otherwise the result with the open parameters fixed.
pub(crate) fn settled<'a>(
    mut found: Found<'a>,
    (task, unknowns, coordinates): (&NetworkFitTask, &[Unknown], &Coordinates),
    own: &[f64],
) -> Result<Found<'a>, NetworkFitError> {
    if found.outcome.is_ok() {
        return Ok(found);
    }
    let before = found.accuracy;
    // differences of runs by an instrument that changes them cannot resolve such a small slope
    found.accuracy = if found.exact { before } else { DIFFERENCES };
    let told = |found: &mut Found<'a>, values: &[f64]| {
        let at = found.model.at(values).ok()?.clone();
        told_apart((task, unknowns), (&at, found.accuracy), &mut found.model)
    };
    let (lost, _) = coordinates.values(&found.estimate.parameters);
    for at in [own, &lost] {
        let Some(known) = told(&mut found, at).filter(|known| !known.is_whole()) else { continue };
        let held = held(&known);
        if held.len() == own.len() {
            continue;
        }
        if let Some(estimate) = searched(&mut found, (coordinates, own), (&held, &told))? {
            (found.estimate, found.outcome) = (estimate, Ok(()));
            return Ok(found);
        }
    }
    found.accuracy = before;
    Ok(found)
}

/// Parameters that would leave nothing open if they were known.
fn held(known: &Identifiability) -> Vec<usize> {
    let mut held = known.unfelt.clone();
    held.extend(known.unseparated.iter().flat_map(|group| group.held()));
    held.sort_unstable();
    held
}

/// The minimum with these parameters fixed, if it is as low as the end of the first search and
/// leaves something open.
fn searched<'a>(
    found: &mut Found<'a>,
    (coordinates, own): (&Coordinates, &[f64]),
    (held, told): (&[usize], &ToldApart<'_, 'a>),
) -> Result<Option<LeastSquaresFit>, NetworkFitError> {
    let (begin, floor) = (coordinates.of(own), found.model.error());
    let mut settings = exactly(coordinates, (found.gradient, floor));
    let places = held.iter().map(|&place| (place, begin[place])).collect();
    let mut holding = Holding { model: &mut found.model, held: places };
    settings.bounds = (0..own.len())
        .filter(|place| !held.contains(place))
        .map(|place| settings.bounds[place])
        .collect();
    let others = holding.others(&begin);
    let search = minimise(&mut holding, &others, &settings);
    let all = search.as_ref().map(|end| holding.all(&end.parameters)).unwrap_or_default();
    let end = search.map_err(|error| found.model.ended(error))?;
    let as_low = end.squares <= found.estimate.squares * (1.0 + SAME) + floor * floor;
    if outcome(&end, floor, found.exact).is_err() || !as_low {
        return Ok(None);
    }
    let (values, _) = coordinates.values(&all);
    let open = told(found, &values).is_some_and(|known| !known.is_whole());
    let (residuals, jacobian) =
        found.model.evaluate(&all, true).map_err(|error| found.model.ended(error))?;
    let mut on_bound = end.on_bound.clone();
    held.iter().for_each(|&place| on_bound.insert(place, None));
    let whole = LeastSquaresFit { parameters: all, on_bound, residuals, jacobian, ..end };
    Ok(open.then_some(whole))
}
