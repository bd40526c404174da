//! Errors in the numbers of a plan.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Network, ParameterId};

use super::{KnownTo, PlanNumbers, PlanStudy, Target};
use crate::setting::Setting;

impl PlanStudy {
    pub(super) fn problems(&self, network: &Network) -> Vec<Diagnostic> {
        let numbers = match self.numbers(network, &network.overrides()) {
            Ok(numbers) => numbers,
            Err(error) => {
                let message = format!("plan `{}`: {error}", self.name);
                return vec![Diagnostic::error(error.code(), message).at(self.span.clone(), "")];
            }
        };
        let mut problems = self.targets(network, &numbers);
        problems.extend(self.settings().into_iter().filter_map(|(setting, zero)| {
            let value = setting.value.at(&mut network.evaluation()).ok()?;
            let sound = value.is_finite() && (value > 0.0 || (zero && value >= 0.0));
            let least = if zero { "cannot be less than zero" } else { "has to be more than zero" };
            let message = format!("{} {least}", setting.words);
            (!sound).then(|| wrong(message, &setting.span, &setting.help))
        }));
        problems.extend(self.durations(&numbers));
        problems
    }

    fn targets(&self, network: &Network, numbers: &PlanNumbers) -> Vec<Diagnostic> {
        let unsound = |(target, (id, to)): (&Target, &(ParameterId, KnownTo))| {
            let error = to.of(network.parameter_value(*id));
            if error > 0.0 && error.is_finite() {
                return None;
            }
            let message = format!(
                "`know` of plan `{}`: the error of `{}` has to be more than zero",
                self.name, target.name
            );
            let name = &target.name;
            let help = match network.parameter_value(*id).abs() > 0.0 {
                true => format!("write for example `{name} = \"5 %\"`, or an error in its unit"),
                false => {
                    let unit = network.parameters()[id.index()].ty.usual_unit();
                    let unit = if unit == "1" { unit } else { format!("1 {unit}") };
                    format!(
                        "`{name}` is 0, of which no share is an error: write the error in its unit, \
                         for example `{name} = \"{unit}\"`"
                    )
                }
            };
            Some(Diagnostic::wrong("netlist::plan_know", message, &target.span, help))
        };
        self.known.iter().zip(&numbers.known).filter_map(unsound).collect()
    }

    /// Every setting, with true if it may be 0.
    fn settings(&self) -> Vec<(&Setting, bool)> {
        let mut all = vec![(&self.every, false)];
        all.extend(self.duration.iter().map(|duration| (duration, false)));
        let costs = self.run_cost.iter().chain(&self.hour_cost).chain(&self.budget);
        all.extend(costs.map(|cost| (cost, true)));
        for run in &self.runs {
            all.extend(run.duration.iter().map(|duration| (duration, false)));
            all.extend(run.cost.iter().map(|cost| (cost, true)));
        }
        for place in &self.places {
            all.push((&place.noise, false));
            all.extend(place.drift.iter().flat_map(|(drift, time)| [(drift, true), (time, false)]));
            all.extend(place.cost.iter().map(|cost| (cost, true)));
        }
        // settings that all places share appear more than once
        let mut seen: Vec<&Span> = Vec::new();
        all.retain(|(setting, _)| {
            let new = !seen.contains(&&setting.span);
            seen.push(&setting.span);
            new
        });
        all
    }

    /// Checks that a run has at least one, and at most a million, intervals between samples.
    fn durations(&self, numbers: &PlanNumbers) -> Option<Diagnostic> {
        const MOST: f64 = 1e6;
        let every = numbers.every;
        let samples = |duration: f64| duration / every;
        let run = numbers.runs.iter().find(|run| !(1.0..=MOST).contains(&samples(run.duration)))?;
        let message = match samples(run.duration) < 1.0 {
            true => format!("run `{}` is shorter than the time between two samples", run.name),
            false => format!("run `{}` has more than {MOST} samples", run.name),
        };
        (run.duration > 0.0 && every > 0.0).then(|| {
            let help = "samples are taken at the start and then at intervals of `every` until the \
                        run ends";
            wrong(message, &self.every.span, help)
        })
    }
}

fn wrong(message: String, at: &Span, help: &str) -> Diagnostic {
    Diagnostic::wrong("netlist::plan_value", message, at, help)
}
