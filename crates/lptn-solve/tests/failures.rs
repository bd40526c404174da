//! Diagnostics: runs that break off keep their rows, say when, and name the node and the element.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::elements_helper as elements;

use elements::{ABSOLUTE, link, of, own, power, quantity, radiation, stream, system, table};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    AfterEnd, BuildErrorKind, Conductance, ConductorKind, Course, Formula, HeatCapacity,
    NetworkBuilder, NodeId, Path, Temperature, Time,
};
use lptn_solve::{RunStatus, Solution, Transient, TransientError};
use lptn_units::{Dimension, Interpolation, Outside, Table1};

/// A run that has to break off: the time, the message, what was computed before.
fn broken(system: &ThermalSystem, stop: f64) -> (f64, String, &'static str, Solution) {
    let error = Transient::until(Time(stop))
        .solve(system)
        .map(|s| s.end())
        .expect_err("it has to break off");
    let (code, message) = (error.code(), error.to_string());
    match error {
        TransientError::Stopped { time, partial, .. } => {
            assert!(
                partial.times().len() > 1 && partial.times().iter().all(|t| *t <= time),
                "{time}"
            );
            assert!(matches!(partial.end(), RunStatus::Failed(at) if (at - time).abs() <= 0.0));
            for row in 0..partial.times().len() {
                assert!(partial.row(row).iter().all(|t| t.is_finite()), "row {row}");
            }
            (time, message, code, *partial)
        }
        other => panic!("{other}"),
    }
}

/// A node of 100 J/K at 300 K that 100 W heat by 1 K a second.
fn ramp() -> (NetworkBuilder, NodeId) {
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    b.source("heater", node, quantity("100 W"));
    (b, node)
}

#[test]
fn the_end_of_a_table_over_temperature() {
    let (mut b, node) = ramp();
    let types = (ABSOLUTE, of(Dimension::CONDUCTANCE));
    b.table("steps", table(&[290.0, 320.0], &[0.0, 1e-9], Interpolation::Linear, types));
    let room = b.boundary("room", Temperature(300.0));
    let g = link(&b, "steps(T_from)");
    b.resistor("wall", node, room, Path::conductance(g));
    let (time, message, code, partial) = broken(&system(b), 60.0);
    assert!((time - 20.0).abs() < 1e-2, "{time}");
    assert!(
        message.contains("`wall`") && message.contains("steps") && code == "solve::input",
        "{code} {message}"
    );
    assert!((100..=101).contains(&partial.times().len()), "a row every 0.2 s up to 20 s");
}

#[test]
fn the_end_of_a_signal() {
    for text in
        ["load", "max(0 [W], load)", "if(load > 5 [W], 10 [W], 20 [W])", "10 [W] + 0 * load"]
    {
        // regression: max(0, nothing) was 0, and nothing > 5 was false
        let mut b = NetworkBuilder::new();
        let points =
            Table1::new(vec![0.0, 10.0], vec![1.0, 9.0], Interpolation::Linear, Outside::Error)
                .unwrap();
        b.signal("load", of(Dimension::POWER), Course::Curve { points, after: AfterEnd::Error });
        let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
        let p = power(&b, text);
        b.source("heater", node, p);
        let (time, message, code, _) = broken(&system(b), 30.0);
        assert!((time - 10.0).abs() < 1e-6, "{text}: {time}");
        assert!(message.contains("`load`") && code == "solve::input", "{text}: {code} {message}");
    }
}

#[test]
fn a_signal_that_is_not_read_may_end() {
    let mut b = NetworkBuilder::new();
    let points =
        Table1::new(vec![0.0, 10.0], vec![1.0, 9.0], Interpolation::Linear, Outside::Error)
            .unwrap();
    b.signal("load", of(Dimension::POWER), Course::Curve { points, after: AfterEnd::Error });
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "if(t < 8 [s], load, 3 [W])");
    b.source("heater", node, p);
    Transient::until(Time(30.0)).solve(&system(b)).unwrap();
}

#[test]
fn an_error_is_not_put_down_to_a_signal_that_has_nothing_to_do_with_it() {
    // regression: any signal that had ended was blamed for what failed afterwards
    let mut b = NetworkBuilder::new();
    let points =
        Table1::new(vec![0.0, 5.0], vec![1.0, 9.0], Interpolation::Linear, Outside::Error).unwrap();
    b.signal("load", of(Dimension::POWER), Course::Curve { points, after: AfterEnd::Error });
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "if(t < 4 [s], load, 3 [W])");
    b.source("heater", node, p);
    let q = power(&b, "1 [W] * sqrt(10 - t / 1 [s])");
    b.source("root", node, q);
    let (time, message, _, _) = broken(&system(b), 30.0);
    assert!((time - 10.0).abs() < 0.5, "{time}");
    assert!(message.contains("`root`") && !message.contains("`load`"), "{message}");
}

#[test]
fn a_repeated_signal_has_no_past() {
    // regression: it was repeated backwards
    let mut b = NetworkBuilder::new();
    let points =
        Table1::new(vec![5.0, 10.0], vec![1.0, 9.0], Interpolation::Linear, Outside::Error)
            .unwrap();
    b.signal("load", of(Dimension::POWER), Course::Curve { points, after: AfterEnd::Repeat(6.0) });
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "load");
    b.source("heater", node, p);
    let error = Transient::until(Time(30.0)).solve(&system(b)).map(|s| s.end()).unwrap_err();
    assert!(error.to_string().contains("`load`") && error.to_string().contains("5 s"), "{error}");
}

#[test]
fn a_signal_that_repeats_beyond_reason_is_refused_at_once() {
    let mut b = NetworkBuilder::new();
    let points =
        Table1::new(vec![0.0, 1e-9], vec![1.0, 9.0], Interpolation::Linear, Outside::Error)
            .unwrap();
    b.signal("load", of(Dimension::POWER), Course::Curve { points, after: AfterEnd::Repeat(1e-9) });
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "load");
    b.source("heater", node, p);
    let error = Transient::until(Time(3600.0)).solve(&system(b)).map(|s| s.end()).unwrap_err();
    assert!(error.to_string().contains("`load`"), "{error}");
}

#[test]
fn points_that_are_none_are_refused_by_the_builder() {
    for (times, values) in [
        (vec![], vec![]),
        (vec![0.0, 1.0], vec![1.0]),
        (vec![1.0, 1.0], vec![1.0, 2.0]),
        (vec![0.0], vec![f64::NAN]),
    ] {
        let mut b = NetworkBuilder::new();
        b.node("node", HeatCapacity(100.0), Temperature(300.0));
        b.signal(
            "load",
            of(Dimension::POWER),
            Course::Steps { times, values, after: AfterEnd::Hold },
        );
        let errors = b.build().map(|_| ()).unwrap_err();
        assert!(
            errors.0.iter().any(|e| matches!(e.kind, BuildErrorKind::SignalPoints { .. })),
            "{errors}"
        );
    }
}

#[test]
fn a_capacity_that_ends() {
    let mut b = NetworkBuilder::new();
    let types = (ABSOLUTE, of(Dimension::CAPACITY));
    b.table("heat", table(&[290.0, 330.0], &[100.0, 100.0], Interpolation::Linear, types));
    let capacity = own(&b, "heat(T)");
    let node = b.node("node", capacity, Temperature(300.0));
    b.source("heater", node, quantity("100 W"));
    let (time, message, code, _) = broken(&system(b), 60.0);
    assert!((time - 30.0).abs() < 1e-2, "{time}");
    assert!(message.contains("`node`") && code == "solve::input", "{code} {message}");
}

#[test]
fn a_conductance_that_turns_negative() {
    let (mut b, node) = ramp();
    let room = b.boundary("room", Temperature(300.0));
    let g = link(&b, "1e-6 [W/K^2] * (absolute(315 [K]) - T_from)");
    b.resistor("wall", node, room, Path::conductance(g));
    let (time, message, code, _) = broken(&system(b), 60.0);
    assert!((time - 15.0).abs() < 1e-2, "{time}");
    assert!(
        message.contains("`wall`") && message.contains("negative") && code == "solve::input",
        "{code} {message}"
    );
}

#[test]
fn an_emissivity_that_passes_1() {
    // regression: it was taken as it came
    let (mut b, node) = ramp();
    let room = b.boundary("room", Temperature(300.0));
    let emissivity = link(&b, "0.99 + 1e-3 [1/K] * (T_from - absolute(300 [K]))");
    let surfaces =
        Path::new(Formula::GreySurfaces, [emissivity, quantity("1 mm^2"), quantity("1")]);
    b.conductor("glow", ConductorKind::Radiation, (node.into(), room.into()), surfaces);
    let (time, message, _, _) = broken(&system(b), 60.0);
    assert!((time - 10.0).abs() < 1e-2, "{time}");
    assert!(message.contains("`glow`") && message.contains("between 0 and 1"), "{message}");
}

#[test]
fn a_massless_node_that_is_stranded_when_the_flow_stops() {
    for (text, stop) in
        [("3 [W/K] * max(0, 1 - t / 10 [s])", 10.0), ("if(t < 10 [s], 3 [W/K], 0 [W/K])", 10.0)]
    {
        let mut b = NetworkBuilder::new();
        let (inlet, room) =
            (b.boundary("inlet", Temperature(350.0)), b.boundary("room", Temperature(300.0)));
        let cell = b.massless("cell");
        let tank = b.node("tank", HeatCapacity(100.0), Temperature(300.0));
        let rate = link(&b, text);
        stream(&mut b, "pipe", (inlet, cell), rate.clone());
        stream(&mut b, "pour", (cell, tank), rate);
        b.resistor("wall", tank, room, Conductance(0.1));
        let (time, message, code, _) = broken(&system(b), 30.0);
        assert!((time - stop).abs() < 1e-3, "{text}: {time}");
        assert!(
            message.contains("`cell`") && code == "solve::undetermined",
            "{text}: {code} {message}"
        );
    }
}

#[test]
fn a_heat_that_runs_away() {
    let mut b = NetworkBuilder::new();
    let cell = b.node("cell", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "10 [W] * exp((T - absolute(300 [K])) / 20 [K])");
    b.source("reaction", cell, p);
    // x = -20 ln(1 - t / 200): infinite at 200 s
    let (time, message, code, _) = broken(&system(b), 300.0);
    assert!((time - 200.0).abs() < 1e-2, "{time}");
    assert!(message.contains("cell") || message.contains("reaction"), "{code} {message}");
}

#[test]
fn a_massless_node_without_a_solution() {
    // the junction takes in 1 W/K (T_body - T) and makes 5 W exp(..): from some temperature of the
    // body on there is no rest
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(100.0), Temperature(300.0));
    let tip = b.massless("tip");
    b.resistor("wire", body, tip, Conductance(1.0));
    b.source("heater", body, quantity("100 W"));
    let p = power(&b, "5 [W] * exp((T - absolute(300 [K])) / 20 [K])");
    b.source("arc", tip, p);
    let (_, message, code, _) = broken(&system(b), 300.0);
    assert!(message.contains("`tip`") || message.contains("`arc`"), "{code} {message}");
}

#[test]
fn a_thousand_nodes_of_one_capacity_have_it_each_at_its_own_start() {
    for text in ["20 [J/K] * exp((T - 20 [degC]) / 150 [K])", "heat(T)"] {
        let mut b = NetworkBuilder::new();
        let (x, y): (Vec<f64>, Vec<f64>) =
            (0..50).map(|i| (200.0 + 20.0 * f64::from(i), 10.0 + f64::from(i % 7))).unzip();
        b.table("heat", table(&x, &y, Interpolation::Pchip, (ABSOLUTE, of(Dimension::CAPACITY))));
        for i in 0..1000 {
            let capacity = own(&b, text);
            b.node(&format!("n{i}"), capacity, Temperature(300.0 + 0.05 * f64::from(i)));
        }
        let network = b.build().unwrap();
        for (id, i) in network.node_ids().zip(0..) {
            let (start, curve) = (300.0 + 0.05 * f64::from(i), network.enthalpy(id).unwrap());
            assert!(curve.heat(start).unwrap().abs() < 1e-9, "the heat content is 0 at the start");
            let exact = 20.0 * ((start - 293.15) / 150.0).exp();
            assert!(text == "heat(T)" || (network.capacity(id) / exact - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn ten_thousand_radiating_nodes_run_and_their_books_close() {
    let mut b = NetworkBuilder::new();
    let side = 100;
    let nodes: Vec<NodeId> = (0..side * side)
        .map(|i| b.node(&format!("n{i}"), HeatCapacity(10.0), Temperature(300.0)))
        .collect();
    let space = b.boundary("space", Temperature(4.0));
    for y in 0..side {
        for x in 0..side {
            let i = y * side + x;
            if x + 1 < side {
                b.resistor(&format!("x{i}"), nodes[i], nodes[i + 1], Conductance(1.0));
            }
            if y + 1 < side {
                b.resistor(&format!("y{i}"), nodes[i], nodes[i + side], Conductance(1.0));
            }
            radiation(&mut b, &format!("g{i}"), (nodes[i], space), "0.01 m^2");
        }
    }
    b.source("fire", nodes[0], quantity("2000 W"));
    let system = system(b);
    let found = Transient::until(Time(100.0)).tolerance(1e-3).solve(&system).unwrap();
    assert!(found.ledger().closes());
}

/// A body that radiates, with an energy balance that has to close to so much of its heat.
fn books(share: Option<f64>, interrupt: bool) -> Result<Solution, TransientError> {
    let error = share.map_or(String::new(), |share| format!("balance_error = {share:?}\n"));
    let text = format!(
        "format = 1\n[node]\nball = {{ C = \"500 J/K\", T0 = \"absolute(900 [K])\" \
         }}\n[boundary]\nspace = {{ T = \"absolute(4 \
         [K])\" }}\n[radiation]\nglow = {{ from = \"ball\", to = \"space\", emissivity = \"1\", \
         area = \"0.05 m^2\" \
         }}\n[run]\nstop = \"100 s\"\n{error}"
    );
    let netlist = lptn_netlist::parse("books.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let settings = Transient::of(&netlist.network, netlist.run.as_ref().unwrap());
    settings.solve_observed(&system, &mut |progress| match interrupt && progress.time > 50.0 {
        true => lptn_solve::Proceed::Interrupt,
        false => lptn_solve::Proceed::Continue,
    })
}

/// The share that is allowed is the one that is asked for, and nobody claims it of half a run.
#[test]
fn books_have_to_close_as_far_as_is_asked_for_at_the_end() {
    for interrupt in [false, true] {
        let solution = books(None, interrupt).unwrap();
        assert!(solution.ledger().closes());
        let solution = books(Some(0.5), interrupt).unwrap();
        assert!(solution.ledger().closes());
    }
    match books(Some(1e-18), false) {
        Err(TransientError::Open { solution, .. }) => {
            assert_eq!(solution.end(), RunStatus::Reached)
        }
        other => panic!("{:?}", other.map(|solution| solution.end())),
    }
    let half = books(Some(1e-18), true).unwrap();
    assert!(!half.ledger().closes() && matches!(half.end(), RunStatus::Interrupted(_)));
}
