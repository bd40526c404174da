//! The periodic state: closed forms, waiting, and what has none.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::elements_helper as elements;

use std::f64::consts::TAU;

use elements::{link, of, own, power, quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    AfterEnd, Conductance, Course, HeatCapacity, Melting, NetworkBuilder, NodeId, NotPeriodic,
    Path, Properties, Size, Temperature, Time,
};
use lptn_solve::{
    CycleMethod, Periodic, PeriodicError, Proceed, Selection, State, Transient, Window,
};
use lptn_units::Dimension;

const AMBIENT: f64 = 300.0;

fn cycle(period: f64, tolerance: f64) -> Transient {
    Transient::until(Time(period)).tolerance(tolerance)
}

/// Heat that is on for a part of every period.
fn duty(b: &mut NetworkBuilder, node: NodeId, heat: f64, (on, period): (f64, f64)) {
    let course = Course::Steps {
        times: vec![0.0, on],
        values: vec![heat, 0.0],
        after: AfterEnd::Repeat(period),
    };
    b.signal("duty", of(Dimension::POWER), course);
    let load = power(b, "duty");
    b.source("load", node, load);
}

fn temperature(system: &ThermalSystem, state: &State, node: NodeId) -> f64 {
    let place = system.states().iter().position(|&id| id == node).unwrap();
    state.temperature(system, place).unwrap()
}

/// One node of 1000 J/K and 0.5 W/K, 2000 s, that gets 100 W for 300 s of every 1000 s.
fn one_node() -> (ThermalSystem, NodeId) {
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(1000.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", node, air, Conductance(0.5));
    duty(&mut b, node, 100.0, (300.0, 1000.0));
    (system(b), node)
}

/// x(0) = X (1 - exp(-a/tau)) exp(-(p - a)/tau) / (1 - exp(-p/tau)) with X = P / G, on for a of
/// every p.
fn square_wave() -> f64 {
    let (on, period, tau) = (300.0_f64, 1000.0, 2000.0);
    200.0 * (1.0 - (-on / tau).exp()) * (-(period - on) / tau).exp() / (1.0 - (-period / tau).exp())
}

#[test]
fn a_square_wave_on_one_node_has_its_closed_form() {
    let (system, node) = one_node();
    let window = Window {
        name: "cycle".into(),
        from: 0.0,
        to: 1000.0,
        of: Selection::all(system.network()),
    };
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let settings = cycle(1000.0, tolerance).window(window.clone());
        let found = Periodic::find(&system, &settings).unwrap();
        // in closed form, whatever the tolerance
        let start = temperature(&system, &found.state, node);
        assert!((start - AMBIENT - square_wave()).abs() < 1e-9, "{start}");
        assert_eq!((found.method, found.cycles), (CycleMethod::Modes, 1));
        assert!((found.multiplier.unwrap() - (-0.5_f64).exp()).abs() < 1e-12);
        assert!(found.residual < 10.0 * tolerance && found.error < 1e-9);
        // means: all heat leaves, 30 W over 0.5 W/K
        let [seen] = found.solution.windows() else { panic!("one window") };
        let column = |name: &str| seen.columns.iter().find(|c| c.name == name).unwrap();
        assert!((column("node.T").mean - AMBIENT - 60.0).abs() < 10.0 * tolerance);
        assert!((column("air.Q").mean + 30.0).abs() < 10.0 * tolerance);
        let top = square_wave() * (-0.15_f64).exp() + 200.0 * (1.0 - (-0.15_f64).exp());
        assert!((column("node.T").max.0 - AMBIENT - top).abs() < 10.0 * tolerance);
        assert!(found.solution.ledger().closes());
    }
}

/// C x' = P0 + P1 sin wt - G x: x(0) = P0 / G - P1 w C / (G^2 + (w C)^2).
#[test]
fn a_sine_on_one_node_has_its_closed_form() {
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(1000.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", node, air, Conductance(0.5));
    let load = power(&b, "30 [W] + 50 [W] * sin(2 * pi * t / 700 [s])");
    b.source("load", node, load);
    let system = system(b);
    let found = Periodic::find(&system, &cycle(700.0, 1e-6)).unwrap();
    let wc = TAU / 700.0 * 1000.0;
    let exact = AMBIENT + 60.0 - 50.0 * wc / (0.25 + wc * wc);
    assert!((temperature(&system, &found.state, node) - exact).abs() < 1e-8);
    assert_eq!(found.method, CycleMethod::Modes);
}

/// A stream warms two cells one after the other, C y' = m (y_before - y); the inlet swings as a
/// sine. With H = 1 / (1 + i w tau) the cells swing by H and H^2 times the inlet.
#[test]
fn a_stream_under_a_sine_has_its_closed_form() {
    let (period, tau) = (1000.0, 2500.0);
    let mut b = NetworkBuilder::new();
    let first = b.node("first", HeatCapacity(2500.0), Temperature(AMBIENT));
    let second = b.node("second", HeatCapacity(2500.0), Temperature(AMBIENT));
    let inlet =
        b.expression("absolute(330 [K]) + 20 [K] * sin(2 * pi * t / 1000 [s])", None).unwrap();
    let inlet = b.boundary("inlet", inlet);
    let outlet = b.boundary("outlet", Temperature(AMBIENT));
    stream(&mut b, "in", (inlet, first), quantity("1 W/K"));
    stream(&mut b, "on", (first, second), quantity("1 W/K"));
    stream(&mut b, "out", (second, outlet), quantity("1 W/K"));
    let system = system(b);
    let found = Periodic::find(&system, &cycle(period, 1e-8)).unwrap();
    assert_eq!(found.method, CycleMethod::Shooting);
    let w = TAU / period * tau;
    let size = (1.0 + w * w).sqrt();
    let phase = w.atan();
    let exact = |cells: f64| 330.0 - 20.0 * size.powf(-cells) * (cells * phase).sin();
    for (node, cells) in [(first, 1.0), (second, 2.0)] {
        let off = temperature(&system, &found.state, node) - exact(cells);
        assert!(off.abs() < 1e-6, "{off:e}");
    }
    // the chain of equal cells is defective: its one multiplier is exp(-p/tau)
    assert!(
        (found.multiplier.unwrap() - (-period / tau).exp()).abs() < 0.05,
        "{:?}",
        found.multiplier
    );
}

/// Of the motor, in s.
const PERIOD: f64 = 560.0;

/// Winding, core and housing of a motor on duty: radiation and natural convection from the housing,
/// a core whose capacity grows with its temperature. The slowest time constant is about ten cycles.
fn motor() -> (ThermalSystem, [NodeId; 3]) {
    let mut b = NetworkBuilder::new();
    let winding = b.node("winding", HeatCapacity(300.0), Temperature(AMBIENT));
    let capacity = own(&b, "2500 [J/K] * (1 + (T - absolute(300 [K])) / 1000 [K])");
    let core = b.node("core", capacity, Temperature(AMBIENT));
    let housing = b.node("housing", HeatCapacity(1500.0), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("slot", winding, core, Conductance(3.0));
    b.resistor("fit", core, housing, Conductance(5.0));
    let h = link(&b, "2.2 [W/(m^2 K^1.25)] * abs(dT)^0.25");
    b.convection("film", housing, air, Path::film(h, quantity("0.05 m^2")));
    radiation(&mut b, "glow", (housing, air), "0.04 m^2");
    duty(&mut b, winding, 150.0, (190.0, PERIOD));
    (system(b), [winding, core, housing])
}

/// The state after so many cycles from the network's own start.
fn waited(system: &ThermalSystem, settings: &Transient, cycles: f64) -> lptn_solve::Solution {
    let stop = settings.start + cycles * (settings.stop - settings.start);
    Transient { stop, ..settings.clone() }.at(&[]).solve(system).unwrap()
}

/// Property. Waiting 200 cycles comes to the same state, with more than ten times the work.
#[test]
fn a_nonlinear_cycle_comes_to_the_state_that_waiting_comes_to() {
    let (system, nodes) = motor();
    let settings = cycle(PERIOD, 1e-8);
    let found = Periodic::find(&system, &settings).unwrap();
    let stop = 200.0 * PERIOD;
    let waited =
        Transient { stop, ..settings }.at(&[40.0 * PERIOD, 60.0 * PERIOD]).solve(&system).unwrap();
    for node in nodes {
        let of = |state| temperature(&system, state, node);
        let off = of(&found.state) - of(waited.last_state());
        assert!(off.abs() < 1e-6, "{off:e}");
    }
    // scipy 1.17.1: newton_krylov on a cycle of solve_ivp (Radau, rtol 1e-11, atol 1e-9) comes to
    // these in 16 cycles
    for (node, kelvin) in nodes.into_iter().zip([385.896_158_8, 383.681_515_7, 375.107_371_4]) {
        let off = temperature(&system, &found.state, node) - kelvin;
        assert!(off.abs() < 1e-6, "{off:e}");
    }
    assert!(found.residual < 1e-8 && found.error < 1e-7);
    // what is left of the way after 60 cycles and after 40
    let left = |row: usize| {
        let end = temperature(&system, waited.last_state(), nodes[1]);
        waited.row(row)[1] - end
    };
    let rho = (left(2) / left(1)).powf(1.0 / 20.0);
    assert!((-10.2..-9.8).contains(&rho.ln().recip()), "{} cycles", rho.ln().recip());
    assert!((found.multiplier.unwrap() - rho).abs() < 0.03, "{:?} {rho}", found.multiplier);
    let works = [
        (found.steps, waited.statistics().steps),
        (found.flow_evaluations, waited.statistics().flow_evaluations),
    ];
    for (found, waited) in works {
        assert!(10 * found <= waited, "{found} {waited}");
    }
}

/// Property. A rod of 40 radiating cells: many slow modes.
#[test]
fn many_slow_modes_are_found_together() {
    let mut b = NetworkBuilder::new();
    let cells: Vec<NodeId> = (0..40)
        .map(|i| b.node(&format!("cell_{i}"), HeatCapacity(50.0), Temperature(AMBIENT)))
        .collect();
    let air = b.boundary("air", Temperature(AMBIENT));
    for (i, pair) in cells.windows(2).enumerate() {
        b.resistor(&format!("rod_{i}"), pair[0], pair[1], Conductance(4.0));
    }
    for (i, &cell) in cells.iter().enumerate() {
        radiation(&mut b, &format!("glow_{i}"), (cell, air), "0.002 m^2");
    }
    duty(&mut b, cells[0], 40.0, (30.0, 100.0));
    let system = system(b);
    let settings = cycle(100.0, 1e-6);
    let found = Periodic::find(&system, &settings).unwrap();
    let waited = waited(&system, &settings, 1000.0);
    let off = found.state.distance(waited.last_state());
    assert!(off < 1e-4, "{off:e}");
    assert!(20 * found.steps < waited.statistics().steps);
}

/// Regression. A wall that hardly forgets anything while it is cold and much when it glows, behind
/// a coil that follows at once: long steps throw the coil far off, and did so again and again.
#[test]
fn a_furnace_that_starts_cold_is_found() {
    let mut b = NetworkBuilder::new();
    let coil = b.node("coil", HeatCapacity(2e3), Temperature(AMBIENT));
    let wall = b.node("wall", HeatCapacity(150e3), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    radiation(&mut b, "inside", (coil, wall), "0.08 m^2");
    radiation(&mut b, "outside", (wall, air), "0.18 m^2");
    duty(&mut b, coil, 12e3, (30.0, 40.0));
    let system = system(b);
    let settings = cycle(40.0, 1e-7);
    let found = Periodic::find(&system, &settings).unwrap();
    let waited = waited(&system, &settings, 2000.0);
    // the errors of the steps of 80 remembered cycles add up
    let off = found.state.distance(waited.last_state());
    assert!(off < 1e-4, "{off:e}");
    assert!(10 * found.steps < waited.statistics().steps);
    // 9 kW leave on average; the wall hardly swings
    let wall = temperature(&system, &found.state, wall);
    let mean = (9e3 / (0.18 * elements::SIGMA) + AMBIENT.powi(4)).powf(0.25);
    assert!((wall - mean).abs() < 1.5, "{wall} {mean}");
}

/// Property. Wax that melts and freezes in every cycle: its temperature does not tell its state.
#[test]
fn melting_and_freezing_in_every_cycle_comes_to_what_waiting_comes_to() {
    let mut b = NetworkBuilder::new();
    let melting = Melting {
        solidus: Temperature(320.0).into(),
        liquidus: Temperature(320.0).into(),
        heat: quantity("200 kJ/kg"),
    };
    let cp = Some(quantity("2000 J/(kg K)"));
    let wax = b.material("wax", Properties { cp, melting: Some(melting), ..Properties::default() });
    let lump = b.lump(wax, Size::Mass(quantity("0.1 kg"))).unwrap();
    let node = b.node("pack", lump, Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    b.resistor("skin", node, air, Conductance(1.0));
    duty(&mut b, node, 60.0, (1000.0, 2500.0));
    let system = system(b);
    let settings = cycle(2500.0, 1e-6);
    let found = Periodic::find(&system, &settings).unwrap();
    let waited = waited(&system, &settings, 60.0);
    let off = found.state.distance(waited.last_state());
    assert!(off < 1e-4, "{off:e}");
}

#[test]
fn what_leads_nowhere_keeps_its_energy_or_is_refused() {
    let adiabatic = |text: &str| {
        let mut b = NetworkBuilder::new();
        let a = b.node("a", HeatCapacity(100.0), Temperature(310.0));
        let c = b.node("c", HeatCapacity(300.0), Temperature(290.0));
        b.resistor("between", a, c, Conductance(2.0));
        let heat = power(&b, text);
        b.source("pump", a, heat);
        (system(b), [a, c])
    };
    let (system, [a, c]) = adiabatic("50 [W] * sin(2 * pi * t / 100 [s])");
    let found = Periodic::find(&system, &cycle(100.0, 1e-8)).unwrap();
    // the mean stays: 100 x 310 + 300 x 290 = 400 x 295
    let of = |node| temperature(&system, &found.state, node);
    assert!((100.0 * of(a) + 300.0 * of(c) - 118_000.0).abs() < 1e-6);
    // d = T_a - T_c obeys d' = 0.5 sin wt - d / 37.5: d(0) = -0.5 w / (1 / 37.5^2 + w^2)
    let w = TAU / 100.0;
    assert!((of(a) - of(c) + 0.5 * w / (37.5_f64.powi(-2) + w * w)).abs() < 1e-6);

    let (system, nodes) = adiabatic("3 [W] + 50 [W] * sin(2 * pi * t / 100 [s])");
    let error = Periodic::find(&system, &cycle(100.0, 1e-5)).unwrap_err();
    let PeriodicError::NoBalance { nodes: found, heat, names } = &error else {
        panic!("{error:?}")
    };
    assert_eq!((found.as_slice(), names.len()), (nodes.as_slice(), 2));
    assert!((heat - 300.0).abs() < 1e-3, "{heat}");
    assert_eq!(error.code(), "periodic::no_balance");
    assert!(error.to_string().contains("300") && error.help().is_some(), "{error}");
}

#[test]
fn inputs_that_do_not_repeat_are_refused() {
    let refused = |text: &str, after: AfterEnd, period: f64| {
        let mut b = NetworkBuilder::new();
        let course =
            Course::Steps { times: vec![0.0, 30.0, 100.0], values: vec![9.0, 0.0, 9.0], after };
        b.signal("duty", of(Dimension::POWER), course);
        let node = b.node("node", HeatCapacity(100.0), Temperature(AMBIENT));
        let air = b.boundary("air", Temperature(AMBIENT));
        b.resistor("skin", node, air, Conductance(0.5));
        let heat = power(&b, text);
        b.source("load", node, heat);
        match Periodic::find(&system(b), &cycle(period, 1e-5)) {
            Err(PeriodicError::NotPeriodic(found)) => Some(found),
            Ok(_) => None,
            Err(other) => panic!("{other:?}"),
        }
    };
    let repeat = AfterEnd::Repeat(100.0);
    for (text, period) in [
        ("duty", 100.0),
        ("duty", 300.0),
        ("duty * sin(2 * pi * t / 50 [s])", 100.0),
        ("if(duty > 4 [W], 1 [W], 2 [W])", 100.0),
        ("5 [W]", 17.0),
        ("duty * (1 - kelvin(T) / 1e6 [K])", 100.0),
    ] {
        assert_eq!(refused(text, repeat, period), None, "{text}");
    }
    for (text, after, period) in [
        ("duty", repeat, 90.0),
        ("duty", repeat, 50.0),
        ("duty", AfterEnd::Hold, 100.0),
        ("t * 1 [W/s]", repeat, 100.0),
        ("duty + t * 1e-6 [W/s]", repeat, 100.0),
        ("duty * sin(2 * pi * t / 51 [s])", repeat, 100.0),
        ("if(t > 150 [s], 1 [W], 2 [W])", repeat, 100.0),
        ("max(kelvin(T) / 320 [K] - 1, 0) * t * 1 [W/s]", repeat, 100.0),
    ] {
        let found = refused(text, after, period).unwrap_or_else(|| panic!("{text}"));
        let [now, then] = found.values.map(Option::unwrap);
        assert!(
            (now - then).abs() > 1e-7
                && found.name == "load"
                && found.period.to_bits() == period.to_bits()
        );
        assert!((0.0..=period).contains(&found.time), "{found:?}");
    }
    let ends = refused("duty", AfterEnd::Error, 100.0).unwrap();
    assert_eq!(ends.values[1], None);
    let error = PeriodicError::NotPeriodic(ends);
    assert_eq!(error.code(), "periodic::not_periodic");
    assert!(
        error.help().unwrap().contains("after_end") && error.to_string().contains("nothing"),
        "{error}"
    );
}

#[test]
fn an_observer_may_interrupt_the_search() {
    let (system, _) = motor();
    let mut steps = 0;
    let outcome = Periodic::find_observed(&system, &cycle(PERIOD, 1e-5), &mut |_| {
        steps += 1;
        if steps == 400 { Proceed::Interrupt } else { Proceed::Continue }
    });
    let error = outcome.unwrap_err();
    assert!(
        matches!(error, PeriodicError::Interrupted { cycles, residual: Some(_) } if cycles > 1),
        "{error:?}"
    );
}

#[test]
fn a_network_without_state_needs_no_search() {
    let mut b = NetworkBuilder::new();
    let shield = b.massless("shield");
    let (hot, cold) =
        (b.boundary("hot", Temperature(400.0)), b.boundary("cold", Temperature(AMBIENT)));
    b.resistor("in", hot, shield, Conductance(1.0));
    b.resistor("out", shield, cold, Conductance(3.0));
    let system = system(b);
    let found = Periodic::find(&system, &cycle(100.0, 1e-5)).unwrap();
    assert_eq!((found.method, found.cycles), (CycleMethod::Stateless, 1));
    assert!((found.solution.row(0)[0] - 325.0).abs() < 1e-9);
}

/// A start that is far from its periodic state but hardly moves in one cycle is not taken for it.
#[test]
fn a_small_residual_of_a_slow_network_is_not_believed() {
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(1e6), Temperature(AMBIENT));
    let air = b.boundary("air", Temperature(AMBIENT));
    let h = link(&b, "1 [W/(m^2 K)] + 1e-3 [W/(m^2 K^2)] * abs(dT)");
    b.convection("film", node, air, Path::film(h, quantity("1 m^2")));
    duty(&mut b, node, 0.02, (5.0, 10.0));
    let system = system(b);
    let found = Periodic::find(&system, &cycle(10.0, 1e-5)).unwrap();
    // x (1 + 0.001 x) = 0.01 on average, to a ripple of 1e-7 K
    let exact = (-1.0 + (1.0 + 4e-3 * 0.01_f64).sqrt()) / 2e-3;
    let off = temperature(&system, &found.state, node) - AMBIENT - exact;
    assert!(off.abs() <= found.error + 1e-4, "{off:e} {:e}", found.error);
}

/// With six digits where these tell the values apart, with all where they do not.
#[test]
fn values_that_do_not_repeat_are_told_apart() {
    let mut b = NetworkBuilder::new();
    let item = lptn_network::Item::Node(b.node("node", HeatCapacity(1.0), Temperature(300.0)));
    let said = |now: f64, then: f64| {
        let (field, name) = (lptn_network::Field::Temperature, "node".to_owned());
        let values = [Some(now), Some(then)];
        let found = NotPeriodic {
            item,
            field,
            name,
            time: 2.0,
            period: 10.0,
            values,
            unit: Some("W".into()),
        };
        PeriodicError::NotPeriodic(found).to_string()
    };
    let apart = said(1.0 / 3.0, 2.0);
    assert!(apart.contains("0.333333 W") && apart.contains("2 W one period of 10 s"), "{apart}");
    let alike = said(1.0, 1.000_000_25);
    assert!(alike.contains("is 1 W") && alike.contains("1.00000025 W"), "{alike}");
}
