//! Kind: reference. Pages in a real browser, which is the judge of what HTML and scripts do.
//!
//! Without Chromium these tests say so and pass, unless `LPTN_REQUIRE_ORACLES` is set.
//!
//! They check values against `result.csv`, zoom, legend, contrast in both themes, widths, and the
//! text of the printed page. JSON is read with `float_roundtrip`; without it serde_json is off by
//! one in the last digit.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test that cannot go on has failed, and one that cannot begin says why"
)]

use crate::common;

use std::process::{Command, Output};

use common::{Folder, browse};
use serde_json::{Value, json};

/// Looks at a page from inside.
pub(crate) const PROBE: &str = include_str!("common/probe.js");

/// A gearbox whose fan switches: three panels, events, a limit.
const FAN: &str = include_str!("../../../networks/gearbox_fan.toml");

/// The browser with these arguments; `None` where there is none.
fn browser(folder: &Folder, arguments: &[&str]) -> Option<Output> {
    let mut command = Command::new("chromium");
    command.args(["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]);
    command.args(["--disable-background-networking", "--enable-logging=stderr"]);
    command.arg(format!("--user-data-dir={}", folder.path().join("profile").display()));
    match command.args(arguments).current_dir(folder.path()).output() {
        Ok(output) => Some(output),
        Err(_) => {
            let required = std::env::var_os("LPTN_REQUIRE_ORACLES").is_some();
            assert!(!required, "chromium is required");
            eprintln!("skipped: there is no chromium");
            None
        }
    }
}

fn address(folder: &Folder, name: &str) -> String {
    format!("file://{}", folder.path().join(name).display())
}

/// Findings of the probe in a page.
pub(crate) fn probed(folder: &Folder, name: &str, width: u32) -> Option<Value> {
    browse::browsed(folder, &[(name, width)], PROBE).map(|mut found| found.remove(0))
}

fn fan() -> Folder {
    let folder = Folder::with("fan.toml", FAN);
    let ran = folder.run(&["run", "fan.toml", "--report=fan.html"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    folder
}

/// Every number of every chart at the time of a row is that of a column of `result.csv`, to the
/// last digit. All other numbers are at a switch, two times the smallest step apart, or 30 s after
/// it, when the fan may switch again.
#[test]
fn what_is_drawn_is_what_the_rows_say() {
    let folder = fan();
    let Some(found) = probed(&folder, "fan.html", 1000) else { return };
    let numbers = |name: &str| -> Vec<Vec<f64>> {
        let text = folder.read(name);
        let cells = |line: &str| line.split(',').filter_map(|cell| cell.parse().ok()).collect();
        text.lines().skip(1).map(cells).collect()
    };
    let (rows, events) = (numbers("out/fan/result.csv"), numbers("out/fan/events.csv"));
    let columns: Vec<Vec<f64>> =
        (0..rows[0].len()).map(|c| rows.iter().map(|row| row[c]).collect()).collect();
    let charts = found["charts"].as_array().unwrap();
    assert_eq!(charts.len(), 3);
    for chart in charts {
        let data = chart["data"].as_array().unwrap().iter().map(|column| {
            column.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<f64>>()
        });
        let data: Vec<Vec<f64>> = data.collect();
        let is_row = |time: &f64| columns[0].contains(time);
        for column in &data {
            let at_rows = data[0].iter().zip(column).filter(|(time, _)| is_row(time));
            let values: Vec<f64> = at_rows.map(|(_, value)| *value).collect();
            assert!(columns.contains(&values), "{:?} .. is not a column", &values[..3]);
        }
        let between: Vec<f64> = data[0].iter().copied().filter(|time| !is_row(time)).collect();
        assert!(!between.is_empty(), "the fan switches between rows");
        for time in between {
            let near = |event: f64| (event - time).abs() < 1e-9;
            let at = |event: &Vec<f64>| near(event[0]) || near(event[0] + 30.0);
            assert!(events.iter().any(at), "{time} s is neither a row nor an event");
        }
    }
}

#[test]
fn zoom_and_legend_work() {
    let folder = fan();
    let Some(found) = probed(&folder, "fan.html", 1000) else { return };
    for chart in found["charts"].as_array().unwrap() {
        let range = |name: &str| -> Vec<f64> {
            chart[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
        };
        let (before, zoomed, times) =
            (range("before"), range("zoomed"), chart["data"][0].as_array());
        let times = times.unwrap();
        let middle = times[times.len() / 2].as_f64().unwrap();
        assert_eq!((zoomed[0], zoomed[1]), (middle, 7200.0));
        assert!(zoomed[2] >= before[2] && zoomed[3] <= before[3], "{before:?} {zoomed:?}");
        assert_eq!(range("again"), before);
        let shown = |name: &str| chart[name].as_array().unwrap().last().unwrap().as_bool().unwrap();
        assert!(!shown("hidden") && shown("shown"));
        // by keys: nearer by 1.4 around the middle, then to the left by a tenth of what is seen
        assert_eq!(chart["pressed"], json!([false, "false"]));
        let (nearer, moved, all) = (range("nearer"), range("moved"), range("all"));
        let (half, left) = (3600.0 / 1.4, 3600.0 - 3600.0 / 1.4);
        let close = |a: &[f64], b: [f64; 2]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(close(&nearer, [left, 3600.0 + half]), "{nearer:?}");
        assert!(close(&moved, [left - 0.2 * half, 3600.0 + 0.8 * half]), "{moved:?}");
        assert_eq!(all, before[..2]);
    }
}

/// Drawings are as wide as the page at most. Buttons and keys zoom by 1.4, move, and show all.
#[test]
fn drawings_fit_the_page_and_can_be_zoomed() {
    let folder = fan();
    for width in [600, 1200, 1920] {
        let Some(found) = probed(&folder, "fan.html", width) else { return };
        let drawings = found["drawings"].as_array().unwrap();
        assert_eq!(drawings.len(), 2, "a circuit and its heat");
        for drawing in drawings {
            let view = |name: &str| -> Vec<f64> {
                drawing[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
            };
            let same = |a: &[f64], b: &[f64]| (a[2] - b[2]).abs() < 1e-9;
            let (page, right) = (&drawing["page"], drawing["right"].as_f64().unwrap());
            assert!(right <= page.as_f64().unwrap() + 1.0, "{right} of {page} at {width}");
            let (before, nearer, moved) = (view("before"), view("nearer"), view("moved"));
            assert!((before[2] / nearer[2] - 1.4).abs() < 1e-6, "{before:?} {nearer:?}");
            assert!(moved[0] > nearer[0] && same(&moved, &nearer), "{nearer:?} {moved:?}");
            assert_eq!((view("all"), view("again")), (before.clone(), before));
            assert!(same(&view("key"), &nearer));
        }
    }
}

/// WCAG 2.1: 4.5 for text. Nothing reaches over the right edge, from a telephone to a wide screen.
#[test]
fn everything_can_be_read_in_both_themes_at_three_widths() {
    let folder = fan();
    for width in [500, 1000, 1800] {
        let Some(found) = probed(&folder, "fan.html", width) else { return };
        for theme in ["light", "dark"] {
            let least = &found["contrast"][theme];
            assert!(least[0].as_f64().unwrap() >= 4.5, "{theme} at {width}: {least}");
        }
        assert_eq!(found["wide"], Value::Array(Vec::new()), "at {width}");
    }
}

/// Every word of every table is in the printed text, those that were folded away too.
#[test]
fn print_cuts_nothing() {
    let folder = fan();
    let address = address(&folder, "fan.html");
    let print = ["--print-to-pdf=fan.pdf", "--no-pdf-header-footer", &address];
    if browser(&folder, &print).is_none() {
        return;
    }
    let mut reader = Command::new("pdftotext");
    let reader = reader.args(["-layout", "fan.pdf", "-"]).current_dir(folder.path());
    let Ok(text) = reader.output() else {
        assert!(std::env::var_os("LPTN_REQUIRE_ORACLES").is_none(), "pdftotext is required");
        return;
    };
    let text: String = String::from_utf8_lossy(&text.stdout).split_whitespace().collect();
    let page = folder.read("fan.html");
    let cells = page.split("<td").skip(1).map(|cell| {
        let from = cell.find('>').unwrap() + 1;
        cell[from..from + cell[from..].find("</td>").unwrap()].to_owned()
    });
    for cell in cells.filter(|cell| !cell.contains(['&', '\u{2588}'])) {
        let cell: String = cell.split_whitespace().collect();
        assert!(text.contains(&cell), "{cell} is not printed");
    }
    assert!(text.contains("\"sundials\""), "the manifest is not printed");
}

/// A page in the dark theme is printed on white, and its margins of 15 mm stay empty: at 50 dots an
/// inch they are 29.5 dots wide.
#[test]
fn print_is_light_and_inside_its_margins() {
    let folder = fan();
    let page = folder.read("fan.html");
    folder.write("dark.html", &page.replacen("<html", "<html data-theme=\"dark\"", 1));
    let address = address(&folder, "dark.html");
    let print = ["--print-to-pdf=dark.pdf", "--no-pdf-header-footer", &address];
    if browser(&folder, &print).is_none() {
        return;
    }
    let mut drawer = Command::new("pdftoppm");
    let drawer = drawer.args(["-r", "50", "-gray", "dark.pdf"]).current_dir(folder.path());
    let Ok(drawn) = drawer.output() else {
        assert!(std::env::var_os("LPTN_REQUIRE_ORACLES").is_none(), "pdftoppm is required");
        return;
    };
    let (mut rest, mut pages) = (drawn.stdout.as_slice(), 0);
    while !rest.is_empty() {
        // P5, width and height, 255, then a byte for each dot
        let head: Vec<&[u8]> = rest.splitn(4, |byte| *byte == b'\n').collect();
        let size = std::str::from_utf8(head[1]).unwrap();
        let size: Vec<usize> = size.split(' ').map(|number| number.parse().unwrap()).collect();
        let (dots, next) = head[3].split_at(size[0] * size[1]);
        for row in dots.chunks(size[0]) {
            let edges = row[..28].iter().chain(&row[size[0] - 28..]);
            assert!(edges.copied().all(|dot| dot > 250), "something in a margin");
        }
        let mean = dots.iter().map(|dot| f64::from(*dot)).sum::<f64>() / dots.len() as f64;
        assert!(mean > 200.0, "a page is dark: {mean}");
        (rest, pages) = (next, pages + 1);
    }
    assert!(pages > 1);
}
