//! Records that begin after their run, and columns that begin after their record: a reading is the
//! temperature at the time of its row. The records are closed forms of known parameters.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};

const R: f64 = 0.4;
const TAU: f64 = R * 2000.0;
const P: f64 = 100.0;

/// Temperatures of two bodies, 2 kJ/K with 0.4 K/W to a room of 20 degC and 100 W. The first begins
/// at 35 degC, the second at 20 degC.
fn truth(t: f64) -> [f64; 2] {
    [35.0, 20.0].map(|start| 20.0 + R * P + (start - 20.0 - R * P) * f64::exp(-t / TAU))
}

/// A record with rows from `from` s on, whose second column has values from `known` s on.
fn record(from: f64, known: f64) -> String {
    let rows = (0..200).map(|k| 10.0 * f64::from(k)).filter(|t| *t >= from);
    let row = |t: f64| {
        let [a, b] = truth(t);
        let b = if t < known { String::new() } else { b.to_string() };
        format!("{t},{a},{b}\n")
    };
    rows.map(row).fold("t [s],a [degC],b [degC]\n".to_owned(), |csv, row| csv + &row)
}

fn netlist(csv: &str, (start, initial): (&str, &str)) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nR = \"0.3 K/W\"\nP = \"80 W\"\n\
         [node]\na = {{ C = \"2 kJ/K\", T0 = \"35 degC\" }}\n\
         b = {{ C = \"2 kJ/K\", T0 = \"20 degC\" }}\n\
         [boundary]\nroom = {{ T = \"20 degC\" }}\n\
         [resistor]\nra = {{ from = \"a\", to = \"room\", R = \"R\" }}\n\
         rb = {{ from = \"b\", to = \"room\", R = \"R\" }}\n\
         [source]\nha = {{ into = \"a\", P = \"P\" }}\nhb = {{ into = \"b\", P = \"P\" }}\n\
         [run]\nstop = \"1 h\"\n{start}\n\
         [fit.all]\ndata = \"r.csv\"\ncolumn = {{ a = \"a.T\", b = \"b.T\" }}\n\
         vary = [\"R\", \"P\"]\n{initial}\n"
    );
    parse_with("bodies.toml", &text, &mut |_| Ok(csv.as_bytes().to_vec()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn task(csv: &str, begun: (&str, &str)) -> NetworkFitTask {
    let netlist = netlist(csv, begun);
    NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap()
}

#[track_caller]
fn finds_the_truth(from: f64, begun: (&str, &str)) {
    let fit = fit_network(&task(&record(from, from), begun)).unwrap();
    let [r, p] = [0, 1].map(|i| fit.parameters[i].value);
    assert!((r / R - 1.0).abs() < 1e-6 && (p / P - 1.0).abs() < 1e-6, "{from} {begun:?}: {r} {p}");
}

/// The record may begin with the run, one row later or long after it; `start` may say so or not.
#[test]
fn analytic_a_reading_is_the_temperature_of_its_own_time() {
    for from in [0.0, 10.0, 300.0, 900.0] {
        for initial in ["", "initial = \"record\"", "initial = \"0 s\""] {
            finds_the_truth(from, ("", initial));
        }
    }
    finds_the_truth(300.0, ("start = \"300 s\"", "initial = \"record\""));
    finds_the_truth(300.0, ("start = \"-60 s\"", "initial = \"record\""));
}

/// Another column of the record begins later than the run can: its node is named with the time of
/// its reading. One row later is the order in which a logger reads its channels.
#[test]
fn a_reading_of_a_later_time_is_known() {
    let late = |from: f64, known: f64, initial: &str, wanted: &[f64]| {
        let task = task(&record(from, known), ("", initial));
        assert!(task.runs[0].settings.start() <= from);
        let found: Vec<f64> = task.runs[0].late_starts().map(|start| start.read_at).collect();
        assert_eq!(found, wanted, "{from} {known} {initial}");
    };
    late(300.0, 300.0, "initial = \"record\"", &[]);
    late(300.0, 310.0, "initial = \"record\"", &[]);
    late(0.0, 400.0, "initial = \"record\"", &[400.0]);
    late(300.0, 400.0, "initial = \"20 s\"", &[400.0]);
    late(300.0, 400.0, "", &[]);
}
