//! What depends on temperature is seen, however narrow: random bodies whose heat has tables, kinks
//! and narrow functions of temperature, against the quadrature `t = C int dT / q(T)`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the measured figures, shown with --nocapture")]

use crate::features;

use std::sync::Arc;

use features::{Dice, Feature, ZERO, seeds};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, Context, HeatCapacity, Network, NetworkBuilder, Path, Temperature, Time,
};
use lptn_solve::{EventKind, Solution, Transient, Unbounded};
use lptn_units::{Interpolation, LookupTable, Outside, Table1, TableSymbol, Type};

/// Errors beyond so many tolerances have to be told.
const FACTOR: f64 = 10.0;

/// How many random bodies are tried; `LPTN_GUARD_CASES` gives another number.
const CASES: u64 = 120;

fn add_table(feature: &Feature, number: usize, b: &mut NetworkBuilder) {
    let Some((x, y)) = feature.table() else { return };
    let table = Table1::new(x, y, Interpolation::Linear, Outside::Hold).unwrap();
    let table = Arc::new(LookupTable::One(table));
    let symbol =
        TableSymbol { table, arguments: vec![Type::SCALAR], ty: Type::SCALAR, units: vec![] };
    b.table(&format!("shape{number}"), symbol);
}

/// A body of 1 kJ/K that is heated from 20 degC by about 100 W, or cools from 600 degC.
struct Body {
    features: Vec<Feature>,
    cools: bool,
}

const C: f64 = 1000.0;

impl Body {
    fn random(dice: &mut Dice) -> Self {
        let cools = dice.roll() < 0.3;
        let range = if cools { (150.0, 550.0) } else { (30.0, 100.0) };
        let count = 1 + dice.one_of(3);
        Self { features: (0..count).map(|_| Feature::random(dice, range)).collect(), cools }
    }

    fn start(&self) -> f64 {
        if self.cools { 600.0 } else { 20.0 }
    }

    fn factor(&self, celsius: f64) -> f64 {
        1.0 + self.features.iter().map(|feature| feature.of(celsius)).sum::<f64>()
    }

    /// Heat that it receives in W.
    fn heat(&self, celsius: f64) -> f64 {
        let loss = if self.cools { 5.0 * self.factor(celsius) } else { 1e-3 };
        let power = if self.cools { 0.0 } else { 100.0 * self.factor(celsius) };
        power - loss * (celsius - 20.0)
    }

    fn network(&self) -> Network {
        let mut b = NetworkBuilder::new();
        let body = b.node("body", HeatCapacity(C), Temperature::celsius(self.start()));
        let air = b.boundary("air", Temperature::celsius(20.0));
        self.features.iter().enumerate().for_each(|(k, feature)| add_table(feature, k, &mut b));
        let terms =
            self.features.iter().enumerate().map(|(k, feature)| {
                feature.text(k, if self.cools { "body.T" } else { "T" }, "degC")
            });
        let factor = format!("(1 + {})", terms.collect::<Vec<String>>().join(" + "));
        if self.cools {
            let text = format!("5 [W/K] * {factor}");
            let g = b.expression_in(Context::Link, &text, None).unwrap();
            b.resistor("skin", body, air, Path::conductance(g));
        } else {
            b.resistor("skin", body, air, Conductance(1e-3));
            let text = format!("100 [W] * {factor}");
            let power = b.expression_in(Context::Source, &text, None).unwrap();
            b.source("heater", body, power);
        }
        b.build().unwrap()
    }

    /// Times at which it has the temperatures of a fine grid, up to a stop in s.
    fn course(&self) -> Vec<(f64, f64)> {
        let sign = if self.cools { -1.0 } else { 1.0 };
        let end = if self.cools { 60.0 } else { 130.0 };
        let mut grid: Vec<f64> = self.features.iter().flat_map(Feature::corners).collect();
        let cells = 20_000;
        let part = |k: i32| self.start() + (end - self.start()) * f64::from(k) / f64::from(cells);
        grid.extend((0..=cells).map(part));
        grid.retain(|t| (t - self.start()) * sign >= 0.0 && (end - t) * sign >= 0.0);
        grid.sort_by(|a, b| (a * sign).total_cmp(&(b * sign)));
        grid.dedup();
        let mut course = vec![(0.0, grid[0])];
        for pair in grid.windows(2) {
            let time = course[course.len() - 1].0 + self.takes(pair[0], pair[1]);
            course.push((time, pair[1]));
        }
        course
    }

    /// Time in s from one temperature in degC to another, by Gauss's quadrature at three points.
    fn takes(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let at = |x: f64| C / self.heat(middle + half * x);
        let edge = 0.6_f64.sqrt();
        half / 9.0 * (5.0 * (at(-edge) + at(edge)) + 8.0 * at(0.0))
    }

    /// The temperature in degC at a time.
    fn at(&self, course: &[(f64, f64)], time: f64) -> f64 {
        let place = course.partition_point(|point| point.0 <= time).clamp(1, course.len() - 1);
        let (before, from) = course[place - 1];
        let mut found = from;
        for _ in 0..5 {
            found += (time - before - self.takes(from, found)) * self.heat(found) / C;
        }
        found
    }
}

/// The largest error over the tolerance, and whether growth is told.
fn error_of(body: &Body, tolerance: f64) -> (f64, Solution) {
    let course = body.course();
    let stop = 0.999 * course[course.len() - 1].0;
    let system = ThermalSystem::assemble(&body.network()).unwrap();
    let run = Transient::until(Time(stop)).every(Time(stop / 100.0)).tolerance(tolerance);
    let solution = run.solve(&system).unwrap();
    let node = solution.network().node("body").unwrap();
    let temperatures = solution.temperature(node).unwrap();
    let error = solution
        .times()
        .iter()
        .zip(&temperatures)
        .map(|(time, kelvin)| (kelvin - ZERO - body.at(&course, *time)).abs() / tolerance);
    (error.fold(0.0, f64::max), solution)
}

#[test]
fn nothing_narrow_over_temperature_is_passed_unseen() {
    let mut failed = Vec::new();
    let (mut worst, mut told, mut steps) = (0.0_f64, 0, 0);
    for seed in seeds(CASES) {
        let mut dice = Dice::new(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let body = Body::random(&mut dice);
        let tolerance = [1e-3, 1e-4, 1e-5][usize::try_from(seed % 3).unwrap()];
        let (error, solution) = error_of(&body, tolerance);
        steps += solution.statistics().steps;
        match solution.why_unbounded() {
            None => worst = worst.max(error),
            Some(_) => told += 1,
        }
        if error > FACTOR && solution.error_is_bounded() {
            failed.push(seed);
            println!(
                "seed {seed}: {error:.1} tolerances of {tolerance:e} K, grown {:.2}; {:?}",
                solution.growth(),
                body.features
            );
        }
    }
    println!("worst {worst:.2} tolerances, {told} told, {steps} steps");
    assert!(failed.is_empty(), "{failed:?}");
}

/// A body of 1 kJ/K with a heat in W, almost without loss, after 900 s in degC.
fn after(power: &str) -> (f64, Solution) {
    let mut b = NetworkBuilder::new();
    let body = b.node("body", HeatCapacity(C), Temperature::celsius(20.0));
    let air = b.boundary("air", Temperature::celsius(20.0));
    b.resistor("skin", body, air, Conductance(1e-9));
    let power = b.expression_in(Context::Source, power, None).unwrap();
    b.source("heater", body, power);
    let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
    let solution = Transient::until(Time(900.0)).solve(&system).unwrap();
    let end = solution.temperature(body).unwrap();
    (end[end.len() - 1] - ZERO, solution)
}

#[test]
fn a_band_that_a_step_would_pass_switches_twice() {
    let (band, widths) = ("100 [W] - if(abs(T - 61.37 [degC]) < ", [2.0, 0.5, 0.01]);
    for width in widths {
        let (end, solution) = after(&format!("{band}{width} [K], 90 [W], 0 [W])"));
        let compared = |event: &&lptn_solve::Event| matches!(event.kind, EventKind::Comparison(_));
        assert_eq!(solution.events().iter().filter(compared).count(), 2, "{width}");
        // at 10 W instead of 100 it takes ten times as long through the band
        let right = 110.0 - 9.0 * 2.0 * width;
        assert!((end - right).abs() < 1e-4, "{width}: {end} for {right}");
    }
}

/// `dT/dt = (1 W + 2 W/K (T - 20 degC) - 1 W/K (T - 20 degC)) / C`: the rise is `e^(t/tau) - 1` K.
#[test]
fn errors_that_grow_are_made_up_for_or_told() {
    for (stop, bounded) in [(500.0, true), (1500.0, false)] {
        let mut b = NetworkBuilder::new();
        let body = b.node("body", HeatCapacity(100.0), Temperature::celsius(20.0));
        let air = b.boundary("air", Temperature::celsius(20.0));
        b.resistor("skin", body, air, Conductance(1.0));
        let text = "1 [W] + 2 [W/K] * (T - 20 [degC])";
        let power = b.expression_in(Context::Source, text, None).unwrap();
        b.source("leakage", body, power);
        let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
        let solution = Transient::until(Time(stop)).solve(&system).unwrap();
        let rows = solution.times().iter().zip(solution.temperature(body).unwrap());
        let error = rows.map(|(t, kelvin)| (kelvin - ZERO - 19.0 - (t / 100.0).exp()).abs());
        let error = error.fold(0.0, f64::max) / solution.tolerance();
        println!("{stop} s: {error:.1} tolerances, {:?}", solution.why_unbounded());
        match solution.why_unbounded() {
            None => assert!(bounded && error < FACTOR, "{error}"),
            Some(Unbounded::Grows { factor }) => {
                let grown = (stop / 100.0).exp();
                assert!(!bounded && (factor / grown - 1.0).abs() < 0.5, "{factor} {grown}");
            }
            Some(other) => panic!("{other:?}"),
        }
    }
}

/// Nodes in a row, each heated with features of its own temperature and joined by conductances with
/// features of their mean, the last one to a boundary at 20 degC.
struct Row {
    capacities: Vec<f64>,
    heats: Vec<(f64, Feature)>,
    conductances: Vec<(f64, Feature)>,
}

impl Row {
    fn random(dice: &mut Dice) -> Self {
        let count = 2 + usize::try_from(dice.one_of(2)).unwrap();
        let feature = |dice: &mut Dice| {
            let mut feature = Feature::random(dice, (25.0, 90.0));
            feature.width = feature.width.max(0.5);
            feature
        };
        let capacities = (0..count).map(|_| dice.in_ratio(50.0, 500.0)).collect();
        let heats = (0..count).map(|_| (dice.between(10.0, 60.0), feature(dice))).collect();
        let conductances = (0..count).map(|_| (dice.in_ratio(0.5, 4.0), feature(dice))).collect();
        Self { capacities, heats, conductances }
    }

    fn network(&self) -> Network {
        let mut b = NetworkBuilder::new();
        let features = self.heats.iter().chain(&self.conductances);
        features.enumerate().for_each(|(k, (_, feature))| add_table(feature, k, &mut b));
        let air = b.boundary("air", Temperature::celsius(20.0));
        let start = Temperature::celsius(20.0);
        let nodes: Vec<_> = (self.capacities.iter().enumerate())
            .map(|(i, c)| b.node(&format!("n{i}"), HeatCapacity(*c), start))
            .collect();
        let count = nodes.len();
        for (i, (power, feature)) in self.heats.iter().enumerate() {
            let text = format!("{power:?} [W] * (1 + {})", feature.text(i, "T", "degC"));
            let power = b.expression_in(Context::Source, &text, None).unwrap();
            b.source(&format!("q{i}"), nodes[i], power);
        }
        for (i, (g, feature)) in self.conductances.iter().enumerate() {
            let text = format!("{g:?} [W/K] * (1 + {})", feature.text(count + i, "T_mean", "degC"));
            let g = Path::conductance(b.expression_in(Context::Link, &text, None).unwrap());
            match nodes.get(i + 1) {
                Some(next) => b.resistor(&format!("r{i}"), nodes[i], *next, g),
                None => b.resistor(&format!("r{i}"), nodes[i], air, g),
            };
        }
        b.build().unwrap()
    }

    /// Rates in K/s at temperatures in degC.
    fn rates(&self, celsius: &[f64]) -> Vec<f64> {
        let mut heat: Vec<f64> = (self.heats.iter().zip(celsius))
            .map(|((power, feature), t)| power * (1.0 + feature.of(*t)))
            .collect();
        for (i, (g, feature)) in self.conductances.iter().enumerate() {
            let (from, to) = (celsius[i], celsius.get(i + 1).copied().unwrap_or(20.0));
            let q = g * (1.0 + feature.of(0.5 * (from + to))) * (from - to);
            heat[i] -= q;
            heat.get_mut(i + 1).into_iter().for_each(|heat| *heat += q);
        }
        heat.iter().zip(&self.capacities).map(|(q, c)| q / c).collect()
    }

    /// The classical method of Runge and Kutta with a step in s.
    fn step(&self, celsius: &[f64], step: f64) -> Vec<f64> {
        let ahead = |rates: &[f64], part: f64| -> Vec<f64> {
            celsius.iter().zip(rates).map(|(t, rate)| t + part * step * rate).collect()
        };
        let k1 = self.rates(celsius);
        let k2 = self.rates(&ahead(&k1, 0.5));
        let k3 = self.rates(&ahead(&k2, 0.5));
        let k4 = self.rates(&ahead(&k3, 1.0));
        let mean = (0..k1.len()).map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
        ahead(&mean.collect::<Vec<f64>>(), 1.0)
    }
}

#[test]
fn rows_of_nodes_agree_with_tiny_steps() {
    const STEPS: usize = 200;
    let tolerance = 1e-3;
    let (mut worst, mut told, mut failed) = (0.0_f64, 0, Vec::new());
    for seed in seeds(10) {
        let mut dice = Dice::new(seed.wrapping_mul(0x2545_F491_4F6C_DD1D));
        let row = Row::random(&mut dice);
        let system = ThermalSystem::assemble(&row.network()).unwrap();
        let run = Transient::until(Time(100.0)).every(Time(1.0)).tolerance(tolerance);
        let solution = run.solve(&system).unwrap();
        let columns: Vec<Vec<f64>> = (solution.network().node_ids())
            .map(|id| solution.temperature(id).unwrap().into_iter().collect())
            .collect();
        let mut celsius = vec![20.0; columns.len()];
        let mut error = 0.0_f64;
        for k in 1..columns[0].len() {
            (0..STEPS).for_each(|_| celsius = row.step(&celsius, 1.0 / STEPS as f64));
            let errors = columns.iter().zip(&celsius).map(|(kelvin, t)| kelvin[k] - ZERO - t);
            error = errors.fold(error, |most, e| most.max(e.abs() / tolerance));
        }
        println!("row {seed}: {error:.2} tolerances, grown {:.2}", solution.growth());
        match solution.why_unbounded() {
            None if error > FACTOR => failed.push(seed),
            None => worst = worst.max(error),
            Some(_) => told += 1,
        }
    }
    println!("worst {worst:.2} tolerances, {told} told");
    assert!(failed.is_empty(), "{failed:?}");
}
