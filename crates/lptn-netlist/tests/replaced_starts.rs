//! Temperatures at the start that a state replaces: values of their parameters have no effect, and
//! no study and no `--set` gives them one in silence.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, Rejected, parse_with};

const STATE: &str = r#"{ "format": 1, "network": "body", "time": { "value": 0.0, "unit": "s" },
  "end": "reached", "temperatures": { "unit": "K", "values": { "a": 310.0, "b": 320.0 } },
  "melted": {}, "states": {}, "controls": {} }"#;

/// Two bodies, one with its own start and one with that of `[default]`; only `T_a` and `T_b` are
/// for starts alone.
fn netlist(initial: &str, more: &str) -> Result<Netlist, Rejected> {
    let text = format!(
        "format = 1\n[param]\nT_a = \"20 degC\"\nT_b = \"30 degC\"\nT_room = \"20 degC\"\n\
         [default]\nT0 = \"T_b\"\n\
         [node]\na = {{ C = \"1 kJ/K\", T0 = \"T_a + (T_room - 20 [degC])\" }}\n\
         b = {{ C = \"1 kJ/K\" }}\n[boundary]\nroom = {{ T = \"T_room\" }}\n\
         [resistor]\nr = {{ from = \"a\", to = \"b\", R = \"1 K/W\" }}\n\
         s = {{ from = \"b\", to = \"room\", R = \"1 K/W\" }}\n\
         [run]\nstop = \"1 min\"\n{initial}\n{more}\n"
    );
    parse_with("body.toml", &text, &mut |_| Ok(STATE.as_bytes().to_vec()))
}

const INITIAL: &str = "initial = \"state.json\"";

/// The parameters of the doubts, in the order of the warnings.
fn idle(netlist: &Netlist) -> Vec<&str> {
    let doubts = netlist.warnings.iter().filter(|w| w.code == "netlist::initial_replaces");
    let named = doubts.map(|doubt| doubt.message.split_once(" gives `").unwrap().1);
    named.map(|rest| rest.split('`').next().unwrap()).collect()
}

#[test]
fn a_value_that_a_state_replaces_is_doubted_where_it_is_set() {
    for (initial, names) in [(INITIAL, vec!["T_a", "T_b"]), ("", vec![])] {
        let mut netlist = netlist(initial, "").unwrap();
        assert!(netlist.warnings.is_empty(), "{:?}", netlist.warnings);
        for name in ["T_a", "T_b", "T_room"] {
            netlist.set(&[format!("{name}=60degC")]).unwrap();
        }
        assert_eq!(idle(&netlist), names, "{initial}");
    }
}

#[test]
fn a_study_of_a_value_that_a_state_replaces_is_doubted() {
    let sweep = "[sweep.s]\nmethod = \"list\"\nover = \"run\"\nreport = { m = \"max(a.T)\" }\n\
                 axes = { T_a = [\"0 degC\", \"40 degC\"] }";
    let size = "[size.z]\nmaximise = \"T_b\"\n\
                vary = { T_b = { from = \"0 degC\", to = \"90 degC\" } }\n\
                require = [\"a.T <= 60 [degC]\"]\nover = \"run\"";
    let doubts = |initial: &str, study: &str| {
        let netlist = netlist(initial, study).unwrap();
        idle(&netlist).into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(doubts(INITIAL, sweep).contains(&"T_a".to_owned()));
    assert!(doubts(INITIAL, size).contains(&"T_b".to_owned()));
    for study in [sweep.replace("T_a", "T_room"), sweep.to_owned(), size.to_owned()] {
        assert!(doubts("", &study).is_empty());
    }
    assert!(doubts(INITIAL, &sweep.replace("T_a", "T_room")).is_empty());
}
