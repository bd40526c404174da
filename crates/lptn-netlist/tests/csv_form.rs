//! Statements about the form of a file, `{ csv = "c.csv", decimal = "," }`: the same for `[import]`,
//! sweeps, catalogues and records. The expected numbers are those in the files.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::io::{Error, ErrorKind};
use std::path::Path;

use lptn_netlist::{Netlist, Rejected, Severity, parse_with};
use lptn_network::Item;

const FILES: [(&str, &str); 6] = [
    ("n.csv", "Netz;;\nname;C;T0\na;1,234;25,5\nb;2,345;25,5\n"),
    ("c.csv", "from;to;Gr;name\na;b;1,234;rad\n"),
    ("l.csv", "from;to;G [W/K];name\na;air;1,234;line\n"),
    ("s.csv", "part;R [K/W]\nsmall;1,234\nlarge;2,345\n"),
    ("k.csv", "R;G\n1,234;2,345\n2,345;3,456\n"),
    ("r.csv", "t;T\n0;1,234\n60;2,345\n120;3,456\n"),
];

const MAIN: &str = r#"
format = 1

[param]
R = "1 K/W"
G = "1 W/K"
C = "1 J/K"

[import]
nodes = { csv = "n.csv", decimal = ",", units = { C = "kJ/K", T0 = "degC" } }
conductors = ["PLAIN", { csv = "c.csv", decimal = ",", units = { Gr = "cm^2" } }]

[node]
body = { C = "C", T0 = "20 degC" }

[boundary]
air = { T = "20 degC" }

[resistor]
out = { from = "a", to = "air", R = "R" }
skin = { from = "body", to = "air", G = "G" }

[sweep.all]
method = "csv"
file = { csv = "k.csv", decimal = ",", units = { R = "K/W", G = "W/K" } }
report = { T = "a.T" }

[size.part]
minimise = "R"
catalogue = [{ csv = "s.csv", decimal = "," }]
require = ["a.T <= 80 [degC]"]

[fit.heat]
data = { csv = "r.csv", decimal = ",", units = { t = "s", T = "degC" } }
column = { T = "body.T" }
vary = ["C", "G"]
"#;

fn read(main: &str) -> Result<Netlist, Rejected> {
    let main =
        main.replace("PLAIN", "l.csv").replace("\"l.csv\"", "{ csv = \"l.csv\", decimal = \",\" }");
    raw(&main)
}

fn raw(main: &str) -> Result<Netlist, Rejected> {
    parse_with("main.toml", main, &mut |path: &Path| {
        let found = FILES.iter().find(|(name, _)| Path::new(name) == path);
        let found = found.map(|(_, text)| text.as_bytes().to_vec());
        found.ok_or_else(|| Error::from(ErrorKind::NotFound))
    })
}

/// The numbers that the four kinds of files give, in SI units.
fn numbers(netlist: &Netlist) -> Vec<f64> {
    let network = &netlist.network;
    let node = network.node("a").unwrap();
    let mut found = vec![network.capacity(node), network.initial(node)];
    let mut paths = network.conductor_ids();
    let line = paths.find(|id| network.name_of(Item::Conductor(*id)) == "line").unwrap();
    found.push(network.conductance(line).unwrap());
    let plan = netlist.studies.sweeps[0].plan(network).unwrap();
    found.extend(plan.axes.iter().map(|(_, axis)| axis.value(1)));
    found.extend(&netlist.studies.sizes[0].catalogues[0].columns[0].values);
    found.extend(&netlist.studies.fits[0].records[0].record.columns[0].values);
    found
}

const EXPECTED: [f64; 10] =
    [1234.0, 298.65, 1.234, 2.345, 3.456, 1.234, 2.345, 274.384, 275.495, 276.606];

#[test]
fn one_form_is_read_alike_in_imports_sweeps_catalogues_and_records() {
    let netlist = read(MAIN).unwrap();
    let found = numbers(&netlist);
    assert_eq!(found.len(), EXPECTED.len());
    for (found, expected) in found.iter().zip(EXPECTED) {
        assert!((found - expected).abs() < 1e-9 * expected, "{found} is not {expected}");
    }
    let notes = netlist.warnings.iter().filter(|one| one.severity == Severity::Note);
    let notes: Vec<_> = notes.map(|note| note.message.as_str()).collect();
    for (name, _) in FILES {
        assert_eq!(
            notes.iter().filter(|note| note.starts_with(name)).count(),
            1,
            "{name}: {notes:?}"
        );
    }
}

/// A study that is written back names the form of its file.
#[test]
fn an_expansion_keeps_the_form() {
    let text = read(MAIN).unwrap().expanded();
    for line in [
        "file = { csv = \"k.csv\", decimal = \",\", units = { R = \"K/W\", G = \"W/K\" } }",
        "catalogue = [{ csv = \"s.csv\", decimal = \",\" }]",
        "data = [{ csv = \"r.csv\", decimal = \",\", units = { t = \"s\", T = \"degC\" } }]",
    ] {
        assert!(text.contains(line), "{line}\n\n{text}");
    }
    let again = raw(&text).unwrap();
    assert_eq!(numbers(&again), numbers(&read(MAIN).unwrap()));
}

/// Without the statement each of the files can be read in two ways, and the note shows where to
/// write it.
#[test]
fn a_file_that_can_be_read_in_two_ways_is_refused_everywhere() {
    for (table, name) in [
        ("{ csv = \"n.csv\", decimal = \",\", units = { C = \"kJ/K\", T0 = \"degC\" } }", "c.csv"),
        ("{ csv = \"c.csv\", decimal = \",\", units = { Gr = \"cm^2\" } }", "c.csv"),
        ("{ csv = \"k.csv\", decimal = \",\", units = { R = \"K/W\", G = \"W/K\" } }", "k.csv"),
        ("{ csv = \"s.csv\", decimal = \",\" }", "s.csv"),
    ] {
        let refused = read(&MAIN.replace(table, &format!("\"{name}\""))).unwrap_err();
        let found = refused.diagnostics.iter().find(|one| one.code == "netlist::csv_decimal");
        let found = found.unwrap_or_else(|| panic!("{name}: {refused}"));
        let note = format!("`{{ csv = \"{name}\", decimal = \",\" }}`");
        assert!(found.notes.iter().any(|one| one.contains(&note)), "{found:?}");
    }
}
