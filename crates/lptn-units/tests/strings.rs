//! A table of strings, right and wrong. The numbers come from the definitions of the units (SI
//! Brochure, NIST SP 811), worked out in decimal arithmetic with 40 digits, not from this crate.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Dimension, Type, Unit, Written, parse_quantity, parse_value};
use wrong::{check_wrong, is_parameter};

use crate::wrong;

const NONE: Type = Type::SCALAR;
const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;
const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);
const ROTATION: Type = Type::of(Dimension::ANGULAR_VELOCITY);
const RESISTANCE: Type = Type::of(Dimension::RESISTANCE);
const FILM: Type = Type::of(Dimension::FILM_COEFFICIENT);
const POWER: Type = Type::of(Dimension::POWER);
const ENERGY: Type = Type::of(Dimension::ENERGY);
const LENGTH: Type = Type::of(Dimension::LENGTH);
const TIME: Type = Type::of(Dimension::TIME);
const PRESSURE: Type = Type::of(Dimension::PRESSURE);
const FLOW: Type = Type::of(Dimension::VOLUME_FLOW);
const SPECIFIC_HEAT: Type = Type::of(Dimension::SPECIFIC_HEAT);
const CONDUCTIVITY: Type = Type::of(Dimension::CONDUCTIVITY);
const DENSITY: Type = Type::of(Dimension::DENSITY);
const MASS: Type = Type::of(Dimension::MASS);

fn close(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs()
}

/// Every one of these reads with its own type expected, and as a whole string of unknown type.
fn check_right(table: &[(&str, Type, f64)]) {
    for (text, ty, expected) in table {
        let quantity = parse_quantity(text, Some(*ty)).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(close(quantity.value, *expected), "{text}: {} is not {expected}", quantity.value);
        assert_eq!((quantity.ty, quantity.deviation), (*ty, None), "{text}");
        let written = parse_value(text, Some(*ty), &|_| false).unwrap();
        assert!(matches!(written, Written::Quantity(q) if q == quantity), "{text}");
    }
}

#[test]
fn the_twenty_one_strings() {
    check_right(&[
        ("25 degC", ABSOLUTE, 298.15),
        ("7000 rpm", ROTATION, 733.0382858376184),
        ("0.42 degC/W", RESISTANCE, 0.42),
        ("475 J/(kg K)", SPECIFIC_HEAT, 475.0),
        ("3 L/min", FLOW, 5e-05),
        ("1 BTU/(h ft^2 degF)", FILM, 5.678263341113488),
        ("0.3 K/W", RESISTANCE, 0.3),
        ("2.31 kg", MASS, 2.31),
        ("20 W/(m^2 K)", FILM, 20.0),
        ("167 W/(m K)", CONDUCTIVITY, 167.0),
        ("7850 kg/m^3", DENSITY, 7850.0),
        ("25 min", TIME, 1500.0),
        ("220.6 W", POWER, 220.6),
        ("7.7 mK/W", RESISTANCE, 0.0077),
        ("5 mm", LENGTH, 0.005),
        ("300 K", ABSOLUTE, 300.0),
        ("2 bar", PRESSURE, 2e5),
        ("4 kJ/K", Type::of(Dimension::CAPACITY), 4000.0),
        ("0.1 m^2", Type::of(Dimension::AREA), 0.1),
    ]);
    let sloppy = parse_quantity("12 W/m2K", Some(FILM)).unwrap_err();
    assert_eq!(sloppy.help().as_deref(), Some("did you mean \"12 W/(m^2 K)\"?"));
    let churning = parse_quantity("87 uW/rpm^(5/3)", None).unwrap();
    assert!(close(churning.value, 0.003739425534996411), "{}", churning.value);
    assert_eq!(churning.ty.to_string(), "W s^(5/3)/rad^(5/3)");
}

#[test]
fn temperatures_and_rotations() {
    check_right(&[
        ("25.5 °C", ABSOLUTE, 298.65),
        ("25.5 ℃", ABSOLUTE, 298.65),
        ("77 degF", ABSOLUTE, 298.15),
        ("77 °F", ABSOLUTE, 298.15),
        ("540 degR", ABSOLUTE, 300.0),
        ("-273.15 degC", ABSOLUTE, 0.0),
        ("-459.67 degF", ABSOLUTE, 0.0),
        ("−20 degC", ABSOLUTE, 253.15),
        ("1e-5 K", DIFFERENCE, 1e-5),
        ("540 degR", DIFFERENCE, 300.0),
        ("50 rev/s", ROTATION, 314.1592653589793),
        ("360 deg/s", ROTATION, std::f64::consts::TAU),
        ("1.5 krpm", ROTATION, 157.07963267948966),
        ("3 rad/s", ROTATION, 3.0),
        ("90 deg", Type::of(Dimension::ANGLE), std::f64::consts::FRAC_PI_2),
        ("90°", Type::of(Dimension::ANGLE), std::f64::consts::FRAC_PI_2),
        ("50 Hz", Type::of(Dimension::FREQUENCY), 50.0),
        ("100 N m rad/s", POWER, 100.0),
    ]);
}

#[test]
fn other_units_and_other_spellings() {
    check_right(&[
        ("0.7", NONE, 0.7),
        (" +5e2 ", NONE, 500.0),
        ("1_000 W", POWER, 1000.0),
        (".5 W", POWER, 0.5),
        ("80 %", NONE, 0.8),
        ("5 ppm", NONE, 5e-6),
        ("0.39 %/K", Type::of(Dimension::EXPANSION_COEFFICIENT), 0.0039),
        ("1 hp", POWER, 745.6998715822702),
        ("3412 BTU/h", POWER, 999.9584914276222),
        ("1 BTU/(lb degF)", SPECIFIC_HEAT, 4186.8),
        ("0.25 BTU/(h ft degF)", CONDUCTIVITY, 0.4326836665928478),
        ("62.4 lb/ft^3", DENSITY, 999.5521145351128),
        ("100 ft lbf", ENERGY, 135.58179483314004),
        ("14.5 psi", PRESSURE, 99973.98075094123),
        ("1 atm", PRESSURE, 101325.0),
        ("5 gal", Type::of(Dimension::VOLUME), 0.01892705892),
        ("2 gpm", FLOW, 0.0001261803928),
        ("120 cfm", FLOW, 0.056633693184),
        ("6 lpm", FLOW, 1e-4),
        ("60 mph", Type::of(Dimension::VELOCITY), 26.8224),
        ("20 mil", LENGTH, 0.000508),
        ("3 oz", MASS, 0.085048569375),
        ("1.5 kWh", ENERGY, 5.4e6),
        ("1 eV", ENERGY, 1.602176634e-19),
        ("1 cal", ENERGY, 4.184),
        ("100 cSt", Type::of(Dimension::KINEMATIC_VISCOSITY), 1e-4),
        ("13 mm^2/s", Type::of(Dimension::KINEMATIC_VISCOSITY), 13e-6),
        ("5 cP", Type::of(Dimension::DYNAMIC_VISCOSITY), 0.005),
        ("2 d", TIME, 172800.0),
        ("3 ms", TIME, 0.003),
        ("3 m s", Type::of(Dimension::LENGTH.checked_mul(Dimension::TIME).unwrap()), 3.0),
        ("5 µm", LENGTH, 5e-6),
        ("5 μm", LENGTH, 5e-6),
        ("5 um", LENGTH, 5e-6),
        ("3 N·m", ENERGY, 3.0),
        ("3 N*m", ENERGY, 3.0),
        ("2 * m", LENGTH, 2.0),
        ("2 / s", Type::of(Dimension::FREQUENCY), 2.0),
        ("2 1/s", Type::of(Dimension::FREQUENCY), 2.0),
        ("12 W/(m²·K)", FILM, 12.0),
        ("12 W·m⁻²·K⁻¹", FILM, 12.0),
        ("12 W/m^2/K", FILM, 12.0),
        ("12 W m^-2 K^-1", FILM, 12.0),
        ("4 m^0.5 m^(1/2)", LENGTH, 4.0),
        ("10 V A", POWER, 10.0),
        ("2 A^2 Ω", POWER, 2.0),
        ("5 kohm", Type::of(Dimension::ELECTRICAL_RESISTANCE), 5000.0),
    ]);
}

#[test]
fn deviations() {
    let table = [
        ("87 ± 15 uW/rpm^(5/3)", 0.003739425534996411, 0.0006447285405166226),
        ("25 ± 0.5 degC", 298.15, 0.5),
        ("25 degC ± 0.5 K", 298.15, 0.5),
        ("25 degC ± 0.9 degF", 298.15, 0.5),
        ("77 ± 0.9 degF", 298.15, 0.5),
        ("20 W +/- 5 %", 20.0, 1.0),
        ("-20 W ± 5 %", -20.0, 1.0),
        ("5 ± 0 K", 5.0, 0.0),
        ("2 kW ± 30 W", 2000.0, 30.0),
    ];
    for (text, value, deviation) in table {
        let quantity = parse_quantity(text, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(close(quantity.value, value), "{text}");
        assert!(close(quantity.sigma(), deviation), "{text}");
    }
}

/// Percents and factors follow a value that is changed, deviations with a unit do not.
#[test]
fn a_deviation_in_percent_is_of_any_value() {
    let half_width = 3_f64.sqrt();
    let table = [
        ("100 W ± 5 %", 5.0, 50.0),
        ("-100 W ± 5 %", 5.0, 50.0),
        ("100 ± 5 W", 5.0, 5.0),
        ("100 W ± 5 % (rectangle)", 5.0 / half_width, 50.0 / half_width),
        ("100 ± 5 W (rectangle)", 5.0 / half_width, 5.0 / half_width),
        ("100 W ± 5 % (lognormal)", 5.0, 50.0),
        ("100 ± 5 W (lognormal)", 5.0, 50.0),
    ];
    for (text, own, other) in table {
        let quantity = parse_quantity(text, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        let spread = quantity.deviation.unwrap();
        assert!(close(spread.sigma(quantity.value), own), "{text}");
        assert!(
            close(spread.sigma(1000.0), other) && close(spread.sigma(-1000.0), other),
            "{text}"
        );
        assert!(!spread.is_certain(), "{text}");
        if text.contains("lognormal") {
            assert!([1.0, 100.0].iter().all(|at| close(spread.of_logarithm(*at), 0.05)), "{text}");
        }
    }
    assert!(parse_quantity("100 W ± 0 %", None).unwrap().deviation.unwrap().is_certain());
}

/// `50 %` is 0.5, and `50 ± 5 %` was 50 ± 2.5.
#[test]
fn percent_is_a_unit_like_any_other_before_a_deviation_too() {
    let table = [
        ("50 ± 5 %", 0.5, 0.05),
        ("-50 +- 5 %", -0.5, 0.05),
        ("97 ± 1%", 0.97, 0.01),
        ("0.4 ± 0.1 %/K", 0.004, 0.001),
        ("0.4 %/K ± 5 %", 0.004, 0.0002),
    ];
    for (text, value, deviation) in table {
        let quantity = parse_quantity(text, None).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(close(quantity.value, value), "{text}");
        assert!(close(quantity.sigma(), deviation), "{text}");
    }
    let code = "units::percent_deviation";
    for text in ["0.8 ± 5 %", "80 % ± 5 %", "20 +- 5 % W", "1.2 ± 5 % mK/W", "0 ± 1 %", "3 ± 10 %"]
    {
        assert_eq!(parse_quantity(text, None).unwrap_err().code(), code, "{text}");
    }
}

#[test]
fn wrong_units_show_the_right_ones() {
    check_wrong(&[
        ("25 degX", None, "units::unknown_unit", "degX", Some("did you mean \"25 degC\"?")),
        ("25 C", None, "units::unknown_unit", "C", Some("did you mean \"25 degC\"?")),
        (
            "1 BTU/(h ft^2 F)",
            None,
            "units::unknown_unit",
            "F",
            Some("did you mean \"1 BTU/(h ft^2 degF)\"?"),
        ),
        ("0.5 Watts", None, "units::unknown_unit", "Watts", Some("did you mean \"0.5 W\"?")),
        ("3 kgs", None, "units::unknown_unit", "kgs", Some("did you mean \"3 kg\"?")),
        ("3 m3", None, "units::unknown_unit", "m3", Some("did you mean \"3 m^3\"?")),
        ("12 W/(m2 K)", None, "units::unknown_unit", "m2", Some("did you mean \"12 W/(m^2 K)\"?")),
        (
            "12 W m-2 K-1",
            None,
            "units::unknown_unit",
            "-",
            Some("did you mean \"12 W m^-2 K^-1\"?"),
        ),
        ("12 W/m²K", None, "units::ambiguous_product", "K", Some("write \"12 W/(m² K)\"")),
        ("5 J/kg K", None, "units::ambiguous_product", "K", Some("write \"5 J/(kg K)\"")),
        ("5 J/kg*K", None, "units::ambiguous_product", "*K", Some("write \"5 J/(kg K)\"")),
        ("9 fooo", None, "units::unknown_unit", "fooo", None),
        ("5e W", None, "units::unknown_unit", "e", None),
    ]);
}

#[test]
fn wrong_types_say_what_is_due() {
    check_wrong(&[
        ("5", Some(RESISTANCE), "units::bare_number", "5", Some("write \"5 K/W\"")),
        ("5", Some(ABSOLUTE), "units::bare_number", "5", Some("write \"5 degC\"")),
        (
            "0.42 K/W/s",
            Some(RESISTANCE),
            "units::dimension",
            "0.42 K/W/s",
            Some("write \"0.42 K/W\""),
        ),
        (
            "0.42 W/K",
            Some(RESISTANCE),
            "units::dimension",
            "0.42 W/K",
            Some("write \"1 / (0.42 [W/K])\""),
        ),
        (
            "5 W",
            Some(NONE),
            "units::dimension",
            "5 W",
            Some("the value must come out without a unit"),
        ),
        (
            "25 degC",
            Some(POWER),
            "units::dimension",
            "25 degC",
            Some("the value must come out in W"),
        ),
    ]);
}

#[test]
fn wrong_temperatures_and_products_say_what_is_due() {
    check_wrong(&[
        ("5 degC", Some(DIFFERENCE), "units::difference_wanted", "5 degC", Some("write \"5 K\"")),
        (
            "9 degF",
            Some(DIFFERENCE),
            "units::difference_wanted",
            "9 degF",
            Some("write \"9 degR\""),
        ),
        ("5 K W/W", Some(ABSOLUTE), "units::absolute_wanted", "5 K W/W", Some("write \"5 degC\"")),
        (
            "50 Hz",
            Some(ROTATION),
            "units::rotation",
            "50 Hz",
            Some("write \"50 rev/s\" for revolutions, or use rad/s, deg/s or rpm"),
        ),
        (
            "3000 1/min",
            Some(ROTATION),
            "units::rotation",
            "3000 1/min",
            Some("write \"3000 rpm\" for revolutions, or use rad/s, deg/s or rpm"),
        ),
        (
            "50 rev/s",
            Some(Type::of(Dimension::FREQUENCY)),
            "units::dimension",
            "50 rev/s",
            Some("the value must come out in 1/s"),
        ),
        ("5 W rad^2", Some(POWER), "units::dimension", "5 W rad^2", Some("write \"5 W\"")),
    ]);
    let error = parse_quantity("0.42 K/W/s", Some(RESISTANCE)).unwrap_err();
    assert_eq!(error.to_string(), "must be a thermal resistance (K/W), got K/(W s)");
}

#[test]
fn wrong_numbers() {
    let zero = Some("0 K is -273.15 degC or -459.67 degF");
    let positive = Some("the standard deviation after ± is zero or positive");
    let zero_w = Some("write the deviation in the unit of the value, for example \"0 ± 1 W\"");
    let zero_r = Some("write the deviation in the unit of the value, for example \"0 ± 1 K/W\"");
    let finite = Some("leave the field out if there is no such value");
    check_wrong(&[
        ("1,5 K/W", None, "units::decimal_comma", ",", Some("write \"1.5 K/W\"")),
        ("nan", None, "units::not_finite", "nan", finite),
        ("-inf", None, "units::not_finite", "-inf", finite),
        ("inf W", None, "units::not_finite", "inf W", finite),
        ("1e999 W", None, "units::out_of_range", "1e999", None),
        ("1e-999 W", None, "units::out_of_range", "1e-999", None),
        ("1e308 km", None, "units::out_of_range", "1e308", None),
        ("-300 degC", None, "units::below_absolute_zero", "-300", zero),
        ("-1 K", Some(ABSOLUTE), "units::below_absolute_zero", "-1", zero),
        ("5 ± -1 K", None, "units::negative_deviation", "-1", positive),
        ("5 degC ± 1", None, "units::bare_number", "1", Some("write \"5 ± 1 degC\"")),
        ("5 degC ± 1 W", None, "units::dimension", "1", Some("the value must come out in K")),
        ("5 kW ± 1", None, "units::bare_number", "1", Some("write \"5 ± 1 kW\"")),
        ("0 W ± 10 %", None, "units::relative_deviation", "10", zero_w),
        ("0 ± 5 % K/W", None, "units::relative_deviation", "5", zero_r),
        ("25 ± 5 % degC", None, "units::relative_deviation", "5", Some("write \"25 ± 1.25 degC\"")),
        (
            "5 m^(1/0)",
            None,
            "units::exponent",
            "^(1/0)",
            Some("write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)"),
        ),
        (
            "5 m^2000000000 m^2000000000",
            None,
            "units::exponent",
            " m^2000000000",
            Some("write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)"),
        ),
    ]);
}

#[test]
fn expressions_taken_for_quantities_and_the_other_way_round() {
    check_wrong(&[
        (
            "2 * m",
            None,
            "units::two_readings",
            "m",
            Some("write \"2 m\" for the quantity or \"(2 * m)\" for the expression"),
        ),
        (
            "20 W/K + 60 W/K * fan",
            None,
            "units::unbracketed_unit",
            "W/K",
            Some("write \"20 [W/K] + 60 [W/K] * fan\""),
        ),
        ("60 W * fan", None, "units::unbracketed_unit", "W", Some("write \"60 [W] * fan\"")),
        (
            "20 W/s^2 * fan",
            None,
            "units::unbracketed_unit",
            "W/s^2",
            Some("write \"20 [W/s^2] * fan\""),
        ),
        (
            "3 s^(1/2) * fan",
            None,
            "units::unbracketed_unit",
            "s^(1/2)",
            Some("write \"3 [s^(1/2)] * fan\""),
        ),
        ("3 s^-2 * fan", None, "units::unbracketed_unit", "s^-2", Some("write \"3 [s^-2] * fan\"")),
        ("3 W/s² * fan", None, "units::unbracketed_unit", "W/s²", Some("write \"3 [W/s²] * fan\"")),
        (
            "20 W/m2K * m",
            None,
            "units::unbracketed_unit",
            "W/m2K",
            Some("write \"20 [W/(m^2 K)] * m\""),
        ),
        ("T_amb + 5 K", None, "units::unbracketed_unit", "K", Some("write \"T_amb + 5 [K]\"")),
        (
            "max(3 K, T_amb)",
            None,
            "units::unbracketed_unit",
            "K",
            Some("write \"max(3 [K], T_amb)\""),
        ),
        ("T_amb [K]", None, "units::misplaced_bracket", "[K]", Some("write \"T_amb\"")),
        ("T_amb +", None, "units::syntax", "", None),
        ("-2^2", None, "units::ambiguous_sign", "-2", Some("write \"- 2^2\" or \"(-2)^2\"")),
    ]);
    for text in ["2 * fan", "2 * t", "1 / 2", "degC", "2 * min(fan, 3)", "5 [K]", "(2 * m)"] {
        let written = parse_value(text, None, &is_parameter).unwrap();
        assert!(matches!(written, Written::Expression(_)), "{text}");
    }
    assert!(matches!(parse_value("2 m", None, &is_parameter), Ok(Written::Quantity(_))));
}

#[test]
fn deep_brackets_are_an_error() {
    for text in [format!("5 {}", "(".repeat(100_000)), "(".repeat(100_000), "5 ".repeat(100_000)] {
        assert!(parse_value(&text, None, &is_parameter).is_err());
    }
    let error = parse_quantity(&format!("5 {}", "(".repeat(100_000)), None).unwrap_err();
    assert_eq!((error.code(), error.span.len()), ("units::too_deep", 1));
}

#[test]
fn units_alone_convert_both_ways() {
    let table = [
        ("degC", 25.0, 298.15, ABSOLUTE),
        ("degF", 77.0, 298.15, ABSOLUTE),
        ("K", 5.0, 5.0, DIFFERENCE),
    ];
    for (text, value, si, ty) in table {
        let unit = Unit::parse(text).unwrap();
        assert_eq!(unit.ty, ty);
        assert!(close(unit.to_si(value), si) && (unit.from_si(si) - value).abs() < 1e-12, "{text}");
    }
    assert!(Unit::parse("1").unwrap().ty.is_scalar());
    assert_eq!(
        Unit::parse("W/m2K").unwrap_err().help().as_deref(),
        Some("did you mean \"W/(m^2 K)\"?")
    );
    assert_eq!(Unit::parse(" ").unwrap_err().code(), "units::empty");
}

#[test]
fn raised_digits_are_exponents() {
    for (raised, digit) in "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().zip('0'..) {
        let of = |exponent: &str| Unit::parse(&format!("s{exponent}")).unwrap().ty;
        assert_eq!(of(&raised.to_string()), of(&format!("^{digit}")), "{raised}");
        assert_eq!(of(&format!("⁻{raised}")), of(&format!("^-{digit}")), "{raised}");
    }
}

/// Nested too deep is another thing.
#[test]
fn many_brackets_side_by_side_are_read() {
    assert_eq!(Unit::parse(&"(m) ".repeat(40)).unwrap().ty, Unit::parse("m^40").unwrap().ty);
}

/// `min(` would be a call.
#[test]
fn a_bracket_multiplies_behind_a_space_only() {
    assert_eq!(Unit::parse("W (s)").unwrap().ty, ENERGY);
    assert!(Unit::parse("W(s)").is_err());
}

#[test]
fn number_and_unit_of_a_quantity_are_found_where_they_stand() {
    let of = |text: &str| {
        let written = lptn_units::written_quantity(text).unwrap();
        (text[written.number].to_owned(), written.unit.text)
    };
    assert_eq!(of("3000 ± 100 mW/K"), ("3000".into(), "mW/K".into()));
    assert_eq!(of(" -2.5e-3 degC"), ("-2.5e-3".into(), "degC".into()));
    assert_eq!(of("25 degC ± 0.5 K"), ("25".into(), "degC".into()));
    assert_eq!(of("0.7"), ("0.7".into(), "1".into()));
    assert!(lptn_units::written_quantity("P / 20 [K]").is_none());
}
