//! Resistance to the digits promised, junctions as ports, modes of large networks.

use crate::common;

use common::{assembled, chain, near};
use lptn_analysis::RunAnalysis;
use lptn_network::{
    Conductance, HeatCapacity, HeatFlow, NetworkBuilder, NodeId, Temperature, Time,
};
use lptn_reduce::{NortonEquivalent, ReduceError, Reduction, ReductionOptions, StepResponse, port};
use lptn_solve::Transient;

/// A sum with twice the digits (M. Knuth's two-sum).
fn exact_sum(values: impl Iterator<Item = f64>) -> f64 {
    let (mut high, mut low) = (0.0, 0.0);
    for x in values {
        let sum: f64 = high + x;
        let part = sum - high;
        low += (high - (sum - part)) + (x - part);
        high = sum;
    }
    high + low
}

/// Conductances over `decades`, in an order without pattern.
fn spread(n: usize, decades: f64) -> Vec<f64> {
    let place = |i: usize| (i * 7919 % n) as f64 / n as f64;
    (0..n).map(|i| 10_f64.powf(decades * (place(i) - 0.5)) * 1.234_567).collect()
}

/// A chain's port resistance is the sum of its resistances, whatever the capacities.
#[test]
fn resistance_is_right_to_1e_12_over_three_decades() {
    for n in [2, 10, 30, 31, 200, 3000] {
        let conductance = spread(n, 3.0);
        let (system, nodes) = chain(&vec![1.0; n], &conductance);
        let resistance = NortonEquivalent::new(&system, nodes[n - 1]).unwrap().resistance;
        near(resistance, exact_sum(conductance.iter().map(|g| 1.0 / g)), 1e-12);
    }
}

/// A weak path to ground behind strong ones: rounding on the diagonal alone would cost five digits
/// here.
#[test]
fn a_weak_ground_is_seen_through_strong_paths() {
    for (strong, tolerance) in [(1e3, 1e-12), (1e6, 1e-12), (1e9, 1e-10)] {
        let mut conductance = vec![strong / 3.0; 500];
        conductance[0] = 1.0 / 3.0;
        let (system, nodes) = chain(&vec![1.0; 500], &conductance);
        let resistance = NortonEquivalent::new(&system, nodes[499]).unwrap().resistance;
        near(resistance, 3.0 + 499.0 * 3.0 / strong, tolerance);
    }
}

/// A mesh: paths between nodes, 7 for the boundary, with conductances in W/K.
type Mesh = [(usize, usize, f64); 14];

/// Meshes with conductances from 1 W/K to 9e2, 6e5, 2e8 and 9e11 W/K; the resistance at node 0 by
/// Gauss elimination in fractions (Python), and the condition number of G (numpy).
#[rustfmt::skip]
const MESHES: [(Mesh, f64, f64); 4] = [
    (
        [
            (1, 0, 9.0), (2, 1, 800.0), (3, 2, 200.0), (4, 0, 80.0), (5, 4, 4.0), (6, 5, 800.0), (6, 4, 80.0),
            (5, 1, 400.0), (1, 4, 700.0), (0, 5, 2.0), (6, 4, 10.0), (6, 0, 50.0), (7, 6, 1.0), (7, 5, 900.0),
        ],
        112_689_622_483.0 / 11_842_780_415_070.0,
        55.0,
    ),
    (
        [
            (1, 0, 6e5), (2, 0, 80.0), (3, 2, 10.0), (4, 0, 6e3), (5, 1, 7e4), (6, 0, 4.0), (5, 1, 700.0),
            (1, 3, 3.0), (1, 4, 80.0), (1, 0, 10.0), (6, 1, 30.0), (2, 6, 4e4), (7, 6, 1.0), (7, 5, 2.0),
        ],
        0.334_291_870_178_007_43, // 123014328367820605/367984804124361681
        2.9e6,
    ),
    (
        [
            (1, 0, 3e6), (2, 0, 2e8), (3, 0, 6.0), (4, 1, 10.0), (5, 3, 70.0), (6, 1, 2e8), (3, 0, 2e3),
            (5, 6, 1e6), (0, 1, 1e8), (6, 1, 5e6), (1, 4, 2e4), (4, 5, 30.0), (7, 6, 1.0), (7, 5, 2.0),
        ],
        0.333_333_792_319_371_7, // 732113926661683684440522143/2196338755718577938568490210
        1.2e9,
    ),
    (
        [
            (1, 0, 9e7), (2, 1, 9e9), (3, 0, 3e8), (4, 3, 30.0), (5, 3, 500.0), (6, 0, 9e11), (5, 0, 7e7),
            (5, 6, 3e9), (0, 4, 2.0), (0, 1, 4e9), (0, 3, 6e7), (4, 1, 9e3), (7, 6, 1.0), (7, 5, 2.0),
        ],
        // 918680191341073631256929423701195783977/2756040572817334690610723569661525013500
        0.333_333_333_479_181,
        4.2e12,
    ),
];

/// To 1e-12 up to a spread of 10^3, to 100 eps cond(G) beyond; refinement by links does better:
/// 1e-14 throughout.
#[test]
fn the_resistance_of_a_mesh_is_that_of_exact_fractions() {
    let zero = Temperature::celsius(0.0);
    for (mesh, expected, condition) in MESHES {
        let mut b = NetworkBuilder::new();
        let nodes: Vec<NodeId> =
            (0..7).map(|i| b.node(&format!("n{i}"), HeatCapacity(1.0), zero)).collect();
        let ground = b.boundary("ground", zero);
        for (k, &(from, to, g)) in mesh.iter().enumerate() {
            let end =
                nodes.get(from).map_or_else(|| ground.into(), |&n| lptn_network::End::Node(n));
            b.resistor(&format!("g{k}"), end, nodes[to], Conductance(g));
        }
        let resistance = NortonEquivalent::new(&assembled(b), nodes[0]).unwrap().resistance;
        near(resistance, expected, 1e-12_f64.min(100.0 * f64::EPSILON * condition));
        near(resistance, expected, 1e-14);
    }
}

/// The same with every second node massless: eliminated, and a port itself.
#[test]
fn junctions_can_be_ports() {
    let n = 21;
    let conductance = spread(n, 3.0);
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let end = b.boundary("end", zero);
    let mut nodes: Vec<NodeId> = Vec::new();
    for i in 0..n {
        let name = format!("n{i}");
        nodes.push(if i % 2 == 0 {
            b.massless(&name)
        } else {
            b.node(&name, HeatCapacity(10.0), zero)
        });
        let name = format!("g{i}");
        match i {
            0 => b.resistor(&name, end, nodes[0], Conductance(conductance[0])),
            _ => b.resistor(&name, nodes[i - 1], nodes[i], Conductance(conductance[i])),
        };
    }
    b.source("heat", nodes[n - 1], HeatFlow(3.0));
    let system = assembled(b);
    let run = RunAnalysis::until(Time(60.0));
    let reduction = Reduction::new(
        &system,
        nodes[n - 1],
        &ReductionOptions { run: Some(run), ..Default::default() },
    )
    .unwrap();
    let exact = exact_sum(conductance.iter().map(|g| 1.0 / g));
    near(reduction.norton.resistance, exact, 1e-12);
    let dynamics = reduction.dynamics.unwrap();
    near(dynamics.step.as_ref().unwrap().direct, 1.0 / conductance[n - 1], 1e-14);
    near(dynamics.pairs[0].capacity, 100.0, 1e-14);
    let moment: f64 = (0..n)
        .filter(|i| i % 2 == 1)
        .map(|i| 10.0 * exact_sum(conductance[..=i].iter().map(|g| 1.0 / g)).powi(2))
        .sum();
    near(dynamics.pairs[1].capacity, moment / (exact * exact), 1e-12);
    // the curve begins with what comes at once, and is what the integrator finds
    assert!(dynamics.step.as_ref().unwrap().residual < 1e-9 * exact);
    let solution = Transient::until(Time(60.0)).tolerance(1e-8).solve(&system).unwrap();
    for (time, t) in solution.times().iter().zip(solution.temperature(nodes[n - 1]).unwrap()) {
        assert!(
            (t - 273.15 - 3.0 * dynamics.step.as_ref().unwrap().value(*time)).abs() < 1e-6,
            "{time}"
        );
    }
}

/// Heat between two boundaries: the weights are the divider's, and a port on it has no capacity
/// behind it.
#[test]
fn boundary_weights_are_those_of_a_divider() {
    let mut b = NetworkBuilder::new();
    let (hot, cold) =
        (b.boundary("hot", Temperature(400.0)), b.boundary("cold", Temperature(300.0)));
    let j = b.massless("j");
    b.resistor("a", hot, j, Conductance(3.0));
    b.resistor("b", j, cold, Conductance(1.0));
    let far = b.node("far", HeatCapacity(5.0), Temperature(300.0));
    b.resistor("c", far, cold, Conductance(1.0));
    let system = assembled(b);
    let reduction = Reduction::new(&system, j, &ReductionOptions::default()).unwrap();
    assert_eq!(reduction.norton.boundary_weights, [0.75, 0.25]);
    near(reduction.inputs.reference, 375.0, 1e-15);
    assert!(reduction.dynamics.is_none());
}

/// A uniform chain of 400 cells: rates `(4 G/C) sin^2((2k-1) pi / (4n+2))` (discrete sine
/// transform).
#[test]
fn the_slowest_time_constant_of_a_long_chain() {
    let n = 400;
    let (system, nodes) = chain(&vec![2.0; n], &vec![5.0; n]);
    let norton = NortonEquivalent::new(&system, nodes[n - 1]).unwrap();
    let step = StepResponse::new(&system, &norton).unwrap().unwrap();
    let rate = |k: f64| {
        4.0 * 5.0 / 2.0
            * ((2.0 * k - 1.0) * std::f64::consts::PI / (4.0 * n as f64 + 2.0)).sin().powi(2)
    };
    for k in 1..8 {
        near(step.terms[k - 1].tau, 1.0 / rate(k as f64), 1e-11);
    }
    assert!(step.slowest().error < 1e-12 * step.slowest().tau);
    // the first cell alone takes the heat at first: z = t / C
    assert!((step.value(1e-4) - 0.5e-4).abs() < 1e-6 * norton.resistance, "{}", step.residual);
}

/// Two equal branches at a common node: their difference is a mode that the port does not see.
#[test]
fn a_mode_that_the_port_does_not_see_is_not_its_time_constant() {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let end = b.boundary("end", zero);
    let middle = b.node("middle", HeatCapacity(1.0), zero);
    b.resistor("ground", middle, end, Conductance(1.0));
    for name in ["left", "right"] {
        let node = b.node(name, HeatCapacity(1000.0), zero);
        b.resistor(&format!("to_{name}"), middle, node, Conductance(1e-3));
    }
    // odd mode: 1000 J/K over 1e-3 W/K = 1e6 s; even: 2000 J/K over its 1/(1 + 1/2e-3) W/K =
    // 1.002e6 s and fast
    let system = assembled(b);
    let norton = NortonEquivalent::new(&system, middle).unwrap();
    let step = StepResponse::new(&system, &norton).unwrap().unwrap();
    assert_eq!(step.terms.len(), 2, "{step:?}");
    assert!(step.terms.iter().all(|term| (term.tau - 1e6).abs() > 100.0));
}

/// A port of a millionth of a joule per kelvin: time constants nine decades apart. To first order
/// in c the fast one is c R_int with all of R_int.
#[test]
fn time_constants_may_lie_far_apart() {
    let (system, [port, _]) = common::two_nodes([1e-6, 1e3], 0.1, 0.3, 1.0);
    let norton = NortonEquivalent::new(&system, port).unwrap();
    let step = StepResponse::new(&system, &norton).unwrap().unwrap();
    near(step.terms[0].tau, 300.0 + 0.3e-6, 1e-12);
    near(step.terms[0].resistance, 0.3, 1e-8);
    near(step.terms[1].tau, 1e-7, 1e-5);
    near(step.terms[1].resistance, 0.1, 1e-5);
    assert!(step.residual < 1e-6 * norton.resistance);
}

/// Modes by Lanczos iteration and CVODES have nothing in common but the network.
#[test]
fn the_step_response_of_a_grid_is_what_the_integrator_finds() {
    let n = 24;
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let edge = b.boundary("edge", zero);
    let cells: Vec<NodeId> = (0..n * n)
        .map(|k| b.node(&format!("c{k}"), HeatCapacity(1.0 + (k % 3) as f64), zero))
        .collect();
    let g = spread(2 * n * n, 2.0);
    for k in 0..n * n {
        if k % n + 1 < n {
            b.resistor(&format!("x{k}"), cells[k], cells[k + 1], Conductance(g[k]));
        }
        let below =
            cells.get(k + n).map_or_else(|| edge.into(), |&cell| lptn_network::End::Node(cell));
        b.resistor(&format!("y{k}"), cells[k], below, Conductance(g[n * n + k]));
    }
    let port = cells[7 * n + 5];
    b.source("heat", port, HeatFlow(1.0));
    let system = assembled(b);
    let norton = NortonEquivalent::new(&system, port).unwrap();
    let step = StepResponse::new(&system, &norton).unwrap().unwrap();
    assert!(step.terms.len() < n * n / 2, "{}", step.terms.len());
    let solution =
        Transient::until(Time(3000.0)).tolerance(1e-9).record(&[port]).solve(&system).unwrap();
    for (&time, t) in solution.times().iter().zip(solution.temperature(port).unwrap()) {
        assert!(
            (t - 273.15 - step.value(time)).abs() < 2e-8,
            "{time} {}",
            t - 273.15 - step.value(time)
        );
    }
}

#[test]
fn wrong_ports_are_named() {
    let (system, _) = chain(&[1.0, 1.0], &[1.0, 1.0]);
    let network = system.network();
    let error = port(network, "m1").unwrap_err();
    assert_eq!(
        (error.code(), error.help().as_deref()),
        ("reduce::unknown_port", Some("did you mean `n1`?"))
    );
    assert_eq!(port(network, "g1").unwrap_err().code(), "reduce::unknown_port");
    assert_eq!(port(network, "end").unwrap_err().code(), "reduce::boundary_port");
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    let (x, y) = (b.node("x", HeatCapacity(1.0), zero), b.node("y", HeatCapacity(1.0), zero));
    b.resistor("r", x, y, Conductance(1.0));
    let error = NortonEquivalent::new(&assembled(b), x).unwrap_err();
    assert!(matches!(&error, ReduceError::NoGround { names } if names == &["x", "y"]));
    assert_eq!(error.to_string(), "no path leads to a boundary from `x` and `y`");
}
