//! A plan as it is written.

use lptn_network::{Network, Value};
use lptn_units::{Type, format_number};

use super::{PlanPlace, PlanRun, PlanStudy, Target};
use crate::setting::Setting;
use crate::study::type_of;
use crate::toml_text::{TomlFields, key, like, string, value};

impl PlanStudy {
    pub(super) fn written_fields(&self, network: &Network) -> TomlFields {
        let mut fields = TomlFields::default();
        let known = self.known.iter();
        fields.table("know", known.map(|target| target.written(type_of(network, &target.name))));
        fields.strings("vary", self.varied.iter().map(|(name, _)| name.as_str()));
        fields.table("place", self.places.iter().map(PlanPlace::written));
        fields.put("every", self.every.written());
        fields.maybe("duration", self.duration.as_ref().map(Setting::written));
        fields.table("run", self.runs.iter().map(|run| run.written(network)));
        for (name, names) in [("done", &self.done), ("given", &self.given)] {
            fields.strings(name, names.iter().map(String::as_str));
        }
        let mut cost = TomlFields::default();
        cost.maybe("run", number(self.run_cost.as_ref()));
        cost.maybe("hour", number(self.hour_cost.as_ref()));
        fields.maybe("cost", (!cost.is_empty()).then(|| cost.inline()));
        fields.maybe("budget", number(self.budget.as_ref()));
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
        fields.maybe("sensor", self.observed.sensor.as_deref().map(string));
        fields.maybe("cost", number(self.cost.as_ref()));
        format!("{} = {}", key(&self.observed.column), fields.inline())
    }
}

impl PlanRun {
    fn written(&self, network: &Network) -> String {
        let mut fields = TomlFields::default();
        let one = |(name, values): &(String, Vec<(Value, String)>)| {
            let ty = type_of(network, name);
            let values: Vec<String> = values.iter().map(|(value, _)| like(value, ty)).collect();
            match values.as_slice() {
                [only] => format!("{} = {only}", key(name)),
                all => format!("{} = [{}]", key(name), all.join(", ")),
            }
        };
        fields.table("set", self.set.iter().map(one));
        fields.maybe("duration", self.duration.as_ref().map(Setting::written));
        fields.maybe("cost", number(self.cost.as_ref()));
        format!("{} = {}", key(&self.name), fields.inline())
    }
}

/// A number, if given.
fn number(setting: Option<&Setting>) -> Option<String> {
    setting.map(|setting| value(&setting.value, Type::SCALAR))
}
