//! Bands and shares from exact sensitivities, against closed forms of one node.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{ONE_NODE, RADIATING, RISE, near, parsed, sobol, task};
use lptn_netlist::Netlist;
use lptn_study::uncertainty::{Answer, AnswerOf, Uncertainty, UncertaintyMethod, discrepancies};

fn linear(netlist: &Netlist) -> Uncertainty {
    task(netlist).linear().unwrap_or_else(|error| panic!("{error}"))
}

fn answer(found: &Uncertainty, wanted: impl Fn(&AnswerOf) -> bool) -> &Answer {
    found.answers.iter().find(|answer| wanted(&answer.of)).unwrap()
}

/// The effects in the order of the parameters.
fn effects(answer: &Answer) -> Vec<f64> {
    let of = |input: usize| answer.ranking.iter().find(|part| part.input == input).unwrap().effect;
    (0..answer.ranking.len()).map(of).collect()
}

#[track_caller]
fn all_near(found: &[f64], expected: &[f64]) {
    let size = expected.iter().map(|x| x.abs()).fold(0.0, f64::max);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-6 * size, "{found} is not {expected}");
    }
}

const PARAMETERS: &str =
    "R = \"0.5 K/W ± 4 %\"\nC = \"1 kJ/K ± 5 %\"\nP = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"";

fn one_node(more: &str) -> Netlist {
    parsed(&format!("{}{more}", ONE_NODE.replace("C = \"1 kJ/K\"", "C = \"C\"")), PARAMETERS)
}

/// T = T_amb + P R (1 - e^-x) with x = t / (R C), differentiated by R, C, P and T_amb, times one
/// standard deviation each.
fn slopes(t: f64) -> [f64; 4] {
    let (r, c, p) = (0.5, 1000.0, 200.0);
    let x = t / (r * c);
    let decay = f64::exp(-x);
    let by_r = p * (1.0 - decay - x * decay);
    [by_r * 0.02, -p * r * x * decay / c * 50.0, r * (1.0 - decay) * 20.0, 2.0]
}

#[test]
fn analytic_every_sensitivity_of_one_node_is_its_closed_form() {
    let found = linear(&one_node(""));
    assert_eq!(found.method, UncertaintyMethod::Linear { differences: None, bent: vec![] });
    let end = answer(&found, |of| matches!(of, AnswerOf::End(_)));
    all_near(&effects(end), &slopes(1000.0));
    let variance = |t: f64| slopes(t).iter().map(|slope| slope * slope).sum::<f64>();
    near(end.deviation.value, variance(1000.0).sqrt(), 1e-6);
    near(end.ranking[0].share.value, slopes(1000.0)[2].powi(2) / variance(1000.0), 1e-6);
    assert!((end.ranking.iter().map(|part| part.share.value).sum::<f64>() - 1.0).abs() < 1e-12);
    let bands = &found.bands[0];
    for (row, time) in found.times.iter().enumerate() {
        let (deviation, value) =
            (variance(*time).sqrt(), 293.15 - 100.0 * f64::exp_m1(-time / 500.0));
        near(bands.deviation[row], deviation, 1e-6);
        assert!((bands.value[row] - value).abs() < 1e-5);
        assert!((bands.high[row] - value - 1.959_963_985 * deviation).abs() < 1e-5);
        assert!((bands.low[row] - value + 1.959_963_985 * deviation).abs() < 1e-5);
    }
}

/// The peak is where the heat ends, at 500 s, between the rows, which are 300 s apart; its slope is
/// that of this time.
#[test]
fn analytic_a_maximum_between_the_rows_has_the_slope_of_its_time() {
    let text =
        ONE_NODE.replace("P = \"P\"", "P = \"if(t < 500 [s], P, 0 [W])\"").replace("20 s", "300 s");
    let netlist = parsed(&text, "P = \"200 ± 20 W\"\nT_amb = \"20 degC\"");
    let found = linear(&netlist);
    let rise = 0.5 * -f64::exp_m1(-1.0);
    let max = answer(&found, |of| matches!(of, AnswerOf::Max(_)));
    assert!((max.value - 293.15 - 200.0 * rise).abs() < 1e-4);
    all_near(&effects(max), &[rise * 20.0]);
    let end = answer(&found, |of| matches!(of, AnswerOf::End(_)));
    all_near(&effects(end), &[rise * f64::exp(-1.0) * 20.0]);
    assert_eq!(found.times, [0.0, 300.0, 600.0, 900.0, 1000.0]);
}

/// A margin changes with its own limit and with heat flows too: Q = P (1 - e^-x) leaves over the
/// skin.
#[test]
fn analytic_margins_follow_temperatures_limits_and_heat() {
    let more = "[limit]\nhot = { of = \"block.T - air.T\", below = \"0.45 [K/W] * P\" }\n\
                flow = { of = \"skin.Q\", below = \"180 W\" }\n";
    let found = linear(&one_node(more));
    let margin = |name: &str| {
        let network = &found.answers;
        network
            .iter()
            .filter(|a| matches!(a.of, AnswerOf::Margin(_)))
            .nth(usize::from(name == "flow"))
            .unwrap()
    };
    let [by_r, by_c, by_p, _] = slopes(1000.0);
    all_near(&effects(margin("hot")), &[-by_r, -by_c, 0.45 * 20.0 - by_p, 0.0]);
    let (x, decay) = (2.0, f64::exp(-2.0));
    let flow = [
        200.0 * x * decay / 0.5 * 0.02,
        200.0 * x * decay / 1000.0 * 50.0,
        -(1.0 - decay) * 20.0,
        0.0,
    ];
    all_near(&effects(margin("flow")), &flow);
    // margin of 180 - 200 (1 - e^-2) W over its deviation: `scipy.special.ndtr`
    let (value, deviation) =
        (180.0 - 200.0 * (1.0 - decay), flow.iter().map(|e| e * e).sum::<f64>().sqrt());
    near(margin("flow").value, value, 1e-5);
    near(margin("flow").deviation.value, deviation, 1e-6);
    let probability = 0.344_324_578;
    assert!((margin("flow").below_zero.value - probability).abs() < 1e-5, "{:?}", margin("flow"));
}

/// What is linear in its parameters has the same bands by both methods; what radiates has not:
/// 46.24 K by a straight line where NumPy samples 50.40 K, and 465.4 where 452.8 K is the lower end
/// (see uncertainty_sobol.rs).
#[test]
fn both_methods_agree_where_lines_are_straight_and_say_where_not() {
    let netlist = parsed(ONE_NODE, "P = \"200 ± 20 W\"\nT_amb = \"20 ± 2 degC\"");
    assert_eq!(discrepancies(&linear(&netlist), &sobol(&netlist, 512), 1e-5), []);
    let netlist = parsed(RADIATING, "P = \"100 ± 30 W\"\nGr = \"0.02 ± 0.004 m^2\"");
    let (line, sampled) = (linear(&netlist), sobol(&netlist, 512));
    near(line.answers[0].deviation.value, 46.243_794, 1e-5);
    let found = discrepancies(&line, &sampled, 1e-5);
    let end = found.iter().find(|d| d.time == Some(3600.0)).unwrap();
    near(end.linear.0, 555.996_635 - 1.959_964 * 46.243_794, 1e-6);
    assert!((end.part - (465.36 - 452.755) / (0.5 * (652.427 - 452.755))).abs() < 0.05, "{end:?}");
    assert!(found.iter().any(|d| matches!(d.of, AnswerOf::Margin(_))), "{found:?}");
}

/// A thermostat moves its events with the parameters: there is no exact derivative, and the method
/// says so.
#[test]
fn without_exact_sensitivities_there_are_differences_of_runs() {
    let text = ONE_NODE.replace("P = \"P\"", "P = \"P * heater\"")
        + "[control]\nheater = { sense = \"block\", on_below = \"90 degC\", off_above = \"200 \
            degC\", start = \"on\" }\n\
           [limit]\nhot = { of = \"block.T\", below = \"120 degC\" }\n";
    let found = linear(&parsed(&text, "P = \"200 ± 20 W\"\nT_amb = \"20 degC\""));
    let UncertaintyMethod::Linear { differences: Some(why), .. } = &found.method else {
        panic!("{:?}", found.method)
    };
    assert!(!why.is_empty());
    for (of, sign) in [(0, 1.0), (1, 1.0), (2, -1.0)] {
        near(found.answers[of].ranking[0].effect, sign * RISE * 20.0, 1e-4);
    }
}

#[test]
fn certain_networks_have_a_code_for_an_answer() {
    let netlist = parsed(ONE_NODE, "P = \"200 W\"\nT_amb = \"20 degC\"");
    let error = task(&netlist).linear().unwrap_err();
    assert_eq!(error.code(), "uncertainty::no_deviation");
    assert!(error.help().unwrap().contains("±"));
}

/// A maximum where the heat is switched off: T = T_amb + P R (1 - exp(-t_off / R C)) by P and
/// t_off, whose slope at a fixed time is another one on each side.
#[test]
fn regression_a_maximum_at_a_jump_moves_with_the_jump() {
    let switched = ONE_NODE.replace("P = \"P\"", "P = \"if(t < t_off, P, 0 [W])\"");
    let found = linear(&parsed(
        &switched,
        "P = \"100 ± 10 W\"\nt_off = \"500 ± 50 s\"\nT_amb = \"20 degC\"",
    ));
    let peak = answer(&found, |of| matches!(of, AnswerOf::Max(_)));
    let decay = f64::exp(-1.0);
    let expected = [0.5 * (1.0 - decay) * 10.0, 100.0 / 1000.0 * decay * 50.0];
    let found = effects(peak);
    near(found[0], expected[0], 1e-3);
    near(found[1], expected[1], 1e-3);
}

/// Without an effect a parameter has no share, and rounding is none.
#[test]
fn regression_a_parameter_without_effect_has_no_share() {
    let balanced = "[boundary]\nair = { T = \"20 degC\" }\n[node]\nblock = { C = \"1 kJ/K\", T0 \
        = \"20 degC\" }\n\
        [resistor]\nskin = { from = \"block\", to = \"air\", R = \"R\" }\n[run]\nstop = \"1000 \
        s\"\n";
    let found = linear(&parsed(balanced, "R = \"0.5 ± 0.05 K/W\""));
    let end = answer(&found, |of| matches!(of, AnswerOf::End(_)));
    assert_eq!((end.deviation.value, end.ranking[0].share.value), (0.0, 0.0));
}

/// A junction without mass is hottest just before its load falls, and so is the limit of the heat
/// that leaves it least kept: T = T_air + P_high (R_pad + R_skin (1 - exp(-t / tau))), tau = 300 s.
#[test]
fn analytic_an_extreme_before_a_jump_has_the_slope_of_its_own_side() {
    let text = "[node]\nbody = { C = \"1 kJ/K\", T0 = \"20 degC\" }\nchip = { massless = true }\n\
        [boundary]\nair = { T = \"20 degC\" }\n[resistor]\npad = { from = \"chip\", to = \"body\", R \
        = \"0.5 K/W\" }\nskin = { from = \"body\", to = \"air\", R = \"0.3 K/W\" }\n[source]\nloss = \
        { into = \"chip\", P = \"if(t < 10 [min], P_high, P_low)\" }\n[limit]\nhot = { of = \
        \"chip.T\", below = \"90 degC\" }\nheat = { of = \"pad.Q\", below = \"120 W\" }\n[run]\nstop \
        = \"20 min\"\n";
    let found = linear(&parsed(text, "P_high = \"100 ± 5 W\"\nP_low = \"60 ± 12 W\""));
    let slope = 0.5 - 0.3 * f64::exp_m1(-2.0);
    let hottest = |of: &AnswerOf| matches!(of, AnswerOf::Max(_));
    let chip = found.answers.iter().rfind(|answer| hottest(&answer.of)).unwrap();
    all_near(&effects(chip), &[5.0 * slope, 0.0]);
    let margins: Vec<&Answer> =
        found.answers.iter().filter(|answer| matches!(answer.of, AnswerOf::Margin(_))).collect();
    all_near(&effects(margins[0]), &[-5.0 * slope, 0.0]);
    all_near(&effects(margins[1]), &[-5.0, 0.0]);
    // SciPy: norm.sf(-5.940 / 3.797)
    assert!((margins[0].below_zero.value - 0.941_1).abs() < 1e-3, "{:?}", margins[0]);
}

/// Numbers from 0 to 1 in an order that is always the same (Marsaglia's xorshift, 2003).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.next() * all.len() as f64) as usize]
    }
}

/// Nodes with and without mass in a tree towards the air, with loads, a room and limits that jump.
fn jumping(chance: &mut Chance) -> String {
    use std::fmt::Write as _;
    let count = 2 + (chance.next() * 3.0) as usize;
    let mut text = format!(
        "[signal]\nduty = {{ t = [0, 40, 130], v = [{:.3}, {:.3}, {:.3}], t_unit = \"s\", v_unit = \
         \"1\", interp = \"previous\", after_end = \"hold\" }}\n[boundary]\nair = {{ T = \"{}\" }}\n[node]\n",
        chance.next(),
        chance.between(0.0, 2.0),
        chance.next(),
        chance.of(&["T_amb", "if(t < 70 [s], T_amb, T_amb + 15 [K])"])
    );
    for i in 0..count {
        let mass = match i > 0 && chance.next() < 0.6 {
            true => "massless = true".to_owned(),
            false => format!("C = \"{:.3} J/K\", T0 = \"T_amb\"", chance.between(20.0, 200.0)),
        };
        writeln!(text, "n{i} = {{ {mass} }}").unwrap();
    }
    text += "[resistor]\n";
    for i in 0..count {
        let to = if i == 0 {
            "air".to_owned()
        } else {
            format!("n{}", (chance.next() * i as f64) as usize)
        };
        let law = chance.of(&["R = \"R\"", "R = \"2 * R\"", "G = \"1.3 [W/K]\""]);
        writeln!(text, "r{i} = {{ from = \"n{i}\", to = \"{to}\", {law} }}").unwrap();
    }
    text += "[source]\n";
    for k in 0..2 {
        let into = (chance.next() * count as f64) as usize;
        let at = chance.between(20.0, 180.0);
        let load = chance.of(&["P_a * duty", "if(t < AT, P_a, P_b)", "if(t >= AT, P_b, 0 [W])"]);
        let load = load.replace("AT", &format!("{at:.2} [s]"));
        writeln!(text, "s{k} = {{ into = \"n{into}\", P = \"{load}\" }}").unwrap();
    }
    let last = count - 1;
    write!(
        text,
        "[limit]\nhot = {{ of = \"n{last}.T\", below = \"60 degC\" }}\nheat = {{ of = \"r{last}.Q\", \
         below = \"70 W\" }}\nloss = {{ of = \"s0.P\", above = \"3 W\" }}\nboth = {{ of = \"if(t <= \
         100 [s], n0.T, n{last}.T) - air.T\", below = \"20 K\" }}\n[run]\nstop = \"200 s\"\n\
         tolerance = \"1e-8 K\"\n"
    )
    .unwrap();
    text
}

/// What a run with this value of a parameter answers: maxima, then margins.
fn extremes(netlist: &Netlist, name: &str, value: f64) -> Vec<f64> {
    use lptn_assembly::ThermalSystem;
    use lptn_solve::{Transient, Watch};
    let network = &netlist.network;
    let mut given = network.given();
    given.set(network.parameter(name).unwrap(), value);
    let system = ThermalSystem::of(network, &given).unwrap();
    let watch = network.node_ids().map(|node| Watch { node, level: None }).collect();
    let run = Transient::of(network, netlist.run.as_ref().unwrap());
    let run = Transient { watch, ..run }.solve(&system).unwrap();
    let peaks = run.watched().iter().map(|seen| seen.peak.0);
    peaks.chain(run.limits().iter().map(|seen| seen.margin)).collect()
}

/// Slopes of maxima and of least margins against differences of runs, where loads, rooms and limits
/// jump: between the slopes to the two sides, which differ where another moment takes over.
#[test]
fn random_slopes_of_extremes_are_those_of_runs_beside() {
    let parameters = "P_a = \"40 ± 4 W\"\nP_b = \"70 ± 7 W\"\nR = \"0.5 ± 0.05 K/W\"\nT_amb = \"20 ± \
                      2 degC\"";
    for seed in 1..=60 {
        let mut chance = Chance(0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(seed));
        let text = jumping(&mut chance);
        let netlist = parsed(&text, parameters);
        let found = linear(&netlist);
        let asked = found.answers.iter().filter(|a| !matches!(a.of, AnswerOf::End(_)));
        let found_effects: Vec<Vec<f64>> = asked.map(effects).collect();
        for (i, (name, own, sigma)) in
            [("P_a", 40.0, 4.0), ("P_b", 70.0, 7.0), ("R", 0.5, 0.05), ("T_amb", 293.15, 2.0)]
                .into_iter()
                .enumerate()
        {
            let step = 1e-4 * sigma;
            let [below, here, above] =
                [-step, 0.0, step].map(|by| extremes(&netlist, name, own + by));
            for (k, own_effects) in found_effects.iter().enumerate() {
                let left = (here[k] - below[k]) / step * sigma;
                let right = (above[k] - here[k]) / step * sigma;
                let room = 2e-3 * (1.0 + left.abs().max(right.abs()));
                let sides = left.min(right) - room..=left.max(right) + room;
                let effect = own_effects[i];
                assert!(
                    sides.contains(&effect),
                    "seed {seed}: answer {k} by {name}: {effect}, not {sides:?}\n{text}"
                );
            }
        }
    }
}

/// A body that starts at 60 degC and settles at 20 degC + P / G = 58 degC, P = 38 ± 6 W: its peak is
/// the start, but 49.76 W (97.5 %) take it to 69.76 degC. The margin of 65 degC is 5 K there and
/// -4.76 K here: it falls by 9.76 K. With 30 ± 6 W the start stays the worst.
#[test]
fn straight_lines_that_miss_another_moment_are_named() {
    let found = |power: &str| {
        let text = format!(
            "format = 1\n[param]\nP = \"{power}\"\n[node]\na = {{ C = \"100 J/K\", T0 = \"60 degC\" \
             }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\n\
             r = {{ from = \"a\", to = \"air\", G = \"1 W/K\" }}\n[source]\n\
             s = {{ into = \"a\", P = \"P\" }}\n[limit]\nl = {{ of = \"a.T\", below = \"65 degC\" }}\n\
             [run]\nstop = \"1 h\"\n"
        );
        let netlist = lptn_netlist::parse("a.toml", &text).unwrap_or_else(|e| panic!("{e}"));
        match linear(&netlist).method {
            UncertaintyMethod::Linear { bent, .. } => bent,
            UncertaintyMethod::Sobol { .. } => panic!("linear"),
        }
    };
    let bent = found("38 ± 6 W");
    let margin = bent.iter().find(|bent| matches!(bent.of, AnswerOf::Margin(_))).unwrap();
    near(margin.found, 38.0 + 1.959_963_985 * 6.0 - 40.0, 1e-3);
    assert!(margin.linear < 1e-3, "{margin:?}");
    assert_eq!(found("20 ± 6 W"), []);
}

/// A rise of 31.5 K with nine contributions of ± 1 K: 95 % of it lies within ± 1.96 x 3 K, and
/// the part above 35.5 K within 1.96 x 3 - 4 K. One contribution alone does not reach 35.5 K.
#[test]
fn a_kink_that_only_several_parameters_reach_together_is_told() {
    let powers: String = (0..9).map(|i| format!("P{i} = \"7 ± 2 W\"\n")).collect();
    let sum: Vec<String> = (0..9).map(|i| format!("P{i}")).collect();
    let network = ONE_NODE.replace("P = \"P\"", &format!("P = \"{}\"", sum.join(" + ")))
        + "[limit]\nclip = { of = \"max(0 [K], block.T - 55.5 [degC])\", below = \"1 K\" }\n\
           warm = { of = \"block.T\", below = \"80 degC\" }\n";
    let found =
        linear(&parsed(&network.replace("1000 s", "20 ks"), &(powers + "T_amb = \"20 degC\"")));
    let UncertaintyMethod::Linear { bent, .. } = &found.method else { panic!() };
    let [bent] = bent.as_slice() else { panic!("{bent:?}") };
    assert!(bent.linear.abs() <= 0.0);
    near(bent.found, 3.0 * 1.959_963_985 - 4.0, 1e-4);
}
