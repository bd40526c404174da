//! Heat contents, and values that make no sense: one test for each fixed mistake.

use crate::common;

use common::{Folder, Ran, csv};

/// 0.1 kg of wax from 60 degC, 2 kJ/(kg K) and 200 kJ/kg, through 1 K/W to 20 degC.
fn wax(solidus: &str, liquidus: &str) -> String {
    format!(
        "format = 1\n[material]\nwax = {{ cp = \"2 kJ/(kg K)\", solidus = \"{solidus}\", liquidus \
         = \"{liquidus}\", \
         latent_heat = \"200 kJ/kg\" }}\n[node]\nw = {{ material = \"wax\", mass = \"0.1 kg\", T0 \
         = \"60 degC\" }}\n\
         [boundary]\nroom = {{ T = \"20 degC\" }}\n[resistor]\nr = {{ from = \"w\", to = \"room\", \
         R = \"1 K/W\" }}\n\
         [run]\nstop = \"1500 s\"\noutput = {{ every = \"50 s\" }}\n"
    )
}

/// Its temperature at a time in s, in degC: 40 K exp(-t / 200 s) over the room, a stand of 20 kJ at
/// the melting point.
fn wax_at(time: f64, melting: f64) -> f64 {
    let (tau, rise) = (200.0, melting - 20.0);
    let begin = tau * (40.0 / rise).ln();
    let end = begin + 20_000.0 / rise;
    if time < begin {
        20.0 + 40.0 * (-time / tau).exp()
    } else if time < end {
        melting
    } else {
        20.0 + rise * (-(time - end) / tau).exp()
    }
}

fn run(text: &str, column: &str) -> Vec<(f64, f64)> {
    let folder = Folder::with("x.toml", text);
    let ran =
        folder.run(&["run", "x.toml", "--no-files", "--format", "csv", "--select", column, "-q"]);
    let (_, rows) = csv(&ran.exits(0).out);
    rows.into_iter().map(|row| (row[0], row[1])).collect()
}

/// The same temperature in two units differs by the rounding of one of them: the whole latent heat
/// was lost, or the file was refused as liquidus below solidus.
#[test]
fn melting_at_one_temperature_may_be_written_in_two_units() {
    for (solidus, liquidus, melting) in [
        ("31.7 degC", "304.85 K", 31.7),
        ("304.85 K", "31.7 degC", 31.7),
        ("89.06 degF", "31.7 degC", 31.7),
        ("45.1 degC", "113.18 degF", 45.1),
    ] {
        for (time, found) in run(&wax(solidus, liquidus), "w.T") {
            let right = wax_at(time, melting);
            assert!(
                (found - right).abs() < 1e-4,
                "{solidus} {liquidus} at {time} s: {found}, not {right}"
            );
        }
    }
}

/// Widths that a double hardly resolves lost a part of the latent heat.
#[test]
fn melting_over_a_narrow_interval_keeps_its_heat() {
    for width in ["1e-12", "1e-11", "1e-10", "1e-9", "1e-8", "1e-7", "1e-6"] {
        let liquidus = format!("{} degC", 36.6 + width.parse::<f64>().unwrap());
        for (time, found) in run(&wax("36.6 degC", &liquidus), "w.T") {
            let right = wax_at(time, 36.6);
            assert!((found - right).abs() < 1e-4, "{width} K at {time} s: {found}, not {right}");
        }
    }
}

/// A liquidus that is below the solidus by more than rounding stays an error.
#[test]
fn a_liquidus_below_the_solidus_is_refused() {
    Folder::with("x.toml", &wax("36.6 degC", "36.59 degC")).run(&["check", "x.toml"]).exits(1);
}

/// The effective capacity of a change of phase: a Gaussian of 200 kJ/kg.
fn peak(at: f64, width: f64) -> String {
    let height = 2e5 / (width * (2.0 * std::f64::consts::PI).sqrt());
    format!(
        "2000 [J/(kg K)] + {height:?} [J/(kg K)] * exp(-0.5 * ((T - {at} [degC]) / {width} [K])^2)"
    )
}

/// The peak was lost where it fell between the points at which the capacity was looked at: 84 degC
/// after 500 s. The numbers are those of SciPy 1.16, t(T) = integral of m cp R / (90 degC - T) dT
/// by `quad` with the peak as a break, inverted by `brentq`.
#[test]
fn a_narrow_peak_of_a_capacity_is_not_lost() {
    let cases = [
        (47.3137, 0.5, 47.839_141_920_5),
        (50.0, 0.2, 50.151_827_093_1),
        (61.0, 0.01, 60.999_923_389),
        (61.0, 0.001, 60.999_923_389),
    ];
    for (at, width, right) in cases {
        let text = format!(
            "format = 1\n[material]\npcm = {{ cp = \"{}\" }}\n[node]\nw = {{ material = \"pcm\", \
             mass = \"0.1 kg\", \
             T0 = \"20 degC\" }}\n[boundary]\nb = {{ T = \"90 degC\" }}\n[resistor]\n\
             r = {{ from = \"w\", to = \"b\", R = \"1 K/W\" }}\n[run]\nstop = \"500 s\"\n",
            peak(at, width)
        );
        let found = run(&text, "w.T").last().unwrap().1;
        // a peak of 0.01 K is as good as a step in the heat: half a width
        let near = if width < 0.1 { width } else { 1e-4 };
        assert!((found - right).abs() < near, "{at} {width}: {found}, not {right}");
    }
}

/// A stream whose specific heat has a peak: 0.01 kg/s from 90 degC that leave at 40 degC give 0.01
/// (2000 * 50 + 200000) W = 3 kW, which 20/3000 K/W take to 20 degC. Without the peak it would be
/// 35.8 degC.
#[test]
fn a_narrow_peak_of_the_specific_heat_of_a_stream_is_not_lost() {
    for width in [0.3, 0.05, 0.001] {
        let text = format!(
            "format = 1\n[fluid]\nslurry = {{ cp = \"{}\" }}\n[node]\na = {{ C = \"100 J/K\", T0 \
             = \"20 degC\" }}\n\
             [boundary]\nhot = {{ T = \"90 degC\" }}\ncold = {{ T = \"20 degC\" }}\n[resistor]\n\
             r = {{ from = \"a\", to = \"cold\", R = \"0.00666666666666666667 K/W\" \
             }}\n[advection]\n\
             feed = {{ from = \"hot\", to = \"a\", fluid = \"slurry\", flow = \"0.01 kg/s\" }}\n\
             drain = {{ from = \"a\", to = \"cold\", fluid = \"slurry\", flow = \"0.01 kg/s\" }}\n",
            peak(61.3137, width)
        );
        let folder = Folder::with("x.toml", &text);
        let ran =
            folder.run(&["steady", "x.toml", "--format", "csv", "--select", "a.T", "-q"]).exits(0);
        let found = csv(&ran.out).1[0][0];
        assert!((found - 40.0).abs() < 1e-6, "{width}: {found}");
    }
}

/// A capacity that nothing can follow is refused with its place.
#[test]
fn a_capacity_that_changes_too_quickly_is_refused() {
    let text = wax("50 degC", "50 degC")
        .replace("2 kJ/(kg K)\"", "2 [kJ/(kg K)] * (1.1 + sin(kelvin(T) / 1e-9 [K]))\"");
    Folder::with("x.toml", &text)
        .run(&["check", "x.toml"])
        .exits(1)
        .prints("network::capacity_too_quick");
}

/// A block that 150 W heat, with a resistance and the temperature of the room as parameters.
const BLOCK: &str = "format = 1\n[param]\nT_room = \"25 degC\"\nR_skin = \"0.3 K/W\"\nc = \"475 \
    J/(kg K)\"\n\
    [material.steel]\ncp = \"c + 0 [J/(kg K^2)] * (T - 20 [degC])\"\n[node]\n\
    block = { material = \"steel\", mass = \"1.2 kg\", T0 = \"25 degC\" }\nrim = { massless = true \
    }\n\
    [boundary]\nroom = { T = \"T_room\" }\n[resistor]\nweb = { from = \"block\", to = \"rim\", R \
    = \"7 mK/W\" }\n\
    skin = { from = \"rim\", to = \"room\", R = \"R_skin\" }\n[source]\nP = { into = \"block\", P \
    = \"150 W\" }\n\
    [limit]\nhot = { of = \"block.T\", below = \"110 degC\" }\n[run]\nstop = \"25 min\"\n";

fn block(arguments: &[&str]) -> Ran {
    Folder::with("x.toml", BLOCK).run(arguments)
}

/// `--set T_room=25K` ran at -248 degC, where the same text in the file is an error.
#[test]
fn kelvin_set_for_an_absolute_temperature_is_refused_as_in_the_file() {
    block(&["run", "x.toml", "--no-files", "--set", "T_room=25K"])
        .exits(2)
        .says("units::absolute_wanted")
        .says(
            "`--set \"T_room=25 degC\"`, or `--set \"T_room=absolute(25 [K])\"` if kelvin is meant",
        );
    // 30 degC is likelier than 303 degC
    block(&["run", "x.toml", "--no-files", "--set", "T_room=303K"]).exits(2).says(
        "write `--set \"T_room=absolute(303 [K])\"`, or `--set \"T_room=303 degC\"` if degrees",
    );
    let ran = block(&["steady", "x.toml", "--format", "csv", "--set", "T_room=absolute(300 [K])"])
        .exits(0);
    assert!(ran.out.contains("26.85"), "{}", ran.out);
    block(&["steady", "x.toml", "--set", "T_room=300 K"]).exits(2);
    block(&["steady", "x.toml", "--set", "T_room=80 degF"]).exits(0);
}

/// `below = "110 K"` of a temperature meant -163 degC.
#[test]
fn a_bound_in_kelvin_for_an_absolute_temperature_is_refused() {
    let with = |bound: &str| Folder::with("x.toml", &BLOCK.replace("110 degC", bound));
    with("110 K")
        .run(&["check", "x.toml"])
        .exits(1)
        .prints("`below = \"110 degC\"`, or `below = \"absolute(110 [K])\"` if kelvin is meant");
    with("absolute(383.15 [K])").run(&["check", "x.toml"]).exits(0);
    let difference =
        BLOCK.replace("block.T\", below = \"110 degC\"", "block.T - room.T\", below = \"110 K\"");
    Folder::with("x.toml", &difference).run(&["check", "x.toml"]).exits(0);
}

/// The range of a parameter has the type of the parameter, which is not that of a field.
#[test]
fn other_values_of_a_parameter_follow_the_rule_too() {
    let size = "[size.s]\nminimise = \"T_room\"\nvary = { T_room = { from = \"280 K\", to = \"300 \
        degC\" } }\n\
        require = [\"block.T < 90 [degC]\"]\n";
    let folder = Folder::with("x.toml", &format!("{BLOCK}{size}"));
    folder
        .run(&["check", "x.toml"])
        .exits(1)
        .prints("write `\"absolute(280 [K])\"`, or `\"280 degC\"` if degrees Celsius are meant");
    let template = "format = 1\n[template.part]\nparam = { T_air = \"25 degC\" \
        }\n[template.part.node]\n\
        a = { C = \"10 J/K\", T0 = \"20 degC\" }\n[template.part.boundary]\nair = { T = \"T_air\" \
        }\n\
        [template.part.resistor]\nr = { from = \"a\", to = \"air\", R = \"1 K/W\" }\n[use.one]\n\
        template = \"part\"\nset = { T_air = \"25 K\" }\n";
    let ran = Folder::with("x.toml", template).run(&["check", "x.toml"]).exits(1);
    assert!(ran.out.contains("units::absolute_wanted"), "{}", ran.out);
}

/// A start at 25 K among degrees Celsius was taken without a word.
#[test]
fn a_cold_start_in_kelvin_beside_degrees_celsius_is_a_warning() {
    let text = BLOCK.replace("T0 = \"25 degC\"", "T0 = \"25 K\"");
    let ran = Folder::with("x.toml", &text).run(&["check", "x.toml"]).exits(0);
    assert!(ran.out.contains("netlist::cold"), "{}", ran.out);
    assert!(ran.out.contains("did you mean `T0 = \"25 degC\"`?"), "{}", ran.out);
}

/// A thousandth taken for a million: 1.2e9 degC and exit code 0 without a word.
#[test]
fn a_result_beyond_sense_names_the_node_the_path_and_the_source() {
    for verb in ["run", "steady"] {
        let mut arguments = vec![verb, "x.toml", "--set", "R_skin=8 MK/W", "--format", "json"];
        if verb == "run" {
            arguments.extend(["--no-files", "--set", "T_room=25 degC"]);
        }
        let ran = Folder::with("x.toml", &BLOCK.replace("25 min", "10 h")).run(&arguments);
        let json = ran.json();
        let found = json["warnings"].as_array().unwrap();
        let beyond = found.iter().find(|w| w["code"] == "run::beyond_sense").unwrap();
        assert!(
            beyond["message"].as_str().unwrap().starts_with("node `block` reaches "),
            "{beyond}"
        );
        assert!(beyond["help"].as_str().unwrap().ends_with("`skin` and `P`"), "{beyond}");
        assert!(found.iter().any(|w| w["code"] == "network::decades_apart"), "{}", ran.out);
    }
    let folder = Folder::with("x.toml", BLOCK);
    folder.write("y.toml", &BLOCK.replace("\"0.3 K/W\"", "\"8 MK/W\"").replace("25 min", "10 h"));
    folder.run(&["compare", "x.toml", "y.toml"]).says("run::beyond_sense");
}

/// The run is plausible as far as it goes, but not the steady state that its table shows.
#[test]
fn an_implausible_steady_state_of_a_plausible_run_is_a_warning() {
    let folder = Folder::with("x.toml", BLOCK);
    let ran = folder.run(&["run", "x.toml", "--set", "R_skin=8 MK/W", "--no-files"]).exits(1);
    ran.says("run::beyond_sense").says("degC in steady state, which is not plausible");
}

/// Resistances that meet in a node and are many decades apart are named, both of them.
#[test]
fn resistances_many_decades_apart_are_named() {
    let text = BLOCK.replace("\"0.3 K/W\"", "\"8 MK/W\"");
    let ran = Folder::with("x.toml", &text).run(&["check", "x.toml"]).exits(0);
    assert!(
        ran.out.contains("resistor `skin`, 8e6 K/W, and resistor `web`, 0.007 K/W"),
        "{}",
        ran.out
    );
    let ran = block(&["check", "x.toml"]).exits(0);
    assert!(!ran.out.contains("decades"), "{}", ran.out);
}

/// The check of materials saw literals only.
#[test]
fn an_implausible_property_is_seen_through_parameters() {
    let ran = Folder::with("x.toml", &BLOCK.replace("475 J/(kg K)", "0.475 J/(kg K)"))
        .run(&["check", "x.toml"]);
    assert!(
        ran.out.contains("`cp` of material `steel` is 0.475 J/(kg K) at 25 degC"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("did you mean 0.475 J/(g K)?"), "{}", ran.out);
    block(&["steady", "x.toml", "--set", "c=0.475 J/(kg K)"]).says("netlist::implausible_property");
    let ran = block(&["check", "x.toml"]).exits(0);
    assert!(!ran.out.contains("implausible"), "{}", ran.out);
}

const LUMPS: &str = r#"format = 1
[node]
a = { C = "1 kJ/K", T0 = "25 degC" }
b = { C = "3 kJ/K", T0 = "25 degC" }
c = { C = "2 kJ/K", T0 = "25 degC" }
[boundary]
room = { T = "25 degC" }
space = { T = "2.7 K" }
[conduction]
wall = { shape = "slab", from = "a", to = "b", thickness = "8 mm", area = "1 m^2", k = "50 W/(m K)" }
[convection]
skin = { from = "b", to = "room", h = "12 W/(m^2 K)", area = "0.1 m^2" }
[resistor]
seat = { from = "b", to = "c", R = "8 mK/W" }
[radiation]
sky = { from = "c", to = "space", area = "0.01 m^2", emissivity = 0.8 }
"#;

/// One slip each: a scale, a prefix, a unit of length.
#[test]
fn a_slip_of_a_prefix_or_a_scale_is_asked_about() {
    let check = |from: &str, to: &str| {
        assert!(LUMPS.contains(from), "{from}");
        let folder = Folder::with("x.toml", &LUMPS.replacen(from, to, 1));
        folder.run(&["check", "x.toml"]).exits(0)
    };
    let ran = check("format = 1", "format = 1");
    assert!(ran.err.is_empty() && !ran.out.contains("warning["), "{}{}", ran.out, ran.err);
    for (from, to, code, asks) in [
        ("room = { T = \"25 degC\" }", "room = { T = \"298 degC\" }", "kelvin", "\"298 K\""),
        ("T0 = \"25 degC\"", "T0 = \"293.15 degC\"", "kelvin", "\"293.15 K\""),
        ("\"1 kJ/K\"", "\"1.2 J/K\"", "implausible_value", "1.2 kJ/K"),
        ("\"12 W/(m^2 K)\"", "\"12 kW/(m^2 K)\"", "implausible_value", "12 W/(m^2 K)"),
        ("\"8 mm\"", "\"8 m\"", "implausible_value", "8 mm"),
        ("\"8 mK/W\"", "\"8 MK/W\"", "decades_apart", "prefix"),
    ] {
        let ran = check(from, to);
        let said = format!("{}{}", ran.out, ran.err);
        assert!(said.contains(code) && said.contains(asks), "{to}: {said}");
    }
    let alone = LUMPS.replace("\"8 mK/W\"", "\"8 MK/W\"").replace("sky = {", "# sky = {");
    let ran = Folder::with("x.toml", &alone).run(&["check", "x.toml"]);
    assert!(ran.out.contains("network::time_constant"), "{}", ran.out);
}

/// None of this is said of networks as they should be, deep space and absolute zero included.
#[test]
fn networks_that_make_sense_are_left_alone() {
    let networks = concat!(env!("CARGO_MANIFEST_DIR"), "/../../networks");
    let folder = Folder::empty();
    let mut seen = 0;
    for entry in std::fs::read_dir(networks).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let path = path.display().to_string();
        for arguments in
            [vec!["check", &path], vec!["run", &path, "--no-files"], vec!["steady", &path]]
        {
            let ran = folder.run(&arguments);
            for code in [
                "run::beyond_sense",
                "network::decades_apart",
                "network::time_constant",
                "netlist::cold",
                "netlist::kelvin",
                "implausible",
            ] {
                assert!(
                    !ran.err.contains(code) && !ran.out.contains(code),
                    "{arguments:?}: {}",
                    ran.err
                );
            }
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

/// Two hot bodies and two cold ones, each pair exchanging 1.3e308 J: every sum of heats that is
/// stored is beyond what a number holds, so the balance cannot close, while temperatures can be
/// computed as of any network.
fn unbalanced() -> Folder {
    let text = "format = 1\n[param]\nk = '1 ± 0.1'\n[signal]\nP = '0 W'\n[node]\n\
        c1 = { C = '1e307 J/K', T0 = '20 degC' }\nc2 = { C = '1e307 J/K', T0 = '20 degC' }\n\
        h1 = { C = '1e307 J/K', T0 = '46 degC' }\nh2 = { C = '1e307 J/K', T0 = '46 degC' }\n\
        [boundary]\nair = { T = '20 degC' }\n[resistor]\n\
        r1 = { from = 'h1', to = 'c1', G = 'k * 1e305 [W/K]' }\n\
        r2 = { from = 'h2', to = 'c2', G = '1e305 W/K' }\n\
        s1 = { from = 'c1', to = 'air', G = '1e303 W/K' }\n\
        s2 = { from = 'c2', to = 'air', G = '1e303 W/K' }\n\
        [source]\ns = { into = 'h1', P = 'P' }\n[limit]\nhot = { of = 'h1.T', below = '50 degC' }\n\
        [run]\nstop = '1000 s'\n\
        [fit.f]\ndata = 'r.csv'\ncolumn = { x = 'h1.T' }\nvary = { k = { from = 0.1, to = 10 } }\n\
        [infer.i]\ndata = 'r.csv'\ncolumn = { x = 'h1.T' }\nsigma = '0.1 K'\nfind = ['P']\n\
        [sweep.w]\nmethod = 'grid'\nover = 'run'\naxes.k = [1, 2]\nreport.top = 'max(h1.T)'\n\
        [size.z]\nminimise = 'k'\nover = 'run'\nvary = { k = { from = 0.1, to = 5 } }\n\
        require = ['h1.T <= 48 [degC]']\n";
    let folder = Folder::with("x.toml", text);
    let row = |k: u32| {
        let t = 10.0 * f64::from(k);
        format!("{t},{}\n", 33.0 + 13.0 * f64::exp(-0.02 * t))
    };
    let rows: String = (0..=100).map(row).collect();
    folder.write("r.csv", &format!("t [s],x [degC]\n{rows}"));
    let settled = text.replace(
        "P = '0 W'\n",
        "P = { t = [0, 50], v = [0, 1], t_unit = 's', v_unit = 'W', interp = 'previous', after_end = \
         'repeat', period = '100 s' }\n",
    );
    let (before, rest) = settled.split_once("[infer.i]").expect("it infers");
    let (_, after) = rest.split_once("[sweep.w]").expect("it sweeps");
    folder.write("cycle.toml", &format!("{before}[sweep.w]{after}"));
    folder
}

/// One place asks whether the energy balance of a run closes, so whoever computes one is told.
#[test]
fn a_run_whose_balance_does_not_close_is_no_result_of_any_verb() {
    let folder = unbalanced();
    for words in [
        "run x.toml --no-files",
        "run x.toml --no-files --uncertainty linear",
        "fit network x.toml",
        "infer x.toml",
        "reduce x.toml --port h1",
        "rank x.toml --over run",
        "size x.toml",
        "compare x.toml x.toml",
        "compare x.toml x.toml --uncertainty",
        "compare cycle.toml cycle.toml",
        "verify x.toml",
        "graph x.toml --at 500s",
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        folder.run(&words).exits(3).says("run::ledger");
    }
    folder.run(&["sweep", "x.toml"]).exits(3).prints("2 candidates failed with run::ledger");
}
