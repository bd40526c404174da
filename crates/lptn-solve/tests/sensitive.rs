//! How a body and what is made of it change with parameters, exactly and by differences of runs,
//! against the derivatives of its exponential.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_network::{Network, ParameterId, Time};
use lptn_solve::{
    Gradient, Proceed, SensitiveError, SensitiveRun, Transient, Watch, can_move, sensitive_run,
    sensitive_run_observed,
};

const C: f64 = 1000.0;
const G: f64 = 2.0;
const P: f64 = 160.0;

/// A control that never switches, but that something waits for: there are no exact sensitivities
/// then.
const CONTROL: &str =
    "[control]\nfan = { sense = \"body\", on_above = \"500 degC\", off_below = \"400 degC\" }\n";

/// A body that is heated by `P` and loses `G` to air, from 20 degC.
fn network(more: &str, (g, fan): (&str, &str)) -> Network {
    let text = format!(
        "format = 1\n[param]\nP = \"160 W\"\nG = \"{g}\"\nT_air = \"20 degC\"\nC = \"1 kJ/K\"\n{more}[node]\nbody = {{ C = \
         \"C\", T0 = \"20 degC\" }}\ntwin = {{ C = \"1 kJ/K\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"T_air\" \
         }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", G = \"G{fan}\" }}\nother = {{ from = \"twin\", to = \
         \"air\", G = \"2 W/K\" }}\n[source]\nheat = {{ into = \"body\", P = \"P\" }}\nsame = {{ into = \"twin\", P = \"160 \
         W\" }}\n[limit]\nhot = {{ of = \"body.T\", below = \"150 degC\" }}\nboth = {{ of = \"min(body.T, twin.T)\", above = \
         \"0 degC\" }}\n[run]\nstop = \"1000 s\"\nreport = {{ loss = \"skin.Q\", share = \"skin.Q / P\" }}\n"
    );
    let netlist = lptn_netlist::parse("sensitive.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    netlist.network
}

fn id(network: &Network, name: &str) -> ParameterId {
    let place = network.parameters().iter().position(|parameter| parameter.name == name).unwrap();
    network.parameter_ids().nth(place).unwrap()
}

fn run(network: &Network) -> SensitiveRun {
    let body = network.node("body").unwrap();
    let watch = vec![Watch { node: body, level: None }];
    let settings = Transient { watch, ..Transient::until(Time(1000.0)) };
    let settings = settings.every(Time(100.0)).tolerance(1e-7);
    let parameters = ["P", "G", "T_air", "C"].map(|name| id(network, name));
    sensitive_run(network, &settings, &parameters).unwrap()
}

/// What the temperature in K and the heat that is lost in W change with P, G, T_air and C after a
/// time in s.
fn exact(t: f64) -> [[f64; 2]; 4] {
    let left = (-G * t / C).exp();
    let rise = P / G * (1.0 - left);
    let by_g = -P / (G * G) * (1.0 - left) + P / G * t / C * left;
    let by_c = -P / G * G * t / (C * C) * left;
    [
        [(1.0 - left) / G, 1.0 - left],
        [by_g, rise + G * by_g],
        [1.0 - left, -G * left],
        [by_c, G * by_c],
    ]
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error * (1.0 + expected.abs()), "{found} for {expected}");
}

/// Holds temperatures and results in all rows to their derivatives.
fn holds(run: &SensitiveRun, network: &Network, error: f64) {
    let body = network.node("body").unwrap();
    let reports = network.reports();
    for (k, name) in ["P", "G", "T_air", "C"].into_iter().enumerate() {
        let id = id(network, name);
        let temperatures = run.sensitivity(id, body).unwrap();
        let losses = run.result_slope(id, &reports[0].value).unwrap();
        let shares = run.result_slope(id, &reports[1].value).unwrap();
        assert_eq!([temperatures.len(), losses.len(), shares.len()], [11; 3]);
        for (row, time) in run.solution.times().iter().enumerate() {
            let [temperature, loss] = exact(*time)[k];
            near(temperatures[row], temperature, error);
            near(losses[row], loss, error);
            let own = if k == 0 { -(1.0 - (-G * time / C).exp()) / P } else { 0.0 };
            near(shares[row], own + loss / P, error);
        }
    }
}

#[test]
fn sensitivities_are_exact_where_the_laws_have_derivatives() {
    let network = network("", ("2 W/K", ""));
    let run = run(&network);
    assert_eq!(run.gradient, Gradient::Exact);
    holds(&run, &network, 1e-6);
    let limits: Vec<_> = network.limit_ids().collect();
    for row in [0, 3, 10] {
        let time = run.solution.times()[row];
        let left = (-G * time / C).exp();
        near(run.margin_in_row(limits[0], row).unwrap(), 130.0 - 80.0 * (1.0 - left), 1e-6);
        for (name, k, by) in [("P", 0, 0.1), ("G", 1, 1e-3), ("T_air", 2, 0.01)] {
            let found = run.margin_slope_in_row((id(&network, name), by), (limits[0], row));
            near(found.unwrap().unwrap(), -exact(time)[k][0], 1e-6);
        }
    }
    let p = id(&network, "P");
    // where both are equal the smaller one bends, unless neither moves
    assert_eq!(run.margin_slope_in_row((p, 0.1), (limits[1], 10)).unwrap(), None);
    assert_eq!(run.margin_slope_in_row((p, 0.1), (limits[1], 0)).unwrap(), Some(0.0));
    assert!(run.peak(p, network.node("body").unwrap()).is_none());
    assert!(run.margin(p, limits[0]).is_none());
}

/// The runs beside it are a thousandth of the parameter apart: what is left is a third derivative.
#[test]
fn sensitivities_are_differences_of_runs_where_something_switches() {
    let network = network(CONTROL, ("2 W/K", " * (1 + fan)"));
    let run = run(&network);
    assert!(matches!(run.gradient, Gradient::Differences(_)));
    holds(&run, &network, 1e-5);
    let (body, twin) = (network.node("body").unwrap(), network.node("twin").unwrap());
    let limit = network.limit_ids().next().unwrap();
    for (k, name) in ["P", "G", "T_air", "C"].into_iter().enumerate() {
        let id = id(&network, name);
        near(run.peak(id, body).unwrap(), exact(1000.0)[k][0], 1e-5);
        near(run.margin(id, limit).unwrap(), -exact(1000.0)[k][0], 1e-5);
        assert!(run.peak(id, twin).is_none(), "it is not watched");
    }
}

/// A conductance of 2 W/K at the upper or the lower end of a table over a parameter.
fn at_the_end_of_a_table(control: &str, upper: bool) -> Network {
    let (x, y) = if upper { (1, ["1 W/K", "2 W/K"]) } else { (0, ["2 W/K", "3 W/K"]) };
    let table = format!("x = {x}\n{control}[table]\ng = {{ x = [0, 1], y = {y:?} }}\n");
    let fan = if control.is_empty() { "" } else { " * (1 + fan)" };
    network(&table, ("2 W/K", &format!(" * 0 + g(x){fan}")))
}

/// There a parameter has runs to one side: two of them make a difference of the second order.
#[test]
fn a_parameter_at_the_end_of_its_range_has_differences_to_one_side() {
    for upper in [true, false] {
        let network = at_the_end_of_a_table(CONTROL, upper);
        let x = id(&network, "x");
        let settings = Transient::until(Time(1000.0)).every(Time(100.0)).tolerance(1e-7);
        let run = sensitive_run(&network, &settings, &[x]).unwrap();
        assert!(matches!(run.gradient, Gradient::Differences(_)));
        let found = run.sensitivity(x, network.node("body").unwrap()).unwrap();
        for (slope, t) in found.iter().zip(run.solution.times()) {
            near(*slope, exact(*t)[1][0], 2e-5);
        }
        can_move(&network, x).unwrap();
        can_move(&network, id(&network, "P")).unwrap();
    }
}

#[test]
fn what_is_made_of_a_parameter_at_the_end_of_its_range_is_a_difference_to_one_side() {
    for upper in [true, false] {
        let network = at_the_end_of_a_table("", upper);
        let x = id(&network, "x");
        let settings = Transient::until(Time(1000.0)).every(Time(100.0)).tolerance(1e-7);
        let run = sensitive_run(&network, &settings, &[x]).unwrap();
        assert_eq!(run.gradient, Gradient::Exact);
        let losses = run.result_slope(x, &network.reports()[0].value).unwrap();
        let limit = network.limit_ids().next().unwrap();
        for (row, t) in run.solution.times().iter().enumerate() {
            let [temperature, loss] = exact(*t)[1];
            near(losses[row], loss, 1e-3);
            let margin = run.margin_slope_in_row((x, 1e-4), (limit, row)).unwrap().unwrap();
            near(margin, -temperature, 1e-5);
        }
    }
}

#[test]
fn a_run_or_one_beside_it_can_be_interrupted() {
    let network = network(CONTROL, ("2 W/K", " * (1 + fan)"));
    let settings = Transient::until(Time(1000.0)).at(&[]);
    let parameters = [id(&network, "P")];
    let steps = std::cell::Cell::new(0);
    let interrupted = |after: usize| {
        steps.set(0);
        let found = sensitive_run_observed(&network, (&settings, &parameters), &|_| {
            steps.set(steps.get() + 1);
            if steps.get() > after { Proceed::Interrupt } else { Proceed::Continue }
        });
        matches!(found, Err(SensitiveError::Interrupted))
    };
    assert!(!interrupted(usize::MAX));
    let all = steps.get();
    for after in [0, all / 2, all - 1] {
        assert!(interrupted(after), "{after} of {all}");
        assert!(steps.get() <= after + 2, "the run to the other side has one step at most");
    }
}

/// A parameter that a table knows from one value to another only.
fn in_a_table(value: f64, x: [f64; 2]) -> Network {
    let table =
        format!("x = {value:?}\n[table]\ng = {{ x = {x:?}, y = [\"1 W/K\", \"2 W/K\"] }}\n");
    network(&table, ("2 W/K", " * 0 + g(x)"))
}

/// By a thousandth of itself, to one side at least.
#[test]
fn a_parameter_can_move_if_the_network_takes_a_value_beside_it() {
    let moves = |value: f64, x: [f64; 2]| {
        let network = in_a_table(value, x);
        can_move(&network, id(&network, "x"))
    };
    for (value, x) in [(2.0, [1.0, 3.0]), (2.0, [2.0, 3.0]), (2.0, [1.0, 2.0])] {
        assert!(moves(value, x).is_ok(), "{value} {x:?}");
        assert!(moves(-value, [-x[1], -x[0]]).is_ok(), "{value} {x:?}");
    }
    assert!(moves(2.0, [1.9979, 2.0019]).is_ok() && moves(2.0, [1.9981, 2.0021]).is_ok());
    // refused for the larger value
    let refused = moves(2.0, [1.9981, 2.0019]).unwrap_err().to_string();
    assert!(refused.contains("2.002"), "{refused}");
}

/// `exp((P - 160 W) / 0.1 W)` changes by 10 of itself per W; the difference is one of a hundred
/// thousandth of the parameter.
#[test]
fn a_result_of_a_parameter_is_a_difference_far_finer_than_runs_are() {
    let text = "format = 1\n[param]\nP = \"160 W\"\n[node]\nbody = { C = \"1 kJ/K\", T0 = \"20 \
        degC\" }\n[boundary]\nair = { T = \
                \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", G = \"2 W/K\" \
                }\n[source]\nheat = { into = \
                \"body\", P = \"P\" }\n[run]\nstop = \"10 s\"\nreport = { steep = \"exp((P - 160 \
                [W]) / 0.1 [W])\" }\n";
    let netlist = lptn_netlist::parse("steep.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let network = &netlist.network;
    let settings = Transient::until(Time(10.0)).at(&[10.0]);
    let p = id(network, "P");
    let run = sensitive_run(network, &settings, &[p]).unwrap();
    assert_eq!(run.gradient, Gradient::Exact);
    for slope in run.result_slope(p, &network.reports()[0].value).unwrap() {
        near(slope, 10.0, 1e-4);
    }
}

/// A margin of 0 or 1 kW that a parameter moves by rounding alone is straight.
#[test]
fn a_margin_that_rounding_moves_is_straight() {
    let text = "format = 1\n[param]\nP = \"160 W\"\n[node]\nbody = { C = \"1 kJ/K\", T0 = \"20 \
        degC\" }\n[boundary]\nair = { T = \
                \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", G = \"2 W/K\" \
                }\n[source]\nheat = { into = \
                \"body\", P = \"P\" }\n[limit]\nnone = { of = \"1000 * P / 0.3 * 0.3 - 1000 * \
                P\", above = \"0 W\" }\nsome = { of = \"1000 [W] + (1000 * P / 0.3 * 0.3 - 1000 \
                * P)\", above = \"0 W\" }\n[run]\nstop = \"10 s\"\n";
    let netlist = lptn_netlist::parse("rounds.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let network = &netlist.network;
    let p = id(network, "P");
    let run = sensitive_run(network, &Transient::until(Time(10.0)).at(&[10.0]), &[p]).unwrap();
    for (limit, margin) in network.limit_ids().zip([0.0, 1e3]) {
        let mut moved = false;
        for by in [0.1, 0.7] {
            let own = run.margin_in_row(limit, 0).unwrap();
            near(own, margin, 1e-10);
            let rounds = |p: f64| 1000.0 * p / 0.3 * 0.3 - 1000.0 * p;
            moved |= (rounds(160.0 + by) + rounds(160.0 - by) - 2.0 * rounds(160.0)).abs() > 1e-12;
            let slope = run.margin_slope_in_row((p, by), (limit, 0)).unwrap();
            assert!(slope.unwrap().abs() < 1e-9, "{slope:?}");
        }
        assert!(moved, "there is rounding");
    }
}
