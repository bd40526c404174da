//! The parts of the object of an inference.

use lptn_fit::infer::{InferredColumn, InferredJump, InferredSensor, Known};
use lptn_study::SiValue;
use serde_json::{Map, Value, json};

use super::InferAnswer;

fn seconds(time: f64) -> SiValue {
    SiValue::new(time, "s")
}

impl InferAnswer {
    pub(super) fn signals_json(&self) -> Value {
        let one = |j: usize| {
            let (estimated, course) = (&self.task.estimated[j], &self.found.courses[j]);
            let unit = self.units[j].ty.dimension.si_unit();
            let known =
                |known: Known| json!({ "value": known.value, "sd": known.deviation, "unit": unit });
            let member = json!({
                "mean": course.mean.map(known),
                "end": known(self.at_end(j)),
                "constant": known(course.still.0),
                "constant_log_likelihood": course.still.1,
                "intensity": course.intensity,
                "slope_intensity": course.slope_intensity,
                "positive": estimated.positive,
            });
            (estimated.name.clone(), member)
        };
        Value::Object((0..self.task.estimated.len()).map(one).collect())
    }

    pub(super) fn jumps_json(&self) -> Value {
        let one = |jump: &InferredJump| {
            let estimated = &self.task.estimated[jump.course];
            let own = self.units[jump.course].ty.dimension.si_unit();
            let unit = if estimated.positive { "1".to_owned() } else { own };
            json!({
                "signal": estimated.name,
                "between": [seconds(jump.between.0), seconds(jump.between.1)],
                "by": { "value": jump.by.value, "sd": jump.by.deviation, "unit": unit },
                "log_likelihood_without": self.found.log_likelihood - jump.gain,
            })
        };
        self.found.jumps.iter().map(one).collect()
    }

    pub(super) fn sensors_json(&self) -> Value {
        let one = |sensor: &InferredSensor| {
            let unit = if sensor.gain { "1" } else { "K" };
            let member = json!({
                "value": sensor.now.value,
                "sd": sensor.now.deviation,
                "unit": unit,
                "prior": sensor.before.deviation,
            });
            (self.sensor_name(sensor), member)
        };
        Value::Object(self.found.sensors.iter().map(one).collect())
    }

    pub(super) fn parameters_json(&self) -> Value {
        let one = |(name, unit, before, now): (String, lptn_units::Unit, Known, Known)| {
            let member = json!({
                "value": now.value,
                "sd": now.deviation,
                "unit": unit.ty.dimension.si_unit(),
                "prior": before.deviation,
            });
            (name, member)
        };
        Value::Object(self.uncertain().into_iter().map(one).collect::<Map<String, Value>>())
    }

    pub(super) fn columns_json(&self) -> Value {
        let all = self.task.run.columns.iter().zip(&self.found.columns);
        let one = |(column, found): (&lptn_fit::network::MeasuredColumn, &InferredColumn)| {
            json!({
                "column": column.name,
                "sigma": SiValue::new(found.sigma, "K"),
                "slow": found.slow.map(|(sd, time)| {
                    json!({ "sd": sd, "unit": "K", "time": seconds(time) })
                }),
                "samples": found.readings,
                "surprise_rms": found.rms,
                "surprise_mean": found.mean,
                "neighbours": found.neighbours,
                "drift": found.drift.map(|d| json!({ "value": d.value, "sd": d.deviation, "unit": "K" })),
            })
        };
        all.map(one).collect()
    }
}
