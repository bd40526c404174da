//! Runs the cases of a validation set and judges what lptn says to each expected value.

#![allow(
    dead_code,
    unreachable_pub,
    reason = "the format is read whole; each test file uses a part of this"
)]

mod answer;
mod calibration;
mod case;
mod expected;
mod gate;
mod mean;
mod network;
pub mod page;
mod proof;
mod size;
mod verdict;

use std::path::{Path, PathBuf};

use lptn_network::Network;
use serde_json::Value;

pub use verdict::Report;

use answer::{Laboratory, Trouble};
use case::Case;
use network::Model;
use verdict::Verdict;

/// The folder of the project's own copy.
pub fn own_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/validation")
}

/// The names of the cases in a folder, in order: every folder in it, but for those that are no
/// one's work.
pub fn cases(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry"))
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().expect("a name in UTF-8"))
        .filter(|name| !name.starts_with(['.', '_']))
        .collect();
    names.sort();
    names
}

/// `case.json` of a case, not yet understood, with the path of its record.
pub fn json(folder: &Path, id: &str) -> Value {
    let path = folder.join(id).join("case.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut json: Value =
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    if let Some(data) = json.pointer_mut("/calibration/data")
        && let Some(name) = data.as_str()
    {
        *data = Value::from(folder.join(id).join(name).to_string_lossy().into_owned());
    }
    json
}

/// Runs a case and judges every value.
pub fn judge(id: &str, json: &Value) -> Report {
    let case: Case = match serde_json::from_value(json.clone()) {
        Ok(case) => case,
        Err(error) => return Report::unreadable(id, &error.to_string()),
    };
    let mut report = Report::new(id, &case);
    if case.id != id {
        report.complain(format!("its id is `{}`", case.id));
    }
    values(&case, Laboratory::new(&case, json), &mut report);
    report
}

/// Judges what `network` says to every value of a case of the project's own copy but to `size`,
/// which is about the fields of the case. `names` pairs names of the case with others of the
/// network.
pub fn judge_network(id: &str, network: &Network, names: &[(&str, &str)]) -> Report {
    let mut json = json(&own_folder(), id);
    if let Some(expected) = json["expected"].as_array_mut() {
        expected.retain(|value| value["quantity"] != "size");
    }
    let case: Case = serde_json::from_value(json.clone()).unwrap_or_else(|e| panic!("{id}: {e}"));
    let mut report = Report::new(id, &case);
    let laboratory =
        Model::of(network, &case, names).map(|model| Laboratory::of(&case, &json, model));
    values(&case, laboratory.map_err(Trouble), &mut report);
    report
}

fn values(case: &Case, laboratory: Result<Laboratory<'_>, Trouble>, report: &mut Report) {
    if case.expected.is_empty() {
        report.complain("nothing is expected of it".to_owned());
    }
    for expected in &case.expected {
        let found = match &laboratory {
            Ok(laboratory) => laboratory.answer(expected),
            Err(trouble) => Err(trouble.clone()),
        };
        if let (Ok(laboratory), Ok(found)) = (&laboratory, &found)
            && let Some(bound) = laboratory.bound(expected)
        {
            let (error, own) = ((found - expected.value).abs(), case.own_error(expected));
            if error > bound + own {
                let beyond = format!("{error:e} K off, proven {bound:e} K, own error {own:e} K");
                report.complain(format!("{beyond}: {expected:?}"));
            }
        }
        let verdict = match found {
            Ok(found) => Verdict::of(found, expected),
            Err(Trouble(why)) => Verdict::Wrong(why),
        };
        report.add(expected, verdict);
    }
    match laboratory.as_ref().map(Laboratory::proof) {
        Ok(Ok(proof)) => report.proof = proof,
        Ok(Err(Trouble(why))) => report.complain(why),
        Err(_) => {}
    }
}
