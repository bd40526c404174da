//! Sentences of a plan.

use lptn_fit::network::design::{DesignPlan, GivenFit, MOST_LEGS, Never};
use lptn_report::significant;

use super::PlanAnswer;
use super::shown::cost;
use crate::unseparated::{Named, joined, names_and_units};
use crate::words::{count, unverified};

/// Lines with a label below the tables.
pub(super) fn notes(answer: &PlanAnswer) -> Vec<(&'static str, String)> {
    let (task, design) = (&answer.task, &answer.design);
    let mut notes = Vec::new();
    if let Some(plan) = &design.plan {
        notes.push(("sensors", answer.places(&plan.places).join(", ")));
        notes.push((
            "runs",
            match plan.runs.is_empty() {
                true => "none: all is known already".to_owned(),
                false => answer.runs(&plan.runs),
            },
        ));
        if answer.has_costs() {
            notes.push(("cost", costs(answer, plan)));
        }
    }
    notes.extend(weights(answer).map(|weights| ("sigma", weights)));
    let done: Vec<&str> =
        task.runs.iter().filter(|run| run.done).map(|run| run.name.as_str()).collect();
    if !done.is_empty() {
        notes.push(("besides", format!("the runs {}", done.join(", "))));
    }
    if task.given() > 0 {
        let of = answer.study.given.join(", ");
        notes.push(("known", format!("{} of {of}", count(task.given(), "record"))));
    }
    notes.extend(shared(answer).map(|shared| ("shared noise", shared)));
    notes.extend(rough(answer).map(|rough| ("rough", rough)));
    notes.extend(unverified(&answer.input.netlist.network).map(|unsure| ("note", unsure)));
    if !design.exact {
        notes.push(("gradient", "differences of runs: the network switches by itself".to_owned()));
    }
    if let Some(never) = design.never.as_ref().filter(|never| !is_lost(answer, never)) {
        notes.push(("never known", lost(answer, never)));
    }
    notes
}

/// Note that columns of existing records share noise, which a plan does not count.
fn shared(answer: &PlanAnswer) -> Option<String> {
    let of_fit = |given: &GivenFit| {
        let sizes = given.fit.shared_noise.iter().map(|shared| shared.correlation.abs());
        Some((given.name.clone(), sizes.reduce(f64::max)?))
    };
    let all: Vec<(String, f64)> = answer.task.given_fits.iter().filter_map(of_fit).collect();
    let most = all.iter().map(|(_, size)| *size).reduce(f64::max)?;
    let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
    Some(format!(
        "columns of {} share errors, correlation up to {}; the plan treats places as independent, \
         so the errors of several will be larger",
        names.join(", "),
        significant(most, 2)
    ))
}

/// Note on values that are hardly known: far from them a network responds differently.
fn rough(answer: &PlanAnswer) -> Option<String> {
    const PART: f64 = 0.5;
    let plan = answer.design.plan.as_ref()?;
    let hardly = |i: &usize| {
        let (error, value) = (plan.errors[*i], answer.task.values[*i].abs());
        let is_part = value > 0.0 && !answer.task.unknowns[*i].is_shift();
        is_part && error.is_finite() && error > PART * value
    };
    let all: Vec<usize> = answer.concerned(&plan.places).into_iter().filter(hardly).collect();
    let names: Vec<String> = all.iter().map(|&i| answer.names[i].clone()).collect();
    let are = if all.len() == 1 {
        "is not known to half of its value"
    } else {
        "are not known to half of their values"
    };
    let why = "so errors are rough: they are those of small changes";
    (!all.is_empty()).then(|| format!("{} {are}, {why}", joined(&names)))
}

/// The `sigma` for a fit of the record, if sensors drift.
fn weights(answer: &PlanAnswer) -> Option<String> {
    let places = &answer.design.plan.as_ref()?.places;
    let drifting = places.iter().map(|&place| &answer.task.places[place]);
    let drifting = drifting.filter(|place| place.correlated > 0.0);
    let one = |place: &lptn_fit::network::design::DesignPlace| {
        format!("{} {} K", place.name, significant(place.weight(), 2))
    };
    let all: Vec<String> = drifting.map(one).collect();
    let why = "a drift is left in the mean of many values";
    (!all.is_empty()).then(|| format!("for the fit: {} ({why})", all.join(", ")))
}

fn costs(answer: &PlanAnswer, plan: &DesignPlan) -> String {
    let sensors: f64 = plan.places.iter().map(|&place| answer.task.places[place].cost).sum();
    let of = match answer.task.budget.is_finite() {
        true => format!(" of {}", cost(answer.task.budget)),
        false => String::new(),
    };
    let (all, runs) = (cost(plan.cost), cost(plan.cost - sensors));
    format!("{all}{of}: sensors {}, runs {runs}", cost(sensors))
}

/// True if some required value is not determined by any run with all sensors.
fn is_lost(answer: &PlanAnswer, never: &Never) -> bool {
    let unknowns = &answer.task.unknowns;
    answer.task.known.iter().any(|known| !never.determines(&unknowns[known.unknown]))
}

/// Text on values that no run determines or distinguishes.
fn lost(answer: &PlanAnswer, never: &Never) -> String {
    let (names, units) =
        names_and_units(&answer.input, &never.unknowns, &answer.task.record_names());
    let values = never.values.clone();
    let named = Named { unknowns: &never.unknowns, names: &names, units: &units, values };
    let mut parts = Vec::new();
    if !never.told.unfelt.is_empty() {
        parts.push(format!("no place depends on {}", named.listed(&never.told.unfelt)));
    }
    parts.extend(never.told.unseparated.iter().map(|group| named.unseparated(group)));
    parts.join("; ")
}

/// The last line: the advice, or the reason why nothing helps.
pub(super) fn verdict(answer: &PlanAnswer) -> String {
    if let Some(never) = answer.design.never.as_ref().filter(|never| is_lost(answer, never)) {
        return format!(
            "not determined by any of the runs, with every sensor and however long: {}",
            lost(answer, never)
        );
    }
    let Some(plan) = &answer.design.plan else {
        let budget = cost(answer.task.budget);
        return format!("the budget of {budget} has room for no run with any sensor");
    };
    if plan.reached && plan.runs.is_empty() {
        return format!("nothing has to be measured: {} is known already", answer.wanted());
    }
    if plan.reached {
        let places = joined(&answer.places(&plan.places));
        let runs = answer.runs(&plan.runs);
        return format!("measure {places} and run {runs}: that determines {}", told(answer, plan));
    }
    format!("not reached: {}", short(answer, plan))
}

/// "alpha to 0.98 %", for each required value.
fn told(answer: &PlanAnswer, plan: &DesignPlan) -> String {
    let known = answer.task.known.iter().map(|known| known.unknown);
    let one = |i: usize| format!("{} to {}", answer.names[i], answer.part(i, plan.errors[i]));
    joined(&known.map(one).collect::<Vec<_>>())
}

/// Reasons why required errors are not reached, and remedies.
fn short(answer: &PlanAnswer, plan: &DesignPlan) -> String {
    let known = answer.task.known.iter();
    let missed = known.filter(|known| plan.errors[known.unknown] > known.error);
    let one = |known: &lptn_fit::network::design::Known| {
        let (i, name) = (known.unknown, &answer.names[known.unknown]);
        let (error, wanted) = (plan.errors[i], answer.part(i, known.error));
        if !error.is_finite() {
            return format!("sensors at these places do not determine {name}");
        }
        let limit = plan.limits.as_ref().map_or(0.0, |limits| limits[i]);
        let mut text =
            format!("{name} is known to {}, but {wanted} is wanted", answer.part(i, error));
        if limit > known.error {
            let part = answer.part(i, limit);
            text += &format!(", and longer runs do not lead below {part}");
            if let Some((cause, share)) = plan.causes[i].filter(|(_, share)| *share > 0.1) {
                let (percent, cause) = (significant(100.0 * share, 2), &answer.names[cause]);
                text += &format!(": {percent} % of the variance come from the `±` of {cause}");
            }
        }
        text
    };
    let texts: Vec<String> = missed.map(one).collect();
    let more = match (answer.task.budget.is_finite(), plan.runs.len() >= MOST_LEGS) {
        (_, true) => format!(", with {MOST_LEGS} runs, the most that are planned"),
        (true, _) => format!(", for a budget of {}", cost(answer.task.budget)),
        _ => "; a further run adds next to nothing".to_owned(),
    };
    texts.join("; ") + &more
}
