//! The exact solution of networks with streams of constant capacity rate, against closed forms and
//! mpmath.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests; the measured figures, shown with --nocapture"
)]

use crate::elements_helper as elements;

use elements::{quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, End, HeatCapacity, HeatFlow, Network, NetworkBuilder, Temperature, Time,
};
use lptn_solve::{ExactSolution, NoReference, Reference, Transient, Verification};

const ZERO: f64 = 273.15;

fn rate(flow: f64) -> lptn_network::Input {
    quantity(&format!("{flow} W/K"))
}

/// Twelve cells of 50 J/K, 20 degC warm, in a stream of 20 W/K from an inlet.
fn chain(inlet: &str) -> Network {
    let mut b = NetworkBuilder::new();
    let course = b.expression(inlet, None).unwrap();
    let mut last: End = b.boundary("inlet", course).into();
    for i in 1..=12 {
        let cell = b.node(&format!("c{i}"), HeatCapacity(50.0), Temperature::celsius(20.0));
        stream(&mut b, &format!("s{i}"), (last, cell), rate(20.0));
        last = cell.into();
    }
    b.build().unwrap()
}

/// Compares with rows of (time [s], node, temperature [degC]), whose times ascend.
#[track_caller]
fn agrees(network: &Network, expected: &[(f64, &str, f64)], tolerance: f64) -> ExactSolution {
    let mut times: Vec<f64> = expected.iter().map(|e| e.0).collect();
    times.dedup();
    let exact = ExactSolution::solve(network, 0.0, &times).unwrap();
    let mut worst: f64 = 0.0;
    for &(time, node, value) in expected {
        let row = times.iter().position(|t| t.to_bits() == time.to_bits()).unwrap();
        let found = exact.row(row)[network.node(node).unwrap().index()] - ZERO;
        worst = worst.max((found - value).abs());
        assert!(
            (found - value).abs() <= tolerance,
            "{node} at {time} s: {found}, expected {value}"
        );
    }
    println!("off by {worst:.1e} K, own error {:.1e} K", exact.own_error());
    assert!(worst <= exact.own_error() + 6e-14, "{worst:e} {:e}", exact.own_error());
    exact
}

/// A step of the inlet reaches cell k as `P(k, t mcp / C)`, the distribution of Erlang; by mpmath's
/// incomplete gamma function with 40 digits. The matrix has one eigenvector for twelve states.
#[test]
fn a_chain_of_equal_cells_passes_a_step_on_as_erlang_has_it() {
    let expected = [
        (5.0, "c1", 80.526_530_173_437_11),
        (5.0, "c6", 21.159_452_593_643_01),
        (5.0, "c12", 20.000_095_523_061_172),
        (20.0, "c1", 89.976_517_616_046_82),
        (20.0, "c6", 76.613_475_654_426_23),
        (20.0, "c12", 27.834_680_071_296_297),
        (40.0, "c6", 89.903_135_048_266_6),
        (40.0, "c12", 81.110_513_095_355_89),
        (100.0, "c1", 90.0),
        (100.0, "c12", 89.999_995_741_058_1),
    ];
    let exact = agrees(&chain("90 [degC]"), &expected, 2e-13);
    assert_eq!((exact.states(), exact.carried()), (12, 12));
    assert!(exact.quadrature_error().is_none());
}

/// The integral of that: `t P(k, a) - k / (mcp / C) P(k + 1, a)`, `a = t mcp / C`.
#[test]
fn a_chain_of_equal_cells_passes_a_ramp_on() {
    let expected = [
        (5.0, "c1", 21.419_169_104_045_766),
        (5.0, "c6", 20.007_405_479_754_67),
        (5.0, "c12", 20.000_000_301_333_527),
        (20.0, "c6", 22.937_946_460_726_73),
        (40.0, "c12", 25.356_969_735_588_02),
        (100.0, "c1", 68.75),
        (100.0, "c12", 55.000_000_102_532_77),
    ];
    let exact = agrees(&chain("20 [degC] + 0.5 [K/s] * t"), &expected, 2e-13);
    assert!(exact.quadrature_error().is_none());
}

/// mpmath's `expm` with 50 digits, the sine as two more states.
#[test]
fn a_chain_of_equal_cells_passes_a_sine_on() {
    let expected = [
        (5.0, "c1", 20.297_145_995_237_18),
        (5.0, "c6", 20.001_550_920_334_15),
        (5.0, "c12", 20.000_000_063_110_12),
        (130.0, "c1", 29.720_382_608_759_036),
        (130.0, "c6", 29.316_762_854_584_49),
        (1000.0, "c1", 11.476_487_579_367_647),
        (1000.0, "c12", 13.335_613_981_366_907),
    ];
    let exact = agrees(&chain("20 [degC] + 10 [K] * sin(2 * pi * t / 600 [s])"), &expected, 1e-10);
    assert!(exact.quadrature_error().is_some_and(|error| error <= 1e-10), "{exact:?}");
}

/// A circulant matrix, as in `response.rs`: `T_j = T_air + 1/n sum_k z^(jk) exp(-s_k t) T_0`; with
/// no loss the mean stays for ever.
#[test]
fn a_ring_forgets_as_its_closed_form_does() {
    for (count, flow, loss) in [(7_usize, 10.0, 2.0), (24, 80.0, 0.5), (5, 3.0, 0.0)] {
        let mut b = NetworkBuilder::new();
        let air = b.boundary("air", Temperature::celsius(20.0));
        let start = |i| Temperature::celsius(if i == 0 { 70.0 } else { 20.0 });
        let cells: Vec<_> =
            (0..count).map(|i| b.node(&format!("c{i}"), HeatCapacity(50.0), start(i))).collect();
        for i in 0..count {
            let ends = (cells[i], cells[(i + 1) % count]);
            stream(&mut b, &format!("hose{i}"), ends, rate(flow));
            if loss > 0.0 {
                b.resistor(&format!("skin{i}"), cells[i], air, Conductance(loss));
            }
        }
        let network = b.build().unwrap();
        let closed = |j: usize, t: f64| -> f64 {
            let of = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                let decay = (-(loss + flow * (1.0 - angle.cos())) * t / 50.0).exp();
                decay * (angle * j as f64 - flow * angle.sin() * t / 50.0).cos()
            };
            20.0 + 50.0 * (0..count).map(of).sum::<f64>() / count as f64
        };
        let names: Vec<String> = (0..count).map(|j| format!("c{j}")).collect();
        let at = |t: f64| names.iter().enumerate().map(move |(j, name)| (t, &**name, (j, t)));
        let rows = [0.5, 3.0, 10.0, 300.0].into_iter().flat_map(at);
        let expected: Vec<_> = rows.map(|(t, name, (j, s))| (t, name, closed(j, s))).collect();
        agrees(&network, &expected, 1e-12);
    }
}

/// Time in s, then a, b, d, e and c in degC.
const ALONG_A_WALL: [[f64; 6]; 4] = [
    [
        0.01,
        19.984_036_980_471_213,
        20.012_410_461_679_217,
        20.796_410_872_115_51,
        59.999_457_276_728_08,
        23.101_391_884_861_23,
    ],
    [
        3.0,
        17.410_512_978_300_89,
        20.986_141_171_082_12,
        21.747_750_342_787_754,
        59.827_921_040_671_17,
        20.695_448_424_512_772,
    ],
    [
        40.0,
        16.892_821_786_283_506,
        20.050_229_404_603_96,
        20.788_092_197_283_56,
        57.681_242_743_360_72,
        20.064_106_969_335_402,
    ],
    [
        1000.0,
        32.150_868_039_363_36,
        33.453_404_604_225_8,
        33.715_130_126_428_626,
        46.801_451_018_426_44,
        33.498_583_130_925_9,
    ],
];

/// A coolant along a wall, one joint of it massless and one cell of 1 mJ/K: rates over six decades;
/// mpmath's `expm` with 60 digits, the ramp of the inlet as a state.
#[test]
fn a_stream_through_a_massless_joint_is_that_of_mpmath() {
    let mut b = NetworkBuilder::new();
    let twenty = Temperature::celsius(20.0);
    let ramp = b.expression("10 [degC] + 0.02 [K/s] * t", None).unwrap();
    let inlet = b.boundary("inlet", ramp);
    let air = b.boundary("air", Temperature::celsius(25.0));
    let first = b.node("a", HeatCapacity(50.0), twenty);
    let joint = b.massless("c");
    let second = b.node("b", HeatCapacity(50.0), twenty);
    let tiny = b.node("d", HeatCapacity(1e-3), twenty);
    let wall = b.node("e", HeatCapacity(2000.0), Temperature::celsius(60.0));
    stream(&mut b, "s1", (inlet, first), rate(20.0));
    stream(&mut b, "s2", (joint, first), rate(-20.0)); // a negative one flows the other way
    stream(&mut b, "s3", (joint, second), rate(20.0));
    stream(&mut b, "s4", (second, tiny), rate(20.0));
    stream(&mut b, "s5", (tiny, air), rate(20.0));
    b.resistor("w1", first, wall, Conductance(3.0));
    b.resistor("w2", joint, wall, Conductance(1.5));
    b.resistor("w3", tiny, wall, Conductance(0.4));
    b.resistor("skin", wall, air, Conductance(0.5));
    b.source("heat", wall, HeatFlow(100.0));
    b.source("pump", joint, HeatFlow(7.0));
    let names = ["a", "b", "d", "e", "c"];
    let row = |row: &[f64; 6]| -> Vec<(f64, &str, f64)> {
        names.iter().zip(&row[1..]).map(|(name, value)| (row[0], *name, *value)).collect()
    };
    let expected: Vec<_> = ALONG_A_WALL.iter().flat_map(row).collect();
    agrees(&b.build().unwrap(), &expected, 1e-12);
}

/// Two masses of 1 MJ/K beside a coolant cell of 1 uJ/K: slow rates 13 decades below the fast one
/// keep their digits. The cell follows its inlet at once, so the masses see `(T1 - T_in)` through 2
/// W/K each: two exponentials.
#[test]
fn slow_nodes_keep_their_digits_beside_fast_ones() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature::celsius(10.0));
    let cell = b.node("cell", HeatCapacity(1e-6), Temperature::celsius(10.0));
    let after = b.node("after", HeatCapacity(1e-6), Temperature::celsius(10.0));
    let mass = b.node("mass", HeatCapacity(1e6), Temperature::celsius(80.0));
    stream(&mut b, "s1", (inlet, cell), rate(1e3));
    stream(&mut b, "s2", (cell, after), rate(1e3));
    b.resistor("film", cell, mass, Conductance(2.0));
    let network = b.build().unwrap();
    // quasi-steady but for C_cell / C_mass, 1e-12: G = 2 * 1000 / 1002 W/K
    let tau = 1e6 / (2.0 * 1000.0 / 1002.0);
    let mass_at = |t: f64| 10.0 + 70.0 * (-t / tau).exp();
    let after_at = |t: f64| 10.0 + (mass_at(t) - 10.0) * 2.0 / 1002.0;
    let rows = [100.0, 1e5, 3e6].map(|t| [(t, "mass", mass_at(t)), (t, "after", after_at(t))]);
    agrees(&network, &rows.concat(), 2e-10);
}

/// No boundary, no source, and rows at any times; mpmath's `expm` with 40 digits.
#[test]
fn regression_a_loop_without_inputs_goes_by_long_steps_too() {
    let mut b = NetworkBuilder::new();
    let cell = |b: &mut NetworkBuilder, name: &str, c: f64, t: f64| {
        b.node(name, HeatCapacity(c), Temperature::celsius(t))
    };
    let cells = [cell(&mut b, "a", 50.0, 20.0), cell(&mut b, "b", 70.0, 60.0)];
    let last = cell(&mut b, "c", 70.0, 30.0);
    stream(&mut b, "s1", (cells[0], cells[1]), rate(20.0));
    stream(&mut b, "s2", (cells[1], last), rate(20.0));
    stream(&mut b, "s3", (last, cells[0]), rate(20.0));
    let expected = [
        (0.1, "a", 20.408_649_736_245_47),
        (0.1, "b", 58.879_058_192_253_36),
        (0.1, "c", 30.829_049_138_999_874),
        (1.777, "a", 27.978_593_670_694_856),
        (1.777, "b", 45.794_368_839_795_155),
        (1.777, "c", 38.506_635_681_137_09),
        (9.1, "a", 38.461_832_280_858_246),
        (9.1, "b", 38.190_426_805_722_18),
        (9.1, "c", 38.622_550_136_521_93),
    ];
    agrees(&b.build().unwrap(), &expected, 1e-12);
}

#[test]
fn runs_with_streams_are_verified_and_wrong_ones_are_not() {
    let settings = Transient::until(Time(200.0)).every(Time(0.1));
    let found = |text: &str| {
        let system = ThermalSystem::assemble(&chain(text)).unwrap();
        Verification::of(&system, &settings).unwrap()
    };
    for inlet in ["90 [degC]", "if(t < 30 [s], 20 [degC] + 1 [K/s] * t, 40 [degC])"] {
        let verified = found(inlet);
        let Reference::Exact { carried, own_error, .. } = verified.reference else {
            panic!("{verified:?}")
        };
        println!("own error {own_error:.1e} K");
        assert_eq!(carried, 12);
        assert!(verified.passes() && own_error < 1e-10, "{verified:?}");
    }
    let system = ThermalSystem::assemble(&chain("90.001 [degC]")).unwrap();
    let run = settings.solve(&system).unwrap();
    let exact = ExactSolution::solve(&chain("90 [degC]"), 0.0, run.times()).unwrap();
    let wrong = Verification::against_exact(&exact, &[&run]);
    assert!(!wrong.passes(), "{wrong:?}");
}

#[test]
fn what_is_not_linear_beside_a_stream_is_still_not_exact() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", Temperature::celsius(10.0));
    let cell = b.node("cell", HeatCapacity(5.0), Temperature::celsius(10.0));
    stream(&mut b, "s1", (inlet, cell), rate(3.0));
    radiation(&mut b, "glow", (cell, inlet), "0.05 m^2");
    let found = Verification::of(&system(b), &Transient::until(Time(2.0))).unwrap();
    let Reference::FinerRun { reason: NoReference::Unsolved(reason), .. } = found.reference else {
        panic!("{found:?}")
    };
    assert!(reason.to_string().contains("`glow`"), "{reason}");
}
