//! What each record says of its own run: courses of signals and temperatures at the start. Expected
//! values are the numbers from which closed forms made the records.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::infer::{InferError, InferTask};
use lptn_fit::network::{NetworkFit, NetworkFitError, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::Proceed;

/// A body of 0.3 K/W and 2659 J/K in a room that warms evenly from `room` by `rate`, heated by
/// `power` W, that begins `above` it.
struct Run {
    room: f64,
    rate: f64,
    power: f64,
    above: f64,
    /// The row in which a wire is broken.
    broken: Option<u32>,
}

const TAU: f64 = 0.3 * 2659.0;

impl Run {
    fn csv(&self) -> String {
        let mut csv = String::from("t [s],ring [degC],hall [degC],heat [W]\n");
        for t in (0..60).map(|k| 25.0 * f64::from(k)) {
            let left = f64::exp(-t / TAU);
            let hall = self.room + self.rate * t;
            let ring = hall - self.rate * TAU * (1.0 - left)
                + 0.3 * self.power * (1.0 - left)
                + self.above * left;
            let broken = self.broken.is_some_and(|row| (t - 25.0 * f64::from(row)).abs() < 1.0);
            let ring = if broken { 9999.0 } else { ring };
            csv += &format!("{t},{ring},{hall},{}\n", self.power);
        }
        csv
    }
}

fn netlist(more: &str, sensor: &str, records: &[Run]) -> Netlist {
    read_by((more, sensor), records, |ring| ring, 0.0)
}

/// The records as instruments give them: one makes `ring` of what is there in degC, one reads `hall`
/// too much.
fn read_by(
    (more, sensor): (&str, &str),
    records: &[Run],
    ring: impl Fn(f64) -> f64,
    hall: f64,
) -> Netlist {
    let names: Vec<String> = (0..records.len()).map(|k| format!("\"{k}.csv\"")).collect();
    let text = format!(
        "format = 1\n[param]\nR = \"0.25 K/W\"\nC = \"2 kJ/K\"\n[signal]\nhall = \"25 degC\"\n\
         heat = \"1 W\"\n[node]\nbody = {{ C = \"C\", T0 = \"25 degC\" }}\n[boundary]\nroom = \
         {{ T = \"hall\" }}\n[resistor]\nskin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n\
         [source]\nheater = {{ into = \"body\", P = \"heat\" }}\n{sensor}\n\
         [fit.all]\ndata = [{}]\nvary = [\"R\", \"C\"]\nsigma = \"0.01 K\"\n{more}\n",
        names.join(", ")
    );
    let record = |path: &std::path::Path| -> std::io::Result<Vec<u8>> {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let csv = records[name.parse::<usize>().unwrap()].csv();
        let read = |line: &str| {
            let cells: Vec<f64> = line.split(',').map_while(|cell| cell.parse().ok()).collect();
            match cells.as_slice() {
                [t, r, h, p] => format!("{t},{},{},{p}\n", ring(*r), h + hall),
                _ => format!("{line}\n"),
            }
        };
        Ok(csv.lines().map(read).collect::<String>().into_bytes())
    };
    parse_with("body.toml", &text, &mut |path| record(path))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn fitted(netlist: &Netlist) -> Result<NetworkFit, NetworkFitError> {
    fit_network(&NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2)?)
}

#[track_caller]
fn is_truth(fit: &NetworkFit) {
    let [r, c] = [0, 1].map(|i| fit.parameters[i].value);
    assert!((r / 0.3 - 1.0).abs() < 1e-6 && (c / 2659.0 - 1.0).abs() < 1e-5, "{r} {c}");
}

const WARMING: [Run; 2] = [
    Run { room: 25.0, rate: 4e-3, power: 220.6, above: 0.0, broken: None },
    Run { room: 25.0, rate: -2e-3, power: 100.0, above: 0.0, broken: None },
];

#[test]
fn analytic_signals_follow_the_columns_of_each_record() {
    let more = "column = { ring = \"body.T\" }\nsignal = { hall = \"hall\", heat = \"heat\" }";
    is_truth(&fitted(&netlist(more, "", &WARMING)).unwrap());
}

const WARM: [Run; 2] = [
    Run { room: 20.0, rate: 0.0, power: 220.6, above: 9.0, broken: None },
    Run { room: 27.0, rate: 0.0, power: 0.0, above: 50.0, broken: None },
];

#[test]
fn analytic_a_run_begins_where_its_record_does() {
    let more = "column = { ring = \"body.T\" }\nsignal = { hall = \"hall\", heat = \"heat\" }\n\
                initial = \"record\"";
    is_truth(&fitted(&netlist(more, "", &WARM)).unwrap());
    let mean = more.replace("record", "0 s");
    is_truth(&fitted(&netlist(&mean, "", &WARM)).unwrap());
}

const BOTH: &str = "signal = { hall = \"hall\", heat = \"heat\" }";

/// The start moves with what its sensor reads too much. Everything is relative to the hall, which is
/// known, so a body that comes to rest tells both.
#[test]
fn analytic_a_start_moves_with_the_offset_of_its_sensor() {
    let more = format!(
        "column = {{ ring = {{ of = \"body.T\", sensor = \"tc\" }} }}\n{BOTH}\ninitial = \"record\""
    );
    let fit = |sensor: &str, ring: fn(f64) -> f64| {
        let sensor = format!("[sensor]\ntc = {{ {sensor} }}");
        fitted(&read_by((&more, &sensor), &WARM, ring, 0.0)).unwrap()
    };
    is_truth(&fit("offset = \"0 K\"", |ring| ring));
    is_truth(&fit("offset = \"2 K\"", |ring| ring + 2.0));
    let free = fit("offset = \"free\"", |ring| ring + 2.0);
    is_truth(&free);
    assert!((free.parameters[2].value - 2.0).abs() < 1e-5, "{}", free.parameters[2].value);
    // a `±` of 3 K, known to 0.01 K or so, pulls by less than 1e-5 of itself
    let known = fit("offset = \"0 ± 3 K\"", |ring| ring + 2.0);
    assert!((known.parameters[2].value - 2.0).abs() < 1e-4, "{}", known.parameters[2].value);
    // two states of rest tell two numbers: R and the gain, beside an offset that is known
    let gain = fit("offset = \"2 K\", gain = \"free\"", |ring| 1.01 * ring + 2.0);
    is_truth(&gain);
    assert!((gain.parameters[2].value - 1.01).abs() < 1e-7, "{}", gain.parameters[2].value);
}

/// Two states of rest do not tell R, an offset and a gain: that is an answer, and no search that
/// went astray.
#[test]
fn what_no_start_tells_is_not_determined() {
    let more = format!(
        "column = {{ ring = {{ of = \"body.T\", sensor = \"tc\" }} }}\n{BOTH}\ninitial = \"record\""
    );
    let sensor = "[sensor]\ntc = { offset = \"free\", gain = \"free\" }";
    let fit = fitted(&read_by((&more, sensor), &WARM, |ring| 1.01 * ring + 2.0, 0.0)).unwrap();
    let known = fit.identifiability.unwrap();
    assert_eq!((fit.not_converged, known.is_whole(), known.rank), (None, false, 3), "{known:?}");
}

/// The hall reads 1.7 K too much: taken off what the signal follows where it is known, and found
/// where it is not, for the body begins at a temperature that is known.
#[test]
fn analytic_a_signal_follows_what_its_sensor_was_exposed_to() {
    let follows = "signal = { hall = { column = \"hall\", sensor = \"th\" }, heat = \"heat\" }";
    let more = format!("column = {{ ring = \"body.T\" }}\n{follows}");
    let fit = |more: &str, sensor: &str| {
        let sensor = format!("[sensor]\nth = {{ {sensor} }}");
        fitted(&read_by((more, &sensor), &WARMING, |ring| ring, 1.7))
    };
    is_truth(&fit(&more, "offset = \"1.7 K\"").unwrap());
    let close = |fit: &NetworkFit, i: usize| {
        is_truth(fit);
        assert!((fit.parameters[i].value - 1.7).abs() < 1e-5, "{}", fit.parameters[i].value);
    };
    close(&fit(&more, "offset = \"free\"").unwrap(), 2);
    // a column that is compared has one instrument, whatever else follows it
    let both = format!(
        "column = {{ ring = \"body.T\", hall = {{ of = \"room.T\", sensor = \"th\" }} }}\n{BOTH}"
    );
    close(&fit(&both, "offset = \"free\"").unwrap(), 2);
    let error = fit(&more, "offset = \"1.7 K\", lag = \"10 s\"").unwrap_err();
    assert_eq!(error.code(), "fit::signal_lag");
}

/// An inference takes off what is known of an input's sensor, and refuses one of which more is to be
/// found.
#[test]
fn an_inference_follows_what_the_sensor_of_its_input_was_exposed_to() {
    let infer = |sensor: &str, hall: f64| {
        let more = format!(
            "column = {{ ring = \"body.T\" }}\n{BOTH}\n[infer.heat]\ndata = \"0.csv\"\ncolumn = {{ ring \
             = \"body.T\" }}\nsigma = \"0.1 K\"\nsignal = {{ hall = {{ column = \"hall\", sensor = \
             \"th\" }} }}\nfind = {{ heat = {{ change = \"30 W\", within = \"1 min\" }} }}"
        );
        let sensor = format!("[sensor]\nth = {{ {sensor} }}");
        let netlist = read_by((&more, &sensor), &WARMING[..1], |ring| ring, hall);
        let task = InferTask::of(&netlist, &netlist.studies.infers[0]).unwrap();
        let found = lptn_fit::infer::infer(&task, &|_| Proceed::Continue)?;
        Ok::<_, InferError>(found.courses[0].band.iter().map(|b| b.value).collect::<Vec<_>>())
    };
    let [ideal, high] =
        [infer("offset = \"0 K\"", 0.0), infer("offset = \"1.7 K\"", 1.7)].map(Result::unwrap);
    let apart = ideal.iter().zip(&high).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(ideal.len() > 50 && apart < 1e-6, "{apart}");
    assert_eq!(infer("offset = \"0 ± 3 K\"", 1.7).unwrap_err().code(), "infer::input");
}

/// One value of 9999 degC ruins a fit; it is named, and left out where that is asked.
#[test]
fn an_outlier_is_named_and_left_out() {
    let broken = |row: u32| {
        [
            Run { room: 25.0, rate: 0.0, power: 220.6, above: 0.0, broken: Some(row) },
            Run { room: 25.0, rate: 0.0, power: 100.0, above: 0.0, broken: None },
        ]
    };
    let more = "column = { ring = \"body.T\" }\nsignal = { hall = \"hall\", heat = \"heat\" }";
    for row in [1, 20, 59] {
        let kept = netlist(more, "", &broken(row));
        let named = kept.warnings.iter().find(|warning| warning.code == "record::outlier");
        assert!(named.is_some_and(|warning| warning.message.contains("9999 degC")), "{row}");
        let wrong = fitted(&kept).unwrap().parameters[0].value;
        assert!((wrong / 0.3 - 1.0).abs() > 0.01, "{wrong}");
        is_truth(
            &fitted(&netlist(&format!("{more}\noutliers = \"drop\""), "", &broken(row))).unwrap(),
        );
    }
}
