//! Streams of constant capacity rate: one exact resistance, and what of the rest is right. Numbers
//! from NumPy's inverse of the balances, unless a closed form stands beside them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{assembled, near};
use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, ConductorKind, End, HeatCapacity, HeatFlow, NetworkBuilder, Path, Resistance,
    Temperature, Time,
};
use lptn_reduce::{Definition, Judge, Reduction, ReductionOptions};
use lptn_solve::SteadyState;

fn stream(b: &mut NetworkBuilder, name: &str, (from, to): (End, End), rate: f64) {
    b.conductor(name, ConductorKind::Advection, (from, to), Path::stream(Conductance(rate)));
}

/// A hot part between the inlet and the outlet side of a channel; 10 W/K flow through both.
fn channel(massless: bool) -> ThermalSystem {
    let zero = Temperature::celsius(20.0);
    let mut b = NetworkBuilder::new();
    let hot = b.node("hot", HeatCapacity(300.0), zero);
    let inlet = if massless { b.massless("in") } else { b.node("in", HeatCapacity(100.0), zero) };
    let outlet = b.node("out", HeatCapacity(200.0), zero);
    let (cool, air) =
        (b.boundary("cool", Temperature::celsius(15.0)), b.boundary("air", Temperature(300.0)));
    b.resistor("a", hot, inlet, Conductance(2.0));
    b.resistor("b", hot, outlet, Conductance(1.0));
    b.resistor("c", outlet, air, Conductance(0.5));
    stream(&mut b, "feed", (cool.into(), inlet.into()), 10.0);
    stream(&mut b, "on", (inlet.into(), outlet.into()), 10.0);
    stream(&mut b, "back", (outlet.into(), cool.into()), 10.0);
    b.source("p", hot, HeatFlow(30.0));
    b.source("q", inlet, HeatFlow(7.0));
    assembled(b)
}

#[test]
fn what_flows_one_way_is_felt_one_way() {
    let rows = [
        [0.4107142857142857, 0.09821428571428571, 0.03571428571428571],
        [0.06845238095238095, 0.09970238095238096, 0.005952380952380952],
        [0.09523809523809523, 0.09523809523809523, 0.09523809523809523],
    ];
    let cool = [0.9821428571428571, 0.9970238095238095, 0.9523809523809523];
    let moments = [
        [51.95843962585034, 3.124335671768707, 2.891156462585034],
        [51.28613945578231, 2.1302791950113376, 2.834467120181406],
    ];
    for (massless, moments) in [false, true].into_iter().zip(moments) {
        let system = channel(massless);
        for (k, port) in system.network().node_ids().enumerate() {
            let options = ReductionOptions::default();
            let reduction = Reduction::new(&system, port, &options).unwrap();
            let norton = &reduction.norton;
            near(norton.resistance, rows[k][k], 1e-13);
            for (j, expected) in rows.iter().enumerate() {
                near(norton.influence[j], rows[k][j], 1e-13);
                near(norton.response[j], expected[k], 1e-13);
            }
            near(norton.boundary_weights[0], cool[k], 1e-13);
            near(norton.boundary_weights.iter().sum::<f64>(), 1.0, 1e-13);
            near(norton.source_weights[1], rows[k][1] / rows[k][k], 1e-13);
            near(norton.first_moment(system.network()), moments[k], 1e-13);
            // the rest would need modes, which swing where streams go round
            let dynamics = reduction.dynamics.unwrap();
            let definitions: Vec<Definition> =
                dynamics.pairs.iter().map(|pair| pair.definition).collect();
            assert_eq!(definitions, [Definition::Sum, Definition::FirstMoment]);
            assert!(dynamics.step.is_none() && dynamics.recommended.by.is_none());
        }
    }
}

/// In steady state `T = T_ref + R_eq Q_N`, whatever the streams do.
#[test]
fn the_equivalent_is_the_steady_state() {
    for massless in [false, true] {
        let system = channel(massless);
        let steady = SteadyState::solve(&system, 0.0).unwrap();
        for port in system.network().node_ids() {
            let reduction = Reduction::new(&system, port, &ReductionOptions::default()).unwrap();
            let inputs = reduction.inputs;
            let found = inputs.reference + reduction.norton.resistance * inputs.heat;
            assert!((found - steady.temperatures[port.index()]).abs() < 1e-9, "{found} {port:?}");
        }
    }
}

/// The run is compared all the same, by integrating both networks.
#[test]
fn the_run_judges_where_no_step_can() {
    let system = channel(false);
    let hot = system.network().node("hot").unwrap();
    let run = Some(RunAnalysis::until(Time(2000.0)));
    let reduction = Reduction::new(&system, hot, &ReductionOptions { run, ..Default::default() });
    let dynamics = reduction.unwrap().dynamics.unwrap();
    assert_eq!(dynamics.recommended.by, Some(Judge::Run));
    let rise = dynamics.rise.unwrap();
    for pair in &dynamics.pairs {
        let run = pair.run.unwrap();
        assert!(run.kelvin > 0.01 && run.kelvin < rise, "{run:?}");
    }
}

/// A sump with its own inlet and outlet is no more than a conductance: the closed form of two nodes
/// in a row, 0.1 K/W and 1 / (15 W/K), and all definitions.
#[test]
fn a_stream_through_one_node_is_a_conductance() {
    let zero = Temperature::celsius(35.0);
    let build = |flows: bool| {
        let mut b = NetworkBuilder::new();
        let steel = b.node("steel", HeatCapacity(1235.0), zero);
        let sump = b.node("sump", HeatCapacity(600.0), zero);
        let cool = b.boundary("cool", Temperature::celsius(40.0));
        b.resistor("w", steel, sump, Resistance(0.1));
        if flows {
            stream(&mut b, "feed", (cool.into(), sump.into()), 15.0);
            stream(&mut b, "back", (sump.into(), cool.into()), 15.0);
        } else {
            b.resistor("g", sump, cool, Conductance(15.0));
        }
        b.source("p", steel, HeatFlow(223.0));
        let system = assembled(b);
        let run = Some(RunAnalysis::until(Time(3600.0)));
        let options = ReductionOptions { run, ..Default::default() };
        Reduction::new(&system, steel, &options).unwrap()
    };
    let (flows, conducts) = (build(true), build(false));
    near(flows.norton.resistance, 1.0 / 6.0, 1e-14);
    near(flows.norton.boundary_weights[0], 1.0, 1e-14);
    let [flows, conducts] = [flows, conducts].map(|r| r.dynamics.unwrap());
    assert_eq!(flows.pairs.len(), 4);
    for (a, b) in flows.pairs.iter().zip(&conducts.pairs) {
        near(a.capacity, b.capacity, 1e-10);
        near(a.step.unwrap().kelvin, b.step.unwrap().kelvin, 1e-9);
        near(a.run.unwrap().kelvin, b.run.unwrap().kelvin, 1e-5);
    }
}
