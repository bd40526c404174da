//! Reference: heat exchangers against the Python package ht 1.2.0 (Caleb Bell, MIT licence), and in
//! their limits; fins, and films between them.

use lptn_laws::{
    Formula, effectiveness_counterflow, effectiveness_crossflow, effectiveness_one_stream,
    effectiveness_parallel, effectiveness_shell, fin_efficiency, finned, nusselt_between_plates,
    nusselt_through_plates,
};
use lptn_units::Dual;

#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}

/// ht: effectiveness_from_NTU(5, 0.7), (0.3, 0.2) and (2, 1); the crossflow is its integral.
#[test]
fn exchangers_are_those_of_ht() {
    near(effectiveness_counterflow(5.0, 0.7), 0.920_670_368_605_110_8, 1e-14);
    near(effectiveness_parallel(5.0, 0.7), 0.588_115_606_841_758_5, 1e-14);
    near(effectiveness_crossflow(5.0, 0.7), 0.844_482_179_974_855, 1e-13);
    near(effectiveness_crossflow(0.3, 0.2), 0.252_626_344_509_073_95, 1e-13);
    near(effectiveness_crossflow(2.0, 1.0), 0.614_247_239_273_578, 1e-13);
    near(effectiveness_crossflow(4000.0 / 1500.0, 1500.0 / 4197.0), 0.835_786_537_947_844, 1e-13);
    near(effectiveness_shell(5.0, 0.7), 0.683_497_704_431_143_9, 1e-14);
    near(effectiveness_shell(0.3, 0.2), 0.252_570_353_967_874_03, 1e-14);
    near(effectiveness_shell(2.0, 1.0), 0.556_809_667_943_669_6, 1e-14);
    near(effectiveness_one_stream(5.0, 0.7), 0.993_262_053_000_914_5, 1e-14);
}

/// Incropera et al., 6th edition, example 11.3: gas from 300 to 100 degC warms 1 kg/s of water from 35
/// to 125 degC; the chart gives 2.1 transfer units for e = 0.75, and U = 100 W/(m^2 K) an area of
/// 39.7 m^2.
#[test]
fn a_cooler_of_a_textbook() {
    let [gas, water] = [4197.0 * 90.0 / 200.0, 4197.0];
    let values = [100.0 * 39.7, gas, water];
    let ends = [573.15, 308.15];
    let heat = Formula::Crossflow.value(&values, ends) * (ends[0] - ends[1]);
    near(heat, 3.77e5, 0.015);
    let told = Formula::Crossflow.results(&values, ends);
    near(told[0], 0.75, 0.015);
    near(told[1], 2.1, 0.005);
    near(told[2] - 273.15, 100.0, 0.03);
    near(told[3] - 273.15, 125.0, 0.015);
}

const COOLERS: [[Formula; 2]; 5] = [
    [Formula::Counterflow, Formula::CounterflowOutlet],
    [Formula::Parallel, Formula::ParallelOutlet],
    [Formula::Crossflow, Formula::CrossflowOutlet],
    [Formula::Shell, Formula::ShellOutlet],
    [Formula::OneStream, Formula::OneStreamOutlet],
];

/// The heat from the outlet is that from the inlet that it tells, and both close the balances of the
/// streams.
#[test]
fn a_cooler_is_the_same_from_its_outlet() {
    for [inlet, outlet] in COOLERS {
        for rates in [[70.0, 100.0], [100.0, 70.0], [80.0, 80.0]] {
            let values = [350.0, rates[0], rates[1]];
            let values = &values[..inlet.declaration().fields.len()];
            let behind = outlet.results(values, [320.0, 300.0]);
            let heat = 20.0 * outlet.value(values, [320.0, 300.0]);
            let before = [behind[2], 300.0];
            near(inlet.value(values, before) * (before[0] - 300.0), heat, 1e-12);
            let told = inlet.results(values, before);
            near(told[2], 320.0, 1e-14);
            near(rates[0] * (before[0] - told[2]), heat, 1e-11);
            told.get(3).into_iter().for_each(|to| near(rates[1] * (to - 300.0), heat, 1e-11));
        }
    }
}

/// Without flow no heat, of hardly any flow all that it can carry; finite slopes everywhere, and a
/// size of 0. A stream that is reversed turns counterflow into parallel.
#[test]
fn coolers_stand_still_start_and_turn_round() {
    for [inlet, outlet] in COOLERS {
        for law in [inlet, outlet] {
            for [size, from, to] in [
                [350.0, 0.0, 100.0],
                [350.0, 70.0, 0.0],
                [350.0, 0.0, 0.0],
                [0.0, 70.0, 100.0],
                [0.0, 0.0, 0.0],
                [350.0, 1e-9, 100.0],
                [350.0, 1e-250, 1e-250],
                [1e6, 1.0, 1.0],
                [1e6, 1.0, 1e-3],
            ] {
                let of = [(size, 0), (from, 1), (to, 2)].map(|(x, i)| Dual::<3>::variable(x, i));
                let of = &of[..law.declaration().fields.len()];
                let found = law.value(of, [Dual::constant(320.0), Dual::constant(300.0)]);
                let finite = found.derivatives.iter().all(|slope| slope.is_finite());
                assert!(found.value.is_finite() && finite, "{law:?} {size} {from} {to}: {found:?}");
                let still = from == 0.0 || size == 0.0 || (to == 0.0 && of.len() == 3);
                assert_eq!(found.value == 0.0, still, "{law:?} {size} {from} {to}: {found:?}");
                let most = if of.len() == 3 { from.min(to) } else { from };
                let between = inlet.value(&[size, from, to][..of.len()], [320.0, 300.0]);
                assert!(between <= most, "{inlet:?} carries {between} with {most}");
                let told = law.results(&[size, from, to][..of.len()], [320.0, 300.0]);
                assert!(told.iter().all(|x| x.is_finite()), "{law:?}: {told:?}");
            }
        }
        let slow = inlet.value(&[350.0, 1e-9, 100.0][..inlet.declaration().fields.len()], [0.0; 2]);
        near(slow, 1e-9, 1e-9);
    }
    let value = |law: Formula, rates: [f64; 2]| law.value(&[350.0, rates[0], rates[1]], [0.0; 2]);
    for rates in [[-70.0, 100.0], [70.0, -100.0]] {
        let turned = value(Formula::Counterflow, rates);
        near(turned, value(Formula::Parallel, [70.0, 100.0]), 1e-15);
        near(value(Formula::Parallel, rates), value(Formula::Counterflow, [70.0, 100.0]), 1e-15);
    }
    let both = value(Formula::Counterflow, [-70.0, -100.0]);
    near(both, value(Formula::Counterflow, [70.0, 100.0]), 1e-15);
}

/// Where one side boils all are 1 - exp(-N); small ones are N; equal streams against each other are N
/// / (1 + N), and nothing jumps there.
#[test]
fn exchangers_in_their_limits() {
    let laws: [fn(f64, f64) -> f64; 3] =
        [effectiveness_counterflow, effectiveness_parallel, effectiveness_crossflow];
    for law in laws {
        for n in [1e-9_f64, 0.1, 1.0, 5.0, 20.0] {
            near(law(n, 0.0), -(-n).exp_m1(), 1e-13);
            near(law(n, 1e-9), law(n, 0.0), 1e-7);
        }
        near(law(1e-9, 0.7), 1e-9, 1e-8);
        near(law(0.0, 0.7) + 1.0, 1.0, 0.0);
        for n in [0.02, 0.5, 3.0] {
            // both sides of where a series stands for a quotient
            for x in [0.01 / n, 1.0 - 0.01 / n] {
                near(law(n, x - 1e-12), law(n, x + 1e-12), 1e-11);
            }
        }
    }
    let [n, ratio] = [(0.0, 0), (1.0, 1)].map(|(x, i)| Dual::<2>::variable(x, i));
    for found in [
        effectiveness_counterflow(n, ratio),
        effectiveness_parallel(n, ratio),
        effectiveness_crossflow(n, ratio),
    ] {
        assert_eq!((found.value, found.derivatives), (0.0, [1.0, 0.0]), "at no size");
    }
    for n in [0.5, 5.0] {
        near(effectiveness_counterflow(n, 1.0), n / (1.0 + n), 1e-15);
        near(effectiveness_counterflow(n, 1.0 - 1e-9), n / (1.0 + n), 1e-8);
    }
}

/// tanh(1); short fins lose nothing; a fin of which the base is all.
#[test]
fn fins_are_as_good_as_they_conduct() {
    near(fin_efficiency(1.0), 1f64.tanh(), 1e-15);
    near(fin_efficiency(0.009_999), 0.009_999_f64.tanh() / 0.009_999, 1e-14);
    near(fin_efficiency(1e-9), 1.0, 1e-15);
    near(finned(10.0, [0.01, 0.2], 1e-9), 2.1, 1e-14);
    near(finned(10.0, [0.01, 0.2], 2.0), 0.1 + 2.0 * 2f64.tanh() / 2.0, 1e-14);
}

/// Close together plates warm all air between them, Nu = El / 24; far apart each is a plate of its
/// own, Nu = 0.59 El^(1/4). Cengel: thin ones give off most at S = 2.714 L / Ra_L^(1/4).
#[test]
fn plates_in_still_air_in_their_limits() {
    near(nusselt_between_plates(1e-4), 1e-4 / 24.0, 1e-6);
    near(nusselt_between_plates(1e5), 0.59 * 1e5_f64.powf(0.25), 1e-3);
    let given = |el: f64| nusselt_between_plates(el) / el.sqrt();
    let best = 2.714_f64.powi(4);
    assert!(given(best) > given(0.97 * best) && given(best) > given(1.03 * best));
    let still = nusselt_between_plates(Dual::<1>::variable(0.0, 0));
    assert_eq!((still.value, still.derivatives), (0.0, [1.0 / 24.0]));
}

/// A slow flow is warmed as far as it can be, Nu = Re* Pr / 2, and takes nothing at rest; in a fast one
/// each plate is nearly alone, Nu = 0.664 Re*^(1/2) Pr^(1/3).
#[test]
fn plates_in_a_flow_in_their_limits() {
    near(nusselt_through_plates(1e-5, 0.7), 1e-5 * 0.35, 1e-9);
    near(nusselt_through_plates(1e8, 0.7), 0.664 * 1e4 * 0.7_f64.cbrt(), 2e-4);
    let rest = nusselt_through_plates(Dual::<1>::variable(0.0, 0), Dual::constant(0.7));
    assert_eq!((rest.value, rest.derivatives), (0.0, [0.35]));
}

/// Regression: two fins in a slow flow seemed to give twice the heat that the air between them takes.
#[test]
fn a_sink_that_heats_more_air_than_passes_is_out_of_range() {
    let at = |fins: f64, speed: f64| {
        let air = [0.0277, 1.1, 1007.0, 20e-6, speed];
        let sink = [2.5e-3, 0.1, 0.03, 0.8e-3, 167.0, fins];
        let values = [&air[..], &sink].concat();
        let law = Formula::PlateFinsBlown;
        let groups = law.groups(&values, [353.15, 293.15]);
        let rate = 1.1 * 1007.0 * speed * 2.5e-3 * 0.03 * (fins - 1.0);
        (groups[2], law.value(&values, [353.15, 293.15]) / rate)
    };
    let share = |fins: f64, speed: f64| {
        let (found, expected) = at(fins, speed);
        near(found.unwrap(), expected, 1e-12);
        expected
    };
    assert!(share(2.0, 0.2) > 1.9 && share(12.0, 0.2) > 1.0);
    assert!(share(20.0, 3.0) < 1.0);
    assert_eq!(at(12.0, 0.0).0, None, "at rest nothing passes and nothing is heated");
}
