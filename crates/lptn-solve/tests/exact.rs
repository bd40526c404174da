//! The exact solution against closed forms, published tables and other programs.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use crate::common;

use common::{ZERO, gearbox, nafems_t3, one_node, random, rc_ladder, stiff, two_masses};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, HeatFlow, Network, NetworkBuilder, Temperature, Time,
};
use lptn_solve::{
    ExactError, ExactSolution, NoReference, Reference, Transient, Verification, allowed_error,
};

/// Compares with rows of (time [s], node, temperature [degC]).
#[track_caller]
fn agrees(network: &Network, expected: &[(f64, &str, f64)], tolerance: f64) -> ExactSolution {
    let mut times: Vec<f64> = expected.iter().map(|e| e.0).collect();
    times.dedup();
    let exact = ExactSolution::solve(network, 0.0, &times).unwrap();
    for &(time, node, value) in expected {
        let row = times.iter().position(|t| t.to_bits() == time.to_bits()).unwrap();
        let found = exact.row(row)[network.node(node).unwrap().index()] - ZERO;
        assert!(
            (found - value).abs() <= tolerance,
            "{node} at {time} s: {found}, expected {value}"
        );
    }
    exact
}

#[test]
fn the_gearbox_is_that_of_the_validation_case() {
    // validation/gearbox_two_node, closed form
    let expected = [
        (5.0, "steel", 26.219_503_974_350_72),
        (5.0, "alum", 25.649_934_038_029_055),
        (300.0, "steel", 46.974_438_777_062_55),
        (300.0, "alum", 45.822_557_783_442_73),
        (1500.0, "steel", 82.613_154_474_351_82),
        (1500.0, "alum", 81.034_066_970_539_07),
        (3600.0, "steel", 91.983_775_885_421_79),
        (3600.0, "alum", 90.292_361_368_891_62),
    ];
    let exact = agrees(&gearbox(), &expected, 2e-12);
    assert!(exact.quadrature_error().is_none() && exact.own_error() < 1e-12);
}

#[test]
fn the_ladder_is_that_of_the_validation_case() {
    // validation/rc_ladder, closed form by the discrete sine transform
    let expected = [
        (5.0, "n1", 0.281_352_364_715_292_9),
        (5.0, "n4", 0.000_579_125_314_303_596_8),
        (5.0, "n8", 8.478_414_192_936_157e-9),
        (50.0, "n1", 0.722_425_982_822_680_9),
        (50.0, "n8", 0.008_341_706_548_742_223),
        (300.0, "n4", 0.622_013_341_772_344_1),
        (300.0, "n8", 0.441_996_930_492_801_2),
    ];
    agrees(&rc_ladder(), &expected, 2e-13);
}

#[test]
fn two_masses_without_a_boundary_keep_their_mean() {
    // validation/msl_two_masses: 323.15 K + 50 K exp(-t / 0.75 s), the last two of its values
    let expected = [
        (0.5, "mass1", 348.820_855_951_629_6 - ZERO),
        (1.0, "mass1", 336.329_856_905_786_3 - ZERO),
    ];
    agrees(&two_masses(), &expected, 2e-13);
    let late = ExactSolution::solve(&two_masses(), 0.0, &[1e9]).unwrap();
    assert!(late.row(0).iter().all(|t| (t - 323.15).abs() < 1e-13), "{:?}", late.row(0));
}

#[test]
fn heat_into_an_island_adds_up_for_ever() {
    // the mean rises by P t / (C1 + C2), the difference settles at P/G C2/(C1 + C2)
    let mut b = NetworkBuilder::new();
    let start = Temperature::celsius(0.0);
    let a = b.node("a", HeatCapacity(10.0), start);
    let c = b.node("c", HeatCapacity(30.0), start);
    b.resistor("r", a, c, Conductance(2.0));
    b.source("p", a, HeatFlow(8.0));
    let network = b.build().unwrap();
    let mean = 8.0 * 1e6 / 40.0;
    let difference = 8.0 / 2.0 * 30.0 / 40.0;
    let expected = [(1e6, "a", mean + 0.75 * difference), (1e6, "c", mean - 0.25 * difference)];
    agrees(&network, &expected, 1e-9);
}

#[test]
fn the_bar_with_a_sine_at_its_end_meets_nafems() {
    // validation/nafems_t3: 36.60 degC published; the others by series, tolerance = error of the
    // grid
    let expected = [
        (16.0, "n50", 0.169_926_047_539_538_44),
        (16.0, "n80", 14.864_632_264_847_99),
        (24.0, "n80", 28.774_855_595_326_14),
        (32.0, "n50", 3.374_236_432_249_490_7),
    ];
    agrees(&nafems_t3(), &expected, 0.02);
    let exact = agrees(&nafems_t3(), &[(32.0, "n80", 36.6)], 0.05);
    assert!(exact.quadrature_error().is_some_and(|error| error <= 1e-10), "{exact:?}");
}

#[test]
fn ramps_are_in_closed_form() {
    // validation/ramp_and_sine_inputs, node `ramp`
    let heat = "if(t < 100 [s], 4 [W/s] * t, if(t < 700 [s], 400 [W], \
                if(t < 900 [s], 400 [W] - 2 [W/s] * (t - 700 [s]), 0 [W])))";
    let expected = [
        (50.0, "node", 23.944_517_467_184_24),
        (100.0, "node", 34.959_393_172_136_785),
        (400.0, "node", 88.715_309_083_285_33),
        (700.0, "node", 108.491_005_388_337_71),
        (800.0, "node", 104.273_748_421_450_56),
        (2500.0, "node", 20.323_851_727_129_863),
    ];
    let exact = agrees(&one_node(1200.0, "20 [degC]", heat), &expected, 5e-13);
    assert!(exact.quadrature_error().is_none());
}

#[test]
fn a_sine_is_integrated_to_1e_10_kelvin() {
    // validation/ramp_and_sine_inputs, node `sine`: period 30 min
    let day = "20 [degC] + 10 [K] * sin(2 * pi * t / 1800 [s])";
    let expected = [
        (50.0, "node", 20.137_332_766_629_832),
        (400.0, "node", 25.146_381_742_153_096),
        (1000.0, "node", 23.240_360_713_798_78),
        (2500.0, "node", 26.893_177_209_295_036),
    ];
    agrees(&one_node(1200.0, day, "0 [W]"), &expected, 1e-10);
}

#[test]
fn a_duty_cycle_is_in_closed_form() {
    // validation/duty_cycle_one_node: 220 W for 3 of every 10 min; starts at 25 degC
    let on = |k: u32| format!("if(t < {} [s], 0, if(t < {} [s], 1, 0))", 600 * k, 600 * k + 180);
    let terms: Vec<String> = (1..=5).map(on).collect();
    let power = format!("220 [W] * (if(t < 180 [s], 1, 0) + {})", terms.join(" + "));
    let mut b = NetworkBuilder::new();
    let ambient = Temperature::celsius(25.0);
    let body = b.node("body", HeatCapacity(2659.0), ambient);
    let air = b.boundary("amb", ambient);
    b.resistor("e0", body, air, Conductance(3.282_994_090_610_637));
    let heat = b.expression(&power, None).unwrap();
    b.source("q0", body, heat);
    let expected = [
        (180.0, "body", 38.353_995_110_622_21),
        (600.0, "body", 32.950_645_839_378_545),
        (780.0, "body", 44.720_254_785_353_376),
        (3000.0, "body", 39.820_029_015_687_77),
        (3180.0, "body", 50.220_723_299_371_91),
    ];
    agrees(&b.build().unwrap(), &expected, 1e-12);
}

#[test]
fn fast_nodes_follow_slow_inputs_exactly() {
    // T = 20 + 10 (r sin wt - w cos wt + w exp(-rt)) r/(r^2 + w^2), r = G/C, over 12 decades of r/w
    let w = std::f64::consts::TAU / 1800.0;
    for c in [1e-9, 1e-3, 1.0, 1e3, 1e7] {
        let r: f64 = 4.0 / c;
        let answer = |t: f64| {
            let sine = r * (w * t).sin() - w * (w * t).cos() + w * (-r * t).exp();
            20.0 + 10.0 * sine * r / (r * r + w * w)
        };
        let expected = [37.0, 950.0, 2500.0].map(|t| (t, "node", answer(t)));
        let day = "20 [degC] + 10 [K] * sin(2 * pi * t / 1800 [s])";
        agrees(&one_node(c, day, "0 [W]"), &expected, 1e-10);
    }
}

#[test]
fn inputs_with_kinks_are_integrated_too() {
    // the half wave max(0, sin wt): a sine over its first half period, then decay
    let w = std::f64::consts::TAU / 100.0;
    let r: f64 = 4.0 / 100.0;
    let sine = |t: f64| {
        25.0 * (r * (w * t).sin() - w * (w * t).cos() + w * (-r * t).exp()) * r / (r * r + w * w)
    };
    let expected =
        [(30.0, "node", 20.0 + sine(30.0)), (90.0, "node", 20.0 + sine(50.0) * (-r * 40.0).exp())];
    let heat = "100 [W] * max(0, sin(2 * pi * t / 100 [s]))";
    agrees(&one_node(100.0, "20 [degC]", heat), &expected, 1e-10);
}

#[test]
fn massless_nodes_take_the_mean_of_their_neighbours() {
    // node - 2 W/K - joint - 6 W/K - air at 0 degC, 4 W into the joint: 1.5 W/K in series, of the 4
    // W a quarter goes to the node, which settles at 4 W / 6 W/K; T_joint = (2 T + 4) / 8
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let joint = b.massless("joint");
    let node = b.node("node", HeatCapacity(3.0), Temperature::celsius(50.0));
    let air = b.boundary("air", zero);
    b.resistor("inner", node, joint, Conductance(2.0));
    b.resistor("outer", joint, air, Conductance(6.0));
    b.source("heat", joint, HeatFlow(4.0));
    let network = b.build().unwrap();
    let at = |t: f64| 4.0 / 6.0 + (50.0 - 4.0 / 6.0) * (-1.5 * t / 3.0).exp();
    let row = |t: f64| [(t, "node", at(t)), (t, "joint", (2.0 * at(t) + 4.0) / 8.0)];
    agrees(&network, &[row(0.5), row(2.0), row(30.0)].concat(), 3e-13);
}

#[test]
fn a_run_starts_where_it_is_told_to() {
    // a ramp of 1 K/s seen by C/G = 1 s from t = 10 s on: T = T_air(t) - (1 - exp(-(t - 10)))
    let network = one_node(4.0, "10 [degC] + 1 [K/s] * t", "0 [W]");
    let exact = ExactSolution::solve(&network, 10.0, &[10.0, 12.0]).unwrap();
    assert!((exact.row(0)[0] - 293.15).abs() < 1e-13);
    assert!((exact.row(1)[0] - (273.15 + 22.0 - (1.0 - f64::exp(-2.0)))).abs() < 1e-12);
}

#[test]
fn rates_over_fourteen_decades_keep_their_digits() {
    // mpmath 1.3 with 80 digits: eigsy of C^-1/2 G C^-1/2
    let expected = [
        (1.0, "n0", 0.049_975_116_155_108_426),
        (1.0, "n3", 0.000_248_797_323_926_824_7),
        (1000.0, "n0", 45.730_498_666_794_49),
        (1000.0, "n5", 0.780_427_266_446_234_6),
        (1e5, "n0", 3_023.987_556_407_294_5),
        (1e5, "n3", 2_992.487_971_696_187),
        (1e6, "n0", 5_154.796_970_996_95),
        (1e6, "n5", 99.985_378_110_274_25),
    ];
    let network = stiff();
    let exact = ExactSolution::solve(&network, 0.0, &[1.0, 1000.0, 1e5, 1e6]).unwrap();
    for (t, node, value) in expected {
        let row = exact.times().iter().position(|x| x.to_bits() == f64::to_bits(t)).unwrap();
        let found = exact.row(row)[network.node(node).unwrap().index()] - ZERO;
        println!("{t} {node}: {:e} (own {:e})", found - value, exact.own_error());
        assert!(
            (found - value).abs() <= exact.own_error(),
            "{node} at {t} s: {found}, expected {value}"
        );
    }
    assert!(exact.own_error() < 1e-6, "{:e}", exact.own_error());
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let network = gearbox();
    for times in [&[][..], &[2.0, 1.0], &[-1.0, 1.0], &[0.0]] {
        assert!(
            matches!(ExactSolution::solve(&network, 0.0, times), Err(ExactError::Times)),
            "{times:?}"
        );
    }
    let failing = one_node(1.0, "20 [degC]", "1 [W] * sqrt(1 - t / 1 [s])");
    let error = ExactSolution::solve(&failing, 0.0, &[2.0]).unwrap_err();
    assert_eq!(error.code(), "solve::input");
}

fn row_of(nodes: usize) -> Network {
    let zero = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let foot = b.boundary("foot", Temperature::celsius(10.0));
    let mut last = b.node("n0", HeatCapacity(1.0), zero);
    b.resistor("r0", last, foot, Conductance(1.0));
    for i in 1..nodes {
        let next = b.node(&format!("n{i}"), HeatCapacity(1.0), zero);
        b.resistor(&format!("r{i}"), last, next, Conductance(1.0));
        last = next;
    }
    b.build().unwrap()
}

#[test]
fn random_networks_are_solved_alike_by_two_codes() {
    let settings = Transient::until(Time(100.0)).every(Time(5.0));
    let (mut massless, mut own, mut ratio) = (0, 0.0, 0.0);
    for seed in 0..200 {
        let network = random(seed);
        massless += usize::from(network.nodes().iter().any(|node| node.massless));
        let system = ThermalSystem::assemble(&network).unwrap();
        let found = Verification::of(&system, &settings).unwrap();
        let [_, fine] = &found.comparisons[..] else { panic!("{found:?}") };
        let Reference::Exact { own_error, .. } = found.reference else { panic!("{found:?}") };
        own = f64::max(own, own_error);
        ratio = f64::max(ratio, fine.difference.largest / fine.tolerance);
        assert!(fine.passes(), "seed {seed}: {:e} K", fine.difference.largest);
    }
    println!(
        "own error up to {own:.1e} K, runs at 1e-7 K off by up to {ratio:.1} times their tolerance"
    );
    assert!(massless > 100 && own < 1e-7, "{massless} {own:e}");
}

#[test]
fn a_large_network_is_compared_with_itself() {
    let system = ThermalSystem::assemble(&row_of(2001)).unwrap();
    let found = Verification::of(&system, &Transient::until(Time(20.0)).every(Time(5.0))).unwrap();
    let Reference::FinerRun { reason: NoReference::Unsolved(reason), tolerance } = &found.reference
    else {
        panic!("{found:?}")
    };
    assert_eq!(reason.code(), "modes::too_large");
    assert!((tolerance / 1e-7 - 1.0).abs() < 1e-12);
    assert_eq!(found.comparisons.len(), 1);
    assert!(found.passes(), "{:?}", found.comparisons[0].difference.largest);
}

#[test]
fn runs_are_verified_at_two_tolerances() {
    for network in [gearbox(), rc_ladder(), nafems_t3()] {
        let system = ThermalSystem::assemble(&network).unwrap();
        let found = Verification::of(&system, &Transient::until(Time(32.0))).unwrap();
        assert!(matches!(found.reference, Reference::Exact { .. }));
        let tolerances: Vec<f64> = found.comparisons.iter().map(|c| c.tolerance).collect();
        assert_eq!(tolerances.len(), 2);
        assert!((tolerances[0] - 1e-5).abs() < 1e-18 && (tolerances[1] - 1e-7).abs() < 1e-20);
        assert!(found.passes(), "{:?}", found.comparisons);
        let worst = &found.comparisons[0].difference;
        assert!(worst.by_node.iter().all(|d| *d <= worst.largest));
    }
}

/// The gearbox with one thing wrong in it.
fn mutant(internal: f64, external: f64, capacity: f64, power: f64) -> Network {
    let ambient = Temperature::celsius(25.5);
    let mut b = NetworkBuilder::new();
    let steel = b.node("steel", HeatCapacity(capacity), ambient);
    let aluminium = b.node("alum", HeatCapacity(1424.0), ambient);
    let bed = b.boundary("bed", ambient);
    b.resistor("internal", steel, aluminium, Conductance(internal));
    b.resistor("external", aluminium, bed, Conductance(external));
    b.source("q0", steel, HeatFlow(power));
    b.build().unwrap()
}

#[test]
fn a_run_of_another_network_is_not_verified() {
    let (internal, external) = (129.764_705_882_352_93, 3.367_938_931_297_709_7);
    let settings = Transient::until(Time(1500.0));
    let judged = |network: &Network| {
        let run = settings.solve(&ThermalSystem::assemble(network).unwrap()).unwrap();
        let exact = ExactSolution::solve(&gearbox(), 0.0, run.times()).unwrap();
        let found = Verification::against_exact(&exact, &[&run]);
        (found.passes(), found.comparisons[0].difference.largest)
    };
    assert!(judged(&mutant(internal, external, 1235.0, 220.6)).0);
    for wrong in [
        mutant(internal * 1.001, external, 1235.0, 220.6),
        mutant(internal, external * 2.0, 1235.0, 220.6),
        mutant(internal, external, 1235.1, 220.6),
        mutant(internal, external, 1235.0, -220.6),
    ] {
        let (passes, largest) = judged(&wrong);
        assert!(!passes && largest > allowed_error(1e-5), "{largest}");
    }
}

#[test]
fn a_run_of_other_rows_is_not_compared() {
    let network = gearbox();
    let run =
        Transient::until(Time(10.0)).solve(&ThermalSystem::assemble(&network).unwrap()).unwrap();
    let exact = ExactSolution::solve(&network, 0.0, &[0.0, 10.0]).unwrap();
    assert!(exact.difference(&run).is_none());
    let found = Verification::against_exact(&exact, &[&run]);
    assert!(found.comparisons.is_empty() && !found.passes());
}

#[test]
fn what_is_allowed_is_ten_times_down_to_1e_5() {
    for (tolerance, allowed) in [(1e-3, 1e-2), (1e-5, 1e-4), (1e-6, 5e-5), (1e-7, 5e-6)] {
        assert!((allowed_error(tolerance) / allowed - 1.0).abs() < 1e-12);
    }
}
