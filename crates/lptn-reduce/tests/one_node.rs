//! The equivalent as a network: reduced again, and with inputs that change with time.

use crate::common;

use common::{assembled, near};
use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, NetworkBuilder, Temperature, Time};
use lptn_reduce::{Reduction, ReductionOptions};

fn options(stop: f64) -> ReductionOptions {
    ReductionOptions { run: Some(RunAnalysis::until(Time(stop))), ..Default::default() }
}

#[test]
fn reduced_again_it_is_the_same() {
    let (system, [steel, _]) = common::two_nodes([1000.0, 1659.0], 0.1, 0.3, 220.6);
    let reduction = Reduction::new(&system, steel, &options(1500.0)).unwrap();
    for pair in &reduction.dynamics.as_ref().unwrap().pairs {
        let network = reduction.network(&system, 0.0, Some(pair)).unwrap();
        let one = ThermalSystem::assemble(&network).unwrap();
        let again = Reduction::new(&one, network.node("steel").unwrap(), &options(1500.0)).unwrap();
        near(again.norton.resistance, reduction.norton.resistance, 1e-15);
        near(again.inputs.heat, reduction.inputs.heat, 1e-15);
        near(again.inputs.reference, reduction.inputs.reference, 1e-15);
        for same in &again.dynamics.unwrap().pairs {
            near(same.capacity, pair.capacity, 1e-12);
        }
    }
}

/// Sources and boundaries that change: at a port in the middle of a chain whose other nodes are
/// nearly massless the equivalent is nearly exact, so that its run has to be that of the whole
/// network.
#[test]
fn inputs_that_change_with_time_are_kept() {
    let mut b = NetworkBuilder::new();
    let start = Temperature::celsius(20.0);
    let high = b.parameter("P_high", HeatFlow(40.0));
    assert_eq!(high.index(), 0);
    let pulse = b.expression("if(t < 300 [s], P_high, 5 [W])", None).unwrap();
    let day = b.expression("20 [degC] + 8 [K] * sin(2 * pi * t / 1200 [s])", None).unwrap();
    let left = b.node("left", HeatCapacity(1e-3), start);
    let middle = b.node("middle", HeatCapacity(500.0), start);
    let right = b.massless("right");
    let (sky, oven) = (b.boundary("sky", day), b.boundary("oven", Temperature::celsius(60.0)));
    b.resistor("a", sky, left, Conductance(2.0));
    b.resistor("b", left, middle, Conductance(4.0));
    b.resistor("c", middle, right, Conductance(3.0));
    b.resistor("d", right, oven, Conductance(0.5));
    b.source("pulse", left, pulse);
    b.source("steady", right, HeatFlow(7.0));
    let system = assembled(b);
    let reduction = Reduction::new(&system, middle, &options(1000.0)).unwrap();
    // dividers: 2/(2 + 4) of the 40 W at `left` go to the sky, 0.5/3.5 of the 7 W to the oven
    near(reduction.inputs.heat, 40.0 * 4.0 / 6.0 + 7.0 * 3.0 / 3.5, 1e-13);
    let (to_sky, to_oven) = (1.0 / (0.5 + 0.25), 1.0 / (2.0 + 1.0 / 3.0));
    near(reduction.norton.resistance, 1.0 / (to_sky + to_oven), 1e-13);
    let pair = &reduction.dynamics.as_ref().unwrap().pairs[0];
    assert!(pair.run.unwrap().kelvin < 1e-4, "{pair:?}");
    assert!(reduction.dynamics.as_ref().unwrap().rise.unwrap() > 5.0);
    let network = reduction.network(&system, 0.0, Some(pair)).unwrap();
    assert_eq!(
        (network.boundaries().len(), network.sources().len(), network.nodes().len()),
        (2, 2, 1)
    );
    assert!(network.has_time_dependent_inputs());
    let one = ThermalSystem::assemble(&network).unwrap();
    let again = Reduction::new(&one, network.node("middle").unwrap(), &options(1000.0)).unwrap();
    near(again.norton.resistance, reduction.norton.resistance, 1e-14);
    near(again.inputs.heat, reduction.inputs.heat, 1e-14);
}

/// A source halfway along a slow bar: the one-node network feels its heat at once, the bar does
/// not.
#[test]
fn the_error_of_a_run_is_that_of_its_own_sources() {
    let (c, g) = (100.0, 2.0);
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    let near_end = b.node("near", HeatCapacity(c), zero);
    let far_end = b.node("far", HeatCapacity(c), zero);
    let ground = b.boundary("ground", zero);
    b.resistor("a", ground, near_end, Conductance(g));
    b.resistor("b", near_end, far_end, Conductance(g));
    b.source("heat", far_end, HeatFlow(10.0));
    let system = assembled(b);
    let reduction = Reduction::new(&system, near_end, &options(2000.0)).unwrap();
    near(reduction.inputs.heat, 10.0, 1e-13);
    // rates (g/c)(3 -+ sqrt 5)/2 of the matrix [[2, -1], [-1, 1]] g/c; the port's rise is 5 K (1 -
    // sum of w e^-lt)
    let root = 5_f64.sqrt();
    let rates = [0.5 * (3.0 - root), 0.5 * (3.0 + root)].map(|x| x * g / c);
    let weight = rates[1] / (rates[1] - rates[0]); // w1 + w2 = 1, and no slope at 0: w1 l1 + w2 l2 = 0
    let rise = |t: f64| {
        5.0 * (1.0 - weight * (-rates[0] * t).exp() - (1.0 - weight) * (-rates[1] * t).exp())
    };
    for pair in &reduction.dynamics.unwrap().pairs {
        let tau = 0.5 * pair.capacity;
        let error = |t: f64| (rise(t) + 5.0 * f64::exp_m1(-t / tau)).abs();
        let expected = (0..200_000).map(|k| error(0.01 * f64::from(k))).fold(0.0, f64::max);
        near(pair.run.unwrap().kelvin, expected, 1e-5);
    }
}

/// A node that only a boundary joins to the port is not felt: neither its source nor the boundary
/// behind it, nor the parameters and names that only these use, are in the one-node network.
#[test]
fn what_the_port_does_not_feel_is_left_out() {
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    b.parameter("P_port", HeatFlow(40.0));
    b.parameter("P_far", HeatFlow(70.0));
    let pulse = b.expression("if(t < 300 [s], P_port, 5 [W])", None).unwrap();
    let [port, far] = ["port", "far"].map(|name| b.node(name, HeatCapacity(500.0), zero));
    let (bed, sky) = (b.boundary("bed", zero), b.boundary("sky", zero));
    b.resistor("a", port, bed, Conductance(2.0));
    b.resistor("b", far, bed, Conductance(4.0));
    b.resistor("c", far, sky, Conductance(4.0));
    b.source("pulse", port, pulse);
    let constant = b.expression("P_far", None).unwrap();
    b.source("elsewhere", far, constant);
    let system = assembled(b);
    let reduction = Reduction::new(&system, port, &ReductionOptions::default()).unwrap();
    let network = reduction.network(&system, 0.0, None).unwrap();
    let names: Vec<&str> =
        network.boundaries().iter().map(|boundary| boundary.name.as_str()).collect();
    assert_eq!(names, ["bed"]);
    assert_eq!((network.sources().len(), network.parameters().len()), (1, 1));
    assert_eq!(network.parameters()[0].name, "P_port");
    assert!(network.nodes()[0].massless, "no pair, no capacity");
}

/// A massless port starts where the inputs put it that act just after the start: of 40 W until 100
/// s, 5 W until 150 s and 7 W from then on, the 5 W at 100 s.
#[test]
fn a_massless_port_starts_with_what_acts_after_the_start() {
    let mut b = NetworkBuilder::new();
    let heat =
        b.expression("if(t <= 100 [s], 40 [W], if(t < 150 [s], 5 [W], 7 [W]))", None).unwrap();
    let (port, wall) =
        (b.massless("port"), b.node("wall", HeatCapacity(500.0), Temperature(300.0)));
    let air = b.boundary("air", Temperature(290.0));
    b.resistor("inner", port, wall, Conductance(2.0));
    b.resistor("outer", wall, air, Conductance(1.0));
    b.source("heat", port, heat);
    let system = assembled(b);
    for (start, heat) in [(0.0, 40.0), (100.0, 5.0), (200.0, 7.0)] {
        let run = RunAnalysis::until(Time(1000.0)).lasting(start, 1000.0);
        let reduction = Reduction::new(
            &system,
            port,
            &ReductionOptions { run: Some(run), ..Default::default() },
        )
        .unwrap();
        near(reduction.initial, 300.0 + heat / 2.0, 1e-14);
    }
}

/// The runs that are compared keep a hundredth of a tight tolerance, and never more than the one
/// documented.
#[test]
fn the_tolerance_of_the_comparison_follows_that_of_the_run() {
    let (system, [steel, _]) = common::two_nodes([1000.0, 1659.0], 0.1, 0.3, 220.6);
    for (asked, kept) in [(1e-3, lptn_reduce::TOLERANCE), (1e-6, 1e-8)] {
        let run = RunAnalysis::until(Time(100.0)).within(asked);
        let reduction = Reduction::new(
            &system,
            steel,
            &ReductionOptions { run: Some(run), ..Default::default() },
        )
        .unwrap();
        near(reduction.dynamics.unwrap().tolerance.unwrap(), kept, 1e-12);
    }
}
