//! Numbers and units as they are said or written elsewhere: each is refused with what to write.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Type, parse_quantity, parse_value};
use wrong::{check_wrong, is_parameter};

#[path = "common/wrong.rs"]
mod wrong;

const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

#[test]
fn numbers_with_separators_show_those_without() {
    let decimal = "units::decimal_comma";
    let groups = "units::digit_groups";
    check_wrong(&[
        (
            "1,000 W",
            None,
            decimal,
            ",",
            Some("write \"1000 W\" if the comma separates thousands, \"1.000 W\" if it is a decimal comma"),
        ),
        ("0,350 K/W", None, decimal, ",", Some("write \"0.350 K/W\"")),
        ("-1,5 K/W", None, decimal, ",", Some("write \"-1.5 K/W\"")),
        ("1,000.5 W", None, decimal, ",", Some("write \"1000.5 W\"")),
        ("1.000,5 W", None, decimal, ",", Some("write \"1000.5 W\"")),
        ("1,000,000 W", None, decimal, ",", Some("write \"1000000 W\"")),
        (
            "1,00,000 W",
            None,
            decimal,
            ",",
            Some("write a decimal point, and no separators between the digits"),
        ),
        ("1,5 Watts", None, decimal, ",", Some("write \"1.5 W\"")),
        ("1,5 ± 0,5 W", None, decimal, ",", Some("write \"1.5 ± 0.5 W\"")),
        ("1.5 ± 0,5 W", None, decimal, ",", Some("write \"1.5 ± 0.5 W\"")),
        ("1,5 * fan", None, decimal, ",", Some("write \"1.5 * fan\"")),
        ("1 000 W", None, groups, " ", Some("write \"1000 W\"")),
        ("1'000 W", None, groups, "'", Some("write \"1000 W\"")),
        ("1.000.000 W", None, groups, ".", Some("write \"1000000 W\"")),
        ("12 000.5 W", None, groups, " ", Some("write \"12000.5 W\"")),
    ]);
    for text in ["1.000 W", "1_000 W", "5 1/min", ".5 W"] {
        assert!(parse_quantity(text, None).is_ok(), "{text}");
    }
}

#[test]
fn units_as_they_are_said_show_those_as_they_are_written() {
    let unknown = "units::unknown_unit";
    check_wrong(&[
        ("20 degrees C", None, unknown, "degrees", Some("did you mean \"20 degC\"?")),
        ("20 deg C", None, unknown, "C", Some("did you mean \"20 degC\"?")),
        ("20 ° C", None, unknown, "C", Some("did you mean \"20 degC\"?")),
        ("68 deg F", None, unknown, "F", Some("did you mean \"68 degF\"?")),
        ("20 ºC", None, unknown, "ºC", Some("did you mean \"20 degC\"?")),
        ("20 ˚C", None, unknown, "˚C", Some("did you mean \"20 degC\"?")),
        ("60 Nm", None, unknown, "Nm", Some("did you mean \"60 N m\"?")),
        ("60 Nm/rad", None, unknown, "Nm", Some("did you mean \"60 N m/rad\"?")),
        ("2 rad/Nm", None, unknown, "Nm", Some("did you mean \"2 rad/(N m)\"?")),
        ("2 Nm^2", None, unknown, "Nm", None),
        ("2 sqm", None, unknown, "sqm", Some("did you mean \"2 m^2\"?")),
        ("12 W/(sqm K)", None, unknown, "sqm", Some("did you mean \"12 W/(m^2 K)\"?")),
        ("7000 U/min", None, unknown, "U", Some("did you mean \"7000 rpm\"?")),
    ]);
}

#[test]
fn a_parameter_in_the_place_of_a_unit_needs_an_operator() {
    let code = "units::missing_operator";
    check_wrong(&[
        ("2 fan", None, code, "fan", Some("write \"2 * fan\"")),
        ("2fan", None, code, "fan", Some("write \"2 * fan\"")),
        ("2 T_amb", None, code, "T_amb", Some("write \"2 * T_amb\"")),
    ]);
}

#[test]
fn a_temperature_without_unit_may_be_in_kelvin() {
    check_wrong(&[
        (
            "293.15",
            Some(ABSOLUTE),
            "units::bare_number",
            "293.15",
            Some("write \"293.15 degC\" or \"293.15 K\""),
        ),
        ("-20", Some(ABSOLUTE), "units::bare_number", "-20", Some("write \"-20 degC\"")),
    ]);
}

/// What a help shows between quotes, pasted, reads.
#[test]
fn proposals_read() {
    let wrong = [
        "1,000 W",
        "1,5 Watts",
        "1 000 W",
        "1.000,5 kW",
        "20 deg C",
        "60 Nm",
        "2 rad/Nm",
        "7000 U/min",
        "2 fan",
        "1,5 ± 0,5 W",
        "-2^2 * fan",
        "[W]",
        "fan * [W]",
    ];
    for text in wrong {
        let help = parse_value(text, None, &is_parameter).expect_err(text).help().unwrap();
        let proposals: Vec<&str> = help.split('"').skip(1).step_by(2).collect();
        assert!(!proposals.is_empty(), "{text}: {help}");
        for proposal in proposals {
            assert!(parse_value(proposal, None, &is_parameter).is_ok(), "{text}: {proposal}");
        }
    }
}
