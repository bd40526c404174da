//! Derivatives of the rates of a simulation: Jacobians against formulas by hand, sums that are zero,
//! transposes, and differences of rates and of runs.
//!
//! A network in thermal equilibrium with constant conductances has `C_i dT_i/dt = sum G_ij (T_j -
//! T_i)`, so that `J_ij = G_ij / C_i`. Radiation at T has the slope `4 sigma eps A T^3`.

use lptn_analysis::{SavedSimulation, Simulation, SimulationError};
use lptn_network::{
    Acts, Conductance, ConductorKind, Context, End, HeatCapacity, HeatFlow, Input,
    IntegratorChoice, Network, NetworkBuilder, NodeId, OutputTimes, Path, RunSettings, Temperature,
    Thermostat, Time,
};
use lptn_solve::{Direction, DirectionError, DirectionPart, RateSlopes, Rates};

/// The constant of Stefan and Boltzmann in W/(m^2 K^4): CODATA 2018.
const SIGMA: f64 = 5.670_374_419e-8;

fn settings() -> RunSettings {
    RunSettings {
        stop: 1000.0,
        output: OutputTimes::Every(100.0),
        integrator: IntegratorChoice::Auto,
        tolerance: 1e-8,
        ..RunSettings::cycle(None, 1000.0)
    }
}

pub(crate) fn simulation(network: &Network) -> Simulation {
    Simulation::new(network, &settings()).unwrap()
}

fn path(b: &NetworkBuilder, text: &str) -> Input {
    b.expression_in(Context::Link, text, None).unwrap().into()
}

pub(crate) fn quantity(text: &str) -> Input {
    lptn_units::parse_quantity(text, None).unwrap().into()
}

fn wall(b: &mut NetworkBuilder, name: &str, ends: [End; 2], area: f64) {
    let area = quantity(&format!("{area} m^2"));
    b.conductor(name, ConductorKind::Radiation, (ends[0], ends[1]), Path::radiation(area));
}

/// The Jacobian in 1/s, dense.
pub(crate) fn dense(slopes: &RateSlopes) -> Vec<Vec<f64>> {
    let count = slopes.jacobian().states.len();
    let mut dense = vec![vec![0.0; count]; count];
    for (value, row, column) in slopes.jacobian().entries() {
        dense[row][column] += value;
    }
    dense
}

fn unit(count: usize, at: usize) -> Vec<f64> {
    (0..count).map(|i| f64::from(u8::from(i == at))).collect()
}

/// The derivatives by one input at constant states.
pub(crate) fn by_input(slopes: &RateSlopes, states: usize, (inputs, at): (usize, usize)) -> Rates {
    let direction = Direction { states: vec![0.0; states], inputs: unit(inputs, at) };
    slopes.along(&direction).unwrap()
}

#[track_caller]
pub(crate) fn assert_near(found: f64, expected: f64, relative: f64) {
    let off = (found - expected).abs();
    assert!(off <= relative * expected.abs().max(1e-300), "{found}, not {expected}");
}

/// Two bodies of 200 and 500 J/K at 350 and 300 K, joined by G = 3 W/K, the second to air at 290 K
/// by 2 W/K; a heater P in the first.
fn two_nodes() -> Network {
    let mut b = NetworkBuilder::new();
    b.parameter("P", HeatFlow(40.0));
    b.parameter("G", Conductance(3.0));
    b.parameter("C", HeatCapacity(200.0));
    b.parameter("T_0", Temperature(350.0));
    let c = b.expression("C", None).unwrap();
    let start = b.expression("T_0", None).unwrap();
    let first = b.node("first", c, start);
    let second = b.node("second", HeatCapacity(500.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    let g = path(&b, "G");
    b.resistor("joint", first, second, Path::conductance(g));
    b.resistor("skin", second, air, Conductance(2.0));
    let power = b.expression_in(Context::Source, "P", None).unwrap();
    b.source("heater", first, power);
    b.build().unwrap()
}

#[test]
fn two_nodes_have_the_jacobian_by_hand() {
    let slopes = simulation(&two_nodes()).slopes(&["P", "G", "C", "T_0"]).unwrap();
    let expected = [[-3.0 / 200.0, 3.0 / 200.0], [3.0 / 500.0, -5.0 / 500.0]];
    for (found, expected) in dense(&slopes).iter().flatten().zip(expected.iter().flatten()) {
        assert_near(*found, *expected, 1e-14);
    }
    let heat = 40.0 - 3.0 * 50.0;
    let by_inputs = [
        [1.0 / 200.0, 0.0],
        [-50.0 / 200.0, 50.0 / 500.0],
        [-heat / (200.0 * 200.0), 0.0],
        [0.0, 0.0], // a start that is over
    ];
    for (at, expected) in by_inputs.iter().enumerate() {
        let found = by_input(&slopes, 2, (4, at));
        for (found, expected) in found.states.iter().zip(expected) {
            assert_near(*found, *expected, 1e-13);
        }
        assert!(found.nodes.iter().all(|node| node.abs() < 1e-300), "held states do not move");
    }
}

#[test]
fn radiation_has_the_slope_of_the_fourth_power() {
    let mut b = NetworkBuilder::new();
    b.parameter("T_wall", Temperature(300.0));
    let body = b.node("body", HeatCapacity(150.0), Temperature(800.0));
    let given = b.expression("T_wall", None).unwrap();
    let walls = b.boundary("walls", given);
    wall(&mut b, "glow", [body.into(), walls.into()], 0.2);
    let slopes = simulation(&b.build().unwrap()).slopes(&["T_wall"]).unwrap();
    let of = |t: f64| 4.0 * SIGMA * 0.2 * t.powi(3) / 150.0;
    assert_near(dense(&slopes)[0][0], -of(800.0), 1e-12);
    assert_near(by_input(&slopes, 1, (1, 0)).states[0], of(300.0), 1e-12);
}

/// A massless skin between a body and walls that it radiates to, with its temperature in K by
/// bisection of its balance `G (T - t) + P = sigma A (t^4 - W^4)`.
#[test]
fn a_massless_node_that_radiates_is_eliminated() {
    let (g, area, capacity, hot, cold) = (5.0, 0.3, 400.0, 700.0, 300.0_f64);
    let mut b = NetworkBuilder::new();
    b.parameter("P", HeatFlow(60.0));
    let body = b.node("body", HeatCapacity(capacity), Temperature(hot));
    let skin = b.massless("skin");
    let walls = b.boundary("walls", Temperature(cold));
    b.resistor("inside", body, skin, Conductance(g));
    wall(&mut b, "glow", [skin.into(), walls.into()], area);
    let power = b.expression_in(Context::Source, "P", None).unwrap();
    b.source("sun", skin, power);
    let slopes = simulation(&b.build().unwrap()).slopes(&["P"]).unwrap();
    let (mut low, mut high) = (cold, 2.0 * hot);
    for _ in 0..200 {
        let t: f64 = 0.5 * (low + high);
        let left = g * (hot - t) + 60.0 - SIGMA * area * (t.powi(4) - cold.powi(4));
        (low, high) = if left > 0.0 { (t, high) } else { (low, t) };
    }
    let out = 4.0 * SIGMA * area * low.powi(3);
    let follows = g / (g + out);
    assert_eq!(slopes.jacobian().values.len(), 1);
    assert_near(dense(&slopes)[0][0], -g * out / (g + out) / capacity, 1e-9);
    let along = slopes.along(&Direction { states: vec![1.0], inputs: vec![0.0] }).unwrap();
    assert_near(along.nodes[skin.index()], follows, 1e-9);
    assert_near(along.nodes[body.index()], 1.0, 1e-15);
    let heated = by_input(&slopes, 1, (1, 0));
    assert_near(heated.nodes[skin.index()], 1.0 / (g + out), 1e-9);
    assert_near(heated.states[0], follows / capacity, 1e-9);
}

/// A junction with constant conductances of 2 and 6 W/K is eliminated exactly: 1.5 W/K.
#[test]
fn a_junction_is_its_series_and_follows_by_shares() {
    let mut b = NetworkBuilder::new();
    b.parameter("P", HeatFlow(8.0));
    let a = b.node("a", HeatCapacity(100.0), Temperature(320.0));
    let c = b.node("c", HeatCapacity(50.0), Temperature(300.0));
    let m = b.massless("m");
    b.resistor("am", a, m, Conductance(2.0));
    b.resistor("mc", m, c, Conductance(6.0));
    let power = b.expression_in(Context::Source, "P", None).unwrap();
    b.source("heat", m, power);
    let slopes = simulation(&b.build().unwrap()).slopes(&["P"]).unwrap();
    let expected = [-1.5 / 100.0, 1.5 / 100.0, 1.5 / 50.0, -1.5 / 50.0];
    for (found, expected) in dense(&slopes).iter().flatten().zip(expected) {
        assert_near(*found, expected, 1e-14);
    }
    let heated = by_input(&slopes, 2, (1, 0));
    assert_near(heated.nodes[m.index()], 1.0 / 8.0, 1e-14);
    assert_near(heated.states[0], 0.25 / 100.0, 1e-14);
    assert_near(heated.states[1], 0.75 / 50.0, 1e-14);
    let only = Rates { states: vec![0.0; 2], nodes: unit(3, m.index()) };
    let against = slopes.against(&only).unwrap();
    assert_near(against.states[0], 0.25, 1e-14);
    assert_near(against.states[1], 0.75, 1e-14);
    assert_near(against.inputs[0], 1.0 / 8.0, 1e-14);
}

/// A bit of everything: a film over temperature, radiation, streams in a loop, a massless skin, a
/// thermostat, a signal; closed to the outside but for its heater.
fn everything(outside: bool) -> Network {
    let mut b = NetworkBuilder::new();
    b.parameter("scale", HeatFlow(30.0));
    b.parameter("G", Conductance(4.0));
    let drive = b.expression("1.5 + 0.1 * sin(t / 100 [s])", None).unwrap();
    b.signal_expression("drive", drive);
    let fan = b.control("fan");
    let nodes: Vec<NodeId> = [("a", 380.0), ("b", 350.0), ("c", 310.0), ("d", 290.0)]
        .map(|(name, t)| b.node(name, HeatCapacity(100.0 + t), Temperature(t)))
        .to_vec();
    let [a, n, c, d] = nodes[..] else { unreachable!("four of them") };
    let skins = ["skin", "rim"].map(|name| b.massless(name));
    let film = path(&b, "5 [W/(m^2 K)] * (1 + fan) * (abs(dT) / 1 [K])^0.25");
    b.conductor(
        "film",
        ConductorKind::Convection,
        (a.into(), n.into()),
        Path::film(film, quantity("0.3 m^2")),
    );
    let g = path(&b, "G * (1 + (T_mean - 0 [degC]) / 500 [K])");
    b.resistor("inside", c, skins[0], Path::conductance(g));
    wall(&mut b, "rims", [skins[0].into(), skins[1].into()], 0.7);
    wall(&mut b, "glow", [skins[1].into(), d.into()], 0.4);
    let [one, two, three] = [(a, n), (n, c), (c, a)];
    for (name, (from, to)) in [("one", one), ("two", two), ("three", three)] {
        b.conductor(
            name,
            ConductorKind::Advection,
            (from.into(), to.into()),
            Path::stream(quantity("2 W/K")),
        );
    }
    let power = b.expression_in(Context::Source, "scale * drive", None).unwrap();
    b.source("heater", d, power);
    if outside {
        let air = b.boundary("air", Temperature(290.0));
        let skin = path(&b, "G * (0.2 + fan)");
        b.resistor("out", d, air, Path::conductance(skin));
    }
    let thresholds = [340.0, 330.0].map(|t| Temperature(t).into());
    let [on, off] = thresholds;
    let acts = Acts::Cooling;
    let min_dwell = Time(0.0).into();
    b.thermostat(fan, Thermostat { sense: a.into(), acts, on, off, start: true, min_dwell });
    b.build().unwrap()
}

const INPUTS: [&str; 3] = ["drive", "G", "scale"];

/// Heat that leaves one node enters another, at every temperature.
#[test]
fn the_columns_of_a_closed_network_sum_to_zero_with_capacities() {
    let simulation = simulation(&everything(false));
    let slopes = simulation.slopes(&[]).unwrap();
    let places: Vec<_> =
        slopes.jacobian().entries().map(|(_, row, column)| (column, row)).collect();
    assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "column by column, rows ascending");
    let dense = dense(&slopes);
    let network = simulation.network();
    let capacity = |row: usize| network.capacity(simulation.states()[row]);
    for column in 0..dense.len() {
        let parts: Vec<f64> =
            (0..dense.len()).map(|row| capacity(row) * dense[row][column]).collect();
        let (sum, size) = (parts.iter().sum::<f64>(), parts.iter().map(|v| v.abs()).sum::<f64>());
        assert!(size > 1.0 && sum.abs() < 1e-11 * size, "{parts:?}");
    }
}

#[test]
fn the_derivative_against_a_direction_is_the_transpose() {
    let mut simulation = simulation(&everything(true));
    simulation.advance(Time(20.0), &[]).unwrap();
    let slopes = simulation.slopes(&INPUTS).unwrap();
    let number = |i: usize| (1.7 * i as f64 + 0.3).sin();
    for shift in 0..5 {
        let of =
            |count: usize, first: usize| (0..count).map(|i| number(i + first + shift)).collect();
        let direction = Direction { states: of(4, 0), inputs: of(3, 10) };
        let weights = Rates { states: of(4, 20), nodes: of(6, 30) };
        let (along, against) =
            (slopes.along(&direction).unwrap(), slopes.against(&weights).unwrap());
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let one = product(&along.states, &weights.states) + product(&along.nodes, &weights.nodes);
        let other = product(&direction.states, &against.states)
            + product(&direction.inputs, &against.inputs);
        assert_near(one, other, 1e-11);
    }
}

/// Rates of the same simulation with states and inputs that are moved by `by` times a direction.
fn moved(simulation: &Simulation, direction: &Direction, by: f64) -> Rates {
    let mut other = simulation.clone();
    let mut saved = other.save();
    saved.carried.iter_mut().zip(&direction.states).for_each(|(y, dy)| *y += by * dy);
    other.restore(&saved).unwrap();
    let own = [1.5 + 0.1 * (simulation.time() / 100.0).sin(), 4.0, 30.0];
    for ((name, own), change) in INPUTS.iter().zip(own).zip(&direction.inputs) {
        other.set(name, own + by * change).unwrap();
    }
    other.rates().unwrap()
}

#[test]
fn directions_agree_with_differences_of_rates() {
    let mut simulation = simulation(&everything(true));
    for time in [20.0, 200.0] {
        simulation.advance(Time(time), &[]).unwrap();
        let slopes = simulation.slopes(&INPUTS).unwrap();
        for at in 0..7 {
            let direction =
                Direction { states: unit(7, at)[..4].to_vec(), inputs: unit(7, at)[4..].to_vec() };
            let exact = slopes.along(&direction).unwrap();
            let by = 1e-3;
            let (below, above) =
                (moved(&simulation, &direction, -by), moved(&simulation, &direction, by));
            let all = |rates: &Rates| [&rates.states[..], &rates.nodes[..]].concat();
            let sides = all(&below).into_iter().zip(all(&above));
            for (exact, (below, above)) in all(&exact).iter().zip(sides) {
                let found = (above - below) / (2.0 * by);
                assert!(
                    (found - exact).abs() < 1e-7 + 1e-6 * exact.abs(),
                    "{at}: {exact}, {found}"
                );
            }
        }
    }
}

/// Without inputs that change, `d2T/dt2 = J dT/dt`: against second differences of rows of a run.
#[test]
fn the_jacobian_bends_a_run() {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(200.0), Temperature(600.0));
    let c = b.node("c", HeatCapacity(300.0), Temperature(300.0));
    let skin = b.massless("skin");
    b.resistor("inside", a, skin, Conductance(3.0));
    wall(&mut b, "glow", [skin.into(), c.into()], 0.2);
    let mut simulation = simulation(&b.build().unwrap());
    simulation.advance(Time(10.0), &[]).unwrap();
    let rates = simulation.rates().unwrap();
    let bent = simulation.slopes(&[]).unwrap();
    let bent = bent.along(&Direction { states: rates.states, inputs: vec![] }).unwrap();
    let mut start = self::simulation(simulation.network());
    let run = start.advance(Time(20.0), &[8.0, 10.0, 12.0]).unwrap();
    let row = |node: NodeId| run.temperature(node).unwrap();
    let skin_rate = (row(skin)[3] - row(skin)[1]) / 4.0;
    let expected = bent.nodes[skin.index()];
    assert!((skin_rate - expected).abs() < 2e-3 * expected.abs(), "{skin_rate} {expected}");
    for (node, bent) in [a, c].into_iter().zip(bent.states) {
        let rows = row(node);
        let found = (rows[1] - 2.0 * rows[2] + rows[3]) / 4.0;
        assert!((found - bent).abs() < 2e-3 * bent.abs(), "{found} {bent}");
    }
}

#[test]
fn what_has_no_direction_is_refused() {
    let simulation = simulation(&two_nodes());
    assert!(matches!(simulation.slopes(&["first"]), Err(SimulationError::NotAnInput(_))));
    assert!(matches!(simulation.slopes(&["Q"]), Err(SimulationError::Unknown(_))));
    let twice = simulation.slopes(&["P", "G", "P"]);
    assert!(matches!(twice, Err(SimulationError::Twice { name }) if name == "P"));
    let slopes = simulation.slopes(&["P"]).unwrap();
    let short = Direction { states: vec![1.0], inputs: vec![0.0] };
    let length = DirectionError::Length { of: DirectionPart::States, given: 1, needed: 2 };
    assert_eq!(slopes.along(&short), Err(length));
    let open = Direction { states: vec![0.0; 2], inputs: vec![f64::NAN] };
    let not_finite = DirectionError::NotFinite { of: DirectionPart::Inputs, position: 0 };
    assert_eq!(slopes.along(&open), Err(not_finite));
    let weights = Rates { states: vec![0.0; 2], nodes: vec![] };
    let length = DirectionError::Length { of: DirectionPart::Nodes, given: 0, needed: 2 };
    assert_eq!(slopes.against(&weights), Err(length));
}

/// A network of massless nodes has no state, and its temperatures still follow its inputs.
#[test]
fn a_network_without_state_follows_its_inputs() {
    let mut b = NetworkBuilder::new();
    b.parameter("P", HeatFlow(8.0));
    let m = b.massless("m");
    let air = b.boundary("air", Temperature(300.0));
    wall(&mut b, "glow", [m.into(), air.into()], 0.1);
    let power = b.expression_in(Context::Source, "P", None).unwrap();
    b.source("heat", m, power);
    let simulation = simulation(&b.build().unwrap());
    let slopes = simulation.slopes(&["P"]).unwrap();
    assert!(slopes.jacobian().values.is_empty());
    let hot = (300.0_f64.powi(4) + 8.0 / (SIGMA * 0.1)).powf(0.25);
    let found = by_input(&slopes, 0, (1, 0)).nodes[m.index()];
    assert_near(found, 1.0 / (4.0 * SIGMA * 0.1 * hot.powi(3)), 1e-9);
}

#[test]
fn slopes_are_sent_to_another_thread() {
    let slopes = simulation(&two_nodes()).slopes(&["P"]).unwrap();
    let found = std::thread::spawn(move || dense(&slopes)[0][0]).join().unwrap();
    assert_near(found, -3.0 / 200.0, 1e-14);
}

/// A massless node with the balance `G (T - m) + 20 W (x - x^3) = 0`, `x = (m - 300 K) / 10 K`, at T
/// = 300 K and G = 1 W/K: `x = 0` or `x = +- sqrt(1/2)`. There `dm/dT = G / (G + 1 W/K) = 1/2`.
#[test]
fn a_massless_node_with_several_solutions_keeps_its_solution() {
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(100.0), Temperature(300.0));
    let m = b.massless("m");
    b.start_at(m, Temperature(308.0));
    b.resistor("joint", body, m, Conductance(1.0));
    let x = "(kelvin(T) - 300 [K]) / (10 [K])";
    let power = format!("20 [W] * ({x} - ({x})^3)");
    let power = b.expression_in(Context::Source, &power, None).unwrap();
    b.source("bent", m, power);
    let mut simulation = simulation(&b.build().unwrap());
    for side in [-1.0, 1.0] {
        let rise = side * 10.0 * 0.5_f64.sqrt();
        let saved = SavedSimulation { stood: vec![300.0 + rise], ..simulation.save() };
        simulation.restore(&saved).unwrap();
        let rates = simulation.rates().unwrap();
        assert_near(rates.nodes[m.index()], 300.0 + rise, 1e-9);
        assert_near(rates.states[0], rise / 100.0, 1e-7);
        let slopes = simulation.slopes(&[]).unwrap();
        assert_near(dense(&slopes)[0][0], -0.5 / 100.0, 1e-7);
    }
    let foreign = SavedSimulation { stood: vec![300.0; 2], ..simulation.save() };
    assert!(matches!(simulation.restore(&foreign), Err(SimulationError::Foreign)));
}
