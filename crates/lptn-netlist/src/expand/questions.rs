//! `[run]` and the studies.

use super::Writer;
use crate::run::{OutputPlan, RUN};
use crate::setting::Setting;
use crate::toml_text::{TomlFields, quantity, strings};
use crate::uncertainty::UNCERTAINTY;
use lptn_network::{IntegratorChoice, OutputTimes, RunSettings, Value};
use lptn_units::{Dimension, Type};

impl Writer<'_> {
    pub(super) fn run(&mut self) {
        let Some(plan) = &self.origin.plan else { return };
        let mut fields = TomlFields::default();
        for (name, setting) in [("start", plan.start.as_ref()), ("stop", Some(&plan.stop))] {
            if let Some(setting) = setting {
                fields.put(name, setting.written());
            }
        }
        match &plan.output {
            Some(OutputPlan::Every(every)) => {
                fields.put("output", format!("{{ every = {} }}", every.written()));
            }
            Some(OutputPlan::At(times)) => {
                let times: Vec<String> = times.iter().map(|time| time.written()).collect();
                fields.put("output", format!("{{ at = [{}] }}", times.join(", ")));
            }
            None => {}
        }
        if !plan.select.is_empty() {
            fields.put("select", strings(plan.select.iter().map(String::as_str)));
        }
        let mut reports = TomlFields::default();
        let named = |name: &str| self.network.named_values().iter().any(|value| value.name == name);
        for report in self.network.reports().iter().filter(|report| !named(&report.name)) {
            let text = match &report.value {
                // every instance of a family
                Value::Expression(program) if report.text.contains("[*]") => program.text(),
                _ => &report.text,
            };
            reports.word(&report.name, text);
        }
        if !reports.is_empty() {
            fields.put("report", reports.inline());
        }
        let mut windows = TomlFields::default();
        for window in &plan.windows {
            let [from, to] = window.ends().map(Setting::written);
            windows.put(window.name(), format!("{{ from = {from}, to = {to} }}"));
        }
        if !windows.is_empty() {
            fields.put("window", windows.inline());
        }
        if let Some(tolerance) = &plan.tolerance {
            fields.put("tolerance", tolerance.written());
        }
        if let Some(share) = &plan.balance_error {
            fields.put("balance_error", share.written());
        }
        if plan.integrator != IntegratorChoice::Auto {
            fields.word("integrator", plan.integrator.word());
        }
        self.section(RUN.name, &fields);
    }

    /// The settings of a run.
    pub(super) fn settings(&mut self, run: &RunSettings) {
        let mut fields = TomlFields::default();
        let time = |seconds: f64| quantity(seconds, Type::of(Dimension::TIME));
        if run.start.abs() > 0.0 {
            fields.put("start", time(run.start));
        }
        fields.put("stop", time(run.stop));
        let output = match &run.output {
            OutputTimes::Every(every) => format!("{{ every = {} }}", time(*every)),
            OutputTimes::At(times) => {
                let times: Vec<String> = times.iter().map(|at| time(*at)).collect();
                format!("{{ at = [{}] }}", times.join(", "))
            }
        };
        fields.put("output", output);
        fields.put("tolerance", quantity(run.tolerance, Type::of(Dimension::TEMPERATURE)));
        if let Some(share) = run.balance_error {
            fields.put("balance_error", quantity(share, Type::of(Dimension::NONE)));
        }
        if run.integrator != IntegratorChoice::Auto {
            fields.word("integrator", run.integrator.word());
        }
        self.section(RUN.name, &fields);
    }

    /// Joint knowledge of the parameters: `[uncertainty]`.
    pub(super) fn uncertainty(&mut self) {
        let path = |place: &lptn_data::Span, path: &str| self.path(place.file, path);
        let fields = self.origin.uncertainty.fields(&path);
        self.section(UNCERTAINTY.name, &fields);
    }

    /// The studies.
    pub(super) fn studies(&mut self) {
        let (network, origin) = (self.network, self.origin);
        let studies = origin.studies.written(network, &|file, path| self.path(file, path));
        studies.iter().for_each(|(heading, fields)| self.section(heading, fields));
    }
}
