//! Answers to steps, pulses and swings against closed forms.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use crate::elements_helper as elements;

use elements::{quantity, radiation, stream, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{Conductance, HeatCapacity, HeatFlow, Network, NetworkBuilder, Temperature};
use lptn_solve::{
    Complex, Drive, FrequencyResponse, Linearised, ResponseError, SteadyState, StepAnswer,
};

fn start() -> Temperature {
    Temperature::celsius(20.0)
}

/// 50 J/K at 4 K/W, with a massless junction 1 K/W before it.
fn one_node() -> ThermalSystem {
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(50.0), start());
    let joint = b.massless("joint");
    let air = b.boundary("air", start());
    b.resistor("inner", joint, body, Conductance(1.0));
    b.resistor("skin", body, air, Conductance(0.25));
    system(b)
}

fn node(network: &Network, name: &str) -> lptn_network::NodeId {
    network.node(name).unwrap()
}

#[test]
fn a_body_behind_a_junction_answers_as_one_exponential() {
    let system = one_node();
    let linear = Linearised::of(&system, None).unwrap();
    let network = system.network();
    let (body, joint) = (node(network, "body"), node(network, "joint"));
    let step = StepAnswer::new(&linear, Drive::Node(joint)).unwrap();
    let rise = |t: f64| -4.0 * (-t / 200.0_f64).exp_m1();
    for t in [0.0, 1e-3, 1.0, 200.0, 5e3] {
        assert!((step.value(body.index(), t) - rise(t)).abs() <= 1e-13 * rise(t), "{t}");
        assert!((step.value(joint.index(), t) - rise(t) - 1.0).abs() < 1e-14, "{t}");
        if t > 0.0 {
            let pulse = 1.0 + rise(t) / -(-t / 0.2 / 200.0_f64).exp_m1();
            assert!((step.pulse(joint.index(), t, 0.2) - pulse).abs() < 1e-13, "{t}");
        }
    }
    assert!((step.span(joint.index()).unwrap().0 / 200.0 - 1.0).abs() < 1e-13);
    let mut swing = FrequencyResponse::new(&linear, Drive::Node(joint)).unwrap();
    for omega in [0.0, 1e-4, 5e-3, 2.0] {
        let exact = Complex::new(4.0, 0.0) / Complex::new(1.0, 200.0 * omega);
        let found = swing.at(omega).unwrap();
        assert!((found[body.index()] - exact).norm() < 1e-14, "{omega}");
        assert!((found[joint.index()] - exact - 1.0).norm() < 1e-14, "{omega}");
    }
}

/// A circulant matrix: with `z = exp(2 pi i / n)` the modes are `z^(jk)`, and
/// `T_j(t) = 1/n sum_k z^(jk) (1 - exp(-s_k t)) / (C s_k)`.
#[test]
fn a_ring_of_streams_answers_a_step_as_its_closed_form_does() {
    let (n, flow, loss, c) = (7_usize, 10.0, 2.0, 50.0);
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", start());
    let cells: Vec<_> =
        (0..n).map(|i| b.node(&format!("cell{i}"), HeatCapacity(c), start())).collect();
    for i in 0..n {
        let ends = (cells[i], cells[(i + 1) % n]);
        stream(&mut b, &format!("hose{i}"), ends, quantity(&format!("{flow} W/K")));
        b.resistor(&format!("skin{i}"), cells[i], air, Conductance(loss));
    }
    let system = system(b);
    let linear = Linearised::of(&system, None).unwrap();
    let step = StepAnswer::new(&linear, Drive::Node(cells[0])).unwrap();
    let mut swing = FrequencyResponse::new(&linear, Drive::Node(cells[0])).unwrap();
    let unit = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        Complex::new(angle.cos(), angle.sin())
    };
    // a stream takes nothing from the cell that it leaves: heat comes from the one before
    let rate = |k: usize| (unit(k).conj() * -flow + (flow + loss)) / c;
    for (j, cell) in cells.iter().enumerate() {
        let sum = |of: &dyn Fn(Complex) -> Complex| -> Complex {
            (0..n).map(|k| unit(j * k) * of(rate(k))).sum::<Complex>() / (n as f64 * c)
        };
        for t in [0.5, 10.0, 300.0] {
            let exact = sum(&|s| (Complex::new(1.0, 0.0) - (-s * t).exp()) / s).re;
            let found = step.value(cell.index(), t);
            assert!((found - exact).abs() < 1e-13, "{j} at {t}: {found} {exact}");
        }
        for omega in [0.0, 0.05, 1.0] {
            let exact = sum(&|s| (s + Complex::new(0.0, omega)).inv());
            assert!((swing.at(omega).unwrap()[cell.index()] - exact).norm() < 1e-14, "{j}");
        }
    }
}

/// `P = sigma A (T^4 - T_b^4)`: dT/dT_b is `(T_b / T)^3`, dT/dP is `1 / (4 sigma A T^3)`.
#[test]
fn a_glowing_ball_follows_its_surroundings_by_its_slopes() {
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(900.0));
    let space = b.boundary("space", Temperature(600.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    let heater = b.source("heater", ball, HeatFlow(1000.0));
    let system = system(b);
    let refused = Linearised::of(&system, None).unwrap_err();
    assert!(refused.to_string().contains("`glow`"), "{refused}");
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let linear = Linearised::of(&system, Some(&steady)).unwrap();
    let settled = |drive| StepAnswer::new(&linear, drive).unwrap().settled[ball.index()];
    let sigma = 5.670_374_419e-8;
    let hot = (600.0_f64.powi(4) + 1000.0 / (sigma * 0.05)).powf(0.25);
    let by_space = settled(Drive::Boundary(space));
    assert!((by_space / (600.0 / hot).powi(3) - 1.0).abs() < 1e-8, "{by_space}");
    let by_heat = settled(Drive::Source(heater));
    assert!((by_heat * 4.0 * sigma * 0.05 * hot.powi(3) - 1.0).abs() < 1e-9, "{by_heat}");
}

#[test]
fn what_is_not_grounded_settles_at_no_temperature() {
    let mut b = NetworkBuilder::new();
    let loose = b.node("loose", HeatCapacity(10.0), start());
    let body = b.node("body", HeatCapacity(50.0), start());
    let air = b.boundary("air", start());
    b.resistor("skin", body, air, Conductance(0.25));
    let system = system(b);
    let linear = Linearised::of(&system, None).unwrap();
    let refused = StepAnswer::new(&linear, Drive::Node(loose)).unwrap_err();
    assert!(matches!(refused, ResponseError::NoGround { .. }), "{refused}");
    // elsewhere the island is in nobody's way, and it swings as a capacity does
    let step = StepAnswer::new(&linear, Drive::Node(body)).unwrap();
    assert!((step.value(body.index(), 200.0) - 4.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-14);
    assert!(step.value(loose.index(), 200.0).abs() < 1e-15);
    let mut swing = FrequencyResponse::new(&linear, Drive::Node(loose)).unwrap();
    assert!((swing.at(2.0).unwrap()[loose.index()] - Complex::new(0.0, -0.05)).norm() < 1e-16);
    assert!(matches!(swing.at(0.0).unwrap_err(), ResponseError::NoGround { .. }));
}

/// A chain of equal cells has one mode for all: cell k answers heat into the first by Erlang's
/// distribution, `1/mcp P(k, t mcp / C)`; a joint in the last hose follows at once. By mpmath with 40
/// digits; the pulses as their sum.
#[test]
fn a_chain_of_equal_cells_answers_a_step_as_erlang_has_it() {
    let mut b = NetworkBuilder::new();
    let inlet = b.boundary("inlet", start());
    let mut last: lptn_network::End = inlet.into();
    for i in 1..=6 {
        let cell = b.node(&format!("c{i}"), HeatCapacity(50.0), start());
        stream(&mut b, &format!("s{i}"), (last, cell), quantity("20 W/K"));
        last = cell.into();
    }
    let joint = b.massless("joint");
    stream(&mut b, "s7", (last, joint), quantity("20 W/K"));
    stream(&mut b, "s8", (joint, inlet), quantity("20 W/K"));
    let system = system(b);
    let linear = Linearised::of(&system, None).unwrap();
    let network = system.network();
    let of = |name: &str| node(network, name).index();
    let step = StepAnswer::new(&linear, Drive::Node(node(network, "c1"))).unwrap();
    let expected = [
        ("c1", 5.0, 0.043_233_235_838_169_37),
        ("c1", 20.0, 0.049_983_226_868_604_874),
        ("c6", 5.0, 8.281_804_240_307_22e-4),
        ("c6", 20.0, 0.040_438_196_896_018_74),
        ("joint", 20.0, 0.040_438_196_896_018_74),
    ];
    for (name, time, value) in expected {
        let found = step.value(of(name), time);
        assert!((found / value - 1.0).abs() < 1e-13, "{name} at {time} s: {found}");
    }
    assert!((step.value(of("c1"), 1e-6) / (1e-6 / 50.0) - 1.0).abs() < 1e-6);
    assert!((step.settled[of("c6")] - 0.05).abs() < 1e-16);
    // c1 forgets by itself: a geometric series of one exponential
    let pulse = 0.05 * (-2.0_f64).exp_m1() / (-8.0_f64).exp_m1();
    assert!((step.pulse(of("c1"), 5.0, 0.25) / pulse - 1.0).abs() < 1e-13);
    let (short, long) = step.span(of("c1")).unwrap();
    assert!((short / 2.5 - 1.0).abs() < 2e-3 && (long / 2.5 - 1.0).abs() < 2e-3, "{short} {long}");
}
