//! Coefficients and speeds in the units of a reader.

use lptn_report::significant;
use lptn_units::{Dimension, Unit};

/// The unit in which speeds are shown.
#[derive(Clone, Debug)]
pub(super) struct SpeedUnit(pub(crate) Unit);

impl SpeedUnit {
    pub(super) fn rpm() -> Self {
        let ty = lptn_units::Type::of(Dimension::ANGULAR_VELOCITY);
        let scale = std::f64::consts::TAU / 60.0;
        Self(Unit { text: "rpm".to_owned(), scale, offset: 0.0, ty })
    }

    /// `2646 rpm`.
    pub(super) fn speed(&self, si: f64) -> String {
        format!("{} {}", significant(self.0.from_si(si), 4), self.0.text)
    }

    /// `1000 … 7000 rpm`.
    pub(super) fn range(&self, (low, high): (f64, f64)) -> String {
        format!("{} .. {}", significant(self.0.from_si(low), 4), self.speed(high))
    }

    /// A unit over that of the speed: `K/rpm`, `K/(rad/s)`.
    pub(super) fn per(&self, unit: &str) -> String {
        let speed = &self.0.text;
        if speed.contains(['/', ' ']) {
            format!("{unit}/({speed})")
        } else {
            format!("{unit}/{speed}")
        }
    }

    /// A value with its standard error and a unit that suits its size: `87.2 ± 0.3 uW/rpm^(5/3)`.
    pub(super) fn quantity(&self, value: f64, error: Option<f64>, of: Dimension) -> String {
        let (scale, unit) = self.unit(value, of);
        let number = with_error(value / scale, error.map(|error| error / scale));
        if unit.is_empty() { number } else { format!("{number} {unit}") }
    }

    /// A unit for a value: its size in SI and its text.
    /// It is made of `W` and the unit of the speed if the dimension allows it.
    pub(super) fn unit(&self, value: f64, of: Dimension) -> (f64, String) {
        let [_, mass, .., angle] = of.exponents();
        let parts = Dimension::ANGULAR_VELOCITY.checked_pow(angle);
        let parts =
            parts.zip(Dimension::POWER.checked_pow(mass)).and_then(|(s, p)| s.checked_mul(p));
        if of.is_none() {
            return (1.0, String::new());
        }
        if parts != Some(of) || !(mass.as_integer() == Some(1) || mass.is_zero()) {
            return (1.0, of.si_unit());
        }
        let per_speed = self.0.scale.powf(angle.to_f64());
        let power = |base: &str, num: i32, den: i32| match (num, den) {
            (1, 1) => base.to_owned(),
            (_, 1) => format!("{base}^{num}"),
            _ => format!("{base}^({num}/{den})"),
        };
        let name = &self.0.text;
        if mass.is_zero() {
            return (per_speed, power(name, angle.num(), angle.den()));
        }
        let (factor, prefix) = prefix(value / per_speed);
        let speeds = match angle.num() {
            0 => String::new(),
            n if n < 0 => format!("/{}", power(name, -n, angle.den())),
            n => format!(" {}", power(name, n, angle.den())),
        };
        (per_speed * factor, format!("{prefix}W{speeds}"))
    }
}

/// Probability of chance alone as text: `p = 0.42`.
pub(super) fn chance(probability: f64) -> String {
    match probability {
        p if p < 1e-4 => "p < 0.0001".to_owned(),
        p => format!("p = {}", significant(p, 2)),
    }
}

/// The power of 1000 that brings a value to 1 … 1000, and its SI prefix.
fn prefix(value: f64) -> (f64, &'static str) {
    const PREFIXES: [(f64, &str); 8] = [
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "u"),
        (1e-9, "n"),
        (1e-12, "p"),
        (1e-15, "f"),
    ];
    let size = value.abs();
    if size == 0.0 || !size.is_finite() {
        return PREFIXES[2];
    }
    PREFIXES.iter().find(|(scale, _)| size >= 0.9999 * scale).copied().unwrap_or(PREFIXES[7])
}

/// A value with as many digits as its standard error has meaning: two of the error.
pub(super) fn with_error(value: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| error.is_finite() && *error > 0.0) else {
        return significant(value, 4);
    };
    let rounded: f64 = format!("{error:.1e}").parse().unwrap_or(error);
    #[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64 is below 400")]
    let exponent = rounded.log10().floor() as i32;
    let size = value.abs().max(rounded);
    if !(1e-4..1e6).contains(&size) || exponent < -9 {
        return format!("{} ± {}", significant(value, 4), significant(error, 2));
    }
    let decimals = usize::try_from(1 - exponent).unwrap_or(0);
    format!("{value:.decimals$} ± {rounded:.decimals$}")
}

#[cfg(test)]
mod tests {
    use lptn_units::{Dimension, Unit};

    use super::{SpeedUnit, with_error};

    #[test]
    fn errors_have_two_digits() {
        assert_eq!(with_error(87.1896, Some(0.2692)), "87.19 ± 0.27");
        assert_eq!(with_error(223.5215, Some(12.3)), "224 ± 12");
        assert_eq!(with_error(1.67158, Some(0.01408)), "1.672 ± 0.014");
        assert_eq!(with_error(1.67158, Some(0.0996)), "1.67 ± 0.10");
        assert_eq!(with_error(13095.13, Some(641.4)), "13095 ± 640");
        assert_eq!(with_error(44.0312, None), "44.03");
    }

    #[test]
    fn coefficients_are_in_units_of_the_speeds() {
        let rpm = SpeedUnit::rpm();
        let si = |text: &str| Unit::parse(text).unwrap();
        let check = |text: &str, value: f64, shown: &str| {
            let unit = si(text);
            assert_eq!(rpm.quantity(unit.to_si(value), None, unit.ty.dimension), shown);
        };
        check("W/rpm^(5/3)", 87e-6, "87 uW/rpm^(5/3)");
        check("W/rpm", 0.02, "20 mW/rpm");
        check("W/rpm^3", 3.4e-10, "340 pW/rpm^3");
        check("rpm", 7366.4, "7366 rpm");
        check("W", 223.5, "223.5 W");
        check("W/K", 3.3, "3.3 W/K");
        assert_eq!(rpm.quantity(1.67, Some(0.1), Dimension::NONE), "1.67 ± 0.10");
    }
}
