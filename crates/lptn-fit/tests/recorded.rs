//! What each record says of its own run: courses of signals and temperatures at the start. Expected
//! values are the numbers from which closed forms made the records.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFit, NetworkFitError, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};

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
        Ok(records[name.parse::<usize>().unwrap()].csv().into_bytes())
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

#[test]
fn a_start_is_not_read_from_a_sensor_that_is_sought() {
    let more = "column = { ring = { of = \"body.T\", sensor = \"tc\" } }\n\
                signal = { hall = \"hall\", heat = \"heat\" }\ninitial = \"record\"";
    let sensor = |offset: &str| format!("[sensor]\ntc = {{ offset = \"{offset}\" }}");
    let error = fitted(&netlist(more, &sensor("0 ± 3 K"), &WARM)).unwrap_err();
    assert_eq!(error.code(), "fit::initial");
    is_truth(&fitted(&netlist(more, &sensor("0 K"), &WARM)).unwrap());
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
