//! Command line: `lptn steady --periodic`.

use crate::common;

use common::Folder;
use serde_json::Value;

const DUTY: &str = include_str!("../../../networks/duty_cycle.toml");
const GUN: &str = include_str!("../../../networks/welding_gun.toml");

fn number(json: &Value) -> f64 {
    json["value"].as_f64().expect("a scalar")
}

/// R = 0.3046 K/W, C = 2659 J/K, 220 W for 3 of every 10 min from 25 degC:
/// x(0) = X (1 - exp(-a/tau)) exp(-(p - a)/tau) / (1 - exp(-p/tau)).
fn start_of_duty() -> f64 {
    let (on, period, tau, rise) = (180.0_f64, 600.0, 0.3046 * 2659.0, 220.0 * 0.3046);
    25.0 + rise * (1.0 - (-on / tau).exp()) * (-(period - on) / tau).exp()
        / (1.0 - (-period / tau).exp())
}

#[test]
fn a_duty_cycle_settles_at_its_closed_form() {
    let folder = Folder::with("duty.toml", DUTY);
    let args = ["steady", "duty.toml", "--periodic"];
    let json = folder.run(&[&args[..], &["--format", "json"]].concat()).exits(0).json();
    let body = &json["columns"]["body.T"];
    assert!((number(&body["start"]) - start_of_duty()).abs() < 1e-9, "{body}");
    // all heat leaves: 66 W on average
    assert!((number(&body["mean"]) - 25.0 - 66.0 * 0.3046).abs() < 1e-4);
    assert!((number(&json["columns"]["amb.Q"]["mean"]) + 66.0).abs() < 1e-4);
    assert!((number(&body["max_at"]) - 180.0).abs() < 1e-9);
    let swing = number(&body["max"]) - number(&body["min"]);
    assert!((number(&body["swing"]) - swing).abs() < 1e-9);
    assert!((number(&json["period"]) - 600.0).abs() < 1e-12);
    let search = &json["search"];
    assert_eq!((search["method"].as_str(), search["cycles"].as_u64()), (Some("modes"), Some(1)));
    assert!((number(&search["time_constant"]) - 0.3046 * 2659.0).abs() < 1e-6);
    assert!(number(&search["residual"]) < 1e-4);

    let csv =
        folder.run(&[&args[..], &["--format", "csv", "--select", "*.T"]].concat()).exits(0).out;
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("name,unit,start,mean,min,min_at [s],max,max_at [s],swing"));
    let row: Vec<&str> = lines.next().expect("a row").split(',').collect();
    assert_eq!(&row[..2], ["body.T", "degC"]);
    assert!((row[2].parse::<f64>().unwrap() - start_of_duty()).abs() < 1e-9);
    assert!(folder.files() == ["duty.toml"]);
}

#[test]
fn a_cycle_with_radiation_is_shown_and_written() {
    let folder = Folder::with("gun.toml", GUN);
    let ran = folder.run(&["steady", "gun.toml", "--periodic", "-o", "settled"]).exits(0);
    let ran = ran.prints("swing [K]").prints("by shooting").prints("settled:").prints("balance:");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    let files = ["events.csv", "manifest.json", "result.csv", "state.json", "windows.csv"];
    let files = files.map(|name| format!("settled/{name}"));
    assert_eq!(folder.files(), [&["gun.toml".to_owned()][..], &files].concat());
    let result = folder.read("settled/result.csv");
    let rows: Vec<Vec<f64>> = result
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 301, "the usual number of rows, as every 5 s are too few");
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    assert!(
        first[1..4].iter().zip(&last[1..4]).all(|(a, b)| (a - b).abs() < 1e-4),
        "{first:?} {last:?}"
    );
}

#[test]
fn what_is_no_cycle_is_refused() {
    let refused = |text: &str, more: &[&str], code: &str, exit: i32| {
        let folder = Folder::with("n.toml", text);
        let ran = folder.run(&[&["steady", "n.toml", "--periodic"], more].concat()).exits(exit);
        assert!(ran.err.contains(code), "{}", ran.err);
        ran.err
    };
    let text = refused(DUTY, &["--period", "7 min"], "periodic::not_periodic", 2);
    assert!(
        text.contains("losses") && text.contains("220 W") && text.contains("--period"),
        "{text}"
    );
    refused(DUTY, &["--period", "-1 s"], "periodic::period", 2);
    refused(DUTY, &["--period", "5 K"], "units::dimension", 2);
    let constant =
        DUTY.replace("P = \"duty\"", "P = \"220 W\"").replace("[signal]\nduty", "[signal]\nidle");
    refused(&constant, &[], "periodic::no_period", 2);
    let sine = DUTY.replace("P = \"duty\"", "P = \"220 [W] * sin(2 * pi * t / 600 [s])^2\"");
    refused(&sine, &[], "periodic::no_period", 2);
    let other = "other = { t = [\"0 s\", \"1 s\"], v = [1, 2], after_end = \"repeat\", period = \
        \"31.4159265 s\" }";
    let two = DUTY
        .replace("[node]", &format!("{other}\n\n[node]"))
        .replace("P = \"duty\"", "P = \"duty * other\"");
    let text = refused(&two, &[], "periodic::no_common_period", 2);
    assert!(text.contains("`other`") && text.contains("`duty`"), "{text}");
    let closed = DUTY.replace("from = \"body\", to = \"amb\"", "from = \"body\", to = \"lid\"");
    let closed = closed.replace("[node]\n", "[node]\nlid = { C = \"10 J/K\", T0 = \"25 degC\" }\n");
    // 220 W for three minutes
    assert!(refused(&closed, &[], "periodic::no_balance", 2).contains("39600 J"));
    let folder = Folder::with("n.toml", DUTY);
    folder.run(&["steady", "n.toml", "--period", "10 min"]).exits(2);
}
