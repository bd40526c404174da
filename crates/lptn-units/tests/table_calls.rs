//! Expressions that call tables: their values, derivatives and degrees, and where they have kinks.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Degree, Dimension, Dual, Expression, Interpolation, Outside, Program, Type};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use tables::{Names, POWER, SLOTS, one, program, run, two};

use crate::tables_helper as tables;

#[test]
fn tables_are_called_with_values_of_their_types() {
    for (text, ty, value) in [
        ("loss(speed)", POWER, 100.0),
        ("2 * loss(speed / 2) + loss(0 [rad/s])", POWER, 100.0),
        ("map(speed, torque)", POWER, 110.0),
        ("map(speed - 10 [rad/s], max(torque, 1.5 [N m])) - loss(speed)", POWER, -5.0),
        (
            "loss(speed) * cp(T) + map(loss(speed) / torque * 1 [rad], torque * 2)",
            POWER,
            120.0 + 220.0,
        ),
        ("cp(20 [degC]) + cp(T - 1000 [K] + 1500 [K])", Type::SCALAR, 3.0),
        ("f(f(f(x)))", Type::SCALAR, 0.25),
    ] {
        let program = program(text);
        assert_eq!(program.ty(), ty, "{text}");
        assert!((run(&program).unwrap() - value).abs() < 1e-12, "{text}: {:?}", run(&program));
    }
}

#[test]
fn derivatives_go_through_tables() {
    let slots: Vec<Dual<3>> =
        SLOTS.iter().enumerate().map(|(i, value)| Dual::variable(*value, i)).collect();
    let found = program("map(speed * 1.5, torque) * cp(T)").eval(&slots, &mut Vec::new()).unwrap();
    for (found, hand) in found.derivatives.into_iter().zip([3.0 * 1.2, 10.0 * 1.2, 160.0 * 0.01]) {
        assert!((found - hand).abs() < 1e-12, "{found} instead of {hand}");
    }
}

#[test]
fn a_stack_of_the_stated_size_is_never_reallocated() {
    for text in ["g(x, f(g(y, f(x)) + 1))", "1 + (x + (y + g(x * (y + 1), (x + f(y)) * (y - 2))))"]
    {
        let program = program(text);
        let mut stack = Vec::with_capacity(program.stack_size());
        let before = (stack.as_ptr(), stack.capacity());
        program.eval(&SLOTS, &mut stack).unwrap();
        assert_eq!((stack.as_ptr(), stack.capacity()), before, "{text}");
    }
}

#[test]
fn degrees_of_tables() {
    for (text, degree) in [
        ("f(y) * x", Degree::Affine),
        ("f(x)", Degree::Nonlinear),
        ("g(y, x)", Degree::Nonlinear),
        ("g(x, y)", Degree::Nonlinear),
        ("x + g(y, f(y))", Degree::Affine),
        ("g(y, 2) + f(3)", Degree::Constant),
        ("if(f(x) < 1, 1, 2)", Degree::Nonlinear),
    ] {
        assert_eq!(program(text).degree_in(3), degree, "{text}");
    }
}

fn parts(programs: &[Program]) -> Vec<(f64, Type)> {
    programs.iter().map(|part| (run(part).unwrap(), part.ty())).collect()
}

#[test]
fn kinks_are_listed_in_the_order_of_the_text() {
    const DIFFERENCE: Type = Type::of(Dimension::TEMPERATURE);
    let scalar = Type::SCALAR;
    let table: [(&str, Vec<(f64, Type)>); 7] = [
        ("x + y", vec![]),
        ("abs(y - 3) + abs(-2) * min(x, 1)", vec![(-0.5, scalar), (-0.75, scalar)]),
        (
            "max(x, y, 1, 2)",
            vec![(-2.25, scalar), (-0.75, scalar), (-1.75, scalar), (1.5, scalar), (0.5, scalar)],
        ),
        ("min(T, 300 [K] + 0 [degC])", vec![(320.0 - 573.15, DIFFERENCE)]),
        ("max(speed * torque, P)", vec![(43.0, POWER)]),
        ("abs(max(x, y) - 3)", vec![(-2.25, scalar), (-0.5, scalar)]),
        ("mean(x, y) + if(abs(x) < 1, 1, max(y, 0))", vec![(0.25, scalar), (2.5, scalar)]),
    ];
    for (text, expected) in table {
        let program = program(text);
        let found = parts(program.kinks());
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for ((value, ty), (hand, hand_ty)) in found.into_iter().zip(expected) {
            assert!((value - hand).abs() < 1e-12 && ty == hand_ty, "{text}: {value} {ty}");
        }
    }
}

#[test]
fn kinks_and_calls_load_the_ordinary_slots_in_comparisons_too() {
    let program = program("if(abs(kelvin(T) - 350 [K]) + 10 [K] * cp(T) > 5 [K], x, y)");
    assert_eq!(program.slots(), [3, 4, 6]);
    assert_eq!(program.kinks()[0].slots(), [2]);
    assert_eq!(parts(program.kinks())[0].0.to_bits(), (-30.0_f64).to_bits());
    assert_eq!(program.table_calls()[0].arguments[0].slots(), [2]);
}

#[test]
fn calls_of_tables_are_listed_inner_ones_first() {
    let program = program("g(f(x + 1), y) + if(x < 1, cp(T), 2)");
    let found: Vec<(usize, Vec<f64>)> = program
        .table_calls()
        .iter()
        .map(|call| {
            (
                call.table.dimension(),
                parts(&call.arguments).into_iter().map(|part| part.0).collect(),
            )
        })
        .collect();
    assert_eq!(found, [(1, vec![1.25]), (2, vec![1.0, 2.5]), (1, vec![320.0])]);
}

/// The kinks of the largest of many: there, one of the programs is 0.
#[test]
fn many_arguments_have_few_kinks_and_none_is_missed() {
    let lines: Vec<String> = (0..100).map(|i| format!("({i} * x - {})", i * i)).collect();
    let program = program(&format!("max({})", lines.join(", ")));
    assert!(program.kinks().len() < 1000, "{}", program.kinks().len());
    // the lines i and i + 1 meet at x = 2 i + 1, above all others: i x - i^2 is largest for the i
    // next to x / 2
    for i in 0..99 {
        let mut slots = SLOTS;
        slots[3] = f64::from(2 * i + 1);
        let at_root = |part: &Program| part.eval(&slots, &mut Vec::new()).unwrap() == 0.0;
        assert!(program.kinks().iter().any(at_root), "x = {}", slots[3]);
    }
}

fn config() -> Config {
    Config {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_261_121),
        ..Config::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn derivatives_of_random_tables_agree_with_differences(
        steps in proptest::collection::vec((0.2..1.5, -5.0..5.0), 2..8),
        z in proptest::collection::vec(-5.0..5.0, 16),
        pchip in any::<bool>(),
        at in [-1.0..8.0, -1.0..4.0],
    ) {
        let mut last = 0.0;
        let x: Vec<f64> = steps.iter().map(|(step, _): &(f64, f64)| { last += step; last }).collect();
        let y: Vec<f64> = steps.iter().map(|(_, value)| *value).collect();
        let interpolation = if pchip { Interpolation::Pchip } else { Interpolation::Linear };
        let grid = [0.0, 1.0, 2.0, 3.0];
        let names = Names { plain: one(&x, &y, interpolation, Outside::Hold), pair: two(&grid, &grid, &z, Outside::Hold) };
        let program = Expression::parse("f(x) * g(y, x / 2) + f(y)^2 - g(f(x), y)").unwrap().compile(&names, None).unwrap();
        let [a, b] = at;
        let (slots, mut stack) = (|a, b| [0.0, 0.0, 0.0, a, b], Vec::with_capacity(program.stack_size()));
        // kinks are where an argument of a call is a knot
        let step = 1e-6;
        for call in program.table_calls() {
            for (index, argument) in call.arguments.iter().enumerate() {
                let value = argument.eval(&slots(a, b), &mut stack).unwrap();
                prop_assume!(call.table.knots(index).iter().all(|knot| (knot - value).abs() > 1e-3));
            }
        }
        let mut value = |a, b| program.eval(&slots(a, b), &mut stack).unwrap();
        let in_a = (value(a + step, b) - value(a - step, b)) / (2.0 * step);
        let in_b = (value(a, b + step) - value(a, b - step)) / (2.0 * step);
        let exact = value(a, b);
        let zero = Dual::<2>::constant(0.0);
        let duals = [zero, zero, zero, Dual::variable(a, 0), Dual::variable(b, 1)];
        let found = program.eval(&duals, &mut Vec::new()).unwrap();
        prop_assert_eq!(found.value.to_bits(), exact.to_bits());
        for (dual, difference) in found.derivatives.into_iter().zip([in_a, in_b]) {
            prop_assert!((dual - difference).abs() < 1e-6 * (10.0 + dual.abs()), "{dual} and \
                {difference}");
        }
    }
}

#[test]
fn calls_are_found_by_name_and_functions_are_none() {
    let text = "max(loss(speed), 2 * map(speed, abs(x))) + los (1)";
    let calls = Expression::parse(text).unwrap().calls();
    let found: Vec<(&str, &str)> =
        calls.iter().map(|(name, at)| (name.as_str(), &text[at.clone()])).collect();
    assert_eq!(found, [("loss", "loss"), ("map", "map"), ("los", "los")]);
}
