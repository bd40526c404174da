//! Reads `[plan.NAME]`.

use lptn_data::{Diagnostic, Span, nearest};
use lptn_network::Value;
use lptn_units::{Quantity, Type, parse_quantity};

use super::declaration::{COST, PLACE, PLAN, PLAN_RUN};
use super::{PlanPlace, PlanRun, PlanStudy, Target};
use crate::fields::{Fields, Owner, wrong_shape};
use crate::fit::{Measured, Observed};
use crate::listed::{Listed, Names};
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;
use crate::setting::Setting;
use crate::work::Elaboration;

/// A parameter with its values in a run: each with its text, as it is written.
type Values = (String, Vec<(Value, String)>);

impl<'a> Elaboration<'a> {
    pub(super) fn plan(&mut self, entry: &'a RawEntry) -> Option<PlanStudy> {
        let fields = self.fields(&PLAN, entry)?;
        self.all_there(&fields, &[])?;
        let known = self.plan_targets(&fields);
        let varied = self.plan_varied(&fields);
        let places = self.plan_places(&fields);
        let every = self.require(&fields, "every").map(|_| ());
        let every = every.and_then(|()| self.optional_setting(&fields, "every")?);
        let duration = self.optional_setting(&fields, "duration");
        let runs = self.plan_runs(&fields);
        let cost = self.plan_cost(&fields);
        let budget = self.optional_setting(&fields, "budget");
        let names: Vec<&str> = self.elements("fit").iter().map(|fit| fit.key.as_str()).collect();
        let given = self.plan_names(&fields, "given", ("netlist::plan_given", "fit", &names));
        let runs = runs?;
        let names: Vec<&str> = runs.iter().map(|run: &PlanRun| run.name.as_str()).collect();
        let done = self.plan_names(&fields, "done", ("netlist::plan_done", "run", &names));
        let duration = duration?;
        if duration.is_none() && (runs.is_empty() || runs.iter().any(|run| run.duration.is_none()))
        {
            self.require(&fields, "duration");
            return None;
        }
        let (known, varied) = (known?, varied?);
        self.set_and_estimated(&runs, &known, &varied)?;
        let (run_cost, hour_cost) = cost?;
        Some(PlanStudy {
            name: entry.key.clone(),
            span: entry.key_span.clone(),
            known,
            varied,
            places: places?,
            runs,
            done: done?,
            given: given?,
            every: every?,
            duration,
            run_cost,
            hour_cost,
            budget: budget?,
        })
    }

    /// `know = { R_int = "5 %", P = "2 W" }`.
    fn plan_targets(&mut self, fields: &Fields<'a>) -> Option<Vec<Target>> {
        let wanted = Names::Table("a table of parameters and errors", "a table with a parameter");
        let known = self.listed(fields, "know", wanted)?.into_iter().filter_map(|one| one.entry);
        all(known.map(|entry| self.plan_target(fields, entry)))
    }

    fn plan_target(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<Target> {
        let (words, name) = (fields.owner.field("know"), &entry.key);
        self.can_vary(&words, name, &entry.key_span)?;
        let ty = self.type_here(name)?;
        let target = Target {
            name: name.clone(),
            span: entry.key_span.clone(),
            percent: None,
            absolute: None,
        };
        if let Some(percent) = percent_of(&entry.value) {
            if ty.absolute {
                let message = format!(
                    "{words}: a percentage of the temperature `{name}` is \
                    ambiguous"
                );
                let help = "write the error in K, for example `\"0.5 K\"`";
                self.refuse("netlist::plan_know", message, &entry.value.span, help);
                return None;
            }
            let owner = fields.owner.inside("know").inside(name);
            let place = Place { owner: &owner, key: "", raw: &entry.value };
            self.without_deviation(place, &percent)?;
            return Some(Target { percent: Some(percent.value), ..target });
        }
        let owner = fields.owner.inside("know");
        let wanted = Wanted::constant(Type::of(ty.dimension));
        let value = self.exactly_inside(&owner, (name, &entry.value), wanted)?;
        Some(Target { absolute: Some(value), ..target })
    }

    fn plan_varied(&mut self, fields: &Fields<'a>) -> Option<Vec<(String, Span)>> {
        if fields.get("vary").is_none() {
            return Some(Vec::new());
        }
        let words = fields.owner.field("vary");
        let names = self.listed(fields, "vary", Names::List("a list of parameters"))?;
        let all = names.into_iter().map(|Listed { name, span, .. }| {
            self.can_vary(&words, name, span).map(|()| (name.to_owned(), span.clone()))
        });
        all.collect()
    }

    fn plan_places(&mut self, fields: &Fields<'a>) -> Option<Vec<PlanPlace>> {
        let wanted = Names::Table("a table of places", "a table with a place");
        let places = self.listed(fields, "place", wanted)?.into_iter().filter_map(|one| one.entry);
        let shared = ["noise", "drift", "drift_time"];
        let shared = shared.map(|key| self.optional_setting(fields, key));
        let [noise, drift, time] = shared;
        let shared = [noise?, drift?, time?];
        all(places.map(|entry| self.plan_place(fields, entry, &shared)))
    }

    fn plan_place(
        &mut self,
        fields: &Fields<'a>,
        entry: &'a RawEntry,
        shared: &[Option<Setting>; 3],
    ) -> Option<PlanPlace> {
        let owner = fields.owner.inside("place").inside(&entry.key);
        let inner = self.inner(&PLACE, owner.clone(), entry)?;
        let of = self.require(&inner, "of").and_then(|raw| {
            let found = self.fit_result(&owner, raw)?;
            if found.ty.absolute {
                return Some(found);
            }
            let message =
                format!("{} measures `{}`, which is not a temperature", owner.words(), found.text);
            let help =
                "write a temperature, `of = \"steel.T\"`, or a mean, `of = \"mean(a.T, b.T)\"`";
            self.refuse("netlist::plan_place", message, &raw.span, help);
            None
        });
        let mut own = |key: &str, shared: &Option<Setting>| {
            let own = self.optional_setting(&inner, key)?;
            Some(own.or_else(|| shared.clone()))
        };
        let noise = own("noise", &shared[0]);
        let drift = own("drift", &shared[1]);
        let time = own("drift_time", &shared[2]);
        let cost = own("cost", &None);
        let sensor =
            self.sensor_of(&inner, of.as_ref().map(|of| of.ty))?.map(|(name, _)| name.to_owned());
        let place = (&owner, &entry.key_span, "netlist::plan_drift");
        let drift = self.drift(place, (drift?, time?))?;
        let Some(noise) = noise? else {
            if inner.complete {
                let message = format!("{} has no `noise`", owner.words());
                self.report(inner.missing("noise", message));
            }
            return None;
        };
        let Measured { text, end, value, ty } = of?;
        let (column, span) = (entry.key.clone(), entry.key_span.clone());
        let observed = Observed { column, text, end, value, ty, sigma: None, sensor, span };
        Some(PlanPlace { observed, noise, drift, cost: cost? })
    }

    fn plan_runs(&mut self, fields: &Fields<'a>) -> Option<Vec<PlanRun>> {
        if fields.get("run").is_none() {
            return Some(Vec::new());
        }
        let table = self.table_of(fields, ("run", "a table of runs"))?;
        all(table.entries.iter().map(|entry| self.plan_run(fields, entry)))
    }

    fn plan_run(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<PlanRun> {
        let owner = fields.owner.inside("run").inside(&entry.key);
        let inner = self.inner(&PLAN_RUN, owner.clone(), entry)?;
        let duration = self.optional_setting(&inner, "duration");
        let cost = self.optional_setting(&inner, "cost");
        let set = match inner.get("set") {
            None => Some(Vec::new()),
            Some(_) => self.plan_set(&inner),
        };
        let set = set?;
        let count: usize = set.iter().map(|(_, values)| values.len()).product();
        if count > super::MOST_RUNS {
            let message =
                format!("{} makes {count} runs, more than {}", owner.words(), super::MOST_RUNS);
            let help = "give its lists fewer values";
            self.refuse("netlist::plan_runs", message, &entry.key_span, help);
            return None;
        }
        let (name, span) = (entry.key.clone(), entry.key_span.clone());
        Some(PlanRun { name, span, set, duration: duration?, cost: cost? })
    }

    /// `set = { omega = ["3000 rpm", "7000 rpm"], P = "20 W" }`.
    fn plan_set(&mut self, fields: &Fields<'a>) -> Option<Vec<Values>> {
        let table = self.table_of(fields, ("set", "a table of parameters"))?;
        let owner = fields.owner.inside("set");
        all(table.entries.iter().map(|entry| self.plan_values(&owner, entry)))
    }

    fn plan_values(&mut self, owner: &Owner<'_>, entry: &'a RawEntry) -> Option<Values> {
        let name = &entry.key;
        if !self.is_parameter_here(&owner.words(), name, &entry.key_span) {
            return None;
        }
        let ty = self.type_here(name)?;
        let items = entry.value.items();
        if items.is_empty() {
            let sample = format!("{name} = [\"..\", \"..\"]");
            self.report(wrong_shape(
                &owner.field(name),
                &entry.value,
                "a value or a list with one",
                &sample,
            ));
            return None;
        }
        let one = |item: &'a RawValue| {
            let value = self.exactly_inside(owner, (name, item), Wanted::like(ty))?;
            Some((value, text_of(item)))
        };
        Some((name.clone(), all(items.iter().map(one))?))
    }

    fn plan_cost(&mut self, fields: &Fields<'a>) -> Option<(Option<Setting>, Option<Setting>)> {
        let Some(entry) = fields.entry("cost") else { return Some((None, None)) };
        let inner = self.inner(&COST, fields.owner.inside("cost"), entry)?;
        let run = self.optional_setting(&inner, "run");
        let hour = self.optional_setting(&inner, "hour");
        Some((run?, hour?))
    }

    /// Names of existing runs or fits.
    fn plan_names(
        &mut self,
        fields: &Fields<'a>,
        key: &'static str,
        (code, kind, known): (&'static str, &str, &[&str]),
    ) -> Option<Vec<String>> {
        if fields.get(key).is_none() {
            return Some(Vec::new());
        }
        let what = format!("a list of names of {kind}s");
        let mut names = Vec::new();
        for Listed { name, span, .. } in self.listed(fields, key, Names::List(&what))? {
            if !known.contains(&name) {
                let message = format!(
                    "{} names `{name}`, but there is no such {kind}",
                    fields.owner.field(key)
                );
                let help = match known.is_empty() {
                    true => format!("there is no {kind} at all: leave `{key}` out"),
                    false => nearest(name, known.iter().copied(), &format!("the {kind}s are")),
                };
                self.refuse(code, message, span, help);
                return None;
            }
            names.push(name.to_owned());
        }
        Some(names)
    }

    /// Refuses runs that set a parameter to be estimated, which has one value.
    fn set_and_estimated(
        &mut self,
        runs: &[PlanRun],
        known: &[Target],
        varied: &[(String, Span)],
    ) -> Option<()> {
        let estimated = known.iter().map(|target| (&target.name, &target.span));
        let estimated: Vec<_> =
            estimated.chain(varied.iter().map(|(name, span)| (name, span))).collect();
        for run in runs {
            for (name, _) in &run.set {
                let Some((_, span)) = estimated.iter().find(|(estimated, _)| *estimated == name)
                else {
                    continue;
                };
                let message = format!(
                    "`{name}` is to be estimated, but run `{}` sets \
                    it",
                    run.name
                );
                let problem = Diagnostic::error("netlist::plan_set_and_sought", message)
                    .at((*span).clone(), "to be estimated")
                    .also(run.span.clone(), "set by this run");
                let help = format!("leave `{name}` out of `set`, or out of `know` and `vary`");
                self.report(problem.help(help));
                return None;
            }
        }
        Some(())
    }
}

/// The number of `"5 %"` or `"± 5 %"`.
fn percent_of(raw: &RawValue) -> Option<Quantity> {
    let RawKind::String { text, .. } = &raw.kind else { return None };
    let number = text.trim().trim_start_matches('±').strip_suffix('%')?;
    parse_quantity(number.trim(), Some(Type::SCALAR)).ok()
}

fn text_of(raw: &RawValue) -> String {
    match &raw.kind {
        RawKind::Integer(text) | RawKind::Float(text) => text.clone(),
        RawKind::String { text, .. } => text.trim().to_owned(),
        _ => String::new(),
    }
}
