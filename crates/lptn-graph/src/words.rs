//! Quantities in a few words.

use lptn_network::{ConductorFlow, Evaluation, Network, Value};
use lptn_report::{decimals, fixed, prefix, significant};
use lptn_solve::Snapshot;
use lptn_units::Unit;

/// Marks of a scale of colours.
const TICKS: f64 = 8.0;

/// Digits of values.
const DIGITS: usize = 4;

/// A quantity that is not negative with the prefix that suits it: `1.235 kJ/K`.
pub(crate) fn si(value: f64, unit: &str) -> String {
    let (scale, letter) = prefix(value);
    format!("{} {}{unit}", significant(value / scale, DIGITS), micro(letter))
}

/// The scale and name of `unit` with the prefix for `largest`.
pub(crate) fn unit_of(largest: f64, unit: &str) -> (f64, String) {
    let (scale, letter) = prefix(largest);
    (scale, format!("{}{unit}", micro(letter)))
}

fn micro(letter: &str) -> &str {
    if letter == "u" { "µ" } else { letter }
}

/// A resistance in K/W; `mK/W` if it is small, and never `kK/W`.
pub(crate) fn resistance(value: f64) -> String {
    match value {
        x if x >= 0.1 => format!("{} K/W", significant(x, DIGITS)),
        x => si(x, "K/W"),
    }
}

/// The value of a path that is known before a run, if any.
pub(crate) fn flow(flow: ConductorFlow) -> Option<String> {
    match flow {
        ConductorFlow::Conductance(g) => Some(resistance(1.0 / g)),
        ConductorFlow::Radiation(area) => Some(format!("{} m²", significant(area, DIGITS))),
        ConductorFlow::Stream(rate) => Some(si(rate.abs(), "W/K")),
        ConductorFlow::Variable => None,
    }
}

/// The number that a value is in SI units; `None` if it reads anything but parameters.
pub(crate) fn number(network: &Network, value: &Value, scope: &mut Evaluation) -> Option<f64> {
    if is_fixed(network, value) { value.at(scope).ok() } else { None }
}

/// True if a value reads only parameters.
pub(crate) fn is_fixed(network: &Network, value: &Value) -> bool {
    let parameters = || network.parameter_ids().map(|id| network.parameter_slot(id));
    value.slots().iter().all(|slot| parameters().any(|known| known == *slot))
}

/// A letter for a value that is not a number, with whether it depends on time and on temperatures:
/// `P(t)`.
pub(crate) fn letter(letter: &str, depends: (bool, bool)) -> String {
    let on = match depends {
        (true, true) => "(t, T)",
        (true, false) => "(t)",
        (false, true) => "(T)",
        (false, false) => "",
    };
    format!("{letter}{on}")
}

/// A name for several: the one that they share but for their indices, `row[*].base`, else their
/// number.
pub(crate) fn together(names: &[String], what: &str) -> String {
    let mut families = names.iter().map(|name| family(name));
    let first = families.next().unwrap_or_default();
    match (names, families.all(|other| other == first)) {
        ([one], _) => one.clone(),
        (_, true) => first,
        (_, false) => format!("{} {what}", names.len()),
    }
}

/// A name without its indices.
fn family(name: &str) -> String {
    let mut out = String::new();
    for (i, part) in name.split('[').enumerate() {
        match part.split_once(']') {
            Some((_, rest)) if i > 0 => out += &format!("[*]{rest}"),
            _ => out += part,
        }
    }
    out
}

/// The caption of a picture of a state; a reader of the picture sees no warning.
pub(crate) fn caption(network: &Network, state: &Snapshot) -> String {
    let time = || lptn_report::duration(state.time, 4);
    match (state.settled, network.changing_inputs().is_empty()) {
        (true, true) => "steady state".to_owned(),
        (true, false) => format!("steady state for the inputs at {}", time()),
        (false, _) => format!("at {}", time()),
    }
}

/// Temperatures with as many decimals as their span needs.
#[derive(Clone, Debug)]
pub(crate) struct Scale<'a> {
    unit: &'a Unit,
    decimals: usize,
}

impl<'a> Scale<'a> {
    /// For temperatures that lie `span` kelvins apart.
    pub(crate) fn new(unit: &'a Unit, span: f64) -> Self {
        Self { unit, decimals: decimals(span / unit.scale, 3, 1).min(4) }
    }

    /// Round temperatures between two in K: their share of the way, and their numbers.
    pub(crate) fn ticks(&self, span: [f64; 2]) -> Vec<(f64, String)> {
        let [low, high] = span.map(|kelvin| self.unit.from_si(kelvin));
        let marks = lptn_plot::round_marks((low, high), TICKS);
        marks.into_iter().map(|(value, text)| ((value - low) / (high - low), text)).collect()
    }

    /// The unit as it is printed in pictures.
    fn sign(&self) -> String {
        self.unit.text.replace("deg", "°")
    }

    /// A temperature in K without its unit.
    pub(crate) fn number(&self, kelvin: f64) -> String {
        fixed(self.unit.from_si(kelvin), self.decimals)
    }

    /// A temperature in K: `92.7 °C`.
    pub(crate) fn text(&self, kelvin: f64) -> String {
        format!("{} {}", self.number(kelvin), self.sign())
    }

    /// A temperature in K with up to 6 digits: `25 °C`.
    pub(crate) fn given(&self, kelvin: f64) -> String {
        format!("{} {}", significant(self.unit.from_si(kelvin), 6), self.sign())
    }

    /// The coldest and the hottest of several, as one if they look alike.
    pub(crate) fn range(&self, [low, high]: [f64; 2]) -> String {
        match self.number(low) == self.number(high) {
            true => self.text(low),
            false => format!("{} .. {}", self.number(low), self.text(high)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, resistance, si, together};
    use lptn_units::Unit;

    #[test]
    fn quantities_have_the_prefix_that_suits_them() {
        let found = [si(1235.0, "J/K"), si(0.062, "W/K"), si(2e-6, "W/K")];
        assert_eq!(found, ["1.235 kJ/K", "62 mW/K", "2 µW/K"]);
        let found = [3750.0, 0.42, 0.007_706].map(resistance);
        assert_eq!(found, ["3750 K/W", "0.42 K/W", "7.706 mK/W"]);
    }

    #[test]
    fn several_are_called_by_what_they_share() {
        let names = |texts: &[&str]| texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
        assert_eq!(together(&names(&["a[1].base", "a[2].base"]), "paths"), "a[*].base");
        assert_eq!(together(&names(&["a[1].base", "b"]), "paths"), "2 paths");
        assert_eq!(together(&names(&["a[1].base"]), "paths"), "a[1].base");
    }

    #[test]
    fn temperatures_show_their_span() {
        let celsius = Unit::parse("degC").unwrap();
        let scale = Scale::new(&celsius, 0.5);
        assert_eq!(scale.range([300.0, 300.5]), "26.850 .. 27.350 °C");
        assert_eq!(scale.range([300.0, 300.0]), "26.850 °C");
        assert_eq!(scale.given(298.15), "25 °C");
    }
}
