//! Flow networks: closed forms, SciPy, a printed Hardy Cross example, balances of random networks.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::fmt::Write as _;

use crate::elements_helper::Random;

use lptn_assembly::ThermalSystem;
use lptn_network::{Network, Time};
use lptn_solve::{SteadyState, Transient};

const ZERO: f64 = 273.15;

fn network(text: &str) -> Network {
    let text = format!("format = 1\n{text}");
    let netlist = lptn_netlist::parse("net.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    netlist.network
}

/// A body, since a network of pressures alone is not a network.
const BODY: &str = "[boundary]\nair = { T = \"20 degC\" }\n[node]\nbody = { massless = true }\n\
    [resistor]\npath = { from = \"body\", to = \"air\", R = \"1 K/W\" }\n";

/// Value of a named value or pressure in SI units in steady state.
fn steady(text: &str, names: &[&str]) -> Vec<f64> {
    let network = network(text);
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    read(&network, &steady, names)
}

fn read(network: &Network, steady: &SteadyState, names: &[&str]) -> Vec<f64> {
    let mut scope = steady.evaluation(network);
    let one = |name: &&str| {
        if let Some(id) = network.state(name) {
            return network.state_value(id, &steady.temperatures);
        }
        if let Ok(id) = network.parameter(name) {
            return network.parameter_value(id);
        }
        let id = network.report_ids().find(|id| network.reports()[id.index()].name == **name);
        network.report_value(id.unwrap_or_else(|| panic!("no `{name}`")), &mut scope).unwrap()
    };
    names.iter().map(one).collect()
}

fn near(found: f64, right: f64, share: f64) {
    assert!((found - right).abs() <= share * right.abs(), "{found} is not {right}");
}

/// The flow through one branch for a pressure difference.
fn flow(branch: &str, dp: f64) -> f64 {
    let text = format!(
        "{BODY}[junction]\na = {{ p = \"{dp} Pa\" }}\nb = {{ p = \"0 Pa\" }}\nc = {{}}\n[branch]\n\
         it = {{ from = \"a\", to = \"b\", {branch} }}\n\
         one = {{ from = \"a\", to = \"c\", flow = \"dp * 1 [kg/(s Pa)]\" }}\n\
         other = {{ from = \"c\", to = \"b\", flow = \"dp * 1 [kg/(s Pa)]\" }}\n"
    );
    steady(&text, &["it"])[0]
}

/// SciPy's fsolve with a tolerance of 1e-13: temperatures of two channels that share 0.05 kg/s of
/// oil by its viscosity.
#[test]
fn the_hotter_channel_takes_more() {
    let text = r#"
[lubricant.oil]
viscosity = [["40 degC", "46 mm^2/s"], ["100 degC", "6.8 mm^2/s"]]
density = "870 kg/m^3"
[boundary]
supply = { T = "40 degC" }
[node]
one = { massless = true }
two = { massless = true }
[junction]
tank = { p = "0 bar" }
rail = {}
[branch]
pump = { from = "tank", to = "rail", flow = "0.05 kg/s" }
first = { from = "rail", to = "tank", lubricant = "oil", flow_T = "one.T", length = "1 m", diameter = "10 mm" }
second = { from = "rail", to = "tank", lubricant = "oil", flow_T = "two.T", length = "1 m", diameter = "10 mm" }
[advection]
in1 = { from = "supply", to = "one", mcp = "first * 2000 [J/(kg K)]" }
in2 = { from = "supply", to = "two", mcp = "second * 2000 [J/(kg K)]" }
out1 = { from = "one", to = "supply", mcp = "first * 2000 [J/(kg K)]" }
out2 = { from = "two", to = "supply", mcp = "second * 2000 [J/(kg K)]" }
[source]
q1 = { into = "one", P = "2 kW" }
q2 = { into = "two", P = "1 kW" }
"#;
    let network = network(text);
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    let found: Vec<f64> = steady.temperatures[..2].iter().map(|t| t - ZERO).collect();
    assert!((found[0] - 74.403662).abs() < 1e-6, "{found:?}");
    assert!((found[1] - 63.885358).abs() < 1e-6, "{found:?}");
}

/// Closed forms: resistances in parallel and in series.
#[test]
fn laminar_branches_in_parallel_and_in_series() {
    let text = format!(
        "{BODY}[junction]\ntank = {{ p = \"1 bar\" }}\nrail = {{}}\nmid = {{}}\n[branch]\n\
         pump = {{ from = \"tank\", to = \"rail\", flow = \"0.1 kg/s\" }}\n\
         a = {{ from = \"rail\", to = \"mid\", resistance = \"2e9 Pa s/m^3\", density = \"800 kg/m^3\" }}\n\
         b = {{ from = \"rail\", to = \"mid\", resistance = \"6e9 Pa s/m^3\", density = \"800 kg/m^3\" }}\n\
         c = {{ from = \"mid\", to = \"tank\", resistance = \"1e9 Pa s/m^3\", density = \"800 kg/m^3\" }}\n"
    );
    let found = steady(&text, &["a", "b", "c", "rail", "mid", "a.volume_flow"]);
    let volume = 0.1 / 800.0;
    let right = [0.075, 0.025, 0.1, 1e5 + volume * 2.5e9, 1e5 + volume * 1e9, 0.75 * volume];
    found.iter().zip(right).for_each(|(found, right)| near(*found, right, 1e-9));
}

/// Closed forms of the definitions of zeta, C_d and K_v.
#[test]
fn losses_orifices_and_valves() {
    let density = "density = \"900 kg/m^3\"";
    for sign in [1.0, -1.0] {
        let zeta = flow(&format!("zeta = 3, area = \"10 mm^2\", {density}"), sign * 5e4);
        near(zeta, sign * 900.0 * 1e-5 * (5e4_f64 * 2.0 / (3.0 * 900.0)).sqrt(), 1e-12);
        let orifice = flow(&format!("C_d = 0.6, area = \"10 mm^2\", {density}"), sign * 5e4);
        near(orifice, sign * 0.6 * 1e-5 * (2.0 * 900.0 * 5e4_f64).sqrt(), 1e-12);
        let valve = flow(&format!("K_v = \"3.6 m^3/h\", {density}"), sign * 4e4);
        near(valve, sign * 900.0 * 1e-3 * (0.4_f64 * 1000.0 / 900.0).sqrt(), 1e-12);
    }
    // below dp_small: the cubic with the value and the slope of the root there
    let small = flow(&format!("zeta = 2, area = \"1 m^2\", dp_small = \"4 Pa\", {density}"), 2.0);
    near(small, 900.0 * (4.0_f64 / 900.0).sqrt() * (1.25 * 0.5 - 0.25 * 0.125), 1e-12);
}

/// Hagen-Poiseuille; Colebrook by iteration over the friction factor, as it is printed.
#[test]
fn pipes_are_laminar_and_turbulent() {
    let (d, length, rho, mu) = (0.02_f64, 5.0, 998.0, 1e-3);
    let pipe = |rough: f64| {
        format!(
            "length = \"5 m\", diameter = \"20 mm\", roughness = \"{rough} m\", \
             density = \"998 kg/m^3\", viscosity = \"1 mPa s\""
        )
    };
    let laminar = std::f64::consts::PI * rho * d.powi(4) / (128.0 * mu * length);
    near(flow(&pipe(1e-4), 10.0), laminar * 10.0, 1e-12);
    for rough in [0.0, 1e-5, 5e-4] {
        for dp in [3e3, 1e5, -1e5] {
            let found = flow(&pipe(rough), dp);
            let (re, area) = (4.0 * found.abs() / (std::f64::consts::PI * d * mu), d * d / 4.0);
            let mut f: f64 = 0.03;
            for _ in 0..100 {
                f = (-2.0 * (rough / (3.7 * d) + 2.51 / (re * f.sqrt())).log10()).powi(-2);
            }
            let speed = found / (rho * std::f64::consts::PI * area);
            near(f * length / d * rho / 2.0 * speed * speed.abs(), dp, 1e-9);
            assert!(re > 4000.0, "{re}");
        }
    }
    // between them the flow rises
    let flows: Vec<f64> = (0..200).map(|k| flow(&pipe(0.0), 20.0 + 2.0 * f64::from(k))).collect();
    assert!(flows.windows(2).all(|pair| pair[0] < pair[1]));
    let steepest = flows.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(steepest < 2.1 * laminar, "it is continuous");
}

/// Closed forms: p_0 s^2 - a s V - b V^2 = k V^2, and a straight curve at a straight system.
#[test]
fn pumps_meet_their_systems() {
    let system = |pump: &str, back: &str| {
        format!(
            "{BODY}[junction]\ntank = {{ p = \"0 Pa\" }}\nrail = {{}}\n[branch]\n\
             pump = {{ from = \"tank\", to = \"rail\", {pump}, density = \"1000 kg/m^3\" }}\n\
             back = {{ from = \"rail\", to = \"tank\", {back}, density = \"1000 kg/m^3\" }}\n"
        )
    };
    // V/area = 2000 V, so that k is 1e3/2 x 2000^2
    let (quadratic, k) = ("zeta = 1, area = \"5 cm^2\"", 500.0 * 2000.0 * 2000.0);
    for (a, b, s) in [(0.0_f64, 1e10, 1.0_f64), (2e7, 1e10, 0.8), (2e7, 0.0, 0.5)] {
        let mut pump = format!("p_0 = \"1 bar\", speed = {s}, efficiency = 0.5");
        if a > 0.0 {
            write!(pump, ", a = \"{a} Pa s/m^3\"").unwrap();
        }
        if b > 0.0 {
            write!(pump, ", b = \"{b} Pa s^2/m^6\"").unwrap();
        }
        let found = steady(&system(&pump, quadratic), &["pump.volume_flow", "rail", "pump.power"]);
        let (linear, square, p): (f64, f64, f64) = (a * s, b + k, 1e5 * s * s);
        let volume = 2.0 * p / (linear + (linear * linear + 4.0 * square * p).sqrt());
        near(found[0], volume, 1e-9);
        near(found[1], k * volume * volume, 1e-9);
        near(found[2], k * volume.powi(3) / 0.5, 1e-9);
    }
    let curve =
        "curve = [[\"0 l/min\", \"3 bar\"], [\"30 l/min\", \"2 bar\"], [\"60 l/min\", \"0 bar\"]]";
    let found = steady(
        &system(&format!("{curve}, speed = 0.9"), "resistance = \"2e8 Pa s/m^3\""),
        &["pump.volume_flow"],
    );
    // second line at the speed: p = 0.81 (4e5 - 4e8 V/0.9), as V/0.9 is between 0.5 and 1 l/s
    near(found[0], 0.81 * 4e5 / (2e8 + 0.9 * 4e8), 1e-9);
    let shut = "flow = \"0 [kg/(s Pa)] * dp\"";
    let shut = system("p_0 = \"1 bar\", b = \"1e10 Pa s^2/m^6\"", shut);
    let shut = shut.replace("dp\", density = \"1000 kg/m^3\"", "dp\"");
    near(steady(&shut, &["rail"])[0], 1e5, 1e-6);
}

/// A Hardy Cross example with two tanks, one 10 ft below the other, printed with two decimals: Michigan Tech, CE
/// 3620 Water Resources Engineering, lecture 9 (2013). Head loss in ft is K Q^2 with Q in ft^3/s;
/// 1 Pa and 1 kg/s stand for them here.
#[test]
fn a_printed_hardy_cross_example() {
    let pipes = [
        ("A", "n1", 0.38),
        ("n1", "n2", 2.89),
        ("n1", "n4", 2.53),
        ("n4", "n2", 12.13),
        ("n3", "n2", 2.17),
        ("n3", "n4", 2.89),
        ("B", "n3", 0.94),
    ];
    let mut text = format!("{BODY}[junction]\nA = {{ p = \"0 Pa\" }}\nB = {{ p = \"-10 Pa\" }}\n");
    (1..5).for_each(|n| writeln!(text, "n{n} = {{ size = \"10 Pa\" }}").unwrap());
    text += "[branch]\n";
    for (i, (from, to, k)) in pipes.iter().enumerate() {
        writeln!(
            text,
            "p{} = {{ from = \"{from}\", to = \"{to}\", zeta = {}, area = \"1 m^2\", \
             dp_small = \"1e-6 Pa\", density = \"1 kg/m^3\" }}",
            i + 1,
            2.0 * k
        )
        .unwrap();
    }
    for (n, demand) in [2.0, 4.0, 1.0, 3.0].into_iter().enumerate() {
        let n = n + 1;
        writeln!(text, "d{n} = {{ from = \"n{n}\", to = \"A\", flow = \"{demand} kg/s\" }}")
            .unwrap();
    }
    let found = steady(&text, &["p2", "p3", "p4"]);
    for (found, printed) in found.into_iter().zip([2.13, 2.16, 0.32]) {
        assert!((found - printed).abs() < 0.006, "{found} is printed as {printed}");
    }
}

/// Flows rise with pressure differences, so that the pressures at which every junction balances are
/// the only ones. The flows are computed here from the pressures found.
#[test]
fn junctions_of_random_networks_balance() {
    let mut random = Random(25);
    let mut uniform = |low: f64, high: f64| random.between(low, high);
    for _ in 0..100 {
        let junctions = 2 + uniform(0.0, 8.0) as usize;
        let mut text = format!("{BODY}[junction]\nj0 = {{ p = \"1 bar\" }}\n");
        (1..=junctions).for_each(|j| writeln!(text, "j{j} = {{}}").unwrap());
        text += "[branch]\n";
        let mut branches = Vec::new();
        for i in 0..2 * junctions {
            let to = 1 + i % junctions;
            let from = if i < junctions { to - 1 } else { uniform(0.0, to as f64) as usize };
            let (laminar, size) = (uniform(0.0, 1.0) < 0.4, 10_f64.powf(uniform(-5.0, -3.0)));
            let law = match laminar {
                true => format!("resistance = \"{:e} Pa s/m^3\"", 1e5 / size),
                false => format!("zeta = 1.5, area = \"{:e} m^2\"", size),
            };
            writeln!(
                text,
                "b{i} = {{ from = \"j{from}\", to = \"j{to}\", {law}, density = \"850 kg/m^3\" }}"
            )
            .unwrap();
            branches.push((from, to, laminar, size));
        }
        let mut drawn = vec![0.0; junctions + 1];
        for (j, drawn) in drawn.iter_mut().enumerate().skip(1) {
            *drawn = uniform(-1.0, 1.0);
            writeln!(text, "d{j} = {{ from = \"j{j}\", to = \"j0\", flow = \"{drawn} kg/s\" }}")
                .unwrap();
        }
        let names: Vec<String> = (0..=junctions).map(|j| format!("j{j}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let p = steady(&text, &names);
        let mut left: Vec<f64> = drawn.iter().map(|drawn| -drawn).collect();
        for (from, to, laminar, size) in branches {
            let dp: f64 = p[from] - p[to];
            let flow = match laminar {
                true => 850.0 * dp * size / 1e5,
                false => size * (2.0 * 850.0 * dp.abs() / 1.5).sqrt() * dp.signum(),
            };
            left[from] -= flow;
            left[to] += flow;
        }
        left[1..].iter().for_each(|left| assert!(left.abs() < 1e-6, "{left}\n{text}"));
    }
}

/// Closed form: a body in a stream whose flow follows from pressures.
#[test]
fn a_body_warms_in_the_stream_of_a_branch() {
    let text = r#"
[boundary]
inlet = { T = "50 degC" }
[node]
body = { C = "2 kJ/K", T0 = "20 degC" }
[junction]
tank = { p = "0 bar" }
rail = {}
[branch]
pump = { from = "tank", to = "rail", flow = "0.02 kg/s" }
a = { from = "rail", to = "tank", resistance = "1e9 Pa s/m^3", density = "1000 kg/m^3" }
b = { from = "rail", to = "tank", resistance = "3e9 Pa s/m^3", density = "1000 kg/m^3" }
[advection]
on = { from = "inlet", to = "body", mcp = "a * 4000 [J/(kg K)]" }
off = { from = "body", to = "inlet", mcp = "a * 4000 [J/(kg K)]" }
"#;
    let network = network(text);
    let system = ThermalSystem::assemble(&network).unwrap();
    let times = [0.0, 20.0, 60.0];
    let solution = Transient::until(Time(60.0)).at(&times).tolerance(1e-6).solve(&system).unwrap();
    let last = solution.last().temperatures[0] - ZERO;
    let exact = 50.0 - 30.0 * (-0.015_f64 * 4000.0 / 2000.0 * 60.0).exp();
    assert!((last - exact).abs() < 1e-4, "{last} is not {exact}");
}

/// By hand: a pump of p = 1 bar - a V between given pressures, which pumps, is overcome, and runs out.
#[test]
fn a_pump_returns_no_power() {
    for (rail, volume, power) in [(0.5_f64, 0.0025, 250.0), (2.0, -0.005, 0.0), (-0.5, 0.0075, 0.0)]
    {
        let text = format!(
            "{BODY}[junction]\ntank = {{ p = \"0 bar\" }}\nrail = {{ p = \"{rail} bar\" }}\nmiddle = {{}}\n\
             [branch]\npump = {{ from = \"tank\", to = \"rail\", p_0 = \"1 bar\", a = \"2e7 Pa s/m^3\", \
             efficiency = 0.5, density = \"1000 kg/m^3\" }}\n\
             one = {{ from = \"tank\", to = \"middle\", flow = \"dp * 1 [kg/(s Pa)]\" }}\n\
             other = {{ from = \"middle\", to = \"rail\", flow = \"dp * 1 [kg/(s Pa)]\" }}\n"
        );
        let found = steady(&text, &["pump.volume_flow", "pump.power"]);
        near(found[0], volume, 1e-9);
        assert!((found[1] - power).abs() <= 1e-6, "{} is not {power}", found[1]);
    }
}

/// Two branches that meet in a massless node: while their pressures are not known, nothing
/// determines its temperature.
const MIXER: &str = r#"
[default]
T0 = "20 degC"
[boundary]
supply = { T = "20 degC" }
out = { T = "20 degC" }
[node]
one = { C = "100 J/K" }
two = { C = "100 J/K" }
mix = { massless = true }
[junction]
tank = { p = "0 bar" }
rail = {}
end = {}
[branch]
pump = { from = "tank", to = "rail", flow = "0.05 kg/s" }
first = { from = "rail", to = "end", resistance = "1e5 Pa s/m^3", density = "870 kg/m^3" }
second = { from = "rail", to = "end", resistance = "2e5 Pa s/m^3", density = "870 kg/m^3" }
back = { from = "end", to = "tank", resistance = "1e5 Pa s/m^3", density = "870 kg/m^3" }
[advection]
in1 = { from = "supply", to = "one", mcp = "first * 2000 [J/(kg K)]" }
in2 = { from = "supply", to = "two", mcp = "second * 2000 [J/(kg K)]" }
o1 = { from = "one", to = "mix", mcp = "first * 2000 [J/(kg K)]" }
o2 = { from = "two", to = "mix", mcp = "second * 2000 [J/(kg K)]" }
[source]
P1 = { into = "one", P = "100 W" }
P2 = { into = "two", P = "300 W" }
[run]
stop = "4 s"
"#;

const LEAVES: &str =
    "[advection.leaves]\nfrom = \"mix\"\nto = \"out\"\nmcp = \"back * 2000 [J/(kg K)]\"\n";

/// Closed form: the channels rise by 1.5 K (1 - exp(-t/1.5 s)) and 9 K (1 - exp(-t/3 s)), and the
/// mixture has two parts of the first and one of the second.
#[test]
fn branches_mix_in_a_massless_node() {
    let network = network(&format!("{MIXER}{LEAVES}"));
    let system = ThermalSystem::assemble(&network).unwrap();
    let times = [0.0, 1.0, 4.0];
    let solution = Transient::until(Time(4.0)).at(&times).tolerance(1e-6).solve(&system).unwrap();
    let rise = |of: f64, tau: f64| of * (1.0 - (-4.0 / tau).exp());
    let exact = (2.0 * rise(1.5, 1.5) + rise(9.0, 3.0)) / 3.0;
    let mix = network.node("mix").unwrap().index();
    let last = solution.last().temperatures[mix] - ZERO - 20.0;
    assert!((last - exact).abs() < 1e-4, "{last} is not {exact}");
}

/// The streams of a flow network are judged with its pressures, not before.
#[test]
fn flows_that_do_not_leave_a_node_are_found() {
    for (text, nodes) in [(format!("{MIXER}{LEAVES}"), 0), (MIXER.to_owned(), 1)] {
        let netlist = lptn_netlist::parse("net.toml", &format!("format = 1\n{text}")).unwrap();
        let streams = |code: &str| code == "network::unbalanced_streams";
        assert!(!netlist.warnings.iter().any(|w| streams(w.code)), "{:?}", netlist.warnings);
        let network = &netlist.network;
        let steady = SteadyState::solve(&ThermalSystem::assemble(network).unwrap(), 0.0).unwrap();
        let temperatures = [&steady.temperatures[..], &steady.boundary_temperatures].concat();
        let found =
            network.unbalanced_flows(&mut steady.evaluation(network), &temperatures).unwrap();
        assert_eq!(found.len(), nodes, "{found:?}");
        for passing in found {
            near(passing.inflow, 100.0, 1e-9);
            assert!(passing.outflow.abs() <= 1e-9, "{passing:?}");
        }
    }
}
