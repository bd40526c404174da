//! Powers of the speed, as text.

use lptn_units::Rational;

/// `omega`, `omega^3`, `omega^(5/3)`; also of a unit such as `rpm`.
pub(crate) fn power_name(base: &str, exponent: Rational) -> String {
    match exponent.as_integer() {
        Some(1) => base.to_owned(),
        Some(whole) if whole >= 0 => format!("{base}^{whole}"),
        _ => format!("{base}^({}/{})", exponent.num(), exponent.den()).replace("/1)", ")"),
    }
}
