//! Sizing over a run and over a settled cycle, against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, Over, parse};
use lptn_network::{Network, RunSettings};
use lptn_solve::Proceed;
use lptn_study::{Demand, Moments, SizeError, SizeTask, Sizing, TrialError, Verdict, size};

/// One node of 1 kJ/K that is heated and loses heat over `R` to air of 20 degC.
fn one_node(parameters: &str, heat: &str, study: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\n{parameters}\n[node]\nblock = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n\
         [boundary]\nair = {{ T = \"20 degC\" }}\n\
         [resistor]\nskin = {{ from = \"block\", to = \"air\", R = \"R\" }}\n\
         [source]\nloss = {{ into = \"block\", P = \"{heat}\" }}\n{study}\n"
    );
    parse("one_node.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn solve(netlist: &Netlist) -> Result<Sizing, SizeError> {
    let study = &netlist.studies.sizes[0];
    let run = |network: &Network| -> Result<RunSettings, String> {
        netlist.run_of(network).map(Option::unwrap).map_err(|problems| problems[0].message.clone())
    };
    let cycle = |network: &Network| {
        let period = study.period(network).unwrap().or(network.repeat_period().unwrap());
        Ok(RunSettings::cycle(netlist.run_of(network).unwrap().as_ref(), period.unwrap()))
    };
    let moments = match study.over {
        Over::Steady => Moments::Steady(0.0),
        Over::Run => Moments::Run(&run),
        Over::Periodic => Moments::Periodic(&cycle),
    };
    size(&SizeTask {
        demand: Demand {
            network: &netlist.network,
            netlist,
            cases: &[],
            requirements: &study.requirements,
            moments,
            doubt: None,
            watcher: &|_| Proceed::Continue,
        },
        parameter: study.ranges(&netlist.network).unwrap()[0].0,
        range: study.ranges(&netlist.network).unwrap()[0].1,
        goal: study.goal,
    })
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    let off = (found - expected).abs() / expected.abs();
    assert!(off <= relative, "{found:e} is not {expected:e}: {off:.1e}");
}

/// R_in in K/W, the sized G in W/K, and which of both limits binds.
const TWO_NODES: [(f64, f64, usize); 2] =
    [(0.05, 2.089_318_473_701_052, 1), (0.2, 2.764_741_115_845_265_6, 0)];
const R_ABOVE: f64 = 0.409_578_075_407_070_86;
const R_ONE_SHOT: f64 = 1.593_887_982_573_626;

/// T - T_air = P R (1 - exp(-t / (R C))), at its highest at the end: 100 W for 10 minutes may warm
/// it by 50 K. R of 100 R (1 - exp(-0.6 / R)) = 50 by Newton's method in 50 digits (mpmath).
#[test]
fn a_one_shot_duty_stays_below_for_its_time() {
    let study = "[run]\nstop = \"10 min\"\n[size.s]\nmaximise = \"R\"\nover = \"run\"\n\
                 vary = { R = { from = \"0.05 K/W\", to = \"5 K/W\" } }\n\
                 require = [\"block.T <= 70 [degC]\"]";
    let sizing = solve(&one_node("R = \"1 K/W\"", "100 W", study)).unwrap();
    assert_eq!(sizing.verdict, Verdict::Bound);
    near(sizing.trial.value, R_ONE_SHOT, 1e-9);
    near(sizing.trial.judged.worst_at[0].unwrap(), 600.0, 1e-12);
    assert!(sizing.error.unwrap() < 1e-8 * R_ONE_SHOT, "{:?}", sizing.error);
}

/// The time until it is 50 K warmer: -R C ln(1 - 50 K / (P R)).
#[test]
fn the_time_to_a_limit_has_its_closed_form() {
    let study = "[run]\nstop = \"t_on\"\n[size.s]\nmaximise = \"t_on\"\nover = \"run\"\n\
                 vary = { t_on = { from = \"1 s\", to = \"2 h\" } }\n\
                 require = [\"block.T <= 70 [degC]\"]";
    for (r, power) in [(0.8_f64, 100.0), (2.0, 30.0), (0.51, 100.0)] {
        let parameters = format!("R = \"{r} K/W\"\nt_on = \"1 min\"");
        let sizing = solve(&one_node(&parameters, &format!("{power} W"), study)).unwrap();
        near(sizing.trial.value, -r * 1000.0 * (-50.0 / (power * r)).ln_1p(), 1e-9);
    }
}

/// 150 W for 300 s of every 1000 s, 10 W for the rest. At the end of the load the settled rise is
/// (150 W R (1 - a) + 10 W R (1 - b) a) / (1 - a b) with a = exp(-300 s / (R C)) and b = exp(-700 s /
/// (R C)); the R that makes it 40 K by Newton's method in 50 digits (mpmath).
#[test]
fn the_peak_of_a_two_level_duty_has_its_closed_form() {
    let study = "[signal]\nduty = { t = [0, 300], v = [150, 10], t_unit = \"s\", v_unit = \"W\", \
                 interp = \"previous\", after_end = \"repeat\", period = \"1000 s\" }\n[size.s]\n\
                 maximise = \"R\"\nover = \"periodic\"\n\
                 vary = { R = { from = \"0.05 K/W\", to = \"5 K/W\" } }\n\
                 require = [\"block.T <= 60 [degC]\"]";
    let sizing = solve(&one_node("R = \"1 K/W\"", "duty", study)).unwrap();
    near(sizing.trial.value, 0.471_075_078_509_985_5, 1e-8);
    near(sizing.trial.judged.worst_at[0].unwrap(), 300.0, 1e-12);
    assert!(sizing.error.unwrap() < 1e-8, "{:?}", sizing.error);
    // a limit from below binds at the start of the load, where b follows on a
    let study = study.replace("maximise", "minimise").replace("<= 60", ">= 30");
    let sizing = solve(&one_node("R = \"1 K/W\"", "duty", &study)).unwrap();
    near(sizing.trial.value, R_ABOVE, 1e-8);
}

/// A fan that heats what it cools, for 10 minutes: (100/x + 2 x) K (1 - exp(-0.6 x)) is 30 K twice,
/// by Newton's method in 40 digits (mpmath).
#[test]
fn what_helps_first_and_harms_later_is_told_over_a_run_too() {
    let study = "[run]\nstop = \"10 min\"\n[size.s]\nminimise = \"x\"\nover = \"run\"\n\
                 vary = { x = { from = 1, to = 50 } }\nrequire = [\"block.T <= 50 [degC]\"]";
    let netlist = one_node("x = 3\nR = \"1 [K/W] / x\"", "100 [W] + 2 [W] * x^2", study);
    let sizing = solve(&netlist).unwrap();
    near(sizing.trial.value, 4.003_052_654_355_523, 1e-8);
    near(sizing.breaks_again.unwrap(), 10.070_934_131_063_34, 1e-8);
}

/// 200 W into 1 kJ/K that radiates to 20 degC: the area that brings it to 100 degC in 600 s, from
/// the integral of C dT / (P - e s A (T^4 - T_air^4)) in 40 digits (mpmath).
#[test]
fn radiation_is_sized_over_a_run() {
    let study = "[radiation]\nglow = { from = \"block\", to = \"air\", emissivity = 0.9, area = \
                 \"A\" }\n[run]\nstop = \"600 s\"\n[size.s]\nminimise = \"A\"\nover = \"run\"\n\
                 vary = { A = { from = \"0.01 m^2\", to = \"10 m^2\" } }\n\
                 require = [\"block.T <= 100 [degC]\"]";
    let sizing = solve(&one_node("A = \"1 m^2\"\nR = \"1e15 K/W\"", "200 W", study)).unwrap();
    near(sizing.trial.value, 0.207_626_474_342_499_64, 1e-8);
}

/// 100 W for half an hour into the first of two nodes; rises by the matrix exponential in 40 digits
/// (mpmath).
#[test]
fn limits_bind_in_turn_over_a_run() {
    for (r_in, expected, binding) in TWO_NODES {
        let text = format!(
            "format = 1\n[param]\nG = \"3 W/K\"\n[default]\nT0 = \"20 degC\"\n[node]\n\
             inner = {{ C = \"1 kJ/K\" }}\nouter = {{ C = \"1 kJ/K\" }}\n[boundary]\n\
             air = {{ T = \"20 degC\" }}\n[resistor]\n\
             joint = {{ from = \"inner\", to = \"outer\", R = \"{r_in} K/W\" }}\n\
             skin = {{ from = \"outer\", to = \"air\", G = \"G\" }}\n\
             [source]\nloss = {{ into = \"inner\", P = \"100 W\" }}\n[run]\nstop = \"30 min\"\n\
             [size.s]\nminimise = \"G\"\nover = \"run\"\n\
             vary = {{ G = {{ from = \"0.1 W/K\", to = \"20 W/K\" }} }}\n\
             require = [\"inner.T <= 70 [degC]\", \"outer.T <= 60 [degC]\"]\n"
        );
        let netlist = parse("two.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
        let sizing = solve(&netlist).unwrap();
        near(sizing.trial.value, expected, 1e-8);
        assert_eq!(sizing.closest, binding);
    }
}

/// What is compared may change with time, on both sides: a limit that falls as a straight line.
#[test]
fn a_requirement_may_move() {
    let study = "[run]\nstop = \"1000 s\"\n[size.s]\nmaximise = \"P\"\nover = \"run\"\n\
                 vary = { P = { from = \"1 W\", to = \"500 W\" } }\n\
                 require = [\"block.T - air.T <= 60 [K] - t * 40 [K] / 1000 [s]\"]";
    let sizing = solve(&one_node("P = \"1 W\"\nR = \"0.5 K/W\"", "P", study)).unwrap();
    // at the end 20 K are left: P R (1 - exp(-2))
    near(sizing.trial.value, 20.0 / (0.5 * -(-2.0_f64).exp_m1()), 1e-8);
}

#[test]
fn what_nothing_keeps_is_told_over_a_run_too() {
    let study = "[run]\nstop = \"1 h\"\n[size.s]\nminimise = \"R\"\nover = \"run\"\n\
                 vary = { R = { from = \"0.5 K/W\", to = \"5 K/W\" } }\n\
                 require = [\"block.T <= 30 [degC]\"]";
    let sizing = solve(&one_node("R = \"1 K/W\"", "100 W", study)).unwrap();
    assert_eq!(sizing.verdict, Verdict::Infeasible);
    near(sizing.trial.value, 0.5, 1e-4);
    near(sizing.margin(), 10.0 - 50.0 * -(-7.2_f64).exp_m1(), 1e-3);
}

/// Violations cross where, of x = 1 / R in W/K, `100 / x (1 - e^(-x / 2)) - 5 = 2 x - 10` (SciPy's
/// brentq): runs too answer with the crossing, whatever the range.
#[test]
fn the_closest_value_over_a_run_does_not_depend_on_the_range() {
    for (from, to) in [(0.02, 1.0), (0.0002, 1000.0)] {
        let study = format!(
            "[run]\nstop = \"500 s\"\n[size.s]\nminimise = \"R\"\nover = \"run\"\n\
             vary = {{ R = {{ from = \"{from} K/W\", to = \"{to} K/W\" }} }}\n\
             require = [\"max(block.T) <= 25 [degC]\", \"2 [K^2/W] / R <= 10 [K]\"]"
        );
        let sizing = solve(&one_node("R = \"1 K/W\"", "100 W", &study)).unwrap();
        assert_eq!(sizing.verdict, Verdict::Infeasible);
        near(sizing.trial.value, 1.0 / CROSSING, 1e-8);
        near(sizing.margin(), 10.0 - 2.0 * CROSSING, 1e-7);
    }
}

const CROSSING: f64 = 8.377_714_921_387_591;

/// A run that would end before it begins, at values in the range.
#[test]
fn values_without_a_run_are_an_error_that_says_where() {
    let study = "[run]\nstop = \"t_on\"\n[size.s]\nmaximise = \"t_on\"\nover = \"run\"\n\
                 vary = { t_on = { from = \"-1 s\", to = \"2 h\" } }\n\
                 require = [\"block.T <= 70 [degC]\"]";
    let error = solve(&one_node("R = \"1 K/W\"\nt_on = \"1 min\"", "100 W", study)).unwrap_err();
    assert_eq!(error.code(), "size::run");
    let SizeError::Trial { error, .. } = error else { panic!("{error}") };
    assert!(matches!(*error, TrialError::Settings(ref says) if says.contains("ends")), "{error}");
}
