//! Gradients of runs by their adjoint, against forward sensitivities and differences of runs.

use lptn_assembly::ThermalSystem;
use lptn_network::{Functional, IntegratorChoice, LimitId, Network, ParameterId, Time};
use lptn_solve::{Method, Proceed, Solution, Transient, sensitive_run};

use crate::features::Dice;

/// Radiation, a film, a capacity over temperature, massless nodes that are eliminated and solved
/// for, a stream, a state, a heat that jumps.
const MANY: &str = r#"
[node]
block = { C = "size * cp * (1 + 0.001 [1/K] * (T - 20 [degC]))", T0 = "T0" }
case = { C = "300 J/K", T0 = "20 degC" }
joint = { massless = true }
skin = { massless = true }
water = { massless = true }
[boundary]
air = { T = "T_air" }
inlet = { T = "15 degC" }
[state]
wear = { rate = "worn * (block.T - air.T)", start = 0, size = 1 }
[resistor]
press = { from = "block", to = "joint", R = "R * (1 + wear)" }
plate = { from = "joint", to = "case", R = "2 * R" }
wall = { from = "case", to = "skin", R = "0.5 K/W" }
pad = { from = "block", to = "water", R = "3 * R" }
[radiation]
sky = { from = "skin", to = "air", emissivity = "eps", area = "0.05 m^2" }
[convection]
film = { from = "skin", to = "air", h = "h * (1 + 0.01 [1/K] * (skin.T - air.T))", area = "0.1 m^2" }
[advection]
in = { from = "inlet", to = "water", mcp = "mcp" }
out = { from = "water", to = "air", mcp = "mcp" }
[source]
heat = { into = "block", P = "if(t < 400 [s], P, 0.3 * P)" }
[limit]
hot = { of = "case.T", below = "100 degC" }
drop = { of = "skin.T - joint.T", below = "100 K" }
leak = { of = "pad.Q * R", below = "100 K" }
[param]
P = "60 W"
eps = "0.8"
h = "9 W/(m^2 K)"
size = "0.6 kg"
cp = "900 J/(kg K)"
R = "0.4 K/W"
T_air = "20 degC"
mcp = "3 W/K"
T0 = "25 degC"
worn = "1e-5 1/(K s)"
[run]
stop = "1000 s"
"#;

fn network(text: &str) -> Network {
    let text = format!("format = 1\n{text}");
    let netlist = lptn_netlist::parse("backward.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    netlist.network
}

fn until(stop: f64, tolerance: f64) -> Transient {
    Transient::until(Time(stop)).every(Time(stop)).tolerance(tolerance)
}

fn run(network: &Network, settings: &Transient) -> Solution {
    settings.solve(&ThermalSystem::assemble(network).unwrap()).unwrap()
}

fn by_all(network: &Network, tolerance: f64, limit: LimitId, functional: Functional) -> Vec<f64> {
    let settings = Transient { trajectory: true, ..until(1000.0, tolerance) };
    let parameters: Vec<ParameterId> = network.parameter_ids().collect();
    let solution = run(network, &settings);
    solution.margin_gradient((limit, functional), &parameters, &|_| Proceed::Continue).unwrap().by
}

#[track_caller]
fn near(found: f64, expected: f64, (error, scale): (f64, f64)) {
    assert!((found - expected).abs() <= error * scale, "{found:e} is not {expected:e}");
}

#[test]
fn both_ways_in_time_agree() {
    let network = network(MANY);
    let parameters: Vec<ParameterId> = network.parameter_ids().collect();
    let forward = sensitive_run(&network, &until(1000.0, 1e-9), &parameters).unwrap();
    let row = forward.solution.times().len() - 1;
    for limit in network.limit_ids() {
        let back = by_all(&network, 1e-9, limit, Functional::Last);
        for (&parameter, found) in parameters.iter().zip(back) {
            let expected = forward.margin_derivative(parameter, (limit, row)).unwrap();
            let name = &network.parameters()[parameter.index()].name;
            println!("{name}: {found:e} {expected:e}");
            near(found, expected, (1e-8, expected.abs().max(1e-3)));
        }
    }
}

/// A rod of constant conductances: its run and its adjoint go by the one-step method, and forward
/// sensitivities by CVODES.
#[test]
fn linear_networks_agree_with_forward_sensitivities() {
    let network = rod(60, ("", "50 W", ""));
    let parameters: Vec<ParameterId> = network.parameter_ids().collect();
    let limit = network.limit_ids().next().unwrap();
    let forward = sensitive_run(&network, &until(1000.0, 1e-9), &parameters).unwrap();
    let row = forward.solution.times().len() - 1;
    let settings = Transient { trajectory: true, ..until(1000.0, 1e-9) };
    assert_eq!(run(&network, &settings).method(), Some(Method::OneStep));
    let back = by_all(&network, 1e-9, limit, Functional::Last);
    for (&parameter, found) in parameters.iter().zip(back) {
        let expected = forward.margin_derivative(parameter, (limit, row)).unwrap();
        near(found, expected, (1e-8, expected.abs().max(1e-3)));
    }
}

/// The one-step method keeps its series. With x = exp(-G t / C): T = 20 degC + P/G (1 - x).
#[test]
fn the_method_that_is_asked_for_does_not_matter() {
    let network = network(
        "[param]\nP = \"40 W\"\nG = \"2 W/K\"\n[node]\nbody = { C = \"500 J/K\", T0 = \"20 degC\" \
         }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"air\", G = \
         \"G\" }\n[source]\nheat = { into = \"body\", P = \"P\" }\n[limit]\nhot = { of = \"body.T\", below = \
         \"90 degC\" }\n[run]\nstop = \"1000 s\"\n",
    );
    let integrator = IntegratorChoice::OneStep;
    let settings = Transient { trajectory: true, integrator, ..until(1000.0, 1e-9) };
    let solution = run(&network, &settings);
    let (limit, parameters) = (network.limit_ids().next().unwrap(), network.parameter_ids());
    let parameters: Vec<ParameterId> = parameters.collect();
    let mean = (limit, Functional::Mean);
    let found = solution.margin_gradient(mean, &parameters, &|_| Proceed::Continue).unwrap();
    let (p, g, c, t) = (40.0, 2.0, 500.0, 1000.0);
    let x = f64::exp(-g * t / c);
    let part = 1.0 - c / (g * t) * (1.0 - x);
    let by_g = -p / (g * g) * part + p / g * (c / (g * g * t) * (1.0 - x) - x / g);
    near(found.margin, 70.0 - p / g * part, (1e-8, 1.0));
    near(found.by[0], -part / g, (1e-8, 1.0));
    near(found.by[1], -by_g, (1e-8, 1.0));
}

/// A light wall of 48 kJ/K next to inner walls of 7.3 MJ/K, heated half of each day for 20 days: the
/// adjoint falls by two decades, and begins anew at every jump.
const ROOM: &str = r#"
[param]
wall = "10.5 m^2"
inner = "75.5 m^2"
[signal]
gains = { t = ["0 h", "6 h", "18 h", "24 h"], v = ["0 W", "1 kW", "0 W", "0 W"], interp = "previous", after_end = "repeat", period = "24 h" }
[node]
c_ext = { C = "47900 J/K", T0 = "22 degC" }
c_int = { C = "7297100 J/K", T0 = "22 degC" }
s_ext = { massless = true }
[boundary]
out = { T = "22 degC" }
[convection]
between = { from = "s_ext", to = "c_int", h = "5 W/(m^2 K)", area = "wall" }
outside = { from = "c_ext", to = "out", h = "2.4 W/(m^2 K)", area = "wall" }
[resistor]
wall_in = { from = "s_ext", to = "c_ext", G = "247 W/K" }
[source]
ext = { into = "s_ext", P = "wall / (wall + inner) * gains" }
int = { into = "c_int", P = "inner / (wall + inner) * gains" }
[limit]
hot = { of = "c_ext.T", below = "100 degC" }
[run]
stop = "20 d"
"#;

#[test]
fn an_adjoint_that_falls_by_decades_keeps_its_digits() {
    let network = network(ROOM);
    let parameters: Vec<ParameterId> = network.parameter_ids().collect();
    let stop = 20.0 * 86400.0;
    let forward = sensitive_run(&network, &until(stop, 1e-8), &parameters).unwrap();
    let row = forward.solution.times().len() - 1;
    let limit = network.limit_ids().next().unwrap();
    let settings = Transient { trajectory: true, ..until(stop, 1e-8) };
    let solution = run(&network, &settings);
    let last = (limit, Functional::Last);
    let found = solution.margin_gradient(last, &parameters, &|_| Proceed::Continue).unwrap();
    for (&parameter, found) in parameters.iter().zip(found.by) {
        let expected = forward.margin_derivative(parameter, (limit, row)).unwrap();
        println!("{found:e} {expected:e}");
        near(found, expected, (1e-6, expected.abs()));
    }
}

/// The node that each heater heats.
const HEATED: [&str; 3] = ["room0", "room1", "plate"];

/// Three bodies, each with a thermostat, at random. The first thermostat feels a massless node that
/// is eliminated, the second one that is solved for, the third heats its room through such a node.
fn rooms(seed: u64) -> Network {
    let mut random = Dice::new(seed);
    let mut text =
        String::from("[param]\nG = \"1.5 W/K\"\nP = \"90 W\"\non = \"30 degC\"\nC = \"400 J/K\"\n");
    let mut parts = [const { String::new() }; 5];
    for k in 0..3 {
        let size = random.between(0.5, 2.0);
        let (own, band) = (random.between(0.0, 8.0), random.between(1.0, 6.0));
        let dwell = if random.between(0.0, 1.0) < 0.3 { "12 s" } else { "0 s" };
        let heat = random.between(0.7, 1.3);
        parts[0] += &format!("room{k} = {{ C = \"{size} * C\", T0 = \"20 degC\" }}\n");
        parts[1] +=
            &format!("wall{k} = {{ from = \"room{k}\", to = \"air\", G = \"G * {size}\" }}\n");
        parts[2] += &format!(
            "heater{k} = {{ sense = \"{}\", on_below = \"on + {own} [K]\", off_above = \"on + {} \
             [K]\", start = \"on\", min_dwell = \"{dwell}\" }}\n",
            ["joint", "shell", "room2"][k],
            own + band
        );
        parts[3] +=
            &format!("heat{k} = {{ into = \"{}\", P = \"P * {heat} * heater{k}\" }}\n", HEATED[k]);
        parts[4] += &format!(
            "sky{k} = {{ from = \"room{k}\", to = \"air\", emissivity = 0.9, area = \"0.02 m^2\" }}\n"
        );
    }
    let [nodes, walls, controls, sources, skies] = parts;
    text += &format!(
        "[node]\n{nodes}joint = {{ massless = true }}\nshell = {{ massless = true }}\nplate = {{ massless \
         = true }}\n[boundary]\nair = {{ T = \"10 degC\" }}\n[resistor]\n{walls}a = {{ from = \
         \"room0\", to = \"room1\", G = \"0.3 * G\" }}\nb = {{ from = \"room1\", to = \"room2\", G = \
         \"0.2 * G\" }}\nc = {{ from = \"room0\", to = \"joint\", G = \"2 * G\" }}\nd = {{ from = \"joint\", \
         to = \"air\", G = \"0.1 * G\" }}\ne = {{ from = \"room1\", to = \"shell\", G = \"3 * G\" }}\nf = {{ \
         from = \"plate\", to = \"room2\", G = \"4 * G\" }}\n[radiation]\n{skies}g = {{ from = \"shell\", to \
         = \"air\", emissivity = 0.9, area = \"0.03 m^2\" }}\nh = {{ from = \"plate\", to = \"air\", \
         emissivity = 0.9, area = \"0.03 m^2\" }}\n[control]\n{controls}[source]\n{sources}[limit]\nhot = {{ \
         of = \"room1.T\", below = \"90 degC\" }}\n[run]\nstop = \"1000 s\"\nreport = {{ warmth = \
         \"mean(room1.T)\" }}\n"
    );
    network(&text)
}

/// Differences of exact runs, of the fourth order: a parameter moves by 1e-5 of itself.
#[test]
fn rooms_that_switch_agree_with_differences_of_runs() {
    let (mut compared, mut switches) = (0, 0);
    for seed in 0..6 {
        let network = rooms(seed);
        let limit = network.limit_ids().next().unwrap();
        let settings = until(1000.0, 1e-10);
        let own = run(&network, &settings);
        let functional = [Functional::Last, Functional::Mean][usize::from(seed % 2 == 1)];
        let found = by_all(&network, 1e-10, limit, functional);
        for (parameter, found) in network.parameter_ids().zip(found) {
            let value = network.parameter_value(parameter);
            let at = |steps: f64| {
                let mut changed = network.given();
                changed.set(parameter, value * (1.0 + 1e-5 * steps));
                let other = run(&network.with(&changed).unwrap(), &settings);
                (other.events().len(), margin(&other, functional))
            };
            let sides = [-2.0, -1.0, 1.0, 2.0].map(at);
            if sides.iter().any(|(events, _)| *events != own.events().len()) {
                continue; // a switch comes or goes at the end
            }
            let [a, b, c, d] = sides.map(|(_, margin)| margin);
            let expected = (8.0 * (c - b) - (d - a)) / (12e-5 * value);
            println!("{seed} {found:e} {expected:e}");
            near(found * value, expected * value, (1e-5, (expected * value).abs().max(10.0)));
            compared += 1;
        }
        switches += own.events().len();
    }
    assert!(compared > 15 && switches > 80, "{compared} {switches}");
}

/// The margin of the limit at the end, or its mean.
fn margin(solution: &Solution, functional: Functional) -> f64 {
    let room = solution.network().node("room1").unwrap();
    let temperature = match functional {
        Functional::Last => *solution.temperature(room).unwrap().last().unwrap(),
        _ => solution.reports_over_time()[0].value,
    };
    363.15 - temperature
}

/// A rod of 1000 nodes whose 1000 conductances, each with its parameter, are constant or rise with
/// temperature. The gradient takes at most four times the time of the run; the ratio is printed, not
/// asserted.
#[test]
#[ignore = "measures time"]
fn thousand_parameters() {
    for law in LAWS {
        let network = rod(1000, (law, "50 W", ""));
        for tolerance in [1e-3, 1e-4, 1e-6, 1e-8] {
            println!(
                "`{law}` at {tolerance} K: {}",
                cost_of_gradient(&network, (1000.0, tolerance))
            );
        }
    }
}

/// The same heated by a thermostat, through 25 switches.
#[test]
#[ignore = "measures time"]
fn thousand_parameters_through_switches() {
    let heater = "[control]\nheater = { sense = \"n999\", off_above = \"45 degC\", on_below = \"40 \
                  degC\", start = \"on\" }\n";
    for law in LAWS {
        let network = rod(1000, (law, "heater * 50 [W]", heater));
        for tolerance in [1e-3, 1e-4, 1e-6, 1e-8] {
            println!(
                "`{law}` at {tolerance} K: {}",
                cost_of_gradient(&network, (100.0, tolerance))
            );
        }
    }
}

const LAWS: [&str; 2] = ["", " * (1 + 0.001 [1/K] * (@.T - 20 [degC]))"];

/// A rod of some nodes with a factor of each conductance, in which `@` is its node, the power at its
/// end, and further entries.
fn rod(count: usize, (law, power, more): (&str, &str, &str)) -> Network {
    let mut parts = [const { String::new() }; 3];
    let mut before = "air".to_owned();
    for k in 0..count {
        let node = format!("n{k}");
        let factor = law.replace('@', &node);
        parts[0] += &format!("G{k} = \"{} W/K\"\n", 20 + k % 7);
        parts[1] += &format!("{node} = {{ C = \"{} J/K\", T0 = \"20 degC\" }}\n", 5 + k % 3);
        parts[2] +=
            &format!("r{k} = {{ from = \"{before}\", to = \"{node}\", G = \"G{k}{factor}\" }}\n");
        before = node;
    }
    let [parameters, nodes, paths] = parts;
    network(&format!(
        "[param]\n{parameters}[boundary]\nair = {{ T = \"20 degC\" }}\n[node]\n{nodes}[resistor]\n\
         {paths}[source]\nheat = {{ into = \"{before}\", P = \"{power}\" }}\n{more}[limit]\nhot = {{ of = \
         \"n{}.T\", below = \"500 degC\" }}\n[run]\nstop = \"1000 s\"\n",
        count * 99 / 100
    ))
}

fn cost_of_gradient(network: &Network, (stop, tolerance): (f64, f64)) -> String {
    let limit = network.limit_ids().next().unwrap();
    let parameters: Vec<ParameterId> = network.parameter_ids().collect();
    let began = std::time::Instant::now();
    run(network, &until(stop, tolerance));
    let once = began.elapsed();
    let settings = Transient { trajectory: true, ..until(stop, tolerance) };
    let began = std::time::Instant::now();
    let solution = run(network, &settings);
    let way =
        solution.margin_gradient((limit, Functional::Last), &parameters, &|_| Proceed::Continue);
    let all = began.elapsed();
    let (by, ratio) = (way.unwrap().by, all.as_secs_f64() / once.as_secs_f64());
    format!("run {once:?}, with gradient {all:?}: {ratio:.2} runs, {:e}", by[992])
}
