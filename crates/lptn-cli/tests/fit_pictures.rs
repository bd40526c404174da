//! The pictures of the fits: what `--plot` draws is what was measured and fitted.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::picture;

use std::fmt::Write as _;

use common::Folder;
use picture::Picture;

/// A pixel in the file is exact to 0.005, and an axis has some 100 to 600 of them.
const READ: f64 = 2e-4;

#[track_caller]
fn near(found: f64, expected: f64, range: f64) {
    assert!((found - expected).abs() <= READ * range, "{found} is not {expected}");
}

/// Draws, and sees that the same bytes come twice.
fn drawn(folder: &Folder, arguments: &[&str], code: i32) -> Picture {
    let draw = |file: &str| {
        let all = [arguments, &["--plot", file]].concat();
        folder.run(&all).exits(code).says(&format!("wrote  {file}"));
        folder.read(file)
    };
    let first = draw("x.svg");
    assert_eq!(first, draw("y.svg"));
    let text = folder.run(&[arguments, &["--plot", "-", "--quiet"]].concat()).exits(code).out;
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    Picture::read(&first)
}

/// `T = 20 degC + 60 K (1 - exp(-t / 600 s))`, and a ripple that is +-0.1 K in turn.
fn heating(ripple: f64) -> String {
    let mut text = "t [s],ring [degC],<bed> [degC]\n".to_owned();
    for i in 0..=60 {
        let t = 30.0 * f64::from(i);
        let off = if i % 2 == 0 { ripple } else { -ripple };
        let ring = 80.0 - 60.0 * f64::exp(-t / 600.0) + off;
        let bed = 50.0 - 20.0 * f64::exp(-t / 500.0);
        writeln!(text, "{t},{ring:.9},{bed:.9}").unwrap();
    }
    text
}

/// Analytic: the curve of a closed-form exponential is the record, T_f is 80 degC, and what is
/// missed is the ripple.
#[test]
fn analytic_a_step_over_its_exponential_and_what_it_misses() {
    let folder = Folder::with("record.csv", &heating(0.1));
    let picture = drawn(&folder, &["fit", "step", "record.csv"], 0);
    picture.says("time [min]").says("record.csv").says("T_f of ring").says("t_RC 60");
    picture.says("&lt;bed&gt;");
    let (upper, lower) = ("temperature [°C]", "measured \u{2212} fit [K]");
    let dots = picture.dots(upper, "series0");
    // the end of T_f with its interval, and 61 values
    assert_eq!(dots.len(), 62);
    near(dots[0].1, 80.0, 100.0);
    for (i, &(minutes, value)) in dots[1..].iter().enumerate() {
        let off = if i % 2 == 0 { 0.1 } else { -0.1 };
        near(minutes, 0.5 * i as f64, 30.0);
        near(value, 80.0 - 60.0 * f64::exp(-minutes / 10.0) + off, 60.0);
    }
    let lines = picture.lines(upper, "series0");
    let [curve, level] = &lines[..2] else { panic!("{lines:?}") };
    curve.iter().for_each(|&(t, value)| near(value, 80.0 - 60.0 * f64::exp(-t / 10.0), 300.0));
    level.iter().for_each(|&(_, value)| near(value, 80.0, 100.0));
    let missed = picture.dots(lower, "series0");
    assert_eq!(missed.len(), 61);
    for (i, (_, value)) in missed.iter().enumerate().skip(10) {
        let off = if i % 2 == 0 { 0.1 } else { -0.1 };
        assert!((value - off).abs() < 0.02, "{value} at {i}");
    }
}

/// Analytic: without a ripple nothing is missed beyond the rounding of the record.
#[test]
fn analytic_an_exact_exponential_leaves_nothing() {
    let folder = Folder::with("record.csv", &heating(0.0));
    let picture = drawn(&folder, &["fit", "step", "record.csv", "--column", "ring"], 0);
    for (_, value) in picture.dots("measured \u{2212} fit [K]", "series0") {
        assert!(value.abs() < 1e-6, "{value}");
    }
}

/// A column without a fit is still shown, and so is the network it is compared with.
#[test]
fn a_column_without_a_fit_and_a_model_are_drawn() {
    let folder = Folder::with_gearbox();
    let mut text = "t [s],ring [degC],noise [degC]\n".to_owned();
    for i in 0..=50 {
        let (t, noise) = (30.0 * f64::from(i), 20.0 + f64::from(i * 37 % 11));
        writeln!(text, "{t},{:.6},{noise}", 92.7 - 67.2 * f64::exp(-t / 810.0)).unwrap();
    }
    folder.write("record.csv", &text);
    let arguments = ["fit", "step", "record.csv", "--model", "gearbox.toml", "--port", "steel"];
    let picture = drawn(&folder, &arguments, 3);
    picture.says("noise: no fit (fit::undetermined)").says("steel of gearbox");
    assert_eq!(picture.dots("temperature [°C]", "series1").len(), 51);
    let run = folder.run(&["run", "gearbox.toml", "--format", "csv", "--no-files"]).exits(0);
    let (headers, rows) = common::csv(&run.out);
    let steel = headers.iter().position(|name| name.starts_with("steel.T")).unwrap();
    let model = &picture.lines("temperature [°C]", "series2")[0];
    assert_eq!(model.len(), 51);
    for &(minutes, value) in model {
        let row = rows.iter().find(|row| (row[0] - 60.0 * minutes).abs() < 1.0).unwrap();
        near(value, row[steel], 200.0);
    }
}

/// Two records of a body with known parameters: `T = 20 degC + rise (1 - exp(-t / 600 s))` and
/// steps of +-0.1 K; the second leaves out every third value.
fn body() -> Folder {
    let folder = Folder::with(
        "body.toml",
        "format = 1\ntitle = \"Body\"\n\n[param]\nR = \"0.2 K/W\"\nC = \"2 kJ/K\"\n\n[node]\nbody = \
         { C = \"C\", T0 = \"20 degC\" }\n\n[boundary]\nair = { T = \"20 degC\" }\n\n[resistor]\nskin = \
         { from = \"body\", to = \"air\", R = \"R\" }\n\n[source]\nheat = { into = \"body\", P = \
         \"200 W\" }\n\n[fit.heating]\ndata = [{ csv = \"a.csv\" }, { csv = \"b.csv\" }]\ncolumn \
         = { ring = \"body.T\" }\nsigma = \"0.1 K\"\nvary = [\"R\", \"C\"]\n",
    );
    for (name, gaps) in [("a.csv", false), ("b.csv", true)] {
        let mut text = "t [s],ring [degC]\n".to_owned();
        for i in 0..=60 {
            let t = 30.0 * f64::from(i);
            let off = if i % 2 == 0 { 0.1 } else { -0.1 };
            let value = 80.0 - 60.0 * f64::exp(-t / 600.0) + off;
            let cell = if gaps && i % 3 == 1 { String::new() } else { format!("{value:.9}") };
            writeln!(text, "{t},{cell}").unwrap();
        }
        folder.write(name, &text);
    }
    folder
}

/// Analytic: R is 60 K / 200 W and R C is 600 s, so the line is the closed form also where nothing
/// was measured, and what is missed is the ripple, half of 2 sigma.
#[test]
fn analytic_records_over_the_fitted_network() {
    let picture = drawn(&body(), &["fit", "network", "body.toml"], 0);
    let (upper, lower) = ("temperature [°C]", "measured \u{2212} fitted [K]");
    for text in ["time [min]", "ring", "a.csv", "b.csv", "sigma 0.1 K", "bands: 0 \u{b1} 2 sigma"] {
        picture.says(text);
    }
    // the residuals of all columns are first
    assert_eq!(picture.panels.len(), 5);
    assert_eq!(picture.dots(upper, "series0").len(), 61);
    let line = &picture.lines(upper, "series0")[0];
    assert_eq!(line.len(), 61);
    line.iter().for_each(|&(t, value)| near(value, 80.0 - 60.0 * f64::exp(-t / 10.0), 300.0));
    let second = &picture.panels[4];
    assert_eq!((&*second.title, second.count("series0")), (lower, 41));
    for (i, (_, value)) in picture.dots(lower, "series0").iter().enumerate().skip(10) {
        let off = if i % 2 == 0 { 0.1 } else { -0.1 };
        assert!((value - off).abs() < 0.02, "{value} at {i}");
    }
    let band = &picture.lines(lower, "series0")[0];
    band.iter().for_each(|(_, value)| near(value.abs(), 0.2, 10.0));
}

/// Of many records the first twelve are drawn, and the picture says so.
#[test]
fn many_records_are_not_all_drawn() {
    let folder = body();
    let names: Vec<String> = (0..14).map(|i| format!("{{ csv = \"r{i}.csv\" }}")).collect();
    (0..14).for_each(|i| folder.write(&format!("r{i}.csv"), &folder.read("a.csv")));
    let both = "{ csv = \"a.csv\" }, { csv = \"b.csv\" }";
    folder.write("many.toml", &folder.read("body.toml").replace(both, &names.join(", ")));
    let picture = drawn(&folder, &["fit", "network", "many.toml", "--starts", "0"], 0);
    picture.says("the first 12 of 14 records are drawn").says("r11.csv");
    assert_eq!(picture.panels.len(), 25);
    assert!(!picture.texts.iter().any(|text| text == "r12.csv"));
}

/// Analytic: records of one exponential with rise 20 K (rpm / 1000)^2 and t_RC 100 s, so the rises
/// go with omega^2, t_RC is constant and P = 1000 J/K dT / t_RC. The dots are those of the CSV.
#[test]
fn analytic_rise_time_constant_and_power_over_speed() {
    let folder = Folder::empty();
    std::fs::create_dir(folder.path().join("records")).unwrap();
    for thousands in 1..=7 {
        let mut text = "t [s],ring [degC],case [degC]\n".to_owned();
        for i in 0..400 {
            let off = 0.05 * f64::from(i * 37 % 11 - 5);
            let rise =
                20.0 * f64::from(thousands * thousands) * (1.0 - f64::exp(-f64::from(i) / 100.0));
            writeln!(text, "{i},{:.6},{:.6}", 25.0 + rise + off, 25.0 + 0.5 * rise - off).unwrap();
        }
        folder.write(&format!("records/{thousands}000rpm.csv"), &text);
    }
    let arguments = ["fit", "law", "records", "--capacity", "1 kJ/K"];
    let picture = drawn(&folder, &arguments, 0);
    let titles = ["temperature rise [K]", "time constant [min]", "dissipated power [W]"];
    let named: Vec<&str> = picture.panels.iter().map(|panel| &*panel.title).collect();
    assert_eq!(named, titles);
    for text in ["speed [rpm]", "ring", "case", "mean of ring", "omega^n", "its 95 % band"] {
        picture.says(text);
    }
    let [rises, times, powers] = titles.map(|title| picture.dots(title, "series0"));
    for i in 0..7 {
        let rise = 20.0 * (i as f64 + 1.0).powi(2);
        near(rises[i].0, 1000.0 * (i as f64 + 1.0), 7000.0);
        near(rises[i].1, rise, 2500.0);
        assert!((times[i].1 * 60.0 - 100.0).abs() < 2.0, "{times:?}");
        near(powers[i].1, 10.0 * rise, 50_000.0);
    }
    // the law is the best one's, 10 W (omega / (1000 rpm))^2, as the free exponent finds it
    let law = &picture.lines(titles[2], "series0");
    let law = law.iter().find(|line| line.len() > 100).unwrap();
    law.iter().for_each(|&(rpm, power)| near(power, 2e-4 * rpm * rpm, 50_000.0));
    // what is drawn is what the files hold
    let file = folder.read("out/records/figure_8_time_constant.csv");
    let rows: Vec<Vec<&str>> = file.lines().skip(1).map(|row| row.split(',').collect()).collect();
    let second = picture.dots(titles[1], "series1");
    for (row, (first, second)) in rows.iter().zip(times.iter().zip(&second)) {
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        near(first.0, number(1), 7000.0);
        near(first.1, number(2), 2.0);
        near(second.1, number(5), 2.0);
    }
}

/// The paper's three laws by hand: 58.8 K, 18.6 min and 222.9 W at 7000 rpm; with them C dT / t_RC
/// is 140.1 W, and t_RC would have to be 11.7 min.
#[test]
fn the_papers_laws_contradict_each_other_in_a_picture() {
    let arguments = [
        "fit",
        "law",
        "--dT",
        "0.0084 ± 0.0011 K/rpm",
        "--t_RC",
        "18.6 ± 3.8 min",
        "--P",
        "87 ± 15 uW/rpm^(5/3)",
        "--capacity",
        "2659 J/K",
        "--over",
        "1000 rpm to 7000 rpm",
    ];
    let picture = drawn(&Folder::empty(), &arguments, 1);
    for (title, ink, expected) in [
        ("temperature rise [K]", "series0", 58.8),
        ("time constant [min]", "series1", 11.68),
        ("dissipated power [W]", "series1", 140.1),
    ] {
        let lines = picture.lines(title, ink);
        // a band goes there and back
        let line = lines.iter().find(|line| line.len() == 121).unwrap();
        near(line[120].1, expected, 300.0);
    }
    picture.says("C dT / P").says("C dT / t_RC").says("speed [rpm]");
}

/// Points of a file: the dots with one standard error, 8.74 and 0.5 W at 1000 rpm.
#[test]
fn points_are_drawn_with_their_errors() {
    let folder = Folder::with(
        "points.csv",
        "omega [rpm],P [W],P_sd [W]\n1000,9.4,0.5\n2000,26.9,0.6\n3000,55.6,0.8\n4000,86.5,1\n\
         5000,128,1.4\n6000,172,1.8\n7000,224,2.2\n",
    );
    let picture = drawn(&folder, &["fit", "law", "points.csv"], 0);
    let title = "dissipated power [W]";
    let dots = picture.dots(title, "series0");
    near(dots[0].1, 9.4, 300.0);
    near(dots[6].1, 224.0, 300.0);
    let bar = |line: &&Vec<(f64, f64)>| {
        line.len() == 6 && (line[0].1 - 221.8).abs() < 0.1 && (line[1].1 - 226.2).abs() < 0.1
    };
    assert_eq!(picture.lines(title, "series0").iter().filter(bar).count(), 1);
    picture.says("bars: one standard error");
}
