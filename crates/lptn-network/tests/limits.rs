//! Limits: margins with their sign, units, parameters, and what a builder refuses.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_network::{
    Bound, BuildErrorKind, Conductance, HeatCapacity, InputProblem, LimitSeverity, Network,
    NetworkBuilder, Temperature,
};
use lptn_units::{Dimension, Expression, Type, parse_quantity};

fn network() -> Network {
    let mut builder = NetworkBuilder::new();
    let celsius = |text| parse_quantity(text, Some(Type::ABSOLUTE_TEMPERATURE)).unwrap();
    builder.parameter("T_max", celsius("110 degC"));
    let a = builder.node("a", HeatCapacity(1.0), Temperature(300.0));
    let b = builder.massless("b");
    let air = builder.boundary("air", Temperature(290.0));
    builder.resistor("ab", a, b, Conductance(1.0));
    builder.resistor("cool", b, air, Conductance(1.0));
    let of = builder.post_expression("max(a.T, b.T)", None).unwrap();
    let value = builder.expression("T_max - 10 [K]", Some(Type::ABSOLUTE_TEMPERATURE)).unwrap();
    builder.limit(
        "hot",
        (of.into(), "max(a.T, b.T)"),
        (Bound::Below, value.into()),
        LimitSeverity::Error,
    );
    let of = builder.post_expression("a.T - air.T", None).unwrap();
    let value = parse_quantity("5 K", Some(Type::of(Dimension::TEMPERATURE))).unwrap();
    builder.limit(
        "rise",
        (of.into(), "a.T - air.T"),
        (Bound::Above, value.into()),
        LimitSeverity::Warning,
    );
    builder.build().unwrap()
}

#[test]
fn margins_are_positive_while_a_limit_is_kept() {
    let network = network();
    let mut scope = network.evaluation();
    scope.set_temperatures(&[350.0, 360.0], &[290.0]);
    let margins: Vec<f64> =
        network.limit_ids().map(|id| network.limit_margin(id, &mut scope).unwrap()).collect();
    // 100 degC - 360 K; 350 K - 290 K - 5 K
    assert!(
        (margins[0] - (373.15 - 360.0)).abs() < 1e-12 && (margins[1] - 55.0).abs() < 1e-12,
        "{margins:?}"
    );
    scope.set_temperatures(&[292.0, 380.0], &[290.0]);
    let margins: Vec<f64> =
        network.limit_ids().map(|id| network.limit_margin(id, &mut scope).unwrap()).collect();
    assert!(
        (margins[0] - (373.15 - 380.0)).abs() < 1e-12 && (margins[1] + 3.0).abs() < 1e-12,
        "{margins:?}"
    );
    assert_eq!(network.limits()[0].text, "max(a.T, b.T)");
    assert_eq!(network.limits()[0].margin_type(), Type::of(Dimension::TEMPERATURE));
}

#[test]
fn a_limit_follows_its_parameters() {
    let network = network();
    let mut other = network.overrides();
    other.set_text("T_max", "120 degC").unwrap();
    let network = network.with(&other).unwrap();
    let mut scope = network.evaluation();
    scope.set_temperatures(&[300.0, 300.0], &[290.0]);
    let id = network.limit_ids().next().unwrap();
    assert!((network.limit_margin(id, &mut scope).unwrap() - (383.15 - 300.0)).abs() < 1e-12);
}

#[test]
fn without_temperatures_there_is_no_margin() {
    let network = network();
    let id = network.limit_ids().next().unwrap();
    let error = network.limit_margin(id, &mut network.evaluation()).unwrap_err();
    assert!(matches!(error.problem, InputProblem::Evaluation(_)), "{error}");
}

#[test]
fn expressions_of_results_read_parameters_time_and_temperatures() {
    let network = network();
    let text = "(a.T - air.T) * t / 1 [s] + (T_max - b.T)";
    let program = Expression::parse(text).unwrap().compile(&network.post_scope(), None).unwrap();
    let value = lptn_network::Value::Expression(program.into());
    let mut scope = network.evaluation();
    scope.set_time(2.0, 2.0);
    scope.set_temperatures(&[300.0, 310.0], &[290.0]);
    assert!((value.at(&mut scope).unwrap() - (10.0 * 2.0 + (383.15 - 310.0))).abs() < 1e-12);
    let error = Expression::parse("c.T").unwrap().compile(&network.post_scope(), None).unwrap_err();
    assert_eq!(error[0].code(), "units::unknown_name");
}

#[test]
fn wrong_limits_are_refused() {
    let mut builder = NetworkBuilder::new();
    let a = builder.node("a", HeatCapacity(1.0), Temperature(300.0));
    let of = builder.post_expression("a.T", None).unwrap();
    let value = parse_quantity("5 W", None).unwrap();
    builder.limit(
        "a",
        (of.clone().into(), "a.T"),
        (Bound::Below, value.into()),
        LimitSeverity::Error,
    );
    let value = builder.post_expression("a.T", None).unwrap();
    builder.limit("self", (of.into(), "a.T"), (Bound::Below, value.into()), LimitSeverity::Error);
    builder.capacitor("more", a, HeatCapacity(1.0));
    builder.node("late", HeatCapacity(1.0), Temperature(300.0));
    let errors = builder.build().unwrap_err().0;
    let codes: Vec<&str> = errors.iter().map(|e| e.code()).collect();
    assert_eq!(
        codes,
        ["network::wrong_type", "network::duplicate_name", "network::depends_on_result"]
    );
    assert!(matches!(errors[2].kind, BuildErrorKind::DependsOnResult { .. }));
}
