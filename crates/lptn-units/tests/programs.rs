//! What compiled programs and parsed expressions tell about themselves, and how they fail at run
//! time.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{Names, program, run, values};
use lptn_units::{
    Comparison, Degree, Dimension, Dual, EvalError, Expression, Program, SlotKind, Trend, Type,
};

const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);
const ABSOLUTE: Type = Type::ABSOLUTE_TEMPERATURE;

#[test]
fn run_time_errors_name_value_and_place() {
    let text = "2 + (x - 3)^0.5";
    let error = run(text).unwrap_err();
    assert_eq!((error.code(), &text[error.span()]), ("units::negative_base", "(x - 3)^0.5"));
    assert!(
        matches!(error, EvalError::NegativeBase { base, exponent, .. } if base < -0.999 && (0.5..0.51).contains(&exponent))
    );
    assert_eq!(run("(x - 3)^(n / 2)").unwrap_err().code(), "units::negative_base");
    let text = "1 + ln(x - 2)";
    let error = run(text).unwrap_err();
    assert_eq!((error.code(), &text[error.span()]), ("units::domain", "ln(x - 2)"));
    assert_eq!(run("sqrt(x - 3)").unwrap_err().code(), "units::domain");
    let text = "3 * (1 / (x - 2))";
    let error = run(text).unwrap_err();
    assert_eq!((error.code(), &text[error.span()]), ("units::result_not_finite", "1 / (x - 2)"));
    let error = program("T - T_amb").eval(&[1.0_f64], &mut Vec::new()).unwrap_err();
    assert_eq!(error.code(), "units::missing_slot");
}

#[test]
fn comparisons_load_frozen_slots_and_their_own_programs_the_ordinary_ones() {
    let program = program("if(if(T > 340 [K] + 0 [degC], x, n) > 1, kelvin(T), 0 [K])");
    assert_eq!(program.slots(), [0, 1, 6, 10]);
    let frozen = |t| {
        let mut slots = values();
        slots[10] = t;
        slots
    };
    let mut stack = Vec::new();
    assert_eq!(program.eval(&frozen(350.0), &mut stack).unwrap().to_bits(), 350.0_f64.to_bits());
    let [inner, outer] = program.comparisons() else { panic!("two comparisons") };
    assert_eq!((inner.slots(), outer.slots()), (vec![6], vec![0, 1, 6]));
    assert_eq!(inner.ty(), DIFFERENCE);
    let difference = inner.eval(&values(), &mut stack).unwrap();
    assert!((difference - (350.0 - 613.15)).abs() < 1e-12);
}

#[test]
fn held_comparisons_take_their_truth_from_slots() {
    let program = program(
        "if(if(T > 340 [K] + 0 [degC], x, n) > 1, kelvin(T), 0 [K]) + if(x < 3, 1 [K], 2 [K])",
    );
    assert_eq!(program.relations(), [Comparison::Greater, Comparison::Greater, Comparison::Less]);
    let held = program.with_held_comparisons(&mut |i| [Some(11), Some(12), None][i]);
    assert_eq!(held.slots(), [0, 1, 6, 10, 11, 12]);
    let value = |inner: f64, outer: f64| {
        let mut slots = values();
        slots.extend([inner, outer]);
        let of = |program: &Program| program.eval(&slots, &mut Vec::new()).unwrap();
        (of(&held), of(&held.comparisons()[1]))
    };
    // the outer truth decides; the inner one decides between x = 2 and n = 3, of which 1 is taken
    assert_eq!(value(0.0, 0.0), (1.0, 2.0));
    assert_eq!(value(1.0, 1.0), (351.0, 1.0));
    // derivatives are those of the branch that is held
    let mut slots: Vec<Dual<1>> =
        values().into_iter().chain([0.0, 1.0]).map(Dual::constant).collect();
    slots[6] = Dual::variable(300.0, 0);
    let slope = held.eval(&slots, &mut Vec::new()).unwrap();
    assert_eq!((slope.value, slope.derivatives[0]), (301.0, 1.0));
}

#[test]
fn a_comparison_splits_into_its_sides() {
    let text = "steel.T <= 80 [degC]";
    let (left, comparison, right) = Expression::parse(text).unwrap().split_comparison().unwrap();
    assert_eq!(
        (left.text(), comparison.to_string().as_str(), right.text()),
        ("steel.T", "<=", "80 [degC]")
    );
    let right = right.compile(&Names, Some(ABSOLUTE)).unwrap();
    assert!((right.eval::<f64>(&[], &mut Vec::new()).unwrap() - 353.15).abs() < 1e-12);
    let (_, _, wrong) =
        Expression::parse("steel.T < 80 [K] * foo").unwrap().split_comparison().unwrap();
    assert_eq!(wrong.compile(&Names, None).unwrap_err()[0].span, 19..22);
    assert!(Expression::parse("1 + 2").unwrap().split_comparison().is_none());
    let text = "x + 2 * n - 1 >= max(n, fan, 3 * (x + 1)) + if(x < n, 2, 5)";
    let (left, _, right) = Expression::parse(text).unwrap().split_comparison().unwrap();
    let value = |side: Expression| {
        side.compile(&Names, None).unwrap().eval(&values(), &mut Vec::new()).unwrap()
    };
    assert_eq!((value(left), value(right)), (7.0, 11.0));
}

/// A constant part is computed before the run, whatever it is made of, so that a negative base
/// takes the whole exponent that it comes to: (2 - 3)^2 = 1, (2 - 3)^1 = -1.
#[test]
fn constant_exponents_are_known_beforehand() {
    let even = [
        "sqrt(4)",
        "abs(-2)",
        "min(2, 3)",
        "min(3, 2)",
        "max(1, 2)",
        "max(2, 1)",
        "min(5, 2, 3)",
        "max(0, 2, 1)",
        "mean(1, 3)",
        "mean(1, 2, 3)",
        "ln(1)",
        "sin(0)",
        "tanh(0)",
        "2 * cos(0)",
        "2 * exp(0)",
        "(1 + 1)",
        "(5 - 3)",
        "(1 / 0.5)",
        "-(-2)",
        "2^1",
    ];
    for exponent in even {
        assert!((run(&format!("(x - 3)^({exponent})")).unwrap() - 1.0).abs() < 1e-15, "{exponent}");
    }
    for exponent in ["cos(0)", "exp(0)", "min(1, 2)", "max(1, 0)", "mean(1)", "sqrt(1)"] {
        assert!((run(&format!("(x - 3)^({exponent})")).unwrap() + 1.0).abs() < 1e-15, "{exponent}");
    }
    // what is constant has no kink
    for constant in [
        "sqrt(4)",
        "ln(2)",
        "cos(1)",
        "sin(1)",
        "tanh(1)",
        "exp(1)",
        "abs(-2)",
        "2^0.5",
        "mean(1, 2)",
    ] {
        assert!(program(&format!("x + max({constant}, 5)")).kinks().is_empty(), "{constant}");
    }
    let constant = program("2 * sqrt(9) + max(1, 4)");
    assert!(constant.slots().is_empty() && constant.kinks().is_empty());
    assert_eq!((constant.text(), run(constant.text()).unwrap()), ("2 * sqrt(9) + max(1, 4)", 10.0));
}

#[test]
fn programs_can_be_shared_between_threads() {
    fn is_shared<T: Send + Sync + Clone>() {}
    is_shared::<Program>();
}

#[test]
fn names_are_listed_with_their_places() {
    let text = "max(ring[1, *].T, planet[1].gear.T) + a.b * pi";
    let names = Expression::parse(text).unwrap().names();
    let expected = [("ring[1,*].T", 4..16), ("planet[1].gear.T", 18..34), ("a.b", 38..41)];
    assert_eq!(names, expected.map(|(name, span)| (name.to_owned(), span)));
}

#[test]
fn degrees_are_upper_bounds() {
    let table = [
        ("n", Degree::Constant),
        ("3 * x + n", Degree::Affine),
        ("(x + 1) / n - x", Degree::Affine),
        ("n / x", Degree::Nonlinear),
        ("x * x", Degree::Nonlinear),
        ("x * (n + n * n)", Degree::Affine),
        ("abs(x)", Degree::Nonlinear),
        ("abs(n) * x", Degree::Affine),
        ("if(n < 2, x, 2 * x)", Degree::Affine),
        ("1 + if(n < 2, n, if(n < 1, n, x))", Degree::Affine),
        ("if(x < 2, 1, 2)", Degree::Nonlinear),
        ("if(n < 2, x^2, 1)", Degree::Nonlinear),
        ("mean(x, n)", Degree::Affine),
        ("(x + n) + n * (x - 1)", Degree::Affine),
        ("(n + 1) * (x + n)", Degree::Affine),
        ("(x + 1) * (x + n)", Degree::Nonlinear),
        ("(x + 1) / (n + 1)", Degree::Affine),
        ("-x", Degree::Affine),
        ("x^1", Degree::Affine),
        ("n^x", Degree::Nonlinear),
    ];
    for (text, degree) in table {
        assert_eq!(program(text).degree_in(0), degree, "{text}");
    }
}

#[test]
fn deep_nesting_is_an_error_and_long_sums_are_not() {
    for text in [
        "(".repeat(100_000),
        "-".repeat(100_000),
        "2^".repeat(100_000),
        "abs(".repeat(100_000),
        format!("{}x{}", "(".repeat(101), ")".repeat(101)),
    ] {
        let error = Expression::parse(&text).unwrap_err();
        assert_eq!(error.code(), "units::too_deep", "{}", &text[..10]);
    }
    let long = vec!["x"; 100_000].join(" + ");
    assert!((run(&long).unwrap() - 200_000.0).abs() < 1e-6);
}

#[test]
fn names_may_stand_for_others() {
    let expression = Expression::parse("R * (1 + R / 2) + loss(gear.T) - pi").unwrap();
    let meaning = |name: &str| {
        matches!(name, "R" | "loss" | "gear.T" | "pi").then(|| format!("planet[2].{name}"))
    };
    let renamed = expression.renamed(&meaning);
    assert_eq!(
        renamed.meant(),
        "planet[2].R * (1 + planet[2].R / 2) + planet[2].loss(planet[2].gear.T) - pi"
    );
    // places are those of the text that was written
    assert_eq!(renamed.text(), "R * (1 + R / 2) + loss(gear.T) - pi");
    assert_eq!(renamed.names()[2], ("planet[2].gear.T".to_owned(), 23..29));
    let (left, _, right) =
        Expression::parse("R <= 2 * R").unwrap().renamed(&meaning).split_comparison().unwrap();
    assert_eq!((left.meant().as_str(), right.meant().as_str()), ("planet[2].R", "2 * planet[2].R"));
}

/// `x`, `n` and `fan` vary, temperatures are foreign, everything else is fixed.
fn split(text: &str) -> (Vec<f64>, bool) {
    let kind = |slot| match slot {
        0..=2 => SlotKind::Varying,
        6..=10 => SlotKind::Foreign,
        _ => SlotKind::Fixed,
    };
    let split = program(text).split(&kind);
    let values: Vec<f64> =
        split.parts.iter().map(|part| part.eval(&values(), &mut Vec::new()).unwrap()).collect();
    (values, split.entangled)
}

/// With x = 2, n = 3, fan = 0.25.
#[test]
fn parts_that_read_no_temperature_are_found_wherever_they_stand() {
    let whole = |text: &str, value: f64| assert_eq!(split(text), (vec![value], false), "{text}");
    whole("x^2 + n", 7.0);
    whole("P / (220 [W]) * x^2 * (1 + kelvin(T) / (1 [K]))", 4.0);
    whole("(1 + kelvin(T) / (1 [K])) * x^2", 4.0);
    whole("kelvin(T) / (1 [K]) * n", 3.0);
    whole("n * kelvin(T)", 3.0);
    whole("kelvin(T) - exp(x - 2) * 1 [K]", 1.0);
    whole("if(T > T_amb, x^2, kelvin(T) / (1 [K]))", 4.0);
    whole("if(x < 5, kelvin(T) / (1 [K]), sin(x - 2) + 7)", 7.0);
    whole("if(x < 5, x, n) * kelvin(T)", 2.0);
    whole("max(kelvin(T) / (1 [K]), x + n)", 5.0);
    // a choice by a temperature and by something else is one by a temperature
    assert_eq!(split("if(kelvin(T) / (1 [K]) > x, x^2, n)"), (vec![4.0, 3.0], false));
    assert_eq!(split("if(x < kelvin(T) / (1 [K]), x^2, n)"), (vec![4.0, 3.0], false));
    assert_eq!(split("x * kelvin(T) * fan + n^2 * 1 [K]"), (vec![2.0, 0.25, 9.0], false));
    assert_eq!(split("sin(n * (kelvin(T) - (350 [K])) / (1 [K]) + x)"), (vec![3.0, 2.0], true));
    assert_eq!(split("1 / (1 + x * kelvin(T) / (1 [K]))"), (vec![2.0], true));
    assert_eq!(split("kelvin(T) + P / (1 [W/K])"), (vec![], false));
}

/// Of a film coefficient over the magnitude of x: what rises surely is told from what may fall.
#[test]
fn trends_are_told_only_where_they_are_sure() {
    let trend = |text: &str| {
        program(text).trend(&|slot| if slot == 0 { Trend::SIGNED } else { Trend::constant(3.0) })
    };
    let rising = [
        "1.6 * abs(x)^0.25 + n",
        "2 + x^2",
        "max(5, abs(x))",
        "1 - 0.5 * exp(-abs(x))",
        "abs(2 * x) / n",
    ];
    for text in rising {
        let found = trend(text);
        assert!(found.rises && !found.falls && found.low >= 0.0, "{text}: {found:?}");
    }
    let others = [
        "x",
        "1 + x",
        "5 - abs(x)",
        "abs(x) * exp(-abs(x))",
        "n / (1 + abs(x))",
        "if(x < 2, 1, abs(x))",
    ];
    for text in others {
        let found = trend(text);
        assert!(!(found.rises && found.low >= 0.0), "{text}: {found:?}");
    }
    assert!(trend("n / (1 + abs(x))").falls && trend("n * 2 - 1").is_held());
}
