//! Numbers and units as they are said or written elsewhere: each is refused with what to write.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Dimension, Expression, NoNames, Type, parse_quantity, parse_value};
use wrong::{check_wrong, is_parameter};

use crate::wrong;

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
            Some(
                "write \"1000 W\" if the comma separates thousands, \"1.000 W\" if it is a decimal \
                 comma",
            ),
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
fn units_that_are_joined_otherwise_show_their_product() {
    let unknown = "units::unknown_unit";
    check_wrong(&[
        ("475 J/kgK", None, unknown, "kgK", Some("did you mean \"475 J/(kg K)\"?")),
        ("475 J/(kg.K)", None, unknown, ".", Some("did you mean \"475 J/(kg K)\"?")),
        ("475 J.kg-1.K-1", None, unknown, ".", Some("did you mean \"475 J kg^-1 K^-1\"?")),
        ("475 J kg-1 K-1", None, unknown, "-", Some("did you mean \"475 J kg^-1 K^-1\"?")),
        ("3 mPas", None, unknown, "mPas", Some("did you mean \"3 mPa s\"?")),
        ("12 W/m2K", None, unknown, "m2K", Some("did you mean \"12 W/(m^2 K)\"?")),
        ("2 Kw", None, unknown, "Kw", Some("did you mean \"2 kW\"?")),
        ("2 kgs", None, unknown, "kgs", Some("did you mean \"2 kg\"?")),
        ("12 W/(m**2*K)", None, unknown, "*", Some("did you mean \"12 W/(m^2 K)\"?")),
        ("7 K per W", None, unknown, "per", Some("did you mean \"7 K/W\"?")),
        ("25 Minuten", None, unknown, "Minuten", Some("did you mean \"25 min\"?")),
        ("5 J/kg-K", None, unknown, "-", Some("did you mean \"5 J/(kg K)\"?")),
        ("2 kgm2", None, unknown, "kgm2", Some("did you mean \"2 kg m^2\"?")),
        ("2 J/g°C", None, unknown, "g°C", Some("did you mean \"2 J/(g °C)\"?")),
    ]);
}

#[test]
fn powers_of_ten_and_units_without_brackets_show_what_reads_and_is_right() {
    let ten = "units::power_of_ten";
    let bracket = "units::unbracketed_unit";
    check_wrong(&[
        ("7.7*10^-3 K/W", None, ten, "7.7*10^-3 K/W", Some("write \"7.7e-3 K/W\"")),
        ("7.7x10-3 K/W", None, ten, "7.7x10-3 K/W", Some("write \"7.7e-3 K/W\"")),
        ("2 × 10^(5) W", None, ten, "2 × 10^(5) W", Some("write \"2e5 W\"")),
        ("T_amb + 5 degC", None, bracket, "degC", Some("write \"T_amb + 5 [K]\"")),
        ("10 K * fan + 25 degC", None, bracket, "K", Some("write \"10 [K] * fan + 25 [degC]\"")),
        ("1200-1300 J/K", None, "units::syntax", "-", None),
    ]);
}

#[test]
fn a_speed_per_minute_shows_rpm() {
    let speed = Some(Type::of(Dimension::ANGULAR_VELOCITY));
    let help =
        |text: &str| parse_value(text, speed, &is_parameter).expect_err(text).help().unwrap();
    assert_eq!(
        help("3000 1/min"),
        "write \"3000 rpm\" for revolutions, or use rad/s, deg/s or rpm"
    );
    assert_eq!(help("3000 /min"), "write \"3000 rpm\" for revolutions, or use rad/s, deg/s or rpm");
    assert_eq!(help("50 Hz"), "write \"50 rev/s\" for revolutions, or use rad/s, deg/s or rpm");
    assert_eq!(help("3000 min-1"), "did you mean \"3000 rpm\"?");
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
        ("293.15", Some(ABSOLUTE), "units::bare_number", "293.15", Some("write \"293.15 K\"")),
        (
            "500",
            Some(ABSOLUTE),
            "units::bare_number",
            "500",
            Some("write \"500 degC\" or \"500 K\""),
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

#[test]
fn messages_name_what_was_found() {
    let message = |text: &str| Expression::parse(text).unwrap_err().to_string();
    assert!(message("x +").contains("the end") && message("x + )").contains("`)`"));
    let call = Expression::parse("2 * sqrt(1, 2)").unwrap().compile(&NoNames, None).unwrap_err();
    assert_eq!(call[0].code(), "units::arity");
    assert!(call[0].to_string().contains("`sqrt`"), "{}", call[0]);
    // a text too long to be a slip gets no proposal
    let long = format!("1,5 {} W", " ".repeat(250));
    let help = parse_quantity(&long, None).unwrap_err().help().unwrap();
    assert_eq!(help, "write a decimal point, and no separators between the digits");
}
