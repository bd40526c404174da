//! What is fuzzed (`make fuzz`), on a fixed corpus: no panic, no text that cannot be shown, no NaN
//! as a result. The corpus is what fuzzing found to reach something new, and every netlist of the
//! project.
//!
//! Fuzz targets are plain functions. libFuzzer is outside the workspace (`fuzz/`), on stable Rust.

#![allow(clippy::print_stdout, reason = "what was fed last is shown where it fails")]

use crate::targets;

use std::path::{Path, PathBuf};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries =
        std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    files
}

/// Feeds a target; what it was fed last is shown where it fails.
fn feed(target: &str, inputs: impl IntoIterator<Item = (String, Vec<u8>)>) -> usize {
    let (_, run) = targets::TARGETS.iter().find(|(name, _)| *name == target).expect("a target");
    let mut count = 0;
    for (name, bytes) in inputs {
        println!("{target}: {name}");
        run(&bytes);
        count += 1;
    }
    count
}

fn read(path: PathBuf) -> (String, Vec<u8>) {
    let bytes = std::fs::read(&path).expect("a file");
    (path.display().to_string(), bytes)
}

fn replay(target: &str) {
    let count = feed(target, files(&format!("fuzz/corpus/{target}")).into_iter().map(read));
    assert!(count >= 10, "only {count} inputs for {target}");
}

#[test]
fn quantities() {
    replay("quantity");
}

#[test]
fn expressions() {
    replay("expression");
}

#[test]
fn netlists() {
    replay("netlist");
}

#[test]
fn csv_files() {
    replay("csv");
}

#[test]
fn states() {
    replay("state");
}

#[test]
fn assignments() {
    replay("set");
}

/// Every netlist that is shipped, and every one with mistakes.
#[test]
fn netlists_of_the_project() {
    let folders = ["networks", "crates/lptn-netlist/tests/bad", "crates/lptn-netlist/tests/good"];
    let all = folders.into_iter().flat_map(files);
    let toml = all.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    assert!(feed("netlist", toml.map(read)) > 400);
}

/// Every block of the documentation, whatever it holds, as a netlist, and every line of one as an
/// expression.
#[test]
fn blocks_of_the_documentation() {
    let pages = ["docs", "docs/elements"].into_iter().flat_map(files);
    let pages = pages.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let mut blocks = Vec::new();
    for path in pages {
        let text = std::fs::read_to_string(&path).expect("a page");
        let inside = text
            .split("```")
            .skip(1)
            .step_by(2)
            .map(|block| block.split_once('\n').map_or("", |b| b.1));
        blocks.extend(inside.map(|block| (path.display().to_string(), block.as_bytes().to_vec())));
    }
    assert!(feed("netlist", blocks.clone()) > 80);
    let words = |(page, block): (String, Vec<u8>)| {
        let text = String::from_utf8(block).expect("a text");
        text.split('"').map(|words| (page.clone(), words.as_bytes().to_vec())).collect::<Vec<_>>()
    };
    feed("expression", blocks.into_iter().flat_map(words));
}
