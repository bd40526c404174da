//! What a system says of itself, and what it reads and keeps: unknowns, inputs, positions,
//! temperatures.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::networks;

use lptn_assembly::ThermalSystem;
use lptn_network::{
    Acts, Conductance, Context, HeatCapacity, HeatFlow, NetworkBuilder, Positions, Temperature,
    Thermostat, Time,
};
use networks::{flow, link, power, quantity, radiation, stream, system};

/// Two states, a junction that can be eliminated, one that radiates and cannot, in mixed order.
fn mixed() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let tip = b.massless("tip");
    let warm = b.node("warm", HeatCapacity(30.0), Temperature(320.0));
    let joint = b.massless("joint");
    let cool = b.node("cool", HeatCapacity(50.0), Temperature(290.0));
    let (sky, air) = (b.boundary("sky", Temperature(200.0)), b.boundary("air", Temperature(280.0)));
    b.resistor("a", warm, joint, Conductance(2.0));
    b.resistor("b", joint, cool, Conductance(2.0));
    b.resistor("c", warm, tip, Conductance(3.0));
    radiation(&mut b, "glow", (tip, sky), "0.5 m^2");
    stream(&mut b, "wind", (air, cool), quantity("4 W/K"));
    b.resistor("d", sky, air, Conductance(7.0));
    b.source("heater", warm, quantity("60 W"));
    system(b)
}

#[test]
fn unknowns_are_states_then_massless_nodes_that_cannot_be_eliminated() {
    let mixed = mixed();
    let names = |ids: &[lptn_network::NodeId]| -> Vec<String> {
        ids.iter().map(|id| mixed.network().nodes()[id.index()].name.clone()).collect()
    };
    assert_eq!(names(mixed.states()), ["warm", "cool"]);
    assert_eq!(names(mixed.algebraic()), ["tip"]);
    assert_eq!(names(mixed.unknowns()), ["warm", "cool", "tip"]);
    assert_eq!(mixed.capacity(), [30.0, 50.0]);
    assert_eq!(mixed.mass(), [30.0, 50.0, 0.0]);
    assert_eq!(mixed.initial(), [320.0, 290.0]);
    assert!(!mixed.is_linear() && !mixed.is_symmetric() && mixed.has_massless());
    let streams: Vec<_> = mixed.streams().iter().map(|id| id.index()).collect();
    assert_eq!(streams, [4]);
    // the diagonal, warm with cool through the joint, warm with the tip: both ways
    assert_eq!(mixed.pattern().entries(), 3 + 2 + 2);
}

#[test]
fn kinds_of_systems_are_told_apart() {
    let build = |add: &dyn Fn(&mut NetworkBuilder, [lptn_network::End; 2])| {
        let mut b = NetworkBuilder::new();
        let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
        let air = b.boundary("air", Temperature(300.0));
        add(&mut b, [node.into(), air.into()]);
        let system = system(b);
        (system.is_linear(), system.is_symmetric(), system.has_massless())
    };
    let constant = build(&|b, [a, air]| {
        b.resistor("r", a, air, Conductance(1.0));
    });
    assert_eq!(constant, (true, true, false));
    let glowing = build(&|b, [a, air]| {
        radiation(b, "r", (a, air), "1 m^2");
    });
    assert_eq!(glowing, (false, true, false));
    let flowing = build(&|b, [a, air]| {
        stream(b, "r", (a, air), quantity("1 W/K"));
    });
    assert_eq!(flowing, (false, false, false));
    let varying = build(&|b, [a, air]| {
        let g = link(b, "1 [W/K] * kelvin(T_mean) / 300 [K]");
        b.resistor("r", a, air, lptn_network::Path::conductance(g));
    });
    assert_eq!(varying, (false, true, false));
    let junction = build(&|b, [a, air]| {
        let j = b.massless("j");
        b.resistor("r", a, j, Conductance(1.0));
        b.resistor("s", j, air, Conductance(1.0));
    });
    assert_eq!(junction, (true, true, true));
    let hot_junction = build(&|b, [a, air]| {
        let j = b.massless("j");
        b.resistor("r", a, j, Conductance(1.0));
        radiation(b, "s", (j, air), "1 m^2");
    });
    assert_eq!(hot_junction, (false, true, true));
}

#[test]
fn inputs_are_read_anew_when_the_time_or_its_segment_changes() {
    let mut b = NetworkBuilder::new();
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let ramp = b.expression("absolute(300 [K]) + 2 [K/s] * t", None).unwrap();
    let air = b.boundary("air", ramp);
    b.resistor("r", node, air, Conductance(1.0));
    let step = b.expression("if(t < 1 [s], 10 [W], 30 [W])", None).unwrap();
    b.source("step", node, step);
    let system = system(b);
    let mut work = system.workspace();
    let mut at = |time: f64, segment: f64| {
        system.read_inputs(&mut work, time, segment).unwrap();
        let mut flow = [f64::NAN];
        system.flow(&mut work, &[300.0], &mut flow).unwrap();
        assert!((system.boundary_temperatures(&work)[0] - 300.0 - 2.0 * time).abs() < 1e-12);
        assert!((system.source_powers(&work)[0] + 2.0 * time - flow[0]).abs() < 1e-12);
        flow[0]
    };
    for (time, segment, expected) in [
        (1.0, 0.5, 12.0),
        (1.0, 1.5, 32.0),
        (1.0, 0.5, 12.0),
        (0.0, 0.5, 10.0),
        (3.0, 2.0, 36.0),
        (3.0, 2.0, 36.0),
    ] {
        assert!((at(time, segment) - expected).abs() < 1e-12, "{time} {segment}");
    }
}

/// A parabola that is taken for a straight line is read as itself where that is asked for, and as
/// the line again afterwards.
#[test]
fn inputs_on_a_line_can_be_read_themselves() {
    let mut b = NetworkBuilder::new();
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let square = b.expression("3 [W/s^2] * t^2", None).unwrap();
    b.source("square", node, square);
    let system = system(b);
    let mut work = system.workspace();
    work.draw_line(system.network(), (0.0, 10.0), 5.0);
    for _ in 0..2 {
        system.read_inputs(&mut work, 4.0, 5.0).unwrap();
        assert!((system.source_powers(&work)[0] - 120.0).abs() < 1e-12);
        system.read_exactly(&mut work, 4.0, 5.0).unwrap();
        assert!((system.source_powers(&work)[0] - 48.0).abs() < 1e-12);
    }
}

#[test]
fn an_input_that_fails_leaves_nothing_half_read() {
    let mut b = NetworkBuilder::new();
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(300.0));
    b.resistor("r", node, air, Conductance(1.0));
    let root = b.expression("5 [W] * sqrt(4 - t / 1 [s])", None).unwrap();
    b.source("root", node, root);
    let system = system(b);
    let mut work = system.workspace();
    let mut flow = [f64::NAN];
    for _ in 0..2 {
        system.read_inputs(&mut work, 3.0, 3.0).unwrap();
        system.flow(&mut work, &[300.0], &mut flow).unwrap();
        assert!((flow[0] - 5.0).abs() < 1e-12);
        for _ in 0..2 {
            let error = system.read_inputs(&mut work, 5.0, 5.0).unwrap_err();
            assert_eq!(error.name, "root");
        }
    }
}

#[test]
fn positions_that_change_are_read_again() {
    let mut b = NetworkBuilder::new();
    let fan = b.control("fan");
    let node = b.node("a", HeatCapacity(1.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    b.resistor("r", node, air, Conductance(1.0));
    let thermostat = Thermostat {
        sense: node.into(),
        acts: Acts::Cooling,
        on: Temperature(350.0).into(),
        off: Temperature(330.0).into(),
        start: false,
        min_dwell: Time(0.0).into(),
    };
    b.thermostat(fan, thermostat);
    let p = power(&b, "if(T > absolute(340 [K]), 2 [W], 0 [W])");
    b.source("warm", node, p);
    let p = b.expression_in(Context::Time, "-7 [W] * fan", None).unwrap();
    b.source("fan_heat", node, p);
    let system = system(b);
    let mut work = system.workspace();
    assert_eq!(work.positions(), &Positions { controls: vec![false], switches: vec![false] });
    let y = [348.0];
    let mut flow_with = |on: bool, holds: bool| {
        work.set_positions(&Positions { controls: vec![on], switches: vec![holds] });
        assert_eq!((work.positions().controls[0], work.positions().switches[0]), (on, holds));
        system.read_inputs(&mut work, 0.0, 0.0).unwrap();
        let mut flow = [f64::NAN];
        system.flow(&mut work, &y, &mut flow).unwrap();
        system.recover(&mut work, &y);
        let excess = system.control_excess(&mut work, fan).unwrap();
        let switch = system.network().switch_ids().next().unwrap();
        let (difference, slope) = system.switch_difference(&mut work, switch).unwrap();
        assert!(
            (difference - 8.0).abs() < 1e-12 && (slope - 1.0).abs() < 1e-12,
            "{difference} {slope}"
        );
        (flow[0], excess)
    };
    // -58 W to the air; off: 348 K is 2 K short of 350 K, on: 18 K above 330 K
    for (on, holds, flow, excess) in [
        (false, false, -58.0, -2.0),
        (true, false, -65.0, -18.0),
        (true, true, -63.0, -18.0),
        (false, true, -56.0, -2.0),
    ] {
        let found = flow_with(on, holds);
        assert!((found.0 - flow).abs() < 1e-12 && (found.1 - excess).abs() < 1e-12, "{found:?}");
    }
}

#[test]
fn temperatures_are_placed_recovered_and_picked() {
    let mixed = mixed();
    let mut work = mixed.workspace();
    mixed.read_inputs(&mut work, 0.0, 0.0).unwrap();
    mixed.recover(&mut work, &[320.0, 290.0, 310.0]);
    // the joint lies between two equal conductances
    assert_eq!(mixed.node_temperatures(&work), [310.0, 320.0, 305.0, 290.0]);
    assert_eq!(mixed.boundary_temperatures(&work), [200.0, 280.0]);
    assert_eq!(mixed.source_powers(&work), [60.0]);
    let mut y = [f64::NAN; 3];
    mixed.unknown_temperatures(&[1.0, 2.0, 3.0, 4.0], &mut y);
    assert_eq!(y.map(f64::to_bits), [2.0_f64, 4.0, 1.0].map(f64::to_bits));
    mixed.place(&mut work, &[301.0, 302.0, 303.0, 304.0]);
    assert_eq!(mixed.node_temperatures(&work), [301.0, 302.0, 303.0, 304.0]);
    assert_eq!(mixed.boundary_temperatures(&work), [200.0, 280.0]);
}

#[test]
fn heat_of_boundaries_counts_every_kind_of_path() {
    let mixed = mixed();
    let y = [320.0, 290.0, 310.0];
    let mut work = mixed.workspace();
    mixed.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut heat = [f64::NAN; 2];
    mixed.boundary_heat(&mut work, &y, &mut heat).unwrap();
    let glow = 0.5 * networks::SIGMA * (310.0_f64.powi(4) - 200.0_f64.powi(4));
    let bridge = 7.0 * (200.0 - 280.0);
    // a stream into `cool` takes nothing from where it begins
    assert!((heat[0] - (bridge - glow)).abs() < 1e-10, "{heat:?}");
    assert!((heat[1] + bridge).abs() < 1e-10, "{heat:?}");
    let mut linear = [f64::NAN; 2];
    mixed.linear_boundary_heat(&work, &y, &mut linear);
    assert!((linear[0] - bridge).abs() < 1e-10 && (linear[1] + bridge).abs() < 1e-10, "{linear:?}");
    let found = flow(&mixed, 0.0, &y);
    // through the joint 1 W/K, to the tip 3 W/K, the stream brings 4 W/K (280 K - 290 K)
    let expected = [60.0 - 30.0 - 30.0, 30.0 - 40.0, 30.0 - glow];
    found
        .iter()
        .zip(expected)
        .for_each(|(f, e)| assert!((f - e).abs() < 1e-10, "{found:?} {expected:?}"));
    let mut linear = [f64::NAN; 3];
    mixed.linear_flow(&work, &y, &mut linear);
    for (f, e) in linear.iter().zip([0.0, 30.0, 30.0]) {
        assert!((f - e).abs() < 1e-10, "{linear:?}");
    }
    let mut streams = [f64::NAN];
    mixed.stream_heat(&mut work, &mut streams).unwrap();
    assert!((streams[0] + 40.0).abs() < 1e-12, "{streams:?}");
    assert!((mixed.boundary_conductance() - 7.0).abs() < 1e-12);
}

/// Sources that know temperatures are heat of the elements, not of the inputs: with shares, and
/// kept for the results.
#[test]
fn sources_of_temperatures_share_their_heat() {
    let mut b = NetworkBuilder::new();
    let [x, y] = ["x", "y"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    let air = b.boundary("air", Temperature(290.0));
    b.resistor("r", x, air, Conductance(1.0));
    b.resistor("s", x, y, Conductance(2.0));
    b.source("plain", y, HeatFlow(11.0));
    let p = power(&b, "3 [W/K] * (x.T - air.T)");
    b.shared_source("shared", &[(x, 0.25), (y, 0.75)], p);
    b.shared_source("plain_shared", &[(x, 0.5), (y, 0.5)], HeatFlow(4.0));
    let system = system(b);
    assert!(!system.is_symmetric());
    let found = flow(&system, 0.0, &[310.0, 305.0]);
    // 60 W; 20 W to the air, 10 W from x to y
    let expected = [-20.0 - 10.0 + 15.0 + 2.0, 10.0 + 11.0 + 45.0 + 2.0];
    found
        .iter()
        .zip(expected)
        .for_each(|(f, e)| assert!((f - e).abs() < 1e-11, "{found:?} {expected:?}"));
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut heat = [f64::NAN];
    system.boundary_heat(&mut work, &[310.0, 305.0], &mut heat).unwrap();
    assert!((heat[0] + 20.0).abs() < 1e-12);
    let powers = system.source_powers(&work);
    assert!(
        (powers[1] - 60.0).abs() < 1e-11 && powers[0].to_bits() == 11.0_f64.to_bits(),
        "{powers:?}"
    );
}

/// Three boundaries and one node: what goes from one boundary to another past the node.
#[test]
fn bridges_lead_to_every_boundary() {
    let mut b = NetworkBuilder::new();
    let x = b.node("x", HeatCapacity(1.0), Temperature(300.0));
    let ends =
        [(280.0, "a"), (250.0, "b"), (310.0, "c")].map(|(t, n)| b.boundary(n, Temperature(t)));
    for (i, (from, to, g)) in [(0, 1, 2.0), (1, 2, 5.0), (2, 0, 0.5)].into_iter().enumerate() {
        b.resistor(&format!("r{i}"), ends[from], ends[to], Conductance(g));
    }
    b.resistor("tie", x, ends[2], Conductance(3.0));
    let system = system(b);
    let mut work = system.workspace();
    system.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut heat = [f64::NAN; 3];
    system.boundary_heat(&mut work, &[300.0], &mut heat).unwrap();
    let expected =
        [2.0 * 30.0 - 0.5 * 30.0, -2.0 * 30.0 - 5.0 * 60.0, 5.0 * 60.0 + 0.5 * 30.0 + 3.0 * 10.0];
    heat.iter()
        .zip(expected)
        .for_each(|(f, e)| assert!((f - e).abs() < 1e-10, "{heat:?} {expected:?}"));
    assert!((system.boundary_conductance() - 10.5).abs() < 1e-12);
}
