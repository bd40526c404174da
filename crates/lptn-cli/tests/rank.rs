//! `lptn rank`, as a user meets it.

use crate::common;

use common::Folder;

/// 100 W over 0.05 K/W and 4 W/K into air of 20 degC: 50 degC.
const CHAIN: &str = "format = 1\n[param]\nG_skin = \"4 W/K\"\n[default]\nT0 = \"20 degC\"\n[node]\n\
    core = { C = \"1 kJ/K\" }\nshell = { C = \"1 kJ/K\" }\n[boundary]\nair = { T = \"20 degC\" }\n\
    [resistor]\nfit = { from = \"core\", to = \"shell\", R = \"0.05 K/W\" }\nskin = { from = \
    \"shell\", to = \"air\", G = \"G_skin\" }\n[source]\nloss = { into = \"core\", P = \"100 W\" }\n";

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn values_are_ranked_with_their_units() {
    let folder = Folder::with("chain.toml", CHAIN);
    let ran = folder.run(&["rank", "chain.toml"]).exits(0);
    for line in [
        "core: 50 degC in steady state",
        "G_skin     4 W/K  +10 %           -2.5",
        "loss.P       100 W  +10 %             +3",
        "fit.R     0.05 K/W  +10 %           +0.5",
        "air.T      20 degC  +1 K              +1",
        "change first: 10 % less of loss.P makes core 3 K colder",
    ] {
        assert!(ran.out.lines().any(|shown| words(shown) == words(line)), "{line}\n{}", ran.out);
    }
    let ran = folder.run(&["rank", "chain.toml", "--of", "shell", "--set", "G_skin=2W/K"]).exits(0);
    ran.prints("shell: 70 degC in steady state").prints("-5");
}

#[test]
fn rows_are_the_same_in_csv_and_json() {
    let folder = Folder::with("chain.toml", CHAIN);
    let ran = folder.run(&["rank", "chain.toml", "--format", "csv"]).exits(0);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[0], "name,kind,unit,changed_by,value [-],effect [K]");
    assert_eq!(lines.len(), 6);
    assert!(lines[1].starts_with("G_skin,parameter,W/K,+10 %,4,-2.5"), "{}", lines[1]);
    let json = folder.json("rank chain.toml").exits(0).json();
    assert_eq!(json["node"], "core");
    assert_eq!(json["rows"].as_array().unwrap().len(), 5);
    assert!(json["feedback"].is_null() && json["at"].is_null());
    assert!((json["temperature"]["value"].as_f64().unwrap() - 50.0).abs() < 1e-9);
}

#[test]
fn what_cannot_be_ranked_is_said() {
    let folder = Folder::with("chain.toml", CHAIN);
    folder.run(&["rank", "chain.toml", "--of", "gear"]).exits(2).says("network::unknown_name");
    folder.run(&["rank", "chain.toml", "--over", "run"]).exits(2).says("run::no_run");
    let empty = "format = 1\n[boundary]\nair = { T = \"20 degC\" }\n";
    Folder::with("empty.toml", empty).run(&["rank", "empty.toml"]).exits(2).says("network::empty");
    let loose = CHAIN.replace("from = \"shell\", to = \"air\"", "from = \"core\", to = \"shell\"");
    let ran = Folder::with("loose.toml", &loose).run(&["rank", "loose.toml"]);
    assert!(ran.exits(2).err.contains("steady::no_boundary"));
}

/// A parameter that changes nothing is listed: steady states do not depend on capacities.
#[test]
fn a_parameter_without_effect_is_listed() {
    let text = format!("{}\n", CHAIN.replace("[param]\n", "[param]\nspare = \"3 W\"\n"));
    let folder = Folder::with("chain.toml", &text);
    folder.run(&["rank", "chain.toml"]).exits(0).prints("no effect on core: `spare`");
    let rows = folder.json("rank chain.toml").exits(0).json()["rows"].clone();
    let row = rows.as_array().unwrap().iter().find(|row| row[0] == "spare").unwrap();
    assert_eq!(row.as_array().unwrap().last().unwrap().as_f64(), Some(0.0));
}

/// 10 % of 0 W is nothing, which is not "no effect": 1 W more into the core warms it by
/// 0.05 K/W + 1 / (4 W/K), over steady states and over a run that is long enough. 1 kW is not small:
/// 0.001 kW is the largest power of ten that warms by 1 K at most.
#[test]
fn a_value_of_zero_is_changed_by_a_little_of_its_unit() {
    let text = CHAIN
        .replace("[param]\n", "[param]\nz = \"0 kW\"\nidle = \"0 W\"\n")
        .replace("P = \"100 W\"", "P = \"100 [W] + z\"")
        + "[run]\nstop = \"10 h\"\n";
    let folder = Folder::with("chain.toml", &text);
    for over in ["steady", "run"] {
        let ran = folder.run(&["rank", "chain.toml", "--over", over]).exits(0);
        assert!(words(&ran.out).contains("z 0 kW +0.001 kW +0.3"), "{}", ran.out);
        let ran = folder.run(&["rank", "chain.toml", "--over", over, "--format", "csv"]).exits(0);
        let row = ran.out.lines().find(|line| line.starts_with("z,")).unwrap().to_owned();
        assert!(row.starts_with("z,parameter,kW,+0.001 kW,0,"), "{row}");
        let effect: f64 = row.rsplit(',').next().unwrap().parse().unwrap();
        assert!((effect - 0.3).abs() < 1e-4, "{row}");
        assert!(ran.out.lines().any(|line| line == "idle,parameter,W,+1 W,0,0"), "{}", ran.out);
    }
    // nothing else is there to change
    let alone = "format = 1\n[param]\nz = \"0 W\"\n[node]\na = { C = \"1 J/K\", T0 = \"20 degC\" }\n\
        b = { C = \"1 J/K\", T0 = \"20 degC\" }\n[resistor]\nr = { from = \"a\", to = \"b\", R = \"1 K/W\" \
        }\n[source]\ns = { into = \"a\", P = \"z\" }\nu = { into = \"a\", P = \"1 W\" }\n[run]\nstop = \"1 min\"\n";
    let folder = Folder::with("alone.toml", alone);
    folder
        .run(&["rank", "alone.toml", "--over", "run", "--of", "a"])
        .exits(0)
        .prints("a responds to no value that is not 0");
}

/// 100 W over 2 W/K + 50 W/(m^2 K) A into air of 20 degC: with A = 1e-4 m^2 the body is
/// 50 K - 100 W / (2.005 W/K) = 0.1247 K colder, and with 1 m^2 by 48.1 K, not by the 1250 K of the
/// slope. A source of 0 W warms by 0.5 K/W. Both are elements or parameters that are off.
#[test]
fn what_is_off_is_ranked_by_a_change_that_its_slope_describes() {
    let text = "format = 1\n[param]\nA_fin = \"0 m^2\"\n[node]\na = { C = \"100 J/K\", T0 = \"20 degC\" \
        }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nr = { from = \"a\", to = \"air\", G = \"2 [W/K] \
        + 50 [W/(m^2 K)] * A_fin\" }\n[source]\ns = { into = \"a\", P = \"100 W\" }\ns0 = { into = \"a\", P = \
        \"0 W\" }\n";
    let folder = Folder::with("fin.toml", text);
    let ran = folder.run(&["rank", "fin.toml"]).exits(0);
    assert!(words(&ran.out).contains("A_fin 0 m^2 +1e-4 m^2 -0.125"), "{}", ran.out);
    assert!(words(&ran.out).contains("s0.P 0 W +1 W +0.5"), "{}", ran.out);
    ran.prints("change first: 10 % more of r.G makes a 5 K colder");
    let rows = folder.json("rank fin.toml").exits(0).json()["rows"].clone();
    let effect = |name: &str| {
        let row = rows.as_array().unwrap().iter().find(|row| row[0] == name).unwrap();
        row.as_array().unwrap().last().unwrap().as_f64().unwrap()
    };
    let exact = 100.0 / 2.005 - 50.0;
    assert!((effect("A_fin") / exact - 1.0).abs() < 0.005, "{rows}");
    assert!((effect("s0.P") - 0.5).abs() < 1e-9, "{rows}");
}

/// Where something switches there are no derivatives by parameters, which is said.
#[test]
fn parameters_that_are_not_ranked_are_told() {
    let fan =
        "[control]\nfan = { sense = \"core\", on_above = \"80 degC\", off_below = \"70 degC\" }\n";
    let text = format!("{}{fan}", CHAIN.replace("G = \"G_skin\"", "G = \"G_skin * (1 + fan)\""));
    let ran = Folder::with("fan.toml", &text).run(&["rank", "fan.toml"]).exits(0);
    ran.prints("parameters are not ranked").prints("loss.P");
}
