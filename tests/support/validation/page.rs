//! The table of the cases in `docs/validation.md`.

use std::path::Path;

use serde_json::Value;

use super::verdict::Report;

/// How the table begins.
const HEADING: [&str; 2] = [
    "| Case | What it is | Its answers are | Values | Largest error, of what is allowed | Proven error |",
    "|---|---|---|---|---|---|",
];

/// Upper ends of what is said of an error: machines differ in its digits.
const CLASSES: [(f64, &str); 7] = [
    (1e-4, "0.01 %"),
    (1e-3, "0.1 %"),
    (1e-2, "1 %"),
    (0.1, "10 %"),
    (0.2, "20 %"),
    (0.5, "50 %"),
    (1.0, "100 %"),
];

/// The rows that may stand for a report, the tightest first.
fn rows(report: &Report, case: &Value) -> Vec<String> {
    let of = |key: &str| case[key].as_str().expect("a text").to_owned();
    let [right, _] = report.counts();
    let id = &report.id;
    let link = format!("[`{id}`](../tests/validation/{id}/case.json)");
    let start = format!("| {link} | {} | {} | {right} |", of("title"), of("provenance"));
    let near = |(end, _): &&(f64, &str)| {
        report.worst() <= *end && (*end <= 1e-4 || report.worst() > end / 30.0)
    };
    let classes = CLASSES.iter().filter(near);
    let proofs = proofs(report);
    let pairs = classes.flat_map(|(_, shown)| proofs.iter().map(move |proof| (shown, proof)));
    pairs.map(|(shown, proof)| format!("{start} {shown} | {proof} |")).collect()
}

/// Texts that may stand for the proven error, the tightest first: powers of ten above it.
fn proofs(report: &Report) -> Vec<String> {
    match &report.proof {
        None => vec!["-".to_owned()],
        Some(Err(code)) => vec![format!("not proven: `{code}`")],
        Some(Ok(bound)) => {
            let ends = (-12..=3).map(|power: i32| (10f64.powi(power), power));
            let near =
                ends.filter(|(end, _)| bound <= end && (*bound > end / 30.0 || *end <= 1e-12));
            near.map(|(_, power)| format!("1e{power} K")).collect()
        }
    }
}

/// Compares the table of the page with the reports; `LPTN_BLESS=1` writes it.
pub fn keep(page: &Path, reports: &[Report], case: impl Fn(&str) -> Value) {
    let text = std::fs::read_to_string(page).expect("the page");
    let lines: Vec<&str> = text.lines().collect();
    let start = lines.iter().position(|line| *line == HEADING[0]).expect("the table's heading");
    let rest = &lines[start + HEADING.len()..];
    let shown = rest.iter().take_while(|line| line.starts_with('|')).count();
    let wanted: Vec<_> = reports.iter().map(|report| rows(report, &case(&report.id))).collect();
    let same = |(shown, wanted): (&&str, &Vec<String>)| wanted.iter().any(|row| row == shown);
    if shown == wanted.len() && rest.iter().zip(&wanted).all(same) {
        return;
    }
    assert!(std::env::var_os("LPTN_BLESS").is_some(), "LPTN_BLESS=1 writes {}", page.display());
    let table = wanted.iter().map(|rows| rows[0].as_str());
    let before = lines[..start + HEADING.len()].iter().copied();
    let new: Vec<&str> = before.chain(table).chain(rest[shown..].iter().copied()).collect();
    std::fs::write(page, new.join("\n") + "\n").expect("the page is written");
}
