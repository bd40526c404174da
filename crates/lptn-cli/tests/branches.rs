//! Networks whose balances have more than one solution: which one is found.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use std::fmt::Write as _;

use common::Folder;
use common::random::{Random, between};

/// 60 W into a block that loses them through a surface without capacity, whose film falls between
/// 76 and 97 K and between 138 and 143 K: the surface has up to three temperatures at which its
/// balance holds.
const BOILING: &str = "format = 1\n[table]\nfilm = { x = [0, 76, 97, 138, 143, 3000], y = [1.1, \
    0.73, 0.5, 1.35, 0.8, 0.65], \
     x_unit = \"K\", y_unit = \"W/(m^2 K)\" }\n[node]\nblock = { C = \"117 J/K\", T0 = \"50 degC\" \
     }\nj = { massless = true }\n\
     [boundary]\nroom = { T = \"50 degC\" }\n[resistor]\ninner = { from = \"block\", to = \"j\", R \
     = \"5.0 K/W\" }\n\
     [convection]\nskin = { from = \"j\", to = \"room\", h = \"film(abs(dT))\", area = \"0.26 \
     m^2\" }\n\
     [source]\nheat = { into = \"block\", P = \"60 W\" }\n[run]\nstop = \"3000 s\"\noutput = { \
     every = \"300 s\" }\n\
     tolerance = \"1e-5 K\"\n";

/// Heat that rises and falls in a triangle, through a surface whose film has a gap: between 174 and
/// 209 degC of the block the surface has two temperatures at which it stays.
const HYSTERESIS: &str = "format = 1\n[signal]\np = { t = [0, 2000, 4000], v = [0, 50, 0], t_unit \
    = \"s\", v_unit = \"W\", \
     after_end = \"repeat\" }\n[node]\nblock = { C = \"20 J/K\", T0 = \"50 degC\" }\nj = { \
     massless = true }\n\
     [boundary]\nroom = { T = \"50 degC\" }\n[resistor]\ninner = { from = \"block\", to = \"j\", R \
     = \"5 K/W\" }\n\
     [convection]\nskin = { from = \"j\", to = \"room\", area = \"0.26 m^2\", \
     h = \"1 [W/(m^2 K)] - 0.7 [W/(m^2 K)] * exp(-((abs(dT) - 90 [K]) / 12 [K])^2)\" }\n\
     [source]\nheat = { into = \"block\", P = \"p\" }\n[run]\nstop = \"8000 s\"\noutput = { every \
     = \"500 s\" }\n\
     tolerance = \"1e-5 K\"\n";

fn column(rows: &[Vec<f64>], time: f64, column: usize) -> f64 {
    rows.iter().find(|row| (row[0] - time).abs() < 1e-9).unwrap()[column]
}

/// Rows of the block and of `j` in degC at these times in s, at most ten tolerances off.
fn keeps_to(folder: &Folder, exact: &[(f64, f64, f64)], tolerances: &[&str]) {
    let plain = ["run", "net.toml", "--no-files", "--format", "csv", "--select", "*.T"];
    for tolerance in tolerances {
        let ran = folder.run(&[&plain[..], &["--tolerance", tolerance]].concat()).exits(0);
        let (_, rows) = common::csv(&ran.out);
        let allowed = 10.0 * tolerance.trim_end_matches(" K").parse::<f64>().unwrap();
        for &(time, block, j) in exact {
            for (place, expected) in [(1, block), (2, j)] {
                let found = column(&rows, time, place);
                assert!(
                    (found - expected).abs() <= allowed,
                    "{found}, not {expected} at {time} s, {tolerance}"
                );
            }
        }
    }
    let (_, rows) = common::csv(&folder.run(&plain).exits(0).out);
    same_in_every_format(folder, &rows);
}

/// What else is printed and looked at decides nothing.
fn same_in_every_format(folder: &Folder, rows: &[Vec<f64>]) {
    let last = rows.last().unwrap();
    folder.run(&["run", "net.toml", "--no-files"]).exits(0).prints(&format!("{:.1}", last[1]));
    let json = folder.run(&["run", "net.toml", "--no-files", "--format", "json"]).exits(0).json();
    for (row, written) in rows.iter().zip(json["rows"].as_array().unwrap()) {
        for place in 0..3 {
            let same = (written[place].as_f64().unwrap() - row[place]).abs() < 1e-10; // but for the reader's rounding
            assert!(same, "{written}, {row:?}");
        }
    }
    folder.run(&["verify", "net.toml"]).exits(0);
}

const FINE: [&str; 4] = ["1e-3 K", "1e-4 K", "1e-5 K", "1e-6 K"];

/// Newton's method left the branch of a massless node some time after or before its end: 1.63 K off
/// after 1500 s, and another number, or none, by the format that was asked for.
#[test]
fn a_massless_node_leaps_where_its_solution_ends() {
    let folder = Folder::with("net.toml", BOILING);
    // SciPy 1.x, the balance solved for the block along the branch, Radau with rtol 1e-12, the
    // other branch from the fold at 1368.63 s on; with capacities of 1e-3, 1e-4 and 1e-5 J/K in
    // place of the balance Radau gives 452.78619, 452.78697 and 452.78706 degC after 1500 s
    let exact = [
        (900.0, 364.085_309, 177.314_299),
        (1200.0, 411.322_998, 185.049_611),
        (1500.0, 452.787_068, 247.807_364),
        (1800.0, 495.712_903, 269.044_019),
        (3000.0, 589.441_685, 315.520_631),
    ];
    keeps_to(&folder, &exact, &FINE);
}

/// The fold above is a corner of the table; here dq/dT goes through zero at 80.105 K, between two
/// of its points. Tolerances below 1e-4 K ended at 819.471 s with `solve::fold`.
#[test]
fn a_massless_node_leaps_at_a_smooth_fold() {
    let folder = Folder::with("net.toml", &BOILING.replace("5.0 K/W", "20.0 K/W"));
    // With d = j - room and s(d) = 0.26 m^2 film(d) d the time along a branch is the integral of
    // 117 J/K (1 + 20 K/W s'(d)) / (60 W - s(d)) over d: SciPy 1.17, quad to 1e-13, up to 1 + 20
    // K/W s' = 0 at 819.4711002 s, the block at 415.4558702 degC, and on from where the block is as
    // hot on the other branch, j at 148.1463413 degC in place of 130.1053512. Radau with capacities
    // of 1e-3, 1e-4 and 1e-5 J/K gives 447.040468, 447.043905 and 447.044658 degC after 900 s: as
    // their power 2/3, towards 447.04486.
    let exact = [
        (600.0, 327.172_240, 101.072_198),
        (900.0, 447.044_867, 150.319_128),
        (1200.0, 556.180_345, 157.346_397),
        (1800.0, 738.693_102, 167.825_090),
        (3000.0, 994.152_153, 180.643_513),
    ];
    keeps_to(&folder, &exact, &FINE);
}

/// The time of a leap moves with the parameters: exact sensitivities went on over it as if nothing
/// had happened, and gave 6.661 K/W.
#[test]
fn sensitivities_over_a_leap_are_differences() {
    let net = BOILING
        .replace("5.0 K/W", "20.0 K/W")
        .replace("P = \"60 W\"", "P = \"Pw\"")
        .replace("3000 s", "900 s");
    let folder =
        Folder::with("net.toml", &net.replace("[table]", "[param]\nPw = \"60 W ± 1 W\"\n[table]"));
    let arguments =
        ["run", "net.toml", "--no-files", "--uncertainty", "linear", "--format", "json"];
    let json = folder.run(&arguments).exits(0).json();
    assert_eq!(json["uncertainty"]["exact"], false, "{json}");
    // as for the fold above, the integrals for 59.99 and 60.01 W
    for (result, slope) in [("block.T", 6.778_976), ("j.T", 0.458_885)] {
        let sd = json["uncertainty"]["results"][result]["end"]["sd"]["value"].as_f64().unwrap();
        assert!((sd - slope).abs() < 1e-3 * slope, "{result}: {sd}, not {slope}");
    }
}

/// Up at 123.160 degC and down at 138.738 degC, twice: smooth folds of a surface whose film has a
/// gap, under heat that rises and falls in a triangle.
#[test]
fn a_massless_node_leaps_up_and_down_again_and_again() {
    let folder = Folder::with("net.toml", HYSTERESIS);
    // SciPy 1.17, DOP853 with rtol and atol 1e-12 on dt/dx = 20 J/K (1 + 5 K/W s'(d)), dd/dx = P(t) -
    // s(d), which is regular up to and at a fold: leaps at 892.349488, 3853.600147, 4890.481551 and
    // 7853.600146 s
    let exact = [
        (500.0, 123.767_766, 82.072_942),
        (1000.0, 248.825_348, 151.788_396),
        (2000.0, 453.382_738, 225.383_799),
        (3500.0, 225.955_663, 148.949_664),
        (4000.0, 112.178_232, 77.034_014),
        (4500.0, 127.451_467, 83.674_551),
        (5000.0, 249.181_118, 151.834_462),
        (6000.0, 453.383_324, 225.384_054),
        (7500.0, 225.955_663, 148.949_664),
        (8000.0, 112.178_232, 77.034_014),
    ];
    keeps_to(&folder, &exact, &FINE);
}

/// `state.json` says where a massless node stands, but a restart looked for it from the mean of all
/// starts: from 850 s on it stood at 145.5 degC in place of 115.3.
#[test]
fn a_restart_goes_on_upon_the_same_branch() {
    let part =
        |run: &str| HYSTERESIS.replace("stop = \"8000 s\"\noutput = { every = \"500 s\" }", run);
    let rows = |folder: &Folder| {
        let arguments = ["run", "net.toml", "--no-files", "--format", "csv", "--select", "*.T"];
        common::csv(&folder.run(&arguments).exits(0).out).1
    };
    // on the way up on the lower branch, and on the way down on the upper one
    for (at, stop) in [(850, 1150), (3700, 4000)] {
        let folder = Folder::with(
            "net.toml",
            &part(&format!("stop = \"{stop} s\"\noutput = {{ every = \"25 s\" }}")),
        );
        let whole = rows(&folder);
        folder.write(
            "net.toml",
            &part(&format!("stop = \"{at} s\"\noutput = {{ every = \"25 s\" }}")),
        );
        folder.run(&["run", "net.toml"]).exits(0);
        let again =
            format!("start = \"{at} s\"\nstop = \"{stop} s\"\noutput = {{ every = \"25 s\" }}\n");
        folder.write("net.toml", &part(&format!("{again}initial = \"out/net/state.json\"")));
        let then = rows(&folder);
        assert_eq!(then.len(), 13);
        for row in &then {
            for place in [1, 2] {
                let expected = column(&whole, row[0], place);
                let off = (row[place] - expected).abs();
                assert!(
                    off <= 1e-4,
                    "{} in place of {expected} at {} s from {at} s",
                    row[place],
                    row[0]
                );
            }
        }
    }
}

/// 155 W into a hub whose fit on a massless shaft lets go at 71.43 degC: by a law with a corner beside
/// the end of the branch, over which 16 even places stepped. The run went on for minutes.
const LETS_GO: &str = "format = 1\n[node]\nhub = { C = \"210.4 J/K\", T0 = \"51.33 degC\" }\nshaft \
    = { massless = true }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nout = { from = \
    \"shaft\", to = \"air\", R = \"3.863 K/W\" }\nskin = { from = \"hub\", to = \"air\", R = \"0.892 \
    K/W\" }\nfit = { from = \"hub\", to = \"shaft\", G = \"0.02684 [W/K] + 8.202 [W/K^2] * max(20.1 [K] \
    - (T_from - 20 [degC]) + 0.6484 * (T_to - 20 [degC]), 0 [K])\" }\n[source]\nheat = { into = \
    \"hub\", P = \"155.1 W\" }\n[run]\nstop = \"750 s\"\noutput = { every = \"10 s\" }\ntolerance = \
    \"1e-5 K\"\n";

/// The same with a press fit of aluminium on steel.
fn press_fit([capacity, start]: [f64; 2], [power, skin, out]: [f64; 3], fit: &str) -> String {
    format!(
        "format = 1\n[node]\nhub = {{ C = \"{capacity} J/K\", T0 = \"{start} degC\" }}\nshaft = {{ \
         massless = true }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\nout = {{ from = \
         \"shaft\", to = \"air\", R = \"{out} K/W\" }}\nskin = {{ from = \"hub\", to = \"air\", R = \
         \"{skin} K/W\" }}\n[source]\nheat = {{ into = \"hub\", P = \"{power} W\" }}\n[press_fit]\nfit \
         = {{ from = \"hub\", to = \"shaft\", {fit}, alpha = [\"2.3e-05 1/K\", \"1.15e-05 1/K\"], E = \
         [\"70 GPa\", \"210 GPa\"], poisson = [0.33, 0.3], k = [\"150 W/(m K)\", \"46 W/(m K)\"], slope = \
         0.1, roughness = \"1 um\", hardness = \"1.5 GPa\" }}\n"
    )
}

#[test]
fn a_massless_node_leaps_beside_a_corner() {
    let folder = Folder::with("net.toml", LETS_GO);
    // SciPy 1.17: the branch by its length, DOP853 with rtol 1e-13, to where dq/dT is 0 at 43.405033 s,
    // then the other branch with rtol 1e-12
    let exact = [
        (20.0, 61.299_605, 61.060_834),
        (40.0, 70.049_566, 69.272_876),
        (60.0, 78.684_975, 25.513_023),
        (200.0, 119.606_132, 29.357_266),
        (750.0, 153.618_687, 32.552_496),
    ];
    keeps_to(&folder, &exact, &FINE);
    let fit = "diameter = \"0.04973 m\", hub_diameter = \"0.09945 m\", length = \"0.02486 m\", \
        interference = \"2.048e-05 m\", h_gap = \"100 W/(m^2 K)\"";
    let net = press_fit([58.71, 42.58], [170.2, 0.3237, 3.369], fit);
    let run = "[run]\nstop = \"57 s\"\noutput = { every = \"1 s\" }\ntolerance = \"1e-5 K\"\n";
    folder.write("net.toml", &format!("{net}{run}"));
    // the same, the end of the branch at 9.292960 s
    let exact = [
        (5.0, 49.517_190, 49.393_743),
        (9.0, 53.795_996, 53.262_663),
        (10.0, 54.772_079, 39.709_386),
        (20.0, 62.214_164, 43.927_682),
        (57.0, 70.960_318, 48.885_146),
    ];
    keeps_to(&folder, &exact, &FINE);
}

/// Of 120 such hubs 11 did not come back. A shaft that stores next to nothing is the other way to the
/// same temperatures.
#[test]
fn hubs_let_go_as_with_a_shaft_that_stores_next_to_nothing() {
    let mut random = Random(5);
    let mut leaps = 0;
    for case in 0..60 {
        let d = between(&mut random, 0.03, 0.07);
        let fit = format!(
            "diameter = \"{d} m\", hub_diameter = \"{} m\", length = \"{} m\", interference = \"{} \
             m\", h_gap = \"{} W/(m^2 K)\"",
            2.0 * d,
            0.5 * d,
            between(&mut random, 8e-6, 3e-5),
            10.0_f64.powf(between(&mut random, 1.7, 3.3))
        );
        let capacity = 10.0_f64.powf(between(&mut random, 1.5, 2.6));
        let skin = 10.0_f64.powf(between(&mut random, -0.6, 0.4));
        let out = 10.0_f64.powf(between(&mut random, 0.3, 1.0));
        let power = 10.0_f64.powf(between(&mut random, 1.6, 2.4));
        let net = press_fit([capacity, 20.0], [power, skin, out], &fit);
        let stop = 4.0 * capacity * skin;
        let run = format!(
            "[run]\nstop = \"{stop} s\"\noutput = {{ every = \"{} s\" }}\ntolerance = \"1e-6 K\"\n",
            stop / 64.0
        );
        let folder = Folder::with("net.toml", &format!("{net}{run}"));
        let rows = || {
            let arguments = ["run", "net.toml", "--no-files", "--format", "csv", "--select", "*.T"];
            common::csv(&folder.run(&arguments).exits(0).out).1
        };
        let found = rows();
        leaps += usize::from(found.windows(2).any(|pair| pair[1][2] < pair[0][2] - 1.0));
        let stores = net.replace("massless = true", "C = \"1e-8 J/K\", T0 = \"20 degC\"");
        folder.write("net.toml", &format!("{stores}{run}"));
        for (found, expected) in found.iter().zip(rows()) {
            for place in [1, 2] {
                let off = (found[place] - expected[place]).abs();
                assert!(off < 2e-5, "{case}: {off} at {} s\n{net}{run}", found[0]);
            }
        }
    }
    assert!(leaps > 10, "{leaps}");
}

/// A press fit whose conductance has next to an infinite slope where it is lost leaps by 2e-4 K there. A
/// window that looked there ended the run with `solve::fold`.
#[test]
fn no_look_between_rows_ends_a_run() {
    let fit = "diameter = \"0.04895 m\", hub_diameter = \"0.0979 m\", length = \"0.02448 m\", \
        interference = \"1.607e-05 m\", h_gap = \"2000 W/(m^2 K)\"";
    let net = press_fit([98.39, 16.89], [118.4, 2.068, 8.802], fit);
    let run = "[run]\nstop = \"610.5 s\"\n";
    let window = "window = { all = { from = \"0 s\", to = \"610.5 s\" } }\n";
    let limit = "[limit]\nl = { of = \"shaft.T\", below = \"400 degC\" }\n";
    let folder = Folder::empty();
    let mut seen = Vec::new();
    for more in ["", window, limit, "output = { every = \"0.05 s\" }\n"] {
        folder.write("net.toml", &format!("{net}{run}{more}"));
        let arguments = ["run", "net.toml", "--no-files", "--format", "csv", "--select", "*.T"];
        let (_, rows) = common::csv(&folder.run(&arguments).exits(0).out);
        seen.push(rows.last().unwrap().clone());
    }
    assert!(seen.iter().all(|row| row == &seen[0]), "{seen:?}");
}

/// A steady state was one of several, not the one that the network comes to: 25.7 degC in place of
/// 79.0.
#[test]
fn of_several_steady_states_the_one_that_the_start_leads_to_is_given() {
    let two = |start: &str| {
        format!(
            "format = 1\n[node]\na = {{ C = \"10 J/K\", T0 = \"{start}\" }}\n[boundary]\nb = {{ T \
             = \"20 degC\" }}\n\
             [resistor]\nr = {{ from = \"a\", to = \"b\", R = \"0.5 K/W\" }}\n[source]\n\
             s = {{ into = \"a\", P = \"160 [W] * 0.5 * (1 + tanh((a.T - 60 [degC]) / 2 [K]))\" \
             }}\n\
             [run]\nstop = \"1 h\"\n"
        )
    };
    // T - 20 = 40 (1 + tanh((T - 60)/2)): rests near 20 and near 100 degC, and nowhere else; 60
    // degC is between them
    for (start, end) in
        [("59 degC", 20.0), ("61 degC", 100.0), ("0 degC", 20.0), ("300 degC", 100.0)]
    {
        let folder = Folder::with("net.toml", &two(start));
        let json = folder.run(&["steady", "net.toml", "--format", "json"]).exits(0).json();
        let found = json["values"]["a.T"]["value"].as_f64().unwrap();
        assert!((found - end).abs() < 1e-6, "{found} from {start}");
        folder.run(&["run", "net.toml", "--no-files"]).exits(0);
    }
}

/// `compare` gave one of several steady states without a word.
#[test]
fn every_verb_tells_in_the_same_words_that_there_are_several_steady_states() {
    let net = HYSTERESIS.replace("P = \"p\"", "P = \"9 W\"").replace(
        "block = { C = \"20 J/K\", T0 = \"50 degC\" }",
        "block = { C = \"20 J/K\", T0 = \"300 degC\" }",
    );
    let folder = Folder::with("net.toml", &net);
    folder.write("still.toml", &net[..net.find("[run]").unwrap()]);
    // 0.26 m^2 h(d) d = 9 W at d = 34.6154, 85.1209 (unstable) and 93.8597 K: SciPy 1.17, brentq
    let words = "several steady states: from its start the network reaches the one with `j` at \
        143.9 degC; in another it is at 84.62 degC";
    let warnings = |json: &serde_json::Value| -> Vec<String> {
        let all = json["warnings"].as_array().unwrap().iter();
        let several = all.filter(|warning| warning["code"] == "steady::several");
        several.map(|warning| warning["message"].as_str().unwrap().to_owned()).collect()
    };
    let steady = folder.run(&["steady", "net.toml", "--format", "json"]).exits(0).json();
    assert_eq!(warnings(&steady), [words]);
    let run = folder.run(&["run", "net.toml", "--no-files"]).exits(0);
    assert!(
        run.out.split_whitespace().collect::<Vec<_>>().join(" ").contains(words),
        "{}",
        run.out
    );
    let both = ["compare", "net.toml", "still.toml", "--sort", "given"];
    let compared = folder.run(&[&both[..], &["--format", "json"]].concat()).exits(0).json();
    assert_eq!(
        warnings(&compared),
        ["net.toml", "still.toml"].map(|file| format!("{file}: {words}"))
    );
    folder.run(&both).exits(0).says(&format!("net.toml: {words}"));
}

/// A chain of one to three nodes, each with a heat that switches on or off over a few K.
fn switching(random: &mut Random) -> (usize, String) {
    let count = 1 + (random.next() % 3) as usize;
    let (mut nodes, mut paths, mut sources) = (String::new(), String::new(), String::new());
    for i in 0..count {
        let c = 10.0_f64.powf(between(random, 0.0, 3.0));
        writeln!(
            nodes,
            "n{i} = {{ C = \"{c} J/K\", T0 = \"{} degC\" }}",
            between(random, 0.0, 150.0)
        )
        .unwrap();
        let r = 10.0_f64.powf(between(random, -0.5, 0.3));
        writeln!(paths, "r{i} = {{ from = \"n{i}\", to = \"b\", R = \"{r} K/W\" }}").unwrap();
        if i > 0 {
            let r = 10.0_f64.powf(between(random, -0.5, 1.5));
            writeln!(paths, "q{i} = {{ from = \"n{i}\", to = \"n{}\", R = \"{r} K/W\" }}", i - 1)
                .unwrap();
        }
        let (power, at) = (between(random, 20.0, 200.0), between(random, 30.0, 120.0));
        let width =
            between(random, 1.0, 10.0) * if random.next().is_multiple_of(3) { -1.0 } else { 1.0 };
        let heat = format!("{power} [W] * 0.5 * (1 + tanh((n{i}.T - {at} [degC]) / {width} [K]))");
        writeln!(sources, "s{i} = {{ into = \"n{i}\", P = \"{heat}\" }}").unwrap();
    }
    let text = format!(
        "format = 1\n[node]\n{nodes}[boundary]\nb = {{ T = \"20 degC\" \
         }}\n[resistor]\n{paths}[source]\n{sources}\
         [run]\nstop = \"1e6 s\"\noutput = {{ every = \"5e5 s\" }}\n"
    );
    (count, text)
}

/// A run of 1e6 s, thousands of times the longest time constant, is the other way to the same
/// answer. Of 150 networks like these 5 had another steady state than the end of their run.
#[test]
fn steady_states_are_where_runs_end() {
    let mut random = Random(11);
    for case in 0..60 {
        let (count, text) = switching(&mut random);
        let folder = Folder::with("net.toml", &text);
        let json = folder
            .run(&["steady", "net.toml", "--format", "json", "--temperature-unit", "K"])
            .exits(0)
            .json();
        let arguments = [
            "run",
            "net.toml",
            "--no-files",
            "--format",
            "csv",
            "--temperature-unit",
            "K",
            "--select",
            "*.T",
        ];
        let (_, rows) = common::csv(&folder.run(&arguments).exits(0).out);
        for i in 0..count {
            let steady = json["values"][format!("n{i}.T")]["value"].as_f64().unwrap();
            let ended = rows.last().unwrap()[1 + i];
            assert!(
                (steady - ended).abs() < 1e-3,
                "case {case}: n{i} {steady} K, {ended} K\n{text}"
            );
        }
    }
}
