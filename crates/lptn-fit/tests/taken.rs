//! What a held parameter moves if it is off.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFitTask, fit_network};
use lptn_netlist::parse_with;

/// A record of 67.2 K and 810 s tells P R and R C. With P held and off by its 10 W of 200 W, R moves
/// by -5 % and C by 5 %; `idle`, of which nothing is read, moves nothing.
#[test]
fn analytic_a_held_power_moves_resistance_and_capacity() {
    let text = "format = 1\n[param]\nP = \"200 ± 10 W\"\nR = \"0.3 K/W\"\nC = \"2600 J/K\"\n\
        idle = \"1 ± 0.5 W\"\n[node]\nbody = { C = \"C\", T0 = \"25.5 degC\" }\n\
        dummy = { C = \"1 J/K\", T0 = \"25.5 degC\" }\n[boundary]\nair = { T = \"25.5 degC\" }\n\
        [resistor]\nskin = { from = \"body\", to = \"air\", R = \"R\" }\n\
        own = { from = \"dummy\", to = \"air\", R = \"1 K/W\" }\n\
        [source]\nheat = { into = \"body\", P = \"P\" }\nrest = { into = \"dummy\", P = \"idle\" }\n\
        [fit.heating]\ndata = \"record.csv\"\ncolumn = { ring = \"body.T\" }\nvary = [\"R\", \"C\"]\n";
    let row = |k: u32| {
        let t = 30.0 * f64::from(k);
        format!("{t},{:.9}\n", 25.5 - 67.2 * f64::exp_m1(-t / 810.0))
    };
    let csv = "t [s],ring [degC]\n".to_owned() + &(0..=50).map(row).collect::<String>();
    let netlist = parse_with("body.toml", text, &mut |_| Ok(csv.clone().into_bytes())).unwrap();
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 2).unwrap();
    let off = task.taken_as_exact();
    let names: Vec<&str> = off
        .iter()
        .map(|off| netlist.network.parameters()[off.parameter.index()].name.as_str())
        .collect();
    assert_eq!(names, ["P", "idle"]);
    let moved = fit_network(&task).unwrap().moved_by(&task, &off).unwrap();
    let near = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} is not {expected}");
    };
    near(moved[0].by[0].unwrap(), -0.05 * 67.2 / 200.0);
    near(moved[0].by[1].unwrap(), 0.05 * 810.0 / (67.2 / 200.0));
    assert!(moved[1].rows.abs() < 1e-12 && moved[1].by[0].unwrap().abs() < 1e-12);
}
