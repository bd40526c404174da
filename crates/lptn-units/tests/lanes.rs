//! Programs on lanes give the value of every lane by itself, to the last digit; pieces tell on which
//! side of its kinks a program is.

use lptn_units::{Interpolation, LANES, Lanes, Outside, Program};

use crate::tables_helper::{Names, one, program, two};

/// Slots of the tests' names, another one in every lane.
fn lanes_of(first: f64, step: f64) -> Vec<[f64; 7]> {
    let at = |lane: usize| first + step * lane as f64;
    (0..LANES).map(|lane| [50.0 + at(lane), 1.0, 320.0, at(lane), 2.5, 7.0, 410.0]).collect()
}

fn on_lanes(program: &Program, slots: &[[f64; 7]]) -> Option<Lanes> {
    let load = |slot: u32| std::array::from_fn(|lane| slots[lane][slot as usize]);
    program.eval_lanes(load, &mut Vec::new())
}

#[test]
fn every_lane_is_the_value_alone_to_the_last_digit() {
    for text in [
        "x",
        "-x",
        "3",
        "x + y - 2 * x * y / (x + 7)",
        "3 - x",
        "3 / (x + 0.1)",
        "(x + 1)^3 - (x + 2)^-2",
        "x^0.25 + x^(5/3) + (x + 0.5)^1.25",
        "(x + 1)^y",
        "2^x",
        "abs(x - 0.3) * min(x, 0.4) + max(x, 0.2, y)",
        "sqrt(x) + exp(-x) + ln(x + 1) + sin(x) + cos(x) + tanh(x)",
        "mean(x, y, 3)",
        "loss(speed) / 7 [W] + cp(T) * f(x)",
        "1.32 * abs(x - y)^0.25 * (1 + x / (y + (x * (y + x))))",
    ] {
        let program = program(text);
        assert!(program.runs_on_lanes(), "{text}");
        let slots = lanes_of(0.05, 0.09);
        let found = on_lanes(&program, &slots).unwrap_or_else(|| panic!("{text}"));
        for (lane, slots) in found.iter().zip(&slots) {
            let alone = program.eval(slots, &mut Vec::new()).unwrap();
            assert_eq!(lane.to_bits(), alone.to_bits(), "{text} at {slots:?}");
        }
    }
}

#[test]
fn programs_with_branches_or_maps_do_not_run_on_lanes() {
    for text in ["if(x < 0.4, 1, 2)", "g(x, y)", "1 + map(speed, torque) / P"] {
        let program = program(text);
        assert!(!program.runs_on_lanes(), "{text}");
        assert_eq!(on_lanes(&program, &lanes_of(0.1, 0.1)), None, "{text}");
    }
}

/// One lane in which a value cannot be had, by its error alone, gives up all.
#[test]
fn a_lane_with_an_error_gives_up_all() {
    for text in [
        "1 / (x - 0.25)",
        "sqrt(x - 0.3)",
        "ln(x - 0.3)",
        "(x - 0.3)^0.5",
        "(x - 0.3)^y",
        "loss(speed + 49.3 [rad/s])",
        "exp(4000 * x)",
    ] {
        let program = program(text);
        let slots = lanes_of(0.0, 0.125);
        let alone = |slots: &[f64; 7]| program.eval(slots, &mut Vec::new()).is_ok();
        let right = slots.iter().filter(|slots| alone(slots)).count();
        assert!(right > 0 && right < LANES, "{text}: {right} lanes have a value");
        assert_eq!(on_lanes(&program, &slots), None, "{text}");
        let lane = slots.iter().find(|slots| alone(slots)).unwrap();
        assert!(on_lanes(&program, &[*lane; LANES]).is_some(), "{text}");
    }
}

#[test]
fn programs_do_the_same_if_their_operations_and_tables_are_one() {
    let same = |a: &str, b: &str| program(a).does_the_same(&program(b));
    assert!(same("x + 2 * y", "x+2*y") && same("1 + x", "(1 + x)"));
    assert!(!same("x + 2 * y", "x + 3 * y") && !same("x", "y") && !same("x + y", "x - y"));
    let names = |scale: f64| Names {
        plain: one(&[0.0, 1.0], &[0.0, scale], Interpolation::Linear, Outside::Hold),
        pair: two(&[0.0, 1.0], &[0.0, 1.0], &[0.0; 4], Outside::Hold),
    };
    let (first, other) = (names(1.0), names(2.0));
    let of = |names: &Names| -> Program {
        lptn_units::Expression::parse("f(x)").unwrap().compile(names, None).unwrap()
    };
    assert!(of(&first).does_the_same(&of(&first)));
    assert!(!of(&first).does_the_same(&of(&other)), "one text, two tables");
}

/// Pieces at two places are told apart where a kink or a point of a table lies between.
#[test]
fn pieces_change_at_kinks_and_points_of_tables() {
    let at = |program: &Program, x: f64| {
        let slots = [50.0, 1.0, 320.0, x, 2.5, 7.0, 410.0];
        program.pieces(&slots, &mut Vec::new(), |slot| slot == 3)
    };
    for (text, bend) in [
        ("abs(x - 0.3)", 0.3),
        ("min(x, 0.6) * y", 0.6),
        ("max(2 * x, 0.5, y - 9)", 0.25),
        ("f(x - 0.5) + 1", 0.5),
        ("abs(y - 2.4) + 0.1 * f(x) * abs(x - 0.7)", 0.7),
    ] {
        let program = program(text);
        let (before, behind) = (at(&program, bend - 1e-9), at(&program, bend + 1e-9));
        assert!(before.is_some() && behind.is_some() && before != behind, "{text}");
        let (far, near) = (at(&program, bend - 0.01), at(&program, bend - 1e-6));
        assert_eq!(far, near, "{text}: nothing bends there");
    }
}

#[test]
fn what_does_not_vary_bends_nothing_and_what_has_no_value_is_told() {
    let slots = |x: f64| [50.0, 1.0, 320.0, x, 2.5, 7.0, 410.0];
    let pieces = |text: &str, x: f64, slot: u32| {
        program(text).pieces(&slots(x), &mut Vec::new(), |own| own == slot)
    };
    // only a kink over y is looked at
    assert_eq!(pieces("abs(x - 0.3) + y", 0.2, 4), pieces("abs(x - 0.3) + y", 0.4, 4));
    assert_ne!(pieces("abs(x - 0.3) + y", 0.2, 3), pieces("abs(x - 0.3) + y", 0.4, 3));
    assert_eq!(pieces("if(x < 0.3, 1, 2)", 0.2, 3), None);
    assert_eq!(pieces("abs(1 / (x - 0.2))", 0.2, 3), None);
    // the order of kinks counts: one below and one above is not the same as the reverse
    assert_ne!(
        pieces("abs(x - 0.3) + abs(0.3 - x)", 0.2, 3),
        pieces("abs(x - 0.3) + abs(0.3 - x)", 0.4, 3)
    );
}
