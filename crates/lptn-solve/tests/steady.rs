//! Analytic and diagnostics: steady states of nonlinear networks, from anywhere, and the answer
//! where there is none.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::elements_helper as elements;

use elements::{Random, SIGMA, link, own, power, quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, End, Formula, HeatCapacity, HeatFlow, Melting, NetworkBuilder, NodeId, Path,
    Properties, Size, Temperature,
};
use lptn_solve::{SteadyError, SteadyState};

fn steady(system: &ThermalSystem) -> SteadyState {
    SteadyState::solve(system, 0.0).unwrap_or_else(|e| panic!("{}: {e}", e.code()))
}

fn refused(system: &ThermalSystem) -> SteadyError {
    let found = SteadyState::solve(system, 0.0);
    found.map(|s| s.state.temperatures).expect_err("there is no steady state to report")
}

/// A chain of nodes that radiate to each other and lose heat to two boundaries.
fn glowing(starts: &[f64]) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let (sky, room) = (b.boundary("sky", Temperature(4.0)), b.boundary("room", Temperature(300.0)));
    let nodes: Vec<NodeId> = starts
        .iter()
        .enumerate()
        .map(|(i, t)| match i % 3 {
            2 => b.massless(&format!("n{i}")),
            _ => b.node(&format!("n{i}"), HeatCapacity(10.0), Temperature(*t)),
        })
        .collect();
    for (i, pair) in nodes.windows(2).enumerate() {
        radiation(&mut b, &format!("g{i}"), (pair[0], pair[1]), "0.2 m^2");
        b.resistor(&format!("r{i}"), pair[0], pair[1], Conductance(0.01));
    }
    radiation(&mut b, "out", (nodes[0], sky), "0.01 m^2");
    b.resistor("foot", nodes[starts.len() - 1], room, Conductance(0.1));
    b.source("fire", nodes[starts.len() / 2], HeatFlow(2000.0));
    system(b)
}

#[test]
fn the_start_does_not_matter() {
    let mut random = Random(3);
    let reference = steady(&glowing(&[300.0; 9])).state.temperatures;
    for _ in 0..30 {
        let starts: Vec<f64> = (0..9).map(|_| random.between(50.0, 2000.0)).collect();
        let found = steady(&glowing(&starts)).state.temperatures;
        for (a, b) in found.iter().zip(&reference) {
            assert!((a - b).abs() < 1e-8, "{found:?} {reference:?} from {starts:?}");
        }
    }
}

#[test]
fn strong_radiation_is_found_from_cold_and_from_absolute_zero() {
    for start in [0.0, 1.0, 50.0, 300.0, 20_000.0] {
        let mut b = NetworkBuilder::new();
        let ball = b.node("ball", HeatCapacity(1.0), Temperature(start));
        let skin = b.massless("skin");
        let space = b.boundary("space", Temperature(0.0));
        b.source("fire", ball, HeatFlow(SIGMA * 5000.0_f64.powi(4)));
        radiation(&mut b, "inner", (ball, skin), "1 m^2");
        radiation(&mut b, "outer", (skin, space), "1 m^2");
        let found = steady(&system(b)).state.temperatures;
        assert!((found[1] - 5000.0).abs() < 1e-8, "{found:?} from {start}");
        assert!((found[0] - 5000.0 * 2.0_f64.powf(0.25)).abs() < 1e-8, "{found:?} from {start}");
    }
}

#[test]
fn a_network_at_one_temperature_is_at_rest() {
    // regression: nothing flows but the last digits, which did not balance
    let mut b = NetworkBuilder::new();
    let (a, c) = (b.node("a", HeatCapacity(1.0), Temperature(351.0)), b.massless("c"));
    let room = b.boundary("room", Temperature(300.1));
    radiation(&mut b, "inner", (a, c), "1 m^2");
    radiation(&mut b, "outer", (c, room), "3 m^2");
    stream(&mut b, "in", (room, c), quantity("7 W/K"));
    let found = steady(&system(b)).state.temperatures;
    assert!(found.iter().all(|t| (t - 300.1).abs() < 1e-9), "{found:?}");
}

#[test]
fn a_network_on_a_small_conductance_is_solved_to_its_rounding() {
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> =
        (0..40).map(|i| b.node(&format!("n{i}"), HeatCapacity(1.0), Temperature(300.0))).collect();
    let room = b.boundary("room", Temperature(300.0));
    for (i, pair) in nodes.windows(2).enumerate() {
        b.resistor(&format!("r{i}"), pair[0], pair[1], Conductance(1e4));
    }
    radiation(&mut b, "glow", (nodes[3], room), "1e-6 m^2");
    b.resistor("foot", nodes[0], room, Conductance(1e-5));
    b.source("heater", nodes[39], HeatFlow(1e-3));
    let found = steady(&system(b));
    let t = found.temperatures[0] - 300.0;
    let out = 1e-5 * t + SIGMA * 1e-6 * (found.temperatures[3].powi(4) - 300.0_f64.powi(4));
    assert!((out - 1e-3).abs() < 1e-8, "{out}");
}

#[test]
fn thermal_runaway_is_no_steady_state() {
    // P = 10 exp((T - 300) / 20): at G = 1 W/K the most that could be carried off is at exp = 2, 20
    // W < 10 + ..
    let mut b = NetworkBuilder::new();
    let cell = b.node("cell", HeatCapacity(100.0), Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", cell, room, Conductance(1.0));
    let p = power(&b, "10 [W] * exp((T - absolute(300 [K])) / 20 [K])");
    b.source("reaction", cell, p);
    let error = refused(&system(b));
    assert_eq!(error.code(), "steady::runaway");
    // from 10/20 exp((T - 300) / 20) = 1 on
    let lptn_solve::SteadyError::Runaway { node, source, from, rests: None } = &error else {
        panic!("{error}")
    };
    assert_eq!((node.as_str(), source.as_str()), ("cell", "reaction"));
    assert!((from - (300.0 + 20.0 * 2f64.ln())).abs() < 1e-6, "{error}");
}

/// Two steady states: x = 2 exp(x / 10) has a stable root near 2.59 and an unstable one near 25.4.
fn ignition(start: f64) -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let cell = b.node("cell", HeatCapacity(100.0), Temperature(300.0 + start));
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", cell, room, Conductance(1.0));
    let p = power(&b, "2 [W] * exp((T - absolute(300 [K])) / 10 [K])");
    b.source("reaction", cell, p);
    system(b)
}

fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let sign = f(low).signum();
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle).signum() * sign > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn an_unstable_steady_state_is_never_reported() {
    let stable = root(0.0, 10.0, |x| 2.0 * (x / 10.0).exp() - x);
    for start in [0.0, 5.0, 10.0, 15.0, 20.0, 24.0, 25.0, 26.0, 27.0, 30.0, 50.0, 200.0] {
        match SteadyState::solve(&ignition(start), 0.0) {
            Ok(found) => {
                let x = found.temperatures[0] - 300.0;
                assert!((x - stable).abs() < 1e-8, "{x} from {start}");
            }
            Err(error) => {
                assert!(start > 25.0, "{error} from {start}");
                assert!(error.to_string().contains("cell"), "{error}");
            }
        }
    }
}

#[test]
fn an_unstable_loop_of_nodes_that_act_on_each_other_is_found_out() {
    // each heats the other by more than both lose: stable alone, unstable together; warming cools
    // nothing here, and in the second network one is cooled where the other warms, which is a slow
    // growing oscillation with a delay of three
    for (first, stable) in [("1.5 [W/K]", false), ("0.5 [W/K]", true)] {
        let mut b = NetworkBuilder::new();
        let ids = ["a", "c"].map(|n| b.node(n, HeatCapacity(10.0), Temperature(301.0)));
        let room = b.boundary("room", Temperature(300.0));
        for (i, id) in ids.iter().enumerate() {
            b.resistor(&format!("r{i}"), *id, room, Conductance(1.0));
            let other = ["c", "a"][i];
            let p = power(&b, &format!("{first} * ({other}.T - absolute(300 [K]))"));
            b.source(&format!("p{i}"), *id, p);
        }
        assert_eq!(SteadyState::solve(&system(b), 0.0).is_ok(), stable, "{first}");
    }
    // x_i' = -x_i - g x_(i-1) in a ring of three: unstable for g > 2 (the secant condition, 1 /
    // cos^3(pi / 3) = 8 for the product)
    for (gain, stable) in [("2.2 [W/K]", false), ("1.8 [W/K]", true)] {
        let mut b = NetworkBuilder::new();
        let names = ["a", "c", "d"];
        let ids = names.map(|n| b.node(n, HeatCapacity(10.0), Temperature(301.0)));
        let room = b.boundary("room", Temperature(300.0));
        for (i, id) in ids.iter().enumerate() {
            b.resistor(&format!("r{i}"), *id, room, Conductance(1.0));
            let p = power(&b, &format!("-{gain} * ({}.T - absolute(300 [K]))", names[(i + 2) % 3]));
            b.source(&format!("p{i}"), *id, p);
        }
        let found = SteadyState::solve(&system(b), 0.0).map(|s| s.state.temperatures);
        assert_eq!(found.is_ok(), stable, "{gain}: {found:?}");
    }
}

#[test]
fn zero_flow_that_strands_a_massless_node_names_it() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature(300.0));
    let cell = b.massless("cell");
    let rate = link(&b, "3 [W/K] * t / 1 [s]");
    stream(&mut b, "pipe", (inlet, cell), rate);
    let error = refused(&system(b));
    assert_eq!(error.code(), "solve::undetermined");
    assert!(error.to_string().contains("`cell`"), "{error}");
}

#[test]
fn a_closed_loop_of_streams_mixes_to_its_mean() {
    let mut b = NetworkBuilder::new();
    let starts = [400.0, 300.0, 350.0];
    let capacities = [100.0, 300.0, 50.0];
    let nodes: Vec<NodeId> = (0..3)
        .map(|i| b.node(&format!("n{i}"), HeatCapacity(capacities[i]), Temperature(starts[i])))
        .collect();
    for i in 0..3 {
        stream(&mut b, &format!("s{i}"), (nodes[i], nodes[(i + 1) % 3]), quantity("5 W/K"));
    }
    let mean = starts.iter().zip(capacities).map(|(t, c)| t * c).sum::<f64>() / 450.0;
    let found = steady(&system(b)).state.temperatures;
    assert!(found.iter().all(|t| (t - mean).abs() < 1e-8), "{found:?} {mean}");
}

#[test]
fn streams_in_a_loop_that_do_not_balance_are_no_island_at_rest() {
    let mut b = NetworkBuilder::new();
    let nodes: Vec<NodeId> = (0..2)
        .map(|i| b.node(&format!("n{i}"), HeatCapacity(1.0), Temperature(300.0 + f64::from(i))))
        .collect();
    stream(&mut b, "there", (nodes[0], nodes[1]), quantity("5 W/K"));
    stream(&mut b, "back", (nodes[1], nodes[0]), quantity("4 W/K"));
    let error = refused(&system(b));
    assert_eq!(error.code(), "solve::undetermined", "{error}");
}

#[test]
fn a_loop_with_a_cooler_is_balanced() {
    // pump loop: hot (100 W) -> cold -> hot, 20 W/K; cold loses 4 W/K to 300 K
    let mut b = NetworkBuilder::new();
    let hot = b.massless("hot");
    let cold = b.massless("cold");
    let room = b.boundary("room", Temperature(300.0));
    stream(&mut b, "there", (hot, cold), quantity("20 W/K"));
    stream(&mut b, "back", (cold, hot), quantity("20 W/K"));
    b.convection("cooler", cold, room, Conductance(4.0));
    b.source("heater", hot, HeatFlow(100.0));
    let found = steady(&system(b));
    assert!(
        (found.temperatures[0] - 330.0).abs() < 1e-9
            && (found.temperatures[1] - 325.0).abs() < 1e-9
    );
    assert!((found.boundary_heat[0] + 100.0).abs() < 1e-8, "{:?}", found.boundary_heat);
}

#[test]
fn counterflow_cells_have_the_effectiveness_of_their_number() {
    // N cells a side, equal capacity rates m, UA / N a cell pair: between outlets the balance of a
    // pair gives a constant difference d, and the hot side falls by a d / (1 + a) .. each cell,
    // with a = UA / (N m)
    let (n, m, ua) = (20_u32, 10.0, 40.0);
    let mut b = NetworkBuilder::new();
    let (hot_in, cold_in) =
        (b.boundary("hot_in", Temperature(400.0)), b.boundary("cold_in", Temperature(300.0)));
    let hot: Vec<NodeId> = (0..n).map(|i| b.massless(&format!("h{i}"))).collect();
    let cold: Vec<NodeId> = (0..n).map(|i| b.massless(&format!("c{i}"))).collect();
    let g = ua / f64::from(n);
    for i in 0..n as usize {
        let from: End = if i == 0 { hot_in.into() } else { hot[i - 1].into() };
        stream(&mut b, &format!("hs{i}"), (from, hot[i]), quantity("10 W/K"));
        let from: End = if i + 1 == n as usize { cold_in.into() } else { cold[i + 1].into() };
        stream(&mut b, &format!("cs{i}"), (from, cold[i]), quantity("10 W/K"));
        b.convection(&format!("wall{i}"), hot[i], cold[i], Conductance(g));
    }
    // every pair exchanges q = g d with the same d: hot[i] = 400 - (i + 1) q / m, cold[i] = 300 +
    // (n - i) q / m
    let a = g / m;
    let d = 100.0 / (1.0 + a * f64::from(n + 1));
    let found = steady(&system(b)).state.temperatures;
    for i in 0..n as usize {
        let exact = 400.0 - (i as f64 + 1.0) * a * d;
        assert!(
            (found[hot[i].index()] - exact).abs() < 1e-9,
            "{i}: {} {exact}",
            found[hot[i].index()]
        );
        let exact = 300.0 + (f64::from(n) - i as f64) * a * d;
        assert!(
            (found[cold[i].index()] - exact).abs() < 1e-9,
            "{i}: {} {exact}",
            found[cold[i].index()]
        );
    }
}

#[test]
fn two_islands_keep_an_energy_each() {
    let mut b = NetworkBuilder::new();
    let node = |b: &mut NetworkBuilder, name: &str, c: f64, t: f64| {
        b.node(name, HeatCapacity(c), Temperature(t))
    };
    let (a, c) = (node(&mut b, "a", 100.0, 900.0), node(&mut b, "c", 300.0, 100.0));
    let (d, e) = (node(&mut b, "d", 10.0, 500.0), node(&mut b, "e", 10.0, 700.0));
    let f = node(&mut b, "f", 1.0, 50.0);
    let room = b.boundary("room", Temperature(280.0));
    radiation(&mut b, "ac", (a, c), "0.02 m^2");
    b.resistor("de", d, e, Conductance(0.5));
    radiation(&mut b, "f_room", (f, room), "0.02 m^2");
    b.source("up", d, HeatFlow(20.0));
    b.source("down", e, HeatFlow(-20.0));
    let found = steady(&system(b));
    let t = &found.temperatures;
    assert!((t[0] - 300.0).abs() < 1e-8 && (t[1] - 300.0).abs() < 1e-8, "{t:?}");
    // 20 W over 0.5 W/K: 40 K apart around 600 K
    assert!((t[2] - 620.0).abs() < 1e-8 && (t[3] - 580.0).abs() < 1e-8, "{t:?}");
    assert!((t[4] - 280.0).abs() < 1e-8, "{t:?}");
    assert_eq!(found.adiabatic, [a, c, d, e]);
}

#[test]
fn an_island_with_a_source_has_no_rest() {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(100.0), Temperature(300.0));
    let c = b.node("c", HeatCapacity(100.0), Temperature(300.0));
    radiation(&mut b, "ac", (a, c), "0.02 m^2");
    b.source("heater", a, HeatFlow(1.0));
    let error = refused(&system(b));
    assert_eq!(error.code(), "steady::no_boundary");
}

#[test]
fn an_island_with_a_source_that_ends_by_itself_rests() {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(100.0), Temperature(300.0));
    let c = b.node("c", HeatCapacity(100.0), Temperature(290.0));
    radiation(&mut b, "ac", (a, c), "0.02 m^2");
    let p = power(&b, "2 [W/K] * (absolute(350 [K]) - T)");
    b.source("heater", a, p);
    let found = steady(&system(b)).state.temperatures;
    assert!(found.iter().all(|t| (t - 350.0).abs() < 1e-6), "{found:?}");
}

#[test]
fn an_island_whose_capacity_grows_manyfold_rests_where_its_energy_leads() {
    // regression: the capacity at the start led away from it. C_a = 10 exp((T - 300) / 50): H_a =
    // 500 (exp(..) - 1)
    let mut b = NetworkBuilder::new();
    let capacity = own(&b, "10 [J/K] * exp((T - absolute(300 [K])) / 50 [K])");
    let a = b.node("a", capacity, Temperature(300.0));
    let c = b.node("c", HeatCapacity(100.0), Temperature(900.0));
    b.resistor("ac", a, c, Conductance(1.0));
    let end =
        root(300.0, 900.0, |t| 500.0 * (((t - 300.0) / 50.0).exp() - 1.0) + 100.0 * (t - 900.0));
    let found = steady(&system(b)).state.temperatures;
    assert!(found.iter().all(|t| (t - end).abs() < 1e-7), "{found:?} {end}");
}

fn wax(b: &mut NetworkBuilder, liquidus: f64) -> lptn_network::MaterialId {
    let melting = Melting {
        solidus: Temperature(330.0).into(),
        liquidus: Temperature(liquidus).into(),
        heat: quantity("200 kJ/kg"),
    };
    let cp = Some(quantity("2000 J/(kg K)"));
    b.material("wax", Properties { cp, melting: Some(melting), ..Properties::default() })
}

#[test]
fn an_island_that_melts_in_part_rests_at_the_melting_point() {
    // 1 kg of wax from 300 K with 1000 J/K of iron at 450 K: 60 kJ to 330 K, 60 kJ of the 200 kJ
    // melt, iron at 330 K
    for (liquidus, exact) in [(330.0, 330.0), (340.0, f64::NAN)] {
        let mut b = NetworkBuilder::new();
        let wax = wax(&mut b, liquidus);
        let lump = b.lump(wax, Size::Mass(quantity("1 kg"))).unwrap();
        let a = b.node("a", lump, Temperature(300.0));
        let c = b.node("c", HeatCapacity(1000.0), Temperature(450.0));
        b.resistor("ac", a, c, Conductance(1.0));
        // over 10 K: 2000 (T - 300) + 20000 (T - 330) = 1000 (450 - T)
        let exact = if exact.is_nan() { (450e3 + 600e3 + 6.6e6) / 23e3 } else { exact };
        let found = steady(&system(b)).state.temperatures;
        assert!(found.iter().all(|t| (t - exact).abs() < 1e-8), "{found:?} {exact}");
    }
}

#[test]
fn conductivity_of_temperature_in_a_wall_of_cells() {
    // Kirchhoff: the integral of k = 10 (1 + (T - 300) / 200) is linear across the wall
    let mut b = NetworkBuilder::new();
    let (hot, cold) =
        (b.boundary("hot", Temperature(600.0)), b.boundary("cold", Temperature(300.0)));
    let nodes: Vec<NodeId> = (0..9).map(|i| b.massless(&format!("n{i}"))).collect();
    let mut ends: Vec<End> = vec![hot.into()];
    ends.extend(nodes.iter().map(|n| End::from(*n)));
    ends.push(cold.into());
    for (i, pair) in ends.windows(2).enumerate() {
        let k = own(&b, "10 [W/(m K)] * (1 + (T - absolute(300 [K])) / 200 [K])");
        let shape = |k| Path::new(Formula::Slab, [k, quantity("1 m^2"), quantity("1 cm")]);
        let kind = lptn_network::ConductorKind::Conduction;
        b.conductor(&format!("k{i}"), kind, (pair[0], pair[1]), shape(k));
    }
    let integral = |t: f64| (t - 300.0) + (t - 300.0).powi(2) / 400.0;
    let found = steady(&system(b));
    for (i, t) in found.temperatures.iter().enumerate() {
        let exact = integral(600.0) * (1.0 - (i as f64 + 1.0) / 10.0);
        assert!((integral(*t) - exact).abs() < 1e-8, "{i}: {t}");
    }
    assert!((found.boundary_heat[0] - 10.0 * integral(600.0) / 0.1).abs() < 1e-6);
}

#[test]
fn ten_thousand_radiating_nodes_give_all_heat_to_space() {
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
    b.source("fire", nodes[0], HeatFlow(2000.0));
    let system = system(b);
    let found = steady(&system);
    assert!((found.boundary_heat[0] + 2000.0).abs() < 1e-6);
}

/// A body whose capacity is known up to 350 K would rest at 400 K with another one of its size.
#[test]
fn an_island_that_rests_where_no_capacity_is_known_is_refused() {
    let solved = |hot: f64| {
        let text = format!(
            "format = 1\n[table]\nc = {{ x = [250, 350], x_unit = \"K\", y = [\"10 J/K\", \"10 \
             J/K\"] }}\n[node]\na = {{ C = \
             \"c(T - absolute(0 [K]))\", T0 = \"absolute(300 [K])\" }}\nb = {{ C = \"10 J/K\", \
             T0 = \"absolute({hot} [K])\" \
             }}\n[resistor]\nlead = {{ from = \"a\", to = \"b\", G = \"1 W/K\" }}\n[run]\nstop = \
             \"1 s\"\n"
        );
        let netlist = lptn_netlist::parse("island.toml", &text).unwrap_or_else(|r| panic!("{r}"));
        SteadyState::solve(&ThermalSystem::assemble(&netlist.network).unwrap(), 0.0)
    };
    let found = solved(380.0).unwrap();
    assert!(
        found.temperatures.iter().all(|t| (t - 340.0).abs() < 1e-6),
        "{:?}",
        found.temperatures
    );
    let refused = solved(500.0).unwrap_err();
    assert!(refused.to_string().contains("`a`"), "{refused}");
}

/// Without capacities there is no way to follow: `2 W exp(x / 10 K) = 1 W/K x` at 2.59 K, where it
/// stays, and at 25.43 K, where it does not.
#[test]
fn a_joint_does_not_rest_where_nothing_stays() {
    let stable = root(0.0, 10.0, |x| 2.0 * (x / 10.0).exp() - x);
    for start in [0.0, 20.0, 23.0, 24.0] {
        let text = format!(
            "format = 1\n[node]\ncell = {{ massless = true, T0 = \"absolute({} [K])\" \
             }}\n[boundary]\nroom = {{ T = \
             \"absolute(300 [K])\" }}\n[resistor]\nskin = {{ from = \"cell\", to = \"room\", G = \
             \"1 W/K\" }}\n[source]\nheat = \
             {{ into = \"cell\", P = \"2 [W] * exp((T - absolute(300 [K])) / 10 [K])\" \
             }}\n[run]\nstop = \"1 s\"\n",
            300.0 + start
        );
        let netlist = lptn_netlist::parse("cell.toml", &text).unwrap_or_else(|r| panic!("{r}"));
        let found = SteadyState::solve(&ThermalSystem::assemble(&netlist.network).unwrap(), 0.0);
        let found = found.unwrap_or_else(|error| panic!("{start}: {error}")).temperatures[0];
        assert!((found - 300.0 - stable).abs() < 1e-8, "{found} from {start}");
    }
}
