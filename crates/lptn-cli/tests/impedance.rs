//! `lptn impedance`, as a user meets it.

use crate::common;

use common::{Folder, csv};
use serde_json::Value;

/// 100 J/K at 2 K/W: 200 s; another part that nothing grounds.
const BODY: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\nbody = { C = \"100 J/K\" }\n\
    loose = { C = \"5 J/K\" }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\n\
    skin = { from = \"body\", to = \"air\", R = \"2 K/W\" }\n[source]\n\
    heat = { into = \"body\", P = \"1 W\" }\n";

fn scalar(value: &Value) -> f64 {
    value["value"].as_f64().unwrap_or_else(|| panic!("{value}"))
}

#[test]
fn a_step_and_its_pulses_are_one_exponential() {
    let folder = Folder::with("body.toml", BODY);
    let arguments = ["impedance", "body.toml", "--port", "heat", "--time", "20s,200s"];
    let ran = folder.run(&arguments).exits(0);
    ran.prints("`body` rises by 2 K/W of `heat`, in steady state").prints("63.21 %");
    let with_pulses =
        ["impedance", "body.toml", "--port", "body", "--time=200s", "--duty=0.25", "--format=csv"];
    let (headers, rows) = csv(&folder.run(&with_pulses).exits(0).out);
    assert_eq!(headers, ["time [s]", "rise [K/W]", "duty 0.25 [K/W]"]);
    let rise = -2.0 * (-1.0_f64).exp_m1();
    assert!((rows[0][1] - rise).abs() < 1e-14);
    assert!((rows[0][2] + rise / (-4.0_f64).exp_m1()).abs() < 1e-14);
    let json = folder.json("impedance body.toml --port body").exits(0).json();
    assert!((scalar(&json["settled"]) - 2.0).abs() < 1e-15);
    // three a decade, from a tenth of the time constant to five of them
    let times: Vec<f64> =
        json["points"].as_array().unwrap().iter().map(|point| scalar(&point["time"])).collect();
    assert_eq!((times[0], *times.last().unwrap()), (10.0, 1000.0));
}

#[test]
fn a_swing_is_r_over_one_plus_j_omega_rc() {
    let folder = Folder::with("body.toml", BODY);
    let list = ["impedance", "body.toml", "--port", "air", "--to", "body", "--omega"];
    let ran = folder.run(&[&list[..], &["0 rad/s, 5 mrad/s, 1 Hz", "--format=json"]].concat());
    let points = ran.exits(0).json()["points"].clone();
    for (point, omega) in points.as_array().unwrap().iter().zip([0.0, 5e-3, std::f64::consts::TAU])
    {
        assert!((scalar(&point["omega"]) - omega).abs() < 1e-15);
        let size = 1.0 + (200.0 * omega).powi(2);
        assert!((scalar(&point["re"]) - 1.0 / size).abs() < 1e-14);
        assert!((scalar(&point["im"]) + 200.0 * omega / size).abs() < 1e-14);
    }
    let ran = folder.run(&["impedance", "body.toml", "--port", "body", "--omega"]).exits(0);
    ran.prints("amplitude [K/W]").prints("phase [deg]");
}

/// Equal cells in a stream have one mode for all: `1/mcp P(k, t mcp / C)` by mpmath, as in
/// `crates/lptn-solve/tests/response.rs`.
#[test]
fn a_chain_of_equal_cells_answers_without_modes() {
    let mut text = String::from(
        "format = 1\n[default]\nT0 = \"20 degC\"\n[boundary]\ninlet = { T = \
        \"20 degC\" }\n[node]\n",
    );
    (1..=6).for_each(|i| text += &format!("c{i} = {{ C = \"50 J/K\" }}\n"));
    text += "[advection]\ns1 = { from = \"inlet\", to = \"c1\", mcp = \"20 W/K\" }\n\
        s7 = { from = \"c6\", to = \"inlet\", mcp = \"20 W/K\" }\n";
    let hose = |i| format!("s{i} = {{ from = \"c{}\", to = \"c{i}\", mcp = \"20 W/K\" }}\n", i - 1);
    (2..=6).for_each(|i| text += &hose(i));
    let folder = Folder::with("chain.toml", &text);
    folder.run(&["modes", "chain.toml"]).exits(2).says("modes::defective");
    let words =
        ["impedance", "chain.toml", "--port=c1", "--to=c6", "--time=5s,20s", "--format=csv"];
    let (_, rows) = csv(&folder.run(&words).exits(0).out);
    let expected = [8.281_804_240_307_22e-4, 0.040_438_196_896_018_74];
    for (row, rise) in rows.iter().zip(expected) {
        assert!((row[1] / rise - 1.0).abs() < 1e-12, "{row:?}");
    }
    let table = ["impedance", "chain.toml", "--port=c1", "--foster"];
    folder.run(&table).exits(2).says("modes::defective");
    let pulses = ["impedance", "chain.toml", "--port=c1", "--duty=0.25"];
    folder.run(&pulses).exits(0).prints("D = 0.25");
    folder.run(&["impedance", "chain.toml", "--port=c1", "--omega"]).exits(0);
}

#[test]
fn what_cannot_be_asked_is_said() {
    let folder = Folder::with("body.toml", BODY);
    let refused = |words: &[&str], code: &str| {
        folder.run(&[&["impedance", "body.toml"], words].concat()).exits(2).says(code);
    };
    refused(&[], "impedance::no_port");
    refused(&["--port", "air"], "impedance::no_node");
    refused(&["--port", "bdy"], "did you mean `body`?");
    refused(&["--port", "body", "--to", "air"], "reduce::boundary_port");
    refused(&["--port", "loose"], "response::no_ground");
    refused(&["--port", "body", "--omega", "2 Hz,-1 Hz"], "impedance::list");
    refused(&["--port", "body", "--time", "0s"], "impedance::list");
    refused(&["--port", "body", "--omega", "3 K"], "--omega");
    refused(&["--port", "body", "--duty", "1.5"], "impedance::duty");
    refused(&["--port", "body", "--to", "loose", "--duty", "0.5"], "impedance::pulses_elsewhere");
    let loose = ["impedance", "body.toml", "--port", "loose", "--omega", "1 rad/s"];
    folder.run(&loose).exits(0).prints("0.2").prints("-90");
}

/// The curve is drawn through them: they come in order, and that is told.
#[test]
fn lists_are_shown_in_order_and_that_is_told() {
    let folder = Folder::with("body.toml", BODY);
    let ask = |list: [&str; 2]| {
        folder.run(&["impedance", "body.toml", "--port=body", list[0], list[1], "--format=csv"])
    };
    for (given, ascending) in [
        (["--time", "2s,1s,2s"], ["--time", "1s,2s"]),
        (["--omega", "2 Hz, 1 rad/s"], ["--omega", "1 rad/s,2 Hz"]),
    ] {
        let (moved, ran) = (ask(given).exits(0), ask(ascending).exits(0));
        assert_eq!(moved.out, ran.out);
        assert!(moved.err.contains("ascending order") && !ran.err.contains("ascending"));
    }
}

/// Two bodies behind a junction. Conductances 4, 2 W/K and capacities 2, 4 J/K: the squared rates of
/// `C^-1/2 G C^-1/2` are those of [[3, -2/8^0.5], ..]; the closed forms stand in the test.
const PAIR: &str = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\njoint = { massless = true }\n\
    a = { C = \"2 J/K\" }\nb = { C = \"4 J/K\" }\n[boundary]\nair = { T = \"20 degC\" }\n\
    [resistor]\nin = { from = \"joint\", to = \"a\", R = \"0.5 K/W\" }\n\
    mid = { from = \"a\", to = \"b\", G = \"4 W/K\" }\nout = { from = \"b\", to = \"air\", G = \"2 W/K\" }\n";

#[test]
fn a_table_and_a_ladder_are_the_network() {
    let folder = Folder::with("pair.toml", PAIR);
    let ask = |words: &[&str]| folder.run(&[&["impedance", "pair.toml"], words].concat());
    let json = ask(&["--port", "joint", "--cauer", "--format=json"]).exits(0).json();
    assert!((scalar(&json["direct"]) - 0.5).abs() < 1e-12);
    let rungs = json["cauer"].as_array().unwrap().iter();
    for (rung, (c, r)) in rungs.zip([(2.0, 0.25), (4.0, 0.5)]) {
        assert!((scalar(&rung["C"]) - c).abs() < 1e-11 && (scalar(&rung["R"]) - r).abs() < 1e-11);
    }
    // rates: roots of s^2 - (2 + 1.5) s + 2 * 1.5 - 2
    let root = (3.5_f64.powi(2) - 4.0).sqrt();
    let rates = [0.5 * (3.5 + root), 0.5 * (3.5 - root)];
    let (headers, rows) = csv(&ask(&["--port", "a", "--foster", "--format=csv"]).exits(0).out);
    assert_eq!(headers, ["R [K/W]", "tau [s]"]);
    for (row, rate) in rows.iter().zip(rates) {
        assert!((row[1] * rate - 1.0).abs() < 1e-12, "{row:?}");
    }
    // the residues of (s + 1.5) / (2 (s^2 + 3.5 s + 1)) over the rates
    let residue = |rate: f64, other: f64| (1.5 - rate) / (2.0 * (other - rate)) / rate;
    assert!((rows[0][0] - residue(rates[0], rates[1])).abs() < 1e-12);
    assert!((rows[1][0] - residue(rates[1], rates[0])).abs() < 1e-12);
    // between two places terms of either sign: 4 / (8 (s^2 + 3.5 s + 1))
    let (_, rows) =
        csv(&ask(&["--port", "a", "--to", "b", "--foster", "--format=csv"]).exits(0).out);
    let residue = |rate: f64, other: f64| 0.5 / (other - rate) / rate;
    assert!((rows[0][0] - residue(rates[0], rates[1])).abs() < 1e-12 && rows[0][0] < 0.0);
    ask(&["--port", "a", "--to", "b", "--cauer"]).exits(2).says("impedance::between");
    ask(&["--port", "a", "--to", "b", "--foster=1"]).exits(2).says("impedance::between");
    ask(&["--port", "a", "--write", "x.toml"]).exits(2).says("impedance::nothing_to_write");
}

#[test]
fn what_is_written_has_the_same_impedance() {
    let folder = Folder::with("pair.toml", PAIR);
    for (form, file) in [("--foster", "table.toml"), ("--cauer", "ladder.toml")] {
        folder.run(&["impedance", "pair.toml", "--port", "joint", form, "--write", file]).exits(0);
        folder.run(&["check", file]).exits(0).prints("0 warnings");
        let ask = |file: &str| {
            let run = ["impedance", file, "--port", "joint", "--time=0.1s,3s", "--format=csv"];
            csv(&folder.run(&run).exits(0).out).1
        };
        for (here, there) in ask(file).iter().zip(ask("pair.toml")) {
            assert!((here[1] / there[1] - 1.0).abs() < 1e-12, "{here:?} {there:?}");
        }
        let again = ["impedance", "pair.toml", "--port", "joint", form, "--write", file];
        folder.run(&again).exits(2).says("impedance::exists");
    }
}

/// Fewer terms state their error over every load, which one term of a chain of many has: against
/// the closed form of the step, which is one of the loads.
#[test]
fn fewer_terms_say_how_wrong_they_are() {
    let folder = Folder::with("pair.toml", PAIR);
    let ran = folder.run(&["impedance", "pair.toml", "--port", "a", "--foster=1", "--format=json"]);
    let json = ran.exits(0).json();
    let error = scalar(&json["error"]);
    let tau = scalar(&json["foster"][0]["tau"]);
    let root = (3.5_f64.powi(2) - 4.0).sqrt();
    let (fast, slow) = (0.5 * (3.5 + root), 0.5 * (3.5 - root));
    let part = |rate: f64, other: f64| (1.5 - rate) / (2.0 * (other - rate)) / rate;
    let whole =
        |t: f64| -part(fast, slow) * (-fast * t).exp_m1() - part(slow, fast) * (-slow * t).exp_m1();
    let one = |t: f64| -0.75 * (-t / tau).exp_m1();
    let worst = (1..2000).map(|k| (whole(0.01 * f64::from(k)) - one(0.01 * f64::from(k))).abs());
    let worst = worst.fold(0.0, f64::max);
    assert!(worst > 0.02 && error >= worst && error < 2.0 * worst, "{error} {worst}");
}

#[test]
fn a_chain_is_refused_where_it_says_nothing() {
    let folder = Folder::with("pair.toml", PAIR);
    let stream = PAIR.replace("massless = true", "C = \"1 J/K\"").replace(
        "mid = { from",
        "m2 = { from = \"b\", to = \"joint\", R = \"9 K/W\" }\nmid = { from",
    );
    let ring = format!(
        "{stream}[advection]\nu = {{ from = \"joint\", to = \"a\", mcp = \"50 W/K\" }}\n\
         v = {{ from = \"a\", to = \"b\", mcp = \"50 W/K\" }}\n\
         w = {{ from = \"b\", to = \"joint\", mcp = \"50 W/K\" }}\n"
    );
    folder.write("ring.toml", &ring);
    folder
        .run(&["impedance", "ring.toml", "--port", "a", "--foster"])
        .exits(2)
        .says("impedance::swings");
    let light = PAIR.replace("a = { C = \"2 J/K\" }", "a = { massless = true }");
    let light = light.replace("b = { C = \"4 J/K\" }", "b = { massless = true }");
    let light = light.replace("[boundary]", "c = { C = \"1 J/K\" }\n[boundary]");
    let light = light
        .replace("[resistor]", "[resistor]\nd = { from = \"c\", to = \"air\", R = \"1 K/W\" }");
    folder.write("light.toml", &light);
    folder
        .run(&["impedance", "light.toml", "--port", "a", "--foster"])
        .exits(2)
        .says("impedance::at_once");
}

/// The module of Infineon's AN2008-03 (T. Schuetze, Thermal equivalent circuit models, 2008), whose
/// table Simscape takes for its Foster block. Curve: the sum of the data sheet, computed in Python.
#[test]
fn a_published_table_has_its_published_curve() {
    let module = "format = 1\n[default]\nT0 = \"80 degC\"\n[boundary]\ncase = { T = \"80 degC\" }\n\
        [foster]\nchip = { to = \"case\", R = [\"1.6 mK/W\", \"4.3 mK/W\", \"1.3 mK/W\", \"1.4 \
        mK/W\"], tau = [\"6.8 ms\", \"64 ms\", \"320 ms\", \"2 s\"] }\n[source]\nloss = { into = \
        \"chip\", P = \"1 kW\" }\n[run]\nstop = \"10 s\"\ntolerance = \"1e-6 K\"\noutput = { \
        every = \"100 ms\" }\n";
    let curve = [
        0.000_290_232_189_799,
        0.001_901_329_977_41,
        0.005_415_848_866_51,
        0.007_693_738_358_62,
        0.008_590_566_874_2,
    ];
    let folder = Folder::with("module.toml", module);
    let times = "--time=1ms,10ms,100ms,1s,10s";
    let ask = ["impedance", "module.toml", "--port", "chip", times, "--format=csv"];
    let (_, rows) = csv(&folder.run(&ask).exits(0).out);
    for (row, z) in rows.iter().zip(curve) {
        assert!((row[1] / z - 1.0).abs() < 1e-11, "{row:?} {z}");
    }
    let run = ["run", "module.toml", "--no-files", "--format=csv", "--select=chip.T"];
    let (_, rows) = csv(&folder.run(&run).exits(0).out);
    for (row, z) in [1, 10, 100].into_iter().map(|row| &rows[row]).zip(&curve[2..]) {
        assert!((row[1] - 80.0 - 1000.0 * z).abs() < 1e-5, "{row:?} {z}");
    }
    let back = ["impedance", "module.toml", "--port", "chip", "--foster", "--format=csv"];
    let (_, rows) = csv(&folder.run(&back).exits(0).out);
    let table = [(0.0016, 0.0068), (0.0043, 0.064), (0.0013, 0.32), (0.0014, 2.0)];
    for (row, (r, tau)) in rows.iter().zip(table) {
        assert!((row[0] / r - 1.0).abs() < 1e-10 && (row[1] / tau - 1.0).abs() < 1e-10, "{row:?}");
    }
}
