//! Kind: reference. Live pages: in a browser, and their core as WebAssembly in node.
//!
//! Numbers that a page shows are compared with those that the program prints for the same values.
//! A program that was built without the core (`make live`) refuses `--live`; then, and without node
//! or Chromium, these tests say so and pass. With `LPTN_REQUIRE_ORACLES` they need node and
//! Chromium if the core is there.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test that cannot go on has failed, and one that cannot begin says why"
)]

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

use crate::common::{Folder, GEARBOX, browse};

/// Probes a page: readable, within its width.
const LOOK: &str = include_str!("common/probe.js");

/// Moves a slider.
const MOVE: &str = include_str!("common/live_probe.js");

/// Runs the core in node.
const CORE: &str = include_str!("common/live.mjs");

/// Unpacks random data in node.
const UNPACK: &str = include_str!("common/unlzma.mjs");

/// True if the program has the core.
fn has_core() -> bool {
    let built = option_env!("LPTN_LIVE").is_some_and(|core| !core.is_empty());
    if !built {
        eprintln!("skipped: the program was built without the core of live pages");
    }
    built
}

/// The value of an expression in the page.
fn browsed(folder: &Folder, width: u32, expression: &str) -> Option<Value> {
    browse::browsed(folder, &[("live.html", width)], expression).map(|mut found| found.remove(0))
}

/// An expression that is evaluated when the page has its first answer.
fn answered(expression: &str) -> String {
    format!(
        "(async () => {{\nwhile (!document.querySelector('.tune').dataset.answers) \
         await new Promise(done => setTimeout(done, 20));\nreturn {expression};\n}})()"
    )
}

/// The gearbox with `R` between its parts as a parameter.
fn gearbox() -> Folder {
    let text = GEARBOX.replace("[param]", "[param]\nR = \"7.7 mK/W\"");
    let text = text.replace("1.7 [K] / 220.6 [W]", "R");
    let text = text + "\n[limit]\nhot = { of = \"steel.T\", below = \"83 degC\" }\n";
    let folder = Folder::with("gearbox.toml", &text);
    if has_core() {
        let ran = folder.run(&["run", "gearbox.toml", "--report=live.html", "--live"]);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
    }
    folder
}

#[test]
fn a_program_without_the_core_says_how_to_get_it() {
    if has_core() {
        return;
    }
    let folder = gearbox();
    let ran = folder.run(&["run", "gearbox.toml", "--report", "--live"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("report::no_core") && ran.err.contains("make build"), "{}", ran.err);
    assert_eq!(folder.files(), ["gearbox.toml"], "nothing is computed");
}

#[test]
fn live_pages_are_of_runs_with_a_report_and_without_bands() {
    let folder = gearbox();
    for words in [
        &["run", "gearbox.toml", "--live"][..],
        &["run", "gearbox.toml", "--live", "--report", "--uncertainty"],
        &["run", "gearbox.toml", "--live", "--report", "--posterior", "p.json"],
        &["steady", "gearbox.toml", "--live", "--report"],
    ] {
        let ran = folder.run(words);
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.err);
    }
}

/// Without its additions a live page is the page without `--live`, byte for byte.
#[test]
fn only_live_pages_have_the_core() {
    let folder = gearbox();
    if !has_core() {
        return;
    }
    let ran = folder.run(&["run", "gearbox.toml", "--report=plain.html"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let (mut page, plain) = (folder.read("live.html"), folder.read("plain.html"));
    assert!(!plain.contains("wasm") && !plain.contains("blob:") && !plain.contains("tune"));
    for (from, to) in [
        ("<section class=\"tune\">", "</section>\n"),
        ("<script type=\"application/json\" id=\"contents\">", "</script>\n"),
        ("<script type=\"application/x-lzma\" id=\"core\">", "</script>\n"),
        (".tune{", "display:none}\n}\n"),
        (" 'sha256-", "blob:"),
        ("<script>// Unpacks", "</script>\n"),
    ] {
        let begin = match from {
            " 'sha256-" => page.match_indices(from).nth(2).unwrap().0,
            from => page.find(from).unwrap_or_else(|| panic!("no {from}")),
        };
        let end = begin + page[begin..].find(to).unwrap() + to.len();
        page.replace_range(begin..end, "");
    }
    // the command in it has one word more
    let page = page.replace(" --live", "").replace("\"--live\"", "");
    let plain = plain.replace("plain.html", "live.html");
    let same = page.lines().zip(plain.lines()).filter(|(a, b)| a != b && !b.contains("arguments"));
    assert_eq!(same.collect::<Vec<_>>(), []);
}

/// The page is sent by mail: two megabytes.
#[test]
fn a_live_page_has_at_most_two_megabytes() {
    let folder = gearbox();
    if has_core() {
        let bytes = folder.read("live.html").len();
        // 2 MB are promised; the rest is for what will be added
        assert!(bytes <= 1_950_000, "{bytes} bytes");
    }
}

/// The oracle is xz. An end that is missing is an error.
#[test]
fn what_xz_packed_is_unpacked() {
    let folder = Folder::with("unlzma.mjs", UNPACK);
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../lptn-html/assets/unlzma.js");
    let mut node = Command::new("node");
    let Ok(output) = node.args(["unlzma.mjs", script]).current_dir(folder.path()).output() else {
        eprintln!("skipped: there is no node");
        return;
    };
    let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    if found.is_null() && Command::new("xz").arg("--version").output().is_err() {
        eprintln!("skipped: there is no xz");
        return;
    }
    assert_eq!(found, json!({ "inputs": 40, "differ": 0, "silent": 0 }));
}

/// The page as it is, under its own policy: the browser has nothing to say.
#[test]
fn a_live_page_solves_under_its_policy_without_a_word() {
    let folder = gearbox();
    if !has_core() {
        return;
    }
    let state = answered("document.querySelector('.said').textContent");
    let Some(found) = browsed(&folder, 1000, &state) else { return };
    let state = found.as_str().unwrap();
    assert!(state.ends_with("Same values as the program, to the last digit."), "{state}");
}

#[test]
fn a_live_page_can_be_read_in_both_themes_at_three_widths() {
    let folder = gearbox();
    if !has_core() {
        return;
    }
    let look = answered(&format!("await {LOOK}"));
    for width in [600, 1200, 1920] {
        let Some(found) = browsed(&folder, width, &look) else { return };
        for theme in ["light", "dark"] {
            let least = &found["contrast"][theme];
            assert!(least[0].as_f64().unwrap() >= 4.5, "{theme} at {width}: {least}");
        }
        assert_eq!(found["wide"], Value::Array(Vec::new()), "at {width}");
        assert_eq!(found["unreached"], Value::Array(Vec::new()), "at {width}");
    }
}

/// The cells of the row of a table that begins with a name.
fn row<'a>(part: &'a Value, name: &str) -> Vec<&'a str> {
    let rows = part.as_array().unwrap().iter();
    let rows = rows.map(|row| row.as_array().unwrap().iter().map(|c| c.as_str().unwrap().trim()));
    let mut rows = rows.map(Iterator::collect::<Vec<_>>);
    rows.find(|cells| cells.first() == Some(&name)).unwrap_or_else(|| panic!("{name} in {part}"))
}

/// The slider of `R` gives the steady state of `lptn steady --set`, and the rows of `lptn run`.
#[test]
fn a_slider_shows_what_the_program_prints() {
    let folder = gearbox();
    if !has_core() {
        return;
    }
    let Some(found) = browsed(&folder, 1000, MOVE) else { return };
    let (first, moved) = (&found["first"], &found["moved"]);
    let value = moved["fields"][0].as_str().unwrap();
    let set = format!("R={value} mK/W");
    assert!(value.parse::<f64>().unwrap() > 7.7, "{value}");
    assert_eq!(moved["command"], format!("lptn run gearbox.toml --set '{set}'"));
    let printed = |ran: &str, name: &str| -> Vec<String> {
        let line = ran.lines().find(|line| line.split_whitespace().next() == Some(name)).unwrap();
        line.split_whitespace().map(str::to_owned).collect()
    };
    let steady = folder.run(&["steady", "gearbox.toml", "--set", &set]).out;
    for name in ["steel", "aluminium", "skin", "mill_bed"] {
        assert_eq!(row(&moved["steady"], name)[1], printed(&steady, name)[1], "{name}: {steady}");
    }
    assert_eq!(row(&first["steady"], "steel")[1], "92.7");
    assert_ne!(row(&moved["steady"], "steel")[1], "92.7");
    let ran = folder.run(&["run", "gearbox.toml", "--set", &set, "--format", "csv", "--no-files"]);
    let last: Vec<f64> =
        ran.out.lines().last().unwrap().split(',').map(|n| n.parse().unwrap()).collect();
    let curves = moved["curves"].as_array().unwrap();
    assert!(curves.iter().all(|value| last.contains(&value.as_f64().unwrap())), "{curves:?}");
    // the limit of 83 degC is broken, which the claims say
    assert_eq!(ran.code, Some(1));
    assert!(moved["claims"].as_str().unwrap().contains("hot broken by"), "{}", moved["claims"]);
    assert!(!first["claims"].as_str().unwrap().contains("broken"));
    assert!(
        first["marked"] == 0 && moved["marked"].as_u64().unwrap() >= 3,
        "old drawings are marked"
    );
}

#[test]
fn a_live_page_refuses_wrong_values_and_goes_back() {
    let folder = gearbox();
    if !has_core() {
        return;
    }
    let Some(found) = browsed(&folder, 1000, MOVE) else { return };
    let (first, moved, wrong) = (&found["first"], &found["moved"], &found["wrong"]);
    assert_eq!(wrong["invalid"], "true");
    assert!(wrong["problems"].as_str().unwrap().contains("units::dimension"), "{wrong}");
    assert_eq!(wrong["steady"], moved["steady"], "the values before");
    let reset = &found["reset"];
    for part in ["steady", "results", "claims", "curves", "fields", "problems", "marked"] {
        assert_eq!(reset[part], first[part], "{part}");
    }
    assert_eq!(found["before"], first["results"], "the program and the page");
    assert!(found["named"] == true && found["reached"] == true, "by keyboard and by ear");
}

fn networks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_run = |file: &PathBuf| {
        file.extension().is_some_and(|ending| ending == "toml")
            && std::fs::read_to_string(file).unwrap().contains("\n[run]")
    };
    let mut files: Vec<PathBuf> = files.filter(is_run).collect();
    files.sort();
    files
}

/// The greatest difference of two tables of numbers with the same header.
fn apart(one: &str, other: &str) -> f64 {
    assert_eq!(one.lines().next(), other.lines().next());
    assert_eq!(one.lines().count(), other.lines().count());
    let numbers = |text: &str| -> Vec<f64> {
        let cells = text.lines().skip(1).flat_map(|line| line.split(','));
        cells.map(|cell| cell.parse().unwrap_or(0.0)).collect()
    };
    let pairs = numbers(one).into_iter().zip(numbers(other));
    pairs.map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
}

/// Networks with another integrator than that of the program differ by at most this, relative to
/// the value or to 1: some of their columns are heat flows in W, temperatures are in degC.
const CLOSE: f64 = 1e-3;

/// Every shipped network: the same bytes if the core takes the integrator of the program, else
/// within the tolerance, or a reason why there is no run.
#[test]
fn the_core_in_node_has_the_rows_of_the_program() {
    let folder = Folder::empty();
    if !has_core() {
        return;
    }
    let mut expected = Vec::new();
    for (i, file) in networks().iter().enumerate() {
        let (file, page, out) =
            (file.display().to_string(), format!("--report={i}.html"), format!("out{i}"));
        let words = ["run", &file, "--live", &page, "--format", "csv", "--output", &out];
        let ran = folder.run(&words);
        let manifest = folder.read(&format!("{out}/manifest.json"));
        let manifest: Value = serde_json::from_str(&manifest).unwrap();
        expected.push((file, ran.out, manifest["integrator"].clone()));
    }
    folder.write("live.mjs", CORE);
    let pages: Vec<String> = (0..expected.len()).map(|i| format!("{i}.html")).collect();
    let mut node = Command::new("node");
    let Ok(output) = node.arg("live.mjs").args(pages).current_dir(folder.path()).output() else {
        assert!(std::env::var_os("LPTN_REQUIRE_ORACLES").is_none(), "node is required");
        eprintln!("skipped: there is no node");
        return;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    let answers: Vec<Value> =
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(answers.len(), expected.len(), "{}", String::from_utf8_lossy(&output.stderr));
    let (mut same, mut close) = (0, 0);
    for (answer, (file, rows, integrator)) in answers.iter().zip(&expected) {
        let Some(found) = answer["rows"].as_str() else {
            let refused = answer["problems"].to_string();
            assert!(refused.contains("needs CVODE"), "{file}: {answer}");
            eprintln!("{file}: {integrator} in the program, none in the core");
            continue;
        };
        if answer["integrator"] == *integrator {
            assert!(found == rows, "{file}: {integrator}: differs by {:e}", apart(found, rows));
            same += 1;
        } else {
            let by = apart(found, rows);
            assert!(by < CLOSE, "{file}: {integrator} and {}: {by:e}", answer["integrator"]);
            eprintln!("{file}: {integrator} and {}: {by:.1e}", answer["integrator"]);
            close += 1;
        }
    }
    assert!(same > 10 && close > 5, "{same} with the same bytes, {close} close");
}

/// A rod of 1000 cells that heat enters at one end.
const ROD: &str = "format = 1
[param]
P = '10 W'
[grid.rod]
size = ['1 m', '10 mm', '10 mm']
cells = [1000]
k = '50 W/(m K)'
density = '7800 kg/m^3'
cp = '500 J/(kg K)'
T0 = '20 degC'
[boundary]
air = { T = '20 degC' }
[convection]
cold = { from = 'rod.x1', to = 'air', h = '100 W/(m^2 K)' }
[source]
loss = { into = 'rod.x0', P = 'P' }
[run]
stop = '10 min'
output = { every = '10 s' }
";

/// Moves the first slider forty times: the least time in ms from an edit to the page that shows it,
/// and how many times slower a loop of some 50 ms is than one that is too short to be interrupted.
const EDITS: &str = "(async () => {
const spin = count => {
  const begun = performance.now();
  let sum = 0;
  for (let i = 0; i < count; i++) sum += Math.sqrt(i + sum);
  return sum > 0 ? performance.now() - begun : 0;
};
const least = count => Math.min(...Array.from({ length: 10 }, () => spin(count)));
least(1e6);
const panel = document.querySelector('.tune'), slider = panel.querySelector('input[type=range]');
const answers = async n => {
  while (Number(panel.dataset.answers || 0) < n) await new Promise(done => setTimeout(done, 5));
};
await answers(1);
const took = [];
for (let i = 0; i < 40; i++) {
  slider.value = 300 + 10 * i;
  slider.dispatchEvent(new Event('input'));
  await answers(i + 2);
  took.push(Number(panel.dataset.took));
}
const short = least(1e6), count = Math.ceil(50 / short);
return [Math.min(...took), Math.max(1, least(count * 1e6) / (count * short))];
})()";

/// From an edit to the page that shows it: 50 ms for the gearbox, 200 ms for 1000 nodes, in as many
/// times as much if other programs interrupt this one.
#[test]
fn an_edit_is_seen_at_once() {
    if !has_core() {
        return;
    }
    let rod = Folder::with("rod.toml", ROD);
    rod.run(&["run", "rod.toml", "--report=live.html", "--live"]).exits(0);
    for (folder, most) in [(gearbox(), 50.0), (rod, 200.0)] {
        let Some(found) = browsed(&folder, 1000, EDITS) else { return };
        let [took, slower] = [0, 1].map(|i| found[i].as_f64().unwrap());
        assert!(took <= most * slower, "{took} ms are more than {most} ms times {slower}");
    }
}
