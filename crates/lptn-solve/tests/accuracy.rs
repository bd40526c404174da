//! Tolerance: the global error of nonlinear networks stays within ten tolerances of closed forms
//! and of other programs.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::elements_helper as elements;

use elements::{
    ABSOLUTE, SIGMA, error, holds, last, link, of, own, power, quantity, radiation, run, stream,
    system, table,
};
use lptn_network::{
    AfterEnd, Conductance, Course, End, HeatCapacity, HeatFlow, Melting, NetworkBuilder, NodeId,
    Path, Properties, Size, Temperature,
};
use lptn_solve::Transient;
use lptn_units::{Dimension, Interpolation, Outside, Table1};

#[test]
fn radiation_cools_as_the_cube_root() {
    // T^-3 = T0^-3 + 3 sigma Gr t / C
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(1000.0));
    let space = b.boundary("space", Temperature(0.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    holds(&system(b), ball, 36_000.0, |t| (1e-9 + 3.0 * SIGMA * 0.05 * t / 500.0).powf(-1.0 / 3.0));
}

#[test]
fn natural_convection_cools_by_a_power() {
    // C x' = -h A x^1.25: x^-0.25 = x0^-0.25 + 0.25 h A t / C
    let mut b = NetworkBuilder::new();
    let plate = b.node("plate", HeatCapacity(800.0), Temperature(380.0));
    let room = b.boundary("room", Temperature(300.0));
    let h = link(&b, "1.3 [W/(m^2 K^1.25)] * abs(dT)^0.25");
    b.convection("film", plate, room, Path::film(h, quantity("0.6 m^2")));
    let exact = |t: f64| 300.0 + (80.0_f64.powf(-0.25) + 0.25 * 1.3 * 0.6 * t / 800.0).powi(-4);
    holds(&system(b), plate, 20_000.0, exact);
}

/// The temperature at which `f` is zero.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let sign = f(low).signum();
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle).signum() * sign > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn a_capacity_linear_in_temperature_follows_its_heat_content() {
    // C = 200 (1 + x / 500): 200 (x + x^2 / 1000) = P t without losses
    let mut b = NetworkBuilder::new();
    let capacity = own(&b, "200 [J/K] * (1 + (T - absolute(300 [K])) / 500 [K])");
    let block = b.node("block", capacity, Temperature(300.0));
    b.source("heater", block, HeatFlow(100.0));
    holds(&system(b), block, 1000.0, |t| 300.0 + 500.0 * ((1.0 + t / 500.0).sqrt() - 1.0));
}

#[test]
fn a_capacity_that_falls_a_hundredfold_keeps_the_tolerance() {
    // C = 1000 exp(-x / 20) into G = 1 at x_room = 200 is stiff towards the end; dx / dt = (200 -
    // x) / C. Here heat alone: H = 20000 (1 - exp(-x / 20)) = 100 t
    let mut b = NetworkBuilder::new();
    let capacity = own(&b, "1000 [J/K] * exp(-(T - absolute(300 [K])) / 20 [K])");
    let block = b.node("block", capacity, Temperature(300.0));
    b.source("heater", block, HeatFlow(100.0));
    // up to x = 100: C = 6.7
    let stop = 200.0 * (1.0 - (-5.0_f64).exp());
    holds(&system(b), block, stop, |t| 300.0 - 20.0 * (1.0 - t / 200.0).ln());
}

#[test]
fn a_small_capacity_at_the_end_still_settles_within_the_tolerance() {
    // C = 1000 exp(-x / 20), cooled by 1 W/K to x = 100 from x = 0: t = integral of C / (100 - x),
    // which has no closed form, but where it comes to rest it has
    let mut b = NetworkBuilder::new();
    let capacity = own(&b, "1000 [J/K] * exp(-(T - absolute(300 [K])) / 20 [K])");
    let block = b.node("block", capacity, Temperature(300.0));
    let room = b.boundary("room", Temperature(400.0));
    b.resistor("wall", block, room, Conductance(1.0));
    let system = system(b);
    for tolerance in [1e-3, 1e-5] {
        let found = last(&run(&system, 20_000.0, tolerance), block);
        assert!((found - 400.0).abs() < 10.0 * tolerance, "{found} at {tolerance}");
    }
}

#[test]
fn a_capacity_table_with_corners_follows_its_heat_content() {
    let mut b = NetworkBuilder::new();
    let (x, y) = ([250.0, 320.0, 350.0, 360.0, 500.0], [400.0, 500.0, 2000.0, 300.0, 350.0]);
    b.table("heat", table(&x, &y, Interpolation::Linear, (ABSOLUTE, of(Dimension::CAPACITY))));
    let capacity = own(&b, "heat(T)");
    let block = b.node("block", capacity, Temperature(300.0));
    b.source("heater", block, HeatFlow(100.0));
    let content =
        Table1::new(x.to_vec(), y.to_vec(), Interpolation::Linear, Outside::Error).unwrap();
    let exact = |t: f64| root(299.0, 500.0, |at| content.integral(300.0, at).unwrap() - 100.0 * t);
    holds(&system(b), block, 900.0, exact);
}

fn wax(b: &mut NetworkBuilder, liquidus: f64) -> NodeId {
    let melting = Melting {
        solidus: Temperature(330.0).into(),
        liquidus: Temperature(liquidus).into(),
        heat: quantity("200 kJ/kg"),
    };
    let cp = Some(quantity("2000 J/(kg K)"));
    let wax = b.material("wax", Properties { cp, melting: Some(melting), ..Properties::default() });
    let lump = b.lump(wax, Size::Mass(quantity("0.01 kg"))).unwrap();
    b.node("wax", lump, Temperature(300.0))
}

#[test]
fn melting_at_one_temperature_holds_it_until_all_is_molten() {
    // 20 J/K, 2000 J of latent heat, 10 W: 60 s to 330 K, 200 s of melting, then on
    let mut b = NetworkBuilder::new();
    let node = wax(&mut b, 330.0);
    b.source("heater", node, HeatFlow(10.0));
    let exact = |t: f64| match t {
        t if t < 60.0 => 300.0 + 0.5 * t,
        t if t < 260.0 => 330.0,
        t => 330.0 + 0.5 * (t - 260.0),
    };
    holds(&system(b), node, 400.0, exact);
}

#[test]
fn melting_at_one_temperature_under_cooling_takes_the_time_it_should() {
    // 1 W/K to 350 K: x = 50 (1 - exp(-t / 20)) up to 30; then 20 W melt 2000 J in 100 s; then 20 K
    // decay
    let mut b = NetworkBuilder::new();
    let node = wax(&mut b, 330.0);
    let room = b.boundary("room", Temperature(350.0));
    b.resistor("wall", node, room, Conductance(1.0));
    let (begin, end) = (20.0 * 2.5_f64.ln(), 20.0 * 2.5_f64.ln() + 100.0);
    let exact = |t: f64| match t {
        t if t < begin => 350.0 - 50.0 * (-t / 20.0).exp(),
        t if t < end => 330.0,
        t => 350.0 - 20.0 * (-(t - end) / 20.0).exp(),
    };
    holds(&system(b), node, 300.0, exact);
}

#[test]
fn melting_over_a_range_follows_its_heat_content() {
    let mut b = NetworkBuilder::new();
    let node = wax(&mut b, 340.0);
    b.source("heater", node, HeatFlow(10.0));
    let exact = |t: f64| match t {
        t if t < 60.0 => 300.0 + 0.5 * t,
        // 20 J/K and 200 J/K
        t if t < 280.0 => 330.0 + (t - 60.0) / 22.0,
        t => 340.0 + 0.5 * (t - 280.0),
    };
    holds(&system(b), node, 400.0, exact);
}

#[test]
fn freezing_gives_back_what_melting_took() {
    let mut b = NetworkBuilder::new();
    let node = wax(&mut b, 330.0);
    let p = b.expression("if(t < 300 [s], 10 [W], -10 [W])", None).unwrap();
    b.source("heater", node, p);
    let system = system(b);
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let solution = run(&system, 600.0, tolerance);
        assert!(
            (last(&solution, node) - 300.0).abs() < 10.0 * tolerance,
            "{}",
            last(&solution, node)
        );
        assert!(solution.ledger().stored[0].abs() < 20.0 * 10.0 * tolerance);
    }
}

#[test]
fn a_chain_of_stirred_cells_passes_a_step_on() {
    // equal cells of C / mcp = 5 s: 1 - exp(-s) sum s^k / k!, s = t / 5 s
    let mut b = NetworkBuilder::new();
    let mut upstream: End = b.boundary("inlet", Temperature(350.0)).into();
    let mut cell = b.node("n0", HeatCapacity(50.0), Temperature(300.0));
    for i in 0..6 {
        if i > 0 {
            cell = b.node(&format!("n{i}"), HeatCapacity(50.0), Temperature(300.0));
        }
        stream(&mut b, &format!("s{i}"), (upstream, cell), quantity("10 W/K"));
        upstream = cell.into();
    }
    let exact = |t: f64| {
        let s = t / 5.0;
        let terms = (1..6).scan(1.0, |term, k| {
            *term *= s / f64::from(k);
            Some(*term)
        });
        350.0 - 50.0 * (-s).exp() * (1.0 + terms.sum::<f64>())
    };
    holds(&system(b), cell, 100.0, exact);
}

#[test]
fn a_massless_skin_that_radiates_agrees_with_another_program() {
    // SciPy 1.17.1, solve_ivp(method="Radau", rtol=1e-12, atol=1e-11) on the body alone, the skin
    // by brentq with xtol = 1e-13: time, body, skin
    let reference = [
        (100.0, 576.625_577_296_652_4, 465.949_912_735_311_9),
        (300.0, 536.684_773_972_521_3, 446.731_014_764_760_07),
        (1000.0, 444.550_707_177_029_9, 397.051_458_791_650_6),
        (3000.0, 345.245_986_466_583_76, 333.245_548_948_510_93),
    ];
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(1000.0), Temperature(600.0));
    let skin = b.massless("skin");
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", body, skin, Conductance(2.0));
    radiation(&mut b, "glow", (skin, room), "0.1 m^2");
    let system = system(b);
    let times = reference.map(|(t, _, _)| t);
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-7] {
        let solution = Transient::until(lptn_network::Time(3000.0))
            .at(&times)
            .tolerance(tolerance)
            .solve(&system)
            .unwrap();
        for (row, (time, of_body, of_skin)) in reference.iter().enumerate() {
            let found = solution.row(row + 1);
            assert!(
                (found[0] - of_body).abs() <= 10.0 * tolerance,
                "{time} {found:?} at {tolerance}"
            );
            assert!(
                (found[1] - of_skin).abs() <= 10.0 * tolerance,
                "{time} {found:?} at {tolerance}"
            );
        }
    }
}

/// A node of 100 J/K at 300 K without losses, heated by a signal.
fn heated(course: Course) -> (lptn_assembly::ThermalSystem, NodeId) {
    let mut b = NetworkBuilder::new();
    b.signal("load", of(Dimension::POWER), course);
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = b.expression("load", None).unwrap();
    b.source("heater", node, p);
    (system(b), node)
}

fn curve(t: &[f64], v: &[f64], interp: Interpolation, after: AfterEnd) -> Course {
    let points = Table1::new(t.to_vec(), v.to_vec(), interp, Outside::Error).unwrap();
    Course::Curve { points, after }
}

#[test]
fn a_repeated_line_heats_by_its_area() {
    // 0 at 0 s, 100 at 2 s, 40 at 5 s, period 7 s (40 held for 2 s, then back to 0): 100 + 210 + 80
    // J a period
    let course =
        curve(&[0.0, 2.0, 5.0], &[0.0, 100.0, 40.0], Interpolation::Linear, AfterEnd::Repeat(7.0));
    let (system, node) = heated(course);
    let heat = |t: f64| match t {
        t if t < 2.0 => 25.0 * t * t,
        t if t < 5.0 => 100.0 + 100.0 * (t - 2.0) - 10.0 * (t - 2.0).powi(2),
        t => 310.0 + 40.0 * (t - 5.0),
    };
    let exact = |t: f64| {
        let k = (t / 7.0 * (1.0 + 1e-13)).floor();
        300.0 + (390.0 * k + heat(t - 7.0 * k)) / 100.0
    };
    holds(&system, node, 100.0, exact);
}

#[test]
fn repeated_steps_jump_where_they_say() {
    let (times, values) = (vec![0.0, 1.0, 3.0], vec![50.0, 0.0, 200.0]);
    let (system, node) = heated(Course::Steps { times, values, after: AfterEnd::Repeat(4.0) });
    let heat = |t: f64| 50.0 * t.min(1.0) + 200.0 * (t - 3.0).max(0.0);
    let exact = |t: f64| {
        let k = (t / 4.0 * (1.0 + 1e-13)).floor();
        300.0 + (250.0 * k + heat(t - 4.0 * k)) / 100.0
    };
    let solution = run(&system, 30.0, 1e-5);
    assert!(error(&solution, node, exact) < 1e-9);
    // rows at a jump hold the heat after it
    let rows = solution
        .times()
        .iter()
        .zip(solution.source_heat(system.network().source_ids().next().unwrap()));
    for (t, p) in rows {
        let phase = t - 4.0 * (t / 4.0 * (1.0 + 1e-13)).floor();
        let expected = if phase < 1.0 - 1e-9 {
            50.0
        } else if phase < 3.0 - 1e-9 {
            0.0
        } else {
            200.0
        };
        assert!((p - expected).abs() < 1e-12, "{t}: {p}");
    }
}

#[test]
fn a_repeated_cubic_jumps_back_at_the_end_of_its_period() {
    // regression: only straight signals had stop times. The area of a pchip is that of the table
    let points = Table1::new(
        vec![0.0, 1.0, 3.0],
        vec![0.0, 10.0, 200.0],
        Interpolation::Pchip,
        Outside::Error,
    )
    .unwrap();
    let whole = points.integral(0.0, 3.0).unwrap();
    let course = Course::Curve { points: points.clone(), after: AfterEnd::Repeat(3.0) };
    let (system, node) = heated(course);
    let breaks = system.network().breakpoints(0.0, 10.0).unwrap();
    assert_eq!(breaks, [3.0, 6.0, 9.0]);
    let exact = |t: f64| {
        let k = (t / 3.0 * (1.0 + 1e-13)).floor();
        300.0 + (whole * k + points.integral(0.0, (t - 3.0 * k).max(0.0)).unwrap()) / 100.0
    };
    holds(&system, node, 10.0, exact);
}

#[test]
fn kinks_of_time_are_stop_times() {
    for (text, expected) in [
        ("10 [W/s] * abs(t - 3.7 [s])", vec![3.7]),
        ("max(0 [W], 10 [W/s] * (t - 2.5 [s]))", vec![2.5]),
        ("min(40 [W], 10 [W/s] * t)", vec![4.0]),
        ("if(t < 6 [s], 1 [W], 2 [W])", vec![6.0]),
        ("10 [W] * abs(sin(t / 1 [s]))", vec![std::f64::consts::PI, 2.0 * std::f64::consts::PI]),
    ] {
        let mut b = NetworkBuilder::new();
        let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
        let p = b.expression(text, None).unwrap();
        b.source("heater", node, p);
        let found = b.build().unwrap().breakpoints(0.0, 8.0).unwrap();
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        assert!(
            found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-9),
            "{text}: {found:?}"
        );
    }
}

#[test]
fn a_loss_table_of_a_speed_that_ramps_is_stopped_at_its_knots() {
    // speed 0 to 100 rad/s in 10 s; loss 0, 20, 100 W at 0, 40, 100 rad/s: knots pass at 4 s; 40 +
    // 360 J in all
    let mut b = NetworkBuilder::new();
    let speed = of(Dimension::ANGULAR_VELOCITY);
    b.signal(
        "speed",
        speed,
        curve(&[0.0, 10.0], &[0.0, 100.0], Interpolation::Linear, AfterEnd::Hold),
    );
    let symbol = table(
        &[0.0, 40.0, 100.0],
        &[0.0, 20.0, 100.0],
        Interpolation::Linear,
        (speed, of(Dimension::POWER)),
    );
    b.table("loss", symbol);
    let node = b.node("node", HeatCapacity(100.0), Temperature(300.0));
    let p = power(&b, "loss(speed)");
    b.source("gears", node, p);
    let system = system(b);
    assert_eq!(system.network().breakpoints(0.0, 20.0).unwrap(), [4.0, 10.0]);
    let heat = |t: f64| match t {
        t if t < 4.0 => 2.5 * t * t,
        t if t < 10.0 => 40.0 + 20.0 * (t - 4.0) + 20.0 / 3.0 * (t - 4.0).powi(2),
        t => 400.0 + 100.0 * (t - 10.0),
    };
    holds(&system, node, 20.0, |t| 300.0 + heat(t) / 100.0);
}

#[test]
fn a_capacity_that_falls_a_thousandfold_still_holds_the_tolerance() {
    // regression: the tolerance was that of the heat content over the capacity at the start. From
    // 306 K on C = 1 J/K, and what is left of the start is forgotten: x = 50 + 20 / sqrt(2) sin(t -
    // pi / 4)
    let mut b = NetworkBuilder::new();
    let (x, y) = ([250.0, 305.0, 306.0, 500.0], [1000.0, 1000.0, 1.0, 1.0]);
    b.table("heat", table(&x, &y, Interpolation::Linear, (ABSOLUTE, of(Dimension::CAPACITY))));
    let capacity = own(&b, "heat(T)");
    let block = b.node("block", capacity, Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    b.resistor("wall", block, room, Conductance(1.0));
    let p = b.expression("50 [W] + 20 [W] * sin(t / 1 [s])", None).unwrap();
    b.source("heater", block, p);
    let system = system(b);
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let solution = run(&system, 400.0, tolerance);
        let rows = solution.times().iter().zip(solution.temperature(block).unwrap());
        for (t, found) in rows.filter(|(t, _)| **t > 200.0) {
            let exact = 350.0 + 20.0 / 2.0_f64.sqrt() * (t - std::f64::consts::FRAC_PI_4).sin();
            assert!(
                (found - exact).abs() <= 10.0 * tolerance,
                "{t}: {found} {exact} at {tolerance}"
            );
        }
    }
}

#[test]
fn cooling_with_a_capacity_that_falls_follows_its_integral() {
    // C = 1000 exp(-x / 20), 1 W/K to x = 100: t = integral from 0 to x of C / (100 - s), by
    // Simpson's rule. It does not forget: a difference between two courses grows with their speed,
    // so that of the first steps does too
    let capacity = |x: f64| 1000.0 * (-x / 20.0).exp();
    let time = |x: f64| {
        let (n, f) = (4000, |s: f64| capacity(s) / (100.0 - s));
        let h = x / f64::from(n);
        let inner: f64 =
            (1..n).map(|k| (if k % 2 == 1 { 4.0 } else { 2.0 }) * f(f64::from(k) * h)).sum();
        h / 3.0 * (f(0.0) + inner + f(x))
    };
    let mut b = NetworkBuilder::new();
    let text = "1000 [J/K] * exp(-(T - absolute(300 [K])) / 20 [K])";
    let block = b.node("block", own(&b, text), Temperature(300.0));
    let room = b.boundary("room", Temperature(400.0));
    b.resistor("wall", block, room, Conductance(1.0));
    let system = system(b);
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let solution = run(&system, 300.0, tolerance);
        for (t, found) in solution.times().iter().zip(solution.temperature(block).unwrap()) {
            let x = found - 300.0;
            let off = (time(x) - t) * (100.0 - x) / capacity(x);
            let grown = ((100.0 - x) / capacity(x) / 0.1).max(1.0);
            assert!(
                x > 99.0 || off.abs() <= 10.0 * tolerance * grown,
                "{t}: {x} is {off} K off at {tolerance}"
            );
        }
    }
}
