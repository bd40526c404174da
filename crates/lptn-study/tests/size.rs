//! Sizing against closed forms of networks of one and two nodes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, parse};
use lptn_solve::Proceed;
use lptn_study::uncertainty::{Inputs, uncertain_anywhere};
use lptn_study::{
    Coolant, CoolingTask, Demand, Doubt, Moments, SizeError, SizeTask, Sizing, TrialError, Verdict,
    judge, size,
};

/// 100 W into `inner`, over `R_in` into `outer`, over `G` into air of 20 degC.
fn chain(param: &str, study: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nG = \"3 W/K\"\nR_in = \"0.05 K/W\"\n{param}\n[default]\nT0 = \"20 \
         degC\"\n[node]\n\
         inner = {{ C = \"1 kJ/K\" }}\nouter = {{ C = \"1 kJ/K\" }}\n[boundary]\nair = {{ T = \"20 \
         degC\" }}\n\
         [resistor]\njoint = {{ from = \"inner\", to = \"outer\", R = \"R_in\" }}\n\
         skin = {{ from = \"outer\", to = \"air\", G = \"G\" }}\n\
         [source]\nloss = {{ into = \"inner\", P = \"100 W\" }}\n[size.s]\n{study}\n"
    );
    parse("chain.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn one_node(resistor: &str, power: &str, study: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nx = 3\n[node]\nblock = {{ C = \"1 kJ/K\", T0 = \"20 degC\" \
         }}\n[boundary]\n\
         air = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \"block\", to = \"air\", \
         {resistor} }}\n\
         [source]\nloss = {{ into = \"block\", P = \"{power}\" }}\n[size.s]\n{study}\n"
    );
    parse("one_node.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn demand(netlist: &Netlist) -> Demand<'_> {
    let probability = netlist.studies.sizes[0].probability(&netlist.network).unwrap();
    let inputs = uncertain_anywhere(&netlist.network, &netlist.overrides()).ok();
    let inputs: Option<&Inputs> = inputs.map(|inputs| &*Box::leak(Box::new(inputs)));
    Demand {
        network: &netlist.network,
        netlist,
        cases: &[],
        requirements: &netlist.studies.sizes[0].requirements,
        moments: Moments::Steady(0.0),
        doubt: probability.map(|probability| Doubt { probability, inputs }),
        watcher: &|_| Proceed::Continue,
    }
}

fn solve(netlist: &Netlist) -> Result<Sizing, SizeError> {
    let study = &netlist.studies.sizes[0];
    size(&SizeTask {
        demand: demand(netlist),
        parameter: study.ranges(&netlist.network).unwrap()[0].0,
        range: study.ranges(&netlist.network).unwrap()[0].1,
        goal: study.goal,
    })
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found:e} is not {expected:e}");
}

#[test]
fn one_node_has_the_closed_form() {
    let study = "minimise = \"x\"\nvary = { x = { from = 0.1, to = 50 } }\nrequire = [\"block.T <= \
        75 [degC]\"]";
    let sizing = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", study)).unwrap();
    assert_eq!(sizing.verdict, Verdict::Bound);
    near(sizing.trial.value, 100.0 / 55.0, 1e-12);
    assert!(sizing.margin() >= 0.0 && sizing.margin() < 1e-10, "{}", sizing.margin());
    assert_eq!(sizing.breaks_again, None);
    // T = 20 + P/G: 1 % more G takes 1 % of the rise
    near(sizing.sensitivity.unwrap(), 0.55, 1e-7);
    // the Norton equivalent of one path is the network itself
    near(sizing.first_guess.unwrap(), 100.0 / 55.0, 1e-10);

    let study = study.replace("minimise", "maximise").replace("to = 50", "to = 5");
    let sizing = solve(&one_node("R = \"x * 1 [K/W]\"", "100 W", &study)).unwrap();
    near(sizing.trial.value, 55.0 / 100.0, 1e-12);
    near(sizing.sensitivity.unwrap(), -0.55, 1e-7);
}

#[test]
fn two_limits_bind_in_turn() {
    let study = "minimise = \"G\"\nvary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }\n\
                 require = [\"inner.T <= 80 [degC]\", \"70 [degC] >= outer.T\"]";
    // outer = 20 + 100/G; inner is 100 R_in above it
    for (r_in, expected, binding) in
        [(0.05, 2.0, 1), (0.2, 2.5, 0), (0.0999, 2.0, 1), (0.1001, 100.0 / 49.99, 0)]
    {
        let mut netlist = chain("", study);
        netlist.set(&[format!("R_in={r_in} K/W")]).unwrap();
        let sizing = solve(&netlist).unwrap();
        near(sizing.trial.value, expected, 1e-11);
        assert_eq!(sizing.closest, binding, "R_in {r_in}");
        let other = sizing.trial.judged.margins[1 - binding];
        near(other, f64::abs(10.0 - 100.0 * r_in), 1e-9);
        if f64::abs(r_in - 0.1) > 0.01 {
            // the guess is for the limit that binds, and exact for one path
            near(sizing.first_guess.unwrap(), expected, 1e-10);
        }
    }
}

#[test]
fn what_is_kept_already_takes_the_best_end() {
    let study = "minimise = \"G\"\nvary = { G = { from = \"5 W/K\", to = \"50 W/K\" } }\nrequire = \
        [\"outer.T <= 70 [degC]\"]";
    let sizing = solve(&chain("", study)).unwrap();
    assert_eq!(sizing.verdict, Verdict::BestEnd);
    near(sizing.trial.value, 5.0, 0.0);
    near(sizing.margin(), 30.0, 1e-12);
    assert_eq!(sizing.breaks_again, None);
    // seen from the other end the answer is the border again
    let sizing =
        solve(&chain("", &study.replace("minimise", "maximise").replace("<=", ">="))).unwrap();
    assert_eq!(sizing.verdict, Verdict::Infeasible);
}

#[test]
fn infeasible_says_how_far_off() {
    let study = "minimise = \"G\"\nvary = { G = { from = \"0.5 W/K\", to = \"2 W/K\" } }\nrequire \
        = [\"outer.T <= 60 [degC]\"]";
    let sizing = solve(&chain("", study)).unwrap();
    assert_eq!((sizing.verdict, sizing.feasible()), (Verdict::Infeasible, false));
    near(sizing.trial.value, 2.0, 1e-7);
    near(sizing.margin(), 60.0 - (20.0 + 100.0 / 2.0), 1e-6);
    // below the surroundings nothing helps
    let sizing = solve(&chain("", &study.replace("60 [degC]", "10 [degC]"))).unwrap();
    assert_eq!(sizing.verdict, Verdict::Infeasible);
    near(sizing.margin(), 10.0 - 70.0, 1e-6);
}

/// A fan that heats what it cools: T = 20 + 100/x + 2 x, with its least value at the root of 50.
fn fan(limit: &str) -> Sizing {
    let study = format!(
        "minimise = \"x\"\nvary = {{ x = {{ from = 1, to = 50 }} }}\nrequire = [\"block.T <= \
         {limit} [degC]\"]"
    );
    solve(&one_node("G = \"x * 1 [W/K]\"", "100 [W] + 2 [W] * x^2", &study)).unwrap()
}

#[test]
fn what_helps_first_and_harms_later_is_told() {
    // 100/x + 2 x = 30 at 5 and 10
    let sizing = fan("50");
    assert_eq!(sizing.verdict, Verdict::Bound);
    near(sizing.trial.value, 5.0, 1e-12);
    near(sizing.breaks_again.unwrap(), 10.0, 1e-12);
}

#[test]
fn a_window_between_the_places_is_found() {
    // 100/x + 2 x = 28.2845 has its two roots 0.07 apart, while the places are 18 % apart
    let root = (28.2845_f64 * 28.2845 - 800.0).sqrt();
    let sizing = fan("48.2845");
    assert_eq!(sizing.verdict, Verdict::Bound);
    near(sizing.trial.value, (28.2845 - root) / 4.0, 1e-9);
    near(sizing.breaks_again.unwrap(), (28.2845 + root) / 4.0, 1e-9);
}

#[test]
fn an_infeasible_middle_is_the_best_there_is() {
    let sizing = fan("48.28");
    assert_eq!(sizing.verdict, Verdict::Infeasible);
    near(sizing.trial.value, 50.0_f64.sqrt(), 1e-5);
    near(sizing.margin(), 48.28 - 20.0 - 2.0 * 200.0_f64.sqrt(), 1e-6);
}

/// The rises of 100/x over 5 K and of 2 x over 10 K cross at `2 x^2 - 5 x = 100`, the zero of
/// `100/x - 5 - (2 x - 10)`: there the worst of both is least, whatever range is searched.
#[test]
fn the_closest_value_has_the_least_violation_in_its_unit() {
    let crossing = (5.0 + 825.0_f64.sqrt()) / 4.0;
    for (from, to) in [(1.0, 50.0), (0.001, 5000.0), (8.0, 9.0), (2.0, 10.0)] {
        for goal in ["minimise", "maximise"] {
            let study = format!(
                "{goal} = \"x\"\nvary = {{ x = {{ from = {from}, to = {to} }} }}\nrequire = \
                 [\"block.T - air.T <= 5 [K]\", \"x * 2 [K] <= 10 [K]\"]"
            );
            let sizing = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", &study)).unwrap();
            assert_eq!(sizing.verdict, Verdict::Infeasible);
            near(sizing.trial.value, crossing, 1e-7);
            near(sizing.margin(), 10.0 - 2.0 * crossing, 1e-6);
        }
    }
    // without the crossing in the range it is the nearer end
    let study = "minimise = \"x\"\nvary = { x = { from = 14, to = 50 } }\nrequire = \
        [\"block.T - air.T <= 5 [K]\", \"x * 2 [K] <= 10 [K]\"]";
    let sizing = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", study)).unwrap();
    near(sizing.trial.value, 14.0, 1e-12);
    assert_eq!(sizing.closest, 1);
    near(sizing.margin(), -18.0, 1e-9);
}

/// 1 K counts as 1 % of 12 W: `(100/x - 5) / 100 = (3 x - 12) / 12` at the root of
/// `x^2 / 4 - 0.95 x = 1`. A bound of 0 W counts as one of 100 W:
/// `(100/x - 5) / 100 = 3 x / 100` at the root of `3 x^2 + 5 x = 100`.
#[test]
fn violations_in_several_units_are_shares_of_bounds() {
    let table = [
        ("12", (0.95 + (0.95_f64 * 0.95 + 1.0).sqrt()) / 0.5),
        ("0", (-5.0 + 1225.0_f64.sqrt()) / 6.0),
    ];
    for (bound, expected) in table {
        for (from, to) in [(1.0, 50.0), (0.01, 500.0)] {
            let study = format!(
                "minimise = \"x\"\nvary = {{ x = {{ from = {from}, to = {to} }} }}\nrequire = \
                 [\"block.T - air.T <= 5 [K]\", \"x * 3 [W] <= {bound} [W]\"]"
            );
            let sizing = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", &study)).unwrap();
            assert_eq!(sizing.verdict, Verdict::Infeasible);
            near(sizing.trial.value, expected, 1e-7);
        }
    }
}

/// A requirement that nothing changes is broken by the same everywhere: the better end is the
/// answer.
#[test]
fn equal_violations_leave_the_better_end() {
    for (goal, best) in [("minimise", 1.0), ("maximise", 50.0)] {
        let study = format!(
            "{goal} = \"x\"\nvary = {{ x = {{ from = 1, to = 50 }} }}\nrequire = \
             [\"air.T <= 10 [degC]\"]"
        );
        let sizing = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", &study)).unwrap();
        near(sizing.trial.value, best, 1e-15);
        near(sizing.margin(), -10.0, 1e-12);
    }
}

#[test]
fn what_was_set_before_stays_set() {
    let study = "minimise = \"G\"\nvary = { G = { from = \"0.5 W/K\", to = \"50 W/K\" } }\nrequire \
        = [\"inner.T <= 80 [degC]\"]";
    let mut netlist = chain("", study);
    netlist.set(&["R_in=0.2 K/W".into()]).unwrap();
    near(solve(&netlist).unwrap().trial.value, 2.5, 1e-11);
}

#[test]
fn a_range_without_network_is_an_error_that_says_where() {
    let study = "minimise = \"x\"\nvary = { x = { from = -1, to = 5 } }\nrequire = [\"block.T <= \
        75 [degC]\"]";
    let error = solve(&one_node("G = \"x * 1 [W/K]\"", "100 W", study)).unwrap_err();
    assert_eq!(error.code(), "size::network");
    let SizeError::Trial { values, error, .. } = error else { panic!("{error}") };
    assert!(matches!(*error, TrialError::Network(_)) && values[0] < 0.0, "{values:?}");
}

#[test]
fn margins_are_those_of_the_network_as_it_is() {
    let study = "minimise = \"G\"\nvary = { G = { from = \"1 W/K\", to = \"9 W/K\" } }\n\
                 require = [\"inner.T <= 80 [degC]\", \"inner.T - outer.T < 6 [K]\"]";
    let netlist = chain("", study);
    let margins = judge(demand(&netlist)).unwrap().margins;
    // G = 3 W/K, R_in = 0.05 K/W
    near(margins[0], 80.0 - (20.0 + 100.0 / 3.0 + 5.0), 1e-12);
    near(margins[1], 1.0, 1e-10);
}

/// What is kept with a probability of 95 % is kept by 1.6449 standard deviations: with P = 100 ± 5 W
/// the margin 60 K - P / G has one of 5 W / G; with air of 20 ± 2 degC beside it one of
/// sqrt(25 / G^2 + 4), by Newton's method in 30 digits (mpmath).
#[test]
fn a_probability_takes_what_deviations_may_take() {
    let text = |air: &str| {
        format!(
            "format = 1\n[param]\nG = \"1 W/K\"\nP = \"100 ± 5 W\"\nT_air = \"{air}\"\n[node]\n\
             block = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"T_air\" }}\n\
             [resistor]\nskin = {{ from = \"block\", to = \"air\", G = \"G\" }}\n[source]\n\
             loss = {{ into = \"block\", P = \"P\" }}\n[size.s]\nminimise = \"G\"\n\
             vary = {{ G = {{ from = \"0.5 W/K\", to = \"50 W/K\" }} }}\n\
             require = [\"block.T <= 80 [degC]\"]\nprobability = \"95 %\"\n"
        )
    };
    let solved = |air: &str| {
        let netlist = parse("a.toml", &text(air)).unwrap_or_else(|rejected| panic!("{rejected}"));
        solve(&netlist).unwrap()
    };
    let one = solved("20 degC");
    near(one.trial.value, 1.803_737_802_245_956, 1e-9);
    near(one.trial.judged.deviations[0], 5.0 / one.trial.value, 1e-9);
    // straight in P, so nothing is left out
    assert!(one.trial.judged.left_out[0].abs() < 1e-9);
    let two = solved("20 ± 2 degC");
    near(two.trial.value, TWO_DEVIATIONS, 1e-9);
}

const TWO_DEVIATIONS: f64 = 1.836_755_734_099_352_6;

/// The largest P with `0.5 K/W P <= 500 K` at 95 %, by hand: z is the normal quantile, and a
/// rectangle ends at sqrt(3) deviations. The deviation is that of the value that is tried, whatever
/// the file has.
#[test]
fn a_deviation_in_percent_is_of_the_value_that_is_sized() {
    let z = 1.644_853_626_951_472_7;
    let table = [
        ("100 W ± 5 %", 1000.0 / (1.0 + 0.05 * z)),
        ("2 kW ± 5 %", 1000.0 / (1.0 + 0.05 * z)),
        ("100 ± 5 W", 1000.0 - 5.0 * z),
        ("100 W ± 5 % (rectangle)", 1000.0 / (1.0 + 0.05 * z / 3_f64.sqrt())),
        ("100 W ± 30 % (lognormal)", 1000.0 * f64::exp(-0.3 * z)),
        ("100 ± 30 W (lognormal)", 1000.0 * f64::exp(-0.3 * z)),
    ];
    for (power, expected) in table {
        let text = format!(
            "format = 1\n[param]\nP = \"{power}\"\n[node]\n\
             block = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
             [resistor]\nskin = {{ from = \"block\", to = \"air\", R = \"0.5 K/W\" }}\n[source]\n\
             loss = {{ into = \"block\", P = \"P\" }}\n[size.s]\nmaximise = \"P\"\n\
             vary = {{ P = {{ from = \"1 W\", to = \"5 kW\" }} }}\n\
             require = [\"block.T <= 520 [degC]\"]\nprobability = \"95 %\"\n"
        );
        let netlist = parse("a.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
        near(solve(&netlist).unwrap().trial.value, expected, 1e-9);
    }
}

/// P = m cp rise, m = rho V, R = (limit - ambient) / P.
#[test]
fn a_coolant_carries_the_heat_with_its_rise() {
    let task = CoolingTask { power: 223.0, limit: 383.15, ambient: 308.15, rise: 10.0 };
    near(task.cooling().unwrap().resistance, 75.0 / 223.0, 1e-15);
    let flow = task.flow(Coolant { specific_heat: 2000.0, density: 800.0 }).unwrap();
    near(flow.mass, 223.0 / 2e4, 1e-15);
    near(flow.volume, 223.0 / 1.6e7, 1e-15);
}

/// The part that a probability takes from margins that are not straight lines. Powers of 30 ± 3 W
/// into `a` and `b`, each over `G` to 20 degC; z = 1.644854 on one side, 1.959964 on both (SciPy's `norm.ppf`).
#[test]
fn a_probability_holds_on_both_sides_of_a_kink_and_for_times() {
    let solved = |require: &str| {
        let text = format!(
            "format = 1\n[param]\nP_a = \"30 ± 3 W\"\nP_b = \"30 ± 3 W\"\nG = \"1 W/K\"\n[node]\n\
             a = {{ C = \"100 J/K\", T0 = \"20 degC\" }}\nb = {{ C = \"100 J/K\", T0 = \"20 degC\" \
             }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
             r_a = {{ from = \"a\", to = \"air\", G = \"G\" }}\n\
             r_b = {{ from = \"b\", to = \"air\", G = \"G\" }}\n[source]\n\
             s_a = {{ into = \"a\", P = \"P_a\" }}\ns_b = {{ into = \"b\", P = \"P_b\" }}\n[size.s]\n\
             minimise = \"G\"\nvary = {{ G = {{ from = \"0.2 W/K\", to = \"20 W/K\" }} }}\n\
             require = [\"{require}\"]\nprobability = \"95 %\"\n"
        );
        let netlist = parse("a.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
        solve(&netlist).unwrap().trial.value
    };
    // |N(0, 3 sqrt(2) / G)| <= 5 K: both sides of the kink count
    near(solved("abs(a.T - b.T) <= 5 [K]"), 1.959_964 * 18.0_f64.sqrt() / 5.0, 1e-5);
    // one parameter, whatever the curve: (30 + 3 z) / G <= 31 K
    near(solved("(a.T - 20 [degC])^3 <= 31^3 * 1 [K^3]"), 34.934_561 / 31.0, 1e-6);
    // the hotter of two: 1.0868 is enough (largest of two normal numbers), by squares a little more
    let hotter = solved("max(a.T, b.T) <= 53 [degC]");
    assert!(hotter > 1.0868 && hotter < 1.04 * 1.0868, "{hotter}");
}

/// Powers of 10 ± 3 W into one body, or 20 ± 2 W into each of two, over `R` to 20 degC: none reaches
/// the kink alone. Their sum and difference are normal, z as above.
#[test]
fn a_kink_that_only_several_parameters_reach_together_is_seen() {
    let solved = |require: &str| {
        let powers: String = (0..9).map(|i| format!("P{i} = \"10 ± 3 W\"\n")).collect();
        let sum: Vec<String> = (0..9).map(|i| format!("P{i}")).collect();
        let text = format!(
            "format = 1\n[param]\nR = \"0.3 K/W\"\n{powers}A = \"20 ± 2 W\"\nB = \"20 ± 2 W\"\n\
             [node]\nx = {{ C = \"100 J/K\", T0 = \"20 degC\" }}\n\
             a = {{ C = \"10 J/K\", T0 = \"20 degC\" }}\nb = {{ C = \"10 J/K\", T0 = \"20 degC\" }}\n\
             [boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
             r = {{ from = \"x\", to = \"air\", R = \"R\" }}\n\
             r_a = {{ from = \"a\", to = \"air\", R = \"R\" }}\n\
             r_b = {{ from = \"b\", to = \"air\", R = \"R\" }}\n[source]\n\
             s = {{ into = \"x\", P = \"{}\" }}\ns_a = {{ into = \"a\", P = \"A\" }}\n\
             s_b = {{ into = \"b\", P = \"B\" }}\n[size.s]\nmaximise = \"R\"\n\
             vary = {{ R = {{ from = \"0.05 K/W\", to = \"5 K/W\" }} }}\n\
             require = [\"{require}\"]\nprobability = \"95 %\"\n",
            sum.join(" + ")
        );
        let netlist = parse("a.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
        solve(&netlist).unwrap().trial.value
    };
    let (one, two) = (1.644_853_627, 1.959_963_985);
    near(solved("max(0 [K], x.T - 54 [degC]) <= 1 [K]"), 35.0 / (90.0 + 9.0 * one), 1e-6);
    near(solved("max(0 [K], abs(a.T - b.T) - 5 [K]) <= 1 [K]"), 6.0 / (two * 8.0_f64.sqrt()), 1e-6);
    // the safe side of an intersection: 1.0223 is enough if both are hot, z = 0.760
    let both = solved("min(a.T, b.T) <= 42 [degC]");
    assert!(both <= 22.0 / (20.0 + 2.0 * 0.760) && both > 0.95, "{both}");
}
