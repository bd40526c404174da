//! A sweep as it is written back.

use lptn_network::{Network, Value};
use lptn_units::{Dimension, Type};

use crate::csv_form::written as written_file;
use crate::study::{PathFrom, type_of};
use crate::sweep::axis::AxisValues;
use crate::sweep::{SweepMethod, SweepOver, SweepStudy};
use crate::toml_text::{TomlFields, key, like, strings, value};

impl SweepStudy {
    pub(super) fn as_written(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        fields.word("method", self.method.word());
        if let Some(file) = &self.file {
            fields.put("file", written_file(&path(file.span.file, &file.csv), &file.options));
        }
        fields.put("axes", self.axes_written(network));
        if self.method.is_sampled() {
            fields.put("samples", self.samples.to_string());
            fields.put("seed", self.seed.to_string());
        }
        if self.over != SweepOver::Steady {
            fields.word("over", self.over.word());
        }
        let period = self.period.as_ref();
        fields.maybe("period", period.map(|period| value(period, Type::of(Dimension::TIME))));
        let mut reports = TomlFields::default();
        for report in &self.reports {
            match report.text.as_str() {
                "" => reports.put(&key(&report.name), value(&report.of, report.ty)),
                text => reports.word(&report.name, text),
            }
        }
        fields.put("report", reports.inline());
        let front = self.front.iter().flatten();
        fields.strings("front", front.map(|&place| self.reports[place].name.as_str()));
        fields
    }

    fn axes_written(&self, network: &Network) -> String {
        if self.method == SweepMethod::Csv {
            return strings(self.axes.iter().map(|axis| axis.name.as_str()));
        }
        let axis = |axis: &super::SweepAxis| {
            let ty = type_of(network, &axis.name);
            format!("{} = {}", key(&axis.name), written(&axis.values, ty))
        };
        let axes: Vec<String> = self.axes.iter().map(axis).collect();
        format!("{{ {} }}", axes.join(", "))
    }
}

fn written(values: &AxisValues, ty: Type) -> String {
    let one = |value: &Value| like(value, ty);
    match values {
        AxisValues::List(values, _) => {
            format!("[{}]", values.iter().map(one).collect::<Vec<_>>().join(", "))
        }
        AxisValues::Range { ends: [from, to], points, log, .. } => {
            let points = if *points == 0 { String::new() } else { format!(", points = {points}") };
            let scale = if *log { ", scale = \"log\"" } else { "" };
            format!("{{ from = {}, to = {}{points}{scale} }}", one(from), one(to))
        }
        AxisValues::Column(_) => String::new(),
    }
}
