//! Every output has its temperatures in one unit: the one that is shown, and K or degR for their
//! differences.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Folder, GEARBOX};
use serde_json::Value;

/// What is a difference of temperatures by its name.
const DIFFERENCES: [&str; 16] = [
    "margin",
    "sd",
    "effect",
    "swing",
    "residual",
    "error",
    "rms",
    "dT",
    "rise",
    "tolerance",
    "drift",
    "bias",
    "sensor",
    "resolution",
    "amplitudes",
    "extrapolated",
];

/// A number in K beside the same in `unit`, degF or degR.
fn is_same(kelvin: &Value, other: &Value, unit: &str) -> bool {
    let (Some(kelvin), Some(other)) = (kelvin.as_f64(), other.as_f64()) else {
        return kelvin == other;
    };
    let expected = 1.8 * kelvin - if unit == "degF" { 459.67 } else { 0.0 };
    (other - expected).abs() <= 1e-9 * expected.abs().max(1.0)
}

/// Compares an object in K with the same in degF, and gives how many temperatures it has.
fn compared(key: &str, kelvin: &Value, other: &Value) -> usize {
    let same_unit = |k: &Value, o: &Value, key: &str| match (k.as_str(), o.as_str()) {
        (Some("K"), Some(unit @ ("degF" | "degR"))) => {
            assert!(unit == "degR" || !DIFFERENCES.contains(&key), "{key}: {other}");
            Some(unit.to_owned())
        }
        (k, o) => {
            assert!(k == o && k != Some("K"), "{key}: {other}");
            None
        }
    };
    match (kelvin, other) {
        (Value::Object(k), Value::Object(o)) if k.contains_key("rows") => {
            compared_rows((&k["columns"], &o["columns"]), (&k["rows"], &o["rows"]), same_unit)
                + compared_members(k, o)
        }
        (Value::Object(k), Value::Object(o)) if k.contains_key("unit") => {
            let Some(unit) = same_unit(&k["unit"], &o["unit"], key) else {
                return compared_members(k, o);
            };
            assert!(is_same(&k["value"], &o["value"], &unit), "{key}: {kelvin} {other}");
            for error in ["standard_error", "naive_standard_error", "systematic_error"] {
                assert!(is_same(&kelvin[error], &other[error], "degR"), "{key}: {kelvin} {other}");
            }
            let ends = |of: &Value| of["interval_95"].as_array().cloned().unwrap_or_default();
            for (k, o) in ends(kelvin).iter().zip(&ends(other)) {
                assert!(is_same(k, o, &unit), "{key}: {kelvin} {other}");
            }
            1
        }
        (Value::Object(k), Value::Object(o)) => compared_members(k, o),
        (Value::Array(k), Value::Array(o)) => {
            assert_eq!(k.len(), o.len(), "{key}");
            k.iter().zip(o).map(|(k, o)| compared(key, k, o)).sum()
        }
        _ => 0,
    }
}

fn compared_members(
    k: &serde_json::Map<String, Value>,
    o: &serde_json::Map<String, Value>,
) -> usize {
    assert!(k.keys().eq(o.keys()), "{:?} {:?}", k.keys(), o.keys());
    let inside = k.iter().filter(|(key, _)| !["rows", "value"].contains(&key.as_str()));
    inside
        .filter(|(key, k)| *key != "columns" || k.is_object())
        .map(|(key, k)| compared(key, k, &o[key]))
        .sum()
}

fn compared_rows(
    columns: (&Value, &Value),
    rows: (&Value, &Value),
    same_unit: impl Fn(&Value, &Value, &str) -> Option<String>,
) -> usize {
    let list = |of: &Value| of.as_array().unwrap().clone();
    let mut found = 0;
    for (i, (k, o)) in list(columns.0).iter().zip(&list(columns.1)).enumerate() {
        assert_eq!(k["name"], o["name"]);
        let Some(unit) = same_unit(&k["unit"], &o["unit"], k["name"].as_str().unwrap()) else {
            continue;
        };
        for (k, o) in list(rows.0).iter().zip(&list(rows.1)) {
            assert!(is_same(&k[i], &o[i], &unit), "{k} {o}");
            found += 1;
        }
    }
    found
}

/// A gearbox with a limit, a window, a report and uncertain parameters.
fn of_everything() -> Folder {
    let text = GEARBOX
        .replace("\"25.5 degC\"", "\"25.5 ± 1 degC\"")
        .replace("\"220.6 W\"", "\"220.6 W ± 5 %\"");
    let run = "[run]\nreport = { rise = \"steel.T - air.T\", wide = \"mean(steel.T - air.T)\" }\nselect = [\"*.T\", \"rise\"]\n\
               window = { late = { from = \"20 min\", to = \"25 min\" } }\n";
    let limits = "[limit]\nhot = { of = \"steel.T\", below = \"90 degC\" }\n\
                  rise = { of = \"steel.T - air.T\", below = \"90 K\" }\n";
    let folder = Folder::with("gearbox.toml", &(text.replace("[run]\n", run) + limits));
    let duty = include_str!("../../../networks/duty_cycle.toml").to_owned();
    folder.write(
        "duty.toml",
        &(duty + "\n[limit]\nhot = { of = \"body.T\", below = \"90 degC\" }\n"),
    );
    let ring = |t: f64| 92.7 - 67.2 * (-t / 810.0).exp() + 0.05 * (t / 7.0).sin();
    let rows = (0..300).map(|i| 5.0 * f64::from(i)).map(|t| format!("{t},{:.2}\n", ring(t)));
    folder.write("record.csv", &format!("t [s],ring [degC]\n{}", rows.collect::<String>()));
    folder
}

/// Every temperature and every difference goes with the unit that is asked for.
#[test]
fn temperatures_come_in_one_unit() {
    let folder = of_everything();
    for (command, least) in [
        ("run gearbox.toml --no-files", 900),
        ("run gearbox.toml --no-files --uncertainty linear", 1500),
        ("run gearbox.toml --no-files --uncertainty sobol --samples 64", 1500),
        ("steady gearbox.toml", 8),
        ("steady duty.toml --periodic", 10),
        ("compare gearbox.toml duty.toml", 6),
        ("rank gearbox.toml", 6),
        ("reduce gearbox.toml --port steel --bias", 6),
        ("fit step record.csv --capacity 2659J/K --sensor 1K", 5),
        ("fit step record.csv --model gearbox.toml --port steel", 10),
    ] {
        let [kelvin, fahrenheit] = ["K", "degF"]
            .map(|unit| folder.json(&format!("{command} --temperature-unit {unit}")).json());
        let found = compared("", &kelvin, &fahrenheit);
        assert!(found >= least, "{command}: {found} temperatures");
        // without the option in the netlist's, which is degC, and no absolute one in K
        let celsius = folder.json(command).json();
        assert!(celsius.to_string().contains("\"degC\""), "{command}: {celsius}");
    }
}

/// Compares two files of CSV, one in K and the same in degF, and gives how many temperatures they
/// have. A column has its unit in brackets, or a row has it in its cell `unit`.
fn compared_csv(kelvin: &str, other: &str) -> usize {
    let cells = |text: &str| -> Vec<Vec<String>> {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        let row = |row: csv::StringRecord| row.iter().map(str::to_owned).collect();
        reader.records().map(|record| row(record.unwrap())).collect()
    };
    let (kelvin, other) = (cells(kelvin), cells(other));
    assert_eq!(kelvin.len(), other.len());
    let unit_of = |rows: &[Vec<String>], row: usize, column: usize| {
        let header = &rows[0][column];
        let own = header.split_once(" [").map(|(_, unit)| unit.trim_end_matches(']').to_owned());
        let of_row = rows[0].iter().position(|header| header == "unit");
        own.or_else(|| of_row.map(|place| rows[row][place].clone())).unwrap_or_default()
    };
    let mut found = 0;
    for row in 1..kelvin.len() {
        for column in 0..kelvin[0].len() {
            let (k, o) = (unit_of(&kelvin, row, column), unit_of(&other, row, column));
            assert_ne!(o, "K", "{:?}", other[0][column]);
            let (a, b) = (kelvin[row][column].parse::<f64>(), other[row][column].parse::<f64>());
            let (Ok(a), Ok(b)) = (a, b) else { continue };
            if k == "K" && kelvin[0][column] != "value [-]" {
                // a bound or a swing beside its value is a difference
                let difference = ["swing", "bound"].contains(&kelvin[0][column].as_str());
                let unit = if difference { "degR" } else { o.as_str() };
                assert!(["degF", "degR"].contains(&unit), "{unit}");
                let same = is_same(&a.into(), &b.into(), unit) || (a.is_nan() && b.is_nan());
                assert!(same, "{:?} {a} {b}", kelvin[0][column]);
                found += 1;
            }
        }
    }
    found
}

/// A mean difference was in degR in one file and in K in the next.
#[test]
fn csv_and_tables_have_the_units_of_json() {
    let folder = of_everything();
    for (command, least) in [
        ("run gearbox.toml --no-files", 900),
        ("run gearbox.toml --no-files --certify", 900),
        ("run gearbox.toml --no-files --uncertainty linear", 900),
        ("steady gearbox.toml", 4),
        ("steady duty.toml --periodic", 10),
        ("compare gearbox.toml duty.toml", 6),
        ("rank gearbox.toml", 6),
        ("reduce gearbox.toml --port steel --bias", 2),
        ("fit step record.csv --capacity 2659J/K --sensor 1K", 5),
    ] {
        let [kelvin, fahrenheit] = ["K", "degF"].map(|unit| {
            let all = format!("{command} --temperature-unit {unit} --format csv");
            folder.run(&all.split(' ').collect::<Vec<_>>()).out
        });
        let found = compared_csv(&kelvin, &fahrenheit);
        assert!(found >= least, "{command}: {found} temperatures");
        let all = format!("{command} --temperature-unit degF");
        let text = folder.run(&all.split(' ').collect::<Vec<_>>()).out;
        let heads = text.lines().filter(|line| line.contains("[K]"));
        let heads: Vec<&str> = heads.filter(|_| !command.starts_with("reduce")).collect();
        assert!(heads.is_empty(), "{command}: {heads:?}");
    }
    for unit in ["K", "degF"] {
        let all = format!("run gearbox.toml --temperature-unit {unit} --certify -o {unit}");
        folder.run(&all.split(' ').collect::<Vec<_>>());
    }
    for name in ["result", "windows", "reports"] {
        let [kelvin, fahrenheit] =
            ["K", "degF"].map(|unit| folder.read(&format!("{unit}/{name}.csv")));
        let found = compared_csv(&kelvin, &fahrenheit);
        assert!(found >= 2, "{name}: {found} temperatures");
    }
}

/// The last row, the window's largest value, the limit's worst and the steady state's are one
/// number, and CSV has it too.
#[test]
fn the_same_temperature_is_the_same_number_in_every_member() {
    let folder = of_everything();
    for unit in ["degC", "K", "degF", "degR"] {
        let run = format!("run gearbox.toml --temperature-unit {unit}");
        let value = folder.json(&run).json();
        let last = value["rows"].as_array().unwrap().last().unwrap();
        let (headers, rows) = common::csv(&folder.read("out/gearbox/result.csv"));
        let column =
            headers.iter().position(|header| *header == format!("steel.T [{unit}]")).unwrap();
        let steel = last[column].as_f64().unwrap();
        assert_eq!(value["columns"][column]["unit"], unit);
        assert_eq!(rows.last().unwrap()[column].to_bits(), steel.to_bits());
        let same = |found: &Value| {
            assert_eq!(found["unit"], unit, "{found}");
            assert!((found["value"].as_f64().unwrap() - steel).abs() < 1e-9, "{found} {steel}");
        };
        same(&value["windows"]["late"]["columns"]["steel.T"]["max"]);
        same(&value["limits"]["hot"]["worst"]);
        let limit = &value["limits"]["hot"];
        let number = |of: &Value| of["value"].as_f64().unwrap();
        let margin = number(&limit["below"]) - number(&limit["worst"]);
        assert!((number(&limit["margin"]) - margin).abs() < 1e-9, "{limit}");
        // files of results do not follow: they are in K
        let manifest: Value =
            serde_json::from_str(&folder.read("out/gearbox/manifest.json")).unwrap();
        assert_eq!(
            manifest["limits"]["hot"]["below"],
            serde_json::json!({ "value": 363.15, "unit": "K" })
        );
        let steady = folder.json(&format!("steady gearbox.toml --temperature-unit {unit}")).json();
        let settled = &steady["values"]["steel.T"];
        assert_eq!(
            (settled["unit"].as_str(), settled),
            (Some(unit), &steady["limits"]["hot"]["worst"])
        );
    }
}
