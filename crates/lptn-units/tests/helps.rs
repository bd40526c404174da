//! Helps: what they tell to write is read as what was evidently meant, or they tell nothing.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Dimension, Expression, NoNames, Type, Written, parse_quantity, parse_value};
use proptest::prelude::*;

const LENGTH: Type = Type::of(Dimension::LENGTH);
const POWER: Type = Type::of(Dimension::POWER);
const RESISTANCE: Type = Type::of(Dimension::RESISTANCE);

/// The value of a string where this type is due, as a netlist reads it, and its deviation; or the
/// helps.
fn read(text: &str, ty: Type) -> Result<(f64, Option<f64>), Option<String>> {
    match parse_value(text, Some(ty), &|_| false).map_err(|error| error.help())? {
        Written::Quantity(quantity) => {
            Ok((quantity.value, quantity.deviation.map(|_| quantity.sigma())))
        }
        Written::Expression(expression) => of_expression(&expression, ty),
    }
}

fn of_expression(expression: &Expression, ty: Type) -> Result<(f64, Option<f64>), Option<String>> {
    let program = expression.compile(&NoNames, Some(ty)).map_err(|errors| errors[0].help())?;
    Ok((program.eval(&[], &mut Vec::new()).map_err(|_| None)?, None))
}

/// What a help puts in quotes.
fn offered(help: &str) -> Vec<String> {
    help.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The texts offered for a text that is refused.
fn offers(text: &str, ty: Type) -> Vec<String> {
    let help = read(text, ty).expect_err(text);
    help.as_deref().map(offered).unwrap_or_default()
}

fn near(found: f64, expected: f64) -> bool {
    (found - expected).abs() <= 1e-11 * expected.abs()
}

/// The first text that is offered is read as this value, without another step between.
fn leads_to(text: &str, ty: Type, expected: f64, deviation: Option<f64>) {
    let offers = offers(text, ty);
    let first = offers.first().unwrap_or_else(|| panic!("{text}: nothing is offered"));
    let (found, of) = read(first, ty).unwrap_or_else(|help| panic!("{text}: {first}: {help:?}"));
    assert!(near(found, expected), "{text}: {first} is {found}, not {expected}");
    match (of, deviation) {
        (Some(of), Some(wanted)) => {
            assert!(near(of, wanted), "{text}: {first}: ± {of}, not {wanted}")
        }
        (of, wanted) => assert_eq!(of, wanted, "{text}: {first}"),
    }
}

/// 1 in is 0.0254 m, by definition.
const INCH: f64 = 0.0254;

/// The help for 3/8 in led to 67.7 mm in two steps.
#[test]
fn fractions_of_a_unit_are_shown_as_decimals() {
    leads_to("3/8 in", LENGTH, 0.375 * INCH, None);
    leads_to("3 / 8 in", LENGTH, 0.375 * INCH, None);
    leads_to("3/8in", LENGTH, 0.375 * INCH, None);
    leads_to("3/8 [in]", LENGTH, 0.375 * INCH, None);
    leads_to("1 1/2 in", LENGTH, 1.5 * INCH, None);
    leads_to("1-1/2 in", LENGTH, 1.5 * INCH, None);
    leads_to("-1 1/2 in", LENGTH, -1.5 * INCH, None);
    leads_to("1/3 K/W", RESISTANCE, 1.0 / 3.0, None);
    leads_to("1/2 W ± 5 %", POWER, 0.5, Some(0.025));
    assert_eq!(offers("3/8 in", LENGTH), ["0.375 in"]);
    let units = parse_quantity("3/8 in", None).unwrap_err();
    assert_eq!(
        (units.code(), units.help().as_deref()),
        ("units::fraction", Some("write \"0.375 in\""))
    );
    for right in ["5 1/min", "1 / 2", "3/8 * 1 [in]", "1/s", "2 1/K"] {
        assert!(parse_value(right, None, &|_| false).is_ok(), "{right}");
    }
    for nothing in ["3/0 in", "3/0 [in]", "1 1/0 in"] {
        assert!(offers(nothing, LENGTH).iter().all(|offer| !offer.contains("inf")), "{nothing}");
    }
    // a difference of unlike kinds is not a mixed number
    assert!(!offers("1 - 1/2 in", LENGTH).iter().any(|offer| read(offer, LENGTH).is_ok()));
}

/// The inverse of a length is not a length that anybody meant.
#[test]
fn an_inverse_is_offered_for_what_people_write_both_ways_only() {
    leads_to("0.5 W/K", RESISTANCE, 2.0, None);
    leads_to("2 [K/W]", Type::of(Dimension::CONDUCTANCE), 0.5, None);
    for (text, ty) in [("8 1/in", LENGTH), ("2 * 4 [1/in]", LENGTH), ("5 W/K ± 5 %", RESISTANCE)] {
        assert!(offers(text, ty).is_empty(), "{text}: {:?}", offers(text, ty));
    }
}

/// What is known to measure something else is not a slip of the unit: its number says nothing of
/// what is due.
#[test]
fn another_quantity_is_not_relabelled() {
    for (text, ty) in
        [("25 degC", POWER), ("5 kWh", POWER), ("475 J/(kg K)", Type::of(Dimension::CAPACITY))]
    {
        assert!(offers(text, ty).is_empty(), "{text}: {:?}", offers(text, ty));
    }
    leads_to("0.42 K/W/s", RESISTANCE, 0.42, None);
    leads_to("0.42 K/W/s ± 5 %", RESISTANCE, 0.42, Some(0.021));
}

#[test]
fn deviations_lead_to_deviations() {
    let scalar = Type::SCALAR;
    leads_to("220 ± 5 % W", POWER, 220.0, Some(11.0));
    leads_to("20 +- 5 % W", POWER, 20.0, Some(1.0));
    leads_to("0.8 ± 5 %", scalar, 0.8, Some(0.04));
    leads_to("80 % ± 5 %", scalar, 0.8, Some(0.04));
    leads_to("0.5 % ± 10 %", scalar, 0.005, Some(0.0005));
    leads_to("80 % ± 5", scalar, 0.8, Some(0.05));
    leads_to("0.5 % ± 0.1", scalar, 0.005, Some(0.001));
    leads_to("5 kW ± 1", POWER, 5000.0, Some(1000.0));
    leads_to("25 ± 5 % degC", Type::ABSOLUTE_TEMPERATURE, 298.15, Some(1.25));
    leads_to("0.8 ± 5 %", POWER, 0.8, Some(0.04));
    leads_to("5 ± 1", RESISTANCE, 5.0, Some(1.0));
    leads_to("50 Hz ± 5 %", Type::of(Dimension::ANGULAR_VELOCITY), 100.0 * std::f64::consts::PI, {
        Some(5.0 * std::f64::consts::PI)
    });
    let asked = offers("0.8 ± 5 %", scalar);
    assert_eq!(asked, ["0.8 ± 0.04", "0.008 ± 0.05"]);
    assert_eq!(offers("80 % ± 5 %", scalar), ["80 ± 4 %", "80 ± 5 %"]);
    assert_eq!(offers("220 ± 5 % W", POWER), ["220 W ± 5 %", "2.2 ± 0.05 W"]);
}

/// `mPA` was taken for MPa, and `mw` for mW: a factor of 1e9 to guess.
#[test]
fn a_prefix_keeps_its_case_and_without_any_nothing_is_offered() {
    let pressure = Type::of(Dimension::PRESSURE);
    leads_to("5 mPA", pressure, 5e-3, None);
    leads_to("5 MPA", pressure, 5e6, None);
    leads_to("5 Mw", POWER, 5e6, None);
    leads_to("5 KW", POWER, 5e3, None);
    for (text, ty) in [("5 mpa", pressure), ("5 mw", POWER), ("5 mj", Type::of(Dimension::ENERGY))]
    {
        assert!(offers(text, ty).is_empty(), "{text}: {:?}", offers(text, ty));
    }
}

const UNITS: [(&str, f64, Dimension); 6] = [
    ("in", INCH, Dimension::LENGTH),
    ("mm", 1e-3, Dimension::LENGTH),
    ("kW", 1e3, Dimension::POWER),
    ("mK/W", 1e-3, Dimension::RESISTANCE),
    ("W/(m^2 K)", 1.0, Dimension::FILM_COEFFICIENT),
    ("min", 60.0, Dimension::TIME),
];

proptest! {
    #[test]
    fn any_fraction_of_any_unit(whole in 0u32..20, n in 1u32..64, d in 2u32..64, unit in 0usize..6, tight: bool) {
        let (unit, scale, dimension) = UNITS[unit];
        let part = f64::from(n) / f64::from(d);
        let bar = if tight { "/" } else { " / " };
        let (text, value) = match whole {
            0 => (format!("{n}{bar}{d} {unit}"), part),
            _ if n < d => (format!("{whole} {n}{bar}{d} {unit}"), f64::from(whole) + part),
            _ => return Ok(()),
        };
        leads_to(&text, Type::of(dimension), value * scale, None);
    }

    /// A part of the value is offered first, the percentage second; both are read at once as what
    /// they say.
    #[test]
    fn any_deviation_in_percent(x in 0.01f64..200.0, y in 0.0f64..50.0) {
        for text in [format!("{x} ± {y} %"), format!("{x} % ± {y} %"), format!("{x} % ± {y}")] {
            let ty = Type::SCALAR;
            let Err(help) = read(&text, ty) else {
                // one reading: that of every other unit
                let (value, deviation) = read(&text, ty).unwrap();
                prop_assert!(near(value, x / 100.0) && near(deviation.unwrap(), y / 100.0), "{text}");
                prop_assert!(text.ends_with('%') && x > 1.0 && y <= x, "{text}");
                continue;
            };
            for offer in offered(&help.unwrap()) {
                prop_assert!(read(&offer, ty).is_ok(), "{text}: {offer}");
            }
        }
    }
}
