//! Networks that the program runs.

use std::collections::BTreeMap;

use serde_json::value::RawValue;

use super::compare::Case;
use super::model::{Field, Net, constant};
use super::results::in_si;
use super::units::Kind;
use super::write::{MAIN, Texts};
use crate::common::{Folder, csv};

/// Columns by name.
type Columns = BTreeMap<String, Vec<f64>>;

pub fn folder(texts: &Texts) -> Folder {
    let folder = Folder::empty();
    texts.iter().for_each(|(name, text)| folder.write(name, text));
    folder
}

/// The columns of a run as CSV; the first is the time.
fn as_csv(folder: &Folder, file: &str, more: &[&str]) -> Result<Columns, String> {
    let arguments = [&["run", file, "--no-files", "--format", "csv"], more].concat();
    let ran = folder.run(&arguments);
    if ran.code != Some(0) {
        return Err(format!("exit {:?}: {}", ran.code, ran.err));
    }
    let (headers, rows) = csv(&ran.out);
    let column = |(i, header): (usize, &String)| {
        let (name, unit) = header.split_once(" [").unwrap_or((header, "]"));
        (
            name.to_owned(),
            in_si(unit.trim_end_matches(']'), rows.iter().map(|row| row[i]).collect()),
        )
    };
    Ok(headers.iter().enumerate().map(column).collect())
}

/// The columns of a run as JSON. Numbers are read from their text: serde_json rounds the last digit
/// of some.
fn as_json(folder: &Folder) -> Result<Columns, String> {
    let ran = folder.run(&["run", MAIN, "--no-files", "--format", "json"]);
    let words = |error: serde_json::Error| error.to_string();
    let json: BTreeMap<String, Box<RawValue>> = serde_json::from_str(&ran.out).map_err(words)?;
    let (Some(columns), Some(rows)) = (json.get("columns"), json.get("rows")) else {
        return Err("no columns or rows".into());
    };
    let columns: Vec<serde_json::Value> = serde_json::from_str(columns.get()).map_err(words)?;
    let rows: Vec<Vec<Box<RawValue>>> = serde_json::from_str(rows.get()).map_err(words)?;
    let text =
        |column: &serde_json::Value, key: &str| column[key].as_str().unwrap_or("?").to_owned();
    let values =
        |i: usize| rows.iter().map(|row| row[i].get().parse().unwrap_or(f64::NAN)).collect();
    let column = |(i, column)| (text(column, "name"), in_si(&text(column, "unit"), values(i)));
    Ok(columns.iter().enumerate().map(column).collect())
}

/// Every column of one stands in the other with the same bits.
fn equal(what: &str, one: &Columns, other: &Columns) -> Result<(), String> {
    for (name, values) in one {
        let there = other.get(name).ok_or_else(|| format!("{what} has no column {name}"))?;
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        if there.len() != values.len() || !values.iter().zip(there).all(same) {
            return Err(format!("{name} is {values:?}, and in {what} {there:?}"));
        }
    }
    Ok(())
}

/// All formats show the numbers of the library.
pub fn formats(case: &Case) -> Result<(), String> {
    let folder = folder(&case.net.texts());
    let mut whole = as_csv(&folder, MAIN, &[])?;
    equal("JSON", &whole, &as_json(&folder)?)?;
    let some = as_csv(&folder, MAIN, &["--select", "*.T"])?;
    equal("CSV with all columns", &some, &whole)?;
    whole.remove("time");
    equal("the library", &whole, &case.results.columns)?;
    table(case, &folder)
}

/// A run that shows one column, none of whose values it needs, gives the rest of the answer of one
/// that shows all.
pub fn columns_decide_nothing(case: &Case) -> Result<(), String> {
    let folder = folder(&case.net.texts());
    let node = case.net.of("node").find(|node| node.get("massless").is_none());
    let Some(node) = node.map(|node| &*node.name) else { return Ok(()) };
    let column = &*format!("{node}.T");
    let whole = ["run", MAIN, "--no-files", "--format", "json", "--balance", node];
    let ask = |more: &[&str]| {
        let ran = folder.run(&[&whole[..], more].concat());
        serde_json::from_str(&ran.out).map_err(|error| format!("{error}: {}", ran.err))
    };
    let (all, one): (serde_json::Value, serde_json::Value) =
        (ask(&[])?, ask(&["--select", column])?);
    for key in ["events", "ledger", "balance", "limits", "statistics"] {
        if all[key] != one[key] {
            return Err(format!(
                "{key} is {} with all columns, {} with {column}",
                all[key], one[key]
            ));
        }
    }
    Ok(())
}

/// The table shows the temperatures at the end as far as its decimals go.
fn table(case: &Case, folder: &Folder) -> Result<(), String> {
    let shown = folder.run(&["run", MAIN, "--no-files"]).out;
    let mut rows = shown.lines().skip_while(|line| !line.starts_with("T [degC]")).skip(1);
    let mut seen = 0;
    for line in rows.by_ref().take_while(|line| !line.trim().is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [name, _, end, ..] = words[..] else { continue };
        let Some(values) = case.results.columns.get(&format!("{name}.T")) else { continue };
        let digits = end.split_once('.').map_or(0, |(_, digits)| digits.len());
        let there: f64 = end.parse().map_err(|_| format!("{end} is not a number in {line}"))?;
        let last = values.last().copied().unwrap_or(f64::NAN);
        if (there - last).abs() > 0.500_001 * 10_f64.powi(-i32::try_from(digits).unwrap_or(0)) {
            return Err(format!("{name} ends at {last}, and in the table at {end}"));
        }
        seen += 1;
    }
    if seen == 0 { Err(format!("no table in {shown}")) } else { Ok(()) }
}

/// A run in two parts ends where the whole does.
pub fn in_two_parts(case: &Case) -> Result<(), (String, Texts)> {
    let stop = case.net.run_value("stop");
    let (first, second) = (part(&case.net, (0.0, 0.5 * stop)), part(&case.net, (0.5 * stop, stop)));
    let mut texts = first.texts();
    let main = texts.remove(MAIN).unwrap_or_default();
    texts.insert("first.toml".into(), main);
    let text =
        second.texts()[MAIN].replace("[run]\n", "[run]\ninitial = \"out/first/state.json\"\n");
    texts.insert("second.toml".into(), text);
    two_parts(case, &texts, stop).map_err(|words| (words, texts))
}

fn two_parts(case: &Case, texts: &Texts, stop: f64) -> Result<(), String> {
    let folder = folder(texts);
    let ran = folder.run(&["run", "first.toml", "--format", "json"]);
    if ran.code != Some(0) {
        return Err(format!("the first part ends with {:?}: {}", ran.code, ran.err));
    }
    margins(
        case,
        &ran.out,
        &folder.run(&["run", "second.toml", "--no-files", "--format", "json"]).out,
    )?;
    let found = as_csv(&folder, "second.toml", &["--select", "*.T"])?;
    let rows = case.results.times.iter().filter(|time| **time >= 0.5 * stop).count();
    for (name, values) in found.iter().filter(|(name, _)| *name != "time") {
        let whole = &case.results.columns[name];
        for (a, b) in whole[whole.len() - rows..].iter().zip(values) {
            if (a - b).abs() > case.bound() {
                return Err(format!(
                    "{name} is {a} in one run and {b} in two, {:.1e} allowed",
                    case.bound()
                ));
            }
        }
    }
    Ok(())
}

/// The margins of a run are the smaller ones of its parts.
fn margins(case: &Case, first: &str, second: &str) -> Result<(), String> {
    let parts = [first, second].map(serde_json::from_str::<serde_json::Value>);
    let [Ok(first), Ok(second)] = parts else { return Err("no JSON of a part".into()) };
    for (name, whole) in &case.results.margins {
        let of = |part: &serde_json::Value| {
            part["limits"][name]["margin"]["value"].as_f64().unwrap_or(f64::NAN)
        };
        let least = f64::min(of(&first), of(&second));
        if (least - whole).abs() > case.bound() {
            return Err(format!("margin of {name} is {whole} in one run and {least} in two"));
        }
    }
    Ok(())
}

/// The network over a part of its run, without windows and reports.
fn part(net: &Net, (from, to): (f64, f64)) -> Net {
    let mut net = net.clone();
    net.entries.retain(|entry| !matches!(&*entry.section, "window" | "report"));
    let interval = net.run_value("stop") / 16.0;
    let rows = constant(interval, Kind::Time);
    let run = net.run();
    for (key, field) in &mut run.fields {
        match &**key {
            "start" => *field = constant(from, Kind::Instant),
            "stop" => *field = constant(to, Kind::Instant),
            "output" => *field = Field::Table(vec![("every".into(), rows.clone())]),
            _ => {}
        }
    }
    net
}
