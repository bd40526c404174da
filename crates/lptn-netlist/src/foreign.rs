//! Files of other kinds that are given instead of a netlist. Each is reported once: errors in each
//! of its lines as TOML would help no one.

use lptn_data::{Diagnostic, FileId, Span};

use crate::format::NetlistFormat;

/// The file is not a netlist at all.
pub(crate) const CODE: &str = "netlist::not_a_netlist";

/// Lines that are examined.
const ENOUGH: usize = 50;

/// A text with fewer broken lines is a netlist with mistakes in it.
const MANY: usize = 8;

const NEW: &str = "a netlist is a TOML file; `lptn new NAME` writes one to start from";

/// Error that names the kind of a text that is plainly not TOML; `broken` is the number of its
/// broken lines.
pub(crate) fn recognise(
    (name, format): (&str, &NetlistFormat),
    (file, text): (FileId, &str),
    broken: usize,
) -> Option<Diagnostic> {
    let all: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    if all.iter().any(|line| is_heading(line, format)) {
        return None;
    }
    let lines = &all[..all.len().min(ENOUGH)];
    let first = lines.iter().find(|line| !line.starts_with('#'))?;
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_lowercase()).unwrap_or_default();
    let (is, help) = if first.starts_with('{') || (ending == "json" && first.starts_with('[')) {
        ("JSON", json_help(text))
    } else if first.starts_with('<') {
        ("XML or HTML", NEW.to_owned())
    } else if ["cir", "ckt", "sp", "spi", "spice"].contains(&ending.as_str()) || is_spice(lines) {
        ("a circuit for SPICE", SPICE.to_owned())
    } else if ending == "csv" || is_csv(lines) {
        ("a CSV file", csv_help(name))
    } else if broken >= MANY && 2 * broken >= all.len() {
        ("another kind of text", NEW.to_owned())
    } else {
        return None;
    };
    let start = text.find(first).unwrap_or(0);
    let problem = Diagnostic::error(CODE, format!("{name} is not a netlist: it looks like {is}"));
    Some(problem.at(Span::new(file, start..start + first.len()), "not TOML").help(help))
}

const SPICE: &str = "a netlist is a TOML file: `R1 a b 0.3` is, below [resistor], `R1 = { from = \
                     \"a\", to = \"b\", R = \"0.3 K/W\" }`; `lptn new NAME` writes one to start \
                     from";

fn csv_help(name: &str) -> String {
    format!(
        "a netlist is a TOML file that names CSV files: `lptn new NAME` writes one to start from; \
         a measured record is fitted by `lptn fit step {name}`"
    )
}

fn json_help(text: &str) -> String {
    match text.contains("\"temperatures\"") {
        true => "a run starts from a state that its netlist names below [run]: `initial = \
            \"state.json\"`"
            .to_owned(),
        false => NEW.to_owned(),
    }
}

/// True for the heading of a known section.
fn is_heading(line: &str, format: &NetlistFormat) -> bool {
    let inner = line.split('#').next().unwrap_or_default().trim().trim_matches(['[', ']']).trim();
    line.starts_with('[') && format.has(inner.split('.').next().unwrap_or_default().trim())
}

/// True for two lines or more, all with the same separator and none with an equals sign.
fn is_csv(lines: &[&str]) -> bool {
    let mut cells = lines.iter().filter(|line| !line.starts_with('#')).peekable();
    let separator = |line: &str| [',', ';', '\t'].into_iter().find(|c| line.contains(*c));
    let Some(first) = cells.peek().and_then(|line| separator(line)) else { return false };
    lines.len() > 1 && cells.all(|line| line.contains(first) && !line.contains('='))
}

/// True for control lines, or elements between two nodes.
fn is_spice(lines: &[&str]) -> bool {
    let control = [".end", ".tran", ".op", ".ac", ".dc", ".model", ".subckt", ".include"];
    let is_control = |line: &&str| control.iter().any(|word| line.to_lowercase().starts_with(word));
    let element = |line: &&str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let named = line.starts_with(|c: char| "RCVILrcvil".contains(c));
        named && words.len() >= 4 && !line.contains(['=', ',', ';', ':'])
    };
    lines.iter().any(is_control)
        || lines.iter().filter(|line| element(line)).count() * 2 > lines.len()
}
