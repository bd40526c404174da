//! Courses over time from records: against the joint Gaussian given all readings, the limit of
//! Cramér and Rao, and truths of which records were made by closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::bench;

use bench::{Bench, body, driven, held, inferred, noise, parse};
use lptn_fit::infer::{Follower, InferError, InferTask, Inferred, Row};
use lptn_netlist::Netlist;
use lptn_solve::{available_threads, in_parallel};

#[track_caller]
fn near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} is not {expected}");
}

/// Steel and aluminium of the gearbox.
const GEARBOX: &str = "format = 1\n[signal]\nP = \"100 W\"\n[default]\nT0 = \"25.5 degC\"\n[node]\n\
     steel = { C = \"1235 J/K\" }\naluminium = { C = \"1424 J/K\" }\n[boundary]\nair = { T = \
     \"25.5 degC\" }\n[resistor]\ninternal = { from = \"steel\", to = \"aluminium\", R = \"7.7 mK/W\" \
     }\nskin = { from = \"aluminium\", to = \"air\", R = \"0.297 K/W\" }\n[source]\nP_disp = { into = \
     \"steel\", P = \"P\" }\n[infer.power]\ndata = \"r.csv\"\n";

const READ: [f64; 13] =
    [25.70, 25.24, 25.54, 25.53, 25.54, 25.68, 25.91, 25.97, 26.13, 26.40, 26.51, 26.79, 27.05];

fn gearbox(column: &str, find: &str) -> Netlist {
    let rows: Vec<String> =
        READ.iter().enumerate().map(|(k, t)| format!("{},{t}\n", 5 * k)).collect();
    let csv = format!("t [s],tc [degC]\n{}", rows.concat());
    let study = format!("column = {{ tc = \"{column}\" }}\nsigma = \"0.1 K\"\nfind = {find}\n");
    parse(&format!("{GEARBOX}{study}"), &csv)
}

const WALK: &str = "{ P = { change = \"30 W\", within = \"1 min\" } }";

/// mpmath 1.3 with 60 digits: Kalman filter and Rauch-Tung-Striebel smoother, transition and noise by
/// the exponential of the matrix of C. F. Van Loan (IEEE Trans. Autom. Control 23 (1978) 395), for
/// what is known of P beforehand.
#[test]
fn reference_the_band_is_that_of_an_independent_smoother() {
    let found = inferred(&gearbox("aluminium.T", WALK)).unwrap();
    let course = &found.courses[0];
    assert!((course.before.value, course.before.deviation) == (100.0, 1_130.313_120_844_728_2));
    let expected = [
        (0, 25.562_138_093_484_57, 11.752_682_620_209_422, 298.65),
        (1, 28.403_595_862_481_39, 9.096_440_008_265_49, 298.736_884_995_911_9),
        (6, 80.300_648_013_554_86, 8.335_225_746_098_334, 299.339_573_247_796_3),
        (12, 108.530_682_339_955_44, 17.222_305_436_842_118, 300.529_606_853_008_2),
    ];
    for (k, power, deviation, steel) in expected {
        let band = course.band[k];
        near(band.value, power, 1e-9 * power);
        near(half(band.ends), deviation, 1e-9 * deviation);
        near(found.nodes[0].1[k].value, steel, 1e-10 * steel);
    }
    near(found.log_likelihood, -3.389_400_276_385, 1e-7);
}

/// Of a band one standard deviation.
fn half((low, high): (f64, f64)) -> f64 {
    (high - low) / (2.0 * 1.959_963_984_540_054)
}

/// At the last row nothing comes behind, so rows that are answered as they come say the same.
#[test]
fn analytic_the_filter_is_the_smoother_at_the_last_row() {
    let netlist = gearbox("steel.T", WALK);
    let found = inferred(&netlist).unwrap();
    let task = InferTask::of(&netlist, &netlist.studies.infers[0]).unwrap();
    let mut follower = Follower::new(task).unwrap();
    let mut last = None;
    for (k, t) in READ.iter().enumerate() {
        let values = vec![t + 273.15];
        let row = Row { time: 5.0 * k as f64, values, signals: Vec::new() };
        last = follower.row(row).unwrap().pop().or(last);
    }
    let (last, band) = (last.unwrap(), found.courses[0].band[12]);
    // what was known beforehand is taken from the first rows alone: next to nothing as well
    near(last.courses[0].value, band.value, 1e-5 * band.value);
    near(half(last.courses[0].ends), half(band.ends), 1e-5);
    near(last.nodes[0].value, found.nodes[0].1[12].value, 1e-5);
}

/// Rise of the steel t s after 220.6 W began: by both modes of the two bodies.
fn steel(t: f64) -> f64 {
    let (between, out) = (1.0 / 7.7e-3, 1.0 / 0.297);
    let (own, other): (f64, f64) = (-between / 1235.0, -(between + out) / 1424.0);
    let coupled = between * between / (1235.0 * 1424.0);
    let root = ((own - other).powi(2) + 4.0 * coupled).sqrt();
    let modes = [0.5 * (own + other + root), 0.5 * (own + other - root)];
    let share = |i: usize| (modes[i] - other) / (modes[i] - modes[1 - i]);
    let mode = |i: usize| share(i) * f64::exp_m1(modes[i] * t) / modes[i];
    220.6 / 1235.0 * (mode(0) + mode(1))
}

/// 220.6 W for two minutes, one thermocouple with noise of 0.1 K on the steel, a row each second: the
/// limit of Cramer and Rao for a constant is 0.337937 W (SciPy 1.11: the sum of the squares of
/// `dT/dP` by the exponential of the matrix). That it is constant is not known beforehand, so the
/// band is wider.
#[test]
fn analytic_a_constant_power_is_known_after_two_minutes() {
    let mut deviations: Vec<f64> = Vec::new();
    for seed in 0..20 {
        let mut noise = noise(seed);
        let row = |k: u32| format!("{k},{}\n", 25.5 + steel(f64::from(k)) + 0.1 * noise());
        let csv = format!("t [s],tc [degC]\n{}", (0..121).map(row).collect::<String>());
        let study = "column = { tc = \"steel.T\" }\nsigma = \"0.1 K\"\nfind = [\"P\"]\n";
        let found = inferred(&parse(&format!("{GEARBOX}{study}"), &csv)).unwrap();
        let course = &found.courses[0];
        near(course.still.0.deviation, 0.337_937_047_9, 1e-8);
        near(course.still.0.value, 220.6, 4.0 * 0.338);
        let end = course.band[120];
        deviations.push(half(end.ends) / 220.6);
        assert!(end.ends.0 < 220.6 && 220.6 < end.ends.1, "{seed}: {end:?}");
    }
    deviations.sort_by(f64::total_cmp);
    assert!(deviations[19] < 0.05 && deviations[10] < 0.025, "{deviations:?}");
}

/// In how many percent of the rows the band holds the truth.
fn covered(bench: &Bench, records: u32) -> f64 {
    let seeds: Vec<u32> = (0..records).collect();
    let course = bench.course(driven);
    let held = in_parallel(&seeds, available_threads(), |&seed| {
        let study = format!("sigma = \"{} K\"\nfind = [\"P\"]", bench.sigma);
        let found = inferred(&body(&study, &bench.csv(&course, seed))).unwrap();
        let rows = course.iter().zip(&found.courses[0].band);
        rows.filter(|((_, power, _), band)| band.ends.0 <= *power && *power <= band.ends.1).count()
    });
    100.0 * held.iter().sum::<usize>() as f64 / f64::from(records * bench.rows)
}

#[test]
fn the_band_holds_steps_ramps_and_a_cycle() {
    for bench in
        [Bench { every: 5.0, rows: 600, sigma: 0.1 }, Bench { every: 10.0, rows: 300, sigma: 0.05 }]
    {
        let part = covered(&bench, 8);
        println!("every {} s: {part} %", bench.every);
        assert!((93.0..=98.0).contains(&part), "every {} s: {part} %", bench.every);
    }
}

/// Truths that are drawn as the study says: their ranks in the stated Gaussian are uniform (S. Talts
/// et al., arXiv 1804.06788). Chi-square with 9 degrees of freedom: 21.67 is exceeded in 1 of 100.
fn ranks(records: u32) -> [f64; 3] {
    let bench = Bench { every: 10.0, rows: 60, sigma: 0.1 };
    let seeds: Vec<u32> = (0..records).collect();
    let ranks = in_parallel(&seeds, available_threads(), |&seed| {
        let mut walk = noise(100_000 + seed);
        // in steps of 0.5 s, as the study says: 30 W in 1 min
        let (mut now, mut last) = (100.0 + 40.0 * walk(), 0.0);
        let course = bench.course(|t| {
            now += 30.0 * ((t - last).max(0.0) / 60.0).sqrt() * walk();
            last = t;
            now
        });
        let study = "sigma = \"0.1 K\"\nfind = { P = { change = \"30 W\", within = \"1 min\" } }";
        let found = inferred(&body(study, &bench.csv(&course, seed))).unwrap();
        [3, 30, 59].map(|k| {
            let band = found.courses[0].band[k];
            let z = (course[k].1 - band.value) / half(band.ends);
            0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
        })
    });
    std::array::from_fn(|i| {
        let mut bins = [0.0_f64; 10];
        ranks.iter().for_each(|rank| bins[((rank[i] * 10.0) as usize).min(9)] += 1.0);
        let expected = f64::from(records) / 10.0;
        bins.iter().map(|count| (count - expected).powi(2) / expected).sum()
    })
}

#[test]
fn ranks_of_drawn_truths_are_uniform() {
    let found = ranks(1000);
    println!("chi-square {found:?}");
    assert!(found.iter().all(|chi| *chi < 21.67), "{found:?}");
}

/// The film coefficient of a wind over a hot plate is not linear in anything; rounds find it. The
/// record is that of the network itself with the estimated time history, integrated in short steps.
#[test]
fn a_film_coefficient_over_time_is_found_in_rounds() {
    let truth = |t: f64| 25.0 * (1.0 + 0.6 * f64::sin(t / 300.0));
    let (mut kelvin, mut csv) = (298.15, String::from("t [s],tc [degC]\n"));
    let mut noise = noise(7);
    for k in 0..241 {
        let time = 10.0 * f64::from(k);
        csv += &format!("{time},{}\n", kelvin - 273.15 + 0.05 * noise());
        for part in 0..1000 {
            let t = time + 0.01 * (f64::from(part) + 0.5);
            let out = truth(t) * 0.1 * (kelvin - 298.15)
                + 0.8 * 5.670_374_419e-8 * 0.1 * (kelvin.powi(4) - 298.15_f64.powi(4));
            kelvin += 0.01 * (200.0 - out) / 900.0;
        }
    }
    let text = "format = 1\n[signal]\nh = \"10 W/(m^2 K)\"\n[node]\nplate = { C = \"900 J/K\", T0 = \"25 degC\" \
         }\n[boundary]\nair = { T = \"25 degC\" }\n[convection]\nwind = { from = \"plate\", to = \"air\", \
         h = \"h\", area = \"0.1 m^2\" }\n[radiation]\nglow = { from = \"plate\", to = \"air\", area = \
         \"0.1 m^2\", emissivity = 0.8 }\n[source]\nheat = { into = \"plate\", P = \"200 W\" }\n\
         [infer.film]\ndata = \"r.csv\"\ncolumn = { tc = \"plate.T\" }\nsigma = \"0.05 K\"\n\
         find = { h = { positive = true } }\n";
    let found = inferred(&parse(text, &csv)).unwrap();
    let band = &found.courses[0].band;
    let late = (20..241).filter(|k| {
        let value = truth(10.0 * *k as f64);
        band[*k].ends.0 <= value && value <= band[*k].ends.1
    });
    let part = 100.0 * late.count() as f64 / 221.0;
    assert!(part > 90.0, "{part} % in {} rounds", found.rounds);
    near(band[120].value, truth(1200.0), 0.08 * truth(1200.0));
}

/// Two instruments on one body: that which drifts is named, and neither where none does.
#[test]
fn a_drifting_instrument_is_told_from_a_sound_one() {
    let bench = Bench { every: 5.0, rows: 300, sigma: 0.1 };
    let course = bench.course(driven);
    for drift in [0.0, 1.0] {
        let mut noise = noise(3);
        let row = |(t, _, rise): &(f64, f64, f64)| {
            let (one, two) = (0.1 * noise(), 0.1 * noise());
            format!("{t},{},{}\n", 25.0 + rise + one, 25.0 + rise + two + drift * t / 1495.0)
        };
        let csv =
            format!("t [s],tc [degC],tc2 [degC]\n{}", course.iter().map(row).collect::<String>());
        let found = inferred(&two(&csv)).unwrap();
        let seen = found.columns[1].drift.unwrap();
        near(seen.value, drift, 5.0 * seen.deviation);
        assert!(seen.deviation < 0.03, "{seen:?}");
    }
}

fn two(csv: &str) -> Netlist {
    let text = "format = 1\n[signal]\nP = \"100 W\"\n[node]\nbody = { C = \"2659 J/K\", T0 = \"25 degC\" }\n\
         [boundary]\nroom = { T = \"25 degC\" }\n[resistor]\nskin = { from = \"body\", to = \"room\", \
         R = \"0.3 K/W\" }\n[source]\nheat = { into = \"body\", P = \"P\" }\n[infer.power]\ndata = \
         \"r.csv\"\ncolumn = { tc = \"body.T\", tc2 = \"body.T\" }\nsigma = \"0.1 K\"\nfind = [\"P\"]\n";
    parse(text, csv)
}

/// A free offset on the only instrument, and a free start: nothing tells them apart.
#[test]
fn what_cannot_be_known_has_a_band_as_wide_as_before() {
    let bench = Bench { every: 10.0, rows: 30, sigma: 0.1 };
    let csv = bench.csv(&bench.course(|_| 150.0), 1);
    let free =
        inferred(&body("sigma = \"0.1 K\"\nfind = [\"P\"]\ninitial = \"free\"", &csv)).unwrap();
    let known = inferred(&body("sigma = \"0.1 K\"\nfind = [\"P\"]", &csv)).unwrap();
    let width = |found: &Inferred| half(found.courses[0].band[15].ends);
    assert!(width(&free) > width(&known), "{} {}", width(&free), width(&known));
}

#[test]
fn what_cannot_be_inferred_is_refused() {
    let bench = Bench { every: 10.0, rows: 30, sigma: 0.1 };
    let csv = bench.csv(&bench.course(|_| 150.0), 1);
    let netlist = body("sigma = \"0.1 K\"\nfind = [\"P\"]", &csv);
    let task = InferTask::of(&netlist, &netlist.studies.infers[0]).unwrap();
    let open = Follower::new(task).unwrap_err();
    assert!(matches!(open, InferError::Smoothness { .. }), "{open}");
    let jumps = WALK.replace("min\"", "min\", jumps = true");
    let netlist = body(&format!("sigma = \"0.1 K\"\nfind = {jumps}"), &csv);
    let task = InferTask::of(&netlist, &netlist.studies.infers[0]).unwrap();
    assert!(matches!(Follower::new(task).unwrap_err(), InferError::Jumps { .. }));
    let short = body("sigma = \"0.1 K\"\nfind = [\"P\"]", "t [s],tc [degC]\n0,25\n");
    assert!(matches!(inferred(&short).unwrap_err(), InferError::Short));
}

const OPEN: &str = "sigma = \"0.1 K\"\nfind = [\"P\"]";

/// SciPy 1.11: generalised least squares of the same record with jumps at the six moments of the
/// truth, each beside a shift of temperature of which nothing is known, since a jump may come
/// anywhere between two rows.
#[test]
fn reference_held_loads_are_known_by_their_jumps() {
    let bench = Bench { every: 5.0, rows: 600, sigma: 0.1 };
    let course = bench.course(held);
    let csv = bench.csv(&course, 2);
    let found = inferred(&body(OPEN, &csv)).unwrap();
    let expected = [
        (300.0, 120.666_542_94, 0.266_795_64),
        (900.0, -160.520_514_83, 0.424_423_22),
        (1200.0, 90.387_175_35, 0.424_423_22),
        (1800.0, 50.141_626_29, 0.424_423_22),
        (2100.0, -170.021_069_98, 0.424_423_22),
        (2700.0, 90.378_849_27, 0.433_937_55),
    ];
    assert_eq!(found.jumps.len(), expected.len());
    for (jump, (moment, by, deviation)) in found.jumps.iter().zip(expected) {
        assert!(jump.between.0 <= moment && moment <= jump.between.1, "{jump:?}");
        near(jump.by.value, by, 0.3 * deviation);
        near(jump.by.deviation, deviation, 0.05 * deviation);
    }
    let smooth = "sigma = \"0.1 K\"\nfind = { P = { jumps = false } }";
    let smooth = inferred(&body(smooth, &csv)).unwrap();
    assert!(smooth.jumps.is_empty());
    let width = |found: &Inferred| half(found.courses[0].band[90].ends);
    assert!(width(&smooth) > 10.0 * width(&found), "{} {}", width(&smooth), width(&found));
}

/// Records in which nothing jumps: the price of a jump allows for 2 of 40.
#[test]
fn chance_does_not_jump() {
    let bench = Bench { every: 5.0, rows: 120, sigma: 0.1 };
    let ramp = |t: f64| 50.0 + 0.3 * t;
    for truth in [&(|_| 220.0) as &(dyn Fn(f64) -> f64 + Sync), &ramp] {
        let course = bench.course(truth);
        let seeds: Vec<u32> = (0..40).collect();
        let jumps = in_parallel(&seeds, available_threads(), |&seed| {
            inferred(&body(OPEN, &bench.csv(&course, seed))).unwrap().jumps.len()
        });
        let records = jumps.iter().filter(|jumps| **jumps > 0).count();
        assert!(records <= 2, "{records}");
    }
}
