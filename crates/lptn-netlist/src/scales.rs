//! Degrees Celsius that were written as kelvin.

use lptn_data::Diagnostic;
use lptn_network::ZERO_CELSIUS;
use lptn_units::{Quantity, format_number};

use crate::place::Place;
use crate::raw::RawKind;

/// Temperatures below this, in K (-100 degC), are suspect if others are written in degC.
const COLD: f64 = ZERO_CELSIUS - 100.0;

/// Deep space, 2.725 K, however it is rounded.
const SPACE: std::ops::RangeInclusive<f64> = 2.7..=2.73;

/// The scales in which absolute temperatures are written.
#[derive(Debug, Default)]
pub(crate) struct Scales {
    /// True if one is in degC or degF.
    celsius: bool,
    /// The warnings about those in K that are so cold.
    cold: Vec<Diagnostic>,
}

impl Scales {
    /// Notes a temperature of a field.
    pub(crate) fn note(&mut self, place: Place<'_>, quantity: &Quantity) {
        let RawKind::String { text, .. } = &place.raw.kind else { return };
        if !quantity.ty.absolute {
            return;
        }
        let number = text.trim().strip_suffix('K').map(str::trim_end);
        let plain = number.filter(|number| number.parse::<f64>().is_ok());
        self.celsius |= number.is_none();
        // absolute zero is intended: a sky that radiates nothing back
        let space = SPACE.contains(&quantity.value);
        let cold = quantity.value > 0.0 && quantity.value < COLD && !space;
        if let Some(number) = plain.filter(|_| cold) {
            let celsius = format_number(((quantity.value - ZERO_CELSIUS) * 1e6).round() / 1e6);
            let message =
                format!("{} is {} K, {celsius} degC", place.words(), format_number(quantity.value));
            let key =
                if place.key.is_empty() { String::new() } else { format!("{} = ", place.key) };
            let warning = Diagnostic::warning("netlist::cold", message)
                .at(place.raw.span.clone(), "other temperatures of the netlist are in degC")
                .help(format!("did you mean `{key}\"{number} degC\"`?"));
            self.cold.push(warning);
        }
    }

    /// A warning for each temperature that is probably meant in degC, as others are.
    pub(crate) fn doubts(self) -> Vec<Diagnostic> {
        if self.celsius { self.cold } else { Vec::new() }
    }
}
