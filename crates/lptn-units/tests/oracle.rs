//! Values against UDUNITS (the program `udunits2`) and against fend-core.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::process::Command;

use lptn_units::Unit;

/// This crate's unit, UDUNITS' name for it, an SI unit that both read.
const UDUNITS: &[(&str, &str, &str)] = &[
    ("degC/W", "degC/W", "K/W"),
    ("J/(kg degF)", "J/(kg.degF)", "J/(kg.K)"),
    ("BTU/(h ft^2 degF)", "BTU/(h.ft2.degF)", "W/(m2.K)"),
    ("BTU/(h ft degF)", "BTU/(h.ft.degF)", "W/(m.K)"),
    ("rpm", "rpm", "rad/s"),
    ("uW/rpm", "uW/rpm", "W.s/rad"),
    ("hp", "shaft_horsepower", "W"),
    ("PS", "metric_horsepower", "W"),
    ("mmHg", "mmHg", "Pa"),
    ("inHg", "inHg", "Pa"),
    ("torr", "torr", "Pa"),
    ("week", "week", "s"),
    ("gal", "US_liquid_gallon", "m3"),
    ("L/min", "L/min", "m3/s"),
    ("psi", "psi", "Pa"),
    ("lbf", "lbf", "N"),
    ("kgf", "kgf", "N"),
    ("lb", "lb", "kg"),
    ("oz", "avoirdupois_ounce", "kg"),
    ("cSt", "cSt", "m2/s"),
    ("kW h", "kW.h", "J"),
    ("atm", "atm", "Pa"),
    ("mbar", "mbar", "Pa"),
    ("cfm", "ft3/min", "m3/s"),
    ("mil", "mil", "m"),
    ("mi", "mile", "m"),
    ("yd", "yd", "m"),
    ("in", "inch", "m"),
    ("degR", "degR", "K"),
    ("eV", "eV", "J"),
    ("deg", "degree", "rad"),
    ("d", "day", "s"),
    ("tonne", "tonne", "kg"),
    ("%", "%", "1"),
    ("Mohm", "Mohm", "ohm"),
    ("daN", "daN", "N"),
    ("hPa", "hPa", "Pa"),
    ("P", "poise", "Pa.s"),
];

/// `1 x = 5.67826 y` gives 5.67826.
fn udunits(have: &str, want: &str) -> Option<f64> {
    let output = Command::new("udunits2").args(["-H", have, "-W", want]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let first = text.lines().next()?;
    first.split(" = ").nth(1)?.split_whitespace().next()?.parse().ok()
}

#[test]
fn scales_agree_with_udunits() {
    if Command::new("udunits2").arg("-h").output().is_err() {
        assert_ne!(
            std::env::var("LPTN_REQUIRE_ORACLES").as_deref(),
            Ok("1"),
            "udunits2 is required"
        );
        println!("SKIPPED: udunits2 not found; install it with: sudo apt-get install udunits-bin");
        return;
    }
    for (ours, theirs, si) in UDUNITS {
        let scale = Unit::parse(ours).unwrap_or_else(|e| panic!("{ours}: {e}")).scale;
        let expected =
            udunits(theirs, si).unwrap_or_else(|| panic!("udunits2 does not convert {theirs}"));
        // udunits2 prints six digits.
        assert!((scale / expected - 1.0).abs() < 6e-6, "{ours}: {scale}, UDUNITS {expected}");
    }
    let celsius = udunits("25 degC", "K").unwrap();
    assert!((Unit::parse("degC").unwrap().to_si(25.0) - celsius).abs() < 1e-3);
    let fahrenheit = udunits("77 degF", "K").unwrap();
    assert!((Unit::parse("degF").unwrap().to_si(77.0) - fahrenheit).abs() < 1e-3);
}

#[test]
fn scales_agree_with_fend() {
    let table = [
        ("kWh", "kWh", "J"),
        ("BTU", "BTU", "J"),
        ("cal", "calorie", "J"),
        ("hp", "hp", "W"),
        ("psi", "psi", "Pa"),
        ("ft", "ft", "m"),
        ("lb", "lb", "kg"),
        ("L/min", "L/min", "m^3/s"),
        ("J/(kg K)", "J/(kg K)", "m^2/(s^2 K)"),
        ("uW/rpm", "uW/rpm", "W s/rad"),
        ("rpm", "rpm", "rad/s"),
        ("mph", "mph", "m/s"),
        ("gal", "gallon", "m^3"),
        ("W/(m^2 K)", "W/(m^2 K)", "kg/(s^3 K)"),
    ];
    for (ours, theirs, si) in table {
        let mut context = fend_core::Context::new();
        let question = format!("(1 {theirs}) to ({si}) to 16 sf");
        let answer = fend_core::evaluate(&question, &mut context)
            .unwrap_or_else(|e| panic!("{question}: {e}"));
        let text = answer.get_main_result().trim_start_matches("approx. ").to_owned();
        let number = text.split_whitespace().next().unwrap_or_default();
        let expected: f64 = number.parse().unwrap_or_else(|e| panic!("{question} = {text}: {e}"));
        let scale = Unit::parse(ours).unwrap().scale;
        // fend rounds the BTU to nine digits.
        let tolerance = if ours == "BTU" { 1e-8 } else { 1e-12 };
        assert!((scale / expected - 1.0).abs() < tolerance, "{ours}: {scale}, fend {text}");
    }
}
