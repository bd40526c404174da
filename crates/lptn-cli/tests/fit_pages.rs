//! Kind: analytic. Pages of fits: values, intervals and doubts first, residuals as a picture,
//! records by their names.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use std::fmt::Write as _;

use common::Folder;
use serde_json::Value;

/// Values of the charts of a page.
pub fn charts(page: &str) -> Vec<Value> {
    let parts = page.split("<script type=\"application/json\">").skip(1);
    parts
        .map(|part| serde_json::from_str(part.split("</script>").next().unwrap()).unwrap())
        .collect()
}

/// The page before its first figure.
fn head(page: &str) -> &str {
    &page[..page.find("<figure").unwrap()]
}

/// `T = 20 degC + 60 K (1 - exp(-t / 600 s))` up to `stop` in s, with +-0.1 K in turn.
fn heating(stop: u32) -> String {
    let mut text = "t [s],ring [degC]\n".to_owned();
    for i in 0..=stop / 30 {
        let t = 30.0 * f64::from(i);
        let off = if i % 2 == 0 { 0.1 } else { -0.1 };
        writeln!(text, "{t},{:.6}", 80.0 - 60.0 * f64::exp(-t / 600.0) + off).unwrap();
    }
    text
}

/// The numbers of `name = value unit (95 %: low .. high)` in a text.
fn interval(text: &str, name: &str) -> [f64; 3] {
    let text = &text[text.find(&format!("{name} = ")).unwrap() + name.len() + 3..];
    let value = text.split(' ').next().unwrap();
    let ends = text[text.find("95 %: ").unwrap() + 6..].split(')').next().unwrap();
    let (low, high) = ends.split_once(" .. ").unwrap();
    [value, low, high].map(|number| number.parse().unwrap())
}

/// Analytic: T_f = 80 degC and t_RC = 600 s lie in intervals that are said before any picture. A
/// record of one time constant is doubted there, in words; a long one is not.
#[test]
fn analytic_the_page_of_a_step_begins_with_its_values() {
    for (stop, long) in [(3600, true), (600, false)] {
        let folder = Folder::with("record.csv", &heating(stop));
        folder.run(&["fit", "step", "record.csv", "--report=page.html"]).exits(0);
        let page = folder.read("page.html");
        let head = head(&page);
        for (name, expected) in [("T_f", 80.0), ("t_RC", 600.0)] {
            let [value, low, high] = interval(head, name);
            assert!(low <= value && value <= high, "{name}: {value} in {low} .. {high}");
            assert!(low <= expected && expected <= high, "{name}: {low} .. {high}");
        }
        assert_eq!(head.contains("class=\"holds\">ring: T_f"), long, "{head}");
        assert_eq!(head.contains("T_f is extrapolated by"), !long, "{head}");
        let panels = charts(&page)[0]["panels"].as_array().unwrap().len();
        assert_eq!(panels, 2, "the record and its residuals");
    }
}

/// Analytic: 100 W on 0.5 K/W over 20 degC, `T = 70 - 50 exp(-t / 500 s)` degC. The power and its
/// band are first; of 61 readings each has its difference to the prediction, 1 sigma in the mean
/// square but for chance (5 / root(2 * 61) = 0.45).
#[test]
fn analytic_the_page_of_an_inference_begins_with_its_value() {
    let text = "format = 1\n[signal]\nP = '50 W'\n[node]\nbody = { C = '1000 J/K', T0 = '20 degC' }\n\
        [boundary]\nroom = { T = '20 degC' }\n[resistor]\nskin = { from = 'body', to = 'room', R = \
        '0.5 K/W' }\n[source]\nheat = { into = 'body', P = 'P' }\n[infer.power]\ndata = \
        'record.csv'\ncolumn = { ring = 'body.T' }\nsigma = '0.03 K'\nfind = ['P']\n";
    let folder = Folder::with("body.toml", text);
    let mut record = "t [s],ring [degC]\n".to_owned();
    for i in 0..=60 {
        let (t, k) = (30.0 * f64::from(i), f64::from(i));
        // noise of a golden section: even over +-0.052 K, so its deviation is 0.03 K
        let noise = 0.104 * ((k * 0.618_033_988_75).fract() - 0.5);
        writeln!(record, "{t},{:.6}", 70.0 - 50.0 * f64::exp(-t / 500.0) + noise).unwrap();
    }
    folder.write("record.csv", &record);
    folder.run(&["infer", "body.toml", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    let [value, low, high] = interval(head(&page), "P");
    assert!(low < value && value < high && low < 100.0 && 100.0 < high, "{low} {value} {high}");
    let charts = charts(&page);
    let panels = charts[0]["panels"].as_array().unwrap();
    let missed = panels.iter().find(|panel| panel["y"]["unit"] == "sigma").unwrap();
    let dots = &missed["curves"].as_array().unwrap()[1];
    let values = dots["y"].as_array().unwrap().iter().map(|y| y.as_f64().unwrap());
    assert_eq!((values.len(), &dots["name"]), (61, &"ring".into()));
    let rms = (values.map(|y| y * y).sum::<f64>() / 61.0).sqrt();
    assert!((rms - 1.0).abs() < 0.45, "{rms}");
}

/// Records of one name have their folders in titles and at bars.
#[test]
fn records_of_one_name_have_their_folders() {
    let folder = Folder::with(
        "body.toml",
        "format = 1\n[param]\nR = '0.2 K/W'\nC = '2 kJ/K'\n[node]\nbody = { C = 'C', T0 = '20 degC' }\n\
         [boundary]\nair = { T = '20 degC' }\n[resistor]\nskin = { from = 'body', to = 'air', R = 'R' }\n\
         [source]\nheat = { into = 'body', P = '200 W' }\n[fit.all]\ndata = [{ csv = \
         'runs/spring/1.csv' }, { csv = 'runs/autumn/1.csv' }, { csv = 'runs/autumn/2.csv' }]\ncolumn = \
         { ring = 'body.T' }\nsigma = '0.1 K'\nvary = ['R', 'C']\n",
    );
    for name in ["spring/1", "autumn/1", "autumn/2"] {
        let path = folder.path().join(format!("runs/{name}.csv"));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, heating(1800)).unwrap();
    }
    folder.run(&["fit", "network", "body.toml", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    for name in ["spring/1.csv", "autumn/1.csv", "autumn/2.csv"] {
        assert!(page.contains(&format!("<h2>{name}</h2>")), "no title {name}");
        assert!(page.contains(&format!(">ring ({name})<")), "no bar {name}");
    }
}

/// 7501 rows: at most 1000 dots of each column, its first, lowest, highest and last value among them.
#[test]
fn a_long_record_has_a_page_that_can_be_sent() {
    let name = "networks/records/synthetic_gearbox/7000rpm_a.csv";
    let file = format!("{}/../../{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(file).unwrap();
    let folder = Folder::with("record.csv", &text);
    let words = ["fit", "step", "record.csv", "--column", "ring_gear", "--report=page.html"];
    folder.run(&words).exits(0);
    let page = folder.read("page.html");
    assert!(page.len() < 300_000, "{} bytes", page.len());
    let rows = text.lines().skip_while(|line| !line.starts_with("t [s]")).skip(1);
    let rows = rows.map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
    let values: Vec<f64> = rows.collect();
    assert_eq!(values.len(), 7501);
    let charts = charts(&page);
    let curves = charts[0]["panels"][0]["curves"].as_array().unwrap();
    let is_dots = |curve: &&Value| curve["name"] == "ring_gear" && curve["look"] == "dots";
    let dots = curves.iter().find(is_dots).unwrap()["y"].as_array().unwrap();
    let dots: Vec<f64> = dots.iter().map(|value| value.as_f64().unwrap()).collect();
    assert!(dots.len() <= 1000, "{} dots", dots.len());
    let ends = |of: &[f64]| {
        let least = of.iter().copied().fold(f64::INFINITY, f64::min);
        let most = of.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [of[0], least, most, of[of.len() - 1]]
    };
    let pairs = ends(&dots).into_iter().zip(ends(&values));
    pairs.for_each(|(dot, value)| assert!((dot - value).abs() < 1e-9, "{dot} {value}"));
}
