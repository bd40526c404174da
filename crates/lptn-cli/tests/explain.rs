//! `lptn explain`: every code has a page, every page a code, and every example is what it says.
//!
//! An example is one diff, so that the wrong and the corrected file come from the same lines. A
//! test runs both.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::pages;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use common::{Folder, Ran};
use serde_json::Value;

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The sources of a folder and below it.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// Whether a text is a code: `area::problem`.
fn is_code(text: &str) -> bool {
    let word =
        |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_lowercase() || b == b'_');
    text.split_once("::").is_some_and(|(area, problem)| word(area) && word(problem))
}

/// The codes that the sources name, outside of tests and comments.
fn codes_of_sources() -> BTreeSet<String> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(crates()).unwrap() {
        sources(&entry.unwrap().path().join("src"), &mut files);
    }
    let mut codes = BTreeSet::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let text = text.split("#[cfg(test)]").next().unwrap();
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            codes.extend(line.split('"').filter(|part| is_code(part)).map(str::to_owned));
        }
    }
    codes
}

fn explained() -> Vec<Value> {
    let ran = Folder::empty().run(&["explain", "--format", "json"]).exits(0);
    ran.json()["codes"].as_array().unwrap().clone()
}

fn word<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap()
}

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let pages = explained();
    let names: Vec<String> = pages.iter().map(|page| word(page, "code").to_owned()).collect();
    let told: BTreeSet<String> = names.iter().cloned().collect();
    let known = codes_of_sources();
    assert!(known.len() > 400, "{}", known.len());
    let missing: Vec<&String> = known.difference(&told).collect();
    let left: Vec<&String> = told.difference(&known).collect();
    assert!(missing.is_empty(), "without a page in docs/codes: {missing:?}");
    assert!(left.is_empty(), "pages of codes that nothing has: {left:?}");
    assert_eq!(names.len(), told.len(), "a code stands in two headings");
}

#[test]
fn every_page_says_it_in_a_line_and_then_in_full() {
    for page in explained() {
        let (code, summary) = (word(&page, "code"), word(&page, "summary"));
        assert!(summary.ends_with('.') && summary.chars().count() <= 72, "{code}: {summary}");
        let text = page["text"].as_array().unwrap();
        assert!(!text.is_empty(), "{code} is not explained");
        assert!(text.iter().all(|t| t.as_str().unwrap().ends_with(['.', ':'])), "{code}");
    }
}

/// Runs one of the files of an example: a fragment in its network, others as they stand.
fn tried(example: &Value, which: &str) -> Ran {
    let (verb, text) = (word(example, "verb"), word(example, which));
    let name = if verb.starts_with("fit step") { "record.csv" } else { "file.toml" };
    let fragment = example["fragment"].as_bool().unwrap();
    let text = if fragment { pages::completed(text) } else { text.to_owned() };
    let folder = Folder::with(name, &text);
    let words: Vec<&str> = verb.split(' ').chain([name]).collect();
    folder.run(&words)
}

/// What is wrong with an example of a page.
fn wrong_example(page: &Value, example: &Value) -> Option<String> {
    let code = word(page, "code");
    let shows = |ran: &Ran| {
        let text = format!("{}{}", ran.out, ran.err);
        [format!("[{code}]"), format!("\"{code}\"")].iter().any(|shown| text.contains(shown))
    };
    let wrong = tried(example, "wrong");
    let mended = tried(example, "mended");
    if !shows(&wrong) {
        return Some(format!("{code}: the wrong file gives\n{}{}", wrong.out, wrong.err));
    }
    let well = mended.code == Some(0) && !shows(&mended);
    (!well).then(|| format!("{code}: the mended file gives\n{}{}", mended.out, mended.err))
}

/// Codes that share a page have one example: that of any of them does.
#[test]
fn wrong_files_have_their_code_and_mended_ones_have_none() {
    let (mut problems, mut count) = (Vec::new(), 0);
    let all = explained();
    let mut sections: BTreeMap<String, Vec<&Value>> = BTreeMap::new();
    for page in &all {
        sections.entry(page["text"].to_string()).or_default().push(page);
    }
    for pages in sections.values() {
        for example in pages[0]["examples"].as_array().unwrap() {
            count += 1;
            let wrong: Vec<String> =
                pages.iter().filter_map(|page| wrong_example(page, example)).collect();
            if wrong.len() == pages.len() {
                problems.extend(wrong);
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n\n"));
    assert!(count > 150, "only {count} examples were found");
}

#[test]
fn a_code_is_explained_and_a_near_one_is_suggested() {
    let folder = Folder::empty();
    let ran = folder.run(&["explain", "netlist::unknown_key"]).exits(0);
    ran.prints("netlist::unknown_key\nA key that its section does not have.\n\n");
    let as_printed = folder.run(&["explain", "error[netlist::unknown_key]:"]).exits(0);
    as_printed.prints("\n-   block = ").prints("\n+   block = ");
    folder.run(&["explain", "reduce"]).exits(0).prints("reduce\n").prints("\nno_ground  ");
    for (word, near) in [
        ("netlist::unknwon_key", "did you mean `netlist::unknown_key`?"),
        ("unknown_key", "did you mean `netlist::unknown_key`?"),
        ("unist", "did you mean `units`?"),
        ("nonsense::nonsense", "`lptn explain` lists them all"),
    ] {
        folder.run(&["explain", word]).exits(2).says("explain::unknown").says(near);
    }
    let coloured = folder.run(&["explain", "netlist::unknown_key", "--color", "always"]).exits(0);
    coloured.prints("\u{1b}[1;31m-   block").prints("\u{1b}[32m+   block");
    let csv = folder.run(&["explain", "--format", "csv"]).exits(0);
    csv.prints("code,summary\n").prints("\nnetwork::empty,A network without a node.\n");
}

/// Only those who look on are told where to read more and what to type next.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_is_told_where_to_read_more() {
    let folder = Folder::empty();
    let piped = folder.run(&["run", "missing.toml"]).exits(2);
    assert!(!piped.err.contains("lptn explain"), "{}", piped.err);
    let on_terminal = |arguments: &str| {
        let mut script = std::process::Command::new("script");
        let command = format!("'{}' {arguments}", env!("CARGO_BIN_EXE_lptn"));
        script.args(["-qec", &command, "/dev/null"]).current_dir(folder.path());
        Ran::of(script.stdin(std::process::Stdio::null()).output().unwrap()).out
    };
    let said = on_terminal("run missing.toml");
    assert_eq!(said.matches("explain  lptn explain input::cannot_read").count(), 1, "{said}");
    assert!(!on_terminal("run missing.toml -q").contains("lptn explain"));
    assert!(on_terminal("new motor").contains("next   lptn check motor.toml"));
    assert!(on_terminal("check motor.toml").contains("stiffness: "));
}

#[test]
fn words_of_a_verdict_are_explained() {
    let folder = Folder::empty();
    for word in ["kept", "broken", "BROKEN", "not judged", "not determined", "open"] {
        let ran = folder.run(&["explain", word]).exits(0);
        assert!(ran.out.lines().count() > 3, "{word}: {}", ran.out);
    }
    folder.run(&["explain", "brokn"]).exits(2);
}

/// The words of a message find the page, in any order and case.
#[test]
fn several_words_find_their_page() {
    let folder = Folder::empty();
    for words in ["limit broken", "BROKEN limit", "limit not judged"] {
        let ran = folder.run(&["explain", words]).exits(0);
        let page =
            if words.contains("judged") { "no value in this answer" } else { "exit code is 1" };
        let text = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(page), "{words}: {text}");
    }
    folder
        .run(&["explain", "deviation percent temperature"])
        .exits(0)
        .prints("units::relative_deviation");
    folder.run(&["explain", "purple elephants"]).exits(2).says("explain::unknown");
}
