//! Nodes whose mass changes: mixing in closed form, and classical Runge-Kutta steps.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::elements_helper::Random;

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, Network, NoTangents, Time};
use lptn_solve::{ExactSolution, Linearised, LinearisedError, Solution, SteadyState, Transient};

const ZERO: f64 = 273.15;

/// Specific heat of the water of all tanks, in J/(kg K).
const CP: f64 = 4180.0;

fn network(text: &str) -> Network {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    netlist.network
}

fn run(network: &Network, times: &[f64], integrator: IntegratorChoice) -> Solution {
    let system = ThermalSystem::assemble(network).unwrap();
    let transient = Transient::until(Time(*times.last().unwrap())).at(times).tolerance(1e-5);
    Transient { integrator, ..transient }.solve(&system).unwrap_or_else(|e| panic!("{e}"))
}

fn near(found: f64, right: f64, error: f64, at: &str) {
    assert!((found - right).abs() <= error, "{found} is not {right} to {error}: {at}");
}

/// 50 kg of water at 20 degC, into which 0.1 kg/s of 80 degC flow.
const TANK: &str = r#"
format = 1
[param]
inflow = "0.1 kg/s"
cp = "4180 J/(kg K)"
[state]
m = { rate = "inflow", start = "50 kg", max = "110 kg" }
[boundary]
hot = { T = "80 degC" }
[node]
water = { C = "m * cp", T0 = "20 degC" }
[advection]
fill = { from = "hot", to = "water", mcp = "if(m < 110 [kg], inflow, 0 [kg/s]) * cp" }
"#;

#[test]
fn a_tank_mixes_and_its_energy_balance_has_the_heat_of_the_inflow() {
    let network = network(TANK);
    let solution = run(&network, &[0.0, 300.0, 600.0], IntegratorChoice::default());
    let water = network.node("water").unwrap();
    for (time, found) in solution.times().iter().zip(solution.temperature(water).unwrap()) {
        let right = 80.0 - 60.0 * 50.0 / (50.0 + 0.1 * time);
        near(found - ZERO, right, 1e-4, "mixing");
    }
    let ledger = solution.ledger();
    ledger.check().unwrap();
    // 60 kg warmed by 60 K
    near(ledger.stored[water.index()], 60.0 * CP * 60.0, 20.0, "stored");
    let brought: f64 = ledger.streams.iter().chain(&ledger.masses).sum();
    near(brought, 60.0 * CP * 60.0, 20.0, "brought by the stream and the mass");
}

/// A tank that is filled to up to a hundred times its content. The bound of the balance counted the
/// capacity at the start only, and refused runs that were right.
#[test]
fn a_tank_that_grows_a_hundredfold_keeps_its_energy_balance() {
    let text = TANK
        .replace(", max = \"110 kg\"", "")
        .replace("if(m < 110 [kg], inflow, 0 [kg/s])", "inflow");
    for inflow in [0.25, 0.5, 2.0, 8.0] {
        let network = network(&text.replace("\"0.1 kg/s\"", &format!("\"{inflow} kg/s\"")));
        let solution = run(&network, &[0.0, 60.0, 600.0], IntegratorChoice::default());
        let water = network.node("water").unwrap();
        for (time, found) in solution.times().iter().zip(solution.temperature(water).unwrap()) {
            near(found - ZERO, 80.0 - 60.0 * 50.0 / (50.0 + inflow * time), 1e-4, "mixing");
        }
        solution.ledger().check().unwrap();
    }
}

/// Two tanks: the first one is filled, heated and drained into the second one, which cools.
struct Tanks {
    /// Mass flows in kg/s, shares by which they vary and angular frequencies in 1/s.
    fill: [f64; 3],
    drain: [f64; 3],
    masses: [f64; 2],
    /// Heat in W, conductances in W/K, capacity of the first vessel in J/K.
    heat: f64,
    between: f64,
    loss: f64,
    vessel: f64,
}

const START: [f64; 2] = [40.0, 15.0];
const INLET: f64 = 80.0;
const AIR: f64 = 5.0;

impl Tanks {
    fn random(random: &mut Random) -> Self {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        Self {
            fill: [between(0.02, 0.3), between(0.0, 0.9), between(0.005, 0.05)],
            drain: [between(0.02, 0.1), between(0.0, 0.9), between(0.005, 0.05)],
            masses: [between(100.0, 200.0), between(5.0, 50.0)],
            heat: between(-2e3, 5e3),
            between: between(1.0, 500.0),
            loss: between(1.0, 500.0),
            vessel: between(1e3, 1e5),
        }
    }

    fn text(&self) -> String {
        let flow = |[mean, share, frequency]: [f64; 3]| {
            format!("{mean} [kg/s] * (1 + {share} * sin({frequency} [1/s] * t))")
        };
        format!(
            r#"
format = 1
[param]
cp = "4180 J/(kg K)"
[signal]
fill = "{}"
drain = "{}"
[state]
m = {{ rate = "fill - drain", start = "{} kg" }}
level = {{ rate = "drain", start = "{} kg" }}
[value]
heavy = "m * cp + {} [J/K]"
[boundary]
inlet = {{ T = "{INLET} degC" }}
air = {{ T = "{AIR} degC" }}
[node]
first = {{ C = "heavy", T0 = "{} degC" }}
second = {{ T0 = "{} degC" }}
[capacitor]
content = {{ node = "second", C = "level * cp" }}
[advection]
in = {{ from = "inlet", to = "first", mcp = "fill * cp" }}
over = {{ from = "first", to = "second", mcp = "drain * cp" }}
[resistor]
wall = {{ from = "first", to = "second", G = "{} W/K" }}
loss = {{ from = "second", to = "air", G = "{} W/K" }}
[source]
heater = {{ into = "first", P = "{} W" }}
"#,
            flow(self.fill),
            flow(self.drain),
            self.masses[0],
            self.masses[1],
            self.vessel,
            START[0],
            START[1],
            self.between,
            self.loss,
            self.heat
        )
    }

    /// Masses in kg, then temperatures in degC: their rates.
    fn rates(&self, t: f64, [first, second, a, b]: [f64; 4]) -> [f64; 4] {
        let flow =
            |[mean, share, frequency]: [f64; 3]| mean * (1.0 + share * (frequency * t).sin());
        let (fill, drain) = (flow(self.fill), flow(self.drain));
        let wall = self.between * (b - a);
        let warm = CP * fill * (INLET - a) + wall + self.heat;
        let warms = CP * drain * (a - b) - wall + self.loss * (AIR - b);
        [fill - drain, drain, warm / (CP * first + self.vessel), warms / (CP * second)]
    }

    /// The state after some seconds, by steps of 50 ms.
    fn after(&self, seconds: u32) -> [f64; 4] {
        let (h, mut y) = (0.05, [self.masses[0], self.masses[1], START[0], START[1]]);
        let add = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
        for step in 0..20 * seconds {
            let t = h * f64::from(step);
            let k1 = self.rates(t, y);
            let k2 = self.rates(t + 0.5 * h, add(y, k1, 0.5 * h));
            let k3 = self.rates(t + 0.5 * h, add(y, k2, 0.5 * h));
            let k4 = self.rates(t + h, add(y, k3, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        }
        y
    }
}

#[test]
fn random_tanks_agree_with_runge_kutta_in_every_integrator() {
    let count = std::env::var("LPTN_TANKS").map_or(20, |count| count.parse().unwrap());
    let mut random = Random(17);
    for number in 0..count {
        let tanks = Tanks::random(&mut random);
        let right = tanks.after(600);
        let network = network(&tanks.text());
        for integrator in [IntegratorChoice::Cvode, IntegratorChoice::Esdirk] {
            let solution = run(&network, &[0.0, 600.0], integrator);
            for (name, right) in [("first", right[2]), ("second", right[3])] {
                let found = solution.temperature(network.node(name).unwrap()).unwrap()[1];
                near(found - ZERO, right, 1e-4, &format!("`{name}` of {number}\n{}", tanks.text()));
            }
            solution.ledger().check().unwrap();
        }
    }
}

/// The mass returns to 60 kg, whatever it was: the steady state is that of a constant capacity.
const LEVEL: &str = r#"
format = 1
[state]
m = { rate = "(60 [kg] - m) / 100 [s]", start = "20 kg" }
[boundary]
air = { T = "20 degC" }
[node]
water = { C = "m * 4180 [J/(kg K)]", T0 = "20 degC" }
[resistor]
loss = { from = "water", to = "air", R = "2 K/kW" }
[source]
heater = { into = "water", P = "5 kW" }
"#;

#[test]
fn a_steady_state_does_not_depend_on_the_capacity() {
    let network = network(LEVEL);
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    let water = network.node("water").unwrap();
    near(steady.temperatures[water.index()] - ZERO, 30.0, 1e-8, "5 kW * 2 K/kW over 20 degC");
}

#[test]
fn analyses_that_need_a_constant_capacity_refuse() {
    let network = network(TANK);
    let system = ThermalSystem::assemble(&network).unwrap();
    let linear = Linearised::of(&system, None).map(drop);
    assert!(matches!(linear, Err(LinearisedError::Mass { name }) if name == "water"));
    assert!(ExactSolution::solve(&network, 0.0, &[0.0, 1.0]).is_err());
    let parameters: Vec<_> = network.parameter_ids().collect();
    assert!(matches!(network.tangents(&parameters), Err(NoTangents::Events { .. })));
    let level = self::network(
        &LEVEL.replace("5 kW", "5 [kW] * p").replace("[boundary]", "[param]\np = 1\n[boundary]"),
    );
    let parameters: Vec<_> = level.parameter_ids().collect();
    assert!(matches!(level.tangents(&parameters), Err(NoTangents::Mass { .. })));
}

#[test]
fn a_capacity_that_ends_stops_the_run_with_its_name() {
    let network = network(&TANK.replace("rate = \"inflow\"", "rate = \"-inflow\""));
    let system = ThermalSystem::assemble(&network).unwrap();
    let error = Transient::until(Time(600.0)).solve(&system).unwrap_err();
    let words = error.to_string();
    assert!(words.contains("water") && words.contains("not positive"), "{words}");
}

#[test]
fn a_capacity_that_jumps_is_refused() {
    let jumps = TANK.replace("\"m * cp\"", "\"if(m > 60 [kg], m, 2 * m) * cp\"");
    let rejected = lptn_netlist::parse("net.toml", &jumps).map(drop).unwrap_err();
    assert!(rejected.to_string().contains("network::comparison_not_linear"), "{rejected}");
}
