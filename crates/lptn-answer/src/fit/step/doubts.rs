//! Warnings about a fit in addition to its numbers.

use lptn_fit::step::{LONG_ENOUGH, StepError, StepFit, TwoExponentials};
use lptn_netlist::{Diagnostic, RecordColumn};
use lptn_report::{duration, significant};
use lptn_units::Problem as _;

use super::estimate::with_error;
use super::request::{Reference, Request};
use super::{StepColumn, shown};
use crate::exit::Exit;
use crate::failure::told;

/// The warnings about a column's fit.
pub(super) fn of(request: &Request, column: &StepColumn) -> Vec<Diagnostic> {
    let name = &column.column.name;
    let at = |problem: Diagnostic| problem.at(column.column.span.clone(), "");
    let fit = &column.fit;
    let mut warnings = Vec::new();
    if fit.extrapolates() {
        warnings.push(at(short(name, fit)));
    }
    if let Some(problem) = cut(request, column) {
        warnings.push(at(problem));
    }
    if let Some(problem) = cooling(request, column) {
        warnings.push(at(problem));
    }
    if let Some(start) = fit.still_until {
        warnings.push(at(late(name, start)));
    } else if let Some(two) = &fit.second.offer {
        warnings.push(at(second(name, two, request)));
    }
    if fit.coarse {
        let step = significant(fit.resolution.unwrap_or(f64::NAN), 3);
        let message = format!(
            "column `{name}`: the residual is the rounding of the logger to {step} K, which does \
             not average out"
        );
        let help = "the 95 % intervals contain the true value less often: in 86 of 100 records \
            with a step of five deviations of slow noise";
        warnings.push(at(Diagnostic::warning("fit::coarse", message)).help(help));
    }
    // if the visible noise is slow itself, its interval is hardly wider
    if fit.noise.drifts() && fit.tau.half_width > WIDE * fit.tau.standard_error {
        warnings.push(at(drifting(name, fit)));
    }
    let drift = column.power.drift;
    if drift.abs() > 0.05 * column.power.rise.value.abs() {
        let message = format!(
            "the reference `{}` changes by {} K over the record, and its mean is used",
            column.power.reference,
            significant(drift, 3)
        );
        let help =
            "a bed that warms is a node of the network: `lptn fit network` can fit it as one";
        warnings.push(at(Diagnostic::warning("fit::drift", message)).help(help));
    }
    warnings
}

/// Wider intervals, in standard errors to each side, are reported: many samples have two.
const WIDE: f64 = 2.5;

/// Warning that the intervals include a drift as slow as the record.
fn drifting(name: &str, fit: &StepFit) -> Diagnostic {
    let message = format!(
        "column `{name}`: the data cannot exclude a drift as slow as the record; the 95 % interval \
         of t_RC includes it and is ± {} standard errors",
        significant(fit.tau.half_width / fit.tau.standard_error, 2)
    );
    let help = "one record cannot separate such a drift from the response: add a sensor at a \
        constant temperature, or a second record";
    Diagnostic::warning("fit::slow_drift", message).help(help)
}

/// Warning that the end of the curve is not in the record.
fn short(name: &str, fit: &StepFit) -> Diagnostic {
    let lengths = significant(fit.time_constants(), 3);
    let several = if lengths == "1" { "" } else { "s" };
    let message = format!(
        "column `{name}`: T_f is extrapolated by {} K: the record is {lengths} time \
         constant{several} long",
        significant(fit.beyond.abs(), 3)
    );
    let long = duration(LONG_ENOUGH * fit.tau.value, 3);
    let help = format!(
        "measure for {LONG_ENOUGH} time constants, {long}: no error includes the part that was not \
         measured"
    );
    Diagnostic::warning("fit::short", message).help(help)
}

/// Warning that dT is counted from the cut of the record.
fn cut(request: &Request, column: &StepColumn) -> Option<Diagnostic> {
    if request.reference != Reference::Initial || !request.is_cut() {
        return None;
    }
    let from = significant(request.record.time.first().copied().unwrap_or(f64::NAN), 6);
    let what =
        if request.capacity.is_some() { "P_disp is not the heat" } else { "is not the rise" };
    let message = format!(
        "column `{}`: dT is counted from the cut at {from} s, and {what} unless the step begins \
         there",
        column.column.name
    );
    let help = "count it from the temperature before the step: --reference \"25.5 degC\", or from \
        a COLUMN";
    Some(Diagnostic::warning("fit::cut", message).help(help))
}

/// Warning that a power is negative by more than its 95 % interval: dissipation never is.
fn cooling(request: &Request, column: &StepColumn) -> Option<Diagnostic> {
    let (name, fit, power) = (&column.column.name, &column.fit, &column.power.power);
    if request.capacity.is_none() || power.value + power.half_width >= 0.0 {
        return None;
    }
    if fit.settled.value < fit.initial.value {
        let message =
            format!("column `{name}`: the record cools: the negative P_disp is not a dissipation");
        let help = "a body that cools without heat has P = 0 and tends to its surroundings: T_f is \
            their temperature, and t_RC and R_eq are valid";
        return Some(Diagnostic::warning("fit::cooling", message).help(help));
    }
    let message = format!(
        "column `{name}`: T_f is below the reference: the negative P_disp is not a dissipation"
    );
    let help = "--reference is the temperature of the column without heat";
    Some(Diagnostic::warning("fit::cooling", message).help(help))
}

/// The offer of a second exponential.
fn second(name: &str, two: &TwoExponentials, request: &Request) -> Diagnostic {
    let (settled, unit) = (request.unit.from_si(two.settled.value), &request.unit);
    let error = two.settled.standard_error / unit.scale;
    let part = |k: usize| {
        let (amplitude, tau) = (&two.amplitudes[k], &two.taus[k]);
        format!(
            "{} K exp(-t / ({} s))",
            shown(amplitude.value, amplitude.standard_error),
            with_error(tau.value, tau.standard_error)
        )
    };
    let message = format!("column `{name}`: the residuals need a second exponential");
    Diagnostic::warning("fit::second_exponential", message).note(format!(
        "({}) {} + {} + {}, which misses {} K",
        with_error(settled, error),
        unit.text,
        part(0),
        part(1),
        significant(two.rms, 3)
    ))
}

/// Warning that the step begins after the record.
fn late(name: &str, start: f64) -> Diagnostic {
    let from = significant(start, 6);
    let message = format!("column `{name}` is constant until {from} s, but one exponential is not");
    let help = format!("begin with the step: --from \"{from} s\"");
    Diagnostic::warning("fit::late_start", message).help(help)
}

/// Time in s at which a column turns back by more than a third of its range: it heats, then cools.
fn turns(times: &[f64], values: &[f64]) -> Option<f64> {
    let known: Vec<(f64, f64)> = times
        .iter()
        .zip(values)
        .filter(|(_, value)| !value.is_nan())
        .map(|(time, value)| (*time, *value))
        .collect();
    let (first, last) = (known.first()?.1, known.last()?.1);
    let highest = known.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let lowest = known.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let range = highest.1 - lowest.1;
    let turn = |far: f64| 3.0 * (far - first).abs().min((far - last).abs()) > range;
    [highest, lowest].into_iter().find(|extreme| turn(extreme.1)).map(|extreme| extreme.0)
}

/// Why a column has no fit, and how the command ends.
pub(super) fn failed(
    request: &Request,
    column: &RecordColumn,
    error: &StepError,
) -> (Exit, Diagnostic) {
    let message = format!("column `{}`: {error}", column.name);
    let problem = Diagnostic { message, ..told(error) }.at(column.span.clone(), "");
    let options = match error {
        StepError::Saturated { from, to, .. } => {
            Some(format!("leave it out, with --to \"{from} s\" or --from \"{to} s\""))
        }
        StepError::Fit(_) | StepError::Undetermined { .. } => {
            turns(&request.record.time, &column.values).map(|at| {
                let at = significant(at, 6);
                format!(
                    "it turns back at {at} s, and one step does not: fit one part of it, with \
                     --to \"{at} s\" or --from \"{at} s\""
                )
            })
        }
        _ => None,
    };
    (error.class().into(), problem.help(options))
}
