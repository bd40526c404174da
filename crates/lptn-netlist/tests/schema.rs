//! The schema of a netlist: it is a JSON Schema, accepts every netlist that is right, and refuses
//! those whose keys or types are wrong.

use std::path::{Path, PathBuf};

use lptn_netlist::{Files, Takes, format, parse_raw, schema};
use lptn_units::Unit;
use serde_json::Value;

use crate::schema_check::{is_sound, refused};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The files of a folder with an ending, in order.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(files(&path, ending)),
            false if path.extension().is_some_and(|e| e == ending) => found.push(path),
            false => {}
        }
    }
    found.sort();
    found
}

/// A netlist as an editor sees it; `None` if it is not TOML.
fn as_json(text: &str) -> Option<Value> {
    let mut files = Files::default();
    let file = files.add("net.toml", text);
    let (raw, problems) = parse_raw(&files, file);
    problems.is_empty().then(|| raw.top.json())
}

#[test]
fn it_is_a_json_schema_and_the_same_every_time() {
    let schema = schema();
    is_sound(&schema, &schema);
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema.to_string(), lptn_netlist::schema().to_string());
}

/// A key of each type, with its help, its default and its example.
#[test]
fn a_key_says_what_it_takes() {
    let schema = schema();
    let key = |path: &str| schema.pointer(path).unwrap_or_else(|| panic!("{path}"));
    let resistance = key("/$defs/resistor/properties/R");
    assert_eq!(resistance["type"], "string");
    assert_eq!(resistance["description"], "thermal resistance.\n\nTakes: K/W.");
    assert_eq!(resistance["examples"], serde_json::json!(["0.3 K/W"]));
    let over = key("/$defs/size/properties/over");
    assert_eq!(over["enum"], serde_json::json!(["steady", "run", "periodic"]));
    assert_eq!(over["default"], "steady");
    assert_eq!(key("/$defs/node/properties/massless/type"), "boolean");
    assert_eq!(key("/$defs/sweep/properties/samples/type"), "integer");
    assert_eq!(key("/properties/run/properties/tolerance/default"), "1e-5 K");
    let on = key("/$defs/gearbox.bearing/required");
    assert_eq!(on, &serde_json::json!(["on", "model"]));
}

/// Readers take the type of a value from its declaration.
#[test]
fn the_unit_of_every_key_is_one() {
    for key in format().sections.iter().flat_map(|section| section.keys) {
        if let Takes::Quantity(unit) | Takes::Property(unit) = key.takes {
            let known =
                unit.is_empty() || unit == "absolute temperature" || Unit::parse(unit).is_ok();
            assert!(known, "{}: {unit}", key.name);
        }
    }
}

/// The blocks of a page that are netlists; a fragment lacks the first line.
fn blocks(page: &str) -> Vec<String> {
    let parts = page.split("\n```toml").skip(1);
    let block = |part: &str| {
        let (words, rest) = part.split_once('\n')?;
        let text = rest.split("\n```").next()?;
        let head = if words.contains("fragment") { "format = 1\n" } else { "" };
        Some(format!("{head}{text}\n"))
    };
    parts.filter(|part| !part.starts_with(" from ")).filter_map(block).collect()
}

#[test]
fn every_netlist_that_is_right_is_accepted() {
    let (schema, mut count) = (schema(), 0);
    let mut check = |text: &str, place: &Path| {
        let Some(value) = as_json(text).filter(|_| text.contains("format = 1")) else { return };
        assert_eq!(refused(&schema, &schema, &value), None, "{}", place.display());
        count += 1;
    };
    for folder in [
        "networks",
        "tests",
        "crates/lptn-netlist/tests/good",
        "crates/lptn-netlist/tests/expand",
        "docs",
    ] {
        for path in files(&root().join(folder), "toml") {
            check(&std::fs::read_to_string(&path).unwrap(), &path);
        }
    }
    for path in files(&root().join("docs"), "md") {
        let page = std::fs::read_to_string(&path).unwrap();
        blocks(&page).iter().for_each(|block| check(block, &path));
    }
    assert!(count >= 150, "{count}");
}

/// What a schema can tell: the code, how many files with it are refused at least, and those that
/// are not.
const REFUSED: [(&str, usize, &[&str]); 9] = [
    ("netlist::unknown_key", 38, &[]),
    ("netlist::unknown_section", 5, &[]),
    ("netlist::missing_format", 2, &[]),
    ("netlist::missing_field", 27, NEEDED_BESIDE),
    ("netlist::no_law", 4, &[]),
    ("netlist::not_a_table", 11, &[]),
    ("netlist::wrong_shape", 28, OF_ANOTHER_SHAPE),
    ("netlist::unknown_word", 13, &["mesh_scuffing"]),
    ("units::bare_number", 8, UNIT_FROM_ELSEWHERE),
];

/// A key is needed beside another one, or what it names has no such property.
const NEEDED_BESIDE: &[&str] = &[
    "control_half_a_pair",
    "control_half_of_its_own",
    "correlation_fluid",
    "csv_keys_mixed",
    "infer_half",
    "mass_without_material",
    "melting",
    "mesh_scuffing",
    "pipe_no_content",
    "pipe_no_start",
    "plan_no_duration",
    "size_range_half",
    "state_samples",
];

/// A table is empty, a list too short, a text is no number, or `method` asks for a range.
const OF_ANOTHER_SHAPE: &[&str] =
    &["case_empty", "correlation_word", "fit_vary_empty", "sweep_samples", "table_curves_one"];

/// The unit follows from what something else is, or the number stands in a text.
const UNIT_FROM_ELSEWHERE: &[&str] = &[
    "limit_without_unit",
    "missing_unit_in_string",
    "signal_times_wrong_unit",
    "temperature_without_unit",
];

#[test]
fn wrong_keys_and_types_are_refused() {
    let schema = schema();
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad");
    let mut found: Vec<(&str, usize, Vec<String>)> =
        REFUSED.iter().map(|(code, ..)| (*code, 0, Vec::new())).collect();
    for path in files(&bad, "toml") {
        let text = String::from_utf8(std::fs::read(&path).unwrap());
        let Some(value) = text.ok().and_then(|text| as_json(&text)) else { continue };
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let said = std::fs::read_to_string(path.with_extension("txt")).unwrap();
        let refused = refused(&schema, &schema, &value).is_some();
        let has = |code: &str| said.contains(&format!("error[{code}]"));
        for (_, count, missed) in found.iter_mut().filter(|(code, ..)| has(code)) {
            *count += usize::from(refused);
            missed.extend((!refused).then(|| name.clone()));
        }
    }
    let wrong: Vec<String> = REFUSED
        .iter()
        .zip(&found)
        .filter(|((_, least, exceptions), (_, count, missed))| {
            count < least || missed != exceptions
        })
        .map(|((code, ..), (_, count, missed))| {
            format!("{code}: {count} are refused, but not {missed:?}")
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
