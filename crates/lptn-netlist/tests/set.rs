//! `--set`: other values for parameters.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; exact numbers"
)]

use lptn_netlist::{Netlist, Rejected, parse};
use lptn_network::Item;

const TEXT: &str = "format = 1

[param]
omega = \"1000 rpm\"
P = \"0.1 [W/rpm] * omega\"
R_out = \"0.5 K/W\"
share = 0.25
T_amb = \"25 degC\"
tau = \"20 s\"

[node]
block = { T0 = \"T_amb\", C = \"500 J/K\" }

[boundary]
air = { T = \"T_amb\" }

[resistor]
cooling = { from = \"block\", to = \"air\", R = \"R_out * (1 - share)\" }

[source]
loss = { into = \"block\", P = \"P\" }

[run]
stop = \"3 * tau\"
";

fn netlist() -> Netlist {
    parse("net.toml", TEXT).unwrap()
}

fn set(netlist: &mut Netlist, assignments: &[&str]) -> Result<(), Rejected> {
    let assignments: Vec<String> = assignments.iter().map(|&text| text.to_owned()).collect();
    netlist.set(&assignments)
}

fn refused(assignments: &[&str]) -> String {
    let mut netlist = netlist();
    let rejected = set(&mut netlist, assignments).unwrap_err();
    assert!(!rejected.syntax);
    rejected.to_string()
}

fn power(netlist: &Netlist) -> f64 {
    let mut powers = [0.0];
    netlist.network.source_powers(&mut netlist.network.evaluation(), &mut powers).unwrap();
    powers[0]
}

#[test]
fn values_and_what_depends_on_them_change() {
    let mut netlist = netlist();
    assert!((power(&netlist) - 100.0).abs() < 1e-9);
    set(&mut netlist, &["omega=5000rpm", "share = 0.5"]).unwrap();
    assert!((power(&netlist) - 500.0).abs() < 1e-9);
    let Item::Conductor(cooling) = netlist.network.item("cooling").unwrap() else {
        panic!("a conductor")
    };
    assert!((netlist.network.conductance(cooling).unwrap() - 4.0).abs() < 1e-12);
}

#[test]
fn the_run_follows_its_parameters() {
    let mut netlist = netlist();
    set(&mut netlist, &["tau=1 min"]).unwrap();
    assert_eq!(netlist.run.unwrap().stop, 180.0);
}

#[test]
fn what_was_set_before_stays_set() {
    let mut netlist = netlist();
    set(&mut netlist, &["omega=2000 rpm"]).unwrap();
    set(&mut netlist, &["share=0.5"]).unwrap();
    assert!((power(&netlist) - 200.0).abs() < 1e-9);
}

#[test]
fn a_refused_assignment_changes_nothing() {
    let mut netlist = netlist();
    set(&mut netlist, &["omega=2000 rpm", "share=2"]).unwrap_err();
    assert!((power(&netlist) - 100.0).abs() < 1e-9);
}

#[test]
fn every_problem_is_named() {
    let expected = "\
error[netlist::bad_assignment]: `omega` is not an assignment
 --> --set:1:1: `=` is missing
  = help: write NAME=VALUE, for example `omega=5000rpm`
error[netlist::unknown_parameter]: there is no parameter `shar`
 --> --set:2:1
 ::: net.toml:7:9: its value in the netlist
  = help: did you mean `share`?
error[units::dimension]: parameter `R_out` must be a thermal resistance (K/W), got a thermal \
conductance (W/K)
 --> --set:3:7
 ::: net.toml:6:9: its value in the netlist
  = help: write \"1 / (2 [W/K])\"";
    let found = refused(&["omega", "shar=2", "R_out=2 W/K"]);
    assert_eq!(found, expected, "\n{found}");
}

/// A field of an element is not a parameter: the message has the lines that make it one.
#[test]
fn a_field_of_an_element_shows_the_parameter_that_it_needs() {
    for (assignment, help) in [
        ("air.T=30 degC", "its value is the parameter `T_amb`: set that"),
        ("cooling.R=1 K/W", "only parameters can be set: set one that this value reads"),
        (
            "block.C=1 J/K",
            "only parameters can be set: add `block_C = \"500 J/K\"` below [param], write `C = \
             \"block_C\"` in `block`, and set `block_C`",
        ),
    ] {
        let found = refused(&[assignment]);
        assert!(found.contains(help), "{found}");
    }
}

#[test]
fn what_breaks_names_the_place_and_the_change() {
    let expected = "\
error[network::not_positive]: `R` of resistor `cooling` must be more than zero, got -0.5 K/W
 --> net.toml:18:45
 ::: --set:2:1: `share` is set here
  = help: check the sign: heat flows from the warm to the cold end, whichever is named first";
    let found = refused(&["omega=3 rpm", "share=2"]);
    assert_eq!(found, expected, "\n{found}");
}

#[test]
fn the_run_is_checked_again() {
    let found = refused(&["tau=-5 s"]);
    assert!(
        found.starts_with("error[netlist::run_stop]: the run ends at -15 s, but begins at 0 s"),
        "{found}"
    );
    assert!(found.contains("--set:1:1: `tau` is set here"), "{found}");
}

#[test]
fn the_same_parameter_twice_is_an_error() {
    let found = refused(&["share=0.5", "share=0.6"]);
    assert!(
        found.starts_with("error[netlist::assigned_twice]: parameter `share` is set twice"),
        "{found}"
    );
}

#[test]
fn expressions_are_for_netlists() {
    for text in ["tau=2*tau", "T_amb=T_amb"] {
        let found = refused(&[text]);
        assert!(
            found.contains("`--set` takes a number or a quantity, not an expression"),
            "{found}"
        );
    }
    let found = refused(&["omega=5 rpmm"]);
    assert!(found.contains("did you mean \"5 rpm\"?"), "{found}");
}

#[test]
fn an_assignment_needs_a_name() {
    let expected = "\
error[netlist::bad_assignment]: `=5` names no parameter
 --> --set:1:1: a name is missing before `=`
  = help: write NAME=VALUE, for example `omega=5000rpm`";
    let found = refused(&["=5"]);
    assert_eq!(found, expected, "\n{found}");
}
