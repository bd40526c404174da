//! Gradients of a run by its adjoint.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{Functional, ParameterId, RunSettings};
use lptn_solve::{BackwardError, Proceed, Progress};

use crate::gradient::error::GradientError;
use crate::gradient::followed::{Followed, Gradients};

/// The gradients of results of a run: one way back in time for each result.
pub(super) fn gradients(
    (system, ids): (&ThermalSystem, &[ParameterId]),
    settings: &RunSettings,
    followed: &[Followed],
    observer: &dyn Fn(Progress) -> Proceed,
) -> Result<Gradients, GradientError> {
    let run = RunAnalysis::of(system.network(), settings).bare().with_trajectory();
    let solution = run.solve(system, &mut |progress| observer(progress))?;
    let mut found = Gradients::default();
    for one in followed {
        // the margin of a maximum is least there, as that of a minimum is
        let functional = match one.functional {
            Functional::Max => Functional::Min,
            other => other,
        };
        let slopes = solution.margin_gradient((one.limit, functional), ids, observer);
        let slopes = slopes.map_err(|error| match error {
            BackwardError::Tangents(why) => GradientError::Differences { why: why.to_string() },
            error => error.into(),
        })?;
        let by = slopes.by.iter().map(|slope| one.sign * slope).collect();
        found.add(one.sign * slopes.margin, by);
    }
    Ok(found)
}
