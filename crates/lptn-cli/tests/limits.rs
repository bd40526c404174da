//! Limits, materials, include and what `check` adds, from the command line.

use crate::common;

use common::Folder;

/// C = 100 J/K, R = 0.5 K/W, P = 100 W: 50 K above 20 degC, tau = 50 s.
const NET: &str = "format = 1\n[param]\nT_max = \"60 degC\"\n[node]\na = { T0 = \"20 degC\", C \
    = \"100 J/K\" }\n\
                   [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nr = { from = \"a\", to \
                   = \"air\", R = \"0.5 K/W\" }\n\
                   [source]\np = { into = \"a\", P = \"100 W\" }\n[run]\nstop = \"1000 s\"\n\
                   [limit]\nhot = { of = \"a.T\", below = \"T_max\" }\n\
                   warm = { of = \"a.T - air.T\", below = \"45 K\", severity = \"warning\" }\n";

#[test]
fn a_broken_limit_ends_with_1_and_the_last_line_says_which() {
    let folder = Folder::with("net.toml", NET);
    // 40 K of 50 K are reached after 50 ln 5 = 80.47 s
    let ran = folder.run(&["run", "net.toml", "--no-files"]).exits(1).says("limit::exceeded");
    let last = "limit broken: `hot` (a.T below 60 degC) by 10 K at 16.67 min, first at 80.47 s";
    assert_eq!(ran.err.lines().last(), Some(last));
    let ran = folder.run(&["steady", "net.toml"]).exits(1);
    assert_eq!(
        ran.err.lines().last(),
        Some("limit broken: `hot` (a.T below 60 degC) by 10 K in steady state")
    );
}

#[test]
fn a_warning_changes_no_exit_code() {
    let folder = Folder::with("net.toml", NET);
    for verb in ["run", "steady"] {
        let ran = folder.run(&[verb, "net.toml", "--set", "T_max=80degC"]).exits(0).says("`warm`");
        ran.prints("kept").prints("exceeded");
    }
}

#[test]
fn json_has_each_limit_with_its_margin() {
    let folder = Folder::with("net.toml", NET);
    let json = folder.run(&["run", "net.toml", "--no-files", "--format", "json"]).exits(1).json();
    let hot = &json["limits"]["hot"];
    assert_eq!((hot["kept"].as_bool(), hot["margin"]["unit"].as_str()), (Some(false), Some("K")));
    let near = |value: &serde_json::Value, exact: f64| {
        (value["value"].as_f64().unwrap() - exact).abs() < 1e-3
    };
    assert!(near(&hot["margin"], -10.0) && near(&hot["broken_at"], 50.0 * 5.0_f64.ln()), "{hot}");
    let json = folder.run(&["steady", "net.toml", "--format", "json"]).exits(1).json();
    assert!(near(&json["limits"]["warm"]["margin"], -5.0), "{json}");
    assert!(json["limits"]["warm"]["broken_at"].is_null());
}

/// The values of the closed form above; `cold` is nearest to being broken at the start.
#[test]
fn the_manifest_says_what_became_of_every_limit() {
    let folder =
        Folder::with("net.toml", &format!("{NET}cold = {{ of = \"a.T\", above = \"10 degC\" }}\n"));
    // the manifest is in K whatever is shown
    let shown = ["run", "net.toml", "--format", "json", "--temperature-unit", "K"];
    let json = folder.run(&shown).exits(1).json();
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    let limits = &manifest["limits"];
    assert_eq!(limits, &json["limits"]);
    assert_eq!(limits.as_object().unwrap().keys().collect::<Vec<_>>(), ["hot", "warm", "cold"]);
    let expected = [
        (
            "hot",
            "a.T",
            "below",
            "error",
            [333.15, 343.15, -10.0, 1000.0],
            Some(50.0 * 5.0_f64.ln()),
        ),
        (
            "warm",
            "a.T - air.T",
            "below",
            "warning",
            [45.0, 50.0, -5.0, 1000.0],
            Some(50.0 * 10.0_f64.ln()),
        ),
        ("cold", "a.T", "above", "error", [283.15, 293.15, 10.0, 0.0], None),
    ];
    for (name, of, side, severity, numbers, broken_at) in expected {
        let limit = &limits[name];
        assert_eq!((&limit["of"], &limit["severity"]), (&of.into(), &severity.into()), "{limit}");
        assert_eq!(limit["kept"], broken_at.is_none());
        for ((key, unit), exact) in
            [(side, "K"), ("worst", "K"), ("margin", "K"), ("worst_at", "s")].iter().zip(numbers)
        {
            let found =
                limit[key]["value"].as_f64().unwrap_or_else(|| panic!("no {key} in {limit}"));
            assert!(
                (found - exact).abs() < 1e-3 && limit[key]["unit"] == *unit,
                "{name} {key} {found} {exact}"
            );
        }
        let broken = limit["broken_at"]["value"].as_f64();
        assert_eq!(broken.is_some(), broken_at.is_some(), "{limit}");
        assert!(
            broken.zip(broken_at).is_none_or(|(found, exact)| (found - exact).abs() < 1e-3),
            "{limit}"
        );
    }
}

#[test]
fn quiet_still_says_why_the_exit_code_is_1() {
    let folder = Folder::with("net.toml", NET);
    for (verb, last) in [
        ("run", "limit broken: `hot` (a.T below 60 degC) by 10 K at 16.67 min, first at 80.47 s"),
        ("steady", "limit broken: `hot` (a.T below 60 degC) by 10 K in steady state"),
        ("compare", "limit broken: net breaks hot"),
    ] {
        for format in ["table", "csv", "json"] {
            let ran = folder
                .run(&[verb, "net.toml", "--no-files", "--quiet", "--format", format])
                .exits(1);
            assert_eq!(ran.err.trim_end(), last, "{verb} {format}");
        }
        // a broken limit of severity warning is a warning
        let ran = folder
            .run(&[verb, "net.toml", "--no-files", "--quiet", "--set", "T_max=80degC"])
            .exits(0);
        assert_eq!(ran.err, "", "{verb}");
    }
}

#[test]
fn the_manifest_lists_every_file() {
    let folder = Folder::with("net.toml", &format!("include = [\"more.toml\"]\n{NET}"));
    folder.write("more.toml", "format = 1\n[source]\nq = { into = \"a\", P = \"1 W\" }\n");
    folder.run(&["run", "net.toml"]).exits(1);
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/net/manifest.json")).unwrap();
    assert_eq!(manifest["inputs"][0]["name"], "net.toml");
    assert_eq!(manifest["inputs"][1]["name"], "more.toml");
    assert_ne!(manifest["inputs"][0]["sha256"], manifest["inputs"][1]["sha256"]);
    let ran =
        folder.run_with(&["check", "-"], &format!("include = [\"more.toml\"]\n{NET}")).exits(1);
    ran.prints("netlist::include_without_folder");
}

#[test]
fn materials_are_listed_with_their_sources() {
    let folder = Folder::empty();
    let ran = folder.run(&["materials"]).exits(0).prints("steel_8620").prints("gear_oil_vg220");
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    folder.run(&["materials", "steel_8620"]).exits(0).prints("AZoM").prints("475 J/(kg K)");
    let json = folder.run(&["materials", "--format", "json"]).exits(0).json();
    assert_eq!(json["materials"]["aluminium_6061"]["cp"]["value"], 896.0);
    assert_eq!(json["fluids"]["air"]["T"]["unit"], "K");
    let oil = &json["lubricants"]["iso_vg_220"];
    assert!((oil["nu_100"]["value"].as_f64().unwrap() - 18.75e-6).abs() < 5e-9, "{oil}");
    folder.run(&["materials", "pao_vg_220"]).exits(0).prints("25.58 mm^2/s").prints("GEARpie");
    folder.run(&["materials", "pao_vg_22"]).exits(2).says("did you mean `pao_vg_220`?");
    let csv = folder.run(&["materials", "--format", "csv"]).exits(0).out;
    assert!(csv.contains("iso_vg_32,lubricant,902,,,,"), "{csv}");
    assert!(
        csv.starts_with(
            "name,kind,density [kg/m^3],cp [J/(kg K)],k [W/(m K)],k_through [W/(m K)],T [K],title,source\n"
        )
    );
    folder.run(&["materials", "steel_8260"]).exits(2).says("did you mean `steel_8620`?");
}

#[test]
fn check_names_the_stiffness_and_the_specific_heat_of_the_paper() {
    let text = NET.replace("C = \"100 J/K\"", "material = \"m\", mass = \"1 kg\"");
    let text = format!("{text}[material]\nm = {{ cp = \"0.475 J/(kg K)\" }}\n");
    let folder = Folder::with("net.toml", &text);
    let ran =
        folder.run(&["check", "net.toml", "-v"]).exits(0).prints("did you mean 0.475 J/(g K)?");
    // C / G = 0.475 x 0.5 s
    ran.prints("stiffness: C / sum of G is 237 ms (a)").prints("1 warning");
    let two =
        NET.replace("[source]", "[node.b]\nT0 = \"20 degC\"\nC = \"1 J/K\"\n[source]").replace(
            "[source]",
            "[convection]\ns = { from = \"a\", to = \"b\", R = \"0.5 K/W\" }\n[source]",
        );
    folder.write("two.toml", &two);
    // a: 100 / (2 + 2) s, b: 1 / 2 s
    folder
        .run(&["check", "two.toml", "-v"])
        .exits(0)
        .prints("stiffness: 50, C / sum of G is 500 ms (b) to 25 s (a)");
    let json = folder.run(&["check", "two.toml", "--format", "json"]).exits(0).json();
    assert_eq!(json["stiffness"]["ratio"]["value"], 50.0);
}

/// A junction without capacity over 1 K/W follows a pulse of 100 W: 120 degC at its top, 20 K above
/// the limit, which it passes 30 s sqrt(ln(10/8)) before, and 100 W 30 s sqrt(pi) = 5317.36 J.
#[test]
fn what_a_network_without_capacity_does_between_rows_does_not_depend_on_them() {
    let net = "format = 1\nnode.junction = { massless = true }\nboundary.air = { T = \"20 degC\" }\n\
               resistor.out = { from = \"junction\", to = \"air\", R = \"1 K/W\" }\n\
               source.loss = { into = \"junction\", \
               P = \"100 [W] * exp(-((t - 1234 [s]) / 30 [s])^2)\" }\n\
               limit.hot = { of = \"junction.T\", below = \"100 degC\" }\nrun.stop = \"1 h\"\n";
    let folder = Folder::with("net.toml", net);
    let near = |value: &serde_json::Value, exact: f64, within: f64| {
        let found = value["value"].as_f64().unwrap_or(f64::NAN);
        assert!((found - exact).abs() < within, "{value} {exact}");
    };
    let passes = 1234.0 - 30.0 * (100.0_f64 / 80.0).ln().sqrt();
    for every in ["1h", "17min", "12s", "1s"] {
        let run = ["run", "net.toml", "--no-files", "--format", "json", "--every", every];
        let json = folder.run(&run).exits(1).json();
        near(&json["limits"]["hot"]["margin"], -20.0, 1e-6);
        near(&json["limits"]["hot"]["broken_at"], passes, 1e-5);
        folder.run(&["run", "net.toml", "--no-files", "--every", every]).prints("5.317 kJ");
    }
    let csv = folder.run(&["compare", "net.toml", "--format", "csv"]).exits(1).out;
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (head, row) = (lines.next().unwrap(), lines.next().unwrap());
    let number = |name: &str| -> f64 {
        let place = head.iter().position(|column| column.starts_with(name)).unwrap();
        row[place].parse().unwrap()
    };
    assert!((number("hot.margin") + 20.0).abs() < 1e-6, "{csv}");
    let heat = 3000.0 * std::f64::consts::PI.sqrt();
    assert!((number("heat") - heat).abs() < 1e-6 * heat, "{csv}");
}

/// A body that warms evenly by 0.6 K/min for 10 min has 3 K more than at the start in the mean.
#[test]
fn the_mean_of_one_value_is_that_over_the_run() {
    let net = "format = 1\n[param]\nP = \"10 W\"\n[node]\na = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n\
               [source]\ns = { into = \"a\", P = \"P\" }\n[run]\nstop = \"10 min\"\n[limit]\n\
               average = { of = \"mean(a.T)\", below = \"22 degC\" }\n\
               most = { of = \"a.T\", below = \"25 degC\" }\n\
               [size.most]\nmaximise = \"P\"\nvary = { P = { from = \"1 W\", to = \"100 W\" } }\n\
               require = [\"mean(a.T) <= 24 [degC]\"]\nover = \"run\"\n";
    let folder = Folder::with("net.toml", net);
    let json = folder.run(&["run", "net.toml", "--no-files", "--format", "json"]).exits(1).json();
    let near = |value: &serde_json::Value, exact: f64| {
        let found = value["value"].as_f64().unwrap_or(f64::NAN);
        assert!((found - exact).abs() < 1e-4, "{value} {exact}");
    };
    near(&json["limits"]["average"]["margin"], -1.0);
    near(&json["limits"]["average"]["broken_at"], 600.0);
    near(&json["limits"]["most"]["margin"], -1.0);
    near(&json["limits"]["most"]["broken_at"], 500.0);
    let size = folder.run(&["size", "net.toml"]).exits(0);
    size.prints("over the run of 10 min").prints("P = 13.333");
}

/// The rise is P R (1 - exp(-t/tau)) with R = 0.5 K/W and tau = 500 s. It is above 40 K for 200 s of
/// 1000 s if it reaches 40 K at 800 s; its integral is P R (1000 s - tau (1 - exp(-2))).
#[test]
fn numbers_over_time_are_limits_and_requirements_and_stay_in_an_expansion() {
    let net = "format = 1\n[param]\nP = \"160 W\"\n[node]\na = { C = \"1 kJ/K\", T0 = \"20 degC\" }\n\
               [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nr = { from = \"a\", to = \"air\", R = \
               \"0.5 K/W\" }\n[source]\ns = { into = \"a\", P = \"P\" }\n[run]\nstop = \"1000 s\"\n[limit]\n\
               hot = { of = \"time_over(a.T, 60 [degC])\", below = \"200 s\" }\n\
               heat = { of = \"integral(r.Q)\", below = \"100 kJ\" }\n\
               [size.most]\nmaximise = \"P\"\nvary = { P = { from = \"50 W\", to = \"300 W\" } }\n\
               require = [\"200 [s] >= time_over(a.T, 60 [degC])\"]\nover = \"run\"\n";
    let folder = Folder::with("net.toml", net);
    let flat = folder.run(&["check", "net.toml", "--expand"]).exits(0).out;
    folder.write("flat.toml", &flat);
    for file in ["net.toml", "flat.toml"] {
        let json = folder.run(&["run", file, "--no-files", "--format", "json"]).exits(1).json();
        let near = |name: &str, exact: f64| {
            let found = json["limits"][name]["margin"]["value"].as_f64().unwrap_or(f64::NAN);
            assert!(
                (found - exact).abs() < 1e-3 * (1.0 + 1e-3 * exact.abs()),
                "{name} {found} {exact}"
            );
        };
        near("hot", 200.0 - 1000.0 - 500.0 * (-40.0_f64 / 80.0).ln_1p());
        near("heat", 1e5 - 160.0 * (1000.0 + 500.0 * (-2.0_f64).exp_m1()));
        // 80 W / (1 - exp(-1.6)) = 100.2370 W
        let size = folder.run(&["size", file]).exits(0);
        size.prints("over the run of").prints("P = 100.237");
        let steady = folder.run(&["steady", file]).exits(0);
        steady.prints("not judged");
    }
}
