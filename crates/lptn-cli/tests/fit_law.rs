//! `lptn fit law`: numbers are those of `crates/lptn-study/tests/law.rs`, which has them from SciPy
//! and closed forms.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::common;

use common::{Folder, Ran};

const POINTS: &str = "\
# the paper's form
omega [rpm],P [W],P_sd [W],dT [K],t_RC [min],remark
1000,9.4,0.5,2.7,13.1,first
1000,8.1,0.5,2.4,13.8,
2000,26.9,0.6,7.9,13.6,
2000,28.6,0.6,8.5,13.2,
3000,54.2,0.8,16.2,13.4,
3000,53.0,0.8,16.0,13.9,
4000,90.1,1.2,26.9,13.3,
4000,86.5,1.2,26.2,13.5,
5000,127.3,1.8,38.7,13.6,
5000,126.0,1.8,38.0,13.1,
6000,171.9,2.5,51.6,13.4,
6000,175.2,2.5,52.9,13.7,
7000,225.0,3.0,67.9,13.2,
7000,221.4,3.0,66.5,13.6,
";

/// Without rise and time constant.
fn plain() -> String {
    let cells = |line: &str| line.split(',').take(2).collect::<Vec<_>>().join(",") + "\n";
    POINTS.lines().filter(|line| !line.starts_with('#')).map(cells).collect()
}

fn paper(extra: &[&str]) -> Ran {
    let laws = [
        "--dT",
        "0.0084 ± 0.0011 K/rpm",
        "--t_RC",
        "18.6 ± 3.8 min",
        "--P",
        "87 ± 15 uW/rpm^(5/3)",
    ];
    let mut arguments = vec!["fit", "law"];
    arguments.extend(laws);
    arguments.extend(["--capacity", "2659 J/K", "--over", "1000 rpm to 7000 rpm"]);
    arguments.extend(extra);
    Folder::empty().run(&arguments)
}

#[track_caller]
fn fits_a_terminal(text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn points_choose_their_law() {
    let ran = Folder::with("points.csv", &plain()).run(&["fit", "law", "points.csv"]).exits(0);
    fits_a_terminal(&ran.out);
    let ran = ran.prints("omega^(5/3) is best: the next, omega^n, is 3.2 AICc behind");
    let ran =
        ran.prints("14 points at 1000 .. 7000 rpm, unweighted").prints("87.19 ± 0.27 uW/rpm^(5/3)");
    let ran = ran.prints("n = 1.672 ± 0.014").prints("negative");
    // SciPy: HC2 with 5.27 degrees of freedom, where Student's t alone gives ± 0.58
    let ran = ran.prints("95 %      omega^(5/3): 87.19 ± 0.89 uW/rpm^(5/3)");
    assert!(!ran.out.contains("agree?"), "{}", ran.out);
}

#[test]
fn weights_come_from_the_column_of_errors() {
    let folder = Folder::with("points.csv", POINTS);
    let ran = folder.run(&["fit", "law", "points.csv", "--format", "json"]);
    let json = ran.json();
    assert_eq!(json["weighted"], true);
    let best = &json["laws"][0];
    assert_eq!(best["law"], "omega^(5/3)");
    assert!((best["chi_squared"].as_f64().unwrap() - 17.643455106910523).abs() < 1e-8);
    assert_eq!(best["rmse"]["unit"], "W");
    let unweighted =
        folder.run(&["fit", "law", "points.csv", "--unweighted", "--format", "json"]).json();
    assert_eq!(unweighted["weighted"], false);
    let rmse = unweighted["laws"][0]["rmse"]["value"].as_f64().unwrap();
    assert!((rmse - 1.3795021574440414).abs() < 1e-9);
}

/// Rise and time constant of these points imply another exponent than the power (p = 0.027).
#[test]
fn rise_and_time_constant_are_compared_with_the_power() {
    let folder = Folder::with("points.csv", POINTS);
    let ran = folder.run(&["fit", "law", "points.csv", "--capacity", "2659 J/K"]).exits(1);
    fits_a_terminal(&ran.out);
    let ran = ran
        .prints("Do dT, t_RC and P agree?")
        .prints("refuted")
        .prints("contradiction: dT and t_RC imply");
    let last = ran.out.lines().last().unwrap();
    assert!(last.contains("7000 rpm"), "{last}");
    let json = folder
        .run(&["fit", "law", "points.csv", "--format", "json"])
        .exits(1)
        .says("contradiction");
    let found = &json.json()["consistency"];
    assert!(
        (found["exponents"]["test"]["probability"].as_f64().unwrap() - 0.02712706774086985).abs()
            < 1e-6
    );
    assert_eq!(found["agrees"], false);
    assert!(found["level"].is_null());
}

/// 20, 70 and 140 W against 8.7, 70.2 and 222.9 W; 43 and 11.7 min: 2659 J/K x 0.0084 K/rpm n /
/// 18.6 min, against 87 uW/rpm^(5/3) n^(5/3).
#[test]
fn the_papers_fits_contradict_each_other() {
    let ran = paper(&[]).exits(1);
    fits_a_terminal(&ran.out);
    let ran = ran
        .prints("20.0")
        .prints("140.1")
        .prints("8.7")
        .prints("222.9")
        .prints("42.8")
        .prints("11.7");
    let flat = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat.ends_with(
            "contradiction: dT and t_RC imply a power that goes with omega, not omega^(1.67); all \
             three agree only if t_RC goes with omega^(-0.67): 42.8 min at 1000 rpm and 11.7 min \
             at 7000 rpm"
        ),
        "{flat}"
    );
    let json = paper(&["--format", "json"]).exits(1).says("contradiction").json();
    let found = &json["consistency"];
    assert!((found["exponents"]["P_implied"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    assert!(
        (found["at"][2]["P"]["value"].as_f64().unwrap() - 87e-6 * 7000_f64.powf(5.0 / 3.0)).abs()
            < 1e-9
    );
    let csv = paper(&["--format", "csv"]).exits(1);
    assert!(
        csv.out.starts_with("omega [rpm],dT [K],t_RC [s],P_implied [W],P [W],t_RC_needed [s]\n"),
        "{}",
        csv.out
    );
}

#[test]
fn laws_that_agree_exit_with_0() {
    let laws = [
        "--dT",
        "26.499 uK/rpm^(5/3)",
        "--t_RC",
        "809.9 s",
        "--P",
        "87 [uW/rpm^(5/3)] * omega^(5/3)",
    ];
    let mut arguments = vec!["fit", "law"];
    arguments.extend(laws);
    arguments.extend(["--capacity", "2659 J/K ± 5 %", "--over", "1000 rpm to 7000 rpm"]);
    Folder::empty().run(&arguments).exits(0).prints("dT, t_RC and P agree");
}

#[test]
fn a_users_law_stands_among_the_others() {
    let folder = Folder::with("points.csv", &plain());
    let law = "a * omega * exp(omega / b)";
    let ran = folder.run(&["fit", "law", "points.csv", "--law", law]).exits(0);
    fits_a_terminal(&ran.out);
    ran.prints("b = 7366 ± 450 rpm").prints("4.12");
    let start = ["--start", "b = 7000 rpm"];
    let ran = folder.run(&[
        "fit",
        "law",
        "points.csv",
        "--law",
        law,
        start[0],
        start[1],
        "--format",
        "csv",
    ]);
    assert!(ran.exits(0).out.contains("a * omega * exp(omega / b),b,rad/s,"));
}

/// No parameter is printed as if it had been found.
#[test]
fn a_law_that_cannot_be_fitted_exits_with_3() {
    let folder = Folder::with("points.csv", &plain());
    let law = ["--law", "a * ln(omega / b)", "--start", "a = 1 W", "--start", "b = -1 rpm"];
    let ran = folder
        .run(&[&["fit", "law", "points.csv"][..], &law].concat())
        .exits(3)
        .says("failed: `a * ln");
    assert!(!ran.out.contains("b = "), "{}", ran.out);
    // two coefficients that only their product tells of
    let law = ["--law", "a * b * omega", "--start", "a = 20 mW/rpm"];
    folder
        .run(&[&["fit", "law", "points.csv"][..], &law].concat())
        .exits(3)
        .says("do not determine");
}

#[test]
fn mistakes_are_shown_where_they_stand() {
    let folder = Folder::with("points.csv", &plain());
    let law = |law: &str, rest: &[&str]| {
        let mut arguments = vec!["fit", "law", "points.csv", "--law", law];
        arguments.extend(rest);
        folder.run(&arguments).exits(2)
    };
    law("3 [K] + a * omega", &[]).says("units::operands");
    law("a * b * omega", &[]).says("fit::law_open_unit").says("--start \"a = 20 mW/rpm\"");
    law("a * omega", &["--start", "alpha = 20 mW/rpm"]).says("fit::law_start");
    law("a * omega", &["--start", "a"]).says("write for example");
    folder
        .run(&["fit", "law", "points.csv", "--speed", "omgea"])
        .exits(2)
        .says("did you mean `omega`?");
    folder.run(&["fit", "law", "points.csv", "--power", "omega"]).exits(2).says("record::unit");
    folder
        .run(&["fit", "law", "points.csv", "--capacity", "0 J/K"])
        .exits(2)
        .says("fit::law_capacity");
    folder.run(&["fit", "law", "no.csv"]).exits(2).says("cannot read");
    folder.run(&["fit", "law"]).exits(2);
    let paper = [
        "fit",
        "law",
        "--dT",
        "0.0084 W/rpm",
        "--t_RC",
        "1 min",
        "--P",
        "1 W",
        "--over",
        "1 rpm to 2 rpm",
    ];
    folder.run(&paper).exits(2).says("fit::law_dimension");
    let paper = [
        "fit",
        "law",
        "--dT",
        "0.0084 K/rpm",
        "--t_RC",
        "1 min",
        "--P",
        "1 W",
        "--over",
        "7000 rpm",
    ];
    folder.run(&paper).exits(2).says("fit::law_range");
}

#[test]
fn points_are_read_with_their_mistakes() {
    let bad = |text: &str| Folder::with("p.csv", text).run(&["fit", "law", "p.csv"]);
    bad("omega [rpm],P\n1,2\n").exits(2).says("record::no_unit");
    bad("omega [rpm],P [W]\n1,2\n3\n").exits(2).says("record::short_row");
    bad("omega [rpm],P [W]\n1,two\n").exits(2).says("record::not_a_number");
    bad("omega [Hz],P [W]\n1,2\n").exits(2).says("fit::law_column");
    bad("a [rpm],b [rpm],P [W]\n1,2,3\n").exits(2).says("--speed a");
    bad("omega [rpm],P [W]\n0,2\n1,3\n").exits(2).says("fit::law_speed").says("p.csv:2");
    bad("omega [rpm],P [W]\n").exits(2).says("record::no_rows");
    bad("omega [rpm];P [W]\n1,2\n").exits(2).says("record::separator");
    let gap = bad("omega [rpm],P [W]\n1,2\n2,\n3,6\n").exits(0);
    gap.says("1 of 3 rows have gaps").prints("2 points are too few to choose a law");
}

/// Standard errors in percent are not left out silently.
#[test]
fn errors_in_another_kind_of_unit_are_refused() {
    for header in ["P_sd [%]", "P_sd [1]", "P_sd [K]", "P_std [%]", "P ± [%]", "P_err [s]"] {
        let text = POINTS.replace("P_sd [W]", header);
        let folder = Folder::with("points.csv", &text);
        let ran = folder.run(&["fit", "law", "points.csv"]).exits(2).says("record::unit");
        ran.says("give the standard errors of `P` in W, or use --unweighted");
        folder.run(&["fit", "law", "points.csv", "--unweighted"]).prints("unweighted");
    }
}

/// Revolutions in `1/min` are a frequency for lptn; the help is the option that reads them.
#[test]
fn a_speed_in_revolutions_names_its_option() {
    let folder = Folder::with("law.csv", "n [1/min],P [W]\n1000,2\n2000,4\n3000,6\n4000,8\n");
    let ran = folder.run(&["fit", "law", "law.csv", "--no-files"]).exits(2);
    ran.says("fit::law_column").says("--unit n=rpm");
    folder
        .run(&["fit", "law", "law.csv", "--no-files", "--speed", "n"])
        .exits(2)
        .says("--unit n=rpm");
    folder.run(&["fit", "law", "law.csv", "--no-files", "--unit", "n=rpm"]).exits(0);
}
