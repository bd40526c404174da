//! Properties of substances as functions in paths, capacities, states and sensitivities, against
//! closed forms.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{Gradient, Selection, Solution, SteadyState, Table, Transient, sensitive_run};
use lptn_units::Unit;

fn network(text: &str) -> Network {
    let text = format!(
        "format = 1\n[fluid]\ngas = {{ cp = \"1 J/(kg K)\", k = {{ x = [\"0 degC\", \"100 degC\"], y = \
         [\"0.1 W/(m K)\", \"0.2 W/(m K)\"] }} }}\n[boundary]\nice = {{ T = \"0 degC\" }}\n{text}"
    );
    let netlist = lptn_netlist::parse("net.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    netlist.network
}

fn run(network: &Network) -> Solution {
    let system = ThermalSystem::assemble(network).unwrap();
    let settings = Transient::until(Time(1000.0)).every(Time(500.0)).tolerance(1e-6);
    settings.solve(&system).unwrap()
}

fn near(found: f64, right: f64, within: f64) {
    assert!((found - right).abs() <= within, "{found} is not {right}");
}

/// A body at `x` over 0 degC that loses L k(T) x, with k = A + B x.
const A: f64 = 0.1;
const B: f64 = 0.001;
const L: f64 = 5.0;
const C: f64 = 1000.0;

const COOLS: &str = "[param]\nL = \"5 m\"\n[node]\nbody = { C = \"1 kJ/K\", T0 = \"80 degC\" }\n[resistor]\n\
    skin = { from = \"body\", to = \"ice\", G = \"L * gas.k(T_from)\" }\n[run]\nstop = \"1000 s\"\n";

/// Bernoulli's equation x' = -(L/C) (A x + B x^2): x = A / ((A/x0 + B) exp(A L t/C) - B).
fn cooled(length: f64, t: f64) -> f64 {
    A / ((A / 80.0 + B) * (A * length * t / C).exp() - B)
}

#[test]
fn a_run_with_a_conductivity_over_temperature_is_that_of_bernoulli() {
    let network = network(COOLS);
    let solution = run(&network);
    let body = solution.temperature(network.node("body").unwrap()).unwrap();
    for (time, row) in [(500.0, 1), (1000.0, 2)] {
        near(body[row] - 273.15, cooled(L, time), 2e-5);
    }
}

/// The derivative of the closed form with respect to L.
#[test]
fn sensitivities_read_the_slope_of_the_property() {
    let network = network(COOLS);
    let parameter = network.parameter("L").unwrap();
    let settings = Transient::until(Time(1000.0)).every(Time(500.0)).tolerance(1e-7);
    let run = sensitive_run(&network, &settings, &[parameter]).unwrap();
    assert_eq!(run.gradient, Gradient::Exact);
    let (t, step) = (1000.0, 1e-4);
    let slope = (cooled(L + step, t) - cooled(L - step, t)) / (2.0 * step);
    let found = run.sensitivity(parameter, network.node("body").unwrap()).unwrap();
    near(found[2], slope, 1e-5 * slope.abs());
}

/// Air at 350 K has 0.0300 W/(m K): Incropera et al., 7th edition, table A.4. The library has
/// 0.03000328 W/(m K) from CoolProp.
#[test]
fn a_steady_state_is_that_of_the_printed_conductivity() {
    let network = network(
        "[node]\nbody = { massless = true }\n[boundary.room]\nT = \"26.85 degC\"\n[resistor]\nskin \
         = { from = \"body\", to = \"room\", G = \"2 [m] * air.k(body.T)\" }\n[source]\nheat = { into = \
         \"body\", P = \"3 W\" }\n",
    );
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    near(steady[network.node("body").unwrap()], 350.0, 0.01);
}

/// C = m cp(T) with cp = c0 + c1 x under a constant power: m (c0 x + c1 x^2/2) = P t.
#[test]
fn a_capacity_and_a_state_read_a_property() {
    let network = network(
        "[material]\ncast = { cp = { x = [\"0 degC\", \"100 degC\"], y = [\"400 J/(kg K)\", \"600 J/(kg \
         K)\"] } }\n[node]\nbody = { C = \"1 [kg] * cast.cp(T)\", T0 = \"0 degC\" }\nother = { C = \"1 \
         J/K\", T0 = \"0 degC\" }\n[resistor]\nr = { from = \"other\", to = \"ice\", R = \"1 K/W\" }\n\
         [state]\nsum = { rate = \"gas.k(other.T) / 100 [s]\", start = \"0 W/(m K)\", size = \"1 W/(m K)\" }\n[source]\nheat = { \
         into = \"body\", P = \"44 W\" }\n[run]\nstop = \"1000 s\"\n",
    );
    let solution = run(&network);
    let body = solution.temperature(network.node("body").unwrap()).unwrap();
    // 44 kJ = 400 x + x^2
    near(body[2] - 273.15, -200.0 + (200.0_f64 * 200.0 + 44_000.0).sqrt(), 1e-4);
    let selection = Selection::matching(&network, &["sum".to_owned()]).unwrap();
    let table = Table::of_solution(&solution, &selection, &Unit::parse("K").unwrap());
    near(table.columns().last().unwrap().values[2], 1.0, 1e-6);
}
