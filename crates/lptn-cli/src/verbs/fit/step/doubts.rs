//! What is to be said about a fit beside its numbers.

use lptn_fit::step::{LONG_ENOUGH, StepError, StepFit, TwoExponentials};
use lptn_netlist::{Diagnostic, RecordColumn};
use lptn_report::{duration, significant};
use lptn_units::Problem as _;

use super::estimate::with_error;
use super::request::{Reference, Request};
use super::{Column, shown};
use crate::exit::Exit;
use crate::failure::told;

/// The warnings about a column's fit.
pub(crate) fn of(request: &Request, column: &Column<'_>) -> Vec<Diagnostic> {
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
    if let Some(two) = &fit.second.offer {
        warnings.push(at(second(name, two, request)));
    }
    if fit.coarse {
        let step = significant(fit.resolution.unwrap_or(f64::NAN), 3);
        let message = format!(
            "column `{name}`: what the curve misses is the rounding of the logger to {step} K, \
             which does not average out"
        );
        let help = "the 95 % intervals hold the truth less often than they say: in 86 of 100 \
            records with a step of five deviations of slow noise";
        warnings.push(at(Diagnostic::warning("fit::coarse", message)).help(help));
    }
    // where the noise that is seen is slow itself, its own interval is hardly wider
    if fit.noise.drifts() && fit.tau.half_width > WIDE * fit.tau.standard_error {
        warnings.push(at(drifting(name, fit)));
    }
    let drift = column.power.drift;
    if drift.abs() > 0.05 * column.power.rise.value.abs() {
        let message = format!(
            "the reference `{}` changes by {} K over the record, and its mean is taken",
            column.power.reference,
            significant(drift, 3)
        );
        let help =
            "a bed that warms is a node of the network: `lptn fit network` can fit it as one";
        warnings.push(at(Diagnostic::warning("fit::drift", message)).help(help));
    }
    warnings
}

/// An interval of more standard errors to each side is worth a word: many samples have two.
const WIDE: f64 = 2.5;

/// That a drift as slow as the record is in the intervals.
fn drifting(name: &str, fit: &StepFit) -> Diagnostic {
    let message = format!(
        "column `{name}`: a drift as slow as the record is as likely as none: the 95 % \
         interval of t_RC counts it, and is {} standard errors wide to each side",
        significant(fit.tau.half_width / fit.tau.standard_error, 2)
    );
    let help = "one exponential takes such a drift up, and the record cannot tell it; a sensor \
        beside it whose temperature stays, or a second record, can";
    Diagnostic::warning("fit::slow_drift", message).help(help)
}

/// That the end of the curve is not in the record.
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
        "measure for {LONG_ENOUGH} time constants, {long}: what was not measured is in no error"
    );
    Diagnostic::warning("fit::short", message).help(help)
}

/// That dT is counted from where the record is cut.
fn cut(request: &Request, column: &Column<'_>) -> Option<Diagnostic> {
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
    let help = "count it from where the column was before the step: --reference \"25.5 degC\", or \
        from a COLUMN";
    Some(Diagnostic::warning("fit::cut", message).help(help))
}

/// That a power is negative by more than its noise: no part of a gearbox takes heat out of the
/// world.
fn cooling(request: &Request, column: &Column<'_>) -> Option<Diagnostic> {
    let (name, fit, power) = (&column.column.name, &column.fit, &column.power.power);
    if request.capacity.is_none() || power.value + power.half_width >= 0.0 {
        return None;
    }
    if fit.settled.value < fit.initial.value {
        let message =
            format!("column `{name}`: the record cools: the negative P_disp is no dissipation");
        let help = "what cools without heat has P = 0 and tends to its surroundings: T_f is their \
            temperature, and t_RC and R_eq hold";
        return Some(Diagnostic::warning("fit::cooling", message).help(help));
    }
    let message = format!(
        "column `{name}`: T_f is below the reference: the negative P_disp is no dissipation"
    );
    let help = "--reference is where the column would be without heat";
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
    let message = format!("column `{name}`: what the curve misses asks for a second exponential");
    Diagnostic::warning("fit::second_exponential", message).note(format!(
        "({}) {} + {} + {}, which misses {} K",
        with_error(settled, error),
        unit.text,
        part(0),
        part(1),
        significant(two.rms, 3)
    ))
}

/// Why a column has no fit, and how the command ends.
pub(crate) fn failed(column: &RecordColumn, error: &StepError) -> (Exit, Diagnostic) {
    let message = format!("column `{}`: {error}", column.name);
    let problem = Diagnostic { message, ..told(error) }.at(column.span.clone(), "");
    let options = match error {
        StepError::Saturated { from, to, .. } => {
            Some(format!("leave it out, with --to \"{from} s\" or --from \"{to} s\""))
        }
        _ => None,
    };
    (error.class().into(), problem.help(options))
}
