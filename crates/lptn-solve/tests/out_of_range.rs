//! When laws are outside the ranges in which they are known, by hand: Re = rho u D / mu rises with
//! the speed.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_assembly::ThermalSystem;
use lptn_network::Time;
use lptn_solve::{Solution, Transient, Watch};

/// Re = 2750 s/m u is known from 0.4 to 4e5.
fn run(speed: &str, watches: bool) -> Solution {
    let text = format!(
        "format = 1\n[boundary]\nroom = {{ T = \"20 degC\" }}\n[node]\nrod = {{ T0 = \"80 \
         degC\", C = \"100 J/K\" \
         }}\n[convection.skin]\nfrom = \"rod\"\nto = \"room\"\ncorrelation = \
         \"cylinder_in_cross_flow_hilpert\"\nk = \
         \"0.0277 W/(m K)\"\ndensity = \"1.1 kg/m^3\"\ncp = \"1007 J/(kg K)\"\nviscosity = \"20 \
         uPa s\"\nspeed = \
         \"{speed}\"\ndiameter = \"50 mm\"\narea = \"0.02 m^2\"\n[run]\nstop = \"200 s\"\n"
    );
    let netlist = lptn_netlist::parse("rod.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let node = netlist.network.node("rod").unwrap();
    let watch = if watches { vec![Watch { node, level: None }] } else { Vec::new() };
    let settings = Transient { watch, ..Transient::until(Time(200.0)) };
    settings.at(&[]).solve(&system).unwrap()
}

fn near(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} for {expected}");
}

#[test]
fn a_law_is_outside_its_range_while_its_group_is() {
    for watches in [false, true] {
        let solution = run("1 [m/s^2] * t", watches);
        let found = solution.out_of_range();
        assert_eq!(found.len(), 2, "{found:?}");
        near(found[0].from, 0.0, 0.0);
        near(found[0].to, 0.4 / 2750.0, 1e-9);
        near(found[1].from, 4e5 / 2750.0, 1e-9);
        near(found[1].to, 200.0, 0.0);
        near(found[1].value, 2750.0 * 200.0, 1e-6);
        near(found[1].at, 200.0, 0.0);
    }
    assert!(run("3 m/s", false).out_of_range().is_empty());
}

/// Each step is looked at in six points, and between five of these, for a group may change faster
/// than temperatures do.
#[test]
fn a_group_that_follows_inputs_is_looked_at_ten_times_a_step() {
    for watches in [false, true] {
        let solution = run("1 [m/s^2] * t", watches);
        let (looks, steps) = (solution.looks().placed, solution.statistics().steps);
        assert!(steps > 100 && looks.abs_diff(10 * steps) <= 12, "{looks} looks in {steps} steps");
    }
}
