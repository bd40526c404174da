//! Rows that are answered as they come, against an independent filter: gaps are left out, and so is
//! what nobody would expect, as far as that is asked.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::infer::{Followed, Follower, InferError, InferTask, Row};
use lptn_fit::network::NetworkFitError;
use lptn_netlist::{Netlist, parse_with};
use lptn_units::statistics::NORMAL_95;

const BODY: &str = "format = 1
[signal]
P = \"100 W\"
hall = \"20 degC\"
[node]
body = { C = \"2 kJ/K\", T0 = \"20 degC\" }
[boundary]
air = { T = \"hall\" }
[resistor]
skin = { from = \"body\", to = \"air\", R = \"0.3 K/W\" }
[source]
heat = { into = \"body\", P = \"P\" }
[infer.power]
data = \"r.csv\"
column.ring = { of = \"body.T\", sigma = \"0.1 K\" }
column.lid = { of = \"body.T\", sigma = \"0.2 K\" }
find = { P = { change = \"30 W\", within = \"1 min\" } }
signal = { hall = \"hall\" }
";

fn netlist(text: &str) -> Netlist {
    let record =
        b"t [s],ring [degC],lid [degC],hall [degC]\n0,20,20,20\n10,20.5,20.5,20\n".to_vec();
    parse_with("body.toml", text, &mut |_| Ok(record.clone()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn follower(netlist: &Netlist) -> Follower {
    Follower::new(InferTask::of(netlist, &netlist.studies.infers[0]).unwrap()).unwrap()
}

/// In degC; NaN is a gap. The hall is 20 degC, and was not measured but in the first row.
fn row((k, read): (usize, &[f64; 2])) -> Row {
    let hall = if k == 0 { 293.15 } else { f64::NAN };
    let values = read.iter().map(|degrees| degrees + 273.15).collect();
    Row { time: 10.0 * k as f64, values, signals: vec![hall] }
}

const GAP: f64 = f64::NAN;

const READ: [[f64; 2]; 10] = [
    [20.03, 19.9],
    [20.58, 20.7],
    [21.02, 21.1],
    [21.33, 21.6],
    [GAP, 22.1],
    [GAP, GAP],
    [22.8, 22.6],
    [9999.0, 23.5],
    [23.78, 23.4],
    [24.21, 24.3],
];

/// Power in W, its standard deviation, and the body in K at each row: a Kalman filter in NumPy 2 of
/// temperature and power, with the exponential of C. F. Van Loan's matrix by SciPy 1.17, a power
/// known beforehand to 2445.125 W, that leaves out what is NaN or beyond 10 standard deviations.
const FILTER: [(f64, f64, f64); 10] = [
    (100.0, 2_445.124_999_421_287_6, 293.15),
    (121.808_367_296_682_15, 19.368_719_708_824_226, 293.753_994_114_957_04),
    (107.050_132_607_964_44, 13.310_896_255_258_143, 294.216_909_392_115_04),
    (92.734_715_217_217_44, 13.545_909_870_999_278, 294.592_186_407_511_2),
    (99.976_744_703_388_97, 16.518_431_350_382_304, 295.094_019_457_179_97),
    (99.976_744_703_388_97, 20.563_525_336_801_88, 295.557_628_714_288_57),
    (92.955_135_476_901_18, 14.308_475_037_474_288, 295.920_344_534_557_16),
    (103.281_813_215_242_79, 17.077_602_864_559_61, 296.435_026_513_203_8),
    (100.366_232_751_522_69, 14.430_970_570_618_76, 296.861_498_255_158_66),
    (106.415_250_894_096_3, 14.410_723_716_195_394, 297.353_753_901_039_1),
];

#[track_caller]
fn near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

#[test]
fn reference_gaps_and_what_nobody_would_expect_are_left_out() {
    let netlist = netlist(BODY);
    let mut follower = follower(&netlist).dropping();
    let all = READ.iter().enumerate().flat_map(|read| follower.row(row(read)).unwrap());
    let all: Vec<Followed> = all.collect();
    assert_eq!(all.len(), READ.len());
    for (followed, (power, deviation, kelvin)) in all.iter().zip(FILTER) {
        let band = followed.courses[0];
        near(band.value, power, 1e-6 * deviation);
        let half = 0.5 * (band.ends.1 - band.ends.0) / NORMAL_95;
        near(half, deviation, 1e-7 * deviation);
        near(followed.nodes[0].value, kelvin, 1e-7);
    }
    assert!(all[5].surprises.iter().all(|surprise| surprise.is_nan()));
    let [spark] = all[7].unexpected[..] else { panic!("{:?}", all[7]) };
    assert!(spark.left_out && (spark.column, spark.in_a_row) == (0, 1), "{spark:?}");
    near(spark.surprise, 59_068.003_096_185_28, 1e-3);
    assert!(
        all.iter().all(|row| row.time.to_bits() == 70_f64.to_bits() || row.unexpected.is_empty())
    );
}

/// Unless it is asked for nothing is left out; and what comes a fourth time in a row is believed.
#[test]
fn what_comes_again_and_again_is_believed() {
    let netlist = netlist(BODY);
    let read = |k: usize| if k < 10 { [20.0, GAP] } else { [60.0, GAP] };
    for drops in [false, true] {
        let mut follower = follower(&netlist);
        if drops {
            follower = follower.dropping();
        }
        let left_out: Vec<usize> = (0..15)
            .flat_map(|k| follower.row(row((k, &read(k)))).unwrap())
            .flat_map(|told| told.unexpected.into_iter().map(move |own| (told.time, own)))
            .filter(|(_, own)| own.left_out)
            .map(|(time, _)| time as usize)
            .collect();
        assert_eq!(left_out, if drops { vec![100, 110, 120] } else { vec![] });
    }
}

/// The first rows wait for a reading behind the start, however many gaps there are before it.
#[test]
fn gaps_in_the_first_rows_are_waited_out() {
    let netlist = netlist(BODY);
    let mut follower = follower(&netlist);
    let answered: Vec<usize> = [[20.0, GAP], [GAP, GAP], [GAP, 20.9], [21.3, GAP]]
        .iter()
        .enumerate()
        .map(|read| follower.row(row(read)).unwrap().len())
        .collect();
    assert_eq!(answered, [0, 0, 3, 1]);
    let mut alone = self::follower(&netlist);
    assert!(alone.row(row((0, &[20.0, 20.0]))).unwrap().is_empty());
    assert!(matches!(alone.end().unwrap_err(), InferError::Short));
}

#[test]
fn a_row_before_the_start_of_the_run_is_refused() {
    let netlist = netlist(&format!("{BODY}[run]\nstart = \"1 min\"\nstop = \"2 min\"\n"));
    let error = follower(&netlist).row(row((0, &[20.0, 20.0]))).unwrap_err();
    assert!(matches!(error, InferError::Record(NetworkFitError::Times { .. })), "{error}");
}
