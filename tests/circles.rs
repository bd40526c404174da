//! Modules that use each other in circles cannot be read one after the other. Their number may only
//! fall.
//!
//! A module and those inside it are one thing to read where it calls them by their bare names: only
//! paths that begin with `crate` or `super` count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// How many modules of a crate stand in circles; a crate that is not named has none. Where fewer
/// do, write the number here.
const IN_CIRCLES: [(&str, usize); 1] = [("lptn-units", 3)];

type Graph = BTreeMap<String, BTreeSet<String>>;

/// The source of every module of a crate by its path, `grid::build`, without comments and unit
/// tests.
fn modules(folder: &Path, prefix: &str, found: &mut BTreeMap<String, String>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let full = if prefix.is_empty() { name.clone() } else { format!("{prefix}::{name}") };
        if path.is_dir() {
            modules(&path, &full, found);
        } else if path.extension().is_some_and(|extension| extension == "rs")
            && !["lib", "main"].contains(&&*name)
        {
            let text = std::fs::read_to_string(&path).expect("a source file");
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
            let code = lines.collect::<Vec<_>>().join(" ");
            found.insert(if name == "mod" { prefix.to_owned() } else { full }, code);
        }
    }
}

/// Every path that a list of uses names: `crate::a::{b, c::d}` is two.
fn paths(prefix: &str, tree: &str, found: &mut Vec<String>) {
    let Some((head, rest)) = tree.split_once('{') else {
        found.push(format!("{prefix}{}", tree.split(" as ").next().unwrap_or_default().trim()));
        return;
    };
    let inner = rest.rsplit_once('}').map_or(rest, |(inner, _)| inner);
    let (mut depth, mut start) = (0, 0);
    for (i, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inner[start..i].trim();
                start = (i + 1).min(inner.len());
                if !part.is_empty() {
                    paths(&format!("{prefix}{}", head.trim()), part, found);
                }
            }
            _ => {}
        }
    }
}

/// What a module names of its own crate, in uses and in other places.
fn named(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
            let before = code[..at].trim_end();
            let whole = code[..at].chars().next_back().is_none_or(|c| !is_word(c));
            if whole && (before.ends_with("use") || before.ends_with("pub(crate) use")) {
                paths("", code[at..].split(';').next().unwrap_or_default(), &mut found);
            } else if whole {
                found.push(code[at..].chars().take_while(|c| is_word(*c)).collect());
            }
        }
    }
    found
}

/// The module that a path leads to from another one, if it is one of these.
fn target(path: &str, from: &str, all: &BTreeMap<String, String>) -> Option<String> {
    let mut place: Vec<&str> = from.split("::").collect();
    let mut parts = path.split("::").map(str::trim).peekable();
    match parts.next()? {
        "crate" => place.clear(),
        _ => drop(place.pop()),
    }
    while parts.next_if_eq(&"super").is_some() {
        place.pop();
    }
    place.extend(parts);
    while !place.is_empty() && !all.contains_key(&place.join("::")) {
        place.pop();
    }
    let found = place.join("::");
    (!found.is_empty() && found != from).then_some(found)
}

fn graph(source: &Path) -> Graph {
    let mut all = BTreeMap::new();
    modules(source, "", &mut all);
    let uses = |(name, code): (&String, &String)| {
        let used = named(code).into_iter().filter_map(|path| target(&path, name, &all)).collect();
        (name.clone(), used)
    };
    all.iter().map(uses).collect()
}

fn reached<'a>(graph: &'a Graph, from: &'a str) -> BTreeSet<&'a str> {
    let (mut found, mut waiting) = (BTreeSet::new(), vec![from]);
    while let Some(next) = waiting.pop() {
        waiting.extend(graph[next].iter().map(String::as_str).filter(|used| found.insert(*used)));
    }
    found
}

#[test]
fn circles_of_modules_only_open() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates");
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(crates).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let graph = graph(&path.join("src"));
        let circles: Vec<&String> = graph
            .keys()
            .filter(|module| reached(&graph, module).contains(module.as_str()))
            .collect();
        let known = IN_CIRCLES.iter().find(|(of, _)| *of == name).map_or(0, |(_, count)| *count);
        if circles.len() != known {
            wrong.push(format!("{name} has {} modules in circles: {circles:?}", circles.len()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The circle of two modules is seen through lists of uses, `super` and plain paths.
#[test]
fn paths_lead_to_modules() {
    let all: BTreeMap<String, String> =
        ["a", "a::b", "c"].into_iter().map(|name| (name.to_owned(), String::new())).collect();
    let found =
        named("use crate::a::{self, b::{Thing as Other, more}}; fn f() { super::c::go() } ");
    let targets: Vec<Option<String>> =
        found.iter().map(|path| target(path, "a::b", &all)).collect();
    assert_eq!(
        found,
        ["crate::a::self", "crate::a::b::Thing", "crate::a::b::more", "super::c::go"]
    );
    assert_eq!(
        targets,
        [Some("a".to_owned()), None, None, None::<String>.or(Some("a".to_owned()))]
    );
}
