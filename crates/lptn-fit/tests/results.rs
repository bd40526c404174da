//! Heat flows and expressions as columns of a fit. Expected values are those of closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{NetworkFit, NetworkFitError, NetworkFitTask, fit_network};
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::{Gradient, Transient, sensitive_run};

/// A body of 2659 J/K behind a skin without capacity, 0.1 K/W to that and 0.2 K/W on, 220.6 W.
const TAU: f64 = 0.3 * 2659.0;
const POWER: f64 = 220.6;

fn netlist(param: &str, fit: &str, csv: &str) -> Netlist {
    let text = format!(
        "format = 1\n[param]\nR1 = \"0.13 K/W\"\nR2 = \"0.17 K/W\"\nP = \"180 W\"\n{param}\n[node]\n\
         body = {{ C = \"2659 J/K\", T0 = \"25 degC\" }}\nskin = {{ massless = true }}\n[boundary]\n\
         air = {{ T = \"25 degC\" }}\n[resistor]\ninner = {{ from = \"body\", to = \"skin\", R = \
         \"R1\" }}\nouter = {{ from = \"skin\", to = \"air\", R = \"R2\" }}\n[source]\nheat = {{ into \
         = \"body\", P = \"P\" }}\n{fit}\n"
    );
    parse_with("body.toml", &text, &mut |_| Ok(csv.as_bytes().to_vec()))
        .unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn fitted(netlist: &Netlist) -> Result<NetworkFit, NetworkFitError> {
    fit_network(&NetworkFitTask::of(netlist, &netlist.studies.fits[0], 2)?)
}

/// A record of what `of` makes of the heat that leaves the body at each time.
fn record(header: &str, of: impl Fn(f64, f64) -> Vec<f64>) -> String {
    let mut csv = format!("t [s],{header}\n");
    for t in (0..60).map(|k| 30.0 * f64::from(k)) {
        let cells = of(t, POWER * (1.0 - f64::exp(-t / TAU)));
        let cells: Vec<String> = cells.iter().map(|cell| format!("{cell:.10}")).collect();
        csv += &format!("{t},{}\n", cells.join(","));
    }
    csv
}

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} is not {expected}");
}

/// The heat tells P and R1 + R2, the difference across the inside of the skin R1; no temperature is
/// measured, and the skin is massless.
#[test]
fn analytic_a_heat_flow_and_a_difference_determine_three_parameters() {
    let csv = record("q [W],dt [K]", |_, q| vec![q, 0.1 * q]);
    let fit = "[fit.all]\ndata = \"r.csv\"\nvary = [\"P\", \"R1\", \"R2\"]\n\
               column.q = { of = \"outer.Q\", sigma = \"1 W\" }\n\
               column.dt = { of = \"body.T - skin.T\", sigma = \"0.1 K\" }";
    let fit = fitted(&netlist("", fit, &csv)).unwrap();
    assert_eq!(fit.gradient, Gradient::Exact);
    for (found, expected) in fit.parameters.iter().zip([POWER, 0.1, 0.2]) {
        near(found.value, expected, 1e-6);
    }
}

/// A factor of the expression itself, which nothing in the network uses: beside an R1 that is known
/// it is found, beside one that is not only their product is.
#[test]
fn analytic_a_parameter_of_the_expression_itself_is_found() {
    let csv = record("q [W],u [W/K]", |_, q| vec![q, 3.5 * 0.1 * q / 4.0]);
    let of = |vary: &str| {
        let fit = format!(
            "[fit.all]\ndata = \"r.csv\"\nvary = [{vary}]\ncolumn.q = {{ of = \"outer.Q\", sigma = \
             \"1 W\" }}\ncolumn.u = {{ of = \"k * (body.T - skin.T) / 4 [K^2]\", sigma = \"0.01 W/K\" }}"
        );
        fitted(&netlist("k = \"3 W\"", &fit, &csv)).unwrap()
    };
    // R1 is held at 0.13 K/W
    let fit = of("\"P\", \"R2\", \"k\"");
    for (found, expected) in fit.parameters.iter().zip([POWER, 0.17, 3.5 * 0.1 / 0.13]) {
        near(found.value, expected, 1e-6);
    }
    let known = of("\"P\", \"R1\", \"R2\", \"k\"").identifiability.unwrap();
    assert!(!known.is_whole() && known.rank == 3, "{known:?}");
}

/// At every time, by every parameter: Q = P (1 - e), e = exp(-t / (C (R1 + R2))), and the rise of
/// the body over the skin is R1 Q.
#[test]
fn analytic_derivatives_of_heats_and_expressions() {
    let netlist = netlist("", "", "");
    let network = &netlist.network;
    let fit =
        "[fit.all]\ndata = \"r.csv\"\nvary = [\"P\"]\ncolumn.q = \"outer.Q * kelvin(body.T)\"\n";
    let csv = record("q [W K]", |_, q| vec![q]);
    let with = self::netlist("", fit, &csv);
    let value = &with.studies.fits[0].observed[0].value;
    let ids = ["P", "R1", "R2"].map(|name| with.network.parameter(name).unwrap());
    let run = Transient::until(lptn_network::Time(2000.0)).tolerance(1e-9);
    let found = sensitive_run(&with.network, &run, &ids).unwrap();
    assert_eq!(network.nodes().len(), 2);
    let (p, r, c) = (180.0, 0.3, 2659.0);
    for (row, t) in found.solution.times().iter().enumerate() {
        let e = f64::exp(-t / (r * c));
        let (q, body) = (p * (1.0 - e), 298.15 + r * p * (1.0 - e));
        let by_r = -p * e * t / (c * r * r);
        // of the body: P (1 - e) + R dQ/dR
        let expected = [
            (1.0 - e) * body + q * r * (1.0 - e),
            by_r * body + q * (q + r * by_r),
            by_r * body + q * (q + r * by_r),
        ];
        // 10 tolerances of the run, times 1500 W/K
        assert!((found.solution.result(value)[row] - q * body).abs() < 1.5e-5);
        for (id, expected) in ids.iter().zip(expected) {
            let slope = found.result_slope(*id, value).unwrap()[row];
            assert!((slope - expected).abs() < 1e-7 * (1e4 + expected.abs()), "{slope} {expected}");
        }
    }
}

/// An expression that compares the time is read on its own side of each jump, at a row too.
#[test]
fn analytic_an_expression_jumps_at_times_of_its_own() {
    let jumps = |t: f64, q: f64| if t < 600.0 { q } else { 0.5 * q };
    let csv =
        record("q [W]", |t, q| vec![if (200.0..400.0).contains(&t) { 2.0 } else { jumps(t, q) }]);
    let of = "if(t < 600 [s], 1, 0.5) * if(t < 200 [s], outer.Q, if(t < 400 [s], 2 [W], outer.Q))";
    let fit = format!(
        "[fit.all]\ndata = \"r.csv\"\nvary = [\"P\", \"R2\"]\ncolumn.q = {{ of = \"{of}\", sigma = \"1 \
         W\" }}"
    );
    let fit = fitted(&netlist("", &fit, &csv)).unwrap();
    for (found, expected) in fit.parameters.iter().zip([POWER, 0.17]) {
        near(found.value, expected, 1e-6);
    }
}

/// P, R2, offset and time constant.
const SCIPY: [f64; 4] = [220.600_002, 0.169_999_996, 2.978_832_55, 39.824_041];

/// A heat flux sensor with a time constant of 40 s and an offset of which ± 5 W is known: its answer
/// to `1 - exp(-t / tau)` is a closed form, to which SciPy's `least_squares` fits the same four values
/// beside the same priors.
#[test]
fn analytic_a_sensor_of_heat_has_offset_and_lag_in_its_own_unit() {
    let lag = 40.0;
    let csv = record("q [W],ring [degC]", |t, q| {
        let (body, own) = (f64::exp(-t / TAU), f64::exp(-t / lag));
        let slow = POWER * (1.0 - (TAU * body - lag * own) / (TAU - lag));
        vec![slow + 3.0, 25.0 + 0.3 * q]
    });
    let fit = "[sensor]\nflux = { offset = \"0 ± 5 W\", lag = \"30 ± 20 s\", resolution = \"1 W\" }\n\
               [fit.all]\ndata = \"r.csv\"\nvary = [\"P\", \"R2\"]\n\
               column.q = { of = \"outer.Q\", sensor = \"flux\", sigma = \"1 W\" }\n\
               column.ring = { of = \"body.T\", sigma = \"0.001 K\" }";
    let netlist = netlist("", fit, &csv);
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 2).unwrap();
    assert_eq!(task.unknowns()[2].ty.dimension.si_unit(), "W");
    let sigma = task.runs[0].columns[0].sigma.unwrap();
    near(sigma, (1.0_f64 + 1.0 / 12.0).sqrt(), 1e-12);
    let fit = fit_network(&task).unwrap();
    for (found, expected) in fit.parameters.iter().zip(SCIPY) {
        near(found.value, expected, 1e-5);
    }
}

#[test]
fn columns_that_cannot_be_compared_are_refused() {
    let csv = record("q [W],ring [degC]", |_, q| vec![q, 25.0 + 0.3 * q]);
    let fit = |column: &str| {
        let text = format!("[fit.all]\ndata = \"r.csv\"\nvary = [\"P\"]\n{column}");
        fitted(&netlist("", &text, &csv))
    };
    let error = fit("column = { q = \"outer.Q\", ring = \"body.T\" }").unwrap_err();
    assert_eq!(error.code(), "fit::units");
    let error = fit("column = { q = \"P\" }").unwrap_err();
    assert_eq!(error.code(), "fit::observed");
    // ln 0 at the start: refused where something was measured there, and a gap otherwise
    let tell = |first: &str| {
        let csv = record("n", |_, q| vec![f64::ln(0.1 * q)]).replace("-inf", first);
        let text =
            "[fit.all]\ndata = \"r.csv\"\nvary = [\"P\"]\ncolumn.n = \"ln(inner.Q * R1 / 1 [K])\"";
        let netlist = netlist("", text, &csv.replace("n\n", "n [1]\n"));
        fitted(&netlist)
    };
    assert_eq!(tell("-9").unwrap_err().code(), "fit::no_value");
    near(tell("").unwrap().parameters[0].value, POWER * 0.1 / 0.13, 1e-6);
    // alone, heat is compared by the watt
    near(fit("column = { q = \"outer.Q\" }").unwrap().parameters[0].value, POWER, 1e-6);
}
