//! Values of the validation set (`validation/*/case.json`), copied with the place they are from.

mod common;

use common::{assembled, chain, near, two_nodes};
use lptn_network::{Area, Conductance, FilmCoefficient, HeatCapacity, HeatFlow, NetworkBuilder, Path};
use lptn_network::{Temperature, Time};
use lptn_reduce::{Bias, NortonEquivalent, Options, Reduction, fit_exponential, transfer_resistance};
use lptn_solve::{SteadyState, Transient};

/// gearbox_two_node: closed forms, and fits over 751 points from 0 to 1500 s by an independent program.
#[test]
fn gearbox_two_node() {
    let (system, [steel, aluminium]) = two_nodes([1235.0, 1424.0], 1.7 / 220.6, 65.5 / 220.6, 220.6);
    let at = |node| NortonEquivalent::new(&system, node).unwrap();
    near(at(steel).resistance, 0.304_623_753_399_818_7, 1e-12);
    near(at(aluminium).resistance, 0.296_917_497_733_454_2, 1e-12);
    near(transfer_resistance(&system, steel, aluminium).unwrap(), 0.296_917_497_733_454_2, 1e-12);
    near(transfer_resistance(&system, aluminium, steel).unwrap(), 0.296_917_497_733_454_2, 1e-12);
    near(at(steel).capacity_sum(system.network()), 2659.0, 1e-12);
    let dynamics = Reduction::new(&system, aluminium, &Options::default()).unwrap().dynamics.unwrap();
    near(dynamics.step.terms[0].tau, 793.952_560_566_783_6, 1e-9);
    near(dynamics.step.terms[1].tau, 5.068_291_654_431_279, 1e-9);
    let run = Transient::until(Time(1500.0)).every(Time(2.0)).tolerance(1e-7);
    let expected = [
        (
            steel,
            [25.953_841_877_379_16, 92.666_719_433_326_05, 792.840_661_382_671_4, 0.022_616_800_162_933_71],
        ),
        (
            aluminium,
            [25.101_602_652_961_063, 91.029_271_859_092_36, 794.942_465_824_167_6, 0.019_853_419_959_291_973],
        ),
    ];
    for (node, [initial, settled, tau, rms]) in expected {
        let bias = Bias::new(&system, node, &run).unwrap().unwrap();
        assert_eq!(bias.points, 751);
        assert!((bias.fit.initial - 273.15 - initial).abs() < 1e-4, "{bias:?}");
        assert!((bias.fit.settled - 273.15 - settled).abs() < 1e-4, "{bias:?}");
        assert!((bias.fit.tau - tau).abs() < 1e-3, "{bias:?}");
        assert!((bias.fit.rms - rms).abs() < 1e-5, "{bias:?}");
        near(bias.heat, 220.6, 1e-12);
        near(bias.inferred, (settled - initial) * 2659.0 / tau, 1e-5);
    }
}

/// bridge_steady: exact rational arithmetic; all nodes massless.
#[test]
fn bridge_steady() {
    let mut b = NetworkBuilder::new();
    let (a, d) = (b.boundary("a", Temperature::celsius(100.0)), b.boundary("d", Temperature::celsius(0.0)));
    let (n, c) = (b.massless("b"), b.massless("c"));
    b.resistor("ab", a, n, Conductance(3.0));
    b.resistor("ac", a, c, Conductance(2.0));
    b.resistor("bd", n, d, Conductance(5.0));
    b.resistor("cd", c, d, Conductance(7.0));
    b.resistor("bc", n, c, Conductance(4.0));
    let system = assembled(b);
    let norton = NortonEquivalent::new(&system, n).unwrap();
    near(norton.resistance, 0.092_857_142_857_142_86, 1e-14);
    near(transfer_resistance(&system, n, c).unwrap(), 0.028_571_428_571_428_57, 1e-14);
    near(norton.boundary_weights.iter().sum::<f64>(), 1.0, 1e-14);
    let reduction = Reduction::new(&system, n, &Options::default()).unwrap();
    assert!((reduction.inputs.reference - 273.15 - 33.571_428_571_428_57).abs() < 1e-12);
    assert!(reduction.dynamics.is_none());
}

/// emach_resistance_network: temperatures of eMach's own solver. The case asks for no port resistance, but the
/// port's temperature is `T_ref + R_eq Q_N`, and conductances span six decades.
#[test]
fn emach_resistance_network() {
    let mut b = NetworkBuilder::new();
    let ambient = b.boundary("n0", Temperature::celsius(25.0));
    let n: Vec<_> = (1..6).map(|i| b.massless(&format!("n{i}"))).collect();
    let conductances = [
        (0, 1, 0.266_666_666_666_666_66),
        (1, 2, 2.666_666_666_666_666_5),
        (1, 3, 0.000_266_666_666_666_666_7),
        (2, 4, 150.0),
        (3, 4, 0.015),
    ];
    for (i, &(from, to, g)) in conductances.iter().enumerate() {
        b.resistor(&format!("e{i}"), n[from], n[to], Conductance(g));
    }
    let film = || Path::Film(FilmCoefficient(10.0).into(), Area(0.005).into());
    b.convection("e5", n[2], ambient, film());
    b.convection("e6", n[3], ambient, film());
    b.source("q0", n[0], HeatFlow(10.0));
    b.source("q1", n[4], HeatFlow(10.0));
    let system = assembled(b);
    let expected =
        [390.376_857_203_876_7, 352.876_857_203_876_7, 349.152_060_095_606_66, 100.847_939_904_393_36];
    for (&node, celsius) in n.iter().zip(expected).chain([(&n[4], 349.193_892_167_047_07)]) {
        let reduction = Reduction::new(&system, node, &Options::default()).unwrap();
        let rise = reduction.norton.resistance * reduction.inputs.heat;
        assert!((reduction.inputs.reference + rise - 273.15 - celsius).abs() < 1e-9, "{celsius}");
    }
}

/// rc_ladder: closed forms (discrete sine transform).
#[test]
fn rc_ladder() {
    let (system, nodes) = chain(&[50.0; 8], &[4.0; 8]);
    let reduction = Reduction::new(&system, nodes[7], &Options::default()).unwrap();
    near(reduction.norton.resistance, 2.0, 1e-13);
    near(transfer_resistance(&system, nodes[2], nodes[7]).unwrap(), 0.75, 1e-13);
    let tau = [
        367.066_223_679_649_3,
        41.727_069_584_659_52,
        15.728_597_840_160_953,
        8.604_821_060_433_45,
        5.722_037_030_415_315,
        4.323_050_554_083_825,
        3.594_001_122_196_057_7,
        3.234_199_128_401_67,
    ];
    let step = reduction.dynamics.unwrap().step;
    assert_eq!(step.terms.len(), 8);
    assert!(step.residual < 1e-10, "{step:?}");
    for (term, tau) in step.terms.iter().zip(tau) {
        near(term.tau, tau, 1e-10);
    }
}

/// incropera_3_2_chip: a chip between air above and a joint, a board and air below, massless throughout.
#[test]
fn incropera_3_2_chip() {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature::celsius(25.0));
    let [chip, joint, back] = ["chip", "joint", "back"].map(|name| b.massless(name));
    let film = || Path::Film(FilmCoefficient(100.0).into(), Area(1.0).into());
    b.convection("e0", chip, air, film());
    b.resistor("e1", chip, joint, Conductance(11_111.111_111_111_111));
    b.resistor("e2", joint, back, Conductance(29_875.0));
    b.convection("e3", back, air, film());
    let norton = NortonEquivalent::new(&assembled(b), chip).unwrap();
    near(norton.resistance, 0.005_030_678_800_958_934, 1e-13);
}

/// freq_two_node: closed forms.
#[test]
fn freq_two_node() {
    let (system, [n1, n2]) = two_nodes([300.0, 2000.0], 0.25, 0.5, 0.0);
    let norton = NortonEquivalent::new(&system, n1).unwrap();
    near(norton.resistance, 0.75, 1e-13);
    near(NortonEquivalent::new(&system, n2).unwrap().resistance, 0.5, 1e-13);
    near(norton.capacity_sum(system.network()), 2300.0, 1e-12);
}

/// gearbox_speed_sweep: seven separate nodes at one boundary; each is its own equivalent.
#[test]
fn gearbox_speed_sweep() {
    let mut b = NetworkBuilder::new();
    let zero = Temperature::celsius(0.0);
    let bed = b.boundary("bed", zero);
    let heat = [
        8.700_000_000_000_005,
        27.620_778_304_246_688,
        54.290_187_781_654_74,
        87.690_505_072_683_22,
        127.194_771_612_259_76,
        172.360_602_392_299_63,
        222.851_717_740_399_1,
    ];
    let nodes: Vec<_> = (1..8).map(|i| b.node(&format!("n{i}000"), HeatCapacity(2659.0), zero)).collect();
    for (i, &node) in nodes.iter().enumerate() {
        b.resistor(&format!("e{i}"), node, bed, Conductance(3.282_716_049_382_716));
        b.source(&format!("q{i}"), node, HeatFlow(heat[i]));
    }
    let system = assembled(b);
    let options = Options { run: Some(Transient::until(Time(1500.0))), window: None };
    let reduction = Reduction::new(&system, nodes[6], &options).unwrap();
    near(reduction.norton.resistance, 0.3046, 1e-4 / 0.3046);
    near(reduction.norton.resistance, 1.0 / 3.282_716_049_382_716, 1e-14);
    near(reduction.inputs.heat * reduction.norton.resistance, 67.886_382_613_660_5, 1e-10);
    assert_eq!(reduction.norton.source_weights, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let dynamics = reduction.dynamics.unwrap();
    near(dynamics.step.slowest().tau, 810.0, 1e-9);
    // the capacities of the other six are not behind this port
    dynamics.pairs.iter().for_each(|pair| near(pair.capacity, 2659.0, 1e-11));
    assert!((dynamics.rise.unwrap() - 57.231_869_041_234_1).abs() < 1e-6);
    assert!(dynamics.pairs.iter().all(|pair| pair.run.unwrap().kelvin < 1e-6));
}

/// `T_ref + R_eq Q_N` is the steady temperature of the port, by the other solver.
#[test]
fn the_port_gives_the_steady_state_of_every_network() {
    let (system, nodes) = chain(&[1.0, 3.0, 2.0, 5.0], &[0.1, 7.0, 0.3, 40.0]);
    let mut b = NetworkBuilder::new();
    let t = Temperature(300.0);
    let (hot, cold) = (b.boundary("hot", Temperature(350.0)), b.boundary("cold", Temperature(290.0)));
    let (x, y) = (b.node("x", HeatCapacity(3.0), t), b.node("y", HeatCapacity(4.0), t));
    let j = b.massless("j");
    b.resistor("a", hot, x, Conductance(0.2));
    b.resistor("b", x, j, Conductance(5.0));
    b.resistor("c", j, y, Conductance(2.0));
    b.resistor("d", y, cold, Conductance(0.7));
    b.resistor("e", j, cold, Conductance(0.05));
    b.source("p", j, HeatFlow(12.0));
    b.source("q", y, HeatFlow(-3.0));
    let two_boundaries = assembled(b);
    for (system, ports) in [(system, nodes), (two_boundaries, vec![x, y, j])] {
        let steady = SteadyState::solve(&system, 0.0).unwrap();
        for port in ports {
            let reduction = Reduction::new(&system, port, &Options::default()).unwrap();
            let norton = &reduction.norton;
            let port_temperature = reduction.inputs.reference + norton.resistance * reduction.inputs.heat;
            assert!((port_temperature - steady.temperatures[port.index()]).abs() < 1e-10);
            near(norton.boundary_weights.iter().sum::<f64>(), 1.0, 1e-13);
        }
    }
}

#[test]
fn a_fit_finds_one_exponential_again_and_says_where_there_is_none() {
    let times: Vec<f64> = (0..200).map(|k| 5.0 * f64::from(k)).collect();
    let curve = |tau: f64| -> Vec<f64> { times.iter().map(|t| 92.7 - 67.2 * (-t / tau).exp()).collect() };
    for tau in [3.0, 80.0, 810.0, 2e4] {
        let fit = fit_exponential(&times, &curve(tau)).unwrap();
        near(fit.tau, tau, 1e-7);
        assert!((fit.initial - 25.5).abs() < 1e-6 && (fit.settled / 92.7 - 1.0).abs() < 1e-6, "{fit:?}");
        assert!(fit.rms < 1e-9);
    }
    let code = |times: &[f64], values: &[f64]| fit_exponential(times, values).unwrap_err().code();
    assert_eq!(code(&times[..3], &curve(80.0)[..3]), "fit::too_few_points");
    assert_eq!(code(&times, &vec![20.0; 200]), "fit::flat");
    assert_eq!(code(&times, &times), "fit::no_curvature");
    assert_eq!(code(&[0.0, 1.0, 1.0, 2.0], &[0.0, 1.0, 2.0, 3.0]), "fit::not_a_record");
}
