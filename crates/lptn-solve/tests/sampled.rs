//! Sampled states and controllers, against exact exponentials from sample to sample.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::elements_helper::Random;
use crate::own_states::{ZERO, column, near, network, run};

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, NoTangents, Time};
use lptn_solve::{
    ExactSolution, Linearised, LinearisedError, Others, Periodic, PeriodicError, Proceed,
    StateRates, SteadyState, Transient,
};

/// A heater of 40 W under a digital controller.
fn hot_end(keys: &str) -> String {
    format!(
        "format = 1\n[default]\nT0 = \"22 degC\"\n[boundary]\nroom = {{ T = \"22 degC\" }}\n[node]\nblock = \
         {{ C = \"13 J/K\" }}\nsensor = {{ C = \"0.5 J/K\" }}\n[controller]\nduty = {{ sense = \"sensor\", \
         setpoint = \"200 degC\", K_p = \"0.03 1/K\", K_i = \"0.0005 1/(K s)\", min = 0, max = 1, {keys} \
         }}\n[resistor]\nloss = {{ from = \"block\", to = \"room\", G = \"80 mW/K\" }}\nfit = {{ from = \
         \"block\", to = \"sensor\", G = \"0.1 W/K\" }}\n[source]\nheater = {{ into = \"block\", P = \"40 [W] * \
         duty\" }}\n"
    )
}

/// NumPy: matrix exponentials (SciPy's `expm`) from sample to sample, all digits that it printed.
/// Block, integral and output at 60, 120, 300 and 600 s, after the samples there.
#[test]
fn digital_controllers_are_those_of_matrix_exponentials() {
    let cases = [
        (
            "sample = \"0.5 s\"",
            [
                [171.874_494_368, 0.636_711_578, 1.0],
                [206.506_774_362, 0.538_705_358, 0.318_102_450],
                [200.195_157_435, 0.361_541_156, 0.355_111_231],
                [200.000_577_771, 0.356_016_405, 0.355_997_369],
            ],
        ),
        (
            "sample = \"0.5 s\", K_d = \"0.05 s/K\", lag = \"2 s\"",
            [
                [171.874_494_368, 0.709_519_219, 1.0],
                [208.875_408_629, 0.596_060_265, 0.314_000_581],
                [200.221_686_188, 0.361_991_232, 0.354_907_987],
                [200.000_471_617, 0.356_012_746, 0.355_997_677],
            ],
        ),
        (
            "sample = \"2 s\", K_d = \"0.02 s/K\", lag = \"0 s\"",
            [
                [171.874_494_368, 0.680_211_387, 1.0],
                [207.431_478_590, 0.553_909_197, 0.312_525_933],
                [200.194_434_049, 0.361_262_413, 0.355_080_903],
                [200.000_463_120, 0.356_012_534, 0.355_997_811],
            ],
        ),
        (
            "sample = \"0.5 s\", tracking = \"0.1 s\"",
            [
                [144.773_904_573, -1.213_024_880, 0.606_381_679],
                [182.751_303_091, -0.133_747_692, 0.434_555_322],
                [199.475_700_340, 0.341_113_423, 0.358_387_720],
                [199.998_447_792, 0.355_955_928, 0.356_007_069],
            ],
        ),
    ];
    for (keys, right) in cases {
        let network = network(&hot_end(keys));
        let solution = run(&network, &[0.0, 60.0, 120.0, 300.0, 600.0], 1e-5);
        let block = column(&solution, "block.T");
        let (integral, output) = (column(&solution, "duty.integral"), column(&solution, "duty"));
        for (row, [t, i, u]) in (1..).zip(right) {
            near(block[row] - ZERO, t, 1e-4);
            near(integral[row], i, 1e-6);
            near(output[row], u, 1e-5);
        }
        assert!(solution.ledger().relative_residual().unwrap().abs() < 1e-9);
    }
}

/// 14.24 W of 40 W keep the block at 200 degC.
#[test]
fn the_steady_state_repeats_itself() {
    let network = network(&hot_end("sample = \"0.5 s\""));
    let steady = SteadyState::solve(&ThermalSystem::assemble(&network).unwrap(), 0.0).unwrap();
    near(steady[network.node("block").unwrap()], 200.0 + ZERO, 1e-7);
    for value in network.state_values(&steady.temperatures) {
        near(value, 0.356, 1e-9);
    }
    // the way from the start to it is followed, with samples or without
    assert_eq!(steady.others, Others::None);
    let plain = self::network(&hot_end("acts = \"heating\""));
    let steady = SteadyState::solve(&ThermalSystem::assemble(&plain).unwrap(), 0.0).unwrap();
    assert_eq!(steady.others, Others::None);
}

/// A body under a thermostat that reads it at every sample: exact exponentials in between.
#[test]
fn random_thermostats_are_those_of_exponentials() {
    let mut random = Random(5);
    for _ in 0..40 {
        let (c, g) = (random.between(50.0, 500.0), random.between(0.5, 5.0));
        let (power, every) = (g * random.between(60.0, 120.0), random.between(0.2, 9.0));
        let band = random.between(0.5, 3.0);
        let text = format!(
            "format = 1\n[param]\nTs = \"{every:?} s\"\n[boundary]\nair = {{ T = \"20 degC\" }}\n[node]\nb = \
             {{ C = \"{c:?} J/K\", T0 = \"20 degC\" }}\n[resistor]\nr = {{ from = \"b\", to = \"air\", G = \
             \"{g:?} W/K\" }}\n[state]\nheats = {{ next = \"if(b.T < 60 [degC] - {band:?} [K], 1, if(b.T > 60 \
             [degC] + {band:?} [K], 0, heats))\", every = \"Ts\", start = 0, size = 1 }}\nsamples = {{ next = \
             \"samples + 1\", every = \"Ts\", start = 0, size = 1 }}\n[source]\ns = {{ into = \"b\", P = \
             \"{power:?} [W] * heats\" }}\n"
        );
        let (mut t, mut on) = (20.0, 0.0);
        let last = 200;
        for k in 0..=last {
            on = if t < 60.0 - band {
                1.0
            } else if t > 60.0 + band {
                0.0
            } else {
                on
            };
            let end = 20.0 + power * on / g;
            let time = if k == last { 0.4 * every } else { every };
            t = end + (t - end) * (-g * time / c).exp();
        }
        let network = network(&text);
        for integrator in [IntegratorChoice::Auto, IntegratorChoice::Cvode] {
            let stop = (f64::from(last) + 0.4) * every;
            let settings = Transient::until(Time(stop)).at(&[0.0, stop]).tolerance(1e-6);
            let system = ThermalSystem::assemble(&network).unwrap();
            let solution = Transient { integrator, ..settings }.solve(&system).unwrap();
            near(column(&solution, "b.T")[1] - ZERO, t, 1e-4);
            near(column(&solution, "heats")[1], on, 1e-12);
            near(column(&solution, "samples")[1], f64::from(last + 1), 1e-9);
        }
    }
}

/// Samples are at multiples of the time between them: two runs one after the other, the first up to
/// a sample or between two, are one run.
#[test]
fn a_run_that_goes_on_samples_as_the_whole_one() {
    let network = network(&hot_end("sample = \"0.5 s\""));
    let system = ThermalSystem::assemble(&network).unwrap();
    let whole = run(&network, &[0.0, 120.0], 1e-6);
    for middle in [30.0, 30.2] {
        let first = run(&network, &[0.0, middle], 1e-6);
        let rest = Transient { start: middle, ..Transient::until(Time(120.0)) };
        let rest = rest.at(&[middle, 120.0]).tolerance(1e-6);
        let rest =
            rest.solve_from(&system, first.last_state(), &mut |_| Proceed::Continue).unwrap();
        for name in ["block.T", "duty", "duty.integral"] {
            near(column(&rest, name)[1], column(&whole, name)[1], 2e-5);
        }
    }
}

/// Two states that take each other's value: all next values follow from those before the sample.
#[test]
fn samples_at_one_time_are_taken_at_once() {
    let text = "format = 1\n[boundary]\nair = { T = \"20 degC\" }\n[node]\nb = { C = \"1 J/K\", T0 = \"20 degC\" \
                }\n[resistor]\nr = { from = \"b\", to = \"air\", G = \"1 W/K\" }\n[state]\nx = { next = \"y\", every = \
                \"1 s\", start = \"1 kg\" }\ny = { next = \"x\", every = \"1 s\", start = \"3 kg\" }\nslow = { next = \
                \"slow + x\", every = \"2 s\", start = \"0 kg\", size = \"1 kg\" }\n";
    let solution = run(&network(text), &[0.0, 0.5, 1.0, 1.5, 2.0, 2.5], 1e-5);
    for (name, right) in [
        ("x", [3.0, 3.0, 1.0, 1.0, 3.0, 3.0]),
        ("y", [1.0, 1.0, 3.0, 3.0, 1.0, 1.0]),
        ("slow", [1.0, 1.0, 1.0, 1.0, 2.0, 2.0]),
    ] {
        for (found, right) in column(&solution, name).iter().zip(right) {
            near(*found, right, 1e-12);
        }
    }
}

#[test]
fn analyses_that_know_no_samples_refuse_them() {
    let network = network(&hot_end("sample = \"0.5 s\""));
    let system = ThermalSystem::assemble(&network).unwrap();
    let cycle = Periodic::find(&system, &Transient::until(Time(10.0)));
    assert!(matches!(cycle, Err(PeriodicError::Sampled { name }) if name == "duty"));
    let linear = Linearised::of(&system, None).map(drop);
    assert!(matches!(linear, Err(LinearisedError::Sampled { name }) if name == "duty"));
    assert!(ExactSolution::solve(&network, 0.0, &[0.0, 1.0]).is_err());
    assert!(StateRates::new(&system).is_err());
    let parameters: Vec<_> = network.parameter_ids().collect();
    let slopes = network.tangents(&parameters).map(drop);
    assert!(matches!(slopes, Err(NoTangents::Sampled { .. })), "{slopes:?}");
}
