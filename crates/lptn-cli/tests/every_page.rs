//! Kind: reference. The page of every command in a browser, and its numbers compared with JSON.
//!
//! A page says nothing on the console, requests nothing, stays within the window, can be read in
//! both themes and used by keys. Every number of a table is a value of JSON, rounded, in the unit
//! of JSON or in a multiple of it.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::os::unix::fs::symlink;
use std::path::Path;

use serde_json::Value;

use crate::browser::PROBE;
use crate::common::Folder;
use crate::common::browse::browsed;

/// A page of every kind: its name and the words of its command.
const PAGES: [(&str, &str); 28] = [
    ("run", "run networks/gearbox_fan.toml"),
    ("run_cycle", "run docs/netlists/motor_jacket.toml"),
    ("run_family", "run docs/netlists/battery.toml"),
    ("run_grid", "run docs/netlists/housing_cover.toml"),
    ("run_unsure", "run docs/netlists/power_module.toml --uncertainty=linear"),
    ("steady", "steady docs/netlists/inverter.toml"),
    ("steady_grid", "steady docs/netlists/board.toml"),
    ("cycle", "steady docs/netlists/motor_jacket.toml --periodic"),
    ("compare", "compare networks/candidates"),
    ("compare_cases", "compare docs/netlists/vehicle.toml --cases"),
    ("size", "size docs/netlists/fins_and_fan.toml"),
    ("rank", "rank networks/gearbox.toml"),
    ("sweep", "sweep docs/netlists/motor_grid.toml"),
    ("sweep_many", "sweep docs/netlists/motor_sweep.toml"),
    ("gear", "gear docs/netlists/gear_stage.toml --speed 1000rpm,3000rpm"),
    ("impedance", "impedance networks/gearbox.toml --port steel --duty 0.5,0.1"),
    ("foster", "impedance docs/netlists/power_module.toml --port chip --foster"),
    ("modes", "modes networks/gearbox.toml"),
    ("verify", "verify networks/gearbox.toml"),
    ("reduce", "reduce networks/gearbox.toml --port steel"),
    ("reduce_keep", "reduce networks/rc_ladder.toml --keep n1,n8"),
    ("plan", "plan docs/gearbox_plan.toml"),
    ("fit_step", "fit step docs/records/gearbox_7000rpm.csv --column ring_gear"),
    ("fit_network", "fit network docs/gearbox_sensors.toml"),
    ("fit_compare", "fit compare docs/skins.toml docs/cold_cups.toml"),
    ("infer", "infer docs/bench.toml"),
    ("check", "check networks/gearbox.toml"),
    ("materials", "materials"),
];

/// Runs a command of the list in a folder with the networks and pages of the repository.
fn run(folder: &Folder, words: &str, more: &[&str]) -> String {
    let words: Vec<&str> =
        words.split(' ').chain(["--quiet"]).chain(more.iter().copied()).collect();
    let ran = folder.run(&words);
    assert!(ran.code.is_some_and(|code| code <= 1), "{words:?}: {}", ran.err);
    ran.out
}

/// A folder with the page of every command.
fn pages() -> Folder {
    let folder = Folder::empty();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for name in ["networks", "docs"] {
        symlink(root.join(name), folder.path().join(name)).unwrap();
    }
    for (name, words) in PAGES {
        run(&folder, words, &[&format!("--report={name}.html")]);
    }
    folder
}

#[test]
fn every_page_opens_and_can_be_read_and_used_by_keys() {
    let folder = pages();
    let names: Vec<String> = PAGES.iter().map(|(name, _)| format!("{name}.html")).collect();
    // the end of what the program prints is the beginning of the page
    for name in ["size", "rank", "plan"] {
        let page = folder.read(&format!("{name}.html"));
        let results = page.find("<h2>Results</h2>").unwrap();
        let last = page[results..].split("<h2>Network</h2>").next().unwrap();
        let last = last[last.rfind("<p>").unwrap()..].split("</p>").next().unwrap();
        let last = last.rsplit("</span> ").next().unwrap();
        assert!(page[..page.find("<figure").unwrap()].contains(last), "{name}: {last}");
    }
    for name in &names {
        let page = folder.read(name);
        assert!(!page.contains(" src=") && !page.contains(" href="), "{name}");
        assert!(!page.contains("url("), "{name}");
    }
    for width in [600, 1200, 1920] {
        let all: Vec<(&str, u32)> = names.iter().map(|name| (name.as_str(), width)).collect();
        let Some(found) = browsed(&folder, &all, PROBE) else { return };
        for ((name, _), found) in PAGES.iter().zip(&found) {
            let empty = Value::Array(Vec::new());
            assert_eq!(found["wide"], empty, "{name} at {width}");
            assert_eq!(found["unreached"], empty, "{name} at {width}");
            assert!(found["used"].as_u64() >= Some(1), "{name}: {found}");
            for theme in ["light", "dark"] {
                let least = &found["contrast"][theme];
                assert!(least[0].as_f64().unwrap() >= 4.5, "{name}, {theme} at {width}: {least}");
            }
            for drawing in found["drawings"].as_array().unwrap() {
                let right = drawing["right"].as_f64().unwrap();
                assert!(right <= f64::from(width) + 1.0, "{name} at {width}: {drawing}");
            }
        }
    }
}

/// Every number in a text of JSON.
fn numbers(of: &Value, found: &mut Vec<f64>) {
    match of {
        Value::Number(number) => found.extend(number.as_f64()),
        Value::Array(all) => all.iter().for_each(|one| numbers(one, found)),
        Value::Object(all) => all.values().for_each(|one| numbers(one, found)),
        _ => {}
    }
}

/// Columns of pages whose numbers follow from those of JSON: differences to a boundary, shares, half
/// widths of intervals, differences to the least AICc, the time that a control was on; and, in a
/// plan, the parameters as the netlist has them.
const DERIVED: [(&str, &str); 12] = [
    ("run", "mean period"),
    ("run", "on for"),
    ("steady", "over air [K]"),
    ("steady_grid", "over air [K]"),
    ("impedance", "settled"),
    ("foster", "share"),
    ("fit_network", "95 % \u{b1}"),
    ("fit_compare", "95 % \u{b1}"),
    ("fit_step", "95 % \u{b1}"),
    ("fit_compare", "AICc"),
    ("plan", "95 % \u{b1}"),
    ("plan", "value"),
];

/// Multiples of units: of ten, percent, min, h, d, degrees, revolutions a minute, and the unit of
/// the loss of a gearbox, which `docs/gearbox_sensors.toml` has in uW/rpm^(5/3).
const FACTORS: [f64; 14] = [
    1.0,
    100.0,
    1e3,
    1e-3,
    1e6,
    1e-6,
    1e9,
    1e-9,
    1.0 / 60.0,
    1.0 / 3600.0,
    1.0 / 86_400.0,
    180.0 / std::f64::consts::PI,
    30.0 / std::f64::consts::PI,
    // (pi / 30)^(5/3), times 1e6
    23_265.605_7,
];

/// The value of a printed number and half of its last digit; `None` for fewer than three digits. The
/// zeros at the end of an integer may be rounded.
fn printed(text: &str) -> Option<(f64, f64)> {
    let value: f64 = text.parse().ok()?;
    let (digits, power) = text.split_once('e').unwrap_or((text, "0"));
    let mut power: i32 = power.parse().ok()?;
    let mut digits = digits.trim_start_matches(['-', '+', '0', '.']);
    match digits.split_once('.') {
        Some((_, after)) => power -= i32::try_from(after.len()).ok()?,
        None => {
            let zeros = digits.len() - digits.trim_end_matches('0').len();
            digits = &digits[..digits.len() - zeros];
            power += i32::try_from(zeros).ok()?;
        }
    }
    let count = digits.chars().filter(char::is_ascii_digit).count();
    (count >= 3).then_some((value, 0.5001 * 10_f64.powi(power)))
}

/// The numbers in the right-aligned cells of the tables of the answer, without derived columns and
/// without the table of parameters, whose values are texts of the netlist.
fn cells(name: &str, page: &str) -> Vec<String> {
    let answer = page.split("<h2>Parameters</h2>").next().unwrap();
    let texts = |part: &str, tag: &str| -> Vec<(bool, String)> {
        let cells = part.split(tag).skip(1).filter(|cell| cell.starts_with([' ', '>']));
        let one = |cell: &str| {
            let (head, text) = cell.split_once('>').unwrap();
            (head.contains("number"), text.split("</t").next().unwrap().to_owned())
        };
        cells.map(one).collect()
    };
    let mut found = Vec::new();
    for table in answer.split("<table>").skip(1) {
        let table = table.split("</table>").next().unwrap();
        let heads = texts(table, "<th");
        for row in table.split("<tr>").skip(1) {
            for (i, (number, text)) in texts(row, "<td").into_iter().enumerate() {
                let head = heads.get(i).map_or("", |head| head.1.as_str());
                let derived = DERIVED.contains(&(name, head));
                if number && !derived {
                    found.extend(text.split_whitespace().map(str::to_owned));
                }
            }
        }
    }
    found
}

#[test]
fn every_number_of_a_table_is_one_of_json() {
    let folder = pages();
    let (mut checked, mut unknown) = (0, Vec::new());
    for (name, words) in PAGES.iter().filter(|(name, _)| !["check", "materials"].contains(name)) {
        let json: Value = serde_json::from_str(&run(&folder, words, &["--format=json"])).unwrap();
        let mut known = Vec::new();
        numbers(&json, &mut known);
        for cell in cells(name, &folder.read(&format!("{name}.html"))) {
            let Some((value, half)) = printed(&cell) else { continue };
            let is_it = |number: &f64| {
                FACTORS.iter().any(|factor| (number.abs() * factor - value.abs()).abs() <= half)
            };
            checked += 1;
            if !known.iter().any(is_it) {
                unknown.push(format!("{name}: {cell}"));
            }
        }
    }
    assert_eq!(unknown, Vec::<String>::new());
    assert!(checked > 500, "{checked} numbers");
}
