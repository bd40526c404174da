//! Pipes with plug flow: the method of characteristics by hand, and classical Runge-Kutta steps of
//! the delay equations.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::TAU;

use crate::elements_helper::Random;

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, Network, NoTangents, Time};
use lptn_solve::{
    ExactSolution, Linearised, LinearisedError, Method, Periodic, PeriodicError, Proceed,
    Selection, Solution, State, StateRates, SteadyState, Table, Transient, sensitive_run,
};
use lptn_units::Unit;

const ZERO: f64 = 273.15;

fn network(text: &str) -> Network {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    netlist.network
}

fn until(times: &[f64], tolerance: f64) -> Transient {
    Transient::until(Time(*times.last().unwrap())).at(times).tolerance(tolerance)
}

fn run(network: &Network, times: &[f64], tolerance: f64) -> Solution {
    let system = ThermalSystem::assemble(network).unwrap();
    until(times, tolerance).solve(&system).unwrap_or_else(|e| panic!("{e}"))
}

fn column(solution: &Solution, name: &str) -> Vec<f64> {
    let selection = Selection::matching(solution.network(), &[name.to_owned()]).unwrap();
    let table = Table::of_solution(solution, &selection, &Unit::parse("degC").unwrap());
    table.columns().last().unwrap().values.clone()
}

fn near(found: f64, right: f64, error: f64, at: &str) {
    assert!((found - right).abs() <= error, "{found} is not {right} to {error}: {at}");
}

/// Water of 418 W/K takes 100 s through a pipe of 41.8 kJ/K, then enters a tank of as much.
const TANK: &str = r#"
format = 1
[default]
T0 = "20 degC"
[boundary]
inlet = { T = "60 degC" }
drain = { T = "20 degC" }
[node]
tank = { C = "41.8 kJ/K" }
[pipe]
supply = { from = "inlet", to = "tank", mcp = "418 W/K", C = "41.8 kJ/K" }
[advection]
out = { from = "tank", to = "drain", mcp = "418 W/K" }
"#;

#[test]
fn a_step_arrives_after_content_over_flow() {
    let times = [0.0, 99.0, 100.0 - 1e-6, 100.0 + 1e-6, 150.0, 200.0];
    let solution = run(&network(TANK), &times, 1e-5);
    let leaves = column(&solution, "supply.T");
    for (found, right) in leaves.iter().zip([20.0, 20.0, 20.0, 60.0, 60.0, 60.0]) {
        near(*found, right, 1e-9, "the fluid that leaves");
    }
    for (time, found) in times.iter().zip(column(&solution, "tank.T")) {
        let right = 60.0 - 40.0 * (-(time - 100.0).max(0.0) / 100.0).exp();
        near(found, right, 1e-4, "the tank");
    }
    // 418 W/K (60 - 20) K for the 100 s in which cold fluid still leaves
    let pipe = solution.network().node("supply").unwrap();
    near(solution.ledger().stored[pipe.index()], 418.0 * 40.0 * 100.0, 1e-3, "heat in the pipe");
    assert_eq!(solution.method(), Some(Method::Cvode));
}

#[test]
fn a_volume_and_a_mass_of_a_fluid_are_contents() {
    let water = "[fluid]\nwater = { cp = \"4180 J/(kg K)\", density = \"1000 kg/m^3\" }\n";
    let forms = [
        "flow = \"0.1 kg/s\", fluid = \"water\", mass = \"10 kg\"",
        "flow = \"6 L/min\", flow_T = \"20 degC\", fluid = \"water\", volume = \"10 L\"",
    ];
    for form in forms {
        let text = TANK
            .replace("mcp = \"418 W/K\", C = \"41.8 kJ/K\" }\n[adv", &format!("{form} }}\n[adv"));
        let solution = run(&network(&format!("{text}{water}")), &[0.0, 99.0, 101.0, 200.0], 1e-5);
        let found = column(&solution, "supply.T");
        near(found[1], 20.0, 1e-9, form);
        near(found[2], 60.0, 1e-9, form);
        let right = 60.0 - 40.0 * (-1.0_f64).exp();
        near(column(&solution, "tank.T")[3], right, 1e-4, form);
        let pipe = solution.network().node("supply").unwrap();
        near(solution.ledger().stored[pipe.index()], 1.672e6, 1.0, form);
    }
}

/// The specific heat of the fluid depends on temperature: the energy balance counts its enthalpy.
#[test]
fn the_heat_in_a_pipe_is_that_of_its_enthalpy() {
    let oil = "[fluid]\noil = { cp = \"1800 [J/(kg K)] + 4 [J/(kg K^2)] * (T - 20 [degC])\" }\n";
    let form = "flow = \"0.1 kg/s\", fluid = \"oil\", mass = \"10 kg\"";
    let text =
        TANK.replace("mcp = \"418 W/K\", C = \"41.8 kJ/K\" }\n[adv", &format!("{form} }}\n[adv"));
    let solution = run(&network(&format!("{text}{oil}")), &[0.0, 50.0], 1e-5);
    let pipe = solution.network().node("supply").unwrap();
    // 5 kg, the integral of 1800 + 4 x from 0 to 40
    near(solution.ledger().stored[pipe.index()], 5.0 * (1800.0 * 40.0 + 2.0 * 1600.0), 1.0, "5 kg");
}

/// The time at which a function that rises reaches a value.
fn when(value: f64, mut from: f64, mut to: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (from + to);
        if of(middle) < value { from = middle } else { to = middle }
    }
    0.5 * (from + to)
}

/// The flow swells and ebbs, the inlet is a sine: characteristics by hand.
#[test]
fn a_flow_that_varies_carries_what_entered() {
    let text = r#"
format = 1
[boundary]
inlet = { T = "40 [degC] + 10 [K] * sin(2 * pi * t / 70 [s])" }
drain = { T = "20 degC" }
[pipe]
line = { from = "inlet", to = "drain", mcp = "100 [W/K] * (1 + 0.8 * sin(2 * pi * t / 60 [s]))", C = "3 kJ/K", T0 = "40 degC" }
"#;
    let passed = |t: f64| 100.0 * (t + 0.8 * 60.0 / TAU * (1.0 - (TAU * t / 60.0).cos()));
    let times: Vec<f64> = (0..=60).map(|i| 5.0 * f64::from(i)).collect();
    for tolerance in [1e-4, 1e-6] {
        let solution = run(&network(text), &times, tolerance);
        for (&time, found) in times.iter().zip(column(&solution, "line.T")) {
            let entered = passed(time) - 3000.0;
            let right = match entered < 0.0 {
                true => 40.0,
                false => 40.0 + 10.0 * (TAU * when(entered, 0.0, time, passed) / 70.0).sin(),
            };
            near(found, right, 10.0 * tolerance, &format!("{time} s, {tolerance} K"));
        }
    }
}

/// Half a period forwards, half a period backwards: what entered last leaves first, then fluid that
/// came from the other side.
#[test]
fn a_flow_that_reverses_brings_fluid_back() {
    let text = r#"
format = 1
[boundary]
left = { T = "40 [degC] + 0.2 [K/s] * t" }
right = { T = "20 [degC] - 0.1 [K/s] * t" }
[pipe]
line = { from = "left", to = "right", mcp = "100 [W/K] * sin(2 * pi * t / 60 [s])", C = "1 kJ/K", T0 = "30 degC" }
"#;
    let passed = |t: f64| 100.0 * 60.0 / TAU * (1.0 - (TAU * t / 60.0).cos());
    let most = passed(30.0);
    let times: Vec<f64> = (1..60).filter(|t| *t != 30).map(f64::from).collect();
    let times: Vec<f64> = [0.0].into_iter().chain(times).collect();
    let solution = run(&network(text), &times, 1e-6);
    for (&time, found) in times.iter().zip(column(&solution, "line.T")).skip(1) {
        let at = passed(time);
        let right = match time < 30.0 {
            true if at < 1000.0 => 30.0,
            true => 40.0 + 0.2 * when(at - 1000.0, 0.0, time, passed),
            false if at > most - 1000.0 => 40.0 + 0.2 * when(at, 0.0, 30.0, passed),
            false => 20.0 - 0.1 * when(-(at + 1000.0), 30.0, 60.0, |t| -passed(t)),
        };
        near(found, right, 1e-5, &format!("{time} s"));
    }
}

/// Temperatures at even steps, each with its slopes before and after a jump there.
#[derive(Default)]
struct History(Vec<[f64; 3]>);

impl History {
    /// The temperature after some half steps, by cubic Hermite interpolation; just `before` a jump
    /// there, or after it.
    fn at(&self, halves: i64, before: bool, at_start: f64) -> f64 {
        if halves < 0 || halves == 0 && before {
            return at_start;
        }
        let i = usize::try_from(halves / 2).unwrap();
        if halves % 2 == 0 {
            return self.0[i][0];
        }
        let ([y, _, slope], [next, end, _]) = (self.0[i], self.0[i + 1]);
        0.5 * (y + next) + STEP / 8.0 * (slope - end)
    }
}

/// Tanks in a loop: each gets its fluid from the one before, some seconds later.
struct Loop {
    capacity: Vec<f64>,
    start: Vec<f64>,
    loss: Vec<f64>,
    heat: Vec<f64>,
    /// Steps that the fluid before each tank takes.
    delay: Vec<usize>,
    flow: f64,
}

const STEP: f64 = 0.05;
const ROOM: f64 = 15.0;

impl Loop {
    fn random(random: &mut Random) -> Self {
        let count = 2 + (3.0 * random.unit()) as usize;
        let mut each = |from: f64, to: f64| -> Vec<f64> {
            (0..count).map(|_| from + (to - from) * random.unit()).collect()
        };
        let (capacity, start) = (each(500.0, 5000.0), each(10.0, 90.0));
        let (loss, heat, delay) = (each(1.0, 30.0), each(0.0, 2000.0), each(40.0, 400.0));
        let flow = each(20.0, 200.0)[0];
        let delay = delay.into_iter().map(|steps| steps as usize).collect();
        Self { capacity, start, loss, heat, delay, flow }
    }

    fn text(&self) -> String {
        let mut text = "format = 1\n[boundary]\nroom = { T = \"15 degC\" }\n".to_owned();
        for i in 0..self.start.len() {
            let before = (i + self.start.len() - 1) % self.start.len();
            text += &format!(
                "[node.n{i}]\nC = \"{} J/K\"\nT0 = \"{} degC\"\n[resistor.r{i}]\nfrom = \"n{i}\"\nto = \
                 \"room\"\nG = \"{} W/K\"\n[source.q{i}]\ninto = \"n{i}\"\nP = \"{} W\"\n[pipe.p{i}]\n\
                 from = \"n{before}\"\nto = \"n{i}\"\nmcp = \"{} W/K\"\nC = \"{} J/K\"\nT0 = \"{} degC\"\n",
                self.capacity[i],
                self.start[i],
                self.loss[i],
                self.heat[i],
                self.flow,
                self.flow * self.delay[i] as f64 * STEP,
                50.0 + i as f64,
            );
        }
        text
    }

    /// Slopes after some half steps, just `before` jumps there or after them.
    fn rates(&self, (halves, before): (i64, bool), t: &[f64], known: &[History]) -> Vec<f64> {
        let count = t.len();
        let one = |i: usize| {
            let back = halves - 2 * self.delay[i] as i64;
            let inflow = known[(i + count - 1) % count].at(back, before, 50.0 + i as f64);
            let heat = self.flow * (inflow - t[i]) + self.loss[i] * (ROOM - t[i]) + self.heat[i];
            heat / self.capacity[i]
        };
        (0..count).map(one).collect()
    }

    /// Temperatures after some steps, by the classical Runge-Kutta method.
    fn solved(&self, steps: i64) -> Vec<History> {
        let mut t = self.start.clone();
        let mut known: Vec<History> = t.iter().map(|_| History::default()).collect();
        for now in (0..=2 * steps).step_by(2) {
            let [came, goes] = [true, false].map(|before| self.rates((now, before), &t, &known));
            for (i, known) in known.iter_mut().enumerate() {
                known.0.push([t[i], came[i], goes[i]]);
            }
            let add = |rates: &[f64], h: f64| -> Vec<f64> {
                t.iter().zip(rates).map(|(t, rate)| t + h * rate).collect()
            };
            let second = self.rates((now + 1, false), &add(&goes, 0.5 * STEP), &known);
            let third = self.rates((now + 1, false), &add(&second, 0.5 * STEP), &known);
            let last = self.rates((now + 2, true), &add(&third, STEP), &known);
            for i in 0..t.len() {
                t[i] += STEP / 6.0 * (goes[i] + 2.0 * second[i] + 2.0 * third[i] + last[i]);
            }
        }
        known
    }
}

/// Loops with delays against Runge-Kutta steps of 50 ms. Set `LPTN_PIPES` for more of them.
#[test]
fn random_loops_are_those_of_runge_kutta() {
    let count = std::env::var("LPTN_PIPES").map_or(30, |n| n.parse().unwrap());
    let mut random = Random(2026);
    for case in 0..count {
        let own = Loop::random(&mut random);
        let known = own.solved(2400);
        let times: Vec<f64> = (0..=12).map(|i| 10.0 * f64::from(i)).collect();
        let solution = run(&network(&own.text()), &times, 1e-5);
        for (i, known) in known.iter().enumerate() {
            for (&time, found) in times.iter().zip(column(&solution, &format!("n{i}.T"))) {
                let right = known.0[(time / STEP).round() as usize][0];
                near(found, right, 1e-4, &format!("loop {case}, n{i}, {time} s"));
            }
        }
    }
}

/// A run that is cut in two is the same run: the state contains the fluid.
#[test]
fn a_run_goes_on_with_the_fluid_in_its_pipes() {
    let network = network(&TANK.replace("\"60 degC\"", "\"60 [degC] + 5 [K] * sin(t / 9 [s])\""));
    let system = ThermalSystem::assemble(&network).unwrap();
    let whole = run(&network, &[0.0, 180.0], 1e-6);
    let first = run(&network, &[0.0, 70.0], 1e-6);
    let rest = Transient { start: 70.0, ..until(&[70.0, 180.0], 1e-6) };
    let rest = rest.solve_from(&system, first.last_state(), &mut |_| Proceed::Continue);
    let rest = rest.unwrap_or_else(|e| panic!("{e}"));
    for name in ["tank.T", "supply.T"] {
        near(column(&rest, name)[1], column(&whole, name)[1], 1e-5, name);
    }
    // fluid has passed, and nobody knows which
    let lost = State::restored(first.last_state().carried().to_vec(), Vec::new());
    let rest = Transient { start: 70.0, ..until(&[70.0, 180.0], 1e-6) };
    assert!(rest.solve_from(&system, &lost, &mut |_| Proceed::Continue).is_err());
}

#[test]
fn in_steady_state_fluid_leaves_as_it_enters() {
    for (mcp, tank) in [("418 W/K", 60.0), ("-418 W/K", 20.0)] {
        let text = TANK.replace("418 W/K", mcp);
        let system = ThermalSystem::assemble(&network(&text)).unwrap();
        let steady = SteadyState::solve(&system, 0.0).unwrap_or_else(|e| panic!("{e}"));
        let node = system.network().node("tank").unwrap();
        near(steady[node] - ZERO, tank, 1e-9, mcp);
    }
}

#[test]
fn analyses_that_do_not_know_the_fluid_refuse() {
    let network = network(TANK);
    let system = ThermalSystem::assemble(&network).unwrap();
    let cycle = Periodic::find(&system, &until(&[0.0, 60.0], 1e-5));
    assert!(matches!(cycle, Err(PeriodicError::Pipe { name }) if name == "supply"));
    assert!(StateRates::new(&system).is_err());
    let near = Linearised::of(&system, None);
    assert!(matches!(near, Err(LinearisedError::Pipe { .. })));
    for integrator in [IntegratorChoice::OneStep, IntegratorChoice::Esdirk] {
        let run = Transient { integrator, ..until(&[0.0, 60.0], 1e-5) };
        assert!(run.solve(&system).is_err(), "{integrator:?}");
    }
}

/// The flow depends on the temperature of the tank: a mixing valve; against Runge-Kutta steps.
#[test]
fn a_flow_that_reads_temperatures_is_followed() {
    let text = r#"
format = 1
[boundary]
inlet = { T = "60 degC" }
drain = { T = "20 degC" }
[node]
tank = { C = "5 kJ/K", T0 = "20 degC" }
[value]
valve = "200 [W/K] * (70 [degC] - tank.T) / 50 [K]"
[pipe]
supply = { from = "inlet", to = "tank", mcp = "valve", C = "4 kJ/K", T0 = "20 degC" }
[advection]
out = { from = "tank", to = "drain", mcp = "valve" }
[source]
heater = { into = "tank", P = "300 W" }
"#;
    // until the hot fluid arrives nothing but the heater warms the tank; then both
    let valve = |t: f64| 200.0 * (70.0 - t) / 50.0;
    let (mut t, mut passed, mut time) = (20.0, 0.0, 0.0);
    let h = 1e-3;
    let times: Vec<f64> = (0..=8).map(|i| 10.0 * f64::from(i)).collect();
    let solution = run(&network(text), &times, 1e-6);
    let found = column(&solution, "tank.T");
    let mut next = 0;
    while next < times.len() {
        if time >= times[next] - 0.5 * h {
            near(found[next], t, 2e-3, &format!("{time} s"));
            next += 1;
        }
        let rates = |t: f64, passed: f64| {
            let inflow = if passed < 4000.0 { 20.0 } else { 60.0 };
            ((300.0 + valve(t) * (inflow - t)) / 5000.0, valve(t))
        };
        let (a, b) = rates(t, passed);
        let (c, d) = rates(t + 0.5 * h * a, passed + 0.5 * h * b);
        (t, passed, time) = (t + h * c, passed + h * d, time + h);
    }
}

/// Temperatures after 200 s differentiate by the content only through the history of the fluid.
#[test]
fn derivatives_through_a_pipe_are_differences_of_runs() {
    let text = format!(
        "{}\n[param]\nV = \"41.8 kJ/K\"\n",
        TANK.replace("\"41.8 kJ/K\" }\n[adv", "\"V\" }\n[adv")
    );
    let network = network(&text);
    let content = network.parameter("V").unwrap();
    assert!(matches!(network.tangents(&[content]), Err(NoTangents::Pipe { .. })));
    let settings = until(&[0.0, 200.0], 1e-7);
    let run = sensitive_run(&network, &settings, &[content]).unwrap_or_else(|e| panic!("{e}"));
    let node = network.node("tank").unwrap();
    let found = run.sensitivity(content, node).unwrap()[1];
    // T = 60 - 40 exp(-(418 W/K t - V) / 41.8 kJ/K)
    near(found * 41_800.0, -40.0 * (-1.0_f64).exp(), 1e-3, "by the content");
}

/// A flow may begin at zero: the fluid at the end of the pipe is known.
#[test]
fn a_flow_may_begin_at_rest() {
    let text =
        TANK.replace("mcp = \"418 W/K\", C", "mcp = \"if(t < 50 [s], 0 [W/K], 418 [W/K])\", C");
    let solution = run(&network(&text), &[0.0, 149.0, 151.0], 1e-5);
    for (found, right) in column(&solution, "supply.T").iter().zip([20.0, 20.0, 60.0]) {
        near(*found, right, 1e-9, "the fluid that leaves");
    }
}

#[test]
fn a_pipe_may_be_a_part_of_a_template() {
    let text = r#"
format = 1
[default]
T0 = "20 degC"
[boundary]
hot = { T = "60 degC" }
[template.line]
port = ["source"]
[template.line.node]
n = { C = "1 kJ/K" }
[template.line.pipe]
p = { from = "source", to = "n", mcp = "10 W/K", C = "100 J/K" }
[use.line]
template = "line"
count = 2
connect = { source = "hot" }
"#;
    let solution = run(&network(text), &[0.0, 60.0], 1e-5);
    let right = 60.0 - 40.0 * (-0.5_f64).exp();
    near(column(&solution, "line[2].n.T")[1], right, 1e-4, "after 10 s");
}

#[test]
fn the_exact_solution_knows_no_pipes() {
    assert!(ExactSolution::solve(&network(TANK), 0.0, &[0.0, 60.0]).is_err());
}

/// A flow of a loop that reads a temperature after the fluid has come round takes few steps.
#[test]
fn a_flow_that_reads_temperatures_takes_few_steps() {
    let text = r#"
format = 1
[boundary]
air = { T = "20 degC" }
[node]
hot = { C = "600 J/K", T0 = "48 degC" }
cold = { C = "120 J/K", T0 = "15 degC" }
[resistor]
loss = { from = "cold", to = "air", G = "7 W/K" }
[value]
mcp = "10 [W/K] * (1 + 0.5 * sin(2 * pi * t / 57 [s])) * exp(0.007 [1/K] * (cold.T - 20 [degC]))"
[pipe]
line = { from = "hot", to = "cold", mcp = "mcp", C = "128 J/K", T0 = "66 degC" }
[advection]
back = { from = "cold", to = "hot", mcp = "mcp" }
[source]
heat = { into = "hot", P = "46 W" }
"#;
    let network = network(text);
    let system = ThermalSystem::assemble(&network).unwrap();
    let mut steps = 0;
    let solution = until(&[0.0, 13.0], 1e-5).solve_observed(&system, &mut |_| {
        steps += 1;
        Proceed::Continue
    });
    solution.unwrap();
    assert!(steps < 2000, "{steps} steps");
}
