//! A table of expressions: right values against hand computation, and every error with its code,
//! the part of the text it points to, and its help.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;
#[path = "expressions/rotations.rs"]
mod rotations;

use common::{compile, program, values};
use lptn_units::{Dimension, Type, UnitError};

const SCALAR: Type = Type::SCALAR;
const POWER: Type = Type::of(Dimension::POWER);
const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);
const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

fn check_right(table: &[(&str, Type, f64)]) {
    for (text, ty, expected) in table {
        let program = program(text);
        let value = program.eval(&values(), &mut Vec::new()).unwrap();
        assert!(
            (value - expected).abs() <= 1e-13 * expected.abs(),
            "{text} = {value}, not {expected}"
        );
        assert_eq!(program.ty(), *ty, "{text}");
    }
}

#[test]
#[expect(
    clippy::excessive_precision,
    reason = "digits as computed by hand with more than f64 holds"
)]
fn arithmetic_and_units_are_right() {
    check_right(&[
        ("1 + 2 * 3", SCALAR, 7.0),
        ("(1 + 2) * 3", SCALAR, 9.0),
        ("2 - 3 - 4", SCALAR, -5.0),
        ("2 / 4 / 5", SCALAR, 0.1),
        ("2 ^ 3 ^ 2", SCALAR, 512.0),
        ("-x^2", SCALAR, -4.0),
        ("- 2^2", SCALAR, -4.0),
        ("(-2)^2", SCALAR, 4.0),
        ("2^-1", SCALAR, 0.5),
        ("x^n", SCALAR, 8.0),
        ("3 - -2", SCALAR, 5.0),
        ("3 -2", SCALAR, 1.0),
        ("8.7e-5 * 1e5", SCALAR, 8.7),
        ("2 * pi", SCALAR, std::f64::consts::TAU),
        ("20 [W/K] + 60 [W/K] * fan", Type::of(Dimension::CONDUCTANCE), 35.0),
        ("1.7 [K] / P", Type::of(Dimension::RESISTANCE), 0.00772727272727272727),
        ("1 [kW] + 1 [BTU/h]", POWER, 1000.29307107017222),
        ("87 [uW/rpm^(5/3)] * (1000 [rpm])^(5/3)", POWER, 8.7),
        (
            "torque * omega",
            Type::of(Dimension::POWER.checked_mul(Dimension::ANGLE).unwrap()),
            500.0,
        ),
        ("torque * omega + 20 [W]", POWER, 520.0),
    ]);
}

#[test]
#[expect(
    clippy::excessive_precision,
    reason = "digits as computed by hand with more than f64 holds"
)]
fn absolute_temperatures_and_differences_are_right() {
    check_right(&[
        ("T - T_amb", DIFFERENCE, 50.0),
        ("T + 5 [K]", ABSOLUTE, 355.0),
        ("5 [K] + T", ABSOLUTE, 355.0),
        ("T - 5 [degR]", ABSOLUTE, 347.222222222222222),
        ("-20 [degC]", ABSOLUTE, 253.15),
        ("T - -20 [degC]", DIFFERENCE, 96.85),
        ("T -20 [degC]", DIFFERENCE, 56.85),
        ("77 [degF]", ABSOLUTE, 298.15),
        ("mean(T, T_amb)", ABSOLUTE, 325.0),
        ("mean(1, 2, 6)", SCALAR, 3.0),
        ("max(T, T_amb, 100 [degC])", ABSOLUTE, 373.15),
        ("min(x, n, x * n)", SCALAR, 2.0),
        (
            "kelvin(T)^2",
            Type::of(DIFFERENCE.dimension.checked_mul(DIFFERENCE.dimension).unwrap()),
            122500.0,
        ),
        ("absolute(300 [K])", ABSOLUTE, 300.0),
        ("steel.T - planet[1].gear.T", DIFFERENCE, -10.0),
        ("steel.T - planet[ 1 ].gear.T", DIFFERENCE, -10.0),
    ]);
}

#[test]
#[expect(
    clippy::excessive_precision,
    reason = "digits as computed by hand with more than f64 holds"
)]
fn conditions_and_functions_are_right() {
    check_right(&[
        ("if(T > 80 [degC], 1, 2)", SCALAR, 2.0),
        ("if(T > 70 [degC], 1, 2)", SCALAR, 1.0),
        ("if(x == 2, sqrt(x - 2), sqrt(1 - x))", SCALAR, 0.0),
        ("if(x != 2, ln(0 - x), x)", SCALAR, 2.0),
        ("if(if(x < 1, 1, 5) >= 5, if(n <= 3, 10, 11), 12)", SCALAR, 10.0),
        ("x + if(x < 1, x, n) * 2 - 1", SCALAR, 7.0),
        ("abs(-3 [W])", POWER, 3.0),
        ("sqrt(4 [m^2])", Type::of(Dimension::LENGTH), 2.0),
        ("exp(ln(x))", SCALAR, 2.0),
        ("sin(90 [deg])", SCALAR, 1.0),
        ("cos(60 [deg]) + sin(pi / 6)", SCALAR, 1.0),
        ("tanh(0.5)", SCALAR, 0.462117157260009758),
        ("(8 [m^3])^(1/3)", Type::of(Dimension::LENGTH), 2.0),
        ("(4 [m^2])^0.5", Type::of(Dimension::LENGTH), 2.0),
        (
            "(4 [m^2])^-(1/2)",
            Type::of(Dimension::NONE.checked_div(Dimension::LENGTH).unwrap()),
            0.5,
        ),
        ("(0 - x)^3", SCALAR, -8.0),
        ("(0 - x)^71", SCALAR, -2361183241434822606848.0),
        ("(0 - x)^n", SCALAR, -8.0),
        ("50 [%] * x", SCALAR, 1.0),
        ("1 / (1 / x + 1 / n)", SCALAR, 1.2),
    ]);
}

/// Text, expected type, code, part pointed to, help.
type Wrong = (&'static str, Option<Type>, &'static str, &'static str, Option<&'static str>);

fn check_wrong(table: &[Wrong]) {
    for (text, expected, code, part, help) in table {
        let errors = compile(text, *expected).expect_err(text);
        let error = &errors[0];
        assert_eq!(error.code(), *code, "{text}: {error}");
        assert_eq!(&text[error.span.clone()], *part, "{text}: {error}");
        assert_eq!(error.help().as_deref(), *help, "{text}: {error}");
    }
}

#[test]
fn errors_of_syntax() {
    check_wrong(&[
        (
            "",
            None,
            "units::empty",
            "",
            Some("write a quantity such as \"0.3 K/W\" or an expression such as \"2 * G\""),
        ),
        ("1 +", None, "units::syntax", "", None),
        ("(1 + 2", None, "units::syntax", "", None),
        ("1 + 2)", None, "units::syntax", ")", None),
        ("x = 2", None, "units::syntax", "=", None),
        (
            "x && n",
            None,
            "units::syntax",
            "&",
            Some("conditions are combined by nesting: \"if(a < b, if(c < d, x, y), y)\""),
        ),
        ("2 x", None, "units::syntax", "x", None),
        ("max(1,,2)", None, "units::syntax", ",", None),
        ("5 [W", None, "units::syntax", "[W", None),
        ("1e999 * x", None, "units::out_of_range", "1e999", None),
        ("-2^2", None, "units::ambiguous_sign", "-2", Some("write \"- 2^2\" or \"(-2)^2\"")),
        (
            "x < n < 5",
            None,
            "units::chained_comparison",
            "<",
            Some("write \"if(a < b, if(b < c, x, y), y)\""),
        ),
        ("P [W] * 2", None, "units::misplaced_bracket", "[W]", Some("write \"P * 2\"")),
        ("P[W] * 2", None, "units::misplaced_bracket", "[W]", Some("write \"P * 2\"")),
        ("5 [Watt]", None, "units::unknown_unit", "Watt", Some("did you mean \"5 [W]\"?")),
        (
            "2 * 5 [J/kg K]",
            None,
            "units::ambiguous_product",
            "K",
            Some("write \"2 * 5 [J/(kg K)]\""),
        ),
        (
            "5 [W^x]",
            None,
            "units::exponent",
            "^",
            Some("write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)"),
        ),
        (
            "T - -300 [degC]",
            None,
            "units::below_absolute_zero",
            "300",
            Some("0 K is -273.15 degC or -459.67 degF"),
        ),
    ]);
}

#[test]
fn errors_of_names_and_arguments() {
    check_wrong(&[
        ("2 * omeg", None, "units::unknown_name", "omeg", Some("did you mean `omega`?")),
        ("stel.T - T", None, "units::unknown_name", "stel.T", Some("did you mean `steel.T`?")),
        ("xyzzy", None, "units::unknown_name", "xyzzy", None),
        ("sqr(x)", None, "units::unknown_function", "sqr", Some("did you mean `sqrt`?")),
        ("sqrt(x, n)", None, "units::arity", "sqrt", None),
        ("max(x)", None, "units::arity", "max", None),
        ("mean()", None, "units::arity", "mean", None),
        ("if(x < n, 1)", None, "units::arity", "if", None),
        ("2 * sqrt", None, "units::arity", "sqrt", None),
        (
            "exp(5 [K])",
            None,
            "units::argument",
            "5 [K]",
            Some("divide it by a temperature difference (K), for example \"exp(5 [K] / 1 [K])\""),
        ),
        (
            "sin(5 [m])",
            None,
            "units::argument",
            "5 [m]",
            Some("divide it by a length (m), for example \"sin(5 [m] / 1 [m])\""),
        ),
        ("kelvin(5 [K])", None, "units::argument", "5 [K]", None),
        ("absolute(T)", None, "units::argument", "T", None),
        ("x < n", None, "units::truth", "x < n", Some("write \"if(x < n, 1, 0)\"")),
        ("2 * (x < n)", None, "units::truth", "x < n", Some("write \"2 * (if(x < n, 1, 0))\"")),
        ("if(fan, 1, 2)", None, "units::truth", "fan", Some("write \"if(fan > 0.5, 1, 2)\"")),
    ]);
}

#[test]
fn errors_of_dimensions() {
    check_wrong(&[
        (
            "P + 5 [K]",
            None,
            "units::operands",
            "P + 5 [K]",
            Some("give all of them in W or all in K"),
        ),
        ("P + 5", None, "units::operands", "P + 5", Some("write \"P + 5 [W]\"")),
        (
            "max(0, T - T_amb)",
            None,
            "units::operands",
            "0, T - T_amb",
            Some("write \"max(0 [K], T - T_amb)\""),
        ),
        ("if(x < n, P, 0)", None, "units::operands", "P, 0", Some("write \"if(x < n, P, 0 [W])\"")),
        (
            "if(T > 80 [K], 1, 2)",
            None,
            "units::operands",
            "T > 80 [K]",
            Some("write \"if(T > 80 [degC], 1, 2)\""),
        ),
        (
            "if(T - T_amb > 5 [degC], 1, 2)",
            None,
            "units::operands",
            "T - T_amb > 5 [degC]",
            Some("write \"if(T - T_amb > 5 [K], 1, 2)\""),
        ),
    ]);
}

#[test]
fn a_bare_number_beside_a_temperature_gets_the_unit_that_is_right_in_its_place() {
    let code = "units::operands";
    check_wrong(&[
        ("T_amb + 5", Some(ABSOLUTE), code, "T_amb + 5", Some("write \"T_amb + 5 [K]\"")),
        ("5 + T_amb", Some(ABSOLUTE), code, "5 + T_amb", Some("write \"5 [K] + T_amb\"")),
        ("T_amb - 5", None, code, "T_amb - 5", Some("write \"T_amb - 5 [K]\"")),
        ("T_amb - 5", Some(DIFFERENCE), code, "T_amb - 5", Some("write \"T_amb - 5 [degC]\"")),
        (
            "1 + 0.004 [1/K] * (T - 20)",
            Some(SCALAR),
            code,
            "T - 20",
            Some("write \"1 + 0.004 [1/K] * (T - 20 [degC])\""),
        ),
        (
            "1 + 0.004 * (T - 20)",
            Some(SCALAR),
            code,
            "T - 20",
            Some("write \"1 + 0.004 * (T - 20 [degC])\""),
        ),
        (
            "T_amb - 5 [degC]",
            Some(ABSOLUTE),
            "units::absolute_wanted",
            "T_amb - 5 [degC]",
            Some("write \"T_amb - 5 [K]\""),
        ),
        (
            "min(T_amb, 40)",
            Some(ABSOLUTE),
            code,
            "T_amb, 40",
            Some("write \"min(T_amb, 40 [degC])\""),
        ),
    ]);
}

#[test]
fn errors_of_results() {
    let resistance = Some(Type::of(Dimension::RESISTANCE));
    check_wrong(&[
        (
            "2 * 3 / 4",
            resistance,
            "units::dimension",
            "2 * 3 / 4",
            Some("the value must come out in K/W"),
        ),
        ("T", Some(POWER), "units::dimension", "T", Some("the value must come out in W")),
        (
            "P * 1",
            Some(DIFFERENCE),
            "units::dimension",
            "P * 1",
            Some("the value must come out in K"),
        ),
        ("omega^x", None, "units::exponent", "x", Some("write \"(omega / 1 [rad/s])^x\"")),
        (
            "2^P",
            None,
            "units::exponent",
            "P",
            Some("divide the exponent by its unit: \"x^(n / 1 [K])\""),
        ),
        (
            "(1 [m])^2000000000 * (1 [m])^2000000000",
            None,
            "units::exponent",
            "(1 [m])^2000000000 * (1 [m])^2000000000",
            Some("write a whole number, a decimal or a fraction: m^2, s^0.5, rpm^(5/3)"),
        ),
    ]);
}

#[test]
fn errors_of_absolute_temperatures() {
    let code = "units::absolute_temperature";
    macro_rules! both {
        ($kelvin:literal, $celsius:literal) => {
            Some(concat!(
                "write \"",
                $kelvin,
                "\" to count from 0 K, \"",
                $celsius,
                "\" to count from 0 degC"
            ))
        };
    }
    check_wrong(&[
        (
            "T + T_amb",
            None,
            code,
            "T_amb",
            both!("kelvin(T) + kelvin(T_amb)", "T + (T_amb - 0 [degC])"),
        ),
        ("T_amb + 5 [degC]", None, code, "5 [degC]", Some("write \"T_amb + 5 [K]\"")),
        ("2 * T", None, code, "T", both!("2 * kelvin(T)", "2 * (T - 0 [degC])")),
        ("2 * 20 [degC]", None, code, "20 [degC]", Some("write \"2 * 20 [K]\"")),
        ("T^4", None, code, "T", both!("kelvin(T)^4", "(T - 0 [degC])^4")),
        ("T / 300 [K]", None, code, "T", both!("kelvin(T) / 300 [K]", "(T - 0 [degC]) / 300 [K]")),
        ("exp(T)", None, code, "T", both!("exp(kelvin(T))", "exp((T - 0 [degC]))")),
        ("abs(T)", None, code, "T", both!("abs(kelvin(T))", "abs((T - 0 [degC]))")),
        ("-T", None, code, "T", both!("-kelvin(T)", "-(T - 0 [degC])")),
        ("5 [K] - T", None, code, "T", Some("write \"5 [degC] - T\"")),
        ("x * (T - 20 [K])", None, code, "T - 20 [K]", Some("write \"x * (T - 20 [degC])\"")),
        (
            "x * (T - 293 [K])",
            None,
            code,
            "T - 293 [K]",
            Some("write \"x * (T - absolute(293 [K]))\""),
        ),
        (
            "300 [K]",
            Some(ABSOLUTE),
            "units::absolute_wanted",
            "300 [K]",
            Some("write \"absolute(300 [K])\""),
        ),
        ("T", Some(DIFFERENCE), "units::difference_wanted", "T", Some("write \"T - 0 [degC]\"")),
        (
            "5 [degC]",
            Some(DIFFERENCE),
            "units::difference_wanted",
            "5 [degC]",
            Some("write \"5 [K]\""),
        ),
    ]);
}

/// What is offered is evaluated: T is 350 K, T_amb 300 K, by hand.
#[test]
fn what_is_offered_has_the_value_that_is_meant() {
    for (text, expected) in [
        ("10 * (1 + 0.00393 [1/K] * (T - 20 [K]))", 10.0 * (1.0 + 0.00393 * (76.85 - 20.0))),
        ("0.00393 [1/K] * (T - 293.15 [K])", 0.00393 * (350.0 - 293.15)),
        ("0.5 [1/K] * (90 [K] - T)", 0.5 * (90.0 - 76.85)),
        ("if(T > 60 [K], 1, 2)", 1.0),
        ("if(T > 80 [K], 1, 2)", 2.0),
        ("if(T > 340 [K], 1, 2)", 1.0),
        ("if(T > 360, 1, 2)", 2.0),
        ("(T + T_amb) / 2", 325.0),
        ("0.5 * (T + T_amb)", 325.0),
    ] {
        let help = compile(text, None).unwrap_err()[0].help().unwrap();
        let offered = help.split('"').nth(1).unwrap();
        let found = program(offered).eval(&values(), &mut Vec::new()).unwrap();
        assert!((found - expected).abs() < 1e-9, "{text}: {offered} is {found}, not {expected}");
    }
}

/// Both texts that are offered are temperatures where one is due; T is 350 K = 76.85 degC, T_amb
/// 300 K, by hand.
#[test]
fn both_offers_are_temperatures_where_one_is_due() {
    for (text, from_zero, from_ice) in [
        ("2 * T", 700.0, 273.15 + 153.7),
        ("T / 2", 175.0, 273.15 + 38.425),
        ("T + T_amb", 650.0, 273.15 + 103.7),
    ] {
        let help = compile(text, Some(ABSOLUTE)).unwrap_err()[0].help().unwrap();
        for (place, expected) in [(1, from_zero), (3, from_ice)] {
            let offered = help.split('"').nth(place).unwrap();
            assert_eq!(compile(offered, Some(ABSOLUTE)).unwrap().ty(), ABSOLUTE, "{offered}");
            let found = program(offered).eval(&values(), &mut Vec::new()).unwrap();
            assert!((found - expected).abs() < 1e-9, "{text}: {offered} is {found}");
        }
    }
}

#[test]
fn all_errors_are_reported_in_order_of_place() {
    let errors = compile("foo + (T + T_amb) * sqrt(1, 2) + bar", None).unwrap_err();
    let codes: Vec<&str> = errors.iter().map(UnitError::code).collect();
    let expected = [
        "units::unknown_name",
        "units::absolute_temperature",
        "units::arity",
        "units::unknown_name",
    ];
    assert_eq!(codes, expected);
}

#[test]
fn one_radian_too_many_is_a_result_in_the_type_that_is_due() {
    assert_eq!(compile("torque * omega", Some(POWER)).unwrap().ty(), POWER);
}

#[test]
fn habits_of_other_languages_are_answered() {
    let nested = Some("conditions are combined by nesting: \"if(a < b, if(c < d, x, y), y)\"");
    let choice = Some(
        "write `if(condition, value, other value)`, for example \"if(t < 10 [min], 100 [W], 0 \
         [W])\"",
    );
    let power = Some("a power is written with `^`: \"x^2\"");
    check_wrong(&[
        ("if x < 3 then 1 else 2", None, "units::syntax", "x", choice),
        ("x < 3 ? 1 : 2", None, "units::syntax", "?", choice),
        ("if(x < 3 and n < 2, 1, 2)", None, "units::syntax", "and", nested),
        ("x ** 2", None, "units::syntax", "*", power),
        ("x²", None, "units::syntax", "²", power),
        ("x * * 2", None, "units::syntax", "*", None),
        ("x $ 2", None, "units::syntax", "$", None),
        ("[W]", None, "units::misplaced_bracket", "[W]", Some("write \"1 [W]\"")),
        ("x * [W]", None, "units::misplaced_bracket", "[W]", Some("write \"x * 1 [W]\"")),
    ]);
    check_right(&[("x × n", SCALAR, 6.0)]);
}

#[test]
fn comparisons_for_equality_are_found_by_name() {
    let expression =
        lptn_units::Expression::parse("if(t == 5 [s], x, 0) + if(t < x, 1, if(x != t, 1, 2))")
            .unwrap();
    let found: Vec<&str> =
        expression.equalities("t").into_iter().map(|span| &expression.text()[span]).collect();
    assert_eq!(found, ["t == 5 [s]", "x != t"]);
    assert!(
        lptn_units::Expression::parse("if(x == 2, t, 0 [s])").unwrap().equalities("t").is_empty()
    );
}
