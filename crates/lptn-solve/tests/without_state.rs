//! Networks whose nodes are all massless: what they do over time, against closed forms.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test fails by panicking, in its helpers too; numbers that are given"
)]

use std::f64::consts::PI;

use lptn_assembly::ThermalSystem;
use lptn_netlist::parse;
use lptn_network::Time;
use lptn_solve::{Selection, Solution, Transient, Watch, Window};

/// A joint with a conductance to air at 300 K and a heat in W, a limit of 330 K, and a run of 100 s
/// with a window over all of it.
fn run((conductance, heat): (&str, &str), rows: &[f64]) -> (Solution, lptn_solve::WindowSeen) {
    let text = format!(
        "format = 1\n[node]\njoint = {{ massless = true }}\n[boundary]\nair = {{ T = \"300 K\" }}\n[resistor]\nskin = \
         {{ from = \"joint\", to = \"air\", G = \"{conductance}\" }}\n[source]\nheat = {{ into = \"joint\", P = \"{heat}\" \
         }}\n[limit]\nhot = {{ of = \"joint.T\", below = \"absolute(330 [K])\" }}\n[run]\nstop = \"100 s\"\n"
    );
    let netlist = parse("joint.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let network = &netlist.network;
    let of = Selection::all(network);
    let window = Window { name: "run".into(), from: 0.0, to: 100.0, of };
    let node = network.node("joint").unwrap();
    let watch = vec![Watch { node, level: Some(320.0) }];
    let settings = Transient { watch, ..Transient::until(Time(100.0)) };
    let system = ThermalSystem::assemble(network).unwrap();
    let solution = settings.at(rows).window(window).solve(&system).unwrap();
    let seen = solution.windows()[0].clone();
    assert!(solution.ledger().closes());
    (solution, seen)
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

fn rows(solution: &Solution, exact: impl Fn(f64) -> f64) {
    let node = solution.network().node("joint").unwrap();
    for (time, found) in solution.times().iter().zip(solution.temperature(node).unwrap()) {
        near(found, exact(*time), 1e-8);
    }
}

/// 80 W sin(2 pi t / 200 s) by 2 W/K.
#[test]
fn a_joint_follows_its_heat_at_once() {
    let wave = ("2 W/K", "80 [W] * sin(2 * pi * t / 200 [s])");
    for times in [vec![], vec![10.0, 50.0, 100.0], vec![0.0, 37.0]] {
        let (solution, seen) = run(wave, &times);
        rows(&solution, |t| 300.0 + 40.0 * (PI * t / 100.0).sin());
        assert!(times.iter().all(|time| solution.times().contains(time)));
        let column = &seen.columns[0];
        near(column.mean, 300.0 + 40.0 * 2.0 / PI, 1e-6);
        near(column.max.0, 340.0, 1e-6);
        near(column.max.1, 50.0, 0.1);
        near(column.min.0, 300.0, 1e-9);
        let limit = solution.limits()[0];
        near(limit.margin, -10.0, 1e-6);
        near(limit.worst_at, 50.0, 0.1);
        near(limit.broken_at.unwrap(), 100.0 / PI * 0.75_f64.asin(), 1e-6);
        let watched = solution.watched()[0];
        near(watched.peak.0, 340.0, 1e-4);
        near(watched.crossed.unwrap(), 100.0 / 6.0, 1e-2);
    }
}

/// By 2 W/K (1 + (T_mean - 300 K) / 100 K) a heat P raises it by 100 K (sqrt(1 + P / 100 W) - 1).
#[test]
fn a_joint_whose_conductance_rises_follows_a_root() {
    let bent = "2 [W/K] * (1 + (T_mean - absolute(300 [K])) / 100 [K])";
    let (solution, seen) = run((bent, "3 [W/s] * t"), &[0.0, 25.0, 50.0, 100.0]);
    rows(&solution, |t| 300.0 + 100.0 * ((1.0 + 0.03 * t).sqrt() - 1.0));
    let column = &seen.columns[0];
    near(column.mean, 300.0 + 100.0 * ((8.0 - 1.0) / 1.5 / 3.0 - 1.0), 1e-6);
    near(column.max.0, 400.0, 1e-8);
    near(solution.limits()[0].broken_at.unwrap(), (1.69 - 1.0) / 0.03, 1e-6);
    near(solution.watched()[0].crossed.unwrap(), (1.44 - 1.0) / 0.03, 1e-3);
    assert_eq!(solution.statistics().steps, 0);
}

/// A jump of the heat makes the joint leap: each side has its own row.
#[test]
fn a_jump_of_the_heat_is_one_of_the_joint() {
    let jump = ("2 W/K", "if(t < 40 [s], 20 [W], 70 [W])");
    let (solution, seen) = run(jump, &[0.0, 39.0, 40.0, 100.0]);
    rows(&solution, |t| if t < 40.0 { 310.0 } else { 335.0 });
    near(seen.columns[0].mean, 0.4 * 310.0 + 0.6 * 335.0, 1e-9);
    let limit = solution.limits()[0];
    assert_eq!((limit.broken_at, limit.worst_at), (Some(40.0), 100.0));
    near(limit.margin, -5.0, 1e-9);
    assert_eq!(solution.watched()[0].crossed, Some(40.0));
    near(solution.watched()[0].peak.0, 335.0, 1e-9);
}

/// Each row once, in the order of time, one at the ends of the run and at a jump too.
#[test]
fn each_row_is_written_once() {
    let jump = ("2 W/K", "if(t < 40 [s], 20 [W], 70 [W])");
    let wave = ("2 W/K", "80 [W] * sin(2 * pi * t / 200 [s])");
    for heat in [jump, wave] {
        let times = |rows: &[f64]| run(heat, rows).0.times().to_vec();
        assert_eq!(times(&[0.0, 39.0, 40.0, 100.0]), [0.0, 39.0, 40.0, 100.0]);
        assert_eq!(times(&[0.0, 37.0]), [0.0, 37.0, 100.0]);
        assert_eq!(times(&[3.0, 41.0, 99.0]), [0.0, 3.0, 41.0, 99.0, 100.0]);
    }
}

/// Joints that are solved for are looked at at all points of each part of their inputs before
/// anything reads them, so that each look begins next to what it finds: as measured.
#[test]
fn looks_at_a_joint_are_few() {
    let bent = "2 [W/K] * (1 + (T_mean - absolute(300 [K])) / 100 [K])";
    let looks = |heat: &str| run((bent, heat), &[0.0, 100.0]).0.looks();
    let (line, wave) = (looks("3 [W/s] * t"), looks("80 [W] * sin(2 * pi * t / 200 [s])"));
    for (found, measured) in [(line.placed, 338), (wave.placed, 7213)] {
        assert!(found.abs_diff(measured) <= measured / 100, "{found} for {measured}");
    }
    assert_eq!([line.searched, wave.searched], [8, 153]);
}

/// A joint that radiates has one solution: each of eight parts is gone to its end before it is
/// looked at, which costs a look each.
#[test]
fn a_joint_of_one_solution_is_gone_through_part_by_part() {
    let text = "format = 1\n[node]\njoint = { massless = true }\n[boundary]\nair = { T = \
                \"absolute(300 [K])\" }\n[radiation]\nskin = { from = \"joint\", to = \"air\", \
                emissivity = \"1\", area = \"1 m^2\" }\n[source]\nheat = { into = \"joint\", P = \
                \"3 [W/s] * t\" }\n[run]\nstop = \"100 s\"\n";
    let netlist = parse("glows.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let solution = Transient::until(Time(100.0)).at(&[0.0, 100.0]).solve(&system).unwrap();
    let node = netlist.network.node("joint").unwrap();
    let exact = (300.0_f64.powi(4) + 300.0 / 5.670_374_419e-8).powf(0.25);
    near(*solution.temperature(node).unwrap().last().unwrap(), exact, 1e-6);
    // six points for the books of each part beside its end, and four at the ends of the run
    assert_eq!(solution.looks().placed, 8 * 7 + 4);
}
