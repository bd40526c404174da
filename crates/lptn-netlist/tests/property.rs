//! Whatever the bytes: no panic, no network that breaks its promises, and time in proportion to the
//! length.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::cpu;

use std::fmt::Write as _;

use cpu::takes_time_in_proportion;
use lptn_netlist::{Netlist, Rejected, Severity, parse, parse_bytes, parse_with};
use proptest::prelude::*;

const GEARBOX: &str = include_str!("good/gearbox.toml");

/// Every element and every input.
const ELEMENTS: &str = include_str!("good/elements.toml");

/// Reads a netlist whose CSV files all hold these bytes.
fn with_csv(text: &str, csv: &[u8]) -> Result<Netlist, Rejected> {
    parse_with("elements.toml", text, &mut |_| Ok(csv.to_vec()))
}

/// Its CSV files as they are.
fn with_files(text: &str) -> Result<Netlist, Rejected> {
    parse_with("elements.toml", text, &mut |path| {
        Ok(match path.to_str() {
            Some("cycle.csv") => include_bytes!("good/cycle.csv").to_vec(),
            Some("map.csv") => include_bytes!("good/map.csv").to_vec(),
            Some("film.csv") => include_bytes!("good/film.csv").to_vec(),
            _ => return Err(std::io::ErrorKind::NotFound.into()),
        })
    })
}

/// A table of one, of two arguments and a signal from one file.
const ALL_FROM_CSV: &str = "format = 1\n[table]\na = { csv = \"d.csv\", x = \"x\", value = \"z\" \
    }\n\
     b = { csv = \"d.csv\", x = \"x\", y = \"y\", value = \"z\" }\n[signal]\n\
     c = { csv = \"d.csv\", time = \"t\", value = \"z\" }\n\
     [node]\nn = { C = \"1 J/K\", T0 = \"0 degC\" }\n";

const CSV: &str = "x [rpm],y [N m],t [s],z [W]\n0,0,0,1\n0,1,1,2\n1,0,2,3\n1,1,3,5\n";

fn check(result: Result<Netlist, Rejected>) -> Result<(), TestCaseError> {
    match result {
        Ok(netlist) => sound(&netlist),
        Err(rejected) => complete(&rejected),
    }
}

/// What a network promises.
fn sound(netlist: &Netlist) -> Result<(), TestCaseError> {
    let network = &netlist.network;
    prop_assert!(!network.nodes().is_empty());
    for id in network.node_ids() {
        let node = &network.nodes()[id.index()];
        let capacity = network.capacity(id);
        prop_assert!(capacity.is_finite());
        prop_assert_eq!(node.massless, capacity <= 0.0);
        prop_assert!(node.massless || network.initial(id) >= 0.0);
    }
    for id in network.conductor_ids() {
        if let Some(g) = network.conductance(id) {
            prop_assert!(g.is_finite() && g > 0.0);
        }
        let conductor = &network.conductors()[id.index()];
        prop_assert_ne!(conductor.from, conductor.to);
    }
    if let Some(run) = &netlist.run {
        prop_assert!(run.stop > run.start && run.tolerance > 0.0);
    }
    prop_assert!(netlist.warnings.iter().all(|w| w.severity == Severity::Warning));
    Ok(())
}

/// A refusal has a reason, and every place is a piece of a text.
fn complete(rejected: &Rejected) -> Result<(), TestCaseError> {
    prop_assert!(rejected.diagnostics.iter().any(|d| d.severity == Severity::Error));
    for diagnostic in &rejected.diagnostics {
        for label in &diagnostic.labels {
            let text = rejected.files.text(label.span.file);
            prop_assert!(
                text.get(label.span.range.clone()).is_some(),
                "{diagnostic}: {:?}",
                label.span
            );
        }
    }
    prop_assert!(!rejected.to_string().is_empty());
    Ok(())
}

fn config() -> ProptestConfig {
    ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() }
}

/// Pieces that mean something to the format, in places where they may not.
fn piece() -> impl Strategy<Value = String> {
    let known = prop::sample::select(vec![
        "",
        "\"",
        "'",
        "{",
        "}",
        "[",
        "]",
        "=",
        ",",
        "\n",
        "#",
        "[node]\n",
        "[param]\nx = ",
        "[signal]\n",
        "[table]\n",
        "into = { steel = 0.5 }",
        "T_from",
        "shape = \"rod\"",
        "csv = \"map.csv\"",
        "period = \"1 s\"",
        "loss(",
        "steel.T",
        "T0",
        "massless = true",
        "1e999",
        "nan",
        "-",
        "0",
        "K",
        " [K]",
        "degC",
        "t",
        "steel",
        "P_7000",
        "/ 0",
        "^(1/2)",
        "\\u0041",
        "\\x41",
        "\"\"\"",
        "±",
        "°C",
        "(",
        ")",
        "if(",
        "<",
        "[run]\nstop = ",
        "G = \"1 W/K\"",
        "format = 1\n",
        "[[node]]\n",
        "é",
        "\u{feff}",
        "\r",
        "\t",
    ]);
    prop_oneof![4 => known.prop_map(str::to_owned), 1 => "\\PC{0,3}".prop_map(|text| text)]
}

/// Pieces that mean something in a CSV file.
fn csv_piece() -> impl Strategy<Value = String> {
    let known = prop::sample::select(vec![
        "", ",", ";", "\"", "\n", "\r\n", "\r", "#", "nan", "-0", "1e999", "-300", "[degC]", "[",
        "]", "x", "\u{feff}", " ", "\n\n", "é",
    ]);
    prop_oneof![4 => known.prop_map(str::to_owned), 1 => "\\PC{0,3}".prop_map(|text| text)]
}

/// The text with a range replaced, on borders of characters.
fn mutate(text: &str, (at, length, piece): &(usize, usize, String)) -> String {
    let letters: Vec<char> = text.chars().collect();
    let start = at % (letters.len() + 1);
    let end = (start + length).min(letters.len());
    let (before, after): (String, String) =
        (letters[..start].iter().collect(), letters[end..].iter().collect());
    format!("{before}{piece}{after}")
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        check(parse_bytes("any.toml", &bytes))?;
    }

    #[test]
    fn any_pieces(pieces in prop::collection::vec(piece(), 0..40)) {
        check(parse("any.toml", &pieces.concat()))?;
    }

    #[test]
    fn a_mutated_gearbox(changes in prop::collection::vec((any::<usize>(), 0..12usize, piece()), 1..4)) {
        let text = changes.iter().fold(GEARBOX.to_owned(), |text, change| mutate(&text, change));
        check(parse("gearbox.toml", &text))?;
    }

    #[test]
    fn mutated_elements(changes in prop::collection::vec((any::<usize>(), 0..12usize, piece()), 1..4)) {
        let text = changes.iter().fold(ELEMENTS.to_owned(), |text, change| mutate(&text, change));
        check(with_files(&text))?;
    }

    #[test]
    fn any_bytes_as_csv(bytes in prop::collection::vec(any::<u8>(), 0..100)) {
        check(with_csv(ALL_FROM_CSV, &bytes))?;
    }

    #[test]
    fn a_mutated_csv(changes in prop::collection::vec((any::<usize>(), 0..6usize, csv_piece()), 1..4)) {
        let text = changes.iter().fold(CSV.to_owned(), |text, change| mutate(&text, change));
        check(with_csv(ALL_FROM_CSV, text.as_bytes()))?;
    }

    #[test]
    fn lines_of_the_elements_in_any_order(order in Just(ELEMENTS.lines().collect::<Vec<_>>()).prop_shuffle()) {
        check(with_files(&order.join("\n")))?;
    }

    #[test]
    fn lines_of_the_gearbox_in_any_order(order in Just(GEARBOX.lines().collect::<Vec<_>>()).prop_shuffle()) {
        check(parse("gearbox.toml", &order.join("\n")))?;
    }

    #[test]
    fn any_assignments(texts in prop::collection::vec("(P_7000|bed_share|T_amb|x)?=?[-0-9.a-zA-Z±/ \
        ]{0,9}", 0..4)) {
        let mut netlist = parse("gearbox.toml", GEARBOX).unwrap();
        match netlist.set(&texts) {
            Ok(()) => sound(&netlist)?,
            Err(rejected) => complete(&rejected)?,
        }
    }
}

/// A chain of nodes, each with a parameter of its own that uses the one before it.
fn chain(nodes: usize) -> String {
    let mut text = "format = 1\n[param]\nR0 = \"1 K/W\"\n".to_owned();
    for i in 1..nodes {
        let _ = writeln!(text, "R{i} = \"R{} * 1\"", i - 1);
    }
    text += "[node]\n";
    for i in 0..nodes {
        let _ = writeln!(text, "n{i} = {{ T0 = \"25 degC\", C = \"5 J/K\" }}");
    }
    text += "[resistor]\n";
    for i in 1..nodes {
        let _ = writeln!(text, "r{i} = {{ from = \"n{}\", to = \"n{i}\", R = \"R{i}\" }}", i - 1);
    }
    text
}

#[test]
fn a_large_file_takes_time_in_proportion() {
    takes_time_in_proportion(10_000, |nodes| {
        let netlist = parse("chain.toml", &chain(nodes)).unwrap();
        assert_eq!(netlist.network.nodes().len(), nodes);
    });
}

/// Ten thousand mistakes are counted, and still no square.
#[test]
fn a_large_file_full_of_mistakes_takes_time_in_proportion() {
    takes_time_in_proportion(10_000, |nodes| {
        let text = chain(nodes).replace("J/K", "J/k").replace("to = \"n", "to = \"m");
        let rejected = parse("chain.toml", &text).unwrap_err();
        assert_eq!(rejected.diagnostics.len(), lptn_netlist::MOST_PROBLEMS + 1);
    });
}
