//! The parameters of a netlist, with the ranges of their sliders.

use lptn_answer::input::Input;
use lptn_network::ParameterId;
use lptn_report::significant;
use serde_json::{Value, json};

/// Ratio of the ends of a slider to its value.
const RATIO: f64 = 4.0;

/// Half the range of a temperature in K.
const TEMPERATURES: f64 = 50.0;

/// A parameter and the range of its slider, in the unit in which the netlist writes it.
#[derive(Clone, Debug)]
pub struct Slider {
    /// Its name, as `--set` takes it.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// The unit of the value; empty for numbers.
    pub unit: String,
    /// The ends of the range.
    pub range: [f64; 2],
    /// True if equal ways of the slider are equal ratios.
    pub log: bool,
}

/// A slider for each parameter, in the order of the netlist.
pub fn sliders(input: &Input) -> Vec<Slider> {
    input.netlist.network.parameter_ids().map(|id| slider(input, id)).collect()
}

fn slider(input: &Input, id: ParameterId) -> Slider {
    let network = &input.netlist.network;
    let (parameter, unit) = (&network.parameters()[id.index()], input.unit_of(id));
    let value = unit.from_si(network.parameter_value(id));
    let (range, log) = match value {
        _ if parameter.ty.absolute => {
            let half = TEMPERATURES / unit.scale;
            ([value - half, value + half], false)
        }
        0.0 => ([-1.0, 1.0], false),
        value if value < 0.0 => ([value * RATIO, value / RATIO], false),
        value => ([value / RATIO, value * RATIO], true),
    };
    let unit = if matches!(unit.text.as_str(), "1" | "-") { String::new() } else { unit.text };
    Slider { name: parameter.name.clone(), value, unit, range, log }
}

/// The parts of it that a page shows.
impl From<Slider> for Value {
    fn from(Slider { name, value, unit, range, log }: Slider) -> Self {
        let text = significant(value, 6);
        json!({
            "name": name, "value": value, "text": text, "unit": unit, "range": range, "log": log,
        })
    }
}
