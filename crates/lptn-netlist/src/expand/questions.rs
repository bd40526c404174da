//! `[run]`, `[size]` and `[fit]`: what is asked of the network.

use super::Writer;
use super::text::{Fields, like, quantity, value};
use crate::fit::{FitRecord, FitStudy, Observed, VariedName};
use crate::run::OutputPlan;
use crate::setting::Setting;
use crate::size::{Goal, SizeStudy};
use crate::toml_text::{key, string};
use lptn_network::{OutputTimes, RunSettings};
use lptn_units::{Dimension, Type};

impl Writer<'_> {
    pub(super) fn run(&mut self) {
        let Some(plan) = &self.origin.plan else { return };
        let mut fields = Fields::default();
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
            fields.put("select", strings(&plan.select));
        }
        let mut reports = Fields::default();
        for report in self.network.reports() {
            reports.word(&report.name, &report.text);
        }
        if !reports.is_empty() {
            fields.put("report", reports.inline());
        }
        let mut windows = Fields::default();
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
        self.section("run", &fields);
    }

    /// The numbers of a run.
    pub(super) fn settings(&mut self, run: &RunSettings) {
        let mut fields = Fields::default();
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
        self.section("run", &fields);
    }

    pub(super) fn sizes(&mut self) {
        for size in &self.origin.sizes {
            let fields = self.size(size);
            self.section(&format!("size.{}", key(&size.name)), &fields);
        }
    }

    fn size(&self, size: &SizeStudy) -> Fields {
        let network = &self.network;
        let mut fields = Fields::default();
        let goal = if size.goal == Goal::Minimise { "minimise" } else { "maximise" };
        fields.word(goal, &size.parameter);
        if let Ok(id) = network.parameter(&size.parameter) {
            let ty = network.parameters()[id.index()].ty;
            let [from, to] = size.ends().map(|end| like(end, ty));
            fields.put("vary", format!("{{ {} = {{ from = {from}, to = {to} }} }}", key(&size.parameter)));
        }
        let texts: Vec<String> = size.requirements.iter().map(|r| r.text.clone()).collect();
        fields.put("require", strings(&texts));
        fields
    }
}

impl Writer<'_> {
    pub(super) fn fits(&mut self) {
        for fit in &self.origin.fits {
            let fields = self.fit(fit);
            self.section(&format!("fit.{}", key(&fit.name)), &fields);
        }
    }

    fn fit(&self, fit: &FitStudy) -> Fields {
        let ty = |name: &str| {
            let id = self.network.parameter(name).ok();
            id.map_or(Type::SCALAR, |id| self.network.parameters()[id.index()].ty)
        };
        let mut fields = Fields::default();
        let record = |record: &FitRecord| {
            let csv = string(&self.path(record.span.file, &record.csv));
            let set: Vec<String> = record
                .set
                .iter()
                .map(|(name, own)| format!("{} = {}", key(name), like(own, ty(name))))
                .collect();
            if set.is_empty() { csv } else { format!("{{ csv = {csv}, set = {{ {} }} }}", set.join(", ")) }
        };
        let records: Vec<String> = fit.records.iter().map(record).collect();
        fields.put("data", format!("[{}]", records.join(", ")));
        if let Some(time) = &fit.time {
            fields.word("time", time);
        }
        let column = |observed: &Observed| {
            let (name, of) = (key(&observed.column), string(&observed.text));
            match &observed.sigma {
                None => format!("{name} = {of}"),
                Some(sigma) => {
                    let sigma = value(sigma, Type::of(observed.ty.dimension));
                    format!("{name} = {{ of = {of}, sigma = {sigma} }}")
                }
            }
        };
        let columns: Vec<String> = fit.observed.iter().map(column).collect();
        fields.put("column", format!("{{ {} }}", columns.join(", ")));
        let varied = |varied: &VariedName| {
            let ends = [("from", &varied.from), ("to", &varied.to)].into_iter();
            let ends: Vec<String> = ends
                .filter_map(|(name, end)| Some(format!("{name} = {}", like(end.as_ref()?, ty(&varied.name)))))
                .collect();
            let range = if ends.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", ends.join(", ")) };
            format!("{} = {range}", key(&varied.name))
        };
        let varied: Vec<String> = fit.varied.iter().map(varied).collect();
        fields.put("vary", format!("{{ {} }}", varied.join(", ")));
        fields
    }
}

fn strings(texts: &[String]) -> String {
    let texts: Vec<String> = texts.iter().map(|text| string(text)).collect();
    format!("[{}]", texts.join(", "))
}
