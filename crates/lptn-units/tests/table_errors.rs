//! Calls of tables that are wrong, in the text or at run time.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{EvalError, UnitError};
use tables::{compile, program, run};

use crate::tables_helper as tables;

/// Text, code, part pointed to, message, help.
type Wrong = (&'static str, &'static str, &'static str, &'static str, &'static str);

const WRONG: [Wrong; 17] = [
    (
        "2 * loss",
        "units::arity",
        "loss",
        "table `loss` takes one argument, a rotational speed (rad/s), got 0",
        "write \"2 * loss(speed)\"",
    ),
    (
        "map(speed) + P",
        "units::arity",
        "map(speed)",
        "table `map` takes two arguments, a rotational speed (rad/s) and an energy (J), got 1",
        "write \"map(speed, torque) + P\"",
    ),
    (
        "loss(speed, torque)",
        "units::arity",
        "loss(speed, torque)",
        "table `loss` takes one argument, a rotational speed (rad/s), got 2",
        "write \"loss(speed)\"",
    ),
    (
        "map(P)",
        "units::arity",
        "map(P)",
        "table `map` takes two arguments, a rotational speed (rad/s) and an energy (J), got 1",
        "write `map(..)` with a rotational speed (rad/s) and an energy (J) between the brackets",
    ),
    (
        "tempo()",
        "units::arity",
        "tempo()",
        "table `tempo` takes one argument, a time (s), got 0",
        "write `tempo(..)` with a time (s) between the brackets",
    ),
    (
        "loss(50)",
        "units::argument",
        "50",
        "table `loss` takes a rotational speed (rad/s), got a plain number",
        "write \"loss(50 [rad/s])\"",
    ),
    (
        "loss(50 [Hz])",
        "units::argument",
        "50 [Hz]",
        "table `loss` takes a rotational speed (rad/s), got a frequency (1/s)",
        "write \"loss(50 [rev/s])\"",
    ),
    (
        "map(speed, P)",
        "units::argument",
        "P",
        "table `map` takes an energy (J), got a power (W)",
        "the argument must come out in J",
    ),
    (
        "cp(300 [K])",
        "units::argument",
        "300 [K]",
        "table `cp` takes an absolute temperature, got a temperature difference (K)",
        "write \"cp(absolute(300 [K]))\"",
    ),
    (
        "cp(T - 20 [degC])",
        "units::argument",
        "T - 20 [degC]",
        "table `cp` takes an absolute temperature, got a temperature difference (K)",
        "write \"cp(absolute(T - 20 [degC]))\"",
    ),
    (
        "f(speed - 3 [rad/s])",
        "units::argument",
        "speed - 3 [rad/s]",
        "table `f` takes a plain number, got a rotational speed (rad/s)",
        "write \"f((speed - 3 [rad/s]) / 1 [rad/s])\"",
    ),
    (
        "lss(speed)",
        "units::unknown_function",
        "lss",
        "unknown function `lss`",
        "did you mean `loss`?",
    ),
    (
        "tanhh(x)",
        "units::unknown_function",
        "tanhh",
        "unknown function `tanhh`",
        "did you mean `tanh`?",
    ),
    (
        "P(x + 1)",
        "units::not_a_table",
        "P",
        "`P` is not a table and takes no arguments",
        "write \"P * (x + 1)\"",
    ),
    (
        "P / x(y)",
        "units::not_a_table",
        "x",
        "`x` is not a table and takes no arguments",
        "write \"P / (x * y)\"",
    ),
    (
        "P(x, y) + P",
        "units::not_a_table",
        "P",
        "`P` is not a table and takes no arguments",
        "write \"P + P\"",
    ),
    ("los", "units::unknown_name", "los", "unknown name `los`", "did you mean `loss(..)`?"),
];

#[test]
fn wrong_calls_point_to_the_place_and_show_the_text() {
    for (text, code, part, message, help) in WRONG {
        let errors = compile(text).expect_err(text);
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        assert_eq!((errors[0].code(), &text[errors[0].span.clone()]), (code, part), "{text}");
        assert_eq!(errors[0].to_string(), message, "{text}");
        assert_eq!(errors[0].help().as_deref(), Some(help), "{text}");
    }
}

#[test]
fn proposals_compile() {
    for (text, .., help) in WRONG {
        for proposal in help.split('"').skip(1).step_by(2) {
            assert!(compile(proposal).is_ok(), "{text}: {proposal}: {:?}", compile(proposal).err());
        }
    }
}

#[test]
fn every_wrong_argument_is_reported_once() {
    let codes = |text: &str| -> Vec<&'static str> {
        compile(text).unwrap_err().iter().map(UnitError::code).collect()
    };
    assert_eq!(codes("map(P, T)"), ["units::argument"; 2]);
    assert_eq!(
        codes("map(foo, T) + loss(bar)"),
        ["units::unknown_name", "units::argument", "units::unknown_name"]
    );
    assert_eq!(codes("loss(speed < 1 [rad/s])"), ["units::truth"]);
}

#[test]
fn an_argument_outside_is_an_error_with_its_place() {
    let text = "3 * map(speed, torque * 2.5)";
    let error = run(&program(text)).unwrap_err();
    assert_eq!(
        (error.code(), &text[error.span()]),
        ("units::outside_table", "map(speed, torque * 2.5)")
    );
    assert!(error.help().unwrap().contains("outside = \"hold\""));
    assert_eq!(
        error.to_string(),
        "table `map` reaches from 0 to 2 in its second argument, got 2.5 (SI units)"
    );
    let EvalError::OutsideTable { table, argument, value, from, to, .. } = error else {
        panic!("{error}")
    };
    assert_eq!((table.as_str(), argument, value, from, to), ("map", 1, 2.5, 0.0, 2.0));
    let error = run(&program("loss(120 [rad/s])")).unwrap_err();
    assert_eq!(error.code(), "units::outside_table");
}

/// A held table would turn an infinite argument into its end value.
#[test]
fn an_argument_that_is_not_finite_is_reported_where_it_arises() {
    for text in ["1 + f(1 / (y - 2.5))", "1 + g(x, 1 / (y - 2.5))", "loss(speed * (1 / (y - 2.5)))"]
    {
        let error = run(&program(text)).unwrap_err();
        assert_eq!(
            (error.code(), &text[error.span()]),
            ("units::result_not_finite", "1 / (y - 2.5)")
        );
    }
}
