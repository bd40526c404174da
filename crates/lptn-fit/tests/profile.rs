//! Reference: intervals that are not even, against the closed form of one body.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::network::{FittedParameter, NetworkFitTask, fit_network};
use lptn_netlist::parse_with;

/// What was read every 20 s of a body of 2659 J/K behind 0.3 K/W: eight times in its first 140 s it
/// tells the capacity, but hardly that heat leaves at all.
const READ: [f64; 8] = [0.05, 1.53, 3.41, 4.68, 6.33, 7.95, 9.53, 10.88];
const HEAT: f64 = 220.6;

fn fit(bounds: &str) -> Vec<FittedParameter> {
    let mut csv = String::from("t [s],ring [degC]\n");
    for (k, rise) in (0..).zip(READ) {
        csv += &format!("{},{}\n", 20 * k, 25.0 + rise);
    }
    let text = format!(
        "format = 1\n[param]\nG = \"6 W/K\"\nC = \"2 kJ/K\"\n[node]\nbody = {{ C = \"C\", T0 = \
         \"25 degC\" }}\n[boundary]\nroom = {{ T = \"25 degC\" }}\n[resistor]\nskin = {{ from = \
         \"body\", to = \"room\", R = \"1 / G\" }}\n[source]\nheat = {{ into = \"body\", P = \"220.6 W\" \
         }}\n[fit.all]\ndata = \"r.csv\"\ncolumn = {{ ring = \"body.T\" }}\nvary = {bounds}\n"
    );
    let netlist = parse_with("body.toml", &text, &mut |_| Ok(csv.clone().into_bytes()))
        .unwrap_or_else(|rejected| panic!("{rejected}"));
    let task = NetworkFitTask::of(&netlist, &netlist.studies.fits[0], 1).unwrap();
    fit_network(&task).unwrap().parameters
}

/// T - 25 degC = P / G (1 - exp(-G t / C)) less what was read, squared and summed.
fn squares(conductance: f64, capacity: f64) -> f64 {
    let miss = |(k, read): (u32, f64)| {
        let x = conductance * f64::from(20 * k) / capacity;
        (HEAT / conductance * -(-x).exp_m1() - read).powi(2)
    };
    (0..).zip(READ).map(miss).sum()
}

/// The least over the capacity: golden section.
fn profile(conductance: f64) -> (f64, f64) {
    let (mut low, mut high) = (1000.0, 5000.0);
    let share = (5_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..80 {
        let (a, b) = (high - share * (high - low), low + share * (high - low));
        if squares(conductance, a) < squares(conductance, b) { high = b } else { low = a }
    }
    (squares(conductance, low), low)
}

/// `[(J^T J)^-1]` of the conductance, by differences of the closed form.
fn bread(conductance: f64, capacity: f64) -> f64 {
    let read = |g: f64, c: f64, k: u32| HEAT / g * -(-g * f64::from(20 * k) / c).exp_m1();
    let mut sums = [0.0; 3];
    for k in 0..8 {
        let (g, c) = (1e-4 * conductance, 1e-4 * capacity);
        let slope = |up: (f64, f64), down: (f64, f64), step: f64| {
            (read(up.0, up.1, k) - read(down.0, down.1, k)) / (2.0 * step)
        };
        let by_g = slope((conductance + g, capacity), (conductance - g, capacity), g);
        let by_c = slope((conductance, capacity + c), (conductance, capacity - c), c);
        sums = [sums[0] + by_g * by_g, sums[1] + by_g * by_c, sums[2] + by_c * by_c];
    }
    sums[2] / (sums[0] * sums[2] - sums[1] * sums[1])
}

/// A conductance of 3 ± 5 W/K cannot be below 0: the interval is "below", and ends where the sum of
/// squares, the capacity fitted again, has risen by what the even interval says.
#[test]
fn a_parameter_near_nothing_is_bounded_on_one_side() {
    let found = fit(r#"{ G = { from = "1 mW/K", to = "1 kW/K" }, C = {} }"#);
    let (conductance, capacity) = (&found[0], &found[1]);
    let half = conductance.half_width.unwrap();
    assert!(conductance.value - half < 0.0, "{conductance:?}");
    let ends = conductance.profile.unwrap();
    assert!(ends.low.is_none(), "{ends:?}");
    let high = ends.high.unwrap();
    let rise = half * half / bread(conductance.value, capacity.value);
    let (least, _) = profile(conductance.value);
    let excess = (profile(high).0 - least) / rise;
    assert!((excess - 1.0).abs() < 2e-3, "{high}: {excess}");
    // the capacity is known well, and its interval is even
    assert!(capacity.profile.is_none(), "{capacity:?}");
}

/// On a bound there is no standard error, but what is possible above it.
#[test]
fn a_parameter_on_a_bound_has_an_interval_too() {
    let found = fit(r#"{ G = { from = "5 W/K", to = "1 kW/K" }, C = {} }"#);
    let conductance = &found[0];
    assert!(conductance.on_bound.is_some() && conductance.standard_error.is_none());
    let ends = conductance.profile.unwrap();
    assert!(ends.low.is_none());
    // beyond the bound, and not farther than where the free fit ends
    let high = ends.high.unwrap();
    let free = fit(r#"{ G = { from = "1 mW/K", to = "1 kW/K" }, C = {} }"#);
    assert!(high > 5.0 && high < 3.0 * free[0].profile.unwrap().high.unwrap(), "{high}");
}
