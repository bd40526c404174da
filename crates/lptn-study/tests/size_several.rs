//! Several parameters at once, and parts from catalogues, against closed forms and brute force.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{aim, demand};
use lptn_netlist::{parse, parse_with};
use lptn_study::{ChoiceTask, Choices, Parts, Several, SeveralTask, choose, size_several};

fn several(text: &str, threads: usize) -> Several {
    let netlist = parse("a.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"));
    let varied = netlist.studies.sizes[0].ranges(&netlist.network).unwrap();
    size_several(&SeveralTask { demand: demand(&netlist), aim: aim(&netlist), varied, threads })
        .unwrap()
}

/// 100 W over fins whose film grows with the speed of the air to the power of 0.8.
fn fins(goal: &str, vary: &str, require: &str) -> String {
    format!(
        "format = 1\n[param]\nA = \"0.1 m^2\"\nv = \"2 m/s\"\nR = \"0.1 K/W\"\n\
         m = \"A * 3 [kg/m^2]\"\nP_fan = \"0.5 [W] * (v / 1 [m/s])^3\"\n[node]\n\
         chip = {{ C = \"600 J/K\", T0 = \"35 degC\" }}\n\
         base = {{ C = \"60 J/K\", T0 = \"35 degC\" }}\n[boundary]\n\
         air = {{ T = \"35 degC\" }}\n[resistor]\n\
         pad = {{ from = \"chip\", to = \"base\", R = \"R\" }}\n[convection]\n\
         fins = {{ from = \"base\", to = \"air\", h = \"12 [W/(m^2 K)] * (v / 1 [m/s])^0.8\", area \
         = \"A\" }}\n\
         [source]\nheat = {{ into = \"chip\", P = \"100 W\" }}\n\
         [size.s]\n{goal}\nvary = {{ {vary} }}\nrequire = [{require}]\n"
    )
}

const AREA: &str = "A = { from = \"0.02 m^2\", to = \"2 m^2\" }";
const SPEED: &str = "v = { from = \"0.5 m/s\", to = \"8 m/s\" }";

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    let off = (found - expected).abs() / expected.abs();
    assert!(off <= relative, "{found:e} is not {expected:e}: {off:.1e}");
}

/// 40 K for 100 W need A v^0.8 = 100 / 480 in m^2 and m/s, so 0.5 v^3 + 12 A is least where
/// 1.5 v^3.8 = 2: the closed form of two parameters with one limit.
#[test]
fn two_parameters_have_their_closed_form() {
    let (v, a): (f64, f64) = {
        let v = (4.0_f64 / 3.0).powf(1.0 / 3.8);
        (v, 100.0 / (480.0 * v.powf(0.8)))
    };
    let text = fins(
        "minimise = \"P_fan + 4 [W/kg] * m\"",
        &format!("{AREA}, {SPEED}"),
        "\"base.T <= 75 [degC]\"",
    );
    let found = several(&text, 2);
    assert!(found.feasible && found.binding == [0], "{found:?}");
    near(found.design.objective, 0.5 * v.powi(3) + 12.0 * a, 1e-8);
    near(found.design.values[0], a, 1e-5);
    near(found.design.values[1], v, 1e-5);
    assert!(found.design.judged.margins[0] >= 0.0 && found.design.judged.margins[0] < 1e-5);
    // the same whatever the number of threads
    let one = several(&text, 1);
    assert_eq!(one.design.values, found.design.values);
    assert_eq!(one.solved, found.solved);
}

/// Three parameters, two limits and an end of a range, against all of 60 x 60 x 60 places with the
/// closed form of the two nodes. No place is better, and the best one is near.
#[test]
fn three_parameters_are_no_worse_than_brute_force() {
    let pad = "R = { from = \"0.05 K/W\", to = \"0.5 K/W\" }";
    let text = fins(
        "minimise = \"P_fan + 4 [W/kg] * m + 0.06 [W K/W] / R\"",
        &format!("{AREA}, {SPEED}, {pad}"),
        "\"chip.T <= 95 [degC]\", \"base.T <= 80 [degC]\"",
    );
    let found = several(&text, 2);
    assert!(found.feasible);
    let cost = |a: f64, v: f64, r: f64| 0.5 * v.powi(3) + 12.0 * a + 0.06 / r;
    let kept = |a: f64, v: f64, r: f64| {
        let rise = 100.0 / (12.0 * v.powf(0.8) * a);
        rise <= 45.0 && rise + 100.0 * r <= 60.0
    };
    let share = |k: i32| f64::from(k) / 59.0;
    let mut best = f64::INFINITY;
    for i in 0..60 {
        for j in 0..60 {
            for k in 0..60 {
                let a = 0.02 * 100.0_f64.powf(share(i));
                let v = 0.5 * 16.0_f64.powf(share(j));
                let r = 0.05 + 0.45 * share(k);
                if kept(a, v, r) {
                    best = best.min(cost(a, v, r));
                }
            }
        }
    }
    let &[a, v, r] = found.design.values.as_slice() else { panic!("three values") };
    near(found.design.objective, cost(a, v, r), 1e-12);
    assert!(found.design.objective <= best, "{} > {best}", found.design.objective);
    assert!(found.design.objective > 0.9 * best, "{} < {best}", found.design.objective);
    // both kept to the last digits that matter
    assert!(kept(a * (1.0 + 1e-9), v, r * (1.0 - 1e-9)), "{a} {v} {r}");
}

/// The most heat that can be carried off is where both stand at their largest.
#[test]
fn an_answer_at_the_ends_of_the_ranges_is_found() {
    let text = fins("maximise = \"A * v\"", &format!("{AREA}, {SPEED}"), "\"base.T >= 36 [degC]\"");
    let found = several(&text, 2);
    // 1 K at least: A v^0.8 <= 100 / 12, which A v is largest for where v is
    let a = 100.0 / 12.0 / 8.0_f64.powf(0.8);
    near(found.design.objective, 8.0 * a, 1e-8);
    near(found.design.values[1], 8.0, 1e-9);
}

#[test]
fn what_nothing_keeps_is_told() {
    let text = fins("minimise = \"A * v\"", &format!("{AREA}, {SPEED}"), "\"chip.T <= 40 [degC]\"");
    let found = several(&text, 2);
    assert!(!found.feasible);
    // 10 K over the pad alone; 100 W over 12 x 8^0.8 x 2 W/K at best
    near(found.design.judged.margins[0], 5.0 - 10.0 - 100.0 / (24.0 * 8.0_f64.powf(0.8)), 1e-3);
}

/// Three requirements in K against each other: the least of the largest violation s is where all
/// three are equal, `100 / (12 (2 + s/5)^0.8 (10 + s) / 20) = 5 + s` (SciPy's brentq).
#[test]
fn the_closest_of_several_has_the_least_violation() {
    let require = "\"base.T - air.T <= 5 [K]\", \"A * 20 [K/m^2] <= 10 [K]\", \
        \"v * 5 [K s/m] <= 10 [K]\"";
    let wide = "A = { from = \"0.001 m^2\", to = \"50 m^2\" }";
    for area in [AREA, wide] {
        let text = fins("minimise = \"A * v\"", &format!("{area}, {SPEED}"), require);
        let found = several(&text, 2);
        assert!(!found.feasible);
        near(found.design.judged.margins[found.worst], -LEAST, 1e-6);
        near(found.design.values[0], (10.0 + LEAST) / 20.0, 1e-5);
        near(found.design.values[1], (10.0 + LEAST) / 5.0, 1e-5);
    }
}

const LEAST: f64 = 1.948_262_312_641_519_5;

const SINKS: &str = "part,R [K/W],price_sink [-]\ns1,0.9,4\ns2,600e-3,6\ns3,0.45,9\ns4,0.3,15\n";
const FANS: &str = "part,g [mW/K],price_fan [-],maker\nf0,100,0,x\nf1,900,3,x\nf2,2500,5,y\n";

fn choice(limit: f64, goal: &str, threads: usize) -> Choices {
    let text = format!(
        "format = 1\n[param]\nR = \"1 K/W\"\ng = \"1 W/K\"\nprice_sink = 0\nprice_fan = 0\n[node]\n\
         chip = {{ C = \"600 J/K\", T0 = \"20 degC\" }}\nsink = {{ C = \"60 J/K\", T0 = \"20 degC\" \
         }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
         pad = {{ from = \"chip\", to = \"sink\", R = \"R\" }}\n\
         fan = {{ from = \"sink\", to = \"air\", G = \"g\" }}\n[source]\n\
         heat = {{ into = \"chip\", P = \"30 W\" }}\n[size.s]\n{goal} = \"price_sink + price_fan\"\n\
         catalogue = [\"sinks.csv\", \"fans.csv\"]\nrequire = [\"chip.T <= {limit} [degC]\"]\n"
    );
    let mut load = |path: &std::path::Path| {
        Ok(if path.ends_with("sinks.csv") { SINKS } else { FANS }.as_bytes().to_vec())
    };
    let netlist = parse_with("a.toml", &text, &mut load).unwrap_or_else(|e| panic!("{e}"));
    let parts = |catalogue: &lptn_netlist::Catalogue| Parts {
        parameters: catalogue
            .columns
            .iter()
            .map(|one| netlist.network.parameter(&one.name).unwrap())
            .collect(),
        values: (0..catalogue.parts.len())
            .map(|part| catalogue.columns.iter().map(|one| one.values[part]).collect())
            .collect(),
    };
    let catalogues: Vec<Parts> = netlist.studies.sizes[0].catalogues.iter().map(parts).collect();
    let (demand, aim) = (demand(&netlist), aim(&netlist));
    choose(&ChoiceTask { demand, aim, catalogues: &catalogues, varied: &[], threads }).unwrap()
}

/// Every combination by T = 20 degC + 30 W (R + 1 / g), the cheapest that keeps the limit.
#[test]
fn the_cheapest_parts_that_work_are_those_of_brute_force() {
    let sinks = [(0.9, 4.0), (0.6, 6.0), (0.45, 9.0), (0.3, 15.0)];
    let fans = [(0.1, 0.0), (0.9, 3.0), (2.5, 5.0)];
    for limit in [40.0, 55.0, 60.0, 70.0, 85.0, 350.0] {
        let mut cheapest: Option<(f64, [usize; 2])> = None;
        for (i, (r, of_sink)) in sinks.iter().enumerate() {
            for (k, (g, of_fan)) in fans.iter().enumerate() {
                let works = 20.0 + 30.0 * (r + 1.0 / g) <= limit;
                if works && cheapest.is_none_or(|(price, _)| of_sink + of_fan < price) {
                    cheapest = Some((of_sink + of_fan, [i, k]));
                }
            }
        }
        let found = choice(limit, "minimise", 2);
        let best = found.best.map(|best| &found.judged[best]);
        assert_eq!(best.map(|best| best.parts.clone()), cheapest.map(|(_, parts)| parts.to_vec()));
        assert_eq!((found.count, found.judged.len()), (12, 12));
        for choice in &found.judged {
            let ((r, _), (g, _)) = (sinks[choice.parts[0]], fans[choice.parts[1]]);
            let margin = limit - 20.0 - 30.0 * (r + 1.0 / g);
            assert!((choice.margins()[0] - margin).abs() < 1e-9);
        }
        let prices: Vec<f64> = found.judged.iter().map(|one| one.objective).collect();
        assert!(prices.is_sorted());
    }
    // the dearest that works, and the same whatever the number of threads
    let dearest = choice(60.0, "maximise", 1);
    assert_eq!(dearest.judged[dearest.best.unwrap()].parts, [3, 2]);
    let again = choice(60.0, "maximise", 3);
    let parts = |all: &Choices| all.judged.iter().map(|one| one.parts.clone()).collect::<Vec<_>>();
    assert_eq!(parts(&dearest), parts(&again));
}
