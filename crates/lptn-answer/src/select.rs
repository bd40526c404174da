//! `--select`: the columns that are kept.

use lptn_netlist::{Diagnostic, Files, Netlist, Span};
use lptn_network::Item;
use lptn_solve::Selection;
use lptn_units::suggest;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::words::count;

/// The columns of a run: those that the command line asks for, else those of `[run]`, else all.
pub fn of_run(netlist: &Netlist, option: &[String]) -> Result<Selection, Failure> {
    let of_run = netlist.run.as_ref().map_or(&[][..], |run| &run.select);
    if option.is_empty() { chosen(netlist, of_run, true) } else { chosen(netlist, option, false) }
}

/// The columns that the command line asks for, else all.
pub fn of_option(netlist: &Netlist, option: &[String]) -> Result<Selection, Failure> {
    chosen(netlist, option, false)
}

/// For each pattern, true if it matches a column of a run.
pub fn matching(netlist: &Netlist, patterns: &[String]) -> Vec<bool> {
    let found = |pattern: &String| {
        Selection::matching(&netlist.network, std::slice::from_ref(pattern)).is_ok()
    };
    patterns.iter().map(found).collect()
}

/// All columns but those of imported parts: a million columns are of no use to anyone.
pub fn all(netlist: &Netlist) -> Selection {
    let shown =
        |item: Item| matches!(item, Item::Boundary(_)) || !netlist.source_map.is_imported(item);
    Selection::of(&netlist.network, shown)
}

fn chosen(netlist: &Netlist, patterns: &[String], in_file: bool) -> Result<Selection, Failure> {
    if patterns.is_empty() {
        return Ok(all(netlist));
    }
    Selection::matching(&netlist.network, patterns)
        .map_err(|unmatched| no_match(netlist, &unmatched, in_file))
}

/// Note on the columns that are left out by default.
pub fn hidden(netlist: &Netlist) -> Option<String> {
    let (network, map) = (&netlist.network, &netlist.source_map);
    let imported = |item: &Item| map.is_imported(*item);
    let nodes = network.node_ids().map(Item::Node).filter(imported).count();
    let paths = network.conductor_ids().map(Item::Conductor).filter(imported).count();
    let sources = network.source_ids().map(Item::Source).filter(imported).count();
    let counts = [(nodes, "node"), (paths, "path"), (sources, "source")];
    let words: Vec<String> =
        counts.iter().filter(|(n, _)| *n > 0).map(|(n, noun)| count(*n, noun)).collect();
    (!words.is_empty())
        .then(|| format!("hidden {} imported: columns by --select 'NAME.T'", words.join(", ")))
}

fn no_match(netlist: &Netlist, unmatched: &[String], in_file: bool) -> Failure {
    let names = Selection::names(&netlist.network);
    let mut files = if in_file { netlist.files.clone() } else { Files::new() };
    let patterns = netlist.run.as_ref().map_or(&[][..], |run| &run.select);
    let diagnostics = unmatched.iter().map(|pattern| {
        let place = if in_file {
            let written = patterns.iter().position(|p| p == pattern);
            written.and_then(|i| netlist.source_map.select().get(i).cloned())
        } else {
            let file = files.add("--select", pattern.as_str());
            Some(Span::new(file, 0..pattern.len()))
        };
        let problem = |message: String| Diagnostic::error("select::no_match", message);
        let message = format!("no column matches `{pattern}`");
        let problem = match netlist.no_instance(pattern) {
            Some((why, advice)) => problem(format!("{message}: {why}")).help(advice),
            None => problem(message).help(help(pattern, &names)),
        };
        problem.at(place, "")
    });
    let diagnostics = diagnostics.collect();
    Failure { exit: Exit::Input, files, diagnostics }
}

/// The nearest name; a name without its ending is the usual mistake.
fn help(pattern: &str, names: &[String]) -> String {
    let prefix = format!("{pattern}.");
    let complete = names.iter().find(|name| name.starts_with(&prefix)).map(String::as_str);
    if let Some(near) = complete.or_else(|| suggest(pattern, names.iter().map(String::as_str))) {
        return format!("did you mean `{near}`?");
    }
    const SHOWN: usize = 8;
    let some: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > SHOWN {
        format!(" and {} more", names.len() - SHOWN)
    } else {
        String::new()
    };
    format!("the columns are {}{more}; `*.T` is every temperature", some.join(", "))
}
