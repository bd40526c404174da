//! Files of signals: doubts about their values and times.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common::Folder;

/// The file of a signal is judged as a record is: a broken wire, and a clock that is set forward.
#[test]
fn a_signal_of_temperature_is_judged() {
    let net = "format = 1\n[node]\nbox = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n[signal]\nroom = { csv = \
        \"room.csv\", time = \"t\", value = \"T\", after_end = \"hold\" }\n[boundary]\nair = { T = \"room\" }\n\
        [resistor]\nskin = { from = \"box\", to = \"air\", R = \"1 K/W\" }\n[run]\nstop = \"10 min\"\n";
    let folder = Folder::with("net.toml", net);
    let signal = |value: &dyn Fn(u32) -> f64, time: &dyn Fn(u32) -> String, head: &str| {
        let rows: String = (0..40).map(|k| format!("{},{:.2}\n", time(k), value(k))).collect();
        folder.write("room.csv", &format!("{head},T [degC]\n{rows}"));
        folder.run(&["run", "net.toml", "--no-files"]).exits(0).err
    };
    let rise = |k: u32| 20.0 + 5.0 * (1.0 - f64::exp(-f64::from(k) / 9.0));
    let broken = |k: u32| if k == 21 { 1372.0 } else { rise(k) };
    let seconds = |k: u32| (10 * k).to_string();
    let said = signal(&broken, &seconds, "t [s]");
    assert!(said.contains("netlist::csv_outlier") && said.contains("reads 1372 degC"), "{said}");
    assert!(!signal(&rise, &seconds, "t [s]").contains("csv_outlier"));
    let clock = |k: u32| {
        format!("2026-03-29 {:02}:{:02}", (k + 4) / 6 + u32::from(k > 7), (k + 4) % 6 * 10)
    };
    let said = signal(&rise, &clock, "t");
    assert!(said.contains("netlist::csv_clock_change"), "{said}");
}
