//! What a search does along directions that the records leave open: it ends, and the verdict names
//! them. The expected combinations are those of the closed forms of one body with constant power,
//! fitted to the same numbers by SciPy 1.17's `least_squares`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFit, NetworkFitError, NetworkFitTask, Unseparated, fit_network};
use lptn_netlist::{Netlist, parse_with};

/// One body of `R` and `C` that 100 W heat from 20 degC, with records of 1800 s.
fn body([r, c]: [&str; 2], (head, rest): (&str, &str), value: impl Fn(f64) -> f64) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nR = \"{r} K/W\"\nC = \"{c} kJ/K\"\nP = \"100 W\"\n\
         [node]\nbody = {{ C = \"C\", T0 = \"20 degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n\
         [resistor]\nskin = {{ from = \"body\", to = \"air\", R = \"R\" }}\n\
         [source]\nheat = {{ into = \"body\", P = \"P\" }}\n{rest}"
    );
    let mut csv = format!("t [s],y [{head}]\n");
    (0..181).map(|k| 10.0 * f64::from(k)).for_each(|t| csv += &format!("{t},{}\n", value(t)));
    parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// Noise that every program has alike, of this standard deviation.
fn noise(t: f64, sigma: f64, phase: f64) -> f64 {
    sigma * 2_f64.sqrt() * f64::sin(t * t / 100.0 + phase)
}

fn fitted(netlist: &Netlist) -> NetworkFit {
    let task = NetworkFitTask::of(netlist, &netlist.studies.fits[0], 1).unwrap();
    fit_network(&task).unwrap()
}

/// The only open group, of a fit that ended.
#[track_caller]
fn open(fit: &NetworkFit, what: &str) -> Unseparated {
    assert_eq!(fit.not_converged, None, "{what}");
    let known = fit.identifiability.as_ref().unwrap();
    assert_eq!((known.unseparated.len(), known.unfelt.len()), (1, 0), "{what}: {known:?}");
    known.unseparated[0].clone()
}

const STARTS: [[&str; 2]; 3] = [["0.3", "2"], ["0.32", "1.9"], ["0.1", "9"]];

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} is not {expected}");
}

/// `Q = P (1 - exp(-t / (R C)))`: a heat flow tells R C alone.
#[test]
fn a_heat_flow_tells_a_time_constant_and_the_search_ends() {
    let expected = [(0.0, 599.699_093), (1.0, 598.780_672), (2.0, 598.983_831)];
    for (start, (phase, expected)) in STARTS.into_iter().zip(expected) {
        let flow = |t: f64| 100.0 * (1.0 - f64::exp(-t / 600.0)) + noise(t, 1.0, phase);
        let study = "[fit.a]\ndata = \"r.csv\"\ncolumn.y = { of = \"skin.Q\", sigma = \"1 W\" }\n\
            vary = [\"R\", \"C\"]\n";
        let netlist = body(start, ("W", study), flow);
        let group = open(&fitted(&netlist), &format!("{start:?}"));
        assert_eq!((group.parameters.as_slice(), group.missing), (&[0, 1][..], 1));
        let found = &group.determined.as_ref().unwrap()[0];
        assert_eq!(found.terms, [(0, 1), (1, 1)]);
        near(found.value, expected);
    }
}

/// `T - T_air = P R (1 - exp(-t / (R C)))`: a difference tells P R and R C.
#[test]
fn a_difference_tells_two_products_and_the_search_ends() {
    let expected = [
        (0.0, [29.966_201, 598.097_527]),
        (1.0, [29.881_612, 593.167_902]),
        (2.0, [29.905_266, 594.489_921]),
    ];
    for (start, (phase, expected)) in STARTS.into_iter().zip(expected) {
        let rise = |t: f64| 30.0 * (1.0 - f64::exp(-t / 600.0)) + noise(t, 0.3, phase);
        let study = "[fit.a]\ndata = \"r.csv\"\n\
            column.y = { of = \"body.T - air.T\", sigma = \"0.3 K\" }\n\
            vary = [\"R\", \"C\", \"P\"]\n";
        let netlist = body(start, ("K", study), rise);
        let group = open(&fitted(&netlist), &format!("{start:?}"));
        assert_eq!((group.parameters.as_slice(), group.missing), (&[0, 1, 2][..], 1));
        let mut values: Vec<f64> =
            group.determined.as_ref().unwrap().iter().map(|found| found.value).collect();
        values.sort_by(f64::total_cmp);
        values.into_iter().zip(expected).for_each(|(found, expected)| near(found, expected));
    }
}

/// With `initial`, what is read is `y0 exp(-t / (R C)) + (T_air + P R + offset) (1 - exp(..))`: an
/// offset of which nothing is known trades with R, and C follows R.
#[test]
fn a_free_offset_that_the_start_takes_off_again_is_not_determined() {
    let expected = [
        (0.0, [29.988_691, 599.363_594]),
        (1.0, [30.014_439, 602.783_520]),
        (2.0, [30.027_088, 603.657_605]),
    ];
    for (start, (phase, expected)) in STARTS.into_iter().zip(expected) {
        let read = |t: f64| 20.0 + 30.0 * (1.0 - f64::exp(-t / 600.0)) + noise(t, 0.1, phase);
        let study = "[sensor]\ntc = { offset = \"free\" }\n[fit.a]\ndata = \"r.csv\"\n\
            column.y = { of = \"body.T\", sensor = \"tc\" }\nsigma = \"0.1 K\"\n\
            initial = \"record\"\nvary = [\"R\", \"C\"]\n";
        let netlist = body(start, ("degC", study), read);
        let fit = fitted(&netlist);
        let group = open(&fit, &format!("{start:?}"));
        assert_eq!((group.parameters.as_slice(), group.missing), (&[0, 1, 2][..], 1));
        let value = |i: usize| fit.parameters[i].value;
        near(100.0 * value(0) + value(2), expected[0]);
        near(value(0) * value(1), expected[1]);
        assert!(fit.parameters.iter().all(|parameter| parameter.standard_error.is_none()));
    }
}

/// An offset that is known to 1e9 K is as good as free: R and C stay felt and are determined.
#[test]
fn an_offset_known_to_nothing_hides_no_parameter() {
    let read = |t: f64| 21.0 + 30.0 * (1.0 - f64::exp(-t / 600.0)) + noise(t, 0.1, 0.0);
    let of = |offset: &str| {
        let study = format!(
            "[sensor]\ntc = {{ offset = \"{offset}\" }}\n[fit.a]\ndata = \"r.csv\"\n\
             column.y = {{ of = \"body.T\", sensor = \"tc\" }}\nsigma = \"0.1 K\"\n\
             vary = [\"R\", \"C\"]\n"
        );
        let fit = fitted(&body(STARTS[1], ("degC", &study), read));
        assert!(fit.not_converged.is_none() && fit.identifiability.as_ref().unwrap().is_whole());
        [0, 1, 2].map(|i| fit.parameters[i].value)
    };
    let (wide, free) = (of("0 ± 1e9 K"), of("free"));
    for (wide, free) in wide.into_iter().zip(free) {
        assert!((wide / free - 1.0).abs() < 1e-4, "{wide} {free}");
    }
    assert!((wide[2] - 1.0).abs() < 0.1);
}

/// A mean over the record is no start of it.
#[test]
fn a_mean_over_more_than_half_of_the_record_is_refused() {
    let read = |t: f64| 20.0 + 30.0 * (1.0 - f64::exp(-t / 600.0));
    for (initial, refused) in [("2 h", true), ("1000 s", true), ("900 s", false), ("20 s", false)] {
        let study = format!(
            "[fit.a]\ndata = \"r.csv\"\ncolumn.y = \"body.T\"\nsigma = \"0.1 K\"\n\
             initial = \"{initial}\"\nvary = [\"R\", \"C\"]\n"
        );
        let netlist = body(STARTS[0], ("degC", &study), read);
        let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1);
        let code = task.err().map(|error: NetworkFitError| error.code());
        assert_eq!(code, refused.then_some("fit::initial_mean"), "{initial}");
    }
}
