//! Steady states and transients against closed forms written out here, not taken from the library.

use crate::support;

use lptn::prelude::*;
use lptn_network::{Area, FilmCoefficient, NodeId, Path};
use support::{assembled, shipped, transient};

/// `tests/validation` case "gearbox_two_node": the closed form of the two-node network, steel then
/// aluminium.
const GEARBOX: [(f64, f64, f64); 6] = [
    (5.0, 26.219_503_974_350_72, 25.649_934_038_029_055),
    (60.0, 30.835_742_645_040_536, 29.877_325_028_382_21),
    (300.0, 46.974_438_777_062_55, 45.822_557_783_442_73),
    (810.0, 68.645_990_240_062_73, 67.234_329_181_706_22),
    (1500.0, 82.613_154_474_351_82, 81.034_066_970_539_07),
    (3600.0, 91.983_775_885_421_79, 90.292_361_368_891_62),
];

fn celsius(kelvin: f64) -> f64 {
    kelvin - 273.15
}

fn close(found: f64, exact: f64, within: f64) {
    assert!((found - exact).abs() <= within, "{found} is not {exact} within {within:e}");
}

#[test]
fn gearbox_file_settles_at_the_temperatures_of_the_paper() {
    let (netlist, system) = shipped("gearbox.toml");
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    for (name, exact) in [("steel", 92.7), ("aluminium", 91.0)] {
        let node = netlist.network.node(name).unwrap();
        close(celsius(steady.temperatures[node.index()]), exact, 1e-6);
    }
}

#[test]
fn gearbox_file_heats_up_as_its_closed_form() {
    let (netlist, system) = shipped("gearbox.toml");
    let times: Vec<f64> = GEARBOX.iter().map(|row| row.0).collect();
    let solution =
        Transient::until(Time(3600.0)).at(&times).tolerance(1e-5).solve(&system).unwrap();
    let column = |name: &str| solution.temperature(netlist.network.node(name).unwrap()).unwrap();
    let (steel, aluminium) = (column("steel"), column("aluminium"));
    for (row, (_, exact_steel, exact_aluminium)) in GEARBOX.iter().enumerate() {
        close(celsius(steel[row + 1]), *exact_steel, 1e-4);
        close(celsius(aluminium[row + 1]), *exact_aluminium, 1e-4);
    }
}

#[test]
fn speed_file_gives_the_power_and_the_temperature_of_the_published_law() {
    // 87e-6 x 7000^(5/3) W, and 25.5 degC + P x 13.5 x 60 / 2659
    let (netlist, system) = shipped("gearbox_speed.toml");
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    close(steady.source_heat[0], 222.851_717_740_399_1, 1e-9);
    let node = netlist.network.node("gearbox").unwrap();
    close(celsius(steady.temperatures[node.index()]), 25.5 + 67.886_382_613_660_5, 1e-9);
    let solution = transient(&netlist).solve(&system).unwrap();
    let end = *solution.temperature(node).unwrap().last().unwrap();
    close(celsius(end), 25.5 + 57.231_869_041_234_1, 1e-4);
}

#[test]
fn norton_file_settles_at_the_steel_temperature_with_one_time_constant() {
    let (netlist, system) = shipped("gearbox_norton.toml");
    let node = netlist.network.node("gearbox").unwrap();
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    close(celsius(steady.temperatures[node.index()]), 92.7, 1e-9);
    let solution = transient(&netlist).solve(&system).unwrap();
    let exact = 92.7 - 67.2 * (-1500.0 / (2659.0 * 67.2 / 220.6_f64)).exp();
    close(celsius(*solution.temperature(node).unwrap().last().unwrap()), exact, 1e-4);
}

#[test]
fn two_masses_meet_at_their_weighted_mean() {
    let (netlist, system) = shipped("two_masses.toml");
    let solution = transient(&netlist).solve(&system).unwrap();
    let hot = solution.temperature(netlist.network.node("hot").unwrap()).unwrap();
    for (t, found) in solution.times().iter().zip(&hot) {
        // the difference decays with G (1/C1 + 1/C2) = 10 x 2/15 per second
        close(celsius(*found), 50.0 + 50.0 * (-t * 20.0 / 15.0).exp(), 1e-4);
    }
    assert!(!solution.error_is_bounded());
}

/// Without a boundary they keep their energy: both come to rest at the mean, weighted by the
/// capacities.
#[test]
fn two_masses_come_to_rest_where_their_energy_leads() {
    let (netlist, system) = shipped("two_masses.toml");
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    steady.temperatures.iter().for_each(|t| close(celsius(*t), 50.0, 1e-9));
    let all: Vec<_> = netlist.network.node_ids().collect();
    assert_eq!(steady.adiabatic, all);
}

/// Heat that stays for ever leads to no steady state.
#[test]
fn a_heated_island_has_no_steady_state_and_says_so() {
    let mut b = NetworkBuilder::new();
    let a = b.node("a", HeatCapacity(10.0), Temperature(300.0));
    let c = b.node("c", HeatCapacity(10.0), Temperature(300.0));
    b.resistor("joint", a, c, Conductance(1.0));
    b.source("heater", a, HeatFlow(5.0));
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let error = SteadyState::solve(&system, 0.0).unwrap_err();
    assert_eq!(error.code(), "steady::no_boundary");
    let text = "no path leads to a boundary from `a` and `c`, and 5 W cannot leave: there is no \
        steady state";
    assert_eq!(error.to_string(), text);
}

/// Node equations of the bridge at hot 60 degC, cold 20 degC, solved by Cramer's rule: left: (1/2 +
/// 1/2 + 1/4) l - 1/2 r = 60/2 + 20/4, right: -1/2 l + (1/4 + 1/2 + 1/2) r = 60/4 + 20/2.
#[test]
fn bridge_has_its_exact_temperatures_without_an_integrator() {
    let (netlist, system) = shipped("bridge.toml");
    let solution = transient(&netlist).solve(&system).unwrap();
    assert_eq!(solution.statistics().steps, 0);
    let column = |name: &str| solution.temperature(netlist.network.node(name).unwrap()).unwrap();
    let (left, right) = (column("left"), column("right"));
    for (row, t) in solution.times().iter().enumerate() {
        let hot = 60.0 + 10.0 * (t / 60.0).sin();
        let (a, b) = (hot / 2.0 + 20.0 / 4.0, hot / 4.0 + 20.0 / 2.0);
        let determinant = 1.25 * 1.25 - 0.25;
        close(celsius(left[row]), (1.25 * a + 0.5 * b) / determinant, 1e-10);
        close(celsius(right[row]), (1.25 * b + 0.5 * a) / determinant, 1e-10);
    }
}

#[test]
fn bridge_is_in_balance_to_rounding() {
    let (netlist, system) = shipped("bridge.toml");
    let solution = transient(&netlist).solve(&system).unwrap();
    assert!(solution.ledger().relative_residual().unwrap().abs() < 1e-14);
    // hot gives what cold takes: the integral of (hot - cold)/R over 600 s, R from the node
    // equations above
    let [hot, cold] = solution.ledger().boundaries[..] else { panic!("two boundaries") };
    let left = |h: f64| (1.25 * (h / 2.0 + 5.0) + 0.5 * (h / 4.0 + 10.0)) / (1.25 * 1.25 - 0.25);
    let right = |h: f64| (1.25 * (h / 4.0 + 10.0) + 0.5 * (h / 2.0 + 5.0)) / (1.25 * 1.25 - 0.25);
    let flow = |h: f64| (h - left(h)) / 2.0 + (h - right(h)) / 4.0;
    let mean_hot = 60.0 + 10.0 * 60.0 * (1.0 - 10.0_f64.cos()) / 600.0; // flow is linear in h
    close(hot, 600.0 * flow(mean_hot), 1e-6);
    close(cold, -600.0 * flow(mean_hot), 1e-6);
}

#[test]
fn parallel_paths_add_and_the_halved_load_is_a_restart() {
    let (netlist, system) = shipped("parallel_paths.toml");
    let node = netlist.network.node("case").unwrap();
    let solution = transient(&netlist).solve(&system).unwrap();
    let (g, c) = (12.0 * 0.12 + 1.0 / 4.5, 1900.0);
    let rise = |from: f64, p: f64, t: f64| p / g + (from - p / g) * (-g * t / c).exp();
    let at_step = rise(0.0, 80.0, 600.0);
    let found = solution.temperature(node).unwrap();
    for (t, found) in solution.times().iter().zip(&found) {
        let exact = if *t <= 600.0 { rise(0.0, 80.0, *t) } else { rise(at_step, 40.0, t - 600.0) };
        close(celsius(*found) - 30.0, exact, 1e-4);
    }
    assert_eq!(solution.statistics().restarts, 1);
    // the row at the jump holds the value after it
    let row = solution.times().iter().position(|t| (t - 600.0).abs() < 1e-9).unwrap();
    let heat = solution.source_heat(netlist.network.source_ids().next().unwrap());
    assert_eq!((heat[row - 1], heat[row]), (80.0, 40.0));
}

/// Phasors: each slice of the ladder is one complex balance; after five days the start is
/// forgotten.
#[test]
fn wall_swings_as_its_phasors_say() {
    let (netlist, system) = shipped("ladder.toml");
    let node = |name: &str| netlist.network.node(name).unwrap();
    let solution = transient(&netlist).solve(&system).unwrap();
    let omega = 2.0 * std::f64::consts::PI / 86_400.0;
    let (mean, swing) = wall(omega);
    for (k, name) in ["outer", "w2", "w3", "w4", "inner"].into_iter().enumerate() {
        let found = *solution.temperature(node(name)).unwrap().last().unwrap();
        let (re, im) = swing[k];
        let phase = omega * 5.0 * 86_400.0;
        let exact = mean[k] + re * phase.sin() + im * phase.cos();
        // what is left of the start: the slowest mode decays by e^-13 over five days
        close(celsius(found), exact, 1e-3);
    }
}

/// Mean temperatures in degC and swings (in phase, in quadrature) of the wall in `ladder.toml`, by
/// elimination of its five complex balances.
fn wall(omega: f64) -> ([f64; 5], [(f64, f64); 5]) {
    let (r, c) = (0.048 / (0.7 * 10.0), 1.5e6 * 0.048 * 10.0);
    let (r_out, r_in) = (1.0 / 250.0 + r / 2.0, 1.0 / 80.0 + r / 2.0);
    let solve = |omega: f64, outside: f64, room: f64| -> [(f64, f64); 5] {
        let up = [1.0 / r; 4];
        let mut diagonal = [(0.0, omega * c); 5];
        for (k, d) in diagonal.iter_mut().enumerate() {
            d.0 = [1.0 / r_out + 1.0 / r, 2.0 / r, 2.0 / r, 2.0 / r, 1.0 / r_in + 1.0 / r][k];
        }
        let mut right = [(0.0, 0.0); 5];
        right[0].0 = outside / r_out;
        right[4].0 = room / r_in;
        let mul = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let inverse = |a: (f64, f64)| {
            let square = a.0 * a.0 + a.1 * a.1;
            (a.0 / square, -a.1 / square)
        };
        for k in 1..5 {
            let factor = mul((up[k - 1], 0.0), inverse(diagonal[k - 1]));
            diagonal[k] =
                (diagonal[k].0 - factor.0 * up[k - 1], diagonal[k].1 - factor.1 * up[k - 1]);
            let carried = mul(factor, right[k - 1]);
            right[k] = (right[k].0 + carried.0, right[k].1 + carried.1);
        }
        let mut found = [(0.0, 0.0); 5];
        for k in (0..5).rev() {
            let next = if k < 4 { found[k + 1] } else { (0.0, 0.0) };
            let link = if k < 4 { up[k] } else { 0.0 };
            found[k] =
                mul((right[k].0 + link * next.0, right[k].1 + link * next.1), inverse(diagonal[k]));
        }
        found
    };
    (solve(0.0, 10.0, 20.0).map(|x| x.0), solve(omega, 8.0, 0.0))
}

#[test]
fn film_and_resistance_of_the_same_value_are_the_same_path() {
    let steady = |path: Path| {
        let mut b = NetworkBuilder::new();
        let plate = b.node("plate", HeatCapacity(100.0), Temperature::celsius(20.0));
        let air = b.boundary("air", Temperature::celsius(20.0));
        b.convection("film", plate, air, path);
        b.source("heater", plate, HeatFlow(50.0));
        SteadyState::solve(&assembled(b), 0.0).unwrap().temperatures[0]
    };
    close(celsius(steady(Path::film(FilmCoefficient(25.0), Area(0.2)))), 30.0, 1e-12);
    close(celsius(steady(Resistance(0.2).into())), 30.0, 1e-12);
}

/// A source that is on from 100 s to 250 s, on one node: two restarts, three exponentials.
#[test]
fn a_pulse_is_met_exactly_at_both_edges() {
    let mut b = NetworkBuilder::new();
    let node: NodeId = b.node("mass", HeatCapacity(500.0), Temperature::celsius(0.0));
    let air = b.boundary("air", Temperature::celsius(0.0));
    b.resistor("path", node, air, Resistance(0.5));
    let pulse =
        b.expression("if(t < 100 [s], 0 [W], if(t < 250 [s], 400 [W], 0 [W]))", None).unwrap();
    b.source("pulse", node, pulse);
    let solution = Transient::until(Time(600.0)).every(Time(50.0)).solve(&assembled(b)).unwrap();
    let peak = 200.0 * (1.0 - (-150.0 / 250.0_f64).exp());
    for (t, found) in solution.times().iter().zip(solution.temperature(node).unwrap()) {
        let exact = match *t {
            t if t <= 100.0 => 0.0,
            t if t <= 250.0 => 200.0 * (1.0 - (-(t - 100.0) / 250.0).exp()),
            t => peak * (-(t - 250.0) / 250.0).exp(),
        };
        close(celsius(found), exact, 1e-4);
    }
    assert_eq!(solution.statistics().restarts, 2);
    close(solution.ledger().sources[0], 60_000.0, 1e-6);
}

/// The peak of `T' = (P sin(w t) - G T)/C` lies between the rows: it is found at the steps, not in
/// the table.
#[test]
fn a_peak_between_the_rows_is_seen() {
    let mut b = NetworkBuilder::new();
    let node = b.node("mass", HeatCapacity(100.0), Temperature::celsius(0.0));
    let air = b.boundary("air", Temperature::celsius(0.0));
    b.resistor("path", node, air, Conductance(1.0));
    let heat = b.expression("100 [W] * sin(2 * pi * t / 200 [s])", None).unwrap();
    b.source("heat", node, heat);
    let mut run = Transient::until(Time(200.0)).at(&[]);
    run.watch = vec![lptn_solve::Watch { node, level: Some(273.15 + 10.0) }];
    let solution = run.solve(&assembled(b)).unwrap();
    let (w, rate) = (2.0 * std::f64::consts::PI / 200.0, 0.01);
    let exact = |t: f64| {
        (rate * (w * t).sin() - w * (w * t).cos() + w * (-rate * t).exp()) / (rate * rate + w * w)
    };
    let fine = |k: u32| f64::from(k) * 1e-3;
    let peak = (0..200_000).map(|k| exact(fine(k))).fold(0.0, f64::max);
    let crossing = (0..200_000).map(fine).find(|t| exact(*t) >= 10.0).unwrap();
    let seen = solution.watched()[0];
    close(celsius(seen.peak.0), peak, 2e-3);
    close(seen.crossed.unwrap(), crossing, 0.1);
}

#[test]
fn a_network_at_rest_stays_at_rest_to_the_last_digit() {
    let mut b = NetworkBuilder::new();
    let hot = b.node("hot", HeatCapacity(10.0), Temperature::celsius(25.5));
    let air = b.boundary("air", Temperature::celsius(25.5));
    b.resistor("path", hot, air, Conductance(0.3));
    let rest = assembled(b);
    let solution = Transient::until(Time(1e4)).solve(&rest).unwrap();
    assert!(solution.temperature(hot).unwrap().iter().all(|t| t.to_bits() == 298.65_f64.to_bits()));
    assert_eq!(solution.ledger().relative_residual(), None);
}
