//! Distributions behind deviations, right and wrong.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::Distribution::{Lognormal, Normal, Rectangle};
use lptn_units::{Dimension, Type, parse_quantity};
use wrong::check_wrong;

use crate::wrong;

fn close(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs()
}

/// A rectangle of half-width a has the standard deviation a / sqrt(3) (ISO/IEC Guide 98-3, 4.3.7),
/// here by hand: 3 / sqrt(3) = 1.7320508075688772.
#[test]
fn distributions_stand_behind_deviations() {
    let table = [
        ("0 ± 3 K (rectangle)", 0.0, 1.7320508075688772, Rectangle),
        ("25 ± 3 degC (rectangle)", 298.15, 1.7320508075688772, Rectangle),
        ("25 degC ± 3 K(rectangle)", 298.15, 1.7320508075688772, Rectangle),
        ("20 W ± 5 % ( Rectangle )", 20.0, 0.5773502691896257, Rectangle),
        ("50 ± 5 % (rectangle)", 0.5, 0.02886751345948129, Rectangle),
        ("12 ± 3 W/(m^2 K) (lognormal)", 12.0, 3.0, Lognormal),
        ("12 W/(m^2 K) ± 25 % (lognormal)", 12.0, 3.0, Lognormal),
        ("1 ± 0.2 (lognormal)", 1.0, 0.2, Lognormal),
        ("1 ± 0.2 (normal)", 1.0, 0.2, Normal),
        ("12 ± 3 W/(m^2 K)", 12.0, 3.0, Normal),
    ];
    for (text, value, sigma, distribution) in table {
        let quantity = parse_quantity(text, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        let spread = quantity.deviation.unwrap();
        assert!(
            close(quantity.value, value) && close(spread.sigma(value), sigma),
            "{text}: {spread:?}"
        );
        assert_eq!(spread.distribution, distribution, "{text}");
    }
}

#[test]
fn wrong_distributions_say_what_to_write() {
    let kelvin = Some(Type::of(Dimension::TEMPERATURE));
    let alone = "write how far the value may be off before it: \"20 W ± 5 % (rectangle)\"";
    let factor = "leave `(lognormal)` out, or write a separate factor: \"1 ± 0.2 (lognormal)\"";
    let unit = "write \"0 ± 3 K (rectangle)\"";
    let code = "units::distribution";
    check_wrong(&[
        ("0 ± 3 K (uniform)", None, code, "(uniform)", Some("write `(rectangle)`")),
        ("3 W (rectangle)", None, code, "(rectangle)", Some(alone)),
        ("0 ± 3 K (lognormal)", None, "units::lognormal", "(lognormal)", Some(factor)),
        ("0 ± 3 (rectangle)", kelvin, "units::bare_number", "0 ± 3 (rectangle)", Some(unit)),
    ]);
}
