//! Time constants and shapes against closed forms.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests; numbers that are exact"
)]

use crate::common;

use common::{gearbox, rc_ladder, stiff, two_masses};
use lptn_network::{Conductance, HeatCapacity, Network, NetworkBuilder, Temperature};
use lptn_solve::{ExactError, Modes};

#[track_caller]
fn has(network: &Network, expected: &[f64], tolerance: f64) -> Modes {
    let modes = Modes::solve(network).unwrap();
    let found: Vec<f64> = modes.modes().iter().map(|mode| mode.tau()).collect();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() <= tolerance, "{found} for {expected}");
    }
    modes
}

#[test]
fn two_nodes_have_the_rates_of_the_characteristic_equation() {
    // r^2 - (g/C_s + (g + h)/C_a) r + g h / (C_s C_a) = 0 for the conductances g within and h to
    // the outside
    let (g, h, c) = (220.6 / 1.7, 220.6 / 65.5, [1235.0, 1424.0]);
    let (sum, product) = (g / c[0] + (g + h) / c[1], g * h / (c[0] * c[1]));
    let fast = 0.5 * (sum + f64::sqrt(sum * sum - 4.0 * product));
    has(&gearbox(), &[fast / product, 1.0 / fast], 1e-14);
}

#[test]
fn the_gearbox_of_the_issue_has_its_time_constants() {
    // peers.md 4.1: C 1000 and 1659 J/K, R_int = 1.7/220.6 and 0.1, R_amb = 65.5/220.6 and 0.3 K/W
    for (internal, outer, slow, fast) in
        [(1.7 / 220.6, 65.5 / 220.6, 792.43, 4.79), (0.1, 0.3, 838.33, 59.37)]
    {
        let start = Temperature::celsius(25.5);
        let mut b = NetworkBuilder::new();
        let steel = b.node("steel", HeatCapacity(1000.0), start);
        let aluminium = b.node("aluminium", HeatCapacity(1659.0), start);
        let air = b.boundary("air", start);
        b.resistor("internal", steel, aluminium, Conductance(f64::recip(internal)));
        b.resistor("outer", aluminium, air, Conductance(f64::recip(outer)));
        // 5 digits are given; the sum and the product of the rates are known exactly
        let modes = has(&b.build().unwrap(), &[slow, fast], 1e-3);
        let (g, h) = (f64::recip(internal), f64::recip(outer));
        let (a, c) = (modes.modes()[0].rate, modes.modes()[1].rate);
        assert!(((a + c) / (g / 1000.0 + (g + h) / 1659.0) - 1.0).abs() < 1e-14);
        assert!(((a * c) / (g * h / 1000.0 / 1659.0) - 1.0).abs() < 1e-14);
    }
}

#[test]
fn the_ladder_has_the_modes_of_the_sine_transform() {
    // one end held, one free: 1/tau_k = 4 G/C sin^2((2k - 1) pi/34), node i at sin((2k - 1) i
    // pi/17); C 50 J/K, G 4 W/K
    let angle = |k: i32| f64::from(2 * k - 1) * std::f64::consts::PI / 17.0;
    let tau: Vec<f64> = (1..=8).map(|k| 50.0 / (16.0 * (0.5 * angle(k)).sin().powi(2))).collect();
    let modes = has(&rc_ladder(), &tau, 2e-14);
    for (k, mode) in (1..).zip(modes.modes()) {
        let exact = |i: f64| (i * angle(k)).sin();
        assert!(
            (mode.shape[2] / mode.shape[7] - exact(3.0) / exact(8.0)).abs() < 1e-12,
            "mode {k}"
        );
    }
}

#[test]
fn without_a_boundary_the_mean_lasts_for_ever() {
    let modes = Modes::solve(&two_masses()).unwrap();
    let [mean, exchange] = modes.modes() else { panic!("{modes:?}") };
    assert_eq!((mean.rate.to_bits(), mean.tau()), (0, f64::INFINITY));
    assert_eq!(mean.shape.as_slice(), [1.0, 1.0]);
    assert!((exchange.tau() - 0.75).abs() < 1e-15); // C/(2 G)
    assert!((exchange.shape[1] + 1.0).abs() < 1e-15);
}

#[test]
fn rates_over_fourteen_decades_keep_their_digits() {
    // mpmath 1.3 with 80 digits: eigsy of C^-1/2 G C^-1/2
    let expected = [
        113_232.300_653_112_35,
        90.273_947_711_009_2,
        22.440_305_135_711_032,
        0.087_287_151_032_384_85,
        9.998_900_130_963_41e-6,
        9.990_009_980_039_83e-10,
    ];
    has(&stiff(), &expected, 1e-12);
}

fn network_of(capacity: &[f64], links: &[(usize, usize, f64)], ties: &[(usize, f64)]) -> Network {
    let start = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let nodes: Vec<_> = (0..)
        .zip(capacity)
        .map(|(i, &c)| b.node(&format!("n{i}"), HeatCapacity(c), start))
        .collect();
    for (k, &(i, j, g)) in links.iter().enumerate() {
        b.resistor(&format!("g{k}"), nodes[i], nodes[j], Conductance(g));
    }
    if !ties.is_empty() {
        let air = b.boundary("air", start);
        ties.iter().for_each(|&(i, g)| {
            b.resistor(&format!("t{i}"), nodes[i], air, Conductance(g));
        });
    }
    b.build().unwrap()
}

#[track_caller]
fn takes_part(modes: &Modes, mode: usize, expected: &[f64]) {
    for (found, expected) in modes.modes()[mode].participation.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{:?}", modes.modes()[mode]);
    }
}

/// A dense solver mixes modes whose rates differ by less than rounding of the fastest: here 1e18
/// times as fast. Two nodes that are one at these times make a 2 x 2 problem: `[[2, -1], [-1, 1]]`
/// with capacities 1 and 2, rates `(5 -+ sqrt 17) / 4`; what is left out is 1e-18 of it.
#[test]
fn slow_modes_are_not_mixed_by_rounding_of_fast_ones() {
    let links = [(0, 1, 1e-12), (1, 2, 1e6)];
    let root = 17_f64.sqrt();
    let modes = has(
        &network_of(&[1.0, 1.0, 1.0], &links, &[(0, 1e-12)]),
        &[4e12 / (5.0 - root), 4e12 / (5.0 + root), 0.5e-6],
        1e-14,
    );
    for (mode, rate) in [(0, (5.0 - root) / 4.0), (1, (5.0 + root) / 4.0)] {
        // x_1 = (2 - rate) x_0
        let other = (2.0 - rate) * (2.0 - rate);
        let sum = 1.0 + 2.0 * other;
        takes_part(&modes, mode, &[1.0 / sum, other / sum, other / sum]);
    }
}

/// Two pairs, 3 and 7 J/K, that nearly nothing joins: they exchange heat at `g (1/3 + 1/7)`.
#[test]
fn a_weak_exchange_without_a_boundary_keeps_its_digits() {
    let links = [(0, 1, 1e6), (2, 3, 3e5), (1, 2, 1e-9)];
    let modes = Modes::solve(&network_of(&[1.0, 2.0, 3.0, 4.0], &links, &[])).unwrap();
    assert_eq!(modes.modes()[0].rate.to_bits(), 0);
    takes_part(&modes, 0, &[0.1, 0.2, 0.3, 0.4]);
    assert!((modes.modes()[1].rate / (1e-9 / 2.1) - 1.0).abs() < 1e-13);
    takes_part(&modes, 1, &[0.7 / 3.0, 1.4 / 3.0, 0.9 / 7.0, 1.2 / 7.0]);
}

/// Strong paths between weak ones, 1e14 apart; mpmath 1.3 with 80 digits: eigsy of C^-1/2 G C^-1/2.
#[test]
fn strong_paths_inside_a_network_keep_the_slow_modes() {
    let links = [(0, 1, 1.0), (1, 2, 1e14), (2, 3, 2.0), (3, 4, 1e14 / 3.0)];
    let network = network_of(&[3.0, 5.0, 7.0, 2.0, 4.0], &links, &[(0, 0.5), (4, 0.2)]);
    let modes = has(
        &network,
        &[
            36.43709690941729,
            2.244789686328594,
            1.5534075219012646,
            3.999999999999891e-14,
            2.916666666666647e-14,
        ],
        1e-13,
    );
    takes_part(
        &modes,
        1,
        &[
            0.48441967214562387,
            0.021601701180639508,
            0.030242381652890872,
            0.15457874834027213,
            0.30915749668057363,
        ],
    );
}

#[test]
fn participation_sums_to_one_over_nodes_and_over_modes() {
    for network in [gearbox(), rc_ladder(), two_masses(), stiff()] {
        let modes = Modes::solve(&network).unwrap();
        for mode in modes.modes() {
            assert!((mode.participation.iter().sum::<f64>() - 1.0).abs() < 1e-13);
            let largest = mode.shape.iter().fold(f64::MIN, |a, b| a.max(*b));
            assert!(
                (largest - 1.0).abs() < 1e-8 && mode.shape.iter().all(|x| x.abs() < 1.0 + 1e-8)
            );
        }
        for i in 0..network.nodes().len() {
            let over_modes: f64 = modes.modes().iter().map(|mode| mode.participation[i]).sum();
            assert!((over_modes - 1.0).abs() < 1e-13, "{over_modes}");
        }
    }
}

#[test]
fn massless_nodes_follow_and_take_no_part() {
    // a node, a joint in the middle of 2 and 6 W/K, a boundary: tau = C / 1.5 W/K, the joint at a
    // quarter
    let start = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let node = b.node("node", HeatCapacity(3.0), start);
    let joint = b.massless("joint");
    let air = b.boundary("air", start);
    b.resistor("inner", node, joint, Conductance(2.0));
    b.resistor("outer", joint, air, Conductance(6.0));
    let modes = has(&b.build().unwrap(), &[2.0], 1e-15);
    assert!((modes.modes()[0].shape[1] - 0.25).abs() < 1e-15);
    let [of_node, of_joint] = modes.modes()[0].participation[..] else { panic!("{modes:?}") };
    assert!((of_node - 1.0).abs() < 1e-15 && of_joint == 0.0);
}

#[test]
fn equal_islands_keep_to_themselves() {
    // two equal nodes that nothing joins: any mixture of them would be a mode; each is one by
    // itself here
    let start = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", start);
    for name in ["a", "b"] {
        let node = b.node(name, HeatCapacity(7.0), start);
        b.resistor(&format!("skin_{name}"), node, air, Conductance(2.0));
    }
    let modes = has(&b.build().unwrap(), &[3.5, 3.5], 1e-15);
    assert_eq!(modes.modes()[0].shape.as_slice(), [1.0, 0.0]);
    assert_eq!(modes.modes()[1].shape.as_slice(), [0.0, 1.0]);
}

#[test]
fn large_networks_are_refused() {
    let start = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    for i in 0..2001 {
        b.node(&format!("n{i}"), HeatCapacity(1.0), start);
    }
    let error = Modes::solve(&b.build().unwrap()).unwrap_err();
    assert!(matches!(error, ExactError::TooLarge { nodes: 2001 }), "{error}");
}

#[test]
fn a_network_without_capacity_has_no_modes() {
    let start = Temperature::celsius(0.0);
    let mut b = NetworkBuilder::new();
    let joint = b.massless("joint");
    let air = b.boundary("air", start);
    b.resistor("r", joint, air, Conductance(2.0));
    assert!(Modes::solve(&b.build().unwrap()).unwrap().modes().is_empty());
}
