//! A plan as it is written.

use lptn_network::{Network, Value};
use lptn_units::{Type, format_number};

use super::{PlanPlace, PlanRun, PlanStudy, Target};
use crate::setting::Setting;
use crate::toml_text::{TomlFields, key, like, string, strings, value};

impl PlanStudy {
    pub(super) fn written_fields(&self, network: &Network) -> TomlFields {
        let ty = |name: &str| {
            let id = network.parameter(name).ok();
            id.map_or(Type::SCALAR, |id| network.parameters()[id.index()].ty)
        };
        let mut fields = TomlFields::default();
        let known = self.known.iter().map(|target| target.written(ty(&target.name)));
        fields.put("know", braced(known));
        if !self.varied.is_empty() {
            fields.put("vary", strings(self.varied.iter().map(|(name, _)| name.as_str())));
        }
        fields.put("place", braced(self.places.iter().map(PlanPlace::written)));
        fields.put("every", self.every.written());
        if let Some(duration) = &self.duration {
            fields.put("duration", duration.written());
        }
        if !self.runs.is_empty() {
            fields.put("run", braced(self.runs.iter().map(|run| run.written(&ty))));
        }
        for (name, names) in [("done", &self.done), ("given", &self.given)] {
            if !names.is_empty() {
                fields.put(name, strings(names.iter().map(String::as_str)));
            }
        }
        let mut cost = TomlFields::default();
        put(&mut cost, "run", self.run_cost.as_ref());
        put(&mut cost, "hour", self.hour_cost.as_ref());
        if !cost.is_empty() {
            fields.put("cost", cost.inline());
        }
        put(&mut fields, "budget", self.budget.as_ref());
        fields
    }
}

impl Target {
    fn written(&self, ty: Type) -> String {
        let error = match (&self.absolute, self.percent) {
            (Some(error), _) => value(error, Type::of(ty.dimension)),
            (None, percent) => format!("\"{} %\"", format_number(percent.unwrap_or(f64::NAN))),
        };
        format!("{} = {error}", key(&self.name))
    }
}

impl PlanPlace {
    fn written(&self) -> String {
        let mut fields = TomlFields::default();
        fields.put("of", string(&self.observed.text));
        fields.put("noise", self.noise.written());
        if let Some((drift, time)) = &self.drift {
            fields.put("drift", drift.written());
            fields.put("drift_time", time.written());
        }
        if let Some(sensor) = &self.observed.sensor {
            fields.put("sensor", string(sensor));
        }
        put(&mut fields, "cost", self.cost.as_ref());
        format!("{} = {}", key(&self.observed.column), fields.inline())
    }
}

impl PlanRun {
    fn written(&self, ty: &dyn Fn(&str) -> Type) -> String {
        let mut fields = TomlFields::default();
        let one = |(name, values): &(String, Vec<(Value, String)>)| {
            let values: Vec<String> =
                values.iter().map(|(value, _)| like(value, ty(name))).collect();
            match values.as_slice() {
                [only] => format!("{} = {only}", key(name)),
                all => format!("{} = [{}]", key(name), all.join(", ")),
            }
        };
        if !self.set.is_empty() {
            fields.put("set", braced(self.set.iter().map(one)));
        }
        if let Some(duration) = &self.duration {
            fields.put("duration", duration.written());
        }
        put(&mut fields, "cost", self.cost.as_ref());
        format!("{} = {}", key(&self.name), fields.inline())
    }
}

/// A number, where it is there.
fn put(fields: &mut TomlFields, name: &str, setting: Option<&Setting>) {
    if let Some(setting) = setting {
        fields.put(name, value(&setting.value, Type::SCALAR));
    }
}

fn braced(fields: impl Iterator<Item = String>) -> String {
    format!("{{ {} }}", fields.collect::<Vec<_>>().join(", "))
}
