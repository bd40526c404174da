//! Words that results of several verbs share.

use lptn_network::{Network, list_of};
use lptn_report::{Text, TextTable};
use lptn_units::Unit;

/// More nodes than this do not fit on a screen.
pub const MOST_NODES: usize = 30;

/// "1 node", "2 nodes".
pub fn count(n: usize, noun: &str) -> String {
    let ending = if n == 1 {
        ""
    } else if noun.ends_with('y') {
        "ies"
    } else {
        "s"
    };
    let noun = if n == 1 { noun } else { noun.strip_suffix('y').unwrap_or(noun) };
    format!("{n} {noun}{ending}")
}

/// "2 nodes, 2 boundaries, 3 paths, 1 source", and states and controls if there are any.
pub fn counts(network: &Network) -> String {
    let mut parts = vec![
        count(network.nodes().len() - network.states().len(), "node"),
        count(network.boundaries().len(), "boundary"),
        count(network.conductors().len(), "path"),
        count(network.sources().len() - network.states().len(), "source"),
    ];
    if !network.states().is_empty() {
        parts.push(count(network.states().len(), "state"));
    }
    if !network.controls().is_empty() {
        parts.push(count(network.controls().len(), "control"));
    }
    parts.join(", ")
}

/// Keeps the largest of too many rows, the largest first. Returns their number before.
pub fn largest<T>(rows: &mut Vec<T>, size: impl Fn(&T) -> f64) -> usize {
    let all = rows.len();
    if all > MOST_NODES {
        rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
        rows.truncate(MOST_NODES);
    }
    all
}

/// A section with a table of some of `all` rows, and how to see the others.
/// Nothing if there are none.
pub fn some_of(text: &mut Text, table: impl Into<TextTable>, (all, how): (usize, &str)) {
    let table = table.into();
    let shown = table.rows();
    if all == 0 {
        return;
    }
    text.section().table(table);
    if shown < all {
        text.line(format!("{shown} of {all} are shown, {how}"));
    }
}

/// A unit for reading: `-` for a plain number.
pub fn symbol(unit: &str) -> &str {
    if unit == "1" { "-" } else { unit }
}

/// A unit after its number, with a blank before it; nothing for a plain number.
pub fn spaced(unit: &str) -> String {
    if unit == "1" { String::new() } else { format!(" {unit}") }
}

/// The unit of a difference between two temperatures in `unit`.
pub fn difference(unit: &Unit) -> &'static str {
    unit.difference()
}

/// Elements with laws whose constants were not read in their source.
pub fn unverified(network: &Network) -> Option<String> {
    unverified_names(network)
        .map(|names| format!("unverified constants: {}", list_of(&names, "elements")))
}

/// The same for programs: their names.
pub fn unverified_names(network: &Network) -> Option<Vec<String>> {
    let items = network.unverified().into_iter();
    let names: Vec<String> = items.map(|item| network.name_of(item).into_owned()).collect();
    (!names.is_empty()).then_some(names)
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn nouns_agree_with_their_number() {
        assert_eq!(count(1, "boundary"), "1 boundary");
        assert_eq!(count(2, "boundary"), "2 boundaries");
        assert_eq!(count(0, "node"), "0 nodes");
    }
}
