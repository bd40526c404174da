//! Gradients of runs that switch, against closed forms.

use lptn_netlist::parse;
use lptn_solve::Proceed;
use lptn_study::sweep::{Cases, SweepTask};
use lptn_study::{GradientError, Gradients};

const STOP: f64 = 1000.0;

/// A body in air of 25 degC with a heater that a thermostat switches: 33 switches.
#[derive(Clone, Copy)]
struct Heater {
    power: f64,
    conductance: f64,
    capacity: f64,
    /// Rise over air at which it goes on, and off, in K.
    thresholds: [f64; 2],
    dwell: f64,
}

const HEATER: Heater =
    Heater { power: 40.0, conductance: 2.0, capacity: 500.0, thresholds: [9.0, 10.0], dwell: 0.0 };

/// Results of a run.
#[derive(Clone, Copy)]
struct Ran {
    last: f64,
    most: f64,
    mean: f64,
    /// Heat of the heater in J.
    heat: f64,
    switches: usize,
}

impl Heater {
    fn of([power, conductance, capacity, on, off, dwell]: [f64; 6]) -> Self {
        Self { power, conductance, capacity, thresholds: [on, off], dwell }
    }

    fn values(self) -> [f64; 6] {
        let [on, off] = self.thresholds;
        [self.power, self.conductance, self.capacity, on, off, self.dwell]
    }

    /// Part by part: the rise goes to P/G or 0 as `exp(-G t / C)`.
    fn run(self) -> Ran {
        let tau = self.capacity / self.conductance;
        let (mut on, mut rise, mut time, mut switches) = (true, 0.0_f64, 0.0_f64, 0);
        let (mut most, mut area, mut heat) = (0.0_f64, 0.0, 0.0);
        loop {
            let target = if on { self.power / self.conductance } else { 0.0 };
            let threshold = self.thresholds[usize::from(on)];
            let reached = tau * ((rise - target) / (threshold - target)).ln();
            let held = if switches == 0 { 0.0 } else { self.dwell };
            let lasts = reached.max(held).min(STOP - time);
            let end = target + (rise - target) * (-lasts / tau).exp();
            area += target * lasts + tau * (rise - end);
            heat += if on { self.power * lasts } else { 0.0 };
            most = most.max(end);
            (rise, time) = (end, time + lasts);
            if time >= STOP {
                return Ran { last: rise, most, mean: area / STOP, heat, switches };
            }
            (on, switches) = (!on, switches + 1);
        }
    }

    /// The derivatives of a result by all values, by central differences of the sixth order.
    fn slopes(self, of: impl Fn(Ran) -> f64) -> [f64; 6] {
        let mut slopes = [0.0; 6];
        for (k, slope) in slopes.iter_mut().enumerate() {
            let h = 2e-5 * self.values()[k].max(0.1);
            let at = |steps: f64| {
                let mut values = self.values();
                values[k] += steps * h;
                of(Self::of(values).run())
            };
            let side = |n: f64| at(n) - at(-n);
            *slope = (45.0 * side(1.0) - 9.0 * side(2.0) + side(3.0)) / (60.0 * h);
        }
        slopes
    }

    fn text(self) -> String {
        let [power, conductance, capacity, on, off, dwell] = self.values();
        format!(
            "format = 1\n[param]\nP = \"{power} W\"\nG = \"{conductance} W/K\"\nC = \"{capacity} \
             J/K\"\non = \"{on} K\"\noff = \"{off} K\"\ndwell = \"{dwell} s\"\n[node]\nblock = {{ C \
             = \"C\", T0 = \"25 degC\" }}\n[boundary]\nair = {{ T = \"25 degC\" }}\n[resistor]\n\
             cooling = {{ from = \"block\", to = \"air\", G = \"G\" }}\n[control]\nheater = {{ sense \
             = \"block\", on_below = \"25 [degC] + on\", off_above = \"25 [degC] + off\", start = \
             \"on\", min_dwell = \"dwell\" }}\n[source]\nheat = {{ into = \"block\", P = \"P * \
             heater\" }}\n"
        )
    }
}

const AXES: [&str; 6] = ["P", "G", "C", "on", "off", "dwell"];

/// The gradients of `reports` by `axes`, at the values of the netlist.
fn gradients(text: &str, axes: &[&str], reports: &str) -> Result<Gradients, GradientError> {
    // a line of [param] is a line of `axes`
    let value = |axis: &str| {
        let mut lines = text.lines().filter_map(|line| line.strip_prefix(&format!("{axis} = ")));
        format!("{axis} = [{}]", lines.next().unwrap())
    };
    let listed: Vec<String> = axes.iter().map(|axis| value(axis)).collect();
    let run = format!(
        "{text}[run]\nstop = \"{STOP} s\"\ntolerance = \"1e-10 K\"\n[sweep.grad]\nmethod = \
         \"list\"\nover = \"run\"\naxes = {{ {} }}\nreport = {{ {reports} }}\n",
        listed.join(", ")
    );
    let netlist = parse("gradient.toml", &run).unwrap_or_else(|rejected| panic!("{rejected}"));
    let study = netlist.studies.sweeps[0].clone();
    let cases = Cases::new(study.plan(&netlist.network).unwrap());
    let own: Vec<f64> = cases.parameters().map(|id| netlist.network.parameter_value(id)).collect();
    SweepTask::new(netlist, study, cases)
        .unwrap()
        .gradients(&own, (usize::MAX, &[]), &|_| Proceed::Continue)
}

/// Sums over many switches: to 1e-8 of themselves, or of 1 in SI units.
#[track_caller]
fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let size = expected.abs().max(1.0);
        assert!((found - expected).abs() <= 1e-8 * size, "{found:e} is not {expected:e}");
    }
}

const REPORTS: &str = "end = \"last(block.T)\", top = \"max(block.T)\", mean = \"mean(block.T)\", \
                       heat = \"integral(heat.P)\"";

#[track_caller]
fn agrees(heater: Heater, switches: usize) {
    let ran = heater.run();
    assert_eq!(ran.switches, switches);
    let found = gradients(&heater.text(), &AXES, REPORTS).unwrap();
    let air = 298.15;
    near(&found.values, &[air + ran.last, air + ran.most, air + ran.mean, ran.heat]);
    near(&found.slopes[0], &heater.slopes(|ran| ran.last));
    near(&found.slopes[1], &heater.slopes(|ran| ran.most));
    near(&found.slopes[2], &heater.slopes(|ran| ran.mean));
    near(&found.slopes[3], &heater.slopes(|ran| ran.heat));
}

/// The largest temperature is that at which the heater goes off; the heat jumps at each switch.
#[test]
fn a_thermostat_of_33_switches_has_its_closed_form() {
    agrees(HEATER, 33);
}

/// Cooling from 10 K to 9 K takes 26.3 s and a dwell lasts 40 s, so that dwells alone end.
#[test]
fn a_dwell_moves_as_the_switch_at_which_it_began() {
    agrees(Heater { dwell: 40.0, ..HEATER }, 21);
}

/// Now and then the dwell decides, else the threshold.
#[test]
fn dwells_and_thresholds_alternate() {
    agrees(Heater { dwell: 25.0, ..HEATER }, 32);
}

/// The heat falls by a comparison when the rise passes 10 K: it goes to 20 K until then, and to 12 K
/// from there.
#[test]
fn a_comparison_has_its_closed_form() {
    let text = "format = 1\n[param]\nP = \"40 W\"\nG = \"2 W/K\"\nC = \"500 J/K\"\nbend = \"10 K\"\n\
                [node]\nblock = { C = \"C\", T0 = \"25 degC\" }\n[boundary]\nair = { T = \"25 degC\" \
                }\n[resistor]\ncooling = { from = \"block\", to = \"air\", G = \"G\" }\n[source]\nheat = \
                { into = \"block\", P = \"if(block.T < 25 [degC] + bend, P, 0.6 * P)\" }\n";
    let end = |[p, g, c, bend]: [f64; 4]| {
        let (before, after, tau) = (p / g, 0.6 * p / g, c / g);
        let reached = tau * (before / (before - bend)).ln();
        after + (bend - after) * (-(STOP - reached) / tau).exp()
    };
    let own = [40.0, 2.0, 500.0, 10.0];
    let found = gradients(text, &["P", "G", "C", "bend"], "end = \"last(block.T)\"").unwrap();
    near(&found.values, &[298.15 + end(own)]);
    let slope = |k: usize| {
        let h = 3e-4 * own[k];
        let at = |steps: f64| {
            let mut values = own;
            values[k] += steps * h;
            end(values)
        };
        let side = |n: f64| at(n) - at(-n);
        (45.0 * side(1.0) - 9.0 * side(2.0) + side(3.0)) / (60.0 * h)
    };
    near(&found.slopes[0], &[0, 1, 2, 3].map(slope));
}

/// Two heaters that are alike switch at one time: which of the two goes first is not determined.
#[test]
fn switches_at_one_time_are_refused() {
    let one = HEATER.text();
    let two = one.replace(
        "[resistor]\n",
        "[resistor]\ntoo = { from = \"other\", to = \"air\", G = \"G\" }\n",
    );
    let two = two.replace("[boundary]", "other = { C = \"C\", T0 = \"25 degC\" }\n[boundary]");
    let two = two.replace(
        "[source]\n",
        "second = { sense = \"other\", on_below = \"34 degC\", off_above = \"35 degC\", start = \
         \"on\" }\n[source]\nmore = { into = \"other\", P = \"P * second\" }\n",
    );
    let error = gradients(&two, &["P", "on"], "end = \"last(block.T)\"").unwrap_err();
    assert_eq!(lptn_units::Problem::code(&error), "gradient::together");
}
