//! A reduction as JSON.

use std::borrow::Cow;
use std::io::{self, Write};

use lptn_reduce::{Bias, Deviation, Dynamics, FitError, Window};
use lptn_report::JsonWriter;
use lptn_study::Scalar;
use serde_json::{Map, Value, json};

use super::View;
use crate::diagnostics;

pub(crate) fn write(view: &View<'_>, out: impl Write) -> io::Result<()> {
    let netlist = &view.input.netlist;
    let (norton, inputs) = (&view.reduction.norton, &view.reduction.inputs);
    let boundaries = netlist.network.boundaries().iter().map(|b| Cow::from(&b.name));
    let sources = netlist.network.sources().iter().map(|s| s.name());
    let mut json = JsonWriter::new(out);
    json.member("format", &json!(1))?;
    json.member("network", &json!(view.input.text.stem))?;
    json.member("warnings", &diagnostics::list(&netlist.files, &netlist.warnings))?;
    json.member("port", &json!(view.args.port))?;
    json.member("R_eq", &scalar(norton.resistance, "K/W"))?;
    json.member("T_ref", &scalar(inputs.reference, "K"))?;
    json.member("Q_N", &scalar(inputs.heat, "W"))?;
    json.member("boundary_weights", &named(boundaries, &norton.boundary_weights))?;
    json.member("source_weights", &named(sources, &norton.source_weights))?;
    dynamics(view.reduction.dynamics.as_ref(), &mut json)?;
    if let Some(bias) = &view.bias {
        json.member("bias", &of_bias(bias))?;
    }
    json.member("notes", &json!(view.notes()))?;
    json.finish().map(drop)
}

fn dynamics<W: Write>(dynamics: Option<&Dynamics>, json: &mut JsonWriter<W>) -> io::Result<()> {
    let Some(dynamics) = dynamics else {
        return ["C_eq", "errors", "recommended"]
            .into_iter()
            .try_for_each(|name| json.member(name, &Value::Null));
    };
    let by_name = |value: &dyn Fn(&lptn_reduce::Pair) -> Value| -> Value {
        let pairs = dynamics.pairs.iter().map(|pair| (pair.definition.key().to_owned(), value(pair)));
        Value::Object(pairs.collect::<Map<_, _>>())
    };
    json.member("C_eq", &by_name(&|pair| scalar(pair.capacity, "J/K")))?;
    let errors =
        |pair: &lptn_reduce::Pair| json!({ "step": error(&pair.step), "run": pair.run.as_ref().map(error) });
    json.member("errors", &by_name(&errors))?;
    json.member("recommended", &json!(dynamics.recommended.definition.key()))?;
    json.member("recommended_by", &json!(if dynamics.recommended.by_run { "run" } else { "step" }))?;
    json.member("tau_1", &scalar(dynamics.step.slowest().tau, "s"))?;
    let of = match dynamics.window {
        Window::Given(_) => "given",
        Window::Run(_) => "run",
        Window::TimeConstants(_) => "five time constants",
    };
    json.member("window", &json!({ "value": dynamics.window.length(), "unit": "s", "from": of }))?;
    let optional = |value: Option<f64>| value.map_or(Value::Null, |value| scalar(value, "K"));
    json.member("rise", &optional(dynamics.rise))?;
    json.member("tolerance", &optional(dynamics.tolerance))
}

fn error(deviation: &Deviation) -> Value {
    json!({
        "max": scalar(deviation.kelvin, "K"),
        "relative": deviation.relative.map_or(Value::Null, |relative| scalar(relative, "1")),
        "time": scalar(deviation.time, "s"),
    })
}

fn of_bias(bias: &Result<Bias, FitError>) -> Value {
    match bias {
        Err(error) => json!({ "code": error.code(), "message": error.to_string() }),
        Ok(bias) => json!({
            "T_i": scalar(bias.fit.initial, "K"),
            "T_f": scalar(bias.fit.settled, "K"),
            "t_RC": scalar(bias.fit.tau, "s"),
            "rms": scalar(bias.fit.rms, "K"),
            "points": scalar_of_count(bias.points),
            "C_eq": scalar(bias.capacity, "J/K"),
            "R_eq": scalar(bias.resistance, "K/W"),
            "P_inferred": scalar(bias.inferred, "W"),
            "P_true": scalar(bias.heat, "W"),
            "relative": bias.relative().map_or(Value::Null, |relative| scalar(relative, "1")),
        }),
    }
}

fn scalar(value: f64, unit: &str) -> Value {
    Scalar::new(value, unit).json()
}

fn scalar_of_count(count: usize) -> Value {
    json!({ "value": count, "unit": "1" })
}

fn named<'a>(names: impl Iterator<Item = Cow<'a, str>>, values: &[f64]) -> Value {
    Value::Object(names.zip(values).map(|(name, &value)| (name.into_owned(), scalar(value, "1"))).collect())
}
