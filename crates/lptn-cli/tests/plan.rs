//! `lptn plan`, as a user meets it.

use crate::common;

use common::Folder;

/// One body, 0.3 K/W and 2659 J/K: 797.7 s. Rows at 0, 5 .. 1800 s, noise of 0.1 K. The sum of the
/// squares of 0.3 (1 - exp(-t / 797.7)) over k rows, and 0.1 over its root, follow in closed form.
const BODY: &str = "format = 1\n[param]\nP = \"220.6 W\"\nR = \"0.3 K/W\"\nC = \"2659 J/K\"\n\
    [node]\nbody = { C = \"C\", T0 = \"25 degC\" }\n[boundary]\nroom = { T = \"25 degC\" }\n\
    [resistor]\nskin = { from = \"body\", to = \"room\", R = \"R\" }\n\
    [source]\nheat = { into = \"body\", P = \"P\" }\n[plan.power]\nknow = { P = \"0.02 %\" }\n\
    place = { ring = { of = \"body.T\", noise = \"0.1 K\" } }\nevery = \"5 s\"\n\
    duration = \"30 min\"\nrun = { hot = {}, cold = { set = { P = \"50 W\" } } }\n";

fn error(rows: u32) -> f64 {
    let slope = |k: u32| 0.3 * -f64::exp_m1(-5.0 * f64::from(k) / 797.7);
    0.1 / (0..rows).map(|k| slope(k).powi(2)).sum::<f64>().sqrt()
}

fn body() -> Folder {
    Folder::with("body.toml", &BODY.replace(", cold = { set = { P = \"50 W\" } }", ""))
}

#[test]
fn the_answer_says_where_and_how_long() {
    let folder = body();
    let ran = folder.run(&["plan", "body.toml"]).exits(0);
    let rows = (2..=361).find(|&rows| error(rows) <= 2e-4 * 220.6).expect("it is reached");
    ran.prints("plan power: know P to 0.02 %").prints("measure ring and run hot for");
    let json = folder.json("plan body.toml").exits(0).json();
    let plan = &json["plan"];
    assert_eq!((&plan["places"][0], &plan["runs"][0]["run"]), (&"ring".into(), &"hot".into()));
    assert_eq!(plan["runs"][0]["samples"], rows);
    let found = plan["standard_errors"]["P"]["value"].as_f64().expect("a number");
    assert!((found / error(rows) - 1.0).abs() < 1e-8);
    assert_eq!((&json["reached"], &json["gradient"]), (&true.into(), &"exact".into()));
}

/// What is to be found cannot be set by a run; a budget that has room for nothing says so.
#[test]
fn what_cannot_be_planned_is_said() {
    let folder = Folder::with("body.toml", BODY);
    folder.run(&["plan", "body.toml"]).exits(2).says("netlist::plan_set_and_sought");
    let poor =
        BODY.replace(", cold = { set = { P = \"50 W\" } }", "") + "budget = 5\ncost.run = 6\n";
    let ran = Folder::with("body.toml", &poor).run(&["plan", "body.toml"]).exits(1);
    ran.prints("the budget of 5 has room for no run");
    let none = BODY.split("[plan").next().expect("a network");
    let folder = Folder::with("body.toml", none);
    folder.run(&["plan", "body.toml"]).exits(2).says("plan::no_study");
    let no_run = BODY
        .replace("run = { hot = {}, cold = { set = { P = \"50 W\" } } }\n", "")
        .replace("of = \"body.T\"", "of = \"R * 1 [W] + body.T\"");
    let ran = Folder::with("body.toml", &no_run).run(&["plan", "body.toml"]).exits(2);
    ran.says("fit::not_linear");
}

/// One step of unknown power does not tell P, R and C apart; with a `±` of C it tells P as well as
/// C is known, and not better.
#[test]
fn what_no_record_tells_is_the_last_line() {
    let unknown = BODY
        .replace(
            "run = { hot = {}, cold = { set = { P = \"50 W\" } } }\n",
            "vary = [\"R\", \"C\"]\n",
        )
        .replace("0.02 %", "2 %");
    let folder = Folder::with("body.toml", &unknown);
    let ran = folder.run(&["plan", "body.toml"]).exits(1);
    ran.prints("not determined by any of the runs").prints("only P R");
    let ran = folder.run(&["plan", "body.toml", "--set", "C=2659 ± 265.9 J/K"]).exits(1);
    ran.prints("P is known to 10 %, but 2 % is wanted");
    let known = folder.json("plan body.toml --set C=2659±265.9J/K").exits(1).json();
    let verdict = known["verdict"].as_str().unwrap_or_default();
    assert!(verdict.contains("longer runs do not lead below 10 %: 100 % of the variance"));
    assert_eq!(known["plan"]["most_by"]["P"]["of"], "C");
    folder.run(&["plan", "body.toml", "--set", "C=2659 ± 26.59 J/K"]).exits(0);
}

#[test]
fn errors_over_time_are_rows_and_a_picture() {
    let folder = body();
    let ran = folder.run(&["plan", "body.toml", "--format", "csv"]).exits(0);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[0], "t [s],P [W]");
    let last: Vec<f64> = lines[lines.len() - 1].split(',').flat_map(str::parse).collect();
    assert!((last[0] - 1800.0).abs() < 1e-9 && (last[1] / error(361) - 1.0).abs() < 1e-6);
    folder.run(&["plan", "body.toml", "--plot", "power.svg"]).exits(0);
    let svg = folder.read("power.svg");
    assert!(svg.contains("error / wanted error") && svg.contains("enough"));
}

/// Records that are there already count: two of them leave the same error as both runs planned.
#[test]
fn records_that_are_there_already_count() {
    let mut csv = String::from("t [s],ring [degC]\n");
    let mut noise = 0.1;
    for k in 0..361 {
        let t = 5.0 * f64::from(k);
        // as even as noise of 0.1 K can be
        noise = -noise;
        csv += &format!("{t},{}\n", 25.0 - 66.18 * f64::exp_m1(-t / 797.7) + noise);
    }
    let fitted = BODY.replace(", cold = { set = { P = \"50 W\" } }", "")
        + "given = [\"first\"]\n[fit.first]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\n\
           sigma = \"0.1 K\"\nvary = [\"P\"]\n";
    let folder = Folder::with("body.toml", &fitted);
    folder.write("r.csv", &csv);
    let json = folder.json("plan body.toml").exits(0).json();
    let known = json["known"]["P"]["value"].as_f64().expect("a number");
    assert!((known / error(361) - 1.0).abs() < 0.02, "{known} is not {}", error(361));
    assert_eq!(json["plan"]["runs"].as_array().map(Vec::len), Some(0));
}

/// What the fit of records that are there warns of was lost: a start that is 10 K off, and a fit that
/// does not tell its parameters apart.
#[test]
fn what_a_given_fit_warns_of_is_said() {
    let row = |k: u32| {
        let t = 5.0 * f64::from(k);
        format!("{t},{:.6}\n", 25.0 + 220.6 * 0.3 * -f64::exp_m1(-t / 797.7))
    };
    let csv: String = "t [s],ring [degC]\n".to_owned() + &(0..361).map(row).collect::<String>();
    let says = |text: &str, vary: &str| {
        let plan = BODY
            .replace(", cold = { set = { P = \"50 W\" } }", "")
            .replace("T0 = \"25", text)
            + "given = [\"first\"]\n[fit.first]\ndata = \"r.csv\"\ncolumn = { ring = \"body.T\" }\n\
               sigma = \"0.1 K\"\nvary = "
            + vary;
        let folder = Folder::with("body.toml", &plan);
        folder.write("r.csv", &csv);
        folder.run(&["plan", "body.toml"])
    };
    let ran = says("T0 = \"35", "[\"P\", \"C\"]").says("fit::misfit");
    ran.says("fit `first`, whose records are there: the model does not describe column `ring`");
    let ran = says("T0 = \"25", "[\"P\", \"R\", \"C\"]").exits(1).says("plan::given_open");
    ran.says("not determined: only P R and R C are determined");
}
