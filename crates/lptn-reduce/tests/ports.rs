//! Ports of networks with closed forms, and the fit of one exponential. The cases of
//! `tests/validation` are checked there.

use crate::common;

use common::{assembled, chain, near, two_nodes};
use lptn_analysis::RunAnalysis;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature, Time};
use lptn_reduce::{Bias, Reduction, ReductionOptions, fit_exponential, transfer_resistance};
use lptn_solve::{Proceed, SteadyState};

/// What the seed paper's method concludes from its fit, in the paper's own words: P = (T_f - T_i)
/// C_eq / t_RC.
#[test]
fn the_bias_follows_from_the_fit() {
    let (system, nodes) = two_nodes([1235.0, 1424.0], 1.7 / 220.6, 65.5 / 220.6, 220.6);
    let run = RunAnalysis::until(Time(1500.0)).every(Time(2.0)).within(1e-7);
    for node in nodes {
        let bias = Bias::new(&system, node, &run).unwrap().unwrap();
        let solution = run.solve(&system, &mut |_| Proceed::Continue).unwrap();
        assert_eq!(
            bias.fit,
            fit_exponential(solution.times(), &solution.temperature(node).unwrap()).unwrap()
        );
        near(bias.heat, 220.6, 1e-12);
        near(bias.capacity, 2659.0, 1e-14);
        near(bias.inferred, (bias.fit.settled - bias.fit.initial) * 2659.0 / bias.fit.tau, 1e-12);
        near(bias.relative().unwrap(), (bias.inferred - 220.6) / 220.6, 1e-10);
    }
}

/// One node is one exponential, so that what the method infers is what was put in: from 400 s to
/// 1000 s, and of the heat that the port feels, not of that behind the boundary.
#[test]
fn the_bias_of_one_node_is_none() {
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    let bed = b.boundary("bed", zero);
    let [port, other] = ["port", "other"].map(|name| b.node(name, HeatCapacity(50.0), zero));
    b.resistor("r", port, bed, Conductance(0.5));
    b.resistor("s", other, bed, Conductance(0.5));
    b.source("heat", port, HeatFlow(8.0));
    b.source("elsewhere", other, HeatFlow(1000.0));
    let run = RunAnalysis::until(Time(1000.0)).lasting(400.0, 1000.0);
    let run = run.every(Time(2.0)).within(1e-8);
    let bias = Bias::new(&assembled(b), port, &run).unwrap().unwrap();
    near(bias.length, 600.0, 1e-15);
    assert_eq!(bias.points, 301);
    near(bias.heat, 8.0, 1e-12);
    near(bias.fit.tau, 100.0, 1e-6);
    near(bias.resistance, 2.0, 1e-6);
    assert!(bias.relative().unwrap().abs() < 1e-6, "{bias:?}");
}

/// A node that cools has an exponential and no heat to compare with.
#[test]
fn where_no_heat_is_put_in_there_is_no_bias() {
    let mut b = NetworkBuilder::new();
    let bed = b.boundary("bed", Temperature(300.0));
    let port = b.node("port", HeatCapacity(50.0), Temperature(350.0));
    b.resistor("r", port, bed, Conductance(0.5));
    let run = RunAnalysis::until(Time(500.0)).every(Time(2.0)).within(1e-8);
    let bias = Bias::new(&assembled(b), port, &run).unwrap().unwrap();
    near(bias.fit.settled, 300.0, 1e-8);
    near(bias.inferred, -25.0, 1e-5);
    assert_eq!(bias.relative(), None);
}

/// A network of junctions: the weights sum to 1, and there is no C_eq.
#[test]
fn a_bridge_of_junctions_has_no_dynamics() {
    let mut b = NetworkBuilder::new();
    let (a, d) =
        (b.boundary("a", Temperature::celsius(100.0)), b.boundary("d", Temperature::celsius(0.0)));
    let (n, c) = (b.massless("b"), b.massless("c"));
    b.resistor("ab", a, n, Conductance(3.0));
    b.resistor("ac", a, c, Conductance(2.0));
    b.resistor("bd", n, d, Conductance(5.0));
    b.resistor("cd", c, d, Conductance(7.0));
    b.resistor("bc", n, c, Conductance(4.0));
    let reduction = Reduction::new(&assembled(b), n, &ReductionOptions::default()).unwrap();
    near(reduction.norton.boundary_weights.iter().sum::<f64>(), 1.0, 1e-14);
    assert!(reduction.dynamics.is_none());
}

/// All modes of a uniform chain, found from its end:
/// `1 / tau_k = 4 G / C sin^2((2k - 1) pi / (4n + 2))`, the discrete sine transform with one end
/// held and one free.
#[test]
fn the_end_of_a_chain_sees_every_mode() {
    let n = 8;
    let (system, nodes) = chain(&vec![50.0; n], &vec![4.0; n]);
    let step = Reduction::new(&system, nodes[n - 1], &ReductionOptions::default())
        .unwrap()
        .dynamics
        .unwrap()
        .step
        .unwrap();
    assert_eq!(step.terms.len(), n);
    assert!(step.residual < 1e-10, "{step:?}");
    for (k, term) in (1..).zip(&step.terms) {
        let angle = f64::from(2 * k - 1) * std::f64::consts::PI / (4 * n + 2) as f64;
        near(term.tau, 50.0 / (16.0 * angle.sin().powi(2)), 1e-10);
    }
}

/// Nodes at one boundary are each their own equivalent: P R (1 - exp(-t / (R C))).
#[test]
fn nodes_that_a_boundary_joins_do_not_see_each_other() {
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    let bed = b.boundary("bed", zero);
    let nodes: Vec<_> =
        (0..7).map(|i| b.node(&format!("n{i}"), HeatCapacity(2659.0), zero)).collect();
    for (i, &node) in nodes.iter().enumerate() {
        b.resistor(&format!("e{i}"), node, bed, Conductance(3.25));
        b.source(&format!("q{i}"), node, HeatFlow(20.0 + 30.0 * i as f64));
    }
    let options =
        ReductionOptions { run: Some(RunAnalysis::until(Time(1500.0))), ..Default::default() };
    let reduction = Reduction::new(&assembled(b), nodes[6], &options).unwrap();
    near(reduction.norton.resistance, 1.0 / 3.25, 1e-14);
    near(reduction.inputs.heat, 200.0, 1e-14);
    assert_eq!(reduction.norton.source_weights, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let dynamics = reduction.dynamics.unwrap();
    near(dynamics.step.as_ref().unwrap().slowest().tau, 2659.0 / 3.25, 1e-12);
    dynamics.pairs.iter().for_each(|pair| near(pair.capacity, 2659.0, 1e-11));
    let rise = 200.0 / 3.25 * -f64::exp_m1(-1500.0 * 3.25 / 2659.0);
    assert!((dynamics.rise.unwrap() - rise).abs() < 1e-6);
    assert!(dynamics.pairs.iter().all(|pair| pair.run.unwrap().kelvin < 1e-6));
}

/// `T_ref + R_eq Q_N` is the steady temperature of the port, by the other solver.
#[test]
fn the_port_gives_the_steady_state_of_every_network() {
    let (system, nodes) = chain(&[1.0, 3.0, 2.0, 5.0], &[0.1, 7.0, 0.3, 40.0]);
    let mut b = NetworkBuilder::new();
    let t = Temperature(300.0);
    let (hot, cold) =
        (b.boundary("hot", Temperature(350.0)), b.boundary("cold", Temperature(290.0)));
    let (x, y) = (b.node("x", HeatCapacity(3.0), t), b.node("y", HeatCapacity(4.0), t));
    let j = b.massless("j");
    b.resistor("a", hot, x, Conductance(0.2));
    b.resistor("b", x, j, Conductance(5.0));
    b.resistor("c", j, y, Conductance(2.0));
    b.resistor("d", y, cold, Conductance(0.7));
    b.resistor("e", j, cold, Conductance(0.05));
    b.source("p", j, HeatFlow(12.0));
    b.source("q", y, HeatFlow(-3.0));
    let two_boundaries = assembled(b);
    for (system, ports) in [(system, nodes), (two_boundaries, vec![x, y, j])] {
        let steady = SteadyState::solve(&system, 0.0).unwrap();
        for port in ports {
            let reduction = Reduction::new(&system, port, &ReductionOptions::default()).unwrap();
            let norton = &reduction.norton;
            let port_temperature =
                reduction.inputs.reference + norton.resistance * reduction.inputs.heat;
            assert!((port_temperature - steady.temperatures[port.index()]).abs() < 1e-10);
            near(norton.boundary_weights.iter().sum::<f64>(), 1.0, 1e-13);
        }
    }
}

#[test]
fn a_fit_finds_one_exponential_again_and_says_where_there_is_none() {
    let times: Vec<f64> = (0..200).map(|k| 5.0 * f64::from(k)).collect();
    let curve =
        |tau: f64| -> Vec<f64> { times.iter().map(|t| 92.7 - 67.2 * (-t / tau).exp()).collect() };
    for tau in [3.0, 80.0, 810.0, 2e4] {
        let fit = fit_exponential(&times, &curve(tau)).unwrap();
        near(fit.tau, tau, 1e-7);
        assert!(
            (fit.initial - 25.5).abs() < 1e-6 && (fit.settled / 92.7 - 1.0).abs() < 1e-6,
            "{fit:?}"
        );
        assert!(fit.rms < 1e-9);
    }
    let code = |times: &[f64], values: &[f64]| fit_exponential(times, values).unwrap_err().code();
    assert_eq!(code(&times[..3], &curve(80.0)[..3]), "fit::too_few_points");
    assert_eq!(code(&times, &vec![20.0; 200]), "fit::flat");
    assert_eq!(code(&times, &times), "fit::no_curvature");
    assert_eq!(code(&[0.0, 1.0, 1.0, 2.0], &[0.0, 1.0, 2.0, 3.0]), "fit::not_a_record");
}

/// Rows of the table by their words, and the relations between its columns.
#[test]
fn the_table_has_a_row_a_pair() {
    let (system, nodes) = two_nodes([1000.0, 1659.0], 0.1, 0.3, 220.6);
    let options =
        ReductionOptions { run: Some(RunAnalysis::until(Time(1500.0))), ..Default::default() };
    let reduction = Reduction::new(&system, nodes[0], &options).unwrap();
    let table = reduction.table();
    let labels: Vec<&[String]> =
        table.labels().iter().map(|label| label.cells.as_slice()).collect();
    assert_eq!(labels[0], ["sum", "first_moment", "dominant_pole", "least_squares"]);
    assert_eq!(labels[1], ["no", "no", "no", "yes"]);
    let column = |name: &str| {
        let column = table.columns().iter().find(|column| column.name == name);
        column.unwrap_or_else(|| panic!("no column {name}")).values.clone()
    };
    assert!(column("R_eq").iter().all(|r| (r - 0.4).abs() < 1e-14));
    near(column("C_eq")[0], 2659.0, 1e-14);
    near(column("tau")[0], 0.4 * 2659.0, 1e-14);
    // heat of 220.6 W from rest: the error of the run is that of 1 W, as often
    near(column("run.max")[0], 220.6 * column("step.max")[0], 1e-4);
    near(column("step.relative")[0], column("step.max")[0] / 0.4, 1e-14);
    let alone = Reduction::new(&system, nodes[0], &ReductionOptions::default()).unwrap().table();
    let runs = alone.columns().iter().filter(|column| column.name.starts_with("run."));
    assert!(runs.flat_map(|column| &column.values).all(|value| value.is_nan()));
}

/// A port that sees no capacity has one row without a definition, and its resistance.
#[test]
fn the_table_of_a_junction_has_one_row() {
    let mut b = NetworkBuilder::new();
    let bed = b.boundary("bed", Temperature(300.0));
    let port = b.massless("port");
    b.resistor("r", port, bed, Conductance(0.5));
    let table = Reduction::new(&assembled(b), port, &ReductionOptions::default()).unwrap().table();
    assert_eq!((table.rows(), table.labels()[0].cells.as_slice()), (1, [String::new()].as_slice()));
    assert_eq!(table.labels()[1].cells, ["no"]);
    let row: Vec<f64> = table.row(0).collect();
    assert!((row[0] - 2.0).abs() < 1e-14 && row[1..].iter().all(|value| value.is_nan()), "{row:?}");
}

/// Reciprocity: the rise of one end for heat into the other is that of the resistance they share.
#[test]
fn the_transfer_resistance_is_that_of_the_common_path() {
    let (system, nodes) = chain(&[1.0, 2.0, 3.0], &[0.5, 4.0, 0.1]);
    near(transfer_resistance(&system, nodes[0], nodes[2]).unwrap(), 2.0, 1e-13);
    near(transfer_resistance(&system, nodes[2], nodes[1]).unwrap(), 2.25, 1e-13);
}
