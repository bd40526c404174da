//! Kind: determinism. The core of a page answers as the program: the same call, natively.
//!
//! Expected numbers are those of the program's own question; here only the way into a page and out
//! of it is under test.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn_answer::input::Input;
use lptn_answer::listener::Nobody;
use lptn_answer::run::RunQuestion;
use lptn_answer::steady::SteadyQuestion;
use lptn_live::{Changes, Live, contents, sliders};
use lptn_report::{Page as _, write_csv};
use serde_json::Value;

/// The gearbox of the seed paper, whose two parts have `R` as a parameter.
fn gearbox() -> Input {
    let text = include_str!("../../../networks/gearbox.toml");
    let text =
        text.replace("[param]", "[param]\nR = \"7.7 mK/W\"").replace("1.7 [K] / 220.6 [W]", "R");
    let folder = std::env::temp_dir().join(format!("lptn-live-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("gearbox_R.toml");
    std::fs::write(&file, text).unwrap();
    Input::read(&file).unwrap()
}

fn opened(input: &Input, changes: &Changes<'_>) -> Live {
    let contents = contents(&input.netlist, changes, &RunQuestion::default()).to_string();
    Live::open(&contents).unwrap()
}

fn ask(live: &Live, question: &str) -> Value {
    serde_json::from_str(&live.answer(question)).unwrap()
}

/// The rows that `lptn run` writes.
fn rows(input: &Arc<Input>) -> String {
    let answer = RunQuestion::default().ask(Arc::clone(input), &Nobody).unwrap();
    let mut bytes = Vec::new();
    write_csv(&answer.shown_table(), &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn networks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        files.filter(|file| file.extension().is_some_and(|ending| ending == "toml")).collect();
    files.sort();
    files
}

#[test]
fn every_network_has_the_rows_of_the_program() {
    let mut runs = 0;
    for file in networks() {
        let input = Arc::new(Input::read(&file).unwrap());
        if input.netlist.run.is_none() {
            continue;
        }
        let answer = ask(&opened(&input, &Changes::default()), "{\"rows\":true}");
        assert_eq!(answer["rows"], rows(&input), "{}", file.display());
        runs += 1;
    }
    assert!(runs > 20, "{runs}");
}

#[test]
fn other_values_and_the_command_line_are_kept() {
    let plain = gearbox();
    let (set, stop) = (["P_7000=300 W".to_owned()], Some("10 min"));
    let live = opened(&plain, &Changes { set: &set, stop, ..Changes::default() });
    let answer = ask(&live, "{\"rows\":true,\"set\":[\"R=0.02 K/W\"]}");
    let mut input = plain.set(&["P_7000=300 W"]).unwrap();
    input.set_times(stop, None).unwrap();
    let input = Arc::new(input.set(&["R=0.02 K/W"]).unwrap());
    assert_eq!(answer["rows"], rows(&input));
    assert_eq!(answer["parameters"][0]["text"], "20");
    assert_eq!(answer["parameters"][0]["unit"], "mK/W");
    // all numbers of the steady state
    let steady = SteadyQuestion::default().ask(input, &Nobody).unwrap();
    let text = lptn_html::results(&lptn_report::with_results(
        &steady.text(),
        Vec::new(),
        lptn_report::Report::default(),
    ));
    assert_eq!(answer["steady"], text);
    assert!(text.contains("aluminium"), "{text}");
}

/// `T_steel - T_aluminium` is `R P` in steady state: 0.02 K/W x 220.6 W over the 91.0 degC of the
/// head of the file.
#[test]
fn the_steady_state_is_that_of_the_closed_form() {
    let live = opened(&gearbox(), &Changes::default());
    let answer = ask(&live, "{\"set\":[\"R=0.02 K/W\"]}");
    let steady = answer["steady"].as_str().unwrap();
    let end = 25.5 + 65.5 + 0.02 * 220.6;
    assert!(steady.contains(&format!(">{end:.1}<")), "{end}: {steady}");
}

#[test]
fn wrong_values_are_refused_in_the_words_of_the_program() {
    let live = opened(&gearbox(), &Changes::default());
    for (set, code) in [("R=1 W", "units::dimension"), ("R=x", ""), ("Q=1", "")] {
        let answer = ask(&live, &serde_json::json!({ "set": [set] }).to_string());
        let problem = &answer["refused"][0];
        assert!(problem["message"].as_str().is_some_and(|text| !text.is_empty()), "{answer}");
        assert!(code.is_empty() || problem["code"] == code, "{answer}");
        assert_eq!(answer.as_object().unwrap().len(), 1, "no result beside a refusal");
    }
    assert!(Live::open("{}").is_err() && Live::open("no").is_err());
}

/// Powers of ten and temperatures: ends of ranges by hand.
#[test]
fn sliders_are_from_a_quarter_to_four_times() {
    let all = sliders(&gearbox());
    let by_name = |name: &str| all.iter().find(|slider| slider.name == name).unwrap();
    let share = by_name("bed_share");
    assert!(share.log && share.unit.is_empty());
    assert!((share.range[0] - 0.175).abs() < 1e-12 && (share.range[1] - 2.8).abs() < 1e-12);
    let ambient = by_name("T_amb");
    assert!(!ambient.log && ambient.unit == "degC");
    assert!((ambient.range[0] + 24.5).abs() < 1e-9 && (ambient.range[1] - 75.5).abs() < 1e-9);
}
