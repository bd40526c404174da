//! Every TOML block of the documentation is a netlist that parses: complete ones as they stand,
//! fragments (` ```toml
//! fragment`) as additions to a small base. What pages show of commands is kept by `crates/lptn-cli/tests/documents.rs`.

use crate::pages;
use crate::support;

use std::path::{Path, PathBuf};

use pages::{blocks, completed, lines, pages};

fn all_pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = pages(root);
    pages.extend(["ARCHITECTURE.md", "CHANGELOG.md"].map(|name| root.join(name)));
    pages
}

#[test]
fn every_toml_block_parses() {
    let mut count = 0;
    for page in all_pages() {
        let lines = lines(&page);
        for block in blocks(&lines) {
            let text = lines[block.lines.clone()].join("\n") + "\n";
            let netlist = match block.words() {
                ("toml", "fragment") => completed(&text),
                // an excerpt of a file, which `crates/lptn-cli/tests/documents.rs` reads
                ("toml", words) if words.starts_with("from ") => continue,
                ("toml", _) => text,
                _ => continue,
            };
            let place = format!("{}:{}", page.display(), block.lines.start);
            // CSV files are looked for beside the page
            match lptn_netlist::parse_file(Path::new(&place), netlist.as_bytes()) {
                Err(error) => panic!("{place}\n{netlist}\n{error}"),
                Ok(read) => expands(&read, Path::new(&place)),
            }
            count += 1;
        }
    }
    for folder in ["docs", "docs/elements", "docs/netlists", "docs/cookbook"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for entry in std::fs::read_dir(folder).expect("a folder of the documentation") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|ending| ending == "toml") {
                let text = std::fs::read(&path).expect("a netlist");
                let read = lptn_netlist::parse_file(&path, &text);
                expands(&read.unwrap_or_else(|error| panic!("{}\n{error}", path.display())), &path);
                count += 1;
            }
        }
    }
    assert!(count >= 90, "only {count} netlists were found");
}

/// The expansion of a netlist is read as the same network, written as the same text, and runs to
/// the same temperatures.
fn expands(netlist: &lptn_netlist::Netlist, place: &Path) {
    if netlist.not_flat().is_some() {
        return;
    }
    let text = netlist.expanded();
    let again = lptn_netlist::prove(&text, place, &netlist.network, (0.0, 3600.0));
    let again = again.unwrap_or_else(|error| panic!("{}\n{text}\n{error}", place.display()));
    assert_eq!(again.expanded(), text, "{}", place.display());
    let end = |netlist: &lptn_netlist::Netlist| {
        let system =
            lptn::prelude::ThermalSystem::assemble(&netlist.network).expect("it assembles");
        netlist.run.as_ref()?;
        // a page may show a network that stops its run
        let solution =
            support::transient(netlist).solve(&system).map_err(|error| error.to_string());
        Some(solution.map(|solution| solution.row(solution.times().len() - 1).to_vec()))
    };
    let (found, expected) = match (end(&again), end(netlist)) {
        (Some(Ok(found)), Some(Ok(expected))) => (found, expected),
        (found, expected) => return assert_eq!(found, expected, "{}", place.display()),
    };
    assert_eq!(found.len(), expected.len(), "{}", place.display());
    for (found, expected) in found.iter().zip(&expected) {
        assert!(
            (found - expected).abs() <= 1e-9 * expected.abs(),
            "{}: {found} {expected}",
            place.display()
        );
    }
}

#[test]
fn every_link_to_a_file_leads_somewhere() {
    for page in all_pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        let folder = page.parent().expect("a folder");
        for part in text.split("](").skip(1) {
            let target =
                part.split(')').next().unwrap_or_default().split('#').next().unwrap_or_default();
            if target.is_empty() || target.contains("://") {
                continue;
            }
            assert!(folder.join(target).exists(), "{}: {target} is not there", page.display());
        }
    }
}

/// The book holds what is written: every page below `docs` once.
#[test]
fn the_book_has_every_page_once() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).expect("the summary");
    for page in all_pages() {
        let Ok(name) = page.strip_prefix(&docs) else { continue };
        let wanted = usize::from(name != Path::new("SUMMARY.md"));
        let link = format!("]({})", name.display());
        assert_eq!(summary.matches(&link).count(), wanted, "docs/SUMMARY.md: {}", name.display());
    }
}

/// What a heading is called in a link, on GitHub and in the book.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    heading.trim().to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
}

#[test]
fn every_link_to_a_heading_leads_to_one() {
    for page in all_pages() {
        let text = std::fs::read_to_string(&page).expect("a page");
        for part in text.split("](").skip(1) {
            let target = part.split(')').next().unwrap_or_default();
            let Some((file, wanted)) = target.split_once('#').filter(|_| !target.contains("://"))
            else {
                continue;
            };
            let other = if file.is_empty() { page.clone() } else { page.with_file_name(file) };
            let found = lines(&other).iter().any(|line| {
                let heading = line.trim_start_matches('#');
                heading.len() < line.len() && anchor(heading) == wanted
            });
            assert!(found, "{}: {target} has no such heading", page.display());
        }
    }
}

/// Tables, headings and blocks are as wide as they have to be.
#[test]
fn lines_of_prose_fit_on_a_page() {
    for page in pages(Path::new(env!("CARGO_MANIFEST_DIR"))) {
        let lines = lines(&page);
        let blocks = blocks(&lines);
        for (number, line) in lines.iter().enumerate() {
            let block = blocks.iter().any(|block| block.lines.contains(&number));
            let width = if block { 0 } else { line.chars().count() };
            let place = format!("{}:{}", page.display(), number + 1);
            assert!(line.starts_with(['|', '#']) || width <= 100, "{place}: {width} characters");
        }
    }
}
