//! `lptn sweep`: rows against closed forms, the same bytes whatever happens on the way.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// One node of 1000 J/K at 20 degC, heated by P through a constant: T = T_air + P/G (1 - exp(-t/tau))
/// with tau = C/G.
const NODE: &str = r#"
format = 1

[param]
P = "100 W"
G = "5 W/K"
share = 0.5

[node]
block = { T0 = "20 degC", C = "1 kJ/K" }

[boundary]
air = { T = "20 degC" }

[resistor]
skin = { from = "block", to = "air", G = "G" }

[source]
loss = { into = "block", P = "P" }

[run]
stop = "400 s"
tolerance = "1e-7 K"

[sweep.steady]
method = "grid"
axes = { P = ["50 W", "100 W"], G = { from = "2 W/K", to = "8 W/K", steps = 2 } }
report = { T = "block.T", Q = "skin.Q", half = "share * P" }

[sweep.course]
method = "list"
over = "run"
axes = { G = ["2 W/K", "5 W/K"], P = ["50 W", "100 W"] }

[sweep.course.report]
top = "max(block.T)"
low = "min(block.T)"
end = "last(block.T - air.T)"
mean = "mean(block.T)"
lost = "integral(skin.Q)"
over = "time_over(block.T, 30 [degC])"
under = "time_under(block.T, 30 [degC])"
life = "life(block.T, 1000 [h], 20 [degC], 0.5 [eV])"

[sweep.lost]
method = "list"
over = "steady"
axes = { G = ["2 W/K", "-1 W/K", "5 W/K"] }
report = { T = "block.T" }

[sweep.sampled]
method = "latin_hypercube"
samples = 40
seed = 3
over = "run"
axes = { G = { from = "1 W/K", to = "100 W/K", scale = "log" }, P = { from = "10 W", to = "20 W" } }
report = { T = "last(block.T)" }
"#;

/// The numbers of the rows, a cell without one as NaN.
fn rows(csv: &str) -> Vec<Vec<f64>> {
    let number = |cell: &str| cell.parse().unwrap_or(f64::NAN);
    csv.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

fn csv(folder: &Folder, name: &str, more: &[&str]) -> String {
    let command = ["sweep", "node.toml", name, "--no-files", "--format", "csv"];
    folder.run(&[&command, more].concat()).exits(0).out
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

#[test]
fn steady_states_of_a_grid() {
    let folder = Folder::with("node.toml", NODE);
    let out = csv(&folder, "steady", &[]);
    let heading = "case [-],P [W],G [W/K],T [degC],Q [W],half [W],failed";
    assert_eq!(out.lines().next().unwrap(), heading);
    let expected =
        [(50.0, 2.0), (50.0, 5.0), (50.0, 8.0), (100.0, 2.0), (100.0, 5.0), (100.0, 8.0)];
    for (case, (row, (p, g))) in rows(&out).iter().zip(expected).enumerate() {
        assert_eq!(row[..3], [case as f64 + 1.0, p, g]);
        near(row[3], 20.0 + p / g, 1e-12);
        near(row[4], p, 1e-12);
        near(row[5], 0.5 * p, 1e-15);
    }
    // what does not vary can be set
    let set = rows(&csv(&folder, "steady", &["--set", "share=0.25"]));
    near(set[5][5], 25.0, 1e-15);
}

#[test]
fn functionals_of_an_exponential() {
    let folder = Folder::with("node.toml", NODE);
    let rows = rows(&csv(&folder, "course", &[]));
    // SciPy's quad over 1/400 exp(0.5 eV/k (1/293.15 - 1/T)) along the closed form, epsrel 1e-12
    let life_hours = [582.504_047_768_306_7, 460.057_514_237_098_5];
    for (row, ((g, p), hours)) in
        rows.iter().zip([(2.0, 50.0), (5.0, 100.0)].into_iter().zip(life_hours))
    {
        let (rise, tau, stop): (f64, f64, f64) = (p / g, 1000.0 / g, 400.0);
        let left = (-stop / tau).exp();
        let mean = rise * (1.0 - tau / stop * (1.0 - left));
        let reached = -tau * (1.0 - 10.0 / rise).ln();
        near(row[3], 20.0 + rise * (1.0 - left), 1e-8);
        near(row[4], 20.0, 1e-12);
        near(row[5], rise * (1.0 - left), 1e-8);
        near(row[6], 20.0 + mean, 1e-8);
        near(row[7], g * mean * stop, 1e-7);
        near(row[8], stop - reached, 1e-7);
        near(row[9], reached, 1e-7);
        near(row[10], hours * 3600.0, 1e-7);
    }
}

#[test]
fn a_candidate_that_fails_is_a_row_with_its_code() {
    let folder = Folder::with("node.toml", NODE);
    let out = csv(&folder, "lost", &[]);
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[1..], ["1,2,70,", "2,-1,,network::not_positive", "3,5,40,"]);
    let ran = folder.run(&["sweep", "node.toml", "lost"]).exits(0);
    ran.prints("1 candidate failed with network::not_positive, the first is case 2");
    let all = NODE.replace(r#"["2 W/K", "-1 W/K", "5 W/K"]"#, r#"["-1 W/K"]"#);
    folder.write("all.toml", &all);
    folder.run(&["sweep", "all.toml", "lost"]).exits(3).says("every candidate failed");
}

#[test]
fn samples_fill_their_ranges() {
    let folder = Folder::with("node.toml", NODE);
    let rows = rows(&csv(&folder, "sampled", &[]));
    for (axis, share) in
        [(1, (|g: f64| g.log10() / 2.0) as fn(f64) -> f64), (2, |p| p / 10.0 - 1.0)]
    {
        let mut held = [0; 40];
        rows.iter().for_each(|row| held[(share(row[axis]) * 40.0) as usize] += 1);
        assert_eq!(held, [1; 40], "axis {axis}");
    }
    for row in rows {
        near(row[3], 20.0 + row[2] / row[1] * (1.0 - (-0.4 * row[1]).exp()), 1e-7);
    }
}

#[test]
fn the_bytes_do_not_depend_on_threads() {
    let folder = Folder::with("node.toml", NODE);
    for name in ["steady", "course", "sampled"] {
        let one = csv(&folder, name, &["--threads", "1"]);
        assert_eq!(csv(&folder, name, &["--threads", "2"]), one);
        assert_eq!(csv(&folder, name, &["--threads", "7"]), one);
    }
}

#[test]
fn parts_are_joined_to_the_bytes_of_one_process() {
    let folder = Folder::with("node.toml", NODE);
    let whole = csv(&folder, "sampled", &[]);
    for part in ["1/3", "2/3", "3/3"] {
        folder.run(&["sweep", "node.toml", "sampled", "-o", "parts", "--shard", part]).exits(0);
    }
    folder.run(&["sweep", "merge", "parts"]).exits(0).says("joined 3 parts, 40 candidates");
    assert_eq!(folder.read("parts/sweep.csv"), whole);
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("parts/manifest.json")).unwrap();
    assert_eq!(manifest["sweep"]["last"], 40);
    assert_eq!(manifest["inputs"][0]["name"], "node.toml");
}

#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let folder = Folder::with("node.toml", NODE);
    let part = |part: &str, more: &[&str]| {
        let command = ["sweep", "node.toml", "sampled", "-o", "parts", "--shard", part];
        folder.run(&[&command, more].concat()).exits(0);
    };
    let merge = |code: &str| {
        folder.run(&["sweep", "merge", "parts"]).exits(2).says(code);
    };
    std::fs::create_dir(folder.path().join("parts")).unwrap();
    merge("sweep::no_parts");
    part("1/3", &[]);
    part("3/3", &[]);
    merge("sweep::gap");
    part("2/3", &["--set", "share=0.25"]);
    merge("sweep::mixed_parts");
    std::fs::remove_dir_all(folder.path().join("parts/part-2-of-3")).unwrap();
    part("2/3", &[]);
    part("1/2", &[]);
    merge("sweep::double");
    std::fs::remove_dir_all(folder.path().join("parts/part-1-of-2")).unwrap();
    let rows = folder.read("parts/part-2-of-3/sweep.csv").replace("14,", "15,");
    folder.write("parts/part-2-of-3/sweep.csv", &rows);
    merge("sweep::part_changed");
    folder.write("parts/part-2-of-3/sweep.csv.part", "case");
    merge("sweep::part_unfinished");
}

#[test]
fn jobs_name_the_command_of_a_part() {
    let folder = Folder::with("node.toml", NODE);
    let plan = |kind: &str| {
        let words =
            ["sweep", "plan", "node.toml", "sampled", kind, "--shards", "4", "--set", "P=7W"];
        folder.run(&words).exits(0).out
    };
    let slurm = plan("--slurm");
    assert!(slurm.contains("#SBATCH --array=1-4") && slurm.contains("--shard auto"), "{slurm}");
    assert!(
        slurm.contains("lptn sweep node.toml sampled --set 'P=7W' -o out/node/sampled --resume")
    );
    let tasks = plan("--hyperqueue");
    assert!(tasks.contains("--array 1-4") && tasks.contains("$HQ_TASK_ID/4"), "{tasks}");
}

#[test]
fn a_task_of_a_job_array_knows_its_part() {
    let folder = Folder::with("node.toml", NODE);
    let mut command =
        folder.command(&["sweep", "node.toml", "sampled", "--shard", "auto", "-o", "parts"]);
    command.envs([
        ("SLURM_ARRAY_TASK_ID", "2"),
        ("SLURM_ARRAY_TASK_COUNT", "4"),
        ("SLURM_ARRAY_TASK_MIN", "1"),
        ("SLURM_ARRAY_TASK_MAX", "4"),
    ]);
    common::Ran::of(command.output().unwrap()).exits(0);
    let rows = rows(&folder.read("parts/part-2-of-4/sweep.csv"));
    assert_eq!((rows[0][0], rows.len()), (11.0, 10));
    folder.run(&["sweep", "node.toml", "sampled", "--shard", "auto"]).exits(2);
}

#[test]
fn json_has_the_rows_and_the_extremes() {
    let folder = Folder::with("node.toml", NODE);
    for more in [&["--no-files"][..], &[]] {
        let command = ["sweep", "node.toml", "lost", "--format", "json"];
        let json = folder.run(&[&command, more].concat()).exits(0).json();
        assert_eq!(json["rows"][0], serde_json::json!([1, 2.0, 70.0, null]));
        let lost = serde_json::json!([2, -1.0, null, "network::not_positive"]);
        assert_eq!(json["rows"][1], lost);
        assert_eq!(json["failed"]["network::not_positive"], 1);
        assert_eq!(json["extremes"]["T"]["largest"]["case"], 1);
        assert_eq!(json["columns"][2], serde_json::json!({ "name": "T", "unit": "degC" }));
    }
}

#[test]
fn inputs_that_change_have_no_steady_state() {
    let text = NODE.replace(r#"P = "P" }"#, r#"P = "P * if(t < 5 [s], 1, 2)" }"#);
    let folder = Folder::with("node.toml", &text);
    folder.run(&["sweep", "node.toml", "steady"]).exits(2).says("sweep::inputs_change");
}

/// A value that the axes replace is a warning, other values are not.
#[test]
fn a_given_value_that_an_axis_replaces_is_a_warning() {
    let folder = Folder::with("node.toml", NODE);
    let sweep = |set: &str| folder.run(&["sweep", "node.toml", "steady", "--set", set]).exits(0);
    sweep("G=3W/K").says("sweep::replaced").says("`G` has no effect: [sweep.steady] varies it");
    let other = sweep("share=0.4");
    assert!(!other.err.contains("sweep::replaced"), "{}", other.err);
    let json = folder.json("sweep node.toml steady --no-files --set G=3W/K").json();
    assert_eq!(json["warnings"][0]["code"], "sweep::replaced");
}

/// A power that is on for half of a cycle: with h = (half a cycle) G/C the top of the settled cycle
/// is T_air + P/G (1 - exp(-h)) / (1 - exp(-2 h)), and the least exp(-h) of that rise.
#[test]
fn settled_cycles_of_a_duty() {
    let text = NODE
        .replace(r#"P = "P" }"#, r#"P = "P * duty" }"#)
        .replace("[sweep.steady]", "[sweep.cycle]\nover = \"periodic\"")
        .replace(
            r#"report = { T = "block.T", Q = "skin.Q", half = "share * P" }"#,
            r#"report = { top = "max(block.T)", low = "min(block.T)", mean = "mean(block.T)" }"#,
        );
    let duty = "[signal]\nduty = { t = [\"0 s\", \"100 s\", \"200 s\"], v = [1, 0, 1], interp = \"previous\", \
                after_end = \"repeat\" }\n\n[sweep.cycle]";
    let folder = Folder::with("node.toml", &text.replacen("[sweep.cycle]", duty, 1));
    for row in rows(&csv(&folder, "cycle", &[])) {
        let (p, g) = (row[1], row[2]);
        let (h, rise) = (0.1 * g, p / g);
        let top = rise * (1.0 - (-h).exp()) / (1.0 - (-2.0 * h).exp());
        near(row[3], 20.0 + top, 1e-8);
        near(row[4], 20.0 + top * (-h).exp(), 1e-8);
        near(row[5], 20.0 + 0.5 * rise, 1e-8);
    }
    let uneven = text.replace("P * duty", "P * t / 1 [s]");
    folder.write("uneven.toml", &uneven);
    let ran = folder.run(&["sweep", "uneven.toml", "cycle", "--no-files"]);
    ran.exits(2).says("sweep::no_period");
}
