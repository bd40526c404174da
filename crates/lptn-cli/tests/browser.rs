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

use common::Folder;
use serde_json::Value;

const PROBE: &str = include_str!("common/probe.js");

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

/// What a page is when its scripts have run, and what the browser said meanwhile.
pub(crate) fn opened(folder: &Folder, name: &str, width: u32) -> Option<(String, Vec<String>)> {
    let size = format!("--window-size={width},1200");
    let address = address(folder, name);
    let arguments = ["--virtual-time-budget=5000", "--dump-dom", &size, &address];
    let output = browser(folder, &arguments)?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let said = said.lines().filter(|line| line.contains(":CONSOLE")).map(str::to_owned).collect();
    Some((String::from_utf8(output.stdout).unwrap(), said))
}

/// What the probe finds in a page, for which another script is allowed in a copy of it.
pub(crate) fn probed(folder: &Folder, name: &str, width: u32) -> Option<Value> {
    let page = folder.read(name);
    let from = page.find("<meta http-equiv=\"Content-Security-Policy\"").unwrap();
    let to = from + page[from..].find('\n').unwrap();
    let page = format!("{}{}", &page[..from], &page[to..]);
    let probed = page.replace("</body>", &format!("<script>{PROBE}</script></body>"));
    folder.write("probed.html", &probed);
    let (page, said) = opened(folder, "probed.html", width)?;
    assert!(said.is_empty(), "{said:?}");
    let begin = "<pre id=\"probe\">";
    let from = page.find(begin).unwrap_or_else(|| panic!("no probe: {page}")) + begin.len();
    let to = from + page[from..].find("</pre>").unwrap();
    let text = page[from..to].replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    Some(serde_json::from_str(&text).unwrap())
}

fn fan() -> Folder {
    let folder = Folder::with("fan.toml", FAN);
    let ran = folder.run(&["run", "fan.toml", "--report=fan.html"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    folder
}

#[test]
fn a_page_opens_from_disk_without_a_word() {
    let folder = fan();
    let Some((page, said)) = opened(&folder, "fan.html", 1000) else { return };
    assert!(said.is_empty(), "{said:?}");
    assert!(page.contains("data-ready=\"1\"") && page.contains("<canvas"), "the charts are there");
}

/// Every number of every chart is that of a column of `result.csv`, to the last digit.
#[test]
fn what_is_drawn_is_what_the_rows_say() {
    let folder = fan();
    let Some(found) = probed(&folder, "fan.html", 1000) else { return };
    let rows = folder.read("out/fan/result.csv");
    let rows: Vec<Vec<f64>> = rows
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    let columns: Vec<Vec<f64>> =
        (0..rows[0].len()).map(|c| rows.iter().map(|row| row[c]).collect()).collect();
    let charts = found["charts"].as_array().unwrap();
    assert_eq!(charts.len(), 3);
    for chart in charts {
        for column in chart["data"].as_array().unwrap() {
            let values = column.as_array().unwrap().iter();
            let values: Vec<f64> = values.map(|v| v.as_f64().unwrap()).collect();
            assert!(columns.contains(&values), "{:?} .. is no column", &values[..3]);
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
        let (before, zoomed) = (range("before"), range("zoomed"));
        assert_eq!((zoomed[0], zoomed[1]), (3600.0, 7200.0));
        assert!(zoomed[2] >= before[2] && zoomed[3] <= before[3], "{before:?} {zoomed:?}");
        assert_eq!(range("again"), before);
        let shown = |name: &str| chart[name].as_array().unwrap().last().unwrap().as_bool().unwrap();
        assert!(!shown("hidden") && shown("shown"));
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
