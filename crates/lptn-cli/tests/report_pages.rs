//! Kind: reference. Pages of studies: the answer first, pictures whose numbers are those of the CSV.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::browser::probed;
use crate::common;

use common::browse::browsed;
use common::{Folder, csv};
use serde_json::Value;

/// A lump of 1000 J/K: `25 + P/G (1 - exp(-G t / 1000))` degC.
const LUMP: &str = "format = 1
title = 'Plain'
[param]
P = '100 W'
G = '10 W/K'
T_air = '25 degC ± 1 K'
[node]
lump = { C = '1000 J/K', T0 = '25 degC' }
[boundary]
air = { T = 'T_air' }
[resistor]
skin = { from = 'lump', to = 'air', G = 'G' }
[source]
heat = { into = 'lump', P = 'P' }
[limit]
hot = { of = 'lump.T', below = '40 degC' }
[run]
stop = '300 s'
output = { every = '10 s' }
";

/// The lump, and one with a better skin.
fn two() -> Folder {
    let folder = Folder::with("plain.toml", LUMP);
    folder.write("finned.toml", &LUMP.replace("10 W/K", "20 W/K").replace("Plain", "Finned"));
    folder
}

/// The value at 300 s for a conductance in W/K, by the closed form.
fn end(conductance: f64) -> f64 {
    25.0 + 100.0 / conductance * (1.0 - (-0.3 * conductance).exp())
}

/// The cells of the first row with this first cell in the tables of a page.
fn row(page: &str, first: &str) -> Vec<String> {
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split("<td").skip(1);
        let text = |cell: &str| {
            cell[cell.find('>').unwrap() + 1..].split("</td>").next().unwrap().to_owned()
        };
        cells.map(text).collect()
    };
    let mut rows = page.lines().map(cells).filter(|cells| !cells.is_empty());
    rows.find(|cells| cells[0] == first).unwrap_or_else(|| panic!("no row {first}"))
}

/// A column of a CSV text by its name before the unit.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let is = |head: &str| head == name || head.starts_with(&format!("{name} ["));
    let at = reader.headers().unwrap().iter().position(is).unwrap_or_else(|| panic!("{name}"));
    reader.records().map(|record| record.unwrap()[at].to_owned()).collect()
}

/// Left and right of the bars of an ink, in pixels, in the order of the drawing.
fn bars(page: &str, ink: &str) -> Vec<(f64, f64)> {
    // a circle is not a bar
    let is_bar =
        |line: &&str| line.contains(&format!("class=\"f-{ink}\"")) && !line.contains(" 0 1 0 ");
    let bars = page.lines().filter(|line| line.starts_with("<path d=\"M")).filter(is_bar);
    let of = |line: &str| {
        let path = line.split('"').nth(1).unwrap();
        let xs = path.split(['M', 'L', 'Z']).filter(|point| !point.is_empty());
        let xs = xs.map(|point| point.split(' ').next().unwrap().parse::<f64>().unwrap());
        xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    bars.map(of).collect()
}

/// Values of the charts of a page.
fn charts(page: &str) -> Vec<Value> {
    let begin = "<script type=\"application/json\">";
    let parts = page.split(begin).skip(1);
    parts
        .map(|part| serde_json::from_str(part.split("</script>").next().unwrap()).unwrap())
        .collect()
}

/// Analytic: margins, differences and shares by the closed form; curves are the rows of each run.
#[test]
fn analytic_a_comparison_begins_with_its_verdict() {
    let folder = two();
    let compared = ["compare", "plain.toml", "finned.toml"];
    let ran = folder.run(&[&compared[..], &["--report=page.html"]].concat()).exits(0);
    let (margin, lead) = (40.0 - end(20.0), end(10.0) - end(20.0));
    let verdict = format!(
        "finned has the largest margin, {margin:.1} K to `hot`, {lead:.2} K more than plain; they differ in G"
    );
    let words: Vec<&str> = ran.out.split_whitespace().collect();
    assert!(words.join(" ").contains(&verdict), "{verdict}\n{}", ran.out);
    let page = folder.read("page.html");
    let verdict = verdict.replace("`hot`", "<code>hot</code>");
    assert!(page.find(&verdict).unwrap() < page.find("<figure").unwrap());
    assert_eq!(row(&page, "title"), ["title", "Finned", "Plain"]);
    assert_eq!(row(&page, "T of air"), ["T of air", "25 degC", "25 degC"]);
    assert_eq!(row(&page, "heat of the sources"), ["heat of the sources", "100 W", "100 W"]);
    assert_eq!(row(&page, "judged over"), ["judged over", "5 min", "5 min"]);
    assert_eq!(row(&page, "G"), ["G", "20 W/K", "10 W/K"]);
    let table = folder.run(&[&compared[..], &["--format=csv"]].concat()).exits(0).out;
    let stored: Vec<f64> = column(&table, "stored").iter().map(|x| x.parse().unwrap()).collect();
    assert_eq!(column(&table, "duty"), ["100", "100"]);
    assert_eq!(column(&table, "length"), ["300", "300"]);
    let [inside, outside] = ["series0", "series1"].map(|ink| bars(&page, ink));
    for (i, share) in stored.iter().enumerate() {
        let all = outside[i].1 - inside[i].0;
        let drawn = (inside[i].1 - inside[i].0) / all;
        assert!((drawn - share).abs() < 1e-4, "{drawn} is not {share}");
    }
    let charts = charts(&page);
    assert_eq!(charts.len(), 1);
    for (i, name) in ["finned", "plain"].iter().enumerate() {
        let rows = folder
            .run(&["run", &format!("{name}.toml"), "--select=lump.T", "--format=csv"])
            .exits(0);
        let rows: Vec<f64> = csv(&rows.out).1.iter().map(|row| row[1]).collect();
        let curve = &charts[0]["panels"][0]["curves"][i];
        let drawn: Vec<f64> =
            curve["y"].as_array().unwrap().iter().map(|y| y.as_f64().unwrap()).collect();
        assert_eq!(curve["name"], format!("{name}: lump"));
        assert_eq!(drawn, rows);
    }
}

/// Other ambient, duty or length: the comparison says so, in its answer and not only on a page.
#[test]
fn designs_under_other_conditions_are_doubted() {
    let code = "compare::conditions_differ";
    let folder = two();
    let same = folder.run(&["compare", "plain.toml", "finned.toml"]).exits(0);
    assert!(!same.err.contains(code), "{}", same.err);
    let other =
        LUMP.replace("25 degC ±", "30 degC ±").replace("100 W", "90 W").replace("300 s", "200 s");
    folder.write("other.toml", &other);
    let ran = folder.json("compare plain.toml other.toml").exits(0);
    let doubts = ran.json()["warnings"].as_array().unwrap().clone();
    let said: Vec<&str> = doubts
        .iter()
        .filter(|doubt| doubt["code"] == code)
        .map(|doubt| doubt["message"].as_str().unwrap())
        .collect();
    assert_eq!(
        said,
        [
            "candidates differ in the temperature of `air`: 25 degC in plain, 30 degC in other",
            "candidates differ in the heat of their sources: 100 W in plain, 90 W in other",
            "candidates differ in the time they are judged over: 5 min in plain, 3.333 min in other",
        ]
    );
    // asked for
    let asked = folder.run(&["compare", "plain.toml", "--set", "T_air=20degC,30degC"]).exits(0);
    assert!(!asked.err.contains(code), "{}", asked.err);
}

/// Eight records of a known truth, alpha = 87 uW/rpm^(5/3): two screens, below 1 MB.
fn eight() -> Folder {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let text = std::fs::read_to_string(format!("{root}/docs/gearbox_sensors.toml")).unwrap();
    let (from, to) = (text.find("data = [").unwrap(), text.find("]\ncolumn.").unwrap());
    let record = |(speed, which): (u32, char)| {
        format!("{{ csv = \"{speed}000rpm_{which}.csv\", set = {{ omega = \"{speed}000 rpm\" }} }}")
    };
    let records: Vec<(u32, char)> =
        [3, 4, 5, 7].into_iter().flat_map(|n| [(n, 'a'), (n, 'b')]).collect();
    let folder = Folder::empty();
    for (speed, which) in &records {
        let name = format!("{speed}000rpm_{which}.csv");
        let path = format!("{root}/networks/records/synthetic_gearbox/{name}");
        folder.write(&name, &std::fs::read_to_string(path).unwrap());
    }
    let records: Vec<String> = records.into_iter().map(record).collect();
    folder.write(
        "eight.toml",
        &format!("{}data = [{}{}", &text[..from], records.join(", "), &text[to..]),
    );
    folder
}

#[test]
fn a_fit_of_eight_records_is_read_from_its_answer() {
    let folder = eight();
    let fitted = ["fit", "network", "eight.toml"];
    folder.run(&[&fitted[..], &["--report=page.html", "--quiet"]].concat()).exits(0);
    let page = folder.read("page.html");
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let order = [
        "determine the 3 parameters",
        ">alpha</td>",
        "<h2>Residuals</h2>",
        "3000rpm_a.csv",
        "<h2>Results</h2>",
        "<h2>Network with the fitted values</h2>",
    ];
    let places: Vec<usize> =
        order.iter().map(|text| page.find(text).unwrap_or_else(|| panic!("{text}"))).collect();
    assert!(places.is_sorted(), "{places:?}");
    let table = folder.run(&[&fitted[..], &["--format=csv", "--quiet"]].concat()).exits(0).out;
    let value = |name: &str| -> f64 { column(&table, name)[0].parse().unwrap() };
    let alpha = value("value");
    assert!((value("low_95")..=value("high_95")).contains(&87.0), "{alpha}");
    // the network of the page is that of the fit
    let network = &page[places[5]..];
    let shown = row(network, "alpha");
    let value: f64 = shown[1].strip_suffix(" uW/rpm^(5/3)").unwrap().parse().unwrap();
    assert!((value - alpha).abs() < 1e-3, "{value} is not {alpha}");
    assert_eq!(shown[2], "80 uW/rpm^(5/3)");
    // values, residuals and records are on two screens of 1920 x 1200 pixels
    let end = "Math.max(...[...document.querySelectorAll('.many figure')].map(figure => \
               figure.getBoundingClientRect().bottom + scrollY))";
    let Some(found) = browsed(&folder, &[("page.html", 1920)], end) else { return };
    let end = found[0].as_f64().unwrap();
    assert!(end <= 2.0 * 1200.0, "{end} pixels");
}

/// A plate between two boundaries, hot along one edge.
const PLATE: &str = "format = 1
[material.plate]
k = '20 W/(m K)'
density = '1000 kg/m^3'
cp = '500 J/(kg K)'
[grid.plate]
size = ['80 mm', '60 mm', '4 mm']
cells = [8, 6, 1]
material = 'plate'
T0 = '20 degC'
[boundary]
air = { T = '20 degC' }
[convection]
cold = { from = 'plate.x1', to = 'air', h = '100 W/(m^2 K)' }
[source]
loss = { into = 'plate.x0', P = '10 W' }
[run]
stop = '30 min'
output = { every = '5 min' }
";

/// The tooltips of a page that begin with a name.
fn tips<'a>(page: &'a str, begin: &str) -> Vec<&'a str> {
    let all = page.split("<title>").skip(1).map(|part| part.split("</title>").next().unwrap());
    all.filter(|tip| tip.starts_with(begin)).collect()
}

/// Cells, hottest cell and isotherms are those of the CSV of the grid.
#[test]
fn a_field_is_that_of_its_cells() {
    let folder = Folder::with("plate.toml", PLATE);
    folder.run(&["steady", "plate.toml", "--report=page.html", "--no-files"]).exits(0);
    let page = folder.read("page.html");
    folder
        .run(&["graph", "plate.toml", "--grid=plate", "--format=csv", "-o", "plate.csv"])
        .exits(0);
    let cells = folder.read("plate.csv");
    let (names, values) = (column(&cells, "cell"), column(&cells, "T"));
    let values: Vec<f64> = values.iter().map(|value| value.parse().unwrap()).collect();
    // the drawing of the network names the cells too
    let page =
        &page[page.find("Temperatures in plate").unwrap()..page.find("<h2>Steady state").unwrap()];
    let shown = tips(page, "plate[");
    assert_eq!(shown.len(), 48);
    for (name, value) in names.iter().zip(&values) {
        let tip = shown.iter().find(|tip| tip.starts_with(&format!("{name}:"))).unwrap();
        assert_eq!(**tip, format!("{name}: {value:.1} \u{b0}C"));
    }
    // the plate is as hot all along its edge
    let most = values.iter().copied().fold(0.0, f64::max);
    let [marked] = tips(page, "hottest cell: ")[..] else { panic!("not one cell is marked") };
    let place = names.iter().position(|name| marked.ends_with(name)).unwrap();
    assert!(most - values[place] < 1e-9, "{marked}");
    // temperatures fall along x only, so that an isotherm is a straight line across the plate
    let x: Vec<f64> = column(&cells, "x").iter().map(|x| x.parse().unwrap()).collect();
    let lines: Vec<&str> = page
        .lines()
        .filter(|line| line.contains("class=\"s-paper\"") && line.contains("degC</title>"))
        .collect();
    assert!(lines.len() >= 3, "{lines:?}");
    for line in lines {
        let level: f64 = tips(line, "")[0].split(' ').next().unwrap().parse().unwrap();
        // SciPy is not needed: between two nodes the field is linear
        let k = (0..42).step_by(6).find(|k| values[*k] >= level && values[k + 6] < level).unwrap();
        let at = x[k] + (values[k] - level) / (values[k] - values[k + 6]) * (x[k + 6] - x[k]);
        let path = line.split('"').nth(1).unwrap();
        let pixels: Vec<f64> = path
            .split(['M', 'L'])
            .filter(|p| !p.is_empty())
            .map(|p| p.split(' ').next().unwrap().parse().unwrap())
            .collect();
        let first = pixels[0];
        assert!(pixels.iter().all(|pixel| (pixel - first).abs() < 0.02), "{path}");
        // 80 mm are as wide as 60 mm are high times 4/3
        let scale = (760.0_f64 / 0.08).min(460.0 / 0.06);
        assert!(
            (first - 82.0 - at * scale).abs() < 0.02,
            "{level} at {first}, not {}",
            82.0 + at * scale
        );
    }
}

/// The slider shows the first and the last of the instants; without scripts the last is there.
#[test]
fn a_field_moves_over_time() {
    let folder = Folder::with("plate.toml", PLATE);
    folder.run(&["run", "plate.toml", "--report=page.html", "--no-files"]).exits(0);
    let page = folder.read("page.html");
    // the manifest has 40 of the 48 cells and of the 12 nodes on faces
    assert!(page.contains("&quot;..&quot;: &quot;20 more&quot;"));
    let frames: Vec<&str> =
        page.lines().filter(|line| line.starts_with("<div data-time=")).collect();
    assert_eq!(frames.len(), 7);
    assert!(frames[..6].iter().all(|frame| frame.contains("\" hidden>")));
    assert!(frames[6].starts_with("<div data-time=\"30 min\">"), "{}", &frames[6][..40]);
    let Some(found) = probed(&folder, "page.html", 1000) else { return };
    let seen = &found["frames"][0];
    assert_eq!(seen["count"], 7);
    assert_eq!(seen["label"], true);
    assert_eq!(seen["last"], Value::from(vec!["30 min"]));
    // one is seen at a time: a zoom holds for all
    let views: Vec<&Value> = found["drawings"].as_array().unwrap()[..7].iter().collect();
    assert!(views.iter().all(|view| view["together"] == true), "{views:?}");
    assert_eq!((&seen["first"], &seen["told"]), (&Value::from(vec!["0 s"]), &Value::from("0 s")));
}

/// Analytic: air of 20 degC swings by 10 K a day, for 90 days. Its mean over each day is 20 degC, its range
/// 10 to 30 degC. One day alone is drawn as it is.
#[test]
fn analytic_months_are_shown_by_days() {
    let text = LUMP.replace("T = 'T_air'", "T = 'T_air + 10 [K] * sin(2 * pi * t / 1 [d])'");
    let text = text.replace("'300 s'", "'90 d'").replace("'10 s'", "'1 h'");
    let text = text.replace("below = '40 degC'", "below = '60 degC'");
    let folder = Folder::with("plain.toml", &text.replace("25 degC ± 1 K", "20 degC"));
    folder.run(&["run", "plain.toml", "--report=page.html", "--no-files"]).exits(0);
    let page = folder.read("page.html");
    assert!(page.contains("means of days, bands from the lowest to the highest value"));
    let charts = charts(&page);
    let panel = &charts[0]["panels"][0];
    let air = panel["curves"].as_array().unwrap().iter().find(|c| c["name"] == "air").unwrap();
    for (side, expected) in [("y", 20.0), ("low", 10.0), ("high", 30.0)] {
        let days = air[side].as_array().unwrap();
        assert_eq!(days.len(), 90, "{side}");
        // the mean of rows of a sine is exact but for rounding
        assert!(days.iter().all(|day| (day.as_f64().unwrap() - expected).abs() < 1e-9), "{side}");
    }
    let day = ["run", "plain.toml", "--stop=1d", "--report=page.html", "--no-files"];
    folder.run(&day).exits(0);
    assert!(!folder.read("page.html").contains("means of days"));
}

/// Bars of the tornado are the effects of `ranking.csv`; a boundary has the band of its parameter.
#[test]
fn an_uncertain_run_begins_with_its_margins() {
    let text = LUMP.replace("'100 W'", "'100 W ± 10 W'").replace("'10 W/K'", "'10 W/K ± 1 W/K'");
    let folder = Folder::with("plain.toml", &text);
    folder.run(&["run", "plain.toml", "--uncertainty=linear", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    assert!(page.find("<h2>Margins of limits</h2>").unwrap() < page.find("<h2>Results").unwrap());
    let ranking = folder.read("out/plain/ranking.csv");
    let of = column(&ranking, "result");
    let effects: Vec<f64> = column(&ranking, "effect")
        .iter()
        .zip(&of)
        .filter(|(_, of)| *of == "hot margin")
        .map(|(effect, _)| effect.parse().unwrap())
        .collect();
    assert_eq!(effects.len(), 3);
    let more = bars(
        &page[page.find("Margins of limits").unwrap()..page.find("<script type=").unwrap()],
        "series1",
    );
    assert_eq!(more.len(), 3);
    for (bar, effect) in more.iter().zip(&effects) {
        let drawn = (bar.1 - bar.0) / (more[0].1 - more[0].0);
        let expected = (effect / effects[0]).abs();
        assert!((drawn - expected).abs() < 2e-3, "{drawn} is not {expected}");
    }
    // 1.96 standard deviations of 1 K; T_air also moves the lump
    let charts = charts(&page);
    let curves = charts[0]["panels"][0]["curves"].as_array().unwrap();
    let air = curves.iter().find(|curve| curve["name"] == "air").unwrap();
    let half = (air["high"][3].as_f64().unwrap() - air["low"][3].as_f64().unwrap()) / 2.0;
    assert!((half - 1.959_963_984_540_054).abs() < 1e-9, "{half}");
}

/// Analytic: 100 W ± 10 W on 10 W/K are 10 K ± 1 K in each of four bodies. Their bands would cover
/// each other: each has a picture, with 1.96 K on both sides at the end.
#[test]
fn analytic_bands_that_cover_each_other_have_a_picture_each() {
    let (mut nodes, mut skins, mut heats) = (String::new(), String::new(), String::new());
    for (i, name) in ["a", "b", "c", "d"].into_iter().enumerate() {
        nodes += &format!("{name} = {{ C = '1.{i} kJ/K', T0 = '20 degC' }}\n");
        skins += &format!("s{name} = {{ from = '{name}', to = 'air', G = '10 W/K' }}\n");
        heats += &format!("p{name} = {{ into = '{name}', P = 'P' }}\n");
    }
    let text = format!(
        "format = 1\n[param]\nP = '100 W ± 10 W'\n[node]\n{nodes}[boundary]\nair = {{ T = '20 degC' \
         }}\n[resistor]\n{skins}[source]\n{heats}[limit]\nhot = {{ of = 'c.T', below = '35 degC' }}\n\
         [run]\nstop = '1 h'\n"
    );
    let folder = Folder::with("four.toml", &text);
    folder.run(&["run", "four.toml", "--uncertainty=linear", "--report=page.html"]).exits(0);
    let page = folder.read("page.html");
    let charts = charts(&page);
    let of = |name: &str| {
        let has = |chart: &&Value| chart["panels"][0]["curves"][0]["name"] == name;
        charts.iter().find(has).unwrap()["panels"][0].clone()
    };
    for name in ["a", "b", "c", "d"] {
        assert!(page.contains(&format!("<h2>{name}</h2>")), "no picture of {name}");
        let panel = of(name);
        assert_eq!(panel["curves"].as_array().unwrap().len(), 1);
        let limits = usize::from(name == "c");
        assert_eq!(panel["limits"].as_array().unwrap().len(), limits, "{name}");
        let end =
            |side: &str| panel["curves"][0][side].as_array().unwrap().last().unwrap().as_f64();
        let half = (end("high").unwrap() - end("low").unwrap()) / 2.0;
        assert!((half - 1.959_963_984_540_054).abs() < 1e-6, "{name}: {half}");
    }
}

/// Each candidate of a sweep is a dot and a line, with its values as in the CSV.
#[test]
fn candidates_of_a_sweep_tell_their_values() {
    let study = "[sweep.fins]\nmethod = 'grid'\naxes = { G = ['8 W/K', '12 W/K'], P = ['100 W', '150 W', \
                 '200 W'] }\nover = 'run'\nreport = { T_max = 'max(lump.T)', cost = 'G / 1 [W/K]' }\n";
    let folder = Folder::with("plain.toml", &format!("{LUMP}{study}"));
    folder.run(&["sweep", "plain.toml", "--report=page.html", "--no-files"]).exits(0);
    let rows = folder.run(&["sweep", "plain.toml", "--no-files", "--format=csv"]).exits(0).out;
    let page = folder.read("page.html");
    let (limits, hottest) = (column(&rows, "limits"), column(&rows, "T_max"));
    let tips = tips(&page, "case ");
    // a line, and a dot in the panel of the second report
    assert_eq!(tips.len(), 12);
    for case in 0..6 {
        let of: Vec<&&str> =
            tips.iter().filter(|tip| tip.starts_with(&format!("case {}:", case + 1))).collect();
        assert_eq!((of.len(), of[0]), (2, of[1]));
        let value: f64 = hottest[case].parse().unwrap();
        let shown: f64 =
            of[0].split("T_max ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!((shown - value).abs() < 1e-3, "{} of {value}", of[0]);
        assert!(of[0].ends_with(&format!("limits {}", limits[case])), "{}", of[0]);
    }
}

/// The colour of a node is that of its position in the file, in curves, circuit, heat flows and
/// table, whatever is chosen.
#[test]
fn a_node_has_one_colour_on_a_page() {
    let text = "format = 1\n[node]\nfirst = { C = '9 J/K', T0 = '20 degC' }\nsecond = { C = '9 J/K', T0 = \
        '20 degC' }\n[boundary]\nair = { T = '20 degC' }\n[resistor]\njoint = { from = 'first', to = \
        'second', R = '1 K/W' }\nskin = { from = 'second', to = 'air', R = '2 K/W' }\n[source]\nheat = \
        { into = 'first', P = '9 W' }\n[run]\nstop = '60 s'\n";
    let folder = Folder::with("body.toml", text);
    for chosen in [vec![], vec!["--select", "second.T", "--select", "air.T"]] {
        let run = ["run", "body.toml", "--no-files", "--report=page.html"];
        folder.run(&[&run[..], &chosen].concat()).exits(0);
        let page = folder.read("page.html");
        let charts = charts(&page);
        let curves = charts[0]["panels"][0]["curves"].as_array().unwrap();
        for (i, name) in ["first", "second", "air"].into_iter().enumerate() {
            let key = format!("series{i}");
            if let Some(curve) = curves.iter().find(|curve| curve["name"] == name) {
                assert_eq!(curve["ink"], key.as_str(), "{name}");
            }
            // a dot in the circuit and one in the heat flows, at the end and in steady state
            let is_dot =
                |line: &&str| line.contains("a4.5 4.5") && line.contains(&format!("f-{key}"));
            assert_eq!(page.lines().filter(is_dot).count(), 4, "{name}");
        }
        assert!(page.contains("class=\"spark c-series1\""));
    }
}
