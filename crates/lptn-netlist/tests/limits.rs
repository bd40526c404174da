//! Files that are too long, too wrong, or no files at all.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::cpu;

use std::fmt::Write as _;
use std::path::Path;

use cpu::takes_time_in_proportion;
use lptn_netlist::{MOST_BYTES, MOST_PROBLEMS, ReadError, parse, read};

fn code(path: &Path) -> &'static str {
    match read(path).unwrap_err() {
        ReadError::Rejected(rejected) => rejected.diagnostics[0].code,
        ReadError::Io { .. } => "",
    }
}

#[test]
fn a_file_over_the_limit_is_refused() {
    let path = std::env::temp_dir().join(format!("lptn-too-long-{}.toml", std::process::id()));
    std::fs::File::create(&path).unwrap().set_len(MOST_BYTES + 1).unwrap();
    let found = code(&path);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(found, "netlist::too_long");
}

#[cfg(unix)]
#[test]
fn a_device_is_refused_without_being_read() {
    assert_eq!(code(Path::new("/dev/zero")), "netlist::not_a_file");
}

/// A netlist with `wrong` lines, each with another mistake in its unit.
fn wrong_units(wrong: usize) -> String {
    let mut text = "format = 1\n[param]\n".to_owned();
    for i in 0..wrong {
        let _ = writeln!(text, "p{i} = \"{i}.5 Wattt{i}/(m2K)\"");
    }
    text
}

#[test]
fn many_mistakes_are_counted_in_time_in_proportion() {
    takes_time_in_proportion(16_000, |wrong| {
        let rejected = parse("wrong.toml", &wrong_units(wrong)).unwrap_err();
        assert_eq!(rejected.diagnostics.len(), MOST_PROBLEMS + 1);
        let last = rejected.diagnostics.last().unwrap();
        assert_eq!((last.code, last.place()), ("netlist::more", None));
        // the lines and the missing node
        assert_eq!(last.message, format!("and {} more problems", wrong + 1 - MOST_PROBLEMS));
    });
}

#[test]
fn many_broken_lines_are_counted_in_time_in_proportion() {
    takes_time_in_proportion(16_000, |lines| {
        let text = "format = 1\n[node]\n".to_owned() + &"a = \n".repeat(lines);
        let rejected = parse("broken.toml", &text).unwrap_err();
        assert_eq!(rejected.diagnostics.len(), MOST_PROBLEMS + 1);
        assert_eq!(rejected.diagnostics.last().unwrap().code, "netlist::more");
    });
}

#[test]
fn what_is_cut_off_is_warnings_before_errors() {
    let mut text = "format = 1\n[param]\n".to_owned();
    for i in 0..60 {
        let _ = writeln!(text, "p{i} = 1");
    }
    text += "[node]\na = { T0 = \"20 degC\", C = \"5 J/K\" }\n[boundary]\nair = { T = \"20 degC\" \
        }\n\
             [resistor]\nskin = { from = \"a\", to = \"air\", R = \"1 K/W\" }\n";
    let netlist = parse("unused.toml", &text).unwrap();
    assert_eq!(netlist.warnings.len(), MOST_PROBLEMS + 1);
    assert_eq!(netlist.warnings.last().unwrap().message, "and 10 more problems");
    let rejected = parse("unused.toml", &text.replace("J/K", "J/k")).unwrap_err();
    assert_eq!(rejected.diagnostics.len(), 1);
}
