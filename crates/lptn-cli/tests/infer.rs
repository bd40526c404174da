//! `lptn infer`: a heated body of which a closed form made the record.
#![allow(clippy::unwrap_used, reason = "a test may")]

use crate::common;

use std::fmt::Write as _;

use common::{Folder, csv};

/// 150 W, from 10 min on 250 W, on 0.3 K/W and 2659 J/K over 25 degC, every 10 s; the second column
/// reads 2 K too much.
fn record() -> String {
    let tau = 0.3 * 2659.0;
    let mut text = "t [s],ring [degC],lid [degC]\n".to_owned();
    for k in 0..121 {
        let t = 10.0 * f64::from(k);
        let later = (t - 600.0).max(0.0);
        let rise = -45.0 * f64::exp_m1(-t / tau) - 30.0 * f64::exp_m1(-later / tau);
        // noise without a seed: what is left of a golden section
        let noise = |n: f64| 0.1 * ((n * 0.618_033_988_75).fract() - 0.5);
        let own = f64::from(k);
        writeln!(text, "{t},{:.4},{:.4}", 25.0 + rise + noise(own), 27.0 + rise + noise(own + 9.0))
            .unwrap();
    }
    text
}

fn folder(study: &str) -> Folder {
    let text = format!(
        "format = 1\ntitle = \"Body\"\n[signal]\nP = \"100 W\"\n[node]\nbody = {{ C = \"2659 J/K\", T0 = \
         \"25 degC\" }}\n[boundary]\nroom = {{ T = \"25 degC\" }}\n[resistor]\nskin = {{ from = \
         \"body\", to = \"room\", R = \"0.3 K/W\" }}\n[source]\nheat = {{ into = \"body\", P = \"P\" \
         }}\n{study}"
    );
    let folder = Folder::with("body.toml", &text);
    folder.write("record.csv", &record());
    folder
}

const STUDY: &str = "[infer.power]\ndata = \"record.csv\"\ncolumn = { ring = \"body.T\" }\n\
    sigma = \"0.03 K\"\nfind = [\"P\"]\n";
const SAID: &str = "[infer.power]\ndata = \"record.csv\"\ncolumn = { ring = \"body.T\" }\n\
    sigma = \"0.03 K\"\nfind = { P = { change = \"60 W\", within = \"1 min\" } }\n";

#[test]
fn a_power_is_found_before_and_behind_a_step() {
    let folder = folder(STUDY);
    let run = folder.run(&["infer", "body.toml", "-o", "out"]).exits(0);
    assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
    assert!(run.out.contains("P changes (likelihood ratio"), "{}", run.out);
    let (header, rows) = csv(&folder.read("out/inferred.csv"));
    assert_eq!(&header[..4], ["time [s]", "P [W]", "P.low [W]", "P.high [W]"]);
    for (row, expected) in [(30, 150.0), (100, 250.0)] {
        assert!((rows[row][1] - expected).abs() < 8.0, "{:?}", rows[row]);
        assert!(rows[row][2] < expected && expected < rows[row][3], "{:?}", rows[row]);
    }
    let json = folder.run(&["infer", "body.toml", "power", "--format", "json"]).exits(0).json();
    assert_eq!(json["determined"], serde_json::json!(true));
    let between = &json["jumps"][0]["between"];
    assert_eq!((&between[0]["unit"], &between[1]["unit"]), (&"s".into(), &"s".into()));
    let [from, to] = [0, 1].map(|end| between[end]["value"].as_f64().unwrap());
    assert!(from <= 600.0 && 600.0 <= to, "{between}");
    assert!((json["signals"]["P"]["mean"]["value"].as_f64().unwrap() - 200.0).abs() < 3.0);
    assert_eq!(json["moments"]["rows"].as_array().unwrap().len(), 121);
}

#[test]
fn rows_that_come_are_answered_as_the_whole_record_at_its_end() {
    let folder = folder(SAID);
    let whole = folder.run(&["infer", "body.toml", "--format", "csv"]).exits(0);
    let followed = folder.run_with(&["infer", "body.toml", "--follow"], &record()).exits(0);
    let ((_, whole), (header, followed)) = (csv(&whole.out), csv(&followed.out));
    assert_eq!(header.last().unwrap(), "ring.surprise [-]");
    assert_eq!((whole.len(), followed.len()), (121, 121));
    for (a, b) in whole[120].iter().zip(&followed[120]) {
        assert!((a - b).abs() <= 1e-7 * a.abs().max(1.0), "{a} {b}");
    }
}

#[test]
fn what_cannot_be_followed_says_what_to_write() {
    let open = folder(STUDY).run_with(&["infer", "body.toml", "--follow"], &record()).exits(2);
    open.says("infer::smoothness").says("change = \"50 W\"");
    let folder = folder(SAID);
    let follow = |text: &str| folder.run_with(&["infer", "body.toml", "--follow"], text).exits(2);
    follow("").says("record::no_rows");
    follow("t [s],ring [degC]\n0,25\n0,26\n").says("record::time_repeated").says("<stdin>:3:1");
    follow("t [s],ring [degC]\n5,25\n0,26\n").says("record::time_reversed").says("<stdin>:3:1");
    follow("t [s],ring [degC]\n0,25\n5,abc\n").says("record::not_a_number").says("<stdin>:3:3");
    follow("t [s],rung [degC]\n0,25\n").says("ring");
    follow("# bench\nt [s],ring [degC]\n\n0,25\nabc,26\n")
        .says("<stdin>:5:1")
        .says("`#` before it");
    follow("t [s],ring [degC]\n0,25\n5\n10,26\n").says("record::short_row").says("<stdin>:3:1");
    follow("t [s],ring [degC]\n0,25\n").says("infer::short");
    follow("t [s],ring [degC]\n-10,25\n0,25\n").says("fit::record_times").says("<stdin>");
    let text = b"t [s],ring [degC]\n0,25\n5,25 \xb0C\n";
    let latin = |text: &[u8]| folder.run_bytes(&["infer", "body.toml", "--follow"], text).exits(2);
    latin(text).says("netlist::not_text").says("<stdin>:3:6");
    for options in [["--format", "json"], ["--plot", "p.svg"], ["--report", "-q"]] {
        let all = [["infer", "body.toml", "--follow"].as_slice(), &options].concat();
        folder.run_with(&all, &record()).exits(2).says("infer::follow_output").says(options[0]);
    }
}

/// As in a record that is read as a whole.
#[test]
fn gaps_rows_that_stand_twice_and_a_last_row_that_breaks_off_are_followed() {
    let folder = folder(SAID);
    let with = |text: &str| folder.run_with(&["infer", "body.toml", "--follow"], text).exits(0);
    let plain = "t [s],ring [degC]\n0,25\n10,25.5\n20,26\n40,27\n";
    let expected = with(plain).out;
    let twice =
        with("\u{feff}t [s],ring [degC]\r\n0,25\r\n10,25.5\r\n10,25.5\r\n20,26\r\n40,27\r\n");
    assert_eq!(twice.says("record::same_row").says("<stdin>:4:1").out, expected);
    let broken = with(&format!("{plain}5"));
    assert_eq!(broken.says("record::broken_off").says("<stdin>:6:1").out, expected);
    let (_, rows) = csv(&with(&plain.replace("40,", "30,NaN\n40,")).out);
    assert_eq!(rows.len(), 5);
    assert!(rows[3][6].is_nan() && rows[3][3] - rows[3][2] > rows[2][3] - rows[2][2]);
}

/// What is said of `data` is no word about stdin, and what nobody would expect is.
#[test]
fn a_wild_reading_that_comes_is_left_out_where_that_is_asked() {
    let study = SAID.replace("sigma", "outliers = \"drop\"\nsigma");
    let wild = |time: &str| {
        let line = |line: &str| match line.split_once(',') {
            Some((own, _)) if own == time => format!("{own},200,27\n"),
            _ => format!("{line}\n"),
        };
        record().lines().map(line).collect::<String>()
    };
    for (study, done) in [(study.as_str(), "it is left out"), (SAID, "it is taken in")] {
        let folder = folder(study);
        folder.write("record.csv", &wild("600"));
        let run = folder.run_with(&["infer", "body.toml", "--follow"], &wild("300")).exits(0);
        let run = run.says("infer::unexpected").says("<stdin>, line 32").says(done);
        assert!(!run.err.contains("at 600 s"), "{}", run.err);
        let (_, rows) = csv(&run.out);
        assert_eq!((rows[29][1] - rows[31][1]).abs() < 50.0, done == "it is left out");
        assert!(rows[30][6] > 1e3, "{:?}", rows[30]);
    }
}

#[test]
fn a_record_that_begins_before_the_run_is_refused() {
    let folder = folder(STUDY);
    folder.write("record.csv", &record().replace("\n0,", "\n-10,24.9,27\n0,"));
    folder.run(&["infer", "body.toml"]).exits(2).says("fit::record_times").says("set `start`");
}

/// The offset of the only instrument is free, and the start unknown: any power may be.
#[test]
fn an_offset_that_nothing_determines_is_a_verdict() {
    let sensor = "[sensor]\ntc = { offset = \"0 ± 3 K\" }\n";
    let both = STUDY.replace(
        "{ ring = \"body.T\" }",
        "{ ring = \"body.T\", lid = { of = \"body.T\", \
                                                     sensor = \"tc\" } }",
    );
    let run = folder(&format!("{sensor}{both}")).run(&["infer", "body.toml", "--format", "json"]);
    let offset = run.exits(0).json()["sensors"]["tc.offset"]["value"].as_f64().unwrap();
    assert!((offset - 2.0).abs() < 0.02, "{offset}");
    let free = STUDY.replace("\"body.T\"", "{ of = \"body.T\", sensor = \"tc\" }");
    let short = "t [s],ring [degC],lid [degC]\n0,25,27\n1,25.1,27\n2,25.1,27\n";
    let folder =
        folder(&format!("[sensor]\ntc = {{ offset = \"free\" }}\n{free}initial = \"free\"\n"));
    folder.write("record.csv", short);
    folder.run(&["infer", "body.toml"]).exits(1).prints("not determined");
}

/// Two heats into one body warm it by their sum only. The verdict names both, and no other unknown.
#[test]
fn a_verdict_names_what_cannot_be_distinguished() {
    let both = STUDY.replace("find = [\"P\"]", "find = [\"P\", \"Q\"]");
    let more = "[signal.Q]\nt = [\"0 s\", \"1 s\"]\nv = [\"1 W\", \"1 W\"]\nafter_end = \"hold\"\n[source.more]\ninto = \"body\"\nP = \"Q\"\n";
    let text = format!("{both}{more}");
    let run = folder(&text).run(&["infer", "body.toml"]).exits(1);
    let said = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    let verdict = "not determined: the record cannot distinguish `P` from `Q`; find only one of `P` and \
                   `Q`, or measure another node";
    assert!(said.ends_with(verdict), "{said}");
}

/// A walk by 60 W in a minute leaves far more than noise does, and that is an answer: 35.640694 W by
/// the algebraic Riccati equation of temperature and power (SciPy 1.17, `solve_discrete_are`, noise by
/// the exponential of C. F. Van Loan's matrix). A free offset of the only instrument, and one of 300 K
/// (which is 1000 W through 0.3 K/W), leave no answer.
#[test]
fn a_band_that_is_as_wide_as_is_said_is_an_answer() {
    let white = "0.3 K\"\ndrift = \"0 K\"\ndrift_time = \"1 s\"";
    let study = SAID.replace("0.03 K\"", white);
    let run = folder(&study).run(&["infer", "body.toml", "--format", "json"]).exits(0).json();
    let deviation = run["signals"]["P"]["end"]["sd"].as_f64().unwrap();
    assert!((deviation - 35.640_694).abs() < 1e-4, "{deviation}");
    for (offset, code) in [("free", 1), ("0 ± 3 K", 0), ("0 ± 300 K", 1)] {
        let sensor = format!("[sensor]\ntc = {{ offset = \"{offset}\" }}\n");
        let of = SAID.replace("\"body.T\"", "{ of = \"body.T\", sensor = \"tc\" }");
        let folder = folder(&format!("{sensor}{of}initial = \"free\"\n"));
        folder.run(&["infer", "body.toml"]).exits(code);
    }
}

#[test]
fn a_start_that_the_record_contradicts_is_named() {
    let folder = folder(STUDY);
    folder.write("record.csv", &record().replace("\n0,24.9", "\n0,29.9"));
    folder.run(&["infer", "body.toml"]).exits(0).says("infer::start").says("initial = \"free\"");
    folder.run(&["infer", "body.toml", "flow"]).exits(2).says("infer::no_study");
}

/// Noise of which each reading holds 0.15 of the one before: neighbours correlate by
/// 0.15 / (1 + 0.15^2) = 0.147, which is 9 standard deviations of chance in 4000 rows.
#[test]
fn neighbours_that_are_off_together_are_told_where_there_are_many() {
    let mut seed = 1_u64;
    // the sum of twelve even numbers less 6 is as good as normal, with a variance of 1
    let mut noise = || {
        let one = |_| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(one).sum::<f64>() - 6.0
    };
    let (mut last, mut text) = (0.0, "t [s],ring [degC]\n".to_owned());
    for k in 0..4000 {
        let (t, own) = (f64::from(k), noise());
        let rise = -45.0 * f64::exp_m1(-t / (0.3 * 2659.0));
        writeln!(text, "{t},{:.5}", 25.0 + rise + 0.1 * (own + 0.15 * last)).unwrap();
        last = own;
    }
    let study = SAID
        .replace("60 W", "1 W")
        .replace("0.03 K\"", "0.1 K\"\ndrift = \"0 K\"\ndrift_time = \"1 s\"");
    let folder = folder(&study);
    folder.write("record.csv", &text);
    let run = folder.run(&["infer", "body.toml"]).exits(0).says("infer::surprised");
    let run = run.says("neighbours correlate by 0.1").says("than `drift`, ");
    assert!(!run.err.contains("`sigma` is larger"), "{}", run.err);
}

/// Two bodies apart from each other: P = 50 W on one is constant, Q on the other goes from 10 W to
/// 40 W at 600 s. Each has its own ratio, and that of P is at most what chance reaches.
#[test]
fn each_signal_has_its_own_ratio() {
    let tau = 0.3 * 1000.0;
    let mut record = "t [s],one [degC],two [degC]\n".to_owned();
    for k in 0..121 {
        let (t, own) = (10.0 * f64::from(k), f64::from(k));
        let noise = |n: f64| 0.1 * ((n * 0.618_033_988_75).fract() - 0.5);
        let later = (t - 600.0).max(0.0);
        let one = 25.0 - 15.0 * f64::exp_m1(-t / tau) + noise(own);
        let two = 25.0 - 3.0 * f64::exp_m1(-t / tau) - 9.0 * f64::exp_m1(-later / tau);
        writeln!(record, "{t},{one:.4},{:.4}", two + noise(own + 9.0)).unwrap();
    }
    let text = "format = 1\n[signal]\nP = \"50 W\"\nQ = \"10 W\"\n[default]\nT0 = \"25 degC\"\n[node]\n\
        a = { C = \"1 kJ/K\" }\nb = { C = \"1 kJ/K\" }\n[boundary]\nroom = { T = \"25 degC\" }\n[resistor]\n\
        r = { from = \"a\", to = \"room\", R = \"0.3 K/W\" }\ns = { from = \"b\", to = \"room\", R = \"0.3 \
        K/W\" }\n[source]\nh = { into = \"a\", P = \"P\" }\ni = { into = \"b\", P = \"Q\" }\n[infer.both]\n\
        data = \"record.csv\"\ncolumn = { one = \"a.T\", two = \"b.T\" }\nsigma = \"0.03 K\"\n\
        find = [\"P\", \"Q\"]\n";
    let folder = Folder::with("two.toml", text);
    folder.write("record.csv", &record);
    let ran = folder.run(&["infer", "two.toml"]).exits(0);
    let words = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("the record does not show that P changes"), "{}", ran.out);
    assert!(words.contains("Q changes (likelihood ratio"), "{}", ran.out);
    let signals = folder.run(&["infer", "two.toml", "--format", "json"]).exits(0).json();
    let constant = signals["signals"]["P"]["constant"]["value"].as_f64().unwrap();
    assert!((constant - 50.0).abs() < 0.5, "{constant}");
}

/// The body with a core that is heated, and a record with eight rows of a thermocouple out of its
/// range: the core has to be far hotter and colder than the body.
fn out_of_range(rows: &str) -> Folder {
    let folder = folder(STUDY);
    let core = "core = { C = \"500 J/K\", T0 = \"25 degC\" }\nbody = ";
    let fit = "[resistor]\nfit = { from = \"core\", to = \"body\", R = \"0.1 K/W\" }\n";
    let text = folder.read("body.toml").replace("body = ", core).replace("[resistor]\n", fit);
    folder.write("body.toml", &text.replace("into = \"body\"", "into = \"core\""));
    let over = rows.lines().enumerate().map(|(i, line)| match (i, line.split(',').next()) {
        (60..68, Some(t)) => format!("{t},1300,1300\n"),
        _ => format!("{line}\n"),
    });
    folder.write("record.csv", &over.collect::<String>());
    folder
}

/// Rows that no run follows are named, not a node below absolute zero. Left out, they do not
/// matter.
#[test]
fn rows_that_no_run_follows_are_named() {
    let folder = out_of_range(&record());
    let ran = folder.run(&["infer", "body.toml"]);
    let ran = ran.says("record::outlier").says("reads 1300 degC at 590 s and in 7 rows after it");
    assert!(ran.code != Some(0) && ran.err.contains("infer::unfollowed"), "{}", ran.err);
    assert!(ran.err.contains("column `ring`"), "{}", ran.err);
    let dropped = format!("{STUDY}outliers = \"drop\"\n");
    let text = folder.read("body.toml").replace(STUDY, &dropped);
    folder.write("body.toml", &text);
    folder.run(&["infer", "body.toml"]).exits(0).prints("P = ");
}

/// Most values are those of the row before, so the usual change must not be 0. By the closed form
/// the body has 48.25 degC at 580 s.
#[test]
fn rows_that_no_run_follows_are_named_among_rounded_values() {
    let round = |text: &str| match text.parse::<f64>() {
        Ok(degrees) => format!("{:.0}", 5.0 * (degrees / 5.0).round()),
        Err(_) => text.to_owned(),
    };
    let rounded = record().lines().fold(String::new(), |all, line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{all}{},{},{}\n", cells[0], round(cells[1]), round(cells[2]))
    });
    let ran = out_of_range(&rounded).run(&["infer", "body.toml"]);
    assert!(ran.code != Some(0) && ran.err.contains("infer::unfollowed"), "{}", ran.err);
    let words = ran.err.split_whitespace().collect::<Vec<_>>().join(" ");
    let named = "no run follows column `ring` from 50 to 1300 degC, which it reads at 590 s";
    assert!(words.contains(named), "{}", ran.err);
}
