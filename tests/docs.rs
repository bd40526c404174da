//! Every TOML block of the documentation is a netlist that parses: complete ones as they stand, fragments
//! (` ```toml fragment`) as additions to a small base.

mod support;

use std::path::{Path, PathBuf};

/// What fragments may refer to.
const BASE: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\nbase_node = { C = \"1 kJ/K\" }\n\
                    [boundary]\nbase_air = { T = \"20 degC\" }\n[resistor]\n\
                    base_path = { from = \"base_node\", to = \"base_air\", R = \"1 K/W\" }\n";

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = Vec::new();
    for folder in ["docs", "docs/elements"] {
        let docs = std::fs::read_dir(root.join(folder)).expect("the folder of documentation");
        pages.extend(docs.map(|entry| entry.expect("an entry").path()));
    }
    pages.extend(["README.md", "ARCHITECTURE.md", "CHANGELOG.md"].map(|name| root.join(name)));
    pages.retain(|path| path.extension().is_some_and(|e| e == "md"));
    pages.sort();
    pages
}

/// The blocks of a page with their info string and line.
fn blocks(text: &str) -> Vec<(String, usize, String)> {
    let mut found = Vec::new();
    let mut open: Option<(String, usize, String)> = None;
    for (number, line) in text.lines().enumerate() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(info)) => open = Some((info.to_owned(), number + 1, String::new())),
            (Some(_), Some(_)) => found.extend(open.take()),
            (Some((_, _, block)), None) => {
                block.push_str(line);
                block.push('\n');
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is not closed");
    found
}

/// The base with the fragment's lines put under the headings that both have.
fn completed(fragment: &str) -> String {
    let mut sections: Vec<(String, String)> = Vec::new();
    for line in BASE.lines().chain(std::iter::once("")).chain(fragment.lines()) {
        let heading = if line.starts_with('[') { Some(line.to_owned()) } else { None };
        match heading {
            Some(heading) if !sections.iter().any(|(known, _)| *known == heading) => {
                sections.push((heading, String::new()));
            }
            Some(heading) => {
                let at = sections.iter().position(|(known, _)| *known == heading).expect("just found");
                let section = sections.remove(at);
                sections.push(section); // what follows belongs to it
            }
            None if sections.is_empty() => sections.push((String::new(), format!("{line}\n"))),
            None => sections.last_mut().expect("not empty").1.push_str(&format!("{line}\n")),
        }
    }
    sections.iter().map(|(heading, body)| format!("{heading}\n{body}")).collect()
}

#[test]
fn every_toml_block_parses() {
    let mut count = 0;
    for page in pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        for (info, line, block) in blocks(&text) {
            let netlist = match info.as_str() {
                "toml" => block,
                "toml fragment" => completed(&block),
                _ => continue,
            };
            let place = format!("{}:{line}", page.display());
            // CSV files are looked for beside the page
            match lptn::netlist::parse_file(Path::new(&place), netlist.as_bytes()) {
                Err(error) => panic!("{place}\n{netlist}\n{error}"),
                Ok(read) => expands(&read, Path::new(&place)),
            }
            count += 1;
        }
    }
    assert!(count >= 6, "only {count} blocks were found");
}

/// The expansion of a netlist is read as the same network, written as the same text, and runs to the same temperatures.
fn expands(netlist: &lptn::netlist::Netlist, place: &Path) {
    if netlist.not_flat().is_some() {
        return;
    }
    let text = netlist.expanded();
    let again = lptn::netlist::prove(&text, place, &netlist.network, (0.0, 3600.0));
    let again = again.unwrap_or_else(|error| panic!("{}\n{text}\n{error}", place.display()));
    assert_eq!(again.expanded(), text, "{}", place.display());
    let end = |netlist: &lptn::netlist::Netlist| {
        let system = lptn::prelude::ThermalSystem::assemble(&netlist.network).expect("it assembles");
        netlist.run.as_ref()?;
        let solution = support::transient(netlist).solve(&system).expect("it runs");
        Some(solution.row(solution.times().len() - 1).to_vec())
    };
    let (found, expected) = (end(&again).unwrap_or_default(), end(netlist).unwrap_or_default());
    assert_eq!(found.len(), expected.len(), "{}", place.display());
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{}: {found} {expected}", place.display());
    }
}

#[test]
fn every_link_to_a_file_leads_somewhere() {
    for page in pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        let folder = page.parent().expect("a folder");
        for part in text.split("](").skip(1) {
            let target = part.split(')').next().unwrap_or_default().split('#').next().unwrap_or_default();
            if target.is_empty() || target.contains("://") {
                continue;
            }
            assert!(folder.join(target).exists(), "{}: {target} is not there", page.display());
        }
    }
}
