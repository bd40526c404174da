//! Analytic: means and extremes over windows, reports and balances, against closed forms of two
//! nodes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, ConductorKind, End, HeatCapacity, HeatFlow, Input, Network, NetworkBuilder, Path,
    Temperature, Time,
};
use lptn_solve::{Selection, Solution, SteadyState, Transient, Window, WindowSeen};
use lptn_units::parse_quantity;

const C: [f64; 2] = [1235.0, 1424.0];
const G: f64 = 220.6 / 1.7;
const G_OUT: f64 = 220.6 / 65.5;
const P: f64 = 220.6;
const T0: f64 = 298.65;

/// The gearbox of the seed paper: steel, aluminium, ambient.
fn gearbox() -> NetworkBuilder {
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(C[0]), Temperature(T0));
    let aluminium = b.node("aluminium", HeatCapacity(C[1]), Temperature(T0));
    let air = b.boundary("air", Temperature(T0));
    b.resistor("internal", steel, aluminium, Conductance(G));
    b.resistor("skin", aluminium, air, Conductance(G_OUT));
    b.source("P_disp", steel, HeatFlow(P));
    b
}

fn system(builder: NetworkBuilder) -> ThermalSystem {
    let network: Network = builder.build().unwrap();
    ThermalSystem::assemble(&network).unwrap()
}

/// A column of a window.
fn column<'a>(window: &'a WindowSeen, name: &str) -> &'a lptn_solve::ColumnSeen {
    window.columns.iter().find(|column| column.name == name).unwrap()
}

fn windowed(system: &ThermalSystem, stop: f64, (from, to): (f64, f64), tolerance: f64) -> Solution {
    let of = Selection::all(system.network());
    let window = Window { name: "w".into(), from, to, of };
    Transient::until(Time(stop)).tolerance(tolerance).window(window).solve(system).unwrap()
}

/// Rates, weights and steady rises of the two nodes over the ambient: x_i(t) = s_i + sum_k a_ik
/// exp(r_k t), from the characteristic equation of the 2 x 2 matrix.
fn modes() -> ([f64; 2], [[f64; 2]; 2], [f64; 2]) {
    let (a, b, c, d) = (-G / C[0], G / C[0], G / C[1], -(G + G_OUT) / C[1]);
    let (half, det) = (0.5 * (a + d), a * d - b * c);
    let root = (half * half - det).sqrt();
    let rates = [half + root, half - root];
    let steady = [P / G_OUT + P / G, P / G_OUT];
    // vectors (b, r - a); weights w from -steady = w_0 v_0 + w_1 v_1
    let v = rates.map(|r| [b, r - a]);
    let det_v = v[0][0] * v[1][1] - v[1][0] * v[0][1];
    let w = [
        (-steady[0] * v[1][1] + steady[1] * v[1][0]) / det_v,
        (-steady[1] * v[0][0] + steady[0] * v[0][1]) / det_v,
    ];
    let weight = |i: usize, k: usize| w[k] * v[k][i];
    (rates, [[weight(0, 0), weight(0, 1)], [weight(1, 0), weight(1, 1)]], steady)
}

fn rise(node: usize, t: f64) -> f64 {
    let (rates, weights, steady) = modes();
    steady[node] + (0..2).map(|k| weights[node][k] * (rates[k] * t).exp()).sum::<f64>()
}

/// The integral of a rise from 0 to `t`.
fn integral(node: usize, t: f64) -> f64 {
    let (rates, weights, steady) = modes();
    let term = |k: usize| weights[node][k] * ((rates[k] * t).exp() - 1.0) / rates[k];
    steady[node] * t + term(0) + term(1)
}

#[test]
fn means_of_the_gearbox_are_those_of_its_exponentials() {
    let mut b = gearbox();
    let program = b.post_expression("steel.T - aluminium.T", None).unwrap();
    b.report("spread", program.into(), "steel.T - aluminium.T");
    let system = system(b);
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let solution = windowed(&system, 1500.0, (613.7, 1207.1), tolerance);
        let [window] = solution.windows() else { panic!("one window") };
        let mean = [0, 1].map(|i| (integral(i, 1207.1) - integral(i, 613.7)) / (1207.1 - 613.7));
        let near = |found: f64, exact: f64| {
            assert!((found - exact).abs() < 10.0 * tolerance, "{found} {exact} at {tolerance}");
        };
        near(column(window, "steel.T").mean, T0 + mean[0]);
        near(column(window, "aluminium.T").mean, T0 + mean[1]);
        near(column(window, "spread").mean, mean[0] - mean[1]);
        near(column(window, "skin.Q").mean / G_OUT, mean[1]);
        near(column(window, "steel.T").min.0, T0 + rise(0, 613.7));
        near(column(window, "steel.T").max.0, T0 + rise(0, 1207.1));
        assert_eq!(column(window, "steel.T").max.1.to_bits(), 1207.1_f64.to_bits());
        assert_eq!(column(window, "steel.T").min.1.to_bits(), 613.7_f64.to_bits());
    }
}

#[test]
fn a_sine_has_its_mean_and_its_top_between_the_rows() {
    let mut b = NetworkBuilder::new();
    let block = b.node("block", HeatCapacity(1e4), Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", block, room, Conductance(1.0));
    let power = b.expression("100 [W] * sin(2 * pi * t / 600 [s])", None).unwrap();
    b.source("heater", block, power);
    let system = system(b);
    let solution = windowed(&system, 600.0, (0.0, 300.0), 1e-6);
    let heater = column(&solution.windows()[0], "heater.P");
    assert!((heater.mean - 200.0 / std::f64::consts::PI).abs() < 1e-7, "{}", heater.mean);
    assert!(
        (heater.max.0 - 100.0).abs() < 1e-6 && (heater.max.1 - 150.0).abs() < 0.1,
        "{heater:?}"
    );
}

#[test]
fn a_jump_inside_a_window_is_met_and_both_sides_count() {
    let mut b = NetworkBuilder::new();
    let block = b.node("block", HeatCapacity(1e3), Temperature(300.0));
    let power = b.expression("if(t < 70 [s], 10 [W], 30 [W])", None).unwrap();
    b.source("heater", block, power);
    let system = system(b);
    let solution = windowed(&system, 200.0, (20.0, 120.0), 1e-5);
    let window = &solution.windows()[0];
    let heater = column(window, "heater.P");
    assert!((heater.mean - 20.0).abs() < 1e-12, "{}", heater.mean);
    // both last, the larger one until the end: they are where they begin
    assert_eq!((heater.min, heater.max), ((10.0, 20.0), (30.0, 70.0)));
    // 300.2 K at 20 s, 300.7 K at 70 s, 302.2 K at 120 s
    let mean = 0.5 * (300.45 + 301.45);
    assert!((column(window, "block.T").mean - mean).abs() < 1e-5);
}

#[test]
fn a_network_without_state_has_windows_and_a_balance_too() {
    let mut b = NetworkBuilder::new();
    let joint = b.massless("joint");
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", joint, room, Conductance(2.0));
    let power = b.expression("1 [W/s^2] * t * t", None).unwrap();
    b.source("heater", joint, power);
    let system = system(b);
    let of = Selection::all(system.network());
    let run =
        Transient::until(Time(30.0)).window(Window { name: "w".into(), from: 5.0, to: 20.0, of });
    let solution = run.balance(joint).solve(&system).unwrap();
    let mean = (20.0_f64.powi(3) - 5.0_f64.powi(3)) / 3.0 / 15.0;
    assert!((column(&solution.windows()[0], "heater.P").mean - mean).abs() < 1e-10);
    assert!((column(&solution.windows()[0], "joint.T").mean - 300.0 - mean / 2.0).abs() < 1e-9);
    let balance = solution.balance().unwrap();
    assert!((balance.heat_turned_over().unwrap() - 9000.0).abs() < 1e-8);
    assert!(
        balance.heat().unwrap().abs() < 1e-8 && (balance.power_turned_over() - 900.0).abs() < 1e-9
    );
}

#[test]
fn the_balance_of_steel_is_that_of_the_exponentials() {
    let system = system(gearbox());
    let steel = system.network().node("steel").unwrap();
    let solution =
        Transient::until(Time(1500.0)).tolerance(1e-7).balance(steel).solve(&system).unwrap();
    let balance = solution.balance().unwrap();
    let terms = balance.largest_first();
    let names: Vec<_> = terms.iter().map(|term| system.network().name_of(term.item)).collect();
    assert_eq!(names, ["P_disp", "internal"]);
    let through = G * (integral(0, 1500.0) - integral(1, 1500.0));
    assert!((terms[0].heat.unwrap() - P * 1500.0).abs() < 1e-6);
    assert!((terms[1].heat.unwrap() + through).abs() < 1e-3, "{:?} {through}", terms[1]);
    assert!((terms[1].power + G * (rise(0, 1500.0) - rise(1, 1500.0))).abs() < 1e-4);
    assert_eq!(terms[1].other, Some(End::Node(system.network().node("aluminium").unwrap())));
    // running integrals obey the formula of the state: the books of one node close to rounding
    let stored = balance.stored.unwrap();
    assert!((stored - C[0] * rise(0, 1500.0)).abs() < 1e-3);
    assert!((balance.heat().unwrap() - stored).abs() < 1e-9 * P * 1500.0);
}

#[test]
fn balances_of_all_nodes_and_boundaries_close_with_streams_shares_and_junctions() {
    let mut b = NetworkBuilder::new();
    let quantity = |text: &str| -> Input { parse_quantity(text, None).unwrap().into() };
    let inlet = b.boundary("inlet", Temperature(290.0));
    let outlet = b.boundary("outlet", Temperature(290.0));
    let body = b.node("body", HeatCapacity(900.0), Temperature(300.0));
    let oil = b.node("oil", HeatCapacity(300.0), Temperature(300.0));
    let joint = b.massless("joint");
    b.resistor("a", body, joint, Conductance(4.0));
    b.resistor("b", joint, oil, Conductance(8.0));
    b.conductor(
        "glow",
        ConductorKind::Radiation,
        (body.into(), outlet.into()),
        Path::radiation(quantity("0.1 m^2")),
    );
    let stream = || Path::stream(quantity("5 W/K"));
    b.conductor("in", ConductorKind::Advection, (inlet.into(), oil.into()), stream());
    b.conductor("out", ConductorKind::Advection, (oil.into(), outlet.into()), stream());
    b.shared_source("loss", &[(body, 0.7), (oil, 0.3)], HeatFlow(200.0));
    let system = system(b);
    let network = system.network();
    let ends = network.node_ids().map(End::Node).chain(network.boundary_ids().map(End::Boundary));
    for end in ends {
        let solution = Transient::until(Time(900.0)).balance(end).solve(&system).unwrap();
        let balance = solution.balance().unwrap();
        let (sum, all) = (balance.heat().unwrap(), balance.heat_turned_over().unwrap());
        let gap = (sum - balance.stored.unwrap()).abs();
        assert!(gap <= 2e-6 * all + 1e-9, "{end:?}: {gap} of {all}");
    }
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    for node in network.node_ids() {
        let balance = steady.balance(network, node.into());
        assert!(balance.power().abs() < 1e-7 * balance.power_turned_over(), "{balance:?}");
        assert_eq!((balance.stored, balance.heat()), (None, None));
    }
}

#[test]
fn a_window_outside_the_run_is_refused() {
    let system = system(gearbox());
    for (from, to) in [(-1.0, 10.0), (10.0, 10.0), (20.0, 10.0), (10.0, 2000.0), (f64::NAN, 10.0)] {
        let window = Window { name: "w".into(), from, to, of: Selection::all(system.network()) };
        let error = Transient::until(Time(1500.0)).window(window).solve(&system).unwrap_err();
        assert!(error.to_string().contains("window `w`"), "{error}");
    }
}
