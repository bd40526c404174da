//! Cases in which results read temperatures.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;

use super::{Reading, reads_temperatures};
use crate::scripted::bodies;

/// True for a body that a heat enters, with further sections, if temperatures are read.
fn reads(sections: &str) -> bool {
    let text = format!(
        "format = 1\n[node]\nbody = {{ C = \"1 J/K\", T0 = \"400 K\" }}\n[boundary]\nair = {{ T \
         = \"300 K\" \
         }}\n[resistor]\nskin = {{ from = \"body\", to = \"air\", R = \"1 K/W\" }}\n{sections}\n"
    );
    let netlist = lptn_netlist::parse("reads.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    reads_temperatures(&netlist.network)
}

const RUN: &str = "[run]\nstop = \"1 s\"\n";

#[test]
fn results_read_temperatures_and_laws_that_tell_nothing_do_not() {
    assert!(!reads(RUN));
    assert!(reads(&format!("{RUN}report = {{ twice = \"2 * (body.T - air.T)\" }}\n")));
    let limit = "[limit]\nhot = { of = \"body.T\", below = \"500 degC\" }\n";
    assert!(reads(&format!("{limit}{RUN}")));
    assert!(reads(&format!("{limit}{RUN}report = {{ loss = \"skin.Q\" }}\n")));
}

/// Expressions that are not part of the network may read them too.
#[test]
fn a_reading_of_any_expression_takes_temperatures() {
    let system = ThermalSystem::assemble(&bodies(&[(1.0, "1 [W]")], None)).unwrap();
    assert!(!Reading::new(&system).reads && Reading::of_any(&system).reads);
}
