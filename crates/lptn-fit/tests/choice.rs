//! The network that records support: against SciPy on networks that are linear in the unknowns, for
//! which all of it has a closed form.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::choice::{Choice, ChoiceError, Contender, Held, choose};
use lptn_fit::network::NetworkFitTask;
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::Proceed;

/// A body of 2 kJ/K over 0.3 K/W to 25 degC with 20, 40 .. 100 % of 200 W, that begins at 26 degC,
/// every 60 s, with noise of 0.2 K.
const RECORDS: [[f64; 30]; 5] = [
    [
        25.93, 27.29, 28.27, 28.91, 29.71, 30.23, 30.78, 31.36, 31.86, 32.71, 32.94, 33.36, 33.56,
        33.78, 34.05, 34.38, 34.9, 34.99, 35.09, 35.31, 35.23, 35.9, 35.54, 35.91, 36.43, 35.59,
        35.9, 36.12, 36.35, 36.05,
    ],
    [
        25.95, 28.18, 30.2, 31.48, 33.71, 35.37, 36.46, 37.43, 38.54, 39.12, 40.63, 41.64, 42.2,
        42.14, 43.24, 43.85, 44.26, 45.0, 44.85, 45.42, 46.01, 46.38, 46.49, 46.91, 47.02, 46.9,
        47.55, 47.35, 47.28, 47.82,
    ],
    [
        26.36, 29.52, 32.54, 35.11, 37.05, 39.91, 41.82, 43.09, 45.14, 46.59, 48.34, 49.37, 50.52,
        51.51, 52.1, 52.8, 53.95, 54.55, 55.21, 55.73, 56.16, 56.83, 57.16, 57.37, 57.44, 57.61,
        58.11, 58.62, 59.05, 58.99,
    ],
    [
        26.14, 30.7, 35.0, 38.24, 41.79, 44.54, 46.96, 49.21, 51.94, 54.07, 56.2, 57.22, 58.94,
        60.17, 60.94, 62.59, 63.45, 64.16, 65.57, 65.85, 66.73, 67.19, 67.65, 68.25, 68.89, 69.0,
        69.18, 70.2, 70.23, 70.22,
    ],
    [
        25.98, 31.3, 36.68, 41.46, 45.06, 49.39, 52.78, 55.65, 58.51, 60.95, 63.21, 64.99, 67.56,
        68.79, 70.48, 71.79, 73.18, 74.34, 75.04, 76.25, 76.96, 77.6, 78.72, 79.32, 79.47, 80.1,
        80.42, 80.81, 81.22, 81.86,
    ],
];

/// The same with 200 W, every 30 s, with noise of 0.3 K of which 80 % are left from row to row.
const LONG: [f64; 90] = [
    25.72, 28.45, 31.29, 33.83, 36.69, 38.76, 40.95, 43.05, 44.75, 46.85, 48.97, 50.92, 52.56,
    54.19, 55.8, 57.13, 58.3, 59.7, 60.72, 62.02, 63.02, 63.99, 65.02, 66.01, 66.71, 67.48, 68.3,
    69.35, 70.29, 71.19, 71.73, 72.23, 72.58, 73.32, 73.83, 74.56, 75.25, 76.12, 76.31, 76.84,
    76.91, 77.36, 77.57, 77.99, 78.14, 78.81, 79.18, 79.66, 79.8, 80.1, 80.09, 80.31, 80.81, 80.62,
    80.89, 81.22, 81.72, 81.82, 81.99, 82.25, 82.34, 82.41, 82.33, 82.38, 82.38, 82.65, 82.34,
    82.4, 82.57, 82.42, 82.82, 83.36, 83.44, 83.56, 83.54, 83.54, 83.25, 83.52, 83.48, 83.51,
    83.48, 83.41, 83.45, 83.61, 83.85, 83.89, 84.28, 84.28, 84.28, 84.44,
];

fn csv(name: &str) -> String {
    let place = FIVE.iter().position(|share| name == format!("{share}.csv"));
    let (values, every): (&[f64], f64) = match place {
        Some(place) => (&RECORDS[place], 60.0),
        None => (&LONG, 30.0),
    };
    let rows = values.iter().enumerate().map(|(k, v)| format!("{},{v},{v}\n", k as f64 * every));
    format!("t [s],ring [degC],other [degC]\n{}", rows.collect::<String>())
}

const FIVE: [&str; 5] = ["0.2", "0.4", "0.6", "0.8", "1"];

/// The rise after t is share P R (1 - exp(-t / R C)), and what it begins with falls with exp(-t /
/// R C): linear in `P` and `T_start`.
fn netlist(shares: &[&str], fit: &str) -> Netlist {
    let record = |share: &&str| match *share {
        "long" => "\"long.csv\"".to_owned(),
        share => format!("{{ csv = \"{share}.csv\", set = {{ share = {share} }} }}"),
    };
    let records: Vec<String> = shares.iter().map(record).collect();
    let text = format!(
        "format = 1\n[param]\nshare = 1\nP = \"150 W\"\nT_start = \"25 degC\"\nR = \"0.3 K/W\"\n\
         [node]\nbody = {{ C = \"2 kJ/K\", T0 = \"T_start\" }}\n[boundary]\n\
         room = {{ T = \"25 degC\" }}\n[resistor]\n\
         skin = {{ from = \"body\", to = \"room\", R = \"R\" }}\n[source]\n\
         heat = {{ into = \"body\", P = \"share * P\" }}\n[sensor]\n\
         tc = {{ offset = \"free\", per = \"record\" }}\n\
         [fit.all]\ndata = [{}]\n{fit}\n",
        records.join(", ")
    );
    parse_with("body.toml", &text, &mut |path| Ok(csv(&path.to_string_lossy()).into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

const RING: &str = "column = { ring = \"body.T\" }\n";

fn varying(shares: &[&str], what: &str) -> Netlist {
    netlist(shares, &format!("{RING}vary = [{what}]"))
}

fn contender(netlist: &Netlist, name: &str) -> Contender {
    let task = NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2).unwrap();
    Contender { name: name.to_owned(), task }
}

fn chosen(netlists: &[&Netlist], threads: usize) -> Result<Choice, ChoiceError> {
    let named = netlists.iter().zip(["a", "b", "c"]);
    let all: Vec<Contender> = named.map(|(netlist, name)| contender(netlist, name)).collect();
    choose(&all, threads, &|_, _| Proceed::Continue)
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// NumPy 2.4.6 and SciPy 1.17.1: `lstsq` of the closed form with all records and with all but one;
/// the likelihood of each record's residuals as white noise, and by `minimize` with the covariance
/// s^2 (c exp(-|t - t'| / theta) + (1 - c) [t = t']), which is taken where it is more than 4 lower.
#[test]
fn analytic_records_speak_for_the_network_with_the_right_start() {
    let (a, b) = (varying(&FIVE, "\"P\""), varying(&FIVE, "\"P\", \"T_start\""));
    let choice = chosen(&[&a, &b], 2).unwrap();
    assert_eq!((choice.best, choice.held), (1, Held::EachRecord));
    assert!(choice.is_told(0) && choice.rivals().is_empty());
    let [poor, right] = &choice.contenders[..] else { panic!() };
    near(poor.fit.parameters[0].value, 201.068_882_79, 1e-7);
    near(right.fit.parameters[0].value, 199.710_486_39, 1e-7);
    assert_eq!((poor.likely.means, poor.likely.of_noise, right.likely.of_noise), (150, 15, 5));
    near(poor.likely.misfit, 45.602_488_576_638_77, 1e-5);
    near(right.likely.misfit, -31.818_629_839_872_134, 1e-6);
    near(poor.likely.aicc.unwrap(), 81.692_714_140_548_53, 1e-5);
    near(right.likely.aicc.unwrap(), -17.029_897_445_505_938, 1e-6);
    near(poor.weight.unwrap(), 3.653_063_946_429_256_8e-22, 1e-3);
    let (one, other) = (poor.whiteness[0].unwrap(), right.whiteness[0].unwrap());
    near(one.statistic, 200.509_110_764_553_33, 1e-5);
    near(one.p, 6.469_944_475_416_242e-20, 1e-3);
    assert_eq!(other.degrees, 50);
    near(other.statistic, 60.573_079_388_898_81, 1e-4);
    near(other.p, 0.145_383_943_957_8, 1e-3);
    let unseen = [
        [0.462_705_984_8, 0.432_404_181_1, 0.470_554_457_5, 0.504_779_960_6, 0.407_485_657_8],
        [0.207_287_476_6, 0.239_454_804_2, 0.227_061_797_0, 0.244_863_154_5, 0.194_213_149_5],
    ];
    for (judged, expected) in choice.contenders.iter().zip(unseen) {
        for (found, expected) in judged.unseen.iter().zip(expected) {
            assert!(found.converged && found.whole && found.samples == 30);
            near(found.rms, expected, 1e-6);
        }
    }
    let behind = poor.behind.unwrap();
    near(behind.ratio, 2.049_157_372_974_812, 1e-6);
    near(behind.interval.unwrap().0, 1.861_156_541_209_295, 1e-4);
    near(behind.interval.unwrap().1, 2.256_148_715_190_117, 1e-4);
    assert_eq!(behind.records, Some(2));
}

/// Of a single record the last third is left out; its noise depends on the row before. The start is
/// where the two networks differ most: 0.64 K, and as much of the heat as that makes of it.
#[test]
fn analytic_of_a_single_record_the_last_third_is_foretold() {
    let (a, b) = (varying(&["long"], "\"P\""), varying(&["long"], "\"P\", \"T_start\""));
    let choice = chosen(&[&a, &b], 2).unwrap();
    assert_eq!((choice.best, choice.held), (1, Held::LastThird { from: 1780.0 }));
    let [poor, right] = &choice.contenders[..] else { panic!() };
    near(poor.likely.misfit, -49.150_230_496_182_644, 1e-5);
    near(right.likely.misfit, -57.576_576_688_164_14, 1e-3);
    near(poor.likely.aicc.unwrap(), -40.679_642_260_888_53, 1e-5);
    near(right.likely.aicc.unwrap(), -46.862_290_973_878_42, 1e-3);
    near(poor.unseen[0].rms, 0.425_532_818_603_635_73, 1e-6);
    near(right.unseen[0].rms, 0.326_611_066_668_075_16, 1e-6);
    assert_eq!(poor.unseen[0].samples, 30);
    assert!(poor.behind.unwrap().interval.is_none() && choice.is_told(0));
    let apart = poor.apart.unwrap();
    assert!(apart.time < 1e-9, "{apart:?}");
    near(apart.by, 0.643_431_91, 1e-6);
}

/// A resistance that is right as it is makes nothing better, so the records do not tell it.
#[test]
fn what_is_not_told_apart_leaves_the_simplest() {
    let b = varying(&FIVE, "\"P\", \"T_start\"");
    let c = varying(&FIVE, "\"P\", \"T_start\", \"R\"");
    let choice = chosen(&[&c, &b], 2).unwrap();
    assert_eq!(choice.rivals().len(), 1);
    assert_eq!(choice.simplest(), 1);
    // twice the same network is as good as itself, to the errors of the runs
    let same = chosen(&[&b, &b], 2).unwrap();
    assert_eq!(same.rivals(), [1]);
    near(same.contenders[1].behind.unwrap().ratio, 1.0, 1e-12);
    near(same.contenders[1].weight.unwrap(), 0.5, 1e-12);
}

#[test]
fn the_order_of_records_and_the_number_of_threads_do_not_matter() {
    let (a, b) = (varying(&FIVE, "\"P\""), varying(&FIVE, "\"P\", \"T_start\""));
    let turned = varying(&["1", "0.6", "0.2", "0.4", "0.8"], "\"P\", \"T_start\"");
    let [one, other] = [(&b, 1), (&turned, 5)].map(|(b, n)| chosen(&[&a, b], n).unwrap());
    for (one, other) in one.contenders.iter().zip(&other.contenders) {
        let rms = |judged: &lptn_fit::choice::Judged| -> Vec<u64> {
            judged.unseen.iter().map(|part| part.rms.to_bits()).collect()
        };
        assert_eq!(rms(one).len(), 5);
        for (a, b) in one.unseen.iter().zip(&other.unseen) {
            near(b.rms, a.rms, 1e-6);
        }
    }
    let again = chosen(&[&a, &b], 7).unwrap();
    assert_eq!(format!("{:?}", again.contenders), format!("{:?}", one.contenders));
}

#[test]
fn what_is_no_comparison_is_refused() {
    let whole = varying(&FIVE, "\"P\"");
    let code = |other: &Netlist| chosen(&[&whole, other], 1).unwrap_err().code();
    assert_eq!(chosen(&[&whole], 1).unwrap_err().code(), "fit::one_candidate");
    assert_eq!(code(&varying(&FIVE[1..], "\"P\"")), "fit::other_records");
    assert_eq!(code(&varying(&["long"], "\"P\"")), "fit::other_records");
    let other = netlist(&FIVE, "column = { other = \"body.T\" }\nvary = [\"P\"]");
    assert_eq!(code(&other), "fit::other_columns");
    let both = "column = { ring = \"body.T\", other = \"body.T\" }\nvary = [\"P\"]";
    assert_eq!(code(&netlist(&FIVE, both)), "fit::other_columns");
    let sure = netlist(&FIVE, &format!("{RING}sigma = \"0.1 K\"\nvary = [\"P\"]"));
    assert_eq!(code(&sure), "fit::other_sigma");
    let open = "column = { ring = { of = \"body.T\", sensor = \"tc\" } }\nvary = [\"P\"]";
    assert_eq!(code(&netlist(&FIVE, open)), "fit::unseen_offset");
    let longer = chosen(&[&varying(&FIVE[1..], "\"P\""), &whole], 1).unwrap_err();
    assert_eq!(longer.code(), "fit::other_records");
    assert_eq!(longer.contender(), Some("a"));
}
