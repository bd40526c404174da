//! Units as loggers spell them.

use lptn_units::{Unit, UnitError};

/// Spellings of units that are none of lptn's, in lower case and without blanks, with the unit.
///
/// `ﾟ` is the half-width mark that Japanese loggers write for the degree sign.
const SPELLINGS: [(&str, &str); 21] = [
    ("degc", "degC"),
    ("deg.c", "degC"),
    ("ºc", "degC"),
    ("˚c", "degC"),
    ("ﾟc", "degC"),
    ("゜c", "degC"),
    ("℃", "degC"),
    ("°c", "degC"),
    ("celsius", "degC"),
    ("grad c", "degC"),
    ("degf", "degF"),
    ("deg.f", "degF"),
    ("ºf", "degF"),
    ("°f", "degF"),
    ("℉", "degF"),
    ("volts", "V"),
    ("vdc", "V"),
    ("sec", "s"),
    ("seconds", "s"),
    ("sek", "s"),
    ("sekunden", "s"),
];

/// The unit of a header, in any of its spellings.
///
/// # Errors
/// The error of a text that is not a unit.
pub(crate) fn unit(text: &str) -> Result<Unit, UnitError> {
    Unit::parse(text).or_else(|error| {
        let bare: String = text.to_lowercase().split_whitespace().collect();
        match SPELLINGS.iter().find(|(spelling, _)| *spelling == bare) {
            Some((_, unit)) => Unit::parse(unit),
            None => Err(error),
        }
    })
}

/// True for a text that is a unit, `-` for a plain number, or `C`, which is refused with its fix.
pub(crate) fn is_unit(text: &str) -> bool {
    !text.is_empty() && (["-", "C"].contains(&text) || unit(text).is_ok())
}

/// The name and the unit of `ring (°C)`, `ring/°C` or `ring / °C`;
/// `None` if the second is not a unit.
pub(crate) fn apart(header: &str) -> Option<(&str, &str)> {
    let split = match header.strip_suffix(')') {
        Some(rest) => rest.rsplit_once('('),
        None => header.rsplit_once('/'),
    };
    let (name, unit) = split.map(|(name, unit)| (name.trim(), unit.trim()))?;
    (!name.is_empty() && is_unit(unit) && unit.parse::<f64>().is_err()).then_some((name, unit))
}

#[cfg(test)]
mod tests {
    use super::{apart, unit};

    #[test]
    fn degrees_are_read_in_every_spelling() {
        for text in ["°C", "degC", "Deg C", "deg. C", "ﾟC", "º C", "℃", "Celsius"] {
            assert!(
                unit(text)
                    .is_ok_and(|unit| unit.ty.absolute && (unit.to_si(0.0) - 273.15).abs() < 1e-9),
                "{text}"
            );
        }
        assert!(unit("furlong").is_err());
    }

    #[test]
    fn a_unit_follows_its_name_in_brackets_or_behind_a_stroke() {
        assert_eq!(apart("ring (°C)"), Some(("ring", "°C")));
        assert_eq!(apart("T1/°C"), Some(("T1", "°C")));
        assert_eq!(apart("speed / rpm"), Some(("speed", "rpm")));
        for none in ["ring", "Date/Time", "on/off", "ring (left)", "(°C)"] {
            assert_eq!(apart(none), None, "{none}");
        }
    }
}
