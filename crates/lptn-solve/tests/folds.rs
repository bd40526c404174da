//! A massless node of several solutions leaps where the one that it follows ends, against the
//! quadrature of its balance.
//!
//! `10 W tanh((x - 340 K) / 2 K) = 2 W/K (x - 300 K) + 2 W/K (x - T)` gives the temperature T of a
//! body at which a joint rests at x. It turns where the slope of the heat is 4 W/K: there the joint
//! leaps.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{Solution, Transient, Watch};

/// Capacity of the body in J/K.
const C: f64 = 100.0;

/// The heat of the body in W, for 60 s.
const P: f64 = 300.0;
const OFF: f64 = 60.0;

/// The joint is so far from 340 K at the ends of its branches: `sech^2 = 0.8` there.
fn end() -> f64 {
    2.0 * 0.2_f64.sqrt().atanh()
}

/// The temperature of the body at which the joint rests at x, and its derivative; all in K.
fn body(x: f64) -> (f64, f64) {
    let tanh = ((x - 340.0) / 2.0).tanh();
    (2.0 * x - 300.0 - 5.0 * tanh, 2.0 - 2.5 * (1.0 - tanh * tanh))
}

/// Where the joint rests on its lower or its upper branch.
fn joint(at: f64, upper: bool) -> f64 {
    let sign = if upper { 1.0 } else { -1.0 };
    let (mut near, mut far) = (340.0 + sign * end(), 340.0 + sign * 200.0);
    for _ in 0..200 {
        let middle = 0.5 * (near + far);
        if (body(middle).0 - at) * sign > 0.0 { far = middle } else { near = middle }
    }
    0.5 * (near + far)
}

/// How fast the joint moves where it is at x and the body has a heat.
fn speed(x: f64, heat: f64) -> f64 {
    let (at, slope) = body(x);
    (heat - 2.0 * (at - 300.0) - 2.0 * (at - x)) / (C * slope)
}

/// The time in s that the joint takes from one temperature to another, by the midpoint rule.
fn takes((from, to): (f64, f64), heat: f64) -> f64 {
    let count = 200_000;
    let step = (to - from) / f64::from(count);
    (0..count).map(|k| step / speed(from + (f64::from(k) + 0.5) * step, heat)).sum()
}

/// Where the joint is so many s later.
fn after(mut x: f64, time: f64, heat: f64) -> f64 {
    let count = 20_000;
    let step = time / f64::from(count);
    for _ in 0..count {
        let half = x + 0.5 * step * speed(x, heat);
        x += step * speed(half, heat);
    }
    x
}

/// The joint at the end of heating and of 60 s of cooling, and when it leaps, up and down.
fn exact() -> ([f64; 2], [f64; 2]) {
    let (low, high) = (340.0 - end(), 340.0 + end());
    let up = takes((joint(300.0, false), low), P);
    let heated = after(joint(body(low).0, true), OFF - up, P);
    let down = OFF + takes((heated, high), 0.0);
    ([heated, after(joint(body(high).0, false), 2.0 * OFF - down, 0.0)], [up, down])
}

fn run(tolerance: f64) -> Solution {
    let text = format!(
        "format = 1\n[node]\nbody = {{ C = \"100 J/K\", T0 = \"absolute(300 [K])\" }}\njoint = \
         {{ massless = true \
         }}\n[boundary]\nair = {{ T = \"absolute(300 [K])\" }}\n[resistor]\nskin = {{ from = \
         \"body\", to = \"air\", G = \"2 \
         W/K\" }}\nfilm = {{ from = \"joint\", to = \"air\", G = \"2 W/K\" }}\nwall = {{ from = \
         \"body\", to = \"joint\", G = \"2 \
         W/K\" }}\n[source]\nheat = {{ into = \"body\", P = \"if(t < {OFF} [s], {P} [W], 0 \
         [W])\" }}\nown = {{ into = \
         \"joint\", P = \"10 [W] * tanh((T - absolute(340 [K])) / 2 [K])\" }}\n[limit]\nleaps = \
         {{ of = \"joint.T\", \
         below = \"absolute(340 [K])\" }}\n[run]\nstop = \"120 s\"\n"
    );
    let netlist = lptn_netlist::parse("folds.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let node = netlist.network.node("joint").unwrap();
    let watch = vec![Watch { node, level: Some(340.0) }];
    let settings = Transient { watch, ..Transient::until(Time(2.0 * OFF)) };
    settings.every(Time(1.0)).tolerance(tolerance).solve(&system).unwrap()
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

#[test]
fn a_joint_leaps_at_the_ends_of_its_branches() {
    let (joints, leaps) = exact();
    for tolerance in [1e-3, 1e-5] {
        let solution = run(tolerance);
        let network = solution.network();
        let [of_body, of_joint] = ["body", "joint"]
            .map(|name| solution.temperature(network.node(name).unwrap()).unwrap());
        let rows = solution.times().iter().zip(of_body.iter().zip(&of_joint));
        for (time, (at, x)) in rows {
            near(body(*x).0, *at, 1e-6);
            let upper = *time > leaps[0] && *time < leaps[1];
            assert!((*x > 340.0) == upper, "{x} K at {time} s, leaps at {leaps:?} s");
        }
        for (row, exact) in [60, 120].into_iter().zip(joints) {
            near(of_joint[row], exact, 10.0 * tolerance);
        }
        near(solution.limits()[0].broken_at.unwrap(), leaps[0], 20.0 * tolerance);
        near(solution.watched()[0].crossed.unwrap(), leaps[0], 20.0 * tolerance);
        near(solution.watched()[0].peak.0, joints[0], 10.0 * tolerance);
        assert!(solution.ledger().closes() && solution.error_is_bounded());
    }
}

/// A run that goes on where another ended stands on the branch on which that one stood.
#[test]
fn a_run_that_goes_on_stays_on_its_branch() {
    let whole = run(1e-5);
    let system = ThermalSystem::assemble(whole.network()).unwrap();
    for part in [40.0, 70.0] {
        let first = Transient::until(Time(part)).at(&[part]).solve(&system).unwrap();
        let settings = Transient { start: part, ..Transient::until(Time(2.0 * OFF)) };
        let rest = settings.at(&[part, 2.0 * OFF]);
        let rest =
            rest.solve_from(&system, first.last_state(), &mut |_| lptn_solve::Proceed::Continue);
        let rest = rest.unwrap();
        for row in 0..2 {
            let known = whole.row_at(rest.times()[row]).unwrap();
            for (a, b) in rest.row(row).iter().zip(whole.row(known)) {
                near(*a, *b, 1e-4);
            }
        }
    }
}
