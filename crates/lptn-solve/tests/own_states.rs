//! States of one's own and named values: closed forms, SciPy, classical Runge-Kutta steps.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::f64::consts::TAU;

use crate::elements_helper::Random;

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, Network, Time};
use lptn_solve::{Periodic, Selection, Solution, SteadyError, SteadyState, Table, Transient};
use lptn_units::Unit;

pub const ZERO: f64 = 273.15;

pub fn network(text: &str) -> Network {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    netlist.network
}

pub fn run(network: &Network, times: &[f64], tolerance: f64) -> Solution {
    let system = ThermalSystem::assemble(network).unwrap();
    let stop = Time(*times.last().unwrap());
    Transient::until(stop).at(times).tolerance(tolerance).solve(&system).unwrap()
}

/// One column in SI units, for states in the unit of their start.
pub fn column(solution: &Solution, name: &str) -> Vec<f64> {
    let selection = Selection::matching(solution.network(), &[name.to_owned()]).unwrap();
    let table = Table::of_solution(solution, &selection, &Unit::parse("K").unwrap());
    table.columns().last().unwrap().values.clone()
}

pub fn near(found: f64, right: f64, error: f64) {
    assert!((found - right).abs() <= error, "{found} is not {right} to {error}");
}

/// A heater of 40 W under a PI controller whose integral stops while the heater is at full power.
const HOT_END: &str = r#"
format = 1
[param]
T_set = "200 degC"
[default]
T0 = "22 degC"
[boundary]
room = { T = "22 degC" }
[node]
block = { C = "13 J/K" }
sensor = { C = "0.5 J/K" }
[value]
demand = "0.03 [1/K] * (T_set - sensor.T) + 0.0005 [1/(K s)] * memory"
[state]
memory = { rate = "if(demand < 1, T_set - sensor.T, 0 [K])", start = "0 K s", size = "1000 K s" }
[resistor]
loss = { from = "block", to = "room", G = "80 mW/K" }
fit = { from = "block", to = "sensor", G = "0.1 W/K" }
[source]
heater = { into = "block", P = "40 [W] * min(max(demand, 0), 1)" }
"#;

/// SciPy's DOP853 with a tolerance of 1e-11, to all its printed digits.
#[test]
fn a_pi_controller_is_that_of_scipy() {
    let solution = run(&network(HOT_END), &[0.0, 60.0, 120.0, 300.0], 1e-5);
    let block = column(&solution, "block.T");
    for (found, right) in block.iter().zip([22.0, 171.874_494, 196.783_560, 199.901_140]) {
        near(found - ZERO, right, 1e-4 + 5e-7);
    }
}

/// The hot end under `[controller]`, whose integral goes back from the limit in `abs(K_p / K_i)`, against
/// SciPy's DOP853 with a tolerance of 1e-11.
#[test]
fn a_controller_is_that_of_scipy() {
    let rest = HOT_END.split_once("[value]").unwrap();
    let (_, after) = rest.1.split_once("[resistor]").unwrap();
    let text = format!(
        "{}[controller]\nduty = {{ sense = \"sensor\", setpoint = \"T_set\", K_p = \"0.03 1/K\", K_i = \
         \"0.0005 1/(K s)\", min = 0, max = 1 }}\n[resistor]{}",
        rest.0,
        after.replace("min(max(demand, 0), 1)", "duty")
    );
    let network = network(&text);
    let solution = run(&network, &[0.0, 60.0, 120.0, 300.0], 1e-5);
    let (block, integral) = (column(&solution, "block.T"), column(&solution, "duty.integral"));
    for (found, right) in
        block.iter().zip([22.0, 171.874_494_368, 206.528_065_898, 200.198_914_081])
    {
        near(found - ZERO, right, 1e-4);
    }
    for (found, right) in integral.iter().zip([0.0, 0.632_120_559, 0.540_804_924, 0.361_701_569]) {
        near(*found, right, 1e-6);
    }
    let names: Vec<&str> = network.parameters().iter().map(|p| p.name.as_str()).collect();
    assert!(names.contains(&"duty.K_p") && names.contains(&"duty.setpoint"), "{names:?}");
}

/// The heater makes up for 80 mW/K times 178 K, 14.24 W: a share of 0.356, or 712 K s.
#[test]
fn the_steady_state_of_a_pi_controller_has_no_error() {
    let network = network(HOT_END);
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    near(steady[network.node("block").unwrap()], 200.0 + ZERO, 1e-7);
    near(network.state_values(&steady.temperatures).next().unwrap(), 712.0, 1e-5);
    near(steady.source_heat[0], 14.24, 1e-7);
}

/// The energy balance has the heat of the heater and of the room, and none of the state.
#[test]
fn a_state_has_no_heat() {
    let network = network(HOT_END);
    let solution = run(&network, &[0.0, 300.0], 1e-7);
    let ledger = solution.ledger();
    let memory = network.states()[0].source.unwrap();
    assert_eq!(ledger.sources[memory.index()].to_bits(), 0);
    let stored = 13.0 * (column(&solution, "block.T")[1] - 22.0 - ZERO)
        + 0.5 * (column(&solution, "sensor.T")[1] - 22.0 - ZERO);
    near(ledger.stored.iter().sum::<f64>(), stored, 1e-5);
    assert!(ledger.relative_residual().unwrap().abs() < 1e-10);
}

/// A reaction of first order in an insulated body: `m = m0 exp(-k t)`, and its heat is
/// `(m0 - m) H`.
fn reaction(size: &str) -> String {
    format!(
        "format = 1\n[param]\nk = \"0.01 1/s\"\nm0 = \"0.2 kg\"\n[node]\nbody = {{ C = \"2 kJ/K\", \
         T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nskin = {{ from = \
         \"body\", to = \"air\", G = \"1e-12 W/K\" }}\n[state]\nleft = {{ rate = \"-k * left\", start = \
         \"m0\", size = \"{size}\" }}\n[source]\nheat = {{ into = \"body\", P = \"k * left * 500 \
         [kJ/kg]\" }}\n"
    )
}

#[test]
fn a_reactant_is_used_up_by_its_exponential_whatever_its_size() {
    for size in ["0.2 kg", "1 mg", "1000 kg"] {
        let solution = run(&network(&reaction(size)), &[0.0, 50.0, 200.0, 1000.0], 1e-5);
        let (left, body) = (column(&solution, "left"), column(&solution, "body.T"));
        for ((time, left), body) in solution.times().iter().zip(left).zip(body) {
            let right = 0.2 * (-0.01 * time).exp();
            // 50 kJ over 2 kJ/K are 25 K; a size of a tonne takes 5000 times the error
            let loose = if size == "1000 kg" { 5e3 } else { 1.0 };
            near(left, right, 10.0 * 1e-7 * 0.2 * 2.0 * loose);
            near(body, 20.0 + ZERO + 250.0 * (0.2 - right), 1e-4 * loose);
        }
    }
}

/// `dm/dk = -t m` and `dT/dk = t m H / C`.
#[test]
fn sensitivities_pass_through_a_state() {
    let network = network(&reaction("0.2 kg"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let k = network.parameter("k").unwrap();
    let run = Transient::until(Time(200.0)).at(&[0.0, 100.0, 200.0]).tolerance(1e-7);
    let solution = run.sensitivities(&[k]).solve(&system).unwrap();
    let found = solution.sensitivity(k, network.node("body").unwrap()).unwrap();
    for (time, found) in solution.times().iter().zip(found) {
        let right = time * 0.2 * (-0.01 * time).exp() * 250.0;
        near(found, right, 1e-4 * right.abs().max(1.0));
    }
}

/// 60 g at 0.2 g/s last 300 s; 8 kW on 10 W/K warm 2 kJ/K until then, and it cools afterwards.
#[test]
fn a_state_stops_at_its_bound() {
    let text = "format = 1\n[node]\npot = { C = \"2 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nroom = { T = \"20 \
                degC\" }\n[resistor]\nloss = { from = \"pot\", to = \"room\", G = \"10 W/K\" }\n[state]\nfuel = { rate = \
                \"-0.2 g/s\", start = \"60 g\", min = \"0 g\" }\n[source]\nflame = { into = \"pot\", P = \"if(fuel > 0 \
                [g], 8 [kW], 0 [W])\" }\n";
    let network = network(text);
    let solution = run(&network, &[0.0, 150.0, 300.0, 600.0], 1e-5);
    let fuel = column(&solution, "fuel");
    for (found, right) in fuel.iter().zip([60.0, 30.0, 0.0, 0.0]) {
        near(*found, right, 1e-4);
    }
    assert!(fuel.iter().all(|fuel| *fuel >= 0.0), "{fuel:?}");
    let hot = 800.0 * (1.0 - (-1.5_f64).exp());
    let pot = column(&solution, "pot.T");
    near(pot[2], 20.0 + ZERO + hot, 1e-3);
    near(pot[3], 20.0 + ZERO + hot * (-1.5_f64).exp(), 1e-3);
    let names: Vec<String> =
        solution.events().iter().map(|event| event.kind.name(&network)).collect();
    assert_eq!(names, ["flame.P", "fuel.min"]);
    // at rest the fuel is used up, and nothing burns
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    near(steady[network.node("pot").unwrap()], 20.0 + ZERO, 1e-6);
}

/// Names of states, parameters and bounds that are also used behind the scenes.
#[test]
fn a_state_may_have_any_name() {
    for name in ["x", "own", "rate", "scale", "one", "energy", "most", "least", "up", "stopped"] {
        let text = format!(
            "format = 1\n[param]\nk = \"0.2 g/s\"\n[node]\npot = {{ C = \"2 kJ/K\", T0 = \"20 degC\" }}\n\
             [boundary]\nroom = {{ T = \"20 degC\" }}\n[resistor]\nloss = {{ from = \"pot\", to = \"room\", G = \
             \"10 W/K\" }}\n[state]\n{name} = {{ rate = \"-k\", start = \"60 g\", min = \"0 g\", max = \"60 g\" }}\n\
             other = {{ rate = \"{name} / 1 [s]\", start = \"0 kg\", max = \"1 kg\", size = \"1 kg\" }}\n"
        );
        let solution = run(&network(&text), &[0.0, 10.0, 300.0, 400.0], 1e-5);
        for (found, right) in column(&solution, name).iter().zip([60.0, 58.0, 0.0, 0.0]) {
            near(*found, right, 1e-4);
        }
        // 60 g falling by 0.2 g/s for 10 s: 590 g s
        near(column(&solution, "other")[1], 0.59, 1e-5);
        // a parameter of that name as a bound
        let text = text
            .replace(&format!("{name} = {{ rate"), "fuel = { rate")
            .replace(&format!("\"{name} / 1 [s]\""), "\"fuel / 1 [s]\"")
            .replace("[param]\n", &format!("[param]\n{name} = \"10 g\"\n"))
            .replace("min = \"0 g\"", &format!("min = \"{name}\""));
        let solution = run(&network(&text), &[0.0, 400.0], 1e-5);
        near(column(&solution, "fuel")[1], 10.0, 1e-4);
    }
}

#[test]
fn a_state_that_changes_whatever_happens_has_no_steady_state() {
    let text = "format = 1\n[node]\npot = { C = \"2 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nroom = { T = \"20 \
                degC\" }\n[resistor]\nloss = { from = \"pot\", to = \"room\", G = \"10 W/K\" }\n[state]\nhours = { rate = \
                \"1\", start = \"0 h\", size = \"1 h\" }\n";
    let system = ThermalSystem::assemble(&network(text)).unwrap();
    let error = SteadyState::solve(&system, 0.0).unwrap_err();
    assert!(
        matches!(&error, SteadyError::Drifts { name, rate, .. } if name == "hours" && (rate - 1.0).abs() < 1e-12),
        "{error}"
    );
}

/// An oscillator of two states in m and m/s: `x = cos(t)`. Nothing damps it, so the errors of its
/// steps add up: 3 periods are allowed twice the errors of a network that forgets.
#[test]
fn states_drive_each_other() {
    let text = "format = 1\n[node]\npot = { C = \"2 kJ/K\", T0 = \"20 degC\" }\n[boundary]\nroom = { T = \"20 \
                degC\" }\n[resistor]\nloss = { from = \"pot\", to = \"room\", G = \"10 W/K\" }\n[state]\nx = { rate = \
                \"v\", start = \"1 m\" }\nv = { rate = \"-x / 1 [s^2]\", start = \"0 m/s\", size = \"1 m/s\" }\n";
    let times: Vec<f64> = (0..=20).map(f64::from).collect();
    let solution = run(&network(text), &times, 1e-6);
    for (time, x) in times.iter().zip(column(&solution, "x")) {
        near(x, time.cos(), 20.0 * 1e-6 / 64.0);
    }
}

/// A sensor with a lag of 5 s in a body that warms by 1 K/s: it shows `t - 5 s (1 - exp(-t/5 s))`.
#[test]
fn a_state_may_be_a_temperature() {
    let text = "format = 1\n[node]\nbody = { C = \"100 J/K\", T0 = \"20 degC\" }\n[boundary]\nroom = { T = \"20 \
                degC\" }\n[resistor]\nloss = { from = \"body\", to = \"room\", G = \"1e-12 W/K\" }\n[source]\nheat = { into = \
                \"body\", P = \"100 W\" }\n[state]\nfelt = { rate = \"(body.T - felt) / 5 [s]\", start = \"20 degC\" }\n";
    let solution = run(&network(text), &[0.0, 3.0, 30.0], 1e-6);
    for (time, felt) in solution.times().iter().zip(column(&solution, "felt")) {
        near(felt, 20.0 + ZERO + time - 5.0 * (1.0 - (-time / 5.0).exp()), 1e-5);
    }
}

/// `C T' = G (To - T) + Kp (r - T) + I`, `I' = Ki (r - T)` with `To` a sine of one day: the swing of
/// the room is `G To / |i w C + G + Kp + Ki / (i w)|`, and its mean is r.
#[test]
fn the_periodic_state_of_a_pi_controller_is_its_frequency_response() {
    let (c, g, kp, ki, day) = (2e6, 100.0, 500.0, 0.05, 86_400.0);
    let text = format!(
        "format = 1\n[signal]\noutside = {{ t = [0, 6, 12, 18, 24], v = [5, 13, 5, -3, 5], t_unit = \"h\", \
         v_unit = \"degC\", after_end = \"repeat\", interp = \"linear\" }}\n[boundary]\nair = {{ T = \
         \"outside\" }}\n[node]\nroom = {{ C = \"{c} J/K\", T0 = \"15 degC\" }}\n[resistor]\nwall = {{ from = \
         \"room\", to = \"air\", G = \"{g} W/K\" }}\n[state]\nwork = {{ rate = \"{ki} [W/(K s)] * (21 [degC] - \
         room.T)\", start = \"0 W\", size = \"1 kW\" }}\n[source]\nheater = {{ into = \"room\", P = \"{kp} \
         [W/K] * (21 [degC] - room.T) + work\" }}\n"
    );
    let system = ThermalSystem::assemble(&network(&text)).unwrap();
    let hours: Vec<f64> = (0..=24).map(|hour| 3600.0 * f64::from(hour)).collect();
    let settings = Transient::until(Time(day)).at(&hours).tolerance(1e-6);
    let found = Periodic::find(&system, &settings).unwrap();
    // the triangle of 8 K is 64/pi^2 of odd sines over n^2, of alternating sign
    let swing = |time: f64| {
        let terms = (0..200).map(|k| {
            let n = f64::from(2 * k + 1);
            let w = n * TAU / day;
            let (re, im) = (g + kp, w * c - ki / w);
            let size = g * 64.0 / (TAU / 2.0).powi(2) / (n * n) / re.hypot(im);
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sign * size * (w * time - im.atan2(re)).sin()
        });
        terms.sum::<f64>()
    };
    let room = column(&found.solution, "room.T");
    for (time, room) in hours.iter().zip(room) {
        near(room, 21.0 + ZERO + swing(*time), 1e-4);
    }
}

/// Two bodies and two states, all driving each other, and a heat that bends with a state.
struct Plant {
    c: [f64; 2],
    g: [f64; 2],
    gain: [f64; 3],
}

impl Plant {
    fn new(random: &mut Random) -> Self {
        let size =
            |random: &mut Random, low: f64, high: f64| 10_f64.powf(random.between(low, high));
        Self {
            c: [size(random, 1.5, 3.0), size(random, 1.5, 3.0)],
            g: [size(random, 0.0, 1.0), size(random, 0.0, 1.0)],
            gain: [random.between(0.5, 5.0), size(random, -2.5, -1.0), random.between(0.0, 0.8)],
        }
    }

    fn text(&self) -> String {
        let Self { c: [ca, cb], g: [ga, gb], gain: [kp, ki, use_] } = self;
        format!(
            "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\na = {{ C = \"{ca:?} J/K\" }}\nb = {{ C = \"{cb:?} \
             J/K\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nab = {{ from = \"a\", to = \"b\", G = \
             \"{ga:?} W/K\" }}\nout = {{ from = \"b\", to = \"air\", G = \"{gb:?} W/K\" }}\n[value]\nshare = \
             \"demand / 100 [W]\"\ndemand = \"{kp:?} [W/K] * error + {ki:?} [W/(K s)] * total\"\nerror = \"60 \
             [degC] - b.T\"\n[state]\ntotal = {{ rate = \"error\", start = \"0 K s\", size = \"1e3 K s\" }}\ncharge = \
             {{ rate = \"-{use_:?} [1/h] * charge * share^2\", start = \"2 A h\" }}\n[source]\nheater = {{ into \
             = \"a\", P = \"demand * charge / 2 [A h]\" }}\n"
        )
    }

    /// Per second: K, K, K s, share of the charge.
    fn rates(&self, y: [f64; 4]) -> [f64; 4] {
        let error = 60.0 - y[1];
        let demand = self.gain[0] * error + self.gain[1] * y[2];
        let between = self.g[0] * (y[0] - y[1]);
        [
            (demand * y[3] - between) / self.c[0],
            (between - self.g[1] * (y[1] - 20.0)) / self.c[1],
            error,
            -self.gain[2] / 3600.0 * y[3] * (demand / 100.0).powi(2),
        ]
    }

    /// After a time in s.
    fn right(&self, time: f64) -> [f64; 4] {
        let (mut y, steps) = ([20.0, 20.0, 0.0, 1.0], 40_000);
        let h = time / f64::from(steps);
        for _ in 0..steps {
            let moved = |k: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| y[i] + by * k[i]);
            let k1 = self.rates(y);
            let k2 = self.rates(moved(k1, h / 2.0));
            let k3 = self.rates(moved(k2, h / 2.0));
            let k4 = self.rates(moved(k3, h));
            y = [0, 1, 2, 3].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        }
        y
    }
}

#[test]
fn random_plants_with_states_are_those_of_runge_and_kutta() {
    let count = std::env::var("LPTN_PLANTS").map_or(60, |count| count.parse().unwrap());
    let (mut random, mut worst) = (Random(11), 0.0_f64);
    for _ in 0..count {
        let plant = Plant::new(&mut random);
        let text = plant.text();
        let network = network(&text);
        let system = ThermalSystem::assemble(&network).unwrap();
        for integrator in [IntegratorChoice::Auto, IntegratorChoice::Cvode] {
            let settings = Transient::until(Time(200.0)).at(&[0.0, 200.0]).tolerance(1e-5);
            let solution = Transient { integrator, ..settings }.solve(&system).unwrap();
            let right = plant.right(200.0);
            for (name, right, scale) in [
                ("a.T", right[0] + ZERO, 1.0),
                ("b.T", right[1] + ZERO, 1.0),
                ("total", right[2], 8.0),
            ] {
                let error = (column(&solution, name)[1] - right).abs() / scale / 1e-5;
                worst = worst.max(error);
                assert!(error < 10.0, "{name} is off by {error} tolerances\n{text}");
            }
        }
    }
    assert!(worst > 0.0);
}

/// Two comparisons inside one named value have one place in the text.
#[test]
fn comparisons_of_a_named_value_are_held_apart() {
    let sum = "if(pot.T > 30 [degC], 1, 0) + if(pot.T > 35 [degC], 1, 0)";
    let text = |value: &str, factor: &str| {
        format!(
            "format = 1\n[boundary]\nroom = {{ T = \"20 degC\" }}\n[node]\npot = {{ C = \"100 J/K\", T0 = \
             \"20 degC\" }}\n{value}[resistor]\nloss = {{ from = \"pot\", to = \"room\", G = \"0.2 [W/K] * \
             (1 + {factor})\" }}\n[source]\ns = {{ into = \"pot\", P = \"20 W\" }}\n"
        )
    };
    let at = |text: String| column(&run(&network(&text), &[0.0, 600.0], 1e-6), "pot.T")[1] - ZERO;
    // 500 s ln(10/9), then 250 s ln(20/17.5) longer, then towards 160/3 degC within 500/3 s
    let to_30 = -500.0 * (1.0_f64 - 10.0 / 100.0).ln();
    let to_35 = to_30 + 250.0 * (40.0_f64 / 35.0).ln();
    let end = 20.0 + 100.0 / 3.0;
    let right = end + (35.0 - end) * (-(600.0 - to_35) * 3.0 / 500.0).exp();
    near(at(text("", &format!("({sum})"))), right, 1e-4);
    near(at(text(&format!("[value]\nfan = \"{sum}\"\n"), "fan")), right, 1e-4);
}

/// A ramp that goes down to its least value, and one that goes up to its greatest.
#[test]
fn each_of_two_bounds_stops_a_state() {
    for (rate, start, bound) in [("-0.3 1/s", 60.0_f64, 10.0), ("0.3 1/s", 60.0, 100.0)] {
        let text = format!(
            "format = 1\n[boundary]\nroom = {{ T = \"20 degC\" }}\n[node]\npot = {{ C = \"2 kJ/K\", T0 = \
             \"20 degC\" }}\n[resistor]\nloss = {{ from = \"pot\", to = \"room\", G = \"10 W/K\" }}\n\
             [state]\nz = {{ rate = \"{rate}\", start = {start}, min = 10, max = 100 }}\n[source]\n\
             s = {{ into = \"pot\", P = \"z * 1 [W]\" }}\n"
        );
        let network = network(&text);
        let solution = run(&network, &[0.0, 100.0, 600.0], 1e-5);
        let z = column(&solution, "z");
        let moved = (bound - start) * (0.3 * 100.0 / (bound - start).abs()).min(1.0);
        near(z[1], start + moved, 1e-6);
        near(z[2], bound, 1e-6);
        near(column(&solution, "s.P")[2], bound, 1e-5);
        let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
        near(steady[network.node("pot").unwrap()] - ZERO, 20.0 + bound / 10.0, 1e-6);
    }
}

/// It rests at the start and drifts where the temperatures come to rest.
#[test]
fn a_state_that_drifts_at_the_end_has_no_steady_state() {
    for power in ["30 W", "30 [W] + 1 [W] * age"] {
        let text = format!(
            "format = 1\n[boundary]\nroom = {{ T = \"20 degC\" }}\n[node]\npot = {{ C = \"100 J/K\", T0 = \
             \"20 degC\" }}\n[resistor]\nloss = {{ from = \"pot\", to = \"room\", G = \"1 W/K\" }}\n\
             [state]\nage = {{ rate = \"max(0, (pot.T - 30 [degC]) / 1 [K]) / 100 [s]\", start = 0, size \
             = 1 }}\n[source]\ns = {{ into = \"pot\", P = \"{power}\" }}\n"
        );
        let network = network(&text);
        let system = ThermalSystem::assemble(&network).unwrap();
        match SteadyState::solve(&system, 0.0) {
            Err(SteadyError::Drifts { name, rate, .. }) => {
                assert_eq!(name, "age");
                near(rate, 0.2, 1e-6);
            }
            other => panic!("{other:?}"),
        }
    }
}

/// A layer of ice that grows and melts in a cycle of cold and no cold: it stops at its thickest, on
/// its least thickness, or rests there all the time. Each network against explicit steps of 0.05 s
/// over many cycles.
#[test]
fn periodic_states_stay_within_their_bounds() {
    for (start, growth, resistance, least, most) in [
        (0.0, 0.1, 0.05, 0.0, 5.0),
        (0.0, 0.1, 0.1, 0.0, 5.0),
        (5.0, 0.1, 0.1, 0.0, 5.0),
        (1.0, 0.3, 0.05, 0.5, 2.0),
        (1.0, -0.3, 0.05, 0.5, 2.0),
    ] {
        let text = format!(
            "format = 1\n[signal]\nP = {{ t = [\"0 s\", \"40 min\", \"60 min\"], v = [\"-50 W\", \"0 W\", \
             \"-50 W\"], interp = \"previous\", after_end = \"repeat\", period = \"1 h\" }}\n[node]\nc = {{ C = \"1 \
             kJ/K\", T0 = \"5 degC\" }}\n[boundary]\nair = {{ T = \"8 degC\" }}\n[state]\nice = {{ rate = \
             \"{growth} [mm/(K h)] * (0 [degC] - c.T)\", start = \"{start} mm\", min = \"{least} mm\", max = \
             \"{most} mm\" }}\n[resistor]\nr = {{ from = \"c\", to = \"air\", R = \"0.4 [K/W] + {resistance} [K/W] \
             * ice / 1 [mm]\" }}\n[source]\ns = {{ into = \"c\", P = \"P\" }}\n"
        );
        let (mut c, mut ice, mut seen) = (5.0_f64, start, Vec::new());
        for step in 0..72_000 * 150 {
            let of_cycle = step % 72_000;
            if step >= 72_000 * 149 && of_cycle % 6000 == 0 {
                seen.push((c, ice));
            }
            let power = if of_cycle < 48_000 { -50.0 } else { 0.0 };
            let flow = (8.0 - c) / (0.4 + resistance * ice) + power;
            ice = f64::clamp(ice - 0.05 / 3600.0 * growth * c, least, most);
            c += 0.05 / 1000.0 * flow;
        }
        let system = ThermalSystem::assemble(&network(&text)).unwrap();
        let times: Vec<f64> = (0..12).map(|i| 300.0 * f64::from(i)).collect();
        let settings = Transient::until(Time(3600.0)).at(&times).tolerance(1e-5);
        let found = Periodic::find(&system, &settings);
        let found = found.unwrap_or_else(|error| panic!("{error}, right {:?}\n{text}", seen[0]));
        let (body, layer) = (column(&found.solution, "c.T"), column(&found.solution, "ice"));
        for (i, (c, ice)) in seen.into_iter().enumerate() {
            near(body[i] - ZERO, c, 2e-3);
            near(layer[i], ice, 1e-4);
        }
    }
}
