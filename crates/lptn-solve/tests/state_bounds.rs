//! States at their bounds: expressions, limits and functionals see exactly the bound.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, Time};
use lptn_solve::{Solution, SteadyState, Transient};

/// 100 J/K with 1 W/K to 20 degC; a state goes from 0.5 to a bound at 1 or at 0 within 50 s.
fn text(rate: &str, bound: &str, condition: &str) -> String {
    format!(
        "format = 1\n[node]\na = {{ C = '100 J/K', T0 = '20 degC' }}\n[boundary]\nroom = {{ T = '20 \
         degC' }}\n[resistor]\nl = {{ from = 'a', to = 'room', G = '1 W/K' }}\n[state]\nx = {{ rate = \
         '{rate}', start = 0.5, {bound} }}\n[source]\nh = {{ into = 'a', P = 'if({condition}, 40 \
         [W], 0 [W])' }}\n"
    )
}

fn system(text: &str) -> ThermalSystem {
    let netlist = lptn_netlist::parse("net.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

fn run(system: &ThermalSystem, integrator: IntegratorChoice, tolerance: f64) -> Solution {
    let transient = Transient::until(Time(600.0)).tolerance(tolerance);
    Transient { integrator, ..transient }.solve(system).unwrap_or_else(|e| panic!("{e}"))
}

/// The temperature of the body in degC after 600 s, heated from one time in s to another.
fn heated((from, to): (f64, f64)) -> f64 {
    let left = |since: f64| (-(600.0 - since) / 100.0).exp();
    20.0 + 40.0 * (left(to) - left(from))
}

/// Strict comparisons with a bound were true behind it: 59.8 instead of 20 degC, without a word.
#[test]
fn comparisons_with_a_bound_are_those_of_the_bound() {
    let (up, down) = (("0.01 1/s", "max = 1"), ("-0.01 1/s", "min = 0"));
    let (never, before, after, always) = ((0.0, 0.0), (0.0, 50.0), (50.0, 600.0), (0.0, 600.0));
    let cases = [
        (up, "x > 1", never),
        (up, "x >= 1", after),
        (up, "x < 1", before),
        (up, "x <= 1", always),
        (up, "3 * x > 3", never),
        (down, "x < 0", never),
        (down, "x <= 0", after),
        (down, "x > 0", before),
        (down, "x >= 0", always),
    ];
    for ((rate, bound), condition, on) in cases {
        let system = system(&text(rate, bound, condition));
        let network = system.network();
        let body = network.node("a").unwrap();
        for integrator in [IntegratorChoice::Auto, IntegratorChoice::Esdirk] {
            for tolerance in [1e-3, 1e-5, 1e-7] {
                let found = run(&system, integrator, tolerance).at_end(body).unwrap() - 273.15;
                let (right, most) = (heated(on), (10.0 * tolerance).max(1e-6));
                assert!((found - right).abs() <= most, "{condition}: {found} for {right}");
            }
        }
        let steady = SteadyState::solve(&system, 0.0).unwrap();
        let (found, hot) = (steady.temperatures[body.index()] - 273.15, on.1 > 599.0);
        let right = if hot { 60.0 } else { 20.0 };
        assert!((found - right).abs() < 1e-6, "{condition}: {found} for {right} in steady state");
    }
}

/// A limit at the bound is kept with a margin of exactly 0, in a run and in steady state.
#[test]
fn limits_and_functionals_see_the_bound() {
    for (rate, bound, limit, functional) in [
        ("-0.01 1/s", "min = 0", "above = 0", "time_under(x, 0)"),
        ("0.01 1/s", "max = 1", "below = 1", "time_over(x, 1)"),
    ] {
        let text = text(rate, bound, "t < 0 [s]")
            + &format!(
                "[limit]\nf = {{ of = 'x', {limit} }}\n[run]\nstop = '10 min'\nreport = {{ beyond = \
                 '{functional}' }}\n"
            );
        let system = system(&text);
        let solution = run(&system, IntegratorChoice::Auto, 1e-5);
        let margin = solution.limits()[0].margin;
        assert!(margin == 0.0, "{rate}: {margin:e}");
        let beyond = &solution.reports_over_time()[0];
        assert!(beyond.value == 0.0, "{rate}: {}", beyond.value);
    }
}
