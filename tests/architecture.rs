//! The arrows between crates, where `unsafe` may stand, and how long a file may be.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// From the ground up: a crate may use only those before it.
const ORDER: [&str; 22] = [
    "lptn-units",
    "lptn-plot",
    "lptn-laws",
    "lptn-network",
    "lptn-data",
    "lptn-netlist",
    "lptn-assembly",
    "lptn-integrate",
    "lptn-cvodes",
    "lptn-solve",
    "lptn-analysis",
    "lptn-reduce",
    "lptn-fit",
    "lptn-study",
    "lptn-report",
    "lptn-html",
    "lptn-graph",
    "lptn-answer",
    "lptn-live",
    "lptn",
    "lptn-cli",
    "lptn-python",
];

/// What a crate may not use although it stands before it.
const FORBIDDEN: [(&str, &[&str]); 9] = [
    (
        "lptn-integrate",
        &["lptn-units", "lptn-laws", "lptn-network", "lptn-netlist", "lptn-assembly"],
    ),
    (
        "lptn-cvodes",
        &["lptn-units", "lptn-laws", "lptn-network", "lptn-data", "lptn-netlist", "lptn-assembly"],
    ),
    ("lptn-data", &["lptn-laws", "lptn-network"]),
    ("lptn-assembly", &["lptn-data", "lptn-netlist"]),
    ("lptn-solve", &["lptn-data", "lptn-netlist"]),
    ("lptn-analysis", &["lptn-data", "lptn-netlist"]),
    ("lptn-reduce", &["lptn-data", "lptn-netlist"]),
    ("lptn-laws", &["lptn-network"]),
    ("lptn-study", &["lptn-fit"]),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The lptn crates that each crate uses, build and test dependencies left out.
fn arrows() -> BTreeMap<String, Vec<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("cargo prints JSON");
    let packages = metadata["packages"].as_array().expect("packages");
    let text = |value: &serde_json::Value| value.as_str().expect("a string").to_owned();
    let uses = |package: &serde_json::Value| {
        let list = package["dependencies"].as_array().expect("dependencies");
        let ours =
            |d: &&serde_json::Value| d["kind"].is_null() && text(&d["name"]).starts_with("lptn");
        list.iter().filter(ours).map(|d| text(&d["name"])).collect()
    };
    packages.iter().map(|package| (text(&package["name"]), uses(package))).collect()
}

#[test]
fn arrows_point_down_only() {
    let place = |name: &str| {
        ORDER
            .iter()
            .position(|&other| other == name)
            .unwrap_or_else(|| panic!("{name} has no place in the order"))
    };
    let arrows = arrows();
    assert!(arrows.len() >= 10, "{arrows:?}");
    for (name, uses) in &arrows {
        for used in uses {
            assert!(place(used) < place(name), "{name} uses {used}, which stands above it");
            let client = ["lptn-python", "lptn-cli"].contains(&name.as_str());
            assert!(used != "lptn" || client, "{name} uses the facade");
        }
    }
}

#[test]
fn no_crate_knows_what_it_may_not() {
    let arrows = arrows();
    for (name, forbidden) in FORBIDDEN {
        let uses = arrows.get(name).map_or(&[][..], Vec::as_slice);
        let found: Vec<_> = uses.iter().filter(|used| forbidden.contains(&used.as_str())).collect();
        assert!(found.is_empty(), "{name} uses {found:?}");
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Every source file of the crates, the tests and the examples with its path, in order.
pub(crate) fn all_sources() -> Vec<(String, String)> {
    let mut paths = Vec::new();
    ["crates", "tests", "examples"]
        .iter()
        .for_each(|folder| sources(&root().join(folder), &mut paths));
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root()).expect("inside the project").display().to_string();
        (name, std::fs::read_to_string(&path).expect("a source file"))
    };
    paths.into_iter().map(read).collect()
}

/// One crate calls C. In another one, `lptn-live`, two modules export functions to a page by name,
/// which Rust calls unsafe; no other word of theirs is.
#[test]
fn one_crate_alone_is_unsafe() {
    let may = ["crates/lptn-cvodes/", "crates/lptn-live/src/lib.rs"];
    for (name, text) in all_sources() {
        let opts_out = text.contains(concat!("allow(", "unsafe_code"));
        assert!(
            !opts_out || may.iter().any(|own| name.starts_with(own)),
            "{name} allows unsafe code"
        );
        let exports = text.replace("#[unsafe(no_mangle)]", "");
        assert!(
            name != "crates/lptn-live/src/abi.rs" || !exports.contains("unsafe"),
            "{name} does more than to export functions"
        );
    }
}

/// What runs where there is no C and no file system, in a browser for one.
const CORE: [&str; 10] = [
    "units",
    "laws",
    "network",
    "data",
    "netlist",
    "assembly",
    "integrate",
    "solve",
    "analysis",
    "reduce",
];

#[test]
fn the_core_knows_no_c() {
    let mut command = Command::new(env!("CARGO"));
    command.args([
        "tree",
        "--offline",
        "--locked",
        "--no-default-features",
        "--edges",
        "normal,build",
    ]);
    command.args(["--prefix", "none", "--format", "{p}"]).current_dir(root());
    command.args(CORE.iter().flat_map(|name| ["-p".to_owned(), format!("lptn-{name}")]));
    let output = command.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8_lossy(&output.stdout);
    assert!(tree.contains("faer"), "{tree}");
    for made_of_c in ["lptn-cvodes", "sundials-sys", "bindgen", "cc v"] {
        assert!(!tree.lines().any(|line| line.starts_with(made_of_c)), "{made_of_c}:\n{tree}");
    }
}

#[test]
fn the_core_reads_files_in_one_place() {
    // the limits are those of the reader; beside it stands who looks for a file of a similar name
    let readers = ["limits.rs", "near_file.rs"];
    for (name, text) in all_sources() {
        let in_core = CORE.iter().any(|part| name.starts_with(&format!("crates/lptn-{part}/src/")));
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let reads = ["std::fs", "std::env", "std::process"].iter().any(|word| code.contains(word));
        let may = readers.iter().any(|reader| name.ends_with(reader));
        assert!(
            !(in_core && reads) || may,
            "{name} reaches the system itself: take what is read as an argument"
        );
    }
}

/// Who asks a network, and how, stands once: `lptn-solve` computes and `lptn-analysis` asks it.
#[test]
fn one_crate_alone_asks_networks() {
    let asks = [
        "Transient {",
        "Transient::of(",
        "Transient::until(",
        "SteadyState::solve",
        "Periodic::find",
        "sensitive_run(",
        "sensitive_run_observed(",
        "Verification::observed(",
    ];
    let may = ["crates/lptn-solve/", "crates/lptn-analysis/", "crates/lptn/"];
    let product = |name: &str| name.starts_with("crates/") && name.contains("/src/");
    for (name, text) in all_sources().into_iter().filter(|(name, _)| product(name)) {
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
        let found: Vec<&str> =
            code.filter(|line| asks.iter().any(|ask| line.contains(ask))).collect();
        let here = may.iter().any(|place| name.starts_with(place));
        assert!(here || found.is_empty(), "{name} asks a network by itself: {found:?}");
    }
}

/// Doubts are data of answers: the command line prints them.
#[test]
fn no_doubt_is_made_by_the_command_line() {
    for (name, text) in all_sources() {
        let made = text.contains(concat!("Diagnostic::", "warning("));
        assert!(!(made && name.starts_with("crates/lptn-cli/src/")), "{name} makes a doubt");
    }
}

/// A file of tests that no `main.rs` names is compiled by nobody.
#[test]
fn every_file_of_tests_is_run() {
    let files: Vec<(String, String)> = all_sources();
    for (name, _) in &files {
        let Some((folder, file)) = name.rsplit_once('/') else { continue };
        let is_test = folder == "tests" || folder.ends_with("/tests");
        if !is_test || file == "main.rs" {
            continue;
        }
        let main = format!("{folder}/main.rs");
        let (_, program) = files.iter().find(|(other, _)| *other == main).expect("a program");
        let module = format!("mod {};", file.trim_end_matches(".rs"));
        assert!(program.lines().any(|line| line == module), "{main} has no `{module}`");
    }
}

/// The packages of ours in a lock, each with what it depends on; versions left out.
fn locked(lock: &str) -> BTreeMap<String, Vec<String>> {
    let text = std::fs::read_to_string(root().join(lock)).expect("a lock");
    let name = |line: &str| line.split('"').nth(1).unwrap_or_default().to_owned();
    let package = |block: &str| {
        let lines = || block.lines().map(str::trim);
        let own = lines().find(|line| line.starts_with("name = "))?;
        let uses = lines().filter(|line| line.starts_with('"'));
        let uses = uses.map(|line| name(line).split(' ').next().unwrap_or_default().to_owned());
        Some((name(own), uses.collect()))
    };
    let all = text.split("[[package]]").filter_map(package);
    all.filter(|(name, _)| name.starts_with("lptn-")).collect()
}

/// `make fuzz` builds with its own lock, which nothing else reads.
#[test]
fn the_lock_of_the_fuzzer_knows_our_crates() {
    let (ours, fuzz) = (arrows(), locked("fuzz/Cargo.lock"));
    for (name, uses) in fuzz.iter().filter(|(name, _)| *name != "lptn-fuzz") {
        let known = ours.get(name).unwrap_or_else(|| panic!("{name} is no crate of ours"));
        let missing: Vec<&String> = known.iter().filter(|used| !uses.contains(used)).collect();
        assert!(missing.is_empty(), "fuzz/Cargo.lock: {name} uses {missing:?} too");
    }
    assert!(fuzz.len() > 10, "{fuzz:?}");
}

#[test]
fn files_are_short() {
    for (name, text) in all_sources() {
        // tests at the end of a file are not counted; lists of cases are long at 100 columns
        let most = if name.contains("tests/") { 500 } else { 420 };
        let code =
            text.split("#[cfg(test)]\nmod tests").next().map_or(0, |code| code.lines().count());
        assert!(code <= most, "{name} has {code} lines: is it one idea?");
    }
}

#[test]
fn examples_are_short() {
    for (name, text) in all_sources().into_iter().filter(|(name, _)| name.starts_with("examples/"))
    {
        assert!(text.lines().count() <= 70, "{name}");
    }
}

#[test]
fn the_prelude_is_small() {
    let text = std::fs::read_to_string(root().join("crates/lptn/src/lib.rs")).expect("the facade");
    let (_, prelude) = text.split_once("pub mod prelude").expect("a prelude");
    let words = prelude.split(|c: char| !c.is_alphanumeric() && c != '_');
    let names: Vec<&str> = words.filter(|word| word.starts_with(char::is_uppercase)).collect();
    assert!((10..=30).contains(&names.len()), "{names:?}");
}

/// A client reads one page: the facade exports items, and no crate as a whole.
#[test]
fn the_facade_is_a_page() {
    let text = std::fs::read_to_string(root().join("crates/lptn/src/lib.rs")).expect("the facade");
    let (own, _) = text.split_once("pub mod prelude").expect("a prelude");
    let exports: Vec<&str> = own.split("pub use ").skip(1).collect();
    let whole = |export: &&&str| {
        let list = export.split(';').next().unwrap_or_default();
        list.starts_with("lptn_") && !list.contains("::")
    };
    assert_eq!(exports.iter().filter(whole).count(), 0, "a crate is exported whole");
    let names = exports.iter().flat_map(|export| {
        let list = export.split(';').next().unwrap_or_default();
        let (_, list) = list.split_once("::").unwrap_or_default();
        list.split([',', '{', '}']).map(str::trim).filter(|name| !name.ends_with("::"))
    });
    let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    assert!((100..=190).contains(&names.len()), "{} items", names.len());
}

/// `?` makes an `lptn::Error` of whatever a call returns. Those of the integrator stand inside of
/// others.
#[test]
fn every_error_becomes_that_of_the_library() {
    let one = std::fs::read_to_string(root().join("crates/lptn/src/error.rs")).expect("the error");
    let others =
        ["crates/lptn/", "crates/lptn-cli/", "crates/lptn-integrate/", "examples/", "tests/"];
    for (name, text) in
        all_sources().into_iter().filter(|(name, _)| !others.iter().any(|o| name.starts_with(o)))
    {
        let kinds = text
            .lines()
            .filter_map(|l| l.strip_prefix("pub enum ").or(l.strip_prefix("pub struct ")));
        let words = kinds.filter_map(|line| line.split(|c: char| !c.is_alphanumeric()).next());
        for error in words.filter(|word| word.ends_with("Error")) {
            assert!(
                one.contains(&format!("::{error}")),
                "{name}: {error} is not in crates/lptn/src/error.rs"
            );
        }
    }
}
