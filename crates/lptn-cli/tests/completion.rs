//! Names that a shell is offered: those of the netlist on the command line.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, Ran};

/// What bash is offered for the last of these words.
fn offered(folder: &Folder, words: &[&str]) -> Vec<String> {
    let words: Vec<&str> = ["--", "lptn"].iter().chain(words).copied().collect();
    let mut command = folder.command(&words);
    let index = (words.len() - 2).to_string();
    command.envs([("COMPLETE", "bash"), ("_CLAP_IFS", "\n"), ("_CLAP_COMPLETE_INDEX", &index)]);
    command.envs([("_CLAP_COMPLETE_COMP_TYPE", "9"), ("_CLAP_COMPLETE_SPACE", "false")]);
    let ran = Ran::of(command.output().unwrap()).exits(0);
    ran.out.lines().map(str::to_owned).collect()
}

#[test]
fn names_of_the_netlist_are_offered() {
    let folder = Folder::with_gearbox();
    assert_eq!(offered(&folder, &["run", "gearbox.toml", "--set", "T_"]), ["T_amb="]);
    assert_eq!(offered(&folder, &["run", "gearbox.toml", "--select", "st"]), ["steel.T"]);
    assert_eq!(offered(&folder, &["steady", "gearbox.toml", "--balance", "al"]), ["aluminium"]);
    assert_eq!(offered(&folder, &["reduce", "gearbox.toml", "--port", "s"]), ["steel"]);
    assert!(offered(&folder, &["materials", "steel_8"]).contains(&"steel_8620".to_owned()));
    assert_eq!(offered(&folder, &["stea"]), ["steady"]);
    folder.write(
        "plan.toml",
        "format = 1\n[param]\nR = \"1 K/W\"\n[node]\na = { C = \"1 J/K\", \
        T0 = \"20 degC\" }\n[boundary]\nb = { T = \"20 degC\" }\n[resistor]\nr = { from = \"a\", \
        to = \"b\", R = \"R\" }\n[plan.next]\nknow = { R = \"5 %\" }\nevery = \"1 s\"\n\
        duration = \"1 min\"\nplace = { a = { of = \"a.T\", noise = \"1 K\" } }\n",
    );
    assert_eq!(offered(&folder, &["plan", "plan.toml", "ne"]), ["next"]);
    folder.write("r.csv", "t [s],x [degC]\n0,25\n60,30\n");
    let fit = "[fit.near]\ndata = \"r.csv\"\ncolumn = { x = \"a.T\" }\nvary = [\"R\"]\n";
    folder.write("fit.toml", &(folder.read("plan.toml") + fit));
    assert_eq!(offered(&folder, &["fit", "compare", "fit.toml", "--fit", "ne"]), ["near"]);
}

/// A netlist that cannot be read offers nothing, and says nothing between the words of a shell.
#[test]
fn what_cannot_be_read_offers_nothing() {
    let folder = Folder::with("broken.toml", "format = 1\n[node\n");
    assert!(offered(&folder, &["run", "broken.toml", "--set", ""]).is_empty());
    assert!(offered(&folder, &["run", "missing.toml", "--set", ""]).is_empty());
}

#[test]
fn a_shell_gets_the_script_that_asks() {
    let folder = Folder::empty();
    let mut command = folder.command(&[]);
    let ran = Ran::of(command.env("COMPLETE", "bash").output().unwrap()).exits(0);
    ran.prints("complete ");
}
