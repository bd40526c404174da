//! Analytic: elements that are more than a constant conductance, against closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, ConductorKind, Context, End, HeatCapacity, HeatFlow, Input, Network,
    NetworkBuilder, NodeId, Path, Temperature, Time,
};
use lptn_solve::{Solution, SteadyState, Transient};
use lptn_units::parse_quantity;

const SIGMA: f64 = 5.670_374_419e-8;

fn system(builder: NetworkBuilder) -> ThermalSystem {
    let network: Network = builder.build().unwrap();
    ThermalSystem::assemble(&network).unwrap()
}

fn quantity(text: &str) -> Input {
    parse_quantity(text, None).unwrap().into()
}

fn run(system: &ThermalSystem, stop: f64, tolerance: f64) -> Solution {
    let solution = Transient::until(Time(stop)).tolerance(tolerance).solve(system).unwrap();
    let ledger = solution.ledger();
    assert!(ledger.closes(), "{ledger:?} {:e}", ledger.relative_residual().unwrap());
    solution
}

fn last(solution: &Solution, node: NodeId) -> f64 {
    *solution.temperature(node).unwrap().last().unwrap()
}

fn gr(area: &str) -> Path {
    Path::radiation(quantity(area))
}

#[test]
fn a_node_that_radiates_to_absolute_zero_cools_as_the_cube_root() {
    // T^-3 = T0^-3 + 3 sigma Gr t / C
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(1000.0));
    let space = b.boundary("space", Temperature(0.0));
    b.conductor("glow", ConductorKind::Radiation, (ball.into(), space.into()), gr("0.05 m^2"));
    let system = system(b);
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let solution = run(&system, 3600.0, tolerance);
        for (t, found) in solution.times().iter().zip(solution.temperature(ball).unwrap()) {
            let exact = (1e-9 + 3.0 * SIGMA * 0.05 * t / 500.0).powf(-1.0 / 3.0);
            assert!(
                (found - exact).abs() < 10.0 * tolerance,
                "{t}: {found} {exact} at {tolerance}"
            );
        }
    }
}

#[test]
fn a_massless_shield_halves_radiation() {
    // equal exchange areas in series: T_shield^4 is the mean of the fourth powers
    let mut b = NetworkBuilder::new();
    let hot = b.boundary("hot", Temperature(800.0));
    let cold = b.boundary("cold", Temperature(300.0));
    let shield = b.massless("shield");
    b.conductor("a", ConductorKind::Radiation, (hot.into(), shield.into()), gr("0.1 m^2"));
    b.conductor("b", ConductorKind::Radiation, (shield.into(), cold.into()), gr("0.1 m^2"));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let exact = (0.5 * (800.0_f64.powi(4) + 300.0_f64.powi(4))).powf(0.25);
    assert!((steady.temperatures[shield.index()] - exact).abs() < 1e-9);
    let heat = 0.5 * 0.1 * SIGMA * (800.0_f64.powi(4) - 300.0_f64.powi(4));
    assert!((steady.boundary_heat[0] / heat - 1.0).abs() < 1e-12);
}

#[test]
fn a_massless_junction_with_radiation_follows_a_node_over_time() {
    // body -(2 W/K)- skin -(radiation)- 300 K; reference: SciPy 1.17 Radau, rtol 1e-12, on the body
    // alone with the skin from a root to 1e-13
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(1000.0), Temperature(600.0));
    let skin = b.massless("skin");
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", body, skin, Conductance(2.0));
    b.conductor("glow", ConductorKind::Radiation, (skin.into(), room.into()), gr("0.1 m^2"));
    let system = system(b);
    assert_eq!(system.algebraic(), [skin]);
    let solution = run(&system, 1000.0, 1e-7);
    let (body, skin) = (last(&solution, body), last(&solution, skin));
    // the balance of the skin holds at the end
    let through = 2.0 * (body - skin);
    let away = 0.1 * SIGMA * (skin.powi(4) - 300.0_f64.powi(4));
    assert!((through - away).abs() < 1e-6, "{through} {away}");
    let coarse = run(&system, 1000.0, 1e-5);
    assert!((last(&coarse, solution.recorded()[0]) - body).abs() < 1e-4);
}

#[test]
fn a_stream_warms_cell_by_cell() {
    // each cell: mcp (T_in - T) + G (T_wall - T) = 0
    let mut b = NetworkBuilder::new();
    let (inlet, wall) =
        (b.boundary("inlet", Temperature(290.0)), b.boundary("wall", Temperature(350.0)));
    let mut upstream: End = inlet.into();
    let mut cells = Vec::new();
    for i in 0..5 {
        let cell = if i % 2 == 0 {
            b.massless(&format!("cell{i}"))
        } else {
            b.node(&format!("cell{i}"), HeatCapacity(10.0), Temperature(300.0))
        };
        let rate = Path::stream(quantity("20 W/K"));
        b.conductor(&format!("flow{i}"), ConductorKind::Advection, (upstream, cell.into()), rate);
        b.convection(&format!("film{i}"), wall, cell, Conductance(5.0));
        upstream = cell.into();
        cells.push(cell);
    }
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let solution = run(&system, 200.0, 1e-7);
    let mut exact = 290.0;
    for cell in cells {
        exact = (20.0 * exact + 5.0 * 350.0) / 25.0;
        assert!((steady.temperatures[cell.index()] - exact).abs() < 1e-10);
        assert!((last(&solution, cell) - exact).abs() < 1e-6);
    }
    assert!(steady.imbalance().abs() < 1e-9 * steady.turned_over());
}

#[test]
fn a_capacity_that_grows_with_temperature_takes_the_heat_it_should() {
    // 100 W for 1000 s into C = 200 (1 + 1e-3 (T - 300)): H = 200 (x + 0.5e-3 x^2) = 1e5
    let mut b = NetworkBuilder::new();
    let text = "200 [J/K] * (1 + 1e-3 [1/K] * (T - absolute(300 [K])))";
    let capacity = b.expression_in(Context::Own, text, None).unwrap();
    let block = b.node("block", capacity, Temperature(300.0));
    b.source("heater", block, HeatFlow(100.0));
    let system = system(b);
    let solution = run(&system, 1000.0, 1e-5);
    let rise = (-1.0 + (1.0 + 2e-3 * 500.0_f64).sqrt()) / 1e-3;
    assert!(
        (last(&solution, block) - 300.0 - rise).abs() < 1e-4,
        "{} {rise}",
        last(&solution, block) - 300.0
    );
    assert!((solution.ledger().stored[0] - 1e5).abs() < 1e-4);
}

#[test]
fn an_island_comes_to_rest_where_its_energy_leads() {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(100.0), Temperature(400.0));
    let c = b.node("c", HeatCapacity(300.0), Temperature(300.0));
    b.resistor("joint", a, c, Conductance(3.0));
    b.conductor("glow", ConductorKind::Radiation, (a.into(), c.into()), gr("0.01 m^2"));
    let system = system(b);
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    assert!(
        (steady.temperatures[0] - 325.0).abs() < 1e-9
            && (steady.temperatures[1] - 325.0).abs() < 1e-9
    );
    assert_eq!(steady.adiabatic, [a, c]);
}

#[test]
fn a_conductance_that_depends_on_another_node_enters_the_jacobian() {
    // the valve opens with the temperature of the sensor: G = 1 + 0.1 (T_sensor - 300)
    let mut b = NetworkBuilder::new();
    let hot = b.node("hot", HeatCapacity(200.0), Temperature(300.0));
    let sensor = b.node("sensor", HeatCapacity(20.0), Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    b.source("heater", hot, HeatFlow(100.0));
    b.resistor("wire", hot, sensor, Conductance(1.0));
    let text = "1 [W/K] + 0.1 [W/K^2] * (sensor.T - absolute(300 [K]))";
    let valve = b.expression_in(Context::Link, text, None).unwrap();
    b.resistor("valve", hot, room, Path::conductance(valve));
    let system = system(b);
    assert!(!system.is_symmetric());
    // sensor = hot in steady state: (1 + 0.1 x) x = 100
    let rise = (-1.0 + (1.0 + 40.0_f64).sqrt()) / 0.2;
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    assert!((steady.temperatures[0] - 300.0 - rise).abs() < 1e-9);
    assert!((last(&run(&system, 5000.0, 1e-6), hot) - 300.0 - rise).abs() < 1e-5);
}
