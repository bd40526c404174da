//! R-tau tables whose numbers are parameters, in series with a heat sink, and fitted to a curve.

use crate::common;

use common::{Folder, csv};

/// Table of a small transistor, in K/W and s.
const TABLE: [(f64, f64); 5] =
    [(21.0, 0.013), (48.0, 0.17), (65.0, 0.82), (43.0, 5.4), (69.0, 43.0)];

const DIE: &str = "format = 1\n[param]\nR2 = \"48 K/W\"\ntau1 = \"13 ms\"\nk = 1\n[default]\nT0 = \
    \"0 degC\"\n[boundary]\nambient = { T = \"0 degC\" }\n[foster]\ndie = { to = \"ambient\", R = \
    [\"21 K/W\", \"R2\", \"65 [K/W] * k\", \"43 ± 2 K/W\", \"69 K/W\"], tau = [\"tau1\", \"0.17 \
    s\", \"0.82 s\", \"5.4 s\", \"43 s\"] }\n[source]\np = { into = \"die\", P = \"1 W\" }\n\
    [run]\nstop = \"50 s\"\ntolerance = \"1e-7 K\"\noutput = { every = \"10 s\" }\n";

/// Points of a maker's curve, over its final 250 K/W (NDS332P).
const CURVE: [(f64, f64); 16] = [
    (1e-4, 0.001402),
    (8.72e-4, 0.0085),
    (9.476e-3, 0.057119),
    (0.05, 0.146823),
    (0.1, 0.205168),
    (0.2, 0.279125),
    (0.5, 0.401537),
    (1.0, 0.495428),
    (2.0, 0.576191),
    (5.0, 0.669571),
    (10.683, 0.741601),
    (21.2997, 0.810463),
    (50.0, 0.895578),
    (100.0, 0.953184),
    (156.877, 0.975353),
    (216.442, 0.979892),
];

fn zth(unit: &str) -> String {
    let rows = CURVE.iter().map(|(t, z)| format!("{t},{}\n", 250.0 * z));
    format!("t [s],Z [{unit}]\n0,0\n{}", rows.collect::<String>())
}

/// The sum of the data sheet, with another second resistance and first time constant.
fn sum(time: f64, r2: f64, tau1: f64) -> f64 {
    let mut table = TABLE;
    (table[1].0, table[0].1) = (r2, tau1);
    table.iter().map(|(r, tau)| r * -(-time / tau).exp_m1()).sum()
}

fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "{found} is not {expected}");
}

/// Closed form: the sum of the table, for the parameters as written and as set.
#[test]
fn a_table_of_parameters_is_its_sum() {
    let folder = Folder::with("die.toml", DIE);
    let run = ["run", "die.toml", "--no-files", "--format=csv", "--select=die.T"];
    for (set, r2, tau1) in
        [(&[][..], 48.0, 0.013), (&["--set=R2=30K/W", "--set=tau1=2s"], 30.0, 2.0)]
    {
        let (_, rows) = csv(&folder.run(&[&run[..], set].concat()).exits(0).out);
        for row in &rows[1..] {
            near(row[1], sum(row[0], r2, tau1), 1e-7);
        }
    }
    let flat = folder.run(&["check", "die.toml", "--expand"]).exits(0).out;
    folder.write("flat.toml", &flat);
    let whole = folder.run(&run).exits(0).out;
    let same = folder.run(&["run", "flat.toml", "--no-files", "--format=csv", "--select=die.T"]);
    assert_eq!(same.exits(0).out, whole);
}

/// In steady state `d T / d R_4` is the power, so ± 2 K/W are ± 2 K.
#[test]
fn an_uncertain_row_counts() {
    let folder = Folder::with("die.toml", &DIE.replace("50 s", "1000 s"));
    let run = ["run", "die.toml", "--no-files", "--uncertainty=linear", "--select=die.T"];
    folder.run(&run).exits(0).prints("246.00    2.00").prints("die.R_4");
}

/// Five terms against SciPy's `least_squares` from 40 random starts: rms 0.33172 K/W over the 16
/// points after the step, these resistances and time constants, and its standard errors.
#[test]
fn five_terms_are_those_of_another_program() {
    let scipy = [
        (21.12977589, 1.31298181e-02, 0.08285911, 0.12072249),
        (47.73666177, 1.71008212e-01, 0.15578369, 0.16850019),
        (64.87547157, 8.15777438e-01, 0.08431394, 0.1945095),
        (42.88965742, 5.40362683, 0.10565238, 0.19890773),
        (68.83892708, 43.3590760, 0.04131751, 0.05586563),
    ];
    let folder = Folder::with("zth.csv", &zth("K/W"));
    let json =
        folder.run(&["fit", "step", "zth.csv", "--terms=5", "--format=json"]).exits(0).json();
    near(json["tried"][4]["rms"].as_f64().unwrap(), 0.331_716_315_8, 1e-8);
    for (term, (r, tau, by_r, by_tau)) in json["terms"].as_array().unwrap().iter().zip(scipy) {
        let number = |key: &str, of: &str| term[key][of].as_f64().unwrap();
        near(number("R", "value"), r, 1e-5);
        near(number("tau", "value"), tau, 1e-5);
        near(number("R", "naive_standard_error"), r * by_r, 1e-4);
        near(number("tau", "naive_standard_error"), tau * by_tau, 1e-4);
        let [low, high] = [0, 1].map(|end| term["R"]["interval_95"][end].as_f64().unwrap());
        // Student's t of 6 degrees of freedom is 2.447; lptn's noise may be correlated
        near((high / r).ln(), 2.447 * by_r, 0.05);
        near((r / low).ln(), 2.447 * by_r, 0.05);
    }
    folder.write("zth.csv", &zth("K"));
    let resistance = |power: &str| {
        let ask = ["fit", "step", "zth.csv", "--terms=3", "--format=json", power];
        let json = folder.run(&ask).exits(0).json();
        json["terms"][0]["R"]["value"].as_f64().unwrap()
    };
    near(resistance("--power=1W"), 2.0 * resistance("--power=2W"), 1e-12);
    folder.run(&["fit", "step", "zth.csv", "--terms=3"]).exits(0).prints("--power").prints("A [K]");
}

/// SciPy's optima for 1 to 6 terms give AICc 111.5, 80.7, 59.4, 42.0, 52.7 and 135.0.
#[test]
fn the_number_of_terms_is_that_of_the_least_criterion() {
    let folder = Folder::with("zth.csv", &zth("K/W"));
    let ask = ["fit", "step", "zth.csv", "--terms=auto", "--format=json"];
    let json = folder.run(&ask).exits(0).json();
    assert_eq!(json["terms"].as_array().unwrap().len(), 4);
    let criteria = [111.500_09, 80.715_894, 59.404_026, 42.026_078, 52.688_795];
    for (tried, criterion) in json["tried"].as_array().unwrap().iter().zip(criteria) {
        near(tried["AICc"].as_f64().unwrap(), criterion, 1e-6);
    }
    let text = folder.run(&["fit", "step", "zth.csv", "--terms=auto"]).exits(0).out;
    let lines: Vec<&str> = text.lines().skip_while(|line| *line != "[foster.device]").collect();
    let pasted = format!(
        "format = 1\n[default]\nT0 = \"0 degC\"\n[boundary]\ncase = {{ T = \"0 degC\" }}\n{}\n",
        lines.join("\n")
    );
    folder.write("device.toml", &pasted);
    let back = ["impedance", "device.toml", "--port=device", "--time=1s", "--format=csv"];
    let (_, rows) = csv(&folder.run(&back).exits(0).out);
    // the point of the maker at 1 s, to the largest residual
    near(rows[0][1], 123.857, 0.02);
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let folder = Folder::with("zth.csv", &zth("K/W"));
    let ask = |more: &[&str]| folder.run(&[&["fit", "step", "zth.csv"], more].concat());
    ask(&["--terms=7"]).exits(2).says("fit::terms_points").says("17 would");
    ask(&["--terms=0"]).exits(2).says("fit::terms_count");
    ask(&["--terms=many"]).exits(2).says("fit::terms_count");
    ask(&["--terms=2", "--power=1W"]).exits(2).says("fit::terms_power");
    ask(&["--terms=2", "--reference=Z"]).exits(2).says("fit::terms_option");
    let exponential = |t: f64| 5.0 * -(-t / 3.0).exp_m1();
    let rows = (1..40).map(|i| f64::from(i) * 0.5).map(|t| format!("{t},{:.3}\n", exponential(t)));
    folder.write("zth.csv", &format!("t [s],Z [K/W]\n{}", rows.collect::<String>()));
    ask(&["--terms=4"]).exits(3).says("fit::terms_undetermined");
    let json = ask(&["--terms=auto", "--format=json"]).exits(0).json();
    near(json["terms"][0]["R"]["value"].as_f64().unwrap(), 5.0, 1e-3);
    assert_eq!(json["terms"].as_array().unwrap().len(), 1);
}

/// The netlist of 61 lines with a node for each term, by the table itself. Optimum: SciPy's, to the
/// weight of the row at 0.
#[test]
fn a_table_is_fitted_as_parameters() {
    let start = [(15.0, 0.005), (60.0, 0.05), (60.0, 0.4), (60.0, 4.0), (60.0, 50.0)];
    let mut text = "format = 1\n[param]\n".to_owned();
    let mut vary = "[fit.zth.vary]\n".to_owned();
    for (i, (r, tau)) in start.iter().enumerate() {
        let k = i + 1;
        text += &format!("R{k} = \"{r} K/W\"\ntau{k} = \"{tau} s\"\n");
        vary += &format!(
            "R{k} = {{ from = \"0.1 K/W\", to = \"300 K/W\" }}\ntau{k} = {{ from = \"{} s\", to = \
             \"{} s\" }}\n",
            tau / 5.0,
            tau * 5.0
        );
    }
    text += "[default]\nT0 = \"0 degC\"\n[boundary]\nambient = { T = \"0 degC\" }\n[foster]\ndie = \
        { to = \"ambient\", R = [\"R1\", \"R2\", \"R3\", \"R4\", \"R5\"], tau = [\"tau1\", \
        \"tau2\", \"tau3\", \"tau4\", \"tau5\"] }\n[source]\np = { into = \"die\", P = \"1 W\" }\n\
        [fit.zth]\ndata = \"zth.csv\"\ncolumn = { Z = \"die.T - ambient.T\" }\nsigma = \"0.5 K\"\n";
    text += &vary;
    text += "[run]\nstop = \"217 s\"\n";
    let folder = Folder::with("fit.toml", &text);
    folder.write("zth.csv", &zth("K"));
    let ran = folder.run(&["fit", "network", "fit.toml", "--format=json", "--no-files"]);
    let json = ran.exits(0).json();
    for (name, value) in [("R1", 21.12977589), ("tau3", 0.815777438), ("R5", 68.83892708)] {
        near(json["parameters"][name]["value"].as_f64().unwrap(), value, 1e-3);
    }
}

/// Row, chip and sink of the run in series.
const SERIES: [(usize, f64, f64); 3] = [
    (1, 52.1092213906, 40.0023974062),
    (10, 57.6443421683, 40.2871622154),
    (100, 62.212101355, 44.4109809491),
];

/// A device in series: `expm` of SciPy on the ladder and the sink gives these temperatures.
#[test]
fn a_device_hangs_on_a_heat_sink() {
    let device = "format = 1\n[template.igbt]\nparam = { P = { unit = \"W\" } }\nport = \
        [\"case\"]\n[template.igbt.foster]\nchip = { to = \"case\", series = true, R = [\"20 \
        mK/W\", \"60 mK/W\", \"40 mK/W\"], tau = [\"2 ms\", \"50 ms\", \"0.4 s\"] }\n\
        [template.igbt.source]\nloss = { into = \"chip\", P = \"P\" }\n";
    let inverter = "format = 1\ninclude = [\"igbt.toml\"]\n[default]\nT0 = \"40 degC\"\n[boundary]\n\
        air = { T = \"40 degC\" }\n[node]\nsink = { C = \"900 J/K\" }\n[resistor]\nfins = { from = \
        \"sink\", to = \"air\", R = \"0.1 K/W\" }\n[use.high]\ntemplate = \"igbt\"\nconnect = { \
        case = \"sink\" }\nset = { P = \"150 W\" }\n[use.low]\ntemplate = \"igbt\"\nconnect = { \
        case = \"sink\" }\nset = { P = \"300 W\" }\n[run]\nstop = \"10 s\"\ntolerance = \"1e-7 K\"\n\
        output = { every = \"0.1 s\" }\n";
    let folder = Folder::with("inverter.toml", inverter);
    folder.write("igbt.toml", device);
    // 40 + 0.1 * 450 = 85 degC, and 0.12 K/W of each device more
    folder.run(&["steady", "inverter.toml"]).exits(0).prints("103.0").prints("121.0");
    let run = [
        "run",
        "inverter.toml",
        "--no-files",
        "--format=csv",
        "--select=high.chip.T",
        "--select=sink.T",
    ];
    let (headers, rows) = csv(&folder.run(&run).exits(0).out);
    let of = |name: &str| headers.iter().position(|head| head.starts_with(name)).unwrap();
    for (row, chip, sink) in SERIES {
        near(rows[row][of("high.chip.T")], chip, 1e-8);
        near(rows[row][of("sink.T")], sink, 1e-8);
    }
    let wrong = device.replace(", series = true", "");
    folder.write("igbt.toml", &wrong);
    folder
        .run(&["check", "inverter.toml"])
        .exits(1)
        .prints("foster_series")
        .prints("series = true");
}
