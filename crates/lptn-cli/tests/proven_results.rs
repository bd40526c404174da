//! `--certify`: bounds on results that follow from temperatures, against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use serde_json::Value;

use crate::common::{Folder, csv};

/// 10 W into 100 J/K, tied to air of 20 degC by 1 W/K: a rise of `10 (1 - exp(-t / 100 s))` K.
const WARMS: &str = r#"format = 1
[node]
body = { C = "100 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[resistor]
skin = { from = "body", to = "air", G = "1 W/K" }
[source]
heat = { into = "body", P = "10 W" }
[limit]
warm = { of = "body.T", below = "25 degC" }
much = { of = "skin.Q", below = "9 W" }
near = { of = "skin.Q", below = "9.932621 W" }
usual = { of = "mean(skin.Q)", below = "8.0134759 W" }
[run]
stop = "500 s"
output = { every = "50 s" }
[run.report]
square = "skin.Q ^ 2"
total = "integral(skin.Q)"
above = "time_over(body.T, 25 [degC])"
top = "max(body.T)"
rise = "mean(body.T - air.T)"
"#;

/// The rise in K, also the heat of `skin` in W.
fn rise(time: f64) -> f64 {
    -10.0 * (-time / 100.0).exp_m1()
}

/// The gearbox at 25 min: its matrix exponential in decimal numbers of 60 digits. The heat between
/// its parts is 130 W/K times a difference of temperatures that err together.
#[test]
fn two_nodes_are_within_their_bounds() {
    let folder = Folder::with("net.toml", include_str!("../../../networks/gearbox.toml"));
    for (text, tolerance) in TOLERANCES {
        let words =
            ["run", "net.toml", "--certify", "--format", "csv", "--no-files", "--tolerance"];
        let (headers, rows) = csv(&folder.run(&[&words[..], &[text]].concat()).out);
        let at = |name: &str| headers.iter().position(|header| header == name).unwrap();
        let (heat, bound) = (at("internal.Q [W]"), at("internal.Q.bound [W]"));
        let last = rows.last().unwrap();
        within("internal", (last[heat], last[bound]), 204.909_825_494_759_3, 1e4 * tolerance);
        let found = folder.json(&format!("run net.toml --certify --no-files --tolerance {text}"));
        let found = found.json();
        for (name, right) in [("bed", 126_899.320_000_689_5), ("air", 54_385.422_857_438_36)] {
            let given = &found["ledger"]["boundaries"][name];
            let given = (number(given), number(&found["proven_heat"][name]));
            within(name, given, -right, 1e5 * tolerance);
        }
    }
}

fn number(of: &Value) -> f64 {
    of["value"].as_f64().unwrap_or_else(|| panic!("{of}"))
}

/// A number is within its bound of the right one, and the bound is at most `most`. Gives the error
/// over its bound.
fn within(what: &str, (value, bound): (f64, f64), right: f64, most: f64) -> f64 {
    let error = (value - right).abs();
    assert!(error <= bound, "{what}: {value} is {error:e} from {right}, bound {bound:e}");
    assert!(bound <= most, "{what}: bound {bound:e} is above {most:e}, error {error:e}");
    error / bound
}

/// The bounds are so close that half of them would be exceeded.
fn is_close(what: &str, shares: &[f64]) {
    let most = shares.iter().copied().fold(0.0, f64::max);
    assert!(most > 0.5, "{what}: the error is {most} of its bound at most");
}

const TOLERANCES: [(&str, f64); 3] = [("1e-3K", 1e-3), ("1e-5K", 1e-5), ("1e-7K", 1e-7)];

#[test]
fn rows_of_heats_and_reports_are_within_their_bounds() {
    let folder = Folder::with("warms.toml", WARMS);
    let words = ["run", "warms.toml", "--certify", "--format", "csv", "--no-files"];
    for (text, tolerance) in TOLERANCES {
        let ran = folder.run(&[&words[..], &["--tolerance", text]].concat());
        let (headers, rows) = csv(&ran.out);
        let at = |name: &str| headers.iter().position(|header| header == name);
        let column = |name: &str| at(name).unwrap_or_else(|| panic!("{name}: {headers:?}"));
        let mut shares = [const { Vec::new() }; 3];
        for row in rows {
            let right = rise(row[0]);
            let of = |name: &str, bound: &str| (row[column(name)], row[column(bound)]);
            let most = 100.0 * tolerance;
            let (skin, air) =
                (of("skin.Q [W]", "skin.Q.bound [W]"), of("air.Q [W]", "air.Q.bound [W]"));
            shares[0].push(within("skin", skin, right, most));
            shares[1].push(within("air", air, -right, most));
            let square = of("square [kg^2 m^4/s^6]", "square.bound [kg^2 m^4/s^6]");
            shares[2].push(within("square", square, right * right, 20.0 * most));
        }
        shares.iter().for_each(|shares| is_close(text, shares));
    }
}

#[test]
fn numbers_over_the_run_are_within_their_bounds() {
    let folder = Folder::with("warms.toml", WARMS);
    let energy = 5000.0 - 100.0 * rise(500.0);
    let crossing = 100.0 * std::f64::consts::LN_2;
    for (text, tolerance) in TOLERANCES {
        let words = format!("run warms.toml --certify --no-files --tolerance {text}");
        let found = folder.json(&words).json();
        let most = 100.0 * tolerance;
        let heat = |name: &str, kind: &str| {
            (number(&found["ledger"][kind][name]), number(&found["proven_heat"][name]))
        };
        within("heat", heat("heat", "sources"), 5000.0, 1e-8);
        let share = within("air", heat("air", "boundaries"), -energy, 500.0 * most);
        is_close("air", &[share]);
        let report = |name: &str| {
            let of = &found["reports"][name];
            (number(of), number(&of["bound"]))
        };
        is_close("total", &[within("total", report("total"), energy, 500.0 * most)]);
        is_close("rise", &[within("rise", report("rise"), energy / 500.0, most)]);
        within("top", report("top"), 293.15 + rise(500.0) - 273.15, most);
        within("above", report("above"), 500.0 - crossing, 100.0 * most);
    }
}

#[test]
fn limits_have_proven_margins_and_times() {
    let folder = Folder::with("warms.toml", WARMS);
    let mean = 10.0 - 0.2 * rise(500.0);
    for (text, tolerance) in TOLERANCES {
        let words = format!("run warms.toml --certify --no-files --tolerance {text}");
        let found = folder.json(&words).json();
        let of = |name: &str| {
            let limit = &found["limits"][name];
            (limit.clone(), (number(&limit["margin"]), number(&limit["margin_bound"])))
        };
        let most = 100.0 * tolerance;
        for (name, level, fraction) in [("warm", 5.0, 0.5), ("much", 9.0, 0.1)] {
            let (limit, margin) = of(name);
            within(name, margin, level - rise(500.0), most);
            assert_eq!(limit["is_proven"], true, "{name}");
            let [from, to] = [0, 1].map(|end| number(&limit["broken_between"][end]));
            let right = -100.0 * f64::ln(fraction);
            assert!(from <= right && right <= to, "{name}: {from} {right} {to}");
            assert!(to - from <= 100.0 * most, "{name}: {from} {to}");
        }
        // 4.7e-7 W and 6e-9 W above what is reached
        let (near, margin) = of("near");
        within("near", margin, 9.932_621 - rise(500.0), most);
        assert!(near["is_proven"] == false || near["kept"] == true, "near at {text}: {near}");
        assert!(tolerance > 1e-6 || near["is_proven"] == true, "near at {text}: {near}");
        let (_, margin) = of("usual");
        within("usual", margin, 8.013_475_9 - mean, most);
    }
}

/// A limit that is passed by 1 mK, which a run at 1 mK alone takes for just reached: the bounds prove
/// that it is broken.
#[test]
fn a_limit_that_is_broken_for_sure_is_broken() {
    let text = WARMS
        .replace("warm =", "barely = { of = \"body.T\", below = \"29.93162053 degC\" }\nwarm =");
    let folder = Folder::with("warms.toml", &text);
    let right = -100.0 * f64::ln(1.0 - 0.993_162_053);
    for (text, tolerance) in TOLERANCES {
        let found = folder.json(&format!("run warms.toml --certify --no-files --tolerance {text}"));
        let found = found.json();
        let barely = &found["limits"]["barely"];
        assert_eq!(
            (&barely["kept"], &barely["is_proven"]),
            (&false.into(), &true.into()),
            "{text}"
        );
        let margin = (number(&barely["margin"]), number(&barely["margin_bound"]));
        within("barely", margin, 9.931_620_53 - rise(500.0), 10.0 * tolerance);
        let [from, to] = [0, 1].map(|end| number(&barely["broken_between"][end]));
        assert!(from <= right && right <= to && to - from < 1.0, "{text}: {from} {right} {to}");
        let plain = folder.json(&format!("run warms.toml --no-files --tolerance {text}")).json();
        assert_eq!(plain["limits"]["barely"]["kept"], tolerance > 5e-4, "{text}");
    }
}

#[test]
fn verdicts_of_all_limits_are_in_the_notes() {
    let folder = Folder::with("warms.toml", WARMS);
    let run = |tolerance: &str| {
        let words = ["run", "warms.toml", "--certify", "--no-files", "--tolerance", tolerance];
        folder.run(&words).out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let rough = run("1e-3K");
    assert!(rough.contains("proven verdicts: `warm` and `much`"), "{rough}");
    assert!(rough.contains("the proven errors do not decide `near` and `usual`"), "{rough}");
    assert!(rough.contains("BROKEN from 69.3") && rough.contains(" \u{b1} "), "{rough}");
    assert!(rough.contains("proven error of the heat over the run"), "{rough}");
}

/// A step of heat at 100 s: `rise(t) - rise(t - 100 s) / 2` after it. The row there has the heat
/// after the step, and so has its bound.
#[test]
fn steps_of_inputs_are_within_the_bounds() {
    let text = WARMS.replace("P = \"10 W\"", "P = \"if(t < 100 [s], 10 [W], 5 [W])\"");
    let (text, _) = text.split_once("[limit]").unwrap();
    let text = format!("{text}[run]\nstop = \"500 s\"\noutput = {{ every = \"50 s\" }}\n");
    let folder = Folder::with("steps.toml", &text);
    let words = ["run", "steps.toml", "--certify", "--format", "csv", "--no-files"];
    let (headers, rows) = csv(&folder.run(&words).out);
    let column = |name: &str| headers.iter().position(|header| header == name).unwrap();
    let (power, own) = (column("heat.P [W]"), column("heat.P.bound [W]"));
    let (heat, bound) = (column("skin.Q [W]"), column("skin.Q.bound [W]"));
    for row in rows {
        let right = rise(row[0]) - if row[0] > 100.0 { 0.5 * rise(row[0] - 100.0) } else { 0.0 };
        within("skin", (row[heat], row[bound]), right, 1e-3);
        within("heat", (row[power], row[own]), if row[0] < 100.0 { 10.0 } else { 5.0 }, 1e-9);
    }
    let found = folder.json("run steps.toml --certify --no-files").json();
    let heat = (number(&found["ledger"]["sources"]["heat"]), number(&found["proven_heat"]["heat"]));
    within("heat", heat, 3000.0, 1e-8);
}

/// Radiation to space at 0 K: `T = (T0^-3 + 3 k t / C)^(-1/3)` and the energy `C (T0 - T)`.
#[test]
fn laws_that_are_not_linear_have_bounds() {
    const SIGMA: f64 = 5.670_374_419e-8;
    let text = r#"format = 1
[node]
body = { C = "1000 J/K", T0 = "400 K" }
[boundary]
space = { T = "0 K" }
[radiation]
skin = { from = "body", to = "space", Gr = "1 m^2" }
[run]
stop = "1000 s"
output = { every = "100 s" }
"#;
    let folder = Folder::with("cools.toml", text);
    let right = |time: f64| (400f64.powi(-3) + 3.0 * SIGMA * time / 1000.0).powf(-1.0 / 3.0);
    let words = ["run", "cools.toml", "--certify", "--format", "csv", "--no-files"];
    for (text, tolerance) in TOLERANCES {
        let (headers, rows) = csv(&folder.run(&[&words[..], &["--tolerance", text]].concat()).out);
        let column = |name: &str| headers.iter().position(|header| header == name).unwrap();
        let (heat, bound) = (column("skin.Q [W]"), column("skin.Q.bound [W]"));
        for row in rows {
            // the slope is 15 W/K at the start
            within("skin", (row[heat], row[bound]), SIGMA * right(row[0]).powi(4), 1e3 * tolerance);
        }
        let found = folder.json(&format!("run cools.toml --certify --no-files --tolerance {text}"));
        let found = found.json();
        let given = (
            number(&found["ledger"]["boundaries"]["space"]),
            number(&found["proven_heat"]["space"]),
        );
        within("space", given, 1000.0 * (right(1000.0) - 400.0), 1e6 * tolerance);
    }
}
