//! Diagnostics of measured records: every file of `tests/record` is read, or refused, with exactly
//! the words beside it, in `.txt`. A comment `# asks: ring, t = time` in a file says which columns
//! are asked for. `LPTN_BLESS=1` writes the words anew; what it writes has to be read as one would
//! who made the mistake.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use lptn_data::{
    Diagnostic, Files, Record, RecordName, RecordQuery, Rejected, Severity, read_record,
};
use lptn_units::Type;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/record")
}

fn cases() -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let mut cases: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|e| e == "csv")).collect();
    cases.sort();
    cases
}

fn query(bytes: &[u8]) -> RecordQuery {
    let text = String::from_utf8_lossy(bytes);
    let Some(asks) = text.lines().find_map(|line| line.strip_prefix("# asks: ")) else {
        return RecordQuery::default();
    };
    let mut query = RecordQuery::default();
    for name in asks.trim().split(", ") {
        match name.strip_prefix("t = ") {
            Some(time) => query.time = Some(RecordName::new(time)),
            None => query
                .columns
                .push(RecordName { ty: Some(Type::ABSOLUTE_TEMPERATURE), ..RecordName::new(name) }),
        }
    }
    query
}

fn read(path: &Path) -> Result<(Record, Files), Rejected> {
    let bytes = std::fs::read(path).unwrap();
    read_record(Path::new(path.file_name().unwrap()), &bytes, &query(&bytes))
}

fn told(files: &Files, diagnostics: &[Diagnostic]) -> String {
    let told = |diagnostic: &Diagnostic| {
        let marks = diagnostic
            .labels
            .iter()
            .map(|label| format!("\n    marks {:?}", files.at(&label.span)));
        format!("{}{}\n", files.plain(diagnostic), marks.collect::<String>())
    };
    diagnostics.iter().map(told).collect::<Vec<_>>().join("\n")
}

/// What was read, as it is kept: numbers in SI.
fn seen(record: &Record) -> String {
    let numbers = |values: &[f64]| {
        let few = if values.len() > 8 { &values[..3] } else { values };
        let texts: Vec<String> = few.iter().map(|value| format!("{value}")).collect();
        format!("{}{}", texts.join(" "), if values.len() > 8 { " .." } else { "" })
    };
    let mut text = format!(
        "{} rows\n{} [s]: {}\n",
        record.time.len(),
        record.time_name,
        numbers(&record.time)
    );
    for column in &record.columns {
        text += &format!("{} ({}): {}\n", column.name, column.unit.ty, numbers(&column.values));
    }
    text
}

fn outcome(path: &Path) -> String {
    let text = match read(path) {
        Ok((record, files)) => format!("{}\n{}", seen(&record), told(&files, &record.warnings)),
        Err(rejected) => format!("refused\n\n{}", told(&rejected.files, &rejected.diagnostics)),
    };
    text.trim_end().to_owned() + "\n"
}

#[test]
fn diagnostics_of_records_are_as_reviewed() {
    let mut differences = Vec::new();
    for path in cases() {
        let found = outcome(&path);
        let expected = path.with_extension("txt");
        if std::env::var_os("LPTN_BLESS").is_some() {
            std::fs::write(&expected, &found).unwrap();
        } else if std::fs::read_to_string(&expected).unwrap_or_default().replace("\r\n", "\n")
            != found
        {
            differences.push(format!("{}:\n{found}", path.file_name().unwrap().display()));
        }
    }
    assert!(differences.is_empty(), "LPTN_BLESS=1 writes these:\n\n{}", differences.join("\n"));
}

#[test]
fn diagnostics_of_records_have_a_place_and_a_code_and_errors_a_help() {
    let mut codes = std::collections::BTreeSet::new();
    for path in cases() {
        let diagnostics = match read(&path) {
            Ok((record, _)) => record.warnings,
            Err(rejected) => rejected.diagnostics,
        };
        for diagnostic in diagnostics {
            codes.insert(diagnostic.code);
            assert!(diagnostic.place().is_some(), "{}: {diagnostic}", path.display());
            assert!(
                diagnostic.severity != Severity::Error || diagnostic.help.is_some(),
                "{}: {diagnostic}",
                path.display()
            );
        }
    }
    assert!(codes.len() >= 20, "{codes:?}");
}

fn parsed(text: &str, query: &RecordQuery) -> Result<(Record, Files), Rejected> {
    read_record(Path::new("r.csv"), text.as_bytes(), query)
}

/// Units are converted by their definitions: 0 degC is 273.15 K, 32 degF is 0 degC.
#[test]
fn analytic_units_of_columns_are_converted() {
    let text = "t [min],a [degC],b [degF],c [K],P [W]\n0,25,77,298.15,1\n0.5,100,212,373.15,2\n";
    let (record, _) = parsed(text, &RecordQuery::default()).unwrap();
    assert_eq!(record.time, [0.0, 30.0]);
    assert_eq!(record.temperatures().count(), 3);
    for column in record.temperatures() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(column.values[0], 298.15) && near(column.values[1], 373.15), "{column:?}");
    }
    assert!(record.warnings.is_empty(), "{:?}", record.warnings);
}

/// A record of `(time, value)`, the value with so many decimals.
fn written(rows: impl Iterator<Item = (f64, f64)>, decimals: usize) -> String {
    let row = |(time, value): (f64, f64)| format!("{time:.1},{value:.decimals$}\n");
    "t [s],ring [degC]\n".to_owned() + &rows.map(row).collect::<String>()
}

/// 25.5 degC to 92.7 degC with 810 s: the paper's record, and longer and shorter ones.
fn exponential(t: f64) -> f64 {
    92.7 - 67.2 * (-t / 810.0).exp()
}

/// No body that warms by one exponential is taken for a sensor at its end, however coarse the
/// logger and however long the record; a sensor that stops at any place of the climb is found.
#[test]
fn property_saturation_is_told_from_settling() {
    for decimals in [0, 1, 2] {
        for length in [300.0, 1000.0, 1500.0, 2400.0, 4000.0, 8000.0] {
            let times = || (0..).map(|i| 2.0 * f64::from(i)).take_while(move |&t| t <= length);
            let saturation = |end: f64| {
                let text = written(times().map(|t| (t, exponential(t).min(end))), decimals);
                let (record, _) = parsed(&text, &RecordQuery::default()).unwrap();
                record.columns[0].saturation
            };
            assert_eq!(saturation(1000.0), None, "{decimals} decimals, {length} s");
            let reached = exponential(length) - 25.5;
            // a tenth of the climb cut off: what is cut then lasts longer than a step of the logger
            let end = (25.5 + 0.7 * reached).round();
            let found = saturation(end);
            assert!(
                found.is_some_and(|s| (s.value - 273.15 - end).abs() < 1e-9),
                "{decimals} {length} {found:?}"
            );
        }
    }
}

fn codes(text: &str) -> Vec<&'static str> {
    let (record, _) = parsed(text, &RecordQuery::default()).unwrap();
    record.warnings.iter().map(|warning| warning.code).collect()
}

/// A hall that swings by 1 K over a day, to a tenth of a kelvin: no sensor is at its end.
#[test]
fn a_slow_swing_of_a_few_steps_is_no_sensor_at_its_end() {
    for phase in [0.0, 1.0, 2.0, 3.0, 4.0, 5.0] {
        let minutes = (0..2880).map(f64::from);
        let swing = |t: f64| 20.0 + 0.5 * (t / 1440.0 * std::f64::consts::TAU + phase).sin();
        let text = written(minutes.map(|t| (60.0 * t, swing(t))), 1);
        assert!(codes(&text).is_empty(), "{phase}: {:?}", codes(&text));
    }
}

/// Points at equal ratios of the time, as a thermal impedance is measured, have no holes; one that
/// was lost from equal distances is one.
#[test]
fn decades_of_time_are_no_holes() {
    for per_decade in [1, 2, 3, 10] {
        let times = (0..=6 * per_decade)
            .map(|i| 10.0 * 10.0_f64.powf(f64::from(i) / f64::from(per_decade)));
        let text = written(times.map(|t| (t, 20.0 + 5.0 * t.log10())), 3);
        assert!(codes(&text).is_empty(), "{per_decade}: {:?}", codes(&text));
    }
    let times = (0..100).map(f64::from).filter(|t| !(40.0..60.0).contains(t));
    assert_eq!(codes(&written(times.map(|t| (t, exponential(t))), 3)), ["record::hole"]);
}

/// Eight columns of one logger that stopped together are one warning, another gap is its own.
#[test]
fn gaps_of_the_same_rows_are_told_once() {
    let names = ["a", "b", "c", "d", "e", "f", "g"];
    let head: String = names.iter().map(|name| format!(",{name} [degC]")).collect();
    let row = |t: u32| {
        let cell = |i: u32| match (t, i) {
            (3 | 4, _) | (6, 6) => ",".to_owned(),
            _ => format!(",{}", 20 + t * t + i),
        };
        format!("{t}{}\n", (0..7).map(cell).collect::<String>())
    };
    let text = format!("t [s]{head}\n{}", (0..10).map(row).collect::<String>());
    let (record, _) = parsed(&text, &RecordQuery::default()).unwrap();
    let told: Vec<&str> = record.warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        told,
        [
            "6 columns have 2 gaps, which are left out of their 10 rows: `a`, `b`, `c`, `d` and 2 \
             more",
            "column `g` has 3 gaps, which are left out of its 10 rows",
        ]
    );
}

/// What lies outside the window is not looked at: neither its gaps nor what stands in place of
/// numbers.
#[test]
fn property_a_window_leaves_out_what_is_outside() {
    let text = "t [s],ring [degC]\n0,OL\n1,25\n2,26\n3,\n";
    let query = RecordQuery { from: Some(1.0), to: Some(2.0), ..RecordQuery::default() };
    let (record, _) = parsed(text, &query).unwrap();
    assert_eq!(record.time, [1.0, 2.0]);
    assert!(record.warnings.is_empty());
    let query = RecordQuery { from: Some(5.0), ..RecordQuery::default() };
    let refused = parsed(text, &query).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, "record::window");
}

/// Values are rounded in the file only; Windows line ends and a byte order mark change nothing.
#[test]
fn property_line_ends_and_a_mark_change_nothing() {
    let text = written((0..50).map(|i| (f64::from(i), exponential(f64::from(i)))), 3);
    let plain = parsed(&text, &RecordQuery::default()).unwrap().0;
    let windows = "\u{feff}".to_owned() + &text.replace('\n', "\r\n");
    let windows = parsed(&windows, &RecordQuery::default()).unwrap().0;
    assert_eq!(plain.time, windows.time);
    assert_eq!(plain.columns[0].values, windows.columns[0].values);
}
