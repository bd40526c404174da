//! The synthetic records of the gearbox are what their script writes.

use crate::synthetic_records_helper as synthetic_records;

use std::f64::consts::TAU;
use std::path::PathBuf;

use lptn_fit::law::{LossLaw, Run, RunReference, RunsSettings, RunsStudy};
use lptn_fit::step::{Capacity, Sensor};
use lptn_netlist::{RecordQuery, read_record};

/// The truth, as the README states it.
const ALPHA: f64 = 87e-6;
const C_EQ: f64 = 2659.0;
const RPM: f64 = TAU / 60.0;

fn runs() -> Vec<Run> {
    let folder =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("networks/records/synthetic_gearbox");
    let file = |(rpm, letter): (u32, &str)| {
        let path = folder.join(format!("{rpm}rpm_{letter}.csv"));
        let bytes = std::fs::read(&path).expect("a shipped record");
        let (record, _) =
            read_record(&path, &bytes, &RecordQuery::default()).expect("a sound record");
        let columns =
            record.temperatures().map(|column| (column.name.clone(), column.values.clone()));
        let name = format!("{rpm}{letter}");
        Run {
            name,
            speed: f64::from(rpm) * RPM,
            columns: columns.collect(),
            times: record.time.clone(),
        }
    };
    (1..8).flat_map(|k| [(1000 * k, "a"), (1000 * k, "b")]).map(file).collect()
}

fn study(reference: RunReference, threads: usize) -> RunsStudy {
    let settings = RunsSettings {
        columns: vec!["ring_gear".to_owned(), "housing".to_owned()],
        capacity: Capacity { value: C_EQ, deviation: 0.05 * C_EQ },
        reference,
        sensor: Sensor { class: 3.0, gain: 0.0 },
        unweighted: false,
        laws: Vec::new(),
        threads,
    };
    RunsStudy::new(&runs(), settings).expect("a study")
}

/// The truth lies within what the study states of its own errors; the exponent is found, and the
/// other laws lose.
#[test]
fn the_study_recovers_the_truth_within_its_own_errors() {
    let study = study(RunReference::Initial, 1);
    for ((name, speed), fit) in study.runs.iter().zip(&study.columns[0].fits) {
        let truth = ALPHA * (speed / RPM).powf(5.0 / 3.0);
        let power = fit.power.power;
        let error = power.random.hypot(power.systematic);
        assert!(
            (power.value - truth).abs() < 3.0 * error,
            "{name}: {} ± {error}, not {truth}",
            power.value
        );
    }
    let best = study.laws.best().expect("a law");
    assert_eq!(best.law.to_string(), "omega^(5/3)", "{}", study.laws.verdict());
    let alpha = &best.fitted().expect("a fit").coefficients[0];
    let random = alpha.standard_error.expect("an error");
    let systematic = study.systematic(best).expect("errors")[0];
    let scale = RPM.powf(5.0 / 3.0);
    let off = alpha.value * scale - ALPHA;
    assert!(off.abs() < 2.0 * scale * random.hypot(systematic.total()), "off by {off}");
    // 5 % of C is 5 % of alpha, in every run alike; the offset of the sensor drops out
    assert!(
        (systematic.capacity / alpha.value - 0.05).abs() < 1e-12
            && systematic.offset < 1e-12 * alpha.value
    );
    // seals alone or oiled gears alone are out of the question
    let singles = study.laws.single_powers();
    let behind: Vec<f64> = singles.iter().filter_map(|c| study.laws.behind(c)).collect();
    assert!(behind[0] == 0.0 && behind[1] > 20.0 && behind[2] > 20.0, "{behind:?}");
    let free = study
        .laws
        .candidates
        .iter()
        .find(|c| matches!(c.law, LossLaw::FreeExponent))
        .expect("it is standard");
    let n = free.fitted().and_then(|fit| fit.coefficient("n")).expect("an exponent");
    assert!((n.value - 5.0 / 3.0).abs() < 3.0 * n.standard_error.expect("an error"), "{n:?}");
}

/// The rise goes with omega^(5/3) and the time constant does not change: the paper's linear rise is
/// refuted.
#[test]
fn exponents_of_rise_and_time_constant_are_those_of_a_linear_network() {
    let study = study(RunReference::Initial, 1);
    let found = study.consistency.expect("14 runs");
    assert!(found.derived && found.agrees());
    assert!(found.claim(found.rise, 5.0 / 3.0).expect("a test").probability > 0.01);
    assert!(found.claim(found.time_constant, 0.0).expect("a test").probability > 0.01);
    assert!(found.claim(found.rise, 1.0).expect("a test").probability < 1e-6);
}

/// A bed that warms is no fixed ground: counted from its mean the power comes out too small, and
/// the errors of two sensors enter.
#[test]
fn the_bed_as_a_reference_costs_power_and_certainty() {
    let (initial, bed) =
        (study(RunReference::Initial, 1), study(RunReference::Column("mill_bed".to_owned()), 1));
    let offsets = synthetic_records::offsets().expect("offsets");
    for (a, b) in initial.columns[0].fits.iter().zip(&bed.columns[0].fits) {
        // what the sensors add is known here, and nowhere else
        let without_offset = b.power.rise.value - (offsets[0] - offsets[2]);
        assert!(without_offset < a.power.rise.value);
        // 3 K / sqrt(3) for each of two
        assert!((b.power.rise.systematic - 6_f64.sqrt()).abs() < 1e-9);
    }
    let best = &bed.laws.candidates[0];
    assert!(bed.systematic(best).expect("errors")[0].offset > 0.0);
}

#[test]
fn threads_change_nothing() {
    let (one, three) = (study(RunReference::Initial, 1), study(RunReference::Initial, 3));
    assert_eq!(one.columns, three.columns);
    assert_eq!(one.laws.verdict(), three.laws.verdict());
}

/// Exact solution, seeded noise: every byte is determined.
#[test]
fn a_file_is_what_the_script_writes() {
    for (name, rpm, run) in [("7000rpm_a.csv", 7000, 0), ("1000rpm_b.csv", 1000, 1)] {
        let path =
            format!("{}/networks/records/synthetic_gearbox/{name}", env!("CARGO_MANIFEST_DIR"));
        let shipped = std::fs::read_to_string(path).expect("a shipped record");
        let written = synthetic_records::record(rpm, run).expect("a record");
        assert!(
            shipped == written,
            "{name} is not what `cargo run --example synthetic_records` writes"
        );
    }
}

/// The class of the thermocouples, and what the README says of these three.
#[test]
fn the_sensors_are_off_as_the_readme_says() {
    let readme = include_str!("../networks/records/synthetic_gearbox/README.md");
    assert!(readme.lines().next().expect("a line").contains("SYNTHETIC"));
    for offset in synthetic_records::offsets().expect("offsets") {
        assert!(offset.abs() <= 3.0);
        let shown = format!("{offset:+.3} K").replace('-', "−");
        assert!(readme.contains(&shown), "the README does not say {shown}");
    }
}
