//! Warnings that a study takes parameters as exact although the netlist gives them a `±`.

use lptn_fit::network::design::{Design, DesignTask};
use lptn_fit::network::{MeasuredRun, Moved, NetworkFit, NetworkFitTask, Off};
use lptn_netlist::{Diagnostic, FitStudy, PlanStudy};
use lptn_report::significant;
use lptn_units::Unit;

use crate::input::Input;
use crate::unseparated::{Named, joined};
use crate::words::{difference, spaced};

/// Least effect that is reported, as a share of an error or of an allowed error.
/// A smaller one makes the two together at most half a percent larger.
const MATTERS: f64 = 0.1;

/// A fixed parameter whose `±` matters.
struct Matters<'o> {
    off: &'o Off,
    /// The unknown that it moves furthest: its index, the change, and the change over its error.
    most: Option<(usize, f64, f64)>,
}

impl<'o> Matters<'o> {
    /// `errors` are those of the unknowns; if none of them is known, the effect on rows counts.
    fn of((off, moved): (&'o Off, &Moved), errors: &dyn Fn(usize) -> Option<f64>) -> Option<Self> {
        let one = |i: usize| {
            let by = moved.by[i]?.abs();
            Some((i, by, by / errors(i)?))
        };
        let most = (0..moved.by.len()).filter_map(one).max_by(|a, b| a.2.total_cmp(&b.2));
        let size = most.map_or(moved.rows, |(_, _, size)| size);
        (size > MATTERS).then_some(Self { off, most })
    }

    /// Those that matter; all if a run failed, because nothing then excludes any.
    fn among(
        off: &'o [Off],
        moved: Option<&[Moved]>,
        errors: &dyn Fn(usize) -> Option<f64>,
    ) -> Vec<Self> {
        match moved {
            Some(moved) => off.iter().zip(moved).filter_map(|o| Self::of(o, errors)).collect(),
            None => off.iter().map(|off| Self { off, most: None }).collect(),
        }
    }
}

/// Warning for a fit.
pub fn of_fit(
    (input, study): (&Input, &FitStudy),
    (task, fit): (&NetworkFitTask, &NetworkFit),
    named: &Named<'_>,
) -> Option<Diagnostic> {
    let off = task.taken_as_exact();
    let moved = fit.moved_by(task, &off).ok();
    let errors = |i: usize| fit.parameters[i].standard_error;
    let found = Matters::among(&off, moved.as_deref(), &errors);
    let words = words(input, (&found, named), "of its standard errors")?;
    let message = format!("fit `{}` does not vary {words}", study.name);
    let warning = Diagnostic::warning("fit::taken_as_exact", message);
    Some(warning.at(study.span.clone(), "").help(counted(study, &names(input, &found))))
}

/// Help to include the uncertainty of these parameters in a fit.
fn counted(study: &FitStudy, names: &[&str]) -> String {
    let sets = |name: &&&str| study.records.iter().any(|record| record.sets(name));
    let set: Vec<String> = names.iter().filter(sets).map(|name| format!("`{name}`")).collect();
    if !set.is_empty() {
        return format!(
            "records set {}, which a fit cannot vary: make the error that all records share a \
             separate parameter, for example a factor `f = \"1 ± 0.05\"`",
            joined(&set)
        );
    }
    let line = match study.varied.iter().any(|varied| varied.has_range()) {
        true => {
            let more: Vec<String> = names.iter().map(|name| format!("`{name} = {{}}`")).collect();
            format!("add {} to `vary`", joined(&more))
        }
        false => {
            let varied = study.varied.iter().map(|varied| varied.name.as_str());
            vary(varied.chain(names.iter().copied()))
        }
    };
    format!("let the fit include it: {line}; an exact value has no `±`")
}

/// Warning for a fit whose fixed values differ from the posterior that every other verb takes.
pub fn beside_posterior(
    input: &Input,
    (study, task, fit): (&FitStudy, &NetworkFitTask, &NetworkFit),
    named: &Named<'_>,
) -> Option<Diagnostic> {
    let posterior = input.netlist.posterior()?;
    let network = &input.netlist.network;
    let (mut off, mut values) = (Vec::new(), Vec::new());
    for quantity in posterior.chosen().map(|i| &posterior.posterior.quantities[i]) {
        let Ok(parameter) = network.parameter(&quantity.name) else { continue };
        if task.parameters.iter().any(|varied| varied.parameter == parameter) {
            continue;
        }
        let away = quantity.value - network.parameter_value(parameter);
        let most = away.hypot(quantity.spread.map_or(0.0, |spread| spread.sigma(quantity.value)));
        // set values take precedence over a posterior
        let of = |run: &MeasuredRun| run.parameters.value(parameter).map_or(most, |_| 0.0);
        off.push(Off { parameter, by: task.runs.iter().map(of).collect() });
        values.push(quantity.value);
    }
    let moved = fit.moved_by(task, &off).ok();
    let errors = |i: usize| fit.parameters[i].standard_error;
    let found = Matters::among(&off, moved.as_deref(), &errors);
    let worst = worst(&found)?;
    let held = |one: &Matters<'_>| {
        let place = off.iter().position(|off| std::ptr::eq(off, one.off)).unwrap_or(0);
        let (unit, id) = (input.unit_of(one.off.parameter), one.off.parameter);
        let shown = |si: f64| significant(unit.from_si(si), 5);
        format!(
            "`{}` at {}, while the posterior has {}{}",
            name(input, one.off),
            shown(network.parameter_value(id)),
            shown(values[place]),
            spaced(&unit.text)
        )
    };
    let held: Vec<String> = found.iter().map(held).collect();
    let message = format!(
        "fit `{}` does not read the posterior that [uncertainty] names, and keeps {}{}",
        study.name,
        joined(&held),
        moves(worst, named, ("that moves", "of its standard errors"))
    );
    let help = "a fit starts from the values of the netlist, since another fit may have used the \
        same records: vary the parameter, or write the value into the netlist";
    let warning = Diagnostic::warning("fit::other_posterior", message);
    Some(warning.at(study.span.clone(), "").help(help))
}

/// Warning for a plan.
pub fn of_plan(
    (input, study): (&Input, &PlanStudy),
    (task, design): (&DesignTask, &Design),
    named: &Named<'_>,
) -> Option<Diagnostic> {
    let (off, moved) = task.taken_as_exact(design);
    let wanted = |i: usize| task.known.iter().find(|known| known.unknown == i).map(|k| k.error);
    let found = Matters::among(&off, moved.as_deref(), &wanted);
    let words = words(input, (&found, named), "times the wanted error")?;
    let message = format!("plan `{}` does not vary {words}", study.name);
    let varied = study.varied.iter().map(|(name, _)| name.as_str());
    let line = vary(varied.chain(names(input, &found)));
    let help = format!("let the plan include it: {line}; an exact value has no `±`");
    let warning = Diagnostic::warning("plan::taken_as_exact", message);
    Some(warning.at(study.span.clone(), "").help(help))
}

/// "`P` (± 5 W), and takes it as exact: off by as much it moves `R` by 0.016 K/W, 72 of its standard
/// errors".
fn words(
    input: &Input,
    (found, named): (&[Matters<'_>], &Named<'_>),
    beside: &str,
) -> Option<String> {
    let own = |one: &Matters<'_>| {
        let deviation = amount(&input.unit_of(one.off.parameter), one.off.most());
        format!("`{}` (± {deviation})", name(input, one.off))
    };
    let worst = worst(found)?;
    let all: Vec<String> = found.iter().map(own).collect();
    let (them, which) = match found.len() {
        1 => ("it", "it".to_owned()),
        _ => ("them", format!("`{}`", name(input, worst.off))),
    };
    let moves = moves(worst, named, (&format!("an error of this size in {which} moves"), beside));
    Some(format!("{}, and takes {them} as exact{moves}", joined(&all)))
}

/// The one that moves an unknown furthest.
fn worst<'f, 'o>(found: &'f [Matters<'o>]) -> Option<&'f Matters<'o>> {
    let size = |one: &Matters<'_>| one.most.map_or(0.0, |(_, _, size)| size);
    found.iter().max_by(|a, b| size(a).total_cmp(&size(b)))
}

/// ": off by as much, it moves `R` by 0.016 K/W, 72 of its standard errors".
fn moves(one: &Matters<'_>, named: &Named<'_>, (how, beside): (&str, &str)) -> String {
    let Some((i, by, size)) = one.most else { return String::new() };
    let (by, size) = (amount(&named.units[i], by), significant(size, 2));
    format!(": {how} `{}` by {by}, {size} {beside}", named.names[i])
}

/// A difference in a unit.
fn amount(unit: &Unit, si: f64) -> String {
    let text = if unit.ty.absolute { difference(unit) } else { &unit.text };
    format!("{}{}", significant(si / unit.scale, 2), spaced(text))
}

fn name<'i>(input: &'i Input, off: &Off) -> &'i str {
    &input.netlist.network.parameters()[off.parameter.index()].name
}

fn names<'i>(input: &'i Input, found: &[Matters<'_>]) -> Vec<&'i str> {
    found.iter().map(|one| name(input, one.off)).collect()
}

/// The line to paste.
fn vary<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    format!("`vary = [{}]`", names.join(", "))
}
