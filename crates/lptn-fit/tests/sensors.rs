//! What instruments add to a record, found together with the network: against the truth of
//! synthetic records and closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use lptn_fit::network::{Hint, NetworkFit, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};

/// One body, `C = 2659 J/K`, heated by 220.6 W over 0.3 K/W: 66.18 K with 797.7 s.
fn body(sensor: &str, column: &str, vary: &str, rows: &[(f64, f64)]) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2 kJ/K\"\nT_room = \"25 degC\"\n\
         [node]\nbody = {{ C = \"C\", T0 = \"T_room\" }}\n[boundary]\nroom = {{ T = \"T_room\" }}\n\
         [resistor]\nskin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n\
         [source]\nheat = {{ into = \"body\", P = \"220.6 W\" }}\n[sensor]\ntc = {sensor}\n\
         [fit.all]\ndata = \"r.csv\"\ncolumn = {{ ring = {column} }}\nsigma = \"0.01 K\"\n\
         vary = {vary}\n"
    );
    let mut csv = String::from("t [s],ring [degC]\n");
    rows.iter().for_each(|(t, value)| csv += &format!("{t},{value}\n"));
    parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// What an instrument with a lag reads of the body, in degC.
fn lagging(t: f64, lag: f64) -> f64 {
    let tau = 0.3 * 2659.0;
    let part = match lag > 0.0 {
        true => (tau * f64::exp(-t / tau) - lag * f64::exp(-t / lag)) / (tau - lag),
        false => f64::exp(-t / tau),
    };
    25.0 + 220.6 * 0.3 * (1.0 - part)
}

fn rows(every: f64, read: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    (0..60).map(|k| every * f64::from(k)).map(|t| (t, read(t))).collect()
}

fn fitted(netlist: &Netlist) -> NetworkFit {
    let task = NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2).unwrap();
    let fit = fit_network(&task).unwrap();
    assert_eq!(fit.not_converged, None);
    fit
}

fn value(netlist: &Netlist, fit: &NetworkFit, name: &str) -> f64 {
    let task = NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2).unwrap();
    let place = task.unknowns().iter().position(|unknown| unknown.name == name);
    fit.parameters[place.unwrap_or_else(|| panic!("{name}"))].value
}

const WITH: &str = "{ of = \"body.T\", sensor = \"tc\" }";

#[track_caller]
fn near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

/// Rows 25 s apart and a lag of 40 s: the curve between rows counts.
#[test]
fn analytic_offset_gain_and_lag_are_found_with_the_network() {
    let read = |t: f64| 1.01 * lagging(t, 40.0) + 1.7;
    let netlist = body(
        "{ offset = \"0 ± 3 K\", gain = \"1.01\", lag = \"30 ± 20 s\" }",
        WITH,
        "[\"R\", \"C\"]",
        &rows(25.0, read),
    );
    let fit = fitted(&netlist);
    near(value(&netlist, &fit, "R"), 0.3, 2e-6);
    near(value(&netlist, &fit, "C"), 2659.0, 0.1);
    near(value(&netlist, &fit, "tc.offset"), 1.7, 1e-3);
    near(value(&netlist, &fit, "tc.lag"), 40.0, 0.02);
    assert!(fit.identifiability.unwrap().is_whole());
}

/// A lag of nothing that is thought to be 10 ± 5 s, beside six courses of noise of 0.01 K: half of
/// them speak for less than nothing. The lags are those of SciPy 1.17's bounded `least_squares`
/// (trf) of the closed form, the errors of the lag those of its (J'J)^-1: 0.0174 s.
#[test]
fn a_lag_of_nothing_is_found_as_nothing() {
    let expected = [0.006_916, 0.0, 0.0, 0.0, 0.023_623, 0.037_452];
    for (phase, expected) in (0..6).zip(expected) {
        let noise = |k: f64| 0.01 * 2_f64.sqrt() * f64::sin(k * k + f64::from(phase));
        let times = (0..600).map(f64::from);
        let rows: Vec<(f64, f64)> =
            times.map(|k| (2.0 * k, lagging(2.0 * k, 0.0) + noise(k))).collect();
        let netlist = body("{ lag = \"10 ± 5 s\" }", WITH, "[\"R\", \"C\"]", &rows);
        let fit = fitted(&netlist);
        near(value(&netlist, &fit, "tc.lag"), expected, 1e-4);
        let profile = fit.parameters[2].profile.unwrap_or_else(|| panic!("{phase}"));
        let high = profile.high.unwrap_or_else(|| panic!("{phase}"));
        assert!(profile.low.is_none() && high > 0.02 && high < 0.4, "{phase}: {profile:?}");
        assert_eq!(fit.parameters[2].on_bound.is_some(), expected <= 0.0, "{phase}");
    }
}

/// The gain is a factor of readings in degC: with R known, a rise tells it.
#[test]
fn analytic_a_gain_is_found_where_the_resistance_is_known() {
    let netlist = body(
        "{ gain = \"1 ± 2 %\" }",
        WITH,
        "[\"C\"]",
        &rows(25.0, |t| 1.015 * (lagging(t, 0.0) - 25.0) * 0.25 / 0.3 + 1.015 * 25.0),
    );
    let fit = fitted(&netlist);
    near(value(&netlist, &fit, "tc.gain"), 1.015, 1e-5);
    near(value(&netlist, &fit, "C"), 0.3 * 2659.0 / 0.25, 0.1);
}

/// A room and an offset that nothing is known of: the record tells their sum alone.
#[test]
fn an_offset_that_nothing_determines_is_said_to_be_undetermined() {
    let netlist = body(
        "{ offset = \"free\" }",
        WITH,
        "[\"R\", \"C\", \"T_room\"]",
        &rows(25.0, |t| lagging(t, 0.0)),
    );
    let fit = fitted(&netlist);
    let known = fit.identifiability.as_ref().unwrap();
    assert_eq!(known.unseparated.len(), 1);
    assert_eq!(
        (known.unseparated[0].parameters.as_slice(), known.unseparated[0].missing),
        (&[2, 3][..], 1)
    );
    assert!(known.determines(0) && known.determines(1));
    assert_eq!(fit.parameters[3].standard_error, None);
}

#[test]
fn an_offset_and_a_lag_without_a_sensor_are_guessed() {
    let hint = |read: fn(f64) -> f64, vary: &str| {
        let rows = rows(25.0, read);
        let netlist = body("{ offset = \"0.1 K\" }", "\"body.T\"", vary, &rows);
        fitted(&netlist).columns[0].hint
    };
    let far = |t: f64| lagging(t, 0.0) - 2.8;
    let found = hint(far, "[\"R\", \"C\"]");
    assert!(matches!(found, Some(Hint::Offset(k)) if (k + 2.8).abs() < 0.1), "{found:?}");
    let found = hint(|t| lagging(t, 60.0), "[\"R\"]");
    assert_eq!(found, None, "a capacity that is wrong is neither");
    let late = |t: f64| {
        let (tau, lag): (f64, f64) = (500.0, 60.0);
        let part = (tau * f64::exp(-t / tau) - lag * f64::exp(-t / lag)) / (tau - lag);
        25.0 + 55.15 * (1.0 - part)
    };
    let found = hint(late, "[\"R\"]");
    assert!(matches!(found, Some(Hint::Lag(s)) if (s - 60.0).abs() < 15.0), "{found:?}");
}

/// Three values, far from what two parameters can make of them: nothing is guessed, nothing breaks.
#[test]
fn few_values_ask_for_no_sensor() {
    let rows = [(0.0, 25.0), (100.0, 300.0), (200.0, 20.0)];
    let netlist = body("{ offset = \"0.1 K\" }", "\"body.T\"", "[\"R\", \"C\"]", &rows);
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 2).unwrap();
    let hints = fit_network(&task).map(|fit| fit.columns[0].hint);
    assert_eq!(hints.unwrap_or(None), None);
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The records of `networks/records/synthetic_gearbox` with their own network: all that its README
/// states comes back, and the offsets that it says the instruments have.
#[test]
fn the_synthetic_gearbox_gives_its_truth_back_with_three_offsets() {
    let mut text = std::fs::read_to_string(root().join("networks/paper_bed.toml")).unwrap();
    let data: Vec<String> = (1..=7)
        .flat_map(|k| ["a", "b"].map(|run| (1000 * k, run)))
        .map(|(rpm, run)| {
            format!("{{ csv = \"{rpm}rpm_{run}.csv\", set = {{ omega = \"{rpm} rpm\" }} }}")
        })
        .collect();
    // what the file knows of its numbers is not used
    let plain = |line: &str| match line.split_once(" ± ") {
        Some((before, behind)) if !line.starts_with('#') => match behind.split_once(' ') {
            Some((_, "%\"")) | None => format!("{before}\"\n"),
            Some((_, unit)) => format!("{before} {unit}\n"),
        },
        _ => format!("{line}\n"),
    };
    // comments end behind the quote of a value
    let lines = text.lines().map(|line| line.split("  #").next().unwrap_or(line).trim_end());
    text = lines.map(|line| plain(line.split(" #").next().unwrap_or(line).trim_end())).collect();
    // nor is it where the search begins
    for (own, elsewhere) in [("1.05 K/W", "0.6 K/W"), ("87 uW", "60 uW"), ("2.16 K/W", "4 K/W")] {
        assert!(text.contains(own));
        text = text.replace(own, elsewhere);
    }
    let fit = text.find("[fit").unwrap_or(text.len());
    text.truncate(fit);
    text += "[sensor]\nring = { offset = \"0 ± 3 K\", resolution = \"0.1 K\" }\n\
        house = { offset = \"0 ± 3 K\", resolution = \"0.1 K\" }\n\
        iron = { offset = \"0 ± 3 K\", resolution = \"0.1 K\" }\n[fit.all]\n\
        column = { ring_gear = { of = \"steel.T\", sensor = \"ring\" }, \
        housing = { of = \"aluminium.T\", sensor = \"house\" }, \
        mill_bed = { of = \"bed.T\", sensor = \"iron\" } }\nsigma = \"0.1 K\"\n\
        vary = [\"alpha\", \"R_internal\", \"R_fixture\", \"R_skin\", \"R_bed\", \"C_bed\"]\n";
    text += &format!("data = [{}]\n", data.join(", "));
    let folder = root().join("networks/records/synthetic_gearbox");
    let netlist = parse_with("g.toml", &text, &mut |path| std::fs::read(folder.join(path)))
        .unwrap_or_else(|rejected| panic!("{rejected}"));
    let found = fitted(&netlist);
    let rpm = std::f64::consts::TAU / 60.0;
    let truth =
        [87e-6 / rpm.powf(5.0 / 3.0), 0.0077, 1.05, 0.365, 2.16, 1670.0, 2.886, -0.870, -1.886];
    for (i, (parameter, truth)) in found.parameters.iter().zip(truth).enumerate() {
        let error = parameter.standard_error.unwrap();
        assert!((parameter.value - truth).abs() < 3.0 * error, "{i}: {parameter:?}");
    }
    near(found.parameters[0].value / truth[0], 1.0, 1e-3);
    truth[6..].iter().zip(&found.parameters[6..]).for_each(|(t, p)| near(p.value, *t, 0.01));
}
