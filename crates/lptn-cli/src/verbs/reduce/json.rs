//! A reduction as JSON.

use std::borrow::Cow;
use std::io;

use lptn_reduce::{Bias, Deviation, Dynamics, FitError, Window};
use lptn_report::Json;
use lptn_study::Scalar;
use serde_json::{Value, json};

use super::View;

pub(crate) fn json(view: &View<'_>, json: &mut Json<'_>) -> io::Result<()> {
    let netlist = &view.input.netlist;
    let (norton, inputs) = (&view.reduction.norton, &view.reduction.inputs);
    let boundaries = netlist.network.boundaries().iter().map(|b| Cow::from(&b.name));
    let sources = netlist.network.sources().iter().map(|s| s.name());
    view.input.head(json, &[])?;
    json.member("port", &view.args.port)?;
    json.member("R_eq", &scalar(norton.resistance, "K/W"))?;
    json.member("T_ref", &scalar(inputs.reference, "K"))?;
    json.member("Q_N", &scalar(inputs.heat, "W"))?;
    json.member("boundary_weights", &named(boundaries, &norton.boundary_weights))?;
    json.member("source_weights", &named(sources, &norton.source_weights))?;
    dynamics(view.reduction.dynamics.as_ref(), json)?;
    if let Some(bias) = &view.bias {
        json.member("bias", &of_bias(bias))?;
    }
    json.member("notes", &view.notes())
}

fn dynamics(dynamics: Option<&Dynamics>, json: &mut Json<'_>) -> io::Result<()> {
    let Some(dynamics) = dynamics else {
        return ["C_eq", "errors", "recommended"]
            .into_iter()
            .try_for_each(|name| json.member(name, &Value::Null));
    };
    let by_name = |value: &dyn Fn(&lptn_reduce::Pair) -> Value| -> Value {
        dynamics.pairs.iter().map(|pair| (pair.definition.key().to_owned(), value(pair))).collect()
    };
    json.member("C_eq", &by_name(&|pair| json!(scalar(pair.capacity, "J/K"))))?;
    let errors =
        |pair: &lptn_reduce::Pair| json!({ "step": error(&pair.step), "run": pair.run.as_ref().map(error) });
    json.member("errors", &by_name(&errors))?;
    json.member("recommended", dynamics.recommended.definition.key())?;
    json.member("recommended_by", if dynamics.recommended.by_run { "run" } else { "step" })?;
    json.member("tau_1", &scalar(dynamics.step.slowest().tau, "s"))?;
    let of = match dynamics.window {
        Window::Given(_) => "given",
        Window::Run(_) => "run",
        Window::TimeConstants(_) => "five time constants",
    };
    json.member("window", &json!({ "value": dynamics.window.length(), "unit": "s", "from": of }))?;
    let kelvin = |value: f64| scalar(value, "K");
    json.member("rise", &dynamics.rise.map(kelvin))?;
    json.member("tolerance", &dynamics.tolerance.map(kelvin))
}

fn error(deviation: &Deviation) -> Value {
    json!({
        "max": scalar(deviation.kelvin, "K"),
        "relative": deviation.relative.map(|relative| scalar(relative, "1")),
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
            "points": json!({ "value": bias.points, "unit": "1" }),
            "C_eq": scalar(bias.capacity, "J/K"),
            "R_eq": scalar(bias.resistance, "K/W"),
            "P_inferred": scalar(bias.inferred, "W"),
            "P_true": scalar(bias.heat, "W"),
            "relative": bias.relative().map(|relative| scalar(relative, "1")),
        }),
    }
}

fn scalar(value: f64, unit: &str) -> Scalar {
    Scalar::new(value, unit)
}

fn named<'a>(names: impl Iterator<Item = Cow<'a, str>>, values: &[f64]) -> Value {
    names.zip(values).map(|(name, &value)| (name.into_owned(), json!(scalar(value, "1")))).collect()
}
