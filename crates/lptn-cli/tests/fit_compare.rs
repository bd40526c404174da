//! `lptn fit compare`, as a user meets it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::Folder;

/// One body with the heat P to 25 degC, and two that are joined by 0.2 K/W: `near` stands between.
const ONE: &str = "format = 1\n[param]\nR = \"0.3 K/W\"\nC = \"2 kJ/K\"\nP = \"100 W\"\n\
    [node]\nbody = { C = \"C\", T0 = \"25 degC\" }\n[boundary]\nroom = { T = \"25 degC\" }\n\
    [resistor]\nskin = { from = \"body\", to = \"room\", R = \"R\" }\n\
    [source]\nheat = { into = \"body\", P = \"P\" }\n";

const TWO: &str = "format = 1\n[param]\nR = \"0.3 K/W\"\nC = \"1 kJ/K\"\nP = \"100 W\"\n\
    [node]\nbody = { C = \"C\", T0 = \"25 degC\" }\nshell = { C = \"C\", T0 = \"25 degC\" }\n\
    [boundary]\nroom = { T = \"25 degC\" }\n[resistor]\n\
    skin = { from = \"shell\", to = \"room\", R = \"R\" }\n\
    joint = { from = \"body\", to = \"shell\", R = \"0.2 K/W\" }\n\
    [source]\nheat = { into = \"body\", P = \"P\" }\n";

fn fit(name: &str, vary: &str) -> String {
    let record = |power: u32| format!("{{ csv = \"{power}.csv\", set = {{ P = \"{power} W\" }} }}");
    format!(
        "[fit.{name}]\ndata = [{}]\ncolumn = {{ ring = \"body.T\" }}\nvary = [{vary}]\n",
        [50, 100, 200].map(record).join(", ")
    )
}

/// Records of two bodies of 1 kJ/K with 0.2 K/W between them and 0.3 K/W to the room, from their two
/// exponentials, read to 0.1 K.
fn folder() -> Folder {
    let folder = Folder::with("one.toml", &(ONE.to_owned() + &fit("rc", "\"R\", \"C\"")));
    folder.write("two.toml", &(TWO.to_owned() + &fit("rc", "\"R\", \"C\"")));
    // rates of C dT/dt = -A T with A = [[5, -5], [-5, 5 + 10/3]] W/K, and C of 1 kJ/K
    let half = 5.0 / 3.0_f64;
    let root = half.hypot(5.0);
    let (slow, fast) = ((5.0 + half - root) / 1000.0, (5.0 + half + root) / 1000.0);
    for power in [50.0_f64, 100.0, 200.0] {
        let mut text = "t [s],ring [degC]\n".to_owned();
        for t in (0..40).map(|k| f64::from(k) * 30.0) {
            // the part of each exponential in the body follows from T and dT/dt at the start
            let settled = 0.5 * power;
            let slope = power / 1000.0;
            let a = (slope - settled * fast) / (fast - slow);
            let b = -settled - a;
            let rise = settled + a * (-slow * t).exp() + b * (-fast * t).exp();
            text += &format!("{t},{:.1}\n", 25.0 + rise);
        }
        folder.write(&format!("{power}.csv"), &text);
    }
    folder
}

#[test]
fn two_bodies_are_told_from_one() {
    let folder = folder();
    let ran = folder.run(&["fit", "compare", "one.toml", "two.toml", "-o", "out"]).exits(0);
    let ran = ran.prints("2 candidates, fitted to 120 values of 3 records");
    ran.prints("the data favour `two`").says("wrote  out/candidates.csv, unseen.csv");
    assert_eq!(
        folder.files().iter().filter(|file| file.starts_with("out")).count(),
        4,
        "{:?}",
        folder.files()
    );
    let unseen = folder.read("out/unseen.csv");
    assert_eq!((unseen.lines().count(), unseen.starts_with("candidate,record,")), (7, true));
    let json = folder.json("fit compare two.toml one.toml --threads 3").exits(0).json();
    assert_eq!((&json["best"], &json["told"]), (&"two".into(), &true.into()));
    let two = &json["candidates"][0];
    assert_eq!((&two["state"], &two["unseen"][1]["samples"]), (&"taken".into(), &40.into()));
    let value = |name: &str| two["parameters"][name]["value"].as_f64().unwrap();
    assert!((value("R") - 0.3).abs() < 1e-3 && (value("C") - 1000.0).abs() < 5.0);
    // rounding to 0.1 K leaves 0.1 / sqrt(12) K
    let unseen = two["unseen_rms"]["value"].as_f64().unwrap();
    assert!((0.02..0.04).contains(&unseen), "{unseen}");
    let one = &json["candidates"][1];
    assert!(one["times_best_95"][0].as_f64().unwrap() > 1.0 && one["state"] == "worse");
    let again = folder.json("fit compare two.toml one.toml --threads 1").exits(0);
    assert_eq!(again.json(), json);
}

/// What a further parameter brings is by chance, so nothing is told, and the simpler one does.
#[test]
fn what_is_by_chance_is_not_told() {
    let folder = folder();
    let both = TWO
        .replace("\"0.2 K/W\"", "\"joint_R\"")
        .replace("P = \"100 W\"", "P = \"100 W\"\njoint_R = \"0.2 K/W\"");
    let fits = fit("plain", "\"R\", \"C\"") + &fit("free", "\"R\", \"C\", \"joint_R\"");
    folder.write("both.toml", &(both + &fits));
    let ran = folder.run(&["fit", "compare", "both.toml"]).exits(1);
    let ran = ran.prints("the records cannot distinguish");
    ran.prints("`plain` needs the fewest").prints("lptn plan");
    let json = folder.json("fit compare both.toml").exits(1).json();
    assert_eq!((&json["told"], &json["simplest"]), (&false.into(), &"plain".into()));
    // one fit is chosen, and candidates are what is set
    let text = "fit compare both.toml --fit plain --set joint_R=0.2K/W,0.02K/W";
    let json = folder.json(text).exits(0).json();
    assert_eq!(json["best"], "joint_R=0.2K/W");
}

#[test]
fn what_cannot_be_compared_is_said() {
    let folder = folder();
    folder.write("bare.toml", ONE);
    folder.write(
        "fewer.toml",
        &(ONE.to_owned()
            + &fit("rc", "\"R\", \"C\"")
                .replace("{ csv = \"50.csv\", set = { P = \"50 W\" } }, ", "")),
    );
    let refused = |words: &[&str], code: &str| {
        let all: Vec<&str> = ["fit", "compare"].iter().chain(words).copied().collect();
        folder.run(&all).exits(2).says(code);
    };
    refused(&["one.toml"], "fit::one_candidate");
    refused(&["one.toml", "bare.toml"], "fit::no_study");
    refused(&["one.toml", "two.toml", "--fit", "rd"], "fit::no_study");
    refused(&["one.toml", "fewer.toml"], "fit::other_records");
    refused(&["one.toml", "two.toml", "--set", "Q=1,2"], "netlist::unknown_parameter");
    refused(&["one.toml", "missing.toml"], "input::cannot_read");
}
